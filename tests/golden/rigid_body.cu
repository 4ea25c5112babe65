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
 * A step takes 206 operations and 315 for each correction, most often one.
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
    const double t89 = __fma_rn(t40, 0x1.6c16c16c16c17p-9, (-0x1.5555555555555p-5));
    const double t90 = __fma_rn(t40, 0x1.27e4fb7789f5cp-20, (-0x1.3813813813814p-14));
    const double t91 = __fma_rn(t40, 0x1.2eb177e905d76p-34, (-0x1.66a8f2bf70ebep-27));
    const double t92 = __fma_rn(t56, t90, t89);
    const double t93 = __fma_rn(t56, (-0x1.78af56a4d411bp-42), t91);
    const double t94 = __fma_rn(t60, t93, t92);
    const double t101 = __fma_rn(t40, 0x1.a01a01a01a01ap-12, (-0x1.1111111111111p-7));
    const double t102 = __fma_rn(t40, 0x1.ae64567f544e4p-24, (-0x1.1566abc011567p-17));
    const double t103 = __fma_rn(t40, 0x1.42df6ed66ca17p-38, (-0x1.b96d79892884bp-31));
    const double t104 = __fma_rn(t56, t102, t101);
    const double t105 = __fma_rn(t56, (-0x1.6286e822a97a1p-46), t103);
    const double t106 = __fma_rn(t60, t105, t104);
    const double t107 = __dmul_rn(mu[1], t25);
    const double t108 = -mu[2];
    const double t109 = __fma_rn(t21, t108, t107);
    const double t110 = __dmul_rn(mu[2], t15);
    const double t111 = -mu[0];
    const double t112 = __fma_rn(t25, t111, t110);
    const double t113 = __dmul_rn(mu[0], t21);
    const double t114 = -mu[1];
    const double t115 = __fma_rn(t15, t114, t113);
    const double t116 = __dmul_rn(t25, t112);
    const double t117 = -t115;
    const double t118 = __fma_rn(t21, t117, t116);
    const double t119 = __dmul_rn(t15, t115);
    const double t120 = -t109;
    const double t121 = __fma_rn(t25, t120, t119);
    const double t122 = __dmul_rn(t21, t109);
    const double t123 = -t112;
    const double t124 = __fma_rn(t15, t123, t122);
    const double t125 = __fma_rn(t63, t109, mu[0]);
    const double t126 = __fma_rn(t63, t112, mu[1]);
    const double t127 = __fma_rn(t63, t115, mu[2]);
    const double t128 = __fma_rn(t82, t118, t125);
    const double t129 = __fma_rn(t82, t121, t126);
    const double t130 = __fma_rn(t82, t124, t127);
    const double t132 = __dmul_rn(t94, t109);
    const double t133 = __dmul_rn(t94, t112);
    const double t134 = __dmul_rn(t94, t115);
    const double t135 = __fma_rn(t106, t118, t132);
    const double t136 = __fma_rn(t106, t121, t133);
    const double t137 = __fma_rn(t106, t124, t134);
    const double t138 = __dmul_rn(2.0, t135);
    const double t139 = __dmul_rn(2.0, t136);
    const double t140 = __dmul_rn(2.0, t137);
    const double t141 = -t82;
    const double t142 = __fma_rn(mu[0], t141, t138);
    const double t143 = __fma_rn(mu[1], t141, t139);
    const double t144 = __fma_rn(mu[2], t141, t140);
    const double t145 = __dmul_rn(mu[0], t63);
    const double t146 = __dmul_rn(mu[1], t63);
    const double t147 = __dmul_rn(mu[2], t63);
    const double t148 = __fma_rn(t82, t109, t145);
    const double t149 = __fma_rn(t82, t112, t146);
    const double t150 = __fma_rn(t82, t115, t147);
    const double t151 = __dmul_rn(mu[0], t15);
    const double t152 = __fma_rn(mu[1], t21, t151);
    const double t153 = __fma_rn(mu[2], t25, t152);
    const double t154 = __dmul_rn(t82, t153);
    const double t155 = -t148;
    const double t156 = -t149;
    const double t157 = -t150;
    const double t158 = __fma_rn(t15, t142, t154);
    const double t159 = __fma_rn(t21, t142, t157);
    const double t160 = __fma_rn(t25, t142, t149);
    const double t161 = __fma_rn(t15, t143, t150);
    const double t162 = __fma_rn(t21, t143, t154);
    const double t163 = __fma_rn(t25, t143, t155);
    const double t164 = __fma_rn(t15, t144, t156);
    const double t165 = __fma_rn(t21, t144, t148);
    const double t166 = __fma_rn(t25, t144, t154);
    const double t167 = __dmul_rn(t14, t158);
    const double t168 = __fma_rn(t28, t159, t167);
    const double t169 = __fma_rn(t31, t160, t168);
    const double t170 = __dmul_rn(t28, t158);
    const double t171 = __fma_rn(t20, t159, t170);
    const double t172 = __fma_rn(t34, t160, t171);
    const double t173 = __dmul_rn(t31, t158);
    const double t174 = __fma_rn(t34, t159, t173);
    const double t175 = __fma_rn(t24, t160, t174);
    const double t176 = __dmul_rn(t14, t161);
    const double t177 = __fma_rn(t28, t162, t176);
    const double t178 = __fma_rn(t31, t163, t177);
    const double t179 = __dmul_rn(t28, t161);
    const double t180 = __fma_rn(t20, t162, t179);
    const double t181 = __fma_rn(t34, t163, t180);
    const double t182 = __dmul_rn(t31, t161);
    const double t183 = __fma_rn(t34, t162, t182);
    const double t184 = __fma_rn(t24, t163, t183);
    const double t185 = __dmul_rn(t14, t164);
    const double t186 = __fma_rn(t28, t165, t185);
    const double t187 = __fma_rn(t31, t166, t186);
    const double t188 = __dmul_rn(t28, t164);
    const double t189 = __fma_rn(t20, t165, t188);
    const double t190 = __fma_rn(t34, t166, t189);
    const double t191 = __dmul_rn(t31, t164);
    const double t192 = __fma_rn(t34, t165, t191);
    const double t193 = __fma_rn(t24, t166, t192);
    const double t194 = __dsub_rn(1.0, t169);
    const double t195 = -t172;
    const double t196 = -t175;
    const double t197 = -t178;
    const double t198 = __dsub_rn(1.0, t181);
    const double t199 = -t184;
    const double t200 = -t187;
    const double t201 = -t190;
    const double t202 = __dsub_rn(1.0, t193);
    const double t203 = __dsub_rn(p[0], t128);
    const double t204 = __dsub_rn(p[1], t129);
    const double t205 = __dsub_rn(p[2], t130);
    const double t206 = __ddiv_rn(1.0, t194);
    const double t207 = __dmul_rn(t197, t206);
    const double t208 = -t207;
    const double t209 = __fma_rn(t195, t208, t198);
    const double t210 = __fma_rn(t196, t208, t199);
    const double t211 = __dmul_rn(t200, t206);
    const double t212 = -t211;
    const double t213 = __fma_rn(t195, t212, t201);
    const double t214 = __fma_rn(t196, t212, t202);
    const double t215 = __ddiv_rn(1.0, t209);
    const double t216 = __dmul_rn(t213, t215);
    const double t217 = -t216;
    const double t218 = __fma_rn(t210, t217, t214);
    const double t219 = __ddiv_rn(1.0, t218);
    const double t220 = __dmul_rn(2.0, t169);
    const double t221 = __dmul_rn(2.0, t172);
    const double t222 = __dmul_rn(2.0, t175);
    const double t223 = __dmul_rn(2.0, t178);
    const double t224 = __dmul_rn(2.0, t181);
    const double t225 = __dmul_rn(2.0, t184);
    const double t226 = __dmul_rn(2.0, t187);
    const double t227 = __dmul_rn(2.0, t190);
    const double t228 = __dmul_rn(2.0, t193);
    const double t229 = __dadd_rn(t15, t225);
    const double t230 = __dsub_rn(t222, t21);
    const double t231 = __dsub_rn(t227, t15);
    const double t232 = __dadd_rn(t25, t221);
    const double t233 = __dadd_rn(t21, t226);
    const double t234 = __dsub_rn(t223, t25);
    const double t235 = __dmul_rn(t220, t220);
    const double t236 = fabs(t235);
    const double t237 = __dmul_rn(t232, t234);
    const double t238 = fabs(t237);
    const double t239 = __dadd_rn(t236, t238);
    const double t240 = __dmul_rn(t230, t233);
    const double t241 = fabs(t240);
    const double t242 = __dadd_rn(t239, t241);
    const double t243 = __dmul_rn(t224, t224);
    const double t244 = fabs(t243);
    const double t245 = __dadd_rn(t238, t244);
    const double t246 = __dmul_rn(t229, t231);
    const double t247 = fabs(t246);
    const double t248 = __dadd_rn(t245, t247);
    const double t249 = __dadd_rn(t241, t247);
    const double t250 = __dmul_rn(t228, t228);
    const double t251 = fabs(t250);
    const double t252 = __dadd_rn(t249, t251);
    const double t253 = fabs(t242);
    const double t254 = fabs(t248);
    const double t255 = (t254 <= t253) ? t253 : t254;
    const double t256 = fabs(t252);
    const double t257 = (t256 <= t255) ? t255 : t256;
    const double t259 = __fma_rn(t203, t208, t204);
    const double t260 = __fma_rn(t203, t212, t205);
    const double t261 = __fma_rn(t217, t259, t260);
    const double t262 = __dmul_rn(t219, t261);
    const double t263 = -t210;
    const double t264 = __fma_rn(t262, t263, t259);
    const double t265 = __dmul_rn(t215, t264);
    const double t266 = __fma_rn(t172, t265, t203);
    const double t267 = __fma_rn(t175, t262, t266);
    const double t268 = __dmul_rn(t206, t267);
    const double t269 = __dmul_rn(t14, t268);
    const double t270 = __fma_rn(t28, t265, t269);
    const double t271 = __fma_rn(t31, t262, t270);
    const double t272 = __dmul_rn(t28, t268);
    const double t273 = __fma_rn(t20, t265, t272);
    const double t274 = __fma_rn(t34, t262, t273);
    const double t275 = __dmul_rn(t31, t268);
    const double t276 = __fma_rn(t34, t265, t275);
    const double t277 = __fma_rn(t24, t262, t276);
    const double t278 = __dsub_rn(p[0], t268);
    const double t279 = __dsub_rn(p[1], t265);
    const double t280 = __dsub_rn(p[2], t262);
    const double t281 = __dsub_rn(t15, t271);
    const double t282 = __dsub_rn(t21, t274);
    const double t283 = __dsub_rn(t25, t277);
    const double t284 = fabs(t268);
    const double t285 = fabs(t265);
    const double t286 = (t285 <= t284) ? t284 : t285;
    const double t287 = fabs(t262);
    const double t288 = (t287 <= t286) ? t286 : t287;
    const double t289 = __dmul_rn(k[0], t288);
    const double t291 = (t257 <= 0x1.ce147ae147ae1p+1) ? t289 : 0x1.fffffep+127;
    const double t292 = fabs(t271);
    const double t293 = fabs(t274);
    const double t294 = (t293 <= t292) ? t292 : t293;
    const double t295 = fabs(t277);
    const double t296 = (t295 <= t294) ? t294 : t295;
    const double t297 = fabs(t15);
    const double t298 = fabs(t21);
    const double t299 = (t298 <= t297) ? t297 : t298;
    const double t300 = fabs(t25);
    const double t301 = (t300 <= t299) ? t299 : t300;
    const double t302 = __dmul_rn(t301, t301);
    const double t303 = __dmul_rn(0x1p-2, t302);
    const double t304 = __dmul_rn(t291, t303);
    const double t305 = __fma_rn(0x1p-1, t296, t304);
    const double t306 = __dmul_rn(k[1], t291);
    const double t307 = __fma_rn(t296, t305, t306);
    const double t311 = __dmul_rn(0x1p-52, 4.0);
    const double t312 = (t291 <= 0x1.0624dd2f1a9fcp-10) ? t307 : t291;
    const double t313 = (t312 <= t291) ? t312 : t291;
    const double t314 = (t291 <= t311) ? t313 : t312;
    p_next[0] = t278;
    p_next[1] = t279;
    p_next[2] = t280;
    x[0] = t281;
    x[1] = t282;
    x[2] = t283;
    *residual_bound = t314;
    *moved = t291;
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
    const double t50 = __dmul_rn(x[0], t49);
    const double t51 = __dmul_rn(x[1], t49);
    const double t52 = __dmul_rn(x[2], t49);
    const double t54 = __dmul_rn(mu[1], t52);
    const double t55 = -mu[2];
    const double t56 = __fma_rn(t51, t55, t54);
    const double t57 = __dmul_rn(mu[2], t50);
    const double t58 = -mu[0];
    const double t59 = __fma_rn(t52, t58, t57);
    const double t60 = __dmul_rn(mu[0], t51);
    const double t61 = -mu[1];
    const double t62 = __fma_rn(t50, t61, t60);
    const double t63 = __dmul_rn(2.0, t56);
    const double t64 = __dmul_rn(2.0, t59);
    const double t65 = __dmul_rn(2.0, t62);
    const double t66 = __dmul_rn(t52, t64);
    const double t67 = -t65;
    const double t68 = __fma_rn(t51, t67, t66);
    const double t69 = __dmul_rn(t50, t65);
    const double t70 = -t63;
    const double t71 = __fma_rn(t52, t70, t69);
    const double t72 = __dmul_rn(t51, t63);
    const double t73 = -t64;
    const double t74 = __fma_rn(t50, t73, t72);
    const double t75 = __fma_rn(t32, t63, mu[0]);
    const double t76 = __fma_rn(t32, t64, mu[1]);
    const double t77 = __fma_rn(t32, t65, mu[2]);
    const double t78 = __dadd_rn(t68, t75);
    const double t79 = __dadd_rn(t71, t76);
    const double t80 = __dadd_rn(t74, t77);
    const double t81 = __dmul_rn(g[1], t50);
    const double t82 = __fma_rn(g[2], t51, t81);
    const double t83 = __fma_rn(g[3], t52, t82);
    const double t84 = -t83;
    const double t85 = __fma_rn(g[0], t32, t84);
    const double t86 = __dmul_rn(g[2], t52);
    const double t87 = -g[3];
    const double t88 = __fma_rn(t51, t87, t86);
    const double t89 = __dmul_rn(g[3], t50);
    const double t90 = -g[1];
    const double t91 = __fma_rn(t52, t90, t89);
    const double t92 = __dmul_rn(g[1], t51);
    const double t93 = -g[2];
    const double t94 = __fma_rn(t50, t93, t92);
    const double t95 = __fma_rn(g[0], t50, t88);
    const double t96 = __fma_rn(g[0], t51, t91);
    const double t97 = __fma_rn(g[0], t52, t94);
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
    mu_next[0] = t78;
    mu_next[1] = t79;
    mu_next[2] = t80;
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
