/*
 * rigid_body, K = 3, h = 0.1
 *
 * coadjoint_steps(states, done, status, rows, target): a thread a trajectory, numbers of double precision.
 * A state has 4 numbers of g, then 3 of mu. Number i of trajectory r is at
 * r / 8 * 56 + i * 8 + r % 8 of states: blocks of 8 trajectories side by side, the last of them whole.
 * Trajectory r goes from step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why
 * no farther:
 * 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,
 * 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.
 * Let targets be multiples of 256, or one.
 *
 * A step takes 209 operations and 335 for each correction, most often one.
 */

#define KERNEL extern "C" __global__
#define INLINE static __device__ __forceinline__
#define CALLED static __device__
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
#define WIDTH 8
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 8.881784197001252e-16
#define NEAR 0.05

static __constant__ const NUMBER coadjoint_slots[46] = {
    0.06666666666666667,
    2.9629629629629633e-6,
    9.259259259259261e-7,
    0.05,
    5.555555555555557e-7,
    0.04000000000000001,
    1.8518518518518523e-6,
    5.925925925925927e-6,
    1.1111111111111115e-6,
    (-0.005000000000000001),
    6.666666666666668e-7,
    2.0833333333333339e-7,
    1.0,
    (-0.0001555555555555556),
    3.0617283950617295e-9,
    (-2.7777777777777786e-5),
    (-1.7592592592592598e-8),
    (-4.2438271604938285e-9),
    1.1111111111111115e-6,
    (-1.2345679012345683e-8),
    (-1.2345679012345683e-8),
    1.0,
    (-0.00010000000000000002),
    2.074074074074075e-9,
    (-6.944444444444447e-9),
    0.013333333333333334,
    (-1.0370370370370373e-6),
    1.1111111111111115e-6,
    (-1.851851851851852e-5),
    1.152263374485597e-8,
    (-3.3436213991769554e-9),
    2.4691358024691365e-7,
    4.115226337448562e-9,
    1.0,
    8.333333333333334e-5,
    (-4.444444444444446e-9),
    3.4722222222222234e-9,
    (-0.008333333333333333),
    1.1111111111111115e-6,
    (-5.787037037037038e-7),
    3.703703703703704e-5,
    (-1.8106995884773669e-9),
    (-8.744855967078192e-9),
    (-6.172839506172841e-7),
    4.115226337448562e-9,
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
    const double t88 = __dadd_rn(1.1754943508222875e-38, t87);
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
    const double t35 = __dmul_rn(t15, t15);
    const double t36 = __fma_rn(t21, t21, t35);
    const double t37 = __fma_rn(t25, t25, t36);
    const double t38 = __dmul_rn(t37, t37);
    const double t39 = __dmul_rn(t38, t38);
    const double t40 = __dmul_rn(t39, t39);
    const double t43 = __fma_rn(t37, (-0.041666666666666664), 0.5);
    const double t46 = __fma_rn(t37, (-2.48015873015873e-5), 0.001388888888888889);
    const double t47 = __fma_rn(t38, t46, t43);
    const double t50 = __fma_rn(t37, (-2.08767569878681e-9), 2.755731922398589e-7);
    const double t53 = __fma_rn(t37, (-4.779477332387385e-14), 1.1470745597729725e-11);
    const double t54 = __fma_rn(t38, t53, t50);
    const double t55 = __fma_rn(t39, t54, t47);
    const double t58 = __fma_rn(t37, (-4.110317623312165e-19), 1.5619206968586225e-16);
    const double t60 = __fma_rn(t38, 8.896791392450574e-22, t58);
    const double t61 = __fma_rn(t40, t60, t55);
    const double t64 = __fma_rn(t37, (-0.008333333333333333), 0.16666666666666666);
    const double t67 = __fma_rn(t37, (-2.7557319223985893e-6), 0.0001984126984126984);
    const double t68 = __fma_rn(t38, t67, t64);
    const double t71 = __fma_rn(t37, (-1.6059043836821613e-10), 2.505210838544172e-8);
    const double t74 = __fma_rn(t37, (-2.8114572543455206e-15), 7.647163731819816e-13);
    const double t75 = __fma_rn(t38, t74, t71);
    const double t76 = __fma_rn(t39, t75, t68);
    const double t79 = __fma_rn(t37, (-1.9572941063391263e-20), 8.22063524662433e-18);
    const double t80 = __fma_rn(t40, t79, t76);
    const double t83 = __fma_rn(t37, 0.005555555555555556, (-0.08333333333333333));
    const double t86 = __fma_rn(t37, 2.204585537918871e-6, (-0.00014880952380952382));
    const double t87 = __fma_rn(t38, t86, t83);
    const double t90 = __fma_rn(t37, 1.376489471727567e-10, (-2.08767569878681e-8));
    const double t92 = __fma_rn(t38, (-6.691268265342339e-13), t90);
    const double t93 = __fma_rn(t39, t92, t87);
    const double t96 = __fma_rn(t37, 0.0007936507936507937, (-0.016666666666666666));
    const double t99 = __fma_rn(t37, 2.0041686708353376e-7, (-1.6534391534391536e-5));
    const double t100 = __fma_rn(t38, t99, t96);
    const double t103 = __fma_rn(t37, 9.17659647818378e-12, (-1.6059043836821613e-9));
    const double t105 = __fma_rn(t38, (-3.936040156083729e-14), t103);
    const double t106 = __fma_rn(t39, t105, t100);
    const double t107 = -mu[2];
    const double t108 = __dmul_rn(mu[1], t25);
    const double t109 = __fma_rn(t21, t107, t108);
    const double t110 = -mu[0];
    const double t111 = __dmul_rn(mu[2], t15);
    const double t112 = __fma_rn(t25, t110, t111);
    const double t113 = -mu[1];
    const double t114 = __dmul_rn(mu[0], t21);
    const double t115 = __fma_rn(t15, t113, t114);
    const double t116 = -t115;
    const double t117 = __dmul_rn(t25, t112);
    const double t118 = __fma_rn(t21, t116, t117);
    const double t119 = -t109;
    const double t120 = __dmul_rn(t15, t115);
    const double t121 = __fma_rn(t25, t119, t120);
    const double t122 = -t112;
    const double t123 = __dmul_rn(t21, t109);
    const double t124 = __fma_rn(t15, t122, t123);
    const double t125 = __fma_rn(t61, t109, mu[0]);
    const double t126 = __fma_rn(t61, t112, mu[1]);
    const double t127 = __fma_rn(t61, t115, mu[2]);
    const double t128 = __fma_rn(t80, t118, t125);
    const double t129 = __fma_rn(t80, t121, t126);
    const double t130 = __fma_rn(t80, t124, t127);
    const double t131 = __dmul_rn(t93, t109);
    const double t132 = __dmul_rn(t93, t112);
    const double t133 = __dmul_rn(t93, t115);
    const double t134 = __fma_rn(t106, t118, t131);
    const double t135 = __fma_rn(t106, t121, t132);
    const double t136 = __fma_rn(t106, t124, t133);
    const double t137 = -t80;
    const double t138 = __fma_rn(mu[0], t137, t134);
    const double t139 = __fma_rn(mu[1], t137, t135);
    const double t140 = __fma_rn(mu[2], t137, t136);
    const double t141 = __dmul_rn(mu[0], t61);
    const double t142 = __dmul_rn(mu[1], t61);
    const double t143 = __dmul_rn(mu[2], t61);
    const double t144 = __fma_rn(t80, t109, t141);
    const double t145 = __fma_rn(t80, t112, t142);
    const double t146 = __fma_rn(t80, t115, t143);
    const double t147 = __dmul_rn(mu[0], t15);
    const double t148 = __fma_rn(mu[1], t21, t147);
    const double t149 = __fma_rn(mu[2], t25, t148);
    const double t150 = __dmul_rn(t80, t149);
    const double t151 = -t146;
    const double t152 = -t144;
    const double t153 = -t145;
    const double t154 = __fma_rn(t15, t138, t150);
    const double t155 = __fma_rn(t21, t138, t151);
    const double t156 = __fma_rn(t25, t138, t145);
    const double t157 = __fma_rn(t15, t139, t146);
    const double t158 = __fma_rn(t21, t139, t150);
    const double t159 = __fma_rn(t25, t139, t152);
    const double t160 = __fma_rn(t15, t140, t153);
    const double t161 = __fma_rn(t21, t140, t144);
    const double t162 = __fma_rn(t25, t140, t150);
    const double t164 = -t154;
    const double t165 = -t155;
    const double t166 = -t156;
    const double t167 = -t157;
    const double t168 = -t158;
    const double t169 = -t159;
    const double t170 = -t160;
    const double t171 = -t161;
    const double t172 = -t162;
    const double t173 = __fma_rn(t14, t164, 1.0);
    const double t174 = __fma_rn(t28, t165, t173);
    const double t175 = __fma_rn(t31, t166, t174);
    const double t176 = __dmul_rn(t28, t164);
    const double t177 = __fma_rn(t20, t165, t176);
    const double t178 = __fma_rn(t34, t166, t177);
    const double t179 = __dmul_rn(t31, t164);
    const double t180 = __fma_rn(t34, t165, t179);
    const double t181 = __fma_rn(t24, t166, t180);
    const double t182 = __dmul_rn(t14, t167);
    const double t183 = __fma_rn(t28, t168, t182);
    const double t184 = __fma_rn(t31, t169, t183);
    const double t185 = __fma_rn(t28, t167, 1.0);
    const double t186 = __fma_rn(t20, t168, t185);
    const double t187 = __fma_rn(t34, t169, t186);
    const double t188 = __dmul_rn(t31, t167);
    const double t189 = __fma_rn(t34, t168, t188);
    const double t190 = __fma_rn(t24, t169, t189);
    const double t191 = __dmul_rn(t14, t170);
    const double t192 = __fma_rn(t28, t171, t191);
    const double t193 = __fma_rn(t31, t172, t192);
    const double t194 = __dmul_rn(t28, t170);
    const double t195 = __fma_rn(t20, t171, t194);
    const double t196 = __fma_rn(t34, t172, t195);
    const double t197 = __fma_rn(t31, t170, 1.0);
    const double t198 = __fma_rn(t34, t171, t197);
    const double t199 = __fma_rn(t24, t172, t198);
    const double t200 = __dsub_rn(p[0], t128);
    const double t201 = __dsub_rn(p[1], t129);
    const double t202 = __dsub_rn(p[2], t130);
    const double t203 = __dmul_rn(t187, t199);
    const double t204 = -t190;
    const double t205 = __fma_rn(t196, t204, t203);
    const double t206 = __dmul_rn(t181, t196);
    const double t207 = -t199;
    const double t208 = __fma_rn(t178, t207, t206);
    const double t209 = __dmul_rn(t178, t190);
    const double t210 = -t181;
    const double t211 = __fma_rn(t187, t210, t209);
    const double t212 = __dmul_rn(t190, t193);
    const double t213 = -t184;
    const double t214 = __fma_rn(t199, t213, t212);
    const double t215 = __dmul_rn(t175, t199);
    const double t216 = -t193;
    const double t217 = __fma_rn(t181, t216, t215);
    const double t218 = __dmul_rn(t181, t184);
    const double t219 = -t175;
    const double t220 = __fma_rn(t190, t219, t218);
    const double t221 = __dmul_rn(t184, t196);
    const double t222 = -t187;
    const double t223 = __fma_rn(t193, t222, t221);
    const double t224 = __dmul_rn(t178, t193);
    const double t225 = -t196;
    const double t226 = __fma_rn(t175, t225, t224);
    const double t227 = __dmul_rn(t175, t187);
    const double t228 = -t178;
    const double t229 = __fma_rn(t184, t228, t227);
    const double t230 = __dmul_rn(t175, t205);
    const double t231 = __fma_rn(t178, t214, t230);
    const double t232 = __fma_rn(t181, t223, t231);
    const double t233 = __ddiv_rn(1.0, t232);
    const double t234 = __dsub_rn(1.0, t175);
    const double t235 = __dsub_rn(1.0, t187);
    const double t236 = __dsub_rn(1.0, t199);
    const double t238 = __dmul_rn(t234, 2.0);
    const double t239 = __dmul_rn(t228, 2.0);
    const double t240 = __dmul_rn(t210, 2.0);
    const double t241 = __dmul_rn(t213, 2.0);
    const double t242 = __dmul_rn(t235, 2.0);
    const double t243 = __dmul_rn(t204, 2.0);
    const double t244 = __dmul_rn(t216, 2.0);
    const double t245 = __dmul_rn(t225, 2.0);
    const double t246 = __dmul_rn(t236, 2.0);
    const double t247 = __dadd_rn(t15, t243);
    const double t248 = __dsub_rn(t240, t21);
    const double t249 = __dsub_rn(t245, t15);
    const double t250 = __dadd_rn(t25, t239);
    const double t251 = __dadd_rn(t21, t244);
    const double t252 = __dsub_rn(t241, t25);
    const double t253 = __dmul_rn(t238, t238);
    const double t254 = fabs(t253);
    const double t255 = __dmul_rn(t250, t252);
    const double t256 = fabs(t255);
    const double t257 = __dadd_rn(t254, t256);
    const double t258 = __dmul_rn(t248, t251);
    const double t259 = fabs(t258);
    const double t260 = __dadd_rn(t257, t259);
    const double t261 = __dmul_rn(t242, t242);
    const double t262 = fabs(t261);
    const double t263 = __dadd_rn(t256, t262);
    const double t264 = __dmul_rn(t247, t249);
    const double t265 = fabs(t264);
    const double t266 = __dadd_rn(t263, t265);
    const double t267 = __dadd_rn(t259, t265);
    const double t268 = __dmul_rn(t246, t246);
    const double t269 = fabs(t268);
    const double t270 = __dadd_rn(t267, t269);
    const double t271 = fabs(t260);
    const double t272 = fabs(t266);
    const double t273 = (t272 <= t271) ? t271 : t272;
    const double t274 = fabs(t270);
    const double t275 = (t274 <= t273) ? t273 : t274;
    const double t277 = __dmul_rn(t200, t205);
    const double t278 = __fma_rn(t201, t208, t277);
    const double t279 = __fma_rn(t202, t211, t278);
    const double t280 = __dmul_rn(t200, t214);
    const double t281 = __fma_rn(t201, t217, t280);
    const double t282 = __fma_rn(t202, t220, t281);
    const double t283 = __dmul_rn(t200, t223);
    const double t284 = __fma_rn(t201, t226, t283);
    const double t285 = __fma_rn(t202, t229, t284);
    const double t286 = __dmul_rn(t233, t279);
    const double t287 = __dmul_rn(t233, t282);
    const double t288 = __dmul_rn(t233, t285);
    const double t289 = __dmul_rn(t14, t286);
    const double t290 = __fma_rn(t28, t287, t289);
    const double t291 = __fma_rn(t31, t288, t290);
    const double t292 = __dmul_rn(t28, t286);
    const double t293 = __fma_rn(t20, t287, t292);
    const double t294 = __fma_rn(t34, t288, t293);
    const double t295 = __dmul_rn(t31, t286);
    const double t296 = __fma_rn(t34, t287, t295);
    const double t297 = __fma_rn(t24, t288, t296);
    const double t298 = __dsub_rn(p[0], t286);
    const double t299 = __dsub_rn(p[1], t287);
    const double t300 = __dsub_rn(p[2], t288);
    const double t301 = __dsub_rn(t15, t291);
    const double t302 = __dsub_rn(t21, t294);
    const double t303 = __dsub_rn(t25, t297);
    const double t304 = fabs(t286);
    const double t305 = fabs(t287);
    const double t306 = (t305 <= t304) ? t304 : t305;
    const double t307 = fabs(t288);
    const double t308 = (t307 <= t306) ? t306 : t307;
    const double t309 = __dmul_rn(k[0], t308);
    const double t311 = (t275 <= 3.61) ? t309 : 3.4028234663852886e38;
    const double t312 = fabs(t291);
    const double t313 = fabs(t294);
    const double t314 = (t313 <= t312) ? t312 : t313;
    const double t315 = fabs(t297);
    const double t316 = (t315 <= t314) ? t314 : t315;
    const double t317 = fabs(t15);
    const double t318 = fabs(t21);
    const double t319 = (t318 <= t317) ? t317 : t318;
    const double t320 = fabs(t25);
    const double t321 = (t320 <= t319) ? t319 : t320;
    const double t322 = __dmul_rn(t321, t321);
    const double t324 = __dmul_rn(t322, 0.25);
    const double t325 = __dmul_rn(t311, t324);
    const double t326 = __fma_rn(0.5, t316, t325);
    const double t327 = __dmul_rn(k[1], t311);
    const double t328 = __fma_rn(t316, t326, t327);
    const double t332 = __dmul_rn(2.220446049250313e-16, 4.0);
    const double t333 = (t311 <= 0.001) ? t328 : t311;
    const double t334 = (t333 <= t311) ? t333 : t311;
    const double t335 = (t311 <= t332) ? t334 : t333;
    p_next[0] = t298;
    p_next[1] = t299;
    p_next[2] = t300;
    x[0] = t301;
    x[1] = t302;
    x[2] = t303;
    *residual_bound = t335;
    *moved = t311;
}

