//! Steps composed of exact rotations.

use alloc::vec::Vec;
use core::fmt;

use coadjoint_geometry::angle::{Angle, Length};
use coadjoint_geometry::number::Number;
use coadjoint_geometry::rotation::Turn;
use coadjoint_geometry::vector::{V3, cross, difference, dot, each, plus, scaled, sum};
use nalgebra::{Matrix3, Vector3};

use super::colours;
use super::composition::Order;
use super::couplings::{
    Bond, Couplings, Dyad, Energies, Own, UserFunction, by_directions, directions, dyads,
};
use super::error::{LatticeError, check_spins, check_step};
use super::family::Family;
use super::lanes::{LANES, Pack};
use super::layout::{Column, Pairs, Piece, Places, Spins, each_pack, row, split};
use super::threads;

/// Steps of a lattice of spins, composed of exact rotations: the length of each spin is kept to rounding.
///
/// ```
/// use coadjoint::lattice::{Family, Graph, Lattice, Order};
/// use nalgebra::Matrix3;
///
/// let ferromagnet = Lattice::new(Graph::cubic([4; 3])?).nearest(-Matrix3::identity())?;
/// let mut spins: Vec<[f64; 3]> = (0..64).map(|i| [(f64::from(i)).sin(), (f64::from(i)).cos(), 0.5]).collect();
/// let before = ferromagnet.energy(&spins)?;
/// let mut step = ferromagnet.rotations(Family::Bonds, Order::Six, 0.1)?;
/// step.advance_by(&mut spins, 100)?;
/// assert!((ferromagnet.energy(&spins)? - before).abs() < 1e-5);
/// # Ok::<(), coadjoint::lattice::LatticeError>(())
/// ```
pub struct RotationStep {
    couplings: Couplings,
    parts: Vec<Summand>,
    step: f64,
    /// The parts of a step with their lengths in time.
    sequence: Vec<(usize, f64)>,
    /// The largest speed of each part for spins of length zero, and by how much it grows with the largest length.
    speeds: Vec<[f64; 2]>,
    spins: Spins,
    /// The components of spins along a direction that is no axis.
    along: Column,
}

/// An energy whose flow is known.
enum Summand {
    Axis(Axis),
    Pairs(Pairs, Exchange),
    /// The sites of a colour in the field of the others.
    Colour(usize, [f64; 3]),
    Sites(Site, Option<Own<Option<Column>>>),
    /// All sites in the field that depends on time.
    Driven(UserFunction<dyn Fn(f64) -> [f64; 3] + Send + Sync>),
}

/// Energies of the components along a direction, of all sites.
struct Axis {
    direction: Site,
    /// The number of the axis, if it is one.
    axis: Option<usize>,
    /// The direction of sites whose colour has this bit, if that is another.
    crossed: Option<(u32, [f64; 3])>,
    /// The weights of couplings; those of crossed directions are antisymmetric.
    weights: Vec<f64>,
    own: Option<Own<Option<Column>>>,
}

/// An energy of pairs of sites.
#[derive(Clone, Copy)]
enum Exchange {
    Isotropic(f64),
    Dyad(Dyad),
}

/// The energy linear·c + ½ square·c² of each site, c its component along a direction.
#[derive(Clone, Copy)]
struct Site {
    direction: [f64; 3],
    linear: f64,
    square: f64,
}

impl fmt::Debug for RotationStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (parts, flows) = (self.parts.len(), self.sequence.len());
        write!(f, "RotationStep {{ parts: {parts}, flows: {flows} }}")
    }
}

