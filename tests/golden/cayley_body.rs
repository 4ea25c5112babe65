// cayley_body: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0 + 0.1 * mu[0].powi(3)`
//
// Group: SO3. Chart cayley, truncation K = 3, order of accuracy 4.
// Terms: S1: 4, S3: 14.
// Operations: gradient and Hessian 52 multiplications and 40 additions; predictor of degree 4 132 and 114.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0 + 0.1 * mu[0].powi(3)`
///
/// Group: SO3. Chart cayley, truncation K = 3, order of accuracy 4.
/// Terms: S1: 4, S3: 14.
/// Operations: gradient and Hessian 52 multiplications and 40 additions; predictor of degree 4 132 and 114.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct CayleyBody<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 258],
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
    type Vector<T> = ::coadjoint::nalgebra::SVector<T, 3>;
    type Matrix<T> = ::coadjoint::nalgebra::SMatrix<T, 3, 3>;
    impl<T: ::coadjoint::Scalar> CayleyBody<T> {
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
        pub fn new(step: T) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(step, &[])?;
            ::core::result::Result::Ok(Self::fold(step, &parts, &|_| T::of(1.0)))
        }
        /// As `new`, with the tail of the series summed for motions that start with `momenta`
        /// (`coadjoint::Tail`): as fast, as geometric, of the same order, and more accurate.
        ///
        /// # Errors
        /// As `new`, and where a step from one of the momenta fails.
        pub fn tuned(
            step: T,
            momenta: impl ::core::iter::IntoIterator<
                Item = impl ::core::convert::Into<Vector<T>>,
            >,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(step, &[])?;
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
            symbols: &[T; 0],
        ) -> ::core::result::Result<[T; 142], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                5,
                1,
                142,
            >(Self::table(), &[], step, symbols)
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 142],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                5,
                142,
                139,
                258,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 258]) -> Self {
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
            phase: &mut ::coadjoint::Phase<::coadjoint::SO3<T>>,
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
            phase: &mut ::coadjoint::Phase<::coadjoint::SO3<T>>,
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
            let t2 = mu1.times_plus(c[257], c[256]);
            let mu2 = input[1];
            let t3 = mu2 * mu2;
            let mu3 = input[2];
            let t4 = mu3 * mu3;
            let t5 = t4 * c[254];
            let t6 = t3.times_plus(c[255], t5);
            // H_red(μ)
            let t7 = t1.times_plus(t2, t6);
            t7
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for CayleyBody<T> {
        type Group = ::coadjoint::SO3<T>;
        type Chart = ::coadjoint::Cayley;
        #[inline(always)]
        fn group(&self) -> &::coadjoint::SO3<T> {
            const { &<::coadjoint::SO3<T>>::new() }
        }
        #[inline]
        fn value(&self, input: &Vector<T>) -> T {
            let c = &self.coefficients;
            let p1 = input[0];
            let t1 = p1.times_plus(c[253], c[252]);
            let t2 = p1.times_plus(t1, c[251]);
            let p2 = input[1];
            let t3 = p2 * p2;
            let p3 = input[2];
            let t4 = p3 * p3;
            let t5 = t4.times_plus(c[249], c[248]);
            let t6 = t3.times_plus(c[250], t5);
            let t7 = p1.times_plus(t2, t6);
            let t8 = t4.times_plus(c[246], c[245]);
            let t9 = t3.times_plus(c[247], t8);
            let t10 = p1.times_plus(t7, t9);
            let t11 = t4.times_plus(c[243], c[242]);
            let t12 = t3.times_plus(c[244], t11);
            let t13 = p1.times_plus(t10, t12);
            let t14 = t3 * t4;
            let t15 = t14 * c[12];
            let t16 = p1.times_plus(t13, t15);
            let t17 = t4.times_plus(c[240], c[239]);
            let t18 = t3.times_plus(c[241], t17);
            let t19 = t4.times_plus(c[238], c[237]);
            let t20 = t4 * t19;
            let t21 = t3.times_plus(t18, t20);
            // S(p)
            let t22 = p1.times_plus(t16, t21);
            t22
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p1 = input[0];
            let t1 = p1.times_plus(c[11], c[10]);
            let t2 = p1.times_plus(t1, c[9]);
            let p2 = input[1];
            let t3 = p2 * p2;
            let p3 = input[2];
            let t4 = p3 * p3;
            let t5 = t4.times_plus(c[7], c[6]);
            let t6 = t3.times_plus(c[8], t5);
            let t7 = p1.times_plus(t2, t6);
            let t8 = t4.times_plus(c[4], c[3]);
            let t9 = t3.times_plus(c[5], t8);
            let t10 = p1.times_plus(t7, t9);
            let t11 = t4.times_plus(c[1], c[0]);
            let t12 = t3.times_plus(c[2], t11);
            let t13 = p1.times_plus(t10, t12);
            let t14 = t3 * t4;
            let t15 = t14 * c[12];
            // ∂(S₁ + S₃)/∂p₁
            let t16 = p1.times_plus(t13, t15);
            let t17 = p1.times_plus(c[18], c[17]);
            let t18 = p1.times_plus(t17, c[2]);
            let t19 = t4 * c[16];
            let t20 = p1.times_plus(t18, t19);
            let t21 = t4.times_plus(c[14], c[13]);
            let t22 = t3.times_plus(c[15], t21);
            let t23 = p1.times_plus(t20, t22);
            // ∂(S₁ + S₃)/∂p₂
            let t24 = p2 * t23;
            let t25 = p1.times_plus(c[22], c[21]);
            let t26 = p1.times_plus(t25, c[1]);
            let t27 = t3 * c[16];
            let t28 = p1.times_plus(t26, t27);
            let t29 = t4.times_plus(c[20], c[19]);
            let t30 = t3.times_plus(c[14], t29);
            let t31 = p1.times_plus(t28, t30);
            // ∂(S₁ + S₃)/∂p₃
            let t32 = p3 * t31;
            <Vector<T> as ::core::convert::From<_>>::from([t16, t24, t32])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p1 = input[0];
            let t1 = p1.times_plus(c[11], c[10]);
            let t2 = p1.times_plus(t1, c[9]);
            let p2 = input[1];
            let t3 = p2 * p2;
            let p3 = input[2];
            let t4 = p3 * p3;
            let t5 = t4.times_plus(c[7], c[6]);
            let t6 = t3.times_plus(c[8], t5);
            let t7 = p1.times_plus(t2, t6);
            let t8 = t4.times_plus(c[4], c[3]);
            let t9 = t3.times_plus(c[5], t8);
            let t10 = p1.times_plus(t7, t9);
            let t11 = t4.times_plus(c[1], c[0]);
            let t12 = t3.times_plus(c[2], t11);
            let t13 = p1.times_plus(t10, t12);
            let t14 = t3 * t4;
            let t15 = t14 * c[12];
            // ∂S/∂p₁
            let t16 = p1.times_plus(t13, t15);
            let t17 = p1.times_plus(c[18], c[17]);
            let t18 = p1.times_plus(t17, c[2]);
            let t19 = t4 * c[16];
            let t20 = p1.times_plus(t18, t19);
            let t21 = t4.times_plus(c[14], c[13]);
            let t22 = t3.times_plus(c[15], t21);
            let t23 = p1.times_plus(t20, t22);
            // ∂S/∂p₂
            let t24 = p2 * t23;
            let t25 = p1.times_plus(c[22], c[21]);
            let t26 = p1.times_plus(t25, c[1]);
            let t27 = t3 * c[16];
            let t28 = p1.times_plus(t26, t27);
            let t29 = t4.times_plus(c[20], c[19]);
            let t30 = t3.times_plus(c[14], t29);
            let t31 = p1.times_plus(t28, t30);
            // ∂S/∂p₃
            let t32 = p3 * t31;
            let t33 = p1.times_plus(c[28], c[27]);
            let t34 = p1.times_plus(t33, c[26]);
            let t35 = t4.times_plus(c[24], c[23]);
            let t36 = t3.times_plus(c[25], t35);
            let t37 = p1.times_plus(t34, t36);
            let t38 = p1.times_plus(t37, t9);
            let t39 = p1 * t38;
            // ∂²(S₁ + S₃)/∂p₁²
            let t40 = t13 + t39;
            let t41 = p1.times_plus(c[25], c[30]);
            let t42 = p1.times_plus(t41, c[29]);
            let t43 = p1.times_plus(t42, t19);
            // ∂²(S₁ + S₃)/∂p₁∂p₂
            let t44 = p2 * t43;
            let t45 = p1.times_plus(c[24], c[32]);
            let t46 = p1.times_plus(t45, c[31]);
            let t47 = p1.times_plus(t46, t27);
            // ∂²(S₁ + S₃)/∂p₁∂p₃
            let t48 = p3 * t47;
            let t49 = t3 * c[33];
            // ∂²(S₁ + S₃)/∂p₂²
            let t50 = t23 + t49;
            let t51 = p2 * p3;
            let t52 = p1.times_plus(c[35], c[34]);
            // ∂²(S₁ + S₃)/∂p₂∂p₃
            let t53 = t51 * t52;
            let t54 = t4 * c[36];
            // ∂²(S₁ + S₃)/∂p₃²
            let t55 = t31 + t54;
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t16, t24, t32]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([[t40, t44, t48], [t44, t50, t53], [t48, t53, t55]]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let mu1 = input[0];
            let t1 = mu1 * mu1;
            let t2 = t1.times_plus(c[148], c[135]);
            let mu2 = input[1];
            let t3 = mu2 * mu2;
            let mu3 = input[2];
            let t4 = mu3 * mu3;
            let t5 = t4.times_plus(c[121], c[120]);
            let t6 = t3.times_plus(c[123], t5);
            let t7 = t1.times_plus(t2, t6);
            let t8 = mu2 * mu3;
            let t9 = t7 * t8;
            let t10 = t4.times_plus(c[154], c[153]);
            let t11 = t3.times_plus(c[155], t10);
            let t12 = t1.times_plus(c[157], t11);
            let t13 = t4.times_plus(c[147], c[146]);
            let t14 = t3.times_plus(c[149], t13);
            let t15 = t1.times_plus(t12, t14);
            let t16 = t4.times_plus(c[137], c[136]);
            let t17 = t3.times_plus(c[138], t16);
            let t18 = t4.times_plus(c[134], c[133]);
            let t19 = t4 * t18;
            let t20 = t3.times_plus(t17, t19);
            let t21 = t1.times_plus(t15, t20);
            let t22 = t3 * t4;
            let t23 = t4 * c[122];
            let t24 = t3.times_plus(c[124], t23);
            let t25 = t22 * t24;
            let t26 = t1.times_plus(t21, t25);
            let t27 = t9 + t26;
            let t28 = t1.times_plus(c[158], c[156]);
            let t29 = t4.times_plus(c[151], c[150]);
            let t30 = t3.times_plus(c[152], t29);
            let t31 = t1.times_plus(t28, t30);
            let t32 = t4.times_plus(c[144], c[143]);
            let t33 = t3.times_plus(c[145], t32);
            let t34 = t4.times_plus(c[141], c[140]);
            let t35 = t4.times_plus(t34, c[139]);
            let t36 = t3.times_plus(t33, t35);
            let t37 = t1.times_plus(t31, t36);
            let t38 = t4.times_plus(c[130], c[129]);
            let t39 = t3.times_plus(c[132], t38);
            let t40 = t4.times_plus(c[127], c[126]);
            let t41 = t4.times_plus(t40, c[125]);
            let t42 = t3.times_plus(t39, t41);
            let t43 = t1.times_plus(t37, t42);
            let t44 = mu1.times_plus(t43, t27);
            let t45 = t4 * c[128];
            let t46 = t3.times_plus(c[131], t45);
            let t47 = t1.times_plus(c[142], t46);
            let t48 = mu1 * mu2;
            let t49 = mu3 * t48;
            // p₁, the first guess
            let t50 = t47.times_plus(t49, t44);
            let t51 = t1.times_plus(c[197], c[195]);
            let t52 = t4.times_plus(c[188], c[187]);
            let t53 = t3.times_plus(c[189], t52);
            let t54 = t1.times_plus(t51, t53);
            let t55 = t4.times_plus(c[176], c[175]);
            let t56 = t3.times_plus(c[179], t55);
            let t57 = t3.times_plus(c[178], c[174]);
            let t58 = t4.times_plus(t56, t57);
            let t59 = t1.times_plus(t54, t58);
            let t60 = t4.times_plus(c[164], c[163]);
            let t61 = t3.times_plus(c[165], t60);
            let t62 = t4.times_plus(c[161], c[160]);
            let t63 = t4.times_plus(t62, c[159]);
            let t64 = t3.times_plus(t61, t63);
            let t65 = t1.times_plus(t59, t64);
            let t66 = mu2 * t65;
            let t67 = t1.times_plus(c[194], c[186]);
            let t68 = t4.times_plus(c[173], c[172]);
            let t69 = t3.times_plus(c[177], t68);
            let t70 = t1.times_plus(t67, t69);
            let t71 = t22 * c[162];
            let t72 = t1.times_plus(t70, t71);
            let t73 = mu3.times_plus(t72, t66);
            let t74 = t4.times_plus(c[181], c[180]);
            let t75 = t3.times_plus(c[184], t74);
            let t76 = t1.times_plus(c[190], t75);
            let t77 = t4.times_plus(c[167], c[166]);
            let t78 = t3.times_plus(c[170], t77);
            let t79 = t1.times_plus(t76, t78);
            let t80 = mu1 * mu3;
            let t81 = t79.times_plus(t80, t73);
            let t82 = t4.times_plus(c[192], c[191]);
            let t83 = t3.times_plus(c[193], t82);
            let t84 = t1.times_plus(c[196], t83);
            let t85 = t4.times_plus(c[183], c[182]);
            let t86 = t3.times_plus(c[185], t85);
            let t87 = t1.times_plus(t84, t86);
            let t88 = t4.times_plus(c[169], c[168]);
            let t89 = t3.times_plus(c[171], t88);
            let t90 = t4 * t89;
            let t91 = t1.times_plus(t87, t90);
            // p₂, the first guess
            let t92 = t48.times_plus(t91, t81);
            let t93 = t1.times_plus(c[236], c[233]);
            let t94 = t4.times_plus(c[226], c[225]);
            let t95 = t3.times_plus(c[228], t94);
            let t96 = t1.times_plus(t93, t95);
            let t97 = t4.times_plus(c[216], c[215]);
            let t98 = t3.times_plus(c[218], t97);
            let t99 = t4.times_plus(c[212], c[211]);
            let t100 = t3.times_plus(t98, t99);
            let t101 = t1.times_plus(t96, t100);
            let t102 = t4.times_plus(c[202], c[201]);
            let t103 = t3.times_plus(c[204], t102);
            let t104 = t4.times_plus(c[200], c[199]);
            let t105 = t4.times_plus(t104, c[198]);
            let t106 = t3.times_plus(t103, t105);
            let t107 = t1.times_plus(t101, t106);
            let t108 = mu3 * t107;
            let t109 = t1.times_plus(c[234], c[227]);
            let t110 = t4.times_plus(c[214], c[213]);
            let t111 = t3.times_plus(c[217], t110);
            let t112 = t1.times_plus(t109, t111);
            let t113 = t22 * c[203];
            let t114 = t1.times_plus(t112, t113);
            let t115 = mu2.times_plus(t114, t108);
            let t116 = t4.times_plus(c[222], c[221]);
            let t117 = t3.times_plus(c[224], t116);
            let t118 = t1.times_plus(c[231], t117);
            let t119 = t4.times_plus(c[206], c[205]);
            let t120 = t3.times_plus(c[209], t119);
            let t121 = t1.times_plus(t118, t120);
            let t122 = t48.times_plus(t121, t115);
            let t123 = t4.times_plus(c[230], c[229]);
            let t124 = t3.times_plus(c[232], t123);
            let t125 = t1.times_plus(c[235], t124);
            let t126 = t4.times_plus(c[220], c[219]);
            let t127 = t3.times_plus(c[223], t126);
            let t128 = t1.times_plus(t125, t127);
            let t129 = t4.times_plus(c[208], c[207]);
            let t130 = t3.times_plus(c[210], t129);
            let t131 = t3 * t130;
            let t132 = t1.times_plus(t128, t131);
            // p₃, the first guess
            let t133 = t80.times_plus(t132, t122);
            <Vector<T> as ::core::convert::From<_>>::from([t50, t92, t133])
        }
        #[inline(always)]
        fn predict_after(&self, last: &Vector<T>, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let twice_even = {
                let mu1 = input[0];
                let t1 = mu1.times_plus(c[67], c[66]);
                let t2 = mu1.times_plus(t1, c[65]);
                let mu2 = input[1];
                let t3 = mu2 * mu2;
                let mu3 = input[2];
                let t4 = mu3 * mu3;
                let t5 = t4.times_plus(c[63], c[62]);
                let t6 = t3.times_plus(c[64], t5);
                let t7 = mu1.times_plus(t2, t6);
                let t8 = t4.times_plus(c[60], c[59]);
                let t9 = t3.times_plus(c[61], t8);
                let t10 = mu1.times_plus(t7, t9);
                let t11 = t4.times_plus(c[57], c[56]);
                let t12 = t3.times_plus(c[58], t11);
                let t13 = mu1.times_plus(t10, t12);
                let t14 = t4.times_plus(c[54], c[53]);
                let t15 = t3.times_plus(c[55], t14);
                let t16 = t4.times_plus(c[52], c[51]);
                let t17 = t4.times_plus(t16, c[50]);
                let t18 = t3.times_plus(t15, t17);
                let t19 = mu1.times_plus(t13, t18);
                let t20 = t4.times_plus(c[48], c[47]);
                let t21 = t3.times_plus(c[49], t20);
                let t22 = t4.times_plus(c[46], c[45]);
                let t23 = t4 * t22;
                let t24 = t3.times_plus(t21, t23);
                let t25 = mu1.times_plus(t19, t24);
                let t26 = t4.times_plus(c[43], c[42]);
                let t27 = t3.times_plus(c[44], t26);
                let t28 = t4.times_plus(c[41], c[40]);
                let t29 = t4.times_plus(t28, c[39]);
                let t30 = t3.times_plus(t27, t29);
                let t31 = mu1.times_plus(t25, t30);
                let t32 = t3 * t4;
                let t33 = t4 * c[37];
                let t34 = t3.times_plus(c[38], t33);
                let t35 = t32 * t34;
                // twice the part of p₁ that is even in h
                let t36 = mu1.times_plus(t31, t35);
                let t37 = mu1.times_plus(c[93], c[92]);
                let t38 = mu1.times_plus(t37, c[91]);
                let t39 = t4.times_plus(c[89], c[88]);
                let t40 = t3.times_plus(c[90], t39);
                let t41 = mu1.times_plus(t38, t40);
                let t42 = t4.times_plus(c[86], c[85]);
                let t43 = t3.times_plus(c[87], t42);
                let t44 = mu1.times_plus(t41, t43);
                let t45 = t4.times_plus(c[83], c[82]);
                let t46 = t3.times_plus(c[84], t45);
                let t47 = mu1.times_plus(t44, t46);
                let t48 = t4.times_plus(c[79], c[78]);
                let t49 = t3.times_plus(c[81], t48);
                let t50 = t3.times_plus(c[80], c[77]);
                let t51 = t4.times_plus(t49, t50);
                let t52 = mu1.times_plus(t47, t51);
                let t53 = t4.times_plus(c[75], c[74]);
                let t54 = t3.times_plus(c[76], t53);
                let t55 = t4 * t54;
                let t56 = mu1.times_plus(t52, t55);
                let t57 = t4.times_plus(c[72], c[71]);
                let t58 = t3.times_plus(c[73], t57);
                let t59 = t4.times_plus(c[70], c[69]);
                let t60 = t4.times_plus(t59, c[68]);
                let t61 = t3.times_plus(t58, t60);
                let t62 = mu1.times_plus(t56, t61);
                // twice the part of p₂ that is even in h
                let t63 = mu2 * t62;
                let t64 = mu1.times_plus(c[119], c[118]);
                let t65 = mu1.times_plus(t64, c[117]);
                let t66 = t4.times_plus(c[115], c[114]);
                let t67 = t3.times_plus(c[116], t66);
                let t68 = mu1.times_plus(t65, t67);
                let t69 = t4.times_plus(c[112], c[111]);
                let t70 = t3.times_plus(c[113], t69);
                let t71 = mu1.times_plus(t68, t70);
                let t72 = t4.times_plus(c[109], c[108]);
                let t73 = t3.times_plus(c[110], t72);
                let t74 = mu1.times_plus(t71, t73);
                let t75 = t4.times_plus(c[106], c[105]);
                let t76 = t3.times_plus(c[107], t75);
                let t77 = t4.times_plus(c[104], c[103]);
                let t78 = t3.times_plus(t76, t77);
                let t79 = mu1.times_plus(t74, t78);
                let t80 = t4.times_plus(c[101], c[100]);
                let t81 = t3.times_plus(c[102], t80);
                let t82 = t3 * t81;
                let t83 = mu1.times_plus(t79, t82);
                let t84 = t4.times_plus(c[98], c[97]);
                let t85 = t3.times_plus(c[99], t84);
                let t86 = t4.times_plus(c[96], c[95]);
                let t87 = t4.times_plus(t86, c[94]);
                let t88 = t3.times_plus(t85, t87);
                let t89 = mu1.times_plus(t83, t88);
                // twice the part of p₃ that is even in h
                let t90 = mu3 * t89;
                <Vector<T> as ::core::convert::From<_>>::from([t36, t63, t90])
            };
            twice_even - last
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for CayleyBody<T> {
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
    impl ::coadjoint::Lanes for CayleyBody<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = CayleyBody<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> CayleyBody<L> {
            CayleyBody {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> CayleyBody<T> {
        fn table() -> &'static ::coadjoint::plumbing::Table {
            &TABLE
        }
    }
    /// All coefficients as data. A base is Σ h^power Σ factor · product, a slot `c[i]` a base
    /// times an integer.
    static TABLE: ::coadjoint::plumbing::Table = ::coadjoint::plumbing::Table {
        /// Products of symbols: an earlier one times a symbol; number 0 is 1.
        products: &[],
        /// Factor, and the number of its product.
        terms: &[
            (0.2, 0), (0.005333333333333333, 0), (0.25, 0), (0.015277777777777777, 0),
            (0.010416666666666666, 0), (0.00025, 0), (0.3333333333333333, 0),
            (0.025185185185185185, 0), (0.03287037037037037, 0), (0.1, 0),
            (0.020666666666666667, 0), (0.024583333333333332, 0), (0.024691358024691357, 0),
            (0.004875, 0), (0.00525, 0), (0.03333333333333333, 0), (0.015, 0), (0.00225, 0),
            (0.2, 0), (0.25, 0), (0.3333333333333333, 0), (0.1, 0), (-0.05, 0),
            (0.0035555555555555557, 0), (-0.0001125, 0), (0.004027777777777778, 0), (-0.0001125, 0),
            (1.0, 0), (-0.07333333333333333, 0), (0.0016444444444444445, 0), (0.0035, 0),
            (-0.07916666666666666, 0), (0.0034814814814814817, 0), (0.00325, 0),
            (0.001857638888888889, 0), (-0.0375, 0), (0.00155, 0), (0.007037037037037037, 0),
            (-0.03, 0), (0.0015979166666666668, 0), (0.0008125, 0), (-0.1111111111111111, 0),
            (0.0057777777777777775, 0), (0.0003375, 0), (0.014333333333333333, 0),
            (0.005648148148148148, 0), (-0.000675, 0), (-0.0003375, 0), (-0.1, 0),
            (0.00901111111111111, 0), (0.006375, 0), (0.0065138888888888885, 0), (-0.0225, 0),
            (0.00411522633744856, 0), (0.005125, 0), (0.00183125, 0), (0.007407407407407408, 0),
            (0.00106875, 0), (-0.00005625, 0), (0.005, 0), (0.0015, 0), (0.00016875, 0), (1.0, 0),
            (-0.056666666666666664, 0), (0.0011259259259259258, 0), (0.0005, 0), (-0.0625, 0),
            (0.002462962962962963, 0), (0.0013020833333333333, 0), (0.13333333333333333, 0),
            (-0.00725925925925926, 0), (-0.015, 0), (0.0008666666666666666, 0),
            (-0.006851851851851852, 0), (0.0004375, 0), (0.15, 0), (-0.0095, 0),
            (-0.09444444444444444, 0), (0.004419753086419753, 0), (0.0001875, 0), (-0.00125, 0),
            (0.004104938271604938, 0), (-0.0005625, 0), (-0.012098765432098766, 0), (-0.0015, 0),
            (-0.07, 0), (0.007005555555555556, 0), (0.006, 0), (0.0031180555555555558, 0),
            (-0.0215, 0), (-0.0225, 0), (0.0031275720164609055, 0), (0.00531875, 0), (0.0005, 0),
            (-0.010875, 0), (0.004824074074074074, 0), (0.001575, 0), (-0.00045, 0), (-0.00225, 0),
            (0.00333125, 0), (0.00110625, 0), (0.00016875, 0), (1.0, 0), (-0.04, 0),
            (0.0005333333333333334, 0), (-0.04583333333333333, 0), (0.0011296296296296297, 0),
            (-0.0005, 0), (0.0005613425925925926, 0), (-0.08333333333333333, 0),
            (0.004814814814814815, 0), (0.015, 0), (-0.0011375, 0), (0.003935185185185185, 0),
            (-0.0007083333333333334, 0), (-0.07777777777777778, 0), (0.0023209876543209876, 0),
            (-0.15, 0), (0.01425, 0), (0.0019135802469135803, 0), (-0.0005625, 0), (0.00625, 0),
            (0.0001875, 0), (-0.0625, 0), (0.0027944444444444444, 0), (0.006172839506172839, 0),
            (0.006, 0), (-0.0007118055555555556, 0), (-0.0015, 0), (-0.0225, 0),
            (0.0017695473251028806, 0), (0.00195625, 0), (0.015416666666666667, 0), (-0.0025625, 0),
            (0.0027407407407407406, 0), (0.00045, 0), (0.009, 0), (-0.001575, 0), (0.00216875, 0),
            (0.00225, 0), (0.00088125, 0), (0.00016875, 0),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (3, 2), (1, 3), (3, 4), (3, 5), (3, 6), (1, 7), (3, 8), (3, 9), (1, 10),
            (3, 11), (3, 12), (3, 13), (3, 14), (3, 15), (3, 16), (3, 17), (3, 18), (0, 19),
            (0, 20), (0, 21), (0, 22), (1, 23), (3, 24), (4, 25), (3, 26), (4, 27), (0, 28),
            (2, 29), (4, 30), (3, 31), (2, 32), (4, 33), (3, 34), (4, 35), (2, 36), (4, 37),
            (3, 38), (2, 39), (4, 40), (4, 41), (2, 42), (4, 43), (4, 44), (3, 45), (4, 46),
            (4, 47), (4, 48), (2, 49), (4, 50), (3, 51), (4, 52), (2, 53), (4, 54), (4, 55),
            (4, 56), (4, 57), (4, 58), (4, 59), (4, 60), (4, 61), (4, 62), (0, 63), (2, 64),
            (4, 65), (3, 66), (2, 67), (4, 68), (4, 69), (1, 70), (3, 71), (2, 72), (4, 73),
            (3, 74), (4, 75), (1, 76), (3, 77), (2, 78), (4, 79), (4, 80), (3, 81), (4, 82),
            (4, 83), (3, 84), (3, 85), (2, 86), (4, 87), (3, 88), (4, 89), (3, 90), (2, 91),
            (4, 92), (4, 93), (4, 94), (3, 95), (4, 96), (4, 97), (4, 98), (3, 99), (4, 100),
            (4, 101), (4, 102), (0, 103), (2, 104), (4, 105), (2, 106), (4, 107), (3, 108),
            (4, 109), (1, 110), (3, 111), (2, 112), (4, 113), (3, 114), (4, 115), (2, 116),
            (4, 117), (1, 118), (3, 119), (4, 120), (4, 121), (3, 122), (4, 123), (2, 124),
            (4, 125), (3, 126), (3, 127), (4, 128), (3, 129), (2, 130), (4, 131), (4, 132),
            (3, 133), (4, 134), (4, 135), (4, 136), (3, 137), (4, 138), (4, 139), (3, 140),
            (4, 141), (4, 142),
        ],
        /// Where the parts of each base end.
        bases: &[
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
            22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
            41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 54, 55, 56, 57, 58, 59, 60,
            61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79,
            80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 92, 93, 94, 95, 96, 97, 98, 99,
            100, 101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111, 112, 113, 114,
            115, 116, 117, 118, 119, 120, 121, 122, 123, 124, 125, 126, 127, 128, 129,
            131, 132, 133, 134, 135, 136, 137, 138, 139, 140, 141, 142,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (6, 2), (7, 2), (8, 2), (9, 3), (10, 3), (11, 3), (12, 4), (13, 4), (14, 4), (15, 5),
            (16, 6), (17, 7), (5, 1), (2, 2), (3, 2), (4, 4), (5, 2), (11, 2), (14, 2), (0, 2),
            (1, 4), (10, 2), (13, 2), (12, 8), (13, 8), (14, 8), (15, 15), (16, 24), (17, 35),
            (8, 4), (11, 6), (7, 4), (10, 6), (4, 8), (3, 4), (5, 4), (1, 8), (24, 2), (26, 2),
            (27, 2), (28, 2), (29, 2), (31, 2), (32, 2), (34, 2), (35, 2), (36, 2), (38, 2),
            (39, 2), (40, 2), (41, 2), (42, 2), (43, 2), (45, 2), (46, 2), (47, 2), (48, 2),
            (49, 2), (51, 2), (52, 2), (53, 2), (54, 2), (55, 2), (56, 2), (57, 2), (58, 2),
            (59, 2), (60, 2), (61, 2), (62, 2), (63, 2), (65, 2), (66, 2), (67, 2), (70, 2),
            (71, 2), (73, 2), (76, 2), (77, 2), (78, 2), (80, 2), (81, 2), (84, 2), (85, 2),
            (87, 2), (89, 2), (90, 2), (91, 2), (93, 2), (94, 2), (95, 2), (97, 2), (98, 2),
            (99, 2), (100, 2), (101, 2), (102, 2), (103, 2), (104, 2), (106, 2), (109, 2), (110, 2),
            (112, 2), (113, 2), (114, 2), (117, 2), (118, 2), (120, 2), (121, 2), (122, 2),
            (125, 2), (127, 2), (128, 2), (130, 2), (131, 2), (132, 2), (134, 2), (135, 2),
            (137, 2), (138, 2), (22, 1), (23, 1), (24, 1), (25, 1), (26, 1), (27, 1), (28, 1),
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
            (133, 1), (134, 1), (135, 1), (136, 1), (137, 1), (138, 1), (0, 1), (1, 1), (2, 1),
            (3, 1), (4, 1), (6, 1), (7, 1), (8, 1), (9, 1), (10, 1), (11, 1), (12, 1), (13, 1),
            (14, 1), (15, 1), (16, 1), (17, 1), (18, 1), (19, 1), (20, 1), (21, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[(2, 2)], &[(2, 4)], &[(1, 2)], &[(1, 2), (2, 2)], &[(1, 4)],
            &[(0, 1), (1, 2), (2, 2)], &[(0, 2)], &[(0, 2), (2, 2)], &[(0, 2), (1, 2)], &[(0, 3)],
            &[(0, 3), (2, 2)], &[(0, 3), (1, 2)], &[(0, 4)], &[(0, 4), (2, 2)], &[(0, 4), (1, 2)],
            &[(0, 5)], &[(0, 6)], &[(0, 7)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[
            (24, 0, &[(1, 2), (2, 4)]), (26, 0, &[(1, 4), (2, 2)]), (27, 0, &[(0, 1)]),
            (28, 0, &[(0, 1), (2, 2)]), (29, 0, &[(0, 1), (2, 4)]), (31, 0, &[(0, 1), (1, 2)]),
            (32, 0, &[(0, 1), (1, 2), (2, 2)]), (34, 0, &[(0, 1), (1, 4)]),
            (35, 0, &[(0, 2), (2, 2)]), (36, 0, &[(0, 2), (2, 4)]), (38, 0, &[(0, 2), (1, 2)]),
            (39, 0, &[(0, 2), (1, 2), (2, 2)]), (40, 0, &[(0, 2), (1, 4)]), (41, 0, &[(0, 3)]),
            (42, 0, &[(0, 3), (2, 2)]), (43, 0, &[(0, 3), (2, 4)]), (45, 0, &[(0, 3), (1, 2)]),
            (46, 0, &[(0, 3), (1, 2), (2, 2)]), (47, 0, &[(0, 3), (1, 4)]), (48, 0, &[(0, 4)]),
            (49, 0, &[(0, 4), (2, 2)]), (51, 0, &[(0, 4), (1, 2)]), (52, 0, &[(0, 5)]),
            (53, 0, &[(0, 5), (2, 2)]), (54, 0, &[(0, 5), (1, 2)]), (55, 0, &[(0, 6)]),
            (56, 0, &[(0, 6), (2, 2)]), (57, 0, &[(0, 6), (1, 2)]), (58, 0, &[(0, 7)]),
            (59, 0, &[(0, 8)]), (60, 0, &[(0, 9)]), (61, 1, &[(1, 1)]), (62, 1, &[(1, 1), (2, 2)]),
            (63, 1, &[(1, 1), (2, 4)]), (65, 1, &[(1, 3)]), (66, 1, &[(1, 3), (2, 2)]),
            (67, 1, &[(1, 5)]), (70, 1, &[(0, 1), (1, 1), (2, 2)]),
            (71, 1, &[(0, 1), (1, 1), (2, 4)]), (73, 1, &[(0, 1), (1, 3), (2, 2)]),
            (76, 1, &[(0, 2), (1, 1)]), (77, 1, &[(0, 2), (1, 1), (2, 2)]),
            (78, 1, &[(0, 2), (1, 1), (2, 4)]), (80, 1, &[(0, 2), (1, 3)]),
            (81, 1, &[(0, 2), (1, 3), (2, 2)]), (84, 1, &[(0, 3), (1, 1)]),
            (85, 1, &[(0, 3), (1, 1), (2, 2)]), (87, 1, &[(0, 3), (1, 3)]),
            (89, 1, &[(0, 4), (1, 1)]), (90, 1, &[(0, 4), (1, 1), (2, 2)]),
            (91, 1, &[(0, 4), (1, 3)]), (93, 1, &[(0, 5), (1, 1)]),
            (94, 1, &[(0, 5), (1, 1), (2, 2)]), (95, 1, &[(0, 5), (1, 3)]),
            (97, 1, &[(0, 6), (1, 1)]), (98, 1, &[(0, 7), (1, 1)]), (99, 1, &[(0, 8), (1, 1)]),
            (100, 2, &[(2, 1)]), (101, 2, &[(2, 3)]), (102, 2, &[(2, 5)]),
            (103, 2, &[(1, 2), (2, 1)]), (104, 2, &[(1, 2), (2, 3)]), (106, 2, &[(1, 4), (2, 1)]),
            (109, 2, &[(0, 1), (1, 2), (2, 1)]), (110, 2, &[(0, 1), (1, 2), (2, 3)]),
            (112, 2, &[(0, 1), (1, 4), (2, 1)]), (113, 2, &[(0, 2), (2, 1)]),
            (114, 2, &[(0, 2), (2, 3)]), (117, 2, &[(0, 2), (1, 2), (2, 1)]),
            (118, 2, &[(0, 2), (1, 2), (2, 3)]), (120, 2, &[(0, 2), (1, 4), (2, 1)]),
            (121, 2, &[(0, 3), (2, 1)]), (122, 2, &[(0, 3), (2, 3)]),
            (125, 2, &[(0, 3), (1, 2), (2, 1)]), (127, 2, &[(0, 4), (2, 1)]),
            (128, 2, &[(0, 4), (2, 3)]), (130, 2, &[(0, 4), (1, 2), (2, 1)]),
            (131, 2, &[(0, 5), (2, 1)]), (132, 2, &[(0, 5), (2, 3)]),
            (134, 2, &[(0, 5), (1, 2), (2, 1)]), (135, 2, &[(0, 6), (2, 1)]),
            (137, 2, &[(0, 7), (2, 1)]), (138, 2, &[(0, 8), (2, 1)]),
        ],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₃²), of S₃
// c[2] = 2 C(p₁² p₂²), of S₃
// c[3] = 3 C(p₁³), of S₁
// c[4] = 3 C(p₁³ p₃²), of S₃
// c[5] = 3 C(p₁³ p₂²), of S₃
// c[6] = 4 C(p₁⁴), of S₃
// c[7] = 4 C(p₁⁴ p₃²), of S₃
// c[8] = 4 C(p₁⁴ p₂²), of S₃
// c[9] = 5 C(p₁⁵), of S₃
// c[10] = 6 C(p₁⁶), of S₃
// c[11] = 7 C(p₁⁷), of S₃
// c[12] = C(p₁ p₂² p₃²), of S₃
// c[13] = 2 C(p₂²), of S₁
// c[14] = 2 C(p₂² p₃²), of S₃
// c[15] = 4 C(p₂⁴), of S₃
// c[16] = 2 C(p₁ p₂² p₃²), of S₃
// c[17] = 2 C(p₁³ p₂²), of S₃
// c[18] = 2 C(p₁⁴ p₂²), of S₃
// c[19] = 2 C(p₃²), of S₁
// c[20] = 4 C(p₃⁴), of S₃
// c[21] = 2 C(p₁³ p₃²), of S₃
// c[22] = 2 C(p₁⁴ p₃²), of S₃
// c[23] = 8 C(p₁⁴), of S₃
// c[24] = 8 C(p₁⁴ p₃²), of S₃
// c[25] = 8 C(p₁⁴ p₂²), of S₃
// c[26] = 15 C(p₁⁵), of S₃
// c[27] = 24 C(p₁⁶), of S₃
// c[28] = 35 C(p₁⁷), of S₃
// c[29] = 4 C(p₁² p₂²), of S₃
// c[30] = 6 C(p₁³ p₂²), of S₃
// c[31] = 4 C(p₁² p₃²), of S₃
// c[32] = 6 C(p₁³ p₃²), of S₃
// c[33] = 8 C(p₂⁴), of S₃
// c[34] = 4 C(p₂² p₃²), of S₃
// c[35] = 4 C(p₁ p₂² p₃²), of S₃
// c[36] = 8 C(p₃⁴), of S₃
// c[237] = C(p₃²), of S₁
// c[238] = C(p₃⁴), of S₃
// c[239] = C(p₂²), of S₁
// c[240] = C(p₂² p₃²), of S₃
// c[241] = C(p₂⁴), of S₃
// c[242] = C(p₁²), of S₁
// c[243] = C(p₁² p₃²), of S₃
// c[244] = C(p₁² p₂²), of S₃
// c[245] = C(p₁³), of S₁
// c[246] = C(p₁³ p₃²), of S₃
// c[247] = C(p₁³ p₂²), of S₃
// c[248] = C(p₁⁴), of S₃
// c[249] = C(p₁⁴ p₃²), of S₃
// c[250] = C(p₁⁴ p₂²), of S₃
// c[251] = C(p₁⁵), of S₃
// c[252] = C(p₁⁶), of S₃
// c[253] = C(p₁⁷), of S₃
