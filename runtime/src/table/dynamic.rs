//! Tables known only at run time.

use alloc::vec;
use alloc::vec::Vec;

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::algebra::{BasisEntry, StructureConstant, Tables, monomial};
use super::domain;
use super::group::TableGroup;
use crate::number::scalar::Scalar;

/// A matrix group known at run time, coordinates in `DVector<f64>`.
///
/// ```
/// use coadjoint::{LieGroup, groups::MatrixGroup};
/// use nalgebra::{DMatrix, DVector};
///
/// // SL(2, R) from its basis; the brackets [h, x] = 2x, [h, y] = −2y, [x, y] = h are found, and
/// // checked to close.
/// let basis = [[1.0, 0.0, 0.0, -1.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]
///     .map(|rows| DMatrix::from_row_slice(2, 2, &rows));
/// let group = MatrixGroup::from_basis(&basis)?
///     .with_casimirs(vec![vec![(0.25, vec![(0, 2)]), (1.0, vec![(1, 1), (2, 1)])]])?;
/// let mu = DVector::from_vec(vec![1.0, 2.0, 3.0]);
/// let (g, moved) = group.exp_transport(&DVector::from_vec(vec![0.3, -0.1, 0.2]), &mu);
/// assert!((group.coadjoint(&g, &moved) - &mu).amax() < 1e-14);
/// assert!((group.casimir(0, &moved) - 6.25).abs() < 1e-13);
///
/// // An algebra known by brackets alone: [a, b] = b; elements are the matrices Ad_g.
/// let affine = MatrixGroup::from_structure_constants(2, &[(0, 1, 1, 1.0), (1, 0, 1, -1.0)])?;
/// assert_eq!(affine.matrix_size(), 2);
///
/// // The Cayley map is a property of the algebra, checked: sl(2) has it, sl(3) not.
/// assert!(group.into_cayley().is_ok());
/// # Ok::<(), coadjoint::groups::TableError>(())
/// ```
pub type MatrixGroup = TableGroup<DynamicTables<false>>;

/// A [`MatrixGroup`] whose algebra was checked to admit the Cayley map.
pub type CayleyMatrixGroup = TableGroup<DynamicTables<true>>;

/// The terms of a polynomial on 𝔤\*: (coefficient, [(coordinate, power), …]).
pub type Terms = Vec<(f64, Vec<(usize, u32)>)>;

/// The tables of a [`MatrixGroup`]; `CAYLEY` says that xξx ∈ 𝔤 was checked.
#[derive(Clone, Debug)]
pub struct DynamicTables<const CAYLEY: bool> {
    dim: usize,
    matrix_size: usize,
    structure: Vec<StructureConstant>,
    basis: Option<Vec<BasisEntry>>,
    gram_inverse: DMatrix<f64>,
    diagonal: bool,
    faithful: bool,
    orthogonal: bool,
    traceless: bool,
    /// Quadratic forms that bound eigenvalues: see `domain`.
    elliptic: Vec<f64>,
    cayley: Vec<f64>,
    casimirs: Vec<Terms>,
}