impl RotationStep {
    pub(super) fn new(
        sites: usize,
        energies: &Energies,
        family: Family,
        order: Order,
        step: f64,
    ) -> Result<Self, LatticeError> {
        check_step(step)?;
        if energies.is_driven() {
            return Err(LatticeError::NotAdmitted { family });
        }
        let couplings =
            Couplings::new(sites, &energies.bonds, matches!(family, Family::Axes { .. }));
        let mut parts = match family {
            Family::Axes { shift } => axes(&couplings, energies, shift),
            Family::Bonds => {
                let mut parts = pairs(sites, &couplings, energies);
                parts.extend(single(&couplings.places, energies, energies.field));
                parts
            }
            Family::Sublattices => {
                // The field is held with that of the neighbours, unless an anisotropy has a flow of its own.
                let mut sites = single(&couplings.places, energies, Vector3::zeros());
                let mut held = energies.field;
                if !sites.is_empty() {
                    sites = single(&couplings.places, energies, held);
                    held = Vector3::zeros();
                }
                let colours = 0..couplings.places.colours.len();
                let colours = colours.map(|colour| Summand::Colour(colour, held.into()));
                colours.chain(sites).collect()
            }
        };
        let driven = energies.driven.clone();
        parts.extend(driven.map(Summand::Driven));
        let speeds = parts.iter().map(|part| speed(part, &couplings)).collect();
        // After all parts comes the time itself, where one depends on it.
        let sequence = order.sequence(parts.len() + usize::from(energies.driven.is_some()));
        let sequence = sequence.into_iter().map(|(part, length)| (part, length * step)).collect();
        let length = couplings.copies.length();
        let (spins, along) = (Spins::new(length, 0), Column::new(length, 3));
        Ok(Self { couplings, parts, step, sequence, speeds, spins, along })
    }

    /// Advances the spins, in the order of the graph's sites, by `steps` steps.
    ///
    /// # Errors
    /// [`LatticeError::Sites`] and [`LatticeError::NonFinite`]; the spins are then as they were.
    pub fn advance_by(&mut self, spins: &mut [[f64; 3]], steps: u64) -> Result<(), LatticeError> {
        self.advance_from(spins, 0.0, steps)
    }

    /// As [`RotationStep::advance_by`], from this time on, of which the field that depends on time is a function.
    ///
    /// # Errors
    /// As [`RotationStep::advance_by`].
    pub fn advance_from(
        &mut self,
        spins: &mut [[f64; 3]],
        start: f64,
        steps: u64,
    ) -> Result<(), LatticeError> {
        check_spins(self.couplings.places.sites(), spins)?;
        self.couplings.places.scatter(spins, &mut self.spins);
        let squares = spins.iter().map(|[x, y, z]| x * x + y * y + z * z);
        let length = squares.fold(0.0, f64::max).sqrt();
        for n in 0..steps {
            let mut now = start + n as f64 * self.step;
            for at in 0..self.sequence.len() {
                let (part, time) = self.sequence[at];
                let Some(&[least, slope]) = self.speeds.get(part) else {
                    now += time;
                    continue;
                };
                match (time * slope.times_plus(length, least)).abs() <= SHORT_TURN {
                    true => self.flow::<true>(part, time, now),
                    false => self.flow::<false>(part, time, now),
                }
            }
        }
        self.couplings.places.gather(&self.spins, spins);
        Ok(())
    }

