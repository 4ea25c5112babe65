//! Judges a step by means of its own, in doubled precision.
//!
//! A step of (g, μ) is right if x, the coordinate of the group's increment, solves x = ∂S(p̂), p̂ = (d^R τ_x)ᵀ μ,
//! is the solution continued from x = s ∂S(p̂), s from 0 to 1, lies inside the chart, and moves g by τ(x) and μ by
//! Ad\*_{τ(x)⁻¹}. Everything here is computed from the exact problem, structure constants and rational S_k, and
//! shares no code with the steps it judges. A step by collocation is judged in the same way, x being the rates at
//! its nodes and ∂S∘p̂ the right side of their equations; `energy` says what its Hamiltonian is computed from.
//!
//! ```
//! use coadjoint_symbolic::hamilton_jacobi::{TermLimit, derive};
//! use coadjoint_symbolic::judge::{Branch, Judge};
//! use coadjoint_symbolic::lie::{Chart, catalogue::lookup};
//! use coadjoint_symbolic::number::ratio;
//! use coadjoint_symbolic::poly::Polynomial;
//!
//! // A rigid body, I = (1.5, 2, 2.5).
//! let square = |i: usize, d: i64| Polynomial::variable(3, i).pow(2).scale(&ratio(1, d));
//! let energy = &(&square(0, 3) + &square(1, 4)) + &square(2, 5);
//! let so3 = lookup("SO3").unwrap();
//! let series = derive(&so3, Chart::Exponential, &energy, 7, TermLimit::default()).unwrap();
//! let judge = Judge::new(&so3, &series).unwrap();
//! let mut setting = judge.at(0.2, &[]).unwrap();
//! let step = setting.step(&[2.0, 0.5, 1.0]).unwrap();
//! let right = step.right_solution().unwrap();
//! let x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
//! let point = step.at(&x).unwrap();
//! assert!(point.residual(f64::EPSILON / 2.0).relative() < 1.0);
//! assert!(matches!(point.branch().0, Branch::Right));
//! ```

// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod branch;
mod domain;
mod double_double;
mod energy;
mod error;
mod functions;
mod gauss;
mod geometry;
mod linear;
mod motion;
mod point;
mod series;
mod step;
mod wide;

pub use branch::Branch;
pub use domain::Inside;
pub use double_double::DoubleDouble;
pub use error::JudgeError;
pub use motion::{Enclosure, Stop};
pub use point::{Point, Residual};
pub use step::{End, RightSolution, Step};

use nalgebra::DMatrix;

use crate::comoving::Frame;
use crate::hamilton_jacobi::{GeneratingSeries, TermLimit, derive};
use crate::lie::{Chart, LieAlgebra};
use crate::problem::Problem;
use crate::smooth::{Hamiltonian, Smooth};
use energy::Expression;
use gauss::{Collocation, Stage};
use geometry::Geometry;
use linear::{column, size};
use series::Series;
use step::{Equation, Scaled};
use wide::exponent_of;

/// Momenta of about this many binary digits of range are counted in the same unit.
const UNITS: i64 = 32;

/// Judges the steps of one problem.
#[derive(Clone, Debug)]
pub struct Judge {
    geometry: Geometry,
    law: Definition,
}

/// The equation of the steps.
#[derive(Clone, Debug)]
enum Definition {
    /// By a series, and the motion of a comoving frame, which follows each step.
    Series(Series, Vec<Series>),
    Collocation(Box<Collocation>),
}

impl Judge {
    /// The judge of the exact series of a Hamiltonian; its variables beyond the dimension are symbols.
    ///
    /// # Errors
    /// [`JudgeError::Chart`] where the algebra has no such chart.
    pub fn new(algebra: &LieAlgebra, series: &GeneratingSeries) -> Result<Self, JudgeError> {
        Self::in_units(Geometry::new(algebra, series.chart())?, series)
    }

    fn in_units(geometry: Geometry, series: &GeneratingSeries) -> Result<Self, JudgeError> {
        let orders = (1..=series.truncation()).map(|k| (k as u32, series.order(k)));
        let law = Definition::Series(Series::new(&geometry, orders), Vec::new());
        Ok(Self { geometry, law })
    }

    /// The judge of a system as its Hamiltonian is; a series is derived within this limit.
    ///
    /// # Errors
    /// As [`Judge::of_problem`] and [`Judge::of_smooth`].
    pub fn of(hamiltonian: &Hamiltonian, limit: TermLimit) -> Result<Self, JudgeError> {
        match hamiltonian {
            Hamiltonian::Polynomial(problem, _) => Self::of_problem(problem, limit),
            Hamiltonian::Smooth(smooth) => Self::of_smooth(smooth),
        }
    }