/// Why tables do not describe a Lie algebra.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// There is no basis element.
    #[error("a Lie algebra needs at least one basis element")]
    Empty,
    /// An index is not below the dimension.
    #[error("index {index} is out of range: the dimension is {dim}, counted from 0")]
    IndexOutOfRange {
        /// The index given.
        index: usize,
        /// The dimension.
        dim: usize,
    },
    /// A number is infinite or not a number.
    #[error("an entry of basis element or bracket {index} is not finite")]
    NonFinite {
        /// The basis element, counted from 0.
        index: usize,
    },
    /// Basis matrices are not square, or differ in size.
    #[error(
        "basis matrix {index} is {rows}×{columns}; all must be square and as large as the first"
    )]
    Shape {
        /// The basis element, counted from 0.
        index: usize,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// The basis matrices are linearly dependent.
    #[error("basis matrix {index} is a combination of the ones before it: leave it out")]
    Dependent {
        /// The basis element, counted from 0.
        index: usize,
    },
    /// A bracket of basis matrices is not in their span.
    #[error(
        "the bracket [e{i}, e{j}] leaves the span of the basis by {defect:.1e} (counted from 0)"
    )]
    NotClosed {
        /// First basis element.
        i: usize,
        /// Second basis element.
        j: usize,
        /// The distance from the span.
        defect: f64,
    },
    /// The structure constants are not antisymmetric.
    #[error("[e{i}, e{j}] and [e{j}, e{i}] are not opposite (counted from 0): list both")]
    NotAntisymmetric {
        /// First basis element.
        i: usize,
        /// Second basis element.
        j: usize,
    },
    /// The structure constants violate the Jacobi identity.
    #[error("the Jacobi identity fails for e{i}, e{j}, e{k} (counted from 0) by {defect:.1e}")]
    Jacobi {
        /// First basis element.
        i: usize,
        /// Second basis element.
        j: usize,
        /// Third basis element.
        k: usize,
        /// The largest coordinate of the cyclic sum.
        defect: f64,
    },
    /// The Cayley map leaves the group.
    #[error(
        "the Cayley chart does not exist on this group: eᵢeⱼeₖ + eₖeⱼeᵢ leaves the algebra for \
         i, j, k = {i}, {j}, {k} (counted from 0); use the exponential chart"
    )]
    NoCayley {
        /// Outer factor.
        i: usize,
        /// Inner factor.
        j: usize,
        /// Other outer factor.
        k: usize,
    },
    /// The adjoint representation does not tell the elements of the centre apart.
    #[error(
        "the algebra has a centre, which brackets alone do not represent by matrices: give a \
         matrix basis"
    )]
    NotFaithful,
    /// A Casimir changes along coadjoint orbits.
    #[error("the polynomial given as Casimir {index} (counted from 0) is not invariant")]
    NotInvariant {
        /// Which one.
        index: usize,
    },
}

/// Relative rounding allowed in the checks below; entries come from exact rationals, rounded once.
const TOLERANCE: f64 = 1e-12;

impl TableGroup<DynamicTables<false>> {
    /// The group of a matrix basis; its structure constants are found by projection.
    ///
    /// # Errors
    /// [`TableError`] when matrices are not square, of one size, finite, independent and closed
    /// under the bracket.
    pub fn from_basis(basis: &[DMatrix<f64>]) -> Result<Self, TableError> {
        let (gram_inverse, scale) = gram(basis)?;
        let dim = basis.len();
        let mut structure = Vec::new();
        for i in 0..dim {
            for j in 0..dim {
                if i == j {
                    continue;
                }
                let bracket = &basis[i] * &basis[j] - &basis[j] * &basis[i];
                let x = &gram_inverse * DVector::from_fn(dim, |k, _| basis[k].dot(&bracket));
                let mut outside = bracket;
                for k in 0..dim {
                    outside -= &basis[k] * x[k];
                    if x[k].abs() > TOLERANCE * scale {
                        structure.push((i, j, k, x[k]));
                    }
                }
                let defect = outside.amax();
                if defect > TOLERANCE * scale * scale {
                    return Err(TableError::NotClosed { i, j, defect });
                }
            }
        }
        Self::from_structure_and_basis(&structure, basis)
    }

    /// The group of a matrix basis whose structure constants are known (all non-zero (i, j, k, c)).
    ///
    /// # Errors
    /// [`TableError`] as for [`MatrixGroup::from_basis`] and
    /// [`MatrixGroup::from_structure_constants`]; that both belong together is checked.
    pub fn from_structure_and_basis(
        structure: &[StructureConstant],
        basis: &[DMatrix<f64>],
    ) -> Result<Self, TableError> {
        let (gram_inverse, scale) = gram(basis)?;
        let dim = basis.len();
        check_structure(dim, structure)?;
        for i in 0..dim {
            for j in i + 1..dim {
                let mut rest = &basis[i] * &basis[j] - &basis[j] * &basis[i];
                for &(_, _, k, c) in structure.iter().filter(|s| (s.0, s.1) == (i, j)) {
                    rest -= &basis[k] * c;
                }
                let defect = rest.amax();
                if defect > TOLERANCE * scale * scale {
                    return Err(TableError::NotClosed { i, j, defect });
                }
            }
        }
        let mut entries = Vec::new();
        for (i, e) in basis.iter().enumerate() {
            for row in 0..e.nrows() {
                for column in 0..e.ncols() {
                    if e[(row, column)] != 0.0 {
                        entries.push((i, row, column, e[(row, column)]));
                    }
                }
            }
        }
        let orthogonal = basis.iter().all(|e| *e == -e.transpose());
        let (elliptic, cayley) = forms(dim, structure, Some((&entries, orthogonal)));
        let tables = DynamicTables {
            dim,
            matrix_size: basis[0].nrows(),
            structure: structure.to_vec(),
            basis: Some(entries),
            elliptic,
            cayley,
            diagonal: is_diagonal(&gram_inverse),
            gram_inverse,
            faithful: true,
            orthogonal,
            traceless: basis.iter().all(|e| e.trace() == 0.0),
            casimirs: Vec::new(),
        };
        Ok(Self { tables })
    }

