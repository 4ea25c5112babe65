//! Time is a part of the state: a run that starts where an earlier one has ended goes on as that one does.

use serde_json::Value;

use crate::support::{Folder, distance, numbers};

/// Systems that depend on time in each of the ways that there are; the last values are those of [inputs] and [integrator].
const DRIVEN: [&str; 7] = [
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5 + 3*sin(t)*x'",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5 + u*z'\n\
     [inputs]\ntimes = [0, 1, 2, 3, 4]\nu = [0, 2, -1, 3, 1]",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5'\ntorque = ['sin(2*t)', '0', 't/4']",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5'\ntorque = ['u', '0', '-z/5']\n\
     [inputs]\ntimes = [0, 1, 2, 3, 4]\nu = [0, 2, -1, 3, 1]",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5 + 3*sin(t)*x'\npotential = 'g[2][2] + g[0][1]^2/3'",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5 + 3*sin(t)*x'\ndamping = 0.2",
    "hamiltonian = 'x^2/3 + a*y^2/4 + z^2/5'\npotential = 'g[2][2]'\ntorque = ['sin(2*t)', '0', 't/4']",
];

/// The system file with this state, a momentum and a matrix, at the start.
fn system(driven: &str, start: &str) -> String {
    format!(
        "group = 'SO3'\ncoordinates = 'x y z'\n{driven}\n[parameters]\na = 1\n[integrator]\nstep = 0.1\n\
         [initial]\n{start}\n"
    )
}

fn state(report: &Value) -> Vec<f64> {
    numbers(&report["momentum"])
        .into_iter()
        .chain(report["group_element"].as_array().unwrap().iter().flat_map(numbers))
        .collect()
}