    /// The judge of a problem that a front end has read, its comoving frame included.
    ///
    /// # Errors
    /// [`JudgeError::Derive`] where the series cannot be derived.
    pub fn of_problem(problem: &Problem, limit: TermLimit) -> Result<Self, JudgeError> {
        let (algebra, chart) = (&problem.algebra, problem.chart);
        let series = derive(algebra, chart, problem.generated(), problem.truncation, limit)?;
        let mut geometry = Geometry::new(algebra, chart)?;
        geometry.units = problem.units();
        let mut judge = Self::in_units(geometry, &series)?;
        if let Definition::Series(_, frame) = &mut judge.law {
            let parts = problem.comoving.iter().flat_map(Frame::parts);
            frame.extend(parts.map(|part| Series::new(&judge.geometry, [(1, part)])));
        }
        Ok(judge)
    }

    /// For steps by collocation in the exponential chart about the middle, known by its series up to the power 2m − 2 of x with
    /// m nodes (1 with one node).
    ///
    /// # Errors
    /// [`JudgeError::Given`] where the Hamiltonian is no expression.
    pub fn of_smooth(smooth: &Smooth) -> Result<Self, JudgeError> {
        let geometry = Geometry::new(&smooth.algebra, Chart::Exponential)?;
        let nodes = smooth.nodes();
        let degree = if nodes == 1 { 1 } else { 2 * nodes - 2 };
        let collocation = Collocation::new(Expression::new(smooth)?, nodes, degree);
        let law = Definition::Collocation(Box::new(collocation.ok_or(JudgeError::OutOfRange)?));
        Ok(Self { geometry, law })
    }

    /// With a step size and the values of the symbols put in. They are taken as exact: give the doubles
    /// that the step itself computes with.
    ///
    /// # Errors
    /// [`JudgeError::NotFinite`].
    pub fn at(&self, step: f64, symbols: &[f64]) -> Result<Setting<'_>, JudgeError> {
        if !step.is_finite() {
            return Err(JudgeError::NotFinite { what: "the step size" });
        }
        if !size(symbols).is_finite() {
            return Err(JudgeError::NotFinite { what: "a parameter" });
        }
        let (symbols, time) = (symbols.to_vec(), DoubleDouble::default());
        Ok(Setting { judge: self, step, symbols, time, scaled: Vec::new() })
    }
}

/// A judge with a step size and parameters.
#[derive(Clone, Debug)]
pub struct Setting<'a> {
    judge: &'a Judge,
    step: f64,
    symbols: Vec<f64>,
    /// The time at which a step starts.
    time: DoubleDouble,
    /// The law, in each of the units that have occurred.
    scaled: Vec<Scaled>,
}

impl Setting<'_> {
    /// Steps start this number of steps after this time; at time 0 where this is not called.
    pub fn start(&mut self, time: f64, steps: u64) {
        let [time, steps, step] = [time, steps as f64, self.step].map(DoubleDouble::from);
        self.time = time + steps * step;
    }

    /// The step from a momentum.
    ///
    /// # Errors
    /// [`JudgeError::NotFinite`], [`JudgeError::Length`]; [`JudgeError::OutOfRange`] where S is.
    pub fn step(&mut self, mu: &[f64]) -> Result<Step<'_>, JudgeError> {
        self.step_from(&column(mu.iter().map(|&m| DoubleDouble::from(m))), 0)
    }

    /// The step from a momentum in units of 2^scale.
    fn step_from(
        &mut self,
        momentum: &DMatrix<DoubleDouble>,
        scale: i64,
    ) -> Result<Step<'_>, JudgeError> {
        let (judge, found) = (self.judge, momentum.nrows());
        if found != judge.geometry.dim {
            let expected = judge.geometry.dim;
            return Err(JudgeError::Length { what: "the momentum", found, expected });
        }
        let largest = size(momentum);
        if !largest.is_finite() {
            return Err(JudgeError::NotFinite { what: "the momentum" });
        }
        let exponent = if largest == 0.0 { 0 } else { exponent_of(largest) + scale };
        let (unit, equation) = match &judge.law {
            Definition::Series(series, frame) => {
                // Not so small that coefficients underflow in it.
                let unit = ((exponent + UNITS / 2).div_euclid(UNITS) * UNITS).max(-960);
                let place = self.scaled.iter().position(|scaled| scaled.scale == unit);
                let place = place.unwrap_or_else(|| {
                    let fold = |series: &Series| series.folded(self.step, &self.symbols, unit);
                    let (series, frame) = (fold(series), frame.iter().map(fold).collect());
                    self.scaled.push(Scaled { series, frame, scale: unit });
                    self.scaled.len() - 1
                });
                let folded = &self.scaled[place];
                if !folded.series.is_finite() {
                    return Err(JudgeError::OutOfRange);
                }
                (unit, Equation::Series(folded))
            }
            Definition::Collocation(collocation) => {
                let (symbols, step, scale) = (&self.symbols[..], self.step, exponent);
                let middle = self.time + DoubleDouble::from(0.5 * step);
                let stage = Stage { collocation, symbols, step, middle, scale };
                (exponent, Equation::Collocation(stage))
            }
        };
        let momentum = momentum.map(|m| m.scaled(scale - unit));
        let double = linear::doubles(&momentum);
        let step = Step { geometry: &judge.geometry, equation, scale: unit, momentum, double };
        step.is_defined().then_some(step).ok_or(JudgeError::Undefined)
    }
}
