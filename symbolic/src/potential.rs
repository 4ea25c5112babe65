//! Potentials V(g), functions of the matrix entries of the group element, and what follows from
//! them: the body torque −g⁻¹dV(g), the symmetry that is left, the Casimirs that survive. A torque may also have no potential.

use std::collections::BTreeMap;

use coadjoint_program::{Graph, Id, Program};
use num_traits::{ToPrimitive, Zero};

use crate::lie::{LieAlgebra, RationalMatrix, null_space};
use crate::number::{Rational, integer};
use crate::poly::{Numeric, Polynomial};
use crate::problem::{Parameter, Symbol, values};

/// A force, as its kicks are made.
#[derive(Clone, Debug)]
pub enum Force {
    /// The torque of a potential V, a polynomial over ℚ in the entries of the group element's matrix, row by row (the first
    /// `size`² variables), and the [`Symbol`]s (the variables after them).
    Polynomial(Polynomial),
    /// The torque of another smooth potential, or one without potential.
    Smooth(Box<Programs>),
}

/// A force as programs.
///
/// Their inputs are the entries of the group element's matrix, row by row; without a potential they are those of a
/// [`Drive`](crate::drive::Drive). Their slots are the [`Symbol`]s.
#[derive(Clone, Debug)]
pub struct Programs {
    /// V, where the torque has a potential.
    pub value: Option<Program>,
    /// The body torque.
    pub torque: Program,
    /// For each of the expressions watched two outputs: its argument, and a number that is finite where the expression
    /// is differentiable in it.
    pub watched: Program,
    /// The texts of the expressions watched.
    pub expressions: Vec<String>,
}

impl Programs {
    /// Of a potential, by programs for V, its derivatives in the entries, and what is watched, whose inputs are the entries, the time
    /// and signals. Where it depends on the time its programs have all of these inputs, and there is no value that is conserved.
    pub fn of_potential(
        algebra: &LieAlgebra,
        [value, gradient, watched]: [&Program; 3],
        expressions: Vec<String>,
        moves: bool,
    ) -> Self {
        let entries = algebra.matrix_size().pow(2);
        let count = if moves { gradient.inputs() } else { entries };
        let by = |outputs: &dyn Fn(&Graph, &[Id]) -> Vec<Id>| {
            let graph = Graph::new();
            let mut inputs: Vec<Id> = (0..count).map(|at| graph.input(at)).collect();
            inputs.resize(gradient.inputs().max(entries + 1), graph.zero());
            graph.finish(count, &outputs(&graph, &inputs))
        };
        let torque = by(&|graph, inputs| {
            let slopes = graph.call(gradient, inputs);
            along(graph, algebra, -1.0, [&inputs[..entries], &slopes])
        });
        let value = (!moves).then(|| by(&|graph, inputs| graph.call(value, inputs)));
        let watched = by(&|graph, inputs| graph.call(watched, inputs));
        Self { value, torque, watched, expressions }
    }

    /// The text of the first expression that is not defined for these inputs, and its argument there.
    pub fn undefined(&self, inputs: &[f64], symbols: &[f64]) -> Option<(&str, f64)> {
        let (number, argument) = undefined(&self.watched.run(inputs, symbols))?;
        Some((&self.expressions[number], argument))
    }
}

/// The derivatives of a function of the matrix of g by ε in g exp(ε e), for each e of the basis, times a factor; by the entries of g and
/// the slopes in them, row by row.
pub(crate) fn along(
    graph: &Graph,
    algebra: &LieAlgebra,
    factor: f64,
    [g, slopes]: [&[Id]; 2],
) -> Vec<Id> {
    let size = algebra.matrix_size();
    // (g e)_ij = Σ_l g_il e_lj.
    let along = |e: &RationalMatrix| {
        let mut sum = graph.zero();
        for (l, j, value) in e.entries() {
            let factor = graph.constant(factor * value.to_f64().unwrap_or(f64::NAN));
            for i in 0..size {
                let scaled = graph.mul(factor, g[i * size + l]);
                sum = graph.times_plus(scaled, slopes[i * size + j], sum);
            }
        }
        sum
    };
    algebra.matrices().iter().map(along).collect()
}

/// The first expression that is not defined, or has no derivative, by its number, and its argument, from the outputs of
/// [`Programs::watched`].
pub(crate) fn undefined(watched: &[f64]) -> Option<(usize, f64)> {
    let (pairs, _) = watched.as_chunks::<2>();
    let found =
        pairs.iter().position(|[argument, test]| argument.is_finite() && !test.is_finite())?;
    Some((found, pairs[found][0]))
}

