//! S_h(p), its gradient and its Hessian, term by term.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::plan::{Part, Plan};
use super::wide::Wide;
use super::{DoubleDouble, JudgeError};
use crate::poly::split_at;

use crate::poly::Polynomial;

/// One term of S before a step size, parameters and a scale of the momentum are put in.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) value: Wide,
    /// k of t^k.
    pub(super) order: u32,
    /// The symbols' powers.
    pub(super) symbols: Vec<(usize, u32)>,
    /// Index of its monomial in the momenta.
    pub(super) monomial: usize,
}

/// S = Σ t^k S_k(p), ready for a step size.
#[derive(Clone, Debug)]
pub(super) struct Series {
    /// The direct factor of each coordinate.
    factors: Vec<usize>,
    pub(super) monomials: Vec<Vec<(usize, u32)>>,
    pub(super) terms: Vec<Term>,
    /// How they are evaluated; none before all terms are known.
    plan: Arc<Plan>,
    /// The last order and the one two before it, where the series has them.
    pub(super) last: Option<(u32, u32)>,
    /// Whether the coefficients hold the step size.
    counted: bool,
}

impl Series {
    fn empty(factors: &[usize]) -> Self {
        let (monomials, terms, plan) = (Vec::new(), Vec::new(), Arc::default());
        Self { factors: factors.to_vec(), monomials, terms, plan, last: None, counted: false }
    }

    /// From the polynomials S₁, S₂, … (any orders), whose variables beyond the coordinates are symbols; `factors` has the
    /// direct factor of each coordinate.
    pub(super) fn new<'a>(
        factors: &[usize],
        orders: impl IntoIterator<Item = (u32, &'a Polynomial)>,
    ) -> Self {
        let dim = factors.len();
        let mut index = BTreeMap::new();
        let mut result = Self::empty(factors);
        let mut known = Vec::new();
        for (order, polynomial) in orders {
            known.push(order);
            for (factors, value) in polynomial.factors() {
                let (momenta, symbols) = split_at(&factors, dim);
                let momenta: Vec<_> = momenta.iter().map(|&(i, e)| (i as usize, e)).collect();
                let symbols = symbols.iter().map(|&(i, e)| (i as usize - dim, e)).collect();
                let monomial = result.monomial(&mut index, momenta);
                result.terms.push(Term { value: Wide::rational(&value), order, symbols, monomial });
            }
        }
        result.finish(known);
        result
    }

    /// From terms (order, c, [(coordinate, power), …]) whose coefficients count the step size already.
    pub(super) fn from_terms(
        factors: &[usize],
        terms: impl IntoIterator<Item = (u32, f64, Vec<(usize, u32)>)>,
    ) -> Result<Self, JudgeError> {
        let dim = factors.len();
        let mut index = BTreeMap::new();
        let mut result = Self::empty(factors);
        let mut known = Vec::new();
        for (order, value, powers) in terms {
            let mut merged: BTreeMap<usize, u32> = BTreeMap::new();
            for (i, power) in powers {
                if i >= dim {
                    return Err(JudgeError::Coordinate { index: i, dim });
                }
                *merged.entry(i).or_insert(0) += power;
            }
            let momenta = merged.into_iter().filter(|f| f.1 > 0).collect();
            let monomial = result.monomial(&mut index, momenta);
            known.push(order);
            let value = Wide::of(value);
            result.terms.push(Term { value, order, symbols: Vec::new(), monomial });
        }
        result.finish(known);
        Ok(result)
    }

    fn monomial(
        &mut self,
        index: &mut BTreeMap<Vec<(usize, u32)>, usize>,
        factors: Vec<(usize, u32)>,
    ) -> usize {
        *index.entry(factors.clone()).or_insert_with(|| {
            self.monomials.push(factors);
            self.monomials.len() - 1
        })
    }

    /// The coefficients hold the step size already.
    pub(super) fn step_is_counted(&mut self) {
        self.counted = true;
    }

    /// Once all terms are known, of these orders.
    fn finish(&mut self, mut known: Vec<u32>) {
        self.plan = Arc::new(Plan::new(&self.factors, &self.monomials));
        // S is odd in t.
        known.retain(|order| order % 2 == 1);
        let last = known.iter().max().copied();
        self.last = last.filter(|&last| last >= 3).map(|last| (last, last - 2));
    }

