//! Gauss's method on quaternions.
//!
//! The spin of a site is s = q s₀ q̄ for a quaternion q, dq/dt = −½ ω q, ω = ∂H/∂s. This equation has Gauss's method applied to
//! it: with the spins at the nodes given, so are ωⱼ, and Qᵢ + ½h Σ aᵢⱼ ωⱼ Qⱼ = 1 is solved for each site by elimination over
//! the quaternions. The spins at the nodes are found by sweeps over the colours of sites. The step turns each spin by q/|q|,
//! whatever the residual, so that lengths are kept to rounding.

use alloc::vec::Vec;
use core::array::from_fn;
use core::fmt;

use coadjoint_geometry::number::Number;
use coadjoint_geometry::vector::{V3, cross, difference, dot, each, plus, plus_by, scaled, sum};
use coadjoint_program::collocation::{MAX_SWEEPS, Nodes, ROUNDING, SOLVED};

use super::couplings::{Couplings, Energies, Own, UserFunction, Velocity, multiplied};
use super::error::{LatticeError, check_spins, check_step};
use super::lanes::{LANES, Pack, larger, larger_each, largest};
use super::layout::{Column, Spins, Vectors, each_pack, pieces, read, split, write};
use super::threads;
use crate::error::{Circumstances, StepError, Stopped};

/// No gradient but that of the lattice.
pub type NoField = fn(&[[f64; 3]], &mut [[f64; 3]]);

/// Steps of a lattice of spins by Gauss's method with `M` nodes on quaternions.
///
/// ```
/// use coadjoint::lattice::{Graph, Lattice};
///
/// // Spins on a ring with the biquadratic energy −(a·b)² of neighbours, by its gradient.
/// let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/// let gradient = |s: &[[f64; 3]], out: &mut [[f64; 3]]| {
///     for i in 0..s.len() {
///         let (before, after) = (s[(i + s.len() - 1) % s.len()], s[(i + 1) % s.len()]);
///         let (b, a) = (dot(s[i], before), dot(s[i], after));
///         out[i] = std::array::from_fn(|k| -2.0 * (b * before[k] + a * after[k]));
///     }
/// };
/// let ring = Lattice::new(Graph::chain(8)?);
/// let mut spins: Vec<[f64; 3]> = (0..8).map(|i| [(f64::from(i)).sin(), (f64::from(i)).cos(), 0.5]).collect();
/// let before = ring.total_spin(&spins)?;
/// ring.gauss_of::<3, _>(0.1, gradient)?.advance_by(&mut spins, 100)?;
/// assert!((ring.total_spin(&spins)?[2] - before[2]).abs() < 1e-13);
/// # Ok::<(), coadjoint::lattice::LatticeError>(())
/// ```
///
/// A step starts from a guess that follows the step before it, where it goes on from its end; its bits then depend on that,
/// within rounding.
pub struct GaussStep<const M: usize, F = NoField> {
    couplings: Couplings,
    /// All of the velocity but the fields of neighbours.
    equation: Equation<M>,
    /// The field without that which depends on time.
    held: V3<f64>,
    driven: Option<UserFunction<dyn Fn(f64) -> [f64; 3] + Send + Sync>>,
    /// The times of the nodes, in steps.
    times: [f64; M],
    gradient: Option<F>,
    step: f64,
    /// aᵢⱼ by i, then by j, and bⱼ, in halves of the step.
    matrix: [[f64; M]; M],
    weights: [f64; M],
    /// The polynomial through the nodes of the step before and its end, at the nodes.
    guess: [([f64; M], f64); M],
    /// The spins now, and at the nodes.
    now: Spins,
    nodes: [Spins; M],
    /// The further gradient at the nodes.
    further: Option<[Spins; M]>,
    /// The state that the last step led to.
    end: Vec<[f64; 3]>,
    /// Sweeps of all steps.
    sweeps: u64,
}

impl<const M: usize, F> fmt::Debug for GaussStep<M, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "GaussStep {{ nodes: {M}, step: {} }}", self.step)
    }
}

