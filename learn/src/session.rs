//! What `coadjoint learn` does: read, reduce, choose, fit, evaluate.

use std::path::PathBuf;

use coadjoint::{Chart, Phase};
use serde::{Deserialize, Serialize};

use crate::catalogue::{Visitor, visit};
use crate::data::{
    PairRows, Recording, ReducedData, Reduction, RowPolicy, Tolerances, read_columns, reduce,
};
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::evaluate::{Drifts, Figures, drifts, evaluate, evaluate_momenta};
use crate::function::{Generating, vector};
use crate::gaussian_process::{GaussianProcessOptions, fit_gaussian_process};
use crate::group::DataGroup;
use crate::model::Model;
use crate::momentum::{PoissonOptions, fit_poisson};
use crate::polynomial::{
    Candidate, SelectionOptions, fit_group_loss, fit_polynomial, folds, gradient_error,
    select_polynomial, split,
};
use crate::save::{ModelFile, TrainingRecord};

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
    /// A network (feature `neural`).
    Network,
    /// A quadratic polynomial and a network (feature `neural`).
    Hybrid,
}

/// What to learn from what.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Training data.
    pub data: PathBuf,
    /// Test data.
    pub test: Option<PathBuf>,
    /// The group's name.
    pub group: String,
    /// The chart's name.
    pub chart: String,
    /// Δt.
    pub step: f64,
    /// The kind of model.
    pub kind: Kind,
    /// The degree of a polynomial; `None` to choose.
    pub degree: Option<usize>,
    /// The ridge of a polynomial of given degree.
    pub ridge: f64,
    /// Refine by the distance on the group (polynomials only).
    pub group_loss: bool,
    /// Limits on attitudes and momenta.
    pub tolerances: Tolerances,
    /// What to do with bad rows.
    pub policy: RowPolicy,
    /// Leave attitudes aside and learn the Poisson map of momenta.
    pub momenta_only: bool,
    /// The momentum drifts are measured from; `None`: the first sample.
    pub start: Option<Vec<f64>>,
    /// The seed of folds and weights.
    pub seed: u64,
    /// Steps over which drifts are measured.
    pub drift_steps: usize,
}

/// What came out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The kind of model.
    pub model: String,
    /// What was chosen, and why.
    pub choice: String,
    /// Errors on the training data.
    pub train: Figures,
    /// Errors on the test data.
    pub test: Option<Figures>,
    /// Drifts along a trajectory; absent where a step could not be made.
    pub drifts: Option<Drifts>,
    /// Rows left out of the training data, with the reason.
    pub dropped: Vec<(usize, String)>,
}

/// Learns, and says how well it went. `progress` is told (step, of, loss) by iterative fits.
///
/// # Errors
/// [`LearnError`] naming what is wrong with the data or the request.
pub fn learn(
    request: &Request,
    progress: &mut dyn FnMut(usize, usize, f64),
) -> Result<(ModelFile, Summary), LearnError> {
    if !(request.step.is_finite() && request.step != 0.0) {
        return Err(LearnError::InvalidOption {
            option: "dt",
            value: request.step.to_string(),
            requirement: "give the time between the two states of a pair".into(),
        });
    }
    visit(&request.group, &request.chart, Learner { request, progress })?
}

struct Learner<'a> {
    request: &'a Request,
    progress: &'a mut dyn FnMut(usize, usize, f64),
}

