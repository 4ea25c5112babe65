//! The data of folding: read once per step size and parameter set, so data, not code.

use std::fmt;

use coadjoint_program::fold::Fold;
use coadjoint_program::print::fill;

use crate::integrator::{FoldTable, Integrator};

/// The static `FOLD`, a `coadjoint::plumbing::Fold` with these lists.
pub(crate) fn fold_item(table: &FoldTable) -> String {
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
    fill(include_str!("fold.in"), &values)
}

/// The static `LAST`, a `coadjoint::plumbing::LastTerms`: the monomials of the last two terms of the series.
pub(crate) fn last_item(integrator: &Integrator) -> String {
    let (coefficients, truncation) = (&integrator.coefficients, integrator.problem.truncation);
    let monomials = coefficients.last_orders(truncation).map(|(order, base)| {
        let monomial = coefficients.monomials().get(base).map_or(&[][..], Vec::as_slice);
        format!("({}, &{monomial:?}), ", order == truncation)
    });
    let factors = list(&integrator.problem.algebra.factor_of_coordinates());
    fill(include_str!("last.in"), &[("MONOMIALS", monomials.collect()), ("FACTORS", factors)])
}

/// The entries of a list as Rust writes them; numbers beyond the range of `f64` by a name, for folding to refuse.
pub(crate) fn list(entries: &[impl fmt::Debug]) -> String {
    let text = format!("{entries:?}");
    text.trim_matches(['[', ']']).replace("NaN", "f64::NAN").replace("inf", "f64::NAN")
}
