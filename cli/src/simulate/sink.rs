//! Records written as they are made.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Seek, SeekFrom, Write, stdout};
use std::path::Path;
use std::time::{Duration, Instant};

use coadjoint_run::number::shortest;
use serde_json::{Value, json};

use super::checkpoint;
use super::header::Header;
use super::target::{Form, Place, Target};
use crate::error::CliError;

/// Bytes kept in memory before they are written.
const BUFFER: usize = 1 << 16;
/// Records reach the file at least this often, as far as steps allow.
const DELAY: Duration = Duration::from_millis(500);
/// Length of the head of a `.npy` file here.
const HEAD: usize = 128;

/// How much of a file is vouched for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    /// Bytes.
    pub bytes: u64,
    /// Records.
    pub rows: u64,
}

/// A file, a device or the standard output that takes records.
pub struct Sink {
    target: Target,
    header: Header,
    names: Vec<String>,
    /// `None` for the standard output, and where nobody reads any more.
    file: Option<File>,
    closed: bool,
    /// A write has failed; nothing more is tried.
    broken: bool,
    buffer: Vec<u8>,
    /// Whole records written so far.
    written: Extent,
    /// Records in the buffer.
    waiting: u64,
    flushed: Instant,
}

impl Sink {
    /// Begins anew.
    ///
    /// # Errors
    /// Where the file cannot be made or another run writes it.
    pub fn begin(target: &Target, header: Header, names: Vec<String>) -> Result<Self, CliError> {
        let mut sink = Self::open(target, header, names)?;
        if let (Some(file), Place::File) = (&mut sink.file, target.place) {
            file.set_len(0).map_err(|error| failed(&target.part(), &error))?;
        }
        match target.form {
            Form::Csv => {
                for line in sink.header.lines() {
                    sink.buffer.extend_from_slice(format!("# {line}\n").as_bytes());
                }
                sink.buffer.extend_from_slice(names_line(&sink.names)?.as_bytes());
            }
            Form::Npy => {
                sink.buffer.extend_from_slice(&npy_head(0, sink.names.len()));
                sink.describe(false)?;
            }
        }
        sink.flush()?;
        Ok(sink)
    }

    /// Goes on where a checkpoint was made; what came after it is cut off.
    ///
    /// # Errors
    /// Where the file is not there or is shorter than the checkpoint says.
    pub fn resume(
        target: &Target,
        header: Header,
        names: Vec<String>,
        extent: Extent,
    ) -> Result<Self, CliError> {
        let part = target.part();
        let length = std::fs::metadata(&part).map_or(0, |data| data.len());
        if length < extent.bytes {
            return Err(CliError::Option(format!(
                "{} has {length} bytes, but the checkpoint is of a run that had written {}: bring \
                 the file back, or remove the checkpoint to begin anew",
                part.display(),
                extent.bytes
            )));
        }
        let mut sink = Self::open(target, header, names)?;
        if let Some(file) = &mut sink.file {
            let cut = file.set_len(extent.bytes).and_then(|()| file.seek(SeekFrom::End(0)));
            cut.map_err(|error| failed(&part, &error))?;
        }
        sink.written = extent;
        Ok(sink)
    }

    fn open(target: &Target, header: Header, names: Vec<String>) -> Result<Self, CliError> {
        let part = target.part();
        let file = match target.place {
            Place::Standard => None,
            place => {
                let create = place == Place::File;
                let mut options = OpenOptions::new();
                let file = options.write(true).create(create).truncate(false).open(&part);
                let file = file.map_err(|error| failed(&part, &error))?;
                if create {
                    match file.try_lock() {
                        Err(TryLockError::WouldBlock) => {
                            return Err(failed(&part, &"another run is writing it"));
                        }
                        // Not every file system has locks.
                        Err(TryLockError::Error(_)) | Ok(()) => {}
                    }
                }
                Some(file)
            }
        };
        Ok(Self {
            target: target.clone(),
            header,
            names,
            file,
            closed: false,
            broken: false,
            buffer: Vec::with_capacity(BUFFER + 4096),
            written: Extent::default(),
            waiting: 0,
            flushed: Instant::now(),
        })
    }

    /// A file that an earlier run has completed; nothing is added.
    pub fn done(target: &Target, extent: Extent) -> Self {
        Self {
            target: target.clone(),
            header: Header::default(),
            names: Vec::new(),
            file: None,
            closed: true,
            broken: false,
            buffer: Vec::new(),
            written: extent,
            waiting: 0,
            flushed: Instant::now(),
        }
    }

    /// How many records there are.
    pub fn rows(&self) -> u64 {
        self.written.rows + self.waiting
    }

