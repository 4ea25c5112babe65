//! The velocity of a motion in its Lie algebra.

use std::path::Path;
use std::sync::Arc;

use coadjoint::LieGroup;
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::step::Energy;
use nalgebra::DVector;

use crate::engine::{Torque, group_of, phase_of};
use crate::error::RunError;
use crate::load::System;

/// A state of a time, as numbers.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// t.
    pub time: f64,
    /// The matrix of g, row by row; it is looked at where a potential is damped, and may be empty elsewhere.
    pub matrix: &'a [f64],
    /// μ, n numbers.
    pub momentum: &'a [f64],
}

/// The velocities ξ = g⁻¹ġ at these instants, n numbers each: ω = ∂H/∂μ(t, μ), and with damping ω + Γ (ad\*_ω μ + τ), where τ
/// is the torque of a potential. The system is called `file` in messages.
///
/// # Errors
/// The data defines no group, or a torque is not defined.
pub fn velocities(
    file: &Path,
    system: &System,
    instants: &[Instant<'_>],
) -> Result<Vec<Vec<f64>>, RunError> {
    let (energy, algebra) = (Energy::new(&system.problem), system.problem.facts().algebra);
    let Some(rates) = &system.damping else {
        return Ok(instants.iter().map(|at| energy.gradient(at.time, at.momentum)).collect());
    };
    let potential = system.potential.as_ref().map(|(potential, _)| potential);
    let potential = potential.filter(|potential| potential.alone().is_none());
    let group = Arc::new(group_of(file, algebra, potential.is_some())?);
    let kick = potential.cloned().map(Kick::build);
    let parameters = system.problem.facts().defaults();
    let torque = kick.as_ref().map(|kick| Torque::new(kick, &group, &parameters));
    let torque = torque.transpose().map_err(RunError::unmade)?;
    let damped = |at: &Instant<'_>| {
        let omega = DVector::from_vec(energy.gradient(at.time, at.momentum));
        let mut force = group.ad_star(&omega, &DVector::from_column_slice(at.momentum));
        if let Some(torque) = &torque {
            let state = phase_of(&group, at.matrix, at.momentum);
            let own = torque.torque(&state.group_element, &state.momentum, at.time);
            force += own.map_err(RunError::at(at.time))?;
        }
        let damping = force.iter().zip(rates).map(|(force, rate)| rate * force);
        Ok(omega.iter().zip(damping).map(|(omega, own)| omega + own).collect())
    };
    instants.iter().map(damped).collect()
}
