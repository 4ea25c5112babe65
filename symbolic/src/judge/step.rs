//! One step to be judged.

use nalgebra::DMatrix;

use super::domain::{Inside, inside};
use super::gauss::Stage;
use super::geometry::Geometry;
use super::linear::{Real, SPACING, column, derivative, doubles, exact, norm, spectral};
use super::series::Folded;
use super::{DoubleDouble, JudgeError};
use crate::lie::Chart;

/// S and the motion of the frame, folded for momenta in units of 2^scale.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    pub(super) series: Folded,
    /// Part by part: y is the gradient.
    pub(super) frame: Vec<Folded>,
    pub(super) scale: i64,
}

/// The equation of a step, whose unknowns are equal to a right side that depends on them.
#[derive(Clone, Debug)]
pub(super) enum Equation<'a> {
    /// x = ∂S(p̂(x)).
    Series(&'a Scaled),
    /// The rates at the nodes.
    Collocation(Stage<'a>),
}

/// One step from a momentum μ. Inside, momenta are counted in units of a power of two near |μ|.
#[derive(Debug)]
pub struct Step<'a> {
    pub(super) geometry: &'a Geometry,
    pub(super) equation: Equation<'a>,
    pub(super) scale: i64,
    pub(super) momentum: DMatrix<DoubleDouble>,
    /// The momentum in double precision.
    pub(super) double: DMatrix<f64>,
}

/// The right solution in doubled precision.
#[derive(Clone, Debug)]
pub struct RightSolution {
    /// The unknowns, one column: x, or the rates of a step by collocation.
    pub x: DMatrix<DoubleDouble>,
    /// The norm of the inverse of 1 less the derivative of the right side: how much a residual moves x.
    pub response: f64,
}

/// The state after the right solution.
#[derive(Clone, Debug)]
pub struct End {
    /// The momentum after the step, one column, in units of 2^scale.
    pub momentum: DMatrix<DoubleDouble>,
    /// The exponent of the momentum's unit.
    pub scale: i64,
    /// τ(x)·exp(y)…, by which the group element moves.
    pub element: DMatrix<DoubleDouble>,
    /// The bound on |μ″ − exact|, in the same units: 16 n u of what is computed and twice what the residual's
    /// bound may move x by.
    pub momentum_bound: f64,
    /// The bound on the change of the group element, relative to ‖g‖.
    pub element_bound: f64,
    /// The factor by which an error of the momentum before the step grows at most, to first order.
    pub growth: f64,
}

