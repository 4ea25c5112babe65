//! Steps of systems that are read from a file, against the steps that the attribute compiles.
//!
//! `cargo run --release -p coadjoint-bench --bin backends [--features jit]`
//!
//! Nanoseconds a step; every way runs once per round, and the median over the rounds counts. In brackets the ratio to
//! the attribute's code, in the same rounds: `advance`, or its ensembles in lanes.

mod many;
mod measure;
mod one;
mod text;

use std::process::ExitCode;

use coadjoint::groups::{Power, SU3};
use coadjoint::{Phase, SE3, SO3, lie_poisson};

use text::{Text, squares};

type Failure = Box<dyn std::error::Error>;

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SE3, truncation = 7)]
fn heavy_top(mu: [f64; 6], inverse: [f64; 3], weight: f64) -> f64 {
    0.5 * (inverse[0] * mu[0] * mu[0] + inverse[1] * mu[1] * mu[1] + inverse[2] * mu[2] * mu[2])
        + weight * mu[5]
}

// Numbers in place of parameters: with these the series has a hundred times as many terms.
#[lie_poisson(group = SE3, truncation = 9)]
fn kirchhoff(mu: [f64; 6]) -> f64 {
    0.5 * (mu[0] * mu[0] + 0.5 * mu[1] * mu[1] + 0.25 * mu[2] * mu[2])
        + 0.5 * (mu[3] * mu[3] + 0.5 * mu[4] * mu[4] + 0.25 * mu[5] * mu[5])
}

#[lie_poisson(group = SU3, truncation = 5)]
fn quadratic(mu: [f64; 8]) -> f64 {
    0.5 * (mu[0] * mu[0] + 0.8 * mu[1] * mu[1] + 0.625 * mu[2] * mu[2] + 0.5 * mu[3] * mu[3])
        + 0.5 * (0.4 * mu[4] * mu[4] + 0.3125 * mu[5] * mu[5] + 0.25 * mu[6] * mu[6])
        + 0.1 * mu[7] * mu[7]
}

#[lie_poisson(group = SO3^4, truncation = 5)]
fn ring(mu: [f64; 12], j: f64) -> f64 {
    let mut sum = 0.0;
    for site in 0..4 {
        for axis in 0..3 {
            sum -= j * mu[3 * site + axis] * mu[(3 * site + axis + 3) % 12];
        }
    }
    sum
}

fn run() -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let text = |name, group, hamiltonian, truncation, step, momentum: &[f64]| Text {
        name,
        group,
        hamiltonian,
        truncation,
        step,
        momentum: momentum.to_vec(),
    };
    let body = [2.0, 0.5, 1.0];
    let rigid = text("rigid body, K = 7", "SO3", squares(&[0.8, 0.5, 0.4]), 7, 0.1, &body);
    let rigid_body = RigidBody::new(0.1, [1.25, 2.0, 2.5])?;
    one::row(&rigid, &rigid_body, Phase::<SO3>::at_identity(body))?;
    let top = [0.3, -0.2, 2.0, 0.1, 0.2, 0.97];
    let weights = squares(&[0.8, 0.5, 0.4]);
    let heavy = text("heavy top, K = 7", "SE3", format!("{weights} + 0.981*m5"), 7, 0.05, &top);
    let heavy_top = HeavyTop::new(0.05, [0.8, 0.5, 0.4], 0.981)?;
    one::row(&heavy, &heavy_top, Phase::<SE3>::at_identity(top))?;
    let fluid = [1.0, 0.5, 0.2, 0.3, 0.4, 0.5];
    one::row(
        &text(
            "Kirchhoff, K = 9",
            "SE3",
            squares(&[1.0, 0.5, 0.25, 1.0, 0.5, 0.25]),
            9,
            0.1,
            &fluid,
        ),
        &Kirchhoff::new(0.1)?,
        Phase::<SE3>::at_identity(fluid),
    )?;
    let colours = [0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5];
    let w = [1.0, 0.8, 0.625, 0.5, 0.4, 0.3125, 0.25, 0.2];
    one::row(
        &text("su(3), K = 5", "SU3", squares(&w), 5, 0.1, &colours),
        &Quadratic::new(0.1)?,
        Phase::<SU3>::at_identity(colours),
    )?;
    let spins = [0.6, 0.0, 0.8, 0.0, 0.8, 0.6, -0.48, 0.64, 0.6, 0.36, -0.48, -0.8];
    let term = |i: usize| format!("-m{i}*m{}", (i + 3) % 12);
    let exchange = (0..12).map(term).collect::<Vec<_>>().join(" ");
    one::row(
        &text("ring of four spins, K = 5", "SO3^4", exchange, 5, 0.05, &spins),
        &Ring::new(0.05, 1.0)?,
        Phase::<Power<SO3, 4, 12>>::at_identity(spins),
    )?;
    println!("\nEnsembles of {} on one core, {} steps each:\n", many::BODIES, many::STEPS);
    many::row(&rigid, &rigid_body)?;
    many::row(&heavy, &heavy_top)?;
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
