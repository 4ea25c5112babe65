//! A session of `coadjoint learn`: read, reduce, choose, fit, evaluate.

mod choose;
mod momenta;
mod neural;
mod request;

use std::path::Path;

use coadjoint::Phase;
use coadjoint::groups::Chart;

pub use neural::remove_checkpoints;
pub use request::{Kind, Request, Summary};

use crate::catalogue::{Visitor, visit};
use crate::data::{Columns, MomentumPairs, PairRows, Recording, Reduction, read_columns, reduce};
use crate::error::LearnError;
use crate::evaluate::{drifts, evaluate};
use crate::function::{Generating, MomentumFunction, vector};
use crate::group::DataGroup;
use crate::network::Progress;
use crate::save::{ModelFile, TrainingRecord};
use request::{few_rows, named};

/// The training data, and test data where there are any.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// Files: CSV, NPY, NPZ, or Parquet where the feature is built in.
    Files(&'a Path, Option<&'a Path>),
    /// Columns that are named as those of files.
    Columns(&'a Columns, Option<&'a Columns>),
    /// Pairs of momenta made by any method, to find the Poisson map nearest to it.
    Momenta(&'a MomentumPairs),
}

/// Learns, and reports the errors. The training of networks calls `progress`.
///
/// # Errors
/// [`LearnError`] naming what is wrong with the data or the request.
pub fn learn(
    request: &Request,
    source: Source<'_>,
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
    source: Source<'a>,
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
        let of = |columns: &Columns| Recording::from_columns(columns, dim, size);
        let read = |path: &Path| of(&read_columns(path, dim, size)?);
        let (recording, test) = match source {
            Source::Files(data, test) => (read(data)?, test.map(read).transpose()?),
            Source::Columns(data, test) => (of(data)?, test.map(of).transpose()?),
            Source::Momenta(pairs) => {
                return momenta::learn::<G, C>(request, &group, pairs, None);
            }
        };
        if request.momenta_only || recording.attitudes.is_none() {
            let test = test.as_ref().map(|t| &t.momenta);
            let (file, summary) =
                momenta::learn::<G, C>(request, &group, &recording.momenta, test)?;
            return Ok((file, Summary { unused: recording.unused, ..summary }));
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
        let (model, record) = choose::fit(request, data, progress)?;
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
            warnings: Vec::from_iter(few_rows(&model, data.len())),
            unused: recording.unused,
        };
        let training = TrainingRecord { train: Some(train), ..record };
        let (group, chart) = (request.group.clone(), &request.chart);
        let file = ModelFile::new(group, chart, request.step, true, model, training);
        Ok((file, summary))
    }
}
