//! Drifts of conserved quantities since the start of a run: their one definition.

use coadjoint_program::Program;

use crate::lie::{LieAlgebra, watched_casimirs};
use crate::poly::Numeric;
use crate::potential::{Force, Potential};
use crate::problem::{Problem, values};
use crate::smooth::{Hamiltonian, Smooth};

/// The largest differences from the start, each relative to its [scale](Scales). `None` where a quantity is not known, is
/// not conserved, or cannot be measured: an unknown drift is never 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// The drift of the spatial momentum J_L, or of its components that a potential leaves conserved.
    pub spatial_momentum: Option<f64>,
    /// The drift of the Casimirs.
    pub casimirs: Option<f64>,
    /// The drift of the energy.
    pub energy: Option<f64>,
}

impl Drift {
    /// Takes the larger of each; NaN where one is NaN, and the other where one is `None`.
    pub fn raise(&mut self, other: Self) {
        let larger = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(maximum(a, b)),
            (a, b) => a.or(b),
        };
        self.spatial_momentum = larger(self.spatial_momentum, other.spatial_momentum);
        self.casimirs = larger(self.casimirs, other.casimirs);
        self.energy = larger(self.energy, other.energy);
    }

    /// Spatial momentum, Casimirs, energy; NaN for `None`.
    pub fn numbers(self) -> [f64; 3] {
        [self.spatial_momentum, self.casimirs, self.energy].map(|drift| drift.unwrap_or(f64::NAN))
    }

    /// The inverse of [`Self::numbers`].
    pub fn of_numbers(numbers: [f64; 3]) -> Self {
        let [spatial_momentum, casimirs, energy] = numbers.map(|x| (!x.is_nan()).then_some(x));
        Self { spatial_momentum, casimirs, energy }
    }
}

/// An energy as a function of the momentum.
#[derive(Clone, Debug)]
pub enum Energy {
    /// A polynomial.
    Polynomial(Numeric),
    /// A smooth function, and the values of its symbols.
    Smooth(Box<Smooth>, Vec<f64>),
}

impl Energy {
    /// A Hamiltonian; a smooth one with the values that its input gives the parameters.
    pub fn new(hamiltonian: &Hamiltonian) -> Self {
        match hamiltonian {
            Hamiltonian::Polynomial(problem, _) => {
                let Problem { hamiltonian, algebra, symbols, .. } = &**problem;
                Self::Polynomial(Numeric::new(hamiltonian, algebra.dim(), &values(symbols)))
            }
            Hamiltonian::Smooth(smooth) => {
                Self::Smooth(smooth.clone(), smooth.symbols_at(&smooth.facts().defaults()))
            }
        }
    }

    /// H(t, μ).
    pub fn value(&self, time: f64, mu: &[f64]) -> f64 {
        match self {
            Self::Polynomial(polynomial) => polynomial.value(mu),
            Self::Smooth(smooth, symbols) => smooth.energy(symbols, time, mu),
        }
    }

    /// The sum of the absolute values of a polynomial's terms; of other functions the absolute value.
    pub fn magnitude(&self, time: f64, mu: &[f64]) -> f64 {
        match self {
            Self::Polynomial(polynomial) => polynomial.magnitude(mu),
            Self::Smooth(..) => self.value(time, mu).abs(),
        }
    }

    /// The expression that is not defined, or has no derivative, at (t, μ), and its argument there.
    pub fn undefined(&self, time: f64, mu: &[f64]) -> Option<(&str, f64)> {
        let Self::Smooth(smooth, symbols) = self else { return None };
        let (number, argument) = smooth.undefined(symbols, time, mu)?;
        Some((&smooth.expressions[number], argument))
    }

    /// ∂H/∂μ in `dim` coordinates.
    pub fn gradient(&self, dim: usize) -> Slopes<'_> {
        match self {
            Self::Polynomial(polynomial) => {
                let slopes = polynomial.gradient(dim);
                Box::new(move |_, mu| slopes.iter().map(|slope| slope.value(mu)).collect())
            }
            Self::Smooth(smooth, symbols) => {
                Box::new(|time, mu| smooth.gradient(symbols, time, mu))
            }
        }
    }
}

