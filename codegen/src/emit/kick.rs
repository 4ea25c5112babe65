//! A potential as Rust: a struct with its value and its torque.

use coadjoint_program::quoting::rust_comment;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::generating_function::{scalar_function, vector_function};
use super::table::fold_item;
use crate::emit::group::Types;
use crate::emit::item::{Arguments, arguments};
use crate::emit::{Options, allow, parameter};
use crate::integrator::{FoldTable, Kick};
use crate::lie::Chart;

/// The potential as items: a struct and its implementation.
#[must_use]
pub fn kick(kick: &Kick, options: &Options) -> TokenStream {
    let Options { krate, visibility, name, attributes, .. } = options;
    let potential = &kick.potential;
    let types = Types::new(&potential.algebra, Chart::default(), options);
    let Types { group, vector, definition, tables, aliases, .. } = &types;
    let blank = (!attributes.is_empty()).then(|| quote!(#[doc = ""]));
    let allow = allow();
    let size = Literal::usize_unsuffixed(potential.size());
    let entries = Literal::usize_unsuffixed(potential.size() * potential.size());

    let Arguments { arguments, scalars, .. } = arguments(&potential.parameters, krate);
    let symbols = parameter::symbols(&potential.symbols, &scalars);
    let texts = potential.symbols.iter().map(|s| &s.text);
    let symbol_count = Literal::usize_unsuffixed(potential.symbols.len());
    let slots = Literal::usize_unsuffixed(kick.coefficients.slots().len());
    let fold = FoldTable::of_kick(kick);
    let room = Literal::usize_unsuffixed(fold.lists().room());
    let table = fold_item(&fold);

    let energy = kick.energy.as_ref().map(|energy| scalar_function(energy, options, "g"));
    let torque = vector_function(&kick.torque, vector, options, "g");
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
    let names = ["g", "c", "g", "group", "k", "symbols", "coefficients"];
    let [own, c, element, by, k, own_symbols, coefficients] = names.map(|name| options.bound(name));
    let entries_of_g = quote! {
        let #by = const { &<#group>::new() };
        let #own: [T; #entries] = ::core::array::from_fn(|#k| {
            #krate::LieGroup::matrix_entry(#by, #element, #k / #size, #k % #size)
        });
        let (#own, #c) = (&#own, &self.coefficients);
    };
    quote! {
        #definition

        #attributes
        #blank
        #(#[doc = #summary])*
        #[derive(::core::clone::Clone, ::core::fmt::Debug)]
        #[allow(clippy::trailing_empty_array)]
        #visibility struct #name<T = f64> {
            /// The coefficients of the programs below, folded for the parameters.
            coefficients: [T; #slots],
        }

        #allow
        const _: () = {
            #aliases

            impl<T: #krate::Scalar> #name<T> {
                /// Folds all coefficients for the parameters.
                ///
                /// # Errors
                /// `StepError::InvalidParameter` where a parameter expression is not finite.
                pub fn new(
                    #(#arguments),*
                ) -> ::core::result::Result<Self, #krate::StepError> {
                    let #own_symbols: [T; #symbol_count] = [#(#symbols),*];
                    // No coefficient holds the step size.
                    let #coefficients = #krate::plumbing::fold(
                        &FOLD,
                        [#(#texts),*],
                        (T::of(1.0), &#own_symbols),
                        [0.0; #room],
                    )?;
                    ::core::result::Result::Ok(Self { coefficients: #coefficients })
                }

                /// V(g).
                #[inline]
                pub fn energy(&self, #element: &<#group as #krate::LieGroup>::Element) -> T {
                    #entries_of_g
                    #energy
                }

                /// The body torque −g⁻¹dV(g): component k is −d/ds V(g·exp(s e_k)) at s = 0.
                #[inline]
                pub fn torque(&self, #element: &<#group as #krate::LieGroup>::Element) -> #vector {
                    #entries_of_g
                    #torque
                }
            }

            #table
        };

        #tables
    }
}
