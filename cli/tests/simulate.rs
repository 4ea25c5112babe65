//! `simulate`: the reference end state, the keys programs rely on, and the files it writes.

mod support;

use serde_json::Value;
use support::{file, json, numbers, root, run};

/// The paper's rigid body at T = 100, 25 digits by a separate implementation
/// (`end_states.json`, "rigid-body (paper)"), rounded to f64.
const MOMENTUM: [f64; 3] = [2.010707126264523, -0.36808278919852901, -1.0351675771028064];
const ATTITUDE: [[f64; 3]; 3] = [
    [0.65150238803525687, -0.6113717809846443, -0.44918724803807787],
    [-0.090946380002903989, 0.52488019083483492, -0.84630345694292452],
    [0.75317554019546132, 0.59222067735334215, 0.28635864744746481],
];

fn error(run: &Value) -> f64 {
    let end = numbers(&run["momentum"]);
    end.iter().zip(MOMENTUM).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The target of the command's main job: 1e-11 at K = 7; K = 3 and 5 as their orders say.
#[test]
fn the_rigid_body_of_the_paper_ends_where_it_should() {
    let runs = json(&[
        "simulate",
        "examples/rigid_body.toml",
        "--truncation",
        "3,5,7",
        "--format",
        "json",
    ]);
    let runs = runs.as_array().unwrap();
    assert_eq!(runs.len(), 3);
    let errors: Vec<f64> = runs.iter().map(error).collect();
    assert!(errors[0] > 1e-9 && errors[0] < 1e-5, "{errors:?}");
    assert!(errors[1] > 1e-12 && errors[1] < 1e-8, "{errors:?}");
    assert!(errors[2] < 1e-11, "{errors:?}");
    for run in runs {
        assert!(run["drift"]["spatial_momentum"].as_f64().unwrap() <= 1e-13);
        assert!(run["drift"]["casimirs"].as_f64().unwrap() <= 1e-13);
    }
    for (row, expected) in runs[2]["group_element"].as_array().unwrap().iter().zip(ATTITUDE) {
        for (a, b) in numbers(row).iter().zip(expected) {
            assert!((a - b).abs() < 1e-11, "{a} {b}");
        }
    }
}

/// The tail of the series summed: the same step, ten times closer.
#[test]
fn a_tuned_run_ends_closer() {
    let command = ["simulate", "examples/rigid_body.toml", "--truncation", "9"];
    let options = ["--step", "0.5", "--format", "json"];
    let plain = json(&[command, options].concat());
    let tuned = json(&[&command[..], &["--tuned"], &options].concat());
    let (plain_error, tuned_error) = (error(&plain), error(&tuned));
    assert!(tuned_error < plain_error / 5.0, "{plain_error:e} {tuned_error:e}");
    assert!(tuned["drift"]["casimirs"].as_f64().unwrap() <= 1e-13);
    assert_eq!(tuned["method"], "K = 9, exp, tuned");

    // Kicks leave the flow's motion.
    let refused = run(&["simulate", "examples/satellite.toml", "--tuned"]);
    assert_eq!(refused.0, 2);
    assert!(refused.2.contains("--tuned"), "{}", refused.2);
}

/// Fitted to the motion, K = 5 is closer than K = 9 is.
#[test]
fn a_fitted_run_ends_closer_by_orders() {
    let command = ["simulate", "examples/rigid_body.toml", "--truncation", "5"];
    let options = ["--step", "0.5", "--format", "json"];
    let plain = json(&[command, options].concat());
    let fitted = json(&[&command[..], &["--fitted", "12"], &options].concat());
    let (plain_error, fitted_error) = (error(&plain), error(&fitted));
    assert!(fitted_error < plain_error / 1e4, "{plain_error:e} {fitted_error:e}");
    assert!(fitted["drift"]["casimirs"].as_f64().unwrap() <= 1e-13);
    assert_eq!(fitted["method"], "K = 5, exp, fitted");

    for (mistake, said) in [
        (vec!["examples/satellite.toml", "--fitted", "12"], "kicks of a potential"),
        (vec!["examples/rigid_body.toml", "--fitted", "0"], "duration 0 is not usable"),
        (vec!["examples/rigid_body.toml", "--fitted", "12", "--tuned"], "--tuned"),
    ] {
        let refused = run(&[&["simulate"], &mistake[..]].concat());
        assert_eq!(refused.0, 2, "{mistake:?}");
        assert!(refused.2.contains(said), "{}", refused.2);
    }
}

#[test]
fn json_has_the_keys_programs_rely_on() {
    let run = json(&["simulate", "examples/heavy_top.toml", "--time", "1", "--format", "json"]);
    assert_eq!(run["steps"], 20);
    assert_eq!(run["time"], 1.0);
    assert_eq!(numbers(&run["momentum"]).len(), 6);
    assert_eq!(run["group_element"].as_array().unwrap().len(), 4);
    for (table, key) in [
        ("drift", "spatial_momentum"),
        ("drift", "casimirs"),
        ("drift", "energy"),
        ("solver", "mean_iterations"),
        ("solver", "max_residual"),
    ] {
        assert!(run[table][key].is_number(), "{table}.{key}");
    }
    assert!(run["solver"]["mean_iterations"].as_f64().unwrap() >= 1.0);
    assert!(run["solver"]["max_residual"].as_f64().unwrap() < 1e-14);
}

/// Backwards from the end leads to the start.
#[test]
fn a_negative_step_runs_backwards() {
    let arguments = ["simulate", "examples/rigid_body.toml", "--time", "2", "--format", "json"];
    let forward = json(&arguments);
    let directory = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(root().join("examples/rigid_body.toml")).unwrap();
    let end = format!("momentum = {}", forward["momentum"]);
    let element = format!("\ngroup_element = {}", forward["group_element"]);
    let system = file(&directory, &text.replace("momentum = [2.0, 0.5, 1.0]", &(end + &element)));
    let back = json(&["simulate", &system, "--time", "2", "--step", "-0.1", "--format", "json"]);
    for (a, b) in numbers(&back["momentum"]).iter().zip([2.0, 0.5, 1.0]) {
        assert!((a - b).abs() < 1e-13);
    }
    assert!((back["group_element"][0][0].as_f64().unwrap() - 1.0).abs() < 1e-13);
}

/// Both charts of one system, and algebras given by basis and by brackets.
#[test]
fn other_charts_and_algebras_keep_their_momentum_too() {
    for arguments in [
        &["simulate", "examples/rigid_body.toml", "--chart", "cayley", "--time", "5"][..],
        &["simulate", "examples/sl2_by_basis.toml"],
        &["simulate", "examples/so21_by_brackets.toml"],
    ] {
        let run = json(&[arguments, &["--format", "json"]].concat());
        assert!(run["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12, "{arguments:?}");
        assert!(run["drift"]["casimirs"].as_f64().unwrap() < 1e-12, "{arguments:?}");
    }
}

#[test]
fn files_and_pictures_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let path = |name: &str| directory.path().join(name).to_str().unwrap().to_owned();
    let (csv, npy, svg) = (path("t.csv"), path("t.npy"), path("drift.svg"));
    let base = ["simulate", "examples/rigid_body.toml", "--time", "2", "--every", "4"];
    let (code, _, _) =
        run(&[&base[..], &["--out", &csv, "--plot", &svg, "--compare", "rk45"]].concat());
    assert_eq!(code, 0);
    let mut reader = csv::Reader::from_path(&csv).unwrap();
    let header: Vec<String> = reader.headers().unwrap().iter().map(Into::into).collect();
    assert_eq!(header[..5], ["time", "mu_1", "mu_2", "mu_3", "g_11"]);
    let rows: Vec<Vec<f64>> =
        reader.records().map(|r| r.unwrap().iter().map(|x| x.parse().unwrap()).collect()).collect();
    // 20 steps, every 4th, and the start.
    assert_eq!(rows.len(), 6);
    assert_eq!(rows[0][1..4], [2.0, 0.5, 1.0]);
    assert_eq!(rows[5][0], 2.0);

    let (code, _, _) = run(&[&base[..], &["--out", &npy]].concat());
    assert_eq!(code, 0);
    let bytes = std::fs::read(&npy).unwrap();
    let array = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(array.shape(), [6, header.len() as u64]);
    assert_eq!(array.into_vec::<f64>().unwrap(), rows.concat());

    let drawing = std::fs::read_to_string(&svg).unwrap();
    for text in ["relative drift of energy", "spatial momentum", "Casimirs", "K = 7", "RK45"] {
        assert!(drawing.contains(text), "{text}");
    }
    let (code, _, error) = run(&[&base[..], &["--out", &path("t.xls")]].concat());
    assert_eq!(code, 2);
    assert!(error.contains(".csv or .npy"));
}

/// What the paper's figures show: the Runge–Kutta method loses the momentum, the integrator keeps it.
#[test]
fn the_rival_drifts() {
    let runs =
        json(&["simulate", "examples/rigid_body.toml", "--compare", "rk45", "--format", "json"]);
    let drift = |i: usize| runs[i]["drift"]["spatial_momentum"].as_f64().unwrap();
    assert!(drift(0) < 1e-13 && drift(1) > 1e-8);
    // Still the same system: it ends near the same place.
    assert!(error(&runs[1]) < 1e-2, "{}", error(&runs[1]));
    assert!(runs[1]["solver"].is_null());
}
