//! Learns maps on Lie groups from data, with exact geometry.
//!
//! Pairs of states one step apart (simulated, measured, noisy, or produced by a bad integrator)
//! are reduced to points (x, p) of a Lagrangian submanifold {x = ∂S/∂p(p)} of T\*G; a model of S
//! is fitted to them and read as a generating function ([`Generating`]). Whatever the model, the
//! map is Poisson, symplectic and G-equivariant, and conserves the spatial momentum and every
//! Casimir to rounding; data decide only how close it is to the true one.
//!
//! ```
//! use coadjoint::{Phase, SO3};
//! use coadjoint::groups::Exponential;
//! use coadjoint::steps::advance;
//! use coadjoint_learn::data::{RowPolicy, TOLERANCE, reduce};
//! use coadjoint_learn::truth::{MomentumBox, Separable, phase_pairs};
//! use coadjoint_learn::{Generating, polynomial::fit_polynomial};
//!
//! // Sixty pairs (state, state 0.1 later) of a rigid body.
//! let group = SO3::new();
//! let wide = MomentumBox { low: -2.0, high: 2.0 };
//! let pairs = phase_pairs(&group, &Separable::paper(), 0.1, wide, 60, 1).into();
//! let data = reduce::<SO3, Exponential>(&group, &pairs, TOLERANCE, RowPolicy::Refuse)?.data;
//! let model = fit_polynomial(&data, 4, 0.0)?;
//! let map = Generating::<SO3, Exponential, _>::new(group, model);
//! let mut state = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
//! advance(&map, &mut state)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Limits
//!
//! A pair determines S only while its increment stays inside the chart, short of the fold of the canonical
//! momentum. Only polynomial models can be emitted as code.
//!
//! # Features
//!
//! `parquet` (reads and writes `.parquet`).
//!
//! Source: M. Vaquero, J. Cortés, D. Martín de Diego, *Symmetry Preservation in Hamiltonian
//! Systems: Simulation and Learning*, sections 5.2–5.4 and conclusions.

pub mod catalogue;
pub mod data;
mod error;
mod evaluate;
mod function;
mod gaussian_process;
mod group;
mod least_squares;
mod model;
pub mod momentum;
pub mod network;
pub mod polynomial;
mod session;
pub mod table;
pub mod truth;

pub use error::{BadRow, BadRows, LearnError, RowProblem};
pub use evaluate::{Drifts, Errors, Figures, drifts, evaluate, evaluate_momenta, evaluate_with};
pub use function::{Generating, Hamiltonian, MomentumFunction, Scaled};
pub use gaussian_process::{GaussianProcess, fit_gaussian_process};
pub use group::{DataGroup, GroupChoice, OwnAlgebra, matrix_of};
pub use least_squares::GaussNewton;
pub use model::{Model, ModelFile, TrainingRecord, exact_polynomial, fit_hybrid, problem};
pub use session::{Dataset, Kind, Request, Summary, learn, remove_checkpoints};
pub use table::npy_header;