    /// S(σq)/σ with σ = 2^scale, whose gradient in q is ∂S/∂p at p = σq.
    pub(super) fn folded(&self, step: f64, symbols: &[f64], scale: i64) -> Folded {
        let largest = self.terms.iter().map(|term| term.order).max().unwrap_or(0);
        let step = if self.counted { Wide::one() } else { Wide::of(step) };
        let powers: Vec<Wide> = (0..=largest).map(|k| step.power(k)).collect();
        let count = self.monomials.len();
        // Terms that cancel (in a spherical body, say) must not leave roundings of a double's size.
        let [mut exact, mut last, mut before] =
            [(); 3].map(|()| vec![DoubleDouble::default(); count]);
        let mut size = vec![0.0; count];
        for term in &self.terms {
            let mut value = term.value.times(powers[term.order as usize]);
            for &(i, power) in &term.symbols {
                let symbol = symbols.get(i).copied().unwrap_or(f64::NAN);
                value = value.times(Wide::of(symbol).power(power));
            }
            let degree: i64 = self.monomials[term.monomial].iter().map(|f| i64::from(f.1)).sum();
            let value = value.scaled(scale.saturating_mul(degree - 1));
            let at = term.monomial;
            exact[at] += value;
            size[at] += value.to_f64().abs();
            if let Some((of_last, of_before)) = self.last {
                if term.order == of_last {
                    last[at] += value;
                } else if term.order == of_before {
                    before[at] += value;
                }
            }
        }
        let plan = Arc::clone(&self.plan);
        let rounded = |v: &[DoubleDouble]| v.iter().map(|v| v.to_f64()).collect::<Vec<_>>();
        let double = rounded(&exact);
        let (last, before) = (plan.part(&rounded(&last)), plan.part(&rounded(&before)));
        Folded { plan, exact, double, size, last, before, has_two: self.last.is_some() }
    }
}

/// S of one step size, one set of parameters and one scale of the momentum.
#[derive(Clone, Debug)]
pub(super) struct Folded {
    plan: Arc<Plan>,
    exact: Vec<DoubleDouble>,
    double: Vec<f64>,
    /// Sums of the terms' absolute values.
    size: Vec<f64>,
    /// S_K, and S_{K−2}.
    last: Part,
    before: Part,
    has_two: bool,
}

/// A gradient and a Hessian, row by row.
pub(super) type Derivatives<T> = (Vec<T>, Vec<T>);

impl Folded {
    pub(super) fn is_finite(&self) -> bool {
        self.exact.iter().all(|c| c.is_finite())
    }

    /// Whether the series has two orders to compare.
    pub(super) fn has_two(&self) -> bool {
        self.has_two
    }

    /// ∂S/∂p in doubled precision.
    pub(super) fn gradient(&self, p: &[DoubleDouble]) -> Vec<DoubleDouble> {
        self.plan.first(&self.exact, &self.plan.products(p))
    }

    /// ∂S/∂p and its derivative in double precision.
    pub(super) fn derivatives(&self, p: &[f64]) -> Derivatives<f64> {
        let products = self.plan.products(p);
        (self.plan.first(&self.double, &products), self.plan.second(&self.double, &products))
    }

    /// The sums of the absolute values of the terms of ∂S/∂p at |p|, and of all monomials of ∂S_K/∂p and of
    /// ∂S_{K−2}/∂p in each direct factor.
    pub(super) fn absolute(&self, p: &[f64]) -> (Vec<f64>, [Vec<f64>; 2]) {
        let p: Vec<f64> = p.iter().map(|p| p.abs()).collect();
        let products = self.plan.products(&p);
        let last_two = [&self.last, &self.before].map(|part| part.at(&products));
        (self.plan.first(&self.size, &products), last_two)
    }

    /// Bounds on |∂S_K/∂p| and |∂S_{K−2}/∂p| of each direct factor in every direction, |p| of all factors being r.
    pub(super) fn last_two_anywhere(&self, r: f64) -> [Vec<f64>; 2] {
        [&self.last, &self.before].map(|part| part.anywhere(r))
    }

    /// For each degree d: a bound G on |∂S_d/∂p| / |p|^(d−1) and one on ‖Hess S_d‖ / |p|^(d−2), |.| being
    /// Euclidean: every factor is at most |p|.
    pub(super) fn growth(&self) -> Vec<(u32, f64, f64)> {
        self.plan.growth(&self.size)
    }
}
