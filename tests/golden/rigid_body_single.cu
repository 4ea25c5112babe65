/*
 * rigid_body, K = 7, h = 0.1
 *
 * coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of single precision.
 * Number i of trajectory r is at i * rows + r of g (4 numbers each) and mu (3 each). Trajectory r goes from
 * step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:
 * 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,
 * 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.
 * Let targets be multiples of 256, or one.
 *
 * A step takes 440 operations and 461 for each correction, most often one.
 */

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
#define NUMBER float
#define ONE 1.0f
#define DIM 3
#define ELEMENT 4
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 0x1p-21f
#define NEAR 0x1.99999ap-5f

static __constant__ const NUMBER coadjoint_slots[225] = {
    0x1.111112p-4f,
    0x1.8daea2p-19f,
    0x1.b25ffep-32f,
    0x1.e31d2cp-45f,
    0x1.f11a4ap-21f,
    0x1.140254p-32f,
    0x1.f98c5p-45f,
    0x1.b9297ep-34f,
    0x1.c6a7aep-45f,
    0x1.91ec5ap-47f,
    (-0x1.821c7p-34f),
    (-0x1.1e2d9ep-46f),
    0x1.0066e2p-33f,
    0x1.7252ccp-44f,
    0x1.18f118p-45f,
    0x1.b74fp-47f,
    0x1.253304p-47f,
    0x1.99999ap-5f,
    0x1.2a42fap-21f,
    0x1.665bfep-35f,
    0x1.c6f782p-49f,
    (-0x1.e8abfep-36f),
    (-0x1.abdaeep-48f),
    0x1.755074p-49f,
    0x1.b9297ep-33f,
    0x1.c6a7aep-44f,
    0x1.2d7144p-45f,
    0x1.0066e2p-34f,
    0x1.7252ccp-45f,
    0x1.86eebp-49f,
    0x1.47ae14p-5f,
    0x1.665bfep-34f,
    0x1.5539a2p-47f,
    (-0x1.e8abfep-37f),
    0x1.f1c09ap-51f,
    0x1.b25ffep-31f,
    0x1.6a55ep-43f,
    0x1.f98c5p-44f,
    (-0x1.821c7p-35f),
    0x1.24df56p-48f,
    (-0x1.821c7p-33f),
    (-0x1.1e2d9ep-45f),
    0x1.0066e2p-32f,
    0x1.7252ccp-43f,
    0x1.18f118p-44f,
    0x1.b74fp-45f,
    0x1.253304p-45f,
    0x1.f11a4ap-20f,
    0x1.140254p-31f,
    0x1.b9297ep-32f,
    0x1.c6a7aep-43f,
    0x1.2d7144p-44f,
    0x1.18f118p-43f,
    0x1.253304p-46f,
    0x1.8daea2p-18f,
    0x1.b25ffep-30f,
    0x1.6a55ep-42f,
    0x1.f98c5p-43f,
    (-0x1.1e2d9ep-44f),
    0x1.b74fp-46f,
    (-0x1.e8abfep-35f),
    (-0x1.abdaeep-47f),
    0x1.755074p-47f,
    0x1.2d7144p-43f,
    0x1.2a42fap-20f,
    0x1.665bfep-33f,
    0x1.5539a2p-46f,
    (-0x1.abdaeep-46f),
    0x1.755074p-48f,
    0x1.5539a2p-45f,
    0x1.6a55ep-41f,
    (-0x1.47ae14p-8f),
    0x1.65e9f8p-21f,
    (-0x1.15fffep-40f),
    0x1.53cc86p-52f,
    0x1.bf6476p-23f,
    0x1.0756fep-34f,
    (-0x1.6ce08ep-51f),
    0x1.3efe7ep-36f,
    0x1.2e014cp-48f,
    0x1.388782p-50f,
    1.0f,
    (-0x1.46394p-13f),
    0x1.a4ccfep-29f,
    (-0x1.c9823p-45f),
    (-0x1.65d33cp-61f),
    (-0x1.d208a6p-16f),
    (-0x1.2e3d0ap-26f),
    0x1.f44a26p-41f,
    (-0x1.acad46p-56f),
    (-0x1.23a232p-28f),
    (-0x1.7b6c5p-40f),
    0x1.40d7e8p-53f,
    (-0x1.2ae43p-42f),
    (-0x1.a31fbap-54f),
    (-0x1.2c2e6p-56f),
    0x1.2a42fap-20f,
    (-0x1.50a3fep-34f),
    0x1.3b8c92p-48f,
    0x1.4c917ep-33f,
    (-0x1.a343ep-46f),
    0x1.cc89ep-47f,
    (-0x1.a831bep-27f),
    0x1.c89132p-45f,
    (-0x1.11829p-59f),
    (-0x1.a831bep-27f),
    (-0x1.a91704p-44f),
    (-0x1.f2e4d8p-53f),
    (-0x1.974158p-40f),
    0x1.513364p-53f,
    (-0x1.0e2ccp-53f),
    0x1.51d8e2p-36f,
    0x1.029082p-46f,
    0x1.9401ccp-49f,
    (-0x1.4d28ap-39f),
    0x1.59f094p-53f,
    (-0x1.89773p-40f),
    (-0x1.0516bap-51f),
    (-0x1.03bffcp-52f),
    0x1.4334a4p-47f,
    (-0x1.5e1224p-52f),
    (-0x1.df6188p-53f),
    1.0f,
    (-0x1.a36e2ep-14f),
    0x1.1d0efep-29f,
    (-0x1.eb65e6p-46f),
    (-0x1.bc325cp-63f),
    (-0x1.dd37f6p-28f),
    0x1.4eec7cp-42f,
    (-0x1.7023bep-57f),
    (-0x1.21ca48p-41f),
    0x1.004b9p-55f,
    (-0x1.76f932p-55f),
    0x1.b4e81cp-7f,
    (-0x1.1660a4p-20f),
    0x1.a0fffep-38f,
    (-0x1.77f2ap-52f),
    0x1.2a42fap-20f,
    (-0x1.aa3afep-33f),
    0x1.71ad9ep-48f,
    0x1.a4ccfep-34f,
    (-0x1.9859ep-46f),
    0x1.363672p-47f,
    (-0x1.36b06ep-16f),
    0x1.8bea28p-27f,
    (-0x1.239b16p-40f),
    0x1.16338ap-55f,
    (-0x1.cb8b38p-29f),
    0x1.4ac4bcp-39f,
    (-0x1.a35f1cp-52f),
    (-0x1.0db404p-41f),
    0x1.3d0e28p-52f,
    (-0x1.c13b76p-55f),
    0x1.091f16p-22f,
    (-0x1.956aa8p-35f),
    (-0x1.2bbbe6p-49f),
    (-0x1.36b2e2p-34f),
    0x1.b0035p-46f,
    (-0x1.38522ap-47f),
    0x1.1acbd4p-28f,
    (-0x1.e5077p-40f),
    0x1.793ba8p-52f,
    (-0x1.d6b014p-48f),
    (-0x1.ec3c1ep-52f),
    (-0x1.54fcb6p-54f),
    0x1.29a096p-34f,
    (-0x1.a5d742p-46f),
    0x1.d1d9a4p-47f,
    0x1.5c1ce4p-42f,
    0x1.fe8bdcp-57f,
    (-0x1.4c3374p-54f),
    0x1.e554d8p-48f,
    0x1.55a74ap-55f,
    1.0f,
    0x1.5d867cp-14f,
    (-0x1.316b7ep-28f),
    (-0x1.a79e78p-46f),
    (-0x1.48854p-58f),
    0x1.dd37f6p-29f,
    (-0x1.4af3cep-41f),
    (-0x1.29ddc6p-58f),
    0x1.7240c2p-43f,
    (-0x1.09041cp-54f),
    0x1.68c83ep-57f,
    (-0x1.111112p-7f),
    0x1.2a42fap-20f,
    (-0x1.049ffep-36f),
    0x1.182744p-50f,
    (-0x1.36b06ep-21f),
    0x1.b9297ep-33f,
    (-0x1.c3277cp-48f),
    (-0x1.754a7ep-36f),
    0x1.82c5e2p-46f,
    (-0x1.3c0f3cp-50f),
    0x1.36b06ep-15f,
    (-0x1.f1b8a8p-30f),
    (-0x1.508ab2p-43f),
    (-0x1.29ac6ap-58f),
    (-0x1.2c7892p-27f),
    0x1.e0ccdcp-41f,
    (-0x1.59e24cp-53f),
    (-0x1.bbe9bp-40f),
    0x1.bfc182p-53f,
    (-0x1.a90cfap-53f),
    (-0x1.4b66dcp-21f),
    0x1.ca81c4p-36f,
    0x1.2bfc2ap-46f,
    (-0x1.69faa8p-38f),
    (-0x1.97edeep-51f),
    0x1.7b7df6p-49f,
    0x1.1acbd4p-28f,
    (-0x1.8de0d6p-40f),
    0x1.6f2a38p-56f,
    0x1.cba7f2p-43f,
    (-0x1.80de28p-51f),
    (-0x1.26a68ap-53f),
    (-0x1.056decp-34f),
    0x1.0afc0ep-45f,
    (-0x1.c075fcp-49f),
    0x1.2b1536p-41f,
    (-0x1.9c742p-53f),
    (-0x1.899092p-53f),
    (-0x1.eb9b74p-48f),
    0x1.0ffbe4p-54f,
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
    const float t3 = __fmul_rn(mu[0], mu[0]);
    const float t5 = __fmul_rn(mu[1], mu[1]);
    const float t7 = __fmul_rn(mu[2], mu[2]);
    const float t10 = __fmaf_rn(t7, coadjoint_slots[112], coadjoint_slots[111]);
    const float t11 = __fmaf_rn(t5, coadjoint_slots[113], t10);
    const float t12 = __fmaf_rn(t3, coadjoint_slots[119], t11);
    const float t16 = __fmaf_rn(t7, coadjoint_slots[100], coadjoint_slots[99]);
    const float t17 = __fmaf_rn(t5, coadjoint_slots[101], t16);
    const float t20 = __fmaf_rn(t7, coadjoint_slots[98], coadjoint_slots[97]);
    const float t22 = __fmaf_rn(t7, t20, coadjoint_slots[96]);
    const float t23 = __fmaf_rn(t5, t17, t22);
    const float t24 = __fmaf_rn(t3, t12, t23);
    const float t28 = __fmaf_rn(t7, coadjoint_slots[79], coadjoint_slots[78]);
    const float t29 = __fmaf_rn(t5, coadjoint_slots[80], t28);
    const float t32 = __fmaf_rn(t7, coadjoint_slots[77], coadjoint_slots[76]);
    const float t34 = __fmaf_rn(t7, t32, coadjoint_slots[75]);
    const float t35 = __fmaf_rn(t5, t29, t34);
    const float t38 = __fmaf_rn(t7, coadjoint_slots[74], coadjoint_slots[73]);
    const float t40 = __fmaf_rn(t7, t38, coadjoint_slots[72]);
    const float t42 = __fmaf_rn(t7, t40, coadjoint_slots[71]);
    const float t43 = __fmaf_rn(t5, t35, t42);
    const float t44 = __fmaf_rn(t3, t24, t43);
    const float t45 = __fmul_rn(mu[1], mu[2]);
    const float t46 = __fmul_rn(t44, t45);
    const float t51 = __fmaf_rn(t7, coadjoint_slots[117], coadjoint_slots[116]);
    const float t52 = __fmaf_rn(t5, coadjoint_slots[118], t51);
    const float t53 = __fmaf_rn(t3, coadjoint_slots[121], t52);
    const float t57 = __fmaf_rn(t7, coadjoint_slots[109], coadjoint_slots[108]);
    const float t58 = __fmaf_rn(t5, coadjoint_slots[110], t57);
    const float t61 = __fmaf_rn(t7, coadjoint_slots[107], coadjoint_slots[106]);
    const float t63 = __fmaf_rn(t7, t61, coadjoint_slots[105]);
    const float t64 = __fmaf_rn(t5, t58, t63);
    const float t65 = __fmaf_rn(t3, t53, t64);
    const float t69 = __fmaf_rn(t7, coadjoint_slots[94], coadjoint_slots[93]);
    const float t70 = __fmaf_rn(t5, coadjoint_slots[95], t69);
    const float t73 = __fmaf_rn(t7, coadjoint_slots[92], coadjoint_slots[91]);
    const float t75 = __fmaf_rn(t7, t73, coadjoint_slots[90]);
    const float t76 = __fmaf_rn(t5, t70, t75);
    const float t79 = __fmaf_rn(t7, coadjoint_slots[89], coadjoint_slots[88]);
    const float t81 = __fmaf_rn(t7, t79, coadjoint_slots[87]);
    const float t83 = __fmaf_rn(t7, t81, coadjoint_slots[86]);
    const float t84 = __fmaf_rn(t5, t76, t83);
    const float t85 = __fmaf_rn(t3, t65, t84);
    const float t89 = __fmaf_rn(t7, coadjoint_slots[115], coadjoint_slots[114]);
    const float t90 = __fmaf_rn(t3, coadjoint_slots[120], t89);
    const float t93 = __fmaf_rn(t7, coadjoint_slots[104], coadjoint_slots[103]);
    const float t95 = __fmaf_rn(t7, t93, coadjoint_slots[102]);
    const float t96 = __fmaf_rn(t3, t90, t95);
    const float t99 = __fmaf_rn(t7, coadjoint_slots[85], coadjoint_slots[84]);
    const float t101 = __fmaf_rn(t7, t99, coadjoint_slots[83]);
    const float t103 = __fmaf_rn(t7, t101, coadjoint_slots[82]);
    const float t104 = __fmaf_rn(t3, t96, t103);
    const float t106 = __fmaf_rn(t7, t104, coadjoint_slots[81]);
    const float t107 = __fmaf_rn(t5, t85, t106);
    const float t108 = __fmaf_rn(mu[0], t107, t46);
    const float t113 = __fmaf_rn(t7, coadjoint_slots[169], coadjoint_slots[168]);
    const float t114 = __fmaf_rn(t5, coadjoint_slots[170], t113);
    const float t115 = __fmaf_rn(t3, coadjoint_slots[172], t114);
    const float t119 = __fmaf_rn(t7, coadjoint_slots[163], coadjoint_slots[162]);
    const float t120 = __fmaf_rn(t5, coadjoint_slots[164], t119);
    const float t123 = __fmaf_rn(t7, coadjoint_slots[161], coadjoint_slots[160]);
    const float t125 = __fmaf_rn(t7, t123, coadjoint_slots[159]);
    const float t126 = __fmaf_rn(t5, t120, t125);
    const float t127 = __fmaf_rn(t3, t115, t126);
    const float t131 = __fmaf_rn(t7, coadjoint_slots[151], coadjoint_slots[150]);
    const float t132 = __fmaf_rn(t5, coadjoint_slots[152], t131);
    const float t135 = __fmaf_rn(t7, coadjoint_slots[149], coadjoint_slots[148]);
    const float t137 = __fmaf_rn(t7, t135, coadjoint_slots[147]);
    const float t138 = __fmaf_rn(t5, t132, t137);
    const float t141 = __fmaf_rn(t7, coadjoint_slots[146], coadjoint_slots[145]);
    const float t143 = __fmaf_rn(t7, t141, coadjoint_slots[144]);
    const float t145 = __fmaf_rn(t7, t143, coadjoint_slots[143]);
    const float t146 = __fmaf_rn(t5, t138, t145);
    const float t147 = __fmaf_rn(t3, t127, t146);
    const float t151 = __fmaf_rn(t7, coadjoint_slots[131], coadjoint_slots[130]);
    const float t152 = __fmaf_rn(t5, coadjoint_slots[132], t151);
    const float t155 = __fmaf_rn(t7, coadjoint_slots[129], coadjoint_slots[128]);
    const float t157 = __fmaf_rn(t7, t155, coadjoint_slots[127]);
    const float t158 = __fmaf_rn(t5, t152, t157);
    const float t161 = __fmaf_rn(t7, coadjoint_slots[126], coadjoint_slots[125]);
    const float t163 = __fmaf_rn(t7, t161, coadjoint_slots[124]);
    const float t165 = __fmaf_rn(t7, t163, coadjoint_slots[123]);
    const float t166 = __fmaf_rn(t5, t158, t165);
    const float t168 = __fmaf_rn(t7, t166, coadjoint_slots[122]);
    const float t169 = __fmaf_rn(t3, t147, t168);
    const float t170 = __fmul_rn(mu[1], t169);
    const float t175 = __fmaf_rn(t7, coadjoint_slots[166], coadjoint_slots[165]);
    const float t176 = __fmaf_rn(t5, coadjoint_slots[167], t175);
    const float t177 = __fmaf_rn(t3, coadjoint_slots[171], t176);
    const float t181 = __fmaf_rn(t7, coadjoint_slots[157], coadjoint_slots[156]);
    const float t182 = __fmaf_rn(t5, coadjoint_slots[158], t181);
    const float t185 = __fmaf_rn(t7, coadjoint_slots[155], coadjoint_slots[154]);
    const float t187 = __fmaf_rn(t7, t185, coadjoint_slots[153]);
    const float t188 = __fmaf_rn(t5, t182, t187);
    const float t189 = __fmaf_rn(t3, t177, t188);
    const float t193 = __fmaf_rn(t7, coadjoint_slots[141], coadjoint_slots[140]);
    const float t194 = __fmaf_rn(t5, coadjoint_slots[142], t193);
    const float t197 = __fmaf_rn(t7, coadjoint_slots[139], coadjoint_slots[138]);
    const float t199 = __fmaf_rn(t7, t197, coadjoint_slots[137]);
    const float t200 = __fmaf_rn(t5, t194, t199);
    const float t203 = __fmaf_rn(t7, coadjoint_slots[136], coadjoint_slots[135]);
    const float t205 = __fmaf_rn(t7, t203, coadjoint_slots[134]);
    const float t207 = __fmaf_rn(t7, t205, coadjoint_slots[133]);
    const float t208 = __fmaf_rn(t5, t200, t207);
    const float t209 = __fmaf_rn(t3, t189, t208);
    const float t210 = __fmul_rn(mu[0], mu[2]);
    const float t211 = __fmaf_rn(t209, t210, t170);
    const float t216 = __fmaf_rn(t7, coadjoint_slots[220], coadjoint_slots[219]);
    const float t217 = __fmaf_rn(t5, coadjoint_slots[221], t216);
    const float t218 = __fmaf_rn(t3, coadjoint_slots[223], t217);
    const float t222 = __fmaf_rn(t7, coadjoint_slots[214], coadjoint_slots[213]);
    const float t223 = __fmaf_rn(t5, coadjoint_slots[215], t222);
    const float t226 = __fmaf_rn(t7, coadjoint_slots[212], coadjoint_slots[211]);
    const float t228 = __fmaf_rn(t7, t226, coadjoint_slots[210]);
    const float t229 = __fmaf_rn(t5, t223, t228);
    const float t230 = __fmaf_rn(t3, t218, t229);
    const float t234 = __fmaf_rn(t7, coadjoint_slots[202], coadjoint_slots[201]);
    const float t235 = __fmaf_rn(t5, coadjoint_slots[203], t234);
    const float t238 = __fmaf_rn(t7, coadjoint_slots[200], coadjoint_slots[199]);
    const float t240 = __fmaf_rn(t7, t238, coadjoint_slots[198]);
    const float t241 = __fmaf_rn(t5, t235, t240);
    const float t244 = __fmaf_rn(t7, coadjoint_slots[197], coadjoint_slots[196]);
    const float t246 = __fmaf_rn(t7, t244, coadjoint_slots[195]);
    const float t248 = __fmaf_rn(t7, t246, coadjoint_slots[194]);
    const float t249 = __fmaf_rn(t5, t241, t248);
    const float t250 = __fmaf_rn(t3, t230, t249);
    const float t254 = __fmaf_rn(t7, coadjoint_slots[182], coadjoint_slots[181]);
    const float t255 = __fmaf_rn(t5, coadjoint_slots[183], t254);
    const float t258 = __fmaf_rn(t7, coadjoint_slots[180], coadjoint_slots[179]);
    const float t260 = __fmaf_rn(t7, t258, coadjoint_slots[178]);
    const float t261 = __fmaf_rn(t5, t255, t260);
    const float t264 = __fmaf_rn(t7, coadjoint_slots[177], coadjoint_slots[176]);
    const float t266 = __fmaf_rn(t7, t264, coadjoint_slots[175]);
    const float t268 = __fmaf_rn(t7, t266, coadjoint_slots[174]);
    const float t269 = __fmaf_rn(t5, t261, t268);
    const float t271 = __fmaf_rn(t5, t269, coadjoint_slots[173]);
    const float t272 = __fmaf_rn(t3, t250, t271);
    const float t273 = __fmul_rn(mu[2], t272);
    const float t278 = __fmaf_rn(t7, coadjoint_slots[217], coadjoint_slots[216]);
    const float t279 = __fmaf_rn(t5, coadjoint_slots[218], t278);
    const float t280 = __fmaf_rn(t3, coadjoint_slots[222], t279);
    const float t284 = __fmaf_rn(t7, coadjoint_slots[208], coadjoint_slots[207]);
    const float t285 = __fmaf_rn(t5, coadjoint_slots[209], t284);
    const float t288 = __fmaf_rn(t7, coadjoint_slots[206], coadjoint_slots[205]);
    const float t290 = __fmaf_rn(t7, t288, coadjoint_slots[204]);
    const float t291 = __fmaf_rn(t5, t285, t290);
    const float t292 = __fmaf_rn(t3, t280, t291);
    const float t296 = __fmaf_rn(t7, coadjoint_slots[192], coadjoint_slots[191]);
    const float t297 = __fmaf_rn(t5, coadjoint_slots[193], t296);
    const float t300 = __fmaf_rn(t7, coadjoint_slots[190], coadjoint_slots[189]);
    const float t302 = __fmaf_rn(t7, t300, coadjoint_slots[188]);
    const float t303 = __fmaf_rn(t5, t297, t302);
    const float t306 = __fmaf_rn(t7, coadjoint_slots[187], coadjoint_slots[186]);
    const float t308 = __fmaf_rn(t7, t306, coadjoint_slots[185]);
    const float t310 = __fmaf_rn(t7, t308, coadjoint_slots[184]);
    const float t311 = __fmaf_rn(t5, t303, t310);
    const float t312 = __fmaf_rn(t3, t292, t311);
    const float t313 = __fmul_rn(mu[0], mu[1]);
    const float t314 = __fmaf_rn(t312, t313, t273);
    const float t317 = fabsf(mu[0]);
    const float t318 = fabsf(mu[1]);
    const float t319 = (t318 <= t317) ? t317 : t318;
    const float t320 = fabsf(mu[2]);
    const float t321 = (t320 <= t319) ? t319 : t320;
    const float t322 = __fadd_rn(0x1p-126f, t321);
    const float t324 = __fdiv_rn(1.0f, t322);
    p[0] = t108;
    p[1] = t211;
    p[2] = t314;
    k[0] = t324;
    k[1] = 0.0f;
}

