//! Systems of ordinary differential equations of fixed size.

/// ẏ = f(y) in N components.
pub trait VectorField<const N: usize>: Copy {
    /// f(y).
    fn evaluate(&self, y: &[f64; N]) -> [f64; N];
}
