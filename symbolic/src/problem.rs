//! The result of every front end: a Lie–Poisson system, ready for the derivation.

use crate::comoving::Frame;
use crate::expr::ParameterExpr;
use crate::lie::{Chart, LieAlgebra};
use crate::number::Rational;
use crate::poly::Polynomial;

/// An opaque coefficient: an expression in parameters only.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The expression.
    pub expr: ParameterExpr,
    /// The expression as a user would write it.
    pub text: String,
}

/// The values of symbols in which no parameter is left, such as sqrt(2).
pub fn values(symbols: &[Symbol]) -> Vec<f64> {
    symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect()
}

/// The type of a parameter in Rust.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// `f64`.
    Scalar,
    /// `[f64; n]`.
    Array(usize),
    /// `nalgebra::SVector<f64, n>`.
    Vector(usize),
    /// `[[f64; columns]; rows]`, flattened row by row.
    Grid(usize, usize),
    /// `nalgebra::SMatrix<f64, rows, columns>`, flattened row by row.
    Matrix(usize, usize),
}

impl Shape {
    /// Its lengths: none of a scalar, one of a list, two of a matrix.
    pub fn lengths(&self) -> Vec<usize> {
        match self {
            Self::Scalar => Vec::new(),
            Self::Array(n) | Self::Vector(n) => vec![*n],
            Self::Grid(rows, columns) | Self::Matrix(rows, columns) => vec![*rows, *columns],
        }
    }

    /// The number of scalars it holds.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        self.lengths().iter().product()
    }
}

/// A parameter of the Hamiltonian. Parameters are flattened to scalars in their order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The name of the parameter.
    pub name: String,
    /// The type of the parameter.
    pub shape: Shape,
    /// The value of each scalar, where the input gives one.
    pub default: Option<Vec<Rational>>,
}

impl Parameter {
    /// The names of its scalars: `m`, or `inertia[0]`, …, or `a[0][0]`, ….
    pub fn scalar_names(&self) -> Vec<String> {
        let name = &self.name;
        match self.shape {
            Shape::Scalar => vec![name.clone()],
            Shape::Array(n) | Shape::Vector(n) => (0..n).map(|i| format!("{name}[{i}]")).collect(),
            Shape::Grid(rows, columns) => (0..rows)
                .flat_map(|i| (0..columns).map(move |j| format!("{name}[{i}][{j}]")))
                .collect(),
            Shape::Matrix(rows, columns) => (0..rows)
                .flat_map(|i| (0..columns).map(move |j| format!("{name}[({i}, {j})]")))
                .collect(),
        }
    }
}

/// The method by which a step solves for p.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solver {
    /// Newton's method, or a variant of it, with the Hessian of S: the default up to 24 dimensions.
    Newton,
    /// The fixed point, which needs the gradient of S alone: the default beyond.
    FixedPoint,
}

impl Solver {
    /// Newton's method is the default up to this dimension. From about 15 to 50 dimensions a step
    /// costs nearly the same either way; but the Hessian's code grows with the square of the
    /// dimension where the couplings are dense, and so do the times of generation and compilation.
    /// Below, Newton's method is mostly the faster, and it converges for longer steps.
    pub(crate) const NEWTON_DIMENSIONS: usize = 24;

    /// The names users write, `newton` and `fixed_point`.
    pub const NAMES: [&str; 2] = ["newton", "fixed_point"];

    /// The default for a group of this dimension.
    pub fn of_dimension(dimension: usize) -> Self {
        match dimension {
            0..=Self::NEWTON_DIMENSIONS => Self::Newton,
            _ => Self::FixedPoint,
        }
    }

    /// The solver of this name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "newton" => Some(Self::Newton),
            "fixed_point" => Some(Self::FixedPoint),
            _ => None,
        }
    }
}

/// The frame in which S generates the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrameChoice {
    /// The comoving one where a linear term of H_red commutes with the rest; where truncation and step are chosen by a
    /// tolerance, the one in which steps are cheaper.
    #[default]
    Auto,
    /// S generates the flow of all of H_red.
    Fixed,
    /// S generates what is left in the comoving frame, whose own motion follows each step.
    Comoving,
}

impl FrameChoice {
    /// The names users write, `auto`, `fixed` and `comoving`.
    pub const NAMES: [&str; 3] = ["auto", "fixed", "comoving"];

    /// The choice of this name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "auto" => Some(Self::Auto),
            "fixed" => Some(Self::Fixed),
            "comoving" => Some(Self::Comoving),
            _ => None,
        }
    }
}

/// The method by which steps are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The generating function, as a series in the step: for polynomials, and their default.
    Series,
    /// Gauss's method in a chart about the middle of the step, from the gradient of H alone: the default for other functions.
    Collocation,
}

