//! How a polynomial and its derivatives are evaluated: each product of powers by one multiplication.

use std::collections::BTreeMap;

use super::double_double::Real;
use super::norm::norm;

/// An entry of the gradient: its monomial's coefficient times `power` times a product.
#[derive(Clone, Copy, Debug)]
struct First {
    monomial: usize,
    i: usize,
    power: f64,
    product: usize,
}

/// An entry of the Hessian, for i ≥ j: its monomial's coefficient times `powers` times a product.
#[derive(Clone, Copy, Debug)]
struct Second {
    monomial: usize,
    i: usize,
    j: usize,
    powers: f64,
    product: usize,
}

/// The products that the derivatives of some monomials need.
#[derive(Clone, Debug, Default)]
pub(super) struct Plan {
    dim: usize,
    /// Product k + 1 is an earlier one times a coordinate; product 0 is 1.
    products: Vec<(usize, usize)>,
    first: Vec<First>,
    second: Vec<Second>,
    /// The degree of each monomial.
    degrees: Vec<u32>,
    /// For each monomial, and each direct factor of the group that it has coordinates of: a bound on the gradient in these
    /// where |p| of every factor is one, D_f Π_g max |pᵐ|, the maximum over the unit sphere of the part in factor g being
    /// Π (mᵢ/D_g)^{mᵢ/2} (O. Kellogg, Math. Z. 27 (1928) 55).
    bounds: Vec<Vec<(usize, f64)>>,
    /// The direct factor of each coordinate.
    factors: Vec<usize>,
}

type Factors = Vec<(usize, u32)>;

/// The factors with the power of coordinate i one less.
fn without(factors: &[(usize, u32)], i: usize) -> Factors {
    let lowered = factors.iter().map(|&(j, e)| (j, if i == j { e - 1 } else { e }));
    lowered.filter(|f| f.1 > 0).collect()
}

impl Plan {
    pub(super) fn new(factors: &[usize], monomials: &[Factors]) -> Self {
        let mut plan = Self { dim: factors.len(), factors: factors.to_vec(), ..Self::default() };
        let mut known = BTreeMap::new();
        for (monomial, factors) in monomials.iter().enumerate() {
            for (at, &(i, a)) in factors.iter().enumerate() {
                let lower = without(factors, i);
                let product = plan.product(&mut known, &lower);
                plan.first.push(First { monomial, i, power: f64::from(a), product });
                for &(j, b) in &factors[..=at] {
                    let b = if i == j { a - 1 } else { b };
                    if b > 0 {
                        let product = plan.product(&mut known, &without(&lower, j));
                        let powers = f64::from(a) * f64::from(b);
                        plan.second.push(Second { monomial, i, j, powers, product });
                    }
                }
            }
            let mut degrees: BTreeMap<usize, u32> = BTreeMap::new();
            factors.iter().for_each(|&(i, m)| *degrees.entry(plan.factors[i]).or_insert(0) += m);
            let share = |&(i, m): &(usize, u32)| {
                let degree = f64::from(degrees[&plan.factors[i]]);
                (f64::from(m) / degree).powf(0.5 * f64::from(m))
            };
            let highest: f64 = factors.iter().map(share).product();
            let bounds = degrees.iter().map(|(&own, &degree)| (own, f64::from(degree) * highest));
            plan.bounds.push(bounds.collect());
            plan.degrees.push(factors.iter().map(|f| f.1).sum());
        }
        plan
    }

    fn product(&mut self, known: &mut BTreeMap<Factors, usize>, factors: &Factors) -> usize {
        let Some(&(i, _)) = factors.last() else { return 0 };
        if let Some(&product) = known.get(factors) {
            return product;
        }
        let lower = self.product(known, &without(factors, i));
        self.products.push((lower, i));
        known.insert(factors.clone(), self.products.len());
        self.products.len()
    }

    /// All products at p.
    pub(super) fn products<T: Real>(&self, p: &[T]) -> Vec<T> {
        let mut values = Vec::with_capacity(self.products.len() + 1);
        values.push(T::from(1.0));
        for &(lower, i) in &self.products {
            values.push(values[lower] * p[i]);
        }
        values
    }

