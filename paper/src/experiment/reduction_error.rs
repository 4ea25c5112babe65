//! The proposition on errors under reduction, measured.

use nalgebra::{Matrix3, Rotation3, Vector3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::outcome::{Config, Curve, Fallible, Report, Tabulation, row};

pub fn run(options: &Config) -> Fallible<Report> {
    let mut report = options.report("reduction-error");
    let mut rng = ChaCha8Rng::seed_from_u64(options.seed(1));
    let mut vector = || Vector3::from_fn(|_, _| StandardNormal.sample(&mut rng));
    let pairs = options.pick(2000, 200);
    let sizes: Vec<f64> = (1..=7).map(|k| 10.0_f64.powi(-k)).collect();
    // Sums of both errors, and their largest ratios to their bounds.
    let mut sums = vec![[0.0_f64; 4]; sizes.len()];
    for _ in 0..pairs {
        // g, and a covector at g as a 3×3 matrix g μ̂: the embedding into ℝ⁹ × ℝ⁹ of the paper.
        let mut point = || {
            let g: Matrix3<f64> = Rotation3::new(vector()).into_inner();
            (g, g * vector().cross_matrix())
        };
        let ((first, _), (second, covector)) = (point(), point());
        let turns: [Vector3<f64>; 2] = [vector(), vector()];
        let push = Matrix3::from_columns(&[vector(), vector(), vector()]);
        for (size, sum) in sizes.iter().zip(&mut sums) {
            let moved = |g: &Matrix3<f64>, turn: &Vector3<f64>| {
                g * Rotation3::new(turn * *size).into_inner()
            };
            let (g1, g2) = (moved(&first, &turns[0]), moved(&second, &turns[1]));
            let alpha = covector + push * *size;
            let (e1, e2) = ((g1 - first).norm(), (g2 - second).norm());
            let left = (first.transpose() * second - g1.transpose() * g2).norm();
            let right = (first.transpose() * covector - g1.transpose() * alpha).norm();
            sum[0] += left / f64::from(pairs);
            sum[1] += right / f64::from(pairs);
            sum[2] = sum[2].max(left / (e1 + e2));
            sum[3] = sum[3].max(right / (alpha.norm() * e1 + (push * *size).norm()));
        }
    }
    let columns = "e | error of g′⁻¹g″ | slope | largest ratio to the bound | error of g′⁻¹α″ | slope | largest ratio to the bound";
    let mut table =
        Tabulation::new(format!("mean over {pairs} random pairs perturbed by a size e"), columns);
    let (mut furthest, mut largest): (f64, f64) = (0.0, 0.0);
    for (k, (size, sum)) in sizes.iter().zip(&sums).enumerate() {
        let before = sums.get(k.wrapping_sub(1));
        let slope = |i: usize| before.map(|before| (before[i] / sum[i]).log10());
        let off = |i: usize| slope(i).map_or(0.0, |slope: f64| (slope - 1.0).abs());
        if k > 1 {
            furthest = furthest.max(off(0)).max(off(1));
        }
        largest = largest.max(sum[2]).max(sum[3]);
        let size = format!("{size:.0e}");
        table.rows.push(row![size, sum[0], slope(0), sum[2], sum[1], slope(1), sum[3]]);
    }
    report.judge("reduction-error", "", &[furthest, largest]);
    report.tables.push(table);
    let mut curve = Curve::over("reduction-error", "size", sizes);
    curve.add("group_error", sums.iter().map(|sum| sum[0]));
    curve.add("covector_error", sums.iter().map(|sum| sum[1]));
    report.curves.push(curve);
    Ok(report)
}
