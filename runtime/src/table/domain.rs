//! Where charts are charts, for groups given by tables: quadratic forms that bound eigenvalues.

use core::f64::consts::PI;
use core::ops::Index;

use super::algebra::{BasisEntry, StructureConstant};
use crate::number::Scalar;

/// Basis vectors that span a nilpotent ideal, as bits. An algebra of more dimensions than bits is not looked at.
pub(super) const MAX_DIM: usize = 128;

/// Writes to `form` (n×n, row by row) a quadratic form Q with (Im λ)² ≤ Q(x) for every eigenvalue λ of ad_x, and
/// returns the nilpotent ideal that was found. `ad` (n×n×n) receives the matrices ad_i, row by row.
///
/// Basis vectors that span a nilpotent ideal R leave the eigenvalues alone, since R acts as zero on the
/// composition factors of 𝔤. On 𝔤/R and on R, blocks of at most three dimensions with trace zero have
/// (Im λ)² = −½ tr A² where λ is imaginary; for larger ones Bendixson's theorem gives
/// (Im λ)² ≤ ½ ‖½(A − Aᵀ)‖² in Frobenius' norm. Where the algebra is not unimodular (tr ad_x)² is added: momenta, and
/// rounding with them, grow by its exponential.
pub(super) const fn elliptic_form(
    n: usize,
    structure: &[StructureConstant],
    ad: &mut [f64],
    form: &mut [f64],
) -> u128 {
    let mut at = 0;
    while at < structure.len() {
        let (i, j, k, c) = structure[at];
        ad[(i * n + k) * n + j] += c;
        at += 1;
    }
    let ideal = if n > MAX_DIM { 0 } else { nilpotent_ideal(n, structure, ad) };
    let size = ideal.count_ones() as usize;
    let small = size <= 3 && n - size <= 3;
    let traceless =
        small && traceless(n, structure, ideal, true) && traceless(n, structure, ideal, false);
    // One form serves both blocks where they agree, or where one of them is zero; else the sum does, if no
    // form is indefinite.
    let agreement = agreement(n, structure, ad, ideal, traceless);
    let exact = traceless && !matches!(agreement, Agreement::None);
    let mut at = 0;
    while at < structure.len() {
        let (a, j, k, c) = structure[at];
        let inside = holds(ideal, j);
        let both = matches!(agreement, Agreement::Equal) && inside;
        if !holds(ideal, a) && holds(ideal, k) == inside && !both {
            let mut b = 0;
            while b < n {
                if !holds(ideal, b) {
                    form[a * n + b] += share(n, ad, exact, b, j, k, c);
                }
                b += 1;
            }
        }
        at += 1;
    }
    let mut at = 0;
    while at < n * n {
        form[at] += trace(n, ad, at / n) * trace(n, ad, at % n);
        at += 1;
    }
    ideal
}

/// tr ad_a.
const fn trace(n: usize, ad: &[f64], a: usize) -> f64 {
    let (mut sum, mut j) = (0.0, 0);
    while j < n {
        sum += ad[(a * n + j) * n + j];
        j += 1;
    }
    sum
}

/// How the forms of the two blocks compare.
enum Agreement {
    Equal,
    OneIsZero,
    None,
}

/// The contribution of the entry c at (k, j) of a matrix to its product with ad_b: −½ tr A B, or ½ ⟨skew A, skew B⟩.
const fn share(n: usize, ad: &[f64], exact: bool, b: usize, j: usize, k: usize, c: f64) -> f64 {
    let same = ad[(b * n + k) * n + j];
    let crossed = ad[(b * n + j) * n + k];
    if exact { -0.5 * c * crossed } else { 0.25 * c * (same - crossed) }
}

const fn holds(set: u128, i: usize) -> bool {
    i < MAX_DIM && set >> i & 1 == 1
}

const fn agreement(
    n: usize,
    structure: &[StructureConstant],
    ad: &[f64],
    ideal: u128,
    exact: bool,
) -> Agreement {
    let (mut equal, mut no_quotient, mut nothing_inside) = (true, true, true);
    let mut a = 0;
    while a < n && ideal != 0 {
        let mut b = 0;
        while b < n && !holds(ideal, a) {
            let (mut quotient, mut within) = (0.0, 0.0);
            let mut at = 0;
            while at < structure.len() && !holds(ideal, b) {
                let (i, j, k, c) = structure[at];
                if i == a && holds(ideal, j) && holds(ideal, k) {
                    within += share(n, ad, exact, b, j, k, c);
                } else if i == a && !holds(ideal, j) && !holds(ideal, k) {
                    quotient += share(n, ad, exact, b, j, k, c);
                }
                at += 1;
            }
            equal = equal && quotient == within;
            no_quotient = no_quotient && quotient == 0.0;
            nothing_inside = nothing_inside && within == 0.0;
            b += 1;
        }
        a += 1;
    }
    if no_quotient || nothing_inside {
        Agreement::OneIsZero
    } else if equal {
        Agreement::Equal
    } else {
        Agreement::None
    }
}

