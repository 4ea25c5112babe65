//! The splittings that files name.

use coadjoint_program::splitting::{self, PRK4, PRK6, RKN4, RKN6, STRANG};

/// A palindromic sequence of kicks and flows, starting and ending with a kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Splitting {
    /// Half a kick, the flow, half a kick: order 2.
    Strang,
    /// Order 4 in six flows, for Hamiltonians of degree at most two (RKN₆ᵇ).
    Rkn4,
    /// Order 6 in eleven flows, for Hamiltonians of degree at most two (RKN₁₁ᵇ).
    Rkn6,
    /// Order 4 in six flows (S₆).
    Prk4,
    /// Order 6 in ten flows (S₁₀).
    Prk6,
}

impl Splitting {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Strang, Self::Rkn4, Self::Rkn6, Self::Prk4, Self::Prk6];

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.known().0
    }

    /// The order of accuracy.
    #[must_use]
    pub fn order(self) -> u32 {
        self.known().1.order
    }

    /// The lengths of the kicks of a step, as parts of it.
    #[must_use]
    pub fn kicks(self) -> Vec<f64> {
        let lengths = self.known().1;
        (0..=lengths.stages).map(|i| lengths.kicks[i.min(lengths.stages - i)]).collect()
    }

    /// The lengths of the flows of a step, as parts of it; kicks are one more.
    #[must_use]
    pub fn flows(self) -> Vec<f64> {
        let lengths = self.known().1;
        (0..lengths.stages).map(|i| lengths.flows[i.min(lengths.stages - 1 - i)]).collect()
    }

    fn known(self) -> (&'static str, splitting::Splitting) {
        match self {
            Self::Strang => ("strang", STRANG),
            Self::Rkn4 => ("rkn4", RKN4),
            Self::Rkn6 => ("rkn6", RKN6),
            Self::Prk4 => ("prk4", PRK4),
            Self::Prk6 => ("prk6", PRK6),
        }
    }
}
