//! Greatest common divisors of machine integers.

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
