//! A kernel as Rust: its programs as functions, and the loop that calls them.

use coadjoint_program::print::{Dialect, Field, signatures};
use coadjoint_program::schedule::Part;

use super::Options;
use super::program::Rust;
use super::steps::steps;
use crate::graph::Program;
use crate::step::Step;

/// Steps of more operations than this are not printed: the compiler would take minutes.
pub(crate) const MOST_OPERATIONS: usize = 20_000;

pub(crate) fn step_operations(step: &Step) -> usize {
    let programs = Part::ALL.iter().filter_map(|(part, _)| part.program(step.kernel()));
    programs.map(Program::operations).sum()
}

/// The programs of a step, and the loop that calls them, as functions.
pub(crate) fn functions(step: &Step, options: &Options) -> String {
    let dialect = Rust::new(options.suffix, step_operations(step));
    let named = |field: Field| Field { name: dialect.bound(&field.name), ..field };
    let functions = signatures(step.kernel(), "").map(|mut signature| {
        signature.inputs = signature.inputs.into_iter().map(named).collect();
        dialect.function(&signature, &dialect.body(&signature))
    });
    functions.collect::<String>() + &steps(step.kernel(), &dialect)
}
