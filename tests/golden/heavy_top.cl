/*
 * heavy_top, K = 3, h = 0.05
 *
 * coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of double precision.
 * Number i of trajectory r is at i * rows + r of g (7 numbers each) and mu (6 each). Trajectory r goes from
 * step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:
 * 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,
 * 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.
 * Let targets be multiples of 256, or one.
 *
 * A step takes 804 operations and 862 for each correction, most often one.
 */

#pragma OPENCL FP_CONTRACT OFF
#define KERNEL __kernel
#define INLINE static
#define CALLED static
#define GLOBAL __global
#define RESTRICT restrict
#define COUNT ulong
#define ROW get_global_id(0)
#define NUMBER double
#define ONE 1.0
#define DIM 6
#define ELEMENT 7
#define DIM_ARRAY 6
#define ELEMENT_ARRAY 7
#define TOLERANCE 0x1p-50
#define NEAR 0x1.999999999999ap-5

__constant NUMBER coadjoint_slots[238] = {
    0x1.1111111111111p-5,
    0x1.8daea1d7f4cf8p-22,
    0x1.f11a4a4df2037p-24,
    (-0x1.6dbe497c4ad45p-20),
    0x1.999999999999ap-6,
    0x1.2a42f961f79bbp-24,
    (-0x1.6dbe497c4ad45p-21),
    0x1.47ae147ae147cp-6,
    0x1.505e9ac8a14cbp-18,
    0x1.c07e23b62c664p-18,
    0x1.91d14e3bcd35bp-5,
    0x1.f11a4a4df2037p-23,
    0x1.8daea1d7f4cf8p-21,
    0x1.2a42f961f79bbp-23,
    0x1.91d14e3bcd35bp-6,
    0x1.c07e23b62c664p-19,
    (-0x1.56e264e486271p-16),
    0x1.ae8d92ec53957p-28,
    (-0x1.b6e4582ec032p-22),
    0x1.3e57cd46175a4p-30,
    0x1.4edfe40d2490ap-25,
    (-0x1.47ae147ae147cp-9),
    (-0x1.c92ddbdb5d896p-21),
    0x1.65e9f80f29213p-24,
    (-0x1.124eb71d381f4p-22),
    (-0x1.c0a526f1363e8p-28),
    0x1.bf647612f3698p-26,
    1.0,
    0x1.1dbca9691a75ep-12,
    0x1.3eed9c3d47653p-26,
    (-0x1.3eed9c3d47653p-24),
    (-0x1.f64fd613b6d8fp-26),
    (-0x1.463940c326d24p-15),
    (-0x1.0d2fe42a53bf2p-27),
    0x1.a4ccfdb7dd391p-33,
    0x1.124eb71d381f4p-19,
    0x1.ca65f5b3ac4bp-26,
    (-0x1.d208a5a912e34p-18),
    (-0x1.b6e4582ec032p-27),
    (-0x1.2e3d0a5c72605p-30),
    (-0x1.23a2326b2afeap-32),
    (-0x1.30c93d3ce9065p-19),
    0x1.555c449623b52p-26,
    0x1.2a42f961f79bbp-23,
    (-0x1.04158996f6a26p-26),
    (-0x1.a831bdb32743dp-31),
    (-0x1.a831bdb32743dp-31),
    (-0x1.91d14e3bcd35bp-6),
    (-0x1.505e9ac8a14cbp-19),
    0x1.56e264e486271p-14,
    0x1.071da0e5c14d2p-25,
    (-0x1.492b422310257p-21),
    (-0x1.5d8d961ac44fp-28),
    1.0,
    0x1.ac9afe1da7b0dp-13,
    0x1.66cb4fc4f051dp-27,
    (-0x1.1f090c9d8d0e5p-25),
    (-0x1.66cb4fc4f051dp-25),
    (-0x1.a36e2eb1c432ep-16),
    0x1.b4f0fba17562cp-31,
    0x1.1d0efe744b89cp-33,
    0x1.56e264e486271p-20,
    0x1.b6e4582ec032p-27,
    (-0x1.b6e4582ec032p-28),
    (-0x1.dd37f5698c2c5p-32),
    0x1.be7fdabc30c0ep-26,
    0x1.b4e81b4e81b4fp-8,
    0x1.4f43c35c99ed4p-19,
    (-0x1.1660a47d91c48p-23),
    (-0x1.0311740d5fabbp-19),
    0x1.34d9936344e0dp-25,
    0x1.2a42f961f79bbp-23,
    (-0x1.e7a861fb0e707p-24),
    (-0x1.a02275be576a4p-26),
    (-0x1.36b06e70b7422p-18),
    (-0x1.fd54d81cf8535p-27),
    0x1.8bea28851394ap-31,
    (-0x1.cb8b382cbfdecp-33),
    0x1.091f168ff88a6p-25,
    0x1.1acbd3ccc4d7fp-32,
    0x1.505e9ac8a14cbp-19,
    1.0,
    (-0x1.4edfe40d2490ap-26),
    (-0x1.42ea2e313eb01p-25),
    (-0x1.ac9afe1da7b0dp-13),
    (-0x1.48e5091f31a06p-25),
    0x1.124eb71d381f4p-20,
    0x1.7a6c2312b117dp-27,
    0x1.5d867c3ece2a6p-16,
    (-0x1.11169d44e95dbp-28),
    (-0x1.316b7e5807ca7p-32),
    (-0x1.24983ac9d576bp-29),
    0x1.dd37f5698c2c5p-33,
    (-0x1.1dbca9691a75ep-15),
    0x1.70c2bca6da8d1p-25,
    (-0x1.e7a861fb0e707p-21),
    0x1.7004e021221b8p-27,
    (-0x1.1111111111111p-8),
    (-0x1.0ab015954be58p-19),
    0x1.2a42f961f79bbp-23,
    (-0x1.a6a2ff9550c7dp-27),
    (-0x1.36b06e70b7422p-24),
    0x1.36b06e70b7422p-17,
    (-0x1.954c3aad6278cp-27),
    (-0x1.f1b8a7f7c0d82p-34),
    0x1.86204e6271f39p-27,
    (-0x1.2c78910991256p-31),
    (-0x1.04158996f6a26p-30),
    (-0x1.4b66dc33f6acfp-24),
    0x1.1acbd3ccc4d7fp-32,
    1.0,
    0x1.41743e963dc49p-12,
    0x1.0d187bd3b43d6p-25,
    (-0x1.1f090c9d8d0e5p-24),
    (-0x1.0d187bd3b43d6p-24),
    0x1.47ae147ae147cp-7,
    0x1.124eb71d381f4p-19,
    (-0x1.179ec9cbd821fp-14),
    (-0x1.99a1ebe75e0c9p-27),
    (-0x1.65e9f80f29213p-22),
    0x1.6e80fe033c8c8p-30,
    (-0x1.999999999999ap-7),
    (-0x1.56e264e486271p-19),
    0x1.124eb71d381f4p-20,
    0x1.56e264e486271p-18,
    0x1.000533709ac7ep-24,
    0x1.bf647612f3698p-22,
    (-0x1.b4e81b4e81b5p-14),
    (-0x1.c92ddbdb5d898p-24),
    (-0x1.4f8b588e368f2p-21),
    0x1.7dc65dee09bd1p-28,
    0x1.5d867c3ece2a6p-21,
    0x1.bf647612f3698p-29,
    (-0x1.292a9bb4fccc8p-18),
    0x1.d208a5a912e34p-16,
    0x1.451aebfcb44afp-28,
    (-0x1.a02275be576a4p-26),
    0x1.99a1ebe75e0c9p-25,
    (-0x1.39e75e4c40e56p-30),
    0x1.97c790f3f086dp-14,
    0x1.79ef4bef5e64p-24,
    (-0x1.bf647612f3698p-21),
    (-0x1.3e254e465d72ep-27),
    0x1.65e9f80f29214p-29,
    (-0x1.e3d8bc6058c96p-29),
    (-0x1.3cfa3faffc95fp-25),
    0x1.2a42f961f79bbp-22,
    (-0x1.3e254e465d72ep-28),
    0x1.74d3b7ba75829p-21,
    0x1.3e254e465d72ep-28,
    0x1.091f168ff88a6p-28,
    (-0x1.732b85fcc25b6p-28),
    1.0,
    0x1.ac9afe1da7b0dp-12,
    0x1.de646a5beb17dp-25,
    (-0x1.de646a5beb17dp-24),
    (-0x1.ae8d92ec53957p-24),
    (-0x1.47ae147ae147cp-7),
    (-0x1.9b7612abd42eep-19),
    (-0x1.179ec9cbd821fp-14),
    (-0x1.3819d84ec18fbp-26),
    0x1.65e9f80f29213p-22,
    0x1.6e80fe033c8c8p-30,
    0x1.849a2e140f819p-18,
    0x1.5d867c3ece2a6p-15,
    0x1.86204e6271f39p-27,
    0x1.d426c47622578p-25,
    (-0x1.507bdd34e8aeep-25),
    (-0x1.4adf1e34b31b5p-30),
    (-0x1.79ef4bef5e64p-25),
    (-0x1.2a42f961f79bbp-24),
    (-0x1.3e254e465d72ep-29),
    0x1.027e4f992bed6p-29,
    0x1.1111111111111p-6,
    0x1.30c93d3ce9065p-18,
    (-0x1.30c93d3ce9065p-17),
    (-0x1.4006804cc179dp-19),
    0x1.04158996f6a26p-23,
    (-0x1.f11a4a4df2037p-22),
    0x1.7aa706995f589p-13,
    0x1.57646fa951a26p-23,
    0x1.8daea1d7f4cf8p-20,
    (-0x1.fd087d3d62516p-27),
    (-0x1.55c2131596626p-20),
    (-0x1.a4e15a37c0f55p-28),
    (-0x1.845c8a0ce512ap-13),
    (-0x1.0eebc4a7eb93dp-22),
    0x1.a6898bf5741c8p-20,
    0x1.e0c0e80f4ea23p-27,
    0x1.a831bdb32743dp-30,
    0x1.968500765af65p-28,
    (-0x1.9e409340f4583p-20),
    (-0x1.58a86a218fe71p-27),
    0x1.617ec8bff60dep-27,
    1.0,
    (-0x1.ac9afe1da7b0dp-12),
    (-0x1.66cb4fc4f051dp-23),
    (-0x1.41743e963dc49p-12),
    (-0x1.93a4b9bd8e5c2p-24),
    0x1.4006804cc179dp-19,
    0x1.d426c47622578p-26,
    (-0x1.d426c47622578p-30),
    0x1.999999999999ap-7,
    0x1.0129cbab649d5p-17,
    0x1.0624dd2f1a9fdp-13,
    0x1.24983ac9d576bp-25,
    (-0x1.04fa9a35b8a83p-20),
    (-0x1.90dd15d38a39bp-28),
    (-0x1.b4e81b4e81b5p-14),
    (-0x1.6dbe497c4ad46p-25),
    0x1.24983ac9d576bp-28,
    0x1.124eb71d381f4p-24,
    0x1.7dc65dee09bd1p-28,
    (-0x1.5d867c3ece2a6p-21),
    (-0x1.a190f6bc5aa6cp-29),
    0x1.bf647612f3698p-29,
    (-0x1.1111111111111p-6),
    (-0x1.c92ddbdb5d896p-17),
    0x1.97c790f3f086dp-13,
    0x1.e3980bd4b296p-24,
    0x1.a6898bf5741c8p-20,
    (-0x1.4591b23c0f6a7p-27),
    (-0x1.9a71fd223d384p-23),
    (-0x1.f11a4a4df2037p-22),
    0x1.36b06e70b7422p-21,
    (-0x1.65e9f80f29214p-29),
    (-0x1.845c8a0ce512ap-13),
    (-0x1.b1793aa645b95p-24),
    0x1.451aebfcb44afp-23,
    0x1.e7a861fb0e708p-27,
    0x1.41ae40ec1fe8cp-27,
    (-0x1.b2f7010433c3p-20),
    (-0x1.732b85fcc25b6p-27),
    0x1.b9de7aeff3916p-27,
    0x1.9e409340f4583p-20,
    (-0x1.58a86a218fe71p-27),
    0x1.617ec8bff60dep-27,
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
    const double t6 = mu[0] * mu[0];
    const double t8 = mu[1] * mu[1];
    const double t10 = mu[2] * mu[2];
    const double t14 = fma(mu[5], coadjoint_slots[38], coadjoint_slots[37]);
    const double t15 = fma(t10, coadjoint_slots[39], t14);
    const double t16 = fma(t8, coadjoint_slots[40], t15);
    const double t17 = fma(t6, coadjoint_slots[46], t16);
    const double t20 = mu[4] * coadjoint_slots[36];
    const double t21 = fma(mu[0], coadjoint_slots[43], t20);
    const double t23 = mu[3] * coadjoint_slots[35];
    const double t24 = fma(mu[2], t21, t23);
    const double t25 = fma(mu[1], t17, t24);
    const double t30 = fma(mu[5], coadjoint_slots[33], coadjoint_slots[32]);
    const double t31 = fma(t10, coadjoint_slots[34], t30);
    const double t32 = fma(t6, coadjoint_slots[45], t31);
    const double t33 = mu[0] * mu[3];
    const double t35 = t33 * coadjoint_slots[42];
    const double t36 = fma(mu[2], t32, t35);
    const double t40 = fma(mu[5], coadjoint_slots[29], coadjoint_slots[28]);
    const double t41 = fma(t6, coadjoint_slots[44], t40);
    const double t44 = mu[4] * coadjoint_slots[30];
    const double t45 = fma(mu[0], coadjoint_slots[41], t44);
    const double t46 = mu[3] * mu[3];
    const double t49 = fma(t46, coadjoint_slots[31], coadjoint_slots[27]);
    const double t50 = fma(mu[4], t45, t49);
    const double t51 = fma(mu[5], t41, t50);
    const double t52 = fma(mu[2], t36, t51);
    const double t53 = fma(mu[1], t25, t52);
    const double t56 = mu[3] * coadjoint_slots[25];
    const double t57 = fma(mu[1], coadjoint_slots[26], t56);
    const double t61 = fma(mu[5], coadjoint_slots[22], coadjoint_slots[21]);
    const double t62 = fma(t10, coadjoint_slots[23], t61);
    const double t63 = fma(mu[1], t57, t62);
    const double t67 = fma(mu[5], coadjoint_slots[17], coadjoint_slots[16]);
    const double t68 = fma(t10, coadjoint_slots[19], t67);
    const double t69 = mu[2] * mu[4];
    const double t71 = t69 * coadjoint_slots[18];
    const double t72 = fma(mu[3], t68, t71);
    const double t73 = fma(mu[1], t63, t72);
    const double t76 = mu[3] * coadjoint_slots[20];
    const double t77 = fma(mu[1], coadjoint_slots[24], t76);
    const double t80 = fma(mu[5], coadjoint_slots[15], coadjoint_slots[14]);
    const double t81 = fma(mu[1], t77, t80);
    const double t82 = mu[4] * t81;
    const double t83 = fma(mu[2], t73, t82);
    const double t84 = fma(mu[0], t53, t83);
    const double t90 = fma(mu[5], coadjoint_slots[75], coadjoint_slots[74]);
    const double t91 = fma(t10, coadjoint_slots[76], t90);
    const double t92 = fma(t8, coadjoint_slots[77], t91);
    const double t93 = fma(t6, coadjoint_slots[79], t92);
    const double t96 = mu[3] * coadjoint_slots[70];
    const double t97 = fma(mu[1], coadjoint_slots[71], t96);
    const double t99 = mu[4] * coadjoint_slots[69];
    const double t100 = fma(mu[2], t97, t99);
    const double t101 = fma(mu[0], t93, t100);
    const double t106 = fma(mu[5], coadjoint_slots[59], coadjoint_slots[58]);
    const double t107 = fma(t10, coadjoint_slots[60], t106);
    const double t108 = fma(t8, coadjoint_slots[64], t107);
    const double t109 = mu[1] * mu[4];
    const double t111 = t109 * coadjoint_slots[62];
    const double t112 = fma(mu[2], t108, t111);
    const double t116 = fma(mu[5], coadjoint_slots[55], coadjoint_slots[54]);
    const double t117 = fma(t8, coadjoint_slots[63], t116);
    const double t120 = mu[3] * coadjoint_slots[57];
    const double t121 = fma(mu[1], coadjoint_slots[61], t120);
    const double t122 = mu[4] * mu[4];
    const double t125 = fma(t122, coadjoint_slots[56], coadjoint_slots[53]);
    const double t126 = fma(mu[3], t121, t125);
    const double t127 = fma(mu[5], t117, t126);
    const double t128 = fma(mu[2], t112, t127);
    const double t129 = fma(mu[0], t101, t128);
    const double t132 = mu[4] * coadjoint_slots[73];
    const double t133 = fma(mu[0], coadjoint_slots[78], t132);
    const double t137 = fma(mu[5], coadjoint_slots[67], coadjoint_slots[66]);
    const double t138 = fma(t10, coadjoint_slots[68], t137);
    const double t139 = fma(mu[0], t133, t138);
    const double t143 = fma(mu[5], coadjoint_slots[50], coadjoint_slots[49]);
    const double t144 = fma(t10, coadjoint_slots[52], t143);
    const double t145 = mu[2] * mu[3];
    const double t147 = t145 * coadjoint_slots[51];
    const double t148 = fma(mu[4], t144, t147);
    const double t149 = fma(mu[0], t139, t148);
    const double t152 = mu[4] * coadjoint_slots[65];
    const double t153 = fma(mu[0], coadjoint_slots[72], t152);
    const double t156 = fma(mu[5], coadjoint_slots[48], coadjoint_slots[47]);
    const double t157 = fma(mu[0], t153, t156);
    const double t158 = mu[3] * t157;
    const double t159 = fma(mu[2], t149, t158);
    const double t160 = fma(mu[1], t129, t159);
    const double t166 = fma(mu[5], coadjoint_slots[103], coadjoint_slots[102]);
    const double t167 = fma(t10, coadjoint_slots[104], t166);
    const double t168 = fma(t8, coadjoint_slots[106], t167);
    const double t169 = fma(t6, coadjoint_slots[109], t168);
    const double t172 = mu[3] * coadjoint_slots[107];
    const double t173 = fma(mu[1], coadjoint_slots[108], t172);
    const double t175 = t109 * coadjoint_slots[105];
    const double t176 = fma(mu[0], t173, t175);
    const double t177 = fma(mu[2], t169, t176);
    const double t180 = mu[3] * coadjoint_slots[100];
    const double t181 = fma(mu[1], coadjoint_slots[101], t180);
    const double t185 = fma(mu[5], coadjoint_slots[98], coadjoint_slots[97]);
    const double t186 = fma(t10, coadjoint_slots[99], t185);
    const double t187 = fma(mu[1], t181, t186);
    const double t191 = fma(mu[5], coadjoint_slots[94], coadjoint_slots[93]);
    const double t192 = fma(t10, coadjoint_slots[96], t191);
    const double t194 = t69 * coadjoint_slots[95];
    const double t195 = fma(mu[3], t192, t194);
    const double t196 = fma(mu[1], t187, t195);
    const double t197 = fma(mu[0], t177, t196);
    const double t202 = fma(mu[5], coadjoint_slots[89], coadjoint_slots[88]);
    const double t203 = fma(t10, coadjoint_slots[90], t202);
    const double t204 = fma(t8, coadjoint_slots[92], t203);
    const double t206 = mu[4] * coadjoint_slots[87];
    const double t208 = mu[3] * coadjoint_slots[86];
    const double t209 = fma(mu[2], t206, t208);
    const double t210 = fma(mu[1], t204, t209);
    const double t214 = fma(mu[5], coadjoint_slots[85], coadjoint_slots[84]);
    const double t215 = fma(t8, coadjoint_slots[91], t214);
    const double t216 = mu[4] * t215;
    const double t217 = fma(mu[2], t210, t216);
    const double t221 = fma(t122, coadjoint_slots[82], coadjoint_slots[81]);
    const double t222 = fma(t46, coadjoint_slots[83], t221);
    const double t223 = mu[3] * mu[4];
    const double t225 = t223 * coadjoint_slots[80];
    const double t226 = fma(mu[2], t222, t225);
    const double t227 = fma(mu[1], t217, t226);
    const double t228 = fma(mu[0], t197, t227);
    const double t234 = fma(mu[5], coadjoint_slots[140], coadjoint_slots[139]);
    const double t235 = fma(t10, coadjoint_slots[142], t234);
    const double t236 = fma(t8, coadjoint_slots[144], t235);
    const double t237 = fma(t6, coadjoint_slots[151], t236);
    const double t239 = mu[3] * coadjoint_slots[149];
    const double t241 = mu[5] * coadjoint_slots[148];
    const double t242 = fma(mu[1], t239, t241);
    const double t244 = mu[5] * coadjoint_slots[143];
    const double t246 = mu[3] * coadjoint_slots[141];
    const double t247 = fma(mu[1], t244, t246);
    const double t248 = mu[2] * t247;
    const double t249 = fma(mu[0], t242, t248);
    const double t250 = fma(mu[4], t237, t249);
    const double t255 = fma(mu[5], coadjoint_slots[128], coadjoint_slots[127]);
    const double t256 = fma(t10, coadjoint_slots[130], t255);
    const double t257 = fma(t8, coadjoint_slots[132], t256);
    const double t259 = mu[5] * coadjoint_slots[131];
    const double t261 = t69 * coadjoint_slots[129];
    const double t262 = fma(mu[1], t259, t261);
    const double t263 = fma(mu[3], t257, t262);
    const double t267 = fma(mu[5], coadjoint_slots[122], coadjoint_slots[121]);
    const double t268 = fma(t10, coadjoint_slots[126], t267);
    const double t270 = mu[4] * coadjoint_slots[125];
    const double t272 = mu[3] * coadjoint_slots[124];
    const double t273 = fma(mu[2], t270, t272);
    const double t275 = t122 * coadjoint_slots[123];
    const double t276 = fma(mu[3], t273, t275);
    const double t277 = fma(mu[5], t268, t276);
    const double t278 = fma(mu[1], t263, t277);
    const double t279 = fma(mu[0], t250, t278);
    const double t284 = fma(mu[5], coadjoint_slots[135], coadjoint_slots[134]);
    const double t285 = fma(t10, coadjoint_slots[138], t284);
    const double t286 = fma(t6, coadjoint_slots[150], t285);
    const double t288 = mu[3] * coadjoint_slots[147];
    const double t290 = mu[4] * coadjoint_slots[146];
    const double t291 = fma(mu[2], t288, t290);
    const double t294 = t122 * coadjoint_slots[136];
    const double t295 = fma(t46, coadjoint_slots[137], t294);
    const double t296 = fma(mu[0], t291, t295);
    const double t297 = fma(mu[5], t286, t296);
    const double t301 = fma(mu[5], coadjoint_slots[118], coadjoint_slots[117]);
    const double t302 = fma(t10, coadjoint_slots[120], t301);
    const double t304 = t69 * coadjoint_slots[119];
    const double t305 = fma(mu[3], t302, t304);
    const double t308 = fma(mu[5], coadjoint_slots[116], coadjoint_slots[115]);
    const double t309 = mu[4] * t308;
    const double t310 = fma(mu[2], t305, t309);
    const double t311 = fma(mu[0], t297, t310);
    const double t315 = fma(mu[5], coadjoint_slots[112], coadjoint_slots[111]);
    const double t316 = fma(t6, coadjoint_slots[145], t315);
    const double t319 = mu[4] * coadjoint_slots[113];
    const double t320 = fma(mu[0], coadjoint_slots[133], t319);
    const double t323 = fma(t46, coadjoint_slots[114], coadjoint_slots[110]);
    const double t324 = fma(mu[4], t320, t323);
    const double t325 = fma(mu[5], t316, t324);
    const double t326 = mu[3] * t325;
    const double t327 = fma(mu[2], t311, t326);
    const double t328 = fma(mu[1], t279, t327);
    const double t334 = fma(mu[5], coadjoint_slots[186], coadjoint_slots[185]);
    const double t335 = fma(t10, coadjoint_slots[188], t334);
    const double t336 = fma(t8, coadjoint_slots[190], t335);
    const double t337 = fma(t6, coadjoint_slots[193], t336);
    const double t339 = mu[3] * coadjoint_slots[192];
    const double t341 = mu[5] * coadjoint_slots[191];
    const double t342 = fma(mu[1], t339, t341);
    const double t344 = mu[5] * coadjoint_slots[189];
    const double t346 = mu[3] * coadjoint_slots[187];
    const double t347 = fma(mu[1], t344, t346);
    const double t348 = mu[2] * t347;
    const double t349 = fma(mu[0], t342, t348);
    const double t350 = fma(mu[4], t337, t349);
    const double t355 = fma(mu[5], coadjoint_slots[180], coadjoint_slots[179]);
    const double t356 = fma(t10, coadjoint_slots[182], t355);
    const double t357 = fma(t8, coadjoint_slots[184], t356);
    const double t359 = mu[5] * coadjoint_slots[183];
    const double t361 = t69 * coadjoint_slots[181];
    const double t362 = fma(mu[1], t359, t361);
    const double t363 = fma(mu[3], t357, t362);
    const double t367 = fma(mu[5], coadjoint_slots[174], coadjoint_slots[173]);
    const double t368 = fma(t10, coadjoint_slots[178], t367);
    const double t370 = mu[4] * coadjoint_slots[177];
    const double t372 = mu[3] * coadjoint_slots[176];
    const double t373 = fma(mu[2], t370, t372);
    const double t375 = t122 * coadjoint_slots[175];
    const double t376 = fma(mu[3], t373, t375);
    const double t377 = fma(mu[5], t368, t376);
    const double t378 = fma(mu[1], t363, t377);
    const double t379 = fma(mu[0], t350, t378);
    const double t384 = fma(mu[5], coadjoint_slots[165], coadjoint_slots[164]);
    const double t385 = fma(t10, coadjoint_slots[168], t384);
    const double t386 = fma(t8, coadjoint_slots[172], t385);
    const double t388 = mu[4] * coadjoint_slots[171];
    const double t390 = mu[3] * coadjoint_slots[170];
    const double t391 = fma(mu[2], t388, t390);
    const double t394 = t122 * coadjoint_slots[166];
    const double t395 = fma(t46, coadjoint_slots[167], t394);
    const double t396 = fma(mu[1], t391, t395);
    const double t397 = fma(mu[5], t386, t396);
    const double t401 = fma(mu[5], coadjoint_slots[160], coadjoint_slots[159]);
    const double t402 = fma(t10, coadjoint_slots[162], t401);
    const double t404 = t145 * coadjoint_slots[161];
    const double t405 = fma(mu[4], t402, t404);
    const double t408 = fma(mu[5], coadjoint_slots[158], coadjoint_slots[157]);
    const double t409 = mu[3] * t408;
    const double t410 = fma(mu[2], t405, t409);
    const double t411 = fma(mu[1], t397, t410);
    const double t415 = fma(mu[5], coadjoint_slots[154], coadjoint_slots[153]);
    const double t416 = fma(t8, coadjoint_slots[169], t415);
    const double t419 = mu[3] * coadjoint_slots[156];
    const double t420 = fma(mu[1], coadjoint_slots[163], t419);
    const double t423 = fma(t122, coadjoint_slots[155], coadjoint_slots[152]);
    const double t424 = fma(mu[3], t420, t423);
    const double t425 = fma(mu[5], t416, t424);
    const double t426 = mu[4] * t425;
    const double t427 = fma(mu[2], t411, t426);
    const double t428 = fma(mu[0], t379, t427);
    const double t434 = fma(mu[5], coadjoint_slots[227], coadjoint_slots[226]);
    const double t435 = fma(t10, coadjoint_slots[230], t434);
    const double t436 = fma(t8, coadjoint_slots[233], t435);
    const double t437 = fma(t6, coadjoint_slots[236], t436);
    const double t439 = mu[2] * coadjoint_slots[235];
    const double t442 = mu[3] * coadjoint_slots[229];
    const double t443 = fma(mu[1], coadjoint_slots[231], t442);
    const double t444 = fma(mu[0], t439, t443);
    const double t447 = mu[2] * coadjoint_slots[232];
    const double t449 = mu[4] * coadjoint_slots[228];
    const double t450 = fma(mu[1], t447, t449);
    const double t451 = fma(mu[0], coadjoint_slots[234], t450);
    const double t452 = mu[4] * t451;
    const double t453 = fma(mu[3], t444, t452);
    const double t454 = fma(mu[5], t437, t453);
    const double t459 = fma(mu[5], coadjoint_slots[219], coadjoint_slots[218]);
    const double t460 = fma(t10, coadjoint_slots[221], t459);
    const double t461 = fma(t8, coadjoint_slots[225], t460);
    const double t463 = mu[5] * coadjoint_slots[223];
    const double t465 = t69 * coadjoint_slots[220];
    const double t466 = fma(mu[1], t463, t465);
    const double t467 = fma(mu[3], t461, t466);
    const double t470 = mu[3] * coadjoint_slots[222];
    const double t471 = fma(mu[1], coadjoint_slots[224], t470);
    const double t474 = fma(mu[5], coadjoint_slots[217], coadjoint_slots[216]);
    const double t475 = fma(mu[1], t471, t474);
    const double t476 = mu[4] * t475;
    const double t477 = fma(mu[2], t467, t476);
    const double t478 = fma(mu[0], t454, t477);
    const double t483 = fma(mu[5], coadjoint_slots[209], coadjoint_slots[208]);
    const double t484 = fma(t10, coadjoint_slots[212], t483);
    const double t485 = fma(t8, coadjoint_slots[215], t484);
    const double t487 = mu[4] * coadjoint_slots[214];
    const double t489 = mu[3] * coadjoint_slots[213];
    const double t490 = fma(mu[2], t487, t489);
    const double t493 = t122 * coadjoint_slots[210];
    const double t494 = fma(t46, coadjoint_slots[211], t493);
    const double t495 = fma(mu[1], t490, t494);
    const double t496 = fma(mu[5], t485, t495);
    const double t500 = fma(mu[5], coadjoint_slots[205], coadjoint_slots[204]);
    const double t501 = fma(t10, coadjoint_slots[207], t500);
    const double t503 = t145 * coadjoint_slots[206];
    const double t504 = fma(mu[4], t501, t503);
    const double t507 = fma(mu[5], coadjoint_slots[203], coadjoint_slots[202]);
    const double t508 = mu[3] * t507;
    const double t509 = fma(mu[2], t504, t508);
    const double t510 = fma(mu[1], t496, t509);
    const double t514 = fma(mu[5], coadjoint_slots[198], coadjoint_slots[197]);
    const double t515 = fma(t10, coadjoint_slots[201], t514);
    const double t517 = t69 * coadjoint_slots[199];
    const double t518 = fma(mu[3], t515, t517);
    const double t522 = fma(mu[5], coadjoint_slots[196], coadjoint_slots[195]);
    const double t523 = fma(t10, coadjoint_slots[200], t522);
    const double t525 = mu[5] * coadjoint_slots[194];
    const double t526 = fma(t122, t523, t525);
    const double t527 = fma(mu[3], t518, t526);
    const double t528 = fma(mu[1], t510, t527);
    const double t529 = fma(mu[0], t478, t528);
    const double t532 = fabs(mu[0]);
    const double t533 = fabs(mu[1]);
    const double t534 = (t533 <= t532) ? t532 : t533;
    const double t535 = fabs(mu[2]);
    const double t536 = (t535 <= t534) ? t534 : t535;
    const double t537 = fabs(mu[3]);
    const double t538 = (t537 <= t536) ? t536 : t537;
    const double t539 = fabs(mu[4]);
    const double t540 = (t539 <= t538) ? t538 : t539;
    const double t541 = fabs(mu[5]);
    const double t542 = (t541 <= t540) ? t540 : t541;
    const double t543 = 0x1p-126 + t542;
    const double t545 = 1.0 / t543;
    p[0] = t84;
    p[1] = t160;
    p[2] = t228;
    p[3] = t328;
    p[4] = t428;
    p[5] = t529;
    k[0] = t545;
    k[1] = 0.0;
}

