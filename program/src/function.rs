//! Functions as straight-line programs, so that they have the same bits on every target.
//!
//! Each is off by at most two units in the last place where the target fuses products, and where it does not. Outside its
//! domain a function is not a number. The ways of reducing arguments are those of fdlibm (Sun Microsystems, 1993); where
//! nothing else is said polynomials are Taylor's.

use alloc::vec::Vec;

use crate::graph::{Function, Graph, Id};

/// ln 2, its first 32 bits and the rest.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// π/2, three times 27 bits and the rest: products of the first three with whole numbers below 2²⁶ are exact.
const QUARTER_TURN: [f64; 4] = [
    1.570_796_325_802_803,
    9.920_935_739_593_517e-10,
    5.721_188_709_663_575e-18,
    1.644_625_693_632_425_8e-26,
];

/// The largest angle: beyond, its last digit is more than 10⁻⁸.
const LARGEST_ANGLE: f64 = 1e8;

/// atan t = t − t·(t²·ATAN[0] + t⁴·ATAN[1] + …) for |t| ≤ 7/16; the coefficients of fdlibm.
const ATAN: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932_4e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];

/// The least argument from which an angle is taken as its difference to that of tangent c: (least, c, angle, its rest).
const ATAN_STEPS: [(f64, f64, f64, f64); 3] = [
    (7.0 / 16.0, 0.5, 4.636_476_090_008_061e-1, 2.269_877_745_296_168_7e-17),
    (11.0 / 16.0, 1.0, core::f64::consts::FRAC_PI_4, 3.061_616_997_868_383e-17),
    (19.0 / 16.0, 1.5, 9.827_937_232_473_29e-1, 1.390_331_103_123_099_8e-17),
];
/// The entry of the right angle.
const ATAN_LAST: (f64, f64, f64) =
    (39.0 / 16.0, core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);

/// tanh x from this on is 1 − 2/(e²ˣ + 1).
const TANH_LARGE: f64 = 0.7;

impl Graph {
    /// A function of a.
    pub fn function(&self, function: Function, a: Id) -> Id {
        let result = match function {
            Function::Exp => self.exp(a),
            Function::Ln => self.ln(a),
            Function::Sin => self.sine(a, 0.0),
            Function::Cos => self.sine(a, 1.0),
            Function::Tan => self.tan(a),
            Function::Atan => self.atan(a),
            Function::Tanh => self.tanh(a),
            Function::Power(m, n) => return self.rational_power(a, m, n),
        };
        self.name(function, a, result);
        result
    }

    /// Σ coefficients\[k\]·xᵏ by Horner's scheme.
    fn horner(&self, x: Id, coefficients: &[f64]) -> Id {
        let mut sum = self.zero();
        for &coefficient in coefficients.iter().rev() {
            sum = self.times_plus(sum, x, self.constant(coefficient));
        }
        sum
    }

    /// r² and p such that exp r = 1 + r + r²·p for small r, by terms up to this degree.
    fn exp_rest(&self, r: Id, degree: u32) -> (Id, Id) {
        let mut factor = 1.0;
        let coefficients = (2..=degree).map(|k| {
            factor *= f64::from(k);
            1.0 / factor
        });
        let rest = self.horner(r, &coefficients.collect::<Vec<_>>());
        (self.mul(r, r), rest)
    }

    /// exp x as a number near 1 and the exponent of a power of two beside it.
    fn exp_parts(&self, x: Id) -> (Id, Id) {
        let [per_ln_2, high, low, one] =
            [core::f64::consts::LOG2_E, -LN_2[0], -LN_2[1], 1.0].map(|value| self.constant(value));
        let k = self.round(self.mul(x, per_ln_2));
        let r = self.times_plus(k, low, self.times_plus(k, high, x));
        let (square, rest) = self.exp_rest(r, 13);
        (self.add(self.times_plus(square, rest, r), one), k)
    }

    /// a · 2ᵏ for whole k as far as numbers reach.
    fn scale_far(&self, a: Id, k: Id) -> Id {
        let first = self.round(self.mul(k, self.constant(0.5)));
        let second = self.sub(k, first);
        self.scale(self.scale(a, first), second)
    }

