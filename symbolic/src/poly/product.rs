//! Sums of products, the operation everything else is made of.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

use crate::cancel;
use crate::number::{Fractions, Rational, bits, lcm};
use crate::poly::polynomial::{Factors, Key, Keys, Polynomial};

/// Reasons for which a sum is not computed.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SumError {
    /// The sum has more terms than the limit allows; this many were counted.
    Terms(usize),
    /// A degree does not fit into 32 bits.
    Degree,
}

/// The coefficients of a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arithmetic {
    /// They are exact.
    Exact,
    /// Where they do not fit into machine integers, each is rounded to floating point: for estimates and first guesses, which take
    /// a fifth of the time.
    Rounded,
}

/// A sum in floating point.
#[derive(Clone, Copy)]
struct Rounded {
    sum: f64,
    /// The sum of the absolute values of its terms.
    size: f64,
}

/// A sum that is smaller than this part of its terms is made of rounding, where it is none that is 0.
const CANCELLED: f64 = 1e-12;

impl Rounded {
    fn new(sum: f64) -> Self {
        Self { sum, size: sum.abs() }
    }
}

impl Numerator for Rounded {
    fn times(&self, other: &Self) -> Self {
        Self::new(self.sum * other.sum)
    }
    fn add_product(&mut self, left: &Self, right: &Self) {
        let product = left.sum * right.sum;
        self.sum += product;
        self.size += product.abs();
    }
    fn vanishes(&self) -> bool {
        self.sum.abs() <= CANCELLED * self.size
    }
    fn nothing() -> Self {
        Self::new(0.0)
    }
}