INLINE void coadjoint_correct(const double *RESTRICT p, const double *RESTRICT mu, const double *RESTRICT k, double *RESTRICT p_next, double *RESTRICT x, double *RESTRICT left, double *RESTRICT moved)
{
    const double t14 = p[1] * p[1];
    const double t16 = p[2] * p[2];
    const double t19 = fma(t16, coadjoint_slots[1], coadjoint_slots[0]);
    const double t20 = fma(t14, coadjoint_slots[2], t19);
    const double t21 = p[2] * p[3];
    const double t23 = t21 * coadjoint_slots[3];
    const double t25 = fma(p[0], t20, t23);
    const double t26 = p[0] * p[0];
    const double t29 = fma(t16, coadjoint_slots[5], coadjoint_slots[4]);
    const double t30 = fma(coadjoint_slots[2], t26, t29);
    const double t31 = p[2] * p[4];
    const double t33 = t31 * coadjoint_slots[6];
    const double t34 = fma(p[1], t30, t33);
    const double t36 = fma(t14, coadjoint_slots[5], coadjoint_slots[7]);
    const double t37 = fma(coadjoint_slots[1], t26, t36);
    const double t38 = p[3] * coadjoint_slots[3];
    const double t39 = p[1] * p[4];
    const double t40 = coadjoint_slots[6] * t39;
    const double t41 = fma(p[0], t38, t40);
    const double t42 = fma(p[2], t37, t41);
    const double t44 = p[0] * p[2];
    const double t45 = coadjoint_slots[3] * t44;
    const double t46 = fma(p[3], coadjoint_slots[8], t45);
    const double t48 = p[1] * p[2];
    const double t49 = coadjoint_slots[6] * t48;
    const double t50 = fma(p[4], coadjoint_slots[9], t49);
    const double t52 = p[0] * p[1];
    const double t54 = t52 * coadjoint_slots[11];
    const double t56 = p[2] * coadjoint_slots[12];
    const double t57 = fma(p[0], t56, t38);
    const double t58 = p[2] * coadjoint_slots[3];
    const double t60 = p[2] * coadjoint_slots[13];
    const double t61 = p[4] * coadjoint_slots[6];
    const double t62 = fma(p[1], t60, t61);
    const double t63 = p[2] * coadjoint_slots[6];
    const double t64 = p[0] * coadjoint_slots[3];
    const double t65 = p[1] * coadjoint_slots[6];
    const double t66 = t25 * t25;
    const double t67 = fma(t34, t34, t66);
    const double t68 = fma(t42, t42, t67);
    const double t80 = fma(t68, (-0x1.5555555555555p-5), 0x1p-1);
    const double t81 = fma(t68, (-0x1.a01a01a01a01ap-16), 0x1.6c16c16c16c17p-10);
    const double t82 = fma(t68, (-0x1.1eed8eff8d898p-29), 0x1.27e4fb7789f5cp-22);
    const double t83 = fma(t68, (-0x1.ae7f3e733b81fp-45), 0x1.93974a8c07c9dp-37);
    const double t84 = fma(t68, (-0x1.e542ba4020225p-62), 0x1.6827863b97d97p-53);
    const double t85 = t68 * t68;
    const double t86 = fma(t81, t85, t80);
    const double t87 = fma(t83, t85, t82);
    const double t88 = fma(0x1.0ce396db7f853p-70, t85, t84);
    const double t89 = t85 * t85;
    const double t90 = fma(t87, t89, t86);
    const double t91 = t89 * t89;
    const double t92 = fma(t88, t91, t90);
    const double t103 = fma(t68, (-0x1.1111111111111p-7), 0x1.5555555555555p-3);
    const double t104 = fma(t68, (-0x1.71de3a556c734p-19), 0x1.a01a01a01a01ap-13);
    const double t105 = fma(t68, (-0x1.6124613a86d09p-33), 0x1.ae64567f544e4p-26);
    const double t106 = fma(t68, (-0x1.952c77030ad4ap-49), 0x1.ae7f3e733b81fp-41);
    const double t107 = fma(t68, (-0x1.71b8ef6dcf572p-66), 0x1.2f49b46814157p-57);
    const double t108 = fma(t85, t104, t103);
    const double t109 = fma(t85, t106, t105);
    const double t110 = fma(t89, t109, t108);
    const double t111 = fma(t91, t107, t110);
    const double t121 = fma(t68, 0x1.6c16c16c16c17p-9, (-0x1.5555555555555p-5));
    const double t122 = fma(t68, 0x1.27e4fb7789f5cp-20, (-0x1.3813813813814p-14));
    const double t123 = fma(t68, 0x1.2eb177e905d76p-34, (-0x1.66a8f2bf70ebep-27));
    const double t124 = fma(t68, 0x1.6827863b97d97p-50, (-0x1.78af56a4d411bp-42));
    const double t125 = fma(t68, 0x1.501c7c925f668p-67, (-0x1.10f588c412135p-58));
    const double t126 = fma(t85, t122, t121);
    const double t127 = fma(t85, t124, t123);
    const double t128 = fma(t89, t127, t126);
    const double t129 = fma(t91, t125, t128);
    const double t139 = fma(t68, 0x1.a01a01a01a01ap-12, (-0x1.1111111111111p-7));
    const double t140 = fma(t68, 0x1.ae64567f544e4p-24, (-0x1.1566abc011567p-17));
    const double t141 = fma(t68, 0x1.42df6ed66ca17p-38, (-0x1.b96d79892884bp-31));
    const double t142 = fma(t68, 0x1.2f49b46814157p-54, (-0x1.6286e822a97a1p-46));
    const double t143 = fma(t68, 0x1.d3a2117dbc61fp-72, (-0x1.9ff00d5b8942p-63));
    const double t144 = fma(t85, t140, t139);
    const double t145 = fma(t85, t142, t141);
    const double t146 = fma(t89, t145, t144);
    const double t147 = fma(t91, t143, t146);
    const double t154 = fma(t68, (-0x1.3813813813814p-13), 0x1.6c16c16c16c17p-9);
    const double t155 = fma(t68, (-0x1.66a8f2bf70ebep-25), 0x1.bbd779334ef0ap-19);
    const double t156 = fma(t68, (-0x1.1a8380fb9f0d4p-39), 0x1.7a5dd5e3474d3p-32);
    const double t157 = fma(t85, t155, t154);
    const double t158 = fma(t85, 0x1.3b22957424de4p-47, t156);
    const double t159 = fma(t89, t158, t157);
    const double t166 = fma(t68, (-0x1.1566abc011567p-16), 0x1.a01a01a01a01ap-12);
    const double t167 = fma(t68, (-0x1.b96d79892884bp-29), 0x1.42cb40df7f3abp-22);
    const double t168 = fma(t68, (-0x1.09e52e19ff1b9p-43), 0x1.93974a8c07c9dp-36);
    const double t169 = fma(t85, t167, t166);
    const double t170 = fma(t85, 0x1.09607ddb1192cp-51, t168);
    const double t171 = fma(t89, t170, t169);
    const double t172 = mu[1] * t42;
    const double t173 = -mu[2];
    const double t174 = fma(t34, t173, t172);
    const double t175 = mu[2] * t25;
    const double t176 = -mu[0];
    const double t177 = fma(t42, t176, t175);
    const double t178 = mu[0] * t34;
    const double t179 = -mu[1];
    const double t180 = fma(t25, t179, t178);
    const double t181 = t42 * t177;
    const double t182 = -t180;
    const double t183 = fma(t34, t182, t181);
    const double t184 = t25 * t180;
    const double t185 = -t174;
    const double t186 = fma(t42, t185, t184);
    const double t187 = t34 * t174;
    const double t188 = -t177;
    const double t189 = fma(t25, t188, t187);
    const double t190 = fma(t92, t174, mu[0]);
    const double t191 = fma(t92, t177, mu[1]);
    const double t192 = fma(t92, t180, mu[2]);
    const double t193 = fma(t111, t183, t190);
    const double t194 = fma(t111, t186, t191);
    const double t195 = fma(t111, t189, t192);
    const double t197 = t129 * t174;
    const double t198 = t129 * t177;
    const double t199 = t129 * t180;
    const double t200 = fma(t147, t183, t197);
    const double t201 = fma(t147, t186, t198);
    const double t202 = fma(t147, t189, t199);
    const double t203 = 2.0 * t200;
    const double t204 = 2.0 * t201;
    const double t205 = 2.0 * t202;
    const double t206 = -t111;
    const double t207 = fma(mu[0], t206, t203);
    const double t208 = fma(mu[1], t206, t204);
    const double t209 = fma(mu[2], t206, t205);
    const double t210 = mu[0] * t92;
    const double t211 = mu[1] * t92;
    const double t212 = mu[2] * t92;
    const double t213 = fma(t111, t174, t210);
    const double t214 = fma(t111, t177, t211);
    const double t215 = fma(t111, t180, t212);
    const double t216 = mu[0] * t25;
    const double t217 = fma(mu[1], t34, t216);
    const double t218 = fma(mu[2], t42, t217);
    const double t219 = t111 * t218;
    const double t220 = -t213;
    const double t221 = -t214;
    const double t222 = -t215;
    const double t223 = fma(t25, t207, t219);
    const double t224 = fma(t34, t207, t222);
    const double t225 = fma(t42, t207, t214);
    const double t226 = fma(t25, t208, t215);
    const double t227 = fma(t34, t208, t219);
    const double t228 = fma(t42, t208, t220);
    const double t229 = fma(t25, t209, t221);
    const double t230 = fma(t34, t209, t213);
    const double t231 = fma(t42, t209, t219);
    const double t232 = mu[4] * t42;
    const double t233 = -mu[5];
    const double t234 = fma(t34, t233, t232);
    const double t235 = mu[5] * t25;
    const double t236 = -mu[3];
    const double t237 = fma(t42, t236, t235);
    const double t238 = mu[3] * t34;
    const double t239 = -mu[4];
    const double t240 = fma(t25, t239, t238);
    const double t241 = t42 * t237;
    const double t242 = -t240;
    const double t243 = fma(t34, t242, t241);
    const double t244 = t25 * t240;
    const double t245 = -t234;
    const double t246 = fma(t42, t245, t244);
    const double t247 = t34 * t234;
    const double t248 = -t237;
    const double t249 = fma(t25, t248, t247);
    const double t250 = fma(t92, t234, mu[3]);
    const double t251 = fma(t92, t237, mu[4]);
    const double t252 = fma(t92, t240, mu[5]);
    const double t253 = fma(t111, t243, t250);
    const double t254 = fma(t111, t246, t251);
    const double t255 = fma(t111, t249, t252);
    const double t256 = t129 * t234;
    const double t257 = t129 * t237;
    const double t258 = t129 * t240;
    const double t259 = fma(t147, t243, t256);
    const double t260 = fma(t147, t246, t257);
    const double t261 = fma(t147, t249, t258);
    const double t262 = 2.0 * t259;
    const double t263 = 2.0 * t260;
    const double t264 = 2.0 * t261;
    const double t265 = fma(mu[3], t206, t262);
    const double t266 = fma(mu[4], t206, t263);
    const double t267 = fma(mu[5], t206, t264);
    const double t268 = mu[3] * t92;
    const double t269 = mu[4] * t92;
    const double t270 = mu[5] * t92;
    const double t271 = fma(t111, t234, t268);
    const double t272 = fma(t111, t237, t269);
    const double t273 = fma(t111, t240, t270);
    const double t274 = mu[3] * t25;
    const double t275 = fma(mu[4], t34, t274);
    const double t276 = fma(mu[5], t42, t275);
    const double t277 = t111 * t276;
    const double t278 = -t271;
    const double t279 = -t272;
    const double t280 = -t273;
    const double t281 = fma(t25, t265, t277);
    const double t282 = fma(t34, t265, t280);
    const double t283 = fma(t42, t265, t272);
    const double t284 = fma(t25, t266, t273);
    const double t285 = fma(t34, t266, t277);
    const double t286 = fma(t42, t266, t278);
    const double t287 = fma(t25, t267, t279);
    const double t288 = fma(t34, t267, t271);
    const double t289 = fma(t42, t267, t277);
    const double t290 = t46 * t281;
    const double t291 = fma(t50, t282, t290);
    const double t292 = fma(coadjoint_slots[10], t283, t291);
    const double t293 = t46 * t284;
    const double t294 = fma(t50, t285, t293);
    const double t295 = fma(coadjoint_slots[10], t286, t294);
    const double t296 = t46 * t287;
    const double t297 = fma(t50, t288, t296);
    const double t298 = fma(coadjoint_slots[10], t289, t297);
    const double t299 = t193 + t292;
    const double t300 = t194 + t295;
    const double t301 = t195 + t298;
    const double t302 = mu[4] * coadjoint_slots[10];
    const double t303 = fma(t50, t233, t302);
    const double t304 = mu[5] * t46;
    const double t305 = fma(coadjoint_slots[10], t236, t304);
    const double t306 = mu[3] * t50;
    const double t307 = fma(t46, t239, t306);
    const double t308 = t42 * t305;
    const double t309 = -t307;
    const double t310 = fma(t34, t309, t308);
    const double t311 = t25 * t307;
    const double t312 = -t303;
    const double t313 = fma(t42, t312, t311);
    const double t314 = t34 * t303;
    const double t315 = -t305;
    const double t316 = fma(t25, t315, t314);
    const double t317 = coadjoint_slots[10] * t237;
    const double t318 = fma(t50, t242, t317);
    const double t319 = t46 * t240;
    const double t320 = fma(coadjoint_slots[10], t245, t319);
    const double t321 = t50 * t234;
    const double t322 = fma(t46, t248, t321);
    const double t323 = t310 + t318;
    const double t324 = t313 + t320;
    const double t325 = t316 + t322;
    const double t326 = t25 * t46;
    const double t327 = fma(t34, t50, t326);
    const double t328 = fma(t42, coadjoint_slots[10], t327);
    const double t329 = 2.0 * t328;
    const double t330 = t159 * t234;
    const double t331 = t159 * t237;
    const double t332 = t159 * t240;
    const double t333 = fma(t171, t243, t330);
    const double t334 = fma(t171, t246, t331);
    const double t335 = fma(t171, t249, t332);
    const double t336 = t129 * t303;
    const double t337 = t129 * t305;
    const double t338 = t129 * t307;
    const double t339 = fma(t147, t323, t336);
    const double t340 = fma(t147, t324, t337);
    const double t341 = fma(t147, t325, t338);
    const double t342 = fma(t329, t333, t339);
    const double t343 = fma(t329, t334, t340);
    const double t344 = fma(t329, t335, t341);
    const double t345 = 2.0 * t342;
    const double t346 = 2.0 * t343;
    const double t347 = 2.0 * t344;
    const double t348 = t147 * t329;
    const double t349 = -t348;
    const double t350 = fma(mu[3], t349, t345);
    const double t351 = fma(mu[4], t349, t346);
    const double t352 = fma(mu[5], t349, t347);
    const double t353 = mu[3] * t129;
    const double t354 = mu[4] * t129;
    const double t355 = mu[5] * t129;
    const double t356 = fma(t147, t234, t353);
    const double t357 = fma(t147, t237, t354);
    const double t358 = fma(t147, t240, t355);
    const double t359 = t329 * t356;
    const double t360 = t329 * t357;
    const double t361 = t329 * t358;
    const double t362 = fma(t111, t303, t359);
    const double t363 = fma(t111, t305, t360);
    const double t364 = fma(t111, t307, t361);
    const double t365 = mu[3] * t46;
    const double t366 = fma(mu[4], t50, t365);
    const double t367 = fma(mu[5], coadjoint_slots[10], t366);
    const double t368 = t111 * t367;
    const double t369 = fma(t276, t348, t368);
    const double t370 = t223 + t369;
    const double t371 = fma(t25, t350, t370);
    const double t372 = fma(t46, t265, t371);
    const double t373 = t224 - t364;
    const double t374 = fma(t34, t350, t373);
    const double t375 = fma(t50, t265, t374);
    const double t376 = t225 + t363;
    const double t377 = fma(t42, t350, t376);
    const double t378 = fma(coadjoint_slots[10], t265, t377);
    const double t379 = t226 + t364;
    const double t380 = fma(t25, t351, t379);
    const double t381 = fma(t46, t266, t380);
    const double t382 = t227 + t369;
    const double t383 = fma(t34, t351, t382);
    const double t384 = fma(t50, t266, t383);
    const double t385 = t228 - t362;
    const double t386 = fma(t42, t351, t385);
    const double t387 = fma(coadjoint_slots[10], t266, t386);
    const double t388 = t229 - t363;
    const double t389 = fma(t25, t352, t388);
    const double t390 = fma(t46, t267, t389);
    const double t391 = t230 + t362;
    const double t392 = fma(t34, t352, t391);
    const double t393 = fma(t50, t267, t392);
    const double t394 = t231 + t369;
    const double t395 = fma(t42, t352, t394);
    const double t396 = fma(coadjoint_slots[10], t267, t395);
    const double t397 = t20 * t372;
    const double t398 = fma(t54, t375, t397);
    const double t399 = fma(t57, t378, t398);
    const double t400 = fma(t58, t281, t399);
    const double t401 = t54 * t372;
    const double t402 = fma(t30, t375, t401);
    const double t403 = fma(t62, t378, t402);
    const double t404 = fma(t63, t282, t403);
    const double t405 = t57 * t372;
    const double t406 = fma(t62, t375, t405);
    const double t407 = fma(t37, t378, t406);
    const double t408 = fma(t64, t281, t407);
    const double t409 = fma(t65, t282, t408);
    const double t410 = t58 * t372;
    const double t411 = fma(t64, t378, t410);
    const double t412 = fma(coadjoint_slots[8], t281, t411);
    const double t413 = t63 * t375;
    const double t414 = fma(t65, t378, t413);
    const double t415 = fma(coadjoint_slots[9], t282, t414);
    const double t416 = t20 * t381;
    const double t417 = fma(t54, t384, t416);
    const double t418 = fma(t57, t387, t417);
    const double t419 = fma(t58, t284, t418);
    const double t420 = t54 * t381;
    const double t421 = fma(t30, t384, t420);
    const double t422 = fma(t62, t387, t421);
    const double t423 = fma(t63, t285, t422);
    const double t424 = t57 * t381;
    const double t425 = fma(t62, t384, t424);
    const double t426 = fma(t37, t387, t425);
    const double t427 = fma(t64, t284, t426);
    const double t428 = fma(t65, t285, t427);
    const double t429 = t58 * t381;
    const double t430 = fma(t64, t387, t429);
    const double t431 = fma(coadjoint_slots[8], t284, t430);
    const double t432 = t63 * t384;
    const double t433 = fma(t65, t387, t432);
    const double t434 = fma(coadjoint_slots[9], t285, t433);
    const double t435 = t20 * t390;
    const double t436 = fma(t54, t393, t435);
    const double t437 = fma(t57, t396, t436);
    const double t438 = fma(t58, t287, t437);
    const double t439 = t54 * t390;
    const double t440 = fma(t30, t393, t439);
    const double t441 = fma(t62, t396, t440);
    const double t442 = fma(t63, t288, t441);
    const double t443 = t57 * t390;
    const double t444 = fma(t62, t393, t443);
    const double t445 = fma(t37, t396, t444);
    const double t446 = fma(t64, t287, t445);
    const double t447 = fma(t65, t288, t446);
    const double t448 = t58 * t390;
    const double t449 = fma(t64, t396, t448);
    const double t450 = fma(coadjoint_slots[8], t287, t449);
    const double t451 = t63 * t393;
    const double t452 = fma(t65, t396, t451);
    const double t453 = fma(coadjoint_slots[9], t288, t452);
    const double t454 = t20 * t281;
    const double t455 = fma(t54, t282, t454);
    const double t456 = fma(t57, t283, t455);
    const double t457 = t54 * t281;
    const double t458 = fma(t30, t282, t457);
    const double t459 = fma(t62, t283, t458);
    const double t460 = t57 * t281;
    const double t461 = fma(t62, t282, t460);
    const double t462 = fma(t37, t283, t461);
    const double t463 = t58 * t281;
    const double t464 = fma(t64, t283, t463);
    const double t465 = t63 * t282;
    const double t466 = fma(t65, t283, t465);
    const double t467 = t20 * t284;
    const double t468 = fma(t54, t285, t467);
    const double t469 = fma(t57, t286, t468);
    const double t470 = t54 * t284;
    const double t471 = fma(t30, t285, t470);
    const double t472 = fma(t62, t286, t471);
    const double t473 = t57 * t284;
    const double t474 = fma(t62, t285, t473);
    const double t475 = fma(t37, t286, t474);
    const double t476 = t58 * t284;
    const double t477 = fma(t64, t286, t476);
    const double t478 = t63 * t285;
    const double t479 = fma(t65, t286, t478);
    const double t480 = t20 * t287;
    const double t481 = fma(t54, t288, t480);
    const double t482 = fma(t57, t289, t481);
    const double t483 = t54 * t287;
    const double t484 = fma(t30, t288, t483);
    const double t485 = fma(t62, t289, t484);
    const double t486 = t57 * t287;
    const double t487 = fma(t62, t288, t486);
    const double t488 = fma(t37, t289, t487);
    const double t489 = t58 * t287;
    const double t490 = fma(t64, t289, t489);
    const double t491 = t63 * t288;
    const double t492 = fma(t65, t289, t491);
    const double t494 = 1.0 - t400;
    const double t495 = -t404;
    const double t496 = -t409;
    const double t497 = -t412;
    const double t498 = -t415;
    const double t499 = -t419;
    const double t500 = 1.0 - t423;
    const double t501 = -t428;
    const double t502 = -t431;
    const double t503 = -t434;
    const double t504 = -t438;
    const double t505 = -t442;
    const double t506 = 1.0 - t447;
    const double t507 = -t450;
    const double t508 = -t453;
    const double t509 = -t456;
    const double t510 = -t459;
    const double t511 = -t462;
    const double t512 = 1.0 - t464;
    const double t513 = -t466;
    const double t514 = -t469;
    const double t515 = -t472;
    const double t516 = -t475;
    const double t517 = -t477;
    const double t518 = 1.0 - t479;
    const double t519 = -t482;
    const double t520 = -t485;
    const double t521 = -t488;
    const double t522 = -t490;
    const double t523 = -t492;
    const double t524 = p[0] - t299;
    const double t525 = p[1] - t300;
    const double t526 = p[2] - t301;
    const double t527 = p[3] - t253;
    const double t528 = p[4] - t254;
    const double t529 = p[5] - t255;
    const double t530 = 1.0 / t494;
    const double t531 = t499 * t530;
    const double t532 = -t531;
    const double t533 = fma(t495, t532, t500);
    const double t534 = fma(t496, t532, t501);
    const double t535 = fma(t497, t532, t502);
    const double t536 = fma(t498, t532, t503);
    const double t537 = t504 * t530;
    const double t538 = -t537;
    const double t539 = fma(t495, t538, t505);
    const double t540 = fma(t496, t538, t506);
    const double t541 = fma(t497, t538, t507);
    const double t542 = fma(t498, t538, t508);
    const double t543 = t509 * t530;
    const double t544 = -t543;
    const double t545 = fma(t495, t544, t510);
    const double t546 = fma(t496, t544, t511);
    const double t547 = fma(t497, t544, t512);
    const double t548 = fma(t498, t544, t513);
    const double t549 = t514 * t530;
    const double t550 = -t549;
    const double t551 = fma(t495, t550, t515);
    const double t552 = fma(t496, t550, t516);
    const double t553 = fma(t497, t550, t517);
    const double t554 = fma(t498, t550, t518);
    const double t555 = t519 * t530;
    const double t556 = -t555;
    const double t557 = fma(t495, t556, t520);
    const double t558 = fma(t496, t556, t521);
    const double t559 = fma(t497, t556, t522);
    const double t560 = fma(t498, t556, t523);
    const double t561 = 1.0 / t533;
    const double t562 = t539 * t561;
    const double t563 = -t562;
    const double t564 = fma(t534, t563, t540);
    const double t565 = fma(t535, t563, t541);
    const double t566 = fma(t536, t563, t542);
    const double t567 = t545 * t561;
    const double t568 = -t567;
    const double t569 = fma(t534, t568, t546);
    const double t570 = fma(t535, t568, t547);
    const double t571 = fma(t536, t568, t548);
    const double t572 = t551 * t561;
    const double t573 = -t572;
    const double t574 = fma(t534, t573, t552);
    const double t575 = fma(t535, t573, t553);
    const double t576 = fma(t536, t573, t554);
    const double t577 = t557 * t561;
    const double t578 = -t577;
    const double t579 = fma(t534, t578, t558);
    const double t580 = fma(t535, t578, t559);
    const double t581 = fma(t536, t578, t560);
    const double t582 = 1.0 / t564;
    const double t583 = t569 * t582;
    const double t584 = -t583;
    const double t585 = fma(t565, t584, t570);
    const double t586 = fma(t566, t584, t571);
    const double t587 = t574 * t582;
    const double t588 = -t587;
    const double t589 = fma(t565, t588, t575);
    const double t590 = fma(t566, t588, t576);
    const double t591 = t579 * t582;
    const double t592 = -t591;
    const double t593 = fma(t565, t592, t580);
    const double t594 = fma(t566, t592, t581);
    const double t595 = 1.0 / t585;
    const double t596 = t589 * t595;
    const double t597 = -t596;
    const double t598 = fma(t586, t597, t590);
    const double t599 = t593 * t595;
    const double t600 = -t599;
    const double t601 = fma(t586, t600, t594);
    const double t602 = 1.0 / t598;
    const double t603 = t601 * t602;
    const double t604 = -t603;
    const double t605 = 1.0 / 1.0;
    const double t606 = fma(t524, t532, t525);
    const double t607 = fma(t524, t538, t526);
    const double t608 = fma(t524, t544, t527);
    const double t609 = fma(t524, t550, t528);
    const double t610 = fma(t524, t556, t529);
    const double t611 = fma(t563, t606, t607);
    const double t612 = fma(t568, t606, t608);
    const double t613 = fma(t573, t606, t609);
    const double t614 = fma(t578, t606, t610);
    const double t615 = fma(t584, t611, t612);
    const double t616 = fma(t588, t611, t613);
    const double t617 = fma(t592, t611, t614);
    const double t618 = fma(t597, t615, t616);
    const double t619 = fma(t600, t615, t617);
    const double t620 = fma(t604, t618, t619);
    const double t621 = t605 * t620;
    const double t622 = t602 * t618;
    const double t623 = -t586;
    const double t624 = fma(t622, t623, t615);
    const double t625 = t595 * t624;
    const double t626 = -t565;
    const double t627 = fma(t625, t626, t611);
    const double t628 = -t566;
    const double t629 = fma(t622, t628, t627);
    const double t630 = t582 * t629;
    const double t631 = -t534;
    const double t632 = fma(t630, t631, t606);
    const double t633 = -t535;
    const double t634 = fma(t625, t633, t632);
    const double t635 = -t536;
    const double t636 = fma(t622, t635, t634);
    const double t637 = t561 * t636;
    const double t638 = fma(t404, t637, t524);
    const double t639 = fma(t409, t630, t638);
    const double t640 = fma(t412, t625, t639);
    const double t641 = fma(t415, t622, t640);
    const double t642 = t530 * t641;
    const double t643 = t20 * t642;
    const double t644 = fma(t54, t637, t643);
    const double t645 = fma(t57, t630, t644);
    const double t646 = fma(t58, t625, t645);
    const double t647 = t54 * t642;
    const double t648 = fma(t30, t637, t647);
    const double t649 = fma(t62, t630, t648);
    const double t650 = fma(t63, t622, t649);
    const double t651 = t57 * t642;
    const double t652 = fma(t62, t637, t651);
    const double t653 = fma(t37, t630, t652);
    const double t654 = fma(t64, t625, t653);
    const double t655 = fma(t65, t622, t654);
    const double t656 = t58 * t642;
    const double t657 = fma(t64, t630, t656);
    const double t658 = fma(coadjoint_slots[8], t625, t657);
    const double t659 = t63 * t637;
    const double t660 = fma(t65, t630, t659);
    const double t661 = fma(coadjoint_slots[9], t622, t660);
    const double t662 = p[0] - t642;
    const double t663 = p[1] - t637;
    const double t664 = p[2] - t630;
    const double t665 = p[3] - t625;
    const double t666 = p[4] - t622;
    const double t667 = p[5] - t621;
    const double t668 = t25 - t646;
    const double t669 = t34 - t650;
    const double t670 = t42 - t655;
    const double t671 = t46 - t658;
    const double t672 = t50 - t661;
    const double t673 = fabs(t642);
    const double t674 = fabs(t637);
    const double t675 = (t674 <= t673) ? t673 : t674;
    const double t676 = fabs(t630);
    const double t677 = (t676 <= t675) ? t675 : t676;
    const double t678 = fabs(t625);
    const double t679 = (t678 <= t677) ? t677 : t678;
    const double t680 = fabs(t622);
    const double t681 = (t680 <= t679) ? t679 : t680;
    const double t682 = fabs(t621);
    const double t683 = (t682 <= t681) ? t681 : t682;
    const double t684 = k[0] * t683;
    const double t685 = fabs(t646);
    const double t686 = fabs(t650);
    const double t687 = (t686 <= t685) ? t685 : t686;
    const double t688 = fabs(t655);
    const double t689 = (t688 <= t687) ? t687 : t688;
    const double t690 = fabs(t658);
    const double t691 = (t690 <= t689) ? t689 : t690;
    const double t692 = fabs(t661);
    const double t693 = (t692 <= t691) ? t691 : t692;
    const double t694 = (0.0 <= t693) ? t693 : 0.0;
    const double t695 = fabs(t25);
    const double t696 = fabs(t34);
    const double t697 = (t696 <= t695) ? t695 : t696;
    const double t698 = fabs(t42);
    const double t699 = (t698 <= t697) ? t697 : t698;
    const double t700 = fabs(t46);
    const double t701 = (t700 <= t699) ? t699 : t700;
    const double t702 = fabs(t50);
    const double t703 = (t702 <= t701) ? t701 : t702;
    const double t704 = fabs(coadjoint_slots[10]);
    const double t705 = (t704 <= t703) ? t703 : t704;
    const double t706 = t705 * t705;
    const double t708 = t706 * 0x1p-2;
    const double t709 = t684 * t708;
    const double t710 = fma(0x1p-1, t694, t709);
    const double t711 = k[1] * t684;
    const double t712 = fma(t694, t710, t711);
    const double t716 = 0x1p-52 * 4.0;
    const double t717 = (t684 <= 0x1.0624dd2f1a9fcp-10) ? t712 : t684;
    const double t718 = (t717 <= t684) ? t717 : t684;
    const double t719 = (t684 <= t716) ? t718 : t717;
    p_next[0] = t662;
    p_next[1] = t663;
    p_next[2] = t664;
    p_next[3] = t665;
    p_next[4] = t666;
    p_next[5] = t667;
    x[0] = t668;
    x[1] = t669;
    x[2] = t670;
    x[3] = t671;
    x[4] = t672;
    x[5] = coadjoint_slots[10];
    *left = t719;
    *moved = t684;
}

