//! The times of `--at`.

use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use sha2::{Digest, Sha256};

use super::schedule::Schedule;
use crate::error::RunError;
use crate::number::shortest;

/// How many times are written out in full where a run is described.
const LISTED: usize = 16;

/// The times to record, each once, in the order of the run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Times(pub Vec<f64>);

impl Times {
    /// Reads `1,2.5,3` or the name of a file with numbers between commas, spaces or line ends; `#`
    /// begins a comment there.
    ///
    /// # Errors
    /// Where it is neither, or a time is not in the run.
    pub fn read(argument: &str, schedule: &Schedule) -> Result<Self, RunError> {
        let refuse = |what: String| RunError::Option(format!("--at {argument}: {what}"));
        let list = argument.split(',').map(|word| word.trim().parse::<f64>());
        let times = match list.collect::<Result<Vec<f64>, _>>() {
            Ok(times) => times,
            Err(_) => read(Path::new(argument)).map_err(refuse)?,
        };
        Self::new(times, schedule).map_err(refuse)
    }

    /// These times, which must be in the run.
    ///
    /// # Errors
    /// Where there are none, or one is not in the run.
    pub fn new(mut times: Vec<f64>, schedule: &Schedule) -> Result<Self, String> {
        if times.is_empty() {
            return Err("no times are given".into());
        }
        let end = schedule.end;
        let within = |t: &f64| (0.0..=end.abs()).contains(&(t * end.signum()));
        if let Some(outside) = times.iter().find(|time| !within(time)) {
            let end = shortest(end);
            return Err(format!("{outside} is not between 0 and the end, {end}"));
        }
        times.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        times.dedup();
        Ok(Self(times))
    }

    /// The times in words, for the description of a run.
    pub fn text(&self) -> String {
        if self.0.len() <= LISTED {
            return self.0.iter().map(|&t| shortest(t)).collect::<Vec<_>>().join(",");
        }
        let mut hash = Sha256::new();
        self.0.iter().for_each(|time| hash.update(time.to_le_bytes()));
        format!("{} times, sha256 {:x}", self.0.len(), hash.finalize())
    }
}

fn read(path: &Path) -> Result<Vec<f64>, String> {
    let text = read_text(path).map_err(|error| {
        format!("neither numbers with commas between them nor a file that can be read ({error})")
    })?;
    let mut times = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words = line.split([',', ' ', '\t', '\r']).filter(|word| !word.is_empty());
        for word in words {
            let time = word.parse();
            times.push(time.map_err(|_| format!("line {}: `{word}` is no number", number + 1))?);
        }
    }
    Ok(times)
}
