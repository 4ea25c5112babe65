//! The operations of a step's programs, for systems on all kinds of groups: a formula that is moved or rewritten must not
//! cost more.
//!
//! `COADJOINT_BLESS=1 cargo test -p coadjoint-tests --test all operations` rewrites the table.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_codegen::system::{Options, read_either};
use coadjoint_program::{Node, Precision, Program};
use coadjoint_tests::kernels;
use coadjoint_tests::sources::{golden, read};

/// The kernel of a system file of `examples`, in this chart if one is given.
fn example(name: &str, chart: Option<&str>) -> Step {
    let mut text = read(&format!("examples/{name}.toml"));
    if let Some(chart) = chart {
        text = text.replace("[integrator]", &format!("[integrator]\nchart = {chart:?}"));
    }
    let problem = read_either(&text, Options::default(), &[]).unwrap().problem;
    Origin::derive(problem, TermLimit::default()).unwrap().step(Precision::Double).unwrap()
}

/// The kernel of a product of groups with closed forms and one by tables.
fn product() -> Step {
    let hamiltonian = "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + g^2/9 + h^2/10 + a*d/9";
    Step::build(&kernels::integrator("SU2*SE2*Aff1", hamiltonian, "exponential", 5)).unwrap()
}

/// A system: its name, its step and the operations that the step had.
type Row = (&'static str, fn() -> Step, usize);

/// Systems, their kernels, and the operations of all programs at commit 4621d748; steps of smooth Hamiltonians measure their
/// reach since, up to the end by the group's action, with its exponentials cut where these are 0, and count their sweeps, and those on SE(3) with Cayley's map compare torques and forces in a unit of length.
const SYSTEMS: [Row; 14] = [
    ("rigid body", || example("rigid_body", None), 539),
    ("heavy top", || example("heavy_top", None), 2003),
    ("Kirchhoff", || example("kirchhoff_body", None), 2127),
    ("gyrostat", || example("gyrostat", None), 987),
    ("so(4)", || example("manakov_so4", None), 8730),
    ("su(3)", || example("su3_quadratic", None), 18409),
    ("ring", || example("heisenberg_spin_ring", None), 4284),
    ("comoving", || example("lagrange_top", None), 1445),
    ("Cayley, SO(3)", || example("gyrostat", Some("cayley")), 912),
    ("Cayley, SE(3)", || example("kirchhoff_body", Some("cayley")), 2013 + 11),
    ("Cayley, so(4)", || example("manakov_so4", Some("cayley")), 3439),
    ("√ body", || example("relativistic_body", None), 1573 + 110 + 24 + 3),
    ("six variables", || example("screened_top", None), 3475 + 93 + 16 + 27 + 3),
    ("product", product, 2553),
];

/// The operations of a program, signs left out, since sums and fused products take either sign.
fn operations(program: &Program) -> usize {
    let counts = |node: &&Node| node.is_operation() && !matches!(node, Node::Neg(_) | Node::Abs(_));
    program.nodes().iter().filter(counts).count()
}

#[test]
fn no_step_takes_more_operations_than_it_did() {
    let mut table = format!(
        "{:<14} {:>7} {:>7} {:>7} {:>9} {:>7} {:>7} {:>9}\n",
        "system", "guess", "correct", "accept", "transport", "frame", "all", "at most"
    );
    let mut grown = Vec::new();
    for (name, step, before) in SYSTEMS {
        let step = step();
        let programs = &step.kernel().programs;
        let frame = programs.frame.as_ref().map_or(0, operations);
        let [guess, correct, accept, transport] =
            [&programs.guess, &programs.correct, &programs.accept, &programs.transport]
                .map(operations);
        let all = guess + correct + accept + transport + frame;
        writeln!(
            table,
            "{name:<14} {guess:>7} {correct:>7} {accept:>7} {transport:>9} {frame:>7} {all:>7} {before:>9}"
        )
        .unwrap();
        grown.extend((all > before).then_some(name));
    }
    golden("operations.txt", &table);
    assert!(grown.is_empty(), "more operations than at 4621d748: {grown:?}");
}
