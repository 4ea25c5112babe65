//! The laws every map of a generating function must pass, measured at a point.
//!
//! Derivatives are central differences of twelfth order, so that a law that holds shows up to about
//! 1e-13; their spacing becomes finer until the defect that they show is within its bound or settles. Defects are relative
//! to the size of what is compared.

use alloc::vec::Vec;

use crate::chart::Chart;
use crate::error::StepError;
use crate::generating::{Reversed, VectorOf};
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::{Integrator, solve};
use crate::step::monitor::Monitor;
use crate::step::{advance, poisson_map};

/// A law tried on a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The name of the law: one word, the same in every version.
    pub name: &'static str,
    /// The largest relative defect found at the points tried; not a number where it could not be measured at any, since
    /// differences did not settle.
    pub value: f64,
    /// The defect up to which the law is taken to hold.
    pub bound: f64,
}

impl Law {
    /// True if the law holds; not if the defect is NaN.
    #[must_use]
    pub fn pass(&self) -> bool {
        self.value <= self.bound
    }

    /// True if it could be measured.
    #[must_use]
    pub fn is_measured(&self) -> bool {
        !self.value.is_nan()
    }
}

/// The bound of laws that need derivatives by differences.
const DIFFERENCES: f64 = 1e-9;
/// The bound of laws that hold to rounding.
const ROUNDING: f64 = 1e-12;

/// Tries every law at each of `points` and returns the worst defects: those of [`check_map`] and `inverse`.
///
/// # Errors
/// [`StepError`] where a map cannot be made.
pub fn check<S>(
    map: &S,
    backward: Option<&S>,
    points: &[Phase<S::Group>],
) -> Result<Vec<Law>, StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64>,
{
    let mut there = |phase: &mut Phase<S::Group>| advance(map, phase).map(|_| ());
    let mut laws = match backward {
        None => check_map(map.group(), &mut there, None, points)?,
        Some(backward) => {
            let mut back = |phase: &mut Phase<S::Group>| advance(backward, phase).map(|_| ());
            check_map(map.group(), &mut there, Some(&mut back), points)?
        }
    };
    let by_logarithm = laws.iter().any(|law| law.name == "symplectic");
    for point in points {
        if !by_logarithm {
            check_in_chart(map, point, &mut laws)?;
        }
        let covered = poisson_map(map, &point.momentum)?;
        let back = poisson_map(&Reversed(map), &covered)?;
        note(&mut laws, "inverse", relative(&back, &point.momentum), ROUNDING);
    }
    Ok(laws)
}

/// Tries `symplectic` at one point more where the group has no logarithm: the chart gives the derivative.
///
/// # Errors
/// [`StepError`] where the map cannot be made.
pub fn check_in_chart<S>(
    map: &S,
    point: &Phase<S::Group>,
    laws: &mut Vec<Law>,
) -> Result<(), StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64>,
{
    note_settled(laws, "symplectic", symplectic_defect_in_chart(map, point)?);
    Ok(())
}

/// Makes a step of a state.
pub type Advance<'a, G> = dyn FnMut(&mut Phase<G>) -> Result<(), StepError> + 'a;

/// Tries the laws that any map of T\*G must pass, given as that which advances a state, at each of `points` and returns the
/// worst defects: `poisson` (up to 64 dimensions; it follows from the next two), `symplectic` (where the group has a logarithm;
/// beyond these dimensions on some tangent vectors), `equivariant`, `momentum`, `casimirs`, `diagram`, and, where the map of the
/// negative step is given, `symmetric`.
///
/// # Errors
/// [`StepError`] where a step cannot be made.
pub fn check_map<G: LieGroup<Scalar = f64>>(
    group: &G,
    there: &mut Advance<'_, G>,
    back: Option<&mut Advance<'_, G>>,
    points: &[Phase<G>],
) -> Result<Vec<Law>, StepError> {
    let mut laws = Vec::new();
    for point in points {
        check_derivatives(group, there, point, &mut laws)?;
    }
    laws.extend(check_exact(group, there, back, points)?);
    Ok(laws)
}

