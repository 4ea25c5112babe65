//! The names an expression may use.

use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::Function;
use crate::number::Rational;

#[derive(Clone, Debug, PartialEq, Eq)]
// Some are those of files alone.
#[cfg_attr(not(feature = "system"), allow(dead_code))]
pub(crate) enum Name {
    /// A coordinate of the momentum, counted from 0.
    Coordinate(usize),
    /// A scalar parameter, counted through all parameters flattened.
    Parameter(usize),
    Number(Rational),
    Time,
    /// An input, a function of the time, counted from 0.
    Signal(usize),
    /// A part of formulas: its text, and where it begins in the file.
    Part {
        text: String,
        offset: usize,
    },
}

impl Name {
    fn describe(&self) -> &'static str {
        match self {
            Self::Coordinate(_) => "a coordinate of the momentum",
            Self::Parameter(_) | Self::Number(_) => "a parameter",
            Self::Time => "the time",
            Self::Signal(_) => "an input",
            Self::Part { .. } => "a part under [let]",
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    known: BTreeMap<String, Name>,
    /// Names in the order given, for messages.
    order: Vec<String>,
    /// Names whose definitions are mistakes already.
    wrong: BTreeSet<String>,
    /// There may be others, which a mistake in the coordinates or the group has hidden.
    incomplete: bool,
    /// Reasons for which parameters have no inverse.
    singular: BTreeMap<String, String>,
}

impl Names {
    /// Adds a second name of something, which messages do not list; nothing where the name is known already.
    #[cfg(feature = "system")]
    pub(crate) fn alias(&mut self, name: String, meaning: Name) {
        self.known.entry(name).or_insert(meaning);
    }

    /// Adds a name that messages list; nothing where it is known already.
    #[cfg(feature = "system")]
    pub(crate) fn known(&mut self, name: &str, meaning: Name) {
        if !self.known.contains_key(name) {
            self.order.push(name.to_owned());
            self.alias(name.to_owned(), meaning);
        }
    }

    /// Uses of this name, whose definition is a mistake, are no further mistakes.
    #[cfg(feature = "system")]
    pub(crate) fn excuse(&mut self, name: &str) {
        self.wrong.insert(name.to_owned());
    }

    /// Unknown names are no further mistakes.
    #[cfg(feature = "system")]
    pub(crate) fn set_incomplete(&mut self) {
        self.incomplete = true;
    }

    /// The reason for which this parameter has no inverse.
    #[cfg(feature = "system")]
    pub(crate) fn set_singular(&mut self, name: &str, reason: String) {
        self.singular.insert(name.to_owned(), reason);
    }

    /// True if a name in this text is unknown only because of a mistake that is reported.
    pub(super) fn excuses(&self, text: &str) -> bool {
        let mut words = text.split(|c| !continues_name(c));
        self.incomplete || words.any(|word| self.wrong.contains(word))
    }

    /// Adds a name, or reports that it is no name or already taken.
    pub(crate) fn add(&mut self, name: &str, meaning: Name, span: Span, diagnostics: &Diagnostics) {
        let taken = if !is_name(name) {
            self.incomplete = true;
            return diagnostics.report(span, Mistake::BadName(name.to_owned()));
        } else if Function::lookup(name).is_some() || name == "sum" {
            "a function"
        } else if let Some(before) = self.known.get(name) {
            before.describe()
        } else {
            self.known.insert(name.to_owned(), meaning);
            self.order.push(name.to_owned());
            return;
        };
        self.incomplete = true;
        diagnostics.report(span, Mistake::NameTaken(name.to_owned(), taken.to_owned()));
    }

    /// The names of coordinates, which are told apart by their places.
    pub(crate) fn of_coordinates(names: &[(String, Span)], diagnostics: &Diagnostics) -> Self {
        let mut known = Self::default();
        for (i, (name, place)) in names.iter().enumerate() {
            known.add(name, Name::Coordinate(i), *place, diagnostics);
        }
        known
    }

    /// Adds every name of others that is not known yet.
    #[cfg(feature = "system")]
    pub(crate) fn include(&mut self, others: &Self) {
        let new = others.order.iter().filter(|name| !self.known.contains_key(*name)).cloned();
        self.order.extend(new.collect::<Vec<_>>());
        for (name, meaning) in &others.known {
            self.alias(name.clone(), meaning.clone());
        }
        self.inherit(others);
    }

    /// Adds the names that others lack, with the reasons.
    #[cfg(feature = "system")]
    pub(crate) fn inherit(&mut self, others: &Self) {
        self.wrong.extend(others.wrong.iter().cloned());
        self.incomplete |= others.incomplete;
        self.singular.extend(others.singular.clone());
    }

    pub(crate) fn get(&self, name: &str) -> Option<&Name> {
        self.known.get(name)
    }

    /// The number of entries of the list with this name; `None` if there is no such list.
    pub(crate) fn entries(&self, list: &str) -> Option<usize> {
        let start = format!("{list}[");
        let inside = self.known.range(start.clone()..).map(|(name, _)| name.strip_prefix(&start));
        let indices = inside.map_while(|inside| inside?.split(']').next()?.parse::<usize>().ok());
        indices.max().map(|last| last + 1)
    }

    pub(crate) fn unknown(&self, name: &str) -> Mistake {
        if matches!(name, "t" | "time") {
            return Mistake::Time(name.to_owned());
        }
        if let Some((matrix, indices)) = name.strip_prefix("inv(").and_then(|n| n.split_once(')')) {
            return match self.singular.get(matrix) {
                Some(reason) => Mistake::NoInverse(matrix.to_owned(), reason.clone()),
                None if indices.is_empty()
                    || !is_word(matrix)
                    || self.entries(matrix).is_some() =>
                {
                    Mistake::Inverse(name.to_owned())
                }
                None => self.unknown(matrix),
            };
        }
        if let Some(count) = self.entries(name) {
            return Mistake::List(name.to_owned(), count);
        }
        let suggestion = nearest(name, self.order.iter().map(String::as_str));
        let suggestion = suggestion.map(str::to_owned);
        Mistake::UnknownVariable(name.to_owned(), suggestion, self.order.clone())
    }
}

pub(super) fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

pub(super) fn continues_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '\''
}

/// True if the text is a name without indices.
pub(super) fn is_word(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(begins_name) && letters.all(continues_name)
}

fn is_name(text: &str) -> bool {
    let (head, indices) = text.split_at(text.find('[').unwrap_or(text.len()));
    let digits = |i: &str| {
        let i = i.strip_suffix(']').unwrap_or("");
        !i.is_empty() && i.bytes().all(|b| b.is_ascii_digit())
    };
    is_word(head) && indices.split('[').skip(1).all(digits)
}
