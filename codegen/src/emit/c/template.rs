//! Text of a header that is the same for all systems, or filled in.

use crate::emit::c::dialect::decimal;
use crate::step::Step;

/// a^n, where parameters have powers: the operations of the interpreter.
pub(super) const POWER: &str = "
/* Internal: a^n by repeated squaring. */
static inline double @p@_internal_power(double a, uint32_t n)
{
    double base = a;
    double result = 1.0;
    uint32_t left = n;
    while (left > 0u) {
        if ((left % 2u) == 1u) {
            result = result * base;
        }
        left = left / 2u;
        if (left > 0u) {
            base = base * base;
        }
    }
    return result;
}
";

/// The check of the last term of a series against the one before.
pub(super) const WITHIN: &str = "
/* Internal: the value of a polynomial. */
static inline double @p@_internal_polynomial(const double *coefficients, double r)
{
    double sum = 0.0;
    uint32_t i;
    for (i = /*DEGREES*/; i > 0u; i--) {
        sum = (sum * r) + coefficients[i - 1u];
    }
    return sum;
}

/* Internal: whether the last term of the series is at most half the one before for |p| up to r. */
static inline bool @p@_internal_within(const double *last, const double *before, double r)
{
    const double size = @p@_internal_polynomial(last, r);
    const double whole = @p@_internal_polynomial(before, r);
    /* Without a term to compare with there is no ratio, and rounding's own is none. */
    const bool nothing = (whole <= 0.0) || (size <= (16.0 * DBL_EPSILON));
    return ((size <= (0.5 * whole)) || nothing) && (size <= DBL_MAX);
}

/* Internal: how far, in |p|, the series can be trusted. */
static inline double @p@_internal_radius(const double *last, const double *before)
{
    static const double longer[13] = {
        1.3407807929942597e154, 1.157920892373162e77, 3.402823669209385e38, 18446744073709551616.0,
        4294967296.0, 65536.0, 256.0, 16.0, 4.0, 2.0,
        1.4142135623730951, 1.189207115002721, 1.0905077326652577,
    };
    double r = DBL_MAX;
    const double size = @p@_internal_polynomial(last, 1.0);
    if ((size > 0.0) || (size < 0.0) || !(fabs(size) <= DBL_MAX)) {
        const double smallest = 1.1754943508222875e-38;
        uint32_t i;
        r = @p@_internal_within(last, before, smallest) ? smallest : 0.0;
        for (i = 0u; i < 13u; i++) {
            const double next = r * longer[i];
            if (@p@_internal_within(last, before, next)) {
                r = next;
            }
        }
    }
    return r;
}
";

pub(super) const ABOUT: &str = "
/**
 * Folds the coefficients for steps of size h (negative: backwards in time). Call it once, and again whenever h or
 * a parameter changes; steps only read the map. It needs about /*BYTES*/ bytes of stack.
 *
 * Returns @P@_OK, @P@_BAD_STEP (h is zero or not finite) or @P@_BAD_PARAMETER (a coefficient is not
 * finite: a parameter is not, or one that is divided by is zero). The map keeps the status: steps with a map that
 * could not be made return it and do nothing.
 */
";

/// Counters, and the step size.
pub(super) const BEGIN: &str = "    double radius = DBL_MAX;
    @p@_status status = @P@_OK;
    uint32_t term = 0u;
    uint32_t part = 0u;
    uint32_t slot = 0u;
    uint32_t base;
    uint32_t i;
/*NEXT*/    if ((!(fabs(h) <= DBL_MAX)) || (!(fabs(h) > 0.0))) {
        status = @P@_BAD_STEP;
    }
";

/// Opaque coefficients and their products.
pub(super) const SYMBOLS: &str = "    for (i = 0u; i < /*SYMBOLS*/; i++) {
        if ((status == @P@_OK) && (!(fabs(symbol[i]) <= DBL_MAX))) {
            status = @P@_BAD_PARAMETER;
        }
    }
    product[0] = 1.0;
    for (i = 0u; i < /*PRODUCTS*/; i++) {
        product[i + 1u] = product[made_of[i]] * symbol[made_by[i]];
    }
