// Drives the class of a header of C++.
#include "@file@"

#include <cinttypes>
#include <cstdio>
#include <cstring>

int main()
{
    const double momentum[@P@_DIMENSION] = {@momentum@};
@parameters@
    const @C@ map(@step@@by_value@);
    @C@::State state = @C@::at_identity(momentum);
    uint32_t made = 0u;
    const @C@::Status status = map.advance(state@time@, @steps@u, made);
    double spatial[@P@_DIMENSION];
    double matrix[@P@_ROWS * @P@_ROWS];
    @C@::spatial_momentum(state, spatial);
    @C@::matrix(state, matrix);
    std::printf("advance %d %lu\n", static_cast<int>(status), static_cast<unsigned long>(made));
    std::printf("mu");
    for (uint32_t i = 0u; i < @P@_DIMENSION; i++) {
        uint64_t bits;
        std::memcpy(&bits, &state.mu[i], sizeof bits);
        std::printf(" %016" PRIx64, bits);
    }
    std::printf("\n%d %d\n", static_cast<int>(map.status()), static_cast<int>(map.step(state@time@)));
    return map.energy(state@time@) < 1.0e300 ? 0 : 1;
}
