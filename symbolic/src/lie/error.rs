//! The errors in the data of a Lie algebra.

use crate::number::Rational;

/// Why data does not define a Lie algebra. Every message is one line and names generators.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LieAlgebraError {
    /// There are no generators.
    #[error("a Lie algebra needs at least one generator; give its basis or its brackets")]
    Empty,
    /// More generators than brackets alone are of use for.
    #[error(
        "{generators} generators are known by their brackets alone; at most {limit} are: the matrices of such an algebra are those of its adjoint representation, {generators} tables of {generators} × {generators}. Write it as a product of smaller groups, or give a matrix basis"
    )]
    TooLarge {
        /// The number of generators.
        generators: usize,
        /// The most there may be.
        limit: usize,
    },
    /// The bracket of a generator with itself is given and not zero.
    #[error(
        "[{generator}, {generator}] = 0 always, but a value is given for it; leave it out, or name two generators"
    )]
    SelfBracket {
        /// The name of the generator.
        generator: String,
        /// Its index, from zero.
        index: usize,
    },
    /// A basis matrix is not square.
    #[error("basis matrix {generator} is {rows} × {columns}; every basis matrix must be square")]
    NotSquare {
        /// The name of the generator.
        generator: String,
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// Basis matrices differ in size.
    #[error(
        "basis matrix {generator} is {size} × {size} but the first is {expected} × {expected}; all must have one size"
    )]
    DifferentSizes {
        /// The name of the generator.
        generator: String,
        /// Its size.
        size: usize,
        /// The size of the first.
        expected: usize,
    },
    /// A basis matrix is a combination of those before it.
    #[error(
        "basis matrix {generator} is a linear combination of those before it; leave it out or replace it"
    )]
    Dependent {
        /// The name of the generator.
        generator: String,
        /// Its index, from zero.
        index: usize,
    },
    /// A bracket leaves the span of the basis.
    #[error(
        "the bracket [{first}, {second}] is not a combination of the basis; add the matrices that close it"
    )]
    NotClosed {
        /// The name of the first generator.
        first: String,
        /// The name of the second generator.
        second: String,
        /// Their indices, from zero.
        indices: (usize, usize),
    },
    /// An index is at or beyond the dimension.
    #[error(
        "generator index {index} is out of range; there are {dimension} generators, counted from 0"
    )]
    OutOfRange {
        /// The index.
        index: usize,
        /// The dimension.
        dimension: usize,
    },
    /// The same bracket or structure constant is given twice with different values.
    #[error("the bracket [{first}, {second}] is given twice with different values; keep one")]
    Inconsistent {
        /// The name of the first generator.
        first: String,
        /// The name of the second generator.
        second: String,
        /// Their indices, from zero.
        indices: (usize, usize),
    },
    /// c_ij^k and c_ji^k do not add up to zero.
    #[error(
        "[{a}, {b}] and [{b}, {a}] must be opposite, but their components along {c} are {forward} and {backward} (i, j, k = {i}, {j}, {k})",
        a = .generators[0], b = .generators[1], c = .generators[2], i = .indices.0, j = .indices.1, k = .indices.2
    )]
    NotAntisymmetric {
        /// The names of the generators i, j and k.
        generators: Box<[String; 3]>,
        /// c_ij^k.
        forward: Box<Rational>,
        /// c_ji^k.
        backward: Box<Rational>,
        /// (i, j, k), from zero.
        indices: (usize, usize, usize),
    },
    /// The Jacobi identity fails.
    #[error(
        "the Jacobi identity fails for {a}, {b}, {c} (i, j, k = {i}, {j}, {k}): [[{a}, {b}], {c}] + cyclic has component {value} along {along}",
        a = .generators[0], b = .generators[1], c = .generators[2], i = .indices.0, j = .indices.1, k = .indices.2
    )]
    Jacobi {
        /// The names of the generators i, j and k.
        generators: Box<[String; 3]>,
        /// (i, j, k), from zero.
        indices: (usize, usize, usize),
        /// The generator along which the sum does not vanish.
        along: String,
        /// The component of the sum along it.
        value: Box<Rational>,
    },
}
