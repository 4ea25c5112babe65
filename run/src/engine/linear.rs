//! The derivative of a step, as a matrix, by the programs of its [`Tangent`].
//!
//! A tangent to a state (g, μ) is (ξ, ν), ξ = g⁻¹δg in 𝔤 and ν = δμ in 𝔤\*: 2n numbers. A step is a sequence of kicks, of motions by
//! increments x that solve the equations of flows, and of motions of a comoving frame. A motion by τ(x) moves, with L = d^L τ_x,
//!
//! ```text
//! ξ″ = Ad_{τ(x)⁻¹} ξ + L δx        ν″ = Ad*_{τ(x)⁻¹} ν + ad*_{L δx} μ″
//! ```
//!
//! Where δx comes of the Hessian of a generating function at the p of the step, every symmetric Hessian makes this symplectic.

use coadjoint::StepError;
use coadjoint::steps::Circumstances;
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::step::{Differentiated, Origin, Step, Tangent};
use nalgebra::{DMatrix, DVector};

use super::compiled::{Compiled, Numbers, refusal};

/// The derivative of a step, or of several, in the state before it, in the parameters θ, and in the values of inputs that it reads.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linear {
    /// ∂(ξ″, ν″)/∂(ξ, ν), 2n×2n.
    pub state: DMatrix<f64>,
    /// ∂(ξ″, ν″)/∂θ, 2n×q.
    pub parameters: DMatrix<f64>,
    /// ∂(ξ″, ν″)/∂u for each of the values below, 2n×s.
    pub inputs: DMatrix<f64>,
    /// The values of inputs that the step reads: the number of the input, the time.
    pub read: Vec<(usize, f64)>,
    /// The momentum after the step, where its programs refuse it and its equations were solved otherwise.
    pub refused: Option<Vec<f64>>,
}

impl Linear {
    /// The derivative of this step followed by the next one.
    pub(super) fn then(self, next: &Self) -> Self {
        let inputs = &next.state * &self.inputs;
        let columns = inputs.column_iter().chain(next.inputs.column_iter());
        let columns: Vec<_> = columns.map(|column| column.into_owned()).collect();
        let none = DMatrix::zeros(next.state.nrows(), 0);
        Self {
            state: &next.state * &self.state,
            parameters: &next.state * &self.parameters + &next.parameters,
            inputs: if columns.is_empty() { none } else { DMatrix::from_columns(&columns) },
            read: [self.read, next.read.clone()].concat(),
            refused: None,
        }
    }
}

/// Corrections of Newton's method at most, and the one, relative to the numbers, after which there is no other.
const MOST_CORRECTIONS: u32 = 30;
const ROUNDING: f64 = 1e-13;

/// Halvings of the motion of a frame at most.
const MOST_HALVINGS: i32 = 64;

/// The programs of the derivative of steps, with the derivatives of coefficients in parameters.
struct Differential<'a> {
    step: &'a Step,
    tangent: &'a Tangent,
    slots: &'a [f64],
    /// For each parameter the derivatives of the coefficients.
    slopes: &'a [Vec<f64>],
}

/// A state on its way through a step, and its derivative in all columns: those of (ξ, ν) at the start, of parameters, of inputs.
struct Carried {
    state: Numbers,
    /// True if programs refuse a flow.
    refused: bool,
    xi: DMatrix<f64>,
    nu: DMatrix<f64>,
}

/// The derivatives of the coefficients of steps in each parameter.
///
/// # Errors
/// Fails if one is not finite.
pub(super) fn slopes(compiled: &Compiled) -> Result<Vec<Vec<f64>>, StepError> {
    let (step, (size, parameters)) = (compiled.step(), compiled.values());
    let of = |number: usize| {
        let mut change = vec![0.0; parameters.len()];
        change[number] = 1.0;
        let slope = step.slope(size, parameters, &change);
        slope.map_err(|error| refusal(error, size, &step.symbols(&change)))
    };
    (0..parameters.len()).map(of).collect()
}