impl Visitor for Learner<'_> {
    type Output = Result<(ModelFile, Summary), LearnError>;

    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> Self::Output {
        let Self { request, progress } = self;
        let read = |path: &PathBuf| {
            let (dim, size) = (group.dim(), group.matrix_size());
            Recording::from_columns(&read_columns(path, dim, size)?, dim, size)
        };
        let recording = read(&request.data)?;
        let test = request.test.as_ref().map(read).transpose()?;
        if let Some(start) = &request.start
            && start.len() != group.dim()
        {
            let (expected, found) = (group.dim(), start.len());
            let what = "the start".into();
            return Err(LearnError::Shape { what, expected, found });
        }
        if request.momenta_only || recording.attitudes.is_none() {
            return from_momenta::<G, C>(request, &group, &recording, test.as_ref());
        }
        let pairs = |recording: &Recording| -> Result<(PairRows<G>, Reduction), LearnError> {
            let rows = recording.phase_pairs(&group, request.tolerances.attitude)?;
            let reduction = reduce::<G, C>(&group, &rows, request.tolerances, request.policy)?;
            // Errors are measured on the rows that were used.
            let used = rows.pairs.into_iter().filter(|(r, _)| reduction.rows.contains(r));
            Ok((PairRows { pairs: used.collect(), bad: Vec::new() }, reduction))
        };
        let (rows, reduction) = pairs(&recording)?;
        let test = test.as_ref().map(pairs).transpose()?;
        let data = &reduction.data;
        let (model, record) = fit::<G, C>(request, &group, data, progress)?;
        let map = Generating::<G, C, _>::new(group.clone(), &model);
        let train = evaluate(&map, &group, &rows, data);
        let test = test.map(|(rows, reduction)| evaluate(&map, &group, &rows, &reduction.data));
        let start = match &request.start {
            Some(mu) => Some(Phase::new(group.identity(), vector::<G>(mu))),
            None => rows.pairs.first().map(|(_, pair)| pair.before.clone()),
        };
        let summary = Summary {
            model: model.name().into(),
            choice: record.choice.clone(),
            train: train.clone(),
            test,
            drifts: start.and_then(|s| drifts(&map, &group, &s, request.drift_steps, None).ok()),
            dropped: named(&reduction.dropped),
        };
        let training = TrainingRecord { train: Some(train), ..record };
        let (name, chart) = (&request.group, &request.chart);
        let file = ModelFile::new(name, chart, request.step, true, model, training);
        Ok((file, summary))
    }
}

fn named(rows: &[BadRow]) -> Vec<(usize, String)> {
    rows.iter().map(|bad| (bad.row, bad.problem.to_string())).collect()
}

