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
    pub samples: Vec<Sample>,
    /// Moments so far, and how many of them one sample stands for.
    count: usize,
    width: usize,
    /// The largest drifts so far: ours, then the rival's.
    pub most: [[f64; 3]; 2],
}

impl Default for History {
    fn default() -> Self {
        Self { samples: Vec::new(), count: 0, width: 1, most: [[0.0; 3]; 2] }
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

impl Sample {
    /// Takes a later moment in.
    fn extend(&mut self, later: &Self) {
        raise(&mut self.drifts, &later.drifts);
        self.time = later.time;
    }
}

impl History {
    pub fn push(&mut self, sample: Sample) {
        raise(&mut self.most, &sample.drifts);
        match self.samples.get_mut(self.count / self.width) {
            Some(last) => last.extend(&sample),
            None => self.samples.push(sample),
        }
        self.count += 1;
        if self.samples.len() > MOST {
            self.width *= 2;
            let whole = |pair: &[Sample]| {
                let mut both = pair[0];
                pair[1..].iter().for_each(|later| both.extend(later));
                both
            };
            self.samples = self.samples.chunks(2).map(whole).collect();
        }
    }
}
