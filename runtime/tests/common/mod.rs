//! Helpers that the group tests share: random vectors, and the laws of one group.
#![allow(dead_code, clippy::unwrap_used, clippy::expect_used)]

use coadjoint::LieGroup;
use coadjoint::groups::{CayleyGroup, Coordinates};

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

/// Every law of [`LieGroup`] at random points with coordinates up to `size`.
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
        let back = group.inverse(&g);
        let growth = (0..group.matrix_size())
            .flat_map(|i| (0..group.matrix_size()).map(move |j| (i, j)))
            .map(|(i, j)| {
                group.matrix_entry(&g, i, j).abs().max(group.matrix_entry(&back, i, j).abs())
            })
            .fold(1.0, f64::max);
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
        if log {
            let x = plus::<G>(&x, 1.0 / size.max(1.0) - 1.0, &x);
            let found = group.log(&group.exp(&x)).expect("a logarithm near 0");
            small("log∘exp", distance::<G>(&found, &x), 1e-13 * (1.0 + size));
        }

        // Actions.
        let gh = group.compose(&g, &h);
        let left = group.adjoint(&gh, &z);
        let right = group.adjoint(&g, &group.adjoint(&h, &z));
        small("Ad is an action", distance::<G>(&left, &right), 20.0 * eps);
        let left = group.coadjoint(&gh, &mu);
        let right = group.coadjoint(&g, &group.coadjoint(&h, &mu));
        small("Ad* is an action", distance::<G>(&left, &right), 50.0 * eps);
        let paired = group.coadjoint(&g, &mu).pairing(&z)
            - mu.pairing(&group.adjoint(&group.inverse(&g), &z));
        small("⟨Ad*_g μ, z⟩ = ⟨μ, Ad_{g⁻¹} z⟩", paired.abs(), 50.0 * eps);
        let paired = group.ad_star(&y, &mu).pairing(&z) - mu.pairing(&group.bracket(&y, &z));
        small("⟨ad*_y μ, z⟩ = ⟨μ, [y, z]⟩", paired.abs(), 1e-13);
        let (element, moved) = group.exp_transport(&x, &mu);
        small("exp_transport's element", element_distance(group, &element, &g), eps);
        let expected = group.coadjoint(&group.inverse(&g), &mu);
        small("exp_transport's momentum", distance::<G>(&moved, &expected), 50.0 * eps);
        for index in 0..group.casimir_count() {
            let (before, after) = (group.casimir(index, &mu), group.casimir(index, &moved));
            small("Casimir", (before - after).abs(), 100.0 * eps * (1.0 + before.abs()));
        }

        // (d^R exp)ᵀ by its definition, its derivative and its inverse.
        let p = group.dexp_transpose(&x, &mu);
        let (again, derivative) = group.dexp_transpose_with_derivative(&x, &mu);
        small("dexpᵀ, both ways", distance::<G>(&p, &again), 20.0 * eps);
        let step = 1e-5;
        for j in 0..dim {
            let unit = G::Vector::from_entries(dim, |i| f64::from(u8::from(i == j)));
            let ahead = group.dexp_transpose(&plus::<G>(&x, step, &unit), &mu);
            let behind = group.dexp_transpose(&plus::<G>(&x, -step, &unit), &mu);
            for i in 0..dim {
                let slope = (ahead[i] - behind[i]) / (2.0 * step);
                small(
                    "derivative of dexpᵀ",
                    (slope - derivative[(i, j)]).abs(),
                    1e-8 * growth * growth,
                );
            }
        }
        if log {
            let ahead = group.compose(&group.exp(&plus::<G>(&x, step, &y)), &group.inverse(&g));
            let behind = group.compose(&group.exp(&plus::<G>(&x, -step, &y)), &group.inverse(&g));
            let (ahead, behind) = (group.log(&ahead).unwrap(), group.log(&behind).unwrap());
            let slope = G::Vector::from_entries(dim, |i| (ahead[i] - behind[i]) / (2.0 * step));
            let paired = p.pairing(&y) - mu.pairing(&slope);
            small("dexpᵀ by differences", paired.abs(), 1e-7 * growth * growth);
        }
        let inverse = group.dexp_inverse_transpose(&x, &p);
        small("dexp⁻ᵀ ∘ dexpᵀ", distance::<G>(&inverse, &mu), 1e3 * eps);
        let near = plus::<G>(&x, -1.0 + 0.3 / size, &x);
        let p = group.dexp_transpose(&near, &mu);
        let inverse = group.dexp_inverse_transpose(&near, &p);
        small("dexp⁻ᵀ ∘ dexpᵀ near 0", distance::<G>(&inverse, &mu), 1e-14);

        // Reading elements.
        let read = group.element_from_matrix(|i, j| group.matrix_entry(&g, i, j)).unwrap();
        small("element_from_matrix", element_distance(group, &read, &g), eps);
    }
    let mut matrix = [[0.0; 16]; 16];
    matrix[0][0] = f64::NAN;
    assert!(group.element_from_matrix(|i, j| matrix[i][j]).is_err());
    assert!(group.element_from_matrix(|_, _| 0.0).is_err());

    // No input panics or hangs.
    for bad in [f64::NAN, f64::INFINITY, 1e300, 1e12, 1e5] {
        let x = G::Vector::from_entries(dim, |i| if i == 0 { bad } else { 0.1 });
        let mu = G::Vector::from_entries(dim, |_| 1.0);
        let (g, _) = group.exp_transport(&x, &mu);
        let _ = (group.dexp_transpose(&x, &mu), group.dexp_inverse_transpose(&x, &mu));
        let _ = (group.dexp_transpose_with_derivative(&x, &mu), group.log(&g));
    }
}

