//! S_h(p), its gradient and its Hessian, term by term.

use std::collections::BTreeMap;
use std::convert::Infallible;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::DoubleDouble;
use super::geometry::Geometry;
use super::linear::{Real, SPACING, column, derivative, norm, spectral};
use super::wide::Wide;
use crate::poly::{Polynomial, split_at};

/// The powers of coordinates in a monomial.
type Powers = Vec<(usize, u32)>;

/// S = Σ t^k S_k(p), ready for a step size.
#[derive(Clone, Debug)]
pub(super) struct Series {
    terms: Vec<Addend>,
    plan: Arc<Chain>,
    /// The last order, where the series has the one two before it too.
    last: Option<u32>,
}

/// One term of S before a step size, parameters and a scale of the momentum are put in.
#[derive(Clone, Debug)]
struct Addend {
    value: Wide,
    /// k of t^k.
    order: u32,
    /// The symbols' powers.
    symbols: Powers,
    /// Index of its monomial in the momenta.
    monomial: usize,
}

impl Series {
    /// From the polynomials S₁, S₂, … (any orders), whose variables beyond the coordinates are symbols.
    pub(super) fn new<'a>(
        Geometry { factors, units, .. }: &Geometry,
        orders: impl IntoIterator<Item = (u32, &'a Polynomial)>,
    ) -> Self {
        let dim = factors.len();
        let mut known = BTreeMap::new();
        let mut monomials: Vec<Powers> = Vec::new();
        let (mut terms, mut last) = (Vec::new(), None);
        for (order, polynomial) in orders {
            // S is odd in t.
            last = if order >= 3 && order % 2 == 1 { Some(order) } else { last };
            for (powers, value) in polynomial.factors() {
                let (momenta, symbols) = split_at(&powers, dim);
                let momenta: Powers = momenta.iter().map(|&(i, e)| (i as usize, e)).collect();
                let symbols = symbols.iter().map(|&(i, e)| (i as usize - dim, e)).collect();
                let monomial = *known.entry(momenta.clone()).or_insert_with(|| {
                    monomials.push(momenta);
                    monomials.len() - 1
                });
                terms.push(Addend { value: Wide::rational(&value), order, symbols, monomial });
            }
        }
        Self { terms, plan: Arc::new(Chain::new((factors, units), &monomials)), last }
    }

    /// S(σq)/σ with σ = 2^scale, whose gradient in q is ∂S/∂p at p = σq.
    pub(super) fn folded(&self, step: f64, symbols: &[f64], scale: i64) -> Folded {
        let plan = Arc::clone(&self.plan);
        let largest = self.terms.iter().map(|term| term.order).max().unwrap_or(0);
        let powers: Vec<Wide> = (0..=largest).map(|k| Wide::of(step).power(k)).collect();
        let zeros = vec![DoubleDouble::default(); plan.degrees.len()];
        // Terms that cancel (in a spherical body, say) must not leave roundings of a double's size.
        let (mut exact, mut last_two) = (zeros.clone(), [zeros.clone(), zeros]);
        let mut size = vec![0.0; exact.len()];
        for term in &self.terms {
            let mut value = term.value.times(powers[term.order as usize]);
            for &(i, power) in &term.symbols {
                let symbol = symbols.get(i).copied().unwrap_or(f64::NAN);
                value = value.times(Wide::of(symbol).power(power));
            }
            let at = term.monomial;
            let value = value.scaled(scale * i64::from(plan.degrees[at] - 1));
            exact[at] += value;
            size[at] += value.to_f64().abs();
            let before_last = self.last.and_then(|last| last.checked_sub(term.order));
            if let Some(place @ (0 | 2)) = before_last {
                last_two[place as usize / 2][at] += value;
            }
        }
        let rounded = |list: &[DoubleDouble]| list.iter().map(|v| v.to_f64()).collect::<Vec<_>>();
        let last_two = last_two.map(|list| rounded(&list).iter().map(|c| c.abs()).collect());
        let last_two = self.last.map(|_| last_two);
        Folded { plan, exact, size, last_two }
    }
}

/// S of one step size, one set of parameters and one scale of the momentum.
#[derive(Clone, Debug)]
pub(super) struct Folded {
    plan: Arc<Chain>,
    exact: Vec<DoubleDouble>,
    /// Sums of the terms' absolute values.
    size: Vec<f64>,
    /// The absolute values of the coefficients of S_K and S_{K−2}, where there are both.
    last_two: Option<[Vec<f64>; 2]>,
}

impl Folded {
    pub(super) fn is_finite(&self) -> bool {
        self.exact.iter().all(|c| c.is_finite())
    }

    /// ∂S/∂p.
    pub(super) fn gradient<T: Real>(&self, p: &DMatrix<T>) -> DMatrix<T> {
        let coefficients: Vec<T> = self.exact.iter().map(|&c| T::of(c)).collect();
        column(self.plan.gradient(&coefficients, &self.plan.products(p.as_slice())).into_iter())
    }

    /// ‖Hess S‖ at p.
    pub(super) fn hessian(&self, p: &DMatrix<f64>) -> f64 {
        let spacing = SPACING * if norm(p) > 0.0 { norm(p) } else { 1.0 };
        let gradient = |p: &DMatrix<f64>| Ok::<_, Infallible>(self.gradient(p));
        let Ok(hessian) = derivative(p, &self.gradient(p), spacing, gradient);
        spectral(&hessian)
    }

