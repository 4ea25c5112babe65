//! Steps by collocation, for Hamiltonians that are no polynomials.

use coadjoint_program::Precision;
use coadjoint_program::print::{Dialect, Field, Signature};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::generating_function::unit;
use super::header::Method;
use super::item::{Items, Parts, assemble, bound, printed};
use super::program::{Rust, tokens};
use super::programs::functions;
use crate::drive::Drive;
use crate::emit::Options;
use crate::emit::group::Types;
use crate::graph::Program;
use crate::integrator::FoldTable;
use crate::lie::Chart;
use crate::smooth::Smooth;
use crate::step::Step;

/// The integrator of a smooth Hamiltonian as items.
#[must_use]
pub(crate) fn collocation(smooth: &Smooth, options: &Options) -> Items {
    let types = Types::new(&smooth.algebra, Chart::Exponential, options);
    let step = printed(Step::by_collocation(smooth, Precision::Double, types.elements));
    let [mu, c, time] = ["mu", "c", "time"].map(|name| options.bound(name));
    let now = if smooth.depends_on_time() { quote!(#time) } else { quote!(T::of(0.0)) };
    let parts = Parts {
        facts: smooth.facts(),
        method: Method::of_collocation(smooth),
        symbols: &smooth.symbols,
        fold: FoldTable::of_symbols(smooth.symbols.len(), None, Some),
        order: 2 * smooth.nodes(),
        about: [
            " K, as it was asked for.",
            " The coefficients of the programs below: the symbols, h, and a radius that is infinite.",
        ],
        // Steps go by those before them.
        together: Some(quote!(u64::MAX)),
        energy: quote!(value(#c, #mu, #now)),
        methods: TokenStream::new(),
        programs: programs(smooth, options, &types, step.as_ref()),
        step,
        types,
    };
    assemble(&parts, None, None, options)
}

/// `impl Steps`: by the programs of a step, and where they refuse one by the runtime, which is given the energy.
fn programs(smooth: &Smooth, options: &Options, types: &Types, step: Option<&Step>) -> TokenStream {
    let Options { krate, name, .. } = options;
    let Types { group, vector, .. } = types;
    let (energy, over) = (format_ident!("{name}Energy"), format_ident!("{name}Over"));
    let names = ["phase", "since", "asked", "state"];
    let [phase, since, asked, state] = names.map(|name| options.bound(name));
    let index = Literal::usize_unsuffixed;
    let [nodes, n, symbols] = [smooth.nodes(), types.dim, smooth.symbols.len()].map(index);
    let moves = smooth.depends_on_time();
    let now = match moves {
        true => quote!(#since.0 + T::of(#since.1 as f64) * self.step),
        false => quote!(#since.0),
    };
    let functions_of_step = step.map(|step| functions(step, options));
    let drive = match step {
        Some(_) => {
            let time = moves.then(|| quote!(#now,));
            quote! {
                let #state = plumbing::load(#phase);
                plumbing::store(#phase, steps(&self.coefficients, #state, #time #asked))
            }
        }
        None => quote!(plumbing::Driven::none(T::of(0.0))),
    };
    let bound = bound(moves, krate);
    let driven = smooth.drive.as_deref().map(|drive| driven(drive, options, types, &energy));
    let beside = if driven.is_some() { quote!(#energy(symbols)) } else { quote!(()) };
    let functions_of_energy = functions_of_energy(smooth, options, types.dim);
    let (expressions, unit) = (&smooth.expressions, unit(&smooth.units));
    let vector64 = quote!(#krate::nalgebra::SVector<f64, #n>);
    quote! {
        #functions_of_step

        type #over<T> = #group;

        impl<T: #bound> plumbing::Steps for #name<T> {
            type Group = #group;

            #[inline(always)]
            fn drive_from(
                &self,
                #phase: &mut #krate::Phase<#group>,
                #since: (T, u64),
                #asked: u64,
            ) -> plumbing::DrivenIn<#group> {
                #drive
            }

            #[cold]
            fn by_hand(
                &self,
                #phase: &mut #krate::Phase<#group>,
                #since: (T, u64),
                _: ::core::option::Option<(#vector, T)>,
            ) -> ::core::result::Result<#krate::steps::StepReport<T>, #krate::StepError> {
                plumbing::collocated::<
                    _, #over<f64>, _, _, #nodes, #n, #symbols,
                    { <#over<f64> as plumbing::ElementNumbers>::COUNT },
                >(#phase, [#now, self.step], &self.symbols, |symbols| (#energy(symbols), #beside))
            }
        }

        #functions_of_energy

        /// The Hamiltonian, given its symbols, for the steps that programs refuse.
        struct #energy([f64; #symbols]);

        impl #krate::collocation::Energy<#vector64> for #energy {
            fn value(&self, time: f64, mu: &#vector64) -> f64 {
                value(&self.0, &mu.data.0[0], time)
            }

            fn gradient(&self, time: f64, mu: &#vector64) -> #vector64 {
                gradient(&self.0, &mu.data.0[0], time).into()
            }

            fn reach(
                &self,
                (time, mu): (f64, &#vector64),
                (then, next): (f64, &#vector64),
            ) -> ::core::option::Option<f64> {
                let [mu, next] = [&mu.data.0[0], &next.data.0[0]];
                ::core::option::Option::Some(reach(&self.0, mu, time, next, then))
            }

            #unit

            fn undefined(
                &self,
                time: f64,
                mu: &#vector64,
            ) -> ::core::option::Option<#krate::collocation::Undefined> {
                let watched = watched(&self.0, &mu.data.0[0], time);
                plumbing::undefined(&[#(#expressions),*], &watched)
            }
        }

        #driven
    }
}

/// `impl Drive` for the energy: the velocity and the torque beside it, for the steps that programs refuse.
fn driven(drive: &Drive, options: &Options, types: &Types, energy: &Ident) -> TokenStream {
    let Options { krate, name, .. } = options;
    let over = format_ident!("{name}Over");
    let dialect = Rust::alone(options.suffix);
    let lists = [("g", drive.entries), ("mu", types.dim), ("omega", types.dim)];
    let function = |name: &str, program: &Program| {
        let program = &drive.of_system(program);
        let inputs = lists.iter().map(|(list, len)| Field::array(&dialect.bound(list), *len));
        let inputs = inputs.chain([Field::number(&dialect.bound("time"))]).collect();
        let outputs = vec![Field::array("", program.outputs().len())];
        let signature = Signature { name: name.to_owned(), program, inputs, outputs };
        dialect.function(&signature, &dialect.body(&signature))
    };
    let functions = [("acting", &drive.program), ("watched_in_drive", &drive.watched)];
    let functions = tokens(&functions.map(|(name, program)| function(name, program)).concat());
    let [n, entries, rows] =
        [types.dim, drive.entries, drive.entries.isqrt()].map(Literal::usize_unsuffixed);
    let (vector, expressions) = (quote!(#krate::nalgebra::SVector<f64, #n>), &drive.expressions);
    let element = quote!(<#over<f64> as #krate::LieGroup>::Element);
    let state = quote! {
        let mut entries = [0.0; #entries];
        #krate::LieGroup::matrix_entries(
            &<#over<f64> as ::core::default::Default>::default(),
            g,
            &mut |i, j, entry| if let ::core::option::Option::Some(own) = entries.get_mut(i * #rows + j) {
                *own = entry;
            },
        );
    };
    let arguments = quote!(&self.0, &entries, &mu.data.0[0], &omega.data.0[0], time);
    quote! {
        #functions

        impl #krate::collocation::Drive<#over<f64>> for #energy {
            fn acting(
                &self,
                time: f64,
                g: &#element,
                mu: &#vector,
                omega: &#vector,
            ) -> [#vector; 2] {
                #state
                let both = acting(#arguments);
                [<#vector>::from_fn(|i, _| both[i]), <#vector>::from_fn(|i, _| both[#n + i])]
            }

            fn undefined(
                &self,
                time: f64,
                g: &#element,
                mu: &#vector,
                omega: &#vector,
            ) -> ::core::option::Option<#krate::collocation::Undefined> {
                #state
                plumbing::undefined(&[#(#expressions),*], &watched_in_drive(#arguments))
            }
        }
    }
}

/// The programs of the Hamiltonian as functions.
fn functions_of_energy(smooth: &Smooth, options: &Options, dim: usize) -> TokenStream {
    let dialect = Rust::alone(options.suffix);
    let function = |name: &str, program: &Program, states: &[[&str; 2]]| {
        let fields = |[mu, time]: &[&str; 2]| {
            [Field::array(&dialect.bound(mu), dim), Field::number(&dialect.bound(time))]
        };
        let inputs = states.iter().flat_map(fields).collect();
        let outputs = vec![match program.outputs().len() {
            1 if name != "gradient" => Field::number(""),
            len => Field::array("", len),
        }];
        let signature = Signature { name: name.to_owned(), program, inputs, outputs };
        dialect.function(&signature, &dialect.body(&signature))
    };
    let state = ["mu", "time"];
    let functions = [
        function("value", &smooth.value, &[state]),
        function("gradient", &smooth.gradient, &[state]),
        function("watched", &smooth.watched, &[state]),
        function("reach", &smooth.reach, &[state, ["next", "then"]]),
    ];
    tokens(&functions.concat())
}
