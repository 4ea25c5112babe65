//! From the text of a system to what steps are made of.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint_codegen::hamilton_jacobi::{DeriveError, TermLimit};
use coadjoint_codegen::integrator::{Integrator, Kick, Kicks};
use coadjoint_codegen::potential::Potential;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::smooth::{Facts, Functions, Hamiltonian, Smooth};
use coadjoint_codegen::step::{Energy, Invariants, Origin};
use coadjoint_codegen::system::{self, Options, Run, Splitting};
use coadjoint_learn::{GroupChoice, ModelFile};
use coadjoint_program::Trajectories;

use crate::backend::Backend;
use crate::engine::{
    Charted, Compiled, Damped, Damper, Equations, Kept, Motion, Source, Varied, collocated,
    product_group, whole_group,
};
use crate::error::RunError;
use crate::grid::Grid;
use crate::inputs;
use crate::simulate::Schedule;

/// A system as its file has it, its Hamiltonian a polynomial or another smooth function.
pub type System = system::System<Hamiltonian>;

/// Reads the text of a system file where the parameters with these names vary; `name` is what mistakes call it.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_varying(
    name: &str,
    text: &str,
    options: Options,
    varied: &[String],
) -> Result<System, RunError> {
    read_given(name, text, options, varied, &Functions::default())
}

/// The same of a text parts of which are given.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_given(
    name: &str,
    text: &str,
    options: Options,
    varied: &[String],
    given: &Functions,
) -> Result<System, RunError> {
    let read = system::read_given(text, options, varied, given);
    let mut read = read.map_err(|mistakes| RunError::Input(mistakes.render(name, text)))?;
    inputs::fill(Path::new(name), &mut read)?;
    Ok(read)
}

/// A system with the polynomial that its Hamiltonian is. Where it is none, `lacking` says what there is not, and `advice` what
/// there is instead.
///
/// # Errors
/// Where it is none.
pub fn polynomial(
    path: &Path,
    system: System,
    lacking: &str,
    advice: &str,
) -> Result<system::System, RunError> {
    let System { problem, potential, damping, run, units, parameters } = system;
    match problem {
        Hamiltonian::Polynomial(problem, _) => {
            let problem = *problem;
            Ok(system::System { problem, potential, damping, run, units, parameters })
        }
        Hamiltonian::Smooth(smooth) => Err(not_of_series(path, &smooth, lacking, advice)),
    }
}

/// The error of a system without series where `lacking`, which is made from one, is asked for.
pub(crate) fn not_of_series(path: &Path, smooth: &Smooth, lacking: &str, advice: &str) -> RunError {
    let nodes = smooth.nodes();
    RunError::Option(format!(
        "{}: {lacking}: the steps of this system are made by collocation, of order {} from ∂H/∂μ at {nodes} nodes, and not by \
         the series of a polynomial; {advice}",
        path.display(),
        2 * nodes,
    ))
}

/// Reads the group of a system file alone; `name` is what mistakes call it.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_group(name: &str, text: &str) -> Result<GroupChoice, RunError> {
    let algebra = system::read_group(text);
    let algebra = algebra.map_err(|mistakes| RunError::Input(mistakes.render(name, text)))?;
    Ok(GroupChoice::of(&algebra))
}

/// A learned polynomial as a system: steps of the model's own size are the learned map.
///
/// # Errors
/// Where the model is no polynomial.
pub fn learned(model: &ModelFile) -> Result<System, RunError> {
    let run = Run { step: Some(model.step), ..Run::default() };
    let (problem, units) = (coadjoint_learn::problem(model, "learned")?, system::Units::default());
    let (potential, damping, parameters) = (None, None, Vec::new());
    Ok(system::System { problem, potential, damping, run, units, parameters }.into())
}

/// Derives and lowers a problem.
///
/// # Errors
/// Where the series cannot be derived, or is too large.
pub(crate) fn integrator(path: &Path, problem: Problem) -> Result<Integrator, RunError> {
    Integrator::build(problem, TermLimit::default()).map_err(RunError::of(path))
}