";

/// A coefficient's share in the bound on the Hessian.
pub(super) const BOUND: &str =
    "        for (; (next_bound < /*BOUNDS*/) && (bound_base[next_bound] == base); next_bound++) {
            i = bound_place[next_bound];
            map->c[i] = map->c[i] + (fabs(value) * bound_weight[next_bound]);
        }
";

/// A part of the last two terms of the series.
pub(super) const LAST: &str =
    "            for (; (next_last < /*LASTS*/) && (last_part[next_last] == part); next_last++) {
                const double size = fabs(sum) * last_weight[next_last];
                i = last_place[next_last];
                if (last_is_highest[next_last] == 1u) {
                    last[i] = last[i] + size;
                } else {
                    before[i] = before[i] + size;
                }
            }
";

pub(super) const LOOP: &str = "    power[0] = 1.0;
    for (i = 1u; i < /*POWERS*/; i++) {
        power[i] = power[i - 1u] * h;
    }
    for (i = 0u; i < @P@_COEFFICIENTS; i++) {
        map->c[i] = 0.0;
    }
    for (base = 0u; base < /*BASES*/; base++) {
        double value = 0.0;
        for (; part < part_end[base]; part++) {
            double sum = 0.0;
            for (; term < term_end[part]; term++) {
                sum = sum + /*SUMMAND*/;
            }
            sum = sum * power[power_of[part]];
/*LAST*/            value = value + sum;
        }
        for (; slot < slot_end[base]; slot++) {
            map->c[slot] = value * (double)scale[slot];
        }
/*BOUND*/    }
";

/// The smallest radius of a factor of the group.
pub(super) const RADIUS: &str = "    for (i = 0u; i < /*PLACES*/; i += /*DEGREES*/) {
        const double own = @p@_internal_radius(&last[i], &before[i]);
        radius = (own < radius) ? own : radius;
    }
";

/// The radius, and whether all is finite.
pub(super) const END: &str = "/*RADIUS*/    for (i = 0u; i < (@P@_COEFFICIENTS - 1u); i++) {
        if ((status == @P@_OK) && (!(fabs(map->c[i]) <= DBL_MAX))) {
            status = @P@_BAD_PARAMETER;
        }
    }
    map->c[@P@_COEFFICIENTS - 1u] = radius * radius;
    if (status != @P@_OK) {
        for (i = 0u; i < @P@_COEFFICIENTS; i++) {
            map->c[i] = (double)NAN;
        }
    }
    map->status = status;
    return status;
}
";

/// Folding for a step of kicks and flows.
pub(super) const STEP: &str =
    "static inline @p@_status @p@_init(@p@_map *map, double h/*PARAMETERS*/)
{
    /* The flows and kicks of a step, as parts of it. */
    static const double flows[@P@_FLOWS + 1u] = /*FLOWS*/;
    static const double kicks[@P@_FLOWS + 1u] = /*KICKS*/;
    @p@_status status = @P@_OK;
    uint32_t i;
    for (i = 0u; i <= @P@_FLOWS; i++) {
        const @p@_status found = @p@_internal_fold(&map->c[i * @P@_COEFFICIENTS], h * flows[i], h * kicks[i]/*PASSED*/);
        if (status == @P@_OK) {
            status = found;
        }
    }
    map->status = status;
    return status;
}
";

/// Helpers of functions that follow.
pub(crate) const HELPERS: &str = "
#if defined(__cplusplus)
extern \"C\" {
#endif

/* Functions whose names have `internal` in them are not to be called from outside. */

/* Internal: whether all numbers of a list are finite. */
static inline bool @p@_internal_finite(const double *list, uint32_t length)
{
    bool finite = true;
    uint32_t i;
    for (i = 0u; i < length; i++) {
        if (!(fabs(list[i]) <= DBL_MAX)) {
            finite = false;
        }
    }
    return finite;
}
";

