//! What is said of mistakes: each file of `codegen/tests/cases` is of one kind of input, and says of each all that is said.
//!
//! ```text
//! # the kind of input
//! ====
//! group = SO3
//! ----
//! system.toml:1:9: error: …
//! ====
//! …
//! ```
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-codegen --test all cases` writes what is said now: a new case is its input between
//! these lines.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::path::Path;

use coadjoint_codegen::parse::rust;
use coadjoint_codegen::system::{Options, read};

/// A kind of input: the name of its file, and the mistakes of a text.
type Kind = (&'static str, fn(&str) -> String);

const KINDS: [Kind; 4] = [
    ("attributes", of_an_attribute),
    ("hamiltonians", |text| of_a_file(&crate::text::file(text), "h.toml")),
    ("sums", |text| of_a_file(&crate::sums::file(text, crate::sums::MOMENTUM), "h.toml")),
    ("system_files", |text| of_a_file(text, "system.toml")),
];

fn of_a_file(text: &str, name: &str) -> String {
    read(text, Options::default())
        .map_or_else(|mistakes| mistakes.render(name, text), |_| String::new())
}

/// The first line is the attribute; columns are those of its arguments and of the function.
fn of_an_attribute(text: &str) -> String {
    let (attribute, function) = text.split_once('\n').unwrap();
    let inside = attribute.strip_prefix("#[").and_then(|rest| rest.strip_suffix(']')).unwrap();
    let (name, arguments) = inside.split_once('(').unwrap_or((inside, ")"));
    let arguments = arguments.strip_suffix(')').unwrap();
    let (arguments, function) = (arguments.parse().unwrap(), syn::parse_str(function).unwrap());
    let read = match name {
        "lie_poisson" => rust::hamiltonian(arguments, &function).map(drop),
        _ => rust::potential(arguments, &function).map(drop),
    };
    let Err(mistakes) = read else { return String::new() };
    mistakes.into_syn_error().into_iter().fold(String::new(), |mut all, error| {
        let (start, end) = (error.span().start(), error.span().end());
        writeln!(all, "{}:{}-{}: {error}", start.line, start.column + 1, end.column + 1).unwrap();
        all
    })
}

#[test]
fn each_mistake_is_said_as_its_case_has_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let bless = std::env::var_os("COADJOINT_BLESS").is_some();
    let mut differences = String::new();
    for (name, said) in KINDS {
        let path = folder.join(name).with_extension("cases");
        let text = std::fs::read_to_string(&path).unwrap();
        let mut cases = text.split("====\n");
        let mut whole = cases.next().unwrap().to_owned();
        for case in cases {
            let line = whole.lines().count() + 1;
            let (input, expected) = case.split_once("----\n").unwrap();
            let found = said(input.strip_suffix('\n').unwrap_or(input));
            write!(whole, "====\n{input}----\n{found}").unwrap();
            if found != expected || found.is_empty() {
                writeln!(
                    differences,
                    "{name}.cases:{line}\n{input}---- expected\n{expected}---- found\n{found}"
                )
                .unwrap();
            }
        }
        if bless {
            std::fs::write(&path, whole).unwrap();
        }
    }
    assert!(bless || differences.is_empty(), "{differences}");
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), KINDS.len());
}
