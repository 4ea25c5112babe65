//! Converged end states, read from `reference/end_states.json` (written by `reference/compute.py`).

use serde::Deserialize;

use crate::{
    arithmetic::Vector,
    state::{Rotation, State},
};

const FILE: &str = include_str!("../../reference/end_states.json");

/// Why a reference could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// The file is not what `reference/compute.py` writes.
    #[error("reference/end_states.json: {0}; write it again with reference/compute.py")]
    Format(#[from] serde_json::Error),
    /// No such entry.
    #[error(
        "reference/end_states.json has no entry `{0}`; add the problem to reference/compute.py and run it"
    )]
    Missing(String),
    /// A figure of the wrong shape.
    #[error("reference/end_states.json, entry `{entry}`: `{text}` is not a number")]
    Number {
        /// The entry.
        entry: String,
        /// What stands there.
        text: String,
    },
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    end: String,
    end_state: EndState,
}

#[derive(Deserialize)]
struct EndState {
    momentum: [String; 3],
    force: [String; 3],
    quaternion: [String; 4],
    position: [String; 3],
}

/// The end time and end state of a problem.
///
/// # Errors
/// When the file lacks the entry or is malformed.
pub fn end_state(name: &str) -> Result<(f64, State), ReferenceError> {
    let entries: Vec<Entry> = serde_json::from_str(FILE)?;
    let entry = entries
        .into_iter()
        .find(|e| e.name == name)
        .ok_or_else(|| ReferenceError::Missing(name.to_owned()))?;
    let state = State {
        momentum: numbers(name, &entry.end_state.momentum)?,
        force: numbers(name, &entry.end_state.force)?,
        rotation: Rotation::Quaternion(numbers(name, &entry.end_state.quaternion)?),
        position: numbers::<3>(name, &entry.end_state.position)? as Vector,
    };
    let [end] = numbers(name, &[entry.end])?;
    Ok((end, state))
}

fn numbers<const N: usize>(entry: &str, texts: &[String; N]) -> Result<[f64; N], ReferenceError> {
    let mut values = [0.0; N];
    for (value, text) in values.iter_mut().zip(texts) {
        *value = text
            .parse()
            .map_err(|_| ReferenceError::Number { entry: entry.to_owned(), text: text.clone() })?;
    }
    Ok(values)
}
