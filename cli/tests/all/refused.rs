//! Systems that once ran to a wrong end with a good report: each is refused with the time, or right to the end.

use crate::support::{file, run};
use tempfile::TempDir;

const MANAKOV: &str = "group = \"SO4\"\nhamiltonian = \"mu[0]^2/6 + mu[1]^2/8 + mu[2]^2/10 + mu[3]^2/10 + \
                       mu[4]^2/12 + mu[5]^2/14\"\n[integrator]\ntruncation = 5\nstep = 1.0\n[initial]\n\
                       momentum = [9.3, -10.0, -8.6, 9.4, 6.4, 9.7]\n[run]\ntime = 5.0\n";
const QUARTIC: &str = "group = \"SO3*SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]^4/4 + \
                       mu[3]^2/2\"\n[integrator]\ntruncation = 9\nstep = 1\n[initial]\n\
                       momentum = [2.0, 0.5, 1.0, 1.0, 0.0, 0.0]\n[run]\ntime = 10\n";

/// The run fails with the time, the step, the size of x, the ratio, and a step that works: with that one it ends well.
fn refused(system: &str, options: &[&str]) {
    let (code, out, error) = run(&[&["simulate", system], options].concat());
    assert!(code == 1 && out.is_empty(), "{out}{error}");
    for word in ["at time 0, step 1: ", "|x| = ", "in the ratio ", "; a step of "] {
        assert!(error.contains(word), "{word}: {error}");
    }
    let step = error.split("; a step of ").nth(1).unwrap().split(' ').next().unwrap();
    let (code, _, error) = run(&["simulate", system, "--step", step, "--time", step]);
    assert_eq!(code, 0, "{step}: {error}");
}

#[test]
fn a_step_over_several_turns_in_four_dimensions() {
    let directory = TempDir::new().unwrap();
    refused(&file(&directory, MANAKOV), &[]);
}

#[test]
fn one_factor_of_a_product_breaks_the_step() {
    let directory = TempDir::new().unwrap();
    let system = file(&directory, QUARTIC);
    refused(&system, &[]);
    refused(&system, &["--solver", "fixed_point"]);
}

#[test]
fn a_cayley_step_so_long_that_nothing_moves() {
    let options = ["--truncation", "9", "--chart", "cayley", "--step", "30", "--time", "300"];
    let (code, out, error) =
        run(&[&["simulate", "examples/manakov_so4.toml"], &options[..]].concat());
    assert!(code == 1 && out.is_empty(), "{out}{error}");
    assert!(error.contains("at time 0, step 1: ") && error.contains("; a step of "), "{error}");
}

/// Random steps of the same system: with a momentum the run is refused, or its Casimirs are kept.
#[test]
fn random_starts_are_refused_or_keep_their_casimirs() {
    let directory = TempDir::new().unwrap();
    let system = file(&directory, MANAKOV);
    let states = directory.path().join("states.csv");
    let mut text = "mu_1,mu_2,mu_3,mu_4,mu_5,mu_6\n".to_owned();
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    for _ in 0..400 {
        let numbers: Vec<String> = (0..6)
            .map(|_| {
                seed ^= seed << 13;
                seed ^= seed >> 7;
                seed ^= seed << 17;
                (20.0 * (seed >> 11) as f64 / (1u64 << 53) as f64 - 10.0).to_string()
            })
            .collect();
        text += &(numbers.join(",") + "\n");
    }
    std::fs::write(&states, text).unwrap();
    let mut ended = 0;
    for (truncation, step) in [("3", "0.5"), ("5", "0.5"), ("5", "1.0"), ("5", "0.05")] {
        let out = directory.path().join("ends.csv");
        let [states, out] = [&states, &out].map(|path| path.to_str().unwrap());
        let options =
            ["--truncation", truncation, "--step", step, "--time", step, "--format", "json"];
        let run = run(
            &[&["ensemble", &system, "--initial", states, "--out", out], &options[..]].concat()
        );
        let report: serde_json::Value = serde_json::from_str(&run.1).unwrap();
        let failed = report["failed"].as_u64().unwrap();
        assert!(report["drift"]["casimirs"].as_f64().unwrap() < 1e-12, "{report}");
        assert!(report["drift"]["spatial_momentum"].as_f64().unwrap() < 1e-12, "{report}");
        ended += 400 - failed;
        for (number, line) in std::fs::read_to_string(out).unwrap().lines().skip(1).enumerate() {
            let finite = line.split(',').all(|cell| cell.parse::<f64>().unwrap().is_finite());
            let listed = || {
                let list = std::fs::read_to_string(format!("{out}.rejected.csv")).unwrap();
                list.contains(&format!("\n{},1,\"", number + 1))
            };
            assert!(finite || listed(), "row {}", number + 1);
        }
    }
    assert!(ended > 400, "{ended}");
}
