/*
 * rigid_body, K = 3, h = 0.1
 *
 * coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of double precision.
 * Number i of trajectory r is at i * rows + r of g (4 numbers each) and mu (3 each). Trajectory r goes from
 * step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:
 * 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,
 * 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.
 * Let targets be multiples of 256, or one.
 *
 * A step takes 209 operations and 335 for each correction, most often one.
 */

#define KERNEL extern "C" __global__
#define INLINE static __device__ __forceinline__
#define CALLED static __device__ __noinline__
#define GLOBAL
#define RESTRICT __restrict__
#define COUNT unsigned long long
#define COEFFICIENTS const NUMBER *
#define ROW ((COUNT)blockIdx.x * blockDim.x + threadIdx.x)
#ifndef NAN
#define NAN (0.0f / 0.0f)
#endif
#ifndef INFINITY
#define INFINITY (1.0f / 0.0f)
#endif
#define NUMBER double
#define ONE 1.0
#define DIM 3
#define ELEMENT 4
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 0x1p-50
#define NEAR 0x1.999999999999ap-5

static __constant__ const NUMBER coadjoint_slots[46] = {
    0x1.1111111111111p-4,
    0x1.8daea1d7f4cf8p-19,
    0x1.f11a4a4df2037p-21,
    0x1.999999999999ap-5,
    0x1.2a42f961f79bbp-21,
    0x1.47ae147ae147cp-5,
    0x1.f11a4a4df2037p-20,
    0x1.8daea1d7f4cf8p-18,
    0x1.2a42f961f79bbp-20,
    (-0x1.47ae147ae147cp-8),
    0x1.65e9f80f29213p-21,
    0x1.bf647612f3698p-23,
    1.0,
    (-0x1.463940c326d24p-13),
    0x1.a4ccfdb7dd391p-29,
    (-0x1.d208a5a912e34p-16),
    (-0x1.2e3d0a5c72605p-26),
    (-0x1.23a2326b2afeap-28),
    0x1.2a42f961f79bbp-20,
    (-0x1.a831bdb32743dp-27),
    (-0x1.a831bdb32743dp-27),
    1.0,
    (-0x1.a36e2eb1c432ep-14),
    0x1.1d0efe744b89cp-29,
    (-0x1.dd37f5698c2c5p-28),
    0x1.b4e81b4e81b4fp-7,
    (-0x1.1660a47d91c48p-20),
    0x1.2a42f961f79bbp-20,
    (-0x1.36b06e70b7422p-16),
    0x1.8bea28851394ap-27,
    (-0x1.cb8b382cbfdecp-29),
    0x1.091f168ff88a6p-22,
    0x1.1acbd3ccc4d7fp-28,
    1.0,
    0x1.5d867c3ece2a6p-14,
    (-0x1.316b7e5807ca7p-28),
    0x1.dd37f5698c2c5p-29,
    (-0x1.1111111111111p-7),
    0x1.2a42f961f79bbp-20,
    (-0x1.36b06e70b7422p-21),
    0x1.36b06e70b7422p-15,
    (-0x1.f1b8a7f7c0d82p-30),
    (-0x1.2c78910991256p-27),
    (-0x1.4b66dc33f6acfp-21),
    0x1.1acbd3ccc4d7fp-28,
    INFINITY,
};

INLINE void coadjoint_copy(NUMBER *RESTRICT to, const NUMBER *RESTRICT from, const int length)
{
    for (int i = 0; i < length; i++) {
        to[i] = from[i];
    }
}

