//! The runtime type of a problem's group.

use proc_macro2::TokenStream;
use quote::quote;

use crate::problem::Problem;

/// How generated code names the group.
pub struct GroupType {
    /// The type, generic over the scalar `T` in scope.
    pub ty: TokenStream,
    /// An expression for a reference to its value.
    pub value: TokenStream,
    /// Items it needs.
    pub definition: TokenStream,
}

/// The runtime type for `problem.algebra`.
#[must_use]
pub fn group_type(problem: &Problem, krate: &TokenStream) -> GroupType {
    let name = quote::format_ident!("{}", problem.algebra.name());
    let ty = quote!(#krate::#name<T>);
    GroupType {
        value: quote!(const { &<#krate::#name<T>>::new() }),
        ty,
        definition: TokenStream::new(),
    }
}
