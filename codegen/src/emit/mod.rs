//! Writing an integrator as Rust.
//!
//! One struct holding the folded coefficients, its constructor, and the implementation of
//! `coadjoint::GeneratingFunction`. Everything is generic over the scalar, allocates nothing, and
//! names the runtime by absolute path.

mod body;
mod constructor;
mod file;
mod generating_function;
mod group;
mod header;
mod item;
mod kick;
mod limit;
mod number;
mod parameter;
mod parts;
mod table;

pub use file::{file, potential_items};
pub use item::{Options, camel_case, tokens};
pub use kick::kick;
pub use limit::{MOST_TERMS, TooManyTerms, check_size};
