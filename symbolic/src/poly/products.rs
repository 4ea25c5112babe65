//! Products of variables, each made of an earlier one.

use std::collections::HashMap;

/// Products Π xᵢ^powerᵢ in an order in which they can be made, each of an earlier one by one multiplication.
#[derive(Clone, Debug, Default)]
pub(crate) struct Products {
    made: Vec<(u32, u32)>,
    numbers: HashMap<Vec<u32>, u32>,
}

impl Products {
    /// Adds the product and those it is made of, and returns its number; that of 1 is zero.
    pub(crate) fn add(&mut self, powers: &[u32]) -> u32 {
        let Some(last) = powers.iter().rposition(|&power| power > 0) else { return 0 };
        if let Some(&number) = self.numbers.get(powers) {
            return number;
        }
        let mut shorter = powers.to_vec();
        shorter[last] -= 1;
        let of = self.add(&shorter);
        self.made.push((of, last as u32));
        let number = self.made.len() as u32;
        self.numbers.insert(powers.to_vec(), number);
        number
    }

    /// (earlier product, variable) of each product but that of 1, by its number.
    pub(crate) fn into_made(self) -> Vec<(u32, u32)> {
        self.made
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_product_is_an_earlier_one_times_a_variable() {
        let mut products = Products::default();
        let wanted = [vec![2, 0, 1], vec![0, 0, 0], vec![0, 3, 1], vec![2, 0, 1]];
        let numbers = wanted.clone().map(|powers| products.add(&powers));
        let mut powers = vec![vec![0; 3]];
        for &(of, variable) in &products.made {
            let mut next: Vec<u32> = powers[of as usize].clone();
            next[variable as usize] += 1;
            assert!(!powers.contains(&next), "{next:?} is made twice");
            powers.push(next);
        }
        for (number, wanted) in numbers.into_iter().zip(&wanted) {
            assert_eq!(&powers[number as usize], wanted);
        }
        // x, x², x²z, y, y², y³, y³z, and no more.
        assert_eq!(products.made.len(), 7);
    }
}