    fn exp(&self, x: Id) -> Id {
        // Beyond these the result is 0 or infinite. What is no number passes both.
        let [low, high] = [-746.0, 710.0].map(|value| self.constant(value));
        let x = self.select(high, x, high, x);
        let (value, k) = self.exp_parts(self.select(x, low, low, x));
        self.scale_far(value, k)
    }

    /// The natural logarithm of a positive number's fraction, between √½ and √2, and its exponent.
    fn ln_parts(&self, x: Id) -> (LnOfFraction, Id) {
        // 2⁻¹⁰⁰⁰ and 2⁶⁴.
        let [tiny, raise] = [23, 1023 + 64].map(|exponent: u64| f64::from_bits(exponent << 52));
        let [tiny, raise, raised, root, two, half] =
            [tiny, raise, 64.0, core::f64::consts::SQRT_2, 2.0, 0.5]
                .map(|value| self.constant(value));
        let zero = self.zero();
        let larger = self.mul(x, raise);
        let lower = self.select(x, tiny, raised, zero);
        let x = self.select(x, tiny, larger, x);
        let e = self.exponent(self.mul(x, root));
        let fraction = self.scale_far(x, self.neg(e));
        let e = self.sub(e, lower);
        // ln(1 + f) = f − (f²/2 − s·(f²/2 + R)), s = f/(2 + f), R = Σ 2/(2k + 1) s²ᵏ.
        let f = self.sub(fraction, self.constant(1.0));
        let s = self.div(f, self.add(f, two));
        let z = self.mul(s, s);
        let series: Vec<f64> = (1..=11).map(|k| 2.0 / f64::from(2 * k + 1)).collect();
        let rest = self.mul(self.horner(z, &series), z);
        let half_square = self.mul(self.mul(f, half), f);
        let sum = self.add(half_square, rest);
        (LnOfFraction { f, half_square, product: (s, sum) }, e)
    }

    fn ln(&self, x: Id) -> Id {
        let [high, low, largest] = [LN_2[0], LN_2[1], f64::MAX].map(|value| self.constant(value));
        let (LnOfFraction { f, half_square, product: (s, sum) }, e) = self.ln_parts(x);
        let less = self.sub(self.sub(half_square, self.times_plus(s, sum, self.mul(e, low))), f);
        let value = self.sub(self.mul(e, high), less);
        // Infinities and what is no number stay themselves.
        let value = self.select(x, largest, value, x);
        let zero = self.zero();
        self.unless(value, self.select(x, zero, largest, zero))
    }

    /// A positive number, or what is no number.
    pub(crate) fn positive(&self, x: Id) -> Id {
        let (zero, largest) = (self.zero(), self.constant(f64::MAX));
        self.unless(x, self.select(x, zero, largest, zero))
    }

    /// a where `wrong` is 0, and not a number where it is the largest number: ∞ − ∞.
    fn unless(&self, a: Id, wrong: Id) -> Id {
        let wrong = self.mul(wrong, self.constant(f64::MAX));
        self.add(a, self.sub(wrong, wrong))
    }

    /// a to the power m/n.
    fn rational_power(&self, a: Id, m: i32, n: u32) -> Id {
        let common = common_divisor(m.unsigned_abs(), n).max(1);
        let (m, n) = (m / common as i32, n / common);
        let (whole, rest) = (m.unsigned_abs() / n, m.unsigned_abs() % n);
        let one = self.constant(1.0);
        let power = if whole == 0 { one } else { self.power(a, whole) };
        let result = match (rest, n, m < 0) {
            (0, _, false) => power,
            (0, _, true) => self.div(one, power),
            (_, 2, negative) => {
                let power = self.mul(power, self.sqrt(a));
                if negative { self.div(one, power) } else { power }
            }
            (_, _, false) => {
                self.mul(power, self.fractional_power(a, f64::from(rest), f64::from(n)))
            }
            (_, _, true) => {
                self.div(self.fractional_power(a, -f64::from(rest), f64::from(n)), power)
            }
        };
        // Products and roots are differentiated as such.
        if n > 1 && (m, n) != (1, 2) {
            self.name(Function::Power(m, n), a, result);
        }
        result
    }

