//! The velocity of a motion in its Lie algebra.

use coadjoint_codegen::step::Energy;

use crate::load::System;

/// A state of a time, as numbers.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// t.
    pub time: f64,
    /// The matrix of g, row by row; it is looked at where a velocity reads it, and may be empty elsewhere.
    pub matrix: &'a [f64],
    /// μ, n numbers.
    pub momentum: &'a [f64],
}

/// The velocities ξ = g⁻¹ġ at these instants, n numbers each: ω + η with ω = ∂H/∂μ(t, μ) and the velocity η of the system's drive.
pub fn velocities(system: &System, instants: &[Instant<'_>]) -> Vec<Vec<f64>> {
    let energy = Energy::new(&system.problem);
    let symbols = system.problem.symbols();
    let driven = system.problem.smooth().filter(|smooth| smooth.drive.is_some());
    let velocity = |at: &Instant<'_>| {
        let omega = energy.gradient(at.time, at.momentum);
        let Some(smooth) = driven else { return omega };
        let [own, _] = smooth.acting(&symbols, at.time, at.matrix, [at.momentum, &omega]);
        omega.iter().zip(own).map(|(omega, own)| omega + own).collect()
    };
    instants.iter().map(velocity).collect()
}
