//! Learning from momenta alone.

use coadjoint::{Chart, Phase};

use super::{Kind, Request, Summary, named};
use crate::data::{MomentumPairs, RowPolicy};
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::evaluate::{drifts, evaluate_momenta};
use crate::function::{Generating, MomentumFunction, vector};
use crate::group::DataGroup;
use crate::model::Model;
use crate::momentum::{PoissonOptions, fit_poisson};
use crate::polynomial::{Basis, Candidate, folds};
use crate::save::{ModelFile, TrainingRecord};

/// Momenta only: a polynomial with p eliminated, its degree by cross-validation if none is given.
pub(super) fn learn<G: DataGroup, C: Chart<G>>(
    request: &Request,
    group: &G,
    pairs: &MomentumPairs,
    test: Option<&MomentumPairs>,
) -> Result<(ModelFile, Summary), LearnError> {
    if !matches!(request.kind, Kind::Auto | Kind::Polynomial) {
        return Err(LearnError::InvalidOption {
            option: "model",
            value: request.kind.name().into(),
            requirement: "momenta alone are learned by polynomials; use auto or polynomial".into(),
        });
    }
    let bad: Vec<BadRow> = (0..pairs.len())
        .filter(|&i| {
            !pairs
                .before
                .column(i)
                .iter()
                .chain(pairs.after.column(i).iter())
                .all(|v| v.is_finite())
        })
        .map(|i| BadRow { row: i + 1, problem: RowProblem::NonFinite })
        .collect();
    if !bad.is_empty() && request.policy == RowPolicy::Refuse {
        return Err(LearnError::BadRows(BadRows { rows: bad, total: pairs.len(), chart: C::NAME }));
    }
    let kept: Vec<usize> =
        (0..pairs.len()).filter(|i| bad.iter().all(|b| b.row != i + 1)).collect();
    let pairs = pairs.select(&kept);
    let fit = |degree: usize, pairs: &MomentumPairs| {
        fit_poisson::<G, C>(group, pairs, &PoissonOptions::degree(degree))
    };
    let figures = |model: &Model, pairs: &MomentumPairs| {
        evaluate_momenta(
            &Generating::<G, C, &dyn MomentumFunction>::new(group.clone(), model),
            pairs,
        )
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
            if let Ok(found) = fit(degree, &outside) {
                let result = figures(&Model::Polynomial(found.model), &inside);
                if let Some(mse) = result.mse.momentum.filter(|_| result.unsolved.is_empty()) {
                    let name = format!("polynomial degree {degree}");
                    candidates.push(Candidate { name, degree, ridge: 1e-16, mse });
                }
            }
        }
        let best = candidates.iter().min_by(|a, b| a.mse.total_cmp(&b.mse)).ok_or_else(|| {
            LearnError::NotConverged { reason: "no degree from 2 to 6 could be fitted".into() }
        })?;
        let mse = best.mse;
        (best.degree, format!("{}: held-out mse of mu'' {mse:.1e}; p eliminated", best.name))
    };
    let fitted = fit(degree, &pairs)?;
    let model = Model::Polynomial(fitted.model);
    let train = figures(&model, &pairs);
    let map = Generating::<G, C, &dyn MomentumFunction>::new(group.clone(), &model);
    let first = pairs.before.column_iter().next().map(|mu| mu.iter().copied().collect());
    let start: Option<Vec<f64>> = request.start.clone().or(first);
    let start = start.map(|mu| Phase::<G>::new(group.identity(), vector::<G>(&mu)));
    let summary = Summary {
        model: model.name().into(),
        choice: choice.clone(),
        train: train.clone(),
        test: test.map(|t| figures(&model, t)),
        drifts: start.and_then(|s| drifts(&map, group, &s, request.drift_steps, None).ok()),
        dropped: named(&bad),
        unused: Vec::new(),
    };
    let training = TrainingRecord {
        samples: pairs.len(),
        seed: request.seed,
        choice,
        candidates,
        history: fitted.history,
        train: Some(train),
    };
    let (name, chart) = (&request.group, &request.chart);
    let file = ModelFile::new(name, chart, request.step, false, model, training);
    Ok((file, summary))
}
