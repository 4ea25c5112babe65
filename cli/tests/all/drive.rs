//! Velocities and torques beside a Hamiltonian: their equations, their order, what they keep, and what is said of them.

use coadjoint::Phase;
use coadjoint::collocation::{Collocation, DoubleBracket};
use coadjoint::groups::SO3;
use nalgebra::Vector3;
use serde_json::Value;

use crate::smooth_examples::{cross, runge_kutta};
use crate::support::{Folder, distance, json, numbers, text_of};

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

/// End states of systems that users run, from closed forms and from DOP853 in extended precision: Gilbert damping of a macrospin (the
/// tangent of the half angle decays), the spin torque oscillator near its limit cycle, feedback of attitude and rate in a satellite's SI
/// units, detumbling by B-dot over half an orbit, a vehicle with a full matrix of added mass and drag on SE(3), a spin that relaxes.
#[test]
fn known_motions_are_met() {
    let body = "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\n";
    let field = |i: usize| {
        format!("(C*g[2][{i}] - S*g[0][{i}])")
            .replace('C', "(3/2*cos(2*n*t) - 1/2)")
            .replace('S', "3/2*sin(2*n*t)")
    };
    let along = format!("({}*omega[0] + {}*omega[1] + {}*omega[2])", field(0), field(1), field(2));
    let square = "(9/4*sin(2*n*t)^2 + (3/2*cos(2*n*t) - 1/2)^2)";
    let torquer =
        (0..3).map(|i| format!("\"-k*B0^2*({square}*omega[{i}] - {}*{along})\"", field(i)));
    let torquer = torquer.collect::<Vec<_>>().join(", ");
    for (example, right, bound) in [
        (
            "spin_torque_oscillator.toml --time 2000",
            &[-0.374284738, -0.836530280, 0.400160000][..],
            1e-9,
        ),
        (
            "attitude_feedback.toml",
            &[1.8973508647283311e-4, 1.9037143636106458e-4, -6.0928915882440405e-6][..],
            1e-11,
        ),
        (
            "underwater_vehicle.toml",
            &[0.38957124, -2.09562826, 5.94604406, -2.3438583, 2.06243666, 0.9682715][..],
            1e-8,
        ),
    ] {
        let report = json(&format!("simulate examples/{example}"));
        let apart = distance(&numbers(&report["momentum"]), right);
        assert!(apart < bound, "{example}: {apart:e} {report}");
    }
    for (text, start, step, time, right, bound) in [
        (
            format!(
                "{body}hamiltonian = \"z/(1 + al^2)\"\ndamping = \"al\"\n[parameters]\nal = 0.1\n"
            ),
            "momentum = [\"sin(2.5)\", 0, \"cos(2.5)\"]".to_owned(),
            0.1,
            30.0,
            vec![-0.004827577190758435, 0.03372970862820666, -0.9994193320395216],
            1e-13,
        ),
        (
            format!(
                "{body}hamiltonian = \"x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)\"\ntorque = [{torquer}]\n[parameters]\nI1 = 0.002\n\
                 I2 = 0.0022\nI3 = 0.0018\nB0 = 3e-5\nk = 5e3\nn = 0.0011\n"
            ),
            "angular_velocity = [0.5, -0.3, 0.4]".to_owned(),
            0.5,
            3000.0,
            vec![1.8147407861155024e-5, 7.2256788826357377e-5, -3.2698559610694428e-6],
            1e-13,
        ),
        (
            format!(
                "{body}hamiltonian = \"-(0.5*x + 0.3*z)\"\ntorque = [\"-x/T2\", \"-y/T2\", \"-(z - M0)/T1\"]\n[parameters]\n\
                 T1 = 8\nT2 = 3\nM0 = 1\n"
            ),
            "momentum = [0, 0, 1]".to_owned(),
            0.1,
            10.0,
            vec![0.1644321220, -0.1468854077, 0.2660426123],
            2e-10,
        ),
    ] {
        let folder = Folder::with(&format!(
            "{text}[integrator]\nstep = {step}\n[initial]\n{start}\n[run]\ntime = {time}\n"
        ));
        let report = folder.json("simulate system.toml");
        let apart = distance(&numbers(&report["momentum"]), &right);
        assert!(apart < bound, "{text}: {apart:e} {report}");
        let said = report["estimated_error"].as_f64().unwrap();
        assert!(said < 1e-6, "{text}: {report}");
    }
}

