//! SO(3) and SU(2), elements as unit quaternions (w, i, j, k).

use coadjoint_program::collocation::BETA;

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::entire::{Angle, NEWTON, WideAngle, series};
use crate::step::product::{ESTIMATED, Moved, Part};
use crate::step::vector::{Matrix, V3, cross, dot, minus, plus, scaled, three};

/// The largest θ² of a step: a quarter turn, and what is beyond it by rounding. Longer ones are not accepted at once.
pub(crate) const QUARTER_TURN: f64 = 2.5;

/// The rotations of space, or their double cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Rotation {
    /// The chart.
    pub chart: Chart,
    /// Whether elements tell x from x + 2π.
    pub double_cover: bool,
}

/// b, c and twice their derivatives at θ², for (d^R exp_x)ᵀ.
pub(crate) struct Dexp {
    pub b: Id,
    pub c: Id,
    pub b_slope: Id,
    pub c_slope: Id,
}

impl Dexp {
    /// The four functions.
    pub(crate) fn new(graph: &Graph, angle: Angle, slopes: f64) -> Self {
        Self {
            b: angle.b(graph),
            c: angle.c(graph),
            b_slope: angle.b_slope(graph, slopes),
            c_slope: angle.c_slope(graph, slopes),
        }
    }
}

/// μ + b μ×x + c (μ×x)×x
pub(crate) fn dexp_transpose(graph: &Graph, b: Id, c: Id, x: &V3, mu: &V3) -> V3 {
    let once = cross(graph, mu, x);
    let twice = cross(graph, &once, x);
    plus(graph, &plus(graph, mu, b, &once), c, &twice)
}

/// [`dexp_transpose`] and its derivative in x.
pub(crate) fn dexp_with_derivative(graph: &Graph, k: &Dexp, x: &V3, mu: &V3) -> (V3, Matrix) {
    let once = cross(graph, mu, x);
    let twice = cross(graph, &once, x);
    let value = plus(graph, &plus(graph, mu, k.b, &once), k.c, &twice);
    // D v = b μ×v + c [(μ×v)×x + (μ×x)×v] + (x·v)(2b′ μ×x + 2c′ (μ×x)×x),
    // with (μ×v)×x = v (μ·x) − μ (v·x).
    let along = scaled(graph, k.b_slope, &once);
    let along = plus(graph, &plus(graph, &along, k.c_slope, &twice), graph.neg(k.c), mu);
    let turn = plus(graph, &scaled(graph, k.b, mu), k.c, &once);
    let constant = turned(graph, &turn, graph.mul(k.c, dot(graph, mu, x)));
    let derivative = Matrix::new(3, 3, |i, j| graph.times_plus(along[i], x[j], constant.at(i, j)));
    (value, derivative)
}

/// The matrix of v ↦ turn × v + diagonal·v.
pub(crate) fn turned(graph: &Graph, turn: &V3, diagonal: Id) -> Matrix {
    let back = minus(graph, turn);
    let rows =
        [[diagonal, back[2], turn[1]], [turn[2], diagonal, back[0]], [back[1], turn[0], diagonal]];
    Matrix::new(3, 3, |i, j| rows[i][j])
}

/// R(q)ᵀ v for the unit quaternion (w, s·x): v + 2 s w v×x + 2 s² (v×x)×x, whose products with x need not wait for w and s.
pub(crate) fn rotate_back(graph: &Graph, (w, s): (Id, Id), x: &V3, v: &V3) -> V3 {
    let two = graph.constant(2.0);
    let once = cross(graph, v, x);
    let twice = cross(graph, &once, x);
    let doubled = graph.mul(two, s);
    let (near, far) = (graph.mul(doubled, w), graph.mul(doubled, s));
    plus(graph, &plus(graph, v, near, &once), far, &twice)
}

/// The product of unit quaternions, pulled back onto the unit sphere to first order, so that rounding does not
/// accumulate in the norm over many steps. The second one is (w, s·x).
pub(crate) fn compose(graph: &Graph, a: &[Id], (w, s): (Id, Id), x: &V3) -> Vec<Id> {
    let u = scaled(graph, s, x);
    let vector = three(a, 1);
    let real = graph.times_plus(a[0], w, graph.neg(dot(graph, &vector, &u)));
    let imaginary = plus(graph, &plus(graph, &cross(graph, &vector, &u), a[0], &u), w, &vector);
    let product = [real, imaginary[0], imaginary[1], imaginary[2]];
    let norm = dot(graph, &product, &product);
    let (factor, half) = (graph.constant(1.5), graph.constant(-0.5));
    let factor = graph.times_plus(half, norm, factor);
    product.iter().map(|&entry| graph.mul(entry, factor)).collect()
}

