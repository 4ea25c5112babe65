//! The Hamilton–Jacobi equation by least squares (the conclusions of the paper) against the exact series.

use coadjoint::SO3;
use coadjoint::groups::{Chart as _, Exponential};
use coadjoint::steps::poisson_map;
use coadjoint_codegen::hamilton_jacobi::{GeneratingSeries, TermLimit, derive};
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::system::{Options as SystemOptions, read};
use coadjoint_learn::polynomial::{Basis, PolynomialModel, Scaling};
use coadjoint_learn::truth::Separable;
use coadjoint_learn::{GaussNewton, MomentumFunction};
use nalgebra::{DMatrix, DVector, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::poisson::map;
use crate::outcome::{Config, Curve, Fallible, Report, Tabulation, row};
use crate::state::{RIGID_BODY, Timestep, exact_momentum};

/// The time T up to which S is fitted.
const TIME: f64 = 0.5;

/// Minimises Σ(∂S/∂t − H(J_R(∂S/∂p, p)))² over sampled t in (0, T) and p in [−1, 1]³ by Gauss and Newton's method, for
/// S = Σ_a (t/T)^a S_a(p) with polynomials S_a and odd powers a, so that S(0, ·) = 0. The sign is that of the forward
/// flow. Returns S(T, ·) and the mean squared residual of the equation after each accepted step.
fn solve(
    degree: usize,
    powers: &[i32],
    samples: usize,
    seed: u64,
) -> Fallible<(PolynomialModel, Vec<f64>)> {
    let body = Separable::paper();
    let scaling = Scaling { centre: vec![0.0; 3], half_width: vec![1.0; 3] };
    let model = PolynomialModel::zero(Basis::new(3, degree), scaling);
    // The basis lacks the constant, which does not matter to x = ∂S/∂p but does to ∂S/∂t.
    let terms = model.basis().terms().len();
    let unknowns = powers.len() * (terms + 1);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = || rng.random::<f64>();
    // At each sample p and the rows by which the unknowns make ∂S/∂t and the three coordinates of x = ∂S/∂p.
    let mut points = Vec::new();
    let mut rows = DMatrix::zeros(4 * samples, unknowns);
    for i in 0..samples {
        let t = draw();
        let p = Vector3::from_fn(|_, _| 2.0 * draw() - 1.0);
        let (mut values, mut gradients) = (vec![0.0; terms], vec![0.0; 3 * terms]);
        model.basis_values(p.as_slice(), &mut values);
        model.basis_gradients(p.as_slice(), &mut gradients);
        values.push(1.0);
        for (block, &a) in powers.iter().enumerate() {
            let (factor, rate) = (t.powi(a), f64::from(a) * t.powi(a - 1) / TIME);
            for (k, value) in values.iter().enumerate() {
                let column = block * (terms + 1) + k;
                rows[(4 * i, column)] = rate * value;
                for j in (0..3).filter(|_| k < terms) {
                    rows[(4 * i + 1 + j, column)] = factor * gradients[3 * k + j];
                }
            }
        }
        points.push(p);
    }
    let energy = |x: &Vector3<f64>, p: &Vector3<f64>| {
        body.value(Exponential.right_momentum(&SO3::new(), x, p).as_slice())
    };
    let increment = |made: &DVector<f64>, i: usize| Vector3::from_fn(|j, _| made[4 * i + 1 + j]);
    let residual = |c: &DVector<f64>| {
        let made = &rows * c;
        let one = |(i, p): (usize, &Vector3<f64>)| made[4 * i] - energy(&increment(&made, i), p);
        let all = DVector::from_iterator(samples, points.iter().enumerate().map(one));
        all.iter().all(|v: &f64| v.is_finite()).then_some(all)
    };
    let linearise = |c: &DVector<f64>| {
        let made = &rows * c;
        let mut jacobian = DMatrix::zeros(samples, unknowns);
        for (i, p) in points.iter().enumerate() {
            let x = increment(&made, i);
            let mut row = rows.row(4 * i).into_owned();
            for j in 0..3 {
                // By differences, whose error moves the minimum by less than is visible.
                let at = |change: f64| energy(&(x + Vector3::ith(j, change)), p);
                row -= rows.row(4 * i + 1 + j) * ((at(1e-5) - at(-1e-5)) / 2e-5);
            }
            jacobian.set_row(i, &row);
        }
        Some((residual(c)?, jacobian))
    };
    let iteration = GaussNewton { iterations: 20, relative_decrease: 1e-3, ridge: 1e-18 };
    let descent = iteration.minimise(DVector::zeros(unknowns), residual, linearise);
    let (unknowns, history) = descent.ok_or("the equation has no finite residual at S = 0")?;
    let blocks = unknowns.as_slice().chunks_exact(terms + 1);
    let sum = blocks
        .fold(vec![0.0; terms], |sum, block| sum.iter().zip(block).map(|(s, c)| s + c).collect());
    let history = history.iter().map(|sum| sum / samples as f64).collect();
    Ok((model.with_coefficients(&sum), history))
}

/// The series of the paper's rigid body in the exponential chart to the order K.
fn series(truncation: usize) -> Fallible<GeneratingSeries> {
    let system = read(RIGID_BODY, SystemOptions::default());
    let system = system.map_err(|mistakes| mistakes.render("rigid body", RIGID_BODY))?;
    let (problem, limit) = (system.problem, TermLimit::new(100_000));
    Ok(derive(&problem.algebra, Chart::Exponential, &problem.hamiltonian, truncation, limit)?)
}

pub fn run(options: &Config) -> Fallible<Report> {
    let mut report = options.report("hamilton-jacobi");
    let mut rng = ChaCha8Rng::seed_from_u64(options.seed(2));
    let tests: Vec<Vector3<f64>> =
        (0..100).map(|_| Vector3::from_fn(|_, _| 2.0 * rng.random::<f64>() - 1.0)).collect();
    let reference = series(11)?;
    let slope = |p: &Vector3<f64>, i: usize| -> f64 {
        let orders = (1..=reference.truncation()).step_by(2);
        orders
            .map(|k| TIME.powi(k as i32) * reference.order(k).derivative(i).evaluate(p.as_slice()))
            .sum()
    };
    let title = format!("p in [-1, 1]³, t in (0, {TIME}); errors at t = {TIME}, 100 points");
    let columns = "degree | powers of t | residual mse | rms of dS − series K=11 | rms of the map, least squares | rms of the map, series";
    let mut table = Tabulation::new(title, columns);
    let mut residuals = Curve::over("hamilton-jacobi", "iteration", (0..=20).map(f64::from));
    let fits = options.pick(&[(2, 1), (4, 2), (6, 3), (8, 4)][..], &[(2, 1), (4, 2)]);
    let mut errors =
        Curve::over("hamilton-jacobi-errors", "degree", fits.iter().map(|fit| fit.0 as f64));
    let (mut fitted, mut expanded) = (Vec::new(), Vec::new());
    for &(degree, count) in fits {
        let powers: Vec<i32> = (0..count).map(|a| 2 * a + 1).collect();
        let (model, history) = solve(degree, &powers, options.pick(3000, 600), options.seed(1))?;
        let steps = Timestep::new(RIGID_BODY, Chart::Exponential, 2 * count as usize - 1)?;
        let learned = map(&model);
        let (mut slopes, mut ours, mut theirs) = (0.0, 0.0, 0.0);
        for mu in &tests {
            let mut gradient = [0.0; 3];
            model.gradient(mu.as_slice(), &mut gradient);
            slopes += (0..3).map(|j| (gradient[j] - slope(mu, j)).powi(2)).sum::<f64>();
            let exact = exact_momentum(mu, TIME);
            ours += (poisson_map(&learned, mu)? - exact).norm_squared();
            let (states, _) = steps.walk(TIME, 1, mu.as_slice()).ok_or("a step was refused")?;
            theirs += (Vector3::from_row_slice(&states[1].momentum) - exact).norm_squared();
        }
        let rms = |sum: f64| (sum / (3 * tests.len()) as f64).sqrt();
        let words: Vec<String> = powers.iter().map(i32::to_string).collect();
        let (last, words) = (history.last().copied(), words.join(" "));
        table.rows.push(row![degree as f64, words, last, rms(slopes), rms(ours), rms(theirs)]);
        residuals.add(format!("degree_{degree}"), history);
        fitted.push(rms(ours));
        expanded.push(rms(theirs));
    }
    let ratios = fitted.iter().zip(&expanded).map(|(ours, theirs)| ours / theirs);
    report.judge("hamilton-jacobi", "", &[ratios.fold(0.0, f64::max)]);
    errors.add("fitted", fitted);
    errors.add("series", expanded);
    report.tables.push(table);
    report.curves.extend([residuals, errors]);
    Ok(report)
}