/// A potential on a Lie group, or a torque without one.
///
/// The matrix of a group element is that of the algebra's basis, or the adjoint matrix where only brackets are known.
#[derive(Clone, Debug)]
pub struct Potential {
    /// The name of the potential.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: LieAlgebra,
    /// V, or the torque.
    pub force: Force,
    /// The opaque coefficients of the force.
    pub symbols: Vec<Symbol>,
    /// The parameters the symbols are made of.
    pub parameters: Vec<Parameter>,
    /// The potential as the user wrote it.
    pub source: String,
}

impl Potential {
    /// The size d of group elements, which are d × d matrices.
    pub fn size(&self) -> usize {
        self.algebra.matrix_size()
    }

    /// The torque without potential, where it is one.
    pub fn alone(&self) -> Option<&Programs> {
        match &self.force {
            Force::Smooth(programs) if programs.value.is_none() => Some(programs),
            _ => None,
        }
    }

    /// The body torque of a polynomial V: component k is −d/ds V(g·exp(s e_k)) at s = 0, which is
    /// −Σ ∂V/∂g_ij (g e_k)_ij.
    pub fn torque(&self, energy: &Polynomial) -> Vec<Polynomial> {
        // (g e)_ij = Σ_l g_il e_lj.
        let motion = |e: &RationalMatrix, i: usize, j: usize| {
            let column = e.entries().filter(|&(_, c, _)| c == j);
            column.map(|(l, _, value)| ((i, l), -value.clone())).collect()
        };
        self.algebra.matrices().iter().map(|e| self.along(energy, |i, j| motion(e, i, j))).collect()
    }

    /// Σ ∂V/∂g_ij m_ij with m_ij linear in g, given by its terms ((row, column), coefficient).
    fn along(
        &self,
        energy: &Polynomial,
        motion: impl Fn(usize, usize) -> Vec<((usize, usize), Rational)>,
    ) -> Polynomial {
        let size = self.size();
        let mut terms = Vec::new();
        for (exponents, value) in energy.terms() {
            // A variable is an entry of the matrix, number row · size + column.
            for at in (0..size * size).filter(|&at| exponents[at] > 0) {
                for ((row, column), by) in motion(at / size, at % size) {
                    let mut exponents = exponents.clone();
                    let power = integer(i64::from(exponents[at]));
                    exponents[at] -= 1;
                    exponents[row * size + column] += 1;
                    terms.push((exponents, &value * power * by));
                }
            }
        }
        Polynomial::from_terms(energy.variables(), terms)
    }
}

/// Multiplications in making elements at most.
const OPERATIONS: usize = 100_000_000;
/// The size of rounding in sums that vanish, relative to their terms.
const ROUNDING: f64 = 1e-10;
/// Terms of an exponential.
const TERMS: usize = 30;

impl Potential {
    /// A basis of the ξ ∈ 𝔤 with ⟨J_L, ξ⟩ conserved, their largest coordinate being 1: of a polynomial exactly, of another V by
    /// its formula, and so of a torque without potential.
    pub(crate) fn directions(&self) -> Vec<Vec<f64>> {
        let found = match &self.force {
            Force::Polynomial(energy) => {
                let float = |x: &Rational| x.to_f64().unwrap_or(f64::NAN);
                self.symmetries(energy).iter().map(|xi| xi.iter().map(float).collect()).collect()
            }
            Force::Smooth(programs) => self.level(programs),
        };
        let scaled = |xi: Vec<f64>| {
            let size = xi.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            xi.iter().map(|x| x / size).collect()
        };
        found.into_iter().map(scaled).collect()
    }

    /// A basis of the ξ ∈ 𝔤 with V(exp(sξ)g) = V(g), found as polynomials in the entries of any
    /// matrix g: by Noether's theorem ⟨J_L, ξ⟩ is conserved, by kicks exactly. Symmetries that
    /// rest on relations between the entries, such as orthogonality, are not found.
    pub fn symmetries(&self, energy: &Polynomial) -> Vec<Vec<Rational>> {
        // (e g)_ij = Σ_l e_il g_lj.
        let motion = |e: &RationalMatrix, i: usize, j: usize| {
            let row = e.entries().filter(|&(r, _, _)| r == i);
            row.map(|(_, l, value)| ((l, j), value.clone())).collect()
        };
        let slopes: Vec<Polynomial> = self
            .algebra
            .matrices()
            .iter()
            .map(|e| self.along(energy, |i, j| motion(e, i, j)))
            .collect();
        let mut rows: BTreeMap<Vec<u32>, BTreeMap<u32, Rational>> = BTreeMap::new();
        for (k, slope) in slopes.iter().enumerate() {
            for (exponents, value) in slope.terms() {
                rows.entry(exponents).or_default().insert(k as u32, value);
            }
        }
        null_space(rows.into_values(), slopes.len())
    }

