//! The defining equations, checked as identities of polynomials.

use crate::hamilton_jacobi::chart::{Composition, Inverse, Series, Side, Work};
use crate::hamilton_jacobi::{Derivation, TermLimit, derive, estimate, predictor};
use crate::lie::{Chart, LieAlgebra, catalogue};
use crate::number::{integer, ratio};
use crate::poly::{Arithmetic, Polynomial};
use num_traits::ToPrimitive;
use std::collections::BTreeMap;

/// A Hamiltonian of degree three with every kind of term, in `extra` further symbols.
fn hamiltonian(dimension: usize, extra: usize) -> Polynomial {
    let variables = dimension + extra;
    let mut h = Polynomial::zero(variables);
    for i in 0..dimension {
        let a = Polynomial::variable(variables, i);
        let b = Polynomial::variable(variables, (i + 1) % dimension);
        let mut square = (&a * &a).scale(&ratio(1, 3 + i as i64));
        if extra > 0 {
            square = &square * &Polynomial::variable(variables, dimension + i % extra);
        }
        h = &(&h + &square) + &(&a * &b).scale(&ratio(1, 7 + i as i64));
    }
    let first = Polynomial::variable(variables, 0);
    let last = Polynomial::variable(variables, dimension - 1);
    let cubic = &(&first * &first) * &last;
    &(&h + &last.scale(&ratio(2, 5))) + &cubic.scale(&ratio(1, 11))
}

/// Unequal squares, coupled to the next.
fn squares(n: usize) -> Polynomial {
    let terms = (0..n as u32).flat_map(|i| {
        let next = (i + 1) % n as u32;
        let square = (vec![(i, 2)], ratio(1, 2 + i64::from(i)));
        [square, (vec![(i, 1), (next, 1)], ratio(1, 5))]
    });
    Polynomial::from_factors(n, terms)
}

/// An algebra of no particular fame: a and the plane (b, c) it turns and stretches.
fn unseen() -> LieAlgebra {
    LieAlgebra::from_brackets(
        "unseen",
        ["a", "b", "c"].map(String::from).to_vec(),
        [
            (0, 1, vec![(2, integer(1)), (1, ratio(1, 3))]),
            (0, 2, vec![(1, ratio(-1, 2)), (2, ratio(1, 3))]),
        ],
    )
    .unwrap()
}

/// The heavy top with symbols for 1/I_1 and for the weight.
fn heavy_top() -> Polynomial {
    let h = [([0, 0, 6], 1, 2), ([1, 1, 8], 1, 4), ([2, 2, 8], 1, 5), ([5, 7, 8], 1, 1)];
    let terms = h.map(|(factors, n, d)| (factors.map(|v| (v, 1)).to_vec(), ratio(n, d)));
    // Variable 8 stands for one.
    let h = Polynomial::from_factors(9, terms);
    Polynomial::from_terms(8, h.terms())
}

/// J_L(x, p) = J_R(−x, p) at x = ∂S/∂p(p) with p(t) from the exact flow is μ′ through t^{K+1}.
fn spatial_momentum_is_initial(algebra: &LieAlgebra, chart: Chart, h: &Polynomial) {
    let dimension = algebra.dim();
    let k = 3;
    let limit = TermLimit::default();
    let variables = h.variables();
    let series = derive(algebra, chart, h, k, limit).unwrap();
    let last = k + 1;
    let rows = predictor(algebra, chart, h, last, limit).unwrap();
    let p: Vec<Series> =
        (0..dimension).map(|i| rows.iter().map(|row| row[i].clone()).collect()).collect();
    let gradients: Vec<Polynomial> =
        (1..=k).flat_map(|order| series.order(order).gradient(dimension)).collect();
    let mut work = Work::new(variables, limit, Arithmetic::Exact);
    let mut composed = Composition::new(dimension, &gradients).unwrap();
    for order in 0..=last {
        composed.extend(&mut work, &p, order).unwrap();
    }
    let mut spatial = Inverse::new(algebra, chart, Side::Dual).unwrap();
    let mut back: Vec<Series> = vec![vec![Polynomial::zero(variables)]; dimension];
    for order in 0..=last {
        for (i, back) in back.iter_mut().enumerate().filter(|_| order > 0) {
            let mut x = Polynomial::zero(variables);
            for j in 1..=order.min(k) {
                x = &x - composed.coefficient((j - 1) * dimension + i, order - j);
            }
            back.push(x);
        }
        let found = spatial.extend(&mut work, (&back, &p), order).unwrap();
        for (i, found) in found.iter().enumerate() {
            let expected = match order {
                0 => Polynomial::variable(variables, i),
                _ => Polynomial::zero(variables),
            };
            assert_eq!(*found, expected, "{} {chart} t^{order}", algebra.name());
        }
    }
}

