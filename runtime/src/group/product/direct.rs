//! Products of groups known at run time: spin chains of any length.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use crate::group::element_error::{ElementError, finite, fixed};
use crate::group::{CayleyGroup, LieGroup};
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;

/// The direct product of any number of groups, known at run time.
///
/// Elements are lists with one element for each factor; coordinates are those of the factors in
/// order; matrices are block diagonal; Casimirs are those of the first factor, then of the second,
/// and so on. All work but that for n×n matrices is linear in the number of factors.
///
/// ```
/// use coadjoint::{groups::DirectProduct, LieGroup, SO3};
/// use nalgebra::DVector;
///
/// let chain = DirectProduct::new(vec![SO3::<f64>::new(); 64]);
/// assert_eq!((chain.dim(), chain.casimir_count(), chain.matrix_size()), (192, 64, 192));
/// let x = DVector::from_fn(192, |i, _| (i as f64).sin());
/// assert!((chain.log(&chain.exp(&x)).unwrap() - x).amax() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct DirectProduct<G> {
    factors: Vec<Factor<G>>,
    dim: usize,
    matrix_size: usize,
    casimirs: usize,
}

/// A factor and where its coordinates, matrices and Casimirs begin.
#[derive(Clone, Debug)]
struct Factor<G> {
    group: G,
    coordinate: usize,
    row: usize,
    casimir: usize,
}

impl<G: LieGroup> DirectProduct<G> {
    /// The product of `factors` in this order.
    #[must_use]
    pub fn new(factors: Vec<G>) -> Self {
        let (mut dim, mut matrix_size, mut casimirs) = (0, 0, 0);
        let place = |group: G| {
            let factor = Factor { coordinate: dim, row: matrix_size, casimir: casimirs, group };
            dim += factor.group.dim();
            matrix_size += factor.group.matrix_size();
            casimirs += factor.group.casimir_count();
            factor
        };
        let factors = factors.into_iter().map(place).collect();
        Self { factors, dim, matrix_size, casimirs }
    }

    /// The factors, in order.
    pub fn factors(&self) -> impl ExactSizeIterator<Item = &G> {
        self.factors.iter().map(|factor| &factor.group)
    }

    /// The factor that owns a row of the matrices, or a Casimir.
    fn owner(&self, index: usize, first: impl Fn(&Factor<G>) -> usize) -> Option<usize> {
        self.factors.partition_point(|factor| first(factor) <= index).checked_sub(1)
    }
}

impl<G: LieGroup> Factor<G> {
    /// Its own coordinates.
    fn part(&self, x: &DVector<G::Scalar>) -> G::Vector {
        G::Vector::from_entries(self.group.dim(), |i| x[self.coordinate + i])
    }

    /// Writes its own coordinates.
    fn place(&self, part: &G::Vector, x: &mut DVector<G::Scalar>) {
        for i in 0..part.dim() {
            x[self.coordinate + i] = part[i];
        }
    }
}

impl<T: Scalar, G: LieGroup<Scalar = T>> DirectProduct<G> {
    /// Joins coordinates made factor by factor.
    fn coordinates(&self, mut make: impl FnMut(usize, &Factor<G>) -> G::Vector) -> DVector<T> {
        let mut result = <DVector<T> as Coordinates<T>>::zeros(self.dim);
        for (at, factor) in self.factors.iter().enumerate() {
            factor.place(&make(at, factor), &mut result);
        }
        result
    }

    /// Joins coordinates and the diagonal blocks of their derivative.
    fn with_derivative(
        &self,
        make: impl Fn(&Factor<G>) -> (G::Vector, <G::Vector as Coordinates<T>>::Matrix),
    ) -> (DVector<T>, DMatrix<T>) {
        let mut slope = DVector::<T>::zero_matrix(self.dim);
        let value = self.coordinates(|_, factor| {
            let (value, block) = make(factor);
            for i in 0..value.dim() {
                for j in 0..value.dim() {
                    slope[(factor.coordinate + i, factor.coordinate + j)] = block[(i, j)];
                }
            }
            value
        });
        (value, slope)
    }

    /// Joins elements and coordinates.
    fn with_elements(
        &self,
        make: impl Fn(&Factor<G>) -> (G::Element, G::Vector),
    ) -> (Vec<G::Element>, DVector<T>) {
        let mut elements = Vec::with_capacity(self.factors.len());
        let moved = self.coordinates(|_, factor| {
            let (g, nu) = make(factor);
            elements.push(g);
            nu
        });
        (elements, moved)
    }
}

impl<T: Scalar, G: LieGroup<Scalar = T>> LieGroup for DirectProduct<G> {
    type Scalar = T;
    type Vector = DVector<T>;
    type Element = Vec<G::Element>;

    fn dim(&self) -> usize {
        self.dim
    }

    fn identity(&self) -> Self::Element {
        self.factors.iter().map(|factor| factor.group.identity()).collect()
    }

    fn compose(&self, g: &Self::Element, h: &Self::Element) -> Self::Element {
        let pairs = self.factors.iter().zip(g).zip(h);
        pairs.map(|((factor, g), h)| factor.group.compose(g, h)).collect()
    }

    fn inverse(&self, g: &Self::Element) -> Self::Element {
        self.factors.iter().zip(g).map(|(factor, g)| factor.group.inverse(g)).collect()
    }

