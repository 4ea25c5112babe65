//! Headers of C: the committed ones are what is written now, compilers have nothing to say about them, and they compute
//! the interpreter's bits.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-codegen --test all c_header` rewrites the files. A tool that is missing leaves
//! its part out, with a line that says so; with `COADJOINT_REQUIRE_TOOLS` set it fails.
#![allow(clippy::unwrap_used, clippy::panic)]

mod systems;

use crate::tools::{self, FLAGS_C, FLAGS_CPP, Tool, scratch};
use coadjoint_codegen::emit::c::Language;
use coadjoint_program::Stepper;
use num_traits::ToPrimitive;
use systems::Built;

/// Steps of a run: more than a block.
const STEPS: u64 = 300;

/// The time at which a run begins, where the Hamiltonian depends on it.
const TIME: f64 = 0.3;

#[test]
fn headers_are_the_committed_ones() {
    for built in systems::all().iter().filter(|built| !built.system.large) {
        if built.system.golden {
            systems::check_golden(&format!("tests/golden/{}", built.file), &built.header);
        }
        assert_eq!(Built::new(built.system).header, built.header, "{}", built.system.name);
    }
}

/// The numbers that a line of the program's output has.
fn numbers(output: &str, what: &str, which: usize) -> Vec<f64> {
    let line = output.lines().filter(|line| line.split(' ').next() == Some(what)).nth(which);
    let line = line.unwrap_or_else(|| panic!("no `{what}` in\n{output}"));
    let bits = line.split(' ').skip(1).map(|word| u64::from_str_radix(word, 16).unwrap());
    bits.map(f64::from_bits).collect()
}

fn bits(list: &[f64]) -> Vec<u64> {
    list.iter().map(|value| value.to_bits()).collect()
}

/// The interpreter's results for the same: coefficients, end state, energies.
fn compare(built: &Built, output: &str) {
    let name = built.system.name;
    let step = &built.programs;
    let kernel = step.kernel();
    let parameters = built.parameters.iter();
    let values = parameters.flat_map(|parameter| parameter.default.clone().unwrap());
    let values: Vec<f64> = values.map(|value| value.to_f64().unwrap()).collect();
    let mut slots = step.fold(built.step, &values).unwrap();
    // Every coefficient is one of the interpreter's; the last is the square of the radius.
    let known = bits(&slots);
    let coefficients = numbers(output, "coefficients", 0);
    assert_eq!(
        coefficients.last().map(|value| value.to_bits()),
        Some(known[step.radius_at()]),
        "{name}"
    );
    for value in coefficients {
        assert!(known.contains(&value.to_bits()), "{name}: {value} is no coefficient");
    }
    let mut g = numbers(output, "identity", 0);
    let mut mu = built.momentum.clone();
    step.set_time(&mut slots, built.step, TIME);
    let watched = kernel.watch(&slots, &g, &mu);
    assert_eq!(bits(&numbers(output, "energy", 0)), bits(&watched[..1]), "{name}");
    if watched.len() > 1 {
        assert_eq!(bits(&numbers(output, "casimirs", 0)), bits(&watched[1..]), "{name}");
    }
    let (pieces, each) = if step.moves() { (STEPS, 1) } else { (1, STEPS) };
    for piece in 0..pieces {
        step.set_time(&mut slots, built.step, TIME + piece as f64 * built.step);
        let outcome = kernel.advance(&slots, &mut g, &mut mu, each);
        assert_eq!(outcome.steps, each, "{name}: refused");
    }
    step.set_time(&mut slots, built.step, TIME);
    let watch = |g: &[f64], mu: &[f64]| kernel.watch(&slots, g, mu);
    assert!(output.contains(&format!("\nadvance 0 {STEPS}\n")), "{name}:\n{output}");
    assert_eq!(bits(&numbers(output, "g", 0)), bits(&g), "{name}: g");
    assert_eq!(bits(&numbers(output, "mu", 0)), bits(&mu), "{name}: mu");
    assert_eq!(bits(&numbers(output, "energy", 1)), bits(&watch(&g, &mu)[..1]), "{name}");
    let matrix = kernel.programs.matrix.run(&g, &[]);
    assert_eq!(bits(&numbers(output, "matrix", 0)), bits(&matrix), "{name}: matrix");
    // The spatial momentum is conserved, and at the identity it is the body's.
    let (before, after) = (numbers(output, "spatial", 0), numbers(output, "spatial", 1));
    let size = mu.iter().fold(1.0_f64, |size, entry| size.max(entry.abs()));
    for i in 0..before.len() {
        assert!((before[i] - built.momentum[i]).abs() <= 1e-15 * size, "{name}: {before:?}");
        let kept = (before[i] - after[i]).abs() < 1e-13 * size;
        assert!(kept || kernel.flows().is_some(), "{name}: {before:?} {after:?}");
    }
    assert!(
        (0..mu.len()).any(|i| (mu[i] - built.momentum[i]).abs() > 1e-3),
        "{name}: nothing moves"
    );
}

