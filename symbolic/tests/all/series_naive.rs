//! The recurrence against a second implementation, for random Hamiltonians.
//!
//! Here S is one polynomial in p and t, of the second implementation that `polynomial` has, every order is
//! computed from the beginning with Bernoulli numbers from a table, and nothing is skipped.

use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive};
use coadjoint_symbolic::lie::{Chart, LieAlgebra, catalogue};
use coadjoint_symbolic::number::{Rational, integer, ratio};
use coadjoint_symbolic::poly::Polynomial;
use num_traits::One;
use proptest::prelude::*;

use crate::polynomial::{self, Naive, derivative};

/// Exponents of p_1 … p_n and, last, of t.
type Series = Naive;

fn add(a: &Series, b: &Series, factor: &Rational) -> Series {
    let scaled = b.iter().map(|(exponents, value)| (exponents.clone(), value * factor));
    polynomial::naive(&a.clone().into_iter().chain(scaled).collect())
}

/// The product up to t^`order`.
fn multiply(a: &Series, b: &Series, order: u32) -> Series {
    let mut product = polynomial::multiply(a, b);
    product.retain(|exponents, _| exponents.last().is_some_and(|t| *t <= order));
    product
}

fn variable(n: usize, index: usize) -> Series {
    let mut exponents = vec![0; n + 1];
    exponents[index] = 1;
    Series::from([(exponents, Rational::one())])
}

/// Σ_k (−1)^k B_k/k! (ad_x^T)^k p up to t^`order` ≤ 6, (ad_x^T w)_j = Σ c_ij^l x_i w_l.
fn body_momentum(algebra: &LieAlgebra, x: &[Series], order: u32) -> Vec<Series> {
    let n = algebra.dim();
    let weights =
        [(1, 1), (1, 2), (1, 12), (0, 1), (-1, 720), (0, 1), (1, 30240)].map(|(a, b)| ratio(a, b));
    let mut power: Vec<Series> = (0..n).map(|i| variable(n, i)).collect();
    let mut result = vec![Series::new(); n];
    for weight in &weights {
        let mut next = vec![Series::new(); n];
        for i in 0..n {
            result[i] = add(&result[i], &power[i], weight);
        }
        for c in algebra.structure() {
            next[c.j] = add(&next[c.j], &multiply(&x[c.i], &power[c.k], order), &c.value);
        }
        power = next;
    }
    result
}

fn naive(algebra: &LieAlgebra, h: &Polynomial, truncation: u32) -> Series {
    let n = algebra.dim();
    let mut s = Series::new();
    for k in 1..=truncation {
        let x: Vec<Series> = (0..n).map(|i| derivative(&s, i)).collect();
        let momentum = body_momentum(algebra, &x, k - 1);
        let mut energy = Series::new();
        for (exponents, value) in h.terms() {
            let mut term = Series::from([(vec![0; n + 1], value)]);
            for (i, e) in exponents.iter().enumerate() {
                for _ in 0..*e {
                    term = multiply(&term, &momentum[i], k - 1);
                }
            }
            energy = add(&energy, &term, &Rational::one());
        }
        for (mut exponents, value) in energy.into_iter().filter(|(e, _)| e[n] == k - 1) {
            exponents[n] = k;
            s.insert(exponents, value / integer(i64::from(k)));
        }
    }
    s
}

/// A Hamiltonian of degree at most three in `n` variables with a few terms.
fn hamiltonian(n: usize) -> impl Strategy<Value = Polynomial> {
    let coefficient = (-5_i64..6, 1_i64..8).prop_map(|(a, b)| ratio(a, b));
    let factors = proptest::collection::vec(0..n as u32, 1..4);
    proptest::collection::vec((factors, coefficient), 1..6).prop_map(move |terms| {
        let terms = terms.into_iter().map(|(factors, value)| {
            (factors.into_iter().map(|variable| (variable, 1)).collect(), value)
        });
        Polynomial::from_factors(n, terms)
    })
}

fn check(algebra: &LieAlgebra, h: &Polynomial, truncation: u32) {
    let n = algebra.dim();
    let expected = naive(algebra, h, truncation);
    let limit = TermLimit::default();
    let series = derive(algebra, Chart::Exponential, h, truncation as usize, limit).unwrap();
    for k in 1..=truncation {
        let part = expected.iter().filter(|(e, _)| e[n] == k);
        let part = part.map(|(e, value)| (e[..n].to_vec(), value.clone()));
        assert_eq!(*series.order(k as usize), Polynomial::from_terms(n, part), "S_{k} of {h:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn three_dimensional_algebras(
        name in prop_oneof![Just("SO3"), Just("SL2"), Just("SE2"), Just("Heisenberg")],
        h in hamiltonian(3),
    ) {
        check(&catalogue::lookup(name).unwrap(), &h, 4);
    }

    #[test]
    fn euclidean_motions(h in hamiltonian(6)) {
        check(&catalogue::lookup("SE3").unwrap(), &h, 3);
    }
}

#[test]
fn high_order_of_the_rigid_body() {
    let h = Polynomial::from_factors(
        3,
        [(0, 3), (1, 4), (2, 5)].map(|(i, d)| (vec![(i, 2)], ratio(1, d))),
    );
    check(&catalogue::lookup("SO3").unwrap(), &h, 7);
}
