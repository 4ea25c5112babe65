//! The table `[algebra]`: a Lie algebra by a basis of matrices, or by generators and brackets.

use super::table::{Table, span};
use crate::diagnostic::{Mistake, Span};
use crate::lie::{LieAlgebra, LieAlgebraError, RationalMatrix, catalogue};
use crate::number::Rational;
use crate::parse::{Names, bracket};

const BASIS: &str = "basis = [[[\"0\", \"-1\"], [\"1\", \"0\"]]]";
const GENERATORS: &str = "generators = [\"a\", \"b\", \"c\"]";
const BRACKETS: &str = "brackets = [\"[a, b] = c\", \"[a, c] = -1/2*b\"]";

/// Reads the table; the algebra is called `system` if the table names it not.
pub(super) fn read(table: &Table<'_>, system: &str) -> Option<LieAlgebra> {
    table.check_keys(&["name", "basis", "generators", "brackets"]);
    let name = table.string("name", "name = \"my-algebra\"");
    if let Some((name, place)) = name
        && catalogue::lookup(name).is_ok()
    {
        let taken = Mistake::NameTaken(name.to_owned(), "a known group".to_owned());
        table.diagnostics.report(place, taken);
    }
    let name = name.map_or_else(|| format!("the algebra of {system}"), |(name, _)| name.to_owned());
    let message = match (table.has("basis"), table.has("brackets")) {
        (true, false) => return by_basis(table, name),
        (false, true) => return by_brackets(table, name),
        (true, true) => "[algebra] has both `basis` and `brackets`",
        (false, false) => "[algebra] has neither `basis` nor `brackets`",
    };
    let help = format!("give either {BASIS}, or {GENERATORS} and {BRACKETS}");
    table.diagnostics.report_other(table.span, message, &help);
    None
}

fn generators(table: &Table<'_>) -> Option<Vec<(String, Span)>> {
    table.names("generators", GENERATORS).map(|(names, _)| names)
}

fn by_basis(table: &Table<'_>, name: String) -> Option<LieAlgebra> {
    let (list, whole) = table.array("basis", BASIS)?;
    let places: Vec<Span> = list.iter().map(|value| span(value)).collect();
    let matrices: Vec<RationalMatrix> = list
        .into_iter()
        .filter_map(|value| table.matrix("basis", value, BASIS).map(RationalMatrix::from_rows))
        .collect();
    if matrices.len() < places.len() {
        return None;
    }
    let names: Vec<String> = match generators(table) {
        Some(names) if names.len() == matrices.len() => {
            names.into_iter().map(|(name, _)| name).collect()
        }
        Some(names) => {
            let message = format!("{} generators for {} matrices", names.len(), matrices.len());
            table.diagnostics.report_other(whole, message, "give one name each");
            return None;
        }
        None => (1..=matrices.len()).map(|i| format!("e{i}")).collect(),
    };
    let rounded = matrices.iter().flat_map(RationalMatrix::entries).any(|(_, _, v)| rounded(v));
    LieAlgebra::from_named_basis(name, names.clone(), matrices)
        .map_err(|error| {
            let generator = match &error {
                LieAlgebraError::NotSquare { generator, .. }
                | LieAlgebraError::DifferentSizes { generator, .. }
                | LieAlgebraError::Dependent { generator, .. } => Some(generator),
                _ => None,
            };
            let at = generator.and_then(|g| names.iter().position(|name| name == g));
            let place = at.and_then(|at| places.get(at).copied()).unwrap_or(whole);
            table.diagnostics.report(place, not_exact(error, rounded));
        })
        .ok()
}

fn by_brackets(table: &Table<'_>, name: String) -> Option<LieAlgebra> {
    let before = table.diagnostics.len();
    let (list, whole) = table.strings("brackets", "a list of texts", BRACKETS)?;
    let Some(named) = generators(table) else {
        if !table.has("generators") {
            table.missing("generators", GENERATORS);
        }
        return None;
    };
    let mut names = Names::of_coordinates(&named, table.diagnostics);
    names.include(table.constants);
    let mut brackets = Vec::new();
    for (line, place) in &list {
        let offset = table.offset(*place, line);
        brackets.extend(bracket(line, offset, *place, &names, table.diagnostics));
    }
    if table.diagnostics.len() > before {
        return None;
    }
    let generators = named.into_iter().map(|(name, _)| name).collect();
    let rounded = brackets.iter().flat_map(|(_, _, terms)| terms).any(|(_, value)| rounded(value));
    let algebra = LieAlgebra::from_brackets(name, generators, brackets);
    table.diagnostics.check(whole, algebra.map_err(|error| not_exact(error, rounded)))
}

/// True for a number rounded to floating point, as roots are; false for a fraction that somebody wrote.
fn rounded(value: &Rational) -> bool {
    value.denom().bits() > 40
}

/// The mistake that data are no algebra, which may be due to rounding.
fn not_exact(error: LieAlgebraError, rounded: bool) -> Mistake {
    if !rounded {
        return Mistake::Algebra(error);
    }
    let help = "numbers such as sqrt(3) are rounded, while an algebra is checked exactly: scale the generators so that \
                its numbers are rational";
    Mistake::Other(error.to_string(), Some(help.to_owned()))
}
