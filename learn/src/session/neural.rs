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

/// Trains a network or a hybrid; `purpose` tells checkpoints apart. Returns the model, its name and the losses.
pub(super) fn train(
    request: &Request,
    kind: Kind,
    data: &ReducedData,
    purpose: &str,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, String, Vec<f64>), LearnError> {
    let TrainingOptions { widths, adam_steps, lbfgs_steps, checkpoint, .. } = &request.network;
    if adam_steps + lbfgs_steps == 0 {
        return Err(LearnError::option("evaluations", 0, "a network is trained by at least one"));
    }
    let checkpoint = checkpoint.as_deref();
    let checkpoint = checkpoint.map(|base| ending(base, &format!(".{}{purpose}", kind.name())));
    let options = TrainingOptions { seed: request.seed, checkpoint, ..request.network.clone() };
    if kind == Kind::Network {
        let (network, history) = fit_network(&data.p, &data.x, None, &options, progress)?;
        return Ok((Model::Network(network), format!("network {widths:?}"), history));
    }
    let degree = request.degree.unwrap_or(2);
    let (model, history) = fit_hybrid(&data.p, &data.x, degree, &options, progress)?;
    Ok((model, format!("hybrid of degree {degree} and network {widths:?}"), history))
}
