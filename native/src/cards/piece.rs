//! Rows that are in a device's memory together.

use std::time::{Duration, Instant};

use coadjoint_program::{BLOCK, Precision};

use crate::cards::DeviceError;
use crate::cards::card::Card;
use crate::cards::machine::{Array, Room};

/// The least number of rows that must fit: with fewer, a device does not pay.
pub(crate) const FEWEST: usize = 1024;

/// A launch longer than this is not doubled: cards that draw the screen are taken from kernels that run for seconds.
const LONG: Duration = Duration::from_millis(150);

/// A row that stays where it is.
const NEVER: u64 = u64::MAX;

/// The numbers of rows, number i of row r at `i * rows + r`, as bytes in a precision.
struct Numbers {
    bytes: Vec<u8>,
    rows: usize,
    precision: Precision,
}

impl Numbers {
    fn new(count: usize, rows: usize, precision: Precision) -> Self {
        // A group of no numbers still has an array.
        Self { bytes: vec![0; (count * rows).max(1) * precision.bytes()], rows, precision }
    }

    fn put(&mut self, row: usize, values: &[f64]) {
        for (i, &value) in values.iter().enumerate() {
            let place = (i * self.rows + row) * self.precision.bytes();
            match self.precision {
                Precision::Double => {
                    self.bytes[place..place + 8].copy_from_slice(&value.to_ne_bytes());
                }
                Precision::Single => {
                    self.bytes[place..place + 4].copy_from_slice(&(value as f32).to_ne_bytes());
                }
            }
        }
    }

    fn get(&self, row: usize, values: &mut [f64]) {
        for (i, value) in values.iter_mut().enumerate() {
            let place = (i * self.rows + row) * self.precision.bytes();
            *value = match self.precision {
                Precision::Double => f64::from_ne_bytes(word(&self.bytes, place)),
                Precision::Single => f64::from(f32::from_ne_bytes(word(&self.bytes, place))),
            };
        }
    }
}

fn word<const N: usize>(bytes: &[u8], place: usize) -> [u8; N] {
    std::array::from_fn(|i| bytes[place + i])
}

/// Moves these rows, all at once, to step `steps`; `first` is the place of the first of them.
fn advance(
    card: &mut Card,
    (first, rows): (usize, &mut [Row]),
    steps: u64,
    redo: &mut Redo<'_>,
    told: &dyn Fn(u64),
    advanced: &mut Advanced,
) -> Result<(), Room> {
    let count = rows.len();
    let mut element = Numbers::new(card.element, count, card.precision);
    let mut momentum = Numbers::new(card.dim, count, card.precision);
    let mut done = vec![0; count * 8];
    let mut status = vec![0; count * 4];
    for (place, row) in rows.iter().enumerate() {
        element.put(place, &row.g);
        momentum.put(place, &row.mu);
        done[8 * place..8 * place + 8].copy_from_slice(&counted(row).to_ne_bytes());
    }
    let bytes = [&element.bytes, &momentum.bytes, &done, &status].map(Vec::len);
    card.machine.reserve(bytes)?;
    for (array, bytes) in
        Array::ALL.into_iter().zip([&element.bytes, &momentum.bytes, &done, &status])
    {
        card.machine.write(array, bytes)?;
    }
    let going = rows.iter().filter(|row| !row.ended);
    let mut at = going.map(|row| row.made).min().unwrap_or(steps);
    let mut length = BLOCK;
    // A launch that failed before a step was made may be tried again with fewer rows; the caller's rows are unchanged.
    let mut begun = false;
    while at < steps {
        let target = steps.min(at.saturating_add(length));
        let start = Instant::now();
        match card.machine.launch(count as u64, target) {
            Err(Room::Short) if begun => {
                let (device, name) = (card.device, card.name.clone());
                return Err(DeviceError::Memory { device, name, rows: count }.into());
            }
            other => other?,
        }
        begun = true;
        let took = start.elapsed();
        advanced.launches += 1;
        advanced.running += took;
        if took < LONG {
            length = length.saturating_mul(2);
        }
        card.machine.read(Array::Done, &mut done)?;
        card.machine.read(Array::Status, &mut status)?;
        let mut refused: Vec<(usize, u64, Status)> = Vec::new();
        for (place, row) in rows.iter().enumerate() {
            let made = u64::from_ne_bytes(word(&done, 8 * place));
            let why = u32::from_ne_bytes(word(&status, 4 * place));
            let (device, name) = (card.device, &card.name);
            let wrong = || DeviceError::Wrong { device, name: name.clone(), row: first + place };
            match row.ended {
                true if made == NEVER => {}
                false if made == target => {}
                false if row.made <= made && made < target => {
                    refused.push((place, made, Status::of(why).ok_or_else(wrong)?));
                }
                _ => return Err(wrong().into()),
            }
        }
        if !refused.is_empty() {
            card.machine.read(Array::Element, &mut element.bytes)?;
            card.machine.read(Array::Momentum, &mut momentum.bytes)?;
            advanced.refused += refused.len() as u64;
            let mut list = Vec::with_capacity(refused.len());
            let mut next = refused.iter().peekable();
            for (place, row) in rows.iter_mut().enumerate() {
                if let Some(&&(_, made, why)) = next.peek().filter(|one| one.0 == place) {
                    next.next();
                    element.get(place, &mut row.g);
                    momentum.get(place, &mut row.mu);
                    row.made = made;
                    list.push(Refused { place: first + place, row, why });
                }
            }
            redo(&mut list, target);
            for &(place, ..) in &refused {
                let row = &rows[place];
                element.put(place, &row.g);
                momentum.put(place, &row.mu);
                done[8 * place..8 * place + 8].copy_from_slice(&counted(row).to_ne_bytes());
            }
            let zeros = vec![0; status.len()];
            for (array, bytes) in
                Array::ALL.into_iter().zip([&element.bytes, &momentum.bytes, &done, &zeros])
            {
                card.machine.write(array, bytes)?;
            }
        }
        at = target;
        told(at);
    }
    card.machine.read(Array::Element, &mut element.bytes)?;
    card.machine.read(Array::Momentum, &mut momentum.bytes)?;
    for (place, row) in rows.iter_mut().enumerate().filter(|(_, row)| !row.ended) {
        element.get(place, &mut row.g);
        momentum.get(place, &mut row.mu);
        row.made = steps;
    }
    Ok(())
}