    /// The gradient of the polynomial with these coefficients.
    pub(super) fn first<T: Real>(&self, coefficients: &[T], products: &[T]) -> Vec<T> {
        let mut result = vec![T::default(); self.dim];
        for first in &self.first {
            let c = coefficients[first.monomial];
            if c != T::default() {
                result[first.i] += c * T::from(first.power) * products[first.product];
            }
        }
        result
    }

    /// The Hessian of the polynomial with these coefficients, row by row.
    pub(super) fn second(&self, coefficients: &[f64], products: &[f64]) -> Vec<f64> {
        let n = self.dim;
        let mut result = vec![0.0; n * n];
        for second in &self.second {
            let c = coefficients[second.monomial];
            if c != 0.0 {
                let value = c * second.powers * products[second.product];
                result[second.i * n + second.j] += value;
                if second.i != second.j {
                    result[second.j * n + second.i] += value;
                }
            }
        }
        result
    }

    /// See [`Folded::growth`](super::series::Folded::growth).
    pub(super) fn growth(&self, size: &[f64]) -> Vec<(u32, f64, f64)> {
        let n = self.dim;
        let mut by_degree: BTreeMap<u32, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
        for &degree in &self.degrees {
            by_degree.entry(degree).or_insert_with(|| (vec![0.0; n], vec![0.0; n * n]));
        }
        for first in &self.first {
            if let Some((gradient, _)) = by_degree.get_mut(&self.degrees[first.monomial]) {
                gradient[first.i] += size[first.monomial] * first.power;
            }
        }
        for &Second { monomial, i, j, powers, .. } in &self.second {
            if let Some((_, hessian)) = by_degree.get_mut(&self.degrees[monomial]) {
                hessian[i * n + j] += size[monomial] * powers;
                if i != j {
                    hessian[j * n + i] += size[monomial] * powers;
                }
            }
        }
        by_degree.into_iter().map(|(d, (g, h))| (d, norm(&g), norm(&h))).collect()
    }

    /// A bound on the gradient of the polynomial with these coefficients, of which many are zero.
    pub(super) fn part(&self, coefficients: &[f64]) -> Part {
        let entries = self.first.iter().filter(|first| coefficients[first.monomial] != 0.0);
        let entries = entries
            .map(|first| {
                let size = coefficients[first.monomial].abs() * first.power;
                (self.factors[first.i], first.product, size)
            })
            .collect();
        let mut bounds: BTreeMap<(usize, u32), f64> = BTreeMap::new();
        for ((own, &degree), c) in self.bounds.iter().zip(&self.degrees).zip(coefficients) {
            for &(factor, bound) in own.iter().filter(|_| *c != 0.0) {
                *bounds.entry((factor, degree - 1)).or_insert(0.0) += bound * c.abs();
            }
        }
        let factors = self.factors.last().map_or(0, |last| last + 1);
        Part { factors, entries, bounds: bounds.into_iter().collect() }
    }
}

/// The sizes of the terms of a gradient, by the direct factors of the group.
#[derive(Clone, Debug)]
pub(super) struct Part {
    factors: usize,
    /// Factors, products, and what these are multiplied by.
    entries: Vec<(usize, usize, f64)>,
    /// Factors and powers of |p|, and Kellogg's bound for them.
    bounds: Vec<((usize, u32), f64)>,
}

impl Part {
    /// The sum of the absolute values of all terms of each factor, given the products at |p|.
    pub(super) fn at(&self, products: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.factors];
        self.entries.iter().for_each(|&(f, product, c)| sums[f] += c * products[product]);
        sums
    }

    /// A bound on the gradient of each factor in every direction, |p| of all factors being r.
    pub(super) fn anywhere(&self, r: f64) -> Vec<f64> {
        let mut sums = vec![0.0; self.factors];
        self.bounds.iter().for_each(|&((f, power), bound)| sums[f] += bound * r.powi(power as i32));
        sums
    }
}
