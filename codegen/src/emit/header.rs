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

/// The text on one line, fit for a doc comment.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('`', "'")
}
