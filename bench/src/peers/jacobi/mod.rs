//! The exact motion of the free body by Jacobi's functions, the floor under every method for it.
//!
//! Momentum: Landau and Lifshitz, *Mechanics*, section 37. Attitude: precession of the line of nodes about the angular
//! momentum, its integral of the third kind written as a linear part and the argument of a theta function (Jacobi 1849;
//! van Zon and Schofield, J. Comput. Phys. 225 (2007) 145).

mod elliptic;
mod theta;

use theta::Theta;

use crate::{
    arithmetic::{Vector, cross, dot},
    method::{Method, RunError, Setting},
    problem::{FreeBody, Problem, System},
    state::{Rotation, State},
};

/// One motion, ready to be evaluated at any time.
#[derive(Clone, Debug)]
pub struct Motion {
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

impl Motion {
    /// The motion through a momentum and an attitude (matrix by rows).
    ///
    /// # Errors
    /// On the separatrix, for equal moments and for a steady rotation about a principal axis: there the functions
    /// degenerate.
    pub fn new(
        inertia: &Vector,
        momentum: &Vector,
        attitude: &[Vector; 3],
    ) -> Result<Self, RunError> {
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
            return Err(RunError::Foreign(
                "exact solution: separatrix or steady rotation".to_owned(),
            ));
        }
        let handed = if (b + 1) % 3 == c { 1.0 } else { -1.0 };
        let sign_c = momentum[c].signum();
        // Π̇_b = Π_c Π_a (1/I_a − 1/I_c) for (a, b, c) cyclic.
        let sign_b = sign_c * handed * (1.0 / ia - 1.0 / ic).signum();
        let amplitude = [sign_c * square_c.sqrt(), sign_b * square_b.sqrt(), square_a.sqrt()];
        let (sine, cosine) = (momentum[b] / amplitude[1], momentum[a] / amplitude[2]);
        let norm = sine.hypot(cosine);
        let phase = elliptic::incomplete(sine / norm, cosine / norm, m);

        let quarter = elliptic::complete(m);
        let other = elliptic::complete(1.0 - m);
        let per_argument = std::f64::consts::FRAC_PI_2 / quarter;
        let nome = (-std::f64::consts::PI * other / quarter).exp();
        // The parameter of the third kind: tan am(η | 1 − m) = C/√(L² − C²).
        let size = square.sqrt();
        let (s, k) = ((square_c / square).sqrt(), ((square - square_c) / square).sqrt());
        let eta = elliptic::incomplete(s, k, 1.0 - m);
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

    /// Momentum and attitude (matrix by rows) at time t.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> (Vector, [Vector; 3]) {
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

/// The product of two complex numbers.
#[inline(always)]
fn turn(u: &[f64; 2], v: &[f64; 2]) -> [f64; 2] {
    [u[0] * v[0] - u[1] * v[1], u[0] * v[1] + u[1] * v[0]]
}

/// The exact solution as a row: evaluated at every multiple of the step, as a trajectory would be.
#[derive(Clone, Copy, Debug, Default)]
pub struct Exact;

const NAME: &str = "exact (Jacobi)";

impl Method for Exact {
    fn name(&self) -> &str {
        NAME
    }

    fn family(&self) -> &str {
        NAME
    }

    fn order(&self) -> Option<u32> {
        None
    }

    fn applies(&self, problem: &Problem) -> bool {
        matches!(problem.system, System::FreeBody(_))
    }

    fn settings(&self, _: &Problem) -> Vec<Setting> {
        vec![Setting::Step(1.0)]
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(NAME)?;
        let System::FreeBody(body) = &problem.system else {
            return Err(RunError::NotApplicable {
                method: NAME.to_owned(),
                problem: problem.name.to_owned(),
            });
        };
        let initial = &problem.initial;
        let motion = Motion::new(&body.inertia, &initial.momentum, &initial.rotation.matrix())?;
        let (count, h) = Setting::steps(step, problem.end);
        let mut last = motion.at(0.0);
        for number in 1..=count {
            last = std::hint::black_box(motion.at(number as f64 * h));
        }
        Ok(FreeBody::state(last.0, Rotation::Matrix(last.1)))
    }
}
