//! Steps that others make, on a simple cubic lattice written for nothing else: the two sublattices of a chessboard, each row
//! of each with a number on both sides that closes the ring, in lanes of eight.

// Copies of slices stay calls.
#![allow(clippy::manual_memcpy)]

/// Eight numbers.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Pack([f64; 8]);

impl Pack {
    fn of(value: f64) -> Self {
        Self([value; 8])
    }

    #[inline(always)]
    fn with(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for lane in 0..8 {
            self.0[lane] = f(self.0[lane], other.0[lane]);
        }
        self
    }

    /// self · a + b, fused where the build target has the instruction.
    #[inline(always)]
    fn times_plus(mut self, a: Self, b: Self) -> Self {
        for lane in 0..8 {
            self.0[lane] = match cfg!(target_feature = "fma") {
                true => self.0[lane].mul_add(a.0[lane], b.0[lane]),
                false => self.0[lane] * a.0[lane] + b.0[lane],
            };
        }
        self
    }
}

macro_rules! operators {
    ($($operator:ident $name:ident $sign:tt),*) => {$(
        impl std::ops::$operator for Pack {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.with(other, |a, b| a $sign b)
            }
        }
    )*};
}

operators!(Add add +, Sub sub -, Mul mul *);

impl std::ops::Neg for Pack {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with(self, |a, _| -a)
    }
}

type V3 = [Pack; 3];

/// Numbers on both sides of a row.
const EDGE: usize = 8;

/// H = Σ −a·b + Σ (D z² − B z) on a periodic cube whose side is a multiple of 16.
#[derive(Clone, Copy)]
pub struct Cube {
    pub side: usize,
    pub square: f64,
    pub field: f64,
}

/// Components of the spins, for each row those of both sublattices one after the other.
#[derive(Clone)]
pub struct Board(Vec<f64>);

#[inline(always)]
fn load(list: &[f64], at: usize) -> Pack {
    let list = &list[at..at + 8];
    let mut pack = [0.0; 8];
    for lane in 0..8 {
        pack[lane] = list[lane];
    }
    Pack(pack)
}

/// The sum of the packs of six rows at a place.
#[inline(always)]
fn six(Board(list): &Board, rows: [usize; 6], at: usize) -> Pack {
    (load(list, rows[0] + at) + load(list, rows[1] + at))
        + (load(list, rows[2] + at) + load(list, rows[3] + at))
        + (load(list, rows[4] + at) + load(list, rows[5] + at))
}

#[inline(always)]
fn plus(a: V3, s: f64, b: V3) -> V3 {
    let s = Pack::of(s);
    [b[0].times_plus(s, a[0]), b[1].times_plus(s, a[1]), b[2].times_plus(s, a[2])]
}

#[inline(always)]
fn cross(a: V3, b: V3) -> V3 {
    let entry = |i: usize, j: usize| (-a[j]).times_plus(b[i], a[i] * b[j]);
    [entry(1, 2), entry(2, 0), entry(0, 1)]
}

#[inline(always)]
fn unit(v: V3) -> V3 {
    let square = v[0].times_plus(v[0], v[1].times_plus(v[1], v[2] * v[2]));
    let factor = square.with(square, |square, _| 1.0 / square.sqrt());
    [v[0] * factor, v[1] * factor, v[2] * factor]
}

impl Cube {
    /// The numbers of a component of a row.
    fn width(self) -> usize {
        self.side / 2 + 2 * EDGE
    }

    /// The place of the first number of a row.
    fn row(self, y: usize, z: usize) -> usize {
        (z * self.side + y) * 6 * self.width() + EDGE
    }

    /// The place of a site's first component.
    fn place(self, site: usize) -> usize {
        let (x, y, z) = (site % self.side, site / self.side % self.side, site / self.side.pow(2));
        let half = (x + y + z) % 2;
        self.row(y, z) + 3 * half * self.width() + x / 2
    }

    /// The spins of sites in C order.
    pub fn read(self, spins: &[[f64; 3]]) -> Board {
        let mut board = Board(vec![0.0; self.side.pow(2) * 6 * self.width()]);
        for (site, spin) in spins.iter().enumerate() {
            let at = self.place(site);
            (0..3).for_each(|axis| board.0[at + axis * self.width()] = spin[axis]);
        }
        self.close_all(&mut board);
        board
    }

    pub fn write(self, board: &Board, spins: &mut [[f64; 3]]) {
        for (site, spin) in spins.iter_mut().enumerate() {
            let at = self.place(site);
            *spin = [0, 1, 2].map(|axis| board.0[at + axis * self.width()]);
        }
    }

    /// Closes the rings of a row.
    fn close(self, board: &mut Board, row: usize) {
        let length = self.side / 2;
        for column in 0..6 {
            let at = row + column * self.width();
            board.0[at - 1] = board.0[at + length - 1];
            board.0[at + length] = board.0[at];
        }
    }

