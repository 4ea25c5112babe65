//! The run itself: piece after piece, each safe on the disk before it counts.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint_run::ensemble::{Drift, Engine, Layout, Rejected, Watch, piece as length};

use super::finished::Finished;
use super::input::Input;
use super::journal::{Identity, Journal};
use super::output::{Appended, Form, beside, rename, unwritten};
use super::table::Piece;
use crate::error::CliError;
use crate::progress;

/// What is on the disk is noted this often.
const NOTED: Duration = Duration::from_millis(200);

/// Rejected rows that are told at the end; all are in the list.
const TOLD: usize = 5;

/// A run that is set up.
pub struct Job<'a> {
    /// Advances rows.
    pub engine: &'a dyn Engine,
    /// Where rows come from.
    pub input: Box<dyn Input>,
    /// Where they go.
    pub out: PathBuf,
    /// Rows of the input, counted from 0.
    pub range: Range<u64>,
    /// Steps of every trajectory.
    pub steps: u64,
    /// What the run is.
    pub identity: Identity,
    /// Forget what an earlier run has done.
    pub restart: bool,
    /// Keep what an earlier run has finished.
    pub keep: bool,
}

/// What a run did.
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
    /// What has made the steps.
    pub made_by: Vec<String>,
    /// Rows of which a device has refused steps that others then made.
    pub redone: u64,
    /// Seconds of this run.
    pub seconds: f64,
}

/// The files of a run.
struct Files {
    out: PathBuf,
    partial: PathBuf,
    list: PathBuf,
    list_partial: PathBuf,
    journal: PathBuf,
    done: PathBuf,
}

impl Files {
    fn of(out: &Path) -> Self {
        Self {
            out: out.into(),
            partial: beside(out, ".partial"),
            list: beside(out, ".rejected.csv"),
            list_partial: beside(out, ".rejected.csv.partial"),
            journal: beside(out, ".journal"),
            done: beside(out, ".done"),
        }
    }
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), CliError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(unwritten(path, &error)),
        _ => Ok(()),
    }
}

/// Runs from the beginning, or from where an earlier run was stopped; or keeps what one has finished.
pub fn run(mut job: Job<'_>) -> Result<Outcome, CliError> {
    let start = Instant::now();
    let form = Form::of(&job.out)?;
    let layout = job.input.layout();
    let files = Files::of(&job.out);
    let count = job.range.end - job.range.start;
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
        let output = Appended::open(&files.partial, journal.output)?;
        let list = Appended::open(&files.list_partial, journal.rejected_bytes)?;
        first = advance(&mut job, form, &layout, &files, &mut journal, output, list)?;
        seal(form, &layout, &files, count, &mut journal)?;
    }
    remove(&files.done)?;
    publish(form, &layout, &files, &journal)?;
    if job.keep {
        let first_row = job.range.start + 1;
        Finished::of(&files.out, &files.list, first_row, journal.clone())?.write(&files.done)?;
    }
    remove(&files.journal)?;
    Ok(outcome(count, (resumed, false), journal, files, first, start))
}

/// What a finished run has noted that is to be kept; `None` where the run is to be made.
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
    files: &Files,
    journal: &mut Journal,
    mut output: Appended,
    mut list: Appended,
) -> Result<Vec<Rejected>, CliError> {
    let count = job.range.end - job.range.start;
    let table = job.input.table().cloned();
    if journal.rows == 0 {
        output.append(&form.header(layout, table.as_ref(), count))?;
        list.append(b"row,step,reason\n")?;
    }
    let position = (journal.rows > 0).then_some(journal.position);
    job.input.seek(job.range.start + journal.rows, position)?;
    let steps = job.steps.max(1);
    let bar = progress::bar(count.saturating_mul(steps), "trajectories");
    bar.set_position(journal.rows.saturating_mul(steps));
    let by = job.engine.device();
    let card = by.as_ref().is_some_and(|by| !by.processor);
    let maker = by.map_or_else(|| job.engine.backend(), |by| by.to_string());
    if !journal.made_by.contains(&maker) {
        journal.made_by.push(maker);
    }
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
        output.append(&form.encode(layout, table.as_ref(), &piece))?;
        for rejected in &piece.rows.rejected {
            let reason = rejected.reason.replace('"', "'");
            list.append(format!("{},{},\"{reason}\"\n", rejected.row, rejected.step).as_bytes())?;
        }
        first.extend(piece.rows.rejected.iter().take(TOLD - first.len().min(TOLD)).cloned());
        journal.raise(drift);
        journal.redone = earlier + job.engine.device().map_or(0, |by| by.redone);
        journal.rows += take;
        journal.rejected += piece.rows.rejected.len() as u64;
        journal.position = job.input.position();
        journal.output = output.length();
        journal.rejected_bytes = list.length();
        bar.set_position(journal.rows.saturating_mul(steps));
        if noted.elapsed() > NOTED && journal.rows < count {
            output.sync()?;
            list.sync()?;
            journal.write(&files.journal)?;
            noted = Instant::now();
        }
    }
    output.sync()?;
    list.sync()?;
    bar.finish_and_clear();
    Ok(first)
}

/// Notes that everything is written.
fn seal(
    form: Form,
    layout: &Layout,
    files: &Files,
    count: u64,
    journal: &mut Journal,
) -> Result<(), CliError> {
    debug_assert_eq!(journal.rows, count);
    #[cfg(feature = "parquet")]
    if form == Form::Parquet {
        let whole = beside(&files.out, ".parquet.partial");
        super::parquet_file::convert(&files.partial, &whole, layout)
            .map_err(|error| unwritten(&whole, &error))?;
    }
    let _ = (form, layout);
    journal.complete = true;
    journal.write(&files.journal)
}

/// Gives the files their names.
fn publish(form: Form, _layout: &Layout, files: &Files, journal: &Journal) -> Result<(), CliError> {
    if journal.rejected == 0 {
        remove(&files.list_partial)?;
        remove(&files.list)?;
    } else if files.list_partial.exists() {
        rename(&files.list_partial, &files.list)?;
    }
    let whole = match form {
        #[cfg(feature = "parquet")]
        Form::Parquet => beside(&files.out, ".parquet.partial"),
        _ => files.partial.clone(),
    };
    if whole.exists() {
        rename(&whole, &files.out)?;
    } else if !files.out.exists() {
        return Err(CliError::Option(format!(
            "{} says that {} is written, but it is gone; begin anew with --restart",
            files.journal.display(),
            files.out.display()
        )));
    }
    remove(&files.partial)
}
