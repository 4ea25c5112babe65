//! `cargo run --release -p coadjoint-run --example estimates -- [count] [seed]`
//!
//! Runs of random systems of ten kinds (1000 s seeded at 1), each with its estimate of the error at the end, beside the truth: a run
//! of another truncation and a much smaller step; of motions without forces also the momentum by the classical method of Runge
//! and Kutta. Ends with 1 where a bar of `docs/measurements/estimates.md` is missed.

use std::process::ExitCode;
use std::sync::LazyLock;
use std::time::Instant;

use coadjoint_codegen::step::Energy;
use coadjoint_codegen::system::Options;
use coadjoint_run::simulate::{
    LARGE, Outcome, Schedule, Setup, Unknown, Warning, matrix, run, split,
};
use coadjoint_run::{Backend, Derived, Grid, RunError, read_varying};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// An estimate is at most this many times too small, and [`ABOVE`] times too large.
const BELOW: f64 = 10.0;
const ABOVE: f64 = 100.0;
/// Seconds for which each run is made, again and again, to see what its estimate costs.
const LONG: f64 = 0.3;
/// Errors below the rounding of the steps of the truth by this much each are not told apart.
const FLOOR: f64 = 1.1e-16;

/// A random system.
struct Case {
    kind: &'static str,
    /// Its text, without `[integrator]` and `[run]`.
    text: String,
    /// Lines of `[integrator]` besides step and truncation.
    integrator: &'static str,
    truncation: usize,
    step: f64,
    time: f64,
    /// True if nothing acts but H(μ).
    free: bool,
}

impl Case {
    fn random(number: usize, random: &mut ChaCha8Rng) -> Self {
        let mut u = |low: f64, high: f64| random.random_range(low..high);
        let body =
            format!("x^2*{:.3} + y^2*{:.3} + z^2*{:.3}", u(0.2, 0.5), u(0.5, 0.8), u(0.8, 1.2));
        let start: Vec<f64> = (0..12).map(|_| u(-1.0, 1.0)).collect();
        let [a, b, c, d] = [u(0.1, 0.6), u(0.5, 2.0), u(1.0, 30.0), u(0.05, 0.4)];
        let order = [3, 5, 7][(number / 10) % 3];
        let xyz = "coordinates = \"x y z\"\n";
        let canonical = "[algebra]\ngenerators = [\"Q\", \"R\", \"P\", \"S\", \"E\"]\nbrackets = [\"[Q, P] = E\", \"[R, S] = E\"]\n";
        let (kind, dim, head, tail, integrator) = match number % 10 {
            0 => (
                "body",
                3,
                format!("group = \"SO3\"\n{xyz}hamiltonian = \"{body}\"\n"),
                String::new(),
                "",
            ),
            1 => (
                "body in a fluid",
                6,
                format!(
                    "group = \"SE3\"\ncoordinates = \"x y z u v w\"\nhamiltonian = \"{body} + {a:.3}*u^2 + {b:.3}*v^2 + {d:.3}*w^2 + {a:.3}*w\"\n"
                ),
                String::new(),
                "",
            ),
            2 => (
                "spins",
                9,
                format!(
                    "group = \"SO3^3\"\n{xyz}hamiltonian = \"-sum(i, 0..2, x[i]*x[i+1] + y[i]*y[i+1] + {b:.3}*z[i]*z[i+1]) - {d:.3}*z[1]^2\"\n"
                ),
                String::new(),
                "",
            ),
            3 => (
                "smooth",
                3,
                format!(
                    "group = \"SO3\"\n{xyz}hamiltonian = \"{body} + {a:.3}*sin({b:.3}*x + z) + sqrt(1 + y^2)\"\n"
                ),
                String::new(),
                "",
            ),
            4 => (
                "driven",
                3,
                format!(
                    "group = \"SU2\"\n{xyz}hamiltonian = \"{body} + {a:.3}*cos({b:.3}*t)*x + {b:.3}*exp(-((t - {c:.3})/{d:.3})^2)*y\"\n"
                ),
                String::new(),
                "",
            ),
            5 => (
                "potential",
                6,
                format!(
                    "group = \"SE3\"\ncoordinates = \"x y z u v w\"\nhamiltonian = \"{body} + (u^2 + v^2 + w^2)/2\"\npotential = \"{b:.3}*(g[0][3]^2 + g[1][3]^2 + g[2][3]^2) + {a:.3}*g[2][2]\"\n"
                ),
                String::new(),
                "",
            ),
            6 => (
                "two oscillators",
                4,
                format!(
                    "coordinates = \"q r p s e\"\nhamiltonian = \"(p^2 + s^2)/2 + {b:.3}*(1 - cos(q)) + r^2/2 + {d:.3}*q*r\"\n"
                ),
                canonical.to_owned(),
                "",
            ),
            7 => (
                "damped",
                3,
                format!("group = \"SO3\"\n{xyz}hamiltonian = \"{body}\"\ndamping = {d:.3}\n"),
                String::new(),
                "",
            ),
            8 => (
                "late torque",
                3,
                format!(
                    "group = \"SO3\"\n{xyz}hamiltonian = \"{body}\"\ntorque = [\"{b:.3}*exp(-((t - {c:.3})/{d:.3})^2)\", \"0\", \"{a:.3}*x\"]\n"
                ),
                String::new(),
                "",
            ),
            _ => {
                let times: Vec<String> = (0..41).map(|i| format!("{}", 5 * i)).collect();
                let values: Vec<String> = (0..41).map(|_| format!("{:.3}", u(-1.0, 1.0))).collect();
                let inputs = format!(
                    "[inputs]\ntimes = [{}]\nf = [{}]\n",
                    times.join(", "),
                    values.join(", ")
                );
                (
                    "inputs",
                    3,
                    format!("group = \"SO3\"\n{xyz}hamiltonian = \"{body} + {a:.3}*f*x\"\n"),
                    inputs,
                    "",
                )
            }
        };
        let mut momentum: Vec<String> = start[..dim].iter().map(|x| format!("{x:.4}")).collect();
        if number % 10 == 6 {
            momentum.push("-1".to_owned());
        }
        let text = format!(
            "name = \"case\"\n{head}{tail}[initial]\nmomentum = [{}]\n",
            momentum.join(", ")
        );
        let step = 10_f64.powf(u(-1.7, -0.4));
        let time = 10_f64.powf(u(0.7, 2.2));
        let free = [0, 1, 2, 3, 6].contains(&(number % 10));
        Self { kind, text, integrator, truncation: order, step, time, free }
    }

