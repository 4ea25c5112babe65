//! The groups known by name.

use super::{LieAlgebra, RationalMatrix};
use crate::number::integer;

/// The names of the catalogue.
#[must_use]
pub fn names() -> &'static [&'static str] {
    &["SO3", "SE3"]
}

/// Why a text names no group.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// No group has this name.
    #[error("unknown group `{name}`{}; known groups: {known}", did_you_mean(.suggestion))]
    Unknown {
        /// The name given.
        name: String,
        /// The nearest known name, if one is near.
        suggestion: Option<String>,
        /// All known names.
        known: String,
    },
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}

/// The Lie algebra of the group of this name.
///
/// # Errors
/// If there is no such group.
pub fn lookup(name: &str) -> Result<LieAlgebra, CatalogueError> {
    let basis = match name {
        "SO3" => rotations(3),
        "SE3" => {
            let mut basis = rotations(4);
            basis.extend((0..3).map(|i| RationalMatrix::from_entries(4, 4, [(i, 3, integer(1))])));
            basis
        }
        _ => return Err(unknown(name)),
    };
    LieAlgebra::from_basis(name, basis).map_err(|_| unknown(name))
}

fn unknown(name: &str) -> CatalogueError {
    let suggestion = names()
        .iter()
        .map(|known| (distance(&name.to_lowercase(), &known.to_lowercase()), *known))
        .filter(|(distance, _)| *distance <= 2)
        .min()
        .map(|(_, known)| known.to_owned());
    CatalogueError::Unknown { name: name.to_owned(), suggestion, known: names().join(", ") }
}

/// The edit distance (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// The three hat matrices in the upper left corner.
fn rotations(size: usize) -> Vec<RationalMatrix> {
    [(1, 2), (2, 0), (0, 1)]
        .into_iter()
        .map(|(a, b)| {
            RationalMatrix::from_entries(size, size, [(b, a, integer(1)), (a, b, integer(-1))])
        })
        .collect()
}
