//! Integers of a fixed number of words, for coefficients just beyond machine integers.
//!
//! A sum of products in heap-allocated integers allocates for every product; coefficients of
//! high orders have a few hundred bits and are summed here without.

use num_bigint::{BigInt, Sign};

/// An integer as sign and magnitude, least significant word first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words<const N: usize> {
    negative: bool,
    length: usize,
    magnitude: [u64; N],
}

impl<const N: usize> Words<N> {
    /// The words of an integer, which must fit.
    pub(crate) fn new(value: &BigInt) -> Self {
        let mut magnitude = [0; N];
        let mut length = 0;
        for (word, digit) in magnitude.iter_mut().zip(value.iter_u64_digits()) {
            *word = digit;
            length += 1;
        }
        Self { negative: value.sign() == Sign::Minus, length, magnitude }
    }

    /// The words of a machine integer; N must be at least two.
    pub(crate) fn from_small(value: i128) -> Self {
        let mut magnitude = [0; N];
        let absolute = value.unsigned_abs();
        magnitude[0] = absolute as u64;
        magnitude[1] = (absolute >> 64) as u64;
        Self { negative: value < 0, length: 2, magnitude }
    }

    /// The product, which must fit.
    pub(crate) fn times(&self, other: &Self) -> Self {
        let magnitude = self.multiplied(other);
        let length = N - magnitude.iter().rev().take_while(|&&word| word == 0).count();
        Self { negative: self.negative != other.negative, length, magnitude }
    }

    #[inline(always)]
    fn multiplied(&self, other: &Self) -> [u64; N] {
        let mut result = [0_u64; N];
        let mut i = 0;
        while i < self.length {
            let word = u128::from(self.magnitude[i]);
            let mut carry = 0_u128;
            let mut j = 0;
            while j < other.length && i + j < N {
                // At most (2^64 − 1)² + 2 (2^64 − 1) = 2^128 − 1.
                let sum = word * u128::from(other.magnitude[j]) + u128::from(result[i + j]) + carry;
                result[i + j] = sum as u64;
                carry = sum >> 64;
                j += 1;
            }
            if i + j < N {
                result[i + j] = carry as u64;
            }
            i += 1;
        }
        result
    }
}

/// A sum of products in two's complement.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sum<const N: usize>([u64; N]);

impl<const N: usize> Sum<N> {
    pub(crate) fn nothing() -> Self {
        Self([0; N])
    }

    pub(crate) fn vanishes(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }

    /// Adds left · right; the caller knows that neither product nor sum overflows.
    #[inline(always)]
    pub(crate) fn add_product(&mut self, left: &Words<N>, right: &Words<N>) {
        let product = left.multiplied(right);
        let mut i = 0;
        if left.negative == right.negative {
            let mut carry = false;
            while i < N {
                let (sum, first) = self.0[i].overflowing_add(product[i]);
                let (sum, second) = sum.overflowing_add(u64::from(carry));
                self.0[i] = sum;
                carry = first | second;
                i += 1;
            }
        } else {
            let mut borrow = false;
            while i < N {
                let (difference, first) = self.0[i].overflowing_sub(product[i]);
                let (difference, second) = difference.overflowing_sub(u64::from(borrow));
                self.0[i] = difference;
                borrow = first | second;
                i += 1;
            }
        }
    }

    pub(crate) fn to_integer(self) -> BigInt {
        let mut bytes = Vec::with_capacity(8 * N);
        for word in self.0 {
            bytes.extend_from_slice(&word.to_le_bytes());
        }
        BigInt::from_signed_bytes_le(&bytes)
    }
}

/// The greatest common divisor; zero only if both are zero.
pub(crate) fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        // Division of 128-bit integers is slow, so the loop moves to 64 bits once both fit.
        if a <= u64::MAX as u128 && b <= u64::MAX as u128 {
            return gcd_word(a as u64, b as u64) as u128;
        }
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

fn gcd_word(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        let rest = a % b;
        a = b;
        b = rest;
    }
    a
}

/// The least common multiple of two positive integers, if it is below 2^127.
pub(crate) fn lcm(a: i128, b: i128) -> Option<i128> {
    if a % b == 0 {
        return Some(a);
    }
    if b % a == 0 {
        return Some(b);
    }
    let divisor = gcd(a.unsigned_abs(), b.unsigned_abs());
    a.checked_mul(b / i128::try_from(divisor).ok()?)
}

/// The number of bits of the absolute value.
#[inline(always)]
pub(crate) fn bits(value: i128) -> u32 {
    128 - value.unsigned_abs().leading_zeros()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn integer() -> impl Strategy<Value = BigInt> {
        (any::<i128>(), 0_u32..20).prop_map(|(value, shift)| BigInt::from(value) >> (6 * shift))
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        /// Three factors of 128 bits and eight of their products stay within 6 words.
        #[test]
        fn agrees_with_big_integers(
            list in proptest::collection::vec((integer(), integer(), integer()), 0..8)
        ) {
            let mut sum = Sum::<7>::nothing();
            let mut expected = BigInt::from(0);
            for (a, b, c) in &list {
                let scaled = Words::<7>::new(a).times(&Words::new(b));
                sum.add_product(&scaled, &Words::new(c));
                expected += a * b * c;
            }
            prop_assert_eq!(sum.vanishes(), expected == BigInt::from(0));
            prop_assert_eq!(sum.to_integer(), expected);
        }

        #[test]
        fn machine_integers(a in any::<i128>(), b in any::<i128>()) {
            let mut sum = Sum::<4>::nothing();
            sum.add_product(&Words::from_small(a), &Words::from_small(b));
            // |a·b| ≤ 2^254 fits in 255 bits and a sign.
            prop_assert_eq!(sum.to_integer(), BigInt::from(a) * b);
        }
    }

    #[test]
    fn small_and_large() {
        assert_eq!(gcd(12, 18), 6);
        assert_eq!(gcd(0, 5), 5);
        assert_eq!(gcd(3 << 100, 5 << 90), 1 << 90);
        assert_eq!(lcm(4, 6), Some(12));
        assert_eq!(lcm((1 << 126) - 1, 1 << 126), None);
        assert_eq!(bits(-8), 4);
        assert_eq!(bits(0), 0);
        assert_eq!(bits(i128::MIN), 128);
    }
}
