//! A kernel as a unit of C for this machine: the loop of a trajectory, and that of lanes side by side.

use alloc::format;
use alloc::string::String;

use super::c::C;
use super::function::function;
use super::vectors::{PREAMBLE, Vectors};
use crate::kernel::{Kernel, Trajectories, WIDTH};
use crate::print::c::signatures;
use crate::print::steps::{LoopStyle, steps};

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
    let mut text =
        String::from("/* A step of a Lie-Poisson integrator, written by coadjoint. */\n");
    text.push_str(&sizes(kernel));
    text.push_str(PREAMBLE);
    if trajectories.one() {
        for signature in signatures(kernel, "scalar_") {
            text.push('\n');
            text.push_str(&function(&scalar, &signature, LONGEST));
        }
        let style = LoopStyle { note: SCALAR_NOTE.into(), ..LoopStyle::default() };
        text.push_str(&SCALAR.replace("/*STEPS*/", &steps(kernel, &scalar, &style, 4)));
    }
    if trajectories.lanes() {
        for signature in signatures(kernel, "lanes_") {
            text.push('\n');
            text.push_str(&function(&lanes, &signature, LONGEST));
        }
        let style = LoopStyle {
            prefix: "lanes_".into(),
            count: "M".into(),
            open: "~(M)(residual_bound <= spread(TOLERANCE)) & (M)(distance <= spread(NEAR))"
                .into(),
            right: "right == spread(1.0)".into(),
            ..LoopStyle::default()
        };
        text.push_str(&LANES.replace("/*STEPS*/", &steps(kernel, &lanes, &style, 8)));
    }
    text
}

/// The sizes as macros, those of arrays at least 1, and as an exported array.
fn sizes(kernel: &Kernel) -> String {
    let (n, m) = (kernel.dim, kernel.element);
    let (tolerance, near) = (kernel.tolerance, kernel.near);
    let literal = |value| C { suffix: String::new(), ..C::default() }.literal(value);
    let array = |length: usize| length.max(1);
    format!(
        "#define bool _Bool\n#define true 1\n#define false 0\n\
         #define NAN __builtin_nan(\"\")\n\
         #define INFINITY __builtin_inf()\n\
         #define EXPORT __attribute__((visibility(\"default\")))\n\
         #define DIM {n}\n#define ELEMENT {m}\n\
         #define DIM_ARRAY {}\n#define ELEMENT_ARRAY {}\n\
         #define TOLERANCE {}\n#define NEAR {}\n#define SLOTS {}\n\
         #define WIDTH {WIDTH}\n\
         EXPORT const unsigned long long coadjoint_sizes[4] = {{{ABI}, {n}, {m}, {}}};\n",
        array(n),
        array(m),
        literal(tolerance),
        literal(near),
        kernel.slots_of_flow(),
        kernel.slots(),
    )
}

const SCALAR: &str = r"
EXPORT unsigned long long coadjoint_advance(const double *restrict c, double *restrict g_state,
    double *restrict mu_state, unsigned long long steps, double *restrict report)
{
    double g[ELEMENT_ARRAY], mu[DIM_ARRAY];
    bool live = true;
    unsigned long long most = 0;
    double residual = 0.0;
    copy(g, g_state, ELEMENT);
    copy(mu, mu_state, DIM);
/*STEPS*/    copy(g_state, g, ELEMENT);
    copy(mu_state, mu, DIM);
    report[0] = (double)most;
    report[1] = residual;
    return done;
}
";

const SCALAR_NOTE: &str = "if (most < tried) {
    most = tried;
}
if (residual < residual_bound) {
    residual = residual_bound;
}";

const LANES: &str = r"
EXPORT void coadjoint_advance_lanes(const double *restrict c, double *restrict g_state,
    double *restrict mu_state, unsigned long long asked, const unsigned char *restrict alive,
    unsigned long long *restrict total)
{
    for (int first = 0; first < WIDTH; first += W) {
        const M steps = counts(asked >> 63 ? 0x7fffffffffffffff : asked);
        V g[ELEMENT_ARRAY], mu[DIM_ARRAY];
        M live;
        for (int i = 0; i < W; i++) {
            live[i] = alive[first + i] ? -1 : 0;
        }
        for (int i = 0; i < ELEMENT; i++) {
            g[i] = load(g_state + i * WIDTH + first);
        }
        for (int i = 0; i < DIM; i++) {
            mu[i] = load(mu_state + i * WIDTH + first);
        }
/*STEPS*/        for (int i = 0; i < ELEMENT; i++) {
            store(g_state + i * WIDTH + first, g[i]);
        }
        for (int i = 0; i < DIM; i++) {
            store(mu_state + i * WIDTH + first, mu[i]);
        }
        for (int i = 0; i < W; i++) {
            total[first + i] = done[i];
        }
    }
}
";
