//! `cargo run -p coadjoint-tests --bin mutants [-- PART OF A NAME]`
//!
//! Takes out, one after another, conditions and constants by which steps are accepted, in a copy of the source tree, and
//! runs the tests that must notice: `runtime/tests/acceptance.rs`, `symbolic/tests/all/acceptance.rs`. Prints a table;
//! ends with 1 where a mutant is missed that is not known to be equivalent. The copy and its build lie in
//! `target/mutants`.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

const ACCEPT: &str = "runtime/src/solve/accept.rs";
const CANDIDATE: &str = "runtime/src/solve/candidate.rs";
const CONTINUATION: &str = "runtime/src/solve/continuation.rs";
const NEWTON: &str = "runtime/src/solve/newton.rs";
const FIXED_POINT: &str = "runtime/src/solve/fixed_point.rs";
const RATE: &str = "runtime/src/solve/rate.rs";
const BY_HAND: &str = "runtime/src/step/mod.rs";
const LIMITS: &str = "program/src/limits.rs";
const KERNEL: &str = "symbolic/src/step/programs.rs";
const SOLVING: &str = "symbolic/src/step/solving.rs";
const PART: &str = "symbolic/src/step/part.rs";
const ROTATION: &str = "symbolic/src/step/rotation.rs";
const INTEGRATOR: &str = "symbolic/src/integrator/mod.rs";

/// A change of the source, and why no test can notice it, where that is so.
struct Mutant {
    name: &'static str,
    file: &'static str,
    from: &'static str,
    to: &'static str,
    equivalent: Option<&'static str>,
}

const fn mutant(
    name: &'static str,
    file: &'static str,
    from: &'static str,
    to: &'static str,
) -> Mutant {
    Mutant { name, file, from, to, equivalent: None }
}

const fn equivalent(mutant: Mutant, why: &'static str) -> Mutant {
    Mutant { equivalent: Some(why), ..mutant }
}

