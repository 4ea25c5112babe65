//! The struct of an integrator and its implementations.

use std::collections::BTreeSet;

use coadjoint_program::print::Value;
use proc_macro2::TokenStream;

use crate::emit::generating_function::{generating_function, integrator as steps, scalar_function};
use crate::emit::group::Types;
use crate::emit::header::Method;
use crate::emit::programs::{MOST_OPERATIONS, step_operations};
use crate::emit::table::{fold_item, last_item};
use crate::emit::{Options, fresh, header, identifier, parameter};
use crate::integrator::{FoldTable, Integrator, Kicks};
use crate::problem::{Parameter, Shape, Symbol};
use crate::smooth::Facts;
use crate::step::{Step, StepError};

/// An integrator as items.
#[derive(Debug, Default)]
pub struct Items {
    /// Paragraphs for the opening of a file.
    pub opening: Vec<String>,
    /// The struct, and what users call.
    pub struct_and_methods: TokenStream,
    /// The programs and tables, which are long; the names they bind end with [`Options::suffix`].
    pub programs: TokenStream,
    /// A line for each coefficient of the series that programs read.
    pub legend: Vec<String>,
}

/// The parts of an integrator that differ by its method.
pub(super) struct Parts<'a> {
    pub facts: Facts<'a>,
    pub method: Method<'a>,
    pub symbols: &'a [Symbol],
    pub types: Types,
    pub fold: FoldTable,
    pub order: usize,
    /// The programs of the step, where they are printed.
    pub step: Option<Step>,
    /// Lines about the truncation, and about the coefficients.
    pub about: [&'static str; 2],
    /// The steps that lanes make together, where these are not a block.
    pub together: &'static str,
    /// The value of the Hamiltonian from `mu`, `c` and the time.
    pub energy: String,
    /// The implementations that make its steps, and what these need.
    pub programs: String,
}

/// A step if it is short enough to be printed, and no kicks belong to it, which are items of their own.
pub(super) fn printed(step: Result<Step, StepError>) -> Option<Step> {
    let step = step.ok()?;
    let short = step.kernel().flows().is_none() && step_operations(&step) <= MOST_OPERATIONS;
    short.then_some(step)
}

/// The integrator as items, its programs and tables apart.
#[must_use]
pub fn items(integrator: &Integrator, options: &Options) -> Items {
    let problem = &integrator.problem;
    let types = Types::new(&problem.algebra, problem.chart, options);
    let step = printed(Step::by_series(integrator, types.elements));
    let fold = FoldTable::new(integrator);
    let programs = steps(integrator, step.as_ref(), options, &types);
    let generating = generating_function(integrator, options, &types, fold.len());
    let parts = Parts {
        facts: problem.facts(),
        method: Method::of_series(integrator),
        symbols: &problem.symbols,
        fold,
        order: integrator.order(),
        step,
        about: [
            " K: the series S₁ … S_K of the generating function is kept.",
            " The coefficients of the programs below, folded for h and the parameters; after them those of the bound on \
             what is left out of the Hessian, the square of the |μ| up to which the series can be trusted, and the \
             coefficients of its last two terms.",
        ],
        together: "",
        energy: scalar_function(&integrator.energy, options, "mu"),
        programs: programs + &generating + &last_item(integrator),
        types,
    };
    let kicks = integrator.kicks.as_ref();
    Items {
        legend: header::legend(&integrator.coefficients),
        ..assemble(&parts, Some(integrator), kicks, options)
    }
}

