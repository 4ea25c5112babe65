//! Many free bodies: nanoseconds per trajectory and unit of time on one core.

mod bodies;
mod compare;
mod method;
mod ours;

pub use bodies::bodies;
pub use compare::{Row, compare, markdown};
pub use method::{EnsembleMethod, OneByOne, TaylorBatch};
pub use ours::ours;

use crate::{
    method::Setting,
    peers::{
        dop853::Dop853,
        embedded::Adaptive,
        general::General,
        moser_veselov::{Form, MoserVeselov},
        taylor::Taylor,
    },
};

/// The peers, with settings that span errors from 1e−5 to 1e−13.
#[must_use]
pub fn peers() -> Vec<Box<dyn EnsembleMethod>> {
    let tolerances = || (6..=13).map(|k| Setting::Tolerance(10f64.powi(-k))).collect();
    let steps = || [0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1].map(Setting::Step).to_vec();
    vec![
        Box::new(OneByOne::new(
            General::new("DOP853", "DOP853", 8, Adaptive(Dop853)),
            tolerances(),
        )),
        Box::new(OneByOne::new(Taylor::<17>::adaptive(), tolerances())),
        Box::new(TaylorBatch::<13, 4>::default()),
        Box::new(TaylorBatch::<17, 4>::default()),
        Box::new(TaylorBatch::<21, 4>::default()),
        Box::new(TaylorBatch::<13, 8>::default()),
        Box::new(TaylorBatch::<17, 8>::default()),
        Box::new(TaylorBatch::<21, 8>::default()),
        Box::new(OneByOne::new(MoserVeselov::new(10, Form::Newton), steps())),
    ]
}
