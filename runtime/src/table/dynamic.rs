//! Tables known only at run time.

use alloc::collections::BTreeMap;
use alloc::vec;
use alloc::vec::Vec;

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector, Schur};

use super::algebra::{Algebra, BasisEntry, Facts, StructureConstant, facts, invert};
use super::domain;
use super::group::TableGroup;
use super::tables::{Tables, monomial};
use crate::linear::coordinates::Coordinates;
use crate::linear::square;
use crate::number::Scalar;

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
pub struct DynamicTables<const CAYLEY: bool>(Data);

#[derive(Clone, Debug)]
struct Data {
    dim: usize,
    size: usize,
    structure: Vec<StructureConstant>,
    basis: Option<Vec<BasisEntry>>,
    facts: Facts,
    gram_inverse: Vec<f64>,
    elliptic: Vec<f64>,
    cayley: Vec<f64>,
    casimirs: Vec<Terms>,
}

impl Data {
    /// The tables, with what follows from them.
    fn new(
        (dim, size): (usize, usize),
        structure: &[StructureConstant],
        basis: Option<Vec<BasisEntry>>,
    ) -> Self {
        let square = || vec![0.0; dim * dim];
        let (mut gram, mut gram_inverse, mut elliptic) = (square(), square(), Vec::new());
        let mut facts =
            facts(structure, basis.as_deref(), (dim, size), &mut gram, &mut vec![0.0; size * size]);
        let mut ideal = 0;
        if dim <= domain::MAX_DIM {
            elliptic = square();
            let mut ad = vec![0.0; dim * dim * dim];
            let room = &mut square();
            ideal = domain::elliptic_form(dim, structure, &mut ad, room, &mut elliptic);
        }
        let mut cayley = Vec::new();
        if let Some(entries) = &basis {
            cayley = square();
            domain::cayley_form(dim, entries, &gram, facts.orthogonal, ideal, &mut cayley);
        }
        facts.dependent = invert(dim, &mut gram, &mut gram_inverse);
        let (structure, casimirs) = (structure.to_vec(), Vec::new());
        Self { dim, size, structure, basis, facts, gram_inverse, elliptic, cayley, casimirs }
    }
}

/// Reasons for which tables do not describe a Lie algebra.
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

/// From this size on matrices are multiplied without their zeros, which lists find.
const LARGE: usize = 16;

/// Relative rounding allowed in the checks below; entries come from exact rationals, rounded once.
const TOLERANCE: f64 = 1e-12;

