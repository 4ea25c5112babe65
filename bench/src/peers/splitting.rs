//! Splittings: exact flows of the parts of H, composed symmetrically (orders 2, 4, 6 and 8).
//!
//! H = Σ Πᵢ²/(2Iᵢ) + H(Γ). Each term turns about one principal axis, H(Γ) moves along a constant velocity: McLachlan,
//! Phys. Rev. Lett. 71 (1993) 3043; Reich, Physica D 76 (1994) 375. Compositions: Hairer, Lubich, Wanner, *Geometric
//! Numerical Integration*, section V.3: Suzuki (order 4), Kahan and Li with 9 (order 6) and 17 stages (order 8).

use crate::{
    arithmetic::{multiply, sin_cos},
    method::{Method, RunError, Setting, step_sweep},
    problem::{FreeBody, MovingBody, Problem, System, Translation},
    state::State,
};

/// The parts of a Hamiltonian: an outer flow and a symmetric composition of the others.
trait Split<const N: usize> {
    /// The exact flow of the first part.
    fn outer(&self, t: f64, y: &mut [f64; N]);
    /// The symmetric composition of the exact flows of the other parts.
    fn inner(&self, t: f64, y: &mut [f64; N]);
}

/// The flow of Π_AXIS²/(2I): a rotation of the momenta and of the attitude by the angle t Π_AXIS/I.
#[inline(always)]
fn turn<const AXIS: usize, const N: usize>(
    inverse: f64,
    t: f64,
    y: &mut [f64; N],
    attitude: usize,
) {
    let (half_sine, half_cosine) = sin_cos(0.5 * t * inverse * y[AXIS]);
    let sine = 2.0 * half_sine * half_cosine;
    let cosine = 1.0 - 2.0 * half_sine * half_sine;
    let (next, last) = ((AXIS + 1) % 3, (AXIS + 2) % 3);
    for vector in (0..attitude).step_by(3) {
        let (u, v) = (y[vector + next], y[vector + last]);
        y[vector + next] = cosine * u + sine * v;
        y[vector + last] = cosine * v - sine * u;
    }
    let mut turn = [half_cosine, 0.0, 0.0, 0.0];
    turn[1 + AXIS] = half_sine;
    let q = multiply(&[y[attitude], y[attitude + 1], y[attitude + 2], y[attitude + 3]], &turn);
    y[attitude..attitude + 4].copy_from_slice(&q);
}

impl Split<7> for FreeBody {
    #[inline(always)]
    fn outer(&self, t: f64, y: &mut [f64; 7]) {
        turn::<0, 7>(self.inverse_inertia[0], t, y, 3);
    }

    #[inline(always)]
    fn inner(&self, t: f64, y: &mut [f64; 7]) {
        turn::<1, 7>(self.inverse_inertia[1], 0.5 * t, y, 3);
        turn::<2, 7>(self.inverse_inertia[2], t, y, 3);
        turn::<1, 7>(self.inverse_inertia[1], 0.5 * t, y, 3);
    }
}

impl<T: Translation> Split<13> for MovingBody<T> {
    #[inline(always)]
    fn outer(&self, t: f64, y: &mut [f64; 13]) {
        let force = [y[3], y[4], y[5]];
        let torque = self.translation.torque(&force);
        let moved = self.translation.moved(&[y[6], y[7], y[8], y[9]], &force);
        for i in 0..3 {
            y[i] += t * torque[i];
            y[10 + i] += t * moved[i];
        }
    }

    #[inline(always)]
    fn inner(&self, t: f64, y: &mut [f64; 13]) {
        let a = self.inverse_inertia;
        turn::<0, 13>(a[0], 0.5 * t, y, 6);
        turn::<1, 13>(a[1], 0.5 * t, y, 6);
        turn::<2, 13>(a[2], t, y, 6);
        turn::<1, 13>(a[1], 0.5 * t, y, 6);
        turn::<0, 13>(a[0], 0.5 * t, y, 6);
    }
}

