//! The time for an error of Hamiltonians that are no polynomials: collocation beside DOP853, on the same gradients.

use std::time::Instant;

use coadjoint::collocation::Collocation;
use coadjoint::{LieGroup, Phase, SE3, SO3};
use nalgebra::{SVector, Vector3, Vector6};
use ode_solvers::{SVector as Peers, System};

use crate::timing::Failure;
use crate::work::integrate;

/// The end of all runs.
const END: f64 = 1000.0;
/// The errors of the columns.
const TARGETS: [f64; 3] = [1e-6, 1e-8, 1e-10];
/// A reference is converged to this.
const CONVERGED: f64 = 2e-11;

/// An error and the time in seconds that it takes.
type Point = (f64, f64);

/// √(1 + Σ μᵢ²/Iᵢ) + μ₂³/10
fn root(m: &Vector3<f64>) -> Vector3<f64> {
    let v = Vector3::new(m.x * (1.0 / 1.5), m.y * 0.5, m.z * 0.4);
    v / (1.0 + v.dot(m)).sqrt() + Vector3::new(0.0, 0.0, 0.3 * m.z * m.z)
}

/// 3/5 μ₀ + 3/10 exp(4/5 μ₂) + 1/5 exp(−μ₁/2)
fn spin(m: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(0.6, -0.1 * (-0.5 * m.y).exp(), 0.24 * (0.8 * m.z).exp())
}

/// Six variables with 1/√ and exp.
fn six(q: &Vector6<f64>) -> Vector6<f64> {
    let r = (1.0 + q[3] * q[3] + q[4] * q[4] * (2.0 / 3.0) + q[5] * q[5] * 1.5).sqrt();
    let (i, e) = (1.0 / r, (q[5] * (1.0 / 9.0) + q[2] * (1.0 / 11.0)).exp());
    let f = (e - i * i * (2.0 / 3.0)) * i;
    Vector6::new(
        q[0] * (2.0 / 3.0) + q[3] * (1.0 / 7.0),
        q[1] * 0.5,
        q[2] * 0.4 + e * r * (1.0 / 11.0),
        f * q[3] + q[0] * (1.0 / 7.0),
        f * q[4] * (2.0 / 3.0),
        f * q[5] * 1.5 + e * r * (1.0 / 9.0),
    )
}

/// The numbers of an end state that are compared.
trait Ends<const D: usize>: LieGroup<Scalar = f64> {
    fn numbers(state: &Phase<Self>) -> SVector<f64, D>;
}

/// Momentum and attitude, the scalar part of the quaternion not negative.
impl Ends<7> for SO3 {
    fn numbers(state: &Phase<Self>) -> SVector<f64, 7> {
        let (m, q) = (&state.momentum, state.group_element);
        one_sign(SVector::from([m.x, m.y, m.z, q.w, q.i, q.j, q.k]))
    }
}

/// The momentum.
impl Ends<6> for SE3 {
    fn numbers(state: &Phase<Self>) -> SVector<f64, 6> {
        state.momentum
    }
}

fn one_sign(y: SVector<f64, 7>) -> SVector<f64, 7> {
    let sign = 1.0_f64.copysign(y[3]);
    SVector::from_fn(|i, _| if i < 3 { y[i] } else { sign * y[i] })
}

/// μ̇ = μ × ω, q̇ = ½ q (0, ω).
struct Turning<F>(F);

impl<F: Fn(&Vector3<f64>) -> Vector3<f64>> System<f64, Peers<f64, 7>> for Turning<F> {
    fn system(&self, _: f64, y: &Peers<f64, 7>, dy: &mut Peers<f64, 7>) {
        let m = Vector3::new(y[0], y[1], y[2]);
        let w = (self.0)(&m);
        let (t, h, u) = (m.cross(&w), w * 0.5, Vector3::new(y[4], y[5], y[6]));
        let v = h * y[3] + u.cross(&h);
        *dy = Peers::from([t.x, t.y, t.z, -u.dot(&h), v.x, v.y, v.z]);
    }
}

/// μ̇ = ad\*_ω μ.
struct Moving<F>(F);

impl<F: Fn(&Vector6<f64>) -> Vector6<f64>> System<f64, Peers<f64, 6>> for Moving<F> {
    fn system(&self, _: f64, y: &Peers<f64, 6>, dy: &mut Peers<f64, 6>) {
        let m = Vector6::from(y.data.0[0]);
        let slope = SE3::new().ad_star(&(self.0)(&m), &m);
        *dy = Peers::from(slope.data.0[0]);
    }
}

/// The least time of some runs, and where the last came to.
fn timed<R>(rounds: u32, mut run: impl FnMut() -> Result<R, Failure>) -> Result<(f64, R), Failure> {
    let mut best = f64::INFINITY;
    let mut last = run()?;
    for _ in 0..rounds {
        let begun = Instant::now();
        last = run()?;
        best = best.min(begun.elapsed().as_secs_f64());
    }
    Ok((best, last))
}

