//! A run: flows, or flows and kicks, from the initial state to the end.

use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint::{
    Cayley, Chart, Exponential, GeneratingFunction, Phase, StepError, solve::Solution,
    solve::solve, steps::reconstruct,
};
use coadjoint_codegen::lie;
use coadjoint_program::Trajectories;
use nalgebra::DVector;

use super::march::{Beside, March};
use super::mover::{ByPrograms, Made, OneByOne};
use super::outlet::Outlet;
use super::recorder::{Outcome, Watched};
use super::setup::Setup;
use super::subject::Subject;
use crate::engine::{
    Compiled, Forces, Interpreter, Restore, Steepness, advise, cayley_group, product_group,
    whole_group,
};
use crate::error::RunError;
use crate::load::Derived;
use crate::number::largest;

/// Runs a system from the start to the end.
///
/// # Errors
/// Settings that make no sense, and why the run stopped.
pub fn run(system: &Derived, setup: &Setup, outlet: &mut dyn Outlet) -> Result<Outcome, RunError> {
    let problem = &system.integrator.problem;
    if setup.momentum.len() != problem.algebra.dim() {
        return Err(RunError::Option("the momentum does not fit the group".to_owned()));
    }
    let group = system.group()?;
    let task = Task { system, setup };
    match problem.chart {
        lie::Chart::Exponential => task.integrate::<_, Exponential>(&group, outlet),
        lie::Chart::Cayley => {
            task.integrate::<_, Cayley>(&cayley_group(&system.file, &group)?, outlet)
        }
    }
}

impl Derived {
    /// The group that the equations are on. Kicks look at the matrices of the whole group; a flow alone goes factor by
    /// factor.
    ///
    /// # Errors
    /// Where the data defines no group.
    pub fn group(&self) -> Result<DirectProduct<MatrixGroup>, RunError> {
        let algebra = &self.integrator.problem.algebra;
        match &self.forces {
            Some(forces) => whole_group(&self.file, algebra, Some(&forces.kick.potential)),
            None => product_group(&self.file, algebra),
        }
    }

    /// The quantities watched in a run.
    pub fn watched(&self) -> Watched<'_> {
        let symmetries = self.forces.as_ref().map(|forces| forces.symmetries.as_slice());
        let problem = &self.integrator.problem;
        let (algebra, coordinates) = (&problem.algebra, problem.coordinates.as_slice());
        Watched { algebra, coordinates, energy: Some(&self.energy), attitude: true, symmetries }
    }

    /// The method of a run, in a few words.
    pub fn label(&self) -> String {
        let problem = &self.integrator.problem;
        let mut label = format!("K = {}, {}", problem.truncation, problem.chart);
        if problem.comoving.is_some() {
            label.push_str(", comoving");
        }
        if let Some(forces) = &self.forces {
            label = format!("{label}, {}", forces.splitting.name());
        }
        label
    }
}

/// The subject of the run.
#[derive(Clone, Copy)]
struct Task<'a> {
    system: &'a Derived,
    setup: &'a Setup,
}

impl<'a> Task<'a> {
    /// The run as its driver knows it.
    fn subject(&self) -> Subject<'a> {
        let Self { system, setup } = *self;
        Subject { file: &system.file, setup, watched: system.watched(), warnings: Vec::new() }
    }

    /// Advances from the initial state to the end.
    fn integrate<G: Restore, C: Chart<G>>(
        &self,
        group: &G,
        outlet: &mut dyn Outlet,
    ) -> Result<Outcome, RunError> {
        match &self.system.forces {
            Some(forces) => self.kicked::<G, C>(group, forces, outlet),
            None => self.flow::<G, C>(group, outlet),
        }
    }

    /// Flows and kicks.
    fn kicked<G: Restore, C: Chart<G>>(
        &self,
        group: &G,
        forces: &Forces,
        outlet: &mut dyn Outlet,
    ) -> Result<Outcome, RunError> {
        let integrator = &self.system.integrator;
        let h = self.setup.schedule.step;
        let make = |h| forces.step::<G, C>(integrator, group, h);
        let step = make(h).map_err(at_start)?;
        let longest = h * forces.longest_flow();
        let flow = Interpreter::<G, C>::new(integrator, group.clone(), longest);
        let flow = flow.map_err(at_start)?;
        let steepness = Steepness::new(&flow);
        let subject = self.subject();
        let mut mover = OneByOne::new(group, &self.setup.schedule, |time, phase: &mut _| {
            step(phase, time).map_err(|error| {
                let works = |h| make(h).is_ok_and(|s| s(&mut phase.clone(), time).is_ok());
                advise(error, h, works)
            })?;
            Ok(Made { solve: None })
        });
        let beside = Beside {
            side: &|time, part, phase| make(part)?(phase, time),
            ratio: &|mu| steepness.ratio(mu),
        };
        March { subject: &subject, group }.run(&mut mover, &beside, outlet)
    }

    /// The flow alone.
    fn flow<G: Restore, C: Chart<G>>(
        &self,
        group: &G,
        outlet: &mut dyn Outlet,
    ) -> Result<Outcome, RunError> {
        let integrator = &self.system.integrator;
        let schedule = &self.setup.schedule;
        let h = schedule.step;
        let series = |h| Interpreter::<G, C>::new(integrator, group.clone(), h);
        let step = series(h).map_err(at_start)?;
        let steepness = Steepness::new(&step);
        let subject = self.subject();
        let one = |step: &Interpreter<'_, G, C>, phase: &mut Phase<G>| {
            let solution = solve(step, &phase.momentum)?;
            let residual = residual(step, &phase.momentum, &solution);
            reconstruct(step, phase, &solution.x)?;
            Ok((solution.iterations, residual))
        };
        let side = |_: f64, part: f64, phase: &mut Phase<G>| one(&series(part)?, phase).map(drop);
        let advised = |error, phase: &Phase<G>| {
            advise(error, h, |h| series(h).is_ok_and(|step| one(&step, &mut phase.clone()).is_ok()))
        };
        let beside = Beside { side: &side, ratio: &|mu| steepness.ratio(mu) };
        let march = March { subject: &subject, group };
        let (backend, steps) = (self.setup.backend, schedule.steps as f64);
        let Some(compiled) =
            Compiled::new(&step, backend, steps, Trajectories::One, &self.system.kept)?
        else {
            let mut mover = OneByOne::new(group, schedule, |_, phase: &mut _| {
                let made = one(&step, phase).map_err(|error| advised(error, phase))?;
                Ok(Made { solve: Some(made) })
            });
            return march.run(&mut mover, &beside, outlet);
        };
        let mut mover = ByPrograms::new(&compiled, &step, &advised);
        let outcome = march.run(&mut mover, &beside, outlet);
        compiled.code().notes().iter().for_each(|note| outlet.warn(note));
        Ok(Outcome { backend: Some(compiled.code().used()), ..outcome? })
    }
}

fn at_start(source: StepError) -> RunError {
    RunError::Step { time: 0.0, source }
}

/// The residual of J_L(x, p) = μ, relative to the largest coordinate of μ: measured, where
/// the step itself reports an estimate. NaN where anything is NaN.
fn residual<G: Restore, C: Chart<G>>(
    step: &Interpreter<'_, G, C>,
    mu: &DVector<f64>,
    solution: &Solution<DVector<f64>, f64>,
) -> f64 {
    let reached = C::default().left_momentum(step.group(), &solution.x, &solution.p);
    let left = largest((reached - mu).iter().copied());
    let size = largest(mu.iter().copied());
    if size == 0.0 { left } else { left / size }
}