/// The derivative of a step of this origin from this state and time, given the [`slopes`]; `None` where there is none.
///
/// # Errors
/// Fails if two solutions of the step meet.
pub(super) fn linear(
    compiled: &Compiled,
    origin: &Origin,
    slopes: &[Vec<f64>],
    state: &Numbers,
    time: f64,
) -> Result<Option<Linear>, StepError> {
    let Some(tangent) = compiled.tangent(origin) else { return Ok(None) };
    let (step, slots) = (compiled.step(), compiled.coefficients_at(time));
    let differential = Differential { step, tangent, slots: &slots, slopes };
    differential.at(state, [time, compiled.values().0])
}

/// z of the equations of a flow from this state by Newton's method with their matrix; `None` where it does not converge.
fn by_newton(tangent: &Tangent, slots: &[f64], Numbers { g, mu }: &Numbers) -> Option<Vec<f64>> {
    let Tangent { equation, flow, .. } = tangent;
    let (n, u) = (mu.len(), equation.value.outputs().len() - 2 * mu.len());
    let from = if flow.guesses_from_element() { [&g[..], mu].concat() } else { mu.clone() };
    let mut z = flow.programs.guess.run(&from, slots);
    z.truncate(u);
    for _ in 0..MOST_CORRECTIONS {
        let at = [&g[..], &vec![0.0; n], mu, &z].concat();
        let residual = DVector::from_vec(equation.value.run(&at, slots));
        let slope = by_inputs(equation, &at, slots, [2 * n, 2 * n + u]);
        let change = slope.rows(0, u).into_owned().lu().solve(&residual.rows(0, u))?;
        z.iter_mut().zip(&change).for_each(|(z, change)| *z -= change);
        let size = z.iter().fold(0.0, |largest: f64, z| largest.max(z.abs()));
        if change.amax() <= ROUNDING * size {
            return Some(z);
        }
    }
    None
}

/// A unit vector.
fn unit(of: usize, at: usize) -> Vec<f64> {
    (0..of).map(|i| if i == at { 1.0 } else { 0.0 }).collect()
}

/// The error of a step whose solution is also that of another one.
fn meeting(x: &[f64]) -> StepError {
    let x = x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    StepError::NotFollowed { reached: 1.0, at: Circumstances { x, ratio: 0.0, usable_step: None } }
}

/// The results of a program for these rows of inputs, a column each.
fn run_columns(program: &Program, rows: &[Vec<f64>], slots: &[f64]) -> DMatrix<f64> {
    let results = match rows.is_empty() {
        true => Vec::new(),
        false => program.run_each(
            rows.len(),
            |row, i| rows[row].get(i).copied().unwrap_or(f64::NAN),
            slots,
        ),
    };
    DMatrix::from_vec(program.outputs().len(), rows.len(), results)
}

/// The derivative of a program at these inputs in the ones from `from` to `to`, counted after the fixed ones.
fn by_inputs(
    own: &Differentiated,
    at: &[f64],
    slots: &[f64],
    [from, to]: [usize; 2],
) -> DMatrix<f64> {
    let count = own.by_inputs.inputs() - at.len();
    let rows: Vec<_> = (from..to).map(|i| [at, &unit(count, i)].concat()).collect();
    run_columns(&own.by_inputs, &rows, slots)
}

/// The derivative of a program at these inputs along these changes of its coefficients.
fn by_slots(own: &Differentiated, at: &[f64], slots: &[f64], changes: &[Vec<f64>]) -> DMatrix<f64> {
    let rows: Vec<_> = changes.iter().map(|change| [at, &change[..]].concat()).collect();
    run_columns(&own.by_slots, &rows, slots)
}

