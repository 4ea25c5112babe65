//! Model files: `model.json`.

use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::file;
use serde::{Deserialize, Serialize};

use crate::error::LearnError;
use crate::evaluate::Figures;
use crate::function::MomentumFunction;
use crate::group_choice::GroupChoice;
use crate::model::Model;
use crate::polynomial::Candidate;

/// The first field of every model file.
const FORMAT: &str = "coadjoint-model";
/// The version this build writes, and the only one it reads.
const VERSION: u32 = 1;

/// How a model came to be.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrainingRecord {
    /// The number of samples of the fit.
    pub samples: usize,
    /// The seed of everything random in the fit.
    pub seed: u64,
    /// The choice and its reason, in a sentence.
    pub choice: String,
    /// The candidates of a cross-validation, if there was one.
    pub candidates: Vec<Candidate>,
    /// The loss after every step of an iterative fit.
    pub history: Vec<f64>,
    /// The errors on the training data.
    pub train: Option<Figures>,
}

/// A learned generating function with all that is needed to use it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelFile {
    format: String,
    version: u32,
    /// The group.
    pub group: GroupChoice,
    /// The chart's name: `exp` or `cayley`.
    pub chart: String,
    /// Δt, the time one application of the map stands for.
    pub step: f64,
    /// Whether the data held attitudes. If not, the map of momenta is all that was learned, and
    /// the attitude must not be reconstructed from it.
    pub attitude: bool,
    /// How the model came to be.
    pub training: TrainingRecord,
    /// The function S.
    pub model: Model,
}

impl ModelFile {
    /// A model of the group, chart and step given.
    #[must_use]
    pub fn new(
        group: impl Into<GroupChoice>,
        chart: impl Into<String>,
        step: f64,
        attitude: bool,
        model: Model,
        training: TrainingRecord,
    ) -> Self {
        let (format, version) = (FORMAT.into(), VERSION);
        let (group, chart) = (group.into(), chart.into());
        Self { format, version, group, chart, step, attitude, training, model }
    }

    /// Writes the model as JSON; numbers read back to the same bits.
    ///
    /// # Errors
    /// [`LearnError::File`] when the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), LearnError> {
        let fail = LearnError::file(path);
        file::write(path, &[], self.text().map_err(&fail)?.as_bytes()).map_err(fail)
    }

    /// The model as JSON, as [`ModelFile::save`] writes it.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn text(&self) -> Result<String, std::io::Error> {
        Ok(serde_json::to_string(self)? + "\n")
    }

    /// Reads a model.
    ///
    /// # Errors
    /// [`LearnError::File`] when the file cannot be read, [`LearnError::Model`] when it is damaged,
    /// of another version, or something else altogether.
    pub fn load(path: &Path) -> Result<Self, LearnError> {
        let text = read_text(path).map_err(|source| match source.kind() {
            std::io::ErrorKind::InvalidData => {
                LearnError::Model(path.into(), "it is not a text file; models are JSON".into())
            }
            _ => LearnError::file(path)(source),
        })?;
        Self::of_text(path, &text)
    }

    /// Reads a model from its text; `path` is what mistakes call it.
    ///
    /// # Errors
    /// [`LearnError::Model`] when it is damaged, of another version, or something else altogether.
    pub fn of_text(path: &Path, text: &str) -> Result<Self, LearnError> {
        let fail = |reason: String| LearnError::Model(path.into(), reason);
        // The kind of file is checked first, so that the message is about that.
        let value: serde_json::Value =
            serde_json::from_str(text).map_err(|e| fail(format!("it is not whole JSON: {e}")))?;
        if value.get("format").and_then(|f| f.as_str()) != Some(FORMAT) {
            return Err(fail(format!("its field `format` is not `{FORMAT}`")));
        }
        let version = value.get("version").and_then(serde_json::Value::as_u64);
        if version != Some(u64::from(VERSION)) {
            let found = version.map_or("no version".into(), |v| format!("version {v}"));
            return Err(fail(format!("it has {found}; this build reads version {VERSION}")));
        }
        let file: Self = serde_json::from_value(value).map_err(|e| fail(e.to_string()))?;
        if !(file.step.is_finite() && file.step != 0.0) {
            return Err(fail(format!("its step {} is not a usable time", file.step)));
        }
        if file.model.dim() == 0 {
            return Err(fail("its model has no coordinates".into()));
        }
        Ok(file)
    }
}
