//! The back ends there are on this machine, for kernels.

use std::sync::Arc;

use coadjoint::groups::MatrixGroup;
use coadjoint::{LieGroup, Phase};
use coadjoint_codegen::step::Step;
use coadjoint_native::{COptions, Native, NativeError};
#[cfg(feature = "jit")]
use coadjoint_program::Trajectories;
use coadjoint_program::{Kernel, Stepper};
use nalgebra::{DMatrix, DVector};

/// A stepper that any thread can use.
pub type AnyStepper = Arc<dyn Stepper + Send + Sync>;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    Interpreter,
    C,
    #[cfg(feature = "jit")]
    Jit,
}

impl Backend {
    pub const ALL: &'static [Self] = &[
        Self::Interpreter,
        Self::C,
        #[cfg(feature = "jit")]
        Self::Jit,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Interpreter => "interpreter",
            Self::C => "c",
            #[cfg(feature = "jit")]
            Self::Jit => "jit",
        }
    }

    /// The stepper of a kernel; `None` where the machine has no C compiler.
    pub fn stepper(self, kernel: &Kernel) -> Option<AnyStepper> {
        match self {
            Self::Interpreter => Some(Arc::new(kernel.clone())),
            Self::C => match Native::by_c(kernel, &COptions::default()) {
                Ok(native) => Some(Arc::new(native.entry)),
                Err(NativeError::NoCompiler { .. }) => {
                    eprintln!("no C compiler: it is left out");
                    None
                }
                Err(error) => panic!("{error}"),
            },
            #[cfg(feature = "jit")]
            Self::Jit => Some(Arc::new(
                coadjoint_native::jit::compile(kernel, Trajectories::Both).expect("code"),
            )),
        }
    }
}

/// The numbers that the programs of a step have for a group element.
pub fn numbers_of(
    step: &Step,
    group: &MatrixGroup,
    g: &<MatrixGroup as LieGroup>::Element,
) -> Vec<f64> {
    step.element_of(&entries_of(group, g))
}

/// The matrix of a group element, row by row.
pub fn entries_of<G: LieGroup<Scalar = f64>>(group: &G, g: &G::Element) -> Vec<f64> {
    let size = group.matrix_size();
    (0..size * size).map(|at| group.matrix_entry(g, at / size, at % size)).collect()
}

/// The matrix, row by row, of an element given by the numbers that the programs have for it.
pub fn matrix_of(kernel: &Kernel, g: &[f64]) -> Vec<f64> {
    kernel.programs.matrix.run(g, &[])
}

/// The state of the runtime that the programs have as these numbers.
pub fn phase_of(kernel: &Kernel, group: &MatrixGroup, g: &[f64], mu: &[f64]) -> Phase<MatrixGroup> {
    let size = group.matrix_size();
    let element = DMatrix::from_row_slice(size, size, &matrix_of(kernel, g));
    Phase::<MatrixGroup>::new(element, DVector::from_column_slice(mu))
}
