/* A year of the asteroid Toutatis, by the header that coadjoint wrote from toutatis.toml. */
#include "toutatis.h"

#include <stdio.h>

int main(void)
{
    const double momentum[TOUTATIS_DIMENSION] = {1.7130682953672385, 0.0, 2.081077733561844};
    const double day = 1.0;
    const uint32_t steps = 4u * 365u;
    toutatis_map map;
    toutatis_state state;
    toutatis_status status;
    double before[TOUTATIS_DIMENSION];
    double after[TOUTATIS_DIMENSION];
    double energy;
    uint32_t made = 0u;
    uint32_t i;

    status = toutatis_init(&map, 0.25 * day);
    toutatis_at_identity(&state, momentum);
    toutatis_spatial_momentum(&state, before);
    energy = toutatis_energy(&map, &state);
    if (status == TOUTATIS_OK) {
        status = toutatis_advance(&map, &state, steps, &made);
    }
    printf("%lu steps: %s\n", (unsigned long)made, toutatis_status_text(status));
    toutatis_spatial_momentum(&state, after);

    /* To the last bit, so that two machines can be compared. */
    printf("attitude %a %a %a %a\n", state.g[0], state.g[1], state.g[2], state.g[3]);
    printf("momentum %a %a %a\n", state.mu[0], state.mu[1], state.mu[2]);
    for (i = 0u; i < TOUTATIS_DIMENSION; i++) {
        printf("spatial momentum changed by %.1e\n", after[i] - before[i]);
    }
    printf("energy changed by %.1e\n", toutatis_energy(&map, &state) - energy);
    return (status == TOUTATIS_OK) ? 0 : 1;
}
