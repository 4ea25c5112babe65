//! The fold of the canonical momentum: where it is, and that data beyond it are found.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::groups::{Cayley, Chart, Exponential};
use coadjoint::{Phase, SO3};
use coadjoint_learn::data::{PairRows, PhasePair, RowPolicy, TOLERANCE, reduce};
use coadjoint_learn::truth::{MomentumBox, Separable, exact_flow, phase_pairs};
use coadjoint_learn::{LearnError, RowProblem};
use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// p and the angle of the increment after unit time.
fn canonical<C: Chart<SO3>>(body: &Separable, mu: &Vector3<f64>) -> (Vector3<f64>, f64) {
    let group = SO3::new();
    let end = exact_flow(&group, body, &Phase::<SO3>::at_identity(*mu), 1.0);
    let chart = C::default();
    let x = chart.coordinate(&group, &end.group_element).unwrap();
    (chart.pull_back(&group, &x, mu), end.group_element.angle())
}

/// det ∂p/∂μ′ by differences of fourth order.
fn determinant<C: Chart<SO3>>(body: &Separable, mu: &Vector3<f64>) -> f64 {
    let h = 2e-3;
    let mut derivative = Matrix3::zeros();
    for j in 0..3 {
        let at = |s: f64| canonical::<C>(body, &(mu + Vector3::ith(j, s * h))).0;
        let slope = (at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0));
        derivative.set_column(j, &(slope / (12.0 * h)));
    }
    derivative.determinant()
}

/// The angle where the determinant first vanishes along a direction of μ′; `None` short of the
/// half turn.
fn fold<C: Chart<SO3>>(body: &Separable, direction: [f64; 3]) -> Option<f64> {
    let direction = Vector3::from(direction);
    let mut velocity = [0.0; 3];
    use coadjoint_learn::MomentumFunction;
    body.gradient(direction.as_slice(), &mut velocity);
    let direction = direction / Vector3::from(velocity).norm();
    let mut last = 0.0;
    for k in 1..80 {
        let mu = direction * (0.05 * f64::from(k));
        let angle = canonical::<C>(body, &mu).1;
        if angle > 3.1 || angle < last {
            return None;
        }
        if determinant::<C>(body, &mu) <= 0.0 {
            return Some(angle);
        }
        last = angle;
    }
    None
}

/// The angles documented in `data::fold`: θ tan(θ/2) = 1 for the ball in the Cayley chart, and the
/// worst directions found by searching the sphere.
#[test]
fn the_fold_is_where_it_is_documented() {
    let ball = Separable::rigid_body([1.0, 1.0, 1.0]);
    let body = Separable::paper();
    let plate = Separable::rigid_body([1.0, 2.0, 3.0]);
    // Steps are 0.05 of the angle, so the fold lies at most that far before the first hit.
    let near = |found: Option<f64>, expected: f64| {
        let found = found.unwrap();
        assert!(found > expected - 0.02 && found < expected + 0.06, "{found} {expected}");
    };
    near(fold::<Cayley>(&ball, [0.3, 0.5, -0.8]), 1.3065);
    near(fold::<Cayley>(&body, [0.45, -0.17, -0.88]), 1.27);
    near(fold::<Cayley>(&plate, [0.15, 0.19, -0.97]), 1.12);
    near(fold::<Exponential>(&plate, [0.12, 0.0, 0.99]), 1.99);
    for direction in [[0.12, 0.0, 0.99], [0.45, -0.17, -0.88], [0.02, -0.26, 0.97], [1.0, 1.0, 1.0]]
    {
        assert_eq!(fold::<Exponential>(&ball, direction), None);
        assert_eq!(fold::<Exponential>(&body, direction), None);
    }
}

fn rows(body: &Separable, step: f64) -> PairRows<SO3> {
    phase_pairs(&SO3::new(), body, step, MomentumBox { low: -2.0, high: 2.0 }, 400, 5).into()
}

fn bad<C: Chart<SO3>>(rows: &PairRows<SO3>) -> Vec<(usize, RowProblem)> {
    let result = reduce::<SO3, C>(&SO3::new(), rows, TOLERANCE, RowPolicy::Refuse);
    match result {
        Ok(_) => Vec::new(),
        Err(LearnError::BadRows(bad)) => {
            bad.rows.into_iter().map(|row| (row.row, row.problem)).collect()
        }
        Err(other) => panic!("{other}"),
    }
}

/// The plate's data beyond the fold of the exponential chart are named by row; compared with the
/// determinant of the true flow the check is right but for rows close to the fold.
#[test]
fn data_beyond_the_fold_of_the_exponential_chart_are_found() {
    let plate = Separable::rigid_body([1.0, 2.0, 3.0]);
    let group = SO3::new();
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    // About the slow axis, up to angles short of the half turn.
    let mut pairs = Vec::new();
    while pairs.len() < 500 {
        let mut draw = |size: f64| size * (2.0 * rng.random::<f64>() - 1.0);
        let mu = Vector3::new(draw(1.2), draw(1.2), 4.2 + draw(4.2));
        let before = Phase::<SO3>::at_identity(mu);
        let after = exact_flow(&group, &plate, &before, 1.0);
        if after.group_element.angle() < 2.8 {
            pairs.push(PhasePair { before, after });
        }
    }
    let rows: PairRows<SO3> = pairs.into();
    let found = bad::<Exponential>(&rows);
    let folded: Vec<usize> = found
        .iter()
        .filter(|(_, problem)| matches!(problem, RowProblem::Folded(_)))
        .map(|(row, _)| *row)
        .collect();
    let (mut wrong, mut beyond) = (0, 0);
    for (row, pair) in &rows.pairs {
        let truth = determinant::<Exponential>(&plate, &pair.before.momentum);
        if truth.abs() > 0.02 {
            beyond += usize::from(truth < 0.0);
            wrong += usize::from((truth < 0.0) != folded.contains(row));
        }
    }
    println!("{} of 500 named, {beyond} clearly beyond, {wrong} wrong", folded.len());
    assert!(beyond > 10 && wrong <= 5, "{beyond} {wrong}");
    let error = reduce::<SO3, Exponential>(&group, &rows, TOLERANCE, RowPolicy::Refuse);
    let message = error.unwrap_err().to_string();
    assert!(message.contains("share one p") && message.contains("smaller step"), "{message}");
}

/// The paper's body folds nowhere short of the half turn in the exponential chart.
#[test]
fn the_papers_body_has_no_fold_in_the_exponential_chart() {
    assert_eq!(bad::<Exponential>(&rows(&Separable::paper(), 1.0)), []);
    assert!(!bad::<Cayley>(&rows(&Separable::paper(), 1.0)).is_empty());
}
