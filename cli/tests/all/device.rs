//! `ensemble --device`: results; cases `emit` and `device_refused` show the texts, and what is said where there is no device.
//!
//! Runs need OpenCL (pocl will do) and a command built for it; where there is none they say so, and fail with
//! `COADJOINT_REQUIRE_TOOLS=1`.

use std::time::Duration;

use crate::support::{BODY, Folder};
use serde_json::Value;

const TOP: &str = "examples/heavy_top.toml";

/// States of which the last twenty are driven so hard that the programs refuse steps, and the very last beyond the chart.
fn states(folder: &Folder, dim: usize, rows: usize) {
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
    folder.write("states.csv", text);
}

/// A folder, where the command is built for OpenCL and there is a device.
fn place() -> Option<Folder> {
    let folder = Folder::new();
    states(&folder, 3, 40);
    let probe = "--initial states.csv --out probe.csv --device opencl --time 1";
    let ran = folder.run(&format!("ensemble {BODY} {probe}"));
    if ran.code == 0 {
        return Some(folder);
    }
    let reasons = ["built without", "no OpenCL library", "no device"];
    assert!(reasons.iter().any(|text| ran.error.contains(text)), "{ran:?}");
    assert_eq!(ran.error.lines().count(), 1, "{ran:?}");
    let required = std::env::var_os("COADJOINT_REQUIRE_TOOLS").is_some_and(|value| value == "1");
    assert!(!required, "COADJOINT_REQUIRE_TOOLS is set, and {}", ran.error);
    eprintln!("{}: nothing was tried", ran.error.trim());
    None
}

fn ensemble(folder: &Folder, file: &str, out: &str, more: &str) -> Value {
    folder.json(&format!("ensemble {file} --initial states.csv --out {out} {more}"))
}

#[test]
fn a_device_writes_the_bytes_of_the_interpreter() {
    let Some(folder) = place() else { return };
    for (file, dim) in [(BODY, 3), (TOP, 6)] {
        states(&folder, dim, 700);
        let backend = "--backend interpreter --time 60";
        let expected = ensemble(&folder, file, "cpu.csv", backend);
        let report = ensemble(&folder, file, "device.csv", &format!("{backend} --device opencl:0"));
        assert!(folder.bytes("cpu.csv") == folder.bytes("device.csv"), "{file}");
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
    let Some(folder) = place() else { return };
    let single = "--device opencl --precision single";
    for (file, dim) in [(BODY, 3), (TOP, 6), ("examples/su3_quadratic.toml", 8)] {
        states(&folder, dim, 60);
        let report = ensemble(&folder, file, "single.csv", &format!("{single} --time 5"));
        assert_eq!(report["device"]["precision"], "single", "{file}");
        assert!(report["failed"].as_u64().unwrap() < 25, "{file}: {report}");
        let drift = |key: &str| report["drift"][key].as_f64().unwrap();
        assert!(drift("spatial_momentum") > 1e-9 && drift("spatial_momentum") < 1e-3, "{report}");
    }
    // A run in another precision is another run. One that is killed leaves its journal.
    states(&folder, 3, 60_000);
    let run = format!("ensemble {BODY} --initial states.csv --out killed.csv --time 500");
    let mut child = folder.command(&format!("{run} {single}")).spawn().unwrap();
    while !folder.has("killed.csv.journal") && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let journal: Value = serde_json::from_str(&folder.text("killed.csv.journal")).unwrap();
    let by = journal["made_by"][0].as_str().unwrap();
    assert!(by.starts_with("opencl:0 (") && by.ends_with("in single precision"), "{by}");
    folder.refused(&[(&run, "another precision: single, by opencl:0")]);
}
