//! How much work guesses are worth.

/// Blocks of steps over which costs are compared.
const WINDOW: u32 = 8;
/// Windows until another number of substeps is tried again.
const REST: u32 = 32;
/// The most substeps, and those to begin with.
const MOST: u32 = 8;
const FIRST: u32 = 3;
/// What it costs to refine a block once, in substeps.
const REFINEMENT: u32 = 12;

/// Finds the number of substeps of a guess for which guesses and refinements together cost least: now and then
/// others are tried than was best, and kept where they are better.
#[derive(Debug)]
pub struct Effort {
    /// The number at present.
    substeps: u32,
    /// The best one so far, and what a window costs with it, where that is known.
    best: u32,
    cost: Option<u32>,
    /// What is tried next, and the windows until then.
    next: Trial,
    rest: u32,
    /// Of the present window.
    blocks: u32,
    refinements: u32,
}

/// Another number of substeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trial {
    /// One more.
    More,
    /// The most: one more alone may not show that many help.
    Most,
    /// One fewer.
    Fewer,
}

impl Effort {
    pub fn new() -> Self {
        Self {
            substeps: FIRST,
            best: FIRST,
            cost: None,
            next: Trial::Fewer,
            rest: 0,
            blocks: 0,
            refinements: 0,
        }
    }

    /// The number of substeps for the next block.
    #[inline(always)]
    pub fn substeps(&self) -> u32 {
        self.substeps
    }

    /// Takes note of a block that had to be refined so often.
    #[inline(always)]
    pub fn note(&mut self, refinements: u32) {
        self.blocks += 1;
        self.refinements += refinements;
        let cost = self.blocks * self.substeps + REFINEMENT * self.refinements;
        let failed = self.substeps != self.best && self.cost.is_some_and(|known| cost >= known);
        if failed || self.blocks == WINDOW {
            self.decide(cost, failed);
        }
    }

    /// What to do after a window, or a part of one that tells enough.
    #[inline(never)]
    fn decide(&mut self, cost: u32, failed: bool) {
        let refined = self.refinements > 0;
        (self.blocks, self.refinements) = (0, 0);
        if failed {
            self.substeps = self.best;
            (self.next, self.rest) = match self.next {
                Trial::More => (Trial::Most, 0),
                Trial::Most => (Trial::Fewer, 0),
                Trial::Fewer => (Trial::More, REST),
            };
            return;
        }
        let before = self.cost.replace(cost);
        if self.substeps != self.best {
            // Better: on in this direction, and from the most only down.
            (self.best, self.rest) = (self.substeps, 0);
            if self.next == Trial::Most {
                self.next = Trial::Fewer;
            }
        } else if before.is_none_or(|before| cost > before + before / 4) {
            // Steps are not what they were.
            (self.next, self.rest) = (Trial::More, 0);
        }
        if self.rest > 0 {
            self.rest -= 1;
            return;
        }
        // What never has to be refined does not take more.
        if !refined || self.best == MOST {
            self.next = Trial::Fewer;
        }
        self.substeps = match self.next {
            Trial::More => self.best + 1,
            Trial::Most => MOST,
            Trial::Fewer => (self.best - 1).max(1),
        };
        if self.substeps == self.best {
            (self.next, self.rest) = (Trial::More, REST);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The substeps of each of so many blocks, where a block takes `refinements(substeps)`.
    fn blocks(
        effort: &mut Effort,
        count: usize,
        refinements: impl Fn(u32) -> u32,
    ) -> [u32; MOST as usize + 1] {
        let mut seen = [0; MOST as usize + 1];
        for _ in 0..count {
            let substeps = effort.substeps();
            seen[substeps as usize] += 1;
            effort.note(refinements(substeps));
        }
        seen
    }

    #[test]
    fn the_cheapest_number_is_found_and_kept() {
        for enough in 1..=MOST {
            let mut effort = Effort::new();
            let seen = blocks(&mut effort, 1000, |substeps| u32::from(substeps < enough));
            assert!(seen[enough as usize] > 900, "{enough}: {seen:?}");
        }
    }

    #[test]
    fn what_does_not_help_is_not_paid_for() {
        for always in [0, 1, 3] {
            let seen = blocks(&mut Effort::new(), 1000, |_| always);
            assert!(seen[1] > 900, "{always}: {seen:?}");
        }
    }

    #[test]
    fn it_follows_when_steps_change() {
        let mut effort = Effort::new();
        blocks(&mut effort, 300, |_| 0);
        let seen = blocks(&mut effort, 300, |substeps| u32::from(substeps < 4));
        assert!(seen[4] > 200, "{seen:?}");
        let seen = blocks(&mut effort, 2000, |substeps| u32::from(substeps < 2));
        assert!(seen[2] > 1200, "{seen:?}");
    }
}
