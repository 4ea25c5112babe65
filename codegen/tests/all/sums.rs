//! Sums over sites in system files; `cases/read.cases` has others, and momenta given for one copy.
#![allow(clippy::unwrap_used)]

use crate::given::read;

pub fn file(hamiltonian: &str, momentum: &str) -> String {
    format!(
        "group = \"SO3^3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"{hamiltonian}\"\n\
         [parameters]\nJ = [1, 2, 3]\nP = [0, 1.5, -1]\n[initial]\nmomentum = {momentum}\n"
    )
}

pub const MOMENTUM: &str = "[1, 2, 3, 4, 5, 6, 7, 8, 9]";

/// The exchange of all pairs of sites at this squared distance, in plain terms.
fn exchange(sites: &[[f64; 3]], distance2: f64) -> (usize, String) {
    let mut terms = Vec::new();
    for (i, a) in sites.iter().enumerate() {
        for (j, b) in sites.iter().enumerate().skip(i + 1) {
            let apart: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
            if (apart - distance2).abs() < 1e-9 {
                terms.push(format!("x[{i}]*x[{j}] + y[{i}]*y[{j}] + z[{i}]*z[{j}]"));
            }
        }
    }
    (terms.len(), terms.join(" + "))
}

#[test]
fn lattices_by_edges_are_those_of_their_geometry() {
    let circle = |turns: f64, radius: f64| {
        let (y, x) = (turns * std::f64::consts::TAU).sin_cos();
        [radius * x, radius * y, 0.0]
    };
    let triangle: Vec<_> = (0..3).map(|i| circle(f64::from(i) / 3.0, 1.0)).collect();
    let tips = (0..6).map(|i| circle((f64::from(i) + 0.5) / 6.0, 3f64.sqrt()));
    let star: Vec<_> = (0..6).map(|i| circle(f64::from(i) / 6.0, 1.0)).chain(tips).collect();
    let grid = || (-1..=1).map(f64::from);
    let cube = grid().flat_map(|x| grid().flat_map(move |y| grid().map(move |z| [x, y, z])));
    let molecule: Vec<_> = cube.filter(|p| p.iter().map(|x| x * x).sum::<f64>() == 2.0).collect();
    let squares = (0..12).map(|i| format!(" + 0.2*z[{i}]^2")).collect::<String>();
    let field = (0..12).map(|i| format!(" - 0.5*z[{i}]")).collect::<String>();
    for (name, sites, distance2, bonds, rest) in [
        ("spin_triangle", triangle, 3.0, 3, String::new()),
        ("kagome_star", star, 1.0, 18, squares),
        ("spin_molecule", molecule, 2.0, 24, field),
    ] {
        let path = format!("{}/../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let example = read(&std::fs::read_to_string(path).unwrap());
        let (count, exchange) = exchange(&sites, distance2);
        assert_eq!(count, bonds, "{name}");
        let plain = read(&format!(
            "group = \"SO3^{}\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"{exchange}{rest}\"\n",
            sites.len()
        ));
        assert_eq!(example.problem.hamiltonian, plain.problem.hamiltonian, "{name}");
    }
}
