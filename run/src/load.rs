//! From the text of a system to what steps are made of.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use coadjoint::StepError;
use coadjoint_codegen::drive::Drive;
use coadjoint_codegen::hamilton_jacobi::{DeriveError, TermLimit};
use coadjoint_codegen::integrator::{Integrator, Kick, Kicks};
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::smooth::{Facts, Functions, Hamiltonian};
use coadjoint_codegen::step::{Invariants, Origin};
use coadjoint_codegen::system::{self, Options, Run};
use coadjoint_learn::{GroupChoice, ModelFile};
use coadjoint_program::Trajectories;

use crate::backend::Backend;
use crate::engine::{Charted, Compiled, Kept, Motion, group_of};
use crate::error::RunError;
use crate::grid::Grid;
use crate::inputs;
use crate::simulate::{Block, Schedule};

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

/// Reads a text of which some parts are given.
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
/// Fails if it is none.
pub fn polynomial(
    path: &Path,
    system: System,
    lacking: &str,
    advice: &str,
) -> Result<system::System, RunError> {
    let System { problem, potential, run, units, parameters } = system;
    let problem = problem.into_polynomial().map_err(|smooth| {
        let nodes = smooth.nodes();
        RunError::Option(format!(
            "{}: {lacking}: the steps of this system are made by collocation, of order {} from ∂H/∂μ at {nodes} nodes, and not \
             by the series of a polynomial; {advice}",
            path.display(),
            2 * nodes,
        ))
    })?;
    Ok(system::System { problem, potential, run, units, parameters })
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
/// Fails if the model is no polynomial.
pub fn learned(model: &ModelFile) -> Result<System, RunError> {
    let run = Run { step: Some(model.step), ..Run::default() };
    let (problem, units) = (coadjoint_learn::problem(model, "learned")?, system::Units::default());
    let (potential, parameters) = (None, Vec::new());
    Ok(system::System { problem, potential, run, units, parameters }.into())
}

/// Derives and lowers a problem.
///
/// # Errors
/// Fails if the series cannot be derived, or is too large.
pub(crate) fn integrator(path: &Path, problem: Problem) -> Result<Integrator, RunError> {
    Integrator::build(problem, TermLimit::default()).map_err(RunError::of(path))
}

/// A system with its method: derived, where steps are made by a series.
///
/// # Errors
/// Where the series cannot be derived, or is too large.
pub(crate) fn derive(path: &Path, hamiltonian: Hamiltonian) -> Result<Origin, RunError> {
    Origin::derive(hamiltonian, TermLimit::default()).map_err(RunError::of(path))
}

/// A system whose steps can be made.
#[derive(Debug)]
pub struct Derived {
    /// The name of the system in messages.
    pub(crate) file: PathBuf,
    /// The equations, with the method by which steps are made.
    pub(crate) origin: Arc<Origin>,
    /// The values of the parameters that are kept.
    pub(crate) values: Vec<f64>,
    /// The group that the equations are on.
    pub(crate) group: Charted,
    /// The programs compiled so far.
    kept: Arc<Kept>,
    /// The conserved quantities.
    pub(crate) invariants: Invariants,
    /// The blocks of the group's matrices, once a run asked for them.
    pub(crate) blocks: OnceLock<Vec<Block>>,
    /// The reason for which the series of a polynomial gave way to collocation, where it did.
    gave_way: Option<DeriveError>,
}

impl Derived {
    /// Prepares a system, which is called by its name in messages.
    ///
    /// # Errors
    /// Fails if the series of a polynomial cannot be derived, or is too large, or the data defines no group.
    pub fn of(system: System) -> Result<Self, RunError> {
        let file = PathBuf::from(system.problem.facts().name);
        Self::of_file(&file, system)
    }

    /// As [`Derived::of`], called by the name of a file in messages.
    ///
    /// # Errors
    /// As [`Derived::of`].
    pub fn of_file(file: &Path, system: System) -> Result<Self, RunError> {
        let System { problem, potential, .. } = system;
        let (problem, gave_way) = problem.settled();
        // Kicks, and a drive that reads the group element, look at the matrices of the whole group; a flow alone goes factor by factor.
        let drive = problem.smooth().and_then(|smooth| smooth.drive.as_ref());
        let whole = potential.is_some() || drive.is_some_and(|drive| drive.reads_element());
        let group = group_of(file, problem.facts().algebra, whole)?;
        let mut origin = derive(file, problem)?;
        if let Some((potential, splitting)) = potential {
            let kicked = origin.with_kicks(Kick::build(potential), splitting);
            origin = kicked.ok_or_else(|| {
                let what = "the potential has other parameters than the Hamiltonian";
                RunError::Option(what.to_owned())
            })?;
        }
        let chart = origin.series().map_or(lie::Chart::Exponential, |series| series.problem.chart);
        let group = Charted::new(file, group, chart)?;
        let values = origin.facts().defaults();
        let invariants = Invariants::of_system(&origin, &values);
        let (kept, blocks) = Default::default();
        let (file, origin) = (file.to_owned(), Arc::new(origin));
        Ok(Self { file, origin, values, group, kept, invariants, blocks, gave_way })
    }

    /// The inputs u(t).
    pub fn signals(&self) -> &[Signal] {
        self.origin.signals()
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
        self.origin.facts()
    }

    /// The series, where steps are made by it.
    pub fn series(&self) -> Option<&Integrator> {
        self.origin.series()
    }

    /// The velocity and the torque beside the Hamiltonian, where there are any.
    pub fn drive(&self) -> Option<&Drive> {
        self.origin.drive()
    }

    /// The flows between kicks, where there are kicks, as a system without them.
    pub(crate) fn without_kicks(&self) -> Option<Self> {
        let invariants = Invariants::of(self.facts().algebra);
        Some(Self { invariants, ..self.with(self.origin.without_kicks()?) })
    }

    /// This system without the velocity of its drive, where it has one.
    pub(crate) fn without_velocity(&self) -> Option<Self> {
        Some(self.with(self.origin.without_velocity()?))
    }

    /// This system with these inputs in place of its own.
    pub(crate) fn with_signals(&self, signals: Vec<Signal>) -> Self {
        self.with(self.origin.with_signals(signals))
    }

    /// This system with these values of the parameters that are kept: nothing is derived or compiled anew.
    pub(crate) fn at(&self, values: &[f64]) -> Self {
        Self {
            values: values.to_vec(),
            kept: self.kept.clone(),
            invariants: Invariants::of_system(&self.origin, values),
            gave_way: self.gave_way.clone(),
            ..self.with(self.origin.clone())
        }
    }

    /// Other equations on the same group, with the same conserved quantities.
    fn with(&self, origin: impl Into<Arc<Origin>>) -> Self {
        Self {
            origin: origin.into(),
            values: self.values.clone(),
            group: self.group.clone(),
            kept: Arc::default(),
            file: self.file.clone(),
            invariants: self.invariants.clone(),
            blocks: OnceLock::new(),
            gave_way: None,
        }
    }

    /// The kicks between flows, where there are any.
    pub fn kicks(&self) -> Option<&Kicks> {
        self.origin.kicks()
    }

    /// True if the equations depend on the time other than through the state.
    pub(crate) fn moves(&self) -> bool {
        self.origin.depends_on_time()
    }

    /// True if states move by programs alone, so that many may move side by side.
    pub(crate) fn alike(&self) -> bool {
        !self.origin.is_function()
    }

    /// The programs of steps of this size, about `steps` of which are going to be made, where steps are made of programs.
    ///
    /// # Errors
    /// Fails if the step makes no sense, or the backend that the user named cannot be had.
    pub(crate) fn compiled(
        &self,
        step: f64,
        backend: Backend,
        steps: f64,
        trajectories: Trajectories,
    ) -> Result<Option<Arc<Compiled>>, RunError> {
        let Some(origin) = self.origin() else {
            return match backend {
                Backend::Auto | Backend::Interpreter => Ok(None),
                _ => Err(RunError::Option(format!(
                    "{}: no compiled --backend: the Hamiltonian is a function that is called; leave it out",
                    self.file.display()
                ))),
            };
        };
        let of = (step, &self.values[..]);
        Compiled::new(origin, of, backend, steps, trajectories, &self.kept)
    }

    /// Makes the programs of steps, where there are any: most of the work before the first step.
    pub fn prepare(&self) {
        // A step without programs is made without them.
        self.origin().map(|origin| self.kept.programs(origin).is_ok());
    }

    /// The system that the programs of steps are made from, where there are programs.
    pub(crate) fn origin(&self) -> Option<&Origin> {
        Some(&*self.origin).filter(|origin| !origin.is_function())
    }

    /// Steps of this grid with the parameters as the file has them, by the programs that were compiled, if any.
    ///
    /// # Errors
    /// Fails if the step or the parameters make no sense.
    pub(crate) fn steps(
        &self,
        grid: Grid,
        compiled: Option<&Arc<Compiled>>,
    ) -> Result<Motion<'_>, StepError> {
        self.with_parameters(grid, &self.values, compiled)
    }

    /// Steps of this grid for these values of the parameters that are kept.
    ///
    /// # Errors
    /// As [`Derived::steps`].
    pub(crate) fn with_parameters(
        &self,
        grid: Grid,
        parameters: &[f64],
        compiled: Option<&Arc<Compiled>>,
    ) -> Result<Motion<'_>, StepError> {
        self.group.steps(&self.origin, grid, parameters, compiled)
    }

    /// The order of accuracy: K + 1, or that of the splitting where it is lower.
    pub(crate) fn order(&self) -> u32 {
        self.origin.order()
    }

    /// The method of a run, in a few words.
    pub fn label(&self) -> String {
        self.origin.label()
    }
}
