//! The places of a step's numbers in memory: one frame on the stack of the function that runs the loop.

use std::ops::Range;

use coadjoint_program::Kernel;
use coadjoint_program::schedule::{Kept, Places, Variable};

use super::error::JitError;

/// Bytes that a frame may take.
const MOST: usize = 1 << 18;

/// Places of a frame, counted in numbers (or groups of lanes).
#[derive(Clone, Debug)]
pub(super) struct Frame {
    variables: Places,
    /// Where g, then μ, are kept: at the start of the block, and of a step with kicks.
    kept: Range<usize>,
    /// All of them.
    size: usize,
    /// Where programs keep values that have no register, one program after the other.
    scratch: usize,
}

impl Frame {
    pub(super) fn of(kernel: &Kernel) -> Self {
        let variables = Places::of(kernel);
        let states = if kernel.flows().is_some() { 2 } else { 1 };
        let kept = variables.len()..variables.len() + states * variables.state().len();
        let size = kept.end;
        Self { variables, kept, size, scratch: size }
    }

    /// Its size in bytes, for numbers of this size.
    pub(super) fn bytes(&self, each: usize) -> Result<u32, JitError> {
        let bytes = self.size.saturating_mul(each);
        match u32::try_from(bytes) {
            Ok(fits) if bytes <= MOST => Ok(fits),
            _ => Err(JitError::Large { bytes, most: MOST }),
        }
    }

    /// One more place for a value that has no register.
    pub(super) fn scratch(&mut self) -> usize {
        self.scratch += 1;
        self.size = self.size.max(self.scratch);
        self.scratch - 1
    }

    /// Forgets the values that have no register.
    pub(super) fn clear(&mut self) {
        self.scratch = self.kept.end;
    }

    /// Where a variable's numbers are; those of a count, where programs read it.
    pub(super) fn places(&self, variable: Variable) -> Range<usize> {
        self.variables.range(variable)
    }

    /// Where g and μ are kept.
    pub(super) fn kept(&self, kept: Kept) -> usize {
        self.kept.start + kept as usize * self.state().len()
    }

    /// Where g and μ are.
    pub(super) fn state(&self) -> Range<usize> {
        self.variables.state()
    }

    /// The variable of number i of a list, and where that number is.
    pub(super) fn find(&self, list: &[Variable], i: usize) -> Option<(Variable, usize)> {
        let mut before = 0;
        list.iter().find_map(|&variable| {
            let places = self.places(variable);
            let at = places.start + i - before;
            before += places.len();
            (i < before).then_some((variable, at))
        })
    }
}