impl Method {
    /// The names users write, `series` and `collocation`.
    pub const NAMES: [&str; 2] = ["series", "collocation"];

    /// The method of this name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "series" => Some(Self::Series),
            "collocation" => Some(Self::Collocation),
            _ => None,
        }
    }
}

/// A Hamiltonian H_red on the dual of a Lie algebra, a chart and a truncation.
///
/// H_red is a polynomial over ℚ in the coordinates of the momentum (the first `algebra.dim()`
/// variables) and the [`Symbol`]s (the variables after them).
#[derive(Clone, Debug)]
pub struct Problem {
    /// The name of the system.
    pub name: String,
    /// The Lie algebra 𝔤.
    pub algebra: LieAlgebra,
    /// The names of the momentum's coordinates, dual to the basis of 𝔤.
    pub coordinates: Vec<String>,
    /// The reduced Hamiltonian H_red.
    pub hamiltonian: Polynomial,
    /// The opaque coefficients of `hamiltonian`.
    pub symbols: Vec<Symbol>,
    /// The parameters the symbols are made of.
    pub parameters: Vec<Parameter>,
    /// The Hamiltonian as the user wrote it.
    pub source: String,
    /// The chart in which S is derived.
    pub chart: Chart,
    /// The truncation K: S₁ … S_K are kept.
    pub truncation: usize,
    /// The solver asked for; `None` takes the default for the dimension.
    pub solver: Option<Solver>,
    /// The frame asked for.
    pub frame: FrameChoice,
    /// The comoving frame, if S is to generate the motion in it.
    pub comoving: Option<Frame>,
    /// True if h·H_red is the generating function of a learned map, not the first term of a series.
    pub learned: bool,
}

impl Problem {
    /// The Hamiltonian whose flow S generates: H_red, less the summand f of a comoving frame.
    pub fn generated(&self) -> &Polynomial {
        self.comoving.as_ref().map_or(&self.hamiltonian, |frame| &frame.rest)
    }

    /// The values of the symbols for these of the parameters that are kept.
    pub fn symbols_at(&self, parameters: &[f64]) -> Vec<f64> {
        self.symbols.iter().map(|symbol| symbol.expr.evaluate(parameters)).collect()
    }

    /// Puts the default values of the parameters in, in the same frame; exactly, if the coefficients are then rational.
    pub fn with_defaults(&self) -> Self {
        let dim = self.algebra.dim();
        let values = |parameter: &Parameter| match &parameter.default {
            Some(values) => values.iter().cloned().map(Some).collect(),
            None => vec![None; parameter.shape.len()],
        };
        let values: Vec<Option<Rational>> = self.parameters.iter().flat_map(values).collect();
        let with_values =
            |symbol: &Symbol| Symbol { expr: symbol.expr.with_values(&values), ..symbol.clone() };
        let symbols: Vec<Symbol> = self.symbols.iter().map(with_values).collect();
        let put_in = |polynomial: &Polynomial| {
            let term = |(factors, mut value): (Vec<(u32, u32)>, Rational)| {
                let mut left = Vec::new();
                for (variable, power) in factors {
                    let symbol = (variable as usize).checked_sub(dim).and_then(|i| symbols.get(i));
                    match symbol.map(|symbol| &symbol.expr) {
                        Some(ParameterExpr::Rational(own)) => {
                            value = (0..power).fold(value, |value, _| value * own);
                        }
                        _ => left.push((variable, power)),
                    }
                }
                (left, value)
            };
            let terms: Vec<_> = polynomial.factors().map(term).collect();
            Polynomial::from_factors(polynomial.variables(), terms)
        };
        let comoving = self.comoving.as_ref().map(|frame| Frame {
            spin: put_in(&frame.spin),
            casimirs: put_in(&frame.casimirs),
            rest: put_in(&frame.rest),
        });
        let (hamiltonian, parameters) = (put_in(&self.hamiltonian), Vec::new());
        Self { hamiltonian, symbols, parameters, comoving, ..self.clone() }
    }

    /// The name of the frame in which S generates the motion, `fixed` or `comoving`.
    pub fn frame_name(&self) -> &'static str {
        if self.comoving.is_some() { "comoving" } else { "fixed" }
    }

    /// The solver asked for, or the default for the dimension.
    pub fn solver(&self) -> Solver {
        self.solver.unwrap_or(Solver::of_dimension(self.algebra.dim()))
    }
}

impl Problem {
    /// True if H_red is of degree two or less in the momenta.
    pub fn is_quadratic(&self) -> bool {
        let dim = self.algebra.dim();
        let degree = |factors: &[(u32, u32)]| {
            let momenta = factors.iter().filter(|(variable, _)| (*variable as usize) < dim);
            momenta.map(|(_, power)| power).sum::<u32>()
        };
        self.hamiltonian.factors().all(|(factors, _)| degree(&factors) <= 2)
    }
}
