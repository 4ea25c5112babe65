//! Everything that can go wrong in learning, with what to do about it.

use std::fmt;
use std::path::{Path, PathBuf};

/// Errors of reading, reducing and fitting data, and of saving and loading models.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the messages name the fields")]
pub enum LearnError {
    /// A file could not be read or written.
    #[error("cannot read or write {}: {source}", path.display())]
    File { path: PathBuf, source: std::io::Error },
    /// A file is not in the format its name promises.
    #[error("{} is not a readable {format} file: {reason}", path.display())]
    Format { path: PathBuf, format: &'static str, reason: String },
    /// The ending of a file name names no format this build reads.
    #[error("{}: the ending must be .csv, .npy, .npz or .parquet", .0.display())]
    UnknownFormat(PathBuf),
    /// A cell is not a number.
    #[error("row {row}, column {column}: `{text}` is not a number")]
    NotANumber { row: usize, column: String, text: String },
    /// A column that must be there is missing.
    #[error(
        "column {missing} is missing; the columns found are {}. Momenta are mu_1 … mu_{dim} before \
         and mu_next_1 … mu_next_{dim} after; attitudes g_11 … and g_next_11 …, or q_w, q_x, q_y, \
         q_z and q_next_w …",
        found.join(", ")
    )]
    MissingColumn { missing: String, dim: usize, found: Vec<String> },
    /// The columns do not have the same length, or an array not the right shape.
    #[error("{what} has {found} entries where {expected} are needed")]
    Shape { what: String, expected: usize, found: usize },
    /// There is not a single usable sample.
    #[error("the data hold no usable sample: give at least one row")]
    NoSamples,
    /// Attitudes are needed, and the data are momenta only.
    #[error(
        "the data hold momenta only: they determine the group increment only up to a rotation \
         about the momentum, so the attitude cannot be learned from them. Give g_… or q_… columns, \
         or ask for the Poisson map of momenta alone"
    )]
    NoAttitude,
    /// Attitudes are given as quaternions, which the group does not have.
    #[error("attitudes of this group cannot be given as quaternions; give g_11 … and g_next_11 …")]
    NoQuaternions,
    /// The matrices of g are those of Ad_g, and the group has a centre.
    #[error(
        "this group has a centre, whose elements all have Ad_g = 1, so the matrices of g do not determine the increment: leave \
         the columns of g out, and the Poisson map is learned from the momenta alone"
    )]
    Centre,
    /// Rows that cannot be used.
    #[error("{0}")]
    BadRows(BadRows),
    /// The samples do not determine the coefficients.
    #[error(
        "{samples} samples do not determine the {terms} coefficients of degree {degree} at ridge \
         {ridge:e}: give more samples, a lower degree, or a larger ridge"
    )]
    NotDetermined { degree: usize, terms: usize, samples: usize, ridge: f64 },
    /// A sample is outside the chart, or the model sends it there.
    #[error("a sample is out of reach of the {0} chart; use data with a smaller step")]
    OutOfChart(&'static str),
    /// The iteration of a fit could not begin or did not end.
    #[error("the fit did not converge: {0}")]
    NotConverged(String),
    /// The catalogue has no such group.
    #[error("group {name}: {reason}")]
    UnknownGroup { name: String, reason: String },
    /// The group has no such chart.
    #[error("{group} has no chart {chart}: {reason}")]
    NoChart { group: String, chart: String, reason: String },
    /// An option is out of its range.
    #[error("{option} is {value}: {requirement}")]
    InvalidOption { option: &'static str, value: String, requirement: String },
    /// Training cannot resume from a checkpoint.
    #[error("cannot resume from the checkpoint {path}: {1}; delete it to start again", path = .0.display())]
    Checkpoint(PathBuf, String),
    /// A model file is damaged or not one of ours.
    #[error("{path} is not a usable model file: {1}", path = .0.display())]
    Model(PathBuf, String),
}

impl LearnError {
    pub(crate) fn option(
        option: &'static str,
        value: impl fmt::Display,
        requirement: impl Into<String>,
    ) -> Self {
        Self::InvalidOption { option, value: value.to_string(), requirement: requirement.into() }
    }

    pub(crate) fn file(path: &Path) -> impl Fn(std::io::Error) -> Self {
        move |source| Self::File { path: path.into(), source }
    }

    /// A file that is not in its format.
    pub(crate) fn format(path: &Path, format: &'static str, reason: impl fmt::Display) -> Self {
        Self::Format { path: path.into(), format, reason: reason.to_string() }
    }

    /// True if the input (a file, an option) is at fault, not a computation.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::NotConverged(_) | Self::OutOfChart(_))
    }
}

