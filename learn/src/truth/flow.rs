//! The flow of a left-invariant Hamiltonian to about rounding, by extrapolation.

use coadjoint::groups::{Chart, Exponential};
use coadjoint::{LieGroup, Phase};

use crate::function::{MomentumFunction, entries, vector};
use crate::trivialisation::left_exp_derivative_inverse;

/// The largest |ξ|·step of one extrapolated step: with 8 levels its error is below rounding.
const STEP_ANGLE: f64 = 0.4;

/// Advances (g, μ) by the exact flow of H∘J_R for the time `time`: ġ = g·ξ, μ̇ = ad\*_ξ μ with
/// ξ = ∂H/∂μ, to about 10⁻¹⁴.
///
/// Gragg–Bulirsch–Stoer extrapolation (Hairer, Nørsett, Wanner, *Solving Ordinary Differential
/// Equations I*, section II.9) of x with g(t) = g·exp(x(t)) together with μ; at the end μ is
/// carried by the group element, so that J_L is conserved to rounding.
#[must_use]
pub fn exact_flow<G, H>(group: &G, hamiltonian: &H, phase: &Phase<G>, time: f64) -> Phase<G>
where
    G: LieGroup<Scalar = f64>,
    H: MomentumFunction + ?Sized,
{
    let dim = group.dim();
    let mut now = phase.clone();
    let mut left = time;
    // The current velocity sets the size of a step; the count is bounded for absurd input.
    for _ in 0..1_000_000 {
        let mut velocity = vec![0.0; dim];
        hamiltonian.gradient(&entries(&now.momentum), &mut velocity);
        let speed = velocity.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let parts = (left.abs() * speed / STEP_ANGLE).ceil().max(1.0);
        let step = left / parts;
        let x = increment(group, hamiltonian, &now.momentum, step);
        let (g, mu) = Exponential.transport(group, &x, &now.momentum);
        now = Phase::new(group.compose(&now.group_element, &g), mu);
        if parts <= 1.0 {
            break;
        }
        left -= step;
    }
    now
}

/// [`exact_flow`] of a momentum alone.
#[must_use]
pub fn exact_momentum_flow<G, H>(group: &G, hamiltonian: &H, mu: &G::Vector, time: f64) -> G::Vector
where
    G: LieGroup<Scalar = f64>,
    H: MomentumFunction + ?Sized,
{
    exact_flow(group, hamiltonian, &Phase::new(group.identity(), mu.clone()), time).momentum
}

/// x(step), the logarithm of the group increment.
fn increment<G, H>(group: &G, hamiltonian: &H, mu: &G::Vector, step: f64) -> G::Vector
where
    G: LieGroup<Scalar = f64>,
    H: MomentumFunction + ?Sized,
{
    let dim = group.dim();
    let slope = |state: &[f64], out: &mut [f64]| {
        let (x, mu) = state.split_at(dim);
        let (x, mu) = (vector::<G>(x), vector::<G>(mu));
        let mut velocity = vec![0.0; dim];
        hamiltonian.gradient(&entries(&mu), &mut velocity);
        let xi = vector::<G>(&velocity);
        // g = exp(x): (d^L exp_x) ẋ = ξ.
        let matrix = left_exp_derivative_inverse(group, &x);
        let turn = group.ad_star(&xi, &mu);
        for j in 0..dim {
            out[j] = (0..dim).map(|i| matrix[(j, i)] * velocity[i]).sum();
            out[dim + j] = turn[j];
        }
    };
    let mut start = vec![0.0; dim];
    start.extend(entries(mu));
    let end = extrapolate(&start, step, slope);
    vector::<G>(&end[..dim])
}

/// One extrapolated step of y′ = slope(y) with the sequence 2, 4, …, 2·LEVELS.
fn extrapolate(start: &[f64], step: f64, slope: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    const LEVELS: usize = 8;
    let size = start.len();
    let mut first = vec![0.0; size];
    slope(start, &mut first);
    let mut table: Vec<Vec<f64>> = Vec::with_capacity(LEVELS);
    let mut change = f64::INFINITY;
    for level in 0..LEVELS {
        let count = 2 * (level + 1);
        let h = step / count as f64;
        // Gragg's smoothing midpoint rule.
        let mut before = start.to_vec();
        let mut now: Vec<f64> = start.iter().zip(&first).map(|(y, f)| y + h * f).collect();
        let mut f = vec![0.0; size];
        for _ in 1..count {
            slope(&now, &mut f);
            let next = before.iter().zip(&f).map(|(y, f)| y + 2.0 * h * f).collect();
            before = std::mem::replace(&mut now, next);
        }
        slope(&now, &mut f);
        let mut entry: Vec<f64> =
            (0..size).map(|i| 0.5 * (before[i] + now[i] + h * f[i])).collect();
        // Aitken and Neville, in h².
        let previous = std::mem::take(&mut table);
        for (k, old) in previous.iter().enumerate() {
            let ratio = (level + 1) as f64 / (level - k) as f64;
            let factor = 1.0 / (ratio * ratio - 1.0);
            let better: Vec<f64> =
                entry.iter().zip(old).map(|(new, old)| new + (new - old) * factor).collect();
            table.push(std::mem::replace(&mut entry, better));
        }
        let best = previous.last();
        let difference = best.map_or(f64::INFINITY, |old| {
            entry.iter().zip(old).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        });
        table.push(entry);
        // Stop at rounding: more levels would only gather more of it.
        let scale = start.iter().map(|v| v.abs()).fold(1.0, f64::max);
        if difference <= 4.0 * f64::EPSILON * scale || (difference >= change && difference < 1e-12)
        {
            break;
        }
        change = difference;
    }
    table.pop().unwrap_or_else(|| start.to_vec())
}

#[cfg(test)]
mod tests {
    use coadjoint::SO3;
    use nalgebra::Vector3;

    use super::*;
    use crate::truth::Quadratic;

    /// The end state A of the free body I = (1.5, 2, 2.5), T = 100, computed at 40 digits with a
    /// separate implementation (first row of the group element and the momentum).
    #[test]
    fn agrees_with_the_reference_end_state() {
        let start = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0));
        let end = exact_flow(&SO3::new(), &Quadratic::paper(), &start, 100.0);
        let momentum = [2.010_707_126_264_523, -0.368_082_789_198_529, -1.035_167_577_102_806_4];
        let row = [0.651_502_388_035_256_8, -0.611_371_780_984_644_3, -0.449_187_248_038_077_9];
        for i in 0..3 {
            assert!((end.momentum[i] - momentum[i]).abs() < 1e-11, "{}", end.momentum);
            let entry = SO3::<f64>::new().matrix_entry(&end.group_element, 0, i);
            assert!((entry - row[i]).abs() < 1e-11);
        }
    }

    #[test]
    fn one_long_step_is_many_short_ones() {
        let group = SO3::new();
        let start = Phase::<SO3>::at_identity(Vector3::new(5.0, 1.0, 3.0));
        let whole = exact_flow(&group, &Quadratic::paper(), &start, 1.0);
        let mut parts = start;
        for _ in 0..64 {
            parts = exact_flow(&group, &Quadratic::paper(), &parts, 1.0 / 64.0);
        }
        assert!((whole.momentum - parts.momentum).norm() < 1e-12);
        assert!(whole.group_element.angle_to(&parts.group_element) < 1e-12);
    }
}
