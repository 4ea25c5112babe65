//! The group in numbers: ad\*, the charts' pull-back and transport, their derivatives, and matrices.

use std::sync::LazyLock;

use nalgebra::DMatrix;

use super::linear::{Real, norm, size, spectral};
use super::wide::Wide;
use super::{DoubleDouble, JudgeError};
use crate::lie::{Chart, LieAlgebra, cubic};
use crate::number::Rational;

/// Terms of an exponential series at most.
const TERMS: usize = 500;

/// The largest ratio of the largest term of a series to its sum; beyond it too few digits are left.
const CANCELLATION: f64 = 1e9;

/// 1/k in doubled precision; 1/0 is not used.
static RECIPROCALS: LazyLock<Vec<DoubleDouble>> = LazyLock::new(|| {
    (0..TERMS + 2).map(|k| DoubleDouble::from(1.0) / DoubleDouble::from(k as f64)).collect()
});

/// A table entry: three or four indices and a value.
#[derive(Clone, Debug)]
struct Nonzero<const N: usize> {
    at: [usize; N],
    value: DoubleDouble,
}

fn entry<const N: usize>(at: [usize; N], value: &Rational) -> Nonzero<N> {
    Nonzero { at, value: Wide::rational(value).scaled(0) }
}

/// Entries (row, column, value) of a sparse matrix; those of one place are added.
type Sparse<T> = Vec<(usize, usize, T)>;

fn times<T: Real>(matrix: &[(usize, usize, T)], columns: &DMatrix<T>) -> DMatrix<T> {
    let mut product = DMatrix::zeros(columns.nrows(), columns.ncols());
    for (from, mut to) in columns.column_iter().zip(product.column_iter_mut()) {
        for &(row, column, value) in matrix {
            to[row] += value * from[column];
        }
    }
    product
}

/// A Lie algebra, its matrices and a chart, as numbers. Vectors are matrices of one column.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    pub(super) dim: usize,
    /// The direct factor of each coordinate, ascending from 0.
    pub(super) factors: Vec<usize>,
    /// The factors of coordinates where their sizes are compared.
    pub(super) units: Vec<f64>,
    pub(super) chart: Chart,
    /// \[e_i, e_j\] contains c·e_k.
    structure: Vec<Nonzero<3>>,
    /// xξx contains x_a x_b ξ_c·v along e_d.
    cubic: Vec<Nonzero<4>>,
    /// e_i has v at (row, column).
    basis: Vec<Nonzero<3>>,
    /// Rows of a group element's matrix.
    pub(super) size: usize,
    /// a with ‖ad_x‖ ≤ a|x|, Euclidean.
    pub(super) bracket_norm: f64,
    /// b with ‖Σ xᵢ eᵢ‖ ≤ b|x|, Frobenius' norm and the Euclidean one.
    pub(super) basis_norm: f64,
}

impl Geometry {
    pub(super) fn new(algebra: &LieAlgebra, chart: Chart) -> Result<Self, JudgeError> {
        let dim = algebra.dim();
        let structure = algebra.structure().iter().map(|c| entry([c.i, c.j, c.k], &c.value));
        let structure: Vec<_> = structure.collect();
        let cubic = match chart {
            Chart::Exponential => Vec::new(),
            Chart::Cayley => cubic(algebra)?,
        };
        let cubic =
            cubic.iter().map(|c| entry([c.first, c.second, c.argument, c.result], &c.value));
        let cubic: Vec<_> = cubic.collect();
        let matrices = algebra.matrices();
        let entries = matrices.iter().enumerate();
        let basis: Vec<_> = entries
            .flat_map(|(i, e)| e.entries().map(move |(j, k, v)| entry([i, j, k], v)))
            .collect();
        let basis_norm = norm(&values(&basis));
        Ok(Self {
            dim,
            factors: algebra.factor_of_coordinates().iter().map(|&f| f as usize).collect(),
            units: vec![1.0; dim],
            chart,
            size: algebra.matrix_size(),
            bracket_norm: bracket_norm(dim, &structure),
            basis_norm: if basis_norm == 0.0 { 1.0 } else { basis_norm },
            structure,
            cubic,
            basis,
        })
    }

