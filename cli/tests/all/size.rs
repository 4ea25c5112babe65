//! Spin chains of 64 and 256 sites: conservation, order, and what is too large to emit.

use crate::support::{Folder, distance, json, numbers, run, text_of};

const CHAIN: &str = "examples/spin_chain_64.toml";
const RING: &str = "examples/heisenberg_spin_ring.toml";

fn chain(sites: usize) -> Folder {
    Folder::with(&text_of(CHAIN).replace("64", &sites.to_string()))
}

#[test]
fn chains_of_64_and_256_spins_keep_momentum_and_casimirs() {
    for (sites, time) in [(64, "0.5"), (256, "0.1")] {
        let run = chain(sites).json(&format!("simulate system.toml --time {time}"));
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
        numbers(&json(&format!("simulate {CHAIN} --time 0.4 --step {step}"))["momentum"])
    };
    let runs = ["0.2", "0.1", "0.05"].map(end);
    let order = (distance(&runs[0], &runs[1]) / distance(&runs[1], &runs[2])).log2();
    assert!((order - 4.0).abs() < 0.3, "{order}");
}

#[test]
fn both_solvers_make_the_same_map_that_keeps_the_laws() {
    let ends = ["newton", "fixed_point"].map(|solver| {
        numbers(&json(&format!("simulate {RING} --time 1 --solver {solver}"))["momentum"])
    });
    assert!(distance(&ends[0], &ends[1]) < 1e-13, "{ends:?}");
    run(&format!("check {RING} --solver fixed_point --points 1")).ok();
}

#[test]
fn what_is_too_large_to_emit_is_refused_by_its_terms_and_still_runs() {
    let chain = chain(400);
    let emit = chain.run("emit system.toml");
    assert_eq!(emit.error.trim().lines().count(), 1, "{emit:?}");
    emit.fails(2, &["terms, more than the limit of", "coadjoint simulate"]);
    chain.run("simulate system.toml --time 0.05").ok();
}
