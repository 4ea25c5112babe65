//! Kernels of steps by collocation, beside the runtime's generic step of the same equations.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::groups::{Coordinates, DirectProduct, Heisenberg, Product, SE2, SL2, SO4, SU2, SU3};
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_codegen::smooth::Smooth;
use coadjoint_codegen::step::Origin;
use coadjoint_program::{Precision, Stepper};
use coadjoint_tests::backends::entries_of;
use coadjoint_tests::bridge::named;
use coadjoint_tests::kernels::smooth;
use coadjoint_tests::stress::Random;

/// The momenta after steps from the time 0.3, and the most sweeps of one.
fn by_kernel(smooth: &Smooth, h: f64, steps: u64, mu: &[f64]) -> (Vec<f64>, Vec<f64>, u32) {
    let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
    let kernel = step.kernel();
    let mut slots = step.fold(h, &[]).unwrap();
    let size = (kernel.programs.matrix.outputs().len() as f64).sqrt() as usize;
    let identity: Vec<f64> =
        (0..size * size).map(|at| f64::from(u8::from(at / size == at % size))).collect();
    let (mut g, mut mu) = (step.element_of(&identity), mu.to_vec());
    let mut sweeps = 0;
    for number in 0..steps {
        step.set_time(&mut slots, h, 0.3 + number as f64 * h);
        let made = kernel.advance(&slots, &mut g, &mut mu, 1);
        assert_eq!(made.steps, 1, "{}: step {number} of {h}", smooth.source);
        sweeps = sweeps.max(made.corrections);
    }
    let matrix = kernel.programs.matrix.run(&g, &[]);
    (matrix, mu, sweeps)
}

fn list<V: Coordinates<f64>>(vector: &V) -> Vec<f64> {
    (0..vector.dim()).map(|i| vector[i]).collect()
}

fn vector<V: Coordinates<f64>>(list: &[f64]) -> V {
    V::from_entries(list.len(), |i| list[i])
}

/// A Hamiltonian for these values of its symbols, by its programs.
#[derive(Clone, Copy)]
struct AtSymbols<'a>(&'a Smooth, &'a [f64]);

impl<V: Coordinates<f64>> Energy<V> for AtSymbols<'_> {
    fn value(&self, time: f64, mu: &V) -> f64 {
        self.0.energy(self.1, time, &list(mu))
    }

    fn gradient(&self, time: f64, mu: &V) -> V {
        vector(&self.0.gradient(self.1, time, &list(mu)))
    }

    fn unit(&self, i: usize) -> f64 {
        self.0.units[i]
    }
}

fn by_runtime<G: LieGroup<Scalar = f64>, const M: usize>(
    group: &G,
    smooth: &Smooth,
    h: f64,
    steps: u64,
    mu: &[f64],
) -> (Vec<f64>, Vec<f64>, u32) {
    let symbols = smooth.symbols_at(&[]);
    let energy = AtSymbols(smooth, &symbols);
    let mut step = Collocation::<_, _, M>::new(group.clone(), energy, h).unwrap();
    let mut state = Phase::<G>::new(group.identity(), vector::<G::Vector>(mu));
    let report = step.advance_by(&mut state, 0.3, steps).unwrap();
    (entries_of(group, &state.group_element), list(&state.momentum), report.iterations)
}

fn compare_at<G: LieGroup<Scalar = f64>, const M: usize>(group: &G, name: &str, hamiltonian: &str) {
    let mu: Vec<f64> = (0..group.dim()).map(|i| 0.6 - 0.17 * i as f64).collect();
    let smooth = smooth(name, hamiltonian, 2 * M - 1);
    let h = if M == 1 { 0.05 } else { 0.15 };
    let (g, moved, sweeps) = by_kernel(&smooth, h, 12, &mu);
    let (other_g, other, others) = by_runtime::<G, M>(group, &smooth, h, 12, &mu);
    let furthest = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let apart = f64::max(furthest(&g, &other_g), furthest(&moved, &other));
    assert!(apart < 1e-13, "{name}, {M} nodes: {apart:e}");
    assert!(sweeps <= others + 1, "{name}, {M} nodes: {sweeps} sweeps, {others} by the runtime");
}

fn compare<G: LieGroup<Scalar = f64>>(group: &G, name: &str, hamiltonian: &str) {
    compare_at::<G, 1>(group, name, hamiltonian);
    compare_at::<G, 2>(group, name, hamiltonian);
    compare_at::<G, 4>(group, name, hamiltonian);
}

