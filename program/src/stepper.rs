//! The trait for everything that makes steps.

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
    /// Whether one trajectory is going to be made by itself.
    #[must_use]
    pub fn one(self) -> bool {
        self != Self::Lanes
    }

    /// Whether trajectories are going to be made side by side.
    #[must_use]
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
    /// Slices must have the kernel's lengths. Given shorter ones, the interpreter reads them as if filled up
    /// with zeros, machine code makes no step.
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
