//! The drifts of a run in bounded memory.

/// Moments kept at most; then two become one.
const MOST: usize = 720;

/// The drifts of energy, momentum and Casimirs at a moment, ours and the rival's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    pub time: f64,
    /// Ours, then the rival's.
    pub drifts: [[f64; 3]; 2],
}

/// Moments, each standing for several of which it has the largest drifts.
#[derive(Clone, Debug)]
pub struct History {
    samples: Vec<Sample>,
    /// Moments that one stands for.
    width: usize,
    /// How many the last one has so far.
    filled: usize,
    most: [[f64; 3]; 2],
}

impl Default for History {
    fn default() -> Self {
        Self { samples: Vec::new(), width: 1, filled: 1, most: [[0.0; 3]; 2] }
    }
}

/// The larger of two; NaN where one is, so that what has left the numbers does not look well.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

fn raise(into: &mut [[f64; 3]; 2], by: &[[f64; 3]; 2]) {
    for (a, b) in into.iter_mut().flatten().zip(by.iter().flatten()) {
        *a = worse(*a, *b);
    }
}

impl History {
    pub fn push(&mut self, sample: Sample) {
        raise(&mut self.most, &sample.drifts);
        match self.samples.last_mut() {
            Some(last) if self.filled < self.width => {
                raise(&mut last.drifts, &sample.drifts);
                last.time = sample.time;
                self.filled += 1;
            }
            _ => {
                self.samples.push(sample);
                self.filled = 1;
            }
        }
        if self.samples.len() > MOST {
            let pair = |pair: &[Sample]| {
                let mut both = pair[0];
                for other in &pair[1..] {
                    raise(&mut both.drifts, &other.drifts);
                    both.time = other.time;
                }
                both
            };
            self.filled =
                if self.samples.len().is_multiple_of(2) { 2 * self.width } else { self.filled };
            self.samples = self.samples.chunks(2).map(pair).collect();
            self.width *= 2;
        }
    }

    /// The largest drifts so far: ours, then the rival's.
    pub fn most(&self) -> [[f64; 3]; 2] {
        self.most
    }

    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }
}
