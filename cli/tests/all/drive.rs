//! Velocities and torques beside a Hamiltonian: the order of steps, and what needs more than a case (`drive_*.case`).

use coadjoint::Phase;
use coadjoint::collocation::{Collocation, DoubleBracket, Drive, Energy};
use coadjoint::groups::SO3;
use nalgebra::{UnitQuaternion, Vector3};
use serde_json::Value;

use crate::support::{Folder, distance, numbers, text_of};

/// The momentum and the entries of the group element at the end of a run.
fn end(report: &Value) -> Vec<f64> {
    let rows = report["group_element"].as_array().unwrap();
    [numbers(&report["momentum"]), rows.iter().flat_map(numbers).collect()].concat()
}

/// The order of runs from their errors at a step and at half of it.
fn order(error: impl Fn(f64) -> f64, step: f64) -> f64 {
    let [coarse, fine] = [error(step), error(step / 2.0)];
    assert!(fine > 0.0, "{coarse:e}");
    (coarse / fine).log2()
}

const BODY: &str =
    "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"x^2/2 + y^2/4 + z^2/6\"\n";

/// Groups of all kinds, with a velocity and a torque of all that they may read. The last algebra is not unimodular.
const DRIVEN: [(&str, usize); 6] = [
    ("group = \"SO3\"", 3),
    ("group = \"SE3\"", 6),
    ("group = \"SU3\"", 8),
    ("group = \"SL2\"", 3),
    ("group = \"SO3*SE2\"", 6),
    (
        "[algebra]\ngenerators = [\"e1\", \"e2\", \"e3\"]\nbrackets = [\"[e1, e3] = e1\", \"[e2, e3] = e1 + e2\"]",
        3,
    ),
];

fn driven(group: &str, dim: usize, acting: &str, k: usize) -> Folder {
    let (head, table) = match group.starts_with('[') {
        true => ("", group),
        false => (group, ""),
    };
    let terms: Vec<String> = (0..dim).map(|i| format!("mu[{i}]^2/{}", 3 + i)).collect();
    let start: Vec<String> = (0..dim).map(|i| format!("{}", 0.7 - 0.3 * (i % 4) as f64)).collect();
    Folder::with(&format!(
        "{head}\nhamiltonian = \"{} + mu[0]*mu[1]/7\"\n{acting}{table}\n[integrator]\nmethod = \"collocation\"\n\
         truncation = {k}\nstep = 0.1\n[initial]\nmomentum = [{}]\n[run]\ntime = 1.6\n",
        terms.join(" + "),
        start.join(", "),
    ))
}

/// Lists for a velocity and a torque.
fn acting(dim: usize, parts: [bool; 2]) -> String {
    let velocity =
        |i: usize| format!("\"0.2*mu[{}]*omega[{i}] + 0.1*sin(t)*g[0][1]\"", (i + 1) % dim);
    let torque = |i: usize| {
        format!("\"-0.2*sqrt(1 + mu[{i}]^2)*omega[{i}] + 0.3*cos(2*t)*g[1][0] - 0.1*g[1][1]\"")
    };
    let list = |of: &dyn Fn(usize) -> String| (0..dim).map(of).collect::<Vec<_>>().join(", ");
    let lines = [("velocity", list(&velocity)), ("torque", list(&torque))];
    let lines = lines.iter().zip(parts).filter(|(_, part)| *part);
    lines.map(|((key, list), _)| format!("{key} = [{list}]\n")).collect()
}

/// Steps at m nodes have the order 2m, with a velocity, a torque, and both, of time, g, μ and ω.
#[test]
fn the_order_is_that_of_the_nodes() {
    for (group, dim) in DRIVEN {
        for parts in [[true, false], [false, true], [true, true]] {
            let acting = acting(dim, parts);
            let at = |k: usize, step: f64| {
                let folder = driven(group, dim, &acting, k);
                end(&folder.json(&format!("simulate system.toml --no-estimate --step {step}")))
            };
            let exact = at(9, 0.1);
            for (k, step) in [(1, 0.1), (3, 0.2), (5, 0.4)] {
                let found = order(|step| distance(&at(k, step), &exact), step);
                let expected = (k + 1) as f64;
                assert!((found - expected).abs() < 0.5, "{group} {parts:?} K = {k}: {found}");
            }
        }
    }
}