/// The matrix of R(q).
pub(crate) fn rotation_matrix(graph: &Graph, q: &[Id]) -> Matrix {
    let (w, back) = (q[0], three(q, 1));
    let back = minus(graph, &back);
    let (zero, one) = (graph.zero(), graph.constant(1.0));
    let columns = [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
        .map(|unit| rotate_back(graph, (w, one), &back, &unit));
    Matrix::new(3, 3, |i, j| columns[j][i])
}

/// The unit quaternion of a rotation matrix, row by row with `stride` numbers a row (S. Shepperd, J. Guidance 1, 1978).
pub(crate) fn quaternion_of(matrix: &[f64], stride: usize) -> Vec<f64> {
    let m = |i: usize, j: usize| matrix.get(i * stride + j).copied().unwrap_or(0.0);
    let trace = m(0, 0) + m(1, 1) + m(2, 2);
    let squares = [trace, m(0, 0), m(1, 1), m(2, 2)];
    let largest = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    let q = match largest {
        0 => [1.0 + trace, m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)],
        axis => {
            let (i, j, k) = (axis - 1, axis % 3, (axis + 1) % 3);
            let mut q = [m(k, j) - m(j, k), 0.0, 0.0, 0.0];
            q[1 + i] = 1.0 + m(i, i) - m(j, j) - m(k, k);
            q[1 + j] = m(j, i) + m(i, j);
            q[1 + k] = m(k, i) + m(i, k);
            q
        }
    };
    let norm = q.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    q.iter().map(|entry| entry / norm).collect()
}

impl Rotation {
    fn angle(self, graph: &Graph, x: &V3) -> Angle {
        Angle { t: dot(graph, x, x), reach: QUARTER_TURN }
    }

    /// w and s of τ(x) as a quaternion (w, s·x).
    pub(crate) fn increment(self, graph: &Graph, x: &V3) -> (Id, Id) {
        match self.chart {
            Chart::Exponential => {
                let angle = self.angle(graph, x);
                (angle.half_cosine(graph), angle.half_sine(graph))
            }
            Chart::Cayley if self.double_cover => {
                // (1 − a)⁻¹(1 + a) = (1 + a)²/(1 + |a|²) for the pure quaternion a = x/4.
                let [quarter, half, one] = [0.25, 0.5, 1.0].map(|value| graph.constant(value));
                let a = scaled(graph, quarter, x);
                let n = dot(graph, &a, &a);
                let factor = graph.div(one, graph.add(one, n));
                (graph.mul(graph.sub(one, n), factor), graph.mul(half, factor))
            }
            Chart::Cayley => {
                // cay(x) is the rotation with quaternion (1, x/2)/√(1 + |x|²/4).
                let (half, one) = (graph.constant(0.5), graph.constant(1.0));
                let a = scaled(graph, half, x);
                let w = graph.div(one, graph.sqrt(graph.add(one, dot(graph, &a, &a))));
                (w, graph.mul(half, w))
            }
        }
    }
}

/// 1 + |a|² and (1 − |a|²)μ + 2(a·μ)a + 2 μ×a, a = x/4: with them (d^R cay_x)ᵀ μ on SU(2) is the second by the square of
/// the first.
fn doubled(graph: &Graph, a: &V3, mu: &V3) -> (Id, V3) {
    let (one, two) = (graph.constant(1.0), graph.constant(2.0));
    let n = dot(graph, a, a);
    let along = dot(graph, a, mu);
    let bent = plus(graph, &cross(graph, mu, a), along, a);
    let rest = scaled(graph, graph.sub(one, n), mu);
    (graph.add(one, n), plus(graph, &rest, two, &bent))
}

/// c(t) = Σ |B₂ₖ|/(2k)! tᵏ⁻¹, t = |x|², and 2 dc/dt: the factors of exp's J_R, with as many terms as the series has to this
/// degree. It is the map of groups by tables.
pub(crate) fn bernoulli(graph: &Graph, t: Id, degree: usize) -> [Id; 2] {
    let term = |k: usize| BETA[..=degree].get(2 * k + 2).map_or(0.0, |beta| beta.abs());
    let slope = |k: usize| 2.0 * (k + 1) as f64 * term(k + 1);
    [series(graph, t, 1.0, 1e-17, term), series(graph, t, 1.0, 1e-17, slope)]
}

