//! Entire functions of t by their power series, with as many terms as a stated domain needs.

use crate::graph::{Graph, Id};

/// More terms than any domain asks for.
const MOST: usize = 64;

/// Σ cₖ tᵏ for 0 ≤ t ≤ `reach`, where terms below `accuracy` times the first are left out.
///
/// In pairs and pairs of pairs (G. Estrin, 1960), since a chain of fused products is as slow as it is long.
pub(crate) fn series(
    graph: &Graph,
    t: Id,
    reach: f64,
    accuracy: f64,
    coefficient: impl Fn(usize) -> f64,
) -> Id {
    let first = coefficient(0).abs();
    let mut power = 1.0;
    let mut count = 1;
    for k in 1..MOST {
        power *= reach;
        if coefficient(k).abs() * power > accuracy * first {
            count = k + 1;
        }
    }
    let mut list: Vec<Id> = (0..count).map(|k| graph.constant(coefficient(k))).collect();
    let mut power = t;
    while list.len() > 1 {
        list = list
            .chunks(2)
            .map(|pair| match *pair {
                [low, high] => graph.times_plus(high, power, low),
                _ => pair[0],
            })
            .collect();
        if list.len() > 1 {
            power = graph.mul(power, power);
        }
    }
    list[0]
}

/// (−1)ᵏ/n!
fn alternating(k: usize, n: usize) -> f64 {
    let factorial: f64 = (2..=n).map(|i| i as f64).product();
    if k.is_multiple_of(2) { 1.0 / factorial } else { -1.0 / factorial }
}

/// The truncation allowed in the equation of a step and in what it conserves, relative to the first term.
pub(crate) const ROUNDING: f64 = 1e-17;

/// The same for derivatives, which only Newton's method uses.
pub(crate) const NEWTON: f64 = 1e-10;

/// The functions of θ² = t that rotations need, for angles up to a limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Angle {
    /// t = θ².
    pub t: Id,
    /// The largest t.
    pub reach: f64,
}

impl Angle {
    /// cos(θ/2)
    pub(crate) fn half_cosine(self, graph: &Graph) -> Id {
        self.exact(graph, |k| 0.25_f64.powi(k as i32) * alternating(k, 2 * k))
    }

    /// sin(θ/2)/θ
    pub(crate) fn half_sine(self, graph: &Graph) -> Id {
        self.exact(graph, |k| 0.5 * 0.25_f64.powi(k as i32) * alternating(k, 2 * k + 1))
    }

    /// b = (1 − cos θ)/θ²
    pub(crate) fn b(self, graph: &Graph) -> Id {
        self.exact(graph, |k| alternating(k, 2 * k + 2))
    }

    /// c = (θ − sin θ)/θ³
    pub(crate) fn c(self, graph: &Graph) -> Id {
        self.exact(graph, |k| alternating(k, 2 * k + 3))
    }

    /// 2 db/dt, by which b changes with θ²/2, up to `accuracy`.
    pub(crate) fn b_slope(self, graph: &Graph, accuracy: f64) -> Id {
        let coefficient = |k: usize| (2 * (k + 1)) as f64 * alternating(k + 1, 2 * k + 4);
        series(graph, self.t, self.reach, accuracy, coefficient)
    }

    /// 2 dc/dt, up to `accuracy`.
    pub(crate) fn c_slope(self, graph: &Graph, accuracy: f64) -> Id {
        let coefficient = |k: usize| (2 * (k + 1)) as f64 * alternating(k + 1, 2 * k + 5);
        series(graph, self.t, self.reach, accuracy, coefficient)
    }

    /// 4 d²b/dt², for Newton's method.
    pub(crate) fn b_curvature(self, graph: &Graph) -> Id {
        let coefficient = |k: usize| (4 * (k + 1) * (k + 2)) as f64 * alternating(k, 2 * k + 6);
        series(graph, self.t, self.reach, NEWTON, coefficient)
    }

    /// 4 d²c/dt², for Newton's method.
    pub(crate) fn c_curvature(self, graph: &Graph) -> Id {
        let coefficient = |k: usize| (4 * (k + 1) * (k + 2)) as f64 * alternating(k, 2 * k + 7);
        series(graph, self.t, self.reach, NEWTON, coefficient)
    }

    fn exact(self, graph: &Graph, coefficient: impl Fn(usize) -> f64) -> Id {
        series(graph, self.t, self.reach, ROUNDING, coefficient)
    }
}

/// The functions of an angle of any size: t = θ² up to 2⁵⁰.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideAngle {
    /// cos(θ/2)
    pub half_cosine: Id,
    /// sin(θ/2)/θ
    pub half_sine: Id,
    /// (1 − cos θ)/θ²
    pub b: Id,
    /// (θ − sin θ)/θ³
    pub c: Id,
}

impl WideAngle {
    /// The functions at t.
    pub(crate) fn new(graph: &Graph, t: Id) -> Self {
        // 2π in two pieces, so that a fused product takes whole turns off without rounding.
        const TURN: f64 = std::f64::consts::TAU;
        const REST: f64 = 2.449_293_598_294_706_4e-16;
        /// Below this t the quotients by θ and θ² are taken from their series.
        const SMALL: f64 = 1.0;
        let (half, one, two) = (graph.constant(0.5), graph.constant(1.0), graph.constant(2.0));
        let angle = graph.sqrt(t);
        let halved = graph.mul(half, angle);
        let turns = graph.neg(graph.round(graph.mul(halved, graph.constant(1.0 / TURN))));
        let (turn, rest) = (graph.constant(TURN), graph.constant(REST));
        let reduced = graph.times_plus(turns, rest, graph.times_plus(turns, turn, halved));
        // With 2r in place of θ: |2r| ≤ 2π.
        let square = graph.mul(graph.constant(4.0), graph.mul(reduced, reduced));
        let near = Angle { t: square, reach: 4.0 * 9.88 };
        let half_cosine = near.half_cosine(graph);
        let sine = graph.mul(two, graph.mul(near.half_sine(graph), reduced));
        let small = graph.constant(SMALL);
        let short = Angle { t, reach: SMALL };
        let [short_sine, short_c] = [short.half_sine(graph), short.c(graph)];
        let half_sine = graph.select(t, small, short_sine, graph.div(sine, angle));
        let b = graph.mul(two, graph.mul(half_sine, half_sine));
        let whole = graph.mul(two, graph.mul(half_sine, half_cosine));
        let c = graph.select(t, small, short_c, graph.div(graph.sub(one, whole), t));
        Self { half_cosine, half_sine, b, c }
    }
}
