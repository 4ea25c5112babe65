//! Functions that may be applied to parameters.

/// A function of one real number. (Those of the momentum are straight-line programs, [`coadjoint_program::Function`].)
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// The square root.
    Sqrt,
    /// The sine (radians).
    Sin,
    /// The cosine (radians).
    Cos,
    /// The tangent (radians).
    Tan,
    /// The inverse of the tangent.
    Atan,
    /// The hyperbolic tangent.
    Tanh,
    /// The exponential.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The absolute value.
    Abs,
}

impl Function {
    /// Every function.
    pub const ALL: [Self; 9] = [
        Self::Sqrt,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Atan,
        Self::Tanh,
        Self::Exp,
        Self::Ln,
        Self::Abs,
    ];

    /// The name of the function: the same in a system file and as a method of `f64`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sqrt => "sqrt",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Atan => "atan",
            Self::Tanh => "tanh",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
        }
    }

    /// The function of this name.
    #[must_use]
    pub fn lookup(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    /// The value of the function at `x`.
    #[must_use]
    pub fn apply(self, x: f64) -> f64 {
        match self {
            Self::Sqrt => x.sqrt(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Atan => x.atan(),
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Abs => x.abs(),
        }
    }

    /// The derivative of the function at `x`.
    #[must_use]
    pub fn slope(self, x: f64) -> f64 {
        match self {
            Self::Sqrt => 0.5 / x.sqrt(),
            Self::Sin => x.cos(),
            Self::Cos => -x.sin(),
            Self::Tan => 1.0 + x.tan().powi(2),
            Self::Atan => 1.0 / (1.0 + x * x),
            Self::Tanh => 1.0 - x.tanh().powi(2),
            Self::Exp => x.exp(),
            Self::Ln => 1.0 / x,
            Self::Abs if x == 0.0 => f64::NAN,
            Self::Abs => x.signum(),
        }
    }
}
