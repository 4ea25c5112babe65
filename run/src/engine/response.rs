//! The generating function of a step of collocation, to second order.

use coadjoint::collocation::{Node, Solution};
use coadjoint::groups::Coordinates;
use coadjoint::{LieGroup, StepError};
use coadjoint_codegen::graph::Program;
use coadjoint_codegen::smooth::Smooth;
use coadjoint_program::Argument;
use nalgebra::{DMatrix, DVector};

use super::linear::{columns, meeting};
use super::space::Tables;

/// The spacing of differences that are exact on polynomials.
const SPACING: f64 = 0.25;

/// The second derivatives of a smooth Hamiltonian, and those of the generating functions of its steps.
pub(crate) struct Response<'a> {
    smooth: &'a Smooth,
    symbols: Vec<f64>,
    /// μ, t, the signals, v ↦ ∂²H/∂μ² v.
    hessian: Program,
    /// μ, t, the signals, the change of the symbols ↦ that of ∂H/∂μ.
    mixed: Program,
    /// The derivatives of the symbols in each parameter.
    slopes: Vec<Vec<f64>>,
}

impl<'a> Response<'a> {
    /// For these values of the parameters that the system keeps.
    pub(crate) fn new(smooth: &'a Smooth, parameters: &[f64]) -> Self {
        let symbols = smooth.symbols_at(parameters);
        let inputs: Vec<Argument> = (0..smooth.algebra.dim()).map(Argument::Input).collect();
        let slots: Vec<Argument> = (0..symbols.len()).map(Argument::Slot).collect();
        let slope = |number: usize| {
            let mut change = vec![0.0; parameters.len()];
            change[number] = 1.0;
            let slopes = smooth.symbols.iter().map(|symbol| symbol.expr.slope(parameters, &change));
            slopes.collect()
        };
        let hessian = smooth.gradient.push_forward(&inputs);
        let mixed = smooth.gradient.push_forward(&slots);
        let slopes = (0..parameters.len()).map(slope).collect();
        Self { smooth, symbols, hessian, mixed, slopes }
    }

    /// q, the number of parameters.
    pub(crate) fn parameters(&self) -> usize {
        self.slopes.len()
    }

    /// [S_PP, S_Pθ] (n×n and n×q) of the step of size `step` with this solution, x = ∂S/∂P(P).
    ///
    /// They are δx = Σ bᵢ δ(hẋᵢ) of the linear equations δ(hẋᵢ, hṗᵢ) = Kᵢ (δxᵢ, δpᵢ) + h ∂(ẋᵢ, ṗᵢ)/∂ω ∂²H/∂μ∂θ δθ, with
    /// δxᵢ and δpᵢ from δP and from these as in the equations of a step.
    ///
    /// # Errors
    /// Fails if two solutions meet.
    pub(crate) fn of<const M: usize>(
        &self,
        group: &Tables,
        solution: &Solution<DVector<f64>, M>,
        step: f64,
    ) -> Result<[DMatrix<f64>; 2], StepError> {
        let (n, q) = (group.dim(), self.parameters());
        let size = 2 * n;
        let mut matrix = DMatrix::identity(size * M, size * M);
        let mut right = DMatrix::zeros(size * M, n + q);
        for (i, node) in solution.nodes.iter().enumerate() {
            let [by_state, by_parameters] = self.node::<M>(group, node, step);
            for j in 0..M {
                let weight = solution.matrix[j][i];
                let mut block = matrix.view_mut((i * size, j * size), (size, size));
                block -= &by_state * weight;
            }
            let mut rows = right.rows_mut(i * size, size);
            rows.columns_mut(0, n).copy_from(&by_state.columns(n, n));
            rows.columns_mut(n, q).copy_from(&by_parameters);
        }
        let solved = matrix.lu().solve(&right).ok_or_else(|| meeting(&solution.x))?;
        let mut whole = DMatrix::zeros(n, n + q);
        for (i, weight) in solution.weights.iter().enumerate() {
            whole += solved.rows(i * size, n) * *weight;
        }
        let hessian = whole.columns(0, n);
        // Symmetric but for rounding.
        let symmetric = (hessian + hessian.transpose()) * 0.5;
        Ok([symmetric, whole.columns(n, q).into_owned()])
    }

    /// The derivatives of h(ẋ, ṗ) at a node: in (x, p), 2n×2n, and in the parameters, 2n×q.
    fn node<const M: usize>(
        &self,
        group: &Tables,
        node: &Node<DVector<f64>>,
        step: f64,
    ) -> [DMatrix<f64>; 2] {
        let (n, Node { time, x, p, momentum }) = (group.dim(), node);
        let row = |v: &DVector<f64>| DVector::by_node::<1>(n, |_| v.clone());
        let rates = |x: &DVector<f64>, p: &DVector<f64>, omega: &DVector<f64>| {
            let rates = group.node_rates::<1>(&row(x), &row(p), &row(omega), 2 * M - 2);
            DVector::from_iterator(2 * n, rates.iter().flatten().map(|&[rate]| rate))
        };
        let run = |program: &Program, change: &[f64]| {
            let mut inputs = self.smooth.inputs(*time, momentum.as_slice());
            inputs.extend_from_slice(change);
            DVector::from_vec(program.run(&inputs, &self.symbols))
        };
        let omega = self.smooth.gradient(&self.symbols, *time, momentum.as_slice());
        let omega = DVector::from_vec(omega) * step;
        // (∂J_R/∂p)ᵀ above −(∂J_R/∂x)ᵀ, and ∂J_R/∂(x, p).
        let lift = columns(n, |unit| rates(x, p, unit));
        let (up, down) = (lift.rows(0, n), lift.rows(n, n));
        let mut slope = DMatrix::zeros(n, 2 * n);
        slope.columns_mut(0, n).copy_from(&-down.transpose());
        slope.columns_mut(n, n).copy_from(&up.transpose());
        let hessian = columns(n, |unit| run(&self.hessian, unit.as_slice()));
        let mut by_state = &lift * (hessian * step) * slope;
        let mut by_place = by_state.columns_mut(0, n);
        by_place += columns(n, |unit| derivative::<M>(|s| rates(&(x + unit * s), p, &omega)));
        // ẋ does not depend on p, and ṗ is linear in it.
        let mut by_momentum = by_state.view_mut((n, n), (n, n));
        by_momentum += columns(n, |unit| rates(x, unit, &omega).rows(n, n).into_owned());
        let mut mixed = DMatrix::zeros(n, self.parameters());
        for (mut column, slopes) in mixed.column_iter_mut().zip(&self.slopes) {
            column.copy_from(&run(&self.mixed, slopes));
        }
        [by_state, lift * (mixed * step)]
    }
}

/// The derivative at 0 of a polynomial of at most degree 2M − 2, by central differences, which are then exact.
fn derivative<const M: usize>(f: impl Fn(f64) -> DVector<f64>) -> DVector<f64> {
    let mut sum = f(0.0);
    sum.fill(0.0);
    let mut weight = 1.0;
    for k in 1..M {
        // 2 (m!)²/((m − k)! (m + k)!) with m = M − 1, over k, with alternating signs.
        weight *= (M - k) as f64 / (M - 1 + k) as f64;
        let at = SPACING * k as f64;
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        sum += (f(at) - f(-at)) * (sign * weight / at);
    }
    sum
}
