//! Monomials as keys: packed into one machine integer, or as a list of factors.

use std::cmp::Ordering;

/// A monomial as a key of tables and sorted lists. A greater key has the lexicographically greater
/// exponents.
pub(crate) trait Key: Clone + Ord {
    /// The product of two monomials.
    fn product(&self, other: &Self) -> Self;
    /// A well mixed hash; tables use its upper bits.
    fn hash(&self) -> u64;
}

/// How exponents of a given number of variables are packed into 128 bits, the first variable in
/// the highest bits, so that integer order is lexicographic order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Packing {
    variables: usize,
    width: u32,
}

impl Packing {
    /// `None` for more variables than leave four bits for each.
    pub(crate) fn new(variables: usize) -> Option<Self> {
        let width = match variables {
            0 => 32,
            1..=32 => (128 / variables as u32).min(32),
            _ => return None,
        };
        Some(Self { variables, width })
    }

    /// Whether every monomial of this total degree fits, so that sums of keys cannot carry.
    pub(crate) fn holds(self, degree: u32) -> bool {
        u64::from(degree) < 1_u64 << self.width
    }

    #[inline(always)]
    pub(crate) fn shift(self, variable: usize) -> u32 {
        (self.variables - 1 - variable) as u32 * self.width
    }

    pub(crate) fn mask(self) -> u128 {
        (1_u128 << self.width) - 1
    }

    pub(crate) fn pack(self, factors: &[(u32, u32)]) -> u128 {
        let mut key = 0;
        for &(variable, exponent) in factors {
            key += u128::from(exponent) << self.shift(variable as usize);
        }
        key
    }

    pub(crate) fn unpack(self, key: u128) -> Vec<(u32, u32)> {
        let mut factors = Vec::new();
        for variable in 0..self.variables {
            let exponent = (key >> self.shift(variable)) & self.mask();
            if exponent > 0 {
                factors.push((variable as u32, exponent as u32));
            }
        }
        factors
    }
}

impl Key for u128 {
    #[inline(always)]
    fn product(&self, other: &Self) -> Self {
        self.wrapping_add(*other)
    }

    #[inline(always)]
    fn hash(&self) -> u64 {
        let low = (*self as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let high = ((*self >> 64) as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
        let mixed = low ^ high.rotate_left(32);
        mixed.wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }
}

/// The factors (variable, exponent) of a monomial, ascending by variable, exponents positive.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Factors(pub(crate) Box<[(u32, u32)]>);

impl Ord for Factors {
    fn cmp(&self, other: &Self) -> Ordering {
        for (a, b) in self.0.iter().zip(&other.0) {
            // The smaller variable is the more significant one.
            let order = b.0.cmp(&a.0).then(a.1.cmp(&b.1));
            if order != Ordering::Equal {
                return order;
            }
        }
        self.0.len().cmp(&other.0.len())
    }
}

impl PartialOrd for Factors {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Key for Factors {
    fn product(&self, other: &Self) -> Self {
        Self(product(&self.0, &other.0).into_boxed_slice())
    }

    fn hash(&self) -> u64 {
        let mut hash = 0_u64;
        for &(variable, exponent) in &self.0 {
            let word = (u64::from(variable) << 32) | u64::from(exponent);
            hash = (hash.rotate_left(23) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        }
        hash
    }
}

/// Factors (variable, exponent), ascending by variable.
pub type Monomial = [(u32, u32)];

/// The product of two monomials.
#[must_use]
pub fn product(a: &Monomial, b: &Monomial) -> Vec<(u32, u32)> {
    let mut result = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].0.cmp(&b[j].0) {
            Ordering::Less => {
                result.push(a[i]);
                i += 1;
            }
            Ordering::Greater => {
                result.push(b[j]);
                j += 1;
            }
            Ordering::Equal => {
                // The degree of every product is checked to fit before.
                result.push((a[i].0, a[i].1.saturating_add(b[j].1)));
                i += 1;
                j += 1;
            }
        }
    }
    result.extend_from_slice(&a[i..]);
    result.extend_from_slice(&b[j..]);
    result
}

/// The factors with variables before this one, the momenta say, and the others.
#[must_use]
pub fn split_at(factors: &Monomial, variable: usize) -> (&Monomial, &Monomial) {
    factors.split_at(factors.partition_point(|&(own, _)| (own as usize) < variable))
}
