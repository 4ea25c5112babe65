//! The table `[algebra]`: a Lie algebra by a basis of matrices, or by generators and brackets.

use toml::de::DeValue;

use super::table::{Table, matrix, span, wrong_kind};
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::lie::{LieAlgebra, LieAlgebraError, RationalMatrix, catalogue};
use crate::number::Rational;
use crate::parse::{Name, Names, bracket};

const BASIS: &str = "basis = [[[\"0\", \"-1\"], [\"1\", \"0\"]]]";
const GENERATORS: &str = "generators = [\"a\", \"b\", \"c\"]";
const BRACKETS: &str = "brackets = [\"[a, b] = c\", \"[a, c] = -1/2*b\"]";

/// Reads the table; the algebra is called `system` if the table names it not.
pub(super) fn read(
    table: &Table<'_>,
    system: &str,
    diagnostics: &mut Diagnostics,
) -> Option<LieAlgebra> {
    table.check_keys(&["name", "basis", "generators", "brackets"], diagnostics);
    let name = table.string("name", "name = \"my-algebra\"", diagnostics);
    if let Some((name, place)) = name
        && catalogue::lookup(name).is_ok()
    {
        let taken = Mistake::NameTaken(name.to_owned(), "a known group".to_owned());
        diagnostics.report(place, taken);
    }
    let name = name.map_or_else(|| format!("the algebra of {system}"), |(name, _)| name.to_owned());
    match (table.has("basis"), table.has("brackets")) {
        (true, false) => by_basis(table, name, diagnostics),
        (false, true) => by_brackets(table, name, diagnostics),
        (both, _) => {
            let message = if both {
                "[algebra] has both `basis` and `brackets`"
            } else {
                "[algebra] has neither `basis` nor `brackets`"
            };
            let help = format!("give either {BASIS}, or {GENERATORS} and {BRACKETS}");
            diagnostics.report(table.span, Mistake::Other(message.to_owned(), Some(help)));
            None
        }
    }
}

/// The names under `generators`.
fn generators(table: &Table<'_>, diagnostics: &mut Diagnostics) -> Option<Vec<(String, Span)>> {
    let (list, _) = table.array("generators", GENERATORS, diagnostics)?;
    let mut names = Vec::new();
    for value in list {
        match value.get_ref() {
            DeValue::String(name) => names.push((name.to_string(), span(value))),
            _ => wrong_kind("generators", "a list of names", value, GENERATORS, diagnostics),
        }
    }
    Some(names)
}

fn by_basis(table: &Table<'_>, name: String, diagnostics: &mut Diagnostics) -> Option<LieAlgebra> {
    let (list, whole) = table.array("basis", BASIS, diagnostics)?;
    let mut matrices = Vec::new();
    let mut places = Vec::new();
    for value in list {
        places.push(span(value));
        if let Some(rows) = matrix("basis", value, BASIS, table.constants, diagnostics) {
            matrices.push(RationalMatrix::from_rows(rows));
        }
    }
    if matrices.len() < places.len() {
        return None;
    }
    let names: Vec<String> = match generators(table, diagnostics) {
        Some(names) if names.len() == matrices.len() => {
            names.into_iter().map(|(name, _)| name).collect()
        }
        Some(names) => {
            let message = format!("{} generators for {} matrices", names.len(), matrices.len());
            diagnostics.report(whole, Mistake::Other(message, Some("give one name each".into())));
            return None;
        }
        None => (1..=matrices.len()).map(|i| format!("e{i}")).collect(),
    };
    let rounded = matrices.iter().flat_map(RationalMatrix::entries).any(|(_, _, v)| rounded(v));
    match LieAlgebra::from_named_basis(name, names.clone(), matrices) {
        Ok(algebra) => Some(algebra),
        Err(error) => {
            let generator = match &error {
                LieAlgebraError::NotSquare { generator, .. }
                | LieAlgebraError::DifferentSizes { generator, .. }
                | LieAlgebraError::Dependent { generator, .. } => Some(generator),
                _ => None,
            };
            let at = generator.and_then(|g| names.iter().position(|name| name == g));
            let place = at.and_then(|at| places.get(at).copied()).unwrap_or(whole);
            diagnostics.report(place, not_exact(error, rounded));
            None
        }
    }
}

fn by_brackets(
    table: &Table<'_>,
    name: String,
    diagnostics: &mut Diagnostics,
) -> Option<LieAlgebra> {
    let before = diagnostics.len();
    let (list, whole) = table.array("brackets", BRACKETS, diagnostics)?;
    let Some(named) = generators(table, diagnostics) else {
        if !table.has("generators") {
            let (key, owner) = ("generators".to_owned(), table.name().to_owned());
            let missing = Mistake::MissingKey(key, owner, GENERATORS.to_owned());
            diagnostics.report(table.span, missing);
        }
        return None;
    };
    let mut names = Names::default();
    for (i, (name, place)) in named.iter().enumerate() {
        names.add(name, Name::Coordinate(i), *place, diagnostics);
    }
    names.include(table.constants);
    let mut brackets = Vec::new();
    for value in list {
        match value.get_ref() {
            DeValue::String(line) => {
                // After the opening quote.
                let offset = value.span().start + 1;
                brackets.extend(bracket(line, offset, span(value), &names, diagnostics));
            }
            _ => wrong_kind("brackets", "a list of texts", value, BRACKETS, diagnostics),
        }
    }
    if diagnostics.len() > before {
        return None;
    }
    let generators = named.into_iter().map(|(name, _)| name).collect();
    let rounded = brackets.iter().flat_map(|(_, _, terms)| terms).any(|(_, value)| rounded(value));
    match LieAlgebra::from_brackets(name, generators, brackets) {
        Ok(algebra) => Some(algebra),
        Err(error) => {
            diagnostics.report(whole, not_exact(error, rounded));
            None
        }
    }
}

/// Whether a number is one of floating point, as roots are, and no fraction that somebody wrote.
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
