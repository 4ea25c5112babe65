//! How functions of this crate that come from nowhere in particular are solved.

use super::{ByDimension, Integrator, NewtonModel, Predict};
use crate::generating::{GeneratingFunction, Reversed};
#[cfg(feature = "alloc")]
use crate::{chart::Chart, generating::PolynomialFunction, group::LieGroup};

impl<S: GeneratingFunction + ?Sized> Predict for Reversed<'_, S> {}
impl<S: GeneratingFunction + ?Sized> NewtonModel for Reversed<'_, S> {}
impl<S: GeneratingFunction + ?Sized> Integrator for Reversed<'_, S> {
    type Method = ByDimension<Self>;
}

#[cfg(feature = "alloc")]
impl<G: LieGroup, C: Chart<G>> Predict for PolynomialFunction<G, C> {}
#[cfg(feature = "alloc")]
impl<G: LieGroup, C: Chart<G>> NewtonModel for PolynomialFunction<G, C> {}
#[cfg(feature = "alloc")]
impl<G: LieGroup, C: Chart<G>> Integrator for PolynomialFunction<G, C> {
    type Method = ByDimension<Self>;
}
