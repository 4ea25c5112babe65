//! Polynomial models: the fit of gradients is linear least squares.

mod basis;
mod fit;
mod model;
mod select;

pub use basis::{Basis, Scaling};
pub use fit::{fit_gradients, fit_polynomial};
pub use model::PolynomialModel;
pub use select::{Candidate, Selection, select_polynomial};
pub(crate) use select::{folds, gradient_error, split};