impl<const M: usize, F: Fn(&[[f64; 3]], &mut [[f64; 3]])> GaussStep<M, F> {
    pub(super) fn new(
        sites: usize,
        energies: &Energies,
        step: f64,
        gradient: Option<F>,
    ) -> Result<Self, LatticeError> {
        check_step(step)?;
        let couplings = Couplings::new(sites, &energies.bonds, false);
        let Nodes { times, weights, matrix, .. } = const { Nodes::<M>::new() };
        let times = times.map(|time| time + 0.5);
        let guess = from_fn(|i| {
            // Lagrange's polynomials of the nodes one step before and of the end.
            let known = |j: usize| if j == M { 0.0 } else { times[j] - 1.0 };
            let of = |j: usize| {
                let others = (0..=M).filter(|k| *k != j);
                others.map(|k| (times[i] - known(k)) / (known(j) - known(k))).product()
            };
            (from_fn(of), of(M))
        });
        let spins = Spins::new(couplings.places.len() + LANES, 0);
        let twice = 2.0 * energies.anisotropy;
        let anisotropic = energies.anisotropy.iter().any(|entry| *entry != 0.0);
        Ok(Self {
            equation: Equation {
                constant: [energies.field.into(); M],
                own: energies.own.iter().map(|own| own.placed(&couplings.places)).collect(),
                anisotropy: anisotropic.then(|| from_fn(|i| from_fn(|j| twice[(i, j)]))),
                damping: (energies.damping != [0.0; 3]).then_some(energies.damping),
                velocity: energies.velocity.clone().map(|own| (own, couplings.places.sites_at())),
                times: [0.0; M],
            },
            held: energies.field.into(),
            driven: energies.driven.clone(),
            times,
            matrix: from_fn(|i| from_fn(|j| 0.5 * step * (matrix[j][i] + 0.5 * weights[j]))),
            weights: weights.map(|weight| 0.5 * step * weight),
            guess,
            nodes: from_fn(|i| Spins::new(couplings.copies.length(), 1 + i)),
            further: gradient.is_some().then(|| from_fn(|_| spins.clone())),
            now: spins,
            couplings,
            gradient,
            step,
            end: Vec::new(),
            sweeps: 0,
        })
    }

    /// Sweeps over all sites that all steps took so far.
    #[must_use]
    pub fn sweeps(&self) -> u64 {
        self.sweeps
    }

    /// Guesses the next step by its state alone, whatever was before: its bits then follow from the state.
    pub fn forget(&mut self) {
        self.end.clear();
    }

    /// Advances the spins, in the order of the graph's sites, by `steps` steps.
    ///
    /// # Errors
    /// [`LatticeError::Sites`] and [`LatticeError::NonFinite`], with the spins as they were; [`LatticeError::Stopped`] where
    /// the equations of a step were not solved and [`LatticeError::TooLong`], with the spins before that step.
    pub fn advance_by(&mut self, spins: &mut [[f64; 3]], steps: u64) -> Result<(), LatticeError> {
        self.advance_from(spins, 0.0, steps)
    }

    /// As [`GaussStep::advance_by`], from this time on, of which the field that depends on time is a function.
    ///
    /// # Errors
    /// As [`GaussStep::advance_by`].
    pub fn advance_from(
        &mut self,
        spins: &mut [[f64; 3]],
        time: f64,
        steps: u64,
    ) -> Result<(), LatticeError> {
        let Self { couplings, now, .. } = self;
        check_spins(couplings.places.sites(), spins)?;
        let mut goes_on = self.end == spins;
        couplings.places.scatter(spins, now);
        let size = spins.iter().flatten().fold(0.0, |size, number| larger(size, number.abs()));
        let mut made = Ok(());
        for steps in 0..steps {
            self.start(goes_on);
            let now = time + steps as f64 * self.step;
            self.equation.times = self.times.map(|at| now + at * self.step);
            if let Some(UserFunction(field)) = &self.driven {
                self.equation.constant = self.equation.times.map(|at| sum(self.held, field(at)));
            }
            goes_on = true;
            if let Err(error) = self.solve(size, steps) {
                made = Err(error);
                goes_on = false;
                break;
            }
            self.finish();
        }
        self.couplings.places.gather(&self.now, spins);
        self.end.clear();
        if goes_on {
            self.end.extend_from_slice(spins);
        }
        made
    }

