//! The group in doubled precision: ad\*, the chart's pull-back and transport, its derivative, and matrices.

use std::sync::LazyLock;

use super::double_double::Real;
use super::linear::{Lu, identity, multiply, multiply_into};
use super::norm::norm;
use super::wide::Wide;
use super::{DoubleDouble, JudgeError};
use crate::lie::{Chart, LieAlgebra, cubic};
use crate::number::Rational;

/// Terms of an exponential series at most.
const TERMS: usize = 500;

/// How much larger than its sum the largest term of a series may be: beyond, too few digits are left.
const CANCELLATION: f64 = 1e9;

/// 1/k in doubled precision; 1/0 is not used.
static RECIPROCALS: LazyLock<Vec<DoubleDouble>> = LazyLock::new(|| {
    let one = DoubleDouble::from(1.0);
    (0..TERMS + 2).map(|k| one / DoubleDouble::from(k as f64)).collect()
});

/// A table entry: three or four indices and a value in doubled precision.
#[derive(Clone, Debug)]
struct Entry<const N: usize> {
    at: [usize; N],
    exact: DoubleDouble,
}

fn exact(value: &Rational) -> DoubleDouble {
    Wide::rational(value).scaled(0)
}

/// A Lie algebra, its matrices and a chart, as numbers.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    pub(super) dim: usize,
    /// The direct factor of each coordinate, ascending from 0.
    pub(super) factors: Vec<usize>,
    pub(super) chart: Chart,
    /// \[e_i, e_j\] contains c·e_k.
    structure: Vec<Entry<3>>,
    /// The rows and columns of ad_xᵀ that are not empty, and where each structure constant belongs.
    places: Vec<(usize, usize)>,
    place_of: Vec<usize>,
    /// xξx contains x_a x_b ξ_c·v along e_d.
    cubic: Vec<Entry<4>>,
    /// e_i has v at (row, column).
    basis: Vec<Entry<3>>,
    pub(super) size: usize,
    /// a with ‖ad_x‖ ≤ a|x|, Euclidean.
    pub(super) bracket_norm: f64,
    /// b with ‖Σ xᵢ eᵢ‖ ≤ b|x|, Frobenius' norm and the Euclidean one.
    pub(super) basis_norm: f64,
    pub(super) nilpotent: bool,
    /// c with ‖ξ ↦ xξx‖ ≤ c|x|².
    cubic_norm: f64,
}

impl Geometry {
    pub(super) fn new(algebra: &LieAlgebra, chart: Chart) -> Result<Self, JudgeError> {
        let dim = algebra.dim();
        let structure: Vec<_> = algebra
            .structure()
            .iter()
            .map(|s| Entry { at: [s.i, s.j, s.k], exact: exact(&s.value) })
            .collect();
        let cubic = match chart {
            Chart::Exponential => Vec::new(),
            Chart::Cayley => cubic(algebra)?
                .iter()
                .map(|e| Entry {
                    at: [e.first, e.second, e.argument, e.result],
                    exact: exact(&e.value),
                })
                .collect(),
        };
        let (basis, size): (Vec<Entry<3>>, usize) = match algebra.basis() {
            Some(basis) => {
                let entries = basis.iter().enumerate().flat_map(|(i, e)| {
                    e.entries().map(move |(row, column, v)| Entry {
                        at: [i, row, column],
                        exact: exact(v),
                    })
                });
                (entries.collect(), basis.first().map_or(0, |e| e.rows()))
            }
            // (ad_i)ₖⱼ = cᵢⱼᵏ
            None => {
                let entries = structure
                    .iter()
                    .map(|s| Entry { at: [s.at[0], s.at[2], s.at[1]], exact: s.exact });
                (entries.collect(), dim)
            }
        };
        let mut places: Vec<(usize, usize)> = Vec::new();
        let place_of = structure.iter().map(|s| {
            let place = (s.at[1], s.at[2]);
            places.iter().position(|known| *known == place).unwrap_or_else(|| {
                places.push(place);
                places.len() - 1
            })
        });
        let place_of = place_of.collect();
        let mut geometry = Self {
            dim,
            factors: algebra.factor_of_coordinates().iter().map(|&f| f as usize).collect(),
            chart,
            places,
            place_of,
            nilpotent: is_nilpotent(algebra),
            cubic_norm: norm(&cubic.iter().map(|e| e.exact.to_f64()).collect::<Vec<_>>()),
            bracket_norm: bracket_norm(dim, &structure),
            basis_norm: norm(&basis.iter().map(|e| e.exact.to_f64()).collect::<Vec<_>>()),
            structure,
            cubic,
            basis,
            size,
        };
        if geometry.basis_norm == 0.0 {
            geometry.basis_norm = 1.0;
        }
        Ok(geometry)
    }

