//! The settings of a run: everything needed to repeat it, for the heads of files, for reports, and to tell
//! whether a checkpoint is of this run.

use coadjoint_codegen::problem::{Problem, Solver};
use coadjoint_codegen::system::Splitting;
use coadjoint_learn::ModelFile;
use coadjoint_program::quoting::line;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::Scales;
use serde_json::{Map, Value, json};

use super::setup::Settings;
use crate::note::Identity;

/// Names and values, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Header(Vec<(&'static str, Value)>);

impl Header {
    /// The description of a run of this problem.
    pub(crate) fn new(
        settings: &Settings,
        problem: &Problem,
        splitting: Option<Splitting>,
    ) -> Self {
        let solver = match problem.solver() {
            Solver::Newton => Solver::NAMES[0],
            Solver::FixedPoint => Solver::NAMES[1],
        };
        let mut own = vec![
            ("name", json!(problem.name)),
            ("group", json!(problem.algebra.name())),
            ("truncation", json!(problem.truncation)),
            ("chart", json!(problem.chart.name())),
            ("frame", json!(if problem.comoving.is_some() { "comoving" } else { "fixed" })),
            ("solver", json!(solver)),
        ];
        own.extend(splitting.map(|splitting| ("splitting", json!(splitting.name()))));
        Self::of(settings, ["system", "system_sha256"], own)
    }

    /// The description of a run of a learned map.
    pub(crate) fn of_model(settings: &Settings, model: &ModelFile) -> Self {
        let own = vec![
            ("kind", json!(model.model.name())),
            ("group", json!(model.group)),
            ("chart", json!(model.chart)),
        ];
        Self::of(settings, ["model", "model_sha256"], own)
    }

    /// The entries of its own of a run, between those that every run has.
    fn of(
        settings: &Settings,
        [file, hash]: [&'static str; 2],
        own: Vec<(&'static str, Value)>,
    ) -> Self {
        let setup = &settings.setup;
        let schedule = &setup.schedule;
        let mut list = vec![
            ("program", json!(format!("coadjoint {}", env!("CARGO_PKG_VERSION")))),
            (file, json!(settings.file.display().to_string())),
            (hash, json!(settings.hash)),
        ];
        list.extend(own);
        list.extend([
            ("step", json!(schedule.step)),
            ("step_asked", json!(schedule.asked)),
            ("steps", json!(schedule.steps)),
            ("time", json!(schedule.end)),
            ("initial_momentum", json!(setup.momentum)),
        ]);
        let element = setup.group_element.as_ref();
        list.extend(element.map(|rows| ("initial_group_element", json!(rows.concat()))));
        list.extend(setup.every.map(|every| ("every", json!(every))));
        list.extend(setup.at.as_ref().map(|times| ("at", json!(times.text()))));
        Self(list)
    }

    /// Only the entries with these names.
    pub(crate) fn only(mut self, names: &[&str]) -> Self {
        self.0.retain(|(name, _)| names.contains(name));
        self
    }

    /// With another entry at the end.
    pub(crate) fn with(mut self, name: &'static str, value: Value) -> Self {
        self.0.push((name, value));
        self
    }

    /// With the scales of the drifts that there are.
    pub(crate) fn with_scales(mut self, known: [bool; 3], scales: &Scales) -> Self {
        let list = [
            ("spatial_momentum_scale", json!(scales.spatial_momentum)),
            ("casimir_scales", json!(scales.casimirs)),
            ("energy_scale", json!(scales.energy)),
        ];
        self.0.extend(
            list.into_iter().zip(known).filter_map(|(scale, known)| known.then_some(scale)),
        );
        self
    }

    /// The value of this name in words.
    pub fn text(&self, name: &str) -> String {
        self.get(name).map(text).unwrap_or_default()
    }

    /// The value of this name.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// Lines `name: value`.
    pub(crate) fn lines(&self) -> impl Iterator<Item = String> + '_ {
        self.0.iter().map(|(name, value)| format!("{name}: {}", text(value)))
    }

    /// As a JSON object.
    pub(crate) fn object(&self) -> Map<String, Value> {
        self.0.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect()
    }

    /// By name, to be compared with another run.
    pub(crate) fn identity(&self) -> Identity {
        self.0.iter().map(|(name, value)| ((*name).to_owned(), text(value))).collect()
    }
}

/// On one line, numbers as short as they can be.
fn text(value: &Value) -> String {
    match value {
        Value::String(text) => line(text),
        Value::Number(number) if number.is_f64() => {
            number.as_f64().map_or_else(String::new, shortest)
        }
        Value::Array(list) => list.iter().map(text).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}
