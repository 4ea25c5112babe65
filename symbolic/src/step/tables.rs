//! Any group by its structure constants and the matrices of its basis; elements as matrices, row by row.

use coadjoint_geometry::bernoulli::BETA;

use crate::graph::{Graph, Id};
use crate::lie::{Chart, LieAlgebra, RationalMatrix};
use crate::number::nearest_float;
use crate::step::MOST_OF_TABLES;
use crate::step::product::{Moved, Part};
use crate::step::vector::{Matrix, finite, largest, solve};

/// The norm of ad_x and of the matrix of x up to which series are exact to rounding: up to it steps are accepted at once.
const REACH: f64 = std::f64::consts::FRAC_PI_2;

/// The exponential of a comoving frame's motion y is that of y·2^−SQUARINGS, squared as often: up to a norm of y of
/// [`FARTHEST`] the truncated series of 10 terms is exact to rounding. Beyond, the motion is not finite, which is refused.
const SQUARINGS: i32 = 23;
const TERMS: i32 = 10;
const FARTHEST: f64 = (1 << (SQUARINGS - 3)) as f64;

/// The truncation allowed in series: below rounding.
const ROUNDING: f64 = 1e-17;

/// The entries of a matrix that are not 0, as (row, column, value).
type Entries = Vec<(usize, usize, f64)>;

/// (i, j, k, cᵢⱼᵏ), both orders of a bracket one after the other.
pub(crate) type Structure = Vec<(usize, usize, usize, f64)>;

/// A group by tables.
#[derive(Clone, Debug)]
pub(crate) struct Tables {
    chart: Chart,
    dim: usize,
    size: usize,
    structure: Structure,
    /// The matrices of the basis, as entries.
    basis: Vec<Entries>,
    /// Matrices Dₖ with ⟨Dₖ, Eₗ⟩ = δₖₗ; none for adjoint matrices in the exponential chart, which need none.
    dual: Vec<Entries>,
    /// The truncation allowed in the derivative of φ.
    slope: f64,
    /// True if elements are orthogonal matrices.
    orthogonal: bool,
}

/// The structure constants that are not 0.
pub(crate) fn structure_of(algebra: &LieAlgebra) -> Structure {
    let mut structure = algebra.constants();
    structure.sort_by_key(|&(i, j, k, _)| (i.min(j), i.max(j), k, i));
    structure
}

impl Tables {
    /// The group of this algebra, of whose derivatives as much as `slope` may be left out. `None` where its matrices are
    /// not linearly independent.
    pub(crate) fn new(algebra: &LieAlgebra, chart: Chart, slope: f64) -> Option<Self> {
        let dim = algebra.dim();
        let structure = structure_of(algebra);
        let matrices = algebra.matrices();
        let size = algebra.matrix_size();
        let entries = |matrix: &RationalMatrix| {
            let entries = matrix.entries().map(|(i, j, value)| (i, j, nearest_float(value)));
            entries.filter(|entry| entry.2 != 0.0).collect::<Vec<_>>()
        };
        let basis = matrices.iter().map(entries).collect();
        let dual = match (chart, algebra.basis()) {
            (Chart::Exponential, None) => Vec::new(),
            _ => algebra.dual_matrices()?.iter().map(entries).collect(),
        };
        let orthogonal = matrices.iter().all(RationalMatrix::is_antisymmetric);
        Some(Self { chart, dim, size, structure, basis, dual, slope, orthogonal })
    }

    /// The rows of its matrices.
    pub(crate) fn rows(&self) -> usize {
        self.size
    }

    /// About the operations of its formulas in a step, at most; with the derivative of the chart, or without.
    pub(crate) fn operations(&self, derivative: bool) -> usize {
        let (n, brackets) = (self.dim, self.structure.len());
        let product = self.size.saturating_pow(3);
        let each = match (self.chart, derivative) {
            (Chart::Exponential, true) => (n + 1) * brackets * terms(REACH, ROUNDING),
            (Chart::Exponential, false) => 2 * brackets * terms(REACH, ROUNDING),
            (Chart::Cayley, true) => (4 * n).saturating_mul(product),
            (Chart::Cayley, false) => product,
        };
        // The matrices of an increment and of a state, and elimination.
        let solve = if derivative { 2 * n.pow(3) } else { 0 };
        product.saturating_mul(16).saturating_add(each).saturating_add(solve)
    }

