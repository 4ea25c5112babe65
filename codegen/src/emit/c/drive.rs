//! The loop of steps, that of [`coadjoint_program::Stepper::advance`].

use coadjoint_program::print::{LoopStyle, steps};

use super::dialect::{Portable, decimal};
use super::fold::Folding;
use super::names::Names;
use crate::step::Step;

/// The functions that make steps.
pub(super) fn functions(step: &Step, fold: &Folding, names: &Names) -> String {
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
        ..LoopStyle::default()
    };
    let dialect = Portable::new(names, fold.places.clone());
    let text = DRIVE
        .replace("/*STEPS*/", &steps(kernel, &dialect, &style, 4))
        .replace("/*TOLERANCE*/", &decimal(kernel.tolerance()))
        .replace("/*NEAR*/", &decimal(kernel.near()));
    names.fill(&text)
}

const REFUSED_STEP: &str = "status = @p@_internal_reason(c, mu, residual_bound, distance);";

const REFUSED_STATE: &str = "status = @P@_OFF_GROUP;
if ((!@p@_internal_finite(g, @P@_ELEMENT)) || (!@p@_internal_finite(mu, @P@_DIMENSION))) {
    status = @P@_NOT_FINITE;
}";

/// The loop of steps.
const DRIVE: &str = "
/* Internal: copies a list. */
static inline void @p@_internal_copy(double *to, const double *from, uint32_t length)
{
    uint32_t i;
    for (i = 0u; i < length; i++) {
        to[i] = from[i];
    }
}

/* Internal: whether an equation is corrected again: not solved, and near the first guess. */
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
 *
 * Returns @P@_OK where that is all of them. Else the state is that after the last step made, finite and as good
 * as any other, and the status says why the next step was refused: see @p@_status.
 * The state is looked at every @P@_BLOCK steps and at the end; where it is found broken, it is that of the last look.
 */
static inline @p@_status @p@_advance(const @p@_map *map, @p@_state *state, uint32_t steps,
    uint32_t *made)
{
    /* A step solves its equation by corrections: p from the first guess on, x, a bound on the residual, and the
     * distance from the guess, both relative to the largest coordinate of the momentum. */
    const double *c = map->c;
    double g[@P@_ELEMENT];
    double mu[@P@_DIMENSION];
    @p@_status status = map->status;
    @p@_internal_copy(g, state->g, @P@_ELEMENT);
    @p@_internal_copy(mu, state->mu, @P@_DIMENSION);
/*STEPS*/    @p@_internal_copy(state->g, g, @P@_ELEMENT);
    @p@_internal_copy(state->mu, mu, @P@_DIMENSION);
    *made = done;
    return status;
}

/**
 * Makes one step. Where it is refused, the state stays as it was, and the status says why: see @p@_status.
 */
static inline @p@_status @p@_step(const @p@_map *map, @p@_state *state)
{
    uint32_t made = 0u;
    return @p@_advance(map, state, 1u, &made);
}
";
