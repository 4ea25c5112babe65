//! Ways to make flows beside programs, and advice about steps that are refused.

use coadjoint::{Phase, StepError};

use super::compiled::{Compiled, Solved};
use super::space::Tables;

/// Makes a flow of a state from this time.
pub(super) type Flow<'a> =
    Box<dyn Fn(&mut Phase<Tables>, f64) -> Result<Solved, StepError> + Send + Sync + 'a>;

/// A way to make flows without programs: where programs refuse a step, and where a system has none.
pub(super) trait Propagator<'a>: Send + Sync {
    /// The flow of this length, for these values of the parameters that are kept.
    ///
    /// # Errors
    /// Fails if the length makes no sense, or a coefficient is not finite.
    fn flow(&self, group: &Tables, length: f64, parameters: &[f64]) -> Result<Flow<'a>, StepError>;

    /// Makes the next step of a motion that it remembers, where there is one.
    fn go_on(&self, _: &mut Phase<Tables>, _time: f64) -> Option<Solved> {
        None
    }

    /// Forgets the values of the parameters; false if it is made of them, so that it is to be made anew.
    fn forgets(&mut self) -> bool {
        false
    }

    /// The largest ratio of the last two terms of a series at momenta that lie side by side in this many lanes, 1 or
    /// [`WIDTH`](coadjoint_program::WIDTH), where it may be worth a warning, for steps whose longest flow has this length; else 0.
    fn ratio(
        &self,
        _: Option<&Compiled>,
        _longest: f64,
        _parameters: &[f64],
        _momenta: (&[f64], usize),
    ) -> f64 {
        0.0
    }

    /// This method in the comoving frame, where there is one and the choice is left.
    fn comoving(&self) -> Option<Box<dyn Propagator<'_> + '_>> {
        None
    }

    /// True if there are momenta at which the Hamiltonian is not defined.
    fn may_be_undefined(&self) -> bool {
        false
    }

    /// Checks that the Hamiltonian, and what acts beside it, are defined in a state with this momentum.
    ///
    /// # Errors
    /// The expression in it that is not.
    fn defined(
        &self,
        _time: f64,
        _phase: &dyn Fn() -> Phase<Tables>,
        _mu: &[f64],
    ) -> Result<(), StepError> {
        Ok(())
    }
}

/// Halves of a refused step that are tried.
const MOST_HALVINGS: u32 = 24;

/// The error with the longest of h/2, h/4, … with which `works` says that the step can be made; as it is where there is
/// none, and where the length of the step is not to blame.
#[cold]
pub(super) fn advise(error: StepError, h: f64, mut works: impl FnMut(f64) -> bool) -> StepError {
    if !error.asks_for_smaller_step() {
        return error;
    }
    let mut shorter = h;
    for _ in 0..MOST_HALVINGS {
        shorter *= 0.5;
        if works(shorter) {
            return error.with_usable_step(shorter);
        }
    }
    error
}