/// The items of these parts, without a legend; those of a series say more of it.
pub(super) fn assemble(
    parts: &Parts<'_>,
    series: Option<&Integrator>,
    kicks: Option<&Kicks>,
    options: &Options,
) -> Items {
    let Parts { facts, method, types, fold, step, .. } = parts;
    let [of_truncation, of_coefficients] = parts.about;
    // If H depends on the time, methods take the time of the state.
    let (time, stopped) = (options.bound("time"), options.bound("stopped"));
    let [argument, now, then, of] = match method.moves {
        true => [
            format!("{time}: T,"),
            time.clone(),
            format!("{time} + T::of({stopped}.steps as f64) * self.step"),
            "(t, μ)".to_owned(),
        ],
        false => ["", "T::of(0.0)", "T::of(0.0)", "(μ)"].map(String::from),
    };
    let reduced =
        format!(" The reduced Hamiltonian H_red{of}, with the parameters given at construction.");
    let mut values = types.values();
    values.extend(constructor(facts.parameters, parts.symbols, fold, options));
    values.extend([
        ("BLANK", (!options.attributes.is_empty()).to_string()),
        ("SUMMARY", header::lines(*facts, method, series, step.as_ref()).iter().map(doc).collect()),
        ("OF_TRUNCATION", doc(of_truncation)),
        ("OF_COEFFICIENTS", doc(of_coefficients)),
        ("REDUCED", doc(reduced)),
        ("BOUND", bound(method.moves).to_owned()),
        ("TRUNCATION", facts.truncation.to_string()),
        ("ORDER", parts.order.to_string()),
        ("TIME", argument),
        ("NOW", now),
        ("THEN", then),
        ("SERIES", series.is_some().to_string()),
        ("PROGRAMS", parts.programs.clone()),
        ("LANES", (!method.moves).to_string()),
        ("STEPS", step.is_some().to_string()),
        ("TOGETHER", parts.together.to_owned()),
        ("ENERGY", parts.energy.clone()),
        ("TABLE", fold_item(fold)),
    ]);
    Items {
        opening: header::opening(*facts, method, kicks, options, step.as_ref()),
        struct_and_methods: options.tokens(&options.fill(include_str!("item.in"), &values)),
        programs: options.tokens(&options.fill(include_str!("programs.in"), &values)),
        legend: Vec::new(),
    }
}

/// A line of documentation.
pub(super) fn doc(line: impl AsRef<str>) -> String {
    format!("#[doc = {:?}]\n", line.as_ref())
}

/// The bound of numbers; those of 32 bits could not tell the times within a step apart.
pub(super) fn bound(moves: bool) -> &'static str {
    if moves { "__krate::Scalar<Element = f64>" } else { "__krate::Scalar" }
}

/// The places of a constructor `new(step, parameters…)`, which folds.
pub(super) fn constructor(
    parameters: &[Parameter],
    symbols: &[Symbol],
    fold: &FoldTable,
    options: &Options,
) -> [Value; 7] {
    let Arguments { arguments, names, scalars } = arguments(parameters);
    let texts = symbols.iter().map(|symbol| format!("{:?}, ", symbol.text));
    [
        ("STEP", fresh(&options.bound("step"), &names)),
        ("ARGUMENTS", arguments),
        ("VALUES", parameter::symbols(symbols, &scalars).join(", ")),
        ("TEXTS", texts.collect()),
        ("SYMBOLS", symbols.len().to_string()),
        ("SLOTS", fold.len().to_string()),
        ("ROOM", fold.lists().room().to_string()),
    ]
}

struct Arguments {
    /// `name: type, ` for each.
    arguments: String,
    /// The names.
    names: BTreeSet<String>,
    /// An expression for each of their scalars.
    scalars: Vec<String>,
}

fn arguments(parameters: &[Parameter]) -> Arguments {
    let mut names = parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let (mut arguments, mut scalars) = (String::new(), Vec::new());
    for parameter in parameters {
        let name = argument_name(&parameter.name, &mut names);
        arguments.push_str(&format!("{name}: {}, ", parameter_type(&parameter.shape)));
        scalars.extend(parameter.scalar_names().iter().map(|scalar| {
            // `inertia[0]`: the name, then how the scalar is reached.
            let access = scalar.strip_prefix(parameter.name.as_str()).unwrap_or_default();
            format!("{name}{access}")
        }));
    }
    Arguments { arguments, names, scalars }
}

/// A parameter's name as an argument; with another one, where it cannot be an identifier.
fn argument_name(name: &str, names: &mut BTreeSet<String>) -> String {
    let argument = identifier(name).to_string();
    if argument == name {
        return argument;
    }
    let argument = fresh(&argument, names);
    names.insert(argument.clone());
    argument
}

/// The type of a parameter over the scalar `T`.
fn parameter_type(shape: &Shape) -> String {
    match shape {
        Shape::Scalar => "T".to_owned(),
        Shape::Array(n) => format!("[T; {n}]"),
        Shape::Vector(n) => format!("__krate::nalgebra::SVector<T, {n}>"),
        Shape::Grid(rows, columns) => format!("[[T; {columns}]; {rows}]"),
        Shape::Matrix(rows, columns) => format!("__krate::nalgebra::SMatrix<T, {rows}, {columns}>"),
    }
}
