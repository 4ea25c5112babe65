//! The exact motion of the free body by Jacobi's functions: the floor under every method for it.
//!
//! Momentum: Landau and Lifshitz, *Mechanics*, section 37. Attitude: precession of the line of nodes about the angular
//! momentum, its integral of the third kind written as a linear part and the argument of a theta function (Jacobi 1849;
//! van Zon and Schofield, J. Comput. Phys. 225 (2007) 145).

use super::method::{Competitor, equal_steps};
use super::problem::{Dynamics, Problem, State, Vector, cross, dot};
use crate::timing::Failure;

/// The solution evaluated once per unit of time, as a trajectory would be.
pub fn method(problem: &Problem) -> Option<Competitor> {
    (problem.kind == Dynamics::Free).then(|| Competitor {
        name: "exact (Jacobi)".to_owned(),
        order: None,
        settings: vec![1.0],
        run,
    })
}

/// The state at the end, with all before it at multiples of the step.
pub fn run(problem: &Problem, step: f64) -> Result<State, Failure> {
    let inertia = problem.inverse_inertia.map(f64::recip);
    let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let motion = Polhode::new(&inertia, &problem.momentum, &identity)?;
    let (count, h) = equal_steps(step, problem.end);
    let mut last = motion.at(0.0);
    for number in 1..=count {
        last = std::hint::black_box(motion.at(number as f64 * h));
    }
    Ok(State::rotating(last.0, last.1))
}

/// One motion, ready to be evaluated at any time.
#[derive(Clone, Debug)]
struct Polhode {
    /// The axis about which the body turns for ever, that of dn; the middle one, of sn; the other, of cn.
    axes: [usize; 3],
    amplitude: Vector,
    modulus_terms: [f64; 3],
    theta: Theta,
    /// z = phase + rate·t.
    phase: f64,
    rate: f64,
    /// The steady part of the precession, radians per unit time.
    precession: f64,
    /// The sign with which the theta function's argument counts.
    winding: f64,
    /// The unit complex number that turns the frame at time 0 to angle 0.
    start: [f64; 2],
    /// The space frame: columns are the images of line of nodes, its normal and the angular momentum at time 0.
    frame: [Vector; 3],
    size: f64,
}

impl Polhode {
    /// The motion through a momentum and an attitude (matrix by rows).
    fn new(inertia: &Vector, momentum: &Vector, attitude: &[Vector; 3]) -> Result<Self, Failure> {
        let square = dot(momentum, momentum);
        let twice_energy: f64 = (0..3).map(|i| momentum[i] * momentum[i] / inertia[i]).sum();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| inertia[i].total_cmp(&inertia[j]));
        let [least, b, most] = order;
        let (a, c) = if square > twice_energy * inertia[b] { (least, most) } else { (most, least) };
        let (ia, ib, ic) = (inertia[a], inertia[b], inertia[c]);
        // Squares of the amplitudes of Π on the three axes, from the two invariants.
        let from_c = twice_energy * ic - square;
        let from_a = twice_energy * ia - square;
        let square_a = ia * from_c / (ic - ia);
        let square_b = ib * from_c / (ic - ib);
        let square_c = ic * from_a / (ia - ic);
        let m = (ib - ia) * from_c / ((ib - ic) * from_a);
        let speed = ((ib - ic) * from_a / (ia * ib * ic)).sqrt();
        if !(m > 0.0 && m < 1.0 - 1e-9 && square_a > 0.0 && speed.is_finite()) {
            return Err("exact solution: separatrix or steady rotation".into());
        }
        let handed = if (b + 1) % 3 == c { 1.0 } else { -1.0 };
        let sign_c = momentum[c].signum();
        // Π̇_b = Π_c Π_a (1/I_a − 1/I_c) for (a, b, c) cyclic.
        let sign_b = sign_c * handed * (1.0 / ia - 1.0 / ic).signum();
        let amplitude = [sign_c * square_c.sqrt(), sign_b * square_b.sqrt(), square_a.sqrt()];
        let (sine, cosine) = (momentum[b] / amplitude[1], momentum[a] / amplitude[2]);
        let norm = sine.hypot(cosine);
        let phase = incomplete(sine / norm, cosine / norm, m);

