//! Pieces on a machine that is none: short of memory, refusing, or out of its mind.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use coadjoint_program::states::States;
use coadjoint_program::{Graph, Kernel, KernelParts, Precision, Programs, WIDTH};

use crate::cards::card::Card;
use crate::cards::machine::{Array, Machine, Opened, Room};
use crate::cards::piece::{ENDED, FEWEST, Refused, Status};
use crate::cards::{Api, Device, DeviceError};

/// A step of no meaning with one number in g and one in μ.
fn kernel() -> Kernel {
    let program = |inputs: usize, outputs: usize| {
        let graph = Graph::new();
        let ids: Vec<_> = (0..outputs).map(|_| graph.constant(1.0)).collect();
        graph.finish(inputs, &ids)
    };
    let programs = Programs {
        guess: program(1, 1),
        correct: program(2, 4),
        accept: program(4, 1),
        transport: program(3, 2),
        frame: None,
        sound: program(2, 1),
        watch: program(2, 1),
        matrix: program(1, 1),
    };
    let (dim, element, unknowns, solution) = (1, 1, 1, 1);
    let (tolerance, near, corrections) = (1e-15, 0.1, 3);
    Kernel::new(KernelParts {
        dim,
        element,
        unknowns,
        solution,
        tolerance,
        near,
        corrections,
        programs,
    })
    .unwrap()
}

/// The place of a row's g among the numbers of all states; its μ is [`WIDTH`] further on.
fn place(row: usize) -> usize {
    row / WIDTH * 2 * WIDTH + row % WIDTH
}

/// Adds 1 to g for each step; refuses the step that μ gives, if it is not 0.
struct Fake {
    arrays: [Vec<u8>; 3],
    /// Rows that fit.
    room: usize,
    /// The most rows there ever were.
    most: Arc<AtomicUsize>,
    /// The bytes of states that were copied.
    copied: Arc<AtomicUsize>,
    /// The status it writes, and its additions to counts.
    status: u32,
    beyond: u64,
}

impl Machine for Fake {
    fn reserve(&mut self, bytes: [usize; 3]) -> Result<(), Room> {
        let rows = bytes[2] / 4;
        if rows > self.room {
            return Err(Room::Short);
        }
        self.most.fetch_max(rows, Ordering::Relaxed);
        self.arrays = bytes.map(|length| vec![0; length]);
        Ok(())
    }

    fn write(&mut self, array: Array, first: usize, bytes: &[u8]) -> Result<(), Room> {
        self.arrays[array as usize][first..first + bytes.len()].copy_from_slice(bytes);
        if array == Array::States {
            self.copied.fetch_add(bytes.len(), Ordering::Relaxed);
        }
        Ok(())
    }

    fn read(&mut self, array: Array, first: usize, bytes: &mut [u8]) -> Result<(), Room> {
        bytes.copy_from_slice(&self.arrays[array as usize][first..first + bytes.len()]);
        Ok(())
    }

    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room> {
        let [states, counts, status] = &mut self.arrays;
        let states: &mut [f64] = bytemuck::cast_slice_mut(states);
        let (counts, status): (&mut [u64], &mut [u32]) =
            (bytemuck::cast_slice_mut(counts), bytemuck::cast_slice_mut(status));
        for row in 0..rows as usize {
            let (g, done) = (place(row), &mut counts[row]);
            let at = states[g + WIDTH];
            status[row] = 0;
            while *done < target && status[row] == 0 {
                if at != 0.0 && states[g] == at {
                    status[row] = self.status;
                } else {
                    states[g] += 1.0;
                    *done += 1;
                }
            }
            *done = done.saturating_add(self.beyond);
        }
        Ok(())
    }
}

const DEVICE: Device = Device { api: Api::OpenCl, number: 0 };

fn card(room: usize, status: u32, beyond: u64, memory: u64) -> (Card, [Arc<AtomicUsize>; 2]) {
    let seen: [Arc<AtomicUsize>; 2] = Default::default();
    let [most, copied] = seen.clone();
    let arrays = [const { Vec::new() }; 3];
    let machine = Box::new(Fake { arrays, room, most, copied, status, beyond });
    let opened = Opened { machine, name: "none".into(), processor: true, memory: (memory, memory) };
    (Card::of(opened, DEVICE, &kernel()), seen)
}

/// States whose numbers are 0, and the counts of their steps.
fn rows(count: usize) -> (States, Vec<u64>) {
    (States::new(1, 1, count), vec![0; count])
}

/// Tells of no progress, and makes no steps.
fn idle(_: &mut States, _: &mut [u64], _: &[Refused], _: u64) {}

