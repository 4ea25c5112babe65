//! Which model is fitted, and why.

use super::neural::train;
use super::request::{Kind, Request};
use crate::data::ReducedData;
use crate::error::LearnError;
use crate::gaussian_process::fit_gaussian_process;
use crate::model::Model;
use crate::network::Progress;
use crate::polynomial::{
    Candidate, Selection, fit_polynomial, folds, gradient_error, select_polynomial, split,
};
use crate::save::TrainingRecord;

/// Networks are not tried where a polynomial leaves less than this part of the mean square of x:
/// no training so far has reached it.
const BEYOND_NETWORKS: f64 = 1e-16;
/// The most samples that Gaussian processes are conditioned on.
const LARGEST_PROCESS: usize = 300;

/// Fits the kind of model asked for.
pub(super) fn fit(
    request: &Request,
    data: &ReducedData,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, TrainingRecord), LearnError> {
    let mut record =
        TrainingRecord { samples: data.len(), seed: request.seed, ..TrainingRecord::default() };
    let selection = || select_polynomial(data, 2..=10, request.seed);
    let model = match request.kind {
        Kind::Polynomial | Kind::Auto if request.degree.is_some() => {
            let degree = request.degree.unwrap_or(2);
            record.choice = format!("polynomial degree {degree}, as asked");
            Model::Polynomial(fit_polynomial(data, degree, request.ridge)?)
        }
        Kind::Polynomial => {
            let found = selection()?;
            let mse = found.best.mse;
            record.choice = format!("{}: cross-validated mse of x {mse:.1e}", found.best.name);
            record.candidates = found.candidates;
            Model::Polynomial(found.model)
        }
        Kind::GaussianProcess => {
            record.choice = "Gaussian process, as asked".into();
            Model::GaussianProcess(fit_gaussian_process(data, LARGEST_PROCESS)?)
        }
        Kind::Auto => automatic(request, data, selection()?, &mut record, progress)?,
        Kind::Network | Kind::Hybrid => {
            let (model, name, history) = train(request, request.kind, data, "", progress)?;
            record.choice = format!("{name}, as asked");
            record.history = history;
            model
        }
    };
    Ok((model, record))
}

/// The best of every kind: polynomials by cross-validation over five folds; the
/// best of them, a Gaussian process and networks, which cost more, on the first of the folds.
fn automatic(
    request: &Request,
    data: &ReducedData,
    selection: Selection,
    record: &mut TrainingRecord,
    progress: &mut dyn FnMut(Progress),
) -> Result<Model, LearnError> {
    let Selection { model: polynomial, best, candidates } = selection;
    record.candidates = candidates;
    let held = folds(data.len(), 5, request.seed).into_iter().next().unwrap_or_default();
    let ((p, rest_p), (x, rest_x)) = (split(&data.p, &held), split(&data.x, &held));
    let rest = ReducedData { x: rest_x, p: rest_p, momenta: data.momenta.clone() };
    let mut rivals: Vec<(Kind, String, f64)> = Vec::new();
    // A model that cannot be fitted is no candidate.
    if let Ok(model) = fit_polynomial(&rest, best.degree, best.ridge) {
        rivals.push((Kind::Polynomial, best.name.clone(), gradient_error(&model, &p, &x)));
    }
    if let Ok(process) = fit_gaussian_process(&rest, LARGEST_PROCESS) {
        let mse = gradient_error(&process, &p, &x);
        rivals.push((Kind::GaussianProcess, "Gaussian process".into(), mse));
    }
    let square = x.norm_squared() / x.len().max(1) as f64;
    let least = rivals.iter().map(|r| r.2).fold(f64::INFINITY, f64::min);
    let mut remark = "";
    if least <= BEYOND_NETWORKS * square {
        remark = "; networks not tried: they cannot reach this";
    } else {
        for kind in [Kind::Network, Kind::Hybrid] {
            match train(request, kind, &rest, ".held-out", progress) {
                Ok((model, name, _)) => {
                    rivals.push((kind, name, gradient_error(&model, &p, &x)));
                }
                Err(error @ (LearnError::Checkpoint(..) | LearnError::File { .. })) => {
                    return Err(error);
                }
                Err(_) => {}
            }
        }
    }
    rivals.sort_by(|a, b| a.2.total_cmp(&b.2));
    for (kind, name, mse) in rivals.iter().filter(|r| r.0 != Kind::Polynomial) {
        let degree = if *kind == Kind::Network { 0 } else { 2 };
        record.candidates.push(Candidate { name: name.clone(), degree, ridge: 0.0, mse: *mse });
    }
    let shown: Vec<String> =
        rivals.iter().map(|(_, name, mse)| format!("{name} {mse:.1e}")).collect();
    let kind = rivals.first().map_or(Kind::Polynomial, |r| r.0);
    record.choice = match shown.split_first() {
        Some((first, others)) => {
            format!("{first}: held-out mse of x; against {}{remark}", others.join(", "))
        }
        None => best.name,
    };
    match kind {
        Kind::GaussianProcess => {
            Ok(Model::GaussianProcess(fit_gaussian_process(data, LARGEST_PROCESS)?))
        }
        Kind::Network | Kind::Hybrid => {
            let (model, _, history) = train(request, kind, data, "", progress)?;
            record.history = history;
            Ok(model)
        }
        Kind::Polynomial | Kind::Auto => Ok(Model::Polynomial(polynomial)),
    }
}
