//! Networks within a session.

use std::path::{Path, PathBuf};

use super::request::{Kind, Request};
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::hybrid::fit_hybrid;
use crate::model::Model;
use crate::network::{Progress, TrainingOptions, fit_network};

/// The endings that a session may append to the name of a checkpoint.
const ENDINGS: [&str; 4] = [".network", ".hybrid", ".network.held-out", ".hybrid.held-out"];

fn ending(base: &Path, ending: &str) -> PathBuf {
    let mut name = base.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Removes the checkpoints of a session that has ended, and whose model is safe.
///
/// # Errors
/// [`LearnError::File`] when one is there and cannot be removed.
pub fn remove_checkpoints(base: &Path) -> Result<(), LearnError> {
    for path in ENDINGS.map(|name| ending(base, name)) {
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                return Err(LearnError::File { path, source });
            }
            _ => {}
        }
    }
    Ok(())
}

/// A trained model.
pub(super) struct Trained {
    pub(super) model: Model,
    pub(super) name: String,
    pub(super) history: Vec<f64>,
}

/// Trains a network or a hybrid; `purpose` tells checkpoints apart.
pub(super) fn train(
    request: &Request,
    kind: Kind,
    data: &ReducedData,
    purpose: &str,
    progress: &mut dyn FnMut(usize, usize, f64),
) -> Result<Trained, LearnError> {
    let settings = &request.network;
    if settings.evaluations == 0 {
        return Err(LearnError::option("evaluations", 0, "a network is trained by at least one"));
    }
    let name = if kind == Kind::Network { "network" } else { "hybrid" };
    let adam_steps = settings.evaluations / 20;
    let options = TrainingOptions {
        widths: settings.widths.clone(),
        activation: settings.activation,
        adam_steps,
        lbfgs_steps: settings.evaluations - adam_steps,
        seed: request.seed,
        checkpoint: settings
            .checkpoint
            .as_ref()
            .map(|base| ending(base, &format!(".{name}{purpose}"))),
        ..TrainingOptions::default()
    };
    let mut tell = |p: Progress| progress(p.step, p.total, p.loss);
    let widths = &settings.widths;
    if kind == Kind::Network {
        let (network, history) = fit_network(&data.p, &data.x, None, &options, &mut tell)?;
        Ok(Trained { model: Model::Network(network), name: format!("network {widths:?}"), history })
    } else {
        let degree = request.degree.unwrap_or(2);
        let (model, history) = fit_hybrid(&data.p, &data.x, degree, &options, &mut tell)?;
        let name = format!("hybrid of degree {degree} and network {widths:?}");
        Ok(Trained { model, name, history })
    }
}
