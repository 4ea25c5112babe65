//! The gallery's systems, through their fields and back.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::fs;
use std::path::Path;

use coadjoint_codegen::system::{Options, read_either};
use coadjoint_page::fields::Fields;
use coadjoint_page::file::File;
use coadjoint_page::gallery::gallery;
use coadjoint_page::run::Animation;
use coadjoint_page::system::System;

/// Lists of bonds, which a page's fields do not hold, potentials, velocities, torques, damping, 192 dimensions, and steps of more than 60 000
/// operations: not for a page.
const LEFT_OUT: [&str; 16] = [
    "attitude_feedback",
    "damped_body",
    "elliptic_satellite",
    "kagome_star",
    "magnetic_bottle",
    "magnetic_satellite",
    "reaction_wheels",
    "relativistic_orbit",
    "satellite",
    "spin_chain_64",
    "spin_molecule",
    "spin_torque_oscillator",
    "spin_triangle",
    "underwater_vehicle",
    "vortex_ring",
    "zeitlin_5",
];

/// The system of a file and its run, as far as fields hold them.
fn said(text: &str) -> String {
    let read = read_either(text, Options::default(), &[]).unwrap();
    // Fields hold no end of line after the last word.
    format!("{:?} {:?}", read.problem, (read.run.step, read.run.time, read.run.momentum))
        .replace("\\n\"", "\"")
}

#[test]
fn every_example_is_there_and_says_the_same_through_its_fields() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut seen = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if path.extension().is_none_or(|extension| extension != "toml")
            || LEFT_OUT.contains(&stem.as_str())
        {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let fields = Fields::of_file(&text).unwrap();
        assert!(
            gallery().iter().any(|entry| entry.fields == fields),
            "{stem} is not in the gallery"
        );
        let file = File::of(&fields);
        assert!(file.unwritten.is_empty(), "{stem}");
        assert_eq!(said(&text), said(&file.text), "{stem}");
        seen += 1;
    }
    assert!(seen >= 23, "{seen}");
}

#[test]
fn every_system_of_the_gallery_runs_and_keeps_momentum_and_casimirs() {
    assert!(gallery().len() >= 27);
    for entry in gallery() {
        let system = System::new(&entry.fields)
            .unwrap_or_else(|mistakes| panic!("{}: {mistakes:?}", entry.id));
        let mut run = Animation::new(&system, &system.momentum);
        let copied = read_either(&system.file, Options::default(), &[]).unwrap();
        assert_eq!(
            (copied.run.momentum, copied.run.step),
            (Some(run.momentum().to_vec()), Some(system.h))
        );
        assert_eq!(run.advance(&system, 50), 50, "{}", entry.id);
        let [[energy, momentum, casimirs], _] = run.history.most;
        assert!(momentum < 1e-13 && casimirs < 1e-13, "{}: {momentum:e} {casimirs:e}", entry.id);
        // Relative to |E₀|, which is a small part of the sum of its terms on the spin ring.
        let conserved = system.invariants.energy;
        assert!(energy < 2e-5 || !conserved && energy.is_nan(), "{}: {energy:e}", entry.id);
    }
}
