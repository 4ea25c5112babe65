/*
 * rigid_body, K = 7, h = 0.1
 *
 * coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of double precision.
 * Number i of trajectory r is at i * rows + r of g (4 numbers each) and mu (3 each). Trajectory r goes from
 * step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:
 * 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,
 * 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.
 * Let targets be multiples of 256, or one.
 *
 * A step takes 440 operations and 461 for each correction, most often one.
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
#define DIM 3
#define ELEMENT 4
#define DIM_ARRAY 3
#define ELEMENT_ARRAY 4
#define TOLERANCE 0x1p-50
#define NEAR 0x1.999999999999ap-5

__constant NUMBER coadjoint_slots[225] = {
    0x1.1111111111111p-4,
    0x1.8daea1d7f4cf8p-19,
    0x1.b25ffda505644p-32,
    0x1.e31d2bca7382ap-45,
    0x1.f11a4a4df2037p-21,
    0x1.140253d630c26p-32,
    0x1.f98c50b21a73bp-45,
    0x1.b9297d9b9979cp-34,
    0x1.c6a7ad5930e3cp-45,
    0x1.91ec59ed28b18p-47,
    (-0x1.821c6faf213cap-34),
    (-0x1.1e2d9d0862c0bp-46),
    0x1.0066e22a4c124p-33,
    0x1.7252cc0e5e74bp-44,
    0x1.18f1183648f22p-45,
    0x1.b74f00c74242cp-47,
    0x1.253303606a824p-47,
    0x1.999999999999ap-5,
    0x1.2a42f961f79bbp-21,
    0x1.665bfe0e8ad91p-35,
    0x1.c6f7817b90328p-49,
    (-0x1.e8abfd59a610cp-36),
    (-0x1.abdaee9053a45p-48),
    0x1.7550730118d23p-49,
    0x1.b9297d9b9979cp-33,
    0x1.c6a7ad5930e3cp-44,
    0x1.2d714371de852p-45,
    0x1.0066e22a4c124p-34,
    0x1.7252cc0e5e74bp-45,
    0x1.86eeaf2b38adbp-49,
    0x1.47ae147ae147cp-5,
    0x1.665bfe0e8ad91p-34,
    0x1.5539a11cac25ep-47,
    (-0x1.e8abfd59a610cp-37),
    0x1.f1c09956cbc2fp-51,
    0x1.b25ffda505644p-31,
    0x1.6a55e0d7d6a2p-43,
    0x1.f98c50b21a73bp-44,
    (-0x1.821c6faf213cap-35),
    0x1.24df55da2c2c8p-48,
    (-0x1.821c6faf213cap-33),
    (-0x1.1e2d9d0862c0bp-45),
    0x1.0066e22a4c124p-32,
    0x1.7252cc0e5e74bp-43,
    0x1.18f1183648f22p-44,
    0x1.b74f00c74242cp-45,
    0x1.253303606a824p-45,
    0x1.f11a4a4df2037p-20,
    0x1.140253d630c26p-31,
    0x1.b9297d9b9979cp-32,
    0x1.c6a7ad5930e3cp-43,
    0x1.2d714371de852p-44,
    0x1.18f1183648f22p-43,
    0x1.253303606a824p-46,
    0x1.8daea1d7f4cf8p-18,
    0x1.b25ffda505644p-30,
    0x1.6a55e0d7d6a2p-42,
    0x1.f98c50b21a73bp-43,
    (-0x1.1e2d9d0862c0bp-44),
    0x1.b74f00c74242cp-46,
    (-0x1.e8abfd59a610cp-35),
    (-0x1.abdaee9053a45p-47),
    0x1.7550730118d23p-47,
    0x1.2d714371de852p-43,
    0x1.2a42f961f79bbp-20,
    0x1.665bfe0e8ad91p-33,
    0x1.5539a11cac25ep-46,
    (-0x1.abdaee9053a45p-46),
    0x1.7550730118d23p-48,
    0x1.5539a11cac25ep-45,
    0x1.6a55e0d7d6a2p-41,
    (-0x1.47ae147ae147cp-8),
    0x1.65e9f80f29213p-21,
    (-0x1.15fffe7e17ee4p-40),
    0x1.53cc86b77f7efp-52,
    0x1.bf647612f3698p-23,
    0x1.0756fe9271ab3p-34,
    (-0x1.6ce08e9de44f5p-51),
    0x1.3efe7e452ff59p-36,
    0x1.2e014b3e6036ep-48,
    0x1.388782c670d89p-50,
    1.0,
    (-0x1.463940c326d24p-13),
    0x1.a4ccfdb7dd391p-29,
    (-0x1.c9822f419ddfdp-45),
    (-0x1.65d33c98da80ep-61),
    (-0x1.d208a5a912e34p-16),
    (-0x1.2e3d0a5c72605p-26),
    0x1.f44a25ec0fa3p-41,
    (-0x1.acad451415c4dp-56),
    (-0x1.23a2326b2afeap-28),
    (-0x1.7b6c4f3661cddp-40),
    0x1.40d7e887822bbp-53,
    (-0x1.2ae42f242403cp-42),
    (-0x1.a31fbacde7077p-54),
    (-0x1.2c2e5f233795cp-56),
    0x1.2a42f961f79bbp-20,
    (-0x1.50a3fe2cb0fa8p-34),
    0x1.3b8c918739b02p-48,
    0x1.4c917e325820bp-33,
    (-0x1.a343e0e720ad7p-46),
    0x1.cc89e0c992eb8p-47,
    (-0x1.a831bdb32743dp-27),
    0x1.c89131441d8cap-45,
    (-0x1.118290e4a7046p-59),
    (-0x1.a831bdb32743dp-27),
    (-0x1.a9170477aabp-44),
    (-0x1.f2e4d795a4a57p-53),
    (-0x1.9741588b01887p-40),
    0x1.5133634dc128cp-53,
    (-0x1.0e2cbf32dd3bp-53),
    0x1.51d8e1b93d151p-36,
    0x1.029082a703e4p-46,
    0x1.9401cc24f6144p-49,
    (-0x1.4d28a0bbaef6ep-39),
    0x1.59f0949c1fb0ap-53,
    (-0x1.89772ffb9bc65p-40),
    (-0x1.0516b9f1db0b1p-51),
    (-0x1.03bffb617f8f2p-52),
    0x1.4334a350c4ddp-47,
    (-0x1.5e12232a54239p-52),
    (-0x1.df6188762d52dp-53),
    1.0,
    (-0x1.a36e2eb1c432ep-14),
    0x1.1d0efe744b89cp-29,
    (-0x1.eb65e6e7a9919p-46),
    (-0x1.bc325ce10f3eep-63),
    (-0x1.dd37f5698c2c5p-28),
    0x1.4eec7cf6ff92dp-42,
    (-0x1.7023bd4f30cd4p-57),
    (-0x1.21ca47924c5fcp-41),
    0x1.004b8f01b0814p-55,
    (-0x1.76f932a97e319p-55),
    0x1.b4e81b4e81b4fp-7,
    (-0x1.1660a47d91c48p-20),
    0x1.a0fffdbd23e55p-38,
    (-0x1.77f29ff12591ep-52),
    0x1.2a42f961f79bbp-20,
    (-0x1.aa3afdb053b0cp-33),
    0x1.71ad9df78c5ddp-48,
    0x1.a4ccfdb7dd392p-34,
    (-0x1.9859e03418e95p-46),
    0x1.363671b8970bep-47,
    (-0x1.36b06e70b7422p-16),
    0x1.8bea28851394ap-27,
    (-0x1.239b1571faa02p-40),
    0x1.16338ad649e1cp-55,
    (-0x1.cb8b382cbfdecp-29),
    0x1.4ac4bbd60723cp-39,
    (-0x1.a35f1c52e0961p-52),
    (-0x1.0db403f49db15p-41),
    0x1.3d0e27e9a09b9p-52,
    (-0x1.c13b7642405a1p-55),
    0x1.091f168ff88a6p-22,
    (-0x1.956aa877e2e61p-35),
    (-0x1.2bbbe67e0107dp-49),
    (-0x1.36b2e1deecbedp-34),
    0x1.b003505a9fbe4p-46,
    (-0x1.38522a8da91b7p-47),
    0x1.1acbd3ccc4d7fp-28,
    (-0x1.e5077080915efp-40),
    0x1.793ba8cda65adp-52,
    (-0x1.d6b0131ea26c1p-48),
    (-0x1.ec3c1e01e2bf2p-52),
    (-0x1.54fcb63e03e36p-54),
    0x1.29a09616fef42p-34,
    (-0x1.a5d74283d8ad7p-46),
    0x1.d1d9a48f07dd3p-47,
    0x1.5c1ce37952ca9p-42,
    0x1.fe8bdc5d9b513p-57,
    (-0x1.4c3373aaab85ep-54),
    0x1.e554d7698b07ep-48,
    0x1.55a74a6a99b7p-55,
    1.0,
    0x1.5d867c3ece2a6p-14,
    (-0x1.316b7e5807ca7p-28),
    (-0x1.a79e779b922ep-46),
    (-0x1.48853f5bc89bep-58),
    0x1.dd37f5698c2c5p-29,
    (-0x1.4af3cd718a33fp-41),
    (-0x1.29ddc59d95e3dp-58),
    0x1.7240c10a3903cp-43,
    (-0x1.09041c21d6548p-54),
    0x1.68c83dc25c7f2p-57,
    (-0x1.1111111111111p-7),
    0x1.2a42f961f79bbp-20,
    (-0x1.049ffe96366f5p-36),
    0x1.1827437ec712ep-50,
    (-0x1.36b06e70b7422p-21),
    0x1.b9297d9b9979cp-33,
    (-0x1.c3277cd27bae8p-48),
    (-0x1.754a7df9d0a22p-36),
    0x1.82c5e2455f773p-46,
    (-0x1.3c0f3b3d12106p-50),
    0x1.36b06e70b7422p-15,
    (-0x1.f1b8a7f7c0d82p-30),
    (-0x1.508ab182b421bp-43),
    (-0x1.29ac6aafb5c5bp-58),
    (-0x1.2c78910991256p-27),
    0x1.e0ccdb87cae96p-41,
    (-0x1.59e24cab71363p-53),
    (-0x1.bbe9af08344ecp-40),
    0x1.bfc1818476ab4p-53,
    (-0x1.a90cf9e27001fp-53),
    (-0x1.4b66dc33f6acfp-21),
    0x1.ca81c49ff778p-36,
    0x1.2bfc2a39122f1p-46,
    (-0x1.69faa8b42f28ep-38),
    (-0x1.97edee6fe2196p-51),
    0x1.7b7df5d0b2f3fp-49,
    0x1.1acbd3ccc4d7fp-28,
    (-0x1.8de0d68fe54c2p-40),
    0x1.6f2a38b90adfap-56,
    0x1.cba7f2abea9d8p-43,
    (-0x1.80de28c620afp-51),
    (-0x1.26a68af1e5ad2p-53),
    (-0x1.056deb9e93d66p-34),
    0x1.0afc0d1ee33dap-45,
    (-0x1.c075fb7613a43p-49),
    0x1.2b1536d0cc8ap-41,
    (-0x1.9c741f2f284e8p-53),
    (-0x1.899091d861e21p-53),
    (-0x1.eb9b74ae37dcfp-48),
    0x1.0ffbe35e85e33p-54,
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
    const double t3 = mu[0] * mu[0];
    const double t5 = mu[1] * mu[1];
    const double t7 = mu[2] * mu[2];
    const double t10 = fma(t7, coadjoint_slots[112], coadjoint_slots[111]);
    const double t11 = fma(t5, coadjoint_slots[113], t10);
    const double t12 = fma(t3, coadjoint_slots[119], t11);
    const double t16 = fma(t7, coadjoint_slots[100], coadjoint_slots[99]);
    const double t17 = fma(t5, coadjoint_slots[101], t16);
    const double t20 = fma(t7, coadjoint_slots[98], coadjoint_slots[97]);
    const double t22 = fma(t7, t20, coadjoint_slots[96]);
    const double t23 = fma(t5, t17, t22);
    const double t24 = fma(t3, t12, t23);
    const double t28 = fma(t7, coadjoint_slots[79], coadjoint_slots[78]);
    const double t29 = fma(t5, coadjoint_slots[80], t28);
    const double t32 = fma(t7, coadjoint_slots[77], coadjoint_slots[76]);
    const double t34 = fma(t7, t32, coadjoint_slots[75]);
    const double t35 = fma(t5, t29, t34);
    const double t38 = fma(t7, coadjoint_slots[74], coadjoint_slots[73]);
    const double t40 = fma(t7, t38, coadjoint_slots[72]);
    const double t42 = fma(t7, t40, coadjoint_slots[71]);
    const double t43 = fma(t5, t35, t42);
    const double t44 = fma(t3, t24, t43);
    const double t45 = mu[1] * mu[2];
    const double t46 = t44 * t45;
    const double t51 = fma(t7, coadjoint_slots[117], coadjoint_slots[116]);
    const double t52 = fma(t5, coadjoint_slots[118], t51);
    const double t53 = fma(t3, coadjoint_slots[121], t52);
    const double t57 = fma(t7, coadjoint_slots[109], coadjoint_slots[108]);
    const double t58 = fma(t5, coadjoint_slots[110], t57);
    const double t61 = fma(t7, coadjoint_slots[107], coadjoint_slots[106]);
    const double t63 = fma(t7, t61, coadjoint_slots[105]);
    const double t64 = fma(t5, t58, t63);
    const double t65 = fma(t3, t53, t64);
    const double t69 = fma(t7, coadjoint_slots[94], coadjoint_slots[93]);
    const double t70 = fma(t5, coadjoint_slots[95], t69);
    const double t73 = fma(t7, coadjoint_slots[92], coadjoint_slots[91]);
    const double t75 = fma(t7, t73, coadjoint_slots[90]);
    const double t76 = fma(t5, t70, t75);
    const double t79 = fma(t7, coadjoint_slots[89], coadjoint_slots[88]);
    const double t81 = fma(t7, t79, coadjoint_slots[87]);
    const double t83 = fma(t7, t81, coadjoint_slots[86]);
    const double t84 = fma(t5, t76, t83);
    const double t85 = fma(t3, t65, t84);
    const double t89 = fma(t7, coadjoint_slots[115], coadjoint_slots[114]);
    const double t90 = fma(t3, coadjoint_slots[120], t89);
    const double t93 = fma(t7, coadjoint_slots[104], coadjoint_slots[103]);
    const double t95 = fma(t7, t93, coadjoint_slots[102]);
    const double t96 = fma(t3, t90, t95);
    const double t99 = fma(t7, coadjoint_slots[85], coadjoint_slots[84]);
    const double t101 = fma(t7, t99, coadjoint_slots[83]);
    const double t103 = fma(t7, t101, coadjoint_slots[82]);
    const double t104 = fma(t3, t96, t103);
    const double t106 = fma(t7, t104, coadjoint_slots[81]);
    const double t107 = fma(t5, t85, t106);
    const double t108 = fma(mu[0], t107, t46);
    const double t113 = fma(t7, coadjoint_slots[169], coadjoint_slots[168]);
    const double t114 = fma(t5, coadjoint_slots[170], t113);
    const double t115 = fma(t3, coadjoint_slots[172], t114);
    const double t119 = fma(t7, coadjoint_slots[163], coadjoint_slots[162]);
    const double t120 = fma(t5, coadjoint_slots[164], t119);
    const double t123 = fma(t7, coadjoint_slots[161], coadjoint_slots[160]);
    const double t125 = fma(t7, t123, coadjoint_slots[159]);
    const double t126 = fma(t5, t120, t125);
    const double t127 = fma(t3, t115, t126);
    const double t131 = fma(t7, coadjoint_slots[151], coadjoint_slots[150]);
    const double t132 = fma(t5, coadjoint_slots[152], t131);
    const double t135 = fma(t7, coadjoint_slots[149], coadjoint_slots[148]);
    const double t137 = fma(t7, t135, coadjoint_slots[147]);
    const double t138 = fma(t5, t132, t137);
    const double t141 = fma(t7, coadjoint_slots[146], coadjoint_slots[145]);
    const double t143 = fma(t7, t141, coadjoint_slots[144]);
    const double t145 = fma(t7, t143, coadjoint_slots[143]);
    const double t146 = fma(t5, t138, t145);
    const double t147 = fma(t3, t127, t146);
    const double t151 = fma(t7, coadjoint_slots[131], coadjoint_slots[130]);
    const double t152 = fma(t5, coadjoint_slots[132], t151);
    const double t155 = fma(t7, coadjoint_slots[129], coadjoint_slots[128]);
    const double t157 = fma(t7, t155, coadjoint_slots[127]);
    const double t158 = fma(t5, t152, t157);
    const double t161 = fma(t7, coadjoint_slots[126], coadjoint_slots[125]);
    const double t163 = fma(t7, t161, coadjoint_slots[124]);
    const double t165 = fma(t7, t163, coadjoint_slots[123]);
    const double t166 = fma(t5, t158, t165);
    const double t168 = fma(t7, t166, coadjoint_slots[122]);
    const double t169 = fma(t3, t147, t168);
    const double t170 = mu[1] * t169;
    const double t175 = fma(t7, coadjoint_slots[166], coadjoint_slots[165]);
    const double t176 = fma(t5, coadjoint_slots[167], t175);
    const double t177 = fma(t3, coadjoint_slots[171], t176);
    const double t181 = fma(t7, coadjoint_slots[157], coadjoint_slots[156]);
    const double t182 = fma(t5, coadjoint_slots[158], t181);
    const double t185 = fma(t7, coadjoint_slots[155], coadjoint_slots[154]);
    const double t187 = fma(t7, t185, coadjoint_slots[153]);
    const double t188 = fma(t5, t182, t187);
    const double t189 = fma(t3, t177, t188);
    const double t193 = fma(t7, coadjoint_slots[141], coadjoint_slots[140]);
    const double t194 = fma(t5, coadjoint_slots[142], t193);
    const double t197 = fma(t7, coadjoint_slots[139], coadjoint_slots[138]);
    const double t199 = fma(t7, t197, coadjoint_slots[137]);
    const double t200 = fma(t5, t194, t199);
    const double t203 = fma(t7, coadjoint_slots[136], coadjoint_slots[135]);
    const double t205 = fma(t7, t203, coadjoint_slots[134]);
    const double t207 = fma(t7, t205, coadjoint_slots[133]);
    const double t208 = fma(t5, t200, t207);
    const double t209 = fma(t3, t189, t208);
    const double t210 = mu[0] * mu[2];
    const double t211 = fma(t209, t210, t170);
    const double t216 = fma(t7, coadjoint_slots[220], coadjoint_slots[219]);
    const double t217 = fma(t5, coadjoint_slots[221], t216);
    const double t218 = fma(t3, coadjoint_slots[223], t217);
    const double t222 = fma(t7, coadjoint_slots[214], coadjoint_slots[213]);
    const double t223 = fma(t5, coadjoint_slots[215], t222);
    const double t226 = fma(t7, coadjoint_slots[212], coadjoint_slots[211]);
    const double t228 = fma(t7, t226, coadjoint_slots[210]);
    const double t229 = fma(t5, t223, t228);
    const double t230 = fma(t3, t218, t229);
    const double t234 = fma(t7, coadjoint_slots[202], coadjoint_slots[201]);
    const double t235 = fma(t5, coadjoint_slots[203], t234);
    const double t238 = fma(t7, coadjoint_slots[200], coadjoint_slots[199]);
    const double t240 = fma(t7, t238, coadjoint_slots[198]);
    const double t241 = fma(t5, t235, t240);
    const double t244 = fma(t7, coadjoint_slots[197], coadjoint_slots[196]);
    const double t246 = fma(t7, t244, coadjoint_slots[195]);
    const double t248 = fma(t7, t246, coadjoint_slots[194]);
    const double t249 = fma(t5, t241, t248);
    const double t250 = fma(t3, t230, t249);
    const double t254 = fma(t7, coadjoint_slots[182], coadjoint_slots[181]);
    const double t255 = fma(t5, coadjoint_slots[183], t254);
    const double t258 = fma(t7, coadjoint_slots[180], coadjoint_slots[179]);
    const double t260 = fma(t7, t258, coadjoint_slots[178]);
    const double t261 = fma(t5, t255, t260);
    const double t264 = fma(t7, coadjoint_slots[177], coadjoint_slots[176]);
    const double t266 = fma(t7, t264, coadjoint_slots[175]);
    const double t268 = fma(t7, t266, coadjoint_slots[174]);
    const double t269 = fma(t5, t261, t268);
    const double t271 = fma(t5, t269, coadjoint_slots[173]);
    const double t272 = fma(t3, t250, t271);
    const double t273 = mu[2] * t272;
    const double t278 = fma(t7, coadjoint_slots[217], coadjoint_slots[216]);
    const double t279 = fma(t5, coadjoint_slots[218], t278);
    const double t280 = fma(t3, coadjoint_slots[222], t279);
    const double t284 = fma(t7, coadjoint_slots[208], coadjoint_slots[207]);
    const double t285 = fma(t5, coadjoint_slots[209], t284);
    const double t288 = fma(t7, coadjoint_slots[206], coadjoint_slots[205]);
    const double t290 = fma(t7, t288, coadjoint_slots[204]);
    const double t291 = fma(t5, t285, t290);
    const double t292 = fma(t3, t280, t291);
    const double t296 = fma(t7, coadjoint_slots[192], coadjoint_slots[191]);
    const double t297 = fma(t5, coadjoint_slots[193], t296);
    const double t300 = fma(t7, coadjoint_slots[190], coadjoint_slots[189]);
    const double t302 = fma(t7, t300, coadjoint_slots[188]);
    const double t303 = fma(t5, t297, t302);
    const double t306 = fma(t7, coadjoint_slots[187], coadjoint_slots[186]);
    const double t308 = fma(t7, t306, coadjoint_slots[185]);
    const double t310 = fma(t7, t308, coadjoint_slots[184]);
    const double t311 = fma(t5, t303, t310);
    const double t312 = fma(t3, t292, t311);
    const double t313 = mu[0] * mu[1];
    const double t314 = fma(t312, t313, t273);
    const double t317 = fabs(mu[0]);
    const double t318 = fabs(mu[1]);
    const double t319 = (t318 <= t317) ? t317 : t318;
    const double t320 = fabs(mu[2]);
    const double t321 = (t320 <= t319) ? t319 : t320;
    const double t322 = 0x1p-126 + t321;
    const double t324 = 1.0 / t322;
    p[0] = t108;
    p[1] = t211;
    p[2] = t314;
    k[0] = t324;
    k[1] = 0.0;
}

INLINE void coadjoint_correct(const double *RESTRICT p, const double *RESTRICT mu, const double *RESTRICT k, double *RESTRICT p_next, double *RESTRICT x, double *RESTRICT left, double *RESTRICT moved)
{
    const double t8 = p[1] * p[1];
    const double t9 = p[0] * p[0];
    const double t12 = p[2] * p[2];
    const double t15 = fma(t12, coadjoint_slots[13], coadjoint_slots[12]);
    const double t16 = fma(t8, coadjoint_slots[14], t15);
    const double t17 = fma(t9, coadjoint_slots[16], t16);
    const double t21 = fma(t12, coadjoint_slots[8], coadjoint_slots[7]);
    const double t22 = fma(t8, coadjoint_slots[9], t21);
    const double t25 = fma(t12, coadjoint_slots[6], coadjoint_slots[5]);
    const double t27 = fma(t12, t25, coadjoint_slots[4]);
    const double t28 = fma(t8, t22, t27);
    const double t29 = fma(t9, t17, t28);
    const double t33 = fma(t12, coadjoint_slots[11], coadjoint_slots[10]);
    const double t34 = fma(t9, coadjoint_slots[15], t33);
    const double t37 = fma(t12, coadjoint_slots[3], coadjoint_slots[2]);
    const double t39 = fma(t12, t37, coadjoint_slots[1]);
    const double t40 = fma(t9, t34, t39);
    const double t42 = fma(t12, t40, coadjoint_slots[0]);
    const double t43 = fma(t8, t29, t42);
    const double t44 = p[0] * t43;
    const double t48 = fma(t12, coadjoint_slots[28], coadjoint_slots[27]);
    const double t49 = fma(t8, coadjoint_slots[14], t48);
    const double t50 = fma(t9, coadjoint_slots[29], t49);
    const double t54 = fma(t12, coadjoint_slots[25], coadjoint_slots[24]);
    const double t55 = fma(t8, coadjoint_slots[26], t54);
    const double t56 = fma(t8, t55, t27);
    const double t57 = fma(t9, t50, t56);
    const double t61 = fma(t12, coadjoint_slots[22], coadjoint_slots[21]);
    const double t62 = fma(t8, coadjoint_slots[23], t61);
    const double t65 = fma(t12, coadjoint_slots[20], coadjoint_slots[19]);
    const double t67 = fma(t12, t65, coadjoint_slots[18]);
    const double t68 = fma(t8, t62, t67);
    const double t70 = fma(t12, t68, coadjoint_slots[17]);
    const double t71 = fma(t9, t57, t70);
    const double t72 = p[1] * t71;
    const double t75 = fma(t12, coadjoint_slots[11], coadjoint_slots[38]);
    const double t76 = fma(t8, coadjoint_slots[28], t75);
    const double t77 = fma(t9, coadjoint_slots[39], t76);
    const double t79 = fma(t12, coadjoint_slots[37], coadjoint_slots[5]);
    const double t80 = fma(t8, coadjoint_slots[8], t79);
    const double t83 = fma(t12, coadjoint_slots[36], coadjoint_slots[35]);
    const double t84 = fma(t12, t83, coadjoint_slots[1]);
    const double t85 = fma(t8, t80, t84);
    const double t86 = fma(t9, t77, t85);
    const double t89 = fma(t12, coadjoint_slots[22], coadjoint_slots[33]);
    const double t90 = fma(t8, coadjoint_slots[34], t89);
    const double t93 = fma(t12, coadjoint_slots[32], coadjoint_slots[31]);
    const double t94 = fma(t12, t93, coadjoint_slots[18]);
    const double t95 = fma(t8, t90, t94);
    const double t97 = fma(t8, t95, coadjoint_slots[30]);
    const double t98 = fma(t9, t86, t97);
    const double t99 = p[2] * t98;
    const double t104 = fma(t12, coadjoint_slots[43], coadjoint_slots[42]);
    const double t105 = fma(t8, coadjoint_slots[44], t104);
    const double t106 = fma(t9, coadjoint_slots[46], t105);
    const double t110 = fma(t12, coadjoint_slots[41], coadjoint_slots[40]);
    const double t111 = fma(t9, coadjoint_slots[45], t110);
    const double t112 = t12 * t111;
    const double t113 = fma(t8, t106, t112);
    const double t114 = t9 * t113;
    const double t115 = t43 + t114;
    const double t116 = p[0] * p[1];
    const double t119 = fma(t8, coadjoint_slots[52], t104);
    const double t120 = fma(t9, coadjoint_slots[53], t119);
    const double t124 = fma(t12, coadjoint_slots[50], coadjoint_slots[49]);
    const double t125 = fma(t8, coadjoint_slots[51], t124);
    const double t127 = fma(t12, coadjoint_slots[37], coadjoint_slots[48]);
    const double t129 = fma(t12, t127, coadjoint_slots[47]);
    const double t130 = fma(t8, t125, t129);
    const double t131 = fma(t9, t120, t130);
    const double t132 = t116 * t131;
    const double t133 = p[0] * p[2];
    const double t136 = fma(t12, coadjoint_slots[58], coadjoint_slots[40]);
    const double t137 = fma(t8, coadjoint_slots[43], t136);
    const double t138 = fma(t9, coadjoint_slots[59], t137);
    const double t140 = fma(t12, coadjoint_slots[57], coadjoint_slots[48]);
    const double t141 = fma(t8, coadjoint_slots[25], t140);
    const double t144 = fma(t12, coadjoint_slots[56], coadjoint_slots[55]);
    const double t146 = fma(t12, t144, coadjoint_slots[54]);
    const double t147 = fma(t8, t141, t146);
    const double t148 = fma(t9, t138, t147);
    const double t149 = t133 * t148;
    const double t151 = fma(t8, coadjoint_slots[63], t124);
    const double t152 = fma(t9, coadjoint_slots[44], t151);
    const double t156 = fma(t12, coadjoint_slots[61], coadjoint_slots[60]);
    const double t157 = fma(t8, coadjoint_slots[62], t156);
    const double t158 = t12 * t157;
    const double t159 = fma(t9, t152, t158);
    const double t160 = t8 * t159;
    const double t161 = t71 + t160;
    const double t162 = p[1] * p[2];
    const double t163 = fma(t8, coadjoint_slots[50], t140);
    const double t164 = fma(t9, coadjoint_slots[13], t163);
    const double t167 = fma(t12, coadjoint_slots[67], coadjoint_slots[60]);
    const double t168 = fma(t8, coadjoint_slots[68], t167);
    const double t171 = fma(t12, coadjoint_slots[66], coadjoint_slots[65]);
    const double t173 = fma(t12, t171, coadjoint_slots[64]);
    const double t174 = fma(t8, t168, t173);
    const double t175 = fma(t9, t164, t174);
    const double t176 = t162 * t175;
    const double t178 = fma(t12, coadjoint_slots[70], coadjoint_slots[55]);
    const double t179 = fma(t8, coadjoint_slots[57], t178);
    const double t180 = fma(t9, coadjoint_slots[41], t179);
    const double t182 = fma(t12, coadjoint_slots[69], coadjoint_slots[65]);
    const double t183 = fma(t8, coadjoint_slots[61], t182);
    const double t184 = t8 * t183;
    const double t185 = fma(t9, t180, t184);
    const double t186 = t12 * t185;
    const double t187 = t98 + t186;
    const double t191 = t44 * t44;
    const double t192 = fma(t72, t72, t191);
    const double t193 = fma(t99, t99, t192);
    const double t204 = fma(t193, (-0x1.5555555555555p-5), 0x1p-1);
    const double t205 = fma(t193, (-0x1.a01a01a01a01ap-16), 0x1.6c16c16c16c17p-10);
    const double t206 = fma(t193, (-0x1.1eed8eff8d898p-29), 0x1.27e4fb7789f5cp-22);
    const double t207 = fma(t193, (-0x1.ae7f3e733b81fp-45), 0x1.93974a8c07c9dp-37);
    const double t208 = fma(t193, (-0x1.e542ba4020225p-62), 0x1.6827863b97d97p-53);
    const double t209 = t193 * t193;
    const double t210 = fma(t205, t209, t204);
    const double t211 = fma(t207, t209, t206);
    const double t212 = fma(0x1.0ce396db7f853p-70, t209, t208);
    const double t213 = t209 * t209;
    const double t214 = fma(t211, t213, t210);
    const double t215 = t213 * t213;
    const double t216 = fma(t212, t215, t214);
    const double t227 = fma(t193, (-0x1.1111111111111p-7), 0x1.5555555555555p-3);
    const double t228 = fma(t193, (-0x1.71de3a556c734p-19), 0x1.a01a01a01a01ap-13);
    const double t229 = fma(t193, (-0x1.6124613a86d09p-33), 0x1.ae64567f544e4p-26);
    const double t230 = fma(t193, (-0x1.952c77030ad4ap-49), 0x1.ae7f3e733b81fp-41);
    const double t231 = fma(t193, (-0x1.71b8ef6dcf572p-66), 0x1.2f49b46814157p-57);
    const double t232 = fma(t209, t228, t227);
    const double t233 = fma(t209, t230, t229);
    const double t234 = fma(t213, t233, t232);
    const double t235 = fma(t215, t231, t234);
    const double t242 = fma(t193, 0x1.6c16c16c16c17p-9, (-0x1.5555555555555p-5));
    const double t243 = fma(t193, 0x1.27e4fb7789f5cp-20, (-0x1.3813813813814p-14));
    const double t244 = fma(t193, 0x1.2eb177e905d76p-34, (-0x1.66a8f2bf70ebep-27));
    const double t245 = fma(t209, t243, t242);
    const double t246 = fma(t209, (-0x1.78af56a4d411bp-42), t244);
    const double t247 = fma(t213, t246, t245);
    const double t254 = fma(t193, 0x1.a01a01a01a01ap-12, (-0x1.1111111111111p-7));
    const double t255 = fma(t193, 0x1.ae64567f544e4p-24, (-0x1.1566abc011567p-17));
    const double t256 = fma(t193, 0x1.42df6ed66ca17p-38, (-0x1.b96d79892884bp-31));
    const double t257 = fma(t209, t255, t254);
    const double t258 = fma(t209, (-0x1.6286e822a97a1p-46), t256);
    const double t259 = fma(t213, t258, t257);
    const double t260 = mu[1] * t99;
    const double t261 = -mu[2];
    const double t262 = fma(t72, t261, t260);
    const double t263 = mu[2] * t44;
    const double t264 = -mu[0];
    const double t265 = fma(t99, t264, t263);
    const double t266 = mu[0] * t72;
    const double t267 = -mu[1];
    const double t268 = fma(t44, t267, t266);
    const double t269 = t99 * t265;
    const double t270 = -t268;
    const double t271 = fma(t72, t270, t269);
    const double t272 = t44 * t268;
    const double t273 = -t262;
    const double t274 = fma(t99, t273, t272);
    const double t275 = t72 * t262;
    const double t276 = -t265;
    const double t277 = fma(t44, t276, t275);
    const double t278 = fma(t216, t262, mu[0]);
    const double t279 = fma(t216, t265, mu[1]);
    const double t280 = fma(t216, t268, mu[2]);
    const double t281 = fma(t235, t271, t278);
    const double t282 = fma(t235, t274, t279);
    const double t283 = fma(t235, t277, t280);
    const double t285 = t247 * t262;
    const double t286 = t247 * t265;
    const double t287 = t247 * t268;
    const double t288 = fma(t259, t271, t285);
    const double t289 = fma(t259, t274, t286);
    const double t290 = fma(t259, t277, t287);
    const double t291 = 2.0 * t288;
    const double t292 = 2.0 * t289;
    const double t293 = 2.0 * t290;
    const double t294 = -t235;
    const double t295 = fma(mu[0], t294, t291);
    const double t296 = fma(mu[1], t294, t292);
    const double t297 = fma(mu[2], t294, t293);
    const double t298 = mu[0] * t216;
    const double t299 = mu[1] * t216;
    const double t300 = mu[2] * t216;
    const double t301 = fma(t235, t262, t298);
    const double t302 = fma(t235, t265, t299);
    const double t303 = fma(t235, t268, t300);
    const double t304 = mu[0] * t44;
    const double t305 = fma(mu[1], t72, t304);
    const double t306 = fma(mu[2], t99, t305);
    const double t307 = t235 * t306;
    const double t308 = -t301;
    const double t309 = -t302;
    const double t310 = -t303;
    const double t311 = fma(t44, t295, t307);
    const double t312 = fma(t72, t295, t310);
    const double t313 = fma(t99, t295, t302);
    const double t314 = fma(t44, t296, t303);
    const double t315 = fma(t72, t296, t307);
    const double t316 = fma(t99, t296, t308);
    const double t317 = fma(t44, t297, t309);
    const double t318 = fma(t72, t297, t301);
    const double t319 = fma(t99, t297, t307);
    const double t320 = t115 * t311;
    const double t321 = fma(t132, t312, t320);
    const double t322 = fma(t149, t313, t321);
    const double t323 = t132 * t311;
    const double t324 = fma(t161, t312, t323);
    const double t325 = fma(t176, t313, t324);
    const double t326 = t149 * t311;
    const double t327 = fma(t176, t312, t326);
    const double t328 = fma(t187, t313, t327);
    const double t329 = t115 * t314;
    const double t330 = fma(t132, t315, t329);
    const double t331 = fma(t149, t316, t330);
    const double t332 = t132 * t314;
    const double t333 = fma(t161, t315, t332);
    const double t334 = fma(t176, t316, t333);
    const double t335 = t149 * t314;
    const double t336 = fma(t176, t315, t335);
    const double t337 = fma(t187, t316, t336);
    const double t338 = t115 * t317;
    const double t339 = fma(t132, t318, t338);
    const double t340 = fma(t149, t319, t339);
    const double t341 = t132 * t317;
    const double t342 = fma(t161, t318, t341);
    const double t343 = fma(t176, t319, t342);
    const double t344 = t149 * t317;
    const double t345 = fma(t176, t318, t344);
    const double t346 = fma(t187, t319, t345);
    const double t347 = 1.0 - t322;
    const double t348 = -t325;
    const double t349 = -t328;
    const double t350 = -t331;
    const double t351 = 1.0 - t334;
    const double t352 = -t337;
    const double t353 = -t340;
    const double t354 = -t343;
    const double t355 = 1.0 - t346;
    const double t356 = p[0] - t281;
    const double t357 = p[1] - t282;
    const double t358 = p[2] - t283;
    const double t359 = 1.0 / t347;
    const double t360 = t350 * t359;
    const double t361 = -t360;
    const double t362 = fma(t348, t361, t351);
    const double t363 = fma(t349, t361, t352);
    const double t364 = t353 * t359;
    const double t365 = -t364;
    const double t366 = fma(t348, t365, t354);
    const double t367 = fma(t349, t365, t355);
    const double t368 = 1.0 / t362;
    const double t369 = t366 * t368;
    const double t370 = -t369;
    const double t371 = fma(t363, t370, t367);
    const double t372 = 1.0 / t371;
    const double t373 = fma(t356, t361, t357);
    const double t374 = fma(t356, t365, t358);
    const double t375 = fma(t370, t373, t374);
    const double t376 = t372 * t375;
    const double t377 = -t363;
    const double t378 = fma(t376, t377, t373);
    const double t379 = t368 * t378;
    const double t380 = fma(t325, t379, t356);
    const double t381 = fma(t328, t376, t380);
    const double t382 = t359 * t381;
    const double t383 = t115 * t382;
    const double t384 = fma(t132, t379, t383);
    const double t385 = fma(t149, t376, t384);
    const double t386 = t132 * t382;
    const double t387 = fma(t161, t379, t386);
    const double t388 = fma(t176, t376, t387);
    const double t389 = t149 * t382;
    const double t390 = fma(t176, t379, t389);
    const double t391 = fma(t187, t376, t390);
    const double t392 = p[0] - t382;
    const double t393 = p[1] - t379;
    const double t394 = p[2] - t376;
    const double t395 = t44 - t385;
    const double t396 = t72 - t388;
    const double t397 = t99 - t391;
    const double t398 = fabs(t382);
    const double t399 = fabs(t379);
    const double t400 = (t399 <= t398) ? t398 : t399;
    const double t401 = fabs(t376);
    const double t402 = (t401 <= t400) ? t400 : t401;
    const double t403 = k[0] * t402;
    const double t404 = fabs(t385);
    const double t405 = fabs(t388);
    const double t406 = (t405 <= t404) ? t404 : t405;
    const double t407 = fabs(t391);
    const double t408 = (t407 <= t406) ? t406 : t407;
    const double t409 = fabs(t44);
    const double t410 = fabs(t72);
    const double t411 = (t410 <= t409) ? t409 : t410;
    const double t412 = fabs(t99);
    const double t413 = (t412 <= t411) ? t411 : t412;
    const double t414 = t413 * t413;
    const double t415 = 0x1p-2 * t414;
    const double t416 = t403 * t415;
    const double t417 = fma(0x1p-1, t408, t416);
    const double t418 = k[1] * t403;
    const double t419 = fma(t408, t417, t418);
    const double t423 = 0x1p-52 * 4.0;
    const double t424 = (t403 <= 0x1.0624dd2f1a9fcp-10) ? t419 : t403;
    const double t425 = (t424 <= t403) ? t424 : t403;
    const double t426 = (t403 <= t423) ? t425 : t424;
    p_next[0] = t392;
    p_next[1] = t393;
    p_next[2] = t394;
    x[0] = t395;
    x[1] = t396;
    x[2] = t397;
    *left = t426;
    *moved = t403;
}

INLINE void coadjoint_accept(const double *RESTRICT mu, const double *RESTRICT x, double left, double way, double *RESTRICT right)
{
    const double t10 = 0x1p-52 * 4.0;
    const double t13 = x[0] * x[0];
    const double t14 = fma(x[1], x[1], t13);
    const double t15 = fma(x[2], x[2], t14);
    const double t17 = t15 * 0x1.9f02f6222c72p-4;
    const double t18 = fabs(t17);
    const double t21 = (t17 <= 0x1.fffffffffffffp+1023) ? 0.0 : 1.0;
    const double t22 = t21 + t21;
    const double t23 = t18 + t22;
    const double t24 = mu[0] * mu[0];
    const double t25 = fma(mu[1], mu[1], t24);
    const double t26 = fma(mu[2], mu[2], t25);
    const double t30 = (coadjoint_slots[224] <= 0x1.fffffep+127) ? 4.0 : 9.0;
    const double t31 = t23 * t30;
    const double t32 = (t26 <= coadjoint_slots[224]) ? 1.0 : 0.0;
    const double t33 = (t31 <= 1.0) ? t32 : 0.0;
    const double t34 = (way <= 0x1.999999999999ap-5) ? t33 : 0.0;
    const double t35 = (left <= t10) ? t34 : 0.0;
    *right = t35;
}

INLINE void coadjoint_transport(const double *RESTRICT g, const double *RESTRICT mu, const double *RESTRICT x, double *RESTRICT g_next, double *RESTRICT mu_next)
{
    const double t10 = x[0] * x[0];
    const double t11 = fma(x[1], x[1], t10);
    const double t12 = fma(x[2], x[2], t11);
    const double t22 = fma(t12, (-0x1p-3), 1.0);
    const double t23 = fma(t12, (-0x1.6c16c16c16c17p-16), 0x1.5555555555555p-9);
    const double t24 = fma(t12, (-0x1.27e4fb7789f5cp-32), 0x1.a01a01a01a01ap-24);
    const double t25 = fma(t12, (-0x1.93974a8c07c9dp-51), 0x1.1eed8eff8d898p-41);
    const double t26 = t12 * t12;
    const double t27 = fma(t23, t26, t22);
    const double t28 = fma(t25, t26, t24);
    const double t29 = t26 * t26;
    const double t30 = fma(t28, t29, t27);
    const double t31 = t29 * t29;
    const double t32 = fma(0x1.ae7f3e733b81fp-61, t31, t30);
    const double t42 = fma(t12, (-0x1.5555555555555p-6), 0x1p-1);
    const double t43 = fma(t12, (-0x1.a01a01a01a01ap-20), 0x1.1111111111111p-12);
    const double t44 = fma(t12, (-0x1.ae64567f544e4p-37), 0x1.71de3a556c734p-28);
    const double t45 = fma(t12, (-0x1.ae7f3e733b81fp-56), 0x1.6124613a86d09p-46);
    const double t46 = fma(t26, t43, t42);
    const double t47 = fma(t26, t45, t44);
    const double t48 = fma(t29, t47, t46);
    const double t49 = fma(t31, 0x1.952c77030ad4ap-66, t48);
    const double t50 = x[0] * t49;
    const double t51 = x[1] * t49;
    const double t52 = x[2] * t49;
    const double t54 = mu[1] * t52;
    const double t55 = -mu[2];
    const double t56 = fma(t51, t55, t54);
    const double t57 = mu[2] * t50;
    const double t58 = -mu[0];
    const double t59 = fma(t52, t58, t57);
    const double t60 = mu[0] * t51;
    const double t61 = -mu[1];
    const double t62 = fma(t50, t61, t60);
    const double t63 = 2.0 * t56;
    const double t64 = 2.0 * t59;
    const double t65 = 2.0 * t62;
    const double t66 = t52 * t64;
    const double t67 = -t65;
    const double t68 = fma(t51, t67, t66);
    const double t69 = t50 * t65;
    const double t70 = -t63;
    const double t71 = fma(t52, t70, t69);
    const double t72 = t51 * t63;
    const double t73 = -t64;
    const double t74 = fma(t50, t73, t72);
    const double t75 = fma(t32, t63, mu[0]);
    const double t76 = fma(t32, t64, mu[1]);
    const double t77 = fma(t32, t65, mu[2]);
    const double t78 = t68 + t75;
    const double t79 = t71 + t76;
    const double t80 = t74 + t77;
    const double t81 = g[1] * t50;
    const double t82 = fma(g[2], t51, t81);
    const double t83 = fma(g[3], t52, t82);
    const double t84 = -t83;
    const double t85 = fma(g[0], t32, t84);
    const double t86 = g[2] * t52;
    const double t87 = -g[3];
    const double t88 = fma(t51, t87, t86);
    const double t89 = g[3] * t50;
    const double t90 = -g[1];
    const double t91 = fma(t52, t90, t89);
    const double t92 = g[1] * t51;
    const double t93 = -g[2];
    const double t94 = fma(t50, t93, t92);
    const double t95 = fma(g[0], t50, t88);
    const double t96 = fma(g[0], t51, t91);
    const double t97 = fma(g[0], t52, t94);
    const double t98 = fma(g[1], t32, t95);
    const double t99 = fma(g[2], t32, t96);
    const double t100 = fma(g[3], t32, t97);
    const double t101 = t85 * t85;
    const double t102 = fma(t98, t98, t101);
    const double t103 = fma(t99, t99, t102);
    const double t104 = fma(t100, t100, t103);
    const double t107 = fma(t104, (-0x1p-1), 0x1.8p+0);
    const double t108 = t85 * t107;
    const double t109 = t98 * t107;
    const double t110 = t99 * t107;
    const double t111 = t100 * t107;
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
    const double t8 = g[0] * g[0];
    const double t9 = fma(g[1], g[1], t8);
    const double t10 = fma(g[2], g[2], t9);
    const double t11 = fma(g[3], g[3], t10);
    const double t13 = t11 - 1.0;
    const double t14 = fabs(t13);
    const double t15 = mu[0] - mu[0];
    const double t16 = mu[1] - mu[1];
    const double t17 = t15 + t16;
    const double t18 = mu[2] - mu[2];
    const double t19 = t17 + t18;
    const double t20 = t14 + t19;
    const double t22 = sqrt(0x1p-52);
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
