//! The groups known by name, and products of them.
//!
//! | name | group | basis |
//! |---|---|---|
//! | `R1`, `R2`, … | translations | e_i = ∂_i, affine (n+1)×(n+1) matrices |
//! | `SO2`, `SO4`, `SO5`, … | rotations | E_ba − E_ab for a < b, in lexicographic order |
//! | `SO3` | rotations of space | the hat matrices about the three axes |
//! | `SE2`, `SE3` | rigid motions | rotations as in `SO2`, `SO3`, then translations |
//! | `SE23` | SE_2(3), extended poses | as `SO3 \|x R3^2`: rotations, velocities, places; matrices ((R, v, p), (0, 1)) |
//! | `SU2` | unit quaternions | −iσ_k/2, so \[e_1, e_2\] = e_3 and cyclic; real 4×4 form |
//! | `SU3`, `SU4`, … | special unitary | for a < b: E_ab − E_ba, i(E_ab + E_ba); then i(E_kk − E_k+1,k+1) |
//! | `U1`, `U2`, … | unitary | for a < b as in `SU`; then iE_kk |
//! | `SL2` | SL(2, ℝ) | H, E, F with \[H,E\] = 2E, \[H,F\] = −2F, \[E,F\] = H |
//! | `Sp2`, `Sp4`, … | Sp(n, ℝ), symplectic | ((A, B), (C, −Aᵀ)), z = (q, p): E_ab of A row by row; for a ≤ b those of B, then C |
//! | `Heisenberg` | upper unitriangular 3×3 | \[e_1, e_2\] = e_3 |
//! | `Aff1` | affine maps of the line | scaling, translation: \[e_1, e_2\] = e_2 |
//!
//! Complex n×n matrices A + iB are real 2n×2n matrices ((A, −B), (B, A)). Names may be written with
//! parentheses, `SO(3)`, `SL(2,R)`, `SE_2(3)`.
//!
//! Products: `SO3*SO3`, `SO3^4`, and semidirect products of a group with copies of a space it acts
//! on: `SO3 |x R3`, `SO3 |x R3^2` (columns of a matrix), `SO3 |x Sym3` (symmetric matrices,
//! S ↦ gSgᵀ). Also `×` and `⋉`. Powers bind tightest, then `|x`, then `*`.

use crate::lie::{LieAlgebra, RationalMatrix, symmetric_square};
use crate::nearest::nearest;
use crate::number::{Rational, integer, ratio};

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
    let tokens = tokens(text)?;
    let mut parser = Parser { text, tokens, at: 0, depth: 0 };
    let algebra = parser.product()?;
    match parser.next() {
        None => Ok(algebra),
        Some(_) => Err(parser.syntax("`*`, `^`, `|x` or the end")),
    }
}

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
        if n == 0 || !matches!(family, "SO" | "SU" | "U" | "SE" | "SL" | "Sp" | "Aff" | "R") {
            return Err(unknown());
        }
        if n > limit && family != "SE" {
            return Err(CatalogueError::TooLarge { name: name.into(), what: "n", limit });
        }
        match (family, n) {
            ("SO", 3) => hats(),
            ("SO", 2..) => antisymmetric(n),
            ("SE", 2) => return Ok(lookup("SO2 |x R2")?.renamed(plain)),
            ("SE", 3) => return Ok(lookup("SO3 |x R3")?.renamed(plain)),
            ("SE", 23) => return Ok(lookup("SO3 |x R3^2")?.renamed(plain)),
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
            ("SL", 2) => symplectic(1),
            ("Sp", _) if n.is_multiple_of(2) => symplectic(n / 2),
            ("Aff", 1) => vec![real(2, &[((0, 0), 1)]), real(2, &[((0, 1), 1)])],
            ("R", _) => translations(n),
            _ => return Err(unknown()),
        }
    };
    LieAlgebra::from_basis(plain, basis).map_err(|_| unknown())
}

