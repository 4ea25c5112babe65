//! `learn`, `simulate --model`, `emit --model`, `geometrize`, and where `reproduce` has gone.

use assert_cmd::Command;
use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};

fn coadjoint() -> Command {
    Command::cargo_bin("coadjoint").unwrap()
}

/// From data on disk to a model, its drifts, and its code.
#[test]
fn learn_simulate_and_emit() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let group = SO3::new();
    let pairs = |count, seed| {
        let wide = MomentumBox { low: -2.0, high: 2.0 };
        phase_pairs(&group, &Quadratic::paper(), 0.1, wide, count, seed)
    };
    write_pairs(&at("train.csv"), &group, &pairs(60, 1)).unwrap();
    write_pairs(&at("test.csv"), &group, &pairs(20, 2)).unwrap();
    let output = coadjoint()
        .args(["learn"])
        .arg(at("train.csv"))
        .args(["--group", "SO3", "--dt", "0.1", "--degree", "4", "--format", "json", "--test"])
        .arg(at("test.csv"))
        .arg("--out")
        .arg(at("model.json"))
        .assert()
        .success();
    let summary: serde_json::Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
    for data in ["train", "test"] {
        for quantity in ["x", "momentum", "group"] {
            assert!(summary[data]["mse"][quantity].as_f64().unwrap() < 1e-13, "{summary}");
            assert!(summary[data]["max_error"][quantity].as_f64().unwrap() < 1e-5);
        }
    }
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12);

    let run = coadjoint()
        .args(["simulate", "--start", "2,0.5,1", "--time", "10", "--model"])
        .arg(at("model.json"))
        .arg("--out")
        .arg(at("run.csv"))
        .assert()
        .success();
    let said = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    assert!(said.starts_with("learned polynomial, exp: 100 steps to time 10"), "{said}");
    let rows = std::fs::read_to_string(at("run.csv")).unwrap();
    assert_eq!(rows.lines().filter(|line| !line.starts_with('#')).count(), 102);
    assert!(rows.contains("\ntime,mu_1,mu_2,mu_3,g_11,"), "{rows}");

    let code = coadjoint().args(["emit", "--model"]).arg(at("model.json")).assert().success();
    let code = String::from_utf8_lossy(&code.get_output().stdout).into_owned();
    assert!(code.contains("pub struct Learned"), "{code}");
}

#[test]
fn bad_data_and_models_exit_with_two() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.json");
    std::fs::write(&path, "{}").unwrap();
    let run = coadjoint()
        .args(["simulate", "--start", "2,0.5,1", "--time", "10", "--model"])
        .arg(&path)
        .assert()
        .code(2);
    let message = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(message.contains("is not `coadjoint-model`"), "{message}");
    coadjoint().args(["learn", "missing.csv", "--dt", "0.1"]).assert().code(2);
    let relu =
        ["learn", "missing.csv", "--dt", "0.1", "--model", "network", "--activation", "relu"];
    let run = coadjoint().args(relu).assert().code(2);
    let message = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(message.contains("piecewise constant"), "{message}");
}

#[test]
fn reproduce_names_the_program_that_has_its_place() {
    for arguments in [&["reproduce"][..], &["reproduce", "all", "--quick", "--html", "report.html"]]
    {
        let run = coadjoint().args(arguments).assert().code(2);
        let message = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
        let command = "cargo run --release -p coadjoint-paper -- all --quick --html report.html";
        assert!(message.contains(command), "{message}");
    }
}

/// Forward Euler on a system file, geometrized: the Casimir stays, and the model says it is one of
/// momenta.
#[test]
fn geometrize_a_method_on_a_system() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("model.json");
    let system = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/rigid_body.toml");
    let run = coadjoint()
        .args(["geometrize", "--system", system, "--map", "euler", "--samples", "200"])
        .args(["--dt", "0.1", "--degree", "4", "--start", "2,0.5,1", "--format", "json", "--out"])
        .arg(&out)
        .assert()
        .success();
    let summary: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12, "{summary}");
    // Euler's map is not Poisson: what is left is its own defect.
    let left = summary["train"]["mse"]["momentum"].as_f64().unwrap();
    assert!((1e-8..1e-2).contains(&left), "{summary}");
    let model = coadjoint_learn::ModelFile::load(&out).unwrap();
    assert!(!model.attitude && model.group == "SO3");
    coadjoint().args(["geometrize", "--dt", "0.1"]).assert().code(2);
    coadjoint()
        .args(["geometrize", "--system", system, "--dt", "0.1", "--within", "3,1"])
        .assert()
        .code(2);
}

/// Numbers that make no sense, and sizes that no memory holds, are refused as arguments.
#[test]
fn arguments_without_sense_are_refused_before_anything_is_allocated() {
    let directory = tempfile::TempDir::new().unwrap();
    let data = directory.path().join("pairs.csv");
    let mut text = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n".to_owned();
    for i in 0..40 {
        let x = f64::from(i) / 40.0;
        text += &format!("{},{},1,{},{},1.01\n", x, 1.0 - x, x + 0.01, 0.99 - x);
    }
    std::fs::write(&data, text).unwrap();
    let data = data.to_str().unwrap();
    let body = "examples/rigid_body.toml";
    for (arguments, expected) in [
        (["learn", data, "--dt", "0.1", "--start", "nan,1,1"].as_slice(), "start is NaN"),
        (&["learn", data, "--dt", "0.1", "--start", "1,inf,1"], "start is inf"),
        (&["learn", data, "--dt", "0.1", "--ridge", "nan"], "ridge is NaN"),
        (&["learn", data, "--dt", "0.1", "--degree", "50"], "23425 coefficients"),
        (&["learn", data, "--dt", "0.1", "--degree", "1000"], "167668500 coefficients"),
        (&["learn", data, "--dt", "0.1", "--degree", "0"], "degree is 0"),
        (
            &["geometrize", "--system", body, "--dt", "0.1", "--samples", "1000000000"],
            "--samples 1000000000: at most 100000 pairs",
        ),
        (&["geometrize", "--system", body, "--dt", "0.1", "--start", "nan,0,0"], "start is NaN"),
    ] {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
        let output = coadjoint().current_dir(root).args(arguments).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

/// Data that do not support a model are refused in words.
#[test]
fn data_that_support_no_model_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("data.csv");
    let head = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n";
    let three = "1,0,0,1,0,0\n0,1,0,0,1,0\n0,0,1,0,0,1\n";
    let wide = "mu_1,mu_2,mu_3,mu_4,mu_next_1,mu_next_2,mu_next_3\n1,0,0,0,1,0,0\n";
    for (text, options, expected) in [
        (format!("{head}{three}"), &["--degree", "4"][..], "3 samples do not determine"),
        (format!("{head}{three}"), &[], "3 samples do not determine"),
        (head.to_owned(), &[], "no usable sample"),
        (format!("{head}1,0,0,1.1,0,0\n"), &[], "a Casimir of the group differs by 2.1e-1"),
        (wide.to_owned(), &[], "a momentum of this group has 4 entries where 3 are needed"),
    ] {
        std::fs::write(&path, &text).unwrap();
        let made = coadjoint().arg("learn").arg(&path).args(["--dt", "0.1"]).args(options).output();
        let (made, error) = made.map(|m| (m.status.success(), m.stderr)).unwrap();
        let error = String::from_utf8_lossy(&error).into_owned();
        assert!(!made && error.contains(expected), "{text}{error}");
    }
}
