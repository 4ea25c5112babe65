//! Runs of Hamiltonians that are no polynomials, by collocation.

use std::path::Path;

use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::smooth::Functions;
use coadjoint_codegen::system::Options;
use coadjoint_run::simulate::{Schedule, Setup, run};
use coadjoint_run::{Accuracy, Derived, read_given};
use serde_json::{Value, json};

use crate::support::{Folder, distance, numbers};

const FAST_BODY: &str = r#"
name = "fast-body"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "sqrt(1 + x^2/I1 + y^2/2 + z^2/2.5)"
[parameters]
I1 = 1.5
[integrator]
truncation = 7
step = 0.2
[initial]
momentum = [2.0, 0.5, 1.0]
[run]
time = 200.0
"#;

fn report_of(folder: &Folder, options: &str) -> Value {
    folder.json(&format!("simulate system.toml {options}"))
}

#[test]
fn momentum_casimirs_and_energy_are_kept() {
    let folder = Folder::with(FAST_BODY);
    let report = report_of(&folder, "--out rows.csv");
    assert_eq!(report["method"], "collocation, 4 nodes");
    assert_eq!(report["steps"], 1000);
    let drift = |name: &str| report["drift"][name].as_f64().unwrap();
    assert!(drift("spatial_momentum") < 1e-13, "{report}");
    assert!(drift("casimirs") < 1e-13, "{report}");
    assert!(drift("energy") < 1e-11, "{report}");
    let energy = report["energy"]["start"].as_f64().unwrap();
    let expected = (1.0_f64 + 4.0 / 1.5 + 0.125 + 0.4).sqrt();
    assert!((energy - expected).abs() < 1e-15, "{energy}");
    assert_eq!(folder.text("rows.csv").lines().filter(|line| !line.starts_with('#')).count(), 1002);
}

/// Order 8: the error of half the step is about 2⁸ times as small.
#[test]
fn the_order_is_that_of_the_truncation() {
    let folder = Folder::with(FAST_BODY);
    let end = |step: f64| -> Vec<f64> {
        numbers(&report_of(&folder, &format!("--time 8 --step {step}"))["momentum"])
    };
    let exact = end(0.1);
    let order = (distance(&end(1.6), &exact) / distance(&end(0.8), &exact)).log2();
    assert!((order - 8.0).abs() < 1.0, "{order}");
}

#[test]
fn refusals_name_expression_argument_and_time() {
    let folder = Folder::with(&FAST_BODY.replace("sqrt(1 + x^2/I1", "x + ln(x - 3"));
    let expected = "at time 0: ln(x - 3 + y^2/2 + z^2/(5/2)) of -0.475";
    folder.run("simulate system.toml").fails(1, &[expected]);
    let chosen = FAST_BODY.replace("step = 0.2", "step = 0.2\nchart = \"cayley\"");
    let ran = Folder::with(&chosen).run("simulate system.toml");
    ran.fails(2, &["`chart` is one of a series"]);
    let folder = Folder::with(FAST_BODY);
    let expected = ["there is no series", "collocation", "`check` tries the laws"];
    folder.run("derive system.toml").fails(2, &expected);
    let driven = Folder::with(&breathing());
    let single = "emit system.toml --language cuda --precision single";
    driven.run(single).fails(2, &["depend on time", "use double precision"]);
}

/// The body whose mass moves in time.
fn breathing() -> String {
    FAST_BODY.replace("sqrt(1 + ", "sqrt(1 + sin(t)^2 + ")
}

