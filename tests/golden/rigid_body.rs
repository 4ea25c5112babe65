// rigid_body: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `let [x, y, z] = mu; 0.5 * (x * x / 1.5 + y * y / 2.0 + z * z / 2.5)`
//
// Group: SO3. Chart exp, truncation K = 9, order of accuracy 10.
// Terms: S1: 3, S3: 3, S5: 7, S7: 12, S9: 18.
// Operations: gradient and Hessian 146 multiplications and 131 additions; predictor of degree 8 159 and 150.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `let [x, y, z] = mu; 0.5 * (x * x / 1.5 + y * y / 2.0 + z * z / 2.5)`
///
/// Group: SO3. Chart exp, truncation K = 9, order of accuracy 10.
/// Terms: S1: 3, S3: 3, S5: 7, S7: 12, S9: 18.
/// Operations: gradient and Hessian 146 multiplications and 131 additions; predictor of degree 8 159 and 150.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct RigidBody<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 438],
    /// A bound on the part of the Hessian that Newton's method leaves out, by degree.
    defect: [T; 9],
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
    impl<T: ::coadjoint::Scalar> RigidBody<T> {
        /// K: the series S₁ … S_K of the generating function is kept.
        pub const TRUNCATION: usize = 9;
        /// The order of accuracy, K + 1.
        pub const ORDER: usize = 10;
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
        ) -> ::core::result::Result<[T; 199], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                10,
                1,
                199,
            >(Self::table(), &[], step, symbols)
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 199],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                10,
                199,
                199,
                438,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 438]) -> Self {
            let defect = ::coadjoint::plumbing::bound::<
                T,
                9,
            >(
                &coefficients,
                &[
                    (146, 9.451143358184197, 8), (147, 3.5769946345638064, 8),
                    (148, 3.5769946345638064, 8), (149, 9.451143358184197, 8),
                    (150, 9.451143358184197, 8), (151, 1.1238480402831414, 8),
                    (152, 0.5608172632095823, 8), (153, 1.1238480402831414, 8),
                    (154, 9.451143358184197, 8), (155, 3.5769946345638064, 8),
                    (156, 0.5608172632095823, 8), (157, 0.5608172632095823, 8),
                    (158, 3.5769946345638064, 8), (159, 3.5769946345638064, 8),
                    (160, 1.1238480402831414, 8), (161, 3.5769946345638064, 8),
                    (162, 9.451143358184197, 8), (163, 9.451143358184197, 8),
                ],
            );
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
            let mu2 = input[1];
            let t2 = mu2 * mu2;
            let mu3 = input[2];
            let t3 = mu3 * mu3;
            let t4 = t3 * c[435];
            let t5 = t2.times_plus(c[436], t4);
            // H_red(μ)
            let t6 = t1.times_plus(c[437], t5);
            t6
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for RigidBody<T> {
        type Group = ::coadjoint::SO3<T>;
        type Chart = ::coadjoint::Exponential;
        #[inline(always)]
        fn group(&self) -> &::coadjoint::SO3<T> {
            const { &<::coadjoint::SO3<T>>::new() }
        }
        #[inline]
        fn value(&self, input: &Vector<T>) -> T {
            let c = &self.coefficients;
            let p1 = input[0];
            let t1 = p1 * p1;
            let p2 = input[1];
            let t2 = p2 * p2;
            let p3 = input[2];
            let t3 = p3 * p3;
            let t4 = t3.times_plus(c[160], c[434]);
            let t5 = t2.times_plus(c[161], t4);
            let t6 = t1.times_plus(c[163], t5);
            let t7 = t3.times_plus(c[157], c[432]);
            let t8 = t2.times_plus(c[158], t7);
            let t9 = t3.times_plus(c[156], c[431]);
            let t10 = t3.times_plus(t9, c[430]);
            let t11 = t2.times_plus(t8, t10);
            let t12 = t1.times_plus(t6, t11);
            let t13 = t3.times_plus(c[153], c[427]);
            let t14 = t2.times_plus(c[154], t13);
            let t15 = t3.times_plus(c[152], c[426]);
            let t16 = t3.times_plus(t15, c[425]);
            let t17 = t2.times_plus(t14, t16);
            let t18 = t3.times_plus(c[151], c[424]);
            let t19 = t3.times_plus(t18, c[423]);
            let t20 = t3.times_plus(t19, c[422]);
            let t21 = t2.times_plus(t17, t20);
            let t22 = t1.times_plus(t12, t21);
            let t23 = t3.times_plus(c[159], c[433]);
            let t24 = t1.times_plus(c[162], t23);
            let t25 = t3.times_plus(c[155], c[429]);
            let t26 = t3.times_plus(t25, c[428]);
            let t27 = t1.times_plus(t24, t26);
            let t28 = t3.times_plus(c[150], c[421]);
            let t29 = t3.times_plus(t28, c[420]);
            let t30 = t3.times_plus(t29, c[419]);
            let t31 = t1.times_plus(t27, t30);
            let t32 = t3.times_plus(t31, c[418]);
            let t33 = t2.times_plus(t22, t32);
            let t34 = t3.times_plus(c[148], c[417]);
            let t35 = t2.times_plus(c[149], t34);
            let t36 = t3.times_plus(c[147], c[416]);
            let t37 = t3.times_plus(t36, c[415]);
            let t38 = t2.times_plus(t35, t37);
            let t39 = t3.times_plus(c[146], c[414]);
            let t40 = t3.times_plus(t39, c[413]);
            let t41 = t3.times_plus(t40, c[412]);
            let t42 = t2.times_plus(t38, t41);
            let t43 = t3.times_plus(t42, c[411]);
            let t44 = t3 * c[410];
            let t45 = t2.times_plus(t43, t44);
            // S(p)
            let t46 = t1.times_plus(t33, t45);
            t46
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p2 = input[1];
            let t1 = p2 * p2;
            let p1 = input[0];
            let t2 = p1 * p1;
            let p3 = input[2];
            let t3 = p3 * p3;
            let t4 = t3.times_plus(c[27], c[26]);
            let t5 = t1.times_plus(c[28], t4);
            let t6 = t2.times_plus(c[30], t5);
            let t7 = t3.times_plus(c[22], c[21]);
            let t8 = t1.times_plus(c[23], t7);
            let t9 = t3.times_plus(c[20], c[19]);
            let t10 = t3.times_plus(t9, c[18]);
            let t11 = t1.times_plus(t8, t10);
            let t12 = t2.times_plus(t6, t11);
            let t13 = t3.times_plus(c[13], c[12]);
            let t14 = t1.times_plus(c[14], t13);
            let t15 = t3.times_plus(c[11], c[10]);
            let t16 = t3.times_plus(t15, c[9]);
            let t17 = t1.times_plus(t14, t16);
            let t18 = t3.times_plus(c[8], c[7]);
            let t19 = t3.times_plus(t18, c[6]);
            let t20 = t3.times_plus(t19, c[5]);
            let t21 = t1.times_plus(t17, t20);
            let t22 = t2.times_plus(t12, t21);
            let t23 = t3.times_plus(c[25], c[24]);
            let t24 = t2.times_plus(c[29], t23);
            let t25 = t3.times_plus(c[17], c[16]);
            let t26 = t3.times_plus(t25, c[15]);
            let t27 = t2.times_plus(t24, t26);
            let t28 = t3.times_plus(c[4], c[3]);
            let t29 = t3.times_plus(t28, c[2]);
            let t30 = t3.times_plus(t29, c[1]);
            let t31 = t2.times_plus(t27, t30);
            let t32 = t3.times_plus(t31, c[0]);
            let t33 = t1.times_plus(t22, t32);
            // ∂(S₁ + … + S₉)/∂p₁
            let t34 = p1 * t33;
            let t35 = t3.times_plus(c[53], c[52]);
            let t36 = t1.times_plus(c[54], t35);
            let t37 = t2.times_plus(c[55], t36);
            let t38 = t1.times_plus(c[51], t7);
            let t39 = t3.times_plus(c[50], c[49]);
            let t40 = t3.times_plus(t39, c[48]);
            let t41 = t1.times_plus(t38, t40);
            let t42 = t2.times_plus(t37, t41);
            let t43 = t3.times_plus(c[46], c[45]);
            let t44 = t1.times_plus(c[47], t43);
            let t45 = t3.times_plus(c[44], c[43]);
            let t46 = t3.times_plus(t45, c[42]);
            let t47 = t1.times_plus(t44, t46);
            let t48 = t1.times_plus(t47, t20);
            let t49 = t2.times_plus(t42, t48);
            let t50 = t3.times_plus(c[40], c[39]);
            let t51 = t1.times_plus(c[41], t50);
            let t52 = t3.times_plus(c[38], c[37]);
            let t53 = t3.times_plus(t52, c[36]);
            let t54 = t1.times_plus(t51, t53);
            let t55 = t3.times_plus(c[35], c[34]);
            let t56 = t3.times_plus(t55, c[33]);
            let t57 = t3.times_plus(t56, c[32]);
            let t58 = t1.times_plus(t54, t57);
            let t59 = t3.times_plus(t58, c[31]);
            let t60 = t2.times_plus(t49, t59);
            // ∂(S₁ + … + S₉)/∂p₂
            let t61 = p2 * t60;
            let t62 = t3.times_plus(c[74], c[73]);
            let t63 = t1.times_plus(c[53], t62);
            let t64 = t2.times_plus(c[75], t63);
            let t65 = t3.times_plus(c[20], c[49]);
            let t66 = t1.times_plus(c[72], t65);
            let t67 = t3.times_plus(c[71], c[16]);
            let t68 = t3.times_plus(t67, c[70]);
            let t69 = t1.times_plus(t66, t68);
            let t70 = t2.times_plus(t64, t69);
            let t71 = t3.times_plus(c[44], c[10]);
            let t72 = t1.times_plus(c[13], t71);
            let t73 = t3.times_plus(c[69], c[68]);
            let t74 = t3.times_plus(t73, c[6]);
            let t75 = t1.times_plus(t72, t74);
            let t76 = t3.times_plus(c[67], c[66]);
            let t77 = t3.times_plus(t76, c[65]);
            let t78 = t3.times_plus(t77, c[1]);
            let t79 = t1.times_plus(t75, t78);
            let t80 = t2.times_plus(t70, t79);
            let t81 = t3.times_plus(c[63], c[62]);
            let t82 = t1.times_plus(c[64], t81);
            let t83 = t3.times_plus(c[61], c[37]);
            let t84 = t3.times_plus(t83, c[60]);
            let t85 = t1.times_plus(t82, t84);
            let t86 = t3.times_plus(c[59], c[58]);
            let t87 = t3.times_plus(t86, c[57]);
            let t88 = t3.times_plus(t87, c[32]);
            let t89 = t1.times_plus(t85, t88);
            let t90 = t1.times_plus(t89, c[56]);
            let t91 = t2.times_plus(t80, t90);
            // ∂(S₁ + … + S₉)/∂p₃
            let t92 = p3 * t91;
            <Vector<T> as ::core::convert::From<_>>::from([t34, t61, t92])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p2 = input[1];
            let t1 = p2 * p2;
            let p1 = input[0];
            let t2 = p1 * p1;
            let p3 = input[2];
            let t3 = p3 * p3;
            let t4 = t3.times_plus(c[27], c[26]);
            let t5 = t1.times_plus(c[28], t4);
            let t6 = t2.times_plus(c[30], t5);
            let t7 = t3.times_plus(c[22], c[21]);
            let t8 = t1.times_plus(c[23], t7);
            let t9 = t3.times_plus(c[20], c[19]);
            let t10 = t3.times_plus(t9, c[18]);
            let t11 = t1.times_plus(t8, t10);
            let t12 = t2.times_plus(t6, t11);
            let t13 = t3.times_plus(c[13], c[12]);
            let t14 = t1.times_plus(c[14], t13);
            let t15 = t3.times_plus(c[11], c[10]);
            let t16 = t3.times_plus(t15, c[9]);
            let t17 = t1.times_plus(t14, t16);
            let t18 = t3.times_plus(c[8], c[7]);
            let t19 = t3.times_plus(t18, c[6]);
            let t20 = t3.times_plus(t19, c[5]);
            let t21 = t1.times_plus(t17, t20);
            let t22 = t2.times_plus(t12, t21);
            let t23 = t3.times_plus(c[25], c[24]);
            let t24 = t2.times_plus(c[29], t23);
            let t25 = t3.times_plus(c[17], c[16]);
            let t26 = t3.times_plus(t25, c[15]);
            let t27 = t2.times_plus(t24, t26);
            let t28 = t3.times_plus(c[4], c[3]);
            let t29 = t3.times_plus(t28, c[2]);
            let t30 = t3.times_plus(t29, c[1]);
            let t31 = t2.times_plus(t27, t30);
            let t32 = t3.times_plus(t31, c[0]);
            let t33 = t1.times_plus(t22, t32);
            // ∂S/∂p₁
            let t34 = p1 * t33;
            let t35 = t3.times_plus(c[53], c[52]);
            let t36 = t1.times_plus(c[54], t35);
            let t37 = t2.times_plus(c[55], t36);
            let t38 = t1.times_plus(c[51], t7);
            let t39 = t3.times_plus(c[50], c[49]);
            let t40 = t3.times_plus(t39, c[48]);
            let t41 = t1.times_plus(t38, t40);
            let t42 = t2.times_plus(t37, t41);
            let t43 = t3.times_plus(c[46], c[45]);
            let t44 = t1.times_plus(c[47], t43);
            let t45 = t3.times_plus(c[44], c[43]);
            let t46 = t3.times_plus(t45, c[42]);
            let t47 = t1.times_plus(t44, t46);
            let t48 = t1.times_plus(t47, t20);
            let t49 = t2.times_plus(t42, t48);
            let t50 = t3.times_plus(c[40], c[39]);
            let t51 = t1.times_plus(c[41], t50);
            let t52 = t3.times_plus(c[38], c[37]);
            let t53 = t3.times_plus(t52, c[36]);
            let t54 = t1.times_plus(t51, t53);
            let t55 = t3.times_plus(c[35], c[34]);
            let t56 = t3.times_plus(t55, c[33]);
            let t57 = t3.times_plus(t56, c[32]);
            let t58 = t1.times_plus(t54, t57);
            let t59 = t3.times_plus(t58, c[31]);
            let t60 = t2.times_plus(t49, t59);
            // ∂S/∂p₂
            let t61 = p2 * t60;
            let t62 = t3.times_plus(c[74], c[73]);
            let t63 = t1.times_plus(c[53], t62);
            let t64 = t2.times_plus(c[75], t63);
            let t65 = t3.times_plus(c[20], c[49]);
            let t66 = t1.times_plus(c[72], t65);
            let t67 = t3.times_plus(c[71], c[16]);
            let t68 = t3.times_plus(t67, c[70]);
            let t69 = t1.times_plus(t66, t68);
            let t70 = t2.times_plus(t64, t69);
            let t71 = t3.times_plus(c[44], c[10]);
            let t72 = t1.times_plus(c[13], t71);
            let t73 = t3.times_plus(c[69], c[68]);
            let t74 = t3.times_plus(t73, c[6]);
            let t75 = t1.times_plus(t72, t74);
            let t76 = t3.times_plus(c[67], c[66]);
            let t77 = t3.times_plus(t76, c[65]);
            let t78 = t3.times_plus(t77, c[1]);
            let t79 = t1.times_plus(t75, t78);
            let t80 = t2.times_plus(t70, t79);
            let t81 = t3.times_plus(c[63], c[62]);
            let t82 = t1.times_plus(c[64], t81);
            let t83 = t3.times_plus(c[61], c[37]);
            let t84 = t3.times_plus(t83, c[60]);
            let t85 = t1.times_plus(t82, t84);
            let t86 = t3.times_plus(c[59], c[58]);
            let t87 = t3.times_plus(t86, c[57]);
            let t88 = t3.times_plus(t87, c[32]);
            let t89 = t1.times_plus(t85, t88);
            let t90 = t1.times_plus(t89, c[56]);
            let t91 = t2.times_plus(t80, t90);
            // ∂S/∂p₃
            let t92 = p3 * t91;
            let t93 = t3.times_plus(c[88], c[87]);
            let t94 = t1.times_plus(c[89], t93);
            let t95 = t2.times_plus(c[91], t94);
            let t96 = t3.times_plus(c[83], c[82]);
            let t97 = t1.times_plus(c[84], t96);
            let t98 = t3.times_plus(c[81], c[80]);
            let t99 = t3.times_plus(t98, c[79]);
            let t100 = t1.times_plus(t97, t99);
            let t101 = t2.times_plus(t95, t100);
            let t102 = t3.times_plus(c[86], c[85]);
            let t103 = t2.times_plus(c[90], t102);
            let t104 = t3.times_plus(c[78], c[77]);
            let t105 = t3.times_plus(t104, c[76]);
            let t106 = t2.times_plus(t103, t105);
            let t107 = t3 * t106;
            let t108 = t1.times_plus(t101, t107);
            let t109 = t2 * t108;
            // ∂²(S₁ + … + S₉)/∂p₁²
            let t110 = t33 + t109;
            let t111 = p2 * p1;
            let t112 = t3.times_plus(c[105], c[104]);
            let t113 = t1.times_plus(c[89], t112);
            let t114 = t2.times_plus(c[106], t113);
            let t115 = t3.times_plus(c[102], c[101]);
            let t116 = t1.times_plus(c[103], t115);
            let t117 = t1.times_plus(t116, t99);
            let t118 = t2.times_plus(t114, t117);
            let t119 = t3.times_plus(c[99], c[98]);
            let t120 = t1.times_plus(c[100], t119);
            let t121 = t3.times_plus(c[97], c[96]);
            let t122 = t3.times_plus(t121, c[95]);
            let t123 = t1.times_plus(t120, t122);
            let t124 = t3.times_plus(c[94], c[68]);
            let t125 = t3.times_plus(t124, c[93]);
            let t126 = t3.times_plus(t125, c[92]);
            let t127 = t1.times_plus(t123, t126);
            let t128 = t2.times_plus(t118, t127);
            // ∂²(S₁ + … + S₉)/∂p₁∂p₂
            let t129 = t111 * t128;
            let t130 = p1 * p3;
            let t131 = t3.times_plus(c[86], c[117]);
            let t132 = t1.times_plus(c[105], t131);
            let t133 = t2.times_plus(c[118], t132);
            let t134 = t3.times_plus(c[116], c[80]);
            let t135 = t1.times_plus(c[83], t134);
            let t136 = t3.times_plus(c[115], c[114]);
            let t137 = t3.times_plus(t136, c[76]);
            let t138 = t1.times_plus(t135, t137);
            let t139 = t2.times_plus(t133, t138);
            let t140 = t3.times_plus(c[97], c[43]);
            let t141 = t1.times_plus(c[113], t140);
            let t142 = t3.times_plus(c[112], c[111]);
            let t143 = t3.times_plus(t142, c[93]);
            let t144 = t1.times_plus(t141, t143);
            let t145 = t3.times_plus(c[110], c[109]);
            let t146 = t3.times_plus(t145, c[108]);
            let t147 = t3.times_plus(t146, c[107]);
            let t148 = t1.times_plus(t144, t147);
            let t149 = t2.times_plus(t139, t148);
            // ∂²(S₁ + … + S₉)/∂p₁∂p₃
            let t150 = t130 * t149;
            let t151 = t1.times_plus(c[103], t96);
            let t152 = t2.times_plus(c[128], t151);
            let t153 = t3.times_plus(c[126], c[125]);
            let t154 = t1.times_plus(c[127], t153);
            let t155 = t1.times_plus(t154, t122);
            let t156 = t2.times_plus(t152, t155);
            let t157 = t3.times_plus(c[123], c[122]);
            let t158 = t1.times_plus(c[124], t157);
            let t159 = t3.times_plus(c[121], c[120]);
            let t160 = t3.times_plus(t159, c[119]);
            let t161 = t1.times_plus(t158, t160);
            let t162 = t3 * t161;
            let t163 = t2.times_plus(t156, t162);
            let t164 = t1 * t163;
            // ∂²(S₁ + … + S₉)/∂p₂²
            let t165 = t60 + t164;
            let t166 = p2 * p3;
            let t167 = t3.times_plus(c[81], c[19]);
            let t168 = t1.times_plus(c[83], t167);
            let t169 = t2.times_plus(c[138], t168);
            let t170 = t3.times_plus(c[137], c[96]);
            let t171 = t1.times_plus(c[99], t170);
            let t172 = t1.times_plus(t171, t143);
            let t173 = t2.times_plus(t169, t172);
            let t174 = t3.times_plus(c[123], c[135]);
            let t175 = t1.times_plus(c[136], t174);
            let t176 = t3.times_plus(c[134], c[133]);
            let t177 = t3.times_plus(t176, c[119]);
            let t178 = t1.times_plus(t175, t177);
            let t179 = t3.times_plus(c[132], c[131]);
            let t180 = t3.times_plus(t179, c[130]);
            let t181 = t3.times_plus(t180, c[129]);
            let t182 = t1.times_plus(t178, t181);
            let t183 = t2.times_plus(t173, t182);
            // ∂²(S₁ + … + S₉)/∂p₂∂p₃
            let t184 = t166 * t183;
            let t185 = t3.times_plus(c[115], c[77]);
            let t186 = t1.times_plus(c[81], t185);
            let t187 = t2.times_plus(c[145], t186);
            let t188 = t3.times_plus(c[144], c[111]);
            let t189 = t1.times_plus(c[97], t188);
            let t190 = t3.times_plus(c[143], c[142]);
            let t191 = t3.times_plus(t190, c[108]);
            let t192 = t1.times_plus(t189, t191);
            let t193 = t2.times_plus(t187, t192);
            let t194 = t3.times_plus(c[134], c[120]);
            let t195 = t1.times_plus(c[141], t194);
            let t196 = t3.times_plus(c[140], c[139]);
            let t197 = t3.times_plus(t196, c[130]);
            let t198 = t1.times_plus(t195, t197);
            let t199 = t1 * t198;
            let t200 = t2.times_plus(t193, t199);
            let t201 = t3 * t200;
            // ∂²(S₁ + … + S₉)/∂p₃²
            let t202 = t91 + t201;
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t34, t61, t92]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([[t110, t129, t150], [t129, t165, t184], [t150, t184, t202]]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let mu1 = input[0];
            let t1 = mu1 * mu1;
            let mu2 = input[1];
            let t2 = mu2 * mu2;
            let mu3 = input[2];
            let t3 = mu3 * mu3;
            let t4 = t3.times_plus(c[298], c[297]);
            let t5 = t2.times_plus(c[299], t4);
            let t6 = t1.times_plus(c[305], t5);
            let t7 = t3.times_plus(c[286], c[285]);
            let t8 = t2.times_plus(c[287], t7);
            let t9 = t3.times_plus(c[284], c[283]);
            let t10 = t3.times_plus(t9, c[282]);
            let t11 = t2.times_plus(t8, t10);
            let t12 = t1.times_plus(t6, t11);
            let t13 = t3.times_plus(c[265], c[264]);
            let t14 = t2.times_plus(c[266], t13);
            let t15 = t3.times_plus(c[263], c[262]);
            let t16 = t3.times_plus(t15, c[261]);
            let t17 = t2.times_plus(t14, t16);
            let t18 = t3.times_plus(c[260], c[259]);
            let t19 = t3.times_plus(t18, c[258]);
            let t20 = t3.times_plus(t19, c[257]);
            let t21 = t2.times_plus(t17, t20);
            let t22 = t1.times_plus(t12, t21);
            let t23 = mu2 * mu3;
            let t24 = t22 * t23;
            let t25 = t3.times_plus(c[303], c[302]);
            let t26 = t2.times_plus(c[304], t25);
            let t27 = t1.times_plus(c[307], t26);
            let t28 = t3.times_plus(c[295], c[294]);
            let t29 = t2.times_plus(c[296], t28);
            let t30 = t3.times_plus(c[293], c[292]);
            let t31 = t3.times_plus(t30, c[291]);
            let t32 = t2.times_plus(t29, t31);
            let t33 = t1.times_plus(t27, t32);
            let t34 = t3.times_plus(c[280], c[279]);
            let t35 = t2.times_plus(c[281], t34);
            let t36 = t3.times_plus(c[278], c[277]);
            let t37 = t3.times_plus(t36, c[276]);
            let t38 = t2.times_plus(t35, t37);
            let t39 = t3.times_plus(c[275], c[274]);
            let t40 = t3.times_plus(t39, c[273]);
            let t41 = t3.times_plus(t40, c[272]);
            let t42 = t2.times_plus(t38, t41);
            let t43 = t1.times_plus(t33, t42);
            let t44 = t3.times_plus(c[301], c[300]);
            let t45 = t1.times_plus(c[306], t44);
            let t46 = t3.times_plus(c[290], c[289]);
            let t47 = t3.times_plus(t46, c[288]);
            let t48 = t1.times_plus(t45, t47);
            let t49 = t3.times_plus(c[271], c[270]);
            let t50 = t3.times_plus(t49, c[269]);
            let t51 = t3.times_plus(t50, c[268]);
            let t52 = t1.times_plus(t48, t51);
            let t53 = t3.times_plus(t52, c[267]);
            let t54 = t2.times_plus(t43, t53);
            // p₁, the first guess
            let t55 = mu1.times_plus(t54, t24);
            let t56 = t3.times_plus(c[355], c[354]);
            let t57 = t2.times_plus(c[356], t56);
            let t58 = t1.times_plus(c[358], t57);
            let t59 = t3.times_plus(c[349], c[348]);
            let t60 = t2.times_plus(c[350], t59);
            let t61 = t3.times_plus(c[347], c[346]);
            let t62 = t3.times_plus(t61, c[345]);
            let t63 = t2.times_plus(t60, t62);
            let t64 = t1.times_plus(t58, t63);
            let t65 = t3.times_plus(c[337], c[336]);
            let t66 = t2.times_plus(c[338], t65);
            let t67 = t3.times_plus(c[335], c[334]);
            let t68 = t3.times_plus(t67, c[333]);
            let t69 = t2.times_plus(t66, t68);
            let t70 = t3.times_plus(c[332], c[331]);
            let t71 = t3.times_plus(t70, c[330]);
            let t72 = t3.times_plus(t71, c[329]);
            let t73 = t2.times_plus(t69, t72);
            let t74 = t1.times_plus(t64, t73);
            let t75 = t3.times_plus(c[317], c[316]);
            let t76 = t2.times_plus(c[318], t75);
            let t77 = t3.times_plus(c[315], c[314]);
            let t78 = t3.times_plus(t77, c[313]);
            let t79 = t2.times_plus(t76, t78);
            let t80 = t3.times_plus(c[312], c[311]);
            let t81 = t3.times_plus(t80, c[310]);
            let t82 = t3.times_plus(t81, c[309]);
            let t83 = t2.times_plus(t79, t82);
            let t84 = t3.times_plus(t83, c[308]);
            let t85 = t1.times_plus(t74, t84);
            let t86 = mu2 * t85;
            let t87 = t3.times_plus(c[352], c[351]);
            let t88 = t2.times_plus(c[353], t87);
            let t89 = t1.times_plus(c[357], t88);
            let t90 = t3.times_plus(c[343], c[342]);
            let t91 = t2.times_plus(c[344], t90);
            let t92 = t3.times_plus(c[341], c[340]);
            let t93 = t3.times_plus(t92, c[339]);
            let t94 = t2.times_plus(t91, t93);
            let t95 = t1.times_plus(t89, t94);
            let t96 = t3.times_plus(c[327], c[326]);
            let t97 = t2.times_plus(c[328], t96);
            let t98 = t3.times_plus(c[325], c[324]);
            let t99 = t3.times_plus(t98, c[323]);
            let t100 = t2.times_plus(t97, t99);
            let t101 = t3.times_plus(c[322], c[321]);
            let t102 = t3.times_plus(t101, c[320]);
            let t103 = t3.times_plus(t102, c[319]);
            let t104 = t2.times_plus(t100, t103);
            let t105 = t1.times_plus(t95, t104);
            let t106 = mu1 * mu3;
            // p₂, the first guess
            let t107 = t105.times_plus(t106, t86);
            let t108 = t3.times_plus(c[406], c[405]);
            let t109 = t2.times_plus(c[407], t108);
            let t110 = t1.times_plus(c[409], t109);
            let t111 = t3.times_plus(c[400], c[399]);
            let t112 = t2.times_plus(c[401], t111);
            let t113 = t3.times_plus(c[398], c[397]);
            let t114 = t3.times_plus(t113, c[396]);
            let t115 = t2.times_plus(t112, t114);
            let t116 = t1.times_plus(t110, t115);
            let t117 = t3.times_plus(c[388], c[387]);
            let t118 = t2.times_plus(c[389], t117);
            let t119 = t3.times_plus(c[386], c[385]);
            let t120 = t3.times_plus(t119, c[384]);
            let t121 = t2.times_plus(t118, t120);
            let t122 = t3.times_plus(c[383], c[382]);
            let t123 = t3.times_plus(t122, c[381]);
            let t124 = t3.times_plus(t123, c[380]);
            let t125 = t2.times_plus(t121, t124);
            let t126 = t1.times_plus(t116, t125);
            let t127 = t3.times_plus(c[368], c[367]);
            let t128 = t2.times_plus(c[369], t127);
            let t129 = t3.times_plus(c[366], c[365]);
            let t130 = t3.times_plus(t129, c[364]);
            let t131 = t2.times_plus(t128, t130);
            let t132 = t3.times_plus(c[363], c[362]);
            let t133 = t3.times_plus(t132, c[361]);
            let t134 = t3.times_plus(t133, c[360]);
            let t135 = t2.times_plus(t131, t134);
            let t136 = t2.times_plus(t135, c[359]);
            let t137 = t1.times_plus(t126, t136);
            let t138 = mu3 * t137;
            let t139 = t3.times_plus(c[403], c[402]);
            let t140 = t2.times_plus(c[404], t139);
            let t141 = t1.times_plus(c[408], t140);
            let t142 = t3.times_plus(c[394], c[393]);
            let t143 = t2.times_plus(c[395], t142);
            let t144 = t3.times_plus(c[392], c[391]);
            let t145 = t3.times_plus(t144, c[390]);
            let t146 = t2.times_plus(t143, t145);
            let t147 = t1.times_plus(t141, t146);
            let t148 = t3.times_plus(c[378], c[377]);
            let t149 = t2.times_plus(c[379], t148);
            let t150 = t3.times_plus(c[376], c[375]);
            let t151 = t3.times_plus(t150, c[374]);
            let t152 = t2.times_plus(t149, t151);
            let t153 = t3.times_plus(c[373], c[372]);
            let t154 = t3.times_plus(t153, c[371]);
            let t155 = t3.times_plus(t154, c[370]);
            let t156 = t2.times_plus(t152, t155);
            let t157 = t1.times_plus(t147, t156);
            let t158 = mu1 * mu2;
            // p₃, the first guess
            let t159 = t157.times_plus(t158, t138);
            <Vector<T> as ::core::convert::From<_>>::from([t55, t107, t159])
        }
        #[inline(always)]
        fn predict_after(&self, last: &Vector<T>, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let twice_even = {
                let mu1 = input[0];
                let mu2 = input[1];
                let t1 = mu2 * mu2;
                let t2 = mu1 * mu1;
                let mu3 = input[2];
                let t3 = mu3 * mu3;
                let t4 = t3.times_plus(c[191], c[190]);
                let t5 = t1.times_plus(c[192], t4);
                let t6 = t2.times_plus(c[194], t5);
                let t7 = t3.times_plus(c[186], c[185]);
                let t8 = t1.times_plus(c[187], t7);
                let t9 = t3.times_plus(c[184], c[183]);
                let t10 = t3.times_plus(t9, c[182]);
                let t11 = t1.times_plus(t8, t10);
                let t12 = t2.times_plus(t6, t11);
                let t13 = t3.times_plus(c[177], c[176]);
                let t14 = t1.times_plus(c[178], t13);
                let t15 = t3.times_plus(c[175], c[174]);
                let t16 = t3.times_plus(t15, c[173]);
                let t17 = t1.times_plus(t14, t16);
                let t18 = t3.times_plus(c[172], c[171]);
                let t19 = t3.times_plus(t18, c[170]);
                let t20 = t3.times_plus(t19, c[169]);
                let t21 = t1.times_plus(t17, t20);
                let t22 = t2.times_plus(t12, t21);
                let t23 = t3.times_plus(c[189], c[188]);
                let t24 = t2.times_plus(c[193], t23);
                let t25 = t3.times_plus(c[181], c[180]);
                let t26 = t3.times_plus(t25, c[179]);
                let t27 = t2.times_plus(t24, t26);
                let t28 = t3.times_plus(c[168], c[167]);
                let t29 = t3.times_plus(t28, c[166]);
                let t30 = t3.times_plus(t29, c[165]);
                let t31 = t2.times_plus(t27, t30);
                let t32 = t3.times_plus(t31, c[164]);
                let t33 = t1.times_plus(t22, t32);
                // twice the part of p₁ that is even in h
                let t34 = mu1 * t33;
                let t35 = t3.times_plus(c[223], c[222]);
                let t36 = t1.times_plus(c[224], t35);
                let t37 = t2.times_plus(c[225], t36);
                let t38 = t3.times_plus(c[220], c[219]);
                let t39 = t1.times_plus(c[221], t38);
                let t40 = t3.times_plus(c[218], c[217]);
                let t41 = t3.times_plus(t40, c[216]);
                let t42 = t1.times_plus(t39, t41);
                let t43 = t2.times_plus(t37, t42);
                let t44 = t3.times_plus(c[214], c[213]);
                let t45 = t1.times_plus(c[215], t44);
                let t46 = t3.times_plus(c[212], c[211]);
                let t47 = t3.times_plus(t46, c[210]);
                let t48 = t1.times_plus(t45, t47);
                let t49 = t3.times_plus(c[209], c[208]);
                let t50 = t3.times_plus(t49, c[207]);
                let t51 = t3.times_plus(t50, c[206]);
                let t52 = t1.times_plus(t48, t51);
                let t53 = t2.times_plus(t43, t52);
                let t54 = t3.times_plus(c[204], c[203]);
                let t55 = t1.times_plus(c[205], t54);
                let t56 = t3.times_plus(c[202], c[201]);
                let t57 = t3.times_plus(t56, c[200]);
                let t58 = t1.times_plus(t55, t57);
                let t59 = t3.times_plus(c[199], c[198]);
                let t60 = t3.times_plus(t59, c[197]);
                let t61 = t3.times_plus(t60, c[196]);
                let t62 = t1.times_plus(t58, t61);
                let t63 = t3.times_plus(t62, c[195]);
                let t64 = t2.times_plus(t53, t63);
                // twice the part of p₂ that is even in h
                let t65 = mu2 * t64;
                let t66 = t3.times_plus(c[254], c[253]);
                let t67 = t1.times_plus(c[255], t66);
                let t68 = t2.times_plus(c[256], t67);
                let t69 = t3.times_plus(c[251], c[250]);
                let t70 = t1.times_plus(c[252], t69);
                let t71 = t3.times_plus(c[249], c[248]);
                let t72 = t3.times_plus(t71, c[247]);
                let t73 = t1.times_plus(t70, t72);
                let t74 = t2.times_plus(t68, t73);
                let t75 = t3.times_plus(c[245], c[244]);
                let t76 = t1.times_plus(c[246], t75);
                let t77 = t3.times_plus(c[243], c[242]);
                let t78 = t3.times_plus(t77, c[241]);
                let t79 = t1.times_plus(t76, t78);
                let t80 = t3.times_plus(c[240], c[239]);
                let t81 = t3.times_plus(t80, c[238]);
                let t82 = t3.times_plus(t81, c[237]);
                let t83 = t1.times_plus(t79, t82);
                let t84 = t2.times_plus(t74, t83);
                let t85 = t3.times_plus(c[235], c[234]);
                let t86 = t1.times_plus(c[236], t85);
                let t87 = t3.times_plus(c[233], c[232]);
                let t88 = t3.times_plus(t87, c[231]);
                let t89 = t1.times_plus(t86, t88);
                let t90 = t3.times_plus(c[230], c[229]);
                let t91 = t3.times_plus(t90, c[228]);
                let t92 = t3.times_plus(t91, c[227]);
                let t93 = t1.times_plus(t89, t92);
                let t94 = t1.times_plus(t93, c[226]);
                let t95 = t2.times_plus(t84, t94);
                // twice the part of p₃ that is even in h
                let t96 = mu3 * t95;
                <Vector<T> as ::core::convert::From<_>>::from([t34, t65, t96])
            };
            twice_even - last
        }
        #[inline(always)]
        fn newton_model(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p2 = input[1];
            let t1 = p2 * p2;
            let p1 = input[0];
            let t2 = p1 * p1;
            let p3 = input[2];
            let t3 = p3 * p3;
            let t4 = t3.times_plus(c[27], c[26]);
            let t5 = t1.times_plus(c[28], t4);
            let t6 = t2.times_plus(c[30], t5);
            let t7 = t3.times_plus(c[22], c[21]);
            let t8 = t1.times_plus(c[23], t7);
            let t9 = t3.times_plus(c[20], c[19]);
            let t10 = t3.times_plus(t9, c[18]);
            let t11 = t1.times_plus(t8, t10);
            let t12 = t2.times_plus(t6, t11);
            let t13 = t3.times_plus(c[13], c[12]);
            let t14 = t1.times_plus(c[14], t13);
            let t15 = t3.times_plus(c[11], c[10]);
            let t16 = t3.times_plus(t15, c[9]);
            let t17 = t1.times_plus(t14, t16);
            let t18 = t3.times_plus(c[8], c[7]);
            let t19 = t3.times_plus(t18, c[6]);
            let t20 = t3.times_plus(t19, c[5]);
            let t21 = t1.times_plus(t17, t20);
            let t22 = t2.times_plus(t12, t21);
            let t23 = t3.times_plus(c[25], c[24]);
            let t24 = t2.times_plus(c[29], t23);
            let t25 = t3.times_plus(c[17], c[16]);
            let t26 = t3.times_plus(t25, c[15]);
            let t27 = t2.times_plus(t24, t26);
            let t28 = t3.times_plus(c[4], c[3]);
            let t29 = t3.times_plus(t28, c[2]);
            let t30 = t3.times_plus(t29, c[1]);
            let t31 = t2.times_plus(t27, t30);
            let t32 = t3.times_plus(t31, c[0]);
            let t33 = t1.times_plus(t22, t32);
            // ∂S/∂p₁
            let t34 = p1 * t33;
            let t35 = t3.times_plus(c[53], c[52]);
            let t36 = t1.times_plus(c[54], t35);
            let t37 = t2.times_plus(c[55], t36);
            let t38 = t1.times_plus(c[51], t7);
            let t39 = t3.times_plus(c[50], c[49]);
            let t40 = t3.times_plus(t39, c[48]);
            let t41 = t1.times_plus(t38, t40);
            let t42 = t2.times_plus(t37, t41);
            let t43 = t3.times_plus(c[46], c[45]);
            let t44 = t1.times_plus(c[47], t43);
            let t45 = t3.times_plus(c[44], c[43]);
            let t46 = t3.times_plus(t45, c[42]);
            let t47 = t1.times_plus(t44, t46);
            let t48 = t1.times_plus(t47, t20);
            let t49 = t2.times_plus(t42, t48);
            let t50 = t3.times_plus(c[40], c[39]);
            let t51 = t1.times_plus(c[41], t50);
            let t52 = t3.times_plus(c[38], c[37]);
            let t53 = t3.times_plus(t52, c[36]);
            let t54 = t1.times_plus(t51, t53);
            let t55 = t3.times_plus(c[35], c[34]);
            let t56 = t3.times_plus(t55, c[33]);
            let t57 = t3.times_plus(t56, c[32]);
            let t58 = t1.times_plus(t54, t57);
            let t59 = t3.times_plus(t58, c[31]);
            let t60 = t2.times_plus(t49, t59);
            // ∂S/∂p₂
            let t61 = p2 * t60;
            let t62 = t3.times_plus(c[74], c[73]);
            let t63 = t1.times_plus(c[53], t62);
            let t64 = t2.times_plus(c[75], t63);
            let t65 = t3.times_plus(c[20], c[49]);
            let t66 = t1.times_plus(c[72], t65);
            let t67 = t3.times_plus(c[71], c[16]);
            let t68 = t3.times_plus(t67, c[70]);
            let t69 = t1.times_plus(t66, t68);
            let t70 = t2.times_plus(t64, t69);
            let t71 = t3.times_plus(c[44], c[10]);
            let t72 = t1.times_plus(c[13], t71);
            let t73 = t3.times_plus(c[69], c[68]);
            let t74 = t3.times_plus(t73, c[6]);
            let t75 = t1.times_plus(t72, t74);
            let t76 = t3.times_plus(c[67], c[66]);
            let t77 = t3.times_plus(t76, c[65]);
            let t78 = t3.times_plus(t77, c[1]);
            let t79 = t1.times_plus(t75, t78);
            let t80 = t2.times_plus(t70, t79);
            let t81 = t3.times_plus(c[63], c[62]);
            let t82 = t1.times_plus(c[64], t81);
            let t83 = t3.times_plus(c[61], c[37]);
            let t84 = t3.times_plus(t83, c[60]);
            let t85 = t1.times_plus(t82, t84);
            let t86 = t3.times_plus(c[59], c[58]);
            let t87 = t3.times_plus(t86, c[57]);
            let t88 = t3.times_plus(t87, c[32]);
            let t89 = t1.times_plus(t85, t88);
            let t90 = t1.times_plus(t89, c[56]);
            let t91 = t2.times_plus(t80, t90);
            // ∂S/∂p₃
            let t92 = p3 * t91;
            let t93 = t3.times_plus(c[80], c[79]);
            let t94 = t1.times_plus(c[82], t93);
            let t95 = t2.times_plus(c[87], t94);
            let t96 = t3.times_plus(c[77], c[76]);
            let t97 = t2.times_plus(c[85], t96);
            let t98 = t3 * t97;
            let t99 = t1.times_plus(t95, t98);
            let t100 = t2 * t99;
            // ∂²(S₁ + … + S₇)/∂p₁²
            let t101 = t33 + t100;
            let t102 = p2 * p1;
            let t103 = t1.times_plus(c[101], t93);
            let t104 = t2.times_plus(c[104], t103);
            let t105 = t3.times_plus(c[96], c[95]);
            let t106 = t1.times_plus(c[98], t105);
            let t107 = t3.times_plus(c[68], c[93]);
            let t108 = t3.times_plus(t107, c[92]);
            let t109 = t1.times_plus(t106, t108);
            let t110 = t2.times_plus(t104, t109);
            // ∂²(S₁ + … + S₇)/∂p₁∂p₂
            let t111 = t102 * t110;
            let t112 = p1 * p3;
            let t113 = t3.times_plus(c[114], c[76]);
            let t114 = t1.times_plus(c[80], t113);
            let t115 = t2.times_plus(c[117], t114);
            let t116 = t3.times_plus(c[111], c[93]);
            let t117 = t1.times_plus(c[43], t116);
            let t118 = t3.times_plus(c[109], c[108]);
            let t119 = t3.times_plus(t118, c[107]);
            let t120 = t1.times_plus(t117, t119);
            let t121 = t2.times_plus(t115, t120);
            // ∂²(S₁ + … + S₇)/∂p₁∂p₃
            let t122 = t112 * t121;
            let t123 = t1.times_plus(c[125], t105);
            let t124 = t2.times_plus(c[82], t123);
            let t125 = t3.times_plus(c[120], c[119]);
            let t126 = t1.times_plus(c[122], t125);
            let t127 = t3 * t126;
            let t128 = t2.times_plus(t124, t127);
            let t129 = t1 * t128;
            // ∂²(S₁ + … + S₇)/∂p₂²
            let t130 = t60 + t129;
            let t131 = p2 * p3;
            let t132 = t1.times_plus(c[96], t116);
            let t133 = t2.times_plus(c[19], t132);
            let t134 = t3.times_plus(c[133], c[119]);
            let t135 = t1.times_plus(c[135], t134);
            let t136 = t3.times_plus(c[131], c[130]);
            let t137 = t3.times_plus(t136, c[129]);
            let t138 = t1.times_plus(t135, t137);
            let t139 = t2.times_plus(t133, t138);
            // ∂²(S₁ + … + S₇)/∂p₂∂p₃
            let t140 = t131 * t139;
            let t141 = t3.times_plus(c[142], c[108]);
            let t142 = t1.times_plus(c[111], t141);
            let t143 = t2.times_plus(c[77], t142);
            let t144 = t3.times_plus(c[139], c[130]);
            let t145 = t1.times_plus(c[120], t144);
            let t146 = t1 * t145;
            let t147 = t2.times_plus(t143, t146);
            let t148 = t3 * t147;
            // ∂²(S₁ + … + S₇)/∂p₃²
            let t149 = t91 + t148;
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t34, t61, t92]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([[t101, t111, t122], [t111, t130, t140], [t122, t140, t149]]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn bend(&self, x: T) -> T {
            x * x * T::of(0.25)
        }
        #[inline(always)]
        fn hessian_defect(&self, size: T) -> T {
            ::coadjoint::plumbing::polynomial(&self.defect, size)
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for RigidBody<T> {
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
    impl ::coadjoint::Lanes for RigidBody<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = RigidBody<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> RigidBody<L> {
            RigidBody {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> RigidBody<T> {
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
            (0.2, 0), (0.25, 0), (0.0002777777777777778, 0), (0.000002037037037037037, 0),
            (0.00000001578483245149912, 0), (0.00000000012418620854834847, 0),
            (-0.0000006944444444444445, 0), (-0.000000014844209288653733, 0),
            (-0.00000000021969103141942648, 0), (0.000000004317313345091123, 0),
            (0.00000000016914070154810896, 0), (-0.0000000000086541889846931, 0),
            (0.3333333333333333, 0), (0.0014814814814814814, 0), (0.000019753086419753087, 0),
            (0.00000026818211509569535, 0), (0.0000000036504539813181788, 0),
            (0.000462962962962963, 0), (0.000012551440329218107, 0), (0.0000002806355738454504, 0),
            (0.000000005666049745610788, 0), (0.000005015432098765432, 0),
            (0.00000025238421843360113, 0), (0.000000007836376205717769, 0),
            (0.000000055778055392252924, 0), (0.0000000032900944252110232, 0),
            (0.0000000006263123748013152, 0), (-0.000002194787379972565, 0),
            (-0.00000003971520020902737, 0), (0.0000000003359921421192569, 0),
            (0.000002914951989026063, 0), (0.00000020557079713458315, 0),
            (0.000000008931867722448427, 0), (0.00000007797700698935267, 0),
            (0.000000005891520480569406, 0), (0.0000000016173386872403791, 0),
            (0.000000020322105370116346, 0), (0.0000000010637170582300898, 0),
            (0.000000013563190860858899, 0), (0.0000000008719554139459642, 0),
            (0.0000000007405320762659583, 0), (0.000000000012902924044518313, 0),
            (0.00000000006980683516272604, 0), (0.2, 0), (0.25, 0), (0.3333333333333333, 0),
            (-0.05, 0), (0.0006666666666666666, 0), (-0.00000009876543209876543, 0),
            (0.0000000029472859102488733, 0), (0.00020833333333333335, 0),
            (0.0000059876543209876546, 0), (-0.000000006329610033313737, 0),
            (0.0000018132716049382715, 0), (0.00000004191162061532432, 0),
            (0.000000010843039633548893, 0), (1.0, 0), (-0.015555555555555555, 0),
            (0.00003061728395061729, 0), (-0.00000005079365079365079, 0),
            (-0.00000000006061793716114703, 0), (-0.002777777777777778, 0),
            (-0.00017592592592592592, 0), (0.0000008886929257299627, 0),
            (-0.0000000023238617806519043, 0), (-0.00004243827160493827, 0),
            (-0.0000013479815794630609, 0), (0.000000013914364099549284, 0),
            (-0.00000026546884185773075, 0), (-0.000000009088301815925274, 0),
            (-0.0000000016272852162126854, 0), (0.0011111111111111111, 0),
            (-0.000007654320987654322, 0), (0.000000043791233914690706, 0),
            (0.000015123456790123456, 0), (-0.00000023273891175125742, 0),
            (0.00000012782513554118492, 0), (-0.0001234567901234568, 0),
            (0.000000050689137108890194, 0), (-0.00000000018533760097546105, 0),
            (-0.0001234567901234568, 0), (-0.00000009438892154941538, 0),
            (-0.000000021636074640189867, 0), (-0.0000014468613234045333, 0),
            (0.000000014623750734861845, 0), (-0.000000011716963877457705, 0),
            (0.0000019204389574759944, 0), (0.0000001435321270712217, 0),
            (0.000000028033618568597993, 0), (-0.0000023672349598275523, 0),
            (0.000000015002745903523222, 0), (-0.0000013978705336730028, 0),
            (-0.00000004529168269451763, 0), (-0.00000002252971503085815, 0),
            (0.00000008970757941951357, 0), (-0.000000030363806007762724, 0),
            (-0.000000020789836366730134, 0), (1.0, 0), (-0.01, 0), (0.00002074074074074074, 0),
            (-0.000000027278071722516166, 0), (-0.0000000000188124632569077, 0),
            (-0.00006944444444444444, 0), (0.00000029747207524985305, 0),
            (-0.0000000009978444052518126, 0), (-0.0000005147707231040564, 0),
            (0.0000000027787575935724084, 0), (-0.000000004065470066627474, 0),
            (0.13333333333333333, 0), (-0.001037037037037037, 0), (0.0000005925925925925926, 0),
            (-0.0000000032608269645306683, 0), (0.0011111111111111111, 0),
            (-0.000019382716049382716, 0), (0.00000005130315500685871, 0),
            (0.000009567901234567902, 0), (-0.0000002266803840877915, 0),
            (0.0000000861013129531648, 0), (-0.001851851851851852, 0), (0.00011522633744855967, 0),
            (-0.000001035991900189431, 0), (0.0000000030162649421908683, 0),
            (-0.000033436213991769545, 0), (0.0000023502514860539553, 0),
            (-0.00000003637468155986674, 0), (-0.0000004790890979162585, 0),
            (0.000000027500163302632438, 0), (-0.000000004870586065930716, 0),
            (0.0002469135802469136, 0), (-0.000004609053497942387, 0),
            (-0.00000002079822326735907, 0), (-0.0000070644718792866944, 0),
            (0.00000023981535915692295, 0), (-0.00000008668648071940253, 0),
            (0.0000411522633744856, 0), (-0.0000017231693774903652, 0),
            (0.00000003271975090905132, 0), (-0.000000006532105297537396, 0),
            (-0.000000042694566014181926, 0), (-0.000000007393980302073581, 0),
            (0.000006767261088248743, 0), (-0.0000002341687170219406, 0),
            (0.00000012929939541736524, 0), (0.0000003091863174167701, 0),
            (0.0000000013838386037745891, 0), (-0.0000000072034605642287395, 0),
            (0.00000006735326351238559, 0), (0.0000000037042144444471326, 0), (1.0, 0),
            (0.008333333333333333, 0), (-0.000044444444444444447, 0),
            (-0.000000023515579071134626, 0), (-0.00000000044522829708014896, 0),
            (0.00003472222222222222, 0), (-0.0000005878894767783656, 0),
            (-0.0000000004036841073878111, 0), (0.00000016442533803644915, 0),
            (-0.000000005746619635508524, 0), (0.0000000009779020919067215, 0),
            (-0.08333333333333333, 0), (0.0011111111111111111, 0), (-0.0000014814814814814815, 0),
            (0.000000009719772682735646, 0), (-0.0005787037037037037, 0),
            (0.000020061728395061728, 0), (-0.00000006261022927689594, 0),
            (-0.0000021219135802469136, 0), (0.0000002147021359984323, 0),
            (-0.00000001096551660787772, 0), (0.003703703703703704, 0),
            (-0.000018106995884773663, 0), (-0.00000014945456920765562, 0),
            (-0.0000000004034228231759096, 0), (-0.0000874485596707819, 0),
            (0.0000008540727676530145, 0), (-0.000000015000326605264876, 0),
            (-0.0000015770951727741851, 0), (0.000000019418316023254294, 0),
            (-0.00000001843363517103229, 0), (-0.0006172839506172839, 0),
            (0.000002606310013717421, 0), (0.00000016652513771855336, 0),
            (-0.00000051440329218107, 0), (-0.0000000070764474056655125, 0),
            (0.00000002633254948069763, 0), (0.0000411522633744856, 0),
            (-0.0000014135475863870925, 0), (0.0000000019904050631073952, 0),
            (0.00000020412829054804364, 0), (-0.00000006676392245665223, 0),
            (-0.000000012778430988307531, 0), (-0.0000059442158207590304, 0),
            (0.000000296412422612697, 0), (-0.00000003111822384799065, 0),
            (0.0000005312778975330416, 0), (-0.00000001788732360291574, 0),
            (-0.00000001706814921263938, 0), (-0.00000006822421088539058, 0),
            (0.0000000058977115320152455, 0),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (1, 2), (3, 3), (5, 4), (7, 5), (9, 6), (5, 7), (7, 8), (9, 9), (7, 10),
            (9, 11), (9, 12), (1, 13), (3, 14), (5, 15), (7, 16), (9, 17), (3, 18), (5, 19),
            (7, 20), (9, 21), (5, 22), (7, 23), (9, 24), (7, 25), (9, 26), (9, 27), (5, 28),
            (7, 29), (9, 30), (5, 31), (7, 32), (9, 33), (7, 34), (9, 35), (9, 36), (7, 37),
            (9, 38), (7, 39), (9, 40), (9, 41), (9, 42), (9, 43), (0, 44), (0, 45), (0, 46),
            (1, 47), (3, 48), (5, 49), (7, 50), (3, 51), (5, 52), (7, 53), (5, 54), (7, 55),
            (7, 56), (0, 57), (2, 58), (4, 59), (6, 60), (8, 61), (2, 62), (4, 63), (6, 64),
            (8, 65), (4, 66), (6, 67), (8, 68), (6, 69), (8, 70), (8, 71), (3, 72), (5, 73),
            (7, 74), (5, 75), (7, 76), (7, 77), (4, 78), (6, 79), (8, 80), (4, 81), (6, 82),
            (8, 83), (6, 84), (8, 85), (8, 86), (5, 87), (7, 88), (7, 89), (6, 90), (8, 91),
            (6, 92), (8, 93), (8, 94), (7, 95), (8, 96), (8, 97), (0, 98), (2, 99), (4, 100),
            (6, 101), (8, 102), (4, 103), (6, 104), (8, 105), (6, 106), (8, 107), (8, 108),
            (1, 109), (3, 110), (5, 111), (7, 112), (3, 113), (5, 114), (7, 115), (5, 116),
            (7, 117), (7, 118), (2, 119), (4, 120), (6, 121), (8, 122), (4, 123), (6, 124),
            (8, 125), (6, 126), (8, 127), (8, 128), (3, 129), (5, 130), (7, 131), (5, 132),
            (7, 133), (7, 134), (4, 135), (6, 136), (8, 137), (6, 138), (8, 139), (8, 140),
            (5, 141), (7, 142), (7, 143), (6, 144), (8, 145), (8, 146), (7, 147), (8, 148),
            (0, 149), (2, 150), (4, 151), (6, 152), (8, 153), (4, 154), (6, 155), (8, 156),
            (6, 157), (8, 158), (8, 159), (1, 160), (3, 161), (5, 162), (7, 163), (3, 164),
            (5, 165), (7, 166), (5, 167), (7, 168), (7, 169), (2, 170), (4, 171), (6, 172),
            (8, 173), (4, 174), (6, 175), (8, 176), (6, 177), (8, 178), (8, 179), (3, 180),
            (5, 181), (7, 182), (5, 183), (7, 184), (7, 185), (4, 186), (6, 187), (8, 188),
            (6, 189), (8, 190), (8, 191), (5, 192), (7, 193), (7, 194), (6, 195), (8, 196),
            (8, 197), (7, 198), (8, 199),
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
            189, 190, 191, 192, 193, 194, 195, 196, 197, 198, 199,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (12, 2), (13, 2), (14, 2), (15, 2), (16, 2), (17, 2), (18, 2), (19, 2), (20, 2),
            (21, 2), (22, 2), (23, 2), (24, 2), (25, 2), (26, 2), (27, 4), (28, 4), (29, 4),
            (30, 4), (31, 4), (32, 4), (33, 4), (34, 4), (35, 4), (36, 6), (37, 6), (38, 6),
            (39, 6), (40, 6), (41, 8), (42, 8), (1, 2), (2, 2), (3, 2), (4, 2), (5, 2), (6, 4),
            (7, 4), (8, 4), (9, 6), (10, 6), (11, 8), (21, 4), (22, 4), (23, 4), (24, 6), (25, 6),
            (26, 8), (30, 2), (31, 2), (32, 2), (35, 6), (38, 2), (39, 2), (40, 4), (42, 2), (0, 2),
            (3, 4), (4, 6), (5, 8), (6, 2), (8, 6), (9, 2), (10, 4), (11, 2), (14, 4), (15, 6),
            (16, 8), (19, 4), (20, 6), (27, 2), (29, 6), (34, 2), (36, 2), (37, 4), (41, 2),
            (27, 8), (28, 8), (29, 8), (30, 8), (31, 8), (32, 8), (33, 8), (34, 8), (35, 8),
            (36, 24), (37, 24), (38, 24), (39, 24), (40, 24), (41, 48), (42, 48), (17, 4), (18, 4),
            (20, 4), (21, 8), (22, 8), (23, 8), (24, 12), (25, 12), (26, 16), (33, 16), (34, 16),
            (35, 24), (38, 12), (39, 12), (42, 16), (13, 4), (14, 8), (15, 12), (16, 16), (19, 8),
            (20, 12), (25, 4), (28, 16), (29, 24), (32, 16), (36, 12), (41, 16), (6, 8), (7, 8),
            (8, 8), (9, 24), (10, 24), (11, 48), (24, 24), (25, 24), (26, 48), (40, 8), (2, 4),
            (3, 8), (4, 12), (5, 16), (7, 16), (8, 24), (9, 12), (11, 16), (23, 16), (39, 4),
            (4, 24), (5, 48), (10, 8), (15, 24), (16, 48), (20, 24), (37, 8), (5, 1), (8, 1),
            (10, 1), (11, 1), (16, 1), (20, 1), (23, 1), (25, 1), (26, 1), (29, 1), (32, 1),
            (34, 1), (35, 1), (37, 1), (39, 1), (40, 1), (41, 1), (42, 1), (56, 2), (57, 2),
            (58, 2), (59, 2), (60, 2), (61, 2), (62, 2), (63, 2), (64, 2), (65, 2), (66, 2),
            (67, 2), (68, 2), (69, 2), (70, 2), (77, 2), (78, 2), (79, 2), (80, 2), (81, 2),
            (82, 2), (83, 2), (84, 2), (85, 2), (89, 2), (90, 2), (91, 2), (92, 2), (93, 2),
            (95, 2), (96, 2), (97, 2), (98, 2), (99, 2), (100, 2), (101, 2), (102, 2), (103, 2),
            (104, 2), (105, 2), (106, 2), (107, 2), (118, 2), (119, 2), (120, 2), (121, 2),
            (122, 2), (123, 2), (124, 2), (125, 2), (126, 2), (127, 2), (134, 2), (135, 2),
            (136, 2), (137, 2), (138, 2), (139, 2), (143, 2), (144, 2), (145, 2), (147, 2),
            (148, 2), (149, 2), (150, 2), (151, 2), (152, 2), (153, 2), (154, 2), (155, 2),
            (156, 2), (157, 2), (158, 2), (169, 2), (170, 2), (171, 2), (172, 2), (173, 2),
            (174, 2), (175, 2), (176, 2), (177, 2), (178, 2), (185, 2), (186, 2), (187, 2),
            (188, 2), (189, 2), (190, 2), (194, 2), (195, 2), (196, 2), (198, 2), (46, 1), (47, 1),
            (48, 1), (49, 1), (50, 1), (51, 1), (52, 1), (53, 1), (54, 1), (55, 1), (56, 1),
            (57, 1), (58, 1), (59, 1), (60, 1), (61, 1), (62, 1), (63, 1), (64, 1), (65, 1),
            (66, 1), (67, 1), (68, 1), (69, 1), (70, 1), (71, 1), (72, 1), (73, 1), (74, 1),
            (75, 1), (76, 1), (77, 1), (78, 1), (79, 1), (80, 1), (81, 1), (82, 1), (83, 1),
            (84, 1), (85, 1), (86, 1), (87, 1), (88, 1), (89, 1), (90, 1), (91, 1), (92, 1),
            (93, 1), (94, 1), (95, 1), (96, 1), (97, 1), (98, 1), (99, 1), (100, 1), (101, 1),
            (102, 1), (103, 1), (104, 1), (105, 1), (106, 1), (107, 1), (108, 1), (109, 1),
            (110, 1), (111, 1), (112, 1), (113, 1), (114, 1), (115, 1), (116, 1), (117, 1),
            (118, 1), (119, 1), (120, 1), (121, 1), (122, 1), (123, 1), (124, 1), (125, 1),
            (126, 1), (127, 1), (128, 1), (129, 1), (130, 1), (131, 1), (132, 1), (133, 1),
            (134, 1), (135, 1), (136, 1), (137, 1), (138, 1), (139, 1), (140, 1), (141, 1),
            (142, 1), (143, 1), (144, 1), (145, 1), (146, 1), (147, 1), (148, 1), (149, 1),
            (150, 1), (151, 1), (152, 1), (153, 1), (154, 1), (155, 1), (156, 1), (157, 1),
            (158, 1), (159, 1), (160, 1), (161, 1), (162, 1), (163, 1), (164, 1), (165, 1),
            (166, 1), (167, 1), (168, 1), (169, 1), (170, 1), (171, 1), (172, 1), (173, 1),
            (174, 1), (175, 1), (176, 1), (177, 1), (178, 1), (179, 1), (180, 1), (181, 1),
            (182, 1), (183, 1), (184, 1), (185, 1), (186, 1), (187, 1), (188, 1), (189, 1),
            (190, 1), (191, 1), (192, 1), (193, 1), (194, 1), (195, 1), (196, 1), (197, 1),
            (198, 1), (0, 1), (1, 1), (2, 1), (3, 1), (4, 1), (6, 1), (7, 1), (9, 1), (12, 1),
            (13, 1), (14, 1), (15, 1), (17, 1), (18, 1), (19, 1), (21, 1), (22, 1), (24, 1),
            (27, 1), (28, 1), (30, 1), (31, 1), (33, 1), (36, 1), (38, 1), (43, 1), (44, 1),
            (45, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[(2, 2)], &[(1, 2)], &[(1, 2), (2, 2)], &[(1, 2), (2, 4)], &[(1, 2), (2, 6)],
            &[(1, 2), (2, 8)], &[(1, 4), (2, 2)], &[(1, 4), (2, 4)], &[(1, 4), (2, 6)],
            &[(1, 6), (2, 2)], &[(1, 6), (2, 4)], &[(1, 8), (2, 2)], &[(0, 2)], &[(0, 2), (2, 2)],
            &[(0, 2), (2, 4)], &[(0, 2), (2, 6)], &[(0, 2), (2, 8)], &[(0, 2), (1, 2)],
            &[(0, 2), (1, 2), (2, 2)], &[(0, 2), (1, 2), (2, 4)], &[(0, 2), (1, 2), (2, 6)],
            &[(0, 2), (1, 4)], &[(0, 2), (1, 4), (2, 2)], &[(0, 2), (1, 4), (2, 4)],
            &[(0, 2), (1, 6)], &[(0, 2), (1, 6), (2, 2)], &[(0, 2), (1, 8)], &[(0, 4), (2, 2)],
            &[(0, 4), (2, 4)], &[(0, 4), (2, 6)], &[(0, 4), (1, 2)], &[(0, 4), (1, 2), (2, 2)],
            &[(0, 4), (1, 2), (2, 4)], &[(0, 4), (1, 4)], &[(0, 4), (1, 4), (2, 2)],
            &[(0, 4), (1, 6)], &[(0, 6), (2, 2)], &[(0, 6), (2, 4)], &[(0, 6), (1, 2)],
            &[(0, 6), (1, 2), (2, 2)], &[(0, 6), (1, 4)], &[(0, 8), (2, 2)], &[(0, 8), (1, 2)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[
            (56, 0, &[(0, 1)]), (57, 0, &[(0, 1), (2, 2)]), (58, 0, &[(0, 1), (2, 4)]),
            (59, 0, &[(0, 1), (2, 6)]), (60, 0, &[(0, 1), (2, 8)]), (61, 0, &[(0, 1), (1, 2)]),
            (62, 0, &[(0, 1), (1, 2), (2, 2)]), (63, 0, &[(0, 1), (1, 2), (2, 4)]),
            (64, 0, &[(0, 1), (1, 2), (2, 6)]), (65, 0, &[(0, 1), (1, 4)]),
            (66, 0, &[(0, 1), (1, 4), (2, 2)]), (67, 0, &[(0, 1), (1, 4), (2, 4)]),
            (68, 0, &[(0, 1), (1, 6)]), (69, 0, &[(0, 1), (1, 6), (2, 2)]),
            (70, 0, &[(0, 1), (1, 8)]), (77, 0, &[(0, 3), (2, 2)]), (78, 0, &[(0, 3), (2, 4)]),
            (79, 0, &[(0, 3), (2, 6)]), (80, 0, &[(0, 3), (1, 2)]),
            (81, 0, &[(0, 3), (1, 2), (2, 2)]), (82, 0, &[(0, 3), (1, 2), (2, 4)]),
            (83, 0, &[(0, 3), (1, 4)]), (84, 0, &[(0, 3), (1, 4), (2, 2)]),
            (85, 0, &[(0, 3), (1, 6)]), (89, 0, &[(0, 5), (2, 2)]), (90, 0, &[(0, 5), (2, 4)]),
            (91, 0, &[(0, 5), (1, 2)]), (92, 0, &[(0, 5), (1, 2), (2, 2)]),
            (93, 0, &[(0, 5), (1, 4)]), (95, 0, &[(0, 7), (2, 2)]), (96, 0, &[(0, 7), (1, 2)]),
            (97, 1, &[(1, 1)]), (98, 1, &[(1, 1), (2, 2)]), (99, 1, &[(1, 1), (2, 4)]),
            (100, 1, &[(1, 1), (2, 6)]), (101, 1, &[(1, 1), (2, 8)]), (102, 1, &[(1, 3), (2, 2)]),
            (103, 1, &[(1, 3), (2, 4)]), (104, 1, &[(1, 3), (2, 6)]), (105, 1, &[(1, 5), (2, 2)]),
            (106, 1, &[(1, 5), (2, 4)]), (107, 1, &[(1, 7), (2, 2)]), (118, 1, &[(0, 2), (1, 1)]),
            (119, 1, &[(0, 2), (1, 1), (2, 2)]), (120, 1, &[(0, 2), (1, 1), (2, 4)]),
            (121, 1, &[(0, 2), (1, 1), (2, 6)]), (122, 1, &[(0, 2), (1, 3)]),
            (123, 1, &[(0, 2), (1, 3), (2, 2)]), (124, 1, &[(0, 2), (1, 3), (2, 4)]),
            (125, 1, &[(0, 2), (1, 5)]), (126, 1, &[(0, 2), (1, 5), (2, 2)]),
            (127, 1, &[(0, 2), (1, 7)]), (134, 1, &[(0, 4), (1, 1)]),
            (135, 1, &[(0, 4), (1, 1), (2, 2)]), (136, 1, &[(0, 4), (1, 1), (2, 4)]),
            (137, 1, &[(0, 4), (1, 3)]), (138, 1, &[(0, 4), (1, 3), (2, 2)]),
            (139, 1, &[(0, 4), (1, 5)]), (143, 1, &[(0, 6), (1, 1)]),
            (144, 1, &[(0, 6), (1, 1), (2, 2)]), (145, 1, &[(0, 6), (1, 3)]),
            (147, 1, &[(0, 8), (1, 1)]), (148, 2, &[(2, 1)]), (149, 2, &[(1, 2), (2, 1)]),
            (150, 2, &[(1, 2), (2, 3)]), (151, 2, &[(1, 2), (2, 5)]), (152, 2, &[(1, 2), (2, 7)]),
            (153, 2, &[(1, 4), (2, 1)]), (154, 2, &[(1, 4), (2, 3)]), (155, 2, &[(1, 4), (2, 5)]),
            (156, 2, &[(1, 6), (2, 1)]), (157, 2, &[(1, 6), (2, 3)]), (158, 2, &[(1, 8), (2, 1)]),
            (169, 2, &[(0, 2), (2, 1)]), (170, 2, &[(0, 2), (2, 3)]), (171, 2, &[(0, 2), (2, 5)]),
            (172, 2, &[(0, 2), (2, 7)]), (173, 2, &[(0, 2), (1, 2), (2, 1)]),
            (174, 2, &[(0, 2), (1, 2), (2, 3)]), (175, 2, &[(0, 2), (1, 2), (2, 5)]),
            (176, 2, &[(0, 2), (1, 4), (2, 1)]), (177, 2, &[(0, 2), (1, 4), (2, 3)]),
            (178, 2, &[(0, 2), (1, 6), (2, 1)]), (185, 2, &[(0, 4), (2, 1)]),
            (186, 2, &[(0, 4), (2, 3)]), (187, 2, &[(0, 4), (2, 5)]),
            (188, 2, &[(0, 4), (1, 2), (2, 1)]), (189, 2, &[(0, 4), (1, 2), (2, 3)]),
            (190, 2, &[(0, 4), (1, 4), (2, 1)]), (194, 2, &[(0, 6), (2, 1)]),
            (195, 2, &[(0, 6), (2, 3)]), (196, 2, &[(0, 6), (1, 2), (2, 1)]),
            (198, 2, &[(0, 8), (2, 1)]),
        ],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₃²), of S₃
// c[2] = 2 C(p₁² p₃⁴), of S₅
// c[3] = 2 C(p₁² p₃⁶), of S₇
// c[4] = 2 C(p₁² p₃⁸), of S₉
// c[5] = 2 C(p₁² p₂²), of S₃
// c[6] = 2 C(p₁² p₂² p₃²), of S₅
// c[7] = 2 C(p₁² p₂² p₃⁴), of S₇
// c[8] = 2 C(p₁² p₂² p₃⁶), of S₉
// c[9] = 2 C(p₁² p₂⁴), of S₅
// c[10] = 2 C(p₁² p₂⁴ p₃²), of S₇
// c[11] = 2 C(p₁² p₂⁴ p₃⁴), of S₉
// c[12] = 2 C(p₁² p₂⁶), of S₇
// c[13] = 2 C(p₁² p₂⁶ p₃²), of S₉
// c[14] = 2 C(p₁² p₂⁸), of S₉
// c[15] = 4 C(p₁⁴ p₃²), of S₅
// c[16] = 4 C(p₁⁴ p₃⁴), of S₇
// c[17] = 4 C(p₁⁴ p₃⁶), of S₉
// c[18] = 4 C(p₁⁴ p₂²), of S₅
// c[19] = 4 C(p₁⁴ p₂² p₃²), of S₇
// c[20] = 4 C(p₁⁴ p₂² p₃⁴), of S₉
// c[21] = 4 C(p₁⁴ p₂⁴), of S₇
// c[22] = 4 C(p₁⁴ p₂⁴ p₃²), of S₉
// c[23] = 4 C(p₁⁴ p₂⁶), of S₉
// c[24] = 6 C(p₁⁶ p₃²), of S₇
// c[25] = 6 C(p₁⁶ p₃⁴), of S₉
// c[26] = 6 C(p₁⁶ p₂²), of S₇
// c[27] = 6 C(p₁⁶ p₂² p₃²), of S₉
// c[28] = 6 C(p₁⁶ p₂⁴), of S₉
// c[29] = 8 C(p₁⁸ p₃²), of S₉
// c[30] = 8 C(p₁⁸ p₂²), of S₉
// c[31] = 2 C(p₂²), of S₁
// c[32] = 2 C(p₂² p₃²), of S₃
// c[33] = 2 C(p₂² p₃⁴), of S₅
// c[34] = 2 C(p₂² p₃⁶), of S₇
// c[35] = 2 C(p₂² p₃⁸), of S₉
// c[36] = 4 C(p₂⁴ p₃²), of S₅
// c[37] = 4 C(p₂⁴ p₃⁴), of S₇
// c[38] = 4 C(p₂⁴ p₃⁶), of S₉
// c[39] = 6 C(p₂⁶ p₃²), of S₇
// c[40] = 6 C(p₂⁶ p₃⁴), of S₉
// c[41] = 8 C(p₂⁸ p₃²), of S₉
// c[42] = 4 C(p₁² p₂⁴), of S₅
// c[43] = 4 C(p₁² p₂⁴ p₃²), of S₇
// c[44] = 4 C(p₁² p₂⁴ p₃⁴), of S₉
// c[45] = 6 C(p₁² p₂⁶), of S₇
// c[46] = 6 C(p₁² p₂⁶ p₃²), of S₉
// c[47] = 8 C(p₁² p₂⁸), of S₉
// c[48] = 2 C(p₁⁴ p₂²), of S₅
// c[49] = 2 C(p₁⁴ p₂² p₃²), of S₇
// c[50] = 2 C(p₁⁴ p₂² p₃⁴), of S₉
// c[51] = 6 C(p₁⁴ p₂⁶), of S₉
// c[52] = 2 C(p₁⁶ p₂²), of S₇
// c[53] = 2 C(p₁⁶ p₂² p₃²), of S₉
// c[54] = 4 C(p₁⁶ p₂⁴), of S₉
// c[55] = 2 C(p₁⁸ p₂²), of S₉
// c[56] = 2 C(p₃²), of S₁
// c[57] = 4 C(p₂² p₃⁴), of S₅
// c[58] = 6 C(p₂² p₃⁶), of S₇
// c[59] = 8 C(p₂² p₃⁸), of S₉
// c[60] = 2 C(p₂⁴ p₃²), of S₅
// c[61] = 6 C(p₂⁴ p₃⁶), of S₉
// c[62] = 2 C(p₂⁶ p₃²), of S₇
// c[63] = 4 C(p₂⁶ p₃⁴), of S₉
// c[64] = 2 C(p₂⁸ p₃²), of S₉
// c[65] = 4 C(p₁² p₃⁴), of S₅
// c[66] = 6 C(p₁² p₃⁶), of S₇
// c[67] = 8 C(p₁² p₃⁸), of S₉
// c[68] = 4 C(p₁² p₂² p₃⁴), of S₇
// c[69] = 6 C(p₁² p₂² p₃⁶), of S₉
// c[70] = 2 C(p₁⁴ p₃²), of S₅
// c[71] = 6 C(p₁⁴ p₃⁶), of S₉
// c[72] = 2 C(p₁⁴ p₂⁴ p₃²), of S₉
// c[73] = 2 C(p₁⁶ p₃²), of S₇
// c[74] = 4 C(p₁⁶ p₃⁴), of S₉
// c[75] = 2 C(p₁⁸ p₃²), of S₉
// c[76] = 8 C(p₁⁴ p₃²), of S₅
// c[77] = 8 C(p₁⁴ p₃⁴), of S₇
// c[78] = 8 C(p₁⁴ p₃⁶), of S₉
// c[79] = 8 C(p₁⁴ p₂²), of S₅
// c[80] = 8 C(p₁⁴ p₂² p₃²), of S₇
// c[81] = 8 C(p₁⁴ p₂² p₃⁴), of S₉
// c[82] = 8 C(p₁⁴ p₂⁴), of S₇
// c[83] = 8 C(p₁⁴ p₂⁴ p₃²), of S₉
// c[84] = 8 C(p₁⁴ p₂⁶), of S₉
// c[85] = 24 C(p₁⁶ p₃²), of S₇
// c[86] = 24 C(p₁⁶ p₃⁴), of S₉
// c[87] = 24 C(p₁⁶ p₂²), of S₇
// c[88] = 24 C(p₁⁶ p₂² p₃²), of S₉
// c[89] = 24 C(p₁⁶ p₂⁴), of S₉
// c[90] = 48 C(p₁⁸ p₃²), of S₉
// c[91] = 48 C(p₁⁸ p₂²), of S₉
// c[92] = 4 C(p₁² p₂²), of S₃
// c[93] = 4 C(p₁² p₂² p₃²), of S₅
// c[94] = 4 C(p₁² p₂² p₃⁶), of S₉
// c[95] = 8 C(p₁² p₂⁴), of S₅
// c[96] = 8 C(p₁² p₂⁴ p₃²), of S₇
// c[97] = 8 C(p₁² p₂⁴ p₃⁴), of S₉
// c[98] = 12 C(p₁² p₂⁶), of S₇
// c[99] = 12 C(p₁² p₂⁶ p₃²), of S₉
// c[100] = 16 C(p₁² p₂⁸), of S₉
// c[101] = 16 C(p₁⁴ p₂⁴), of S₇
// c[102] = 16 C(p₁⁴ p₂⁴ p₃²), of S₉
// c[103] = 24 C(p₁⁴ p₂⁶), of S₉
// c[104] = 12 C(p₁⁶ p₂²), of S₇
// c[105] = 12 C(p₁⁶ p₂² p₃²), of S₉
// c[106] = 16 C(p₁⁸ p₂²), of S₉
// c[107] = 4 C(p₁² p₃²), of S₃
// c[108] = 8 C(p₁² p₃⁴), of S₅
// c[109] = 12 C(p₁² p₃⁶), of S₇
// c[110] = 16 C(p₁² p₃⁸), of S₉
// c[111] = 8 C(p₁² p₂² p₃⁴), of S₇
// c[112] = 12 C(p₁² p₂² p₃⁶), of S₉
// c[113] = 4 C(p₁² p₂⁶ p₃²), of S₉
// c[114] = 16 C(p₁⁴ p₃⁴), of S₇
// c[115] = 24 C(p₁⁴ p₃⁶), of S₉
// c[116] = 16 C(p₁⁴ p₂² p₃⁴), of S₉
// c[117] = 12 C(p₁⁶ p₃²), of S₇
// c[118] = 16 C(p₁⁸ p₃²), of S₉
// c[119] = 8 C(p₂⁴ p₃²), of S₅
// c[120] = 8 C(p₂⁴ p₃⁴), of S₇
// c[121] = 8 C(p₂⁴ p₃⁶), of S₉
// c[122] = 24 C(p₂⁶ p₃²), of S₇
// c[123] = 24 C(p₂⁶ p₃⁴), of S₉
// c[124] = 48 C(p₂⁸ p₃²), of S₉
// c[125] = 24 C(p₁² p₂⁶), of S₇
// c[126] = 24 C(p₁² p₂⁶ p₃²), of S₉
// c[127] = 48 C(p₁² p₂⁸), of S₉
// c[128] = 8 C(p₁⁶ p₂⁴), of S₉
// c[129] = 4 C(p₂² p₃²), of S₃
// c[130] = 8 C(p₂² p₃⁴), of S₅
// c[131] = 12 C(p₂² p₃⁶), of S₇
// c[132] = 16 C(p₂² p₃⁸), of S₉
// c[133] = 16 C(p₂⁴ p₃⁴), of S₇
// c[134] = 24 C(p₂⁴ p₃⁶), of S₉
// c[135] = 12 C(p₂⁶ p₃²), of S₇
// c[136] = 16 C(p₂⁸ p₃²), of S₉
// c[137] = 16 C(p₁² p₂⁴ p₃⁴), of S₉
// c[138] = 4 C(p₁⁶ p₂² p₃²), of S₉
// c[139] = 24 C(p₂² p₃⁶), of S₇
// c[140] = 48 C(p₂² p₃⁸), of S₉
// c[141] = 8 C(p₂⁶ p₃⁴), of S₉
// c[142] = 24 C(p₁² p₃⁶), of S₇
// c[143] = 48 C(p₁² p₃⁸), of S₉
// c[144] = 24 C(p₁² p₂² p₃⁶), of S₉
// c[145] = 8 C(p₁⁶ p₃⁴), of S₉
// c[146] = C(p₂² p₃⁸), of S₉
// c[147] = C(p₂⁴ p₃⁶), of S₉
// c[148] = C(p₂⁶ p₃⁴), of S₉
// c[149] = C(p₂⁸ p₃²), of S₉
// c[150] = C(p₁² p₃⁸), of S₉
// c[151] = C(p₁² p₂² p₃⁶), of S₉
// c[152] = C(p₁² p₂⁴ p₃⁴), of S₉
// c[153] = C(p₁² p₂⁶ p₃²), of S₉
// c[154] = C(p₁² p₂⁸), of S₉
// c[155] = C(p₁⁴ p₃⁶), of S₉
// c[156] = C(p₁⁴ p₂² p₃⁴), of S₉
// c[157] = C(p₁⁴ p₂⁴ p₃²), of S₉
// c[158] = C(p₁⁴ p₂⁶), of S₉
// c[159] = C(p₁⁶ p₃⁴), of S₉
// c[160] = C(p₁⁶ p₂² p₃²), of S₉
// c[161] = C(p₁⁶ p₂⁴), of S₉
// c[162] = C(p₁⁸ p₃²), of S₉
// c[163] = C(p₁⁸ p₂²), of S₉
// c[410] = C(p₃²), of S₁
// c[411] = C(p₂²), of S₁
// c[412] = C(p₂² p₃²), of S₃
// c[413] = C(p₂² p₃⁴), of S₅
// c[414] = C(p₂² p₃⁶), of S₇
// c[415] = C(p₂⁴ p₃²), of S₅
// c[416] = C(p₂⁴ p₃⁴), of S₇
// c[417] = C(p₂⁶ p₃²), of S₇
// c[418] = C(p₁²), of S₁
// c[419] = C(p₁² p₃²), of S₃
// c[420] = C(p₁² p₃⁴), of S₅
// c[421] = C(p₁² p₃⁶), of S₇
// c[422] = C(p₁² p₂²), of S₃
// c[423] = C(p₁² p₂² p₃²), of S₅
// c[424] = C(p₁² p₂² p₃⁴), of S₇
// c[425] = C(p₁² p₂⁴), of S₅
// c[426] = C(p₁² p₂⁴ p₃²), of S₇
// c[427] = C(p₁² p₂⁶), of S₇
// c[428] = C(p₁⁴ p₃²), of S₅
// c[429] = C(p₁⁴ p₃⁴), of S₇
// c[430] = C(p₁⁴ p₂²), of S₅
// c[431] = C(p₁⁴ p₂² p₃²), of S₇
// c[432] = C(p₁⁴ p₂⁴), of S₇
// c[433] = C(p₁⁶ p₃²), of S₇
// c[434] = C(p₁⁶ p₂²), of S₇
