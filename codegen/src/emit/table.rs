//! The coefficient table: read once per step size and parameter set, so data, not code.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::number::float;
use crate::integrator::Coefficients;

/// The expression of a `coadjoint::plumbing::Table` holding `coefficients`.
#[must_use]
pub fn table(krate: &TokenStream, coefficients: &Coefficients) -> TokenStream {
    let terms = coefficients.bases().iter().flatten().map(|term| {
        let factor = float(term.rounded_factor());
        let step = Literal::u32_unsuffixed(term.step_power);
        let symbols = term.symbol_powers.iter().map(|&p| Literal::u32_unsuffixed(p));
        quote!((#factor, #step, [#(#symbols),*]))
    });
    let mut end = 0;
    let ends = coefficients.bases().iter().map(|base| {
        end += base.len();
        Literal::usize_unsuffixed(end)
    });
    let slots = coefficients.slots().iter().map(|&(base, scale)| {
        let base = Literal::usize_unsuffixed(base);
        let scale = Literal::u32_unsuffixed(scale);
        quote!((#base, #scale))
    });
    let series = Literal::usize_unsuffixed(coefficients.series());
    quote! {
        #krate::plumbing::Table {
            terms: &[#(#terms),*],
            ends: &[#(#ends),*],
            slots: &[#(#slots),*],
            series: #series,
        }
    }
}
