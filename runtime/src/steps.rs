//! Steps: as they come, with kicks, watched.

pub use crate::error::{Circumstances, Stopped};
pub use crate::step::kicked::Kicked;
pub use crate::step::monitor::{Drift, Monitor};
pub use crate::step::splitting::{MAX_FLOWS, Prk4, Prk6, Rkn4, Rkn6, Splitting, Strang};
pub use crate::step::{StepReport, advance, advance_by, poisson_map, reconstruct};
