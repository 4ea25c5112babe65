//! A kernel as a unit of C for the machine at hand: the loop of a trajectory, and that of lanes side by side.

use alloc::format;
use alloc::string::String;

use super::c::C;
use super::pieces::pieces;
use super::signature::{Signature, signatures};
use super::vectors::{PREAMBLE, Vectors};
use crate::kernel::{BLOCK, Kernel};
use crate::stepper::{Trajectories, WIDTH};

/// The version of what [`native_unit`] exports. It changes with the loop, the functions' parameters and the meaning of
/// the array of sizes.
pub const ABI: u64 = 1;

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
#[must_use]
pub fn native_unit(kernel: &Kernel, trajectories: Trajectories) -> String {
    let calls = String::from("static __attribute__((noinline)) void");
    let total: usize = driven(kernel, "").map(|one| one.program.cost().total()).sum();
    let head = if total <= INLINED { C::default().head } else { calls.clone() };
    let scalar = C { head, functions: builtins(), ..C::default() };
    let lanes = Vectors(C {
        head: calls,
        number: "V".into(),
        functions: ["fused", "root", "size", "nearest"].map(String::from),
        ..C::default()
    });
    let mut text =
        String::from("/* A step of a Lie-Poisson integrator, written by coadjoint. */\n");
    text.push_str(&sizes(kernel));
    text.push_str(PREAMBLE);
    let frame = kernel.programs().frame.is_some();
    if trajectories.one() {
        for signature in driven(kernel, "scalar_") {
            text.push('\n');
            text.push_str(&pieces(&scalar, &scalar, &signature, LONGEST));
        }
        text.push_str(&SCALAR.replace("/*FRAME*/", if frame { SCALAR_FRAME } else { "" }));
    }
    if trajectories.lanes() {
        for signature in driven(kernel, "lanes_") {
            text.push('\n');
            text.push_str(&pieces(&lanes, &lanes.0, &signature, LONGEST));
        }
        text.push_str(&LANES.replace("/*FRAME*/", if frame { LANES_FRAME } else { "" }));
    }
    text
}

/// The signatures of the programs that the loop calls.
fn driven<'a>(
    kernel: &'a Kernel,
    prefix: &'static str,
) -> impl Iterator<Item = Signature<'a>> + 'a {
    let watched = ["watch", "matrix"].map(|name| format!("{prefix}{name}"));
    signatures(kernel, prefix).into_iter().filter(move |one| !watched.contains(&one.name))
}

fn builtins() -> [String; 4] {
    ["fma", "sqrt", "fabs", "rint"].map(|name| format!("__builtin_{name}"))
}

/// The sizes as macros, those of arrays at least 1, and as an exported array.
fn sizes(kernel: &Kernel) -> String {
    let (n, m, k) = (kernel.dim(), kernel.element(), kernel.constants());
    let (tolerance, near) = (kernel.tolerance(), kernel.near());
    let literal = |value| C { suffix: String::new(), ..C::default() }.literal(value);
    let array = |length: usize| length.max(1);
    format!(
        "#define NAN __builtin_nan(\"\")\n\
         #define INFINITY __builtin_inf()\n\
         #define EXPORT __attribute__((visibility(\"default\")))\n\
         #define DIM {n}\n#define ELEMENT {m}\n\
         #define DIM_ARRAY {}\n#define ELEMENT_ARRAY {}\n#define CONSTANT_ARRAY {}\n\
         #define TOLERANCE {}\n#define NEAR {}\n#define CORRECTIONS {}u\n\
         #define BLOCK {BLOCK}ull\n#define WIDTH {WIDTH}\n\
         EXPORT const unsigned long long coadjoint_sizes[4] = {{{ABI}, {n}, {m}, {}}};\n",
        array(n),
        array(m),
        array(k),
        literal(tolerance),
        literal(near),
        kernel.corrections(),
        kernel.slots(),
    )
}

const SCALAR: &str = r"
EXPORT unsigned long long coadjoint_advance(const double *restrict c, double *restrict g_state,
    double *restrict mu_state, unsigned long long steps, double *restrict report)
{
    double g[ELEMENT_ARRAY], mu[DIM_ARRAY], x[DIM_ARRAY] = {0.0};
    double g_start[ELEMENT_ARRAY], mu_start[DIM_ARRAY];
    double g_next[ELEMENT_ARRAY], mu_next[DIM_ARRAY];
    unsigned long long done = 0;
    unsigned most = 0;
    double residual = 0.0, right;
    for (int i = 0; i < ELEMENT; i++) {
        g[i] = g_state[i];
    }
    for (int i = 0; i < DIM; i++) {
        mu[i] = mu_state[i];
    }
    while (done < steps) {
        const unsigned long long length = steps - done < BLOCK ? steps - done : BLOCK;
        unsigned long long made = 0;
        for (int i = 0; i < ELEMENT; i++) {
            g_start[i] = g[i];
        }
        for (int i = 0; i < DIM; i++) {
            mu_start[i] = mu[i];
        }
        while (made < length) {
            double p[DIM_ARRAY], p_next[DIM_ARRAY], k[CONSTANT_ARRAY];
            double left = 1.0, way = 0.0, moved;
            scalar_guess(c, mu, p, k);
            for (unsigned correction = 1; correction <= CORRECTIONS; correction++) {
                scalar_correct(c, p, mu, k, p_next, x, &left, &moved);
                for (int i = 0; i < DIM; i++) {
                    p[i] = p_next[i];
                }
                way = way + moved;
                if (most < correction) {
                    most = correction;
                }
                if (left <= TOLERANCE) {
                    if (residual < left) {
                        residual = left;
                    }
                    break;
                }
                if (!(way <= NEAR)) {
                    break;
                }
            }
            scalar_accept(c, mu, x, left, way, &right);
            if (!(right == 1.0)) {
                break;
            }
            scalar_transport(c, g, mu, x, g_next, mu_next);
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = g_next[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = mu_next[i];
            }
            made++;
        }
        if (made > 0) {
/*FRAME*/            scalar_sound(c, g, mu, &right);
            if (!(right == 1.0)) {
                for (int i = 0; i < ELEMENT; i++) {
                    g[i] = g_start[i];
                }
                for (int i = 0; i < DIM; i++) {
                    mu[i] = mu_start[i];
                }
                made = 0;
            }
        }
        done += made;
        if (made < length) {
            break;
        }
    }
    for (int i = 0; i < ELEMENT; i++) {
        g_state[i] = g[i];
    }
    for (int i = 0; i < DIM; i++) {
        mu_state[i] = mu[i];
    }
    report[0] = (double)most;
    report[1] = residual;
    return done;
}
";

