//! Learn the map from data, keep the geometry exactly.
//!
//! Pairs of states one step apart (simulated, measured, noisy, or produced by a bad integrator)
//! are reduced to points (x, p) of a Lagrangian submanifold {x = ∂S/∂p(p)} of T\*G; a model of S
//! is fitted to them and read as a generating function ([`Generating`]). Whatever the model, the
//! map is Poisson, symplectic and G-equivariant, and conserves the spatial momentum and every
//! Casimir to rounding; data decide only how close it is to the true one.
//!
//! Source: M. Vaquero, J. Cortés, D. Martín de Diego, *Symmetry Preservation in Hamiltonian
//! Systems: Simulation and Learning*, sections 5.2–5.4 and conclusions.

pub mod catalogue;
pub mod data;
mod emit;
mod error;
mod evaluate;
pub mod experiment;
mod function;
mod gaussian_process;
mod group;
mod hamilton_jacobi;
mod hamiltonian;
mod hybrid;
mod least_squares;
mod model;
pub mod momentum;
pub mod network;
mod npy;
pub mod polynomial;
mod save;
mod series;
mod session;
mod trivialisation;
pub mod truth;
mod type_two;

pub use emit::{exact_polynomial, problem};
pub use error::{BadRow, BadRows, LearnError, RowProblem};
pub use evaluate::{Drifts, Errors, Figures, drifts, evaluate, evaluate_momenta, evaluate_with};
pub use function::{Generating, MomentumFunction, Scaled, Zero};
pub use gaussian_process::{
    GaussianProcess, GaussianProcessOptions, Uncertainty, fit_gaussian_process,
};
pub use group::{DataGroup, matrix_of};
pub use hamilton_jacobi::{CollocationOptions, TimeDependent, solve_hamilton_jacobi};
pub use hamiltonian::fit_hamiltonian;
pub use hybrid::{fit_hybrid, fit_hybrid_to_gradients};
pub use least_squares::{Descent, GaussNewton};
pub use model::Model;
pub use npy::{NpyError, NpyHeader, npy_header};
pub use save::{ModelFile, TrainingRecord};
pub use series::Monomials;
pub use session::{
    Kind, NetworkSettings, Request, Summary, learn, learn_momenta, remove_checkpoints,
};
pub use type_two::{TypeTwo, TypeTwoData, canonical_pairs, type_two_data};

/// The page on learning; its snippets are tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/learning.md")]
mod page {}
