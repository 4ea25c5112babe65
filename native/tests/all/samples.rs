//! Kernels of random programs over all kinds of nodes: no step of anything, but every branch of the loop; and the
//! comparison of machine code with the interpreter, bit for bit.
#![allow(clippy::unwrap_used)]

use coadjoint_native::Entry;
use coadjoint_program::{Graph, Id, Kernel, KernelParts, Program, Programs, Stepper, WIDTH};

/// Numbers by chance, the same ones in every run: SplitMix64.
#[derive(Clone, Debug)]
pub struct Chance(pub u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Below `bound`, which is not 0.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// Between −1 and 1.
    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Numbers of a state: now and then one that is none, or hardly one.
    fn state(&mut self, count: usize) -> Vec<f64> {
        let special = [0.0, -0.0, f64::INFINITY, f64::NAN, 5e-324, 1e300];
        let number = |_| match self.below(40) {
            0 => special[self.below(special.len())],
            _ => 2.0 * self.number(),
        };
        (0..count).map(number).collect()
    }
}

/// The shape of a random kernel.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub dim: usize,
    pub element: usize,
    pub constants: usize,
    /// Numbers solved for and numbers of the solution read beyond those of a series; guesses then read g too.
    pub beyond: [usize; 2],
    pub slots: usize,
    /// Nodes of each program, roughly.
    pub nodes: usize,
    pub corrections: u32,
    pub comoving: bool,
    /// Flows between kicks; 0 without kicks.
    pub flows: u32,
}

/// A kernel with folded coefficients.
pub struct Sample {
    pub kernel: Kernel,
    pub slots: Vec<f64>,
}

impl Sample {
    pub fn new(shape: Shape, chance: &mut Chance) -> Self {
        let Shape { dim: n, element: m, constants: k, corrections, beyond, .. } = shape;
        let [u, v] = beyond.map(|beyond| n + beyond);
        let guessed_from = if beyond == [0, 0] { n } else { m + n };
        let programs = Programs {
            guess: random(shape, guessed_from, u + k, None, chance),
            correct: random(shape, u + n + k, u + v + 2, None, chance),
            accept: rarely_no(shape, n + v + 2, 4, Some(0), chance),
            transport: random(shape, m + n + v, m + n, Some(m), chance),
            frame: shape.comoving.then(|| random(shape, m + n + 1, m + n, None, chance)),
            sound: rarely_no(shape, m + n, 2, None, chance),
            watch: random(shape, m + n, 1, None, chance),
            matrix: random(shape, m, m, None, chance),
        };
        let (dim, element, unknowns, solution, tolerance, near) = (n, m, u, v, 0.5, 3.0);
        let mut kernel = Kernel::new(KernelParts {
            dim,
            element,
            unknowns,
            solution,
            tolerance,
            near,
            corrections,
            programs,
        })
        .unwrap();
        if shape.flows > 0 {
            let kick = random(shape, m + n, n, None, chance);
            kernel = kernel.with_kicks(kick, shape.flows).unwrap();
        }
        let slots = (0..kernel.slots()).map(|_| chance.number()).collect();
        Self { kernel, slots }
    }

    /// A short one with three coordinates and four numbers in an element.
    pub fn small(seed: u64) -> Self {
        let (dim, element, constants, slots, nodes, corrections) = (3, 4, 1, 5, 20, 5);
        let (beyond, comoving, flows) = ([0, 0], true, 0);
        Self::new(
            Shape { dim, element, constants, beyond, slots, nodes, corrections, comoving, flows },
            &mut Chance(seed),
        )
    }
}

/// A random graph on the inputs; its nodes, the last of them using most of it.
fn grow(
    graph: &Graph,
    shape: Shape,
    inputs: usize,
    chance: &mut Chance,
    with_rows: bool,
) -> Vec<Id> {
    let mut ids: Vec<Id> = (0..inputs).map(|i| graph.input(i)).collect();
    ids.extend((0..shape.slots).map(|i| graph.slot(i)));
    ids.extend([graph.zero(), graph.epsilon()]);
    ids.extend([1.0, -1.0, 0.3, 1e-200, f64::MAX].map(|value| graph.constant(value)));
    for _ in 0..shape.nodes {
        if with_rows && chance.below(12) == 0 {
            ids.extend(side_by_side(graph, &ids, shape, chance));
        }
        // Of late nodes more often, so that little is left unused.
        let recent = ids.len().min(20);
        let [a, b, c, d] = std::array::from_fn(|_| match chance.below(3) {
            0 => ids[chance.below(ids.len())],
            _ => ids[ids.len() - 1 - chance.below(recent)],
        });
        ids.push(match chance.below(16) {
            0 | 1 => graph.add(a, b),
            2 | 3 => graph.sub(a, b),
            4 => graph.mul(a, b),
            5 | 6 => graph.times_plus(a, b, c),
            7 => graph.div(a, b),
            8 => graph.neg(a),
            9 => graph.abs(a),
            10 => graph.sqrt(a),
            11 => graph.round(a),
            12 => graph.scale(a, graph.round(b)),
            13 => graph.exponent(a),
            _ => graph.select(a, b, c, d),
        });
    }
    ids
}