#[test]
fn a_run_goes_on_where_another_has_ended() {
    for driven in DRIVEN {
        let folder = Folder::with(&system(driven, "momentum = [2, 0.5, 1]"));
        let at = "--at 2,3.05,4 --out run.csv";
        let whole = state(&folder.json(&format!("simulate system.toml --time 4 {at}")));
        let half = folder.json("simulate system.toml --time 2");
        let start =
            format!("momentum = {}\ngroup_element = {}", half["momentum"], half["group_element"]);
        let close = |what: &str, found: &[f64], right: &[f64]| {
            let apart = distance(found, right);
            assert!(apart < 1e-12, "{driven}: {what}: {found:?} {right:?} {apart:e}");
        };
        // The time of the file, and that of the option instead of it.
        folder.write("file.toml", system(driven, &format!("time = 2\n{start}")));
        folder.write("other.toml", system(driven, &format!("time = 1\n{start}")));
        let recorded = folder.table("run.csv");
        for (command, backend) in [("file.toml", "interpreter"), ("other.toml --t0 2", "auto")] {
            let command = format!("simulate {command} --time 2 --backend {backend}");
            let report = folder.json(&format!("{command} --at 2,3.05,4 --out again.csv"));
            close(&command, &state(&report), &whole);
            // Steps of other sizes beside it are of its time too.
            let small = |error: &Value| error.as_f64().is_none_or(|error| error < 0.01);
            assert!(small(&report["estimated_error"]), "{driven}: {report}");
            assert_eq!(
                (&report["time"], &report["run"]["initial_time"]),
                (&4.0.into(), &2.0.into())
            );
            let again = folder.table("again.csv");
            assert_eq!(again.len(), 4);
            for (own, right) in again[1..].iter().zip(&recorded[1..]) {
                let row = |row: &[String]| -> Vec<f64> {
                    row[..13].iter().map(|cell| cell.parse().unwrap()).collect()
                };
                close("a record", &row(own), &row(right));
            }
        }
        // A record beside the grid is the end of a run from the grid point before it.
        folder.json("simulate system.toml --time 4 --at 3,3.05 --out near.csv");
        let near = folder.table("near.csv");
        let cells = |row: usize| near[row][1..13].join(",");
        let g: Vec<String> =
            near[1][4..13].chunks(3).map(|row| format!("[{}]", row.join(","))).collect();
        let here = format!(
            "time = 3\nmomentum = [{}]\ngroup_element = [{}]",
            near[1][1..4].join(","),
            g.join(",")
        );
        folder.write("near.toml", system(driven, &here));
        folder.run("simulate near.toml --time 0.05 --step 0.05 --out one.csv").ok();
        let parsed = |text: &str| text.split(',').map(|x| x.parse().unwrap()).collect::<Vec<f64>>();
        let one = folder.table("one.csv")[2][1..13].join(",");
        close("beside the grid", &parsed(&cells(2)), &parsed(&one));
        // Backwards from the end, by the map itself.
        let end = folder.json("simulate file.toml --time 2");
        let last = format!(
            "time = 4\nmomentum = {}\ngroup_element = {}",
            end["momentum"], end["group_element"]
        );
        folder.write("last.toml", system(driven, &last));
        let back = state(&folder.json("simulate last.toml --time 2 --step -0.1"));
        if !driven.contains("-z/5") {
            close("back", &back, &state(&half));
        }
        // Rows, of which the second has a parameter of its own.
        let cells = |state: &[f64]| state.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let names = "mu_1,mu_2,mu_3,g_11,g_12,g_13,g_21,g_22,g_23,g_31,g_32,g_33";
        let half = cells(&state(&half));
        folder.write("rows.csv", format!("{names}\n{half}\n"));
        if !driven.contains("damping") {
            folder.write("varied.csv", format!("{names},a\n{half},1\n{half},2\n"));
        }
        for (rows, command) in [("rows.csv", "other.toml --t0 2"), ("varied.csv", "file.toml")] {
            if !folder.has(rows) {
                continue;
            }
            let command =
                format!("ensemble {command} --initial {rows} --time 2 --restart --out ends.csv");
            let said = folder.json(&format!("{command} --estimate 1"));
            let estimate = &said["estimated_error"]["largest"];
            assert!(estimate.as_f64().is_none_or(|error| error < 0.01), "{driven}: {said}");
            let ends = folder.table("ends.csv");
            let end: Vec<f64> = ends[1][..12].iter().map(|cell| cell.parse().unwrap()).collect();
            close(&command, &end, &whole);
            folder.run(&format!("{} --at 3.05,4", command.replace("ends.csv", "ends.npy"))).ok();
            assert_eq!(folder.bytes("ends.npy").len() % 8, 0);
            let kept = folder.bytes("ends.npy");
            let width = ends[0].len();
            let data = &kept[kept.len() - 8 * width * 2 * (ends.len() - 1)..];
            let first: Vec<f64> = data[..96]
                .chunks(8)
                .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
                .collect();
            let right: Vec<f64> =
                recorded[2][1..13].iter().map(|cell| cell.parse().unwrap()).collect();
            close("a state on the way", &first, &right);
        }
    }
}

/// H = cos(t) z turns the momentum (1, 2, 3) by the angle sin t₀ − sin t: x + iy = (1 + 2i) exp(−i (sin t − sin t₀)).
const TURN: &str = "group = 'SO3'\ncoordinates = 'x y z'\nhamiltonian = 'cos(t)*z + 0*x^2'\n\
                    [integrator]\nstep = 0.1\n[initial]\ntime = 5\nmomentum = [1, 2, 3]\n[run]\ntime = 2\n";

