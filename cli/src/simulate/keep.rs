//! The outputs of a run: records, pictures and checkpoints, and messages to the user.

use std::path::{Path, PathBuf};
use std::time::Instant;

use coadjoint_run::RunError;
use coadjoint_run::simulate::{Begun, Halt, Moment, Outcome, Record, Resume, Sink};
use indicatif::ProgressBar;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::interrupt::Guard;
use super::records::{Checkpoint, Records};
use super::samples::{Sample, Samples};
use super::settings::{Header, Settings};
use super::target::{Destination, paths};
use crate::error::CliError;
use crate::note::{self, Identity};
use crate::progress;

/// The way to forget an earlier run.
pub(super) const ANEW: &str = "remove it to begin anew";

/// Advice on a checkpoint of another run.
const AGAIN: &str = "give the same command as then, or another --checkpoint";

/// A run that has ended, for reports and pictures.
#[derive(Clone, Debug)]
pub(crate) struct Trajectory {
    /// The method.
    pub label: String,
    pub header: Header,
    /// Names of the momentum's coordinates.
    pub coordinates: Vec<String>,
    /// A bounded choice of the moments of the run, the start first and the end last; empty where no picture is
    /// asked for.
    pub samples: Vec<Sample>,
    /// A line about the step, where another was used than was asked for.
    pub announcement: Option<String>,
    /// The end, and the maxima over all steps.
    pub outcome: Outcome,
    /// The file with the records, and how many there are.
    pub out: Option<(PathBuf, u64)>,
}

/// The outputs of a run that is going on.
pub(super) struct Keeper<'a> {
    settings: &'a Settings<'a>,
    header: Header,
    /// The entries in which a checkpoint must agree.
    identity: Identity,
    /// Which drifts records have.
    known: [bool; 3],
    records: Option<Records>,
    /// The numbers of a record.
    row: Vec<f64>,
    /// The moments kept for pictures, if any are.
    samples: Option<Samples>,
    /// When the last checkpoint was written.
    saved: Instant,
    guard: Option<Guard>,
    bar: Option<ProgressBar>,
    shown: Instant,
    /// The error that halted the run.
    failure: Option<CliError>,
}

/// Makes a run by `drive`, and keeps its outputs; where it stops, the records made so far are kept.
pub(crate) fn keep(
    settings: &Settings<'_>,
    label: String,
    header: Header,
    coordinates: &[String],
    drive: impl FnOnce(&mut dyn Sink) -> Result<Outcome, RunError>,
) -> Result<Trajectory, CliError> {
    let samples = settings.sampled.then(|| Samples::new(coordinates.len()));
    let mut keeper = Keeper { samples, ..Keeper::new(settings, header.clone()) };
    let outcome = drive(&mut keeper);
    let samples = keeper.samples.take();
    let (outcome, rows) = keeper.close(outcome)?;
    Ok(Trajectory {
        label,
        header,
        coordinates: coordinates.to_vec(),
        samples: samples.map(Samples::finish).unwrap_or_default(),
        announcement: settings.setup.schedule.announcement(),
        outcome,
        out: settings.out.as_ref().zip(rows).map(|(target, rows)| (target.path.clone(), rows)),
    })
}

impl<'a> Keeper<'a> {
    pub(super) fn new(settings: &'a Settings<'a>, header: Header) -> Self {
        let now = Instant::now();
        Self {
            settings,
            header,
            identity: Identity::new(),
            known: [false; 3],
            records: None,
            row: Vec::new(),
            samples: None,
            saved: now,
            guard: None,
            bar: None,
            shown: now,
            failure: None,
        }
    }

    /// Opens the file of records, and goes on from a checkpoint if there is one, of which `step` tells the number of steps. `own`
    /// is an entry in which it must agree besides those of the header.
    pub(super) fn open<R: DeserializeOwned>(
        &mut self,
        (own, value): (&str, String),
        columns: Vec<String>,
        step: impl Fn(&R) -> u64,
    ) -> Result<Option<R>, CliError> {
        let settings = self.settings;
        // First of all: what is read below is then not another run's.
        let output = settings.out.as_ref().map(Destination::open).transpose()?.flatten();
        self.identity = self.header.identity();
        // It follows from the time and the step, whose names say more.
        self.identity.remove("steps");
        let out = settings.out.as_ref().map(|out| out.path.display().to_string());
        self.identity.insert("out".to_owned(), out.unwrap_or_else(|| "none".to_owned()));
        self.identity.insert(own.to_owned(), value);
        let path = settings.checkpoint.as_ref().map(|(path, _)| path);
        let found = path.map(|path| note::read(path, "checkpoint", ANEW)).transpose()?.flatten();
        let (mut done, steps) = (0, settings.setup.schedule.steps);
        if let (Some(path), Some(Checkpoint::<R> { identity, resume, complete, .. })) =
            (path, &found)
        {
            note::agree(path, identity, &self.identity, AGAIN)?;
            let path = path.display();
            done = step(resume);
            match complete {
                true => errln!(
                    "this run has finished; its report is made from {path}: remove it to run anew"
                ),
                false => errln!("going on from {path} at step {done} of {steps}"),
            }
        }
        if let Some(target) = &settings.out {
            let header = self.header.clone();
            self.records = Some(Records::open(target, output, header, columns, found.as_ref())?);
        }
        if done < steps {
            self.guard = Some(Guard::new());
            self.bar = Some(progress::bar(steps, "integrating"));
        }
        (self.saved, self.shown) = (Instant::now(), Instant::now());
        let Some(found) = found else { return Ok(None) };
        self.samples = found.samples;
        Ok(Some(found.resume))
    }

