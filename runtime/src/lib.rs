//! Integrators for Hamiltonian systems on Lie groups that conserve momentum and Casimirs exactly.
//!
//! Write the reduced Hamiltonian H_red(μ) once; [`lie_poisson`] derives the generating function of
//! its flow in exact rational arithmetic and emits a step specialised to it: symplectic on T\*G,
//! Poisson on 𝔤\*, equivariant, of order 2, 4, 6, 8, …, free of allocation.
//!
//! ```
//! use coadjoint::{lie_poisson, Phase, SO3};
//!
//! /// Free rigid body, moments of inertia in kg m².
//! #[lie_poisson(group = SO3, truncation = 7)]
//! pub fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
//!     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
//! }
//!
//! # fn main() -> Result<(), coadjoint::StepError> {
//! let step = RigidBody::new(0.1, [1.5, 2.0, 2.5])?; // coefficients are folded here, once
//! let mut body = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
//! for _ in 0..1000 {
//!     step.advance(&mut body)?; // no allocation, no panic
//! }
//! let spatial = body.spatial_momentum(&SO3::new());
//! assert!((spatial.x - 2.0).abs() < 1e-13);
//! # Ok(())
//! # }
//! ```
//!
//! # The one interface
//!
//! A [`GeneratingFunction`] gives S(p), ∂S/∂p and ∂²S/∂p². [`steps::poisson_map`] and [`steps::advance`] turn any
//! of them into a map: the truncated Hamilton–Jacobi series that the attribute emits, or a function
//! learned from data. The new momentum is the group action on the old one, so momentum and Casimirs
//! are kept whatever the function; the solve only decides how exactly the map is symplectic, and it
//! goes to rounding.
//!
//! # Limits
//!
//! A series needs a polynomial H_red in μ (its coefficients may be any expressions of parameters); any
//! other smooth H_red takes steps by [`collocation`]. A step must stay inside the chart: about h|Ω| < 2 for the exponential chart on SO(3); beyond it a step
//! returns [`StepError::NotConverged`] and leaves the state as it was. Conventions (left
//! trivialisation, signs) are those of [`LieGroup`].
//!
//! # Features
//!
//! `std` (default), `alloc`, `libm` (for `no_std`), `ensemble` (many trajectories in SIMD lanes and
//! threads), `systems` (tops, bodies, spins and waves, ready to integrate).
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "alloc")]
extern crate alloc;
// Generated code names the runtime by its absolute path, here too.
#[cfg(all(feature = "systems", not(test)))]
extern crate self as coadjoint;

mod chart;
pub mod collocation;
mod error;
pub mod generating;
mod group;
pub mod groups;
pub mod lanes;
#[cfg(feature = "alloc")]
pub mod lattice;
#[cfg(feature = "alloc")]
pub mod laws;
mod linear;
mod number;
#[doc(hidden)]
pub mod plumbing;
pub mod solve;
mod step;
pub mod steps;
// Without tests of their own here (`tests/tests/systems_*.rs` has them), and half a minute of derivations.
#[cfg(all(feature = "systems", not(test)))]
pub mod systems;
mod table;

