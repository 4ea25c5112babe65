//! Steps of states with tangents beside them, by the kernel of their [`Tangent`].

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use coadjoint::StepError;
use coadjoint_codegen::step::{Origin, Step, Tangent};
use coadjoint_program::states::{into_lane, of_lane};
use coadjoint_program::{Kernel, Trajectories, WIDTH};
use nalgebra::{DMatrix, DMatrixView};

use super::codes::Codes;
use super::compiled::{Compiled, Numbers, refusal};
use super::varied::{Sense, Varied};
use crate::backend::{Backend, Running};
use crate::error::RunError;

/// Two steps that differ by less, relative to the momentum, are the same one.
const SAME: f64 = 1e-11;

/// Changes of the values that a step reads, k of each.
pub(crate) type Reading<'a> = dyn Fn(&[Read]) -> DMatrix<f64> + 'a;

/// A value of an input that a step reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Read {
    /// The number of the input.
    pub input: usize,
    /// The time.
    pub time: f64,
}

/// The tangents of the steps of a motion.
#[derive(Debug)]
pub(crate) struct Tangents {
    varied: Arc<Varied>,
    backend: Backend,
    /// The steps that are going to be made.
    steps: f64,
    /// The size that most steps have, and the derivatives of their coefficients in each parameter, which do not depend on the time.
    usual: (f64, Vec<Vec<f64>>),
    /// q, the number of parameters.
    pub parameters: usize,
    /// s, the number of values of inputs that a step reads.
    pub reads: usize,
    /// The coefficients of steps of the size that most have, as the kernel reads them, where they do not depend on the time.
    slots: [OnceLock<Vec<f64>>; 2],
}

/// A state with tangents, or cotangents, on their way.
#[derive(Debug)]
pub(crate) struct Carried<'t> {
    tangents: &'t Tangents,
    /// The way they go.
    pub sense: Sense,
    tangent: &'t Tangent,
    code: Running,
    /// The state.
    pub state: Numbers,
    /// ξ, ν, and the changes of the parameters and of the values that a step reads, (2n + q + s)×k.
    pub columns: DMatrix<f64>,
}

/// The derivatives of the coefficients of steps in each parameter.
///
/// # Errors
/// Fails if one is not finite.
fn slopes(step: &Step, (size, parameters): (f64, &[f64])) -> Result<Vec<Vec<f64>>, StepError> {
    let of = |number: usize| {
        let mut change = vec![0.0; parameters.len()];
        change[number] = 1.0;
        let slope = step.slope(size, parameters, &change);
        slope.map_err(|error| refusal(error, size, &step.symbols(&change)))
    };
    (0..parameters.len()).map(of).collect()
}

impl Tangents {
    /// Differentiates these steps, of which about `steps` are going to be made; `None` where they have no derivatives.
    ///
    /// # Errors
    /// Fails if a derivative of a coefficient is not finite.
    pub(super) fn new(
        compiled: &Compiled,
        origin: &Origin,
        backend: Backend,
        steps: f64,
    ) -> Result<Option<Self>, StepError> {
        let (step, (size, parameters)) = (compiled.step(), compiled.values());
        let each = step.kernel().slots_of_flow().max(1);
        let of_parameters = slopes(step, (size, parameters))?;
        let (sampled, parameters) = (step.sampled(size, 0.0), of_parameters.len());
        let places = |(number, slope): (usize, &Vec<f64>)| {
            let known = slope.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
            known.map(|(at, _)| (at % each, number)).collect::<Vec<_>>()
        };
        let mut all: Vec<_> = of_parameters.iter().enumerate().flat_map(places).collect();
        let of_inputs = sampled.iter().zip(parameters..);
        all.extend(of_inputs.map(|(&(place, ..), number)| (place % each, number)));
        all.sort_unstable();
        all.dedup();
        let count = parameters + sampled.len();
        let make = || {
            let forward = Tangent::new(step, origin, all.clone(), count).ok()?;
            let backward = forward.transpose(step, origin).ok()?;
            let backward = backward.map(|own| (own, Codes::default()));
            Some(Varied { forward: (forward, Codes::default()), backward })
        };
        let fits = |known: &Varied| known.forward.0.is_for(&all, count);
        let Some(varied) = compiled.varied(fits, make) else { return Ok(None) };
        let (reads, slots) = (sampled.len(), Default::default());
        let usual = (size, of_parameters);
        Ok(Some(Self { varied, backend, steps, usual, parameters, reads, slots }))
    }