/// Tries the laws of [`check_map`] that take derivatives, `poisson` and `symplectic`, at one point more than those that `laws` has
/// been tried at.
///
/// # Errors
/// [`StepError`] where a step cannot be made.
pub fn check_derivatives<G: LieGroup<Scalar = f64>>(
    group: &G,
    there: &mut Advance<'_, G>,
    point: &Phase<G>,
    laws: &mut Vec<Law>,
) -> Result<(), StepError> {
    if group.dim() <= MANY {
        let defect = poisson_defect(group, &point.momentum, &mut |mu| covered(group, there, mu))?;
        note_settled(laws, "poisson", defect);
    }
    if let Some(defect) = symplectic_defect_of(group, point, there)? {
        note_settled(laws, "symplectic", defect);
    }
    Ok(())
}

/// The map of momenta that a map of T\*G covers.
fn covered<G: LieGroup<Scalar = f64>>(
    group: &G,
    there: &mut Advance<'_, G>,
    mu: &G::Vector,
) -> Result<G::Vector, StepError> {
    let mut state = Phase::<G>::new(group.identity(), mu.clone());
    there(&mut state).map(|()| state.momentum)
}

/// Tries the laws of [`check_map`] that take no derivatives.
///
/// # Errors
/// [`StepError`] where a step cannot be made.
pub fn check_exact<G: LieGroup<Scalar = f64>>(
    group: &G,
    there: &mut Advance<'_, G>,
    mut back: Option<&mut Advance<'_, G>>,
    points: &[Phase<G>],
) -> Result<Vec<Law>, StepError> {
    let mut laws: Vec<Law> = Vec::new();
    for (at, point) in points.iter().enumerate() {
        let covered = covered(group, there, &point.momentum)?;
        let mut image = point.clone();
        there(&mut image)?;
        // Φ(k·α) = k·Φ(α) for some k other than the point's own element; the last point is its own neighbour's.
        let k = points.get(at + 1).map_or(&point.group_element, |next| &next.group_element);
        let mut moved = Phase::new(group.compose(k, &point.group_element), point.momentum.clone());
        there(&mut moved)?;
        let element = group.compose(k, &image.group_element);
        let difference = element_difference(group, &moved.group_element, &element);
        let difference = difference.worse(relative(&moved.momentum, &image.momentum));
        note(&mut laws, "equivariant", difference, ROUNDING);
        // J_L(Φ(α)) = J_L(α)
        let spatial = relative(&image.spatial_momentum(group), &point.spatial_momentum(group));
        note(&mut laws, "momentum", spatial, ROUNDING);
        // C(Φ(μ)) = C(μ), relative to the scale of `Drift::casimirs`.
        let mut monitor = Monitor::new(group.clone(), point, 1.0);
        monitor.observe(&image, 1.0);
        note(&mut laws, "casimirs", monitor.drift().casimirs, ROUNDING);
        // J_R∘Φ̂ = Φ∘J_R: the map of T\*G covers that of 𝔤\*.
        note(&mut laws, "diagram", relative(&image.momentum, &covered), ROUNDING);
        // Φ_{−h}∘Φ_h = id
        if let Some(back) = &mut back {
            back(&mut image)?;
            note(&mut laws, "symmetric", relative(&image.momentum, &point.momentum), ROUNDING);
        }
    }
    Ok(laws)
}

/// Notes a defect by differences; points at which these do not settle leave it to the others.
fn note_settled(laws: &mut Vec<Law>, name: &'static str, value: f64) {
    match laws.iter_mut().find(|law| law.name == name) {
        Some(law) if law.value.is_nan() => law.value = value,
        Some(_) if value.is_nan() => {}
        _ => note(laws, name, value, DIFFERENCES),
    }
}

fn note(laws: &mut Vec<Law>, name: &'static str, value: f64, bound: f64) {
    match laws.iter_mut().find(|law| law.name == name) {
        // NaN must stay.
        Some(law) if law.value.is_nan() || value <= law.value => {}
        Some(law) => law.value = value,
        None => laws.push(Law { name, value, bound }),
    }
}

