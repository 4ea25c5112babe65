//! The page: sections, tables, verdicts, and a gallery. One file that needs no network.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use coadjoint_draw::{Panel, STYLE_SHEET, escaped, run::Picture};

use crate::gallery::{self, settings, verdict};
use crate::outcome::{Judgement, Report, Tabulation, brief, shown};
use crate::text::{Figure, figures, fill};

const SIZE: (f64, f64) = (440.0, 230.0);
/// The width of a panel where three are side by side.
const NARROW: f64 = 400.0;

pub struct Section {
    pub figure: &'static Figure,
    pub settings: Vec<String>,
    pub out: String,
    pub panels: Vec<Panel>,
    pub tables: Vec<Tabulation>,
    pub judgements: Vec<Judgement>,
}

/// The sections of a page, in its order, of the experiments that were run.
pub fn sections(reports: &[Report]) -> Vec<Section> {
    let section = |figure: &'static Figure| {
        let report = reports.iter().find(|report| report.name == figure.experiment)?;
        let tables = report.tables.iter().enumerate();
        let shown = |i| figure.tables.is_none_or(|[from, to]| (from..to).contains(&i));
        let tables = tables.filter(|(i, _)| shown(*i)).map(|(_, table)| table.clone());
        let judgements = report.judgements.iter().filter(|own| own.figure == figure.id);
        Some(Section {
            figure,
            settings: figure.settings.iter().map(|text| fill(text, report)).collect(),
            out: fill(&figure.out, report),
            panels: figure.group.iter().flat_map(|group| group.draw(report)).collect(),
            tables: tables.collect(),
            judgements: judgements.cloned().collect(),
        })
    };
    figures().iter().filter_map(section).collect()
}

/// The page as the text of an HTML file: the same outcomes make the same bytes.
pub fn page(reports: &[Report], gallery: &[Picture]) -> String {
    let sections = sections(reports);
    let seeds: BTreeSet<String> = reports.iter().map(|report| report.seed.to_string()).collect();
    let seeds: Vec<String> = seeds.into_iter().collect();
    let mut text = String::new();
    let judged: Vec<&Judgement> = sections.iter().flat_map(|section| &section.judgements).collect();
    let kept = gallery.iter().filter(|picture| gallery::worst(picture) <= gallery::BOUND).count();
    let held = judged.iter().filter(|judgement| judgement.holds()).count() + kept;
    let all = judged.len() + gallery.len();
    let version = if reports.iter().any(|report| report.quick) {
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
         <style>\n{STYLE_SHEET}{}</style>\n</head>\n<body>\n<header>\n\
         <h1>Symmetry Preservation in Hamiltonian Systems: Simulation and Learning, reproduced</h1>\n\
         <p>Every figure and table of the paper by M. Vaquero, J. Cortés and D. Martín de Diego, with what came out \
         beside it and the number that judges it; then comparisons of our own, and a gallery. {version} \
         Seed {}: the same seed gives the same page.</p>\n\
         <p><span class=\"mark{}\">{held} of {all}</span> numbers are what they must be.</p>\n\
         <nav aria-label=\"Contents\">\n<ol>\n",
        include_str!("../page.css"),
        seeds.join(", "),
        if held == all { "" } else { " fails" },
    );
    for Section { figure, judgements, .. } in &sections {
        let holds = judgements.iter().all(Judgement::holds);
        let mark = if judgements.is_empty() { String::new() } else { verdict(holds) };
        let (id, title) = (&figure.id, escaped(&figure.title));
        let _ = writeln!(text, "<li><a href=\"#{id}\">{title}</a> {mark}</li>");
    }
    if !gallery.is_empty() {
        let count = gallery.len();
        let _ = writeln!(text, "<li><a href=\"#gallery\">Gallery of {count} systems</a></li>");
    }
    text.push_str("</ol>\n</nav>\n</header>\n<main>\n");
    for (ours, title) in [(false, "The paper"), (true, "Beyond the paper")] {
        let own: Vec<&Section> = sections.iter().filter(|s| s.figure.ours == ours).collect();
        if !own.is_empty() {
            let _ = writeln!(text, "<h2>{title}</h2>");
        }
        own.into_iter().for_each(|own| section(&mut text, own));
    }
    if !gallery.is_empty() {
        let _ = writeln!(
            text,
            "<h2 id=\"gallery\">Gallery</h2>\n<p>Every system of the examples, run as its file says: the body momentum \
             over time, and what drifts. A mark says whether spatial momentum and \
             Casimirs, which every step conserves whatever S is, stay within {}. Energy is conserved as well as K \
             and h make it.</p>",
            brief(gallery::BOUND)
        );
        gallery.iter().for_each(|picture| text.push_str(&gallery::exhibit(picture)));
    }
    text.push_str(
        "<footer>Made by <code>coadjoint-paper</code>. One file, no network.</footer>\n</main>\n</body>\n</html>\n",
    );
    text
}

