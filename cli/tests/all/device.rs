//! `emit --language opencl|cuda` and `ensemble --device`: texts, results, and what is said where there is no device.
//!
//! Runs need OpenCL (pocl will do) and a command built for it; where there is none they say so, and fail with
//! `COADJOINT_REQUIRE_TOOLS=1`.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::support::{Folder, json, root, run};
use serde_json::Value;

const BODY: &str = "examples/rigid_body.toml";
const TOP: &str = "examples/heavy_top.toml";

/// States of which the last twenty are driven so hard that the programs refuse steps, and the very last beyond the chart.
fn states(folder: &Folder, dim: usize, rows: usize) -> String {
    let mut text = (1..=dim).map(|i| format!("mu_{i}")).collect::<Vec<_>>().join(",") + "\n";
    for row in 0..rows {
        let size = match rows - row {
            1 => 1e7,
            left @ 2..=20 => 8.0 + left as f64,
            _ => 0.5 + row as f64 / rows as f64,
        };
        let of = |i: usize| format!("{}", size * (1.3 + 2.1 * i as f64 + 0.1 * row as f64).sin());
        text += &((0..dim).map(of).collect::<Vec<_>>().join(",") + "\n");
    }
    folder.write("states.csv", text)
}

/// Whether the command is built for OpenCL, and there is a device.
fn there_is_one(folder: &Folder) -> bool {
    let initial = states(folder, 3, 40);
    let out = folder.name("probe.csv");
    let words = ["ensemble", BODY, "--initial", &initial, "--out", &out];
    let (code, _, said) = run(&[&words[..], &["--device", "opencl", "--time", "1"]].concat());
    if code == 0 {
        return true;
    }
    assert!(
        ["built without", "no OpenCL library", "no device"].iter().any(|text| said.contains(text)),
        "{said}"
    );
    assert_eq!(said.lines().count(), 1, "{said}");
    let required = std::env::var_os("COADJOINT_REQUIRE_TOOLS").is_some_and(|value| value == "1");
    assert!(!required, "COADJOINT_REQUIRE_TOOLS is set, and {said}");
    eprintln!("{}: nothing was tried", said.trim());
    false
}

fn ensemble(file: &str, initial: &str, out: &str, more: &[&str]) -> Value {
    let mut arguments = vec!["ensemble", file, "--initial", initial, "--out", out];
    arguments.extend(["--format", "json"]);
    arguments.extend(more);
    json(&arguments)
}

#[test]
fn a_device_writes_the_bytes_of_the_interpreter() {
    let folder = Folder::new();
    if !there_is_one(&folder) {
        return;
    }
    for (file, dim) in [(BODY, 3), (TOP, 6)] {
        let initial = states(&folder, dim, 700);
        let [cpu, device] = ["cpu.csv", "device.csv"].map(|name| folder.name(name));
        let backend = ["--backend", "interpreter", "--time", "60"];
        let expected = ensemble(file, &initial, &cpu, &backend);
        let mut more = backend.to_vec();
        more.extend(["--device", "opencl:0"]);
        let report = ensemble(file, &initial, &device, &more);
        assert!(std::fs::read(&cpu).unwrap() == std::fs::read(&device).unwrap(), "{file}");
        for key in ["failed", "drift", "first_failed"] {
            assert_eq!(report[key], expected[key], "{file}: {key}");
        }
        assert!(report["failed"].as_u64().unwrap() > 0, "{report}");
        // More rows than those that failed were helped over a step.
        assert!(report["device"]["redone"].as_u64() >= report["failed"].as_u64(), "{report}");
        assert_eq!(report["device"]["precision"], "double");
        assert!(report["made_by"][0].as_str().unwrap().starts_with("opencl:0 ("), "{report}");
        assert_eq!(expected["made_by"][0], "interpreter");
        assert_eq!(expected["device"], Value::Null);
    }
}

