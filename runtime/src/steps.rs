//! Steps: as they come, with kicks, watched.

pub use crate::error::{Circumstances, Stopped};
pub use crate::step::{
    StepReport, Steps, advance, advance_by,
    kicked::{Flows, Kicked, Piece, compose},
    monitor::{Drift, Monitor},
    poisson_map, reconstruct,
};
pub use coadjoint_program::splitting::Splitting;
