//! Records written as they are made, and the checkpoint that counts them.

use std::io::{Error, ErrorKind, Write, stdout};
use std::path::Path;
use std::time::{Duration, Instant};

use coadjoint_codegen::file::{self, Extent, Output};
use coadjoint_run::simulate::Resume;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::samples::Samples;
use super::settings::Header;
use super::target::{Destination, Place, paths};
use crate::error::{CliError, unwritten};
use crate::form::Form;
use crate::note::Identity;

/// Bytes kept in memory before they are written.
const BUFFER: usize = 1 << 16;
/// Records reach the file at least this often, as far as steps allow.
const DELAY: Duration = Duration::from_millis(500);

/// The progress of a run, on the disk. Records that it counts are there before it is.
#[derive(Debug, Deserialize, Serialize)]
pub(crate) struct Checkpoint<R = Resume> {
    /// The description of the run.
    pub identity: Identity,
    /// The state, and the maxima so far.
    pub resume: R,
    /// Bytes of the file of records.
    pub bytes: u64,
    /// The checksum of these.
    pub records_crc32: u32,
    /// Records in it.
    pub rows: u64,
    /// The moments kept for pictures, if any are.
    pub samples: Option<Samples>,
    /// True if the run has finished.
    pub complete: bool,
}

/// A file, a device or the standard output that takes records.
pub(crate) struct Records {
    target: Destination,
    header: Header,
    names: Vec<String>,
    /// `None` for the standard output, and for a file that an earlier run has completed.
    output: Option<Output>,
    /// Nobody reads any more, or there is nothing to add.
    closed: bool,
    /// A write has failed; nothing more is tried.
    broken: bool,
    buffer: Vec<u8>,
    /// Whole records written so far.
    written: u64,
    /// Records in the buffer.
    waiting: u64,
    flushed: Instant,
}

impl Records {
    /// Begins anew, or goes on where a checkpoint was made: what came after it is cut off, and nothing is added to a file
    /// that an earlier run has completed. `output` is the file that the target has opened.
    pub(crate) fn open<R>(
        target: &Destination,
        output: Option<Output>,
        header: Header,
        names: Vec<String>,
        found: Option<&Checkpoint<R>>,
    ) -> Result<Self, CliError> {
        // After an earlier end the name may have been given already.
        let fresh = output.as_ref().is_some_and(Output::is_fresh);
        let closed = found.is_some_and(|found| found.complete) && fresh && target.path.exists();
        let mut records = Self {
            target: target.clone(),
            header,
            names,
            output: output.filter(|_| !closed),
            closed,
            broken: false,
            buffer: Vec::with_capacity(BUFFER + 4096),
            written: found.map_or(0, |found| found.rows),
            waiting: 0,
            flushed: Instant::now(),
        };
        let head = if target.form == Form::Csv { Vec::new() } else { records.array_head() };
        let Some(found) = found else {
            if let Some(output) = &mut records.output {
                output.begin(&head).map_err(unwritten(&target.part()))?;
            }
            if target.form == Form::Csv {
                for line in records.header.lines() {
                    records.buffer.extend_from_slice(format!("# {line}\n").as_bytes());
                }
                records.buffer.extend(target.form.head(&records.names, &[]));
            } else {
                records.describe(false)?;
            }
            records.flush()?;
            return Ok(records);
        };
        if let Some(output) = &mut records.output {
            let extent = Extent { bytes: found.bytes, crc32: found.records_crc32 };
            let resumed = output.resume(extent, head.len() as u64);
            resumed.map_err(|error| match error.kind() {
                ErrorKind::InvalidData => CliError::Option(format!(
                    "{}: {error}: bring the file back, or remove the checkpoint to begin anew",
                    target.part().display()
                )),
                _ => unwritten(&target.part())(error),
            })?;
        }
        records.head()?;
        Ok(records)
    }

    /// The number of records.
    pub(crate) fn rows(&self) -> u64 {
        self.written + self.waiting
    }

    /// True if the reader has closed its end.
    pub(crate) fn closed(&self) -> bool {
        self.closed
    }

    /// Adds a record.
    pub(crate) fn row(&mut self, values: &[f64]) -> Result<(), CliError> {
        self.target.form.append(values, values.len(), &mut self.buffer);
        self.waiting += 1;
        if self.buffer.len() >= BUFFER { self.flush() } else { Ok(()) }
    }

    /// Writes what waits, if it has waited for long.
    pub(crate) fn tick(&mut self) -> Result<(), CliError> {
        if self.waiting > 0 && self.flushed.elapsed() >= DELAY { self.flush() } else { Ok(()) }
    }

