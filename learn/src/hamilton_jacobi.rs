//! The Hamilton–Jacobi equation by least squares (the conclusions of the paper).

use coadjoint::{Chart, LieGroup};
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::error::LearnError;
use crate::function::{MomentumFunction, entries, vector};
use crate::least_squares::GaussNewton;
use crate::polynomial::{Basis, PolynomialModel, Scaling};
use crate::trivialisation::left_derivative;
use crate::truth::MomentumBox;

/// How [`solve_hamilton_jacobi`] works.
#[derive(Clone, Debug, PartialEq)]
pub struct CollocationOptions {
    /// The total degree of S in p.
    pub degree: usize,
    /// The powers of t; odd ones, since S is odd in t.
    pub powers: Vec<u32>,
    /// The largest time T; samples are drawn from 0 to T.
    pub time: f64,
    /// The box from which momenta are drawn.
    pub momenta: MomentumBox,
    /// The number of samples (t, p).
    pub samples: usize,
    /// The seed of the samples.
    pub seed: u64,
    /// When the Gauss–Newton iteration stops.
    pub iteration: GaussNewton,
}

/// A function S(t, p) = Σ_a (t/T)^a S_a(p) with polynomials S_a.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeDependent {
    powers: Vec<u32>,
    time: f64,
    /// One coefficient vector per power, in the basis of `model`.
    coefficients: Vec<Vec<f64>>,
    model: PolynomialModel,
    /// The mean squared residual of the equation after each accepted step.
    pub history: Vec<f64>,
}

impl TimeDependent {
    /// The polynomial S(t, ·) at the time `t`.
    #[must_use]
    pub fn at(&self, t: f64) -> PolynomialModel {
        let mut sum = vec![0.0; self.model.basis().len()];
        for (power, coefficients) in self.powers.iter().zip(&self.coefficients) {
            let factor = (t / self.time).powi((*power).cast_signed());
            sum.iter_mut().zip(coefficients).for_each(|(s, c)| *s += factor * c);
        }
        self.model.clone().with_coefficients(&sum)
    }
}

