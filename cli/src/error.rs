//! The errors of the command, and their exit codes.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use coadjoint_learn::LearnError;
use coadjoint_run::RunError;

/// Errors of a command.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    /// A run that failed, or what was given for it.
    #[error(transparent)]
    Run(Box<RunError>),
    /// An option that does not make sense.
    #[error("{0}")]
    Option(String),
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read { path: PathBuf, source: std::io::Error },
    /// A file that cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    Write { path: PathBuf, source: std::io::Error },
    /// Nobody reads the records any more, which is no failure.
    #[error("nobody reads the records any more")]
    NobodyReads,
    /// A run that was asked to stop.
    #[error("{0}")]
    Interrupted(String),
    /// No row of an ensemble has an end state; the report has been printed.
    #[error(
        "no trajectory reached the end: all {failed} rows failed{}",
        .list.as_ref().map(|list| format!("; {} says why", list.display())).unwrap_or_default()
    )]
    Rows { failed: u64, list: Option<PathBuf> },
    /// Nothing can be said of some rows; what was found has been printed.
    #[error("{0}")]
    NotJudged(String),
    /// Laws that do not hold; the table has been printed.
    #[error("{0}")]
    Laws(String),
}

impl From<RunError> for CliError {
    fn from(error: RunError) -> Self {
        Self::Run(Box::new(error))
    }
}

/// The error of a file that cannot be read.
pub(crate) fn unread(path: &Path) -> impl Fn(std::io::Error) -> CliError + '_ {
    |source| CliError::Read { path: path.into(), source }
}

/// The error of a file that cannot be written.
pub(crate) fn unwritten(path: &Path) -> impl Fn(std::io::Error) -> CliError + '_ {
    |source| CliError::Write { path: path.into(), source }
}

impl CliError {
    /// 2 for bad input, 3 for what could not be judged, 130 for an interruption, 1 for everything else.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::NobodyReads => 0,
            Self::Option(_) | Self::Read { .. } => 2,
            // A name that no output may have, or that another run uses.
            Self::Write { source, .. }
                if matches!(source.kind(), ErrorKind::InvalidInput | ErrorKind::ResourceBusy) =>
            {
                2
            }
            Self::Run(error) if error.is_input() => 2,
            Self::Run(_) | Self::Rows { .. } | Self::Write { .. } | Self::Laws(_) => 1,
            Self::NotJudged(_) => 3,
            Self::Interrupted(_) => 130,
        }
    }

    /// The message for the terminal, with its line end.
    pub(crate) fn text(&self) -> String {
        if matches!(self, Self::NobodyReads) {
            return String::new();
        }
        // Rendered mistakes begin with their own places.
        if let Self::Run(error) = self
            && let RunError::Input(text) = &**error
        {
            return text.clone();
        }
        format!("error: {self}\n")
    }
}

impl From<LearnError> for CliError {
    fn from(error: LearnError) -> Self {
        RunError::from(error).into()
    }
}
