//! The dialect of C with vectors of the machine's full width, as GCC and Clang have them.

use alloc::format;
use alloc::string::String;

use super::c::{C, Dialect};
use crate::graph::Node;

/// C on numbers of the type `V`, a GNU vector; coefficients are spread over the lanes where they are used.
pub(super) struct Vectors(pub C);

/// The types and operations of the dialect: `V` of `W` numbers, `M` of as many integers, and operations that C lacks. Each
/// is one instruction where the processor has it.
pub(super) const PREAMBLE: &str = "\
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define W 8
#elif defined(__AVX__)
#define W 4
#else
#define W 2
#endif
#ifdef __aarch64__
#include <arm_neon.h>
#endif
typedef double V __attribute__((vector_size(W * 8)));
typedef long long M __attribute__((vector_size(W * 8)));
typedef double U __attribute__((vector_size(W * 8), aligned(8), may_alias));
#define INLINE static inline __attribute__((always_inline))
#if W == 8
#define EACH(f) ((V){f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7)})
#elif W == 4
#define EACH(f) ((V){f(0), f(1), f(2), f(3)})
#else
#define EACH(f) ((V){f(0), f(1)})
#endif
#ifdef __has_builtin
#define HAS(x) __has_builtin(x)
#else
#define HAS(x) 0
#endif

INLINE V spread(double a)
{
#define F(i) a
    return EACH(F);
#undef F
}

INLINE V fused(V a, V b, V c)
{
#if HAS(__builtin_elementwise_fma)
    return __builtin_elementwise_fma(a, b, c);
#elif W == 8 && HAS(__builtin_ia32_vfmaddpd512_mask)
    return __builtin_ia32_vfmaddpd512_mask(a, b, c, -1, 4);
#elif W == 4 && defined(__FMA__) && HAS(__builtin_ia32_vfmaddpd256)
    return __builtin_ia32_vfmaddpd256(a, b, c);
#elif W == 2 && defined(__aarch64__)
    return (V)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b);
#else
#define F(i) __builtin_fma(a[i], b[i], c[i])
    return EACH(F);
#undef F
#endif
}

INLINE V root(V a)
{
#if HAS(__builtin_elementwise_sqrt)
    return __builtin_elementwise_sqrt(a);
#elif W == 8 && HAS(__builtin_ia32_sqrtpd512_mask)
    return __builtin_ia32_sqrtpd512_mask(a, a, -1, 4);
#elif W == 4 && HAS(__builtin_ia32_sqrtpd256)
    return __builtin_ia32_sqrtpd256(a);
#elif W == 2 && defined(__aarch64__)
    return (V)vsqrtq_f64((float64x2_t)a);
#else
#define F(i) __builtin_sqrt(a[i])
    return EACH(F);
#undef F
#endif
}

INLINE V nearest(V a)
{
#if HAS(__builtin_elementwise_rint)
    return __builtin_elementwise_rint(a);
#elif W == 8 && HAS(__builtin_ia32_rndscalepd_mask)
    return __builtin_ia32_rndscalepd_mask(a, 4, a, -1, 4);
#elif W == 4 && HAS(__builtin_ia32_roundpd256)
    return __builtin_ia32_roundpd256(a, 4);
#elif W == 2 && defined(__aarch64__)
    return (V)vrndnq_f64((float64x2_t)a);
#else
#define F(i) __builtin_rint(a[i])
    return EACH(F);
#undef F
#endif
}

/* a where the mask is set, else b */
INLINE V pick(M mask, V a, V b)
{
#if W == 4 && HAS(__builtin_ia32_blendvpd256)
    return __builtin_ia32_blendvpd256(b, a, (V)mask);
#else
    return (V)((mask & (M)a) | (~mask & (M)b));
#endif
}

INLINE V size(V a)
{
    return (V)((M)a & 0x7fffffffffffffffLL);
}

/* a 2^k, by the exponent field of k, which is in the last bits of a sum */
INLINE V scaled(V a, V k)
{
    return a * (V)((M)(k + 0x1.80000000003ffp52) << 52);
}

/* The exponent field of a, in the last bits of 2^52, less its bias */
INLINE V exponent(V a)
{
    return (V)((((M)a >> 52) & 0x7ff) | 0x4330000000000000LL) - 0x1.00000000003ffp52;
}

/* The same of single numbers. */
INLINE double scaled_one(double a, double k)
{
    const union { double number; unsigned long long bits; } sum = {k + 0x1.80000000003ffp52};
    const union { unsigned long long bits; double number; } factor = {sum.bits << 52};
    return a * factor.number;
}

INLINE double exponent_one(double a)
{
    const union { double number; unsigned long long bits; } own = {a};
    return (double)((own.bits >> 52) & 0x7ff) - 1023.0;
}

INLINE M counts(long long a)
{
    return (M){0} + a;
}

INLINE void copy(double *to, const double *from, int length)
{
    for (int i = 0; i < length; i++) {
        to[i] = from[i];
    }
}

INLINE int any(M mask)
{
#if W == 4 && HAS(__builtin_ia32_movmskpd256)
    return __builtin_ia32_movmskpd256((V)mask) != 0;
#else
    long long found = 0;
    for (int i = 0; i < W; i++) {
        found |= mask[i];
    }
    return found != 0;
#endif
}

/* Copies in the lanes of a mask. */
INLINE void update(M mask, V *to, const V *from, int length)
{
    for (int i = 0; i < length; i++) {
        to[i] = pick(mask, from[i], to[i]);
    }
}

INLINE V load(const double *from)
{
    return *(const U *)from;
}

INLINE void store(double *to, V a)
{
    *(U *)to = a;
}
";

impl Dialect for Vectors {
    fn c(&self) -> &C {
        &self.0
    }

    fn constant(&self, value: f64) -> String {
        format!("spread({})", self.0.literal(value))
    }

    fn slot(&self, index: usize) -> String {
        format!("spread(c[{index}])")
    }

    fn operation(&self, node: Node, operands: &[&str]) -> String {
        match (node, operands) {
            (Node::Select(..), [a, b, c, d]) => format!("pick((M)({a} <= {b}), {c}, {d})"),
            _ => self.0.operation(node, operands),
        }
    }
}
