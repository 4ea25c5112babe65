//! A killed training goes on where it was and ends with the same bits.

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};

fn learn(folder: &Path, out: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_coadjoint"));
    command
        .arg("learn")
        .arg(folder.join("train.csv"))
        .args(["--dt", "0.1", "--model", "network", "--widths", "40,40", "--evaluations", "1500"])
        .arg("--out")
        .arg(folder.join(out))
        .stdout(Stdio::null());
    command
}

#[test]
fn a_killed_training_ends_with_the_same_model() {
    let folder = tempfile::tempdir().unwrap();
    let wide = MomentumBox { low: -2.0, high: 2.0 };
    let pairs = phase_pairs(&SO3::new(), &Quadratic::paper(), 0.1, wide, 100, 1);
    write_pairs(&folder.path().join("train.csv"), &SO3::new(), &pairs).unwrap();
    assert!(learn(folder.path(), "whole.json").status().unwrap().success());

    let mut child = learn(folder.path(), "killed.json").spawn().unwrap();
    let checkpoint = folder.path().join("killed.json.checkpoint.network");
    while !checkpoint.exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(checkpoint.exists() && !folder.path().join("killed.json").exists());
    assert!(learn(folder.path(), "killed.json").status().unwrap().success());
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(read("whole.json") == read("killed.json"));
    assert!(!checkpoint.exists());
}
