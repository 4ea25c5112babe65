//! `simulate`: the reference end state, the keys programs rely on, and the files it writes.

use crate::support::{BODY, Folder, distance, json, numbers, run, text_of};
use serde_json::Value;
use sha2::{Digest, Sha256};

/// The paper's rigid body at T = 100, 25 digits by a separate implementation
/// (`end_states.json`, "rigid-body (paper)"), rounded to f64.
const MOMENTUM: [f64; 3] = [2.010707126264523, -0.36808278919852901, -1.0351675771028064];
const ATTITUDE: [[f64; 3]; 3] = [
    [0.65150238803525687, -0.6113717809846443, -0.44918724803807787],
    [-0.090946380002903989, 0.52488019083483492, -0.84630345694292452],
    [0.75317554019546132, 0.59222067735334215, 0.28635864744746481],
];

fn error(run: &Value) -> f64 {
    distance(&numbers(&run["momentum"]), &MOMENTUM)
}

/// The target of the command's main job: 1e-11 at K = 7; K = 3 and 5 as their orders say.
#[test]
fn the_rigid_body_of_the_paper_ends_where_it_should() {
    let runs = json(&format!("simulate {BODY} --truncation 3,5,7"));
    let runs = runs.as_array().unwrap();
    assert_eq!(runs.len(), 3);
    let errors: Vec<f64> = runs.iter().map(error).collect();
    assert!(errors[0] > 1e-9 && errors[0] < 1e-5, "{errors:?}");
    assert!(errors[1] > 1e-12 && errors[1] < 1e-8, "{errors:?}");
    assert!(errors[2] < 1e-11, "{errors:?}");
    for run in runs {
        assert!(run["drift"]["spatial_momentum"].as_f64().unwrap() <= 1e-13);
        assert!(run["drift"]["casimirs"].as_f64().unwrap() <= 1e-13);
    }
    for (row, expected) in runs[2]["group_element"].as_array().unwrap().iter().zip(ATTITUDE) {
        assert!(distance(&numbers(row), &expected) < 1e-11, "{row}");
    }
}

/// The estimate is near the truth: where a run is compared as a whole, at its beginning, or with half steps, since steps of twice
/// the size are refused.
#[test]
fn the_estimated_error_is_near_the_truth() {
    let apart = |coarse: &Value, fine: &Value| {
        let (coarse, fine) = (numbers(coarse), numbers(fine));
        let size = fine.iter().map(|x| x * x).sum::<f64>().sqrt();
        let square: f64 = coarse.iter().zip(&fine).map(|(a, b)| (a - b) * (a - b)).sum();
        square.sqrt() / size
    };
    for (system, step) in [
        ("examples/rigid_body.toml --truncation 5 --time 20", 0.1),
        ("examples/rigid_body.toml --truncation 3", 0.1),
        ("examples/satellite.toml --time 10", 0.05),
        ("examples/zeitlin_5.toml --time 2", 0.1),
    ] {
        let run = |step: f64| json(&format!("simulate {system} --step {step}"));
        let (coarse, fine) = (run(step), run(step / 4.0));
        let element = |run: &Value| -> Value {
            let rows = run["group_element"].as_array().unwrap();
            rows.iter().flat_map(|row| row.as_array().unwrap().clone()).collect()
        };
        let truth = apart(&coarse["momentum"], &fine["momentum"])
            .max(apart(&element(&coarse), &element(&fine)));
        let found = coarse["estimated_error"].as_f64().unwrap();
        assert!((0.1..10.0).contains(&(found / truth)), "{system}: {found:e}, in truth {truth:e}");
        assert_eq!(coarse["warnings"], Value::Array(Vec::new()), "{system}");
    }
    let rough = run(&format!("simulate {BODY} --truncation 1 --step 0.25 --time 1600")).ok();
    rough.says(&["warning: the end is not resolved"]).prints(&["  warning: the end is not"]);
    let rough = run(&format!("simulate {BODY} --truncation 1 --step 0.25 --time 100")).ok();
    rough.says(&["warning: the error at the end is about "]).prints(&["  warning: the error at"]);
}

