//! The coefficient table: read once per step size and parameter set, so data, not code.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::number::float;
use crate::integrator::{Coefficients, Products};
use crate::lie::LieAlgebra;

/// The sizes of a table, as the literals that generic functions want.
pub struct Sizes {
    /// More than any power of h.
    pub powers: Literal,
    /// How many products of symbols there are, 1 among them.
    pub products: Literal,
    /// How many parts there are.
    pub parts: Literal,
    /// How many bases there are.
    pub bases: Literal,
}

impl Sizes {
    /// The sizes of the table of `coefficients`, whose symbols make these products.
    #[must_use]
    pub fn of(coefficients: &Coefficients, products: &Products) -> Self {
        let terms = coefficients.bases().iter().flatten();
        let power = terms.map(|term| term.step_power).max().unwrap_or(0);
        Self {
            powers: Literal::u32_unsuffixed(power + 1),
            products: Literal::usize_unsuffixed(products.steps().len() + 1),
            parts: Literal::usize_unsuffixed(coefficients.parts().flatten().count()),
            bases: Literal::usize_unsuffixed(coefficients.bases().len()),
        }
    }
}

/// The static `TABLE`, a `coadjoint::plumbing::Table` holding `coefficients`, whose symbols make
/// these products; `algebra` tells the factor of each coordinate.
#[must_use]
pub fn table_item(
    krate: &TokenStream,
    coefficients: &Coefficients,
    all: &Products,
    algebra: &LieAlgebra,
) -> TokenStream {
    let pair = |&(of, symbol): &(usize, usize)| {
        let (of, symbol) = (Literal::usize_unsuffixed(of), Literal::usize_unsuffixed(symbol));
        quote!((#of, #symbol))
    };
    let products = all.steps().iter().map(pair);
    let terms = coefficients.bases().iter().flatten().map(|term| {
        let factor = float(term.rounded_factor());
        let product = Literal::usize_unsuffixed(all.number(&term.symbol_powers));
        quote!((#factor, #product))
    });
    let mut end = 0;
    let parts = coefficients.parts().flatten().map(|part| {
        end += part.len();
        let power = Literal::u32_unsuffixed(part.first().map_or(0, |term| term.step_power));
        let end = Literal::usize_unsuffixed(end);
        quote!((#power, #end))
    });
    let mut end = 0;
    let bases = coefficients.parts().map(|parts| {
        end += parts.count();
        Literal::usize_unsuffixed(end)
    });
    let slots = coefficients.slots().iter().map(|&(base, scale)| {
        let base = Literal::usize_unsuffixed(base);
        let scale = Literal::u32_unsuffixed(scale);
        quote!((#base, #scale))
    });
    let monomials = coefficients.monomials().iter().map(|factors| monomial(factors));
    let factors = algebra.factor_of_coordinates().into_iter().map(Literal::u32_unsuffixed);
    quote! {
        /// All coefficients as data. A base is Σ h^power Σ factor · product, a slot `c[i]` a base
        /// times an integer.
        static TABLE: #krate::plumbing::Table = #krate::plumbing::Table {
            /// Products of symbols: an earlier one times a symbol; number 0 is 1.
            products: &[#(#products),*],
            /// Factor, and the number of its product.
            terms: &[#(#terms),*],
            /// The power of h, and where its terms end.
            parts: &[#(#parts),*],
            /// Where the parts of each base end.
            bases: &[#(#bases),*],
            /// For each slot its base, and the integer.
            slots: &[#(#slots),*],
            /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
            /// first bases.
            monomials: &[#(#monomials),*],
            /// The direct factor of the group that each coordinate belongs to.
            factors: &[#(#factors),*],
        };
    }
}

/// A monomial as a slice of pairs.
fn monomial(factors: &[(u32, u32)]) -> TokenStream {
    let factors = factors.iter().map(|&(coordinate, exponent)| {
        let coordinate = Literal::u32_unsuffixed(coordinate);
        let exponent = Literal::u32_unsuffixed(exponent);
        quote!((#coordinate, #exponent))
    });
    quote!(&[#(#factors),*])
}
