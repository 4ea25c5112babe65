//! Run-time tables over lanes: the same tables, coordinates of another scalar.

use core::marker::PhantomData;

use nalgebra::{DVector, SimdValue};

use super::LaneGroup;
use crate::group::phase::Phase;
use crate::number::scalar::Scalar;
use crate::table::{
    BasisEntry, CayleyTables, DynamicTables, StructureConstant, TableGroup, Tables, monomial,
};

/// The tables of a [`MatrixGroup`](crate::groups::MatrixGroup) with coordinates in `DVector<L>`.
#[derive(Clone, Debug)]
pub struct DynamicLaneTables<const CAYLEY: bool, L> {
    tables: DynamicTables<CAYLEY>,
    scalar: PhantomData<L>,
}

impl<const CAYLEY: bool, L: Scalar> Tables for DynamicLaneTables<CAYLEY, L> {
    type Scalar = L;
    type Vector = DVector<L>;
    type Column = DVector<L>;

    fn dim(&self) -> usize {
        self.tables.dim()
    }

    fn matrix_size(&self) -> usize {
        self.tables.matrix_size()
    }

    fn structure(&self) -> &[StructureConstant] {
        self.tables.structure()
    }

    fn basis(&self) -> Option<&[BasisEntry]> {
        self.tables.basis()
    }

    fn gram_inverse(&self, i: usize, j: usize) -> f64 {
        self.tables.gram_inverse(i, j)
    }

    fn gram_is_diagonal(&self) -> bool {
        self.tables.gram_is_diagonal()
    }

    fn is_faithful(&self) -> bool {
        self.tables.is_faithful()
    }

    fn is_orthogonal(&self) -> bool {
        self.tables.is_orthogonal()
    }

    fn is_traceless(&self) -> bool {
        self.tables.is_traceless()
    }

    // Over lanes the bound decides; lanes that it refuses are tried again one by one.
    fn exp_extent(&self, x: &DVector<L>) -> L {
        self.tables.exp_bound(x)
    }

    fn cayley_extent(&self, x: &DVector<L>) -> L {
        self.tables.cayley_bound(x)
    }

    fn casimir_count(&self) -> usize {
        self.tables.casimir_count()
    }

    fn casimir(&self, index: usize, mu: &DVector<L>) -> L {
        let mut sum = L::of(0.0);
        for (c, factors) in self.tables.casimir_terms(index) {
            sum += monomial::<L, _>(*c, factors, mu);
        }
        sum
    }
}

impl<L: Scalar> CayleyTables for DynamicLaneTables<true, L> {}

impl<const CAYLEY: bool> LaneGroup for TableGroup<DynamicTables<CAYLEY>> {
    type Over<L: Scalar + SimdValue<Element = f64>> = TableGroup<DynamicLaneTables<CAYLEY, L>>;

    fn over<L: Scalar + SimdValue<Element = f64>>(&self) -> Self::Over<L> {
        let tables = DynamicLaneTables { tables: self.tables.clone(), scalar: PhantomData };
        TableGroup { tables }
    }

    fn splat<L: Scalar + SimdValue<Element = f64>>(phase: &Phase<Self>) -> Phase<Self::Over<L>> {
        Phase {
            group_element: phase.group_element.map(L::splat),
            momentum: phase.momentum.map(L::splat),
        }
    }

    fn insert<L: Scalar + SimdValue<Element = f64>>(
        lanes: &mut Phase<Self::Over<L>>,
        lane: usize,
        phase: &Phase<Self>,
    ) {
        for (to, from) in lanes.group_element.iter_mut().zip(&phase.group_element) {
            to.replace(lane, *from);
        }
        for (to, from) in lanes.momentum.iter_mut().zip(&phase.momentum) {
            to.replace(lane, *from);
        }
    }

    fn extract<L: Scalar + SimdValue<Element = f64>>(
        lanes: &Phase<Self::Over<L>>,
        lane: usize,
    ) -> Phase<Self> {
        Phase {
            group_element: lanes.group_element.map(|value| value.extract(lane)),
            momentum: lanes.momentum.map(|value| value.extract(lane)),
        }
    }
}