    /// The entries of the matrix of ad_xᵀ, row by row, that can be other than zero.
    fn ad_entries<T: Real>(&self, x: &[T]) -> Vec<(usize, usize, T)> {
        let mut entries: Vec<_> =
            self.places.iter().map(|&(row, column)| (row, column, T::default())).collect();
        for (constant, &place) in self.structure.iter().zip(&self.place_of) {
            entries[place].2 += T::of(constant.exact) * x[constant.at[0]];
        }
        entries
    }

    /// Σ ad_xᵀᵏ v / (k + shift)!·shift!, for shift 0 the exponential and for 1 its divided difference.
    fn exponential<T: Real>(&self, x: &[T], v: &[T], shift: usize) -> Result<Vec<T>, JudgeError> {
        let matrix = self.ad_entries(x);
        let mut sum = v.to_vec();
        let mut term = v.to_vec();
        let mut next = vec![T::default(); v.len()];
        let mut largest = size(v);
        for k in 1..TERMS {
            next.fill(T::default());
            for &(row, column, value) in &matrix {
                next[row] += value * term[column];
            }
            let factor = T::of(RECIPROCALS[k + shift]);
            for ((term, &next), sum) in term.iter_mut().zip(&next).zip(&mut sum) {
                *term = next * factor;
                *sum += *term;
            }
            let small = size(&term);
            if !small.is_finite() {
                return Err(JudgeError::OutOfRange);
            }
            largest = largest.max(small);
            let total = size(&sum);
            if small <= 1e-34 * total || small == 0.0 {
                if largest > CANCELLATION * total {
                    return Err(JudgeError::OutOfRange);
                }
                return Ok(sum);
            }
        }
        Err(JudgeError::OutOfRange)
    }

    /// p̂ = (d^R τ_x)ᵀ μ.
    pub(super) fn pull_back<T: Real>(&self, x: &[T], mu: &[T]) -> Result<Vec<T>, JudgeError> {
        match self.chart {
            Chart::Exponential => self.exponential(x, mu, 1),
            Chart::Cayley => {
                Lu::new(self.dim, self.cayley_matrix(x)).ok_or(JudgeError::OutOfRange)?.solve(mu)
            }
        }
    }

    /// μ″ = Ad\*_{τ(x)⁻¹} μ, given p̂ too: on the exponential chart μ + ad_xᵀ p̂.
    pub(super) fn transport<T: Real>(
        &self,
        x: &[T],
        mu: &[T],
        p: &[T],
    ) -> Result<Vec<T>, JudgeError> {
        match self.chart {
            Chart::Exponential => {
                let mut moved = mu.to_vec();
                for (row, column, value) in self.ad_entries(x) {
                    moved[row] += value * p[column];
                }
                Ok(moved)
            }
            Chart::Cayley => {
                // J_R(x, p) = J_L(−x, p)
                let back: Vec<T> = x.iter().map(|&x| -x).collect();
                Ok(apply(self.dim, &self.cayley_matrix(&back), p))
            }
        }
    }

    /// Ad\*_{exp(y)⁻¹} μ.
    pub(super) fn exp_transport<T: Real>(&self, y: &[T], mu: &[T]) -> Result<Vec<T>, JudgeError> {
        self.exponential(y, mu, 0)
    }

    /// The matrix of p ↦ J_L(x, p), (J_L)_j = p_j − ½ xᵢ cᵢⱼˡ p_l − ¼ ⟨p, x e_j x⟩.
    fn cayley_matrix<T: Real>(&self, x: &[T]) -> Vec<T> {
        let n = self.dim;
        let mut matrix = identity::<T>(n);
        for entry in &self.structure {
            let [i, j, k] = entry.at;
            matrix[j * n + k] += T::of(entry.exact) * x[i] * T::from(-0.5);
        }
        for entry in &self.cubic {
            let [a, b, argument, result] = entry.at;
            matrix[argument * n + result] += T::of(entry.exact) * x[a] * x[b] * T::from(-0.25);
        }
        matrix
    }

