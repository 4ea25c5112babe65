//! The source of the runtime's table-driven groups, from codegen's catalogue: exact bases,
//! brackets and Casimirs, stated in each group's documentation.

use std::fmt::Write as _;

use coadjoint_codegen::lie::{Chart, LieAlgebra, RationalMatrix, casimirs};
use coadjoint_codegen::number::Rational;
use num_traits::{One, Signed};

use crate::bridge::double;

/// The groups: name, what it is, and how its basis reads.
pub const GROUPS: [(&str, &str, &str); 8] = [
    ("SO4", "rotations of four-dimensional space", "E_ba − E_ab for a < b, in lexicographic order"),
    ("SO5", "rotations of five-dimensional space", "E_ba − E_ab for a < b, in lexicographic order"),
    (
        "SU3",
        "the special unitary group of ℂ³, as real 6×6 matrices ((A, −B), (B, A)) of A + iB",
        "for a < b in lexicographic order E_ab − E_ba and i(E_ab + E_ba); then \
         i(E_kk − E_k+1,k+1)",
    ),
    (
        "SU4",
        "the special unitary group of ℂ⁴, as real 8×8 matrices ((A, −B), (B, A)) of A + iB",
        "for a < b in lexicographic order E_ab − E_ba and i(E_ab + E_ba); then \
         i(E_kk − E_k+1,k+1)",
    ),
    (
        "U2",
        "the unitary group of ℂ², as real 4×4 matrices ((A, −B), (B, A)) of A + iB",
        "E_12 − E_21, i(E_12 + E_21), iE_11, iE_22",
    ),
    (
        "U3",
        "the unitary group of ℂ³, as real 6×6 matrices ((A, −B), (B, A)) of A + iB",
        "for a < b in lexicographic order E_ab − E_ba and i(E_ab + E_ba); then iE_kk",
    ),
    ("SL2", "real 2×2 matrices of determinant 1", "E_11 − E_22, E_12, E_21"),
    (
        "Aff1",
        "affine maps of the line, as 2×2 matrices",
        "the scaling E_11 and the translation E_12",
    ),
];

/// The source of the module of one group.
///
/// # Errors
/// `fmt::Error` never happens for strings.
pub fn source(
    algebra: &LieAlgebra,
    what: &str,
    basis_text: &str,
) -> Result<String, std::fmt::Error> {
    let (name, n) = (algebra.name(), algebra.dim());
    let basis = algebra.basis().unwrap_or_default();
    let size = basis.first().map_or(n, RationalMatrix::rows);
    let cayley = Chart::Cayley.check(algebra).is_ok();
    let invariants = casimirs(algebra, if n <= 9 { 3 } else { 2 }).unwrap_or_default();
    let mut out = String::new();
    writeln!(out, "//! {name}: {what}.")?;
    writeln!(out, "//!\n//! Written by the test `catalogue` of coadjoint-tests; do not edit.\n")?;
    writeln!(
        out,
        "use crate::table::{{BasisEntry, CasimirTerm, StaticAlgebra, StaticMatrixGroup, StructureConstant}};"
    )?;
    if cayley {
        writeln!(out, "use crate::table::CayleyAlgebra;")?;
    }
    writeln!(out, "\n/// The group {name}: {what}.\n///")?;
    writeln!(out, "/// Basis e1, e2, …: {basis_text}.\n///\n/// Brackets (all others are zero):")?;
    for i in 0..n {
        for j in i + 1..n {
            let terms = algebra.structure().iter().filter(|s| (s.i, s.j) == (i, j));
            let sum = sum(terms.map(|s| (s.value.clone(), format!("e{}", s.k + 1))));
            if sum != "0" {
                writeln!(out, "/// - \\[e{}, e{}\\] = {sum}", i + 1, j + 1)?;
            }
        }
    }
    if invariants.is_empty() {
        writeln!(out, "///\n/// It has no polynomial Casimir.")?;
    } else {
        writeln!(out, "///\n/// Casimirs:")?;
    }
    for casimir in &invariants {
        let terms = casimir.factors().map(|(factors, value)| {
            let factors = factors.iter().map(|&(i, power)| match power {
                1 => format!("μ{}", i + 1),
                _ => format!("μ{}^{power}", i + 1),
            });
            (value, factors.collect::<Vec<_>>().join(" "))
        });
        writeln!(out, "/// - {}", sum(terms))?;
    }
    let charts = if cayley {
        "Both charts."
    } else {
        "The exponential chart only: xξx leaves the algebra."
    };
    writeln!(out, "///\n/// {charts}")?;
    writeln!(
        out,
        "pub type {name}<T = f64> = StaticMatrixGroup<{name}Algebra, {n}, {size}, T>;\n"
    )?;
    writeln!(out, "/// The Lie algebra of [`{name}`] as tables.")?;
    writeln!(out, "#[derive(Clone, Copy, Debug)]\npub struct {name}Algebra;\n")?;
    writeln!(out, "impl StaticAlgebra for {name}Algebra {{")?;
    writeln!(out, "    const DIM: usize = {n};\n    const MATRIX_SIZE: usize = {size};")?;
    writeln!(out, "    const STRUCTURE: &'static [StructureConstant] = &[")?;
    for s in algebra.structure() {
        writeln!(out, "        ({}, {}, {}, {:?}),", s.i, s.j, s.k, double(&s.value))?;
    }
    writeln!(out, "    ];\n    const BASIS: Option<&'static [BasisEntry]> = Some(&[")?;
    for (i, e) in basis.iter().enumerate() {
        for (row, column, value) in e.entries() {
            writeln!(out, "        ({i}, {row}, {column}, {:?}),", double(value))?;
        }
    }
    writeln!(out, "    ]);\n    const CASIMIRS: &'static [&'static [CasimirTerm]] = &[")?;
    for casimir in &invariants {
        writeln!(out, "        &[")?;
        for (factors, value) in casimir.factors() {
            writeln!(out, "            ({:?}, &{factors:?}),", double(&value))?;
        }
        writeln!(out, "        ],")?;
    }
    writeln!(out, "    ];\n}}")?;
    if cayley {
        writeln!(out, "\nimpl CayleyAlgebra for {name}Algebra {{}}")?;
    }
    Ok(out)
}

/// `2e1 − ½e2` for people.
fn sum(terms: impl Iterator<Item = (Rational, String)>) -> String {
    let mut text = String::new();
    for (value, what) in terms {
        let sign = if value.is_negative() { "−" } else { "+" };
        if !text.is_empty() {
            text = format!("{text} {sign} ");
        } else if value.is_negative() {
            text.push('−');
        }
        let size = value.abs();
        if !size.is_one() {
            let _ = write!(text, "{size} ");
        }
        text.push_str(&what);
    }
    if text.is_empty() { "0".into() } else { text }
}
