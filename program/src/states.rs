//! States of many trajectories, in the order in which kernels move them side by side.

use alloc::vec;
use alloc::vec::Vec;

use crate::kernel::WIDTH;

/// States (g, μ) in blocks of [`WIDTH`]: the numbers of g, then those of μ, number i of the state in lane r of a block at
/// `i * WIDTH + r`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct States {
    numbers: Vec<f64>,
    /// The number of numbers of a block.
    length: usize,
}

impl States {
    /// This many states of `element` numbers of g and `dim` of μ, which are not known yet: their numbers are NaN.
    pub fn new(element: usize, dim: usize, rows: usize) -> Self {
        let length = (element + dim) * WIDTH;
        Self { numbers: vec![f64::NAN; rows.div_ceil(WIDTH) * length], length }
    }

    /// The number of numbers of a block.
    pub fn length(&self) -> usize {
        self.length
    }

    /// All blocks, one after the other.
    pub fn blocks(&self) -> &[f64] {
        &self.numbers
    }

    /// All blocks, one after the other.
    pub fn blocks_mut(&mut self) -> &mut [f64] {
        &mut self.numbers
    }
}

/// The numbers of the state in a lane of a block.
pub fn of_lane(block: &[f64], lane: usize) -> impl Iterator<Item = f64> + '_ {
    block.iter().skip(lane).step_by(WIDTH).copied()
}

/// Puts the numbers of a state, those of g and then those of μ, into a lane of a block.
pub fn into_lane(block: &mut [f64], lane: usize, numbers: impl IntoIterator<Item = f64>) {
    let places = block.iter_mut().skip(lane).step_by(WIDTH);
    places.zip(numbers).for_each(|(place, number)| *place = number);
}
