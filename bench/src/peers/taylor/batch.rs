//! Free bodies side by side: Taylor's method in L lanes, each lane with its own step.
//!
//! What heyoka's batch mode does, with the order fixed at compile time.

use super::for_each_order;
use crate::{
    arithmetic::Vector,
    method::RunError,
    number::{Lanes, Number},
    problem::FreeBody,
    state::{Rotation, State},
};

/// The coefficients of (Π, q), N of them.
type Series<const N: usize, const L: usize> = [[Lanes<L>; 7]; N];

/// The series through y.
#[inline(always)]
fn expand<const N: usize, const L: usize>(body: &FreeBody, y: &[Lanes<L>; 7]) -> Series<N, L> {
    let a = &body.inverse_inertia;
    let differences = [a[2] - a[1], a[0] - a[2], a[1] - a[0]];
    let mut series = [[Lanes::splat(0.0); 7]; N];
    series[0] = *y;
    for_each_order!(K, N, {
        let scale = 1.0 / (K + 1) as f64;
        series[K + 1] = next::<K, N, L>(&series, &differences, a, scale);
    });
    series
}

#[inline(always)]
fn next<const K: usize, const N: usize, const L: usize>(
    series: &Series<N, L>,
    differences: &Vector,
    inverse_inertia: &Vector,
    scale: f64,
) -> [Lanes<L>; 7] {
    let zero = Lanes::splat(0.0);
    let mut momentum = [zero; 3];
    // Σ (q component) (Π component): rows q, columns Π.
    let mut products = [[zero; 3]; 4];
    for j in 0..=K {
        let (left, right) = (&series[j], &series[K - j]);
        for i in 0..3 {
            momentum[i] = left[(i + 1) % 3].fused(right[(i + 2) % 3], momentum[i]);
            for (row, sums) in products.iter_mut().enumerate() {
                sums[i] = left[3 + row].fused(right[i], sums[i]);
            }
        }
    }
    let p = products
        .map(|row| std::array::from_fn::<_, 3, _>(|i| row[i] * (0.5 * scale * inverse_inertia[i])));
    [
        momentum[0] * (differences[0] * scale),
        momentum[1] * (differences[1] * scale),
        momentum[2] * (differences[2] * scale),
        -p[1][0] - p[2][1] - p[3][2],
        p[0][0] + p[2][2] - p[3][1],
        p[0][1] + p[3][0] - p[1][2],
        p[0][2] + p[1][1] - p[2][0],
    ]
}

/// The end states of L bodies.
///
/// # Errors
/// When a step becomes too small.
#[inline]
pub fn integrate<const N: usize, const L: usize>(
    body: &FreeBody,
    momenta: &[Vector; L],
    end: f64,
    tolerance: f64,
) -> Result<[State; L], RunError> {
    let mut y = [Lanes::splat(0.0); 7];
    for i in 0..3 {
        y[i] = Lanes(momenta.map(|m| m[i]));
    }
    y[3] = Lanes::splat(1.0);
    let mut left = [end; L];
    while left.iter().any(|&t| t > 0.0) {
        let series = expand::<N, L>(body, &y);
        let h = step_sizes(&series, tolerance);
        for lane in 0..L {
            if h[lane] < 1e-12 * end || h[lane].is_nan() {
                return Err(RunError::NotConverged);
            }
        }
        // A lane that has arrived takes steps of length 0.
        let h = Lanes(std::array::from_fn(|lane| h[lane].min(left[lane])));
        for i in 0..7 {
            y[i] = series.iter().rev().skip(1).fold(series[N - 1][i], |sum, c| sum.fused(h, c[i]));
        }
        for lane in 0..L {
            left[lane] -= h.0[lane];
        }
    }
    Ok(std::array::from_fn(|lane| {
        let v = y.map(|component| component.0[lane]);
        FreeBody::state([v[0], v[1], v[2]], Rotation::Quaternion([v[3], v[4], v[5], v[6]]))
    }))
}

/// Per lane, the h for which each of the last two terms is at the tolerance.
#[inline(always)]
fn step_sizes<const N: usize, const L: usize>(series: &Series<N, L>, tolerance: f64) -> [f64; L] {
    let size = |k: usize| {
        let mut sizes = [0.0f64; L];
        for component in &series[k] {
            for (size, value) in sizes.iter_mut().zip(component.0) {
                *size = size.max(value.abs());
            }
        }
        sizes
    };
    let (first, before, last) = (size(0), size(N - 2), size(N - 1));
    // Seven digits of a step size are plenty, and single precision takes a fraction of the time.
    let root = |ratio: f64, degree: usize| f64::from((ratio as f32).powf(1.0 / degree as f32));
    std::array::from_fn(|lane| {
        let limit = tolerance * first[lane];
        root(limit / last[lane], N - 1).min(root(limit / before[lane], N - 2))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{method::Method, peers::jacobi::Exact, problem, state::Scale};

    #[test]
    fn every_lane_reaches_its_own_exact_state() {
        let mut problem = problem::named("free-body-a").unwrap();
        problem.end = 30.0;
        let momenta = [[2.0, 0.5, 1.0], [1.2, 2.5, 0.6], [0.3, -1.0, 0.4], [-2.0, 0.1, 3.0]];
        let problem::System::FreeBody(body) = problem.system else {
            panic!("body A is a free body")
        };
        let ends = integrate::<17, 4>(&body, &momenta, problem.end, 1e-15).unwrap();
        for (momentum, end) in momenta.iter().zip(ends) {
            problem.initial.momentum = *momentum;
            let exact = Exact.run(&problem, crate::method::Setting::Step(1.0)).unwrap();
            let error = end.error(&exact, &Scale { momentum: 1.0, position: 1.0 });
            assert!(error < 2e-13, "{momentum:?}: {error:e}");
        }
    }
}
