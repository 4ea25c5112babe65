//! How emitted Rust looks from outside.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// How the Rust is to look from outside.
#[derive(Clone, Debug)]
pub struct Options {
    /// The path of the runtime crate, `::coadjoint` unless renamed.
    pub krate: TokenStream,
    /// The visibility of the struct.
    pub visibility: TokenStream,
    /// The struct's name.
    pub name: Ident,
    /// Attributes for the struct: the user's doc comments.
    pub attributes: TokenStream,
}

impl Options {
    /// Public, `::coadjoint`, named after the problem in camel case.
    #[must_use]
    pub fn for_problem(name: &str) -> Self {
        Self {
            krate: quote!(::coadjoint),
            visibility: quote!(pub),
            name: Ident::new(&camel_case(name), Span::call_site()),
            attributes: TokenStream::new(),
        }
    }
}

/// `rigid_body` and `rigid-body` as `RigidBody`.
#[must_use]
pub fn camel_case(name: &str) -> String {
    let mut result = String::new();
    for word in name.split(|c: char| !c.is_alphanumeric()) {
        let mut letters = word.chars();
        if let Some(first) = letters.next() {
            result.extend(first.to_uppercase());
            result.push_str(letters.as_str());
        }
    }
    match result.chars().next() {
        Some(first) if first.is_alphabetic() => result,
        _ => format!("System{result}"),
    }
}
