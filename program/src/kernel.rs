//! A whole step as programs, and the loop that drives them.
//!
//! The loop is one tree of statements ([`Kernel::schedule`]), which the interpreter walks and every target prints or
//! compiles:
//!
//! ```text
//! for each step
//!     (p, k) = guess(μ)
//!     distance = 0
//!     do   (p, x, residual_bound, moved) = correct(p, μ, k);  distance = distance + moved
//!     while not residual_bound ≤ tolerance, and distance ≤ near, and more corrections are allowed
//!     if accept(μ, x, residual_bound, distance) is not 1: stop before this step
//!     (g, μ) = transport(g, μ, x)
//! after each BLOCK steps and at the end
//!     (g, μ) = frame(g, μ, steps of the block)      where there is a comoving frame
//!     if sound(g, μ) is not 1: back to the start of the block, stop
//! ```
//!
//! If a potential breaks the symmetry, a step is a sequence of kicks and flows that begins and ends with a kick. Each flow
//! has folded coefficients of its own, those of its length, and so has the last kick:
//!
//! ```text
//! for each flow: μ = kick(g, μ), then as above from guess to transport, with the coefficients of the flow
//! μ = kick(g, μ)
//! ```
//!
//! A refused step leaves the state as it was; whoever drives the kernel may then follow the solution by other means or
//! say why there is none.

use alloc::vec::Vec;
use core::fmt;
use core::ops::Deref;

use crate::graph::Program;
use crate::schedule::{Block, schedule};

/// The programs of a step. n is the dimension, m how many numbers make a group element, u how many are solved for, v how many
/// a solution is read as, k how many constants a solve has. A series is solved for p (u = n) and read as x (v = n).
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    /// μ (n), or g (m) and μ (n), ↦ a first guess of p (u), and the constants of the solve (k).
    pub guess: Program,
    /// p (u), μ (n), constants (k) ↦ the next p (u), x (v), a bound on the residual of the equation (1), the length of
    /// the correction (1), both relative to the largest coordinate of μ.
    pub correct: Program,
    /// μ (n), x (v), the residual bound (1), the distance from the guess (1) ↦ 1 if the step is right, else 0.
    pub accept: Program,
    /// g (m), μ (n), x (v) ↦ g·τ(x) (m), Ad\*_{τ(x)⁻¹} μ (n).
    pub transport: Program,
    /// g (m), μ (n), a number of steps (1) ↦ both moved on by the comoving frame.
    pub frame: Option<Program>,
    /// g (m), μ (n) ↦ 1 if finite and on the group, else 0.
    pub sound: Program,
    /// g (m), μ (n) ↦ the energy, then the Casimirs of low degree that are conserved.
    pub watch: Program,
    /// g (m) ↦ the matrix of g, row by row.
    pub matrix: Program,
}

/// The programs of a kernel and the limits of its solve, which [`Kernel::new`] checks.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelParts {
    /// n, the dimension of the group.
    pub dim: usize,
    /// m, how many numbers make a group element, with those that its steps leave to the next one.
    pub element: usize,
    /// u, how many numbers are solved for.
    pub unknowns: usize,
    /// v, how many numbers a solution is read as, the increment x and whatever else of it is needed.
    pub solution: usize,
    /// The residual bound, relative to the largest coordinate of μ, at which a solve ends; less than 1.
    pub tolerance: f64,
    /// The distance from the first guess, relative to the largest coordinate of μ, beyond which a solve is given up; not
    /// negative.
    pub near: f64,
    /// The corrections after which a solve is given up.
    pub corrections: u32,
    /// The programs.
    pub programs: Programs,
}

/// A step of a system on its group, for every target: [`KernelParts`] that fit together, which are read through it.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    parts: KernelParts,
    constants: usize,
    slots: usize,
    precision: Precision,
    kicks: Option<Kicks>,
    clock: Option<Clock>,
    schedule: Block,
}

impl Deref for Kernel {
    type Target = KernelParts;

    fn deref(&self) -> &KernelParts {
        &self.parts
    }
}

/// The times at which the programs of a step that depends on time ask for it: coefficients after those that are folded.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// The place of the size of a step among the coefficients.
    pub size: usize,
    /// The place of the first time, after which the others are.
    pub first: usize,
    /// The times, from the beginning of a step on, in its lengths.
    pub times: Vec<f64>,
    /// The time at which the first step of a trajectory begins, where the programs count its steps.
    pub start: f64,
}

/// Kicks between the flows of a step.
#[derive(Clone, Debug, PartialEq)]
struct Kicks {
    kick: Program,
    flows: u32,
}

