//! The bases of the groups with a name.

use super::CatalogueError;
use crate::lie::{LieAlgebra, RationalMatrix};
use crate::number::{Rational, integer, ratio};

/// The largest n of SO(n), SU(n), U(n); beyond, the brackets alone take minutes.
const LARGEST: usize = 16;
/// The largest n of ℝⁿ.
const LARGEST_SPACE: usize = 4096;

/// The group of a name without products.
pub(super) fn group(name: &str) -> Result<LieAlgebra, CatalogueError> {
    let plain = plain(name);
    let unknown = || CatalogueError::unknown(name);
    let split = plain.find(|c: char| c.is_ascii_digit()).unwrap_or(plain.len());
    let (family, digits) = plain.split_at(split);
    let basis = if digits.is_empty() {
        match family {
            "Heisenberg" => [(0, 1), (1, 2), (0, 2)].map(|at| real(3, &[(at, 1)])).to_vec(),
            _ => return Err(unknown()),
        }
    } else {
        let n: usize = digits.parse().map_err(|_| unknown())?;
        let limit = if family == "R" { LARGEST_SPACE } else { LARGEST };
        if n == 0 || !matches!(family, "SO" | "SU" | "U" | "SE" | "SL" | "Aff" | "R") {
            return Err(unknown());
        }
        if n > limit {
            return Err(CatalogueError::TooLarge { name: name.into(), what: "n", limit });
        }
        match (family, n) {
            ("SO", 3) => hats(3),
            ("SO", 2..) => antisymmetric(n),
            ("SE", 2) => {
                let mut basis = vec![real(3, &[((1, 0), 1), ((0, 1), -1)])];
                basis.extend(translations(2));
                basis
            }
            ("SE", 3) => {
                let mut basis = hats(4);
                basis.extend(translations(3));
                basis
            }
            ("SU", 2) => pauli(),
            ("SU", 3..) => {
                let mut basis = off_diagonal(n);
                basis.extend((0..n - 1).map(|k| {
                    let plus = (k, k, integer(1));
                    complex(n, &[], &[plus, (k + 1, k + 1, integer(-1))])
                }));
                basis
            }
            ("U", _) => {
                let mut basis = off_diagonal(n);
                basis.extend((0..n).map(|k| complex(n, &[], &[(k, k, integer(1))])));
                basis
            }
            ("SL", 2) => vec![
                real(2, &[((0, 0), 1), ((1, 1), -1)]),
                real(2, &[((0, 1), 1)]),
                real(2, &[((1, 0), 1)]),
            ],
            ("Aff", 1) => vec![real(2, &[((0, 0), 1)]), real(2, &[((0, 1), 1)])],
            ("R", _) => translations(n),
            _ => return Err(unknown()),
        }
    };
    LieAlgebra::from_basis(plain, basis).map_err(|_| unknown())
}

/// `SO(3)` as `SO3`, `SL(2,R)` as `SL2`.
fn plain(name: &str) -> String {
    let mut text: String =
        name.chars().filter(|c| !c.is_whitespace() && !"()".contains(*c)).collect();
    for real in [",R", ",ℝ"] {
        if let Some(rest) = text.strip_suffix(real) {
            text = rest.to_owned();
        }
    }
    text
}

fn real(size: usize, entries: &[((usize, usize), i64)]) -> RationalMatrix {
    let entries = entries.iter().map(|&((i, j), value)| (i, j, integer(value)));
    RationalMatrix::from_entries(size, size, entries)
}

/// The real form ((A, −B), (B, A)) of A + iB.
fn complex(
    n: usize,
    a: &[(usize, usize, Rational)],
    b: &[(usize, usize, Rational)],
) -> RationalMatrix {
    let mut entries = Vec::new();
    for (i, j, value) in a {
        entries.push((*i, *j, value.clone()));
        entries.push((n + i, n + j, value.clone()));
    }
    for (i, j, value) in b {
        entries.push((*i, n + j, -value.clone()));
        entries.push((n + i, *j, value.clone()));
    }
    RationalMatrix::from_entries(2 * n, 2 * n, entries)
}

/// The three hat matrices in the upper left corner.
fn hats(size: usize) -> Vec<RationalMatrix> {
    [(1, 2), (2, 0), (0, 1)].map(|(a, b)| real(size, &[((b, a), 1), ((a, b), -1)])).to_vec()
}

fn antisymmetric(n: usize) -> Vec<RationalMatrix> {
    pairs(n).map(|(a, b)| real(n, &[((b, a), 1), ((a, b), -1)])).collect()
}

fn translations(n: usize) -> Vec<RationalMatrix> {
    (0..n).map(|i| real(n + 1, &[((i, n), 1)])).collect()
}

/// −iσ_k/2 for the three Pauli matrices.
fn pauli() -> Vec<RationalMatrix> {
    let (plus, minus) = (ratio(1, 2), ratio(-1, 2));
    vec![
        complex(2, &[], &[(0, 1, minus.clone()), (1, 0, minus.clone())]),
        complex(2, &[(0, 1, minus.clone()), (1, 0, plus.clone())], &[]),
        complex(2, &[], &[(0, 0, minus), (1, 1, plus)]),
    ]
}

fn off_diagonal(n: usize) -> Vec<RationalMatrix> {
    pairs(n)
        .flat_map(|(a, b)| {
            let (one, minus) = (integer(1), integer(-1));
            [
                complex(n, &[(a, b, one.clone()), (b, a, minus)], &[]),
                complex(n, &[], &[(a, b, one.clone()), (b, a, one)]),
            ]
        })
        .collect()
}

fn pairs(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |a| (a + 1..n).map(move |b| (a, b)))
}
