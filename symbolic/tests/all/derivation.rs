//! Sizes, values and limits of derivations.

use coadjoint_symbolic::hamilton_jacobi::{DeriveError, TermLimit, derive, predictor};
use coadjoint_symbolic::lie::{Chart, LieAlgebra, catalogue};
use coadjoint_symbolic::number::{Rational, integer, ratio};
use coadjoint_symbolic::poly::Polynomial;

fn quadratic(variables: usize, terms: &[(usize, usize, i64, i64)]) -> Polynomial {
    Polynomial::from_factors(
        variables,
        terms.iter().map(|&(i, j, n, d)| (vec![(i as u32, 1), (j as u32, 1)], ratio(n, d))),
    )
}

/// I = (1.5, 2, 2.5): H = x²/3 + y²/4 + z²/5.
fn rigid_body() -> Polynomial {
    quadratic(3, &[(0, 0, 1, 3), (1, 1, 1, 4), (2, 2, 1, 5)])
}

fn heavy_top() -> Polynomial {
    let body = quadratic(6, &[(0, 0, 1, 3), (1, 1, 1, 4), (2, 2, 1, 5)]);
    &body + &Polynomial::variable(6, 5)
}

fn counts(group: &str, chart: Chart, h: &Polynomial, truncation: usize) -> Vec<usize> {
    let algebra = catalogue::lookup(group).unwrap();
    let series = derive(&algebra, chart, h, truncation, TermLimit::default()).unwrap();
    (1..=truncation).step_by(2).map(|k| series.order(k).len()).collect()
}

/// A flag set by another thread ends derivations where they are; work without a flag goes on.
#[test]
fn cancelled_derivations_unwind() {
    use coadjoint_symbolic::cancel::{Cancelled, scope};
    use std::sync::{Arc, atomic::AtomicBool};

    let so3 = catalogue::lookup("SO3").unwrap();
    let limit = TermLimit::default();
    let work = |stop: bool| {
        let derivation = || derive(&so3, Chart::Exponential, &rigid_body(), 7, limit).unwrap();
        std::panic::catch_unwind(|| scope(Arc::new(AtomicBool::new(stop)), derivation))
    };
    assert!(work(true).unwrap_err().is::<Cancelled>());
    assert!(work(false).is_ok());
    derive(&so3, Chart::Exponential, &rigid_body(), 7, limit).unwrap();
}

#[test]
fn terms_per_order() {
    // Counts from the table "Terms per S_k" of the mathematics notes (docs: chart and order).
    let body = rigid_body();
    assert_eq!(counts("SO3", Chart::Exponential, &body, 15), [3, 3, 7, 12, 18, 25, 33, 42]);
    assert_eq!(counts("SO3", Chart::Cayley, &body, 7), [3, 6, 10, 15]);
    assert_eq!(counts("SE3", Chart::Exponential, &heavy_top(), 7), [4, 7, 28, 77]);
    assert_eq!(counts("SE3", Chart::Cayley, &heavy_top(), 7), [4, 12, 34, 82]);
    let full = &body + &quadratic(3, &[(0, 1, 1, 7), (0, 2, 1, 11), (1, 2, 1, 13)]);
    assert_eq!(counts("SO3", Chart::Exponential, &full, 11), [6, 15, 28, 45, 66, 91]);
}

#[test]
fn homogeneous_orders() {
    // S_k has degree k (d − 1) + 1 for H homogeneous of degree d; here d = 4.
    let so3 = catalogue::lookup("SO3").unwrap();
    let h = &rigid_body().pow(2) + &quadratic(3, &[(0, 1, 1, 7)]).pow(2);
    let series = derive(&so3, Chart::Exponential, &h, 5, TermLimit::default()).unwrap();
    for k in [1, 3, 5] {
        assert!(series.order(k).terms().all(|(e, _)| e.iter().sum::<u32>() == 3 * k as u32 + 1));
        assert!(!series.order(k).is_zero());
    }
}

#[test]
fn predictor_of_the_rigid_body() {
    let so3 = catalogue::lookup("SO3").unwrap();
    let limit = TermLimit::default();
    let rows = predictor(&so3, Chart::Exponential, &rigid_body(), 6, limit).unwrap();
    for component in 0..3 {
        let sizes: Vec<usize> = rows.iter().map(|row| row[component].len()).collect();
        assert_eq!(sizes, [1, 1, 2, 3, 5, 6, 9]);
    }
    // Values of the hand-written prototype with the same series through t⁶ (f64).
    let cases = [
        (0.1, [2.0, 0.5, 1.0], [1.9971774549335621, 0.5265801424615563, 0.9918341936034715]),
        (0.5, [1.2, 2.5, 0.6], [1.1559658236176586, 2.5446635937603417, 0.48208777922427165]),
        (0.3, [-1.0, 0.7, 2.0], [-1.015127474645246, 0.617548655061713, 2.0188321728543235]),
    ];
    for (h, mu, expected) in cases {
        for (component, value) in expected.into_iter().enumerate() {
            let mut p = 0.0;
            for (m, row) in rows.iter().enumerate() {
                p += row[component].evaluate(&mu) * f64::powi(h, m as i32);
            }
            assert!((p - value).abs() < 1e-14, "{component}: {p} is not {value}");
        }
    }
}

