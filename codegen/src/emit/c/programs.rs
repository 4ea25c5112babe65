//! The programs of a step as functions of C, and the loop that calls them, that of
//! [`coadjoint_program::Stepper::advance`].

use coadjoint_program::print::{Field, LoopStyle, Signature, function, signatures, steps};
use coadjoint_program::{Graph, Program};

use crate::emit::c::dialect::{Portable, decimal};
use crate::emit::c::fold::Folding;
use crate::emit::c::names::Names;
use crate::emit::c::template::{CLOCK_OF_STEP, INVERT, timed};
use crate::step::Step;

/// Operations of a function at most: compilers allot registers in a time that grows faster than its length.
const LONGEST: usize = 1000;

/// Some outputs of the program that watches a state, as a program of μ alone, which is all that Casimirs are of.
fn watched(step: &Step, outputs: std::ops::Range<usize>) -> Program {
    let kernel = step.kernel();
    let (n, m) = (kernel.dim, kernel.element);
    let graph = Graph::new();
    let mut inputs = vec![graph.zero(); m];
    inputs.extend((0..n).map(|i| graph.input(i)));
    let all = graph.call(&kernel.programs.watch, &inputs);
    graph.finish(n, all.get(outputs).unwrap_or(&[]))
}

/// The energy: of μ, or with a potential of g and μ.
fn energy(step: &Step) -> Program {
    let kernel = step.kernel();
    if kernel.flows().is_none() {
        return watched(step, 0..1);
    }
    let inputs = kernel.element + kernel.dim;
    let graph = Graph::new();
    let state: Vec<_> = (0..inputs).map(|i| graph.input(i)).collect();
    let all = graph.call(&kernel.programs.watch, &state);
    graph.finish(inputs, all.get(..1).unwrap_or(&[]))
}

pub(super) fn casimirs(step: &Step) -> usize {
    step.kernel().programs.watch.outputs().len().saturating_sub(1)
}

/// All programs, and what they need.
pub(super) fn functions(step: &Step, fold: &Folding, names: &Names) -> String {
    let kernel = step.kernel();
    let dialect = Portable::new(names, fold.places.clone());
    let prefix = format!("{}_internal_", names.lower);
    let (n, m) = (kernel.dim, kernel.element);
    let mut text = String::new();
    if !step.inverted().is_empty() {
        text.push_str(&names.fill(INVERT));
    }
    let mut print = |about: &str, signature: &Signature<'_>| {
        text.push_str(&format!("\n/* Internal: {about}. */\n"));
        text.push_str(&function(&dialect, signature, LONGEST));
    };
    for signature in signatures(kernel, &prefix) {
        let about = match signature.name.strip_prefix(&prefix).unwrap_or_default() {
            "guess" => "mu to a first guess of p, and constants of the solve",
            "correct" => "one correction of p",
            "accept" => "1 where a step is right",
            "transport" => "the state moved by the increment x",
            "frame" => "the state moved on by the comoving frame",
            "kick" => "mu kicked by the torque of the potential",
            _ => "1 where a state is finite and on the group",
        };
        print(about, &signature);
    }
    let array = Field::array;
    let program = &kernel.programs.matrix;
    let (inputs, outputs) = (vec![array("g", m)], vec![array("matrix", program.outputs().len())]);
    let name = |name: &str| format!("{prefix}{name}");
    let signature = Signature { name: name("matrix"), program, inputs, outputs };
    print("the matrix of a group element", &signature);
    let (energy, count) = (energy(step), casimirs(step));
    let mu = || vec![array("mu", n)];
    let outputs = vec![Field::number("energy")];
    let inputs = if kernel.flows().is_some() { vec![array("g", m), array("mu", n)] } else { mu() };
    print("the energy", &Signature { name: name("energy"), program: &energy, inputs, outputs });
    if count > 0 {
        let program = &watched(step, 1..1 + count);
        let outputs = vec![array("casimirs", count)];
        let signature = Signature { name: name("casimirs"), program, inputs: mu(), outputs };
        print("the Casimirs", &signature);
    }
    let inputs = vec![array("g", m), array("back", m), array("mu", n)];
    let outputs = vec![array("spatial", n)];
    let program = &step.spatial();
    let signature = Signature { name: name("spatial"), program, inputs, outputs };
    print("the spatial momentum", &signature);
    text
}

