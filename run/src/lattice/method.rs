//! The methods of steps of a lattice.

use coadjoint::lattice::{Family, Order};

/// The method of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Algorithm {
    /// Exact rotations.
    Rotations(Family, Order),
    /// Gauss's method with this number of nodes, 1 to 4.
    Gauss(usize),
}

impl Algorithm {
    /// The order of accuracy.
    #[must_use]
    pub fn order(self) -> u32 {
        match self {
            Self::Rotations(_, order) => order.number(),
            Self::Gauss(nodes) => 2 * nodes as u32,
        }
    }

    /// The name of the family, or `collocation`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Rotations(family, _) => family.to_string(),
            Self::Gauss(_) => "collocation".to_owned(),
        }
    }

    /// The method in words, with what it does not keep.
    #[must_use]
    pub fn label(self) -> String {
        let (name, order) = (self.name(), self.order());
        match self {
            Self::Rotations(Family::Sublattices, _) => {
                format!(
                    "{name}, order {order}, not symplectic; the energy is exact without anisotropy"
                )
            }
            _ => format!("{name}, order {order}"),
        }
    }
}
