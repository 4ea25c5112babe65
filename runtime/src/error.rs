//! Errors of a step.

use core::fmt;

/// Errors of making a step. The state is left as it was.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StepError {
    /// The equation J_L(∂S/∂p(p), p) = μ was not solved to the tolerance.
    #[error(
        "the step did not converge: {} after {iterations} iterations; {at}",
        Known(*residual, format_args!("relative residual {residual:.1e}"), "the residual is not finite")
    )]
    NotConverged {
        /// Newton iterations, or evaluations of the fixed point.
        iterations: u32,
        /// The largest remaining residual, relative to the largest momentum coordinate.
        residual: f64,
        /// The circumstances of the step.
        at: Circumstances,
    },
    /// The solution of x = s ∂S/∂p could not be followed from s = 0, the identity, to s = 1.
    #[error(
        "no step is connected with the identity: the solution of x = s ∂S/∂p was followed up to s = {reached:.3} only; {at}"
    )]
    NotFollowed {
        /// The s that the continuation reached.
        reached: f64,
        /// The circumstances of the step.
        at: Circumstances,
    },
    /// The step lies outside the chart.
    #[error(
        "the step leaves the chart: {}; {at}",
        Known(
            *extent,
            format_args!("it is {:.2} times as long as the chart reaches", Short(*extent)),
            "its length is not finite"
        )
    )]
    OutsideChart {
        /// The length of x as a multiple of the chart's reach: the square root of
        /// [`Chart::extent`](crate::chart::Chart::extent).
        extent: f64,
        /// The circumstances of the step.
        at: Circumstances,
    },
    /// The series of the generating function has stopped to converge at this momentum.
    #[error(
        "the series means nothing for so long a step: {}; {at}",
        Known(
            at.ratio,
            format_args!("its terms have the ratio {:.2}, and at most 0.5 is accepted", Short(at.ratio)),
            "its terms are not finite"
        )
    )]
    SeriesDiverges {
        /// The circumstances of the step.
        at: Circumstances,
    },
    /// The velocity of a step of collocation varies too much for its nodes.
    #[error(
        "the step is too long for its nodes: {} of the velocity or the force is not resolved, and at most {limit:.0e} is accepted; {at}",
        Known(*tail, format_args!("{tail:.1e}"), "an unknown share")
    )]
    Unresolved {
        /// The share of the highest polynomial in the velocity, or that in the force relative to the momentum; with one
        /// node an estimate of the error.
        tail: f64,
        /// The largest share that is accepted.
        limit: f64,
        /// The circumstances of the step.
        at: Circumstances,
    },
    /// The energy, its gradient or a torque is not finite at a momentum that the step needs: outside the domain of a function, or at
    /// a pole.
    #[error("an expression is not defined at time {}: {expression} {}{}", Short(*time), Of(*argument), Hint(at))]
    Undefined {
        /// The expression as the Hamiltonian or the torque has it.
        expression: &'static str,
        /// The value its function is given; NaN where it is not known.
        argument: f64,
        /// The time.
        time: f64,
        /// The circumstances of the step; none where the energy or the torque is not defined in the state that the step starts from.
        at: Option<Circumstances>,
    },
    /// A coordinate of the momentum is infinite or not a number.
    #[error("the state is not finite: a coordinate of the momentum is NaN or infinite")]
    NonFiniteState,
    /// The group element is not on the group, or not finite, or would be after the step.
    #[error(
        "the group element is off the group by {defect:.1e} (NaN: not finite): start from one that is on it"
    )]
    OffGroup {
        /// [`LieGroup::element_defect`](crate::LieGroup::element_defect).
        defect: f64,
    },
    /// The state after the step is too large for its number type.
    #[error(
        "the state after the step is not finite: a coordinate of the momentum is too large for its number type"
    )]
    Overflow,
    /// The step size is zero, infinite or not a number.
    #[error("step size {} is not usable: give a finite step other than zero", Short(*step))]
    InvalidStep {
        /// The step size given.
        step: f64,
    },
    /// A parameter, or an expression in the parameters, is infinite, not a number, or a rate of damping below 0.
    #[error("coefficient {name} is {}: {}", Short(*value), match value.is_finite() {
        true => "damping must not be negative, or the energy would rise",
        false => "every parameter expression must be finite",
    })]
    InvalidParameter {
        /// The expression, as written in the Hamiltonian.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}

/// A number as a decimal fraction, or with an exponent where that would have many zeros.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            size if size > 0.0 && !(1e-7..1e9).contains(&size) => fmt::LowerExp::fmt(&self.0, f),
            _ => fmt::Display::fmt(&self.0, f),
        }
    }
}

