//! A whole module as formatted text: for build scripts, the command line, and checking in.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::Options;
use crate::emit::header::comment;
use crate::emit::item::Items;
use crate::integrator::Kick;

/// Columns of a comment.
const WIDTH: usize = 97;

/// Items as a Rust source file: their opening, which says where they come from and how to read them, the items, tables last,
/// and the legend of their coefficients.
#[must_use]
pub fn file(items: Items) -> String {
    let Items { opening, struct_and_methods, programs, legend } = items;
    let mut result = comment(&opening, WIDTH, "//");
    result.push('\n');
    result.push_str(&text(quote!(#struct_and_methods #programs)));
    if !legend.is_empty() {
        result.push('\n');
        result.push_str(&comment(&legend, usize::MAX, "//"));
    }
    result
}

/// The potential of a system, to stand after the integrator `options` was used for: the same name
/// with `Potential` after it.
#[must_use]
pub fn potential_items(kick: &Kick, options: &Options) -> String {
    let name = format_ident!("{}Potential", options.name);
    format!("\n{}", text(super::kick(kick, &Options { name, ..options.clone() })))
}

/// The longest line of a table, in bytes.
const LONGEST_ROW: usize = 100;

pub(crate) fn text(tokens: TokenStream) -> String {
    match syn::parse2(tokens.clone()) {
        Ok(items) => arranged(&prettyplease::unparse(&items)),
        // Emitted tokens are items by construction; if not, unformatted text still compiles or
        // shows the compiler what is wrong.
        Err(_) => tokens.to_string(),
    }
}

/// Text with an empty line after every item that ends in a brace, but for the last of its block, and with as many entries of
/// a table to a line as it holds.
fn arranged(text: &str) -> String {
    const STARTS: [&str; 8] = ["///", "#[", "impl", "fn ", "pub ", "static ", "type ", "const "];
    let mut result = String::with_capacity(text.len());
    // The line that is written, and the width of its indentation.
    let (mut from, mut indent) = (0, 0);
    for line in text.lines() {
        let (row, start) = (&result[from..], line.trim_start());
        let same = line.len() - start.len() == indent;
        if same && row.len() + start.len() < LONGEST_ROW && is_entry(row) && is_entry(line) {
            result.push(' ');
            result.push_str(start);
            continue;
        }
        let after_item = matches!(row.trim_start(), "}" | "};");
        if after_item && STARTS.iter().any(|first| start.starts_with(first)) {
            result.push('\n');
        }
        if !result.is_empty() {
            result.push('\n');
        }
        (from, indent) = (result.len(), line.len() - start.len());
        result.push_str(line);
    }
    result.push('\n');
    result
}

/// True for a line of entries of a table: tuples or slices of numbers, each with a comma.
fn is_entry(line: &str) -> bool {
    let line = line.trim();
    (line.starts_with('(') || line.starts_with("&["))
        && line.ends_with("),") | line.ends_with("],")
        && line.chars().all(|c| c.is_ascii_digit() || "()[]&,.-+eE ".contains(c))
}
