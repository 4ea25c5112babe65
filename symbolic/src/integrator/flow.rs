//! A first guess of x along the exact flow, by numbers instead of formulas.
//!
//! Written out as polynomials of μ′, the predictor grows fast with the dimension. Here the momentum's
//! Taylor coefficients along μ̇ = ad*_ω μ, ω = ∂H/∂μ, come from one another by their recurrence, as in
//! a Taylor integrator, and x = log of the increment from the moments of ω about the middle of the
//! step, by Magnus' series of order four, six or eight (Blanes, Casas and Ros, BIT 40, 2000, 434, and
//! BIT 42, 2002, 262). The work grows with the square of the degree and with the number of terms of H.

use std::collections::HashMap;

use num_traits::One;

use super::coefficients::{BaseTerm, Coefficients, Contribution};
use crate::graph::{Graph, Id, Program};
use crate::integrator::lower;
use crate::number::{Rational, ratio};
use crate::poly::Polynomial;
use crate::problem::Problem;

/// The degrees in h to which x can be had.
pub(crate) const DEGREES: [usize; 3] = [4, 6, 8];

/// μ′ ↦ x up to h^degree, degree four, six or eight.
pub(crate) fn increment_program(
    coefficients: &mut Coefficients,
    problem: &Problem,
    degree: usize,
) -> Program {
    let mut flow = Flow::new(coefficients, problem);
    flow.extend(degree - 1);
    let x = flow.increment(degree);
    flow.graph.finish(problem.algebra.dim(), &x)
}

/// ∫ (s − ½)ⁱ sᵏ ds from 0 to 1.
fn moment(i: u32, k: i64) -> Rational {
    let mut sum = ratio(0, 1);
    // (s − ½)ⁱ term by term: the coefficients of sʲ from that of sⁱ down.
    let mut binomial = ratio(1, 1);
    for j in (0..=i64::from(i)).rev() {
        sum += &binomial * ratio(1, k + j + 1);
        binomial *= ratio(-j, 2 * (i64::from(i) - j + 1));
    }
    sum
}

/// The share of sᵏ in a₁ = 9/4 B₀ − 15 B₂, the value of ω in the middle of the step.
fn a1(k: i64) -> Rational {
    ratio(9, 4) * moment(0, k) - ratio(15, 1) * moment(2, k)
}

/// The share of sᵏ in a₃ = 180 B₂ − 15 B₀, half the second derivative there.
fn a3(k: i64) -> Rational {
    ratio(180, 1) * moment(2, k) - ratio(15, 1) * moment(0, k)
}

/// Power series in the time over the step, s from 0 to 1, as nodes of a graph.
struct Flow<'a> {
    coefficients: &'a mut Coefficients,
    problem: &'a Problem,
    graph: Graph,
    /// The coefficients of sᵏ in each coordinate of μ: `[order][coordinate]`.
    momenta: Vec<Vec<Id>>,
    /// The coefficients of the monomials met so far.
    products: HashMap<(Vec<u32>, usize), Id>,
    /// Slots of plain numbers.
    numbers: HashMap<Rational, usize>,
}

impl<'a> Flow<'a> {
    fn new(coefficients: &'a mut Coefficients, problem: &'a Problem) -> Self {
        let graph = Graph::new();
        let inputs = (0..problem.algebra.dim()).map(|i| graph.input(i)).collect();
        let (products, numbers) = (HashMap::new(), HashMap::new());
        Self { coefficients, problem, graph, momenta: vec![inputs], products, numbers }
    }

    /// The momentum's coefficients up to s^highest.
    fn extend(&mut self, highest: usize) {
        let problem = self.problem;
        let field = problem.algebra.hamiltonian_field(problem.generated());
        for order in self.momenta.len()..=highest {
            let share = ratio(1, order as i64);
            let rates: Vec<Id> = field
                .iter()
                .map(|rate| {
                    let terms = self.collect(1, &rate.scale(&share));
                    self.evaluate(&terms, order - 1)
                })
                .collect();
            self.momenta.push(rates);
        }
    }

    /// x up to h^degree.
    fn increment(&mut self, degree: usize) -> Vec<Id> {
        let hamiltonian = self.problem.generated();
        let omega = hamiltonian.gradient(self.problem.algebra.dim());
        let jets: Vec<Vec<Id>> = omega
            .iter()
            .map(|rate| {
                let terms = self.collect(1, rate);
                (0..degree).map(|order| self.evaluate(&terms, order)).collect()
            })
            .collect();
        match degree {
            ..6 => self.fourth_order(&jets),
            6..8 => self.sixth_order(&jets),
            8.. => self.eighth_order(&jets),
        }
    }