fn section(text: &mut String, section: &Section) {
    let figure = section.figure;
    let title = escaped(&figure.title);
    let settings = settings(&section.settings);
    let _ = writeln!(text, "<section>\n<h3 id=\"{}\">{title}</h3>\n{settings}\n<dl>", figure.id);
    let shows = if figure.ours { "Why" } else { "The paper" };
    let lines =
        [(shows, &figure.shows), ("Silent on", &figure.silent), ("What came out", &section.out)];
    for (name, line) in lines.into_iter().filter(|(_, line)| !line.is_empty()) {
        let _ = writeln!(text, "<dt>{name}</dt><dd>{}</dd>", escaped(line));
    }
    text.push_str("</dl>\n<ul class=\"verdicts\">\n");
    for judgement in &section.judgements {
        let class = if judgement.holds() { "" } else { " class=\"fails\"" };
        let (what, mark) = (escaped(&judgement.what), verdict(judgement.holds()));
        let [value, asked] = judgement.words();
        let value = format!("<span class=\"number\">{value}</span>");
        let _ = writeln!(text, "<li{class}>{mark} {what}: {value}, {asked}</li>");
    }
    text.push_str("</ul>\n");
    let three = section.panels.len() == 3;
    let (class, width) = if three { ("panels three", NARROW) } else { ("panels", SIZE.0) };
    let _ = writeln!(text, "<div class=\"{class}\">");
    section.panels.iter().for_each(|panel| text.push_str(&panel.alone(width, SIZE.1)));
    text.push_str("</div>\n");
    // Tables are what some sections are about; beside pictures they are details.
    let details = !section.panels.is_empty() && !section.tables.is_empty();
    if details {
        text.push_str("<details><summary>The numbers</summary>\n");
    }
    section.tables.iter().for_each(|own| table(text, own));
    if details {
        text.push_str("</details>\n");
    }
    text.push_str("</section>\n");
}

fn table(text: &mut String, table: &Tabulation) {
    let numeric = |column: usize| {
        column > 0
            && table
                .rows
                .iter()
                .any(|row| matches!(row.get(column), Some(cell) if cell.is_number()))
    };
    let class = |column: usize| if numeric(column) { " class=\"n\"" } else { "" };
    let title = escaped(&table.title);
    let _ = write!(text, "<div class=\"scroll\"><table>\n<caption>{title}</caption>\n<thead><tr>");
    for (i, column) in table.columns.iter().enumerate() {
        let _ = write!(text, "<th scope=\"col\"{}>{}</th>", class(i), escaped(column));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        let _ = write!(text, "<tr><th scope=\"row\">{}</th>", escaped(&shown(&row[0])));
        for (i, value) in row.iter().enumerate().skip(1) {
            let _ = write!(text, "<td{}>{}</td>", class(i), escaped(&shown(value)));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>\n");
}
