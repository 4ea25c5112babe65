//! Steps by straight-line programs: what the loop that the attribute prints calls.
//!
//! In lanes the loop goes on as long as all of them are right; an equation is corrected in the lanes of a mask.

use nalgebra::SVector;

use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::number::{Coefficients, Number, Registers, Scalar};
use crate::solve::Driven;
use crate::step::numbers::ElementNumbers;

/// Steps after which a comoving frame moves on and the state is checked: few enough for the integrals of the frame, which
/// drift by rounding, to be the same in all of them.
pub const BLOCK: u64 = 256;

/// The numbers of g and of μ.
type State<T, const M: usize, const N: usize> = ([T; M], [T; N]);

/// The result of a loop, and the state after it.
type Run<T, const M: usize, const N: usize> = (Driven<[T; N], T>, State<T, M, N>);

/// The numbers of a state.
#[inline(always)]
pub fn load<G, const N: usize, const M: usize>(phase: &Phase<G>) -> State<G::Scalar, M, N>
where
    G: ElementNumbers + LieGroup<Vector = SVector<<G as LieGroup>::Scalar, N>>,
{
    let mut g = [G::Scalar::of(0.0); M];
    G::write(&phase.group_element, &mut g);
    (g, phase.momentum.into())
}

/// Makes the state that after the last step of a run.
#[inline(always)]
pub fn store<G, const N: usize, const M: usize>(
    phase: &mut Phase<G>,
    (driven, (g, mu)): Run<G::Scalar, M, N>,
) -> Driven<G::Vector, G::Scalar>
where
    G: ElementNumbers + LieGroup<Vector = SVector<<G as LieGroup>::Scalar, N>>,
{
    let Driven { steps, iterations, residual, refused } = driven;
    if steps > 0 {
        phase.group_element = G::read(&g);
        phase.momentum = mu.into();
    }
    let refused = refused.map(|(x, distance)| (x.into(), distance));
    Driven { steps, iterations, residual, refused }
}

/// The most lanes of registers.
const MOST_LANES: usize = 16;

/// The numbers of several states, one for each lane; where there are fewer the first stands in the lanes left over.
// No closures here: they would not have the instructions of their caller.
#[inline(always)]
pub fn load_lanes<R, G, const N: usize, const M: usize>(
    registers: R,
    phases: &[(usize, &mut Phase<G>)],
) -> State<R::Number, M, N>
where
    R: Registers,
    G: ElementNumbers<Scalar = f64> + LieGroup<Vector = SVector<f64, N>>,
{
    let lanes = R::LANES.min(MOST_LANES);
    let (mut g, mut mu) = ([[0.0; MOST_LANES]; M], [[0.0; MOST_LANES]; N]);
    for lane in 0..lanes {
        let Some((_, phase)) = phases.get(lane).or(phases.first()) else { break };
        let mut numbers = [0.0; M];
        G::write(&phase.group_element, &mut numbers);
        for i in 0..M {
            g[i][lane] = numbers[i];
        }
        for i in 0..N {
            mu[i][lane] = phase.momentum[i];
        }
    }
    let zero = registers.load(&[0.0; MOST_LANES][..lanes]);
    let mut state = ([zero; M], [zero; N]);
    for i in 0..M {
        state.0[i] = registers.load(&g[i][..lanes]);
    }
    for i in 0..N {
        state.1[i] = registers.load(&mu[i][..lanes]);
    }
    state
}

/// Makes the states those after a run if it made all of its steps; whether it did.
#[inline(always)]
pub fn store_lanes<R, G, const N: usize, const M: usize>(
    registers: R,
    phases: &mut [(usize, &mut Phase<G>)],
    steps: u64,
    (driven, (g, mu)): Run<R::Number, M, N>,
) -> bool
where
    R: Registers,
    G: ElementNumbers<Scalar = f64> + LieGroup<Vector = SVector<f64, N>>,
{
    let lanes = R::LANES.min(MOST_LANES);
    if driven.steps < steps || phases.len() > lanes {
        return false;
    }
    let (mut g_rows, mut mu_rows) = ([[0.0; MOST_LANES]; M], [[0.0; MOST_LANES]; N]);
    for i in 0..M {
        registers.store(g[i], &mut g_rows[i][..lanes]);
    }
    for i in 0..N {
        registers.store(mu[i], &mut mu_rows[i][..lanes]);
    }
    for (lane, (_, phase)) in phases.iter_mut().enumerate() {
        let mut numbers = [0.0; M];
        for i in 0..M {
            numbers[i] = g_rows[i][lane];
        }
        phase.group_element = G::read(&numbers);
        for i in 0..N {
            phase.momentum[i] = mu_rows[i][lane];
        }
    }
    true
}

impl<V, T: Number> Driven<V, T> {
    /// Takes a step into the report.
    #[inline(always)]
    pub fn note(&mut self, corrections: u64, residual_bound: T) {
        self.iterations = self.iterations.max(corrections as u32);
        let larger = self.residual.simd_le(residual_bound);
        self.residual = residual_bound.select(larger, self.residual);
    }
}

/// Coefficients, and after those that are folded the times at which programs ask for the Hamiltonian.
#[derive(Clone, Copy)]
pub struct Timed<C, T, const TIMES: usize> {
    folded: C,
    first: usize,
    times: [T; TIMES],
}

/// The coefficients of a step that begins at `now`, whose size is at the place `size`. The times have the places from `first` on,
/// and are given as parts of the step.
#[inline(always)]
pub fn timed<T: Number, C: Coefficients<T>, const TIMES: usize>(
    folded: C,
    [size, first]: [usize; 2],
    now: T,
    parts: [f64; TIMES],
) -> Timed<C, T, TIMES> {
    let mut times = [now; TIMES];
    for i in 0..TIMES {
        times[i] = folded.of(parts[i]).times_plus(folded.at(size), now);
    }
    Timed { folded, first, times }
}

impl<T: Number, C: Coefficients<T>, const TIMES: usize> Coefficients<T> for Timed<C, T, TIMES> {
    #[inline(always)]
    fn at(self, place: usize) -> T {
        if place < self.first { self.folded.at(place) } else { self.times[place - self.first] }
    }
    #[inline(always)]
    fn of(self, value: f64) -> T {
        self.folded.of(value)
    }
    #[inline(always)]
    fn epsilon(self) -> T {
        self.folded.epsilon()
    }
}

/// True if the answer of a program is 1 in all lanes.
#[inline(always)]
pub fn is_one<T: Number, C: Coefficients<T>>(c: C, answer: T) -> bool {
    !T::any(!c.of(1.0).simd_le(answer))
}

/// The new number in the lanes of a mask, in others the old one. A single lane would not ask, were it not in the mask.
#[inline(always)]
pub fn choose<T: Number>(lanes: T::Mask, new: T, old: T) -> T {
    if T::SINGLE { new } else { new.select(lanes, old) }
}

/// [`choose`] for each of a row of numbers.
#[inline(always)]
pub fn choose_all<T: Number, const N: usize>(
    lanes: T::Mask,
    new: [T; N],
    mut old: [T; N],
) -> [T; N] {
    for i in 0..N {
        old[i] = choose(lanes, new[i], old[i]);
    }
    old
}

/// The result of a long function, which is not inlined.
#[inline(never)]
pub fn called<R>(function: impl FnOnce() -> R) -> R {
    function()
}