    /// a to the power m/n of size below 1: the exponential of m/n times the logarithm of a's fraction, the power
    /// of two apart.
    fn fractional_power(&self, a: Id, m: f64, n: f64) -> Id {
        let (LnOfFraction { f, half_square, product: (s, sum) }, e) = self.ln_parts(a);
        let [m_of, per_n, ratio, ln_2, largest, less_n] =
            [m, 1.0 / n, m / n, core::f64::consts::LN_2 / n, f64::MAX, -n]
                .map(|value| self.constant(value));
        let logarithm = self.sub(f, self.sub(half_square, self.mul(s, sum)));
        // e·m = n·k + rest, so that 2^(e·m/n) = 2ᵏ·exp(rest·ln 2/n).
        let e = self.mul(e, m_of);
        let k = self.round(self.mul(e, per_n));
        let exponent = self.mul(self.times_plus(k, less_n, e), ln_2);
        let (value, more) = self.exp_parts(self.times_plus(logarithm, ratio, exponent));
        let value = self.scale_far(value, self.add(k, more));
        // Of 0 and ∞, of what has no root, and of what is no number.
        let root = self.sqrt(a);
        let one = self.constant(1.0);
        let special = if m < 0.0 { self.div(one, root) } else { root };
        self.select(a, largest, self.select(a, self.zero(), special, value), special)
    }

    /// The sine and the cosine of what is left of an angle beside whole quarter turns, each with what rounding took from
    /// it; and how many quarter turns these are, from this many on, between ∓2.
    fn circle(&self, x: Id, from: f64) -> ([Id; 2], [Id; 2], Id) {
        let [per_turn, from, fourth, less_four] =
            [core::f64::consts::FRAC_2_PI, from, 0.25, -4.0].map(|value| self.constant(value));
        let parts = QUARTER_TURN.map(|value| self.constant(value));
        let k = self.round(self.mul(x, per_turn));
        let back = self.neg(k);
        let first = self.times_plus(back, parts[0], x);
        let (difference, lost) = self.exact_difference(first, self.mul(k, parts[1]));
        let (difference, more) = self.exact_difference(difference, self.mul(k, parts[2]));
        let lost = self.times_plus(back, parts[3], self.add(lost, more));
        let high = self.add(difference, lost);
        let low = self.add(self.sub(difference, high), lost);
        let turns = self.add(k, from);
        let turns = self.times_plus(self.round(self.mul(turns, fourth)), less_four, turns);

        let series = |first: u32| {
            let mut factor = 1.0;
            let mut list = Vec::new();
            for k in 2..=17 {
                factor *= f64::from(k);
                if k >= first && k % 2 == first % 2 {
                    let sign = if (k - first).is_multiple_of(4) { 1.0 } else { -1.0 };
                    list.push(sign / factor);
                }
            }
            list
        };
        let half = self.constant(0.5);
        let one = self.constant(1.0);
        let z = self.mul(high, high);
        let half_square = self.mul(z, half);
        // sin(high + low) = high − (z·high·(1/6 − …) − low·(1 − z/2))
        let rest = self.horner(z, &series(3));
        let cube = self.mul(z, high);
        let cosine = self.sub(one, half_square);
        let linear = self.mul(low, cosine);
        let rest = self.sub(self.mul(cube, rest), linear);
        let sine = self.sub(high, rest);
        let sine_rest = self.sub(self.sub(high, sine), rest);
        // cos(high + low) = (1 − z/2) + (1 − (1 − z/2) − z/2 + z²·(1/24 − …) − high·low)
        let lost = self.sub(self.sub(one, cosine), half_square);
        let rest = self.horner(z, &series(4));
        let rest = self.times_plus(self.mul(z, z), rest, self.sub(lost, self.mul(high, low)));
        let whole = self.add(cosine, rest);
        ([sine, sine_rest], [whole, self.add(self.sub(cosine, whole), rest)], turns)
    }

    /// a − b, and what rounding took from it.
    fn exact_difference(&self, a: Id, b: Id) -> (Id, Id) {
        let difference = self.sub(a, b);
        let taken = self.sub(difference, a);
        (difference, self.sub(self.sub(a, self.sub(difference, taken)), self.add(b, taken)))
    }