/// t, μ ↦ ∂H/∂μ(t, μ).
pub type Slopes<'a> = Box<dyn Fn(f64, &[f64]) -> Vec<f64> + 'a>;

/// The quantities that a motion conserves, as functions of its states.
#[derive(Clone, Debug, Default)]
pub struct Invariants {
    /// The ξ with ⟨J_L, ξ⟩ conserved, their largest coordinate being 1; `None` where all of J_L is conserved.
    pub directions: Option<Vec<Vec<f64>>>,
    /// The Casimirs of low degree that are conserved.
    pub casimirs: Vec<Numeric>,
    /// H_red(μ), where an energy is known and conserved.
    pub hamiltonian: Option<Energy>,
    /// The reason for which a known energy is not conserved.
    pub no_energy: Option<&'static str>,
    /// V(g), as a function of the entries of the matrix of g.
    pub potential: Option<PotentialEnergy>,
}

/// A potential as a function of the entries of the matrix of g, row by row.
#[derive(Clone, Debug)]
pub enum PotentialEnergy {
    /// A polynomial.
    Polynomial(Numeric),
    /// Another function, and its slots.
    Smooth(Program, Vec<f64>),
}

impl PotentialEnergy {
    /// V(g).
    pub fn value(&self, g: &[f64]) -> f64 {
        match self {
            Self::Polynomial(polynomial) => polynomial.value(g),
            Self::Smooth(program, slots) => {
                program.run(g, slots).first().copied().unwrap_or(f64::NAN)
            }
        }
    }

    /// The sum of the absolute values of a polynomial's terms; of other functions the absolute value.
    fn magnitude(&self, g: &[f64]) -> f64 {
        match self {
            Self::Polynomial(polynomial) => polynomial.magnitude(g),
            Self::Smooth(..) => self.value(g).abs(),
        }
    }
}

impl Invariants {
    /// Of every motion on the coadjoint orbits of this algebra that keeps the spatial momentum.
    pub fn of(algebra: &LieAlgebra) -> Self {
        let casimirs = watched_casimirs(algebra).into_iter();
        let casimirs = casimirs.map(|casimir| Numeric::new(&casimir, algebra.dim(), &[]));
        Self { casimirs: casimirs.collect(), ..Self::default() }
    }

    /// Of the motion with this Hamiltonian, with the kicks of a potential if there is one.
    pub fn new(algebra: &LieAlgebra, hamiltonian: Energy, potential: Option<&Potential>) -> Self {
        let dim = algebra.dim();
        let moves = matches!(&hamiltonian, Energy::Smooth(smooth, _) if smooth.moves);
        let moves = moves.then_some("not conserved: the Hamiltonian depends on time");
        let Some(potential) = potential else {
            let hamiltonian = moves.is_none().then_some(hamiltonian);
            return Self { hamiltonian, no_energy: moves, ..Self::of(algebra) };
        };
        let kept = watched_casimirs(algebra).into_iter();
        let kept = kept.filter(|casimir| potential.keeps(casimir));
        let symbols = values(&potential.symbols);
        let value = match &potential.force {
            Force::Polynomial(energy) => {
                let entries = potential.size().pow(2);
                Some(PotentialEnergy::Polynomial(Numeric::new(energy, entries, &symbols)))
            }
            Force::Smooth(programs) => {
                programs.value.clone().map(|value| PotentialEnergy::Smooth(value, symbols))
            }
        };
        let no_energy = match value {
            Some(_) => moves,
            None => Some("not conserved: a torque acts, which is not Hamiltonian"),
        };
        Self {
            directions: Some(potential.directions()),
            casimirs: kept.map(|casimir| Numeric::new(&casimir, dim, &[])).collect(),
            hamiltonian: no_energy.is_none().then_some(hamiltonian),
            no_energy,
            potential: value,
        }
    }

