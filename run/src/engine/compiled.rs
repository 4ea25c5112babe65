//! Steps as straight-line programs: evaluated, or as machine code.

use std::array::from_fn;
use std::borrow::Cow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use coadjoint::StepError;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::step::{
    self, Convergence, DriftPrograms, Invariants, Observation, Origin, Step,
};
use coadjoint_program::fold::FoldError;
use coadjoint_program::{Kernel, Precision, Program, Trajectories, WIDTH};

use super::codes::{Codes, MOST_OPERATIONS, is_large, operations};
use super::varied::Varied;
use crate::backend::{Backend, Running};
use crate::error::RunError;
use crate::grid::Grid;
use crate::number::maximum;

/// Above this ratio of terms a run says so; above twice this its steps are refused.
pub const STEEP: f64 = 0.25;

/// The refusal of coefficients for a step size and symbols.
pub(super) fn refusal(error: FoldError, step: f64, symbols: &[f64]) -> StepError {
    match error {
        FoldError::Step => StepError::InvalidStep { step },
        FoldError::Symbol(i) => {
            let value = symbols[i];
            let name = if value.is_finite() { "of the damping" } else { "of the Hamiltonian" };
            StepError::InvalidParameter { name, value }
        }
        FoldError::Coefficient(value) => {
            StepError::InvalidParameter { name: "of the generating function", value }
        }
    }
}

/// The course of the solves of steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Solved {
    /// The most iterations of a step.
    pub iterations: u32,
    /// The largest residual.
    pub residual: f64,
    /// The steps that programs refused and the generic solver made.
    pub rescued: u64,
}

impl Solved {
    /// The solves of one step.
    pub(crate) fn one(iterations: u32, residual: f64) -> Self {
        Self { iterations, residual, rescued: 0 }
    }

    /// Both together.
    pub(crate) fn with(self, other: Self) -> Self {
        Self {
            iterations: self.iterations.max(other.iterations),
            residual: maximum(self.residual, other.residual),
            rescued: self.rescued + other.rescued,
        }
    }
}

/// The course of the solves of steps, where it is known.
pub(crate) type Solves = Option<Solved>;

/// A state as the programs have it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Numbers {
    /// The group element.
    pub g: Vec<f64>,
    /// μ.
    pub mu: Vec<f64>,
}

impl Numbers {
    /// g and μ.
    pub(crate) fn parts(&self) -> [&[f64]; 2] {
        [&self.g, &self.mu]
    }
}

/// The compiled programs of one integrator, for later runs: programs do not depend on the size of a step.
#[derive(Default)]
pub(crate) struct Kept {
    programs: OnceLock<Arc<Executable>>,
    codes: Codes,
}

/// The programs of one integrator.
#[derive(Debug)]
pub(crate) struct Executable {
    step: Step,
    observation: Observation,
    convergence: OnceLock<Convergence>,
    /// Those of derivatives that were asked for.
    varied: Mutex<Vec<Arc<Varied>>>,
}

impl Executable {
    fn build(origin: &Origin) -> Result<Arc<Self>, step::StepError> {
        let step = origin.step(Precision::Double)?;
        let observation = Observation::new(&step);
        let (convergence, varied) = Default::default();
        Ok(Arc::new(Self { step, observation, convergence, varied }))
    }
}

impl std::fmt::Debug for Kept {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Kept").finish_non_exhaustive()
    }
}

impl Kept {
    /// The programs of this origin; made, where they are not there yet.
    ///
    /// # Errors
    /// The reason for which there are none.
    pub(crate) fn programs(&self, origin: &Origin) -> Result<Arc<Executable>, step::StepError> {
        match self.programs.get() {
            Some(programs) => Ok(programs.clone()),
            None => Executable::build(origin)
                .map(|programs| self.programs.get_or_init(|| programs).clone()),
        }
    }
}

/// The numbers that the programs of a step read, for one size and one set of parameters.
#[derive(Clone, Debug)]
pub(crate) struct Folded {
    /// The size of a step.
    size: f64,
    /// The values of the parameters that are kept.
    parameters: Vec<f64>,
    /// The coefficients.
    slots: Vec<f64>,
    /// The |μ| up to which the ratio of the last two terms of the series is at most [`STEEP`]; 0 where it is not known.
    quiet: f64,
}

/// Steps as straight-line programs.
#[derive(Clone)]
pub(crate) struct Compiled {
    programs: Arc<Executable>,
    folded: Folded,
    code: Arc<Running>,
    /// True if a comoving frame moves: then each step is a block of its own, so that bits do not depend on how a run is
    /// cut into pieces.
    framed: bool,
    /// Inputs in place of those of the system.
    signals: Option<Arc<[Signal]>>,
}

