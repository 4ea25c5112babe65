//! The non-symmetric baseline: a type-II generating function in canonical coordinates of T\*G.
//!
//! R. Chen and M. Tao, *Data-driven prediction of general Hamiltonian dynamics via learning
//! exactly-symplectic maps* (2021), as the paper uses it: (q, p) are the canonical coordinates of
//! the phase point in a chart of the whole group, and S(q′, p″) gives p′ = p″ + ∂S/∂q′,
//! q″ = q′ + ∂S/∂p″. The map is symplectic, and knows nothing of the symmetry. S may be of any
//! kind the symmetric models have: a polynomial, a network, or a network on top of a polynomial.

use coadjoint::{Chart, LieGroup, Phase};
use nalgebra::{DMatrix, DVector};

use crate::data::PairRows;
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::function::{MomentumFunction, entries, vector};

/// The map of a type-II generating function S(q′, p″).
#[derive(Clone, Debug)]
pub struct TypeTwo<M> {
    /// The function S of 2n arguments (q′, p″).
    pub function: M,
}

/// Points (q′, p″) and the gradients (p′ − p″, q″ − q′) of S there, 2n×N each.
pub type TypeTwoData = (DMatrix<f64>, DMatrix<f64>);

/// Canonical coordinates (q, p) of a phase point: g = τ(q), p = (d^Lτ_q)ᵀ μ.
fn canonical<G, C>(group: &G, phase: &Phase<G>) -> Option<Vec<f64>>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let chart = C::default();
    let q = entries(&chart.coordinate(group, &phase.group_element)?);
    let minus: Vec<f64> = q.iter().map(|v| -v).collect();
    let p = entries(&chart.pull_back(group, &vector::<G>(&minus), &phase.momentum));
    Some(q.into_iter().chain(p).collect())
}

/// Canonical coordinates of pairs of phase points: (q′, p′) and (q″, p″), 2n×N each.
///
/// # Errors
/// [`LearnError::BadRows`] for attitudes the chart does not reach.
pub fn canonical_pairs<G, C>(
    group: &G,
    pairs: &PairRows<G>,
) -> Result<(DMatrix<f64>, DMatrix<f64>), LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let (mut before, mut after, mut bad) = (Vec::new(), Vec::new(), Vec::new());
    for (row, pair) in &pairs.pairs {
        let ends = canonical::<G, C>(group, &pair.before)
            .zip(canonical::<G, C>(group, &pair.after))
            .filter(|(a, b)| a.iter().chain(b).all(|v| v.is_finite()));
        match ends {
            Some((a, b)) => {
                before.extend(a);
                after.extend(b);
            }
            None => bad.push(BadRow { row: *row, problem: RowProblem::OutOfChart }),
        }
    }
    if !bad.is_empty() {
        let total = pairs.pairs.len();
        return Err(LearnError::BadRows(BadRows { rows: bad, total, chart: C::NAME }));
    }
    let width = 2 * group.dim();
    let count = before.len() / width;
    Ok((DMatrix::from_vec(width, count, before), DMatrix::from_vec(width, count, after)))
}

/// The points and gradients that S has to fit, from pairs of phase points.
///
/// # Errors
/// As [`canonical_pairs`].
pub fn type_two_data<G, C>(group: &G, pairs: &PairRows<G>) -> Result<TypeTwoData, LearnError>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let dim = group.dim();
    let (before, after) = canonical_pairs::<G, C>(group, pairs)?;
    let mut points = before.clone();
    points.rows_mut(dim, dim).copy_from(&after.rows(dim, dim));
    let mut gradients = DMatrix::zeros(2 * dim, before.ncols());
    gradients.rows_mut(0, dim).copy_from(&(before.rows(dim, dim) - after.rows(dim, dim)));
    gradients.rows_mut(dim, dim).copy_from(&(after.rows(0, dim) - before.rows(0, dim)));
    Ok((points, gradients))
}

impl<M: MomentumFunction> TypeTwo<M> {
    /// Maps (q′, p′) to (q″, p″) by Newton's method on p′ = p″ + ∂S/∂q′(q′, p″); `None` where it does
    /// not converge.
    #[must_use]
    pub fn map(&self, state: &[f64]) -> Option<Vec<f64>> {
        let width = state.len();
        let dim = width / 2;
        let mut point = state.to_vec();
        let (mut slope, mut hessian) = (vec![0.0; width], vec![0.0; width * width]);
        let scale = state.iter().map(|v| v.abs()).fold(1.0, f64::max);
        for _ in 0..50 {
            self.function.gradient_and_hessian(&point, &mut slope, &mut hessian);
            let residual = DVector::from_fn(dim, |i, _| point[dim + i] + slope[i] - state[dim + i]);
            let jacobian = DMatrix::from_fn(dim, dim, |i, j| {
                hessian[i * width + dim + j] + if i == j { 1.0 } else { 0.0 }
            });
            let correction = jacobian.lu().solve(&residual)?;
            for i in 0..dim {
                point[dim + i] -= correction[i];
            }
            if correction.amax() <= 1e-13 * scale {
                self.function.gradient(&point, &mut slope);
                for i in 0..dim {
                    point[i] += slope[dim + i];
                }
                return point.iter().all(|v| v.is_finite()).then_some(point);
            }
        }
        None
    }

    /// Maps a phase point, through the chart; `None` where it leaves the chart.
    #[must_use]
    pub fn advance<G, C>(&self, group: &G, phase: &Phase<G>) -> Option<Phase<G>>
    where
        G: LieGroup<Scalar = f64>,
        C: Chart<G>,
    {
        let chart = C::default();
        let next = self.map(&canonical::<G, C>(group, phase)?)?;
        let (q, p) = next.split_at(group.dim());
        let (q, p) = (vector::<G>(q), vector::<G>(p));
        let momentum = chart.right_momentum(group, &q, &p);
        let (element, _) = chart.transport(group, &q, &momentum);
        Some(Phase::new(element, momentum))
    }
}
