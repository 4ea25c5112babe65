//! Numbers as literals.

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::number::Rational;

/// The nearest `f64` of an exact number.
#[must_use]
pub(crate) fn exact(value: &Rational) -> TokenStream {
    float(value.to_f64().unwrap_or(f64::NAN))
}

/// A literal; numbers beyond the range of `f64` by name, for folding to refuse.
#[must_use]
pub(crate) fn float(value: f64) -> TokenStream {
    if value.is_finite() {
        let literal = Literal::f64_unsuffixed(value);
        quote!(#literal)
    } else {
        quote!(f64::NAN)
    }
}