    /// The flow of a part of the energy, as it is now, in which all spins turn by a short angle, or by any.
    fn flow<const SHORT: bool>(&mut self, part: usize, time: f64, now: f64) {
        let Self { couplings, spins, along, .. } = self;
        let places = couplings.places.len();
        match &self.parts[part] {
            Summand::Axis(part) => match part.axis {
                Some(axis) => about_axis::<SHORT>(couplings, part, axis, time, spins),
                None => {
                    let colours = || couplings.places.colours.iter().zip(0_u32..);
                    let [x, y, z] = spins.all();
                    for (range, colour) in colours() {
                        let (direction, _) = part.of_colour(colour);
                        for (at, own) in range.clone().zip(&mut along.all_mut()[range.clone()]) {
                            *own = dot([x[at], y[at], z[at]], direction);
                        }
                    }
                    couplings.copies.refresh(along.all_mut(), couplings.copies.all());
                    let along = along.all();
                    for (range, colour) in colours() {
                        let (direction, sign) = part.of_colour(colour);
                        let first = range.start / LANES;
                        each_pack(
                            split(spins, range).1,
                            range.len(),
                            #[inline(always)]
                            |pack, spin| {
                                let field = part.rate(couplings, along, first + pack);
                                about::<SHORT>(direction, field.by(sign * time), spin)
                            },
                        );
                    }
                }
            },
            Summand::Pairs(pairs, exchange) => {
                let columns = spins.all_mut();
                threads::wide(
                    #[inline(always)]
                    || exchange_all::<SHORT>(pairs, *exchange, time, columns),
                );
            }
            Summand::Colour(colour, field) => {
                let range = &couplings.places.colours[*colour];
                let lists = couplings.copies.of_colour[*colour].clone();
                for column in spins.all_mut() {
                    couplings.copies.refresh(column, lists.clone());
                }
                let (around, own) = split(spins, range);
                let first = range.start / LANES;
                each_pack(
                    own,
                    range.len(),
                    #[inline(always)]
                    |pack, spin| {
                        let field = each(|axis| Pack::of(field[axis]));
                        let [field] = couplings.fields([field], [&around], first + pack);
                        let x = scaled(Pack::of(time), field);
                        turn::<SHORT>(x).back(spin)
                    },
                );
            }
            Summand::Sites(site, own) => {
                each_pack(
                    spins.all_mut(),
                    places,
                    #[inline(always)]
                    |pack, spin| {
                        let along = dot(spin, each(|axis| Pack::of(site.direction[axis])));
                        let mut rate = site.rate(along);
                        if let Some(own) = own {
                            rate = rate + own.rate(along, pack * LANES);
                        }
                        about::<SHORT>(site.direction, rate.by(time), spin)
                    },
                );
            }
            Summand::Driven(UserFunction(field)) => {
                let field = field(now);
                let turn = turn::<SHORT>(each(|axis| Pack::of(field[axis] * time)));
                each_pack(
                    spins.all_mut(),
                    places,
                    #[inline(always)]
                    |_, spin| turn.back(spin),
                );
            }
        }
    }
}

impl Site {
    /// The speed of rotation about the direction.
    #[inline(always)]
    fn rate(&self, along: Pack) -> Pack {
        along.by_plus(self.square, Pack::of(self.linear))
    }
}

impl Axis {
    /// The direction of the sites of a colour, and the sign of their weights.
    fn of_colour(&self, colour: u32) -> ([f64; 3], f64) {
        match self.crossed {
            Some((bit, direction)) if colour >> bit & 1 == 1 => (direction, -1.0),
            _ => (self.direction.direction, 1.0),
        }
    }

    /// The speed of rotation of a pack about the direction, along which all spins have these components.
    #[inline(always)]
    fn rate(&self, couplings: &Couplings, along: &[f64], pack: usize) -> Pack {
        let of_pack = row(along, pack * LANES);
        let rate = self.direction.rate(of_pack) + couplings.along(&self.weights, along, pack);
        match &self.own {
            Some(own) => rate + own.rate(of_pack, pack * LANES),
            None => rate,
        }
    }
}

/// Angles up to which rotations have a short series: less than a quarter turn.
const SHORT_TURN: f64 = 1.5;

#[inline(always)]
fn reach(short: bool) -> Length {
    if short { Length::Short } else { Length::Any }
}

/// The rotation by a vector.
#[inline(always)]
fn turn<const SHORT: bool>(x: V3<Pack>) -> Turn<Pack> {
    let angle = Angle::new(x, reach(SHORT));
    Turn { w: angle.half_cosine, s: angle.half_sine, x }
}

/// Spins turned about a unit vector.
#[inline(always)]
fn about<const SHORT: bool>(direction: [f64; 3], by: Pack, spin: V3<Pack>) -> V3<Pack> {
    let angle = Angle::new([by], reach(SHORT));
    let x = each(|axis| Pack::of(direction[axis]));
    Turn { w: angle.half_cosine, s: angle.half_sine * by, x }.back(spin)
}