impl<'a> Differential<'a> {
    /// The derivative of the step of this size from this state and time; `None` where its equations are not solved.
    ///
    /// # Errors
    /// Fails if two solutions meet.
    fn at(&self, state: &Numbers, [time, size]: [f64; 2]) -> Result<Option<Linear>, StepError> {
        let (kernel, sampled) = (self.step.kernel(), self.step.sampled(size, time));
        let (n, q) = (kernel.dim, self.slopes.len());
        let columns = 2 * n + q + sampled.len();
        let (xi, nu) = (DMatrix::identity(n, columns), DMatrix::zeros(n, columns));
        let mut moving = Carried { state: state.clone(), refused: false, xi, nu };
        moving.nu.columns_mut(n, n).fill_with_identity();
        let each = kernel.slots_of_flow();
        // The changes of the coefficients of a flow in each parameter and input.
        let changes = |flow: usize| -> Vec<Vec<f64>> {
            let own = flow * each..(flow + 1) * each;
            let of_parameters = self.slopes.iter().map(|slope| slope[own.clone()].to_vec());
            let of_input =
                |&(place, ..): &(usize, usize, f64)| unit(each, place.wrapping_sub(own.start));
            of_parameters.chain(sampled.iter().map(of_input)).collect()
        };
        for flow in 0..kernel.flows().unwrap_or(1) as usize {
            let (slots, changes) = (&self.slots[flow * each..][..each], changes(flow));
            self.kick(&mut moving, slots, &changes);
            if !self.flow(&mut moving, slots, &changes)? {
                return Ok(None);
            }
        }
        if let Some(last) = kernel.flows() {
            let last = last as usize;
            self.kick(&mut moving, &self.slots[last * each..][..each], &changes(last));
        }
        let mut whole = DMatrix::zeros(2 * n, columns);
        whole.rows_mut(0, n).copy_from(&moving.xi);
        whole.rows_mut(n, n).copy_from(&moving.nu);
        Ok(Some(Linear {
            state: whole.columns(0, 2 * n).into_owned(),
            parameters: whole.columns(2 * n, q).into_owned(),
            inputs: whole.columns(2 * n + q, sampled.len()).into_owned(),
            read: sampled.into_iter().map(|(_, input, time)| (input, time)).collect(),
            refused: moving.refused.then_some(moving.state.mu),
        }))
    }

    /// A kick, where there are kicks.
    fn kick(&self, moving: &mut Carried, slots: &[f64], changes: &[Vec<f64>]) {
        let Some(kick) = &self.tangent.kick else { return };
        let (n, Numbers { g, mu }) = (self.step.kernel().dim, &moving.state);
        let at = [&g[..], &vec![0.0; n], mu].concat();
        let turned = by_inputs(kick, &at, slots, [0, n]);
        let mut pushed = turned * &moving.xi;
        let mut others = pushed.columns_mut(2 * n, changes.len());
        others += by_slots(kick, &at, slots, changes);
        moving.nu += pushed;
        moving.state.mu = kick.value.run(&at, slots);
    }

