//! Reduction: from pairs in T\*G to points (x, p) of a Lagrangian submanifold of T\*G.

use coadjoint::groups::{Chart, Coordinates};
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::cancel;
use nalgebra::{DMatrix, DVector};

use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::function::{MomentumFunction, entries, vector};
use crate::group::DataGroup;
use crate::least_squares::Reduced;
use crate::polynomial::{Basis, PolynomialModel, Scaling};

/// Pairs of momenta, a sample per column.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumPairs {
    /// μ′, n×N.
    pub before: DMatrix<f64>,
    /// μ″, n×N.
    pub after: DMatrix<f64>,
}

impl MomentumPairs {
    pub(crate) fn count(&self) -> usize {
        self.before.ncols()
    }

    pub(crate) fn select(&self, samples: &[usize]) -> Self {
        Self {
            before: self.before.select_columns(samples),
            after: self.after.select_columns(samples),
        }
    }
}

/// Reduced data: points (x, p) of the Lagrangian submanifold to be learned, a sample per column,
/// and the momenta they came from.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedData {
    /// x, the chart coordinate of g′⁻¹g″, n×N.
    pub x: DMatrix<f64>,
    /// p = (d^Lτ_x)ᵀ μ″, the canonical momentum of g′⁻¹·α″, n×N.
    pub p: DMatrix<f64>,
    /// μ′ and μ″.
    pub momenta: MomentumPairs,
}

impl ReducedData {
    /// N, the number of samples.
    pub fn count(&self) -> usize {
        self.p.ncols()
    }

    pub(crate) fn select(&self, samples: &[usize]) -> Self {
        Self {
            x: self.x.select_columns(samples),
            p: self.p.select_columns(samples),
            momenta: self.momenta.select(samples),
        }
    }
}

/// A pair of phase points, before and after a step.
#[derive(Debug)]
pub struct PhasePair<G: LieGroup> {
    /// (g′, μ′).
    pub before: Phase<G>,
    /// (g″, μ″).
    pub after: Phase<G>,
}

impl<G: LieGroup> Clone for PhasePair<G> {
    fn clone(&self) -> Self {
        Self { before: self.before.clone(), after: self.after.clone() }
    }
}

/// Pairs of phase points with their row numbers, and the rows that gave none.
#[derive(Clone, Debug)]
pub struct PairRows<G: LieGroup> {
    /// The pairs, each with the number of its row, from 1.
    pub pairs: Vec<(usize, PhasePair<G>)>,
    /// Rows already known to be bad.
    pub bad: Vec<BadRow>,
}

impl<G: LieGroup> From<Vec<PhasePair<G>>> for PairRows<G> {
    /// Numbers the pairs from 1.
    fn from(pairs: Vec<PhasePair<G>>) -> Self {
        let pairs = pairs.into_iter().enumerate().map(|(i, pair)| (i + 1, pair)).collect();
        Self { pairs, bad: Vec::new() }
    }
}

/// The default limit on the error of a row: far above rounding in files, far below noise. It bounds the distance of an
/// attitude's entries from the group and the relative difference of J_L across a pair. With an infinite limit noisy data are
/// projected onto the group, and p is taken from μ″.
pub const TOLERANCE: f64 = 1e-6;

/// The policy for bad rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RowPolicy {
    /// Refuse the data, naming the rows.
    #[default]
    Refuse,
    /// Leave the rows out and report them.
    Drop,
}

/// Reduced data and the rows left out of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduction {
    /// The points (x, p).
    pub data: ReducedData,
    /// The row number of each sample.
    pub rows: Vec<usize>,
    /// Rows left out, in order.
    pub dropped: Vec<BadRow>,
}

