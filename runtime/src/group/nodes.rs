//! Vectors of space at several nodes, the numbers of all nodes side by side: the compiler makes lanes of them.

use coadjoint_geometry::bernoulli::BETA;

use crate::number::Scalar;

/// A number at each node.
pub(super) type Row<T, const M: usize> = [T; M];
/// A vector of space at each node.
pub(super) type Rows3<T, const M: usize> = [Row<T, M>; 3];

/// The number f(i) at each node i.
#[inline(always)]
pub(super) fn each<T: Scalar, const M: usize>(mut f: impl FnMut(usize) -> T) -> Row<T, M> {
    let mut row = [T::of(0.0); M];
    for i in 0..M {
        row[i] = f(i);
    }
    row
}

/// a × b
#[inline(always)]
pub(super) fn cross<T: Scalar, const M: usize>(a: &Rows3<T, M>, b: &Rows3<T, M>) -> Rows3<T, M> {
    let entry = |j: usize, k: usize| each(|i| (-a[k][i]).times_plus(b[j][i], a[j][i] * b[k][i]));
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

/// a·b
#[inline(always)]
pub(super) fn dot<T: Scalar, const M: usize>(a: &Rows3<T, M>, b: &Rows3<T, M>) -> Row<T, M> {
    each(|i| a[2][i].times_plus(b[2][i], a[1][i].times_plus(b[1][i], a[0][i] * b[0][i])))
}

/// a + s·b
#[inline(always)]
pub(super) fn plus<T: Scalar, const M: usize>(
    a: &Rows3<T, M>,
    s: T,
    b: &Rows3<T, M>,
) -> Rows3<T, M> {
    plus_each(a, &[s; M], b)
}

/// a + s·b, with an s for each node
#[inline(always)]
pub(super) fn plus_each<T: Scalar, const M: usize>(
    a: &Rows3<T, M>,
    s: &Row<T, M>,
    b: &Rows3<T, M>,
) -> Rows3<T, M> {
    let entry = |k: usize| each(|i| b[k][i].times_plus(s[i], a[k][i]));
    [entry(0), entry(1), entry(2)]
}

/// s·a
#[inline(always)]
pub(super) fn scaled<T: Scalar, const M: usize>(s: T, a: &Rows3<T, M>) -> Rows3<T, M> {
    let entry = |k: usize| each(|i| a[k][i] * s);
    [entry(0), entry(1), entry(2)]
}

/// a·b at each node
#[inline(always)]
pub(super) fn product<T: Scalar, const M: usize>(a: &Row<T, M>, b: &Row<T, M>) -> Row<T, M> {
    each(|i| a[i] * b[i])
}

/// a + b at each node
#[inline(always)]
pub(super) fn plus_rows<T: Scalar, const M: usize>(a: &Row<T, M>, b: &Row<T, M>) -> Row<T, M> {
    each(|i| a[i] + b[i])
}

/// −s for each node
#[inline(always)]
pub(super) fn minus<T: Scalar, const M: usize>(s: &Row<T, M>) -> Row<T, M> {
    each(|i| -s[i])
}

/// c(t) = Σ |B₂ₖ|/(2k)! tᵏ⁻¹, t = |x|², the factor of exp's J_R on so(3), with as many terms as its series has to this degree;
/// 2 dc/dt, and 4 d²c/dt².
#[inline(always)]
pub(super) fn bernoulli<T: Scalar, const M: usize>(t: &Row<T, M>, degree: usize) -> [Row<T, M>; 3] {
    let mut sums = [[T::of(0.0); M]; 3];
    for k in (0..degree / 2).rev() {
        let beta = BETA[2 * k + 2].abs();
        let factors = [1.0, 2.0 * k as f64, 4.0 * (k * k.saturating_sub(1)) as f64];
        // The powers tᵏ, tᵏ⁻¹, tᵏ⁻².
        for (order, (sum, factor)) in sums.iter_mut().zip(factors).enumerate() {
            if order <= k {
                *sum = each(|i| sum[i].times_plus(t[i], T::of(factor * beta)));
            }
        }
    }
    sums
}
