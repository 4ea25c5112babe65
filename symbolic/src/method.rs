//! The method of a system whose input leaves it open: the series, or collocation where the series is dear.

use crate::hamilton_jacobi::{self, DeriveError, TermLimit};
use crate::integrator::operations;
use crate::problem::Problem;
use crate::smooth::{Hamiltonian, Smooth};

/// The operations of ∂S and Hess S up to which programs are made from a series where the method is open. Of four spins on a
/// ring, K = 7, they are 4.5·10⁵, and of 32 with K = 5 9·10⁵: their programs take about one second and two.
const MOST_OPERATIONS: usize = 600_000;

impl TermLimit {
    /// The limit of a derivation where the method is open: it then takes no more than about two seconds.
    #[must_use]
    pub fn of_open_method() -> Self {
        Self { products: 150_000_000, ..Self::default() }
    }
}

impl Hamiltonian {
    /// This system with its method: where the input leaves that open, and the series is too large or its programs take more than
    /// about two seconds to make, steps are made by collocation; then also the reason. Work is counted, not timed, so that a
    /// system has the same method on every machine.
    #[must_use]
    pub fn settled(self) -> (Self, Option<DeriveError>) {
        match self {
            Self::Polynomial(problem, Some(open)) => match too_dear(&problem) {
                Some(reason) => {
                    let truncation = problem.truncation;
                    (Self::Smooth(Box::new(Smooth { truncation, ..*open })), Some(reason))
                }
                None => (Self::Polynomial(problem, None), None),
            },
            settled => (settled, None),
        }
    }
}

/// The reason for which the series of a problem is too dear where there is another method.
fn too_dear(problem: &Problem) -> Option<DeriveError> {
    let Problem { algebra, chart, truncation, .. } = problem;
    let limit = TermLimit::of_open_method();
    match hamilton_jacobi::derive(algebra, *chart, problem.generated(), *truncation, limit) {
        Ok(series) => {
            let operations = operations(algebra.dim(), *truncation, &series);
            (operations > MOST_OPERATIONS)
                .then_some(DeriveError::TooManyOperations { operations, limit: MOST_OPERATIONS })
        }
        Err(error) => error.is_of_size().then_some(error),
    }
}
