//! Damping by the double bracket: what it keeps, what falls, and its own equations.

use coadjoint::collocation::{Damping, Energy};
use coadjoint::{LieGroup, Phase, SO3};
use nalgebra::Vector3;

use crate::smooth_examples::{cross, runge_kutta};
use crate::support::{Folder, distance, json, numbers, text_of};

/// Π' = Π × (ω + α Π × ω) and R' = R (ω + α Π × ω)^: state Π, then the columns of Rᵀ, each of which turns as Π does.
#[test]
fn a_damped_body_moves_as_its_own_equations_say() {
    let [a, inertia] = [[0.02; 3], [1.0, 2.0, 3.0]];
    let start = [2.0, 0.1, 0.2, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let expected = runge_kutta(start, (20.0, 20_000), |_, state| {
        let omega: [f64; 3] = std::array::from_fn(|i| state[i] / inertia[i]);
        let lost = cross(&state[..3], &omega);
        let turn: [f64; 3] = std::array::from_fn(|i| omega[i] + a[i] * lost[i]);
        std::array::from_fn(|i| cross(&state[i / 3 * 3..][..3], &turn)[i % 3])
    });
    let error = |step: f64| {
        let report = json(&format!("simulate examples/damped_body.toml --time 20 --step {step}"));
        let rows = report["group_element_blocks"][0]["matrix"].as_array().unwrap();
        let state = [numbers(&report["momentum"]), rows.iter().flat_map(numbers).collect()];
        distance(&state.concat(), &expected)
    };
    let [coarse, fine] = [error(0.05), error(0.025)];
    assert!(fine < 2e-6 && (coarse / fine - 4.0).abs() < 0.1, "{coarse:e} {fine:e}");
}

/// Π' = Π × (ω + α Π × ω) with ω = (1 + 0.9 cos 3t) I⁻¹Π: the damping has the slope of its own time.
#[test]
fn damping_goes_with_the_time_of_its_hamiltonian() {
    let folder = Folder::with(
        "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"(1 + 0.9*cos(3*t))*(x^2/2 + y^2/4 + z^2/6)\"\n\
         damping = 0.3\n[integrator]\nstep = 0.1\n[initial]\nmomentum = [0.6, -0.4, 1.0]\n[run]\ntime = 3\n",
    );
    let expected = runge_kutta([0.6, -0.4, 1.0], (3.0, 3000), |t, mu| {
        let strength = 1.0 + 0.9 * (3.0 * t).cos();
        let omega: [f64; 3] = std::array::from_fn(|i| strength * mu[i] / [1.0, 2.0, 3.0][i]);
        let lost = cross(mu, &omega);
        let turn: [f64; 3] = std::array::from_fn(|i| omega[i] + 0.3 * lost[i]);
        cross(mu, &turn)
    });
    let error = |step: f64| {
        let report = folder.json(&format!("simulate system.toml --step {step}"));
        distance(&numbers(&report["momentum"]), &expected)
    };
    let [coarse, fine] = [error(0.05), error(0.025)];
    assert!(fine < 1e-3 && (coarse / fine - 4.0).abs() < 0.3, "{coarse:e} {fine:e}");
}

/// H = z⁴.
struct Bent;

impl Energy<Vector3<f64>> for Bent {
    fn value(&self, _: f64, mu: &Vector3<f64>) -> f64 {
        mu[2].powi(4)
    }

    fn gradient(&self, _: f64, mu: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(0.0, 0.0, 4.0 * mu[2].powi(3))
    }
}

/// With the mean slope of H between its ends, a step of damping by x takes Σ xᵢ²/(h Γᵢ) from the energy, however H is bent; between
/// two such halves z stays, and the momentum turns by −4 z³ h about the third axis.
#[test]
fn damping_takes_the_mean_slope_of_its_hamiltonian() {
    let (group, mut phase) = (SO3::new(), Phase::<SO3>::at_identity([1.0, 0.2, 0.9]));
    let damping = Damping::<_, _, 8>::new(group, Bent, Vector3::repeat(0.4)).unwrap();
    let before = phase.momentum[2].powi(4);
    damping.advance(&mut phase, 0.0, 0.05).unwrap();
    let x = group.log(&phase.group_element).unwrap();
    let lost = x.norm_squared() / (0.05 * 0.4);
    assert!(lost > 0.01 && (phase.momentum[2].powi(4) - before + lost).abs() < 1e-14, "{lost}");
    let turn = Vector3::new(0.0, 0.0, 0.1 * 4.0 * phase.momentum[2].powi(3));
    let turned = group.exp_transport(&turn, &phase.momentum).1;
    let mut phase = Phase::<SO3>::new(phase.group_element, turned);
    damping.advance(&mut phase, 0.05, 0.05).unwrap();
    let folder = Folder::with(
        "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"z^4\"\ndamping = 0.4\n[integrator]\nstep = 0.1\n\
         method = \"collocation\"\n[initial]\nmomentum = [1.0, 0.2, 0.9]\n[run]\ntime = 0.1\n",
    );
    let found = numbers(&folder.json("simulate system.toml")["momentum"]);
    assert!(distance(&found, phase.momentum.as_slice()) < 1e-13, "{found:?} {phase:?}");
}

/// Π' = Π × (ω + x) + τ and r' = r × (ω + x) with x = α (Π × ω + τ), τ = r × ∇V and the last row r of R; for H with and without
/// a root. The sum of both energies falls, and the momentum about the vertical stays.
#[test]
fn damping_beside_a_potential_takes_from_both_energies() {
    for (hamiltonian, root) in [("H", 0.0), ("sqrt(1 + 2*H)", 1.0)] {
        let hamiltonian = hamiltonian.replace('H', "(x^2/2 + y^2/4 + z^2/6)");
        let folder = Folder::with(&format!(
            "group = \"SO3\"\ncoordinates = \"x y z\"\nhamiltonian = \"{hamiltonian}\"\n\
             potential = \"1.3*(g[2][2] + g[2][0]^2/3)\"\ndamping = 0.2\n[integrator]\nstep = 0.1\n\
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
            let turn: [f64; 3] = std::array::from_fn(|i| omega[i] + 0.2 * (own[i] + torque[i]));
            let (moved, turned) = (cross(mu, &turn), cross(r, &turn));
            std::array::from_fn(|i| if i < 3 { moved[i] + torque[i] } else { turned[i - 3] })
        });
        let error = |step: f64| {
            let report = folder.json(&format!("simulate system.toml --step {step}"));
            assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-13, "{report}");
            let rows = report["group_element_blocks"][0]["matrix"].as_array().unwrap();
            distance(&[numbers(&report["momentum"]), numbers(&rows[2])].concat(), &expected)
        };
        let [coarse, fine] = [error(0.05), error(0.025)];
        assert!(fine < 1e-4 && (coarse / fine - 4.0).abs() < 0.3, "{coarse:e} {fine:e}");
        let report = folder.json("check system.toml");
        let laws = report["laws"].as_array().unwrap();
        assert!(laws.len() == 2 && laws.iter().all(|law| law["pass"] == true), "{report}");
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

const REST: &str = "[integrator]\nstep = 0.1\n[initial]\nmomentum = ";

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
        let folder = Folder::with(&format!("{text}\n{REST}{momentum:?}\n[run]\ntime = 2\n"));
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

/// Rows are runs, also where a parameter varies; runs stop between steps and go on as they would have.
#[test]
fn damping_goes_through_every_door() {
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
    for (command, word) in [
        ("emit system.toml", "no code is written of damping"),
        ("emit system.toml --language c", "no code is written of damping"),
        ("simulate system.toml --tolerance 1e-6", "a tolerance says nothing of damping"),
        ("verify system.toml out.csv", "a system with damping is not judged"),
    ] {
        folder.run(command).fails(2, &[word]);
    }
    folder.write("in.csv", "mu_1,mu_2,mu_3,a\n2,0.1,0.2,2\n");
    folder.run("ensemble system.toml --initial in.csv --out out.csv").fails(
        2,
        &["can neither vary from row to row nor have derivatives: it is a number of the algebra or of the damping"],
    );
    for (damping, more, word) in [
        ("-0.1", "", "must not be negative"),
        ("[0.1, 0.2]", "", "2"),
        ("\"b\"", "", "unknown variable `b`"),
        ("true", "", "a number"),
        (
            "0.1",
            "potential = \"g[2][2]\"\ntorque = [\"t\", \"0\", \"0\"]\n",
            "`damping` is not for a system with a potential and a torque",
        ),
    ] {
        let own = format!("{more}damping = {damping}");
        Folder::with(&text.replace("damping = \"a\"", &own))
            .run("simulate system.toml")
            .fails(2, &[word]);
    }
    // Too long for the damping, not for the step.
    let strong = Folder::with(&text.replace("a = 0.02", "a = 20"));
    strong.run("simulate system.toml").fails(1, &["did not converge", "works here"]);
}
