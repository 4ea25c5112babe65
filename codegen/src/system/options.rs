//! Options of reading a system file.

use crate::lie::Chart;
use crate::problem::{FrameChoice, Method, Solver};

/// The treatment of the parameters of a system file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parameters {
    /// Their values are put into the Hamiltonian, exactly.
    #[default]
    Substituted,
    /// They stay parameters, with their values as defaults.
    Kept,
}

/// Options of reading a system file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// The treatment of the parameters.
    pub parameters: Parameters,
    /// Replaces the truncation of the file.
    pub truncation: Option<usize>,
    /// Replaces the chart of the file.
    pub chart: Option<Chart>,
    /// Replaces the solver of the file.
    pub solver: Option<Solver>,
    /// Replaces the method of the file.
    pub method: Option<Method>,
    /// Replaces the frame of the file.
    pub frame: Option<FrameChoice>,
}
