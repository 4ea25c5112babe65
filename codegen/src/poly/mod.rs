//! Sparse multivariate polynomials over ℚ, fast in unoptimised builds too.

mod accumulate;
mod calculus;
mod monomial;
mod plan;
mod polynomial;
mod product;
mod table;

pub(crate) use monomial::{Factors, split_at};
pub use polynomial::Polynomial;
pub(crate) use product::{Product, SumError, sum_of_products};
