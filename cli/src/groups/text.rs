//! Groups for people.

use std::fmt::Write;

use super::facts::{Description, LARGEST};

/// Texts are not wider than this.
const WIDTH: usize = 100;
/// With more coordinates than this ad* is written out for the first one only.
const WRITTEN_OUT: usize = 10;
/// With more Casimirs than this only the first few are printed.
const CASIMIRS: usize = 8;
/// A formula longer than this is cut.
const LONGEST: usize = 400;

/// The syntax of products, printed below the list.
const PRODUCTS: &str = "\
SO4, SO5, ..., SU3, SU4, ..., U1, U2, ..., Sp2, Sp4, ... go up to n = 16, R1, R2, ... to n = 4096.
Parentheses are allowed: SO(3), SE_2(3).

Groups are put together in the key `group` of a system file:
  SO3*SE3        a product; the coordinates of the first factor come first
  SO3^64         a power; one copy's coordinates and momentum may be given for all copies
  SO3 |x R3      a semidirect product: the matrices of SO3 act on columns; R3^2 for two columns
  SO3 |x Sym3    the same with symmetric matrices, S to g S g^T
  (SO3*R1)^2     powers bind tightest, then |x, then *; at most 8192 dimensions

A group of your own is the table [algebra] in place of `group`: a `basis` of square rational matrices, or
`generators` and `brackets` such as \"[a, b] = 2*c\". docs/book/src/file-format.md shows both.

`coadjoint groups NAME` prints basis, brackets, the sign of ad*, Casimirs and charts of one group or product.
";

/// One line for each group.
pub(crate) fn list(all: &[Description]) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{:<12} {:>9}  {:<11} group and basis", "name", "dimension", "charts");
    for facts in all {
        let charts = if facts.no_cayley.is_none() { "exp, cayley" } else { "exp" };
        let _ = writeln!(
            out,
            "{:<12} {:>9}  {charts:<11} {}",
            facts.algebra.name(),
            facts.algebra.dim(),
            facts.summary.as_deref().unwrap_or_default()
        );
    }
    out.push('\n');
    out.push_str(PRODUCTS);
    out
}

/// Everything about one group.
pub(crate) fn group(facts: &Description) -> String {
    let mut out = String::new();
    let algebra = &facts.algebra;
    let what = facts.summary.as_ref().map(|summary| format!(": {summary}")).unwrap_or_default();
    let _ = writeln!(out, "{}{what}", algebra.name());
    let _ = writeln!(out, "dimension {}", algebra.dim());
    if algebra.dim() > LARGEST {
        let factors = algebra.factors();
        let _ = writeln!(
            out,
            "\n{} direct factors; the basis is that of the first, then that of the second, and so on. \
             `coadjoint groups` of a factor shows it.",
            factors.len()
        );
    } else {
        basis(&mut out, facts);
        brackets(&mut out, facts);
        ad_star(&mut out, facts);
    }
    casimirs(&mut out, facts);
    charts(&mut out, facts);
    out
}

fn basis(out: &mut String, facts: &Description) {
    let Some(size) = facts.size() else {
        out.push_str("\nknown by its brackets alone, without matrices\n");
        return;
    };
    let kind = match facts.complex {
        true => format!(
            "complex {0} x {0} matrices; group elements are the real {size} x {size} matrices ((A, -B), (B, A)) \
             of A + iB",
            size / 2
        ),
        false => format!("{size} x {size} matrices"),
    };
    let _ = writeln!(out, "\nbasis: {kind}");
    out.push_str("  (E(a,b) has a one in row a and column b, and zeros elsewhere)\n");
    for (i, matrix) in facts.algebra.basis().unwrap_or_default().iter().enumerate() {
        let _ = writeln!(out, "  e{} = {}", i + 1, facts.entries(matrix));
    }
    out.push('\n');
}

fn brackets(out: &mut String, facts: &Description) {
    let found = facts.brackets();
    if found.is_empty() {
        out.push_str("brackets: all zero\n");
        return;
    }
    out.push_str("brackets, those not written being zero\n");
    let texts: Vec<String> =
        found.iter().map(|(i, j, value)| format!("[e{i}, e{j}] = {value}")).collect();
    columns(out, &texts);
}

/// Texts in columns, as many as fit.
fn columns(out: &mut String, texts: &[String]) {
    let wide = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0) + 4;
    for row in texts.chunks((WIDTH / wide).max(1)) {
        let cells: Vec<String> = row.iter().map(|text| format!("{text:<wide$}")).collect();
        let _ = writeln!(out, "  {}", cells.concat().trim_end());
    }
}

fn ad_star(out: &mut String, facts: &Description) {
    out.push_str(
        "\nsign of ad*: <ad*_ξ μ, η> = <μ, [ξ, η]>, so (ad*_ξ μ)_j is the sum of ξ_i c_ij^l μ_l over i and l,\n\
         where [e_i, e_j] is the sum of c_ij^l e_l. The motion is dμ/dt = ad*_ξ μ with ξ = ∂H/∂μ.\n",
    );
    if let Some(vectors) = facts.ad_star_in_vectors() {
        let _ = writeln!(out, "  {vectors}");
    }
    let dim = facts.algebra.dim();
    let shown = if dim <= WRITTEN_OUT { dim } else { 1 };
    for j in 0..shown {
        let _ = writeln!(out, "  (ad*_ξ μ)_{} = {}", j + 1, cut(&facts.ad_star(j)));
    }
}

fn casimirs(out: &mut String, facts: &Description) {
    let (count, degree) = (facts.casimirs.len(), facts.degree);
    if count == 0 {
        let _ = writeln!(out, "\nCasimirs: none that is a polynomial of degree up to {degree}");
        return;
    }
    let _ = writeln!(out, "\nCasimirs: all polynomial ones of degree up to {degree} are made of");
    for casimir in facts.casimirs.iter().take(CASIMIRS) {
        let _ = writeln!(out, "  {}", cut(&facts.casimir(casimir)));
    }
    if count > CASIMIRS {
        let _ = writeln!(out, "  and {} more; --format json prints all", count - CASIMIRS);
    }
}

fn charts(out: &mut String, facts: &Description) {
    out.push_str("\ncharts of a step x, near the identity\n");
    let _ = writeln!(out, "  exp     {}", facts.exp_domain());
    let _ = match facts.cayley_domain() {
        Ok(domain) => writeln!(out, "  cayley  {domain}"),
        Err(why) => writeln!(out, "  cayley  does not exist: {why}"),
    };
}

/// A formula, or its beginning.
fn cut(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let short: String = text.chars().take(LONGEST).collect();
    format!("{short} ... (--format json prints all)")
}
