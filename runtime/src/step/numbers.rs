//! Group elements as the numbers that straight-line programs compute with.

use crate::group::LieGroup;
use crate::group::closed::{Closed, Formulas};
use crate::group::product::{pair::Product, row::Power};
use crate::number::Scalar;
use crate::table::fixed::{StaticAlgebra, StaticMatrixGroup};

/// A group whose elements the programs of a step read and write as a row of numbers; `coadjoint emit` says which.
pub trait ElementNumbers: LieGroup {
    /// The number of numbers of an element.
    const COUNT: usize;

    /// Writes the numbers of g; `numbers` has [`ElementNumbers::COUNT`] places.
    fn write(g: &Self::Element, numbers: &mut [Self::Scalar]);

    /// The element with these numbers.
    fn read(numbers: &[Self::Scalar]) -> Self::Element;
}

impl<F, T, const N: usize, const M: usize> ElementNumbers for Closed<F, T, N, M>
where
    F: Formulas<N, M>,
    T: Scalar,
{
    const COUNT: usize = M;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [T]) {
        numbers[..M].copy_from_slice(&F::numbers(g));
    }

    #[inline(always)]
    fn read(numbers: &[T]) -> Self::Element {
        let mut own = [T::of(0.0); M];
        own.copy_from_slice(&numbers[..M]);
        F::element(own)
    }
}

impl<A, const N: usize, const D: usize, T> ElementNumbers for StaticMatrixGroup<A, N, D, T>
where
    A: StaticAlgebra,
    T: Scalar,
{
    const COUNT: usize = D * D;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [T]) {
        for i in 0..D {
            for j in 0..D {
                numbers[i * D + j] = g[(i, j)];
            }
        }
    }

    #[inline(always)]
    fn read(numbers: &[T]) -> Self::Element {
        let mut g = Self::Element::repeat(T::of(0.0));
        for i in 0..D {
            for j in 0..D {
                g[(i, j)] = numbers[i * D + j];
            }
        }
        g
    }
}

impl<G, const COPIES: usize, const N: usize> ElementNumbers for Power<G, COPIES, N>
where
    G: ElementNumbers + Default,
{
    const COUNT: usize = COPIES * G::COUNT;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [G::Scalar]) {
        for (copy, numbers) in g.iter().zip(numbers.chunks_mut(G::COUNT)) {
            G::write(copy, numbers);
        }
    }

    #[inline(always)]
    fn read(numbers: &[G::Scalar]) -> Self::Element {
        core::array::from_fn(|copy| G::read(&numbers[copy * G::COUNT..]))
    }
}

impl<A, B, const N: usize> ElementNumbers for Product<A, B, N>
where
    A: ElementNumbers + Default,
    B: ElementNumbers<Scalar = A::Scalar> + Default,
{
    const COUNT: usize = A::COUNT + B::COUNT;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [A::Scalar]) {
        A::write(&g.0, numbers);
        B::write(&g.1, &mut numbers[A::COUNT..]);
    }

    #[inline(always)]
    fn read(numbers: &[A::Scalar]) -> Self::Element {
        (A::read(numbers), B::read(&numbers[A::COUNT..]))
    }
}