    /// The first guess of the spins at the nodes.
    fn start(&mut self, goes_on: bool) {
        let Self { guess, now, nodes, couplings, .. } = self;
        let (places, now) = (couplings.places.len(), now.all());
        let columns = nodes.each_mut().map(Spins::all_mut);
        threads::each(
            pieces(columns, places),
            #[inline(always)]
            |(first, mut nodes)| {
                for at in (0..nodes[0][0].len()).step_by(LANES) {
                    let start = now.row(first + at);
                    let mut before = [[Pack::of(0.0); 3]; M];
                    for i in 0..M {
                        before[i] = read(&nodes[i], at);
                    }
                    for i in 0..M {
                        let mut spin = start;
                        if goes_on {
                            let (weights, weight) = &guess[i];
                            spin = scaled(Pack::of(*weight), start);
                            for j in 0..M {
                                spin = plus_by(spin, weights[j], before[j]);
                            }
                        }
                        write(&mut nodes[i], at, spin);
                    }
                }
            },
        );
    }

    /// Finds the spins at the nodes, whose largest component is `size`, after `steps` steps.
    fn solve(&mut self, size: f64, steps: u64) -> Result<(), LatticeError> {
        let (mut before, mut angle) = (f64::INFINITY, 0.0);
        for sweep in 0..MAX_SWEEPS {
            self.sweeps += 1;
            self.ask();
            let [mut change, mut speed] = [0.0; 2];
            for colour in 0..self.couplings.places.colours.len() {
                let found = self.pass(colour);
                (change, speed) = (larger(change, found[0]), larger(speed, found[1]));
            }
            change = change.sqrt();
            angle = (speed / M as f64).sqrt() * self.step.abs();
            let rate = if sweep == 0 { 0.5 } else { (change / before).min(0.5) };
            let rounding = change >= before && change <= ROUNDING * size;
            if change * rate <= SOLVED * size || rounding {
                if angle > core::f64::consts::PI {
                    return Err(LatticeError::TooLong { steps, angle });
                }
                self.ask();
                return Ok(());
            }
            before = change;
            if !change.is_finite() {
                break;
            }
        }
        let at = Circumstances { x: angle, ratio: 0.0, usable_step: None };
        let residual = before / size;
        let error = StepError::NotConverged { iterations: MAX_SWEEPS, residual, at };
        Err(Stopped { steps, error }.into())
    }

    /// Asks for the further gradient at the nodes.
    fn ask(&mut self) {
        let Self { couplings, nodes, gradient, further, .. } = self;
        let (Some(gradient), Some(further)) = (gradient, further) else { return };
        let sites = couplings.places.sites();
        let mut spins = alloc::vec![[0.0; 3]; sites];
        let mut found = alloc::vec![[0.0; 3]; sites];
        for (node, further) in nodes.iter().zip(further) {
            couplings.places.gather(node, &mut spins);
            gradient(&spins, &mut found);
            couplings.places.scatter(&found, further);
        }
    }

    /// One sweep over the sites of a colour: the largest changes of a site and speeds, as squares summed over nodes.
    fn pass(&mut self, colour: usize) -> [f64; 2] {
        let Self { nodes, now, couplings, further, .. } = self;
        let range = couplings.places.colours[colour].clone();
        let now = now.all();
        let further = further.as_ref().map(|nodes| nodes.each_ref().map(Spins::all));
        let lists = &couplings.copies.of_colour[colour];
        for column in nodes.each_mut().into_iter().flat_map(Spins::all_mut) {
            couplings.copies.refresh(column, lists.clone());
        }
        let parts = nodes.each_mut().map(|node| split(node, &range));
        let around = parts.each_ref().map(|part| part.0);
        let columns = parts.map(|part| part.1);
        let (equation, matrix, first_place) = (&self.equation, &self.matrix, range.start);
        let pieces = pieces(columns, range.len());
        let changes = threads::each(
            pieces,
            #[inline(always)]
            |(first, mut nodes)| {
                let [mut change, mut speed, mut all] = [Pack::of(0.0); 3];
                for at in (0..nodes[0][0].len()).step_by(LANES) {
                    let place = first_place + first + at;
                    let mut spins = [[Pack::of(0.0); 3]; M];
                    for i in 0..M {
                        spins[i] = read(&nodes[i], at);
                    }
                    let mut rates = equation.rates(&spins, further.as_ref(), place);
                    rates = couplings.fields(rates, around.each_ref(), place / LANES);
                    equation.drive(&spins, &mut rates, place);
                    let turns = solved(matrix, &rates);
                    let start = now.row(place);
                    let [mut gaps, mut squares] = [Pack::of(0.0); 2];
                    for i in 0..M {
                        let (spin, _) = turned(turns[i], start);
                        let gap = difference(spin, spins[i]);
                        gaps = gaps + dot(gap, gap);
                        squares = squares + dot(rates[i], rates[i]);
                        write(&mut nodes[i], at, spin);
                    }
                    change = larger_each(change, gaps);
                    all = all + gaps;
                    speed = larger_each(speed, squares);
                }
                // The sum is not finite where a change is not a number, which the larger of two may lose.
                [largest(change + all.by(0.0)), largest(speed)]
            },
        );
        let both = |a: [f64; 2], b: [f64; 2]| [larger(a[0], b[0]), larger(a[1], b[1])];
        changes.into_iter().fold([0.0; 2], both)
    }

