//! Sparse multivariate polynomials over ℚ, fast in unoptimised builds too.

mod calculus;
mod monomial;
mod polynomial;
mod product;
mod table;

pub use polynomial::Polynomial;
pub(crate) use product::{Product, sum_of_products};
