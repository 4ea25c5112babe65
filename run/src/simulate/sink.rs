//! The receiver of a run's records.

use coadjoint_codegen::step::Scales;
use serde::{Deserialize, Deserializer, Serialize};

use super::blocks::Block;
use super::tally::{Moment, Tally};

/// A sink ends the run here; it knows why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Halt;

/// Facts about a run before its first step.
#[derive(Clone, Copy, Debug)]
pub struct Begun<'a> {
    /// The names of the momentum's coordinates.
    pub coordinates: &'a [String],
    /// The blocks of the group's matrices that records hold.
    pub blocks: &'a [Block],
    /// Marks the drifts that exist: of the spatial momentum, the Casimirs and the energy.
    pub known: [bool; 3],
    /// True if there is an energy.
    pub energy: bool,
    /// The sizes that drifts are relative to.
    pub scales: &'a Scales,
}

/// The drifts of a record, in the order of [`Drift`](super::Drift).
pub(crate) const DRIFTS: [&str; 3] = ["spatial_momentum_drift", "casimir_drift", "energy_drift"];

impl Begun<'_> {
    /// The names of the columns of records: `time`, the coordinates of the momentum as the system file names them (`mu_1`,
    /// … where it names none), the entries of the blocks of g, row by row, as `g_11`, … by their places in the whole
    /// matrix (`g_1_12` in matrices of more than nine rows), the energy and the drifts that there are.
    pub fn columns(&self) -> Vec<String> {
        let drifts =
            DRIFTS.iter().zip(self.known).filter_map(|(name, known)| known.then_some(*name));
        let last: Vec<&str> = self.energy.then_some("energy").into_iter().chain(drifts).collect();
        let size = self.blocks.last().map_or(0, |block| block.range.end);
        let separator = if size > 9 { "_" } else { "" };
        let entries = self.blocks.iter().flat_map(Block::places);
        let elements: Vec<String> =
            entries.map(|(i, j)| format!("g_{}{separator}{}", i + 1, j + 1)).collect();
        let taken = |name: &String| {
            name == "time" || last.contains(&name.as_str()) || elements.contains(name)
        };
        let momentum = self.coordinates.iter().enumerate().map(|(i, name)| {
            if *name == format!("mu[{i}]") {
                format!("mu_{}", i + 1)
            } else if taken(name) {
                format!("momentum_{name}")
            } else {
                name.clone()
            }
        });
        let mut names = vec!["time".to_owned()];
        names.extend(momentum);
        names.extend(elements.iter().cloned());
        names.extend(last.into_iter().map(str::to_owned));
        names
    }
}

/// A state of a run that is to be kept.
pub struct Record<'a> {
    /// t.
    pub time: f64,
    /// μ.
    pub momentum: &'a [f64],
    /// The entries of the blocks of g, row by row; none where attitudes mean nothing.
    pub element: &'a [f64],
    /// The energy, where one is known, and the differences from the start.
    pub moment: Moment,
    /// The spatial momentum Ad*_g μ.
    pub spatial_momentum: &'a [f64],
}

/// The state of a run, complete enough to go on later.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Resume {
    /// Steps made.
    pub step: u64,
    /// μ.
    pub momentum: Vec<f64>,
    /// The numbers of g, as what makes the steps has them, and those that steps by collocation leave to the next one.
    #[serde(deserialize_with = "numbers")]
    pub element: Vec<f64>,
    /// The number of requested times recorded so far.
    pub times: usize,
    /// The maxima so far.
    pub(crate) tally: Tally,
}

/// Numbers in a file, in which those that are not known are null.
fn numbers<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect())
}

/// The receiver of a run's records, asked now and then whether to go on. Methods that it does not need do nothing.
pub trait Sink {
    /// The first state has been measured. Returns where to go on, if not from the start.
    ///
    /// # Errors
    /// To end the run.
    fn begin(&mut self, _begun: &Begun<'_>) -> Result<Option<Resume>, Halt> {
        Ok(None)
    }

    /// A record, in the order of time.
    ///
    /// # Errors
    /// To end the run.
    fn record(&mut self, _record: &Record<'_>) -> Result<(), Halt> {
        Ok(())
    }

    /// The drift was measured at this time.
    fn look(&mut self, _time: f64, _momentum: &[f64], _moment: &Moment) {}

    /// Between steps, about every ten milliseconds, and at the end: the number of steps made, whether this is the end, and a
    /// function that makes what the run would need to go on from here.
    ///
    /// # Errors
    /// To end the run.
    fn pause(&mut self, _steps: u64, _end: bool, _state: &dyn Fn() -> Resume) -> Result<(), Halt> {
        Ok(())
    }

    /// After the end, from time to time while the error is estimated: whether to leave that.
    fn stop(&mut self) -> bool {
        false
    }

    /// A warning that the user should see at once.
    fn warn(&mut self, _text: &str) {}
}

/// Takes nothing.
impl Sink for () {}

#[cfg(test)]
mod tests {
    use super::super::blocks::Representation;
    use super::*;

    #[test]
    fn columns_have_the_names_of_the_file_and_none_twice() {
        let blocks =
            [0..1, 1..2].map(|range| Block { range, kind: Representation::Real, orthogonal: 0 });
        let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let (scales, coordinates) = (Scales::default(), names(&["mu[0]", "energy", "x"]));
        let whole = Begun {
            coordinates: &coordinates,
            blocks: &blocks,
            known: [true; 3],
            energy: true,
            scales: &scales,
        };
        let found = whole.columns();
        assert_eq!(found[..6], names(&["time", "mu_1", "momentum_energy", "x", "g_11", "g_22"]));
        assert_eq!(found[6], "energy");
        assert_eq!(found[7..], names(&DRIFTS));
        let known = [false, true, false];
        let part =
            Begun { coordinates: &coordinates[1..2], blocks: &[], known, energy: false, ..whole };
        assert_eq!(part.columns(), names(&["time", "energy", "casimir_drift"]));
    }

    #[test]
    fn numbers_that_are_not_known_go_through_files() {
        let (element, tally) = (vec![0.5, f64::NAN], Tally::default());
        let state = Resume { step: 7, momentum: vec![1.0], element, times: 0, tally };
        let text = serde_json::to_string(&state).unwrap_or_default();
        let back: Option<Resume> = serde_json::from_str(&text).ok();
        let element = back.map_or_else(Vec::new, |back| back.element);
        assert!(matches!(element[..], [first, last] if first == 0.5 && last.is_nan()), "{text}");
    }
}
