//! SE(3), elements as a unit quaternion (w, i, j, k) and a translation.

use crate::graph::{Graph, Id};
use crate::lie::Chart;
use crate::step::entire::{Angle, ROUNDING, WideAngle};
use crate::step::product::{Moved, Part};
use crate::step::rotation::{
    Dexp, QUARTER_TURN, Rotation, bernoulli, compose, dexp_transpose, dexp_with_derivative,
    quaternion_of, rotate_back, rotation_matrix, turned,
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
fn resolve(graph: &Graph, omega: &V3, y: &V3) -> V3 {
    let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
    let turned = cross(graph, y, omega);
    let along = graph.mul(quarter, dot(graph, omega, y));
    plus(graph, &plus(graph, y, half, &turned), along, omega)
}

/// 1/(1 + |ω|²/4)
fn cayley_factor(graph: &Graph, omega: &V3) -> Id {
    let (one, quarter) = (graph.constant(1.0), graph.constant(0.25));
    graph.div(one, graph.times_plus(dot(graph, omega, omega), quarter, one))
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
    fn new(graph: &Graph, x: &[Id], mu: &[Id]) -> Self {
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
        let f = cayley_factor(graph, &omega);
        let q = scaled(graph, f, &resolve(graph, &omega, &gamma));
        let r = Self::bend(graph, &q, &omega, half, quarter);
        let s = sum(graph, &pi, &cross(graph, &v, &r));
        let p = scaled(graph, f, &plus(graph, &s, half, &cross(graph, &s, &omega)));
        Self { f, q, r, s, p }
    }

    /// ¼ q×ω − ½ q
    fn bend(graph: &Graph, q: &V3, omega: &V3, half: Id, quarter: Id) -> V3 {
        plus(graph, &scaled(graph, quarter, &cross(graph, q, omega)), graph.neg(half), q)
    }

    /// The derivative of (P, Q).
    fn derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Matrix {
        let (omega, v, gamma) = (three(x, 0), three(x, 3), three(mu, 3));
        let (zero, one) = (graph.zero(), graph.constant(1.0));
        let (half, quarter) = (graph.constant(0.5), graph.constant(0.25));
        let along = graph.mul(quarter, dot(graph, &omega, &gamma));
        let mut derivative = Matrix::zeros(graph, 6, 6);
        for j in 0..3 {
            let mut e = [zero; 3];
            e[j] = one;
            // Along ω: f changes by −½ f² ω_j.
            let stretch = graph.neg(graph.mul(graph.mul(self.f, omega[j]), half));
            let bent = plus(graph, &scaled(graph, half, &cross(graph, &gamma, &e)), along, &e);
            let bent = plus(graph, &bent, graph.mul(quarter, gamma[j]), &omega);
            let dq = plus(graph, &scaled(graph, stretch, &self.q), self.f, &bent);
            let dr = Self::bend(graph, &dq, &omega, half, quarter);
            let ds = cross(graph, &v, &plus(graph, &dr, quarter, &cross(graph, &self.q, &e)));
            let turned = cross(graph, &ds, &omega);
            let change = plus(graph, &ds, half, &sum(graph, &turned, &cross(graph, &self.s, &e)));
            let dp = plus(graph, &scaled(graph, stretch, &self.p), self.f, &change);
            // Along v only s changes.
            let ds = cross(graph, &e, &self.r);
            let dp_v = scaled(graph, self.f, &plus(graph, &ds, half, &cross(graph, &ds, &omega)));
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
    graph: &Graph,
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
    let m = sum(graph, &cross(graph, &gv, omega), &cross(graph, &g, v));
    let s = dot(graph, omega, v);
    let by_v = scaled(graph, k.b_slope, &g);
    let by_v = plus(graph, &plus(graph, &by_v, k.c_slope, &gg), graph.neg(k.c), gamma);
    let curved = plus(graph, &scaled(graph, curvature.0, &g), curvature.1, &gg);
    let by_omega = scaled(graph, k.b_slope, &gv);
    let by_omega = plus(graph, &plus(graph, &by_omega, k.c_slope, &m), s, &curved);
    let weight = graph.mul(s, k.c_slope);
    let by_omega = plus(graph, &by_omega, graph.neg(weight), gamma);
    let turn = scaled(graph, k.b_slope, gamma);
    let turn = plus(graph, &scaled(graph, s, &plus(graph, &turn, k.c_slope, &g)), k.c, &gv);
    let across = dot(graph, gamma, omega);
    let diagonal = dot(graph, gamma, v);
    let rest = turned(graph, &turn, graph.times_plus(weight, across, graph.mul(k.c, diagonal)));
    Matrix::new(3, 3, |i, j| {
        let sum = graph.add(to.at(i, j), rest.at(i, j));
        graph.times_plus(by_v[i], v[j], graph.times_plus(by_omega[i], omega[j], sum))
    })
}

/// R(q) v
fn rotate(graph: &Graph, q: &[Id], v: &V3) -> V3 {
    let u = three(q, 1);
    let back = minus(graph, &u);
    rotate_back(graph, (q[0], graph.constant(1.0)), &back, v)
}

impl Motion {
    fn rotation(self) -> Rotation {
        Rotation { chart: self.chart, double_cover: false }
    }

    fn angle(omega: &V3, graph: &Graph) -> Angle {
        Angle { t: dot(graph, omega, omega), reach: QUARTER_TURN }
    }

    /// (g, μ) moved by the increment with quaternion q = (w, s·ω) and translation t.
    fn moved(graph: &Graph, (g, mu): (&[Id], &[Id]), q: (Id, Id), omega: &V3, t: &V3) -> Moved {
        let (pi, gamma) = (three(mu, 0), three(mu, 3));
        let lever = cross(graph, t, &gamma);
        let angular = rotate_back(graph, q, omega, &difference(graph, &pi, &lever));
        let linear = rotate_back(graph, q, omega, &gamma);
        let place = sum(graph, &rotate(graph, g, t), &three(g, 4));
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

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        if self.chart == Chart::Cayley {
            let parts = CayleyParts::new(graph, x, mu);
            return join(&parts.p, &parts.q);
        }
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let angle = Self::angle(&omega, graph);
        // The derivative of Γ's part enters p itself: to rounding.
        let k = Dexp::new(graph, angle, ROUNDING);
        let angular = dexp_transpose(graph, k.b, k.c, &omega, &pi);
        let (linear, slope) = dexp_with_derivative(graph, &k, &omega, &gamma);
        join(&sum(graph, &angular, &three(&slope.apply(graph, &v), 0)), &linear)
    }

    /// (d^R exp)ᵀ (Π, Γ) = (f_Π + D_Γ v, f_Γ) with so(3)'s f_Π = (d^R exp_ω)ᵀ Π and its derivative D: the upper block of
    /// an entire function of a block triangular matrix.
    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        if self.chart == Chart::Cayley {
            let parts = CayleyParts::new(graph, x, mu);
            let derivative = parts.derivative(graph, x, mu);
            return (join(&parts.p, &parts.q), derivative);
        }
        let (omega, v, pi, gamma) = (three(x, 0), three(x, 3), three(mu, 0), three(mu, 3));
        let angle = Self::angle(&omega, graph);
        let k = Dexp::new(graph, angle, ROUNDING);
        let curvature = (angle.b_curvature(graph), angle.c_curvature(graph));
        let (angular, angular_slope) = dexp_with_derivative(graph, &k, &omega, &pi);
        let (linear, slope) = dexp_with_derivative(graph, &k, &omega, &gamma);
        let angular = sum(graph, &angular, &three(&slope.apply(graph, &v), 0));
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

    /// exp's: with so(3)'s J(a, p) = p − ½ a×p + c a×(a×p) it is (J(a, n) + D J(a, f) b, J(a, f)), D the derivative in a:
    /// D J b = −½ b×f + c [b×(a×f) + a×(b×f)] + 2c′ (a·b) a×(a×f).
    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        let (a, b, n, f) = (three(x, 0), three(x, 3), three(p, 0), three(p, 3));
        let [c, slope] = bernoulli(graph, dot(graph, &a, &a), degree);
        let half = graph.constant(-0.5);
        let (turned, once, bent) =
            (cross(graph, &a, &n), cross(graph, &a, &f), cross(graph, &b, &f));
        let twice = cross(graph, &a, &once);
        let linear = plus(graph, &plus(graph, &f, half, &once), c, &twice);
        let first = plus(graph, &n, half, &sum(graph, &turned, &bent));
        let second = cross(graph, &a, &sum(graph, &turned, &bent));
        let second = sum(graph, &second, &cross(graph, &b, &once));
        let along = graph.mul(slope, dot(graph, &a, &b));
        let angular = plus(graph, &plus(graph, &first, c, &second), along, &twice);
        join(&angular, &linear)
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let (omega, v) = (three(x, 0), three(x, 3));
        let q = self.rotation().increment(graph, &omega);
        let t = match self.chart {
            Chart::Exponential => {
                let angle = Self::angle(&omega, graph);
                let (b, c) = (angle.b(graph), angle.c(graph));
                let once = cross(graph, &omega, &v);
                let twice = cross(graph, &omega, &once);
                plus(graph, &plus(graph, &v, b, &once), c, &twice)
            }
            Chart::Cayley => {
                // cay(ω, v) has the translation (1 − ω̂/2)⁻¹ v.
                let f = cayley_factor(graph, &omega);
                scaled(graph, f, &resolve(graph, &minus(graph, &omega), &v))
            }
        };
        Self::moved(graph, (g, mu), q, &omega, &t)
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let (omega, v) = (three(y, 0), three(y, 3));
        let angle = WideAngle::new(graph, dot(graph, &omega, &omega));
        let once = cross(graph, &omega, &v);
        let twice = cross(graph, &omega, &once);
        let place = plus(graph, &plus(graph, &v, angle.b, &once), angle.c, &twice);
        let q = (angle.half_cosine, angle.half_sine);
        Some(Self::moved(graph, (g, mu), q, &omega, &place))
    }

    fn spatial(&self, graph: &Graph, g: &[Id], _: &[Id], mu: &[Id]) -> Vec<Id> {
        let (pi, gamma) = (rotate(graph, g, &three(mu, 0)), rotate(graph, g, &three(mu, 3)));
        join(&sum(graph, &pi, &cross(graph, &three(g, 4), &gamma)), &gamma)
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        graph.add(self.rotation().extent(graph, &x[..3]), finite(graph, &x[3..]))
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        graph.add(self.rotation().defect(graph, &g[..4]), finite(graph, &g[4..]))
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
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

/// The motions of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Plane {
    /// The chart.
    pub chart: Chart,
}

/// The coordinates of se(2) in se(3).
const PLACES: [usize; 3] = [2, 3, 4];

/// The numbers of an element among those of a motion of space.
const NUMBERS: [usize; 4] = [0, 3, 4, 5];

fn lift<const N: usize>(graph: &Graph, list: &[Id], places: &[usize], zeros: [(); N]) -> Vec<Id> {
    let mut lifted = vec![graph.zero(); zeros.len()];
    for (&place, &entry) in places.iter().zip(list) {
        lifted[place] = entry;
    }
    lifted
}

fn drop(list: &[Id], places: &[usize]) -> Vec<Id> {
    places.iter().map(|&place| list[place]).collect()
}

impl Plane {
    fn space(self) -> Motion {
        Motion { chart: self.chart }
    }
}

fn flat(moved: &Moved) -> Moved {
    Moved { g: drop(&moved.g, &NUMBERS), mu: drop(&moved.mu, &PLACES) }
}

impl Part for Plane {
    fn dim(&self) -> usize {
        3
    }

    fn element(&self) -> usize {
        4
    }

    fn pull_back(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> Vec<Id> {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        drop(&self.space().pull_back(graph, &x, &mu), &PLACES)
    }

    fn pull_back_with_derivative(&self, graph: &Graph, x: &[Id], mu: &[Id]) -> (Vec<Id>, Matrix) {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let (p, slope) = self.space().pull_back_with_derivative(graph, &x, &mu);
        (drop(&p, &PLACES), Matrix::new(3, 3, |i, j| slope.at(PLACES[i], PLACES[j])))
    }

    fn node_momentum(&self, graph: &Graph, x: &[Id], p: &[Id], degree: usize) -> Vec<Id> {
        let (x, p) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, p, &PLACES, [(); 6]));
        drop(&self.space().node_momentum(graph, &x, &p, degree), &PLACES)
    }

    fn transport(&self, graph: &Graph, g: &[Id], x: &[Id], mu: &[Id]) -> Moved {
        let (x, mu) = (lift(graph, x, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        flat(&self.space().transport(graph, &g, &x, &mu))
    }

    fn move_frame(&self, graph: &Graph, g: &[Id], y: &[Id], mu: &[Id]) -> Option<Moved> {
        let (y, mu) = (lift(graph, y, &PLACES, [(); 6]), lift(graph, mu, &PLACES, [(); 6]));
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        self.space().move_frame(graph, &g, &y, &mu).map(|moved| flat(&moved))
    }

    fn spatial(&self, graph: &Graph, g: &[Id], back: &[Id], mu: &[Id]) -> Vec<Id> {
        let (g, mu) = (lift(graph, g, &NUMBERS, [(); 7]), lift(graph, mu, &PLACES, [(); 6]));
        drop(&self.space().spatial(graph, &g, back, &mu), &PLACES)
    }

    fn extent(&self, graph: &Graph, x: &[Id]) -> Id {
        let x = lift(graph, x, &PLACES, [(); 6]);
        self.space().extent(graph, &x)
    }

    fn defect(&self, graph: &Graph, g: &[Id]) -> Id {
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        self.space().defect(graph, &g)
    }

    fn matrix(&self, graph: &Graph, g: &[Id]) -> Matrix {
        let g = lift(graph, g, &NUMBERS, [(); 7]);
        let whole = self.space().matrix(graph, &g);
        const KEPT: [usize; 3] = [0, 1, 3];
        Matrix::new(3, 3, |i, j| whole.at(KEPT[i], KEPT[j]))
    }

    fn about(&self) -> String {
        "the cosine and the sine of half the angle from body to space, then the translation".into()
    }

    fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        let m = |i: usize, j: usize| matrix.get(i * 3 + j).copied().unwrap_or(0.0);
        let space = [
            [m(0, 0), m(0, 1), 0.0, m(0, 2)],
            [m(1, 0), m(1, 1), 0.0, m(1, 2)],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ];
        let element = self.space().element_of(space.as_flattened());
        NUMBERS.iter().map(|&place| element[place]).collect()
    }
}
