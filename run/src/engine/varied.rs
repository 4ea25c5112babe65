//! The kernels of steps with tangents, and of their transposes.

use coadjoint_codegen::step::Tangent;

use super::codes::Codes;

/// The kernels of steps with tangents, of their transposes, and their codes, for later runs.
#[derive(Debug)]
pub(super) struct Varied {
    pub forward: (Tangent, Codes),
    /// Where there is one.
    pub backward: Option<(Tangent, Codes)>,
}

/// A kernel of steps with tangents, or of their transposes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sense {
    /// Tangents, from the state before a step to that after it.
    Forward,
    /// Cotangents, the other way.
    Backward,
}

impl Varied {
    /// That of this sense.
    pub(super) fn of(&self, sense: Sense) -> Option<&(Tangent, Codes)> {
        match sense {
            Sense::Forward => Some(&self.forward),
            Sense::Backward => self.backward.as_ref(),
        }
    }
}
