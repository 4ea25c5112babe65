//! `learn`, `simulate --model` and `emit --model`; the case `learn_refused` shows what is refused.

use crate::support::Folder;
use serde_json::Value;

const RUN: &str = "simulate --model model.json --out run.csv";

/// A folder with a learned map.
fn place() -> Folder {
    let place = Folder::new();
    place.pairs("train.csv", 40, 1);
    place.run("learn train.csv --group SO3 --dt 0.1 --degree 2 --out model.json").ok();
    place
}

/// From data on disk to a model, its drifts, and its code.
#[test]
fn learn_simulate_and_emit() {
    let place = Folder::new();
    place.pairs("train.csv", 60, 1);
    place.pairs("test.csv", 20, 2);
    let data = "learn train.csv --test test.csv --group SO3 --dt 0.1 --degree 4 --out model.json";
    let summary = place.json(data);
    for data in ["train", "test"] {
        for quantity in ["x", "momentum", "group"] {
            assert!(summary[data]["mse"][quantity].as_f64().unwrap() < 1e-13, "{summary}");
            assert!(summary[data]["max_error"][quantity].as_f64().unwrap() < 1e-5);
        }
    }
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12);
    let ran = place.run(&format!("{RUN} --start 2,0.5,1 --time 10")).ok();
    assert!(ran.out.starts_with("learned polynomial, exp: 100 steps to time 10"), "{ran:?}");
    assert_eq!(place.table("run.csv").len(), 102);
    place.run("emit --model model.json").ok().prints(&["pub struct Learned"]);
}

/// Steps of forward Euler are no Poisson map, and refused as one. With the tolerance `inf` the nearest Poisson map is found: the
/// Casimir stays, and the model says it is one of momenta.
#[test]
fn the_poisson_map_nearest_to_a_method_is_found() {
    let place = Folder::new();
    let mut text = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n".to_owned();
    for n in 1..=200 {
        let part = |a: f64| 5.0 * (a * f64::from(n)).fract() - 2.5;
        let [x, y, z] = [0.8192, 0.6710, 0.5497].map(part);
        let (u, v, w) =
            (y * z / 2.5 - z * y / 2.0, z * x / 1.5 - x * z / 2.5, x * y / 2.0 - y * x / 1.5);
        text += &format!("{x},{y},{z},{},{},{}\n", x + 0.1 * u, y + 0.1 * v, z + 0.1 * w);
    }
    place.write("pairs.csv", text);
    let learn = "learn pairs.csv --dt 0.1 --degree 4 --start -1,0.5,1 --out model.json";
    place.run(learn).fails(2, &["with --tolerance inf the Poisson map nearest to them is found"]);
    let summary = place.json(&format!("{learn} --tolerance inf"));
    assert!(summary["warnings"][0].as_str().unwrap().starts_with("Casimirs differ by up to "));
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12, "{summary}");
    // Euler's map is not Poisson: what is left is its own defect.
    let left = summary["train"]["mse"]["momentum"].as_f64().unwrap();
    assert!((1e-8..1e-2).contains(&left), "{summary}");
    let model = coadjoint_learn::ModelFile::load(&place.at("model.json")).unwrap();
    assert!(!model.attitude && model.group.name() == "SO3");
}

#[test]
fn reports_and_files_of_learned_runs_are_those_of_every_run() {
    let place = place();
    let report = place.json(&format!("{RUN} --start 2,0.5,1 --time 1000 --every 100"));
    assert_eq!(report["method"], "learned polynomial, exp");
    let drift = &report["drift"];
    for number in
        [&drift["casimirs"], &drift["spatial_momentum"], &report["solver"]["max_residual"]]
    {
        assert!(number.as_f64().unwrap() < 1e-10, "{report}");
    }
    assert!(report.get("energy").is_none() && drift.get("energy").is_none());
    let why = "not known: a learned map has steps of one size";
    assert!(report["estimated_error"].is_null() && report["estimated_error_unknown"] == why);
    let said = "estimated relative error at the end not known: a learned map has steps of one size";
    place.run(&format!("{RUN} --start 2,0.5,1 --time 10")).ok().prints(&[said]);
    let text = place.text("run.csv");
    assert!(text.contains("# model: model.json") && text.contains("# complete: 101 records"));
    assert_eq!(
        place.table("run.csv")[0].join(","),
        "time,mu_1,mu_2,mu_3,g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33,spatial_momentum_drift,casimir_drift"
    );
    place.refused(&[("verify run.csv", "learned map")]);
}

/// A number that is not finite ends the run with the time, and the records up to there stay. The map has one step: another
/// time is refused, not rounded.
#[test]
fn learned_runs_that_cannot_be_made_are_refused() {
    let place = place();
    for (options, code, words) in [
        ("--start nan,0,0 --time 10", 2, "--start: NaN is no finite number"),
        ("--start 1e200,0,0 --time 10", 1, "at time 0, step "),
        ("--start 2,0.5,1 --time 0.25", 2, "no whole number of steps"),
    ] {
        place.run(&format!("{RUN} {options}")).fails(code, &[words]);
        assert!(!place.has("run.csv"));
    }
    let report: Value = place.json(&format!("{RUN} --start 2,0.5,1 --time 0.3"));
    assert_eq!(report["steps"], 3);
}

