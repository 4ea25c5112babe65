//! Coefficients of a step: numbers once the step size and the parameters are known.

use std::collections::{BTreeSet, HashMap};

use num_traits::{One, ToPrimitive};

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
/// *Bases* are the C_m(h, parameters) of the generating function, the predictor and the energy; what
/// they have at one power of h is a *part*. *Slots* are what programs read: a base times a small
/// integer, which differentiation brings.
#[derive(Clone, Debug, Default)]
pub struct Coefficients {
    bases: Vec<Vec<Contribution>>,
    slots: Vec<(usize, u32)>,
    known: HashMap<(usize, u32), usize>,
    /// The monomials of the series S₁ + … + S_K, S_k having the power k of h; its bases are the
    /// first.
    monomials: Vec<Vec<(u32, u32)>>,
}

impl Coefficients {
    /// Adds a base coefficient and returns its number.
    pub(crate) fn add_base(&mut self, mut contributions: Vec<Contribution>) -> usize {
        contributions.sort_by_key(|contribution| contribution.step_power);
        self.bases.push(contributions);
        self.bases.len() - 1
    }

    /// A base and a slot for each of this many symbols: its value.
    pub(crate) fn of_symbols(count: usize) -> Self {
        let mut coefficients = Self::default();
        for symbol in 0..count {
            let mut symbol_powers = vec![0; count];
            symbol_powers[symbol] = 1;
            coefficients.add_product(0, symbol_powers);
        }
        coefficients
    }

    /// Adds a base and a slot that are a power of the step size times powers of symbols.
    pub(crate) fn add_product(&mut self, step_power: u32, symbol_powers: Vec<u32>) {
        let factor = Rational::one();
        let base = self.add_base(vec![Contribution { factor, step_power, symbol_powers }]);
        self.slot(base, 1);
    }

    /// Adds the bases and slots of another table, whose symbols come after `symbols` of this one; the number of its first slot.
    pub(crate) fn append(&mut self, other: &Self, symbols: usize) -> usize {
        let (base, slot) = (self.bases.len(), self.slots.len());
        let shifted = |term: &Contribution| {
            let symbol_powers = [&vec![0; symbols][..], &term.symbol_powers].concat();
            Contribution { symbol_powers, ..term.clone() }
        };
        self.bases.extend(other.bases.iter().map(|terms| terms.iter().map(shifted).collect()));
        self.slots.extend(other.slots.iter().map(|&(own, scale)| (base + own, scale)));
        slot
    }

    /// Declares the bases added so far to be those of the series with these terms.
    pub(crate) fn end_series(&mut self, terms: &[BaseTerm]) {
        self.monomials = terms.iter().map(|term| term.factors.clone()).collect();
    }

    /// The number of bases of the series S₁ + … + S_K; they come first.
    pub fn series(&self) -> usize {
        self.monomials.len()
    }

    /// The monomials of the series, each as (coordinate, exponent), ascending.
    pub fn monomials(&self) -> &[Vec<(u32, u32)>] {
        &self.monomials
    }

    /// The slot that holds `scale` times base number `base`.
    pub(crate) fn slot(&mut self, base: usize, scale: u32) -> usize {
        if let Some(&slot) = self.known.get(&(base, scale)) {
            return slot;
        }
        self.slots.push((base, scale));
        self.known.insert((base, scale), self.slots.len() - 1);
        self.slots.len() - 1
    }

    /// The summands of each base coefficient.
    pub fn bases(&self) -> &[Vec<Contribution>] {
        &self.bases
    }

    /// For each slot its base and the integer that multiplies it.
    pub fn slots(&self) -> &[(usize, u32)] {
        &self.slots
    }

    /// For each base its parts: the summands of one power of h.
    pub(crate) fn parts(&self) -> impl Iterator<Item = impl Iterator<Item = &[Contribution]>> {
        self.bases.iter().map(|base| base.chunk_by(|a, b| a.step_power == b.step_power))
    }

    /// The bases of the series that have a part of the order K or K − 2, each with that order: the coefficients of the
    /// last two terms. None for K = 1, where there is one term only.
    pub fn last_orders(&self, truncation: usize) -> impl Iterator<Item = (usize, usize)> {
        let parts = self.parts().enumerate().take(self.series());
        let orders = parts.flat_map(|(base, parts)| {
            parts.map(move |part| (part.first().map_or(0, |term| term.step_power as usize), base))
        });
        orders.filter(move |&(order, _)| truncation > 1 && order + 2 >= truncation)
    }

    /// The coordinates on which S₁ … S_K depend.
    pub(crate) fn of_series(&self) -> BTreeSet<usize> {
        let series = self.bases.iter().zip(&self.monomials);
        let series = series.filter(|(parts, _)| parts.iter().any(|term| term.step_power > 0));
        series.flat_map(|(_, factors)| factors.iter().map(|&(i, _)| i as usize)).collect()
    }

    /// The coordinates on which S₃ … S_K depend.
    pub(crate) fn beyond_first(&self) -> BTreeSet<usize> {
        let series = self.bases.iter().zip(&self.monomials);
        let beyond = series.filter(|(parts, _)| parts.iter().any(|term| term.step_power > 1));
        beyond.flat_map(|(_, factors)| factors.iter().map(|&(i, _)| i as usize)).collect()
    }
}

impl Contribution {
    /// The factor rounded to the nearest `f64`.
    pub(crate) fn rounded_factor(&self) -> f64 {
        self.factor.to_f64().unwrap_or(f64::NAN)
    }
}

/// A polynomial in the momenta whose coefficients are bases of a [`Coefficients`] table: S_h(p),
/// one component of the predictor, or the energy.
#[derive(Clone, Debug)]
pub(crate) struct BaseTerm {
    /// (coordinate, exponent), ascending, exponents positive.
    pub factors: Vec<(u32, u32)>,
    /// The number of the base coefficient.
    pub base: usize,
    /// The lowest power of h in the coefficient, k for a term of S_k.
    pub order: u32,
}

impl BaseTerm {
    /// The exponent of a coordinate.
    pub(crate) fn exponent(&self, coordinate: usize) -> u32 {
        let found = self.factors.binary_search_by_key(&coordinate, |&(i, _)| i as usize);
        found.map_or(0, |at| self.factors[at].1)
    }
}
