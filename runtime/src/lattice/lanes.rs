//! Eight numbers side by side, in plain loops that compilers turn into the vectors of the processor.

use coadjoint_geometry::row::Tuple;

/// The numbers of a pack.
pub const LANES: usize = 8;

/// Numbers of sites side by side.
pub type Pack = Tuple<f64, LANES>;

/// The larger of two numbers; not a number where one of them is none.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// The larger number of two in each lane; `b` where one of them is not a number.
#[inline(always)]
pub fn larger_each(a: Pack, b: Pack) -> Pack {
    let mut list = b.0;
    for lane in 0..LANES {
        list[lane] = if a.0[lane] > b.0[lane] { a.0[lane] } else { b.0[lane] };
    }
    Tuple(list)
}

/// The largest number; not a number where one of them is none.
#[inline(always)]
pub fn largest(pack: Pack) -> f64 {
    pack.0.into_iter().fold(f64::NEG_INFINITY, larger)
}
