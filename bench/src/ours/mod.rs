//! Our methods, as users write them.

/// The integrator of a step size and parameters, with the coefficients asked for. The code that fits them
/// is there only where rows want it: see [`FITTINGS`].
macro_rules! integrator {
    ($fits:ident, $body:ident($h:expr, $($argument:expr),*), $coefficients:expr, $momentum:expr) => {{
        let failed = |_| RunError::NotConverged;
        let series = |h| $body::new(h, $($argument),*);
        match $coefficients {
            Coefficients::Series => series($h).map_err(failed)?,
            Coefficients::Tuned => {
                $body::tuned($h, $($argument,)* [$momentum]).map_err(failed)?
            }
            Coefficients::Fitted(duration) => integrator!($fits, $h, series, $momentum, duration),
        }
    }};
    (fitted, $h:expr, $series:expr, $momentum:expr, $duration:expr) => {{
        let fitted = coadjoint::tune::fit($h, $series, [$momentum], $duration);
        fitted.map_err(|_| RunError::NotConverged)?.integrator
    }};
    (plain, $h:expr, $series:expr, $momentum:expr, $duration:expr) => {{
        let _: f64 = $duration;
        return Err(RunError::NotFitted);
    }};
}

pub(crate) mod free_body;
mod moving_body;

use crate::{
    method::{Method, RunError, Setting, step_sweep_about},
    problem::{Problem, System},
    state::State,
};

/// Every row of ours.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    let mut methods = free_body::all();
    methods.extend(moving_body::all());
    methods
}

/// Generated integrators of one truncation.
trait Run {
    /// Whether there is one for such a system.
    fn applies(&self, system: &System) -> bool;

    /// By what factor its steps are longer than those of other methods.
    fn pace(&self, system: &System) -> f64 {
        let _ = system;
        1.0
    }

    /// Integrates by equal steps of about `step`; `None` where there is no integrator for the system.
    fn run(
        &self,
        problem: &Problem,
        step: f64,
        coefficients: Coefficients,
    ) -> Option<Result<State, RunError>>;
}

/// Where the coefficients of S come from. Their making counts as work in every row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Coefficients {
    /// The series as it is.
    Series,
    /// Its tail summed for the motion.
    Tuned,
    /// Fitted to the motion, followed for so long.
    Fitted(f64),
}

/// Rows with fitted coefficients.
struct Fitting {
    group: &'static str,
    /// Up to this truncation; beyond, a fit takes longer than the whole motion.
    highest: u32,
    /// How long motions are followed, in the problem's unit of time: those on curves once around,
    /// those on larger tori longer.
    followed: f64,
}

const FITTINGS: [Fitting; 3] = [
    Fitting { group: "SO(3)", highest: 11, followed: 8.0 },
    Fitting { group: "SO(3), comoving", highest: 9, followed: 16.0 },
    Fitting { group: "SE(3)", highest: 7, followed: 64.0 },
];

/// The kinds of rows.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Series,
    Tuned,
    /// Followed for so many units of time.
    Fitted(f64),
}

/// A truncation as a row.
struct Ours<R> {
    name: String,
    truncation: u32,
    kind: Kind,
    runs: R,
}

/// The rows of a truncation: the series as it is, with its tail summed, and fitted.
fn rows<R: Run + Copy + 'static>(
    truncation: u32,
    group: &str,
    runs: R,
) -> impl Iterator<Item = Box<dyn Method>> {
    let plain = format!("coadjoint, {group}, K = {truncation}");
    let tuned = (format!("{plain}, tuned"), Kind::Tuned);
    let fitting = FITTINGS.iter().find(|row| row.group == group && truncation <= row.highest);
    let fitted = fitting.map(|row| (format!("{plain}, fitted"), Kind::Fitted(row.followed)));
    [(plain, Kind::Series), tuned]
        .into_iter()
        .chain(fitted)
        .map(move |(name, kind)| Box::new(Ours { name, truncation, kind, runs }) as Box<dyn Method>)
}

impl<R: Run> Method for Ours<R> {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "coadjoint"
    }

    /// Tuned, the term of order K + 1 is small beside the next, and no order is measured cleanly;
    /// fitted, there is none.
    fn order(&self) -> Option<u32> {
        (self.kind == Kind::Series).then_some(self.truncation + 1)
    }

    fn applies(&self, problem: &Problem) -> bool {
        self.runs.applies(&problem.system)
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep_about(self.runs.pace(&problem.system) * problem.time_scale)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(&self.name)?;
        let coefficients = match self.kind {
            Kind::Series => Coefficients::Series,
            Kind::Tuned => Coefficients::Tuned,
            Kind::Fitted(followed) => Coefficients::Fitted(followed * problem.time_scale),
        };
        self.runs.run(problem, step, coefficients).unwrap_or_else(|| {
            Err(RunError::NotApplicable {
                method: self.name.clone(),
                problem: problem.name.to_owned(),
            })
        })
    }
}
