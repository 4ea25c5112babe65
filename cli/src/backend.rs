//! What evaluates the programs of a step.

use std::time::Instant;

use coadjoint_program::{Kernel, Outcome, WIDTH};

use crate::error::CliError;

/// What is to make the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Backend {
    /// What is cheapest for this run: a short one never waits for a compiler.
    #[default]
    Auto,
    /// The interpreter of the programs, which is always there.
    Interpreter,
}

/// Programs ready to make steps.
pub struct Code {
    name: &'static str,
    /// Seconds until it was ready.
    ready: f64,
}

impl Code {
    /// By the backend asked for, to make about so many steps.
    ///
    /// # Errors
    /// Where the backend that the user named cannot be had.
    pub fn new(kernel: &Kernel, backend: Backend, steps: f64) -> Result<Self, CliError> {
        let begun = Instant::now();
        let _ = (kernel, steps);
        match backend {
            Backend::Auto | Backend::Interpreter => {
                Ok(Self { name: "interpreter", ready: begun.elapsed().as_secs_f64() })
            }
        }
    }

    /// Its name, and the seconds until it was ready.
    pub fn report(&self) -> (&'static str, f64) {
        (self.name, self.ready)
    }

    /// As [`Kernel::advance`].
    pub fn advance(
        &self,
        kernel: &Kernel,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
    ) -> Outcome {
        kernel.advance(slots, g, mu, steps)
    }

    /// As [`Kernel::advance_lanes`].
    pub fn advance_lanes(
        &self,
        kernel: &Kernel,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
        live: [bool; WIDTH],
    ) -> [u64; WIDTH] {
        kernel.advance_lanes(slots, g, mu, steps, live)
    }
}
