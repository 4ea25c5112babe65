//! The product's own steps, as programs, from the text of a system.

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::step::{REACH, Step};
use coadjoint_codegen::system::{Options, Parameters, read};
use coadjoint_program::{Kernel, Stepper};

use crate::error::LearnError;

/// The paper's rigid body from (2, 0.5, 1).
pub(super) const RIGID_BODY: &str = r#"
name = "rigid-body"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2/3 + y^2/4 + z^2/5"

[initial]
momentum = [2.0, 0.5, 1.0]
"#;

/// A heavy top with moments (1, 1.2, 0.8) and its weight at (0.1, 0, 0.4).
pub(super) const HEAVY_TOP: &str = r#"
name = "heavy-top"
group = "SE3"
coordinates = ["x", "y", "z", "u", "v", "w"]
hamiltonian = "x^2/2 + y^2/2.4 + z^2/1.6 + 0.1*u + 0.4*w"

[initial]
momentum = [0.7, -0.4, 1.1, 0.0, 0.6, 0.8]
"#;

/// Steps of one size.
pub(super) struct Steps {
    step: Step,
    integrator: Integrator,
}

/// Where a run has come.
#[derive(Clone, Debug)]
pub(super) struct End {
    /// The momentum.
    pub(super) momentum: Vec<f64>,
    /// The matrix of the group element, row by row.
    pub(super) matrix: Vec<f64>,
    /// The corrections made on the way, all steps together.
    pub(super) corrections: u64,
}

impl Steps {
    /// Of a system, in this chart, with this truncation.
    pub(super) fn new(system: &str, chart: Chart, truncation: usize) -> Result<Self, LearnError> {
        let failed = |reason: String| LearnError::NotConverged { reason };
        let options = Options {
            parameters: Parameters::Substituted,
            truncation: Some(truncation),
            chart: Some(chart),
            solver: None,
        };
        let system = read(system, options).map_err(|e| failed(e.render("system", system)))?;
        let integrator = Integrator::build(system.problem, TermLimit::default())
            .map_err(|e| failed(e.to_string()))?;
        let step = Step::build(&integrator, REACH).map_err(|e| failed(e.to_string()))?;
        Ok(Self { step, integrator })
    }

    /// The programs.
    pub(super) fn kernel(&self) -> &Kernel {
        self.step.kernel()
    }

    /// So many steps of size `h` from the identity and this momentum; `None` where one is refused.
    pub(super) fn run(&self, h: f64, steps: u64, momentum: &[f64]) -> Option<End> {
        // No momentum is too large for the series: how far it converges is what is looked at.
        let radius = 1e100;
        let slots = self.step.slots(&self.integrator.coefficients.fold(h, &[]), radius);
        let kernel = self.kernel();
        let size = kernel.programs().matrix.outputs().len().isqrt();
        let identity: Vec<f64> =
            (0..size * size).map(|i| if i % (size + 1) == 0 { 1.0 } else { 0.0 }).collect();
        let (mut g, mut momentum) = (self.step.element_of(&identity), momentum.to_vec());
        let mut corrections = 0;
        for _ in 0..steps {
            let made = kernel.advance(&slots, &mut g, &mut momentum, 1);
            if made.steps == 0 {
                return None;
            }
            corrections += u64::from(made.corrections);
        }
        let mut nodes = Vec::new();
        let program = &kernel.programs().matrix;
        program.evaluate(|i| g[i], |i| slots[i], &mut nodes);
        let matrix = program.outputs().iter().map(|id| nodes[id.index()]).collect();
        Some(End { momentum, matrix, corrections })
    }
}
