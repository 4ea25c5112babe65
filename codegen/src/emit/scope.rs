//! Where a program is written: what its names stand for, and what it computes.

use proc_macro2::TokenStream;

/// What the names a program uses stand for.
pub struct Scope {
    /// The path of the runtime crate.
    pub krate: TokenStream,
    /// The type of `input`, over the scalar `T`.
    pub input: TokenStream,
    /// The length of `c`, an array of `T`.
    pub slots: usize,
    /// Whether `c` is an array of `C` instead, to be lifted to `T`.
    pub lifted: bool,
    /// The dimension of the algebra; for potentials, the size of the group's matrices.
    pub dim: usize,
    /// What the program computes.
    pub meaning: Meaning,
}

impl Scope {
    /// The same scope for a program that computes something else.
    #[must_use]
    pub fn of(&self, meaning: Meaning) -> Self {
        Self { krate: self.krate.clone(), input: self.input.clone(), meaning, ..*self }
    }
}

/// Some of the terms S₁ + … + S_K: those of the orders from `first` to `last`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Orders {
    /// The lowest order, odd.
    pub first: usize,
    /// The highest order, odd.
    pub last: usize,
}

impl Orders {
    /// `S₁ + … + S₇`.
    #[must_use]
    pub fn text(self) -> String {
        let Self { first, last } = self;
        match (first.abs_diff(last), first > last) {
            (_, true) => "0".to_owned(),
            (0, _) => format!("S{}", subscript(first)),
            (2, _) => format!("S{} + S{}", subscript(first), subscript(last)),
            _ => format!("S{} + … + S{}", subscript(first), subscript(last)),
        }
    }
}

/// What a program computes; it names the inputs, and says in comments what the outputs are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// p ↦ what no comment says.
    Unnamed,
    /// p ↦ S(p).
    Value,
    /// μ ↦ H_red(μ).
    Energy,
    /// p ↦ the gradient of these orders of S.
    Gradient(Orders),
    /// p ↦ the gradient of S, then the upper triangle of the Hessian of these orders.
    Hessian(Orders),
    /// (p, v) ↦ ∂²S₁/∂p²·v.
    Leading,
    /// μ ↦ a first guess of p.
    Guess,
    /// μ ↦ a first guess of x.
    Increment,
    /// μ ↦ twice the part of the guess of p that is even in h.
    EvenGuess,
    /// μ, then a number of steps ↦ about μ so much later.
    Onwards,
    /// μ in the middle of a step ↦ about x, and μ before it.
    Around,
    /// μ ↦ y, where exp y moves the frame.
    Frame,
    /// The entries of g ↦ V(g).
    Potential,
    /// The entries of g ↦ the body torque.
    Torque,
}

impl Meaning {
    /// The name of input number `i`, counted from zero; names count from one.
    #[must_use]
    pub fn input(self, i: usize, dim: usize) -> String {
        match self {
            Self::Leading if i >= dim => format!("v{}", i + 1 - dim),
            Self::Onwards if i >= dim => "later".to_owned(),
            Self::Unnamed | Self::Value | Self::Gradient(_) | Self::Hessian(_) | Self::Leading => {
                format!("p{}", i + 1)
            }
            Self::Potential | Self::Torque => {
                let size = dim.max(1);
                format!("g{}_{}", i / size + 1, i % size + 1)
            }
            _ => format!("mu{}", i + 1),
        }
    }

    /// What output number `i` is, counted from zero, as a formula.
    #[must_use]
    pub fn output(self, i: usize, dim: usize) -> Option<String> {
        let index = |i: usize| subscript(i + 1);
        let text = match self {
            Self::Unnamed => return None,
            Self::Value => "S(p)".to_owned(),
            Self::Energy => "H_red(μ)".to_owned(),
            Self::Gradient(orders) => format!("∂({})/∂p{}", orders.text(), index(i)),
            Self::Hessian(_) if i < dim => format!("∂S/∂p{}", index(i)),
            Self::Hessian(orders) => {
                let (row, column) = upper_triangle(i - dim, dim);
                let of = orders.text();
                if row == column {
                    format!("∂²({of})/∂p{}²", index(row))
                } else {
                    format!("∂²({of})/∂p{}∂p{}", index(row), index(column))
                }
            }
            Self::Leading => format!("(∂²S₁/∂p²·v){}", index(i)),
            Self::Guess => format!("p{}, the first guess", index(i)),
            Self::Increment => format!("x{}, the first guess", index(i)),
            Self::EvenGuess => format!("twice the part of p{} that is even in h", index(i)),
            Self::Onwards => format!("μ{}, later", index(i)),
            Self::Around if i < dim => format!("x{}", index(i)),
            Self::Around => format!("μ{} before the step", index(i - dim)),
            Self::Frame => format!("y{}", index(i)),
            Self::Potential => "V(g)".to_owned(),
            Self::Torque => format!("torque {}", i + 1),
        };
        Some(text)
    }
}

/// The row and the column of entry number `entry` of an upper triangle, row by row.
fn upper_triangle(mut entry: usize, dim: usize) -> (usize, usize) {
    for row in 0..dim {
        let length = dim - row;
        if entry < length {
            return (row, row + entry);
        }
        entry -= length;
    }
    (dim, dim)
}

/// A number in subscript digits.
#[must_use]
pub fn subscript(number: usize) -> String {
    let digit = |c: char| c.to_digit(10).and_then(|d| char::from_u32(0x2080 + d)).unwrap_or(c);
    number.to_string().chars().map(digit).collect()
}

/// A number in superscript digits.
#[must_use]
pub fn superscript(number: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or(c, |d| DIGITS[d as usize]);
    number.to_string().chars().map(digit).collect()
}
