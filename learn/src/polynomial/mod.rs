//! Polynomial models: the fit of gradients is linear least squares.

mod fit;
mod model;

pub use fit::{Candidate, Selection, fit_gradients, fit_polynomial, select_polynomial};
pub(crate) use fit::{folds, gradient_error, split};
pub use model::{Basis, PolynomialModel, Scaling};