/// Rows of an ensemble have their own times, and side by side the bits of runs of their own.
#[test]
fn rows_that_depend_on_time_are_runs() {
    let rows: Vec<[f64; 3]> = (0..11).map(|row| [2.0, 0.5 - 0.1 * f64::from(row), 1.0]).collect();
    let line = |[x, y, z]: &[f64; 3]| format!("{x},{y},{z}\n");
    let folder = Folder::with(&breathing());
    folder
        .write("in.csv", format!("mu_1,mu_2,mu_3\n{}", rows.iter().map(line).collect::<String>()));
    folder.run("ensemble system.toml --initial in.csv --out out.csv --time 20").ok();
    for (found, start) in folder.text("out.csv").lines().skip(1).zip(rows) {
        let found: Vec<f64> = found.split(',').take(3).map(|cell| cell.parse().unwrap()).collect();
        let system = breathing().replace("[2.0, 0.5, 1.0]", &format!("{start:?}"));
        let alone = numbers(&report_of(&Folder::with(&system), "--time 20")["momentum"]);
        assert_eq!(found, alone, "{start:?}");
    }
    let text = folder.run("emit --language opencl system.toml").ok().out;
    assert!(text.contains("times[0] = fma(0.0, "), "{text}");
    let header = folder.run("emit --language c system.toml").ok().out;
    assert!(header.contains("_step(&map, &state, time);"), "{header}");
}

/// The programs of a step are those of all targets: with the same bits by the interpreter and by machine code, and as texts.
#[test]
fn steps_are_programs_for_every_target() {
    let folder = Folder::with(FAST_BODY);
    let run = |backend: &str| {
        folder.run(&format!("simulate system.toml --backend {backend} --out {backend}.csv")).ok();
        folder.text(&format!("{backend}.csv"))
    };
    let by_interpreter = run("interpreter");
    assert!(by_interpreter.lines().count() > 100);
    if cfg!(unix) {
        assert_eq!(by_interpreter, run("c"));
    }
    let header = folder.run("emit --language c system.toml").ok().out;
    assert!(header.contains("Collocation at 4 nodes"), "{header}");
    let text = folder.run("emit --language opencl system.toml").ok().out;
    assert!(text.contains("collocation, 4 nodes, step 0.2."), "{text}");
}

/// Rows are runs of their own: with the parameters of their columns, whatever the threads, and whatever becomes of others.
#[test]
fn rows_of_an_ensemble_are_runs() {
    let folder = Folder::with(FAST_BODY);
    let rows = [([2.0, 0.5, 1.0], 1.5), ([1.0, 0.2, 0.3], 1.2), ([-1.0, 0.5, 2.0], 3.0)];
    let line = |([x, y, z], inertia): &([f64; 3], f64)| format!("{x},{y},{z},{inertia}\n");
    let given: String = rows.iter().map(line).collect();
    folder.write("in.csv", format!("mu_1,mu_2,mu_3,I1\n{given}1,1,1,0\n"));
    let ensemble = |out: &str, more: &str| {
        let command = format!("ensemble system.toml --initial in.csv --out {out} --time 20 {more}");
        folder.run(&command).ok().out
    };
    let report = ensemble("one.csv", "--threads 1 --estimate 3 --format json");
    let report: Value = serde_json::from_str(&report).unwrap();
    assert_eq!((&report["method"], &report["failed"]), (&json!("collocation, 4 nodes"), &json!(1)));
    assert!(report["estimated_error"]["largest"].as_f64().unwrap() < 1e-12, "{report}");
    assert!(report["drift"]["casimirs"].as_f64().unwrap() < 1e-13, "{report}");
    ensemble("three.csv", "--threads 3");
    assert_eq!(folder.text("one.csv"), folder.text("three.csv"));
    let found = folder.text("one.csv");
    for (found, (start, inertia)) in found.lines().skip(1).zip(rows) {
        let found: Vec<f64> = found.split(',').take(3).map(|cell| cell.parse().unwrap()).collect();
        let system = FAST_BODY.replace("I1 = 1.5", &format!("I1 = {inertia}"));
        let system = system.replace("[2.0, 0.5, 1.0]", &format!("{start:?}"));
        let alone = numbers(&report_of(&Folder::with(&system), "--time 20")["momentum"]);
        let apart = distance(&found, &alone);
        assert!(apart < 1e-13, "{inertia}: {apart:e}");
    }
}

