//! The implementations of `coadjoint::GeneratingFunction` and of `Integrator`.

use coadjoint_program::print::{Value, fill, tuple};

use super::program::{Rust, list};
use crate::emit::Options;
use crate::emit::group::Types;
use crate::emit::programs::functions;
use crate::graph::Program;
use crate::integrator::{FoldTable, Integrator, Predictor};
use crate::problem::Solver;
use crate::step::Step;

/// `impl GeneratingFunction for name`; `slots` is the number of coefficients.
pub(crate) fn generating_function(
    integrator: &Integrator,
    options: &Options,
    types: &Types,
    slots: usize,
) -> String {
    let vector = &types.vector;
    let hessian = |program| hessian_function(program, types, options);
    let frame = integrator.frame.iter().enumerate().map(|(part, program)| {
        let function = vector_function(program, vector, options, "mu");
        format!("{part}usize => ::core::option::Option::Some({{ {function} }}),\n")
    });
    let radius_at = FoldTable::radius_at(integrator);
    let judged = slots > radius_at + 1;
    let rate = integrator.largest_rate.map(|rate| format!("{rate}f64"));
    let mut values = types.values();
    values.extend([
        ("VALUE", scalar_function(&integrator.value, options, "p")),
        ("GRADIENT", vector_function(&integrator.gradient, vector, options, "p")),
        ("HESSIAN", integrator.hessian.as_ref().map_or_else(String::new, hessian)),
        ("FRAME", frame.collect()),
        ("JUDGED", judged.to_string()),
        ("RADIUS", radius_at.to_string()),
        ("LAST", (radius_at + 1).to_string()),
        ("UNIT", unit(&integrator.units)),
        ("RATE", rate.unwrap_or_default()),
    ]);
    options.fill(include_str!("generating_function.in"), &values)
}

/// `impl Integrator`: by the programs of a step, or, where these are too long to be printed, by the predictor.
pub(crate) fn integrator(
    integrator: &Integrator,
    step: Option<&Step>,
    options: &Options,
    types: &Types,
) -> String {
    let mut values: Vec<Value> = types.values();
    let solver = integrator.problem.solver();
    if solver != Solver::of_dimension(integrator.problem.algebra.dim()) {
        values.push(("SOLVER", format!("{solver:?}")));
    }
    match step {
        Some(step) => values.push(("FUNCTIONS", functions(step, options))),
        None => {
            let guess = vector_function(&integrator.predictor, &types.vector, options, "mu");
            values.push(("GUESS", guess));
        }
    }
    if let Predictor::Flow(_) = integrator.plan.predictor {
        values.push(("FLOW", "1".to_owned()));
    }
    options.fill(include_str!("integrator.in"), &values)
}

/// The body of a function with one output; it reads `input` and `c`.
pub(crate) fn scalar_function(program: &Program, options: &Options, input: &str) -> String {
    Rust::alone(options.suffix).block(program, input, tuple)
}

/// The body of a function with as many outputs as `vector` has entries.
pub(crate) fn vector_function(
    program: &Program,
    vector: &str,
    options: &Options,
    input: &str,
) -> String {
    let result = |outputs: &[String]| format!("<{vector} as From<_>>::from({})", list(outputs));
    Rust::alone(options.suffix).block(program, input, result)
}

fn hessian_function(program: &Program, types: &Types, options: &Options) -> String {
    let Types { dim, vector, matrix, .. } = types;
    let dim = *dim;
    Rust::alone(options.suffix).block(program, "p", |outputs| {
        let (gradient, triangle) = outputs.split_at(dim.min(outputs.len()));
        // Entry (i, j) of an upper triangle, row by row.
        let entry = |i: usize, j: usize| triangle.get(i * dim - i * (i + 1) / 2 + j);
        let column = |j: usize| list((0..dim).filter_map(|i| entry(i.min(j), i.max(j))));
        let columns: Vec<String> = (0..dim).map(column).collect();
        format!("(<{vector}>::from({}), <{matrix}>::from({}))", list(gradient), list(&columns))
    })
}

/// The method that gives the factors of coordinates where sizes are compared, where these are not 1.
pub(super) fn unit(units: &[f64]) -> String {
    if units.iter().all(|unit| *unit == 1.0) {
        return String::new();
    }
    let list: Vec<String> = units.iter().map(|unit| format!("{unit}f64")).collect();
    let values = [("COUNT", units.len().to_string()), ("UNITS", list.join(", "))];
    fill(include_str!("unit.in"), &values)
}
