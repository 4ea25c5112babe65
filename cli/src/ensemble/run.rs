//! The run itself: piece after piece, each safe on the disk before it counts.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint_codegen::file::{self, Extent, Output, beside, passing};
use coadjoint_run::ensemble::{Course, Drift, Engine, Rejected, Watch};

use super::journal::{ANEW, Finished, Journal};
use super::states::{Piece, States};
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
pub(crate) struct Job<'a> {
    /// Advances rows.
    pub engine: &'a Engine<'a>,
    /// Where rows come from.
    pub states: States,
    /// Everything the run reads.
    pub inputs: [&'a Path; 2],
    /// Where rows go, and in which form.
    pub out: &'a Path,
    pub form: Form,
    /// Rows of the input, counted from 0.
    pub range: Range<u64>,
    /// How far rows go, and where their states are kept.
    pub course: Course,
    /// Of how many rows the error at the end is estimated.
    pub estimate: Option<u64>,
    /// The identity of the run.
    pub identity: Identity,
    /// Forget what an earlier run has done.
    pub restart: bool,
    /// Keep what an earlier run has finished.
    pub keep: bool,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    /// Rows of the output.
    pub trajectories: u64,
    /// Rows already written by an earlier run that was stopped.
    pub resumed: u64,
    /// Whether an earlier run had finished, and its files are kept.
    pub kept: bool,
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
    /// A Parquet file that is whole but for its name.
    parquet: PathBuf,
    list: PathBuf,
    journal: PathBuf,
    done: PathBuf,
}

impl Files {
    /// Of this output.
    pub(crate) fn of(out: &Path) -> Self {
        Self {
            out: out.into(),
            parquet: passing(&beside(out, ".parquet")),
            list: beside(out, ".rejected.csv"),
            journal: beside(out, ".journal"),
            done: beside(out, ".done"),
        }
    }

    /// Refuses names that are inputs of the run.
    pub(crate) fn check(&self, inputs: &[&Path]) -> Result<(), CliError> {
        let names = [&self.out, &self.parquet, &self.list, &self.journal, &self.done];
        names.iter().try_for_each(|name| file::check(name, inputs).map_err(unwritten(name)))
    }
}

/// A run on its way.
struct Run<'a> {
    job: Job<'a>,
    files: Files,
    /// The files that grow, kept from other processes: the output and the list of rejected rows.
    output: Output,
    list: Output,
    journal: Journal,
    first: Vec<Rejected>,
}

/// Runs from the beginning, or from where an earlier run was stopped; or keeps what one has finished.
pub(crate) fn run(job: Job<'_>) -> Result<Outcome, CliError> {
    let begun = Instant::now();
    let files = Files::of(job.out);
    // Before anything is read that another process may write.
    let open = |path: &Path| Output::open(path, &job.inputs).map_err(unwritten(path));
    let (output, list) = (open(&files.out)?, open(&files.list)?);
    let (trajectories, finished) = (job.range.end - job.range.start, finished(&job, &files)?);
    let outcome = |resumed, kept, files: Files, first, journal: Journal| Outcome {
        trajectories,
        resumed,
        kept,
        first,
        list: (journal.rejected > 0).then_some(files.list),
        journal,
        seconds: begun.elapsed().as_secs_f64(),
    };
    if let Some(journal) = finished {
        return Ok(outcome(trajectories, true, files, Vec::new(), journal));
    }
    let known: Option<Journal> =
        if job.restart { None } else { note::read(&files.journal, "journal", ANEW)? };
    if let Some(known) = &known {
        known.check(&files.journal, &job.identity)?;
    }
    let fresh = || Journal { identity: job.identity.clone(), ..Journal::default() };
    let journal = known.unwrap_or_else(fresh);
    let resumed = journal.rows;
    let mut run = Run { job, files, output, list, journal, first: Vec::new() };
    // After the last note only names are left to change; the files may have theirs already.
    if !run.journal.complete {
        run.resume()?;
        run.advance(trajectories)?;
        run.seal()?;
    }
    run.publish()?;
    let Run { files, first, journal, .. } = run;
    Ok(outcome(resumed, false, files, first, journal))
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), CliError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(unwritten(path)(error)),
        _ => Ok(()),
    }
}

/// The journal of a finished run that is kept; `None` where the run has to be made.
fn finished(job: &Job<'_>, files: &Files) -> Result<Option<Journal>, CliError> {
    if !job.keep || job.restart {
        return Ok(None);
    }
    let Some(done) = note::read::<Finished>(&files.done, "note", ANEW)? else { return Ok(None) };
    done.journal.check(&files.done, &job.identity)?;
    if done.is_whole(&files.out, &files.list)? {
        return Ok(Some(done.journal));
    }
    let (out, done) = (files.out.display(), files.done.display());
    eprintln!("{out} is not what {done} says: it is made again");
    Ok(None)
}

