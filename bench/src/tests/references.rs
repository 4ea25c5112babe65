//! The references agree with figures computed elsewhere by other means, and the peers with the references.

// Figures stand as they were handed down.
#![allow(clippy::excessive_precision)]

use crate::{
    method::{Method, Setting},
    peers, problem,
    state::{Rotation, State},
};
use serde_json::Value;

#[test]
fn body_a_ends_where_others_say() {
    // 20 digits, T = 1000, from an integration independent of `reference/compute.py`. The last component of the
    // quaternion is left out: as handed down, 0.4122438586374138786, it makes the norm 1 − 2.7e−14.
    let momentum =
        [1.959_874_584_250_366_312_6, -0.820_798_983_120_640_078_1, 0.857_426_756_823_914_961_8];
    let quaternion =
        [0.040_033_827_332_297_606_8, -0.907_336_243_849_827_792_9, 0.072_064_098_421_447_982_7];
    let reference = problem::named("free-body-a").unwrap().reference;
    let Rotation::Quaternion(q) = reference.rotation else { panic!("references are quaternions") };
    for i in 0..3 {
        assert!((reference.momentum[i] - momentum[i]).abs() < 4e-16);
        assert!((q[i] + quaternion[i]).abs() < 4e-16);
    }
    assert!((q.iter().map(|v| v * v).sum::<f64>() - 1.0).abs() < 4e-16);
}

#[test]
fn shorter_runs_end_where_others_say() {
    let independent: Value =
        serde_json::from_str(include_str!("../../reference/independent.json")).unwrap();
    let computed: Value =
        serde_json::from_str(include_str!("../../reference/end_states.json")).unwrap();
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    for given in independent.as_array().unwrap() {
        let entry = computed
            .as_array()
            .unwrap()
            .iter()
            .find(|entry| entry["name"] == given["name"])
            .unwrap();
        let (check, rows) = (&entry["check"], &given["group_element"]);
        assert_eq!(check["end"], given["end"]);
        let ours = State {
            momentum: std::array::from_fn(|i| number(&check["state"]["momentum"][i])),
            force: std::array::from_fn(|i| number(&check["state"]["force"][i])),
            rotation: Rotation::Quaternion(std::array::from_fn(|i| {
                number(&check["state"]["quaternion"][i])
            })),
            position: std::array::from_fn(|i| number(&check["state"]["position"][i])),
        };
        let theirs = State {
            momentum: std::array::from_fn(|i| number(&given["momentum"][i])),
            force: std::array::from_fn(|i| number(&given["momentum"][3 + i])),
            rotation: Rotation::Matrix(std::array::from_fn(|i| {
                std::array::from_fn(|j| number(&rows[i][j]))
            })),
            position: std::array::from_fn(|i| number(&rows[i][3])),
        };
        let scale = problem::named(given["name"].as_str().unwrap()).unwrap().scale;
        let error = ours.error(&theirs, &scale);
        assert!(error < 1e-15, "{}: {error:e}", given["name"]);
    }
}

#[test]
fn the_exact_solution_reaches_both_references() {
    for name in ["free-body-a", "free-body-b"] {
        let problem = problem::named(name).unwrap();
        let error = peers::jacobi::Exact
            .run(&problem, Setting::Step(1.0))
            .unwrap()
            .error(&problem.reference, &problem.scale);
        assert!(error < 1e-12, "{name}: {error:e}");
    }
}

#[test]
fn the_exact_solution_holds_on_both_sides_of_the_separatrix() {
    for momentum in
        [[2.0, 0.5, 1.0], [1.2, 2.5, 0.6], [0.3, -1.0, 2.0], [-0.2, 0.4, -1.5], [-2.0, 0.1, 0.3]]
    {
        let mut problem = problem::named("free-body-a").unwrap();
        problem.initial.momentum = momentum;
        problem.end = 20.0;
        problem.reference =
            peers::taylor::Taylor::<21>::fixed().run(&problem, Setting::Step(0.1)).unwrap();
        let error = peers::jacobi::Exact
            .run(&problem, Setting::Step(1.0))
            .unwrap()
            .error(&problem.reference, &problem.scale);
        assert!(error < 5e-14, "{momentum:?}: {error:e}");
    }
}

#[test]
fn published_errors_of_the_discrete_moser_veselov_algorithm() {
    // Errors at T = 1000 on body A given for order 10: 1.7e−6 at h = 0.5 and 4.9e−8 at h = 0.354.
    use peers::moser_veselov::{Form, MoserVeselov};
    let problem = problem::named("free-body-a").unwrap();
    for form in [Form::FixedPoint, Form::Newton, Form::Compensated] {
        for (step, expected) in [(0.5, 1.7e-6), (0.354, 4.9e-8)] {
            let method = MoserVeselov::new(10, form);
            let error = method
                .run(&problem, Setting::Step(step))
                .unwrap()
                .error(&problem.reference, &problem.scale);
            assert!((error / expected - 1.0).abs() < 0.06, "{form:?} {step}: {error:e}");
        }
    }
}

#[test]
fn adaptive_methods_reach_what_they_are_asked_for() {
    for name in ["free-body-b", "heavy-top", "kirchhoff", "kovalevskaya"] {
        let mut problem = problem::named(name).unwrap();
        problem.end = 20.0 * problem.time_scale;
        let fine = peers::taylor::Taylor::<21>::fixed();
        problem.reference = fine.run(&problem, Setting::Step(problem.time_scale / 20.0)).unwrap();
        for method in peers::all() {
            if !method.applies(&problem)
                || !matches!(method.settings(&problem).first(), Some(Setting::Tolerance(_)))
            {
                continue;
            }
            let error = |tolerance| {
                let end = method.run(&problem, Setting::Tolerance(tolerance)).unwrap();
                end.error(&problem.reference, &problem.scale)
            };
            let (coarse, fine) = (error(1e-6), error(1e-10));
            assert!(
                coarse < 1e-3 && fine < 1e-7,
                "{name}: {}: {coarse:e}, {fine:e}",
                method.name()
            );
            assert!(fine < 1e-2 * coarse, "{name}: {}: {coarse:e}, {fine:e}", method.name());
        }
    }
}
