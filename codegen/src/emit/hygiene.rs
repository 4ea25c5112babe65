//! Names that nothing in the user's scope can take over.
//!
//! A pattern that is a plain name means a constant where one of that name is in scope, and no span
//! changes that. So where items are put into a scope of the user's, the names they bind get an
//! underscore at their ends: `step_`, or more where the user has that name, too. Names that the user
//! binds in the same scope stay, for there they would not compile with such a constant either.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::ToTokens;
use syn::visit::Visit;
use syn::visit_mut::VisitMut;
use syn::{Expr, ExprPath, FieldValue, Member, PatIdent};

/// The items in `tokens` with other names for what they bind, none of which is in `taken`; names in
/// `kept` stay as they are.
#[must_use]
pub fn hygienic(
    tokens: TokenStream,
    kept: &BTreeSet<String>,
    taken: &BTreeSet<String>,
) -> TokenStream {
    let Ok(mut file) = syn::parse2::<syn::File>(tokens.clone()) else {
        // The compiler shows what is wrong with it.
        return tokens;
    };
    let mut bound = Bound::default();
    bound.visit_file(&file);
    let mut used: BTreeSet<String> = taken.union(&bound.0).cloned().collect();
    let mut names = BTreeMap::new();
    for name in bound.0.difference(kept) {
        let new = fresh(&format!("{name}_"), &used);
        used.insert(new.clone());
        names.insert(name.clone(), new);
    }
    Rename(names).visit_file_mut(&mut file);
    file.into_token_stream()
}

/// `name`, with as many underscores at its end as make it differ from all of `taken`.
pub(crate) fn fresh(name: &str, taken: &BTreeSet<String>) -> String {
    let mut name = name.to_owned();
    while taken.contains(&name) {
        name.push('_');
    }
    name
}

/// All identifiers in `tokens`.
#[must_use]
pub fn identifiers(tokens: TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for token in tokens {
        match token {
            TokenTree::Ident(ident) => {
                found.insert(ident.to_string());
            }
            TokenTree::Group(group) => found.extend(identifiers(group.stream())),
            _ => {}
        }
    }
    found
}

/// The names that patterns bind.
#[derive(Default)]
struct Bound(BTreeSet<String>);

impl Visit<'_> for Bound {
    fn visit_pat_ident(&mut self, pattern: &PatIdent) {
        self.0.insert(pattern.ident.to_string());
        syn::visit::visit_pat_ident(self, pattern);
    }
}

/// Gives names that patterns bind other names, there and where they are read.
struct Rename(BTreeMap<String, String>);

impl Rename {
    fn rename(&self, ident: &mut Ident) {
        if let Some(new) = self.0.get(&ident.to_string()) {
            *ident = Ident::new(new, ident.span());
        }
    }
}

impl VisitMut for Rename {
    fn visit_pat_ident_mut(&mut self, pattern: &mut PatIdent) {
        self.rename(&mut pattern.ident);
        syn::visit_mut::visit_pat_ident_mut(self, pattern);
    }

    fn visit_expr_path_mut(&mut self, path: &mut ExprPath) {
        let plain = path.qself.is_none() && path.path.leading_colon.is_none();
        if plain
            && path.path.segments.len() == 1
            && let Some(segment) = path.path.segments.first_mut()
            && segment.arguments.is_none()
        {
            self.rename(&mut segment.ident);
        }
        syn::visit_mut::visit_expr_path_mut(self, path);
    }

    fn visit_field_value_mut(&mut self, field: &mut FieldValue) {
        // `Self { step }`: the field keeps its name.
        if field.colon_token.is_none()
            && let (Member::Named(name), Expr::Path(_)) = (&field.member, &field.expr)
            && self.0.contains_key(&name.to_string())
        {
            field.colon_token = Some(<syn::Token![:]>::default());
        }
        syn::visit_mut::visit_field_value_mut(self, field);
    }
}