    /// ad_xᵀ as a matrix.
    fn ad_transpose(&self, graph: &Graph, x: &[Id]) -> Matrix {
        let mut matrix = Matrix::zeros(graph, self.dim, self.dim);
        for &(i, j, k, c) in &self.structure {
            matrix.set(j, k, graph.times_plus(graph.constant(c), x[i], matrix.at(j, k)));
        }
        matrix
    }

    /// Entry (j, i): Σₖ cᵢⱼᵏ vₖ, the derivative of ad_xᵀ v in x.
    fn ad_slope(&self, graph: &Graph, v: &[Id]) -> Matrix {
        let mut matrix = Matrix::zeros(graph, self.dim, self.dim);
        for &(i, j, k, c) in &self.structure {
            matrix.set(j, i, graph.times_plus(graph.constant(c), v[k], matrix.at(j, i)));
        }
        matrix
    }

    /// Σ weightᵢ · matrixᵢ, the matrices given by their entries.
    fn combine(&self, graph: &Graph, matrices: &[Entries], weights: &[Id]) -> Matrix {
        let mut sum = Matrix::zeros(graph, self.size, self.size);
        for (entries, &weight) in matrices.iter().zip(weights) {
            for &(i, j, value) in entries {
                sum.set(i, j, graph.times_plus(graph.constant(value), weight, sum.at(i, j)));
            }
        }
        sum
    }

    /// The matrix of x.
    fn represent(&self, graph: &Graph, x: &[Id]) -> Matrix {
        self.combine(graph, &self.basis, x)
    }

    /// φ(A)μ with φ(A) = (exp A − 1)/A, A = ad_xᵀ, by its Taylor series, and its derivative in x by this many terms.
    fn phi(&self, graph: &Graph, x: &[Id], mu: &[Id], slopes: usize) -> (Vec<Id>, Matrix) {
        let (a, one) = (self.ad_transpose(graph, x), graph.constant(1.0));
        let (mut term, mut sum) = (mu.to_vec(), mu.to_vec());
        let mut slope = Matrix::zeros(graph, self.dim, self.dim);
        let mut derivative = slope.clone();
        for k in 1..=terms(REACH, ROUNDING) {
            let factor = graph.constant(1.0 / (k + 1) as f64);
            if k <= slopes {
                let both = a.times_plus(graph, &slope, &self.ad_slope(graph, &term));
                slope = both.scaled(graph, factor);
                derivative = derivative.plus(graph, one, &slope);
            }
            term = a.apply(graph, &term).iter().map(|&entry| graph.mul(entry, factor)).collect();
            let ended = term.iter().all(|&entry| graph.is_zero(entry));
            if ended && (k >= slopes || slope.is_zero(graph)) {
                break;
            }
            sum = sum.iter().zip(&term).map(|(&a, &b)| graph.add(a, b)).collect();
        }
        (sum, derivative)
    }

    /// exp X by its Taylor series in powers of a power (M. Paterson and L. Stockmeyer, SIAM J. Comput. 2, 1973).
    fn exponential(&self, graph: &Graph, x: &Matrix) -> Matrix {
        let degree = terms(REACH, ROUNDING) + 1;
        let stride = (degree as f64).sqrt().round() as usize;
        let mut powers = vec![Matrix::identity(graph, self.size), x.clone()];
        while powers.len() <= stride {
            powers.push(powers[powers.len() - 1].times(graph, x));
        }
        let mut sum = Matrix::zeros(graph, self.size, self.size);
        for block in (0..=degree / stride).rev() {
            sum = sum.times(graph, &powers[stride]);
            // Small coefficients first.
            for (i, power) in powers[..stride].iter().enumerate().rev() {
                let inverse = 1.0 / factorial(block * stride + i);
                sum = sum.plus(graph, graph.constant(inverse), power);
            }
        }
        sum
    }

    /// exp X − 1 for X of any norm up to [`FARTHEST`], by scaling and squaring (N. Higham, *Functions of Matrices*, SIAM
    /// 2008, chapter 10). Without the identity, (1 + E)² − 1 = 2E + E², no digits of a short X are lost.
    fn exponential_less_one(&self, graph: &Graph, x: &Matrix) -> Matrix {
        self.exponential_with(graph, x, None).0
    }