const MUTANTS: &[Mutant] = &[
    // The generic step.
    mutant(
        "generic: nearness ignored",
        ACCEPT,
        "candidate.is_solution_within(NEAR)",
        "candidate.is_solution_within(1e9)",
    ),
    mutant("generic: branch ignored", CANDIDATE, "self.branch != Branch::Unknown && ", ""),
    mutant("generic: nearness times 10", LIMITS, "NEAR: f64 = 0.05", "NEAR: f64 = 0.5"),
    mutant(
        "generic: rounding times 1000",
        CANDIDATE,
        "(4.0 * dim as f64).min(32.0)",
        "4000.0 * dim as f64",
    ),
    mutant("generic: momentum zero", CANDIDATE, "f32::MIN_POSITIVE", "0.0_f32"),
    mutant(
        "generic: Newton, residual ignored",
        NEWTON,
        "if residual.simd_le(rounding).all() {",
        "if iterations > 1 {",
    ),
    mutant(
        "generic: Newton, corrections may grow",
        NEWTON,
        "SHRINKS: f64 = 0.25",
        "SHRINKS: f64 = 25.0",
    ),
    mutant("generic: Newton, bends ignored", NEWTON, "BENDS: f64 = 0.25", "BENDS: f64 = 25.0"),
    mutant(
        "generic: Newton, few iterations",
        NEWTON,
        "MAX_ITERATIONS: u32 = 20",
        "MAX_ITERATIONS: u32 = 3",
    ),
    mutant(
        "generic: everything contracts",
        NEWTON,
        "sum + product(j).simd_abs()).simd_lt(one).all()",
        "sum + product(j).simd_abs()).simd_lt(one).all() || i < dim",
    ),
    mutant(
        "generic: everything is oriented",
        NEWTON,
        "false if is_oriented::<S>(dim, derivative, jacobian)",
        "false if dim > 0 || is_oriented::<S>(dim, derivative, jacobian)",
    ),
    mutant(
        "generic: factors ignored",
        NEWTON,
        "k + 1 == end && !positive",
        "k + 1 == dim && !positive",
    ),
    mutant("generic: exchanges ignored", NEWTON, "positive = !positive;", ""),
    mutant(
        "generic: fixed point, residual ignored",
        FIXED_POINT,
        "if found.residual.simd_le(rounding).all() {",
        "if found.iterations > 0 {",
    ),
    mutant(
        "generic: fixed point, few evaluations",
        FIXED_POINT,
        "MAX_EVALUATIONS: u32 = 60",
        "MAX_EVALUATIONS: u32 = 6",
    ),
    mutant(
        "generic: fixed point, an exact guess",
        FIXED_POINT,
        "DISTURBANCE: f64 = 1e-6",
        "DISTURBANCE: f64 = 0.0",
    ),
    mutant(
        "generic: never followed",
        ACCEPT,
        "if candidate.branch == Branch::Only {",
        "if mu.dim() > 0 {",
    ),
    mutant(
        "generic: chart ignored",
        ACCEPT,
        "if extent.simd_le(ScalarOf::<S>::of(1.0)).all() {",
        "if extent.simd_le(ScalarOf::<S>::of(1e9)).all() {",
    ),
    mutant(
        "generic: rate ignored",
        ACCEPT,
        "of_terms.worse(estimated_ratio(generating, mu, &candidate.x))",
        "of_terms",
    ),
    mutant(
        "generic: ratio ignored",
        ACCEPT,
        "select(within, generating.series_ratio(&p))",
        "select(within, ScalarOf::<S>::of(0.0))",
    ),
    mutant(
        "generic: radius ignored",
        ACCEPT,
        "mu.pairing(mu).simd_le(radius * radius)",
        "mu.pairing(mu).simd_lt(ScalarOf::<S>::of(0.0) * radius)",
    ),
    mutant(
        "generic: ratio times 10",
        LIMITS,
        "LARGEST_RATIO: f64 = 0.5",
        "LARGEST_RATIO: f64 = 5.0",
    ),
    mutant(
        "generic: momenta that are not finite",
        ACCEPT,
        "any(|i| !mu[i].all_finite())",
        "any(|i| i > mu.dim())",
    ),
    mutant(
        "generic: lanes are followed",
        ACCEPT,
        "<ScalarOf<S> as SimdValue>::LANES > 1 {",
        "<ScalarOf<S> as SimdValue>::LANES > 8 {",
    ),
    mutant("generic: rate without the Hessian", RATE, "two * (identity", "(two - two) * (identity"),
    mutant(
        "generic: rate of a half turn times 10",
        LIMITS,
        "RATE_OF_HALF_TURN: f64 = 4.0",
        "RATE_OF_HALF_TURN: f64 = 40.0",
    ),
    mutant(
        "generic: distance of a refused step ignored",
        BY_HAND,
        "candidate.moved += distance;",
        "let _ = distance;",
    ),
    mutant(
        "generic: shortest stretch times 1000",
        CONTINUATION,
        "SHORTEST: f64 = 1.0 / 1024.0",
        "SHORTEST: f64 = 1.0",
    ),
    mutant(
        "generic: longest stretch times 10",
        CONTINUATION,
        "LONGEST: f64 = 0.25",
        "LONGEST: f64 = 2.5",
    ),
    mutant(
        "generic: long corrections of a stretch",
        CONTINUATION,
        "CORRECTED: f64 = 0.01",
        "CORRECTED: f64 = 0.05",
    ),
    // Kernels.
    mutant(
        "kernel: residual ignored",
        KERNEL,
        "vec![(residual_bound, tolerance), (distance, near), (extent, one)]",
        "vec![(distance, near), (extent, one)]",
    ),
    mutant(
        "kernel: nearness ignored",
        KERNEL,
        "vec![(residual_bound, tolerance), (distance, near), (extent, one)]",
        "vec![(residual_bound, tolerance), (extent, one)]",
    ),
    mutant("kernel: a sixth of a turn times 10", PART, "= 1.0 / 3.0", "= 10.0 / 3.0"),
    mutant(
        "kernel: no series with a radius",
        KERNEL,
        "[group.estimated(), ESTIMATED]",
        "[group.estimated(), group.estimated()]",
    ),
    mutant(
        "kernel: a quarter turn times 10",
        ROTATION,
        "ESTIMATED } else { 0.5 }",
        "ESTIMATED } else { 5.0 }",
    ),
    mutant(
        "kernel: radius ignored",
        KERNEL,
        "tests.extend(squares.into_iter().map(|square| (square, radius)));",
        "let _ = squares;",
    ),
    mutant(
        "kernel: factors ignored",
        SOLVING,
        "factors.into_iter().map(|own| dot(graph, &mu[own.clone()], &mu[own])).collect()",
        "factors.into_iter().take(1).map(|own| dot(graph, &mu[own.clone()], &mu[own])).collect()",
    ),
    mutant(
        "kernel: rate ignored",
        SOLVING,
        "relative = graph.select(rate, most, relative, far);",
        "let _ = (rate, most, far);",
    ),
    mutant(
        "kernel: rate without the Hessian",
        SOLVING,
        "let two = graph.constant(2.0);\n    let mut z",
        "let two = graph.constant(0.0);\n    let mut z",
    ),
    mutant(
        "kernel: rate by the fixed point ignored",
        KERNEL,
        "share.min(most)",
        "share.min(most + 1.0)",
    ),
    mutant("kernel: rate of K = 1", INTEGRATOR, "[0.95, 1.9, 3.0]", "[9.5, 1.9, 3.0]"),
    mutant("kernel: rate of K = 3", INTEGRATOR, "[0.95, 1.9, 3.0]", "[0.95, 19.0, 3.0]"),
    mutant("kernel: rate of K = 5", INTEGRATOR, "[0.95, 1.9, 3.0]", "[0.95, 1.9, 30.0]"),
    mutant(
        "kernel: rate where the series ends",
        INTEGRATOR,
        "|| !problem.learned && !is_first_whole(&problem, table)",
        "|| !problem.learned || is_first_whole(&problem, table)",
    ),
    mutant("kernel: roundings times 1000", SOLVING, "ROUNDINGS: f64 = 4.0", "ROUNDINGS: f64 = 4e3"),
    mutant("kernel: trusted times 1000", SOLVING, "TRUSTED: f64 = 1e-3", "TRUSTED: f64 = 1.0"),
    mutant("kernel: few corrections", SOLVING, "CORRECTIONS: u32 = 12", "CORRECTIONS: u32 = 1"),
    mutant("kernel: few evaluations", SOLVING, "EVALUATIONS: u32 = 60", "EVALUATIONS: u32 = 6"),
    mutant(
        "kernel: rounding of many coordinates times 1000",
        SOLVING,
        "(ROUNDINGS_EACH * n as f64).clamp(ROUNDINGS, MOST_ROUNDINGS)",
        "1e3 * ROUNDINGS_EACH * n as f64",
    ),
    mutant(
        "kernel: what the Hessian leaves out",
        SOLVING,
        "let half = graph.mul(half, scale);\n        bound = graph.mul(half, bound);",
        "let half = graph.mul(half, scale);\n        bound = graph.sub(half, half);",
    ),
    mutant(
        "kernel: Newton's curvature",
        SOLVING,
        "let curved = graph.times_plus(half, stretch, bend);",
        "let curved = graph.sub(half, half);",
    ),
    mutant(
        "kernel: the chord's curvature",
        SOLVING,
        "let curved = graph.times_plus(four, bend, curved);",
        "let curved = graph.sub(four, four);",
    ),
    equivalent(
        mutant(
            "kernel: the matrices of a chord's own place",
            SOLVING,
            "let far = graph.add(first_stretch, stretch);",
            "let far = graph.sub(stretch, stretch);",
        ),
        "the other parts of the bound suffice: residuals after a chord reach 0.53 of them on eleven systems, 0.39 with this part",
    ),
    mutant(
        "kernel: curvature of a series that is no square",
        SOLVING,
        "return graph.constant(1.0);",
        "return graph.constant(0.0);",
    ),
    mutant(
        "kernel: NaN of the fixed point",
        SOLVING,
        "let bound = graph.add(bound, rest);",
        "let _ = rest;",
    ),
    equivalent(
        mutant(
            "kernel: a correction below rounding",
            SOLVING,
            "graph.select(relative, tolerance, rounded, bound)",
            "graph.select(relative, tolerance, bound, bound)",
        ),
        "nothing more is accepted; the estimate of what such a correction leaves is larger where ‖Hess S‖ |μ| > 10⁷ alone",
    ),
];

