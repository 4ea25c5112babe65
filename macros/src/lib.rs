//! The attribute `lie_poisson`.
