//! Systems on all kinds of groups, to make kernels of.

use coadjoint::collocation::Energy;
use coadjoint::groups::Coordinates;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::{Problem, Solver};
use coadjoint_codegen::smooth::{Hamiltonian, Smooth};
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_codegen::system::{Options, Parameters, read, read_either};

use crate::sources;

/// Groups with a Hamiltonian on each.
pub const SYSTEMS: [(&str, &str); 17] = [
    ("SO3", "a^2/3 + b^2/4 + c^2/5"),
    ("SU2", "a^2/3 + b^2/4 + c^2/5 + a*b/7"),
    ("SE2", "a^2/3 + b^2/4 + c^2/5 + b*c/9"),
    ("SE3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9 + b*f/8"),
    ("SE3", "a^2/3 + b^2/4 + c^2/5 + 2*d + e/2 + f/3"),
    ("Heisenberg", "a^2/2 + b^2/3 + c^2/5 + a*c/4"),
    ("SL2", "a^2/5 + b^2/6 + c^2/7 + a*b/9"),
    ("Aff1", "a^2/5 + b^2/6"),
    ("SO4", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8"),
    ("SU3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + g^2/9 + h^2/10"),
    (
        "SE23",
        "a^2/2 + b^2/3 + c^2/4 + d^2/5 + e^2/4 + f^2/3 + g^2/6 + h^2/5 + i^2/3 + d*g/4 + a*e/9",
    ),
    ("Sp4", "a^2/4 + b^2/6 + c^2/7 + d^2/5 + e^2/6 + f^2/7 + g^2/8 + h^2/6 + i^2/9 + j^2/5"),
    // In the comoving frame.
    (
        "SU3",
        "a^2/3 + b^2/3 + c^2/5 + d^2/5 + e^2/7 + f^2/7 + (a*d - b*c)*f/3 + (a*c + b*d)*e/3 + 9*g",
    ),
    ("SO3^2", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9 + b*e/10"),
    ("SO3*SE2", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9"),
    ("SO3*R3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9"),
    ("SO3", "a^2/3 + b^2/4 + c^2/5 + a^4/50 + a*b*c/9"),
];

/// Hamiltonians that are no polynomials: a relativistic body; the same with parts that move between the middle and the ends of a
/// step; a spin with exponential anisotropy; six variables; a heavy top with gravity between its axes; one of three numbers.
pub const ROOT: &str = "sqrt(1 + a^2/1.5 + b^2/2 + c^2/2.5) + c^3/10";
pub const DRIVEN: &str =
    "sqrt(1 + a^2/1.5 + b^2/2 + c^2/2.5) + 3/10*cos(3*t)*a + sin(2*t)*b^2/4 + cos(t)*c^3/10";
pub const SPIN: &str = "0.6*a + 0.3*exp(0.8*c) + 0.2*exp(-b/2)";
pub const SIX: &str = "a^2/3 + b^2/4 + c^2/5 + a*d/7 + 2/3/sqrt(1 + d^2 + 2*e^2/3 + 1.5*f^2) \
    + exp(f/9 + c/11)*sqrt(1 + d^2 + 2*e^2/3 + 1.5*f^2)";
pub const TOP: &str = "a^2/3 + b^2/4 + c^2/5 + d/7 + 2*f/3";
pub const ANY: &str = "sqrt(1 + a^2/3 + 2*b^2/3 + c^2) + exp(a/4)/3";

/// Momenta from which these start.
pub const THREE: [f64; 3] = [2.0, 0.5, 1.0];
pub const SIX_MOMENTA: [f64; 6] = [0.8, -0.5, 0.6, 0.3, 0.7, -0.4];

/// The coefficients of a step of size `h` that takes the series seriously at any momentum.
pub fn unlimited(step: &Step, h: f64) -> Vec<f64> {
    limited(step, h, f64::MAX)
}

/// The coefficients of a step of size `h` for momenta up to `radius`.
pub fn limited(step: &Step, h: f64, radius: f64) -> Vec<f64> {
    let mut coefficients = step.fold(h, &[]).unwrap();
    coefficients[step.radius_at()] = radius * radius;
    coefficients
}

/// A system file on coordinates a, b, c, …, or of an algebra given by a table, its integrator with these settings.
fn system(group: &str, hamiltonian: &str, settings: &str) -> String {
    if group.starts_with('[') {
        return format!("hamiltonian = {hamiltonian:?}\n[integrator]\n{settings}{group}\n");
    }
    let dim = lie::catalogue::lookup(group).unwrap().dim();
    let names: Vec<String> = ('a'..).take(dim).map(|name| format!("\"{name}\"")).collect();
    let names = names.join(", ");
    format!(
        "group = {group:?}\ncoordinates = [{names}]\nhamiltonian = {hamiltonian:?}\n[integrator]\n{settings}"
    )
}

/// The problem of such a file.
pub fn problem(group: &str, hamiltonian: &str, settings: &str, options: Options) -> Problem {
    read(&system(group, hamiltonian, settings), options).unwrap().problem
}

/// The integrator of a system of [`SYSTEMS`].
pub fn integrator(group: &str, hamiltonian: &str, chart: &str, truncation: usize) -> Integrator {
    integrator_by(Solver::Newton, group, hamiltonian, chart, truncation)
}

/// As [`integrator`], solved by this method.
pub fn integrator_by(
    solver: Solver,
    group: &str,
    hamiltonian: &str,
    chart: &str,
    truncation: usize,
) -> Integrator {
    let options =
        Options { truncation: Some(truncation), solver: Some(solver), ..Options::default() };
    let problem = problem(group, hamiltonian, &format!("chart = {chart:?}\n"), options);
    Integrator::build(problem, TermLimit::default()).unwrap()
}

/// Any Hamiltonian in the coordinates a, b, …, for steps by collocation of the order `truncation` + 1.
pub fn smooth(group: &str, hamiltonian: &str, truncation: usize) -> Smooth {
    let text = system(group, hamiltonian, "method = \"collocation\"\n");
    let options = Options { truncation: Some(truncation), ..Options::default() };
    match read_either(&text, options, &[]).unwrap().problem {
        Hamiltonian::Smooth(smooth) => *smooth,
        Hamiltonian::Polynomial(..) => panic!("a polynomial: {hamiltonian}"),
    }
}

/// A smooth Hamiltonian for values of its symbols, by its programs.
#[derive(Clone)]
pub struct TextEnergy<'a> {
    pub smooth: &'a Smooth,
    pub symbols: Vec<f64>,
    /// True if it says how far its arguments go, which closures do not know.
    pub tells: bool,
}

impl<'a> TextEnergy<'a> {
    /// As a closure that has no symbols.
    pub fn closure(smooth: &'a Smooth) -> Self {
        Self { smooth, symbols: smooth.symbols_at(&[]), tells: false }
    }
}

fn list<V: Coordinates<f64>>(vector: &V) -> Vec<f64> {
    (0..vector.dim()).map(|i| vector[i]).collect()
}

impl<V: Coordinates<f64>> Energy<V> for TextEnergy<'_> {
    fn value(&self, time: f64, mu: &V) -> f64 {
        self.smooth.energy(&self.symbols, time, &list(mu))
    }

    fn gradient(&self, time: f64, mu: &V) -> V {
        let gradient = self.smooth.gradient(&self.symbols, time, &list(mu));
        V::from_entries(gradient.len(), |i| gradient[i])
    }

    fn reach(&self, from: (f64, &V), to: (f64, &V)) -> Option<f64> {
        let ends = ((from.0, &list(from.1)[..]), (to.0, &list(to.1)[..]));
        self.tells.then(|| self.smooth.reach(&self.symbols, ends.0, ends.1))?
    }

    fn unit(&self, i: usize) -> f64 {
        self.smooth.units[i]
    }
}

/// The steps of a file of `tests/systems/emitted`, its parameters kept as in the code that the build script emits.
pub fn emitted(name: &str) -> Origin {
    let text = sources::read(&format!("tests/systems/emitted/{name}.toml"));
    let kept = Options { parameters: Parameters::Kept, ..Options::default() };
    Origin::derive(read_either(&text, kept, &[]).unwrap().problem, TermLimit::default()).unwrap()
}