impl Mutant {
    /// The text of its file in this tree, and the same changed.
    fn change(&self, tree: &Path) -> Result<(String, String), String> {
        let Self { name, file, from, to, .. } = self;
        let text = std::fs::read_to_string(tree.join(file));
        let text = text.map_err(|error| format!("{file}: {error}"))?;
        if text.matches(from).count() != 1 {
            return Err(format!("{name}: {file} has not exactly one {from:?}"));
        }
        let changed = text.replace(from, to);
        Ok((text, changed))
    }
}

/// The files that a build needs, copied.
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

/// Whether they pass.
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
    let chosen: Vec<&Mutant> = MUTANTS.iter().filter(|mutant| mutant.name.contains(only)).collect();
    for file in [ACCEPT, KERNEL] {
        let asked = chosen.iter().any(|mutant| tests(mutant.file) == tests(file));
        if asked && !passes(&tree, file)? {
            return Err(format!("the tests of {file} fail without a change"));
        }
    }
    let mut good = true;
    for mutant in chosen {
        let (text, changed) = mutant.change(&tree)?;
        let Mutant { name, file, equivalent, .. } = mutant;
        let path = tree.join(file);
        let write =
            |text: &str| std::fs::write(&path, text).map_err(|error| format!("{file}: {error}"));
        write(&changed)?;
        let missed = passes(&tree, file);
        write(&text)?;
        let verdict = match (missed?, equivalent) {
            (false, _) => "noticed".to_owned(),
            (true, Some(why)) => format!("equivalent: {why}"),
            (true, None) => {
                good = false;
                "MISSED".to_owned()
            }
        };
        println!("{name:<32} {verdict}");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mutant_changes_the_sources() {
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let wrong: Vec<String> = MUTANTS.iter().filter_map(|m| m.change(root).err()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}