#[test]
fn symbols_specialise_to_numbers() {
    // Symbols (1/I_i) for the rigid body, then their values 2/3, 1/2, 2/5 put in.
    let so3 = catalogue::lookup("SO3").unwrap();
    let values = [ratio(2, 3), ratio(1, 2), ratio(2, 5)];
    let symbolic =
        Polynomial::from_factors(6, (0..3).map(|i| (vec![(i, 2), (i + 3, 1)], ratio(1, 2))));
    let put_in = |p: &Polynomial| {
        Polynomial::from_terms(
            3,
            p.terms().map(|(e, mut value)| {
                for (i, v) in values.iter().enumerate() {
                    value *= v.pow(e[3 + i] as i32);
                }
                (e[..3].to_vec(), value)
            }),
        )
    };
    for chart in [Chart::Exponential, Chart::Cayley] {
        let limit = TermLimit::default();
        let general = derive(&so3, chart, &symbolic, 7, limit).unwrap();
        let special = derive(&so3, chart, &rigid_body(), 7, limit).unwrap();
        for k in 1..=7 {
            assert_eq!(put_in(general.order(k)), *special.order(k));
        }
        let general = predictor(&so3, chart, &symbolic, 5, limit).unwrap();
        let special = predictor(&so3, chart, &rigid_body(), 5, limit).unwrap();
        for (row, expected) in general.iter().zip(&special) {
            let row: Vec<_> = row.iter().map(put_in).collect();
            assert_eq!(row, *expected);
        }
    }
}

#[test]
fn abelian_flow_is_linear_in_time() {
    let plane = LieAlgebra::from_structure_constants("R2", 2, []).unwrap();
    let h = &quadratic(2, &[(0, 0, 1, 2), (0, 1, 1, 3)]) + &Polynomial::variable(2, 1).pow(4);
    let series = derive(&plane, Chart::Exponential, &h, 5, TermLimit::default()).unwrap();
    assert_eq!(*series.order(1), h);
    assert!((2..=5).all(|k| series.order(k).is_zero()));
}

#[test]
fn limits_stop_early() {
    let se3 = catalogue::lookup("SE3").unwrap();
    let h = &heavy_top().pow(3) + &Polynomial::variable(6, 3).pow(7);
    let error = derive(&se3, Chart::Exponential, &h, 31, TermLimit::new(500)).unwrap_err();
    match error {
        DeriveError::TooLarge { order, terms, limit } => {
            assert_eq!(limit, 500);
            assert!(terms > 500 && order <= 31);
        }
        DeriveError::TooMuchWork { products, limit, .. } => assert!(products > limit),
        other => panic!("{other}"),
    }
    let little = TermLimit { terms: 1_000_000, products: 1000 };
    let error = derive(&se3, Chart::Exponential, &h, 31, little).unwrap_err();
    assert!(matches!(error, DeriveError::TooMuchWork { limit: 1000, .. }), "{error}");
    assert!(predictor(&se3, Chart::Exponential, &h, 31, little).is_err());
}

#[test]
fn long_truncations_of_nothing_end() {
    // S = t H for a linear H on an abelian algebra, and for a Casimir: nothing to do, for ever.
    let so3 = catalogue::lookup("SO3").unwrap();
    let h = Polynomial::variable(3, 0);
    let limit = TermLimit::new(100);
    let error = derive(&so3, Chart::Exponential, &h, 1_000_001, limit).unwrap_err();
    assert!(matches!(error, DeriveError::TooMuchWork { .. }), "{error}");
    let steep = Polynomial::from_factors(3, [(vec![(0, u32::MAX)], ratio(1, 2))]);
    let error = derive(&so3, Chart::Exponential, &steep, 5, TermLimit::default()).unwrap_err();
    assert!(matches!(error, DeriveError::Degree { degree: u32::MAX, .. }), "{error}");
}

#[test]
fn hamiltonian_needs_all_momenta() {
    let se3 = catalogue::lookup("SE3").unwrap();
    let error = derive(&se3, Chart::Exponential, &rigid_body(), 3, TermLimit::default());
    assert_eq!(error.unwrap_err(), DeriveError::Variables { variables: 3, dimension: 6 });
}

#[test]
fn long_truncations_leave_machine_integers() {
    // S_31 of the rigid body: denominators beyond 2^127, still exact. The flow of H = |μ|²/2 is
    // a rotation about μ, so adding it changes S by t|p|²/2 only.
    let so3 = catalogue::lookup("SO3").unwrap();
    let limit = TermLimit::default();
    let ball = quadratic(3, &[(0, 0, 1, 2), (1, 1, 1, 2), (2, 2, 1, 2)]);
    let s = derive(&so3, Chart::Exponential, &ball, 31, limit).unwrap();
    assert_eq!(*s.order(1), ball);
    assert!((2..=31).all(|k| s.order(k).is_zero()));
    let s = derive(&so3, Chart::Exponential, &rigid_body(), 23, limit).unwrap();
    let largest = s.order(23).terms().map(|(_, c): (_, Rational)| c.denom().bits()).max();
    assert!(largest > Some(100), "{largest:?}");
    assert!(s.order(23).terms().all(|(e, _)| e.iter().sum::<u32>() == 24));
    assert_eq!(integer(0), ratio(0, 1));
}
