//! Spin chains of 64 and 256 sites: conservation, order, and what is too large to emit.

use crate::support::{json, numbers, root, run, system};

fn chain(sites: usize) -> String {
    let text = std::fs::read_to_string(root().join("examples/spin_chain_64.toml")).unwrap();
    text.replace("64", &sites.to_string())
}

#[test]
fn chains_of_64_and_256_spins_keep_momentum_and_casimirs() {
    for (sites, time) in [(64, "0.5"), (256, "0.1")] {
        let (_folder, system) = system(&chain(sites));
        let run = json(&["simulate", &system, "--time", time, "--format", "json"]);
        assert_eq!(numbers(&run["momentum"]).len(), 3 * sites);
        for what in ["spatial_momentum", "casimirs"] {
            let drift = run["drift"][what].as_f64().unwrap();
            assert!(drift <= 1e-13, "{sites} sites: {what} {drift}");
        }
        assert!(run["solver"]["max_residual"].as_f64().unwrap() < 1e-14);
    }
}

#[test]
fn a_chain_of_64_spins_is_integrated_at_order_four() {
    let end = |step: &str| {
        let arguments = ["simulate", "examples/spin_chain_64.toml", "--time", "0.4"];
        let run = json(&[&arguments[..], &["--step", step, "--format", "json"]].concat());
        numbers(&run["momentum"])
    };
    let runs = [end("0.2"), end("0.1"), end("0.05")];
    let distance =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let order = (distance(&runs[0], &runs[1]) / distance(&runs[1], &runs[2])).log2();
    assert!((order - 4.0).abs() < 0.3, "{order}");
}

#[test]
fn both_solvers_make_the_same_map() {
    let end = |solver: &str| {
        let run = json(&[
            "simulate",
            "examples/heisenberg_spin_ring.toml",
            "--time",
            "1",
            "--solver",
            solver,
            "--format",
            "json",
        ]);
        numbers(&run["momentum"])
    };
    for (a, b) in end("newton").iter().zip(end("fixed_point")) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
}

#[test]
fn the_laws_hold_with_the_fixed_point() {
    let system = "examples/heisenberg_spin_ring.toml";
    let (code, out, err) = run(&["check", system, "--solver", "fixed_point", "--points", "1"]);
    assert_eq!(code, 0, "{out}{err}");
}

#[test]
fn what_is_too_large_to_emit_is_refused_by_its_terms_and_still_runs() {
    let (_folder, system) = system(&chain(300));
    let (code, _, message) = run(&["emit", &system]);
    assert_eq!(code, 2, "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(message.contains("terms, more than the limit of"), "{message}");
    assert!(message.contains("coadjoint simulate"), "{message}");
    let (code, _, err) = run(&["simulate", &system, "--time", "0.05"]);
    assert_eq!(code, 0, "{err}");
}
