//! `cargo run -p coadjoint-tests --bin mutants [-- PART OF A PATH OR A TEXT]`
//!
//! Takes out, one after another, conditions and constants by which steps are accepted, in a copy of the source tree, and
//! runs the tests that must notice: `runtime/tests/acceptance.rs`, `symbolic/tests/all/acceptance.rs`. Prints a table;
//! ends with 1 where a mutant is missed that is not known to be equivalent. The copy and its build lie in
//! `target/mutants`.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// The changes tried in each file: a text that stands there once, and what takes its place.
const MUTANTS: &[(&str, &[[&str; 2]])] = &[
    (
        "runtime/src/solve/accept.rs",
        &[
            ["candidate.is_solution_within(NEAR)", "candidate.is_solution_within(1e9)"],
            ["if candidate.branch == Branch::Only {", "if mu.dim() > 0 {"],
            [
                "if extent.simd_le(ScalarOf::<S>::of(1.0)).all() {",
                "if extent.simd_le(ScalarOf::<S>::of(1e9)).all() {",
            ],
            ["of_terms.worse(estimated_ratio(generating, mu, &candidate.x))", "of_terms"],
            [
                "select(within, generating.series_ratio(&p))",
                "select(within, ScalarOf::<S>::of(0.0))",
            ],
            [
                "own.pairing(&own).simd_le(radius * radius)",
                "own.pairing(&own).simd_lt(ScalarOf::<S>::of(0.0) * radius)",
            ],
            ["any(|i| !mu[i].all_finite())", "any(|i| i > mu.dim())"],
            ["<ScalarOf<S> as SimdValue>::LANES > 1 {", "<ScalarOf<S> as SimdValue>::LANES > 8 {"],
        ],
    ),
    (
        "runtime/src/solve/candidate.rs",
        &[
            ["self.branch != Branch::Unknown && ", ""],
            ["(4.0 * dim as f64).min(32.0)", "4000.0 * dim as f64"],
            ["f32::MIN_POSITIVE", "0.0_f32"],
        ],
    ),
    (
        "program/src/limits.rs",
        &[
            ["NEAR: f64 = 0.05", "NEAR: f64 = 0.5"],
            ["LARGEST_RATIO: f64 = 0.5", "LARGEST_RATIO: f64 = 5.0"],
            ["RATE_OF_HALF_TURN: f64 = 4.0", "RATE_OF_HALF_TURN: f64 = 40.0"],
        ],
    ),
    (
        "runtime/src/solve/newton.rs",
        &[
            ["if residual.simd_le(rounding).all() {", "if iterations > 1 {"],
            ["SHRINKS: f64 = 0.25", "SHRINKS: f64 = 25.0"],
            ["BENDS: f64 = 0.25", "BENDS: f64 = 25.0"],
            ["MAX_ITERATIONS: u32 = 20", "MAX_ITERATIONS: u32 = 3"],
            [
                "sum + product(j).simd_abs()).simd_lt(one).all()",
                "sum + product(j).simd_abs()).simd_lt(one).all() || i < dim",
            ],
            [
                "false if is_oriented::<S>(dim, derivative, jacobian)",
                "false if dim > 0 || is_oriented::<S>(dim, derivative, jacobian)",
            ],
            ["k + 1 == end && !positive", "k + 1 == dim && !positive"],
            ["positive = !positive;", ""],
        ],
    ),
    (
        "runtime/src/solve/fixed_point.rs",
        &[
            ["if found.residual.simd_le(rounding).all() {", "if found.iterations > 0 {"],
            ["MAX_EVALUATIONS: u32 = 60", "MAX_EVALUATIONS: u32 = 6"],
            ["DISTURBANCE: f64 = 1e-6", "DISTURBANCE: f64 = 0.0"],
        ],
    ),
    ("runtime/src/solve/accept.rs", &[["two * (identity", "(two - two) * (identity"]]),
    ("runtime/src/step/mod.rs", &[["candidate.moved += distance;", "let _ = distance;"]]),
    (
        "runtime/src/solve/continuation.rs",
        &[
            ["SHORTEST: f64 = 1.0 / 1024.0", "SHORTEST: f64 = 1.0"],
            ["LONGEST: f64 = 0.25", "LONGEST: f64 = 2.5"],
            ["CORRECTED: f64 = 0.01", "CORRECTED: f64 = 0.05"],
        ],
    ),
    (
        "runtime/src/collocation/following.rs",
        &[
            ["LEAST: [u32; 2] = [1, 4]", "LEAST: [u32; 2] = [0, 0]"],
            ["MOST: u32 = 7", "MOST: u32 = 1"],
            ["LARGEST_DIFFERENCE: f64 = 0.1", "LARGEST_DIFFERENCE: f64 = 10.0"],
            ["cold || attempt.sweeps > CLOSURE_SWEEPS", "attempt.sweeps > CLOSURE_SWEEPS"],
            ["within(attempt, f64::from(attempt.sweeps), ordinary_sweeps(dim))?;", ""],
            ["CLOSURE_SWEEPS: u32 = 8", "CLOSURE_SWEEPS: u32 = 1000"],
            ["within(attempt, square, LARGEST_REACH[M - 1])?;", ""],
            ["within(attempt, square, LARGEST_REACH[M - 1])\n", "Ok(())\n"],
            ["self.follow(attempt, &moved.1)?;", ""],
            ["(time(0.5), end.clone())", "last.clone()"],
            [
                "if made.is_ok() || most == 0 {\n                return made;",
                "if most == 0 {\n                return self.resolve(&attempt).map(|((_, end), _)| end);\n            }\n            if made.is_ok() {\n                return made;",
            ],
            ["unwrap_or(0.0)", "unwrap_or(f64::INFINITY)"],
        ],
    ),
    (
        "symbolic/src/step/programs.rs",
        &[
            [
                "vec![(residual_bound, tolerance), (distance, near), (extent, one)]",
                "vec![(distance, near), (extent, one)]",
            ],
            [
                "vec![(residual_bound, tolerance), (distance, near), (extent, one)]",
                "vec![(residual_bound, tolerance), (extent, one)]",
            ],
            ["[group.estimated(), ESTIMATED]", "[group.estimated(), group.estimated()]"],
            [
                "tests.extend(squares.into_iter().map(|square| (square, radius)));",
                "let _ = squares;",
            ],
            ["share.min(most)", "share.min(most + 1.0)"],
        ],
    ),
    ("symbolic/src/step/product.rs", &[["= 1.0 / 3.0", "= 10.0 / 3.0"]]),
    ("symbolic/src/step/rotation.rs", &[["ESTIMATED } else { 0.5 }", "ESTIMATED } else { 5.0 }"]]),
    (
        "symbolic/src/step/solving.rs",
        &[
            [
                "factors.into_iter().map(|own| dot(graph, &mu[own.clone()], &mu[own])).collect()",
                "factors.into_iter().take(1).map(|own| dot(graph, &mu[own.clone()], &mu[own])).collect()",
            ],
            [
                "relative = graph.select(rate, most, relative, graph.constant(f64::from(f32::MAX)));",
                "let _ = (rate, most);",
            ],
            [
                "let two = graph.constant(2.0);\n    let mut z",
                "let two = graph.constant(0.0);\n    let mut z",
            ],
            ["ROUNDINGS: f64 = 4.0", "ROUNDINGS: f64 = 4e3"],
            ["TRUSTED: f64 = 1e-3", "TRUSTED: f64 = 1.0"],
            ["CORRECTIONS: u32 = 12", "CORRECTIONS: u32 = 1"],
            ["EVALUATIONS: u32 = 60", "EVALUATIONS: u32 = 6"],
            [
                "(ROUNDINGS_EACH * n as f64).clamp(ROUNDINGS, MOST_ROUNDINGS)",
                "1e3 * ROUNDINGS_EACH * n as f64",
            ],
            [
                "bound = graph.mul(graph.mul(graph.constant(0.5), scale), bound);",
                "bound = graph.sub(scale, scale);",
            ],
            [
                "let curved = graph.times_plus(graph.constant(0.5), stretch, bend);",
                "let curved = graph.sub(bend, bend);",
            ],
            [
                "let curved = graph.times_plus(four, bend, graph.times_plus(two, far, slope));",
                "let curved = graph.sub(four, four);",
            ],
            [
                "let far = graph.add(first_stretch, stretch);",
                "let far = graph.sub(stretch, stretch);",
            ],
            ["return graph.constant(1.0);", "return graph.constant(0.0);"],
            ["let bound = graph.add(bound, finite(&graph, &twice));", ""],
            [
                "graph.select(relative, tolerance, graph.min(bound, relative), bound)",
                "graph.select(relative, tolerance, bound, bound)",
            ],
        ],
    ),
    (
        "symbolic/src/integrator/mod.rs",
        &[
            ["[0.95, 1.9, 3.0]", "[9.5, 1.9, 3.0]"],
            ["[0.95, 1.9, 3.0]", "[0.95, 19.0, 3.0]"],
            ["[0.95, 1.9, 3.0]", "[0.95, 1.9, 30.0]"],
            [
                "|| !problem.learned && !is_first_whole(&problem, table)",
                "|| !problem.learned || is_first_whole(&problem, table)",
            ],
        ],
    ),
];

