//! Groups and charts, from their names to types.

use coadjoint::groups::{Cayley, Chart, Exponential, MatrixGroup, TableError};
use coadjoint::{SE3, SO3};
use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, watched_casimirs};
use coadjoint_codegen::number::nearest_float;
use nalgebra::DMatrix;

use crate::error::LearnError;
use crate::group::DataGroup;
use crate::group::GroupChoice;

/// Work to be done for a group and chart known only by name.
pub trait Visitor {
    /// The result of the work.
    type Output;

    /// Does the work for `group` in the chart `C`.
    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> Self::Output;
}

/// Calls `visitor` with the group chosen and the chart called `chart` (`exp` or `cayley`).
///
/// SO3 and SE3 are the compiled groups; every other one is made from its tables.
///
/// # Errors
/// [`LearnError::UnknownGroup`] and [`LearnError::NoChart`].
pub fn visit<V: Visitor>(
    group: &GroupChoice,
    chart: &str,
    visitor: V,
) -> Result<V::Output, LearnError> {
    let name = group.name();
    let unknown = |reason: String| LearnError::UnknownGroup { name: name.into(), reason };
    let no_chart =
        |reason: String| LearnError::NoChart { group: name.into(), chart: chart.into(), reason };
    if chart != "exp" && chart != "cayley" {
        return Err(no_chart("charts are exp and cayley".into()));
    }
    // By the name it has in the catalogue: `SO(3)` is SO3.
    let algebra = group.algebra()?;
    match (algebra.name(), chart) {
        ("SO3", "exp") => Ok(visitor.visit::<SO3, Exponential>(SO3::new())),
        ("SO3", _) => Ok(visitor.visit::<SO3, Cayley>(SO3::new())),
        ("SE3", "exp") => Ok(visitor.visit::<SE3, Exponential>(SE3::new())),
        ("SE3", _) => Ok(visitor.visit::<SE3, Cayley>(SE3::new())),
        _ => {
            let made = with_casimirs(&algebra).map_err(|e| unknown(e.to_string()))?;
            if chart == "exp" {
                return Ok(visitor.visit::<_, Exponential>(made));
            }
            let made = made.into_cayley().map_err(|e| no_chart(e.to_string()))?;
            Ok(visitor.visit::<_, Cayley>(made))
        }
    }
}

/// The group of an algebra by its tables: matrices of the basis's size, or adjoint matrices where only brackets are known.
///
/// # Errors
/// [`TableError`] where rounding to double precision breaks the algebra.
pub fn matrix_group(algebra: &LieAlgebra) -> Result<MatrixGroup, TableError> {
    let structure = algebra.constants();
    let Some(basis) = algebra.basis() else {
        return MatrixGroup::from_structure_constants(algebra.dim(), &structure);
    };
    let matrix = |e: &RationalMatrix| {
        DMatrix::from_fn(e.rows(), e.columns(), |i, j| nearest_float(&e.get(i, j)))
    };
    let basis: Vec<_> = basis.iter().map(matrix).collect();
    MatrixGroup::from_structure_and_basis(&structure, &basis)
}

/// Builds the group with the Casimirs of its algebra up to degree 3.
fn with_casimirs(algebra: &LieAlgebra) -> Result<MatrixGroup, TableError> {
    let terms = watched_casimirs(algebra).into_iter().map(|polynomial| {
        let terms = polynomial.terms().map(|(exponents, value)| {
            let powers = exponents.into_iter().enumerate().filter(|(_, power)| *power > 0);
            (nearest_float(&value), powers.collect())
        });
        terms.collect()
    });
    matrix_group(algebra)?.with_casimirs(terms.collect())
}
