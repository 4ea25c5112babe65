/*
 * rigid_body, K = 3, h = 0.1
 *
 * coadjoint_steps(states, done, status, rows, target): a thread a trajectory, numbers of single precision.
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

#pragma OPENCL FP_CONTRACT OFF
#define KERNEL __kernel
#define INLINE static
#define CALLED static
#define GLOBAL __global
#define RESTRICT restrict
#define COUNT ulong
#define COEFFICIENTS __constant NUMBER *
#define ROW get_global_id(0)
#define NUMBER float
#define ONE 1.0f
#define DIM 3
#define ELEMENT 4
#define WIDTH 8
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 4.76837158203125e-7f
#define NEAR 0.05000000074505806f

__constant NUMBER coadjoint_slots[46] = {
    0.06666667014360428f,
    2.9629629807459423e-6f,
    9.259259172722523e-7f,
    0.05000000074505806f,
    5.555555731007189e-7f,
    0.03999999910593033f,
    1.8518518345445045e-6f,
    5.925925961491885e-6f,
    1.1111111462014378e-6f,
    (-0.004999999888241291f),
    6.666666649834951e-7f,
    2.0833333280734223e-7f,
    1.0f,
    (-0.00015555555000901222f),
    3.0617284263456668e-9f,
    (-2.7777778086601757e-5f),
    (-1.759259227185339e-8f),
    (-4.243827067540451e-9f),
    1.1111111462014378e-6f,
    (-1.2345679145653321e-8f),
    (-1.2345679145653321e-8f),
    1.0f,
    (-9.999999747378752e-5f),
    2.0740740236391275e-9f,
    (-6.944444574941144e-9f),
    0.013333333656191826f,
    (-1.0370370091550285e-6f),
    1.1111111462014378e-6f,
    (-1.851851811807137e-5f),
    1.1522633514005065e-8f,
    (-3.3436213797699565e-9f),
    2.469135722549254e-7f,
    4.11522638188444e-9f,
    1.0f,
    8.333333244081587e-5f,
    (-4.444444368090217e-9f),
    3.472222287470572e-9f,
    (-0.008333333767950535f),
    1.1111111462014378e-6f,
    (-5.787036911897303e-7f),
    3.703703623614274e-5f,
    (-1.8106995902655854e-9f),
    (-8.744856394571343e-9f),
    (-6.172839448481682e-7f),
    4.11522638188444e-9f,
    INFINITY,
};

INLINE void coadjoint_copy(NUMBER *RESTRICT to, const NUMBER *RESTRICT from, const int length)
{
    for (int i = 0; i < length; i++) {
        to[i] = from[i];
    }
}

INLINE void coadjoint_guess(const float *RESTRICT mu, float *RESTRICT p, float *RESTRICT k)
{
    const float t3 = mu[0] * mu[0];
    const float t5 = mu[1] * mu[1];
    const float t7 = mu[2] * mu[2];
    const float t10 = fma(t7, coadjoint_slots[10], coadjoint_slots[9]);
    const float t11 = fma(t5, coadjoint_slots[11], t10);
    const float t12 = fma(t3, coadjoint_slots[18], t11);
    const float t13 = mu[1] * mu[2];
    const float t14 = t12 * t13;
    const float t19 = fma(t7, coadjoint_slots[16], coadjoint_slots[15]);
    const float t20 = fma(t5, coadjoint_slots[17], t19);
    const float t21 = fma(t3, coadjoint_slots[20], t20);
    const float t25 = fma(t7, coadjoint_slots[14], coadjoint_slots[13]);
    const float t26 = fma(t3, coadjoint_slots[19], t25);
    const float t28 = fma(t7, t26, coadjoint_slots[12]);
    const float t29 = fma(t5, t21, t28);
    const float t30 = fma(mu[0], t29, t14);
    const float t35 = fma(t7, coadjoint_slots[29], coadjoint_slots[28]);
    const float t36 = fma(t5, coadjoint_slots[30], t35);
    const float t37 = fma(t3, coadjoint_slots[32], t36);
    const float t41 = fma(t7, coadjoint_slots[23], coadjoint_slots[22]);
    const float t42 = fma(t5, coadjoint_slots[24], t41);
    const float t44 = fma(t7, t42, coadjoint_slots[21]);
    const float t45 = fma(t3, t37, t44);
    const float t46 = mu[1] * t45;
    const float t51 = fma(t7, coadjoint_slots[26], coadjoint_slots[25]);
    const float t52 = fma(t5, coadjoint_slots[27], t51);
    const float t53 = fma(t3, coadjoint_slots[31], t52);
    const float t54 = mu[0] * mu[2];
    const float t55 = fma(t53, t54, t46);
    const float t60 = fma(t7, coadjoint_slots[41], coadjoint_slots[40]);
    const float t61 = fma(t5, coadjoint_slots[42], t60);
    const float t62 = fma(t3, coadjoint_slots[44], t61);
    const float t66 = fma(t7, coadjoint_slots[35], coadjoint_slots[34]);
    const float t67 = fma(t5, coadjoint_slots[36], t66);
    const float t69 = fma(t5, t67, coadjoint_slots[33]);
    const float t70 = fma(t3, t62, t69);
    const float t71 = mu[2] * t70;
    const float t76 = fma(t7, coadjoint_slots[38], coadjoint_slots[37]);
    const float t77 = fma(t5, coadjoint_slots[39], t76);
    const float t78 = fma(t3, coadjoint_slots[43], t77);
    const float t79 = mu[0] * mu[1];
    const float t80 = fma(t78, t79, t71);
    const float t83 = fabs(mu[0]);
    const float t84 = fabs(mu[1]);
    const float t85 = (t84 <= t83) ? t83 : t84;
    const float t86 = fabs(mu[2]);
    const float t87 = (t86 <= t85) ? t85 : t86;
    const float t88 = 1.1754943508222875e-38f + t87;
    const float t90 = 1.0f / t88;
    p[0] = t30;
    p[1] = t55;
    p[2] = t80;
    k[0] = t90;
    k[1] = 0.0f;
}

INLINE void coadjoint_correct(const float *RESTRICT p, const float *RESTRICT mu, const float *RESTRICT k, float *RESTRICT p_next, float *RESTRICT x, float *RESTRICT residual_bound, float *RESTRICT moved)
{
    const float t8 = p[1] * p[1];
    const float t10 = p[2] * p[2];
    const float t13 = fma(t10, coadjoint_slots[1], coadjoint_slots[0]);
    const float t14 = fma(t8, coadjoint_slots[2], t13);
    const float t15 = p[0] * t14;
    const float t16 = p[0] * p[0];
    const float t19 = fma(t10, coadjoint_slots[4], coadjoint_slots[3]);
    const float t20 = fma(coadjoint_slots[2], t16, t19);
    const float t21 = p[1] * t20;
    const float t23 = fma(t8, coadjoint_slots[4], coadjoint_slots[5]);
    const float t24 = fma(coadjoint_slots[1], t16, t23);
    const float t25 = p[2] * t24;
    const float t26 = p[0] * p[1];
    const float t28 = t26 * coadjoint_slots[6];
    const float t29 = p[0] * p[2];
    const float t31 = t29 * coadjoint_slots[7];
    const float t32 = p[1] * p[2];
    const float t34 = t32 * coadjoint_slots[8];
    const float t35 = t15 * t15;
    const float t36 = fma(t21, t21, t35);
    const float t37 = fma(t25, t25, t36);
    const float t38 = t37 * t37;
    const float t39 = t38 * t38;
    const float t40 = t39 * t39;
    const float t43 = fma(t37, (-0.0416666679084301f), 0.5f);
    const float t46 = fma(t37, (-2.4801587642286904e-5f), 0.0013888889225199819f);
    const float t47 = fma(t38, t46, t43);
    const float t50 = fma(t37, (-2.0876755879584152e-9f), 2.755731998149713e-7f);
    const float t53 = fma(t37, (-4.7794772561329454e-14f), 1.147074536050896e-11f);
    const float t54 = fma(t38, t53, t50);
    const float t55 = fma(t39, t54, t47);
    const float t58 = fma(t37, (-4.110317590937049e-19f), 1.5619206814541513e-16f);
    const float t60 = fma(t38, 8.896790959566848e-22f, t58);
    const float t61 = fma(t40, t60, t55);
    const float t64 = fma(t37, (-0.008333333767950535f), 0.1666666716337204f);
    const float t67 = fma(t37, (-2.7557318844628753e-6f), 0.00019841270113829523f);
    const float t68 = fma(t38, t67, t64);
    const float t71 = fma(t37, (-1.6059044372074283e-10f), 2.5052107943679403e-8f);
    const float t74 = fma(t37, (-2.8114573589663704e-15f), 7.647163609812713e-13f);
    const float t75 = fma(t38, t74, t71);
    const float t76 = fma(t39, t75, t68);
    const float t79 = fma(t37, (-1.9572941524685808e-20f), 8.220635078476521e-18f);
    const float t80 = fma(t40, t79, t76);
    const float t83 = fma(t37, 0.0055555556900799274f, (-0.0833333358168602f));
    const float t86 = fma(t37, 2.2045855985197704e-6f, (-0.00014880952949170023f));
    const float t87 = fma(t38, t86, t83);
    const float t90 = fma(t37, 1.3764894779555448e-10f, (-2.0876756323673362e-8f));
    const float t92 = fma(t38, (-6.691268090823488e-13f), t90);
    const float t93 = fma(t39, t92, t87);
    const float t96 = fma(t37, 0.0007936508045531809f, (-0.01666666753590107f));
    const float t99 = fma(t37, 2.0041686354943522e-7f, (-1.6534391761524603e-5f));
    const float t100 = fma(t38, t99, t96);
    const float t103 = fma(t37, 9.17659611493482e-12f, (-1.6059044094518526e-9f));
    const float t105 = fma(t38, (-3.936040133146329e-14f), t103);
    const float t106 = fma(t39, t105, t100);
    const float t107 = -mu[2];
    const float t108 = mu[1] * t25;
    const float t109 = fma(t21, t107, t108);
    const float t110 = -mu[0];
    const float t111 = mu[2] * t15;
    const float t112 = fma(t25, t110, t111);
    const float t113 = -mu[1];
    const float t114 = mu[0] * t21;
    const float t115 = fma(t15, t113, t114);
    const float t116 = -t115;
    const float t117 = t25 * t112;
    const float t118 = fma(t21, t116, t117);
    const float t119 = -t109;
    const float t120 = t15 * t115;
    const float t121 = fma(t25, t119, t120);
    const float t122 = -t112;
    const float t123 = t21 * t109;
    const float t124 = fma(t15, t122, t123);
    const float t125 = fma(t61, t109, mu[0]);
    const float t126 = fma(t61, t112, mu[1]);
    const float t127 = fma(t61, t115, mu[2]);
    const float t128 = fma(t80, t118, t125);
    const float t129 = fma(t80, t121, t126);
    const float t130 = fma(t80, t124, t127);
    const float t131 = t93 * t109;
    const float t132 = t93 * t112;
    const float t133 = t93 * t115;
    const float t134 = fma(t106, t118, t131);
    const float t135 = fma(t106, t121, t132);
    const float t136 = fma(t106, t124, t133);
    const float t137 = -t80;
    const float t138 = fma(mu[0], t137, t134);
    const float t139 = fma(mu[1], t137, t135);
    const float t140 = fma(mu[2], t137, t136);
    const float t141 = mu[0] * t61;
    const float t142 = mu[1] * t61;
    const float t143 = mu[2] * t61;
    const float t144 = fma(t80, t109, t141);
    const float t145 = fma(t80, t112, t142);
    const float t146 = fma(t80, t115, t143);
    const float t147 = mu[0] * t15;
    const float t148 = fma(mu[1], t21, t147);
    const float t149 = fma(mu[2], t25, t148);
    const float t150 = t80 * t149;
    const float t151 = -t146;
    const float t152 = -t144;
    const float t153 = -t145;
    const float t154 = fma(t15, t138, t150);
    const float t155 = fma(t21, t138, t151);
    const float t156 = fma(t25, t138, t145);
    const float t157 = fma(t15, t139, t146);
    const float t158 = fma(t21, t139, t150);
    const float t159 = fma(t25, t139, t152);
    const float t160 = fma(t15, t140, t153);
    const float t161 = fma(t21, t140, t144);
    const float t162 = fma(t25, t140, t150);
    const float t164 = -t154;
    const float t165 = -t155;
    const float t166 = -t156;
    const float t167 = -t157;
    const float t168 = -t158;
    const float t169 = -t159;
    const float t170 = -t160;
    const float t171 = -t161;
    const float t172 = -t162;
    const float t173 = fma(t14, t164, 1.0f);
    const float t174 = fma(t28, t165, t173);
    const float t175 = fma(t31, t166, t174);
    const float t176 = t28 * t164;
    const float t177 = fma(t20, t165, t176);
    const float t178 = fma(t34, t166, t177);
    const float t179 = t31 * t164;
    const float t180 = fma(t34, t165, t179);
    const float t181 = fma(t24, t166, t180);
    const float t182 = t14 * t167;
    const float t183 = fma(t28, t168, t182);
    const float t184 = fma(t31, t169, t183);
    const float t185 = fma(t28, t167, 1.0f);
    const float t186 = fma(t20, t168, t185);
    const float t187 = fma(t34, t169, t186);
    const float t188 = t31 * t167;
    const float t189 = fma(t34, t168, t188);
    const float t190 = fma(t24, t169, t189);
    const float t191 = t14 * t170;
    const float t192 = fma(t28, t171, t191);
    const float t193 = fma(t31, t172, t192);
    const float t194 = t28 * t170;
    const float t195 = fma(t20, t171, t194);
    const float t196 = fma(t34, t172, t195);
    const float t197 = fma(t31, t170, 1.0f);
    const float t198 = fma(t34, t171, t197);
    const float t199 = fma(t24, t172, t198);
    const float t200 = p[0] - t128;
    const float t201 = p[1] - t129;
    const float t202 = p[2] - t130;
    const float t203 = t187 * t199;
    const float t204 = -t190;
    const float t205 = fma(t196, t204, t203);
    const float t206 = t181 * t196;
    const float t207 = -t199;
    const float t208 = fma(t178, t207, t206);
    const float t209 = t178 * t190;
    const float t210 = -t181;
    const float t211 = fma(t187, t210, t209);
    const float t212 = t190 * t193;
    const float t213 = -t184;
    const float t214 = fma(t199, t213, t212);
    const float t215 = t175 * t199;
    const float t216 = -t193;
    const float t217 = fma(t181, t216, t215);
    const float t218 = t181 * t184;
    const float t219 = -t175;
    const float t220 = fma(t190, t219, t218);
    const float t221 = t184 * t196;
    const float t222 = -t187;
    const float t223 = fma(t193, t222, t221);
    const float t224 = t178 * t193;
    const float t225 = -t196;
    const float t226 = fma(t175, t225, t224);
    const float t227 = t175 * t187;
    const float t228 = -t178;
    const float t229 = fma(t184, t228, t227);
    const float t230 = t175 * t205;
    const float t231 = fma(t178, t214, t230);
    const float t232 = fma(t181, t223, t231);
    const float t233 = 1.0f / t232;
    const float t234 = 1.0f - t175;
    const float t235 = 1.0f - t187;
    const float t236 = 1.0f - t199;
    const float t238 = t234 * 2.0f;
    const float t239 = t228 * 2.0f;
    const float t240 = t210 * 2.0f;
    const float t241 = t213 * 2.0f;
    const float t242 = t235 * 2.0f;
    const float t243 = t204 * 2.0f;
    const float t244 = t216 * 2.0f;
    const float t245 = t225 * 2.0f;
    const float t246 = t236 * 2.0f;
    const float t247 = t15 + t243;
    const float t248 = t240 - t21;
    const float t249 = t245 - t15;
    const float t250 = t25 + t239;
    const float t251 = t21 + t244;
    const float t252 = t241 - t25;
    const float t253 = t238 * t238;
    const float t254 = fabs(t253);
    const float t255 = t250 * t252;
    const float t256 = fabs(t255);
    const float t257 = t254 + t256;
    const float t258 = t248 * t251;
    const float t259 = fabs(t258);
    const float t260 = t257 + t259;
    const float t261 = t242 * t242;
    const float t262 = fabs(t261);
    const float t263 = t256 + t262;
    const float t264 = t247 * t249;
    const float t265 = fabs(t264);
    const float t266 = t263 + t265;
    const float t267 = t259 + t265;
    const float t268 = t246 * t246;
    const float t269 = fabs(t268);
    const float t270 = t267 + t269;
    const float t271 = fabs(t260);
    const float t272 = fabs(t266);
    const float t273 = (t272 <= t271) ? t271 : t272;
    const float t274 = fabs(t270);
    const float t275 = (t274 <= t273) ? t273 : t274;
    const float t277 = t200 * t205;
    const float t278 = fma(t201, t208, t277);
    const float t279 = fma(t202, t211, t278);
    const float t280 = t200 * t214;
    const float t281 = fma(t201, t217, t280);
    const float t282 = fma(t202, t220, t281);
    const float t283 = t200 * t223;
    const float t284 = fma(t201, t226, t283);
    const float t285 = fma(t202, t229, t284);
    const float t286 = t233 * t279;
    const float t287 = t233 * t282;
    const float t288 = t233 * t285;
    const float t289 = t14 * t286;
    const float t290 = fma(t28, t287, t289);
    const float t291 = fma(t31, t288, t290);
    const float t292 = t28 * t286;
    const float t293 = fma(t20, t287, t292);
    const float t294 = fma(t34, t288, t293);
    const float t295 = t31 * t286;
    const float t296 = fma(t34, t287, t295);
    const float t297 = fma(t24, t288, t296);
    const float t298 = p[0] - t286;
    const float t299 = p[1] - t287;
    const float t300 = p[2] - t288;
    const float t301 = t15 - t291;
    const float t302 = t21 - t294;
    const float t303 = t25 - t297;
    const float t304 = fabs(t286);
    const float t305 = fabs(t287);
    const float t306 = (t305 <= t304) ? t304 : t305;
    const float t307 = fabs(t288);
    const float t308 = (t307 <= t306) ? t306 : t307;
    const float t309 = k[0] * t308;
    const float t311 = (t275 <= 3.609999895095825f) ? t309 : 3.4028234663852886e38f;
    const float t312 = fabs(t291);
    const float t313 = fabs(t294);
    const float t314 = (t313 <= t312) ? t312 : t313;
    const float t315 = fabs(t297);
    const float t316 = (t315 <= t314) ? t314 : t315;
    const float t317 = fabs(t15);
    const float t318 = fabs(t21);
    const float t319 = (t318 <= t317) ? t317 : t318;
    const float t320 = fabs(t25);
    const float t321 = (t320 <= t319) ? t319 : t320;
    const float t322 = t321 * t321;
    const float t324 = t322 * 0.25f;
    const float t325 = t311 * t324;
    const float t326 = fma(0.5f, t316, t325);
    const float t327 = k[1] * t311;
    const float t328 = fma(t316, t326, t327);
    const float t332 = 1.1920928955078125e-7f * 4.0f;
    const float t333 = (t311 <= 0.0010000000474974513f) ? t328 : t311;
    const float t334 = (t333 <= t311) ? t333 : t311;
    const float t335 = (t311 <= t332) ? t334 : t333;
    p_next[0] = t298;
    p_next[1] = t299;
    p_next[2] = t300;
    x[0] = t301;
    x[1] = t302;
    x[2] = t303;
    *residual_bound = t335;
    *moved = t311;
}

INLINE void coadjoint_accept(const float *RESTRICT mu, const float *RESTRICT x, float residual_bound, float distance, float *RESTRICT right)
{
    const float t10 = 1.1920928955078125e-7f * 4.0f;
    const float t12 = x[0] * x[0];
    const float t13 = fma(x[1], x[1], t12);
    const float t14 = fma(x[2], x[2], t13);
    const float t16 = t14 * 0.10132118314504623f;
    const float t18 = fabs(t16);
    const float t19 = t16 - t16;
    const float t20 = t18 + t19;
    const float t25 = (coadjoint_slots[45] <= 3.4028234663852886e38f) ? 4.0f : 9.0f;
    const float t26 = t20 * t25;
    const float t27 = mu[0] * mu[0];
    const float t28 = fma(mu[1], mu[1], t27);
    const float t29 = fma(mu[2], mu[2], t28);
    const float t30 = (t29 <= coadjoint_slots[45]) ? 1.0f : 0.0f;
    const float t31 = (t26 <= 1.0f) ? t30 : 0.0f;
    const float t32 = (distance <= 0.05000000074505806f) ? t31 : 0.0f;
    const float t33 = (residual_bound <= t10) ? t32 : 0.0f;
    *right = t33;
}

INLINE void coadjoint_transport(const float *RESTRICT g, const float *RESTRICT mu, const float *RESTRICT x, float *RESTRICT g_next, float *RESTRICT mu_next)
{
    const float t10 = x[0] * x[0];
    const float t11 = fma(x[1], x[1], t10);
    const float t12 = fma(x[2], x[2], t11);
    const float t13 = t12 * t12;
    const float t14 = t13 * t13;
    const float t15 = t14 * t14;
    const float t18 = fma(t12, (-0.125f), 1.0f);
    const float t21 = fma(t12, (-2.1701389414374717e-5f), 0.0026041667442768812f);
    const float t22 = fma(t13, t21, t18);
    const float t25 = fma(t12, (-2.691144529443079e-10f), 9.688120172768322e-8f);
    const float t28 = fma(t12, (-7.00118735382627e-16f), 5.0968642284141e-13f);
    const float t29 = fma(t13, t28, t25);
    const float t30 = fma(t14, t29, t22);
    const float t32 = fma(t15, 7.29290352803489e-19f, t30);
    const float t35 = fma(t12, (-0.02083333395421505f), 0.5f);
    const float t38 = fma(t12, (-1.5500992276429315e-6f), 0.0002604166802484542f);
    const float t39 = fma(t13, t38, t35);
    const float t42 = fma(t12, (-1.2232474581874708e-11f), 5.382288836841553e-9f);
    const float t45 = fma(t12, (-2.3337291289711648e-17f), 1.960332564950474e-14f);
    const float t46 = fma(t13, t45, t42);
    const float t47 = fma(t14, t46, t39);
    const float t49 = fma(t15, 2.1449717399340594e-20f, t47);
    const float t50 = x[0] * t49;
    const float t51 = x[1] * t49;
    const float t52 = x[2] * t49;
    const float t53 = g[1] * t50;
    const float t54 = fma(g[2], t51, t53);
    const float t55 = fma(g[3], t52, t54);
    const float t56 = -t55;
    const float t57 = fma(g[0], t32, t56);
    const float t58 = -g[3];
    const float t59 = g[2] * t52;
    const float t60 = fma(t51, t58, t59);
    const float t61 = -g[1];
    const float t62 = g[3] * t50;
    const float t63 = fma(t52, t61, t62);
    const float t64 = -g[2];
    const float t65 = g[1] * t51;
    const float t66 = fma(t50, t64, t65);
    const float t67 = fma(g[0], t50, t60);
    const float t68 = fma(g[0], t51, t63);
    const float t69 = fma(g[0], t52, t66);
    const float t70 = fma(g[1], t32, t67);
    const float t71 = fma(g[2], t32, t68);
    const float t72 = fma(g[3], t32, t69);
    const float t73 = t57 * t57;
    const float t74 = fma(t70, t70, t73);
    const float t75 = fma(t71, t71, t74);
    const float t76 = fma(t72, t72, t75);
    const float t79 = fma(t76, (-0.5f), 1.5f);
    const float t80 = t57 * t79;
    const float t81 = t70 * t79;
    const float t82 = t71 * t79;
    const float t83 = t72 * t79;
    const float t84 = -mu[2];
    const float t85 = mu[1] * x[2];
    const float t86 = fma(x[1], t84, t85);
    const float t87 = -mu[0];
    const float t88 = mu[2] * x[0];
    const float t89 = fma(x[2], t87, t88);
    const float t90 = -mu[1];
    const float t91 = mu[0] * x[1];
    const float t92 = fma(x[0], t90, t91);
    const float t94 = t49 * 2.0f;
    const float t95 = t32 * t94;
    const float t96 = fma(t86, t95, mu[0]);
    const float t97 = fma(t89, t95, mu[1]);
    const float t98 = fma(t92, t95, mu[2]);
    const float t99 = t49 * t94;
    const float t100 = -t92;
    const float t101 = x[2] * t89;
    const float t102 = fma(x[1], t100, t101);
    const float t103 = -t86;
    const float t104 = x[0] * t92;
    const float t105 = fma(x[2], t103, t104);
    const float t106 = -t89;
    const float t107 = x[1] * t86;
    const float t108 = fma(x[0], t106, t107);
    const float t109 = fma(t99, t102, t96);
    const float t110 = fma(t99, t105, t97);
    const float t111 = fma(t99, t108, t98);
    g_next[0] = t80;
    g_next[1] = t81;
    g_next[2] = t82;
    g_next[3] = t83;
    mu_next[0] = t109;
    mu_next[1] = t110;
    mu_next[2] = t111;
}

INLINE void coadjoint_sound(const float *RESTRICT g, const float *RESTRICT mu, float *RESTRICT right)
{
    const float t8 = g[0] * g[0];
    const float t9 = fma(g[1], g[1], t8);
    const float t10 = fma(g[2], g[2], t9);
    const float t11 = fma(g[3], g[3], t10);
    const float t13 = t11 - 1.0f;
    const float t14 = fabs(t13);
    const float t15 = mu[0] - mu[0];
    const float t16 = mu[1] - mu[1];
    const float t17 = t15 + t16;
    const float t18 = mu[2] - mu[2];
    const float t19 = t17 + t18;
    const float t20 = t14 + t19;
    const float t22 = sqrt(1.1920928955078125e-7f);
    const float t23 = (t20 <= t22) ? 1.0f : 0.0f;
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
    float x[3] = {0};
    COUNT done = 0u;
    while ((why == 0u) && (done < steps)) {
        COUNT count = 0u;
        float g_start[4];
        float mu_start[3];
        coadjoint_copy(g_start, g, 4u);
        coadjoint_copy(mu_start, mu, 3u);
        while ((why == 0u) && (done < steps) && (count < 256u)) {
            float p[3];
            float k[2];
            float residual_bound = 1.0f;
            float distance = 0.0f;
            float right = 0.0f;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(residual_bound <= TOLERANCE) && distance <= NEAR)) {
                float moved = 0.0f;
                float p_next[3];
                coadjoint_correct(p, mu, k, p_next, x, &residual_bound, &moved);
                coadjoint_copy(p, p_next, 3u);
                distance = distance + moved;
                tried++;
            }
            coadjoint_accept(mu, x, residual_bound, distance, &right);
            if (right != ONE) {
                why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;
            }
            if (right == ONE) {
                float g_next[4];
                float mu_next[3];
                coadjoint_transport(g, mu, x, g_next, mu_next);
                coadjoint_copy(g, g_next, 4u);
                coadjoint_copy(mu, mu_next, 3u);
                done++;
                count++;
            }
        }
        if (count >= 1u) {
            float right = 0.0f;
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
