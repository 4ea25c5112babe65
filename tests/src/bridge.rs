//! From codegen's exact objects to the runtime's numbers, for tests.

use coadjoint::LieGroup;
use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::{Chart, MatrixGroup, TableError};
use coadjoint_codegen::hamilton_jacobi::GeneratingSeries;
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::number::nearest_float;

pub use coadjoint_learn::catalogue::matrix_group;

/// The group of the catalogue, by its tables.
pub fn named(name: &str) -> MatrixGroup {
    matrix_group(&lookup(name).unwrap()).unwrap()
}

/// S_h = Σ h^k S_k as a generating function.
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
            terms.push((step * nearest_float(&c), factors));
        }
    }
    PolynomialFunction::new(group, chart, terms)
}
