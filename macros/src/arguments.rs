//! `crate = path`, the argument of both attributes that says where the runtime is.

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens;

/// The path of the runtime crate, as far as the user says, and the other arguments.
#[derive(Default)]
pub(crate) struct Arguments {
    /// The path after `crate =`.
    pub krate: Option<TokenStream>,
    /// The other arguments as they are.
    pub others: TokenStream,
}

/// Takes `crate = path` out of the arguments of an attribute.
///
/// # Errors
/// If it is there twice, or what stands after the equals sign is no path.
pub(crate) fn split(tokens: TokenStream) -> syn::Result<Arguments> {
    let mut krate = None;
    let mut others: Vec<TokenTree> = Vec::new();
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for entry in tokens.split_inclusive(|token| is_punct(token, ',')) {
        match entry {
            [TokenTree::Ident(key), equals, ..] if key == "crate" && is_punct(equals, '=') => {
                let path = entry[2..].iter().filter(|token| !is_punct(token, ','));
                let path = path_of(key.span(), path.cloned().collect())?;
                if krate.replace(path).is_some() {
                    return Err(syn::Error::new(key.span(), "`crate` is given twice"));
                }
            }
            _ => others.extend_from_slice(entry),
        }
    }
    Ok(Arguments { krate, others: others.into_iter().collect() })
}

fn is_punct(token: &TokenTree, character: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == character)
}

/// A path, also where it is written as a text.
fn path_of(key: Span, tokens: TokenStream) -> syn::Result<TokenStream> {
    let help = "write the path of the runtime crate, for example crate = my::coadjoint";
    let path = match syn::parse2::<syn::LitStr>(tokens.clone()) {
        Ok(text) => text.parse_with(syn::Path::parse_mod_style),
        Err(_) => syn::parse::Parser::parse2(syn::Path::parse_mod_style, tokens.clone()),
    };
    let place = if tokens.is_empty() {
        syn::Error::new(key, help)
    } else {
        syn::Error::new_spanned(tokens, help)
    };
    path.map(|path| path.to_token_stream()).map_err(|_| place)
}