INLINE void coadjoint_accept(const double *RESTRICT mu, const double *RESTRICT x, double left, double way, double *RESTRICT right)
{
    const double t16 = 0x1p-52 * 4.0;
    const double t19 = x[0] * x[0];
    const double t20 = fma(x[1], x[1], t19);
    const double t21 = fma(x[2], x[2], t20);
    const double t23 = t21 * 0x1.9f02f6222c72p-4;
    const double t24 = x[3] - x[3];
    const double t25 = x[4] - x[4];
    const double t26 = t24 + t25;
    const double t27 = x[5] - x[5];
    const double t28 = t26 + t27;
    const double t29 = t23 + t28;
    const double t30 = fabs(t29);
    const double t33 = (t29 <= 0x1.fffffffffffffp+1023) ? 0.0 : 1.0;
    const double t34 = t33 + t33;
    const double t35 = t30 + t34;
    const double t36 = mu[0] * mu[0];
    const double t37 = fma(mu[1], mu[1], t36);
    const double t38 = fma(mu[2], mu[2], t37);
    const double t39 = fma(mu[3], mu[3], t38);
    const double t40 = fma(mu[4], mu[4], t39);
    const double t41 = fma(mu[5], mu[5], t40);
    const double t44 = t35 * 9.0;
    const double t45 = (t41 <= coadjoint_slots[237]) ? 1.0 : 0.0;
    const double t46 = (t44 <= 1.0) ? t45 : 0.0;
    const double t47 = (way <= 0x1.999999999999ap-5) ? t46 : 0.0;
    const double t48 = (left <= t16) ? t47 : 0.0;
    *right = t48;
}

