//! The gallery: every system of a folder, run as its file says, with its momentum and the drift of its conserved quantities.

use std::fmt::Write as _;
use std::path::Path;

use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::system::{Options, Parameters};
use coadjoint_draw::curves::range;
use coadjoint_draw::run::{Channel, Picture, Recording, drift_panels, motion_panels};
use coadjoint_draw::{Panel, escaped};
use coadjoint_run::simulate::{self, Drift, Moment, Schedule, Setup, Sink};
use coadjoint_run::{Accuracy, Derivations, Derived, meet_tolerance, read_varying};

use crate::outcome::{Fallible, brief};

const SIZE: (f64, f64) = (400.0, 250.0);
/// Stretches of time in which two points of a curve are drawn.
const COLUMNS: usize = 130;
/// A drift of spatial momentum or Casimirs beyond this is no rounding.
pub const BOUND: f64 = 1e-11;

/// The moments of a run at which its drift was looked at; a run without records looks at a bounded number of them.
#[derive(Default)]
struct Looks(Vec<(f64, Vec<f64>, Drift)>);

impl Sink for Looks {
    fn look(&mut self, time: f64, momentum: &[f64], moment: &Moment) {
        self.0.push((time, momentum.to_vec(), moment.drift));
    }
}

pub fn picture(file: &Path) -> Fallible<Picture> {
    let parameters = Parameters::Substituted;
    let options = Options { parameters, ..Options::default() };
    let text = std::fs::read_to_string(file);
    let text = text.map_err(|e| format!("cannot read {}: {e}", file.display()))?;
    let mut system = read_varying(&file.display().to_string(), &text, options, &[])?;
    meet_tolerance(file, &mut system, &Accuracy::default(), &Derivations::default())?;
    let schedule = Schedule::new(file, &Accuracy::default(), &system.run)?;
    let momentum = system.run.momentum.clone();
    let missing = || format!("{}: [initial] momentum is missing", file.display());
    let mut setup = Setup::new(schedule, momentum.ok_or_else(missing)?);
    setup.group_element.clone_from(&system.run.group_element);
    let units = system.units.clone();
    let derived = Derived::of_file(file, system)?;
    let Facts { name, algebra, coordinates, truncation, .. } = derived.facts();
    let (name, group) = (name.to_owned(), algebra.name());
    let chart = derived.series().map(|series| series.problem.chart.name());
    let mut looks = Looks::default();
    let outcome = simulate::run(&derived, &setup, &mut looks)?;
    let Looks(looks) = looks;
    // An unknown drift has no curve.
    let drift = |name: &str, of: fn(&Drift) -> Option<f64>| {
        let values: Option<Vec<f64>> = looks.iter().map(|look| of(&look.2)).collect();
        values.map(|values| Channel { name: name.to_owned(), unit: None, values })
    };
    let mut drifts = Vec::from_iter(drift("energy", |drift| drift.energy));
    if outcome.momenta > 0 {
        let count = outcome.momenta;
        let conserved = format!("spatial momentum, {count} conserved");
        let name = if outcome.potential { &*conserved } else { "spatial momentum" };
        drifts.extend(drift(name, |drift| drift.spatial_momentum));
    }
    if outcome.casimirs > 0 {
        drifts.extend(drift("Casimirs", |drift| drift.casimirs));
    }
    let series = |(i, name): (usize, &String)| Channel {
        name: name.clone(),
        unit: units.coordinate(i).map(str::to_owned),
        values: looks.iter().map(|look| look.1[i]).collect(),
    };
    let label = derived.label();
    let unit = units.time.as_ref().map(|unit| format!(" {unit}")).unwrap_or_default();
    let mut settings = vec![
        format!("group {group}"),
        chart.map_or_else(|| derived.label(), |chart| format!("chart {chart}")),
        format!("K = {truncation}"),
        format!("h = {}{unit}", brief(schedule.step)),
        format!("T = {}{unit}", brief(schedule.end)),
    ];
    // Frame and splitting, after truncation and chart or method and nodes.
    settings.extend(label.split(", ").skip(2).map(str::to_owned));
    let run = Recording {
        label,
        times: looks.iter().map(|look| look.0).collect(),
        momentum: coordinates.iter().enumerate().map(series).collect(),
        drifts,
    };
    Ok(Picture { name, settings, time_unit: units.time, runs: vec![run] })
}

/// The largest drift of what every step conserves whatever S is; NaN where one is unknown.
pub fn worst(picture: &Picture) -> f64 {
    let exact = picture.runs.iter().flat_map(|run| &run.drifts);
    let exact = exact.filter(|drift| drift.name != "energy");
    let largest = |series: &Channel| range(&series.values).map_or(f64::NAN, |(_, high)| high);
    exact.map(largest).fold(0.0, |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

pub fn exhibit(picture: &Picture) -> String {
    let name = escaped(&picture.name);
    let mark = verdict(worst(picture) <= BOUND);
    let mut text = format!(
        "<article class=\"exhibit\" id=\"gallery-{name}\">\n<h3>{name} {mark}</h3>\n{}\n<div class=\"panels\">\n",
        settings(&picture.settings)
    );
    let mut panels = Vec::new();
    if let Some(run) = picture.runs.first() {
        let across = range(&run.times).unwrap_or((0.0, 1.0));
        let unit = picture.time_unit.as_deref();
        panels.extend(motion_panels(run, false, across, unit, COLUMNS).into_iter().take(1));
        panels.extend(together(run, across, unit));
    }
    panels.iter().for_each(|panel| text.push_str(&panel.alone(SIZE.0, SIZE.1)));
    // Writing to a String cannot fail.
    let _ = text.write_str("</div>\n</article>\n");
    text
}

/// All drifts of a run in one panel, as if each were of a run of its own.
fn together(run: &Recording, across: (f64, f64), unit: Option<&str>) -> Option<Panel> {
    let alone = |drift: &Channel| Recording {
        label: drift.name.split(',').next().unwrap_or_default().to_owned(),
        times: run.times.clone(),
        drifts: vec![Channel { name: String::new(), ..drift.clone() }],
        ..Recording::default()
    };
    let runs: Vec<Recording> = run.drifts.iter().map(alone).collect();
    let panel = drift_panels(&runs, across, unit).into_iter().next()?;
    Some(Panel { heading: "Relative drifts".to_owned(), ..panel }.with_legend())
}

/// A mark: does it hold?
pub fn verdict(holds: bool) -> String {
    let (class, word) = if holds { ("", "pass") } else { (" fails", "FAIL") };
    format!("<span class=\"mark{class}\">{word}</span>")
}

pub fn settings(settings: &[String]) -> String {
    let spans: Vec<String> =
        settings.iter().map(|setting| format!("<span>{}</span>", escaped(setting))).collect();
    format!("<p class=\"settings\">{}</p>", spans.join(" · "))
}