    /// These tangents or cotangents, (2n + q + s)×k, with this state; `None` where steps have no transposes.
    ///
    /// # Errors
    /// Fails if the backend that the user named cannot be had.
    pub(crate) fn carry(
        &self,
        sense: Sense,
        state: Numbers,
        columns: DMatrix<f64>,
    ) -> Result<Option<Carried<'_>>, RunError> {
        let trajectories = match columns.ncols() {
            1 => Trajectories::One,
            _ => Trajectories::Lanes,
        };
        let steps = self.steps * columns.ncols().div_ceil(WIDTH) as f64;
        let Some((tangent, codes)) = self.varied.of(sense) else { return Ok(None) };
        let code = codes.code(&tangent.kernel, self.backend, steps, trajectories)?;
        Ok(Some(Carried { tangents: self, sense, tangent, code, state, columns }))
    }
}

impl Carried<'_> {
    fn kernel(&self) -> &Kernel {
        &self.tangent.kernel
    }

    /// The coefficients of the step of these programs from this time.
    fn coefficients(&self, compiled: &Compiled, time: f64) -> Result<Vec<f64>, StepError> {
        let (step, (size, parameters)) = (compiled.step(), compiled.values());
        let (usual, known) = &self.tangents.usual;
        let of_parameters = match size == *usual {
            true => Cow::Borrowed(known),
            false => Cow::Owned(slopes(step, (size, parameters))?),
        };
        let sampled = step.sampled(size, time);
        let (own, known) = (step.kernel().slots_of_flow(), compiled.coefficients_at(time));
        let slope = |place: usize, number: usize| match of_parameters.get(number) {
            Some(slope) => slope.get(place).copied().unwrap_or(0.0),
            None => f64::from(u8::from(sampled[number - of_parameters.len()].0 == place)),
        };
        let (each, slopes) = (self.kernel().slots_of_flow(), &self.tangent.slopes);
        let mut all = Vec::with_capacity(self.kernel().slots());
        for flow in 0..self.kernel().flows().map_or(1, |flows| flows as usize + 1) {
            let first = flow * own;
            all.extend(known.iter().skip(first).take(own));
            all.resize(flow * each + own, 0.0);
            all.extend(slopes.iter().map(|&(place, number)| slope(first + place, number)));
            all.resize((flow + 1) * each, 0.0);
        }
        Ok(all)
    }

    /// The values of inputs that a step of these programs from this time reads.
    pub(super) fn read(compiled: &Compiled, time: f64) -> Vec<Read> {
        let sampled = compiled.step().sampled(compiled.values().0, time);
        sampled.into_iter().map(|(_, input, time)| Read { input, time }).collect()
    }

    /// Sets the changes of the values that a step reads.
    pub(crate) fn reading(&mut self, changes: &DMatrix<f64>) {
        let first = self.columns.nrows() - self.tangents.reads;
        self.columns.rows_mut(first, changes.nrows()).copy_from(changes);
    }

    /// Makes up to `count` steps of one size, of which the first begins at this time; the number of those made. Steps that depend on the time
    /// are made one by one.
    ///
    /// # Errors
    /// Fails if a derivative of a coefficient is not finite.
    pub(super) fn advance(
        &mut self,
        compiled: &Compiled,
        time: f64,
        count: u64,
    ) -> Result<u64, StepError> {
        if compiled.step().moves() {
            return Ok(self.made(&self.coefficients(compiled, time)?, count.min(1)));
        }
        let known = &self.tangents.slots[self.sense as usize];
        let slots = match known.get() {
            Some(slots) => slots,
            None => {
                let made = self.coefficients(compiled, time)?;
                known.get_or_init(|| made)
            }
        };
        Ok(self.made(slots, count))
    }

    /// As [`Carried::advance`] for one step of another size.
    ///
    /// # Errors
    /// As [`Carried::advance`].
    pub(super) fn part(&mut self, compiled: &Compiled, time: f64) -> Result<bool, StepError> {
        let slots = self.coefficients(compiled, time)?;
        Ok(self.made(&slots, 1) == 1)
    }

    /// Makes up to `count` steps with these coefficients.
    fn made(&mut self, slots: &[f64], count: u64) -> u64 {
        let (mut done, n) = (0, self.state.mu.len());
        while done < count {
            let asked = (count - done).min(self.code.at_a_time());
            let made = match self.columns.ncols() {
                1 => self.alone(slots, asked),
                _ => self.side_by_side(slots, asked, n),
            };
            done += made;
            if made < asked {
                break;
            }
        }
        done
    }

    fn alone(&mut self, slots: &[f64], count: u64) -> u64 {
        let (stepper, n) = (self.code.stepper(&self.tangent.kernel), self.state.mu.len());
        let mut mu = [&self.state.mu[..], self.columns.as_slice()].concat();
        let made = stepper.advance(slots, &mut self.state.g, &mut mu, count).steps;
        let (state, columns) = mu.split_at(n);
        self.state.mu.copy_from_slice(state);
        self.columns.as_mut_slice().copy_from_slice(columns);
        made
    }

    fn side_by_side(&mut self, slots: &[f64], count: u64, n: usize) -> u64 {
        let stepper = self.code.stepper(&self.tangent.kernel);
        let (start, rows, mut made) = (self.state.clone(), self.columns.nrows(), 0);
        for columns in self.columns.as_mut_slice().chunks_mut(rows * WIDTH) {
            let own = columns.len() / rows;
            let mut g = vec![0.0; start.g.len() * WIDTH];
            let mut mu = vec![0.0; (n + rows) * WIDTH];
            let with_nothing = columns.chunks(rows).chain(std::iter::repeat(&[][..]));
            for (lane, column) in with_nothing.take(WIDTH).enumerate() {
                into_lane(&mut g, lane, [&start.g, &[]]);
                into_lane(&mut mu, lane, [&start.mu, column]);
            }
            let live = std::array::from_fn(|lane| lane < own);
            // The steps of all columns are the same.
            made = stepper.advance_lanes(slots, &mut g, &mut mu, count, live)[0];
            let put = |own: &mut [f64], numbers: &mut dyn Iterator<Item = f64>| {
                own.iter_mut().zip(numbers).for_each(|(own, number)| *own = number);
            };
            for (lane, column) in columns.chunks_mut(rows).enumerate() {
                put(column, &mut of_lane(&mu, lane).skip(n));
            }
            put(&mut self.state.g, &mut of_lane(&g, 0));
            put(&mut self.state.mu, &mut of_lane(&mu, 0));
        }
        made
    }

    /// Makes the step that programs refuse and that leads to this state, if their corrections find it.
    pub(super) fn refused(
        &mut self,
        compiled: &Compiled,
        time: f64,
        next: Numbers,
    ) -> Result<bool, StepError> {
        let kernel = self.kernel();
        if kernel.flows().is_some() {
            // The states between kicks are those of accepted flows.
            return Ok(false);
        }
        let (slots, Numbers { g, mu }) = (self.coefficients(compiled, time)?, &self.state);
        let size = next.mu.iter().fold(0.0, |largest: f64, mu| largest.max(mu.abs()));
        let mut moved = self.columns.clone();
        for mut column in moved.column_iter_mut() {
            let own: Vec<f64> = mu.iter().chain(&column).copied().collect();
            let found = kernel.attempt_at(&slots, g, &own);
            let from = [&g[..], &own, &found.increment].concat();
            let after = kernel.programs.transport.run(&from, &slots);
            let (state, change) = after[g.len()..].split_at(mu.len());
            let off = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME * size;
            let solved = found.residual_bound <= kernel.tolerance;
            if !solved || !state.iter().zip(&next.mu).all(off) {
                return Ok(false);
            }
            column.copy_from_slice(change);
        }
        (self.columns, self.state) = (moved, next);
        Ok(true)
    }

    /// The tangents.
    pub(crate) fn tangents(&self) -> DMatrixView<'_, f64> {
        self.columns.rows(0, 2 * self.state.mu.len())
    }
}
