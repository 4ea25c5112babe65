//! Draws trajectories.

use std::path::Path;

use coadjoint_codegen::file;
use coadjoint_codegen::system::Units;
use coadjoint_draw::run::{Channel, Picture, Recording, render};
use serde_json::Value;

use super::keep::Trajectory;
use crate::error::{CliError, unwritten};

/// Writes the picture of some runs of one system.
pub(crate) fn draw(
    path: &Path,
    inputs: &[&Path],
    runs: &[Trajectory],
    units: &Units,
) -> Result<(), CliError> {
    let name = runs.first().and_then(|run| run.header.get("name")?.as_str());
    let picture = Picture {
        name: name.unwrap_or_default().to_owned(),
        settings: settings(runs, units),
        time_unit: units.time.clone(),
        runs: runs.iter().map(|run| curves(run, units)).collect(),
    };
    file::write(path, inputs, render(&picture).as_bytes()).map_err(unwritten(path))
}

/// Group, chart, K, step and duration, and what else is said of a run in its label.
fn settings(runs: &[Trajectory], units: &Units) -> Vec<String> {
    let unit = units.time.as_ref().map(|unit| format!(" {unit}")).unwrap_or_default();
    let Some(first) = runs.first() else { return Vec::new() };
    let said = |name| first.header.text(name);
    let all = |text: &dyn Fn(&Trajectory) -> String| {
        let mut list: Vec<String> = runs.iter().map(text).collect();
        list.dedup();
        list.join(", ")
    };
    let number = |run: &Trajectory, name| run.header.get(name).and_then(Value::as_f64);
    let step = |run: &Trajectory| number(run, "step").map(brief).unwrap_or_default();
    let start = number(first, "initial_time");
    let mut settings = vec![format!("group {}", said("group"))];
    // Steps by collocation name none.
    settings.extend(first.header.get("chart").map(|_| format!("chart {}", said("chart"))));
    settings.extend([
        format!("K = {}", all(&|run| run.header.text("truncation"))),
        format!("h = {}{unit}", all(&step)),
    ]);
    settings.extend(start.map(|start| format!("t₀ = {}{unit}", brief(start))));
    settings.push(format!("T = {}{unit}", brief(first.outcome.time - start.unwrap_or(0.0))));
    let usual = format!("K = {}, {}", said("truncation"), said("chart"));
    let more = first.label.strip_prefix(&usual).unwrap_or(&first.label);
    settings.extend(more.split(", ").filter(|t| !t.is_empty()).map(str::to_owned));
    settings
}

/// A number in at most nine digits.
pub(crate) fn brief(value: f64) -> String {
    let text = format!("{value:.8e}");
    let short = text.parse().unwrap_or(value);
    if short == 0.0 || (1e-4..1e7).contains(&f64::abs(short)) {
        format!("{short}")
    } else {
        format!("{short:e}")
    }
}

fn curves(run: &Trajectory, units: &Units) -> Recording {
    let momentum = |(i, name): (usize, &String)| Channel {
        name: name.clone(),
        unit: units.coordinate(i).map(str::to_owned),
        values: run.samples.iter().map(|sample| sample.momentum[i]).collect(),
    };
    let drift = |name: &str, which: usize| Channel {
        name: name.to_owned(),
        unit: None,
        values: run.samples.iter().map(|sample| sample.drift.numbers()[which]).collect(),
    };
    let [spatial, casimirs, energy] = run.outcome.unknown.map(|why| why.is_none());
    let mut drifts = Vec::new();
    if energy {
        drifts.push(drift("energy", 2));
    }
    if spatial {
        let name = match (run.outcome.potential, run.outcome.momenta) {
            (false, _) => "spatial momentum".to_owned(),
            (true, 1) => "spatial momentum, the one component that is conserved".to_owned(),
            (true, count) => {
                format!("spatial momentum, the {count} components that are conserved")
            }
        };
        drifts.push(drift(&name, 0));
    }
    if casimirs {
        drifts.push(drift("Casimirs", 1));
    }
    Recording {
        label: run.label.clone(),
        times: run.samples.iter().map(|sample| sample.time).collect(),
        momentum: run.coordinates.iter().enumerate().map(momentum).collect(),
        drifts,
    }
}
