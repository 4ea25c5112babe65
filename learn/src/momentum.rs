//! Poisson maps from momenta alone, (μ′, μ″): the canonical momenta are eliminated by Newton's method (section 5.3 of the
//! paper).

use coadjoint::LieGroup;
use coadjoint::groups::{Chart, Coordinates};
use coadjoint::solve::solve;
use nalgebra::{DMatrix, DVector};

use crate::data::MomentumPairs;
use crate::error::LearnError;
use crate::function::{Generating, MomentumFunction, entries, vector};
use crate::least_squares::GaussNewton;
use crate::polynomial::{Basis, PolynomialModel, Scaling};

/// The iteration; its ridge fixes the rotation about μ that momenta do not determine.
const ITERATION: GaussNewton =
    GaussNewton { iterations: 60, relative_decrease: 1e-3, ridge: 1e-16 };

/// Refuses a degree that this number of samples does not support.
pub(crate) fn check(dim: usize, degree: usize, samples: usize) -> Result<(), LearnError> {
    Basis::check_fit(dim, degree, samples)?;
    if degree == 0 {
        let requirement = "a generating function without terms moves nothing; give 2 or more";
        return Err(LearnError::option("degree", 0, requirement));
    }
    Ok(())
}

/// Fits S of this total degree to pairs (μ′, μ″): min Σ|Φ_S(μ′ᵢ) − μ″ᵢ|², where Φ_S solves
/// J_L(∂S/∂p(p), p) = μ′ for p. Returns S and the mean squared error of μ″ after each accepted step of the iteration.
/// The attitude that S would reconstruct is arbitrary up to a rotation about the momentum, because the data do not
/// contain it.
///
/// The paper makes the pᵢ unknowns of the fit, as many as there are samples; here each is a
/// function of the coefficients, so the unknowns are the coefficients alone. With δc the change
/// of the coefficients, x = ∂S/∂p moves by δx = (1 − Hess S·D)⁻¹ ∂δS/∂p and
/// δμ″ = ad\*_{d^Lτ_x δx} μ″.
///
/// # Errors
/// [`LearnError::NotConverged`] when a p cannot be solved for, at the start or on the way.
pub fn fit_poisson<G, C>(
    group: &G,
    pairs: &MomentumPairs,
    degree: usize,
) -> Result<(PolynomialModel, Vec<f64>), LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    if pairs.count() == 0 {
        return Err(LearnError::NoSamples);
    }
    check(group.dim(), degree, pairs.count())?;
    let (dim, samples) = pairs.before.shape();
    // p is near both momenta.
    let mut seen = pairs.before.clone().resize_horizontally(2 * samples, 0.0);
    seen.columns_mut(samples, samples).copy_from(&pairs.after);
    let start = PolynomialModel::zero(Basis::new(dim, degree), Scaling::of(&seen));
    let terms = start.basis().terms().len();

    let residual = |c: &DVector<f64>| {
        let model = start.clone().with_coefficients(c.as_slice());
        let generating = Generating::<G, C, &dyn MomentumFunction>::new(group.clone(), &model);
        let mut all = Vec::with_capacity(dim * samples);
        for (before, after) in pairs.before.column_iter().zip(pairs.after.column_iter()) {
            let mu = vector::<G>(before.as_slice());
            let next = coadjoint::steps::poisson_map(&generating, &mu).ok()?;
            all.extend((0..dim).map(|j| next[j] - after[j]));
        }
        Some(DVector::from_vec(all)).filter(|r| r.iter().all(|v| v.is_finite()))
    };
    let linearise = |c: &DVector<f64>| {
        let model = start.clone().with_coefficients(c.as_slice());
        let generating = Generating::<G, C, &dyn MomentumFunction>::new(group.clone(), &model);
        let mut all = DVector::zeros(dim * samples);
        let mut jacobian = DMatrix::zeros(dim * samples, terms);
        let mut row = vec![0.0; terms * dim];
        for i in 0..samples {
            let mu = vector::<G>(pairs.before.column(i).as_slice());
            let point = solve(&generating, &mu).ok()?;
            let (next, map) = response(group, C::default(), &model, &mu, &point.x, &point.p)?;
            model.basis_gradients(&entries(&point.p), &mut row);
            let slopes = map * DMatrix::from_column_slice(dim, terms, &row);
            jacobian.rows_mut(i * dim, dim).copy_from(&slopes);
            for j in 0..dim {
                all[i * dim + j] = next[j] - pairs.after[(j, i)];
            }
        }
        Some((all, jacobian))
    };
    let found = ITERATION.minimise(DVector::zeros(terms), residual, linearise);
    let (unknowns, history) = found.ok_or_else(|| {
        let reason = "no canonical momentum p solves J_L(dS/dp, p) = mu for some sample";
        LearnError::NotConverged(reason.into())
    })?;
    let history = history.iter().map(|sum| sum / (dim * samples) as f64).collect();
    Ok((start.clone().with_coefficients(unknowns.as_slice()), history))
}

/// μ″ at the solution (x, p) over μ′, and the matrix of ∂δS/∂p ↦ δμ″.
fn response<G, C>(
    group: &G,
    chart: C,
    model: &PolynomialModel,
    mu: &G::Vector,
    x: &G::Vector,
    p: &G::Vector,
) -> Option<(G::Vector, DMatrix<f64>)>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let dim = x.dim();
    let mut gradient = vec![0.0; dim];
    let mut hessian = vec![0.0; dim * dim];
    model.gradient_and_hessian(&entries(p), &mut gradient, &mut hessian);
    let hessian = DMatrix::from_row_slice(dim, dim, &hessian);
    let (_, derivative) = chart.pull_back_with_derivative(group, x, mu);
    let derivative = DMatrix::from_fn(dim, dim, |i, j| derivative[(i, j)]);
    // δp = D δx and δx = Hess S δp + ∂δS/∂p.
    let system = DMatrix::identity(dim, dim) - hessian * derivative;
    let moves = system.try_inverse()?;
    let next = chart.transport(group, x, mu).1;
    let turn = ad_star_matrix(group, &next) * left_derivative(group, chart, x);
    Some((next, turn * moves))
}

/// d^Lτ_x, where τ⁻¹dτ = d^Lτ_x dx: row j is (d^Lτ_x)ᵀ e^j, and d^Lτ_x = d^Rτ_{−x}.
fn left_derivative<G, C>(group: &G, chart: C, x: &G::Vector) -> DMatrix<f64>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let dim = x.dim();
    let minus = G::Vector::from_entries(dim, |i| -x[i]);
    let row = |j| chart.pull_back(group, &minus, &G::Vector::unit(dim, j));
    let rows: Vec<f64> = (0..dim).flat_map(|j| entries(&row(j))).collect();
    DMatrix::from_row_slice(dim, dim, &rows)
}

/// The matrix of ξ ↦ ad\*_ξ μ.
fn ad_star_matrix<G>(group: &G, mu: &G::Vector) -> DMatrix<f64>
where
    G: LieGroup<Scalar = f64>,
{
    let dim = mu.dim();
    let column = |j| group.ad_star(&G::Vector::unit(dim, j), mu);
    let columns: Vec<f64> = (0..dim).flat_map(|j| entries(&column(j))).collect();
    DMatrix::from_column_slice(dim, dim, &columns)
}
