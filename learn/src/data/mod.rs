//! Data: pairs of states before and after a step, from memory or from files, and their reduction.

mod recording;
mod reduce;

pub use recording::{Attitudes, Recording, open};
pub use reduce::{
    MomentumPairs, PairRows, PhasePair, ReducedData, Reduction, RowPolicy, TOLERANCE, reduce,
};