INLINE void coadjoint_transport(const double *RESTRICT g, const double *RESTRICT mu, const double *RESTRICT x, double *RESTRICT g_next, double *RESTRICT mu_next)
{
    const double t19 = x[0] * x[0];
    const double t20 = fma(x[1], x[1], t19);
    const double t21 = fma(x[2], x[2], t20);
    const double t31 = fma(t21, (-0x1p-3), 1.0);
    const double t32 = fma(t21, (-0x1.6c16c16c16c17p-16), 0x1.5555555555555p-9);
    const double t33 = fma(t21, (-0x1.27e4fb7789f5cp-32), 0x1.a01a01a01a01ap-24);
    const double t34 = fma(t21, (-0x1.93974a8c07c9dp-51), 0x1.1eed8eff8d898p-41);
    const double t35 = t21 * t21;
    const double t36 = fma(t32, t35, t31);
    const double t37 = fma(t34, t35, t33);
    const double t38 = t35 * t35;
    const double t39 = fma(t37, t38, t36);
    const double t40 = t38 * t38;
    const double t41 = fma(0x1.ae7f3e733b81fp-61, t40, t39);
    const double t51 = fma(t21, (-0x1.5555555555555p-6), 0x1p-1);
    const double t52 = fma(t21, (-0x1.a01a01a01a01ap-20), 0x1.1111111111111p-12);
    const double t53 = fma(t21, (-0x1.ae64567f544e4p-37), 0x1.71de3a556c734p-28);
    const double t54 = fma(t21, (-0x1.ae7f3e733b81fp-56), 0x1.6124613a86d09p-46);
    const double t55 = fma(t35, t52, t51);
    const double t56 = fma(t35, t54, t53);
    const double t57 = fma(t38, t56, t55);
    const double t58 = fma(t40, 0x1.952c77030ad4ap-66, t57);
    const double t59 = x[0] * t58;
    const double t60 = x[1] * t58;
    const double t61 = x[2] * t58;
    const double t72 = fma(t21, (-0x1.5555555555555p-5), 0x1p-1);
    const double t73 = fma(t21, (-0x1.a01a01a01a01ap-16), 0x1.6c16c16c16c17p-10);
    const double t74 = fma(t21, (-0x1.1eed8eff8d898p-29), 0x1.27e4fb7789f5cp-22);
    const double t75 = fma(t21, (-0x1.ae7f3e733b81fp-45), 0x1.93974a8c07c9dp-37);
    const double t76 = fma(t21, (-0x1.e542ba4020225p-62), 0x1.6827863b97d97p-53);
    const double t77 = fma(t35, t73, t72);
    const double t78 = fma(t35, t75, t74);
    const double t79 = fma(t35, 0x1.0ce396db7f853p-70, t76);
    const double t80 = fma(t38, t78, t77);
    const double t81 = fma(t40, t79, t80);
    const double t92 = fma(t21, (-0x1.1111111111111p-7), 0x1.5555555555555p-3);
    const double t93 = fma(t21, (-0x1.71de3a556c734p-19), 0x1.a01a01a01a01ap-13);
    const double t94 = fma(t21, (-0x1.6124613a86d09p-33), 0x1.ae64567f544e4p-26);
    const double t95 = fma(t21, (-0x1.952c77030ad4ap-49), 0x1.ae7f3e733b81fp-41);
    const double t96 = fma(t21, (-0x1.71b8ef6dcf572p-66), 0x1.2f49b46814157p-57);
    const double t97 = fma(t35, t93, t92);
    const double t98 = fma(t35, t95, t94);
    const double t99 = fma(t38, t98, t97);
    const double t100 = fma(t40, t96, t99);
    const double t101 = x[1] * x[5];
    const double t102 = -x[2];
    const double t103 = fma(x[4], t102, t101);
    const double t104 = x[2] * x[3];
    const double t105 = -x[0];
    const double t106 = fma(x[5], t105, t104);
    const double t107 = x[0] * x[4];
    const double t108 = -x[1];
    const double t109 = fma(x[3], t108, t107);
    const double t110 = x[1] * t109;
    const double t111 = fma(t102, t106, t110);
    const double t112 = x[2] * t103;
    const double t113 = fma(t105, t109, t112);
    const double t114 = x[0] * t106;
    const double t115 = fma(t103, t108, t114);
    const double t116 = fma(t81, t103, x[3]);
    const double t117 = fma(t81, t106, x[4]);
    const double t118 = fma(t81, t109, x[5]);
    const double t119 = fma(t100, t111, t116);
    const double t120 = fma(t100, t113, t117);
    const double t121 = fma(t100, t115, t118);
    const double t122 = mu[5] * t120;
    const double t123 = -t121;
    const double t124 = fma(mu[4], t123, t122);
    const double t125 = mu[3] * t121;
    const double t126 = -t119;
    const double t127 = fma(mu[5], t126, t125);
    const double t128 = mu[4] * t119;
    const double t129 = -t120;
    const double t130 = fma(mu[3], t129, t128);
    const double t131 = mu[0] - t124;
    const double t132 = mu[1] - t127;
    const double t133 = mu[2] - t130;
    const double t135 = t61 * t132;
    const double t136 = -t133;
    const double t137 = fma(t60, t136, t135);
    const double t138 = t59 * t133;
    const double t139 = -t131;
    const double t140 = fma(t61, t139, t138);
    const double t141 = t60 * t131;
    const double t142 = -t132;
    const double t143 = fma(t59, t142, t141);
    const double t144 = 2.0 * t137;
    const double t145 = 2.0 * t140;
    const double t146 = 2.0 * t143;
    const double t147 = t61 * t145;
    const double t148 = -t146;
    const double t149 = fma(t60, t148, t147);
    const double t150 = t59 * t146;
    const double t151 = -t144;
    const double t152 = fma(t61, t151, t150);
    const double t153 = t60 * t144;
    const double t154 = -t145;
    const double t155 = fma(t59, t154, t153);
    const double t156 = fma(t41, t144, t131);
    const double t157 = fma(t41, t145, t132);
    const double t158 = fma(t41, t146, t133);
    const double t159 = t149 + t156;
    const double t160 = t152 + t157;
    const double t161 = t155 + t158;
    const double t162 = mu[4] * t61;
    const double t163 = -mu[5];
    const double t164 = fma(t60, t163, t162);
    const double t165 = mu[5] * t59;
    const double t166 = -mu[3];
    const double t167 = fma(t61, t166, t165);
    const double t168 = mu[3] * t60;
    const double t169 = -mu[4];
    const double t170 = fma(t59, t169, t168);
    const double t171 = 2.0 * t164;
    const double t172 = 2.0 * t167;
    const double t173 = 2.0 * t170;
    const double t174 = t61 * t172;
    const double t175 = -t173;
    const double t176 = fma(t60, t175, t174);
    const double t177 = t59 * t173;
    const double t178 = -t171;
    const double t179 = fma(t61, t178, t177);
    const double t180 = t60 * t171;
    const double t181 = -t172;
    const double t182 = fma(t59, t181, t180);
    const double t183 = fma(t41, t171, mu[3]);
    const double t184 = fma(t41, t172, mu[4]);
    const double t185 = fma(t41, t173, mu[5]);
    const double t186 = t176 + t183;
    const double t187 = t179 + t184;
    const double t188 = t182 + t185;
    const double t189 = -g[1];
    const double t190 = -g[2];
    const double t191 = -g[3];
    const double t192 = t120 * t191;
    const double t193 = fma(t123, t190, t192);
    const double t194 = t121 * t189;
    const double t195 = fma(t126, t191, t194);
    const double t196 = t119 * t190;
    const double t197 = fma(t129, t189, t196);
    const double t198 = 2.0 * t193;
    const double t199 = 2.0 * t195;
    const double t200 = 2.0 * t197;
    const double t201 = t191 * t199;
    const double t202 = -t200;
    const double t203 = fma(t190, t202, t201);
    const double t204 = t189 * t200;
    const double t205 = -t198;
    const double t206 = fma(t191, t205, t204);
    const double t207 = t190 * t198;
    const double t208 = -t199;
    const double t209 = fma(t189, t208, t207);
    const double t210 = fma(g[0], t198, t119);
    const double t211 = fma(g[0], t199, t120);
    const double t212 = fma(g[0], t200, t121);
    const double t213 = t203 + t210;
    const double t214 = t206 + t211;
    const double t215 = t209 + t212;
    const double t216 = g[4] + t213;
    const double t217 = g[5] + t214;
    const double t218 = g[6] + t215;
    const double t219 = g[1] * t59;
    const double t220 = fma(g[2], t60, t219);
    const double t221 = fma(g[3], t61, t220);
    const double t222 = -t221;
    const double t223 = fma(g[0], t41, t222);
    const double t224 = g[2] * t61;
    const double t225 = fma(t60, t191, t224);
    const double t226 = g[3] * t59;
    const double t227 = fma(t61, t189, t226);
    const double t228 = g[1] * t60;
    const double t229 = fma(t59, t190, t228);
    const double t230 = fma(g[0], t59, t225);
    const double t231 = fma(g[0], t60, t227);
    const double t232 = fma(g[0], t61, t229);
    const double t233 = fma(g[1], t41, t230);
    const double t234 = fma(g[2], t41, t231);
    const double t235 = fma(g[3], t41, t232);
    const double t236 = t223 * t223;
    const double t237 = fma(t233, t233, t236);
    const double t238 = fma(t234, t234, t237);
    const double t239 = fma(t235, t235, t238);
    const double t242 = fma(t239, (-0x1p-1), 0x1.8p+0);
    const double t243 = t223 * t242;
    const double t244 = t233 * t242;
    const double t245 = t234 * t242;
    const double t246 = t235 * t242;
    g_next[0] = t243;
    g_next[1] = t244;
    g_next[2] = t245;
    g_next[3] = t246;
    g_next[4] = t216;
    g_next[5] = t217;
    g_next[6] = t218;
    mu_next[0] = t159;
    mu_next[1] = t160;
    mu_next[2] = t161;
    mu_next[3] = t186;
    mu_next[4] = t187;
    mu_next[5] = t188;
}