    /// p̂ and its derivative ∂p̂_i/∂x_j, row by row.
    pub(super) fn pull_back_derivative(
        &self,
        x: &[f64],
        mu: &[f64],
    ) -> Result<(Vec<f64>, Vec<f64>), JudgeError> {
        match self.chart {
            Chart::Exponential => self.exponential_derivative(x, mu),
            Chart::Cayley => self.cayley_derivative(x, mu),
        }
    }

    /// Terms t_k = A t_{k−1}/(k+1), A = ad_xᵀ, and their derivatives (A_j t_{k−1} + A ∂_j t_{k−1})/(k+1).
    fn exponential_derivative(
        &self,
        x: &[f64],
        mu: &[f64],
    ) -> Result<(Vec<f64>, Vec<f64>), JudgeError> {
        let n = self.dim;
        let matrix = self.ad_entries(x);
        let (mut sum, mut term) = (mu.to_vec(), mu.to_vec());
        let (mut total, mut derivative) = (vec![0.0; n * n], vec![0.0; n * n]);
        let (mut next, mut next_derivative) = (vec![0.0; n], vec![0.0; n * n]);
        for k in 1..TERMS {
            let factor = 1.0 / (k + 1) as f64;
            next.fill(0.0);
            next_derivative.fill(0.0);
            for &(row, column, value) in &matrix {
                next[row] += value * term[column];
                for j in 0..n {
                    next_derivative[row * n + j] += value * derivative[column * n + j];
                }
            }
            for entry in &self.structure {
                let [i, j, l] = entry.at;
                next_derivative[j * n + i] += entry.exact.to_f64() * term[l];
            }
            for ((term, next), sum) in term.iter_mut().zip(&next).zip(&mut sum) {
                *term = next * factor;
                *sum += *term;
            }
            for ((term, next), sum) in derivative.iter_mut().zip(&next_derivative).zip(&mut total) {
                *term = next * factor;
                *sum += *term;
            }
            let (a, b) = (size(&term), size(&derivative));
            if !a.is_finite() || !b.is_finite() {
                return Err(JudgeError::OutOfRange);
            }
            if a <= 1e-17 * size(&sum) && b <= 1e-17 * size(&total) {
                return Ok((sum, total));
            }
        }
        Err(JudgeError::OutOfRange)
    }

    /// With J_L = M(x) p = μ: ∂p = −M⁻¹ ∂M p.
    fn cayley_derivative(&self, x: &[f64], mu: &[f64]) -> Result<(Vec<f64>, Vec<f64>), JudgeError> {
        let n = self.dim;
        let lu = Lu::new(n, self.cayley_matrix(x)).ok_or(JudgeError::OutOfRange)?;
        let p = lu.solve(mu)?;
        let mut right = vec![0.0; n * n];
        for entry in &self.structure {
            let [i, j, k] = entry.at;
            right[j * n + i] += 0.5 * entry.exact.to_f64() * p[k];
        }
        for entry in &self.cubic {
            let [a, b, argument, result] = entry.at;
            let value = 0.25 * entry.exact.to_f64() * p[result];
            right[argument * n + a] += value * x[b];
            right[argument * n + b] += value * x[a];
        }
        let mut derivative = vec![0.0; n * n];
        for j in 0..n {
            let column: Vec<f64> = (0..n).map(|i| right[i * n + j]).collect();
            for (i, value) in lu.solve(&column)?.into_iter().enumerate() {
                derivative[i * n + j] = value;
            }
        }
        Ok((p, derivative))
    }

    /// The matrix of ad_xᵀ, row by row.
    pub(super) fn ad_transpose(&self, x: &[f64]) -> Vec<f64> {
        let n = self.dim;
        let mut matrix = vec![0.0; n * n];
        for entry in &self.structure {
            let [i, j, k] = entry.at;
            matrix[j * n + k] += entry.exact.to_f64() * x[i];
        }
        matrix
    }

