// learned: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `learned from 60 samples, dt = 0.1`
//
// Group: SO3. Chart exp, truncation K = 1, order of accuracy 2.
// Terms: S1: 35.
// Operations: gradient and Hessian 83 multiplications and 83 additions; predictor of degree 2 357 and 354.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `learned from 60 samples, dt = 0.1`
///
/// Group: SO3. Chart exp, truncation K = 1, order of accuracy 2.
/// Terms: S1: 35.
/// Operations: gradient and Hessian 83 multiplications and 83 additions; predictor of degree 2 357 and 354.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct Learned<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 460],
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
    impl<T: ::coadjoint::Scalar> Learned<T> {
        /// K: the series S₁ … S_K of the generating function is kept.
        pub const TRUNCATION: usize = 1;
        /// The order of accuracy, K + 1.
        pub const ORDER: usize = 2;
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
        ) -> ::core::result::Result<[T; 520], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                3,
                1,
                520,
            >(Self::table(), &[], step, symbols)
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 520],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                3,
                520,
                427,
                460,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 460]) -> Self {
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
            let mu2 = input[1];
            let mu3 = input[2];
            let t1 = mu3.times_plus(c[457], c[456]);
            let t2 = mu2.times_plus(c[458], t1);
            let t3 = mu1.times_plus(c[459], t2);
            let t4 = mu3.times_plus(c[454], c[453]);
            let t5 = mu2.times_plus(c[455], t4);
            let t6 = mu3.times_plus(c[452], c[451]);
            let t7 = mu3.times_plus(t6, c[450]);
            let t8 = mu2.times_plus(t5, t7);
            let t9 = mu1.times_plus(t3, t8);
            let t10 = mu3.times_plus(c[448], c[447]);
            let t11 = mu2.times_plus(c[449], t10);
            let t12 = mu3.times_plus(c[446], c[445]);
            let t13 = mu3.times_plus(t12, c[444]);
            let t14 = mu2.times_plus(t11, t13);
            let t15 = mu3.times_plus(c[443], c[442]);
            let t16 = mu3.times_plus(t15, c[441]);
            let t17 = mu3.times_plus(t16, c[440]);
            let t18 = mu2.times_plus(t14, t17);
            let t19 = mu1.times_plus(t9, t18);
            let t20 = mu3.times_plus(c[438], c[437]);
            let t21 = mu2.times_plus(c[439], t20);
            let t22 = mu3.times_plus(c[436], c[435]);
            let t23 = mu3.times_plus(t22, c[434]);
            let t24 = mu2.times_plus(t21, t23);
            let t25 = mu3.times_plus(c[433], c[432]);
            let t26 = mu3.times_plus(t25, c[431]);
            let t27 = mu3.times_plus(t26, c[430]);
            let t28 = mu2.times_plus(t24, t27);
            let t29 = mu3.times_plus(c[429], c[428]);
            let t30 = mu3.times_plus(t29, c[427]);
            let t31 = mu3.times_plus(t30, c[426]);
            let t32 = mu3.times_plus(t31, c[425]);
            let t33 = mu2.times_plus(t28, t32);
            // H_red(μ)
            let t34 = mu1.times_plus(t19, t33);
            t34
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for Learned<T> {
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
            let p2 = input[1];
            let p3 = input[2];
            let t1 = p3.times_plus(c[48], c[423]);
            let t2 = p2.times_plus(c[35], t1);
            let t3 = p1.times_plus(c[424], t2);
            let t4 = p3.times_plus(c[34], c[33]);
            let t5 = p2.times_plus(c[422], t4);
            let t6 = p3.times_plus(c[421], c[47]);
            let t7 = p3.times_plus(t6, c[420]);
            let t8 = p2.times_plus(t5, t7);
            let t9 = p1.times_plus(t3, t8);
            let t10 = p3.times_plus(c[18], c[17]);
            let t11 = p2.times_plus(c[19], t10);
            let t12 = p3.times_plus(c[16], c[15]);
            let t13 = p3.times_plus(t12, c[14]);
            let t14 = p2.times_plus(t11, t13);
            let t15 = p3.times_plus(c[13], c[12]);
            let t16 = p3.times_plus(t15, c[11]);
            let t17 = p3.times_plus(t16, c[10]);
            let t18 = p2.times_plus(t14, t17);
            let t19 = p1.times_plus(t9, t18);
            let t20 = p3.times_plus(c[46], c[418]);
            let t21 = p2.times_plus(c[419], t20);
            let t22 = p3.times_plus(c[417], c[45]);
            let t23 = p3.times_plus(t22, c[416]);
            let t24 = p2.times_plus(t21, t23);
            let t25 = p3.times_plus(c[32], c[31]);
            let t26 = p3.times_plus(t25, c[30]);
            let t27 = p3.times_plus(t26, c[29]);
            let t28 = p2.times_plus(t24, t27);
            let t29 = p3.times_plus(c[415], c[414]);
            let t30 = p3.times_plus(t29, c[413]);
            let t31 = p3.times_plus(t30, c[44]);
            let t32 = p3.times_plus(t31, c[412]);
            let t33 = p2.times_plus(t28, t32);
            // S(p)
            let t34 = p1.times_plus(t19, t33);
            t34
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p1 = input[0];
            let p2 = input[1];
            let p3 = input[2];
            let t1 = p3.times_plus(c[7], c[6]);
            let t2 = p2.times_plus(c[8], t1);
            let t3 = p1.times_plus(c[9], t2);
            let t4 = p3.times_plus(c[4], c[3]);
            let t5 = p2.times_plus(c[5], t4);
            let t6 = p3.times_plus(c[2], c[1]);
            let t7 = p3.times_plus(t6, c[0]);
            let t8 = p2.times_plus(t5, t7);
            let t9 = p1.times_plus(t3, t8);
            let t10 = p3.times_plus(c[18], c[17]);
            let t11 = p2.times_plus(c[19], t10);
            let t12 = p3.times_plus(c[16], c[15]);
            let t13 = p3.times_plus(t12, c[14]);
            let t14 = p2.times_plus(t11, t13);
            let t15 = p3.times_plus(c[13], c[12]);
            let t16 = p3.times_plus(t15, c[11]);
            let t17 = p3.times_plus(t16, c[10]);
            let t18 = p2.times_plus(t14, t17);
            // ∂(S₁)/∂p₁
            let t19 = p1.times_plus(t9, t18);
            let t20 = p3.times_plus(c[27], c[26]);
            let t21 = p2.times_plus(c[28], t20);
            let t22 = p1.times_plus(c[5], t21);
            let t23 = p3.times_plus(c[24], c[23]);
            let t24 = p2.times_plus(c[25], t23);
            let t25 = p3.times_plus(c[22], c[21]);
            let t26 = p3.times_plus(t25, c[20]);
            let t27 = p2.times_plus(t24, t26);
            let t28 = p1.times_plus(t22, t27);
            let t29 = p3.times_plus(c[34], c[33]);
            let t30 = p1.times_plus(c[35], t29);
            let t31 = p1.times_plus(t30, t13);
            let t32 = p3.times_plus(c[32], c[31]);
            let t33 = p3.times_plus(t32, c[30]);
            let t34 = p3.times_plus(t33, c[29]);
            let t35 = p1.times_plus(t31, t34);
            // ∂(S₁)/∂p₂
            let t36 = p2.times_plus(t28, t35);
            let t37 = p3.times_plus(c[42], c[41]);
            let t38 = p2.times_plus(c[43], t37);
            let t39 = p1.times_plus(c[2], t38);
            let t40 = p3.times_plus(c[40], c[39]);
            let t41 = p2.times_plus(c[22], t40);
            let t42 = p3.times_plus(c[38], c[37]);
            let t43 = p3.times_plus(t42, c[36]);
            let t44 = p2.times_plus(t41, t43);
            let t45 = p1.times_plus(t39, t44);
            let t46 = p2.times_plus(c[34], c[47]);
            let t47 = p1.times_plus(c[48], t46);
            let t48 = p2.times_plus(c[18], c[15]);
            let t49 = p2.times_plus(t48, c[11]);
            let t50 = p1.times_plus(t47, t49);
            let t51 = p2.times_plus(c[46], c[45]);
            let t52 = p2.times_plus(t51, c[30]);
            let t53 = p2.times_plus(t52, c[44]);
            let t54 = p1.times_plus(t50, t53);
            // ∂(S₁)/∂p₃
            let t55 = p3.times_plus(t45, t54);
            <Vector<T> as ::core::convert::From<_>>::from([t19, t36, t55])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p1 = input[0];
            let p2 = input[1];
            let p3 = input[2];
            let t1 = p3.times_plus(c[7], c[6]);
            let t2 = p2.times_plus(c[8], t1);
            let t3 = p1.times_plus(c[9], t2);
            let t4 = p3.times_plus(c[4], c[3]);
            let t5 = p2.times_plus(c[5], t4);
            let t6 = p3.times_plus(c[2], c[1]);
            let t7 = p3.times_plus(t6, c[0]);
            let t8 = p2.times_plus(t5, t7);
            let t9 = p1.times_plus(t3, t8);
            let t10 = p3.times_plus(c[18], c[17]);
            let t11 = p2.times_plus(c[19], t10);
            let t12 = p3.times_plus(c[16], c[15]);
            let t13 = p3.times_plus(t12, c[14]);
            let t14 = p2.times_plus(t11, t13);
            let t15 = p3.times_plus(c[13], c[12]);
            let t16 = p3.times_plus(t15, c[11]);
            let t17 = p3.times_plus(t16, c[10]);
            let t18 = p2.times_plus(t14, t17);
            // ∂S/∂p₁
            let t19 = p1.times_plus(t9, t18);
            let t20 = p3.times_plus(c[27], c[26]);
            let t21 = p2.times_plus(c[28], t20);
            let t22 = p1.times_plus(c[5], t21);
            let t23 = p3.times_plus(c[24], c[23]);
            let t24 = p2.times_plus(c[25], t23);
            let t25 = p3.times_plus(c[22], c[21]);
            let t26 = p3.times_plus(t25, c[20]);
            let t27 = p2.times_plus(t24, t26);
            let t28 = p1.times_plus(t22, t27);
            let t29 = p3.times_plus(c[34], c[33]);
            let t30 = p1.times_plus(c[35], t29);
            let t31 = p1.times_plus(t30, t13);
            let t32 = p3.times_plus(c[32], c[31]);
            let t33 = p3.times_plus(t32, c[30]);
            let t34 = p3.times_plus(t33, c[29]);
            let t35 = p1.times_plus(t31, t34);
            // ∂S/∂p₂
            let t36 = p2.times_plus(t28, t35);
            let t37 = p3.times_plus(c[42], c[41]);
            let t38 = p2.times_plus(c[43], t37);
            let t39 = p1.times_plus(c[2], t38);
            let t40 = p3.times_plus(c[40], c[39]);
            let t41 = p2.times_plus(c[22], t40);
            let t42 = p3.times_plus(c[38], c[37]);
            let t43 = p3.times_plus(t42, c[36]);
            let t44 = p2.times_plus(t41, t43);
            let t45 = p1.times_plus(t39, t44);
            let t46 = p2.times_plus(c[34], c[47]);
            let t47 = p1.times_plus(c[48], t46);
            let t48 = p2.times_plus(c[18], c[15]);
            let t49 = p2.times_plus(t48, c[11]);
            let t50 = p1.times_plus(t47, t49);
            let t51 = p2.times_plus(c[46], c[45]);
            let t52 = p2.times_plus(t51, c[30]);
            let t53 = p2.times_plus(t52, c[44]);
            let t54 = p1.times_plus(t50, t53);
            // ∂S/∂p₃
            let t55 = p3.times_plus(t45, t54);
            let t56 = p1.times_plus(c[49], t2);
            let t57 = p1 * t56;
            // ∂²(S₁)/∂p₁²
            let t58 = t9 + t57;
            let t59 = p2.times_plus(c[50], t4);
            let t60 = p1.times_plus(c[8], t59);
            let t61 = p2.times_plus(t21, t13);
            // ∂²(S₁)/∂p₁∂p₂
            let t62 = p1.times_plus(t60, t61);
            let t63 = p3.times_plus(c[51], c[1]);
            let t64 = p2.times_plus(c[4], t63);
            let t65 = p1.times_plus(c[7], t64);
            let t66 = p3.times_plus(c[43], c[15]);
            let t67 = p2.times_plus(c[18], t66);
            let t68 = p3.times_plus(t37, c[11]);
            let t69 = p2.times_plus(t67, t68);
            // ∂²(S₁)/∂p₁∂p₃
            let t70 = p1.times_plus(t65, t69);
            let t71 = p2.times_plus(c[52], t23);
            let t72 = p1.times_plus(c[28], t71);
            let t73 = p2 * t72;
            // ∂²(S₁)/∂p₂²
            let t74 = t28 + t73;
            let t75 = p2.times_plus(c[27], t66);
            let t76 = p1.times_plus(c[34], t75);
            let t77 = p3.times_plus(c[53], c[21]);
            let t78 = p2.times_plus(c[24], t77);
            let t79 = p3.times_plus(t40, c[30]);
            let t80 = p2.times_plus(t78, t79);
            // ∂²(S₁)/∂p₂∂p₃
            let t81 = p1.times_plus(t76, t80);
            let t82 = p3.times_plus(c[54], c[37]);
            let t83 = p2.times_plus(c[40], t82);
            let t84 = p1.times_plus(c[42], t83);
            let t85 = p3 * t84;
            // ∂²(S₁)/∂p₃²
            let t86 = t45 + t85;
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t19, t36, t55]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([[t58, t62, t70], [t62, t74, t81], [t70, t81, t86]]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let mu1 = input[0];
            let mu2 = input[1];
            let mu3 = input[2];
            let t1 = mu3.times_plus(c[171], c[170]);
            let t2 = mu2.times_plus(c[172], t1);
            let t3 = mu1.times_plus(c[173], t2);
            let t4 = mu3.times_plus(c[168], c[167]);
            let t5 = mu2.times_plus(c[169], t4);
            let t6 = mu3.times_plus(c[166], c[165]);
            let t7 = mu3.times_plus(t6, c[164]);
            let t8 = mu2.times_plus(t5, t7);
            let t9 = mu1.times_plus(t3, t8);
            let t10 = mu3.times_plus(c[162], c[161]);
            let t11 = mu2.times_plus(c[163], t10);
            let t12 = mu3.times_plus(c[160], c[159]);
            let t13 = mu3.times_plus(t12, c[158]);
            let t14 = mu2.times_plus(t11, t13);
            let t15 = mu3.times_plus(c[157], c[156]);
            let t16 = mu3.times_plus(t15, c[155]);
            let t17 = mu3.times_plus(t16, c[154]);
            let t18 = mu2.times_plus(t14, t17);
            let t19 = mu1.times_plus(t9, t18);
            let t20 = mu3.times_plus(c[152], c[151]);
            let t21 = mu2.times_plus(c[153], t20);
            let t22 = mu3.times_plus(c[150], c[149]);
            let t23 = mu3.times_plus(t22, c[148]);
            let t24 = mu2.times_plus(t21, t23);
            let t25 = mu3.times_plus(c[147], c[146]);
            let t26 = mu3.times_plus(t25, c[145]);
            let t27 = mu3.times_plus(t26, c[144]);
            let t28 = mu2.times_plus(t24, t27);
            let t29 = mu3.times_plus(c[143], c[142]);
            let t30 = mu3.times_plus(t29, c[141]);
            let t31 = mu3.times_plus(t30, c[140]);
            let t32 = mu3.times_plus(t31, c[139]);
            let t33 = mu2.times_plus(t28, t32);
            let t34 = mu1.times_plus(t19, t33);
            let t35 = mu3.times_plus(c[137], c[136]);
            let t36 = mu2.times_plus(c[138], t35);
            let t37 = mu3.times_plus(c[135], c[134]);
            let t38 = mu3.times_plus(t37, c[133]);
            let t39 = mu2.times_plus(t36, t38);
            let t40 = mu3.times_plus(c[132], c[131]);
            let t41 = mu3.times_plus(t40, c[130]);
            let t42 = mu3.times_plus(t41, c[129]);
            let t43 = mu2.times_plus(t39, t42);
            let t44 = mu3.times_plus(c[128], c[127]);
            let t45 = mu3.times_plus(t44, c[126]);
            let t46 = mu3.times_plus(t45, c[125]);
            let t47 = mu3.times_plus(t46, c[124]);
            let t48 = mu2.times_plus(t43, t47);
            let t49 = mu3.times_plus(c[123], c[122]);
            let t50 = mu3.times_plus(t49, c[121]);
            let t51 = mu3.times_plus(t50, c[120]);
            let t52 = mu3.times_plus(t51, c[119]);
            let t53 = mu3.times_plus(t52, c[118]);
            let t54 = mu2.times_plus(t48, t53);
            let t55 = mu1.times_plus(t34, t54);
            let t56 = mu3.times_plus(c[116], c[115]);
            let t57 = mu2.times_plus(c[117], t56);
            let t58 = mu3.times_plus(c[114], c[113]);
            let t59 = mu3.times_plus(t58, c[112]);
            let t60 = mu2.times_plus(t57, t59);
            let t61 = mu3.times_plus(c[111], c[110]);
            let t62 = mu3.times_plus(t61, c[109]);
            let t63 = mu3.times_plus(t62, c[108]);
            let t64 = mu2.times_plus(t60, t63);
            let t65 = mu3.times_plus(c[107], c[106]);
            let t66 = mu3.times_plus(t65, c[105]);
            let t67 = mu3.times_plus(t66, c[104]);
            let t68 = mu3.times_plus(t67, c[103]);
            let t69 = mu2.times_plus(t64, t68);
            let t70 = mu3.times_plus(c[102], c[101]);
            let t71 = mu3.times_plus(t70, c[100]);
            let t72 = mu3.times_plus(t71, c[99]);
            let t73 = mu3.times_plus(t72, c[98]);
            let t74 = mu3.times_plus(t73, c[97]);
            let t75 = mu2.times_plus(t69, t74);
            let t76 = mu3.times_plus(c[96], c[95]);
            let t77 = mu3.times_plus(t76, c[94]);
            let t78 = mu3.times_plus(t77, c[93]);
            let t79 = mu3.times_plus(t78, c[92]);
            let t80 = mu3.times_plus(t79, c[91]);
            let t81 = mu3.times_plus(t80, c[90]);
            let t82 = mu2.times_plus(t75, t81);
            let t83 = mu1.times_plus(t55, t82);
            let t84 = mu3.times_plus(c[88], c[87]);
            let t85 = mu2.times_plus(c[89], t84);
            let t86 = mu3.times_plus(c[86], c[85]);
            let t87 = mu3.times_plus(t86, c[84]);
            let t88 = mu2.times_plus(t85, t87);
            let t89 = mu3.times_plus(c[83], c[82]);
            let t90 = mu3.times_plus(t89, c[81]);
            let t91 = mu3.times_plus(t90, c[80]);
            let t92 = mu2.times_plus(t88, t91);
            let t93 = mu3.times_plus(c[79], c[78]);
            let t94 = mu3.times_plus(t93, c[77]);
            let t95 = mu3.times_plus(t94, c[76]);
            let t96 = mu3.times_plus(t95, c[75]);
            let t97 = mu2.times_plus(t92, t96);
            let t98 = mu3.times_plus(c[74], c[73]);
            let t99 = mu3.times_plus(t98, c[72]);
            let t100 = mu3.times_plus(t99, c[71]);
            let t101 = mu3.times_plus(t100, c[70]);
            let t102 = mu3.times_plus(t101, c[69]);
            let t103 = mu2.times_plus(t97, t102);
            let t104 = mu3.times_plus(c[68], c[67]);
            let t105 = mu3.times_plus(t104, c[66]);
            let t106 = mu3.times_plus(t105, c[65]);
            let t107 = mu3.times_plus(t106, c[64]);
            let t108 = mu3.times_plus(t107, c[63]);
            let t109 = mu3.times_plus(t108, c[62]);
            let t110 = mu2.times_plus(t103, t109);
            let t111 = mu3.times_plus(c[61], c[60]);
            let t112 = mu3.times_plus(t111, c[59]);
            let t113 = mu3.times_plus(t112, c[58]);
            let t114 = mu3.times_plus(t113, c[57]);
            let t115 = mu3.times_plus(t114, c[56]);
            let t116 = mu3.times_plus(t115, c[55]);
            let t117 = mu3 * t116;
            let t118 = mu2.times_plus(t110, t117);
            // p₁, the first guess
            let t119 = mu1.times_plus(t83, t118);
            let t120 = mu3.times_plus(c[290], c[289]);
            let t121 = mu2.times_plus(c[291], t120);
            let t122 = mu1.times_plus(c[292], t121);
            let t123 = mu3.times_plus(c[287], c[286]);
            let t124 = mu2.times_plus(c[288], t123);
            let t125 = mu3.times_plus(c[285], c[284]);
            let t126 = mu3.times_plus(t125, c[283]);
            let t127 = mu2.times_plus(t124, t126);
            let t128 = mu1.times_plus(t122, t127);
            let t129 = mu3.times_plus(c[281], c[280]);
            let t130 = mu2.times_plus(c[282], t129);
            let t131 = mu3.times_plus(c[279], c[278]);
            let t132 = mu3.times_plus(t131, c[277]);
            let t133 = mu2.times_plus(t130, t132);
            let t134 = mu3.times_plus(c[276], c[275]);
            let t135 = mu3.times_plus(t134, c[274]);
            let t136 = mu3.times_plus(t135, c[273]);
            let t137 = mu2.times_plus(t133, t136);
            let t138 = mu1.times_plus(t128, t137);
            let t139 = mu3.times_plus(c[271], c[270]);
            let t140 = mu2.times_plus(c[272], t139);
            let t141 = mu3.times_plus(c[269], c[268]);
            let t142 = mu3.times_plus(t141, c[267]);
            let t143 = mu2.times_plus(t140, t142);
            let t144 = mu3.times_plus(c[266], c[265]);
            let t145 = mu3.times_plus(t144, c[264]);
            let t146 = mu3.times_plus(t145, c[263]);
            let t147 = mu2.times_plus(t143, t146);
            let t148 = mu3.times_plus(c[262], c[261]);
            let t149 = mu3.times_plus(t148, c[260]);
            let t150 = mu3.times_plus(t149, c[259]);
            let t151 = mu3.times_plus(t150, c[258]);
            let t152 = mu2.times_plus(t147, t151);
            let t153 = mu1.times_plus(t138, t152);
            let t154 = mu3.times_plus(c[256], c[255]);
            let t155 = mu2.times_plus(c[257], t154);
            let t156 = mu3.times_plus(c[254], c[253]);
            let t157 = mu3.times_plus(t156, c[252]);
            let t158 = mu2.times_plus(t155, t157);
            let t159 = mu3.times_plus(c[251], c[250]);
            let t160 = mu3.times_plus(t159, c[249]);
            let t161 = mu3.times_plus(t160, c[248]);
            let t162 = mu2.times_plus(t158, t161);
            let t163 = mu3.times_plus(c[247], c[246]);
            let t164 = mu3.times_plus(t163, c[245]);
            let t165 = mu3.times_plus(t164, c[244]);
            let t166 = mu3.times_plus(t165, c[243]);
            let t167 = mu2.times_plus(t162, t166);
            let t168 = mu3.times_plus(c[242], c[241]);
            let t169 = mu3.times_plus(t168, c[240]);
            let t170 = mu3.times_plus(t169, c[239]);
            let t171 = mu3.times_plus(t170, c[238]);
            let t172 = mu3.times_plus(t171, c[237]);
            let t173 = mu2.times_plus(t167, t172);
            let t174 = mu1.times_plus(t153, t173);
            let t175 = mu3.times_plus(c[235], c[234]);
            let t176 = mu2.times_plus(c[236], t175);
            let t177 = mu3.times_plus(c[233], c[232]);
            let t178 = mu3.times_plus(t177, c[231]);
            let t179 = mu2.times_plus(t176, t178);
            let t180 = mu3.times_plus(c[230], c[229]);
            let t181 = mu3.times_plus(t180, c[228]);
            let t182 = mu3.times_plus(t181, c[227]);
            let t183 = mu2.times_plus(t179, t182);
            let t184 = mu3.times_plus(c[226], c[225]);
            let t185 = mu3.times_plus(t184, c[224]);
            let t186 = mu3.times_plus(t185, c[223]);
            let t187 = mu3.times_plus(t186, c[222]);
            let t188 = mu2.times_plus(t183, t187);
            let t189 = mu3.times_plus(c[221], c[220]);
            let t190 = mu3.times_plus(t189, c[219]);
            let t191 = mu3.times_plus(t190, c[218]);
            let t192 = mu3.times_plus(t191, c[217]);
            let t193 = mu3.times_plus(t192, c[216]);
            let t194 = mu2.times_plus(t188, t193);
            let t195 = mu3.times_plus(c[215], c[214]);
            let t196 = mu3.times_plus(t195, c[213]);
            let t197 = mu3.times_plus(t196, c[212]);
            let t198 = mu3.times_plus(t197, c[211]);
            let t199 = mu3.times_plus(t198, c[210]);
            let t200 = mu3.times_plus(t199, c[209]);
            let t201 = mu2.times_plus(t194, t200);
            let t202 = mu1.times_plus(t174, t201);
            let t203 = mu3.times_plus(c[207], c[206]);
            let t204 = mu2.times_plus(c[208], t203);
            let t205 = mu3.times_plus(c[205], c[204]);
            let t206 = mu3.times_plus(t205, c[203]);
            let t207 = mu2.times_plus(t204, t206);
            let t208 = mu3.times_plus(c[202], c[201]);
            let t209 = mu3.times_plus(t208, c[200]);
            let t210 = mu3.times_plus(t209, c[199]);
            let t211 = mu2.times_plus(t207, t210);
            let t212 = mu3.times_plus(c[198], c[197]);
            let t213 = mu3.times_plus(t212, c[196]);
            let t214 = mu3.times_plus(t213, c[195]);
            let t215 = mu3.times_plus(t214, c[194]);
            let t216 = mu2.times_plus(t211, t215);
            let t217 = mu3.times_plus(c[193], c[192]);
            let t218 = mu3.times_plus(t217, c[191]);
            let t219 = mu3.times_plus(t218, c[190]);
            let t220 = mu3.times_plus(t219, c[189]);
            let t221 = mu3.times_plus(t220, c[188]);
            let t222 = mu2.times_plus(t216, t221);
            let t223 = mu3.times_plus(c[187], c[186]);
            let t224 = mu3.times_plus(t223, c[185]);
            let t225 = mu3.times_plus(t224, c[184]);
            let t226 = mu3.times_plus(t225, c[183]);
            let t227 = mu3.times_plus(t226, c[182]);
            let t228 = mu3.times_plus(t227, c[181]);
            let t229 = mu2.times_plus(t222, t228);
            let t230 = mu3.times_plus(c[180], c[179]);
            let t231 = mu3.times_plus(t230, c[178]);
            let t232 = mu3.times_plus(t231, c[177]);
            let t233 = mu3.times_plus(t232, c[176]);
            let t234 = mu3.times_plus(t233, c[175]);
            let t235 = mu3.times_plus(t234, c[174]);
            let t236 = mu3 * t235;
            let t237 = mu2.times_plus(t229, t236);
            // p₂, the first guess
            let t238 = mu1.times_plus(t202, t237);
            let t239 = mu3.times_plus(c[409], c[408]);
            let t240 = mu2.times_plus(c[410], t239);
            let t241 = mu1.times_plus(c[411], t240);
            let t242 = mu3.times_plus(c[406], c[405]);
            let t243 = mu2.times_plus(c[407], t242);
            let t244 = mu3.times_plus(c[404], c[403]);
            let t245 = mu3.times_plus(t244, c[402]);
            let t246 = mu2.times_plus(t243, t245);
            let t247 = mu1.times_plus(t241, t246);
            let t248 = mu3.times_plus(c[400], c[399]);
            let t249 = mu2.times_plus(c[401], t248);
            let t250 = mu3.times_plus(c[398], c[397]);
            let t251 = mu3.times_plus(t250, c[396]);
            let t252 = mu2.times_plus(t249, t251);
            let t253 = mu3.times_plus(c[395], c[394]);
            let t254 = mu3.times_plus(t253, c[393]);
            let t255 = mu3.times_plus(t254, c[392]);
            let t256 = mu2.times_plus(t252, t255);
            let t257 = mu1.times_plus(t247, t256);
            let t258 = mu3.times_plus(c[390], c[389]);
            let t259 = mu2.times_plus(c[391], t258);
            let t260 = mu3.times_plus(c[388], c[387]);
            let t261 = mu3.times_plus(t260, c[386]);
            let t262 = mu2.times_plus(t259, t261);
            let t263 = mu3.times_plus(c[385], c[384]);
            let t264 = mu3.times_plus(t263, c[383]);
            let t265 = mu3.times_plus(t264, c[382]);
            let t266 = mu2.times_plus(t262, t265);
            let t267 = mu3.times_plus(c[381], c[380]);
            let t268 = mu3.times_plus(t267, c[379]);
            let t269 = mu3.times_plus(t268, c[378]);
            let t270 = mu3.times_plus(t269, c[377]);
            let t271 = mu2.times_plus(t266, t270);
            let t272 = mu1.times_plus(t257, t271);
            let t273 = mu3.times_plus(c[375], c[374]);
            let t274 = mu2.times_plus(c[376], t273);
            let t275 = mu3.times_plus(c[373], c[372]);
            let t276 = mu3.times_plus(t275, c[371]);
            let t277 = mu2.times_plus(t274, t276);
            let t278 = mu3.times_plus(c[370], c[369]);
            let t279 = mu3.times_plus(t278, c[368]);
            let t280 = mu3.times_plus(t279, c[367]);
            let t281 = mu2.times_plus(t277, t280);
            let t282 = mu3.times_plus(c[366], c[365]);
            let t283 = mu3.times_plus(t282, c[364]);
            let t284 = mu3.times_plus(t283, c[363]);
            let t285 = mu3.times_plus(t284, c[362]);
            let t286 = mu2.times_plus(t281, t285);
            let t287 = mu3.times_plus(c[361], c[360]);
            let t288 = mu3.times_plus(t287, c[359]);
            let t289 = mu3.times_plus(t288, c[358]);
            let t290 = mu3.times_plus(t289, c[357]);
            let t291 = mu3.times_plus(t290, c[356]);
            let t292 = mu2.times_plus(t286, t291);
            let t293 = mu1.times_plus(t272, t292);
            let t294 = mu3.times_plus(c[354], c[353]);
            let t295 = mu2.times_plus(c[355], t294);
            let t296 = mu3.times_plus(c[352], c[351]);
            let t297 = mu3.times_plus(t296, c[350]);
            let t298 = mu2.times_plus(t295, t297);
            let t299 = mu3.times_plus(c[349], c[348]);
            let t300 = mu3.times_plus(t299, c[347]);
            let t301 = mu3.times_plus(t300, c[346]);
            let t302 = mu2.times_plus(t298, t301);
            let t303 = mu3.times_plus(c[345], c[344]);
            let t304 = mu3.times_plus(t303, c[343]);
            let t305 = mu3.times_plus(t304, c[342]);
            let t306 = mu3.times_plus(t305, c[341]);
            let t307 = mu2.times_plus(t302, t306);
            let t308 = mu3.times_plus(c[340], c[339]);
            let t309 = mu3.times_plus(t308, c[338]);
            let t310 = mu3.times_plus(t309, c[337]);
            let t311 = mu3.times_plus(t310, c[336]);
            let t312 = mu3.times_plus(t311, c[335]);
            let t313 = mu2.times_plus(t307, t312);
            let t314 = mu3.times_plus(c[334], c[333]);
            let t315 = mu3.times_plus(t314, c[332]);
            let t316 = mu3.times_plus(t315, c[331]);
            let t317 = mu3.times_plus(t316, c[330]);
            let t318 = mu3.times_plus(t317, c[329]);
            let t319 = mu3.times_plus(t318, c[328]);
            let t320 = mu2.times_plus(t313, t319);
            let t321 = mu1.times_plus(t293, t320);
            let t322 = mu3.times_plus(c[326], c[325]);
            let t323 = mu2.times_plus(c[327], t322);
            let t324 = mu3.times_plus(c[324], c[323]);
            let t325 = mu3.times_plus(t324, c[322]);
            let t326 = mu2.times_plus(t323, t325);
            let t327 = mu3.times_plus(c[321], c[320]);
            let t328 = mu3.times_plus(t327, c[319]);
            let t329 = mu3.times_plus(t328, c[318]);
            let t330 = mu2.times_plus(t326, t329);
            let t331 = mu3.times_plus(c[317], c[316]);
            let t332 = mu3.times_plus(t331, c[315]);
            let t333 = mu3.times_plus(t332, c[314]);
            let t334 = mu3.times_plus(t333, c[313]);
            let t335 = mu2.times_plus(t330, t334);
            let t336 = mu3.times_plus(c[312], c[311]);
            let t337 = mu3.times_plus(t336, c[310]);
            let t338 = mu3.times_plus(t337, c[309]);
            let t339 = mu3.times_plus(t338, c[308]);
            let t340 = mu3.times_plus(t339, c[307]);
            let t341 = mu2.times_plus(t335, t340);
            let t342 = mu3.times_plus(c[306], c[305]);
            let t343 = mu3.times_plus(t342, c[304]);
            let t344 = mu3.times_plus(t343, c[303]);
            let t345 = mu3.times_plus(t344, c[302]);
            let t346 = mu3.times_plus(t345, c[301]);
            let t347 = mu3.times_plus(t346, c[300]);
            let t348 = mu2.times_plus(t341, t347);
            let t349 = mu3.times_plus(c[299], c[298]);
            let t350 = mu3.times_plus(t349, c[297]);
            let t351 = mu3.times_plus(t350, c[296]);
            let t352 = mu3.times_plus(t351, c[295]);
            let t353 = mu3.times_plus(t352, c[294]);
            let t354 = mu3.times_plus(t353, c[293]);
            let t355 = mu3 * t354;
            let t356 = mu2.times_plus(t348, t355);
            // p₃, the first guess
            let t357 = mu1.times_plus(t321, t356);
            <Vector<T> as ::core::convert::From<_>>::from([t119, t238, t357])
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for Learned<T> {
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
    impl ::coadjoint::Lanes for Learned<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = Learned<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> Learned<L> {
            Learned {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> Learned<T> {
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
            (-1.4810836096863522, 0), (0.0000000014432983624537077, 0), (0.19999998816076822, 0),
            (0.0000000007508355777177541, 0), (0.0000000024901410145621633, 0),
            (-0.0000000022159522102461385, 0), (-0.00000000142671259160627, 0),
            (0.0000000009849062259254318, 0), (0.00000000016660352108436305, 0),
            (0.24999999466504325, 0), (-0.0000000004934142731346956, 0),
            (0.0000027804787169772496, 0), (0.0000000004129066931011768, 0),
            (0.0000000004279283946856982, 0), (0.0000000006475555932856761, 0),
            (-0.0000000022929081115486527, 0), (-0.0000000016998980526673803, 0),
            (0.0000000012388829715968155, 0), (0.000000001124149854571188, 0),
            (-0.0000000019686319015652448, 0), (-0.00000000011435310681365792, 0),
            (0.0000000009335910249828172, 0), (-0.0000000003444825664305947, 0),
            (0.00000000015904974935070187, 0), (0.00000000026889217484821454, 0),
            (0.3333333261464789, 0), (-0.0000000012204003801389426, 0),
            (0.000014823387360977377, 0), (0.00000000003252740209730518, 0),
            (0.00000000015225274610585574, 0), (0.000004633815639580159, 0),
            (0.0000000004731315508847518, 0), (-0.00000000022342191601303586, 0),
            (0.0000000004864042788580974, 0), (0.000000000239528580208184, 0),
            (-1.4810836096863522, 0), (0.0000000014432983624537077, 0), (0.19999998816076822, 0),
            (0.0000000007508355777177541, 0), (0.0000000024901410145621633, 0),
            (-0.0000000022159522102461385, 0), (-0.00000000142671259160627, 0),
            (0.0000000009849062259254318, 0), (0.00000000016660352108436305, 0),
            (0.24999999466504325, 0), (-0.0000000004934142731346956, 0),
            (0.0000027804787169772496, 0), (0.0000000004129066931011768, 0),
            (0.0000000004279283946856982, 0), (0.0000000006475555932856761, 0),
            (-0.0000000022929081115486527, 0), (-0.0000000016998980526673803, 0),
            (0.0000000012388829715968155, 0), (0.000000001124149854571188, 0),
            (-0.0000000019686319015652448, 0), (-0.00000000011435310681365792, 0),
            (0.0000000009335910249828172, 0), (-0.0000000003444825664305947, 0),
            (0.00000000015904974935070187, 0), (0.00000000026889217484821454, 0),
            (0.3333333261464789, 0), (-0.0000000012204003801389426, 0),
            (0.000014823387360977377, 0), (0.00000000003252740209730518, 0),
            (0.00000000015225274610585574, 0), (0.000004633815639580159, 0),
            (0.0000000004731315508847518, 0), (-0.00000000022342191601303586, 0),
            (0.0000000004864042788580974, 0), (0.000000000239528580208184, 0),
            (0.0000000011079761051230692, 0), (-0.000000000000000000551558420442499, 0),
            (0.000000000713356295803135, 0), (0.000000000133752976787834, 0),
            (-0.0000000004924531129627159, 0), (0.00000000009916072155004081, 0),
            (-0.00000000008330176054218152, 0), (-0.00000000007226499279121134, 0),
            (-0.00000000006557304885024667, 0), (-0.0000000000000017193627318352347, 0),
            (-0.000000000000001560932293336538, 0), (0.0000000007216491812268539, 0),
            (0.000000000000000000846829132946256, 0), (-0.05000000650427502, 0),
            (0.000000000000000002648969924519002, 0), (0.0000000016196676397113267, 0),
            (0.00000000006562106025895227, 0), (-0.0000027754984349481255, 0),
            (0.000000000003811770796349054, 0), (-0.000000000031119696750621936, 0),
            (-0.00000000000000000034778922733238656, 0), (-0.000000000000000001217935064892907, 0),
            (-0.000000000713356295803135, 0), (0.00000000003821512581056482, 0),
            (0.0000000003655461862736665, 0), (0.0000000000708290909727974, 0),
            (-0.0000000003919873104020028, 0), (-0.00000000007973849231204429, 0),
            (-0.0000000001043827193514868, 0), (0.000000000000005258743134882999, 0),
            (0.000000000000003864902378199618, 0), (-0.0000000002467071365673478, 0),
            (0.000000000032810524888117166, 0), (0.0000027791836057906783, 0),
            (0.00000000000476471449291157, 0), (-0.000000000057769709860820456, 0),
            (-0.0000000000000005291616171636353, 0), (0.000000000000003771132462840586, 0),
            (0.0000000002139641973428491, 0), (0.000000000005744562153401429, 0),
            (-0.0000000000066270739378005745, 0), (0.00000000000000012726322653857233, 0),
            (0.0000000000000036392703030770825, 0), (-0.000000000004478799240182128, 0),
            (-0.0000000000000000005189307313068512, 0), (0.0000000000000021677606189162643, 0),
            (0.0000000000000004786557515678605, 0), (0.0000000000000000002612373067190605, 0),
            (-0.0000000000000003736913874330717, 0), (1.0, 0),
            (-0.00000000000000000116559239352605, 0), (0.0000000009843159507826224, 0),
            (0.00000000014833900125282903, 0), (0.00000000005717655340682896, 0),
            (-0.015555556439381519, 0), (-0.0000000004667955124914086, 0),
            (0.00000000043968539500735567, 0), (-0.0000020991020139002117, 0),
            (0.000000000000024955850443221652, 0), (-0.000000000041153064857274406, 0),
            (-0.0000000008499490263336901, 0), (-0.00000000009848675240150765, 0),
            (0.00000000158336553802741, 0), (-0.00000000036460433354548286, 0),
            (0.0000000015271750325060804, 0), (0.00000000029231361680270394, 0),
            (-0.0000000000684154822729533, 0), (0.000000000000010841100754869261, 0),
            (-0.000000000000010793375575878679, 0), (-0.00000000005717655340682896, 0),
            (-0.0027777770258317087, 0), (0.0000000005302527627104954, 0),
            (-0.000000000287476098426705, 0), (-0.000000031874418741421914, 0),
            (-0.000000000000031531787316569294, 0), (0.00000000013721938208767185, 0),
            (0.00000000007952487467535094, 0), (-0.000000000028112043213624887, 0),
            (0.00000000018575782581480208, 0), (-0.0000000000000027308258885733476, 0),
            (0.000000000000005942686789495845, 0), (-0.00000038605191655436444, 0),
            (-0.00000000000002003428388930341, 0), (0.0000000000711764164427261, 0),
            (-0.0000000000000010186870084537771, 0), (0.000000000000008653161689533094, 0),
            (-0.000000000012876625200714146, 0), (-0.000000000000000000636311379227162, 0),
            (-0.00000000001626370104865259, 0), (-0.00000000017471175153121262, 0),
            (-0.00000000007612637305292787, 0), (0.00000000021778625805937477, 0),
            (0.000000000364489863111631, 0), (0.000000000000022058426478220647, 0),
            (0.000000000000022864815991433735, 0), (-0.0000000006102001900694713, 0),
            (-0.00000000008749474554942132, 0), (0.00001018957172139722, 0),
            (-0.00000000002922358045996064, 0), (0.0000000002795028218273468, 0),
            (-0.0000000000000008498737154809555, 0), (0.000000000000013414012849987187, 0),
            (0.00000000007612637305292787, 0), (-0.00000000015750403448148076, 0),
            (-0.00000000018817516754568704, 0), (0.000000000000028592072387060523, 0),
            (-0.000000000000009470856948192644, 0), (-0.00000000006626139652382493, 0),
            (-0.0000000000000014284954803715946, 0), (0.000000000000010760019135340503, 0),
            (-0.000000000000007711838555438602, 0), (-0.000000000000012651000091119348, 0),
            (-0.000000000000005563906517210347, 0), (-0.000000000000000000516367145965955, 0),
            (-0.0000000002432021394290487, 0), (-0.00000000012544095987805426, 0),
            (0.0000024291317112580745, 0), (-0.00000000000003848545747116834, 0),
            (0.00000000011893912307121366, 0), (-0.00000000011171095800651793, 0),
            (0.000000000001436079810069287, 0), (0.00000000003892753944258174, 0),
            (-0.000000000000011928220856202978, 0), (0.000000000000011856625355875655, 0),
            (-0.000000823403541782326, 0), (0.000000000000012717831464126247, 0),
            (-0.00000000006806539252664609, 0), (0.000000000000009630997961498822, 0),
            (-0.000000000000006075565134088662, 0), (-0.000000000041479922557394695, 0),
            (-0.00000000000000000020340287530075322, 0), (-0.00000000002294994710262152, 0),
            (-0.000000000000020124865055877717, 0), (-0.000000000000026328543876727133, 0),
            (0.00000000002160945586079484, 0), (0.0000000000000014854080945744245, 0),
            (-0.00000000000002470546637135441, 0), (-0.000000000000005565218930886535, 0),
            (0.000000000000011633578540627682, 0), (0.0000000000000006784210416603563, 0),
            (-0.00000000000000000005582035313370819, 0), (0.000000000000009232761363741913, 0),
            (-0.0000000000777971833658133, 0), (0.00000000000000014122590100355544, 0),
            (-0.0000000000000019738826610195774, 0), (0.00000000005436839152757217, 0),
            (-0.000000000000000000096161886264649, 0), (0.0000000000000016901862094901667, 0),
            (0.000000000000002102571864922007, 0), (-0.000000000000000000047751079174400304, 0),
            (-0.0000000011464540557743263, 0), (-0.0000000000000000005330466993873209, 0),
            (-0.0000000008499490263336901, 0), (0.00000000022159522259208584, 0),
            (0.0000000006194414857984077, 0), (0.0000000001426712586192381, 0),
            (0.000000000562074927285594, 0), (-0.00000000009847420512230049, 0),
            (-0.000000000016649780193710478, 0), (-0.000000000000007297766991215247, 0),
            (-0.0000000000000012342753128070482, 0), (1.0, 0),
            (-0.000000000000000001223422961844527, 0), (-0.0000000009843159507826224, 0),
            (0.00000000016838481084485303, 0), (-0.00000000005717655340682896, 0),
            (-0.010000001336153348, 0), (0.0000000004667955124914086, 0),
            (0.0000000004225073745816816, 0), (-0.0000012961031439934003, 0),
            (0.00000000000002947245101291313, 0), (-0.00000000004113307409428303, 0),
            (-0.0000000000000000008182400361983279, 0), (-0.00000000017224128321529734, 0),
            (-0.00000000016644980849997275, 0), (0.00000000007952487467535094, 0),
            (0.00000000010431616552481916, 0), (-0.00000000007768983029266066, 0),
            (0.00000000000000577980307850616, 0), (-0.0000000000000060023638340191036, 0),
            (-0.0000000000000000010110776832944504, 0), (0.00000000013444608742410727, 0),
            (-0.000000000057564330336751824, 0), (0.0000004168285469593186, 0),
            (-0.000000000000005087647065413647, 0), (0.00000000003347134868162876, 0),
            (-0.0000000000000000004610676762079152, 0), (0.0000000000499243195510815, 0),
            (-0.0000000000000007189697948103227, 0), (0.0000000000000024367616547062715, 0),
            (0.00000000000000000031960586691252456, 0), (-0.00000000000000022892558167481443, 0),
            (0.000000000007726583767463333, 0), (0.00000000000000000010125821476745269, 0),
            (0.00000000000000019839990547937287, 0), (-0.00000000000000000004257095211214692, 0),
            (-0.0000000007216491812268539, 0), (0.000000000000000000846829132946256, 0),
            (0.1333333379857107, 0), (0.0000000000000000031032442329728755, 0),
            (-0.000000002346653746715574, 0), (0.00000000006562105909965803, 0),
            (0.000014818407078948254, 0), (0.000000000003811762384463143, 0),
            (-0.000000000031119700498895045, 0), (0.000000000000000002244211349781713, 0),
            (-0.0000000000000000003681889570091377, 0), (0.000000000713356295803135, 0),
            (0.000000000089168657605491, 0), (-0.0000000009523788238281266, 0),
            (-0.00000000010388267249238094, 0), (-0.00000000009765253552068881, 0),
            (0.00000000015164383732903985, 0), (0.00000000031646897928917087, 0),
            (-0.000000000000021926149175486103, 0), (-0.000000000000010295941298869347, 0),
            (0.0000000002467071365673478, 0), (0.0000000000765579102612699, 0),
            (0.0000018533369226029094, 0), (-0.000000000006988251618175076, 0),
            (0.000000000050606093715174684, 0), (0.0000000000000021373977019510747, 0),
            (-0.000000000000018032317967518585, 0), (-0.0000000002139641973428491, 0),
            (0.000000000013400437695211729, 0), (0.000000000009728106368545834, 0),
            (0.0000000000000016783327486813017, 0), (-0.00000000000001775060967117186, 0),
            (-0.000000000010453574603072838, 0), (0.0000000000000005656813025375876, 0),
            (-0.000000000000009852351820592392, 0), (0.0000000000000005853736227965186, 0),
            (-0.000000000000000786009768546942, 0), (-0.0000000000000004567636464740677, 0),
            (0.0000000008499490263336901, 0), (-0.00000000002462169879644534, 0),
            (-0.0000000005291856452696876, 0), (0.00000000007926181811347784, 0),
            (-0.000000002021357655876336, 0), (-0.00000000011938075729632202, 0),
            (-0.00000000002644028137673232, 0), (0.000000000000024570975447717253, 0),
            (0.000000000000004010587343210577, 0), (0.00000000005717655340682896, 0),
            (-0.001851852398031514, 0), (-0.00000000020398460669567113, 0),
            (0.00000000023571658485760574, 0), (0.000000948056381229941, 0),
            (-0.000000000000018710002765862034, 0), (-0.0000000001602186839879866, 0),
            (-0.00000000007952487467535094, 0), (0.00000000009330882547951213, 0),
            (-0.000000000028787885402446017, 0), (0.00000000000000878773869484325, 0),
            (0.000000000000029109109107519676, 0), (-0.00000012867257516148664, 0),
            (0.00000000000003616331688366372, 0), (-0.00000000026142392982244237, 0),
            (0.000000000000004643534184523551, 0), (-0.000000000000010954778334575175, 0),
            (-0.0000000000014302058782195062, 0), (0.0000000006102001900694713, 0),
            (-0.000000000021873693331564815, 0), (-0.000014822908303816961, 0),
            (0.000000000006352959877690107, 0), (-0.0000000000655283494803569, 0),
            (-0.000000000000002826067310490563, 0), (0.000000000000023350254035882245, 0),
            (-0.00000000007612637305292787, 0), (0.00000000004036585461811377, 0),
            (0.0000000002745683831842632, 0), (-0.00000000000008161602014070674, 0),
            (-0.000000000000026082545522204368, 0), (0.00000000002999722034043955, 0),
            (0.0000000000000022418498374852364, 0), (-0.00000000000002441186873616476, 0),
            (0.00000000000000013675721008585226, 0), (0.00000000000001590014609055223, 0),
            (0.00000000000000437922768714999, 0), (0.00000000011171095800651793, 0),
            (0.00000000000037784040530758296, 0), (-0.000000000008458482962115691, 0),
            (0.000000000000008102972662244533, 0), (0.000000000000005101578373278362, 0),
            (0.0000013382187061642054, 0), (0.000000000000005015764180378861, 0),
            (-0.00000000009611801707961887, 0), (-0.000000000000013156122067085897, 0),
            (-0.000000000000004359235830215807, 0), (0.0000000000700986249560938, 0),
            (0.000000000005419084321082784, 0), (-0.000000000000000001748562021671113, 0),
            (0.000000000000015327223639572558, 0), (0.000000000000012077472266539046, 0),
            (-0.000000000000014177942493941512, 0), (0.000000000000002839412876675212, 0),
            (-0.00000000000000024130424386922077, 0), (-0.000000000000000001090589540748834, 0),
            (-0.00000000006868026334610403, 0), (-0.0000000000000036050103521077335, 0), (1.0, 0),
            (-0.0000000000000000016946453010167257, 0), (-0.000000000000000002353078984840902, 0),
            (0.0000000000000000008535229462677882, 0), (0.000000000000000002152636875301209, 0),
            (0.00000000000000000029873328147975543, 0), (-0.0000000000000000005189263191761231, 0),
            (-0.00000000000000000021524493812835522, 0), (0.0000000011464540557743263, 0),
            (-0.0000000000000000005330466993873209, 0), (0.0000000008499490263336901, 0),
            (-0.00000000014773014149946082, 0), (-0.0000000006194414857984077, 0),
            (-0.00000000009511416916766617, 0), (-0.000000000562074927285594, 0),
            (0.00000000006564809356998393, 0), (0.000000000011098971038237857, 0),
            (0.000000000000005475200407020324, 0), (0.0000000000000009256536060510628, 0),
            (0.0000000009843159507826224, 0), (-0.0000000001202748594167175, 0),
            (0.00000000005717655340682896, 0), (0.008333334235868316, 0),
            (-0.0000000004667955124914086, 0), (-0.0000000003145268461308298, 0),
            (0.0000011110698909267272, 0), (-0.00000000000002347918636870618, 0),
            (0.00000000003599747926032962, 0), (0.00000000017224128321529734, 0),
            (0.0000000001188927147364508, 0), (-0.00000000007952487467535094, 0),
            (-0.00000000007995051870159007, 0), (0.00000000005155205684929748, 0),
            (-0.0000000000000026017371104703714, 0), (0.000000000000004859931375364256, 0),
            (-0.00000000013444608742410727, 0), (0.00000000004111451151488637, 0),
            (-0.0000002315496158036405, 0), (-0.0000000000000018266792543970973, 0),
            (-0.000000000023186522721984508, 0), (-0.000000000035657394111306255, 0),
            (-0.0000000000000006361480730639578, 0), (-0.00000000000000019257682914688223, 0),
            (0.0000000000000011430423819595566, 0), (-0.000000000012875824765377194, 0),
            (-0.0000000000000009912752138655871, 0), (-0.0000000011079761051230692, 0),
            (-0.000000000000000000551558420442499, 0), (-0.000000000713356295803135, 0),
            (0.000000000070061082411744, 0), (0.0000000004924531129627159, 0),
            (0.00000000005194132883655404, 0), (0.00000000008330176054218152, 0),
            (-0.00000000003783529119973375, 0), (-0.00000000003433459043726944, 0),
            (-0.000000000000010518026888046074, 0), (-0.00000000000000954452632836503, 0),
            (-0.08333333148143568, 0), (-0.0000000000000000029542871432647058, 0),
            (0.0000000007269861070042472, 0), (0.00000000010936845788292836, 0),
            (-0.000012042908644000129, 0), (0.000000000006352945952439708, 0),
            (-0.000000000051843089689329547, 0), (0.0000000000000013442615684292894, 0),
            (-0.00000000000001094845016243545, 0), (0.0000000005868326375544601, 0),
            (0.00000000007082908488552571, 0), (0.0000000004896398459226917, 0),
            (-0.000000000004532547193079114, 0), (-0.00000000018685250470032055, 0),
            (0.000000000000014451613481678952, 0), (0.00000000000000009697811014200793, 0),
            (-0.0000046325205283935875, 0), (0.00000000000476471622463566, 0),
            (-0.00000000003323929972485762, 0), (-0.000000000000000971624706017434, 0),
            (0.000000000000006649264638499611, 0), (-0.000000000006627071553534117, 0),
            (-0.00000000000000830699083623332, 0), (0.000000000000003802220732211845, 0),
            (-0.0000000000000000004574243255236771, 0), (0.00000000000000034506445559880643, 0),
            (-0.0000000000000000001630696902217509, 0), (-0.0000000009843159507826224, 0),
            (-0.00000000002004580875725932, 0), (-0.00000000005717655340682896, 0),
            (0.00370370376044034, 0), (0.0000000004667955124914086, 0),
            (-0.000000000022488237637771033, 0), (-0.0000005352815587283679, 0),
            (0.00000000000002141103871814663, 0), (-0.00000000010523705935781556, 0),
            (-0.0000000010541798927577225, 0), (0.00000000007926180968786334, 0),
            (0.0000000004941826233702556, 0), (0.00000000004997885681743094, 0),
            (0.00000000011636162184690795, 0), (-0.0000000000000020561180476593585, 0),
            (0.000000000000010902527723133444, 0), (-0.0000000003262681560148243, 0),
            (0.00000000004798866344202543, 0), (-0.000001904460154475576, 0),
            (0.0000000000000385719196294627, 0), (-0.00000000007259827823734813, 0),
            (-0.00000000005944881836704439, 0), (0.000000000000003851404575888856, 0),
            (-0.000000000000016317323706787765, 0), (-0.0000000000000066364268363049876, 0),
            (0.00000000007581399145899599, 0), (0.0000000000000026656842453400905, 0),
            (0.00000000001626370104865259, 0), (0.000000000023609696535727594, 0),
            (0.00000000007612637305292787, 0), (-0.00000000012373146203849254, 0),
            (-0.000000000005170971129615809, 0), (0.0000000000000006324777003695384, 0),
            (0.000000000000028181572041165445, 0), (0.000004633336582419743, 0),
            (0.000000000006352953183551237, 0), (-0.00000000014210648170560023, 0),
            (-0.00000000000000028258852882309106, 0), (-0.000000000000010570983019264639, 0),
            (-0.000000000024789479561728142, 0), (0.00000000000001631640834120399, 0),
            (0.000000000000033936968339291336, 0), (-0.0000000000000008836872874119124, 0),
            (0.000000000000011037193431175482, 0), (-0.00000000000000017520980926199393, 0),
            (0.0000000002432021394290487, 0), (0.000000000016946660539923518, 0),
            (0.00000020605207915242257, 0), (-0.00000000000001995129783906362, 0),
            (0.0000000001739300595986997, 0), (-0.000000000008458485895855734, 0),
            (-0.00000000000001755646775611367, 0), (-0.000000000000015642402642478408, 0),
            (-0.000000000000010565816591979083, 0), (0.0000000002059927518995792, 0),
            (0.0000000000000028055205500623052, 0), (0.000000000003107019593489438, 0),
            (0.000000000000009667929487929207, 0), (-0.000000000000015828592045813805, 0),
            (-0.0000000000000000004904756215209931, 0), (0.000000000000009672018532386576, 0),
            (-0.0000000000000008387651603667468, 0), (0.0000000000000028272562996852764, 0),
            (-0.00000000006868189025001608, 0), (-0.0000000000000000000373143972740205, 0),
            (0.0000000000000005176308211303253, 0),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (1, 2), (1, 3), (1, 4), (1, 5), (1, 6), (1, 7), (1, 8), (1, 9), (1, 10),
            (1, 11), (1, 12), (1, 13), (1, 14), (1, 15), (1, 16), (1, 17), (1, 18), (1, 19),
            (1, 20), (1, 21), (1, 22), (1, 23), (1, 24), (1, 25), (1, 26), (1, 27), (1, 28),
            (1, 29), (1, 30), (1, 31), (1, 32), (1, 33), (1, 34), (1, 35), (0, 36), (0, 37),
            (0, 38), (0, 39), (0, 40), (0, 41), (0, 42), (0, 43), (0, 44), (0, 45), (0, 46),
            (0, 47), (0, 48), (0, 49), (0, 50), (0, 51), (0, 52), (0, 53), (0, 54), (0, 55),
            (0, 56), (0, 57), (0, 58), (0, 59), (0, 60), (0, 61), (0, 62), (0, 63), (0, 64),
            (0, 65), (0, 66), (0, 67), (0, 68), (0, 69), (0, 70), (1, 71), (2, 72), (1, 73),
            (2, 74), (1, 75), (2, 76), (1, 77), (2, 78), (2, 79), (2, 80), (2, 81), (1, 82),
            (2, 83), (1, 84), (2, 85), (1, 86), (2, 87), (1, 88), (2, 89), (2, 90), (2, 91),
            (2, 92), (1, 93), (2, 94), (1, 95), (2, 96), (1, 97), (2, 98), (2, 99), (2, 100),
            (2, 101), (1, 102), (2, 103), (1, 104), (2, 105), (2, 106), (2, 107), (2, 108),
            (1, 109), (2, 110), (2, 111), (2, 112), (2, 113), (2, 114), (2, 115), (2, 116),
            (2, 117), (2, 118), (2, 119), (0, 120), (2, 121), (1, 122), (2, 123), (1, 124),
            (2, 125), (1, 126), (2, 127), (2, 128), (2, 129), (2, 130), (1, 131), (2, 132),
            (1, 133), (2, 134), (1, 135), (2, 136), (2, 137), (2, 138), (2, 139), (1, 140),
            (2, 141), (1, 142), (2, 143), (2, 144), (2, 145), (2, 146), (1, 147), (2, 148),
            (2, 149), (2, 150), (2, 151), (2, 152), (2, 153), (2, 154), (2, 155), (2, 156),
            (2, 157), (2, 158), (1, 159), (2, 160), (1, 161), (2, 162), (2, 163), (2, 164),
            (2, 165), (1, 166), (2, 167), (1, 168), (2, 169), (2, 170), (2, 171), (2, 172),
            (1, 173), (2, 174), (2, 175), (2, 176), (2, 177), (2, 178), (2, 179), (2, 180),
            (2, 181), (2, 182), (2, 183), (2, 184), (1, 185), (2, 186), (2, 187), (2, 188),
            (2, 189), (1, 190), (2, 191), (2, 192), (2, 193), (2, 194), (2, 195), (2, 196),
            (2, 197), (2, 198), (2, 199), (2, 200), (2, 201), (2, 202), (2, 203), (2, 204),
            (2, 205), (2, 206), (2, 207), (2, 208), (2, 209), (2, 210), (2, 211), (2, 212),
            (2, 213), (2, 214), (2, 215), (2, 216), (2, 217), (2, 218), (2, 219), (2, 220),
            (1, 221), (2, 222), (1, 223), (2, 224), (1, 225), (2, 226), (1, 227), (2, 228),
            (2, 229), (2, 230), (2, 231), (0, 232), (2, 233), (1, 234), (2, 235), (1, 236),
            (2, 237), (1, 238), (2, 239), (2, 240), (2, 241), (2, 242), (2, 243), (1, 244),
            (2, 245), (1, 246), (2, 247), (2, 248), (2, 249), (2, 250), (2, 251), (1, 252),
            (2, 253), (2, 254), (2, 255), (2, 256), (2, 257), (2, 258), (2, 259), (2, 260),
            (2, 261), (2, 262), (2, 263), (2, 264), (2, 265), (2, 266), (1, 267), (2, 268),
            (1, 269), (2, 270), (1, 271), (2, 272), (1, 273), (2, 274), (2, 275), (2, 276),
            (2, 277), (1, 278), (2, 279), (1, 280), (2, 281), (1, 282), (2, 283), (2, 284),
            (2, 285), (2, 286), (1, 287), (2, 288), (1, 289), (2, 290), (2, 291), (2, 292),
            (2, 293), (1, 294), (2, 295), (2, 296), (2, 297), (2, 298), (2, 299), (2, 300),
            (2, 301), (2, 302), (2, 303), (2, 304), (1, 305), (2, 306), (1, 307), (2, 308),
            (1, 309), (2, 310), (2, 311), (2, 312), (2, 313), (1, 314), (2, 315), (1, 316),
            (2, 317), (2, 318), (2, 319), (2, 320), (1, 321), (2, 322), (2, 323), (2, 324),
            (2, 325), (2, 326), (2, 327), (2, 328), (2, 329), (2, 330), (2, 331), (1, 332),
            (2, 333), (1, 334), (2, 335), (2, 336), (2, 337), (2, 338), (1, 339), (2, 340),
            (2, 341), (2, 342), (2, 343), (2, 344), (2, 345), (2, 346), (2, 347), (2, 348),
            (2, 349), (1, 350), (2, 351), (2, 352), (2, 353), (2, 354), (2, 355), (2, 356),
            (2, 357), (2, 358), (2, 359), (2, 360), (2, 361), (2, 362), (2, 363), (2, 364),
            (2, 365), (2, 366), (2, 367), (2, 368), (2, 369), (2, 370), (0, 371), (2, 372),
            (2, 373), (2, 374), (2, 375), (2, 376), (2, 377), (2, 378), (1, 379), (2, 380),
            (1, 381), (2, 382), (1, 383), (2, 384), (1, 385), (2, 386), (2, 387), (2, 388),
            (2, 389), (1, 390), (2, 391), (1, 392), (2, 393), (1, 394), (2, 395), (2, 396),
            (2, 397), (2, 398), (1, 399), (2, 400), (1, 401), (2, 402), (2, 403), (2, 404),
            (2, 405), (1, 406), (2, 407), (2, 408), (2, 409), (2, 410), (2, 411), (2, 412),
            (2, 413), (2, 414), (2, 415), (2, 416), (1, 417), (2, 418), (1, 419), (2, 420),
            (1, 421), (2, 422), (1, 423), (2, 424), (2, 425), (2, 426), (2, 427), (1, 428),
            (2, 429), (1, 430), (2, 431), (1, 432), (2, 433), (2, 434), (2, 435), (2, 436),
            (1, 437), (2, 438), (1, 439), (2, 440), (2, 441), (2, 442), (2, 443), (1, 444),
            (2, 445), (2, 446), (2, 447), (2, 448), (2, 449), (2, 450), (2, 451), (2, 452),
            (2, 453), (2, 454), (1, 455), (2, 456), (1, 457), (2, 458), (1, 459), (2, 460),
            (2, 461), (2, 462), (2, 463), (1, 464), (2, 465), (1, 466), (2, 467), (2, 468),
            (2, 469), (2, 470), (1, 471), (2, 472), (2, 473), (2, 474), (2, 475), (2, 476),
            (2, 477), (2, 478), (2, 479), (2, 480), (2, 481), (1, 482), (2, 483), (1, 484),
            (2, 485), (2, 486), (2, 487), (2, 488), (1, 489), (2, 490), (2, 491), (2, 492),
            (2, 493), (2, 494), (2, 495), (2, 496), (2, 497), (2, 498), (2, 499), (1, 500),
            (2, 501), (2, 502), (2, 503), (2, 504), (2, 505), (2, 506), (2, 507), (2, 508),
            (2, 509), (2, 510), (2, 511), (2, 512), (2, 513), (2, 514), (2, 515), (2, 516),
            (2, 517), (2, 518), (2, 519), (2, 520),
        ],
        /// Where the parts of each base end.
        bases: &[
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
            22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
            41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59,
            60, 61, 62, 63, 64, 65, 66, 67, 68, 69, 70, 72, 74, 76, 78, 79, 80, 81, 83,
            85, 87, 89, 90, 91, 92, 94, 96, 98, 99, 100, 101, 103, 105, 106, 107, 108,
            110, 111, 112, 113, 114, 115, 116, 117, 118, 119, 121, 123, 125, 127, 128,
            129, 130, 132, 134, 136, 137, 138, 139, 141, 143, 144, 145, 146, 148, 149,
            150, 151, 152, 153, 154, 155, 156, 157, 158, 160, 162, 163, 164, 165, 167,
            169, 170, 171, 172, 174, 175, 176, 177, 178, 179, 180, 181, 182, 183, 184,
            186, 187, 188, 189, 191, 192, 193, 194, 195, 196, 197, 198, 199, 200, 201,
            202, 203, 204, 205, 206, 207, 208, 209, 210, 211, 212, 213, 214, 215, 216,
            217, 218, 219, 220, 222, 224, 226, 228, 229, 230, 231, 233, 235, 237, 239,
            240, 241, 242, 243, 245, 247, 248, 249, 250, 251, 253, 254, 255, 256, 257,
            258, 259, 260, 261, 262, 263, 264, 265, 266, 268, 270, 272, 274, 275, 276,
            277, 279, 281, 283, 284, 285, 286, 288, 290, 291, 292, 293, 295, 296, 297,
            298, 299, 300, 301, 302, 303, 304, 306, 308, 310, 311, 312, 313, 315, 317,
            318, 319, 320, 322, 323, 324, 325, 326, 327, 328, 329, 330, 331, 333, 335,
            336, 337, 338, 340, 341, 342, 343, 344, 345, 346, 347, 348, 349, 351, 352,
            353, 354, 355, 356, 357, 358, 359, 360, 361, 362, 363, 364, 365, 366, 367,
            368, 369, 370, 372, 373, 374, 375, 376, 377, 378, 380, 382, 384, 386, 387,
            388, 389, 391, 393, 395, 396, 397, 398, 400, 402, 403, 404, 405, 407, 408,
            409, 410, 411, 412, 413, 414, 415, 416, 418, 420, 422, 424, 425, 426, 427,
            429, 431, 433, 434, 435, 436, 438, 440, 441, 442, 443, 445, 446, 447, 448,
            449, 450, 451, 452, 453, 454, 456, 458, 460, 461, 462, 463, 465, 467, 468,
            469, 470, 472, 473, 474, 475, 476, 477, 478, 479, 480, 481, 483, 485, 486,
            487, 488, 490, 491, 492, 493, 494, 495, 496, 497, 498, 499, 501, 502, 503,
            504, 505, 506, 507, 508, 509, 510, 511, 512, 513, 514, 515, 516, 517, 518,
            519, 520,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (25, 2), (26, 2), (27, 2), (28, 2), (29, 2), (30, 2), (31, 3), (32, 3), (33, 3),
            (34, 4), (15, 1), (16, 1), (17, 1), (18, 1), (19, 1), (20, 1), (21, 1), (22, 1),
            (23, 1), (24, 1), (9, 2), (10, 2), (11, 2), (12, 3), (13, 3), (14, 4), (22, 2), (23, 2),
            (24, 3), (5, 1), (6, 1), (7, 1), (8, 1), (28, 1), (29, 1), (33, 1), (2, 2), (3, 3),
            (4, 4), (7, 2), (8, 3), (17, 2), (18, 3), (21, 2), (1, 1), (10, 1), (13, 1), (26, 1),
            (32, 1), (34, 8), (30, 4), (27, 4), (14, 8), (11, 4), (4, 8), (70, 1), (71, 1), (72, 1),
            (73, 1), (74, 1), (75, 1), (76, 1), (77, 1), (78, 1), (79, 1), (80, 1), (81, 1),
            (82, 1), (83, 1), (84, 1), (85, 1), (86, 1), (87, 1), (88, 1), (89, 1), (90, 1),
            (91, 1), (92, 1), (93, 1), (94, 1), (95, 1), (96, 1), (97, 1), (98, 1), (99, 1),
            (100, 1), (101, 1), (102, 1), (103, 1), (104, 1), (105, 1), (106, 1), (107, 1),
            (108, 1), (109, 1), (110, 1), (111, 1), (112, 1), (113, 1), (114, 1), (115, 1),
            (116, 1), (117, 1), (118, 1), (119, 1), (120, 1), (121, 1), (122, 1), (123, 1),
            (124, 1), (125, 1), (126, 1), (127, 1), (128, 1), (129, 1), (130, 1), (131, 1),
            (132, 1), (133, 1), (134, 1), (135, 1), (136, 1), (137, 1), (138, 1), (139, 1),
            (140, 1), (141, 1), (142, 1), (143, 1), (144, 1), (145, 1), (146, 1), (147, 1),
            (148, 1), (149, 1), (150, 1), (151, 1), (152, 1), (153, 1), (154, 1), (155, 1),
            (156, 1), (157, 1), (158, 1), (159, 1), (160, 1), (161, 1), (162, 1), (163, 1),
            (164, 1), (165, 1), (166, 1), (167, 1), (168, 1), (169, 1), (170, 1), (171, 1),
            (172, 1), (173, 1), (174, 1), (175, 1), (176, 1), (177, 1), (178, 1), (179, 1),
            (180, 1), (181, 1), (182, 1), (183, 1), (184, 1), (185, 1), (186, 1), (187, 1),
            (188, 1), (189, 1), (190, 1), (191, 1), (192, 1), (193, 1), (194, 1), (195, 1),
            (196, 1), (197, 1), (198, 1), (199, 1), (200, 1), (201, 1), (202, 1), (203, 1),
            (204, 1), (205, 1), (206, 1), (207, 1), (208, 1), (209, 1), (210, 1), (211, 1),
            (212, 1), (213, 1), (214, 1), (215, 1), (216, 1), (217, 1), (218, 1), (219, 1),
            (220, 1), (221, 1), (222, 1), (223, 1), (224, 1), (225, 1), (226, 1), (227, 1),
            (228, 1), (229, 1), (230, 1), (231, 1), (232, 1), (233, 1), (234, 1), (235, 1),
            (236, 1), (237, 1), (238, 1), (239, 1), (240, 1), (241, 1), (242, 1), (243, 1),
            (244, 1), (245, 1), (246, 1), (247, 1), (248, 1), (249, 1), (250, 1), (251, 1),
            (252, 1), (253, 1), (254, 1), (255, 1), (256, 1), (257, 1), (258, 1), (259, 1),
            (260, 1), (261, 1), (262, 1), (263, 1), (264, 1), (265, 1), (266, 1), (267, 1),
            (268, 1), (269, 1), (270, 1), (271, 1), (272, 1), (273, 1), (274, 1), (275, 1),
            (276, 1), (277, 1), (278, 1), (279, 1), (280, 1), (281, 1), (282, 1), (283, 1),
            (284, 1), (285, 1), (286, 1), (287, 1), (288, 1), (289, 1), (290, 1), (291, 1),
            (292, 1), (293, 1), (294, 1), (295, 1), (296, 1), (297, 1), (298, 1), (299, 1),
            (300, 1), (301, 1), (302, 1), (303, 1), (304, 1), (305, 1), (306, 1), (307, 1),
            (308, 1), (309, 1), (310, 1), (311, 1), (312, 1), (313, 1), (314, 1), (315, 1),
            (316, 1), (317, 1), (318, 1), (319, 1), (320, 1), (321, 1), (322, 1), (323, 1),
            (324, 1), (325, 1), (326, 1), (327, 1), (328, 1), (329, 1), (330, 1), (331, 1),
            (332, 1), (333, 1), (334, 1), (335, 1), (336, 1), (337, 1), (338, 1), (339, 1),
            (340, 1), (341, 1), (342, 1), (343, 1), (344, 1), (345, 1), (346, 1), (347, 1),
            (348, 1), (349, 1), (350, 1), (351, 1), (352, 1), (353, 1), (354, 1), (355, 1),
            (356, 1), (357, 1), (358, 1), (359, 1), (360, 1), (361, 1), (362, 1), (363, 1),
            (364, 1), (365, 1), (366, 1), (367, 1), (368, 1), (369, 1), (370, 1), (371, 1),
            (372, 1), (373, 1), (374, 1), (375, 1), (376, 1), (377, 1), (378, 1), (379, 1),
            (380, 1), (381, 1), (382, 1), (383, 1), (384, 1), (385, 1), (386, 1), (387, 1),
            (388, 1), (389, 1), (390, 1), (391, 1), (392, 1), (393, 1), (394, 1), (395, 1),
            (396, 1), (397, 1), (398, 1), (399, 1), (400, 1), (401, 1), (402, 1), (403, 1),
            (404, 1), (405, 1), (406, 1), (407, 1), (408, 1), (409, 1), (410, 1), (411, 1),
            (412, 1), (413, 1), (414, 1), (415, 1), (416, 1), (417, 1), (418, 1), (419, 1),
            (420, 1), (421, 1), (422, 1), (423, 1), (424, 1), (425, 1), (426, 1), (0, 1), (2, 1),
            (3, 1), (4, 1), (9, 1), (11, 1), (12, 1), (14, 1), (25, 1), (27, 1), (30, 1), (31, 1),
            (34, 1), (35, 1), (36, 1), (37, 1), (38, 1), (39, 1), (40, 1), (41, 1), (42, 1),
            (43, 1), (44, 1), (45, 1), (46, 1), (47, 1), (48, 1), (49, 1), (50, 1), (51, 1),
            (52, 1), (53, 1), (54, 1), (55, 1), (56, 1), (57, 1), (58, 1), (59, 1), (60, 1),
            (61, 1), (62, 1), (63, 1), (64, 1), (65, 1), (66, 1), (67, 1), (68, 1), (69, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[], &[(2, 1)], &[(2, 2)], &[(2, 3)], &[(2, 4)], &[(1, 1)], &[(1, 1), (2, 1)],
            &[(1, 1), (2, 2)], &[(1, 1), (2, 3)], &[(1, 2)], &[(1, 2), (2, 1)], &[(1, 2), (2, 2)],
            &[(1, 3)], &[(1, 3), (2, 1)], &[(1, 4)], &[(0, 1)], &[(0, 1), (2, 1)],
            &[(0, 1), (2, 2)], &[(0, 1), (2, 3)], &[(0, 1), (1, 1)], &[(0, 1), (1, 1), (2, 1)],
            &[(0, 1), (1, 1), (2, 2)], &[(0, 1), (1, 2)], &[(0, 1), (1, 2), (2, 1)],
            &[(0, 1), (1, 3)], &[(0, 2)], &[(0, 2), (2, 1)], &[(0, 2), (2, 2)], &[(0, 2), (1, 1)],
            &[(0, 2), (1, 1), (2, 1)], &[(0, 2), (1, 2)], &[(0, 3)], &[(0, 3), (2, 1)],
            &[(0, 3), (1, 1)], &[(0, 4)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₃), of S₁
// c[2] = 2 C(p₁² p₃²), of S₁
// c[3] = 2 C(p₁² p₂), of S₁
// c[4] = 2 C(p₁² p₂ p₃), of S₁
// c[5] = 2 C(p₁² p₂²), of S₁
// c[6] = 3 C(p₁³), of S₁
// c[7] = 3 C(p₁³ p₃), of S₁
// c[8] = 3 C(p₁³ p₂), of S₁
// c[9] = 4 C(p₁⁴), of S₁
// c[10] = C(p₁), of S₁
// c[11] = C(p₁ p₃), of S₁
// c[12] = C(p₁ p₃²), of S₁
// c[13] = C(p₁ p₃³), of S₁
// c[14] = C(p₁ p₂), of S₁
// c[15] = C(p₁ p₂ p₃), of S₁
// c[16] = C(p₁ p₂ p₃²), of S₁
// c[17] = C(p₁ p₂²), of S₁
// c[18] = C(p₁ p₂² p₃), of S₁
// c[19] = C(p₁ p₂³), of S₁
// c[20] = 2 C(p₂²), of S₁
// c[21] = 2 C(p₂² p₃), of S₁
// c[22] = 2 C(p₂² p₃²), of S₁
// c[23] = 3 C(p₂³), of S₁
// c[24] = 3 C(p₂³ p₃), of S₁
// c[25] = 4 C(p₂⁴), of S₁
// c[26] = 2 C(p₁ p₂²), of S₁
// c[27] = 2 C(p₁ p₂² p₃), of S₁
// c[28] = 3 C(p₁ p₂³), of S₁
// c[29] = C(p₂), of S₁
// c[30] = C(p₂ p₃), of S₁
// c[31] = C(p₂ p₃²), of S₁
// c[32] = C(p₂ p₃³), of S₁
// c[33] = C(p₁² p₂), of S₁
// c[34] = C(p₁² p₂ p₃), of S₁
// c[35] = C(p₁³ p₂), of S₁
// c[36] = 2 C(p₃²), of S₁
// c[37] = 3 C(p₃³), of S₁
// c[38] = 4 C(p₃⁴), of S₁
// c[39] = 2 C(p₂ p₃²), of S₁
// c[40] = 3 C(p₂ p₃³), of S₁
// c[41] = 2 C(p₁ p₃²), of S₁
// c[42] = 3 C(p₁ p₃³), of S₁
// c[43] = 2 C(p₁ p₂ p₃²), of S₁
// c[44] = C(p₃), of S₁
// c[45] = C(p₂² p₃), of S₁
// c[46] = C(p₂³ p₃), of S₁
// c[47] = C(p₁² p₃), of S₁
// c[48] = C(p₁³ p₃), of S₁
// c[49] = 8 C(p₁⁴), of S₁
// c[50] = 4 C(p₁² p₂²), of S₁
// c[51] = 4 C(p₁² p₃²), of S₁
// c[52] = 8 C(p₂⁴), of S₁
// c[53] = 4 C(p₂² p₃²), of S₁
// c[54] = 8 C(p₃⁴), of S₁
// c[412] = C(), of S₁
// c[413] = C(p₃²), of S₁
// c[414] = C(p₃³), of S₁
// c[415] = C(p₃⁴), of S₁
// c[416] = C(p₂²), of S₁
// c[417] = C(p₂² p₃²), of S₁
// c[418] = C(p₂³), of S₁
// c[419] = C(p₂⁴), of S₁
// c[420] = C(p₁²), of S₁
// c[421] = C(p₁² p₃²), of S₁
// c[422] = C(p₁² p₂²), of S₁
// c[423] = C(p₁³), of S₁
// c[424] = C(p₁⁴), of S₁
