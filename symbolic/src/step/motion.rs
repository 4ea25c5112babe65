//! SE(3), elements as a unit quaternion (w, i, j, k) and a translation.

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::entire::{Accuracy, Angle, WideAngle};
use crate::step::part::{Moved, Part};
use crate::step::rotation::{
    Dexp, QUARTER_TURN, Rotation, compose, dexp_transpose, dexp_with_derivative, quaternion_of,
    rotate_back, rotation_matrix, turned,
};
use crate::step::vector::{
    Matrix, V3, cross, difference, dot, finite, minus, plus, scaled, sum, three,
};

/// The motions of space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Motion {
    /// The chart.
    pub chart: Chart,
}

fn join(a: &V3, b: &V3) -> Vec<Id> {
    a.iter().chain(b).copied().collect()
}

/// (1 + ω̂/2)⁻¹ y (1 + |ω|²/4) = y + ½ y×ω + ¼ (ω·y) ω
fn resolve(graph: &mut Graph, omega: &V3, y: &V3) -> V3 {
    let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
    let turned = cross(graph, y, omega);
    let along = dot(graph, omega, y);
    let along = graph.mul(quarter, along);
    let near = plus(graph, y, half, &turned);
    plus(graph, &near, along, omega)
}

/// 1/(1 + |ω|²/4)
fn cayley_factor(graph: &mut Graph, omega: &V3) -> Id {
    let (one, quarter) = (graph.constant(1.0), graph.constant(0.25));
    let square = dot(graph, omega, omega);
    let below = graph.times_plus(square, quarter, one);
    graph.div(one, below)
}

/// The parts of (d^R cay)ᵀ (Π, Γ) = (P, Q): Q = (1 + ω̂/2)⁻¹ Γ, r = ¼ Q×ω − ½ Q, s = Π + v×r,
/// P = f·(s + ½ s×ω), f = 1/(1 + |ω|²/4).
struct CayleyParts {
    f: Id,
    q: V3,
    r: V3,
    s: V3,
    p: V3,
}

impl CayleyParts {
    fn new(graph: &mut Graph, x: &[Id], mu: &[Id]) -> Self {
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
        let f = cayley_factor(graph, &omega);
        let q = resolve(graph, &omega, &gamma);
        let q = scaled(graph, f, &q);
        let r = Self::bend(graph, &q, &omega, half, quarter);
        let lever = cross(graph, &v, &r);
        let s = sum(graph, &pi, &lever);
        let once = cross(graph, &s, &omega);
        let p = plus(graph, &s, half, &once);
        let p = scaled(graph, f, &p);
        Self { f, q, r, s, p }
    }

    /// ¼ q×ω − ½ q
    fn bend(graph: &mut Graph, q: &V3, omega: &V3, half: Id, quarter: Id) -> V3 {
        let once = cross(graph, q, omega);
        let once = scaled(graph, quarter, &once);
        let back = graph.neg(half);
        plus(graph, &once, back, q)
    }

