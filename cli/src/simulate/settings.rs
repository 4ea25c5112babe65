//! The settings of a run, from the file and the options that replace them, and how files and reports describe them.

use std::path::{Path, PathBuf};
use std::time::Duration;

use coadjoint_codegen::diagnostic::Diagnostic;
use coadjoint_codegen::file;
use coadjoint_codegen::problem::Solver;
use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::system::{Options, Run, read_either};
use coadjoint_learn::ModelFile;
use coadjoint_program::quoting::line;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{Event, Scales, Schedule, Setup, Times};
use coadjoint_run::{Accuracy, Derived, RunError, System, inputs_hash, read_varying};
use serde_json::{Map, Value, json};

use super::target::{Destination, Place, paths};
use crate::arguments::SimulateOptions;
use crate::error::{CliError, unwritten};
use crate::note::Identity;

/// The settings of a run, and what is kept of it.
#[derive(Clone, Debug)]
pub(crate) struct Settings<'a> {
    /// The system file or the model.
    pub file: &'a Path,
    /// The SHA-256 of its text.
    pub hash: &'a str,
    /// Everything the run reads.
    pub inputs: Vec<PathBuf>,
    pub setup: Setup,
    /// The target of records.
    pub out: Option<Destination>,
    /// True if a picture is requested.
    pub sampled: bool,
    /// The file of checkpoints, and the time between two.
    pub checkpoint: Option<(PathBuf, Duration)>,
}

impl<'a> Settings<'a> {
    pub(crate) fn new(
        options: &SimulateOptions,
        (file, hash): (&'a Path, &'a str),
        out: Option<Destination>,
        setup: Setup,
    ) -> Result<Self, CliError> {
        let checkpoint = checkpoint(options)?;
        let setup = Setup { recording: out.is_some(), ..setup };
        let (inputs, sampled) = (inputs(options), options.plot.is_some());
        Ok(Self { file, hash, inputs, setup, out, sampled, checkpoint })
    }
}

/// The file of checkpoints, and the time between two.
pub(crate) fn checkpoint(
    options: &SimulateOptions,
) -> Result<Option<(PathBuf, Duration)>, CliError> {
    let what = "--checkpoint-interval must be a number of seconds, 0 or more";
    let Some(path) = &options.checkpoint else { return Ok(None) };
    let interval = Duration::try_from_secs_f64(options.checkpoint_interval);
    Ok(Some((path.clone(), interval.map_err(|_| CliError::Option(what.to_owned()))?)))
}

/// The run of a system, by the options, else by the file.
pub(crate) fn setup(
    options: &SimulateOptions,
    file: &Path,
    asked: &Accuracy,
    run: &Run,
) -> Result<Setup, CliError> {
    let schedule = Schedule::new(file, asked, run)?;
    let momentum = run.momentum_at(schedule.start);
    let momentum =
        momentum.map_err(|what| RunError::System { file: file.into(), source: what.into() })?;
    let momentum = momentum.ok_or_else(|| RunError::Missing {
        file: file.into(),
        key: "[initial] momentum",
        example: "momentum = [2.0, 0.5, 1.0]",
        option: "another file",
    })?;
    let at = options.at.as_deref().map(|at| Times::read(at, &schedule)).transpose()?;
    // Times alone are recorded alone; a step count in the file is then no request.
    let every = match (options.every, &at) {
        (None, Some(_)) => None,
        (count, _) => Some(every(count.or(run.every).unwrap_or(1))?),
    };
    let events: Vec<Event> = run.events.iter().cloned().map(Event::of).collect();
    if let (Some(event), Some(_)) = (events.first(), &options.checkpoint) {
        let name = &event.name;
        return Err(CliError::Option(format!(
            "--checkpoint: a run that looks for events (`{name}`) cannot be continued; leave one of them out"
        )));
    }
    let looks = run.looks.unwrap_or(1) as u32;
    let (backend, group_element) = (options.backend, run.group_element.clone());
    let estimate = !options.no_estimate && run.estimate != Some(false);
    let setup = Setup::new(schedule, momentum);
    Ok(Setup { every, at, events, looks, backend, estimate, group_element, ..setup })
}

/// The system called `name` of this text with the event of `--until`, at which its run ends. Without it the text has no
/// mistakes.
pub(crate) fn with_end(
    name: &str,
    text: &str,
    function: &str,
    options: Options,
) -> Result<System, CliError> {
    const QUOTE: &str = "'''";
    let refuse = |what: &str| CliError::Option(format!("--until {function}: {what}"));
    if function.contains(QUOTE) {
        return Err(refuse(&format!("no function has {QUOTE} in it")));
    }
    let text = format!("{text}\n[[event]]\nwhen = {QUOTE}{function}{QUOTE}\nstop = true\n");
    let Err(mistakes) = read_either(&text, options, &[]) else {
        return Ok(read_varying(name, &text, options, &[])?);
    };
    let said = |mistake: &Diagnostic| {
        let help = mistake.help().map(|help| format!("\n  help: {help}"));
        mistake.message() + &help.unwrap_or_default()
    };
    Err(refuse(&mistakes.list().iter().map(said).collect::<Vec<_>>().join("; ")))
}

/// Everything a run reads, the system or the model first; tables that the system names are not among them.
pub(crate) fn inputs(options: &SimulateOptions) -> Vec<PathBuf> {
    let times = options.at.iter().map(PathBuf::from);
    let system = options.input.model.clone().unwrap_or_else(|| options.input.source(None).file);
    std::iter::once(system).chain(times).collect()
}

/// Every how many steps a record is written.
pub(crate) fn every(steps: usize) -> Result<u64, CliError> {
    match steps {
        0 => Err(CliError::Option("--every counts steps from 1; try --every 1".to_owned())),
        steps => Ok(steps as u64),
    }
}