#[test]
fn json_has_the_keys_programs_rely_on() {
    let run = json("simulate examples/heavy_top.toml --time 1");
    assert_eq!((&run["steps"], &run["time"]), (&20.into(), &1.0.into()));
    assert_eq!(numbers(&run["momentum"]).len(), 6);
    assert_eq!(run["group_element"].as_array().unwrap().len(), 4);
    for key in ["spatial_momentum", "casimirs", "energy"] {
        assert!(run["drift"][key].is_number(), "{key}");
    }
    assert!(run["solver"]["most_iterations"].as_f64().unwrap() >= 1.0);
    assert!(run["estimated_error"].as_f64().unwrap() < 1e-12);
    assert!(run["solver"]["max_residual"].as_f64().unwrap() < 1e-14);
    assert_eq!((&run["step"], &run["step_asked"]), (&0.05.into(), &0.05.into()));
    assert_eq!((&run["chart"], &run["truncation"]), (&"exp".into(), &7.into()));
    assert_eq!(run["coordinates"][3], "Gamma_x");
    assert_eq!(run["run"]["system"], "examples/heavy_top.toml");
    let hash = Sha256::digest(text_of("examples/heavy_top.toml"));
    assert_eq!(run["run"]["system_sha256"], format!("{hash:x}"));
    assert!(run["energy"]["start"].is_f64() && run["energy"]["end"].is_f64());
}

/// A quantity without a number has no key.
#[test]
fn json_never_holds_null() {
    fn nulls(value: &Value) -> bool {
        match value {
            Value::Null => true,
            Value::Array(list) => list.iter().any(nulls),
            Value::Object(map) => map.values().any(nulls),
            _ => false,
        }
    }
    for arguments in [
        "rigid_body.toml --time 5 --truncation 3,5",
        "satellite.toml --time 1",
        "spin_chain_64.toml --time 0.1",
    ] {
        let run = json(&format!("simulate examples/{arguments}"));
        assert!(!nulls(&run), "{run}");
    }
}

/// Backwards from the end leads to the start.
#[test]
fn a_negative_step_runs_backwards() {
    let forward = json(&format!("simulate {BODY} --time 2"));
    let (mu, g) = (&forward["momentum"], &forward["group_element"]);
    let end = format!("momentum = {mu}\ngroup_element = {g}");
    let folder = Folder::with(&text_of(BODY).replace("momentum = [2.0, 0.5, 1.0]", &end));
    let back = folder.json("simulate system.toml --time 2 --step -0.1");
    assert!(distance(&numbers(&back["momentum"]), &[2.0, 0.5, 1.0]) < 1e-13);
    assert!((back["group_element"][0][0].as_f64().unwrap() - 1.0).abs() < 1e-13);
}

