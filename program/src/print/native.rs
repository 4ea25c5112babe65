//! A kernel as a unit of C for this machine: the loop of a trajectory, and that of lanes side by side.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;

use super::c::C;
use super::function::function;
use super::template::fill;
use super::vectors::Vectors;
use crate::kernel::{Kernel, Trajectories, WIDTH};
use crate::print::c::signatures;
use crate::print::steps::{LoopStyle, steps};
use crate::schedule::{Test, Variable};

/// The version of what [`native_unit`] exports. It changes with the loop, the functions' parameters and the meaning of
/// the array of sizes.
pub const ABI: u64 = 2;

/// Operations of a step up to which its programs become part of the loop of one trajectory: the calls are then worth
/// the compiler's time.
const INLINED: usize = 1500;

/// Operations of a function at most: registers are allotted in a time that grows faster than its length.
const LONGEST: usize = 1000;

/// A unit of C that exports, the functions where they are asked for,
///
/// - `coadjoint_advance`: (slots, g, μ, steps, report) ↦ steps made, as [`Stepper::advance`](crate::Stepper::advance); the report is the largest
///   number of corrections and the largest residual;
/// - `coadjoint_advance_lanes`: (slots, g, μ, steps, live, steps made), as [`Stepper::advance_lanes`](crate::Stepper::advance_lanes);
/// - `coadjoint_sizes`: [`ABI`], n, m and the number of folded coefficients.
///
/// It asks for GNU C (GCC 10, Clang 10 or later), no header and, where the processor has fused products, no library. It
/// computes the bits of the interpreter where the compiler contracts nothing (`-ffp-contract=off`).
pub fn native_unit(kernel: &Kernel, trajectories: Trajectories) -> String {
    let calls = String::from("static __attribute__((noinline)) void");
    let total: usize = signatures(kernel, "").map(|one| one.program.cost().total()).sum();
    let head = if total <= INLINED { C::default().head } else { calls.clone() };
    let [fma, sqrt, abs, rint, ..] = C::default().functions.map(|name| format!("__builtin_{name}"));
    let functions = [fma, sqrt, abs, rint, "scaled_one".into(), "exponent_one".into()];
    let scalar = C { head, functions, ..C::default() };
    let lanes = Vectors(C {
        head: calls,
        number: "V".into(),
        functions: ["fused", "root", "size", "nearest", "scaled", "exponent"].map(String::from),
        ..C::default()
    });
    let literal = |value| C::default().literal(value);
    let mut values = vec![
        ("DIM", kernel.dim.to_string()),
        ("ELEMENT", kernel.element.to_string()),
        ("TOLERANCE", literal(kernel.tolerance)),
        ("NEAR", literal(kernel.near)),
        ("SLOTS", kernel.slots().to_string()),
        ("SLOTS_OF_FLOW", kernel.slots_of_flow().to_string()),
        ("WIDTH", WIDTH.to_string()),
        ("ABI", ABI.to_string()),
    ];
    if trajectories.one() {
        let functions = signatures(kernel, "scalar_")
            .map(|signature| format!("\n{}", function(&scalar, &signature, LONGEST)));
        let style = LoopStyle {
            note: "noted(&most, &residual, tried, residual_bound);".into(),
            ..LoopStyle::default()
        };
        let steps = steps(kernel, &scalar, &style, 4);
        values.extend([("SCALAR", functions.collect()), ("SCALAR_STEPS", steps)]);
    }
    if trajectories.lanes() {
        let functions = signatures(kernel, "lanes_")
            .map(|signature| format!("\n{}", function(&lanes, &signature, LONGEST)));
        let style = LoopStyle {
            prefix: "lanes_".into(),
            declare: ["V", "unsigned int", "M"].map(String::from),
            as_number: ["__builtin_convertvector(", ", V)"].map(String::from),
            in_lanes: ["update", "pick", "any"].map(String::from),
            // Flows are counted for all lanes together.
            of_lanes: |test| !matches!(test, Test::Below(Variable::Flow, _)),
            open: "~(M)(residual_bound <= spread(TOLERANCE)) & (M)(distance <= spread(NEAR))"
                .into(),
            right: ["right != spread(1.0)", "right == spread(1.0)"].map(String::from),
            ..LoopStyle::default()
        };
        let steps = steps(kernel, &lanes, &style, 8);
        values.extend([("LANES", functions.collect()), ("LANES_STEPS", steps)]);
    }
    fill(include_str!("native.c.in"), &values)
}