/// A number in words, or other words where it is not finite.
struct Known<'a>(f64, fmt::Arguments<'a>, &'static str);

impl fmt::Display for Known<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.is_finite() {
            true => f.write_fmt(self.1),
            false => f.write_str(self.2),
        }
    }
}

/// The argument of an expression that is not defined, where it is known.
struct Of(f64);

impl fmt::Display for Of {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.is_nan() {
            true => f.write_str("is not finite"),
            false => write!(f, "of {}", Short(self.0)),
        }
    }
}

/// The circumstances of a step that was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circumstances {
    /// The largest coordinate of the x that was found; it solves nothing where the step did not converge.
    pub x: f64,
    /// The ratio of the last two terms of the series at the momentum, or what stands for it where the series has few
    /// terms; zero where S is no series.
    pub ratio: f64,
    /// A step size that was tried here and works, where one was looked for.
    pub usable_step: Option<f64>,
}

impl fmt::Display for Circumstances {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", Known(self.x, format_args!("|x| = {:.1e}", self.x), "|x| is not finite"))?;
        if self.ratio > 0.0 && self.ratio.is_finite() {
            write!(f, ", last terms of the series in the ratio {:.1e}", self.ratio)?;
        }
        match self.usable_step {
            Some(step) => write!(f, "; a step of {} works here", Short(step)),
            None => f.write_str("; take a smaller step"),
        }
    }
}

/// The circumstances of a step, after what went wrong at one of its nodes.
struct Hint<'a>(&'a Option<Circumstances>);

impl fmt::Display for Hint<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.as_ref().map_or(Ok(()), |at| write!(f, "; {at}"))
    }
}

impl StepError {
    /// True if a smaller step may work where this one failed.
    #[must_use]
    pub fn asks_for_smaller_step(&self) -> bool {
        self.circumstances().is_some()
    }

    /// Adds a step size that was tried and works.
    #[must_use]
    pub fn with_usable_step(mut self, step: f64) -> Self {
        match &mut self {
            Self::NotConverged { at, .. }
            | Self::NotFollowed { at, .. }
            | Self::OutsideChart { at, .. }
            | Self::SeriesDiverges { at }
            | Self::Unresolved { at, .. }
            | Self::Undefined { at: Some(at), .. } => at.usable_step = Some(step),
            _ => {}
        }
        self
    }

    /// The circumstances of the step, where the error is of the step and not of its data.
    #[must_use]
    pub fn circumstances(&self) -> Option<&Circumstances> {
        match self {
            Self::NotConverged { at, .. }
            | Self::NotFollowed { at, .. }
            | Self::OutsideChart { at, .. }
            | Self::SeriesDiverges { at }
            | Self::Unresolved { at, .. } => Some(at),
            Self::Undefined { at, .. } => at.as_ref(),
            _ => None,
        }
    }
}

/// The error that stopped a run of several steps. The state is the one after the last accepted step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("after {steps} steps: {error}")]
pub struct Stopped {
    /// Steps made.
    pub steps: u64,
    /// The error of the next step.
    pub error: StepError,
}

impl From<Stopped> for StepError {
    fn from(stopped: Stopped) -> Self {
        stopped.error
    }
}
