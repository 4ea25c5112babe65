//! The data of folding: read once per step size and parameter set, so data, not code.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::program::float;
use crate::integrator::{FoldTable, Integrator};

/// The static `FOLD`, a `coadjoint::plumbing::Fold` with these lists.
pub(crate) fn fold_item(krate: &TokenStream, table: &FoldTable) -> TokenStream {
    let number = |value: u32| Literal::u32_unsuffixed(value);
    let pair = |&(a, b): &(u32, u32)| {
        let (a, b) = (number(a), number(b));
        quote!((#a, #b))
    };
    let fold = table.lists();
    let products = fold.products.iter().map(pair);
    let terms = fold.terms.iter().map(|&(factor, product)| {
        let (factor, product) = (float(factor), number(product));
        quote!((#factor, #product))
    });
    let parts = fold.parts.iter().map(pair);
    let bases = fold.bases.iter().map(|&end| number(end));
    let slots = fold.slots.iter().map(|&(base, scale, place)| {
        let (base, scale, place) = (number(base), number(scale), number(place));
        quote!((#base, #scale, #place))
    });
    let bound = fold.bound.iter().map(|&(base, weight, place)| {
        let (base, weight, place) = (number(base), float(weight), number(place));
        quote!((#base, #weight, #place))
    });
    let kept = fold.kept.iter().map(pair);
    let last = fold.last.iter().map(|&(part, factor, highest, degree, weight)| {
        let (part, factor, degree) = (number(part), number(factor), number(degree));
        let weight = float(weight);
        quote!((#part, #factor, #highest, #degree, #weight))
    });
    let radius = match fold.radius.map(number) {
        Some(place) => quote!(::core::option::Option::Some(#place)),
        None => quote!(::core::option::Option::None),
    };
    quote! {
        /// All coefficients as data. A base is Σ h^power Σ factor · product, a coefficient `c[i]` a base times an
        /// integer.
        static FOLD: #krate::plumbing::Fold<'static> = #krate::plumbing::Fold {
            /// Products of symbols: an earlier one times a symbol; number 0 is 1.
            products: &[#(#products),*],
            /// Factor, and the number of its product.
            terms: &[#(#terms),*],
            /// The power of h, and where its terms end.
            parts: &[#(#parts),*],
            /// Where the parts of each base end.
            bases: &[#(#bases),*],
            /// Base, integer, and the place of their product.
            slots: &[#(#slots),*],
            /// Base, weight and place: a bound on what is left out of the Hessian, by degrees.
            bound: &[#(#bound),*],
            /// Part and place: the coefficients of the last two terms of the series.
            kept: &[#(#kept),*],
            /// How far the series can be trusted: part, factor of the group, whether it belongs to the last term, degree and
            /// bound of the gradient.
            last: &[#(#last),*],
            radius: #radius,
        };
    }
}

/// The static `LAST`, a `coadjoint::plumbing::LastTerms`: the monomials of the last two terms of the series.
pub(crate) fn last_item(krate: &TokenStream, integrator: &Integrator) -> TokenStream {
    let (coefficients, truncation) = (&integrator.coefficients, integrator.problem.truncation);
    let monomials = coefficients.last_orders(truncation).map(|(order, base)| {
        let factors = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        let (highest, monomial) = (order == truncation, monomial(factors));
        quote!((#highest, #monomial))
    });
    let factors = integrator.problem.algebra.factor_of_coordinates();
    let factors = factors.into_iter().map(Literal::u32_unsuffixed);
    quote! {
        static LAST: #krate::plumbing::LastTerms = #krate::plumbing::LastTerms {
            /// The monomials of the last two terms of S, those of the last marked, as (coordinate, exponent) from zero.
            monomials: &[#(#monomials),*],
            /// The direct factor of the group that each coordinate belongs to.
            factors: &[#(#factors),*],
        };
    }
}

fn monomial(factors: &[(u32, u32)]) -> TokenStream {
    let factors = factors.iter().map(|&(coordinate, exponent)| {
        let coordinate = Literal::u32_unsuffixed(coordinate);
        let exponent = Literal::u32_unsuffixed(exponent);
        quote!((#coordinate, #exponent))
    });
    quote!(&[#(#factors),*])
}
