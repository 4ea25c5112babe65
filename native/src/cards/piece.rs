//! Rows that are in a device's memory together.

use std::ops::Range;
use std::time::{Duration, Instant};

use bytemuck::{cast_slice, cast_slice_mut};
use coadjoint_program::states::States;
use coadjoint_program::{BLOCK, Precision, WIDTH};
use rayon::prelude::*;

use crate::cards::DeviceError;
use crate::cards::card::Card;
use crate::cards::machine::{Array, Room};

/// The least number of rows that must fit: with fewer, a device does not pay.
pub(crate) const FEWEST: usize = 1024;

/// A launch longer than this is not doubled: cards that draw the screen are taken from kernels that run for seconds.
const LONG: Duration = Duration::from_millis(150);

/// The count of a row that moves no further.
pub const ENDED: u64 = u64::MAX;

/// Bytes that are copied in the time that another call takes.
const APART: usize = 1 << 17;

/// Numbers that a thread converts at a time.
const SHARE: usize = 1 << 14;

impl Card {
    /// Writes numbers of states to the device, the first of which has number `first` there.
    fn put(&mut self, first: usize, numbers: &[f64]) -> Result<(), Room> {
        let Self { machine, precision, short, .. } = self;
        let first = first * precision.bytes();
        match precision {
            Precision::Double => machine.write(Array::States, first, cast_slice(numbers)),
            Precision::Single => {
                let rounded = numbers.par_iter().with_min_len(SHARE).map(|number| *number as f32);
                rounded.collect_into_vec(short);
                machine.write(Array::States, first, cast_slice(short))
            }
        }
    }

    /// Reads numbers of states from the device, the first of which has number `first` there.
    fn take(&mut self, first: usize, numbers: &mut [f64]) -> Result<(), Room> {
        let Self { machine, precision, short, .. } = self;
        let first = first * precision.bytes();
        match precision {
            Precision::Double => machine.read(Array::States, first, cast_slice_mut(numbers)),
            Precision::Single => {
                short.resize(numbers.len(), 0.0);
                machine.read(Array::States, first, cast_slice_mut(short))?;
                let both = numbers.par_iter_mut().with_min_len(SHARE).zip(short);
                both.for_each(|(number, short)| *number = f64::from(*short));
                Ok(())
            }
        }
    }

    /// Moves these rows, all at once, to step `steps`. The first one begins a block.
    fn advance_piece(
        &mut self,
        (states, made): (&mut States, &mut [u64]),
        rows: &Range<usize>,
        steps: u64,
        redo: &mut Redo<'_>,
        told: &dyn Fn(u64),
        advanced: &mut Advanced,
    ) -> Result<(), Room> {
        let length = states.length();
        // The numbers of the blocks of some of these rows, among all and on the device.
        let numbers = |own: &Range<usize>| {
            let first = rows.start / WIDTH * length;
            let all = own.start / WIDTH * length..own.end.div_ceil(WIDTH) * length;
            (all.start - first, all)
        };
        let (count, (_, all)) = (rows.len(), numbers(rows));
        self.machine.reserve([all.len() * self.precision.bytes(), count * 8, count * 4])?;
        self.put(0, &states.blocks()[all.clone()])?;
        self.machine.write(Array::Done, 0, cast_slice(&made[rows.clone()]))?;
        let wrong = |card: &Self, row: usize| {
            let (device, name) = (card.device, card.name.clone());
            Room::Failed(DeviceError::Wrong { device, name, row })
        };
        let going = made[rows.clone()].iter().filter(|made| **made != ENDED);
        let mut at = going.min().map_or(steps, |made| *made);
        let (mut length_of_launch, mut status) = (BLOCK, vec![0_u32; count]);
        while at < steps {
            let target = steps.min(at.saturating_add(length_of_launch));
            let start = Instant::now();
            self.machine.launch(count as u64, target)?;
            let took = start.elapsed();
            advanced.launches += 1;
            advanced.running += took;
            if took < LONG {
                length_of_launch = length_of_launch.saturating_mul(2);
            }
            self.machine.read(Array::Status, 0, cast_slice_mut(&mut status))?;
            let stopped = (rows.start..).zip(&status).filter(|(_, why)| **why != 0);
            let why = |(place, &why): (usize, &u32)| {
                let why = Status::of(why).ok_or_else(|| wrong(self, place))?;
                Ok(Refused { place, why })
            };
            let refused: Vec<Refused> = stopped.map(why).collect::<Result<_, Room>>()?;
            // Blocks that lie apart by less are copied with those between them.
            let apart = APART / (length * self.precision.bytes());
            let stretches: Vec<Range<usize>> = refused
                .chunk_by(|one, next| next.place / WIDTH - one.place / WIDTH <= apart)
                .filter_map(|near| Some((near.first()?.place, near.last()?.place)))
                .map(|(first, last)| {
                    first / WIDTH * WIDTH..rows.end.min((last / WIDTH + 1) * WIDTH)
                })
                .collect();
            for own in &stretches {
                let (first, all) = numbers(own);
                self.take(first, &mut states.blocks_mut()[all])?;
                let counts = cast_slice_mut(&mut made[own.clone()]);
                self.machine.read(Array::Done, (own.start - rows.start) * 8, counts)?;
            }
            let late = |one: &&Refused| !(at..target).contains(&made[one.place]);
            if let Some(one) = refused.iter().find(late) {
                return Err(wrong(self, one.place));
            }
            if !refused.is_empty() {
                advanced.refused += refused.len() as u64;
                redo(states, made, &refused, target);
            }
            for own in &stretches {
                let (first, all) = numbers(own);
                self.put(first, &states.blocks()[all])?;
                let counts = cast_slice(&made[own.clone()]);
                self.machine.write(Array::Done, (own.start - rows.start) * 8, counts)?;
            }
            at = target;
            told(at);
        }
        self.take(0, &mut states.blocks_mut()[all])?;
        let made = &mut made[rows.clone()];
        self.machine.read(Array::Done, 0, cast_slice_mut(made))?;
        match made.iter().position(|made| *made != steps && *made != ENDED) {
            Some(place) => Err(wrong(self, rows.start + place)),
            None => Ok(()),
        }
    }

