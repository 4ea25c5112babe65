//! The inputs and outputs of a kernel's programs, by name.

use alloc::string::String;
use alloc::vec::Vec;
use alloc::{borrow::ToOwned, format};

use crate::kernel::Kernel;
use crate::program::Program;
use crate::schedule::{Kind, Part, Variable};

/// A part of a program's inputs or outputs: an array or a single number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// How many numbers it has; `None` for a single number that is no array.
    pub len: Option<usize>,
}

impl Field {
    /// An array of this length.
    #[must_use]
    pub fn array(name: &str, len: usize) -> Self {
        Self { name: name.to_owned(), len: Some(len) }
    }

    /// A single number.
    #[must_use]
    pub fn number(name: &str) -> Self {
        Self { name: name.to_owned(), len: None }
    }

    /// How the number at `index` is written where `one` is the form of a single number.
    pub(super) fn place(&self, index: usize, one: impl Fn(&str) -> String) -> String {
        match self.len {
            Some(_) => format!("{}[{index}]", self.name),
            None => one(&self.name),
        }
    }
}

/// The name of a program, and names of its inputs and outputs in the order of their numbers.
///
/// Inputs beyond the fields, of which a well-made signature has none, read as the number 0; outputs beyond them are not
/// written.
#[derive(Clone, Debug)]
pub struct Signature<'a> {
    /// The name of the function.
    pub name: String,
    /// The program.
    pub program: &'a Program,
    /// The inputs.
    pub inputs: Vec<Field>,
    /// The outputs.
    pub outputs: Vec<Field>,
}

impl Signature<'_> {
    /// The field with a number, and the number's place in the field.
    pub(super) fn find(fields: &[Field], number: usize) -> Option<(&Field, usize)> {
        let mut left = number;
        for field in fields {
            let len = field.len.unwrap_or(1);
            if left < len {
                return Some((field, left));
            }
            left -= len;
        }
        None
    }
}

/// The signatures of the programs that the loop of a kernel calls; names of functions begin with `prefix`. An output that
/// is an input as well has a name of its own.
pub fn signatures<'a>(kernel: &'a Kernel, prefix: &str) -> impl Iterator<Item = Signature<'a>> {
    Part::ALL.into_iter().filter_map(move |(part, name)| {
        let (inputs, outputs) = part.variables();
        let field = |variable: Variable, end: &str| {
            let len = match variable.kind(kernel) {
                Kind::Array(len) => Some(len),
                Kind::Number | Kind::Count => None,
            };
            Field { name: format!("{}{end}", variable.name()), len }
        };
        let output = |&variable: &Variable| {
            field(variable, if inputs.contains(&variable) { "_next" } else { "" })
        };
        Some(Signature {
            name: format!("{prefix}{name}"),
            program: part.program(kernel)?,
            inputs: inputs.iter().map(|&variable| field(variable, "")).collect(),
            outputs: outputs.iter().map(output).collect(),
        })
    })
}