    /// The conserved quantities of the state of this time with this momentum and this spatial momentum; `matrix` makes the
    /// matrix of g, row by row, where a potential needs it.
    pub fn conserved(
        &self,
        time: f64,
        mu: &[f64],
        spatial: &[f64],
        matrix: impl Fn() -> Vec<f64>,
    ) -> Conserved {
        let along = |xi: &Vec<f64>| xi.iter().zip(spatial).map(|(xi, j)| xi * j).sum();
        Conserved {
            momenta: match &self.directions {
                None => spatial.to_vec(),
                Some(directions) => directions.iter().map(along).collect(),
            },
            casimirs: self.casimirs.iter().map(|casimir| casimir.value(mu)).collect(),
            energy: self.energy(time, mu, matrix, Energy::value, PotentialEnergy::value),
        }
    }

    /// The start of a run from that state.
    pub fn start(
        &self,
        time: f64,
        mu: &[f64],
        spatial: &[f64],
        matrix: impl Fn() -> Vec<f64>,
    ) -> Start {
        let conserved = self.conserved(time, mu, spatial, &matrix);
        let magnitude =
            self.energy(time, mu, matrix, Energy::magnitude, PotentialEnergy::magnitude);
        let magnitude = magnitude.unwrap_or(0.0);
        let casimirs = self.casimirs.iter();
        let scales = Scales {
            spatial_momentum: spatial.iter().fold(0.0, |size, j| maximum(size, j.abs())),
            casimirs: casimirs.map(|c| casimir_scale(|mu| c.value(mu), mu)).collect(),
            energy: energy_scale(conserved.energy.unwrap_or(0.0), magnitude),
        };
        Start { conserved, scales }
    }

    fn energy(
        &self,
        time: f64,
        mu: &[f64],
        matrix: impl Fn() -> Vec<f64>,
        of_kinetic: fn(&Energy, f64, &[f64]) -> f64,
        of: fn(&PotentialEnergy, &[f64]) -> f64,
    ) -> Option<f64> {
        let kinetic = of_kinetic(self.hamiltonian.as_ref()?, time, mu);
        Some(self.potential.as_ref().map_or(kinetic, |v| kinetic + of(v, &matrix())))
    }
}

/// The conserved quantities at one state; empty or `None` where nothing is known.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Conserved {
    /// The spatial momentum, or its components that are conserved.
    pub momenta: Vec<f64>,
    /// The Casimirs.
    pub casimirs: Vec<f64>,
    /// The energy.
    pub energy: Option<f64>,
}

/// The sizes that drifts are relative to; a drift whose scale is 0 is absolute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scales {
    /// The largest coordinate of the spatial momentum at the start.
    pub spatial_momentum: f64,
    /// The size of each Casimir at the start.
    pub casimirs: Vec<f64>,
    /// |E₀|, or where that is rounding the sum of the absolute values of its terms.
    pub energy: f64,
}

/// The start of a run, from which drifts are measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// The conserved quantities there.
    pub conserved: Conserved,
    /// The sizes that drifts are relative to.
    pub scales: Scales,
}

impl Start {
    /// The drift of a state with these conserved quantities.
    pub fn drift(&self, now: &Conserved) -> Drift {
        let Self { conserved: then, scales } = self;
        let momenta = now.momenta.iter().zip(&then.momenta);
        let momenta = momenta.map(|(now, then)| relative(now - then, scales.spatial_momentum));
        let casimirs = now.casimirs.iter().zip(&then.casimirs).zip(&scales.casimirs);
        let casimirs = casimirs.map(|((now, then), scale)| relative(now - then, *scale));
        let energy = now.energy.zip(then.energy);
        Drift {
            spatial_momentum: momenta.reduce(maximum),
            casimirs: casimirs.reduce(maximum),
            energy: energy.map(|(now, then)| relative(now - then, scales.energy)),
        }
    }

    /// The drift of a state, as far as it can be measured: where rounding of a state alone may move a conserved quantity by
    /// more than 1e-11 of its scale, as it does after long motions in groups that are not compact, there is none. `beside`
    /// is what is conserved of the state whose numbers are [nudged](nudge).
    pub fn measured(&self, now: &Conserved, beside: Conserved) -> Drift {
        let beside = Self { conserved: beside, scales: self.scales.clone() };
        let moved = beside.drift(now).numbers().map(|moved| moved * (f64::EPSILON / NUDGE));
        let mut drift = self.drift(now).numbers();
        for (drift, moved) in drift.iter_mut().zip(moved) {
            // NaN is not measured either.
            if !drift.is_finite() || moved.is_nan() || moved > MEASURABLE {
                *drift = f64::NAN;
            }
        }
        Drift::of_numbers(drift)
    }
}