INLINE void coadjoint_accept(const double *RESTRICT mu, const double *RESTRICT x, double residual_bound, double distance, double *RESTRICT right)
{
    const double t10 = __dmul_rn(2.220446049250313e-16, 4.0);
    const double t12 = __dmul_rn(x[0], x[0]);
    const double t13 = __fma_rn(x[1], x[1], t12);
    const double t14 = __fma_rn(x[2], x[2], t13);
    const double t16 = __dmul_rn(t14, 0.10132118364233778);
    const double t18 = fabs(t16);
    const double t19 = __dsub_rn(t16, t16);
    const double t20 = __dadd_rn(t18, t19);
    const double t25 = (coadjoint_slots[45] <= 3.4028234663852886e38) ? 4.0 : 9.0;
    const double t26 = __dmul_rn(t20, t25);
    const double t27 = __dmul_rn(mu[0], mu[0]);
    const double t28 = __fma_rn(mu[1], mu[1], t27);
    const double t29 = __fma_rn(mu[2], mu[2], t28);
    const double t30 = (t29 <= coadjoint_slots[45]) ? 1.0 : 0.0;
    const double t31 = (t26 <= 1.0) ? t30 : 0.0;
    const double t32 = (distance <= 0.05) ? t31 : 0.0;
    const double t33 = (residual_bound <= t10) ? t32 : 0.0;
    *right = t33;
}

