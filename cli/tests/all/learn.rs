//! `learn`, `simulate --model`, `emit --model`, `geometrize`, and where `reproduce` has gone.

use crate::support::{Folder, json, run};

/// From data on disk to a model, its drifts, and its code.
#[test]
fn learn_simulate_and_emit() {
    let folder = Folder::new();
    let (train, test) = (folder.pairs("train.csv", 60, 1), folder.pairs("test.csv", 20, 2));
    let (model, out) = (folder.name("model.json"), folder.name("run.csv"));
    let data = ["learn", &train, "--test", &test, "--group", "SO3", "--dt", "0.1"];
    let summary =
        json(&[&data[..], &["--degree", "4", "--format", "json", "--out", &model]].concat());
    for data in ["train", "test"] {
        for quantity in ["x", "momentum", "group"] {
            assert!(summary[data]["mse"][quantity].as_f64().unwrap() < 1e-13, "{summary}");
            assert!(summary[data]["max_error"][quantity].as_f64().unwrap() < 1e-5);
        }
    }
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12);

    let start = ["simulate", "--start", "2,0.5,1", "--time", "10", "--model", &model];
    let (code, said, error) = run(&[&start[..], &["--out", &out]].concat());
    assert_eq!(code, 0, "{error}");
    assert!(said.starts_with("learned polynomial, exp: 100 steps to time 10"), "{said}");
    let rows = folder.text("run.csv");
    assert_eq!(rows.lines().filter(|line| !line.starts_with('#')).count(), 102);

    let (code, module, _) = run(&["emit", "--model", &model]);
    assert!(code == 0 && module.contains("pub struct Learned"), "{module}");
}

#[test]
fn bad_data_and_models_exit_with_two() {
    let folder = Folder::new();
    let model = folder.write("model.json", "{}");
    let missing = ["learn", "missing.csv", "--dt", "0.1"];
    let (network, body) =
        (["--model", "network", "--activation", "relu"], "examples/rigid_body.toml");
    // The verb of earlier versions names the program that has its place.
    let paper = "cargo run --release -p coadjoint-paper -- all --quick --html report.html";
    for (arguments, expected) in [
        (
            &["simulate", "--start", "2,0.5,1", "--time", "10", "--model", &model][..],
            "is not `coadjoint-model`",
        ),
        (&missing, "missing.csv"),
        (&[&missing[..], &network].concat(), "piecewise constant"),
        (&["geometrize", "--dt", "0.1"], "DATA"),
        (&["geometrize", "--system", body, "--dt", "0.1", "--within", "3,1"], "is no interval"),
        (&["reproduce"], paper),
        (&["reproduce", "all", "--quick", "--html", "report.html"], paper),
    ] {
        let (code, _, error) = run(arguments);
        assert_eq!(code, 2, "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

/// Forward Euler on a system file, geometrized: the Casimir stays, and the model says it is one of
/// momenta.
#[test]
fn geometrize_a_method_on_a_system() {
    let folder = Folder::new();
    let out = folder.name("model.json");
    let pairs =
        ["geometrize", "--system", "examples/rigid_body.toml", "--map", "euler", "--dt", "0.1"];
    let fit = ["--samples", "200", "--degree", "4", "--start", "2,0.5,1", "--format", "json"];
    let summary = json(&[&pairs[..], &fit, &["--out", &out]].concat());
    assert!(summary["drifts"]["casimir"].as_f64().unwrap() < 1e-12, "{summary}");
    // Euler's map is not Poisson: what is left is its own defect.
    let left = summary["train"]["mse"]["momentum"].as_f64().unwrap();
    assert!((1e-8..1e-2).contains(&left), "{summary}");
    let model = coadjoint_learn::ModelFile::load(out.as_ref()).unwrap();
    assert!(!model.attitude && model.group == "SO3");
}

/// Numbers that make no sense, and sizes that no memory holds, are refused as arguments.
#[test]
fn arguments_without_sense_are_refused_before_anything_is_allocated() {
    let folder = Folder::new();
    let mut text = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n".to_owned();
    for i in 0..40 {
        let x = f64::from(i) / 40.0;
        text += &format!("{},{},1,{},{},1.01\n", x, 1.0 - x, x + 0.01, 0.99 - x);
    }
    let data = &folder.write("pairs.csv", text);
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
        let (code, _, error) = run(arguments);
        assert_eq!(code, 2, "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

/// Data that do not support a model are refused in words.
#[test]
fn data_that_support_no_model_are_refused() {
    let folder = Folder::new();
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
        let path = folder.write("data.csv", &text);
        let (code, _, error) = run(&[&["learn", &path, "--dt", "0.1"], options].concat());
        assert!(code != 0 && error.contains(expected), "{text}{error}");
    }
}