/// `SO(3)` as `SO3`, `SL(2,R)` as `SL2`, `SE_2(3)` as `SE23`.
fn plain(name: &str) -> String {
    let mut text: String =
        name.chars().filter(|c| !c.is_whitespace() && !"()_".contains(*c)).collect();
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

/// The three hat matrices.
fn hats() -> Vec<RationalMatrix> {
    [(1, 2), (2, 0), (0, 1)].map(|(a, b)| real(3, &[((b, a), 1), ((a, b), -1)])).to_vec()
}

/// The matrices ((A, B), (C, −Aᵀ)) with symmetric B and C in ℝ²ⁿ.
fn symplectic(n: usize) -> Vec<RationalMatrix> {
    let squares = (0..n * n).map(|k| (k / n, k % n));
    let diagonal = squares.map(|(a, b)| real(2 * n, &[((a, b), 1), ((n + b, n + a), -1)]));
    let corners = [(0, n), (n, 0)].into_iter().flat_map(|(row, column)| {
        let both = (0..n).flat_map(move |a| (a..n).map(move |b| [(a, b), (b, a)]));
        both.map(move |both| {
            let entries = both.map(|(a, b)| ((row + a, column + b), 1));
            real(2 * n, &entries[usize::from(both[0] == both[1])..])
        })
    });
    diagonal.chain(corners).collect()
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

/// The names of the catalogue, families by their smallest members.
pub fn names() -> &'static [&'static str] {
    &[
        "SO2",
        "SO3",
        "SO4",
        "SO5",
        "SE2",
        "SE3",
        "SE23",
        "SU2",
        "SU3",
        "SU4",
        "U1",
        "U2",
        "U3",
        "SL2",
        "Sp4",
        "Heisenberg",
        "Aff1",
        "R1",
        "R2",
        "R3",
    ]
}

/// The description of a group of the catalogue, by its name in the form of [`names`]: without
/// parentheses. `None` for products and for unknown names.
///
/// ```
/// use coadjoint_symbolic::lie::catalogue::{names, summary};
///
/// assert!(names().iter().all(|name| summary(name).is_some()));
/// assert_eq!(summary("SO3").as_deref(), Some("rotations of space; about axes 1, 2, 3"));
/// ```
pub fn summary(name: &str) -> Option<String> {
    let split = name.find(|c: char| c.is_ascii_digit()).unwrap_or(name.len());
    let (family, digits) = name.split_at(split);
    let n: usize = match digits {
        "" => 0,
        digits => digits.parse().ok()?,
    };
    const PAIRS: &str = "for a < b a real and an imaginary direction, then the diagonal";
    let text = match (family, n) {
        ("SO", 2) => "rotations of the plane".to_owned(),
        ("SO", 3) => "rotations of space; about axes 1, 2, 3".to_owned(),
        ("SO", 4..) => format!("rotations of {n} dimensions; in the planes (a, b), a < b"),
        ("SE", 2) => "rigid motions of the plane; the rotation, then translations".to_owned(),
        ("SE", 3) => "rigid motions of space; rotations as in SO3, then translations".to_owned(),
        ("SE", 23) => {
            "extended poses; rotations as in SO3, then velocities, then places".to_owned()
        }
        ("SU", 2) => "unit quaternions; -i/2 times the Pauli matrices".to_owned(),
        ("SU", 3..) => format!("unitary {n} x {n} matrices of determinant 1; {PAIRS}"),
        ("U", 1) => "complex numbers of modulus 1".to_owned(),
        ("U", 2..) => format!("unitary {n} x {n} matrices; {PAIRS}"),
        ("SL", 2) => "real 2 x 2 matrices of determinant 1; H, E, F".to_owned(),
        ("Sp", _) if n.is_multiple_of(2) => {
            format!("symplectic {n} x {n} matrices (A, B; C, -A^T); A, then symmetric B, then C")
        }
        ("Heisenberg", 0) => {
            "upper 3 x 3 matrices with diagonal 1; the centre comes last".to_owned()
        }
        ("Aff", 1) => "affine maps of the line; scaling, then translation".to_owned(),
        ("R", 1) => "translations of the line".to_owned(),
        ("R", 2..) => format!("translations of {n} dimensions"),
        _ => return None,
    };
    Some(text)
}

/// Reasons for which a text names no group.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// No group has this name.
    #[error(
        "unknown group `{name}`{}; known groups are {known}, and products such as SO3*SO3, SO3^4, SO3 |x R3",
        did_you_mean(.suggestion)
    )]
    Unknown {
        /// The name given.
        name: String,
        /// The nearest known name, if one is near.
        suggestion: Option<String>,
        /// All known names.
        known: String,
    },
    /// The text is not a product of groups.
    #[error("cannot read the group `{text}`: expected {expected} but found {found}")]
    Syntax {
        /// The whole text.
        text: String,
        /// The alternatives there.
        expected: &'static str,
        /// The text there.
        found: String,
    },
    /// The group has too many dimensions.
    #[error("the group `{name}` is too large: {what} is at most {limit}")]
    TooLarge {
        /// The name.
        name: String,
        /// The quantity limited.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// The group does not act on the space given.
    #[error("{group} does not act on {space} here; {instead}")]
    NoAction {
        /// The group.
        group: String,
        /// The space.
        space: String,
        /// A replacement.
        instead: String,
    },
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}