/// The flow of the energies along an axis, in which the other two components turn.
fn about_axis<const SHORT: bool>(
    couplings: &Couplings,
    part: &Axis,
    axis: usize,
    time: f64,
    spins: &mut Spins,
) {
    let [x, y, z] = &mut spins.0;
    let (along, u, v) = match axis {
        0 => (x, y, z),
        1 => (y, z, x),
        _ => (z, x, y),
    };
    couplings.copies.refresh(along.all_mut(), couplings.copies.all());
    let along = along.all();
    each_pack(
        [u.all_mut(), v.all_mut()],
        couplings.places.len(),
        #[inline(always)]
        |pack, [u, v]| {
            let by = part.rate(couplings, along, pack).by(time);
            let angle = Angle::new([by], reach(SHORT));
            let half = angle.half_sine * by;
            let sine = (half * angle.half_cosine).by(2.0);
            let cosine = half.by_plus(-2.0, Pack::of(0.0)).times_plus(half, Pack::of(1.0));
            [u.times_plus(cosine, v * sine), v.times_plus(cosine, -u * sine)]
        },
    );
}

/// The flow of energies of pairs, none of which share a site.
#[inline(always)]
fn exchange_all<const SHORT: bool>(
    pairs: &Pairs,
    exchange: Exchange,
    time: f64,
    columns: Piece<'_>,
) {
    match exchange {
        // Both turn about their sum, by opposite changes.
        Exchange::Isotropic(factor) => pairs.replace(
            columns,
            #[inline(always)]
            |s, t, own| {
                let turn = turn::<SHORT>(scaled(own.by(factor * time), sum(s, t)));
                let once = cross(s, turn.x);
                let doubled = turn.s.by(2.0);
                let change =
                    plus(scaled(doubled * turn.w, once), doubled * turn.s, cross(once, turn.x));
                [sum(s, change), difference(t, change)]
            },
        ),
        Exchange::Dyad(Dyad { factor, left, right }) => pairs.replace(
            columns,
            #[inline(always)]
            |s, t, own| {
                let time = own.by(factor * time);
                let left_component = dot(s, each(|axis| Pack::of(left[axis])));
                let right_component = dot(t, each(|axis| Pack::of(right[axis])));
                [
                    about::<SHORT>(left, right_component * time, s),
                    about::<SHORT>(right, left_component * time, t),
                ]
            },
        ),
    }
}

/// The parts of the energy that depend on one component of each spin.
fn axes(couplings: &Couplings, energies: &Energies, shift: f64) -> Vec<Summand> {
    let symmetric = |matrix: &Matrix3<f64>| by_directions(&((matrix + matrix.transpose()) * 0.5));
    let weights: Vec<[f64; 6]> = couplings.matrices().map(symmetric).collect();
    let squares = by_directions(&(2.0 * energies.anisotropy - Matrix3::identity() * shift));
    let part = |(at, direction): (usize, [f64; 3])| {
        let axis = (at < 3).then_some(at);
        let linear = axis.map_or(0.0, |axis| energies.field[axis]);
        let weights: Vec<f64> = weights.iter().map(|list| list[at]).collect();
        let own = energies.own.iter().find(|own| own.direction == direction);
        let own = own.map(|own| own.placed(&couplings.places));
        let none = linear == 0.0 && squares[at] == 0.0 && weights.iter().all(|w| *w == 0.0);
        let direction = Site { direction, linear, square: squares[at] };
        let all = own.is_some() || !none;
        all.then_some(Summand::Axis(Axis { direction, axis, crossed: None, weights, own }))
    };
    let parts = directions().into_iter().enumerate().filter_map(part);
    // Antisymmetric parts Σ w aₚ b_q, p ≠ q: sites whose colours differ in a bit have the component p or q by it, and commute.
    let last = couplings.bits().flatten().max();
    let crossed = (0..last.map_or(0, |last| last + 1)).flat_map(|bit| {
        let pairs = [[0, 1], [1, 0], [1, 2], [2, 1], [2, 0], [0, 2]];
        pairs.into_iter().filter_map(move |[p, q]| {
            let weight = |(matrix, own): (&Matrix3<f64>, Option<u32>)| {
                let weight = 0.5 * (matrix[(p, q)] - matrix[(q, p)]);
                if own == Some(bit) { weight } else { 0.0 }
            };
            let weights: Vec<f64> =
                couplings.matrices().zip(couplings.bits()).map(weight).collect();
            let [direction, other] = [p, q].map(|at| directions()[at]);
            let direction = Site { direction, linear: 0.0, square: 0.0 };
            let crossed = Some((bit, other));
            let none = weights.iter().all(|weight| *weight == 0.0);
            (!none).then_some(Summand::Axis(Axis {
                direction,
                axis: None,
                crossed,
                weights,
                own: None,
            }))
        })
    });
    parts.chain(crossed).collect()
}

