//! Texts of users never become code: what is emitted for hostile names is what is emitted for plain ones, but for comments.
#![allow(clippy::unwrap_used)]

use crate::given::kept;
use crate::tools::{FLAGS_C, FLAGS_CPP, Tool, scratch};
use coadjoint_codegen::emit::c::{self, HeaderOptions, Language};
use coadjoint_codegen::emit::{Options as RustOptions, file, items, potential_items};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{Integrator, Kick};
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_program::print::{DeviceLanguage, device_unit};

/// Texts that end comments, strings, elements and lines, that continue lines, or that are words of some language.
fn hostile() -> Vec<String> {
    let mut list: Vec<String> = [
        "x\npub fn evil() { std::process::exit(1) }\n//",
        "x\r*/ int evil(void) { return 1; } /*",
        "*//* ??/\n\\",
        "\"quoted\" 'text' `tick` \\",
        "</script><script>alert(1)</script><!-- ]]> &amp;",
        "=cmd|' /C calc'!A0",
        "\u{202e}\u{2066}dlrow\u{2069} \u{200f}",
        "a\u{2028}b\u{85}c\u{b}d\u{0}\u{1b}[2J",
        "@p@ @P@ /*VERSION*/ {} {0} %s #",
        "Self",
        "T",
        "fn",
        "NULL",
        "kg² ⓐ Ω …",
        "",
    ]
    .map(str::to_owned)
    .to_vec();
    list.push("long_name ".repeat(1000));
    list
}

/// A text in quotes, of JSON and of TOML.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn own_algebra(name: &str) -> Integrator {
    let name = quoted(name);
    let text = format!(
        "name = {name}\nhamiltonian = \"a^2/2 + b^2/4 - c^2/6\"\n[algebra]\nname = {name}\n\
         generators = [\"a\", \"b\", \"c\"]\nbrackets = [\"[a, b] = -c\", \"[b, c] = a\", \"[c, a] = b\"]\n\
         [integrator]\ntruncation = 3"
    );
    Integrator::build(kept(&text).problem, TermLimit::default()).unwrap()
}

/// The lines of Rust that are no comments.
fn code_of_rust(text: &str) -> Vec<&str> {
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect()
}

fn code_of_c(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        code.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    code + rest
}

#[test]
fn names_of_systems_and_algebras_stay_in_comments() {
    let style = RustOptions::for_problem("plain");
    let written = |name: &str| {
        let integrator = own_algebra(name);
        let top =
            "name = \"top\"\ngroup = \"SO3\"\nhamiltonian = \"mu[0]^2\"\npotential = \"g[2][2]\"";
        let mut potential = kept(top).potential.unwrap().0;
        potential.source = name.to_owned();
        potential.algebra = integrator.problem.algebra.clone();
        let kick = potential_items(&Kick::build(potential), &style);
        let header = |unit: &str| HeaderOptions {
            prefix: "plain".to_owned(),
            time: Some(unit.to_owned()),
            momentum: vec![Some(unit.to_owned()); 3],
            ..HeaderOptions::default()
        };
        let rust = file(items(&integrator, &style));
        let c = c::header(&Origin::from(integrator.clone()), &header(name)).unwrap();
        let step = Step::build(&integrator).unwrap();
        let slots = step.fold(0.1, &[]).unwrap();
        let device = |language| device_unit(step.kernel(), &slots, language, name);
        (rust, kick, [c, device(DeviceLanguage::OpenCl), device(DeviceLanguage::Cuda)])
    };
    let (rust, kick, plain) = written("plain");
    for name in hostile() {
        let (other, other_kick, hostile) = written(&name);
        assert_eq!(code_of_rust(&other), code_of_rust(&rust), "{name}");
        assert_eq!(code_of_rust(&other_kick), code_of_rust(&kick), "{name}");
        for (one, other) in plain.iter().zip(&hostile) {
            assert_eq!(code_of_c(other), code_of_c(one), "{name}");
            assert!(other.is_ascii() && !other.contains("??"), "{name}");
        }
        for text in [&other, &other_kick] {
            assert!(!text.contains(['\u{202e}', '\u{2066}', '\u{2028}', '\r', '\0']), "{name}");
            syn::parse_file(text).unwrap();
        }
        // As the command writes it, with names from the system's.
        let integrator = own_algebra(&name);
        let own = RustOptions::for_problem(&integrator.problem.name);
        let module = syn::parse_file(&file(items(&integrator, &own))).unwrap();
        assert_eq!(module.items.len(), syn::parse_file(&rust).unwrap().items.len(), "{name}");
        assert!(own.name != "Self" && own.name != "T");
    }
}

/// Names of parameters are words, and so may be keywords and macros; C and C++ are compiled, Rust is parsed.
#[test]
fn kept_parameters_may_have_any_name() {
    let long = "n".repeat(10_000);
    let names = "NAN NULL M_PI INFINITY I DBL_MAX EOF errno bool class double fn self Self T type async step parameters \
        map h x' x_ Ω ⓐ _ __ main";
    let names: Vec<&str> = names.split(' ').chain([long.as_str()]).collect();
    let sum: Vec<String> = names.iter().map(|name| format!("{name}*mu[0]")).collect();
    let values: Vec<String> =
        names.iter().enumerate().map(|(i, name)| format!("{} = {i}", quoted(name))).collect();
    let text = format!(
        "group = \"SO3\"\nhamiltonian = \"mu[1]^2 + {}\"\npotential = \"{}\"\n[parameters]\n{}\n\
         [integrator]\ntruncation = 3",
        sum.join(" + "),
        sum.join(" + ").replace("mu[0]", "g[0][0]"),
        values.join("\n")
    );
    let system = kept(&text);
    let kick = Kick::build(system.potential.unwrap().0);
    for name in ["plain", "double", "NULL", "Self"] {
        let mut problem = system.problem.clone();
        problem.name = name.to_owned();
        let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
        let style = RustOptions::for_problem(name);
        let rust = file(items(&integrator, &style)) + &potential_items(&kick, &style);
        syn::parse_file(&rust).unwrap();
        let folder = scratch(&format!("quoting_{name}"));
        for (language, compiler, flags, ending) in
            [(Language::C, "gcc", FLAGS_C, "c"), (Language::Cpp, "g++", FLAGS_CPP, "cpp")]
        {
            let options =
                HeaderOptions { prefix: name.to_owned(), language, ..HeaderOptions::default() };
            let header = c::header(&Origin::from(integrator.clone()), &options).unwrap();
            std::fs::write(folder.join("header.h"), header).unwrap();
            let source = folder.join(format!("main.{ending}"));
            let before = ["complex.h", "errno.h", "math.h", "stddef.h", "stdio.h"];
            let before = before.iter().filter(|one| ending == "c" || **one != "complex.h");
            let mut main: String = before.map(|one| format!("#include <{one}>\n")).collect();
            main.push_str("#include \"header.h\"\nint main(void) { return 0; }\n");
            std::fs::write(&source, main).unwrap();
            if let Some(compiler) = Tool::find(compiler) {
                compiler.check(&flags, &source, true);
            }
        }
    }
}
