//! Everything a Lie group must offer, from its tables.

use core::f64::consts::PI;

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use crate::group::element_error::{ElementError, finite, within};
use crate::group::{CayleyGroup, LieGroup, Rows};
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::Scalar;
use crate::table::algebra::{Algebra, BasisEntry};
use crate::table::domain;
use crate::table::tables::Tables;

/// A Lie group given by the tables of its Lie algebra: structure constants, and a matrix basis
/// where one is known.
///
/// Elements are d×d matrices in the representation of the basis; where only brackets are known,
/// the n×n matrices of Ad_g. All of [`LieGroup`] to rounding for any ‖x‖: (d^R exp)ᵀ and Ad\* of
/// exp act on the momentum by series with sub-steps, exp of the matrix by scaling and squaring.
/// Use it through [`StaticMatrixGroup`](crate::groups::StaticMatrixGroup) (tables in the program, no
/// allocation) or `MatrixGroup` (tables known at run time, feature `alloc`).
#[derive(Clone, Copy, Debug, Default)]
pub struct TableGroup<K> {
    pub(crate) tables: K,
}

pub use super::tables::MatrixOf as Element;

/// Terms of the exponential series for norms up to 1; rounding needs 18 in f64.
const TERMS: usize = 24;

impl<K: Tables> TableGroup<K> {
    /// The tables this group is made of.
    pub(super) fn algebra(&self) -> Algebra<'_> {
        self.tables.algebra()
    }

    /// Calls `visit` with every non-zero entry of the matrices in use.
    pub(super) fn for_each_entry(&self, mut visit: impl FnMut(BasisEntry)) {
        match self.algebra().basis {
            Some(entries) => entries.iter().for_each(|&entry| visit(entry)),
            // (ad_i)ₖⱼ = cᵢⱼᵏ
            None => self.algebra().structure.iter().for_each(|&(i, j, k, c)| visit((i, k, j, c))),
        }
    }

    /// True if elements are matrices Ad_g.
    pub(super) fn is_adjoint(&self) -> bool {
        self.algebra().basis.is_none()
    }

    pub(super) fn zero_matrix(&self) -> Element<K> {
        K::Column::zero_matrix(self.algebra().size)
    }

    pub(super) fn unit_matrix(&self) -> Element<K> {
        square::identity(self.algebra().size, &self.zero_matrix())
    }

    /// The matrix Σ xᵢ eᵢ.
    pub fn matrix_of(&self, x: &K::Vector) -> Element<K> {
        let mut result = self.zero_matrix();
        self.for_each_entry(|(i, row, column, value)| {
            result[(row, column)] = x[i].times_plus(K::Scalar::of(value), result[(row, column)]);
        });
        result
    }

    /// The vector of ⟨m, eᵢ⟩ = Σ entries of m times entries of eᵢ.
    pub(super) fn products(&self, m: &Element<K>) -> K::Vector {
        let mut result = K::Vector::zeros(self.algebra().dim);
        self.for_each_entry(|(i, row, column, value)| {
            result[i] = m[(row, column)].times_plus(K::Scalar::of(value), result[i]);
        });
        result
    }

    /// The inverse of the Gram matrix, applied to v.
    pub(super) fn gram_solve(&self, v: &K::Vector) -> K::Vector {
        let Algebra { dim, gram_inverse, facts, .. } = self.algebra();
        let entry = |i, j| K::Scalar::of(gram_inverse[i * dim + j]);
        if facts.diagonal {
            return K::Vector::from_entries(dim, |i| v[i] * entry(i, i));
        }
        self.applied(entry, v)
    }

    /// The product of a matrix of this dimension with a vector.
    fn applied(&self, entry: impl Fn(usize, usize) -> K::Scalar, v: &K::Vector) -> K::Vector {
        let dim = self.algebra().dim;
        K::Vector::from_entries(dim, |i| {
            let row = |sum, j: usize| v[j].times_plus(entry(i, j), sum);
            (0..dim).fold(K::Scalar::of(0.0), row)
        })
    }

    /// The coordinates of the matrix of 𝔤 nearest to m.
    pub(super) fn coordinates_of(&self, m: &Element<K>) -> K::Vector {
        self.gram_solve(&self.products(m))
    }

    /// The matrix P in the span of the basis with ⟨P, ξ⟩ = ⟨μ, ξ⟩ for every ξ ∈ 𝔤.
    pub(super) fn dual_matrix(&self, mu: &K::Vector) -> Element<K> {
        self.matrix_of(&self.gram_solve(mu))
    }

    /// exp of a matrix of the representation, by scaling and squaring.
    pub(super) fn matrix_exponential(&self, m: &Element<K>) -> Element<K> {
        let size = self.algebra().size;
        let Some(count) = square::halvings(square::row_sum_norm(size, m), 1.5) else {
            return K::Column::matrix_from_entries(size, |_, _| K::Scalar::of(f64::NAN));
        };
        let one = K::Scalar::of(1.0);
        let rounding = K::Scalar::epsilon() * K::Scalar::of(0.125);
        let m = square::scale(size, m, square::half_power(count));
        let mut sum = square::plus_scaled(size, &self.unit_matrix(), one, &m);
        let mut term = m.clone();
        for k in 2..TERMS {
            term = self.tables.multiply(&m, &term);
            term = square::scale(size, &term, K::Scalar::of(1.0 / k as f64));
            sum = square::plus_scaled(size, &sum, one, &term);
            if square::largest_entry(size, &term).simd_le(rounding).all() {
                break;
            }
        }
        for _ in 0..count {
            sum = self.tables.multiply(&sum, &sum);
        }
        sum
    }

    /// For groups of orthogonal matrices: pulls g back onto them to first order, so that rounding
    /// does not accumulate in gᵀg over many steps.
    pub(super) fn straighten(&self, g: Element<K>) -> Element<K> {
        if !self.algebra().facts.orthogonal {
            return g;
        }
        let size = self.algebra().size;
        let (half, three_halves) = (K::Scalar::of(-0.5), K::Scalar::of(1.5));
        let squared = square::transpose_multiply(size, &g, &g);
        let mut correction = squared.clone();
        square::fill(size, &mut correction, |i, j| {
            let value = squared[(i, j)] * half;
            if i == j { value + three_halves } else { value }
        });
        self.tables.multiply(&g, &correction)
    }
}

