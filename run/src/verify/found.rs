//! The findings of a verification.

use serde::Serialize;
use serde_json::{Map, Value, json};

/// The findings.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Found {
    /// Rows that were reached from another.
    pub rows: u64,
    /// Steps made.
    pub steps: u64,
    /// The largest deviation of a momentum over its bound.
    pub momentum: f64,
    /// The largest deviation of a group element, over its bound.
    pub group_element: f64,
    /// The largest drift of the Casimirs from row to row, relative to their scales.
    pub casimir: f64,
    /// The largest drift of the spatial momentum from row to row, relative to its size.
    pub spatial_momentum: f64,
    /// Rows that are not in the sample asked for, where one is.
    pub not_sampled: Option<u64>,
    /// Rows that the run itself has refused, and says so.
    pub refused: u64,
    /// Rows that could not be judged.
    pub not_judged: u64,
    /// The reason for the first of them.
    pub why_not_judged: Option<String>,
    /// The file's own statement about its end, where it is a part.
    pub part: Option<String>,
    /// The place at which the file was cut before its end, if it was.
    pub cut: Option<String>,
    /// The first wrong row, and what is wrong with it.
    pub wrong: Option<String>,
}

impl Found {
    /// For people.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("{} rows by {} steps in doubled precision", self.rows, self.steps),
            format!("worst momentum: {:.2e} of its bound", self.momentum),
            format!("worst group element: {:.2e} of its bound", self.group_element),
            format!("worst drift of a Casimir from row to row: {:.2e}", self.casimir),
            format!(
                "worst drift of the spatial momentum from row to row: {:.2e}",
                self.spatial_momentum
            ),
        ];
        for (count, what) in [
            (self.not_sampled.unwrap_or(0), "are not in the sample"),
            (self.refused, "were refused by the run itself"),
            (self.not_judged, "could not be judged"),
        ] {
            lines.extend((count > 0).then(|| format!("{count} rows {what}")));
        }
        let part = self.part.iter();
        lines.extend(part.map(|part| format!("the file is a part of a run: {part}")));
        lines.extend(self.cut.clone());
        lines.push(self.verdict().to_owned());
        lines
    }

    /// In a few words.
    pub(crate) fn verdict(&self) -> &'static str {
        match (&self.wrong, self.not_judged) {
            (Some(_), _) => "wrong",
            (None, 0) if self.cut.is_some() => "not verified: the file is cut before its end",
            (None, 0) if self.not_sampled.is_some() => "no row of the sample is wrong",
            (None, 0) => "no row is wrong",
            (None, _) => "not verified: some rows could not be judged",
        }
    }

    /// For programs; keys with nothing to say are left out, as are numbers that are not finite.
    pub fn object(&self) -> Map<String, Value> {
        let mut found = json!(self);
        found["verdict"] = json!(self.verdict());
        let entries = found.as_object().into_iter().flatten();
        let given = entries.filter(|(_, value)| !value.is_null());
        given.map(|(name, value)| (name.clone(), value.clone())).collect()
    }

    /// Records a defect; the first one is reported.
    pub(crate) fn blame(&mut self, what: String) {
        self.wrong.get_or_insert(what);
    }

    /// Takes note of rows that are missing at the end.
    pub(crate) fn cut(&mut self, what: String) {
        self.cut.get_or_insert(what);
    }

    /// Takes note of a row that cannot be judged.
    pub(crate) fn pass_over(&mut self, why: String) {
        self.not_judged += 1;
        self.why_not_judged.get_or_insert(why);
    }
}
