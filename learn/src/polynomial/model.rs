//! A polynomial of total degree d in the Chebyshev basis of normalised momenta.

use serde::{Deserialize, Serialize};

use crate::error::LearnError;
use crate::function::MomentumFunction;

/// An affine map of each coordinate of the data to about [−1, 1]: u = (p − centre) / half_width.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scaling {
    /// The middle of the data, per coordinate.
    pub centre: Vec<f64>,
    /// Half the range of the data, per coordinate; positive.
    pub half_width: Vec<f64>,
}

impl Scaling {
    /// The scaling that takes the samples (columns of `points`) to [−1, 1] in every coordinate.
    pub fn of(points: &nalgebra::DMatrix<f64>) -> Self {
        let bounds = |row: usize| {
            points.row(row).iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| {
                (low.min(v), high.max(v))
            })
        };
        let (mut centre, mut half_width) = (Vec::new(), Vec::new());
        for row in 0..points.nrows() {
            let (low, high) = bounds(row);
            let half = 0.5 * (high - low);
            centre.push(if low <= high { 0.5 * (low + high) } else { 0.0 });
            // A coordinate that never varies keeps its unit.
            half_width.push(if half > 0.0 && half.is_finite() { half } else { 1.0 });
        }
        Self { centre, half_width }
    }

    /// u, the normalised coordinate number `index` of `p`.
    pub(crate) fn normalise(&self, index: usize, p: f64) -> f64 {
        (p - self.centre[index]) / self.half_width[index]
    }
}

/// The most numbers of the matrix of a fit: a gigabyte.
const LARGEST_FIT: usize = 1 << 27;

/// Products of Chebyshev polynomials T_a(u₁) T_b(u₂) … of total degree 1 … d.
///
/// The constant is left out: a generating function matters only through its gradient. Ordered by
/// degree, then by exponents, descending.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    dim: usize,
    /// The total degree.
    pub(crate) degree: usize,
    /// Exponents of all terms, `dim` per term.
    exponents: Vec<u8>,
}

impl Basis {
    /// The basis in `dim` coordinates up to the total degree `degree` (at most 255).
    pub fn new(dim: usize, degree: usize) -> Self {
        let degree = degree.min(usize::from(u8::MAX));
        let mut exponents = Vec::new();
        let mut current = vec![0; dim];
        for total in 1..=degree {
            compositions(total, 0, &mut current, &mut exponents);
        }
        Self { dim, degree, exponents }
    }

    /// The number of basis functions of `dim` coordinates and total degree 1 … `degree`:
    /// C(dim + degree, degree) − 1.
    pub fn size(dim: usize, degree: usize) -> usize {
        Self::checked_size(dim, degree).unwrap_or(usize::MAX)
    }

    /// As [`Basis::size`]; `None` if there are more than an address can count.
    pub(crate) fn checked_size(dim: usize, degree: usize) -> Option<usize> {
        // Each intermediate count is a binomial, so the division leaves no remainder.
        let mut count = 1_u128;
        for k in 1..=degree {
            count = count.checked_mul(dim.checked_add(k)? as u128)? / k as u128;
            if count > usize::MAX as u128 {
                return None;
            }
        }
        usize::try_from(count - 1).ok()
    }

    /// Refuses a fit of all terms up to `degree` to `samples` gradients whose matrix would be too
    /// large, or whose degree is beyond 255, before anything is allocated.
    ///
    /// # Errors
    /// [`LearnError::InvalidOption`] with the number of terms and the limit.
    pub(crate) fn check_fit(dim: usize, degree: usize, samples: usize) -> Result<(), LearnError> {
        let refused = |terms: String| {
            let most = LARGEST_FIT / samples.saturating_mul(dim).max(1);
            let requirement = format!(
                "in {dim} coordinates that is {terms} coefficients; with {samples} samples the fit \
                 may have at most {most} (its matrix {LARGEST_FIT} numbers), and the degree is at most \
                 255: give a lower degree"
            );
            LearnError::option("degree", degree, requirement)
        };
        let Some(terms) = Self::checked_size(dim, degree) else {
            return Err(refused(format!("more than {}", usize::MAX)));
        };
        // The matrix has a row for each coordinate of each sample, and is square at least.
        let rows = samples.saturating_mul(dim).max(terms);
        if degree > usize::from(u8::MAX) || rows.saturating_mul(terms) > LARGEST_FIT {
            return Err(refused(terms.to_string()));
        }
        Ok(())
    }

