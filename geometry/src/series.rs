//! Entire functions of t by their power series, with as many terms as a stated reach needs, counted while compiling.

/// The most terms of a series.
const MOST: usize = 32;

/// Terms up to this one are looked at.
pub(crate) const TRIED: usize = 40;

/// The truncation allowed relative to the first term.
pub(crate) const ROUNDING: f64 = 1e-17;

/// The truncation of derivatives that only Newton's method uses.
pub const NEWTON: f64 = 1e-10;

/// Coefficients, and how many of them are needed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct List {
    /// The number of coefficients.
    pub count: usize,
    /// The coefficients, by powers of t.
    pub coefficients: [f64; MOST],
}

/// A function of t, 0 ≤ t ≤ reach, and its first three derivatives in t/2: with t = |x|² these are what x·v multiplies.
#[derive(Clone, Copy, Debug)]
pub struct Taylor(pub(crate) [List; 4]);

impl Taylor {
    /// Σ cₖ tᵏ, each derivative to its accuracy.
    pub(crate) const fn new(mut c: [f64; TRIED], reach: f64, accuracy: [f64; 4]) -> Self {
        let mut lists = [List { count: 1, coefficients: [0.0; MOST] }; 4];
        let mut order = 0;
        while order < 4 {
            let list = &mut lists[order];
            let (mut power, mut k) = (1.0, 0);
            while k < TRIED {
                if k < MOST {
                    list.coefficients[k] = c[k];
                }
                if k > 0 {
                    power *= reach;
                    if c[k].abs() * power > accuracy[order] * c[0].abs() {
                        list.count = k + 1;
                    }
                }
                k += 1;
            }
            assert!(list.count <= MOST, "the reach asks for more terms than there are");
            // The derivative.
            k = 0;
            while k + 1 < TRIED {
                c[k] = (2 * (k + 1)) as f64 * c[k + 1];
                k += 1;
            }
            c[TRIED - 1] = 0.0;
            order += 1;
        }
        Self(lists)
    }
}

/// scale · factorʲ (−1)ʲ/(2j + k)!
pub(crate) const fn alternating(k: usize, scale: f64, factor: f64) -> [f64; TRIED] {
    let mut c = [0.0; TRIED];
    let (mut factorial, mut i, mut j, mut power) = (1.0, 0, 0, scale);
    while j < TRIED {
        while i < 2 * j + k {
            i += 1;
            factorial *= i as f64;
        }
        c[j] = if j.is_multiple_of(2) { power / factorial } else { -power / factorial };
        power *= factor;
        j += 1;
    }
    c
}
