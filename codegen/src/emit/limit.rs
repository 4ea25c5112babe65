//! Limits on the size of emitted code.

use crate::integrator::Integrator;

/// The most terms of S that are emitted as Rust: about 280 spins of a Heisenberg ring at K = 3. The
/// module of 256 spins (17 920 terms, 14.5 MB) took rustc a good minute of processor time in release
/// and 1 GB; that of 128 spins 45 s and 0.6 GB.
pub const MOST_TERMS: usize = 20_000;
/// The most terms that the coefficients of S have as polynomials in the parameters. They are data: one table, read when an
/// integrator is constructed.
pub(crate) const MOST_DATA: usize = 200_000;

/// A generating function with too many terms to emit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "too large to emit: S has {terms} terms, more than the limit of {limit}; {}lower the truncation, \
     or run it in the interpreter with `coadjoint simulate`",
    literals(*.with_literals)
)]
pub struct TooManyTerms {
    /// The terms of S₁ + … + S_K, or those of their coefficients.
    pub terms: usize,
    /// The terms that are left with numbers in place of the parameters, where these make it too large.
    pub with_literals: Option<usize>,
    /// [`MOST_TERMS`], or the limit of what is data.
    pub limit: usize,
}

fn literals(terms: Option<usize>) -> String {
    terms.map_or_else(String::new, |terms| {
        format!(
            "with numbers in place of the parameters it has at most {terms}: write literals; or "
        )
    })
}

/// Whether an integrator is small enough for [`file`](super::file) and [`tokens`](super::tokens):
/// larger ones are written all the same, but take the compiler very long.
///
/// # Errors
/// [`TooManyTerms`].
pub fn check_size(integrator: &Integrator) -> Result<(), TooManyTerms> {
    let terms = integrator.terms();
    // Of symbols the code knows nothing: it has one term to a monomial in the momenta.
    let parameters = !integrator.problem.symbols.is_empty();
    let code = if parameters { integrator.coefficients.series() } else { terms };
    if code > MOST_TERMS {
        return Err(TooManyTerms { terms: code, with_literals: None, limit: MOST_TERMS });
    }
    if terms > MOST_DATA {
        return Err(TooManyTerms { terms, with_literals: Some(code), limit: MOST_DATA });
    }
    Ok(())
}
