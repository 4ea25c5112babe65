//! The contents of a picture of runs.

/// Differences below this, and zero, which has no logarithm, are drawn here.
pub const FLOOR: i32 = -17;

/// A run, recorded at some times.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// The method, such as `K = 7, exp`.
    pub label: String,
    /// The times of the records.
    pub times: Vec<f64>,
    /// The coordinates of the momentum.
    pub momentum: Vec<Series>,
    /// Relative differences of conserved quantities from the start; the names are those of panels.
    pub drifts: Vec<Series>,
}

/// One number at each time of a run.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// The name.
    pub name: String,
    /// The unit, if there is one.
    pub unit: Option<String>,
    /// One value for each time.
    pub values: Vec<f64>,
}

/// The label of an axis of time.
pub(crate) fn time_label(unit: Option<&str>) -> String {
    unit.map_or("time".to_owned(), |unit| format!("time ({unit})"))
}