    /// With (exp X − 1)/X applied to a vector, where there is one: of 2X it is 1 + ½E times that of X.
    fn exponential_with(&self, graph: &Graph, x: &Matrix, v: Option<&[Id]>) -> (Matrix, Vec<Id>) {
        let norm = row_norm(graph, x);
        let (most, scale) = (graph.constant(FARTHEST), graph.constant(0.5_f64.powi(SQUARINGS)));
        let scale = graph.select(norm, most, scale, graph.constant(f64::MAX));
        let x = x.scaled(graph, scale);
        let plus = |v: &[Id], s: Id, change: Vec<Id>| -> Vec<Id> {
            v.iter().zip(change).map(|(&v, change)| graph.times_plus(s, change, v)).collect()
        };
        // X (1 + X/2 (1 + X/3 (…))).
        let mut sum = Matrix::zeros(graph, x.rows(), x.rows());
        let mut applied = v.map(<[Id]>::to_vec);
        for k in (1..=TERMS).rev() {
            let inverse = graph.constant(1.0 / f64::from(k));
            let part = x.scaled(graph, inverse);
            sum = part.times_plus(graph, &sum, &part);
            let inverse = graph.constant(1.0 / f64::from(k + 1));
            applied = applied.zip(v).map(|(now, v)| plus(v, inverse, x.apply(graph, &now)));
        }
        let (half, two) = (graph.constant(0.5), graph.constant(2.0));
        for _ in 0..SQUARINGS {
            applied = applied.map(|now| plus(&now, half, sum.apply(graph, &now)));
            sum = sum.times_plus(graph, &sum, &sum.scaled(graph, two));
        }
        (sum, applied.unwrap_or_default())
    }

    /// g·k; where elements are orthogonal, pulled back onto them, so that rounding does not accumulate in gᵀg over many
    /// steps.
    fn product(&self, graph: &Graph, g: &Matrix, k: &Matrix) -> Vec<Id> {
        self.pulled_back(graph, g.times(graph, k)).entries().to_vec()
    }

    /// A matrix near an element, pulled back onto the elements to first order where these are orthogonal.
    fn pulled_back(&self, graph: &Graph, product: Matrix) -> Matrix {
        if !self.orthogonal {
            return product;
        }
        let (half, three_halves) = (graph.constant(-0.5), graph.constant(1.5));
        let gram = product.transposed().times(graph, &product);
        let whole = Matrix::identity(graph, self.size).scaled(graph, three_halves);
        let correction = whole.plus(graph, half, &gram);
        product.times(graph, &correction)
    }

    /// (1 + s·X/2)⁻¹, s = ±1.
    fn resolvent(&self, graph: &Graph, x: &Matrix, s: f64) -> Matrix {
        let identity = Matrix::identity(graph, self.size);
        let matrix = identity.plus(graph, graph.constant(0.5 * s), x);
        let units = identity.entries().chunks(self.size);
        let columns: Vec<Vec<Id>> = units.map(|unit| solve(graph, &matrix, unit)).collect();
        Matrix::new(self.size, self.size, |i, j| columns[j][i])
    }

    /// The coordinates ⟨Z, Eᵢ⟩.
    fn coordinates(&self, graph: &Graph, z: &Matrix) -> Vec<Id> {
        let coordinate = |entries: &Entries| {
            entries.iter().fold(graph.zero(), |sum, &(i, j, value)| {
                graph.times_plus(graph.constant(value), z.at(i, j), sum)
            })
        };
        self.basis.iter().map(coordinate).collect()
    }

    /// Aᵀ W Bᵀ with W = Σ μₖ Dₖ, so that ⟨W, ξ⟩ = ⟨μ, ξ⟩.
    fn between(&self, graph: &Graph, a: &Matrix, mu: &[Id], b: &Matrix) -> Matrix {
        let w = self.combine(graph, &self.dual, mu);
        a.transposed().times(graph, &w).times(graph, &b.transposed())
    }

