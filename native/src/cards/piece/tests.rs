//! Pieces on a machine that is none: short of memory, refusing, or out of its mind.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use coadjoint_program::{Graph, Kernel, KernelParts, Precision, Programs};

use crate::cards::card::Card;
use crate::cards::machine::{Array, Machine, Opened, Room};
use crate::cards::piece::{FEWEST, Refused, Row, Status, word};
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

/// Adds 1 to g for each step; refuses the step that μ gives, if it is not 0.
struct Fake {
    arrays: [Vec<u8>; 4],
    /// Rows that fit.
    room: usize,
    /// The most rows there ever were.
    most: Arc<AtomicUsize>,
    /// The status it writes, and its additions to counts.
    status: u32,
    beyond: u64,
}

impl Machine for Fake {
    fn reserve(&mut self, bytes: [usize; 4]) -> Result<(), Room> {
        let rows = bytes[3] / 4;
        if rows > self.room {
            return Err(Room::Short);
        }
        self.most.fetch_max(rows, Ordering::Relaxed);
        self.arrays = bytes.map(|length| vec![0; length]);
        Ok(())
    }

    fn write(&mut self, array: Array, bytes: &[u8]) -> Result<(), Room> {
        self.arrays[array as usize].copy_from_slice(bytes);
        Ok(())
    }

    fn read(&mut self, array: Array, bytes: &mut [u8]) -> Result<(), DeviceError> {
        bytes.copy_from_slice(&self.arrays[array as usize]);
        Ok(())
    }

    fn launch(&mut self, rows: u64, target: u64) -> Result<(), Room> {
        for row in 0..rows as usize {
            let mut done = u64::from_ne_bytes(word(&self.arrays[2], 8 * row));
            let mut g = f64::from_ne_bytes(word(&self.arrays[0], 8 * row));
            let at = f64::from_ne_bytes(word(&self.arrays[1], 8 * row));
            let mut why = 0_u32;
            while done < target && why == 0 {
                if at != 0.0 && g == at {
                    why = self.status;
                } else {
                    g += 1.0;
                    done += 1;
                }
            }
            done = done.saturating_add(self.beyond);
            self.arrays[0][8 * row..8 * row + 8].copy_from_slice(&g.to_ne_bytes());
            self.arrays[2][8 * row..8 * row + 8].copy_from_slice(&done.to_ne_bytes());
            self.arrays[3][4 * row..4 * row + 4].copy_from_slice(&why.to_ne_bytes());
        }
        Ok(())
    }
}

const DEVICE: Device = Device { api: Api::OpenCl, number: 0 };

fn card(room: usize, status: u32, beyond: u64, memory: u64) -> (Card, Arc<AtomicUsize>) {
    let most = Arc::new(AtomicUsize::new(0));
    let arrays = [const { Vec::new() }; 4];
    let machine = Box::new(Fake { arrays, room, most: most.clone(), status, beyond });
    let opened = Opened { machine, name: "none".into(), processor: true, memory: (memory, memory) };
    (Card::of(opened, DEVICE, &kernel()), most)
}

fn rows(count: usize) -> Vec<Row> {
    vec![Row { g: vec![0.0], mu: vec![0.0], ..Row::default() }; count]
}

#[test]
fn pieces_are_as_large_as_memory_is() {
    let (mut card, most) = card(3000, 1, 0, u64::MAX);
    let mut list = rows(10_000);
    let told = std::cell::Cell::new(0);
    let tell = |made: u64| {
        assert!(made >= told.get());
        told.set(made);
    };
    let advanced = card.advance(&mut list, 700, &mut |_, _| {}, &tell).unwrap();
    assert_eq!((advanced.pieces, most.load(Ordering::Relaxed)), (4, 2500));
    assert_eq!((advanced.refused, told.get()), (0, 700));
    assert!(list.iter().all(|row| row.g == [700.0] && row.made == 700));
    // By what the device says of itself: 28 bytes a row.
    let (mut card, most) = self::card(usize::MAX, 1, 0, 28 * 1500);
    card.advance(&mut rows(4000), 10, &mut |_, _| {}, &|_| {}).unwrap();
    assert_eq!(most.load(Ordering::Relaxed), 1500);
}

#[test]
fn a_device_without_room_for_a_thousand_rows_is_refused() {
    let (mut card, _) = card(FEWEST - 1, 1, 0, u64::MAX);
    let mut list = rows(100_000);
    let error = card.advance(&mut list, 700, &mut |_, _| {}, &|_| {}).unwrap_err();
    assert_eq!(error, DeviceError::Memory { device: DEVICE, name: "none".into(), rows: FEWEST });
    assert!(list.iter().all(|row| row.g == [0.0] && row.made == 0));
}

#[test]
fn what_is_refused_is_handed_out_and_goes_on() {
    let (mut card, _) = card(100, 3, 0, u64::MAX);
    let mut list = rows(5);
    list[1].mu = vec![300.0];
    list[3].mu = vec![5.0];
    list[4] = Row { g: vec![7.5], mu: vec![1.0], made: 0, ended: true };
    let mut seen = Vec::new();
    let mut redo = |refused: &mut [Refused<'_>], target: u64| {
        for Refused { place, row, why } in refused {
            assert_eq!(*place, if row.made == 5 { 3 } else { 1 });
            seen.push((row.made, *why, target));
            if row.made == 300 {
                row.ended = true;
            } else {
                row.g = vec![1000.0];
                row.made = target;
            }
        }
    };
    let advanced = card.advance(&mut list, 2000, &mut redo, &|_| {}).unwrap();
    assert_eq!(seen, [(5, Status::Outside, 256), (300, Status::Outside, 768)]);
    assert_eq!(advanced.refused, 2);
    let found: Vec<_> = list.iter().map(|row| (row.g[0], row.made, row.ended)).collect();
    let expected = [
        (2000.0, 2000, false),
        (300.0, 300, true),
        (2000.0, 2000, false),
        (1000.0 + 1744.0, 2000, false),
        (7.5, 0, true),
    ];
    assert_eq!(found, expected);
}

#[test]
fn counts_and_states_that_cannot_be_are_errors() {
    let wrong = |status: u32, beyond: u64| {
        let (mut card, _) = card(usize::MAX, status, beyond, u64::MAX);
        let mut list = rows(3);
        list[1].mu = vec![5.0];
        card.advance(&mut list, 10, &mut |_, _| {}, &|_| {}).unwrap_err()
    };
    assert_eq!(wrong(9, 0), DeviceError::Wrong { device: DEVICE, name: "none".into(), row: 1 });
    assert_eq!(wrong(1, 3), DeviceError::Wrong { device: DEVICE, name: "none".into(), row: 0 });
    let (mut card, _) = card(usize::MAX, 1, 0, u64::MAX);
    let mut list = rows(3);
    list[2].g.clear();
    let error = card.advance(&mut list, 10, &mut |_, _| {}, &|_| {}).unwrap_err();
    assert_eq!(error, DeviceError::Shape { row: 2, element: 1, dim: 1 });
    assert_eq!(card.precision, Precision::Double);
}