INLINE void coadjoint_sound(const double *RESTRICT g, const double *RESTRICT mu, double *RESTRICT right)
{
    const double t14 = g[0] * g[0];
    const double t15 = fma(g[1], g[1], t14);
    const double t16 = fma(g[2], g[2], t15);
    const double t17 = fma(g[3], g[3], t16);
    const double t19 = t17 - 1.0;
    const double t20 = fabs(t19);
    const double t21 = g[4] - g[4];
    const double t22 = g[5] - g[5];
    const double t23 = t21 + t22;
    const double t24 = g[6] - g[6];
    const double t25 = t23 + t24;
    const double t26 = t20 + t25;
    const double t27 = mu[0] - mu[0];
    const double t28 = mu[1] - mu[1];
    const double t29 = t27 + t28;
    const double t30 = mu[2] - mu[2];
    const double t31 = t29 + t30;
    const double t32 = mu[3] - mu[3];
    const double t33 = t31 + t32;
    const double t34 = mu[4] - mu[4];
    const double t35 = t33 + t34;
    const double t36 = mu[5] - mu[5];
    const double t37 = t35 + t36;
    const double t38 = t26 + t37;
    const double t40 = sqrt(0x1p-52);
    const double t41 = (t38 <= t40) ? 1.0 : 0.0;
    *right = t41;
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
            double left = 1.0;
            double way = 0.0;
            double right = 0.0;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(left <= TOLERANCE) && way <= NEAR)) {
                double moved = 0.0;
                double p_next[DIM];
                coadjoint_correct(p, mu, k, p_next, x, &left, &moved);
                coadjoint_copy(p, p_next, DIM);
                way = way + moved;
                tried++;
            }
            coadjoint_accept(mu, x, left, way, &right);
            if (!(right == ONE)) {
                why = !(way <= NEAR) ? 2u : !(left <= TOLERANCE) ? 1u : 3u;
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