fn refusals(built: &Built, output: &str) {
    let name = built.system.name;
    let line = |start: &str| {
        let found = output.lines().find(|line| line.starts_with(&format!("{start} ")));
        found.unwrap_or_else(|| panic!("{name}: no {start}")).to_owned()
    };
    assert_eq!(line("init"), "init 0 fine", "{name}");
    assert_eq!(line("none"), "none 0 0 1", "{name}");
    assert_eq!(line("step"), "step 0 0", "{name}");
    let large = line("large");
    let refused = ["large 5 0 1", "large 6 0 1", "large 7 0 1"].contains(&large.as_str());
    // Velocities of bodies with a root are bounded, however large their momentum is.
    let bounded = ["relativistic_body", "kicked_root"].contains(&name);
    assert!(refused || bounded, "{name}: {large}");
    assert_eq!(line("momentum"), "momentum 3 1", "{name}");
    assert_eq!(line("element"), "element 3 0 1", "{name}");
    // Quaternions are unit ones, matrices of compact groups orthogonal; others may be any.
    let element = if built.any_element { "group 0 3 0" } else { "group 4 0 1" };
    // The many flows of a step with kicks pull an element back onto the group before the state is checked.
    if built.programs.kernel().flows().is_none() {
        assert_eq!(line("group"), element, "{name}");
    }
    if built.programs.moves() {
        let expected = "time 3 1 a number of the state, or the time, is not finite";
        assert_eq!(line("time"), expected, "{name}");
    }
    assert_eq!(line("zero"), "zero 1 1 1", "{name}");
    assert_eq!(line("nan"), "nan 1 1", "{name}");
    if !built.parameters.is_empty() {
        assert_eq!(line("parameter"), "parameter 2 2", "{name}");
    }
}