const SCALAR_FRAME: &str = "            scalar_frame(c, g, mu, (double)made, g_next, mu_next);
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = g_next[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = mu_next[i];
            }
";

const LANES: &str = r"
EXPORT void coadjoint_advance_lanes(const double *restrict c, double *restrict g_state,
    double *restrict mu_state, unsigned long long steps, const unsigned char *restrict alive,
    unsigned long long *restrict total)
{
    for (int first = 0; first < WIDTH; first += W) {
        V g[ELEMENT_ARRAY], mu[DIM_ARRAY], x[DIM_ARRAY];
        V g_start[ELEMENT_ARRAY], mu_start[DIM_ARRAY];
        V g_next[ELEMENT_ARRAY], mu_next[DIM_ARRAY];
        V right;
        M live;
        unsigned long long done = 0;
        for (int i = 0; i < W; i++) {
            live[i] = alive[first + i] ? -1 : 0;
            total[first + i] = 0;
        }
        for (int i = 0; i < ELEMENT; i++) {
            g[i] = load(g_state + i * WIDTH + first);
        }
        for (int i = 0; i < DIM; i++) {
            mu[i] = load(mu_state + i * WIDTH + first);
            x[i] = spread(0.0);
        }
        while (done < steps && any(live)) {
            const unsigned long long length = steps - done < BLOCK ? steps - done : BLOCK;
            V made = spread(0.0);
            M stirred, broken;
            for (int i = 0; i < ELEMENT; i++) {
                g_start[i] = g[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu_start[i] = mu[i];
            }
            for (unsigned long long step = 0; step < length; step++) {
                V p[DIM_ARRAY], p_next[DIM_ARRAY], x_next[DIM_ARRAY], k[CONSTANT_ARRAY];
                V left = spread(1.0), way = spread(0.0), left_next, moved;
                M open = live;
                lanes_guess(c, mu, p, k);
                for (unsigned correction = 1; correction <= CORRECTIONS; correction++) {
                    lanes_correct(c, p, mu, k, p_next, x_next, &left_next, &moved);
                    for (int i = 0; i < DIM; i++) {
                        p[i] = pick(open, p_next[i], p[i]);
                        x[i] = pick(open, x_next[i], x[i]);
                    }
                    left = pick(open, left_next, left);
                    way = pick(open, way + moved, way);
                    open &= ~(M)(left <= spread(TOLERANCE)) & (M)(way <= spread(NEAR));
                    if (!any(open)) {
                        break;
                    }
                }
                lanes_accept(c, mu, x, left, way, &right);
                live &= (M)(right == spread(1.0));
                if (!any(live)) {
                    break;
                }
                made = pick(live, made + spread(1.0), made);
                lanes_transport(c, g, mu, x, g_next, mu_next);
                for (int i = 0; i < ELEMENT; i++) {
                    g[i] = pick(live, g_next[i], g[i]);
                }
                for (int i = 0; i < DIM; i++) {
                    mu[i] = pick(live, mu_next[i], mu[i]);
                }
            }
            stirred = (M)(made > spread(0.0));
/*FRAME*/            lanes_sound(c, g, mu, &right);
            broken = stirred & ~(M)(right == spread(1.0));
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = pick(broken, g_start[i], g[i]);
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = pick(broken, mu_start[i], mu[i]);
            }
            made = pick(broken, spread(0.0), made);
            live &= (M)(made == spread((double)length));
            for (int i = 0; i < W; i++) {
                total[first + i] += (unsigned long long)made[i];
            }
            done += length;
        }
        for (int i = 0; i < ELEMENT; i++) {
            store(g_state + i * WIDTH + first, g[i]);
        }
        for (int i = 0; i < DIM; i++) {
            store(mu_state + i * WIDTH + first, mu[i]);
        }
    }
}
";

const LANES_FRAME: &str = "            lanes_frame(c, g, mu, made, g_next, mu_next);
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = pick(stirred, g_next[i], g[i]);
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = pick(stirred, mu_next[i], mu[i]);
            }
";
