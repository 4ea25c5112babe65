//! Targets of records, by the name given.

use std::path::{Path, PathBuf};

use coadjoint_codegen::file::{self, Output, beside, passing};

use crate::error::{CliError, unwritten};
use crate::form::Form;

/// The kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// The standard output.
    Standard,
    /// A device or a pipe, written as it is.
    Device,
    /// A file, which has its name with `.partial` added until it is complete.
    File,
}

/// The target of records.
#[derive(Clone, Debug)]
pub(crate) struct Destination {
    /// The name given.
    pub path: PathBuf,
    pub form: Form,
    pub place: Place,
    /// The files that the run reads.
    pub inputs: Vec<PathBuf>,
}

impl Destination {
    /// The target of `--out`: refused where the name has no known ending, its folder is not there, or it is an input.
    pub(crate) fn new(path: &Path, inputs: &[PathBuf]) -> Result<Self, CliError> {
        let refuse = |what: &str| CliError::Option(format!("--out {}: {what}", path.display()));
        let ending = path.extension().and_then(|ending| ending.to_str());
        let special = std::fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir());
        let (form, place) = if path == Path::new("-") {
            (Form::Csv, Place::Standard)
        } else if special && matches!(ending, Some("npy" | "parquet")) {
            return Err(refuse(
                ".npy and .parquet need a file that can be written again; this is a device or a pipe: write .csv",
            ));
        } else if special {
            (Form::Csv, Place::Device)
        } else {
            file::check(path, &[]).map_err(unwritten(path))?;
            (Form::of(path, "--out")?, Place::File)
        };
        Self { path: path.to_owned(), form, place, inputs: inputs.to_vec() }.checked()
    }

    /// The file of one of several truncations: the truncation stands before the ending of its name.
    pub(crate) fn numbered(&self, truncation: usize) -> Result<Self, CliError> {
        if self.place != Place::File {
            return Err(CliError::Option(format!(
                "--out {}: several truncations need several files; give a name such as t.csv",
                self.path.display()
            )));
        }
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let ending = self.path.extension().unwrap_or_default().to_string_lossy();
        let path = self.path.with_file_name(format!("{stem}-K{truncation}.{ending}"));
        Self { path, ..self.clone() }.checked()
    }

    /// Refuses names that are inputs.
    fn checked(self) -> Result<Self, CliError> {
        let inputs = paths(&self.inputs);
        for name in self.names() {
            file::check(&name, &inputs).map_err(unwritten(&name))?;
        }
        Ok(self)
    }

    /// The names of the files that are written.
    pub(crate) fn names(&self) -> Vec<PathBuf> {
        match (self.place, self.form) {
            (Place::File, Form::Csv) => vec![self.path.clone(), self.part()],
            (Place::File, _) => vec![self.path.clone(), self.part(), self.description()],
            _ => Vec::new(),
        }
    }

    /// Opens it, and keeps other runs out; `None` for the standard output.
    pub(crate) fn open(&self) -> Result<Option<Output>, CliError> {
        if self.place == Place::Standard {
            return Ok(None);
        }
        Output::open(&self.path, &paths(&self.inputs)).map(Some).map_err(unwritten(&self.part()))
    }

    /// The name that is written to until all is there.
    pub(crate) fn part(&self) -> PathBuf {
        if self.place == Place::File { passing(&self.path) } else { self.path.clone() }
    }

    /// The JSON file beside a matrix or a Parquet file.
    pub(crate) fn description(&self) -> PathBuf {
        beside(&self.path, ".json")
    }
}

/// Borrows the paths of a list.
pub(crate) fn paths(list: &[PathBuf]) -> Vec<&Path> {
    list.iter().map(PathBuf::as_path).collect()
}
