//! The limits up to which steps are accepted, by kernels and by the runtime's generic step. All come from experiments
//! (`docs/measurements`).

/// The ratio of the last two terms of a series up to which it is trusted.
pub const LARGEST_RATIO: f64 = 0.5;

/// The distance of a solution from its first guess, relative to the largest coordinate of μ, up to which it is the one
/// continued from the identity, if nothing else speaks against it.
pub const NEAR: f64 = 0.05;

/// The rate at which motions part that a half turn counts as, where a step is solved by the fixed point, without the Hessian
/// of S. The other part of the rate, twice the spectral radius of ∂p/∂x·Hess S, is at most about 1.2 where the fixed point
/// converges in the evaluations that it has.
pub const RATE_OF_HALF_TURN: f64 = 4.0;

/// The last term of a series that is what rounding leaves of one that cancels (of a spherical body, say), in units of the number
/// type's rounding, for coordinates of order one: its ratio means nothing.
pub const NEGLIGIBLE: f64 = 16.0;
