//! The run itself: piece after piece, each safe on the disk before it counts.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint_codegen::file::{self, Extent, Output, beside, passing};
use coadjoint_run::ensemble::{Course, Drift, Engine, Rejected, Watch};

use super::journal::{ANEW, Journal};
use super::states::{Piece, States};
use crate::arguments::EnsembleOptions;
use crate::error::{CliError, unwritten};
use crate::form::Form;
use crate::note::{self, Identity};
use crate::progress;

/// The journal is brought up to date this often.
const NOTED: Duration = Duration::from_millis(200);

/// The number of rejected rows named at the end; all are in the list.
const TOLD: usize = 5;

/// The names of the columns of the list of rejected rows.
const LIST: &[u8] = b"row,step,reason\n";

/// A run that is set up.
pub(crate) struct Job<'a, 's> {
    pub options: &'a EnsembleOptions,
    /// Advances rows.
    pub engine: &'a Engine<'s>,
    /// The source of rows.
    pub states: States,
    /// Everything the run reads.
    pub inputs: &'a [&'a Path],
    /// The form in which rows are written.
    pub form: Form,
    /// Rows of the input, counted from 0.
    pub range: Range<u64>,
    /// The steps of each row, and the times at which its states are kept.
    pub course: Course,
    /// The identity of the run.
    pub identity: Identity,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub(crate) struct Completion {
    /// Rows of the output.
    pub trajectories: u64,
    /// Rows already written by an earlier run that was stopped.
    pub resumed: u64,
    /// The first rows without an end state, as far as this run met them.
    pub first: Vec<Rejected>,
    /// The list of them, if there are any.
    pub list: Option<PathBuf>,
    /// The counts and measurements.
    pub journal: Journal,
    /// Seconds of this run.
    pub seconds: f64,
}

/// The names of the files of a run.
pub(crate) struct Files {
    out: PathBuf,
    list: PathBuf,
    journal: PathBuf,
}

impl Files {
    /// Names the files of this output.
    pub(crate) fn of(out: &Path) -> Self {
        Self {
            out: out.into(),
            list: beside(out, ".rejected.csv"),
            journal: beside(out, ".journal"),
        }
    }

    /// Refuses names that are inputs of the run.
    pub(crate) fn check(&self, inputs: &[&Path]) -> Result<(), CliError> {
        let names = [&self.out, &self.list, &self.journal];
        names.iter().try_for_each(|name| file::check(name, inputs).map_err(unwritten(name)))
    }
}

/// A run on its way.
struct Run<'a, 's> {
    job: Job<'a, 's>,
    files: Files,
    /// The files that grow, kept from other processes: the output and the list of rejected rows.
    output: Output,
    list: Output,
    journal: Journal,
    first: Vec<Rejected>,
}

/// Runs from the beginning, or from where an earlier run was stopped.
pub(crate) fn run(job: Job<'_, '_>) -> Result<Completion, CliError> {
    let begun = Instant::now();
    let files = Files::of(&job.options.out);
    // Before anything is read that another process may write.
    let open = |path: &Path| Output::open(path, job.inputs).map_err(unwritten(path));
    let (output, list) = (open(&files.out)?, open(&files.list)?);
    let known: Option<Journal> =
        if job.options.restart { None } else { note::read(&files.journal, "journal", ANEW)? };
    if let Some(known) = &known {
        let advice = format!("go on as then, or {ANEW}");
        note::agree(&files.journal, &known.identity, &job.identity, &advice)?;
    }
    let fresh = || Journal { identity: job.identity.clone(), ..Journal::default() };
    let journal = known.unwrap_or_else(fresh);
    let (resumed, trajectories) = (journal.rows, job.range.end - job.range.start);
    let mut run = Run { job, files, output, list, journal, first: Vec::new() };
    run.resume()?;
    run.advance(trajectories)?;
    run.publish()?;
    let Run { files, first, journal, .. } = run;
    let list = (journal.rejected > 0).then_some(files.list);
    let seconds = begun.elapsed().as_secs_f64();
    Ok(Completion { trajectories, resumed, first, list, journal, seconds })
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), CliError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(unwritten(path)(error)),
        _ => Ok(()),
    }
}

impl Run<'_, '_> {
    /// Goes on behind what the journal counts.
    fn resume(&mut self) -> Result<(), CliError> {
        let both = [(&mut self.output, &self.files.out), (&mut self.list, &self.files.list)];
        for ((output, path), (bytes, crc32)) in both.into_iter().zip(self.journal.files) {
            output.resume(Extent { bytes, crc32 }, 0).map_err(|error| match error.kind() {
                ErrorKind::InvalidData => CliError::Option(format!(
                    "{}: {error}; begin anew with --restart",
                    passing(path).display()
                )),
                _ => unwritten(path)(error),
            })?;
        }
        Ok(())
    }

