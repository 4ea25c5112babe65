//! Steps: as they come, with kicks, watched.

pub use crate::error::{Circumstances, Stopped};
pub use crate::step::kicked::{Flows, Kicked};
pub use crate::step::monitor::{Drift, Monitor};
pub use crate::step::{StepReport, advance, advance_by, poisson_map, reconstruct};
pub use coadjoint_program::splitting::Splitting;