impl Part for Rotation {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        4
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (three(x, 0), three(mu, 0));
        match self.chart {
            Chart::Exponential => {
                let angle = self.angle(graph, &x);
                let (b, c) = (angle.b(graph), angle.c(graph));
                dexp_transpose(graph, b, c, &x, &mu).to_vec()
            }
            Chart::Cayley => self.pull_back_with_derivative(graph, &x, &mu).0,
        }
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (three(x, 0), three(mu, 0));
        let (half, quarter, one) = (graph.constant(0.5), graph.constant(0.25), graph.constant(1.0));
        match self.chart {
            Chart::Exponential => {
                let k = Dexp::new(graph, self.angle(graph, &x), NEWTON);
                let (value, derivative) = dexp_with_derivative(graph, &k, &x, &mu);
                (value.to_vec(), derivative)
            }
            Chart::Cayley if self.double_cover => {
                let a = scaled(graph, quarter, &x);
                let (m, y) = doubled(graph, &a, &mu);
                let factor = graph.div(one, graph.mul(m, m));
                let value = scaled(graph, factor, &y);
                // ∂y/∂a = 2(aμᵀ − μaᵀ + a·μ + μ̂), ∂(m⁻²)/∂a = −4 m⁻³ aᵀ, ∂a/∂x = ¼.
                let turn = turned(graph, &mu, dot(graph, &a, &mu));
                let weight = graph.mul(half, factor);
                let shrink = graph.div(one, m);
                let derivative = Matrix::new(3, 3, |i, j| {
                    let back = graph.neg(mu[i]);
                    let slope = graph.times_plus(a[i], mu[j], turn.at(i, j));
                    let slope = graph.times_plus(back, a[j], slope);
                    let along = graph.mul(value[i], a[j]);
                    graph.times_plus(slope, weight, graph.neg(graph.mul(along, shrink)))
                });
                (value.to_vec(), derivative)
            }
            Chart::Cayley => {
                // d^R cay_x = (1 + x̂/2)/(1 + |x|²/4); its transpose sends μ to (μ + ½ μ×x)/(1 + |x|²/4).
                let factor = graph.div(one, graph.times_plus(dot(graph, &x, &x), quarter, one));
                let once = cross(graph, &mu, &x);
                let value = scaled(graph, factor, &plus(graph, &mu, half, &once));
                let half_factor = graph.mul(half, factor);
                let turn = scaled(graph, half_factor, &mu);
                let along = minus(graph, &scaled(graph, half_factor, &value));
                let turn = turned(graph, &turn, graph.zero());
                let derivative =
                    Matrix::new(3, 3, |i, j| graph.times_plus(along[i], x[j], turn.at(i, j)));
                (value.to_vec(), derivative)
            }
        }
    }

    /// exp's: p − ½ x×p + c x×(x×p).
    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        let (x, p) = (three(x, 0), three(p, 0));
        let [c, _] = bernoulli(graph, dot(graph, &x, &x), degree);
        let once = cross(graph, &x, &p);
        let turned = plus(graph, &p, graph.constant(-0.5), &once);
        plus(graph, &turned, c, &cross(graph, &x, &once)).to_vec()
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let (x, mu) = (three(x, 0), three(mu, 0));
        let q = self.increment(graph, &x);
        let moved = rotate_back(graph, q, &x, &mu);
        Moved { g: compose(graph, g, q, &x), mu: moved.to_vec() }
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let (y, mu) = (three(y, 0), three(mu, 0));
        let angle = WideAngle::new(graph, dot(graph, &y, &y));
        let q = (angle.half_cosine, angle.half_sine);
        let moved = rotate_back(graph, q, &y, &mu);
        Some(Moved { g: compose(graph, g, q, &y), mu: moved.to_vec() })
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        let (back, one) = (minus(graph, &three(g, 1)), graph.constant(1.0));
        rotate_back(graph, (g[0], one), &back, &three(mu, 0)).to_vec()
    }

    fn estimated(&self) -> f64 {
        if self.double_cover { ESTIMATED } else { 0.5 }
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        let square = dot(graph, x, x);
        let limit = match (self.chart, self.double_cover) {
            (Chart::Exponential, _) => std::f64::consts::PI.powi(2),
            (Chart::Cayley, false) => 4.0,
            (Chart::Cayley, true) => 16.0,
        };
        graph.mul(square, graph.constant(1.0 / limit))
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        let (norm, one) = (dot(graph, g, g), graph.constant(1.0));
        graph.abs(graph.sub(norm, one))
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        if !self.double_cover {
            return rotation_matrix(graph, g);
        }
        // w − i(xσ₁ + yσ₂ + zσ₃) as the real matrix ((a, −b), (b, a)).
        let (w, [x, y, z]) = (g[0], three(g, 1));
        let [mx, my, mz] = minus(graph, &[x, y, z]);
        let rows = [[w, my, z, x], [y, w, x, mz], [mz, mx, w, my], [mx, z, y, w]];
        Matrix::new(4, 4, |i, j| rows[i][j])
    }

    fn about(&self) -> String {
        let of = if self.double_cover { "" } else { ", the rotation from body to space" };
        format!("a unit quaternion (w, x, y, z){of}")
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        if !self.double_cover {
            return quaternion_of(matrix, 3);
        }
        let m = |i: usize, j: usize| matrix.get(i * 4 + j).copied().unwrap_or(0.0);
        let q = [m(0, 0), -m(2, 1), m(1, 0), -m(2, 0)];
        let norm = q.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        q.iter().map(|entry| entry / norm).collect()
    }
}
