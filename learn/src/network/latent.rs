//! The paper's way with momenta alone: the canonical momenta pᵢ are unknowns of the fit.

use burn::tensor::{Device, Tensor};
use coadjoint::LieGroup;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::architecture::Architecture;
use super::dense::DenseNetwork;
use super::minimise::minimise;
use super::objective::{Layout, Unknowns, device, matrix};
use super::options::{Progress, TrainingOptions};
use crate::data::MomentumPairs;
use crate::error::LearnError;
use crate::function::vector;
use crate::polynomial::Scaling;
use crate::trivialisation::ad_star_matrix;

/// Where the canonical momenta come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MomentumModel {
    /// One unknown pᵢ per sample (section 5.3 of the paper).
    Latent,
    /// A second network (μ′, μ″) ↦ p of these widths (the paper's remark on scalability).
    Network(Vec<usize>),
}

/// How [`fit_latent`] fits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LatentOptions {
    /// The network for S and the training; the paper's widths are 50, 10.
    pub training: TrainingOptions,
    /// Where p comes from.
    pub momenta: MomentumModel,
}

/// A Poisson map learned with the canonical momenta as unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct LatentFit {
    /// S, in the exponential chart.
    pub network: DenseNetwork,
    /// The loss after every evaluation: the mean squared error of μ′ and μ″.
    pub history: Vec<f64>,
}

/// The coefficients of J_R = Σ b_k (ad_xᵀ)ᵏ p, b_k = (−1)ᵏ B_k/k!: 1, ½, 1/12, 0, −1/720, …
/// The first left out is 7·10⁻¹³; the series serves increments with |ad_x| below about 2.
const BERNOULLI: [f64; 11] = [
    1.0,
    0.5,
    1.0 / 12.0,
    0.0,
    -1.0 / 720.0,
    0.0,
    1.0 / 30_240.0,
    0.0,
    -1.0 / 1_209_600.0,
    0.0,
    1.0 / 47_900_160.0,
];

/// ad_xᵀ p for a row of x and of p per sample.
struct Bracket {
    /// Per basis vector eᵢ the transpose of p ↦ ad\*_{eᵢ} p.
    maps: Vec<Tensor<2>>,
}

impl Bracket {
    fn of<G: LieGroup<Scalar = f64>>(group: &G, device: &Device) -> Self {
        let dim = group.dim();
        let unit = |l: usize| {
            let entries: Vec<f64> = (0..dim).map(|i| if i == l { 1.0 } else { 0.0 }).collect();
            vector::<G>(&entries)
        };
        // ad_star_matrix(eˡ) has the column ad*_{e_i} eˡ.
        let images: Vec<DMatrix<f64>> = (0..dim).map(|l| ad_star_matrix(group, &unit(l))).collect();
        let maps = (0..dim)
            .map(|i| {
                // Row l, column j: the coordinate j of ad*_{e_i} eˡ.
                let entries: Vec<f64> = (0..dim)
                    .flat_map(|l| (0..dim).map(move |j| (l, j)))
                    .map(|(l, j)| images[l][(j, i)])
                    .collect();
                matrix(&entries, dim, dim, device)
            })
            .collect();
        Self { maps }
    }

    fn apply(&self, x: &Tensor<2>, p: Tensor<2>) -> Tensor<2> {
        let samples = p.dims()[0];
        let mut sum: Option<Tensor<2>> = None;
        for (i, map) in self.maps.iter().enumerate() {
            let column = x.clone().slice([0..samples, i..i + 1]);
            let term = p.clone().matmul(map.clone()).mul(column);
            sum = Some(match sum {
                Some(sum) => sum.add(term),
                None => term,
            });
        }
        sum.unwrap_or(p)
    }
}

