//! The words of the page, from `figures.toml`: claims of the paper, results, and the numbers that judge them.

use std::sync::LazyLock;

use serde::Deserialize;

use crate::outcome::{Judgement, Report, brief, shown};
use crate::plot::Panels;

/// A figure or a table in words. In `settings` and `out` numbers are filled in: see [`fill`].
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Figure {
    pub id: String,
    pub experiment: String,
    pub title: String,
    /// True for figures of ours that the paper does not have.
    pub ours: bool,
    pub settings: Vec<String>,
    pub shows: String,
    /// The gaps in the paper, and the choices made here.
    pub silent: String,
    pub out: String,
    /// Which of the experiment's tables are shown, from and to; all if not given.
    pub tables: Option<[usize; 2]>,
    pub judged: Vec<Judged>,
    pub group: Vec<Panels>,
}

/// A number that judges: its meaning and its bounds.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judged {
    pub what: String,
    pub at_most: Option<f64>,
    pub at_least: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Texts {
    notes: std::collections::BTreeMap<String, Vec<String>>,
    figure: Vec<Figure>,
}

#[expect(clippy::expect_used, reason = "the file is part of the program; a test reads it")]
static TEXTS: LazyLock<Texts> =
    LazyLock::new(|| toml::from_str(include_str!("../figures.toml")).expect("figures.toml"));

/// All figures, in the order of the page.
pub fn figures() -> &'static [Figure] {
    &TEXTS.figure
}

/// Fills in the numbers of a report: `{row|column}` is a cell of the first table, `{title|row|column}` of the table whose
/// title begins so (of the first if there is none), `{max curve column}` the largest size in a column of a curve,
/// `{last curve column}` its last value.
pub fn fill(text: &str, report: &Report) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        let (key, after) = after.split_once('}').unwrap_or((after, ""));
        out.push_str(before);
        out.push_str(&value(key, report).unwrap_or_else(|| "–".into()));
        rest = after;
    }
    out + rest
}

fn value(key: &str, report: &Report) -> Option<String> {
    let parts: Vec<&str> = key.split('|').collect();
    if let [row, column] | [_, row, column] = parts[..] {
        let wanted = if parts.len() == 3 { parts[0] } else { "" };
        let table = report.tables.iter().find(|table| table.title.starts_with(wanted));
        let cell = table.or(report.tables.first())?.cell(row, column.parse().ok()?);
        return cell.map(shown);
    }
    let [what, curve, column] = key.split(' ').collect::<Vec<_>>()[..] else { return None };
    let values = report.curve(curve).column(column);
    match what {
        "max" => Some(brief(values.iter().map(|v| v.abs()).fold(0.0, f64::max))),
        _ => values.last().map(f64::to_string),
    }
}

impl Report {
    /// Enters the numbers that judge a figure, in the order of its text; `of` says of which part they are.
    #[expect(clippy::expect_used, reason = "identifiers are constants of this program")]
    pub fn judge(&mut self, figure: &str, of: &str, values: &[f64]) {
        let judged = &figures().iter().find(|own| own.id == figure).expect(figure).judged;
        assert_eq!(judged.len(), values.len(), "{figure}");
        self.judgements.extend(judged.iter().zip(values).map(|(judged, &value)| Judgement {
            figure: figure.into(),
            what: format!("{of}{}", judged.what),
            value: Some(value).filter(|value| value.is_finite()),
            at_most: judged.at_most,
            at_least: judged.at_least,
        }));
    }

    pub fn text(&self) -> String {
        let version = if self.quick { ", quick" } else { "" };
        let mut text = format!("{} (seed {}{version})\n", self.name, self.seed);
        for table in &self.tables {
            let rows = table.rows.iter().map(|row| row.iter().map(shown).collect());
            let rows: Vec<Vec<String>> =
                std::iter::once(table.columns.clone()).chain(rows).collect();
            let width = |c: usize| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
            text += &format!("\n{}\n", table.title);
            for row in &rows {
                let cells =
                    row.iter().enumerate().map(|(c, cell)| format!("  {cell:<w$}", w = width(c)));
                text += &(cells.collect::<String>().trim_end().to_owned() + "\n");
            }
        }
        for note in TEXTS.notes.get(&self.name).into_iter().flatten() {
            text += &format!("\nnote: {note}\n");
        }
        for judgement in &self.judgements {
            let verdict = if judgement.holds() { "holds" } else { "FAILS" };
            let [value, asked] = judgement.words();
            text += &format!("\n{verdict}: {}: {value}, {asked}\n", judgement.what);
        }
        text
    }
}
