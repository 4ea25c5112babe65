//! A run: flows, or flows and kicks, from the initial state to the end.

use coadjoint::{Chart, GeneratingFunction, Phase, Solution, StepError, fit, reconstruct, solve};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::problem::Solver;
use nalgebra::DVector;

use super::setup::Setup;
use super::trajectory::{Recorder, Trajectory, Watched};
use crate::engine::{Energy, Forces, Group, Interpreter};
use crate::error::CliError;
use crate::progress;

/// A step at a time, told to the recorder.
type Step<'s, G> =
    dyn FnMut(f64, &mut Phase<G>, &mut Recorder<'_, G>) -> Result<(), StepError> + 's;

/// What is run.
#[derive(Clone, Copy, Debug)]
pub struct Task<'a> {
    /// The flow.
    pub integrator: &'a Integrator,
    /// The kicks.
    pub forces: Option<&'a Forces>,
    /// The energy of both.
    pub energy: &'a Energy,
    /// From where, how far, in which steps.
    pub setup: &'a Setup,
}

impl<'a> Task<'a> {
    /// What is watched.
    pub fn watched(&self) -> Watched<'a> {
        let symmetries = self.forces.map(|forces| forces.symmetries.as_slice());
        Watched { energy: self.energy, symmetries }
    }

    /// Advances from the initial state to the end.
    pub fn integrate<G: Group, C: Chart<G>>(&self, group: G) -> Result<Trajectory, CliError> {
        let setup = self.setup;
        if let Some(forces) = self.forces {
            let step =
                forces.step::<G, C>(self.integrator, &group, setup.step).map_err(at_start)?;
            return self.march(&group, &mut |time, phase, _| step(phase, time));
        }
        match self.integrator.plan.solver {
            Solver::Newton => self.flow::<G, C, false>(group),
            Solver::FixedPoint => self.flow::<G, C, true>(group),
        }
    }

    /// The flow alone, by one of the solvers.
    fn flow<G: Group, C: Chart<G>, const FIXED_POINT: bool>(
        &self,
        group: G,
    ) -> Result<Trajectory, CliError> {
        let Setup { step: h, tuned, fitted, momentum, .. } = self.setup;
        let series = |h| Interpreter::<G, C, FIXED_POINT>::new(self.integrator, group.clone(), h);
        let step = match fitted {
            Some(duration) => {
                let fit = fit(*h, series, [momentum.clone()], *duration);
                fit.map_err(|error| CliError::Option(format!("--fitted: {error}")))?.integrator
            }
            None if *tuned => Interpreter::tuned(self.integrator, group.clone(), *h, momentum)
                .map_err(at_start)?,
            None => series(*h).map_err(at_start)?,
        };
        self.march(&group, &mut |_, phase, recorder| {
            let solution = solve(&step, &phase.momentum)?;
            recorder.solved(solution.iterations, residual(&step, &phase.momentum, &solution));
            reconstruct(&step, phase, &solution.x);
            Ok(())
        })
    }

    /// Makes the steps.
    fn march<G: Group>(&self, group: &G, step: &mut Step<'_, G>) -> Result<Trajectory, CliError> {
        let setup = self.setup;
        let mut phase = Phase::<G>::new(setup.element(group)?, setup.momentum.clone());
        let problem = &self.integrator.problem;
        let mut label = format!("K = {}, {}", problem.truncation, problem.chart);
        if problem.comoving.is_some() {
            label.push_str(", comoving");
        }
        if setup.tuned {
            label.push_str(", tuned");
        }
        if setup.fitted.is_some() {
            label.push_str(", fitted");
        }
        if let Some(forces) = self.forces {
            label = format!("{label}, {}", forces.splitting.name());
        }
        let mut recorder = Recorder::new(group, self.watched(), &phase, self.integrator, label);
        let bar = progress::bar(setup.steps, "integrating");
        for n in 1..=setup.steps {
            let time = (n - 1) as f64 * setup.step;
            step(time, &mut phase, &mut recorder)
                .map_err(|source| CliError::Step { time, source })?;
            let record = n % setup.every == 0 || n == setup.steps;
            recorder.visit(n as f64 * setup.step, &phase, record);
            if n % 256 == 0 {
                bar.set_position(n);
            }
        }
        bar.finish_and_clear();
        Ok(recorder.finish(setup.steps, &phase))
    }
}

fn at_start(source: StepError) -> CliError {
    CliError::Step { time: 0.0, source }
}

/// What the solve leaves of J_L(x, p) = μ, relative to the largest coordinate of μ: measured, where
/// the step itself reports an estimate.
fn residual<G: Group, C: Chart<G>, const FIXED_POINT: bool>(
    step: &Interpreter<'_, G, C, FIXED_POINT>,
    mu: &DVector<f64>,
    solution: &Solution<DVector<f64>, f64>,
) -> f64 {
    let reached = C::default().left_momentum(step.group(), &solution.x, &solution.p);
    let size = mu.amax();
    if size > 0.0 { (reached - mu).amax() / size } else { 0.0 }
}
