//! `simulate` with a potential: the reference of the satellite, what is conserved, mistakes.

use std::f64::consts::TAU;

use crate::smooth_examples::{cross, runge_kutta};
use crate::support::{Folder, distance, json, numbers, text_of};
use serde_json::Value;

const SATELLITE: &str = "examples/satellite.toml";

/// The largest difference from tests/reference/satellite.json, made by make_references.py beside it.
fn error(step: &str) -> (f64, Value) {
    let reference: Value =
        serde_json::from_str(&text_of("tests/reference/satellite.json")).unwrap();
    let report = json(&format!("simulate {SATELLITE} --time 20 --step {step} --every 1000"));
    let number = |value: &Value| value.as_str().unwrap().parse::<f64>().unwrap();
    let mut worst = 0.0_f64;
    let mut compare = |found: &Value, expected: &Value| {
        worst = worst.max((found.as_f64().unwrap() - number(expected)).abs());
    };
    for i in 0..4 {
        compare(&report["momentum"][i], &reference["momentum"][i]);
    }
    for i in 0..3 {
        for j in 0..3 {
            compare(&report["group_element"][i][j], &reference["attitude"][i][j]);
        }
    }
    for i in 0..2 {
        compare(&report["group_element"][3 + i][3], &reference["orbit"][i]);
    }
    (worst, report)
}

/// Order 6 to the reference, and to 1e-11 where the steps are small.
#[test]
fn the_satellite_reaches_its_reference() {
    let (coarse, _) = error("0.2");
    let (fine, _) = error("0.1");
    let order = (coarse / fine).log2();
    assert!((order - 6.0).abs() < 0.6, "{coarse:e} {fine:e}: order {order:.2}");
    let (finest, report) = error("0.0125");
    assert!(finest < 1e-11, "{finest:e}");
    // Turning attitude and orbit together is the one symmetry left; no Casimir is.
    assert_eq!(report["conserved_momenta"], 1);
    assert_eq!(report["conserved_casimirs"], 0);
    assert!(report["drift"]["casimirs"].is_null());
    assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13);
    assert!(report["drift"]["energy"].as_f64().unwrap() < 1e-11);
}

#[test]
fn the_laws_hold_with_kicks() {
    let report = json(&format!("check {SATELLITE} --points 1"));
    let laws = report["laws"].as_array().unwrap();
    assert!(laws.iter().all(|law| law["pass"] == true), "{report}");
    let law = |name: &str| laws.iter().find(|law| law["name"] == name).unwrap();
    assert!(law("symplectic+V")["value"].as_f64().unwrap() < 1e-9);
    assert!((law("order+V")["value"].as_f64().unwrap() - 6.0).abs() < 0.3, "{report}");
}

#[test]
fn a_broken_symmetry_is_said_and_not_measured() {
    let folder = Folder::with(
        r#"
group = "SO3"
hamiltonian = "mu[0]^2/2 + mu[1]^2/3 + mu[2]^2/4"
potential = "g[2][2] + a*g[0][1]"
[parameters]
a = 0.5
[integrator]
step = 0.05
[initial]
momentum = [0.3, 0.2, 0.1]
[run]
time = 2.0
"#,
    );
    folder.run("simulate system.toml").ok().prints(&[
        "rkn4",
        "not conserved: the potential breaks the symmetry",
        "none that the force keeps",
    ]);
    assert!(folder.json("simulate system.toml")["drift"]["spatial_momentum"].is_null());
    folder.run("emit system.toml").ok().prints(&["SystemPotential", "pub fn torque"]);
}

/// Each row is kicked as `simulate` kicks its state; a row that cannot be moved stops alone.
#[test]
fn ensembles_take_potentials() {
    let folder = Folder::with(
        r#"
group = "SO3"
hamiltonian = "mu[0]^2/2 + mu[1]^2/3 + mu[2]^2/4"
potential = "g[2][2] + 0.5*g[2][0]"
[integrator]
step = 0.05
[initial]
momentum = [0.3, 0.2, 0.1]
[run]
time = 2.0
"#,
    );
    folder.write("in.csv", "mu_1,mu_2,mu_3\n0.3,0.2,0.1\n1e3,2e3,3e3\n0.3,0.2,0.1\n");
    for backend in ["interpreter", "auto"] {
        let report = folder.json(&format!(
            "ensemble system.toml --initial in.csv --out out.csv --backend {backend} --restart"
        ));
        assert_eq!(report["failed"], 1, "{report}");
        // The vertical component of the spatial momentum stays; no Casimir does.
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13, "{report}");
        assert!(report["drift"]["casimirs"].is_null(), "{report}");
        let ends = folder.table("out.csv");
        let single = folder.json("simulate system.toml");
        for row in [1, 3] {
            let end: Vec<f64> = ends[row].iter().map(|cell| cell.parse().unwrap()).collect();
            assert!(distance(&end, &numbers(&single["momentum"])) < 1e-12, "{end:?}");
        }
    }
}

