//! S_h(p), its gradient and its Hessian, term by term.

use std::collections::BTreeMap;

use super::double_double::Real;
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
    pub(super) dim: usize,
    pub(super) monomials: Vec<Vec<(usize, u32)>>,
    pub(super) terms: Vec<Term>,
    /// The last order and the one two before it, where the series has them.
    pub(super) last: Option<(u32, u32)>,
    /// Whether the coefficients hold the step size.
    counted: bool,
}

impl Series {
    /// From the polynomials S₁, S₂, … (any orders), whose variables from `dim` on are symbols.
    pub(super) fn new<'a>(
        dim: usize,
        orders: impl IntoIterator<Item = (u32, &'a Polynomial)>,
    ) -> Self {
        let mut index = BTreeMap::new();
        let mut result =
            Self { dim, monomials: Vec::new(), terms: Vec::new(), last: None, counted: false };
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
        result.note_orders(known);
        result
    }

    /// From terms (order, c, [(coordinate, power), …]) whose coefficients count the step size already.
    pub(super) fn from_terms(
        dim: usize,
        terms: impl IntoIterator<Item = (u32, f64, Vec<(usize, u32)>)>,
    ) -> Result<Self, JudgeError> {
        let mut index = BTreeMap::new();
        let mut result =
            Self { dim, monomials: Vec::new(), terms: Vec::new(), last: None, counted: false };
        let mut known = Vec::new();
        for (order, value, factors) in terms {
            let mut merged: BTreeMap<usize, u32> = BTreeMap::new();
            for (i, power) in factors {
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
        result.note_orders(known);
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

    fn note_orders(&mut self, mut known: Vec<u32>) {
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
        let zero = DoubleDouble::default();
        let count = self.monomials.len();
        let mut folded = Folded {
            dim: self.dim,
            monomials: self.monomials.clone(),
            exact: vec![zero; count],
            double: vec![0.0; count],
            size: vec![0.0; count],
            last: vec![0.0; count],
            before: vec![0.0; count],
            has_two: self.last.is_some(),
            highest: self.monomials.iter().flatten().map(|f| f.1).max().unwrap_or(0) as usize,
        };
        for term in &self.terms {
            let mut value = term.value.times(powers[term.order as usize]);
            for &(i, power) in &term.symbols {
                let symbol = symbols.get(i).copied().unwrap_or(f64::NAN);
                value = value.times(Wide::of(symbol).power(power));
            }
            let degree: i64 = self.monomials[term.monomial].iter().map(|f| i64::from(f.1)).sum();
            let value = value.scaled(scale.saturating_mul(degree - 1));
            let at = term.monomial;
            folded.exact[at] += value;
            folded.size[at] += value.to_f64().abs();
            if let Some((last, before)) = self.last {
                if term.order == last {
                    folded.last[at] += value.to_f64();
                } else if term.order == before {
                    folded.before[at] += value.to_f64();
                }
            }
        }
        for (double, exact) in folded.double.iter_mut().zip(&folded.exact) {
            *double = exact.to_f64();
        }
        folded
    }
}

/// S of one step size, one set of parameters and one scale of the momentum.
#[derive(Clone, Debug)]
pub(super) struct Folded {
    dim: usize,
    monomials: Vec<Vec<(usize, u32)>>,
    exact: Vec<DoubleDouble>,
    double: Vec<f64>,
    /// Sums of the terms' absolute values.
    size: Vec<f64>,
    /// The coefficients of S_K, and of S_{K−2}.
    last: Vec<f64>,
    before: Vec<f64>,
    has_two: bool,
    highest: usize,
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
        self.first(&self.exact, p)
    }

    /// ∂S/∂p and its derivative in double precision.
    pub(super) fn derivatives(&self, p: &[f64]) -> Derivatives<f64> {
        (self.first(&self.double, p), self.second(&self.double, p))
    }

    /// The sums of the absolute values of the terms of ∂S/∂p at |p|.
    pub(super) fn absolute_gradient(&self, p: &[f64]) -> Vec<f64> {
        let p: Vec<f64> = p.iter().map(|p| p.abs()).collect();
        self.first(&self.size, &p)
    }

    /// The sums of the absolute values of all monomials of ∂S_K/∂p and of ∂S_{K−2}/∂p.
    pub(super) fn last_two(&self, p: &[f64]) -> (f64, f64) {
        let p: Vec<f64> = p.iter().map(|p| p.abs()).collect();
        let sum = |coefficients: &[f64]| {
            let sizes: Vec<f64> = coefficients.iter().map(|c| c.abs()).collect();
            self.first(&sizes, &p).iter().sum::<f64>()
        };
        (sum(&self.last), sum(&self.before))
    }

    /// Bounds on |∂S_K/∂p| and |∂S_{K−2}/∂p| in every direction at |p| = r: each monomial c pᵐ of degree D counts with
    /// D |c| Π (mᵢ/D)^{mᵢ/2} r^{D−1} (O. Kellogg, Math. Z. 27 (1928) 55).
    pub(super) fn last_two_anywhere(&self, r: f64) -> (f64, f64) {
        let sum = |coefficients: &[f64]| {
            let terms = self.monomials.iter().zip(coefficients).filter(|(m, _)| !m.is_empty());
            terms.fold(0.0, |sum, (factors, c)| {
                let degree = f64::from(factors.iter().map(|f| f.1).sum::<u32>());
                let share =
                    |&(_, m): &(usize, u32)| (f64::from(m) / degree).powf(0.5 * f64::from(m));
                let highest: f64 = factors.iter().map(share).product();
                sum + degree * c.abs() * highest * r.powf(degree - 1.0)
            })
        };
        (sum(&self.last), sum(&self.before))
    }

    /// For each degree d: a bound G on |∂S_d/∂p| / |p|^(d−1) and one on ‖Hess S_d‖ / |p|^(d−2), |.| being
    /// Euclidean: every factor is at most |p|.
    pub(super) fn growth(&self) -> Vec<(u32, f64, f64)> {
        let n = self.dim;
        let mut by_degree: BTreeMap<u32, (Vec<f64>, Vec<f64>)> = BTreeMap::new();
        for (factors, &size) in self.monomials.iter().zip(&self.size) {
            let degree = factors.iter().map(|f| f.1).sum();
            let (first, second) =
                by_degree.entry(degree).or_insert_with(|| (vec![0.0; n], vec![0.0; n * n]));
            for &(i, a) in factors {
                first[i] += size * f64::from(a);
                for &(j, b) in factors {
                    let b = if i == j { a - 1 } else { b };
                    second[i * n + j] += size * f64::from(a) * f64::from(b);
                }
            }
        }
        by_degree.into_iter().map(|(d, (g, h))| (d, norm(&g), norm(&h))).collect()
    }

    fn powers<T: Real>(&self, p: &[T]) -> Vec<T> {
        let stride = self.highest + 1;
        let mut powers = vec![T::from(1.0); self.dim * stride];
        for i in 0..self.dim {
            for e in 1..stride {
                powers[i * stride + e] = powers[i * stride + e - 1] * p[i];
            }
        }
        powers
    }

    fn first<T: Real>(&self, coefficients: &[T], p: &[T]) -> Vec<T> {
        let (stride, powers) = (self.highest + 1, self.powers(p));
        let power = |i: usize, e: u32| powers[i * stride + e as usize];
        let mut result = vec![T::default(); self.dim];
        for (factors, &c) in self.monomials.iter().zip(coefficients) {
            if c == T::default() {
                continue;
            }
            for (at, &(i, e)) in factors.iter().enumerate() {
                let mut product = c * power(i, e - 1) * T::from(f64::from(e));
                for (other, &(j, f)) in factors.iter().enumerate() {
                    if other != at {
                        product = product * power(j, f);
                    }
                }
                result[i] += product;
            }
        }
        result
    }

    fn second<T: Real>(&self, coefficients: &[T], p: &[T]) -> Vec<T> {
        let (n, stride, powers) = (self.dim, self.highest + 1, self.powers(p));
        let power = |i: usize, e: u32| powers[i * stride + e as usize];
        let mut result = vec![T::default(); n * n];
        for (factors, &c) in self.monomials.iter().zip(coefficients) {
            if c == T::default() {
                continue;
            }
            for (first, &(i, a)) in factors.iter().enumerate() {
                for (second, &(j, b)) in factors.iter().enumerate().take(first + 1) {
                    let mut product = if first == second {
                        if a < 2 {
                            continue;
                        }
                        c * power(i, a - 2) * T::from(f64::from(a * (a - 1)))
                    } else {
                        c * power(i, a - 1) * power(j, b - 1) * T::from(f64::from(a * b))
                    };
                    for (other, &(k, e)) in factors.iter().enumerate() {
                        if other != first && other != second {
                            product = product * power(k, e);
                        }
                    }
                    result[i * n + j] += product;
                    if i != j {
                        result[j * n + i] += product;
                    }
                }
            }
        }
        result
    }
}

/// The Euclidean norm, without overflow; NaN where an entry is.
pub(super) fn norm(v: &[f64]) -> f64 {
    let largest =
        v.iter().fold(0.0_f64, |a, b| if b.is_nan() { f64::NAN } else { maximum(a, b.abs()) });
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * v.iter().map(|x| (x / largest) * (x / largest)).sum::<f64>().sqrt()
}

/// The larger of two numbers; NaN where one is, unlike `f64::max`.
fn maximum(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