impl Kernel {
    /// A step of these parts.
    ///
    /// # Errors
    /// [`ProgramError::Shape`] where a program has not the inputs and outputs that n and m ask for,
    /// [`ProgramError::Limits`] where `tolerance` is not below 1 or `near` is negative.
    pub fn new(parts: KernelParts) -> Result<Self, ProgramError> {
        let KernelParts { dim: n, element: m, unknowns: u, solution: v, .. } = parts;
        let KernelParts { tolerance, near, corrections, ref programs, .. } = parts;
        let constants = programs.guess.outputs().len().saturating_sub(u);
        let of_state = programs.guess.inputs() == m + n;
        let guessed_from = if of_state { m + n } else { n };
        let watched = programs.watch.outputs().len();
        let entries = programs.matrix.outputs().len();
        let shapes = [
            ("guess", &programs.guess, (guessed_from, u + constants)),
            ("correct", &programs.correct, (u + n + constants, u + v + 2)),
            ("accept", &programs.accept, (n + v + 2, 1)),
            ("transport", &programs.transport, (m + n + v, m + n)),
            ("sound", &programs.sound, (m + n, 1)),
            ("watch", &programs.watch, (m + n, watched)),
            ("matrix", &programs.matrix, (m, entries)),
        ];
        let frame = programs.frame.iter().map(|frame| ("frame", frame, (m + n + 1, m + n)));
        let mut slots = 0;
        for (name, program, expected) in shapes.into_iter().chain(frame) {
            let found = (program.inputs(), program.outputs().len());
            if found != expected {
                return Err(ProgramError::Shape { program: name, expected, found });
            }
            slots = slots.max(program.slots());
        }
        // Loops begin with the residual bound 1 and the distance 0.
        if !(tolerance < 1.0 && near >= 0.0) {
            return Err(ProgramError::Limits);
        }
        let schedule = schedule(corrections, programs.frame.is_some(), None);
        let (precision, kicks, clock) = (Precision::Double, None, None);
        Ok(Self { parts, constants, slots, precision, kicks, clock, schedule })
    }

    /// Adds kicks between the `flows` flows of a step: `kick` is g (m), μ (n) ↦ the kicked μ (n). All programs then read the
    /// coefficients of a flow, or those of the last kick.
    ///
    /// # Errors
    /// [`ProgramError::Shape`] if `kick` has other inputs and outputs.
    pub fn with_kicks(self, kick: Program, flows: u32) -> Result<Self, ProgramError> {
        let (n, m) = (self.dim, self.element);
        let (expected, found) = ((m + n, n), (kick.inputs(), kick.outputs().len()));
        if found != expected {
            return Err(ProgramError::Shape { program: "kick", expected, found });
        }
        let slots = self.slots.max(kick.slots());
        let schedule = schedule(self.corrections, self.programs.frame.is_some(), Some(flows));
        Ok(Self { slots, kicks: Some(Kicks { kick, flows }), schedule, ..self })
    }

    /// Lets the programs read these times, the only coefficients that change from step to step.
    #[must_use]
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { clock: Some(clock), ..self }
    }

    /// Sets the time at which the first step of a trajectory begins.
    #[must_use]
    pub fn starting_at(self, start: f64) -> Self {
        let clock = self.clock.map(|clock| Clock { start, ..clock });
        Self { clock, ..self }
    }

    /// Changes the length of the numbers; the tolerance follows their rounding.
    #[must_use]
    pub fn in_precision(self, precision: Precision) -> Self {
        let tolerance = self.tolerance / self.precision.epsilon() * precision.epsilon();
        Self { precision, parts: KernelParts { tolerance, ..self.parts }, ..self }
    }

    /// The numbers that the programs are made for. The interpreter and machine code evaluate them in 64 bits all the
    /// same.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// k, how many constants a solve has.
    pub(crate) fn constants(&self) -> usize {
        self.constants
    }

    /// True if a guess reads g, in which steps leave numbers for the next one, and not μ alone.
    pub fn guesses_from_element(&self) -> bool {
        self.programs.guess.inputs() != self.dim
    }

    /// The number of folded coefficients of a step; with kicks those of every flow and of the last kick.
    pub fn slots(&self) -> usize {
        self.slots * self.flows().map_or(1, |flows| flows as usize + 1)
    }

    /// The number of folded coefficients that programs read in one flow.
    pub fn slots_of_flow(&self) -> usize {
        self.slots
    }

    /// The flows between the kicks of a step, where it has kicks.
    pub fn flows(&self) -> Option<u32> {
        self.kicks.as_ref().map(|kicks| kicks.flows)
    }

    /// The program of a kick.
    pub fn kick(&self) -> Option<&Program> {
        self.kicks.as_ref().map(|kicks| &kicks.kick)
    }

    /// True if coefficients or the state of this many trajectories have fewer numbers than steps read.
    pub fn lacks(&self, slots: &[f64], g: &[f64], mu: &[f64], trajectories: usize) -> bool {
        slots.len() < self.slots()
            || g.len() < self.element * trajectories
            || mu.len() < self.dim * trajectories
    }

    /// The times that the programs read.
    #[must_use]
    pub fn clock(&self) -> Option<&Clock> {
        self.clock.as_ref()
    }

    /// The loop that calls the programs.
    pub fn schedule(&self) -> &Block {
        &self.schedule
    }
}

