//! The proposition on errors under reduction, measured.

use nalgebra::{Matrix3, Rotation3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::report::{Bound, Curve, Report, Table};
use super::run::RunOptions;
use crate::error::LearnError;

/// g and a covector at g as a 3×3 matrix, g μ̂: the embedding into ℝ⁹ × ℝ⁹ of the paper.
struct Point {
    g: Matrix3<f64>,
    alpha: Matrix3<f64>,
}

pub(super) fn run(options: &RunOptions) -> Result<Report, LearnError> {
    let mut report = options.report("reduction-error");
    let mut rng = ChaCha8Rng::seed_from_u64(options.seed(1));
    let mut gauss = move || -> f64 { StandardNormal.sample(&mut rng) };
    let pairs = options.pick(2000, 200);
    let sizes: Vec<f64> = (1..=7).map(|k| 10.0_f64.powi(-k)).collect();
    let mut sums = vec![[0.0_f64; 4]; sizes.len()];
    for _ in 0..pairs {
        let mut vector = || Vector3::from_fn(|_, _| gauss());
        let mut point = || {
            let g = Rotation3::new(vector()).into_inner();
            Point { g, alpha: g * vector().cross_matrix() }
        };
        let (first, second) = (point(), point());
        let turns = (vector(), vector());
        let push = Matrix3::from_columns(&[vector(), vector(), vector()]);
        for (size, sum) in sizes.iter().zip(&mut sums) {
            let moved = |g: &Matrix3<f64>, turn: &Vector3<f64>| {
                g * Rotation3::new(turn * *size).into_inner()
            };
            let (g1, g2) = (moved(&first.g, &turns.0), moved(&second.g, &turns.1));
            let alpha = second.alpha + push * *size;
            let (e1, e2) = ((g1 - first.g).norm(), (g2 - second.g).norm());
            let left = (first.g.transpose() * second.g - g1.transpose() * g2).norm();
            let right = (first.g.transpose() * second.alpha - g1.transpose() * alpha).norm();
            let bounds = [e1 + e2, alpha.norm() * e1 + (push * *size).norm()];
            sum[0] += left;
            sum[1] += right;
            sum[2] = sum[2].max(left / bounds[0]);
            sum[3] = sum[3].max(right / bounds[1]);
        }
    }
    let mut table = Table::new(
        format!("mean over {pairs} random pairs perturbed by a size e"),
        &[
            "e",
            "error of g'^-1 g''",
            "slope",
            "largest ratio to the bound",
            "error of g'^-1 alpha''",
            "slope",
            "largest ratio to the bound",
        ],
    );
    let mut rows = Vec::new();
    let (mut furthest, mut largest): (f64, f64) = (0.0, 0.0);
    for (k, (size, sum)) in sizes.iter().zip(&sums).enumerate() {
        let mean = |quantity: usize| sum[quantity] / f64::from(pairs);
        let slope = |quantity: usize| {
            let before = sums.get(k.wrapping_sub(1))?[quantity] / f64::from(pairs);
            Some((before / mean(quantity)).log10())
        };
        if k > 1 {
            let off = |quantity| slope(quantity).map_or(0.0, |slope: f64| (slope - 1.0).abs());
            furthest = furthest.max(off(0)).max(off(1));
        }
        largest = largest.max(sum[2]).max(sum[3]);
        table.push(vec![
            format!("{size:.0e}").into(),
            mean(0).into(),
            slope(0).into(),
            sum[2].into(),
            mean(1).into(),
            slope(1).into(),
            sum[3].into(),
        ]);
        rows.push(vec![*size, mean(0), mean(1)]);
    }
    report.tables.push(table);
    report.judge(
        "reduction-error",
        "largest difference of a slope from 1, perturbations of 1e-3 and smaller",
        furthest,
        Bound::AtMost(0.01),
    );
    report.judge(
        "reduction-error",
        "largest ratio of an error to its bound",
        largest,
        Bound::AtMost(1.0 + 1e-6),
    );
    let columns = ["size", "group_error", "covector_error"].map(Into::into).to_vec();
    report.curves.push(Curve { name: "reduction-error".into(), columns, rows });
    report.notes.push(
        "both estimates of the proposition hold with slope 1; the bounds are |e1'| + |e1''| for the \
         increment and |alpha''| |e1'| + |e2''| for the covector (the paper's first line prints e2' \
         for e1'', its second e2' for e1')"
            .into(),
    );
    Ok(report)
}