/// The largest difference of two vectors, relative to the larger of them.
fn relative<V: Coordinates<f64>>(a: &V, b: &V) -> f64 {
    let scale = a.largest_entry().max(b.largest_entry()).max(f64::MIN_POSITIVE);
    let mut worst = 0.0;
    for i in 0..a.dim() {
        let difference = (a[i] - b[i]).abs();
        if difference.is_nan() || difference > worst {
            worst = difference;
        }
    }
    worst / scale
}

/// The largest difference of two elements as matrices, relative to their largest entry.
fn element_difference<G: LieGroup<Scalar = f64>>(group: &G, a: &G::Element, b: &G::Element) -> f64 {
    let (mut entries, mut worst, mut scale) = (Vec::new(), 0.0_f64, 1.0_f64);
    group.matrix_entries(a, &mut |_, _, entry| entries.push(entry));
    let mut others = entries.into_iter();
    group.matrix_entries(b, &mut |_, _, b| {
        let a = others.next().unwrap_or(f64::NAN);
        worst = worst.worse((a - b).abs());
        scale = scale.max(a.abs()).max(b.abs());
    });
    worst / scale
}

/// Reasons for which an order could not be measured.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OrderError {
    /// A step failed.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The differences are lost in rounding, or not smaller than the solution.
    #[error(
        "the order cannot be seen between {coarse:.1e} and {fine:.1e}: choose steps that leave \
         both differences well above rounding and below one"
    )]
    OutOfRange {
        /// Relative difference of the two coarser runs.
        coarse: f64,
        /// Relative difference of the two finer runs.
        fine: f64,
    },
}

