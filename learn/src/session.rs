//! A session of `coadjoint learn`: read, reduce, choose, fit, evaluate.

use std::path::Path;

use coadjoint::Phase;
use coadjoint::groups::{Chart, Coordinates};
use coadjoint_codegen::file;
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::catalogue::{Visitor, visit};
use crate::data::{
    MomentumPairs, PairRows, Recording, ReducedData, Reduction, RowPolicy, TOLERANCE, open, reduce,
};
use crate::error::{BadRow, BadRows, LearnError, RowProblem};
use crate::evaluate::{Drifts, Figures, drifts, evaluate, evaluate_momenta};
use crate::function::{Generating, MomentumFunction, vector};
use crate::gaussian_process::fit_gaussian_process;
use crate::group::{DataGroup, GroupChoice};
use crate::model::{Model, ModelFile, TrainingRecord, fit_hybrid};
use crate::momentum::{check, fit_poisson};
use crate::network::{Progress, TrainingOptions, fit_network};
use crate::polynomial::{
    Basis, Candidate, Selection, fit_polynomial, folds, gradient_error, select_polynomial, split,
};
use crate::table::Table;

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
    pub(crate) fn name(self) -> &'static str {
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
    /// Bounds the distance of attitudes from the group and the change of conserved momenta; [`TOLERANCE`] if not given.
    pub tolerance: Option<f64>,
    /// Treatment of rows that cannot be used: an error, or left out.
    pub policy: RowPolicy,
    /// The momentum drifts are measured from; `None`: the first sample.
    pub start: Option<Vec<f64>>,
    /// The seed of folds and weights.
    pub seed: u64,
    /// Options of training networks. The seed is that of the request, and the names of checkpoints begin with the name given
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
fn few_rows(model: &Model, rows: usize) -> Option<String> {
    let Model::Polynomial(polynomial) = model else { return None };
    let coefficients = polynomial.basis().terms().len();
    (rows < coefficients).then(|| {
        format!(
            "{rows} rows for {coefficients} coefficients: the errors on the training data say little; test the model on \
             other data, or lower the degree"
        )
    })
}

/// Rows with the problem of each in words.
fn named(rows: &[BadRow]) -> Vec<(usize, String)> {
    rows.iter().map(|bad| (bad.row, bad.problem.to_string())).collect()
}

/// Tables whose columns are those of [`Recording`].
pub struct Dataset {
    /// The training data.
    pub data: Table,
    /// Test data, where there are any.
    pub test: Option<Table>,
}

impl Dataset {
    /// The data in these files: CSV, NPY, NPZ, or Parquet where the feature is built in.
    ///
    /// # Errors
    /// As [`open`].
    pub fn files(data: &Path, test: Option<&Path>) -> Result<Self, LearnError> {
        Ok(Self { data: open(data)?, test: test.map(open).transpose()? })
    }
}

/// Learns, and reports the errors. The training of networks calls `progress`.
///
/// # Errors
/// [`LearnError`] naming what is wrong with the data or the request.
pub fn learn(
    request: &Request,
    source: Dataset,
    progress: &mut dyn FnMut(Progress),
) -> Result<(ModelFile, Summary), LearnError> {
    if !(request.step.is_finite() && request.step != 0.0) {
        let requirement = "give the time between the two states of a pair";
        return Err(LearnError::option("dt", request.step, requirement));
    }
    let not_finite = |value: &&f64| !value.is_finite();
    if let Some(value) = request.start.iter().flatten().find(not_finite) {
        let requirement = "every coordinate of the momentum must be a finite number";
        return Err(LearnError::option("start", value, requirement));
    }
    if !(request.ridge.is_finite() && request.ridge >= 0.0) {
        return Err(LearnError::option("ridge", request.ridge, "give a finite number from 0"));
    }
    visit(&request.group, &request.chart, Learner { request, source, progress })?
}

struct Learner<'a> {
    request: &'a Request,
    source: Dataset,
    progress: &'a mut dyn FnMut(Progress),
}

impl Visitor for Learner<'_> {
    type Output = Result<(ModelFile, Summary), LearnError>;

    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> Self::Output {
        let Self { request, source, progress } = self;
        let (dim, size) = (group.dim(), group.matrix_size());
        if let Some(start) = &request.start
            && start.len() != dim
        {
            let what = "the start".into();
            return Err(LearnError::Shape { what, expected: dim, found: start.len() });
        }
        let read = |table: Table| Recording::read(table, dim, size);
        let (recording, test) = (read(source.data)?, source.test.map(read).transpose()?);
        if recording.attitudes.is_none() {
            let test = test.as_ref().map(|t| &t.momenta);
            let (file, summary) = learn_momenta::<G, C>(request, &group, &recording.momenta, test)?;
            return Ok((file, Summary { unused: recording.unused, ..summary }));
        }
        let tolerance = request.tolerance.unwrap_or(TOLERANCE);
        let pairs = |recording: &Recording| -> Result<(PairRows<G>, Reduction), LearnError> {
            let rows = recording.phase_pairs(&group, tolerance)?;
            let reduction = reduce::<G, C>(&group, &rows, tolerance, request.policy)?;
            // Errors are measured on the rows that were used.
            let used = rows.pairs.into_iter().filter(|(r, _)| reduction.rows.contains(r));
            Ok((PairRows { pairs: used.collect(), bad: Vec::new() }, reduction))
        };
        let (rows, reduction) = pairs(&recording)?;
        let test = test.as_ref().map(pairs).transpose()?;
        let data = &reduction.data;
        let (model, record) = fit(request, data, progress)?;
        let map = Generating::<G, C, &dyn MomentumFunction>::new(group.clone(), &model);
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
            warnings: Vec::from_iter(few_rows(&model, data.count())),
            unused: recording.unused,
        };
        let training = TrainingRecord { train: Some(train), ..record };
        let (group, chart) = (request.group.clone(), &request.chart);
        let file = ModelFile::new(group, chart, request.step, true, model, training);
        Ok((file, summary))
    }
}