impl Card {
    /// Moves all rows to step `steps`, but those that have ended, in pieces that fit into the device's memory. Rows
    /// stand at the same step in the beginning.
    ///
    /// From time to time threads refuse a step. `redo` is then given these rows, why, and the step that all others have
    /// reached. It has to move them there by other means, or to end them.
    /// `told` receives the average number of steps made.
    ///
    /// # Errors
    /// [`DeviceError`] where there is no room for a thousand rows, or the device fails. The rows are then invalid.
    pub fn advance(
        &mut self,
        rows: &mut [Row],
        steps: u64,
        redo: &mut Redo<'_>,
        told: &dyn Fn(u64),
    ) -> Result<Advanced, DeviceError> {
        let shape = |row: &Row| row.g.len() == self.element && row.mu.len() == self.dim;
        if let Some(row) = rows.iter().position(|row| !shape(row)) {
            let (element, dim) = (self.element, self.dim);
            return Err(DeviceError::Shape { row, element, dim });
        }
        let mut advanced = Advanced::default();
        let total = rows.len().max(1) as u128;
        let mut first = 0;
        while first < rows.len() {
            let count = self.fits.min(rows.len() - first);
            let before = first as u128 * u128::from(steps);
            let told = |made: u64| {
                let all = before + count as u128 * u128::from(made);
                told(u64::try_from(all / total).unwrap_or(steps));
            };
            let own = &mut rows[first..first + count];
            match advance(self, (first, own), steps, redo, &told, &mut advanced) {
                Ok(()) => {
                    advanced.pieces += 1;
                    first += count;
                }
                Err(Room::Short) if count > FEWEST => {
                    self.fits = (count / 2).max(FEWEST);
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

/// The count of a row on the device.
fn counted(row: &Row) -> u64 {
    if row.ended { NEVER } else { row.made }
}

/// The state of a trajectory, and how far it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// The group element, m numbers.
    pub g: Vec<f64>,
    /// μ, n numbers.
    pub mu: Vec<f64>,
    /// Steps made.
    pub made: u64,
    /// True if the row moves no further.
    pub ended: bool,
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
#[derive(Debug)]
pub struct Refused<'a> {
    /// Its place among all rows.
    pub place: usize,
    /// Its state before that step.
    pub row: &'a mut Row,
    /// The reason.
    pub why: Status,
}

/// Makes the steps that threads have refused: it is given the rows, and the step that it has to move them to, or end
/// them.
type Redo<'a> = dyn FnMut(&mut [Refused<'_>], u64) + 'a;

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
