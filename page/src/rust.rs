//! The attribute: a system as a Rust function.

use std::collections::BTreeSet;
use std::fmt::Write;

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::emit::c::prefix;
use coadjoint_codegen::emit::{RUNTIME_TABLES, camel_case, fresh, identifier};
use coadjoint_codegen::expr::{Arena, ExprId, Node};
use coadjoint_codegen::lie::catalogue;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::parse::{Name, Names, text, words};
use coadjoint_codegen::problem::{Parameter, Problem, Shape};
use coadjoint_program::quoting::{line, rust_comment};
use num_traits::{Signed, ToPrimitive};

use crate::fields::Fields;
use crate::system::System;

/// Expressions of more operations are left to the system file.
const MOST_OPERATIONS: usize = 4000;
/// Closed forms that the runtime has at its root.
const AT_ROOT: [&str; 2] = ["SE3", "SO3"];
/// Other groups that it has closed forms of.
const CLOSED_FORMS: [&str; 3] = ["Heisenberg", "SE2", "SU2"];
/// Names that mean something else in the function.
const TAKEN: [&str; 2] = ["mu", "f64"];

/// A program that makes steps of the system.
///
/// # Errors
/// Why there is none, in words.
pub fn program(system: &System) -> Result<String, String> {
    // A comoving frame may be one for the values of the parameters alone: they are then written as numbers.
    let named = system.with_names();
    let numbers = if named.is_some() { Vec::new() } else { system.parameters() };
    let problem = named.as_ref().unwrap_or(&system.integrator.problem);
    let arguments: Vec<String> = names(&problem.parameters, &problem.coordinates);
    let coordinates: Vec<String> =
        problem.coordinates.iter().map(|name| name.to_lowercase()).collect();
    // A name of its own for each, or by their numbers.
    let plain = problem.coordinates.iter().all(|name| is_plain(name))
        && (1..coordinates.len()).all(|i| !coordinates[..i].contains(&coordinates[i]));
    let momenta: Vec<String> = match plain {
        true => coordinates.clone(),
        false => (0..coordinates.len()).map(|i| format!("mu[{i}]")).collect(),
    };
    let scalars: Vec<String> = problem
        .parameters
        .iter()
        .zip(&arguments)
        .flat_map(|(parameter, argument)| {
            let written = parameter.scalar_names();
            written
                .into_iter()
                .map(|name| format!("{argument}{}", &name[parameter.name.len()..]))
                .collect::<Vec<_>>()
        })
        .collect();
    let body = expression(problem, &numbers, &momenta, &scalars)?;

    let Fields { algebra, group, .. } = &system.fields;
    let function = snake(&problem.name);
    let title = camel_case(&function);
    let own = !algebra.trim().is_empty();
    if words(algebra).any(|word| words(&system.fields.parameters).any(|known| known == word)) {
        return Err("[algebra] uses parameters: use the system file".to_owned());
    }
    let group_argument = if own { inline(algebra)? } else { group.trim().to_owned() };
    let known = !own && catalogue::lookup(group).is_ok();
    let name = problem.algebra.name();
    let (import, ty) = if known && AT_ROOT.contains(&name) {
        (format!("use coadjoint::{{lie_poisson, Phase, {name}}};"), name.to_owned())
    } else if known && CLOSED_FORMS.iter().chain(&RUNTIME_TABLES).any(|known| *known == name) {
        (format!("use coadjoint::{{groups::{name}, lie_poisson, Phase}};"), name.to_owned())
    } else {
        ("use coadjoint::{lie_poisson, Phase};".to_owned(), format!("{title}Group"))
    };
    let mut list =
        vec![format!("group = {group_argument}"), format!("truncation = {}", problem.truncation)];
    if system.fields.chart != "exp" {
        list.push(format!("chart = {}", problem.chart.name()));
    }
    if system.fields.frame != "auto" {
        list.push(format!("frame = {}", problem.frame_name()));
    }
    let types = problem.parameters.iter().map(|parameter| match parameter.shape {
        Shape::Array(n) => format!("[f64; {n}]"),
        Shape::Grid(rows, columns) => format!("[[f64; {columns}]; {rows}]"),
        _ => "f64".to_owned(),
    });
    let mut signature = vec![format!("mu: [f64; {}]", momenta.len())];
    signature.extend(arguments.iter().zip(types).map(|(name, ty)| format!("{name}: {ty}")));
    let mut out = format!(
        "{import}\n\n/// H = {}\n#[lie_poisson({})]\npub fn {function}({}) -> f64 {{\n",
        rust_comment(&problem.source),
        list.join(", "),
        signature.join(", "),
    );
    if plain {
        let used =
            |name: &String| if uses(&body, name) { name.clone() } else { format!("_{name}") };
        let _ = writeln!(
            out,
            "    let [{}] = mu;",
            momenta.iter().map(used).collect::<Vec<_>>().join(", ")
        );
    }
    let mut given = vec![float(system.h)];
    given.extend(problem.parameters.iter().map(value));
    let momentum = system.momentum.iter().map(|&x| float(x)).collect::<Vec<_>>().join(", ");
    let steps = (system.time / system.h.abs()).round().clamp(1.0, 1e9);
    let _ = write!(
        out,
        "    {body}\n}}\n\nfn main() -> Result<(), coadjoint::StepError> {{\n    let step = {title}::new({})?;\n    let mut state = Phase::<{ty}>::at_identity([{momentum}]);\n    for _ in 0..{steps} {{\n        step.advance(&mut state)?;\n    }}\n    println!(\"{{:?}}\", state.momentum);\n    Ok(())\n}}\n",
        given.join(", "),
    );
    Ok(out)
}

