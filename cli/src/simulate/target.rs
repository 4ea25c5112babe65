//! Where records go, by the name given.

use std::path::{Path, PathBuf};

use crate::error::CliError;

/// The format of a file of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Comment lines, a line of names, a line for each record, a closing comment line.
    Csv,
    /// A matrix of 64-bit floats; what CSV has in comments and names is in a JSON file beside it.
    Npy,
}

/// The kind of place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The standard output.
    Standard,
    /// A device or a pipe, written as it is.
    Device,
    /// A file, which has its name with `.part` added until it is complete.
    File,
}

/// Where records go.
#[derive(Clone, Debug)]
pub struct Target {
    /// The name given.
    pub path: PathBuf,
    /// The format.
    pub form: Form,
    /// The kind of place.
    pub place: Place,
}

impl Target {
    /// The target of `--out`.
    ///
    /// # Errors
    /// Where the name has no known ending, or its folder is not there.
    pub fn new(path: &Path) -> Result<Self, CliError> {
        let target = |form, place| Ok(Self { path: path.to_owned(), form, place });
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
        folder("--out", path)?;
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
    pub fn numbered(&self, truncation: usize) -> Result<Self, CliError> {
        if self.place != Place::File {
            return Err(CliError::Option(format!(
                "--out {}: several truncations need several files; give a name such as t.csv",
                self.path.display()
            )));
        }
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let ending = self.path.extension().unwrap_or_default().to_string_lossy();
        let path = self.path.with_file_name(format!("{stem}-K{truncation}.{ending}"));
        Ok(Self { path, ..self.clone() })
    }

    /// The name that is written to until all is there.
    pub fn part(&self) -> PathBuf {
        match self.place {
            Place::File => beside(&self.path, ".part"),
            _ => self.path.clone(),
        }
    }

    /// The JSON file beside a matrix.
    pub fn description(&self) -> PathBuf {
        beside(&self.path, ".json")
    }
}

/// Refuses a name in a folder that is not there.
///
/// # Errors
/// With the option's name.
pub fn folder(option: &str, path: &Path) -> Result<(), CliError> {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    if path.is_dir() {
        return Err(CliError::Option(format!("{option} {}: this is a folder", path.display())));
    }
    match parent {
        Some(parent) if !parent.is_dir() => Err(CliError::Option(format!(
            "{option} {}: there is no folder {}",
            path.display(),
            parent.display()
        ))),
        _ => Ok(()),
    }
}

/// `path` with `ending` added to its name.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(ending);
    path.with_file_name(name)
}