    /// True if kicks conserve this function C of the momentum: Σ_k ∂C/∂μ_k τ_k = 0 for all μ and g, with the body torque τ.
    /// A torque that is no polynomial is judged by its formula.
    pub fn keeps(&self, casimir: &Polynomial) -> bool {
        let torque = match &self.force {
            Force::Polynomial(energy) => self.torque(energy),
            Force::Smooth(programs) => return self.seems_to_keep(programs, casimir),
        };
        let mut sums: BTreeMap<(Vec<u32>, Vec<u32>), Rational> = BTreeMap::new();
        for (k, torque) in torque.iter().enumerate() {
            for (mu, slope) in casimir.derivative(k).terms() {
                for (g, value) in torque.terms() {
                    *sums.entry((mu.clone(), g)).or_insert_with(|| integer(0)) += &slope * value;
                }
            }
        }
        sums.values().all(Zero::is_zero)
    }

    /// The ξ along which no torque acts, ⟨τ, Ad_{g⁻¹} ξ⟩ = 0, whatever values its functions have: an identity of its formula, tested
    /// at random elements and values (J. T. Schwartz, J. ACM 27 (1980) 701). So a force that is next to nothing almost everywhere
    /// is seen as well as any other.
    fn level(&self, programs: &Programs) -> Vec<Vec<f64>> {
        let (n, size, generators) = (self.algebra.dim(), self.size(), self.generators());
        // Of a group whose elements would take long, the dual basis would too.
        let elements = self.elements(&generators, 2 * n + 5);
        if elements.is_empty() {
            return Vec::new();
        }
        let Some(dual) = self.algebra.dual_matrices() else { return Vec::new() };
        let dual: Vec<Vec<f64>> = dual.iter().map(|matrix| dense(matrix, size)).collect();
        let torque = programs.torque.with_open_functions();
        let (symbols, mut random) = (values(&self.symbols), random());
        // For each e relative to the largest sum of the terms' sizes.
        let row = |[g, back]: [Vec<f64>; 2]| -> Vec<f64> {
            let inputs = self.inputs(programs, g.clone(), &mut random);
            let torque = torque.run(&opened(inputs, &torque, &mut random), &symbols);
            let along = |e: &Vec<f64>| {
                let turned = product(&back, &product(e, &g, size), size);
                let entry = |dual: &Vec<f64>| dual.iter().zip(&turned).map(|(a, b)| a * b).sum();
                let terms = dual.iter().map(entry).zip(&torque).map(|(a, b): (f64, _)| a * b);
                terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()))
            };
            let sums: Vec<(f64, f64)> = generators.iter().map(along).collect();
            let most = sums.iter().fold(0.0_f64, |most, (_, size)| most.max(*size));
            let scale = if most == 0.0 { 1.0 } else { most };
            sums.iter().map(|(sum, _)| sum / scale).collect()
        };
        let rows = elements.into_iter().map(row);
        let rows: Vec<Vec<f64>> = rows.filter(|row| row.iter().all(|x| x.is_finite())).collect();
        if rows.len() < n + 2 { Vec::new() } else { kernel(rows, n) }
    }

    /// Inputs of the programs of a force at this element, whatever else they read being random.
    fn inputs(
        &self,
        programs: &Programs,
        g: Vec<f64>,
        random: &mut impl FnMut() -> f64,
    ) -> Vec<f64> {
        let (mut inputs, count) = (g, programs.torque.inputs());
        inputs.truncate(count);
        inputs.resize_with(count, random);
        inputs
    }

    /// The sum Σ_k ∂C/∂μ_k τ_k vanishes whatever values the functions in τ have, as in [`Self::level`].
    fn seems_to_keep(&self, programs: &Programs, casimir: &Polynomial) -> bool {
        let (n, generators, symbols) =
            (self.algebra.dim(), self.generators(), values(&self.symbols));
        let slopes: Vec<Numeric> =
            (0..n).map(|k| Numeric::new(&casimir.derivative(k), n, &[])).collect();
        let torque = programs.torque.with_open_functions();
        let mut random = random();
        let mut tried = 0;
        for [g, _] in self.elements(&generators, n + 5) {
            let mu: Vec<f64> = (0..n).map(|_| random()).collect();
            let inputs = self.inputs(programs, [g, mu.clone()].concat(), &mut random);
            let torque = torque.run(&opened(inputs, &torque, &mut random), &symbols);
            let terms = slopes.iter().zip(&torque).map(|(slope, torque)| slope.value(&mu) * torque);
            let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
            if sum.is_finite() && sum.abs() > ROUNDING * size {
                return false;
            }
            tried += usize::from(sum.is_finite());
        }
        tried > n
    }

    fn generators(&self) -> Vec<Vec<f64>> {
        self.algebra.matrices().iter().map(|e| dense(e, self.size())).collect()
    }

    /// Random elements of the group and their inverses, row by row; none where they would take long.
    fn elements(&self, generators: &[Vec<f64>], count: usize) -> Vec<[Vec<f64>; 2]> {
        let size = self.size();
        let places = (0..size * size).filter(|&at| generators.iter().any(|e| e[at] != 0.0));
        if count * TERMS * size * places.count() > OPERATIONS {
            return Vec::new();
        }
        let mut random = random();
        let one: Vec<f64> =
            (0..size * size).map(|at| f64::from(u8::from(at / size == at % size))).collect();
        let mut element = || {
            let mut x = vec![0.0; size * size];
            for e in generators {
                let factor = random();
                x.iter_mut().zip(e).for_each(|(x, e)| *x += factor * e);
            }
            // 1 + x (1 + x/2 (1 + x/3 (…)))
            [1.0, -1.0].map(|sign| {
                (1..=TERMS).rev().fold(one.clone(), |sum, k| {
                    let next = product(&x, &sum, size);
                    next.iter().zip(&one).map(|(next, one)| one + sign * next / k as f64).collect()
                })
            })
        };
        (0..count).map(|_| element()).collect()
    }
}

