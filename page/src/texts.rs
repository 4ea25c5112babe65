//! Texts to copy: the system in each of its languages.

use coadjoint_codegen::emit::c::{self, HeaderOptions};
use coadjoint_codegen::emit::{camel_case, identifier};
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::parse;
use coadjoint_codegen::problem::{Parameter, Shape};
use num_traits::ToPrimitive;

use crate::system::{LIMIT, System};

/// The system in a language: `file` (its system file), `rust` (a program, and the build script that writes its steps), `python`
/// or `c` (a header). An error says why it cannot be written.
pub fn text(system: &System, language: &str) -> Result<String, String> {
    match language {
        "file" => Ok(system.file.clone()),
        "rust" => Ok(rust(system)),
        "python" => python(system, &system.parameters()),
        "c" => {
            let problem = &system.integrator.problem;
            let units = &system.units;
            let momentum =
                (0..system.dim()).map(|i| units.coordinate(i).map(str::to_owned)).collect();
            let options = HeaderOptions {
                prefix: problem.name.clone(),
                time: units.time.clone(),
                momentum,
                ..HeaderOptions::default()
            };
            // With many parameters kept as names the series may be too large: their values are then put in.
            let named =
                system.with_names().and_then(|problem| Integrator::build(problem, LIMIT).ok());
            let named = named.and_then(|integrator| c::header(&integrator, &options).ok());
            let valued =
                || c::header(&system.integrator, &options).map_err(|error| error.to_string());
            named.map_or_else(valued, Ok)
        }
        _ => Err("no such language".to_owned()),
    }
}

fn rust(system: &System) -> String {
    let name = &system.integrator.problem.name;
    let (module, title) = (identifier(&c::prefix(name)), identifier(&camel_case(name)));
    let steps = (system.time / system.h.abs()).round().clamp(1.0, 1e9);
    let (h, momentum) = (system.h, &system.momentum);
    format!(
        r#"// build.rs, which needs coadjoint-codegen and the system file:
//     fn main() -> Result<(), coadjoint_codegen::BuildError> {{
//         let system = coadjoint_codegen::Build::new("{module}.toml").substitute_parameters();
//         system.write("{module}.rs").map(drop)
//     }}

mod {module} {{
    include!(concat!(env!("OUT_DIR"), "/{module}.rs"));
}}

fn main() -> Result<(), coadjoint::StepError> {{
    let step = {module}::{title}::new({h:?})?;
    let mut state = coadjoint::Phase::at_identity({momentum:?});
    for _ in 0..{steps} {{
        step.advance(&mut state)?;
    }}
    println!("{{:?}}", state.momentum);
    Ok(())
}}
"#
    )
}

/// Names that no keyword argument may have.
const KEYWORDS: &str = " False None True and as assert async await break class continue def del elif else except finally \
     for from global if import in is lambda nonlocal not or pass raise return try while with yield ";

fn python(system: &System, parameters: &[Parameter]) -> Result<String, String> {
    let problem = &system.integrator.problem;
    let mut out = String::from("import coadjoint as ca\n\n");
    // Strings of JSON are strings of Python.
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    let number = |x: f64| format!("{x:?}");
    let momentum = system.momentum.iter().map(|&x| number(x)).collect::<Vec<_>>().join(", ");
    let run = format!(
        "run = body.simulate(momentum=[{momentum}], time={}, step={})\n",
        number(system.time),
        number(system.h)
    );
    if !system.fields.algebra.trim().is_empty() {
        let quotes = if system.file.contains("\"\"\"") { "'''" } else { "\"\"\"" };
        if system.file.contains(quotes) || system.file.contains('\\') {
            return Err("there are quotes or backslashes in it; use the system file".to_owned());
        }
        out.push_str(&format!(
            "body = ca.System.from_text({quotes}\n{}{quotes})\n{run}",
            system.file
        ));
        return Ok(out);
    }
    let hamiltonian = problem.source.split_whitespace().collect::<Vec<_>>().join(" ");
    let coordinates: Vec<&str> =
        crate::file::words(&system.fields.coordinates).into_iter().map(|(_, word)| word).collect();
    let mut arguments = vec![
        format!("    {},", quoted(system.fields.group.trim())),
        format!("    {},", quoted(&hamiltonian)),
    ];
    if !coordinates.is_empty() {
        arguments.push(format!("    coordinates={},", quoted(&coordinates.join(" "))));
    }
    let usual = |parameter: &Parameter| {
        !KEYWORDS.contains(&format!(" {} ", parameter.name)) && !parameter.name.contains('\'')
    };
    if parameters.iter().all(usual) && !parameters.is_empty() {
        let list = parameters.iter().map(|one| format!("{}={}", one.name, value(one)));
        arguments.push(format!("    parameters=dict({}),", list.collect::<Vec<_>>().join(", ")));
    } else if !parameters.is_empty() {
        let list = parameters.iter().map(|one| format!("{}: {}", quoted(&one.name), value(one)));
        arguments.push(format!("    parameters={{{}}},", list.collect::<Vec<_>>().join(", ")));
    }
    arguments.push(format!("    truncation={},", problem.truncation));
    if system.fields.chart != "exp" {
        arguments.push(format!("    chart={},", quoted(problem.chart.name())));
    }
    if system.fields.frame != "auto" {
        arguments.push(format!("    frame={},", quoted(problem.frame_name())));
    }
    out.push_str(&format!("body = ca.System(\n{}\n)\n{run}", arguments.join("\n")));
    Ok(out)
}

/// A parameter's value: a number, a fraction as a text, or lists of these.
fn value(parameter: &Parameter) -> String {
    let one = |x: &Rational| {
        let number = x.to_f64().unwrap_or(f64::NAN);
        let exact = parse::rational(&number.to_string()).is_some_and(|back| back == *x);
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