/// Mutants that no test can notice, each with the reason.
const EQUIVALENT: &[[&str; 2]] = &[
    [
        "let far = graph.add(first_stretch, stretch);",
        "the other parts of the bound suffice: residuals after a chord reach 0.53 of them on eleven systems, 0.39 with this part",
    ],
    [
        "graph.select(relative, tolerance, rounded, bound)",
        "nothing more is accepted; the estimate of what such a correction leaves is larger where ‖Hess S‖ |μ| > 10⁷ alone",
    ],
];

/// The text of a file of this tree with one of its changes made.
fn change(tree: &Path, file: &str, [from, to]: [&str; 2]) -> Result<String, String> {
    let text = std::fs::read_to_string(tree.join(file));
    let text = text.map_err(|error| format!("{file}: {error}"))?;
    match text.matches(from).count() {
        1 => Ok(text.replace(from, to)),
        _ => Err(format!("{file} has not exactly one {from:?}")),
    }
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let listed = Command::new("git").args(["ls-files", "-z"]).current_dir(from).output();
    let listed = listed.map_err(|error| format!("git: {error}"))?.stdout;
    for name in String::from_utf8_lossy(&listed).split('\0').filter(|name| !name.is_empty()) {
        let (source, target) = (from.join(name), to.join(name));
        if !source.is_file() {
            continue;
        }
        let folder = target.parent().unwrap_or(to);
        let same = std::fs::read(&source).ok() == std::fs::read(&target).ok();
        let made = std::fs::create_dir_all(folder).and_then(|()| match same {
            true => Ok(0),
            false => std::fs::copy(&source, &target),
        });
        made.map_err(|error| format!("{name}: {error}"))?;
    }
    Ok(())
}