impl std::fmt::Debug for Compiled {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Compiled").field("code", &self.code).finish_non_exhaustive()
    }
}

impl Compiled {
    /// Steps of this size for these values of the parameters, `steps` of which are going to be made, of these trajectories; `None` where they are not made of
    /// programs. What is kept of the same integrator is used again.
    ///
    /// # Errors
    /// Fails if the backend that the user named cannot be had.
    pub(crate) fn new(
        origin: &Origin,
        (size, parameters): (f64, &[f64]),
        backend: Backend,
        steps: f64,
        trajectories: Trajectories,
        kept: &Kept,
    ) -> Result<Option<Arc<Self>>, RunError> {
        let unfit = |why: &dyn std::fmt::Display| match backend {
            Backend::Auto | Backend::Interpreter => Ok(None),
            _ => Err(RunError::Option(format!("--backend: {why}"))),
        };
        let programs = match kept.programs(origin) {
            Ok(programs) => programs,
            Err(error) => return unfit(&error),
        };
        let step = &programs.step;
        if is_large(step.kernel()) && !matches!(backend, Backend::Auto | Backend::Interpreter) {
            let (operations, most) = (operations(step.kernel()), MOST_OPERATIONS);
            return unfit(&format_args!(
                "a step has {operations} operations, more than the {most} that are compiled; use the interpreter"
            ));
        }
        let folded = fold(step, size, parameters);
        let folded = folded.map_err(RunError::unmade)?;
        let framed = step.kernel().programs.frame.is_some();
        let code = kept.codes.code(step.kernel(), backend, steps, trajectories)?;
        let code = Arc::new(code);
        Ok(Some(Arc::new(Self { programs, folded, code, framed, signals: None })))
    }

    /// These steps with other inputs.
    pub(crate) fn with_signals(&self, signals: &[Signal]) -> Arc<Self> {
        Arc::new(Self { signals: Some(signals.into()), ..self.clone() })
    }

    /// Replaces the folded coefficients by those of another size or other parameters.
    pub(crate) fn with(&mut self, folded: Folded) {
        self.folded = folded;
    }

    /// True if these steps have this size and these values of the parameters.
    pub(super) fn is_for(&self, size: f64, parameters: &[f64]) -> bool {
        self.folded.size == size && self.folded.parameters == parameters
    }

    /// Lets the next step of a state know none before it.
    pub(super) fn forget(&self, state: &mut Numbers) {
        self.programs.step.forget(&mut state.g);
    }

    /// Marks the work of the torque as not known: the step to this state was made elsewhere.
    pub(super) fn lose_work(&self, state: &mut Numbers) {
        if let Some(at) = self.step().work_at() {
            state.g[at] = f64::NAN;
        }
    }

    /// The energy at both ends of a run, of these times, and the work of a torque between them; none where it is not known.
    pub(crate) fn work(&self, ends: [(f64, &Numbers); 2]) -> Option<[f64; 3]> {
        let at = self.step().work_at()?;
        let energy = |(time, state): (f64, &Numbers)| {
            let watched = self.kernel().watch(&self.coefficients_at(time), &state.g, &state.mu);
            watched.first().copied()
        };
        let [start, end] = ends;
        let work = [energy(start)?, energy(end)?, end.1.g[at] - start.1.g[at]];
        work.iter().all(|number| number.is_finite()).then_some(work)
    }

