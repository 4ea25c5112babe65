//! Sparse multivariate polynomials over ℚ, fast in unoptimised builds too.

mod accumulate;
mod calculus;
mod monomial;
mod numeric;
mod plan;
mod polynomial;
mod product;
mod table;

pub(crate) use monomial::Factors;
pub use monomial::{Monomial, product as monomial_product, split_at};
pub use numeric::Numeric;
pub(crate) use plan::Product;
pub use polynomial::Polynomial;
pub(crate) use product::{SumError, sum_of_products};
