//! The numbers that programs are evaluated in: several at once, each with the bits that it would have alone.

#[cfg(not(feature = "std"))]
pub(crate) use libm::{fma as fused, rint as nearest, sqrt as root};
#[cfg(feature = "std")]
pub(crate) use standard::{fused, nearest, root};

#[cfg(feature = "std")]
mod standard {
    #[inline(always)]
    pub(crate) fn fused(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    #[inline(always)]
    pub(crate) fn root(a: f64) -> f64 {
        a.sqrt()
    }

    #[inline(always)]
    pub(crate) fn nearest(a: f64) -> f64 {
        a.round_ties_even()
    }
}

/// L numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes<const L: usize>(pub [f64; L]);

impl<const L: usize> Lanes<L> {
    /// The same number in all lanes.
    #[inline(always)]
    pub(crate) fn of(value: f64) -> Self {
        Self([value; L])
    }

    /// A function of numbers, in each lane.
    #[inline(always)]
    pub(crate) fn each<const N: usize>(numbers: [Self; N], f: impl Fn([f64; N]) -> f64) -> Self {
        let mut result = [0.0; L];
        for lane in 0..L {
            let mut own = [0.0; N];
            for i in 0..N {
                own[i] = numbers[i].0[lane];
            }
            result[lane] = f(own);
        }
        Self(result)
    }

    /// Number i of the list; NaN where it is shorter.
    #[inline(always)]
    pub(crate) fn load(list: &[f64], i: usize) -> Self {
        let number = |lane| list.get(i * L + lane).copied().unwrap_or(f64::NAN);
        Self(core::array::from_fn(number))
    }

    #[inline(always)]
    pub(crate) fn store(self, list: &mut [f64], i: usize) {
        for (lane, value) in self.0.into_iter().enumerate() {
            if let Some(place) = list.get_mut(i * L + lane) {
                *place = value;
            }
        }
    }

    /// In live lanes `new`, in others self.
    #[inline(always)]
    pub(crate) fn update(mut self, live: [bool; L], new: Self) -> Self {
        for lane in 0..L {
            if live[lane] {
                self.0[lane] = new.0[lane];
            }
        }
        self
    }
}
