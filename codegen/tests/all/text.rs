//! Hamiltonians as text: precedence, exactness, messages, and that nothing hangs or overflows.

#![allow(clippy::unwrap_used)]

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::number::{Rational, ratio};
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::{self, Options};
use proptest::prelude::*;

/// A system file on SO(3) with this Hamiltonian.
pub fn file(hamiltonian: &str) -> String {
    format!(
        "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\n\
         hamiltonian = '''{hamiltonian}'''\n[parameters]\nm = \"2/3\"\ng = 9.81\n"
    )
}

fn read(hamiltonian: &str) -> Result<Problem, Diagnostics> {
    system::read(&file(hamiltonian), Options::default()).map(|system| system.problem)
}

/// The coefficient of x, where the text is linear in it.
fn slope(hamiltonian: &str) -> Rational {
    let problem = read(hamiltonian).unwrap();
    let terms: Vec<_> = problem.hamiltonian.terms().collect();
    let x = terms.iter().find(|(exponents, _)| exponents[..3] == [1, 0, 0]);
    x.map_or_else(|| ratio(0, 1), |(_, value)| value.clone())
}

#[test]
fn precedence_is_that_of_mathematics() {
    for (text, expected) in [
        ("x + y^2", ratio(1, 1)),
        ("-2^2*x", ratio(-4, 1)),
        ("2^-2*x", ratio(1, 4)),
        ("2^3^2*x", ratio(512, 1)),
        ("2**-1**2*x", ratio(1, 2)),
        ("1/2/2*x", ratio(1, 4)),
        ("1 - 2 - 3*x*-1", ratio(3, 1)),
        ("2*(1 - (3 + 4))*x", ratio(-12, 1)),
        ("--+-x", ratio(-1, 1)),
        ("x*1.5 + 1e-3*x", ratio(1501, 1000)),
        ("0.1*x + 0.2*x - 0.3*x + y", ratio(0, 1)),
        ("m*g*x", ratio(654, 100)),
        ("x*4^(1/2)", ratio(2, 1)),
        ("sqrt(9/4)*x - abs(-2)*x", ratio(-1, 2)),
        ("(x + 1)^3 - x^3 - 3*x^2", ratio(3, 1)),
    ] {
        assert_eq!(slope(text), expected, "{text}");
    }
}

#[test]
fn irrational_numbers_stay_symbols() {
    let problem = read("sqrt(2)*x^2 + y^2/sqrt(2) + 3*sqrt(2)*z").unwrap();
    let texts: Vec<&str> = problem.symbols.iter().map(|s| s.text.as_str()).collect();
    assert_eq!(texts, ["sqrt(2)", "1/sqrt(2)"]);
    assert_eq!(problem.symbols[0].expr.evaluate(&[]), 2_f64.sqrt());
}

#[test]
fn deep_nesting_costs_no_stack() {
    let depth = 200_000;
    let nested = format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(slope(&nested), ratio(1, 1));
    assert_eq!(slope(&format!("{}x", "-".repeat(depth))), ratio(1, 1));
    assert!(read(&"(".repeat(depth)).is_err());
    assert!(read(&format!("x{}", "^2".repeat(depth))).is_err());
    let roots = format!("{}m{}*x", "sqrt(1 + ".repeat(1000), ")".repeat(1000));
    assert!(read(&roots).is_err());
}

#[test]
fn huge_sums_are_linear() {
    let sum = (0..20_000).map(|i| format!("{i}*x")).collect::<Vec<_>>().join(" + ");
    assert_eq!(slope(&sum), ratio(19_999 * 10_000, 1));
}

/// Pieces that make texts likely to be nearly right.
fn piece() -> impl Strategy<Value = String> {
    prop_oneof![
        Just("x".to_owned()),
        Just("y".to_owned()),
        Just("m".to_owned()),
        Just("w".to_owned()),
        Just("sqrt(".to_owned()),
        Just("sin".to_owned()),
        prop::sample::select(vec![
            "+", "-", "*", "/", "^", "**", "(", ")", ",", " ", "[0]", "ω", "²"
        ])
        .prop_map(str::to_owned),
        (0_u32..40).prop_map(|n| n.to_string()),
        Just("1.5e-3".to_owned()),
        Just("1e400".to_owned()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_text_panics(pieces in prop::collection::vec(piece(), 0..24)) {
        let text = pieces.concat();
        if let Err(errors) = read(&text) {
            prop_assert!(!errors.is_empty());
            prop_assert!(errors.render("h", &file(&text)).contains("error: "));
        }
    }

    #[test]
    fn no_file_panics(text in "(group|hamiltonian|\\[run\\]|=|\"|'|\n|SO3|x\\^2|[a-z0-9. \\[\\],])*") {
        let _ = system::read(&text, Options::default());
    }
}
