//! The outputs of a run: records, pictures and checkpoints, and messages to the user.

use std::path::{Path, PathBuf};
use std::time::Instant;

use coadjoint_run::RunError;
use coadjoint_run::simulate::{Begun, Halt, Moment, Outcome, Record, Resume, Sink};
use indicatif::ProgressBar;

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
pub(super) const AGAIN: &str = "give the same command as then, or another --checkpoint";

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
struct Keeper<'a> {
    settings: &'a Settings<'a>,
    header: &'a Header,
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
    let now = Instant::now();
    let mut keeper = Keeper {
        settings,
        header: &header,
        known: [false; 3],
        records: None,
        row: Vec::new(),
        samples: settings.sampled.then(|| Samples::new(coordinates.len())),
        saved: now,
        guard: None,
        bar: None,
        shown: now,
        failure: None,
    };
    let outcome = drive(&mut keeper);
    let Keeper { records, samples, failure, bar, .. } = keeper;
    bar.inspect(ProgressBar::finish_and_clear);
    let target = settings.out.as_ref();
    let outcome = match outcome {
        Ok(outcome) => outcome,
        Err(error) => {
            let error = failure.unwrap_or_else(|| error.into());
            if let Some(records) = records {
                records.stop(&error.to_string());
                let part = target.map(Destination::part);
                if let Some(part) = part.filter(|part| part.is_file()) {
                    errln!("the records up to there are in {}", part.display());
                }
            }
            return Err(error);
        }
    };
    let rows = records.as_ref().map(Records::rows);
    records.map_or(Ok(()), Records::publish)?;
    Ok(Trajectory {
        label,
        header,
        coordinates: coordinates.to_vec(),
        samples: samples.map(Samples::finish).unwrap_or_default(),
        announcement: settings.setup.schedule.announcement(),
        outcome,
        out: target.zip(rows).map(|(target, rows)| (target.path.clone(), rows)),
    })
}

impl Keeper<'_> {
    /// Opens the file of records, and goes on from a checkpoint if there is one.
    fn open(&mut self, begun: &Begun<'_>) -> Result<Option<Resume>, CliError> {
        self.known = begun.known;
        let settings = self.settings;
        // First of all: what is read below is then not another run's.
        let output = settings.out.as_ref().map(Destination::open).transpose()?.flatten();
        let header = self.header.clone().with_scales(begun.known, begun.scales);
        let path = settings.checkpoint.as_ref().map(|(path, _)| path.as_path());
        let found = match path {
            None => None,
            Some(path) => note::read::<Checkpoint>(path, "checkpoint", ANEW)?.map(|f| (path, f)),
        };
        if let Some((path, found)) = &found {
            note::agree(path, &found.identity, &self.identity(), AGAIN)?;
            let samples = found.samples.as_ref();
            if samples.is_some_and(|samples| !samples.fits(begun.coordinates.len())) {
                return Err(CliError::Option(format!(
                    "{} does not hold a state of this system: {ANEW}",
                    path.display()
                )));
            }
        }
        if let Some(target) = &settings.out {
            let found = found.as_ref().map(|(_, found)| found);
            self.records = Some(Records::open(target, output, header, begun.columns(), found)?);
        }
        let Some((path, found)) = found else { return Ok(None) };
        let path = path.display();
        if found.complete {
            errln!("this run has finished; its report is made from {path}: remove it to run anew");
        } else {
            let (step, steps) = (found.resume.step, settings.setup.schedule.steps);
            errln!("going on from {path} at step {step} of {steps}");
        }
        self.samples = found.samples;
        Ok(Some(found.resume))
    }

    /// Between steps.
    fn tend(&mut self, n: u64, end: bool, state: &dyn Fn() -> Resume) -> Result<(), CliError> {
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
        if let Some((path, interval)) = checkpoint
            && (end || stop || self.saved.elapsed() >= *interval)
        {
            self.save(path, end, state())?;
        }
        if !stop {
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
    fn save(&mut self, path: &Path, complete: bool, resume: Resume) -> Result<(), CliError> {
        let vouched = self.records.as_mut().map(Records::vouch).transpose()?;
        let (extent, rows) = vouched.unwrap_or_default();
        let checkpoint = Checkpoint {
            identity: self.identity(),
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

    /// The entries in which a checkpoint must agree.
    fn identity(&self) -> Identity {
        let mut identity = self.header.identity();
        // It follows from the time and the step, whose names say more.
        identity.remove("steps");
        let out = self.settings.out.as_ref();
        let out = out.map_or_else(|| "none".to_owned(), |out| out.path.display().to_string());
        identity.insert("out".to_owned(), out);
        identity.insert("plot".to_owned(), self.settings.sampled.to_string());
        identity
    }

    /// Takes note of a failure.
    fn note<T>(&mut self, outcome: Result<T, CliError>) -> Result<T, Halt> {
        outcome.map_err(|error| {
            self.failure = Some(error);
            Halt
        })
    }
}

impl Sink for Keeper<'_> {
    fn begin(&mut self, begun: &Begun<'_>) -> Result<Option<Resume>, Halt> {
        let opened = self.open(begun);
        let found = self.note(opened)?;
        let steps = self.settings.setup.schedule.steps;
        if found.as_ref().is_none_or(|found| found.step < steps) {
            self.guard = Some(Guard::new());
            self.bar = Some(progress::bar(steps, "integrating"));
        }
        (self.saved, self.shown) = (Instant::now(), Instant::now());
        Ok(found)
    }

    fn record(&mut self, record: &Record<'_>) -> Result<(), Halt> {
        let Some(records) = &mut self.records else { return Ok(()) };
        let drifts = record.moment.drift.numbers().into_iter().zip(self.known);
        let drifts = drifts.filter_map(|(drift, known)| known.then_some(drift));
        self.row.clear();
        self.row.push(record.time);
        self.row.extend_from_slice(record.momentum);
        self.row.extend_from_slice(record.element);
        self.row.extend(record.moment.energy);
        self.row.extend(drifts);
        let written = records.row(&self.row);
        self.note(written)
    }

    fn look(&mut self, time: f64, momentum: &[f64], moment: &Moment) {
        if let Some(samples) = &mut self.samples {
            samples.offer(time, momentum, moment.drift);
        }
    }

    fn pause(&mut self, steps: u64, end: bool, state: &dyn Fn() -> Resume) -> Result<(), Halt> {
        let tended = self.tend(steps, end, state);
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
