//! The loop's variables and programs as a kernel has them.

use alloc::vec::Vec;
use core::ops::Range;

use super::tree::{Part, Variable};
use crate::graph::Program;
use crate::kernel::Kernel;

/// The kind of a variable's contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// An array of this length.
    Array(usize),
    /// A number.
    Number,
    /// A whole number that is not negative. Programs read it as a number.
    Count,
}

impl Variable {
    /// The kind of its contents.
    pub fn kind(self, kernel: &Kernel) -> Kind {
        match self {
            Self::Element => Kind::Array(kernel.element),
            Self::Momentum => Kind::Array(kernel.dim),
            Self::Guess => Kind::Array(kernel.unknowns),
            Self::Increment => Kind::Array(kernel.solution),
            Self::Constants => Kind::Array(kernel.constants()),
            Self::ResidualBound | Self::Distance | Self::Moved | Self::Right => Kind::Number,
            Self::Done | Self::Count | Self::Tried | Self::Flow => Kind::Count,
        }
    }
}

impl Part {
    /// The program in this kernel, if there is one.
    pub fn program(self, kernel: &Kernel) -> Option<&Program> {
        let programs = &kernel.programs;
        match self {
            Self::Guess => Some(&programs.guess),
            Self::Correct => Some(&programs.correct),
            Self::Accept => Some(&programs.accept),
            Self::Transport => Some(&programs.transport),
            Self::Frame => programs.frame.as_ref(),
            Self::Sound => Some(&programs.sound),
            Self::Kick => kernel.kick(),
        }
    }

    /// The variables it reads and those it assigns, in order. All are read before any is assigned.
    pub fn variables(self, kernel: &Kernel) -> (&'static [Variable], &'static [Variable]) {
        use Variable::*;
        match self {
            Self::Guess if kernel.guesses_from_element() => {
                (&[Element, Momentum], &[Guess, Constants])
            }
            Self::Guess => (&[Momentum], &[Guess, Constants]),
            Self::Correct => {
                (&[Guess, Momentum, Constants], &[Guess, Increment, ResidualBound, Moved])
            }
            Self::Accept => (&[Momentum, Increment, ResidualBound, Distance], &[Right]),
            Self::Transport => (&[Element, Momentum, Increment], &[Element, Momentum]),
            Self::Frame => (&[Element, Momentum, Count], &[Element, Momentum]),
            Self::Sound => (&[Element, Momentum], &[Right]),
            Self::Kick => (&[Element, Momentum], &[Momentum]),
        }
    }
}

/// The places of all variables in one list of numbers: g and μ first, then the others.
#[derive(Clone, Debug)]
pub struct Places {
    ranges: Vec<Range<usize>>,
    len: usize,
}

impl Places {
    /// The places for a kernel's variables. A count has one, where programs read it as a number.
    pub fn of(kernel: &Kernel) -> Self {
        let mut len = 0;
        let range = |(variable, _): (Variable, _)| {
            let start = len;
            len += match variable.kind(kernel) {
                Kind::Array(numbers) => numbers,
                Kind::Number | Kind::Count => 1,
            };
            start..len
        };
        let ranges = Variable::ALL.map(range).to_vec();
        Self { ranges, len }
    }

    /// The number of places.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.len
    }

    /// The places of a variable.
    pub fn range(&self, variable: Variable) -> Range<usize> {
        self.ranges[variable as usize].clone()
    }

    /// The places of the state: g, then μ.
    pub fn state(&self) -> Range<usize> {
        self.range(Variable::Element).start..self.range(Variable::Momentum).end
    }
}
