//! The groups known by name, and products of them.
//!
//! | name | group | basis |
//! |---|---|---|
//! | `R1`, `R2`, … | translations | e_i = ∂_i, affine (n+1)×(n+1) matrices |
//! | `SO2`, `SO4`, `SO5`, … | rotations | E_ba − E_ab for a < b, in lexicographic order |
//! | `SO3` | rotations of space | the hat matrices about the three axes |
//! | `SE2`, `SE3` | rigid motions | rotations as in `SO2`, `SO3`, then translations |
//! | `SU2` | unit quaternions | −iσ_k/2, so \[e_1, e_2\] = e_3 and cyclic; real 4×4 form |
//! | `SU3`, `SU4`, … | special unitary | for a < b: E_ab − E_ba, i(E_ab + E_ba); then i(E_kk − E_k+1,k+1) |
//! | `U1`, `U2`, … | unitary | for a < b as in `SU`; then iE_kk |
//! | `SL2` | SL(2, ℝ) | H, E, F with \[H,E\] = 2E, \[H,F\] = −2F, \[E,F\] = H |
//! | `Heisenberg` | upper unitriangular 3×3 | \[e_1, e_2\] = e_3 |
//! | `Aff1` | affine maps of the line | scaling, translation: \[e_1, e_2\] = e_2 |
//!
//! Complex n×n matrices A + iB are real 2n×2n matrices ((A, −B), (B, A)). Names may be written with
//! parentheses, `SO(3)`, `SL(2,R)`.
//!
//! Products: `SO3*SO3`, `SO3^4`, and semidirect products of a group with copies of a space it acts
//! on: `SO3 |x R3`, `SO3 |x R3^2` (columns of a matrix), `SO3 |x Sym3` (symmetric matrices,
//! S ↦ gSgᵀ). Also `×` and `⋉`. Powers bind tightest, then `|x`, then `*`.

mod error;
mod groups;
mod names;
mod parse;
mod summary;

pub use error::CatalogueError;
pub use names::names;
pub use summary::summary;

use super::LieAlgebra;

/// The Lie algebra of the group or product of groups of this text.
///
/// ```
/// use coadjoint_symbolic::lie::catalogue::lookup;
///
/// assert_eq!(lookup("SO3^4").unwrap().dim(), 12);
/// assert_eq!(lookup("SO3 |x R3").unwrap().structure(), lookup("SE3").unwrap().structure());
/// assert!(lookup("SO33 * SE3").unwrap_err().to_string().contains("too large"));
/// ```
///
/// # Errors
/// If a name is unknown, the text is no product, a group is too large, or a group does not act on
/// the space it is to be extended by.
pub fn lookup(text: &str) -> Result<LieAlgebra, CatalogueError> {
    parse::parse(text)
}
