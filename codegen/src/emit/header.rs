//! What a generated integrator says about itself.

use crate::integrator::{Integrator, Predictor};

/// Lines for a doc comment: source, group, chart, truncation, order, terms, operations.
#[must_use]
pub fn lines(integrator: &Integrator) -> Vec<String> {
    let problem = &integrator.problem;
    let terms: Vec<String> = (1..=problem.truncation)
        .step_by(2)
        .map(|k| format!("S{k}: {}", integrator.series.order(k).len()))
        .collect();
    let iteration = integrator.iteration().cost();
    let what = if integrator.hessian.is_some() { "gradient and Hessian" } else { "gradient" };
    let predictor = integrator.predictor.cost();
    let frame = problem
        .comoving
        .as_ref()
        .map(|_| " Comoving frame: S generates the motion in it.".to_owned());
    let mut lines = vec![
        format!(" Hamiltonian: `{}`", one_line(&problem.source)),
        String::new(),
        format!(
            " Group: {}. Chart {}, truncation K = {}, order of accuracy {}.",
            problem.algebra.name(),
            problem.chart,
            problem.truncation,
            integrator.order()
        ),
        format!(" Terms: {}.", terms.join(", ")),
        format!(
            " Operations: {what} {} multiplications and {} additions; predictor of degree {}{} {} \
             and {}.",
            iteration.multiplications,
            iteration.additions,
            integrator.plan.predictor.degree(),
            match integrator.plan.predictor {
                Predictor::Explicit(_) => "",
                Predictor::Flow(_) => " along the flow",
            },
            predictor.multiplications,
            predictor.additions
        ),
    ];
    lines.extend(frame);
    lines
}

/// Lines for the head of a file: by whom it is written, what the integrator says of itself, and how
/// to read what follows.
#[must_use]
pub fn file_lines(integrator: &Integrator) -> Vec<String> {
    let mut result = vec![
        format!(
            "{}: written by coadjoint {}; changes will be overwritten.",
            integrator.problem.name,
            env!("CARGO_PKG_VERSION")
        ),
        String::new(),
    ];
    result.extend(lines(integrator).into_iter().map(|line| line.trim_start().to_owned()));
    result.extend(
        [
            "",
            "Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size \
             and the",
            "parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. \
             Coordinates",
            "count from one in names and comments. Tables stand at the end.",
        ]
        .map(str::to_owned),
    );
    result
}

/// The text on one line, fit for a doc comment.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "'")
}