    /// The terms of h^power · polynomial.
    fn collect(&mut self, power: u32, polynomial: &Polynomial) -> Vec<BaseTerm> {
        lower::collect(self.coefficients, self.problem.algebra.dim(), [(power, polynomial)])
    }

    /// The coefficient of sᵏ in a polynomial of the momenta.
    fn evaluate(&mut self, terms: &[BaseTerm], order: usize) -> Id {
        let mut sum = self.graph.zero();
        for term in terms {
            let slot = self.coefficients.slot(term.base, 1);
            let slot = self.graph.slot(slot);
            let variables: Vec<u32> =
                term.factors.iter().flat_map(|&(v, e)| (0..e).map(move |_| v)).collect();
            if variables.is_empty() {
                if order == 0 {
                    sum = self.graph.add(sum, slot);
                }
                continue;
            }
            let product = self.product(&variables, order);
            sum = self.graph.times_plus(slot, product, sum);
        }
        sum
    }

    /// The coefficient of sᵏ in the product of the given momenta, which are ascending.
    fn product(&mut self, variables: &[u32], order: usize) -> Id {
        let Some((&last, rest)) = variables.split_last() else { return self.graph.zero() };
        if rest.is_empty() {
            return self.momenta[order][last as usize];
        }
        let key = (variables.to_vec(), order);
        if let Some(&known) = self.products.get(&key) {
            return known;
        }
        // In a square every product occurs twice but the one in the middle.
        let square = rest == [last];
        let pairs = if square { order.div_ceil(2) } else { order + 1 };
        let mut sum = self.graph.zero();
        for i in 0..pairs {
            let left = self.product(rest, i);
            let right = self.momenta[order - i][last as usize];
            sum = self.graph.times_plus(left, right, sum);
        }
        if square {
            sum = self.graph.add(sum, sum);
            if order.is_multiple_of(2) {
                let middle = self.momenta[order / 2][last as usize];
                sum = self.graph.times_plus(middle, middle, sum);
            }
        }
        self.products.insert(key, sum);
        sum
    }

    /// A plain number as a node.
    fn number(&mut self, value: Rational) -> Id {
        let slot = match self.numbers.get(&value) {
            Some(&slot) => slot,
            None => {
                let symbol_powers = vec![0; self.problem.symbols.len()];
                let factor = value.clone();
                let number = Contribution { factor, step_power: 0, symbol_powers };
                let base = self.coefficients.add_base(vec![number]);
                let slot = self.coefficients.slot(base, 1);
                self.numbers.insert(value, slot);
                slot
            }
        };
        self.graph.slot(slot)
    }

    /// Σₖ weight(k) · jetₖ, one for each coordinate.
    fn combine(&mut self, jets: &[Vec<Id>], weight: impl Fn(i64) -> Rational) -> Vec<Id> {
        let zero = self.graph.zero();
        jets.iter()
            .map(|jet| {
                let mut sum = zero;
                for (k, &coefficient) in jet.iter().enumerate() {
                    let weight = weight(k as i64);
                    if coefficient == zero || weight == ratio(0, 1) {
                        continue;
                    }
                    let weight = self.number(weight);
                    sum = self.graph.times_plus(weight, coefficient, sum);
                }
                sum
            })
            .collect()
    }

    /// a + Σ factorᵢ bᵢ
    fn add(&mut self, a: &[Id], others: &[(Rational, &[Id])]) -> Vec<Id> {
        let mut sum = a.to_vec();
        for (factor, b) in others {
            let one = factor.is_one();
            for (sum, &b) in sum.iter_mut().zip(*b) {
                *sum = if one {
                    self.graph.add(*sum, b)
                } else {
                    let factor = self.number(factor.clone());
                    self.graph.times_plus(factor, b, *sum)
                };
            }
        }
        sum
    }

    /// factor · \[a, b\]
    fn bracket(&mut self, factor: &Rational, a: &[Id], b: &[Id]) -> Vec<Id> {
        let mut result = vec![self.graph.zero(); a.len()];
        let problem = self.problem;
        for constant in problem.algebra.structure() {
            let value = factor * &constant.value;
            let left = if value.is_one() {
                a[constant.i]
            } else {
                let value = self.number(value);
                self.graph.mul(value, a[constant.i])
            };
            let sum = result[constant.k];
            result[constant.k] = self.graph.times_plus(left, b[constant.j], sum);
        }
        result
    }