/// Reduces pairs (g′, μ′), (g″, μ″) to (x, p):
/// τ(x) = g′⁻¹g″ and p = (d^Lτ_x)ᵀ μ″, the canonical momentum (which equals (d^Rτ_x)ᵀ μ′ where
/// the spatial momentum is conserved).
///
/// # Errors
/// [`LearnError::Centre`], [`LearnError::BadRows`] under [`RowPolicy::Refuse`], [`LearnError::NoSamples`] if none is left.
pub fn reduce<G, C>(
    group: &G,
    given: &PairRows<G>,
    tolerance: f64,
    policy: RowPolicy,
) -> Result<Reduction, LearnError>
where
    G: DataGroup,
    C: Chart<G>,
{
    let chart = C::default();
    if chart.coordinate(group, &group.identity()).is_none() {
        return Err(LearnError::Centre);
    }
    let total = given.pairs.len() + given.bad.len();
    let mut bad = given.bad.clone();
    let mut columns: [Vec<f64>; 4] = Default::default();
    let mut rows = Vec::new();
    for (row, pair) in &given.pairs {
        cancel::check();
        match reduce_pair::<G, C>(group, pair, tolerance) {
            Ok((x, p)) => {
                let found = [&x, &p, &pair.before.momentum, &pair.after.momentum];
                for (column, vector) in columns.iter_mut().zip(found) {
                    column.extend(entries(vector));
                }
                rows.push(*row);
            }
            Err(problem) => bad.push(BadRow { row: *row, problem }),
        }
    }
    let dim = group.dim();
    let [x, p, before, after] =
        columns.map(|column| DMatrix::from_vec(dim, column.len() / dim, column));
    let mut data = ReducedData { x, p, momenta: MomentumPairs { before, after } };
    let folded = beyond_fold::<G, C>(group, &data);
    if !folded.is_empty() {
        for &(i, determinant) in &folded {
            bad.push(BadRow { row: rows[i], problem: RowProblem::Folded(determinant) });
        }
        let kept: Vec<usize> =
            (0..rows.len()).filter(|i| folded.iter().all(|(f, _)| f != i)).collect();
        data = data.select(&kept);
        rows = kept.into_iter().map(|i| rows[i]).collect();
    }
    bad.sort_by_key(|b| b.row);
    if !bad.is_empty() && policy == RowPolicy::Refuse {
        return Err(LearnError::BadRows(BadRows { rows: bad, total, chart: C::NAME }));
    }
    if rows.is_empty() {
        return Err(LearnError::NoSamples);
    }
    Ok(Reduction { data, rows, dropped: bad })
}

fn reduce_pair<G, C>(
    group: &G,
    pair: &PhasePair<G>,
    tolerance: f64,
) -> Result<(G::Vector, G::Vector), RowProblem>
where
    G: DataGroup,
    C: Chart<G>,
{
    let chart = C::default();
    let (before, after) = (&pair.before, &pair.after);
    let finite = |v: &G::Vector| entries(v).iter().all(|e| e.is_finite());
    if !finite(&before.momentum) || !finite(&after.momentum) {
        return Err(RowProblem::NonFinite);
    }
    let increment = group.compose(&group.inverse(&before.group_element), &after.group_element);
    // J_L(α′) = J_L(α″), moved to the frame of g′ (the same statement, by equivariance).
    let carried = group.coadjoint(&increment, &after.momentum);
    let scale = before.momentum.largest_entry().max(f64::MIN_POSITIVE);
    let relative =
        (0..group.dim()).map(|i| (carried[i] - before.momentum[i]).abs()).fold(0.0, f64::max)
            / scale;
    if relative.is_nan() {
        return Err(RowProblem::NonFinite);
    }
    if relative > tolerance {
        return Err(RowProblem::MomentumMismatch(relative));
    }
    let x = chart.coordinate(group, &increment).filter(&finite).ok_or(RowProblem::OutOfChart)?;
    if let Some(measure) = group.fold_measure(C::NAME, &x)
        && measure >= 1.0
    {
        return Err(RowProblem::BeyondFold(measure));
    }
    // d^Lτ_x = d^Rτ_{−x}.
    let minus = G::Vector::from_entries(x.dim(), |i| -x[i]);
    let p = chart.pull_back(group, &minus, &after.momentum);
    Ok((x, p))
}

