//! The errors of assembling a kernel from programs.

use core::fmt;

/// Why nodes are no program, or programs no step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProgramError {
    /// An operand of this node does not come before it.
    Order {
        /// The node's place.
        node: usize,
    },
    /// This node reads an input beyond the number of inputs.
    Input {
        /// The node's place.
        node: usize,
        /// How many inputs there are.
        inputs: usize,
    },
    /// This output is no node of the program.
    Output {
        /// Its number.
        output: usize,
    },
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
            Self::Order { node } => write!(f, "node {node} reads a node that comes after it"),
            Self::Input { node, inputs } => {
                write!(f, "node {node} reads an input beyond the {inputs} there are")
            }
            Self::Output { output } => write!(f, "output {output} is no node of the program"),
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