/// Turns a function computing a reduced Hamiltonian into an integrator.
///
/// ```
/// use coadjoint::{lie_poisson, Phase, SO3};
///
/// #[lie_poisson(group = SO3, truncation = 3, chart = cayley)]
/// fn dumbbell(mu: [f64; 3], transverse: f64, axial: f64) -> f64 {
///     let [x, y, z] = mu;
///     (x * x + y * y) / (2.0 * transverse) + z * z / (2.0 * axial)
/// }
///
/// # fn main() -> Result<(), coadjoint::StepError> {
/// let step = Dumbbell::new(0.1, 2.0, 1.0)?;
/// let mut phase = Phase::<SO3>::at_identity([1.0, 0.0, 1.0]);
/// step.advance(&mut phase)?;
/// assert_eq!(dumbbell([1.0, 0.0, 1.0], 2.0, 1.0), 0.75); // still a function
/// # Ok(())
/// # }
/// ```
///
/// # Arguments
///
/// - `group`: the Lie group: `SO3`, `SE3`, `SO4`, `SU3`, …, products such as `SO3 * SO3` and `SO3^4`,
///   `"SO3 |x R3"` (in quotes), or one of your own: `algebra(basis = [[[0, -1], [1, 0]]])`,
///   `algebra(generators = [a, b, c], brackets = ["[a, b] = c", "[a, c] = -1/2*b"])`. The momentum's
///   coordinates are dual to its basis.
/// - `truncation = K`, odd, 7 by default: S₁ … S_K are kept. The order of accuracy is K + 1.
/// - `chart = exp` (default) or `chart = cayley`.
/// - `solver = newton` (default up to 24 dimensions) or `solver = fixed_point` (default beyond): see
///   [`solve`].
/// - `frame = auto` (default), `frame = fixed` or `frame = comoving`: whether S generates the whole motion, or what is
///   left of it without the precession in a field, the spin of a symmetric body and multiples of quadratic Casimirs, which
///   are exponentials of their own ([`GeneratingFunction::frame`]). Then there are fewer terms, and
///   steps may be two to five times as long, for a fast symmetric top thirty times. `auto` is comoving where a linear term
///   of H commutes with the rest.
///
/// # The function
///
/// The first argument is the momentum, `[f64; n]` or an nalgebra vector; the others are parameters.
/// The body is evaluated while compiling, as far as its course is known then. It may have
///
/// - `let` with patterns (names, `[a, b, ..]`, tuples, `_`), assignments, also `+=` and the like, `const`, `use`, `return`;
/// - `for` over ranges, arrays and their iterators, `while` and `if` whose conditions compare integers known beforehand;
/// - `+ - * /` of numbers, and of integers `%` too; `as`, `f64::from`, the constants `PI`, `TAU`, `E` and `SQRT_2`;
/// - the functions below, `abs`, `recip`, `powi`, `powf`, `mul_add`, of numbers;
/// - arrays and tuples by index; closures and `fn` items; `iter`, `copied`, `map`, `zip`, `enumerate`, `rev`, `fold`, `sum`,
///   `len`;
/// - nalgebra's vectors and matrices: sums, products, entries (`v.x`, `v[i]`, `a[(i, j)]`), `dot`, `cross`, `norm`,
///   `norm_squared`, `component_mul`, `component_div`, `fixed_rows`, and `new`, `from` and `x`, `y`, `z` of types of vectors.
///
/// Anything else is an error that says what to write instead. Decimal literals are exact: `0.1` is 1/10.
///
/// A polynomial in the momentum has a series. With functions (`sqrt`, `exp`, `ln`, `sin`, `cos`, `tan`, `atan`,
/// `tanh`, real powers) or quotients of the momentum it has none, and steps are made by [`collocation`], in the chart that
/// this has for the group. Steps of one call of `advance_by` begin with a guess from those before them; `advance` knows none,
/// and takes up to twice as long. With `time = t` the argument `t: f64` is the time; `advance`, `advance_by` and `energy` then
/// take that of the state, in numbers of 64 bits.
///
/// ```
/// use coadjoint::{Phase, SO3, lie_poisson};
///
/// /// A body at speeds near that of light.
/// #[lie_poisson(group = SO3)]
/// fn fast_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     let [x, y, z] = mu;
///     (1.0 + x * x / inertia[0] + y * y / inertia[1] + z * z / inertia[2]).sqrt()
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let step = FastBody::new(0.2, [1.5, 2.0, 2.5])?;
/// let mut state = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
/// let before = step.energy(&state.momentum);
/// step.advance_by(&mut state, 1000)?;
/// assert!((step.energy(&state.momentum) - before).abs() < 1e-10);
/// # Ok(())
/// # }
/// ```
///
/// # Velocities and torques
///
/// A function with the attribute `#[velocity]` or `#[torque]` in the body acts beside the Hamiltonian: with ω = ∂H/∂μ, a velocity η
/// and a torque τ the motion is ġ = g (ω + η), μ̇ = ad\*_(ω + η) μ + τ. It returns a number for each coordinate of the momentum, and
/// has any of these arguments: the time `t: f64`, the matrix `g: [[f64; m]; m]` of the group element, the momentum `mu` and the
/// velocity `omega`, each `[f64; n]` or a vector of nalgebra; parameters of the Hamiltonian, by their names; and parameters of its
/// own, which `new` takes after those. With `#[velocity_in_space]` and `#[torque_in_space]`, on groups of rotations and motions, it is along
/// the axes of space. Steps are made by collocation.
///
/// ```
/// use coadjoint::{Phase, SO3, lie_poisson};
///
/// /// A body that the air slows down.
/// #[lie_poisson(group = SO3)]
/// fn slow_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     #[torque]
///     fn drag(mu: [f64; 3], rate: f64) -> [f64; 3] {
///         mu.map(|m| -rate * m)
///     }
///     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let step = SlowBody::new(0.1, [1.5, 2.0, 2.5], 0.2)?;
/// let mut state = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
/// let before = state.momentum.norm();
/// step.advance_by(&mut state, 100)?;
/// assert!((state.momentum.norm() / before - f64::exp(-0.2 * 10.0)).abs() < 1e-10);
/// # Ok(())
/// # }
/// ```
///
/// # What it generates
///
/// A struct named after the function in camel case, generic over the scalar ([`Scalar`]): `new(step,
/// parameters…)`, `advance`, `advance_by`, `energy`, `step`, and the implementation of [`lanes::Lanes`] where H does not depend on
/// the time; for a polynomial also `poisson_map` and the implementation of [`GeneratingFunction`].
/// Every mistake in the function is reported at its place.
#[cfg(feature = "macros")]
pub use coadjoint_macros::lie_poisson;