    /// Moves all rows to step `steps`, but those that have [`ENDED`], in pieces that fit into the device's memory. `made` has
    /// the steps that each has made; rows stand at the same step in the beginning.
    ///
    /// From time to time threads refuse a step. `redo` is then given the states and counts of all rows, the rows that it
    /// happened to, and the step that all others have reached. It has to move these rows there by other means, or to end
    /// them, and to count so; of other rows it is not told the state.
    /// `told` receives the average number of steps made.
    ///
    /// # Errors
    /// [`DeviceError`] where there is no room for a thousand rows, or the device fails. The rows are then invalid.
    pub fn advance(
        &mut self,
        states: &mut States,
        made: &mut [u64],
        steps: u64,
        redo: &mut Redo<'_>,
        told: &dyn Fn(u64),
    ) -> Result<Advanced, DeviceError> {
        let (element, dim) = (self.element, self.dim);
        let length = (element + dim) * WIDTH;
        let blocks = made.len().div_ceil(WIDTH);
        if states.length() != length || states.blocks().len() != blocks * length {
            return Err(DeviceError::Shape { element, dim });
        }
        let mut advanced = Advanced::default();
        let total = made.len().max(1) as u128;
        let mut first = 0;
        while first < made.len() {
            let count = self.fits.min(made.len() - first);
            let before = first as u128 * u128::from(steps);
            let told = |made: u64| {
                let all = before + count as u128 * u128::from(made);
                told(u64::try_from(all / total).unwrap_or(steps));
            };
            let (own, begun) = (first..first + count, advanced.launches);
            let all = (&mut *states, &mut *made);
            match self.advance_piece(all, &own, steps, redo, &told, &mut advanced) {
                Ok(()) => {
                    advanced.pieces += 1;
                    first += count;
                }
                // A launch that failed before a step was made may be tried again with fewer rows.
                Err(Room::Short) if count > FEWEST && advanced.launches == begun => {
                    self.fits = (count / 2 / WIDTH * WIDTH).max(FEWEST);
                }
                Err(Room::Short) => {
                    let (device, name) = (self.device, self.name.clone());
                    return Err(DeviceError::Memory { device, name, rows: count });
                }
                Err(Room::Failed(error)) => return Err(error),
            }
        }
        Ok(advanced)
    }
}

/// The reason for which a trajectory stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The equation of the next step was not solved.
    Unsolved,
    /// Its solution is far from the first guess.
    Far,
    /// The next step is outside the domain where it is accepted at once.
    Outside,
    /// The state at the end of a block was not finite, or not on the group: it is that before the block.
    Unsound,
}

impl Status {
    pub(crate) fn of(number: u32) -> Option<Self> {
        match number {
            1 => Some(Self::Unsolved),
            2 => Some(Self::Far),
            3 => Some(Self::Outside),
            4 => Some(Self::Unsound),
            _ => None,
        }
    }
}

/// A row of which a thread has refused a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused {
    /// Its place among all rows. Its state is that before the step, and so is its count.
    pub place: usize,
    /// The reason.
    pub why: Status,
}

/// Makes the steps that threads have refused: it is given all states and counts, the rows, and the step that it has to move
/// them to, or end them.
type Redo<'a> = dyn FnMut(&mut States, &mut [u64], &[Refused], u64) + 'a;

/// The outcome of `Card::advance`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Advanced {
    /// Refused steps that the caller was given to make.
    pub refused: u64,
    /// The number of pieces in which the rows were moved.
    pub pieces: u64,
    /// Launches of the kernel.
    pub launches: u64,
    /// The time the kernel ran.
    pub running: Duration,
}

#[cfg(test)]
mod tests;