/// The tests that judge this file: those of kernels, or of the generic step, which shares its limits with them.
fn tests(file: &str) -> &'static str {
    match file.starts_with("symbolic/") {
        true => "-p coadjoint-symbolic --features judge --test all acceptance",
        false => "-p coadjoint --no-default-features --features std --test acceptance",
    }
}

fn passes(tree: &Path, file: &str) -> Result<bool, String> {
    let status = Command::new("cargo")
        .arg("test")
        .args(tests(file).split(' '))
        .current_dir(tree)
        .env("CARGO_TARGET_DIR", tree.with_file_name("build"))
        .env("RUSTFLAGS", "-A warnings")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    Ok(status.map_err(|error| format!("cargo: {error}"))?.success())
}

fn run(only: &str) -> Result<bool, String> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let tree = root.join("target/mutants/tree");
    copy(&root, &tree)?;
    let all = MUTANTS.iter().flat_map(|(file, changes)| changes.iter().map(move |c| (file, c)));
    all.into_iter().try_for_each(|(file, c)| change(&root, file, *c).map(drop))?;
    let (mut good, mut tried) = (true, "");
    for &(file, changes) in MUTANTS {
        let chosen = |[from, _]: &&[&str; 2]| file.contains(only) || from.contains(only);
        let chosen: Vec<_> = changes.iter().filter(chosen).collect();
        if !chosen.is_empty() && tests(file) != tried {
            tried = tests(file);
            if !passes(&tree, file)? {
                return Err(format!("the tests of {file} fail without a change"));
            }
        }
        for &&[from, to] in &chosen {
            let path = tree.join(file);
            let write = |text: &str| {
                std::fs::write(&path, text).map_err(|error| format!("{file}: {error}"))
            };
            let text = change(&tree, file, [from, from])?;
            write(&change(&tree, file, [from, to])?)?;
            let missed = passes(&tree, file);
            write(&text)?;
            let known = EQUIVALENT.iter().find(|known| known[0] == from);
            good &= !missed.clone()? || known.is_some();
            let verdict = match (missed?, known) {
                (false, _) => "noticed".to_owned(),
                (true, Some([_, why])) => format!("equivalent: {why}"),
                (true, None) => "MISSED".to_owned(),
            };
            println!("{file}: {from:?} -> {to:?}: {verdict}");
        }
    }
    Ok(good)
}

fn main() -> ExitCode {
    match run(&std::env::args().nth(1).unwrap_or_default()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
