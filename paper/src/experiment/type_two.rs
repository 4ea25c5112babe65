//! The paper's baseline without symmetry: a type-II generating function in canonical coordinates of T\*SO(3).
//!
//! R. Chen and M. Tao, *Data-driven prediction of general Hamiltonian dynamics via learning exactly-symplectic maps*
//! (2021), as the paper uses it: (q, p) are the canonical coordinates of the phase point in Cayley's chart of the whole
//! group, and S(q′, p″) gives p′ = p″ + ∂S/∂q′, q″ = q′ + ∂S/∂p″. The map is symplectic, and knows nothing of the symmetry.

use coadjoint::groups::{Cayley, Chart};
use coadjoint::{Phase, SO3};
use coadjoint_learn::MomentumFunction;
use coadjoint_learn::data::PairRows;
use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::outcome::Fallible;

/// (q, p) with g = τ(q), p = (d^Lτ_q)ᵀ μ; `None` outside of the chart.
fn canonical(phase: &Phase<SO3>) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let group = SO3::new();
    let q = Cayley.coordinate(&group, &phase.group_element)?;
    Some((q, Cayley.pull_back(&group, &-q, &phase.momentum)))
}

/// The points (q′, p″) and the gradients (p′ − p″, q″ − q′) that S has to fit, 6×N each.
pub fn data(pairs: &PairRows<SO3>) -> Fallible<(DMatrix<f64>, DMatrix<f64>)> {
    let (mut points, mut gradients) = (Vec::new(), Vec::new());
    for (row, pair) in &pairs.pairs {
        let ends = canonical(&pair.before).zip(canonical(&pair.after));
        let ((q, p), (q2, p2)) =
            ends.ok_or_else(|| format!("row {row} is outside of the chart"))?;
        points.extend(q.iter().chain(p2.iter()));
        gradients.extend((p - p2).iter().chain((q2 - q).iter()));
    }
    let matrix = |entries| DMatrix::from_vec(6, pairs.pairs.len(), entries);
    Ok((matrix(points), matrix(gradients)))
}

/// Maps a phase point by Newton's method on p′ = p″ + ∂S/∂q′(q′, p″); `None` where it does not converge or leaves the
/// chart.
pub fn advance(function: &dyn MomentumFunction, phase: &Phase<SO3>) -> Option<Phase<SO3>> {
    let (q, p) = canonical(phase)?;
    let scale = q.amax().max(p.amax()).max(1.0);
    let (mut next, mut slope, mut hessian) = (p, [0.0; 6], [0.0; 36]);
    for _ in 0..50 {
        let point = [q.x, q.y, q.z, next.x, next.y, next.z];
        function.gradient_and_hessian(&point, &mut slope, &mut hessian);
        let residual = next + Vector3::from_row_slice(&slope[..3]) - p;
        let jacobian = Matrix3::from_fn(|i, j| hessian[6 * i + 3 + j]) + Matrix3::identity();
        let correction = jacobian.lu().solve(&residual)?;
        next -= correction;
        if correction.amax() <= 1e-13 * scale {
            function.gradient(&[q.x, q.y, q.z, next.x, next.y, next.z], &mut slope);
            let q = q + Vector3::from_row_slice(&slope[3..]);
            let group = SO3::new();
            let momentum = Cayley.right_momentum(&group, &q, &next);
            let (element, _) = Cayley.transport(&group, &q, &momentum);
            return (q + next).iter().all(|v| v.is_finite()).then(|| Phase::new(element, momentum));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use coadjoint_learn::polynomial::fit_gradients;
    use coadjoint_learn::truth::{MomentumBox, Separable, phase_pairs};

    use super::*;

    #[test]
    fn type_two_learns_but_does_not_conserve_momentum() {
        let group = SO3::new();
        let pairs = |count, seed| -> PairRows<SO3> {
            phase_pairs(&group, &Separable::paper(), 0.1, MomentumBox::UNIT, count, seed).into()
        };
        let (train, test) = (pairs(150, 1), pairs(50, 2));
        let (points, gradients) = data(&train).unwrap();
        let errors = [2, 4].map(|degree| {
            let function = fit_gradients(&points, &gradients, degree, 0.0).unwrap();
            let step = |at: &Phase<SO3>| advance(&function, at);
            let found = coadjoint_learn::evaluate_with(&group, &test, step);
            assert!(found.unsolved.is_empty());
            found.mse.momentum.unwrap()
        });
        assert!(errors[1] < 0.1 * errors[0], "{errors:?}");
        let function = fit_gradients(&points, &gradients, 4, 0.0).unwrap();
        let start = &test.pairs[0].1.before;
        let end = advance(&function, start).unwrap();
        let drift = end.spatial_momentum(&group) - start.spatial_momentum(&group);
        assert!(drift.norm() > 1e-6, "{drift}");
    }
}
