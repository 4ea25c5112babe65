//! The run-time group of a Lie algebra.

use std::path::Path;

use coadjoint::{
    groups::CayleyMatrixGroup, groups::DirectProduct, groups::MatrixGroup, groups::TableError,
};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_learn::catalogue;

use crate::error::RunError;

/// The group whose Lie algebra this is, factor by factor for a direct product.
pub fn product_group(
    path: &Path,
    algebra: &LieAlgebra,
) -> Result<DirectProduct<MatrixGroup>, RunError> {
    let mut known: Vec<(LieAlgebra, MatrixGroup)> = Vec::new();
    let group = |factor: LieAlgebra| {
        if let Some((_, group)) = known.iter().find(|(other, _)| *other == factor) {
            return Ok(group.clone());
        }
        let group = matrix_group(path, &factor)?;
        known.push((factor, group.clone()));
        Ok(group)
    };
    let groups: Result<Vec<_>, RunError> = algebra.factors().into_iter().map(group).collect();
    Ok(DirectProduct::new(groups?))
}

/// The same group with the Cayley map.
pub fn cayley_group(
    path: &Path,
    group: &DirectProduct<MatrixGroup>,
) -> Result<DirectProduct<CayleyMatrixGroup>, RunError> {
    let factors: Result<Vec<_>, TableError> =
        group.factors().map(|factor| factor.clone().into_cayley()).collect();
    Ok(DirectProduct::new(factors.map_err(RunError::of(path))?))
}

/// The group whose Lie algebra this is, not taken apart: kicks look at the matrices of the whole.
pub fn whole_group(
    path: &Path,
    algebra: &LieAlgebra,
) -> Result<DirectProduct<MatrixGroup>, RunError> {
    Ok(DirectProduct::new(vec![matrix_group(path, algebra)?]))
}

/// The group whose Lie algebra this is.
fn matrix_group(path: &Path, algebra: &LieAlgebra) -> Result<MatrixGroup, RunError> {
    catalogue::matrix_group(algebra).map_err(RunError::of(path))
}