    /// Adds bytes to the list.
    fn append(&mut self, list: &[u8]) -> Result<(), CliError> {
        self.list.append(list).map_err(unwritten(&passing(&self.files.list)))
    }

    /// Waits until all is on the disk, and notes how much that is.
    fn note(&mut self) -> Result<(), CliError> {
        let synced = self.output.sync().and_then(|()| self.list.sync());
        synced.map_err(unwritten(&self.files.out))?;
        note::write(&self.journal, &self.files.journal, self.job.inputs)
    }

    /// Advances the rows that are left of `count`. What is done is the same whatever the size of the pieces.
    fn advance(&mut self, count: u64) -> Result<(), CliError> {
        let passing = passing(&self.files.out);
        let unwritten = unwritten(&passing);
        if self.journal.rows == 0 {
            self.output.append(&self.job.states.header(count)).map_err(&unwritten)?;
            self.append(LIST)?;
        }
        let position = (self.journal.rows > 0).then_some(self.journal.position);
        self.job.states.seek(self.job.range.start + self.journal.rows, position)?;
        let (engine, steps) = (self.job.engine, self.job.course.steps.max(1));
        let bar = progress::bar(count.saturating_mul(steps), "trajectories");
        let layout = self.job.states.found.layout.clone();
        let earlier = self.journal.redone;
        let (mut piece, stop) = (Piece::default(), AtomicBool::new(false));
        let mut noted = Instant::now();
        self.journal.raise(Drift::default(), engine);
        while self.journal.rows < count {
            let done = self.journal.rows;
            let course = &self.job.course;
            let width = layout.width() * course.kept();
            let take = engine.piece(width, course.steps).min(count - done);
            self.job.states.read(take, &mut piece)?;
            if let Some(sample) = self.job.options.estimate {
                let apart = count.div_ceil(sample);
                let rows = piece.rows.values.chunks(layout.width());
                let chosen = (done..).zip(rows).filter(|(row, _)| row % apart == 0);
                let chosen: Vec<&[f64]> = chosen.map(|(_, row)| row).collect();
                let found = engine.estimates(&layout, self.job.course.steps, &chosen);
                self.journal.note(found);
            }
            let made = |made: u64| {
                bar.set_position(done.saturating_mul(steps).saturating_add(take * made));
            };
            let watch = Watch { made: &made, stop: &stop };
            let drift = engine.advance(&layout, &self.job.course, &mut piece.rows, &watch)?;
            let rejected = &piece.rows.rejected;
            let line =
                |r: &Rejected| format!("{},{},\"{}\"\n", r.row, r.step, r.reason.replace('"', "'"));
            let list: String = rejected.iter().map(line).collect();
            let output = &mut self.output;
            let write = |bytes: &[u8]| output.append(bytes).map_err(&unwritten);
            self.job.states.encode(&piece, write)?;
            self.append(list.as_bytes())?;
            self.first.extend(rejected.iter().take(TOLD - self.first.len()).cloned());
            let journal = &mut self.journal;
            journal.raise(drift, engine);
            journal.redone = earlier + engine.device().map_or(0, |by| by.redone);
            journal.rows += take;
            journal.rejected += rejected.len() as u64;
            journal.position = self.job.states.position();
            let extents = [self.output.extent(), self.list.extent()];
            journal.files = extents.map(|Extent { bytes, crc32 }| (bytes, crc32));
            bar.set_position(journal.rows.saturating_mul(steps));
            if noted.elapsed() > NOTED && journal.rows < count {
                self.note()?;
                noted = Instant::now();
            }
        }
        bar.finish_and_clear();
        self.note()
    }

    /// Gives the files their names, the output's last.
    fn publish(&mut self) -> Result<(), CliError> {
        let Self { job, files, output, list, journal, .. } = self;
        if journal.rejected > 0 {
            list.publish().map_err(unwritten(&files.list))?;
        } else {
            list.discard();
            // An earlier run may have left a list.
            if fs::read(&files.list).is_ok_and(|list| list.starts_with(LIST)) {
                remove(&files.list)?;
            }
        }
        let published = job.form.publish(output, &files.out, &job.states.names(), job.inputs);
        published.map_err(unwritten(&files.out))?;
        remove(&files.journal)
    }
}
