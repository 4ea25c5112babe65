//! Emitted code is the committed code.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-tests --test golden_files` rewrites the files.

#![allow(clippy::unwrap_used)]

use coadjoint_codegen::emit;
use coadjoint_tests::{from_function, golden};

fn check_golden(source: (&str, &str)) {
    let integrator = from_function(source.0, source.1).unwrap();
    let name = &integrator.problem.name;
    let text = emit::file(&integrator, &emit::Options::for_problem(name));
    golden::check(name, &text);
    // The same again, byte for byte.
    let again = from_function(source.0, source.1).unwrap();
    assert_eq!(emit::file(&again, &emit::Options::for_problem(name)), text);
}

#[test]
fn emitted_files_are_the_committed_ones() {
    for source in [golden::RIGID_BODY, golden::CAYLEY_BODY, golden::HEAVY_TOP, golden::THREE_WAVE] {
        check_golden(source);
    }
}
