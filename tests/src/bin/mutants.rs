//! `cargo run -p coadjoint-tests --bin mutants [-- PART OF A NAME]`
//!
//! Takes out, one after another, conditions and constants by which steps are accepted, in a copy of the source tree, and
//! runs the tests that must notice: `runtime/tests/acceptance.rs`, `symbolic/tests/all/acceptance.rs`. Prints a table;
//! ends with 1 where a mutant is missed that is not known to be equivalent. The copy and its build lie in
//! `target/mutants`.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

const ACCEPT: &str = "runtime/src/solve/accept.rs";
const CONFIRM: &str = "runtime/src/solve/confirm.rs";
const CONTINUATION: &str = "runtime/src/solve/continuation.rs";
const NEWTON: &str = "runtime/src/solve/newton.rs";
const RATE: &str = "runtime/src/solve/rate.rs";
const FOLD: &str = "program/src/fold.rs";
const KERNEL: &str = "symbolic/src/step/programs.rs";
const SOLVING: &str = "symbolic/src/step/solving.rs";

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

const MUTANTS: [Mutant; 24] = [
    mutant(
        "residual ignored",
        ACCEPT,
        "candidate.residual.simd_le(settings.tolerance()) & candidate.moved",
        "candidate.moved",
    ),
    equivalent(
        mutant("nearness ignored", ACCEPT, " & candidate.moved.simd_le(T::of(NEAR))", ""),
        "every method of solution stops where it has moved that far, with what is left above the tolerance",
    ),
    mutant(
        "nearness times 10",
        "runtime/src/solve/candidate.rs",
        "const NEAR: f64 = 0.05",
        "const NEAR: f64 = 0.5",
    ),
    mutant(
        "a sixth of a turn times 10",
        ACCEPT,
        "OF_OTHERS: f64 = 1.0 / 3.0",
        "OF_OTHERS: f64 = 10.0 / 3.0",
    ),
    mutant(
        "a quarter turn times 10",
        "runtime/src/group/so3.rs",
        "ESTIMATED: f64 = 0.5",
        "ESTIMATED: f64 = 5.0",
    ),
    mutant("radius ignored", ACCEPT, " & within & follows", " & follows"),
    mutant(
        "rate ignored",
        ACCEPT,
        "of_terms.worse(estimated_ratio(generating, mu, x))",
        "of_terms",
    ),
    mutant("rate ignored at once", ACCEPT, " & within & follows", " & within"),
    mutant("rate without the Hessian", RATE, "two * (identity", "(two - two) * (identity"),
    mutant("ratio times 10", FOLD, "LARGEST_RATIO: f64 = 0.5", "LARGEST_RATIO: f64 = 5.0"),
    mutant(
        "chart ignored",
        ACCEPT,
        "if !extent.simd_le(ScalarOf::<S>::of(1.0)).all() {",
        "if false {",
    ),
    mutant(
        "momenta that are not finite",
        ACCEPT,
        "if (0..mu.dim()).any(|i| !mu[i].all_finite()) {",
        "if false {",
    ),
    mutant(
        "one lane is enough",
        ACCEPT,
        "if accept(generating, mu, &candidate, settings).all() {",
        "if accept(generating, mu, &candidate, settings).any() {",
    ),
    mutant(
        "confirm off",
        CONFIRM,
        "if mu.dim() > LARGEST {\n        return Ok(candidate);",
        "if mu.dim() > 0 {\n        return Ok(candidate);",
    ),
    mutant("everything is exact", CONFIRM, "exact: exact.all()", "exact: exact.all() || true"),
    mutant(
        "everything contracts",
        CONFIRM,
        "contracts: contracts.all()",
        "contracts: contracts.all() || true",
    ),
    mutant("the same times 10⁶", CONFIRM, "SAME: f64 = 1e-6", "SAME: f64 = 1.0"),
    mutant(
        "orientation ignored",
        CONTINUATION,
        "if solved && keeps_orientation(generating, mu, &found.x, scale) {",
        "if solved {",
    ),
    mutant(
        "shortest stretch times 1000",
        CONTINUATION,
        "SHORTEST: f64 = 1.0 / 1024.0",
        "SHORTEST: f64 = 1.0",
    ),
    mutant("trusted times 1000", NEWTON, "TRUSTED: f64 = 1e-3", "TRUSTED: f64 = 1.0"),
    mutant(
        "kernel: residual ignored",
        KERNEL,
        "vec![(left, tolerance), (way, near), (extent, one)]",
        "vec![(way, near), (extent, one)]",
    ),
    mutant("kernel: nearness times 10", KERNEL, "const NEAR: f64 = 0.05", "const NEAR: f64 = 0.5"),
    mutant(
        "kernel: radius ignored",
        KERNEL,
        "tests.extend(squares.into_iter().map(|square| (square, radius)));",
        "let _ = (squares, radius);",
    ),
    mutant(
        "kernel: rate ignored",
        SOLVING,
        "relative = graph.select(rate, most, relative, far);",
        "let _ = (rate, most, far);",
    ),
];

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

/// Whether the tests of the crate that owns this file pass.
fn passes(tree: &Path, file: &str) -> Result<bool, String> {
    let arguments = match !file.starts_with("symbolic/") {
        true => [
            "-p",
            "coadjoint",
            "--no-default-features",
            "--features",
            "std",
            "--test",
            "acceptance",
        ]
        .to_vec(),
        false => vec!["-p", "coadjoint-symbolic", "--test", "all", "acceptance"],
    };
    let status = Command::new("cargo")
        .arg("test")
        .args(arguments)
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
    for file in [ACCEPT, KERNEL] {
        if !passes(&tree, file)? {
            return Err(format!("the tests of {file} fail without a change"));
        }
    }
    let mut good = true;
    for Mutant { name, file, from, to, equivalent } in &MUTANTS {
        if !name.contains(only) {
            continue;
        }
        let path = tree.join(file);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{file}: {error}"))?;
        if text.matches(from).count() != 1 {
            return Err(format!("{name}: {file} has not exactly one {from:?}"));
        }
        let write =
            |text: &str| std::fs::write(&path, text).map_err(|error| format!("{file}: {error}"));
        write(&text.replace(from, to))?;
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
