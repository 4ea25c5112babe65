//! Choosing the coefficients of S for accuracy along given motions: any S is as geometric as the series.

#[cfg(feature = "alloc")]
mod fit;
mod tail;
mod trial;

#[cfg(feature = "alloc")]
pub use fit::{Fit, FitError, MAX_FITTED_TERMS, fit};
pub use tail::Tail;