    /// The group of adjoint matrices of an algebra known by its structure constants: all non-zero
    /// (i, j, k, c), meaning that [eᵢ, eⱼ] contains c·eₖ.
    ///
    /// # Errors
    /// [`TableError`] when an index is out of range, a constant is not finite, or the bracket is
    /// not antisymmetric or violates the Jacobi identity.
    pub fn from_structure_constants(
        dim: usize,
        structure: &[StructureConstant],
    ) -> Result<Self, TableError> {
        check_structure(dim, structure)?;
        let mut adjoint = vec![DMatrix::zeros(dim, dim); dim];
        for &(i, j, k, c) in structure {
            adjoint[i][(k, j)] += c;
        }
        let (gram_inverse, faithful) = match gram(&adjoint) {
            Ok((inverse, _)) => (inverse, true),
            Err(_) => (DMatrix::zeros(dim, dim), false),
        };
        let (elliptic, cayley) = forms(dim, structure, None);
        let tables = DynamicTables {
            dim,
            matrix_size: dim,
            structure: structure.to_vec(),
            basis: None,
            elliptic,
            cayley,
            diagonal: is_diagonal(&gram_inverse),
            gram_inverse,
            faithful,
            orthogonal: adjoint.iter().all(|e| *e == -e.transpose()),
            traceless: adjoint.iter().all(|e| e.trace() == 0.0),
            casimirs: Vec::new(),
        };
        Ok(Self { tables })
    }

    /// The same group with the Cayley map.
    ///
    /// # Errors
    /// [`TableError::NoCayley`] where xξx leaves the algebra; [`TableError::NotFaithful`] for an
    /// algebra with a centre known by brackets alone.
    pub fn into_cayley(self) -> Result<CayleyMatrixGroup, TableError> {
        let dim = self.tables.dim;
        if !self.tables.faithful {
            return Err(TableError::NotFaithful);
        }
        let unit = |i: usize| DVector::from_fn(dim, |k, _| f64::from(u8::from(k == i)));
        let basis: Vec<DMatrix<f64>> = (0..dim).map(|i| self.matrix_of(&unit(i))).collect();
        for i in 0..dim {
            for k in i..dim {
                for j in 0..dim {
                    let triple =
                        &basis[i] * &basis[j] * &basis[k] + &basis[k] * &basis[j] * &basis[i];
                    let inside = self.matrix_of(&self.coordinates_of(&triple));
                    if (&triple - inside).amax() > TOLERANCE * (1.0 + triple.amax()) {
                        return Err(TableError::NoCayley { i, j, k });
                    }
                }
            }
        }
        let t = self.tables;
        let tables = DynamicTables {
            dim: t.dim,
            matrix_size: t.matrix_size,
            structure: t.structure,
            basis: t.basis,
            gram_inverse: t.gram_inverse,
            diagonal: t.diagonal,
            faithful: t.faithful,
            orthogonal: t.orthogonal,
            traceless: t.traceless,
            elliptic: t.elliptic,
            cayley: t.cayley,
            casimirs: t.casimirs,
        };
        Ok(TableGroup { tables })
    }
}

