//! Groups by the formulas of `geometry`, whose arrays are vectors and rows of nodes here.

use coadjoint_geometry::row::Row;
use nalgebra::SVector;

use crate::number::Scalar;

/// The entries of a vector.
#[inline(always)]
pub(super) fn array<T: Scalar, const N: usize>(x: &SVector<T, N>) -> [T; N] {
    x.data.0[0]
}

/// Rows as numbers.
#[inline(always)]
pub(super) fn nodes<T: Scalar, const M: usize, const N: usize>(x: &[[T; M]; N]) -> [Row<T, M>; N] {
    let mut numbers = [Row([T::of(0.0); M]); N];
    for i in 0..N {
        numbers[i] = Row(x[i]);
    }
    numbers
}

/// The rows of numbers.
#[inline(always)]
pub(super) fn rows<T: Scalar, const M: usize, const N: usize>(x: [Row<T, M>; N]) -> [[T; M]; N] {
    let mut rows = [[T::of(0.0); M]; N];
    for i in 0..N {
        rows[i] = x[i].0;
    }
    rows
}

/// The methods of [`LieGroup`](crate::groups::LieGroup) that are formulas of coordinates alone.
macro_rules! by_formulas {
    ($group:ty) => {
        fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
            <$group>::ad_star(array(x), array(mu)).into()
        }

        fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
            <$group>::pull_back(array(x), array(mu), Length::Any).into()
        }

        fn exp_extent(&self, x: &Self::Vector) -> T {
            <$group>::extent(array(x), core::f64::consts::PI)
        }

        #[inline(always)]
        fn node_momenta<const M: usize>(
            &self,
            x: &Rows<Self, M>,
            p: &Rows<Self, M>,
            degree: usize,
        ) -> Rows<Self, M> {
            rows(<$group>::momentum(nodes(x), nodes(p), degree))
        }

        #[inline(always)]
        fn node_rates<const M: usize>(
            &self,
            x: &Rows<Self, M>,
            p: &Rows<Self, M>,
            omega: &Rows<Self, M>,
            degree: usize,
        ) -> [Rows<Self, M>; 2] {
            <$group>::rates(nodes(x), nodes(p), nodes(omega), degree).map(rows)
        }

        #[inline(always)]
        fn ad_stars<const M: usize>(&self, x: &Rows<Self, M>, mu: &Rows<Self, M>) -> Rows<Self, M> {
            rows(<$group>::ad_star(nodes(x), nodes(mu)))
        }

        #[inline(always)]
        fn brackets<const M: usize>(&self, x: &Rows<Self, M>, y: &Rows<Self, M>) -> Rows<Self, M> {
            rows(<$group>::bracket(nodes(x), nodes(y)))
        }
    };
}

/// The methods of [`CayleyGroup`](crate::groups::CayleyGroup).
macro_rules! cayley_by_formulas {
    ($group:ty) => {
        fn cayley_extent(&self, x: &Self::Vector) -> T {
            <$group>::extent(array(x), <$group>::CAYLEY_LIMIT)
        }

        fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
            <$group>::cayley_pull_back(array(x), array(mu)).into()
        }
    };
}

pub(super) use {by_formulas, cayley_by_formulas};
