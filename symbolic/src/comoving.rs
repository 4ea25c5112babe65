//! The comoving frame: a summand of H whose flow is known and commutes with the rest.
//!
//! In a field spins precess about it as fast as the field is strong; where the couplings do not know its direction, the
//! precession is exp(tξ) exactly, and only the couplings are left. A free body turns at Ω = I⁻¹Π, and most of that is uniform: with c between the 1/Iᵢ the part c|Π|²/2
//! of H, a Casimir, makes it turn about the fixed direction of its momentum, and what the body does in the
//! frame that turns along is slow. A symmetric top's spin s is an integral; without ½(1/I₃ − 1/I₁)s² it
//! is a spherical top, which knows nothing of the spin. In all cases H = H₀ + f with commuting flows,
//! that of f is exp of something known, and only H₀ is left to the series: it has fewer terms, and they
//! are smaller by powers of the ratio of the speeds.
//!
//! The first two are functions of linear integrals ⟨μ, η⟩, which exact elimination finds for every algebra.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::hamilton_jacobi::{TermLimit, derive};
use crate::lie::{Chart, LieAlgebra, casimirs, null_space};
use crate::number::Rational;
use crate::poly::{Polynomial, split_at};

/// The truncation at which series are compared: brackets that vanish from S₃ are missing from all terms.
const COMPARED: usize = 3;

/// The dimension up to which candidates beside the field are compared: each costs a series.
const SEARCHED: usize = 96;

/// The summand f of H whose flow moves the frame, and what is left of H without it.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// The linear term ⟨μ, ξ⟩ that commutes with the rest, and functions of integrals s = ⟨μ, η⟩ that commute: the flow
    /// moves g and μ by exp of the multiples of ξ and η.
    pub spin: Polynomial,
    /// Multiples of quadratic Casimirs, or any Casimir C that is all of the rest: the flow moves g along ∂C/∂μ and leaves μ.
    pub casimirs: Polynomial,
    /// H − f, which is left to the series.
    pub rest: Polynomial,
}

impl Frame {
    /// The function f as one polynomial.
    pub fn energy(&self) -> Polynomial {
        &self.spin + &self.casimirs
    }

    /// The summands of f that are not zero. Their flows commute, and each takes an exponential of its own.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Polynomial> {
        [&self.spin, &self.casimirs].into_iter().filter(|part| !part.is_zero())
    }
}

