//! A bounded choice of the moments of a run, for pictures.

use coadjoint_run::simulate::{Drift, DriftFields};
use serde::{Deserialize, Serialize};

/// The number of first moments that are all kept.
const HEAD: usize = 512;
/// The largest number kept of the rest. At least half of it is kept, unless moments are large.
const MOST: usize = 4096;
/// The fewest that are kept however large they are, an even number.
const FEWEST: usize = 256;
/// The most numbers kept.
const NUMBERS: usize = 1 << 18;

/// A moment kept for pictures.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub(crate) struct Sample {
    pub time: f64,
    pub momentum: Vec<f64>,
    /// The largest differences since the sample before.
    #[serde(with = "DriftFields")]
    pub drift: Drift,
}

/// The first moments of a run, and every 2^k-th of the rest with the largest drift since the one before,
/// so that thinning hides no peak.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub(crate) struct Samples {
    records: Vec<Sample>,
    most: usize,
    stride: u64,
    /// The number of moments offered after the head.
    offered: u64,
    /// The largest drift since the last moment kept.
    pending: Option<Sample>,
}

impl Samples {
    /// Keeps moments of this dimension.
    pub(crate) fn new(dim: usize) -> Self {
        let most = (NUMBERS / (dim + 5)).clamp(FEWEST, MOST) & !1;
        Self { records: Vec::new(), most, stride: 1, offered: 0, pending: None }
    }

    /// Offers the next moment.
    pub(crate) fn offer(&mut self, time: f64, momentum: &[f64], mut drift: Drift) {
        if let Some(pending) = &self.pending {
            drift.raise(pending.drift);
        }
        let record = || Sample { time, momentum: momentum.to_vec(), drift };
        if self.records.len() < HEAD {
            self.records.push(record());
            return;
        }
        if self.offered.is_multiple_of(self.stride) {
            self.records.push(record());
            self.pending = None;
            if self.records.len() == HEAD + self.most {
                self.thin();
            }
        } else {
            self.pending = Some(record());
        }
        self.offered += 1;
    }

    /// Drops every second record after the head.
    fn thin(&mut self) {
        let tail = self.records.split_off(HEAD);
        let mut before = None;
        for (place, mut record) in tail.into_iter().enumerate() {
            if let Some(Sample { drift, .. }) = before.take() {
                record.drift.raise(drift);
            }
            if place % 2 == 0 {
                self.records.push(record);
            } else {
                before = Some(record);
            }
        }
        self.pending = before;
        self.stride *= 2;
    }

    /// The records, the last moment offered among them.
    pub(crate) fn finish(mut self) -> Vec<Sample> {
        self.records.extend(self.pending);
        self.records
    }

    /// True if all momenta have this dimension; those of a file may not.
    pub(crate) fn fits(&self, dim: usize) -> bool {
        self.stride > 0 && self.records.iter().chain(&self.pending).all(|r| r.momentum.len() == dim)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_bounded_and_no_peak_is_hidden() {
        let mut samples = Samples::new(3);
        let last = 1_000_003;
        for n in 0..=last {
            let energy = Some(if n == 777_777 { 1.0 } else { 0.1 });
            let drift = Drift { energy, ..Drift::default() };
            samples.offer(n as f64, &[1.0, 2.0, 3.0], drift);
            assert!(samples.records.len() <= HEAD + MOST);
        }
        let text = serde_json::to_string(&samples).unwrap();
        assert_eq!(serde_json::from_str::<Samples>(&text).unwrap(), samples);
        let records = samples.finish();
        assert!(records.windows(2).all(|pair| pair[0].time < pair[1].time));
        assert_eq!(records.last().unwrap().time, last as f64);
        assert!(records.len() > HEAD + MOST / 2);
        assert_eq!(records.iter().filter(|record| record.drift.energy == Some(1.0)).count(), 1);
    }
}
