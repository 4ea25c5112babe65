//! Copied code describes the system on the screen.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::Write;
use std::process::{Command, Stdio};

use coadjoint_codegen::parse::rust;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::{Options, read};
use coadjoint_page::gallery::gallery;
use coadjoint_page::system::System;
use coadjoint_page::texts::{Language, text};
use syn::{Item, Meta};

fn systems() -> impl Iterator<Item = (&'static str, System)> {
    gallery().into_iter().map(|entry| (entry.id, System::new(&entry.fields).unwrap()))
}

/// H at a point, for these values of the parameters.
fn energy(problem: &Problem, parameters: &[f64], point: &[f64]) -> f64 {
    let symbols = problem.symbols.iter().map(|symbol| symbol.expr.evaluate(parameters));
    let variables: Vec<f64> = point.iter().copied().chain(symbols).collect();
    problem.hamiltonian.evaluate(&variables)
}

#[test]
fn the_system_file_is_the_system() {
    for (id, system) in systems() {
        let copied = read(&text(&system, Language::File).unwrap(), Options::default()).unwrap();
        assert_eq!(copied.problem.hamiltonian, system.integrator.problem.hamiltonian, "{id}");
        assert_eq!(copied.run.momentum.unwrap(), system.momentum, "{id}");
        assert_eq!(copied.run.step, Some(system.h), "{id}");
    }
}

#[test]
fn the_attribute_reads_the_copied_function_as_the_same_hamiltonian() {
    for (id, system) in systems() {
        let copied = text(&system, Language::Rust).unwrap();
        let file =
            syn::parse_file(&copied).unwrap_or_else(|error| panic!("{id}: {error}\n{copied}"));
        let function = file.items.iter().find_map(|item| match item {
            Item::Fn(function) => {
                function.attrs.iter().find_map(|attribute| match &attribute.meta {
                    Meta::List(list) if list.path.is_ident("lie_poisson") => {
                        Some((list.tokens.clone(), function.clone()))
                    }
                    _ => None,
                })
            }
            _ => None,
        });
        let (arguments, function) = function.unwrap_or_else(|| panic!("{id}:\n{copied}"));
        let read = rust::lie_poisson(arguments, &function).unwrap_or_else(|mistakes| {
            panic!("{id}: {}\n{copied}", mistakes.render("copied", &copied))
        });
        let kept = system.with_names().unwrap_or_else(|| system.integrator.problem.clone());
        assert_eq!(read.algebra.structure(), kept.algebra.structure(), "{id}");
        assert_eq!(
            (read.truncation, read.chart, read.comoving.is_some()),
            (kept.truncation, kept.chart, kept.comoving.is_some()),
            "{id}"
        );
        let values: Vec<f64> = kept
            .parameters
            .iter()
            .flat_map(|parameter| parameter.default.clone().unwrap())
            .map(|x| num_traits::ToPrimitive::to_f64(&x).unwrap())
            .collect();
        for seed in 1..4 {
            let point: Vec<f64> =
                (0..system.dim()).map(|i| ((seed * 7 + i * 3) as f64).sin()).collect();
            let (a, b) = (energy(&read, &values, &point), energy(&kept, &values, &point));
            assert!((a - b).abs() <= 1e-13 * b.abs().max(1.0), "{id}: {a} and {b}\n{copied}");
        }
    }
}

#[test]
fn the_copied_header_is_c99() {
    for (id, system) in
        systems().filter(|(id, _)| ["wing-nut", "heavy-top", "heisenberg-spin-ring"].contains(id))
    {
        let header = text(&system, Language::C).unwrap();
        assert!(header.contains(&format!("{}_step(", id.replace('-', "_"))), "{id}");
        let mut compiler = Command::new("cc")
            .args([
                "-std=c99",
                "-pedantic",
                "-Wall",
                "-Wextra",
                "-Werror",
                "-fsyntax-only",
                "-x",
                "c",
                "-",
            ])
            .stdin(Stdio::piped())
            .spawn()
            .unwrap();
        compiler.stdin.take().unwrap().write_all(header.as_bytes()).unwrap();
        assert!(compiler.wait().unwrap().success(), "{id}");
    }
}

#[test]
fn python_names_the_system_and_its_parameters() {
    let (_, system) = systems().next().unwrap();
    assert_eq!(
        text(&system, Language::Python).unwrap(),
        "import coadjoint as ca\n\nbody = ca.System(\n    \"SO3\",\n    \"x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)\",\n    \
         coordinates=\"x y z\",\n    parameters=dict(I1=1.0, I2=2.0, I3=2.6),\n    truncation=7,\n)\n\
         run = body.simulate(momentum=[0.03, 2.5, 0.02], time=60.0, step=0.1)\n"
    );
}
