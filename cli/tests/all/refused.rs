//! Random steps of a system that once ran to a wrong end with a good report; cases `refused*` show others.

use crate::support::Folder;

const MANAKOV: &str = "group = \"SO4\"\nhamiltonian = \"mu[0]^2/6 + mu[1]^2/8 + mu[2]^2/10 + mu[3]^2/10 + \
                       mu[4]^2/12 + mu[5]^2/14\"\n[integrator]\ntruncation = 5\nstep = 1.0\n[initial]\n\
                       momentum = [9.3, -10.0, -8.6, 9.4, 6.4, 9.7]\n[run]\ntime = 5.0\n";
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
