//! From the text of a system to what steps are made of.

use std::path::{Path, PathBuf};

use coadjoint::groups::{DirectProduct, MatrixGroup};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::in_other_frame;
use coadjoint_codegen::integrator::{Integrator, Kick};
use coadjoint_codegen::potential::Potential;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::step::Invariants;
use coadjoint_codegen::system::{self, Options, Run, Splitting, System};
use coadjoint_codegen::tolerance::{self, Choice, Region, Target};
use coadjoint_learn::{GroupChoice, ModelFile};

use crate::engine::{Charted, Equations, Forces, Kept, defaults, product_group, whole_group};
use crate::error::RunError;

/// Reads the text of a system file as it stands; `name` is what mistakes call it.
///
/// # Errors
/// All mistakes, rendered.
pub fn read(name: &str, text: &str) -> Result<System, RunError> {
    read_with(name, text, Options::default())
}

/// Reads the text of a system file whose Hamiltonian need not be a polynomial.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_either(
    name: &str,
    text: &str,
    options: Options,
) -> Result<System<Hamiltonian>, RunError> {
    let read = system::read_either(text, options, &[]);
    read.map_err(|mistakes| RunError::Input(mistakes.render(name, text)))
}

/// Reads the text of a system file.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_with(name: &str, text: &str, options: Options) -> Result<System, RunError> {
    read_varying(name, text, options, &[])
}

/// The same where the parameters with these names vary.
///
/// # Errors
/// All mistakes, rendered.
pub fn read_varying(
    name: &str,
    text: &str,
    options: Options,
    varied: &[String],
) -> Result<System, RunError> {
    let read = system::read_varying(text, options, varied);
    let read = read.map_err(|mistakes| RunError::Input(mistakes.render(name, text)))?;
    if let (Some(parameter), true) = (varied.first(), read.potential.is_some()) {
        let what = "parameters of a system with a potential do not vary from row to row";
        return Err(RunError::Input(format!("{name}: column {parameter}: {what}")));
    }
    Ok(read)
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
    Ok(System { problem, potential: None, run, units, parameters: Vec::new() })
}

/// Derives and lowers a problem.
///
/// # Errors
/// Where the series cannot be derived, or is too large.
pub fn integrator(path: &Path, problem: Problem) -> Result<Integrator, RunError> {
    Integrator::build(problem, TermLimit::default()).map_err(RunError::of(path))
}

/// Derives and lowers a problem, with the kicks of a potential between flows.
///
/// # Errors
/// As [`integrator`].
pub fn with_kicks(
    path: &Path,
    problem: Problem,
    potential: Option<(Potential, Splitting)>,
) -> Result<Integrator, RunError> {
    let integrator = integrator(path, problem)?;
    let Some((potential, splitting)) = potential else { return Ok(integrator) };
    integrator.with_kicks(Kick::build(potential), splitting).ok_or_else(|| {
        RunError::Option("the potential has other parameters than the Hamiltonian".to_owned())
    })
}

/// A system with its series as programs.
#[derive(Debug)]
pub struct Derived {
    /// The name of the system in messages.
    pub file: PathBuf,
    /// The flow.
    pub integrator: Integrator,
    /// The conserved quantities.
    pub invariants: Invariants,
    /// The kicks of a potential.
    pub forces: Option<Forces>,
    /// The programs compiled so far.
    pub kept: Kept,
}

impl Derived {
    /// Derives the series of a system, which is called by its name in messages.
    ///
    /// # Errors
    /// Where the series cannot be derived, or is too large.
    pub fn of(system: System) -> Result<Self, RunError> {
        let file = PathBuf::from(&system.problem.name);
        Self::of_file(&file, system)
    }

    /// The same, called by the name of a file in messages.
    ///
    /// # Errors
    /// Where the series cannot be derived, or is too large.
    pub fn of_file(file: &Path, system: System) -> Result<Self, RunError> {
        let System { problem, potential, .. } = system;
        let invariants = Invariants::new(&problem, potential.as_ref().map(|(kicks, _)| kicks));
        let integrator = with_kicks(file, problem, potential.clone())?;
        let forces = potential.map(|(potential, splitting)| Forces::new(potential, splitting));
        Ok(Self { file: file.to_owned(), integrator, invariants, forces, kept: Kept::default() })
    }

