//! The time that a trial takes at most for laws that need many steps.

use std::cell::Cell;
use std::time::{Duration, Instant};

use coadjoint::StepError;

use super::law::{Law, Verdict};

/// The time for derivatives, and for the order from all starts.
const LONGEST: Duration = Duration::from_secs(20);

/// The reason of a law that this time is too short for.
pub(super) const LATE: &str = "it takes more than the 20 seconds that check has for it";

/// A limit, from its making on.
pub(super) struct Limit {
    begun: Instant,
    over: Cell<bool>,
}

impl Limit {
    pub(super) fn new() -> Self {
        Self { begun: Instant::now(), over: Cell::new(false) }
    }

    /// Makes steps, or refuses them where the time is over.
    pub(super) fn within(
        &self,
        steps: impl FnOnce() -> Result<(), StepError>,
    ) -> Result<(), StepError> {
        if self.begun.elapsed() > LONGEST {
            self.over.set(true);
            return Err(StepError::NonFiniteState);
        }
        steps()
    }

    /// True if steps were refused.
    pub(super) fn is_over(&self) -> bool {
        self.over.get()
    }

    /// A law, with this reason where it was not measured in time.
    pub(super) fn said(&self, law: Law) -> Law {
        match law.verdict {
            Verdict::NotMeasured(_) if self.is_over() => {
                Law { verdict: Verdict::NotMeasured(LATE), ..law }
            }
            _ => law,
        }
    }
}
