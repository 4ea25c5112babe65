//! coadjoint in a web page: a system as text fields becomes steps, pictures, formulas, and programs to copy.
//!
//! Everything but [`bindings`] runs and is tested on any machine; `build` puts the page together into one HTML file.

pub mod bindings;
pub mod fields;
pub mod file;
pub mod formula;
pub mod gallery;
pub mod history;
pub mod mistakes;
pub mod orbit;
pub mod refusal;
pub mod rival;
pub mod run;
pub mod system;
pub mod texts;