    /// The group that the equations are on. Kicks look at the matrices of the whole group; a flow alone goes factor by
    /// factor.
    ///
    /// # Errors
    /// Where the data defines no group.
    pub fn group(&self) -> Result<DirectProduct<MatrixGroup>, RunError> {
        let algebra = &self.integrator.problem.algebra;
        match &self.forces {
            Some(_) => whole_group(&self.file, algebra),
            None => product_group(&self.file, algebra),
        }
    }

    /// The same with the chart of the steps.
    pub(crate) fn charted(&self) -> Result<Charted, RunError> {
        Charted::new(&self.file, self.group()?, self.integrator.problem.chart)
    }

    /// The equations, with the parameters as the file has them.
    pub(crate) fn equations(&self) -> Equations<'_> {
        let Self { integrator, forces, .. } = self;
        Equations { integrator, forces: forces.as_ref(), parameters: defaults(&integrator.problem) }
    }

    /// The order of accuracy: K + 1, or that of the splitting where it is lower.
    pub fn order(&self) -> u32 {
        let order = self.integrator.problem.truncation as u32 + 1;
        self.forces.as_ref().map_or(order, |forces| order.min(forces.splitting.order()))
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

/// Where a truncation is picked, series may become this large.
const AFFORDABLE: TermLimit = TermLimit { terms: 20_000, products: 2_000_000 };

/// The accuracy asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// The step size.
    pub step: Option<f64>,
    /// The error wanted at the end of the run.
    pub tolerance: Option<f64>,
    /// The norm of the momentum up to which the tolerance is to hold; along the run if not given.
    pub region: Option<f64>,
    /// K, where it is not to be picked.
    pub truncation: Option<usize>,
    /// The duration, where it is not that of the text.
    pub time: Option<f64>,
    /// Whether the frame is the comoving one, where it is not that of the text nor to be picked.
    pub comoving: Option<bool>,
}

/// Picks truncation, step and, where the system leaves the choice, frame where a tolerance is asked for, by the settings
/// or in the text, and puts them into the system; what was picked. Parameters that are kept have the values of the text for
/// that, in a frame that there is for all values.
///
/// # Errors
/// Where nothing can be picked.
pub fn meet_tolerance(
    path: &Path,
    System { problem, potential, run, .. }: &mut System,
    asked: &Accuracy,
) -> Result<Option<Choice>, RunError> {
    let other =
        in_other_frame(problem).filter(|other| asked.comoving == Some(other.comoving.is_some()));
    if let Some(other) = other {
        *problem = other;
    }
    let replaced = asked.tolerance.is_none() && asked.step.is_some();
    let Some(tolerance) = asked.tolerance.or(run.tolerance).filter(|_| !replaced) else {
        return Ok(None);
    };
    if potential.is_some() {
        return Err(RunError::Option(
            "a tolerance says nothing of the kicks of a potential: give the step instead".into(),
        ));
    }
    let duration = asked.time.or(run.time).ok_or_else(|| RunError::Missing {
        file: path.into(),
        key: "[run] time",
        example: "time = 100.0",
        option: "--time 100",
    })?;
    let target = Target {
        tolerance,
        duration,
        start: run.momentum.clone(),
        region: asked.region.map(Region::Ball).or_else(|| run.region.clone()),
        truncation: asked.truncation.or(run.truncation),
    };
    let choose = |problem: Problem| {
        let choice = tolerance::choose(&problem.with_defaults(), &target, AFFORDABLE);
        choice.map(|choice| (Problem { truncation: choice.truncation, ..problem }, choice))
    };
    // Of the frames that the system leaves the choice of, the one in which steps are cheaper.
    let found = match (choose(problem.clone()), in_other_frame(problem).map(choose)) {
        (Ok(one), Some(Ok(other))) if one.1.operations <= other.1.operations => Ok(one),
        (_, Some(Ok(other))) => Ok(other),
        (one, _) => one,
    };
    let (chosen, choice) = found.map_err(RunError::of(path))?;
    *problem = chosen;
    *run = Run { step: Some(choice.step), ..run.clone() };
    Ok(Some(choice))
}
