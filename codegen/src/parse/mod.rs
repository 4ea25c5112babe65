//! Parses the input of users into expressions with places.

mod brackets;
mod composite;
mod decimal;
mod names;
pub mod rust;
mod sum;
pub(crate) mod text;
mod token;
mod vectors;

pub(crate) use brackets::bracket;
pub use decimal::rational;
pub(crate) use decimal::{decimal, fraction, rows};
#[cfg(feature = "system")]
pub(crate) use names::Name;
pub(crate) use names::Names;
#[cfg(feature = "system")]
pub(crate) use token::words;
#[cfg(feature = "system")]
pub(crate) use vectors::components;