INLINE void coadjoint_transport(const double *RESTRICT g, const double *RESTRICT mu, const double *RESTRICT x, double *RESTRICT g_next, double *RESTRICT mu_next)
{
    const double t10 = __dmul_rn(x[0], x[0]);
    const double t11 = __fma_rn(x[1], x[1], t10);
    const double t12 = __fma_rn(x[2], x[2], t11);
    const double t13 = __dmul_rn(t12, t12);
    const double t14 = __dmul_rn(t13, t13);
    const double t15 = __dmul_rn(t14, t14);
    const double t18 = __fma_rn(t12, (-0.125), 1.0);
    const double t21 = __fma_rn(t12, (-2.170138888888889e-5), 0.0026041666666666665);
    const double t22 = __fma_rn(t13, t21, t18);
    const double t25 = __fma_rn(t12, (-2.691144455467372e-10), 9.68812003968254e-8);
    const double t28 = __fma_rn(t12, (-7.001187498614334e-16), 5.096864498991235e-13);
    const double t29 = __fma_rn(t13, t28, t25);
    const double t30 = __fma_rn(t14, t29, t22);
    const double t32 = __fma_rn(t15, 7.292903644389931e-19, t30);
    const double t35 = __fma_rn(t12, (-0.020833333333333332), 0.5);
    const double t38 = __fma_rn(t12, (-1.5500992063492063e-6), 0.00026041666666666666);
    const double t39 = __fma_rn(t13, t38, t35);
    const double t42 = __fma_rn(t12, (-1.2232474797578965e-11), 5.382288910934745e-9);
    const double t45 = __fma_rn(t12, (-2.333729166204778e-17), 1.9603324996120133e-14);
    const double t46 = __fma_rn(t13, t45, t42);
    const double t47 = __fma_rn(t14, t46, t39);
    const double t49 = __fma_rn(t15, 2.1449716601146855e-20, t47);
    const double t50 = __dmul_rn(x[0], t49);
    const double t51 = __dmul_rn(x[1], t49);
    const double t52 = __dmul_rn(x[2], t49);
    const double t53 = __dmul_rn(g[1], t50);
    const double t54 = __fma_rn(g[2], t51, t53);
    const double t55 = __fma_rn(g[3], t52, t54);
    const double t56 = -t55;
    const double t57 = __fma_rn(g[0], t32, t56);
    const double t58 = -g[3];
    const double t59 = __dmul_rn(g[2], t52);
    const double t60 = __fma_rn(t51, t58, t59);
    const double t61 = -g[1];
    const double t62 = __dmul_rn(g[3], t50);
    const double t63 = __fma_rn(t52, t61, t62);
    const double t64 = -g[2];
    const double t65 = __dmul_rn(g[1], t51);
    const double t66 = __fma_rn(t50, t64, t65);
    const double t67 = __fma_rn(g[0], t50, t60);
    const double t68 = __fma_rn(g[0], t51, t63);
    const double t69 = __fma_rn(g[0], t52, t66);
    const double t70 = __fma_rn(g[1], t32, t67);
    const double t71 = __fma_rn(g[2], t32, t68);
    const double t72 = __fma_rn(g[3], t32, t69);
    const double t73 = __dmul_rn(t57, t57);
    const double t74 = __fma_rn(t70, t70, t73);
    const double t75 = __fma_rn(t71, t71, t74);
    const double t76 = __fma_rn(t72, t72, t75);
    const double t79 = __fma_rn(t76, (-0.5), 1.5);
    const double t80 = __dmul_rn(t57, t79);
    const double t81 = __dmul_rn(t70, t79);
    const double t82 = __dmul_rn(t71, t79);
    const double t83 = __dmul_rn(t72, t79);
    const double t84 = -mu[2];
    const double t85 = __dmul_rn(mu[1], x[2]);
    const double t86 = __fma_rn(x[1], t84, t85);
    const double t87 = -mu[0];
    const double t88 = __dmul_rn(mu[2], x[0]);
    const double t89 = __fma_rn(x[2], t87, t88);
    const double t90 = -mu[1];
    const double t91 = __dmul_rn(mu[0], x[1]);
    const double t92 = __fma_rn(x[0], t90, t91);
    const double t94 = __dmul_rn(t49, 2.0);
    const double t95 = __dmul_rn(t32, t94);
    const double t96 = __fma_rn(t86, t95, mu[0]);
    const double t97 = __fma_rn(t89, t95, mu[1]);
    const double t98 = __fma_rn(t92, t95, mu[2]);
    const double t99 = __dmul_rn(t49, t94);
    const double t100 = -t92;
    const double t101 = __dmul_rn(x[2], t89);
    const double t102 = __fma_rn(x[1], t100, t101);
    const double t103 = -t86;
    const double t104 = __dmul_rn(x[0], t92);
    const double t105 = __fma_rn(x[2], t103, t104);
    const double t106 = -t89;
    const double t107 = __dmul_rn(x[1], t86);
    const double t108 = __fma_rn(x[0], t106, t107);
    const double t109 = __fma_rn(t99, t102, t96);
    const double t110 = __fma_rn(t99, t105, t97);
    const double t111 = __fma_rn(t99, t108, t98);
    g_next[0] = t80;
    g_next[1] = t81;
    g_next[2] = t82;
    g_next[3] = t83;
    mu_next[0] = t109;
    mu_next[1] = t110;
    mu_next[2] = t111;
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
    const double t22 = __dsqrt_rn(2.220446049250313e-16);
    const double t23 = (t20 <= t22) ? 1.0 : 0.0;
    *right = t23;
}