    fn close_all(self, board: &mut Board) {
        for row in 0..self.side.pow(2) {
            self.close(board, self.row(row % self.side, row / self.side));
        }
    }

    #[inline(always)]
    fn spin(self, board: &Board, at: usize) -> V3 {
        let width = self.width();
        [load(&board.0, at), load(&board.0, at + width), load(&board.0, at + 2 * width)]
    }

    #[inline(always)]
    fn store(self, board: &mut Board, at: usize, v: V3) {
        for axis in 0..3 {
            let at = at + axis * self.width();
            let list = &mut board.0[at..at + 8];
            for lane in 0..8 {
                list[lane] = v[axis].0[lane];
            }
        }
    }

    /// The sum of the spins of six rows at a place.
    #[inline(always)]
    fn six(self, board: &Board, rows: [usize; 6], at: usize) -> V3 {
        let width = self.width();
        [six(board, rows, at), six(board, rows, at + width), six(board, rows, at + 2 * width)]
    }

    /// Calls `work` with the place, the spins and s × ∂H/∂s of every pack, to write into `out`.
    #[inline(always)]
    fn sweep(
        self,
        board: &Board,
        out: &mut Board,
        mut work: impl FnMut(usize, V3, V3, &mut Board),
    ) {
        let (side, width) = (self.side, self.width());
        for z in 0..side {
            for y in 0..side {
                let row = self.row(y, z);
                for half in 0..2 {
                    let (own, other) = (3 * half * width, 3 * (1 - half) * width);
                    // The other neighbour along x stands before the one at the same place, or after it.
                    let beside = if half == (y + z) % 2 { row - 1 } else { row + 1 };
                    let rows = [
                        row,
                        beside,
                        self.row((y + 1) % side, z),
                        self.row((y + side - 1) % side, z),
                        self.row(y, (z + 1) % side),
                        self.row(y, (z + side - 1) % side),
                    ];
                    for at in (0..side / 2).step_by(8) {
                        let v = self.spin(board, row + own + at);
                        let [x, y, z] = self.six(board, rows, other + at);
                        let up = v[2].times_plus(Pack::of(2.0 * self.square), -z);
                        let field = [-x, -y, up - Pack::of(self.field)];
                        work(row + own + at, v, cross(v, field), out);
                    }
                }
                self.close(out, row);
            }
        }
    }

    /// Steps of the classical Runge–Kutta method, fused, with three boards beside the state.
    pub fn runge_kutta(self, board: &mut Board, h: f64, steps: u64) {
        let [mut sum, mut a, mut b] = [(); 3].map(|()| board.clone());
        for _ in 0..steps {
            for (stage, (weight, ahead)) in
                [(6.0, 0.5), (3.0, 0.5), (3.0, 1.0), (6.0, 0.0)].into_iter().enumerate()
            {
                let (weight, ahead) = (h / weight, ahead * h);
                let from = if stage == 0 { &*board } else { &a };
                self.sweep(
                    from,
                    &mut b,
                    #[inline(always)]
                    |at, _, rate, out| {
                        let start = self.spin(board, at);
                        let so_far = if stage == 0 { start } else { self.spin(&sum, at) };
                        self.store(&mut sum, at, plus(so_far, weight, rate));
                        if stage < 3 {
                            self.store(out, at, plus(start, ahead, rate));
                        }
                    },
                );
                std::mem::swap(&mut a, &mut b);
            }
            std::mem::swap(board, &mut sum);
            self.close_all(board);
        }
    }

    /// Steps of the spherical midpoint rule (R. I. McLachlan, K. Modin, O. Verdier, 2014), which Sunny has, by sweeps until
    /// nothing changes by more than 1e-12.
    pub fn midpoint(self, board: &mut Board, h: f64, steps: u64) {
        let [mut now, mut next] = [(); 2].map(|()| board.clone());
        for _ in 0..steps {
            now.clone_from(board);
            for _ in 0..100 {
                let mut change = Pack::of(0.0);
                self.sweep(
                    &now,
                    &mut next,
                    #[inline(always)]
                    |at, old, rate, out| {
                        let new = unit(plus(self.spin(board, at), 0.5 * h, rate));
                        for axis in 0..3 {
                            let gap = new[axis] - old[axis];
                            change = change.with(
                                gap,
                                #[inline(always)]
                                |a, b| if a > b.abs() { a } else { b.abs() },
                            );
                        }
                        self.store(out, at, new);
                    },
                );
                std::mem::swap(&mut now, &mut next);
                if change.0.into_iter().all(|change| change < 1e-12) {
                    break;
                }
            }
            self.sweep(
                &now,
                &mut next,
                #[inline(always)]
                |at, _, rate, out| {
                    self.store(out, at, unit(plus(self.spin(board, at), h, rate)));
                },
            );
            std::mem::swap(board, &mut next);
        }
    }
}
