//! The outputs of a run: records, pictures and checkpoints, and messages to the user.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use coadjoint_codegen::file::Output;
use coadjoint_run::RunError;
use coadjoint_run::simulate::{
    Begun, Block, Halt, Moment, Outcome, Outlet, Record, Resume, Standing, columns,
};
use indicatif::ProgressBar;

use super::checkpoint::{Checkpoint, bits, numbers};
use super::header::Header;
use super::interrupt::Guard;
use super::samples::Samples;
use super::setup::Settings;
use super::sink::Sink;
use super::target::Target;
use super::trajectory::Trajectory;
use crate::error::CliError;
use crate::progress;

/// The outputs of a run.
pub struct Keeper<'a> {
    settings: &'a Settings,
    label: String,
    header: Header,
    coordinates: &'a [String],
    /// Which drifts records have.
    known: [bool; 3],
    /// The file of records, before anything is asked of it.
    output: Option<Output>,
    sink: Option<Sink>,
    /// The moments kept for pictures, if any are.
    samples: Option<Samples>,
    /// The checkpoint that the run goes on from.
    found: Option<Checkpoint>,
    /// When the last checkpoint was written.
    saved: Instant,
    guard: Option<Guard>,
    bar: Option<ProgressBar>,
    shown: Instant,
    phase: Option<progress::Phase>,
    /// Why the run was halted.
    failure: Option<CliError>,
}

impl<'a> Keeper<'a> {
    /// The keeper of a run with this description and these coordinates.
    pub fn new(
        settings: &'a Settings,
        label: String,
        header: Header,
        coordinates: &'a [String],
    ) -> Self {
        let now = Instant::now();
        Self {
            settings,
            label,
            header,
            coordinates,
            known: [false; 3],
            output: None,
            sink: None,
            samples: settings.sampled.then(|| Samples::new(coordinates.len())),
            found: None,
            saved: now,
            guard: None,
            bar: None,
            shown: now,
            phase: None,
            failure: None,
        }
    }

    /// Makes the run by `drive`; what is kept of it.
    ///
    /// # Errors
    /// Why it stopped; the records made so far are kept.
    pub fn follow(
        mut self,
        drive: impl FnOnce(&mut dyn Outlet) -> Result<Outcome, RunError>,
    ) -> Result<Trajectory, CliError> {
        let outcome = drive(&mut self);
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        (self.guard, self.phase) = (None, None);
        let target = self.settings.out.as_ref();
        let (outcome, rows) = match (outcome, self.sink.take()) {
            (Ok(outcome), None) => (outcome, None),
            (Ok(outcome), Some(sink)) => {
                let rows = sink.rows();
                sink.publish()?;
                (outcome, Some(rows))
            }
            (Err(error), sink) => {
                let error = self.failure.take().unwrap_or_else(|| error.into());
                if let Some(sink) = sink {
                    sink.stop(&error.to_string());
                    let part = target.map(Target::part);
                    if let Some(part) = part.filter(|part| part.is_file()) {
                        eprintln!("the records up to there are in {}", part.display());
                    }
                }
                return Err(error);
            }
        };
        let mut trajectory = Trajectory::of(outcome, self.label, self.header, self.coordinates);
        trajectory.records = self.samples.map(Samples::finish).unwrap_or_default();
        trajectory.announcement = self.settings.setup.schedule.announcement();
        trajectory.out = target.zip(rows).map(|(target, rows)| (target.path.clone(), rows));
        Ok(trajectory)
    }

    /// Takes note of a failure.
    fn note<T>(&mut self, outcome: Result<T, CliError>) -> Result<T, Halt> {
        outcome.map_err(|error| {
            self.failure = Some(error);
            Halt
        })
    }

    /// The checkpoint that the run goes on from, if there is one.
    fn find(&mut self, blocks: &[Block]) -> Result<Option<Resume>, CliError> {
        let setup = &self.settings.setup;
        // First of all: what is read below is then not another run's.
        self.output = self.settings.out.as_ref().map(Target::open).transpose()?.flatten();
        let Some((path, _)) = &self.settings.checkpoint else { return Ok(None) };
        let Some(found) = Checkpoint::read(path, &self.identity())? else { return Ok(None) };
        let momentum = numbers(&found.momentum);
        let element = numbers(&found.element);
        let expected: usize = blocks.iter().map(|b| b.range.len().pow(2)).sum();
        let samples = Samples::from_bits(momentum.len(), &found.samples);
        let fits = momentum.len() == setup.momentum.len()
            && element.len() == expected
            && found.step <= setup.schedule.steps
            && samples.is_some() == self.settings.sampled;
        if !fits {
            return Err(CliError::Option(format!(
                "{} does not hold a state of this system: remove it to begin anew",
                path.display()
            )));
        }
        self.samples = samples;
        let resume = Resume {
            step: found.step,
            momentum,
            element,
            own: found.own.as_deref().map(numbers),
            times: found.times,
            tally: found.tally(),
        };
        self.found = Some(found);
        Ok(Some(resume))
    }