#[test]
fn kernels_make_the_steps_of_the_runtime() {
    let root = "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + b^3/10";
    compare(&SO3::new(), "SO3", root);
    compare(&SU2::new(), "SU2", root);
    compare(&SO3::new(), "SO3", "exp(-a/2)/3 + a + b*sin(2*t)/4 + ln(2 + c)*cos(t)");
    let plane = "exp(a/3) + b^2/2 + c^2/3";
    compare(&SE2::new(), "SE2", plane);
    let six = "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + 1/(2 + f^2) + a*d/7";
    compare(&SE3::new(), "SE3", six);
    // By tables.
    compare(&named("SU2"), "SU2", root);
    compare(&named("SE2"), "SE2", plane);
    compare(&named("SE3"), "SE3", six);
    compare(&Heisenberg::new(), "Heisenberg", root);
    compare(&SL2::new(), "SL2", root);
    compare(&SO4::new(), "SO4", six);
    let product = DirectProduct::new(vec![named("SO3"), named("SO3")]);
    compare(&product, "SO3^2", six);
    compare(&Product::<SO3, SE2, 6>::new(), "SO3*SE2", six);
    compare(&SU3::new(), "SU3", "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + g*h/4 + f/3");
}

/// Of steps of all lengths from random momenta, those that a kernel accepts are the runtime's, which accepts them too.
fn accepted<G: LieGroup<Scalar = f64>, const M: usize>(group: &G, name: &str, hamiltonian: &str) {
    let smooth = smooth(name, hamiltonian, 2 * M - 1);
    let step = Origin::from(smooth.clone()).step(Precision::Double).unwrap();
    let symbols = smooth.symbols_at(&[]);
    let energy = AtSymbols(&smooth, &symbols);
    let mut random = Random::new(17);
    let [mut by_kernel, mut by_runtime] = [0, 0];
    for _ in 0..400 {
        let mu: Vec<f64> = (0..group.dim()).map(|_| random.between(-1.0, 1.0)).collect();
        let h = 10_f64.powf(random.between(-1.3, 0.6));
        let mut moved = mu.clone();
        let mut g = vec![0.0; step.kernel().element];
        let slots = step.fold(h, &[]).unwrap();
        let own = step.kernel().attempt(&slots, &mu);
        let mut generic = Collocation::<_, _, M>::new(group.clone(), energy, h).unwrap();
        let mut state = Phase::<G>::new(group.identity(), vector::<G::Vector>(&mu));
        let other = generic.advance(&mut state, 0.0);
        by_runtime += u32::from(other.is_ok());
        if !own.accepted {
            continue;
        }
        by_kernel += 1;
        assert!(other.is_ok(), "{name}, {M} nodes: h = {h}, {mu:?}: {other:?}");
        let transport = &step.kernel().programs.transport;
        g.extend_from_slice(&mu);
        g.extend_from_slice(&own.increment);
        let after = transport.run(&g, &slots);
        moved.copy_from_slice(&after[step.kernel().element..]);
        let apart = moved.iter().zip(list(&state.momentum)).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-11, "{name}, {M} nodes: h = {h}, {mu:?}");
    }
    // The formulas of kernels end at a quarter turn.
    assert!(
        5 * by_kernel > 4 * by_runtime && by_kernel < 400,
        "{name}, {M} nodes: {by_kernel} {by_runtime}"
    );
}

#[test]
fn kernels_accept_what_the_runtime_accepts() {
    let root = "sqrt(1 + a^2/2 + b^2/3 + c^2/5) + b^3/10 + exp(a)/4";
    accepted::<_, 1>(&named("SO3"), "SO3", root);
    accepted::<_, 2>(&named("SO3"), "SO3", root);
    accepted::<_, 3>(&named("SO3"), "SO3", root);
    accepted::<_, 4>(&named("SO3"), "SO3", root);
    accepted::<_, 1>(&SL2::new(), "SL2", root);
    accepted::<_, 3>(&SL2::new(), "SL2", root);
    let six = "sqrt(1 + a^2 + b^2/2 + c^2/3) + exp(d/5) + e^2/3 + 1/(2 + f^2) + a*d/7";
    accepted::<_, 2>(&named("SE3"), "SE3", six);
    accepted::<_, 4>(&named("SE3"), "SE3", six);
}
