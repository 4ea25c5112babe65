//! Sparse multivariate polynomials over ℚ, fast in unoptimised builds too.

mod calculus;
mod polynomial;
mod product;
mod products;

pub(crate) use polynomial::Factors;
pub use polynomial::{Numeric, Polynomial, product as monomial_product, split_at};
pub(crate) use product::{Arithmetic, Multiplication, SumError, sum_of_products};
pub(crate) use products::Products;