/// The largest set of basis vectors in the radical of the Killing form that spans an ideal, if that is nilpotent;
/// else none.
const fn nilpotent_ideal(n: usize, structure: &[StructureConstant], ad: &[f64]) -> u128 {
    let mut ideal = if n == MAX_DIM { u128::MAX } else { (1 << n) - 1 };
    let mut b = 0;
    while b < n {
        let mut products = [0.0; MAX_DIM];
        let mut at = 0;
        while at < structure.len() {
            let (i, j, k, c) = structure[at];
            products[i] += c * ad[(b * n + j) * n + k];
            at += 1;
        }
        let mut i = 0;
        while i < n {
            if products[i] != 0.0 {
                ideal &= !(1 << i);
            }
            i += 1;
        }
        b += 1;
    }
    // A vector whose brackets leave the set is in no ideal within it.
    let mut before = !ideal;
    while before != ideal {
        before = ideal;
        let mut at = 0;
        while at < structure.len() {
            let (_, j, k, c) = structure[at];
            if c != 0.0 && holds(ideal, j) && !holds(ideal, k) {
                ideal &= !(1 << j);
            }
            at += 1;
        }
    }
    // The descending series, by the basis vectors that can occur in it.
    let (mut series, mut length) = (ideal, 0);
    while series != 0 {
        if length > n {
            return 0;
        }
        length += 1;
        let mut next = 0_u128;
        let mut at = 0;
        while at < structure.len() {
            let (i, j, k, c) = structure[at];
            if c != 0.0 && holds(ideal, i) && holds(series, j) {
                next |= 1 << k;
            }
            at += 1;
        }
        series = next;
    }
    ideal
}

/// Whether every ad_i has trace zero on the block.
const fn traceless(n: usize, structure: &[StructureConstant], ideal: u128, inside: bool) -> bool {
    let mut a = 0;
    while a < n {
        let mut trace = 0.0;
        let mut at = 0;
        while at < structure.len() {
            let (i, j, k, c) = structure[at];
            if i == a && j == k && holds(ideal, j) == inside {
                trace += c;
            }
            at += 1;
        }
        if trace != 0.0 {
            return false;
        }
        a += 1;
    }
    true
}

/// Writes to `form` a quadratic form Q with |λ|² ≤ Q(x) for every eigenvalue λ of the matrix of x: half the square
/// of its Frobenius norm where all matrices are antisymmetric (eigenvalues come in pairs), else four times that,
/// which keeps 1 − x/2 well conditioned where Q ≤ 4. Basis vectors in `ideal` whose matrix squares to zero and is
/// orthogonal to all others under the trace do not count (translations).
pub(super) const fn cayley_form(
    n: usize,
    entries: &[BasisEntry],
    antisymmetric: bool,
    ideal: u128,
    form: &mut [f64],
) {
    let factor = if antisymmetric { 0.5 } else { 2.0 };
    let mut i = 0;
    while i < n * n {
        let (a, b) = (i / n, i % n);
        let skip = (holds(ideal, a) && is_null(n, entries, a))
            || (holds(ideal, b) && is_null(n, entries, b));
        form[i] = if skip { 0.0 } else { factor * matrix_product(entries, a, b, false) };
        i += 1;
    }
}

/// [`LieGroup::exp_extent`](crate::LieGroup::exp_extent) by an elliptic form.
pub(super) fn exp_extent<T: Scalar, V>(form: &[f64], n: usize, x: &V) -> T
where
    V: Index<usize, Output = T>,
{
    evaluate(form, n, x) * T::of(1.0 / (PI * PI))
}

/// [`CayleyGroup::cayley_extent`](crate::CayleyGroup::cayley_extent) by a Cayley form.
pub(super) fn cayley_extent<T: Scalar, V>(form: &[f64], n: usize, x: &V) -> T
where
    V: Index<usize, Output = T>,
{
    evaluate(form, n, x) * T::of(0.25)
}

/// Σ Q_ij x_i x_j over a form as the functions above write it.
fn evaluate<T: Scalar, V>(form: &[f64], n: usize, x: &V) -> T
where
    V: Index<usize, Output = T>,
{
    let mut sum = T::of(0.0);
    for i in 0..n {
        // Where the form says nothing of x, x must be finite all the same.
        let mut row = x[i] * T::of(0.0);
        for j in 0..n {
            let value = form.get(i * n + j).copied().unwrap_or(0.0);
            if value != 0.0 {
                row = x[j].times_plus(T::of(value), row);
            }
        }
        sum = row.times_plus(x[i], sum);
    }
    sum
}

/// Whether the matrix of e_a squares to zero and its products with all others have trace zero.
const fn is_null(n: usize, entries: &[BasisEntry], a: usize) -> bool {
    let mut b = 0;
    while b < n {
        if matrix_product(entries, a, b, true) != 0.0 {
            return false;
        }
        b += 1;
    }
    let mut first = 0;
    while first < entries.len() {
        let (i, _, column, _) = entries[first];
        if i == a {
            let mut second = 0;
            while second < entries.len() {
                let (j, row, _, _) = entries[second];
                if j == a && row == column {
                    return false;
                }
                second += 1;
            }
        }
        first += 1;
    }
    true
}

/// The sum of products of the entries of e_a with those of e_b, or of its transpose.
const fn matrix_product(entries: &[BasisEntry], a: usize, b: usize, transposed: bool) -> f64 {
    let mut sum = 0.0;
    let mut first = 0;
    while first < entries.len() {
        let (i, row, column, value) = entries[first];
        if i == a {
            let mut second = 0;
            while second < entries.len() {
                let (j, other_row, other_column, other) = entries[second];
                let meet = if transposed {
                    other_row == column && other_column == row
                } else {
                    other_row == row && other_column == column
                };
                if j == b && meet {
                    sum += value * other;
                }
                second += 1;
            }
        }
        first += 1;
    }
    sum
}