    /// Turns the spins by the rotation of the whole step.
    fn finish(&mut self) {
        let Self { nodes, now, couplings, further, .. } = self;
        let (equation, matrix, weights) = (&self.equation, &self.matrix, &self.weights);
        for column in nodes.each_mut().into_iter().flat_map(Spins::all_mut) {
            couplings.copies.refresh(column, couplings.copies.all());
        }
        let nodes = nodes.each_ref().map(Spins::all);
        let further = further.as_ref().map(|nodes| nodes.each_ref().map(Spins::all));
        each_pack(
            now.all_mut(),
            couplings.places.len(),
            #[inline(always)]
            |pack, spin| {
                let place = pack * LANES;
                let mut spins = [[Pack::of(0.0); 3]; M];
                for i in 0..M {
                    spins[i] = nodes[i].row(place);
                }
                let mut rates = equation.rates(&spins, further.as_ref(), place);
                rates = couplings.fields(rates, nodes, pack);
                equation.drive(&spins, &mut rates, place);
                let turns = solved(matrix, &rates);
                let mut turn = one();
                for j in 0..M {
                    let [x, y, z] = rates[j];
                    let part = product([Pack::of(0.0), x, y, z], turns[j]);
                    turn = each(|k| part[k].by_plus(-weights[j], turn[k]));
                }
                let (spin, norm) = turned(turn, spin);
                scaled(Pack::of(1.0) / norm, spin)
            },
        );
    }
}

/// The part of ∂H/∂s that does not depend on neighbours, and the velocity beside it.
struct Equation<const M: usize> {
    constant: [V3<f64>; M],
    own: Vec<Own<Option<Column>>>,
    anisotropy: Option<[[f64; 3]; 3]>,
    damping: Option<[f64; 3]>,
    /// With the sites at all places.
    velocity: Option<(UserFunction<Velocity>, Vec<Option<usize>>)>,
    /// The times of the nodes.
    times: [f64; M],
}

impl<const M: usize> Equation<M> {
    /// ∂H/∂s at the nodes, with what is further known of it.
    #[inline(always)]
    fn rates(
        &self,
        spins: &[V3<Pack>; M],
        further: Option<&[[&[f64]; 3]; M]>,
        place: usize,
    ) -> [V3<Pack>; M] {
        let mut rates = [[Pack::of(0.0); 3]; M];
        for i in 0..M {
            rates[i] = each(|axis| Pack::of(self.constant[i][axis]));
        }
        for own in &self.own {
            let direction = each(|axis| Pack::of(own.direction[axis]));
            for i in 0..M {
                let rate = own.rate(dot(spins[i], direction), place);
                rates[i] = plus(rates[i], rate, direction);
            }
        }
        if let Some(matrix) = &self.anisotropy {
            for i in 0..M {
                rates[i] = multiplied(rates[i], matrix, spins[i]);
            }
        }
        if let Some(further) = further {
            for i in 0..M {
                rates[i] = sum(rates[i], further[i].row(place));
            }
        }
        rates
    }