#[test]
fn laws_hold_and_can_be_broken_by_long_steps() {
    let six = FAST_BODY
        .replace("SO3", "SE3")
        .replace(
            "coordinates = [\"x\", \"y\", \"z\"]",
            "coordinates = [\"x\", \"y\", \"z\", \"p\", \"q\", \"r\"]",
        )
        .replace("z^2/2.5)", "z^2/2.5) + 1/sqrt(2 + p^2 + q^2) + exp(-r^2)")
        .replace("[2.0, 0.5, 1.0]", "[0.4, -0.5, 1.1, 0.3, 0.2, -0.9]");
    let folder = Folder::with(&six);
    let found = folder.json("check system.toml");
    let laws = found["laws"].as_array().unwrap();
    assert_eq!(laws.len(), 8, "{found}");
    assert!(laws.iter().all(|law| law["pass"] == true), "{found}");
    folder.run("check system.toml --step 30").fails(1, &["step"]);
}

/// The choice meets its tolerance against a run of far smaller steps, and takes more nodes for more digits.
#[test]
fn a_tolerance_chooses_nodes_and_step() {
    let folder = Folder::with(&FAST_BODY.replace("truncation = 7\nstep = 0.2\n", ""));
    let end = |options: &str| -> (u64, Vec<f64>) {
        let report = report_of(&folder, &format!("--time 40 {options}"));
        (report["truncation"].as_u64().unwrap(), numbers(&report["momentum"]))
    };
    let (_, exact) = end("--step 0.05 --truncation 13");
    let mut before = 0;
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let (truncation, found) = end(&format!("--tolerance {tolerance:e}"));
        let apart = distance(&found, &exact);
        assert!(apart < 2.3 * tolerance, "{tolerance}: {apart:e}");
        assert!(truncation >= before, "{tolerance}: K = {truncation} after {before}");
        before = truncation;
    }
    assert!(before > 3);
}

/// A polynomial by its series and by collocation: the same motion to the error of both, other steps.
#[test]
fn a_polynomial_takes_either_method() {
    let body = FAST_BODY
        .replace("sqrt(1 + x^2/I1 + y^2/2 + z^2/2.5)", "x^2/(2*I1) + y^2/4 + z^2/5")
        .replace("truncation = 7", "truncation = 11\nmethod = \"collocation\"");
    let folder = Folder::with(&body);
    let run = |options: &str| report_of(&folder, &format!("--time 20 {options}"));
    let (own, series) = (run(""), run("--method series"));
    assert_eq!(
        (&own["method"], &series["method"]),
        (&json!("collocation, 6 nodes"), &json!("K = 11, exp"))
    );
    let apart = distance(&numbers(&own["momentum"]), &numbers(&series["momentum"]));
    assert!(apart < 1e-12, "{apart:e}");
    let folder = Folder::with(&FAST_BODY.replace("step = 0.2", "step = 0.2\nmethod = \"series\""));
    let reasons = ["`sqrt` of the momentum is not a polynomial", "without `method = \"series\"`"];
    folder.run("simulate system.toml").fails(2, &reasons);
    folder.run("simulate system.toml --method collocation").ok();
}

/// A spin in a field that turns about the third axis.
const DRIVEN: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "B*(cos(w*t)*x + sin(w*t)*y) + C*z"
[parameters]
B = 0.8
C = 0.3
w = 1.7
[integrator]
step = 0.1
[initial]
momentum = [0.5, -0.3, 0.9]
[run]
time = 12.3
[[event]]
name = "flat"
when = "z - 1"
[[event]]
name = "late"
when = "t - 12.21"
"#;

/// μ of the spin at time t: in axes that turn with the field, which stands still there, it turns about B, 0, C + w.
fn driven(t: f64) -> [f64; 3] {
    let (b, w) = ([0.8, 0.0, 0.3 + 1.7], 1.7_f64);
    let rate = f64::hypot(b[0], b[2]);
    let (axis, start) = (b.map(|x| x / rate), [0.5, -0.3, 0.9]);
    // By Rodrigues' formula, backwards.
    let (sin, cos) = (-rate * t).sin_cos();
    let along: f64 = axis.iter().zip(start).map(|(a, x)| a * x).sum();
    let cross = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        axis[j] * start[k] - axis[k] * start[j]
    };
    let [x, y, z] =
        [0, 1, 2].map(|i| cos * start[i] + sin * cross(i) + (1.0 - cos) * along * axis[i]);
    let (sin, cos) = (w * t).sin_cos();
    [cos * x - sin * y, sin * x + cos * y, z]
}

