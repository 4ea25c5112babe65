//! Folding: the coefficients of a step from its size and the parameters.

use core::fmt;

use crate::limits::LARGEST_RATIO;

/// The numbers that are folded: one, or those of several rows side by side, each with the bits that it has alone.
pub trait Values: Copy {
    /// The numbers that `of` gives, lane by lane.
    fn each(of: impl Fn(usize) -> f64) -> Self;
    /// The number of a lane.
    fn lane(&self, lane: usize) -> f64;
    /// True if `holds` is true for the number of each lane.
    fn all(&self, holds: impl Fn(f64) -> bool) -> bool;
}

impl Values for f64 {
    #[inline(always)]
    fn each(of: impl Fn(usize) -> f64) -> Self {
        of(0)
    }
    #[inline(always)]
    fn lane(&self, _: usize) -> f64 {
        *self
    }
    #[inline(always)]
    fn all(&self, holds: impl Fn(f64) -> bool) -> bool {
        holds(*self)
    }
}

impl<const L: usize> Values for [f64; L] {
    #[inline(always)]
    fn each(of: impl Fn(usize) -> f64) -> Self {
        let mut lanes = [0.0; L];
        for (lane, value) in lanes.iter_mut().enumerate() {
            *value = of(lane);
        }
        lanes
    }
    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self[lane]
    }
    #[inline(always)]
    fn all(&self, holds: impl Fn(f64) -> bool) -> bool {
        self.iter().all(|&value| holds(value))
    }
}

/// The coefficients of a step as data.
///
/// A *base* is a sum of *parts*, a part a power of h times a sum of *terms* factor · product, a product one of powers of
/// symbols, and a coefficient a base times an integer. Lists that refer to bases or parts are sorted by them, so that one
/// pass over the data folds all.
#[derive(Clone, Copy, Debug)]
pub struct Fold<'a> {
    /// Product n + 1 is this product, with product 0 = 1, times this symbol.
    pub products: &'a [(u32, u32)],
    /// Factor and product.
    pub terms: &'a [(f64, u32)],
    /// For each part the power of h, and where its terms end.
    pub parts: &'a [(u32, u32)],
    /// For each base the end of its parts.
    pub bases: &'a [u32],
    /// Base, integer, and the place of their product among the coefficients.
    pub slots: &'a [(u32, u32, u32)],
    /// Base, weight, and the place to which weight · |base| is added: a bound by degrees.
    pub bound: &'a [(u32, f64, u32)],
    /// Part, and the place at which its value is kept.
    pub kept: &'a [(u32, u32)],
    /// The last two terms of the series.
    pub last: &'a [LastTerm],
    /// The place of the square of the radius of the series.
    pub radius: Option<u32>,
}

/// A monomial of S_K or S_{K−2} in the coordinates of one direct factor of the group: the part that is its coefficient, the
/// factor, whether it is one of S_K, the degree of its gradient, and a bound on that in these coordinates where |p| of each
/// factor is one.
pub type LastTerm = (u32, u32, bool, u32, f64);

/// Errors of folding coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FoldError {
    /// The step size is zero or not finite.
    Step,
    /// This symbol is not finite, or is a rate of damping below 0.
    Symbol(usize),
    /// A coefficient is not finite; its value.
    Coefficient(f64),
}

impl fmt::Display for FoldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Step => f.write_str("the step size is zero or not finite"),
            Self::Symbol(i) => {
                write!(f, "expression {i} of the parameters is not finite, or is a rate below 0")
            }
            Self::Coefficient(value) => write!(f, "a coefficient is {value}"),
        }
    }
}

impl core::error::Error for FoldError {}

/// Series whose last terms have gradients of this degree, or a higher one, have no radius: each momentum is judged by itself.
pub const DEGREES: usize = 64;

