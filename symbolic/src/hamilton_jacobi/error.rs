//! Limits and errors of the derivation.

use crate::lie::ChartError;

/// The size at which a derivation stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TermLimit {
    /// The most terms one polynomial may have.
    pub terms: usize,
    /// The most products of coefficients in one derivation. Products of coefficients beyond 127
    /// bits count by their 64-bit words.
    pub products: u64,
}

impl TermLimit {
    /// Allows this many terms in one polynomial, and a number of products in proportion to it.
    pub fn new(terms: usize) -> Self {
        Self { terms, products: (terms as u64).saturating_mul(2000) }
    }
}

impl Default for TermLimit {
    fn default() -> Self {
        Self::new(100_000)
    }
}

/// Reasons for which a derivation stops.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeriveError {
    /// The chart does not exist for the algebra.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The Hamiltonian has fewer variables than the algebra has dimensions.
    #[error(
        "the Hamiltonian has {variables} variables, fewer than the {dimension} momenta of the algebra"
    )]
    Variables {
        /// The number of variables of the Hamiltonian.
        variables: usize,
        /// The dimension of the algebra.
        dimension: usize,
    },
    /// A polynomial grew beyond the limit.
    #[error(
        "too large: order {order} needs at least {terms} terms, more than the limit of {limit}; lower the truncation, or ask for `method = \"collocation\"`"
    )]
    TooLarge {
        /// The order in t at which it happened.
        order: usize,
        /// The number of terms counted when it stopped.
        terms: usize,
        /// The limit.
        limit: usize,
    },
    /// The work grew beyond the limit.
    #[error(
        "too large: order {order} needs at least {products} products of coefficients, more than the limit of {limit}; lower the truncation, or ask for `method = \"collocation\"`"
    )]
    TooMuchWork {
        /// The order in t at which it happened.
        order: usize,
        /// The number of products counted when it stopped.
        products: u64,
        /// The limit.
        limit: u64,
    },
    /// The programs of a step would grow beyond the limit.
    #[error(
        "too large: its gradient and Hessian have about {operations} operations, more than the limit of {limit}"
    )]
    TooManyOperations {
        /// The operations.
        operations: usize,
        /// The limit.
        limit: usize,
    },
    /// The Hamiltonian has too high a degree.
    #[error("the Hamiltonian has degree {degree}; at most {limit} is supported")]
    Degree {
        /// The degree of the Hamiltonian.
        degree: u32,
        /// The limit.
        limit: u32,
    },
}

impl DeriveError {
    /// A note that collocation makes the steps, since nobody asked for the series.
    pub fn gave_way(&self) -> String {
        let text = self.to_string();
        // Without the advice.
        let reason = text.rsplit_once("; ").map_or(&*text, |(reason, _)| reason);
        format!(
            "collocation makes the steps, for the series is {reason}; [integrator] method = \"series\" asks for the series all the same"
        )
    }

    /// True where the series is too large, and not the input at fault.
    pub fn is_of_size(&self) -> bool {
        matches!(
            self,
            Self::TooLarge { .. } | Self::TooMuchWork { .. } | Self::TooManyOperations { .. }
        )
    }
}