/// The sum of products, if it has no more than `limit` terms.
///
/// All products are collected in one table over one common denominator. With machine integers
/// the largest possible sum is bounded beforehand; big integers are used where it might not fit.
pub(crate) fn sum_of_products(
    variables: usize,
    products: &[Multiplication<'_>],
    limit: usize,
    arithmetic: Arithmetic,
) -> Result<Polynomial, SumError> {
    let used: Vec<&Multiplication<'_>> = products
        .iter()
        .filter(|p| !p.left.is_zero() && !p.right.is_zero() && !p.factor.is_zero())
        .collect();
    let mut bound = 0;
    for product in &used {
        let degree = product.left.bound.checked_add(product.right.bound);
        bound = degree.ok_or(SumError::Degree)?.max(bound);
    }
    let packed = Polynomial::packing(variables, bound).is_some();
    let mut keys = Vec::with_capacity(used.len());
    for product in &used {
        keys.push((product.left.keys_for(packed), product.right.keys_for(packed)));
    }
    let small = SmallPlan::new(&used);
    if packed {
        let lists: Vec<(&[u128], &[u128])> =
            keys.iter().map(|(a, b)| (a.packed(), b.packed())).collect();
        let (keys, values) =
            run(&used, small, &lists, (limit, arithmetic)).map_err(SumError::Terms)?;
        Ok(Polynomial::assemble(variables, bound, Keys::Packed(keys), values))
    } else {
        let lists: Vec<(&[Factors], &[Factors])> =
            keys.iter().map(|(a, b)| (a.sparse(), b.sparse())).collect();
        let (keys, values) =
            run(&used, small, &lists, (limit, arithmetic)).map_err(SumError::Terms)?;
        Ok(Polynomial::assemble(variables, bound, Keys::Sparse(keys), values))
    }
}

fn run<K: Key>(
    products: &[&Multiplication<'_>],
    small: Option<SmallPlan>,
    keys: &[(&[K], &[K])],
    (limit, arithmetic): (usize, Arithmetic),
) -> Result<(Vec<K>, Fractions), usize> {
    if let Some(plan) = small {
        let lists: Vec<(i128, &[i128], &[i128])> = products
            .iter()
            .zip(&plan.factors)
            .filter_map(|(p, factor)| match (&p.left.values, &p.right.values) {
                (
                    Fractions::Small { numerators: a, .. },
                    Fractions::Small { numerators: b, .. },
                ) => Some((*factor, a.as_slice(), b.as_slice())),
                _ => None,
            })
            .collect();
        let (keys, values) = accumulate::<K, i128>(keys, &lists, limit)?;
        return Ok((keys, Fractions::small(values, plan.denominator)));
    }
    if arithmetic == Arithmetic::Rounded {
        let rounded = |side: &Polynomial| -> Option<Vec<Rounded>> {
            Some(side.values.to_f64s()?.into_iter().map(Rounded::new).collect())
        };
        let operands = products.iter().map(|p| Some((rounded(p.left)?, rounded(p.right)?)));
        if let Some(operands) = operands.collect::<Option<Vec<_>>>() {
            let factor =
                |p: &&Multiplication<'_>| Rounded::new(p.factor.to_f64().unwrap_or(f64::NAN));
            let lists = products.iter().zip(&operands);
            let lists: Vec<(Rounded, &[Rounded], &[Rounded])> =
                lists.map(|(p, (a, b))| (factor(p), a.as_slice(), b.as_slice())).collect();
            let (keys, sums) = accumulate::<K, Rounded>(keys, &lists, limit)?;
            let sums: Vec<f64> = sums.into_iter().map(|rounded| rounded.sum).collect();
            if let Some(values) = Fractions::of_f64s(&sums) {
                return Ok((keys, values));
            }
        }
    }
    let plan = LargePlan::new(products);
    let operands: Vec<(Vec<BigInt>, Vec<BigInt>)> = products
        .iter()
        .map(|p| (p.left.values.numerators(), p.right.values.numerators()))
        .collect();
    let lists: Vec<(BigInt, &[BigInt], &[BigInt])> = operands
        .iter()
        .zip(&plan.factors)
        .map(|((a, b), factor)| (factor.clone(), a.as_slice(), b.as_slice()))
        .collect();
    let (keys, values) = accumulate::<K, BigInt>(keys, &lists, limit)?;
    Ok((keys, Fractions::big(values, plan.denominator)))
}

/// The arithmetic of one kind of number.
pub(super) trait Numerator: Sized {
    fn times(&self, other: &Self) -> Self;
    fn add_product(&mut self, left: &Self, right: &Self);
    fn vanishes(&self) -> bool;
    fn nothing() -> Self;
}

impl Numerator for i128 {
    // The plan bounds every sum, so wrapping operations never wrap.
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        self.wrapping_mul(*other)
    }
    #[inline(always)]
    fn add_product(&mut self, left: &Self, right: &Self) {
        *self = self.wrapping_add(left.wrapping_mul(*right));
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        *self == 0
    }
    #[inline(always)]
    fn nothing() -> Self {
        0
    }
}

impl Numerator for BigInt {
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn add_product(&mut self, left: &Self, right: &Self) {
        *self += left * right;
    }
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
    fn nothing() -> Self {
        Self::zero()
    }
}

/// The nonzero terms of Σ factor · left · right, sorted. Loops count by hand and index slices
/// because iterators are function calls in an unoptimised build.
pub(super) fn accumulate<K: Key, N: Numerator>(
    keys: &[(&[K], &[K])],
    numbers: &[(N, &[N], &[N])],
    limit: usize,
) -> Result<(Vec<K>, Vec<N>), usize> {
    let expected = keys.iter().map(|(a, b)| a.len() + b.len()).max().unwrap_or(0);
    let mut table = IndexSet::new(expected);
    let mut sums: Vec<N> = Vec::with_capacity(expected);
    let mut index = 0;
    while index < keys.len() {
        let (left_keys, right_keys) = keys[index];
        let (factor, left, right) = &numbers[index];
        let mut i = 0;
        while i < left_keys.len() {
            cancel::check();
            let scaled = factor.times(&left[i]);
            let mut j = 0;
            while j < right_keys.len() {
                let place = table.place(left_keys[i].product(&right_keys[j]));
                if place == sums.len() {
                    sums.push(N::nothing());
                }
                sums.as_mut_slice()[place].add_product(&scaled, &right[j]);
                j += 1;
            }
            // Checked once a row: cancellation may still bring the count down, but memory is
            // what the limit protects.
            if sums.len() > limit {
                return Err(sums.len());
            }
            i += 1;
        }
        index += 1;
    }
    Ok(sort::<K, N>(table.keys, sums))
}

/// Drops zeros and sorts keys descending.
fn sort<K: Key, N: Numerator>(keys: Vec<K>, sums: Vec<N>) -> (Vec<K>, Vec<N>) {
    let mut terms: Vec<(K, N)> = Vec::with_capacity(keys.len());
    for (key, sum) in keys.into_iter().zip(sums) {
        if !sum.vanishes() {
            terms.push((key, sum));
        }
    }
    terms.sort_unstable_by(|a, b| b.0.cmp(&a.0));
    terms.into_iter().unzip()
}

/// A summand factor · left · right.
pub(crate) struct Multiplication<'a> {
    pub(crate) factor: Rational,
    pub(crate) left: &'a Polynomial,
    pub(crate) right: &'a Polynomial,
}