    /// Adds damping and velocity to ω = ∂H/∂s at the nodes.
    #[inline(always)]
    fn drive(&self, spins: &[V3<Pack>; M], rates: &mut [V3<Pack>; M], place: usize) {
        let velocity = self.velocity.as_ref().map(|_| self.velocity_of(spins, rates, place));
        if let Some(damping) = &self.damping {
            for i in 0..M {
                let fall = cross(spins[i], rates[i]);
                rates[i] = each(|axis| fall[axis].by_plus(damping[axis], rates[i][axis]));
            }
        }
        for (rate, own) in rates.iter_mut().zip(velocity.iter().flatten()) {
            *rate = sum(*rate, *own);
        }
    }

    /// The velocities of a pack, one site after the other.
    #[inline(never)]
    fn velocity_of(
        &self,
        spins: &[V3<Pack>; M],
        rates: &[V3<Pack>; M],
        place: usize,
    ) -> [V3<Pack>; M] {
        let mut all = [[Pack::of(0.0); 3]; M];
        let Some((UserFunction(velocity), sites)) = &self.velocity else { return all };
        for lane in 0..LANES {
            let Some(site) = sites[place + lane] else { continue };
            for i in 0..M {
                let [spin, rate] =
                    [&spins[i], &rates[i]].map(|of| [of[0].0[lane], of[1].0[lane], of[2].0[lane]]);
                let own = velocity(self.times[i], site, spin, rate);
                (0..3).for_each(|axis| all[i][axis].0[lane] = own[axis]);
            }
        }
        all
    }
}

/// A quaternion (w, i, j, k).
type Quaternion = [Pack; 4];

#[inline(always)]
fn one() -> Quaternion {
    let zero = Pack::of(0.0);
    [Pack::of(1.0), zero, zero, zero]
}

#[inline(always)]
fn product([a, i, j, k]: Quaternion, [b, p, q, r]: Quaternion) -> Quaternion {
    let (u, v) = ([i, j, k], [p, q, r]);
    let [x, y, z] = plus(plus(cross(u, v), a, v), b, u);
    [a.times_plus(b, -dot(u, v)), x, y, z]
}

#[inline(always)]
fn inverse(q: Quaternion) -> Quaternion {
    let factor = Pack::of(1.0) / Pack::squares(q);
    [q[0] * factor, -q[1] * factor, -q[2] * factor, -q[3] * factor]
}

/// q v q̄, and |q|².
#[inline(always)]
fn turned([w, x, y, z]: Quaternion, v: V3<Pack>) -> (V3<Pack>, Pack) {
    let u = [x, y, z];
    let (along, square) = (dot(u, v), dot(u, u));
    let own = w * w;
    let turned = plus(scaled(own - square, v), w.by(2.0), cross(u, v));
    (plus(turned, along.by(2.0), u), own + square)
}

/// The solution of Qᵢ + Σ aᵢⱼ ωⱼ Qⱼ = 1, by elimination over the quaternions.
#[inline(always)]
fn solved<const M: usize>(matrix: &[[f64; M]; M], rates: &[V3<Pack>; M]) -> [Quaternion; M] {
    let mut rows = [[one(); M]; M];
    for i in 0..M {
        for j in 0..M {
            let [x, y, z] = scaled(Pack::of(matrix[i][j]), rates[j]);
            rows[i][j] = [Pack::of(if i == j { 1.0 } else { 0.0 }), x, y, z];
        }
    }
    let mut right = [one(); M];
    let mut inverses = right;
    for k in 0..M {
        inverses[k] = inverse(rows[k][k]);
        for i in k + 1..M {
            let factor = product(rows[i][k], inverses[k]);
            for j in k + 1..M {
                rows[i][j] = less(rows[i][j], product(factor, rows[k][j]));
            }
            right[i] = less(right[i], product(factor, right[k]));
        }
    }
    for k in (0..M).rev() {
        let mut rest = right[k];
        for j in k + 1..M {
            rest = less(rest, product(rows[k][j], right[j]));
        }
        right[k] = product(inverses[k], rest);
    }
    right
}

#[inline(always)]
fn less(a: Quaternion, b: Quaternion) -> Quaternion {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}
