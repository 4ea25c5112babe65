//! The laws of a Poisson map and its symplectic lift, except the order of accuracy.

use coadjoint::{Chart, Phase, StepError, advance, poisson_map, solve};
use nalgebra::{DMatrix, DVector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::differences::jacobian;
use super::{Law, Trial};
use crate::engine::{Group, Interpreter};
use crate::error::CliError;

/// Allowed where derivatives are taken by differences.
const BY_DIFFERENCES: f64 = 1e-9;
/// Allowed where two results should agree to rounding.
const TO_ROUNDING: f64 = 1e-12;
/// The spacing of differences, relative to the size of the variable.
const SPACING: f64 = 1e-2;

const LAWS: [(&str, &str, f64); 6] = [
    ("Poisson", "DΦ B(μ) DΦᵀ = B(Φ(μ))", BY_DIFFERENCES),
    ("symplectic", "Φ*ω = ω on T*G", BY_DIFFERENCES),
    ("equivariant", "Φ(k·α) = k·Φ(α)", TO_ROUNDING),
    ("momentum", "J_L(Φ(α)) = J_L(α)", TO_ROUNDING),
    ("diagram", "J_R(Φ(α)) = Φ(J_R(α))", TO_ROUNDING),
    ("symmetric", "Φ₋ₕ(Φₕ(α)) = α", TO_ROUNDING),
];

/// The largest violation of each law over the points.
pub fn try_all<G: Group, C: Chart<G>>(
    trial: &Trial<'_>,
    group: &G,
    random: &mut ChaCha8Rng,
) -> Result<Vec<Law>, CliError> {
    let at = |source| CliError::Step { time: 0.0, source };
    let forward = Interpreter::<G, C>::new(trial.integrator, group.clone(), trial.step);
    let backward = Interpreter::<G, C>::new(trial.integrator, group.clone(), -trial.step);
    let maps = Maps { group, forward: forward.map_err(at)?, backward: backward.map_err(at)? };
    let mut worst = [0.0_f64; LAWS.len()];
    for _ in 0..trial.points {
        let phase = Phase::new(
            group.exp(&vector(random, group.dim(), 1.0)),
            vector(random, group.dim(), trial.size),
        );
        let other = group.exp(&vector(random, group.dim(), 1.0));
        let found = maps.violations(&phase, &other, trial.size).map_err(at)?;
        for (worst, found) in worst.iter_mut().zip(found) {
            // A NaN must not look like a law that holds.
            *worst = if found.is_nan() { f64::INFINITY } else { worst.max(found) };
        }
    }
    let law = |((name, statement, bound), value): (&(&'static str, &'static str, f64), f64)| Law {
        name,
        statement,
        value,
        bound: *bound,
        pass: value <= *bound,
    };
    Ok(LAWS.iter().zip(worst).map(law).collect())
}

/// Coordinates between −size and size.
pub fn vector(random: &mut ChaCha8Rng, dim: usize, size: f64) -> DVector<f64> {
    DVector::from_fn(dim, |_, _| size * (2.0 * random.random::<f64>() - 1.0))
}

struct Maps<'a, G, C> {
    group: &'a G,
    forward: Interpreter<'a, G, C>,
    backward: Interpreter<'a, G, C>,
}

