//! The initial momenta of the ensemble, the same in every language.

use crate::arithmetic::{Vector, dot};

/// Steele, Lea and Flood's SplitMix64 (OOPSLA 2014): a few lines in any language.
struct SplitMix(u64);

impl SplitMix {
    /// A number in [0, 1) of 53 bits.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Momenta of norm 1.5 to 3 in directions drawn from the cube, from seed 1.
#[must_use]
pub fn bodies(count: usize) -> Vec<Vector> {
    let mut random = SplitMix(1);
    let mut momenta = Vec::with_capacity(count);
    while momenta.len() < count {
        let direction: Vector = std::array::from_fn(|_| 2.0 * random.uniform() - 1.0);
        let norm = dot(&direction, &direction).sqrt();
        let size = 1.5 + 1.5 * random.uniform();
        if norm > 0.1 {
            momenta.push(direction.map(|v| v * size / norm));
        }
    }
    momenta
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_the_published_one() {
        // First outputs of SplitMix64 from seed 1234567, as in the reference implementation's test (Vigna).
        let mut random = SplitMix(1_234_567);
        let expected = [6_457_827_717_110_365_317u64, 3_203_168_211_198_807_973];
        for value in expected {
            assert_eq!(random.uniform(), (value >> 11) as f64 / (1u64 << 53) as f64);
        }
    }

    #[test]
    fn a_longer_list_begins_with_the_shorter() {
        assert_eq!(bodies(10), bodies(20)[..10]);
        assert!(bodies(100).iter().all(|m| (1.5 - 1e-12..3.0 + 1e-12).contains(&dot(m, m).sqrt())));
    }
}
