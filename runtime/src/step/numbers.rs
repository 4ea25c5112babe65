//! Group elements as the numbers that straight-line programs compute with.

use nalgebra::{Isometry2, Translation2, UnitComplex};

use crate::group::LieGroup;
use crate::group::product::{pair::Product, row::Power};
use crate::group::se2::SE2;
use crate::group::se3::{self, SE3};
use crate::group::so3::{self, Quaternions};
use crate::number::Scalar;
use crate::table::fixed::{StaticAlgebra, StaticMatrixGroup};

/// A group whose elements the programs of a step read and write as a row of numbers; `coadjoint emit` says which.
pub trait ElementNumbers: LieGroup {
    /// How many numbers an element has.
    const COUNT: usize;

    /// Writes the numbers of g; `numbers` has [`ElementNumbers::COUNT`] places.
    fn write(g: &Self::Element, numbers: &mut [Self::Scalar]);

    /// The element with these numbers.
    fn read(numbers: &[Self::Scalar]) -> Self::Element;
}

impl<T: Scalar, const DOUBLE_COVER: bool> ElementNumbers for Quaternions<T, DOUBLE_COVER> {
    const COUNT: usize = 4;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [T]) {
        numbers[..4].copy_from_slice(&so3::numbers(g));
    }

    #[inline(always)]
    fn read(n: &[T]) -> Self::Element {
        so3::quaternion([n[0], n[1], n[2], n[3]])
    }
}

impl<T: Scalar> ElementNumbers for SE3<T> {
    const COUNT: usize = 7;

    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [T]) {
        numbers[..7].copy_from_slice(&se3::numbers(g));
    }

    #[inline(always)]
    fn read(n: &[T]) -> Self::Element {
        se3::element([n[0], n[1], n[2], n[3], n[4], n[5], n[6]])
    }
}

impl<T: Scalar> ElementNumbers for SE2<T> {
    const COUNT: usize = 4;

    /// Cosine and sine of half the angle, then the translation.
    #[inline(always)]
    fn write(g: &Self::Element, numbers: &mut [T]) {
        let (half, one) = (T::of(0.5), T::of(1.0));
        let (cosine, sine) = (g.rotation.re, g.rotation.im);
        // The larger of both by a root, the other one by sin θ = 2 sin(θ/2) cos(θ/2).
        let large = (half + half * cosine.simd_abs()).simd_sqrt();
        let small = half * sine / large;
        let near = cosine.simd_ge(T::of(0.0));
        let sign = one.select(sine.simd_ge(T::of(0.0)), -one);
        numbers[0] = large.select(near, small * sign);
        numbers[1] = small.select(near, large * sign);
        numbers[2] = g.translation.vector.x;
        numbers[3] = g.translation.vector.y;
    }

    #[inline(always)]
    fn read(n: &[T]) -> Self::Element {
        let (w, k) = (n[0], n[1]);
        let rotation =
            UnitComplex::new_unchecked(nalgebra::Complex::new((w - k) * (w + k), (w + w) * k));
        Isometry2::from_parts(Translation2::new(n[2], n[3]), rotation)
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