    /// Adds a record.
    pub(super) fn row(&mut self, numbers: &[f64]) -> Result<(), CliError> {
        self.records.as_mut().map_or(Ok(()), |records| records.row(numbers))
    }

    /// Between steps, and at the end; `state` is what the run needs to go on from here, if it can.
    pub(super) fn tend<R: Serialize>(
        &mut self,
        n: u64,
        end: bool,
        state: Option<&dyn Fn() -> R>,
    ) -> Result<(), CliError> {
        let schedule = &self.settings.setup.schedule;
        if let Some(bar) = self.bar.as_ref().filter(|_| self.shown.elapsed() >= progress::INTERVAL)
        {
            bar.set_position(n);
            self.shown = Instant::now();
        }
        if let Some(records) = &mut self.records {
            records.tick()?;
            if records.closed() && !self.settings.sampled {
                return Err(CliError::NobodyReads);
            }
            if end {
                records.complete()?;
            }
        }
        let stop = !end && self.guard.as_ref().is_some_and(Guard::asked);
        let checkpoint = self.settings.checkpoint.as_ref();
        if let (Some((path, interval)), Some(state)) = (checkpoint, state)
            && (end || stop || self.saved.elapsed() >= *interval)
        {
            self.save(path, end, state())?;
        }
        // With checkpoints the run ends where one can be made.
        if !stop || checkpoint.is_some() && state.is_none() {
            return Ok(());
        }
        let again = checkpoint.map(|(path, _)| path.display());
        let again = again.map(|path| format!("; the same command goes on from {path}"));
        Err(CliError::Interrupted(format!(
            "interrupted at time {}, after {n} of {} steps{}",
            schedule.time(n),
            schedule.steps,
            again.unwrap_or_default()
        )))
    }

    /// Writes a checkpoint; the records that it counts are on the disk before.
    fn save<R: Serialize>(
        &mut self,
        path: &Path,
        complete: bool,
        resume: R,
    ) -> Result<(), CliError> {
        let vouched = self.records.as_mut().map(Records::vouch).transpose()?;
        let (extent, rows) = vouched.unwrap_or_default();
        let checkpoint = Checkpoint {
            identity: self.identity.clone(),
            resume,
            bytes: extent.bytes,
            records_crc32: extent.crc32,
            rows,
            samples: self.samples.clone(),
            complete,
        };
        note::write(&checkpoint, path, &paths(&self.settings.inputs))?;
        self.saved = Instant::now();
        Ok(())
    }

    /// Takes note of a failure.
    pub(super) fn note<T>(&mut self, outcome: Result<T, CliError>) -> Result<T, Halt> {
        outcome.map_err(|error| {
            self.failure = Some(error);
            Halt
        })
    }

    /// The outcome of the run, and the number of records, whose file has its name then; where the run stopped, those made so far
    /// are kept.
    pub(super) fn close<T>(
        self,
        outcome: Result<T, RunError>,
    ) -> Result<(T, Option<u64>), CliError> {
        self.bar.inspect(ProgressBar::finish_and_clear);
        let error = match outcome {
            Ok(outcome) => {
                let rows = self.records.as_ref().map(Records::rows);
                self.records.map_or(Ok(()), Records::publish)?;
                return Ok((outcome, rows));
            }
            Err(error) => self.failure.unwrap_or_else(|| error.into()),
        };
        if let Some(records) = self.records {
            records.stop(&error.to_string());
            let part = self.settings.out.as_ref().map(Destination::part);
            if let Some(part) = part.filter(|part| part.is_file()) {
                errln!("the records up to there are in {}", part.display());
            }
        }
        Err(error)
    }
}

impl Sink for Keeper<'_> {
    fn begin(&mut self, begun: &Begun<'_>) -> Result<Option<Resume>, Halt> {
        self.known = begun.known;
        self.header = self.header.clone().with_scales(begun.known, begun.scales);
        let plot = ("plot", self.settings.sampled.to_string());
        let opened = self.open(plot, begun.columns(), |resume: &Resume| resume.step);
        let fits = |samples: &Samples| samples.fits(begun.coordinates.len());
        let opened = match (&self.settings.checkpoint, self.samples.as_ref().is_none_or(fits)) {
            (Some((path, _)), false) => {
                let what = "does not hold a state of this system";
                Err(CliError::Option(format!("{} {what}: {ANEW}", path.display())))
            }
            _ => opened,
        };
        self.note(opened)
    }

    fn record(&mut self, record: &Record<'_>) -> Result<(), Halt> {
        let drifts = record.moment.drift.numbers().into_iter().zip(self.known);
        let drifts = drifts.filter_map(|(drift, known)| known.then_some(drift));
        self.row.clear();
        self.row.push(record.time);
        self.row.extend_from_slice(record.momentum);
        self.row.extend_from_slice(record.element);
        self.row.extend(record.moment.energy);
        self.row.extend(drifts);
        let written = self.records.as_mut().map_or(Ok(()), |records| records.row(&self.row));
        self.note(written)
    }

    fn look(&mut self, time: f64, momentum: &[f64], moment: &Moment) {
        if let Some(samples) = &mut self.samples {
            samples.offer(time, momentum, moment.drift);
        }
    }

    fn pause(&mut self, steps: u64, end: bool, state: &dyn Fn() -> Resume) -> Result<(), Halt> {
        let tended = self.tend(steps, end, Some(state));
        self.note(tended)
    }

    fn stop(&mut self) -> bool {
        self.guard.as_ref().is_some_and(Guard::asked)
    }

    fn warn(&mut self, text: &str) {
        let tell = || errln!("warning: {text}");
        match &self.bar {
            Some(bar) => bar.suspend(tell),
            None => tell(),
        }
    }
}
