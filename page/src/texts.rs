//! Texts to copy: the system in each of its languages.

use coadjoint_codegen::emit::c::{self, HeaderOptions};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::parse;
use coadjoint_codegen::problem::{Parameter, Shape};
use num_traits::ToPrimitive;

use crate::mistakes::Mistake;
use crate::rust;
use crate::system::System;

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// The system file of the command.
    File,
    /// The attribute.
    Rust,
    /// The Python package.
    Python,
    /// A header of C.
    C,
}

impl Language {
    /// The language of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Some(match name {
            "file" => Self::File,
            "rust" => Self::Rust,
            "python" => Self::Python,
            "c" => Self::C,
            _ => return None,
        })
    }
}

/// The system in this language.
///
/// # Errors
/// Why it cannot be written, in words.
pub fn text(system: &System, language: Language) -> Result<String, String> {
    let words = |mistakes: Vec<Mistake>| {
        mistakes.first().map(|first| first.message.clone()).unwrap_or_default()
    };
    match language {
        Language::File => Ok(system.file.clone()),
        Language::Rust => rust::program(system, &system.with_names().map_err(words)?),
        Language::Python => python(system, &system.with_names().map_err(words)?.parameters),
        Language::C => {
            let problem = system.with_names().map_err(words)?;
            let units = &system.units;
            let momentum =
                (0..system.dim()).map(|i| units.coordinate(i).map(str::to_owned)).collect();
            let options = HeaderOptions {
                prefix: problem.name.clone(),
                time: units.time.clone(),
                momentum,
                ..HeaderOptions::default()
            };
            let limit = TermLimit { terms: 20_000, products: 4_000_000 };
            // With many parameters kept as names the series may be too large: their values are then put in.
            let named = Integrator::build(problem, limit)
                .ok()
                .and_then(|integrator| c::header(&integrator, &options).ok());
            named.map_or_else(
                || c::header(&system.integrator, &options).map_err(|error| error.to_string()),
                Ok,
            )
        }
    }
}

fn python(system: &System, parameters: &[Parameter]) -> Result<String, String> {
    let problem = &system.integrator.problem;
    let mut out = String::from("import coadjoint as ca\n\n");
    let number = |x: f64| format!("{x:?}");
    let momentum = system.momentum.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", ");
    let time = system.fields.time.trim().parse::<f64>().unwrap_or(10.0);
    let run = format!(
        "run = body.simulate(momentum=[{momentum}], time={}, step={})\n",
        number(time),
        number(system.h)
    );
    if !system.fields.algebra.trim().is_empty() || problem.comoving.is_some() {
        // What the constructor has no argument for, the system file says.
        let quotes = if system.file.contains("\"\"\"") { "'''" } else { "\"\"\"" };
        if system.file.contains(quotes) || system.file.contains('\\') {
            return Err(
                "this system's Hamiltonian has quotes in it: use the system file".to_owned()
            );
        }
        out.push_str(&format!(
            "body = ca.System.from_toml({quotes}\n{}{quotes})\n{run}",
            system.file
        ));
        return Ok(out);
    }
    let hamiltonian = problem.source.split_whitespace().collect::<Vec<_>>().join(" ");
    let coordinates = system
        .fields
        .coordinates
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|word| !word.is_empty());
    let coordinates = coordinates.collect::<Vec<_>>().join(" ");
    let mut arguments =
        vec![format!("    {:?},", system.fields.group.trim()), format!("    {hamiltonian:?},")];
    if !coordinates.is_empty() {
        arguments.push(format!("    coordinates={coordinates:?},"));
    }
    if !parameters.is_empty() {
        let list =
            parameters.iter().map(|parameter| format!("{}={}", parameter.name, value(parameter)));
        arguments.push(format!("    parameters=dict({}),", list.collect::<Vec<_>>().join(", ")));
    }
    arguments.push(format!("    truncation={},", problem.truncation));
    if system.fields.chart != "exp" {
        arguments.push(format!("    chart={:?},", problem.chart.name()));
    }
    out.push_str(&format!("body = ca.System(\n{}\n)\n{run}", arguments.join("\n")));
    Ok(out)
}

/// A parameter's value: a number, a fraction as a text, or lists of these.
fn value(parameter: &Parameter) -> String {
    let one = |x: &coadjoint_codegen::number::Rational| {
        let number = x.to_f64().unwrap_or(f64::NAN);
        let exact = parse::rational(&number.to_string()).is_ok_and(|back| back == *x);
        if exact { format!("{number:?}") } else { format!("\"{x}\"") }
    };
    let values: Vec<String> = parameter.default.iter().flatten().map(one).collect();
    match parameter.shape {
        Shape::Array(_) => format!("[{}]", values.join(", ")),
        Shape::Grid(_, columns) => {
            let rows = values.chunks(columns.max(1)).map(|row| format!("[{}]", row.join(", ")));
            format!("[{}]", rows.collect::<Vec<_>>().join(", "))
        }
        _ => values.concat(),
    }
}
