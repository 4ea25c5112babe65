//! What the programs of a kernel read and write, by name.

use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use alloc::{borrow::ToOwned, format};

use crate::kernel::Kernel;
use crate::program::Program;

/// A part of a program's inputs or outputs: an array or a single number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// How many numbers it has; `None` for a single number that is no array.
    pub len: Option<usize>,
}

impl Field {
    /// An array of so many numbers.
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

/// The signatures of guess, correct, accept, transport, frame (where there is one), sound, watch and matrix; names of
/// functions begin with `prefix`.
#[must_use]
pub fn signatures<'a>(kernel: &'a Kernel, prefix: &str) -> Vec<Signature<'a>> {
    let (n, m, k) = (kernel.dim(), kernel.element(), kernel.constants());
    let programs = kernel.programs();
    let array = Field::array;
    let number = Field::number;
    let state = || vec![array("g", m), array("mu", n)];
    let moved = || vec![array("g_next", m), array("mu_next", n)];
    let with = |mut fields: Vec<Field>, last: Field| {
        fields.push(last);
        fields
    };
    let make = |name: &str, program, inputs, outputs| Signature {
        name: format!("{prefix}{name}"),
        program,
        inputs,
        outputs,
    };
    let mut list = vec![
        make("guess", &programs.guess, vec![array("mu", n)], vec![array("p", n), array("k", k)]),
        make(
            "correct",
            &programs.correct,
            vec![array("p", n), array("mu", n), array("k", k)],
            vec![array("p_next", n), array("x", n), number("left"), number("moved")],
        ),
        make(
            "accept",
            &programs.accept,
            vec![array("mu", n), array("x", n), number("left"), number("way")],
            vec![number("right")],
        ),
        make("transport", &programs.transport, with(state(), array("x", n)), moved()),
    ];
    if let Some(frame) = &programs.frame {
        list.push(make("frame", frame, with(state(), number("times")), moved()));
    }
    list.push(make("sound", &programs.sound, state(), vec![number("right")]));
    let watched = programs.watch.outputs().len();
    list.push(make("watch", &programs.watch, state(), vec![array("watched", watched)]));
    let entries = programs.matrix.outputs().len();
    list.push(make(
        "matrix",
        &programs.matrix,
        vec![array("g", m)],
        vec![array("matrix", entries)],
    ));
    list
}