INLINE void coadjoint_correct(const float *RESTRICT p, const float *RESTRICT mu, const float *RESTRICT k, float *RESTRICT p_next, float *RESTRICT x, float *RESTRICT left, float *RESTRICT moved)
{
    const float t8 = __fmul_rn(p[1], p[1]);
    const float t9 = __fmul_rn(p[0], p[0]);
    const float t12 = __fmul_rn(p[2], p[2]);
    const float t15 = __fmaf_rn(t12, coadjoint_slots[13], coadjoint_slots[12]);
    const float t16 = __fmaf_rn(t8, coadjoint_slots[14], t15);
    const float t17 = __fmaf_rn(t9, coadjoint_slots[16], t16);
    const float t21 = __fmaf_rn(t12, coadjoint_slots[8], coadjoint_slots[7]);
    const float t22 = __fmaf_rn(t8, coadjoint_slots[9], t21);
    const float t25 = __fmaf_rn(t12, coadjoint_slots[6], coadjoint_slots[5]);
    const float t27 = __fmaf_rn(t12, t25, coadjoint_slots[4]);
    const float t28 = __fmaf_rn(t8, t22, t27);
    const float t29 = __fmaf_rn(t9, t17, t28);
    const float t33 = __fmaf_rn(t12, coadjoint_slots[11], coadjoint_slots[10]);
    const float t34 = __fmaf_rn(t9, coadjoint_slots[15], t33);
    const float t37 = __fmaf_rn(t12, coadjoint_slots[3], coadjoint_slots[2]);
    const float t39 = __fmaf_rn(t12, t37, coadjoint_slots[1]);
    const float t40 = __fmaf_rn(t9, t34, t39);
    const float t42 = __fmaf_rn(t12, t40, coadjoint_slots[0]);
    const float t43 = __fmaf_rn(t8, t29, t42);
    const float t44 = __fmul_rn(p[0], t43);
    const float t48 = __fmaf_rn(t12, coadjoint_slots[28], coadjoint_slots[27]);
    const float t49 = __fmaf_rn(t8, coadjoint_slots[14], t48);
    const float t50 = __fmaf_rn(t9, coadjoint_slots[29], t49);
    const float t54 = __fmaf_rn(t12, coadjoint_slots[25], coadjoint_slots[24]);
    const float t55 = __fmaf_rn(t8, coadjoint_slots[26], t54);
    const float t56 = __fmaf_rn(t8, t55, t27);
    const float t57 = __fmaf_rn(t9, t50, t56);
    const float t61 = __fmaf_rn(t12, coadjoint_slots[22], coadjoint_slots[21]);
    const float t62 = __fmaf_rn(t8, coadjoint_slots[23], t61);
    const float t65 = __fmaf_rn(t12, coadjoint_slots[20], coadjoint_slots[19]);
    const float t67 = __fmaf_rn(t12, t65, coadjoint_slots[18]);
    const float t68 = __fmaf_rn(t8, t62, t67);
    const float t70 = __fmaf_rn(t12, t68, coadjoint_slots[17]);
    const float t71 = __fmaf_rn(t9, t57, t70);
    const float t72 = __fmul_rn(p[1], t71);
    const float t75 = __fmaf_rn(t12, coadjoint_slots[11], coadjoint_slots[38]);
    const float t76 = __fmaf_rn(t8, coadjoint_slots[28], t75);
    const float t77 = __fmaf_rn(t9, coadjoint_slots[39], t76);
    const float t79 = __fmaf_rn(t12, coadjoint_slots[37], coadjoint_slots[5]);
    const float t80 = __fmaf_rn(t8, coadjoint_slots[8], t79);
    const float t83 = __fmaf_rn(t12, coadjoint_slots[36], coadjoint_slots[35]);
    const float t84 = __fmaf_rn(t12, t83, coadjoint_slots[1]);
    const float t85 = __fmaf_rn(t8, t80, t84);
    const float t86 = __fmaf_rn(t9, t77, t85);
    const float t89 = __fmaf_rn(t12, coadjoint_slots[22], coadjoint_slots[33]);
    const float t90 = __fmaf_rn(t8, coadjoint_slots[34], t89);
    const float t93 = __fmaf_rn(t12, coadjoint_slots[32], coadjoint_slots[31]);
    const float t94 = __fmaf_rn(t12, t93, coadjoint_slots[18]);
    const float t95 = __fmaf_rn(t8, t90, t94);
    const float t97 = __fmaf_rn(t8, t95, coadjoint_slots[30]);
    const float t98 = __fmaf_rn(t9, t86, t97);
    const float t99 = __fmul_rn(p[2], t98);
    const float t104 = __fmaf_rn(t12, coadjoint_slots[43], coadjoint_slots[42]);
    const float t105 = __fmaf_rn(t8, coadjoint_slots[44], t104);
    const float t106 = __fmaf_rn(t9, coadjoint_slots[46], t105);
    const float t110 = __fmaf_rn(t12, coadjoint_slots[41], coadjoint_slots[40]);
    const float t111 = __fmaf_rn(t9, coadjoint_slots[45], t110);
    const float t112 = __fmul_rn(t12, t111);
    const float t113 = __fmaf_rn(t8, t106, t112);
    const float t114 = __fmul_rn(t9, t113);
    const float t115 = __fadd_rn(t43, t114);
    const float t116 = __fmul_rn(p[0], p[1]);
    const float t119 = __fmaf_rn(t8, coadjoint_slots[52], t104);
    const float t120 = __fmaf_rn(t9, coadjoint_slots[53], t119);
    const float t124 = __fmaf_rn(t12, coadjoint_slots[50], coadjoint_slots[49]);
    const float t125 = __fmaf_rn(t8, coadjoint_slots[51], t124);
    const float t127 = __fmaf_rn(t12, coadjoint_slots[37], coadjoint_slots[48]);
    const float t129 = __fmaf_rn(t12, t127, coadjoint_slots[47]);
    const float t130 = __fmaf_rn(t8, t125, t129);
    const float t131 = __fmaf_rn(t9, t120, t130);
    const float t132 = __fmul_rn(t116, t131);
    const float t133 = __fmul_rn(p[0], p[2]);
    const float t136 = __fmaf_rn(t12, coadjoint_slots[58], coadjoint_slots[40]);
    const float t137 = __fmaf_rn(t8, coadjoint_slots[43], t136);
    const float t138 = __fmaf_rn(t9, coadjoint_slots[59], t137);
    const float t140 = __fmaf_rn(t12, coadjoint_slots[57], coadjoint_slots[48]);
    const float t141 = __fmaf_rn(t8, coadjoint_slots[25], t140);
    const float t144 = __fmaf_rn(t12, coadjoint_slots[56], coadjoint_slots[55]);
    const float t146 = __fmaf_rn(t12, t144, coadjoint_slots[54]);
    const float t147 = __fmaf_rn(t8, t141, t146);
    const float t148 = __fmaf_rn(t9, t138, t147);
    const float t149 = __fmul_rn(t133, t148);
    const float t151 = __fmaf_rn(t8, coadjoint_slots[63], t124);
    const float t152 = __fmaf_rn(t9, coadjoint_slots[44], t151);
    const float t156 = __fmaf_rn(t12, coadjoint_slots[61], coadjoint_slots[60]);
    const float t157 = __fmaf_rn(t8, coadjoint_slots[62], t156);
    const float t158 = __fmul_rn(t12, t157);
    const float t159 = __fmaf_rn(t9, t152, t158);
    const float t160 = __fmul_rn(t8, t159);
    const float t161 = __fadd_rn(t71, t160);
    const float t162 = __fmul_rn(p[1], p[2]);
    const float t163 = __fmaf_rn(t8, coadjoint_slots[50], t140);
    const float t164 = __fmaf_rn(t9, coadjoint_slots[13], t163);
    const float t167 = __fmaf_rn(t12, coadjoint_slots[67], coadjoint_slots[60]);
    const float t168 = __fmaf_rn(t8, coadjoint_slots[68], t167);
    const float t171 = __fmaf_rn(t12, coadjoint_slots[66], coadjoint_slots[65]);
    const float t173 = __fmaf_rn(t12, t171, coadjoint_slots[64]);
    const float t174 = __fmaf_rn(t8, t168, t173);
    const float t175 = __fmaf_rn(t9, t164, t174);
    const float t176 = __fmul_rn(t162, t175);
    const float t178 = __fmaf_rn(t12, coadjoint_slots[70], coadjoint_slots[55]);
    const float t179 = __fmaf_rn(t8, coadjoint_slots[57], t178);
    const float t180 = __fmaf_rn(t9, coadjoint_slots[41], t179);
    const float t182 = __fmaf_rn(t12, coadjoint_slots[69], coadjoint_slots[65]);
    const float t183 = __fmaf_rn(t8, coadjoint_slots[61], t182);
    const float t184 = __fmul_rn(t8, t183);
    const float t185 = __fmaf_rn(t9, t180, t184);
    const float t186 = __fmul_rn(t12, t185);
    const float t187 = __fadd_rn(t98, t186);
    const float t191 = __fmul_rn(t44, t44);
    const float t192 = __fmaf_rn(t72, t72, t191);
    const float t193 = __fmaf_rn(t99, t99, t192);
    const float t204 = __fmaf_rn(t193, (-0x1.555556p-5f), 0x1p-1f);
    const float t205 = __fmaf_rn(t193, (-0x1.a01a02p-16f), 0x1.6c16c2p-10f);
    const float t206 = __fmaf_rn(t193, (-0x1.1eed8ep-29f), 0x1.27e4fcp-22f);
    const float t207 = __fmaf_rn(t193, (-0x1.ae7f3ep-45f), 0x1.93974ap-37f);
    const float t208 = __fmaf_rn(t193, (-0x1.e542bap-62f), 0x1.682786p-53f);
    const float t209 = __fmul_rn(t193, t193);
    const float t210 = __fmaf_rn(t205, t209, t204);
    const float t211 = __fmaf_rn(t207, t209, t206);
    const float t212 = __fmaf_rn(0x1.0ce396p-70f, t209, t208);
    const float t213 = __fmul_rn(t209, t209);
    const float t214 = __fmaf_rn(t211, t213, t210);
    const float t215 = __fmul_rn(t213, t213);
    const float t216 = __fmaf_rn(t212, t215, t214);
    const float t227 = __fmaf_rn(t193, (-0x1.111112p-7f), 0x1.555556p-3f);
    const float t228 = __fmaf_rn(t193, (-0x1.71de3ap-19f), 0x1.a01a02p-13f);
    const float t229 = __fmaf_rn(t193, (-0x1.612462p-33f), 0x1.ae6456p-26f);
    const float t230 = __fmaf_rn(t193, (-0x1.952c78p-49f), 0x1.ae7f3ep-41f);
    const float t231 = __fmaf_rn(t193, (-0x1.71b8fp-66f), 0x1.2f49b4p-57f);
    const float t232 = __fmaf_rn(t209, t228, t227);
    const float t233 = __fmaf_rn(t209, t230, t229);
    const float t234 = __fmaf_rn(t213, t233, t232);
    const float t235 = __fmaf_rn(t215, t231, t234);
    const float t242 = __fmaf_rn(t193, 0x1.6c16c2p-9f, (-0x1.555556p-5f));
    const float t243 = __fmaf_rn(t193, 0x1.27e4fcp-20f, (-0x1.381382p-14f));
    const float t244 = __fmaf_rn(t193, 0x1.2eb178p-34f, (-0x1.66a8f2p-27f));
    const float t245 = __fmaf_rn(t209, t243, t242);
    const float t246 = __fmaf_rn(t209, (-0x1.78af56p-42f), t244);
    const float t247 = __fmaf_rn(t213, t246, t245);
    const float t254 = __fmaf_rn(t193, 0x1.a01a02p-12f, (-0x1.111112p-7f));
    const float t255 = __fmaf_rn(t193, 0x1.ae6456p-24f, (-0x1.1566acp-17f));
    const float t256 = __fmaf_rn(t193, 0x1.42df6ep-38f, (-0x1.b96d7ap-31f));
    const float t257 = __fmaf_rn(t209, t255, t254);
    const float t258 = __fmaf_rn(t209, (-0x1.6286e8p-46f), t256);
    const float t259 = __fmaf_rn(t213, t258, t257);
    const float t260 = __fmul_rn(mu[1], t99);
    const float t261 = -mu[2];
    const float t262 = __fmaf_rn(t72, t261, t260);
    const float t263 = __fmul_rn(mu[2], t44);
    const float t264 = -mu[0];
    const float t265 = __fmaf_rn(t99, t264, t263);
    const float t266 = __fmul_rn(mu[0], t72);
    const float t267 = -mu[1];
    const float t268 = __fmaf_rn(t44, t267, t266);
    const float t269 = __fmul_rn(t99, t265);
    const float t270 = -t268;
    const float t271 = __fmaf_rn(t72, t270, t269);
    const float t272 = __fmul_rn(t44, t268);
    const float t273 = -t262;
    const float t274 = __fmaf_rn(t99, t273, t272);
    const float t275 = __fmul_rn(t72, t262);
    const float t276 = -t265;
    const float t277 = __fmaf_rn(t44, t276, t275);
    const float t278 = __fmaf_rn(t216, t262, mu[0]);
    const float t279 = __fmaf_rn(t216, t265, mu[1]);
    const float t280 = __fmaf_rn(t216, t268, mu[2]);
    const float t281 = __fmaf_rn(t235, t271, t278);
    const float t282 = __fmaf_rn(t235, t274, t279);
    const float t283 = __fmaf_rn(t235, t277, t280);
    const float t285 = __fmul_rn(t247, t262);
    const float t286 = __fmul_rn(t247, t265);
    const float t287 = __fmul_rn(t247, t268);
    const float t288 = __fmaf_rn(t259, t271, t285);
    const float t289 = __fmaf_rn(t259, t274, t286);
    const float t290 = __fmaf_rn(t259, t277, t287);
    const float t291 = __fmul_rn(2.0f, t288);
    const float t292 = __fmul_rn(2.0f, t289);
    const float t293 = __fmul_rn(2.0f, t290);
    const float t294 = -t235;
    const float t295 = __fmaf_rn(mu[0], t294, t291);
    const float t296 = __fmaf_rn(mu[1], t294, t292);
    const float t297 = __fmaf_rn(mu[2], t294, t293);
    const float t298 = __fmul_rn(mu[0], t216);
    const float t299 = __fmul_rn(mu[1], t216);
    const float t300 = __fmul_rn(mu[2], t216);
    const float t301 = __fmaf_rn(t235, t262, t298);
    const float t302 = __fmaf_rn(t235, t265, t299);
    const float t303 = __fmaf_rn(t235, t268, t300);
    const float t304 = __fmul_rn(mu[0], t44);
    const float t305 = __fmaf_rn(mu[1], t72, t304);
    const float t306 = __fmaf_rn(mu[2], t99, t305);
    const float t307 = __fmul_rn(t235, t306);
    const float t308 = -t301;
    const float t309 = -t302;
    const float t310 = -t303;
    const float t311 = __fmaf_rn(t44, t295, t307);
    const float t312 = __fmaf_rn(t72, t295, t310);
    const float t313 = __fmaf_rn(t99, t295, t302);
    const float t314 = __fmaf_rn(t44, t296, t303);
    const float t315 = __fmaf_rn(t72, t296, t307);
    const float t316 = __fmaf_rn(t99, t296, t308);
    const float t317 = __fmaf_rn(t44, t297, t309);
    const float t318 = __fmaf_rn(t72, t297, t301);
    const float t319 = __fmaf_rn(t99, t297, t307);
    const float t320 = __fmul_rn(t115, t311);
    const float t321 = __fmaf_rn(t132, t312, t320);
    const float t322 = __fmaf_rn(t149, t313, t321);
    const float t323 = __fmul_rn(t132, t311);
    const float t324 = __fmaf_rn(t161, t312, t323);
    const float t325 = __fmaf_rn(t176, t313, t324);
    const float t326 = __fmul_rn(t149, t311);
    const float t327 = __fmaf_rn(t176, t312, t326);
    const float t328 = __fmaf_rn(t187, t313, t327);
    const float t329 = __fmul_rn(t115, t314);
    const float t330 = __fmaf_rn(t132, t315, t329);
    const float t331 = __fmaf_rn(t149, t316, t330);
    const float t332 = __fmul_rn(t132, t314);
    const float t333 = __fmaf_rn(t161, t315, t332);
    const float t334 = __fmaf_rn(t176, t316, t333);
    const float t335 = __fmul_rn(t149, t314);
    const float t336 = __fmaf_rn(t176, t315, t335);
    const float t337 = __fmaf_rn(t187, t316, t336);
    const float t338 = __fmul_rn(t115, t317);
    const float t339 = __fmaf_rn(t132, t318, t338);
    const float t340 = __fmaf_rn(t149, t319, t339);
    const float t341 = __fmul_rn(t132, t317);
    const float t342 = __fmaf_rn(t161, t318, t341);
    const float t343 = __fmaf_rn(t176, t319, t342);
    const float t344 = __fmul_rn(t149, t317);
    const float t345 = __fmaf_rn(t176, t318, t344);
    const float t346 = __fmaf_rn(t187, t319, t345);
    const float t347 = __fsub_rn(1.0f, t322);
    const float t348 = -t325;
    const float t349 = -t328;
    const float t350 = -t331;
    const float t351 = __fsub_rn(1.0f, t334);
    const float t352 = -t337;
    const float t353 = -t340;
    const float t354 = -t343;
    const float t355 = __fsub_rn(1.0f, t346);
    const float t356 = __fsub_rn(p[0], t281);
    const float t357 = __fsub_rn(p[1], t282);
    const float t358 = __fsub_rn(p[2], t283);
    const float t359 = __fdiv_rn(1.0f, t347);
    const float t360 = __fmul_rn(t350, t359);
    const float t361 = -t360;
    const float t362 = __fmaf_rn(t348, t361, t351);
    const float t363 = __fmaf_rn(t349, t361, t352);
    const float t364 = __fmul_rn(t353, t359);
    const float t365 = -t364;
    const float t366 = __fmaf_rn(t348, t365, t354);
    const float t367 = __fmaf_rn(t349, t365, t355);
    const float t368 = __fdiv_rn(1.0f, t362);
    const float t369 = __fmul_rn(t366, t368);
    const float t370 = -t369;
    const float t371 = __fmaf_rn(t363, t370, t367);
    const float t372 = __fdiv_rn(1.0f, t371);
    const float t373 = __fmaf_rn(t356, t361, t357);
    const float t374 = __fmaf_rn(t356, t365, t358);
    const float t375 = __fmaf_rn(t370, t373, t374);
    const float t376 = __fmul_rn(t372, t375);
    const float t377 = -t363;
    const float t378 = __fmaf_rn(t376, t377, t373);
    const float t379 = __fmul_rn(t368, t378);
    const float t380 = __fmaf_rn(t325, t379, t356);
    const float t381 = __fmaf_rn(t328, t376, t380);
    const float t382 = __fmul_rn(t359, t381);
    const float t383 = __fmul_rn(t115, t382);
    const float t384 = __fmaf_rn(t132, t379, t383);
    const float t385 = __fmaf_rn(t149, t376, t384);
    const float t386 = __fmul_rn(t132, t382);
    const float t387 = __fmaf_rn(t161, t379, t386);
    const float t388 = __fmaf_rn(t176, t376, t387);
    const float t389 = __fmul_rn(t149, t382);
    const float t390 = __fmaf_rn(t176, t379, t389);
    const float t391 = __fmaf_rn(t187, t376, t390);
    const float t392 = __fsub_rn(p[0], t382);
    const float t393 = __fsub_rn(p[1], t379);
    const float t394 = __fsub_rn(p[2], t376);
    const float t395 = __fsub_rn(t44, t385);
    const float t396 = __fsub_rn(t72, t388);
    const float t397 = __fsub_rn(t99, t391);
    const float t398 = fabsf(t382);
    const float t399 = fabsf(t379);
    const float t400 = (t399 <= t398) ? t398 : t399;
    const float t401 = fabsf(t376);
    const float t402 = (t401 <= t400) ? t400 : t401;
    const float t403 = __fmul_rn(k[0], t402);
    const float t404 = fabsf(t385);
    const float t405 = fabsf(t388);
    const float t406 = (t405 <= t404) ? t404 : t405;
    const float t407 = fabsf(t391);
    const float t408 = (t407 <= t406) ? t406 : t407;
    const float t409 = fabsf(t44);
    const float t410 = fabsf(t72);
    const float t411 = (t410 <= t409) ? t409 : t410;
    const float t412 = fabsf(t99);
    const float t413 = (t412 <= t411) ? t411 : t412;
    const float t414 = __fmul_rn(t413, t413);
    const float t415 = __fmul_rn(0x1p-2f, t414);
    const float t416 = __fmul_rn(t403, t415);
    const float t417 = __fmaf_rn(0x1p-1f, t408, t416);
    const float t418 = __fmul_rn(k[1], t403);
    const float t419 = __fmaf_rn(t408, t417, t418);
    const float t423 = __fmul_rn(0x1p-52f, 4.0f);
    const float t424 = (t403 <= 0x1.0624dep-10f) ? t419 : t403;
    const float t425 = (t424 <= t403) ? t424 : t403;
    const float t426 = (t403 <= t423) ? t425 : t424;
    p_next[0] = t392;
    p_next[1] = t393;
    p_next[2] = t394;
    x[0] = t395;
    x[1] = t396;
    x[2] = t397;
    *left = t426;
    *moved = t403;
}

