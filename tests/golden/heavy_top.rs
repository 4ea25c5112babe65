// heavy_top: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `let [a, b, c, _, _, up] = mu; 0.5 * (a * a / inertia[0] + b * b / inertia[1] + c * c / inertia[2]) + m * g * l * up`
//
// Group: SE3. Chart exp, truncation K = 3, order of accuracy 4.
// Terms: S1: 4, S3: 15.
// Operations: gradient and Hessian 37 multiplications and 14 additions; predictor of degree 4 301 and 217.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `let [a, b, c, _, _, up] = mu; 0.5 * (a * a / inertia[0] + b * b / inertia[1] + c * c / inertia[2]) + m * g * l * up`
///
/// Group: SE3. Chart exp, truncation K = 3, order of accuracy 4.
/// Terms: S1: 4, S3: 15.
/// Operations: gradient and Hessian 37 multiplications and 14 additions; predictor of degree 4 301 and 217.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct HeavyTop<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 402],
    /// A bound on the part of the Hessian that Newton's method leaves out, by degree.
    defect: [T; 0],
}
#[allow(
    clippy::all,
    clippy::pedantic,
    clippy::nursery,
    dead_code,
    non_snake_case,
    unexpected_cfgs,
    unused_doc_comments,
    unused_imports,
    unused_variables
)]
const _: () = {
    use ::core::prelude::v1::*;
    type Vector<T> = ::coadjoint::nalgebra::SVector<T, 6>;
    type Matrix<T> = ::coadjoint::nalgebra::SMatrix<T, 6, 6>;
    impl<T: ::coadjoint::Scalar> HeavyTop<T> {
        /// K: the series S₁ … S_K of the generating function is kept.
        pub const TRUNCATION: usize = 3;
        /// The order of accuracy, K + 1.
        pub const ORDER: usize = 4;
        /// Folds all coefficients for the step size `step` (negative: backwards in time) and the
        /// parameters.
        ///
        /// # Errors
        /// `StepError::InvalidStep` for a step that is zero or not finite,
        /// `StepError::InvalidParameter` where a parameter expression is not finite.
        pub fn new(
            step: T,
            inertia: [T; 3],
            m: T,
            g: T,
            l: T,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(
                step,
                &[
                    (T::of(1.0) / inertia[0]),
                    (T::of(1.0) / inertia[1]),
                    (T::of(1.0) / inertia[2]),
                    ((m * g) * l),
                ],
            )?;
            ::core::result::Result::Ok(Self::fold(step, &parts, &|_| T::of(1.0)))
        }
        /// As `new`, with the tail of the series summed for motions that start with `momenta`
        /// (`coadjoint::Tail`): as fast, as geometric, of the same order, and more accurate.
        ///
        /// # Errors
        /// As `new`, and where a step from one of the momenta fails.
        pub fn tuned(
            step: T,
            inertia: [T; 3],
            m: T,
            g: T,
            l: T,
            momenta: impl ::core::iter::IntoIterator<
                Item = impl ::core::convert::Into<Vector<T>>,
            >,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(
                step,
                &[
                    (T::of(1.0) / inertia[0]),
                    (T::of(1.0) / inertia[1]),
                    (T::of(1.0) / inertia[2]),
                    ((m * g) * l),
                ],
            )?;
            let series = |factor: &dyn ::core::ops::Fn(usize) -> T| Self::fold(
                step,
                &parts,
                factor,
            );
            let momenta = ::core::iter::Iterator::map(
                ::core::iter::IntoIterator::into_iter(momenta),
                ::core::convert::Into::into,
            );
            let tail = ::coadjoint::Tail::along(Self::TRUNCATION, momenta, &series)?;
            ::core::result::Result::Ok(series(&|k| tail.factor(k)))
        }
        fn parts(
            step: T,
            symbols: &[T; 4],
        ) -> ::core::result::Result<[T; 238], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                5,
                62,
                238,
            >(
                Self::table(),
                &["1/inertia[0]", "1/inertia[1]", "1/inertia[2]", "m*g*l"],
                step,
                symbols,
            )
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 238],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                5,
                238,
                238,
                402,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 402]) -> Self {
            let defect = ::coadjoint::plumbing::bound::<T, 0>(&coefficients, &[]);
            Self { step, coefficients, defect }
        }
        /// The step size h.
        #[inline]
        pub fn step(&self) -> T {
            self.step
        }
        /// Advances (g, μ) by one step; on error `phase` is left as it was.
        ///
        /// # Errors
        /// `StepError`: no convergence, or a state that is not finite.
        #[inline]
        pub fn advance(
            &self,
            phase: &mut ::coadjoint::Phase<::coadjoint::SE3<T>>,
        ) -> ::core::result::Result<::coadjoint::StepReport<T>, ::coadjoint::StepError> {
            ::coadjoint::advance(self, phase)
        }
        /// Advances (g, μ) by `steps` steps, faster than one by one; the report is of the
        /// worst of them, and on error `phase` is left before the step that failed.
        ///
        /// # Errors
        /// As `advance`.
        pub fn advance_by(
            &self,
            phase: &mut ::coadjoint::Phase<::coadjoint::SE3<T>>,
            steps: u64,
        ) -> ::core::result::Result<::coadjoint::StepReport<T>, ::coadjoint::StepError> {
            ::coadjoint::advance_by(self, phase, steps)
        }
        /// The Poisson map μ ↦ μ″ of one step on 𝔤*.
        ///
        /// # Errors
        /// As `advance`.
        #[inline]
        pub fn poisson_map(
            &self,
            mu: &Vector<T>,
        ) -> ::core::result::Result<Vector<T>, ::coadjoint::StepError> {
            ::coadjoint::poisson_map(self, mu)
        }
        /// The reduced Hamiltonian H_red(μ), with the parameters given at construction.
        #[inline]
        pub fn energy(&self, mu: &Vector<T>) -> T {
            let input = mu;
            let c = &self.coefficients;
            let mu1 = input[0];
            let t1 = mu1 * mu1;
            let mu2 = input[1];
            let t2 = mu2 * mu2;
            let mu3 = input[2];
            let t3 = mu3 * mu3;
            let mu6 = input[5];
            let t4 = mu6 * c[398];
            let t5 = t3.times_plus(c[399], t4);
            let t6 = t2.times_plus(c[400], t5);
            // H_red(μ)
            let t7 = t1.times_plus(c[401], t6);
            t7
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for HeavyTop<T> {
        type Group = ::coadjoint::SE3<T>;
        type Chart = ::coadjoint::Exponential;
        #[inline(always)]
        fn group(&self) -> &::coadjoint::SE3<T> {
            const { &<::coadjoint::SE3<T>>::new() }
        }
        #[inline]
        fn value(&self, input: &Vector<T>) -> T {
            let c = &self.coefficients;
            let p3 = input[2];
            let p1 = input[0];
            let t1 = p1 * p1;
            let p2 = input[1];
            let t2 = p2 * p2;
            let t3 = t2.times_plus(c[394], c[392]);
            let t4 = t1.times_plus(c[396], t3);
            let p4 = input[3];
            let t5 = p4 * c[3];
            let p5 = input[4];
            let t6 = p2 * p5;
            let t7 = t6 * c[6];
            let t8 = p1.times_plus(t5, t7);
            let t9 = p3.times_plus(t4, t8);
            let t10 = t2.times_plus(c[397], c[395]);
            let t11 = p4 * p4;
            let t12 = p5 * p5;
            let p6 = input[5];
            let t13 = p6 * c[10];
            let t14 = t12.times_plus(c[390], t13);
            let t15 = t11.times_plus(c[391], t14);
            let t16 = t2.times_plus(c[393], t15);
            let t17 = t1.times_plus(t10, t16);
            // S(p)
            let t18 = p3.times_plus(t9, t17);
            t18
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p2 = input[1];
            let t1 = p2 * p2;
            let p3 = input[2];
            let t2 = p3 * p3;
            let t3 = t2.times_plus(c[1], c[0]);
            let t4 = t1.times_plus(c[2], t3);
            let p4 = input[3];
            let t5 = p3 * p4;
            let t6 = t5 * c[3];
            let p1 = input[0];
            // ∂(S₁ + S₃)/∂p₁
            let t7 = t4.times_plus(p1, t6);
            let t8 = p1 * p1;
            let t9 = t2.times_plus(c[5], c[4]);
            let t10 = c[2].times_plus(t8, t9);
            let p5 = input[4];
            let t11 = p3 * p5;
            let t12 = t11 * c[6];
            // ∂(S₁ + S₃)/∂p₂
            let t13 = p2.times_plus(t10, t12);
            let t14 = t1.times_plus(c[5], c[7]);
            let t15 = c[1].times_plus(t8, t14);
            let t16 = p4 * c[3];
            let t17 = p2 * p5;
            let t18 = c[6] * t17;
            let t19 = p1.times_plus(t16, t18);
            // ∂(S₁ + S₃)/∂p₃
            let t20 = p3.times_plus(t15, t19);
            let t21 = p3 * p1;
            let t22 = c[3] * t21;
            // ∂(S₁ + S₃)/∂p₄
            let t23 = p4.times_plus(c[8], t22);
            let t24 = p2 * p3;
            let t25 = c[6] * t24;
            // ∂(S₁ + S₃)/∂p₅
            let t26 = p5.times_plus(c[9], t25);
            <Vector<
                T,
            > as ::core::convert::From<_>>::from([t7, t13, t20, t23, t26, c[10]])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p2 = input[1];
            let t1 = p2 * p2;
            let p3 = input[2];
            let t2 = p3 * p3;
            let t3 = t2.times_plus(c[1], c[0]);
            // ∂²(S₁ + S₃)/∂p₁²
            let t4 = t1.times_plus(c[2], t3);
            let p4 = input[3];
            let t5 = p3 * p4;
            let t6 = t5 * c[3];
            let p1 = input[0];
            // ∂S/∂p₁
            let t7 = t4.times_plus(p1, t6);
            let t8 = p1 * p1;
            let t9 = t2.times_plus(c[5], c[4]);
            // ∂²(S₁ + S₃)/∂p₂²
            let t10 = c[2].times_plus(t8, t9);
            let p5 = input[4];
            let t11 = p3 * p5;
            let t12 = t11 * c[6];
            // ∂S/∂p₂
            let t13 = p2.times_plus(t10, t12);
            let t14 = t1.times_plus(c[5], c[7]);
            // ∂²(S₁ + S₃)/∂p₃²
            let t15 = c[1].times_plus(t8, t14);
            let t16 = p4 * c[3];
            let t17 = p2 * p5;
            let t18 = c[6] * t17;
            let t19 = p1.times_plus(t16, t18);
            // ∂S/∂p₃
            let t20 = p3.times_plus(t15, t19);
            let t21 = p3 * p1;
            let t22 = c[3] * t21;
            // ∂S/∂p₄
            let t23 = p4.times_plus(c[8], t22);
            let t24 = p2 * p3;
            let t25 = c[6] * t24;
            // ∂S/∂p₅
            let t26 = p5.times_plus(c[9], t25);
            let t27 = p2 * p1;
            // ∂²(S₁ + S₃)/∂p₁∂p₂
            let t28 = t27 * c[11];
            let t29 = p3 * c[12];
            // ∂²(S₁ + S₃)/∂p₁∂p₃
            let t30 = p1.times_plus(t29, t16);
            // ∂²(S₁ + S₃)/∂p₁∂p₄
            let t31 = p3 * c[3];
            let t32 = p3 * c[13];
            let t33 = p5 * c[6];
            // ∂²(S₁ + S₃)/∂p₂∂p₃
            let t34 = p2.times_plus(t32, t33);
            // ∂²(S₁ + S₃)/∂p₂∂p₅
            let t35 = p3 * c[6];
            // ∂²(S₁ + S₃)/∂p₃∂p₄
            let t36 = c[3] * p1;
            // ∂²(S₁ + S₃)/∂p₃∂p₅
            let t37 = p2 * c[6];
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t7, t13, t20, t23, t26, c[10]]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([
                [t4, t28, t30, t31, T::of(0.0), T::of(0.0)],
                [t28, t10, t34, T::of(0.0), t35, T::of(0.0)],
                [t30, t34, t15, t36, t37, T::of(0.0)],
                [t31, T::of(0.0), t36, c[8], T::of(0.0), T::of(0.0)],
                [T::of(0.0), t35, t37, T::of(0.0), c[9], T::of(0.0)],
                [T::of(0.0), T::of(0.0), T::of(0.0), T::of(0.0), T::of(0.0), T::of(0.0)],
            ]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let mu1 = input[0];
            let mu2 = input[1];
            let t1 = mu1 * mu1;
            let t2 = mu2 * mu2;
            let mu3 = input[2];
            let t3 = mu3 * mu3;
            let mu6 = input[5];
            let t4 = mu6.times_plus(c[191], c[190]);
            let t5 = t3.times_plus(c[192], t4);
            let t6 = t2.times_plus(c[193], t5);
            let t7 = t1.times_plus(c[199], t6);
            let mu5 = input[4];
            let t8 = mu5 * c[189];
            let t9 = mu1.times_plus(c[196], t8);
            let mu4 = input[3];
            let t10 = mu4 * c[188];
            let t11 = mu3.times_plus(t9, t10);
            let t12 = mu2.times_plus(t7, t11);
            let t13 = mu6.times_plus(c[186], c[185]);
            let t14 = t3.times_plus(c[187], t13);
            let t15 = t1.times_plus(c[198], t14);
            let t16 = mu1 * mu4;
            let t17 = t16 * c[195];
            let t18 = mu3.times_plus(t15, t17);
            let t19 = mu6.times_plus(c[182], c[181]);
            let t20 = t1.times_plus(c[197], t19);
            let t21 = mu5 * c[183];
            let t22 = mu1.times_plus(c[194], t21);
            let t23 = mu4 * mu4;
            let t24 = t23.times_plus(c[184], c[180]);
            let t25 = mu5.times_plus(t22, t24);
            let t26 = mu6.times_plus(t20, t25);
            let t27 = mu3.times_plus(t18, t26);
            let t28 = mu2.times_plus(t12, t27);
            let t29 = mu4 * c[178];
            let t30 = mu2.times_plus(c[179], t29);
            let t31 = mu6.times_plus(c[175], c[174]);
            let t32 = t3.times_plus(c[176], t31);
            let t33 = mu2.times_plus(t30, t32);
            let t34 = mu6.times_plus(c[170], c[169]);
            let t35 = t3.times_plus(c[172], t34);
            let t36 = mu3 * mu5;
            let t37 = t36 * c[171];
            let t38 = mu4.times_plus(t35, t37);
            let t39 = mu2.times_plus(t33, t38);
            let t40 = mu4 * c[173];
            let t41 = mu2.times_plus(c[177], t40);
            let t42 = mu6.times_plus(c[168], c[167]);
            let t43 = mu2.times_plus(t41, t42);
            let t44 = mu5 * t43;
            let t45 = mu3.times_plus(t39, t44);
            // p₁, the first guess
            let t46 = mu1.times_plus(t28, t45);
            let t47 = mu6.times_plus(c[228], c[227]);
            let t48 = t3.times_plus(c[229], t47);
            let t49 = t2.times_plus(c[230], t48);
            let t50 = t1.times_plus(c[232], t49);
            let t51 = mu4 * c[223];
            let t52 = mu2.times_plus(c[224], t51);
            let t53 = mu5 * c[222];
            let t54 = mu3.times_plus(t52, t53);
            let t55 = mu1.times_plus(t50, t54);
            let t56 = mu6.times_plus(c[212], c[211]);
            let t57 = t3.times_plus(c[213], t56);
            let t58 = t2.times_plus(c[217], t57);
            let t59 = mu2 * mu5;
            let t60 = t59 * c[215];
            let t61 = mu3.times_plus(t58, t60);
            let t62 = mu6.times_plus(c[208], c[207]);
            let t63 = t2.times_plus(c[216], t62);
            let t64 = mu4 * c[210];
            let t65 = mu2.times_plus(c[214], t64);
            let t66 = mu5 * mu5;
            let t67 = t66.times_plus(c[209], c[206]);
            let t68 = mu4.times_plus(t65, t67);
            let t69 = mu6.times_plus(t63, t68);
            let t70 = mu3.times_plus(t61, t69);
            let t71 = mu1.times_plus(t55, t70);
            let t72 = mu5 * c[226];
            let t73 = mu1.times_plus(c[231], t72);
            let t74 = mu6.times_plus(c[220], c[219]);
            let t75 = t3.times_plus(c[221], t74);
            let t76 = mu1.times_plus(t73, t75);
            let t77 = mu6.times_plus(c[203], c[202]);
            let t78 = t3.times_plus(c[205], t77);
            let t79 = mu3 * mu4;
            let t80 = t79 * c[204];
            let t81 = mu5.times_plus(t78, t80);
            let t82 = mu1.times_plus(t76, t81);
            let t83 = mu5 * c[218];
            let t84 = mu1.times_plus(c[225], t83);
            let t85 = mu6.times_plus(c[201], c[200]);
            let t86 = mu1.times_plus(t84, t85);
            let t87 = mu4 * t86;
            let t88 = mu3.times_plus(t82, t87);
            // p₂, the first guess
            let t89 = mu2.times_plus(t71, t88);
            let t90 = mu6.times_plus(c[256], c[255]);
            let t91 = t3.times_plus(c[257], t90);
            let t92 = t2.times_plus(c[259], t91);
            let t93 = t1.times_plus(c[262], t92);
            let t94 = mu4 * c[260];
            let t95 = mu2.times_plus(c[261], t94);
            let t96 = t59 * c[258];
            let t97 = mu1.times_plus(t95, t96);
            let t98 = mu3.times_plus(t93, t97);
            let t99 = mu4 * c[253];
            let t100 = mu2.times_plus(c[254], t99);
            let t101 = mu6.times_plus(c[251], c[250]);
            let t102 = t3.times_plus(c[252], t101);
            let t103 = mu2.times_plus(t100, t102);
            let t104 = mu6.times_plus(c[247], c[246]);
            let t105 = t3.times_plus(c[249], t104);
            let t106 = t36 * c[248];
            let t107 = mu4.times_plus(t105, t106);
            let t108 = mu2.times_plus(t103, t107);
            let t109 = mu1.times_plus(t98, t108);
            let t110 = mu6.times_plus(c[242], c[241]);
            let t111 = t3.times_plus(c[243], t110);
            let t112 = t2.times_plus(c[245], t111);
            let t113 = mu5 * c[240];
            let t114 = mu4 * c[239];
            let t115 = mu3.times_plus(t113, t114);
            let t116 = mu2.times_plus(t112, t115);
            let t117 = mu6.times_plus(c[238], c[237]);
            let t118 = t2.times_plus(c[244], t117);
            let t119 = mu5 * t118;
            let t120 = mu3.times_plus(t116, t119);
            let t121 = t66.times_plus(c[235], c[234]);
            let t122 = t23.times_plus(c[236], t121);
            let t123 = mu5 * mu4;
            let t124 = t123 * c[233];
            let t125 = mu3.times_plus(t122, t124);
            let t126 = mu2.times_plus(t120, t125);
            // p₃, the first guess
            let t127 = mu1.times_plus(t109, t126);
            let t128 = mu6.times_plus(c[293], c[292]);
            let t129 = t3.times_plus(c[295], t128);
            let t130 = t2.times_plus(c[297], t129);
            let t131 = t1.times_plus(c[304], t130);
            let t132 = mu4 * c[302];
            let t133 = mu6 * c[301];
            let t134 = mu2.times_plus(t132, t133);
            let t135 = mu6 * c[296];
            let t136 = mu4 * c[294];
            let t137 = mu2.times_plus(t135, t136);
            let t138 = mu3 * t137;
            let t139 = mu1.times_plus(t134, t138);
            let t140 = mu5.times_plus(t131, t139);
            let t141 = mu6.times_plus(c[281], c[280]);
            let t142 = t3.times_plus(c[283], t141);
            let t143 = t2.times_plus(c[285], t142);
            let t144 = mu6 * c[284];
            let t145 = t36 * c[282];
            let t146 = mu2.times_plus(t144, t145);
            let t147 = mu4.times_plus(t143, t146);
            let t148 = mu6.times_plus(c[275], c[274]);
            let t149 = t3.times_plus(c[279], t148);
            let t150 = mu5 * c[278];
            let t151 = mu4 * c[277];
            let t152 = mu3.times_plus(t150, t151);
            let t153 = t66 * c[276];
            let t154 = mu4.times_plus(t152, t153);
            let t155 = mu6.times_plus(t149, t154);
            let t156 = mu2.times_plus(t147, t155);
            let t157 = mu1.times_plus(t140, t156);
            let t158 = mu6.times_plus(c[288], c[287]);
            let t159 = t3.times_plus(c[291], t158);
            let t160 = t1.times_plus(c[303], t159);
            let t161 = mu4 * c[300];
            let t162 = mu5 * c[299];
            let t163 = mu3.times_plus(t161, t162);
            let t164 = t66 * c[289];
            let t165 = t23.times_plus(c[290], t164);
            let t166 = mu1.times_plus(t163, t165);
            let t167 = mu6.times_plus(t160, t166);
            let t168 = mu6.times_plus(c[271], c[270]);
            let t169 = t3.times_plus(c[273], t168);
            let t170 = t36 * c[272];
            let t171 = mu4.times_plus(t169, t170);
            let t172 = mu6.times_plus(c[269], c[268]);
            let t173 = mu5 * t172;
            let t174 = mu3.times_plus(t171, t173);
            let t175 = mu1.times_plus(t167, t174);
            let t176 = mu6.times_plus(c[265], c[264]);
            let t177 = t1.times_plus(c[298], t176);
            let t178 = mu5 * c[266];
            let t179 = mu1.times_plus(c[286], t178);
            let t180 = t23.times_plus(c[267], c[263]);
            let t181 = mu5.times_plus(t179, t180);
            let t182 = mu6.times_plus(t177, t181);
            let t183 = mu4 * t182;
            let t184 = mu3.times_plus(t175, t183);
            // p₄, the first guess
            let t185 = mu2.times_plus(t157, t184);
            let t186 = mu6.times_plus(c[339], c[338]);
            let t187 = t3.times_plus(c[341], t186);
            let t188 = t2.times_plus(c[343], t187);
            let t189 = t1.times_plus(c[346], t188);
            let t190 = mu4 * c[345];
            let t191 = mu6 * c[344];
            let t192 = mu2.times_plus(t190, t191);
            let t193 = mu6 * c[342];
            let t194 = mu4 * c[340];
            let t195 = mu2.times_plus(t193, t194);
            let t196 = mu3 * t195;
            let t197 = mu1.times_plus(t192, t196);
            let t198 = mu5.times_plus(t189, t197);
            let t199 = mu6.times_plus(c[333], c[332]);
            let t200 = t3.times_plus(c[335], t199);
            let t201 = t2.times_plus(c[337], t200);
            let t202 = mu6 * c[336];
            let t203 = t36 * c[334];
            let t204 = mu2.times_plus(t202, t203);
            let t205 = mu4.times_plus(t201, t204);
            let t206 = mu6.times_plus(c[327], c[326]);
            let t207 = t3.times_plus(c[331], t206);
            let t208 = mu5 * c[330];
            let t209 = mu4 * c[329];
            let t210 = mu3.times_plus(t208, t209);
            let t211 = t66 * c[328];
            let t212 = mu4.times_plus(t210, t211);
            let t213 = mu6.times_plus(t207, t212);
            let t214 = mu2.times_plus(t205, t213);
            let t215 = mu1.times_plus(t198, t214);
            let t216 = mu6.times_plus(c[318], c[317]);
            let t217 = t3.times_plus(c[321], t216);
            let t218 = t2.times_plus(c[325], t217);
            let t219 = mu5 * c[324];
            let t220 = mu4 * c[323];
            let t221 = mu3.times_plus(t219, t220);
            let t222 = t66 * c[319];
            let t223 = t23.times_plus(c[320], t222);
            let t224 = mu2.times_plus(t221, t223);
            let t225 = mu6.times_plus(t218, t224);
            let t226 = mu6.times_plus(c[313], c[312]);
            let t227 = t3.times_plus(c[315], t226);
            let t228 = t79 * c[314];
            let t229 = mu5.times_plus(t227, t228);
            let t230 = mu6.times_plus(c[311], c[310]);
            let t231 = mu4 * t230;
            let t232 = mu3.times_plus(t229, t231);
            let t233 = mu2.times_plus(t225, t232);
            let t234 = mu6.times_plus(c[307], c[306]);
            let t235 = t2.times_plus(c[322], t234);
            let t236 = mu4 * c[309];
            let t237 = mu2.times_plus(c[316], t236);
            let t238 = t66.times_plus(c[308], c[305]);
            let t239 = mu4.times_plus(t237, t238);
            let t240 = mu6.times_plus(t235, t239);
            let t241 = mu5 * t240;
            let t242 = mu3.times_plus(t233, t241);
            // p₅, the first guess
            let t243 = mu1.times_plus(t215, t242);
            let t244 = mu6.times_plus(c[380], c[379]);
            let t245 = t3.times_plus(c[383], t244);
            let t246 = t2.times_plus(c[386], t245);
            let t247 = t1.times_plus(c[389], t246);
            let t248 = mu3 * c[388];
            let t249 = mu4 * c[382];
            let t250 = mu2.times_plus(c[384], t249);
            let t251 = mu1.times_plus(t248, t250);
            let t252 = mu3 * c[385];
            let t253 = mu5 * c[381];
            let t254 = mu2.times_plus(t252, t253);
            let t255 = mu1.times_plus(c[387], t254);
            let t256 = mu5 * t255;
            let t257 = mu4.times_plus(t251, t256);
            let t258 = mu6.times_plus(t247, t257);
            let t259 = mu6.times_plus(c[372], c[371]);
            let t260 = t3.times_plus(c[374], t259);
            let t261 = t2.times_plus(c[378], t260);
            let t262 = mu6 * c[376];
            let t263 = t36 * c[373];
            let t264 = mu2.times_plus(t262, t263);
            let t265 = mu4.times_plus(t261, t264);
            let t266 = mu4 * c[375];
            let t267 = mu2.times_plus(c[377], t266);
            let t268 = mu6.times_plus(c[370], c[369]);
            let t269 = mu2.times_plus(t267, t268);
            let t270 = mu5 * t269;
            let t271 = mu3.times_plus(t265, t270);
            let t272 = mu1.times_plus(t258, t271);
            let t273 = mu6.times_plus(c[362], c[361]);
            let t274 = t3.times_plus(c[365], t273);
            let t275 = t2.times_plus(c[368], t274);
            let t276 = mu5 * c[367];
            let t277 = mu4 * c[366];
            let t278 = mu3.times_plus(t276, t277);
            let t279 = t66 * c[363];
            let t280 = t23.times_plus(c[364], t279);
            let t281 = mu2.times_plus(t278, t280);
            let t282 = mu6.times_plus(t275, t281);
            let t283 = mu6.times_plus(c[358], c[357]);
            let t284 = t3.times_plus(c[360], t283);
            let t285 = t79 * c[359];
            let t286 = mu5.times_plus(t284, t285);
            let t287 = mu6.times_plus(c[356], c[355]);
            let t288 = mu4 * t287;
            let t289 = mu3.times_plus(t286, t288);
            let t290 = mu2.times_plus(t282, t289);
            let t291 = mu6.times_plus(c[351], c[350]);
            let t292 = t3.times_plus(c[354], t291);
            let t293 = t36 * c[352];
            let t294 = mu4.times_plus(t292, t293);
            let t295 = mu6.times_plus(c[349], c[348]);
            let t296 = t3.times_plus(c[353], t295);
            let t297 = mu6 * c[347];
            let t298 = t66.times_plus(t296, t297);
            let t299 = mu4.times_plus(t294, t298);
            let t300 = mu2.times_plus(t290, t299);
            // p₆, the first guess
            let t301 = mu1.times_plus(t272, t300);
            <Vector<
                T,
            > as ::core::convert::From<_>>::from([t46, t89, t127, t185, t243, t301])
        }
        #[inline(always)]
        fn predict_after(&self, last: &Vector<T>, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let twice_even = {
                let mu1 = input[0];
                let mu3 = input[2];
                let t1 = mu1 * mu1;
                let mu2 = input[1];
                let t2 = mu2 * mu2;
                let t3 = mu3 * mu3;
                let mu6 = input[5];
                let t4 = mu6.times_plus(c[25], c[24]);
                let t5 = t3.times_plus(c[26], t4);
                let t6 = t2.times_plus(c[30], t5);
                let t7 = t1.times_plus(c[34], t6);
                let mu4 = input[3];
                let t8 = mu4 * c[32];
                let mu5 = input[4];
                let t9 = mu2 * mu5;
                let t10 = t9 * c[27];
                let t11 = mu1.times_plus(t8, t10);
                let t12 = mu3.times_plus(t7, t11);
                let t13 = mu6.times_plus(c[29], c[28]);
                let t14 = t2.times_plus(c[31], t13);
                let t15 = t1.times_plus(c[35], t14);
                let t16 = mu6.times_plus(c[21], c[20]);
                let t17 = t1.times_plus(c[33], t16);
                let t18 = mu4 * mu4;
                let t19 = mu5 * mu5;
                let t20 = t19.times_plus(c[22], c[19]);
                let t21 = t18.times_plus(c[23], t20);
                let t22 = mu6.times_plus(t17, t21);
                let t23 = t2.times_plus(t15, t22);
                let t24 = mu3.times_plus(t12, t23);
                let t25 = mu6.times_plus(c[15], c[14]);
                let t26 = t3.times_plus(c[16], t25);
                let t27 = t2.times_plus(c[18], t26);
                let t28 = t9 * c[17];
                let t29 = mu3.times_plus(t27, t28);
                let t30 = mu4 * t29;
                // twice the part of p₁ that is even in h
                let t31 = mu1.times_plus(t24, t30);
                let t32 = mu6.times_plus(c[45], c[44]);
                let t33 = t3.times_plus(c[46], t32);
                let t34 = t2.times_plus(c[49], t33);
                let t35 = t1.times_plus(c[55], t34);
                let t36 = mu4 * c[51];
                let t37 = t9 * c[47];
                let t38 = mu1.times_plus(t36, t37);
                let t39 = mu3.times_plus(t35, t38);
                let t40 = mu6.times_plus(c[54], c[53]);
                let t41 = t2.times_plus(c[56], t40);
                let t42 = t1.times_plus(c[57], t41);
                let t43 = mu6.times_plus(c[41], c[40]);
                let t44 = t2.times_plus(c[48], t43);
                let t45 = t19.times_plus(c[42], c[39]);
                let t46 = t18.times_plus(c[43], t45);
                let t47 = mu6.times_plus(t44, t46);
                let t48 = t1.times_plus(t42, t47);
                let t49 = mu3.times_plus(t39, t48);
                let t50 = mu6.times_plus(c[37], c[36]);
                let t51 = t3.times_plus(c[38], t50);
                let t52 = t1.times_plus(c[52], t51);
                let t53 = mu1 * mu4;
                let t54 = t53 * c[50];
                let t55 = mu3.times_plus(t52, t54);
                let t56 = mu5 * t55;
                // twice the part of p₂ that is even in h
                let t57 = mu2.times_plus(t49, t56);
                let t58 = t3.times_plus(c[75], c[73]);
                let t59 = t2.times_plus(c[77], t58);
                let t60 = t1.times_plus(c[79], t59);
                let t61 = t3.times_plus(c[66], c[64]);
                let t62 = t2.times_plus(c[68], t61);
                let t63 = t19.times_plus(c[59], c[58]);
                let t64 = t18.times_plus(c[60], t63);
                let t65 = t2.times_plus(t62, t64);
                let t66 = t1.times_plus(t60, t65);
                let t67 = mu3 * t66;
                let t68 = t3.times_plus(c[63], c[61]);
                let t69 = t2.times_plus(c[67], t68);
                let t70 = t1.times_plus(c[76], t69);
                let t71 = t9.times_plus(t70, t67);
                let t72 = mu6 * t9;
                let t73 = c[62].times_plus(t72, t71);
                let t74 = t2 * c[65];
                let t75 = t1.times_plus(c[74], t74);
                let t76 = mu3 * mu6;
                let t77 = t75.times_plus(t76, t73);
                let t78 = t3.times_plus(c[71], c[69]);
                let t79 = t2.times_plus(c[72], t78);
                let t80 = t1.times_plus(c[78], t79);
                let t81 = t53.times_plus(t80, t77);
                let t82 = mu6 * t53;
                // twice the part of p₃ that is even in h
                let t83 = c[70].times_plus(t82, t81);
                let t84 = mu6.times_plus(c[86], c[85]);
                let t85 = t3.times_plus(c[87], t84);
                let t86 = t2.times_plus(c[91], t85);
                let t87 = t1.times_plus(c[104], t86);
                let t88 = mu4 * c[96];
                let t89 = t9 * c[88];
                let t90 = mu1.times_plus(t88, t89);
                let t91 = mu3.times_plus(t87, t90);
                let t92 = mu6.times_plus(c[90], c[89]);
                let t93 = t2.times_plus(c[92], t92);
                let t94 = t1.times_plus(c[105], t93);
                let t95 = mu6.times_plus(c[82], c[81]);
                let t96 = t1.times_plus(c[103], t95);
                let t97 = t19.times_plus(c[83], c[80]);
                let t98 = t18.times_plus(c[84], t97);
                let t99 = mu6.times_plus(t96, t98);
                let t100 = t2.times_plus(t94, t99);
                let t101 = mu3.times_plus(t91, t100);
                let t102 = mu6.times_plus(c[94], c[93]);
                let t103 = t3.times_plus(c[97], t102);
                let t104 = t2.times_plus(c[101], t103);
                let t105 = t1.times_plus(c[106], t104);
                let t106 = mu3 * c[100];
                let t107 = mu5 * c[95];
                let t108 = mu2.times_plus(t106, t107);
                let t109 = mu5 * t108;
                let t110 = mu6.times_plus(t105, t109);
                let t111 = mu6.times_plus(c[99], c[98]);
                let t112 = t2.times_plus(c[102], t111);
                let t113 = t1.times_plus(c[107], t112);
                let t114 = t9 * t113;
                let t115 = mu3.times_plus(t110, t114);
                let t116 = mu1 * t115;
                // twice the part of p₄ that is even in h
                let t117 = mu4.times_plus(t101, t116);
                let t118 = mu6.times_plus(c[114], c[113]);
                let t119 = t3.times_plus(c[115], t118);
                let t120 = t2.times_plus(c[122], t119);
                let t121 = t1.times_plus(c[131], t120);
                let t122 = mu4 * c[124];
                let t123 = t9 * c[118];
                let t124 = mu1.times_plus(t122, t123);
                let t125 = mu3.times_plus(t121, t124);
                let t126 = mu6.times_plus(c[130], c[129]);
                let t127 = t2.times_plus(c[133], t126);
                let t128 = t1.times_plus(c[135], t127);
                let t129 = mu6.times_plus(c[110], c[109]);
                let t130 = t2.times_plus(c[121], t129);
                let t131 = t19.times_plus(c[111], c[108]);
                let t132 = t18.times_plus(c[112], t131);
                let t133 = mu6.times_plus(t130, t132);
                let t134 = t1.times_plus(t128, t133);
                let t135 = mu3.times_plus(t125, t134);
                let t136 = mu6.times_plus(c[117], c[116]);
                let t137 = t3.times_plus(c[120], t136);
                let t138 = t2.times_plus(c[123], t137);
                let t139 = t1.times_plus(c[132], t138);
                let t140 = mu3 * c[127];
                let t141 = mu4 * c[119];
                let t142 = mu1.times_plus(t140, t141);
                let t143 = mu4 * t142;
                let t144 = mu6.times_plus(t139, t143);
                let t145 = mu6.times_plus(c[126], c[125]);
                let t146 = t2.times_plus(c[128], t145);
                let t147 = t1.times_plus(c[134], t146);
                let t148 = t53 * t147;
                let t149 = mu3.times_plus(t144, t148);
                let t150 = mu2 * t149;
                // twice the part of p₅ that is even in h
                let t151 = mu5.times_plus(t135, t150);
                let t152 = mu6.times_plus(c[159], c[158]);
                let t153 = t3.times_plus(c[162], t152);
                let t154 = t2.times_plus(c[164], t153);
                let t155 = t1.times_plus(c[166], t154);
                let t156 = mu4 * c[165];
                let t157 = t9 * c[163];
                let t158 = mu1.times_plus(t156, t157);
                let t159 = t19 * c[160];
                let t160 = t18.times_plus(c[161], t159);
                let t161 = mu3.times_plus(t158, t160);
                let t162 = mu6.times_plus(t155, t161);
                let t163 = mu6.times_plus(c[154], c[153]);
                let t164 = t3.times_plus(c[155], t163);
                let t165 = t2.times_plus(c[157], t164);
                let t166 = t9 * c[156];
                let t167 = mu3.times_plus(t165, t166);
                let t168 = mu4 * t167;
                let t169 = mu1.times_plus(t162, t168);
                let t170 = mu6.times_plus(c[147], c[146]);
                let t171 = t3.times_plus(c[150], t170);
                let t172 = t2.times_plus(c[152], t171);
                let t173 = mu3 * c[151];
                let t174 = mu5 * c[148];
                let t175 = mu2.times_plus(t173, t174);
                let t176 = t18 * c[149];
                let t177 = mu5.times_plus(t175, t176);
                let t178 = mu6.times_plus(t172, t177);
                let t179 = mu3 * mu5;
                let t180 = mu6.times_plus(c[144], c[143]);
                let t181 = t3.times_plus(c[145], t180);
                let t182 = t179 * t181;
                let t183 = mu2.times_plus(t178, t182);
                let t184 = mu6.times_plus(c[140], c[139]);
                let t185 = t3.times_plus(c[142], t184);
                let t186 = mu6.times_plus(c[138], c[137]);
                let t187 = t3.times_plus(c[141], t186);
                let t188 = mu6 * c[136];
                let t189 = t19.times_plus(t187, t188);
                let t190 = t18.times_plus(t185, t189);
                let t191 = mu2.times_plus(t183, t190);
                // twice the part of p₆ that is even in h
                let t192 = mu1.times_plus(t169, t191);
                <Vector<
                    T,
                > as ::core::convert::From<_>>::from([t31, t57, t83, t117, t151, t192])
            };
            twice_even - last
        }
        #[inline(always)]
        fn bend(&self, x: T) -> T {
            x * x * T::of(0.25)
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for HeavyTop<T> {
        fn truncation(&self) -> usize {
            Self::TRUNCATION
        }
        fn terms(&self) -> usize {
            ::coadjoint::plumbing::terms(Self::table())
        }
        fn term(&self, number: usize) -> ::coadjoint::Term<'_> {
            ::coadjoint::plumbing::term(Self::table(), number)
        }
        fn adjusted(&self, corrections: &[T]) -> Self {
            let mut coefficients = self.coefficients;
            ::coadjoint::plumbing::adjust(Self::table(), &mut coefficients, corrections);
            Self::with(self.step, coefficients)
        }
    }
    impl ::coadjoint::Lanes for HeavyTop<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = HeavyTop<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> HeavyTop<L> {
            HeavyTop {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> HeavyTop<T> {
        fn table() -> &'static ::coadjoint::plumbing::Table {
            &TABLE
        }
    }
    /// All coefficients as data. A base is Σ h^power Σ factor · product, a slot `c[i]` a base
    /// times an integer.
    static TABLE: ::coadjoint::plumbing::Table = ::coadjoint::plumbing::Table {
        /// Products of symbols: an earlier one times a symbol; number 0 is 1.
        products: &[
            (0, 3), (0, 0), (2, 3), (3, 3), (0, 1), (5, 3), (6, 3), (0, 2), (2, 1), (9, 3), (2, 2),
            (11, 3), (9, 1), (9, 2), (11, 2), (5, 2), (16, 3), (2, 0), (18, 1), (16, 2), (18, 2),
            (5, 1), (22, 2), (8, 3), (10, 3), (12, 3), (22, 3), (27, 3), (17, 3), (8, 2), (30, 3),
            (13, 3), (14, 3), (15, 3), (23, 3), (20, 3), (30, 2), (37, 3), (22, 1), (39, 3),
            (18, 3), (41, 3), (19, 3), (21, 3), (19, 1), (19, 2), (21, 2), (13, 2), (14, 2),
            (15, 2), (23, 2), (20, 2), (37, 2), (13, 1), (39, 2), (39, 1), (18, 0), (57, 3),
            (57, 1), (57, 2), (57, 0),
        ],
        /// Factor, and the number of its product.
        terms: &[
            (1.0, 1), (0.041666666666666664, 4), (0.041666666666666664, 7), (0.5, 8),
            (-0.08333333333333333, 10), (0.08333333333333333, 12), (0.5, 5),
            (0.041666666666666664, 13), (-0.08333333333333333, 14), (0.041666666666666664, 15),
            (-0.08333333333333333, 10), (0.08333333333333333, 17), (0.5, 2),
            (0.041666666666666664, 19), (-0.08333333333333333, 14), (0.041666666666666664, 20),
            (0.041666666666666664, 21), (-0.08333333333333333, 14), (0.041666666666666664, 23),
            (1.0, 1), (0.5, 8), (0.5, 5), (0.5, 2), (0.5, 1), (0.041666666666666664, 4), (0.25, 6),
            (-0.3333333333333333, 24), (0.006944444444444444, 25), (-0.013888888888888888, 26),
            (0.020833333333333332, 28), (-0.013888888888888888, 29), (-0.08333333333333333, 10),
            (0.041666666666666664, 12), (0.16666666666666666, 17), (-0.125, 31),
            (-0.020833333333333332, 32), (0.04861111111111111, 33), (-0.013888888888888888, 34),
            (0.020833333333333332, 35), (-0.06944444444444445, 36), (0.03333333333333333, 38),
            (-0.041666666666666664, 25), (0.09722222222222222, 26), (0.05555555555555555, 28),
            (-0.09722222222222222, 29), (-0.5, 5), (0.5, 8), (-0.041666666666666664, 10),
            (0.041666666666666664, 12), (-0.08333333333333333, 27), (0.08333333333333333, 17),
            (0.08333333333333333, 13), (-0.125, 14), (0.041666666666666664, 15),
            (-0.08333333333333333, 23), (0.125, 20), (-0.041666666666666664, 37),
            (0.041666666666666664, 10), (-0.08333333333333333, 12), (-0.041666666666666664, 27),
            (0.08333333333333333, 17), (0.04861111111111111, 32), (-0.1736111111111111, 33),
            (0.1388888888888889, 34), (-0.08333333333333333, 40), (0.20694444444444443, 35),
            (-0.1388888888888889, 36), (-0.041666666666666664, 13), (0.125, 14),
            (-0.08333333333333333, 15), (0.041666666666666664, 39), (-0.125, 23),
            (0.08333333333333333, 20), (1.0, 0), (0.16666666666666666, 3),
            (0.006944444444444444, 42), (-0.027777777777777776, 42), (0.027777777777777776, 25),
            (-0.05555555555555555, 26), (-0.041666666666666664, 28), (0.05555555555555555, 29),
            (-0.25, 9), (0.16666666666666666, 11), (0.25, 16), (-0.16666666666666666, 30),
            (-0.027777777777777776, 43), (0.013888888888888888, 44), (-0.020833333333333332, 32),
            (0.0625, 33), (-0.03194444444444444, 34), (0.020833333333333332, 35),
            (-0.013888888888888888, 36), (0.020833333333333332, 45), (-0.027777777777777776, 46),
            (0.006944444444444444, 47), (-0.041666666666666664, 48), (0.05555555555555555, 49),
            (-0.015277777777777777, 50), (0.020833333333333332, 51), (-0.027777777777777776, 52),
            (0.008333333333333333, 53), (-0.125, 10), (0.25, 12), (0.16666666666666666, 27),
            (-0.25, 17), (0.20833333333333334, 43), (-0.20833333333333334, 44),
            (-0.1527777777777778, 32), (-0.08611111111111111, 33), (0.2638888888888889, 34),
            (0.25, 35), (-0.2638888888888889, 36), (0.16666666666666666, 9), (-0.25, 11),
            (-0.16666666666666666, 22), (0.25, 16), (0.013888888888888888, 43),
            (-0.027777777777777776, 44), (0.03333333333333333, 32), (-0.04861111111111111, 33),
            (-0.05555555555555555, 40), (0.0763888888888889, 35), (-0.20833333333333334, 45),
            (0.4166666666666667, 46), (-0.20833333333333334, 47), (0.2013888888888889, 54),
            (-0.20277777777777778, 48), (-0.20277777777777778, 49), (0.2013888888888889, 50),
            (-0.2013888888888889, 55), (0.40555555555555556, 51), (-0.2013888888888889, 52),
            (0.006944444444444444, 45), (-0.027777777777777776, 46), (0.020833333333333332, 47),
            (-0.015277777777777777, 54), (0.05555555555555555, 48), (-0.041666666666666664, 49),
            (0.008333333333333333, 56), (-0.027777777777777776, 55), (0.020833333333333332, 51),
            (-0.041666666666666664, 41), (-0.08333333333333333, 43), (0.12083333333333333, 44),
            (0.10416666666666667, 32), (-0.027777777777777776, 33), (-0.1111111111111111, 34),
            (-0.10416666666666667, 35), (0.1111111111111111, 36), (0.25, 19), (-0.25, 21),
            (-0.25, 13), (0.25, 15), (0.25, 23), (-0.25, 20), (-0.008333333333333333, 58),
            (0.05555555555555555, 59), (-0.05694444444444444, 60), (-0.0625, 45),
            (-0.05555555555555555, 46), (0.1125, 47), (0.125, 48), (-0.05555555555555555, 49),
            (-0.05555555555555555, 50), (-0.0625, 51), (0.05555555555555555, 52),
            (-0.05694444444444444, 59), (0.05555555555555555, 60), (0.1125, 45),
            (-0.05555555555555555, 46), (-0.0625, 47), (-0.05555555555555555, 54),
            (-0.05555555555555555, 48), (0.125, 49), (0.05555555555555555, 55), (-0.0625, 51),
            (-0.5, 1), (-0.041666666666666664, 7), (0.25, 3), (-0.3333333333333333, 24),
            (0.020833333333333332, 42), (0.006944444444444444, 25), (-0.013888888888888888, 26),
            (-0.013888888888888888, 29), (0.08333333333333333, 10), (-0.16666666666666666, 12),
            (-0.041666666666666664, 17), (0.125, 31), (-0.020833333333333332, 43),
            (0.020833333333333332, 44), (0.04861111111111111, 33), (-0.06944444444444445, 34),
            (-0.013888888888888888, 36), (0.03333333333333333, 38), (1.0, 0),
            (0.16666666666666666, 6), (0.006944444444444444, 28), (-0.041666666666666664, 42),
            (0.027777777777777776, 25), (0.05555555555555555, 26), (-0.05555555555555555, 29),
            (-0.027777777777777776, 28), (-0.25, 9), (0.25, 11), (0.16666666666666666, 16),
            (-0.16666666666666666, 30), (-0.020833333333333332, 43), (0.020833333333333332, 44),
            (-0.027777777777777776, 32), (0.0625, 33), (-0.013888888888888888, 34),
            (0.013888888888888888, 35), (-0.03194444444444444, 36), (0.020833333333333332, 45),
            (-0.041666666666666664, 46), (0.020833333333333332, 47), (-0.027777777777777776, 48),
            (0.05555555555555555, 49), (-0.027777777777777776, 50), (0.006944444444444444, 51),
            (-0.015277777777777777, 52), (0.008333333333333333, 53), (0.041666666666666664, 27),
            (0.10416666666666667, 43), (-0.10416666666666667, 44), (-0.08333333333333333, 32),
            (-0.027777777777777776, 33), (0.1111111111111111, 34), (0.12083333333333333, 35),
            (-0.1111111111111111, 36), (-0.008333333333333333, 40), (-0.0625, 45), (0.125, 46),
            (-0.0625, 47), (0.05555555555555555, 54), (-0.05555555555555555, 48),
            (-0.05555555555555555, 49), (0.05555555555555555, 50), (-0.05694444444444444, 55),
            (0.1125, 51), (-0.05555555555555555, 52), (0.05555555555555555, 42),
            (-0.041666666666666664, 25), (-0.09722222222222222, 26), (0.09722222222222222, 29),
            (0.5, 2), (-0.5, 8), (0.08333333333333333, 41), (0.041666666666666664, 10),
            (-0.08333333333333333, 12), (-0.041666666666666664, 17), (-0.08333333333333333, 19),
            (0.08333333333333333, 21), (0.125, 14), (-0.125, 15), (-0.041666666666666664, 20),
            (0.041666666666666664, 37), (-0.16666666666666666, 41), (0.125, 10), (0.25, 12),
            (-0.25, 17), (-0.1527777777777778, 43), (0.25, 44), (0.20833333333333334, 32),
            (-0.08611111111111111, 33), (-0.2638888888888889, 34), (-0.20833333333333334, 35),
            (0.2638888888888889, 36), (0.25, 19), (-0.25, 21), (-0.25, 13), (0.25, 15), (0.25, 23),
            (-0.25, 20), (0.041666666666666664, 41), (-0.041666666666666664, 10),
            (-0.08333333333333333, 12), (0.08333333333333333, 17), (-0.08333333333333333, 58),
            (0.04861111111111111, 43), (0.20694444444444443, 44), (-0.1736111111111111, 33),
            (-0.1388888888888889, 34), (0.1388888888888889, 36), (-0.16666666666666666, 18),
            (0.16666666666666666, 9), (0.25, 11), (-0.25, 16), (-0.05555555555555555, 58),
            (0.03333333333333333, 43), (0.0763888888888889, 44), (0.013888888888888888, 32),
            (-0.04861111111111111, 33), (-0.027777777777777776, 35), (0.2013888888888889, 59),
            (-0.2013888888888889, 60), (-0.20833333333333334, 45), (-0.20277777777777778, 46),
            (0.40555555555555556, 47), (0.4166666666666667, 48), (-0.20277777777777778, 49),
            (-0.2013888888888889, 50), (-0.20833333333333334, 51), (0.2013888888888889, 52),
            (-0.05555555555555555, 59), (0.05555555555555555, 60), (0.1125, 45),
            (-0.05555555555555555, 46), (-0.0625, 47), (-0.05694444444444444, 54),
            (-0.05555555555555555, 48), (0.125, 49), (0.05555555555555555, 55), (-0.0625, 51),
            (-0.041666666666666664, 57), (0.041666666666666664, 19), (0.125, 21), (-0.125, 14),
            (-0.08333333333333333, 15), (0.08333333333333333, 20), (0.008333333333333333, 61),
            (-0.015277777777777777, 59), (-0.027777777777777776, 60), (0.006944444444444444, 45),
            (0.05555555555555555, 46), (0.020833333333333332, 47), (-0.027777777777777776, 48),
            (-0.041666666666666664, 49), (0.020833333333333332, 51), (0.125, 4), (-0.125, 7),
            (1.0, 0), (-0.041666666666666664, 42), (0.04861111111111111, 25),
            (0.06944444444444445, 26), (-0.09722222222222222, 29), (0.04861111111111111, 25),
            (-0.09722222222222222, 26), (-0.041666666666666664, 28), (0.06944444444444445, 29),
            (-0.25, 3), (0.16666666666666666, 6), (-0.020833333333333332, 42),
            (-0.027777777777777776, 25), (0.04861111111111111, 28), (-0.20833333333333334, 10),
            (0.2916666666666667, 12), (0.16666666666666666, 27), (-0.20833333333333334, 17),
            (0.10416666666666667, 43), (-0.10416666666666667, 44), (-0.10416666666666667, 32),
            (-0.041666666666666664, 33), (0.16666666666666666, 34), (0.1597222222222222, 35),
            (-0.17083333333333334, 36), (0.25, 9), (-0.25, 11), (-0.16666666666666666, 22),
            (0.16666666666666666, 16), (0.020833333333333332, 43), (-0.020833333333333332, 44),
            (0.04861111111111111, 32), (-0.06944444444444445, 33), (-0.05555555555555555, 40),
            (0.06527777777777778, 35), (-0.0625, 45), (0.125, 46), (-0.0625, 47),
            (0.05555555555555555, 54), (-0.05555555555555555, 48), (-0.05555555555555555, 49),
            (0.05555555555555555, 50), (-0.05555555555555555, 55), (0.1125, 51),
            (-0.05694444444444444, 52), (-0.020833333333333332, 43), (0.020833333333333332, 44),
            (0.027777777777777776, 32), (-0.027777777777777776, 33), (-0.008333333333333333, 40),
            (0.006944444444444444, 35), (0.020833333333333332, 45), (-0.041666666666666664, 46),
            (0.020833333333333332, 47), (-0.027777777777777776, 54), (0.05555555555555555, 48),
            (-0.027777777777777776, 49), (0.008333333333333333, 56), (-0.015277777777777777, 55),
            (0.006944444444444444, 51), (0.16666666666666666, 3), (-0.25, 6),
            (0.04861111111111111, 42), (-0.027777777777777776, 25), (-0.020833333333333332, 28),
            (-0.16666666666666666, 41), (0.20833333333333334, 10), (0.20833333333333334, 12),
            (-0.2916666666666667, 17), (-0.10416666666666667, 43), (0.1597222222222222, 44),
            (0.10416666666666667, 32), (-0.041666666666666664, 33), (-0.17083333333333334, 34),
            (-0.10416666666666667, 35), (0.16666666666666666, 36), (-0.5, 2), (0.5, 5),
            (-0.08333333333333333, 41), (0.08333333333333333, 27), (0.25, 19), (-0.25, 21),
            (-0.25, 13), (0.25, 15), (0.25, 23), (-0.25, 20), (0.09027777777777778, 43),
            (-0.13194444444444445, 44), (-0.175, 32), (0.20833333333333334, 33),
            (0.08333333333333333, 40), (-0.0763888888888889, 35), (-0.08333333333333333, 19),
            (0.08333333333333333, 21), (0.125, 13), (-0.125, 14), (-0.041666666666666664, 39),
            (0.041666666666666664, 23), (-0.16666666666666666, 18), (0.25, 9),
            (0.16666666666666666, 11), (-0.25, 16), (-0.05555555555555555, 58),
            (0.04861111111111111, 43), (0.06527777777777778, 44), (0.020833333333333332, 32),
            (-0.06944444444444445, 33), (-0.020833333333333332, 35), (0.05555555555555555, 59),
            (-0.05555555555555555, 60), (-0.0625, 45), (-0.05555555555555555, 46), (0.1125, 47),
            (0.125, 48), (-0.05555555555555555, 49), (-0.05694444444444444, 50), (-0.0625, 51),
            (0.05555555555555555, 52), (0.08333333333333333, 58), (-0.175, 43),
            (-0.0763888888888889, 44), (0.09027777777777778, 32), (0.20833333333333334, 33),
            (-0.13194444444444445, 35), (-0.2013888888888889, 59), (0.2013888888888889, 60),
            (0.40555555555555556, 45), (-0.20277777777777778, 46), (-0.20833333333333334, 47),
            (-0.2013888888888889, 54), (-0.20277777777777778, 48), (0.4166666666666667, 49),
            (0.2013888888888889, 55), (-0.20833333333333334, 51), (-0.008333333333333333, 58),
            (0.027777777777777776, 43), (0.006944444444444444, 44), (-0.020833333333333332, 32),
            (-0.027777777777777776, 33), (0.020833333333333332, 35), (0.041666666666666664, 57),
            (-0.125, 19), (-0.041666666666666664, 21), (0.08333333333333333, 13), (0.125, 14),
            (-0.08333333333333333, 23), (0.008333333333333333, 61), (-0.027777777777777776, 59),
            (-0.015277777777777777, 60), (0.020833333333333332, 45), (0.05555555555555555, 46),
            (0.006944444444444444, 47), (-0.041666666666666664, 48), (-0.027777777777777776, 49),
            (0.020833333333333332, 51), (1.0, 0), (0.25, 6), (0.020833333333333332, 28),
            (-0.041666666666666664, 25), (0.041666666666666664, 26), (-0.041666666666666664, 29),
            (-0.041666666666666664, 28), (0.5, 8), (-0.08333333333333333, 10),
            (0.041666666666666664, 12), (0.16666666666666666, 17), (-0.16666666666666666, 30),
            (-0.020833333333333332, 32), (0.04861111111111111, 33), (-0.013888888888888888, 34),
            (0.020833333333333332, 35), (-0.06944444444444445, 36), (-0.041666666666666664, 37),
            (0.008333333333333333, 53), (-0.5, 5), (-0.08333333333333333, 27),
            (0.041666666666666664, 10), (-0.08333333333333333, 12), (0.08333333333333333, 17),
            (0.16666666666666666, 27), (-0.006944444444444444, 32), (-0.11805555555555555, 33),
            (0.1388888888888889, 34), (0.22916666666666666, 35), (-0.1388888888888889, 36),
            (0.08333333333333333, 13), (-0.125, 14), (0.041666666666666664, 15),
            (-0.08333333333333333, 23), (0.125, 20), (-0.16666666666666666, 22),
            (-0.1388888888888889, 40), (-0.041666666666666664, 13), (0.125, 14),
            (-0.08333333333333333, 15), (-0.125, 23), (0.08333333333333333, 20),
            (0.05555555555555555, 54), (-0.05555555555555555, 48), (-0.05555555555555555, 49),
            (0.05555555555555555, 50), (-0.05555555555555555, 55), (0.12777777777777777, 51),
            (-0.05555555555555555, 52), (0.041666666666666664, 39), (0.008333333333333333, 56),
            (-0.125, 10), (0.08333333333333333, 12), (-0.08333333333333333, 17), (-0.25, 9),
            (0.16666666666666666, 11), (0.25, 16), (-0.020833333333333332, 43),
            (0.006944444444444444, 44), (-0.020833333333333332, 32), (0.041666666666666664, 33),
            (0.020833333333333332, 35), (0.09027777777777778, 43), (-0.09027777777777778, 44),
            (-0.0763888888888889, 33), (0.08333333333333333, 34), (-0.08333333333333333, 36),
            (0.08333333333333333, 32), (0.027777777777777776, 33), (-0.05555555555555555, 34),
            (-0.08333333333333333, 35), (0.05555555555555555, 36), (0.020833333333333332, 45),
            (-0.027777777777777776, 46), (0.006944444444444444, 47), (-0.041666666666666664, 48),
            (0.05555555555555555, 49), (-0.015277777777777777, 50), (0.020833333333333332, 51),
            (-0.027777777777777776, 52), (0.16666666666666666, 9), (-0.25, 11), (0.25, 16),
            (0.09722222222222222, 43), (-0.1111111111111111, 44), (0.006944444444444444, 32),
            (0.006944444444444444, 33), (0.10416666666666667, 35), (-0.16666666666666666, 13),
            (0.16666666666666666, 15), (0.16666666666666666, 23), (-0.16666666666666666, 20),
            (-0.09722222222222222, 45), (0.20833333333333334, 46), (-0.1111111111111111, 47),
            (-0.041666666666666664, 48), (-0.10555555555555556, 49), (0.14583333333333334, 50),
            (0.1388888888888889, 51), (-0.14583333333333334, 52), (-0.1111111111111111, 45),
            (0.20833333333333334, 46), (-0.09722222222222222, 47), (0.14583333333333334, 54),
            (-0.10555555555555556, 48), (-0.041666666666666664, 49), (-0.14583333333333334, 55),
            (0.1388888888888889, 51), (0.006944444444444444, 45), (-0.027777777777777776, 46),
            (0.020833333333333332, 47), (-0.015277777777777777, 54), (0.05555555555555555, 48),
            (-0.041666666666666664, 49), (-0.027777777777777776, 55), (0.020833333333333332, 51),
            (-0.05555555555555555, 43), (0.04861111111111111, 44), (0.020833333333333332, 32),
            (-0.027777777777777776, 33), (-0.020833333333333332, 35), (0.125, 19), (-0.125, 21),
            (-0.041666666666666664, 14), (0.08333333333333333, 15), (-0.08333333333333333, 20),
            (-0.041666666666666664, 45), (-0.027777777777777776, 46), (0.06388888888888888, 47),
            (0.08333333333333333, 48), (-0.027777777777777776, 49), (-0.05555555555555555, 50),
            (-0.041666666666666664, 51), (0.05555555555555555, 52), (0.125, 19), (-0.125, 21),
            (-0.08333333333333333, 13), (0.041666666666666664, 14), (0.08333333333333333, 23),
            (0.06388888888888888, 45), (-0.027777777777777776, 46), (-0.041666666666666664, 47),
            (-0.05555555555555555, 54), (-0.027777777777777776, 48), (0.08333333333333333, 49),
            (0.05555555555555555, 55), (-0.041666666666666664, 51), (0.05555555555555555, 59),
            (-0.05694444444444444, 60), (-0.020833333333333332, 45), (-0.027777777777777776, 46),
            (0.04861111111111111, 47), (0.041666666666666664, 48), (-0.027777777777777776, 49),
            (-0.020833333333333332, 51), (-0.05694444444444444, 59), (0.05555555555555555, 60),
            (0.04861111111111111, 45), (-0.027777777777777776, 46), (-0.020833333333333332, 47),
            (-0.027777777777777776, 48), (0.041666666666666664, 49), (-0.020833333333333332, 51),
            (1.0, 0), (0.25, 3), (0.020833333333333332, 42), (-0.041666666666666664, 42),
            (-0.041666666666666664, 25), (-0.041666666666666664, 26), (0.041666666666666664, 29),
            (-0.5, 8), (0.08333333333333333, 10), (-0.16666666666666666, 12),
            (-0.041666666666666664, 17), (-0.16666666666666666, 30), (-0.020833333333333332, 43),
            (0.020833333333333332, 44), (0.04861111111111111, 33), (-0.06944444444444445, 34),
            (-0.013888888888888888, 36), (0.041666666666666664, 37), (0.008333333333333333, 53),
            (0.125, 10), (0.08333333333333333, 12), (-0.08333333333333333, 17), (-0.25, 9),
            (0.25, 11), (0.16666666666666666, 16), (-0.020833333333333332, 43),
            (0.020833333333333332, 44), (-0.020833333333333332, 32), (0.041666666666666664, 33),
            (0.006944444444444444, 35), (0.08333333333333333, 43), (-0.08333333333333333, 44),
            (0.027777777777777776, 33), (0.05555555555555555, 34), (-0.05555555555555555, 36),
            (0.09027777777777778, 32), (-0.0763888888888889, 33), (-0.08333333333333333, 34),
            (-0.09027777777777778, 35), (0.08333333333333333, 36), (0.020833333333333332, 45),
            (-0.041666666666666664, 46), (0.020833333333333332, 47), (-0.027777777777777776, 48),
            (0.05555555555555555, 49), (-0.027777777777777776, 50), (0.006944444444444444, 51),
            (-0.015277777777777777, 52), (0.020833333333333332, 43), (-0.020833333333333332, 44),
            (-0.05555555555555555, 32), (-0.027777777777777776, 33), (0.04861111111111111, 35),
            (-0.125, 13), (0.041666666666666664, 14), (0.08333333333333333, 15), (0.125, 23),
            (-0.08333333333333333, 20), (-0.041666666666666664, 45), (0.08333333333333333, 46),
            (-0.041666666666666664, 47), (-0.027777777777777776, 48), (-0.027777777777777776, 49),
            (0.05555555555555555, 50), (0.06388888888888888, 51), (-0.05555555555555555, 52),
            (-0.020833333333333332, 45), (0.041666666666666664, 46), (-0.020833333333333332, 47),
            (0.05555555555555555, 54), (-0.027777777777777776, 48), (-0.027777777777777776, 49),
            (-0.05694444444444444, 55), (0.04861111111111111, 51), (0.5, 2),
            (0.08333333333333333, 41), (-0.16666666666666666, 41), (-0.041666666666666664, 10),
            (-0.08333333333333333, 12), (0.08333333333333333, 17), (-0.006944444444444444, 43),
            (0.22916666666666666, 44), (-0.11805555555555555, 33), (-0.1388888888888889, 34),
            (0.1388888888888889, 36), (-0.08333333333333333, 19), (0.08333333333333333, 21),
            (0.125, 14), (-0.125, 15), (-0.041666666666666664, 20), (0.16666666666666666, 9),
            (0.25, 11), (-0.25, 16), (0.006944444444444444, 43), (0.10416666666666667, 44),
            (0.09722222222222222, 32), (0.006944444444444444, 33), (-0.1111111111111111, 35),
            (0.16666666666666666, 19), (-0.16666666666666666, 21), (0.16666666666666666, 15),
            (-0.16666666666666666, 20), (-0.09722222222222222, 45), (-0.041666666666666664, 46),
            (0.1388888888888889, 47), (0.20833333333333334, 48), (-0.10555555555555556, 49),
            (-0.14583333333333334, 50), (-0.1111111111111111, 51), (0.14583333333333334, 52),
            (0.08333333333333333, 19), (-0.08333333333333333, 21), (-0.125, 13),
            (-0.041666666666666664, 14), (0.125, 23), (0.04861111111111111, 45),
            (-0.027777777777777776, 46), (-0.020833333333333332, 47), (-0.05694444444444444, 54),
            (-0.027777777777777776, 48), (0.041666666666666664, 49), (0.05555555555555555, 55),
            (-0.020833333333333332, 51), (-0.16666666666666666, 18), (-0.1388888888888889, 58),
            (0.041666666666666664, 19), (0.125, 21), (-0.125, 14), (-0.08333333333333333, 15),
            (0.08333333333333333, 20), (0.05555555555555555, 59), (-0.05555555555555555, 60),
            (-0.05555555555555555, 46), (0.12777777777777777, 47), (-0.05555555555555555, 49),
            (-0.05555555555555555, 50), (0.05555555555555555, 52), (0.14583333333333334, 59),
            (-0.14583333333333334, 60), (-0.1111111111111111, 45), (-0.10555555555555556, 46),
            (0.1388888888888889, 47), (0.20833333333333334, 48), (-0.041666666666666664, 49),
            (-0.09722222222222222, 51), (-0.05555555555555555, 59), (0.05555555555555555, 60),
            (0.06388888888888888, 45), (-0.027777777777777776, 46), (-0.041666666666666664, 47),
            (-0.027777777777777776, 48), (0.08333333333333333, 49), (-0.041666666666666664, 51),
            (-0.041666666666666664, 57), (-0.015277777777777777, 59), (-0.027777777777777776, 60),
            (0.006944444444444444, 45), (0.05555555555555555, 46), (0.020833333333333332, 47),
            (-0.027777777777777776, 48), (-0.041666666666666664, 49), (0.020833333333333332, 51),
            (0.008333333333333333, 61), (1.0, 0), (-0.25, 3), (-0.0625, 42), (-0.25, 6),
            (-0.0625, 28), (0.2916666666666667, 12), (-0.2916666666666667, 17),
            (0.020833333333333332, 43), (-0.020833333333333332, 44), (0.006944444444444444, 33),
            (0.09722222222222222, 34), (-0.09722222222222222, 36), (0.020833333333333332, 32),
            (0.006944444444444444, 33), (-0.09722222222222222, 34), (-0.020833333333333332, 35),
            (0.09722222222222222, 36), (0.5, 5), (0.25, 27), (0.25, 9), (-0.25, 11),
            (0.16666666666666666, 16), (0.10416666666666667, 43), (-0.10416666666666667, 44),
            (-0.034722222222222224, 32), (-0.06944444444444445, 33), (0.1597222222222222, 35),
            (-0.08333333333333333, 13), (-0.041666666666666664, 14), (0.125, 15),
            (0.08333333333333333, 23), (-0.125, 20), (-0.020833333333333332, 45),
            (0.041666666666666664, 46), (-0.020833333333333332, 47), (-0.027777777777777776, 48),
            (-0.027777777777777776, 49), (0.05555555555555555, 50), (0.04861111111111111, 51),
            (-0.05694444444444444, 52), (-0.16666666666666666, 22), (-0.05555555555555555, 40),
            (-0.020833333333333332, 43), (0.020833333333333332, 44), (0.027777777777777776, 32),
            (-0.027777777777777776, 33), (0.006944444444444444, 35), (0.08333333333333333, 40),
            (-0.041666666666666664, 45), (0.08333333333333333, 46), (-0.041666666666666664, 47),
            (0.05555555555555555, 54), (-0.027777777777777776, 48), (-0.027777777777777776, 49),
            (-0.05555555555555555, 55), (0.06388888888888888, 51), (-0.041666666666666664, 39),
            (0.020833333333333332, 45), (-0.041666666666666664, 46), (0.020833333333333332, 47),
            (-0.027777777777777776, 54), (0.05555555555555555, 48), (-0.027777777777777776, 49),
            (-0.015277777777777777, 55), (0.006944444444444444, 51), (0.008333333333333333, 56),
            (-0.5, 2), (-0.25, 41), (0.25, 9), (0.16666666666666666, 11), (-0.25, 16),
            (-0.034722222222222224, 43), (0.1597222222222222, 44), (0.10416666666666667, 32),
            (-0.06944444444444445, 33), (-0.10416666666666667, 35), (0.08333333333333333, 19),
            (-0.08333333333333333, 21), (0.041666666666666664, 14), (0.125, 15), (-0.125, 20),
            (-0.020833333333333332, 45), (-0.027777777777777776, 46), (0.04861111111111111, 47),
            (0.041666666666666664, 48), (-0.027777777777777776, 49), (-0.05694444444444444, 50),
            (-0.020833333333333332, 51), (0.05555555555555555, 52), (-0.0763888888888889, 43),
            (-0.13194444444444445, 44), (-0.0763888888888889, 32), (0.2638888888888889, 33),
            (-0.13194444444444445, 35), (0.16666666666666666, 19), (-0.16666666666666666, 21),
            (-0.16666666666666666, 13), (0.16666666666666666, 23), (-0.08333333333333333, 19),
            (0.08333333333333333, 21), (0.125, 13), (-0.125, 14), (0.041666666666666664, 23),
            (0.1388888888888889, 45), (-0.041666666666666664, 46), (-0.09722222222222222, 47),
            (-0.14583333333333334, 54), (-0.10555555555555556, 48), (0.20833333333333334, 49),
            (0.14583333333333334, 55), (-0.1111111111111111, 51), (-0.16666666666666666, 18),
            (-0.05555555555555555, 58), (0.08333333333333333, 58), (0.027777777777777776, 43),
            (0.006944444444444444, 44), (-0.020833333333333332, 32), (-0.027777777777777776, 33),
            (0.020833333333333332, 35), (0.05555555555555555, 59), (-0.05555555555555555, 60),
            (-0.041666666666666664, 45), (-0.027777777777777776, 46), (0.06388888888888888, 47),
            (0.08333333333333333, 48), (-0.027777777777777776, 49), (-0.041666666666666664, 51),
            (-0.125, 19), (-0.041666666666666664, 21), (0.08333333333333333, 13), (0.125, 14),
            (-0.08333333333333333, 23), (-0.14583333333333334, 59), (0.14583333333333334, 60),
            (0.1388888888888889, 45), (-0.10555555555555556, 46), (-0.1111111111111111, 47),
            (-0.041666666666666664, 48), (0.20833333333333334, 49), (-0.09722222222222222, 51),
            (-0.05555555555555555, 59), (0.05555555555555555, 60), (0.12777777777777777, 45),
            (-0.05555555555555555, 46), (-0.05555555555555555, 54), (-0.05555555555555555, 48),
            (0.05555555555555555, 55), (0.041666666666666664, 57), (-0.027777777777777776, 59),
            (-0.015277777777777777, 60), (0.020833333333333332, 45), (0.05555555555555555, 46),
            (0.006944444444444444, 47), (-0.041666666666666664, 48), (-0.027777777777777776, 49),
            (0.020833333333333332, 51), (0.008333333333333333, 61),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (3, 2), (3, 3), (1, 4), (3, 6), (1, 7), (3, 10), (3, 12), (1, 13), (3, 16),
            (3, 19), (0, 20), (0, 21), (0, 22), (0, 23), (1, 24), (3, 25), (2, 27), (4, 31),
            (3, 35), (4, 41), (4, 45), (1, 47), (3, 51), (3, 57), (3, 61), (4, 67), (3, 73),
            (0, 74), (2, 75), (4, 76), (4, 77), (4, 81), (2, 85), (4, 92), (4, 101), (3, 105),
            (4, 112), (2, 116), (4, 122), (4, 132), (4, 141), (3, 142), (4, 149), (3, 155),
            (4, 156), (4, 166), (4, 176), (1, 177), (3, 178), (2, 180), (4, 184), (3, 188),
            (4, 194), (0, 195), (2, 196), (4, 197), (4, 201), (4, 202), (2, 206), (4, 213),
            (4, 222), (3, 223), (4, 230), (4, 231), (4, 241), (4, 245), (1, 247), (3, 251),
            (3, 257), (3, 261), (4, 268), (3, 274), (3, 278), (4, 284), (2, 288), (4, 294),
            (4, 304), (4, 314), (3, 320), (4, 329), (3, 331), (0, 332), (4, 336), (4, 340),
            (2, 342), (4, 345), (3, 349), (4, 356), (2, 360), (4, 366), (4, 376), (4, 382),
            (4, 391), (2, 393), (4, 396), (3, 400), (4, 407), (1, 409), (3, 411), (3, 417),
            (4, 423), (3, 429), (2, 433), (4, 439), (4, 449), (4, 455), (4, 465), (4, 471),
            (3, 477), (4, 486), (0, 487), (2, 488), (4, 489), (4, 492), (4, 493), (1, 494),
            (3, 497), (2, 498), (4, 503), (3, 504), (4, 505), (1, 506), (3, 507), (3, 510),
            (3, 511), (4, 516), (3, 521), (2, 522), (4, 523), (3, 528), (4, 535), (3, 536),
            (4, 537), (3, 540), (2, 543), (4, 548), (4, 553), (4, 558), (4, 566), (2, 569),
            (4, 574), (3, 578), (4, 586), (4, 594), (4, 602), (4, 607), (3, 612), (4, 620),
            (3, 625), (4, 633), (4, 641), (4, 649), (0, 650), (2, 651), (4, 652), (4, 653),
            (4, 656), (1, 657), (3, 660), (2, 661), (4, 666), (3, 667), (4, 668), (3, 671),
            (2, 674), (4, 679), (4, 684), (4, 689), (4, 697), (4, 702), (3, 707), (4, 715),
            (4, 723), (1, 724), (3, 725), (3, 726), (3, 729), (4, 734), (3, 739), (2, 742),
            (4, 747), (3, 751), (4, 759), (3, 764), (4, 772), (2, 773), (4, 774), (3, 779),
            (4, 786), (4, 794), (4, 802), (3, 803), (4, 811), (4, 812), (0, 813), (2, 814),
            (4, 815), (2, 816), (4, 817), (3, 819), (4, 824), (4, 829), (1, 830), (3, 831),
            (2, 834), (4, 839), (3, 844), (4, 852), (2, 853), (4, 854), (4, 859), (4, 860),
            (4, 868), (3, 869), (4, 877), (4, 878), (1, 879), (3, 880), (2, 883), (4, 888),
            (3, 893), (4, 901), (4, 906), (3, 910), (3, 915), (4, 923), (2, 924), (4, 925),
            (4, 926), (4, 931), (4, 939), (3, 944), (4, 952), (4, 959), (3, 960), (4, 968),
            (4, 969),
        ],
        /// Where the parts of each base end.
        bases: &[
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
            22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
            41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59,
            60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78,
            79, 80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95, 96, 97,
            98, 99, 100, 101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111, 112, 113,
            114, 115, 116, 117, 118, 119, 120, 121, 122, 123, 124, 125, 126, 127, 128,
            129, 130, 131, 132, 133, 134, 135, 136, 137, 138, 139, 140, 141, 142, 143,
            144, 145, 146, 147, 148, 149, 150, 151, 152, 153, 154, 155, 156, 157, 158,
            159, 160, 161, 162, 163, 164, 165, 166, 167, 168, 169, 170, 171, 172, 173,
            174, 175, 176, 177, 178, 179, 180, 181, 182, 183, 184, 185, 186, 187, 188,
            189, 190, 191, 192, 193, 194, 195, 196, 197, 198, 199, 200, 201, 202, 203,
            204, 205, 206, 207, 208, 209, 210, 211, 212, 213, 214, 215, 216, 217, 218,
            219, 220, 221, 222, 223, 224, 225, 226, 227, 228, 229, 230, 231, 232, 233,
            234, 235, 236, 237, 238,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (8, 2), (9, 2), (10, 2), (7, 1), (5, 2), (6, 2), (4, 1), (3, 2), (2, 2), (1, 2), (0, 1),
            (10, 4), (9, 4), (6, 4), (17, 2), (18, 2), (20, 2), (21, 2), (26, 2), (28, 2), (29, 2),
            (30, 2), (31, 2), (32, 2), (33, 2), (34, 2), (35, 2), (37, 2), (38, 2), (39, 2),
            (40, 2), (41, 2), (43, 2), (45, 2), (46, 2), (47, 2), (50, 2), (51, 2), (53, 2),
            (54, 2), (55, 2), (56, 2), (57, 2), (58, 2), (59, 2), (60, 2), (61, 2), (63, 2),
            (64, 2), (65, 2), (66, 2), (71, 2), (74, 2), (75, 2), (76, 2), (77, 2), (78, 2),
            (80, 2), (82, 2), (83, 2), (84, 2), (85, 2), (86, 2), (88, 2), (89, 2), (90, 2),
            (91, 2), (92, 2), (93, 2), (94, 2), (95, 2), (97, 2), (101, 2), (103, 2), (104, 2),
            (105, 2), (106, 2), (107, 2), (108, 2), (110, 2), (111, 2), (112, 2), (113, 2),
            (114, 2), (115, 2), (118, 2), (119, 2), (121, 2), (126, 2), (128, 2), (129, 2),
            (131, 2), (133, 2), (135, 2), (136, 2), (137, 2), (138, 2), (139, 2), (140, 2),
            (141, 2), (143, 2), (144, 2), (145, 2), (146, 2), (148, 2), (150, 2), (151, 2),
            (152, 2), (153, 2), (154, 2), (155, 2), (156, 2), (157, 2), (160, 2), (161, 2),
            (163, 2), (165, 2), (166, 2), (167, 2), (168, 2), (169, 2), (170, 2), (172, 2),
            (173, 2), (178, 2), (180, 2), (181, 2), (183, 2), (185, 2), (186, 2), (187, 2),
            (189, 2), (190, 2), (191, 2), (193, 2), (194, 2), (195, 2), (196, 2), (197, 2),
            (198, 2), (199, 2), (201, 2), (202, 2), (205, 2), (206, 2), (208, 2), (209, 2),
            (210, 2), (211, 2), (212, 2), (213, 2), (215, 2), (216, 2), (219, 2), (220, 2),
            (222, 2), (223, 2), (226, 2), (227, 2), (228, 2), (229, 2), (230, 2), (231, 2),
            (233, 2), (234, 2), (236, 2), (237, 2), (15, 1), (16, 1), (17, 1), (18, 1), (19, 1),
            (20, 1), (21, 1), (22, 1), (23, 1), (24, 1), (25, 1), (26, 1), (27, 1), (28, 1),
            (29, 1), (30, 1), (31, 1), (32, 1), (33, 1), (34, 1), (35, 1), (36, 1), (37, 1),
            (38, 1), (39, 1), (40, 1), (41, 1), (42, 1), (43, 1), (44, 1), (45, 1), (46, 1),
            (47, 1), (48, 1), (49, 1), (50, 1), (51, 1), (52, 1), (53, 1), (54, 1), (55, 1),
            (56, 1), (57, 1), (58, 1), (59, 1), (60, 1), (61, 1), (62, 1), (63, 1), (64, 1),
            (65, 1), (66, 1), (67, 1), (68, 1), (69, 1), (70, 1), (71, 1), (72, 1), (73, 1),
            (74, 1), (75, 1), (76, 1), (77, 1), (78, 1), (79, 1), (80, 1), (81, 1), (82, 1),
            (83, 1), (84, 1), (85, 1), (86, 1), (87, 1), (88, 1), (89, 1), (90, 1), (91, 1),
            (92, 1), (93, 1), (94, 1), (95, 1), (96, 1), (97, 1), (98, 1), (99, 1), (100, 1),
            (101, 1), (102, 1), (103, 1), (104, 1), (105, 1), (106, 1), (107, 1), (108, 1),
            (109, 1), (110, 1), (111, 1), (112, 1), (113, 1), (114, 1), (115, 1), (116, 1),
            (117, 1), (118, 1), (119, 1), (120, 1), (121, 1), (122, 1), (123, 1), (124, 1),
            (125, 1), (126, 1), (127, 1), (128, 1), (129, 1), (130, 1), (131, 1), (132, 1),
            (133, 1), (134, 1), (135, 1), (136, 1), (137, 1), (138, 1), (139, 1), (140, 1),
            (141, 1), (142, 1), (143, 1), (144, 1), (145, 1), (146, 1), (147, 1), (148, 1),
            (149, 1), (150, 1), (151, 1), (152, 1), (153, 1), (154, 1), (155, 1), (156, 1),
            (157, 1), (158, 1), (159, 1), (160, 1), (161, 1), (162, 1), (163, 1), (164, 1),
            (165, 1), (166, 1), (167, 1), (168, 1), (169, 1), (170, 1), (171, 1), (172, 1),
            (173, 1), (174, 1), (175, 1), (176, 1), (177, 1), (178, 1), (179, 1), (180, 1),
            (181, 1), (182, 1), (183, 1), (184, 1), (185, 1), (186, 1), (187, 1), (188, 1),
            (189, 1), (190, 1), (191, 1), (192, 1), (193, 1), (194, 1), (195, 1), (196, 1),
            (197, 1), (198, 1), (199, 1), (200, 1), (201, 1), (202, 1), (203, 1), (204, 1),
            (205, 1), (206, 1), (207, 1), (208, 1), (209, 1), (210, 1), (211, 1), (212, 1),
            (213, 1), (214, 1), (215, 1), (216, 1), (217, 1), (218, 1), (219, 1), (220, 1),
            (221, 1), (222, 1), (223, 1), (224, 1), (225, 1), (226, 1), (227, 1), (228, 1),
            (229, 1), (230, 1), (231, 1), (232, 1), (233, 1), (234, 1), (235, 1), (236, 1),
            (237, 1), (1, 1), (2, 1), (3, 1), (5, 1), (6, 1), (8, 1), (9, 1), (10, 1), (11, 1),
            (12, 1), (13, 1), (14, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[(5, 1)], &[(4, 2)], &[(3, 2)], &[(2, 2)], &[(1, 1), (2, 1), (4, 1)], &[(1, 2)],
            &[(1, 2), (2, 2)], &[(0, 1), (2, 1), (3, 1)], &[(0, 2)], &[(0, 2), (2, 2)],
            &[(0, 2), (1, 2)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[
            (17, 0, &[(2, 1), (3, 1)]), (18, 0, &[(2, 1), (3, 1), (5, 1)]),
            (20, 0, &[(2, 3), (3, 1)]), (21, 0, &[(1, 1), (3, 1), (4, 1)]),
            (26, 0, &[(1, 2), (2, 1), (3, 1)]), (28, 0, &[(0, 1)]), (29, 0, &[(0, 1), (5, 1)]),
            (30, 0, &[(0, 1), (5, 2)]), (31, 0, &[(0, 1), (4, 2)]), (32, 0, &[(0, 1), (3, 2)]),
            (33, 0, &[(0, 1), (2, 2)]), (34, 0, &[(0, 1), (2, 2), (5, 1)]),
            (35, 0, &[(0, 1), (2, 4)]), (37, 0, &[(0, 1), (1, 1), (2, 1), (4, 1)]),
            (38, 0, &[(0, 1), (1, 2)]), (39, 0, &[(0, 1), (1, 2), (5, 1)]),
            (40, 0, &[(0, 1), (1, 2), (2, 2)]), (41, 0, &[(0, 1), (1, 4)]),
            (43, 0, &[(0, 2), (2, 1), (3, 1)]), (45, 0, &[(0, 3), (5, 1)]),
            (46, 0, &[(0, 3), (2, 2)]), (47, 0, &[(0, 3), (1, 2)]), (50, 1, &[(2, 1), (4, 1)]),
            (51, 1, &[(2, 1), (4, 1), (5, 1)]), (53, 1, &[(2, 3), (4, 1)]), (54, 1, &[(1, 1)]),
            (55, 1, &[(1, 1), (5, 1)]), (56, 1, &[(1, 1), (5, 2)]), (57, 1, &[(1, 1), (4, 2)]),
            (58, 1, &[(1, 1), (3, 2)]), (59, 1, &[(1, 1), (2, 2)]),
            (60, 1, &[(1, 1), (2, 2), (5, 1)]), (61, 1, &[(1, 1), (2, 4)]),
            (63, 1, &[(1, 2), (2, 1), (4, 1)]), (64, 1, &[(1, 3), (5, 1)]),
            (65, 1, &[(1, 3), (2, 2)]), (66, 1, &[(0, 1), (3, 1), (4, 1)]),
            (71, 1, &[(0, 1), (1, 1), (2, 1), (3, 1)]), (74, 1, &[(0, 2), (2, 1), (4, 1)]),
            (75, 1, &[(0, 2), (1, 1)]), (76, 1, &[(0, 2), (1, 1), (5, 1)]),
            (77, 1, &[(0, 2), (1, 1), (2, 2)]), (78, 1, &[(0, 2), (1, 3)]),
            (80, 1, &[(0, 4), (1, 1)]), (82, 2, &[(2, 1)]), (83, 2, &[(2, 1), (4, 2)]),
            (84, 2, &[(2, 1), (3, 2)]), (85, 2, &[(1, 1), (4, 1)]),
            (86, 2, &[(1, 1), (4, 1), (5, 1)]), (88, 2, &[(1, 1), (2, 2), (4, 1)]),
            (89, 2, &[(1, 2), (2, 1)]), (90, 2, &[(1, 2), (2, 1), (5, 1)]),
            (91, 2, &[(1, 2), (2, 3)]), (92, 2, &[(1, 3), (4, 1)]), (93, 2, &[(1, 4), (2, 1)]),
            (94, 2, &[(0, 1), (3, 1)]), (95, 2, &[(0, 1), (3, 1), (5, 1)]),
            (97, 2, &[(0, 1), (2, 2), (3, 1)]), (101, 2, &[(0, 1), (1, 2), (3, 1)]),
            (103, 2, &[(0, 2), (2, 1)]), (104, 2, &[(0, 2), (2, 1), (5, 1)]),
            (105, 2, &[(0, 2), (2, 3)]), (106, 2, &[(0, 2), (1, 1), (4, 1)]),
            (107, 2, &[(0, 2), (1, 2), (2, 1)]), (108, 2, &[(0, 3), (3, 1)]),
            (110, 2, &[(0, 4), (2, 1)]), (111, 3, &[(3, 1)]), (112, 3, &[(3, 1), (5, 1)]),
            (113, 3, &[(3, 1), (5, 2)]), (114, 3, &[(3, 1), (4, 2)]), (115, 3, &[(3, 3)]),
            (118, 3, &[(2, 2), (3, 1)]), (119, 3, &[(2, 2), (3, 1), (5, 1)]),
            (121, 3, &[(2, 4), (3, 1)]), (126, 3, &[(1, 1), (2, 1), (3, 1), (4, 1)]),
            (128, 3, &[(1, 2), (3, 1)]), (129, 3, &[(1, 2), (3, 1), (5, 1)]),
            (131, 3, &[(1, 2), (2, 2), (3, 1)]), (133, 3, &[(1, 4), (3, 1)]),
            (135, 3, &[(0, 1), (2, 1), (5, 1)]), (136, 3, &[(0, 1), (2, 1), (5, 2)]),
            (137, 3, &[(0, 1), (2, 1), (4, 2)]), (138, 3, &[(0, 1), (2, 1), (3, 2)]),
            (139, 3, &[(0, 1), (2, 3), (5, 1)]), (140, 3, &[(0, 1), (1, 1), (4, 1)]),
            (141, 3, &[(0, 1), (1, 1), (4, 1), (5, 1)]),
            (143, 3, &[(0, 1), (1, 1), (2, 2), (4, 1)]),
            (144, 3, &[(0, 1), (1, 2), (2, 1), (5, 1)]), (145, 3, &[(0, 1), (1, 3), (4, 1)]),
            (146, 3, &[(0, 2), (3, 1), (5, 1)]), (148, 3, &[(0, 2), (2, 2), (3, 1)]),
            (150, 3, &[(0, 2), (1, 2), (3, 1)]), (151, 3, &[(0, 3), (2, 1), (5, 1)]),
            (152, 3, &[(0, 3), (1, 1), (4, 1)]), (153, 4, &[(4, 1)]), (154, 4, &[(4, 1), (5, 1)]),
            (155, 4, &[(4, 1), (5, 2)]), (156, 4, &[(4, 3)]), (157, 4, &[(3, 2), (4, 1)]),
            (160, 4, &[(2, 2), (4, 1)]), (161, 4, &[(2, 2), (4, 1), (5, 1)]),
            (163, 4, &[(2, 4), (4, 1)]), (165, 4, &[(1, 1), (2, 1), (5, 1)]),
            (166, 4, &[(1, 1), (2, 1), (5, 2)]), (167, 4, &[(1, 1), (2, 1), (4, 2)]),
            (168, 4, &[(1, 1), (2, 1), (3, 2)]), (169, 4, &[(1, 1), (2, 3), (5, 1)]),
            (170, 4, &[(1, 2), (4, 1), (5, 1)]), (172, 4, &[(1, 2), (2, 2), (4, 1)]),
            (173, 4, &[(1, 3), (2, 1), (5, 1)]), (178, 4, &[(0, 1), (2, 1), (3, 1), (4, 1)]),
            (180, 4, &[(0, 1), (1, 1), (3, 1)]), (181, 4, &[(0, 1), (1, 1), (3, 1), (5, 1)]),
            (183, 4, &[(0, 1), (1, 1), (2, 2), (3, 1)]), (185, 4, &[(0, 1), (1, 3), (3, 1)]),
            (186, 4, &[(0, 2), (4, 1)]), (187, 4, &[(0, 2), (4, 1), (5, 1)]),
            (189, 4, &[(0, 2), (2, 2), (4, 1)]), (190, 4, &[(0, 2), (1, 1), (2, 1), (5, 1)]),
            (191, 4, &[(0, 2), (1, 2), (4, 1)]), (193, 4, &[(0, 3), (1, 1), (3, 1)]),
            (194, 4, &[(0, 4), (4, 1)]), (195, 5, &[(5, 1)]), (196, 5, &[(4, 2)]),
            (197, 5, &[(4, 2), (5, 1)]), (198, 5, &[(3, 2)]), (199, 5, &[(3, 2), (5, 1)]),
            (201, 5, &[(2, 2), (4, 2)]), (202, 5, &[(2, 2), (3, 2)]),
            (205, 5, &[(1, 1), (2, 1), (4, 1)]), (206, 5, &[(1, 1), (2, 1), (4, 1), (5, 1)]),
            (208, 5, &[(1, 1), (2, 3), (4, 1)]), (209, 5, &[(1, 2), (5, 1)]),
            (210, 5, &[(1, 2), (5, 2)]), (211, 5, &[(1, 2), (4, 2)]), (212, 5, &[(1, 2), (3, 2)]),
            (213, 5, &[(1, 2), (2, 2), (5, 1)]), (215, 5, &[(1, 3), (2, 1), (4, 1)]),
            (216, 5, &[(1, 4), (5, 1)]), (219, 5, &[(0, 1), (2, 1), (3, 1)]),
            (220, 5, &[(0, 1), (2, 1), (3, 1), (5, 1)]), (222, 5, &[(0, 1), (2, 3), (3, 1)]),
            (223, 5, &[(0, 1), (1, 1), (3, 1), (4, 1)]),
            (226, 5, &[(0, 1), (1, 2), (2, 1), (3, 1)]), (227, 5, &[(0, 2), (5, 1)]),
            (228, 5, &[(0, 2), (5, 2)]), (229, 5, &[(0, 2), (4, 2)]), (230, 5, &[(0, 2), (3, 2)]),
            (231, 5, &[(0, 2), (2, 2), (5, 1)]), (233, 5, &[(0, 2), (1, 1), (2, 1), (4, 1)]),
            (234, 5, &[(0, 2), (1, 2), (5, 1)]), (236, 5, &[(0, 3), (2, 1), (3, 1)]),
            (237, 5, &[(0, 4), (5, 1)]),
        ],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₃²), of S₃
// c[2] = 2 C(p₁² p₂²), of S₃
// c[3] = C(p₁ p₃ p₄), of S₃
// c[4] = 2 C(p₂²), of S₁
// c[5] = 2 C(p₂² p₃²), of S₃
// c[6] = C(p₂ p₃ p₅), of S₃
// c[7] = 2 C(p₃²), of S₁
// c[8] = 2 C(p₄²), of S₃
// c[9] = 2 C(p₅²), of S₃
// c[10] = C(p₆), of S₁
// c[11] = 4 C(p₁² p₂²), of S₃
// c[12] = 4 C(p₁² p₃²), of S₃
// c[13] = 4 C(p₂² p₃²), of S₃
// c[390] = C(p₅²), of S₃
// c[391] = C(p₄²), of S₃
// c[392] = C(p₃²), of S₁
// c[393] = C(p₂²), of S₁
// c[394] = C(p₂² p₃²), of S₃
// c[395] = C(p₁²), of S₁
// c[396] = C(p₁² p₃²), of S₃
// c[397] = C(p₁² p₂²), of S₃
