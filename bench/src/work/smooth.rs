//! Hamiltonians that are no polynomials, by collocation: the same gradients as those of DOP853.

use coadjoint::collocation::Collocation;
use coadjoint::{LieGroup, Phase, SE3, SO3};
use nalgebra::{Vector3, Vector6};

use super::method::{Competitor, Run, equal_steps};
use super::problem::{Dynamics, Problem, State, matrix};
use crate::timing::Failure;

/// √(1 + Σ μᵢ²/Iᵢ) + μ₂³/10
pub fn root(m: &Vector3<f64>) -> Vector3<f64> {
    let v = Vector3::new(m.x * (1.0 / 1.5), m.y * 0.5, m.z * 0.4);
    v / (1.0 + v.dot(m)).sqrt() + Vector3::new(0.0, 0.0, 0.3 * m.z * m.z)
}

/// 3/5 μ₀ + 3/10 exp(4/5 μ₂) + 1/5 exp(−μ₁/2)
pub fn spin(m: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(0.6, -0.1 * (-0.5 * m.y).exp(), 0.24 * (0.8 * m.z).exp())
}

/// Six variables with 1/√ and exp.
pub fn six(q: &Vector6<f64>) -> Vector6<f64> {
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

/// The methods with 4, 5 and 6 nodes.
pub fn methods(problem: &Problem) -> Vec<Competitor> {
    let runs: [Run; 3] = match problem.kind {
        Dynamics::Root | Dynamics::Spin => [body::<4>, body::<5>, body::<6>],
        Dynamics::Six => [motion::<4>, motion::<5>, motion::<6>],
        _ => return Vec::new(),
    };
    let method = |(nodes, run)| {
        let name = format!("collocation, {nodes} nodes");
        Competitor::stepping(name, 2 * nodes, problem.time_scale, run)
    };
    (4_u32..).zip(runs).map(method).collect()
}

/// A body with its attitude.
fn body<const M: usize>(problem: &Problem, step: f64) -> Result<State, Failure> {
    let start = Phase::<SO3>::at_identity(problem.momentum);
    let end = match problem.kind {
        Dynamics::Root => walk::<_, M>(SO3::new(), root, start, problem.end, step)?,
        _ => walk::<_, M>(SO3::new(), spin, start, problem.end, step)?,
    };
    let q = &end.group_element;
    Ok(State::rotating(end.momentum.into(), matrix(&[q.w, q.i, q.j, q.k])))
}

/// The six momenta.
fn motion<const M: usize>(problem: &Problem, step: f64) -> Result<State, Failure> {
    let ([a, b, c], [d, e, f]) = (problem.momentum, problem.force);
    let start = Phase::<SE3>::at_identity([a, b, c, d, e, f]);
    let [a, b, c, d, e, f] =
        walk::<_, M>(SE3::new(), six, start, problem.end, step)?.momentum.into();
    Ok(State { force: [d, e, f], ..State::rotating([a, b, c], [[0.0; 3]; 3]) })
}

/// The end of steps of about this size.
fn walk<G: LieGroup<Scalar = f64>, const M: usize>(
    group: G,
    gradient: impl Fn(&G::Vector) -> G::Vector,
    mut state: Phase<G>,
    end: f64,
    step: f64,
) -> Result<Phase<G>, Failure> {
    let (count, h) = equal_steps(step, end);
    let energy = (|_: f64, _: &G::Vector| 0.0, |_: f64, mu: &G::Vector| gradient(mu));
    Collocation::<_, _, M>::new(group, energy, h)?.advance_by(&mut state, 0.0, count)?;
    Ok(state)
}

/// The problems, whose references are made by 8 nodes in short steps.
pub fn problems(only: &str) -> Result<Vec<Problem>, Failure> {
    let kinds = [
        ("root", "√(1 + Σ μᵢ²/Iᵢ) + μ₂³/10", Dynamics::Root, [2.0, 0.5, 1.0]),
        ("spin", "3/5 μ₀ + 3/10 exp(4/5 μ₂) + 1/5 exp(−μ₁/2)", Dynamics::Spin, [1.2, -0.5, 0.8]),
        ("six", "Six variables with 1/√ and exp", Dynamics::Six, [0.8, -0.5, 0.6]),
    ];
    let problem = |(name, title, kind, momentum)| -> Result<Problem, Failure> {
        let mut problem = Problem {
            name: format!("smooth-{name}"),
            title,
            inverse_inertia: [0.0; 3],
            kind,
            momentum,
            force: [0.3, 0.7, -0.4],
            end: 1000.0,
            reference: State::rotating([0.0; 3], [[0.0; 3]; 3]),
            scale: 1.0,
            time_scale: 0.3,
        };
        if problem.name.contains(only) {
            let run = if kind == Dynamics::Six { motion::<8> } else { body::<8> };
            problem.reference = run(&problem, 0.05)?;
        }
        Ok(problem)
    };
    kinds.into_iter().map(problem).collect()
}
