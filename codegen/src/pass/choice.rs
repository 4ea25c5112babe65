//! The choice of integrator in the input: the keys that the attribute and system files share.

use num_integer::Integer;

use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::lie::Chart;
use crate::problem::{FrameChoice, Method, Solver};

/// The truncation where none is given: order of accuracy 8.
const DEFAULT_TRUNCATION: usize = 7;
/// The largest truncation accepted.
const MAX_TRUNCATION: usize = 63;

/// Truncation, chart, solver and frame, with the places where a group may not have them.
#[derive(Clone, Debug)]
pub(crate) struct Choice {
    /// The truncation K; `None` where the input was wrong, which has been reported.
    pub truncation: Option<usize>,
    pub chart: (Chart, Span),
    /// The solver, if one is asked for.
    pub solver: Option<Solver>,
    pub frame: (FrameChoice, Span),
    /// The method, if one is asked for, and where.
    pub method: Option<(Method, Span)>,
}

impl Default for Choice {
    fn default() -> Self {
        Self {
            truncation: Some(DEFAULT_TRUNCATION),
            chart: (Chart::default(), Span::Whole),
            solver: None,
            frame: (FrameChoice::default(), Span::Whole),
            method: None,
        }
    }
}

impl Choice {
    /// Sets the truncation, or reports why it is not usable.
    pub(crate) fn set_truncation(&mut self, k: usize, span: Span, diagnostics: &Diagnostics) {
        let checked = match k {
            0 => Err(Mistake::TruncationZero),
            k if k > MAX_TRUNCATION => Err(Mistake::TruncationLarge(k, MAX_TRUNCATION)),
            k if k.is_even() => Err(Mistake::TruncationEven(k)),
            k => Ok(k),
        };
        self.truncation = diagnostics.check(span, checked);
    }

    /// Sets the chart, the solver, the method or the frame by its name, or reports that there is none of this name.
    pub(crate) fn set_named(
        &mut self,
        key: &str,
        name: &str,
        span: Span,
        diagnostics: &Diagnostics,
    ) {
        let unknown = |of: fn(String, Option<String>) -> Mistake, names: &[&str]| {
            let near: Option<&str> = nearest(name, names.iter().copied());
            diagnostics.report(span, of(name.to_owned(), near.map(str::to_owned)));
        };
        match key {
            "chart" => match name {
                "exp" | "exponential" => self.chart = (Chart::Exponential, span),
                "cayley" => self.chart = (Chart::Cayley, span),
                _ => unknown(Mistake::UnknownChart, &["exp", "cayley"]),
            },
            "solver" => match Solver::named(name) {
                None => unknown(Mistake::UnknownSolver, &Solver::NAMES),
                solver => self.solver = solver,
            },
            "method" => match Method::named(name) {
                None => unknown(Mistake::UnknownMethod, &Method::NAMES),
                Some(method) => self.method = Some((method, span)),
            },
            _ => match FrameChoice::named(name) {
                None => unknown(Mistake::UnknownFrame, &FrameChoice::NAMES),
                Some(frame) => self.frame = (frame, span),
            },
        }
    }
}