    /// Whether nobody reads any more.
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// Adds a record.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn row(&mut self, values: impl Iterator<Item = f64>) -> Result<(), CliError> {
        match self.target.form {
            Form::Csv => {
                for (place, value) in values.enumerate() {
                    if place > 0 {
                        self.buffer.push(b',');
                    }
                    self.buffer.extend_from_slice(shortest(value).as_bytes());
                }
                self.buffer.push(b'\n');
            }
            Form::Npy => values.for_each(|value| self.buffer.extend(value.to_le_bytes())),
        }
        self.waiting += 1;
        if self.buffer.len() >= BUFFER { self.flush() } else { Ok(()) }
    }

    /// Writes what waits, if it has waited for long.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn tick(&mut self) -> Result<(), CliError> {
        if self.waiting > 0 && self.flushed.elapsed() >= DELAY { self.flush() } else { Ok(()) }
    }

    /// Writes what waits. After a failure the file ends with its last whole record.
    fn flush(&mut self) -> Result<(), CliError> {
        let outcome = self.write();
        self.broken |= outcome.is_err();
        if let (Err(_), Some(file), Place::File) = (&outcome, &self.file, self.target.place) {
            // The failure itself is what is reported.
            let _ = file.set_len(self.written.bytes);
        }
        self.flushed = Instant::now();
        outcome
    }

    fn write(&mut self) -> Result<(), CliError> {
        if !self.closed {
            let written = match &mut self.file {
                Some(file) => file.write_all(&self.buffer),
                None => {
                    let mut out = stdout().lock();
                    out.write_all(&self.buffer).and_then(|()| out.flush())
                }
            };
            match written {
                Err(error)
                    if error.kind() == ErrorKind::BrokenPipe
                        && self.target.place != Place::File =>
                {
                    self.closed = true;
                }
                outcome => outcome.map_err(|error| self.failed(&error))?,
            }
        }
        let bytes = self.written.bytes + self.buffer.len() as u64;
        self.written = Extent { bytes, rows: self.written.rows + self.waiting };
        self.waiting = 0;
        self.buffer.clear();
        self.head()
    }

    /// Brings the number of records in the head of a matrix up to date.
    fn head(&mut self) -> Result<(), CliError> {
        let (Form::Npy, Some(file)) = (self.target.form, &mut self.file) else { return Ok(()) };
        let head = npy_head(self.written.rows, self.names.len());
        let outcome = file
            .seek(SeekFrom::Start(0))
            .and_then(|_| file.write_all(&head))
            .and_then(|()| file.seek(SeekFrom::End(0)));
        outcome.map(|_| ()).map_err(|error| self.failed(&error))
    }

    /// Writes all to the disk and says how much there is.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn vouch(&mut self) -> Result<Extent, CliError> {
        self.flush()?;
        if let (Some(file), Place::File) = (&self.file, self.target.place) {
            file.sync_data().map_err(|error| self.failed(&error))?;
        }
        Ok(self.written)
    }

    /// Says at the end of the file that it is complete; it still has the name of a part.
    ///
    /// # Errors
    /// Where the file cannot be written.
    pub fn complete(&mut self) -> Result<Extent, CliError> {
        self.close(&format!("complete: {} records", self.rows()));
        self.vouch()
    }

    /// Gives a complete file its name.
    ///
    /// # Errors
    /// Where the name cannot be given.
    pub fn publish(self) -> Result<(), CliError> {
        if self.target.place != Place::File {
            return Ok(());
        }
        if self.target.form == Form::Npy {
            self.describe(true)?;
        }
        checkpoint::rename(&self.target.part(), &self.target.path)
    }

    /// Ends a file that stays a part, as well as can be, and says why.
    pub fn stop(mut self, why: &str) {
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
        checkpoint::replace(&self.target.description(), &text)
    }

    fn failed(&self, why: &dyn std::fmt::Display) -> CliError {
        match self.target.place {
            Place::Standard => failed(Path::new("the standard output"), why),
            _ => failed(&self.target.part(), why),
        }
    }
}

/// A file that cannot be written.
pub fn failed(path: &Path, why: &dyn std::fmt::Display) -> CliError {
    CliError::Write { path: path.into(), message: why.to_string() }
}

/// Names with commas or quotes are quoted.
fn names_line(names: &[String]) -> Result<String, CliError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let unwritten =
        |error: &dyn std::fmt::Display| failed(Path::new("the names of columns"), error);
    writer.write_record(names).map_err(|error| unwritten(&error))?;
    let bytes = writer.into_inner().map_err(|error| unwritten(&error))?;
    String::from_utf8(bytes).map_err(|error| unwritten(&error))
}

/// The head of a `.npy` file, version 1.0, always of the same length so that it can be replaced.
fn npy_head(rows: u64, columns: usize) -> [u8; HEAD] {
    let mut head = [b' '; HEAD];
    head[..10].copy_from_slice(b"\x93NUMPY\x01\x00\x76\x00");
    let text =
        format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    // Two numbers of 20 digits fit.
    for (place, byte) in head[10..HEAD - 1].iter_mut().zip(text.bytes()) {
        *place = byte;
    }
    head[HEAD - 1] = b'\n';
    head
}
