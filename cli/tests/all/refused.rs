//! Systems that once ran to a wrong end with a good report: each is refused with the time, or right to the end.

use crate::support::{BODY, Folder, Ran};

const MANAKOV: &str = "group = \"SO4\"\nhamiltonian = \"mu[0]^2/6 + mu[1]^2/8 + mu[2]^2/10 + mu[3]^2/10 + \
                       mu[4]^2/12 + mu[5]^2/14\"\n[integrator]\ntruncation = 5\nstep = 1.0\n[initial]\n\
                       momentum = [9.3, -10.0, -8.6, 9.4, 6.4, 9.7]\n[run]\ntime = 5.0\n";
const QUARTIC: &str = "group = \"SO3*SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]^4/4 + \
                       mu[3]^2/2\"\n[integrator]\ntruncation = 9\nstep = 1\n[initial]\n\
                       momentum = [2.0, 0.5, 1.0, 1.0, 0.0, 0.0]\n[run]\ntime = 10\n";

/// A refused step names the time, the size of x, the ratio, and a step that was tried: that step works.
#[test]
fn a_refused_step_names_one_that_works() {
    let folder = Folder::new();
    folder.write("manakov.toml", MANAKOV);
    folder.write("quartic.toml", QUARTIC);
    let usable = |error: &str| -> String {
        for word in ["|x| = ", "in the ratio ", "; a step of "] {
            assert!(error.contains(word), "{word}: {error}");
        }
        let step = error.split("; a step of ").nth(1).unwrap();
        step.split(" works here").next().unwrap().to_owned()
    };
    let fails = |ran: Ran| {
        assert!(ran.code == 1 && ran.out.is_empty(), "{ran:?}");
        assert!(ran.error.starts_with("error: at time 0, step 1: "), "{ran:?}");
        ran.error
    };
    for (system, options) in [
        (BODY, "--step 8 --time 40"),
        ("examples/satellite.toml", "--step 20 --time 40"),
        ("examples/lagrange_top.toml", "--step 10 --time 40"),
        // Several turns in four dimensions; then one factor of a product that breaks the step.
        ("manakov.toml", ""),
        ("manakov.toml", "--format json"),
        ("quartic.toml", ""),
        ("quartic.toml", "--solver fixed_point"),
    ] {
        let step = usable(&fails(folder.run(&format!("simulate {system} {options}"))));
        folder.run(&format!("simulate {system} --step {step} --time {step}")).ok();
    }
    // A Cayley step so long that nothing moved.
    let cayley = "--truncation 9 --chart cayley --step 30 --time 300";
    let error = fails(folder.run(&format!("simulate examples/manakov_so4.toml {cayley}")));
    assert!(error.contains("; a step of "), "{error}");
    let error = folder.run(&format!("check {BODY} --step 20")).fails(1, &[]).error;
    folder.run(&format!("check {BODY} --step {}", usable(&error))).ok();

    // Rows of an ensemble: each its own.
    folder.write("states.csv", "mu_1,mu_2,mu_3\n0.1,0,0.1\n20,5,10\n200,50,100\n");
    let advance = "--initial states.csv --out ends.csv --step 0.5 --time 300";
    folder.run(&format!("ensemble {BODY} {advance}")).ok();
    let list = folder.text("ends.csv.rejected.csv");
    let steps: Vec<f64> = list.lines().skip(1).map(|line| usable(line).parse().unwrap()).collect();
    assert!(steps.len() == 2 && steps[1] < steps[0] && steps[0] < 0.5, "{list}");
    assert!(list.contains("\n2,1,\"") && list.contains("\n3,1,\""), "{list}");
}

/// A body whose step is refused alone is refused beside seven slow ones that do not touch it, and says why.
#[test]
fn idle_factors_do_not_hide_a_fast_one() {
    let fast = "-0.45927998697067629,-24.812225295827826,1.8406638635157002";
    let slow = ",0.45,3.75,3".repeat(7);
    let one = ("SO3", "x^2/2 + y^2/18 + z^2/20", fast.to_owned());
    let sum = "sum(i, 0..8, x[i]^2/2 + y[i]^2/18 + z[i]^2/20)";
    for (group, energy, momenta) in [one, ("SO3^8", sum, format!("{fast}{slow}"))] {
        let folder = Folder::with(&format!(
            "group = \"{group}\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"{energy}\"\n\
             [integrator]\ntruncation = 5\nstep = 1\nsolver = \"newton\"\n"
        ));
        let names: Vec<String> =
            (1..=momenta.split(',').count()).map(|i| format!("mu_{i}")).collect();
        folder.write("states.csv", format!("{}\n{momenta}\n", names.join(",")));
        folder
            .run("ensemble system.toml --initial states.csv --out ends.csv --step 1 --time 1")
            .fails(1, &["all 1 rows failed"])
            .prints(&["the series means nothing for so long a step"]);
    }
}

/// Random steps of the same system: with a momentum the run is refused, or its Casimirs are kept.
#[test]
fn random_starts_are_refused_or_keep_their_casimirs() {
    let folder = Folder::with(MANAKOV);
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
    folder.write("states.csv", text);
    let mut ended = 0;
    for (truncation, step) in [("3", "0.5"), ("5", "0.5"), ("5", "1.0"), ("5", "0.05")] {
        let options =
            format!("--truncation {truncation} --step {step} --time {step} --format json");
        let run = "ensemble system.toml --initial states.csv --out ends.csv";
        let ran = folder.run(&format!("{run} {options}"));
        let report: serde_json::Value = serde_json::from_str(&ran.out).unwrap();
        for law in ["casimirs", "spatial_momentum"] {
            assert!(report["drift"][law].as_f64().unwrap() < 1e-12, "{report}");
        }
        ended += 400 - report["failed"].as_u64().unwrap();
        for (number, line) in folder.text("ends.csv").lines().skip(1).enumerate() {
            let finite = line.split(',').all(|cell| cell.parse::<f64>().unwrap().is_finite());
            let listed = || {
                let list = folder.text("ends.csv.rejected.csv");
                list.contains(&format!("\n{},1,\"", number + 1))
            };
            assert!(finite || listed(), "row {}", number + 1);
        }
    }
    assert!(ended > 400, "{ended}");
}
