//! The loop of a trajectory on a device, and what the languages call things.

pub(super) const HEAD_OPENCL: &str = r"
#pragma OPENCL FP_CONTRACT OFF
#define KERNEL __kernel
#define INLINE static
#define CALLED static
#define GLOBAL __global
#define RESTRICT restrict
#define COUNT ulong
#define ROW get_global_id(0)
";

pub(super) const HEAD_CUDA: &str = r#"
#define KERNEL extern "C" __global__
#define INLINE static __device__ __forceinline__
#define CALLED static __device__ __noinline__
#define GLOBAL
#define RESTRICT __restrict__
#define COUNT unsigned long long
#define ROW ((COUNT)blockIdx.x * blockDim.x + threadIdx.x)
#ifndef NAN
#define NAN (0.0f / 0.0f)
#endif
#ifndef INFINITY
#define INFINITY (1.0f / 0.0f)
#endif
"#;

/// As [`Kernel::advance`](crate::Kernel::advance): every decision is the same. Memory holds the state of the last whole
/// block, so that an unsound block needs no copy to go back to.
pub(super) const LOOP: &str = r"
KERNEL void coadjoint_steps(GLOBAL NUMBER *RESTRICT g_state, GLOBAL NUMBER *RESTRICT mu_state,
    GLOBAL COUNT *RESTRICT done, GLOBAL unsigned int *RESTRICT status, const COUNT rows,
    const COUNT target)
{
    const COUNT row = ROW;
    NUMBER g[ELEMENT_ARRAY], mu[DIM_ARRAY], g_next[ELEMENT_ARRAY], mu_next[DIM_ARRAY];
    NUMBER right;
    COUNT total;
    unsigned int why = 0u;
    if (row >= rows) {
        return;
    }
    total = done[row];
    if (total >= target) {
        return;
    }
    for (int i = 0; i < ELEMENT; i++) {
        g[i] = g_state[i * rows + row];
    }
    for (int i = 0; i < DIM; i++) {
        mu[i] = mu_state[i * rows + row];
    }
    while (total < target && why == 0u) {
        const COUNT most = target - total < BLOCK ? target - total : BLOCK;
        COUNT made = 0;
        while (made < most) {
            NUMBER p[DIM_ARRAY], p_next[DIM_ARRAY], x[DIM_ARRAY], k[CONSTANT_ARRAY];
            NUMBER left = ONE, way = ZERO, moved;
            coadjoint_guess(mu, p, k);
            for (unsigned int correction = 1u; correction <= CORRECTIONS; correction++) {
                coadjoint_correct(p, mu, k, p_next, x, &left, &moved);
                for (int i = 0; i < DIM; i++) {
                    p[i] = p_next[i];
                }
                way = PLUS(way, moved);
                if (left <= TOLERANCE || !(way <= NEAR)) {
                    break;
                }
            }
            coadjoint_accept(mu, x, left, way, &right);
            if (!(right == ONE)) {
                why = !(way <= NEAR) ? 2u : !(left <= TOLERANCE) ? 1u : 3u;
                break;
            }
            coadjoint_transport(g, mu, x, g_next, mu_next);
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = g_next[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = mu_next[i];
            }
            made++;
        }
        if (made > 0) {
/*FRAME*/            coadjoint_sound(g, mu, &right);
            if (!(right == ONE)) {
                why = 4u;
                break;
            }
            for (int i = 0; i < ELEMENT; i++) {
                g_state[i * rows + row] = g[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu_state[i * rows + row] = mu[i];
            }
            total += made;
        }
    }
    done[row] = total;
    status[row] = why;
}
";

pub(super) const FRAME: &str = "            coadjoint_frame(g, mu, (NUMBER)made, g_next, mu_next);
            for (int i = 0; i < ELEMENT; i++) {
                g[i] = g_next[i];
            }
            for (int i = 0; i < DIM; i++) {
                mu[i] = mu_next[i];
            }
";
