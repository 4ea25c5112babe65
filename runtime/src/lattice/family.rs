//! The families of exact rotations.

use core::fmt;

/// A way to make a step of rotations that are exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Family {
    /// H as a sum of energies that depend on one component of each spin: on the three axes, and on the directions halfway
    /// between them where matrices are not diagonal. Where they are not symmetric, sites of some colours have one axis and those
    /// of the others another.
    Axes {
        /// shift·|s|²/2 is taken from the energy of each site, which moves nothing but changes the error of a step:
        /// [`Lattice::shift`](super::Lattice::shift) makes that of ordered states several times smaller. Zero is right for disordered ones.
        shift: f64,
    },
    /// Each pair turns about the sum of its spins, or about two directions; edges that share no site together.
    Bonds,
    /// Sites that are no neighbours of one another turn in the field of the others. Not symplectic.
    Sublattices,
}

impl fmt::Display for Family {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Axes { .. } => "axes",
            Self::Bonds => "bonds",
            Self::Sublattices => "sublattices",
        })
    }
}