    /// The derivative of (P, Q).
    fn derivative(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Matrix {
        let (omega, v, gamma) = (three(x, 0), three(x, 3), three(mu, 3));
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
        let along = dot(graph, &omega, &gamma);
        let along = graph.mul(quarter, along);
        let mut derivative = Matrix::zeros(graph, 6, 6);
        for j in 0..3 {
            let mut e = [zero; 3];
            e[j] = one;
            // Along ω: f changes by −½ f² ω_j.
            let stretch = graph.mul(self.f, omega[j]);
            let stretch = graph.mul(stretch, half);
            let stretch = graph.neg(stretch);
            let bent = cross(graph, &gamma, &e);
            let bent = scaled(graph, half, &bent);
            let bent = plus(graph, &bent, along, &e);
            let weight = graph.mul(quarter, gamma[j]);
            let bent = plus(graph, &bent, weight, &omega);
            let dq = scaled(graph, stretch, &self.q);
            let dq = plus(graph, &dq, self.f, &bent);
            let dr = Self::bend(graph, &dq, &omega, half, quarter);
            let turned = cross(graph, &self.q, &e);
            let dr = plus(graph, &dr, quarter, &turned);
            let ds = cross(graph, &v, &dr);
            let turned = cross(graph, &ds, &omega);
            let other = cross(graph, &self.s, &e);
            let turned = sum(graph, &turned, &other);
            let change = plus(graph, &ds, half, &turned);
            let dp = scaled(graph, stretch, &self.p);
            let dp = plus(graph, &dp, self.f, &change);
            // Along v only s changes.
            let ds = cross(graph, &e, &self.r);
            let turned = cross(graph, &ds, &omega);
            let dp_v = plus(graph, &ds, half, &turned);
            let dp_v = scaled(graph, self.f, &dp_v);
            for i in 0..3 {
                derivative.set(i, j, dp[i]);
                derivative.set(i + 3, j, dq[i]);
                derivative.set(i, j + 3, dp_v[i]);
            }
        }
        derivative
    }
}

/// `to` and the derivative in ω of D(ω, Γ)v, where D(ω, Γ) is that of f(ω) = (d^R exp_ω)ᵀ Γ: the second derivative of f,
/// once applied to v.
///
/// With f = Γ + b g + c g×ω, g = Γ×ω, and b, c functions of t = |ω|²; collected by how the second direction u enters:
/// through ω·u, through v·u, in a cross product, and as itself.
fn bend(
    graph: &mut Graph,
    to: &Matrix,
    k: &Dexp,
    curvature: (Id, Id),
    omega: &V3,
    gamma: &V3,
    v: &V3,
) -> Matrix {
    let g = cross(graph, gamma, omega);
    let gg = cross(graph, &g, omega);
    let gv = cross(graph, gamma, v);
    let m = cross(graph, &gv, omega);
    let other = cross(graph, &g, v);
    let m = sum(graph, &m, &other);
    let s = dot(graph, omega, v);
    let by_v = scaled(graph, k.b_slope, &g);
    let by_v = plus(graph, &by_v, k.c_slope, &gg);
    let back = graph.neg(k.c);
    let by_v = plus(graph, &by_v, back, gamma);
    let curved = scaled(graph, curvature.0, &g);
    let curved = plus(graph, &curved, curvature.1, &gg);
    let by_omega = scaled(graph, k.b_slope, &gv);
    let by_omega = plus(graph, &by_omega, k.c_slope, &m);
    let by_omega = plus(graph, &by_omega, s, &curved);
    let weight = graph.mul(s, k.c_slope);
    let back = graph.neg(weight);
    let by_omega = plus(graph, &by_omega, back, gamma);
    let turn = scaled(graph, k.b_slope, gamma);
    let turn = plus(graph, &turn, k.c_slope, &g);
    let turn = scaled(graph, s, &turn);
    let turn = plus(graph, &turn, k.c, &gv);
    let across = dot(graph, gamma, omega);
    let diagonal = dot(graph, gamma, v);
    let diagonal = graph.mul(k.c, diagonal);
    let diagonal = graph.times_plus(weight, across, diagonal);
    let rest = turned(graph, &turn, diagonal);
    Matrix::new(3, 3, |i, j| {
        let sum = graph.add(to.at(i, j), rest.at(i, j));
        let sum = graph.times_plus(by_omega[i], omega[j], sum);
        graph.times_plus(by_v[i], v[j], sum)
    })
}

/// R(q) v
fn rotate(graph: &mut Graph, q: &[Id], v: &V3) -> V3 {
    let u = three(q, 1);
    let back = minus(graph, &u);
    let one = graph.constant(1.0);
    rotate_back(graph, (q[0], one), &back, v)
}

impl Motion {
    fn rotation(self) -> Rotation {
        Rotation { chart: self.chart, double_cover: false }
    }

    fn angle(omega: &V3, graph: &mut Graph) -> Angle {
        Angle { t: dot(graph, omega, omega), reach: QUARTER_TURN }
    }

    /// (g, μ) moved by the increment with quaternion q = (w, s·ω) and translation t.
    fn moved(graph: &mut Graph, (g, mu): (&[Id], &[Id]), q: (Id, Id), omega: &V3, t: &V3) -> Moved {
        let (pi, gamma) = (three(mu, 0), three(mu, 3));
        let lever = cross(graph, t, &gamma);
        let lifted = difference(graph, &pi, &lever);
        let angular = rotate_back(graph, q, omega, &lifted);
        let linear = rotate_back(graph, q, omega, &gamma);
        let carried = rotate(graph, g, t);
        let place = sum(graph, &carried, &three(g, 4));
        let mut element = compose(graph, g, q, omega);
        element.extend(place);
        Moved { g: element, mu: join(&angular, &linear) }
    }
}

impl Part for Motion {
    fn dim(&self) -> usize {
        6
    }

    fn element(&self) -> usize {
        7
    }

    fn pull_back(&self, graph: &mut Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        if self.chart == Chart::Cayley {
            let parts = CayleyParts::new(graph, x, mu);
            return join(&parts.p, &parts.q);
        }
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let angle = Self::angle(&omega, graph);
        // The derivative of Γ's part enters p itself: to rounding.
        let k = Dexp::new(graph, angle, Accuracy::Rounding);
        let angular = dexp_transpose(graph, k.b, k.c, &omega, &pi);
        let (linear, slope) = dexp_with_derivative(graph, &k, &omega, &gamma);
        let lever = slope.apply(graph, &v);
        let angular = sum(graph, &angular, &three(&lever, 0));
        join(&angular, &linear)
    }

