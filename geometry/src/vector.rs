//! Vectors of space, and matrices as lists of rows.

use crate::number::Number;

/// A vector of space.
pub type V3<T> = [T; 3];

/// The numbers f(0), f(1), …. The library's own ways, `map` and `from_fn` of arrays, stay calls where formulas are large.
#[inline(always)]
pub fn each<T: Number, const N: usize>(f: impl Fn(usize) -> T) -> [T; N] {
    let mut list = [T::of(0.0); N];
    for i in 0..N {
        list[i] = f(i);
    }
    list
}

/// The unit vector along axis `at`.
#[inline(always)]
pub fn unit<T: Number, const N: usize>(at: usize) -> [T; N] {
    let mut list = [T::of(0.0); N];
    list[at] = T::of(1.0);
    list
}

/// a × b
#[inline(always)]
pub fn cross<T: Number>(a: V3<T>, b: V3<T>) -> V3<T> {
    let entry = |i: usize, j: usize| (-a[j]).times_plus(b[i], a[i] * b[j]);
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

/// sum + a × b
#[inline(always)]
pub fn plus_cross<T: Number>(sum: V3<T>, a: V3<T>, b: V3<T>) -> V3<T> {
    let entry =
        |k: usize, i: usize, j: usize| (-a[j]).times_plus(b[i], a[i].times_plus(b[j], sum[k]));
    [entry(0, 1, 2), entry(1, 2, 0), entry(2, 0, 1)]
}

/// a·b
#[inline(always)]
pub fn dot<T: Number, const N: usize>(a: [T; N], b: [T; N]) -> T {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = a[i].times_plus(b[i], sum);
    }
    sum
}

/// a + s·b
#[inline(always)]
pub fn plus<T: Number>(a: V3<T>, s: T, b: V3<T>) -> V3<T> {
    [b[0].times_plus(s, a[0]), b[1].times_plus(s, a[1]), b[2].times_plus(s, a[2])]
}

/// a + factor·b
#[inline(always)]
pub fn plus_by<T: Number>(a: V3<T>, factor: f64, b: V3<T>) -> V3<T> {
    [b[0].by_plus(factor, a[0]), b[1].by_plus(factor, a[1]), b[2].by_plus(factor, a[2])]
}

/// factor·a
#[inline(always)]
pub fn by<T: Number>(factor: f64, a: V3<T>) -> V3<T> {
    [a[0].by(factor), a[1].by(factor), a[2].by(factor)]
}

/// a + b
#[inline(always)]
pub fn sum<T: Number>(a: V3<T>, b: V3<T>) -> V3<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a − b
#[inline(always)]
pub fn difference<T: Number>(a: V3<T>, b: V3<T>) -> V3<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// s·a
#[inline(always)]
pub fn scaled<T: Number>(s: T, a: V3<T>) -> V3<T> {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// −a
#[inline(always)]
pub fn minus<T: Number>(a: V3<T>) -> V3<T> {
    [-a[0], -a[1], -a[2]]
}

/// The matrix of v ↦ turn × v + diagonal·v.
#[inline(always)]
pub fn turned<T: Number>(turn: V3<T>, diagonal: T) -> [V3<T>; 3] {
    let [x, y, z] = turn;
    [[diagonal, -z, y], [z, diagonal, -x], [-y, x, diagonal]]
}

/// constant + a bᵀ
#[inline(always)]
pub fn plus_outer<T: Number>(constant: [V3<T>; 3], a: V3<T>, b: V3<T>) -> [V3<T>; 3] {
    let row = |i: usize| each(|j| a[i].times_plus(b[j], constant[i][j]));
    [row(0), row(1), row(2)]
}

/// Zero where all entries are finite, else not a number: ∞ − ∞ is none.
#[allow(clippy::eq_op)]
#[inline(always)]
pub fn finite<T: Number, const N: usize>(list: [T; N]) -> T {
    let mut sum = T::of(0.0);
    for i in 0..N {
        sum = sum + (list[i] - list[i]);
    }
    sum
}
