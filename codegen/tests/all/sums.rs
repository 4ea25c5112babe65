//! Sums over sites in system files, and coordinates and momenta given for one copy.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::system::{self, Options};

use crate::given::{kept, read};

pub fn file(hamiltonian: &str, momentum: &str) -> String {
    format!(
        "group = \"SO3^3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"{hamiltonian}\"\n\
         [parameters]\nJ = [1, 2, 3]\nP = [0, 1.5, -1]\n[initial]\nmomentum = {momentum}\n"
    )
}

pub const MOMENTUM: &str = "[1, 2, 3, 4, 5, 6, 7, 8, 9]";

#[test]
fn a_sum_is_its_terms() {
    for (short, long) in [
        ("sum(i, 0..3, x[i]^2)", "x[0]^2 + x[1]^2 + x[2]^2"),
        ("2*sum(i, 0..3, x[i]*x[(i+1)%3]) - z[0]", "2*(x[0]*x[1] + x[1]*x[2] + x[2]*x[0]) - z[0]"),
        ("sum(i, 1..3, J[i]*y[i - 1]*y[i])", "2*y[0]*y[1] + 3*y[1]*y[2]"),
        ("sum(i, 0..3, i^2*z[(i - 1) % 3]^2)", "z[0]^2 + 4*z[1]^2"),
        (
            "sum(i, 0..3, sum(j, i + 1..3, (j - i)*x[i]*x[j]))",
            "x[0]*x[1] + 2*x[0]*x[2] + x[1]*x[2]",
        ),
        ("sum(i, 0..len(J), len(x)*J[i]*x[J[i] - 1])", "3*(x[0] + 2*x[1] + 3*x[2])"),
    ] {
        let [short, long] = [short, long].map(|text| read(&file(text, MOMENTUM)));
        assert_eq!(short.problem.hamiltonian, long.problem.hamiltonian, "{}", short.problem.source);
    }
}

#[test]
fn the_momentum_of_a_power_may_be_given_for_one_copy() {
    let momentum = |text: &str| {
        let text = file("sum(i, 0..3, x[i]^2)", text);
        system::read(&text, Options::default()).map(|system| system.run.momentum.unwrap())
    };
    assert_eq!(
        momentum("[\"i + 1\", 0.5, \"2/4\"]").unwrap(),
        [1.0, 0.5, 0.5, 2.0, 0.5, 0.5, 3.0, 0.5, 0.5]
    );
    assert_eq!(momentum("[\"cos(i)\", \"sin(i)\", 0]").unwrap()[3..5], [1f64.cos(), 1f64.sin()]);
    assert!(momentum("[\"1/i\", 0, 0]").is_err());
    assert!(momentum("[\"k\", 0, 0]").is_err());
    assert!(momentum("[1, 2]").is_err());
}

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

#[test]
fn edges_are_numbers_where_parameters_are_kept() {
    let text = "group = \"SO3^3\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
                hamiltonian = \"sum(b, 0..n - 1, J[b]*x[P[b]]*x[P[b + 1]])\"\n\
                [parameters]\nn = \"len(P)\"\nJ = [1, 2]\nP = [0, 2, 1]\n";
    let problem = kept(text).problem;
    let names: Vec<_> = problem.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["J"]);
    assert_eq!(problem.hamiltonian.len(), 2);
}
