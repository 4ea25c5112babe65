//! The page: sections, tables, verdicts.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use coadjoint_draw::{STYLE_SHEET, escaped, run::Picture};
use coadjoint_learn::experiment::{Cell, Judgement, Table};

use crate::gallery;
use crate::prose::{number, prose};
use crate::rules::RULES;
use crate::section::Section;

/// The size of a panel.
const SIZE: (f64, f64) = (440.0, 230.0);
/// The width of a panel where three are side by side.
const NARROW: f64 = 400.0;

/// The page.
pub fn page(
    sections: &[Section],
    gallery: &[Picture],
    quick: bool,
    seeds: &BTreeSet<u64>,
) -> String {
    let mut text = String::new();
    let judged: Vec<&Judgement> = sections.iter().flat_map(|section| &section.judgements).collect();
    let kept = gallery.iter().filter(|picture| gallery::worst(picture) <= gallery::BOUND).count();
    let (held, all) =
        (judged.iter().filter(|j| j.holds()).count() + kept, judged.len() + gallery.len());
    let seeds: Vec<String> = seeds.iter().map(u64::to_string).collect();
    let version = if quick {
        "This is the quick version: fewer samples and steps, networks 64-64."
    } else {
        "Networks have the paper’s width and budget."
    };
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Symmetry Preservation in Hamiltonian Systems, reproduced</title>\n\
         <style>\n{STYLE_SHEET}{RULES}</style>\n</head>\n<body>\n<header>\n\
         <h1>Symmetry Preservation in Hamiltonian Systems: Simulation and Learning, reproduced</h1>\n\
         <p>Every figure and table of the paper by M. Vaquero, J. Cortés and D. Martín de Diego, with what came out \
         beside it and the number that judges it; then comparisons of our own, and a gallery. {version} \
         Seed {}: the same seed gives the same page.</p>\n\
         <p><span class=\"mark{}\">{held} of {all}</span> numbers are what they must be.</p>\n",
        if seeds.is_empty() { "–".to_owned() } else { seeds.join(", ") },
        if held == all { "" } else { " fails" },
    );
    contents(&mut text, sections, gallery);
    text.push_str("</header>\n<main>\n");
    for of_paper in [true, false] {
        let mut own = sections.iter().filter(|section| section.of_paper == of_paper).peekable();
        if own.peek().is_some() {
            let title = if of_paper { "The paper" } else { "Beyond the paper" };
            let _ = writeln!(text, "<h2>{title}</h2>");
        }
        own.for_each(|own| section(&mut text, own));
    }
    if !gallery.is_empty() {
        let _ = writeln!(
            text,
            "<h2 id=\"gallery\">Gallery</h2>\n<p>Every system of the examples, run as its file says: the orbit of the \
             body momentum, the momentum over time, and what drifts. A mark says whether spatial momentum and \
             Casimirs, which every step conserves whatever S is, stay within {}. Energy is conserved as well as K \
             and h make it.</p>",
            number(&format!("{:.0e}", gallery::BOUND))
        );
        gallery.iter().for_each(|picture| text.push_str(&gallery::exhibit(picture)));
    }
    text.push_str("<footer>Made by <code>coadjoint reproduce</code>. One file, no network.</footer>\n</main>\n</body>\n</html>\n");
    text
}

fn contents(text: &mut String, sections: &[Section], gallery: &[Picture]) {
    text.push_str("<nav aria-label=\"Contents\">\n<ol>\n");
    for section in sections {
        let mark =
            if section.judgements.is_empty() { String::new() } else { verdict(section.holds()) };
        let title = escaped(&section.title);
        let _ = writeln!(text, "<li><a href=\"#{}\">{title}</a> {mark}</li>", section.id);
    }
    if !gallery.is_empty() {
        let _ = writeln!(
            text,
            "<li><a href=\"#gallery\">Gallery of {} systems</a></li>",
            gallery.len()
        );
    }
    text.push_str("</ol>\n</nav>\n");
}

