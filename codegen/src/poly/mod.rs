//! Sparse multivariate polynomials over ℚ.

mod polynomial;

pub use polynomial::Polynomial;
