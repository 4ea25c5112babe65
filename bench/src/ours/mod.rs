//! Our methods, as users write them.

mod free_body;

pub use free_body::RigidBody;

use crate::method::Method;

/// Every row of ours.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    RigidBody::all().into_iter().map(|method| Box::new(method) as Box<dyn Method>).collect()
}
