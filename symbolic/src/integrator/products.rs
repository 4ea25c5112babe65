//! The products of symbols in the coefficients, each made of an earlier one by one multiplication.

use std::collections::HashMap;

use super::coefficients::Coefficients;

/// Products Π symbolᵢ^powerᵢ in an order in which they can be made.
#[derive(Clone, Debug, Default)]
pub struct Products {
    steps: Vec<(usize, usize)>,
    numbers: HashMap<Vec<u32>, usize>,
}

impl Products {
    /// Those that `coefficients` need.
    #[must_use]
    pub fn of(coefficients: &Coefficients) -> Self {
        let mut products = Self::default();
        for term in coefficients.bases().iter().flatten() {
            products.add(&term.symbol_powers);
        }
        products
    }

    /// How product n + 1 is made: of which one, product 0 being 1, and by which symbol.
    #[must_use]
    pub fn steps(&self) -> &[(usize, usize)] {
        &self.steps
    }

    /// The number of the product with these powers; zero where it is 1, or not among them.
    #[must_use]
    pub fn number(&self, powers: &[u32]) -> usize {
        self.numbers.get(powers).copied().unwrap_or(0)
    }

    /// Adds the product and those it is made of, and returns its number.
    fn add(&mut self, powers: &[u32]) -> usize {
        let Some(last) = powers.iter().rposition(|&power| power > 0) else { return 0 };
        if let Some(&number) = self.numbers.get(powers) {
            return number;
        }
        let mut shorter = powers.to_vec();
        shorter[last] -= 1;
        let of = self.add(&shorter);
        self.steps.push((of, last));
        self.numbers.insert(powers.to_vec(), self.steps.len());
        self.steps.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::Contribution;
    use crate::number::ratio;

    #[test]
    fn every_product_is_an_earlier_one_times_a_symbol() {
        let mut coefficients = Coefficients::default();
        let wanted = [vec![2, 0, 1], vec![0, 0, 0], vec![0, 3, 1], vec![2, 0, 1]];
        for symbol_powers in wanted.clone() {
            let term = Contribution { factor: ratio(1, 2), step_power: 1, symbol_powers };
            coefficients.add_base(vec![term]);
        }
        let products = Products::of(&coefficients);
        let mut powers = vec![vec![0; 3]];
        for &(of, symbol) in products.steps() {
            let mut next: Vec<u32> = powers[of].clone();
            next[symbol] += 1;
            assert!(!powers.contains(&next), "{next:?} is made twice");
            powers.push(next);
        }
        for wanted in &wanted {
            assert_eq!(&powers[products.number(wanted)], wanted);
        }
        // x, x², x²z, y, y², y³, y³z, and no more.
        assert_eq!(products.steps().len(), 7);
    }
}
