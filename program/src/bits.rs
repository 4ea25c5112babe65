//! Powers of two and exponents by the bits of numbers: exact, and the same on every target.

/// 2ᵏ for whole k from −1022 to 1023; for other k the number whose exponent field are the last bits of k + 1023.
#[inline(always)]
pub fn power_of_two(k: f64) -> f64 {
    // In the last bits of such a sum is k + 1023, the exponent field of 2ᵏ.
    let sum = k + (1.5 * (1_u64 << 52) as f64 + 1023.0);
    f64::from_bits(sum.to_bits() << 52)
}

/// ⌊log₂ |a|⌋ for normal numbers, −1023 for smaller ones, 1024 for infinities and what is no number.
#[inline(always)]
pub fn exponent(a: f64) -> f64 {
    ((a.to_bits() >> 52) & 0x7ff) as f64 - 1023.0
}
