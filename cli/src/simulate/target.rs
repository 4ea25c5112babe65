//! Where records go, by the name given.

use std::path::{Path, PathBuf};

use coadjoint_codegen::file::{self, Output, beside, passing};

use crate::error::{CliError, unwritten};

/// The format of a file of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Comment lines, a line of names, a line for each record, a closing comment line.
    Csv,
    /// A matrix of 64-bit floats; what CSV has in comments and names is in a JSON file beside it.
    Npy,
}

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

/// Where records go.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// The name given.
    pub path: PathBuf,
    /// The format.
    pub form: Form,
    /// The kind of place.
    pub place: Place,
    /// The files that the run reads.
    pub inputs: Vec<PathBuf>,
}

impl Target {
    /// The target of `--out`.
    ///
    /// # Errors
    /// Where the name has no known ending, its folder is not there, or it is one of the inputs.
    pub(crate) fn new(path: &Path, inputs: &[PathBuf]) -> Result<Self, CliError> {
        let target = |form, place| {
            let target = Self { path: path.to_owned(), form, place, inputs: inputs.to_vec() };
            target.check()?;
            Ok(target)
        };
        if path == Path::new("-") {
            return target(Form::Csv, Place::Standard);
        }
        let ending = path.extension().and_then(|ending| ending.to_str());
        let special = std::fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir());
        if special {
            return match ending {
                Some("npy") => Err(CliError::Option(format!(
                    "--out {}: .npy needs a file whose beginning can be written last; this is a \
                     device or a pipe: write .csv",
                    path.display()
                ))),
                _ => target(Form::Csv, Place::Device),
            };
        }
        file::check(path, &[]).map_err(unwritten(path))?;
        match ending {
            Some("csv") => target(Form::Csv, Place::File),
            Some("npy") => target(Form::Npy, Place::File),
            _ => Err(CliError::Option(format!(
                "--out {}: the name must end in .csv or .npy (or be - for the standard output)",
                path.display()
            ))),
        }
    }

    /// The name of the file of one of several truncations: the truncation stands before the ending.
    ///
    /// # Errors
    /// Where the place is no file.
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
        let target = Self { path, ..self.clone() };
        target.check()?;
        Ok(target)
    }

    /// The names of the files that are written.
    pub(crate) fn names(&self) -> Vec<PathBuf> {
        match (self.place, self.form) {
            (Place::File, Form::Csv) => vec![self.path.clone(), self.part()],
            (Place::File, Form::Npy) => vec![self.path.clone(), self.part(), self.description()],
            _ => Vec::new(),
        }
    }

    /// Refuses names that are inputs.
    fn check(&self) -> Result<(), CliError> {
        let inputs: Vec<&Path> = self.inputs.iter().map(PathBuf::as_path).collect();
        let names = self.names();
        names.iter().try_for_each(|name| file::check(name, &inputs).map_err(unwritten(name)))
    }

    /// Opens it, and keeps other runs out; `None` for the standard output.
    ///
    /// # Errors
    /// Where it cannot be written, or another run writes it.
    pub(crate) fn open(&self) -> Result<Option<Output>, CliError> {
        let inputs: Vec<&Path> = self.inputs.iter().map(PathBuf::as_path).collect();
        let opened = (self.place != Place::Standard).then(|| Output::open(&self.path, &inputs));
        opened.transpose().map_err(unwritten(&self.part()))
    }

    /// The name that is written to until all is there.
    pub(crate) fn part(&self) -> PathBuf {
        match self.place {
            Place::File => passing(&self.path),
            _ => self.path.clone(),
        }
    }

    /// The JSON file beside a matrix.
    pub(crate) fn description(&self) -> PathBuf {
        beside(&self.path, ".json")
    }
}