/// Turns a function computing a potential V(g) into its body torque −g⁻¹dV(g), derived exactly, for
/// the kicks of [`steps::Kicked`].
///
/// ```
/// use coadjoint::{LieGroup, Phase, SO3, lie_poisson, potential};
/// use coadjoint::steps::{Kicked, Splitting};
///
/// #[lie_poisson(group = SO3)]
/// fn pendulum(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
///     0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
/// }
///
/// /// The height of the body's third axis.
/// #[potential(group = SO3)]
/// fn height(g: [[f64; 3]; 3], weight: f64) -> f64 {
///     weight * g[2][2]
/// }
///
/// # fn main() -> Result<(), coadjoint::StepError> {
/// let height = Height::new(1.2)?;
/// let torque = |_time: f64, g: &_| height.torque(g);
/// let step = Kicked::new(Splitting::Rkn4, 0.05, torque, |h| Pendulum::new(h, [1.0, 1.5, 1.0]))?;
/// let mut state = Phase::<SO3>::new(SO3::new().exp(&[0.4, 0.0, 0.0].into()), [0.3, 0.2, 0.0]);
/// let energy = |s: &Phase<SO3>| {
///     pendulum(s.momentum.into(), [1.0, 1.5, 1.0]) + height.energy(&s.group_element)
/// };
/// let before = energy(&state);
/// for n in 0..200 {
///     step.advance(&mut state, 0.05 * f64::from(n))?;
/// }
/// assert!((energy(&state) - before).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
///
/// The only argument is `group`, as for [`lie_poisson`]. The function's first argument is the group
/// element's matrix, `[[f64; d]; d]` or an nalgebra matrix, of which it is any smooth function; the
/// others are parameters. What is generated is a struct with `new(parameters…)`, `energy(&g)` and
/// `torque(&g)`. Making one is cheap, so a potential that moves in time is one whose parameters
/// (the direction to the Earth, say) change from kick to kick.
#[cfg(feature = "macros")]
pub use coadjoint_macros::potential;
pub use nalgebra;

pub use error::StepError;
pub use generating::GeneratingFunction;
pub use group::{LieGroup, phase::Phase, se3::SE3, so3::SO3};
pub use number::Scalar;
