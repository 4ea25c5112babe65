//! Events of a run: where functions of the state change their sign.

use serde_json::Value;

use crate::support::Folder;

/// A body that turns about its third axis with velocity 1.
const TURN: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "z"
[parameters]
level = "-0.9"
[integrator]
step = 0.7
truncation = 3
[initial]
momentum = [1, 2, 3]
[run]
time = 13
"#;

const EVENTS: &str = r#"
[[event]]
name = "level"
when = "g[0][0] - level"
direction = "up"
[[event]]
when = "x - 2*y"
"#;

fn events(report: &Value) -> Vec<(String, f64)> {
    let list = report["events"].as_array().unwrap().iter();
    let event = |event: &Value| {
        (event["event"].as_str().unwrap().to_owned(), event["time"].as_f64().unwrap())
    };
    list.map(event).collect()
}

#[test]
fn events_of_a_file_are_found_within_steps() {
    let folder = Folder::with(&format!("{TURN}{EVENTS}"));
    let found = events(&folder.json("simulate system.toml"));
    // g is the rotation by t, and μ turns backwards: x = cos t + 2 sin t, y = 2 cos t − sin t.
    let turn = std::f64::consts::TAU;
    let level = turn - (-0.9_f64).acos();
    let even = 0.75_f64.atan();
    let mut expected: Vec<(&str, f64)> = vec![("level", level), ("level", level + turn)];
    expected.extend((0..5).map(|half| ("x - 2*y", even + f64::from(half) * turn / 2.0)));
    expected.retain(|(_, time)| *time < 13.0);
    expected.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((name, time), (known, at)) in found.iter().zip(expected) {
        assert!(name == known && (time - at).abs() < 1e-12, "{name} {time} {at}");
    }
    let text = folder.run("simulate system.toml").ok();
    text.prints(&["event level: at 3.59", "event x - 2*y: at 0.643"]);
}

/// The last record is that of the event, and every record before it is judged right.
#[test]
fn a_run_ends_at_an_event() {
    let folder = Folder::with(TURN);
    let report = folder.json("simulate system.toml --until g[0][0]+0.9 --out run.csv");
    let end = (-0.9_f64).acos();
    assert!((report["time"].as_f64().unwrap() - end).abs() < 1e-12, "{report}");
    assert_eq!(report["steps"], 3);
    let table = folder.table("run.csv");
    let times: Vec<f64> = table[1..].iter().map(|row| row[0].parse().unwrap()).collect();
    assert_eq!(times.len(), 5);
    assert_eq!(times[4], report["time"].as_f64().unwrap());
    folder.run("verify run.csv").ok().prints(&["no row is wrong"]);
    let never = folder.run("simulate system.toml --until z-4").ok();
    never.prints(&["the event `z-4` did not occur; its function was -1 at the start and is -1"]);
}

#[test]
fn mistakes_about_events() {
    for (event, expected) in [
        ("when = \"w\"", "unknown variable `w`"),
        ("name = \"x\"", "when"),
        ("when = \"x\"\ndirection = \"left\"", "`direction` is up, down or both"),
        ("when = \"x\"\nstop = 1", "true or false"),
        ("when = \"x\"\nlooks = 2", "looks"),
    ] {
        let folder = Folder::with(&format!("{TURN}[[event]]\n{event}\n"));
        folder.run("simulate system.toml").fails(2, &[expected]);
    }
    let folder = Folder::with(TURN);
    for (function, expected) in [("w", "--until w: unknown variable `w`"), ("x+", "--until x+: ")] {
        folder.refused(&[(&format!("simulate system.toml --until {function}"), expected)]);
    }
    let folder = Folder::with(&format!("{TURN}[[event]]\nwhen = \"sqrt(x)\"\n"));
    folder.run("simulate system.toml").fails(1, &["the event `sqrt(x)` is NaN at time 2.7"]);
    let folder = Folder::with(&format!("{TURN}{EVENTS}"));
    folder.run("simulate system.toml --checkpoint c").fails(2, &["leave one of them out"]);
    folder.write("states.csv", "mu_1,mu_2,mu_3\n1,2,3\n");
    let ensemble = "ensemble system.toml --initial states.csv --out end.csv";
    folder.run(ensemble).fails(2, &["ensembles do not look for events"]);
}
