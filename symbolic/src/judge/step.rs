//! One step to be judged.

use super::domain::{Inside, inside};
use super::geometry::{Geometry, size};
use super::linear::multiply;
use super::norm::norm;
use super::series::Folded;
use super::{DoubleDouble, JudgeError};

/// S folded, and the bounds of its derivatives by degree.
#[derive(Clone, Debug)]
pub(super) struct Scaled {
    pub(super) series: Folded,
    pub(super) growth: Vec<(u32, f64, f64)>,
    /// The motion of the frame, part by part: y is the gradient.
    pub(super) frame: Vec<Folded>,
    pub(super) scale: i64,
}

impl Scaled {
    pub(super) fn derivatives(&self, p: &[f64]) -> super::series::Derivatives<f64> {
        self.series.derivatives(p)
    }
}

/// One step from a momentum μ. Inside, momenta are counted in units of a power of two near |μ|.
#[derive(Debug)]
pub struct Step<'a> {
    pub(super) geometry: &'a Geometry,
    pub(super) folded: &'a Scaled,
    pub(super) momentum: Vec<DoubleDouble>,
    pub(super) double: Vec<f64>,
}

/// The right solution in doubled precision.
#[derive(Clone, Debug)]
pub struct RightSolution {
    /// x.
    pub x: Vec<DoubleDouble>,
    /// ‖(1 − Hess S·∂p̂/∂x)⁻¹‖, Frobenius' norm: how much a residual moves x.
    pub response: f64,
}

/// Where the right solution leads.
#[derive(Clone, Debug)]
pub struct End {
    /// The momentum after the step, in units of 2^scale.
    pub momentum: Vec<DoubleDouble>,
    /// The exponent of the momentum's unit.
    pub scale: i64,
    /// τ(x)·exp(y)…, by which the group element moves: its matrix, row by row.
    pub element: Vec<DoubleDouble>,
    /// The bound on |μ″ − exact|, in the same units: 16 n u of what is computed and twice what the residual's
    /// bound may move x by.
    pub momentum_bound: f64,
    /// The bound on the change of the group element, relative to ‖g‖.
    pub element_bound: f64,
    /// By how much an error of the momentum before the step grows at most, to first order.
    pub growth: f64,
}

