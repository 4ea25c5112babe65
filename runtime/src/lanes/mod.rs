//! Several trajectories in the lanes of one SIMD number.

#[cfg(feature = "ensemble")]
pub mod ensemble;
#[cfg(feature = "ensemble")]
mod registers;
#[cfg(feature = "alloc")]
mod tables;

#[cfg(feature = "alloc")]
pub use tables::DynamicLaneTables;

use nalgebra::{SVector, SimdValue};
pub use simba::simd::{AutoF64x4 as F64x4, AutoF64x8 as F64x8};

use crate::group::heisenberg::Heisenberg;
use crate::group::phase::Phase;
use crate::group::product::{Power, Product};
use crate::group::se2::SE2;
use crate::group::se3::SE3;
use crate::group::so3::SO3;
use crate::group::su2::SU2;
use crate::group::{FixedDimension, LieGroup};
use crate::linear::coordinates::Coordinates;
use crate::number::program::Registers;
use crate::number::scalar::Scalar;
use crate::solve::Integrator;
use crate::table::{StaticAlgebra, StaticMatrixGroup};

/// A group that exists over lanes and is known to the compiler: nothing but its type is needed.
pub trait FixedLaneGroup: LieGroup<Scalar = f64> {
    /// The same group over lanes.
    type Over<L: Scalar + SimdValue<Element = f64>>: LieGroup<Scalar = L> + FixedDimension + Default;

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

/// A group over `f64` that exists over lanes too: those known to the compiler, and those known at
/// run time.
pub trait LaneGroup: LieGroup<Scalar = f64> {
    /// The same group over lanes.
    type Over<L: Scalar + SimdValue<Element = f64>>: LieGroup<Scalar = L>;

    /// This group over lanes.
    fn over<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L>;

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

impl<G: FixedLaneGroup> LaneGroup for G {
    type Over<L: Scalar + SimdValue<Element = f64>> = <G as FixedLaneGroup>::Over<L>;

    #[inline(always)]
    fn over<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L> {
        Default::default()
    }

    #[inline(always)]
    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>> {
        <G as FixedLaneGroup>::splat::<L>(phase)
    }

    #[inline(always)]
    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    ) {
        <G as FixedLaneGroup>::insert::<L>(lanes, lane, phase);
    }

    #[inline(always)]
    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self> {
        <G as FixedLaneGroup>::extract::<L>(lanes, lane)
    }
}

/// An integrator over `f64` that can be had over lanes: what the attribute generates.
///
/// A lane computes the same bits as the scalar integrator.
pub trait Lanes: Integrator<Group: LaneGroup> {
    /// The same integrator over lanes.
    type Over<L: Scalar + SimdValue<Element = f64>>: Integrator<
        Group = <Self::Group as LaneGroup>::Over<L>,
    >;

    /// This integrator in every lane: same step size, same parameters.
    fn splat<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L>;

