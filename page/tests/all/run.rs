//! Runs, refusals, the method beside, and the surfaces.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint_page::fields::Fields;
use coadjoint_page::gallery::gallery;
use coadjoint_page::orbit::Orbit;
use coadjoint_page::run::{Reason, Run};
use coadjoint_page::system::System;

fn fields(id: &str) -> Fields {
    gallery().into_iter().find(|entry| entry.id == id).unwrap().fields
}

/// Of `coadjoint simulate examples/rigid_body.toml`, 1000 steps to time 100.
const MOMENTUM: [f64; 3] = [2.01070712626444, -0.3680827891997475, -1.0351675771025337];

#[test]
fn a_run_has_the_bits_of_the_command() {
    let system = System::new(&fields("rigid-body")).unwrap();
    let mut run = Run::new(&system, &system.momentum);
    assert_eq!(run.advance(&system, 1000), 1000);
    assert_eq!(run.momentum(), MOMENTUM);
    let [[_, momentum, casimirs], [rival, ..]] = run.history.most;
    assert!(momentum < 1e-14 && casimirs < 1e-14);
    assert!(rival > 1e-12, "{rival:e}");
}

#[test]
fn drifts_are_those_that_the_command_reports() {
    // `coadjoint simulate examples/rigid_body.toml --truncation 3 --step 0.25`, and
    // `coadjoint simulate examples/lagrange_top.toml --time 50`, with `--format json`: drift.energy.
    let mut body = fields("rigid-body");
    (body.truncation, body.step) = ("3".into(), "0.25".into());
    for (fields, steps, expected) in
        [(body, 400, 1.2377828154956593e-7), (fields("lagrange-top"), 1000, 6.515955383543245e-11)]
    {
        let system = System::new(&fields).unwrap();
        let mut run = Run::new(&system, &system.momentum);
        assert_eq!(run.advance(&system, steps), steps);
        let [[energy, momentum, casimirs], _] = run.history.most;
        assert!((energy / expected - 1.0).abs() < 1e-4, "{energy:e}");
        assert!(momentum < 1e-13 && casimirs < 1e-13);
    }
}

#[test]
fn a_refused_step_says_why_and_what_would_do() {
    let mut fields = fields("rigid-body");
    for (step, reason) in [("1.9", Reason::BeyondChart), ("40", Reason::BeyondSeries)] {
        fields.step = step.into();
        let system = System::new(&fields).unwrap();
        let mut run = Run::new(&system, &system.momentum);
        let made = run.advance(&system, 1000);
        let refusal = run.refusal.clone().unwrap_or_else(|| panic!("h = {step}: {made} steps"));
        assert_eq!(refusal.reason, reason, "h = {step}");
        // The state is as it was, and the shorter step can be made.
        fields.step = refusal.usable.unwrap().to_string();
        let shorter = System::new(&fields).unwrap();
        assert_eq!(Run::new(&shorter, run.momentum()).advance(&shorter, 1), 1);
    }
}

#[test]
fn the_method_beside_is_of_order_four() {
    for id in ["rigid-body", "heavy-top", "su3-quadratic", "toda-lattice", "sl2-geodesic"] {
        let system = System::new(&fields(id)).unwrap();
        let end = |steps: u32| {
            let mut state = system.rival.start(&system.momentum);
            for _ in 0..steps {
                state = system.rival.advance(&state, 0.8 / f64::from(steps));
            }
            state
        };
        let difference =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let exact = end(512);
        let order = (difference(&end(8), &exact) / difference(&end(16), &exact)).log2();
        assert!((3.5..5.2).contains(&order), "{id}: {order}");
        // The spatial momentum is conserved as far as the method is right: so it is read as it should be.
        let moved = difference(&system.rival.spatial(&exact), &system.momentum);
        assert!(moved < 1e-8, "{id}: {moved:e}");
    }
}

#[test]
fn level_curves_are_on_the_orbit_and_on_their_level() {
    for id in ["wing-nut", "plate-in-fluid", "so21-top", "heisenberg-geodesics"] {
        let system = System::new(&fields(id)).unwrap();
        let casimir = &system.invariants.casimirs[0];
        let mu = &system.momentum;
        let orbit = Orbit::new(&system.energy, casimir, mu).unwrap();
        let own = system.energy.value(mu);
        let through = orbit.level(own);
        assert!(orbit.spread.len() > 10 && !through.is_empty(), "{id}");
        let size = orbit.surface.extent;
        for point in through.iter().flatten() {
            let (on, level) = (
                casimir.value(&point[..3]) - casimir.value(mu),
                system.energy.value(&point[..3]) - own,
            );
            assert!(
                on.abs() < 0.02 * size * size && level.abs() < 0.02 * size * size,
                "{id}: {on} {level}"
            );
        }
        let near = through
            .iter()
            .flatten()
            .map(|p| (0..3).map(|i| (p[i] - mu[i]).powi(2)).sum::<f64>().sqrt());
        assert!(near.fold(f64::INFINITY, f64::min) < 0.1 * size, "{id}");
    }
}

#[test]
fn histories_stay_short_and_forget_no_largest_drift() {
    let system = System::new(&fields("wing-nut")).unwrap();
    let mut run = Run::new(&system, &system.momentum);
    run.advance(&system, 5000);
    let samples = &run.history.samples;
    assert!(samples.len() <= 721, "{}", samples.len());
    assert_eq!(samples.last().unwrap().time, run.time());
    for (kind, most) in run.history.most[0].into_iter().enumerate() {
        assert_eq!(samples.iter().map(|sample| sample.drifts[0][kind]).fold(0.0, f64::max), most);
    }
}