INLINE void coadjoint_accept(const float *RESTRICT mu, const float *RESTRICT x, float left, float way, float *RESTRICT right)
{
    const float t10 = __fmul_rn(0x1p-52f, 4.0f);
    const float t13 = __fmul_rn(x[0], x[0]);
    const float t14 = __fmaf_rn(x[1], x[1], t13);
    const float t15 = __fmaf_rn(x[2], x[2], t14);
    const float t17 = __fmul_rn(t15, 0x1.9f02f6p-4f);
    const float t18 = fabsf(t17);
    const float t21 = (t17 <= INFINITY) ? 0.0f : 1.0f;
    const float t22 = __fadd_rn(t21, t21);
    const float t23 = __fadd_rn(t18, t22);
    const float t24 = __fmul_rn(mu[0], mu[0]);
    const float t25 = __fmaf_rn(mu[1], mu[1], t24);
    const float t26 = __fmaf_rn(mu[2], mu[2], t25);
    const float t30 = (coadjoint_slots[224] <= 0x1.fffffep+127f) ? 4.0f : 9.0f;
    const float t31 = __fmul_rn(t23, t30);
    const float t32 = (t26 <= coadjoint_slots[224]) ? 1.0f : 0.0f;
    const float t33 = (t31 <= 1.0f) ? t32 : 0.0f;
    const float t34 = (way <= 0x1.99999ap-5f) ? t33 : 0.0f;
    const float t35 = (left <= t10) ? t34 : 0.0f;
    *right = t35;
}

