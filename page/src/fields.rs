//! The form that a user fills in: a system and a run of it, field by field, as texts.

use std::ops::Range;

use serde::{Deserialize, Serialize};
use toml::de::{DeTable, DeValue};

/// A system as the page's fields hold it. Every field is what the user typed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fields {
    pub name: String,
    /// A group of the catalogue, such as `SO3^4`; unused where `algebra` is given.
    pub group: String,
    /// The entries of the table `[algebra]`, in TOML; empty for a group of the catalogue.
    pub algebra: String,
    /// The names of the momentum's coordinates, separated by blanks or commas.
    pub coordinates: String,
    pub hamiltonian: String,
    /// `name = value`, one a line or separated by commas.
    pub parameters: String,
    pub truncation: String,
    /// `exp` or `cayley`.
    pub chart: String,
    /// `auto`, `fixed` or `comoving`.
    pub frame: String,
    /// `auto`, `series` or `collocation`.
    pub method: String,
    pub step: String,
    /// The momentum at the start, separated by blanks or commas.
    pub momentum: String,
    /// The duration of a run, for the file to copy.
    pub time: String,
}

impl Fields {
    /// The fields of a system file that is known to be right; `None` where it says something that has no field.
    pub fn of_file(text: &str) -> Option<Self> {
        let document = DeTable::parse(text).ok()?;
        let root = document.get_ref();
        let known = [
            "name",
            "group",
            "algebra",
            "coordinates",
            "hamiltonian",
            "parameters",
            "units",
            "integrator",
            "initial",
            "run",
        ];
        if root.keys().any(|key| !known.contains(&key.get_ref().as_ref())) {
            return None;
        }
        let table = |key: &str| root.get(key).and_then(|value| value.get_ref().as_table());
        let within = |of: &str, key: &str| table(of).and_then(|table| table.get(key));
        if within("initial", "time").is_some() {
            return None;
        }
        let raw = |range: Range<usize>| text.get(range).unwrap_or_default();
        let plain = |value: &toml::Spanned<DeValue<'_>>| match value.get_ref() {
            DeValue::String(content) => content.trim().to_owned(),
            _ => raw(value.span()).to_owned(),
        };
        let list = |value: &toml::Spanned<DeValue<'_>>| match value.get_ref() {
            DeValue::Array(entries) => entries.iter().map(plain).collect::<Vec<_>>().join(" "),
            _ => plain(value),
        };
        let entries = |key: &str, show: &dyn Fn(&toml::Spanned<DeValue<'_>>) -> String| {
            let mut pairs: Vec<_> = table(key).into_iter().flat_map(|table| table.iter()).collect();
            pairs.sort_by_key(|(name, _)| name.span().start);
            let line = |(name, value): &(&toml::Spanned<_>, &toml::Spanned<DeValue<'_>>)| {
                let name: &std::borrow::Cow<'_, str> = name.get_ref();
                format!("{name} = {}", show(value))
            };
            pairs.iter().map(line).collect::<Vec<_>>().join("\n")
        };
        let get = |value: Option<&toml::Spanned<DeValue<'_>>>, or: &str| {
            value.map_or_else(|| or.to_owned(), plain)
        };
        Some(Self {
            name: get(root.get("name"), "system"),
            group: get(root.get("group"), ""),
            algebra: entries("algebra", &|value| raw(value.span()).to_owned()),
            coordinates: root.get("coordinates").map(list).unwrap_or_default(),
            hamiltonian: get(root.get("hamiltonian"), ""),
            parameters: entries("parameters", &plain),
            truncation: get(within("integrator", "truncation"), "7"),
            chart: get(within("integrator", "chart"), "exp"),
            frame: get(within("integrator", "frame"), "auto"),
            method: get(within("integrator", "method"), "auto"),
            step: get(within("integrator", "step"), "0.1"),
            momentum: within("initial", "momentum").map(list).unwrap_or_default(),
            time: get(within("run", "time"), "10"),
        })
    }
}