    /// (d^R exp)ᵀ (Π, Γ) = (f_Π + D_Γ v, f_Γ) with so(3)'s f_Π = (d^R exp_ω)ᵀ Π and its derivative D: the upper block of
    /// an entire function of a block triangular matrix.
    fn pull_back_with_derivative(
        &self,
        graph: &mut Graph,
        x: &[Id],
        mu: &[Id],
    ) -> (Vec<Id>, Matrix) {
        if self.chart == Chart::Cayley {
            let parts = CayleyParts::new(graph, x, mu);
            let derivative = parts.derivative(graph, x, mu);
            return (join(&parts.p, &parts.q), derivative);
        }
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let angle = Self::angle(&omega, graph);
        let k = Dexp::new(graph, angle, Accuracy::Rounding);
        let curvature = (angle.b_curvature(graph), angle.c_curvature(graph));
        let (angular, angular_slope) = dexp_with_derivative(graph, &k, &omega, &pi);
        let (linear, slope) = dexp_with_derivative(graph, &k, &omega, &gamma);
        let lever = slope.apply(graph, &v);
        let angular = sum(graph, &angular, &three(&lever, 0));
        let corner = bend(graph, &angular_slope, &k, curvature, &omega, &gamma, &v);
        let zero = graph.zero();
        let derivative = Matrix::new(6, 6, |i, j| match (i < 3, j < 3) {
            (true, true) => corner.at(i, j),
            (true, false) => slope.at(i, j - 3),
            (false, true) => slope.at(i - 3, j),
            (false, false) => zero,
        });
        (join(&angular, &linear), derivative)
    }

    fn transport(&self, graph: &mut Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let (omega, v) = (three(x, 0), three(x, 3));
        let q = self.rotation().increment(graph, &omega);
        let t = match self.chart {
            Chart::Exponential => {
                let angle = Self::angle(&omega, graph);
                let (b, c) = (angle.b(graph), angle.c(graph));
                let once = cross(graph, &omega, &v);
                let twice = cross(graph, &omega, &once);
                let near = plus(graph, &v, b, &once);
                plus(graph, &near, c, &twice)
            }
            Chart::Cayley => {
                // cay(ω, v) has the translation (1 − ω̂/2)⁻¹ v.
                let f = cayley_factor(graph, &omega);
                let back = minus(graph, &omega);
                let t = resolve(graph, &back, &v);
                scaled(graph, f, &t)
            }
        };
        Self::moved(graph, (g, mu), q, &omega, &t)
    }

    fn move_frame(&self, graph: &mut Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let (omega, v) = (three(y, 0), three(y, 3));
        let t = dot(graph, &omega, &omega);
        let angle = WideAngle::new(graph, t);
        let once = cross(graph, &omega, &v);
        let twice = cross(graph, &omega, &once);
        let place = plus(graph, &v, angle.b, &once);
        let place = plus(graph, &place, angle.c, &twice);
        let q = (angle.half_cosine, angle.half_sine);
        Some(Self::moved(graph, (g, mu), q, &omega, &place))
    }

    fn spatial(&self, graph: &mut Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        let (pi, gamma) = (rotate(graph, g, &three(mu, 0)), rotate(graph, g, &three(mu, 3)));
        let arm = cross(graph, &three(g, 4), &gamma);
        join(&sum(graph, &pi, &arm), &gamma)
    }

    fn extent(&self, graph: &mut Graph, x: &[Id]) -> Id {
        let turn = self.rotation().extent(graph, &x[..3]);
        let rest = finite(graph, &x[3..]);
        graph.add(turn, rest)
    }

    fn defect(&self, graph: &mut Graph, g: &[Id]) -> Id {
        let turn = self.rotation().defect(graph, &g[..4]);
        let rest = finite(graph, &g[4..]);
        graph.add(turn, rest)
    }

    fn matrix(&self, graph: &mut Graph, g: &[Id]) -> Matrix {
        let turn = rotation_matrix(graph, g);
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        Matrix::new(4, 4, |i, j| match (i < 3, j < 3) {
            (true, true) => turn.at(i, j),
            (true, false) => g[4 + i],
            (false, true) => zero,
            (false, false) => one,
        })
    }

    fn about(&self) -> String {
        "a unit quaternion (w, x, y, z), the rotation from body to space, then the translation"
            .into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let mut element = quaternion_of(matrix, 4);
        let place = |i: usize| matrix.get(i * 4 + 3).copied().unwrap_or(0.0);
        element.extend((0..3).map(place));
        element
    }
}