INLINE void coadjoint_transport(const float *RESTRICT g, const float *RESTRICT mu, const float *RESTRICT x, float *RESTRICT g_next, float *RESTRICT mu_next)
{
    const float t10 = __fmul_rn(x[0], x[0]);
    const float t11 = __fmaf_rn(x[1], x[1], t10);
    const float t12 = __fmaf_rn(x[2], x[2], t11);
    const float t22 = __fmaf_rn(t12, (-0x1p-3f), 1.0f);
    const float t23 = __fmaf_rn(t12, (-0x1.6c16c2p-16f), 0x1.555556p-9f);
    const float t24 = __fmaf_rn(t12, (-0x1.27e4fcp-32f), 0x1.a01a02p-24f);
    const float t25 = __fmaf_rn(t12, (-0x1.93974ap-51f), 0x1.1eed8ep-41f);
    const float t26 = __fmul_rn(t12, t12);
    const float t27 = __fmaf_rn(t23, t26, t22);
    const float t28 = __fmaf_rn(t25, t26, t24);
    const float t29 = __fmul_rn(t26, t26);
    const float t30 = __fmaf_rn(t28, t29, t27);
    const float t31 = __fmul_rn(t29, t29);
    const float t32 = __fmaf_rn(0x1.ae7f3ep-61f, t31, t30);
    const float t42 = __fmaf_rn(t12, (-0x1.555556p-6f), 0x1p-1f);
    const float t43 = __fmaf_rn(t12, (-0x1.a01a02p-20f), 0x1.111112p-12f);
    const float t44 = __fmaf_rn(t12, (-0x1.ae6456p-37f), 0x1.71de3ap-28f);
    const float t45 = __fmaf_rn(t12, (-0x1.ae7f3ep-56f), 0x1.612462p-46f);
    const float t46 = __fmaf_rn(t26, t43, t42);
    const float t47 = __fmaf_rn(t26, t45, t44);
    const float t48 = __fmaf_rn(t29, t47, t46);
    const float t49 = __fmaf_rn(t31, 0x1.952c78p-66f, t48);
    const float t50 = __fmul_rn(x[0], t49);
    const float t51 = __fmul_rn(x[1], t49);
    const float t52 = __fmul_rn(x[2], t49);
    const float t54 = __fmul_rn(mu[1], t52);
    const float t55 = -mu[2];
    const float t56 = __fmaf_rn(t51, t55, t54);
    const float t57 = __fmul_rn(mu[2], t50);
    const float t58 = -mu[0];
    const float t59 = __fmaf_rn(t52, t58, t57);
    const float t60 = __fmul_rn(mu[0], t51);
    const float t61 = -mu[1];
    const float t62 = __fmaf_rn(t50, t61, t60);
    const float t63 = __fmul_rn(2.0f, t56);
    const float t64 = __fmul_rn(2.0f, t59);
    const float t65 = __fmul_rn(2.0f, t62);
    const float t66 = __fmul_rn(t52, t64);
    const float t67 = -t65;
    const float t68 = __fmaf_rn(t51, t67, t66);
    const float t69 = __fmul_rn(t50, t65);
    const float t70 = -t63;
    const float t71 = __fmaf_rn(t52, t70, t69);
    const float t72 = __fmul_rn(t51, t63);
    const float t73 = -t64;
    const float t74 = __fmaf_rn(t50, t73, t72);
    const float t75 = __fmaf_rn(t32, t63, mu[0]);
    const float t76 = __fmaf_rn(t32, t64, mu[1]);
    const float t77 = __fmaf_rn(t32, t65, mu[2]);
    const float t78 = __fadd_rn(t68, t75);
    const float t79 = __fadd_rn(t71, t76);
    const float t80 = __fadd_rn(t74, t77);
    const float t81 = __fmul_rn(g[1], t50);
    const float t82 = __fmaf_rn(g[2], t51, t81);
    const float t83 = __fmaf_rn(g[3], t52, t82);
    const float t84 = -t83;
    const float t85 = __fmaf_rn(g[0], t32, t84);
    const float t86 = __fmul_rn(g[2], t52);
    const float t87 = -g[3];
    const float t88 = __fmaf_rn(t51, t87, t86);
    const float t89 = __fmul_rn(g[3], t50);
    const float t90 = -g[1];
    const float t91 = __fmaf_rn(t52, t90, t89);
    const float t92 = __fmul_rn(g[1], t51);
    const float t93 = -g[2];
    const float t94 = __fmaf_rn(t50, t93, t92);
    const float t95 = __fmaf_rn(g[0], t50, t88);
    const float t96 = __fmaf_rn(g[0], t51, t91);
    const float t97 = __fmaf_rn(g[0], t52, t94);
    const float t98 = __fmaf_rn(g[1], t32, t95);
    const float t99 = __fmaf_rn(g[2], t32, t96);
    const float t100 = __fmaf_rn(g[3], t32, t97);
    const float t101 = __fmul_rn(t85, t85);
    const float t102 = __fmaf_rn(t98, t98, t101);
    const float t103 = __fmaf_rn(t99, t99, t102);
    const float t104 = __fmaf_rn(t100, t100, t103);
    const float t107 = __fmaf_rn(t104, (-0x1p-1f), 0x1.8p+0f);
    const float t108 = __fmul_rn(t85, t107);
    const float t109 = __fmul_rn(t98, t107);
    const float t110 = __fmul_rn(t99, t107);
    const float t111 = __fmul_rn(t100, t107);
    g_next[0] = t108;
    g_next[1] = t109;
    g_next[2] = t110;
    g_next[3] = t111;
    mu_next[0] = t78;
    mu_next[1] = t79;
    mu_next[2] = t80;
}