/// Fits S in the exponential chart to pairs (μ′, μ″): min Σ|J_L(∂S/∂p(pᵢ), pᵢ) − μ′ᵢ|² +
/// |J_R(∂S/∂p(pᵢ), pᵢ) − μ″ᵢ|² over the weights and the pᵢ, or a network for them.
///
/// # Errors
/// As [`fit_network`](super::fit_network).
pub fn fit_latent<G: LieGroup<Scalar = f64>>(
    group: &G,
    pairs: &MomentumPairs,
    options: &LatentOptions,
    progress: &mut dyn FnMut(Progress),
) -> Result<LatentFit, LearnError> {
    options.training.check()?;
    if pairs.is_empty() {
        return Err(LearnError::NoSamples);
    }
    let (dim, samples) = pairs.before.shape();
    let mut seen = pairs.before.clone().resize_horizontally(2 * samples, 0.0);
    seen.columns_mut(samples, samples).copy_from(&pairs.after);
    let scaling = Scaling::of(&seen);
    let normalised = |m: &DMatrix<f64>| -> Vec<f64> {
        let columns = m.column_iter();
        columns
            .flat_map(|c| (0..dim).map(|j| scaling.normalise(j, c[j])).collect::<Vec<_>>())
            .collect()
    };
    let (before, after) = (normalised(&pairs.before), normalised(&pairs.after));
    let middle: Vec<f64> = before.iter().zip(&after).map(|(a, b)| 0.5 * (a + b)).collect();
    let mean_width = scaling.half_width.iter().sum::<f64>() / dim as f64;
    // An increment of half a radian for a slope of 1: about right, and weights adapt.
    let scale = 0.5 * mean_width;

    let device = device();
    let generating = Architecture {
        inputs: dim,
        widths: options.training.widths.clone(),
        outputs: 1,
        activation: options.training.activation,
    };
    let mut parts = generating.draw(options.training.seed);
    let momenta = match &options.momenta {
        MomentumModel::Latent => {
            parts.push((vec![0.0; samples * dim], samples, dim));
            None
        }
        MomentumModel::Network(widths) => {
            let network = Architecture {
                inputs: 2 * dim,
                widths: widths.clone(),
                outputs: dim,
                activation: options.training.activation,
            };
            parts.extend(network.draw(options.training.seed.wrapping_add(1)));
            Some(network)
        }
    };
    let (layout, start) = Layout::of(parts, &device);
    let both: Vec<f64> = before
        .chunks_exact(dim)
        .zip(after.chunks_exact(dim))
        .flat_map(|(a, b)| a.iter().chain(b).copied().collect::<Vec<_>>())
        .collect();
    let both = matrix(&both, samples, 2 * dim, &device);
    let middle = matrix(&middle, samples, dim, &device);
    let width = matrix(&scaling.half_width, 1, dim, &device);
    let centre = matrix(&scaling.centre, 1, dim, &device);
    // Row-major samples×dim is column-major dim×samples.
    let mu = matrix(pairs.before.as_slice(), samples, dim, &device);
    let mu_next = matrix(pairs.after.as_slice(), samples, dim, &device);
    let bracket = Bracket::of(group, &device);
    let latent = generating.len();

    let loss = |unknowns: &Unknowns| -> Tensor<1> {
        let offset = match &momenta {
            None => unknowns.at(latent),
            Some(network) => network.value(unknowns, latent, both.clone()),
        };
        let u = middle.clone().add(offset);
        let p = u.clone().mul(width.clone()).add(centre.clone());
        let x = generating.slope(unknowns, 0, u).div(width.clone()).mul_scalar(scale);
        let odd = bracket.apply(&x, p.clone());
        let mut power = bracket.apply(&x, odd.clone());
        let mut even = p.add(power.clone().mul_scalar(BERNOULLI[2]));
        for k in (4..BERNOULLI.len()).step_by(2) {
            power = bracket.apply(&x, bracket.apply(&x, power));
            even = even.add(power.clone().mul_scalar(BERNOULLI[k]));
        }
        let odd = odd.mul_scalar(BERNOULLI[1]);
        let left = even.clone().sub(odd.clone()).sub(mu.clone());
        let right = even.add(odd).sub(mu_next.clone());
        left.clone().mul(left).mean().add(right.clone().mul(right).mean())
    };
    let mut evaluate = |flat: &[f64]| layout.value_and_gradient(flat, &loss);
    let kind = format!("momenta {:?}", options.momenta);
    let task = options.training.task(&kind, &[pairs.before.as_slice(), pairs.after.as_slice()]);
    let (flat, history) = minimise(start, task, &options.training, &mut evaluate, None, progress)?;
    let (hidden, output) = generating.layers(&flat);
    let activation = options.training.activation;
    let network = DenseNetwork::new(activation, scaling, vec![0.0; dim], scale, hidden, output)
        .map_err(|reason| LearnError::NotConverged { reason })?;
    Ok(LatentFit { network, history })
}