/// Of a torque without a component along an axis in space, of a weight and an engine that pushes sideways, the momentum about that
/// axis stays, at any number of nodes.
#[test]
fn torques_keep_what_they_leave() {
    let torque = "torque = [\"0.8*g[2][1] + 0.2*cos(t)*g[0][0]\", \"-0.8*g[2][0] + 0.2*cos(t)*g[0][1]\", \"0.2*cos(t)*g[0][2]\"]\n";
    for k in [1, 3, 5, 7] {
        let folder = Folder::with(&format!(
            "{BODY}{torque}[integrator]\ntruncation = {k}\nstep = 0.1\n[initial]\nmomentum = [0.9, -0.5, 0.6]\n[run]\ntime = 100\n"
        ));
        let report = folder.json("simulate system.toml --no-estimate");
        let state = end(&report);
        let vertical: f64 = (0..3).map(|i| state[9 + i] * state[i]).sum();
        assert!((vertical - 0.6).abs() < 1e-13, "K = {k}: {vertical}");
    }
}

/// The closures of the library and a file make the same steps.
#[test]
fn files_and_closures_agree() {
    let inertia = Vector3::new(1.0, 2.0, 3.0);
    let energy = (
        move |_: f64, mu: &Vector3<f64>| 0.5 * mu.dot(&mu.component_div(&inertia)),
        move |_: f64, mu: &Vector3<f64>| mu.component_div(&inertia),
    );
    fn agrees(
        step: &mut Collocation<SO3, impl Energy<Vector3<f64>>, 4, impl Drive<SO3>>,
        drive: &str,
    ) {
        let mut phase = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
        step.advance_by(&mut phase, 0.0, 50).unwrap();
        let folder = Folder::with(&format!(
            "{BODY}{drive}[integrator]\nstep = 0.1\n[initial]\nmomentum = [2, 0.3, 0.1]\n[run]\ntime = 5\n"
        ));
        let found = numbers(&folder.json("simulate system.toml")["momentum"]);
        assert!(distance(&found, phase.momentum.as_slice()) < 1e-13, "{found:?} {phase:?}");
    }
    let damping = DoubleBracket::new(SO3::new(), Vector3::new(0.1, 0.2, 0.3)).unwrap();
    let mut step = Collocation::driven(SO3::new(), energy, damping, 0.1).unwrap();
    agrees(&mut step, "damping = [0.1, 0.2, 0.3]\n");
    let drive = |time: f64, g: &UnitQuaternion<f64>, mu: &Vector3<f64>, omega: &Vector3<f64>| {
        [0.2 * mu.cross(omega), 0.4 * time.cos() * (g.inverse() * Vector3::z()) - 0.1 * mu]
    };
    let mut step = Collocation::driven(SO3::new(), energy, drive, 0.1).unwrap();
    let torque = [0, 1, 2].map(|i| format!("0.4*cos(t)*g[2][{i}] - 0.1*mu[{i}]"));
    agrees(&mut step, &format!("damping = 0.2\ntorque = {torque:?}\n"));
}

#[test]
fn a_damped_body_ends_about_its_major_axis() {
    let folder = Folder::with(&text_of("examples/damped_body.toml"));
    let report = folder.json("simulate system.toml --out out.csv");
    let drift = |name: &str| report["drift"][name].as_f64();
    assert!(drift("spatial_momentum").unwrap() < 1e-12, "{report}");
    assert!(drift("casimirs").unwrap() < 1e-12, "{report}");
    assert!(drift("energy").is_none(), "{report}");
    let [size, mu] = [4.05_f64.sqrt(), numbers(&report["momentum"])[2].abs()];
    assert!((mu - size).abs() < 1e-6, "{report}");
    let table = folder.table("out.csv");
    let place = table[0].iter().position(|name| name == "energy").unwrap();
    let energies: Vec<f64> = table[1..].iter().map(|row| row[place].parse().unwrap()).collect();
    assert!(energies.len() > 2000 && energies.windows(2).all(|pair| pair[1] < pair[0]));
    assert!((energies[energies.len() - 1] - 4.05 / 6.0).abs() < 1e-6);
    folder.run("simulate system.toml").ok().prints(&["damped", "falls: damping acts"]);
}
