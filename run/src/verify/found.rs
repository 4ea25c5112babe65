//! The findings of a verification.

use serde_json::{Map, Value, json};

/// The findings.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Rows that were reached from another.
    pub rows: u64,
    /// Steps made.
    pub steps: u64,
    /// The largest deviation of a momentum over its bound.
    pub momentum: f64,
    /// The same of group elements.
    pub element: f64,
    /// The largest drift of a Casimir from row to row, relative to its terms.
    pub casimir: f64,
    /// The same of the spatial momentum.
    pub spatial: f64,
    /// Rows that are not in the sample asked for.
    pub left_out: u64,
    /// Rows that the run itself has refused, and says so.
    pub refused: u64,
    /// Rows that could not be judged.
    pub unjudged: u64,
    /// Why the first of them could not.
    pub why: Option<String>,
    /// The file's own statement about its end, where it is a part.
    pub part: Option<String>,
    /// The defect of the first wrong row.
    pub wrong: Option<String>,
}

impl Found {
    /// For people.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("{} rows by {} steps in doubled precision", self.rows, self.steps),
            format!("worst momentum: {:.2e} of its bound", self.momentum),
            format!("worst group element: {:.2e} of its bound", self.element),
            format!("worst drift of a Casimir from row to row: {:.2e}", self.casimir),
            format!("worst drift of the spatial momentum from row to row: {:.2e}", self.spatial),
        ];
        for (count, what) in [
            (self.left_out, "are not in the sample"),
            (self.refused, "were refused by the run itself"),
            (self.unjudged, "could not be judged"),
        ] {
            lines.extend((count > 0).then(|| format!("{count} rows {what}")));
        }
        let part = self.part.iter();
        lines.extend(part.map(|part| format!("the file is a part of a run: {part}")));
        lines.push(self.verdict().to_owned());
        lines
    }

    /// In a few words.
    pub fn verdict(&self) -> &'static str {
        match (&self.wrong, self.unjudged) {
            (Some(_), _) => "wrong",
            (None, 0) if self.left_out > 0 => "no row of the sample is wrong",
            (None, 0) => "no row is wrong",
            (None, _) => "not verified: some rows could not be judged",
        }
    }

    /// For programs; keys with nothing to say are left out, as are numbers that are not finite.
    pub fn object(&self) -> Map<String, Value> {
        let list = [
            ("verdict", json!(self.verdict())),
            ("rows", json!(self.rows)),
            ("steps", json!(self.steps)),
            ("momentum", json!(self.momentum)),
            ("group_element", json!(self.element)),
            ("casimir", json!(self.casimir)),
            ("spatial_momentum", json!(self.spatial)),
            ("not_sampled", json!((self.left_out > 0).then_some(self.left_out))),
            ("refused", json!(self.refused)),
            ("not_judged", json!(self.unjudged)),
            ("why_not_judged", json!(self.why)),
            ("part", json!(self.part)),
            ("wrong", json!(self.wrong)),
        ];
        let given = list.into_iter().filter(|(_, value)| !value.is_null());
        given.map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Records a defect; the first one is reported.
    pub fn blame(&mut self, what: String) {
        self.wrong.get_or_insert(what);
    }

    /// Takes note of a row that cannot be judged.
    pub fn pass_over(&mut self, why: String) {
        self.unjudged += 1;
        self.why.get_or_insert(why);
    }
}