#[test]
fn single_precision_is_as_good_as_its_rounding() {
    let folder = Folder::new();
    if !there_is_one(&folder) {
        return;
    }
    for (file, dim) in [(BODY, 3), (TOP, 6), ("examples/su3_quadratic.toml", 8)] {
        let initial = states(&folder, dim, 60);
        let out = folder.name("single.csv");
        let more = ["--device", "opencl", "--precision", "single", "--time", "5"];
        let report = ensemble(file, &initial, &out, &more);
        assert_eq!(report["device"]["precision"], "single", "{file}");
        assert!(report["failed"].as_u64().unwrap() < 25, "{file}: {report}");
        let drift = |key: &str| report["drift"][key].as_f64().unwrap();
        assert!(drift("spatial_momentum") > 1e-9 && drift("spatial_momentum") < 1e-3, "{report}");
    }
    // A run in another precision is another run. One that is killed leaves its journal.
    let initial = states(&folder, 3, 60_000);
    let out = folder.name("killed.csv");
    let words = ["ensemble", BODY, "--initial", &initial, "--out", &out, "--time", "500"];
    let single = ["--device", "opencl", "--precision", "single"];
    let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    command.current_dir(root()).args([&words[..], &single].concat()).stdout(Stdio::null());
    let mut child = command.spawn().unwrap();
    while !Path::new(&format!("{out}.journal")).exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let journal = std::fs::read_to_string(format!("{out}.journal")).unwrap();
    let journal: Value = serde_json::from_str(&journal).unwrap();
    let by = journal["made_by"][0].as_str().unwrap();
    assert!(by.starts_with("opencl:0 (") && by.ends_with("in single precision"), "{by}");
    let (code, _, said) = run(&words);
    assert!(code == 2 && said.contains("another precision: single, by opencl:0"), "{said}");
}

#[test]
fn a_device_that_cannot_be_had_ends_the_run_with_a_line() {
    let folder = Folder::new();
    let initial = states(&folder, 3, 5);
    let out = folder.name("out.csv");
    let words = ["ensemble", BODY, "--initial", &initial, "--out", &out];
    for (more, expected) in [
        (vec!["--device", "opencl:99"], "--device: "),
        (vec!["--device", "cuda:99"], "--device: "),
        (vec!["--device", "vulkan"], "write opencl or cuda"),
        (vec!["--device", "cuda:x"], "number of a device"),
        (vec!["--precision", "single"], "--device"),
    ] {
        let (code, _, said) = run(&[&words[..], &more].concat());
        assert_eq!(code, 2, "{more:?}: {said}");
        assert!(said.contains(expected), "{more:?}: {said}");
        assert!(!std::path::Path::new(&out).exists());
    }
}

#[test]
fn kernels_are_emitted() {
    for (language, kernel) in [("opencl", "__kernel"), ("cuda", "extern \"C\" __global__")] {
        let text = |more: &[&str]| {
            let (code, out, said) = run(&[&["emit", BODY, "--language", language], more].concat());
            assert_eq!(code, 0, "{said}");
            out
        };
        let double = text(&[]);
        assert!(double.contains(kernel) && double.contains("coadjoint_steps"));
        assert!(
            double.contains("rigid-body on SO3") && double.contains("K = 7, step 0.1."),
            "{double}"
        );
        assert!(double.contains("#define NUMBER double"));
        let single = text(&["--precision", "single", "--step", "0.2", "--truncation", "5"]);
        assert!(single.contains("K = 5, step 0.2") && single.contains("#define NUMBER float"));
        assert!(!single.contains("double "), "{single}");
    }
    for (more, expected) in [
        (&[BODY, "--language", "cuda", "--keep-parameters"][..], "--keep-parameters"),
        (&[BODY, "--step", "0.1"], "--step is for --language opencl and cuda"),
    ] {
        let (code, _, said) = run(&[&["emit"], more].concat());
        assert!(code == 2 && said.contains(expected), "{said}");
    }
}
