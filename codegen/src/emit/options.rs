//! How emitted Rust looks from outside.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

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
    /// The suffix of the names that programs bind: an underscore where a constant of the user's might have one of these
    /// names.
    pub suffix: &'static str,
}

impl Options {
    /// The name of something that a program binds.
    pub(super) fn bound(&self, name: &str) -> Ident {
        quote::format_ident!("{name}{}", self.suffix)
    }

    /// Public, `::coadjoint`, named after the problem in camel case.
    #[must_use]
    pub fn for_problem(name: &str) -> Self {
        Self {
            krate: quote!(::coadjoint),
            visibility: quote!(pub),
            name: identifier(&camel_case(name)),
            attributes: TokenStream::new(),
            suffix: "",
        }
    }
}

/// The name as an identifier of Rust, with an underscore in place of what none has, and at the end of a keyword or of `T`,
/// which stands for the numbers.
#[must_use]
pub fn identifier(name: &str) -> Ident {
    let valid = |word: &str| syn::parse_str::<Ident>(word).is_ok();
    let allowed = |c: char| c.is_ascii_alphanumeric() || valid(&format!("a{c}"));
    let mut word: String = name.chars().map(|c| if allowed(c) { c } else { '_' }).collect();
    if !valid(&word) || ["T", "gen"].contains(&word.as_str()) {
        word.push('_');
    }
    if !valid(&word) {
        word.insert(0, 'n');
    }
    format_ident!("{word}")
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
