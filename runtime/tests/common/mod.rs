//! Helpers that the group tests share: random vectors, and the laws of one group.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used)]

use coadjoint::LieGroup;
use coadjoint::groups::{Chart, Coordinates, Exponential};

/// A small deterministic generator (xorshift64*); numbers in (−1, 1).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn number(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector<G: LieGroup<Scalar = f64>>(&mut self, group: &G, size: f64) -> G::Vector {
        G::Vector::from_entries(group.dim(), |_| size * self.number())
    }
}

pub fn distance<G: LieGroup<Scalar = f64>>(a: &G::Vector, b: &G::Vector) -> f64 {
    (0..a.dim()).fold(0.0, |worst, i| {
        let d = (a[i] - b[i]).abs();
        if d.is_nan() { f64::NAN } else { worst.max(d) }
    })
}

pub fn element_distance<G: LieGroup<Scalar = f64>>(
    group: &G,
    a: &G::Element,
    b: &G::Element,
) -> f64 {
    let size = group.matrix_size();
    let mut worst = 0.0_f64;
    for i in 0..size {
        for j in 0..size {
            let d = (group.matrix_entry(a, i, j) - group.matrix_entry(b, i, j)).abs();
            if d.is_nan() {
                return d;
            }
            worst = worst.max(d);
        }
    }
    worst
}

pub fn plus<G: LieGroup<Scalar = f64>>(a: &G::Vector, s: f64, b: &G::Vector) -> G::Vector {
    G::Vector::from_entries(a.dim(), |i| a[i] + s * b[i])
}

#[track_caller]
pub fn small(what: &str, value: f64, bound: f64) {
    assert!(value <= bound, "{what}: {value:e} exceeds {bound:e}");
}

/// The largest entry of the matrices of g and g⁻¹, at least one.
fn growth_of<G: LieGroup<Scalar = f64>>(group: &G, g: &G::Element) -> f64 {
    let (size, back) = (group.matrix_size(), group.inverse(g));
    let entry = |at: usize| {
        let (i, j) = (at / size, at % size);
        group.matrix_entry(g, i, j).abs().max(group.matrix_entry(&back, i, j).abs())
    };
    (0..size * size).map(entry).fold(1.0, f64::max)
}

/// Every law of [`LieGroup`] and of the exponential chart at random points with coordinates up to `size`.
pub fn group_laws<G: LieGroup<Scalar = f64>>(group: &G, size: f64, log: bool) {
    let mut random = Random::new(7);
    let dim = group.dim();
    for _ in 0..12 {
        let x = random.vector(group, size);
        let y = random.vector(group, 1.0);
        let z = random.vector(group, 1.0);
        let mu = random.vector(group, 2.0);
        let g = group.exp(&x);
        let h = group.exp(&y);
        let growth = growth_of(group, &g);
        let eps = 1e-14 * growth * growth * (1.0 + size);
        let negative = plus::<G>(&x, -2.0, &x);

        // Group axioms, exp.
        let e = group.identity();
        small("g·g⁻¹", element_distance(group, &group.compose(&g, &group.inverse(&g)), &e), eps);
        let back = group.compose(&group.exp(&negative), &g);
        small("exp(−x)·exp(x)", element_distance(group, &back, &e), eps);
        let twice = G::Vector::from_entries(dim, |i| 2.0 * x[i]);
        let square = group.compose(&g, &g);
        small(
            "exp(2x) = exp(x)²",
            element_distance(group, &group.exp(&twice), &square),
            10.0 * eps,
        );
        // Actions.
        let gh = group.compose(&g, &h);
        let turned = group.exp(&group.adjoint(&g, &y));
        let conjugated = group.compose(&group.compose(&g, &h), &group.inverse(&g));
        let bound = 20.0 * eps * growth_of(group, &turned);
        small("exp(Ad_g y) = g·exp(y)·g⁻¹", element_distance(group, &turned, &conjugated), bound);
        let step = 1e-5;
        let ahead = group.adjoint(&group.exp(&plus::<G>(&y, step - 1.0, &y)), &z);
        let behind = group.adjoint(&group.exp(&plus::<G>(&y, -step - 1.0, &y)), &z);
        let bracket = group.bracket(&y, &z);
        let slope = G::Vector::from_entries(dim, |i| (ahead[i] - behind[i]) / (2.0 * step));
        small("[y, z] by differences", distance::<G>(&slope, &bracket), 1e-8);
        let left = group.coadjoint(&gh, &mu);
        let right = group.coadjoint(&g, &group.coadjoint(&h, &mu));
        small("Ad* is an action", distance::<G>(&left, &right), 50.0 * eps);
        let paired = group.coadjoint(&g, &mu).pairing(&z)
            - mu.pairing(&group.adjoint(&group.inverse(&g), &z));
        small("⟨Ad*_g μ, z⟩ = ⟨μ, Ad_{g⁻¹} z⟩", paired.abs(), 50.0 * eps);
        let paired = group.ad_star(&y, &mu).pairing(&z) - mu.pairing(&group.bracket(&y, &z));
        small("⟨ad*_y μ, z⟩ = ⟨μ, [y, z]⟩", paired.abs(), 1e-13);
        // Reading elements.
        let read = group.element_from_matrix(|i, j| group.matrix_entry(&g, i, j)).unwrap();
        small("element_from_matrix", element_distance(group, &read, &g), eps);
    }
    let mut matrix = [[0.0; 16]; 16];
    matrix[0][0] = f64::NAN;
    assert!(group.element_from_matrix(|i, j| matrix[i][j]).is_err());
    assert!(group.element_from_matrix(|_, _| 0.0).is_err());
    chart_laws(group, Exponential, size, log);
}

