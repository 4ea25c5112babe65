//! Reasons for which an error is not known.

use crate::number::brief;

/// The reasons for which the error at the end of a run is not known.
#[derive(Clone, Debug, PartialEq)]
pub enum Unknown {
    /// Runs in steps of other sizes end elsewhere.
    Unresolved {
        /// Until this time they go together.
        until: f64,
    },
    /// Another reason.
    Other(&'static str),
}

impl Unknown {
    /// Nobody has asked for an estimate.
    pub const OFF: Self = Self::Other("not estimated");
    /// The steps have the size that the map was learned for.
    pub(crate) const LEARNED: Self = Self::Other("not known: a learned map has steps of one size");
    pub(super) const REFUSED: Self =
        Self::Other("not known: steps of other sizes are refused on the way");
    pub(super) const STOPPED: Self = Self::Other("not known: the estimate was interrupted");
}

impl std::fmt::Display for Unknown {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Other(why) => f.write_str(why),
            Self::Unresolved { until } => write!(
                f,
                "not known: runs in steps of other sizes end elsewhere, and go together until time {}",
                brief(*until)
            ),
        }
    }
}
