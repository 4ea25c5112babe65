//! The judge: steps that are known, and steps that are wrong on purpose. `tests/tests/all/systems_reference.rs` compares its motions
//! with end states computed elsewhere.

use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive};
use coadjoint_symbolic::judge::{Branch, DoubleDouble, Inside, Judge};
use coadjoint_symbolic::lie::{Chart, catalogue::lookup};
use coadjoint_symbolic::number::ratio;
use coadjoint_symbolic::poly::Polynomial;

const UNIT: f64 = f64::EPSILON / 2.0;

fn body(inverse: [(i64, i64); 3]) -> Polynomial {
    let terms = (0..3).map(|i| (vec![(i as u32, 2)], ratio(inverse[i].0, inverse[i].1)));
    Polynomial::from_factors(3, terms)
}

fn judge(chart: Chart, h: &Polynomial, truncation: usize) -> Judge {
    let so3 = lookup("SO3").unwrap();
    let series = derive(&so3, chart, h, truncation, TermLimit::default()).unwrap();
    Judge::new(&so3, &series).unwrap()
}

/// On a spherical body S = h|μ|²/2I exactly, and x = hμ/I whatever its length.
#[test]
fn a_spherical_body_turns_uniformly() {
    let judge = judge(Chart::Exponential, &body([(1, 2), (1, 2), (1, 2)]), 5);
    for scale in [1e-300, 1e-30, 1.0, 1e30, 1e290] {
        let mu = [0.3 * scale, -0.4 * scale, 1.2 * scale];
        for angle in [1e-6, 0.5, 2.0, 3.0] {
            let mut setting = judge.at(angle / scale / 1.3, &[]).unwrap();
            let step = setting.step(&mu).unwrap();
            let right = step.right_solution().unwrap();
            let x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
            for (x, mu) in x.iter().zip(mu) {
                assert!((x - angle / 1.3 * mu / scale).abs() < 1e-14 * angle, "{scale:e} {angle}");
            }
            let point = step.at(&x).unwrap();
            assert!(point.residual(UNIT).relative() < 1.0);
            assert_eq!(step.inside(&x), Inside::Yes);
            assert!(matches!(point.branch().0, Branch::Right));
        }
    }
}

/// Beyond a half turn x is outside; an x that is off by more than rounding does not solve the equation.
#[test]
fn wrong_steps_are_told() {
    let judge = judge(Chart::Exponential, &body([(1, 3), (1, 4), (1, 5)]), 7);
    let mut setting = judge.at(0.2, &[]).unwrap();
    let step = setting.step(&[2.0, 0.5, 1.0]).unwrap();
    let right = step.right_solution().unwrap();
    let mut x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
    let point = step.at(&x).unwrap();
    assert!(point.residual(UNIT).relative() < 0.1);
    assert!(point.series_ratio(UNIT).unwrap() < 0.1);
    assert_eq!(point.branch().0, Branch::Right);
    x[0] += 1e-13;
    let point = step.at(&x).unwrap();
    assert!(point.residual(UNIT).relative() > 1.0);
    assert!(point.residual(2_f64.powi(-24)).relative() < 1.0);
    assert!(matches!(step.inside(&[0.0, 3.2, 0.0]), Inside::No(_)));
    assert!(step.at(&[f64::NAN, 0.0, 0.0]).is_err());
    assert!(setting.step(&[f64::INFINITY, 0.0, 0.0]).is_err());
    assert!(setting.step(&[1.0, 0.0]).is_err());
}

/// Sums of 106 bits: (a + b)(a − b) = a² − b² for numbers 2⁻⁴⁰ apart, and 1/3 to 31 digits.
#[test]
fn doubled_precision() {
    let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
    let left = third * DoubleDouble::from(3.0) - DoubleDouble::from(1.0);
    assert!(left.to_f64().abs() < 1e-31);
    let (a, b) = (DoubleDouble::from(1.0 + 2_f64.powi(-40)), third);
    let difference = (a + b) * (a - b) - (a * a - b * b);
    assert!(difference.to_f64().abs() < 1e-31);
    // 2⁻⁹⁰ is not lost beside 1.
    let small = DoubleDouble::from(2_f64.powi(-90));
    assert_eq!(
        (DoubleDouble::from(1.0) + small - DoubleDouble::from(1.0)).to_f64(),
        2_f64.powi(-90)
    );
    assert_eq!(DoubleDouble::from(3.0).scaled(-1000).scaled(1000).to_f64(), 3.0);
}

/// Along an axis x = h Ω solves the equation at any h; beyond the first fork of x = s ∂S(p̂) it is not the right solution.
#[test]
fn a_solution_beyond_a_fork_is_told() {
    let judge = judge(Chart::Exponential, &body([(1, 3), (1, 4), (1, 5)]), 7);
    let mut setting = judge.at(1.0, &[]).unwrap();
    let mut seen = [0, 0];
    for size in 1..70 {
        let step = setting.step(&[0.0, 0.2 * f64::from(size), 0.0]).unwrap();
        let x = [0.0, 0.1 * f64::from(size), 0.0];
        let point = step.at(&x).unwrap();
        assert!(point.residual(UNIT).relative() < 1.0);
        match point.branch().0 {
            Branch::Right => {
                assert_eq!(seen[1], 0, "size {size}: right beyond a fork");
                seen[0] += 1;
            }
            Branch::Folds(s) => {
                assert!(s < 1.0);
                seen[1] += 1;
            }
            // At the fork itself.
            Branch::CannotTell => {}
            other => panic!("size {size}: {other:?}"),
        }
    }
    assert!(seen[0] > 5 && seen[1] > 0, "{seen:?}");
}

/// The judge knows of a step only its definition: the algebra, the exact series, the frame, the problem; and of a smooth
/// Hamiltonian the nodes of its formula, not the programs of its gradient and functions, nor what runs them.
#[test]
fn shares_no_code_with_the_steps_it_judges() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/judge");
    let known = ["comoving", "hamilton_jacobi", "lie", "number", "poly", "problem", "smooth"];
    let formula = ["{Function, Id, Node};", "Function;"];
    let mut read = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        for names in text.split("coadjoint_program").skip(1) {
            let names = names.split('\n').next().unwrap().trim_start_matches("::");
            assert!(formula.contains(&names), "{}: {names}", path.display());
        }
        for foreign in
            ["coadjoint_geometry", ".run(", "smooth.gradient", "smooth.energy", "smooth.watched"]
        {
            assert!(!text.contains(foreign), "{}: {foreign}", path.display());
        }
        for module in text.split(" crate::").skip(1) {
            let name = module.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap();
            assert!(known.contains(&name), "{}: crate::{name}", path.display());
            read += 1;
        }
    }
    assert!(read > 5, "{read}");
}
