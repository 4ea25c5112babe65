//! Programs evaluated in numbers of other kinds than the interpreter's, and numbers by chance.

use coadjoint_program::{Node, Program, bits};

/// The numbers that programs are evaluated in.
pub trait Number: Copy {
    fn of(value: f64) -> Self;
    fn value(self) -> f64;
    fn add(self, b: Self) -> Self;
    fn mul(self, b: Self) -> Self;
    fn div(self, b: Self) -> Self;
    fn sqrt(self) -> Self;
}

/// A number and its derivative.
#[derive(Clone, Copy, Debug)]
pub struct Dual(pub f64, pub f64);

impl Number for Dual {
    fn of(value: f64) -> Self {
        Self(value, 0.0)
    }
    fn value(self) -> f64 {
        self.0
    }
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.0 + self.0 * b.1)
    }
    fn div(self, b: Self) -> Self {
        let y = self.0 / b.0;
        Self(y, (self.1 - y * b.1) / b.0)
    }
    fn sqrt(self) -> Self {
        let y = self.0.sqrt();
        Self(y, 0.5 * self.1 / y)
    }
}

/// A number without fused products.
impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn add(self, b: Self) -> Self {
        self + b
    }
    fn mul(self, b: Self) -> Self {
        self * b
    }
    fn div(self, b: Self) -> Self {
        self / b
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
}

/// The outputs of a program.
pub fn evaluate<T: Number>(program: &Program, inputs: &[T], slots: &[T]) -> Vec<T> {
    let mut values: Vec<T> = Vec::new();
    for node in program.nodes() {
        let at = |id: coadjoint_program::Id| values[id.index()];
        let negative = |a: T| a.mul(T::of(-1.0));
        let value = match *node {
            Node::Zero => T::of(0.0),
            Node::Constant(bits) => T::of(f64::from_bits(bits)),
            Node::Epsilon => T::of(f64::EPSILON),
            Node::Input(i) => inputs[i as usize],
            Node::Slot(i) => slots[i as usize],
            Node::Add(a, b) => at(a).add(at(b)),
            Node::Sub(a, b) => at(a).add(negative(at(b))),
            Node::Mul(a, b) => at(a).mul(at(b)),
            Node::TimesPlus(a, b, c) => at(a).mul(at(b)).add(at(c)),
            Node::Div(a, b) => at(a).div(at(b)),
            Node::Neg(a) => negative(at(a)),
            Node::Abs(a) if at(a).value() < 0.0 => negative(at(a)),
            Node::Abs(a) => at(a),
            Node::Sqrt(a) => at(a).sqrt(),
            Node::Round(a) => T::of(at(a).value().round_ties_even()),
            Node::Scale(a, k) => at(a).mul(T::of(bits::power_of_two(at(k).value()))),
            Node::Exponent(a) => T::of(bits::exponent(at(a).value())),
            Node::Select(a, b, c, _) if at(a).value() <= at(b).value() => at(c),
            Node::Select(.., d) => at(d),
        };
        values.push(value);
    }
    program.outputs().iter().map(|output| values[output.index()]).collect()
}

/// Numbers by chance, the same ones in every run: SplitMix64.
pub struct Chance(pub u64);

impl Chance {
    pub fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