/// An algebra that no catalogue has: \[U, V\] = −E, \[U, R\] = −2V, \[V, R\] = 2U.
const OSCILLATOR: &str = "[algebra]\nname = \"oscillator\"\ngenerators = [\"U\", \"V\", \"R\", \"E\"]\n\
                          brackets = [\"[U, V] = -E\", \"[U, R] = -two*V\", \"[V, R] = two*U\"]\n\
                          [parameters]\ntwo = 2\n";

/// On the algebra of a system file, which needs no Hamiltonian: the model carries it, and every verb follows the map.
#[test]
fn maps_are_learned_on_the_algebra_of_a_system_file() {
    let place = Folder::new();
    place.write("algebra.toml", OSCILLATOR);
    let hamiltonian = "hamiltonian = \"U^2/2 + V^2/3 + R*E/5 + R^2/9\"\n";
    place.write("system.toml", format!("{hamiltonian}{OSCILLATOR}"));
    let part = |x: f64| 2.0 * (x - x.floor()) - 1.0;
    let mut before = "mu_1,mu_2,mu_3,mu_4\n".to_owned();
    for n in 1..=150 {
        let row = [0.8567, 0.7339, 0.6287, 0.5386].map(|a| part(a * f64::from(n)).to_string());
        before += &(row.join(",") + "\n");
    }
    place.write("before.csv", &before);
    let advance = "--initial before.csv --time 0.1 --out after.csv";
    place.run(&format!("ensemble system.toml {advance} --step 0.1")).ok();
    let after = place.text("after.csv").replace("mu_", "mu_next_");
    let rows = before.lines().zip(after.lines().filter(|line| !line.starts_with('#')));
    place.write("pairs.csv", rows.map(|(a, b)| format!("{a},{b}\n")).collect::<String>());

    let summary =
        place.json("learn pairs.csv --group algebra.toml --dt 0.1 --degree 4 --out model.json");
    assert!(summary["train"]["max_error"]["momentum"].as_f64().unwrap() < 1e-5, "{summary}");
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12, "{summary}");
    place.run("derive --model model.json").ok().prints(&["*mu[0]^2", "*mu[2]*mu[3]"]);
    place.run("emit --model model.json --language c").ok().prints(&["learned_step"]);

    // The map by each of its doors, against the system itself.
    let ends = |name: &str| place.table(name).iter().skip(1).cloned().collect::<Vec<_>>();
    let start = ends("before.csv")[6].join(",");
    let run = format!("simulate --model model.json --out run.csv --time 1 --start {start}");
    place.run(&run).ok().prints(&["learned polynomial, exp: 10 steps"]);
    let all = "--initial before.csv --time 1 --out";
    place.run(&format!("ensemble --model model.json {all} learned.csv")).ok();
    place.run(&format!("ensemble system.toml {all} true.csv --step 0.1")).ok();
    let (run, learned, exact) = (ends("run.csv"), ends("learned.csv"), ends("true.csv"));
    let number = |text: &String| text.parse::<f64>().unwrap();
    for i in 0..4 {
        let followed = number(&run[10][i + 1]);
        assert!((followed - number(&learned[6][i])).abs() < 1e-12, "{run:?}");
        assert!((followed - number(&exact[6][i])).abs() < 1e-4, "{followed} {exact:?}");
    }
    place.write("attitudes.csv", "mu_1,mu_2,mu_3,mu_4,g_11,g_12\n1,0,0,1,1,0\n");
    place.write("bad.toml", "[algebra]\ngenerators = [\"a\"]\nbrackets = [\"[a, b] = a\"]\n");
    place.refused(&[
        ("learn pairs.csv --dt 0.1 --group missing.toml", "missing.toml"),
        ("learn pairs.csv --dt 0.1 --group bad.toml", "bad.toml:3:13: error: unknown variable `b`"),
        ("learn pairs.csv --dt 0.1 --group algebra.toml --out algebra.toml", "algebra.toml"),
        ("learn pairs.csv --dt 0.1 --group algebra.toml --chart cayley", "cayley"),
        ("ensemble --model model.json --initial before.csv --out a.csv", "--time"),
        (&format!("ensemble --model model.json {all} a.csv --step 0.1"), "a step of its own"),
        (
            "ensemble --model model.json --initial before.csv --time 0.25 --out a.csv",
            "whole number",
        ),
        (&format!("ensemble --model model.json {all} a.csv --estimate 3"), "--estimate"),
        (&format!("ensemble --model model.json {all} a.csv --at 0.55,1"), "--at"),
        ("derive --model model.json --format json", "--format"),
    ]);
}
