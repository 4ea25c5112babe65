//! Coefficients of a step: numbers once the step size and the parameters are known.

use std::collections::HashMap;

use num_traits::ToPrimitive;

use crate::number::Rational;

/// One summand factor · h^step_power · Π symbolᵢ^powerᵢ of a base coefficient.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contribution {
    /// The exact rational factor.
    pub factor: Rational,
    /// The power of the step size h.
    pub step_power: u32,
    /// The power of each opaque symbol.
    pub symbol_powers: Vec<u32>,
}

/// All coefficients a step needs.
///
/// *Bases* are the C_m(h, parameters) of the generating function, the predictor and the energy.
/// *Slots* are what programs read: a base times a small integer, which differentiation brings.
#[derive(Clone, Debug, Default)]
pub struct Coefficients {
    bases: Vec<Vec<Contribution>>,
    slots: Vec<(usize, u32)>,
    known: HashMap<(usize, u32), usize>,
    /// The first so many bases belong to the series S₁ + … + S_K, S_k having the power k of h.
    series: usize,
}

impl Coefficients {
    /// Adds a base coefficient and returns its number.
    pub fn add_base(&mut self, contributions: Vec<Contribution>) -> usize {
        self.bases.push(contributions);
        self.bases.len() - 1
    }

    /// Declares the bases added so far to be those of the series.
    pub fn end_series(&mut self) {
        self.series = self.bases.len();
    }

    /// How many bases belong to the series S₁ + … + S_K; they are the first.
    #[must_use]
    pub fn series(&self) -> usize {
        self.series
    }

    /// The slot that holds `scale` times base number `base`.
    pub fn slot(&mut self, base: usize, scale: u32) -> usize {
        if let Some(&slot) = self.known.get(&(base, scale)) {
            return slot;
        }
        self.slots.push((base, scale));
        self.known.insert((base, scale), self.slots.len() - 1);
        self.slots.len() - 1
    }

    /// The summands of each base coefficient.
    #[must_use]
    pub fn bases(&self) -> &[Vec<Contribution>] {
        &self.bases
    }

    /// For each slot its base and the integer that multiplies it.
    #[must_use]
    pub fn slots(&self) -> &[(usize, u32)] {
        &self.slots
    }

    /// The value of every slot for a step size and symbol values, by the same sequence of
    /// operations as emitted code.
    #[must_use]
    pub fn fold(&self, step: f64, symbols: &[f64]) -> Vec<f64> {
        self.fold_with(step, symbols, &|_| 1.0)
    }

    /// As [`Coefficients::fold`], S_k multiplied by `factor(k)`.
    #[must_use]
    pub fn fold_with(&self, step: f64, symbols: &[f64], factor: &dyn Fn(usize) -> f64) -> Vec<f64> {
        let base = |(number, base): (usize, &Vec<Contribution>)| {
            base.iter().fold(0.0, |sum, c| {
                let factor = if number < self.series { factor(c.step_power as usize) } else { 1.0 };
                sum + c.evaluate(step, symbols) * factor
            })
        };
        let bases: Vec<f64> = self.bases.iter().enumerate().map(base).collect();
        self.slots.iter().map(|&(base, scale)| bases[base] * f64::from(scale)).collect()
    }
}

impl Contribution {
    /// The factor rounded to the nearest `f64`.
    #[must_use]
    pub fn rounded_factor(&self) -> f64 {
        self.factor.to_f64().unwrap_or(f64::NAN)
    }

    fn evaluate(&self, step: f64, symbols: &[f64]) -> f64 {
        let mut product = self.rounded_factor();
        for _ in 0..self.step_power {
            product *= step;
        }
        for (&symbol, &power) in symbols.iter().zip(&self.symbol_powers) {
            for _ in 0..power {
                product *= symbol;
            }
        }
        product
    }
}
