//! Hamiltonians that are no polynomials, read as programs, and compared with the same function run by Rust.
#![allow(clippy::unwrap_used)]

use coadjoint_codegen::parse::rust;
use coadjoint_codegen::smooth::{Hamiltonian, Smooth};

pub fn read(arguments: &str, function: &str) -> Hamiltonian {
    let source = syn::parse_str(function).unwrap();
    rust::hamiltonian(arguments.parse().unwrap(), &source)
        .unwrap_or_else(|mistakes| panic!("{function}: {}", mistakes.into_syn_error()))
}

fn smooth(group: &str, function: &str) -> Smooth {
    match read(&format!("group = {group}"), function) {
        Hamiltonian::Smooth(smooth) => *smooth,
        Hamiltonian::Polynomial(..) => panic!("a polynomial: {function}"),
    }
}

/// Checks value and gradient at a point: the gradient by central differences of fourth order.
fn check(smooth: &Smooth, parameters: &[f64], mu: &[f64], expected: impl Fn(&[f64]) -> f64) {
    let symbols: Vec<f64> =
        smooth.symbols.iter().map(|symbol| symbol.expr.evaluate(parameters)).collect();
    let found = smooth.energy(&symbols, 0.0, mu);
    let value = expected(mu);
    assert!((found - value).abs() <= 1e-14 * (1.0 + value.abs()), "{found} is not {value}");
    for (i, slope) in smooth.gradient(&symbols, 0.0, mu).into_iter().enumerate() {
        let at = |shift: f64| {
            let mut mu = mu.to_vec();
            mu[i] += shift;
            expected(&mu)
        };
        let h = 1e-3;
        let difference = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
        let close = (slope - difference).abs() <= 1e-9 * (1.0 + slope.abs());
        assert!(close, "∂H/∂μ{i}: {slope} is not {difference}");
    }
    assert_eq!(smooth.undefined(&symbols, 0.0, mu), None);
}

/// Defines a function and checks that what is read computes what it computes.
macro_rules! same_as_rust {
    ($test:ident, $group:literal, $parameters:expr, $mu:expr, |$at:ident| $call:expr, $function:item) => {
        #[test]
        fn $test() {
            $function
            let smooth = smooth($group, stringify!($function));
            check(&smooth, &$parameters, &$mu, |$at| $call);
        }
    };
}

same_as_rust! {
    relativistic_body, "SO3", [1.5, 2.0, 2.5], [2.0, 0.5, 1.0],
    |mu| h([mu[0], mu[1], mu[2]], [1.5, 2.0, 2.5]),
    fn h(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        let mut sum = 1.0;
        for i in 0..3 {
            sum += mu[i] * mu[i] / inertia[i];
        }
        sum.sqrt()
    }
}

same_as_rust! {
    exponential_anisotropy, "SO3", [0.7, 0.3], [0.4, -0.5, 1.1],
    |mu| h([mu[0], mu[1], mu[2]], 0.7, 0.3),
    fn h(mu: [f64; 3], a: f64, b: f64) -> f64 {
        0.5 * mu[0] * mu[0] + a * (-mu[2] * mu[2] / b.sqrt()).exp() - (2.0 * b) * mu[1]
    }
}

same_as_rust! {
    six_variables, "SE3", [], [0.4, -0.5, 1.1, 0.3, 0.2, -0.9],
    |mu| h([mu[0], mu[1], mu[2], mu[3], mu[4], mu[5]]),
    fn h(mu: [f64; 6]) -> f64 {
        let [x, y, z, p, q, r] = mu;
        let root = (1.0 + x * x + 2.0 * y * y + z * z).sqrt();
        root + 1.0 / (2.0 + p * p + q * q).sqrt() + (-r * r).exp() * x
    }
}

same_as_rust! {
    all_functions, "SO3", [0.7, 2.0], [0.4, 0.5, 1.1],
    |mu| h([mu[0], mu[1], mu[2]], 0.7, 2.0),
    fn h(mu: [f64; 3], a: f64, n: f64) -> f64 {
        let [x, y, z] = mu;
        let first = (a * x).sin() * y.cos() + (x * y).tan() + z.atan() - (x + z).tanh();
        let second = (1.0 + y * y).ln() * z.exp() + x.powf(1.0 / 3.0) - z.powf(-1.5);
        first + second + x.powf(n) * y.powi(-2) + a.powf(z) / (x + y) + y.powf(x)
    }
}

#[test]
fn the_time_is_the_argument_said_to_be_it() {
    let body = "fn h(mu: [f64; 3], a: f64, s: f64) -> f64 { (a * s).sin() * mu[0] + mu[2] }";
    let smooth = smooth("SO3, time = s", body);
    assert!(smooth.moves && smooth.parameters.len() == 1);
    let value = smooth.energy(&[2.0], 0.7, &[0.4, 0.0, 1.0]);
    assert!((value - (1.0 + 1.4_f64.sin() * 0.4)).abs() < 1e-15, "{value}");
    // Otherwise `t` is a parameter like any other.
    let body = "fn h(mu: [f64; 3], t: f64) -> f64 { t * mu[0].powi(2) }";
    assert!(matches!(read("group = SO3", body), Hamiltonian::Polynomial(..)));
}

#[test]
fn polynomials_stay_polynomials() {
    let body = "fn h(mu: [f64; 3], a: f64) -> f64 { mu[0].powi(2) * a.exp().sqrt() + mu[1] / a }";
    assert!(matches!(read("group = SO3", body), Hamiltonian::Polynomial(..)));
}

#[test]
fn what_is_undefined_is_named_with_its_argument() {
    let body = "fn h(mu: [f64; 3], a: f64) -> f64 { (a - mu[0]).sqrt() + (mu[1] * 2.0).ln() + mu[2].powf(1.5) + 1.0 / (mu[0] - mu[1]) }";
    let smooth = smooth("SO3", body);
    let fault = |mu: [f64; 3]| {
        let (number, argument) = smooth.undefined(&[1.0], 0.0, &mu)?;
        Some((smooth.expressions[number].as_str(), argument))
    };
    assert_eq!(fault([0.5, 1.0, 1.0]), None);
    assert_eq!(fault([3.0, 1.0, 1.0]), Some(("sqrt(a - mu[0])", -2.0)));
    // Defined, but without a derivative.
    assert_eq!(fault([1.0, 2.0, 1.0]), Some(("sqrt(a - mu[0])", 0.0)));
    assert_eq!(fault([0.5, -1.0, 1.0]), Some(("ln(mu[1]*2)", -2.0)));
    assert_eq!(fault([0.5, 1.0, -0.25]), Some(("mu[2]^(3/2)", -0.25)));
    assert_eq!(fault([0.5, 1.0, 0.0]), None);
    assert_eq!(fault([0.5, 0.5, 1.0]), Some(("1/(mu[0] - mu[1])", 0.0)));
}
