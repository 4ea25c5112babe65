//! Backends by their names.

use coadjoint_run::Backend;

/// The backend that makes the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum BackendName {
    /// The cheapest for this run: a short one never waits for a compiler
    #[default]
    Auto,
    /// The interpreter of the programs, which is always there
    Interpreter,
    /// The system's C compiler, for this processor
    C,
    /// Cranelift, for this processor
    #[cfg(feature = "jit")]
    Jit,
}

impl From<BackendName> for Backend {
    fn from(name: BackendName) -> Self {
        match name {
            BackendName::Auto => Self::Auto,
            BackendName::Interpreter => Self::Interpreter,
            BackendName::C => Self::C,
            #[cfg(feature = "jit")]
            BackendName::Jit => Self::Jit,
        }
    }
}
