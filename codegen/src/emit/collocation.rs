//! Steps by collocation, for Hamiltonians that are no polynomials.

use coadjoint_program::Precision;
use coadjoint_program::print::{Dialect, Field, Signature, Value};

use super::generating_function::unit;
use super::header::Method;
use super::item::{Items, Parts, assemble, bound, printed};
use super::program::Rust;
use super::programs::functions;
use crate::drive::Drive;
use crate::emit::Options;
use crate::emit::group::Types;
use crate::graph::Program;
use crate::integrator::FoldTable;
use crate::lie::Chart;
use crate::smooth::Smooth;
use crate::step::Step;

/// The integrator of a smooth Hamiltonian as items.
#[must_use]
pub(crate) fn collocation(smooth: &Smooth, options: &Options) -> Items {
    let types = Types::new(&smooth.algebra, Chart::Exponential, options);
    let step = printed(Step::by_collocation(smooth, Precision::Double, types.elements));
    let [mu, c, time] = ["mu", "c", "time"].map(|name| options.bound(name));
    let now = if smooth.depends_on_time() { &time } else { "T::of(0.0)" };
    let parts = Parts {
        facts: smooth.facts(),
        method: Method::of_collocation(smooth),
        symbols: &smooth.symbols,
        fold: FoldTable::of_symbols(smooth.symbols.len(), None, Some),
        order: 2 * smooth.nodes(),
        about: [
            " K, as it was asked for.",
            " The coefficients of the programs below: the symbols, h, and a radius that is infinite.",
        ],
        // Steps go by those before them.
        together: "const TOGETHER: u64 = u64::MAX;",
        energy: format!("value({c}, {mu}, {now})"),
        programs: programs(smooth, options, &types, step.as_ref()),
        step,
        types,
    };
    assemble(&parts, None, None, options)
}

/// `impl Steps`: by the programs of a step, and where they refuse one by the runtime, which is given the energy.
fn programs(smooth: &Smooth, options: &Options, types: &Types, step: Option<&Step>) -> String {
    let since = options.bound("since");
    let moves = smooth.depends_on_time();
    let now = match moves {
        true => format!("{since}.0 + T::of({since}.1 as f64) * self.step"),
        false => format!("{since}.0"),
    };
    let energy = format!("{}Energy", options.name);
    let driven = smooth.drive.is_some();
    let mut values = types.values();
    values.extend([
        ("FUNCTIONS", step.map_or_else(String::new, |step| functions(step, options))),
        ("OVER", format!("{}Over", options.name)),
        ("BOUND", bound(moves).to_owned()),
        ("TIME", if moves { format!("{now},") } else { String::new() }),
        ("NODES", smooth.nodes().to_string()),
        ("SYMBOLS", smooth.symbols.len().to_string()),
        ("NOW", now),
        ("BESIDE", if driven { format!("{energy}(symbols)") } else { "()".to_owned() }),
        ("TYPE", energy),
        ("ENERGY", functions_of_energy(smooth, options, types.dim)),
        ("DOUBLES", format!("__krate::nalgebra::SVector<f64, {}>", types.dim)),
        ("UNIT", unit(&smooth.units)),
        ("EXPRESSIONS", quoted(&smooth.expressions)),
    ]);
    values.extend(smooth.drive.iter().flat_map(|drive| drive_values(drive, options, types.dim)));
    options.fill(include_str!("collocation.in"), &values)
}

/// Texts as literals.
fn quoted(texts: &[String]) -> String {
    texts.iter().map(|text| format!("{text:?}, ")).collect()
}

/// The velocity and the torque beside the energy, for the steps that programs refuse.
fn drive_values(drive: &Drive, options: &Options, dim: usize) -> [Value; 4] {
    let inputs =
        [("g", Some(drive.entries)), ("mu", Some(dim)), ("omega", Some(dim)), ("time", None)];
    let programs = [("acting", &drive.program), ("watched_in_drive", &drive.watched)];
    let functions = programs
        .map(|(name, program)| function(name, &drive.of_system(program), &inputs, true, options));
    [
        ("DRIVE", functions.concat()),
        ("ENTRIES", drive.entries.to_string()),
        ("ROWS", drive.entries.isqrt().to_string()),
        ("OF_DRIVE", quoted(&drive.expressions)),
    ]
}

/// The programs of the Hamiltonian as functions.
fn functions_of_energy(smooth: &Smooth, options: &Options, dim: usize) -> String {
    let states = [("mu", Some(dim)), ("time", None), ("next", Some(dim)), ("then", None)];
    [
        function("value", &smooth.value, &states[..2], false, options),
        function("gradient", &smooth.gradient, &states[..2], true, options),
        function("watched", &smooth.watched, &states[..2], true, options),
        function("reach", &smooth.reach, &states, false, options),
    ]
    .concat()
}

/// A program as a function of lists of these lengths and of numbers, which returns a list or a number.
fn function(
    name: &str,
    program: &Program,
    inputs: &[(&str, Option<usize>)],
    of_list: bool,
    options: &Options,
) -> String {
    let dialect = Rust::alone(options.suffix);
    let input = |&(name, len): &(&str, _)| Field { name: dialect.bound(name), len };
    let outputs =
        vec![Field { name: String::new(), len: of_list.then(|| program.outputs().len()) }];
    let inputs = inputs.iter().map(input).collect();
    let signature = Signature { name: name.to_owned(), program, inputs, outputs };
    dialect.function(&signature, &dialect.body(&signature))
}