/// The results of a random program on rows of late nodes: some are at equal distances, some the same in all rows.
fn side_by_side(graph: &Graph, ids: &[Id], shape: Shape, chance: &mut Chance) -> Vec<Id> {
    let (inputs, count) = (1 + chance.below(5), 2 + chance.below(4));
    let own = Graph::new();
    let shape = Shape { nodes: 3 + chance.below(12), slots: 0, ..shape };
    let made = grow(&own, shape, inputs, chance, false);
    // All inputs count.
    let all = (0..inputs).map(|i| own.input(i)).reduce(|sum, one| own.add(sum, one));
    let outputs: Vec<Id> = all.into_iter().chain(made.into_iter().rev().take(2)).collect();
    let program = own.finish(inputs, &outputs);
    let late = &ids[ids.len() / 2..];
    let mut rows = vec![Vec::new(); count];
    for _ in 0..inputs {
        let (kind, first) = (chance.below(3), chance.below(late.len()));
        for (row, inputs) in rows.iter_mut().enumerate() {
            inputs.push(match kind {
                0 => late[first],
                1 => late[(first + row * (1 + first % 2)) % late.len()],
                _ => late[chance.below(late.len())],
            });
        }
    }
    graph.call_each(&program, &rows).concat()
}

/// Between −2 and 2, and a number whatever a is.
fn within(graph: &Graph, a: Id) -> Id {
    let (low, high) = (graph.constant(-2.0), graph.constant(2.0));
    let below = graph.min(a, high);
    graph.select(low, below, below, low)
}

/// Random results; the one of number `restless` goes through the logistic map, so that steps are not all alike.
fn random(
    shape: Shape,
    inputs: usize,
    outputs: usize,
    restless: Option<usize>,
    chance: &mut Chance,
) -> Program {
    let graph = Graph::new();
    let ids = grow(&graph, shape, inputs, chance, true);
    let mut results = Vec::new();
    for _ in 0..outputs {
        let from = ids.len() - 1 - chance.below(ids.len().min(3 * outputs));
        // Now and then the bare value, which may be an input or not a number.
        results.push(match chance.below(8) {
            0 => ids[chance.below(ids.len())],
            _ => within(&graph, ids[from]),
        });
    }
    if let Some(i) = restless {
        let x = graph.input(i);
        let (one, factor) = (graph.constant(1.0), graph.constant(3.99));
        results[i] = within(&graph, graph.mul(factor, graph.mul(x, graph.sub(one, x))));
    }
    graph.finish(inputs, &results)
}

/// 1, but 0 where a few conditions hold at once, or a restless input comes near its peak.
fn rarely_no(
    shape: Shape,
    inputs: usize,
    conditions: usize,
    restless: Option<usize>,
    chance: &mut Chance,
) -> Program {
    let graph = Graph::new();
    let ids = grow(&graph, shape, inputs, chance, true);
    let one = graph.constant(1.0);
    let mut result = graph.zero();
    for _ in 0..conditions {
        let late = ids.len().div_ceil(2);
        let [a, b] = std::array::from_fn(|_| ids[ids.len() - 1 - chance.below(late)]);
        result = graph.select(a, b, result, one);
    }
    if let Some(i) = restless {
        let (x, peak, zero) = (graph.input(i), graph.constant(0.99), graph.zero());
        result = graph.select(x, peak, result, zero);
    }
    graph.finish(inputs, &[result])
}

/// Counts of the trajectories compared, by outcome.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// All steps made.
    pub whole: usize,
    /// Stopped in the middle of a block.
    pub stopped: usize,
    /// No step at all, or back to the start of a block.
    pub back: usize,
}

fn bits(values: &[f64]) -> Vec<u64> {
    // Which of the many NaNs comes out is left open by IEEE 754.
    let bits = |value: &f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
    values.iter().map(bits).collect()
}

/// Lane `r` of numbers side by side.
fn lane(list: &[f64], r: usize) -> Vec<f64> {
    list.iter().skip(r).step_by(WIDTH).copied().collect()
}

/// Compares both functions of an entry with the interpreter on eight drawn states, lanes being live at random.
pub fn compare(sample: &Sample, entry: &Entry, steps: u64, chance: &mut Chance, seen: &mut Seen) {
    let Sample { kernel, slots } = sample;
    let [g, mu] = [kernel.element, kernel.dim].map(|count| chance.state(count * WIDTH));
    let live: [bool; WIDTH] = std::array::from_fn(|_| chance.below(5) > 0);
    let (mut g_expected, mut mu_expected) = (g.clone(), mu.clone());
    let (mut g_lanes, mut mu_lanes) = (g.clone(), mu.clone());
    let made = kernel.advance_lanes(slots, &mut g_expected, &mut mu_expected, steps, live);
    let made_lanes = entry.advance_lanes(slots, &mut g_lanes, &mut mu_lanes, steps, live);
    assert_eq!(made_lanes, made, "steps made by lanes out of {steps}");
    assert_eq!(bits(&g_lanes), bits(&g_expected), "g of lanes after {made:?} of {steps} steps");
    assert_eq!(bits(&mu_lanes), bits(&mu_expected), "μ of lanes after {made:?} of {steps} steps");

    for r in 0..WIDTH {
        let (mut g_expected, mut mu_expected) = (lane(&g, r), lane(&mu, r));
        let (mut g, mut mu) = (g_expected.clone(), mu_expected.clone());
        let expected = kernel.advance(slots, &mut g_expected, &mut mu_expected, steps);
        let found = entry.advance(slots, &mut g, &mut mu, steps);
        assert_eq!(found.steps, expected.steps, "steps made out of {steps}");
        assert_eq!(found.corrections, expected.corrections, "corrections");
        assert_eq!(bits(&[found.residual]), bits(&[expected.residual]), "residual");
        assert_eq!(bits(&g), bits(&g_expected), "g after {} steps", found.steps);
        assert_eq!(bits(&mu), bits(&mu_expected), "μ after {} steps", found.steps);
        if live[r] {
            assert_eq!(made[r], expected.steps, "steps made by a lane and alone");
        }
        match expected.steps {
            made if made == steps => seen.whole += 1,
            made if made % coadjoint_program::BLOCK == 0 => seen.back += 1,
            _ => seen.stopped += 1,
        }
    }
}