#[test]
fn a_hamiltonian_that_moves_in_time_is_followed_at_its_own_times() {
    let folder = Folder::with(DRIVEN);
    let report = report_of(&folder, "--at 0.037,7.2,12.29 --out rows.csv");
    let close = |found: &[f64], time: f64, most: f64| {
        let error = distance(found, &driven(time));
        assert!(error < most, "{error:e} at {time}");
        error
    };
    close(&numbers(&report["momentum"]), 12.3, 1e-11);
    for row in &folder.table("rows.csv")[1..] {
        let row: Vec<f64> = row.iter().map(|x| x.parse().unwrap()).collect();
        close(&row[1..4], row[0], 1e-11);
    }
    let names = &folder.table("rows.csv")[0];
    assert!(names.iter().any(|name| name == "spatial_momentum_drift"), "{names:?}");
    assert!(!names.iter().any(|name| name.contains("energy")), "{names:?}");
    let events = report["events"].as_array().unwrap();
    assert!(events.len() > 3, "{report}");
    for event in events {
        let time = event["time"].as_f64().unwrap();
        match event["event"].as_str().unwrap() {
            "flat" => assert!((driven(time)[2] - 1.0).abs() < 1e-11, "{event}"),
            _ => assert!((time - 12.21).abs() < 1e-12, "{event}"),
        }
    }
    for name in ["spatial_momentum", "casimirs"] {
        assert!(report["drift"][name].as_f64().unwrap() < 1e-13, "{report}");
    }
    assert!(report["drift"]["energy"].is_null() && report["energy"].is_null(), "{report}");
    let text = folder.run("simulate system.toml --step 0.4").ok();
    text.prints(&["energy           not conserved: the Hamiltonian depends on time"]);
    // Rows of an ensemble, too.
    folder.write("in.csv", "mu_1,mu_2,mu_3\n0.5,-0.3,0.9\n");
    folder.write("rows.toml", DRIVEN.split("[[event]]").next().unwrap());
    let ensemble = "ensemble rows.toml --initial in.csv --at 0.037,7.2,12.29 --out rows.npy";
    folder.run(ensemble).ok();
    let bytes = std::fs::read(folder.path().join("rows.npy")).unwrap();
    let (cells, _) = bytes[bytes.len() - 9 * 8..].as_chunks::<8>();
    let cells: Vec<f64> = cells.iter().map(|cell| f64::from_le_bytes(*cell)).collect();
    for (row, time) in cells.chunks(3).zip([0.037, 7.2, 12.29]) {
        close(row, time, 1e-11);
    }
    // Of an odd number of steps too.
    for step in ["0.41", "0.4"] {
        let report = folder.json(&format!("simulate system.toml --step {step}"));
        let error = close(&numbers(&report["momentum"]), 12.3, 1e-5);
        let estimate = report["estimated_error"].as_f64().unwrap();
        assert!((0.2..5.0).contains(&(estimate / error)), "{estimate:e} {error:e}");
    }
}

/// Inputs that are polynomials of degree three and two, which the splines are then too.
const STEERED: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "u*z^2/2 + v*z"
[inputs]
times = [0, 1.2, 2, 3.5, 6]
u = [0.3, -0.0648, 0.3, 1.0875, -2.1]
v = [0.5, 0.596, 0.5, -0.025, -1.9]
[integrator]
truncation = 5
step = 0.1
[initial]
momentum = [0.5, -0.3, 0.9]
[run]
time = 6
"#;

#[test]
fn inputs_are_splines_and_end_with_their_table() {
    let folder = Folder::with(STEERED);
    let report = report_of(&folder, "");
    // The integral of z u + v, z = 0.9, by which μ turns backwards about the third axis.
    let (sin, cos) = (0.9 * 1.8 - 0.6_f64).sin_cos();
    let expected = [0.5 * cos - 0.3 * sin, -0.5 * sin - 0.3 * cos, 0.9];
    let error = distance(&numbers(&report["momentum"]), &expected);
    assert!(error < 1e-13, "{error:e}");
    assert!(report["drift"]["energy"].is_null(), "{report}");
    // Code has no inputs.
    folder.run("emit system.toml").fails(2, &["no code is written of a system with the input `u`"]);
    for run in ["simulate system.toml --time 8", "simulate system.toml --step=-0.1"] {
        let ran =
            folder.run(run).fails(2, &["the input `u` goes from time 0 to 6, and the run from"]);
        assert!(ran.out.is_empty());
    }
    let starts = "x,y,z\n0.5,-0.3,0.9\n";
    folder.write("starts.csv", starts);
    let ensemble = "ensemble system.toml --initial starts.csv --out rows.csv --time";
    folder.run(&format!("{ensemble} 7")).fails(2, &["to 6, and the run from 0 to 7"]);
    folder.run(&format!("{ensemble} 6")).ok();
}