    /// ad_xᵀ.
    fn ad<T: Real>(&self, x: &DMatrix<T>) -> Sparse<T> {
        let of =
            |entry: &Nonzero<3>| (entry.at[1], entry.at[2], T::of(entry.value) * x[entry.at[0]]);
        self.structure.iter().map(of).collect()
    }

    /// The matrix of ad_xᵀ.
    pub(super) fn ad_transpose(&self, x: &DMatrix<f64>) -> DMatrix<f64> {
        times(&self.ad(x), &DMatrix::identity(self.dim, self.dim))
    }

    /// The matrix Σ xᵢ eᵢ.
    pub(super) fn matrix_of<T: Real>(&self, x: &DMatrix<T>) -> DMatrix<T> {
        let mut matrix = DMatrix::zeros(self.size, self.size);
        for Nonzero { at: [i, row, column], value } in &self.basis {
            matrix[(*row, *column)] += T::of(*value) * x[*i];
        }
        matrix
    }

    /// Σ shift!/(k + shift)! ad_xᵀᵏ times these columns: for shift 0 the exponential, for 1 its divided difference.
    fn exponential<T: Real>(
        &self,
        x: &DMatrix<T>,
        columns: &DMatrix<T>,
        shift: usize,
    ) -> Result<DMatrix<T>, JudgeError> {
        let ad = self.ad(x);
        let (mut sum, mut term) = (columns.clone(), columns.clone());
        let mut largest = size(columns);
        for k in 1..TERMS {
            term = times(&ad, &term) * T::of(RECIPROCALS[k + shift]);
            sum += &term;
            let small = size(&term);
            if !small.is_finite() {
                return Err(JudgeError::OutOfRange);
            }
            largest = largest.max(small);
            let total = size(&sum);
            if small <= 1e-34 * total || small == 0.0 {
                let cancelled = largest > CANCELLATION * total;
                return if cancelled { Err(JudgeError::OutOfRange) } else { Ok(sum) };
            }
        }
        Err(JudgeError::OutOfRange)
    }

    /// p̂ = (d^R τ_x)ᵀ μ for each column μ.
    pub(super) fn pull_back<T: Real>(
        &self,
        chart: Chart,
        x: &DMatrix<T>,
        mu: &DMatrix<T>,
    ) -> Result<DMatrix<T>, JudgeError> {
        match chart {
            Chart::Exponential => self.exponential(x, mu, 1),
            Chart::Cayley => T::solve(&self.cayley_matrix(x), mu).ok_or(JudgeError::OutOfRange),
        }
    }

    /// μ″ = Ad\*_{τ(x)⁻¹} μ for each column μ, p̂ being given too.
    pub(super) fn transport<T: Real>(
        &self,
        chart: Chart,
        x: &DMatrix<T>,
        mu: &DMatrix<T>,
        p: &DMatrix<T>,
    ) -> DMatrix<T> {
        match chart {
            Chart::Exponential => mu + times(&self.ad(x), p),
            // J_R(x, p) = J_L(−x, p)
            Chart::Cayley => self.cayley_matrix(&-x) * p,
        }
    }

    /// The matrix of p ↦ J_L(x, p), (J_L)_j = p_j − ½ xᵢ cᵢⱼˡ p_l − ¼ ⟨p, x e_j x⟩.
    fn cayley_matrix<T: Real>(&self, x: &DMatrix<T>) -> DMatrix<T> {
        let mut matrix = DMatrix::identity(self.dim, self.dim);
        for (row, column, value) in self.ad(x) {
            matrix[(row, column)] -= value * T::from(0.5);
        }
        for Nonzero { at: [a, b, argument, result], value } in &self.cubic {
            matrix[(*argument, *result)] -= T::of(*value) * x[*a] * x[*b] * T::from(0.25);
        }
        matrix
    }

    /// J_R(x, p) = Σ βₖ (ad\*_x)ᵏ p of the exponential chart.
    pub(super) fn momentum<T: Real>(
        &self,
        beta: &[T],
        x: &DMatrix<T>,
        p: &DMatrix<T>,
    ) -> DMatrix<T> {
        let (ad, mut power, mut sum) = (self.ad(x), p.clone(), p * beta[0]);
        for &beta in &beta[1..] {
            power = times(&ad, &power);
            sum += &power * beta;
        }
        sum
    }

