//! The preprocessed discrete Moser–Veselov algorithm of order 10 for the free body, with Newton's method.
//!
//! E. Hairer and G. Vilmart, *Preprocessed discrete Moser–Veselov algorithm for the full dynamics of the rigid body*,
//! J. Phys. A 39 (2006) 13225.

use super::method::{Competitor, equal_steps};
use super::problem::{Dynamics, Problem, Quaternion, State, Vector, cross, dot, matrix};
use crate::timing::Failure;

pub fn method(problem: &Problem) -> Option<Competitor> {
    let name = "DMV10, Newton".to_owned();
    (problem.kind == Dynamics::Free)
        .then(|| Competitor::stepping(name, 10, problem.time_scale, run))
}

fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
    let (count, h) = equal_steps(step, problem.end);
    let inertia = problem.inverse_inertia.map(f64::recip);
    let modified = modified_inertia(&inertia, &problem.momentum, h);
    let difference: Vector = std::array::from_fn(|i| modified[(i + 1) % 3] - modified[(i + 2) % 3]);
    let half = modified.map(|moment| 0.5 * h / moment);
    let f: Vector = std::array::from_fn(|i| difference[i] / modified[i]);
    let kick = difference.map(|d| 4.0 / h * d);
    let (mut m, mut q) = (problem.momentum, [1.0, 0.0, 0.0, 0.0]);
    let mut past = [[0.0; 3]; 4];
    for number in 0..count {
        let a = [half[0] * m[0], half[1] * m[1], half[2] * m[2]];
        // The cubic through the last four.
        let extrapolated =
            |i: usize| 4.0 * (past[0][i] + past[2][i]) - 6.0 * past[1][i] - past[3][i];
        let guess = if number < 4 { a } else { std::array::from_fn(extrapolated) };
        let c = solve(&a, &f, guess)?;
        past = [c, past[0], past[1], past[2]];
        let squares = dot(&c, &c);
        let scale = 1.0 / (1.0 + squares).sqrt();
        q = multiply(&q, &[scale, scale * c[0], scale * c[1], scale * c[2]]);
        let scale = 1.0 / (1.0 + squares);
        for i in 0..3 {
            m[i] += kick[i] * c[(i + 1) % 3] * c[(i + 2) % 3] * scale;
        }
    }
    Ok(State::rotating(m, matrix(&q)))
}

#[inline(always)]
fn multiply(a: &Quaternion, b: &Quaternion) -> Quaternion {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// Solves cᵢ = (1 + |c|²) aᵢ + fᵢ cⱼ cₖ by Newton's method, until the next correction would be below rounding.
#[inline(always)]
fn solve(a: &Vector, f: &Vector, guess: Vector) -> Result<Vector, Failure> {
    let mut c = guess;
    for _ in 0..100 {
        let scale = 1.0 + dot(&c, &c);
        let products = [c[1] * c[2], c[2] * c[0], c[0] * c[1]];
        let residual: Vector = std::array::from_fn(|i| c[i] - scale * a[i] - f[i] * products[i]);
        // Rows of 1 − 2 a cᵀ − (f ∘ cross terms), solved by Cramer's rule.
        let rows: [Vector; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let other = if i == j { 0.0 } else { f[i] * c[3 - i - j] };
                f64::from(u8::from(i == j)) - 2.0 * a[i] * c[j] - other
            })
        });
        let minors =
            [cross(&rows[1], &rows[2]), cross(&rows[2], &rows[0]), cross(&rows[0], &rows[1])];
        let inverse = 1.0 / dot(&rows[0], &minors[0]);
        let mut size = 0.0_f64;
        for i in 0..3 {
            let sum: f64 = (0..3).map(|j| minors[j][i] * residual[j]).sum();
            c[i] -= inverse * sum;
            size = size.max((inverse * sum).abs());
        }
        if size < 5e-9 {
            return Ok(c);
        }
    }
    Err("no convergence: take a smaller step".into())
}

/// Ĩ with 1/Ĩⱼ = σ/Iⱼ + d, where σ and d are polynomials in η = ½h² Σ mᵢ²/Iᵢ and ν = ½h²|m|², which the free body
/// conserves.
fn modified_inertia(inertia: &Vector, momentum: &Vector, h: f64) -> Vector {
    let energy: f64 = (0..3).map(|i| momentum[i] * momentum[i] / inertia[i]).sum();
    let (e, n) = (0.5 * h * h * energy, 0.5 * h * h * dot(momentum, momentum));
    let (sigma, d) = factors(inertia, n, e);
    inertia.map(|moment| 1.0 / (sigma / moment + d))
}

