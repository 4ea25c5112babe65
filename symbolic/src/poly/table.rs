//! A hash table from monomials to places in a list.
//!
//! The standard map costs ten times as much in an unoptimised build, which a proc macro is. The
//! order of the list is that of insertion; nothing depends on the hash.

use super::monomial::Key;

const EMPTY: u32 = u32::MAX;

/// Monomials in order of insertion, found by hashing.
pub(crate) struct Table<K> {
    pub(crate) keys: Vec<K>,
    slots: Vec<u32>,
    shift: u32,
}

impl<K: Key> Table<K> {
    /// A table with room for about `expected` monomials.
    pub(crate) fn new(expected: usize) -> Self {
        let bits = usize::BITS - expected.clamp(8, 1 << 20).leading_zeros() + 1;
        Self { keys: Vec::new(), slots: vec![EMPTY; 1 << bits], shift: 64 - bits }
    }

    /// The place of a monomial, which is the length of the list if it is new.
    #[inline(always)]
    pub(crate) fn place(&mut self, key: K) -> usize {
        let mask = self.slots.len() - 1;
        let slots = self.slots.as_mut_slice();
        let mut slot = (key.hash() >> self.shift) as usize;
        loop {
            let place = slots[slot];
            if place == EMPTY {
                break;
            }
            if self.keys.as_slice()[place as usize] == key {
                return place as usize;
            }
            slot = (slot + 1) & mask;
        }
        slots[slot] = self.keys.len() as u32;
        self.keys.push(key);
        if self.keys.len() * 2 > slots.len() {
            self.grow();
        }
        self.keys.len() - 1
    }

    fn grow(&mut self) {
        self.shift -= 1;
        let size = self.slots.len() * 2;
        self.slots = vec![EMPTY; size];
        for (place, key) in self.keys.iter().enumerate() {
            let mut slot = (key.hash() >> self.shift) as usize;
            while self.slots[slot] != EMPTY {
                slot = (slot + 1) & (size - 1);
            }
            self.slots[slot] = place as u32;
        }
    }
}
