//! coadjoint in a web page: a system as text fields becomes steps, pictures, formulas, and a system file to copy.
//!
//! Everything but [`bindings`] runs and is tested on any machine; `build` puts the page together into one HTML file.

#![allow(missing_docs, reason = "a program of one page; nothing is published")]

pub mod bindings;
pub mod fields;
pub mod file;
pub mod formula;
pub mod gallery;
pub mod history;
pub mod orbit;
pub mod rival;
pub mod run;
pub mod system;