/// The inverse of a matrix, for groups by tables.
pub(crate) const INVERT: &str = "
/* Internal: the inverse of a matrix of `n` rows, by rows; not finite where there is none. */
static inline void @p@_internal_invert(const double *matrix, double *inverse, uint32_t n)
{
    double a[@P@_LARGEST_BLOCK * @P@_LARGEST_BLOCK];
    uint32_t row;
    uint32_t column;
    uint32_t pivot;
    for (row = 0u; row < n; row++) {
        for (column = 0u; column < n; column++) {
            a[(row * n) + column] = matrix[(row * n) + column];
            inverse[(row * n) + column] = (row == column) ? 1.0 : 0.0;
        }
    }
    for (pivot = 0u; pivot < n; pivot++) {
        uint32_t best = pivot;
        double scale;
        for (row = pivot + 1u; row < n; row++) {
            if (fabs(a[(row * n) + pivot]) > fabs(a[(best * n) + pivot])) {
                best = row;
            }
        }
        for (column = 0u; column < n; column++) {
            const double upper = a[(pivot * n) + column];
            const double lower = inverse[(pivot * n) + column];
            a[(pivot * n) + column] = a[(best * n) + column];
            a[(best * n) + column] = upper;
            inverse[(pivot * n) + column] = inverse[(best * n) + column];
            inverse[(best * n) + column] = lower;
        }
        scale = a[(pivot * n) + pivot];
        for (column = 0u; column < n; column++) {
            a[(pivot * n) + column] = a[(pivot * n) + column] / scale;
            inverse[(pivot * n) + column] = inverse[(pivot * n) + column] / scale;
        }
        for (row = 0u; row < n; row++) {
            const double factor = a[(row * n) + pivot];
            for (column = 0u; (row != pivot) && (column < n); column++) {
                a[(row * n) + column] = a[(row * n) + column] - (factor * a[(pivot * n) + column]);
                inverse[(row * n) + column] =
                    inverse[(row * n) + column] - (factor * inverse[(pivot * n) + column]);
            }
        }
    }
}
";

/// The end of what C and C++ share.
pub(crate) const END_OF_C: &str = "
#if defined(__cplusplus)
}
#endif
";

pub(crate) const STATE: &str = "
/** The state at the group's identity with this momentum (@P@_DIMENSION numbers). */
static inline void @p@_at_identity(@p@_state *state, const double *mu)
{
    static const double identity[@P@_ELEMENT] = {
/*IDENTITY*/    };
    uint32_t i;
    for (i = 0u; i < @P@_ELEMENT; i++) {
        state->g[i] = identity[i];
    }
    for (i = 0u; i < @P@_DIMENSION; i++) {
        state->mu[i] = mu[i];
    }
}

/** The matrix of the group element, row by row: @P@_ROWS * @P@_ROWS numbers. */
static inline void @p@_matrix(const @p@_state *state, double *matrix)
{
    const double none[1] = {0.0};
    @p@_internal_matrix(none, state->g, matrix);
}

/**
 * The spatial momentum Ad*_g mu (@P@_DIMENSION numbers). Every step conserves it to rounding: that it is constant
 * is a good check of a program that uses this header./*SINGULAR*/
 */
static inline void @p@_spatial_momentum(const @p@_state *state, double *spatial)
{
    const double none[1] = {0.0};
/*BACK*/    @p@_internal_spatial(none, state->g, /*ARGUMENT*/, state->mu, spatial);
}

/** The energy: the Hamiltonian at the body momentum/*POTENTIAL*/. /*KEPT*/. */
static inline double @p@_energy(const @p@_map *map, const @p@_state *state/*TIME*/)
{
/*LOCAL*/    double energy = 0.0;
/*SET*/    @p@_internal_energy(/*OWN*/, /*OF*/state->mu, &energy);
    return energy;
}
";

pub(crate) const CASIMIRS: &str = "
/** The Casimirs (@P@_CASIMIRS numbers). Every step conserves them to rounding. */
static inline void @p@_casimirs(const @p@_state *state, double *casimirs)
{
    const double none[1] = {0.0};
    @p@_internal_casimirs(none, state->mu, casimirs);
}
";

