//! Drifts of conserved quantities over a run.

use core::fmt::Debug;

use nalgebra::{SimdComplexField, SimdPartialOrd};

use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// The largest drifts seen so far, each relative to its scale. NaN where a state was not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift<T> {
    /// The largest change of a coordinate of the spatial momentum J_L = Ad\*_g μ, relative to the
    /// largest coordinate it had at the start.
    pub spatial_momentum: T,
    /// The largest change of a Casimir of the group, relative to its scale: the largest value it
    /// takes at the first momentum, at that with all coordinates positive, and at that with one
    /// sign turned, so that a Casimir which happens to vanish has a scale too.
    pub casimirs: T,
    /// The largest change of the energy, relative to its first value.
    pub energy: T,
}

/// Tracks the maxima of [`Drift`] over a run. Allocates nothing beyond the coordinates themselves.
///
/// A scale that is zero (momentum zero, energy zero) is replaced by one: the drift is then
/// absolute.
///
/// ```
/// use coadjoint::{Phase, SO3};
/// use coadjoint::steps::Monitor;
/// use nalgebra::Vector3;
///
/// let body = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0));
/// let mut monitor = Monitor::new(SO3::new(), &body, 2.0);
/// let later = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0 + 1e-9));
/// monitor.observe(&later, 2.002);
/// let drift = monitor.drift();
/// assert!((drift.spatial_momentum - 5e-10).abs() < 1e-15);
/// assert!((drift.energy - 1e-3).abs() < 1e-15);
/// ```
pub struct Monitor<G: LieGroup> {
    group: G,
    momentum: G::Vector,
    spatial: G::Vector,
    spatial_scale: G::Scalar,
    energy: G::Scalar,
    energy_scale: G::Scalar,
    drift: Drift<G::Scalar>,
}

fn or_one<T: Scalar>(scale: T) -> T {
    let zero = T::of(0.0);
    T::of(1.0).select(scale.simd_eq(zero), scale)
}

impl<G: LieGroup> Monitor<G> {
    /// Starts at this state of this energy.
    #[must_use]
    pub fn new(group: G, start: &Phase<G>, energy: G::Scalar) -> Self {
        let spatial = start.spatial_momentum(&group);
        let zero = G::Scalar::of(0.0);
        Self {
            momentum: start.momentum.clone(),
            spatial_scale: or_one(spatial.largest_entry()),
            spatial,
            energy,
            energy_scale: or_one(energy.simd_abs()),
            drift: Drift { spatial_momentum: zero, casimirs: zero, energy: zero },
            group,
        }
    }

    /// Takes a state of the run into account.
    pub fn observe(&mut self, state: &Phase<G>, energy: G::Scalar) {
        let spatial = state.spatial_momentum(&self.group);
        for i in 0..spatial.dim() {
            let change = (spatial[i] - self.spatial[i]).simd_abs() / self.spatial_scale;
            self.drift.spatial_momentum = self.drift.spatial_momentum.worse(change);
        }
        for index in 0..self.group.casimir_count() {
            let start = self.group.casimir(index, &self.momentum);
            let change = (self.group.casimir(index, &state.momentum) - start).simd_abs();
            let relative = change / self.casimir_scale(index);
            self.drift.casimirs = self.drift.casimirs.worse(relative);
        }
        let change = (energy - self.energy).simd_abs() / self.energy_scale;
        self.drift.energy = self.drift.energy.worse(change);
    }

    /// The maxima so far.
    #[must_use]
    pub fn drift(&self) -> Drift<G::Scalar> {
        self.drift
    }

    fn casimir_scale(&self, index: usize) -> G::Scalar {
        let dim = self.momentum.dim();
        let mut point = G::Vector::from_entries(dim, |i| self.momentum[i].simd_abs());
        let mut scale = self.group.casimir(index, &point).simd_abs();
        point = self.momentum.clone();
        scale = scale.simd_max(self.group.casimir(index, &point).simd_abs());
        for i in 0..dim {
            point[i] = -point[i];
            scale = scale.simd_max(self.group.casimir(index, &point).simd_abs());
            point[i] = -point[i];
        }
        or_one(scale)
    }
}

impl<G: LieGroup> Debug for Monitor<G> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Monitor").field("group", &self.group).field("drift", &self.drift).finish()
    }
}
