//! Formulas as MathML.

use pulldown_cmark::{Event, Options, Parser};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Storage, push_mathml};

/// A formula that is no LaTeX.
#[derive(Debug, thiserror::Error)]
#[error("line {line}: the formula `{formula}` cannot be read: {reason}")]
pub struct FormulaError {
    /// The line of the page, counted from 1.
    pub line: usize,
    /// The formula as written.
    pub formula: String,
    /// The error of the LaTeX parser.
    pub reason: String,
}

/// The page with each formula replaced by its MathML.
///
/// ```
/// let page = coadjoint_book::with_formulas("The order $K + 1$ is even, not `$K$`.")?;
/// assert!(page.starts_with("The order <math") && page.ends_with("</math> is even, not `$K$`."));
/// # Ok::<(), coadjoint_book::FormulaError>(())
/// ```
///
/// # Errors
/// The first formula that cannot be read, with its line.
pub fn with_formulas(page: &str) -> Result<String, FormulaError> {
    let options = Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES;
    let mut written = String::with_capacity(page.len());
    let mut done = 0;
    for (event, place) in Parser::new_ext(page, options).into_offset_iter() {
        let (formula, display_mode) = match &event {
            Event::InlineMath(formula) => (formula, DisplayMode::Inline),
            Event::DisplayMath(formula) => (formula, DisplayMode::Block),
            _ => continue,
        };
        let mathml = mathml(formula, display_mode).map_err(|reason| FormulaError {
            line: page[..place.start].matches('\n').count() + 1,
            formula: formula.to_string(),
            reason,
        })?;
        written.push_str(&page[done..place.start]);
        done = place.end;
        // A comma after a formula stays on its line.
        match page[done..].chars().next().filter(|next| ",.;:)".contains(*next)) {
            Some(next) if display_mode == DisplayMode::Inline => {
                written.push_str(&format!("<span class=\"formula\">{mathml}{next}</span>"));
                done += next.len_utf8();
            }
            _ => written.push_str(&mathml),
        }
    }
    written.push_str(&page[done..]);
    Ok(written)
}

/// A formula as one line of MathML that Markdown takes as it is.
fn mathml(formula: &str, display_mode: DisplayMode) -> Result<String, String> {
    let storage = Storage::new();
    let parser = pulldown_latex::Parser::new(formula, &storage);
    let events: Vec<_> = parser.collect();
    if let Some(Err(error)) = events.iter().find(|event| event.is_err()) {
        return Err(error.to_string());
    }
    let mut mathml = String::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    push_mathml(&mut mathml, events.into_iter(), config).map_err(|error| error.to_string())?;
    Ok(guarded(&mathml))
}

/// Without line breaks, and with entities for what Markdown would read as its own between tags.
fn guarded(mathml: &str) -> String {
    // The renderer leaves "less than" as it is, and takes the micro sign for the Greek letter, which is then upright.
    let mathml = mathml.replace("><</", ">&lt;</").replace('\u{b5}', "\u{3bc}");
    let mut guarded = String::with_capacity(mathml.len());
    let mut in_tag = false;
    for character in mathml.chars() {
        match character {
            '<' => in_tag = true,
            '>' => in_tag = false,
            _ => {}
        }
        match character {
            '\n' => guarded.push(' '),
            '*' | '_' | '[' | ']' | '|' | '`' | '~' | '\\' | '$' if !in_tag => {
                guarded.push_str(&format!("&#{};", u32::from(character)));
            }
            _ => guarded.push(character),
        }
    }
    guarded
}