impl Fold<'_> {
    /// The numbers of the room that folding works in: the products, then the parts.
    pub const fn room(&self) -> usize {
        1 + self.products.len() + self.parts.len()
    }

    /// Writes all coefficients for a step size and the values of the symbols; places that no list names stay as they are.
    ///
    /// # Errors
    /// [`FoldError`]; the coefficients then mean nothing. [`FoldError::Coefficient`] too where the room has fewer numbers than
    /// [`Fold::room`].
    // Not generic, so that users' debug builds have it optimised.
    pub fn fold(
        &self,
        step: f64,
        symbols: &[f64],
        room: &mut [f64],
        coefficients: &mut [f64],
    ) -> Result<(), FoldError> {
        self.fold_rows(step, symbols, room, coefficients)
    }

    /// Folds for rows side by side. An error does not tell which lane is not finite; folding each alone does.
    ///
    /// # Errors
    /// As [`Fold::fold`].
    pub fn fold_rows<T: Values>(
        &self,
        step: f64,
        symbols: &[T],
        room: &mut [T],
        coefficients: &mut [T],
    ) -> Result<(), FoldError> {
        if let Some(symbol) = symbols.iter().position(|value| !value.all(f64::is_finite)) {
            return Err(FoldError::Symbol(symbol));
        }
        let [nothing, one] = [f64::NAN, 1.0].map(|value| T::each(|_| value));
        if let Some(first) = room.first_mut() {
            *first = one;
        }
        for (made, &(of, symbol)) in (1..).zip(self.products) {
            let value = symbols.get(symbol as usize).copied().unwrap_or(nothing);
            let product = at(room, of);
            set(room, made, T::each(|l| product.lane(l) * value.lane(l)));
        }
        self.fold_products(step, room, coefficients)
    }

    /// Folds with what stands for the products of symbols at the beginning of the room, in which coefficients are linear.
    ///
    /// # Errors
    /// As [`Fold::fold`].
    pub fn fold_products<T: Values>(
        &self,
        step: f64,
        room: &mut [T],
        coefficients: &mut [T],
    ) -> Result<(), FoldError> {
        if step == 0.0 || !step.is_finite() {
            return Err(FoldError::Step);
        }
        let Some((products, parts)) = room.split_at_mut_checked(1 + self.products.len()) else {
            return Err(FoldError::Coefficient(f64::NAN));
        };
        let zero = T::each(|_| 0.0);
        let mut terms = self.terms.iter();
        let mut start = 0;
        for (number, &(power, end)) in (0..).zip(self.parts) {
            let own = terms.by_ref().take((end - start) as usize);
            let sum = own.fold(zero, |sum, &(factor, product)| {
                let product = at(products, product);
                T::each(|l| sum.lane(l) + factor * product.lane(l))
            });
            let power = (0..power).fold(1.0, |product, _| product * step);
            set(parts, number, T::each(|l| sum.lane(l) * power));
            start = end;
        }
        for &(.., place) in self.bound {
            set(coefficients, place, zero);
        }
        let (mut slots, mut bound) = (self.slots.iter().peekable(), self.bound.iter().peekable());
        let mut start = 0;
        for (base, &end) in (0..).zip(self.bases) {
            let value = (start..end).fold(zero, |sum, part| {
                let own = at(parts, part);
                T::each(|l| sum.lane(l) + own.lane(l))
            });
            start = end;
            if !value.all(f64::is_finite) {
                return Err(FoldError::Coefficient(value.lane(0)));
            }
            while let Some(&(_, scale, place)) = slots.next_if(|slot| slot.0 == base) {
                set(coefficients, place, T::each(|l| value.lane(l) * f64::from(scale)));
            }
            while let Some(&(_, weight, place)) = bound.next_if(|term| term.0 == base) {
                let sum = at(coefficients, place);
                let sum = T::each(|l| sum.lane(l) + value.lane(l).abs() * weight);
                set(coefficients, place, sum);
            }
        }
        for &(part, place) in self.kept {
            set(coefficients, place, at(parts, part));
        }
        if let Some(place) = self.radius {
            let radius = self.radius(room, LARGEST_RATIO);
            set(coefficients, place, T::each(|l| radius.lane(l) * radius.lane(l)));
        }
        Ok(())
    }

    /// The |p| of each direct factor of the group up to which the last two terms of the series have at most this ratio in
    /// every direction, by the room that coefficients were folded in.
    pub fn radius<T: Values>(&self, room: &[T], ratio: f64) -> T {
        let parts = room.get(1 + self.products.len()..).unwrap_or(&[]);
        radius(self.last.iter().map(|term| (at(parts, term.0), *term)), ratio)
    }
}

/// The number at a place; not a number where there is none.
#[inline(always)]
fn at<T: Values>(list: &[T], place: u32) -> T {
    list.get(place as usize).copied().unwrap_or(T::each(|_| f64::NAN))
}

#[inline(always)]
fn set<T>(coefficients: &mut [T], place: u32, value: T) {
    if let Some(coefficient) = coefficients.get_mut(place as usize) {
        *coefficient = value;
    }
}

