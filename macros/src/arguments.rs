//! `crate = path`, the argument of both attributes that says where the runtime is.

use std::collections::BTreeMap;

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens;

/// The path of the runtime crate, as far as the user says, and the other arguments.
#[derive(Default)]
pub(crate) struct Meta {
    /// The path after `crate =`.
    pub krate: Option<TokenStream>,
    /// The other arguments as they are.
    pub others: TokenStream,
}

/// Takes `crate = path` out of the arguments of an attribute.
///
/// # Errors
/// If it is there twice, or what stands after the equals sign is no path.
pub(crate) fn split(tokens: TokenStream) -> syn::Result<Meta> {
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
    Ok(Meta { krate, others: others.into_iter().collect() })
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

/// The correction where the crate being compiled has no dependency called `coadjoint`; `None`
/// where it has one, or where nothing is known about its dependencies.
pub(crate) fn help_without_runtime() -> Option<String> {
    advice(std::env::args())
}

/// As [`help`], for the arguments that the compiler was called with.
fn advice(arguments: impl Iterator<Item = String>) -> Option<String> {
    let mut externs: BTreeMap<String, String> = BTreeMap::new();
    let mut arguments = arguments.peekable();
    while let Some(argument) = arguments.next() {
        // Arguments in a file are not looked up.
        if argument.starts_with('@') {
            return None;
        }
        if argument == "--crate-name" && arguments.peek().is_some_and(|name| name == "coadjoint") {
            return None;
        }
        let value = match argument.strip_prefix("--extern") {
            Some("") => arguments.next().unwrap_or_default(),
            Some(value) => value.trim_start_matches('=').to_owned(),
            None => continue,
        };
        let (name, file) = value.split_once('=').unwrap_or((&value, ""));
        // `priv:name`, `noprelude:name`.
        let name = name.rsplit(':').next().unwrap_or(name);
        externs.insert(name.to_owned(), file.to_owned());
    }
    if externs.is_empty() || externs.contains_key("coadjoint") {
        return None;
    }
    let is_runtime = |file: &String| {
        let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
        name.starts_with("libcoadjoint-") || name.starts_with("libcoadjoint.")
    };
    let renamed = externs.iter().find(|(_, file)| is_runtime(file)).map(|(name, _)| name);
    let path = renamed.map_or_else(|| "path::to::coadjoint".to_owned(), |name| format!("::{name}"));
    Some(format!(
        "this crate has no dependency called `coadjoint`: say where the runtime is, `crate = {path}`, \
         among the arguments of this attribute"
    ))
}

#[cfg(test)]
mod tests {
    use super::advice;

    fn of(arguments: &[&str]) -> Option<String> {
        advice(arguments.iter().map(|&argument| argument.to_owned()))
    }

    #[test]
    fn a_renamed_dependency_is_found_by_its_file() {
        let help =
            of(&["rustc", "--extern", "lie=/target/libcoadjoint-0a1b.rmeta"]).unwrap_or_default();
        assert!(help.contains("crate = ::lie`"), "{help}");
        let help = of(&["rustc", "--extern=mine=/target/libmine-0a1b.rmeta"]).unwrap_or_default();
        assert!(help.contains("crate = path::to::coadjoint"), "{help}");
    }

    #[test]
    fn nothing_is_said_where_nothing_is_wrong_or_known() {
        assert_eq!(of(&["rustc", "--extern", "coadjoint=/target/libcoadjoint-0a1b.rmeta"]), None);
        assert_eq!(of(&["rustc", "--extern", "priv:coadjoint=/x/libcoadjoint-1.rmeta"]), None);
        assert_eq!(of(&["rustc", "--crate-name", "coadjoint", "--extern", "a=/x/liba.so"]), None);
        assert_eq!(of(&["rustc", "@arguments"]), None);
        assert_eq!(of(&["rust-analyzer-proc-macro-srv"]), None);
    }
}
