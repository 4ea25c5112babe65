//! A system ready to run: derived, lowered, folded for its step size.

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::{self, LieAlgebra, catalogue};
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::step::{Energy, Invariants, Origin, Step};
use coadjoint_codegen::system::{self, Options, Units};
use coadjoint_program::{Argument, Precision, Program, Stepper};

use crate::fields::Fields;
use crate::file::File;
use crate::file::Mistake;
use crate::rival::Rival;

/// Steps of more operations than this are too slow for a page.
const MOST_OPERATIONS: usize = 60_000;
/// Series may become this large: beyond, a page would stand still.
pub const LIMIT: TermLimit = TermLimit { terms: 20_000, products: 4_000_000 };

/// The time at which runs start: no field gives another one.
pub const START: f64 = 0.0;

/// The kind of a factor of the group, for pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Depiction {
    /// SO(3), or SU(2) as the real matrices of quaternions.
    Rotation,
    Motion,
    Plane,
    Matrix,
}

#[derive(Clone, Debug, serde::Serialize)]
pub struct Component {
    /// Rotations, vectors or other.
    pub kind: Depiction,
    /// The index of its first coordinate, and the number of coordinates.
    pub coordinate: usize,
    pub dim: usize,
    /// The first row of its block in the matrix of the group.
    pub row: usize,
    pub size: usize,
}

#[derive(Debug)]
pub struct System {
    pub file: String,
    /// The equations, with numbers for the parameters.
    pub origin: Origin,
    /// A step as programs.
    pub step: Step,
    /// Their folded coefficients.
    pub slots: Vec<f64>,
    pub h: f64,
    /// μ at the start.
    pub momentum: Vec<f64>,
    /// μ, then t where H is no polynomial, ↦ ∂H/∂μ.
    pub gradient: Program,
    pub casimirs: Vec<Polynomial>,
    /// The conserved quantities, as numbers.
    pub invariants: Invariants,
    pub factors: Vec<Component>,
    /// Runge and Kutta's method of order four for the same equations.
    pub rival: Rival,
    pub units: Units,
}

/// The first inputs of a program, as what it is differentiated in.
fn axes(dim: usize) -> Vec<Argument> {
    (0..dim).map(Argument::Input).collect()
}

impl System {
    /// The system of these fields.
    pub fn new(fields: &Fields) -> Result<Self, Vec<Mistake>> {
        let file = File::of(fields);
        let read = match system::read_either(&file.text, Options::default(), &[]) {
            Ok(read) if file.unwritten.is_empty() => read,
            Ok(_) => return Err(file.unwritten),
            Err(diagnostics) => return Err(file.mistakes(&diagnostics)),
        };
        let h = read.run.step.unwrap_or(0.1);
        let Some(momentum) = read.run.momentum else {
            return Err(vec![Mistake::of(
                "momentum",
                "the momentum at the start is missing",
                "give a number for each coordinate",
            )]);
        };
        let invariants = Invariants::new(read.problem.facts().algebra, Some(&read.problem));
        let large = |error| vec![Mistake::of("truncation", error, "lower the truncation")];
        let origin = Origin::derive(read.problem.settled().0, LIMIT).map_err(large)?;
        let gradient = origin.energy(&[]).slope();
        let refused = |error: &dyn std::fmt::Display| vec![Mistake::of_all(error, None)];
        if !origin.breaks().is_empty() {
            let what = "steps end at the times of held inputs and at breaks in the command and in Python, not on this page";
            return Err(refused(&what));
        }
        let step = origin.step(Precision::Double).map_err(|error| refused(&error))?;
        let programs = &step.kernel().programs;
        let operations = programs.correct.nodes().len() + programs.transport.nodes().len();
        if operations > MOST_OPERATIONS {
            let message = format!(
                "a step has {operations} operations, more than the {MOST_OPERATIONS} that this page runs"
            );
            return Err(vec![Mistake::of("truncation", message, "lower the truncation")]);
        }
        let slots = step.fold(h, &[]).map_err(|error| refused(&error))?;
        let algebra = origin.facts().algebra;
        let casimirs = lie::watched_casimirs(algebra);
        let factors = factors(algebra);
        let rival = Rival::new(algebra, &gradient, &slots);
        let system = Self {
            file: file.text,
            origin,
            step,
            slots,
            h,
            momentum,
            gradient,
            casimirs,
            invariants,
            factors,
            rival,
            units: read.units,
        };
        match system.undefined(START, &system.momentum) {
            Some(what) => {
                let help = "give a momentum at which the Hamiltonian is defined";
                Err(vec![Mistake::of("momentum", what, help).at(0..fields.momentum.len())])
            }
            None => Ok(system),
        }
    }

    /// The Hamiltonian.
    pub fn energy(&self) -> Energy<'_> {
        self.origin.energy(&[])
    }

    pub fn dim(&self) -> usize {
        self.momentum.len()
    }

    /// The series, where steps are made by one.
    pub fn series(&self) -> Option<&Integrator> {
        self.origin.series()
    }

    /// Makes a step with these coefficients, where need be as if there were none before it; whether it can be made.
    pub fn advance(&self, slots: &[f64], g: &mut [f64], mu: &mut [f64]) -> bool {
        let mut made = |g: &mut [f64]| self.step.kernel().advance(slots, g, mu, 1).steps == 1;
        made(g) || {
            self.step.forget(g);
            made(g)
        }
    }

    /// The expression in H that is not defined, or has no derivative, at (t, μ).
    pub fn undefined(&self, time: f64, mu: &[f64]) -> Option<String> {
        let energy = self.energy();
        let (expression, argument) = energy.undefined(time, mu)?;
        Some(format!("an expression is not defined at time {time}: {expression} of {argument}"))
    }

    /// ∂H/∂μ and ∂²H/∂μ², row by row, at μ = 0; at the start where they are not finite there.
    pub fn slopes(&self) -> [Vec<f64>; 2] {
        let (n, gradient) = (self.dim(), &self.gradient);
        let bend = gradient.push_forward(&axes(n));
        let at = |mu: &[f64]| {
            let mut inputs = mu.to_vec();
            inputs.resize(gradient.inputs() + n, 0.0);
            let slope = gradient.run(&inputs, &self.slots);
            let column = |i: usize| {
                let mut inputs = inputs.clone();
                inputs[gradient.inputs() + i] = 1.0;
                bend.run(&inputs, &self.slots)
            };
            [slope, (0..n).flat_map(column).collect()]
        };
        let finite = |slopes: &[Vec<f64>; 2]| slopes.iter().flatten().all(|x| x.is_finite());
        Some(at(&vec![0.0; n])).filter(finite).unwrap_or_else(|| at(&self.momentum))
    }
}

/// The factors of a group as the programs of its steps have them.
fn factors(algebra: &LieAlgebra) -> Vec<Component> {
    let (mut coordinate, mut row) = (0, 0);
    let factor = |factor: LieAlgebra| {
        let is = |name: &str| {
            catalogue::lookup(name).is_ok_and(|known| known.renamed(factor.name()) == factor)
        };
        let dim = factor.dim();
        let size = factor.matrix_size();
        let kind = match () {
            () if is("SO3") || is("SU2") => Depiction::Rotation,
            () if is("SE3") => Depiction::Motion,
            () if is("SE2") => Depiction::Plane,
            () => Depiction::Matrix,
        };
        let found = Component { kind, coordinate, dim, row, size };
        (coordinate, row) = (coordinate + dim, row + size);
        found
    };
    algebra.factors().into_iter().map(factor).collect()
}