    /// The numbers of an element without those that steps leave to the next one.
    pub(crate) fn lasting<'a>(&self, g: &'a [f64]) -> &'a [f64] {
        &g[..g.len().saturating_sub(self.step().memory())]
    }

    /// These steps with another size or other values of the parameters.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(crate) fn anew(
        self: &Arc<Self>,
        size: f64,
        parameters: &[f64],
    ) -> Result<Arc<Self>, StepError> {
        if self.is_for(size, parameters) {
            return Ok(self.clone());
        }
        let folded = self.fold(size, parameters)?;
        Ok(Arc::new(Self { folded, ..(**self).clone() }))
    }

    /// Folds the coefficients for another size or other values of the parameters.
    ///
    /// # Errors
    /// Fails if a coefficient is not finite.
    pub(crate) fn fold(&self, size: f64, parameters: &[f64]) -> Result<Folded, StepError> {
        fold(&self.programs.step, size, parameters)
    }

    /// Folds for at most [`WIDTH`] rows of parameter values, side by side.
    pub(crate) fn fold_rows(
        &self,
        size: f64,
        parameters: &[Vec<f64>],
    ) -> Vec<Result<Folded, StepError>> {
        // Kicks have a list of coefficients for each flow.
        if self.kernel().flows().is_some() {
            return parameters.iter().map(|own| self.fold(size, own)).collect();
        }
        let step = &self.programs.step;
        // Lanes without a row have the numbers of the first one.
        let of = |lane: usize| parameters.get(lane).or_else(|| parameters.first());
        let count = parameters.first().map_or(0, Vec::len);
        let beside = |i: usize| from_fn(|lane| of(lane).map_or(f64::NAN, |own| own[i]));
        let beside: Vec<[f64; WIDTH]> = (0..count).map(beside).collect();
        match step.fold_rows(size, &step.symbols_of_rows(&beside), STEEP) {
            Ok((slots, quiet)) => {
                let own = |lane: usize| Folded {
                    size,
                    parameters: parameters[lane].clone(),
                    slots: slots.iter().map(|slot| slot[lane]).collect(),
                    quiet: quiet[lane],
                };
                (0..parameters.len()).map(|lane| Ok(own(lane))).collect()
            }
            // Of one row, perhaps.
            Err(_) => parameters.iter().map(|own| self.fold(size, own)).collect(),
        }
    }

    /// True if the ratio of the last two terms of the series is known to be at most [`STEEP`] at these momenta, side by side.
    pub(super) fn is_quiet(&self, momenta: &[f64], lanes: usize) -> bool {
        let square =
            |lane: usize| momenta[lane..].iter().step_by(lanes).map(|mu| mu * mu).sum::<f64>();
        (0..lanes).all(|lane| square(lane).sqrt() <= self.folded.quiet)
    }

    fn coefficients(&self) -> &[f64] {
        &self.folded.slots
    }

    /// The backend that makes the steps.
    pub(crate) fn code(&self) -> &Running {
        &self.code
    }

    /// The backend that makes the steps now, in a few words.
    pub(crate) fn maker(this: Option<&Self>) -> String {
        this.map_or("interpreter", |compiled| compiled.code().maker()).to_owned()
    }

    /// The programs.
    pub(crate) fn kernel(&self) -> &Kernel {
        self.programs.step.kernel()
    }

    /// The programs of the ratios by which steps of this series are judged.
    pub(super) fn convergence(&self, integrator: &Integrator) -> &Convergence {
        self.programs.convergence.get_or_init(|| Convergence::new(integrator))
    }

    /// The step.
    pub(super) fn step(&self) -> &Step {
        &self.programs.step
    }

    /// The size of a step, and the values of the parameters that are kept.
    pub(super) fn values(&self) -> (f64, &[f64]) {
        (self.folded.size, &self.folded.parameters)
    }

    /// The programs of derivatives that fit, known ones or, where they can be made, new ones.
    pub(super) fn varied(
        &self,
        fits: impl Fn(&Varied) -> bool,
        make: impl FnOnce() -> Option<Varied>,
    ) -> Option<Arc<Varied>> {
        // A thread that panicked has left whole programs, if any.
        let mut known = self.programs.varied.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = known.iter().find(|own| fits(own)) {
            return Some(own.clone());
        }
        let own = Arc::new(make()?);
        known.push(own.clone());
        Some(own)
    }

    /// Puts the times of the step from this time among its coefficients.
    fn set_time(&self, slots: &mut [f64], time: f64) {
        self.step().set_time_by(self.signals.as_deref(), slots, [self.folded.size, time]);
    }

    /// The coefficients of the step from this time.
    pub(super) fn coefficients_at(&self, time: f64) -> Cow<'_, [f64]> {
        let mut slots = Cow::Borrowed(self.coefficients());
        if self.step().moves() {
            self.set_time(slots.to_mut(), time);
        }
        slots
    }

    /// The spatial momentum Ad\*_g μ and the matrix of g of each state, one after the other.
    pub(super) fn observe(&self, states: &[[&[f64]; 2]]) -> Vec<f64> {
        self.programs.observation.of(states)
    }

    /// Makes `steps` steps after the first ones, which began at the time `start`. A step that the programs refuse is made by `rescue`,
    /// which is given the number of steps before it, and returns its iterations and residual or says why there is no step.
    ///
    /// # Errors
    /// Returns the number of steps made and the error of the next one; the state is then the one before it.
    pub(crate) fn advance(
        &self,
        numbers: &mut Numbers,
        start: f64,
        [first, steps]: [u64; 2],
        mut rescue: impl FnMut(&mut Numbers, u64) -> Result<Solves, StepError>,
    ) -> Result<Solved, (u64, StepError)> {
        let (mut total, mut done) = (Solved::default(), 0);
        let (moves, mut slots) = (self.programs.step.moves(), Cow::Borrowed(self.coefficients()));
        while done < steps {
            let asked = (steps - done).min(self.code().at_a_time());
            let asked = if self.framed || moves { 1 } else { asked };
            let number = first + done;
            if moves {
                let grid = Grid { start, step: self.folded.size };
                self.set_time(slots.to_mut(), grid.time(number));
            }
            let Numbers { g, mu } = numbers;
            let made = self.code().stepper(self.kernel()).advance(&slots, g, mu, asked);
            done += made.steps;
            total = total.with(Solved::one(made.corrections, made.residual));
            if made.steps < asked {
                let solves = rescue(numbers, first + done).map_err(|error| (done, error))?;
                total = total.with(Solved { rescued: 1, ..solves.unwrap_or_default() });
                done += 1;
            }
        }
        Ok(total)
    }

    /// Makes one step from this time, whatever steps came before; whether the programs accept it. The state is else as it was.
    pub(crate) fn one_at(&self, numbers: &mut Numbers, time: f64) -> bool {
        let slots = self.coefficients_at(time);
        let mut alone = numbers.clone();
        self.forget(&mut alone);
        let Numbers { g, mu } = &mut alone;
        let made = self.code().stepper(self.kernel()).advance(&slots, g, mu, 1).steps == 1;
        if made {
            *numbers = alone;
        }
        made
    }

    /// The numbers of the element with this matrix, row by row.
    pub(crate) fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        self.programs.step.element_of(matrix)
    }

    /// The matrix of an element, row by row.
    pub(crate) fn matrix_of(&self, g: &[f64]) -> Vec<f64> {
        self.kernel().programs.matrix.run(g, &[])
    }

    /// The numbers of an element, rounded in single precision, ↦ those of it put onto the group.
    pub(crate) fn settled(&self) -> Program {
        self.programs.step.settled()
    }

    /// The drifts of what is conserved, between states side by side.
    pub(super) fn drifts(&self, invariants: &Invariants) -> DriftPrograms {
        DriftPrograms::new(invariants, Some(&self.programs.step), self.kernel().element)
    }

    /// Makes steps, after the first ones, which began at the time `start`, of [`WIDTH`] trajectories side by side, as
    /// [`Stepper::advance_lanes`](coadjoint_program::Stepper::advance_lanes).
    pub(crate) fn advance_lanes(
        &self,
        g: &mut [f64],
        mu: &mut [f64],
        start: f64,
        [first, steps]: [u64; 2],
        live: [bool; WIDTH],
    ) -> [u64; WIDTH] {
        let (step, stepper) = (&self.programs.step, self.code().stepper(self.kernel()));
        if !step.moves() {
            return stepper.advance_lanes(self.coefficients(), g, mu, steps, live);
        }
        let (mut slots, mut made) = (self.coefficients().to_vec(), [0; WIDTH]);
        for number in 0..steps {
            let live = from_fn(|lane| live[lane] && made[lane] == number);
            if !live.contains(&true) {
                break;
            }
            let grid = Grid { start, step: self.folded.size };
            self.set_time(&mut slots, grid.time(first + number));
            let own = stepper.advance_lanes(&slots, g, mu, 1, live);
            made = from_fn(|lane| made[lane] + own[lane]);
        }
        made
    }
}

/// The coefficients that the programs of a step of this size read.
///
/// # Errors
/// Fails if one is not finite.
pub(super) fn coefficients(
    step: &Step,
    size: f64,
    parameters: &[f64],
) -> Result<Vec<f64>, StepError> {
    step.fold(size, parameters).map_err(|error| refusal(error, size, &step.symbols(parameters)))
}

fn fold(step: &Step, size: f64, parameters: &[f64]) -> Result<Folded, StepError> {
    if step.kernel().flows().is_some() {
        let slots = coefficients(step, size, parameters)?;
        return Ok(Folded { size, parameters: parameters.to_vec(), slots, quiet: 0.0 });
    }
    let symbols = step.symbols(parameters);
    let folded = step.fold_rows(size, &symbols, STEEP);
    let (slots, quiet) = folded.map_err(|error| refusal(error, size, &symbols))?;
    Ok(Folded { size, parameters: parameters.to_vec(), slots, quiet })
}