impl Step<'_> {
    /// μ in the units of this step.
    pub fn momentum(&self) -> &[DoubleDouble] {
        self.momentum.as_slice()
    }

    /// The increment x of the group that a solution has.
    pub fn increment(&self, right: &RightSolution) -> DMatrix<DoubleDouble> {
        match &self.equation {
            Equation::Series(_) => right.x.clone(),
            Equation::Collocation(stage) => stage.increment(&right.x),
        }
    }

    /// The verdict on x as an element of the chart's domain.
    pub fn inside(&self, x: &[f64]) -> Inside {
        inside(self.geometry, &column(x.iter().copied()))
    }

    /// True if the Hamiltonian is defined at the start of the step.
    pub(super) fn is_defined(&self) -> bool {
        match &self.equation {
            Equation::Series(_) => true,
            Equation::Collocation(stage) => stage.is_defined(&self.momentum),
        }
    }

    /// The number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        match &self.equation {
            Equation::Series(_) => self.geometry.dim,
            Equation::Collocation(stage) => stage.unknowns(self.geometry),
        }
    }

    /// The right side of the equation.
    pub(super) fn right_side<T: Real>(&self, x: &DMatrix<T>) -> Result<DMatrix<T>, JudgeError> {
        let mu = self.momentum.map(T::of);
        match &self.equation {
            Equation::Series(scaled) => {
                let p = self.geometry.pull_back(self.geometry.chart, x, &mu)?;
                Ok(scaled.series.gradient(&p))
            }
            Equation::Collocation(stage) => stage.rates(self.geometry, &mu, x, 0.0),
        }
    }

    /// The derivative of the right side, whose value is `here`.
    pub(super) fn slope(
        &self,
        x: &DMatrix<f64>,
        here: &DMatrix<f64>,
    ) -> Result<DMatrix<f64>, JudgeError> {
        // Charts bend over lengths of 1/‖ad‖.
        let spacing = SPACING / self.geometry.bracket_norm.max(1.0);
        match &self.equation {
            Equation::Series(_) => derivative(x, here, spacing, |x| self.right_side(x)),
            Equation::Collocation(stage) => stage.slope(self.geometry, &self.double, x, spacing),
        }
    }

    /// The residual of the equation at x, computed in doubled precision.
    pub(super) fn defect(&self, x: &DMatrix<DoubleDouble>) -> Result<DMatrix<f64>, JudgeError> {
        Ok(doubles(&(x - self.right_side(x)?)))
    }

    /// The length of the longest part of μ in a direct factor of the group, in units that are comparable.
    pub(super) fn largest_factor(&self) -> f64 {
        let units = self.geometry.units.iter();
        let sizes: Vec<f64> = self.double.iter().zip(units).map(|(mu, unit)| mu * unit).collect();
        let parts = self.geometry.factors.chunk_by(|a, b| a == b).scan(0, |start, factor| {
            *start += factor.len();
            Some(norm(&sizes[*start - factor.len()..*start]))
        });
        parts.fold(0.0, f64::max)
    }

    /// The bound on the residual at x, and by how much the right side changes with μ at most. The rounding of a gradient is
    /// measured: by the right side in double precision with all numbers off by four roundings.
    pub(super) fn bound(&self, x: &DMatrix<f64>, unit: f64) -> Result<(f64, f64), JudgeError> {
        let (mu, rounding) = (&self.double, 16.0 * unit);
        let n = self.geometry.dim as f64;
        match &self.equation {
            Equation::Series(scaled) => {
                let p = self.geometry.pull_back(self.geometry.chart, x, mu)?;
                let hessian = scaled.series.hessian(&p);
                let [_, slope] = self.geometry.sensitivity(self.geometry.chart, x)?;
                let sizes = norm(x) + scaled.series.terms(&p) + hessian * (norm(&p) + norm(mu));
                // The spacing of numbers near zero for this unit roundoff.
                let unscaled = DoubleDouble::from(hessian).scaled(-self.scale).to_f64();
                let spaced = 16.0 * n * spacing(unit) * (1.0 + unscaled);
                Ok((rounding * n * sizes + spaced, hessian * (1.0 + slope)))
            }
            Equation::Collocation(stage) => {
                let here = stage.rates(self.geometry, &self.momentum, &exact(x), 0.0)?;
                let off = stage.rates(self.geometry, mu, x, 4.0 * unit)? - doubles(&here);
                let rates = |mu: &DMatrix<f64>| stage.rates(self.geometry, mu, x, 0.0);
                let influence = derivative(mu, &rates(mu)?, SPACING, rates)?;
                Ok((rounding * n * norm(x) + 16.0 * norm(&off), spectral(&influence)))
            }
        }
    }

    /// The state after the right solution, motions of the frame included.
    ///
    /// # Errors
    /// Returns [`JudgeError::OutOfRange`] if numbers leave their range.
    pub fn end(&self, right: &RightSolution, unit: f64) -> Result<End, JudgeError> {
        let (geometry, chart) = (self.geometry, self.geometry.chart);
        let exact_x = self.increment(right);
        let x = doubles(&exact_x);
        let p = geometry.pull_back(chart, &exact_x, &self.momentum)?;
        let mut momentum = geometry.transport(chart, &exact_x, &self.momentum, &p);
        let mut element = geometry.element(chart, &exact_x)?;
        let [turn, slope] = geometry.sensitivity(chart, &x)?;
        let (a, b, mu) = (geometry.bracket_norm, geometry.basis_norm, norm(&self.double));
        let (bound, influence) = self.bound(&doubles(&right.x), unit)?;
        let moved = 2.0 * right.response * bound;
        let n = geometry.dim as f64;
        let rounding = 16.0 * n * unit;
        let mut momentum_bound = turn * mu * (rounding * (1.0 + norm(&x)) + a * slope * moved);
        let least = DoubleDouble::from(spacing(unit)).scaled(-self.scale).to_f64();
        momentum_bound += 16.0 * n * least * (1.0 + turn);
        let mut length = norm(&element);
        let mut element_bound = length * (rounding * (1.0 + norm(&x)) + b * slope * moved);
        let mut growth = turn * (1.0 + a * slope * mu * right.response * influence);
        let frame = match &self.equation {
            Equation::Series(scaled) => &scaled.frame[..],
            Equation::Collocation(_) => &[],
        };
        for part in frame {
            let y = part.gradient(&momentum);
            let (short, at) = (doubles(&y), doubles(&momentum));
            let [turn, slope] = geometry.sensitivity(Chart::Exponential, &short)?;
            let hessian = part.hessian(&at);
            let p = geometry.pull_back(Chart::Exponential, &y, &momentum)?;
            momentum = geometry.transport(Chart::Exponential, &y, &momentum, &p);
            let moved = rounding * part.terms(&at) + hessian * momentum_bound;
            let rounded = rounding * (1.0 + norm(&short));
            momentum_bound = turn * (momentum_bound + norm(&at) * (rounded + a * slope * moved));
            growth *= turn * (1.0 + a * slope * norm(&at) * hessian);
            let turned = geometry.element(Chart::Exponential, &y)?;
            element_bound =
                norm(&turned) * (element_bound + length * (rounded + b * slope * moved));
            element *= turned;
            length = norm(&element);
        }
        Ok(End { momentum, scale: self.scale, element, momentum_bound, element_bound, growth })
    }
}

/// The spacing of numbers below the smallest normal one.
fn spacing(unit: f64) -> f64 {
    f64::from_bits(if unit > 1e-10 { (1023 - 149) << 52 } else { 1 })
}

/// a / b; infinite where that is no number.
pub(super) fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 {
        return 0.0;
    }
    let ratio = a / b;
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}
