//! The loop that lowers a loss: Adam with a schedule, then L-BFGS, with checkpoints.

use super::checkpoint::{Stage, State};
use super::lbfgs::{Descent, Evaluate};
use super::options::{Progress, TrainingOptions};
use crate::error::LearnError;

/// Steps of Adam between two looks at the validation data.
const WATCH: usize = 10;
/// Steps of Adam between two checkpoints.
const SAVE: usize = 50;
/// Evaluations by L-BFGS between two checkpoints, which hold its whole memory: twenty rows of
/// unknowns.
const SAVE_MEMORY: usize = 200;

/// A loss on data that are watched, not fitted.
pub(super) type Watch<'a> = dyn FnMut(&[f64]) -> Result<f64, LearnError> + 'a;

/// Lowers the loss from `start`; returns the unknowns and the loss of every evaluation. `task` is
/// the fingerprint of everything the outcome depends on; `watch` is the loss on other data.
pub(super) fn minimise(
    start: Vec<f64>,
    task: u64,
    options: &TrainingOptions,
    evaluate: &mut Evaluate<'_>,
    watch: Option<&mut Watch<'_>>,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Vec<f64>, Vec<f64>), LearnError> {
    let mut watch = watch;
    let path = options.checkpoint.as_deref();
    let mut state = match path {
        Some(path) => State::load(path, task)?,
        None => None,
    }
    .unwrap_or_else(|| State::new(start));
    let save = |state: &State| path.map_or(Ok(()), |path| state.save(path, task));
    let total = options.adam_steps + options.lbfgs_steps;

    while state.history.len() < options.adam_steps {
        let Stage::Adam { weights, moments } = &mut state.stage else { break };
        let step = state.history.len();
        let (loss, gradient) = evaluate(weights)?;
        if !loss.is_finite() && step == 0 {
            let reason = "the loss is not finite at the first weights".into();
            return Err(LearnError::NotConverged { reason });
        }
        let validation = match &mut watch {
            Some(watch) if step % WATCH == 0 => Some(watch(weights)?),
            _ => None,
        };
        state.history.push(loss);
        progress(Progress { step, total, loss, validation });
        moments.step(step, options.rate(step), weights, &gradient);
        if (step + 1) % SAVE == 0 {
            save(&state)?;
        }
    }
    let mut saved = state.history.len();
    loop {
        let mut left = total.saturating_sub(state.history.len());
        let history = &mut state.history;
        let mut tell = |at: &[f64]| {
            let found = evaluate(at)?;
            progress(Progress { step: history.len(), total, loss: found.0, validation: None });
            history.push(found.0);
            Ok(found)
        };
        match &mut state.stage {
            Stage::Adam { weights, .. } if left >= 2 => {
                let weights = std::mem::take(weights);
                state.stage = Stage::Descent(Descent::begin(weights, &mut tell)?);
            }
            Stage::Descent(descent) if left >= 1 && !descent.stuck => {
                descent.advance(&mut left, &mut tell)?;
            }
            _ => break,
        }
        if state.history.len() >= saved + SAVE_MEMORY {
            save(&state)?;
            saved = state.history.len();
        }
    }
    if let Stage::Descent(descent) = &mut state.stage {
        // Nothing follows, so nothing need be remembered.
        descent.pairs.clear();
    }
    save(&state)?;
    let (weights, loss) = match state.stage {
        Stage::Descent(descent) => (descent.weights, descent.loss),
        Stage::Adam { weights, .. } => {
            let loss = evaluate(&weights)?.0;
            (weights, loss)
        }
    };
    let mut history = state.history;
    history.push(loss);
    Ok((weights, history))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::path::PathBuf;

    use super::*;

    /// A rippled quartic bowl in six variables.
    fn bowl(x: &[f64]) -> (f64, Vec<f64>) {
        let pull = |i: usize, v: f64| v - 0.1 * i as f64;
        let value = x.iter().enumerate().map(|(i, &v)| pull(i, v).powi(4) + pull(i, v).powi(2));
        let slope = |(i, &v): (usize, &f64)| 4.0 * pull(i, v).powi(3) + 2.0 * pull(i, v);
        let mut gradient: Vec<f64> = x.iter().enumerate().map(slope).collect();
        gradient[0] += 0.05 * (100.0 * x[0]).sin();
        (value.sum::<f64>() + 1e-3 * (50.0 * x[0]).sin().powi(2), gradient)
    }

    /// Runs until the evaluation `killed_at` fails, as a kill would.
    fn run(
        checkpoint: Option<PathBuf>,
        killed_at: usize,
    ) -> Result<(Vec<f64>, Vec<f64>), LearnError> {
        let options = TrainingOptions {
            adam_steps: 120,
            lbfgs_steps: 600,
            rate: 1e-2,
            checkpoint,
            ..TrainingOptions::default()
        };
        let mut count = 0;
        let mut evaluate = |x: &[f64]| {
            count += 1;
            if count == killed_at {
                return Err(LearnError::NotConverged { reason: "killed".into() });
            }
            Ok(bowl(x))
        };
        minimise(vec![1.0; 6], 7, &options, &mut evaluate, None, &mut |_| {})
    }

    #[test]
    fn a_killed_run_ends_with_the_bits_of_one_that_was_not() {
        let whole = run(None, usize::MAX).unwrap();
        // In Adam before and after a checkpoint, at its end, in the first and a later round.
        for killed_at in [1, 30, 77, 120, 150, 300] {
            let name = format!("coadjoint-kill-{}-{killed_at}", std::process::id());
            let path = std::env::temp_dir().join(name);
            if run(Some(path.clone()), killed_at).is_ok() {
                // The run was shorter than that.
                assert!(whole.1.len() < killed_at, "{} {killed_at}", whole.1.len());
            }
            assert_eq!(run(Some(path.clone()), usize::MAX).unwrap(), whole, "{killed_at}");
            // Once more: it is finished, and nothing is computed but the last loss.
            assert_eq!(run(Some(path.clone()), 2).unwrap(), whole);
            std::fs::remove_file(path).unwrap();
        }
    }
}
