//! Systems people study, ready to integrate (feature `systems`).
//!
//! Each is the plain function of its Hamiltonian and, beside it, the integrator that
//! [`lie_poisson`](crate::lie_poisson) makes of it. The files of `examples/` hold the same systems
//! with numbers, and say what is known about them in closed form. Free and symmetric bodies are
//! integrated in the comoving frame.
//!
//! ```
//! use coadjoint::systems::LagrangeTop;
//! use coadjoint::{Phase, SE3};
//!
//! # fn main() -> Result<(), coadjoint::StepError> {
//! // Moments 0.5 and 0.3 kg m² about the tip, m g l = 1.2 N m.
//! let step = LagrangeTop::new(0.05, 0.5, 0.3, 1.2)?;
//! let mut top = Phase::<SE3>::at_identity([0.1, 0.0, 1.5, 0.6, 0.0, 0.8]);
//! for _ in 0..200 {
//!     step.advance(&mut top)?;
//! }
//! assert!((top.momentum[2] - 1.5).abs() < 1e-13); // Π₃ is an integral
//! # Ok(())
//! # }
//! ```
//!
//! | system | group | integrator |
//! |---|---|---|
//! | free rigid body, principal axes | SO3 | [`FreeBody`] |
//! | free rigid body, full inertia tensor | SO3 | [`FreeBodyFullInertia`] |
//! | gyrostat, dual-spin spacecraft | SO3 | [`Gyrostat`] |
//! | heavy top | SE3 | [`HeavyTop`] |
//! | Lagrange's top | SE3 | [`LagrangeTop`] |
//! | Kovalevskaya's top | SE3 | [`KovalevskayaTop`] |
//! | Goryachev–Chaplygin top | SE3 | [`GoryachevChaplyginTop`] |
//! | Kirchhoff's body in a fluid | SE3 | [`KirchhoffBody`] |
//! | Clebsch's case | SE3 | [`ClebschCase`] |
//! | Manakov's body | SO4 | [`ManakovBody`] |
//! | quadratic Hamiltonian on su(3)* | SU3 | [`Su3Body`] |
//! | three-wave interaction | SU3 | [`ThreeWaveInteraction`] |
//! | Zeitlin's vorticity, N = 3 | SU3 | [`ZeitlinVorticity3`] |
//! | Zeitlin's vorticity, N = 5 | SU5 | [`ZeitlinVorticity5`] |
//! | Heisenberg spin ring | SO3^4 | [`HeisenbergSpinRing`] |
//! | Toda's lattice, four particles | by brackets | [`TodaLattice`] |
//! | gravity gradient on a satellite, a potential | SO3 | [`GravityGradient`] |

mod body;
mod fluid;
mod lattice;
mod orbit;
mod spin;
mod top;
mod unitary;

pub use body::*;
pub use fluid::*;
pub use lattice::*;
pub use orbit::*;
pub use spin::*;
pub use top::*;
pub use unitary::*;