impl CatalogueError {
    pub(super) fn unknown(name: &str) -> Self {
        let suggestion = nearest(name, names().iter().copied()).map(str::to_owned);
        let known = names().join(", ");
        Self::Unknown { name: name.to_owned(), suggestion, known }
    }
}

/// The most dimensions of a product.
const LARGEST_DIMENSION: usize = 8192;

/// The tokens of a text; `×` as `*`, and `⋉` as `|x`.
fn tokens(text: &str) -> Result<Vec<&str>, CatalogueError> {
    let length =
        |rest: &str, inside: fn(char) -> bool| rest.find(|c| !inside(c)).unwrap_or(rest.len());
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let (token, end) = match first {
            '*' | '^' | '(' | ')' => (&rest[..1], 1),
            '×' => ("*", '×'.len_utf8()),
            '⋉' => ("|x", '⋉'.len_utf8()),
            // Rust tokens written out may have a space between: `| x`.
            '|' if rest[1..].trim_start().starts_with('x') => {
                ("|x", rest.len() - rest[1..].trim_start().len() + 1)
            }
            _ if first.is_ascii_digit() => {
                let end = length(rest, |c| c.is_ascii_digit());
                if rest[..end].parse().is_ok_and(|count: usize| count <= LARGEST_DIMENSION) {
                    (&rest[..end], end)
                } else {
                    return Err(too_large(text));
                }
            }
            _ if in_name(first) => {
                let name = length(rest, in_name);
                // `SO(3)` and `SL(2,R)`: the parenthesis belongs to the name.
                let argument = rest[name..].strip_prefix('(');
                let argument =
                    argument.filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
                let end = argument.and_then(|rest| rest.find(')')).map_or(name, |at| name + at + 2);
                (&rest[..end], end)
            }
            other => {
                return Err(CatalogueError::Syntax {
                    text: text.into(),
                    expected: "a group, `*`, `^`, `|x` or parentheses",
                    found: format!("`{other}`"),
                });
            }
        };
        tokens.push(token);
        rest = rest[end..].trim_start();
    }
    Ok(tokens)
}

fn in_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| in_name(c) && !c.is_ascii_digit())
}

fn too_large(name: &str) -> CatalogueError {
    CatalogueError::TooLarge { name: name.into(), what: "the dimension", limit: LARGEST_DIMENSION }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<&'a str>,
    at: usize,
    depth: usize,
}

