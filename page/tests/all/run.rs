//! Runs, refusals, the method beside, and the surfaces.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint_codegen::poly::Numeric;
use coadjoint_page::fields::Fields;
use coadjoint_page::gallery::gallery;
use coadjoint_page::orbit::Orbit;
use coadjoint_page::run::{Animation, Reason, Refusal};
use coadjoint_page::system::System;

fn fields(id: &str) -> Fields {
    gallery().into_iter().find(|entry| entry.id == id).unwrap().fields
}

/// The final momentum of `coadjoint simulate examples/rigid_body.toml`, 1000 steps to time 100.
const MOMENTUM: [f64; 3] = [2.01070712626444, -0.3680827891997475, -1.0351675771025337];

#[test]
fn a_run_has_the_bits_of_the_command() {
    let system = System::new(&fields("rigid-body")).unwrap();
    let mut run = Animation::new(&system, &system.momentum);
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
        let mut run = Animation::new(&system, &system.momentum);
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
        let mut run = Animation::new(&system, &system.momentum);
        let made = run.advance(&system, 1000);
        let refusal = run.refusal.clone().unwrap_or_else(|| panic!("h = {step}: {made} steps"));
        assert_eq!(refusal.reason, reason, "h = {step}");
        // The state is as it was, and the shorter step can be made.
        fields.step = refusal.usable.unwrap().to_string();
        let shorter = System::new(&fields).unwrap();
        assert_eq!(Animation::new(&shorter, run.momentum()).advance(&shorter, 1), 1);
    }
}

#[test]
fn roots_and_hamiltonians_that_move_in_time_are_run() {
    // With E = H the relativistic body is the rigid one whose time goes slower by the factor E.
    let system = System::new(&fields("relativistic-body")).unwrap();
    let mut run = Animation::new(&system, &system.momentum);
    let slower = system.h / run.energy(&system);
    let mut rigid = fields("rigid-body");
    rigid.step = slower.to_string();
    let rigid = System::new(&rigid).unwrap();
    let mut beside = Animation::new(&rigid, &rigid.momentum);
    assert_eq!((run.advance(&system, 500), beside.advance(&rigid, 500)), (500, 500));
    for (a, b) in run.momentum().iter().zip(beside.momentum()) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert!(run.history.most[0].into_iter().all(|drift| drift < 1e-12));
    // Rosen and Zener's pulse: see the file.
    let system = System::new(&fields("driven-qubit")).unwrap();
    let mut run = Animation::new(&system, &system.momentum);
    assert_eq!(run.advance(&system, 1200), 1200);
    let half = std::f64::consts::FRAC_PI_2;
    let over = ((half * 0.8).sin() / (half * 0.2).cosh()).powi(2);
    assert!((run.momentum()[2] - (1.0 - 2.0 * over)).abs() < 1e-9, "{:?}", run.momentum());
    let [[energy, momentum, casimirs], _] = run.history.most;
    assert!(energy.is_nan() && momentum < 1e-13 && casimirs < 1e-13);
}

#[test]
fn a_step_out_of_the_domain_is_refused_with_the_expression() {
    let mut fields = fields("relativistic-body");
    fields.hamiltonian = "z + x^(3/2)".into();
    (fields.parameters, fields.momentum) = (String::new(), "0.5 -1 1".into());
    let system = System::new(&fields).unwrap();
    let mut run = Animation::new(&system, &system.momentum);
    let made = run.advance(&system, 1000);
    assert!((1..1000).contains(&made), "{made}");
    let Refusal { reason, .. } = run.refusal.unwrap();
    assert!(
        matches!(&reason, Reason::Undefined(text) if text.contains("x^(3/2) of -")),
        "{reason:?}"
    );
    // A step too long for the nodes.
    fields.hamiltonian = "exp(x^2/2) + y^2".into();
    fields.step = "3".into();
    let system = System::new(&fields).unwrap();
    let mut run = Animation::new(&system, &system.momentum);
    run.advance(&system, 100);
    let Refusal { reason, usable } = run.refusal.unwrap();
    assert!(matches!(reason, Reason::NotResolved | Reason::NotSolved), "{reason:?}");
    assert!(usable.is_some_and(|h| h < 3.0));
}

#[test]
fn the_method_beside_is_of_order_four() {
    let ids = ["rigid-body", "heavy-top", "su3-quadratic", "toda-lattice", "sl2-geodesic"];
    for id in ids.into_iter().chain(["screened-top", "driven-qubit"]) {
        let system = System::new(&fields(id)).unwrap();
        let end = |steps: u32| {
            let mut state = system.rival.start(&system.momentum);
            let h = 0.8 / f64::from(steps);
            for number in 0..steps {
                state = system.rival.advance(&state, h * f64::from(number), h);
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
    for id in ["wing-nut", "plate-in-fluid", "so21-top", "heisenberg-geodesics", "exponential-spin"]
    {
        let system = System::new(&fields(id)).unwrap();
        let casimir = &Numeric::new(&system.casimirs[0], 3, &[]);
        let mu = &system.momentum;
        let orbit = Orbit::new(&system.energy(), casimir, mu).unwrap();
        let own = system.energy().value(0.0, mu);
        let through = orbit.level(own);
        assert!(orbit.spread.len() > 10 && !through.is_empty(), "{id}");
        let size = orbit.surface.extent;
        for point in through.iter().flatten() {
            let (on, level) = (
                casimir.value(&point[..3]) - casimir.value(mu),
                system.energy().value(0.0, &point[..3]) - own,
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
    let mut run = Animation::new(&system, &system.momentum);
    run.advance(&system, 5000);
    let samples = &run.history.samples;
    assert!(samples.len() <= 721, "{}", samples.len());
    assert_eq!(samples.last().unwrap().time, run.time());
    for (kind, most) in run.history.most[0].into_iter().enumerate() {
        assert_eq!(samples.iter().map(|sample| sample.drifts[0][kind]).fold(0.0, f64::max), most);
    }
}