/// Both charts of one system, and algebras given by basis and by brackets.
#[test]
fn other_charts_and_algebras_keep_their_momentum_too() {
    for arguments in
        ["rigid_body.toml --chart cayley --time 5", "sl2_by_basis.toml", "so21_by_brackets.toml"]
    {
        let run = json(&format!("simulate examples/{arguments}"));
        assert!(run["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12, "{arguments}");
        assert!(run["drift"]["casimirs"].as_f64().unwrap() < 1e-12, "{arguments}");
    }
}

#[test]
fn tables_and_matrices_hold_the_same_numbers() {
    let folder = Folder::new();
    for out in ["t.csv", "t.npy"] {
        folder.run(&format!("simulate {BODY} --time 2 --every 4 --out {out}")).ok();
    }
    let table = folder.table("t.csv");
    assert_eq!(table[0][..5], ["time", "x", "y", "z", "g_11"]);
    let row = |row: &Vec<String>| row.iter().map(|x| x.parse().unwrap()).collect();
    let rows: Vec<Vec<f64>> = table[1..].iter().map(row).collect();
    // 20 steps, every 4th, and the start.
    assert_eq!(rows.len(), 6);
    assert_eq!((&rows[0][1..4], rows[5][0]), (&[2.0, 0.5, 1.0][..], 2.0));
    let bytes = folder.bytes("t.npy");
    let array = npyz::NpyFile::new(&bytes[..]).unwrap();
    assert_eq!(array.shape(), [6, table[0].len() as u64]);
    assert_eq!(array.into_vec::<f64>().unwrap(), rows.concat());
}

/// Steps end at the time asked for: 50 is 62.5 steps of 0.8. Where the step divides the time it stays.
#[test]
fn runs_end_at_the_time_asked_for() {
    let ran = json(&format!("simulate {BODY} --time 50 --step 0.8"));
    let found = ["time", "step_asked", "steps", "step"].map(|key| ran[key].as_f64().unwrap());
    assert_eq!(found, [50.0, 0.8, 63.0, 50.0 / 63.0]);
    let line = "step 0.7936507936507936 in place of 0.8, so that 63 steps end at 50";
    let changed = run(&format!("simulate {BODY} --time 50 --step 0.8")).ok().prints(&[line]);
    assert_eq!(changed.error.trim(), line);
    let kept = run(&format!("simulate {BODY} --time 50 --step 0.1")).ok();
    assert!(kept.error.is_empty() && !kept.out.contains("in place of"), "{kept:?}");
}

/// A number that is not finite ends the run with the time and the step; here only the energy is too large for one.
#[test]
fn what_is_not_finite_fails_the_run() {
    let folder = Folder::with(
        "group = \"SO3\"\nhamiltonian = \"mu[0]^2/2\"\n[integrator]\ntruncation = 1\nstep = 1e-201\n[initial]\n\
         momentum = [1e200, 0, 0]\n[run]\ntime = 1e-200\n",
    );
    for format in ["text", "json"] {
        let ran = folder.run(&format!("simulate system.toml --format {format}"));
        assert_eq!(ran.fails(1, &["at time 0, step 0: the energy is inf"]).out, "");
    }
}

/// Elements are printed by what they are; zeros outside of the blocks are not printed.
#[test]
fn group_elements_can_be_read() {
    let text = |arguments: &str| run(&format!("simulate examples/{arguments}")).ok().out;
    let body = text("rigid_body.toml --time 1");
    let mut lines = body.lines().skip_while(|line| !line.contains("unit quaternion w, x, y, z"));
    let q = lines.nth(1).unwrap().split_whitespace().map(|word| word.parse().unwrap());
    let q: Vec<f64> = q.collect();
    let matrix = json(&format!("simulate {BODY} --time 1"));
    let g = |i: usize, j: usize| matrix["group_element"][i][j].as_f64().unwrap();
    let [w, x, y, z] = q[..] else { panic!("{q:?}") };
    assert!((w * w + x * x + y * y + z * z - 1.0).abs() < 1e-14);
    for (entry, expected) in [
        (g(0, 0), 1.0 - 2.0 * (y * y + z * z)),
        (g(1, 0), 2.0 * (x * y + w * z)),
        (g(2, 1), 2.0 * (y * z + w * x)),
    ] {
        assert!((entry - expected).abs() < 1e-14, "{entry} {expected}");
    }
    let ring = text("heisenberg_spin_ring.toml --time 0.1");
    assert_eq!(ring.matches("unit quaternion").count(), 4, "{ring}");
    let chain = text("spin_chain_64.toml --time 0.1");
    assert!(chain.contains("group elements of 52 more factors"), "{chain}");
    assert!(chain.lines().count() < 64 * 3 + 50);
    assert!(text("three_wave.toml --time 0.1").contains("complex 3 × 3 matrix"));
    for printed in [body, ring, chain] {
        assert!(!printed.contains("0.0000000000"), "{printed}");
    }
}

/// Parameters, π, velocities, quaternions and inverses give the ends that DOP853 finds at a tolerance of 1e-13 for the
/// numbers that they stand for.
#[test]
fn expressions_stand_for_their_numbers() {
    let body = "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
        hamiltonian = \"x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)\"\n[parameters]\nI1 = 1\nI2 = 2\nI3 = 3\n";
    let inverse = "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
        hamiltonian = \"sum(i, 0..3, mu[i]*inv(J)[i][i]*mu[i])/2\"\n[parameters]\nJ = [[1, 0, 0], [0, 2, 0], [0, 0, 3]]\n";
    let brackets = "hamiltonian = \"a + b^2 + 2*c^2\"\n[parameters]\nm = 7.63\n[algebra]\ngenerators = [\"a\", \"b\", \"c\"]\n\
        brackets = [\"[a, b] = 1/m*c\", \"[b, c] = 1/m*a\", \"[c, a] = 1/m*b\"]\n";
    let turning = "group = \"SO3\"\nhamiltonian = \"2*pi*mu[0] + mu[1]^2/2\"\n";
    let free = [0.4763559763704, 0.6725622165308, 0.1440314155711];
    for (system, initial, end) in [
        (body, "momentum = [\"I1*0.5\", \"I2*0.3\", \"I3*0.1\"]", free),
        (body, "angular_velocity = [0.5, 0.3, 0.1]", free),
        (body, "momentum = [0.5, 0.6, 0.3]\nquaternion = [0.5, 0.5, 0.5, 0.5]", free),
        (inverse, "angular_velocity = [0.5, 0.3, 0.1]", free),
        (brackets, "momentum = [1, 2, 3]", [1.8447868631, -0.1957286961, 3.2493771260]),
        (turning, "momentum = [1, 2, 3]", [1.2094191300, 1.1697698912, 3.3419969734]),
    ] {
        let run = "[integrator]\nstep = \"1/50\"\n[run]\ntime = \"5*0.2\"\n";
        let folder = Folder::with(&format!("{system}[initial]\n{initial}\n{run}"));
        let found = numbers(&folder.json("simulate system.toml")["momentum"]);
        assert!(distance(&found, &end) < 2e-10, "{found:?} for {end:?}: {system}{initial}");
    }
}

const BOOSTS: &str = r#"
name = "boosts"
hamiltonian = "HAMILTONIAN"
[algebra]
generators = ["a", "b", "c"]
brackets = ["[a, b] = -c", "[b, c] = a", "[c, a] = b"]
[integrator]
step = 0.1
truncation = 5
[initial]
momentum = [0.4, 0.7, -0.3]
[run]
time = 20
"#;

/// In a group that is not compact a drift is measured as far as rounding allows. No run fails because of it, and no right
/// row is called wrong.
#[test]
fn drifts_of_long_elements_are_not_measured() {
    for hamiltonian in ["a", "a^2/2 + b^2/3 - c^2/5 + a*c/5 + a/3"] {
        let folder = Folder::with(&BOOSTS.replace("HAMILTONIAN", hamiltonian));
        let report = folder.json("simulate system.toml --out run.csv");
        let end = report["drift_not_measurable_after"]["spatial_momentum"].as_f64().unwrap();
        assert!(end > 2.0 && end < 20.0, "{report}");
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-8, "{report}");
        folder.run("simulate system.toml").ok().prints(&["not measurable after t = "]);
        folder.run("verify run.csv").ok().prints(&["no row is wrong"]);
    }
}

/// Equal increments repeat their rounding, which must not add up in proportion to the steps.
#[test]
fn steady_motions_keep_momentum_and_casimirs() {
    let steady = |group: &str, hamiltonian: &str, momentum: &str| {
        let folder = Folder::with(&format!(
            "group = \"{group}\"\nhamiltonian = \"{hamiltonian}\"\n[integrator]\nstep = 0.5\ntruncation = 3\n\
             [initial]\nmomentum = {momentum}\n[run]\ntime = 100000\nevery = 200000\n",
        ));
        let report = folder.json("simulate system.toml");
        let drift = ["spatial_momentum", "casimirs"].map(|name| report["drift"][name].as_f64());
        (drift.map(Option::unwrap), report["off_group"].as_f64().unwrap())
    };
    let ([spatial, casimirs], off) = steady("SU3", "0.9*mu[0]", "[1, 2, 3, 4, 5, 6, 7, 8]");
    // The frame moves by one matrix, whose rounding adds up between two restorations, 8192 steps apart.
    assert!(spatial < 2e-12 && casimirs < 1e-12 && off < 4e-15, "{spatial} {casimirs} {off}");
    // The translation grows to 2500, and the drift is that of a difference of such numbers.
    let screw = "0.7*mu[0] + 0.2*mu[1] - 0.3*mu[2] + 0.1*mu[4]";
    let ([spatial, casimirs], off) = steady("SE3", screw, "[1, 2, 3, 4, 5, 6]");
    assert!(spatial < 1e-10 && casimirs < 1e-10 && off < 4e-15, "{spatial} {casimirs} {off}");
}

/// A drift follows from the columns of the file and the scale that it names.
#[test]
fn the_scale_of_the_energy_is_the_energy_at_the_start() {
    let folder = Folder::with(
        "group = \"SO3\"\nhamiltonian = \"mu[0]^2/2 + mu[1]^2/4 + mu[2]^2/6 - 0.75\"\n[integrator]\nstep = 0.5\ntruncation = 3\n\
         [initial]\nmomentum = [0.5, 0.9, 1.5]\n[run]\ntime = 100\n",
    );
    let report = folder.json("simulate system.toml --out run.csv");
    let scale = report["drift_scale"]["energy"].as_f64().unwrap();
    assert!((scale - 0.0475).abs() < 1e-15, "{report}");
    assert!(folder.text("run.csv").contains("# energy_scale: 0.0474"));
    let table = folder.table("run.csv");
    let place = |name: &str| table[0].iter().position(|known| known == name).unwrap();
    let [energy, drift] = ["energy", "energy_drift"].map(place);
    let number = |row: &Vec<String>, at: usize| row[at].parse::<f64>().unwrap();
    for row in &table[1..] {
        let expected = (number(row, energy) - number(&table[1], energy)).abs() / scale;
        assert!((number(row, drift) - expected).abs() <= 1e-12 * expected, "{row:?}");
    }
}

/// A quantity that is unknown or not conserved has no number in any output.
#[test]
fn an_unknown_drift_is_absent() {
    let folder = Folder::with(
        "group = \"Aff1\"\nhamiltonian = \"mu[0]^2/2 + mu[1]^2/3\"\n[integrator]\nstep = 0.1\n[initial]\nmomentum = [1, 0.5]\n\
         [run]\ntime = 1\n",
    );
    let report = folder.json("simulate system.toml --out run.csv");
    assert!(report["drift"].get("casimirs").is_none() && report["drift"]["energy"].is_number());
    assert!(!folder.text("run.csv").contains("casimir"));
}
