//! Polynomials as numbers.

use num_traits::ToPrimitive;

use super::Polynomial;

/// Σ c · Π x_i^power over (c, [(i, power)]).
#[derive(Clone, Debug, Default)]
pub struct Numeric(Vec<(f64, Vec<(usize, i32)>)>);

impl Numeric {
    /// `polynomial` in its first `variables` variables, with these values of the symbols after them.
    #[must_use]
    pub fn new(polynomial: &Polynomial, variables: usize, symbols: &[f64]) -> Self {
        let mut terms: Vec<(f64, Vec<(usize, i32)>)> = Vec::new();
        for (factors, value) in polynomial.factors() {
            let mut coefficient = value.to_f64().unwrap_or(f64::NAN);
            let mut own = Vec::new();
            for (i, power) in factors {
                let (i, power) = (i as usize, power as i32);
                match i.checked_sub(variables) {
                    Some(symbol) => {
                        coefficient *= symbols.get(symbol).map_or(f64::NAN, |x| x.powi(power));
                    }
                    None => own.push((i, power)),
                }
            }
            // Terms that differ in their symbols alone follow each other.
            match terms.last_mut() {
                Some((sum, factors)) if *factors == own => *sum += coefficient,
                _ => terms.push((coefficient, own)),
            }
        }
        Self(terms)
    }

    /// The value at x.
    #[must_use]
    pub fn value(&self, x: &[f64]) -> f64 {
        self.each(x).sum()
    }

    /// The sum of the absolute values of the terms, against which rounding and drift of the value are measured.
    #[must_use]
    pub fn magnitude(&self, x: &[f64]) -> f64 {
        self.each(x).map(f64::abs).sum()
    }

    /// The derivatives by the first `dim` variables.
    #[must_use]
    pub fn gradient(&self, dim: usize) -> Vec<Self> {
        let derivative = |i: usize| {
            let terms = self.0.iter().filter_map(|(value, factors)| {
                let at = factors.iter().position(|factor| factor.0 == i)?;
                let mut factors = factors.clone();
                let power = factors[at].1;
                factors[at].1 -= 1;
                factors.retain(|factor| factor.1 > 0);
                Some((value * f64::from(power), factors))
            });
            Self(terms.collect())
        };
        (0..dim).map(derivative).collect()
    }

    /// The terms.
    pub fn terms(&self) -> impl Iterator<Item = (f64, &[(usize, i32)])> {
        self.0.iter().map(|(value, factors)| (*value, factors.as_slice()))
    }

    fn each<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.0.iter().map(|(value, factors)| {
            value * factors.iter().map(|&(i, power)| x[i].powi(power)).product::<f64>()
        })
    }
}
