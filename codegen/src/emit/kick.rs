//! A potential as Rust: a struct with its value and its torque.

use coadjoint_program::quoting::rust_comment;
use proc_macro2::TokenStream;

use super::generating_function::{scalar_function, vector_function};
use super::table::fold_item;
use crate::emit::Options;
use crate::emit::group::Types;
use crate::emit::item::{constructor, doc};
use crate::integrator::{FoldTable, Kick};
use crate::lie::Chart;

/// The potential as items: a struct and its implementation.
#[must_use]
pub fn kick(kick: &Kick, options: &Options) -> TokenStream {
    let potential = &kick.potential;
    let types = Types::new(&potential.algebra, Chart::default(), options);
    let (size, fold) = (potential.size(), FoldTable::of_kick(kick));
    let energy = kick.energy.as_ref().map(|energy| scalar_function(energy, options, "g"));
    let cost = kick.torque.cost();
    let summary = [
        format!(" Potential: `{}`", rust_comment(&potential.source)),
        String::new(),
        format!(
            " Group: {}. Torque: {} multiplications and {} additions.",
            rust_comment(potential.algebra.name()),
            cost.multiplications,
            cost.additions
        ),
    ];
    let mut values = types.values();
    values.extend(constructor(&potential.parameters, &potential.symbols, &fold, options));
    values.extend([
        ("BLANK", (!options.attributes.is_empty()).to_string()),
        ("SUMMARY", summary.iter().map(doc).collect()),
        ("SIZE", size.to_string()),
        ("ENTRIES", (size * size).to_string()),
        ("ENERGY", energy.unwrap_or_default()),
        ("TORQUE", vector_function(&kick.torque, &types.vector, options, "g")),
        ("TABLE", fold_item(&fold)),
    ]);
    options.tokens(&options.fill(include_str!("kick.in"), &values))
}