    /// The Chebyshev indices of every basis function, in order.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = &[u8]> {
        self.exponents.chunks_exact(self.dim.max(1))
    }

    /// T_k, T_k′, T_k″ at `u`: three rows of degree + 1 values per coordinate.
    fn tables(&self, u: impl Iterator<Item = f64>) -> Chebyshev {
        let width = self.degree + 1;
        let mut tables = Chebyshev { width, entries: Vec::with_capacity(3 * width * self.dim) };
        for coordinate in u {
            tables.push(coordinate);
        }
        tables
    }
}

/// All exponents from coordinate `from` on that sum to `left`, the first one largest first.
fn compositions(left: usize, from: usize, current: &mut Vec<u8>, all: &mut Vec<u8>) {
    if from + 1 == current.len() {
        current[from] = u8::try_from(left).unwrap_or(u8::MAX);
        all.extend_from_slice(current);
        return;
    }
    for first in (0..=left).rev() {
        current[from] = u8::try_from(first).unwrap_or(u8::MAX);
        compositions(left - first, from + 1, current, all);
    }
}

/// Chebyshev polynomials and their first two derivatives at one point.
struct Chebyshev {
    width: usize,
    entries: Vec<f64>,
}

impl Chebyshev {
    fn push(&mut self, u: f64) {
        let start = self.entries.len();
        let width = self.width;
        self.entries.resize(start + 3 * width, 0.0);
        let (value, rest) = self.entries[start..].split_at_mut(width);
        let (slope, bend) = rest.split_at_mut(width);
        value[0] = 1.0;
        if width > 1 {
            value[1] = u;
            slope[1] = 1.0;
        }
        for k in 2..width {
            // T_k = 2u T_{k−1} − T_{k−2} and its derivatives.
            value[k] = 2.0 * u * value[k - 1] - value[k - 2];
            slope[k] = 2.0 * value[k - 1] + 2.0 * u * slope[k - 1] - slope[k - 2];
            bend[k] = 4.0 * slope[k - 1] + 2.0 * u * bend[k - 1] - bend[k - 2];
        }
    }

    /// The product of a term, differentiated in the two coordinates given, which may be equal; coordinates out of range
    /// stand for none.
    fn product(&self, term: &[u8], by: [usize; 2]) -> f64 {
        let order = |i: usize| by.iter().filter(|j| **j == i).count();
        term.iter().enumerate().map(|(i, &k)| self.at(i, order(i), k)).product()
    }

    /// The derivative of order 0, 1 or 2 of T_k in the coordinate `index`.
    #[inline]
    fn at(&self, index: usize, order: usize, k: u8) -> f64 {
        self.entries[(3 * index + order) * self.width + usize::from(k)]
    }
}

/// S(p) = Σ_k c_k φ_k(u(p)), the φ_k products of Chebyshev polynomials of total degree ≤ d.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored", into = "Stored")]
pub struct PolynomialModel {
    pub(crate) basis: Basis,
    pub(crate) scaling: Scaling,
    /// The coefficients c_k, in the order of [`Basis::terms`].
    pub(crate) coefficients: Vec<f64>,
}

/// The form on disk: the basis follows from dimension and degree.
#[derive(Serialize, Deserialize)]
struct Stored {
    degree: usize,
    scaling: Scaling,
    coefficients: Vec<f64>,
}

impl From<PolynomialModel> for Stored {
    fn from(model: PolynomialModel) -> Self {
        Self {
            degree: model.basis.degree,
            scaling: model.scaling,
            coefficients: model.coefficients,
        }
    }
}

impl TryFrom<Stored> for PolynomialModel {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
        let Scaling { centre, half_width } = &stored.scaling;
        let dim = centre.len();
        let expected = Basis::size(dim, stored.degree);
        if dim == 0 || half_width.len() != dim {
            return Err(format!(
                "the scaling has {dim} centres and {} half widths; both must be n > 0 numbers",
                half_width.len()
            ));
        }
        if stored.coefficients.len() != expected {
            return Err(format!(
                "degree {} in {dim} coordinates takes {expected} coefficients, {} are given",
                stored.degree,
                stored.coefficients.len()
            ));
        }
        if !half_width.iter().all(|w| w.is_finite() && *w > 0.0)
            || !centre.iter().chain(&stored.coefficients).all(|v| v.is_finite())
        {
            return Err("coefficients and scaling must be finite, half widths positive".into());
        }
        let basis = Basis::new(dim, stored.degree);
        Ok(Self { basis, scaling: stored.scaling, coefficients: stored.coefficients })
    }
}

impl PolynomialModel {
    /// The zero polynomial in `basis`.
    pub fn zero(basis: Basis, scaling: Scaling) -> Self {
        let coefficients = vec![0.0; basis.terms().len()];
        Self { basis, scaling, coefficients }
    }