/// Groups of all kinds, with a velocity and a torque of all that they may read. The last algebra is not unimodular.
const DRIVEN: [(&str, &str, usize); 6] = [
    ("group = \"SO3\"", "1", 3),
    ("group = \"SE3\"", "1", 6),
    ("group = \"SU3\"", "1", 8),
    ("group = \"SL2\"", "1", 3),
    ("group = \"SO3*SE2\"", "1", 6),
    (
        "[algebra]\ngenerators = [\"e1\", \"e2\", \"e3\"]\nbrackets = [\"[e1, e3] = e1\", \"[e2, e3] = e1 + e2\"]",
        "1",
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
    for (group, _, dim) in DRIVEN {
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

/// A velocity, whatever it is, keeps Casimirs and the spatial momentum in 10⁵ steps; of a torque that has no component along an axis
/// in space the momentum about that stays, at any number of nodes.
#[test]
fn velocities_keep_orbits_and_torques_what_they_leave() {
    let velocity = "velocity = [\"0.1*sin(t) + 0.2*y*z\", \"0.3*g[2][0]\", \"-0.1*x\"]\n";
    let rest = |k: usize| {
        format!(
            "[integrator]\ntruncation = {k}\nstep = 0.1\n[initial]\nmomentum = [0.9, -0.5, 0.6]\n[run]\ntime = 10000\n"
        )
    };
    let folder = Folder::with(&format!("{BODY}{velocity}{}", rest(3)));
    let report = folder.json("simulate system.toml --no-estimate");
    for name in ["spatial_momentum", "casimirs"] {
        assert!(report["drift"][name].as_f64().unwrap() < 1e-12, "{report}");
    }
    assert!(report["drift"]["energy"].is_null(), "{report}");
    folder
        .run("simulate system.toml --time 10")
        .ok()
        .prints(&["energy           not conserved: a velocity acts beside the Hamiltonian"]);
    // The weight of a top, and an engine that pushes sideways in space.
    let torque = "torque = [\"0.8*g[2][1] + 0.2*cos(t)*g[0][0]\", \"-0.8*g[2][0] + 0.2*cos(t)*g[0][1]\", \"0.2*cos(t)*g[0][2]\"]\n";
    for k in [1, 3, 5, 7] {
        let folder = Folder::with(&format!("{BODY}{torque}{}", rest(k)));
        let report = folder.json("simulate system.toml --no-estimate --time 100");
        let state = end(&report);
        let vertical: f64 = (0..3).map(|i| state[9 + i] * state[i]).sum();
        assert!((vertical - 0.6).abs() < 1e-13, "K = {k}: {vertical}");
    }
}

/// Π' = Π × (ω + α Π × ω) and R' = R (ω + α Π × ω)^, with ω = (1 + s cos 3t) I⁻¹Π: the state is Π, then the columns of Rᵀ, each of
/// which turns as Π does.
#[test]
fn a_damped_body_moves_as_its_own_equations_say() {
    for strength in [0.0, 0.9] {
        let start = [0.6, -0.4, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let expected = runge_kutta(start, (3.0, 30_000), |t, state| {
            let factor = 1.0 + strength * (3.0 * t).cos();
            let omega: [f64; 3] = std::array::from_fn(|i| factor * state[i] / [1.0, 2.0, 3.0][i]);
            let lost = cross(&state[..3], &omega);
            let turn: [f64; 3] = std::array::from_fn(|i| omega[i] + 0.3 * lost[i]);
            std::array::from_fn(|i| cross(&state[i / 3 * 3..][..3], &turn)[i % 3])
        });
        let folder = Folder::with(&format!(
            "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"(1 + {strength}*cos(3*t))*(x^2/2 + y^2/4 + z^2/6)\"\n\
             damping = 0.3\n[integrator]\nstep = 0.1\n[initial]\nmomentum = [0.6, -0.4, 1.0]\n[run]\ntime = 3\n"
        ));
        let error = |k: usize, step: f64| {
            let run = format!("simulate system.toml --truncation {k} --step {step}");
            distance(&end(&folder.json(&run)), &expected)
        };
        let found = order(|step| error(3, step), 0.05);
        assert!((found - 4.0).abs() < 0.3, "{found}");
        assert!(error(7, 0.1) < 1e-9, "{:e}", error(7, 0.1));
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
    let damping = DoubleBracket::new(SO3::new(), Vector3::new(0.1, 0.2, 0.3)).unwrap();
    let mut step = Collocation::<_, _, 4, _>::driven(SO3::new(), energy, damping, 0.1).unwrap();
    let mut phase = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
    step.advance_by(&mut phase, 0.0, 200).unwrap();
    let folder = Folder::with(&format!(
        "{BODY}damping = [0.1, 0.2, 0.3]\n[integrator]\nstep = 0.1\n[initial]\nmomentum = [2, 0.3, 0.1]\n[run]\ntime = 20\n"
    ));
    let found = numbers(&folder.json("simulate system.toml")["momentum"]);
    assert!(distance(&found, phase.momentum.as_slice()) < 1e-13, "{found:?} {phase:?}");
    let drive =
        |time: f64, g: &nalgebra::UnitQuaternion<f64>, mu: &Vector3<f64>, omega: &Vector3<f64>| {
            let up = g.inverse() * Vector3::z();
            [0.2 * mu.cross(omega), 0.4 * time.cos() * up - 0.1 * mu]
        };
    let mut step = Collocation::<_, _, 4, _>::driven(SO3::new(), energy, drive, 0.1).unwrap();
    let mut phase = Phase::<SO3>::at_identity([2.0, 0.3, 0.1]);
    step.advance_by(&mut phase, 0.0, 50).unwrap();
    let folder = Folder::with(&format!(
        "{BODY}damping = 0.2\n\
         torque = [\"0.4*cos(t)*g[2][0] - 0.1*x\", \"0.4*cos(t)*g[2][1] - 0.1*y\", \"0.4*cos(t)*g[2][2] - 0.1*z\"]\n\
         [integrator]\nstep = 0.1\n[initial]\nmomentum = [2, 0.3, 0.1]\n[run]\ntime = 5\n"
    ));
    let found = numbers(&folder.json("simulate system.toml")["momentum"]);
    assert!(distance(&found, phase.momentum.as_slice()) < 1e-13, "{found:?} {phase:?}");
}

/// A velocity alone moves a state along its orbit: ġ = g η, the rates of a coning gyroscope.
#[test]
fn a_velocity_may_be_all_that_moves() {
    let folder = Folder::with(
        "group = \"SO3\"\nvelocity = [\"0.3*cos(2*t)\", \"0.3*sin(2*t)\", \"0.7\"]\n[integrator]\nstep = 0.1\n[initial]\n\
         momentum = [0, 0, 1]\n[run]\ntime = 3\n",
    );
    let start = [0.0, 0.0, 1.0];
    let expected = runge_kutta(start, (3.0, 30_000), |t, mu| {
        cross(mu, &[0.3 * (2.0 * t).cos(), 0.3 * (2.0 * t).sin(), 0.7])
    });
    let report = folder.json("simulate system.toml");
    let apart = distance(&numbers(&report["momentum"]), &expected);
    assert!(apart < 1e-11, "{apart:e} {report}");
    Folder::with(
        "group = \"SO3\"\ntorque = [\"1\", \"0\", \"0\"]\n[initial]\nmomentum = [0, 0, 1]\n",
    )
    .run("simulate system.toml")
    .fails(2, &["`hamiltonian` is missing"]);
}

/// Π' = Π × (ω + x) + τ and r' = r × (ω + x) with x = α (Π × ω + τ), τ = r × ∇V and the last row r of R; for H with and without
/// a root. The sum of both energies falls, and the momentum about the vertical stays. Without damping the same potential may act
/// within the step.
#[test]
fn a_potential_acts_within_the_step() {
    for (hamiltonian, root, damping) in
        [("H", 0.0, 0.2), ("sqrt(1 + 2*H)", 1.0, 0.2), ("sqrt(1 + 2*H)", 1.0, 0.0)]
    {
        let hamiltonian = hamiltonian.replace('H', "(x^2/2 + y^2/4 + z^2/6)");
        let key = if damping > 0.0 { "damping = 0.2\n" } else { "" };
        let folder = Folder::with(&format!(
            "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"{hamiltonian}\"\n\
             potential = \"1.3*(g[2][2] + g[2][0]^2/3)\"\n{key}[integrator]\nstep = 0.1\nsplitting = \"none\"\n\
             [initial]\nmomentum = [0.6, -0.4, 1.0]\n[run]\ntime = 3\n"
        ));
        let start = [0.6, -0.4, 1.0, 0.0, 0.0, 1.0];
        let expected = runge_kutta(start, (3.0, 30_000), |_, state| {
            let (mu, r) = (&state[..3], &state[3..]);
            let free: [f64; 3] = std::array::from_fn(|i| mu[i] / [1.0, 2.0, 3.0][i]);
            let twice: f64 = (0..3).map(|i| mu[i] * free[i]).sum();
            let omega = free.map(|own| own / (1.0 + root * twice).sqrt());
            let torque = cross(r, &[1.3 * 2.0 / 3.0 * r[0], 0.0, 1.3]);
            let own = cross(mu, &omega);
            let turn: [f64; 3] = std::array::from_fn(|i| omega[i] + damping * (own[i] + torque[i]));
            let (moved, turned) = (cross(mu, &turn), cross(r, &turn));
            std::array::from_fn(|i| if i < 3 { moved[i] + torque[i] } else { turned[i - 3] })
        });
        let report = folder.json("simulate system.toml");
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13, "{report}");
        let state = end(&report);
        let apart = distance(&[&state[..3], &state[9..]].concat(), &expected);
        assert!(apart < 1e-9, "{apart:e}");
        let energy = report["drift"]["energy"].as_f64();
        assert!(energy.is_none() == (damping > 0.0) && energy.is_none_or(|drift| drift < 1e-8));
        let report = folder.json("check system.toml");
        let laws = report["laws"].as_array().unwrap();
        let names: Vec<&str> = laws.iter().map(|law| law["name"].as_str().unwrap()).collect();
        let expected = if damping > 0.0 { &["order", "dissipative"][..] } else { &["order"] };
        assert!(names == expected && laws.iter().all(|law| law["pass"] == true), "{report}");
    }
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

/// Laws of steps with damping, on groups of all kinds and Hamiltonians of both.
#[test]
fn damping_keeps_what_it_is_said_to_keep() {
    for (text, laws) in [
        (
            "group = \"SE3\"\nhamiltonian = \"mu[0]^2/2 + mu[1]^2/3 + mu[2]^3/9 + mu[3]^2/2 + mu[0]*mu[4]/5\"\n\
          damping = [0.1, 0.2, 0, 0.1, 0.3, \"1/7\"]",
            6,
        ),
        (
            "group = \"SO3^2\"\ncoordinates = \"x y z\"\n\
          hamiltonian = \"sum(i, 0..2, x[i]^2 - z[i]^4/4) + x[0]*x[1] + y[0]*y[1] + z[0]*z[1]\"\ndamping = [a, \"a\", \"a\"]\n\
          [parameters]\na = 0.2",
            6,
        ),
        (
            "group = \"SO3\"\nhamiltonian = \"sqrt(1 + mu[0]^2 + mu[1]^2/2 + mu[2]^2/3)\"\ndamping = 0.3",
            6,
        ),
        ("group = \"SO3\"\nhamiltonian = \"mu[0]^2 + cos(t)*mu[1]*mu[2]\"\ndamping = 0.3", 5),
        (
            "group = \"SO3\"\nhamiltonian = \"mu[0]^2 + mu[1]*mu[2]\"\ndamping = 0.3\ntorque = [\"t\", \"g[0][1]\", \"0\"]",
            1,
        ),
    ] {
        let text = text.replace("[a, ", "[\"a\", ");
        let copies = if text.contains("SE3") || text.contains("^2\"\nc") { 6 } else { 3 };
        let momentum = &[0.7, -0.4, 0.9, 0.3, -0.5, 0.2][..copies];
        let rest = "[integrator]\ntruncation = 5\nstep = 0.1\n[initial]\nmomentum = ";
        let folder = Folder::with(&format!("{text}\n{rest}{momentum:?}\n[run]\ntime = 2\n"));
        let report = folder.json("check system.toml");
        let found = report["laws"].as_array().unwrap();
        assert!(found.iter().all(|law| law["pass"] == true), "{text}: {report}");
        assert_eq!(found.len(), laws, "{text}: {report}");
        let report = folder.json("simulate system.toml");
        assert!(report["drift"]["energy"].is_null(), "{text}: {report}");
        if laws > 1 {
            let drift = |name: &str| report["drift"][name].as_f64().unwrap();
            assert!(drift("spatial_momentum").max(drift("casimirs")) < 1e-13, "{text}: {report}");
        }
    }
}

/// A sphere that rubs, is driven by a table, and pulled at by a spring.
fn rubbed(forces: &str) -> Folder {
    Folder::with(&format!(
        "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"(x^2 + y^2 + z^2)/4\"\n{forces}\n[parameters]\n\
         w = 1.3\nc = 0.3\n[inputs]\ntimes = [0, 1, 2]\nu = [1, 2, 5]\n[integrator]\nstep = 0.1\n[initial]\n\
         momentum = [0.3, -0.2, 0.5]\n[run]\ntime = 2\n"
    ))
}

/// Closed forms, by every back end; and what is not Hamiltonian has no drift.
#[test]
fn torques_have_closed_forms() {
    let factor = (-0.6_f64).exp();
    // u = 1 + t², z is the integral of it and of cos t.
    let z = 0.5 + 2.0 + 8.0 / 3.0 + 2.0_f64.sin();
    for (torque, expected) in [
        ("[\"-c*x\", \"-c*y\", \"-c*z + 0*u\"]", [0.3 * factor, -0.2 * factor, 0.5 * factor]),
        ("[\"g[0][0]*0\", \"0\", \"u + cos(t)\"]", [0.3, -0.2, z]),
    ] {
        let folder = rubbed(&format!("torque = {torque}"));
        for backend in ["interpreter", "auto"] {
            let report = folder.json(&format!("simulate system.toml --backend {backend}"));
            for name in ["spatial_momentum", "casimirs", "energy"] {
                assert!(report["drift"][name].is_null(), "{report}");
            }
            let apart = distance(&numbers(&report["momentum"]), &expected);
            assert!(apart < 1e-12, "{torque} {backend}: {apart:e}");
        }
    }
    let both = rubbed("potential = \"w*g[2][2]\"\ntorque = [\"-c*x\", \"-c*y\", \"u - c*z\"]");
    let one = rubbed("torque = [\"w*g[2][1] - c*x\", \"-w*g[2][0] - c*y\", \"u - c*z\"]");
    let [first, second] = [&both, &one].map(|folder| end(&folder.json("simulate system.toml")));
    assert!(distance(&first, &second) < 1e-14, "{first:?} {second:?}");
    let said = both.run("simulate system.toml").ok();
    said.prints(&[
        "collocation, 4 nodes",
        "not conserved: a torque acts",
        "which is not Hamiltonian",
    ]);
}

/// Rows are runs, also where a parameter varies; a tolerance is met; headers are written; the rest is refused in words.
#[test]
fn drives_go_through_every_door() {
    let text = text_of("examples/damped_body.toml").replace("time = 300", "time = 2");
    let folder = Folder::with(&text);
    folder.write("in.csv", "mu_1,mu_2,mu_3,I2\n2,0.1,0.2,2\n2,0.1,0.2,1.5\n");
    folder.json("ensemble system.toml --initial in.csv --out out.csv");
    let table = folder.table("out.csv");
    for (row, inertia) in [(1, "I2 = 2.0"), (2, "I2 = 1.5")] {
        let found: Vec<f64> = table[row][..3].iter().map(|x| x.parse().unwrap()).collect();
        let single = Folder::with(&text.replace("I2 = 2.0", inertia));
        let single = numbers(&single.json("simulate system.toml")["momentum"]);
        assert!(distance(&found, &single) < 1e-13, "{found:?} {single:?}");
    }
    let exact = numbers(&folder.json("simulate system.toml --step 0.01")["momentum"]);
    let met = folder.json("simulate system.toml --tolerance 1e-6");
    assert!(distance(&numbers(&met["momentum"]), &exact) < 2e-6, "{met}");
    let header = folder.run("emit system.toml --language c").ok();
    header.prints(&["Of a velocity eta and a torque tau", "damping = [0.02, 0.02, 0.02]"]);
    for (command, word) in [
        (
            "verify system.toml out.csv",
            "a system with a velocity, a torque or damping is not judged",
        ),
        ("simulate system.toml --method series", "have no series"),
    ] {
        folder.run(command).fails(2, &[word]);
    }
    folder.write("in.csv", "mu_1,mu_2,mu_3,a\n2,0.1,0.2,2\n");
    folder.run("ensemble system.toml --initial in.csv --out out.csv").fails(
        2,
        &["can neither vary from row to row nor have derivatives: it is a number of the algebra or of the damping"],
    );
    for (damping, word) in [
        ("-0.1", "must not be negative"),
        ("[0.1, 0.2]", "2"),
        ("\"b\"", "unknown variable `b`"),
        ("true", "a number"),
    ] {
        let own = format!("damping = {damping}");
        Folder::with(&text.replace("damping = \"a\"", &own))
            .run("simulate system.toml")
            .fails(2, &[word]);
    }
    // Too long for the damping, not for the step.
    let strong = Folder::with(&text.replace("a = 0.02", "a = 20"));
    strong.run("simulate system.toml").fails(1, &["works here"]);
    for (forces, word) in [
        ("torque = [\"x\", \"u\"]", "`torque` has 2 components, and the momentum 3"),
        ("velocity = [\"x\", \"u\"]", "`velocity` has 2 components, and the momentum 3"),
        ("torque = [\"x\", \"u\", \"v\"]", "unknown variable `v`"),
        ("velocity = [\"x\", \"y\", \"z\"]", "`u` does not occur in"),
        ("potential = \"2\"\ntorque = [\"-x\", \"u\", \"v\"]", "does not depend on"),
    ] {
        rubbed(forces).run("simulate system.toml").fails(2, &[word]);
    }
    for (forces, word) in [
        ("torque = [\"ln(g[2][2] - 0.9)\", \"u\", \"0\"]", "ln(g[2][2] - 9/10)"),
        ("potential = \"ln(g[2][2] - 0.9)\"\ntorque = [\"u\", \"0\", \"0\"]", "ln(g[2][2] - 9/10)"),
        ("potential = \"w*g[2][2]\"\ntorque = [\"ln(x - u)\", \"0\", \"0\"]", "ln(x - u)"),
    ] {
        let left = rubbed(forces).run("simulate system.toml");
        left.fails(1, &["is not defined at time", word]);
    }
    let old = rubbed("torque = [\"-x\", \"-y\", \"u\"]").text("system.toml");
    Folder::with(&old.replace("[integrator]", "[integrator]\nsplitting = \"strang\""))
        .run("simulate system.toml")
        .fails(
            2,
            &[
                "`splitting = \"strang\"`: a velocity, a torque or damping acts within the step",
                "remove it",
            ],
        );
    let wrong = rubbed("potential = \"w*g[2][2]\"").text("system.toml");
    let wrong = Folder::with(&wrong.replace("[integrator]", "[integrator]\nsplitting = 3"));
    let said = wrong.run("simulate system.toml").fails(2, &["`splitting` must be a text"]);
    assert_eq!(said.error.matches("must be a text").count(), 1, "{}", said.error);
    let driven = rubbed("torque = [\"0\", \"0\", \"u + cos(t)\"]");
    driven.run("simulate system.toml --time 3").fails(2, &["the input `u` goes from time 0 to 2"]);
    driven.write("in.csv", "mu_1,mu_2,mu_3\n0.3,-0.2,0.5\n1,2,3\n");
    driven.json("ensemble system.toml --initial in.csv --out out.csv");
    let row: Vec<f64> = driven.table("out.csv")[1].iter().map(|x| x.parse().unwrap()).collect();
    let single = numbers(&driven.json("simulate system.toml")["momentum"]);
    assert!(distance(&row, &single) < 1e-13, "{row:?} {single:?}");
}

/// Π' = Π × ω + m × RᵀB(t) − c ω, and each row r of R turns as r' = r × ω.
#[test]
fn a_magnet_in_the_field_of_the_earth_moves_as_its_own_equations_say() {
    let start = [4.0, -2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let expected = runge_kutta(start, (3.0, 60_000), |t, state| {
        let omega: [f64; 3] = std::array::from_fn(|i| state[i] / [1.0, 1.2, 0.6][i]);
        // The field of a dipole −z at the unit vector r.
        let r = [t.cos(), 0.0, t.sin()];
        let field: [f64; 3] = std::array::from_fn(|i| [0.0, 0.0, 1.0][i] - 3.0 * r[2] * r[i]);
        let body: [f64; 3] =
            std::array::from_fn(|i| (0..3).map(|j| state[3 + 3 * j + i] * field[j]).sum());
        let torque = cross(&[0.0, 0.0, 30.0], &body);
        std::array::from_fn(|i| {
            let turned = cross(&state[i / 3 * 3..][..3], &omega)[i % 3];
            if i < 3 { turned + torque[i] - omega[i] } else { turned }
        })
    });
    let report = json("simulate examples/magnetic_satellite.toml --time 3");
    let apart = distance(&end(&report), &expected);
    assert!(apart < 1e-7, "{apart:e}");
}

/// x' = p/m and p' = (q/m) p × B(x).
#[test]
fn a_charge_in_a_magnetic_bottle_moves_as_its_own_equations_say() {
    let start = [1.0, 0.0, 1.0, 0.0, 0.1, 0.0];
    let expected = runge_kutta(start, (3.0, 60_000), |_, state| {
        let (p, x) = state.split_at(3);
        let field = [-x[0] * x[2], -x[1] * x[2], 1.0 + x[2] * x[2]].map(|b| 10.0 * b);
        let force = cross(p, &field);
        [force[0], force[1], force[2], p[0], p[1], p[2]]
    });
    let found = end(&json("simulate examples/magnetic_bottle.toml --time 3"));
    // The last column of the matrix is the place.
    let place = [6, 10, 14].map(|at| found[at]);
    let apart = distance(&[&found[..3], &place].concat(), &expected);
    assert!(apart < 1e-7, "{apart:e}");
}

/// A velocity, and the argument of a power, pass through zero within a step at any step size.
#[test]
fn what_passes_through_zero_is_no_long_step() {
    for (hamiltonian, more) in [
        ("cos(t)*x + y*z/1000", ""),
        ("x^2/2 + y^2/3 + z^2/4", "torque = [\"-g[2][1]\", \"g[2][0]\", \"0\"]\n"),
        ("x^2/2 + y^2/3 - z^4/4 + t*0", "damping = 0.2\n"),
    ] {
        let folder = Folder::with(&format!(
            "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"{hamiltonian}\"\n{more}[integrator]\ntruncation = 3\n\
             step = 0.02\n[initial]\nmomentum = [0, 0.4, 0.1]\n[run]\ntime = 20\n"
        ));
        let [coarse, fine] = ["", " --step 0.01"].map(|step| {
            end(&folder.json(&format!("simulate system.toml{step} --method collocation")))
        });
        assert!(distance(&coarse, &fine) < 1e-6, "{hamiltonian}: {coarse:?} {fine:?}");
    }
}