/// A matrix row by row.
fn dense(matrix: &RationalMatrix, size: usize) -> Vec<f64> {
    let mut entries = vec![0.0; size * size];
    for (i, j, value) in matrix.entries() {
        entries[i * size + j] = value.to_f64().unwrap_or(f64::NAN);
    }
    entries
}

/// The product of two square matrices, row by row, the first of which has few entries.
fn product(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let mut product = vec![0.0; size * size];
    for (at, factor) in a.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
        let from = &b[at % size * size..][..size];
        let row = &mut product[at / size * size..][..size];
        row.iter_mut().zip(from).for_each(|(sum, x)| *sum += factor * x);
    }
    product
}

/// The inputs of a program whose functions are [open](Program::with_open_functions): those of the formula, and values of all
/// sizes from 1/1000 to 1000, so that each term is the largest somewhere.
fn opened(mut inputs: Vec<f64>, program: &Program, random: &mut impl FnMut() -> f64) -> Vec<f64> {
    let open = program.inputs().saturating_sub(inputs.len());
    inputs.extend((0..open).map(|_| (10.0 * random()).exp2()));
    inputs
}

/// Numbers between −1 and 1, the same at every call (D. E. Knuth's linear congruences, MMIX).
fn random() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((state >> 32) as u32) / f64::from(1_u32 << 31) - 1.0
    }
}

/// A basis of the vectors of `n` coordinates that all rows take to zero, but for rounding.
fn kernel(mut rows: Vec<Vec<f64>>, n: usize) -> Vec<Vec<f64>> {
    let largest = |rows: &[Vec<f64>]| rows.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let scale = largest(&rows);
    let mut pivots: Vec<usize> = Vec::new();
    loop {
        let done = pivots.len();
        let places = (done..rows.len()).flat_map(|i| (0..n).map(move |j| (i, j)));
        let size = |&(i, j): &(usize, usize)| rows[i][j].abs();
        let place = places.max_by(|a, b| size(a).total_cmp(&size(b)));
        let Some((i, j)) = place.filter(|place| size(place) > ROUNDING * scale) else { break };
        rows.swap(done, i);
        let pivot: Vec<f64> = rows[done].iter().map(|x| x / rows[done][j]).collect();
        for (other, row) in rows.iter_mut().enumerate() {
            let factor = row[j];
            match other == done {
                true => row.clone_from(&pivot),
                false => row.iter_mut().zip(&pivot).for_each(|(x, pivot)| *x -= factor * pivot),
            }
            if other != done {
                row[j] = 0.0;
            }
        }
        pivots.push(j);
    }
    let free = (0..n).filter(|j| !pivots.contains(j));
    let vector = |j: usize| {
        let mut vector = vec![0.0; n];
        vector[j] = 1.0;
        pivots.iter().zip(&rows).for_each(|(&pivot, row)| vector[pivot] = -row[j]);
        vector
    };
    free.map(vector).collect()
}
