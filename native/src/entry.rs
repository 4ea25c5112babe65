//! Calling machine code: the one place where it happens.
//!
//! A step that was compiled at run time is reached by a pointer, which the type system cannot check. The call is sound
//! for these reasons: the code was printed or built from the same [`Kernel`] whose sizes are checked before each
//! call, it reads and writes nothing but these slices, and it stays loaded as long as the entry lives.
#![allow(unsafe_code)]

use std::sync::Arc;

use coadjoint_program::{Kernel, Outcome, Stepper, WIDTH};

/// Up to `steps` steps of one trajectory: (slots, g, μ, steps, report) ↦ steps made. The report is two numbers: the largest
/// number of corrections and the largest residual.
pub(crate) type AdvanceFunction =
    unsafe extern "C" fn(*const f64, *mut f64, *mut f64, u64, *mut f64) -> u64;

/// Advances [`WIDTH`] trajectories side by side: (slots, g, μ, steps, live, steps made). Number i of trajectory r is at `i *
/// WIDTH + r`; `live` holds a byte for each lane, 0 for those that are not advanced.
pub(crate) type LanesFunction =
    unsafe extern "C" fn(*const f64, *mut f64, *mut f64, u64, *const u8, *mut u64);

/// A compiled step, ready to be called from any thread. What was not compiled of it is interpreted.
#[derive(Clone)]
pub struct Entry {
    kernel: Arc<Kernel>,
    advance: Option<AdvanceFunction>,
    lanes: Option<LanesFunction>,
    /// Keeps the code where it is.
    _code: Arc<dyn Send + Sync>,
}

impl std::fmt::Debug for Entry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Entry").field("dim", &self.kernel.dim).finish_non_exhaustive()
    }
}

impl Entry {
    /// An entry to code that lives as long as `code`.
    ///
    /// # Safety
    /// The functions must be compiled from `kernel`, be pure but for the slices they are given, and be valid as long
    /// as `code` is not dropped.
    pub(crate) unsafe fn new(
        kernel: &Kernel,
        advance: Option<AdvanceFunction>,
        lanes: Option<LanesFunction>,
        code: Arc<dyn Send + Sync>,
    ) -> Self {
        Self { kernel: Arc::new(kernel.clone()), advance, lanes, _code: code }
    }
}

impl Stepper for Entry {
    fn advance(&self, slots: &[f64], g: &mut [f64], mu: &mut [f64], steps: u64) -> Outcome {
        if self.kernel.lacks(slots, g, mu, 1) {
            return Outcome::default();
        }
        let Some(advance) = self.advance else {
            return self.kernel.advance(slots, g, mu, steps);
        };
        let mut report = [0.0; 2];
        // SAFETY: the slices are as long as the code reads and writes, and `&mut` is exclusive.
        let made = unsafe {
            advance(slots.as_ptr(), g.as_mut_ptr(), mu.as_mut_ptr(), steps, report.as_mut_ptr())
        };
        Outcome { steps: made, corrections: report[0] as u32, residual: report[1] }
    }

    fn advance_lanes(
        &self,
        slots: &[f64],
        g: &mut [f64],
        mu: &mut [f64],
        steps: u64,
        live: [bool; WIDTH],
    ) -> [u64; WIDTH] {
        let mut made = [0; WIDTH];
        if self.kernel.lacks(slots, g, mu, WIDTH) {
            return made;
        }
        let Some(lanes) = self.lanes else {
            return self.kernel.advance_lanes(slots, g, mu, steps, live);
        };
        let live = live.map(u8::from);
        // SAFETY: the slices are as long as the code reads and writes, and `&mut` is exclusive.
        unsafe {
            lanes(
                slots.as_ptr(),
                g.as_mut_ptr(),
                mu.as_mut_ptr(),
                steps,
                live.as_ptr(),
                made.as_mut_ptr(),
            );
        }
        made
    }
}