/// A symmetric composition of Strang splittings.
#[derive(Clone, Debug)]
pub struct Splitting {
    name: String,
    order: u32,
    weights: Vec<f64>,
}

// All digits as published.
#[allow(clippy::excessive_precision)]
const KAHAN_LI_6: [f64; 5] = [
    0.392_161_444_007_314_139_28,
    0.332_599_136_789_359_438_60,
    -0.706_246_172_557_639_359_81,
    0.082_213_596_293_550_800_23,
    0.798_543_990_934_829_963_40,
];
#[allow(clippy::excessive_precision)]
const KAHAN_LI_8: [f64; 9] = [
    0.130_202_483_088_890_080_88,
    0.561_162_981_775_108_384_56,
    -0.389_474_962_644_847_286_41,
    0.158_841_906_555_155_600_90,
    -0.395_903_894_133_237_577_34,
    0.184_539_640_978_315_707_09,
    0.258_374_387_686_322_047_29,
    0.295_011_723_609_310_298_87,
    -0.605_508_533_830_034_511_70,
];

impl Splitting {
    /// Of order 2 (one stage).
    #[must_use]
    pub fn order2() -> Self {
        Self::new(2, &[1.0])
    }

    /// Of order 4 (Suzuki, 5 stages).
    #[must_use]
    pub fn order4() -> Self {
        let outer = 1.0 / (4.0 - 4f64.cbrt());
        Self::new(4, &[outer, outer, 1.0 - 4.0 * outer])
    }

    /// Of order 6 (9 stages).
    #[must_use]
    pub fn order6() -> Self {
        Self::new(6, &KAHAN_LI_6)
    }

    /// Of order 8 (17 stages).
    #[must_use]
    pub fn order8() -> Self {
        Self::new(8, &KAHAN_LI_8)
    }

    /// The composition whose weights are `half`, mirrored at the last.
    fn new(order: u32, half: &[f64]) -> Self {
        let weights = half.iter().chain(half.iter().rev().skip(1)).copied().collect();
        Self { name: format!("splitting, order {order}"), order, weights }
    }

    /// Neighbouring outer flows are one flow, also across steps.
    fn solve<const N: usize, S: Split<N>>(
        &self,
        system: &S,
        mut y: [f64; N],
        end: f64,
        step: f64,
    ) -> [f64; N] {
        let (count, h) = Setting::steps(step, end);
        let mut pending = 0.0;
        for _ in 0..count {
            for weight in &self.weights {
                let t = weight * h;
                system.outer(pending + 0.5 * t, &mut y);
                system.inner(t, &mut y);
                pending = 0.5 * t;
            }
        }
        system.outer(pending, &mut y);
        y
    }

    fn moving<T: Translation>(&self, body: &MovingBody<T>, problem: &Problem, step: f64) -> State {
        let initial = MovingBody::<T>::pack(&problem.initial);
        MovingBody::<T>::unpack(&self.solve(body, initial, problem.end, step))
    }
}

impl Method for Splitting {
    fn name(&self) -> &str {
        &self.name
    }

    fn family(&self) -> &str {
        "splitting"
    }

    fn order(&self) -> Option<u32> {
        Some(self.order)
    }

    fn applies(&self, _: &Problem) -> bool {
        true
    }

    fn settings(&self, problem: &Problem) -> Vec<Setting> {
        step_sweep(problem)
    }

    fn run(&self, problem: &Problem, setting: Setting) -> Result<State, RunError> {
        let step = setting.fixed_step(&self.name)?;
        Ok(match &problem.system {
            System::FreeBody(body) => FreeBody::unpack(&self.solve(
                body,
                FreeBody::pack(&problem.initial),
                problem.end,
                step,
            )),
            System::HeavyTop(body) => self.moving(body, problem, step),
            System::Kirchhoff(body) => self.moving(body, problem, step),
            System::Kovalevskaya(body) => self.moving(body, problem, step),
        })
    }
}
