//! The run itself: piece after piece, each safe on the disk before it counts.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint_codegen::file::{self, Extent, Output, beside, passing};
use coadjoint_run::ensemble::{Drift, Engine, Layout, Rejected, Watch, piece as length};

use super::finished::Finished;
use super::input::Input;
use super::journal::{Identity, Journal};
use super::output::Form;
use super::table::Piece;
use crate::error::{CliError, unwritten};
use crate::progress;

/// The journal is brought up to date this often.
const NOTED: Duration = Duration::from_millis(200);

/// The number of rejected rows named at the end; all are in the list.
const TOLD: usize = 5;

/// The names of the columns of the list of rejected rows.
const LIST: &[u8] = b"row,step,reason\n";

/// A run that is set up.
pub struct Job<'a> {
    /// Advances rows.
    pub engine: &'a dyn Engine,
    /// Where rows come from.
    pub input: Box<dyn Input>,
    /// Everything the run reads.
    pub inputs: Vec<PathBuf>,
    /// Where rows go.
    pub out: PathBuf,
    /// Rows of the input, counted from 0.
    pub range: Range<u64>,
    /// Steps of every trajectory.
    pub steps: u64,
    /// The identity of the run.
    pub identity: Identity,
    /// Forget what an earlier run has done.
    pub restart: bool,
    /// Keep what an earlier run has finished.
    pub keep: bool,
}

/// The outcome of a run.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Rows of the output.
    pub trajectories: u64,
    /// Rows already written by an earlier run that was stopped.
    pub resumed: u64,
    /// Whether an earlier run had finished, and its files are kept.
    pub kept: bool,
    /// Rows without an end state.
    pub failed: u64,
    /// The first of them, as far as this run met them.
    pub first: Vec<Rejected>,
    /// The list of them, if there are any.
    pub list: Option<PathBuf>,
    /// The largest drifts.
    pub drift: Drift,
    /// The backends that have made the steps.
    pub made_by: Vec<String>,
    /// Rows of which a device has refused steps that others then made.
    pub redone: u64,
    /// Seconds of this run.
    pub seconds: f64,
}

/// The names of the files of a run.
pub struct Files {
    out: PathBuf,
    /// A Parquet file that is whole but for its name.
    parquet: PathBuf,
    list: PathBuf,
    journal: PathBuf,
    done: PathBuf,
}

impl Files {
    /// Of this output.
    pub fn of(out: &Path) -> Self {
        Self {
            out: out.into(),
            parquet: passing(&beside(out, ".parquet")),
            list: beside(out, ".rejected.csv"),
            journal: beside(out, ".journal"),
            done: beside(out, ".done"),
        }
    }

    /// Refuses names that are inputs of the run.
    pub fn check(&self, inputs: &[&Path]) -> Result<(), CliError> {
        let names = [&self.out, &self.parquet, &self.list, &self.journal, &self.done];
        names.iter().try_for_each(|name| file::check(name, inputs).map_err(unwritten(name)))
    }
}

/// The files that grow, and kept from other processes.
struct Open {
    output: Output,
    list: Output,
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), CliError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(unwritten(path)(error)),
        _ => Ok(()),
    }
}