/// A mark: does it hold?
pub fn verdict(holds: bool) -> String {
    let (class, word) = if holds { ("", "pass") } else { (" fails", "FAIL") };
    format!("<span class=\"mark{class}\">{word}</span>")
}

/// Settings in a line.
pub fn settings(settings: &[String]) -> String {
    let spans: Vec<String> =
        settings.iter().map(|setting| format!("<span>{}</span>", escaped(setting))).collect();
    format!("<p class=\"settings\">{}</p>", spans.join(" · "))
}

fn section(text: &mut String, section: &Section) {
    let _ = writeln!(
        text,
        "<section>\n<h3 id=\"{}\">{}</h3>\n{}\n<dl>",
        section.id,
        escaped(&section.title),
        settings(&section.settings)
    );
    let shows = if section.of_paper { "The paper" } else { "Why" };
    let lines =
        [(shows, &section.shows), ("Silent on", &section.silent), ("What came out", &section.out)];
    for (name, line) in lines.into_iter().filter(|(_, line)| !line.is_empty()) {
        let _ = writeln!(text, "<dt>{name}</dt><dd>{}</dd>", prose(line));
    }
    text.push_str("</dl>\n");
    if !section.judgements.is_empty() {
        text.push_str("<ul class=\"verdicts\">\n");
        for judgement in &section.judgements {
            let class = if judgement.holds() { "" } else { " class=\"fails\"" };
            let _ = writeln!(
                text,
                "<li{class}>{} {}: <span class=\"number\">{}</span>, {}</li>",
                verdict(judgement.holds()),
                prose(&judgement.what),
                cell(&judgement.value),
                prose(&judgement.asked())
            );
        }
        text.push_str("</ul>\n");
    }
    if !section.panels.is_empty() {
        let class = if section.panels.len() == 3 { "panels three" } else { "panels" };
        let _ = writeln!(text, "<div class=\"{class}\">");
        let width = if section.panels.len() == 3 { NARROW } else { SIZE.0 };
        section.panels.iter().for_each(|panel| text.push_str(&panel.alone(width, SIZE.1)));
        text.push_str("</div>\n");
    }
    // Tables are what some sections are about; beside pictures they are details.
    let open = section.panels.is_empty();
    if !open && !section.tables.is_empty() {
        text.push_str("<details><summary>The numbers</summary>\n");
    }
    section.tables.iter().for_each(|own| table(text, own));
    if !open && !section.tables.is_empty() {
        text.push_str("</details>\n");
    }
    text.push_str("</section>\n");
}

fn table(text: &mut String, table: &Table) {
    let numeric = |column: usize| {
        column > 0 && table.rows.iter().any(|row| matches!(row.get(column), Some(Cell::Number(_))))
    };
    let class = |column: usize| if numeric(column) { " class=\"n\"" } else { "" };
    let _ = write!(
        text,
        "<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>",
        prose(&table.title)
    );
    for (i, column) in table.columns.iter().enumerate() {
        let _ = write!(text, "<th scope=\"col\"{}>{}</th>", class(i), prose(column));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        text.push_str("<tr>");
        for (i, value) in row.iter().enumerate() {
            let _ = match i {
                0 => write!(text, "<th scope=\"row\">{}</th>", cell(value)),
                _ => write!(text, "<td{}>{}</td>", class(i), cell(value)),
            };
        }
        // A row may say in one cell why it has no figures.
        let left = table.columns.len().saturating_sub(row.len());
        if left > 0 {
            let _ = write!(text, "<td colspan=\"{left}\"></td>");
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>\n");
}

fn cell(value: &Cell) -> String {
    match value {
        Cell::Number(_) => number(&value.shown()),
        Cell::Text(text) => match text.as_str() {
            "-" => "–".to_owned(),
            "NaN" | "inf" | "-inf" => "no figure".to_owned(),
            text => prose(text),
        },
    }
}