INLINE void coadjoint_guess(const double *RESTRICT mu, double *RESTRICT p, double *RESTRICT k)
{
    const double t3 = __dmul_rn(mu[0], mu[0]);
    const double t5 = __dmul_rn(mu[1], mu[1]);
    const double t7 = __dmul_rn(mu[2], mu[2]);
    const double t10 = __fma_rn(t7, coadjoint_slots[10], coadjoint_slots[9]);
    const double t11 = __fma_rn(t5, coadjoint_slots[11], t10);
    const double t12 = __fma_rn(t3, coadjoint_slots[18], t11);
    const double t13 = __dmul_rn(mu[1], mu[2]);
    const double t14 = __dmul_rn(t12, t13);
    const double t19 = __fma_rn(t7, coadjoint_slots[16], coadjoint_slots[15]);
    const double t20 = __fma_rn(t5, coadjoint_slots[17], t19);
    const double t21 = __fma_rn(t3, coadjoint_slots[20], t20);
    const double t25 = __fma_rn(t7, coadjoint_slots[14], coadjoint_slots[13]);
    const double t26 = __fma_rn(t3, coadjoint_slots[19], t25);
    const double t28 = __fma_rn(t7, t26, coadjoint_slots[12]);
    const double t29 = __fma_rn(t5, t21, t28);
    const double t30 = __fma_rn(mu[0], t29, t14);
    const double t35 = __fma_rn(t7, coadjoint_slots[29], coadjoint_slots[28]);
    const double t36 = __fma_rn(t5, coadjoint_slots[30], t35);
    const double t37 = __fma_rn(t3, coadjoint_slots[32], t36);
    const double t41 = __fma_rn(t7, coadjoint_slots[23], coadjoint_slots[22]);
    const double t42 = __fma_rn(t5, coadjoint_slots[24], t41);
    const double t44 = __fma_rn(t7, t42, coadjoint_slots[21]);
    const double t45 = __fma_rn(t3, t37, t44);
    const double t46 = __dmul_rn(mu[1], t45);
    const double t51 = __fma_rn(t7, coadjoint_slots[26], coadjoint_slots[25]);
    const double t52 = __fma_rn(t5, coadjoint_slots[27], t51);
    const double t53 = __fma_rn(t3, coadjoint_slots[31], t52);
    const double t54 = __dmul_rn(mu[0], mu[2]);
    const double t55 = __fma_rn(t53, t54, t46);
    const double t60 = __fma_rn(t7, coadjoint_slots[41], coadjoint_slots[40]);
    const double t61 = __fma_rn(t5, coadjoint_slots[42], t60);
    const double t62 = __fma_rn(t3, coadjoint_slots[44], t61);
    const double t66 = __fma_rn(t7, coadjoint_slots[35], coadjoint_slots[34]);
    const double t67 = __fma_rn(t5, coadjoint_slots[36], t66);
    const double t69 = __fma_rn(t5, t67, coadjoint_slots[33]);
    const double t70 = __fma_rn(t3, t62, t69);
    const double t71 = __dmul_rn(mu[2], t70);
    const double t76 = __fma_rn(t7, coadjoint_slots[38], coadjoint_slots[37]);
    const double t77 = __fma_rn(t5, coadjoint_slots[39], t76);
    const double t78 = __fma_rn(t3, coadjoint_slots[43], t77);
    const double t79 = __dmul_rn(mu[0], mu[1]);
    const double t80 = __fma_rn(t78, t79, t71);
    const double t83 = fabs(mu[0]);
    const double t84 = fabs(mu[1]);
    const double t85 = (t84 <= t83) ? t83 : t84;
    const double t86 = fabs(mu[2]);
    const double t87 = (t86 <= t85) ? t85 : t86;
    const double t88 = __dadd_rn(0x1p-126, t87);
    const double t90 = __ddiv_rn(1.0, t88);
    p[0] = t30;
    p[1] = t55;
    p[2] = t80;
    k[0] = t90;
    k[1] = 0.0;
}