    /// An angle in the domain, or what is no number.
    fn angle(&self, x: Id) -> Id {
        let [most, largest] = [LARGEST_ANGLE, f64::MAX].map(|value| self.constant(value));
        self.unless(x, self.select(self.abs(x), most, self.zero(), largest))
    }

    /// sin(x + from·π/2).
    fn sine(&self, x: Id, from: f64) -> Id {
        let x = self.angle(x);
        let ([sine, _], [cosine, _], turns) = self.circle(x, from);
        let [half, half_down, most] = [0.5, -0.5, 1.5].map(|value| self.constant(value));
        let size = self.abs(turns);
        // At ∓1 turns the other one of the two.
        let value = self.select(size, half, sine, self.select(size, most, cosine, sine));
        // Negative at −2, −1 and 2.
        let value = self.select(turns, half_down, self.neg(value), value);
        self.select(most, turns, self.neg(sine), value)
    }

    fn tan(&self, x: Id) -> Id {
        let (sine, cosine, turns) = self.circle(self.angle(x), 0.0);
        let [half, most] = [0.5, 1.5].map(|value| self.constant(value));
        let size = self.abs(turns);
        let back = cosine.map(|part| self.neg(part));
        let chosen =
            |even: Id, odd: Id| self.select(size, half, even, self.select(size, most, odd, even));
        let numerator = [chosen(sine[0], back[0]), chosen(sine[1], back[1])];
        let denominator = [chosen(cosine[0], sine[0]), chosen(cosine[1], sine[1])];
        let quotient = self.div(numerator[0], denominator[0]);
        let rest = self.mul(quotient, denominator[1]);
        self.add(quotient, self.div(self.sub(numerator[1], rest), denominator[0]))
    }

    fn atan(&self, x: Id) -> Id {
        let size = self.abs(x);
        let one = self.constant(1.0);
        let zero = self.zero();
        let (mut numerator, mut denominator) = (size, one);
        let (mut angle, mut angle_rest) = (zero, zero);
        let last = (ATAN_LAST.0, None, ATAN_LAST.1, ATAN_LAST.2);
        let steps = ATAN_STEPS.map(|(from, c, angle, rest)| (from, Some(c), angle, rest));
        for (from, c, of_c, rest) in steps.into_iter().chain([last]) {
            let [from, of_c, rest] = [from, of_c, rest].map(|value| self.constant(value));
            let (above, below) = match c {
                // tan(α − γ) = (x − c)/(1 + c·x)
                Some(c) => {
                    let c = self.constant(c);
                    (self.sub(size, c), self.times_plus(c, size, one))
                }
                None => (self.constant(-1.0), size),
            };
            numerator = self.select(from, size, above, numerator);
            denominator = self.select(from, size, below, denominator);
            angle = self.select(from, size, of_c, angle);
            angle_rest = self.select(from, size, rest, angle_rest);
        }
        let t = self.div(numerator, denominator);
        let z = self.mul(t, t);
        let series = self.mul(self.horner(z, &ATAN), z);
        let value = self.sub(angle, self.sub(self.sub(self.mul(t, series), angle_rest), t));
        self.select(zero, x, value, self.neg(value))
    }

    fn tanh(&self, x: Id) -> Id {
        let [one, two, large] = [1.0, 2.0, TANH_LARGE].map(|value| self.constant(value));
        let zero = self.zero();
        let size = self.abs(x);
        let double = self.mul(size, two);
        // tanh x = x − (x·t − (t − 2x))/(t + 2), t = e²ˣ − 1.
        let (square, rest) = self.exp_rest(double, 23);
        let rest = self.mul(square, rest);
        let t = self.add(double, rest);
        let small = self.sub(self.mul(size, t), rest);
        let beside = self.add(t, two);
        let sum = self.add(self.exp(double), one);
        let numerator = self.select(large, size, two, small);
        let quotient = self.div(numerator, self.select(large, size, sum, beside));
        let value = self.sub(self.select(large, size, one, size), quotient);
        self.select(zero, x, value, self.neg(value))
    }
}

/// ln(1 + f) = f − (f²/2 − product), the product of two numbers.
struct LnOfFraction {
    f: Id,
    half_square: Id,
    product: (Id, Id),
}

fn common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}
