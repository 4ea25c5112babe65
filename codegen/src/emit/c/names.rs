//! Names in C.

use std::collections::BTreeSet;

use crate::emit::{camel_case, fresh};
use crate::problem::Parameter;
use crate::step::StepError;

/// Words that C99 or C++ keep for themselves, as far as they are in lower case.
const KEYWORDS: &str = " alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t \
    char32_t class co_await co_return co_yield compl concept const consteval constexpr constinit const_cast continue \
    decltype default delete do double dynamic_cast else enum explicit export extern false float for friend goto if \
    inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public \
    register reinterpret_cast requires restrict return short signed sizeof static static_assert static_cast struct \
    switch template this thread_local throw true try typedef typeid typename union unsigned using virtual void volatile \
    wchar_t while xor xor_eq asm fortran linux unix errno stdin stdout stderr near far small interface ";

/// The prefix of the names in a system's header: `rigid_body` for `rigid-body` and for `RigidBody`.
#[must_use]
pub fn prefix(name: &str) -> String {
    let name = identifier(name).to_lowercase();
    let name = name.trim_matches('_');
    match name.chars().next() {
        Some(first) if first.is_ascii_alphabetic() => name.to_owned(),
        Some(_) => format!("system_{name}"),
        None => "system".to_owned(),
    }
}

/// Letters and digits of ASCII; what else there is becomes an underscore, several of them one.
fn identifier(name: &str) -> String {
    let mut result = String::new();
    for letter in name.chars() {
        if letter.is_ascii_alphanumeric() {
            result.push(letter);
        } else if !result.ends_with('_') {
            result.push('_');
        }
    }
    result
}

/// True if a name looks like a macro, as `NAN`, `M_PI` and, of complex numbers, `I` do: two capitals or more, or an
/// underscore, and nothing in lower case.
fn is_macro(name: &str) -> bool {
    let capitals = name.chars().filter(|c| !c.is_ascii_digit()).count();
    name == "I" || (capitals > 1 && !name.chars().any(|c| c.is_ascii_lowercase()))
}

#[derive(Debug)]
pub(crate) struct Names {
    /// The prefix of functions and types.
    pub lower: String,
    /// The prefix of macros and constants.
    pub upper: String,
    /// The class of C++.
    pub class: String,
    /// Members for the parameters, in their order.
    pub parameters: Vec<String>,
    ending: &'static str,
}

impl Names {
    pub(crate) fn new(parameters: &[Parameter], options: &HeaderOptions) -> Self {
        let lower = prefix(&options.prefix);
        let mut taken = BTreeSet::new();
        let mut member = |name: &str| {
            let name = match identifier(name).trim_start_matches('_') {
                "" => "parameter".to_owned(),
                name if name.starts_with(|first: char| first.is_ascii_digit()) => {
                    format!("p{name}")
                }
                name if KEYWORDS.contains(&format!(" {name} ")) || is_macro(name) => {
                    format!("{name}_")
                }
                name => name.to_owned(),
            };
            let name = fresh(&name, &taken);
            taken.insert(name.clone());
            name
        };
        Self {
            upper: lower.to_uppercase(),
            class: camel_case(&lower),
            parameters: parameters.iter().map(|parameter| member(&parameter.name)).collect(),
            ending: match options.language {
                Language::C => "H",
                Language::Cpp => "HPP",
            },
            lower,
        }
    }

    /// The macro that guards against including the header twice.
    pub(crate) fn guard(&self) -> String {
        format!("{}_{}", self.upper, self.ending)
    }

    pub(crate) fn file(&self) -> String {
        format!("{}.{}", self.lower, self.ending.to_lowercase())
    }

    /// A template with its names put in: `@p@` and `@P@` for the prefix, `@G@` for the guard.
    pub(crate) fn fill(&self, template: &str) -> String {
        template
            .replace("@p@", &self.lower)
            .replace("@P@", &self.upper)
            .replace("@G@", &self.guard())
            .replace("@C@", &self.class)
    }
}

/// The most operations of a step (first guess, one correction, acceptance, transport) that are written as C: about
/// half a megabyte of machine code, and a minute of a compiler.
pub(super) const MOST_OPERATIONS: usize = 40_000;

/// The language of a header.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// C99, which C++ can include.
    #[default]
    C,
    /// C99 with a class of C++11 around it.
    Cpp,
}

/// Options of writing a header.
#[derive(Clone, Debug, Default)]
pub struct HeaderOptions {
    /// The language.
    pub language: Language,
    /// The prefix of all names; see [`prefix`](super::prefix).
    pub prefix: String,
    /// The unit of time, for comments.
    pub time: Option<String>,
    /// The units of the momentum's coordinates, for comments; missing ones are none.
    pub momentum: Vec<Option<String>>,
    /// The one step size that means something, for learned maps.
    pub only_step: Option<f64>,
}

/// Errors of writing a system as C.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HeaderError {
    /// A step of it is not made of straight-line programs.
    #[error("cannot be written as C: {0}")]
    Step(#[from] StepError),
    /// A step has too many operations.
    #[error(
        "too large for a header: a step has {operations} operations, more than the limit of {limit}; lower the \
         truncation, or run it with `coadjoint simulate --backend c`"
    )]
    TooLarge {
        /// Its operations.
        operations: usize,
        /// The most that are written as C.
        limit: usize,
    },
    /// Steps depend on inputs, or have kicks and depend on time.
    #[error(
        "cannot be written as C: its steps depend on inputs, or have kicks and depend on time; `simulate`, `ensemble` and \
         Python make them"
    )]
    Moves,
    /// Nothing moves.
    #[error("cannot be written as C: the Hamiltonian is constant, and nothing moves")]
    Constant,
    /// The series has terms of a degree for which no radius is computed.
    #[error(
        "cannot be written as C: S has a term of degree {degree}, and the bound on its last terms knows of {limit} at \
         most; lower the truncation"
    )]
    Degree {
        /// The degree.
        degree: u32,
        /// The highest one.
        limit: u32,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_c() {
        assert_eq!(prefix("rigid-body"), "rigid_body");
        assert_eq!(prefix("  Ω body 3!"), "body_3");
        assert_eq!(prefix("3 bodies"), "system_3_bodies");
        assert_eq!(prefix("…"), "system");
    }
}
