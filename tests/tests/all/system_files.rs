//! The files of `examples/`: each is read without a complaint, and is the system of its reference.
#![allow(clippy::expect_used, clippy::panic)]

use coadjoint_codegen::system::{Options, read};
use coadjoint_tests::reference::end_states;

#[test]
fn every_example_is_the_system_of_its_reference() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../");
    let mut seen = Vec::new();
    for entry in end_states() {
        let Some(file) = &entry.file else { continue };
        let text = std::fs::read_to_string(format!("{folder}{file}")).expect("an example");
        let system = read(&text, Options::default())
            .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(file, &text)));
        let problem = &system.problem;
        assert_eq!(problem.name, entry.system);
        assert_eq!(problem.hamiltonian, entry.polynomial(), "{file}");
        // Constants come in one order from the file, in another from the reference.
        let sorted = |algebra: &coadjoint_codegen::lie::LieAlgebra| {
            let mut all: Vec<_> = algebra.structure().to_vec();
            all.sort_by_key(|s| (s.i, s.j, s.k));
            all
        };
        assert_eq!(sorted(&problem.algebra), sorted(&entry.algebra()), "{file}");
        assert!(problem.symbols.is_empty(), "{file}");
        seen.push(file.clone());
    }
    assert!(seen.len() >= 15, "{seen:?}");
}