impl<G: Group, C: Chart<G>> Maps<'_, G, C> {
    fn step(&self, phase: &Phase<G>) -> Result<Phase<G>, StepError> {
        let mut moved = phase.clone();
        advance(&self.forward, &mut moved)?;
        Ok(moved)
    }

    /// In the order of [`LAWS`], each relative to the size of what is compared.
    fn violations(
        &self,
        phase: &Phase<G>,
        k: &G::Element,
        size: f64,
    ) -> Result<[f64; LAWS.len()], StepError> {
        let group = self.group;
        let mu = &phase.momentum;
        let moved = self.step(phase)?;
        let image = poisson_map(&self.forward, mu)?;

        let pushed = Phase::new(group.compose(k, &phase.group_element), mu.clone());
        let pushed = self.step(&pushed)?;
        let expected = group.compose(k, &moved.group_element);
        let equivariant = self.distance(&pushed.group_element, &expected).max(relative(
            &pushed.momentum,
            &moved.momentum,
            size,
        ));

        let (before, after) = (phase.spatial_momentum(group), moved.spatial_momentum(group));
        let momentum = relative(&after, &before, before.amax());
        let diagram = relative(&moved.momentum, &image, size);

        let mut back = moved.clone();
        advance(&self.backward, &mut back)?;
        let symmetric = self.distance(&back.group_element, &phase.group_element).max(relative(
            &back.momentum,
            mu,
            size,
        ));

        let poisson = self.poisson(mu, &image, size)?;
        let symplectic = self.symplectic(phase, &moved, size)?;
        Ok([poisson, symplectic, equivariant, momentum, diagram, symmetric])
    }

    /// The largest entry of DΦ B(μ) DΦᵀ − B(Φ(μ)), relative to the largest of B.
    fn poisson(
        &self,
        mu: &DVector<f64>,
        image: &DVector<f64>,
        size: f64,
    ) -> Result<f64, StepError> {
        let n = mu.len();
        let derivative = jacobian(
            n,
            n,
            |_| SPACING * size,
            |i, x| {
                let mut shifted = mu.clone();
                shifted[i] += x;
                poisson_map(&self.forward, &shifted)
            },
        )?;
        let (here, there) = (-self.bracket_form(mu), -self.bracket_form(image));
        let difference = &derivative * &here * derivative.transpose() - &there;
        Ok(ratio(difference.amax(), here.amax().max(there.amax())))
    }

    /// ⟨μ, [eᵢ, eⱼ]⟩; the Poisson tensor is its opposite.
    fn bracket_form(&self, mu: &DVector<f64>) -> DMatrix<f64> {
        let n = mu.len();
        let unit = |i: usize| DVector::from_fn(n, |k, _| if i == k { 1.0 } else { 0.0 });
        let rows: Vec<_> = (0..n).map(|i| self.group.ad_star(&unit(i), mu)).collect();
        DMatrix::from_fn(n, n, |i, j| rows[i][j])
    }

    /// ω on the pairs (ξ, ν) of the left trivialisation:
    /// ω((ξ₁, ν₁), (ξ₂, ν₂)) = ⟨ν₂, ξ₁⟩ − ⟨ν₁, ξ₂⟩ + ⟨μ, [ξ₁, ξ₂]⟩.
    fn symplectic_form(&self, mu: &DVector<f64>) -> DMatrix<f64> {
        let n = mu.len();
        let mut form = DMatrix::zeros(2 * n, 2 * n);
        form.view_mut((0, 0), (n, n)).copy_from(&self.bracket_form(mu));
        for i in 0..n {
            form[(i, n + i)] = 1.0;
            form[(n + i, i)] = -1.0;
        }
        form
    }

    /// The largest entry of Φ*ω − ω, relative to the largest of ω.
    fn symplectic(&self, phase: &Phase<G>, moved: &Phase<G>, size: f64) -> Result<f64, StepError> {
        let derivative = match self.derivative_by_logarithm(phase, moved, size)? {
            Some(derivative) => derivative,
            None => self.derivative_by_chart(phase, size)?,
        };
        let (here, there) =
            (self.symplectic_form(&phase.momentum), self.symplectic_form(&moved.momentum));
        let difference = derivative.transpose() * there * &derivative - &here;
        Ok(ratio(difference.amax(), here.amax()))
    }

    /// DΦ in the left trivialisation, from nearby group elements; `None` where they have no
    /// logarithm, as adjoint matrices of an algebra with a centre.
    fn derivative_by_logarithm(
        &self,
        phase: &Phase<G>,
        moved: &Phase<G>,
        size: f64,
    ) -> Result<Option<DMatrix<f64>>, StepError> {
        let (group, n) = (self.group, phase.momentum.len());
        let home = group.inverse(&moved.group_element);
        let mut lost = false;
        let spacing = |i: usize| if i < n { SPACING } else { SPACING * size };
        let derivative = jacobian(2 * n, 2 * n, spacing, |i, x| {
            let mut shifted = phase.clone();
            if i < n {
                let mut xi = DVector::zeros(n);
                xi[i] = x;
                shifted.group_element = group.compose(&phase.group_element, &group.exp(&xi));
            } else {
                shifted.momentum[i - n] += x;
            }
            let image = self.step(&shifted)?;
            let difference = group.compose(&home, &image.group_element);
            let eta = group.log(&difference).unwrap_or_else(|| {
                lost = true;
                DVector::zeros(n)
            });
            Ok(stacked(&eta, &(&image.momentum - &moved.momentum)))
        })?;
        Ok((!lost).then_some(derivative))
    }

    /// DΦ in the left trivialisation, from the chart: g″ = g′τ(x) with x depending on μ′ only, so
    /// η = Ad_{τ(x)⁻¹}(ξ + d^Rτ_x δx).
    fn derivative_by_chart(&self, phase: &Phase<G>, size: f64) -> Result<DMatrix<f64>, StepError> {
        let (group, mu) = (self.group, &phase.momentum);
        let n = mu.len();
        let chart = C::default();
        let x = solve(&self.forward, mu)?.x;
        let back = group.inverse(&chart.transport(group, &x, mu).0);
        let unit = |i: usize| DVector::from_fn(n, |k, _| if i == k { 1.0 } else { 0.0 });
        let pulled: Vec<_> = (0..n).map(|j| chart.pull_back(group, &x, &unit(j))).collect();
        let right = DMatrix::from_fn(n, n, |i, j| pulled[i][j]);
        let by_momentum = jacobian(
            2 * n,
            n,
            |_| SPACING * size,
            |i, x| {
                let mut shifted = mu.clone();
                shifted[i] += x;
                let image = poisson_map(&self.forward, &shifted)?;
                Ok(stacked(&solve(&self.forward, &shifted)?.x, &image))
            },
        )?;
        let mut derivative = DMatrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            let column = group.adjoint(&back, &unit(i));
            derivative.view_mut((0, i), (n, 1)).copy_from(&column);
            let xi = &right * by_momentum.view((0, i), (n, 1));
            let column = group.adjoint(&back, &xi.column(0).into_owned());
            derivative.view_mut((0, n + i), (n, 1)).copy_from(&column);
        }
        derivative.view_mut((n, n), (n, n)).copy_from(&by_momentum.view((n, 0), (n, n)));
        Ok(derivative)
    }

    /// The largest difference of entries, relative to the largest entry.
    fn distance(&self, g: &G::Element, h: &G::Element) -> f64 {
        let size = self.group.matrix_size();
        let (mut difference, mut largest) = (0.0_f64, 0.0_f64);
        for i in 0..size {
            for j in 0..size {
                let (a, b) = (self.group.matrix_entry(g, i, j), self.group.matrix_entry(h, i, j));
                difference = difference.max((a - b).abs());
                largest = largest.max(b.abs());
            }
        }
        ratio(difference, largest)
    }
}

fn stacked(a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(a.len() + b.len(), a.iter().chain(b.iter()).copied())
}

fn relative(a: &DVector<f64>, b: &DVector<f64>, size: f64) -> f64 {
    ratio((a - b).amax(), size)
}

fn ratio(difference: f64, size: f64) -> f64 {
    if size > 0.0 { difference / size } else { difference }
}