/// Rounding of a state may move a quantity whose drift is measured by this much, relative to its scale.
pub const MEASURABLE: f64 = 1e-11;

/// The drift that rounding explains after this many steps of what every step conserves: it adds up at random, and each step
/// may round ten times.
pub fn rounding(steps: u64) -> f64 {
    10.0 * MEASURABLE * (steps.max(1) as f64).sqrt()
}

/// Far above rounding, and so small that what is conserved changes in proportion to it.
pub const NUDGE: f64 = 1e-9;

/// Moves each number by 1e-9, relatively, up or down without a pattern.
pub fn nudge(numbers: &mut [f64]) {
    for (place, number) in numbers.iter_mut().enumerate() {
        let up = (place as u32 + 1).wrapping_mul(0x9e37_79b9).count_ones().is_multiple_of(2);
        *number *= if up { 1.0 + NUDGE } else { 1.0 - NUDGE };
    }
}

/// |E₀|; where E₀ is 0 up to rounding, the sum of the absolute values of its terms (`magnitude`).
fn energy_scale(energy: f64, magnitude: f64) -> f64 {
    const ROUNDING: f64 = 64.0 * f64::EPSILON;
    if energy.abs() > ROUNDING * magnitude { energy.abs() } else { magnitude }
}

/// The largest |C| at μ, at (|μ₁|, …, |μₙ|), and there with one sign changed: a Casimir that starts at 0, such as Π·Γ of
/// a top, is measured against the size of its terms.
fn casimir_scale(mut casimir: impl FnMut(&[f64]) -> f64, momentum: &[f64]) -> f64 {
    let mut point: Vec<f64> = momentum.iter().map(|entry| entry.abs()).collect();
    let mut scale = maximum(casimir(momentum).abs(), casimir(&point).abs());
    for i in 0..point.len() {
        point[i] = -point[i];
        scale = maximum(scale, casimir(&point).abs());
        point[i] = -point[i];
    }
    scale
}

fn relative(difference: f64, scale: f64) -> f64 {
    if scale == 0.0 { difference.abs() } else { (difference / scale).abs() }
}

/// The larger of two numbers; NaN where one of them is, unlike `f64::max`.
fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_has_no_drift_and_nan_stays() {
        let start = Start {
            conserved: Conserved { momenta: vec![3.0, -4.0], ..Conserved::default() },
            scales: Scales { spatial_momentum: 4.0, ..Scales::default() },
        };
        let now = Conserved { momenta: vec![3.0, -4.5], casimirs: vec![1.0], energy: Some(2.0) };
        let mut drift = start.drift(&now);
        assert_eq!(drift, Drift { spatial_momentum: Some(0.125), ..Drift::default() });
        assert_eq!(Drift::of_numbers(drift.numbers()), drift);
        drift.raise(Drift { spatial_momentum: None, casimirs: Some(1.0), energy: Some(f64::NAN) });
        assert_eq!((drift.spatial_momentum, drift.casimirs), (Some(0.125), Some(1.0)));
        drift.raise(Drift { energy: Some(1.0), ..Drift::default() });
        assert!(drift.energy.is_some_and(f64::is_nan));
    }

    #[test]
    fn scales_are_those_of_the_start_unless_it_is_zero_to_rounding() {
        assert_eq!(energy_scale(-0.0475, 1.4525), 0.0475);
        assert_eq!(energy_scale(1e-17, 1.5), 1.5);
        assert_eq!(energy_scale(0.0, 0.0), 0.0);
        let product = |x: &[f64]| x[0] * x[2] + x[1] * x[3];
        assert_eq!(casimir_scale(product, &[1.0, 1.0, 2.0, -2.0]), 4.0);
    }
}
