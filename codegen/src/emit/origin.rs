//! The items of a system, whatever its method.

use crate::emit::collocation::collocation;
use crate::emit::item::{Items, items};
use crate::emit::{Options, TooManyTerms, check_size};
use crate::step::Origin;

/// The items of a system.
///
/// # Errors
/// [`TooManyTerms`] where a series is too large for a compiler.
pub fn items_of(origin: &Origin, options: &Options) -> Result<Items, TooManyTerms> {
    Ok(match origin {
        Origin::Series(integrator) => {
            check_size(integrator)?;
            items(integrator, options)
        }
        Origin::Collocation(smooth) => collocation(smooth, options),
    })
}
