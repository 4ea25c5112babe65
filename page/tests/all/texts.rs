//! Copied code describes the system on the screen.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::io::Write;
use std::process::{Command, Stdio};

use coadjoint_codegen::emit;
use coadjoint_codegen::system::{Options, read};
use coadjoint_page::gallery::gallery;
use coadjoint_page::system::System;
use coadjoint_page::texts::text;

fn systems() -> impl Iterator<Item = (&'static str, System)> {
    gallery().into_iter().map(|entry| (entry.id, System::new(&entry.fields).unwrap()))
}

#[test]
fn the_system_file_is_the_system() {
    for (id, system) in systems() {
        let copied = read(&text(&system, "file").unwrap(), Options::default()).unwrap();
        assert_eq!(copied.problem.hamiltonian, system.integrator.problem.hamiltonian, "{id}");
        assert_eq!(copied.run.momentum.unwrap(), system.momentum, "{id}");
        assert_eq!(copied.run.step, Some(system.h), "{id}");
    }
}

/// The module that the build script writes has the type whose steps the program makes.
#[test]
fn the_copied_program_calls_what_its_build_script_writes() {
    for (id, system) in systems() {
        let copied = text(&system, "rust").unwrap();
        syn::parse_file(&copied).unwrap_or_else(|error| panic!("{id}: {error}\n{copied}"));
        let options = emit::Options::for_problem(&system.integrator.problem.name);
        let name = &options.name;
        assert!(copied.contains(&format!("::{name}::new({:?})", system.h)), "{id}:\n{copied}");
        if ["wing-nut", "heisenberg-spin-ring"].contains(&id) {
            let written = emit::items(&system.integrator, &options).struct_and_methods;
            assert!(written.to_string().contains(&format!("pub struct {name} <")), "{id}");
        }
    }
}

#[test]
fn the_copied_header_is_c99() {
    for (id, system) in
        systems().filter(|(id, _)| ["wing-nut", "heavy-top", "heisenberg-spin-ring"].contains(id))
    {
        let header = text(&system, "c").unwrap();
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
        text(&system, "python").unwrap(),
        "import coadjoint as ca\n\nbody = ca.System(\n    \"SO3\",\n    \"x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)\",\n    \
         coordinates=\"x y z\",\n    parameters=dict(I1=1.0, I2=2.0, I3=2.6),\n    truncation=7,\n)\n\
         run = body.simulate(momentum=[0.03, 2.5, 0.02], time=60.0, step=0.1)\n"
    );
}