KERNEL void coadjoint_steps(GLOBAL NUMBER *RESTRICT states, GLOBAL COUNT *RESTRICT done_state,
    GLOBAL unsigned int *RESTRICT status, const COUNT rows, const COUNT target)
{
    const COUNT row = ROW;
    GLOBAL NUMBER *const own = states + row / WIDTH * (WIDTH * (ELEMENT + DIM)) + row % WIDTH;
    NUMBER g[ELEMENT_ARRAY], mu[DIM_ARRAY];
    COUNT steps;
    unsigned int why = 0u;
    if (row >= rows) {
        return;
    }
    if (done_state[row] >= target) {
        status[row] = why;
        return;
    }
    steps = target - done_state[row];
    for (int i = 0; i < ELEMENT; i++) {
        g[i] = own[i * WIDTH];
    }
    for (int i = 0; i < DIM; i++) {
        mu[i] = own[(ELEMENT + i) * WIDTH];
    }
    double x[3] = {0};
    COUNT done = 0u;
    while ((why == 0u) && (done < steps)) {
        COUNT count = 0u;
        double g_start[4];
        double mu_start[3];
        coadjoint_copy(g_start, g, 4u);
        coadjoint_copy(mu_start, mu, 3u);
        while ((why == 0u) && (done < steps) && (count < 256u)) {
            double p[3];
            double k[2];
            double residual_bound = 1.0;
            double distance = 0.0;
            double right = 0.0;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(residual_bound <= TOLERANCE) && distance <= NEAR)) {
                double moved = 0.0;
                double p_next[3];
                coadjoint_correct(p, mu, k, p_next, x, &residual_bound, &moved);
                coadjoint_copy(p, p_next, 3u);
                distance = __dadd_rn(distance, moved);
                tried++;
            }
            coadjoint_accept(mu, x, residual_bound, distance, &right);
            if (right != ONE) {
                why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;
            }
            if (right == ONE) {
                double g_next[4];
                double mu_next[3];
                coadjoint_transport(g, mu, x, g_next, mu_next);
                coadjoint_copy(g, g_next, 4u);
                coadjoint_copy(mu, mu_next, 3u);
                done++;
                count++;
            }
        }
        if (count >= 1u) {
            double right = 0.0;
            coadjoint_sound(g, mu, &right);
            if (right != ONE) {
                why = 4u;
                coadjoint_copy(g, g_start, 4u);
                coadjoint_copy(mu, mu_start, 3u);
                done -= count;
            }
        }
    }
    for (int i = 0; i < ELEMENT; i++) {
        own[i * WIDTH] = g[i];
    }
    for (int i = 0; i < DIM; i++) {
        own[(ELEMENT + i) * WIDTH] = mu[i];
    }
    done_state[row] += done;
    status[row] = why;
}
