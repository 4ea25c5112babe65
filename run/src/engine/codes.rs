//! The codes of a kernel by all backends, for later runs.

use std::sync::{Arc, Mutex, PoisonError};

use coadjoint_program::{Kernel, Trajectories};

use crate::backend::{Backend, Code, Running};
use crate::error::RunError;

/// Programs of more operations than this are not compiled, which would take Cranelift more than about a second: they are evaluated as data.
pub(super) const MOST_OPERATIONS: usize = 200_000;

/// The codes of one kernel, for later runs.
#[derive(Debug, Default)]
pub(super) struct Codes {
    codes: Mutex<Vec<(Backend, Trajectories, Arc<Code>)>>,
    /// The steps of runs so far.
    steps: Mutex<f64>,
}

impl Codes {
    /// Usable code: made by this backend, or, for [`Backend::Auto`], any machine code.
    fn find(&self, backend: Backend, trajectories: Trajectories) -> Option<Arc<Code>> {
        // A thread that panicked has added whole codes, if any.
        let codes = self.codes.lock().unwrap_or_else(PoisonError::into_inner);
        let serves = |(by, of, code): &&(Backend, Trajectories, Arc<Code>)| {
            *of == trajectories
                && (*by == backend || backend == Backend::Auto)
                && (backend != Backend::Auto || code.lasts())
        };
        codes.iter().find(serves).map(|(_, _, code)| code.clone())
    }

    /// Keeps a code.
    fn keep(&self, backend: Backend, trajectories: Trajectories, code: &Arc<Code>) {
        let mut codes = self.codes.lock().unwrap_or_else(PoisonError::into_inner);
        // Others are of runs that ended before they were compiled.
        codes.retain(|(.., code)| code.lasts());
        codes.push((backend, trajectories, code.clone()));
    }

    /// The code of the kernel by this backend, about `steps` steps of which are going to be made, of these trajectories.
    ///
    /// # Errors
    /// Fails if the backend that the user named cannot be had.
    pub(super) fn code(
        &self,
        kernel: &Kernel,
        backend: Backend,
        steps: f64,
        trajectories: Trajectories,
    ) -> Result<Running, RunError> {
        let backend = if is_large(kernel) { Backend::Interpreter } else { backend };
        let mut made = self.steps.lock().unwrap_or_else(PoisonError::into_inner);
        let before = *made;
        *made += steps;
        if let Some(code) = self.find(backend, trajectories) {
            if backend == Backend::Auto {
                code.improve(kernel, *made);
            }
            return Ok(Running::new(code));
        }
        let code = Arc::new(Code::new(kernel, backend, [steps, before], trajectories)?);
        self.keep(backend, trajectories, &code);
        Ok(Running::new(code))
    }
}

/// The operations of a step.
pub(super) fn operations(kernel: &Kernel) -> usize {
    kernel.programs.correct.nodes().len() + kernel.programs.transport.nodes().len()
}

/// True if a step has too many operations to be compiled.
pub(super) fn is_large(kernel: &Kernel) -> bool {
    operations(kernel) > MOST_OPERATIONS
}