// product = semidirect { ("*" | "×") semidirect }
// semidirect = power { ("|x" | "⋉") space [ "^" count ] }
// power = ( name | "(" product ")" ) [ "^" count ]
impl<'a> Parser<'a> {
    fn next(&mut self) -> Option<&'a str> {
        self.at += 1;
        self.tokens.get(self.at - 1).copied()
    }

    fn take(&mut self, token: &str) -> bool {
        let found = self.tokens.get(self.at) == Some(&token);
        self.at += usize::from(found);
        found
    }

    /// The token that was taken last is another one than was expected.
    fn syntax(&self, expected: &'static str) -> CatalogueError {
        let found = self.tokens.get(self.at - 1);
        let found = found.map_or("the end".to_owned(), |token| format!("`{token}`"));
        CatalogueError::Syntax { text: self.text.into(), expected, found }
    }

    fn product(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let mut factors = vec![self.semidirect()?];
        while self.take("*") {
            factors.push(self.semidirect()?);
        }
        if factors.iter().map(LieAlgebra::dim).sum::<usize>() > LARGEST_DIMENSION {
            return Err(too_large(self.text));
        }
        match <[LieAlgebra; 1]>::try_from(factors) {
            Ok([single]) => Ok(single),
            Err(factors) => Ok(LieAlgebra::direct_product(&factors)),
        }
    }

    fn semidirect(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let mut algebra = self.power()?;
        while self.take("|x") {
            let Some(space) = self.next().filter(|token| is_name(token)) else {
                return Err(self.syntax("a space such as R3 or Sym3"));
            };
            let copies = self.exponent()?.unwrap_or(1);
            algebra = self.extend(&algebra, space, copies)?;
        }
        Ok(algebra)
    }

    /// G ⋉ V^copies for the matrices of G acting on columns or on symmetric matrices.
    fn extend(
        &self,
        group: &LieAlgebra,
        space: &str,
        copies: usize,
    ) -> Result<LieAlgebra, CatalogueError> {
        let none = |instead: String| CatalogueError::NoAction {
            group: group.name().into(),
            space: space.into(),
            instead,
        };
        let Some(basis) = group.basis() else {
            return Err(none("it is known by its brackets alone; give the brackets".into()));
        };
        let size = basis.first().map_or(0, RationalMatrix::rows);
        let representation: Vec<RationalMatrix> = if space == format!("R{size}") {
            basis.to_vec()
        } else if space == format!("Sym{size}") {
            basis.iter().map(symmetric_square).collect()
        } else {
            let instead = format!("its matrices act on R{size} and Sym{size}");
            return Err(none(instead));
        };
        let dimension = representation.first().map_or(0, RationalMatrix::rows);
        let total = dimension.checked_mul(copies).and_then(|d| d.checked_add(group.dim()));
        if total.is_none_or(|total| total > LARGEST_DIMENSION) {
            return Err(too_large(self.text));
        }
        let suffix = if copies == 1 { String::new() } else { format!("^{copies}") };
        let name = format!("{} |x {space}{suffix}", group.name());
        LieAlgebra::semidirect_product(name, group, &representation, copies)
            .map_err(|error| none(error.to_string()))
    }

    fn power(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let base = match self.next() {
            Some(name) if is_name(name) => group(name)?,
            Some("(") if self.depth < 32 => {
                self.depth += 1;
                let inner = self.product()?;
                self.depth -= 1;
                if self.next() != Some(")") {
                    return Err(self.syntax("`)`"));
                }
                inner
            }
            _ => return Err(self.syntax("a group such as SO3")),
        };
        match self.exponent()? {
            None => Ok(base),
            Some(count) if base.dim().saturating_mul(count) > LARGEST_DIMENSION => {
                Err(too_large(self.text))
            }
            Some(count) => Ok(base.power(count)),
        }
    }

    fn exponent(&mut self) -> Result<Option<usize>, CatalogueError> {
        if !self.take("^") {
            return Ok(None);
        }
        match self.next().map(str::parse) {
            Some(Ok(count)) if count > 0 => Ok(Some(count)),
            _ => Err(self.syntax("a positive whole number")),
        }
    }
}
