//! From what users write to expressions with places.

mod brackets;
mod decimal;
mod names;
pub mod rust;
mod sum;
pub mod text;
mod token;

pub(crate) use brackets::bracket;
pub use decimal::rational;
pub(crate) use decimal::{decimal, fraction, rows};
pub use names::{Name, Names};
pub use token::words;
