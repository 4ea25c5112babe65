//! The tables a matrix group is made of, wherever they are stored.

/// (i, j, k, c): [eᵢ, eⱼ] contains c·eₖ. Both (i, j, …) and (j, i, …) are listed.
pub type StructureConstant = (usize, usize, usize, f64);

/// (i, row, column, value): a non-zero entry of the matrix of eᵢ.
pub type BasisEntry = (usize, usize, usize, f64);

/// A term c·∏ μ_i^power of a Casimir, as (c, [(i, power), …]).
pub type CasimirTerm = (f64, &'static [(usize, u32)]);

/// A Lie algebra as tables, and what follows from them.
#[derive(Clone, Copy, Debug)]
pub struct Algebra<'a> {
    /// n, the dimension.
    pub(super) dim: usize,
    /// d, the size of the matrices; n where the adjoint representation is used.
    pub(super) size: usize,
    /// The non-zero structure constants.
    pub(super) structure: &'a [StructureConstant],
    /// The matrices of the basis; `None` where only the brackets are known. Elements are then matrices of the adjoint
    /// representation.
    pub(super) basis: Option<&'a [BasisEntry]>,
    /// The properties of the matrices in use.
    pub(super) facts: Facts,
    /// The inverse of their Gram matrix ⟨eᵢ, eⱼ⟩ = Σ entries of eᵢ times entries of eⱼ, row by row.
    pub(super) gram_inverse: &'a [f64],
    /// The quadratic form that bounds eigenvalues of ad_x: see `domain`.
    pub(super) elliptic: &'a [f64],
    /// The quadratic form that bounds eigenvalues of the matrix of x; nothing where it is ad_x.
    pub(super) cayley: &'a [f64],
}

/// The properties of the matrices in use.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// The first that is a combination of those before it. Only adjoint matrices may have one: that of an algebra with a
    /// centre.
    pub(super) dependent: Option<usize>,
    /// True if the Gram matrix is diagonal.
    pub(super) diagonal: bool,
    /// True if all are antisymmetric, so that elements are orthogonal.
    pub(super) orthogonal: bool,
    /// True if all have trace 0, so that elements have determinant 1.
    pub(super) traceless: bool,
}

impl<'a> Algebra<'a> {
    /// Entry number `index` of the matrices in use: of the basis, or adjoint, (ad_i)ₖⱼ = cᵢⱼᵏ.
    const fn entry(
        basis: Option<&'a [BasisEntry]>,
        structure: &'a [StructureConstant],
        index: usize,
    ) -> Option<BasisEntry> {
        match basis {
            Some(entries) if index < entries.len() => Some(entries[index]),
            None if index < structure.len() => {
                let (i, j, k, c) = structure[index];
                Some((i, k, j, c))
            }
            _ => None,
        }
    }
}

/// The facts about the matrices of an algebra of dimension `n`, whose Gram matrix is written to `gram` (n×n); all but
/// [`Facts::dependent`], which its inversion tells. `dense` (d×d) is room to work in; `gram` is zero before.
///
/// A function of the compiler's, where the tables are in the program.
pub(super) const fn facts(
    structure: &[StructureConstant],
    basis: Option<&[BasisEntry]>,
    (n, d): (usize, usize),
    gram: &mut [f64],
    dense: &mut [f64],
) -> Facts {
    let (mut orthogonal, mut traceless) = (true, true);
    let mut i = 0;
    while i < n {
        let mut at = 0;
        while at < d * d {
            dense[at] = 0.0;
            at += 1;
        }
        at = 0;
        while let Some((index, row, column, value)) = Algebra::entry(basis, structure, at) {
            if index == i {
                dense[row * d + column] += value;
            }
            at += 1;
        }
        at = 0;
        while let Some((index, row, column, value)) = Algebra::entry(basis, structure, at) {
            gram[i * n + index] += dense[row * d + column] * value;
            at += 1;
        }
        let (mut trace, mut place) = (0.0, 0);
        while place < d * d {
            let (row, column) = (place / d, place % d);
            if row == column {
                trace += dense[place];
            }
            orthogonal = orthogonal && dense[place] == -dense[column * d + row];
            place += 1;
        }
        traceless = traceless && trace == 0.0;
        i += 1;
    }
    let (mut diagonal, mut at) = (true, 0);
    while at < n * n {
        diagonal = diagonal && (at / n == at % n || gram[at] == 0.0);
        at += 1;
    }
    Facts { dependent: None, diagonal, orthogonal, traceless }
}

/// Replaces b, which is zero, by the inverse of a Gram matrix; else returns the first vector that depends on those before
/// it. A Gram matrix needs no pivoting.
pub(super) const fn invert(n: usize, a: &mut [f64], b: &mut [f64]) -> Option<usize> {
    // The squares of the lengths, until it is their turn.
    let mut k = 0;
    while k < n {
        b[k * n + k] = a[k * n + k];
        k += 1;
    }
    k = 0;
    while k < n {
        // The square of the vector's distance from the span of those before it.
        let rest = a[k * n + k];
        if rest.is_nan() || rest <= 1e-12 * b[k * n + k] {
            return Some(k);
        }
        b[k * n + k] = 1.0;
        let mut j = 0;
        while j < n {
            a[k * n + j] /= rest;
            b[k * n + j] /= rest;
            j += 1;
        }
        let mut i = 0;
        while i < n {
            let factor = a[i * n + k];
            if i != k && factor != 0.0 {
                j = 0;
                while j < n {
                    a[i * n + j] -= factor * a[k * n + j];
                    b[i * n + j] -= factor * b[k * n + j];
                    j += 1;
                }
            }
            i += 1;
        }
        k += 1;
    }
    None
}
