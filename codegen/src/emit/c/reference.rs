//! The opening, the sizes and the types of a header.

use std::fmt::Write;

use coadjoint_program::BLOCK;
use coadjoint_program::print::Value;
use coadjoint_program::quoting::c_comment;
use num_traits::ToPrimitive;

use crate::emit::c::dialect::decimal;
use crate::emit::c::fold::{Folding, rows_of};
use crate::emit::c::names::Names;
use crate::emit::c::programs::casimirs;
use crate::emit::c::{HeaderOptions, Language, parameter};
use crate::emit::header::{self, Method, when};
use crate::problem::Parameter;
use crate::step::{Origin, Step};

/// The opening, the sizes, and the types, for the template.
pub(super) fn values(
    origin: &Origin,
    step: &Step,
    fold: &Folding,
    names: &Names,
    options: &HeaderOptions,
) -> Vec<Value> {
    let (facts, kernel) = (origin.facts(), step.kernel());
    let mut members = String::new();
    for (parameter, name) in facts.parameters.iter().zip(&names.parameters) {
        let member = parameter::member(&parameter.shape, name);
        let own = c_comment(&parameter.name);
        let note = if own == *name { String::new() } else { format!(" /**< {own} */") };
        let _ = writeln!(members, "    {member};{note}");
    }
    let mut coordinates = String::new();
    for (i, name) in facts.coordinates.iter().enumerate() {
        let unit = options.momentum.get(i).and_then(Option::as_ref);
        let unit = unit.map_or(String::new(), |unit| format!(" in {}", c_comment(unit)));
        let _ = writeln!(coordinates, "     *  mu[{i}] = {}{unit}", c_comment(name));
    }
    let rows = kernel.programs.matrix.outputs().len().isqrt();
    let identity: Vec<f64> =
        (0..rows * rows).map(|at| f64::from(u8::from(at / rows == at % rows))).collect();
    let numbers = step.element_of(&identity);
    let inverse =
        |(at, rows)| format!("    @p@_internal_invert(&state->g[{at}], &back[{at}], {rows}u);\n");
    let inverted = step.inverted().into_iter();
    let (clock, kicks) = (kernel.clock().is_some(), origin.kicks().is_some());
    let given = !facts.parameters.is_empty();
    let lists = if kicks { "(@P@_FLOWS + 1u) * @P@_COEFFICIENTS" } else { "@P@_COEFFICIENTS" };
    vec![
        ("OPENING", opening(origin, step, fold, names, options)),
        ("VERSION", env!("CARGO_PKG_VERSION").to_owned()),
        ("CPP", (options.language == Language::Cpp).to_string()),
        ("DIMENSIONS", kernel.dim.to_string()),
        ("NUMBERS", kernel.element.to_string()),
        ("ROWS", rows.to_string()),
        ("CASIMIRS", casimirs(step).to_string()),
        ("FLOW_COUNT", kernel.flows().unwrap_or(0).to_string()),
        ("COEFFICIENTS", fold.len().to_string()),
        ("TIMES", kernel.clock().map_or(0, |clock| clock.times.len()).to_string()),
        ("BLOCK", BLOCK.to_string()),
        ("LARGEST", inverted.clone().map(|of| of.1).max().unwrap_or(0).to_string()),
        ("LEARNED", when(options.only_step.is_some(), ", or not the one step that was learned")),
        ("UNRESOLVED", when(origin.series().is_none(), ", or its nodes do not resolve it")),
        ("PARAMETERS", members),
        ("REFERENCE", when(given, ", const Parameters &parameters")),
        ("POINTER", when(given, ", &parameters")),
        ("ELEMENT", step.element_about()),
        ("COORDINATES", coordinates),
        ("LENGTH", names.fill(lists)),
        ("ONLY", options.only_step.map_or_else(String::new, decimal)),
        ("CLOCK", clock.to_string()),
        ("TIME", when(clock, ", double time")),
        ("NOW", when(clock, ", time")),
        ("FROM", when(clock, " from this time")),
        ("OR_TIME", when(clock, ", or the time,")),
        ("IDENTITY", rows_of(numbers.into_iter().map(decimal), 8)),
        ("INVERTED", names.fill(&inverted.map(inverse).collect::<String>())),
        ("OF", when(kicks, "state->g, ")),
        ("POTENTIAL", when(kicks, " and the potential")),
        ("DEFAULTS", defaults(origin, names)),
    ]
}

/// The values that the system file gives to its parameters.
fn defaults(origin: &Origin, names: &Names) -> String {
    let facts = origin.facts();
    let scalars = parameter::scalars(facts.parameters, names);
    let values = facts.parameters.iter().flat_map(|Parameter { shape, default, .. }| {
        (0..shape.len()).map(move |i| default.as_ref()?.get(i)?.to_f64())
    });
    if facts.parameters.iter().all(|parameter| parameter.default.is_none()) {
        return String::new();
    }
    let value = |value: Option<f64>| value.map_or_else(|| "(double)NAN".to_owned(), decimal);
    let lines = scalars.iter().zip(values);
    lines.map(|(scalar, own)| format!("    {scalar} = {};\n", value(own))).collect()
}

/// Columns of a comment.
const WIDTH: usize = 112;

/// The opening comment.
fn opening(
    origin: &Origin,
    step: &Step,
    fold: &Folding,
    names: &Names,
    options: &HeaderOptions,
) -> String {
    let (facts, kernel) = (origin.facts(), step.kernel());
    let numbers = fold.len() * kernel.flows().map_or(1, |flows| flows as usize + 1);
    let unit = options.time.as_ref().map(|unit| format!(" in {}", c_comment(unit)));
    let mut values = header::system(facts, origin.kicks(), &Method::of(origin), c_comment);
    values.extend([
        ("C", "1".to_owned()),
        ("FILE", names.file()),
        ("STANDARD", when(options.language == Language::C, "C99 and ")),
        ("LOWER", names.lower.clone()),
        ("UPPER", names.upper.clone()),
        ("PARAMETERS", when(!facts.parameters.is_empty(), ", &parameters")),
        ("NOW", when(kernel.clock().is_some(), ", time")),
        ("UNIT", unit.unwrap_or_default()),
        ("MEMORY", step.memory().to_string()),
        ("WORKS", step.work_at().is_some().to_string()),
        ("NEITHER", (origin.series().is_none() && step.memory() == 0).to_string()),
        ("COSTS", header::costs(kernel)),
        ("COEFFICIENTS", numbers.to_string()),
        ("MAP_BYTES", (8 * numbers).to_string()),
        ("STATE_BYTES", (8 * (kernel.dim + kernel.element)).to_string()),
        ("FRAME", kernel.programs.frame.is_some().to_string()),
        ("CLOCK", kernel.clock().is_some().to_string()),
        ("LEARNED", options.only_step.map_or_else(String::new, |step| format!("{step:?}"))),
    ]);
    format!("/*\n{} */\n", header::comment(&header::paragraphs(&values), WIDTH, " *"))
}
