//! The growth of a spin chain with its length, measured in the interpreter.

use std::cell::RefCell;
use std::fmt;
use std::time::Instant;

use coadjoint::solve::{FixedPoint, Predict};
use coadjoint::{
    Exponential, GeneratingFunction, LieGroup, Phase, SO3, StepError, advance,
    groups::DirectProduct,
};
use coadjoint_codegen::emit;
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::hamilton_jacobi::{DeriveError, TermLimit};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::system::{self, Options};
use nalgebra::DVector;

const STEP: f64 = 0.05;
/// Steps timed for one row: about a second's worth for the longest chain.
const STEPS: usize = 100;

/// Why a chain could not be measured.
#[derive(Debug, thiserror::Error)]
pub enum GrowthError {
    /// The system text was refused.
    #[error("{0}")]
    System(String),
    /// The series was.
    #[error(transparent)]
    Derive(#[from] DeriveError),
    /// A step was not made.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// One row of the table.
#[derive(Clone, Debug)]
pub struct Growth {
    /// N.
    pub sites: usize,
    /// Terms of S₁ + S₃.
    pub terms: usize,
    /// Operations of predictor and gradient.
    pub operations: usize,
    /// Reading, series, predictor and lowering, in milliseconds.
    pub generation: f64,
    /// Bytes of the emitted module; `None` where it is too large to emit.
    pub bytes: Option<usize>,
    /// A step in the interpreter, in microseconds.
    pub step: f64,
    /// Evaluations of the fixed point (or Newton iterations) per step.
    pub iterations: f64,
    /// The largest change of a coordinate of the spatial momentum.
    pub drift: f64,
}

impl Growth {
    /// The headings of the rows.
    pub const HEADINGS: &str = "   N    terms           operations      generation ms   code bytes        \
         step µs          iterations  momentum drift";
}

impl fmt::Display for Growth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.sites;
        let each = |count: usize| format!("{count} ({})", count / n);
        let time = |value: f64| format!("{value:.1} ({:.2})", value / n as f64);
        let bytes = self.bytes.map_or("too large".to_owned(), each);
        write!(
            f,
            "{n:>4}    {:<14}  {:<14}  {:<14}  {bytes:<16}  {:<15}  {:<10.1}  {:.1e}",
            each(self.terms),
            each(self.operations),
            time(self.generation),
            time(self.step),
            self.iterations,
            self.drift,
        )
    }
}

/// The system file of a ring of `sites` spins.
#[must_use]
pub fn ring(sites: usize) -> String {
    format!(
        r#"
name = "ring"
group = "SO3^{sites}"
coordinates = ["x", "y", "z"]
hamiltonian = """
sum(i, 0..{sites}, 0.3*z[i]^2 - 0.5*z[i]
  - (x[i]*x[(i + 1) % {sites}] + y[i]*y[(i + 1) % {sites}] + z[i]*z[(i + 1) % {sites}]))
"""
[integrator]
truncation = 3
solver = "fixed_point"
[initial]
momentum = ["0.8*cos(1.3*i)", "0.8*sin(1.3*i)", "0.6"]
"#
    )
}

/// Generates, emits and runs a ring of `sites` spins.
///
/// # Errors
/// [`GrowthError`].
pub fn measure(sites: usize) -> Result<Growth, GrowthError> {
    let text = ring(sites);
    let start = Instant::now();
    let system = system::read(&text, Options::default())
        .map_err(|mistakes| GrowthError::System(mistakes.render("ring", &text)))?;
    let integrator = Integrator::build(system.problem, TermLimit::default())?;
    let generation = start.elapsed().as_secs_f64() * 1e3;
    let bytes = emit::check_size(&integrator)
        .is_ok()
        .then(|| emit::file(&integrator, &emit::Options::for_problem("ring")).len());

    let step = Interpreted::new(&integrator, sites);
    let momentum = DVector::from_vec(system.run.momentum.unwrap_or_default());
    let mut phase = Phase::<DirectProduct<SO3>>::new(vec![SO3::new().identity(); sites], momentum);
    let before = phase.spatial_momentum(&step.group);
    let mut iterations = 0;
    let start = Instant::now();
    for _ in 0..STEPS {
        iterations += advance(&step, &mut phase)?.iterations;
    }
    let seconds = start.elapsed().as_secs_f64();
    let operations = integrator.predictor.cost().total() + integrator.gradient.cost().total();
    Ok(Growth {
        sites,
        terms: integrator.terms(),
        operations,
        generation,
        bytes,
        step: seconds * 1e6 / STEPS as f64,
        iterations: f64::from(iterations) / STEPS as f64,
        drift: (phase.spatial_momentum(&step.group) - before).amax(),
    })
}

/// The interpreter on closed forms of SO(3).
struct Interpreted<'a> {
    integrator: &'a Integrator,
    group: DirectProduct<SO3>,
    slots: Vec<f64>,
    scratch: RefCell<Vec<f64>>,
}

impl<'a> Interpreted<'a> {
    fn new(integrator: &'a Integrator, sites: usize) -> Self {
        Self {
            integrator,
            group: DirectProduct::new(vec![SO3::new(); sites]),
            slots: integrator.coefficients.fold(STEP, &[]),
            scratch: RefCell::new(Vec::new()),
        }
    }

    fn run(&self, program: &Program, p: &DVector<f64>) -> DVector<f64> {
        let mut result = vec![0.0; program.outputs().len()];
        program.run(p.as_slice(), &self.slots, &mut self.scratch.borrow_mut(), &mut result);
        DVector::from_vec(result)
    }
}

impl GeneratingFunction for Interpreted<'_> {
    type Group = DirectProduct<SO3>;
    type Chart = Exponential;

    fn group(&self) -> &DirectProduct<SO3> {
        &self.group
    }

    fn value(&self, p: &DVector<f64>) -> f64 {
        self.run(&self.integrator.value, p)[0]
    }

    fn gradient(&self, p: &DVector<f64>) -> DVector<f64> {
        self.run(&self.integrator.gradient, p)
    }
}

impl Predict for Interpreted<'_> {
    fn predict(&self, mu: &DVector<f64>) -> DVector<f64> {
        self.run(&self.integrator.predictor, mu)
    }
}

impl coadjoint::Integrator for Interpreted<'_> {
    type Method = FixedPoint;
}
