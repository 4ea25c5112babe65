//! Systems of ordinary differential equations of fixed size.

use crate::number::Number;

/// ẏ = f(y) in N components.
pub trait VectorField<const N: usize>: Copy {
    /// f(y), for one state or for several side by side.
    fn evaluate<T: Number>(&self, y: &[T; N]) -> [T; N];
}