/// Minimises Σ(S_t − H(J_R(∂S/∂p, p)))² over sampled (t, p) by Gauss–Newton; S(0, ·) = 0 holds by
/// the choice of powers. The sign is that of the forward flow.
///
/// # Errors
/// [`LearnError::InvalidOption`] for no powers or a power 0, [`LearnError::NotConverged`] when the
/// residual does not exist at the start.
pub fn solve_hamilton_jacobi<G, C, H>(
    group: &G,
    hamiltonian: &H,
    options: &CollocationOptions,
) -> Result<TimeDependent, LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
    H: MomentumFunction + ?Sized,
{
    if options.powers.is_empty() || options.powers.contains(&0) {
        return Err(LearnError::InvalidOption {
            option: "powers",
            value: format!("{:?}", options.powers),
            requirement: "give the powers of t, each at least 1".into(),
        });
    }
    let dim = group.dim();
    let MomentumBox { low, high } = options.momenta;
    let mut rng = ChaCha8Rng::seed_from_u64(options.seed);
    let samples: Vec<(f64, Vec<f64>)> = (0..options.samples)
        .map(|_| {
            let t = options.time * rng.random::<f64>();
            (t, (0..dim).map(|_| low + (high - low) * rng.random::<f64>()).collect())
        })
        .collect();
    let scaling = Scaling {
        centre: vec![0.5 * (low + high); dim],
        half_width: vec![0.5 * (high - low); dim],
    };
    let model = PolynomialModel::zero(Basis::new(dim, options.degree), scaling);
    let terms = model.basis().len();
    // The basis lacks the constant, which does not matter to x = ∂S/∂p but does to S_t: one more
    // unknown per power of t.
    let unknowns = options.powers.len() * (terms + 1);
    let factors = |t: f64| -> Vec<(f64, f64)> {
        let u = t / options.time;
        let each = options.powers.iter().map(|&a| {
            let power = a.cast_signed();
            (u.powi(power), f64::from(a) * u.powi(power - 1) / options.time)
        });
        each.collect()
    };

    // The residual and, on request, its derivative, at one sample.
    let chart = C::default();
    let residual_at = |c: &DVector<f64>, t: f64, p: &[f64], slope: Option<&mut [f64]>| {
        let mut values = vec![0.0; terms];
        let mut gradients = vec![0.0; terms * dim];
        model.basis_values(p, &mut values);
        model.basis_gradients(p, &mut gradients);
        let times = factors(t);
        let (mut x, mut rate) = (vec![0.0; dim], 0.0);
        for (a, (factor, derivative)) in times.iter().enumerate() {
            let block = &c.as_slice()[a * (terms + 1)..(a + 1) * (terms + 1)];
            rate += derivative * block[terms];
            for k in 0..terms {
                rate += derivative * block[k] * values[k];
                for j in 0..dim {
                    x[j] += factor * block[k] * gradients[k * dim + j];
                }
            }
        }
        let (x, p) = (vector::<G>(&x), vector::<G>(p));
        let mu = chart.right_momentum(group, &x, &p);
        let residual = rate - hamiltonian.value(&entries(&mu));
        if let Some(slope) = slope {
            let mut velocity = vec![0.0; dim];
            hamiltonian.gradient(&entries(&mu), &mut velocity);
            // J_R = y solves (d^Lτ_x)ᵀ y = p, so (d^Lτ_x)ᵀ δy = D δx with D the derivative of
            // (d^Rτ_z)ᵀ y in z at z = −x.
            let minus: Vec<f64> = entries(&x).iter().map(|v| -v).collect();
            let (_, bend) = chart.pull_back_with_derivative(group, &vector::<G>(&minus), &mu);
            let bend = DMatrix::from_fn(dim, dim, |i, j| bend[(i, j)]);
            let turned =
                left_derivative(group, chart, &x).lu().solve(&DVector::from_vec(velocity))?;
            let along = bend.transpose() * turned;
            for (a, (factor, derivative)) in times.iter().enumerate() {
                let block = &mut slope[a * (terms + 1)..(a + 1) * (terms + 1)];
                block[terms] = *derivative;
                for k in 0..terms {
                    let push: f64 = (0..dim).map(|j| along[j] * gradients[k * dim + j]).sum();
                    block[k] = derivative * values[k] - factor * push;
                }
            }
        }
        residual.is_finite().then_some(residual)
    };
    let residual = |c: &DVector<f64>| {
        let all: Option<Vec<f64>> =
            samples.iter().map(|(t, p)| residual_at(c, *t, p, None)).collect();
        all.map(DVector::from_vec)
    };
    let linearise = |c: &DVector<f64>| {
        let mut jacobian = DMatrix::zeros(samples.len(), unknowns);
        let mut all = DVector::zeros(samples.len());
        let mut row = vec![0.0; unknowns];
        for (i, (t, p)) in samples.iter().enumerate() {
            all[i] = residual_at(c, *t, p, Some(&mut row))?;
            for (entry, value) in jacobian.row_mut(i).iter_mut().zip(&row) {
                *entry = *value;
            }
        }
        Some((all, jacobian))
    };
    let descent = options
        .iteration
        .minimise(DVector::zeros(unknowns), residual, linearise)
        .ok_or_else(|| LearnError::NotConverged {
            reason: "the equation has no finite residual at S = 0".into(),
        })?;
    let coefficients = descent
        .unknowns
        .as_slice()
        .chunks_exact(terms + 1)
        .map(|block| block[..terms].to_vec())
        .collect();
    let count = samples.len().max(1) as f64;
    Ok(TimeDependent {
        powers: options.powers.clone(),
        time: options.time,
        coefficients,
        model,
        history: descent.history.iter().map(|sum| sum / count).collect(),
    })
}