pub(super) fn drive(step: &Step, fold: &Folding, names: &Names) -> String {
    let kernel = step.kernel();
    let of = if kernel.flows().is_some() { "&c[flow * @P@_COEFFICIENTS]" } else { "c" };
    let refused_step = REFUSED_STEP.replace("(c,", &format!("({of},"));
    let style = LoopStyle {
        prefix: "@p@_internal_".into(),
        count: "uint32_t".into(),
        sizes: ["@P@_ELEMENT", "@P@_DIMENSION"].map(String::from),
        copy: "@p@_internal_copy".into(),
        live: "status == @P@_OK".into(),
        open: "@p@_internal_open(residual_bound, distance)".into(),
        right: "right > 0.5".into(),
        slots_of_flow: "@P@_COEFFICIENTS".into(),
        refuse: [refused_step, REFUSED_STATE.into()],
        clock: kernel.clock().map_or("", |_| CLOCK_OF_STEP).into(),
        ..LoopStyle::default()
    };
    let dialect = Portable::new(names, fold.places.clone());
    let drive = DRIVE.replace("/*STEPS*/", &steps(kernel, &dialect, &style, 4));
    let text = timed(&drive, step)
        .replace("/*TOLERANCE*/", &decimal(kernel.tolerance))
        .replace("/*NEAR*/", &decimal(kernel.near));
    names.fill(&text)
}

const REFUSED_STEP: &str = "status = @p@_internal_reason(c, mu, residual_bound, distance);";

const REFUSED_STATE: &str = "status = @P@_OFF_GROUP;
if ((!@p@_internal_finite(g, @P@_ELEMENT)) || (!@p@_internal_finite(mu, @P@_DIMENSION))) {
    status = @P@_NOT_FINITE;
}";

const DRIVE: &str = "
/* Internal: copies a list. */
static inline void @p@_internal_copy(double *to, const double *from, uint32_t length)
{
    uint32_t i;
    for (i = 0u; i < length; i++) {
        to[i] = from[i];
    }
}

/*CLOCK*//* Internal: whether an equation is corrected again: not solved, and near the first guess. */
static inline bool @p@_internal_open(double residual_bound, double distance)
{
    return (!(residual_bound <= /*TOLERANCE*/)) && (distance <= /*NEAR*/);
}

/* Internal: why a step was not accepted. */
static inline @p@_status @p@_internal_reason(const double *c, const double *mu,
    double residual_bound, double distance)
{
    @p@_status status = @P@_BEYOND_CHART;
    double square = 0.0;
    uint32_t i;
    for (i = 0u; i < @P@_DIMENSION; i++) {
        square = @P@_FMA(mu[i], mu[i], square);
    }
    if (!@p@_internal_finite(mu, @P@_DIMENSION)) {
        status = @P@_NOT_FINITE;
    } else if (!(square <= c[@P@_COEFFICIENTS - 1u])) {
        status = @P@_BEYOND_SERIES;
    } else if ((!(residual_bound <= /*TOLERANCE*/)) || (!(distance <= /*NEAR*/))) {
        status = @P@_NOT_SOLVED;
    } else {
        /* What is left is the chart. */
    }
    return status;
}

/**
 * Makes `steps` steps of the size that the map was made for, and tells in `made` how many it has made.
/*ABOUT_TIME*/ *
 * Returns @P@_OK where that is all of them. Else the state is that after the last step made, finite and as good
 * as any other, and the status says why the next step was refused: see @p@_status.
 * The state is looked at every @P@_BLOCK steps and at the end; where it is found broken, it is that of the last look.
 */
static inline @p@_status @p@_advance(const @p@_map *map, @p@_state *state/*TIME*/, uint32_t steps,
    uint32_t *made)
{
    /* A step solves its equation by corrections: p from the first guess on, x, a bound on the residual, and the
     * distance from the guess, both relative to the largest coordinate of the momentum. */
    /*COEFFICIENTS*/;
    double g[@P@_ELEMENT];
    double mu[@P@_DIMENSION];
    @p@_status status = map->status;
/*BEGIN*/    @p@_internal_copy(g, state->g, @P@_ELEMENT);
    @p@_internal_copy(mu, state->mu, @P@_DIMENSION);
/*STEPS*/    @p@_internal_copy(state->g, g, @P@_ELEMENT);
    @p@_internal_copy(state->mu, mu, @P@_DIMENSION);
    *made = done;
    return status;
}

/**
 * Makes one step/*FROM*/. Where it is refused, the state stays as it was, and the status says why: see @p@_status.
 */
static inline @p@_status @p@_step(const @p@_map *map, @p@_state *state/*TIME*/)
{
    uint32_t made = 0u;
    return @p@_advance(map, state/*NOW*/, 1u, &made);
}
";
