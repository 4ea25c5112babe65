//! The radius up to which a series is trusted: headers of C find the runtime's.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

use coadjoint::plumbing::radius_of;
use coadjoint_codegen::emit::c::{HeaderOptions, header};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::system::{Options, read};

const SYSTEMS: [&str; 3] = [
    include_str!("../../examples/rigid_body.toml"),
    include_str!("../../examples/heavy_top.toml"),
    include_str!("../../examples/three_wave.toml"),
];

const STEPS: [f64; 4] = [0.01, 0.1, 0.73, -0.2];

/// The runtime's radius.
fn radius(integrator: &Integrator, step: f64) -> f64 {
    let coefficients = &integrator.coefficients;
    let parts = coefficients.fold_parts(step, &[]);
    let truncation = integrator.problem.truncation;
    let last = coefficients.last_orders(truncation);
    radius_of(
        truncation,
        last.map(|(part, order, base)| {
            (parts[part], order, coefficients.monomials()[base].as_slice())
        }),
    )
}

#[test]
fn headers_trust_a_series_as_far_as_the_runtime() {
    if !Command::new("gcc").arg("--version").output().is_ok_and(|out| out.status.success()) {
        assert!(std::env::var_os("COADJOINT_REQUIRE_TOOLS").is_none(), "gcc is missing");
        eprintln!("no gcc: nothing was compared");
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c_radius");
    std::fs::create_dir_all(&folder).unwrap();
    for (number, text) in SYSTEMS.iter().enumerate() {
        for truncation in [1, 3, 5] {
            let options = Options { truncation: Some(truncation), ..Options::default() };
            let problem = read(text, options).unwrap().problem;
            let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
            let style = HeaderOptions { prefix: "system".into(), ..HeaderOptions::default() };
            let steps = STEPS.map(|step| format!("{step:?}")).join(", ");
            let main = format!(
                "{}\n#include <stdio.h>\nint main(void)\n{{\n    static const double steps[4] = {{{steps}}};\n    \
                 system_map map;\n    uint32_t i;\n    for (i = 0u; i < 4u; i++) {{\n        (void)system_init(&map, \
                 steps[i]);\n        printf(\"%.17g\\n\", map.c[SYSTEM_COEFFICIENTS - 1u]);\n    }}\n    return 0;\n}}\n",
                header(&integrator, &style).unwrap()
            );
            let source = folder.join(format!("{number}-{truncation}.c"));
            std::fs::write(&source, main).unwrap();
            let program = source.with_extension("bin");
            let compiler = Command::new("gcc")
                .args(["-std=c99", "-O1", "-o"])
                .args([&program, &source])
                .arg("-lm")
                .output()
                .unwrap();
            assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));
            let printed =
                String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
            let found: Vec<f64> = printed.lines().map(|line| line.parse().unwrap()).collect();
            let wanted = STEPS.map(|step| radius(&integrator, step));
            for (found, wanted) in found.iter().zip(wanted) {
                let square = wanted * wanted;
                assert!(
                    *found == square || (found / square - 1.0).abs() < 1e-12,
                    "{} K = {truncation}: {found} for {square}",
                    integrator.problem.name
                );
                assert_eq!(truncation == 1, square.is_infinite(), "{square}");
            }
            assert_eq!(found.len(), STEPS.len());
        }
    }
}