/// A flow with the kicks of a potential, if there is one, which `kicked` composes it with.
///
/// # Errors
/// Where the potential has other parameters than the flow.
fn with_kicks<T>(
    flow: T,
    potential: Option<(Potential, Splitting)>,
    kicked: fn(T, Kick, Splitting) -> Option<T>,
) -> Result<T, RunError> {
    let Some((potential, splitting)) = potential else { return Ok(flow) };
    kicked(flow, Kick::build(potential), splitting).ok_or_else(|| {
        RunError::Option("the potential has other parameters than the Hamiltonian".to_owned())
    })
}

/// A system whose steps can be made.
#[derive(Debug)]
pub struct Derived {
    /// The name of the system in messages.
    pub(crate) file: PathBuf,
    /// The means by which they are made.
    pub(crate) flow: Flow,
    /// The damping before and after each, where there is any.
    pub(crate) damping: Option<Damper>,
    /// The conserved quantities.
    pub(crate) invariants: Invariants,
    /// The reason for which the series of a polynomial gave way to collocation, where it did.
    gave_way: Option<DeriveError>,
}

/// The means by which the steps of a system are made.
#[derive(Debug)]
pub(crate) enum Flow {
    /// The series of a polynomial, as programs, with kicks between flows if there are any.
    Series(Box<Expansion>),
    /// Collocation on a group, with kicks between flows if there are any, and the programs compiled so far.
    Collocation(Box<Smooth>, Arc<DirectProduct<MatrixGroup>>, Kept),
}

/// The series of a polynomial as programs, with the kicks of a potential between flows if there are any.
#[derive(Debug)]
pub struct Expansion {
    /// The flow and the kicks.
    pub integrator: Integrator,
    /// The group with the chart of the steps.
    group: Charted,
    /// The programs compiled so far.
    kept: Kept,
}

impl Expansion {
    /// The equations, for these values of the parameters.
    fn equations(&self, parameters: Vec<f64>) -> Equations<'_> {
        Equations { integrator: &self.integrator, parameters }
    }
}

impl Derived {
    /// Prepares a system, which is called by its name in messages.
    ///
    /// # Errors
    /// Where the series of a polynomial cannot be derived, or is too large, or the data defines no group.
    pub fn of(system: System) -> Result<Self, RunError> {
        let file = PathBuf::from(system.problem.facts().name);
        Self::of_file(&file, system)
    }

    /// The same, called by the name of a file in messages.
    ///
    /// # Errors
    /// As [`Derived::of`].
    pub fn of_file(file: &Path, system: System) -> Result<Self, RunError> {
        let System { problem, potential, damping, .. } = system;
        let (problem, gave_way) = problem.settled();
        let kicks = potential.as_ref().map(|(kicks, _)| kicks);
        let invariants = Invariants::new(problem.facts().algebra, Energy::new(&problem), kicks);
        // Kicks look at the matrices of the whole group; a flow alone goes factor by factor.
        let group = match &potential {
            Some(_) => whole_group(file, problem.facts().algebra)?,
            None => product_group(file, problem.facts().algebra)?,
        };
        let kept = Kept::default();
        let flow = match problem {
            Hamiltonian::Polynomial(problem, _) => {
                let flow = integrator(file, *problem)?;
                let integrator = with_kicks(flow, potential, Integrator::with_kicks)?;
                let group = Charted::new(file, group, integrator.problem.chart)?;
                Flow::Series(Box::new(Expansion { integrator, group, kept }))
            }
            Hamiltonian::Smooth(smooth) => {
                let smooth = with_kicks(*smooth, potential, Smooth::with_kicks)?;
                Flow::Collocation(Box::new(smooth), Arc::new(group), kept)
            }
        };
        let mut derived = Self { file: file.to_owned(), flow, damping: None, invariants, gave_way };
        if let Some(rates) = damping {
            derived.damping = Some(Damper { rates, group: Arc::new(derived.group()?) });
        }
        Ok(derived)
    }

    /// The inputs u(t).
    pub fn signals(&self) -> &[Signal] {
        match &self.flow {
            Flow::Series(_) => {
                let torque = self.kicks().and_then(Kicks::torque);
                torque.map_or(&[], |torque| &torque.signals)
            }
            Flow::Collocation(smooth, ..) => &smooth.signals,
        }
    }

