//! The errors of a run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use coadjoint::StepError;

/// Errors of a run.
///
/// Messages name settings as the command does, `--step` and so on; `file` is whatever the system was called.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// Mistakes in the text of a system, rendered with file, line and advice.
    #[error("{0}")]
    Input(String),
    /// A setting that does not make sense.
    #[error("{0}")]
    Option(String),
    /// Something that is neither in the text nor among the settings.
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
    /// A system that has no series, no steps of this accuracy, no group, or no text in another language.
    #[error("{}: {source}", .file.display())]
    System {
        /// The system file.
        file: PathBuf,
        /// The reason.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A step that could not be made.
    #[error("{}{source}", .time.map_or_else(String::new, |time| format!("at time {time}: ")))]
    Step {
        /// When, where steps are not of a system's at all times.
        time: Option<f64>,
        /// The reason.
        source: StepError,
    },
    /// A run that stopped.
    #[error("at time {time}, step {step}: {what}")]
    Run {
        /// When.
        time: f64,
        /// The number of the step, from 1; 0 for the start.
        step: u64,
        /// The reason.
        what: String,
    },
    /// The outlet asked to stop; it knows why.
    #[error("stopped at time {time}, after {step} steps")]
    Halted {
        /// When.
        time: f64,
        /// Steps made.
        step: u64,
    },
    /// A learned model that cannot be used.
    #[error(transparent)]
    Learn(#[from] coadjoint_learn::LearnError),
    /// A device that failed on the way.
    #[error("{0}")]
    Device(coadjoint_native::cards::DeviceError),
}

impl RunError {
    /// The error of a system, which is called `file`.
    pub(crate) fn of<E>(file: &Path) -> impl Fn(E) -> Self + '_
    where
        E: Into<Box<dyn std::error::Error + Send + Sync>>,
    {
        |source| Self::System { file: file.into(), source: source.into() }
    }

    /// The error of a system that says nothing about its step.
    pub fn no_step(file: &Path) -> Self {
        let (key, example, option) = ("[integrator] step", "step = 0.1", "--step 0.1");
        Self::Missing { file: file.into(), key, example, option }
    }

    /// The error of a system that says nothing about its time.
    pub(crate) fn no_time(file: &Path) -> Self {
        let (key, example, option) = ("[run] time", "time = 100.0", "--time 100");
        Self::Missing { file: file.into(), key, example, option }
    }

    /// The error of a step that cannot be made at this time.
    pub(crate) fn at(time: f64) -> impl Fn(StepError) -> Self {
        move |source| Self::Step { time: Some(time), source }
    }

    /// The error of steps that cannot be made at any time.
    pub(crate) fn unmade(source: StepError) -> Self {
        Self::Step { time: None, source }
    }

    /// True if the input is at fault, not the computation.
    pub fn is_input(&self) -> bool {
        match self {
            Self::Input(_) | Self::Option(_) | Self::Missing { .. } | Self::System { .. } => true,
            Self::Step { .. } | Self::Run { .. } | Self::Halted { .. } | Self::Device(_) => false,
            Self::Learn(error) => error.is_input(),
        }
    }
}

/// A text that stays, since errors hold texts that do. Each is kept once.
pub(crate) fn kept(text: &str) -> &'static str {
    static TEXTS: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    // A thread that panicked has added whole texts, if any.
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = texts.get(text) {
        return known;
    }
    let text = text.to_owned().leak();
    texts.insert(text);
    text
}
