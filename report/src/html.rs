//! The page: sections, tables, verdicts, and the rules that lay them out.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use coadjoint_draw::{STYLE_SHEET, escaped, run::Picture};
use coadjoint_learn::experiment::{Cell, Judgement, Table};

use crate::gallery;
use crate::section::Section;

/// The size of a panel.
const SIZE: (f64, f64) = (440.0, 230.0);

/// The rules of the page, besides those of its pictures.
const RULES: &str = "\
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,\"Segoe UI\",sans-serif}
main,header{max-width:1180px;margin:0 auto;padding:0 20px}
h1{font-size:1.9rem;line-height:1.2;margin:1.2em 0 .3em}
h2{font-size:1.5rem;margin:2.2em 0 .2em;padding-top:.5em;border-top:2px solid var(--grid)}
h3{font-size:1.2rem;margin:1.8em 0 .3em}
p,dl,ul{max-width:78ch}
a{color:var(--s0)}
.settings{color:var(--faint);font-size:.9rem;margin:.1em 0 .6em}
.settings span{white-space:nowrap}
sup,sub{line-height:0;font-size:.75em}
dl{display:grid;grid-template-columns:9em 1fr;gap:.25em 1em;margin:.6em 0}
dt{font-weight:600;color:var(--faint)}
dd{margin:0}
.panels{display:grid;grid-template-columns:repeat(2,minmax(0,500px));gap:18px 24px;margin:1em 0}
.panels.three{grid-template-columns:repeat(3,minmax(0,1fr))}
.panels svg{width:100%;height:auto}
.verdicts{list-style:none;padding:0;margin:.6em 0}
.verdicts li{padding:.35em .7em;margin:.3em 0;border-left:5px solid var(--pass);background:var(--soft)}
.verdicts li.fails{border-left-color:var(--fail)}
.mark{font-size:.8rem;font-weight:700;letter-spacing:.03em;padding:.1em .5em;border:1.5px solid currentColor;\
border-radius:3px;color:var(--pass);white-space:nowrap}
.mark.fails{color:var(--fail)}
.number{font-weight:700}
.scroll{overflow-x:auto;margin:.8em 0}
table{border-collapse:collapse;font-size:.86rem}
caption{text-align:left;font-weight:600;padding:.3em 0;max-width:78ch}
th,td{padding:.22em .8em .22em 0;text-align:left;border-bottom:1px solid var(--grid);vertical-align:top}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
details{margin:.6em 0}
summary{cursor:pointer;color:var(--faint)}
nav ol{columns:2;column-gap:3em;max-width:1000px;padding-left:1.4em}
nav li{break-inside:avoid;margin:.15em 0}
footer{color:var(--faint);margin:3em 0 2em;font-size:.9rem}
:root{--pass:#1a6e34;--fail:#b3261e;--soft:#f4f6f8}
@media screen and (prefers-color-scheme:dark){:root{--pass:#5fd07f;--fail:#ff8a80;--soft:#181e25}}
@media (max-width:1000px){.panels.three{grid-template-columns:repeat(2,minmax(0,1fr))}}
@media (max-width:720px){main,header{padding:0 14px}.panels,.panels.three{grid-template-columns:minmax(0,1fr)}\
dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:.5em}nav ol{columns:1}h1{font-size:1.5rem}}
@media print{body{font-size:10.5pt}main,header{max-width:none;padding:0}nav{display:none}\
.panels,.panels.three{grid-template-columns:repeat(2,minmax(0,1fr))}\
svg,.verdicts li,tr,.exhibit h3{break-inside:avoid}h2,h3{break-after:avoid}.scroll{overflow:visible}\
table{font-size:8pt}a{color:inherit;text-decoration:none}}
";

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
        section.panels.iter().for_each(|panel| text.push_str(&panel.alone(SIZE.0, SIZE.1)));
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

/// What is written in ASCII in tables and files, and how it is set on the page.
const SET: [(&str, &str); 8] = [
    ("J_L", "J<sub>L</sub>"),
    ("mu''", "μ″"),
    ("mu'", "μ′"),
    ("g'^-1", "g′⁻¹"),
    ("alpha''", "α″"),
    ("g''", "g″"),
    ("^3", "³"),
    ("dt ", "Δt "),
];

/// Text of a page in which numbers such as 1e-8 are written out.
fn prose(text: &str) -> String {
    let mut text = escaped(text);
    for (plain, set) in SET {
        text = text.replace(plain, set);
    }
    let mut out = String::with_capacity(text.len());
    for (i, word) in text.split(' ').enumerate() {
        if i > 0 {
            out.push(' ');
        }
        let start = word.find(|c: char| c.is_ascii_digit()).unwrap_or(0);
        let end = word.rfind(|c: char| c.is_ascii_digit()).map_or(0, |at| at + 1);
        if start < end {
            out.push_str(&word[..start]);
            out.push_str(&number(&word[start..end]));
            out.push_str(&word[end..]);
        } else {
            out.push_str(word);
        }
    }
    out
}

/// A number such as 1.2e-8 with its power of ten written out; anything else as it is.
fn number(text: &str) -> String {
    let Some((digits, exponent)) = text.split_once('e') else { return minus(text) };
    let plain = |part: &str| {
        let part = part.strip_prefix('-').unwrap_or(part);
        !part.is_empty() && part.chars().all(|c| c.is_ascii_digit() || c == '.')
    };
    if !plain(digits) || !plain(exponent) {
        return text.to_owned();
    }
    let exponent = minus(exponent);
    match digits {
        "1" => format!("10<sup>{exponent}</sup>"),
        digits => format!("{}·10<sup>{exponent}</sup>", minus(digits)),
    }
}

fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => format!("−{rest}"),
        _ => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::{number, prose};

    #[test]
    fn powers_of_ten_are_written_out() {
        assert_eq!(number("1.20e-8"), "1.20·10<sup>−8</sup>");
        assert_eq!(number("1e-12"), "10<sup>−12</sup>");
        assert_eq!(number("-0.5"), "−0.5");
        assert_eq!(prose("at most 1e-12, so"), "at most 10<sup>−12</sup>, so");
        assert_eq!(prose("type II < x"), "type II &lt; x");
        assert_eq!(prose("degree_2e"), "degree_2e");
    }
}