    /// Checks that all inputs have a value from the start of a run to its end.
    ///
    /// # Errors
    /// The first that has not.
    pub fn reaches(&self, schedule: &Schedule) -> Result<(), RunError> {
        inputs::reach(&self.file, self.signals(), [schedule.start, schedule.end])
    }

    /// A note that the series gave way to collocation, with the reason and how to ask for it.
    pub fn gave_way(&self) -> Option<String> {
        self.gave_way.as_ref().map(DeriveError::gave_way)
    }

    /// The facts of the system.
    pub fn facts(&self) -> Facts<'_> {
        match &self.flow {
            Flow::Series(series) => series.integrator.problem.facts(),
            Flow::Collocation(smooth, ..) => smooth.facts(),
        }
    }

    /// The series, where steps are made by it.
    pub fn series(&self) -> Option<&Expansion> {
        match &self.flow {
            Flow::Series(series) => Some(series),
            Flow::Collocation(..) => None,
        }
    }

    /// Whether damping acts before and after each step.
    pub fn is_damped(&self) -> bool {
        self.damping.is_some()
    }

    /// The flows by collocation between kicks, where there are kicks, as a system without them.
    pub(crate) fn without_kicks(&self) -> Option<Self> {
        let Flow::Collocation(smooth, group, _) = &self.flow else { return None };
        smooth.kicks.as_ref()?;
        let smooth = Smooth { kicks: None, ..(**smooth).clone() };
        let flow = Flow::Collocation(Box::new(smooth), group.clone(), Kept::default());
        Some(Self {
            flow,
            damping: None,
            file: self.file.clone(),
            invariants: Invariants::default(),
            gave_way: None,
        })
    }

    /// The kicks between flows, where there are any.
    pub fn kicks(&self) -> Option<&Kicks> {
        match &self.flow {
            Flow::Series(series) => series.integrator.kicks.as_ref(),
            Flow::Collocation(smooth, ..) => smooth.kicks.as_ref(),
        }
    }

    /// True if the equations depend on the time other than through the state.
    pub(crate) fn moves(&self) -> bool {
        let flow = match &self.flow {
            Flow::Series(_) => false,
            Flow::Collocation(smooth, ..) => smooth.depends_on_time(),
        };
        flow || self.kicks().is_some_and(Kicks::moves)
    }

    /// Whether states move by programs alone, so that many may move side by side.
    pub(crate) fn alike(&self) -> bool {
        let calls = matches!(&self.flow, Flow::Collocation(smooth, ..) if smooth.given.is_some());
        self.damping.is_none() && !calls
    }

    /// The group that the equations are on.
    ///
    /// # Errors
    /// Where the data defines no group.
    pub(crate) fn group(&self) -> Result<DirectProduct<MatrixGroup>, RunError> {
        let algebra = self.facts().algebra;
        match self.kicks() {
            Some(_) => whole_group(&self.file, algebra),
            None => product_group(&self.file, algebra),
        }
    }

    /// The programs of steps of this size, about `steps` of which are going to be made, where steps are made of programs.
    ///
    /// # Errors
    /// Where the step makes no sense, or the backend that the user named cannot be had.
    pub(crate) fn compiled(
        &self,
        step: f64,
        backend: Backend,
        steps: f64,
        trajectories: Trajectories,
    ) -> Result<Option<Arc<Compiled>>, RunError> {
        match &self.flow {
            Flow::Series(series) => {
                let Expansion { integrator, kept, .. } = &**series;
                let origin = Origin::Series(integrator);
                Compiled::new(origin, step, backend, steps, trajectories, kept)
            }
            Flow::Collocation(smooth, ..) if smooth.given.is_some() => match backend {
                Backend::Auto | Backend::Interpreter => Ok(None),
                _ => Err(RunError::Option(format!(
                    "{}: no compiled --backend: the Hamiltonian is a function that is called; leave it out",
                    self.file.display()
                ))),
            },
            Flow::Collocation(smooth, _, kept) => {
                let origin = Origin::Collocation(smooth);
                Compiled::new(origin, step, backend, steps, trajectories, kept)
            }
        }
    }

    /// Makes the programs of steps, where there are any: most of the work before the first step.
    pub fn prepare(&self) {
        let kept = match &self.flow {
            Flow::Series(series) => &series.kept,
            Flow::Collocation(_, _, kept) => kept,
        };
        // A step without programs is made without them.
        self.origin().map(|origin| kept.programs(origin).is_ok());
    }

    /// What the programs of steps are made from, where they are.
    pub(crate) fn origin(&self) -> Option<Origin<'_>> {
        match &self.flow {
            Flow::Series(series) => Some(Origin::Series(&series.integrator)),
            Flow::Collocation(smooth, ..) => {
                smooth.given.is_none().then_some(Origin::Collocation(smooth))
            }
        }
    }

    /// Steps of this grid with the parameters as the file has them, by the programs that were made for their size, if any.
    ///
    /// # Errors
    /// Where the step or the parameters make no sense.
    pub(crate) fn steps(
        &self,
        grid: Grid,
        compiled: Option<&Arc<Compiled>>,
    ) -> Result<Box<dyn Varied + '_>, StepError> {
        let parameters = self.facts().defaults();
        let motion = match &self.flow {
            Flow::Series(series) => {
                let equations = series.equations(parameters.clone());
                series.group.steps(equations, grid, compiled.cloned())
            }
            Flow::Collocation(smooth, group, _) => {
                collocated(smooth, group, grid, &parameters, compiled)?
            }
        };
        Ok(self.damped(motion, &parameters))
    }

    /// These steps, with damping before and after each where there is any.
    fn damped<'a>(
        &'a self,
        motion: Box<dyn Varied + 'a>,
        parameters: &[f64],
    ) -> Box<dyn Varied + 'a> {
        let Some(damper) = &self.damping else { return motion };
        let energy = match &self.flow {
            Flow::Series(series) => Source::Polynomial(&series.integrator.problem),
            Flow::Collocation(smooth, ..) => Source::Smooth(smooth),
        };
        let kick = self.kicks().map(|kicks| &kicks.kick);
        Box::new(Damped::new(motion, damper, (energy, kick), parameters))
    }

    /// Steps for another grid or other values of the parameters that are kept, by the programs that are compiled.
    ///
    /// # Errors
    /// As [`Derived::steps`].
    pub(crate) fn varied(
        &self,
        grid: Grid,
        parameters: &[f64],
        compiled: Option<&Arc<Compiled>>,
    ) -> Result<Box<dyn Motion + '_>, StepError> {
        let motion = match &self.flow {
            Flow::Series(series) => {
                series.group.anew(series.equations(parameters.to_vec()), grid, compiled)?
            }
            Flow::Collocation(smooth, group, _) => {
                collocated(smooth, group, grid, parameters, compiled)?
            }
        };
        Ok(self.damped(motion, parameters))
    }

    /// The order of accuracy: K + 1, or that of the splitting where it is lower; 2 with damping.
    pub(crate) fn order(&self) -> u32 {
        if self.damping.is_some() {
            return 2;
        }
        let order = self.facts().truncation as u32 + 1;
        self.kicks().map_or(order, |kicks| order.min(kicks.splitting.order()))
    }

    /// The power of the step that errors follow: the order, or, with inputs by tables, at most 4, since the third derivatives of
    /// their splines jump inside of steps.
    pub(crate) fn power(&self) -> u32 {
        let knots = if self.signals().is_empty() { u32::MAX } else { 4 };
        self.order().min(knots)
    }

    /// The method of a run, in a few words.
    pub fn label(&self) -> String {
        let mut label = match &self.flow {
            Flow::Series(series) => {
                let problem = &series.integrator.problem;
                let mut label = format!("K = {}, {}", problem.truncation, problem.chart);
                if problem.comoving.is_some() {
                    label.push_str(", comoving");
                }
                label
            }
            Flow::Collocation(smooth, ..) => format!("collocation, {} nodes", smooth.nodes()),
        };
        if let Some(kicks) = self.kicks() {
            label = format!("{label}, {}", kicks.splitting.name());
        }
        if self.damping.is_some() {
            label.push_str(", damped");
        }
        label
    }
}
