//! What evaluates the programs of a step.

use std::fmt;
use std::time::Duration;
#[cfg(feature = "jit")]
use std::time::Instant;

use coadjoint_native::{COptions, Entry, Native};
use coadjoint_program::{Kernel, Stepper, Trajectories};

use crate::error::RunError;

/// What is to make the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// What is cheapest for this run: a short one never waits for a compiler.
    #[default]
    Auto,
    /// The interpreter of the programs, which is always there.
    Interpreter,
    /// The system's C compiler, for this processor.
    C,
    /// Cranelift, for this processor.
    #[cfg(feature = "jit")]
    Jit,
}

/// Nanoseconds that an operation takes.
struct Pace {
    interpreted: f64,
    by_c: f64,
    #[cfg(feature = "jit")]
    by_cranelift: f64,
}

/// Of one trajectory, and of [`WIDTH`](coadjoint_program::WIDTH) side by side; measured on a processor of 2022
/// (`docs/measurements/backends.md`, `docs/measurements/python.md`), and enough to tell seconds from minutes.
const ONE: Pace = Pace {
    interpreted: 2.0,
    by_c: 0.2,
    #[cfg(feature = "jit")]
    by_cranelift: 0.34,
};
const LANES: Pace = Pace {
    interpreted: 7.5,
    by_c: 0.6,
    #[cfg(feature = "jit")]
    by_cranelift: 1.6,
};

/// Seconds that a C compiler takes: to start, and for each operation.
const COMPILER_STARTS: f64 = 0.25;
const COMPILER_OPERATION: f64 = 2.2e-4;

/// Programs of more operations than this are not given to a C compiler unless it is named: its time grows faster.
const MOST_FOR_COMPILER: f64 = 40_000.0;

/// The same of Cranelift.
#[cfg(feature = "jit")]
const JIT_STARTS: f64 = 4e-3;
#[cfg(feature = "jit")]
const JIT_OPERATION: f64 = 8e-6;

/// What made the steps of a run.
#[derive(Clone, Debug)]
pub struct Used {
    /// In a few words.
    pub name: String,
    /// How long it took to be ready, where that took any time.
    pub ready: Option<Duration>,
}

/// Programs ready to make steps.
#[derive(Debug)]
pub struct Code {
    entry: Option<Entry>,
    name: String,
    ready: Duration,
    notes: Vec<String>,
}

impl Code {
    /// By the backend asked for, to make about so many steps of trajectories one by one or side by side; what is not
    /// asked for is interpreted.
    ///
    /// # Errors
    /// Where the backend that the user named cannot be had.
    pub fn new(
        kernel: &Kernel,
        backend: Backend,
        steps: f64,
        trajectories: Trajectories,
    ) -> Result<Self, RunError> {
        let failed = |what: &dyn fmt::Display| RunError::Option(format!("--backend: {what}"));
        match backend {
            Backend::Interpreter => Ok(Self::interpreter()),
            Backend::C => Self::by_c(kernel, trajectories).map_err(|error| failed(&error)),
            #[cfg(feature = "jit")]
            Backend::Jit => {
                Self::by_cranelift(kernel, trajectories).map_err(|error| failed(&error))
            }
            Backend::Auto => Ok(Self::cheapest(kernel, steps, trajectories)),
        }
    }

    fn interpreter() -> Self {
        Self {
            entry: None,
            name: "interpreter".to_owned(),
            ready: Duration::ZERO,
            notes: Vec::new(),
        }
    }

    fn by_c(
        kernel: &Kernel,
        trajectories: Trajectories,
    ) -> Result<Self, coadjoint_native::NativeError> {
        let native = Native::by_c(kernel, &COptions { trajectories, ..COptions::default() })?;
        let name = format!("machine code by {}", native.compiler);
        Ok(Self { entry: Some(native.entry), name, ready: native.ready, notes: Vec::new() })
    }

    #[cfg(feature = "jit")]
    fn by_cranelift(
        kernel: &Kernel,
        trajectories: Trajectories,
    ) -> Result<Self, coadjoint_native::jit::JitError> {
        let begun = Instant::now();
        let entry = coadjoint_native::jit::compile(kernel, trajectories)?;
        let name = "machine code by Cranelift".to_owned();
        Ok(Self { entry: Some(entry), name, ready: begun.elapsed(), notes: Vec::new() })
    }

    /// What takes least time for so many steps; what cannot be had is told, and the next best is taken.
    fn cheapest(kernel: &Kernel, steps: f64, trajectories: Trajectories) -> Self {
        let operations = operations(kernel) as f64;
        let pace = if trajectories == Trajectories::Lanes { LANES } else { ONE };
        let run = |each: f64| steps * operations * each * 1e-9;
        let interpreted = run(pace.interpreted);
        let by_c = COMPILER_STARTS + operations * COMPILER_OPERATION + run(pace.by_c);
        let mut notes = Vec::new();
        let tell = |notes: &mut Vec<String>, error: &dyn fmt::Display, next: &str| {
            notes.push(format!("{error}; {next} makes the steps"));
        };
        #[cfg(feature = "jit")]
        {
            let by_cranelift = JIT_STARTS + operations * JIT_OPERATION + run(pace.by_cranelift);
            let slower = operations <= MOST_FOR_COMPILER && by_c < by_cranelift;
            if by_cranelift < interpreted && !slower {
                match Self::by_cranelift(kernel, trajectories) {
                    Ok(code) => return code,
                    Err(error) => tell(&mut notes, &error, "another backend"),
                }
            }
        }
        if by_c < interpreted && operations <= MOST_FOR_COMPILER {
            match Self::by_c(kernel, trajectories) {
                Ok(code) => return Self { notes, ..code },
                Err(error) => tell(&mut notes, &error, "the interpreter"),
            }
        }
        Self { notes, ..Self::interpreter() }
    }

    /// Whether a processor runs it as it is.
    pub fn is_machine_code(&self) -> bool {
        self.entry.is_some()
    }

    /// What makes the steps, for reports.
    pub fn used(&self) -> Used {
        Used { name: self.name.clone(), ready: self.entry.as_ref().map(|_| self.ready) }
    }

    /// What could not be had, and what takes its place.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// What makes the steps of this kernel, from which the code is.
    pub fn stepper<'a>(&'a self, kernel: &'a Kernel) -> &'a dyn Stepper {
        match &self.entry {
            Some(entry) => entry,
            None => kernel,
        }
    }
}

/// The operations of a step, if one correction is enough.
fn operations(kernel: &Kernel) -> usize {
    let programs = kernel.programs();
    let list = [&programs.guess, &programs.correct, &programs.accept, &programs.transport];
    list.iter().map(|program| program.nodes().len()).sum()
}
