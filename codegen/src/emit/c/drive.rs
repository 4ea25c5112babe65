//! The loop of steps, that of [`coadjoint_program::Stepper::advance`].

use super::dialect::decimal;
use super::names::Names;
use crate::step::Step;

/// The functions that make steps.
pub fn functions(step: &Step, names: &Names) -> String {
    let kernel = step.kernel();
    let frame = if kernel.programs().frame.is_some() { FRAME } else { "" };
    let text = DRIVE
        .replace("/*FRAME*/", frame)
        .replace("/*CONSTANTS*/", &kernel.constants().max(1).to_string())
        .replace("/*CORRECTIONS*/", &format!("{}u", kernel.corrections()))
        .replace("/*TOLERANCE*/", &decimal(kernel.tolerance()))
        .replace("/*NEAR*/", &decimal(kernel.near()));
    names.fill(&text)
}

/// The loop of steps.
const DRIVE: &str = "
/* Internal: solves the equation of a step by Newton's method: x, a bound on what is left of the equation, and the way
 * from the first guess, both relative to the largest coordinate of the momentum. */
static inline void @p@_internal_solve(const double *@P@_RESTRICT c, const double *@P@_RESTRICT mu,
    double *@P@_RESTRICT x, double *@P@_RESTRICT left, double *@P@_RESTRICT way)
{
    double p[@P@_DIMENSION];
    double p_next[@P@_DIMENSION];
    double k[/*CONSTANTS*/];
    double moved = 0.0;
    uint32_t correction = 0u;
    uint32_t i;
    bool open = true;
    @p@_internal_guess(c, mu, p, k);
    *left = 1.0;
    *way = 0.0;
    while (open && (correction < /*CORRECTIONS*/)) {
        @p@_internal_correct(c, p, mu, k, p_next, x, left, &moved);
        for (i = 0u; i < @P@_DIMENSION; i++) {
            p[i] = p_next[i];
        }
        *way = *way + moved;
        correction++;
        open = (!(*left <= /*TOLERANCE*/)) && (*way <= /*NEAR*/);
    }
}

/* Internal: why a step was not accepted. */
static inline @p@_status @p@_internal_reason(const double *c, const double *mu, double left, double way)
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
    } else if ((!(left <= /*TOLERANCE*/)) || (!(way <= /*NEAR*/))) {
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
    @p@_state now;
    @p@_state next;
    @p@_status status = map->status;
    double x[@P@_DIMENSION];
    double left = 1.0;
    double way = 0.0;
    double right = 0.0;
    uint32_t done = 0u;
    uint32_t i;
    for (i = 0u; i < @P@_DIMENSION; i++) {
        x[i] = 0.0;
    }
    now = *state;
    next = *state;
    while ((status == @P@_OK) && (done < steps)) {
        uint32_t length = steps - done;
        uint32_t count = 0u;
        @p@_state begun;
        if (length > @P@_BLOCK) {
            length = @P@_BLOCK;
        }
        begun = now;
        while ((status == @P@_OK) && (count < length)) {
            @p@_internal_solve(map->c, now.mu, x, &left, &way);
            @p@_internal_accept(map->c, now.mu, x, left, way, &right);
            if (right > 0.5) {
                @p@_internal_transport(map->c, now.g, now.mu, x, next.g, next.mu);
                now = next;
                count++;
            } else {
                status = @p@_internal_reason(map->c, now.mu, left, way);
            }
        }
        if (count > 0u) {
/*FRAME*/            @p@_internal_sound(map->c, now.g, now.mu, &right);
            if (!(right > 0.5)) {
                status = @P@_OFF_GROUP;
                if ((!@p@_internal_finite(now.g, @P@_ELEMENT)) || (!@p@_internal_finite(now.mu, @P@_DIMENSION))) {
                    status = @P@_NOT_FINITE;
                }
                now = begun;
                count = 0u;
            }
        }
        done = done + count;
    }
    *state = now;
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

/// The motion of a comoving frame, after each block.
const FRAME: &str =
    "            @p@_internal_frame(map->c, now.g, now.mu, (double)count, next.g, next.mu);
            now = next;
";