    /// A flow with the motion of a frame after it; false where its equations are not solved.
    fn flow(
        &self,
        moving: &mut Carried,
        slots: &[f64],
        changes: &[Vec<f64>],
    ) -> Result<bool, StepError> {
        let (kernel, Tangent { equation, reads, .. }) = (self.step.kernel(), self.tangent);
        let Numbers { g, mu } = &moving.state;
        let made = self.tangent.flow.attempt_at(slots, g, mu);
        let (n, u) = (kernel.dim, equation.value.outputs().len() - 2 * kernel.dim);
        let solved = match made.accepted {
            true => Some(made.unknowns),
            // The states between kicks are those of accepted flows.
            false if kernel.flows().is_none() => by_newton(self.tangent, slots, &moving.state),
            false => None,
        };
        let Some(z) = solved else { return Ok(false) };
        moving.refused = !made.accepted;
        let at = [&g[..], &vec![0.0; n], mu, &z[..u]].concat();
        // What the equations, x, and the momentum that x moves depend on besides z.
        let mut along = by_inputs(equation, &at, slots, [n, 2 * n]) * &moving.nu;
        if *reads {
            along += by_inputs(equation, &at, slots, [0, n]) * &moving.xi;
        }
        let mut others = along.columns_mut(2 * n, changes.len());
        others += by_slots(equation, &at, slots, changes);
        let by_solution = by_inputs(equation, &at, slots, [2 * n, 2 * n + u]);
        let value = equation.value.run(&at, slots);
        let (x, pushed) = value[u..].split_at(n);
        let solved = by_solution.rows(0, u).into_owned().lu().solve(&along.rows(0, u));
        let changed =
            along.rows(u, 2 * n) - by_solution.rows(u, 2 * n) * solved.ok_or_else(|| meeting(x))?;
        moving.nu = changed.rows(n, n).into_owned();
        let pushed = DVector::from_column_slice(pushed);
        let mut after = self.moved(
            &self.tangent.motion,
            moving,
            (x, &pushed),
            changed.rows(0, n).into_owned(),
            0,
        );
        for frame in &self.tangent.frame {
            let Some(motion) = &self.tangent.frame_motion else { break };
            let at = after.as_slice();
            let y = frame.value.run(at, slots);
            let mut change = by_inputs(frame, at, slots, [0, n]) * &moving.nu;
            let mut others = change.columns_mut(2 * n, changes.len());
            others += by_slots(frame, at, slots, changes);
            let halvings = self.halvings(&y);
            after = self.moved(motion, moving, (&y, &after), change, halvings);
        }
        if moving.refused {
            moving.state.mu = after.as_slice().to_vec();
            return Ok(true);
        }
        let Numbers { g, mu } = &moving.state;
        let from = [&g[..], mu, &made.increment].concat();
        let mut next = kernel.programs.transport.run(&from, slots);
        let mu = next.split_off(g.len());
        moving.state = Numbers { g: next, mu };
        Ok(true)
    }

    /// Halvings after which a series for the motion by exp(y) is exact to rounding.
    fn halvings(&self, y: &[f64]) -> i32 {
        let mut norm = vec![0.0; y.len()];
        for &(i, j, _, c) in &self.tangent.structure {
            norm[j] += (c * y[i]).abs();
        }
        let norm = norm.into_iter().fold(0.0, f64::max);
        (0..MOST_HALVINGS)
            .find(|&halvings| norm * 0.5_f64.powi(halvings) <= 0.5)
            .unwrap_or(MOST_HALVINGS)
    }

    /// Moves the derivative by τ(x), or in a frame by exp(x), which is that of x·2^−halvings squared as often, of this momentum, given δx in
    /// all columns. Returns the momentum after it.
    fn moved(
        &self,
        motion: &Program,
        moving: &mut Carried,
        (x, mu): (&[f64], &DVector<f64>),
        mut change: DMatrix<f64>,
        halvings: i32,
    ) -> DVector<f64> {
        let (n, share) = (x.len(), 0.5_f64.powi(halvings));
        let row = |sign: f64| {
            move |i: usize| {
                let x = x.iter().map(|x| sign * share * x);
                x.chain(unit(n, i)).collect::<Vec<f64>>()
            }
        };
        let rows: Vec<_> = (0..n).map(row(1.0)).chain((0..n).map(row(-1.0))).collect();
        let found = run_columns(motion, &rows, &[]);
        let mut coadjoint = found.view((0, 0), (n, n)).into_owned();
        // Ad_{τ⁻¹} is the transpose of Ad*_τ, and d^L τ_x = d^R τ_{−x}.
        let mut adjoint = found.view((0, n), (n, n)).transpose();
        let mut left = found.view((n, n), (n, n)).transpose();
        for _ in 0..halvings {
            left = (&left + &adjoint * &left) * 0.5;
            adjoint = &adjoint * &adjoint;
            coadjoint = &coadjoint * &coadjoint;
        }
        let after = &coadjoint * mu;
        change = left * change;
        moving.xi = adjoint * &moving.xi + &change;
        moving.nu = coadjoint * &moving.nu;
        for &(i, j, k, c) in &self.tangent.structure {
            let factor = c * after[k];
            let added = change.row(i) * factor;
            let mut row = moving.nu.row_mut(j);
            row += added;
        }
        after
    }
}