impl Step<'_> {
    /// μ in the units of this step, and their exponent.
    #[must_use]
    pub fn momentum(&self) -> (&[DoubleDouble], i64) {
        (&self.momentum, self.folded.scale)
    }

    /// p̂ = (d^R τ_x)ᵀ μ, in units of 2^scale.
    ///
    /// # Errors
    /// [`JudgeError::OutOfRange`] where x is too large, [`JudgeError::NotFinite`], [`JudgeError::Length`].
    pub fn pull_back(&self, x: &[f64]) -> Result<Vec<DoubleDouble>, JudgeError> {
        self.check(x)?;
        let x: Vec<_> = x.iter().map(|&x| DoubleDouble::from(x)).collect();
        self.geometry.pull_back(&x, &self.momentum)
    }

    pub(super) fn check(&self, x: &[f64]) -> Result<(), JudgeError> {
        if x.len() != self.geometry.dim {
            let (found, expected) = (x.len(), self.geometry.dim);
            return Err(JudgeError::Length { what: "x", found, expected });
        }
        if !size(x).is_finite() {
            return Err(JudgeError::NotFinite { what: "x" });
        }
        Ok(())
    }

    /// Whether x is inside the chart.
    #[must_use]
    pub fn inside(&self, x: &[f64]) -> Inside {
        inside(self.geometry, x)
    }

    /// The length of the longest part of μ in a direct factor of the group.
    pub(super) fn largest_factor(&self) -> f64 {
        let parts = self.geometry.factors.chunk_by(|a, b| a == b).scan(0, |start, factor| {
            *start += factor.len();
            Some(norm(&self.double[*start - factor.len()..*start]))
        });
        parts.fold(0.0, f64::max)
    }

    /// The bound on the residual at x, where p̂ and the terms of ∂S there are known; and ‖Hess S‖ there.
    pub(super) fn bound(&self, x: &[f64], p: &[f64], terms: &[f64], unit: f64) -> (f64, f64) {
        let hessian = self.hessian_norm(p);
        let momenta = norm(p) + norm(&self.double);
        let n = x.len() as f64;
        let bound = 16.0 * n * unit * (norm(x) + norm(terms) + hessian * momenta)
            + self.spaced(x.len(), hessian, spacing(unit));
        (bound, hessian)
    }

    /// The error of x = ∂S(p̂) where numbers near zero are spaced this far apart.
    pub(super) fn spaced(&self, n: usize, hessian: f64, spacing: f64) -> f64 {
        let unscaled = DoubleDouble::from(hessian).scaled(-self.folded.scale).to_f64();
        16.0 * n as f64 * spacing * (1.0 + unscaled)
    }

    /// Where the right solution leads, frame motions included.
    ///
    /// # Errors
    /// [`JudgeError::OutOfRange`].
    pub fn end(&self, right: &RightSolution, unit: f64) -> Result<End, JudgeError> {
        let (geometry, n) = (self.geometry, self.geometry.dim as f64);
        let x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
        let p = geometry.pull_back(&right.x, &self.momentum)?;
        let mut momentum = geometry.transport(&right.x, &self.momentum, &p)?;
        let mut element = geometry.element(&right.x)?;
        let p64: Vec<f64> = p.iter().map(|p| p.to_f64()).collect();
        let (turn, slope) = geometry.sensitivity(&x)?;
        let (a, mu) = (geometry.bracket_norm, norm(&self.double));
        let (terms, _) = self.folded.series.absolute(&p64);
        let (bound, hessian) = self.bound(&x, &p64, &terms, unit);
        let moved = 2.0 * right.response * bound;
        let rounding = 16.0 * n * unit;
        let mut momentum_bound = turn * mu * (rounding * (1.0 + norm(&x)) + a * slope * moved);
        let least = DoubleDouble::from(spacing(unit)).scaled(-self.folded.scale).to_f64();
        momentum_bound += 16.0 * n * least * (1.0 + turn);
        let mut length = norm_of(&element);
        let mut element_bound =
            length * (rounding * (1.0 + norm(&x)) + geometry.basis_norm * slope * moved);
        let mut growth = turn * (1.0 + a * slope * mu * right.response * hessian * (1.0 + slope));
        for part in &self.folded.frame {
            let y = part.gradient(&momentum);
            let short: Vec<f64> = y.iter().map(|y| y.to_f64()).collect();
            let at: Vec<f64> = momentum.iter().map(|m| m.to_f64()).collect();
            let (turn, slope) = geometry.exp_sensitivity(&short)?;
            let (_, hessian) = part.derivatives(&at);
            let next = geometry.exp_transport(&y, &momentum)?;
            let terms = norm(&part.absolute(&at).0);
            let moved = rounding * terms + norm(&hessian) * momentum_bound;
            momentum_bound = turn
                * (momentum_bound
                    + norm(&at) * (rounding * (1.0 + norm(&short)) + a * slope * moved));
            growth *= turn * (1.0 + a * slope * norm(&at) * norm(&hessian));
            let turned = geometry.exponential_matrix(&y)?;
            let factor = norm_of(&turned);
            element_bound = factor
                * (element_bound
                    + length
                        * (rounding * (1.0 + norm(&short)) + geometry.basis_norm * slope * moved));
            element = multiply(geometry.size, &element, &turned);
            length = norm_of(&element);
            momentum = next;
        }
        let scale = self.folded.scale;
        Ok(End { momentum, scale, element, momentum_bound, element_bound, growth })
    }
}

/// The spacing of numbers below the smallest normal one.
pub(super) fn spacing(unit: f64) -> f64 {
    f64::from_bits(if unit > 1e-10 { (1023 - 149) << 52 } else { 1 })
}

fn norm_of(matrix: &[DoubleDouble]) -> f64 {
    norm(&matrix.iter().map(|m| m.to_f64()).collect::<Vec<_>>())
}