    /// What is run, and how.
    fn made(&self, truncation: usize, step: f64) -> Result<(Derived, Setup), RunError> {
        let Self { text, integrator, .. } = self;
        let text = format!("{text}[integrator]\ntruncation = {truncation}\n{integrator}");
        let system = read_varying("case", &text, Options::default(), &[])?;
        let momentum = system.run.momentum.clone().unwrap_or_default();
        let schedule = Schedule::of(Grid { start: 0.0, step }, self.time)?;
        // Nothing is compiled meanwhile.
        let setup = Setup { backend: Backend::Interpreter, ..Setup::new(schedule, momentum) };
        Ok((Derived::of(system)?, setup))
    }

    /// The end of the run.
    fn run(&self, truncation: usize, step: f64, estimate: bool) -> Result<Outcome, RunError> {
        let (derived, setup) = self.made(truncation, step)?;
        run(&derived, &Setup { estimate, ..setup }, &mut ())
    }

    /// Seconds of processor time that the estimate takes, and that the run takes, both together for a while.
    fn cost(&self) -> Result<[f64; 2], RunError> {
        let (derived, setup) = self.made(self.truncation, self.step)?;
        let (mut whole, mut alone) = (0.0, 0.0);
        while alone < LONG {
            for (estimate, time) in [(true, &mut whole), (false, &mut alone)] {
                let begun = processor_time();
                run(&derived, &Setup { estimate, ..setup.clone() }, &mut ())?;
                *time += processor_time() - begun;
            }
        }
        Ok([whole - alone, alone])
    }

    /// The momentum at the end, by Runge and Kutta's method.
    fn momentum(&self) -> Result<Vec<f64>, RunError> {
        let system = read_varying("case", &self.text, Options::default(), &[])?;
        let facts = system.problem.facts();
        let (dim, structure) = (facts.algebra.dim(), facts.algebra.constants());
        let energy = Energy::new(&system.problem);
        let field = |mu: &[f64]| {
            let (omega, mut field) = (energy.gradient(0.0, mu), vec![0.0; dim]);
            structure.iter().for_each(|&(i, j, k, c)| field[j] += omega[i] * c * mu[k]);
            field
        };
        let steps = (self.time / 1e-3).ceil();
        let h = self.time / steps;
        let mut mu = system.run.momentum.clone().unwrap_or_default();
        for _ in 0..steps as u64 {
            let at = |by: f64, k: &[f64]| -> Vec<f64> {
                mu.iter().zip(k).map(|(x, k)| x + by * k).collect()
            };
            let a = field(&mu);
            let b = field(&at(0.5 * h, &a));
            let c = field(&at(0.5 * h, &b));
            let d = field(&at(h, &c));
            mu = (0..dim).map(|i| mu[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i])).collect();
        }
        Ok(mu)
    }
}