#[test]
fn mistakes_have_their_places() {
    for (potential, splitting, hamiltonian, place, message) in [
        ("g[0][3]", "rkn4", "mu[0]^2", ":3:14", "index 3 of `g[0]` is out of range"),
        ("abs(g[0][0])", "rkn4", "mu[0]^2", ":3:14", "has a kink: the potential must be smooth"),
        ("2", "rkn4", "mu[0]^2", ":3:13", "does not depend on the group element"),
        ("g[2][2]", "rkn5", "mu[0]^2", ":6:13", "did you mean `rkn4`"),
        ("g[2][2]", "rkn6", "mu[0]^4", ":6:13", "degree at most two"),
        ("", "strang", "mu[0]^2", ":5:13", "there is none"),
    ] {
        let potential =
            if potential.is_empty() { "" } else { &format!("potential = \"{potential}\"\n") };
        let folder = Folder::with(&format!(
            "group = \"SO3\"\nhamiltonian = \"{hamiltonian}\"\n{potential}[integrator]\nstep = 0.1\n\
             splitting = \"{splitting}\"\n[initial]\nmomentum = [1, 0, 0]\n[run]\ntime = 1\n"
        ));
        folder.run("simulate system.toml").fails(2, &[place, message]);
    }
}

/// A potential that is a polynomial, written as one and as functions, moves a state alike, and the same is conserved.
#[test]
fn potentials_are_any_functions() {
    let report = |potential: &str| {
        let folder = Folder::with(&format!(
            "group = \"SE3\"\nhamiltonian = \"mu[0]^2/2 + mu[1]^2/3 + mu[2]^2/4 + (mu[3]^2 + mu[4]^2 + mu[5]^2)/2\"\n\
             potential = \"{potential}\"\n[parameters]\nk = 0.7\n[integrator]\nstep = 0.05\n[initial]\n\
             momentum = [0.3, 0.2, 0.1, 0.4, -0.2, 0.6]\n[run]\ntime = 3\n"
        ));
        folder.json("simulate system.toml")
    };
    let square = "(1 + g[0][3]^2 + g[1][3]^2 + g[2][3]^2)";
    let one = report(&format!("k*{square}"));
    let other = report(&format!("sqrt(k)*sqrt(k*{square}^2)"));
    let apart = distance(&numbers(&one["momentum"]), &numbers(&other["momentum"]));
    assert!(apart < 1e-13, "{apart:e}");
    // Turning about the centre of the force, and the angle between Π and p.
    for name in ["conserved_momenta", "conserved_casimirs"] {
        assert_eq!(one[name], other[name], "{one} {other}");
    }
    assert_eq!(other["conserved_momenta"], 3);
    for name in ["spatial_momentum", "energy"] {
        let drift = other["drift"][name].as_f64().unwrap();
        assert!(drift < if name == "energy" { 1e-6 } else { 1e-13 }, "{name} {drift:e}");
    }
}

/// The momentum and the rows of the group element at the end of a run, and its report.
fn end(report: &Value) -> Vec<f64> {
    let rows = report["group_element_blocks"][0]["matrix"].as_array().unwrap();
    [numbers(&report["momentum"]), rows.iter().flat_map(numbers).collect()].concat()
}

/// A body whose energy has a root, in a potential: `more` stands before the tables, `split` in that of the integrator.
fn root_body(more: &str, split: &str) -> Folder {
    Folder::with(&format!(
        "group = \"SO3\"\ncoordinates = \"x y z\"\n{more}\n[parameters]\nw = 1.3\n[integrator]\ntruncation = 7\nstep = 0.1\n\
         {split}\n[initial]\nmomentum = [0.6, -0.4, 1.0]\n[run]\ntime = 2\n"
    ))
}

