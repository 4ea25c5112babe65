//! What a case expects, judged by what came.

use std::collections::BTreeMap;

use coadjoint_learn::table::array;
use serde_json::Value;

use super::legible::legible;
use super::text::{Check, Place, Right};
use crate::support::{Folder, Ran, table, text_of};

/// The outcome of a command in its folder, and the JSON of those before it that have names.
pub(super) struct Outcome<'a> {
    pub folder: &'a Folder,
    pub ran: &'a Ran,
    pub known: &'a BTreeMap<String, Value>,
}

impl Outcome<'_> {
    pub(super) fn judge(&self, check: &Check) -> Result<(), String> {
        let right = |is: bool, else_: String| if is { Ok(()) } else { Err(else_) };
        match check {
            Check::Text(of, word, texts) => {
                let content = match of.as_str() {
                    "out" => self.ran.out.clone(),
                    "err" => self.ran.error.clone(),
                    name => self.existing(name)?.text(name),
                };
                texts.iter().try_for_each(|text| {
                    let text = &filled(text, self.known);
                    let count = content.matches(text.as_str()).count();
                    let is = match word.as_str() {
                        "has" => count > 0,
                        "lacks" => count == 0,
                        _ => count == 1,
                    };
                    right(is, format!("{of} has {count} times {text:?}"))
                })
            }
            Check::Equal(of, expected, [low, high]) => {
                let (found, expected) = (self.value(of)?, self.right(expected)?);
                let away = away(&found, &expected).unwrap_or(f64::INFINITY);
                let is = (*low <= away && away <= *high) || (*low == 0.0 && found == expected);
                right(is, format!("{found} instead of {expected}: {away:.2e} away"))
            }
            Check::Between(of, [low, high]) => {
                let found = self.value(of)?;
                let is = found.as_f64().is_some_and(|x| *low <= x && x <= *high);
                right(is, format!("{found} instead of a number from {low:e} to {high:e}"))
            }
            Check::Absent(Place::File(name)) => {
                right(!self.folder.has(name), format!("{name} is there"))
            }
            Check::Absent(of) => match self.value(of) {
                Ok(value) if !value.is_null() => Err(format!("there is {value}")),
                _ => Ok(()),
            },
            Check::Legible(name) => legible(&self.existing(name)?.text(name), 21),
            Check::SameFiles(one, other) => {
                let [a, b] = [one, other].map(|name| self.existing(name).map(|f| f.bytes(name)));
                right(a? == b?, format!("{one} and {other} differ"))
            }
        }
    }

    fn existing(&self, name: &str) -> Result<&Folder, String> {
        match self.folder.has(name) {
            true => Ok(self.folder),
            false => Err(format!("there is no file {name}")),
        }
    }

    pub(super) fn right(&self, right: &Right) -> Result<Value, String> {
        match right {
            Right::Value(value) => Ok(value.clone()),
            Right::Record(place) => self.value(place),
            Right::Of(file, path) if file.ends_with(".json") => {
                at(&serde_json::from_str(&text_of(file)).map_err(|error| error.to_string())?, path)
            }
            Right::Of(command, path) => {
                let known = self.known.get(command);
                at(known.ok_or_else(|| format!("no command is named {command}"))?, path)
            }
        }
    }

    fn value(&self, of: &Place) -> Result<Value, String> {
        match of {
            Place::Json(path) => {
                let json = serde_json::from_str(&self.ran.out);
                at(&json.map_err(|error| format!("no JSON: {error}"))?, path)
            }
            Place::Rows(file) => Ok(self.rows(file)?.len().into()),
            Place::Values(file) => Ok(self.rows(file)?.concat().into()),
            Place::Row(number, entries, file) => {
                let rows = self.rows(file)?;
                let at = if *number < 0 { rows.len() as i64 + number } else { number - 1 };
                let row = usize::try_from(at).ok().and_then(|at| rows.get(at));
                let row = row.ok_or_else(|| format!("{file} has {} rows", rows.len()))?;
                Ok(row.get(entries.start..entries.end.min(row.len())).unwrap_or_default().into())
            }
            Place::File(name) => Err(format!("{name} is no value")),
        }
    }

    /// The records of a table without its names, or the rows of an array.
    fn rows(&self, file: &str) -> Result<Vec<Vec<Value>>, String> {
        let folder = self.existing(file)?;
        if file.ends_with(".npy") {
            let (shape, numbers) = array(&folder.at(file)).map_err(|error| error.to_string())?;
            let width = shape.last().map_or(1, |width| (*width).max(1));
            let row = |row: &[f64]| row.iter().map(|x| Value::from(*x)).collect();
            return Ok(numbers.chunks(width).map(row).collect());
        }
        let cell = |cell: &String| serde_json::from_str(cell).unwrap_or(Value::Null);
        let rows = table(&folder.text(file)).into_iter().skip(1);
        Ok(rows.map(|row| row.iter().map(cell).collect()).collect())
    }
}

/// A text with the values of names between braces.
pub(super) fn filled(text: &str, known: &BTreeMap<String, Value>) -> String {
    let mut text = text.to_owned();
    for (name, value) in known {
        while let Some(start) = text.find(&format!("{{{name}")) {
            let Some(length) = text[start..].find('}') else { break };
            let path = text[start + 1 + name.len()..start + length].to_owned();
            let found = match path.strip_prefix('.') {
                Some(path) => at(value, path),
                None => Ok(value.clone()),
            };
            let Ok(found) = found else { break };
            let found = found.as_str().map_or_else(|| found.to_string(), str::to_owned);
            text.replace_range(start..=start + length, &found);
        }
    }
    text
}

/// A value by a path such as `runs[1].momentum`; a name in a list is that of each entry.
fn at(json: &Value, path: &str) -> Result<Value, String> {
    let mut keys = path.split(['.', '[']).filter(|key| !key.is_empty());
    keys.try_fold(json.clone(), |value, key| {
        let key = key.trim_end_matches(']');
        let found = match (&value, key.parse::<usize>()) {
            (Value::Array(entries), Err(_)) => entries
                .iter()
                .map(|entry| entry.get(key))
                .collect::<Option<Vec<_>>>()
                .map(|all| all.into_iter().cloned().collect()),
            (Value::Array(entries), Ok(number)) => entries.get(number).cloned(),
            _ => value.get(key).cloned(),
        };
        found.ok_or_else(|| format!("there is no {path}"))
    })
}

/// The largest difference, relative to the largest right number, of numbers in any shape; none where shapes differ.
fn away(found: &Value, right: &Value) -> Option<f64> {
    let (found, right) = (numbers(found)?, numbers(right)?);
    let largest = right.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let difference = found.iter().zip(&right).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (found.len() == right.len()).then(|| if difference == 0.0 { 0.0 } else { difference / largest })
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Array(entries) => {
            Some(entries.iter().map(numbers).collect::<Option<Vec<_>>>()?.concat())
        }
        Value::String(digits) => Some(vec![digits.parse().ok()?]),
        other => Some(vec![other.as_f64()?]),
    }
}