/// Runs from the beginning, or from where an earlier run was stopped; or keeps what one has finished.
pub fn run(mut job: Job<'_>) -> Result<Outcome, CliError> {
    let start = Instant::now();
    let form = Form::of(&job.out)?;
    let layout = job.input.layout();
    let files = Files::of(&job.out);
    let inputs = job.inputs.clone();
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    let count = job.range.end - job.range.start;
    // Before anything is read that another process may write.
    let open = |path: &Path| Output::open(path, &inputs).map_err(unwritten(path));
    let mut open = Open { output: open(&files.out)?, list: open(&files.list)? };
    if let Some(journal) = finished(&job, &files)? {
        return Ok(outcome(count, (count, true), journal, files, Vec::new(), start));
    }
    let fresh = Journal { identity: job.identity.clone(), ..Journal::default() };
    let known = if job.restart { None } else { Journal::read(&files.journal)? };
    if let Some(known) = &known {
        known.check(&files.journal, &job.identity)?;
    }
    let resumed = known.as_ref().map_or(0, |journal| journal.rows);
    let mut journal = known.unwrap_or(fresh);
    let mut first = Vec::new();
    // After the last note only names are left to change; the files may have theirs already.
    if !journal.complete {
        resume(&mut open, &files, &journal)?;
        first = advance(&mut job, form, &layout, (&files, &inputs), &mut journal, &mut open)?;
        seal(form, &layout, (&files, &inputs), count, &mut journal, &open)?;
    }
    remove(&files.done)?;
    publish(form, (&files, &inputs), &journal, &mut open)?;
    if job.keep {
        let first_row = job.range.start + 1;
        let done = Finished::of(&files.out, &files.list, first_row, journal.clone())?;
        done.write(&files.done, &inputs)?;
    }
    remove(&files.journal)?;
    Ok(outcome(count, (resumed, false), journal, files, first, start))
}

