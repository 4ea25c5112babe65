//! Helpers that the integration tests share.
#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used, missing_docs)]

pub mod backends;
pub mod bridge;
pub mod elliptic;
pub mod kernels;
pub mod matrix_free;
pub mod moments;
pub mod order;
pub mod reference;
pub mod run;
pub mod sources;
pub mod stress;
pub mod toutatis;

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
    Lattices: "../../docs/book/src/lattices.md";
    Learning: "../../docs/book/src/learning.md";
    Targets: "../../docs/book/src/targets.md";
}
