//! The outputs of a run: records, pictures and checkpoints, and messages to the user.

use std::path::Path;
use std::time::Instant;

use coadjoint_run::RunError;
use coadjoint_run::simulate::{Begun, Halt, Moment, Outcome, Record, Resume, Sink, Standing};
use indicatif::ProgressBar;

use super::checkpoint::{ANEW, Checkpoint};
use super::header::Header;
use super::interrupt::Guard;
use super::records::Records;
use super::samples::Samples;
use super::setup::Settings;
use super::target::Target;
use super::trajectory::Trajectory;
use crate::error::CliError;
use crate::note::{self, Identity};
use crate::progress;

/// The outputs of a run.
pub(crate) struct Keeper<'a> {
    settings: &'a Settings,
    header: &'a Header,
    /// Which drifts records have.
    known: [bool; 3],
    records: Option<Records>,
    /// The moments kept for pictures, if any are.
    samples: Option<Samples>,
    /// When the last checkpoint was written.
    saved: Instant,
    guard: Option<Guard>,
    bar: Option<ProgressBar>,
    shown: Instant,
    /// Why the run was halted.
    failure: Option<CliError>,
}

/// Makes a run by `drive`, and keeps its outputs.
///
/// # Errors
/// Why it stopped; the records made so far are kept.
pub(crate) fn keep(
    settings: &Settings,
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
                let part = target.map(Target::part);
                if let Some(part) = part.filter(|part| part.is_file()) {
                    eprintln!("the records up to there are in {}", part.display());
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
        truncation: None,
        coordinates: coordinates.to_vec(),
        records: samples.map(Samples::finish).unwrap_or_default(),
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
        let output = settings.out.as_ref().map(Target::open).transpose()?.flatten();
        let header = self.header.clone().with_scales(begun.known, begun.scales);
        let names = begun.columns();
        let checkpoint = settings.checkpoint.as_ref();
        let found: Option<Checkpoint> = match checkpoint {
            None => None,
            Some((path, _)) => note::read(path, "checkpoint", ANEW)?,
        };
        if let (Some(found), Some((path, _))) = (&found, checkpoint) {
            let advice = "give the same command as then, or another --checkpoint";
            note::agree(path, &found.identity, &self.identity(), advice)?;
            let samples = found.samples.as_ref();
            if samples.is_some_and(|samples| !samples.fits(begun.coordinates.len())) {
                return Err(CliError::Option(format!(
                    "{} does not hold a state of this system: {ANEW}",
                    path.display()
                )));
            }
        }
        let open = |target| Records::open(target, output, header, names, found.as_ref());
        self.records = settings.out.as_ref().map(open).transpose()?;
        let (Some(found), Some((path, _))) = (found, checkpoint) else { return Ok(None) };
        let path = path.display();
        if found.complete {
            eprintln!(
                "this run has finished; its report is made from {path}: remove it to run anew"
            );
        } else {
            let (step, steps) = (found.resume.step, settings.setup.schedule.steps);
            eprintln!("going on from {path} at step {step} of {steps}");
        }
        self.samples = found.samples;
        Ok(Some(found.resume))
    }

    /// Between steps.
    fn tend(&mut self, standing: &Standing<'_>) -> Result<(), CliError> {
        let schedule = &self.settings.setup.schedule;
        let (n, end) = (standing.step, standing.step == schedule.steps);
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
            self.save(path, standing)?;
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
    fn save(&mut self, path: &Path, standing: &Standing<'_>) -> Result<(), CliError> {
        let vouched = self.records.as_mut().map(Records::vouch).transpose()?;
        let (extent, rows) = vouched.unwrap_or_default();
        let checkpoint = Checkpoint {
            identity: self.identity(),
            resume: (standing.state)(),
            bytes: extent.bytes,
            records_crc32: extent.crc32,
            rows,
            samples: self.samples.clone(),
            complete: standing.step == self.settings.setup.schedule.steps,
        };
        note::write(&checkpoint, path, &self.settings.inputs())?;
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
        let last = record.moment.energy.into_iter().chain(drifts);
        let state = record.momentum.iter().copied().chain((record.element)());
        let written = records.row(std::iter::once(record.time).chain(state).chain(last));
        self.note(written)
    }

    fn look(&mut self, time: f64, momentum: &[f64], moment: &Moment) {
        if let Some(samples) = &mut self.samples {
            samples.offer(time, momentum, moment.drift);
        }
    }

    fn pause(&mut self, standing: &Standing<'_>) -> Result<(), Halt> {
        let tended = self.tend(standing);
        self.note(tended)
    }

    fn warn(&mut self, text: &str) {
        let tell = || eprintln!("warning: {text}");
        match &self.bar {
            Some(bar) => bar.suspend(tell),
            None => tell(),
        }
    }
}
