//! The laws every map of a generating function must pass, measured at a point.
//!
//! Derivatives are central differences of eighth order, so that a law that holds shows up to about
//! 1e-12. Defects are relative to the size of what is compared.

mod differences;
mod order;

use alloc::vec::Vec;

use crate::error::StepError;
use crate::generating::Reversed;
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;
use crate::solve::Integrator;
use crate::step::monitor::Monitor;
use crate::step::{advance, poisson_map};

use differences::{poisson_defect, symplectic_defect};

pub use differences::symplectic_defect_of;
pub use order::{OrderError, measured_order};

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

/// Tries every law at each of `points` and returns the worst defects: `poisson`, `symplectic`,
/// `equivariant`, `momentum`, `casimirs`, `diagram`, `inverse`, and, where the map of the negative
/// step is given, `symmetric`.
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
    let mut laws: Vec<Law> = Vec::new();
    let mut note = |name: &'static str, value: f64, bound: f64| {
        match laws.iter_mut().find(|law| law.name == name) {
            // NaN must stay.
            Some(law) if law.value.is_nan() || value <= law.value => {}
            Some(law) => law.value = value,
            None => laws.push(Law { name, value, bound }),
        }
    };
    let group = map.group();
    for (at, point) in points.iter().enumerate() {
        note("poisson", poisson_defect(map, &point.momentum)?, DIFFERENCES);
        note("symplectic", symplectic_defect(map, point)?, DIFFERENCES);

        let mut image = point.clone();
        advance(map, &mut image)?;
        // Φ(k·α) = k·Φ(α) for some k other than the point's own element; the last point is its own neighbour's.
        let k = points.get(at + 1).map_or(&point.group_element, |next| &next.group_element);
        let mut moved = Phase::new(group.compose(k, &point.group_element), point.momentum.clone());
        advance(map, &mut moved)?;
        let element = group.compose(k, &image.group_element);
        let difference = element_difference(group, &moved.group_element, &element);
        let difference = difference.worse(relative(&moved.momentum, &image.momentum));
        note("equivariant", difference, ROUNDING);
        // J_L(Φ(α)) = J_L(α)
        let spatial = relative(&image.spatial_momentum(group), &point.spatial_momentum(group));
        note("momentum", spatial, ROUNDING);
        // C(Φ(μ)) = C(μ), relative to the scale of `Drift::casimirs`.
        let mut monitor = Monitor::new(group.clone(), point, 1.0);
        monitor.observe(&image, 1.0);
        note("casimirs", monitor.drift().casimirs, ROUNDING);
        // J_R∘Φ̂ = Φ∘J_R: the map of T\*G covers that of 𝔤\*.
        let covered = poisson_map(map, &point.momentum)?;
        note("diagram", relative(&image.momentum, &covered), ROUNDING);
        // Φ_{−h}∘Φ_h = id
        let back = poisson_map(&Reversed(map), &covered)?;
        note("inverse", relative(&back, &point.momentum), ROUNDING);
        if let Some(backward) = backward {
            let back = poisson_map(backward, &covered)?;
            note("symmetric", relative(&back, &point.momentum), ROUNDING);
        }
    }
    Ok(laws)
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
