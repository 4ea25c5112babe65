//! The laws every map of a generating function must pass, measured at a point.
//!
//! Derivatives are central differences of eighth order, so that a law that holds shows up to about
//! 1e-12. Defects are relative to the size of what is compared.

mod differences;

use alloc::vec::Vec;

use crate::error::StepError;
use crate::generating::Reversed;
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::laws::differences::{poisson_defect, symplectic_defect_in_chart};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::solve::Integrator;
use crate::step::monitor::Monitor;
use crate::step::{advance, poisson_map};

pub use differences::symplectic_defect_of;

/// A law tried on a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The name of the law: one word, the same in every version.
    pub name: &'static str,
    /// The largest relative defect found at the points tried.
    pub value: f64,
    /// The defect up to which the law is taken to hold.
    pub bound: f64,
}

impl Law {
    /// Whether the law holds; not if the defect is NaN.
    #[must_use]
    pub fn pass(&self) -> bool {
        self.value <= self.bound
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
            note(&mut laws, "symplectic", symplectic_defect_in_chart(map, point)?, DIFFERENCES);
        }
        let covered = poisson_map(map, &point.momentum)?;
        let back = poisson_map(&Reversed(map), &covered)?;
        note(&mut laws, "inverse", relative(&back, &point.momentum), ROUNDING);
    }
    Ok(laws)
}

/// Makes a step of a state.
pub type Advance<'a, G> = dyn FnMut(&mut Phase<G>) -> Result<(), StepError> + 'a;

/// Tries the laws that any map of T\*G must pass, given as that which advances a state, at each of `points` and returns the
/// worst defects: `poisson`, `symplectic` (where the group has a logarithm), `equivariant`, `momentum`, `casimirs`,
/// `diagram`, and, where the map of the negative step is given, `symmetric`.
///
/// # Errors
/// [`StepError`] where a step cannot be made.
pub fn check_map<G: LieGroup<Scalar = f64>>(
    group: &G,
    there: &mut Advance<'_, G>,
    mut back: Option<&mut Advance<'_, G>>,
    points: &[Phase<G>],
) -> Result<Vec<Law>, StepError> {
    let mut laws: Vec<Law> = Vec::new();
    for (at, point) in points.iter().enumerate() {
        let mut covered = |mu: &G::Vector| {
            let mut state = Phase::<G>::new(group.identity(), mu.clone());
            there(&mut state).map(|()| state.momentum)
        };
        let defect = poisson_defect(group, &point.momentum, &mut covered)?;
        note(&mut laws, "poisson", defect, DIFFERENCES);
        let covered = covered(&point.momentum)?;
        if let Some(defect) = symplectic_defect_of(group, point, there)? {
            note(&mut laws, "symplectic", defect, DIFFERENCES);
        }

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

/// Takes note of a defect.
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
    let size = group.matrix_size();
    let (mut worst, mut scale) = (0.0_f64, 1.0_f64);
    for i in 0..size {
        for j in 0..size {
            let (a, b) = (group.matrix_entry(a, i, j), group.matrix_entry(b, i, j));
            let difference = (a - b).abs();
            if difference.is_nan() {
                return f64::NAN;
            }
            worst = worst.max(difference);
            scale = scale.max(a.abs()).max(b.abs());
        }
    }
    worst / scale
}

/// Why an order could not be measured.
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
    mut run: impl FnMut(f64, u32, &mut Phase<G>) -> Result<(), StepError>,
) -> Result<f64, OrderError> {
    let mut end = |steps: u32| {
        let mut state = start.clone();
        run(time / f64::from(steps), steps, &mut state).map(|()| state)
    };
    let ends = [end(steps)?, end(2 * steps)?, end(4 * steps)?];
    let difference = |a: &Phase<G>, b: &Phase<G>| {
        let elements = element_difference(group, &a.group_element, &b.group_element);
        elements.worse(relative(&a.momentum, &b.momentum))
    };
    let coarse = difference(&ends[0], &ends[1]);
    let fine = difference(&ends[1], &ends[2]);
    if !(coarse < 0.5 && fine > 1e-12) {
        return Err(OrderError::OutOfRange { coarse, fine });
    }
    Ok(nalgebra::ComplexField::ln(coarse / fine) / core::f64::consts::LN_2)
}
