//! Text of a header that is the same for all systems.

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

/// Attitudes and momenta of states.
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

/** The energy: the Hamiltonian at the body momentum/*POTENTIAL*/. Steps keep it near its first value for all times. */
static inline double @p@_energy(const @p@_map *map, const @p@_state *state)
{
    double energy = 0.0;
    @p@_internal_energy(map->c, /*OF*/state->mu, &energy);
    return energy;
}
";

/// The Casimirs, where any of low degree are known.
pub(crate) const CASIMIRS: &str = "
/** The Casimirs (@P@_CASIMIRS numbers). Every step conserves them to rounding. */
static inline void @p@_casimirs(const @p@_state *state, double *casimirs)
{
    const double none[1] = {0.0};
    @p@_internal_casimirs(none, state->mu, casimirs);
}
";

/// A status in words.
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
