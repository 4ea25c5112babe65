//! The findings.

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
    /// The statement of the file about its end, where it is a part.
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
        if self.left_out > 0 {
            lines.push(format!("{} rows are not in the sample", self.left_out));
        }
        if self.refused > 0 {
            lines.push(format!("{} rows were refused by the run itself", self.refused));
        }
        if let Some(part) = &self.part {
            lines.push(format!("the file is a part of a run: {part}"));
        }
        if self.unjudged > 0 {
            lines.push(format!("{} rows could not be judged", self.unjudged));
        }
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

    /// For programs; what there is nothing to say of has no key.
    pub fn object(&self) -> Map<String, Value> {
        let said = |text: &Option<String>| text.as_ref().map(|text| json!(text));
        let list = [
            ("verdict", Some(json!(self.verdict()))),
            ("rows", Some(json!(self.rows))),
            ("steps", Some(json!(self.steps))),
            ("momentum", number(self.momentum)),
            ("group_element", number(self.element)),
            ("casimir", number(self.casimir)),
            ("spatial_momentum", number(self.spatial)),
            ("not_sampled", (self.left_out > 0).then(|| json!(self.left_out))),
            ("refused", Some(json!(self.refused))),
            ("not_judged", Some(json!(self.unjudged))),
            ("why_not_judged", said(&self.why)),
            ("part", said(&self.part)),
            ("wrong", said(&self.wrong)),
        ];
        let given = list.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?)));
        given.collect()
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

/// JSON has no number for what is not finite.
fn number(value: f64) -> Option<Value> {
    value.is_finite().then(|| json!(value))
}

/// The larger of two numbers; NaN where one is.
pub fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
