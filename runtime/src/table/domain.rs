//! Domains of charts for groups given by tables: quadratic forms that bound eigenvalues.

use core::ops::Index;

use super::algebra::{BasisEntry, StructureConstant};
use crate::number::Scalar;

/// Basis vectors that span a nilpotent ideal, as bits. An algebra of more dimensions than bits is not looked at.
pub(super) const MAX_DIM: usize = 128;

/// Writes to `form` (n×n, row by row) a quadratic form Q with (Im λ)² ≤ Q(x) for every eigenvalue λ of ad_x, and
/// returns the nilpotent ideal that was found. `ad` (n×n×n) receives the matrices ad_i, row by row; `inner` (n×n) is room to
/// work in. All are zero before.
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
    inner: &mut [f64],
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
    let (mut exact, mut a) = (size <= 3 && n - size <= 3, 0);
    while a < n {
        let traces = [trace(n, ad, a, ideal, true), trace(n, ad, a, ideal, false)];
        exact = exact && traces[0] == 0.0 && traces[1] == 0.0;
        a += 1;
    }
    loop {
        let mut at = 0;
        while at < n * n {
            (form[at], inner[at]) = (0.0, 0.0);
            at += 1;
        }
        at = 0;
        while at < structure.len() {
            let (a, j, k, c) = structure[at];
            let inside = holds(ideal, j);
            let mut b = if holds(ideal, a) || holds(ideal, k) != inside { n } else { 0 };
            while b < n {
                let block = if inside { &mut *inner } else { &mut *form };
                if !holds(ideal, b) {
                    block[a * n + b] += share(n, ad, exact, b, j, k, c);
                }
                b += 1;
            }
            at += 1;
        }
        // One form serves both blocks where they agree; else their sum does, unless forms may be negative.
        let (mut equal, mut no_quotient, mut nothing_inside) = (true, true, true);
        at = 0;
        while at < n * n {
            equal = equal && form[at] == inner[at];
            no_quotient = no_quotient && form[at] == 0.0;
            nothing_inside = nothing_inside && inner[at] == 0.0;
            at += 1;
        }
        if equal || no_quotient || nothing_inside || !exact {
            at = 0;
            while at < n * n {
                let [a, b] = [at / n, at % n];
                let whole = trace(n, ad, a, ideal, true) + trace(n, ad, a, ideal, false);
                let other = trace(n, ad, b, ideal, true) + trace(n, ad, b, ideal, false);
                form[at] += whole * other + if equal { 0.0 } else { inner[at] };
                at += 1;
            }
            return ideal;
        }
        exact = false;
    }
}

/// The trace of ad_a on the ideal, or on what is left.
const fn trace(n: usize, ad: &[f64], a: usize, ideal: u128, inside: bool) -> f64 {
    let (mut sum, mut j) = (0.0, 0);
    while j < n {
        if holds(ideal, j) == inside {
            sum += ad[(a * n + j) * n + j];
        }
        j += 1;
    }
    sum
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

/// Writes to `form` a quadratic form Q with |λ|² ≤ Q(x) for every eigenvalue λ of the matrix of x: half the square
/// of its Frobenius norm, by the Gram matrix, where all matrices are antisymmetric (eigenvalues come in pairs), else four
/// times that, which keeps 1 − x/2 well conditioned where Q ≤ 4. Basis vectors in `ideal` whose matrix squares to zero and is
/// orthogonal to all others under the trace do not count (translations).
pub(super) const fn cayley_form(
    n: usize,
    entries: &[BasisEntry],
    gram: &[f64],
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
        form[i] = if skip { 0.0 } else { factor * gram[i] };
        i += 1;
    }
}

/// Σ Q_ij x_i x_j over a form as the functions above write it.
pub(super) fn evaluate<T: Scalar, V>(form: &[f64], n: usize, x: &V) -> T
where
    V: Index<usize, Output = T>,
{
    let mut sum = T::of(0.0);
    for i in 0..n {
        // A coordinate that the form does not contain must be finite all the same.
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

/// True if the matrix of e_a squares to zero and its products with all others have trace zero.
const fn is_null(n: usize, entries: &[BasisEntry], a: usize) -> bool {
    let mut b = 0;
    while b < n {
        let (mut trace, mut first) = (0.0, 0);
        while first < entries.len() {
            let (i, row, column, value) = entries[first];
            let mut second = if i == a { 0 } else { entries.len() };
            while second < entries.len() {
                let (j, other_row, other_column, other) = entries[second];
                let meets = other_row == column;
                if j == a && meets {
                    return false;
                }
                if j == b && meets && other_column == row {
                    trace += value * other;
                }
                second += 1;
            }
            first += 1;
        }
        if trace != 0.0 {
            return false;
        }
        b += 1;
    }
    true
}