const ROOT: &str = "hamiltonian = \"sqrt(1 + x^2/1.5 + y^2/2 + z^2/2.5)\"\npotential = \"w*(g[2][2] + g[2][0]^2/3)\"";

/// μ' = μ × ω + r × ∇V and r' = r × ω with the last row r of g, of a body with a root, and of one that time and a table move: the order is that of the splitting, and what the potential leaves is kept.
#[test]
fn any_hamiltonian_is_kicked_as_its_own_equations_say() {
    let u = |t: f64| 1.0 + t * t;
    let driven = "hamiltonian = \"sqrt(1 + x^2/1.5 + y^2/2 + z^2/2.5) + 0.3*u*x*cos(t)\"\n\
        potential = \"w*(g[2][2] + g[2][0]^2/3)\"\n\
        [inputs]\ntimes = [0, 1, 2]\nu = [1, 2, 5]";
    for (text, moves) in [(ROOT, 0.0), (driven, 1.0)] {
        let start = [0.6, -0.4, 1.0, 0.0, 0.0, 1.0];
        let expected = runge_kutta(start, (2.0, 40_000), |t, state| {
            let (mu, r) = (&state[..3], &state[3..]);
            let energy =
                (1.0 + mu[0].powi(2) / 1.5 + mu[1].powi(2) / 2.0 + mu[2].powi(2) / 2.5).sqrt();
            let mut omega: [f64; 3] = std::array::from_fn(|i| mu[i] / [1.5, 2.0, 2.5][i] / energy);
            omega[0] += moves * 0.3 * u(t) * t.cos();
            let torque = cross(r, &[1.3 * 2.0 / 3.0 * r[0], 0.0, 1.3]);
            let (own, turned) = (cross(mu, &omega), cross(r, &omega));
            std::array::from_fn(|i| match i {
                0..3 => own[i] + torque[i],
                _ => turned[i - 3],
            })
        });
        for (splitting, order, step, bound) in
            [("strang", 2.0, 0.1, 1e-3), ("prk4", 4.0, 0.2, 1e-6), ("prk6", 6.0, 0.4, 1e-9)]
        {
            let folder = root_body(text, &format!("splitting = \"{splitting}\""));
            let run = |step: f64| {
                let report = folder.json(&format!("simulate system.toml --step {step}"));
                let found = end(&report);
                (distance(&[&found[..3], &found[9..]].concat(), &expected), report)
            };
            let ([coarse, fine], report) = ([run(step).0, run(step / 2.0).0], run(step / 2.0).1);
            let found = (coarse / fine).log2();
            assert!(
                fine < bound && (found - order).abs() < 0.4,
                "{text}: {coarse:e} {fine:e} {found}"
            );
            assert_eq!(report["method"], format!("collocation, 4 nodes, {splitting}"));
            let drift = |name: &str| report["drift"][name].as_f64();
            assert_eq!((&report["conserved_momenta"], drift("casimirs")), (&1.into(), None));
            assert!(drift("spatial_momentum").unwrap() < 1e-13, "{report}");
            let energy = drift("energy");
            assert!(energy.is_none_or(|drift| drift < bound), "{report}");
            assert_eq!(energy.is_none(), moves > 0.0, "{report}");
        }
    }
}