/// σ and d to order 10.
fn factors(inertia: &Vector, n: f64, e: f64) -> (f64, f64) {
    // s_k = Σ Iᵢᵏ, x_k = Σ Iᵢ⁻ᵏ, r_ij = Σ (I_aⁱ + I_bⁱ)/I_cʲ over the cyclic permutations.
    let s = |k: i32| inertia.iter().map(|moment| moment.powi(k)).sum::<f64>();
    let x = |k: i32| s(-k);
    let r = |i: i32, j: i32| -> f64 {
        inertia.iter().map(|moment| (s(i) - moment.powi(i)) * moment.powi(-j)).sum()
    };
    let delta: f64 = inertia.iter().product();
    let (delta2, delta3, delta4) = (delta.powi(2), delta.powi(3), delta.powi(4));
    let (n2, e2) = (n * n, e * e);
    let (n3, n4, n3e, n2e, n2e2) = (n2 * n, n2 * n2, n2 * n * e, n2 * e, n2 * e2);
    let (ne, ne2, ne3, e3, e4) = (n * e, n * e2, n * e2 * e, e2 * e, e2 * e2);
    let sigma = [
        1.0,
        s(1) * n / (6.0 * delta) - x(1) * e / 3.0,
        (s(2) / delta - x(1)) * n2 / (30.0 * delta),
        (1.0 - r(1, 1)) * ne / (30.0 * delta),
        (3.0 * s(1) / delta + 2.0 * x(2)) * e2 / 60.0,
        (4.0 * delta + 17.0 * s(3) - 15.0 * delta * r(1, 1)) * n3 / (2520.0 * delta3),
        (9.0 * s(1) + 10.0 * delta * x(2) - 6.0 * r(2, 1)) * n2e / (420.0 * delta2),
        ((6.0 * r(1, 2) - 100.0 * x(1)) * delta + 53.0 * s(2)) * ne2 / (2520.0 * delta2),
        (15.0 - delta * x(3) - 2.0 * r(1, 1)) * e3 / (630.0 * delta),
        (62.0 * s(4) - 94.0 * delta * r(2, 1) + 66.0 * delta2 * x(2) + 81.0 * delta * s(1)) * n4
            / (45360.0 * delta4),
        (-77.0 * r(3, 1) + 75.0 * delta * r(1, 2) + 214.0 * s(2) - 240.0 * delta * x(1)) * n3e
            / (22680.0 * delta3),
        (26.0 * delta * r(2, 2) + 55.0 * s(3) + 204.0 * delta
            - 50.0 * delta2 * x(3)
            - 59.0 * delta * r(1, 1))
            * n2e2
            / (7560.0 * delta3),
        (137.0 * delta * x(2) - delta * r(1, 3) + 3.0 * s(1) - 69.0 * r(2, 1)) * ne3
            / (11340.0 * delta2),
        (2.0 * delta2 * x(4) + 5.0 * delta * r(1, 2) - 171.0 * delta * x(1) + 159.0 * s(2)) * e4
            / (45360.0 * delta2),
    ];
    let d = [
        -n / (3.0 * delta) + s(1) * e / (6.0 * delta),
        -s(1) * n2 / (60.0 * delta2),
        (x(1) / (10.0 * delta) - s(2) / (60.0 * delta2)) * ne,
        -(9.0 + r(1, 1)) * e2 / (60.0 * delta),
        (34.0 * delta * x(1) - 19.0 * s(2)) * n3 / (2520.0 * delta3),
        (s(3) + 2.0 * delta * r(1, 1) - 85.0 * delta) * n2e / (1260.0 * delta3),
        (47.0 * s(1) + 13.0 * r(2, 1) - 38.0 * delta * x(2)) * ne2 / (2520.0 * delta2),
        (9.0 * delta * x(1) + delta * r(1, 2) - 11.0 * s(2)) * e3 / (1260.0 * delta2),
        (60.0 * delta * r(1, 1) - 61.0 * s(3) - 247.0 * delta) * n4 / (45360.0 * delta4),
        (54.0 * delta * s(1) - s(4) + 218.0 * delta * r(2, 1) - 426.0 * delta2 * x(2)) * n3e
            / (45360.0 * delta4),
        (125.0 * delta * x(1) - 5.0 * r(3, 1) - 130.0 * s(2) + 4.0 * delta * r(1, 2)) * n2e2
            / (7560.0 * delta3),
        (67.0 * s(3) - 735.0 * delta - 15.0 * delta * r(2, 2)
            + 87.0 * delta * r(1, 1)
            + 34.0 * delta2 * x(3))
            * ne3
            / (22680.0 * delta3),
        (165.0 * s(1) - delta * r(1, 3) - 9.0 * r(2, 1) - 145.0 * delta * x(2)) * e4
            / (45360.0 * delta2),
    ];
    (sigma.iter().sum(), d.iter().sum())
}