        let quarter = complete(m);
        let other = complete(1.0 - m);
        let per_argument = std::f64::consts::FRAC_PI_2 / quarter;
        let nome = (-std::f64::consts::PI * other / quarter).exp();
        // The parameter of the third kind: tan am(η | 1 − m) = C/√(L² − C²).
        let size = square.sqrt();
        let (s, k) = ((square_c / square).sqrt(), ((square - square_c) / square).sqrt());
        let eta = incomplete(s, k, 1.0 - m);
        let delta = (1.0 - (1.0 - m) * s * s).sqrt();
        let theta = Theta::new(nome, per_argument * eta);
        // ∫ du/(1 − n sn² u) = u(1 − κζ) + κ arg Θ(u + iη), κ = s k/δ, Z(iη) = iζ.
        let kappa = s * k / delta;
        let zeta = per_argument * theta.logarithmic_slope();
        let excess = size * (twice_energy - square / ic) / (square - square_c);
        let precession = size / ic + excess * (1.0 - kappa * zeta);
        let winding = excess * kappa / speed;

        let mut motion = Self {
            axes: [c, b, a],
            amplitude,
            modulus_terms: [0.0; 3],
            theta,
            phase: per_argument * phase,
            rate: per_argument * speed,
            precession,
            winding: winding.signum(),
            start: [1.0, 0.0],
            frame: [[0.0; 3]; 3],
            size,
        };
        let [second, third, fourth] = motion.theta.constants();
        motion.modulus_terms = [fourth / third, third / second, fourth / second];
        let (body, _, shifted) = motion.body_frame(0.0);
        motion.start = [shifted[0], -motion.winding * shifted[1]];
        motion.frame = body.map(|axis| std::array::from_fn(|row| dot(&attitude[row], &axis)));
        Ok(motion)
    }

    /// Line of nodes, its normal and the direction of the angular momentum in the body; the momentum; θ₄(z + iη)
    /// as a unit complex number.
    #[inline(always)]
    fn body_frame(&self, t: f64) -> ([Vector; 3], Vector, [f64; 2]) {
        let values = self.theta.at(self.rate * t + self.phase);
        let inverse = 1.0 / values.fourth;
        let dn = self.modulus_terms[0] * values.third * inverse;
        let sn = self.modulus_terms[1] * values.first * inverse;
        let cn = self.modulus_terms[2] * values.second * inverse;
        let [c, b, a] = self.axes;
        let mut momentum = [0.0; 3];
        momentum[c] = self.amplitude[0] * dn;
        momentum[b] = self.amplitude[1] * sn;
        momentum[a] = self.amplitude[2] * cn;
        let direction = momentum.map(|v| v / self.size);
        let mut pole = [0.0; 3];
        pole[c] = 1.0;
        let nodes = cross(&direction, &pole);
        let scale = 1.0 / dot(&nodes, &nodes).sqrt();
        let nodes = nodes.map(|v| v * scale);
        let [x, y] = values.shifted;
        let scale = 1.0 / (x * x + y * y).sqrt();
        ([nodes, cross(&direction, &nodes), direction], momentum, [x * scale, y * scale])
    }

    #[inline]
    fn at(&self, t: f64) -> (Vector, [Vector; 3]) {
        let (body, momentum, shifted) = self.body_frame(t);
        let wound = turn(&[shifted[0], self.winding * shifted[1]], &self.start);
        let (sine, cosine) = (self.precession * t).sin_cos();
        let [cosine, sine] = turn(&[cosine, sine], &wound);
        let [x, y, z] = &self.frame;
        let nodes: Vector = std::array::from_fn(|i| cosine * x[i] + sine * y[i]);
        let normal: Vector = std::array::from_fn(|i| cosine * y[i] - sine * x[i]);
        let rotation = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                nodes[row] * body[0][column]
                    + normal[row] * body[1][column]
                    + z[row] * body[2][column]
            })
        });
        (momentum, rotation)
    }
}

#[inline(always)]
fn turn(u: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    [u[0] * v[0] - u[1] * v[1], u[0] * v[1] + u[1] * v[0]]
}

/// More terms than any nome below 0.9 needs at double precision.
const TERMS: usize = 24;

/// The four functions at a real argument, and θ₄ at z + iy: weights of sin and cos of multiples of z, once per nome.
#[derive(Clone, Debug)]
struct Theta {
    /// 2 q^((k+½)²).
    odd: [f64; TERMS],
    /// 2 q^(k²), k ≥ 1.
    even: [f64; TERMS],
    /// The coefficients times cosh 2ky and sinh 2ky.
    shifted: [[f64; 2]; TERMS],
    terms: usize,
}

/// θ₁, θ₂, θ₃, θ₄ at z and θ₄(z + iy).
#[derive(Clone, Copy, Debug)]
struct Values {
    first: f64,
    second: f64,
    third: f64,
    fourth: f64,
    /// Real and imaginary part of θ₄(z + iy).
    shifted: [f64; 2],
}