    /// Hamilton's equations of H∘J_R at (x, p), ω being ∂H/∂μ at J_R(x, p): ẋ = (∂J_R/∂p)ᵀ ω, ṗ = −(∂J_R/∂x)ᵀ ω.
    pub(super) fn canonical<T: Real>(
        &self,
        beta: &[T],
        x: &DMatrix<T>,
        p: &DMatrix<T>,
        omega: &DMatrix<T>,
    ) -> [DMatrix<T>; 2] {
        let ad = self.ad(x);
        let bracket: Sparse<T> = ad.iter().map(|&(row, column, x)| (column, row, x)).collect();
        let powers = std::iter::successors(Some(p.clone()), |power| Some(times(&ad, power)));
        let powers: Vec<DMatrix<T>> = powers.take(beta.len() - 1).collect();
        let mut velocity = omega * beta[beta.len() - 1];
        let mut force = DMatrix::zeros(self.dim, 1);
        for (power, &beta) in powers.iter().zip(beta).rev() {
            force += times(&self.ad(&velocity), power);
            velocity = times(&bracket, &velocity) + omega * beta;
        }
        [velocity, force]
    }

    /// The sensitivity of τ and Ad\* to x, in double precision: ‖Ad\*_{τ(x)⁻¹}‖ and ‖d^R τ_x‖.
    pub(super) fn sensitivity(
        &self,
        chart: Chart,
        x: &DMatrix<f64>,
    ) -> Result<[f64; 2], JudgeError> {
        let unit = DMatrix::identity(self.dim, self.dim);
        let pulled = self.pull_back(chart, x, &unit)?;
        Ok([spectral(&self.transport(chart, x, &unit, &pulled)), spectral(&pulled)])
    }

    /// τ(x) as a matrix.
    pub(super) fn element(
        &self,
        chart: Chart,
        x: &DMatrix<DoubleDouble>,
    ) -> Result<DMatrix<DoubleDouble>, JudgeError> {
        let (matrix, one) = (self.matrix_of(x), DMatrix::identity(self.size, self.size));
        match chart {
            Chart::Exponential => exponential_matrix(matrix),
            Chart::Cayley => {
                let half = matrix * DoubleDouble::from(0.5);
                Real::solve(&(&one - &half), &(&one + &half)).ok_or(JudgeError::OutOfRange)
            }
        }
    }
}

/// The exponential of a matrix, by scaling and squaring.
fn exponential_matrix(matrix: DMatrix<DoubleDouble>) -> Result<DMatrix<DoubleDouble>, JudgeError> {
    let n = matrix.nrows();
    let mut length = size(&matrix) * n as f64;
    if !length.is_finite() {
        return Err(JudgeError::OutOfRange);
    }
    let mut halvings = 0;
    while length > 1.0 {
        length *= 0.5;
        halvings += 1;
    }
    let matrix = matrix.map(|entry| entry.scaled(-halvings));
    let mut sum = DMatrix::identity(n, n);
    let mut term = sum.clone();
    for k in 1..TERMS {
        term = &matrix * term * RECIPROCALS[k];
        sum += &term;
        if size(&term) <= 1e-34 {
            break;
        }
    }
    Ok((0..halvings).fold(sum, |root, _| &root * &root))
}

fn values<const N: usize>(entries: &[Nonzero<N>]) -> Vec<DoubleDouble> {
    entries.iter().map(|entry| entry.value).collect()
}

/// The smaller of two bounds on ‖ad_x‖/|x|: √Σc², and by rows and columns for each unit vector.
fn bracket_norm(dim: usize, structure: &[Nonzero<3>]) -> f64 {
    // ‖ad_x‖₂² ≤ ‖ad_x‖₁ ‖ad_x‖_∞, each at most √(Σᵢ (its sum for eᵢ)²) |x| by Cauchy's inequality.
    let sums = |row: usize| {
        let mut sums = DMatrix::<f64>::zeros(dim, dim);
        for entry in structure {
            sums[(entry.at[0], entry.at[row])] += entry.value.to_f64().abs();
        }
        sums.column_iter().map(|column| column.norm()).fold(0.0, f64::max)
    };
    norm(&values(structure)).min((sums(1) * sums(2)).sqrt())
}