    fn exp(&self, x: &Self::Vector) -> Self::Element {
        self.factors.iter().map(|factor| factor.group.exp(&factor.part(x))).collect()
    }

    fn log(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = <DVector<T> as Coordinates<T>>::zeros(self.dim);
        for (factor, g) in self.factors.iter().zip(g) {
            factor.place(&factor.group.log(g)?, &mut result);
        }
        Some(result)
    }

    fn bracket(&self, x: &Self::Vector, y: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.bracket(&f.part(x), &f.part(y)))
    }

    fn ad_star(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.ad_star(&f.part(x), &f.part(mu)))
    }

    fn adjoint(&self, g: &Self::Element, x: &Self::Vector) -> Self::Vector {
        self.coordinates(|at, f| f.group.adjoint(&g[at], &f.part(x)))
    }

    fn coadjoint(&self, g: &Self::Element, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|at, f| f.group.coadjoint(&g[at], &f.part(mu)))
    }

    fn exp_transport(&self, x: &Self::Vector, mu: &Self::Vector) -> (Self::Element, Self::Vector) {
        self.with_elements(|f| f.group.exp_transport(&f.part(x), &f.part(mu)))
    }

    fn dexp_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.dexp_transpose(&f.part(x), &f.part(mu)))
    }

    fn dexp_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, DMatrix<T>) {
        self.with_derivative(|f| f.group.dexp_transpose_with_derivative(&f.part(x), &f.part(mu)))
    }

    fn dexp_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.dexp_inverse_transpose(&f.part(x), &f.part(p)))
    }

    #[inline(always)]
    fn exp_extent(&self, x: &Self::Vector) -> T {
        self.factors.iter().fold(T::of(0.0), |extent, factor| {
            extent.worse(factor.group.exp_extent(&factor.part(x)))
        })
    }

    #[inline(always)]
    fn element_defect(&self, g: &Self::Element) -> T {
        self.factors
            .iter()
            .zip(g)
            .fold(T::of(0.0), |defect, (factor, g)| defect.worse(factor.group.element_defect(g)))
    }

    fn casimir_count(&self) -> usize {
        self.casimirs
    }

    fn casimir(&self, index: usize, mu: &Self::Vector) -> T {
        if index >= self.casimirs {
            return T::of(0.0);
        }
        // Of factors without Casimirs the last of equal beginnings is the owner.
        self.owner(index, |factor| factor.casimir).map_or(T::of(0.0), |at| {
            let factor = &self.factors[at];
            factor.group.casimir(index - factor.casimir, &factor.part(mu))
        })
    }

    fn matrix_size(&self) -> usize {
        self.matrix_size
    }

    fn matrix_entry(&self, g: &Self::Element, row: usize, column: usize) -> T {
        let owner = |index| self.owner(index, |factor| factor.row);
        match (owner(row), owner(column)) {
            (Some(at), Some(other)) if at == other => {
                let factor = &self.factors[at];
                factor.group.matrix_entry(&g[at], row - factor.row, column - factor.row)
            }
            _ => T::of(0.0),
        }
    }

    fn element_from_matrix(
        &self,
        entry: impl Fn(usize, usize) -> T,
    ) -> Result<Self::Element, ElementError> {
        finite(self.matrix_size, &entry)?;
        for factor in &self.factors {
            let block = factor.row..factor.row + factor.group.matrix_size();
            for row in block.clone() {
                for column in (0..self.matrix_size).filter(|column| !block.contains(column)) {
                    fixed(&entry, (row, column), 0.0)?;
                }
            }
        }
        // As `dyn`, so that products of products do not nest closure types without end.
        let entry: &dyn Fn(usize, usize) -> T = &entry;
        let element = |factor: &Factor<G>| {
            factor.group.element_from_matrix(|i, j| entry(factor.row + i, factor.row + j))
        };
        self.factors.iter().map(element).collect()
    }
}

impl<T: Scalar, G: CayleyGroup<Scalar = T>> CayleyGroup for DirectProduct<G> {
    fn cayley_transport(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Element, Self::Vector) {
        self.with_elements(|f| f.group.cayley_transport(&f.part(x), &f.part(mu)))
    }

    #[inline(always)]
    fn cayley_extent(&self, x: &Self::Vector) -> T {
        self.factors.iter().fold(T::of(0.0), |extent, factor| {
            extent.worse(factor.group.cayley_extent(&factor.part(x)))
        })
    }

    fn cayley_inverse(&self, g: &Self::Element) -> Option<Self::Vector> {
        let mut result = <DVector<T> as Coordinates<T>>::zeros(self.dim);
        for (factor, g) in self.factors.iter().zip(g) {
            factor.place(&factor.group.cayley_inverse(g)?, &mut result);
        }
        Some(result)
    }

    fn dcay_transpose(&self, x: &Self::Vector, mu: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.dcay_transpose(&f.part(x), &f.part(mu)))
    }

    fn dcay_transpose_with_derivative(
        &self,
        x: &Self::Vector,
        mu: &Self::Vector,
    ) -> (Self::Vector, DMatrix<T>) {
        self.with_derivative(|f| f.group.dcay_transpose_with_derivative(&f.part(x), &f.part(mu)))
    }

    fn dcay_inverse_transpose(&self, x: &Self::Vector, p: &Self::Vector) -> Self::Vector {
        self.coordinates(|_, f| f.group.dcay_inverse_transpose(&f.part(x), &f.part(p)))
    }
}
