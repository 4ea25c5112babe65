//! The runtime's closed forms agree with table-driven groups of the same basis.
#![allow(clippy::unwrap_used)]

use coadjoint::groups::{Coordinates, SE2, SU2};
use coadjoint::{LieGroup, SE3, SO3};
use coadjoint_tests::bridge::named;
use coadjoint_tests::stress::Random;
use nalgebra::DVector;

fn gap(a: &impl Coordinates<f64>, b: &DVector<f64>) -> f64 {
    (0..b.len()).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// Compares along a direction, from 0 to beyond a full turn of its rotation part.
fn agree<G: LieGroup<Scalar = f64>>(closed: &G, name: &str) {
    let table = named(name);
    let n = table.dim();
    let fixed = |v: &[f64]| G::Vector::from_entries(n, |i| v[i]);
    let mut random = Random::new(7);
    let mut numbers = || -> Vec<f64> { (0..n).map(|_| random.between(-1.0, 1.0)).collect() };
    for _ in 0..4 {
        let (direction, mu) = (numbers(), numbers());
        let turning: f64 = direction.iter().take(3.min(n)).map(|v| v * v).sum::<f64>().sqrt();
        for angle in [
            0.0, 1e-10, 1e-5, 0.01, 0.5, 1.4999, 1.5001, 2.0, 2.39, 2.41, 3.1, 3.2, 4.79, 4.81,
            5.0, 6.25, 6.3, 7.0, 20.0, 40.0, 80.0,
        ] {
            let x: Vec<f64> = direction.iter().map(|v| v * angle / turning).collect();
            let what = format!("{name} at {angle}");
            let (xf, muf) = (fixed(&x), fixed(&mu));
            let (xd, mud) = (DVector::from_vec(x), DVector::from_vec(mu.clone()));
            let bound = 3e-14 * (1.0 + angle * angle);

            let (g, moved) = closed.exp_transport(&xf, &muf);
            let (gd, movedd) = table.exp_transport(&xd, &mud);
            for i in 0..table.matrix_size() {
                for j in 0..table.matrix_size() {
                    let d = (closed.matrix_entry(&g, i, j) - gd[(i, j)]).abs();
                    assert!(d <= bound, "{what}: exp differs by {d:e}");
                }
            }
            assert!(gap(&moved, &movedd) <= bound, "{what}: transport");
            let carried = closed.coadjoint(&g, &muf);
            assert!(gap(&carried, &table.coadjoint(&gd, &mud)) <= bound, "{what}: Ad*");
            let carried = closed.adjoint(&g, &muf);
            assert!(gap(&carried, &table.adjoint(&gd, &mud)) <= bound, "{what}: Ad");

            let p = closed.dexp_transpose(&xf, &muf);
            assert!(gap(&p, &table.dexp_transpose(&xd, &mud)) <= bound, "{what}: dexp");
            if angle < 3.12 {
                let (log, logd) = (closed.log(&g).unwrap(), table.log(&gd).unwrap());
                let bound = bound * (1.0 + 1.0 / (std::f64::consts::PI - angle));
                assert!(gap(&log, &logd) <= bound, "{what}: log {:e}", gap(&log, &logd));
            }
        }
    }
}

#[test]
fn closed_forms_agree_with_the_catalogue() {
    agree(&SO3::new(), "SO3");
    agree(&SU2::new(), "SU2");
    agree(&SE2::new(), "SE2");
    agree(&SE3::new(), "SE3");
}
