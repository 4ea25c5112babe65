//! Steps that others make, on a simple cubic lattice written for nothing else: the two sublattices of a chessboard, each row
//! of each with a number on both sides that closes the ring, in lanes of eight.

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

/// Components of the spins of both sublattices.
#[derive(Clone)]
pub struct Board([[Vec<f64>; 3]; 2]);

#[inline(always)]
fn load(list: &[f64], at: usize) -> Pack {
    Pack(list[at..].first_chunk().copied().unwrap_or_default())
}

#[inline(always)]
fn spin(list: &[Vec<f64>; 3], at: usize) -> V3 {
    [load(&list[0], at), load(&list[1], at), load(&list[2], at)]
}

#[inline(always)]
fn store(list: &mut [Vec<f64>; 3], at: usize, v: V3) {
    for axis in 0..3 {
        if let Some(row) = list[axis][at..].first_chunk_mut() {
            *row = v[axis].0;
        }
    }
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
    /// The number of a row's sublattice before its first, and that of a row.
    fn row(self, y: usize, z: usize) -> usize {
        (z * self.side + y) * (self.side / 2 + 2 * EDGE) + EDGE
    }

    fn board(self) -> Board {
        let length = self.side * self.side * (self.side / 2 + 2 * EDGE);
        Board([(); 2].map(|()| [(); 3].map(|()| vec![0.0; length])))
    }

    fn place(self, site: usize) -> (usize, usize) {
        let (x, y, z) = (site % self.side, site / self.side % self.side, site / self.side.pow(2));
        ((x + y + z) % 2, self.row(y, z) + x / 2)
    }

    /// The spins of sites in C order.
    pub fn read(self, spins: &[[f64; 3]]) -> Board {
        let mut board = self.board();
        for (site, spin) in spins.iter().enumerate() {
            let (half, at) = self.place(site);
            (0..3).for_each(|axis| board.0[half][axis][at] = spin[axis]);
        }
        for half in 0..2 {
            for row in 0..self.side * self.side {
                self.close(&mut board.0[half], self.row(row % self.side, row / self.side));
            }
        }
        board
    }

    pub fn write(self, board: &Board, spins: &mut [[f64; 3]]) {
        for (site, spin) in spins.iter_mut().enumerate() {
            let (half, at) = self.place(site);
            *spin = [0, 1, 2].map(|axis| board.0[half][axis][at]);
        }
    }

    /// Closes the ring of a row.
    fn close(self, list: &mut [Vec<f64>; 3], row: usize) {
        let length = self.side / 2;
        for column in list {
            column[row - 1] = column[row + length - 1];
            column[row + length] = column[row];
        }
    }

    /// Calls `work` with the sublattice, the place, the spins and s × ∂H/∂s of every pack; and at the end of each row.
    #[inline(always)]
    fn sweep(
        self,
        board: &Board,
        out: &mut Board,
        mut work: impl FnMut(usize, usize, V3, V3, &mut [Vec<f64>; 3]),
    ) {
        let side = self.side;
        for z in 0..side {
            for y in 0..side {
                let row = self.row(y, z);
                let others = [
                    self.row((y + 1) % side, z),
                    self.row((y + side - 1) % side, z),
                    self.row(y, (z + 1) % side),
                    self.row(y, (z + side - 1) % side),
                ];
                for half in 0..2 {
                    let (own, other) = (&board.0[half], &board.0[1 - half]);
                    // The other neighbour along x stands before the one at the same place, or after it.
                    let beside = if half == (y + z) % 2 { row - 1 } else { row + 1 };
                    for at in (0..side / 2).step_by(8) {
                        let sum = |column: &[f64]| {
                            (load(column, row + at) + load(column, beside + at))
                                + (load(column, others[0] + at) + load(column, others[1] + at))
                                + (load(column, others[2] + at) + load(column, others[3] + at))
                        };
                        let v = spin(own, row + at);
                        let up = v[2].times_plus(Pack::of(2.0 * self.square), -sum(&other[2]));
                        let field = [-sum(&other[0]), -sum(&other[1]), up - Pack::of(self.field)];
                        work(half, row + at, v, cross(v, field), &mut out.0[half]);
                    }
                    self.close(&mut out.0[half], row);
                }
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
                let mut make = |from: &Board, to: &mut Board| {
                    self.sweep(from, to, |half, at, _, rate, out| {
                        let start = spin(&board.0[half], at);
                        let so_far = if stage == 0 { start } else { spin(&sum.0[half], at) };
                        store(&mut sum.0[half], at, plus(so_far, weight, rate));
                        if stage < 3 {
                            store(out, at, plus(start, ahead, rate));
                        }
                    });
                };
                match stage {
                    0 => make(board, &mut a),
                    2 => make(&b, &mut a),
                    _ => make(&a, &mut b),
                }
            }
            std::mem::swap(board, &mut sum);
            for half in 0..2 {
                for row in 0..self.side * self.side {
                    self.close(&mut board.0[half], self.row(row % self.side, row / self.side));
                }
            }
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
                self.sweep(&now, &mut next, |half, at, old, rate, out| {
                    let new = unit(plus(spin(&board.0[half], at), 0.5 * h, rate));
                    for axis in 0..3 {
                        let gap = new[axis] - old[axis];
                        change = change.with(gap, |a, b| if b.abs() > a { b.abs() } else { a });
                    }
                    store(out, at, new);
                });
                std::mem::swap(&mut now, &mut next);
                if change.0.into_iter().all(|change| change < 1e-12) {
                    break;
                }
            }
            self.sweep(&now, &mut next, |half, at, _, rate, out| {
                store(out, at, unit(plus(spin(&board.0[half], at), h, rate)));
            });
            std::mem::swap(board, &mut next);
        }
    }
}
