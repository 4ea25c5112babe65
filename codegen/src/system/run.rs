//! The run a system file describes: `[run]`, and the step or the tolerance of `[integrator]`.

use toml::de::DeValue;

use super::event::Event;
use super::table::{Table, span};
use crate::diagnostic::Span;
use crate::number::nearest_float;
use crate::tolerance::Region;

const TOLERANCE: &str = "tolerance = 1e-9";
const REGION: &str = "region = 2.5";

/// The initial state, the duration and the step; `None` where the file says nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// The step size h, finite and not zero.
    pub step: Option<f64>,
    /// The error asked for at the end, instead of a step size.
    pub tolerance: Option<f64>,
    /// The region in which the momentum stays, for `tolerance`.
    pub region: Option<Region>,
    /// The truncation, if the file gives one.
    pub truncation: Option<usize>,
    /// The duration T, finite and positive.
    pub time: Option<f64>,
    /// Every n-th step is recorded, n ≥ 1.
    pub every: Option<usize>,
    /// The events to look for, at the ends of this number of equal parts of each step, n ≥ 1.
    pub events: Vec<Event>,
    /// `None` where the file does not say.
    pub looks: Option<usize>,
    /// The time at the start t₀, of which energies, torques, inputs and events are functions; 0 if it is not given.
    pub initial_time: f64,
    /// True if the error at the end is estimated.
    pub estimate: Option<bool>,
    /// The body momentum μ at the start.
    pub momentum: Option<Vec<f64>>,
    /// The time at which that momentum has the angular velocity of the file, where it follows from one and H depends on time.
    pub velocity_time: Option<f64>,
    /// The group element at the start, row by row; the identity if it is not given.
    pub group_element: Option<Vec<Vec<f64>>>,
}

impl Run {
    /// The body momentum of a run that starts at this time, as far as the file says.
    ///
    /// # Errors
    /// The reason where it follows from an angular velocity at another time.
    pub fn momentum_at(&self, start: f64) -> Result<Option<Vec<f64>>, String> {
        match self.velocity_time.filter(|time| *time != start) {
            Some(time) => Err(format!(
                "`angular_velocity` gives the momentum at the file's own time, {time}: write the time {start} under [initial]"
            )),
            None => Ok(self.momentum.clone()),
        }
    }
}

/// Reads `[run]`, which may have `more` keys, and `step`, `tolerance` and `region` of `[integrator]`.
pub(super) fn read(root: &Table<'_>, integrator: Option<&Table<'_>>, more: &[&'static str]) -> Run {
    let mut run = Run::default();
    if let Some(table) = integrator {
        let step = table.number("step", "step = 0.1");
        run.step = accepted(table, step, "step = 0.1", |step| {
            (step == 0.0 || !step.is_finite())
                .then_some("the step must be finite and other than zero")
        });
        let tolerance = table.number("tolerance", TOLERANCE);
        run.tolerance = accepted(table, tolerance, TOLERANCE, |tolerance| {
            (!(1e-14..=1e-1).contains(&tolerance))
                .then_some("the tolerance must lie between 1e-14 and 1e-1")
        });
        if let (Some((_, place)), true) = (tolerance, table.has("step")) {
            let what = "a tolerance picks the step: keep one of `tolerance` and `step`";
            table.refuse(place, what, TOLERANCE);
        }
        run.region = region(table);
    }
    if let Some(table) = root.table("run") {
        table.check_keys(&[&["time", "every", "looks", "estimate"][..], more].concat());
        let time = table.number("time", "time = 100.0");
        run.time = accepted(&table, time, "time = 100.0", |time| {
            (time <= 0.0 || !time.is_finite()).then_some("the time must be finite and positive")
        });
        let every = table.integer("every", "every = 1");
        run.every = accepted(&table, every, "every = 1", |every| {
            (every == 0).then_some("`every` counts steps from 1")
        });
        run.estimate = table.has("estimate").then(|| table.flag("estimate", "estimate = false"));
        let looks = table.integer("looks", "looks = 4");
        run.looks = accepted(&table, looks, "looks = 4", |looks| {
            (!(1..=1000).contains(&looks)).then_some("a step is looked at in 1 to 1000 parts")
        });
    }
    run
}

/// A number that was given, refused where `wrong` says why.
pub(super) fn accepted<T: Copy>(
    table: &Table<'_>,
    given: Option<(T, Span)>,
    example: &str,
    wrong: impl Fn(T) -> Option<&'static str>,
) -> Option<T> {
    let (value, place) = given?;
    if let Some(what) = wrong(value) {
        table.refuse(place, what, example);
    }
    Some(value)
}

fn region(table: &Table<'_>) -> Option<Region> {
    let value = table.get("region")?;
    if !table.has("tolerance") {
        let what = "`region` says where a tolerance is to hold, and there is none";
        table.refuse(span(value), what, TOLERANCE);
    }
    if !matches!(value.get_ref(), DeValue::Array(_)) {
        return table.number("region", REGION).map(|(radius, _)| Region::Ball(radius));
    }
    let rows = table.matrix("region", value, REGION)?;
    let bounds = rows.iter().map(|row| match row.as_slice() {
        [low, high] => Some([nearest_float(low), nearest_float(high)]),
        _ => None,
    });
    let bounds: Option<Vec<[f64; 2]>> = bounds.collect();
    if bounds.is_none() {
        let expected = "a radius, or [low, high] for each coordinate";
        table.wrong_kind("region", expected, value, REGION);
    }
    bounds.map(Region::Box)
}