impl<K: Tables> LieGroup for TableGroup<K> {
    type Scalar = K::Scalar;
    type Vector = K::Vector;
    type Element = Element<K>;

    fn dim(&self) -> usize {
        self.algebra().dim
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        self.straighten(self.tables.multiply(g, h))
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        let size = self.algebra().size;
        if self.algebra().facts.orthogonal {
            square::transpose(size, g)
        } else {
            self.tables.invert(g)
        }
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        self.straighten(self.matrix_exponential(&self.matrix_of(x)))
    }

    /// The principal logarithm; `None` too where the representation does not tell x (a centre
    /// that only brackets are known of).
    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        self.logarithm(g)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        let mut result = K::Vector::zeros(self.algebra().dim);
        for &(i, j, k, c) in self.algebra().structure {
            result[k] = (x[i] * K::Scalar::of(c)).times_plus(y[j], result[k]);
        }
        result
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.ad_transpose(x, mu)
    }

    fn ad_stars<const M: usize>(&self, x: &Rows<Self, M>, mu: &Rows<Self, M>) -> Rows<Self, M> {
        let mut result = K::Vector::zero_rows::<M>(self.algebra().dim);
        for &(i, j, k, c) in self.algebra().structure {
            for node in 0..M {
                let factor = x[i][node] * K::Scalar::of(c);
                result[j][node] = factor.times_plus(mu[k][node], result[j][node]);
            }
        }
        result
    }

    fn brackets<const M: usize>(&self, x: &Rows<Self, M>, y: &Rows<Self, M>) -> Rows<Self, M> {
        let mut result = K::Vector::zero_rows::<M>(self.algebra().dim);
        for &(i, j, k, c) in self.algebra().structure {
            for node in 0..M {
                let factor = x[i][node] * K::Scalar::of(c);
                result[k][node] = factor.times_plus(y[j][node], result[k][node]);
            }
        }
        result
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        if self.is_adjoint() {
            return self.applied(|i, j| g[(i, j)], x);
        }
        let moved = self.tables.multiply(g, &self.matrix_of(x));
        self.coordinates_of(&self.tables.multiply(&moved, &self.inverse(g)))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        let size = self.algebra().size;
        let back = self.inverse(g);
        if self.is_adjoint() {
            return self.applied(|i, j| back[(j, i)], mu);
        }
        // ⟨Ad*_g μ, eⱼ⟩ = ⟨P, g⁻¹ eⱼ g⟩ = ⟨g⁻ᵀ P gᵀ, eⱼ⟩
        let turned = square::transpose_multiply(size, &back, &self.dual_matrix(mu));
        self.products(&square::multiply_transpose(size, &turned, g))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        // Ad*_{exp(−x)} μ = exp(ad_xᵀ) μ
        (self.exp(x), self.act(x, mu)[1].clone())
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        let [phi, _] = self.act(x, mu);
        phi
    }

    fn exp_extent(&self, x: &Self::Vector) -> K::Scalar {
        self.tables.exp_extent(x)
    }

    fn element_defect(&self, g: &Self::Element) -> K::Scalar {
        let size = self.algebra().size;
        let poison = square::row_sum_norm(size, g) * K::Scalar::of(0.0);
        if !self.algebra().facts.orthogonal {
            return poison;
        }
        let gram = square::transpose_multiply(size, g, g);
        let rest = square::plus_scaled(size, &gram, K::Scalar::of(-1.0), &self.unit_matrix());
        square::largest_entry(size, &rest) + poison
    }

    fn casimir_count(&self) -> usize {
        self.tables.casimir_count()
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> Self::Scalar {
        self.tables.casimir(index, mu)
    }

    fn matrix_size(&self) -> usize {
        self.algebra().size
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> Self::Scalar {
        g[(row, column)]
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> Self::Scalar,
    ) -> Result<Self::Element, ElementError> {
        self.member(entry)
    }
}

/// Tables of an algebra with xξx ∈ 𝔤 for x, ξ ∈ 𝔤.
pub trait CayleyTables: Tables {}

impl<K: CayleyTables> TableGroup<K> {
    /// 1 + s·x as a matrix.
    fn shifted(&self, x: &K::Vector, s: f64) -> Element<K> {
        let size = self.algebra().size;
        square::plus_scaled(size, &self.unit_matrix(), K::Scalar::of(s), &self.matrix_of(x))
    }
}

impl<K: CayleyTables> CayleyGroup for TableGroup<K> {
    fn cayley(&self, x: &Self::Vector) -> Self::Element {
        let size = self.algebra().size;
        let left = square::invert(size, &self.shifted(x, -0.5)).0;
        self.straighten(square::multiply(size, &left, &self.shifted(x, 0.5)))
    }

    fn cayley_extent(&self, x: &Self::Vector) -> Self::Scalar {
        let Algebra { dim, basis, cayley, .. } = self.algebra();
        match basis {
            Some(_) => domain::evaluate(cayley, dim, x) * K::Scalar::of(0.25),
            None => self.exp_extent(x) * K::Scalar::of(PI * PI / 4.0),
        }
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        // x/2 = (g − 1)(g + 1)⁻¹
        let size = self.algebra().size;
        let one = K::Scalar::of(1.0);
        let unit = self.unit_matrix();
        let below = square::invert(size, &square::plus_scaled(size, g, one, &unit)).0;
        let above = square::plus_scaled(size, g, -one, &unit);
        let half = square::multiply(size, &above, &below);
        let x = self.coordinates_of(&square::scale(size, &half, K::Scalar::of(2.0)));
        let scale = one / K::Scalar::epsilon().simd_sqrt();
        let reached = x.largest_entry().simd_le(scale).all()
            && (0..self.algebra().dim).all(|i| x[i].all_finite());
        reached.then_some(x)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        // ⟨P, (1 − x/2)⁻¹ ξ (1 + x/2)⁻¹⟩ = ⟨(1 − x/2)⁻ᵀ P (1 + x/2)⁻ᵀ, ξ⟩ with ⟨P, ·⟩ = μ on 𝔤
        let size = self.algebra().size;
        let left = square::invert(size, &self.shifted(x, -0.5)).0;
        let right = square::invert(size, &self.shifted(x, 0.5)).0;
        let half = square::transpose_multiply(size, &left, &self.dual_matrix(mu));
        self.products(&square::multiply_transpose(size, &half, &right))
    }
}

impl<K: Tables> TableGroup<K> {
    /// Reads an element: finite, invertible, orthogonal where the group is, of the right
    /// determinant, and acting on 𝔤 as an element does (conjugation keeps 𝔤; an adjoint matrix
    /// keeps the bracket). For groups that are not the whole normaliser of their algebra this is
    /// necessary, not sufficient.
    pub(super) fn member(
        &self,
        entry: impl Fn(usize, usize) -> K::Scalar,
    ) -> Result<Element<K>, ElementError> {
        let size = self.algebra().size;
        finite(size, &entry)?;
        let g = K::Column::matrix_from_entries(size, entry);
        let one = K::Scalar::of(1.0);
        let scale = square::largest_entry(size, &g);
        if self.algebra().facts.orthogonal {
            let defect = self.element_defect(&g);
            if !within(defect, one) {
                return Err(ElementError::NotOrthogonal { defect: defect.largest_lane() });
            }
        }
        let determinant = square::invert(size, &g).1;
        let traceless = self.algebra().facts.traceless && !self.is_adjoint();
        let fits = if traceless {
            within((determinant - one).simd_abs(), one + scale)
        } else {
            determinant.simd_gt(K::Scalar::of(0.0)).all()
        };
        if !fits {
            let required = if traceless {
                "the group needs determinant 1"
            } else {
                "the connected group needs a positive one"
            };
            let determinant = determinant.largest_lane();
            return Err(ElementError::Determinant { determinant, required });
        }
        let g = self.straighten(self.straighten(g));
        let defect = self.action_defect(&g);
        let inverse = square::largest_entry(size, &self.inverse(&g));
        if !within(defect, one + scale * inverse) {
            return Err(ElementError::NotInGroup { defect: defect.largest_lane() });
        }
        Ok(g)
    }

    /// The distance of g from acting on 𝔤 by automorphisms.
    fn action_defect(&self, g: &Element<K>) -> K::Scalar {
        let (dim, size) = (self.algebra().dim, self.algebra().size);
        let minus = K::Scalar::of(-1.0);
        let mut defect = K::Scalar::of(0.0);
        let unit = |i| K::Vector::unit(dim, i);
        if self.is_adjoint() {
            for i in 0..dim {
                for j in i + 1..dim {
                    let moved = self.adjoint(g, &self.bracket(&unit(i), &unit(j)));
                    let [first, second] = [i, j].map(|at| self.adjoint(g, &unit(at)));
                    let bracket = self.bracket(&first, &second);
                    let difference = K::Vector::from_entries(dim, |k| moved[k] - bracket[k]);
                    defect = defect.simd_max(difference.largest_entry());
                }
            }
            return defect;
        }
        let back = self.inverse(g);
        for i in 0..dim {
            let moved = self.tables.multiply(g, &self.matrix_of(&unit(i)));
            let moved = self.tables.multiply(&moved, &back);
            let inside = self.matrix_of(&self.coordinates_of(&moved));
            let outside = square::plus_scaled(size, &moved, minus, &inside);
            defect = defect.simd_max(square::row_sum_norm(size, &outside));
        }
        defect
    }
}

/// Square roots taken at most; more than enough for any finite element near which log exists.
const ROOTS: u32 = 64;
/// Iterations for one square root; quadratic, so that 20 reach rounding from far away.
const ROOT_ITERATIONS: u32 = 20;

impl<K: Tables> TableGroup<K> {
    pub(super) fn logarithm(&self, g: &Element<K>) -> Option<K::Vector> {
        if self.algebra().facts.dependent.is_some() {
            return None;
        }
        let dim = self.algebra().dim;
        let mut x = self.coordinates_of(&self.matrix_logarithm(g)?);
        // The roots lose a few digits; one or two Newton steps in the group bring them back:
        // g = exp(r)·exp(x) and x + (d^R exp_x)⁻¹ r is the better logarithm.
        let one = K::Scalar::of(1.0);
        for _ in 0..2 {
            let back = self.exp(&K::Vector::from_entries(dim, |i| -x[i]));
            let rest = square::multiply(self.algebra().size, g, &back);
            let rest = square::plus_scaled(self.algebra().size, &rest, -one, &self.unit_matrix());
            let r = self.coordinates_of(&rest);
            // Row j of d^R exp_x: the transpose applied to a basis vector.
            let mut turn = K::Vector::zero_matrix(dim);
            for j in 0..dim {
                let row = self.dexp_transpose(&x, &K::Vector::unit(dim, j));
                for i in 0..dim {
                    turn[(j, i)] = row[i];
                }
            }
            let better = K::Vector::solve(&turn, &r);
            x = K::Vector::from_entries(dim, |i| x[i] + better[i]);
        }
        // Only a logarithm that gives g back is one.
        let size = self.algebra().size;
        let again = self.exp(&x);
        let difference = square::plus_scaled(size, &again, -one, g);
        let scale = square::largest_entry(size, g) + one;
        let tolerance = K::Scalar::epsilon().simd_sqrt() * scale;
        square::largest_entry(size, &difference).simd_le(tolerance).all().then_some(x)
    }

    /// The principal logarithm of a matrix to about half the digits or better; `None` where the
    /// square roots do not converge (an eigenvalue on the negative axis).
    fn matrix_logarithm(&self, g: &Element<K>) -> Option<Element<K>> {
        let size = self.algebra().size;
        let one = K::Scalar::of(1.0);
        let unit = self.unit_matrix();
        let mut root = g.clone();
        let mut scale = one;
        let mut roots = 0;
        let rest = loop {
            let rest = square::plus_scaled(size, &root, -one, &unit);
            let norm = square::row_sum_norm(size, &rest);
            if norm.simd_le(K::Scalar::of(0.3)).all() {
                break rest;
            }
            if roots == ROOTS || !norm.all_finite() {
                return None;
            }
            root = self.square_root(&root);
            scale += scale;
            roots += 1;
        };
        // log A = 2 artanh((A − 1)(A + 1)⁻¹)
        let sum = square::plus_scaled(size, &root, one, &unit);
        let z = square::multiply(size, &rest, &square::invert(size, &sum).0);
        let square = square::multiply(size, &z, &z);
        let mut power = z.clone();
        let mut total = z;
        for k in 1..20 {
            power = square::multiply(size, &power, &square);
            let factor = K::Scalar::of(1.0 / (2 * k + 1) as f64);
            total = square::plus_scaled(size, &total, factor, &power);
        }
        Some(square::scale(size, &total, scale + scale))
    }

    fn square_root(&self, a: &Element<K>) -> Element<K> {
        let size = self.algebra().size;
        let (one, half) = (K::Scalar::of(1.0), K::Scalar::of(0.5));
        let unit = self.unit_matrix();
        let mut m = a.clone();
        let mut root = a.clone();
        for _ in 0..ROOT_ITERATIONS {
            let inverse = square::invert(size, &m).0;
            let factor = square::plus_scaled(size, &unit, one, &inverse);
            root = square::scale(size, &square::multiply(size, &root, &factor), half);
            // M ← ½ (1 + ½ (M + M⁻¹))
            let sum = square::plus_scaled(size, &m, one, &inverse);
            m = square::scale(size, &square::plus_scaled(size, &unit, half, &sum), half);
            let change = square::plus_scaled(size, &m, -one, &unit);
            let limit = K::Scalar::epsilon() * K::Scalar::of(8.0);
            if square::largest_entry(size, &change).simd_le(limit).all() {
                break;
            }
        }
        root
    }
}

/// Up to this norm of A one Taylor series is used.
const TAYLOR: f64 = 1.5;
/// Up to this norm of A, sub-steps are.
const SUBSTEPS: f64 = 48.0;
/// Terms of a Taylor series for norms up to [`TAYLOR`]; rounding needs about 20 in f64.
const TAYLOR_TERMS: usize = 30;

/// Square matrices of the algebra's dimension.
pub(crate) type Matrix<K> = <<K as Tables>::Vector as Coordinates<<K as Tables>::Scalar>>::Matrix;

impl<K: Tables> TableGroup<K> {
    /// A bound of ‖ad_xᵀ‖ in the maximum norm.
    fn ad_norm(&self, x: &K::Vector) -> K::Scalar {
        let mut rows = K::Vector::zeros(self.algebra().dim);
        let mut poison = K::Scalar::of(0.0);
        for &(i, j, _, c) in self.algebra().structure {
            rows[j] = x[i].simd_abs().times_plus(K::Scalar::of(c.abs()), rows[j]);
        }
        for i in 0..self.algebra().dim {
            // The maximum of lanes may drop a NaN; this does not.
            poison += x[i] * K::Scalar::of(0.0);
        }
        rows.largest_entry() + poison
    }

    fn scaled(&self, x: &K::Vector, factor: K::Scalar) -> K::Vector {
        K::Vector::from_entries(self.algebra().dim, |i| x[i] * factor)
    }

    /// ad_xᵀ μ
    pub(super) fn ad_transpose(&self, x: &K::Vector, mu: &K::Vector) -> K::Vector {
        let mut result = K::Vector::zeros(self.algebra().dim);
        for &(i, j, k, c) in self.algebra().structure {
            result[j] = (x[i] * K::Scalar::of(c)).times_plus(mu[k], result[j]);
        }
        result
    }

    /// φ(A)μ by its Taylor series, ‖A‖ ≤ `norm` ≤ [`TAYLOR`]. It ends where the terms of the norm are below rounding, and
    /// each coordinate's term is below rounding of that coordinate: one that decays to 10⁻²⁶ beside others of size one keeps
    /// all of its digits.
    fn phi_series(&self, x: &K::Vector, mu: &K::Vector, norm: f64) -> K::Vector {
        let dim = self.algebra().dim;
        let rounding = K::Scalar::epsilon() * K::Scalar::of(0.125);
        let mut term = mu.clone();
        let mut sum = mu.clone();
        let mut bound = 1.0;
        for k in 1..TAYLOR_TERMS {
            let factor = 1.0 / (k + 1) as f64;
            bound *= norm * factor;
            term = self.scaled(&self.ad_transpose(x, &term), K::Scalar::of(factor));
            sum = K::Vector::from_entries(dim, |i| sum[i] + term[i]);
            let small = |i| term[i].simd_abs().simd_le(sum[i].simd_abs() * rounding).all();
            // ‖A‖/(k + 2) < 1, so that later terms are smaller.
            if K::Scalar::of(bound).simd_le(rounding).all() && (0..dim).all(small) {
                break;
            }
        }
        sum
    }

    /// φ(A)μ and exp(A)μ, A = ad_xᵀ.
    pub(super) fn act(&self, x: &K::Vector, mu: &K::Vector) -> [K::Vector; 2] {
        let dim = self.algebra().dim;
        let norm = self.ad_norm(x);
        let largest = norm.largest_lane();
        if largest.is_nan() || largest > SUBSTEPS {
            let Some(count) = square::halvings(norm, 1.0) else {
                let nowhere = self.scaled(mu, K::Scalar::of(f64::NAN));
                return [nowhere.clone(), nowhere];
            };
            let (exp, phi) = self.action_matrices(x, count);
            return [phi, exp].map(|matrix| mu.left_multiply(&matrix));
        }
        let mut steps = 1;
        while TAYLOR * f64::from(steps) < largest {
            steps += 1;
        }
        let (norm, part) = (largest / f64::from(steps), K::Scalar::of(1.0 / f64::from(steps)));
        let x = self.scaled(x, part);
        let (mut phi, mut exp) = (K::Vector::zeros(dim), mu.clone());
        for _ in 0..steps {
            let average = self.phi_series(&x, &exp, norm);
            let change = self.ad_transpose(&x, &average);
            phi = K::Vector::from_entries(dim, |i| average[i].times_plus(part, phi[i]));
            exp = K::Vector::from_entries(dim, |i| exp[i] + change[i]);
        }
        [phi, exp]
    }

    /// exp(A) and φ(A) as matrices, by `count` doublings.
    fn action_matrices(&self, x: &K::Vector, count: u32) -> (Matrix<K>, Matrix<K>) {
        let dim = self.algebra().dim;
        let one = K::Scalar::of(1.0);
        let x = self.scaled(x, square::half_power(count));
        let mut a = K::Vector::zero_matrix(dim);
        for &(i, j, k, c) in self.algebra().structure {
            a[(j, k)] = x[i].times_plus(K::Scalar::of(c), a[(j, k)]);
        }
        let unit = square::identity(dim, &a);
        let mut phi = unit.clone();
        let mut term = unit.clone();
        for k in 1..TAYLOR_TERMS {
            term = square::multiply(dim, &a, &term);
            term = square::scale(dim, &term, K::Scalar::of(1.0 / (k + 1) as f64));
            phi = square::plus_scaled(dim, &phi, one, &term);
        }
        let mut exp = square::plus_scaled(dim, &unit, one, &square::multiply(dim, &a, &phi));
        for _ in 0..count {
            let sum = square::plus_scaled(dim, &exp, one, &unit);
            phi = square::scale(dim, &square::multiply(dim, &sum, &phi), K::Scalar::of(0.5));
            exp = square::multiply(dim, &exp, &exp);
        }
        (exp, phi)
    }
}
