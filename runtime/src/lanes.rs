//! Several trajectories in the lanes of one SIMD number.

use nalgebra::SimdValue;
pub use simba::simd::{AutoF64x4 as F64x4, AutoF64x8 as F64x8};

use crate::generating_function::GeneratingFunction;
use crate::group::LieGroup;
use crate::heisenberg::Heisenberg;
use crate::phase::Phase;
use crate::scalar::Scalar;
use crate::se2::SE2;
use crate::se3::SE3;
use crate::so3::SO3;
use crate::so3_matrix::SO3Matrix;
use crate::su2::SU2;
use crate::table::{StaticAlgebra, StaticMatrixGroup};

/// A group over `f64` that exists over lanes too.
pub trait LaneGroup: LieGroup<Scalar = f64> {
    /// The same group over lanes.
    type Over<L: Scalar + SimdValue<Element = f64>>: LieGroup<Scalar = L>;

    /// A phase point with `phase` in every lane.
    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>>;

    /// Puts `phase` into lane `lane`.
    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    );

    /// Takes out lane `lane`.
    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self>;
}

/// An integrator over `f64` that can be had over lanes: what the attribute generates.
///
/// A lane computes the same bits as the scalar integrator.
pub trait Lanes: GeneratingFunction<Group: LaneGroup> {
    /// The same integrator over lanes.
    type Over<L: Scalar + SimdValue<Element = f64>>: GeneratingFunction<
        Group = <Self::Group as LaneGroup>::Over<L>,
    >;

    /// This integrator in every lane: same step size, same parameters.
    fn splat<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L>;
}

/// [`LaneGroup`] for groups whose elements and vectors are nalgebra types over the scalar.
macro_rules! lane_group {
    ($($group:ident),*) => {$(
        impl LaneGroup for $group<f64> {
            type Over<L: Scalar + SimdValue<Element = f64>> = $group<L>;

            #[inline(always)]
            fn splat<L: Scalar + SimdValue<Element = f64>>(
                phase: &Phase<Self>,
            ) -> Phase<$group<L>> {
                Phase {
                    group_element: SimdValue::splat(phase.group_element),
                    momentum: SimdValue::splat(phase.momentum),
                }
            }

            #[inline(always)]
            fn insert<L: Scalar + SimdValue<Element = f64>>(
                lanes: &mut Phase<$group<L>>,
                lane: usize,
                phase: &Phase<Self>,
            ) {
                lanes.group_element.replace(lane, phase.group_element);
                lanes.momentum.replace(lane, phase.momentum);
            }

            #[inline(always)]
            fn extract<L: Scalar + SimdValue<Element = f64>>(
                lanes: &Phase<$group<L>>,
                lane: usize,
            ) -> Phase<Self> {
                Phase {
                    group_element: SimdValue::extract(&lanes.group_element, lane),
                    momentum: SimdValue::extract(&lanes.momentum, lane),
                }
            }
        }
    )*};
}

lane_group!(SO3, SO3Matrix, SU2, SE2, SE3, Heisenberg);

impl<A: StaticAlgebra, const N: usize, const D: usize> LaneGroup for StaticMatrixGroup<A, N, D> {
    type Over<L: Scalar + SimdValue<Element = f64>> = StaticMatrixGroup<A, N, D, L>;

    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>> {
        Phase {
            group_element: SimdValue::splat(phase.group_element),
            momentum: SimdValue::splat(phase.momentum),
        }
    }

    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    ) {
        lanes.group_element.replace(lane, phase.group_element);
        lanes.momentum.replace(lane, phase.momentum);
    }

    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self> {
        Phase {
            group_element: SimdValue::extract(&lanes.group_element, lane),
            momentum: SimdValue::extract(&lanes.momentum, lane),
        }
    }
}
