//! Emitted Rust is the committed Rust, and the same from run to run.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-tests --test all golden_files` rewrites the files.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::{Build, emit};
use coadjoint_learn::{ModelFile, problem};
use coadjoint_tests::emitted;
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
    let earlier = |name: &str| std::fs::read_to_string(format!("{}/{name}.rs", env!("OUT_DIR")));
    for source in emitted::SYSTEMS {
        let origin = emitted::origin(source).unwrap();
        let name = origin.facts().name;
        let items = emit::items_of(&origin, &emit::Options::for_problem(name));
        let text = emit::file(items.unwrap());
        assert!(earlier(&format!("emitted/{name}")).unwrap() == text, "{name}");
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("weighted_body.rs");
    Build::new("systems/weighted_body.toml").write_to(&path).unwrap();
    assert!(earlier("weighted_body").unwrap() == std::fs::read_to_string(path).unwrap());
}
