//! Sums over sites in system files, and coordinates and momenta given for one copy.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::system::{self, Options};

use crate::given::{read, said};

fn file(hamiltonian: &str, momentum: &str) -> String {
    format!(
        "group = \"SO3^3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"{hamiltonian}\"\n\
         [parameters]\nJ = [1, 2, 3]\n[initial]\nmomentum = {momentum}\n"
    )
}

const MOMENTUM: &str = "[1, 2, 3, 4, 5, 6, 7, 8, 9]";

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
    ] {
        let [short, long] = [short, long].map(|text| read(&file(text, MOMENTUM)));
        assert_eq!(short.problem.hamiltonian, long.problem.hamiltonian, "{}", short.problem.source);
    }
}

#[test]
fn mistakes_in_sums_are_named() {
    for (hamiltonian, message) in [
        ("sum(i, 0..3)", "three arguments"),
        ("sum(i, 0..n, x[i])", "range"),
        ("sum(i, 0..99999, x[0])", "10000"),
        ("sum(J[0], 0..3, x[0])", "no name"),
        ("sum(sin, 0..3, x[0])", "in use"),
        ("sum(i, 0..4, x[i]^2)", "x[3]"),
        ("sum(i, 0..3, x[k]^2)", "x[k]"),
        ("sum(i, 0..3, x[i % 0]^2)", "x[i % 0]"),
        ("sum(i, 0..3, x[i]^2", "sum"),
        ("sum", "sum"),
    ] {
        let shown = said(&file(hamiltonian, MOMENTUM));
        assert!(shown.contains(message), "{hamiltonian}: {shown}");
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
