//! The references agree with figures computed elsewhere by other means, and every method with the references, at its
//! order.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::time::Duration;

use serde_json::Value;

use super::method::{Competitor, equal_steps};
use super::problem::{self, Dynamics, FILE, Figures, Problem, State};
use super::sweep::{Setting, worth_timing};
use super::{exact, methods};

fn named(name: &str) -> Problem {
    problem::all().unwrap().into_iter().find(|problem| problem.name == name).unwrap()
}

const SHORT: [&str; 5] = ["free-body-a", "free-body-b", "heavy-top", "kirchhoff", "kovalevskaya"];

/// The last of our methods: the longest series in the best frame.
fn best(problem: &Problem) -> Competitor {
    methods(problem).into_iter().rfind(|method| method.name.starts_with("coadjoint")).unwrap()
}

#[test]
fn body_a_ends_where_others_say() {
    // 20 digits, T = 1000, from an integration independent of `tests/reference/make_references.py`.
    let momentum =
        [1.959_874_584_250_366_312_6, -0.820_798_983_120_640_078_1, 0.857_426_756_823_914_961_8];
    let reference = named("free-body-a").reference;
    assert!((0..3).all(|i| (reference.momentum[i] - momentum[i]).abs() < 4e-16));
}

#[test]
fn shorter_runs_end_where_others_say() {
    let read = |text| serde_json::from_str::<Vec<Value>>(text).unwrap();
    let (given, computed) = (read(include_str!("../../reference/independent.json")), read(FILE));
    for given in given {
        let entry = computed.iter().find(|entry| entry["name"] == given["name"]).unwrap();
        assert_eq!(entry["check"]["end"], given["end"]);
        let figures: Figures = serde_json::from_value(entry["check"]["state"].clone()).unwrap();
        let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
        let element = |i: usize, j: usize| number(&given["group_element"][i][j]);
        let theirs = State {
            momentum: std::array::from_fn(|i| number(&given["momentum"][i])),
            force: std::array::from_fn(|i| number(&given["momentum"][3 + i])),
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| element(i, j))),
            position: std::array::from_fn(|i| element(i, 3)),
        };
        let scale = named(given["name"].as_str().unwrap()).scale;
        let error = figures.state().unwrap().error(&theirs, scale);
        assert!(error < 1e-15, "{}: {error:e}", given["name"]);
    }
}

#[test]
fn ours_and_dop853_reach_the_references() {
    for problem in SHORT.map(named) {
        for method in methods(&problem) {
            let is = |name| method.name.starts_with(name);
            let setting = match method.order {
                _ if is("coadjoint") && method.name != best(&problem).name => continue,
                Some(_) => 0.125 * problem.time_scale,
                None if is("DOP853") => 1e-13,
                None => 1.0,
            };
            let error = method.run(&problem, setting).unwrap();
            let error = error.error(&problem.reference, problem.scale);
            println!("{}: {}: {error:.1e}", problem.name, method.name);
            assert!(error < 2e-9, "{}: {}: {error:e}", problem.name, method.name);
        }
    }
}

/// Errors below this show rounding, which the motion of the comoving top amplifies 1500 times in 1000 steps.
const FLOOR: f64 = 1e-11;

/// The slope of log error against log step, where neither higher orders nor rounding show.
fn slope(method: &Competitor, problem: &Problem, order: f64, time: f64) -> f64 {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for k in 0..60 {
        let (_, h) = equal_steps(2.5 * time * 2f64.powf(-f64::from(k) / 5.0), problem.end);
        let Ok(end) = method.run(problem, h) else { continue };
        let error = end.error(&problem.reference, problem.scale);
        // At the highest orders only long steps err above rounding.
        let most = if order <= 10.0 { 1e-8 } else { 1e-7 };
        if (FLOOR..most).contains(&error) {
            points.push((h.ln(), error.ln()));
        }
        if error < FLOOR {
            break;
        }
    }
    assert!(points.len() >= 4, "{}: {}: {} points", problem.name, method.name, points.len());
    let n = points.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

#[test]
fn every_method_with_a_step_has_its_order() {
    for whole in SHORT.map(named).into_iter().filter(|problem| problem.name != "free-body-b") {
        for method in methods(&whole) {
            let (Some(order), Some(longest)) = (method.order, method.settings.first()) else {
                continue;
            };
            // Sweeps begin with four times the method's own scale of time.
            let time = longest / 4.0;
            let mut problem = Problem { end: 20.0 * time, ..whole.clone() };
            problem.reference = match whole.kind {
                Dynamics::Free => exact::run(&problem, problem.end).unwrap(),
                _ => best(&whole).run(&problem, time / 16.0).unwrap(),
            };
            let order = f64::from(order);
            let measured = slope(&method, &problem, order, time);
            println!("{}: {}: {measured:.2}", whole.name, method.name);
            // On long steps the next term shows.
            let band = (0.04 * order).max(0.3);
            assert!(
                (measured - order).abs() < band,
                "{}: {}: {measured:.2}",
                whole.name,
                method.name
            );
        }
    }
}

#[test]
fn the_exact_solution_holds_on_both_sides_of_the_separatrix() {
    for momentum in
        [[2.0, 0.5, 1.0], [1.2, 2.5, 0.6], [0.3, -1.0, 2.0], [-0.2, 0.4, -1.5], [-2.0, 0.1, 0.3]]
    {
        let problem = Problem { momentum, end: 20.0, ..named("free-body-a") };
        let ours = best(&problem).run(&problem, 0.1).unwrap();
        let error = exact::run(&problem, 1.0).unwrap().error(&ours, 1.0);
        assert!(error < 1e-13, "{momentum:?}: {error:e}");
    }
}

#[test]
fn published_errors_of_the_discrete_moser_veselov_algorithm() {
    let problem = named("free-body-a");
    let method =
        methods(&problem).into_iter().find(|method| method.name.starts_with("DMV")).unwrap();
    // Of order 10 on body A at T = 1000.
    for (step, expected) in [(0.5, 1.7e-6), (0.354, 4.9e-8)] {
        let error = method.run(&problem, step).unwrap().error(&problem.reference, problem.scale);
        assert!((error / expected - 1.0).abs() < 0.06, "{step}: {error:e}");
    }
}

#[test]
fn only_settings_that_are_cheapest_somewhere_are_timed() {
    let candidate = |(error, micros): (f64, u64)| {
        let rough = Duration::from_micros(micros);
        Setting { method: 0, setting: 1.0, error, rough }
    };
    let tried = [
        (1e-4, 10),
        (9e-5, 11),
        (9e-5, 50),
        (1e-9, 60),
        (1e-9, 90),
        (1e-9, 99),
        (1e-9, 120),
        (1e-9, 130),
    ];
    let kept = worth_timing(tried.map(candidate).into());
    let kept: Vec<u128> = kept.iter().map(|c| c.rough.as_micros()).collect();
    assert_eq!(kept, [10, 11, 50, 60, 90, 99, 120]);
}
