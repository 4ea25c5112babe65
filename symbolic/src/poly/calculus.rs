//! Sums, products, powers and derivatives.

use crate::number::{Fractions, Rational, integer};
use crate::poly::polynomial::{Factors, Keys, Packing, Polynomial};
use crate::poly::product::{Arithmetic, Multiplication, sum_of_products};
use num_traits::{One, Zero};
use std::ops::{Add, Mul, Neg, Sub};

impl Polynomial {
    /// The partial derivative by the variable of this index; zero if there is no such variable.
    pub fn derivative(&self, index: usize) -> Self {
        let mut exponents = Vec::new();
        let mut places = Vec::new();
        // Lowering one exponent by one in all terms that have it keeps their order.
        let keys = match (&self.keys, Packing::new(self.variables())) {
            (Keys::Packed(keys), Some(packing)) if index < self.variables() => {
                let (shift, mask) = (packing.shift(index), packing.mask());
                let mut lowered = Vec::new();
                for (place, &key) in keys.iter().enumerate() {
                    let exponent = ((key >> shift) & mask) as u32;
                    if exponent > 0 {
                        exponents.push(exponent);
                        places.push(place);
                        lowered.push(key - (1 << shift));
                    }
                }
                Keys::Packed(lowered)
            }
            (Keys::Sparse(keys), _) => {
                let mut lowered = Vec::new();
                for (place, key) in keys.iter().enumerate() {
                    if let Some(exponent) = key.0.iter().find(|f| f.0 as usize == index) {
                        exponents.push(exponent.1);
                        places.push(place);
                        lowered.push(lower(key, index as u32));
                    }
                }
                Keys::Sparse(lowered)
            }
            _ => return Self::zero(self.variables()),
        };
        self.differentiated(keys, &places, &exponents)
    }

    /// The partial derivatives by the first `count` variables, in one pass over the terms if most
    /// variables are absent from most terms.
    pub fn gradient(&self, count: usize) -> Vec<Self> {
        let Keys::Sparse(keys) = &self.keys else {
            return (0..count).map(|i| self.derivative(i)).collect();
        };
        let mut parts = vec![(Vec::new(), Vec::new(), Vec::new()); count];
        for (place, key) in keys.iter().enumerate() {
            for &(variable, exponent) in &key.0 {
                if let Some((lowered, places, exponents)) = parts.get_mut(variable as usize) {
                    lowered.push(lower(key, variable));
                    places.push(place);
                    exponents.push(exponent);
                }
            }
        }
        parts
            .into_iter()
            .map(|(lowered, places, exponents)| {
                self.differentiated(Keys::Sparse(lowered), &places, &exponents)
            })
            .collect()
    }

    fn differentiated(&self, keys: Keys, places: &[usize], exponents: &[u32]) -> Self {
        let chosen = match &self.values {
            Fractions::Small { numerators, denominator, bits } => Fractions::Small {
                numerators: places.iter().map(|&place| numerators[place]).collect(),
                denominator: *denominator,
                bits: *bits,
            },
            Fractions::Big { numerators, denominator } => Fractions::Big {
                numerators: places.iter().map(|&place| numerators[place].clone()).collect(),
                denominator: denominator.clone(),
            },
        };
        let values = chosen.scale(&Rational::one(), Some(exponents));
        Self::assemble(self.variables(), self.bound, keys, values)
    }

    /// The polynomial times a number.
    pub fn scale(&self, factor: &Rational) -> Self {
        if factor.is_zero() {
            return Self::zero(self.variables());
        }
        let values = self.values.scale(factor, None);
        Self::assemble(self.variables(), self.bound, self.keys.clone(), values)
    }

    /// The rational multiple whose coefficients are integers without a common divisor, the leading one positive.
    pub(crate) fn primitive(&self) -> Self {
        self.scale(&self.values.content().recip())
    }

    /// The polynomial raised to a power.
    pub fn pow(&self, exponent: u32) -> Self {
        let mut result = Self::constant(self.variables(), Rational::one());
        for bit in (0..32 - exponent.leading_zeros()).rev() {
            result = &result * &result;
            if exponent >> bit & 1 == 1 {
                result = &result * self;
            }
        }
        result
    }

    /// Σ factor · left · right in the larger number of variables.
    fn combine(terms: [(i64, &Self, &Self); 2]) -> Self {
        let variables =
            terms.iter().flat_map(|(_, a, b)| [a.variables(), b.variables()]).max().unwrap_or(0);
        let wide = terms.map(|(f, a, b)| (f, a.widened(variables), b.widened(variables)));
        let products: Vec<Multiplication<'_>> = wide
            .iter()
            .map(|(factor, left, right)| Multiplication { factor: integer(*factor), left, right })
            .collect();
        match sum_of_products(variables, &products, usize::MAX, Arithmetic::Exact) {
            Ok(sum) => sum,
            // Without a limit none is exceeded.
            Err(_) => Self::zero(variables),
        }
    }
}

fn lower(key: &Factors, variable: u32) -> Factors {
    let lowered = key.0.iter().filter_map(|&(v, e)| match (v == variable, e) {
        (true, 1) => None,
        (true, _) => Some((v, e - 1)),
        (false, _) => Some((v, e)),
    });
    Factors(lowered.collect())
}

impl Add for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        let one = Polynomial::constant(self.variables(), Rational::one());
        Polynomial::combine([(1, self, &one), (1, other, &one)])
    }
}

impl Sub for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        let one = Polynomial::constant(self.variables(), Rational::one());
        Polynomial::combine([(1, self, &one), (-1, other, &one)])
    }
}

impl Mul for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        let zero = Polynomial::zero(self.variables());
        Polynomial::combine([(1, self, other), (0, &zero, &zero)])
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        self.scale(&integer(-1))
    }
}
