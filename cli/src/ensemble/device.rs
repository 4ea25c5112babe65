//! The devices that the command line names.

use coadjoint_program::Precision;
use coadjoint_run::ensemble::Asked;

use crate::arguments::EnsembleOptions;

/// A precision by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum PrecisionName {
    /// 64 bits: the bits of every other way
    #[default]
    Double,
    /// 32 bits: faster on most cards; what is conserved drifts by 1e-7 and above
    Single,
}

impl From<PrecisionName> for Precision {
    fn from(name: PrecisionName) -> Self {
        match name {
            PrecisionName::Double => Self::Double,
            PrecisionName::Single => Self::Single,
        }
    }
}

/// The device that the command line asks for.
pub fn asked(options: &EnsembleOptions) -> Option<Asked> {
    let precision = options.precision.into();
    options.device.map(|device| Asked { device, precision })
}