/// Seconds for which this thread has had a processor; where the system does not tell, seconds gone by.
fn processor_time() -> f64 {
    static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| BEGUN.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut a.iter().zip(b).map(|(a, b)| a - b)) / norm(&mut b.iter().copied())
}

/// The larger of the relative differences of μ and g.
fn difference(a: &Outcome, b: &Outcome) -> f64 {
    let whole = |end: &Outcome| -> Vec<f64> {
        split(&end.blocks, &end.element)
            .flat_map(|(block, own)| matrix(block, own).as_slice().to_vec())
            .collect()
    };
    apart(&a.momentum, &b.momentum).max(apart(&whole(a), &whole(b)))
}

fn main() -> ExitCode {
    let number = |at: usize, default: u64| {
        std::env::args().nth(at).and_then(|text| text.parse().ok()).unwrap_or(default)
    };
    let (count, seed) = (number(1, 100), number(2, 1));
    let (mut good, mut warned, mut unknown, mut silent, mut refused) = (0, 0, 0, 0, 0);
    let (mut costs, mut checked, mut disagree) = (Vec::new(), 0, 0.0_f64);
    println!("| number | kind | K | h | steps | estimate | truth | ratio | of the run's time |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for number in 0..count {
        let mut random =
            ChaCha8Rng::seed_from_u64(seed.wrapping_mul(1_000_003).wrapping_add(number));
        // Systems whose steps are refused are drawn anew.
        let drawn = std::iter::repeat_with(|| {
            let case = Case::random(number as usize, &mut random);
            let end = case.run(case.truncation, case.step, true).ok()?;
            let fine = case.run(case.truncation + 2, case.step / 10.0, false).ok()?;
            Some((case, end, fine))
        });
        let mut drawn = drawn.inspect(|made| refused += usize::from(made.is_none())).flatten();
        let Some((case, end, fine)) = drawn.next() else { continue };
        let Case { kind, truncation, step, .. } = case;
        if case.free
            && let Ok(momentum) = case.momentum()
        {
            checked += 1;
            let error = apart(&fine.momentum, &momentum);
            if error > 1e-7 {
                println!("| {number} | {kind} | | | | the fine run is off by {error:.1e} | | | |");
            }
            disagree = disagree.max(error);
        }
        let truth = difference(&end, &fine);
        let told = end.estimated_error.as_ref().map_or_else(
            |why| match why {
                Unknown::Unresolved { until } => format!("not resolved after {until:.1}"),
                other => other.to_string(),
            },
            |error| format!("{error:.1e}"),
        );
        let floor = FLOOR * fine.steps as f64;
        let ratio =
            end.estimated_error.as_ref().map_or(f64::NAN, |e| e.max(floor) / truth.max(floor));
        let fits = (1.0 / BELOW..=ABOVE).contains(&ratio);
        let warning =
            |w: &Warning| matches!(w, Warning::Unresolved { .. } | Warning::Inaccurate { .. });
        match end.estimated_error {
            Ok(_) if fits => good += 1,
            Err(_) if truth < LARGE => unknown += 1,
            _ if end.warnings.iter().any(warning) => warned += 1,
            _ => silent += 1,
        }
        let [own, alone] = case.cost().unwrap_or([f64::NAN; 2]);
        let cost = own / alone;
        costs.push(cost);
        let mark = if fits { "" } else { " ✗" };
        println!(
            "| {number} | {kind} | {truncation} | {step:.3} | {} | {told} | {truth:.1e} | {ratio:.2}{mark} | {cost:.2} |",
            end.steps
        );
    }
    costs.sort_by(f64::total_cmp);
    println!(
        "\n{count} runs ({refused} drawn anew): {good} estimates within a factor of {BELOW} below and {ABOVE} above, {warned} of the \
         others warned of, {unknown} not known with an error below {LARGE}, {silent} wrong without a warning; cost {:.2} of the run in \
         the median, {:.2} in the mean; {checked} fine runs agree with Runge and Kutta's method to {disagree:.1e}",
        costs.get(costs.len() / 2).copied().unwrap_or(f64::NAN),
        costs.iter().sum::<f64>() / costs.len() as f64
    );
    let judged = count as usize - warned;
    let well = 20 * good >= 19 * judged && 20 * unknown <= judged && silent == 0;
    if well { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
