//! Exact derivation of the generating functions of Lie–Poisson systems, and the programs of a step.
//!
//! ```
//! use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive};
//! use coadjoint_symbolic::lie::{Chart, catalogue};
//! use coadjoint_symbolic::number::ratio;
//! use coadjoint_symbolic::poly::Polynomial;
//!
//! // The free rigid body with moments of inertia 1.5, 2 and 2.5.
//! let so3 = catalogue::lookup("SO3")?;
//! let square = |i, divisor| (vec![(i, 2)], ratio(1, divisor));
//! let hamiltonian = Polynomial::from_factors(3, [square(0, 3), square(1, 4), square(2, 5)]);
//! let series = derive(&so3, Chart::Exponential, &hamiltonian, 7, TermLimit::default())?;
//! assert_eq!(series.order(1), &hamiltonian);
//! assert!(series.order(2).is_zero()); // every even term vanishes
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A [`problem::Problem`] is what a front end of `coadjoint-codegen` produces. [`hamilton_jacobi`] solves its equation,
//! [`integrator`] builds programs and a table of coefficients from the series, [`graph`] holds and interprets them, and
//! [`step`] builds all of a step. [`tolerance`] chooses truncation and step size, [`comoving`] and [`potential`] are the
//! moving frame and the kicks.
//!
//! # Features
//!
//! `judge`: the module `judge`, which judges single steps in doubled precision, independently of the runtime.

pub mod cancel;
pub mod comoving;
pub mod drive;
pub mod expr;
pub mod graph;
pub mod hamilton_jacobi;
pub mod integrator;
#[cfg(feature = "judge")]
pub mod judge;
pub mod lie;
mod method;
pub mod nearest;
pub mod number;
pub mod poly;
pub mod potential;
pub mod problem;
pub mod signal;
pub mod smooth;
pub mod spatial;
pub mod step;
pub mod tolerance;
mod units;
