//! System files in tests.
#![allow(clippy::panic, clippy::unwrap_used)]

use coadjoint_codegen::system::{self, Options, Parameters, System};

/// The system of a file, with the values of its parameters put in.
pub fn read(text: &str) -> System {
    read_with(text, Options::default())
}

/// The system of a file with its parameters.
pub fn kept(text: &str) -> System {
    read_with(text, Options { parameters: Parameters::Kept, ..Options::default() })
}

pub fn read_with(text: &str, options: Options) -> System {
    system::read(text, options).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("f", text)))
}

/// The mistakes of a file.
pub fn said(text: &str) -> String {
    system::read(text, Options::default()).unwrap_err().render("file.toml", text)
}