/// The Hamiltonian with these names, and with values for some parameters.
fn expression(
    problem: &Problem,
    numbers: &[Parameter],
    momenta: &[String],
    scalars: &[String],
) -> Result<String, String> {
    let (mut known, mut arena, diagnostics) = (Names::default(), Arena::new(), Diagnostics::new());
    for (i, name) in problem.coordinates.iter().enumerate() {
        known.add(name, Name::Coordinate(i), Default::default(), &diagnostics);
    }
    for i in 0..problem.coordinates.len() {
        known.alias(format!("mu[{i}]"), Name::Coordinate(i));
    }
    let mut place = 0;
    for parameter in &problem.parameters {
        for name in parameter.scalar_names() {
            known.add(&name, Name::Parameter(place), Default::default(), &diagnostics);
            place += 1;
        }
    }
    for parameter in numbers {
        let values = parameter.default.iter().flatten().cloned();
        for (name, value) in parameter.scalar_names().iter().zip(values) {
            known.add(name, Name::Number(value), Default::default(), &diagnostics);
        }
    }
    let root = text::parse(&problem.source, 0, &[], &known, &mut arena, &diagnostics);
    if !diagnostics.is_empty() || arena.len() > MOST_OPERATIONS {
        return Err("this Hamiltonian cannot be written as a function: use the system file, in a build script by coadjoint_codegen::Build".to_owned());
    }
    let mut written: Vec<(String, u8)> = Vec::with_capacity(arena.len());
    for (_, node, _) in arena.iter() {
        let next = write(node, &mut written, &arena, momenta, scalars);
        written.push(next);
    }
    let (text, _) = written.swap_remove(root.index());
    Ok(text)
}

const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const SIGN: u8 = 3;
const ATOM: u8 = 4;

/// A node as text, and how strongly it binds. Operands are taken: each is used once.
fn write(
    node: &Node,
    written: &mut [(String, u8)],
    arena: &Arena,
    momenta: &[String],
    scalars: &[String],
) -> (String, u8) {
    let mut take = |id: ExprId, least: u8| {
        let (text, strength) = std::mem::take(&mut written[id.index()]);
        if strength < least { format!("({text})") } else { text }
    };
    match node {
        Node::Number(number) => literal(number),
        Node::Coordinate(i) => (momenta.get(*i).cloned().unwrap_or_default(), ATOM),
        Node::Parameter(i) => (scalars.get(*i).cloned().unwrap_or_default(), ATOM),
        Node::Neg(a) => (format!("-{}", take(*a, ATOM)), SIGN),
        Node::Add(a, b) => (format!("{} + {}", take(*a, SUM), take(*b, PRODUCT)), SUM),
        Node::Sub(a, b) => (format!("{} - {}", take(*a, SUM), take(*b, PRODUCT)), SUM),
        Node::Mul(a, b) => (format!("{} * {}", take(*a, PRODUCT), take(*b, SIGN)), PRODUCT),
        Node::Div(a, b) => (format!("{} / {}", take(*a, PRODUCT), take(*b, SIGN)), PRODUCT),
        Node::Pow(a, b) => {
            let base = receiver(take(*a, ATOM));
            match arena.node(*b) {
                Node::Number(power) if power.is_integer() => {
                    (format!("{base}.powi({power})"), ATOM)
                }
                _ => (format!("{base}.powf({})", take(*b, SUM)), ATOM),
            }
        }
        Node::Call(function, a) => {
            (format!("{}.{}()", receiver(take(*a, ATOM)), function.name()), ATOM)
        }
        Node::Wrong => (String::new(), ATOM),
    }
}

