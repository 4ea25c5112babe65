//! Why Casimirs were not computed, and the limits of computing them.

/// Monomials of one degree that are looked through at most.
pub(super) const MONOMIALS: usize = 50_000;

/// Multiplications in one elimination at most.
pub(super) const OPERATIONS: u64 = 100_000_000;

/// Why Casimirs were not computed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CasimirError {
    /// Too many monomials.
    #[error(
        "Casimirs of degree {degree} of {algebra} are among more than {limit} monomials; ask for a lower degree"
    )]
    TooLarge {
        /// The algebra.
        algebra: String,
        /// The degree.
        degree: u32,
        /// The most monomials that are looked through.
        limit: usize,
    },
    /// Too much arithmetic.
    #[error(
        "Casimirs of degree {degree} of {algebra} need more than {limit} multiplications; ask for a lower degree"
    )]
    TooMuchWork {
        /// The algebra.
        algebra: String,
        /// The degree.
        degree: u32,
        /// The limit.
        limit: u64,
    },
}