INLINE void coadjoint_correct(const double *RESTRICT p, const double *RESTRICT mu, const double *RESTRICT k, double *RESTRICT p_next, double *RESTRICT x, double *RESTRICT residual_bound, double *RESTRICT moved)
{
    const double t8 = __dmul_rn(p[1], p[1]);
    const double t10 = __dmul_rn(p[2], p[2]);
    const double t13 = __fma_rn(t10, coadjoint_slots[1], coadjoint_slots[0]);
    const double t14 = __fma_rn(t8, coadjoint_slots[2], t13);
    const double t15 = __dmul_rn(p[0], t14);
    const double t16 = __dmul_rn(p[0], p[0]);
    const double t19 = __fma_rn(t10, coadjoint_slots[4], coadjoint_slots[3]);
    const double t20 = __fma_rn(coadjoint_slots[2], t16, t19);
    const double t21 = __dmul_rn(p[1], t20);
    const double t23 = __fma_rn(t8, coadjoint_slots[4], coadjoint_slots[5]);
    const double t24 = __fma_rn(coadjoint_slots[1], t16, t23);
    const double t25 = __dmul_rn(p[2], t24);
    const double t26 = __dmul_rn(p[0], p[1]);
    const double t28 = __dmul_rn(t26, coadjoint_slots[6]);
    const double t29 = __dmul_rn(p[0], p[2]);
    const double t31 = __dmul_rn(t29, coadjoint_slots[7]);
    const double t32 = __dmul_rn(p[1], p[2]);
    const double t34 = __dmul_rn(t32, coadjoint_slots[8]);
    const double t38 = __dmul_rn(t15, t15);
    const double t39 = __fma_rn(t21, t21, t38);
    const double t40 = __fma_rn(t25, t25, t39);
    const double t51 = __fma_rn(t40, (-0x1.5555555555555p-5), 0x1p-1);
    const double t52 = __fma_rn(t40, (-0x1.a01a01a01a01ap-16), 0x1.6c16c16c16c17p-10);
    const double t53 = __fma_rn(t40, (-0x1.1eed8eff8d898p-29), 0x1.27e4fb7789f5cp-22);
    const double t54 = __fma_rn(t40, (-0x1.ae7f3e733b81fp-45), 0x1.93974a8c07c9dp-37);
    const double t55 = __fma_rn(t40, (-0x1.e542ba4020225p-62), 0x1.6827863b97d97p-53);
    const double t56 = __dmul_rn(t40, t40);
    const double t57 = __fma_rn(t52, t56, t51);
    const double t58 = __fma_rn(t54, t56, t53);
    const double t59 = __fma_rn(0x1.0ce396db7f853p-70, t56, t55);
    const double t60 = __dmul_rn(t56, t56);
    const double t61 = __fma_rn(t58, t60, t57);
    const double t62 = __dmul_rn(t60, t60);
    const double t63 = __fma_rn(t59, t62, t61);
    const double t74 = __fma_rn(t40, (-0x1.1111111111111p-7), 0x1.5555555555555p-3);
    const double t75 = __fma_rn(t40, (-0x1.71de3a556c734p-19), 0x1.a01a01a01a01ap-13);
    const double t76 = __fma_rn(t40, (-0x1.6124613a86d09p-33), 0x1.ae64567f544e4p-26);
    const double t77 = __fma_rn(t40, (-0x1.952c77030ad4ap-49), 0x1.ae7f3e733b81fp-41);
    const double t78 = __fma_rn(t40, (-0x1.71b8ef6dcf572p-66), 0x1.2f49b46814157p-57);
    const double t79 = __fma_rn(t56, t75, t74);
    const double t80 = __fma_rn(t56, t77, t76);
    const double t81 = __fma_rn(t60, t80, t79);
    const double t82 = __fma_rn(t62, t78, t81);
    const double t90 = __fma_rn(t40, 0x1.6c16c16c16c17p-8, (-0x1.5555555555555p-4));
    const double t91 = __fma_rn(t40, 0x1.27e4fb7789f5cp-19, (-0x1.3813813813814p-13));
    const double t92 = __fma_rn(t40, 0x1.2eb177e905d76p-33, (-0x1.66a8f2bf70ebep-26));
    const double t93 = __fma_rn(t56, t91, t90);
    const double t94 = __fma_rn(t56, (-0x1.78af56a4d411bp-41), t92);
    const double t95 = __fma_rn(t60, t94, t93);
    const double t103 = __fma_rn(t40, 0x1.a01a01a01a01ap-11, (-0x1.1111111111111p-6));
    const double t104 = __fma_rn(t40, 0x1.ae64567f544e4p-23, (-0x1.1566abc011567p-16));
    const double t105 = __fma_rn(t40, 0x1.42df6ed66ca17p-37, (-0x1.b96d79892884bp-30));
    const double t106 = __fma_rn(t56, t104, t103);
    const double t107 = __fma_rn(t56, (-0x1.6286e822a97a1p-45), t105);
    const double t108 = __fma_rn(t60, t107, t106);
    const double t109 = __dmul_rn(mu[1], t25);
    const double t110 = -mu[2];
    const double t111 = __fma_rn(t21, t110, t109);
    const double t112 = __dmul_rn(mu[2], t15);
    const double t113 = -mu[0];
    const double t114 = __fma_rn(t25, t113, t112);
    const double t115 = __dmul_rn(mu[0], t21);
    const double t116 = -mu[1];
    const double t117 = __fma_rn(t15, t116, t115);
    const double t118 = __dmul_rn(t25, t114);
    const double t119 = -t117;
    const double t120 = __fma_rn(t21, t119, t118);
    const double t121 = __dmul_rn(t15, t117);
    const double t122 = -t111;
    const double t123 = __fma_rn(t25, t122, t121);
    const double t124 = __dmul_rn(t21, t111);
    const double t125 = -t114;
    const double t126 = __fma_rn(t15, t125, t124);
    const double t127 = __fma_rn(t63, t111, mu[0]);
    const double t128 = __fma_rn(t63, t114, mu[1]);
    const double t129 = __fma_rn(t63, t117, mu[2]);
    const double t130 = __fma_rn(t82, t120, t127);
    const double t131 = __fma_rn(t82, t123, t128);
    const double t132 = __fma_rn(t82, t126, t129);
    const double t133 = __dmul_rn(t95, t111);
    const double t134 = __dmul_rn(t95, t114);
    const double t135 = __dmul_rn(t95, t117);
    const double t136 = __fma_rn(t108, t120, t133);
    const double t137 = __fma_rn(t108, t123, t134);
    const double t138 = __fma_rn(t108, t126, t135);
    const double t139 = -t82;
    const double t140 = __fma_rn(mu[0], t139, t136);
    const double t141 = __fma_rn(mu[1], t139, t137);
    const double t142 = __fma_rn(mu[2], t139, t138);
    const double t143 = __dmul_rn(mu[0], t63);
    const double t144 = __dmul_rn(mu[1], t63);
    const double t145 = __dmul_rn(mu[2], t63);
    const double t146 = __fma_rn(t82, t111, t143);
    const double t147 = __fma_rn(t82, t114, t144);
    const double t148 = __fma_rn(t82, t117, t145);
    const double t149 = __dmul_rn(mu[0], t15);
    const double t150 = __fma_rn(mu[1], t21, t149);
    const double t151 = __fma_rn(mu[2], t25, t150);
    const double t152 = __dmul_rn(t82, t151);
    const double t153 = -t146;
    const double t154 = -t147;
    const double t155 = -t148;
    const double t156 = __fma_rn(t15, t140, t152);
    const double t157 = __fma_rn(t21, t140, t155);
    const double t158 = __fma_rn(t25, t140, t147);
    const double t159 = __fma_rn(t15, t141, t148);
    const double t160 = __fma_rn(t21, t141, t152);
    const double t161 = __fma_rn(t25, t141, t153);
    const double t162 = __fma_rn(t15, t142, t154);
    const double t163 = __fma_rn(t21, t142, t146);
    const double t164 = __fma_rn(t25, t142, t152);
    const double t165 = -t156;
    const double t166 = -t157;
    const double t167 = -t158;
    const double t168 = -t159;
    const double t169 = -t160;
    const double t170 = -t161;
    const double t171 = -t162;
    const double t172 = -t163;
    const double t173 = -t164;
    const double t174 = __fma_rn(t14, t165, 1.0);
    const double t175 = __fma_rn(t28, t166, t174);
    const double t176 = __fma_rn(t31, t167, t175);
    const double t177 = __dmul_rn(t28, t165);
    const double t178 = __fma_rn(t20, t166, t177);
    const double t179 = __fma_rn(t34, t167, t178);
    const double t180 = __dmul_rn(t31, t165);
    const double t181 = __fma_rn(t34, t166, t180);
    const double t182 = __fma_rn(t24, t167, t181);
    const double t183 = __dmul_rn(t14, t168);
    const double t184 = __fma_rn(t28, t169, t183);
    const double t185 = __fma_rn(t31, t170, t184);
    const double t186 = __fma_rn(t28, t168, 1.0);
    const double t187 = __fma_rn(t20, t169, t186);
    const double t188 = __fma_rn(t34, t170, t187);
    const double t189 = __dmul_rn(t31, t168);
    const double t190 = __fma_rn(t34, t169, t189);
    const double t191 = __fma_rn(t24, t170, t190);
    const double t192 = __dmul_rn(t14, t171);
    const double t193 = __fma_rn(t28, t172, t192);
    const double t194 = __fma_rn(t31, t173, t193);
    const double t195 = __dmul_rn(t28, t171);
    const double t196 = __fma_rn(t20, t172, t195);
    const double t197 = __fma_rn(t34, t173, t196);
    const double t198 = __fma_rn(t31, t171, 1.0);
    const double t199 = __fma_rn(t34, t172, t198);
    const double t200 = __fma_rn(t24, t173, t199);
    const double t201 = __dsub_rn(p[0], t130);
    const double t202 = __dsub_rn(p[1], t131);
    const double t203 = __dsub_rn(p[2], t132);
    const double t204 = __dmul_rn(t188, t200);
    const double t205 = -t191;
    const double t206 = __fma_rn(t197, t205, t204);
    const double t207 = __dmul_rn(t182, t197);
    const double t208 = -t200;
    const double t209 = __fma_rn(t179, t208, t207);
    const double t210 = __dmul_rn(t179, t191);
    const double t211 = -t182;
    const double t212 = __fma_rn(t188, t211, t210);
    const double t213 = __dmul_rn(t191, t194);
    const double t214 = -t185;
    const double t215 = __fma_rn(t200, t214, t213);
    const double t216 = __dmul_rn(t176, t200);
    const double t217 = -t194;
    const double t218 = __fma_rn(t182, t217, t216);
    const double t219 = __dmul_rn(t182, t185);
    const double t220 = -t176;
    const double t221 = __fma_rn(t191, t220, t219);
    const double t222 = __dmul_rn(t185, t197);
    const double t223 = -t188;
    const double t224 = __fma_rn(t194, t223, t222);
    const double t225 = __dmul_rn(t179, t194);
    const double t226 = -t197;
    const double t227 = __fma_rn(t176, t226, t225);
    const double t228 = __dmul_rn(t176, t188);
    const double t229 = -t179;
    const double t230 = __fma_rn(t185, t229, t228);
    const double t231 = __dmul_rn(t176, t206);
    const double t232 = __fma_rn(t179, t215, t231);
    const double t233 = __fma_rn(t182, t224, t232);
    const double t234 = __ddiv_rn(1.0, t233);
    const double t235 = __dsub_rn(1.0, t176);
    const double t236 = __dsub_rn(1.0, t188);
    const double t237 = __dsub_rn(1.0, t200);
    const double t239 = __dmul_rn(t235, 2.0);
    const double t240 = __dmul_rn(t229, 2.0);
    const double t241 = __dmul_rn(t211, 2.0);
    const double t242 = __dmul_rn(t214, 2.0);
    const double t243 = __dmul_rn(t236, 2.0);
    const double t244 = __dmul_rn(t205, 2.0);
    const double t245 = __dmul_rn(t217, 2.0);
    const double t246 = __dmul_rn(t226, 2.0);
    const double t247 = __dmul_rn(t237, 2.0);
    const double t248 = __dadd_rn(t15, t244);
    const double t249 = __dsub_rn(t241, t21);
    const double t250 = __dsub_rn(t246, t15);
    const double t251 = __dadd_rn(t25, t240);
    const double t252 = __dadd_rn(t21, t245);
    const double t253 = __dsub_rn(t242, t25);
    const double t254 = __dmul_rn(t239, t239);
    const double t255 = fabs(t254);
    const double t256 = __dmul_rn(t251, t253);
    const double t257 = fabs(t256);
    const double t258 = __dadd_rn(t255, t257);
    const double t259 = __dmul_rn(t249, t252);
    const double t260 = fabs(t259);
    const double t261 = __dadd_rn(t258, t260);
    const double t262 = __dmul_rn(t243, t243);
    const double t263 = fabs(t262);
    const double t264 = __dadd_rn(t257, t263);
    const double t265 = __dmul_rn(t248, t250);
    const double t266 = fabs(t265);
    const double t267 = __dadd_rn(t264, t266);
    const double t268 = __dadd_rn(t260, t266);
    const double t269 = __dmul_rn(t247, t247);
    const double t270 = fabs(t269);
    const double t271 = __dadd_rn(t268, t270);
    const double t272 = fabs(t261);
    const double t273 = fabs(t267);
    const double t274 = (t273 <= t272) ? t272 : t273;
    const double t275 = fabs(t271);
    const double t276 = (t275 <= t274) ? t274 : t275;
    const double t278 = __dmul_rn(t201, t206);
    const double t279 = __fma_rn(t202, t209, t278);
    const double t280 = __fma_rn(t203, t212, t279);
    const double t281 = __dmul_rn(t201, t215);
    const double t282 = __fma_rn(t202, t218, t281);
    const double t283 = __fma_rn(t203, t221, t282);
    const double t284 = __dmul_rn(t201, t224);
    const double t285 = __fma_rn(t202, t227, t284);
    const double t286 = __fma_rn(t203, t230, t285);
    const double t287 = __dmul_rn(t234, t280);
    const double t288 = __dmul_rn(t234, t283);
    const double t289 = __dmul_rn(t234, t286);
    const double t290 = __dmul_rn(t14, t287);
    const double t291 = __fma_rn(t28, t288, t290);
    const double t292 = __fma_rn(t31, t289, t291);
    const double t293 = __dmul_rn(t28, t287);
    const double t294 = __fma_rn(t20, t288, t293);
    const double t295 = __fma_rn(t34, t289, t294);
    const double t296 = __dmul_rn(t31, t287);
    const double t297 = __fma_rn(t34, t288, t296);
    const double t298 = __fma_rn(t24, t289, t297);
    const double t299 = __dsub_rn(p[0], t287);
    const double t300 = __dsub_rn(p[1], t288);
    const double t301 = __dsub_rn(p[2], t289);
    const double t302 = __dsub_rn(t15, t292);
    const double t303 = __dsub_rn(t21, t295);
    const double t304 = __dsub_rn(t25, t298);
    const double t305 = fabs(t287);
    const double t306 = fabs(t288);
    const double t307 = (t306 <= t305) ? t305 : t306;
    const double t308 = fabs(t289);
    const double t309 = (t308 <= t307) ? t307 : t308;
    const double t310 = __dmul_rn(k[0], t309);
    const double t312 = (t276 <= 0x1.ce147ae147ae1p+1) ? t310 : 0x1.fffffep+127;
    const double t313 = fabs(t292);
    const double t314 = fabs(t295);
    const double t315 = (t314 <= t313) ? t313 : t314;
    const double t316 = fabs(t298);
    const double t317 = (t316 <= t315) ? t315 : t316;
    const double t318 = fabs(t15);
    const double t319 = fabs(t21);
    const double t320 = (t319 <= t318) ? t318 : t319;
    const double t321 = fabs(t25);
    const double t322 = (t321 <= t320) ? t320 : t321;
    const double t323 = __dmul_rn(t322, t322);
    const double t324 = __dmul_rn(0x1p-2, t323);
    const double t325 = __dmul_rn(t312, t324);
    const double t326 = __fma_rn(0x1p-1, t317, t325);
    const double t327 = __dmul_rn(k[1], t312);
    const double t328 = __fma_rn(t317, t326, t327);
    const double t332 = __dmul_rn(0x1p-52, 4.0);
    const double t333 = (t312 <= 0x1.0624dd2f1a9fcp-10) ? t328 : t312;
    const double t334 = (t333 <= t312) ? t333 : t312;
    const double t335 = (t312 <= t332) ? t334 : t333;
    p_next[0] = t299;
    p_next[1] = t300;
    p_next[2] = t301;
    x[0] = t302;
    x[1] = t303;
    x[2] = t304;
    *residual_bound = t335;
    *moved = t312;
}