/// The bits under sanitizers are those of optimised code, and both are the interpreter's.
#[test]
fn headers_have_the_bits_of_the_interpreter() {
    let Some(gcc) = Tool::find("gcc") else { return };
    for built in systems::all() {
        let system = built.system;
        let folder = scratch(&format!("bits-{}", system.name));
        let source = built.write_main(&folder);
        let compile = |options: &[&str], program: &str| {
            let program = folder.join(program);
            let mut flags = FLAGS_C.to_vec();
            flags.push("-ffp-contract=off");
            flags.extend(options);
            gcc.compile(&flags, &source, &program, &["-lm"]);
            tools::output(&program, &[])
        };
        let output = match system.language {
            Language::C => compile(&[if system.large { "-O0" } else { "-O2" }], "fast"),
            Language::Cpp => built.by_class(&folder),
        };
        let Some(output) = output.into_iter().next() else { continue };
        if system.language == Language::C && !system.large {
            let checked =
                ["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
            let expected = std::slice::from_ref(&output);
            assert_eq!(compile(&checked, "checked"), expected, "{}", system.name);
        }
        compare(built, &output);
        refusals(built, &output);
    }
}

#[test]
fn compilers_have_nothing_to_say() {
    for name in ["gcc", "clang"] {
        let Some(tool) = Tool::find(name) else { continue };
        for built in systems::all().iter().filter(|built| built.system.language == Language::C) {
            let folder = scratch(&format!("warnings-{name}-{}", built.system.name));
            tool.check(&FLAGS_C, &built.write_main(&folder), built.system.large);
        }
    }
    for name in ["g++", "clang++"] {
        let Some(tool) = Tool::find(name) else { continue };
        for built in systems::all() {
            let folder = scratch(&format!("warnings-{name}-{}", built.system.name));
            // A header in C compiles as C++ too.
            let source = built.write_main(&folder);
            let renamed = source.with_extension("cpp");
            std::fs::rename(&source, &renamed).unwrap();
            tool.check(&FLAGS_CPP, &renamed, built.system.large);
        }
    }
}

/// Rules of MISRA C:2012 that headers deviate from (docs/book/src/targets.md says why), and what is no rule: cppcheck supposes that
/// a matrix might have no rows.
const DEVIATIONS: [&str; 2] = ["misra-c2012-2.5", "uninitvar"];

#[test]
fn headers_follow_misra() {
    let Some(cppcheck) = Tool::find("cppcheck") else { return };
    for name in ["rigid_body", "cayley_body", "three_wave", "driven"] {
        let built = systems::all().iter().find(|built| built.system.name == name).unwrap();
        let folder = scratch(&format!("misra-{name}"));
        built.write_main(&folder);
        let unit = folder.join("unit.c");
        std::fs::write(&unit, format!("#include \"{}\"\n", built.file)).unwrap();
        let options = ["--addon=misra", "--std=c99", "--quiet", "--error-exitcode=1"];
        let deviations = DEVIATIONS.map(|rule| format!("--suppress={rule}"));
        let deviations = deviations.each_ref().map(String::as_str);
        cppcheck.run(&[&options[..], &deviations, &[unit.to_str().unwrap()]].concat());
    }
}

/// The example of `examples/c`: its header is what is written now; here and on an Arm core it has the same end.
#[test]
fn the_example_ends_alike_on_every_machine() {
    let built = systems::toutatis();
    systems::check_golden("examples/c/toutatis.h", &built.header);
    let example = systems::root().join("examples/c");
    let main = example.join("main.c");
    let folder = scratch("example");
    let mut found = Vec::new();
    if let Some(gcc) = Tool::find("gcc") {
        let program = folder.join("native");
        gcc.compile(&[&FLAGS_C[..], &["-O2"]].concat(), &main, &program, &["-lm"]);
        found.push(tools::output(&program, &[]).concat());
    }
    if let Some(clang) = Tool::find("clang") {
        let program = folder.join("clang");
        let flags = [&FLAGS_C[..], &["-O2", "-ffp-contract=off"]].concat();
        clang.compile(&flags, &main, &program, &["-lm"]);
        found.push(tools::output(&program, &[]).concat());
    }
    if let (Some(gcc), Some(arm)) =
        (Tool::find("aarch64-linux-gnu-gcc"), Tool::find("qemu-aarch64"))
    {
        let program = folder.join("arm");
        gcc.compile(&[&FLAGS_C[..], &["-O2", "-static"]].concat(), &main, &program, &["-lm"]);
        found.push(arm.run(&[program.to_str().unwrap()]));
    }
    if let Some(cmake) = Tool::find("cmake") {
        let build = folder.join("cmake");
        let build = build.to_str().unwrap();
        cmake.run(&["-S", example.to_str().unwrap(), "-B", build]);
        cmake.run(&["--build", build]);
        found.push(tools::output(&std::path::Path::new(build).join("toutatis"), &[]).concat());
    }
    for output in &found {
        assert!(output.starts_with("1460 steps: fine\n"), "{output}");
        assert_eq!(*output, found[0]);
    }
    let Some(output) = found.first() else { return };
    // The interpreter's end.
    let step = &built.programs;
    let slots = step.fold(built.step, &[]).unwrap();
    let (mut g, mut mu) = (vec![1.0, 0.0, 0.0, 0.0], built.momentum.clone());
    assert_eq!(step.kernel().advance(&slots, &mut g, &mut mu, 1460).steps, 1460);
    for (what, list) in [("attitude", g), ("momentum", mu)] {
        let line = output.lines().find_map(|line| line.strip_prefix(&format!("{what} "))).unwrap();
        let list: Vec<String> = list.iter().map(|&value| tools::hexadecimal(value)).collect();
        assert_eq!(line, list.join(" "), "{what}");
    }
}

#[test]
fn what_cannot_be_written_is_refused() {
    let refused = |text: &str, expected: &str| {
        let error = systems::attempt(text).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    };
    let names: Vec<String> = (0..15).map(|i| format!("c{i}")).collect();
    let squares: Vec<String> = (0..15).map(|i| format!("c{i}^2/{}", i + 3)).collect();
    let large = format!(
        "group = \"SU4\"\ncoordinates = {names:?}\nhamiltonian = \"{}\"\n[integrator]\ntruncation = 1\n",
        squares.join(" + ")
    );
    refused(&large, "more than the limit of 40000");
}
