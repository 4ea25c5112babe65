//! `simulate`: elements that are printed, and drifts by the columns of a file; cases `simulate_*` show the rest.

use crate::support::{BODY, Folder, json, run};

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