/// Refuses names of files that cannot be what they are to be or are inputs, before anything is computed; the target of `--out`.
pub(crate) fn check_names(
    options: &SimulateOptions,
    inputs: &[PathBuf],
) -> Result<Option<Destination>, CliError> {
    let refuse = |what: String| Err(CliError::Option(what));
    let mut used = inputs.to_vec();
    let out = options.out.as_deref().map(|out| Destination::new(out, &used)).transpose()?;
    used.extend(out.iter().flat_map(Destination::names));
    for path in options.plot.iter().chain(&options.checkpoint) {
        file::check(path, &paths(&used)).map_err(unwritten(path))?;
        used.push(path.clone());
    }
    if let Some(plot) = &options.plot {
        let ending = plot.extension().and_then(|ending| ending.to_str());
        if !ending.is_some_and(|ending| ending.eq_ignore_ascii_case("svg")) {
            return refuse(format!(
                "--plot {}: only SVG is drawn; give a name that ends in .svg and convert the picture",
                plot.display()
            ));
        }
    }
    if options.checkpoint.is_none() {
        return Ok(out);
    }
    if options.truncation.len() > 1 {
        return refuse("--checkpoint is of one run: give one --truncation".to_owned());
    }
    if let Some(out) = out.as_ref().filter(|out| out.place != Place::File) {
        return refuse(format!(
            "--checkpoint: what was written to {} cannot be continued; write to a file",
            out.path.display()
        ));
    }
    Ok(out)
}

/// Everything needed to repeat a run, in order: for the heads of files, for reports, and to tell whether a checkpoint is
/// of this run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Header(Vec<(&'static str, Value)>);

impl Header {
    /// The description of a run of this system.
    pub(crate) fn new(settings: &Settings<'_>, system: &Derived) -> Self {
        let Facts { name, algebra, truncation, .. } = system.facts();
        let mut own = vec![
            ("name", json!(name)),
            ("group", json!(algebra.name())),
            ("truncation", json!(truncation)),
        ];
        match system.series() {
            Some(series) => {
                let problem = &series.problem;
                let solver = match problem.solver() {
                    Solver::Newton => Solver::NAMES[0],
                    Solver::FixedPoint => Solver::NAMES[1],
                };
                own.extend([
                    ("chart", json!(problem.chart.name())),
                    ("frame", json!(problem.frame_name())),
                    ("solver", json!(solver)),
                ]);
            }
            None => own.extend([
                ("method", json!("collocation")),
                ("nodes", json!(truncation.div_ceil(2))),
            ]),
        }
        let splitting = system.kicks().map(|kicks| kicks.splitting.name());
        own.extend(splitting.map(|splitting| ("splitting", json!(splitting))));
        own.extend(inputs_hash(system.signals()).map(|hash| ("inputs_sha256", json!(hash))));
        Self::of(settings, ["system", "system_sha256"], own)
    }

    /// The description of a run of a learned map.
    pub(crate) fn of_model(settings: &Settings<'_>, model: &ModelFile) -> Self {
        let own = vec![
            ("kind", json!(model.model.name())),
            ("group", json!(model.group.name())),
            ("chart", json!(model.chart)),
        ];
        Self::of(settings, ["model", "model_sha256"], own)
    }

    /// The entries of its own of a run, between those that every run has.
    fn of(
        settings: &Settings<'_>,
        [file, hash]: [&'static str; 2],
        own: Vec<(&'static str, Value)>,
    ) -> Self {
        let Setup { schedule, momentum, group_element, every, at, events, .. } = &settings.setup;
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
        ]);
        // Absent is 0.
        list.extend((schedule.start != 0.0).then(|| ("initial_time", json!(schedule.start))));
        list.push(("initial_momentum", json!(momentum)));
        let element = group_element.as_ref();
        list.extend(element.map(|rows| ("initial_group_element", json!(rows.concat()))));
        list.extend(every.map(|every| ("every", json!(every))));
        list.extend(at.as_ref().map(|times| ("at", json!(times.text()))));
        let names: Vec<&str> = events.iter().map(|event| event.name.as_str()).collect();
        list.extend((!names.is_empty()).then(|| ("events", json!(names))));
        Self(list)
    }

    /// The description that these entries are.
    pub(crate) fn of_entries(list: Vec<(&'static str, Value)>) -> Self {
        Self(list)
    }

    /// Adds the scales of the drifts that exist.
    pub(crate) fn with_scales(mut self, known: [bool; 3], scales: &Scales) -> Self {
        let list = [
            ("spatial_momentum_scale", json!(scales.spatial_momentum)),
            ("casimir_scales", json!(scales.casimirs)),
            ("energy_scale", json!(scales.energy)),
        ];
        let list = list.into_iter().zip(known);
        self.0.extend(list.filter_map(|(scale, known)| known.then_some(scale)));
        self
    }

    /// The value of this name in words.
    pub(crate) fn text(&self, name: &str) -> String {
        self.get(name).map(text).unwrap_or_default()
    }

    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    /// Lines `name: value`.
    pub(crate) fn lines(&self) -> impl Iterator<Item = String> + '_ {
        self.0.iter().map(|(name, value)| format!("{name}: {}", text(value)))
    }

    pub(crate) fn object(&self) -> Map<String, Value> {
        self.0.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect()
    }

    /// The settings by name, to compare with another run.
    pub(crate) fn identity(&self) -> Identity {
        self.0.iter().map(|(name, value)| ((*name).to_owned(), text(value))).collect()
    }
}

/// Writes a value on one line, numbers as short as they can be.
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