/// Finds the frame in which the series of the rest, S₁ + S₃, has fewest terms, after the [field](commuting_field) is taken
/// from it; above 96 dimensions it has the field alone. A rest that leaves the momentum where it is, a Casimir, is taken
/// whole, and nothing is left. `None` where there is no field and nothing else makes it shorter.
///
/// Variables of `hamiltonian` beyond the dimension are symbols; an η that depends on them is not found.
///
/// ```
/// use coadjoint_symbolic::comoving::comoving;
/// use coadjoint_symbolic::lie::{Chart, catalogue::lookup};
/// use coadjoint_symbolic::number::ratio;
/// use coadjoint_symbolic::poly::Polynomial;
///
/// let body = |inverse: [i64; 3]| {
///     let square = |i: usize| Polynomial::variable(3, i).pow(2).scale(&ratio(inverse[i], 2));
///     &(&square(0) + &square(1)) + &square(2)
/// };
/// let so3 = lookup("SO3").unwrap();
/// // x²/2 + y² + 3z²/2 without |μ|² is (z² − x²)/2.
/// let frame = comoving(&so3, Chart::Exponential, &body([1, 2, 3])).unwrap();
/// assert_eq!(frame.energy(), body([2, 2, 2]));
/// // x²/2 + y²/2 + z² without z²/2 is |μ|²/2, of which one step is exact.
/// let frame = comoving(&so3, Chart::Exponential, &body([1, 1, 2])).unwrap();
/// assert_eq!(frame.spin, body([0, 0, 1]));
/// // Of a linear H, and of a function of Casimirs beside it, nothing is left.
/// let axis = Polynomial::variable(3, 2);
/// let frame = comoving(&so3, Chart::Exponential, &(&axis + &body([1, 1, 1]).pow(2))).unwrap();
/// assert!(frame.spin == axis && frame.rest.is_zero());
/// ```
pub fn comoving(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<Frame> {
    let dim = algebra.dim();
    let length = |h: &Polynomial| length(algebra, chart, h);
    let field = commuting_field(algebra, hamiltonian);
    let mut rest = hamiltonian - &field;
    let nothing = || Polynomial::zero(hamiltonian.variables());
    if algebra.hamiltonian_field(&rest).iter().all(Polynomial::is_zero) {
        let (casimirs, rest) = match degree(&rest, dim) {
            0 => (nothing(), rest),
            _ => (rest, nothing()),
        };
        return (rest != *hamiltonian).then_some(Frame { spin: field, casimirs, rest });
    }
    let mut fewest = length(&rest)?;
    if dim > SEARCHED {
        return (rest != *hamiltonian).then_some(Frame { spin: field, casimirs: nothing(), rest });
    }
    // Takes the best candidate off the rest, if the rest becomes shorter by it.
    let mut take = |candidates: &dyn Fn(&Polynomial) -> Vec<Polynomial>| {
        let (monomials, left, part) = best(&rest, candidates(&rest), dim, &length)?;
        if monomials >= fewest {
            return None;
        }
        (fewest, rest) = (monomials, left);
        Some(part)
    };
    let sum = |first: &Polynomial, parts: Vec<Polynomial>| {
        parts.iter().fold(first.clone(), |sum, part| &sum + part)
    };
    let axes = axes(algebra, hamiltonian, &field);
    let spin = axes.iter().filter_map(|axis| take(&|h| spins(h, axis, dim))).collect();
    let spin = sum(&field, spin);
    let known = casimirs(algebra, 2).unwrap_or_default();
    let casimirs = known.iter().filter_map(|c| take(&|h| multiples(h, c, dim))).collect();
    let casimirs = sum(&nothing(), casimirs);
    (rest != *hamiltonian).then_some(Frame { spin, casimirs, rest })
}

/// True where the frame is taken though the choice is left: there is a [field](commuting_field), or H is the sum of a multiple of a
/// quadratic Casimir and a function of other coordinates, some of the same ideal. Such is a body on SE(3) with one mass for all directions, P²/2m
/// being a Casimir: its path is straight however far a step goes, while in the chart of a series about its own axes what is
/// far seems to turn the body.
pub fn is_uniform(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> bool {
    let dim = algebra.dim();
    if dim <= SEARCHED && degree(hamiltonian, dim) > 0 {
        let ideals = algebra.ideals();
        let apart = |part: &Polynomial| {
            let (of_rest, of_part) = (momenta(&(hamiltonian - part), dim), momenta(part, dim));
            let both = |ideal: &Vec<usize>| {
                [&of_rest, &of_part].iter().all(|own| ideal.iter().any(|i| own.contains(i)))
            };
            of_rest.is_disjoint(&of_part) && ideals.iter().any(both)
        };
        let known = casimirs(algebra, 2).unwrap_or_default();
        if known.iter().any(|c| multiples(hamiltonian, c, dim).iter().any(apart)) {
            return true;
        }
    }
    !commuting_field(algebra, hamiltonian).is_zero()
}

/// The coordinates of the momentum that a polynomial depends on.
fn momenta(polynomial: &Polynomial, dim: usize) -> BTreeSet<usize> {
    let factors = polynomial.factors().flat_map(|(factors, _)| split_at(&factors, dim).0.to_vec());
    factors.map(|(variable, _)| variable as usize).collect()
}

/// The η of linear integrals that commute with the field and those before them, coordinates first.
fn axes(algebra: &LieAlgebra, hamiltonian: &Polynomial, field: &Polynomial) -> Vec<Element> {
    let mut integrals = linear_integrals(algebra, hamiltonian);
    integrals.sort_by_key(|eta| eta.iter().filter(|entry| !entry.is_zero()).count() > 1);
    let mut known = vec![field.clone()];
    let mut independent = |eta: &Element| {
        let integral = functional(hamiltonian.variables(), eta);
        let commutes = known.iter().all(|other| commute(algebra, other, &integral));
        known.extend(commutes.then_some(integral));
        commutes
    };
    integrals.retain(&mut independent);
    integrals
}

/// The number of monomials in the momenta that S₁ and S₃ of a Hamiltonian have; `None` for a Hamiltonian without momenta.
fn length(algebra: &LieAlgebra, chart: Chart, hamiltonian: &Polynomial) -> Option<usize> {
    let dim = algebra.dim();
    if hamiltonian.factors().all(|(factors, _)| split_at(&factors, dim).0.is_empty()) {
        return None;
    }
    let series = derive(algebra, chart, hamiltonian, COMPARED, TermLimit::default()).ok()?;
    Some((1..=COMPARED).map(|k| monomials(series.order(k), dim)).sum())
}

/// The number of different monomials in the momenta.
fn monomials(polynomial: &Polynomial, dim: usize) -> usize {
    let momenta = polynomial.factors().map(|(factors, _)| split_at(&factors, dim).0.to_vec());
    momenta.collect::<BTreeSet<_>>().len()
}

/// The candidate that leaves fewest monomials, after their number and what is left; none that leaves H itself longer. Of
/// equals the one that leaves the smallest coefficients, and of these (as where all are symbols) the one nearest to the middle: of the
/// three of a body, the axis of middle inertia in the usual order.
fn best(
    rest: &Polynomial,
    candidates: Vec<Polynomial>,
    dim: usize,
    length: &impl Fn(&Polynomial) -> Option<usize>,
) -> Option<(usize, Polynomial, Polynomial)> {
    let (middle, most) = (candidates.len() / 2, monomials(rest, dim));
    let measured = candidates.into_iter().enumerate().filter_map(|(at, part)| {
        let left = rest - &part;
        if monomials(&left, dim) > most {
            return None;
        }
        let sizes = left.factors().map(|(_, value)| value.to_f64().map_or(0.0, f64::abs));
        let largest = sizes.fold(0.0, f64::max);
        Some((length(&left)?, largest, at.abs_diff(middle), left, part))
    });
    let least = measured.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    least.map(|(length, _, _, left, part)| (length, left, part))
}

/// Functions of s = ⟨μ, η⟩: its powers above the square where H has them, and of the square as much as cancels a monomial
/// of H or makes two squares in H equal, or nothing.
fn spins(hamiltonian: &Polynomial, eta: &Element, dim: usize) -> Vec<Polynomial> {
    let variables = hamiltonian.variables();
    let integral = functional(variables, eta);
    // A power with more monomials than twice those of H makes it longer.
    let power = |power: u32| {
        let count = (0..u64::from(power))
            .fold(1, |count: u64, i| count.saturating_mul(integral.len() as u64 + i) / (i + 1));
        (count <= 2 * hamiltonian.len() as u64).then(|| integral.pow(power))
    };
    let mut others = Polynomial::zero(variables);
    for power in (3..=degree(hamiltonian, dim)).filter_map(power) {
        let parts = multiples(hamiltonian, &power, dim).into_iter();
        let mut shorter = parts.filter(|part| (hamiltonian - part).len() < hamiltonian.len());
        others = &others + &shorter.next().unwrap_or_else(|| Polynomial::zero(variables));
    }
    let square = |i: usize| coefficient(hamiltonian, &[(i as u32, 2)], dim);
    let mut shares = Vec::new();
    for i in (0..dim).filter(|&i| !eta[i].is_zero()) {
        for (j, other) in (0..dim).map(|j| (j, square(j))).filter(|(_, other)| !other.is_zero()) {
            let difference = &eta[i] * &eta[i] - &eta[j] * &eta[j];
            if !difference.is_zero() {
                shares.push((&square(i) - &other).scale(&difference.recip()));
            }
        }
    }
    let Some(whole) = power(2) else { return distinct([others].into_iter()) };
    shares.extend(cancelling(hamiltonian, &whole, dim));
    let shares = distinct(shares.into_iter()).into_iter().chain([Polynomial::zero(variables)]);
    distinct(shares.map(|share| &others + &(&share * &whole)))
}

/// The highest power of momenta in a polynomial.
fn degree(polynomial: &Polynomial, dim: usize) -> u32 {
    let momenta = |factors: &[(u32, u32)]| split_at(factors, dim).0.iter().map(|(_, e)| e).sum();
    polynomial.factors().map(|(factors, _)| momenta(&factors)).max().unwrap_or(0)
}

/// The multiples of a function that cancel one of its monomials in H.
fn multiples(hamiltonian: &Polynomial, function: &Polynomial, dim: usize) -> Vec<Polynomial> {
    if function.degree() < 2 {
        return Vec::new();
    }
    let shares = distinct(cancelling(hamiltonian, function, dim)).into_iter();
    shares.map(|share| &share * function).collect()
}

/// The factors by which each monomial of a function cancels that of H.
fn cancelling(
    hamiltonian: &Polynomial,
    function: &Polynomial,
    dim: usize,
) -> impl Iterator<Item = Polynomial> {
    function.factors().map(move |(monomial, value)| {
        let (momenta, _) = split_at(&monomial, dim);
        coefficient(hamiltonian, momenta, dim).scale(&value.recip())
    })
}

/// Drops zeros and repetitions.
fn distinct(candidates: impl Iterator<Item = Polynomial>) -> Vec<Polynomial> {
    let mut result: Vec<Polynomial> = Vec::new();
    for candidate in candidates {
        if !candidate.is_zero() && !result.contains(&candidate) {
            result.push(candidate);
        }
    }
    result
}

/// The coefficient of a monomial in the momenta, a polynomial in the symbols.
fn coefficient(hamiltonian: &Polynomial, momenta: &[(u32, u32)], dim: usize) -> Polynomial {
    let terms = hamiltonian.factors().filter_map(|(factors, value)| {
        let (own, symbols) = split_at(&factors, dim);
        (own == momenta).then(|| (symbols.to_vec(), value))
    });
    Polynomial::from_factors(hamiltonian.variables(), terms.collect::<Vec<_>>())
}

/// Coordinates of an element of the algebra.
pub(super) type Element = Vec<Rational>;

/// The terms ⟨μ, L⟩ of H that are linear in the momenta, for each product of symbols (variable, power).
type Linear = BTreeMap<Vec<(u32, u32)>, Element>;

/// A basis of the η ∈ 𝔤 for which ⟨μ, η⟩ is an integral of H, whatever values its symbols have, in reduced echelon form:
/// where a generator is such an η, it is in the basis. Empty where that is too much work to find.
pub(super) fn linear_integrals(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> Vec<Element> {
    let dim = algebra.dim();
    // Σ η_j μ̇_j = 0, monomial by monomial.
    let mut equations: BTreeMap<Vec<(u32, u32)>, BTreeMap<u32, Rational>> = BTreeMap::new();
    for (j, rate) in algebra.hamiltonian_field(hamiltonian).iter().enumerate() {
        for (factors, value) in rate.factors() {
            equations.entry(factors).or_default().insert(j as u32, value);
        }
    }
    let mut rows: Vec<_> = equations.into_values().collect();
    // Short equations first keep the others short.
    rows.sort_by_key(BTreeMap::len);
    null_space(rows, dim)
}

/// ⟨μ, η⟩ in this many variables.
pub(super) fn functional(variables: usize, element: &[Rational]) -> Polynomial {
    let terms = element.iter().enumerate().filter(|(_, value)| !value.is_zero());
    Polynomial::from_factors(
        variables,
        terms.map(|(i, value)| (vec![(i as u32, 1)], value.clone())),
    )
}

/// True if {H, f} = 0.
pub(super) fn commute(algebra: &LieAlgebra, hamiltonian: &Polynomial, f: &Polynomial) -> bool {
    let field = algebra.hamiltonian_field(hamiltonian);
    let slopes = f.gradient(algebra.dim());
    let zero = Polynomial::zero(hamiltonian.variables());
    let rate = slopes.iter().zip(&field).fold(zero, |sum, (slope, rate)| &sum + &(slope * rate));
    rate.is_zero()
}

/// The part ⟨μ, ξ⟩ of the linear terms of H that commutes with the rest of H; zero where there is none. Its flow is
/// exp(tξ), and only the rest is left to a series.
///
/// Of ⟨μ, L⟩, L = Σ σ L_σ with products σ of symbols, it takes for each σ the orthogonal projection of L_σ (in the
/// coordinates of the basis) onto the η for which ⟨μ, η⟩ commutes, where that makes the coordinates of L_σ smaller in sum.
/// A term that commutes with all of 𝔤 is left: the series is exact for it.
pub fn commuting_field(algebra: &LieAlgebra, hamiltonian: &Polynomial) -> Polynomial {
    let (dim, variables) = (algebra.dim(), hamiltonian.variables());
    let mut linear = Linear::new();
    let mut others = Vec::new();
    for (factors, value) in hamiltonian.factors() {
        match split_at(&factors, dim) {
            (&[(i, 1)], symbols) => {
                let zeros = || vec![Rational::zero(); dim];
                linear.entry(symbols.to_vec()).or_insert_with(zeros)[i as usize] = value;
            }
            _ => others.push((factors, value)),
        }
    }
    let moves = |element: &Element| algebra.structure().iter().any(|c| !element[c.i].is_zero());
    if !linear.values().any(moves) {
        return Polynomial::zero(variables);
    }
    // With all of L taken it is enough that each L_σ commutes with the other terms; a part of L must commute with L too.
    let others = Polynomial::from_factors(variables, others);
    let field = projected(algebra, &linear, linear_integrals(algebra, &others), variables);
    if field.is_zero() || commute(algebra, hamiltonian, &field) {
        return field;
    }
    projected(algebra, &linear, linear_integrals(algebra, hamiltonian), variables)
}

/// Σ σ ⟨μ, ξ_σ⟩ with the projections ξ_σ of the L_σ onto the span of `basis`.
fn projected(
    algebra: &LieAlgebra,
    linear: &Linear,
    basis: Vec<Element>,
    variables: usize,
) -> Polynomial {
    let basis = orthogonal(basis);
    let mut field = Polynomial::zero(variables);
    for (symbols, element) in linear {
        let mut rest = element.clone();
        remove(&mut rest, &basis);
        let taken: Element = element.iter().zip(&rest).map(|(all, rest)| all - rest).collect();
        let size = |element: &Element| element.iter().map(Rational::abs).sum::<Rational>();
        let taken = functional(variables, &taken);
        let central = algebra.hamiltonian_field(&taken).iter().all(Polynomial::is_zero);
        if size(&rest) < size(element) && !central {
            let product = [(symbols.clone(), Rational::one())];
            field = &field + &(&taken * &Polynomial::from_factors(variables, product));
        }
    }
    field
}

/// An orthogonal basis of the same span.
fn orthogonal(basis: Vec<Element>) -> Vec<Element> {
    let mut result: Vec<Element> = Vec::new();
    for mut element in basis {
        remove(&mut element, &result);
        result.push(element);
    }
    result
}

/// Takes the projections onto elements that are orthogonal to each other off an element.
fn remove(element: &mut Element, orthogonal: &[Element]) {
    let dot = |a: &Element, b: &Element| {
        let entries = a.iter().zip(b).filter(|(a, b)| !a.is_zero() && !b.is_zero());
        entries.map(|(a, b)| a * b).sum::<Rational>()
    };
    for other in orthogonal {
        let factor = dot(element, other) / dot(other, other);
        if factor.is_zero() {
            continue;
        }
        for (entry, value) in element.iter_mut().zip(other).filter(|(_, value)| !value.is_zero()) {
            *entry -= &factor * value;
        }
    }
}