INLINE void coadjoint_accept(const double *RESTRICT mu, const double *RESTRICT x, double residual_bound, double distance, double *RESTRICT right)
{
    const double t10 = __dmul_rn(0x1p-52, 4.0);
    const double t13 = __dmul_rn(x[0], x[0]);
    const double t14 = __fma_rn(x[1], x[1], t13);
    const double t15 = __fma_rn(x[2], x[2], t14);
    const double t17 = __dmul_rn(t15, 0x1.9f02f6222c72p-4);
    const double t18 = fabs(t17);
    const double t21 = (t17 <= 0x1.fffffffffffffp+1023) ? 0.0 : 1.0;
    const double t22 = __dadd_rn(t21, t21);
    const double t23 = __dadd_rn(t18, t22);
    const double t27 = (coadjoint_slots[45] <= 0x1.fffffep+127) ? 4.0 : 9.0;
    const double t28 = __dmul_rn(t23, t27);
    const double t29 = __dmul_rn(mu[0], mu[0]);
    const double t30 = __fma_rn(mu[1], mu[1], t29);
    const double t31 = __fma_rn(mu[2], mu[2], t30);
    const double t32 = (t31 <= coadjoint_slots[45]) ? 1.0 : 0.0;
    const double t33 = (t28 <= 1.0) ? t32 : 0.0;
    const double t34 = (distance <= 0x1.999999999999ap-5) ? t33 : 0.0;
    const double t35 = (residual_bound <= t10) ? t34 : 0.0;
    *right = t35;
}

