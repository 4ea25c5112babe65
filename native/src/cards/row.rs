//! Trajectories on a device, and the steps that it refuses.

use std::time::Duration;

/// The state of a trajectory, and how far it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// The group element, m numbers.
    pub g: Vec<f64>,
    /// μ, n numbers.
    pub mu: Vec<f64>,
    /// Steps made.
    pub made: u64,
    /// Whether it stays where it is.
    pub ended: bool,
}

/// The reason for which a trajectory stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The equation of the next step was not solved.
    Unsolved,
    /// Its solution is far from the first guess.
    Far,
    /// The next step is outside the domain where it is accepted at once.
    Outside,
    /// The state at the end of a block was not finite, or not on the group: it is that before the block.
    Unsound,
}

impl Status {
    pub(crate) fn of(number: u32) -> Option<Self> {
        match number {
            1 => Some(Self::Unsolved),
            2 => Some(Self::Far),
            3 => Some(Self::Outside),
            4 => Some(Self::Unsound),
            _ => None,
        }
    }
}

/// A row of which a thread has refused a step.
#[derive(Debug)]
pub struct Refused<'a> {
    /// Its place among all rows.
    pub place: usize,
    /// Its state before that step.
    pub row: &'a mut Row,
    /// Why.
    pub why: Status,
}

/// Makes the steps that threads have refused: it is given the rows, and the step that it has to move them to, or end
/// them.
pub type Redo<'a> = dyn FnMut(&mut [Refused<'_>], u64) + 'a;

/// The outcome of `Card::advance`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Advanced {
    /// How often a thread refused a step that the caller was then given to make.
    pub refused: u64,
    /// In how many pieces the rows were moved.
    pub pieces: u64,
    /// How often the kernel was started.
    pub launches: u64,
    /// The time the kernel ran.
    pub running: Duration,
}
