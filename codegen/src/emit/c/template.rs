//! Text of a header that is the same for all systems.

/// Helpers of functions that follow.
pub const HELPERS: &str = "
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

/// a^n, where parameters have powers: the operations of the interpreter.
pub const POWER: &str = "
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

/// The inverse of a matrix, for groups by tables.
pub const INVERT: &str = "
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
pub const END_OF_C: &str = "
#if defined(__cplusplus)
}
#endif
";

/// The loop of steps.
pub const DRIVE: &str = "
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
    @p@_state begun;
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
    while ((status == @P@_OK) && (done < steps)) {
        uint32_t length = steps - done;
        uint32_t count = 0u;
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
pub const FRAME: &str =
    "            @p@_internal_frame(map->c, now.g, now.mu, (double)count, next.g, next.mu);
            now = next;
";

/// Attitudes and momenta of states.
pub const STATE: &str = "
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

/** The energy: the Hamiltonian at the body momentum. Steps keep it near its first value for all times. */
static inline double @p@_energy(const @p@_map *map, const @p@_state *state)
{
    double energy = 0.0;
    @p@_internal_energy(map->c, state->mu, &energy);
    return energy;
}
";

/// The Casimirs, where any of low degree are known.
pub const CASIMIRS: &str = "
/** The Casimirs (@P@_CASIMIRS numbers). Every step conserves them to rounding. */
static inline void @p@_casimirs(const @p@_state *state, double *casimirs)
{
    const double none[1] = {0.0};
    @p@_internal_casimirs(none, state->mu, casimirs);
}
";

/// A status in words.
pub const TEXT: &str = "
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
        text = \"a number of the state is not finite\";
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

/// The class of C++.
pub const CLASS: &str = "
/**
 * The same for C++11: a map with its functions. It allocates nothing and throws nothing.
 */
class @C@ {
public:
    typedef @p@_state State;
    typedef @p@_status Status;
/*PARAMETERS*/
    /** As @p@_init; ask status() whether that went well. */
    explicit @C@(double h/*ARGUMENT*/) noexcept
    {
        (void)@p@_init(&map_, h/*PASSED*/);
    }

    /** Whether steps can be made, or why not. */
    Status status() const noexcept { return map_.status; }

    /** The state at the identity with this momentum. */
    static State at_identity(const double (&mu)[@P@_DIMENSION]) noexcept
    {
        State state;
        @p@_at_identity(&state, mu);
        return state;
    }

    /** As @p@_step. */
    Status step(State &state) const noexcept { return @p@_step(&map_, &state); }

    /** As @p@_advance. */
    Status advance(State &state, uint32_t steps, uint32_t &made) const noexcept
    {
        return @p@_advance(&map_, &state, steps, &made);
    }

    /** As @p@_energy. */
    double energy(const State &state) const noexcept { return @p@_energy(&map_, &state); }
/*CASIMIRS*/
    /** As @p@_spatial_momentum. */
    static void spatial_momentum(const State &state, double (&spatial)[@P@_DIMENSION]) noexcept
    {
        @p@_spatial_momentum(&state, spatial);
    }

    /** As @p@_matrix. */
    static void matrix(const State &state, double (&entries)[@P@_ROWS * @P@_ROWS]) noexcept
    {
        @p@_matrix(&state, entries);
    }

private:
    @p@_map map_;
};
";

/// The Casimirs in the class.
pub const CLASS_CASIMIRS: &str = "
    /** As @p@_casimirs. */
    static void casimirs(const State &state, double (&values)[@P@_CASIMIRS]) noexcept
    {
        @p@_casimirs(&state, values);
    }
";
