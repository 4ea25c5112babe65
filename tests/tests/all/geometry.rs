//! The formulas of groups: their series beside the closed forms, and the numbers they are evaluated in beside one another.

use coadjoint_geometry::angle::{Angle, Length};
use coadjoint_geometry::dual::{Dual, dual, parts};
use coadjoint_geometry::group::Group;
use coadjoint_geometry::motion::Motions;
use coadjoint_geometry::number::Number;
use coadjoint_geometry::rotation::Quaternions;
use coadjoint_geometry::row::Tuple;
use coadjoint_tests::stress::Random;

/// cos(θ/2), sin(θ/2)/θ, (1 − cos θ)/θ² and (θ − sin θ)/θ³ by the library's functions, for θ that is not small.
fn closed(theta: f64) -> [f64; 4] {
    let (sine, cosine) = theta.sin_cos();
    let (half_sine, half_cosine) = (0.5 * theta).sin_cos();
    let square = theta * theta;
    [half_cosine, half_sine / theta, (1.0 - cosine) / square, (theta - sine) / (square * theta)]
}

fn list(angle: Angle<f64>) -> [f64; 4] {
    [angle.half_cosine, angle.half_sine, angle.b, angle.c]
}

/// Both sides of every seam: a quarter turn, where lengths are chosen, and 1, where long ones take series for quotients.
#[test]
fn functions_of_an_angle_are_their_closed_forms_on_both_sides_of_the_seams() {
    for theta in [0.9, 0.999_999, 1.000_001, 1.5, 1.581, 1.582, 3.0, 6.2, 6.4, 12.5, 40.0] {
        let wanted = closed(theta);
        let long = list(Angle::new([theta], Length::Long));
        let any = list(Angle::new([theta], Length::Any));
        for k in 0..4 {
            // The closed forms lose digits by cancellation, as 1/θ² and 1/θ³ grow.
            let bound = 1e-15 * (1.0 + 1.0 / theta.powi(3)) * theta.max(1.0);
            assert!((long[k] - wanted[k]).abs() < bound, "{theta}: {long:?} {wanted:?}");
            assert!((any[k] - wanted[k]).abs() < bound, "{theta}: {any:?} {wanted:?}");
        }
        if theta * theta <= 2.5 {
            assert_eq!(any, list(Angle::new([theta], Length::Short)), "{theta}");
        }
    }
    // At 0, from the power series: 1, ½, ½, 1/6.
    assert_eq!(list(Angle::new([0.0], Length::Long)), [1.0, 0.5, 0.5, 1.0 / 6.0]);
    assert_eq!(list(Angle::new([0.0], Length::Any)), [1.0, 0.5, 0.5, 1.0 / 6.0]);
}

/// Among numbers side by side a long one must not change the others, nor they it.
#[test]
fn rows_have_the_bits_of_their_numbers() {
    let mut random = Random::new(7);
    for _ in 0..100 {
        let mut vector = |size: f64| std::array::from_fn(|_| size * random.between(-1.0, 1.0));
        let x: [[f64; 6]; 3] = [vector(0.5), vector(4.0), vector(1.5)];
        let mu: [[f64; 6]; 3] = [vector(1.0), vector(1.0), vector(1.0)];
        let row = |list: [[f64; 6]; 3]| -> [Tuple<f64, 3>; 6] {
            std::array::from_fn(|k| Tuple(std::array::from_fn(|i| list[i][k])))
        };
        let together = Motions::pull_back(row(x), row(mu), Length::Any);
        let rates = Motions::rates(row(x), row(mu), row(mu), 6);
        for i in 0..3 {
            let alone = Motions::pull_back(x[i], mu[i], Length::Any);
            let own_rates = Motions::rates(x[i], mu[i], mu[i], 6);
            for k in 0..6 {
                assert_eq!(together[k].0[i].to_bits(), alone[k].to_bits());
                assert_eq!(rates[1][k].0[i].to_bits(), own_rates[1][k].to_bits());
            }
        }
    }
}

/// The dual part of a value is its derivative, by central differences of fourth order.
#[test]
fn dual_parts_are_derivatives() {
    let x = [1.3, -0.7, 0.4];
    let along = [0.2, 0.9, -0.5];
    let mu = [0.3, -1.1, 0.8];
    let mut checked = 0;
    for scale in [0.3, 1.0, 2.5] {
        let at = |s: f64| -> [f64; 3] { std::array::from_fn(|i| scale * x[i] + s * along[i]) };
        let f = |x: [f64; 3]| Quaternions::<false>::pull_back(x, mu, Length::Any);
        let [a, b, c, d] = [2e-3, 1e-3, -1e-3, -2e-3].map(|s| f(at(s)));
        let still = dual(mu, [0.0; 3]);
        let (value, slope) =
            parts(Quaternions::<false>::pull_back(dual(at(0.0), along), still, Length::Any));
        for i in 0..3 {
            let difference = (8.0 * (b[i] - c[i]) - (a[i] - d[i])) / 12e-3;
            assert!((slope[i] - difference).abs() < 1e-10, "{scale}: {slope:?}, {difference}");
            assert!((value[i] - f(at(0.0))[i]).abs() < 1e-15);
            checked += 1;
        }
    }
    assert_eq!(checked, 9);
    // The operations by themselves: (√(a/b), |a|) at a = 2 + ε, b = 3 − ε.
    let (a, b) = (Dual { real: 2.0_f64, dual: 1.0 }, Dual { real: 3.0, dual: -1.0 });
    let root = (a / b).sqrt();
    assert!((root.real - (2.0_f64 / 3.0).sqrt()).abs() < 1e-16);
    // ½ (a/b)^{-1/2} (1·3 + 2)/9
    assert!((root.dual - 0.5 / root.real * 5.0 / 9.0).abs() < 2e-16);
    assert_eq!(((-a).abs().real, (-a).abs().dual), (2.0, 1.0));
}

/// J_R(x, p) is the momentum with (d^R exp_{−x})ᵀ J_R = p, by its definition.
#[test]
fn momenta_at_nodes_are_pulled_back_to_p() {
    let p = [0.4, -0.3, 0.7, 0.2, 0.5, -0.6];
    let x = [0.02, 0.05, -0.04, 0.03, -0.02, 0.06];
    // The series to x¹⁴ is exact to rounding here.
    let mu = Motions::momentum(x, p, 14);
    let back = Motions::pull_back(x.map(|entry| -entry), mu, Length::Short);
    for k in 0..6 {
        assert!((back[k] - p[k]).abs() < 4e-16, "{back:?} {p:?}");
    }
}
