//! The table `[parameters]`: numbers with names, which every other number of the file may use.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::One;
use toml::de::{DeTable, DeValue};

use super::options::{Options, Parameters as Treatment};
use super::table::{Table, Value};
use crate::diagnostic::{Diagnostics, Span};
use crate::lie::RationalMatrix;
use crate::number::Rational;
use crate::parse::{Name, Names, words};
use crate::problem::{Parameter, Shape};

/// The parameters of a file, in its order.
#[derive(Debug)]
pub(super) struct Parameters {
    /// The parameters with their places in the table.
    list: Vec<(usize, Given)>,
    /// All of them as numbers.
    pub constants: Names,
}

#[derive(Debug)]
struct Given {
    parameter: Parameter,
    place: Span,
    kept: bool,
    /// The inverse, where there is one and the file asks for some.
    inverse: Option<RationalMatrix>,
}

impl Parameters {
    /// Reads the table: values may use other parameters. Those in `[algebra]` and in inputs, in indices, in ranges of sums and in
    /// `inv(…)` are numbers and never kept. Those called in `varied` are kept, whatever the options say, or refused.
    pub(super) fn read(root: &Table<'_>, options: Options, varied: &[String]) -> Self {
        Self::read_those(root, options, varied, |_| true)
    }

    /// As [`Parameters::read`], of the entries whose values are such.
    pub(super) fn read_those(
        root: &Table<'_>,
        options: Options,
        varied: &[String],
        such: impl Fn(&DeValue<'_>) -> bool,
    ) -> Self {
        let mut result = Self { list: Vec::new(), constants: Names::default() };
        let Some(table) = root.table("parameters") else { return result };
        let inverts = root.file.contains("inv(");
        let keys = ["algebra", "inputs", "breaks"].iter().filter_map(|key| root.get(key));
        let mut numbers: BTreeSet<_> = keys.flat_map(|value| words_of(value.get_ref())).collect();
        let energy = |key: &&str| root.get(key)?.get_ref().as_str();
        for text in ["hamiltonian", "potential"].iter().filter_map(energy) {
            let after = |open, close| {
                text.split(open).skip(1).flat_map(move |rest| rest.split(close).next())
            };
            // The bounds of sums stand between commas.
            let range = |at: usize| [text[..at].rsplit(',').next(), text[at..].split(',').next()];
            let ranges = text.match_indices("..").flat_map(|(at, _)| range(at)).flatten();
            numbers.extend(after("inv(", ')').chain(after("[", ']')).chain(ranges).flat_map(words));
        }
        let mut entries = table.entries();
        entries.retain(|(.., value)| such(value.get_ref()));
        let used: Vec<_> = entries.iter().map(|(.., value)| words_of(value.get_ref())).collect();
        for (at, circular) in order(&entries, &used) {
            let (name, place, value) = entries[at];
            let known = table.with(&result.constants);
            let found = match circular {
                false => result.value(name, value, &known),
                true => {
                    let what = format!("the parameter `{name}` is computed from itself");
                    table.refuse(place, &what, &format!("{name} = 1.5"));
                    None
                }
            };
            if found.is_none() {
                result.constants.excuse(name);
            }
            let (shape, values) = found.unwrap_or_else(|| (Shape::Scalar, vec![Rational::one()]));
            let parameter = Parameter { name: name.to_owned(), shape, default: Some(values) };
            let varies = varied.iter().any(|varied| varied == name);
            let using = || entries.iter().zip(&used).find(|(_, words)| words.contains(name));
            let user = varies.then(using).flatten();
            let why = match user {
                _ if numbers.contains(name) => Some(
                    "it is a number of the algebra or of an input, an index, the range of a sum or inv(…)"
                        .to_owned(),
                ),
                Some(((user, ..), _)) => Some(format!("`{user}` is computed from it")),
                None => None,
            };
            if let Some(why) = why.filter(|_| varies) {
                let what = format!(
                    "the parameter `{name}` can neither vary from row to row nor have derivatives: {why}"
                );
                let help = "give each value a system file of its own";
                root.diagnostics.report_other(place, &what, help);
            }
            let kept = (varies || options.parameters == Treatment::Kept) && !numbers.contains(name);
            let inverse = if inverts { inverse(&parameter, &mut result.constants) } else { None };
            let given = Given { parameter, place, kept, inverse };
            given.add_to(&mut result.constants, None, root.diagnostics);
            result.list.push((at, given));
        }
        result.list.sort_by_key(|(at, _)| *at);
        result
    }

    /// Adds their names to others, and returns those that are kept.
    pub(super) fn add_to(&self, names: &mut Names, diagnostics: &Diagnostics) -> Vec<Parameter> {
        names.inherit(&self.constants);
        let mut scalars = 0;
        let mut kept = Vec::new();
        for (_, given) in &self.list {
            given.add_to(names, given.kept.then_some(scalars), diagnostics);
            if given.kept {
                scalars += given.parameter.shape.len();
                kept.push(given.parameter.clone());
            }
        }
        kept
    }

    pub(super) fn all(&self) -> Vec<Parameter> {
        self.list.iter().map(|(_, given)| given.parameter.clone()).collect()
    }

    /// A number, an array of numbers, an array of such arrays, or the inverse of one.
    fn value(
        &self,
        name: &str,
        value: &Value<'_>,
        table: &Table<'_>,
    ) -> Option<(Shape, Vec<Rational>)> {
        let example = format!("{name} = 1.5 or {name} = \"2/3\"");
        match value.get_ref() {
            DeValue::Array(list) if list.iter().any(|entry| entry.get_ref().is_array()) => {
                let rows = table.matrix(name, value, &example)?;
                let columns = rows.first().map_or(0, Vec::len);
                Some((Shape::Grid(rows.len(), columns), rows.concat()))
            }
            DeValue::Array(list) => {
                let values = table.numbers(name, list.iter(), &example)?;
                Some((Shape::Array(values.len()), values))
            }
            other => match other.as_str().and_then(|text| self.inverse(text)) {
                Some(inverse) => {
                    let n = inverse.rows();
                    let entries = (0..n * n).map(|at| inverse.get(at / n, at % n));
                    Some((Shape::Grid(n, n), entries.collect()))
                }
                None => Some((Shape::Scalar, vec![table.exact(name, value, &example)?])),
            },
        }
    }

    /// The matrix that `inv(J)` is.
    fn inverse(&self, text: &str) -> Option<&RationalMatrix> {
        let name = text.trim().strip_prefix("inv(")?.strip_suffix(')')?.trim();
        let found = self.list.iter().find(|(_, given)| given.parameter.name == name)?;
        found.1.inverse.as_ref()
    }
}

impl Given {
    /// Adds the names of its scalars: numbers, or parameters counted from `first`; and those of its inverse.
    fn add_to(&self, names: &mut Names, first: Option<usize>, diagnostics: &Diagnostics) {
        let Parameter { name, default, .. } = &self.parameter;
        let values = default.iter().flatten();
        for (i, (scalar, value)) in self.parameter.scalar_names().iter().zip(values).enumerate() {
            let meaning = match first {
                None => Name::Number(value.clone()),
                Some(first) => Name::Parameter(first + i),
            };
            names.add(scalar, meaning, self.place, diagnostics);
        }
        let Some(inverse) = &self.inverse else { return };
        for at in 0..inverse.rows() * inverse.rows() {
            let (i, j) = (at / inverse.rows(), at % inverse.rows());
            names.alias(format!("inv({name})[{i}][{j}]"), Name::Number(inverse.get(i, j)));
        }
    }
}

/// The text of a system file with these values of some of its parameters, flattened by rows, in place of its own.
#[must_use]
pub fn with_values(text: &str, values: &[(&Parameter, &[f64])]) -> String {
    let (document, _) = DeTable::parse_recoverable(text);
    let table = document.get_ref().get("parameters").and_then(|own| own.get_ref().as_table());
    let place = |name: &str| Some(table?.get(name)?.span());
    let list = |numbers: &[f64]| format!("{numbers:?}");
    let shown = |parameter: &Parameter, numbers: &[f64]| match parameter.shape.lengths()[..] {
        [] => numbers.first().map_or(String::new(), |number| format!("{number:?}")),
        [_] => list(numbers),
        [_, columns, ..] => {
            let rows: Vec<String> = numbers.chunks(columns.max(1)).map(list).collect();
            format!("[{}]", rows.join(", "))
        }
    };
    let places = values.iter().filter_map(|(parameter, numbers)| {
        Some((place(&parameter.name)?, shown(parameter, numbers)))
    });
    let mut places: Vec<_> = places.collect();
    // From the end on, so that the other places stay.
    places.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
    let mut text = text.to_owned();
    places.into_iter().for_each(|(place, shown)| text.replace_range(place, &shown));
    text
}

/// The inverse of a parameter; without one, `names` get the reason.
fn inverse(parameter: &Parameter, names: &mut Names) -> Option<RationalMatrix> {
    let Parameter { name, shape, default } = parameter;
    let (inverse, reason) = match (shape, default) {
        (Shape::Grid(rows, columns), Some(values)) if rows == columns => {
            let rows = values.chunks((*columns).max(1)).map(<[_]>::to_vec);
            (RationalMatrix::from_rows(rows).inverse(), "the matrix is singular".to_owned())
        }
        (Shape::Grid(rows, columns), _) => (None, format!("it is {rows} × {columns}, not square")),
        _ => (None, "it is no matrix".to_owned()),
    };
    if inverse.is_none() {
        names.set_singular(name, reason);
    }
    inverse
}

/// The entries, each after those that it uses and else in their order; a circle is entered at its first, which is marked.
fn order(entries: &[(&str, Span, &Value<'_>)], used: &[BTreeSet<String>]) -> Vec<(usize, bool)> {
    let places: BTreeMap<&str, usize> =
        entries.iter().enumerate().map(|(at, (name, ..))| (*name, at)).collect();
    let mut users = vec![Vec::new(); entries.len()];
    let mut missing = vec![0; entries.len()];
    for (at, words) in used.iter().enumerate() {
        for &other in words.iter().filter_map(|word| places.get(&word[..])) {
            users[other].push(at);
            missing[at] += 1;
        }
    }
    let mut left: BTreeSet<usize> = (0..entries.len()).collect();
    let mut ready: BTreeSet<usize> = left.iter().copied().filter(|&at| missing[at] == 0).collect();
    let mut order = Vec::new();
    while let Some(&first) = ready.first().or(left.first()) {
        let circular = ready.is_empty();
        let at = if circular { on_circle(first, used, &places, &left) } else { first };
        ready.remove(&at);
        left.remove(&at);
        order.push((at, circular));
        for &user in &users[at] {
            missing[user] -= 1;
            if missing[user] == 0 && left.contains(&user) {
                ready.insert(user);
            }
        }
    }
    order
}

/// An entry that uses itself in the end, found from one of those that are left, all of which use another one.
fn on_circle(
    mut at: usize,
    used: &[BTreeSet<String>],
    places: &BTreeMap<&str, usize>,
    left: &BTreeSet<usize>,
) -> usize {
    let mut seen = BTreeSet::new();
    while seen.insert(at) {
        let mut others = used[at].iter().filter_map(|word| places.get(&word[..]));
        at = others.find(|other| left.contains(other)).copied().unwrap_or(at);
    }
    at
}

fn words_of(value: &DeValue<'_>) -> BTreeSet<String> {
    match value {
        DeValue::String(text) => words(text).collect(),
        DeValue::Array(list) => list.iter().flat_map(|entry| words_of(entry.get_ref())).collect(),
        DeValue::Table(table) => {
            table.iter().flat_map(|(_, entry)| words_of(entry.get_ref())).collect()
        }
        _ => BTreeSet::new(),
    }
}