/// The energies of the edges of each bond and colour.
fn pairs(sites: usize, couplings: &Couplings, energies: &Energies) -> Vec<Summand> {
    let mut parts = Vec::new();
    for Bond { edges, matrix, factors } in &energies.bonds {
        let (isotropic, dyads) = dyads(matrix);
        let isotropic = (isotropic != 0.0).then_some(Exchange::Isotropic(isotropic));
        let exchanges = isotropic.into_iter().chain(dyads.into_iter().map(Exchange::Dyad));
        for exchange in exchanges {
            for colour in colours::edges(sites, edges) {
                let pairs = Pairs::new(&couplings.places, &colour, edges, factors.as_deref());
                parts.push(Summand::Pairs(pairs, exchange));
            }
        }
    }
    parts
}

/// The energies of single sites in a field.
fn single(places: &Places, energies: &Energies, mut field: Vector3<f64>) -> Vec<Summand> {
    // The isotropic part is a multiple of |s|² and moves nothing.
    let (_, dyads) = dyads(&energies.anisotropy);
    let mut sites = Vec::new();
    for Dyad { factor, left, right } in dyads {
        let axis = Vector3::from(left);
        let sign = axis.dot(&Vector3::from(right)).signum();
        let mut linear = 0.0;
        if field.cross(&axis).norm() <= 1e-15 * field.norm() {
            linear = field.dot(&axis);
            field = Vector3::zeros();
        }
        sites.push(Site { direction: left, linear, square: 2.0 * sign * factor });
    }
    let size = field.norm();
    if size > 0.0 {
        sites.push(Site { direction: (field / size).into(), linear: size, square: 0.0 });
    }
    let own = energies.own.iter().map(|own| {
        let none = Site { direction: own.direction, linear: 0.0, square: 0.0 };
        Summand::Sites(none, Some(own.placed(places)))
    });
    sites.into_iter().map(|site| Summand::Sites(site, None)).chain(own).collect()
}

/// The largest speed of rotation of a part for spins of length zero, and by how much it grows with the largest length.
fn speed(part: &Summand, couplings: &Couplings) -> [f64; 2] {
    match part {
        Summand::Axis(Axis { direction: Site { linear, square, .. }, weights, own, .. }) => {
            let most = couplings.most().zip(weights).map(|(most, weight)| most * weight.abs());
            let [least, slope] = own.as_ref().map_or([0.0; 2], Own::speed);
            [linear.abs() + least, square.abs() + slope + most.sum::<f64>()]
        }
        Summand::Pairs(pairs, Exchange::Isotropic(factor)) => {
            [0.0, 2.0 * factor.abs() * pairs.largest()]
        }
        Summand::Pairs(pairs, Exchange::Dyad(dyad)) => [0.0, dyad.factor.abs() * pairs.largest()],
        Summand::Colour(_, field) => {
            let most = couplings.most().zip(couplings.matrices());
            let most = most.map(|(most, matrix)| most * matrix.norm());
            [Vector3::from(*field).norm(), most.sum::<f64>()]
        }
        Summand::Sites(Site { linear, square, .. }, own) => {
            let [least, slope] = own.as_ref().map_or([0.0; 2], Own::speed);
            [linear.abs() + least, square.abs() + slope]
        }
        // It may be any, by the time.
        Summand::Driven(_) => [f64::INFINITY, 0.0],
    }
}