/// The highest degree x is fitted with, and how many samples each coefficient must have.
const DEGREE: usize = 5;
const SAMPLES: usize = 4;

/// Samples beyond the fold of the chart's canonical momentum, with det ∂p/∂μ′ there; none where the samples are too few to
/// tell.
///
/// The data lie on {x = ∂S/∂p(p)} only as long as μ′ ↦ p = (d^Rτ_x)ᵀ μ′ is one to one: past the first zero of det ∂p/∂μ′
/// two increments share one p. Where that happens depends on the flow, so it is looked for in the data: x is a smooth
/// function of μ′ whatever p does, and its derivative follows from a polynomial fitted to the samples.
///
/// Measured on free rigid bodies (smallest angle of the increment over all directions of μ′; see `tests/all/fold.rs`).
/// Cayley: 1.31 rad for the ball, where θ tan(θ/2) = 1, 1.27 for the paper's body (1.5, 2, 2.5), 1.12 for a plate
/// (1, 2, 3), 0.96 for a rod (0.2, 1, 1). Exponential: none short of the half turn for the ball and the paper's body, 1.99
/// for the plate, 1.7 for the rod.
fn beyond_fold<G, C>(group: &G, data: &ReducedData) -> Vec<(usize, f64)>
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let (dim, samples) = data.x.shape();
    let fits = |degree: &usize| SAMPLES * (Basis::size(dim, *degree) + 1) <= samples;
    let Some(degree) = (1..=DEGREE).rev().find(fits) else { return Vec::new() };
    let before = &data.momenta.before;
    let Some(models) = increments(before, &data.x, degree) else { return Vec::new() };
    let chart = C::default();
    let mut slope = vec![0.0; dim];
    let mut found = Vec::new();
    for i in 0..samples {
        let (mu, x) = (before.column(i), data.x.column(i));
        let (mu_vector, x) = (vector::<G>(mu.as_slice()), vector::<G>(x.as_slice()));
        // ∂p/∂μ′ = (d^Rτ_x)ᵀ + ∂/∂x[(d^Rτ_x)ᵀ μ′] ∂x/∂μ′.
        let (_, by_x) = chart.pull_back_with_derivative(group, &x, &mu_vector);
        let mut motion = DMatrix::zeros(dim, dim);
        for (j, model) in models.iter().enumerate() {
            model.gradient(mu.as_slice(), &mut slope);
            motion.row_mut(j).copy_from_slice(&slope);
        }
        let mut matrix = DMatrix::from_fn(dim, dim, |a, b| by_x[(a, b)]) * motion;
        for j in 0..dim {
            let unit: Vec<f64> = (0..dim).map(|k| if k == j { 1.0 } else { 0.0 }).collect();
            let column = chart.pull_back(group, &x, &vector::<G>(&unit));
            (0..dim).for_each(|k| matrix[(k, j)] += column[k]);
        }
        let determinant = matrix.determinant();
        if determinant <= 0.0 {
            found.push((i, determinant));
        }
    }
    found
}

/// x as a polynomial in μ′, a model per coordinate (without its constant).
fn increments(
    before: &DMatrix<f64>,
    x: &DMatrix<f64>,
    degree: usize,
) -> Option<Vec<PolynomialModel>> {
    let (dim, samples) = before.shape();
    let model = PolynomialModel::zero(Basis::new(dim, degree), Scaling::of(before));
    let terms = model.basis().terms().len();
    let mut matrix = DMatrix::from_element(samples, terms + 1, 1.0);
    let mut row = vec![0.0; terms];
    for (i, mu) in before.column_iter().enumerate() {
        model.basis_values(mu.as_slice(), &mut row);
        (0..terms).for_each(|k| matrix[(i, k)] = row[k]);
    }
    (0..dim)
        .map(|j| {
            let right = DVector::from_iterator(samples, x.row(j).iter().copied());
            let coefficients = Reduced::new(matrix.clone(), right).solve(1e-14)?;
            Some(model.clone().with_coefficients(&coefficients.as_slice()[..terms]))
        })
        .collect()
}