impl<const CAYLEY: bool> TableGroup<DynamicTables<CAYLEY>> {
    /// The same group with these Casimirs, each a list of terms (c, [(i, power), …]) meaning
    /// c·∏ μᵢ^power.
    ///
    /// # Errors
    /// [`TableError::IndexOutOfRange`], or [`TableError::NotInvariant`] where ad\*_{∂C/∂μ} μ is
    /// not zero at a few points.
    pub fn with_casimirs(mut self, casimirs: Vec<Terms>) -> Result<Self, TableError> {
        use crate::group::LieGroup;
        let dim = self.tables.dim;
        for (number, terms) in casimirs.iter().enumerate() {
            for &(index, _) in terms.iter().flat_map(|(_, factors)| factors) {
                if index >= dim {
                    return Err(TableError::IndexOutOfRange { index, dim });
                }
            }
            for point in 1..=3 {
                // Points without symmetry; any generic ones do.
                let mu =
                    DVector::from_fn(dim, |i, _| 0.3 + ((i * 7 + point * 3) % 11) as f64 / 11.0);
                let slope = DVector::from_fn(dim, |i, _| derivative(terms, i, &mu));
                let size = |v: &DVector<f64>| v.amax();
                let drift = self.ad_star(&slope, &mu);
                if size(&drift) > 1e-9 * (1.0 + size(&slope)) * size(&mu) * dim as f64 {
                    return Err(TableError::NotInvariant { index: number });
                }
            }
        }
        self.tables.casimirs = casimirs;
        Ok(self)
    }
}

/// ∂/∂μᵢ of a list of terms; a coordinate may occur in several factors of one term.
fn derivative(terms: &Terms, i: usize, mu: &DVector<f64>) -> f64 {
    let mut sum = 0.0;
    for (c, factors) in terms {
        for (at, &(index, power)) in factors.iter().enumerate() {
            if index == i && power > 0 {
                let mut lowered = factors.clone();
                lowered[at].1 -= 1;
                sum += f64::from(power) * monomial::<f64, _>(*c, &lowered, mu);
            }
        }
    }
    sum
}

/// The quadratic forms that bound eigenvalues, for exp and for Cayley's map; with the entries of the basis and
/// whether all its matrices are antisymmetric, or for adjoint matrices.
fn forms(
    dim: usize,
    structure: &[StructureConstant],
    basis: Option<(&[BasisEntry], bool)>,
) -> (Vec<f64>, Vec<f64>) {
    let (mut elliptic, mut cayley) = (vec![0.0; dim * dim], vec![0.0; dim * dim]);
    let mut ad = vec![0.0; dim * dim * dim];
    let ideal = domain::elliptic_form(dim, structure, &mut ad, &mut elliptic);
    match basis {
        Some((entries, antisymmetric)) => {
            domain::cayley_form(dim, entries, antisymmetric, ideal, &mut cayley);
        }
        None => cayley.clone_from(&elliptic),
    }
    (elliptic, cayley)
}

fn is_diagonal(m: &DMatrix<f64>) -> bool {
    (0..m.nrows()).all(|i| (0..m.ncols()).all(|j| i == j || m[(i, j)] == 0.0))
}

/// The inverse Gram matrix and the scale of the entries, with the checks a basis needs.
fn gram(basis: &[DMatrix<f64>]) -> Result<(DMatrix<f64>, f64), TableError> {
    let size = basis.first().ok_or(TableError::Empty)?.nrows();
    let mut scale = 1.0_f64;
    for (index, e) in basis.iter().enumerate() {
        if e.nrows() != size || e.ncols() != size || size == 0 {
            return Err(TableError::Shape { index, rows: e.nrows(), columns: e.ncols() });
        }
        if e.iter().any(|v| !v.is_finite()) {
            return Err(TableError::NonFinite { index });
        }
        scale = scale.max(e.amax());
    }
    let dim = basis.len();
    let gram = DMatrix::from_fn(dim, dim, |i, j| basis[i].dot(&basis[j]));
    // Gram–Schmidt tells which matrix depends on the ones before it.
    let mut orthogonal: Vec<DMatrix<f64>> = Vec::with_capacity(dim);
    for (index, e) in basis.iter().enumerate() {
        let mut rest = e.clone();
        for _ in 0..2 {
            for q in &orthogonal {
                let along = q.dot(&rest);
                rest -= q * along;
            }
        }
        let norm = rest.norm();
        if norm <= 1e-10 * e.norm() || norm == 0.0 {
            return Err(TableError::Dependent { index });
        }
        orthogonal.push(rest / norm);
    }
    let inverse = gram.try_inverse().ok_or(TableError::Dependent { index: dim - 1 })?;
    Ok((inverse, scale))
}

