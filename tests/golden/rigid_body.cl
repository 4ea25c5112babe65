/*
 * rigid_body, K = 3, h = 0.1
 *
 * coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of single precision.
 * Number i of trajectory r is at i * rows + r of g (4 numbers each) and mu (3 each). Trajectory r goes from
 * step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:
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
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 0x1p-21f
#define NEAR 0x1.99999ap-5f

__constant NUMBER coadjoint_slots[46] = {
    0x1.111112p-4f,
    0x1.8daea2p-19f,
    0x1.f11a4ap-21f,
    0x1.99999ap-5f,
    0x1.2a42fap-21f,
    0x1.47ae14p-5f,
    0x1.f11a4ap-20f,
    0x1.8daea2p-18f,
    0x1.2a42fap-20f,
    (-0x1.47ae14p-8f),
    0x1.65e9f8p-21f,
    0x1.bf6476p-23f,
    1.0f,
    (-0x1.46394p-13f),
    0x1.a4ccfep-29f,
    (-0x1.d208a6p-16f),
    (-0x1.2e3d0ap-26f),
    (-0x1.23a232p-28f),
    0x1.2a42fap-20f,
    (-0x1.a831bep-27f),
    (-0x1.a831bep-27f),
    1.0f,
    (-0x1.a36e2ep-14f),
    0x1.1d0efep-29f,
    (-0x1.dd37f6p-28f),
    0x1.b4e81cp-7f,
    (-0x1.1660a4p-20f),
    0x1.2a42fap-20f,
    (-0x1.36b06ep-16f),
    0x1.8bea28p-27f,
    (-0x1.cb8b38p-29f),
    0x1.091f16p-22f,
    0x1.1acbd4p-28f,
    1.0f,
    0x1.5d867cp-14f,
    (-0x1.316b7ep-28f),
    0x1.dd37f6p-29f,
    (-0x1.111112p-7f),
    0x1.2a42fap-20f,
    (-0x1.36b06ep-21f),
    0x1.36b06ep-15f,
    (-0x1.f1b8a8p-30f),
    (-0x1.2c7892p-27f),
    (-0x1.4b66dcp-21f),
    0x1.1acbd4p-28f,
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
    const float t88 = 0x1p-126f + t87;
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
    const float t38 = t15 * t15;
    const float t39 = fma(t21, t21, t38);
    const float t40 = fma(t25, t25, t39);
    const float t51 = fma(t40, (-0x1.555556p-5f), 0x1p-1f);
    const float t52 = fma(t40, (-0x1.a01a02p-16f), 0x1.6c16c2p-10f);
    const float t53 = fma(t40, (-0x1.1eed8ep-29f), 0x1.27e4fcp-22f);
    const float t54 = fma(t40, (-0x1.ae7f3ep-45f), 0x1.93974ap-37f);
    const float t55 = fma(t40, (-0x1.e542bap-62f), 0x1.682786p-53f);
    const float t56 = t40 * t40;
    const float t57 = fma(t52, t56, t51);
    const float t58 = fma(t54, t56, t53);
    const float t59 = fma(0x1.0ce396p-70f, t56, t55);
    const float t60 = t56 * t56;
    const float t61 = fma(t58, t60, t57);
    const float t62 = t60 * t60;
    const float t63 = fma(t59, t62, t61);
    const float t74 = fma(t40, (-0x1.111112p-7f), 0x1.555556p-3f);
    const float t75 = fma(t40, (-0x1.71de3ap-19f), 0x1.a01a02p-13f);
    const float t76 = fma(t40, (-0x1.612462p-33f), 0x1.ae6456p-26f);
    const float t77 = fma(t40, (-0x1.952c78p-49f), 0x1.ae7f3ep-41f);
    const float t78 = fma(t40, (-0x1.71b8fp-66f), 0x1.2f49b4p-57f);
    const float t79 = fma(t56, t75, t74);
    const float t80 = fma(t56, t77, t76);
    const float t81 = fma(t60, t80, t79);
    const float t82 = fma(t62, t78, t81);
    const float t90 = fma(t40, 0x1.6c16c2p-8f, (-0x1.555556p-4f));
    const float t91 = fma(t40, 0x1.27e4fcp-19f, (-0x1.381382p-13f));
    const float t92 = fma(t40, 0x1.2eb178p-33f, (-0x1.66a8f2p-26f));
    const float t93 = fma(t56, t91, t90);
    const float t94 = fma(t56, (-0x1.78af56p-41f), t92);
    const float t95 = fma(t60, t94, t93);
    const float t103 = fma(t40, 0x1.a01a02p-11f, (-0x1.111112p-6f));
    const float t104 = fma(t40, 0x1.ae6456p-23f, (-0x1.1566acp-16f));
    const float t105 = fma(t40, 0x1.42df6ep-37f, (-0x1.b96d7ap-30f));
    const float t106 = fma(t56, t104, t103);
    const float t107 = fma(t56, (-0x1.6286e8p-45f), t105);
    const float t108 = fma(t60, t107, t106);
    const float t109 = mu[1] * t25;
    const float t110 = -mu[2];
    const float t111 = fma(t21, t110, t109);
    const float t112 = mu[2] * t15;
    const float t113 = -mu[0];
    const float t114 = fma(t25, t113, t112);
    const float t115 = mu[0] * t21;
    const float t116 = -mu[1];
    const float t117 = fma(t15, t116, t115);
    const float t118 = t25 * t114;
    const float t119 = -t117;
    const float t120 = fma(t21, t119, t118);
    const float t121 = t15 * t117;
    const float t122 = -t111;
    const float t123 = fma(t25, t122, t121);
    const float t124 = t21 * t111;
    const float t125 = -t114;
    const float t126 = fma(t15, t125, t124);
    const float t127 = fma(t63, t111, mu[0]);
    const float t128 = fma(t63, t114, mu[1]);
    const float t129 = fma(t63, t117, mu[2]);
    const float t130 = fma(t82, t120, t127);
    const float t131 = fma(t82, t123, t128);
    const float t132 = fma(t82, t126, t129);
    const float t133 = t95 * t111;
    const float t134 = t95 * t114;
    const float t135 = t95 * t117;
    const float t136 = fma(t108, t120, t133);
    const float t137 = fma(t108, t123, t134);
    const float t138 = fma(t108, t126, t135);
    const float t139 = -t82;
    const float t140 = fma(mu[0], t139, t136);
    const float t141 = fma(mu[1], t139, t137);
    const float t142 = fma(mu[2], t139, t138);
    const float t143 = mu[0] * t63;
    const float t144 = mu[1] * t63;
    const float t145 = mu[2] * t63;
    const float t146 = fma(t82, t111, t143);
    const float t147 = fma(t82, t114, t144);
    const float t148 = fma(t82, t117, t145);
    const float t149 = mu[0] * t15;
    const float t150 = fma(mu[1], t21, t149);
    const float t151 = fma(mu[2], t25, t150);
    const float t152 = t82 * t151;
    const float t153 = -t146;
    const float t154 = -t147;
    const float t155 = -t148;
    const float t156 = fma(t15, t140, t152);
    const float t157 = fma(t21, t140, t155);
    const float t158 = fma(t25, t140, t147);
    const float t159 = fma(t15, t141, t148);
    const float t160 = fma(t21, t141, t152);
    const float t161 = fma(t25, t141, t153);
    const float t162 = fma(t15, t142, t154);
    const float t163 = fma(t21, t142, t146);
    const float t164 = fma(t25, t142, t152);
    const float t165 = -t156;
    const float t166 = -t157;
    const float t167 = -t158;
    const float t168 = -t159;
    const float t169 = -t160;
    const float t170 = -t161;
    const float t171 = -t162;
    const float t172 = -t163;
    const float t173 = -t164;
    const float t174 = fma(t14, t165, 1.0f);
    const float t175 = fma(t28, t166, t174);
    const float t176 = fma(t31, t167, t175);
    const float t177 = t28 * t165;
    const float t178 = fma(t20, t166, t177);
    const float t179 = fma(t34, t167, t178);
    const float t180 = t31 * t165;
    const float t181 = fma(t34, t166, t180);
    const float t182 = fma(t24, t167, t181);
    const float t183 = t14 * t168;
    const float t184 = fma(t28, t169, t183);
    const float t185 = fma(t31, t170, t184);
    const float t186 = fma(t28, t168, 1.0f);
    const float t187 = fma(t20, t169, t186);
    const float t188 = fma(t34, t170, t187);
    const float t189 = t31 * t168;
    const float t190 = fma(t34, t169, t189);
    const float t191 = fma(t24, t170, t190);
    const float t192 = t14 * t171;
    const float t193 = fma(t28, t172, t192);
    const float t194 = fma(t31, t173, t193);
    const float t195 = t28 * t171;
    const float t196 = fma(t20, t172, t195);
    const float t197 = fma(t34, t173, t196);
    const float t198 = fma(t31, t171, 1.0f);
    const float t199 = fma(t34, t172, t198);
    const float t200 = fma(t24, t173, t199);
    const float t201 = p[0] - t130;
    const float t202 = p[1] - t131;
    const float t203 = p[2] - t132;
    const float t204 = t188 * t200;
    const float t205 = -t191;
    const float t206 = fma(t197, t205, t204);
    const float t207 = t182 * t197;
    const float t208 = -t200;
    const float t209 = fma(t179, t208, t207);
    const float t210 = t179 * t191;
    const float t211 = -t182;
    const float t212 = fma(t188, t211, t210);
    const float t213 = t191 * t194;
    const float t214 = -t185;
    const float t215 = fma(t200, t214, t213);
    const float t216 = t176 * t200;
    const float t217 = -t194;
    const float t218 = fma(t182, t217, t216);
    const float t219 = t182 * t185;
    const float t220 = -t176;
    const float t221 = fma(t191, t220, t219);
    const float t222 = t185 * t197;
    const float t223 = -t188;
    const float t224 = fma(t194, t223, t222);
    const float t225 = t179 * t194;
    const float t226 = -t197;
    const float t227 = fma(t176, t226, t225);
    const float t228 = t176 * t188;
    const float t229 = -t179;
    const float t230 = fma(t185, t229, t228);
    const float t231 = t176 * t206;
    const float t232 = fma(t179, t215, t231);
    const float t233 = fma(t182, t224, t232);
    const float t234 = 1.0f / t233;
    const float t235 = 1.0f - t176;
    const float t236 = 1.0f - t188;
    const float t237 = 1.0f - t200;
    const float t239 = t235 * 2.0f;
    const float t240 = t229 * 2.0f;
    const float t241 = t211 * 2.0f;
    const float t242 = t214 * 2.0f;
    const float t243 = t236 * 2.0f;
    const float t244 = t205 * 2.0f;
    const float t245 = t217 * 2.0f;
    const float t246 = t226 * 2.0f;
    const float t247 = t237 * 2.0f;
    const float t248 = t15 + t244;
    const float t249 = t241 - t21;
    const float t250 = t246 - t15;
    const float t251 = t25 + t240;
    const float t252 = t21 + t245;
    const float t253 = t242 - t25;
    const float t254 = t239 * t239;
    const float t255 = fabs(t254);
    const float t256 = t251 * t253;
    const float t257 = fabs(t256);
    const float t258 = t255 + t257;
    const float t259 = t249 * t252;
    const float t260 = fabs(t259);
    const float t261 = t258 + t260;
    const float t262 = t243 * t243;
    const float t263 = fabs(t262);
    const float t264 = t257 + t263;
    const float t265 = t248 * t250;
    const float t266 = fabs(t265);
    const float t267 = t264 + t266;
    const float t268 = t260 + t266;
    const float t269 = t247 * t247;
    const float t270 = fabs(t269);
    const float t271 = t268 + t270;
    const float t272 = fabs(t261);
    const float t273 = fabs(t267);
    const float t274 = (t273 <= t272) ? t272 : t273;
    const float t275 = fabs(t271);
    const float t276 = (t275 <= t274) ? t274 : t275;
    const float t278 = t201 * t206;
    const float t279 = fma(t202, t209, t278);
    const float t280 = fma(t203, t212, t279);
    const float t281 = t201 * t215;
    const float t282 = fma(t202, t218, t281);
    const float t283 = fma(t203, t221, t282);
    const float t284 = t201 * t224;
    const float t285 = fma(t202, t227, t284);
    const float t286 = fma(t203, t230, t285);
    const float t287 = t234 * t280;
    const float t288 = t234 * t283;
    const float t289 = t234 * t286;
    const float t290 = t14 * t287;
    const float t291 = fma(t28, t288, t290);
    const float t292 = fma(t31, t289, t291);
    const float t293 = t28 * t287;
    const float t294 = fma(t20, t288, t293);
    const float t295 = fma(t34, t289, t294);
    const float t296 = t31 * t287;
    const float t297 = fma(t34, t288, t296);
    const float t298 = fma(t24, t289, t297);
    const float t299 = p[0] - t287;
    const float t300 = p[1] - t288;
    const float t301 = p[2] - t289;
    const float t302 = t15 - t292;
    const float t303 = t21 - t295;
    const float t304 = t25 - t298;
    const float t305 = fabs(t287);
    const float t306 = fabs(t288);
    const float t307 = (t306 <= t305) ? t305 : t306;
    const float t308 = fabs(t289);
    const float t309 = (t308 <= t307) ? t307 : t308;
    const float t310 = k[0] * t309;
    const float t312 = (t276 <= 0x1.ce147ap+1f) ? t310 : 0x1.fffffep+127f;
    const float t313 = fabs(t292);
    const float t314 = fabs(t295);
    const float t315 = (t314 <= t313) ? t313 : t314;
    const float t316 = fabs(t298);
    const float t317 = (t316 <= t315) ? t315 : t316;
    const float t318 = fabs(t15);
    const float t319 = fabs(t21);
    const float t320 = (t319 <= t318) ? t318 : t319;
    const float t321 = fabs(t25);
    const float t322 = (t321 <= t320) ? t320 : t321;
    const float t323 = t322 * t322;
    const float t324 = 0x1p-2f * t323;
    const float t325 = t312 * t324;
    const float t326 = fma(0x1p-1f, t317, t325);
    const float t327 = k[1] * t312;
    const float t328 = fma(t317, t326, t327);
    const float t332 = 0x1p-23f * 4.0f;
    const float t333 = (t312 <= 0x1.0624dep-10f) ? t328 : t312;
    const float t334 = (t333 <= t312) ? t333 : t312;
    const float t335 = (t312 <= t332) ? t334 : t333;
    p_next[0] = t299;
    p_next[1] = t300;
    p_next[2] = t301;
    x[0] = t302;
    x[1] = t303;
    x[2] = t304;
    *residual_bound = t335;
    *moved = t312;
}

INLINE void coadjoint_accept(const float *RESTRICT mu, const float *RESTRICT x, float residual_bound, float distance, float *RESTRICT right)
{
    const float t10 = 0x1p-23f * 4.0f;
    const float t13 = x[0] * x[0];
    const float t14 = fma(x[1], x[1], t13);
    const float t15 = fma(x[2], x[2], t14);
    const float t17 = t15 * 0x1.9f02f6p-4f;
    const float t18 = fabs(t17);
    const float t21 = (t17 <= INFINITY) ? 0.0f : 1.0f;
    const float t22 = t21 + t21;
    const float t23 = t18 + t22;
    const float t27 = (coadjoint_slots[45] <= 0x1.fffffep+127f) ? 4.0f : 9.0f;
    const float t28 = t23 * t27;
    const float t29 = mu[0] * mu[0];
    const float t30 = fma(mu[1], mu[1], t29);
    const float t31 = fma(mu[2], mu[2], t30);
    const float t32 = (t31 <= coadjoint_slots[45]) ? 1.0f : 0.0f;
    const float t33 = (t28 <= 1.0f) ? t32 : 0.0f;
    const float t34 = (distance <= 0x1.99999ap-5f) ? t33 : 0.0f;
    const float t35 = (residual_bound <= t10) ? t34 : 0.0f;
    *right = t35;
}

INLINE void coadjoint_transport(const float *RESTRICT g, const float *RESTRICT mu, const float *RESTRICT x, float *RESTRICT g_next, float *RESTRICT mu_next)
{
    const float t10 = x[0] * x[0];
    const float t11 = fma(x[1], x[1], t10);
    const float t12 = fma(x[2], x[2], t11);
    const float t22 = fma(t12, (-0x1p-3f), 1.0f);
    const float t23 = fma(t12, (-0x1.6c16c2p-16f), 0x1.555556p-9f);
    const float t24 = fma(t12, (-0x1.27e4fcp-32f), 0x1.a01a02p-24f);
    const float t25 = fma(t12, (-0x1.93974ap-51f), 0x1.1eed8ep-41f);
    const float t26 = t12 * t12;
    const float t27 = fma(t23, t26, t22);
    const float t28 = fma(t25, t26, t24);
    const float t29 = t26 * t26;
    const float t30 = fma(t28, t29, t27);
    const float t31 = t29 * t29;
    const float t32 = fma(0x1.ae7f3ep-61f, t31, t30);
    const float t42 = fma(t12, (-0x1.555556p-6f), 0x1p-1f);
    const float t43 = fma(t12, (-0x1.a01a02p-20f), 0x1.111112p-12f);
    const float t44 = fma(t12, (-0x1.ae6456p-37f), 0x1.71de3ap-28f);
    const float t45 = fma(t12, (-0x1.ae7f3ep-56f), 0x1.612462p-46f);
    const float t46 = fma(t26, t43, t42);
    const float t47 = fma(t26, t45, t44);
    const float t48 = fma(t29, t47, t46);
    const float t49 = fma(t31, 0x1.952c78p-66f, t48);
    const float t51 = mu[1] * x[2];
    const float t52 = -mu[2];
    const float t53 = fma(x[1], t52, t51);
    const float t54 = mu[2] * x[0];
    const float t55 = -mu[0];
    const float t56 = fma(x[2], t55, t54);
    const float t57 = mu[0] * x[1];
    const float t58 = -mu[1];
    const float t59 = fma(x[0], t58, t57);
    const float t60 = x[2] * t56;
    const float t61 = -t59;
    const float t62 = fma(x[1], t61, t60);
    const float t63 = x[0] * t59;
    const float t64 = -t53;
    const float t65 = fma(x[2], t64, t63);
    const float t66 = x[1] * t53;
    const float t67 = -t56;
    const float t68 = fma(x[0], t67, t66);
    const float t69 = t49 * 2.0f;
    const float t70 = t32 * t69;
    const float t71 = t49 * t69;
    const float t72 = fma(t53, t70, mu[0]);
    const float t73 = fma(t56, t70, mu[1]);
    const float t74 = fma(t59, t70, mu[2]);
    const float t75 = fma(t62, t71, t72);
    const float t76 = fma(t65, t71, t73);
    const float t77 = fma(t68, t71, t74);
    const float t78 = x[0] * t49;
    const float t79 = x[1] * t49;
    const float t80 = x[2] * t49;
    const float t81 = g[1] * t78;
    const float t82 = fma(g[2], t79, t81);
    const float t83 = fma(g[3], t80, t82);
    const float t84 = -t83;
    const float t85 = fma(g[0], t32, t84);
    const float t86 = g[2] * t80;
    const float t87 = -g[3];
    const float t88 = fma(t79, t87, t86);
    const float t89 = g[3] * t78;
    const float t90 = -g[1];
    const float t91 = fma(t80, t90, t89);
    const float t92 = g[1] * t79;
    const float t93 = -g[2];
    const float t94 = fma(t78, t93, t92);
    const float t95 = fma(g[0], t78, t88);
    const float t96 = fma(g[0], t79, t91);
    const float t97 = fma(g[0], t80, t94);
    const float t98 = fma(g[1], t32, t95);
    const float t99 = fma(g[2], t32, t96);
    const float t100 = fma(g[3], t32, t97);
    const float t101 = t85 * t85;
    const float t102 = fma(t98, t98, t101);
    const float t103 = fma(t99, t99, t102);
    const float t104 = fma(t100, t100, t103);
    const float t107 = fma(t104, (-0x1p-1f), 0x1.8p+0f);
    const float t108 = t85 * t107;
    const float t109 = t98 * t107;
    const float t110 = t99 * t107;
    const float t111 = t100 * t107;
    g_next[0] = t108;
    g_next[1] = t109;
    g_next[2] = t110;
    g_next[3] = t111;
    mu_next[0] = t75;
    mu_next[1] = t76;
    mu_next[2] = t77;
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
    const float t22 = sqrt(0x1p-23f);
    const float t23 = (t20 <= t22) ? 1.0f : 0.0f;
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
    float x[DIM] = {0};
    COUNT done = 0u;
    while ((why == 0u) && (done < steps)) {
        COUNT count = 0u;
        float g_start[ELEMENT];
        float mu_start[DIM];
        coadjoint_copy(g_start, g, ELEMENT);
        coadjoint_copy(mu_start, mu, DIM);
        while ((why == 0u) && (done < steps) && (count < 256u)) {
            float p[DIM];
            float k[2];
            float residual_bound = 1.0f;
            float distance = 0.0f;
            float right = 0.0f;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(residual_bound <= TOLERANCE) && distance <= NEAR)) {
                float moved = 0.0f;
                float p_next[DIM];
                coadjoint_correct(p, mu, k, p_next, x, &residual_bound, &moved);
                coadjoint_copy(p, p_next, DIM);
                distance = distance + moved;
                tried++;
            }
            coadjoint_accept(mu, x, residual_bound, distance, &right);
            if (!(right == ONE)) {
                why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;
            }
            if (right == ONE) {
                float g_next[ELEMENT];
                float mu_next[DIM];
                coadjoint_transport(g, mu, x, g_next, mu_next);
                coadjoint_copy(g, g_next, ELEMENT);
                coadjoint_copy(mu, mu_next, DIM);
                done++;
                count++;
            }
        }
        if (count >= 1u) {
            float right = 0.0f;
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
