//! A whole module as formatted text: for build scripts, the command line, and checking in.

use quote::format_ident;

use super::layout::text;
use super::options::Options;
use super::{header, legend, tokens};
use crate::integrator::{Integrator, Kick};

/// The integrator as a Rust source file: a header that says where it comes from and how to read it,
/// then the items, tables last, and what the coefficients mean.
#[must_use]
pub fn file(integrator: &Integrator, options: &Options) -> String {
    let mut result = comment(header::file_lines(integrator));
    result.push('\n');
    result.push_str(&text(tokens(integrator, options)));
    let legend = legend::lines(&integrator.coefficients);
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

/// Lines as comments.
fn comment(lines: impl IntoIterator<Item = String>) -> String {
    let comment = |line: String| match line.is_empty() {
        true => "//\n".to_owned(),
        false => format!("// {line}\n"),
    };
    lines.into_iter().map(comment).collect()
}