#[test]
fn everything_said_of_a_run_is_of_its_own_time() {
    let folder = Folder::with(TURN);
    let right = |time: f64| {
        let (sin, cos) = (time.sin() - 5.0_f64.sin()).sin_cos();
        [cos + 2.0 * sin, 2.0 * cos - sin, 3.0]
    };
    let report = folder.json("simulate system.toml --out run.csv --every 5");
    assert!(distance(&numbers(&report["momentum"]), &right(7.0)) < 1e-12, "{report}");
    assert_eq!(report["time"], 7.0);
    let table = folder.table("run.csv");
    let times: Vec<f64> = table[1..].iter().map(|row| row[0].parse().unwrap()).collect();
    assert!(distance(&times, &[5.0, 5.5, 6.0, 6.5, 7.0]) < 1e-15, "{times:?}");
    let text = folder.run("simulate system.toml").ok();
    text.prints(&["20 steps from time 5 to time 7"]);
    // Events are of it, and runs end there.
    let until = folder.json("simulate system.toml --until t-6.25");
    assert!((until["time"].as_f64().unwrap() - 6.25).abs() < 1e-12);
    assert!(distance(&numbers(&until["momentum"]), &right(6.25)) < 1e-12);
    // The judge takes it from the head of the file, and convicts a run of another time.
    folder.run("verify run.csv").ok().prints(&["no row is wrong"]);
    folder.run("simulate system.toml --at 5.55,7 --out near.csv").ok();
    folder.run("verify near.csv").ok().prints(&["no row is wrong"]);
    folder.write("report.json", report.to_string());
    folder.run("verify report.json").ok().prints(&["no row is wrong"]);
    let other = report.to_string().replace("\"initial_time\":5.0", "\"initial_time\":4.5");
    folder.write("other.json", other.replace("\"steps\":20", "\"steps\":25"));
    folder.run("verify other.json").fails(1, &["momentum is off"]);
    // Rows of an ensemble say nothing of it.
    folder.write("rows.csv", "mu_1,mu_2,mu_3\n1,2,3\n");
    folder
        .run("ensemble system.toml --initial rows.csv --out ends.csv")
        .ok()
        .prints(&["from time 5"]);
    let verify = "verify system.toml ends.csv --input rows.csv --steps 20 --step 0.1";
    folder.run(verify).ok().prints(&["no row is wrong"]);
    folder.run(&format!("{verify} --t0 5")).ok();
    folder.run(&format!("{verify} --t0 4")).fails(1, &["momentum is off"]);
    // A checkpoint goes on at the same time alone, and inputs must reach all of the run.
    folder.run("simulate system.toml --out c.csv --checkpoint c.state").ok();
    folder.run("simulate system.toml --out c.csv --checkpoint c.state").ok();
    let other = "simulate system.toml --out c.csv --checkpoint c.state --t0 0";
    folder.run(other).fails(2, &["another initial_time: 5 then, nothing now"]);
    let inputs = TURN.replace("cos(t)", "u") + "[inputs]\ntimes = [5.5, 6, 7]\nu = [0, 1, 2]\n";
    folder.write("inputs.toml", inputs.replace("'u*z + 0*x^2'", "'u*z + x^2'"));
    folder.run("simulate inputs.toml").fails(2, &["from time 5.5 to 7, and the run from 5 to 7"]);
    folder.run("simulate inputs.toml --t0 5.5 --time 1.5").ok();
    folder.refused(&[
        ("simulate system.toml --at 4 --out a.csv", "4 is not between 5 and the end, 7"),
        ("simulate system.toml --t0 inf", "--t0 must be finite"),
        ("simulate system.toml --t0 1e17", "farther apart than the steps"),
    ]);
}

/// A pulse at 6 is seen by the laws and by the choice of a step of runs that start shortly before it alone.
#[test]
fn a_tolerance_and_the_laws_look_at_the_time_of_the_run() {
    let pulse =
        TURN.replace("cos(t)*z + 0*x^2", "x^2/3 + y^2/4 + z^2/5 + 4*x*exp(-((t - 6)/0.1)^2)");
    let folder = Folder::with(&pulse.replace("step = 0.1", ""));
    let end = |options: &str| {
        numbers(&folder.json(&format!("simulate system.toml {options}"))["momentum"])
    };
    let (found, right) = (end("--tolerance 1e-7"), end("--step 0.002"));
    assert!(distance(&found, &right) < 1e-6, "{found:?} {right:?}");
    // With the pulse in its first step the motion is unlike the free one.
    let order = |options: &str| {
        let laws = folder.json(&format!("check system.toml --points 1 --step 0.01 {options}"));
        let laws = laws["laws"].as_array().unwrap().clone();
        laws.iter().find(|law| law["name"] == "order").unwrap()["value"].as_f64().unwrap()
    };
    assert!((order("--t0 5.9") - order("--t0 20")).abs() > 1e-6);
}