/// A defect of one row of data.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RowProblem {
    /// A coordinate is NaN or infinite.
    #[error("a coordinate is NaN or infinite")]
    NonFinite,
    /// The attitude is not in the group: the largest difference of an entry from the nearest element of it.
    #[error("an attitude is {0:.1e} away from the group")]
    OffGroup(f64),
    /// J_L(α′) ≠ J_L(α″): the largest difference of a coordinate of the spatial momentum across the pair, relative to the
    /// largest coordinate.
    #[error("the spatial momentum differs by {0:.1e} across the pair")]
    MomentumMismatch(f64),
    /// A Casimir differs between the momenta before and after, by this relative to its size: no motion on the dual of this
    /// group's algebra leads from one to the other.
    #[error("a Casimir of the group differs by {0:.1e} across the pair")]
    CasimirMismatch(f64),
    /// The increment g′⁻¹g″ has no coordinate in the chart.
    #[error("the increment g'^-1 g'' has no coordinate in the chart")]
    OutOfChart,
    /// By the samples around it, the increment lies beyond the fold of the canonical momentum: det ∂p/∂μ′, which is
    /// positive short of the fold.
    #[error("the chart has folded here (det dp/dmu' is about {0:.1e}): two increments share one p")]
    Folded(f64),
    /// The increment lies beyond the fold of the canonical momentum in the chart, by a measure that is 1 at the fold.
    #[error("the increment lies beyond the fold of the chart ({0:.3}, the fold is at 1)")]
    BeyondFold(f64),
}

/// A row that cannot be used, by its number.
#[derive(Clone, Debug, PartialEq)]
pub struct BadRow {
    /// The data row, from 1 (a header not counted).
    pub row: usize,
    /// The message.
    pub problem: RowProblem,
}

/// All rows that cannot be used, and what to do.
#[derive(Clone, Debug, PartialEq)]
pub struct BadRows {
    /// The rows, in order.
    pub rows: Vec<BadRow>,
    /// Rows looked at.
    pub total: usize,
    /// The chart in use.
    pub chart: &'static str,
}

/// Rows listed by name before the message says "and … more".
const LISTED: usize = 10;

impl fmt::Display for BadRows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} rows cannot be used:", self.rows.len(), self.total)?;
        for bad in self.rows.iter().take(LISTED) {
            write!(f, "\n  row {}: {}", bad.row, bad.problem)?;
        }
        if self.rows.len() > LISTED {
            write!(f, "\n  and {} more", self.rows.len() - LISTED)?;
        }
        let has = |test: fn(&RowProblem) -> bool| self.rows.iter().any(|b| test(&b.problem));
        use RowProblem::{
            BeyondFold, CasimirMismatch, Folded, MomentumMismatch, OffGroup, OutOfChart,
        };
        if has(|p| matches!(p, BeyondFold(_) | Folded(_) | OutOfChart)) {
            f.write_str(match self.chart {
                "cayley" => "\nuse the exponential chart, which reaches further, or a smaller step",
                _ => "\nuse data with a smaller step",
            })?;
        }
        if has(|p| matches!(p, OffGroup(_) | MomentumMismatch(_))) {
            write!(
                f,
                "\nnoisy data can be used by raising the tolerances (--tolerance inf); they are then \
                 projected onto the group, and p is taken from the momentum after the step"
            )?;
        }
        if has(|p| matches!(p, CasimirMismatch(_))) {
            write!(
                f,
                "\neither the group is not that of the data, or they are noisy, or made by a method that does not keep the \
                 Casimirs: with --tolerance inf the Poisson map nearest to them is found"
            )?;
        }
        write!(f, "\nor drop these rows and go on (--drop-bad-rows)")
    }
}