    /// L = (1 − X/2)⁻¹, R = (1 + X/2)⁻¹, and Z with ⟨Z, ξ⟩ = ⟨μ, L ξ R⟩.
    fn cayley(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> [Matrix; 3] {
        let x = self.represent(graph, x);
        let (left, right) = (self.resolvent(graph, &x, -1.0), self.resolvent(graph, &x, 1.0));
        let z = self.between(graph, &left, mu, &right);
        [left, right, z]
    }

    /// The matrix of these entries, row by row.
    fn square(&self, entries: &[Id]) -> Matrix {
        Matrix::new(self.size, self.size, |i, j| entries[i * self.size + j])
    }
}

/// The number of terms of φ after the first, for A of this norm and a remainder below `accuracy`.
fn terms(norm: f64, accuracy: f64) -> usize {
    let mut term = 1.0;
    for k in 1..200 {
        term *= norm / (k + 1) as f64;
        // Derivatives have a factor of k more.
        if term * (k as f64) < accuracy {
            return k;
        }
    }
    200
}

/// The largest row sum of sizes of a square matrix.
fn row_norm(graph: &Graph, matrix: &Matrix) -> Id {
    let size = |sum, &entry: &Id| graph.add(sum, graph.abs(entry));
    let rows = matrix.entries().chunks(matrix.rows().max(1));
    let rows: Vec<Id> = rows.map(|row| row.iter().fold(graph.zero(), size)).collect();
    largest(graph, &rows)
}

fn factorial(n: usize) -> f64 {
    (2..=n).map(|i| i as f64).product()
}

impl Part for Tables {
    fn dim(&self) -> usize {
        self.dim
    }

    fn element(&self) -> usize {
        self.size * self.size
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        match self.chart {
            Chart::Exponential => self.phi(graph, x, mu, 0).0,
            Chart::Cayley => {
                let [.., z] = self.cayley(graph, x, mu);
                self.coordinates(graph, &z)
            }
        }
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        match self.chart {
            Chart::Exponential => self.phi(graph, x, mu, terms(REACH, self.slope)),
            Chart::Cayley => {
                let [left, right, z] = self.cayley(graph, x, mu);
                let value = self.coordinates(graph, &z);
                // Along Eⱼ: L′ = ½ L Eⱼ L and R′ = −½ R Eⱼ R, so that Z′ = ½ (Lᵀ Eⱼᵀ Z − Z Eⱼᵀ Rᵀ).
                let half = graph.constant(0.5);
                let minus = graph.constant(-1.0);
                let units = Matrix::identity(graph, self.dim);
                let units = units.entries().chunks(self.dim);
                let columns: Vec<Vec<Id>> = units
                    .map(|unit| {
                        let e = self.represent(graph, unit).transposed();
                        let first = left.transposed().times(graph, &e).times(graph, &z);
                        let second = z.times(graph, &e).times(graph, &right.transposed());
                        let change = self.coordinates(graph, &first.plus(graph, minus, &second));
                        change.iter().map(|&entry| graph.mul(half, entry)).collect()
                    })
                    .collect();
                (value, Matrix::new(self.dim, self.dim, |i, j| columns[j][i]))
            }
        }
    }