impl Theta {
    /// The functions of nome `q`, with shift `y` below −½ ln q.
    fn new(q: f64, y: f64) -> Self {
        let mut theta = Self {
            odd: [0.0; TERMS],
            even: [0.0; TERMS],
            shifted: [[0.0; 2]; TERMS],
            terms: TERMS,
        };
        for k in 0..TERMS {
            let n = (k + 1) as f64;
            theta.odd[k] = 2.0 * q.powf((k as f64 + 0.5).powi(2));
            theta.even[k] = 2.0 * q.powf(n * n);
            // Each exponential beside the power, so that neither overflows.
            let (up, down) =
                ((n * n * q.ln() + 2.0 * n * y).exp(), (n * n * q.ln() - 2.0 * n * y).exp());
            theta.shifted[k] = [up + down, up - down];
            if theta.shifted[k][0] < 1e-18 && theta.odd[k] < 1e-18 * theta.odd[0] {
                theta.terms = k;
                break;
            }
        }
        theta
    }

    /// θ₄′(iy)/(i θ₄(iy)).
    fn logarithmic_slope(&self) -> f64 {
        let (mut value, mut slope) = (1.0, 0.0);
        for k in 0..self.terms {
            let n = (k + 1) as f64;
            let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
            value += sign * self.shifted[k][0];
            slope -= sign * 2.0 * n * self.shifted[k][1];
        }
        slope / value
    }

    #[inline(always)]
    fn at(&self, z: f64) -> Values {
        let (sine, cosine) = z.sin_cos();
        let (sine2, cosine2) = (2.0 * sine * cosine, 1.0 - 2.0 * sine * sine);
        let mut values =
            Values { first: 0.0, second: 0.0, third: 1.0, fourth: 1.0, shifted: [1.0, 0.0] };
        let (mut s_odd, mut c_odd) = (sine, cosine);
        let (mut s_even, mut c_even) = (sine2, cosine2);
        let mut sign = 1.0;
        for k in 0..self.terms {
            values.first += sign * self.odd[k] * s_odd;
            values.second += self.odd[k] * c_odd;
            values.third += self.even[k] * c_even;
            values.fourth -= sign * self.even[k] * c_even;
            // cos(2n(z + iy)) = cos 2nz cosh 2ny − i sin 2nz sinh 2ny.
            values.shifted[0] -= sign * self.shifted[k][0] * c_even;
            values.shifted[1] += sign * self.shifted[k][1] * s_even;
            (s_odd, c_odd) = (s_odd * cosine2 + c_odd * sine2, c_odd * cosine2 - s_odd * sine2);
            (s_even, c_even) =
                (s_even * cosine2 + c_even * sine2, c_even * cosine2 - s_even * sine2);
            sign = -sign;
        }
        values
    }

    /// θ₂, θ₃, θ₄ at 0.
    fn constants(&self) -> [f64; 3] {
        let values = self.at(0.0);
        [values.second, values.third, values.fourth]
    }
}

/// The complete integral K(m) of the first kind, 0 ≤ m < 1 (Abramowitz and Stegun 17.6).
fn complete(m: f64) -> f64 {
    let (mut a, mut b) = (1.0f64, (1.0 - m).sqrt());
    while (a - b).abs() > 1e-16 * a {
        let next = 0.5 * (a + b);
        b = (a * b).sqrt();
        if next == a {
            break;
        }
        a = next;
    }
    std::f64::consts::FRAC_PI_2 / a
}

/// The incomplete integral F of the first kind at the amplitude whose sine and cosine are given, in (−2K, 2K].
fn incomplete(sine: f64, cosine: f64, m: f64) -> f64 {
    let quarter = sine * carlson(cosine * cosine, 1.0 - m * sine * sine, 1.0);
    if cosine >= 0.0 { quarter } else { (2.0 * complete(m)).copysign(sine) - quarter }
}

/// R_F(x, y, z) (Carlson, Numer. Math. 33 (1979) 1).
fn carlson(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    loop {
        let mean = (x + y + z) / 3.0;
        let (dx, dy) = (1.0 - x / mean, 1.0 - y / mean);
        let dz = -(dx + dy);
        if dx.abs().max(dy.abs()).max(dz.abs()) < 1e-3 {
            let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
            let series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0
                - 3.0 * e2 * e3 / 44.0
                - 5.0 * e2 * e2 * e2 / 208.0
                + 3.0 * e3 * e3 / 104.0;
            return series / mean.sqrt();
        }
        let lambda = (x * y).sqrt() + (y * z).sqrt() + (z * x).sqrt();
        (x, y, z) = (0.25 * (x + lambda), 0.25 * (y + lambda), 0.25 * (z + lambda));
    }
}
