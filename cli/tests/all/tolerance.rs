//! `--tolerance`: the error at the end of a run is below what was asked for, and not far below.

use crate::support::{Folder, json, numbers, root, run, system};
use serde_json::Value;

/// The estimate is made for the worst moment of the run and used up to a half; at a given moment the
/// error may happen to be smaller.
const FACTOR: f64 = 1000.0;

/// The momentum relative to its largest coordinate and the group element after it.
fn end(run: &Value) -> Vec<f64> {
    let mut end = numbers(&run["momentum"]);
    let size = end.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    end.iter_mut().for_each(|x| *x /= size);
    for row in run["group_element"].as_array().unwrap() {
        end.extend(numbers(row));
    }
    end
}

fn error(a: &Value, b: &Value) -> f64 {
    end(a).iter().zip(end(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn meets(system: &str, time: &str) {
    let simulate = |tolerance: &str| {
        json(&["simulate", system, "--time", time, "--tolerance", tolerance, "--format", "json"])
    };
    let fine = simulate("1e-13");
    for tolerance in ["1e-6", "1e-8", "1e-10"] {
        let error = error(&simulate(tolerance), &fine);
        let tolerance: f64 = tolerance.parse().unwrap();
        assert!(error <= tolerance, "{system}: {error:e} for {tolerance:e}");
        assert!(error >= tolerance / FACTOR, "{system}: {error:e} for {tolerance:e}");
    }
}

/// The second free body is near the separatrix, where neighbours part fastest.
#[test]
fn errors_are_below_the_tolerance_and_not_far_below() {
    let folder = Folder::new();
    let text = std::fs::read_to_string(root().join("examples/rigid_body.toml")).unwrap();
    let near = folder.write("near.toml", text.replace("[2.0, 0.5, 1.0]", "[1.2, 2.5, 0.6]"));
    meets(&near, "40");
    for (system, time) in [
        ("rigid_body", "40"),
        ("gyrostat", "10"),
        ("heavy_top", "5"),
        ("kirchhoff_body", "5"),
        ("heisenberg_spin_ring", "5"),
    ] {
        meets(&format!("examples/{system}.toml"), time);
    }
}

/// The report names the choice, also one in the file; a region larger than the run's asks for more.
#[test]
fn the_choice_is_told() {
    let told = |arguments: &[&str]| {
        let (code, _, error) = run(arguments);
        assert_eq!(code, 0, "{error}");
        let step = error.split("h = ").nth(1).unwrap().split(' ').next().unwrap();
        (error.clone(), step.parse::<f64>().unwrap())
    };
    let body = "examples/rigid_body.toml";
    let (text, run_step) = told(&["simulate", body, "--tolerance", "1e-9", "--truncation", "7"]);
    assert!(text.starts_with("tolerance 1e-9: K = 7, h = 0."), "{text}");
    assert!(text.contains("along the run, |μ| ≤ 2.29"), "{text}");
    let (text, region_step) =
        told(&["simulate", body, "--tolerance", "1e-9", "--truncation", "7", "--region", "4"]);
    assert!(text.contains("over |μ| ≤ 4"), "{text}");
    assert!(region_step < run_step);

    let folder = Folder::new();
    let text = std::fs::read_to_string(root().join(body)).unwrap();
    let system = text.replace("step = 0.1", "tolerance = 1e-9\nregion = 4");
    let (_, step) = told(&["simulate", &folder.write("system.toml", &system)]);
    assert_eq!(step, region_step);
    let both = text.replace("step = 0.1", "step = 0.1\ntolerance = 1e-9");
    let (code, _, error) = run(&["simulate", &folder.write("system.toml", &both)]);
    assert_eq!(code, 2);
    assert!(error.contains("keep one of `tolerance` and `step`"), "{error}");
    let small = text.replace("step = 0.1", "tolerance = 1e-20");
    let (code, _, error) = run(&["simulate", &folder.write("system.toml", &small)]);
    assert_eq!(code, 2);
    assert!(error.contains("between 1e-14 and 1e-1"), "{error}");
}

/// One function chooses K and h, for every verb and every language.
#[test]
fn all_verbs_choose_the_same_truncation_and_step() {
    let (folder, system) = system(
        "name = \"body\"\ngroup = \"SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n[integrator]\ntolerance = 1e-9\n\
         [initial]\nmomentum = [2, 0.5, 1]\n[run]\ntime = 100\n",
    );
    let report = json(&["simulate", &system, "--format", "json"]);
    let (truncation, step) = (&report["truncation"], &report["step"]);
    assert_ne!(truncation, 7, "the default");
    let checked = json(&["check", &system, "--points", "1", "--format", "json"]);
    assert_eq!((&checked["truncation"], &checked["step"]), (truncation, step));
    let chosen = format!("K = {truncation}, step h = {step}");
    for language in ["rust", "c", "cpp", "opencl", "cuda"] {
        let (code, text, _) = run(&["emit", &system, "--language", language]);
        assert!(code == 0 && text.contains(&chosen), "{language}: {chosen}");
    }
    let (_, series, _) = run(&["derive", &system]);
    assert!(series.contains(&format!("truncation {truncation}")), "{series}");
    let states = folder.at("states.csv");
    std::fs::write(&states, "mu_1,mu_2,mu_3\n2,0.5,1\n").unwrap();
    let out = folder.at("ends.csv");
    let (states, out) = (states.to_str().unwrap(), out.to_str().unwrap());
    let ends = json(&["ensemble", &system, "--initial", states, "--out", out, "--format", "json"]);
    assert_eq!((&ends["truncation"], &ends["step"]), (truncation, step));
}