/// Every law of a chart at random points with coordinates up to `size`; with `log`, its coordinate of a known element is
/// asked for, too.
pub fn chart_laws<G, C>(group: &G, chart: C, size: f64, log: bool)
where
    G: LieGroup<Scalar = f64>,
    C: Chart<G>,
{
    let mut random = Random::new(11);
    let dim = group.dim();
    for _ in 0..12 {
        let x = random.vector(group, size);
        let y = random.vector(group, 1.0);
        let mu = random.vector(group, 2.0);
        let negative = plus::<G>(&x, -2.0, &x);
        let (g, moved) = chart.transport(group, &x, &mu);
        let back = group.inverse(&g);
        let growth = growth_of(group, &g);
        let eps = 1e-14 * growth * growth * (1.0 + size);

        let expected = group.coadjoint(&back, &mu);
        small("the transported momentum", distance::<G>(&moved, &expected), 50.0 * eps);
        for index in 0..group.casimir_count() {
            let (before, after) = (group.casimir(index, &mu), group.casimir(index, &moved));
            small("Casimir", (before - after).abs(), 100.0 * eps * (1.0 + before.abs()));
        }
        let round = group.compose(&chart.transport(group, &negative, &mu).0, &g);
        small("τ(−x)·τ(x)", element_distance(group, &round, &group.identity()), eps);

        // (d^R τ)ᵀ by its definition, its derivative and its inverse.
        let p = chart.pull_back(group, &x, &mu);
        let (again, derivative) = chart.pull_back_with_derivative(group, &x, &mu);
        small("both ways", distance::<G>(&p, &again), 0.0);
        let exact = chart.pull_back_derivative(group, &x, &mu);
        let step = 1e-3;
        for j in 0..dim {
            let at = |s: f64| {
                chart.pull_back(group, &plus::<G>(&x, s * step, &G::Vector::unit(dim, j)), &mu)
            };
            let (near, far) = ([at(1.0), at(-1.0)], [at(2.0), at(-2.0)]);
            for i in 0..dim {
                let slope = 8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i]);
                let slope = slope / (12.0 * step);
                let bound = 1e-9 * growth * growth;
                small("the derivative", (slope - derivative[(i, j)]).abs(), bound);
                small("the exact derivative", (slope - exact[(i, j)]).abs(), bound);
            }
        }
        let inverse = chart.left_momentum(group, &x, &p);
        small("dτ⁻ᵀ ∘ dτᵀ", distance::<G>(&inverse, &mu), 1e3 * eps);
        if log {
            let near = plus::<G>(&x, 1.0 / size.max(1.0) - 1.0, &x);
            let found = chart.coordinate(group, &chart.transport(group, &near, &mu).0);
            small("τ⁻¹∘τ", distance::<G>(&found.unwrap(), &near), 1e-13 * (1.0 + size));
            let step = 1e-5;
            let moved = |s: f64| {
                let ahead = chart.transport(group, &plus::<G>(&x, s, &y), &mu).0;
                group.log(&group.compose(&ahead, &back)).unwrap()
            };
            let (ahead, behind) = (moved(step), moved(-step));
            let slope = G::Vector::from_entries(dim, |i| (ahead[i] - behind[i]) / (2.0 * step));
            let paired = p.pairing(&y) - mu.pairing(&slope);
            small("dτᵀ by differences", paired.abs(), 1e-7 * growth * growth);
        }
    }
    // No input panics or hangs.
    for bad in [f64::NAN, f64::INFINITY, 1e300, 1e12, 1e5] {
        let x = G::Vector::from_entries(dim, |i| if i == 0 { bad } else { 0.1 });
        let mu = G::Vector::from_entries(dim, |_| 1.0);
        let (g, _) = chart.transport(group, &x, &mu);
        let _ = (chart.pull_back_with_derivative(group, &x, &mu), chart.coordinate(group, &g));
        let _ = chart.pull_back_derivative(group, &x, &mu);
        let _ = (chart.left_momentum(group, &x, &mu), chart.extent(group, &x));
    }
}
