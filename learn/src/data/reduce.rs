//! Reduction: from pairs in T\*G to points (x, p) of a Lagrangian submanifold of T\*G.

use coadjoint::groups::{Chart, Coordinates};
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::cancel;
use nalgebra::DMatrix;

use super::fold;
use super::samples::{MomentumPairs, ReducedData};
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::function::{entries, vector};
use crate::group::DataGroup;

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

/// How far data may be from exact before a row is called bad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// The largest distance of an attitude's entry from the group.
    pub attitude: f64,
    /// The largest relative difference of J_L across a pair.
    pub momentum: f64,
}

impl Default for Tolerances {
    /// 10⁻⁶ for both: far above rounding in files, far below noise.
    fn default() -> Self {
        Self { attitude: 1e-6, momentum: 1e-6 }
    }
}

impl Tolerances {
    /// No limit: for noisy data, which are then projected onto the group, with p taken from μ″.
    #[must_use]
    pub fn unlimited() -> Self {
        Self { attitude: f64::INFINITY, momentum: f64::INFINITY }
    }
}

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
/// [`LearnError::BadRows`] under [`RowPolicy::Refuse`], [`LearnError::NoSamples`] if none is left.
pub fn reduce<G, C>(
    group: &G,
    given: &PairRows<G>,
    tolerances: Tolerances,
    policy: RowPolicy,
) -> Result<Reduction, LearnError>
where
    G: DataGroup,
    C: Chart<G>,
{
    let total = given.pairs.len() + given.bad.len();
    let mut bad = given.bad.clone();
    let mut columns: [Vec<f64>; 4] = Default::default();
    let mut rows = Vec::new();
    for (row, pair) in &given.pairs {
        cancel::check();
        match reduce_pair::<G, C>(group, pair, tolerances.momentum) {
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
    let folded = fold::beyond::<G, C>(group, &data);
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
    let minus: Vec<f64> = entries(&x).iter().map(|v| -v).collect();
    let p = chart.pull_back(group, &vector::<G>(&minus), &after.momentum);
    Ok((x, p))
}