    /// Makes steps of several trajectories by straight-line programs, where the integrator has such programs and all steps
    /// are right; whether it did. Trajectories are given with their indices.
    #[doc(hidden)]
    #[inline(always)]
    fn drive_lanes<R: Registers>(
        &self,
        registers: R,
        phases: &mut [(usize, &mut Phase<Self::Group>)],
        steps: u64,
    ) -> bool {
        let _ = (registers, phases, steps);
        false
    }
}

/// [`FixedLaneGroup`] for groups whose elements and vectors are nalgebra types over the scalar.
macro_rules! lane_group {
    ($(($($generics:tt)*) $group:ty => $lane:ident: $over:ty;)*) => {$(
        impl<$($generics)*> FixedLaneGroup for $group {
            type Over<$lane: Scalar + SimdValue<Element = f64>> = $over;

            #[inline(always)]
            fn splat<L: Scalar + SimdValue<Element = f64>>(
                phase: &Phase<Self>,
            ) -> Phase<Self::Over<L>> {
                Phase {
                    group_element: SimdValue::splat(phase.group_element),
                    momentum: SimdValue::splat(phase.momentum),
                }
            }

            #[inline(always)]
            fn insert<L: Scalar + SimdValue<Element = f64>>(
                lanes: &mut Phase<Self::Over<L>>,
                lane: usize,
                phase: &Phase<Self>,
            ) {
                lanes.group_element.replace(lane, phase.group_element);
                lanes.momentum.replace(lane, phase.momentum);
            }

            #[inline(always)]
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
    )*};
}

lane_group! {
    () SO3<f64> => L: SO3<L>;
    () SU2<f64> => L: SU2<L>;
    () SE2<f64> => L: SE2<L>;
    () SE3<f64> => L: SE3<L>;
    () Heisenberg<f64> => L: Heisenberg<L>;
    (A: StaticAlgebra, const N: usize, const D: usize)
        StaticMatrixGroup<A, N, D> => L: StaticMatrixGroup<A, N, D, L>;
}

/// The phase point of one copy.
fn copy_of<G, const COPIES: usize, const N: usize>(
    phase: &Phase<Power<G, COPIES, N>>,
    copy: usize,
) -> Phase<G>
where
    G: LieGroup + Default,
{
    let n = G::default().dim();
    let momentum = G::Vector::from_entries(n, |i| phase.momentum[copy * n + i]);
    Phase { group_element: phase.group_element[copy].clone(), momentum }
}

/// Puts back the phase point of one copy.
fn put_copy<G, const COPIES: usize, const N: usize>(
    phase: &mut Phase<Power<G, COPIES, N>>,
    copy: usize,
    part: Phase<G>,
) where
    G: LieGroup + Default,
{
    let n = G::default().dim();
    for i in 0..n {
        phase.momentum[copy * n + i] = part.momentum[i];
    }
    phase.group_element[copy] = part.group_element;
}

impl<G, const COPIES: usize, const N: usize> FixedLaneGroup for Power<G, COPIES, N>
where
    G: FixedLaneGroup + FixedDimension + Default,
{
    type Over<L: Scalar + SimdValue<Element = f64>> = Power<G::Over<L>, COPIES, N>;

    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>> {
        let n = G::default().dim();
        let mut momentum = SVector::repeat(L::of(0.0));
        let group_element = core::array::from_fn(|copy| {
            let part = G::splat::<L>(&copy_of(phase, copy));
            for i in 0..n {
                momentum[copy * n + i] = part.momentum[i];
            }
            part.group_element
        });
        Phase { group_element, momentum }
    }

    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    ) {
        for copy in 0..COPIES {
            let mut part = copy_of(lanes, copy);
            G::insert::<L>(&mut part, lane, &copy_of(phase, copy));
            put_copy(lanes, copy, part);
        }
    }

    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self> {
        let n = G::default().dim();
        let mut momentum = SVector::repeat(0.0);
        let group_element = core::array::from_fn(|copy| {
            let part = G::extract::<L>(&copy_of(lanes, copy), lane);
            for i in 0..n {
                momentum[copy * n + i] = part.momentum[i];
            }
            part.group_element
        });
        Phase { group_element, momentum }
    }
}

/// The phase points of the two factors.
fn factors<A, B, const N: usize>(phase: &Phase<Product<A, B, N>>) -> (Phase<A>, Phase<B>)
where
    A: LieGroup + FixedDimension + Default,
    B: LieGroup<Scalar = A::Scalar> + FixedDimension + Default,
{
    let (a, b) = &phase.group_element;
    let left = A::Vector::from_entries(A::DIM, |i| phase.momentum[i]);
    let right = B::Vector::from_entries(B::DIM, |i| phase.momentum[A::DIM + i]);
    (
        Phase { group_element: a.clone(), momentum: left },
        Phase { group_element: b.clone(), momentum: right },
    )
}

/// Puts the phase points of the two factors together.
fn joined<A, B, const N: usize>(left: Phase<A>, right: Phase<B>) -> Phase<Product<A, B, N>>
where
    A: LieGroup + FixedDimension + Default,
    B: LieGroup<Scalar = A::Scalar> + FixedDimension + Default,
{
    let momentum =
        SVector::from_fn(
            |i, _| {
                if i < A::DIM { left.momentum[i] } else { right.momentum[i - A::DIM] }
            },
        );
    Phase { group_element: (left.group_element, right.group_element), momentum }
}

impl<A, B, const N: usize> FixedLaneGroup for Product<A, B, N>
where
    A: FixedLaneGroup + FixedDimension + Default,
    B: FixedLaneGroup + FixedDimension + Default,
{
    type Over<L: Scalar + SimdValue<Element = f64>> = Product<A::Over<L>, B::Over<L>, N>;

    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>> {
        let (left, right) = factors(phase);
        joined(A::splat::<L>(&left), B::splat::<L>(&right))
    }

    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    ) {
        let ((mut left, mut right), (a, b)) = (factors(lanes), factors(phase));
        A::insert::<L>(&mut left, lane, &a);
        B::insert::<L>(&mut right, lane, &b);
        *lanes = joined(left, right);
    }

    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self> {
        let (left, right) = factors(lanes);
        joined(A::extract::<L>(&left, lane), B::extract::<L>(&right, lane))
    }
}