/// The least time for an error, between the points.
fn at(points: &[Point], error: f64) -> f64 {
    let between = points.windows(2).filter(|w| w[0].0 >= error && w[1].0 <= error).map(|w| {
        let share = (w[0].0 / error).ln() / (w[0].0 / w[1].0).ln();
        (w[0].1.ln() * (1.0 - share) + w[1].1.ln() * share).exp()
    });
    between.fold(f64::NAN, f64::min)
}

/// Runs of `M` nodes in steps from long to short.
fn ours<G, F, const D: usize, const M: usize>(
    group: &G,
    gradient: F,
    start: &Phase<G>,
    exact: &SVector<f64, D>,
    rounds: u32,
) -> Vec<Point>
where
    G: Ends<D>,
    F: Fn(&G::Vector) -> G::Vector + Copy,
{
    let mut points = Vec::new();
    let mut h = 1.2;
    while h > 0.04 {
        let steps = (END / h).ceil();
        let run = || {
            let energy = (|_: f64, _: &G::Vector| 0.0, |_: f64, m: &G::Vector| gradient(m));
            let mut step = Collocation::<_, _, M>::new(group.clone(), energy, END / steps)?;
            let mut state = start.clone();
            step.advance_by(&mut state, 0.0, steps as u64)?;
            Ok(G::numbers(&state))
        };
        if let Ok((time, end)) = timed(rounds, run) {
            points.push(((end - exact).amax(), time));
        }
        if points.last().is_some_and(|point| point.0 < CONVERGED) {
            break;
        }
        h /= 1.2;
    }
    points
}

fn row(name: &str, points: &[Point], beside: &[Point]) {
    let cell = |error: f64| {
        let (own, other) = (at(points, error), at(beside, error));
        format!(" {:.2} ms ({:.2}) |", own * 1e3, own / other)
    };
    println!("| {name} |{}", TARGETS.map(cell).concat());
}

/// One system by DOP853 and by collocation.
fn system<G, F, const D: usize>(
    name: &str,
    group: &G,
    gradient: F,
    momentum: G::Vector,
    peer: impl Fn(f64) -> Result<SVector<f64, D>, Failure>,
    rounds: u32,
) -> Result<(), Failure>
where
    G: Ends<D>,
    F: Fn(&G::Vector) -> G::Vector + Copy,
{
    let start = Phase::<G>::new(group.identity(), momentum);
    let energy = (|_: f64, _: &G::Vector| 0.0, |_: f64, m: &G::Vector| gradient(m));
    let mut reference = start.clone();
    Collocation::<_, _, 8>::new(group.clone(), energy, 0.05)?.advance_by(
        &mut reference,
        0.0,
        (END / 0.05) as u64,
    )?;
    let exact = G::numbers(&reference);
    let mut beside = Vec::new();
    for k in 14..=30 {
        let tolerance = 10_f64.powf(-f64::from(k) / 2.0);
        let (time, end) = timed(rounds, || peer(tolerance))?;
        beside.push(((end - exact).amax(), time));
    }
    row(&format!("{name}, DOP853"), &beside, &beside);
    let four = ours::<G, F, D, 4>(group, gradient, &start, &exact, rounds);
    let five = ours::<G, F, D, 5>(group, gradient, &start, &exact, rounds);
    let six = ours::<G, F, D, 6>(group, gradient, &start, &exact, rounds);
    for (nodes, points) in [(4, four), (5, five), (6, six)] {
        row(&format!("{name}, {nodes} nodes"), &points, &beside);
    }
    Ok(())
}

/// A body with its attitude.
fn body<F>(name: &str, gradient: F, momentum: [f64; 3], rounds: u32) -> Result<(), Failure>
where
    F: Fn(&Vector3<f64>) -> Vector3<f64> + Copy,
{
    let [x, y, z] = momentum;
    let peer = |tolerance| {
        let start = [x, y, z, 1.0, 0.0, 0.0, 0.0];
        integrate(Turning(gradient), start, END, tolerance).map(|y| one_sign(y.into()))
    };
    system::<SO3, _, 7>(name, &SO3::new(), gradient, momentum.into(), peer, rounds)
}

/// Prints the table: milliseconds for an error at T = 1000, and in brackets the ratio to DOP853.
///
/// # Errors
/// Where a run fails.
pub fn table(quick: bool, only: &str) -> Result<(), Failure> {
    let rounds = if quick { 1 } else { 7 };
    println!("| system, method | 1e-6 | 1e-8 | 1e-10 |\n|---|---|---|---|");
    if "root".contains(only) {
        body("root", root, [2.0, 0.5, 1.0], rounds)?;
    }
    if "spin".contains(only) {
        body("spin", spin, [1.2, -0.5, 0.8], rounds)?;
    }
    if "six".contains(only) {
        let start = [0.8, -0.5, 0.6, 0.3, 0.7, -0.4];
        let peer = |tolerance| integrate(Moving(six), start, END, tolerance).map(SVector::from);
        system::<SE3, _, 6>("six", &SE3::new(), six, start.into(), peer, rounds)?;
    }
    Ok(())
}