    /// Opens the file of records.
    fn open(&mut self, begun: &Begun<'_>) -> Result<(), CliError> {
        self.known = begun.known;
        let names = || columns(self.coordinates, begun);
        let header = || self.header.clone().with_scales(begun.known, begun.scales);
        let target = self.settings.out.as_ref();
        let Some(found) = &self.found else {
            let output = self.output.take();
            let begin = |target| Sink::begin(target, output, header(), names());
            self.sink = target.map(begin).transpose()?;
            return Ok(());
        };
        let output = self.output.take();
        let resume = |target: &Target| {
            // After an earlier end the name may have been given already.
            let fresh = output.as_ref().is_some_and(Output::is_fresh);
            if found.complete && fresh && target.path.exists() {
                return Ok(Sink::done(target, found.rows));
            }
            Sink::resume(target, output, header(), names(), found.extent())
        };
        self.sink = target.map(resume).transpose()?;
        let path = self.settings.checkpoint.as_ref().map(|(path, _)| path.display().to_string());
        let path = path.unwrap_or_default();
        if found.complete {
            eprintln!(
                "this run has finished; its report is made from {path}: remove it to run anew"
            );
        } else {
            let steps = self.settings.setup.schedule.steps;
            eprintln!("going on from {path} at step {} of {steps}", found.step);
        }
        Ok(())
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
        if let Some(sink) = &mut self.sink {
            sink.tick()?;
            if sink.closed() && !self.settings.sampled {
                return Err(CliError::NobodyReads);
            }
        }
        if end {
            if let Some(bar) = &self.bar {
                bar.finish_and_clear();
            }
            if let Some(sink) = &mut self.sink {
                sink.complete()?;
            }
        }
        let stop = !end && self.guard.as_ref().is_some_and(Guard::asked);
        match &self.settings.checkpoint {
            Some((path, interval)) if end || stop || self.saved.elapsed() >= *interval => {
                self.save(path, standing)?;
            }
            _ => {}
        }
        if stop { Err(self.interrupted(n)) } else { Ok(()) }
    }

    /// Writes a checkpoint; the records that it counts are on the disk before.
    fn save(&mut self, path: &Path, standing: &Standing<'_>) -> Result<(), CliError> {
        let state = (standing.state)();
        let vouched = self.sink.as_mut().map(Sink::vouch).transpose()?;
        let (extent, rows) = vouched.unwrap_or_default();
        let mut checkpoint = Checkpoint {
            identity: self.identity(),
            step: state.step,
            momentum: bits(state.momentum.iter().copied()),
            element: bits(state.element.iter().copied()),
            own: state.own.map(|numbers| bits(numbers.iter().copied())),
            bytes: extent.bytes,
            records_crc32: extent.crc32,
            rows,
            times: state.times,
            samples: self.samples.as_ref().map(Samples::to_bits).unwrap_or_default(),
            complete: state.step == self.settings.setup.schedule.steps,
            ..Checkpoint::default()
        };
        checkpoint.set_tally(&state.tally);
        checkpoint.write(path, &self.settings.inputs())?;
        self.saved = Instant::now();
        Ok(())
    }

    /// The settings in which a checkpoint must agree.
    fn identity(&self) -> BTreeMap<String, String> {
        let mut identity = self.header.identity();
        // It follows from the time and the step, whose names say more.
        identity.remove("steps");
        let out = self.settings.out.as_ref();
        let out = out.map_or_else(|| "none".to_owned(), |out| out.path.display().to_string());
        identity.insert("out".to_owned(), out);
        identity.insert("plot".to_owned(), self.settings.sampled.to_string());
        identity
    }

    fn interrupted(&self, step: u64) -> CliError {
        let again = match &self.settings.checkpoint {
            Some((path, _)) => {
                format!("; the same command goes on from {}", path.display())
            }
            None => String::new(),
        };
        let schedule = &self.settings.setup.schedule;
        CliError::Interrupted(format!(
            "interrupted at time {}, after {step} of {} steps{again}",
            schedule.time(step),
            schedule.steps
        ))
    }
}

impl Outlet for Keeper<'_> {
    fn resume(&mut self, blocks: &[Block]) -> Result<Option<Resume>, Halt> {
        let found = self.find(blocks);
        self.note(found)
    }

    fn begin(&mut self, begun: &Begun<'_>) -> Result<(), Halt> {
        let opened = self.open(begun);
        self.note(opened)?;
        if self.found.as_ref().is_none_or(|found| !found.complete) {
            self.guard = Some(Guard::new());
            self.bar = Some(progress::bar(self.settings.setup.schedule.steps, "integrating"));
        }
        (self.saved, self.shown) = (Instant::now(), Instant::now());
        Ok(())
    }

    fn record(&mut self, record: &Record<'_>) -> Result<(), Halt> {
        let Some(sink) = &mut self.sink else { return Ok(()) };
        let drifts = record.drift.numbers().into_iter().zip(self.known);
        let drifts = drifts.filter_map(|(drift, known)| known.then_some(drift));
        let last = record.energy.into_iter().chain(drifts);
        let state = record.momentum.iter().copied().chain((record.element)());
        let written = sink.row(std::iter::once(record.time).chain(state).chain(last));
        self.note(written)
    }

    fn look(&mut self, time: f64, momentum: &[f64], moment: &Moment) {
        if let Some(samples) = &mut self.samples {
            samples.offer(time, momentum, moment.energy.unwrap_or(0.0), moment.drift);
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

    fn phase(&mut self, what: Option<&str>) {
        self.phase = what.map(progress::phase);
    }
}
