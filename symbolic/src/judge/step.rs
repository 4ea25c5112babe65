//! One step to be judged.

use nalgebra::DMatrix;

use super::domain::{Inside, inside};
use super::geometry::Geometry;
use super::linear::{column, doubles, maximum, norm};
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

/// One step from a momentum μ. Inside, momenta are counted in units of a power of two near |μ|.
#[derive(Debug)]
pub struct Step<'a> {
    pub(super) geometry: &'a Geometry,
    pub(super) folded: &'a Scaled,
    pub(super) momentum: DMatrix<DoubleDouble>,
    /// The same in double precision.
    pub(super) double: DMatrix<f64>,
}

/// The right solution in doubled precision.
#[derive(Clone, Debug)]
pub struct RightSolution {
    /// x, one column.
    pub x: DMatrix<DoubleDouble>,
    /// ‖(1 − Hess S·∂p̂/∂x)⁻¹‖, Frobenius' norm: how much a residual moves x.
    pub response: f64,
}

/// Where the right solution leads.
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
    /// By how much an error of the momentum before the step grows at most, to first order.
    pub growth: f64,
}

impl Step<'_> {
    /// μ in the units of this step.
    #[must_use]
    pub fn momentum(&self) -> &[DoubleDouble] {
        self.momentum.as_slice()
    }

    /// Whether x is inside the chart.
    #[must_use]
    pub fn inside(&self, x: &[f64]) -> Inside {
        inside(self.geometry, &column(x.iter().copied()))
    }

    /// p̂(x), and x − ∂S(p̂(x)) computed in doubled precision.
    pub(super) fn defect(
        &self,
        x: &DMatrix<DoubleDouble>,
    ) -> Result<(DMatrix<DoubleDouble>, DMatrix<f64>), JudgeError> {
        let p = self.geometry.pull_back(self.geometry.chart, x, &self.momentum)?;
        let defect = doubles(&(x - self.folded.series.gradient(&p)));
        Ok((p, defect))
    }

    /// The length of the longest part of μ in a direct factor of the group.
    pub(super) fn largest_factor(&self) -> f64 {
        let parts = self.geometry.factors.chunk_by(|a, b| a == b).scan(0, |start, factor| {
            *start += factor.len();
            Some(norm(&self.double.as_slice()[*start - factor.len()..*start]))
        });
        parts.fold(0.0, f64::max)
    }

    /// The bound on the residual at x, where p̂ is known; and ‖Hess S‖ there.
    pub(super) fn bound(&self, x: &DMatrix<f64>, p: &DMatrix<f64>, unit: f64) -> (f64, f64) {
        let (series, n) = (&self.folded.series, self.geometry.dim as f64);
        let hessian = hessian_norm(series, p);
        let sizes = norm(x) + series.terms(p) + hessian * (norm(p) + norm(&self.double));
        (16.0 * n * unit * sizes + self.spaced(hessian, unit), hessian)
    }

    /// The error of x = ∂S(p̂) where numbers near zero are as far apart as with this unit roundoff.
    pub(super) fn spaced(&self, hessian: f64, unit: f64) -> f64 {
        let unscaled = DoubleDouble::from(hessian).scaled(-self.folded.scale).to_f64();
        16.0 * self.geometry.dim as f64 * spacing(unit) * (1.0 + unscaled)
    }

    /// Where the right solution leads, frame motions included.
    ///
    /// # Errors
    /// [`JudgeError::OutOfRange`].
    pub fn end(&self, right: &RightSolution, unit: f64) -> Result<End, JudgeError> {
        let (geometry, chart) = (self.geometry, self.geometry.chart);
        let x = doubles(&right.x);
        let p = geometry.pull_back(chart, &right.x, &self.momentum)?;
        let mut momentum = geometry.transport(chart, &right.x, &self.momentum, &p);
        let mut element = geometry.element(chart, &right.x)?;
        let (turn, slope) = geometry.sensitivity(chart, &x)?;
        let (a, b, mu) = (geometry.bracket_norm, geometry.basis_norm, norm(&self.double));
        let (bound, hessian) = self.bound(&x, &doubles(&p), unit);
        let moved = 2.0 * right.response * bound;
        let n = geometry.dim as f64;
        let rounding = 16.0 * n * unit;
        let mut momentum_bound = turn * mu * (rounding * (1.0 + norm(&x)) + a * slope * moved);
        let least = DoubleDouble::from(spacing(unit)).scaled(-self.folded.scale).to_f64();
        momentum_bound += 16.0 * n * least * (1.0 + turn);
        let mut length = norm(&element);
        let mut element_bound = length * (rounding * (1.0 + norm(&x)) + b * slope * moved);
        let mut growth = turn * (1.0 + a * slope * mu * right.response * hessian * (1.0 + slope));
        for part in &self.folded.frame {
            let y = part.gradient(&momentum);
            let (short, at) = (doubles(&y), doubles(&momentum));
            let (turn, slope) = geometry.sensitivity(Chart::Exponential, &short)?;
            let hessian = norm(&part.derivatives(&at).1);
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
        let scale = self.folded.scale;
        Ok(End { momentum, scale, element, momentum_bound, element_bound, growth })
    }
}

/// ‖Hess S‖ at p, the smaller of Frobenius' norm and the row sum: both bound the spectral norm.
pub(super) fn hessian_norm(series: &Folded, p: &DMatrix<f64>) -> f64 {
    let (_, hessian) = series.derivatives(p);
    let rows = hessian.row_iter().map(|row| row.iter().map(|h| h.abs()).sum::<f64>());
    let (rows, whole) = (rows.fold(0.0, maximum), norm(&hessian));
    if rows < whole { rows } else { whole }
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