/// Momenta only: a polynomial with p eliminated, its degree by cross-validation if none is given.
fn from_momenta<G: DataGroup, C: Chart<G>>(
    request: &Request,
    group: &G,
    recording: &Recording,
    test: Option<&Recording>,
) -> Result<(ModelFile, Summary), LearnError> {
    if !matches!(request.kind, Kind::Auto | Kind::Polynomial) {
        return Err(LearnError::InvalidOption {
            option: "model",
            value: format!("{:?}", request.kind),
            requirement: "momenta alone are learned by polynomials; use auto or polynomial".into(),
        });
    }
    let pairs = &recording.momenta;
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
    let fit = |degree: usize, pairs: &crate::data::MomentumPairs| {
        fit_poisson::<G, C>(group, pairs, &PoissonOptions::degree(degree))
    };
    let figures = |model: &Model, pairs: &crate::data::MomentumPairs| {
        evaluate_momenta(&Generating::<G, C, _>::new(group.clone(), model), pairs)
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
            if crate::polynomial::Basis::size(group.dim(), degree) > 300 {
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
    let map = Generating::<G, C, _>::new(group.clone(), &model);
    let first = pairs.before.column_iter().next().map(|mu| mu.iter().copied().collect());
    let start: Option<Vec<f64>> = request.start.clone().or(first);
    let start = start.map(|mu| Phase::<G>::new(group.identity(), vector::<G>(&mu)));
    let summary = Summary {
        model: model.name().into(),
        choice: choice.clone(),
        train: train.clone(),
        test: test.map(|t| figures(&model, &t.momenta)),
        drifts: start.and_then(|s| drifts(&map, group, &s, request.drift_steps, None).ok()),
        dropped: named(&bad),
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

/// Fits the kind of model asked for.
fn fit<G: DataGroup, C: Chart<G>>(
    request: &Request,
    group: &G,
    data: &ReducedData,
    progress: &mut dyn FnMut(usize, usize, f64),
) -> Result<(Model, TrainingRecord), LearnError> {
    let mut record =
        TrainingRecord { samples: data.len(), seed: request.seed, ..TrainingRecord::default() };
    let selection = || {
        let options = SelectionOptions { seed: request.seed, ..SelectionOptions::default() };
        select_polynomial(data, &options)
    };
    let mut model = match request.kind {
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
            let options = GaussianProcessOptions::default();
            Model::GaussianProcess(fit_gaussian_process(data, &options)?)
        }
        Kind::Auto => automatic(request, data, selection()?, &mut record)?,
        Kind::Network | Kind::Hybrid => neural(request, data, &mut record, progress)?,
    };
    if request.group_loss {
        let Model::Polynomial(start) = &model else {
            return Err(LearnError::InvalidOption {
                option: "loss",
                value: "group".into(),
                requirement: "the distance on the group is minimised for polynomials only".into(),
            });
        };
        let options = crate::GaussNewton { iterations: 20, relative_decrease: 1e-6, ridge: 1e-15 };
        let (refined, history) = fit_group_loss::<G, C>(group, data, start, &options)?;
        record.choice += "; refined by the distance on the group";
        record.history = history;
        model = Model::Polynomial(refined);
    }
    Ok((model, record))
}

/// The best of the cross-validated polynomial and a Gaussian process held to one fold.
fn automatic(
    request: &Request,
    data: &ReducedData,
    selection: crate::polynomial::Selection,
    record: &mut TrainingRecord,
) -> Result<Model, LearnError> {
    record.candidates = selection.candidates;
    let held = folds(data.len(), 5, request.seed).into_iter().next().unwrap_or_default();
    let ((p, rest_p), (x, rest_x)) = (split(&data.p, &held), split(&data.x, &held));
    let rest = ReducedData { x: rest_x, p: rest_p, momenta: data.momenta.clone() };
    let options = GaussianProcessOptions { largest: 300, ..GaussianProcessOptions::default() };
    // A process that cannot be fitted is no candidate.
    if let Ok(process) = fit_gaussian_process(&rest, &options) {
        let mse = gradient_error(&process, &p, &x);
        let name = "Gaussian process".to_owned();
        record.candidates.push(Candidate { name, degree: options.mean_degree, ridge: 0.0, mse });
        if mse < selection.best.mse {
            record.choice = format!(
                "Gaussian process: held-out mse of x {mse:.1e}, best polynomial {:.1e}",
                selection.best.mse
            );
            return Ok(Model::GaussianProcess(fit_gaussian_process(data, &options)?));
        }
    }
    let best = &selection.best;
    record.choice =
        format!("{}: the best of all, cross-validated mse of x {:.1e}", best.name, best.mse);
    Ok(Model::Polynomial(selection.model))
}

#[cfg(not(feature = "neural"))]
fn neural(
    request: &Request,
    _data: &ReducedData,
    _record: &mut TrainingRecord,
    _progress: &mut dyn FnMut(usize, usize, f64),
) -> Result<Model, LearnError> {
    Err(LearnError::InvalidOption {
        option: "model",
        value: format!("{:?}", request.kind).to_lowercase(),
        requirement: "this build has no networks; build with --features neural".into(),
    })
}

#[cfg(feature = "neural")]
fn neural(
    request: &Request,
    data: &ReducedData,
    record: &mut TrainingRecord,
    progress: &mut dyn FnMut(usize, usize, f64),
) -> Result<Model, LearnError> {
    let options = crate::network::TrainingOptions { seed: request.seed, ..Default::default() };
    let mut tell = |p: crate::network::Progress| progress(p.step, p.total, p.loss);
    let (model, history) = if request.kind == Kind::Network {
        let (network, history) = crate::network::fit_network(data, &options, &mut tell)?;
        record.choice = format!("network {:?}, as asked", options.widths);
        (Model::Network(network), history)
    } else {
        let degree = request.degree.unwrap_or(2);
        record.choice = format!("polynomial degree {degree} and network {:?}", options.widths);
        crate::hybrid::fit_hybrid(data, degree, &options, &mut tell)?
    };
    record.history = history;
    Ok(model)
}
