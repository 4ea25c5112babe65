//! A whole module as formatted text: for build scripts, the command line, and checking in.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::Options;
use crate::emit::header::wrapped;
use crate::emit::item::Items;
use crate::integrator::Kick;

/// Columns of a comment.
const WIDTH: usize = 97;

/// Items as a Rust source file: their opening, which says where they come from and how to read them, the items, tables last,
/// and the legend of their coefficients.
#[must_use]
pub fn file(items: Items) -> String {
    let Items { opening, struct_and_methods, programs, legend } = items;
    let mut result = comment(opening.iter().flat_map(|paragraph| wrapped(paragraph, WIDTH)));
    result.push('\n');
    result.push_str(&text(quote!(#struct_and_methods #programs)));
    if !legend.is_empty() {
        let about = "The coefficients of S = Σ C(m) m that programs read, C(m) being that of the monomial m:";
        result.push('\n');
        result.push_str(&comment(std::iter::once(about.to_owned()).chain(legend)));
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

fn comment(lines: impl IntoIterator<Item = String>) -> String {
    let comment = |line: String| match line.is_empty() {
        true => "//\n".to_owned(),
        false => format!("// {line}\n"),
    };
    lines.into_iter().map(comment).collect()
}

/// The longest line of a table, in bytes.
const LONGEST_ROW: usize = 100;

pub(crate) fn text(tokens: TokenStream) -> String {
    match syn::parse2(tokens.clone()) {
        Ok(items) => spaced(&filled(&prettyplease::unparse(&items))),
        // Emitted tokens are items by construction; if not, unformatted text still compiles or
        // shows the compiler what is wrong.
        Err(_) => tokens.to_string(),
    }
}

/// An empty line after every item that ends in a brace, but for the last of its block.
fn spaced(text: &str) -> String {
    const STARTS: [&str; 8] = ["///", "#[", "impl", "fn ", "pub ", "static ", "type ", "const "];
    let mut result = String::with_capacity(text.len());
    let mut after_item = false;
    for line in text.lines() {
        let line_start = line.trim_start();
        if after_item && STARTS.iter().any(|start| line_start.starts_with(start)) {
            result.push('\n');
        }
        after_item = matches!(line_start, "}" | "};");
        result.push_str(line);
        result.push('\n');
    }
    result
}

/// Entries of tables, which stand one to a line, as many to a line as it holds.
fn filled(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut row = String::new();
    for line in text.lines() {
        let indent = line.len() - line.trim_start().len();
        let row_indent = row.len() - row.trim_start().len();
        let entry = is_entry(line);
        if entry
            && !row.is_empty()
            && indent == row_indent
            && row.len() + 1 + line[indent..].len() <= LONGEST_ROW
        {
            row.push(' ');
            row.push_str(&line[indent..]);
            continue;
        }
        if !row.is_empty() {
            result.push_str(&row);
            result.push('\n');
            row.clear();
        }
        if entry {
            row.push_str(line);
        } else {
            result.push_str(line);
            result.push('\n');
        }
    }
    result.push_str(&row);
    result
}

/// True for a line with one entry of a table: a tuple or a slice of numbers, and a comma.
fn is_entry(line: &str) -> bool {
    let line = line.trim();
    (line.starts_with('(') || line.starts_with("&["))
        && line.ends_with("),") | line.ends_with("],")
        && line.chars().all(|c| c.is_ascii_digit() || "()[]&,.-+eE ".contains(c))
}