#[test]
fn pieces_are_as_large_as_memory_is() {
    let (mut card, [most, _]) = card(3000, 1, 0, u64::MAX);
    let (mut states, mut made) = rows(10_000);
    let told = std::cell::Cell::new(0);
    let tell = |made: u64| {
        assert!(made >= told.get());
        told.set(made);
    };
    let advanced = card.advance(&mut states, &mut made, 700, &mut idle, &tell).unwrap();
    assert_eq!((advanced.pieces, most.load(Ordering::Relaxed)), (5, 2496));
    assert_eq!((advanced.refused, told.get()), (0, 700));
    assert!((0..10_000).all(|row| states.blocks()[place(row)] == 700.0 && made[row] == 700));
    // By what the device says of itself: 28 bytes a row.
    let (mut card, [most, _]) = self::card(usize::MAX, 1, 0, 28 * 1500);
    let (mut states, mut made) = rows(4000);
    card.advance(&mut states, &mut made, 10, &mut idle, &|_| {}).unwrap();
    assert_eq!(most.load(Ordering::Relaxed), 1496);
}

#[test]
fn a_device_without_room_for_a_thousand_rows_is_refused() {
    let (mut card, _) = card(FEWEST - 1, 1, 0, u64::MAX);
    let (mut states, mut made) = rows(100_000);
    let error = card.advance(&mut states, &mut made, 700, &mut idle, &|_| {}).unwrap_err();
    assert_eq!(error, DeviceError::Memory { device: DEVICE, name: "none".into(), rows: FEWEST });
    assert_eq!((states, made), rows(100_000));
}

#[test]
fn what_is_refused_is_handed_out_and_goes_on() {
    let (mut card, [_, copied]) = card(usize::MAX, 3, 0, u64::MAX);
    let count = 2000;
    let (mut states, mut made) = rows(count);
    let numbers = states.blocks_mut();
    (numbers[place(1) + WIDTH], numbers[place(count - 2) + WIDTH]) = (300.0, 5.0);
    (numbers[place(4)], numbers[place(4) + WIDTH]) = (7.5, 1.0);
    made[4] = ENDED;
    let mut seen = Vec::new();
    let mut redo = |states: &mut States, made: &mut [u64], refused: &[Refused], target: u64| {
        for &Refused { place: row, why } in refused {
            assert_eq!(row, if made[row] == 5 { count - 2 } else { 1 });
            assert_eq!(states.blocks()[place(row)], made[row] as f64);
            seen.push((made[row], why, target));
            if made[row] == 300 {
                made[row] = ENDED;
            } else {
                states.blocks_mut()[place(row)] = 1000.0;
                made[row] = target;
            }
        }
    };
    let advanced = card.advance(&mut states, &mut made, 2000, &mut redo, &|_| {}).unwrap();
    assert_eq!(seen, [(5, Status::Outside, 256), (300, Status::Outside, 768)]);
    assert_eq!(advanced.refused, 2);
    let found = [0, 1, 2, count - 2, 4].map(|row| (states.blocks()[place(row)], made[row]));
    let moved = 1000.0 + 1744.0;
    let expected = [(2000.0, 2000), (300.0, ENDED), (2000.0, 2000), (moved, 2000), (7.5, ENDED)];
    assert_eq!(found, expected);
    // Blocks of what was refused are written alone, once each.
    assert_eq!(copied.load(Ordering::Relaxed), 8 * (2 * count + 2 * 2 * WIDTH));
}

#[test]
fn counts_and_states_that_cannot_be_are_errors() {
    let wrong = |status: u32, beyond: u64| {
        let (mut card, _) = card(usize::MAX, status, beyond, u64::MAX);
        let (mut states, mut made) = rows(3);
        states.blocks_mut()[place(1) + WIDTH] = 5.0;
        card.advance(&mut states, &mut made, 10, &mut idle, &|_| {}).unwrap_err()
    };
    assert_eq!(wrong(9, 0), DeviceError::Wrong { device: DEVICE, name: "none".into(), row: 1 });
    assert_eq!(wrong(1, 3), DeviceError::Wrong { device: DEVICE, name: "none".into(), row: 0 });
    let (mut card, _) = card(usize::MAX, 1, 0, u64::MAX);
    let (mut states, _) = rows(8);
    let error = card.advance(&mut states, &mut [0; 9], 10, &mut idle, &|_| {}).unwrap_err();
    assert_eq!(error, DeviceError::Shape { element: 1, dim: 1 });
    assert_eq!(card.precision, Precision::Double);
}

#[test]
fn rows_of_single_precision_are_rounded_on_their_way() {
    let kernel = kernel().in_precision(Precision::Single);
    let (most, copied) = Default::default();
    let arrays = [const { Vec::new() }; 3];
    let machine = Fake { arrays, room: usize::MAX, most, copied, status: 1, beyond: 0 };
    let (machine, name) = (Box::new(machine), "none".into());
    let opened = Opened { machine, name, processor: true, memory: (u64::MAX, u64::MAX) };
    let mut card = Card::of(opened, DEVICE, &kernel);
    let (mut states, mut made) = rows(20);
    states.blocks_mut().fill(0.1);
    let advanced = card.advance(&mut states, &mut made, 0, &mut idle, &|_| {}).unwrap();
    assert_eq!((advanced.launches, advanced.pieces), (0, 1));
    assert!(states.blocks().iter().all(|number| *number == f64::from(0.1_f32)));
}
