//! `--tolerance`: the error at the end of a run is below what was asked for, and not far below.

use crate::support::{BODY, Folder, distance, numbers, text_of};
use serde_json::Value;

/// The estimate is made for the worst moment of the run and used up to a half; at a given moment the
/// error may happen to be smaller.
const FACTOR: f64 = 1000.0;

/// The momentum relative to its largest coordinate and the group element after it.
fn end(run: &Value) -> Vec<f64> {
    let mut end = numbers(&run["momentum"]);
    let size = end.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    end.iter_mut().for_each(|x| *x /= size);
    end.extend(run["group_element"].as_array().unwrap().iter().flat_map(numbers));
    end
}

/// The second free body is near the separatrix, where neighbours part fastest.
#[test]
fn errors_are_below_the_tolerance_and_not_far_below() {
    let folder = Folder::with(&text_of(BODY).replace("[2.0, 0.5, 1.0]", "[1.2, 2.5, 0.6]"));
    for run in [
        "system.toml --time 40",
        "examples/rigid_body.toml --time 40",
        "examples/gyrostat.toml --time 10",
        "examples/heavy_top.toml --time 5",
        "examples/kirchhoff_body.toml --time 5",
        "examples/heisenberg_spin_ring.toml --time 5",
    ] {
        let simulate = |tolerance: f64| {
            end(&folder.json(&format!("simulate {run} --tolerance {tolerance:e}")))
        };
        let fine = simulate(1e-13);
        for tolerance in [1e-6, 1e-8, 1e-10] {
            let error = distance(&simulate(tolerance), &fine);
            assert!(error <= tolerance, "{run}: {error:e} for {tolerance:e}");
            assert!(error >= tolerance / FACTOR, "{run}: {error:e} for {tolerance:e}");
        }
    }
}

/// The report names the choice, also one in the file; a region larger than the run's asks for more.
#[test]
fn the_choice_is_told() {
    let text = text_of(BODY);
    let folder = Folder::with(&text.replace("step = 0.1", "tolerance = 1e-9\nregion = 4"));
    let told = |arguments: &str| {
        let error = folder.run(&format!("simulate {arguments}")).ok().error;
        let step = error.split("h = ").nth(1).unwrap().split(' ').next().unwrap();
        let step = step.parse::<f64>().unwrap();
        (error, step)
    };
    let run = format!("{BODY} --tolerance 1e-9 --truncation 7");
    let (said, run_step) = told(&run);
    assert!(said.starts_with("tolerance 1e-9: K = 7, comoving, h = "), "{said}");
    assert!(said.contains("along the run, |μ| ≤ 2.29"), "{said}");
    let (said, region_step) = told(&format!("{run} --region 4"));
    assert!(said.contains("over |μ| ≤ 4"), "{said}");
    assert!(region_step < run_step);
    assert_eq!(told("system.toml").1, region_step);
    for (line, word) in [
        ("step = 0.1\ntolerance = 1e-9", "keep one of `tolerance` and `step`"),
        ("tolerance = 1e-20", "between 1e-14 and 1e-1"),
    ] {
        let folder = Folder::with(&text.replace("step = 0.1", line));
        folder.refused(&[("simulate system.toml", word)]);
    }
}

/// One function chooses K and h, for every verb and every language.
#[test]
fn all_verbs_choose_the_same_truncation_and_step() {
    let folder = Folder::with(
        "name = \"body\"\ngroup = \"SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n[integrator]\ntolerance = 1e-9\n\
         [initial]\nmomentum = [2, 0.5, 1]\n[run]\ntime = 100\n",
    );
    folder.write("states.csv", "mu_1,mu_2,mu_3\n2,0.5,1\n");
    let report = folder.json("simulate system.toml");
    let (truncation, step) = (&report["truncation"], &report["step"]);
    assert_ne!(truncation, 7, "the default");
    for other in
        ["check system.toml --points 1", "ensemble system.toml --initial states.csv --out ends.csv"]
    {
        let found = folder.json(other);
        assert_eq!((&found["truncation"], &found["step"]), (truncation, step), "{other}");
    }
    let chosen = format!("K = {truncation}, step h = {step}");
    for language in ["rust", "c", "cpp", "opencl", "cuda"] {
        folder.run(&format!("emit system.toml --language {language}")).ok().prints(&[&chosen]);
    }
    let series = folder.run("derive system.toml").ok();
    series.prints(&[&format!("truncation {truncation}")]);
}