INLINE void coadjoint_sound(const float *RESTRICT g, const float *RESTRICT mu, float *RESTRICT right)
{
    const float t8 = __fmul_rn(g[0], g[0]);
    const float t9 = __fmaf_rn(g[1], g[1], t8);
    const float t10 = __fmaf_rn(g[2], g[2], t9);
    const float t11 = __fmaf_rn(g[3], g[3], t10);
    const float t13 = __fsub_rn(t11, 1.0f);
    const float t14 = fabsf(t13);
    const float t15 = __fsub_rn(mu[0], mu[0]);
    const float t16 = __fsub_rn(mu[1], mu[1]);
    const float t17 = __fadd_rn(t15, t16);
    const float t18 = __fsub_rn(mu[2], mu[2]);
    const float t19 = __fadd_rn(t17, t18);
    const float t20 = __fadd_rn(t14, t19);
    const float t22 = __fsqrt_rn(0x1p-52f);
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
            float left = 1.0f;
            float way = 0.0f;
            float right = 0.0f;
            COUNT tried = 0u;
            coadjoint_guess(mu, p, k);
            while ((tried < 12u) && (!(left <= TOLERANCE) && way <= NEAR)) {
                float moved = 0.0f;
                float p_next[DIM];
                coadjoint_correct(p, mu, k, p_next, x, &left, &moved);
                coadjoint_copy(p, p_next, DIM);
                way = __fadd_rn(way, moved);
                tried++;
            }
            coadjoint_accept(mu, x, left, way, &right);
            if (!(right == ONE)) {
                why = !(way <= NEAR) ? 2u : !(left <= TOLERANCE) ? 1u : 3u;
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
