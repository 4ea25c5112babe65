//! Steps beyond [`advance`](crate::advance): with settings, with kicks.

pub use crate::error::Circumstances;
pub use crate::solve::Settings;
pub use crate::step::monitor::Drift;
pub use crate::step::splitting::{MAX_FLOWS, Prk4, Prk6, Rkn4, Rkn6, Splitting, Strang};
pub use crate::step::{advance_with, reconstruct};
