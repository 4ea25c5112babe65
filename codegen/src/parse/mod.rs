//! From what users write to expressions with places.

mod brackets;
mod decimal;
mod names;
pub mod rust;
mod sum;
pub mod text;
mod token;

pub use brackets::{Bracket, bracket};
pub use decimal::{NumberError, decimal, rational};
pub use names::{Name, Names};
pub use token::words;
