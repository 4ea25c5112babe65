//! The commands in docs/learning.md are run as they stand.
#![allow(clippy::unwrap_used)]

use coadjoint::SO3;
use coadjoint_learn::data::write_pairs;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};

mod support;

#[test]
fn the_commands_of_the_page_on_learning_run() {
    let page = std::fs::read_to_string(support::root().join("docs/learning.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let wide = MomentumBox { low: -2.5, high: 2.5 };
    for (name, count, seed) in [("train.csv", 60, 1), ("test.csv", 20, 2)] {
        let pairs = phase_pairs(&SO3::new(), &Quadratic::paper(), 0.1, wide, count, seed);
        write_pairs(&folder.path().join(name), &SO3::new(), &pairs).unwrap();
    }
    let system = support::root().join("examples/rigid_body.toml");
    std::fs::copy(system, folder.path().join("rigid_body.toml")).unwrap();
    let blocks = page.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let commands: Vec<&str> = blocks.flat_map(str::lines).collect();
    assert!(commands.len() >= 5, "{commands:?}");
    for command in commands {
        let words: Vec<&str> = command.split_whitespace().collect();
        assert_eq!(words[0], "coadjoint", "{command}");
        let output =
            support::coadjoint().current_dir(folder.path()).args(&words[1..]).output().unwrap();
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    }
    for made in ["model.json", "quartic.json", "run.csv", "quartic.rs"] {
        assert!(folder.path().join(made).exists(), "{made}");
    }
}