/// Errors of making a kernel from programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramError {
    /// A program of a step has other numbers of inputs and outputs than the step's dimensions ask for.
    Shape {
        /// Which program.
        program: &'static str,
        /// Inputs and outputs it must have.
        expected: (usize, usize),
        /// Inputs and outputs it has.
        found: (usize, usize),
    },
    /// The tolerance of a step is not below 1, or the distance from its guess is negative: no guess would be corrected.
    Limits,
}

impl fmt::Display for ProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape { program, expected, found } => write!(
                f,
                "the program '{program}' has {} inputs and {} outputs, where the step has {} and {}",
                found.0, found.1, expected.0, expected.1
            ),
            Self::Limits => f.write_str(
                "the tolerance of a step has to be below 1, and the distance from its guess at least 0",
            ),
        }
    }
}

impl core::error::Error for ProgramError {}

/// The numbers that a kernel is made for: its tolerances are those of their rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 64 bits.
    #[default]
    Double,
    /// 32 bits.
    Single,
}

impl Precision {
    /// The distance from 1 to the next larger number.
    pub fn epsilon(self) -> f64 {
        match self {
            Self::Double => f64::EPSILON,
            Self::Single => f64::from(f32::EPSILON),
        }
    }

    /// Bytes of a number.
    pub fn bytes(self) -> usize {
        match self {
            Self::Double => 8,
            Self::Single => 4,
        }
    }

    /// The number nearest to this one.
    pub(crate) fn round(self, value: f64) -> f64 {
        match self {
            Self::Double => value,
            Self::Single => f64::from(value as f32),
        }
    }
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Double => "double",
            Self::Single => "single",
        })
    }
}

/// Trajectories that are made side by side.
pub const WIDTH: usize = 8;

/// Which of a [`Stepper`]'s two functions somebody is going to call, and so which are worth compiling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Trajectories {
    /// [`Stepper::advance`]: one trajectory.
    One,
    /// [`Stepper::advance_lanes`]: many, side by side.
    Lanes,
    /// Both.
    #[default]
    Both,
}

impl Trajectories {
    /// True if single trajectories are needed.
    pub fn one(self) -> bool {
        self != Self::Lanes
    }

    /// True if trajectories side by side are needed.
    pub fn lanes(self) -> bool {
        self != Self::One
    }
}

/// The outcome of driving a kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Steps made; fewer than asked for where the next one was refused.
    pub steps: u64,
    /// The largest number of corrections of a step.
    pub corrections: u32,
    /// The largest residual left by a step, relative to the largest coordinate of μ.
    pub residual: f64,
}

/// Makes the steps of a [`Kernel`](crate::Kernel): its interpreter, which is the kernel itself, or machine code. Any
/// two for the same kernel make the same bits.
pub trait Stepper {
    /// Makes up to `steps` steps from (g, μ) with these folded coefficients; the state is then that after the last
    /// step made.
    ///
    /// Slices have the kernel's lengths. With shorter ones no step is made.
    fn advance(&self, slots: &[f64], g: &mut [f64], mu: &mut [f64], steps: u64) -> Outcome;

    /// As [`Stepper::advance`] for [`WIDTH`] trajectories side by side: number i of trajectory r of `g` and `mu` is at
    /// `i * WIDTH + r`. Only lanes with `live` move. The steps each made; a refused lane changes no neighbour's bits,
    /// and each lane has the bits of [`Stepper::advance`].
    fn advance_lanes(
        &self,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
        live: [bool; WIDTH],
    ) -> [u64; WIDTH];
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Graph;

    #[test]
    fn limits_under_which_no_guess_is_corrected_are_refused() {
        let program = |inputs, outputs| {
            let graph = Graph::new();
            let zero = graph.zero();
            graph.finish(inputs, &alloc::vec![zero; outputs])
        };
        let kernel = |tolerance, near| {
            let programs = Programs {
                guess: program(1, 1),
                correct: program(2, 4),
                accept: program(4, 1),
                transport: program(3, 2),
                frame: None,
                sound: program(2, 1),
                watch: program(2, 1),
                matrix: program(1, 1),
            };
            let (dim, element, unknowns, solution, corrections) = (1, 1, 1, 1, 3);
            let parts = KernelParts {
                dim,
                element,
                unknowns,
                solution,
                tolerance,
                near,
                corrections,
                programs,
            };
            Kernel::new(parts).err()
        };
        assert_eq!(kernel(0.5, 0.0), None);
        for (tolerance, near) in [(1.0, 0.5), (f64::NAN, 0.5), (0.5, -0.1), (0.5, f64::NAN)] {
            assert_eq!(kernel(tolerance, near), Some(ProgramError::Limits));
        }
    }
}
