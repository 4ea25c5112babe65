/* Drives a header and prints what it does, numbers by their bits; made into a program for one header by a test. */
#include "@file@"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static void print(const char *what, const double *list, uint32_t length)
{
    uint32_t i;
    printf("%s", what);
    for (i = 0u; i < length; i++) {
        uint64_t bits;
        memcpy(&bits, &list[i], sizeof bits);
        printf(" %016" PRIx64, bits);
    }
    printf("\n");
}

static int same(const @p@_state *a, const @p@_state *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

int main(void)
{
    static const double momentum[@P@_DIMENSION] = {@momentum@};
    const double zero = 0.0;
    @p@_map map;
    @p@_map broken;
    @p@_state state;
    @p@_state before;
    @p@_status status;
    double spatial[@P@_DIMENSION];
    double matrix[@P@_ROWS * @P@_ROWS];
    double energy;
    uint32_t made = 7u;
    uint32_t i;
@parameters@
    status = @p@_init(&map, @step@@passed@);
    printf("init %d %s\n", (int)status, @p@_status_text(status));
    print("coefficients", map.c, @P@_COEFFICIENTS);
    @p@_at_identity(&state, momentum);
    print("identity", state.g, @P@_ELEMENT);
    energy = @p@_energy(&map, &state@time@);
    print("energy", &energy, 1u);
#ifdef @P@_CASIMIRS
    {
        double casimirs[@P@_CASIMIRS];
        @p@_casimirs(&state, casimirs);
        print("casimirs", casimirs, @P@_CASIMIRS);
    }
#endif
    @p@_spatial_momentum(&state, spatial);
    print("spatial", spatial, @P@_DIMENSION);

    status = @p@_advance(&map, &state@time@, @steps@u, &made);
    printf("advance %d %lu\n", (int)status, (unsigned long)made);
    print("g", state.g, @P@_ELEMENT);
    print("mu", state.mu, @P@_DIMENSION);
    energy = @p@_energy(&map, &state@time@);
    print("energy", &energy, 1u);
    @p@_spatial_momentum(&state, spatial);
    print("spatial", spatial, @P@_DIMENSION);
    @p@_matrix(&state, matrix);
    print("matrix", matrix, @P@_ROWS * @P@_ROWS);

    /* One step, and nothing at all. */
    before = state;
    status = @p@_advance(&map, &state@time@, 0u, &made);
    printf("none %d %lu %d\n", (int)status, (unsigned long)made, same(&before, &state));
    status = @p@_step(&map, &state@time@);
    printf("step %d %d\n", (int)status, same(&before, &state));

    /* What is refused leaves the state as it was. */
    for (i = 0u; i < @P@_DIMENSION; i++) {
        state.mu[i] = 1.0e9 * momentum[i];
    }
    before = state;
    status = @p@_advance(&map, &state@time@, 10u, &made);
    printf("large %d %lu %d\n", (int)status, (unsigned long)made, same(&before, &state));
    state.mu[0] = (double)NAN;
    before = state;
    status = @p@_step(&map, &state@time@);
    printf("momentum %d %d\n", (int)status, same(&before, &state));
    @p@_at_identity(&state, momentum);
    state.g[0] = (double)INFINITY;
    before = state;
    status = @p@_advance(&map, &state@time@, 3u, &made);
    printf("element %d %lu %d\n", (int)status, (unsigned long)made, same(&before, &state));
    @p@_at_identity(&state, momentum);
    state.g[0] = 1.5;
    before = state;
    status = @p@_advance(&map, &state@time@, 3u, &made);
    printf("group %d %lu %d\n", (int)status, (unsigned long)made, same(&before, &state));

#ifdef @P@_TIMES
    @p@_at_identity(&state, momentum);
    before = state;
    status = @p@_step(&map, &state, (double)INFINITY);
    printf("time %d %d %s\n", (int)status, same(&before, &state), @p@_status_text(status));
#endif

    /* Maps that cannot be made. */
    @p@_at_identity(&state, momentum);
    before = state;
    status = @p@_init(&broken, zero@passed@);
    printf("zero %d %d", (int)status, (int)@p@_step(&broken, &state@time@));
    printf(" %d\n", same(&before, &state));
    status = @p@_init(&broken, (double)NAN@passed@);
    printf("nan %d %d\n", (int)status, (int)@p@_step(&broken, &state@time@));
@broken@
    return 0;
}