impl TableGroup<DynamicTables<false>> {
    /// The group of a matrix basis; its structure constants are found by projection.
    ///
    /// # Errors
    /// [`TableError`] when matrices are not square, of one size, finite, independent and closed
    /// under the bracket.
    pub fn from_basis(basis: &[DMatrix<f64>]) -> Result<Self, TableError> {
        let scale = scale(basis)?;
        let span = Self::spanned(&[], basis)?;
        let mut structure = Vec::new();
        for i in 0..basis.len() {
            for j in (0..basis.len()).filter(|&j| j != i) {
                let bracket = &basis[i] * &basis[j] - &basis[j] * &basis[i];
                let x = span.coordinates_of(&bracket);
                let constants = x.iter().enumerate().filter(|(_, c)| c.abs() > TOLERANCE * scale);
                structure.extend(constants.map(|(k, &c)| (i, j, k, c)));
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
        let scale = scale(basis)?;
        let brackets = Brackets::new(basis.len(), structure)?;
        let group = Self::spanned(structure, basis)?;
        for i in 0..basis.len() {
            for j in i + 1..basis.len() {
                let mut rest = &basis[i] * &basis[j] - &basis[j] * &basis[i];
                for (k, c) in brackets.of(i, j) {
                    rest -= &basis[k] * c;
                }
                let defect = rest.amax();
                if defect > TOLERANCE * scale * scale {
                    return Err(TableError::NotClosed { i, j, defect });
                }
            }
        }
        Ok(group)
    }

    /// The group of independent matrices, whose brackets are not yet compared with them.
    fn spanned(
        structure: &[StructureConstant],
        basis: &[DMatrix<f64>],
    ) -> Result<Self, TableError> {
        let (dim, size) = (basis.len(), basis[0].nrows());
        let places = (0..size).flat_map(|row| (0..size).map(move |column| (row, column)));
        let entries = basis.iter().enumerate().flat_map(|(i, e)| {
            places.clone().map(move |(row, column)| (i, row, column, e[(row, column)]))
        });
        let entries = entries.filter(|entry| entry.3 != 0.0).collect();
        let data = Data::new((dim, size), structure, Some(entries));
        match data.facts.dependent {
            Some(index) => Err(TableError::Dependent { index }),
            None => Ok(Self { tables: DynamicTables(data) }),
        }
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
        Brackets::new(dim, structure)?;
        Ok(Self { tables: DynamicTables(Data::new((dim, dim), structure, None)) })
    }

    /// The group with the Cayley map.
    ///
    /// # Errors
    /// [`TableError::NoCayley`] where xξx leaves the algebra; [`TableError::NotFaithful`] for an
    /// algebra with a centre known by brackets alone.
    pub fn into_cayley(self) -> Result<CayleyMatrixGroup, TableError> {
        let Algebra { dim, facts, .. } = self.algebra();
        if facts.dependent.is_some() {
            return Err(TableError::NotFaithful);
        }
        let basis = |i| self.matrix_of(&<DVector<f64> as Coordinates<f64>>::unit(dim, i));
        let basis: Vec<DMatrix<f64>> = (0..dim).map(basis).collect();
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
        Ok(TableGroup { tables: DynamicTables(self.tables.0) })
    }
}

impl<const CAYLEY: bool> TableGroup<DynamicTables<CAYLEY>> {
    /// Adds these Casimirs, each a list of terms (c, [(i, power), …]) meaning
    /// c·∏ μᵢ^power.
    ///
    /// # Errors
    /// [`TableError::IndexOutOfRange`], or [`TableError::NotInvariant`] where a value changes along
    /// coadjoint orbits at a few points.
    pub fn with_casimirs(mut self, casimirs: Vec<Terms>) -> Result<Self, TableError> {
        let dim = self.algebra().dim;
        for (number, terms) in casimirs.iter().enumerate() {
            for &(index, _) in terms.iter().flat_map(|(_, factors)| factors) {
                if index >= dim {
                    return Err(TableError::IndexOutOfRange { index, dim });
                }
            }
            let values = |mu: &DVector<f64>, size: fn(f64) -> f64| -> f64 {
                terms.iter().map(|(c, factors)| size(monomial::<f64, _>(*c, factors, mu))).sum()
            };
            for point in 1..=3 {
                // Points without symmetry; any generic ones do.
                let generic = |shift: usize| {
                    DVector::from_fn(dim, |i, _| 0.3 + ((i * 7 + shift) % 11) as f64 / 11.0)
                };
                let (x, mu) = (generic(point * 5) / dim as f64, generic(point * 3));
                let [_, moved] = self.act(&x, &mu);
                let change = values(&moved, |term| term) - values(&mu, |term| term);
                if change.abs() > 1e-9 * values(&mu, f64::abs) {
                    return Err(TableError::NotInvariant { index: number });
                }
            }
        }
        self.tables.0.casimirs = casimirs;
        Ok(self)
    }
}

/// The scale of the entries of basis matrices, which must be finite, square, and of one size.
fn scale(basis: &[DMatrix<f64>]) -> Result<f64, TableError> {
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
    Ok(scale)
}

/// Structure constants that were checked: for each i the components of [eᵢ, eⱼ] along eₖ, by (j, k).
struct Brackets(Vec<BTreeMap<(usize, usize), f64>>);

impl Brackets {
    /// Checks indices, antisymmetry and the Jacobi identity.
    fn new(dim: usize, structure: &[StructureConstant]) -> Result<Self, TableError> {
        if dim == 0 {
            return Err(TableError::Empty);
        }
        let mut scale = 1.0_f64;
        let mut brackets = vec![BTreeMap::new(); dim];
        for &(i, j, k, c) in structure {
            for index in [i, j, k] {
                if index >= dim {
                    return Err(TableError::IndexOutOfRange { index, dim });
                }
            }
            if !c.is_finite() {
                return Err(TableError::NonFinite { index: i });
            }
            *brackets[i].entry((j, k)).or_insert(0.0) += c;
            scale = scale.max(c.abs());
        }
        let brackets = Self(brackets);
        let opposite = |i: usize, j: usize, k: usize| brackets.0[j].get(&(i, k)).copied();
        let constants = brackets.0.iter().enumerate();
        let constants = constants.flat_map(|(i, row)| row.iter().map(move |(at, &c)| (i, at, c)));
        let unlike = constants.filter(|&(i, &(j, k), c)| {
            (c + opposite(i, j, k).unwrap_or(0.0)).abs() > TOLERANCE * scale
        });
        if let Some((i, j)) = unlike.map(|(i, &(j, _), _)| (i.min(j), i.max(j))).min() {
            return Err(TableError::NotAntisymmetric { i, j });
        }
        for i in 0..dim {
            let defect = |(_, defect): &(_, f64)| *defect > TOLERANCE * scale * scale * dim as f64;
            if let Some(((j, k), defect)) = brackets.jacobiators(i).into_iter().find(defect) {
                return Err(TableError::Jacobi { i, j, k, defect });
            }
        }
        Ok(brackets)
    }

    /// The components of [eᵢ, eⱼ] that are not zero, as (k, value).
    fn of(&self, i: usize, j: usize) -> impl Iterator<Item = (usize, f64)> {
        self.0[i].range((j, 0)..(j + 1, 0)).map(|(&(_, k), &c)| (k, c))
    }

    /// The largest coordinate of [[eᵢ, eⱼ], eₖ] + [[eⱼ, eₖ], eᵢ] − [[eᵢ, eₖ], eⱼ] for i < j < k where brackets that
    /// are not zero meet, by (j, k).
    fn jacobiators(&self, i: usize) -> BTreeMap<(usize, usize), f64> {
        let mut sums: BTreeMap<(usize, usize, usize), f64> = BTreeMap::new();
        for (&(j, l), c) in self.0[i].range((i + 1, 0)..) {
            for (&(k, m), d) in self.0[l].range((i + 1, 0)..).filter(|((k, _), _)| *k != j) {
                let sign = if k > j { 1.0 } else { -1.0 };
                *sums.entry((j.min(k), j.max(k), m)).or_insert(0.0) += sign * c * d;
            }
        }
        for (j, row) in self.0.iter().enumerate().skip(i + 1) {
            for (&(k, l), c) in row.range((j + 1, 0)..) {
                for (m, d) in self.of(i, l) {
                    *sums.entry((j, k, m)).or_insert(0.0) -= c * d;
                }
            }
        }
        let mut largest = BTreeMap::new();
        for ((j, k, _), sum) in sums {
            let most = largest.entry((j, k)).or_insert(0.0_f64);
            *most = most.max(sum.abs());
        }
        largest
    }
}

impl<const CAYLEY: bool> Tables for DynamicTables<CAYLEY> {
    type Scalar = f64;
    type Vector = DVector<f64>;
    type Column = DVector<f64>;

    fn algebra(&self) -> Algebra<'_> {
        Algebra {
            dim: self.0.dim,
            size: self.0.size,
            structure: &self.0.structure,
            basis: self.0.basis.as_deref(),
            facts: self.0.facts,
            gram_inverse: &self.0.gram_inverse,
            elliptic: &self.0.elliptic,
            cayley: &self.0.cayley,
        }
    }

    fn multiply(&self, a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
        let n = a.nrows();
        if n < LARGE {
            return square::multiply(n, a, b);
        }
        // Column by column and without zeros, which most entries of adjoint matrices are; sums as in `linear`.
        let entries = |column: &[f64]| -> Vec<(usize, f64)> {
            column.iter().copied().enumerate().filter(|&(_, value)| value != 0.0).collect()
        };
        let left: Vec<_> = a.as_slice().chunks_exact(n).map(entries).collect();
        let mut product = DMatrix::zeros(n, n);
        for (sums, b) in
            product.as_mut_slice().chunks_exact_mut(n).zip(b.as_slice().chunks_exact(n))
        {
            for (column, &factor) in left.iter().zip(b).filter(|(_, factor)| **factor != 0.0) {
                for &(i, value) in column {
                    sums[i] = value.times_plus(factor, sums[i]);
                }
            }
        }
        product
    }

    fn invert(&self, m: &DMatrix<f64>) -> DMatrix<f64> {
        let n = m.nrows();
        if n < LARGE {
            return square::invert(n, m).0;
        }
        m.clone().try_inverse().unwrap_or_else(|| DMatrix::from_element(n, n, f64::NAN))
    }

    fn exp_extent(&self, x: &DVector<f64>) -> f64 {
        let Algebra { dim, structure, elliptic, .. } = self.algebra();
        let mut bound = domain::evaluate(elliptic, dim, x) / (PI * PI);
        let within = |bound: f64| bound <= 1.0 || !bound.is_finite();
        // The form of a large algebra would be too large.
        let large = elliptic.is_empty();
        if within(bound) && !large {
            return bound;
        }
        let mut ad = DMatrix::zeros(dim, dim);
        for &(i, j, k, c) in structure {
            ad[(k, j)] += x[i] * c;
        }
        let trace = ad.trace();
        if large {
            let skew = (&ad - ad.transpose()).norm_squared() / 8.0;
            bound += (skew + trace * trace) / (PI * PI);
            if within(bound) {
                return bound;
            }
        }
        // The bound may be larger than it need be: the eigenvalues themselves decide.
        let Some(schur) = Schur::try_new(ad, f64::EPSILON, 100 * dim) else { return bound };
        let eigenvalues: DVector<Complex<f64>> = schur.complex_eigenvalues();
        let largest = eigenvalues.iter().fold(0.0_f64, |worst, z| worst.worse(z.im.abs()));
        bound.min((largest * largest + trace * trace) / (PI * PI))
    }

    fn casimir_count(&self) -> usize {
        self.0.casimirs.len()
    }

    fn casimir(&self, index: usize, mu: &DVector<f64>) -> f64 {
        let terms = self.0.casimirs.get(index).into_iter().flatten();
        terms.map(|(c, factors)| monomial::<f64, _>(*c, factors, mu)).sum()
    }
}

impl super::group::CayleyTables for DynamicTables<true> {}
