//! The data by which coefficients are folded.

use std::collections::{BTreeMap, BTreeSet};

use coadjoint_program::fold::{Fold, FoldError, LastTerm, Values, gradient_bound};

use super::coefficients::Coefficients;
use super::lower::in_units;
use super::{Integrator, Kick, Kicks};
use crate::poly::Products;

/// A [`Fold`] that owns its lists.
#[derive(Clone, Debug, Default)]
pub struct FoldTable {
    products: Vec<(u32, u32)>,
    terms: Vec<(f64, u32)>,
    parts: Vec<(u32, u32)>,
    bases: Vec<u32>,
    slots: Vec<(u32, u32, u32)>,
    bound: Vec<(u32, f64, u32)>,
    kept: Vec<(u32, u32)>,
    last: Vec<LastTerm>,
    radius: Option<u32>,
    len: usize,
    /// The symbols that must not be negative.
    rates: Vec<usize>,
}

/// A monomial of the last two terms of the series: its base, its order, where its coefficient is kept, and how it counts in
/// each direct factor of the group.
struct OfSeries {
    base: usize,
    order: u32,
    place: Option<usize>,
    counts: Vec<LastTerm>,
}

impl FoldTable {
    /// All coefficients of an integrator, as its programs and those of a step read them: its slots; the bound on what is
    /// left out of the Hessian, by degrees; the square of the radius of the series; and the coefficients of its last two
    /// terms, in the order of [`Coefficients::last_orders`].
    pub fn new(integrator: &Integrator) -> Self {
        Self::placed(integrator, Some)
    }

    /// Puts each coefficient at the place that `place` gives, and leaves out those that have none.
    pub fn placed(integrator: &Integrator, place: impl Fn(usize) -> Option<usize>) -> Self {
        let coefficients = &integrator.coefficients;
        let bound_at = coefficients.slots().len();
        let radius_at = Self::radius_at(integrator);
        let bound = integrator.defect.iter().filter_map(|term| {
            let &(base, scale) = coefficients.slots().get(term.slot)?;
            let place = place(bound_at + term.degree as usize)?;
            Some((base, term.weight * f64::from(scale), place))
        });
        let last = last_terms(integrator, |number| place(radius_at + 1 + number));
        let len = (0..=radius_at + last.len()).filter_map(&place).max().map_or(0, |last| last + 1);
        let table = Self::assemble(coefficients, &place, bound.collect(), last);
        Self { radius: place(radius_at).map(number), len, ..table }
    }

    /// The place of the square of the radius.
    pub fn radius_at(integrator: &Integrator) -> usize {
        integrator.coefficients.slots().len() + integrator.defect_len()
    }

    /// The coefficients of a potential; none holds the step size.
    pub fn of_kick(kick: &Kick) -> Self {
        let mut table = Self::assemble(&kick.coefficients, Some, Vec::new(), Vec::new());
        table.len = kick.coefficients.slots().len();
        table
    }

    /// The values of this many symbols, those of the potential of kicks last, then the step size, the coefficients of kicks,
    /// and the square of a radius that is infinite; each where `place` wants it.
    pub fn of_symbols(
        count: usize,
        kicks: Option<&Kicks>,
        place: impl Fn(usize) -> Option<usize>,
    ) -> Self {
        let mut coefficients = Coefficients::of_symbols(count);
        coefficients.add_product(1, vec![0; count]);
        if let Some(Kicks { kick, .. }) = kicks {
            let before = count - kick.potential.symbols.len();
            coefficients.append(&kick.coefficients, before);
        }
        let radius_at = coefficients.slots().len();
        let table = Self::assemble(&coefficients, &place, Vec::new(), Vec::new());
        let len = (0..=radius_at).filter_map(&place).max().map_or(0, |last| last + 1);
        Self { radius: place(radius_at).map(number), len, ..table }
    }

    fn assemble(
        coefficients: &Coefficients,
        place: impl Fn(usize) -> Option<usize>,
        bound: Vec<(usize, f64, usize)>,
        last: Vec<OfSeries>,
    ) -> Self {
        let slots = coefficients.slots().iter().enumerate();
        let slots: Vec<(usize, u32, usize)> =
            slots.filter_map(|(slot, &(base, scale))| Some((base, scale, place(slot)?))).collect();
        let wanted = slots.iter().map(|slot| slot.0).chain(bound.iter().map(|term| term.0));
        let wanted: BTreeSet<usize> = wanted.chain(last.iter().map(|term| term.base)).collect();
        let numbers: BTreeMap<usize, u32> = wanted.into_iter().zip(0..).collect();
        let renumber = |base: usize| numbers.get(&base).copied().unwrap_or(0);

        let mut of_series: BTreeMap<(usize, u32), Vec<&OfSeries>> = BTreeMap::new();
        for own in &last {
            of_series.entry((own.base, own.order)).or_default().push(own);
        }
        let mut table = Self::default();
        let mut products = Products::default();
        for (base, parts) in coefficients.parts().enumerate() {
            if !numbers.contains_key(&base) {
                continue;
            }
            for part in parts {
                let power = part.first().map_or(0, |term| term.step_power);
                for own in of_series.get(&(base, power)).into_iter().flatten() {
                    let part = number(table.parts.len());
                    table.last.extend(own.counts.iter().map(|&(_, a, b, c, d)| (part, a, b, c, d)));
                    table.kept.extend(own.place.map(|place| (part, number(place))));
                }
                let terms = part.iter();
                table.terms.extend(
                    terms.map(|term| (term.rounded_factor(), products.add(&term.symbol_powers))),
                );
                table.parts.push((power, number(table.terms.len())));
            }
            table.bases.push(number(table.parts.len()));
        }
        table.products = products.into_made();
        table.slots = slots
            .into_iter()
            .map(|(base, scale, place)| (renumber(base), scale, number(place)))
            .collect();
        table.slots.sort_unstable();
        table.bound = bound
            .into_iter()
            .map(|(base, weight, place)| (renumber(base), weight, number(place)))
            .collect();
        table.bound.sort_by_key(|term| term.0);
        table
    }

