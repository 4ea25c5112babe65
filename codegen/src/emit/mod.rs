//! Writing an integrator as Rust, or as a header of C ([`c`]).
//!
//! One struct holding the folded coefficients, its constructor, and the implementation of
//! `coadjoint::GeneratingFunction`. Everything is generic over the scalar, allocates nothing, and
//! names the runtime by absolute path.

pub mod c;
mod collocation;
mod constructor;
mod file;
mod generating_function;
mod group;
mod header;
mod hygiene;
mod item;
mod kick;
mod layout;
mod legend;
mod limit;
mod number;
mod opening;
mod options;
mod parameter;
mod program;
mod programs;
mod steps;
mod subscript;
mod table;
mod types;

pub use collocation::collocation;
pub use file::{collocation_file, file, potential_items};
pub use group::RUNTIME_TABLES;
pub use hygiene::{fresh, hygienic, identifiers};
pub use item::{Items, items, tokens};
pub use kick::kick;
pub use limit::{MOST_TERMS, TooManyTerms, check_size};
pub use options::{Options, camel_case, identifier};

use proc_macro2::TokenStream;
use quote::quote;

/// Lints that emitted code turns off, since it follows no style.
fn allow() -> TokenStream {
    quote! {
        #[allow(
            clippy::all, clippy::pedantic, clippy::nursery, dead_code, non_snake_case,
            unexpected_cfgs, unused_assignments, unused_doc_comments, unused_imports, unused_mut,
            unused_variables
        )]
    }
}
