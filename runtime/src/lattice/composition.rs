//! Symmetric compositions of flows, each of which is exact.

use alloc::vec::Vec;

use coadjoint_program::splitting::Splitting;

/// The order of accuracy of a composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Strang's: each part forwards and back.
    Two,
    /// S₆ of Blanes and Moan ([`Splitting::Prk4`]): six times as many parts.
    Four,
    /// S₁₀ of Blanes and Moan ([`Splitting::Prk6`]): ten times as many parts.
    Six,
    /// W. Kahan, R.-C. Li, *Composition constants for raising the orders of unconventional schemes for ordinary
    /// differential equations*, Math. Comp. 66 (1997) 1089–1099: 17 times as many parts.
    Eight,
}

/// The first half of the lengths of steps of order 2.
const KAHAN_LI: [f64; 8] = [
    0.130_202_483_088_890_08,
    0.561_162_981_775_108_4,
    -0.389_474_962_644_847_3,
    0.158_841_906_555_155_6,
    -0.395_903_894_133_237_57,
    0.184_539_640_978_315_7,
    0.258_374_387_686_322_04,
    0.295_011_723_609_310_3,
];

impl Order {
    /// The order as a number.
    #[must_use]
    pub fn number(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Six => 6,
            Self::Eight => 8,
        }
    }

    /// The lengths of passes through all parts, forwards and back by turns.
    fn passes(self) -> Vec<f64> {
        let splitting = match self {
            Self::Two => Splitting::Strang,
            Self::Four => Splitting::Prk4,
            Self::Six => Splitting::Prk6,
            Self::Eight => {
                let middle = 1.0 - 2.0 * KAHAN_LI.iter().sum::<f64>();
                let steps = KAHAN_LI.iter().chain([&middle]).chain(KAHAN_LI.iter().rev());
                return steps.flat_map(|step| [0.5 * step; 2]).collect();
            }
        };
        // Two flows, each between two passes, share their lengths.
        let mut length = 0.0;
        let pairs = splitting.kicks().zip(splitting.flows());
        let mut next = |sum: f64| {
            length = sum - length;
            length
        };
        pairs.flat_map(|(kick, flow)| [next(kick), next(flow)]).collect()
    }

    /// The parts of a step in their order, with their lengths in steps; a part that follows itself is made once.
    pub fn sequence(self, parts: usize) -> Vec<(usize, f64)> {
        let mut sequence: Vec<(usize, f64)> = Vec::new();
        for (pass, length) in self.passes().into_iter().enumerate() {
            for at in 0..parts {
                let part = if pass.is_multiple_of(2) { at } else { parts - 1 - at };
                match sequence.last_mut() {
                    Some(last) if last.0 == part => last.1 += length,
                    _ => sequence.push((part, length)),
                }
            }
        }
        sequence
    }
}