    /// Bounds on |p̂|/|μ| and ‖∂p̂/∂x‖/|μ| for |x| ≤ r; `None` where there are none.
    pub(super) fn pull_back_bounds(&self, r: f64) -> Option<(f64, f64)> {
        let (a, z) = (self.bracket_norm, self.bracket_norm * r);
        match self.chart {
            // φ(z) = (eᶻ − 1)/z and φ′(z) = (eᶻ − φ(z))/z, by their series to stay exact near 0.
            Chart::Exponential => {
                if !(z < 10.0) {
                    return None;
                }
                let (mut value, mut slope, mut term) = (1.0, 0.0, 1.0);
                for k in 1..80 {
                    // zᵏ⁻¹/(k+1)!
                    term /= f64::from(k + 1);
                    slope += f64::from(k) * term;
                    term *= z;
                    value += term;
                }
                Some((value, a * slope))
            }
            // M(x) = 1 + m with ‖m‖ ≤ ar/2 + cr²/4.
            Chart::Cayley => {
                let c = self.cubic_norm;
                let m = 0.5 * z + 0.25 * c * r * r;
                if !(m < 0.99) {
                    return None;
                }
                let inverse = 1.0 / (1.0 - m);
                Some((inverse, inverse * inverse * 0.5 * (a + c * r)))
            }
        }
    }

    /// As [`sensitivity`](Self::sensitivity), of the exponential whatever the chart.
    pub(super) fn exp_sensitivity(&self, y: &[f64]) -> Result<(f64, f64), JudgeError> {
        self.exponential_sensitivity(y)
    }

    /// How τ and Ad\* answer to a change of x, in double precision: ‖Ad\*_{τ(x)⁻¹}‖ and ‖d^R τ_x‖ (Frobenius).
    pub(super) fn sensitivity(&self, x: &[f64]) -> Result<(f64, f64), JudgeError> {
        let n = self.dim;
        match self.chart {
            Chart::Exponential => self.exponential_sensitivity(x),
            Chart::Cayley => {
                let lu = Lu::new(n, self.cayley_matrix(x)).ok_or(JudgeError::OutOfRange)?;
                let back: Vec<f64> = x.iter().map(|x| -x).collect();
                let mut inverse = vec![0.0; n * n];
                for j in 0..n {
                    let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
                    for (i, value) in lu.solve(&unit)?.into_iter().enumerate() {
                        inverse[i * n + j] = value;
                    }
                }
                let whole = multiply(n, &self.cayley_matrix(&back), &inverse);
                Ok((norm(&whole), norm(&inverse)))
            }
        }
    }

    fn exponential_sensitivity(&self, x: &[f64]) -> Result<(f64, f64), JudgeError> {
        let n = self.dim;
        let matrix = self.ad_transpose(x);
        let (mut whole, mut divided) = (identity::<f64>(n), identity::<f64>(n));
        let mut power = identity::<f64>(n);
        let mut next = power.clone();
        for k in 1..TERMS {
            multiply_into(n, &matrix, &power, &mut next);
            for at in 0..n * n {
                power[at] = next[at] / k as f64;
                whole[at] += power[at];
                divided[at] += power[at] / (k + 1) as f64;
            }
            let small = size(&power);
            if !small.is_finite() {
                return Err(JudgeError::OutOfRange);
            }
            if small <= 1e-17 * size(&whole) {
                break;
            }
        }
        Ok((norm(&whole), norm(&divided)))
    }

    /// The matrix Σ xᵢ eᵢ, row by row.
    pub(super) fn matrix_of<T: Real>(&self, x: &[T]) -> Vec<T> {
        let mut matrix = vec![T::default(); self.size * self.size];
        for entry in &self.basis {
            let [i, row, column] = entry.at;
            matrix[row * self.size + column] += T::of(entry.exact) * x[i];
        }
        matrix
    }

    /// τ(x) as a matrix.
    pub(super) fn element(&self, x: &[DoubleDouble]) -> Result<Vec<DoubleDouble>, JudgeError> {
        match self.chart {
            Chart::Exponential => self.exponential_matrix(x),
            Chart::Cayley => {
                let n = self.size;
                let half = |sign: f64| -> Vec<DoubleDouble> {
                    let factor = DoubleDouble::from(0.5 * sign);
                    let m = self.matrix_of(x).into_iter();
                    m.zip(identity::<DoubleDouble>(n)).map(|(m, one)| one + m * factor).collect()
                };
                let lu = Lu::new(n, half(-1.0)).ok_or(JudgeError::OutOfRange)?;
                let right = half(1.0);
                let mut result = vec![DoubleDouble::default(); n * n];
                for j in 0..n {
                    let column: Vec<_> = (0..n).map(|i| right[i * n + j]).collect();
                    for (i, value) in lu.solve(&column)?.into_iter().enumerate() {
                        result[i * n + j] = value;
                    }
                }
                Ok(result)
            }
        }
    }

