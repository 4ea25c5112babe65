//! Six systems by the attribute, each the same as an example file.

use std::hint::black_box;

use coadjoint::groups::{Power, SO4, SU3};
use coadjoint::lanes::ensemble::advance_all;
use coadjoint::{Phase, SE3, SO3, lie_poisson};
use nalgebra::SVector;

use crate::timing::{Contender, Failure, line, medians};

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3]) -> f64 {
    mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0
}

#[lie_poisson(group = SE3, truncation = 7)]
fn heavy_top(mu: [f64; 6]) -> f64 {
    mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0 + 0.981 * mu[5]
}

#[lie_poisson(group = SE3, truncation = 9)]
fn kirchhoff_body(mu: [f64; 6]) -> f64 {
    let [x, y, z, px, py, pz] = mu;
    x * x / 2.0 + y * y / 4.0 + z * z / 6.0 + px * px / 2.0 + py * py / 4.0 + pz * pz / 8.0
}

#[lie_poisson(group = SO3^4, truncation = 3)]
fn spin_ring(mu: [f64; 12]) -> f64 {
    let mut sum = 0.0;
    for site in 0..4 {
        for axis in 0..3 {
            sum -= mu[3 * site + axis] * mu[(3 * site + axis + 3) % 12];
        }
        sum += 0.3 * mu[3 * site + 2] * mu[3 * site + 2] - 0.5 * mu[3 * site + 2];
    }
    sum
}

#[lie_poisson(group = SO4, truncation = 5)]
fn manakov(mu: [f64; 6]) -> f64 {
    let [a, b, c, d, e, f] = mu;
    a * a / 6.0 + b * b / 8.0 + c * c / 10.0 + d * d / 10.0 + e * e / 12.0 + f * f / 14.0
}

#[lie_poisson(group = SU3, truncation = 5)]
fn quadratic(mu: [f64; 8]) -> f64 {
    let [a, b, c, d, e, f, g, h] = mu;
    a * a / 2.0
        + b * b / 2.5
        + c * c / 3.2
        + d * d / 4.0
        + e * e / 5.0
        + f * f / 6.4
        + g * g / 8.0
        + h * h / 10.0
}

type Made = Result<Vec<Contender<'static>>, Failure>;

pub struct Workload {
    pub name: &'static str,
    /// The example file.
    pub file: &'static str,
    /// K.
    pub truncation: usize,
    /// h.
    pub step: f64,
    /// μ at the start.
    pub momentum: &'static [f64],
    /// `advance` and `advance_by`.
    pub single: fn(f64, &[f64]) -> Made,
    /// Many trajectories in lanes, from momenta one after the other; a step is that of one trajectory.
    pub lanes: fn(f64, Vec<f64>) -> Made,
    /// The momentum after 1000 steps, by which two versions of this program compare.
    pub end: fn(f64, &[f64]) -> Result<Vec<f64>, Failure>,
}

/// The ways of one system.
macro_rules! system {
    ($name:literal, $file:literal, $k:literal, $h:literal, $step:ident, $group:ty, $n:literal, $mu:expr) => {
        Workload {
            name: $name,
            file: concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/", $file, ".toml"),
            truncation: $k,
            step: $h,
            momentum: $mu,
            single: |h, mu| {
                let start = Phase::<$group>::at_identity(SVector::<f64, $n>::from_column_slice(mu));
                let (mut one, mut many) = (start.clone(), start);
                let (step, by) = ($step::<f64>::new(h)?, $step::<f64>::new(h)?);
                let advance = move |steps| {
                    for _ in 0..steps {
                        step.advance(&mut one)?;
                    }
                    black_box(&one);
                    Ok(())
                };
                let advance_by = move |steps| {
                    black_box(by.advance_by(&mut many, steps)?);
                    Ok(())
                };
                Ok(vec![
                    Contender::new("advance", 1, advance),
                    Contender::new("advance_by", 1, advance_by),
                ])
            },
            lanes: |h, momenta| {
                let step = $step::<f64>::new(h)?;
                let phase =
                    |mu| Phase::<$group>::at_identity(SVector::<f64, $n>::from_column_slice(mu));
                let mut states: Vec<_> = momenta.chunks_exact($n).map(phase).collect();
                let bodies = states.len();
                let advance =
                    move |steps| match black_box(advance_all(&step, &mut states, steps)).len() {
                        0 => Ok(()),
                        refused => Err(format!("{refused} trajectories were refused").into()),
                    };
                Ok(vec![Contender::new("attribute, lanes", bodies, advance)])
            },
            end: |h, mu| {
                let mut phase =
                    Phase::<$group>::at_identity(SVector::<f64, $n>::from_column_slice(mu));
                let step = $step::<f64>::new(h)?;
                for _ in 0..1000 {
                    step.advance(&mut phase)?;
                }
                Ok(phase.momentum.as_slice().to_vec())
            },
        }
    };
}

pub const SYSTEMS: [Workload; 6] = [
    system!("rigid body, K = 7", "rigid_body", 7, 0.1, RigidBody, SO3, 3, &[2.0, 0.5, 1.0]),
    system!(
        "heavy top, K = 7",
        "heavy_top",
        7,
        0.05,
        HeavyTop,
        SE3,
        6,
        &[0.3, -0.2, 2.0, 0.1, 0.2, 0.97]
    ),
    system!(
        "Kirchhoff, K = 9",
        "kirchhoff_body",
        9,
        0.1,
        KirchhoffBody,
        SE3,
        6,
        &[1.0, 0.5, 0.2, 0.3, 0.4, 0.5]
    ),
    system!(
        "spin ring, K = 3",
        "heisenberg_spin_ring",
        3,
        0.05,
        SpinRing,
        Power<SO3, 4, 12>,
        12,
        &[0.6, 0.0, 0.8, 0.0, 0.8, 0.6, -0.48, 0.64, 0.6, 0.36, -0.48, -0.8]
    ),
    system!(
        "Manakov so(4), K = 5",
        "manakov_so4",
        5,
        0.1,
        Manakov,
        SO4,
        6,
        &[0.5, -0.3, 0.8, 0.2, -0.6, 0.4]
    ),
    system!(
        "su(3), K = 5",
        "su3_quadratic",
        5,
        0.1,
        Quadratic,
        SU3,
        8,
        &[0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5]
    ),
];

/// This many momenta of a system, one after the other, each a little larger than the one before.
pub fn momenta(system: &Workload, count: usize) -> Vec<f64> {
    let size = |i: usize| 1.0 + 0.2 * i as f64 / count as f64;
    (0..count).flat_map(|i| system.momentum.iter().map(move |mu| mu * size(i))).collect()
}

const BODIES: usize = 1024;
/// Systems that are tried in lanes: the first ones.
const IN_LANES: usize = 2;

/// Prints nanoseconds a step; the ratio is to `advance`.
pub fn table(quick: bool, only: &str) -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    println!("Nanoseconds a step (in lanes: of one trajectory), and the ratio to `advance`:\n");
    for (number, system) in SYSTEMS.iter().enumerate() {
        if !system.name.contains(only) {
            continue;
        }
        let mut ways = (system.single)(system.step, system.momentum)?;
        if number < IN_LANES {
            ways.extend((system.lanes)(system.step, momenta(system, BODIES))?);
        }
        let found = medians(&mut ways, if quick { 7 } else { 31 })?;
        let end = (system.end)(system.step, system.momentum)?;
        let digits = |x: &f64| format!("{x:.12}");
        let end: Vec<String> = end.iter().map(digits).collect();
        println!("{} after 1000 steps: {} |", line(system.name, &ways, &found), end.join(", "));
    }
    Ok(())
}