/// The common denominator and the integer factor of each product, if machine integers suffice.
pub(super) struct SmallPlan {
    pub(super) denominator: i128,
    pub(super) factors: Vec<i128>,
}

impl SmallPlan {
    pub(super) fn new(products: &[&Multiplication<'_>]) -> Option<Self> {
        let mut denominator = 1_i128;
        let mut parts = Vec::with_capacity(products.len());
        for product in products {
            let (Fractions::Small { denominator: a, .. }, Fractions::Small { denominator: b, .. }) =
                (&product.left.values, &product.right.values)
            else {
                return None;
            };
            let part = a.checked_mul(*b)?.checked_mul(product.factor.denom().to_i128()?)?;
            denominator = lcm(denominator, part)?;
            parts.push(part);
        }
        let mut factors = Vec::with_capacity(products.len());
        let mut largest = 0_u128;
        for (product, part) in products.iter().zip(parts) {
            let factor = (denominator / part).checked_mul(product.factor.numer().to_i128()?)?;
            let (Fractions::Small { bits: a, .. }, Fractions::Small { bits: b, .. }) =
                (&product.left.values, &product.right.values)
            else {
                return None;
            };
            let size = bits(factor) + a + b;
            if size > 126 {
                return None;
            }
            // A monomial receives at most one contribution from each term of the shorter factor.
            let contributions = product.left.len().min(product.right.len()) as u128;
            largest = largest.checked_add(contributions.checked_mul(1 << size)?)?;
            factors.push(factor);
        }
        (largest <= i128::MAX as u128).then_some(Self { denominator, factors })
    }
}

/// As [`SmallPlan`], with big integers.
struct LargePlan {
    denominator: BigInt,
    factors: Vec<BigInt>,
}

impl LargePlan {
    fn new(products: &[&Multiplication<'_>]) -> Self {
        let mut denominator = BigInt::one();
        let mut parts = Vec::with_capacity(products.len());
        for product in products {
            let part = product.left.values.denominator()
                * product.right.values.denominator()
                * product.factor.denom();
            if !(&denominator % &part).is_zero() {
                denominator = denominator.lcm(&part);
            }
            parts.push(part);
        }
        let factor = |(product, part): (&&Multiplication<'_>, BigInt)| {
            product.factor.numer() * (&denominator / part)
        };
        let factors = products.iter().zip(parts).map(factor).collect();
        Self { denominator, factors }
    }
}

const EMPTY: u32 = u32::MAX;

/// Monomials in order of insertion, found by hashing.
pub(crate) struct IndexSet<K> {
    pub(crate) keys: Vec<K>,
    slots: Vec<u32>,
    shift: u32,
}

impl<K: Key> IndexSet<K> {
    /// A table with room for about `expected` monomials.
    pub(crate) fn new(expected: usize) -> Self {
        let bits = usize::BITS - expected.clamp(8, 1 << 20).leading_zeros() + 1;
        Self { keys: Vec::new(), slots: vec![EMPTY; 1 << bits], shift: 64 - bits }
    }

    /// The place of a monomial, which is the length of the list if it is new.
    #[inline(always)]
    pub(crate) fn place(&mut self, key: K) -> usize {
        let mask = self.slots.len() - 1;
        let slots = self.slots.as_mut_slice();
        let mut slot = (key.hash() >> self.shift) as usize;
        loop {
            let place = slots[slot];
            if place == EMPTY {
                break;
            }
            if self.keys.as_slice()[place as usize] == key {
                return place as usize;
            }
            slot = (slot + 1) & mask;
        }
        slots[slot] = self.keys.len() as u32;
        self.keys.push(key);
        if self.keys.len() * 2 > slots.len() {
            self.grow();
        }
        self.keys.len() - 1
    }

    fn grow(&mut self) {
        self.shift -= 1;
        let size = self.slots.len() * 2;
        self.slots = vec![EMPTY; size];
        for (place, key) in self.keys.iter().enumerate() {
            let mut slot = (key.hash() >> self.shift) as usize;
            while self.slots[slot] != EMPTY {
                slot = (slot + 1) & (size - 1);
            }
            self.slots[slot] = place as u32;
        }
    }
}