/// Degree and size of a bound on the gradient of a monomial, given as (coordinate, exponent), in the coordinates of one
/// direct factor of the group, where |p| of each factor is one; `None` where it has none of them.
///
/// The size is D_f Π max |pᵐ|, D_f being the degree in those coordinates and the maximum of the part in each factor g over
/// the unit sphere Π (mᵢ/D_g)^{mᵢ/2} (O. Kellogg, Math. Z. 27 (1928) 55). `root` is the square root.
pub fn gradient_bound(
    monomial: &[(u32, u32)],
    factor_of: impl Fn(u32) -> u32,
    factor: u32,
    root: impl Fn(f64) -> f64,
) -> Option<(u32, f64)> {
    // n^{n/2}
    let half_power = |n: u32| {
        let whole = (0..n / 2).fold(1.0, |power, _| power * f64::from(n));
        if n.is_multiple_of(2) { whole } else { whole * root(f64::from(n)) }
    };
    let degree_in = |of: u32| -> u32 {
        monomial.iter().filter(|&&(i, _)| factor_of(i) == of).map(|&(_, power)| power).sum()
    };
    let own = degree_in(factor);
    let degree: u32 = monomial.iter().map(|&(_, power)| power).sum();
    let highest: f64 = monomial.iter().map(|&(_, power)| half_power(power)).product();
    let first_of_factor = monomial.iter().enumerate().filter(|&(at, &(i, _))| {
        monomial.iter().take(at).all(|&(other, _)| factor_of(other) != factor_of(i))
    });
    let spheres: f64 =
        first_of_factor.map(|(_, &(i, _))| half_power(degree_in(factor_of(i)))).product();
    (own > 0).then(|| (degree.saturating_sub(1), f64::from(own) * highest / spheres))
}

/// The |p| of each direct factor of the group up to which the last two terms of a series have at most this ratio in every
/// direction, given the coefficients of their monomials.
#[inline(always)]
pub fn radius<T: Values>(terms: impl Iterator<Item = (T, LastTerm)> + Clone, ratio: f64) -> T {
    let factors = terms.clone().map(|(_, term)| term.1 + 1).max().unwrap_or(0);
    let zero = T::each(|_| 0.0);
    let of_factor = |factor: u32| {
        // By the degree of the gradient: of S_K, and of S_{K−2}.
        let (mut last, mut before) = ([zero; DEGREES], [zero; DEGREES]);
        for (value, (_, own, highest, degree, weight)) in terms.clone() {
            let of = if highest { &mut last } else { &mut before };
            match of.get_mut(degree as usize) {
                _ if own != factor => {}
                Some(sum) => *sum = T::each(|l| sum.lane(l) + value.lane(l).abs() * weight),
                None => return zero,
            }
        }
        within(&last, &before, ratio)
    };
    let nearer = |a: T, b: T| T::each(|l| a.lane(l).min(b.lane(l)));
    (0..factors).map(of_factor).fold(T::each(|_| f64::MAX), nearer)
}

/// The largest r up to which the polynomial with the coefficients `last` is at most `ratio` times that with the
/// coefficients `before`; neither has a negative one.
#[inline(always)]
fn within<T: Values>(last: &[T; DEGREES], before: &[T; DEGREES], ratio: f64) -> T {
    let whole =
        |of: &[T; DEGREES]| of.iter().rposition(|c| !c.all(|c| c == 0.0)).map_or(0, |top| top + 1);
    let (last, before) = (last.split_at(whole(last)).0, before.split_at(whole(before)).0);
    let polynomial = |of: &[T], r: &T| {
        of.iter()
            .rev()
            .fold(T::each(|_| 0.0), |sum, c| T::each(|l| sum.lane(l) * r.lane(l) + c.lane(l)))
    };
    // r where it holds for it, else `otherwise`.
    let where_it_holds = |r: &T, otherwise: &T| {
        let (size, whole) = (polynomial(last, r), polynomial(before, r));
        T::each(|l| {
            let (size, whole) = (size.lane(l), whole.lane(l));
            // Without a term to compare with there is no ratio, and that of rounding, which is what is left of a term that
            // cancels (of a spherical body, say), means nothing.
            let nothing = whole <= 0.0 || size <= 16.0 * f64::EPSILON;
            let holds = (size <= ratio * whole || nothing) && size <= f64::MAX;
            if holds { r.lane(l) } else { otherwise.lane(l) }
        })
    };
    // The ratio grows with r; by powers of two, then of their roots.
    let mut r = where_it_holds(&T::each(|_| f64::from(f32::MIN_POSITIVE)), &T::each(|_| 0.0));
    for factor in LONGER {
        r = where_it_holds(&T::each(|l| r.lane(l) * factor), &r);
    }
    let one = polynomial(last, &T::each(|_| 1.0));
    T::each(|l| if one.lane(l) == 0.0 { f64::MAX } else { r.lane(l) })
}

/// The factors by which a radius is made longer, one after the other: 2^512 … 2, and three roots of 2.
const LONGER: [f64; 13] = [
    1.340_780_792_994_259_7e154,
    1.157_920_892_373_162e77,
    3.402_823_669_209_385e38,
    1.844_674_407_370_955_2e19,
    4_294_967_296.0,
    65_536.0,
    256.0,
    16.0,
    4.0,
    2.0,
    core::f64::consts::SQRT_2,
    1.189_207_115_002_721,
    1.090_507_732_665_257_7,
];
