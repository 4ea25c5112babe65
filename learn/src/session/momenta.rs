//! Learning from momenta alone.

use coadjoint::Phase;
use coadjoint::groups::{Chart, Coordinates};
use nalgebra::DMatrix;

use super::request::{Kind, Request, Summary, few_rows, named};
use crate::data::{MomentumPairs, RowPolicy};
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::evaluate::{drifts, evaluate_momenta};
use crate::function::{Generating, MomentumFunction, vector};
use crate::group::DataGroup;
use crate::model::Model;
use crate::momentum::{check, fit_poisson};
use crate::polynomial::{Basis, Candidate, folds};
use crate::save::{ModelFile, TrainingRecord};

/// The map that a model generates.
type Map<'a, G, C> = Generating<G, C, &'a dyn MomentumFunction>;

/// Momenta only: a polynomial with p eliminated, its degree by cross-validation if none is given.
pub(super) fn learn<G: DataGroup, C: Chart<G>>(
    request: &Request,
    group: &G,
    pairs: &MomentumPairs,
    test: Option<&MomentumPairs>,
) -> Result<(ModelFile, Summary), LearnError> {
    if !matches!(request.kind, Kind::Auto | Kind::Polynomial) {
        let requirement = "momenta alone are learned by polynomials; use auto or polynomial";
        return Err(LearnError::option("model", request.kind.name(), requirement));
    }
    if let Some(degree) = request.degree {
        check(group.dim(), degree, pairs.len())?;
    }
    let finite = |m: &DMatrix<f64>, i: usize| m.column(i).iter().all(|v| v.is_finite());
    let mut bad: Vec<BadRow> = (0..pairs.len())
        .filter(|&i| !(finite(&pairs.before, i) && finite(&pairs.after, i)))
        .map(|i| BadRow { row: i + 1, problem: RowProblem::NonFinite })
        .collect();
    let changes: Vec<f64> = (0..pairs.len()).map(|i| casimir_change(group, pairs, i)).collect();
    // A method that is not a Poisson map changes them; the learned map is the nearest that does not.
    if !request.momenta_only {
        let off =
            changes.iter().enumerate().filter(|(_, change)| **change > request.tolerances.momentum);
        bad.extend(off.map(|(i, &relative)| BadRow {
            row: i + 1,
            problem: RowProblem::CasimirMismatch(relative),
        }));
        bad.sort_by_key(|bad| bad.row);
    }
    if !bad.is_empty() && request.policy == RowPolicy::Refuse {
        return Err(LearnError::BadRows(BadRows { rows: bad, total: pairs.len(), chart: C::NAME }));
    }
    let kept: Vec<usize> =
        (0..pairs.len()).filter(|i| bad.iter().all(|b| b.row != i + 1)).collect();
    let pairs = pairs.select(&kept);
    if pairs.is_empty() {
        return Err(LearnError::NoSamples);
    }
    // Each pair says as much as an orbit has dimensions.
    let orbit = group.dim() - group.casimir_count().min(group.dim());
    let fit = |degree: usize, pairs: &MomentumPairs| {
        let (terms, samples) = (Basis::size(group.dim(), degree), pairs.len());
        if orbit * samples < terms {
            return Err(LearnError::NotDetermined { degree, terms, samples, ridge: 0.0 });
        }
        fit_poisson::<G, C>(group, pairs, degree)
    };
    let figures = |model: &Model, pairs: &MomentumPairs| {
        evaluate_momenta(&Map::<'_, G, C>::new(group.clone(), model), pairs)
    };
    let mut candidates = Vec::new();
    let (degree, choice) = if let Some(degree) = request.degree {
        (degree, format!("polynomial degree {degree}, as asked; p eliminated"))
    } else {
        // One split: a fifth of the samples is left out.
        let parts = folds(pairs.len(), 5, request.seed);
        let held = parts.first().cloned().unwrap_or_default();
        let rest: Vec<usize> = (0..pairs.len()).filter(|i| !held.contains(i)).collect();
        let (inside, outside) = (pairs.select(&held), pairs.select(&rest));
        for degree in 2..=6 {
            if Basis::size(group.dim(), degree) > 300 {
                break;
            }
            if let Ok((found, _)) = fit(degree, &outside) {
                let result = figures(&Model::Polynomial(found), &inside);
                if let Some(mse) = result.mse.momentum.filter(|_| result.unsolved.is_empty()) {
                    let name = format!("polynomial degree {degree}");
                    candidates.push(Candidate { name, degree, ridge: 1e-16, mse });
                }
            }
        }
        let best = match candidates.iter().min_by(|a, b| a.mse.total_cmp(&b.mse)) {
            Some(best) => best,
            // Why the lowest could not.
            None => {
                fit(2, &pairs)?;
                fit(2, &outside)?;
                let reason = "no degree from 2 to 6 could be fitted".into();
                return Err(LearnError::NotConverged(reason));
            }
        };
        let mse = best.mse;
        (best.degree, format!("{}: held-out mse of mu'' {mse:.1e}; p eliminated", best.name))
    };
    let (model, history) = fit(degree, &pairs)?;
    let model = Model::Polynomial(model);
    let train = figures(&model, &pairs);
    let map = Map::<'_, G, C>::new(group.clone(), &model);
    let first = pairs.before.column_iter().next().map(|mu| mu.iter().copied().collect());
    let mut warnings = Vec::from_iter(few_rows(&model, pairs.len()));
    let largest = changes.iter().copied().fold(0.0, f64::max);
    if largest > request.tolerances.momentum {
        warnings.push(format!(
            "Casimirs differ by up to {largest:.1e} between before and after; the learned map keeps them"
        ));
    }
    let start: Option<Vec<f64>> = request.start.clone().or(first);
    let start = start.map(|mu| Phase::<G>::new(group.identity(), vector::<G>(&mu)));
    let summary = Summary {
        model: model.name().into(),
        choice: choice.clone(),
        train: train.clone(),
        test: test.map(|t| figures(&model, t)),
        drifts: start.and_then(|s| drifts(&map, group, &s, request.drift_steps, None).ok()),
        dropped: named(&bad),
        warnings,
        unused: Vec::new(),
    };
    let training = TrainingRecord {
        samples: pairs.len(),
        seed: request.seed,
        choice,
        candidates,
        history,
        train: Some(train),
    };
    let (group, chart) = (request.group.clone(), &request.chart);
    let file = ModelFile::new(group, chart, request.step, false, model, training);
    Ok((file, summary))
}

/// The largest change of a Casimir from one momentum of a pair to the other, relative to its size before; where that is 0,
/// to the size of the momentum.
fn casimir_change<G: DataGroup>(group: &G, pairs: &MomentumPairs, pair: usize) -> f64 {
    let (before, after) = (pairs.before.column(pair), pairs.after.column(pair));
    let [before, after] = [before, after].map(|mu| vector::<G>(mu.as_slice()));
    let changes = (0..group.casimir_count()).map(|index| {
        let (was, is) = (group.casimir(index, &before), group.casimir(index, &after));
        let size = was.abs().max(before.largest_entry().powi(2) * f64::EPSILON.sqrt());
        if is == was { 0.0 } else { (is - was).abs() / size }
    });
    changes.fold(0.0, f64::max)
}
