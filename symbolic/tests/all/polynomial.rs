//! Polynomial arithmetic against a second implementation: a map from exponents to rationals.

use coadjoint_symbolic::number::Rational;
use coadjoint_symbolic::poly::Polynomial;
use num_bigint::BigInt;
use num_traits::{ToPrimitive, Zero};
use proptest::prelude::*;
use std::collections::BTreeMap;

pub type Naive = BTreeMap<Vec<u32>, Rational>;
pub type Terms = Vec<(Vec<u32>, Rational)>;

pub fn naive(terms: &Terms) -> Naive {
    let mut result = Naive::new();
    for (exponents, value) in terms {
        *result.entry(exponents.clone()).or_insert_with(Rational::zero) += value;
    }
    result.retain(|_, value| !value.is_zero());
    result
}

fn add(a: &Naive, b: &Naive) -> Naive {
    naive(&a.iter().chain(b).map(|(e, v)| (e.clone(), v.clone())).collect())
}

pub fn multiply(a: &Naive, b: &Naive) -> Naive {
    let mut terms = Terms::new();
    for (e, x) in a {
        for (f, y) in b {
            terms.push((e.iter().zip(f).map(|(i, j)| i + j).collect(), x * y));
        }
    }
    naive(&terms)
}

pub fn derivative(a: &Naive, index: usize) -> Naive {
    let mut terms = Terms::new();
    for (e, x) in a {
        if e[index] > 0 {
            let mut lowered = e.clone();
            lowered[index] -= 1;
            terms.push((lowered, x * Rational::from_integer(e[index].into())));
        }
    }
    naive(&terms)
}

/// The terms in the promised order: exponents descending lexicographically.
fn same(polynomial: &Polynomial, expected: &Naive) {
    let expected: Terms = expected.iter().rev().map(|(e, v)| (e.clone(), v.clone())).collect();
    assert_eq!(polynomial.terms().collect::<Vec<_>>(), expected);
    assert_eq!(polynomial.len(), expected.len());
    let degree = expected.iter().map(|(e, _)| e.iter().sum::<u32>()).max().unwrap_or(0);
    assert_eq!(polynomial.degree(), degree);
    let variables = polynomial.variables();
    assert_eq!(*polynomial, Polynomial::from_terms(variables, expected), "one representation");
}

/// Integers of up to about 300 bits, most of them small, many just around 2^127.
fn number() -> impl Strategy<Value = BigInt> {
    prop_oneof![
        6 => (-20_i64..20).prop_map(BigInt::from),
        1 => any::<i64>().prop_map(BigInt::from),
        1 => any::<i128>().prop_map(BigInt::from),
        1 => (-3_i64..3, 120_u32..140).prop_map(|(n, shift)| (BigInt::from(1) << shift) + n),
        1 => (any::<i128>(), any::<i128>()).prop_map(|(a, b)| BigInt::from(a) * b),
    ]
}

fn rational() -> impl Strategy<Value = Rational> {
    (number(), number()).prop_map(|(n, d)| {
        let d = if d.is_zero() { BigInt::from(1) } else { d };
        Rational::new(n, d)
    })
}

fn small() -> impl Strategy<Value = Rational> {
    (-9_i64..9, 1_i64..7).prop_map(|(n, d)| Rational::new(n.into(), d.into()))
}

/// Exponents of `variables` variables, few of them nonzero, some too large to be packed.
fn exponents(variables: usize) -> impl Strategy<Value = Vec<u32>> {
    let exponent = prop_oneof![8 => 0_u32..4, 1 => 0_u32..40, 1 => 0_u32..100_000];
    proptest::collection::vec((0..variables, exponent), 0..4).prop_map(move |factors| {
        let mut exponents = vec![0; variables];
        for (variable, exponent) in factors {
            exponents[variable] = exponent;
        }
        exponents
    })
}

fn pair(
    coefficient: fn() -> BoxedStrategy<Rational>,
) -> impl Strategy<Value = (usize, Terms, Terms)> {
    prop_oneof![Just(1_usize), Just(3), Just(6), Just(10), Just(31), Just(33), Just(40)]
        .prop_flat_map(move |variables| {
            let terms = || proptest::collection::vec((exponents(variables), coefficient()), 0..12);
            (Just(variables), terms(), terms())
        })
}

fn check(variables: usize, a: &Terms, b: &Terms) {
    let (x, y) = (
        Polynomial::from_terms(variables, a.clone()),
        Polynomial::from_terms(variables, b.clone()),
    );
    let (p, q) = (naive(a), naive(b));
    same(&x, &p);
    same(&(&x + &y), &add(&p, &q));
    same(&(&x * &y), &multiply(&p, &q));
    let minus = Rational::from_integer((-1).into());
    let negative: Naive = q.iter().map(|(e, v)| (e.clone(), v * &minus)).collect();
    same(&-&y, &negative);
    same(&(&x - &y), &add(&p, &negative));
    same(&(&x - &x.clone()), &Naive::new());
    let index = variables / 2;
    same(&x.derivative(index), &derivative(&p, index));
    assert_eq!(x.gradient(variables)[index], x.derivative(index));
    same(&x.pow(3), &multiply(&multiply(&p, &p), &p));
    if let Some((_, factor)) = b.first() {
        let scaled = p.iter().map(|(e, v)| (e.clone(), v * factor)).filter(|t| !t.1.is_zero());
        same(&x.scale(factor), &scaled.collect());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn small_coefficients((variables, a, b) in pair(|| small().boxed())) {
        check(variables, &a, &b);
    }

    #[test]
    fn coefficients_beyond_machine_integers((variables, a, b) in pair(|| rational().boxed())) {
        check(variables, &a, &b);
    }

    #[test]
    fn evaluation((_, a, _) in pair(|| small().boxed()), x in -1.0_f64..1.0) {
        let variables = a.first().map_or(1, |(e, _)| e.len());
        // Powers small enough to stay finite.
        let a: Terms =
            a.into_iter().map(|(e, v)| (e.iter().map(|e| e % 9).collect(), v)).collect();
        let polynomial = Polynomial::from_terms(variables, a.clone());
        let point: Vec<f64> = (0..variables).map(|i| x * (1.0 + i as f64 / 50.0)).collect();
        let mut expected = 0.0;
        let mut size = 0.0;
        for (exponents, value) in naive(&a) {
            let mut term = value.to_f64().unwrap();
            for (e, x) in exponents.iter().zip(&point) {
                term *= x.powi(*e as i32);
            }
            expected += term;
            size += term.abs();
        }
        prop_assert!((polynomial.evaluate(&point) - expected).abs() <= 1e-9 * size);
    }
}

#[test]
fn sums_at_the_edge_of_machine_integers() {
    // (2^63 x + 2^63 y)^2 has the coefficients 2^126, 2^127, 2^126: the middle one is too large.
    let half = Rational::from_integer(BigInt::from(1) << 63);
    let sum = &Polynomial::variable(2, 0) + &Polynomial::variable(2, 1);
    let terms: Terms = sum.scale(&half).pow(2).terms().collect();
    let power = |n: u32| Rational::from_integer(BigInt::from(1) << n);
    assert_eq!(
        terms,
        [(vec![2, 0], power(126)), (vec![1, 1], power(127)), (vec![0, 2], power(126))]
    );
}