/// Every law of [`CayleyGroup`].
pub fn cayley_laws<G: CayleyGroup<Scalar = f64>>(group: &G, size: f64) {
    let mut random = Random::new(11);
    let dim = group.dim();
    for _ in 0..12 {
        let x = random.vector(group, size);
        let y = random.vector(group, 1.0);
        let mu = random.vector(group, 2.0);
        let negative = plus::<G>(&x, -2.0, &x);
        let (g, moved) = group.cayley_transport(&x, &mu);
        let expected = group.coadjoint(&group.inverse(&g), &mu);
        small("cayley_transport's momentum", distance::<G>(&moved, &expected), 1e-12);
        let back = group.compose(&group.cayley_transport(&negative, &mu).0, &g);
        small("cay(−x)·cay(x)", element_distance(group, &back, &group.identity()), 1e-13);
        let found = group.cayley_inverse(&g).unwrap();
        small("cay⁻¹∘cay", distance::<G>(&found, &x), 1e-12);

        let p = group.dcay_transpose(&x, &mu);
        let (again, derivative) = group.dcay_transpose_with_derivative(&x, &mu);
        small("dcayᵀ, both ways", distance::<G>(&p, &again), 1e-13);
        let step = 1e-5;
        for j in 0..dim {
            let unit = G::Vector::from_entries(dim, |i| f64::from(u8::from(i == j)));
            let ahead = group.dcay_transpose(&plus::<G>(&x, step, &unit), &mu);
            let behind = group.dcay_transpose(&plus::<G>(&x, -step, &unit), &mu);
            for i in 0..dim {
                let slope = (ahead[i] - behind[i]) / (2.0 * step);
                small("derivative of dcayᵀ", (slope - derivative[(i, j)]).abs(), 1e-8);
            }
        }
        let tau = |s: f64| group.cayley_transport(&plus::<G>(&x, s, &y), &mu).0;
        let ahead = group.compose(&tau(step), &group.inverse(&g));
        let behind = group.compose(&tau(-step), &group.inverse(&g));
        let (ahead, behind) = (group.log(&ahead).unwrap(), group.log(&behind).unwrap());
        let slope = G::Vector::from_entries(dim, |i| (ahead[i] - behind[i]) / (2.0 * step));
        small("dcayᵀ by differences", (p.pairing(&y) - mu.pairing(&slope)).abs(), 1e-7);
        let inverse = group.dcay_inverse_transpose(&x, &p);
        small("dcay⁻ᵀ ∘ dcayᵀ", distance::<G>(&inverse, &mu), 1e-12);
    }
}
