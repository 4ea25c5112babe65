//! From codegen's exact objects to the runtime's numbers, for tests.

use coadjoint::LieGroup;
use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::{Chart, MatrixGroup, TableError};
use coadjoint_codegen::hamilton_jacobi::GeneratingSeries;
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::number::Rational;
use nalgebra::DMatrix;
use num_traits::ToPrimitive;

/// The nearest double.
#[must_use]
pub fn double(value: &Rational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

/// The runtime's group of an algebra.
///
/// # Errors
/// [`TableError`] if the runtime's checks find something codegen's did not.
pub fn matrix_group(algebra: &LieAlgebra) -> Result<MatrixGroup, TableError> {
    let structure: Vec<_> =
        algebra.structure().iter().map(|s| (s.i, s.j, s.k, double(&s.value))).collect();
    match algebra.basis() {
        Some(basis) => {
            let basis: Vec<_> = basis
                .iter()
                .map(|e| DMatrix::from_fn(e.rows(), e.columns(), |i, j| double(&e.get(i, j))))
                .collect();
            MatrixGroup::from_structure_and_basis(&structure, &basis)
        }
        None => MatrixGroup::from_structure_constants(algebra.dim(), &structure),
    }
}

/// S_h = Σ h^k S_k as a generating function.
///
/// # Errors
/// [`TableError::IndexOutOfRange`] for a series with opaque symbols.
pub fn series_function<G: LieGroup, C: Chart<G>>(
    group: G,
    chart: C,
    series: &GeneratingSeries,
    h: f64,
) -> Result<PolynomialFunction<G, C>, TableError> {
    let mut terms = Vec::new();
    for k in 1..=series.truncation() {
        let step = (0..k).fold(1.0, |product, _| product * h);
        for (factors, c) in series.order(k).factors() {
            let factors = factors.into_iter().map(|(i, power)| (i as usize, power)).collect();
            terms.push((step * double(&c), factors));
        }
    }
    PolynomialFunction::new(group, chart, terms)
}