#[test]
fn predictor_solves_for_the_chart_momentum() {
    let so3 = catalogue::lookup("SO3").unwrap();
    for chart in [Chart::Exponential, Chart::Cayley] {
        spatial_momentum_is_initial(&so3, chart, &hamiltonian(3, 0));
        spatial_momentum_is_initial(&so3, chart, &hamiltonian(3, 2));
        for name in ["SU2", "SE2", "SL2", "Heisenberg"] {
            let algebra = catalogue::lookup(name).unwrap();
            spatial_momentum_is_initial(&algebra, chart, &squares(algebra.dim()));
        }
        let pair = catalogue::lookup("SO3*SE2").unwrap();
        spatial_momentum_is_initial(&pair, chart, &squares(6));
        spatial_momentum_is_initial(&catalogue::lookup("SE3").unwrap(), chart, &heavy_top());
    }
    spatial_momentum_is_initial(&unseen(), Chart::Exponential, &hamiltonian(3, 1));
}

#[test]
fn even_orders_vanish() {
    let so3 = catalogue::lookup("SO3").unwrap();
    let cases = [
        (so3.clone(), Chart::Exponential),
        (so3, Chart::Cayley),
        (catalogue::lookup("SE3").unwrap(), Chart::Cayley),
        (unseen(), Chart::Exponential),
    ];
    for (algebra, chart) in cases {
        let h = hamiltonian(algebra.dim(), 1);
        let limit = TermLimit::default();
        let mut all = Derivation::new(&algebra, chart, &h, limit, Arithmetic::Exact).unwrap();
        (1..=6).for_each(|k| all.extend(k, false).unwrap());
        let all = all.series();
        assert!(!all.order(5).is_zero());
        for k in [2, 4, 6] {
            assert!(all.order(k).is_zero(), "{} {chart} S_{k}", algebra.name());
        }
        assert_eq!(all, derive(&algebra, chart, &h, 6, limit).unwrap());
    }
}

/// With coefficients of many digits and of many sizes, an estimate has no monomials but those of the exact series, with ten digits of
/// each coefficient, and lacks none but of terms that nearly cancel.
#[test]
fn estimates_have_the_terms_of_the_exact_series() {
    let se3 = catalogue::lookup("SE3").unwrap();
    let digits = |i: i64| ratio(1_234_567_890_123_457 + 987_654_321 * i, 10_i64.pow(15));
    let mut h = Polynomial::zero(6);
    for i in 0..6 {
        let a = Polynomial::variable(6, i);
        let scale = ratio(1, 10_i64.pow(2 * i as u32));
        h = &h + &(&a * &a).scale(&(&digits(i as i64) * &scale));
        h = &h + &(&a * &Polynomial::variable(6, (i + 1) % 6)).scale(&digits(7 + i as i64));
    }
    let limit = TermLimit::default();
    let exact = derive(&se3, Chart::Exponential, &h, 5, limit).unwrap();
    let found = estimate(&se3, Chart::Exponential, &h, [5, 5], limit).unwrap();
    assert_ne!(exact, found);
    for k in [1, 3, 5] {
        let terms = |own: &Polynomial| -> BTreeMap<Vec<(u32, u32)>, f64> {
            own.factors().map(|(key, value)| (key, value.to_f64().unwrap())).collect()
        };
        let (exact, mut found) = (terms(exact.order(k)), terms(found.order(k)));
        let largest = exact.values().fold(0.0, |most: f64, value| most.max(value.abs()));
        for (key, a) in exact {
            let b = found.remove(&key).unwrap_or(0.0);
            // Those of terms that cancel in part have fewer digits.
            let rounded = f64::max(1e-10 * a.abs(), 1e-14 * largest);
            let bound = if b == 0.0 { 1e-11 * largest } else { rounded };
            assert!((a - b).abs() <= bound, "S{k}, {key:?}: {a:e}, {b:e}");
        }
        assert!(found.is_empty(), "S{k}: {found:?}");
    }
}