    /// Replaces the coefficients and keeps basis and scaling; missing ones become 0.
    pub fn with_coefficients(mut self, coefficients: &[f64]) -> Self {
        self.coefficients.iter_mut().enumerate().for_each(|(k, c)| {
            *c = coefficients.get(k).copied().unwrap_or(0.0);
        });
        self
    }

    /// The basis.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// ∂φ_k/∂p_j at `p` for every basis function: `row[k·n + j]`, `row` of length len·n.
    pub fn basis_gradients(&self, p: &[f64], row: &mut [f64]) {
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row.chunks_exact_mut(self.basis.dim)) {
            for (j, entry) in out.iter_mut().enumerate() {
                *entry = tables.product(term, [j, usize::MAX]) / self.scaling.half_width[j];
            }
        }
    }

    /// φ_k(p) for every basis function.
    pub fn basis_values(&self, p: &[f64], row: &mut [f64]) {
        let tables = self.tables(p);
        for (term, out) in self.basis.terms().zip(row) {
            *out = tables.product(term, [usize::MAX; 2]);
        }
    }

    fn tables(&self, p: &[f64]) -> Chebyshev {
        self.basis.tables(p.iter().enumerate().map(|(i, &v)| self.scaling.normalise(i, v)))
    }
}

impl MomentumFunction for PolynomialModel {
    fn dim(&self) -> usize {
        self.basis.dim
    }

    fn value(&self, p: &[f64]) -> f64 {
        let tables = self.tables(p);
        let terms = self.basis.terms().zip(&self.coefficients);
        terms.map(|(term, c)| c * tables.product(term, [usize::MAX; 2])).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let tables = self.tables(p);
        gradient.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for j in (0..term.len()).filter(|&j| term[j] != 0) {
                gradient[j] += c * tables.product(term, [j, usize::MAX]);
            }
        }
        gradient.iter_mut().zip(&self.scaling.half_width).for_each(|(entry, w)| *entry /= w);
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let (tables, dim) = (self.tables(p), self.basis.dim);
        let width = &self.scaling.half_width;
        hessian.fill(0.0);
        for (term, c) in self.basis.terms().zip(&self.coefficients) {
            for a in (0..dim).filter(|&a| term[a] != 0) {
                for b in (0..=a).filter(|&b| term[b] != 0) {
                    hessian[a * dim + b] += c * tables.product(term, [a, b]);
                }
            }
        }
        for a in 0..dim {
            for b in 0..=a {
                let entry = hessian[a * dim + b] / (width[a] * width[b]);
                (hessian[a * dim + b], hessian[b * dim + a]) = (entry, entry);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_binomial() {
        for (dim, degree, expected) in [(3, 6, 83), (3, 8, 164), (6, 4, 209), (1, 5, 5)] {
            assert_eq!(Basis::size(dim, degree), expected);
            assert_eq!(Basis::new(dim, degree).terms().len(), expected);
        }
    }

    #[test]
    fn fits_too_large_are_refused_by_number_and_limit() {
        assert_eq!(Basis::checked_size(3, 50), Some(23_425));
        // C(1003, 3) − 1.
        assert_eq!(Basis::checked_size(3, 1000), Some(167_668_500));
        assert_eq!(Basis::checked_size(500, 500), None);
        assert_eq!(Basis::size(500, 500), usize::MAX);
        assert!(Basis::check_fit(3, 8, 1000).is_ok());
        for (degree, terms) in [(50, "23425"), (1000, "167668500"), (usize::MAX, "more than")] {
            let said = Basis::check_fit(3, degree, 1000).unwrap_err().to_string();
            assert!(said.contains(terms) && said.contains("at most 44739"), "{said}");
        }
        // Few terms, but of a degree that exponents cannot hold.
        assert!(Basis::check_fit(1, 256, 10).is_err());
    }

    #[test]
    fn tables_agree_with_cosines() {
        let basis = Basis::new(1, 7);
        let angle: f64 = 0.7;
        let tables = basis.tables([angle.cos()].into_iter());
        for k in 0..=7_u8 {
            let k_float = f64::from(k);
            // T_k(cos θ) = cos kθ, T_k′ = k sin kθ / sin θ.
            assert!((tables.at(0, 0, k) - (k_float * angle).cos()).abs() < 1e-14);
            let slope = k_float * (k_float * angle).sin() / angle.sin();
            assert!((tables.at(0, 1, k) - slope).abs() < 1e-13);
        }
    }
}
