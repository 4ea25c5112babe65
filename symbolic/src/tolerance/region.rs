//! Regions in which the momentum is assumed to stay.

use std::fmt;

use super::ToleranceError;

/// A set of momenta.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// Euclidean norm up to this.
    Ball(f64),
    /// Each coordinate between two bounds.
    Box(Vec<[f64; 2]>),
}

/// Points tried.
const POINTS: usize = 1500;
/// Points from which a larger value is looked for nearby, and how often.
const CLIMBS: usize = 4;
const STEPS: usize = 60;

impl Region {
    /// Refuses a region that is none.
    pub(super) fn check(&self, dim: usize) -> Result<(), ToleranceError> {
        let good = match self {
            Self::Ball(radius) => *radius > 0.0 && radius.is_finite(),
            Self::Box(bounds) => {
                if bounds.len() != dim {
                    return Err(ToleranceError::Bounds { found: bounds.len(), dim });
                }
                bounds.iter().all(|[low, high]| low <= high && (high - low).is_finite())
            }
        };
        if good { Ok(()) } else { Err(ToleranceError::Region) }
    }

    /// The largest value found of several functions on the region: among points spread over it, and
    /// climbing from the best. Not a proof, but the functions are smooth.
    pub(super) fn largest(
        &self,
        dim: usize,
        count: usize,
        values: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<f64> {
        let mut random = Random(1);
        let mut found: Vec<(Vec<f64>, Vec<f64>)> = Vec::with_capacity(POINTS);
        for number in 0..POINTS {
            let point = self.point(dim, number, &mut random);
            let value = values(&point);
            found.push((point, value));
        }
        (0..count)
            .map(|index| {
                found.sort_by(|a, b| b.1[index].total_cmp(&a.1[index]));
                let mut best = 0.0_f64;
                for (point, value) in found.iter().take(CLIMBS) {
                    let (mut here, mut height) = (point.clone(), value[index]);
                    let mut reach = 0.3;
                    for _ in 0..STEPS {
                        let next = self.near(&here, reach, &mut random);
                        let value = values(&next)[index];
                        if value > height {
                            (here, height) = (next, value);
                        } else {
                            reach *= 0.93;
                        }
                    }
                    best = best.max(height);
                }
                best
            })
            .collect()
    }

    /// Points spread over the region, half of them on its boundary.
    pub fn points(&self, dim: usize, count: usize) -> Vec<Vec<f64>> {
        let mut random = Random(1);
        (0..count).map(|number| self.point(dim, number, &mut random)).collect()
    }

    /// A point of the region: half of them on its boundary, where most maxima are.
    fn point(&self, dim: usize, number: usize, random: &mut Random) -> Vec<f64> {
        let inside = number % 2 == 1;
        match self {
            Self::Ball(radius) => {
                let direction: Vec<f64> = (0..dim).map(|_| random.normal()).collect();
                let norm = direction.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-300);
                let radius = if inside { radius * random.uniform() } else { *radius };
                direction.iter().map(|x| x * radius / norm).collect()
            }
            Self::Box(bounds) => bounds
                .iter()
                .map(|[low, high]| {
                    let u = random.uniform();
                    low + (high - low) * if inside { u } else { u.round() }
                })
                .collect(),
        }
    }

    /// A point of the region near another.
    fn near(&self, point: &[f64], reach: f64, random: &mut Random) -> Vec<f64> {
        match self {
            Self::Ball(radius) => {
                let moved: Vec<f64> =
                    point.iter().map(|x| x + reach * radius * random.normal()).collect();
                let norm = moved.iter().map(|x| x * x).sum::<f64>().sqrt();
                let factor = if norm > *radius { radius / norm } else { 1.0 };
                moved.iter().map(|x| x * factor).collect()
            }
            Self::Box(bounds) => point
                .iter()
                .zip(bounds)
                .map(|(x, [low, high])| {
                    (x + reach * (high - low) * random.normal()).clamp(*low, *high)
                })
                .collect(),
        }
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ball(radius) => write!(f, "|μ| ≤ {}", short(*radius)),
            Self::Box(bounds) => {
                let sides = bounds.iter().map(|[a, b]| format!("[{}, {}]", short(*a), short(*b)));
                f.write_str(&sides.collect::<Vec<_>>().join("×"))
            }
        }
    }
}

/// Three digits, rounded away from zero in the last for sizes.
fn short(value: f64) -> String {
    let digits = 2 - value.abs().max(1e-300).log10().floor() as i32;
    let scale = 10_f64.powi(digits);
    format!("{}", (value * scale).round() / scale)
}

/// The generator of Lehmer with the constants of L'Ecuyer's tables (64 bits): points must not
/// change from run to run, and nothing else is asked of them.
struct Random(u64);

impl Random {
    /// Between 0 and 1.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(2_862_933_555_777_941_757).wrapping_add(3_037_000_493);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// About normal: twelve uniform numbers less six.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}