/// Indices, antisymmetry and the Jacobi identity.
fn check_structure(dim: usize, structure: &[StructureConstant]) -> Result<(), TableError> {
    if dim == 0 {
        return Err(TableError::Empty);
    }
    let mut scale = 1.0_f64;
    let mut ad = vec![DMatrix::<f64>::zeros(dim, dim); dim];
    for &(i, j, k, c) in structure {
        for index in [i, j, k] {
            if index >= dim {
                return Err(TableError::IndexOutOfRange { index, dim });
            }
        }
        if !c.is_finite() {
            return Err(TableError::NonFinite { index: i });
        }
        ad[i][(k, j)] += c;
        scale = scale.max(c.abs());
    }
    for i in 0..dim {
        for j in i..dim {
            let sum = ad[i].column(j) + ad[j].column(i);
            if sum.amax() > TOLERANCE * scale {
                return Err(TableError::NotAntisymmetric { i, j });
            }
        }
    }
    // ad is a representation: [ad_i, ad_j] = ad_[i, j].
    for i in 0..dim {
        for j in i + 1..dim {
            let mut rest = &ad[i] * &ad[j] - &ad[j] * &ad[i];
            for k in 0..dim {
                let c = ad[i][(k, j)];
                if c != 0.0 {
                    rest -= &ad[k] * c;
                }
            }
            for k in 0..dim {
                let defect = rest.column(k).amax();
                if defect > TOLERANCE * scale * scale * dim as f64 {
                    return Err(TableError::Jacobi { i, j, k, defect });
                }
            }
        }
    }
    Ok(())
}

impl<const CAYLEY: bool> DynamicTables<CAYLEY> {
    /// A bound on [`Tables::exp_extent`].
    pub(crate) fn exp_bound<T: Scalar>(&self, x: &DVector<T>) -> T {
        domain::exp_extent(&self.elliptic, self.dim, x)
    }

    /// A bound on [`Tables::cayley_extent`].
    pub(crate) fn cayley_bound<T: Scalar>(&self, x: &DVector<T>) -> T {
        domain::cayley_extent(&self.cayley, self.dim, x)
    }

    /// The terms of Casimir number `index`; none for an index out of range.
    pub(crate) fn casimir_terms(&self, index: usize) -> &[(f64, Vec<(usize, u32)>)] {
        self.casimirs.get(index).map(Vec::as_slice).unwrap_or_default()
    }
}

impl<const CAYLEY: bool> Tables for DynamicTables<CAYLEY> {
    type Scalar = f64;
    type Vector = DVector<f64>;
    type Column = DVector<f64>;

    fn dim(&self) -> usize {
        self.dim
    }

    fn matrix_size(&self) -> usize {
        self.matrix_size
    }

    fn structure(&self) -> &[StructureConstant] {
        &self.structure
    }

    fn basis(&self) -> Option<&[BasisEntry]> {
        self.basis.as_deref()
    }

    fn gram_inverse(&self, i: usize, j: usize) -> f64 {
        self.gram_inverse[(i, j)]
    }

    fn gram_is_diagonal(&self) -> bool {
        self.diagonal
    }

    fn is_faithful(&self) -> bool {
        self.faithful
    }

    fn is_orthogonal(&self) -> bool {
        self.orthogonal
    }

    fn is_traceless(&self) -> bool {
        self.traceless
    }

    fn exp_extent(&self, x: &DVector<f64>) -> f64 {
        let bound = self.exp_bound(x);
        if bound <= 1.0 || !bound.is_finite() {
            return bound;
        }
        // The bound may be larger than it need be: the eigenvalues themselves decide.
        let mut ad = DMatrix::zeros(self.dim, self.dim);
        for &(i, j, k, c) in &self.structure {
            ad[(k, j)] += x[i] * c;
        }
        let trace = ad.trace();
        let Some(schur) = Schur::try_new(ad, f64::EPSILON, 100 * self.dim) else { return bound };
        let eigenvalues: DVector<Complex<f64>> = schur.complex_eigenvalues();
        let largest = eigenvalues.iter().fold(0.0_f64, |worst, z| worst.worse(z.im.abs()));
        bound.min((largest * largest + trace * trace) / (PI * PI))
    }

    fn cayley_extent(&self, x: &DVector<f64>) -> f64 {
        self.cayley_bound(x)
    }

    fn casimir_count(&self) -> usize {
        self.casimirs.len()
    }

    fn casimir(&self, index: usize, mu: &DVector<f64>) -> f64 {
        self.casimir_terms(index)
            .iter()
            .map(|(c, factors)| monomial::<f64, _>(*c, factors, mu))
            .sum()
    }
}

impl super::cayley::CayleyTables for DynamicTables<true> {}