/// The table of [`STEERED`].
const WHEELS: &str =
    "t,other,speed\n0,0.5,0.3\n1.2,0.596,-0.0648\n2,0.5,0.3\n3.5,-0.025,1.0875\n6,-1.9,-2.1\n";

/// A folder with [`STEERED`], its table a file.
fn steered_by_file() -> Folder {
    let (first, rest) = STEERED.split_once("times").unwrap();
    let (_, rest) = rest.split_once("[integrator]").unwrap();
    let columns = "table = \"wheels.csv\"\ntimes = \"t\"\nu = \"speed\"\nv = \"other\"";
    let folder = Folder::with(&format!("{first}{columns}\n[integrator]{rest}"));
    folder.write("wheels.csv", WHEELS);
    folder
}

/// Columns of a file that stands beside the system, wherever the command is called.
#[test]
fn tables_of_inputs_may_be_files() {
    let folder = steered_by_file();
    let (lines, write) = (WHEELS, |text: &str| folder.write("wheels.csv", text));
    let listed = report_of(&Folder::with(STEERED), "");
    assert_eq!(report_of(&folder, "")["momentum"], listed["momentum"]);
    for (given, instead, expected) in [
        ("3.5,-0.025", "3.5,wet", "wheels.csv: row 4, column other: `wet` is no finite number"),
        ("1.0875", "NaN", "wheels.csv: row 4, column speed: `NaN` is no finite number"),
        (
            "3.5,",
            "1.5,",
            "wheels.csv: row 4, column t: 1.5 must be after the time of the row before",
        ),
        ("speed", "spd", "wheels.csv: column speed is missing; there are t, other, spd"),
        (&lines[24..], "", "wheels.csv: an input has at least two times"),
    ] {
        write(&lines.replace(given, instead));
        folder.run("simulate system.toml").fails(2, &[expected]);
    }
    folder.remove("wheels.csv");
    folder.run("simulate system.toml").fails(2, &["`table` of [inputs]", "wheels.csv"]);
}

/// Functions in place of tables, which are called at the times of the nodes; where one has no value the step is refused.
#[test]
fn inputs_may_be_functions() {
    let expected = numbers(&report_of(&Folder::with(STEERED), "")["momentum"]);
    let (first, rest) = STEERED.split_once("[inputs]").unwrap();
    let text = format!("{first}[integrator]{}", rest.split_once("[integrator]").unwrap().1);
    let run_until = |end: f64| {
        // The polynomials by which the table was made.
        let u =
            move |t: f64| if t < end { 0.3 - t + 0.7 * t * t - 0.1 * t * t * t } else { f64::NAN };
        let u = Signal::of_function("u".to_owned(), u);
        let v = Signal::of_function("v".to_owned(), |t| 0.5 + 0.2 * t - 0.1 * t * t);
        let given = Functions { inputs: vec![u, v], ..Functions::default() };
        let system = read_given("system", &text, Options::default(), &[], &given)?;
        let schedule = Schedule::new(Path::new("system"), &Accuracy::default(), &system.run)?;
        let setup = Setup::new(schedule, system.run.momentum.clone().unwrap());
        run(&Derived::of(system)?, &setup, &mut ())
    };
    let found = run_until(f64::INFINITY).unwrap().momentum;
    assert!(distance(&found, &expected) < 1e-13, "{found:?}");
    let error = run_until(3.05).unwrap_err().to_string();
    assert!(error.starts_with("at time 3") && error.contains("step 31"), "{error}");
}