    /// x = B₀ + \[B₀, B₁\], Bᵢ = ∫ (s − ½)ⁱ ω ds. For ġ = gω brackets of an even number of factors
    /// change sign against the formulas for ẏ = ωy.
    fn fourth_order(&mut self, jets: &[Vec<Id>]) -> Vec<Id> {
        let b0 = self.combine(jets, |k| moment(0, k));
        let b1 = self.combine(jets, |k| moment(1, k));
        let turn = self.bracket(&ratio(1, 1), &b0, &b1);
        self.add(&b0, &[(ratio(1, 1), &turn)])
    }

    /// x = a₁ + a₃/12 + \[20a₁ + a₃ + c, a₂ + \[a₁, 2a₃ − c\]/60\]/240, c = \[a₁, a₂\], with
    /// a₁ = 9/4 B₀ − 15 B₂, a₂ = 12 B₁, a₃ = 180 B₂ − 15 B₀.
    fn sixth_order(&mut self, jets: &[Vec<Id>]) -> Vec<Id> {
        let straight = self.combine(jets, |k| moment(0, k));
        let outer = self.combine(jets, |k| ratio(20, 1) * a1(k) + a3(k));
        let a1 = self.combine(jets, a1);
        let a2 = self.combine(jets, |k| ratio(12, 1) * moment(1, k));
        let twice_a3 = self.combine(jets, |k| ratio(2, 1) * a3(k));
        let c = self.bracket(&ratio(1, 1), &a1, &a2);
        let inner = self.add(&twice_a3, &[(ratio(-1, 1), &c)]);
        let inner = self.bracket(&ratio(1, 60), &a1, &inner);
        let inner = self.add(&a2, &[(ratio(1, 1), &inner)]);
        let outer = self.add(&outer, &[(ratio(1, 1), &c)]);
        let turn = self.bracket(&ratio(1, 240), &outer, &inner);
        self.add(&straight, &[(ratio(1, 1), &turn)])
    }

    /// With a₁, a₃ as above, a₂ = 75 B₁ − 420 B₃ and a₄ = 2800 B₃ − 420 B₁, and {a, b} = −\[a, b\]:
    /// s₁ = −{u, v}/28, u = a₁ + a₃/28, v = a₂ + 3a₄/28; r₁ = {a₁, s₁ − a₃/14}/3;
    /// s₂ = {u + s₁, v + r₁}; r₂ = {a₁ + 5s₁/4, 2a₃ + s₂ + {a₂, s₁}/2};
    /// s₃ = {B₀ − 7s₁/3 − s₂/6, 63r₁ + r₂ − 9a₂ − 9a₄/4}; x = B₀ − 7s₂/120 + s₃/360.
    fn eighth_order(&mut self, jets: &[Vec<Id>]) -> Vec<Id> {
        let one = || ratio(1, 1);
        let a2 = |k| ratio(75, 1) * moment(1, k) - ratio(420, 1) * moment(3, k);
        let a4 = |k| ratio(2800, 1) * moment(3, k) - ratio(420, 1) * moment(1, k);
        let straight = self.combine(jets, |k| moment(0, k));
        let u = self.combine(jets, |k| a1(k) + a3(k) / ratio(28, 1));
        let v = self.combine(jets, |k| a2(k) + ratio(3, 28) * a4(k));
        let last = self.combine(jets, |k| ratio(-9, 1) * a2(k) - ratio(9, 4) * a4(k));
        let first = self.combine(jets, a1);
        let second = self.combine(jets, a2);
        let third = self.combine(jets, a3);

        let s1 = self.bracket(&ratio(1, 28), &u, &v);
        let r1 = self.add(&s1, &[(ratio(-1, 14), &third)]);
        let r1 = self.bracket(&ratio(-1, 3), &first, &r1);
        let (left, right) = (self.add(&u, &[(one(), &s1)]), self.add(&v, &[(one(), &r1)]));
        let s2 = self.bracket(&ratio(-1, 1), &left, &right);
        let inner = self.bracket(&ratio(-1, 2), &second, &s1);
        let left = self.add(&first, &[(ratio(5, 4), &s1)]);
        let right = self.add(&s2, &[(ratio(2, 1), &third), (one(), &inner)]);
        let r2 = self.bracket(&ratio(-1, 1), &left, &right);
        let left = self.add(&straight, &[(ratio(-7, 3), &s1), (ratio(-1, 6), &s2)]);
        let right = self.add(&last, &[(ratio(63, 1), &r1), (one(), &r2)]);
        let s3 = self.bracket(&ratio(-1, 360), &left, &right);
        self.add(&straight, &[(ratio(-7, 120), &s2), (one(), &s3)])
    }
}
