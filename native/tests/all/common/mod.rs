//! Kernels to try compilers on: programs over all kinds of nodes, drawn at random.
#![allow(dead_code, clippy::unwrap_used, clippy::panic)]

use coadjoint_program::{Graph, Id, Kernel, KernelParts, Program, Programs, WIDTH};

/// Numbers that look random, the same in every run.
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d_4c95_7f2d)
    }

    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() >> 11) as usize % n
    }

    /// In [−1, 1).
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// How many folded coefficients the kernels read at most.
pub const SLOTS: usize = 5;

/// A program with these numbers of inputs, outputs and operations; its outputs are in (−1, 1), those listed in `sizes` in [0, 1).
fn program(
    draw: &mut Draw,
    inputs: usize,
    outputs: usize,
    length: usize,
    sizes: &[usize],
) -> Program {
    let mut graph = Graph::new();
    let mut known: Vec<Id> = (0..inputs).map(|i| graph.input(i)).collect();
    known.extend((0..SLOTS).map(|i| graph.slot(i)));
    known.extend([0.1, -0.75, 3.0, 1e-12].map(|value| graph.constant(value)));
    for _ in 0..length {
        let [a, b, c, d] = std::array::from_fn(|_| {
            let last = known.len();
            let from = if draw.below(3) == 0 { 0 } else { last.saturating_sub(12) };
            known[from + draw.below(last - from)]
        });
        // A factor that is no larger than 1, or long programs have no numbers left in the end.
        let small = known[draw.below(inputs.max(1))];
        known.push(match draw.below(17) {
            0..3 => graph.add(a, b),
            3..5 => graph.sub(a, b),
            5..8 => graph.mul(small, b),
            8..11 => graph.times_plus(small, b, c),
            11 => {
                let size = graph.abs(b);
                let one = graph.constant(1.5);
                let bottom = graph.add(size, one);
                graph.div(a, bottom)
            }
            12 => graph.neg(a),
            13 => graph.abs(a),
            14 => {
                let size = graph.abs(a);
                graph.sqrt(size)
            }
            15 => graph.round(a),
            _ => graph.select(a, b, c, d),
        });
    }
    let one = graph.constant(1.0);
    let outputs: Vec<Id> = (0..outputs)
        .map(|output| {
            let value = known[known.len() - 1 - output % length.max(1)];
            let size = graph.abs(value);
            let bottom = graph.add(size, one);
            let top = if sizes.contains(&output) { size } else { value };
            graph.div(top, bottom)
        })
        .collect();
    graph.finish(inputs, &outputs)
}

/// 1 where the last output of `of` is at most `bound`, else 0.
fn at_most(of: &Program, bound: f64) -> Program {
    let mut graph = Graph::new();
    let inputs: Vec<Id> = (0..of.inputs()).map(|i| graph.input(i)).collect();
    let [value] = graph.call(of, &inputs)[..] else {
        panic!("one output");
    };
    let (bound, one, zero) = (graph.constant(bound), graph.constant(1.0), graph.zero());
    let right = graph.select(value, bound, one, zero);
    graph.finish(of.inputs(), &[right])
}

/// A kernel with n coordinates, m numbers in an element and k constants, whose programs have about this number of operations
/// each. About one step in `1 / refusal` is refused, one block in ten is unsound.
pub fn kernel(
    seed: u64,
    [n, m, k]: [usize; 3],
    length: usize,
    frame: bool,
    refusal: f64,
) -> Kernel {
    let mut draw = Draw::new(seed);
    let draw = &mut draw;
    let accept = program(draw, n + n + 2, 1, length, &[]);
    let sound = program(draw, m + n, 1, length, &[]);
    let programs = Programs {
        guess: program(draw, n, n + k, length, &[]),
        correct: program(draw, n + n + k, n + n + 2, length, &[2 * n, 2 * n + 1]),
        accept: at_most(&accept, 1.0 - refusal),
        transport: program(draw, m + n + n, m + n, length, &[]),
        frame: frame.then(|| program(draw, m + n + 1, m + n, length, &[])),
        sound: at_most(&sound, 0.9),
        watch: program(draw, m + n, 2, 3, &[]),
        matrix: program(draw, m, m, 3, &[]),
    };
    let (dim, element, tolerance, near, corrections) = (n, m, 0.4, 1.2, 5);
    Kernel::new(KernelParts { dim, element, tolerance, near, corrections, programs }).unwrap()
}

/// The same kernel with kicks between flows.
pub fn kicked(kernel: Kernel, seed: u64, flows: u32) -> Kernel {
    let (n, m) = (kernel.dim(), kernel.element());
    let kick = program(&mut Draw::new(seed ^ 0x1234), m + n, n, 20, &[]);
    kernel.with_kicks(kick, flows).unwrap()
}

/// Slots, and g and μ of lanes side by side.
pub fn state(kernel: &Kernel, seed: u64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let mut draw = Draw::new(seed ^ 0xabcd);
    let mut list = |length: usize| (0..length).map(|_| draw.number()).collect::<Vec<f64>>();
    (list(kernel.slots()), list(kernel.element() * WIDTH), list(kernel.dim() * WIDTH))
}

/// Lane `r` of numbers side by side.
pub fn lane(list: &[f64], r: usize) -> Vec<f64> {
    list.iter().skip(r).step_by(WIDTH).copied().collect()
}

/// The bits of numbers; those that are none are all the same.
pub fn bits(list: &[f64]) -> Vec<u64> {
    list.iter().map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }).collect()
}
