//! Emitted Rust is the committed Rust, and the same from run to run.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-tests --test all golden_files` rewrites the files.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::{Build, emit};
use coadjoint_learn::{ModelFile, problem};
use coadjoint_tests::sources::golden;

#[test]
fn the_module_of_a_learned_model_is_the_committed_one() {
    let model = ModelFile::load(Path::new("reference/learned_body.json")).unwrap();
    let problem = problem(&model, "learned").unwrap();
    let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
    golden(
        "learned.rs",
        &emit::file(emit::items(&integrator, &emit::Options::for_problem("learned"))),
    );
}

/// The build script emitted the same, byte for byte: another process, and another profile.
#[test]
fn emission_is_deterministic() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("emitted_again.rs");
    let mut files = vec![(PathBuf::from("systems/weighted_body.toml"), "")];
    let emitted = std::fs::read_dir("systems/emitted").unwrap();
    files.extend(emitted.map(|entry| (entry.unwrap().path(), "emitted/")));
    assert!(files.len() > 12, "{}", files.len());
    for (file, folder) in files {
        let name = file.file_stem().unwrap().to_str().unwrap();
        let earlier = std::fs::read_to_string(format!("{}/{folder}{name}.rs", env!("OUT_DIR")));
        Build::new(&file).write_to(&path).unwrap();
        assert!(earlier.unwrap() == std::fs::read_to_string(&path).unwrap(), "{name}");
    }
}
