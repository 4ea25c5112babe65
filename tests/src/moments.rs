//! Casimirs written down independently of the crates' own: values with the scale they are
//! compared on.

use nalgebra::{Complex, DMatrix};

/// A function of the momentum and the size against which its drift is measured.
pub type Measured = (f64, f64);

pub fn square(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

pub fn dot(u: &[f64], v: &[f64]) -> f64 {
    u.iter().zip(v).map(|(x, y)| x * y).sum()
}

/// The Casimirs of the groups by name, `algebra` being told by `system`.
///
/// so(3): |Π|²; se(3): |Γ|², Π·Γ; so(4): Σ M_ab² and the Pfaffian; se_2(3): the
/// inner products of Γ and Δ; sp(4): tr M², tr M⁴; su(n): tr (iM)^k, k = 2 … n.
pub fn casimirs(group: &str, system: &str, mu: &[f64]) -> Vec<Measured> {
    match (group, system) {
        ("SO3", _) => vec![(square(mu), square(mu))],
        ("SO3^4", _) => mu.chunks(3).map(|s| (square(s), square(s))).collect(),
        ("SE3", _) => {
            let (pi, gamma) = mu.split_at(3);
            let size = (square(pi) * square(gamma)).sqrt();
            vec![(square(gamma), square(gamma)), (dot(pi, gamma), size)]
        }
        ("SO4", _) => {
            let pfaffian = mu[0] * mu[5] - mu[1] * mu[4] + mu[2] * mu[3];
            vec![(square(mu), square(mu)), (pfaffian, square(mu))]
        }
        ("SE23", _) => {
            let (gamma, delta) = mu[3..].split_at(3);
            let size = square(gamma) + square(delta);
            [square(gamma), dot(gamma, delta), square(delta)].map(|value| (value, size)).to_vec()
        }
        ("Sp4", _) => {
            // The matrix ((A, B), (C, −Aᵀ)) dual to the basis by half the trace.
            let &[a, b, c, d, e, f, g, i, j, k] = mu else { panic!("ten momenta") };
            let m = [a, c, 2.0 * i, j, b, d, j, 2.0 * k, 2.0 * e, f, -a, -b, f, 2.0 * g, -c, -d];
            let square = DMatrix::from_row_slice(4, 4, &m).pow(2);
            let traces = [square.trace(), square.pow(2).trace()];
            vec![(traces[0], square.norm()), (traces[1], square.norm_squared())]
        }
        ("SU3", _) => moments(&special_unitary(3, mu)),
        ("SU5", _) => moments(&special_unitary(5, mu)),
        (_, "zeitlin-3") => moments(&sine_bracket(mu)),
        (_, "toda-lattice") => {
            let total: f64 = mu[3..].iter().sum();
            vec![(total, mu[3..].iter().map(|b| b.abs()).sum())]
        }
        other => panic!("no Casimirs written down for {other:?}"),
    }
}

/// tr Aᵏ, k = 2 … n, of a Hermitian matrix, and ‖A‖ᵏ.
fn moments(a: &DMatrix<Complex<f64>>) -> Vec<Measured> {
    let norm = a.norm();
    let mut power = a.clone();
    (2..=a.nrows() as i32)
        .map(|k| {
            power = &power * a;
            (power.trace().re, norm.powi(k))
        })
        .collect()
}

/// −iM for M ∈ su(n)* ≅ su(n) by ⟨M, ξ⟩ = −½ tr Mξ, coordinates dual to E_ab − E_ba,
/// i(E_ab + E_ba), i(E_kk − E_k+1,k+1).
pub fn special_unitary(n: usize, mu: &[f64]) -> DMatrix<Complex<f64>> {
    let mut m = DMatrix::<Complex<f64>>::zeros(n, n);
    let mut at = 0;
    for a in 0..n {
        for b in a + 1..n {
            // −i (r + iq) = q − ir
            m[(a, b)] = Complex::new(mu[at + 1], -mu[at]);
            m[(b, a)] = m[(a, b)].conj();
            at += 2;
        }
    }
    // h_a = ½ (d_a − d_{a+1}), Σ d_a = 0.
    let mut d = vec![0.0; n];
    for a in 1..n {
        d[a] = d[a - 1] - 2.0 * mu[at + a - 1];
    }
    let mean: f64 = d.iter().sum::<f64>() / n as f64;
    for a in 0..n {
        m[(a, a)] = Complex::new(d[a] - mean, 0.0);
    }
    m
}

/// Σ μ(c_m) (T_m + T_−m) + μ(s_m) (T_m − T_−m)/i with the clock and shift matrices of N = 3,
/// T_m = ζ^(2 m₁m₂) (clock)^m₁ (shift)^m₂, ζ = exp(2πi/3), in the order of `zeitlin_3.toml`.
fn sine_bracket(mu: &[f64]) -> DMatrix<Complex<f64>> {
    let root = |k: i32| Complex::from_polar(1.0, std::f64::consts::TAU * f64::from(k) / 3.0);
    let unit = |m1: i32, m2: i32| {
        DMatrix::from_fn(3, 3, |row, column| {
            if (row as i32 + m2).rem_euclid(3) == column as i32 {
                root(2 * m1 * m2 + m1 * row as i32)
            } else {
                Complex::new(0.0, 0.0)
            }
        })
    };
    let mut sum = DMatrix::zeros(3, 3);
    for (pair, (m1, m2)) in [(1, 0), (0, 1), (1, 1), (1, 2)].into_iter().enumerate() {
        let (plus, minus) = (unit(m1, m2), unit(-m1, -m2));
        let cosine = (&plus + &minus) * Complex::new(mu[2 * pair], 0.0);
        let sine = (&plus - &minus) * Complex::new(0.0, -mu[2 * pair + 1]);
        sum += cosine + sine;
    }
    sum
}