pub(crate) const TEXT: &str = "
/** A status in words. */
static inline const char *@p@_status_text(@p@_status status)
{
    const char *text = \"unknown status\";
    switch (status) {
    case @P@_OK:
        text = \"fine\";
        break;
    case @P@_BAD_STEP:
        text = \"/*BAD_STEP*/\";
        break;
    case @P@_BAD_PARAMETER:
        text = \"a coefficient is not finite: a parameter is not, or one that is divided by is zero\";
        break;
    case @P@_NOT_FINITE:
        text = \"a number of the state/*OR_TIME*/ is not finite\";
        break;
    case @P@_OFF_GROUP:
        text = \"the group element is none of the group: normalise it, or start from the identity\";
        break;
    case @P@_NOT_SOLVED:
        text = \"the step's equation was not solved: take a smaller step\";
        break;
    case @P@_BEYOND_SERIES:
        text = \"the momentum is beyond where the series can be trusted: take a smaller step\";
        break;
    case @P@_BEYOND_CHART:
        text = \"the step goes too far at once: take a smaller step\";
        break;
    default:
        /* No other values are returned. */
        break;
    }
    return text;
}
";

/// The texts of templates in the places for the time: where steps depend on it, and where they do not.
const TIMED: [(&str, &str, &str); 12] = [
    ("/*TIME*/", ", double time", ""),
    ("/*NOW*/", ", time", ""),
    ("/*FROM*/", " from this time", ""),
    ("/*COEFFICIENTS*/", "double c[@P@_COEFFICIENTS + @P@_TIMES]", "const double *c = map->c"),
    ("/*LOCAL*/", "    double c[@P@_COEFFICIENTS + @P@_TIMES];\n", ""),
    ("/*OWN*/", "c", "map->c"),
    ("/*OR_TIME*/", ", or the time,", ""),
    ("/*SET*/", "    @p@_internal_clock(map, c, time);\n", ""),
    ("/*BEGIN*/", BEGIN_AT, ""),
    ("/*KEPT*/", "It changes with time", "Steps keep it near its first value for all times"),
    ("/*ABOUT_TIME*/", ABOUT_TIME, ""),
    ("/*CLOCK*/", CLOCK, ""),
];

/// A template with what it says of time.
pub(super) fn timed(template: &str, step: &Step) -> String {
    let clock = step.kernel().clock();
    let fill = |text: String, (place, moving, fixed): (&str, &str, &str)| {
        text.replace(place, if clock.is_some() { moving } else { fixed })
    };
    let text = TIMED.into_iter().fold(template.to_owned(), fill);
    let Some(clock) = clock else { return text };
    let parts: Vec<String> = clock.times.iter().map(|&time| decimal(time)).collect();
    text.replace("/*PARTS*/", &parts.join(", ")).replace("/*SIZE*/", &format!("{}u", clock.size))
}

/// The statement that sets the times of a step.
pub(super) const CLOCK_OF_STEP: &str =
    "@p@_internal_clock(map, c, time + ((double)done * map->c[/*SIZE*/]));";

const CLOCK: &str = "/* Internal: the coefficients of a step that begins at this time. */
static inline void @p@_internal_clock(const @p@_map *map, double *c, double time)
{
    /* The times of a step, from its beginning on and in its lengths. */
    static const double parts[@P@_TIMES] = {/*PARTS*/};
    uint32_t i;
    @p@_internal_copy(c, map->c, @P@_COEFFICIENTS);
    for (i = 0u; i < @P@_TIMES; i++) {
        c[@P@_COEFFICIENTS + i] = @P@_FMA(parts[i], c[/*SIZE*/], time);
    }
}

";

const BEGIN_AT: &str = "    if ((status == @P@_OK) && (!(fabs(time) <= DBL_MAX))) {
        status = @P@_NOT_FINITE;
    }
";

const ABOUT_TIME: &str = " *
 * The first step begins at `time`, that of the state, and step i after it at time + i h, so that no rounding gathers.
 * Between calls count the steps: step i from the time t0 on begins at t0 + i h.
";
