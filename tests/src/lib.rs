//! Helpers that the integration tests share.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

pub mod backends;
pub mod bridge;
pub mod catalogue;
pub mod elliptic;
pub mod erased;
pub mod golden;
pub mod kernels;
pub mod matrix_free;
pub mod moments;
pub mod reference;
pub mod run;
pub mod series;
pub mod stress;
pub mod toutatis;
pub mod toutatis_figure;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::parse::rust;

/// The integrator that the attribute with `arguments` builds from the source of a function.
///
/// # Errors
/// The messages of the attribute.
pub fn from_function(arguments: &str, function: &str) -> syn::Result<Integrator> {
    let problem = rust::lie_poisson(arguments.parse()?, &syn::parse_str(function)?)?;
    Integrator::build(problem, TermLimit::default())
        .map_err(|error| syn::Error::new(proc_macro2::Span::call_site(), error))
}

/// Makes the snippets of pages into tests.
macro_rules! pages {
    ($($name:ident: $path:literal;)*) => {
        $(
            #[cfg(doctest)]
            #[doc = include_str!($path)]
            pub struct $name;
        )*
    };
}

pages! {
    Readme: "../../README.md";
    Codegen: "../../codegen/README.md";
    Macros: "../../macros/README.md";
    Runtime: "../../runtime/README.md";
    Learn: "../../learn/README.md";
    Start: "../../docs/book/src/start.md";
    Hamiltonian: "../../docs/book/src/hamiltonian.md";
    ChartAndStep: "../../docs/book/src/chart-and-step.md";
    Gyrostat: "../../docs/book/src/gyrostat.md";
    Forces: "../../docs/book/src/forces.md";
    Ensembles: "../../docs/book/src/ensembles.md";
    Learning: "../../docs/book/src/learning.md";
    Targets: "../../docs/book/src/targets.md";
}