/// The receiver of a method: of mere numbers the first one has its type written.
fn receiver(text: String) -> String {
    let digit = |c: char| c.is_ascii_digit();
    if text.contains(|c: char| c.is_alphabetic() && c != 'e') {
        return text;
    }
    let Some(start) = text.find(digit) else { return text };
    let end =
        text[start..].find(|c: char| !digit(c) && c != '.').map_or(text.len(), |end| start + end);
    format!("{}_f64{}", &text[..end], &text[end..])
}

/// An exact number: as a decimal where it is one, else as a quotient.
fn literal(number: &Rational) -> (String, u8) {
    let text = decimal(&number.abs()).map(|text| (text, ATOM));
    let (text, strength) = text.unwrap_or_else(|| {
        (format!("{}.0 / {}.0", number.numer().magnitude(), number.denom()), PRODUCT)
    });
    if number.is_negative() { (format!("-{text}"), SIGN.min(strength)) } else { (text, strength) }
}

/// A number with at most 15 decimals, with all of them.
fn decimal(number: &Rational) -> Option<String> {
    let text = number.to_f64()?.to_string();
    let back = coadjoint_codegen::parse::rational(&text)?;
    let text = if text.contains(['.', 'e']) { text } else { format!("{text}.0") };
    (back == *number).then_some(text)
}

fn float(value: f64) -> String {
    format!("{value:?}")
}

/// A parameter's value as an argument.
fn value(parameter: &Parameter) -> String {
    listed(parameter, |x| {
        let (text, _) = literal(x);
        if x.is_negative() && text.contains('/') { format!("({text})") } else { text }
    })
}

/// A parameter's value as a number or as lists, which Python and Rust write alike.
pub(crate) fn listed(parameter: &Parameter, one: impl Fn(&Rational) -> String) -> String {
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

/// Names of arguments that style and the language allow, each its own.
fn names(parameters: &[Parameter], coordinates: &[String]) -> Vec<String> {
    let mut taken: BTreeSet<String> = TAKEN.map(str::to_owned).into();
    taken.extend(coordinates.iter().map(|name| name.to_lowercase()));
    let name = |parameter: &Parameter| {
        let name = identifier(&parameter.name.to_lowercase()).to_string();
        let name = fresh(&name, &taken);
        taken.insert(name.clone());
        name
    };
    parameters.iter().map(name).collect()
}

fn is_plain(name: &str) -> bool {
    let name = name.to_lowercase();
    identifier(&name) == name && !TAKEN.contains(&name.as_str())
}

fn uses(body: &str, name: &str) -> bool {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    body.match_indices(name).any(|(at, _)| {
        let (before, after) = (&body[..at], &body[at + name.len()..]);
        !before.ends_with(word) && !after.starts_with(word)
    })
}

/// The function's name.
fn snake(name: &str) -> String {
    let text = prefix(name);
    if is_plain(&text) { text } else { format!("system_{text}") }
}

/// `algebra(…)` as the attribute reads it.
fn inline(algebra: &str) -> Result<String, String> {
    let nothing = |_| "the table [algebra] is not readable".to_owned();
    let document = toml::de::DeTable::parse(algebra).map_err(nothing)?;
    let table = document.get_ref();
    let mut parts = Vec::new();
    for key in ["generators", "basis", "brackets"] {
        if let Some(value) = table.get(key) {
            let raw = line(algebra.get(value.span()).unwrap_or_default());
            let raw = raw.replace("[ ", "[").replace(", ]", "]").replace(" ]", "]");
            parts.push(format!("{key} = {raw}"));
        }
    }
    Ok(format!("algebra({})", parts.join(", ")))
}
