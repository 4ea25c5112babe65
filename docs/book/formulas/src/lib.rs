//! A preprocessor of mdBook for the manual.
//!
//! A formula stands in the Markdown source between dollar signs, `$…$` in a line and `$$…$$` on its own, in LaTeX. It becomes
//! MathML, which browsers set without scripts and without a network. What is in code is left alone.
//!
//! Links that leave the book's folder are right where the source is read, in the repository. The book itself is read
//! elsewhere too: there such a link becomes the path of the file, and such a picture becomes part of the page.

mod formulas;
mod outside;

pub use formulas::{FormulaError, with_formulas};
pub use outside::without_outside;
