//! How x moves with p where x = ∂S/∂p(p), p = P(x): elimination by tiles of three, in lanes.

use nalgebra::{SMatrix, SVector};

use crate::number::scalar::Scalar;

/// The side of a tile.
const SIDE: usize = 3;

/// Three rows of three.
type Tile<T> = [[T; SIDE]; SIDE];

/// J = (1 − H D)⁻¹ H and (1 − H D)⁻¹ r, for up to six dimensions: with H the Hessian of S and D the
/// derivative of P, x moves by J δ where P(x) moves by δ, and to the solution by the second where r is
/// ∂S/∂p(P(x)) − x.
///
/// Tiles are not pivoted: 1 − H D is near the identity. A singular one gives entries that are not finite.
// Written out: in loops the tiles would go through memory.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn response<T: Scalar, const N: usize>(
    hessian: &SMatrix<T, N, N>,
    derivative: &SMatrix<T, N, N>,
    residual: &SVector<T, N>,
) -> (SMatrix<T, N, N>, SVector<T, N>) {
    const { assert!(N <= 2 * SIDE) };
    let [[h00, h01], [h10, h11]] = tiles(hessian);
    let [[d00, d01], [d10, d11]] = tiles(derivative);
    let entry = |i: usize| if i < N { residual[i] } else { T::of(0.0) };
    let (r0, r1) = ([entry(0), entry(1), entry(2)], [entry(3), entry(4), entry(5)]);

    let (one, zero) = (unit::<T>(T::of(1.0)), unit::<T>(T::of(0.0)));
    let m00 = less(&less(&one, &h00, &d00), &h01, &d10);
    let m01 = less(&less(&zero, &h00, &d01), &h01, &d11);
    let m10 = less(&less(&zero, &h10, &d00), &h11, &d10);
    let m11 = less(&less(&one, &h10, &d01), &h11, &d11);
    // Forwards …
    let inverse0 = inverse(&m00);
    let upper = product(&inverse0, &m01);
    let (j00, j01) = (product(&inverse0, &h00), product(&inverse0, &h01));
    let x0 = applied(&inverse0, &r0);
    let inverse1 = inverse(&less(&m11, &m10, &upper));
    let (j10, j11) = (less(&h10, &m10, &j00), less(&h11, &m10, &j01));
    let x1 = less_applied(&r1, &m10, &x0);
    // … and backwards.
    let (j10, j11) = (product(&inverse1, &j10), product(&inverse1, &j11));
    let x1 = applied(&inverse1, &x1);
    let (j00, j01) = (less(&j00, &upper, &j10), less(&j01, &upper, &j11));
    let x0 = less_applied(&x0, &upper, &x1);

    let rows = [[j00, j01], [j10, j11]];
    let response = SMatrix::from_fn(|i, j| rows[i / SIDE][j / SIDE][i % SIDE][j % SIDE]);
    (response, SVector::from_fn(|i, _| if i < SIDE { x0[i] } else { x1[i - SIDE] }))
}

/// The tiles of a matrix, zero beyond it.
#[inline(always)]
fn tiles<T: Scalar, const N: usize>(m: &SMatrix<T, N, N>) -> [[Tile<T>; 2]; 2] {
    let entry = |i: usize, j: usize| if i < N && j < N { m[(i, j)] } else { T::of(0.0) };
    let row = |i: usize, j: usize| [entry(i, j), entry(i, j + 1), entry(i, j + 2)];
    let tile = |i: usize, j: usize| [row(i, j), row(i + 1, j), row(i + 2, j)];
    [[tile(0, 0), tile(0, 3)], [tile(3, 0), tile(3, 3)]]
}

/// This number on the diagonal.
#[inline(always)]
fn unit<T: Scalar>(on: T) -> Tile<T> {
    let zero = T::of(0.0);
    [[on, zero, zero], [zero, on, zero], [zero, zero, on]]
}

/// a·b
#[cfg_attr(not(debug_assertions), inline(always))]
fn product<T: Scalar>(a: &Tile<T>, b: &Tile<T>) -> Tile<T> {
    let entry = |i: usize, j: usize| {
        a[i][2].times_plus(b[2][j], a[i][1].times_plus(b[1][j], a[i][0] * b[0][j]))
    };
    let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
    [row(0), row(1), row(2)]
}

/// from − a·b
#[cfg_attr(not(debug_assertions), inline(always))]
fn less<T: Scalar>(from: &Tile<T>, a: &Tile<T>, b: &Tile<T>) -> Tile<T> {
    let entry = |i: usize, j: usize| {
        let first = (-a[i][0]).times_plus(b[0][j], from[i][j]);
        (-a[i][2]).times_plus(b[2][j], (-a[i][1]).times_plus(b[1][j], first))
    };
    let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
    [row(0), row(1), row(2)]
}

/// a·v
#[inline(always)]
fn applied<T: Scalar>(a: &Tile<T>, v: &[T; SIDE]) -> [T; SIDE] {
    let entry = |i: usize| a[i][2].times_plus(v[2], a[i][1].times_plus(v[1], a[i][0] * v[0]));
    [entry(0), entry(1), entry(2)]
}

/// from − a·v
#[inline(always)]
fn less_applied<T: Scalar>(from: &[T; SIDE], a: &Tile<T>, v: &[T; SIDE]) -> [T; SIDE] {
    let product = applied(a, v);
    [from[0] - product[0], from[1] - product[1], from[2] - product[2]]
}

/// By cofactors.
#[cfg_attr(not(debug_assertions), inline(always))]
fn inverse<T: Scalar>(a: &Tile<T>) -> Tile<T> {
    let cross = |u: &[T; SIDE], v: &[T; SIDE]| {
        let entry = |i: usize, j: usize| (-u[j]).times_plus(v[i], u[i] * v[j]);
        [entry(1, 2), entry(2, 0), entry(0, 1)]
    };
    let (x, y, z) = (cross(&a[1], &a[2]), cross(&a[2], &a[0]), cross(&a[0], &a[1]));
    let determinant = a[0][2].times_plus(x[2], a[0][1].times_plus(x[1], a[0][0] * x[0]));
    let scale = T::of(1.0) / determinant;
    let row = |i: usize| [x[i] * scale, y[i] * scale, z[i] * scale];
    [row(0), row(1), row(2)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the inverse, in every dimension up to six.
    fn solves<const N: usize>() -> bool {
        let h = SMatrix::<f64, N, N>::from_fn(|i, j| 0.3 / (1.0 + i as f64 + j as f64));
        let d = SMatrix::<f64, N, N>::from_fn(|i, j| (0.7 * i as f64 - 0.4 * j as f64).sin() / 2.0);
        let r = SVector::<f64, N>::from_fn(|i, _| 1.0 + i as f64);
        let (response, x) = response(&h, &d, &r);
        let matrix = SMatrix::<f64, N, N>::identity() - h * d;
        (matrix * response - h).amax() < 1e-15 * N as f64 && (matrix * x - r).amax() < 1e-14
    }

    #[test]
    fn the_response_solves_its_equation() {
        assert!(solves::<1>() && solves::<2>() && solves::<3>());
        assert!(solves::<4>() && solves::<5>() && solves::<6>());
    }
}