    /// This table, which refuses negative values of these symbols.
    pub(crate) fn with_rates(self, rates: Vec<usize>) -> Self {
        Self { rates, ..self }
    }

    /// The lists.
    pub fn lists(&self) -> Fold<'_> {
        Fold {
            products: &self.products,
            terms: &self.terms,
            parts: &self.parts,
            bases: &self.bases,
            slots: &self.slots,
            bound: &self.bound,
            kept: &self.kept,
            last: &self.last,
            radius: self.radius,
        }
    }

    /// The number of coefficients.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The derivatives of the coefficients along a change of the symbols; those of the bound and of the radius, which are
    /// not smooth, are left 0.
    ///
    /// # Errors
    /// [`FoldError`] where one is not finite.
    pub fn slope(&self, step: f64, symbols: &[f64], change: &[f64]) -> Result<Vec<f64>, FoldError> {
        let at = |list: &[f64], i: u32| list.get(i as usize).copied().unwrap_or(f64::NAN);
        // Coefficients are linear in the products.
        let (mut products, mut slopes) = (vec![1.0], vec![0.0]);
        for &(of, symbol) in &self.products {
            let (product, slope) = (at(&products, of), at(&slopes, of));
            products.push(product * at(symbols, symbol));
            slopes.push(product * at(change, symbol) + slope * at(symbols, symbol));
        }
        let lists = Fold { bound: &[], radius: None, ..self.lists() };
        let mut coefficients = vec![0.0; self.len];
        slopes.resize(lists.room(), 0.0);
        lists.fold_products(step, &mut slopes, &mut coefficients)?;
        Ok(coefficients)
    }

    /// All coefficients for a step size and the values of the symbols.
    ///
    /// # Errors
    /// [`FoldError`] where one is not finite.
    pub fn fold(&self, step: f64, symbols: &[f64]) -> Result<Vec<f64>, FoldError> {
        self.folded(step, symbols).map(|(coefficients, _)| coefficients)
    }

    /// The coefficients of rows side by side, and the room they were folded in.
    fn folded<T: Values>(&self, step: f64, symbols: &[T]) -> Result<(Vec<T>, Vec<T>), FoldError> {
        let negative = |&i: &usize| symbols.get(i).is_some_and(|own| !own.all(|own| own >= 0.0));
        if let Some(i) = self.rates.iter().copied().find(negative) {
            return Err(FoldError::Symbol(i));
        }
        let [mut coefficients, mut room] =
            [self.len, self.lists().room()].map(|len| vec![T::each(|_| 0.0); len]);
        self.lists().fold_rows(step, symbols, &mut room, &mut coefficients)?;
        Ok((coefficients, room))
    }

    /// Folds for rows of symbols side by side. Also returns the |p| up to which the last two terms of the series have at
    /// most this ratio.
    ///
    /// # Errors
    /// As [`FoldTable::fold`].
    pub(crate) fn fold_rows<T: Values>(
        &self,
        step: f64,
        symbols: &[T],
        ratio: f64,
    ) -> Result<(Vec<T>, T), FoldError> {
        let (coefficients, room) = self.folded(step, symbols)?;
        Ok((coefficients, self.lists().radius(&room, ratio)))
    }
}

fn number(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

/// The monomials of S_K and S_{K−2}.
fn last_terms(integrator: &Integrator, place: impl Fn(usize) -> Option<usize>) -> Vec<OfSeries> {
    let coefficients = &integrator.coefficients;
    let truncation = integrator.problem.truncation;
    let factors = integrator.problem.algebra.factor_of_coordinates();
    let factor_of = |i: u32| factors.get(i as usize).copied().unwrap_or(0);
    let count = factors.last().map_or(0, |last| last + 1);
    let orders = coefficients.last_orders(truncation).enumerate().map(|(at, (order, base))| {
        let monomial = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        let counts = (0..count).filter_map(|factor| {
            let (degree, weight) = gradient_bound(monomial, factor_of, factor, f64::sqrt)?;
            let weight = weight / in_units(monomial, &integrator.units);
            Some((0, factor, order == truncation, degree, weight))
        });
        OfSeries { base, order: number(order), place: place(at), counts: counts.collect() }
    });
    orders.collect()
}
