//! The nodes of a graph, and their cost.

/// A node of a [`Graph`](crate::Graph), an index into its arena. Operands have smaller ids than their users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The index into [`Program::nodes`](crate::Program::nodes).
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One operation on numbers. Each is rounded once, as IEEE 754 says; nothing may be contracted or reordered.
///
/// The programs of a generating function have inputs, slots, sums, products and fused products only: signs and numbers
/// live in their slots. A whole step has the others too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Node {
    /// The number 0, the value of an empty polynomial.
    Zero,
    /// Another number, by its bits.
    Constant(u64),
    /// The distance from 1 to the next larger number of the type that the program is evaluated in.
    Epsilon,
    /// Input number i.
    Input(u32),
    /// Folded coefficient number i.
    Slot(u32),
    /// a + b
    Add(Id, Id),
    /// a − b
    Sub(Id, Id),
    /// a · b
    Mul(Id, Id),
    /// a · b + c, rounded once where the target rounds as the processor's fused product does.
    TimesPlus(Id, Id, Id),
    /// a / b
    Div(Id, Id),
    /// −a
    Neg(Id),
    /// |a|
    Abs(Id),
    /// √a
    Sqrt(Id),
    /// The integer nearest to a, the even one of two.
    Round(Id),
    /// a · 2ᵏ, for whole k from −1022 to 1023, rounded once where the result is too small: the product with the number
    /// whose exponent field is that of k. Other k give other numbers, the same on every target.
    Scale(Id, Id),
    /// The exponent of a: ⌊log₂ |a|⌋; for numbers too small to have a leading 1, and 0, one less than that of the
    /// smallest with one (−1023), for infinities and what is no number one more than that of the largest (1024).
    Exponent(Id),
    /// c if a ≤ b, else d; d where a or b is not a number.
    Select(Id, Id, Id, Id),
}

impl Node {
    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = Id> + use<> {
        let list = match *self {
            Self::Zero | Self::Constant(_) | Self::Epsilon | Self::Input(_) | Self::Slot(_) => {
                [None; 4]
            }
            Self::Neg(a) | Self::Abs(a) | Self::Sqrt(a) | Self::Round(a) | Self::Exponent(a) => {
                [Some(a), None, None, None]
            }
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Scale(a, b) => [Some(a), Some(b), None, None],
            Self::TimesPlus(a, b, c) => [Some(a), Some(b), Some(c), None],
            Self::Select(a, b, c, d) => [Some(a), Some(b), Some(c), Some(d)],
        };
        list.into_iter().flatten()
    }

    /// The same operation with operands renamed by `rename`.
    #[must_use]
    pub fn map(self, rename: impl Fn(Id) -> Id) -> Self {
        match self {
            Self::Add(a, b) => Self::Add(rename(a), rename(b)),
            Self::Sub(a, b) => Self::Sub(rename(a), rename(b)),
            Self::Mul(a, b) => Self::Mul(rename(a), rename(b)),
            Self::Div(a, b) => Self::Div(rename(a), rename(b)),
            Self::TimesPlus(a, b, c) => Self::TimesPlus(rename(a), rename(b), rename(c)),
            Self::Neg(a) => Self::Neg(rename(a)),
            Self::Abs(a) => Self::Abs(rename(a)),
            Self::Sqrt(a) => Self::Sqrt(rename(a)),
            Self::Round(a) => Self::Round(rename(a)),
            Self::Scale(a, k) => Self::Scale(rename(a), rename(k)),
            Self::Exponent(a) => Self::Exponent(rename(a)),
            Self::Select(a, b, c, d) => Self::Select(rename(a), rename(b), rename(c), rename(d)),
            leaf @ (Self::Zero
            | Self::Constant(_)
            | Self::Epsilon
            | Self::Input(_)
            | Self::Slot(_)) => leaf,
        }
    }
}

/// How many operations a program takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Products, those inside a product-and-sum included.
    pub multiplications: usize,
    /// Sums and differences, those inside a product-and-sum included.
    pub additions: usize,
    /// Quotients and roots.
    pub divisions: usize,
}

impl Cost {
    /// All operations; comparisons, signs and absolute values count nothing.
    #[must_use]
    pub fn total(self) -> usize {
        self.multiplications + self.additions + self.divisions
    }

    /// The cost of these nodes.
    #[must_use]
    pub fn of(nodes: &[Node]) -> Self {
        let mut cost = Self::default();
        for node in nodes {
            match node {
                Node::Add(..) | Node::Sub(..) => cost.additions += 1,
                Node::Mul(..) | Node::Scale(..) => cost.multiplications += 1,
                Node::TimesPlus(..) => {
                    cost.additions += 1;
                    cost.multiplications += 1;
                }
                Node::Div(..) | Node::Sqrt(_) => cost.divisions += 1,
                _ => {}
            }
        }
        cost
    }
}
