//! Errors of a step.

/// Why a step could not be made. The state it was asked to advance is left as it was.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The equation J_L(∂S/∂p(p), p) = μ was not solved to rounding.
    #[error(
        "the step did not converge: relative residual {residual:.1e} after {iterations} Newton \
         iterations; take a smaller step"
    )]
    NotConverged {
        /// Newton iterations made.
        iterations: u32,
        /// The largest remaining residual, relative to the largest momentum coordinate.
        residual: f64,
    },
    /// The fixed point for J_L(∂S/∂p(p), p) = μ was not reached to rounding.
    #[error(
        "the fixed point did not converge: relative residual {residual:.1e} after {iterations} \
         evaluations; take a smaller step, or the solver `newton`"
    )]
    FixedPointNotConverged {
        /// Evaluations made.
        iterations: u32,
        /// The largest remaining residual, relative to the largest momentum coordinate.
        residual: f64,
    },
    /// A coordinate of the momentum or the group element is infinite or not a number.
    #[error("the state is not finite: a coordinate of the momentum is NaN or infinite")]
    NonFiniteState,
    /// The step size is zero, infinite or not a number.
    #[error("step size {step} is not usable: give a finite step other than zero")]
    InvalidStep {
        /// The step size given.
        step: f64,
    },
    /// A parameter, or an expression in the parameters, is infinite or not a number.
    #[error("coefficient {name} is {value}: every parameter expression must be finite")]
    InvalidParameter {
        /// The expression, as written in the Hamiltonian.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}
