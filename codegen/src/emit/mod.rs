//! Writing an integrator as Rust, or as a header of C ([`c`]).
//!
//! One struct holding the folded coefficients, its constructor, and the implementation of
//! `coadjoint::GeneratingFunction`. Everything is generic over the scalar, allocates nothing, and
//! names the runtime by absolute path.

pub mod c;
mod collocation;
mod file;
mod generating_function;
mod group;
mod header;
mod item;
mod kick;
mod origin;
mod parameter;
mod program;
mod programs;
mod steps;
mod table;

use std::collections::BTreeSet;

use coadjoint_program::print::{Value, fill};
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};

use crate::integrator::Integrator;

pub use file::{file, potential_items};
pub use group::RUNTIME_TABLES;
pub use item::{Items, items};
pub use kick::kick;
pub use origin::items_of;

/// Options of the emitted Rust.
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
    /// The suffix of the names that patterns bind: an underscore where a constant of the user's might have one of these
    /// names. A pattern that is a plain name means a constant where one of that name is in scope, and no span changes that.
    pub suffix: &'static str,
}

impl Options {
    /// The name of something that a program binds.
    pub(super) fn bound(&self, name: &str) -> String {
        format!("{name}{}", self.suffix)
    }

    /// A template with these values, and the suffix of bound names in place of `@`.
    fn fill(&self, template: &str, values: &[Value]) -> String {
        fill(&template.replace('@', self.suffix), values)
    }

    /// A text of Rust as tokens, the user's own in place of `__krate`, `__visibility`, `__name` and `__attributes`.
    fn tokens(&self, text: &str) -> TokenStream {
        // The texts written here are tokens; if not, the compiler shows the mistake.
        let own = text.parse().map(|tokens| self.own(tokens));
        own.unwrap_or_else(|_| quote!(::core::compile_error!(#text);))
    }

    fn own(&self, tokens: TokenStream) -> TokenStream {
        let own = |tree| match tree {
            TokenTree::Ident(word) => match word.to_string().as_str() {
                "__krate" => self.krate.clone(),
                "__visibility" => self.visibility.clone(),
                "__name" => self.name.to_token_stream(),
                "__attributes" => self.attributes.clone(),
                _ => word.into_token_stream(),
            },
            TokenTree::Group(group) => {
                Group::new(group.delimiter(), self.own(group.stream())).into_token_stream()
            }
            other => other.into(),
        };
        tokens.into_iter().flat_map(own).collect()
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
pub(crate) fn identifier(name: &str) -> Ident {
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

/// `name`, with as many underscores at its end as make it differ from all of `taken`.
fn fresh(name: &str, taken: &BTreeSet<String>) -> String {
    let mut name = name.to_owned();
    while taken.contains(&name) {
        name.push('_');
    }
    name
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

/// The most terms of S that are emitted as Rust: about 280 spins of a Heisenberg ring at K = 3. The
/// module of 256 spins (17 920 terms, 14.5 MB) took rustc a good minute of processor time in release
/// and 1 GB; that of 128 spins 45 s and 0.6 GB.
pub const MOST_TERMS: usize = 20_000;
/// The most terms that the coefficients of S have as polynomials in the parameters. They are data: one table, read when an
/// integrator is constructed.
pub(crate) const MOST_DATA: usize = 200_000;

/// A generating function with too many terms to emit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "too large to emit: S has {terms} terms, more than the limit of {limit}; {}lower the truncation, \
     or run it in the interpreter with `coadjoint simulate`",
    literals(*.with_literals)
)]
pub struct TooManyTerms {
    /// The terms of S₁ + … + S_K, or those of their coefficients.
    pub terms: usize,
    /// The terms that are left with numbers in place of the parameters, where these make it too large.
    pub with_literals: Option<usize>,
    /// [`MOST_TERMS`], or the limit of what is data.
    pub limit: usize,
}

fn literals(terms: Option<usize>) -> String {
    terms.map_or_else(String::new, |terms| {
        format!(
            "with numbers in place of the parameters it has at most {terms}: write literals; or "
        )
    })
}

/// Checks that an integrator is small enough for [`items`]; larger ones are written, but take the compiler very long.
///
/// # Errors
/// Returns [`TooManyTerms`] above the limit.
pub fn check_size(integrator: &Integrator) -> Result<(), TooManyTerms> {
    let terms = integrator.terms();
    // Of symbols the code knows nothing: it has one term to a monomial in the momenta.
    let parameters = !integrator.problem.symbols.is_empty();
    let code = if parameters { integrator.coefficients.series() } else { terms };
    if code > MOST_TERMS {
        return Err(TooManyTerms { terms: code, with_literals: None, limit: MOST_TERMS });
    }
    if terms > MOST_DATA {
        return Err(TooManyTerms { terms, with_literals: Some(code), limit: MOST_DATA });
    }
    Ok(())
}
