//! How functions of this crate that come from nowhere in particular are solved.

use super::{Integrator, Solver};
use crate::generating::Reversed;
#[cfg(feature = "alloc")]
use crate::{chart::Chart, generating::PolynomialFunction, group::LieGroup};

impl<S: Integrator + ?Sized> Integrator for Reversed<'_, S> {
    fn solver(&self) -> Solver {
        self.0.solver()
    }
}

#[cfg(feature = "alloc")]
impl<G: LieGroup, C: Chart<G>> Integrator for PolynomialFunction<G, C> {}
