//! The derivative of a step, as matrices.
//!
//! A tangent to a state (g, μ) is (ξ, ν), ξ = g⁻¹δg in 𝔤 and ν = δμ in 𝔤\*: 2n numbers. A step is a sequence of motions
//! by group elements and of kicks, whatever has found them. With L = d^L τ_x, of the motion by τ(x)
//!
//! ```text
//! ξ″ = Ad_{τ(x)⁻¹} ξ + L δx        ν″ = Ad*_{τ(x)⁻¹} ν + ad*_{L δx} μ″
//! ```
//!
//! and the method enters by δx alone: where x = ∂S/∂p(p), p = (d^R τ_x)ᵀ μ, by the Hessian of S at the p of the step,
//! δx = (1 − S_pp D)⁻¹ (S_pp (d^R τ_x)ᵀ ν + S_pθ δθ), D = ∂p/∂x. Every symmetric S_pp makes this symplectic.

use coadjoint::groups::Chart;
use coadjoint::steps::Circumstances;
use coadjoint::{Phase, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_program::Argument;
use nalgebra::{DMatrix, DVector};

use super::space::Group;

/// The derivative of a step, or of several, in the state before it and in the parameters θ.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Linear {
    /// ∂(ξ″, ν″)/∂(ξ, ν), 2n×2n.
    pub state: DMatrix<f64>,
    /// ∂(ξ″, ν″)/∂θ, 2n×q.
    pub parameters: DMatrix<f64>,
}

/// The matrix of a linear map of 𝔤 or 𝔤\*.
pub(super) fn columns(dim: usize, map: impl Fn(&DVector<f64>) -> DVector<f64>) -> DMatrix<f64> {
    let unit = |j| DVector::from_fn(dim, |i, _| if i == j { 1.0 } else { 0.0 });
    DMatrix::from_columns(&(0..dim).map(|j| map(&unit(j))).collect::<Vec<_>>())
}

/// The derivative of a program in all of its inputs.
pub(super) fn push_forward(program: &Program) -> Program {
    let inputs: Vec<Argument> = (0..program.inputs()).map(Argument::Input).collect();
    program.push_forward(&inputs)
}

/// A matrix of `dim` rows with these columns, of which there may be none.
pub(super) fn matrix(dim: usize, columns: impl Iterator<Item = DVector<f64>>) -> DMatrix<f64> {
    let entries: Vec<f64> = columns.flat_map(|column| column.as_slice().to_vec()).collect();
    DMatrix::from_column_slice(dim, entries.len() / dim, &entries)
}

/// The error of a step whose solution is also that of another one.
pub(super) fn meeting(x: &DVector<f64>) -> StepError {
    let at = Circumstances { x: x.amax(), ratio: 0.0, usable_step: None };
    StepError::NotFollowed { reached: 1.0, at }
}

impl Linear {
    /// The derivative of the identity.
    pub(crate) fn identity(dim: usize, parameters: usize) -> Self {
        let state = DMatrix::identity(2 * dim, 2 * dim);
        Self { state, parameters: DMatrix::zeros(2 * dim, parameters) }
    }

    /// The derivative of this step followed by the next one.
    pub(crate) fn then(&self, next: &Self) -> Self {
        let parameters = &next.state * &self.parameters + &next.parameters;
        Self { state: &next.state * &self.state, parameters }
    }

    /// The derivative of μ ↦ μ + l τ(g, θ), given the derivatives of l τ in ξ (n×n) and in θ (n×q).
    pub(super) fn of_kick(by_element: &DMatrix<f64>, by_parameters: &DMatrix<f64>) -> Self {
        let dim = by_element.nrows();
        let mut kick = Self::identity(dim, by_parameters.ncols());
        kick.state.view_mut((dim, 0), (dim, dim)).copy_from(by_element);
        kick.parameters.rows_mut(dim, dim).copy_from(by_parameters);
        kick
    }

    /// The derivative of the motion by τ(x) to the momentum `after`, given ∂x/∂μ (n×n) and ∂x/∂θ (n×q).
    pub(super) fn of_motion<G: Group, C: Chart<G>>(
        (chart, group): (C, &G),
        x: &DVector<f64>,
        after: &DVector<f64>,
        [by_momentum, by_parameters]: &[DMatrix<f64>; 2],
    ) -> Self {
        let (dim, back) = (x.len(), -x);
        let coadjoint = columns(dim, |unit| chart.transport(group, x, unit).1);
        // Ad_{τ⁻¹} is the transpose of Ad*_τ, and d^L τ_x = d^R τ_{−x}.
        let adjoint = columns(dim, |unit| chart.transport(group, &back, unit).1).transpose();
        let left = columns(dim, |unit| chart.pull_back(group, &back, unit)).transpose();
        let bent = columns(dim, |unit| group.ad_star(unit, after)) * &left;
        let mut linear = Self::identity(dim, by_parameters.ncols());
        let Self { state, parameters } = &mut linear;
        state.view_mut((0, 0), (dim, dim)).copy_from(&adjoint);
        state.view_mut((0, dim), (dim, dim)).copy_from(&(&left * by_momentum));
        state.view_mut((dim, dim), (dim, dim)).copy_from(&(coadjoint + &bent * by_momentum));
        parameters.rows_mut(0, dim).copy_from(&(left * by_parameters));
        parameters.rows_mut(dim, dim).copy_from(&(bent * by_parameters));
        linear
    }

    /// [∂x/∂μ, ∂x/∂θ] of the solution x = ∂S/∂p(p), p = (d^R τ_x)ᵀ μ, given S_pp (n×n) and S_pθ (n×q) there.
    ///
    /// # Errors
    /// Fails if two solutions meet.
    pub(super) fn response<G: Group, C: Chart<G>>(
        (chart, group): (C, &G),
        x: &DVector<f64>,
        mu: &DVector<f64>,
        [hessian, mixed]: [&DMatrix<f64>; 2],
    ) -> Result<[DMatrix<f64>; 2], StepError> {
        let dim = x.len();
        let slope = chart.pull_back_derivative(group, x, mu);
        let back = columns(dim, |unit| chart.pull_back(group, x, unit));
        let solver = (DMatrix::identity(dim, dim) - hessian * slope).lu();
        let solved = [solver.solve(&(hessian * back)), solver.solve(mixed)];
        let [Some(by_momentum), Some(by_parameters)] = solved else {
            return Err(meeting(x));
        };
        Ok([by_momentum, by_parameters])
    }
}

/// Moves a state by τ(x); the derivative of that.
pub(super) fn moved<G: Group, C: Chart<G>>(
    (chart, group): (C, &G),
    x: &DVector<f64>,
    phase: &mut Phase<G>,
    response: &[DMatrix<f64>; 2],
) -> Linear {
    let (increment, after) = chart.transport(group, x, &phase.momentum);
    let linear = Linear::of_motion((chart, group), x, &after, response);
    phase.group_element = group.compose(&phase.group_element, &increment);
    phase.momentum = after;
    linear
}
