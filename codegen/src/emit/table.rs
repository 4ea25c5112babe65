//! The data of folding: read once per step size and parameter set, so data, not code.

use std::fmt;

use coadjoint_program::fold::Fold;
use coadjoint_program::print::fill;
use proc_macro2::TokenStream;

use super::program::tokens;
use crate::integrator::{FoldTable, Integrator};

/// The static `FOLD`, a `coadjoint::plumbing::Fold` with these lists.
pub(crate) fn fold_item(table: &FoldTable) -> TokenStream {
    let Fold { products, terms, parts, bases, slots, bound, kept, last, radius } = table.lists();
    let radius = match radius {
        Some(place) => format!("::core::option::Option::Some({place})"),
        None => "::core::option::Option::None".to_owned(),
    };
    let values = [
        ("PRODUCTS", list(products)),
        ("TERMS", list(terms)),
        ("PARTS", list(parts)),
        ("BASES", list(bases)),
        ("SLOTS", list(slots)),
        ("BOUND", list(bound)),
        ("KEPT", list(kept)),
        ("LAST", list(last)),
        ("RADIUS", radius),
    ];
    tokens(&fill(FOLD, &values))
}

/// The static `LAST`, a `coadjoint::plumbing::LastTerms`: the monomials of the last two terms of the series.
pub(crate) fn last_item(integrator: &Integrator) -> TokenStream {
    let (coefficients, truncation) = (&integrator.coefficients, integrator.problem.truncation);
    let monomials = coefficients.last_orders(truncation).map(|(order, base)| {
        let monomial = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        format!("({}, &{monomial:?})", order == truncation)
    });
    let monomials: Vec<String> = monomials.collect();
    let factors = integrator.problem.algebra.factor_of_coordinates();
    let values = [("MONOMIALS", monomials.join(", ")), ("FACTORS", list(&factors))];
    tokens(&fill(LAST, &values))
}

/// The entries of a list as Rust writes them; numbers beyond the range of `f64` by a name, for folding to refuse.
pub(crate) fn list(entries: &[impl fmt::Debug]) -> String {
    let text = format!("{entries:?}");
    text.trim_matches(['[', ']']).replace("NaN", "f64::NAN").replace("inf", "f64::NAN")
}

const FOLD: &str = "
/// All coefficients as data. A base is Σ h^power Σ factor · product, a coefficient `c[i]` a base times an integer.
static FOLD: plumbing::Fold<'static> = plumbing::Fold {
    /// Products of symbols: an earlier one times a symbol; number 0 is 1.
    products: &[/*PRODUCTS*/],
    /// Factor, and the number of its product.
    terms: &[/*TERMS*/],
    /// The power of h, and where its terms end.
    parts: &[/*PARTS*/],
    /// Where the parts of each base end.
    bases: &[/*BASES*/],
    /// Base, integer, and the place of their product.
    slots: &[/*SLOTS*/],
    /// Base, weight and place: a bound on what is left out of the Hessian, by degrees.
    bound: &[/*BOUND*/],
    /// Part and place: the coefficients of the last two terms of the series.
    kept: &[/*KEPT*/],
    /// How far the series can be trusted: part, factor of the group, whether it belongs to the last term, degree and bound
    /// of the gradient.
    last: &[/*LAST*/],
    radius: /*RADIUS*/,
};
";

const LAST: &str = "
static LAST: plumbing::LastTerms = plumbing::LastTerms {
    /// The monomials of the last two terms of S, those of the last marked, as (coordinate, exponent) from zero.
    monomials: &[/*MONOMIALS*/],
    /// The direct factor of the group that each coordinate belongs to.
    factors: &[/*FACTORS*/],
};
";
