//! What is read, and what is said of mistakes: each file of `codegen/tests/cases` is of one kind of input, and has of each all that
//! is read or said.
//!
//! ```text
//! # the kind of input
//! ====
//! group = SO3
//! ----
//! system.toml:1:9: error: …
//! ====
//! …
//! ```
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-codegen --test all cases` writes what is said now: a new case is its input between
//! these lines.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::path::Path;

use coadjoint_codegen::parse::rust;
use coadjoint_codegen::smooth::Hamiltonian;
use coadjoint_codegen::system::{Options, Parameters, read, read_either};

/// A kind of input: the name of its file, and the mistakes of a text or all that is read of it.
type Kind = (&'static str, fn(&str) -> String);

const KINDS: [Kind; 5] = [
    ("attributes", of_an_attribute),
    ("hamiltonians", |text| of_a_file(&crate::text::file(text), "h.toml")),
    ("read", of_what_is_read),
    ("sums", |text| of_a_file(&crate::sums::file(text, crate::sums::MOMENTUM), "h.toml")),
    ("system_files", |text| of_a_file(text, "system.toml")),
];

fn of_a_file(text: &str, name: &str) -> String {
    read(text, Options::default())
        .map_or_else(|mistakes| mistakes.render(name, text), |_| String::new())
}

/// The first line is the attribute; columns are those of its arguments and of the function.
fn of_an_attribute(text: &str) -> String {
    let (attribute, function) = text.split_once('\n').unwrap();
    let inside = attribute.strip_prefix("#[").and_then(|rest| rest.strip_suffix(']')).unwrap();
    let (name, arguments) = inside.split_once('(').unwrap_or((inside, ")"));
    let arguments = arguments.strip_suffix(')').unwrap();
    let (arguments, function) = (arguments.parse().unwrap(), syn::parse_str(function).unwrap());
    let read = match name {
        "lie_poisson" => rust::hamiltonian(arguments, &function).map(drop),
        _ => rust::potential(arguments, &function).map(drop),
    };
    let Err(mistakes) = read else { return String::new() };
    mistakes.into_syn_error().into_iter().fold(String::new(), |mut all, error| {
        let (start, end) = (error.span().start(), error.span().end());
        writeln!(all, "{}:{}-{}: {error}", start.line, start.column + 1, end.column + 1).unwrap();
        all
    })
}

/// All that is read of a file, then all that is read differently where parameters are kept.
fn of_what_is_read(text: &str) -> String {
    let read = lines(text, Parameters::Substituted);
    let kept = lines(text, Parameters::Kept);
    let other = kept.iter().filter(|line| !read.contains(line)).map(|line| format!("kept {line}"));
    read.iter().cloned().chain(other).map(|line| line + "\n").collect()
}

/// The parts of a system and its run, a line each; numbers of functions have fourteen digits.
fn lines(text: &str, parameters: Parameters) -> Vec<String> {
    let options = Options { parameters, ..Options::default() };
    let system = match read_either(text, options, &[]) {
        Ok(system) => system,
        Err(mistakes) => return vec![mistakes.render("system.toml", text)],
    };
    let (facts, run, units) = (system.problem.facts(), &system.run, &system.units);
    let short = |x: &f64| format!("{x:.13e}").parse::<f64>().unwrap();
    let list = |numbers: &[f64]| format!("{:?}", numbers.iter().map(short).collect::<Vec<_>>());
    let brackets = facts.algebra.structure().iter().filter(|constant| constant.i < constant.j);
    let brackets = brackets.map(|s| format!("[{}, {}] = {}*{}", s.i, s.j, s.value, s.k));
    let mut all = vec![
        format!(
            "{} on {}, {:?}, K = {}",
            facts.name,
            facts.algebra.name(),
            facts.coordinates,
            facts.truncation
        ),
        format!("brackets {}", brackets.collect::<Vec<_>>().join(", ")),
    ];
    let symbols = match &system.problem {
        Hamiltonian::Polynomial(problem, _) => {
            all.push(format!("H = {:?}, {} chart", problem.hamiltonian, problem.chart));
            &problem.symbols
        }
        Hamiltonian::Smooth(smooth) => {
            let symbols = smooth.symbols_at(&facts.defaults());
            let mu: Vec<f64> =
                (0..smooth.gradient.outputs().len()).map(|i| i as f64 + 1.0).collect();
            let value = short(&smooth.energy(&symbols, 0.3, &mu));
            let gradient = list(&smooth.gradient(&symbols, 0.3, &mu));
            all.push(format!(
                "H(0.3, {mu:?}) = {value}, its gradient {gradient}, moves: {}",
                smooth.moves
            ));
            &smooth.symbols
        }
    };
    for symbol in symbols {
        all.push(format!("{} = {}", symbol.text, short(&symbol.expr.evaluate(&facts.defaults()))));
    }
    for parameter in facts.parameters {
        let values = parameter.default.iter().flatten().map(ToString::to_string);
        let values = values.collect::<Vec<_>>().join(", ");
        all.push(format!("parameter {} of {:?}: {values}", parameter.name, parameter.shape));
    }
    all.extend(system.writable().err());
    all.extend(run.step.map(|step| format!("step {}", short(&step))));
    all.extend(run.time.map(|time| format!("time {time}, every {:?}", run.every)));
    all.extend(run.momentum.iter().map(|mu| format!("momentum {}", list(mu))));
    for row in run.group_element.iter().flatten() {
        all.push(format!("g {row:?}"));
    }
    all.extend(units.time.iter().map(|unit| format!("time in {unit}")));
    let names = facts.coordinates.iter().enumerate();
    let named = names.filter_map(|(i, name)| Some(format!("{name} in {}", units.coordinate(i)?)));
    all.extend(named);
    all
}

#[test]
fn each_mistake_is_said_as_its_case_has_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let bless = std::env::var_os("COADJOINT_BLESS").is_some();
    let mut differences = String::new();
    for (name, said) in KINDS {
        let path = folder.join(name).with_extension("cases");
        let text = std::fs::read_to_string(&path).unwrap();
        let mut cases = text.split("====\n");
        let mut whole = cases.next().unwrap().to_owned();
        for case in cases {
            let line = whole.lines().count() + 1;
            let (input, expected) = case.split_once("----\n").unwrap();
            let found = said(input.strip_suffix('\n').unwrap_or(input));
            write!(whole, "====\n{input}----\n{found}").unwrap();
            if found != expected || found.is_empty() {
                writeln!(
                    differences,
                    "{name}.cases:{line}\n{input}---- expected\n{expected}---- found\n{found}"
                )
                .unwrap();
            }
        }
        if bless {
            std::fs::write(&path, whole).unwrap();
        }
    }
    assert!(bless || differences.is_empty(), "{differences}");
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), KINDS.len());
}
