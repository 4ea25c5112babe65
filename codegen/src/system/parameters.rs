//! The table `[parameters]`: numbers with names, which every other number of the file may use.

use std::collections::BTreeSet;

use num_traits::One;
use toml::de::DeValue;

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
    /// With their places in the table.
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
    /// Reads the table: values may use other parameters. Those in `[algebra]` and `damping`, in indices, in ranges of sums and in
    /// `inv(…)` are numbers and never kept. Those called in `varied` are kept, whatever the options say, or refused.
    pub(super) fn read(root: &Table<'_>, options: Options, varied: &[String]) -> Self {
        let mut result = Self { list: Vec::new(), constants: Names::default() };
        let Some(table) = root.table("parameters") else { return result };
        let of_key = |key| root.get(key).map_or(BTreeSet::new(), |value| words_of(value.get_ref()));
        let mut numbers = of_key("algebra");
        numbers.extend(of_key("damping"));
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
        let entries = table.entries();
        let used: Vec<_> = entries.iter().map(|(.., value)| words_of(value.get_ref())).collect();
        // Each after those that it uses, as far as there is no circle.
        let mut left: Vec<usize> = (0..entries.len()).collect();
        let mut order = Vec::new();
        while !left.is_empty() {
            let ready = |&i: &usize| left.iter().all(|&other| !used[i].contains(entries[other].0));
            let next = left.iter().position(ready).unwrap_or(0);
            order.push(left.remove(next));
        }
        for at in order {
            let (name, place, value) = entries[at];
            let known = table.with(&result.constants);
            // The name of a wrong one is known all the same, so that its uses are no further mistakes.
            let (shape, values) = result
                .value(name, value, &known)
                .unwrap_or_else(|| (Shape::Scalar, vec![Rational::one()]));
            let parameter = Parameter { name: name.to_owned(), shape, default: Some(values) };
            let varies = varied.iter().any(|varied| varied == name);
            let user = entries.iter().zip(&used).find(|(_, words)| words.contains(name));
            let why = match user {
                _ if numbers.contains(name) => Some(
                    "it is a number of the algebra or of the damping, an index, the range of a sum or inv(…)"
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
            let inverse = if root.file.contains("inv(") { inverse(&parameter) } else { None };
            let given = Given { parameter, place, kept, inverse };
            given.add_to(&mut result.constants, None, root.diagnostics);
            result.list.push((at, given));
        }
        result.list.sort_by_key(|(at, _)| *at);
        result
    }

    /// Adds their names to others, and returns those that are kept.
    pub(super) fn add_to(&self, names: &mut Names, diagnostics: &Diagnostics) -> Vec<Parameter> {
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

fn inverse(parameter: &Parameter) -> Option<RationalMatrix> {
    let (Shape::Grid(_, columns), Some(values)) = (&parameter.shape, &parameter.default) else {
        return None;
    };
    RationalMatrix::from_rows(values.chunks((*columns).max(1)).map(<[_]>::to_vec)).inverse()
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
