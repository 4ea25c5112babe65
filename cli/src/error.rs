//! What can go wrong, and the exit code it means.

use std::path::PathBuf;

use coadjoint::{StepError, groups::ElementError, groups::TableError};
use coadjoint_codegen::emit::TooManyTerms;
use coadjoint_codegen::emit::c::HeaderError;
use coadjoint_codegen::hamilton_jacobi::DeriveError;
use coadjoint_codegen::tolerance::ToleranceError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// Mistakes in the system file, rendered with file, line and advice.
    #[error("{0}")]
    Input(String),
    /// An option that does not make sense.
    #[error("{0}")]
    Option(String),
    /// Something the file must say for this command.
    #[error("{file}: `{key}` is missing: write for example `{example}`, or give {option}", file = .file.display())]
    Missing {
        /// The system file.
        file: PathBuf,
        /// The key.
        key: &'static str,
        /// A line with it.
        example: &'static str,
        /// The option that replaces it.
        option: &'static str,
    },
    /// A file that cannot be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The series cannot be derived, or is too large.
    #[error("{}: {source}", .file.display())]
    Derive {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: DeriveError,
    },
    /// No truncation and step can be picked.
    #[error("{}: {source}", .file.display())]
    Tolerance {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: ToleranceError,
    },
    /// The series is too large to write as Rust.
    #[error("{}: {source}", .file.display())]
    Size {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: TooManyTerms,
    },
    /// The system is not written as C.
    #[error("{}: {source}", .file.display())]
    Header {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: HeaderError,
    },
    /// The data defines no group.
    #[error("{}: {source}", .file.display())]
    Group {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: TableError,
    },
    /// The initial group element is none.
    #[error("{}: `group_element` in [initial]: {source}", .file.display())]
    Element {
        /// The system file.
        file: PathBuf,
        /// Why.
        source: ElementError,
    },
    /// A file that cannot be written.
    #[error("cannot write {}: {message}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        message: String,
    },
    /// A step that could not be made.
    #[error("at time {time}: {source}")]
    Step {
        /// When.
        time: f64,
        /// Why.
        source: StepError,
    },
    /// A run that stopped.
    #[error("at time {time}, step {step}: {what}")]
    Run {
        /// When.
        time: f64,
        /// The number of the step, from 1; 0 for the start.
        step: u64,
        /// Why.
        what: String,
    },
    /// A run that was asked to stop.
    #[error("{0}")]
    Interrupted(String),
    /// The method run beside the integrator failed.
    #[error("the comparison with rk45 failed: {0}")]
    Rival(String),
    /// Learning failed, or its data or model cannot be used.
    #[error(transparent)]
    Learn(#[from] coadjoint_learn::LearnError),
    /// No row of an ensemble has an end state; the report has been printed.
    #[error(
        "no trajectory reached the end: all {failed} rows failed{}",
        .list.as_ref().map(|list| format!("; {} says why", list.display())).unwrap_or_default()
    )]
    Rows {
        /// How many.
        failed: u64,
        /// The list of reasons.
        list: Option<PathBuf>,
    },
    /// A device that failed on the way.
    #[error("{0}")]
    Device(coadjoint_device::DeviceError),
    /// Nothing can be said of some rows; what was found has been printed.
    #[error("{0}")]
    NotJudged(String),
    /// Laws that do not hold; the table has been printed.
    #[error("{0}")]
    Laws(String),
}

impl CliError {
    /// 2 for bad input, 3 for what could not be judged, 130 for an interruption, 1 for everything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_)
            | Self::Option(_)
            | Self::Missing { .. }
            | Self::Read { .. }
            | Self::Derive { .. }
            | Self::Tolerance { .. }
            | Self::Size { .. }
            | Self::Header { .. }
            | Self::Group { .. }
            | Self::Element { .. } => 2,
            Self::Learn(error) => {
                if error.is_input() {
                    2
                } else {
                    1
                }
            }
            Self::Rows { .. }
            | Self::Device(_)
            | Self::Write { .. }
            | Self::Step { .. }
            | Self::Run { .. }
            | Self::Rival(_)
            | Self::Laws(_) => 1,
            Self::NotJudged(_) => 3,
            Self::Interrupted(_) => 130,
        }
    }

    /// The message for the terminal, with its line end.
    pub fn text(&self) -> String {
        match self {
            // Rendered mistakes begin with their own places.
            Self::Input(text) => text.clone(),
            other => format!("error: {other}\n"),
        }
    }
}
