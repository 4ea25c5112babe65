//! The functions that graphs remember by name: they have rules for their derivatives.

/// A function of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// The exponential.
    Exp,
    /// The natural logarithm; of positive numbers.
    Ln,
    /// The sine, of an angle in radians up to 10⁸.
    Sin,
    /// The cosine, of an angle in radians up to 10⁸.
    Cos,
    /// The tangent, of an angle in radians up to 10⁸.
    Tan,
    /// The inverse of the tangent.
    Atan,
    /// The hyperbolic tangent.
    Tanh,
    /// a to the power m/n, for n from 1; of numbers from 0 where n is not 1.
    Power(i32, u32),
}