/// An event of the command line has the text read once more, with its inputs.
#[test]
fn runs_with_inputs_from_files_end_at_events() {
    let folder = steered_by_file();
    let ended = report_of(&folder, "--until x-0.4");
    let listed = report_of(&Folder::with(STEERED), "--until x-0.4");
    assert_eq!(ended["events"], listed["events"]);
    assert!(ended["events"].to_string().contains("time"), "{ended}");
    let advice = ["unknown variable `u`", "known here: x, y, z, g[0][0]", "g[2][2], t"];
    folder.run("simulate system.toml --until u-1").fails(2, &advice);
}

#[test]
fn tables_of_inputs_are_no_outputs() {
    let folder = steered_by_file();
    folder.write("starts.csv", "x,y,z\n0.5,-0.3,0.9\n");
    for run in [
        "simulate system.toml --out wheels.csv",
        "simulate system.toml --out rows.csv --checkpoint wheels.csv",
        "ensemble system.toml --initial starts.csv --out wheels.csv",
    ] {
        folder.run(run).fails(2, &["wheels.csv is the same file, which this run uses"]);
        assert_eq!(folder.text("wheels.csv"), WHEELS);
    }
}

/// Splines of a table have too few derivatives for the order of steps.
#[test]
fn laws_hold_with_inputs() {
    let check = Folder::with(STEERED).run("check system.toml").ok();
    check.prints(&["symplectic", "the order is not measured: the input `u`"]);
}

/// Rows whose torque depends on the time and on what it turns are those of runs.
#[test]
fn an_ensemble_has_the_kicks_of_a_run() {
    let system =
        STEERED.replace("hamiltonian = \"u*z^2/2 + v*z\"", "hamiltonian = \"x^2 + z^2/2\"");
    let torque = "coordinates = [\"x\", \"y\", \"z\"]\ntorque = [\"t*x + u\", \"g[0][1]\", \"v\"]";
    let folder = Folder::with(&system.replace("coordinates = [\"x\", \"y\", \"z\"]", torque));
    folder.write("starts.csv", "x,y,z\n0.5,-0.3,0.9\n");
    let expected = numbers(&report_of(&folder, "--time 2")["momentum"]);
    for backend in ["interpreter", "auto"] {
        let run = "ensemble system.toml --initial starts.csv --out rows.csv --restart --time 2";
        folder.run(&format!("{run} --backend {backend}")).ok();
        let row: Vec<f64> =
            folder.table("rows.csv")[1].iter().map(|cell| cell.parse().unwrap()).collect();
        assert!(distance(&row, &expected) < 1e-12, "{row:?} {expected:?}");
    }
}

#[test]
fn mistakes_about_inputs() {
    for (given, instead, expected) in [
        ("times = [0, 1.2, 2, 3.5, 6]", "", "`times` is missing in [inputs]"),
        (
            "times = [0, 1.2, 2, 3.5, 6]",
            "table = \"a.csv\"\ntimes = \"t\"",
            "`u` must be a text in quotes",
        ),
        ("2, 3.5, 6]", "2, 2, 6]", "entry 3 of the times, 2, must be finite and after"),
        ("times = [0, 1.2, 2, 3.5, 6]", "times = [0]", "`u` has 5 values for 1 times"),
        ("1.0875, -2.1]", "1.0875]", "`u` has 4 values for 5 times"),
        ("1.0875, -2.1]", "nan, -2.1]", "`nan` is not a number"),
        ("v = [0.5", "x = [0.5", "the name `x` is already taken by a coordinate"),
        (
            " + v*z",
            " + z",
            "the input `v` does not occur in the Hamiltonian, a velocity or a torque",
        ),
        (
            "u*z^2/2 + v*z",
            "z^2",
            "the input `u` does not occur in the Hamiltonian, a velocity or a torque",
        ),
        ("u*z^2/2", "u*w", "unknown variable `w`"),
    ] {
        let folder = Folder::with(&STEERED.replace(given, instead));
        let ran = folder.run("simulate system.toml").fails(2, &[expected]);
        assert!(ran.error.contains("system.toml:"), "{}", ran.error);
    }
}