/// Goes on behind what the journal counts.
fn resume(open: &mut Open, files: &Files, journal: &Journal) -> Result<(), CliError> {
    let extents = [journal.extent(), journal.rejected_extent()];
    let both = [(&mut open.output, &files.out), (&mut open.list, &files.list)];
    for ((output, path), extent) in both.into_iter().zip(extents) {
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

/// The journal of a finished run that is kept; `None` where the run has to be made.
fn finished(job: &Job<'_>, files: &Files) -> Result<Option<Journal>, CliError> {
    if !job.keep || job.restart {
        return Ok(None);
    }
    let Some(done) = Finished::read(&files.done)? else { return Ok(None) };
    done.journal.check(&files.done, &job.identity)?;
    if done.is_whole(&files.out, &files.list)? {
        return Ok(Some(done.journal));
    }
    eprintln!(
        "{} is not what {} says: it is made again",
        files.out.display(),
        files.done.display()
    );
    Ok(None)
}

fn outcome(
    trajectories: u64,
    (resumed, kept): (u64, bool),
    journal: Journal,
    files: Files,
    first: Vec<Rejected>,
    start: Instant,
) -> Outcome {
    Outcome {
        trajectories,
        resumed,
        kept,
        failed: journal.rejected,
        first,
        list: (journal.rejected > 0).then_some(files.list),
        drift: journal.drift(),
        made_by: journal.made_by,
        redone: journal.redone,
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// Advances the rows that are left. What is done is the same whatever the size of the pieces.
fn advance(
    job: &mut Job<'_>,
    form: Form,
    layout: &Layout,
    (files, inputs): (&Files, &[&Path]),
    journal: &mut Journal,
    Open { output, list }: &mut Open,
) -> Result<Vec<Rejected>, CliError> {
    let append = |to: &mut Output, path: &Path, bytes: &[u8]| {
        to.append(bytes).map_err(unwritten(&passing(path)))
    };
    let sync = |output: &Output, list: &Output| {
        output.sync().and_then(|()| list.sync()).map_err(unwritten(&files.out))
    };
    let count = job.range.end - job.range.start;
    let table = job.input.table().cloned();
    if journal.rows == 0 {
        append(output, &files.out, &form.header(layout, table.as_ref(), count))?;
        append(list, &files.list, LIST)?;
    }
    let position = (journal.rows > 0).then_some(journal.position);
    job.input.seek(job.range.start + journal.rows, position)?;
    let steps = job.steps.max(1);
    let bar = progress::bar(count.saturating_mul(steps), "trajectories");
    bar.set_position(journal.rows.saturating_mul(steps));
    let card = job.engine.device().is_some_and(|by| !by.processor);
    journal.made_by(job.engine);
    let earlier = journal.redone;
    let mut piece = Piece::default();
    let stop = AtomicBool::new(false);
    let mut first = Vec::new();
    let mut noted = Instant::now();
    while journal.rows < count {
        let take = length(layout.width(), job.steps, card).min(count - journal.rows);
        piece.clear(job.range.start + journal.rows + 1);
        job.input.read(take as usize, &mut piece)?;
        let made = |made: u64| {
            bar.set_position(journal.rows.saturating_mul(steps).saturating_add(take * made));
        };
        let drift = job.engine.advance(
            layout,
            job.steps,
            &mut piece.rows,
            &Watch { made: &made, stop: &stop },
        )?;
        append(output, &files.out, &form.encode(layout, table.as_ref(), &piece))?;
        for rejected in &piece.rows.rejected {
            let reason = rejected.reason.replace('"', "'");
            let line = format!("{},{},\"{reason}\"\n", rejected.row, rejected.step);
            append(list, &files.list, line.as_bytes())?;
        }
        first.extend(piece.rows.rejected.iter().take(TOLD - first.len().min(TOLD)).cloned());
        journal.raise(drift);
        journal.made_by(job.engine);
        journal.redone = earlier + job.engine.device().map_or(0, |by| by.redone);
        journal.rows += take;
        journal.rejected += piece.rows.rejected.len() as u64;
        journal.position = job.input.position();
        Extent { bytes: journal.output, crc32: journal.output_crc32 } = output.extent();
        Extent { bytes: journal.rejected_bytes, crc32: journal.rejected_crc32 } = list.extent();
        bar.set_position(journal.rows.saturating_mul(steps));
        if noted.elapsed() > NOTED && journal.rows < count {
            sync(output, list)?;
            journal.write(&files.journal, inputs)?;
            noted = Instant::now();
        }
    }
    sync(output, list)?;
    bar.finish_and_clear();
    Ok(first)
}

/// Notes that everything is written.
fn seal(
    form: Form,
    layout: &Layout,
    (files, inputs): (&Files, &[&Path]),
    count: u64,
    journal: &mut Journal,
    open: &Open,
) -> Result<(), CliError> {
    debug_assert_eq!(journal.rows, count);
    #[allow(unused_mut)]
    let mut whole = open.output.extent();
    #[cfg(feature = "parquet")]
    if form == Form::Parquet {
        let written =
            Output::open_as(&files.out, &files.parquet, inputs).and_then(|mut parquet| {
                super::parquet_file::convert(&passing(&files.out), &mut parquet, layout)
                    .map_err(std::io::Error::other)?;
                Ok(parquet.extent())
            });
        whole = written.map_err(unwritten(&files.parquet))?;
    }
    let _ = (form, layout);
    journal.complete = true;
    journal.whole = [whole.bytes, u64::from(whole.crc32)];
    journal.write(&files.journal, inputs)
}

/// Gives the files their names, the output's last. Those of an earlier run that ended between two of them may have theirs
/// already.
fn publish(
    form: Form,
    (files, inputs): (&Files, &[&Path]),
    journal: &Journal,
    open: &mut Open,
) -> Result<(), CliError> {
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
    if journal.rejected > 0 {
        name(&mut open.list, &files.list, journal.rejected_extent())?;
    } else {
        open.list.discard();
        // That of an earlier run.
        if fs::read(&files.list).is_ok_and(|list| list.starts_with(LIST)) {
            remove(&files.list)?;
        }
    }
    #[cfg(feature = "parquet")]
    if form == Form::Parquet {
        let parquet = Output::open_as(&files.out, &files.parquet, inputs);
        let mut parquet = parquet.map_err(unwritten(&files.parquet))?;
        name(&mut parquet, &files.out, whole)?;
        // The numbers have served.
        open.output.discard();
        return Ok(());
    }
    let _ = (form, inputs);
    name(&mut open.output, &files.out, whole)
}