    /// exp's, by its series Σ βₖ (ad\*_x)ᵏ p.
    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        let a = self.ad_transpose(graph, x);
        let (mut power, mut sum) = (p.to_vec(), p.to_vec());
        for &beta in &BETA[1..=degree] {
            power = a.apply(graph, &power);
            let beta = graph.constant(beta);
            let next = sum.iter().zip(&power);
            sum = next.map(|(&sum, &w)| graph.times_plus(beta, w, sum)).collect();
        }
        sum
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let own = self.square(g);
        match self.chart {
            Chart::Exponential => {
                let a = self.ad_transpose(graph, x);
                // exp(A)μ = μ + A φ(A) μ
                let change = a.apply(graph, &self.phi(graph, x, mu, 0).0);
                let mu = mu.iter().zip(change).map(|(&mu, change)| graph.add(mu, change)).collect();
                let increment = self.exponential(graph, &self.represent(graph, x));
                Moved { g: self.product(graph, &own, &increment), mu }
            }
            Chart::Cayley => {
                // The product (1 − X/2)⁻¹ (1 + X/2) rounds half as much as 2 (1 − X/2)⁻¹ − 1.
                let (x, identity) = (self.represent(graph, x), Matrix::identity(graph, self.size));
                let [increment, inverse] = [0.5, -0.5].map(|half| {
                    let forward = identity.plus(graph, graph.constant(half), &x);
                    self.resolvent(graph, &x, -2.0 * half).times(graph, &forward)
                });
                let mu = self.coordinates(graph, &self.between(graph, &increment, mu, &inverse));
                Moved { g: self.product(graph, &own, &increment), mu }
            }
        }
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let products = 2 * (SQUARINGS + TERMS) as usize;
        if products.saturating_mul(self.size.saturating_pow(3)) > MOST_OF_TABLES {
            return None;
        }
        let own = self.square(g);
        let y = self.represent(graph, y);
        let (identity, one, minus) =
            (Matrix::identity(graph, self.size), graph.constant(1.0), graph.constant(-1.0));
        let change = self.exponential_less_one(graph, &y);
        let increment = self.pulled_back(graph, identity.plus(graph, one, &change));
        let transposed = increment.transposed();
        let mu = if self.dual.is_empty() {
            // Elements are adjoint matrices.
            transposed.apply(graph, mu)
        } else {
            let inverse = if self.orthogonal {
                transposed
            } else {
                identity.plus(
                    graph,
                    one,
                    &self.exponential_less_one(graph, &y.scaled(graph, minus)),
                )
            };
            self.coordinates(graph, &self.between(graph, &increment, mu, &inverse))
        };
        Some(Moved { g: self.product(graph, &own, &increment), mu })
    }

    fn trail(&self, graph: &Graph, y: &[Id], xi: &[Id], change: &[Id]) -> Vec<Id> {
        let back: Vec<Id> = y.iter().map(|&y| graph.neg(y)).collect();
        let inside = self.ad_transpose(graph, &back).transposed();
        let (turn, change) = self.exponential_with(graph, &inside, Some(change));
        let turned = turn.apply(graph, xi).into_iter().zip(xi).zip(change);
        turned.map(|((turned, &xi), change)| graph.add(graph.add(turned, xi), change)).collect()
    }

    fn spatial(&self, graph: &Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id> {
        let g = self.square(g);
        let back = if self.orthogonal { g.transposed() } else { self.square(back) };
        if self.dual.is_empty() {
            // Elements are adjoint matrices.
            return back.transposed().apply(graph, mu);
        }
        // ⟨Ad*_g μ, Eₖ⟩ = ⟨W, g⁻¹ Eₖ g⟩ = ⟨g⁻ᵀ W gᵀ, Eₖ⟩
        self.coordinates(graph, &self.between(graph, &back, mu, &g))
    }

    fn inverted(&self) -> Vec<(usize, usize)> {
        if self.orthogonal { Vec::new() } else { vec![(0, self.size)] }
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        let rest = finite(graph, x);
        let matrix = self.represent(graph, x);
        let size = match self.chart {
            Chart::Cayley => graph.mul(row_norm(graph, &matrix), graph.constant(0.5)),
            Chart::Exponential => {
                let a = self.ad_transpose(graph, x);
                let scale = graph.constant(std::f64::consts::FRAC_1_PI);
                // A series that ends by itself has no limit.
                let norm = |matrix: &Matrix, power: Matrix| match power.is_zero(graph) {
                    true => graph.zero(),
                    false => row_norm(graph, matrix),
                };
                let inside = norm(&a, a.times(graph, &a));
                let own = norm(&matrix, matrix.times(graph, &matrix).times(graph, &matrix));
                graph.mul(graph.max(inside, own), scale)
            }
        };
        graph.add(graph.mul(size, size), rest)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        let rest = finite(graph, g);
        if !self.orthogonal {
            return rest;
        }
        let (g, one) = (self.square(g), graph.constant(1.0));
        let gram = g.transposed().times(graph, &g);
        let places = (0..self.size).flat_map(|i| (i..self.size).map(move |j| (i, j)));
        let off =
            places.map(|(i, j)| graph.sub(gram.at(i, j), if i == j { one } else { graph.zero() }));
        let off: Vec<Id> = off.collect();
        graph.add(largest(graph, &off), rest)
    }

    fn matrix(&self, _: &Graph, g: &[Id]) -> Matrix {
        self.square(g)
    }

    fn about(&self) -> String {
        format!("its matrix of {} rows, row by row", self.size)
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        matrix.to_vec()
    }
}
