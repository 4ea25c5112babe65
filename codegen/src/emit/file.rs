//! A whole module as formatted text: for build scripts, the command line, and checking in.

use coadjoint_program::quoting::rust_comment;
use quote::{format_ident, quote};

use super::collocation::collocation;
use super::item::{Items, items};
use super::layout::text;
use super::legend;
use super::opening::wrapped;
use super::options::Options;
use crate::integrator::{Integrator, Kick};
use crate::smooth::Smooth;

/// Columns of a comment.
const WIDTH: usize = 97;

/// The integrator as a Rust source file: a header that says where it comes from and how to read it,
/// then the items, tables last, and what the coefficients mean.
#[must_use]
pub fn file(integrator: &Integrator, options: &Options) -> String {
    let mut result = module(items(integrator, options));
    let legend = legend::lines(&integrator.coefficients);
    if !legend.is_empty() {
        let about = "The coefficients of S = Σ C(m) m that programs read, C(m) being that of the monomial m:";
        result.push('\n');
        result.push_str(&comment(std::iter::once(about.to_owned()).chain(legend)));
    }
    result
}

/// The integrator of a Hamiltonian that is no polynomial as a Rust source file; its steps are made by collocation.
#[must_use]
pub fn collocation_file(smooth: &Smooth, options: &Options) -> String {
    let opening = format!(
        "Written by coadjoint-codegen from H = {}; do not edit. `{}` makes steps of order {} by collocation at {} nodes; \
         it needs the crate coadjoint.",
        rust_comment(&smooth.source),
        options.name,
        2 * smooth.nodes(),
        smooth.nodes()
    );
    module(Items { opening: vec![opening], ..collocation(smooth, options) })
}

/// Items as a source file.
fn module(items: Items) -> String {
    let Items { opening, struct_and_methods, programs } = items;
    let mut result = comment(opening.iter().flat_map(|paragraph| wrapped(paragraph, WIDTH)));
    result.push('\n');
    result.push_str(&text(quote!(#struct_and_methods #programs)));
    result
}

/// The potential of a system, to stand after the integrator `options` was used for: the same name
/// with `Potential` after it.
#[must_use]
pub fn potential_items(kick: &Kick, options: &Options) -> String {
    let name = format_ident!("{}Potential", options.name);
    format!("\n{}", text(super::kick(kick, &Options { name, ..options.clone() })))
}

/// Lines as comments.
fn comment(lines: impl IntoIterator<Item = String>) -> String {
    let comment = |line: String| match line.is_empty() {
        true => "//\n".to_owned(),
        false => format!("// {line}\n"),
    };
    lines.into_iter().map(comment).collect()
}
