//! The non-symmetric baseline: it learns, and conserves no momentum.
#![allow(clippy::unwrap_used)]

use coadjoint::{Cayley, SO3};
use coadjoint_learn::data::PairRows;
use coadjoint_learn::polynomial::fit_gradients;
use coadjoint_learn::truth::{MomentumBox, Quadratic, phase_pairs};
use coadjoint_learn::{TypeTwo, evaluate_with, type_two_data};

#[test]
fn type_two_learns_but_does_not_conserve_momentum() {
    let group = SO3::new();
    let pairs = |count, seed| -> PairRows<SO3> {
        phase_pairs(&group, &Quadratic::paper(), 0.1, MomentumBox::UNIT, count, seed).into()
    };
    let (train, test) = (pairs(150, 1), pairs(50, 2));
    let (points, gradients) = type_two_data::<_, Cayley>(&group, &train).unwrap();
    let errors: Vec<f64> = [2, 4]
        .iter()
        .map(|&degree| {
            let map =
                TypeTwo { function: fit_gradients(&points, &gradients, degree, 0.0).unwrap() };
            let found = evaluate_with(&group, &test, |at| map.advance::<_, Cayley>(&group, at));
            assert!(found.unsolved.is_empty());
            found.mse.momentum.unwrap()
        })
        .collect();
    assert!(errors[1] < 0.1 * errors[0], "{errors:?}");
    let map = TypeTwo { function: fit_gradients(&points, &gradients, 4, 0.0).unwrap() };
    let start = &test.pairs[0].1.before;
    let end = map.advance::<_, Cayley>(&group, start).unwrap();
    let drift = end.spatial_momentum(&group) - start.spatial_momentum(&group);
    assert!(drift.norm() > 1e-6, "{drift}");
}
