//! Requests to learn, and their results.

use serde::{Deserialize, Serialize};

use crate::data::{RowPolicy, Tolerances};
use crate::error::BadRow;
use crate::evaluate::{Drifts, Figures};
use crate::group_choice::GroupChoice;
use crate::model::Model;
use crate::network::TrainingOptions;

/// The kind of model asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Kind {
    /// Whichever cross-validates best.
    #[default]
    Auto,
    /// A polynomial, of the degree given or the one that cross-validates best.
    Polynomial,
    /// A Gaussian process.
    GaussianProcess,
    /// A network.
    Network,
    /// A quadratic polynomial and a network.
    Hybrid,
}

impl Kind {
    /// The name users write.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Polynomial => "polynomial",
            Self::GaussianProcess => "gp",
            Self::Network => "network",
            Self::Hybrid => "hybrid",
        }
    }
}

/// A request: the model to fit to some data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// The group.
    pub group: GroupChoice,
    /// The chart's name: `exp` or `cayley`.
    pub chart: String,
    /// The time Δt between the two states of a pair.
    pub step: f64,
    /// The kind of model.
    pub kind: Kind,
    /// The degree of a polynomial; `None` to choose.
    pub degree: Option<usize>,
    /// The ridge of a polynomial of given degree.
    pub ridge: f64,
    /// How far attitudes may be off the group, and momenta from being conserved.
    pub tolerances: Tolerances,
    /// Whether rows that cannot be used are an error or left out.
    pub policy: RowPolicy,
    /// Leave attitudes aside and learn the Poisson map of momenta.
    pub momenta_only: bool,
    /// The momentum drifts are measured from; `None`: the first sample.
    pub start: Option<Vec<f64>>,
    /// The seed of folds and weights.
    pub seed: u64,
    /// How networks are trained. Their seed is that of the request, and the names of their checkpoints begin with the one
    /// here.
    pub network: TrainingOptions,
    /// Steps over which drifts are measured.
    pub drift_steps: usize,
}

/// The results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The kind of model.
    pub model: String,
    /// The choice and its reason.
    pub choice: String,
    /// Errors on the training data.
    pub train: Figures,
    /// Errors on the test data.
    pub test: Option<Figures>,
    /// Drifts along a trajectory; absent where a step could not be made.
    pub drifts: Option<Drifts>,
    /// Rows left out of the training data, with the reason.
    pub dropped: Vec<(usize, String)>,
    /// Warnings, such as too few rows for the degree.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Columns of the training data that are neither a momentum nor an attitude.
    pub unused: Vec<String>,
}

/// A word about a polynomial with more coefficients than there were rows.
pub(super) fn few_rows(model: &Model, rows: usize) -> Option<String> {
    let Model::Polynomial(polynomial) = model else { return None };
    let coefficients = polynomial.basis().len();
    (rows < coefficients).then(|| {
        format!(
            "{rows} rows for {coefficients} coefficients: the errors on the training data say little; test the model on \
             other data, or lower the degree"
        )
    })
}

/// Rows with the problem of each in words.
pub(super) fn named(rows: &[BadRow]) -> Vec<(usize, String)> {
    rows.iter().map(|bad| (bad.row, bad.problem.to_string())).collect()
}