/// The laws and the kicks that a series has, through the same doors.
#[test]
fn kicks_of_any_hamiltonian_pass_every_door() {
    let folder = root_body(ROOT, "");
    let laws = folder.json("check system.toml --points 2 --truncation 3");
    let laws = laws["laws"].as_array().unwrap();
    assert!(laws.iter().all(|law| law["pass"] == true), "{laws:?}");
    let value = |name: &str| laws.iter().find(|law| law["name"] == name).unwrap()["value"].as_f64();
    assert!(value("symplectic+V").unwrap() < 1e-9 && value("symmetric+V").unwrap() < 1e-11);
    assert!((value("order+V").unwrap() - 4.0).abs() < 0.3, "{laws:?}");
    assert!((value("order").unwrap() - 4.0).abs() < 0.3, "{laws:?}");
    let rows = |backend: &str| {
        folder.run(&format!("simulate system.toml --backend {backend} --out {backend}.csv")).ok();
        folder.text(&format!("{backend}.csv"))
    };
    let by_interpreter = rows("interpreter");
    assert!(by_interpreter.contains("splitting"));
    if cfg!(unix) {
        assert_eq!(by_interpreter, rows("c"));
    }
    let single = |w: f64| {
        let system = folder.text("system.toml").replace("w = 1.3", &format!("w = {w}"));
        numbers(&Folder::with(&system).json("simulate system.toml")["momentum"])
    };
    // Rows side by side, and rows each with its own parameters.
    folder.write("in.csv", "mu_1,mu_2,mu_3\n0.6,-0.4,1\n1e4,2e4,3e4\n");
    folder.write("varied.csv", "mu_1,mu_2,mu_3,w\n0.6,-0.4,1,1.3\n0.6,-0.4,1,0.4\n");
    for (given, failed, parameters) in [("in", 0, &[1.3][..]), ("varied", 0, &[1.3, 0.4])] {
        let run = format!("ensemble system.toml --initial {given}.csv --out {given}_out.csv");
        let report = folder.json(&run);
        assert_eq!(report["failed"], failed, "{report}");
        for (row, &w) in folder.table(&format!("{given}_out.csv"))[1..].iter().zip(parameters) {
            let row: Vec<f64> = row[..3].iter().map(|x| x.parse().unwrap()).collect();
            assert!(distance(&row, &single(w)) < 1e-12, "{row:?} {w}");
        }
    }
    for (language, word) in [
        ("c", "Splitting: prk4"),
        ("opencl", "collocation, 4 nodes, prk4"),
        ("rust", "SystemPotential"),
    ] {
        folder.run(&format!("emit system.toml --language {language}")).ok().prints(&[word]);
    }
    folder.run("simulate system.toml --tolerance 1e-6").fails(2, &["the kicks of a potential"]);
    let pole = ROOT.replace("g[2][0]^2/3", "ln(g[2][2] - 2)");
    let left = root_body(&pole, "").run("simulate system.toml");
    left.fails(1, &["is not defined at time 0: ln(g[2][2] - 2) of -1"]);
    // A quadratic energy may be moved by collocation, and takes the splittings that it allows.
    let method = "method = \"collocation\"\nsplitting = \"rkn6\"";
    let quadratic =
        ROOT.replace("sqrt(1 + x^2/1.5 + y^2/2 + z^2/2.5)", "x^2/1.5 + y^2/2 + z^2/2.5");
    let by = |method: &str| end(&root_body(&quadratic, method).json("simulate system.toml"));
    assert!(distance(&by(method), &by("splitting = \"rkn6\"")) < 1e-9);
    let left = root_body(ROOT, "splitting = \"rkn4\"").run("simulate system.toml");
    left.fails(2, &["of degree at most two"]);
}

/// The inverse distance from the charge at the angle in the orbit by A. Sommerfeld's formula, whatever the turns.
#[test]
fn an_orbit_near_the_speed_of_light_is_the_ellipse_of_sommerfeld() {
    let (energy, spin, k) = (1.81_f64.sqrt() - 0.5, 0.9, 0.5);
    let (middle, factor) =
        (k * energy / (spin * spin - k * k), (1.0 - k * k / (spin * spin)).sqrt());
    let error = |step: f64| {
        let report = json(&format!("simulate examples/relativistic_orbit.toml --step {step}"));
        assert_eq!(report["conserved_momenta"], 3);
        let drift = |name: &str| report["drift"][name].as_f64().unwrap();
        assert!(drift("spatial_momentum") < 1e-13 && drift("energy") < 1e-8, "{report}");
        let end = end(&report);
        let (x, y) = (end[9], end[13]);
        let angles = (0..12).map(|turns| y.atan2(x) + TAU * f64::from(turns));
        let inverse = angles.map(|angle| middle + (1.0 - middle) * (factor * angle).cos());
        inverse.map(|inverse| (inverse - 1.0 / x.hypot(y)).abs()).fold(f64::INFINITY, f64::min)
    };
    let [coarse, fine] = [error(0.2), error(0.1)];
    assert!(fine < 1e-10 && ((coarse / fine).log2() - 6.0).abs() < 0.2, "{coarse:e} {fine:e}");
}
