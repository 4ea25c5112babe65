//! Numbers as a loop over trajectories needs them: how they lie in memory, and which of them move.

use crate::number::{Lanes, Number};

/// Numbers that know how they lie in memory, and which of them are done.
pub(crate) trait Packed<const L: usize>: Number {
    fn load(list: &[f64], i: usize) -> Self;
    fn store(self, list: &mut [f64], i: usize);
    fn lane(self, lane: usize) -> f64;
    /// In live lanes `new`, in others self.
    fn update(self, live: [bool; L], new: Self) -> Self;
}

impl Packed<1> for f64 {
    #[inline(always)]
    fn load(list: &[f64], i: usize) -> Self {
        list.get(i).copied().unwrap_or(0.0)
    }
    #[inline(always)]
    fn store(self, list: &mut [f64], i: usize) {
        if let Some(place) = list.get_mut(i) {
            *place = self;
        }
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn update(self, live: [bool; 1], new: Self) -> Self {
        if live[0] { new } else { self }
    }
}

impl<const L: usize> Packed<L> for Lanes<L> {
    #[inline(always)]
    fn load(list: &[f64], i: usize) -> Self {
        let mut result = [0.0; L];
        for (lane, value) in result.iter_mut().enumerate() {
            *value = list.get(i * L + lane).copied().unwrap_or(0.0);
        }
        Self(result)
    }
    #[inline(always)]
    fn store(self, list: &mut [f64], i: usize) {
        for (lane, value) in self.0.into_iter().enumerate() {
            if let Some(place) = list.get_mut(i * L + lane) {
                *place = value;
            }
        }
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn update(self, live: [bool; L], new: Self) -> Self {
        let mut result = self.0;
        for lane in 0..L {
            if live[lane] {
                result[lane] = new.0[lane];
            }
        }
        Self(result)
    }
}
