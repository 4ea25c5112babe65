//! Mistakes in a lattice, and steps that cannot be made.

use super::family::Family;
use crate::error::{StepError, Stopped};

/// An error in the description of a lattice, in a state, or of a step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LatticeError {
    /// A length of the shape is zero.
    #[error("axis {axis} of the lattice has length 0: every length must be at least 1")]
    EmptyAxis {
        /// The axis, from 0.
        axis: usize,
    },
    /// The lattice has more sites or edges than can be numbered.
    #[error("the lattice has too many sites or edges: at most {most} of either can be numbered")]
    TooLarge {
        /// The largest number of sites, and of edges.
        most: usize,
    },
    /// The offset of a bond does not have one number for each axis.
    #[error("the offset has {found} numbers, and the lattice {expected} axes")]
    Offset {
        /// The axes of the lattice.
        expected: usize,
        /// The numbers of the offset.
        found: usize,
    },
    /// A site of the cell, or of an edge, does not exist.
    #[error("there is no site {site}: sites are numbered from 0 to {last}", last = sites.saturating_sub(1))]
    NoSite {
        /// The number given.
        site: usize,
        /// The number of sites.
        sites: usize,
    },
    /// An edge joins a site with itself.
    #[error("an edge joins site {site} with itself; an energy of one site is given by `site`")]
    SelfEdge {
        /// The site.
        site: usize,
    },
    /// A bond joins two sites twice.
    #[error(
        "a bond joins sites {} and {} twice, as a periodic axis of length 2 does: double its energy, or open the axis",
        edge[0], edge[1]
    )]
    DuplicateEdge {
        /// The sites.
        edge: [usize; 2],
    },
    /// A bond joins no two sites.
    #[error(
        "the bond joins no sites: it leads out of the open lattice everywhere, or the graph has no edges"
    )]
    NoEdges,
    /// An entry of a coupling, a field or an anisotropy is infinite or not a number.
    #[error("a coefficient of the energy is not finite")]
    Coefficient,
    /// A list of factors has the wrong length.
    #[error(
        "there are {found} factors, and {expected} are needed: one a site, or one an edge of the bond"
    )]
    Factors {
        /// The sites of the lattice, or the edges of the bond.
        expected: usize,
        /// The factors given.
        found: usize,
    },
    /// Exact rotations are of the energy alone.
    #[error("{family} are of the energy alone: damping and a velocity are made by `gauss`")]
    NotAdmitted {
        /// The family.
        family: Family,
    },
    /// A state has the wrong number of spins.
    #[error("the state has {found} spins, and the lattice {expected} sites")]
    Sites {
        /// The sites of the lattice.
        expected: usize,
        /// The spins given.
        found: usize,
    },
    /// A spin is infinite or not a number.
    #[error("the spin of site {site} is not finite")]
    NonFinite {
        /// The site.
        site: usize,
    },
    /// A spin turns too far in a step for its nodes. The state is the one after the last step that was made.
    #[error(
        "after {steps} steps: a spin turns by {angle:.1} rad in a step, and at most half a turn is accepted; take a smaller step"
    )]
    TooLong {
        /// Steps made.
        steps: u64,
        /// The largest angle that a spin turns by at the speed it has at a node.
        angle: f64,
    },
    /// A step could not be made. The state is the one after the last step that was made.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// Refuses coefficients that are not finite.
pub(super) fn finite(numbers: &[f64]) -> Result<(), LatticeError> {
    let all = numbers.iter().all(|number| number.is_finite());
    if all { Ok(()) } else { Err(LatticeError::Coefficient) }
}

/// Refuses factors of another number, and those that are not finite.
pub(super) fn check_factors(factors: &[f64], expected: usize) -> Result<(), LatticeError> {
    let found = factors.len();
    if found == expected { finite(factors) } else { Err(LatticeError::Factors { expected, found }) }
}

/// Refuses a step that is zero or not finite.
pub(super) fn check_step(step: f64) -> Result<(), LatticeError> {
    if step != 0.0 && step.is_finite() {
        return Ok(());
    }
    Err(Stopped { steps: 0, error: StepError::InvalidStep { step } }.into())
}

/// Refuses a state that is not one finite spin a site.
pub(super) fn check_spins(sites: usize, spins: &[[f64; 3]]) -> Result<(), LatticeError> {
    if spins.len() != sites {
        return Err(LatticeError::Sites { expected: sites, found: spins.len() });
    }
    let bad = spins.iter().position(|spin| spin.iter().any(|number| !number.is_finite()));
    bad.map_or(Ok(()), |site| Err(LatticeError::NonFinite { site }))
}
