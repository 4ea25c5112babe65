//! The paper's alternative loss Σ|exp⁻¹(gᵢ⁻¹ τ(∂S/∂p(pᵢ)))|², by Gauss–Newton.

use coadjoint::LieGroup;
use coadjoint::groups::Chart;
use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DVector};

use super::model::PolynomialModel;
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::function::{MomentumFunction, entries, vector};
use crate::least_squares::GaussNewton;
use crate::trivialisation::{left_derivative, left_exp_derivative_inverse};

/// Refines `start` (the fit in chart coordinates) to the least Σ|exp⁻¹(gᵢ⁻¹ τ(∂S/∂p(pᵢ)))|², the
/// distance measured on the group.
///
/// # Errors
/// [`LearnError::OutOfChart`] when the group distance of a sample does not exist at the start.
pub fn fit_group_loss<G, C>(
    group: &G,
    data: &ReducedData,
    start: &PolynomialModel,
    options: &GaussNewton,
) -> Result<(PolynomialModel, Vec<f64>), LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let (dim, samples) = data.p.shape();
    let terms = start.basis().len();
    let chart = C::default();
    let origin = vector::<G>(&vec![0.0; dim]);
    let inverse: Vec<G::Element> = data
        .x
        .column_iter()
        .map(|x| group.inverse(&chart.transport(group, &vector::<G>(x.as_slice()), &origin).0))
        .collect();

    // r = exp⁻¹(gᵢ⁻¹ τ(x)) and the x it belongs to.
    let distance = |i: usize, model: &PolynomialModel| {
        cancel::check();
        let mut x = vec![0.0; dim];
        model.gradient(data.p.column(i).as_slice(), &mut x);
        let x = vector::<G>(&x);
        let reached = chart.transport(group, &x, &origin).0;
        group.log(&group.compose(&inverse[i], &reached)).map(|r| (r, x))
    };
    let residual = |c: &DVector<f64>| {
        let model = start.clone().with_coefficients(c.as_slice());
        let mut all = Vec::with_capacity(dim * samples);
        for i in 0..samples {
            all.extend(entries(&distance(i, &model)?.0));
        }
        Some(DVector::from_vec(all)).filter(|r| r.iter().all(|v| v.is_finite()))
    };
    let linearise = |c: &DVector<f64>| {
        let model = start.clone().with_coefficients(c.as_slice());
        let mut all = DVector::zeros(dim * samples);
        let mut jacobian = DMatrix::zeros(dim * samples, terms);
        let mut row = vec![0.0; terms * dim];
        for i in 0..samples {
            let (r, x) = distance(i, &model)?;
            // δr = (d^L exp_r)⁻¹ d^Lτ_x δx, since gᵢ⁻¹τ(x) moves by its left velocity.
            let map = left_exp_derivative_inverse(group, &r) * left_derivative(group, chart, &x);
            model.basis_gradients(data.p.column(i).as_slice(), &mut row);
            let slopes = map * DMatrix::from_column_slice(dim, terms, &row);
            jacobian.rows_mut(i * dim, dim).copy_from(&slopes);
            all.rows_mut(i * dim, dim).copy_from_slice(&entries(&r));
        }
        Some((all, jacobian))
    };
    let first = DVector::from_column_slice(start.coefficients());
    let (unknowns, history) =
        options.minimise(first, residual, linearise).ok_or(LearnError::OutOfChart(C::NAME))?;
    let count = (dim * samples) as f64;
    let history = history.iter().map(|sum| sum / count).collect();
    Ok((start.clone().with_coefficients(unknowns.as_slice()), history))
}