impl Run<'_> {
    /// Goes on behind what the journal counts.
    fn resume(&mut self) -> Result<(), CliError> {
        let both = [(&mut self.output, &self.files.out), (&mut self.list, &self.files.list)];
        for ((output, path), extent) in both.into_iter().zip(self.journal.extents()) {
            output.resume(extent, 0).map_err(|error| match error.kind() {
                ErrorKind::InvalidData => CliError::Option(format!(
                    "{}: {error}; begin anew with --restart",
                    passing(path).display()
                )),
                _ => unwritten(path)(error),
            })?;
        }
        Ok(())
    }

    /// Adds bytes to the output and to the list.
    fn append(&mut self, rows: &[u8], list: &[u8]) -> Result<(), CliError> {
        self.output.append(rows).map_err(unwritten(&passing(&self.files.out)))?;
        self.list.append(list).map_err(unwritten(&passing(&self.files.list)))
    }

    /// Waits until all is on the disk, and notes how much that is.
    fn note(&mut self) -> Result<(), CliError> {
        let synced = self.output.sync().and_then(|()| self.list.sync());
        synced.map_err(unwritten(&self.files.out))?;
        note::write(&self.journal, &self.files.journal, &self.job.inputs)
    }

    /// Advances the rows that are left of `count`. What is done is the same whatever the size of the pieces.
    fn advance(&mut self, count: u64) -> Result<(), CliError> {
        if self.journal.rows == 0 {
            self.append(&self.job.states.header(count), LIST)?;
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
            if let Some(sample) = self.job.estimate {
                let apart = count.div_ceil(sample);
                let rows = piece.rows.values.chunks(layout.width());
                let chosen = (done..).zip(rows).filter(|(row, _)| row % apart == 0);
                let chosen: Vec<&[f64]> = chosen.map(|(_, row)| row).collect();
                let found = engine.estimates(&layout, self.job.course.steps, &chosen);
                self.journal.estimates.extend(found.into_iter().flatten());
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
            self.append(&self.job.states.encode(&piece), list.as_bytes())?;
            self.first.extend(rejected.iter().take(TOLD - self.first.len()).cloned());
            let journal = &mut self.journal;
            journal.raise(drift, engine);
            journal.redone = earlier + engine.device().map_or(0, |by| by.redone);
            journal.rows += take;
            journal.rejected += rejected.len() as u64;
            journal.position = self.job.states.position();
            let Extent { bytes, crc32 } = self.output.extent();
            (journal.output, journal.output_crc32) = (bytes, crc32);
            let Extent { bytes, crc32 } = self.list.extent();
            (journal.rejected_bytes, journal.rejected_crc32) = (bytes, crc32);
            bar.set_position(journal.rows.saturating_mul(steps));
            if noted.elapsed() > NOTED && journal.rows < count {
                self.note()?;
                noted = Instant::now();
            }
        }
        bar.finish_and_clear();
        Ok(())
    }

    /// Notes that everything is written.
    fn seal(&mut self) -> Result<(), CliError> {
        let whole = match self.job.form {
            #[cfg(feature = "parquet")]
            Form::Parquet => {
                let Files { out, parquet, .. } = &self.files;
                let written = Output::open_as(out, parquet, &self.job.inputs);
                let written = written.and_then(|mut to| {
                    self.output.sync()?;
                    crate::form::to_parquet(&passing(out), &self.job.states.names(), &mut to)?;
                    Ok(to.extent())
                });
                written.map_err(unwritten(parquet))?
            }
            _ => self.output.extent(),
        };
        self.journal.complete = true;
        self.journal.whole = [whole.bytes, u64::from(whole.crc32)];
        self.note()
    }

    /// Gives the files their names, the output's last. Those of an earlier run that ended between two of them may have
    /// theirs already.
    fn publish(&mut self) -> Result<(), CliError> {
        let Self { job, files, output, list, journal, .. } = self;
        let [bytes, crc32] = journal.whole;
        let whole = Extent { bytes, crc32: crc32 as u32 };
        let name = |output: &mut Output, path: &Path, whole: Extent| {
            if output.is_fresh() && file::extent(path).is_ok_and(|found| found == whole) {
                return Ok(());
            }
            let known = if output.is_begun() { Ok(()) } else { output.resume(whole, 0) };
            known.and_then(|()| output.publish()).map_err(|error| match error.kind() {
                ErrorKind::InvalidData => CliError::Option(format!(
                    "{} says that {} is written, but {error}; begin anew with --restart",
                    files.journal.display(),
                    path.display()
                )),
                _ => unwritten(path)(error),
            })
        };
        remove(&files.done)?;
        if journal.rejected > 0 {
            name(list, &files.list, journal.extents()[1])?;
        } else {
            list.discard();
            // That of an earlier run.
            if fs::read(&files.list).is_ok_and(|list| list.starts_with(LIST)) {
                remove(&files.list)?;
            }
        }
        match job.form {
            #[cfg(feature = "parquet")]
            Form::Parquet => {
                let parquet = Output::open_as(&files.out, &files.parquet, &job.inputs);
                name(&mut parquet.map_err(unwritten(&files.parquet))?, &files.out, whole)?;
                // The numbers have served.
                output.discard();
            }
            _ => name(output, &files.out, whole)?,
        }
        if job.keep {
            let first_row = job.range.start + 1;
            let done = Finished::of(&files.out, &files.list, first_row, journal.clone())?;
            note::write(&done, &files.done, &job.inputs)?;
        }
        remove(&files.journal)
    }
}
