//! Sparse multivariate polynomials over ℚ, fast in unoptimised builds too.

mod calculus;
mod monomial;
mod polynomial;
mod product;

pub(crate) use monomial::Factors;
pub use monomial::{Monomial, product as monomial_product, split_at};
pub use polynomial::{Numeric, Polynomial};
pub(crate) use product::{Product, SumError, sum_of_products};
