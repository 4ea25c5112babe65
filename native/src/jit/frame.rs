//! Where the numbers of a step lie in memory: one frame on the stack of the function that runs the loop.

use std::ops::Range;

use coadjoint_program::{Kernel, Program};

use super::JitError;

/// Bytes that a frame may take.
const MOST: usize = 1 << 18;

/// Places of a frame, counted in numbers (or groups of lanes).
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// n and m of the kernel.
    pub(super) dim: usize,
    pub(super) element: usize,
    /// g (m), then μ (n).
    pub(super) state: usize,
    /// The same at the start of the block.
    pub(super) start: usize,
    /// p (n).
    pub(super) p: usize,
    /// The constants of the solve (k).
    pub(super) constants: Range<usize>,
    /// x (n).
    pub(super) x: usize,
    /// What is left of the equation.
    pub(super) left: usize,
    /// The way from the guess.
    pub(super) way: usize,
    /// Steps made in the block.
    pub(super) times: usize,
    /// All of them.
    places: usize,
    /// Where programs keep values that have no register, one program after the other.
    scratch: usize,
}

impl Frame {
    pub(super) fn of(kernel: &Kernel) -> Self {
        let (n, m, k) = (kernel.dim(), kernel.element(), kernel.constants());
        let start = m + n;
        let p = start + m + n;
        let constants = p + n..p + n + k;
        let x = constants.end;
        let left = x + n;
        Self {
            dim: n,
            element: m,
            state: 0,
            start,
            p,
            constants,
            x,
            left,
            way: left + 1,
            times: left + 2,
            places: left + 3,
            scratch: left + 3,
        }
    }

    /// The bytes it takes, numbers being of so many each.
    pub(super) fn bytes(&self, each: usize) -> Result<u32, JitError> {
        let bytes = self.places.saturating_mul(each);
        match u32::try_from(bytes) {
            Ok(fits) if bytes <= MOST => Ok(fits),
            _ => Err(JitError::Large { bytes, most: MOST }),
        }
    }

    /// One more place for a value that has no register.
    pub(super) fn scratch(&mut self) -> usize {
        self.scratch += 1;
        self.places = self.places.max(self.scratch);
        self.scratch - 1
    }

    /// Forgets the values that have no register.
    pub(super) fn clear(&mut self) {
        self.scratch = self.times + 1;
    }

    fn mu(&self) -> usize {
        self.state + self.element
    }

    /// Where input number i of a program is.
    pub(super) fn input(&self, part: Part, i: usize) -> usize {
        let (n, m) = (self.dim, self.element);
        match part {
            Part::Guess => self.mu() + i,
            Part::Correct if i < n => self.p + i,
            Part::Correct if i < 2 * n => self.mu() + i - n,
            Part::Correct => self.constants.start + i - 2 * n,
            // x is followed by what is left, then by the way.
            Part::Accept if i < n => self.mu() + i,
            Part::Accept => self.x + i - n,
            Part::Transport if i < m + n => self.state + i,
            Part::Transport => self.x + i - m - n,
            Part::Frame if i < m + n => self.state + i,
            Part::Frame => self.times,
            Part::Sound => self.state + i,
        }
    }
}

/// The programs of a step that run in its loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Guess,
    Correct,
    Accept,
    Transport,
    Frame,
    Sound,
}

impl Part {
    /// Its program in this kernel.
    pub(super) fn program(self, kernel: &Kernel) -> Option<&Program> {
        let programs = kernel.programs();
        match self {
            Self::Guess => Some(&programs.guess),
            Self::Correct => Some(&programs.correct),
            Self::Accept => Some(&programs.accept),
            Self::Transport => Some(&programs.transport),
            Self::Frame => programs.frame.as_ref(),
            Self::Sound => Some(&programs.sound),
        }
    }
}
