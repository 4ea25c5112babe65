//! The interpreter over lanes.

use std::marker::PhantomData;

use coadjoint::nalgebra::SimdValue;
use coadjoint::{
    Cayley, Exponential, Scalar, groups::CayleyMatrixGroup, lanes::LaneGroup, lanes::Lanes,
};

use super::Interpreter;

macro_rules! lanes {
    ($(($($generics:tt)*) $group:ty, $chart:ty;)*) => {$(
        impl<'a, $($generics)*> Lanes for Interpreter<'a, $group, $chart> {
            type Over<L: Scalar + SimdValue<Element = f64>> =
                Interpreter<'a, <$group as LaneGroup>::Over<L>, $chart>;

            fn splat<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L> {
                Interpreter {
                    integrator: self.integrator,
                    group: self.group.over::<L>(),
                    slots: self.slots.clone(),
                    defect: self.defect.clone(),
                    quadratic: self.quadratic,
                    last: self.last.clone(),
                    radius: self.radius,
                    chart: PhantomData,
                }
            }
        }
    )*};
}

lanes! {
    (G: LaneGroup) G, Exponential;
    () CayleyMatrixGroup, Cayley;
}