INLINE void coadjoint_transport(const double *RESTRICT g, const double *RESTRICT mu, const double *RESTRICT x, double *RESTRICT g_next, double *RESTRICT mu_next)
{
    const double t10 = __dmul_rn(x[0], x[0]);
    const double t11 = __fma_rn(x[1], x[1], t10);
    const double t12 = __fma_rn(x[2], x[2], t11);
    const double t22 = __fma_rn(t12, (-0x1p-3), 1.0);
    const double t23 = __fma_rn(t12, (-0x1.6c16c16c16c17p-16), 0x1.5555555555555p-9);
    const double t24 = __fma_rn(t12, (-0x1.27e4fb7789f5cp-32), 0x1.a01a01a01a01ap-24);
    const double t25 = __fma_rn(t12, (-0x1.93974a8c07c9dp-51), 0x1.1eed8eff8d898p-41);
    const double t26 = __dmul_rn(t12, t12);
    const double t27 = __fma_rn(t23, t26, t22);
    const double t28 = __fma_rn(t25, t26, t24);
    const double t29 = __dmul_rn(t26, t26);
    const double t30 = __fma_rn(t28, t29, t27);
    const double t31 = __dmul_rn(t29, t29);
    const double t32 = __fma_rn(0x1.ae7f3e733b81fp-61, t31, t30);
    const double t42 = __fma_rn(t12, (-0x1.5555555555555p-6), 0x1p-1);
    const double t43 = __fma_rn(t12, (-0x1.a01a01a01a01ap-20), 0x1.1111111111111p-12);
    const double t44 = __fma_rn(t12, (-0x1.ae64567f544e4p-37), 0x1.71de3a556c734p-28);
    const double t45 = __fma_rn(t12, (-0x1.ae7f3e733b81fp-56), 0x1.6124613a86d09p-46);
    const double t46 = __fma_rn(t26, t43, t42);
    const double t47 = __fma_rn(t26, t45, t44);
    const double t48 = __fma_rn(t29, t47, t46);
    const double t49 = __fma_rn(t31, 0x1.952c77030ad4ap-66, t48);
    const double t51 = __dmul_rn(mu[1], x[2]);
    const double t52 = -mu[2];
    const double t53 = __fma_rn(x[1], t52, t51);
    const double t54 = __dmul_rn(mu[2], x[0]);
    const double t55 = -mu[0];
    const double t56 = __fma_rn(x[2], t55, t54);
    const double t57 = __dmul_rn(mu[0], x[1]);
    const double t58 = -mu[1];
    const double t59 = __fma_rn(x[0], t58, t57);
    const double t60 = __dmul_rn(x[2], t56);
    const double t61 = -t59;
    const double t62 = __fma_rn(x[1], t61, t60);
    const double t63 = __dmul_rn(x[0], t59);
    const double t64 = -t53;
    const double t65 = __fma_rn(x[2], t64, t63);
    const double t66 = __dmul_rn(x[1], t53);
    const double t67 = -t56;
    const double t68 = __fma_rn(x[0], t67, t66);
    const double t69 = __dmul_rn(t49, 2.0);
    const double t70 = __dmul_rn(t32, t69);
    const double t71 = __dmul_rn(t49, t69);
    const double t72 = __fma_rn(t53, t70, mu[0]);
    const double t73 = __fma_rn(t56, t70, mu[1]);
    const double t74 = __fma_rn(t59, t70, mu[2]);
    const double t75 = __fma_rn(t62, t71, t72);
    const double t76 = __fma_rn(t65, t71, t73);
    const double t77 = __fma_rn(t68, t71, t74);
    const double t78 = __dmul_rn(x[0], t49);
    const double t79 = __dmul_rn(x[1], t49);
    const double t80 = __dmul_rn(x[2], t49);
    const double t81 = __dmul_rn(g[1], t78);
    const double t82 = __fma_rn(g[2], t79, t81);
    const double t83 = __fma_rn(g[3], t80, t82);
    const double t84 = -t83;
    const double t85 = __fma_rn(g[0], t32, t84);
    const double t86 = __dmul_rn(g[2], t80);
    const double t87 = -g[3];
    const double t88 = __fma_rn(t79, t87, t86);
    const double t89 = __dmul_rn(g[3], t78);
    const double t90 = -g[1];
    const double t91 = __fma_rn(t80, t90, t89);
    const double t92 = __dmul_rn(g[1], t79);
    const double t93 = -g[2];
    const double t94 = __fma_rn(t78, t93, t92);
    const double t95 = __fma_rn(g[0], t78, t88);
    const double t96 = __fma_rn(g[0], t79, t91);
    const double t97 = __fma_rn(g[0], t80, t94);
    const double t98 = __fma_rn(g[1], t32, t95);
    const double t99 = __fma_rn(g[2], t32, t96);
    const double t100 = __fma_rn(g[3], t32, t97);
    const double t101 = __dmul_rn(t85, t85);
    const double t102 = __fma_rn(t98, t98, t101);
    const double t103 = __fma_rn(t99, t99, t102);
    const double t104 = __fma_rn(t100, t100, t103);
    const double t107 = __fma_rn(t104, (-0x1p-1), 0x1.8p+0);
    const double t108 = __dmul_rn(t85, t107);
    const double t109 = __dmul_rn(t98, t107);
    const double t110 = __dmul_rn(t99, t107);
    const double t111 = __dmul_rn(t100, t107);
    g_next[0] = t108;
    g_next[1] = t109;
    g_next[2] = t110;
    g_next[3] = t111;
    mu_next[0] = t75;
    mu_next[1] = t76;
    mu_next[2] = t77;
}

