//! Emitted code is the committed code.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-tests --test all golden_files` rewrites the files.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_learn::{ModelFile, problem};
use coadjoint_tests::{from_function, golden};

fn check_golden(build: impl Fn() -> Integrator) {
    let integrator = build();
    let name = &integrator.problem.name;
    let text = emit::file(&integrator, &emit::Options::for_problem(name));
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.rs"));
    if std::env::var_os("COADJOINT_BLESS").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "{} differs from what is emitted now", path.display());
    // The same again, byte for byte.
    assert_eq!(emit::file(&build(), &emit::Options::for_problem(name)), text);
}

#[test]
fn emitted_files_are_the_committed_ones() {
    let sources = [
        golden::RIGID_BODY,
        golden::CAYLEY_BODY,
        golden::HEAVY_TOP,
        golden::COMOVING_BODY,
        golden::THREE_WAVE,
    ];
    for source in sources {
        check_golden(|| from_function(source.0, source.1).unwrap());
    }
}

#[test]
fn emitted_learned_models_are_the_committed_ones() {
    check_golden(|| {
        let model = ModelFile::load(Path::new("reference/learned_body.json")).unwrap();
        Integrator::build(problem(&model, "learned").unwrap(), TermLimit::default()).unwrap()
    });
}
