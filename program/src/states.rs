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
    /// Room for this many states of `element` numbers of g and `dim` of μ; until they are put there, all numbers are 0.
    pub fn new(element: usize, dim: usize, rows: usize) -> Self {
        let length = (element + dim) * WIDTH;
        Self { numbers: vec![0.0; rows.div_ceil(WIDTH) * length], length }
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

/// Number i of the states of a block; NaN where there is none.
pub fn abreast(block: &[f64], i: usize) -> [f64; WIDTH] {
    block.as_chunks().0.get(i).copied().unwrap_or([f64::NAN; WIDTH])
}

/// The numbers of the state in a lane of a block.
pub fn of_lane(block: &[f64], lane: usize) -> impl Iterator<Item = f64> {
    block.as_chunks::<WIDTH>().0.iter().map(move |numbers| numbers[lane])
}

/// Puts the numbers of a state, those of g and then those of μ, into a lane of a block.
pub fn into_lane(block: &mut [f64], lane: usize, state: [&[f64]; 2]) {
    let mut places = block.as_chunks_mut::<WIDTH>().0.iter_mut();
    for part in state {
        part.iter().zip(&mut places).for_each(|(number, place)| place[lane] = *number);
    }
}
