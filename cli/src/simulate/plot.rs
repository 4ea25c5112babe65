//! From trajectories to what is drawn.

use std::path::Path;

use coadjoint_codegen::file;
use coadjoint_codegen::system::{System, Units};
use coadjoint_draw::run::{Picture, Run, Series, render};

use super::trajectory::Trajectory;
use crate::error::{CliError, unwritten};

/// Writes the picture.
pub fn draw(path: &Path, inputs: &[&Path], picture: &Picture) -> Result<(), CliError> {
    file::write(path, inputs, render(picture).as_bytes()).map_err(unwritten(path))
}

/// The heading above a picture's panels.
#[derive(Clone, Debug)]
pub struct Heading {
    name: String,
    group: String,
    chart: &'static str,
    units: Units,
    /// The step size of each run of ours.
    steps: Vec<f64>,
}

impl Heading {
    /// The heading of a system; [`Heading::step`] adds the steps of its runs.
    pub fn new(system: &System) -> Self {
        let System { problem, units, .. } = system;
        Self {
            name: problem.name.clone(),
            group: problem.algebra.name().to_owned(),
            chart: problem.chart.name(),
            units: units.clone(),
            steps: Vec::new(),
        }
    }

    /// Takes note of the step size of a run.
    pub fn step(&mut self, step: f64) {
        self.steps.push(step);
    }

    /// Group, chart, K, step and duration, and what else is said of a run in its label.
    fn settings(&self, runs: &[Trajectory]) -> Vec<String> {
        let unit = self.units.time.as_ref().map(|unit| format!(" {unit}")).unwrap_or_default();
        let ours = || runs.iter().filter_map(|run| Some((run, run.truncation?)));
        let mut settings = vec![format!("group {}", self.group), format!("chart {}", self.chart)];
        let orders: Vec<String> = ours().map(|(_, k)| k.to_string()).collect();
        settings.push(format!("K = {}", orders.join(", ")));
        let mut steps: Vec<String> = self.steps.iter().map(|h| brief(*h)).collect();
        steps.dedup();
        settings.push(format!("h = {}{unit}", steps.join(", ")));
        if let Some(run) = runs.first() {
            settings.push(format!("T = {}{unit}", brief(run.outcome.time)));
        }
        if let Some((run, k)) = ours().next() {
            let usual = format!("K = {k}, {}", self.chart);
            let more = run.label.strip_prefix(&usual).unwrap_or(&run.label);
            settings.extend(more.split(", ").filter(|t| !t.is_empty()).map(str::to_owned));
        }
        settings
    }
}

/// A number in at most nine digits.
pub fn brief(value: f64) -> String {
    let text = format!("{value:.8e}");
    let short = text.parse().unwrap_or(value);
    if short == 0.0 || (1e-4..1e7).contains(&f64::abs(short)) {
        format!("{short}")
    } else {
        format!("{short:e}")
    }
}

/// The picture of some runs of one system.
pub fn picture(heading: &Heading, trajectories: &[Trajectory]) -> Picture {
    Picture {
        name: heading.name.clone(),
        settings: heading.settings(trajectories),
        time_unit: heading.units.time.clone(),
        runs: trajectories.iter().map(|run| curves(run, &heading.units)).collect(),
    }
}

fn curves(run: &Trajectory, units: &Units) -> Run {
    let momentum = |(i, name): (usize, &String)| Series {
        name: name.clone(),
        unit: units.coordinate(i).map(str::to_owned),
        values: run.records.iter().map(|record| record.momentum[i]).collect(),
    };
    let drift = |name: &str, which: usize| Series {
        name: name.to_owned(),
        unit: None,
        values: run.records.iter().map(|record| record.drift.numbers()[which]).collect(),
    };
    let [spatial, casimirs, energy] = run.outcome.unknown.known();
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
    Run {
        label: run.label.clone(),
        times: run.records.iter().map(|record| record.time).collect(),
        momentum: run.coordinates.iter().enumerate().map(momentum).collect(),
        drifts,
    }
}
