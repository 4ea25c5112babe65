//! A bounded choice of the moments of a run, for pictures.

use super::trajectory::{Drift, Record};

/// The number of first moments that are all kept.
const HEAD: usize = 512;
/// Of the rest, between half of this number and all of it are kept, unless they are large.
const MOST: usize = 4096;
/// The fewest that are kept however large they are, an even number.
const FEWEST: usize = 256;
/// The most numbers kept.
const NUMBERS: usize = 1 << 18;

/// The first moments of a run, and every 2^k-th of the rest with the largest drift since the one before,
/// so that thinning hides no peak.
#[derive(Clone, Debug)]
pub struct Samples {
    records: Vec<Record>,
    most: usize,
    stride: u64,
    /// How many moments were offered after the head.
    offered: u64,
    /// The largest drift since the last moment kept.
    pending: Option<Record>,
}

impl Samples {
    /// For momenta of this dimension.
    pub fn new(dim: usize) -> Self {
        let most = (NUMBERS / (dim + 5)).clamp(FEWEST, MOST) & !1;
        Self { records: Vec::new(), most, stride: 1, offered: 0, pending: None }
    }

    /// Offers the next moment.
    pub fn offer(&mut self, time: f64, momentum: &[f64], energy: f64, mut drift: Drift) {
        if let Some(pending) = &self.pending {
            drift.raise(pending.drift);
        }
        let record = || Record { time, momentum: momentum.to_vec(), energy, drift };
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
            if let Some(Record { drift, .. }) = before.take() {
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
    pub fn finish(mut self) -> Vec<Record> {
        self.records.extend(self.pending);
        self.records
    }

    /// All of it as bits.
    pub fn to_bits(&self) -> Vec<Vec<u64>> {
        let row = |record: &Record| {
            let Record { time, momentum, energy, drift } = record;
            let numbers =
                [*time, *energy].into_iter().chain(drift.numbers()).chain(momentum.iter().copied());
            numbers.map(f64::to_bits).collect()
        };
        let pending = self.pending.iter().map(row);
        let state = vec![self.stride, self.offered, u64::from(self.pending.is_some())];
        std::iter::once(state).chain(self.records.iter().map(row)).chain(pending).collect()
    }

    /// The inverse of [`Self::to_bits`]; `None` where the bits are of something else.
    pub fn from_bits(dim: usize, bits: &[Vec<u64>]) -> Option<Self> {
        let ([stride, offered, pending], rows) = bits
            .split_first()
            .and_then(|(state, rows)| Some((<[u64; 3]>::try_from(state.as_slice()).ok()?, rows)))?;
        let record = |row: &Vec<u64>| {
            let numbers: Vec<f64> = row.iter().copied().map(f64::from_bits).collect();
            let (&[time, energy, spatial_momentum, casimirs, lost], momentum) =
                numbers.split_first_chunk::<5>()?;
            let drift = Drift::of_numbers([spatial_momentum, casimirs, lost]);
            let fits = momentum.len() == dim;
            fits.then(|| Record { time, momentum: momentum.to_vec(), energy, drift })
        };
        let mut records = rows.iter().map(record).collect::<Option<Vec<_>>>()?;
        let pending = if pending == 0 { None } else { Some(records.pop()?) };
        (stride > 0).then(|| Self { records, stride, offered, pending, ..Self::new(dim) })
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
            samples.offer(n as f64, &[1.0, 2.0, 3.0], 0.5, drift);
            assert!(samples.records.len() <= HEAD + MOST);
        }
        let copy = Samples::from_bits(3, &samples.to_bits()).unwrap();
        let (records, copied) = (samples.finish(), copy.finish());
        assert_eq!(records, copied);
        assert!(records.windows(2).all(|pair| pair[0].time < pair[1].time));
        assert_eq!(records.last().unwrap().time, last as f64);
        assert!(records.len() > HEAD + MOST / 2);
        assert_eq!(records.iter().filter(|record| record.drift.energy == Some(1.0)).count(), 1);
    }
}