INLINE void coadjoint_sound(const double *RESTRICT g, const double *RESTRICT mu, double *RESTRICT right)
{
    const double t8 = __dmul_rn(g[0], g[0]);
    const double t9 = __fma_rn(g[1], g[1], t8);
    const double t10 = __fma_rn(g[2], g[2], t9);
    const double t11 = __fma_rn(g[3], g[3], t10);
    const double t13 = __dsub_rn(t11, 1.0);
    const double t14 = fabs(t13);
    const double t15 = __dsub_rn(mu[0], mu[0]);
    const double t16 = __dsub_rn(mu[1], mu[1]);
    const double t17 = __dadd_rn(t15, t16);
    const double t18 = __dsub_rn(mu[2], mu[2]);
    const double t19 = __dadd_rn(t17, t18);
    const double t20 = __dadd_rn(t14, t19);
    const double t22 = __dsqrt_rn(0x1p-52);
    const double t23 = (t20 <= t22) ? 1.0 : 0.0;
    *right = t23;
}

KERNEL void coadjoint_steps(GLOBAL NUMBER *RESTRICT g_state, GLOBAL NUMBER *RESTRICT mu_state,
    GLOBAL COUNT *RESTRICT done_state, GLOBAL unsigned int *RESTRICT status, const COUNT rows,
    const COUNT target)
{
    const COUNT row = ROW;
    NUMBER g[ELEMENT_ARRAY], mu[DIM_ARRAY];
    COUNT steps;
    unsigned int why = 0u;
    if (row >= rows || done_state[row] >= target) {
        return;
    }
    steps = target - done_state[row];
    for (int i = 0; i < ELEMENT; i++) {
        g[i] = g_state[i * rows + row];
    }
    for (int i = 0; i < DIM; i++) {
        mu[i] = mu_state[i * rows + row];
    }
    double x[DIM] = {0};
    COUNT done = 0u;
    while ((why == 0u) && (done < steps)) {
        COUNT count = 0u;
        double g_start[ELEMENT];
        double mu_start[DIM];
        coadjoint_copy(g_start, g, ELEMENT);
        coadjoint_copy(mu_start, mu, DIM);
        while ((why == 0u) && (done < steps) && (count < 256u)) {
            double p[DIM];
            double k[2];
            double residual_bound = 1.0;
            double distance = 0.0;
            double right = 0.0;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(residual_bound <= TOLERANCE) && distance <= NEAR)) {
                double moved = 0.0;
                double p_next[DIM];
                coadjoint_correct(p, mu, k, p_next, x, &residual_bound, &moved);
                coadjoint_copy(p, p_next, DIM);
                distance = __dadd_rn(distance, moved);
                tried++;
            }
            coadjoint_accept(mu, x, residual_bound, distance, &right);
            if (!(right == ONE)) {
                why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;
            }
            if (right == ONE) {
                double g_next[ELEMENT];
                double mu_next[DIM];
                coadjoint_transport(g, mu, x, g_next, mu_next);
                coadjoint_copy(g, g_next, ELEMENT);
                coadjoint_copy(mu, mu_next, DIM);
                done++;
                count++;
            }
        }
        if (count >= 1u) {
            double right = 0.0;
            coadjoint_sound(g, mu, &right);
            if (!(right == ONE)) {
                why = 4u;
                coadjoint_copy(g, g_start, ELEMENT);
                coadjoint_copy(mu, mu_start, DIM);
                done -= count;
            }
        }
    }
    for (int i = 0; i < ELEMENT; i++) {
        g_state[i * rows + row] = g[i];
    }
    for (int i = 0; i < DIM; i++) {
        mu_state[i * rows + row] = mu[i];
    }
    done_state[row] += done;
    status[row] = why;
}