/// Networks are not tried where a polynomial leaves less than this part of the mean square of x:
/// no training so far has reached it.
const BEYOND_NETWORKS: f64 = 1e-16;
/// The most samples that Gaussian processes are conditioned on.
const LARGEST_PROCESS: usize = 300;

/// Fits the kind of model asked for.
fn fit(
    request: &Request,
    data: &ReducedData,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Model, TrainingRecord), LearnError> {
    let mut record =
        TrainingRecord { samples: data.count(), seed: request.seed, ..TrainingRecord::default() };
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
    let held = folds(data.count(), 5, request.seed).into_iter().next().unwrap_or_default();
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

/// The map that a model generates.
type Map<'a, G, C> = Generating<G, C, &'a dyn MomentumFunction>;

/// Momenta only: a polynomial with p eliminated, its degree by cross-validation if none is given.
fn learn_momenta<G: DataGroup, C: Chart<G>>(
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
        check(group.dim(), degree, pairs.count())?;
    }
    let tolerance = request.tolerance.unwrap_or(TOLERANCE);
    let finite = |m: &DMatrix<f64>, i: usize| m.column(i).iter().all(|v| v.is_finite());
    let mut bad: Vec<BadRow> = (0..pairs.count())
        .filter(|&i| !(finite(&pairs.before, i) && finite(&pairs.after, i)))
        .map(|i| BadRow { row: i + 1, problem: RowProblem::NonFinite })
        .collect();
    let changes: Vec<f64> = (0..pairs.count()).map(|i| casimir_change(group, pairs, i)).collect();
    // A method that is not a Poisson map changes them; the learned map is the nearest that does not.
    let off = changes.iter().enumerate().filter(|(_, change)| **change > tolerance);
    bad.extend(off.map(|(i, &relative)| BadRow {
        row: i + 1,
        problem: RowProblem::CasimirMismatch(relative),
    }));
    bad.sort_by_key(|bad| bad.row);
    if !bad.is_empty() && request.policy == RowPolicy::Refuse {
        return Err(LearnError::BadRows(BadRows {
            rows: bad,
            total: pairs.count(),
            chart: C::NAME,
        }));
    }
    let kept: Vec<usize> =
        (0..pairs.count()).filter(|i| bad.iter().all(|b| b.row != i + 1)).collect();
    let pairs = pairs.select(&kept);
    if pairs.count() == 0 {
        return Err(LearnError::NoSamples);
    }
    // Each pair says as much as an orbit has dimensions.
    let orbit = group.dim() - group.casimir_count().min(group.dim());
    let fit = |degree: usize, pairs: &MomentumPairs| {
        let (terms, samples) = (Basis::size(group.dim(), degree), pairs.count());
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
        let parts = folds(pairs.count(), 5, request.seed);
        let held = parts.first().cloned().unwrap_or_default();
        let rest: Vec<usize> = (0..pairs.count()).filter(|i| !held.contains(i)).collect();
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
            // Report why the lowest degree could not be fitted.
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
    let mut warnings = Vec::from_iter(few_rows(&model, pairs.count()));
    let largest = changes.iter().copied().fold(0.0, f64::max);
    if largest > TOLERANCE {
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
        samples: pairs.count(),
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

/// The endings that a session may append to the name of a checkpoint.
const ENDINGS: [&str; 4] = [".network", ".hybrid", ".network.held-out", ".hybrid.held-out"];

/// Removes the checkpoints of a session that has ended, and whose model is safe.
///
/// # Errors
/// [`LearnError::File`] when one is there and cannot be removed.
pub fn remove_checkpoints(base: &Path) -> Result<(), LearnError> {
    for path in ENDINGS.map(|ending| file::beside(base, ending)) {
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
fn train(
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
    let ending = format!(".{}{purpose}", kind.name());
    let checkpoint = checkpoint.map(|base| file::beside(base, &ending));
    let options = TrainingOptions { seed: request.seed, checkpoint, ..request.network.clone() };
    if kind == Kind::Network {
        let (network, history) = fit_network(&data.p, &data.x, None, &options, progress)?;
        return Ok((Model::Network(network), format!("network {widths:?}"), history));
    }
    let degree = request.degree.unwrap_or(2);
    let (model, history) = fit_hybrid(&data.p, &data.x, degree, &options, progress)?;
    Ok((model, format!("hybrid of degree {degree} and network {widths:?}"), history))
}