    /// exp(Σ xᵢ eᵢ), by scaling and squaring.
    pub(super) fn exponential_matrix(
        &self,
        x: &[DoubleDouble],
    ) -> Result<Vec<DoubleDouble>, JudgeError> {
        let n = self.size;
        let matrix = self.matrix_of(x);
        let mut halvings = 0_i64;
        let mut length = size(&matrix) * n as f64;
        if !length.is_finite() {
            return Err(JudgeError::OutOfRange);
        }
        while length > 1.0 {
            length *= 0.5;
            halvings += 1;
        }
        let matrix: Vec<_> = matrix.into_iter().map(|m| m.scaled(-halvings)).collect();
        let mut sum = identity::<DoubleDouble>(n);
        let (mut term, mut next) = (sum.clone(), sum.clone());
        for k in 1..TERMS {
            multiply_into(n, &matrix, &term, &mut next);
            for ((term, &next), sum) in term.iter_mut().zip(&next).zip(&mut sum) {
                *term = next * RECIPROCALS[k];
                *sum += *term;
            }
            if size(&term) <= 1e-34 {
                break;
            }
        }
        for _ in 0..halvings {
            sum = multiply(n, &sum, &sum);
        }
        Ok(sum)
    }

    /// The matrix of x in the representation of the elements, in double precision.
    pub(super) fn representation(&self, x: &[f64]) -> (usize, Vec<f64>) {
        (self.size, self.matrix_of(x))
    }
}

/// The largest absolute entry, in double precision; NaN where an entry is.
pub(super) fn size<T: Real>(v: &[T]) -> f64 {
    v.iter().fold(0.0, |largest: f64, value| {
        let value = value.double().abs();
        if value.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(value) }
    })
}

/// The product of a square matrix, row by row, and a vector.
pub(super) fn apply<T: Real>(n: usize, matrix: &[T], v: &[T]) -> Vec<T> {
    (0..n)
        .map(|i| {
            let mut sum = T::default();
            for j in 0..n {
                sum += matrix[i * n + j] * v[j];
            }
            sum
        })
        .collect()
}

/// The smaller of two bounds on ‖ad_x‖/|x|: √Σc², and by rows and columns for each unit vector.
fn bracket_norm(dim: usize, structure: &[Entry<3>]) -> f64 {
    let whole = norm(&structure.iter().map(|s| s.exact.to_f64()).collect::<Vec<_>>());
    // ‖ad_x‖₂² ≤ ‖ad_x‖₁ ‖ad_x‖_∞, each at most √(Σᵢ (its sum for eᵢ)²) |x| by Cauchy's inequality.
    let sums = |row: fn(&[usize; 3]) -> usize| {
        let mut sums = vec![0.0; dim * dim];
        for entry in structure {
            sums[row(&entry.at) * dim + entry.at[0]] += entry.exact.to_f64().abs();
        }
        sums.chunks(dim.max(1)).map(norm).fold(0.0, f64::max)
    };
    let mixed = (sums(|at| at[1]) * sums(|at| at[2])).sqrt();
    whole.min(mixed)
}

/// Whether the lower central series ends at 0.
fn is_nilpotent(algebra: &LieAlgebra) -> bool {
    // By supports: the span of the generators that occur in brackets of those left. Exact where the basis is
    // adapted to the series, as in the catalogue; elsewhere it may say no, which only asks for more.
    let mut left: Vec<bool> = vec![true; algebra.dim()];
    loop {
        let mut next = vec![false; algebra.dim()];
        for s in algebra.structure().iter().filter(|s| left[s.j]) {
            next[s.k] = true;
        }
        if next.iter().all(|occurs| !occurs) {
            return true;
        }
        if next == left {
            return false;
        }
        left = next;
    }
}