    /// Writes what waits. After a failure the file ends with the last record that fitted.
    fn flush(&mut self) -> Result<(), CliError> {
        let mut outcome = Ok(());
        let mut kept = self.waiting;
        if !self.closed {
            let written = match &mut self.output {
                Some(output) => output.append(&self.buffer),
                None => {
                    let mut out = stdout().lock();
                    out.write_all(&self.buffer).and_then(|()| out.flush())
                }
            };
            let unread = |error: &Error| {
                error.kind() == ErrorKind::BrokenPipe && self.target.place != Place::File
            };
            match written {
                Ok(()) => {}
                Err(error) if unread(&error) => self.closed = true,
                Err(error) => {
                    kept = self.keep_whole();
                    outcome = Err(self.failed(error));
                }
            }
        }
        self.written += kept;
        self.waiting = 0;
        self.buffer.clear();
        let head = self.head();
        let outcome = outcome.and(head);
        self.broken |= outcome.is_err();
        self.flushed = Instant::now();
        outcome
    }

    /// Writes those of the records that wait for which there is room; how many they are.
    fn keep_whole(&mut self) -> u64 {
        let (Some(output), Place::File) = (&mut self.output, self.target.place) else { return 0 };
        let fits = |record: &&[u8]| output.append(record).is_ok();
        let kept = match self.target.form {
            Form::Csv => {
                self.buffer.split_inclusive(|byte| *byte == b'\n').take_while(fits).count()
            }
            _ => self.buffer.chunks(8 * self.names.len().max(1)).take_while(fits).count(),
        };
        (kept as u64).min(self.waiting)
    }

    /// The head of an array; its length does not depend on the number of records.
    fn array_head(&self) -> Vec<u8> {
        self.target.form.head(&self.names, &[self.written, self.names.len() as u64])
    }

    /// Brings the number of records in the head of a matrix up to date.
    fn head(&mut self) -> Result<(), CliError> {
        let head = self.array_head();
        let (Form::Npy, Some(output)) = (self.target.form, &mut self.output) else { return Ok(()) };
        output.set_head(&head).map_err(|error| self.failed(error))
    }

    /// Writes all to the disk and says how much there is.
    pub(crate) fn vouch(&mut self) -> Result<(Extent, u64), CliError> {
        self.flush()?;
        let Some(output) = &self.output else { return Ok((Extent::default(), self.written)) };
        output.sync().map_err(|error| self.failed(error))?;
        Ok((output.extent(), self.written))
    }

    /// Says at the end of the file that it is complete; it still has the name of a part.
    pub(crate) fn complete(&mut self) -> Result<(), CliError> {
        self.close(&format!("complete: {} records", self.rows()));
        self.vouch().map(drop)
    }

    /// Gives a complete file its name.
    pub(crate) fn publish(mut self) -> Result<(), CliError> {
        if self.target.form != Form::Csv && self.output.is_some() {
            self.describe(true)?;
        }
        let Self { target: Destination { form, path, inputs, .. }, output, names, .. } = &mut self;
        let Some(output) = output else { return Ok(()) };
        form.publish(output, path, names, &paths(inputs)).map_err(unwritten(path))
    }

    /// Ends a file that stays a part, as well as can be, and says why.
    pub(crate) fn stop(mut self, why: &str) {
        // Records that still can be written are; the reason comes after them.
        if !self.broken && self.flush().is_ok() {
            self.close(&format!("part: {}", why.replace(['\n', '\r'], " ")));
            let _ = self.vouch();
        }
    }

    fn close(&mut self, line: &str) {
        if self.target.form == Form::Csv {
            self.buffer.extend_from_slice(format!("# {line}\n").as_bytes());
        }
    }

    /// Writes the JSON file beside a matrix.
    fn describe(&self, complete: bool) -> Result<(), CliError> {
        let mut object = self.header.object();
        object.insert("columns".into(), json!(self.names));
        object.insert("complete".into(), Value::Bool(complete));
        let text = format!("{:#}\n", Value::Object(object));
        let path = self.target.description();
        let written = file::write(&path, &paths(&self.target.inputs), text.as_bytes());
        written.map_err(unwritten(&path))
    }

    fn failed(&self, error: Error) -> CliError {
        match self.target.place {
            Place::Standard => unwritten(Path::new("the standard output"))(error),
            _ => unwritten(&self.target.part())(error),
        }
    }
}
