//! Each peer converges to the exact motion with its own order: slopes of log error against log step.
#![allow(clippy::unwrap_used)]

use crate::{
    method::{Method, Setting},
    ours, peers,
    problem::{self, Problem},
};

/// An interval of twenty of these times, its end state by Taylor's method of order 20 at a step far below where it
/// converges.
fn short(name: &str, time: f64) -> Problem {
    let mut problem = problem::named(name).unwrap();
    problem.end = 20.0 * time;
    let taylor = peers::taylor::Taylor::<21>::fixed();
    problem.reference = taylor.run(&problem, Setting::Step(problem.time_scale / 20.0)).unwrap();
    problem
}

/// The least-squares slope over the steps whose errors lie where neither higher orders nor rounding show.
fn slope(method: &dyn Method, problem: &Problem, order: u32, time: f64) -> f64 {
    // Low orders take so many steps that rounding shows earlier.
    let range = if order <= 4 { 1e-9..1e-4 } else { 1e-12..1e-7 };
    let mut points = Vec::new();
    for k in 0..60 {
        let (count, h) = Setting::steps(2.5 * time * 2f64.powf(-f64::from(k) / 5.0), problem.end);
        let Ok(end) = method.run(problem, Setting::Step(problem.end / count as f64)) else {
            continue;
        };
        let error = end.error(&problem.reference, &problem.scale);
        if range.contains(&error) {
            points.push((h, error));
        }
        if error < range.start {
            break;
        }
    }
    least_squares(&points)
}

/// The slope of the logarithms.
fn least_squares(points: &[(f64, f64)]) -> f64 {
    assert!(points.len() >= 4, "{} points", points.len());
    let points: Vec<(f64, f64)> = points.iter().map(|p| (p.0.ln(), p.1.ln())).collect();
    let n = points.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

const PROBLEMS: [&str; 4] = ["free-body-a", "heavy-top", "kirchhoff", "kovalevskaya"];

#[test]
fn every_method_with_a_step_has_its_order() {
    for name in PROBLEMS {
        let whole = problem::named(name).unwrap();
        let mut problem = short(name, whole.time_scale);
        for method in ours::all().into_iter().chain(peers::all()) {
            // Sweeps begin with four times the method's own scale of time.
            let settings = method.settings(&whole);
            let (Some(order), true, Some(&Setting::Step(longest))) =
                (method.order(), method.applies(&whole), settings.first())
            else {
                continue;
            };
            if method.family() == "Taylor" {
                continue;
            }
            let time = longest / 4.0;
            if (problem.end / (20.0 * time) - 1.0).abs() > 1e-9 {
                problem = short(name, time);
            }
            let measured = slope(method.as_ref(), &problem, order, time);
            println!("{name}: {}: {measured:.2}", method.name());
            // At high orders only long steps err above rounding, and there the next term shows.
            let band = (0.04 * f64::from(order)).max(0.3);
            assert!(
                (measured - f64::from(order)).abs() < band,
                "{name}: {}: {measured:.2}",
                method.name()
            );
        }
    }
}

/// Over many steps a Taylor method of order 12 or more is at rounding before it is at its order; over one it is not.
#[test]
fn one_step_of_a_taylor_method_errs_at_its_order_plus_one() {
    for name in PROBLEMS {
        for method in peers::all().into_iter().filter(|method| method.family() == "Taylor") {
            let mut problem = problem::named(name).unwrap();
            if !matches!(method.settings(&problem).first(), Some(Setting::Step(_))) {
                continue;
            }
            let mut points = Vec::new();
            for k in 0..60 {
                let h = 2.5 * problem.time_scale * 2f64.powf(-f64::from(k) / 16.0);
                problem.end = h;
                let fine = peers::taylor::Taylor::<21>::fixed();
                problem.reference = fine.run(&problem, Setting::Step(h / 16.0)).unwrap();
                let error = method
                    .run(&problem, Setting::Step(h))
                    .unwrap()
                    .error(&problem.reference, &problem.scale);
                if (2e-14..1e-8).contains(&error) {
                    points.push((h, error));
                }
            }
            let (measured, expected) =
                (least_squares(&points), f64::from(method.order().unwrap() + 1));
            println!("{name}: {}: {measured:.2}", method.name());
            assert!((measured - expected).abs() < 0.6, "{name}: {}: {measured:.2}", method.name());
        }
    }
}