/// The order of a method over the time `time`, from runs with `steps`, 2·`steps` and 4·`steps`
/// steps: the binary logarithm of the ratio of their successive differences, in momentum and
/// group element. `run(h, n, state)` makes n steps of size h.
///
/// # Errors
/// [`OrderError`] where a step fails or the differences say nothing.
pub fn measured_order<G: LieGroup<Scalar = f64>>(
    group: &G,
    start: &Phase<G>,
    time: f64,
    steps: u32,
    run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Result<f64, OrderError> {
    let [coarse, fine] = differences(group, start, time, steps, run)?;
    if !(coarse < 0.5 && fine > 1e-13) {
        return Err(OrderError::OutOfRange { coarse, fine });
    }
    Ok(nalgebra::ComplexField::ln(coarse / fine) / core::f64::consts::LN_2)
}

/// The differences of runs over the time `time` with `steps` and 2·`steps`, and with 2·`steps` and 4·`steps` steps, in
/// momentum and group element, relative to these. `run(h, n, state)` makes n steps of size h.
///
/// # Errors
/// A step fails.
pub fn differences<G: LieGroup<Scalar = f64>>(
    group: &G,
    start: &Phase<G>,
    time: f64,
    steps: u32,
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Result<[f64; 2], StepError> {
    let mut end = |steps: u32| {
        let mut state = start.clone();
        run(time / f64::from(steps), steps, &mut state).map(|()| state)
    };
    let ends = [end(steps)?, end(2 * steps)?, end(4 * steps)?];
    let difference = |a: &Phase<G>, b: &Phase<G>| {
        let elements = element_difference(group, &a.group_element, &b.group_element);
        elements.worse(relative(&a.momentum, &b.momentum))
    };
    Ok([difference(&ends[0], &ends[1]), difference(&ends[1], &ends[2])])
}

/// Weights of the central difference of twelfth order at ±1 … ±6 steps (B. Fornberg, Math. Comp. 51 (1988) 699).
const WEIGHTS: [f64; 6] =
    [6.0 / 7.0, -15.0 / 56.0, 5.0 / 63.0, -1.0 / 56.0, 1.0 / 385.0, -1.0 / 5544.0];

/// The widest spacing of the differences, relative to the momentum: rounding enters with 1e-16/spacing, the
/// neglected thirteenth derivative with spacing¹².
const WIDEST: f64 = 0.015;
/// The number of spacings, each a quarter of the one before: at the finest rounding is near the bound.
const SPACINGS: u32 = 7;

/// The defect that differences settle on: the first within the bound, else that of the finest spacing, where the one before
/// shows the same up to a tenth; else not a number. Spacings that lead to where a step fails are too wide.
fn settled(mut defect: impl FnMut(f64) -> Result<Option<f64>, StepError>) -> Option<f64> {
    let (mut spacing, mut last, mut before) = (WIDEST, f64::NAN, f64::NAN);
    for _ in 0..SPACINGS {
        if let Ok(found) = defect(spacing) {
            let found = found?;
            if found <= DIFFERENCES {
                return Some(found);
            }
            (before, last) = (last, found);
        }
        spacing *= 0.25;
    }
    Some(if (last - before).abs() <= 0.1 * last { last } else { f64::NAN })
}

type MapOf<'a, V> = dyn FnMut(&V) -> Result<V, StepError> + 'a;

/// The derivative at 0 of `f`, in coordinates.
fn derivative<V: Coordinates<f64>, const K: usize>(
    dim: usize,
    step: f64,
    f: &mut dyn FnMut(f64) -> Result<Option<[V; K]>, StepError>,
) -> Result<Option<[V; K]>, StepError> {
    let mut sum: [V; K] = core::array::from_fn(|_| V::zeros(dim));
    for (k, weight) in WEIGHTS.into_iter().enumerate() {
        let offset = step * (k + 1) as f64;
        let (Some(ahead), Some(behind)) = (f(offset)?, f(-offset)?) else {
            return Ok(None);
        };
        for ((sum, ahead), behind) in sum.iter_mut().zip(ahead).zip(behind) {
            *sum = V::from_entries(dim, |i| sum[i] + weight / step * (ahead[i] - behind[i]));
        }
    }
    Ok(Some(sum))
}

fn shifted<V: Coordinates<f64>>(v: &V, i: usize, by: f64) -> V {
    let mut result = v.clone();
    result[i] += by;
    result
}

/// DΦ B(μ) DΦᵀ = B(Φ(μ)), with B_jk(μ) = −⟨μ, [e_j, e_k]⟩: the largest difference of an entry,
/// relative to the largest entry of B or of the products summed.
pub(super) fn poisson_defect<G: LieGroup<Scalar = f64>>(
    group: &G,
    mu: &G::Vector,
    map: &mut MapOf<'_, G::Vector>,
) -> Result<f64, StepError> {
    let image = map(mu)?;
    let size = mu.largest_entry().max(f64::MIN_POSITIVE);
    let defect =
        settled(|spacing| poisson_defect_by(group, mu, &image, map, spacing * size).map(Some));
    Ok(defect.unwrap_or(f64::NAN))
}

/// The defect by differences of this spacing.
fn poisson_defect_by<G: LieGroup<Scalar = f64>>(
    group: &G,
    mu: &G::Vector,
    image: &G::Vector,
    map: &mut MapOf<'_, G::Vector>,
    step: f64,
) -> Result<f64, StepError> {
    let dim = group.dim();
    let mut columns = Vec::with_capacity(dim);
    for i in 0..dim {
        let mut image = |s: f64| map(&shifted(mu, i, s)).map(|image| Some([image]));
        if let Some([column]) = derivative(dim, step, &mut image)? {
            columns.push(column);
        }
    }
    let (here, there) = (tensor(group, mu), tensor(group, image));
    // DΦ B first, then times DΦᵀ: n³ products, not n⁴.
    let half: Vec<Vec<f64>> = (0..dim)
        .map(|r| (0..dim).map(|k| (0..dim).map(|j| columns[j][r] * here[j][k]).sum()).collect())
        .collect();
    let (mut worst, mut scale) = (0.0_f64, f64::MIN_POSITIVE);
    for r in 0..dim {
        for s in r + 1..dim {
            let expected = there[r][s];
            let mut found = 0.0;
            for (k, column) in columns.iter().enumerate() {
                let product = half[r][k] * column[s];
                found += product;
                scale = scale.max(product.abs());
            }
            scale = scale.max(expected.abs()).max(here[r][s].abs());
            let difference = (found - expected).abs();
            if difference.is_nan() {
                return Ok(f64::NAN);
            }
            worst = worst.max(difference);
        }
    }
    Ok(worst / scale)
}

/// B_jk(μ) = −⟨μ, [e_j, e_k]⟩.
fn tensor<G: LieGroup<Scalar = f64>>(group: &G, mu: &G::Vector) -> Vec<Vec<f64>> {
    let dim = group.dim();
    let row = |j: usize| {
        let moved = group.ad_star(&Coordinates::unit(dim, j), mu);
        (0..dim).map(|k| -moved[k]).collect()
    };
    (0..dim).map(row).collect()
}

/// A tangent vector of T\*G in the left trivialisation.
struct Tangent<V> {
    xi: V,
    nu: V,
}

/// Beyond this many dimensions laws are tried on few states: ω is compared on 8 tangent vectors, for all of a basis take n steps for
/// each of n².
pub const MANY: usize = 64;
const SAMPLED: usize = 8;

/// The tangent vectors at μ on which ω is compared: a basis, or some with parts in all of its directions.
fn tangents<V: Coordinates<f64>>(mu: &V) -> impl Iterator<Item = Tangent<V>> {
    let (dim, size) = (mu.dim(), mu.largest_entry().max(f64::MIN_POSITIVE));
    let (all, count) = (2 * dim, if dim > MANY { SAMPLED } else { 2 * dim });
    let entry = move |number: usize, at: usize| match count == all {
        true => f64::from(u8::from(number == at)),
        false => nalgebra::ComplexField::sin(((number + 2) * (at + 1) * (at + 1)) as f64),
    };
    (0..count).map(move |number| Tangent {
        xi: V::from_entries(dim, |i| entry(number, i)),
        nu: V::from_entries(dim, |i| size * entry(number, dim + i)),
    })
}

/// Φ\*ω = ω on T\*G, ω((ξ₁, ν₁), (ξ₂, ν₂)) = ⟨ν₂, ξ₁⟩ − ⟨ν₁, ξ₂⟩ + ⟨μ, [ξ₁, ξ₂]⟩: the largest
/// difference on pairs of basis vectors, relative to the largest pairing, where the group has no logarithm (adjoint
/// matrices of an algebra with a centre): the chart gives the derivative.
pub(super) fn symplectic_defect_in_chart<S>(
    map: &S,
    point: &Phase<S::Group>,
) -> Result<f64, StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64>,
{
    let image = generated(map, &point.momentum)?.1;
    let defect = settled(|spacing| {
        let pairs = pairs_by_chart(map, &point.momentum, spacing)?;
        Ok(Some(form_defect(map.group(), &point.momentum, &image, &pairs)))
    });
    Ok(defect.unwrap_or(f64::NAN))
}

/// x and μ″ of the map of S alone: the frame moves by exact flows of functions of μ.
fn generated<S>(map: &S, mu: &VectorOf<S>) -> Result<(VectorOf<S>, VectorOf<S>), StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64>,
{
    let x = solve(map, mu)?.x;
    let moved = S::Chart::default().transport(map.group(), &x, mu).1;
    Ok((x, moved))
}

/// Basis vectors of T\*G with their images. g″ = g′τ(x) with x depending on μ′ only, so that
/// g″⁻¹δg″ = Ad_{τ(x)⁻¹}(ξ + d^Rτ_x δx).
fn pairs_by_chart<S>(
    map: &S,
    mu: &VectorOf<S>,
    spacing: f64,
) -> Result<Pairs<VectorOf<S>>, StepError>
where
    S: Integrator,
    S::Group: LieGroup<Scalar = f64>,
{
    let (group, chart) = (map.group(), S::Chart::default());
    let dim = group.dim();
    let x = solve(map, mu)?.x;
    let back = group.inverse(&chart.transport(group, &x, mu).0);
    // Row i of d^Rτ_x: the transpose applied to a basis vector.
    let rows: Vec<VectorOf<S>> =
        (0..dim).map(|i| chart.pull_back(group, &x, &Coordinates::unit(dim, i))).collect();
    let step = spacing * mu.largest_entry().max(f64::MIN_POSITIVE);
    let zero = VectorOf::<S>::zeros(dim);
    let mut pairs = Vec::with_capacity(2 * dim);
    for i in 0..dim {
        let turned =
            Tangent { xi: group.adjoint(&back, &Coordinates::unit(dim, i)), nu: zero.clone() };
        pairs.push((Tangent { xi: Coordinates::unit(dim, i), nu: zero.clone() }, turned));
    }
    for i in 0..dim {
        let mut both = |s: f64| {
            let mu = shifted(mu, i, s);
            let (x, image) = generated(map, &mu)?;
            Ok(Some([x, image]))
        };
        if let Some([slope, nu]) = derivative::<VectorOf<S>, 2>(dim, step, &mut both)? {
            let right = VectorOf::<S>::from_entries(dim, |row| rows[row].pairing(&slope));
            let image = Tangent { xi: group.adjoint(&back, &right), nu };
            pairs.push((Tangent { xi: zero.clone(), nu: Coordinates::unit(dim, i) }, image));
        }
    }
    Ok(pairs)
}

/// The symplectic defect of any map of T\*G that advances a state: the largest change of the canonical form
/// on pairs of basis vectors, relative to the largest pairing. `None` where the group has no logarithm; not a number where
/// differences do not settle.
///
/// # Errors
/// Returns the errors of `map`.
pub fn symplectic_defect_of<G: LieGroup<Scalar = f64>>(
    group: &G,
    point: &Phase<G>,
    map: &mut dyn FnMut(&mut Phase<G>) -> Result<(), StepError>,
) -> Result<Option<f64>, StepError> {
    let mut image = point.clone();
    map(&mut image)?;
    Ok(settled(|spacing| symplectic_defect_by(group, point, &image, map, spacing)))
}

/// The defect by differences of this spacing, of momenta relative to these.
fn symplectic_defect_by<G: LieGroup<Scalar = f64>>(
    group: &G,
    point: &Phase<G>,
    image: &Phase<G>,
    map: &mut dyn FnMut(&mut Phase<G>) -> Result<(), StepError>,
    spacing: f64,
) -> Result<Option<f64>, StepError> {
    let dim = group.dim();
    let back = group.inverse(&image.group_element);
    let mut pairs = Vec::new();
    for before in tangents(&point.momentum) {
        let mut at = |s: f64| -> Result<Phase<G>, StepError> {
            let turn = G::Vector::from_entries(dim, |i| s * before.xi[i]);
            let mut state = Phase::new(
                group.compose(&point.group_element, &group.exp(&turn)),
                G::Vector::from_entries(dim, |i| point.momentum[i] + s * before.nu[i]),
            );
            map(&mut state)?;
            Ok(state)
        };
        let slopes = derivative(dim, spacing, &mut |s| {
            let image = at(s)?;
            let turn = group.log(&group.compose(&back, &image.group_element));
            Ok(turn.map(|turn| [turn, image.momentum]))
        })?;
        let Some([xi, nu]) = slopes else {
            return Ok(None);
        };
        pairs.push((before, Tangent { xi, nu }));
    }
    Ok(Some(form_defect(group, &point.momentum, &image.momentum, &pairs)))
}

type Pairs<V> = Vec<(Tangent<V>, Tangent<V>)>;

/// The largest difference of ω at `mu` and of ω at `image` on the images.
fn form_defect<G: LieGroup<Scalar = f64>>(
    group: &G,
    mu: &G::Vector,
    image: &G::Vector,
    pairs: &Pairs<G::Vector>,
) -> f64 {
    let form = |mu: &G::Vector, a: &Tangent<G::Vector>, b: &Tangent<G::Vector>| {
        let terms =
            [b.nu.pairing(&a.xi), -a.nu.pairing(&b.xi), mu.pairing(&group.bracket(&a.xi, &b.xi))];
        (terms.iter().sum::<f64>(), terms.iter().fold(0.0_f64, |m, t| m.max(t.abs())))
    };
    let (mut worst, mut scale) = (0.0_f64, f64::MIN_POSITIVE);
    for (i, (a, a_image)) in pairs.iter().enumerate() {
        for (b, b_image) in pairs.iter().skip(i + 1) {
            let (before, size) = form(mu, a, b);
            let (after, image_size) = form(image, a_image, b_image);
            let difference = (after - before).abs();
            if difference.is_nan() {
                return f64::NAN;
            }
            worst = worst.max(difference);
            scale = scale.max(size).max(image_size);
        }
    }
    worst / scale
}