    /// The length of the sums of the absolute values of the terms of ∂S/∂p.
    pub(super) fn terms(&self, p: &DMatrix<f64>) -> f64 {
        norm(&self.plan.gradient(&self.size, &self.plan.products(p.abs().as_slice())))
    }

    /// The sums of the absolute values of all monomials of ∂S_K/∂p and of ∂S_{K−2}/∂p in each direct factor; and bounds
    /// on these in every direction, |p| of all factors being r. `None` where there are no two terms.
    pub(super) fn last_two(&self, p: &DMatrix<f64>, r: f64) -> Option<[[Vec<f64>; 2]; 2]> {
        let plan = &self.plan;
        let products = plan.products(p.abs().as_slice());
        let here = |coefficients: &Vec<f64>| {
            let gradient = plan.gradient(coefficients, &products).into_iter();
            plan.by_factor(plan.factors.iter().copied().zip(gradient))
        };
        let anywhere = |coefficients: &Vec<f64>| {
            let monomials = plan.bounds.iter().zip(&plan.degrees).zip(coefficients);
            plan.by_factor(monomials.filter(|(_, c)| **c != 0.0).flat_map(|((own, degree), c)| {
                own.iter().map(move |&(factor, bound)| (factor, bound * c * r.powi(degree - 1)))
            }))
        };
        let [last, before] = self.last_two.as_ref()?;
        Some([[here(last), here(before)], [anywhere(last), anywhere(before)]])
    }
}

/// A plan that evaluates the derivatives of some monomials, with one multiplication for each product of powers.
#[derive(Clone, Debug, Default)]
struct Chain {
    /// The direct factor of each coordinate.
    factors: Vec<usize>,
    /// The degree of each monomial.
    degrees: Vec<i32>,
    /// For each monomial, and each direct factor of the group that it has coordinates of: a bound on the gradient in these
    /// where |p| of every factor is one in comparable units, D_f Π_g max |pᵐ|, the maximum over the unit sphere of the part
    /// in factor g being Π (mᵢ/D_g)^{mᵢ/2} (O. Kellogg, Math. Z. 27 (1928) 55).
    bounds: Vec<Vec<(usize, f64)>>,
    /// Product k + 1 is an earlier one times a coordinate; product 0 is 1.
    products: Vec<(usize, usize)>,
    first: Vec<Derivative>,
}

/// The term of a monomial at one place of a derivative: its coefficient times `factor` times a product.
#[derive(Clone, Copy, Debug)]
struct Derivative {
    monomial: usize,
    place: usize,
    factor: f64,
    product: usize,
}

/// The powers with that of coordinate i one less.
fn without(powers: &[(usize, u32)], i: usize) -> Powers {
    let lowered = powers.iter().map(|&(j, e)| (j, if i == j { e - 1 } else { e }));
    lowered.filter(|power| power.1 > 0).collect()
}

impl Chain {
    fn new((factors, units): (&[usize], &[f64]), monomials: &[Powers]) -> Self {
        let mut plan = Self { factors: factors.to_vec(), ..Self::default() };
        let mut known = BTreeMap::new();
        for (monomial, powers) in monomials.iter().enumerate() {
            for &(i, a) in powers {
                let (factor, product) =
                    (f64::from(a), plan.product(&mut known, &without(powers, i)));
                plan.first.push(Derivative { monomial, place: i, factor, product });
            }
            let mut degrees: BTreeMap<usize, u32> = BTreeMap::new();
            powers.iter().for_each(|&(i, m)| *degrees.entry(factors[i]).or_insert(0) += m);
            let share = |&(i, m): &(usize, u32)| {
                let degree = f64::from(degrees[&factors[i]]);
                (f64::from(m) / degree).powf(0.5 * f64::from(m)) / units[i].powi(m as i32)
            };
            let highest: f64 = powers.iter().map(share).product();
            let bounds = degrees.iter().map(|(&own, &degree)| (own, f64::from(degree) * highest));
            plan.bounds.push(bounds.collect());
            plan.degrees.push(powers.iter().map(|power| power.1 as i32).sum());
        }
        plan
    }

    /// The number of a product, which is added where it is new.
    fn product(&mut self, known: &mut BTreeMap<Powers, usize>, powers: &Powers) -> usize {
        let Some(&(i, _)) = powers.last() else { return 0 };
        if let Some(&product) = known.get(powers) {
            return product;
        }
        let lower = self.product(known, &without(powers, i));
        self.products.push((lower, i));
        known.insert(powers.clone(), self.products.len());
        self.products.len()
    }

    /// All products at p.
    fn products<T: Real>(&self, p: &[T]) -> Vec<T> {
        let mut values = vec![T::one()];
        for &(lower, i) in &self.products {
            values.push(values[lower] * p[i]);
        }
        values
    }

    fn gradient<T: Real>(&self, coefficients: &[T], products: &[T]) -> Vec<T> {
        let mut result = vec![T::zero(); self.factors.len()];
        for &Derivative { monomial, place, factor, product } in &self.first {
            if !coefficients[monomial].is_zero() {
                result[place] += coefficients[monomial] * T::from(factor) * products[product];
            }
        }
        result
    }

    /// The sums over each direct factor.
    fn by_factor(&self, values: impl Iterator<Item = (usize, f64)>) -> Vec<f64> {
        let mut sums = vec![0.0; self.factors.last().map_or(0, |last| last + 1)];
        values.for_each(|(factor, value)| sums[factor] += value);
        sums
    }
}
