// comoving_body: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `let [a, b, c, u, v, w] = mu; 0.5 * ((a * a + b * b) / inertia[0] + c * c / inertia[1] + (u * u + v * v) / mass[0] + w * w / mass[1])`
//
// Group: SE3. Chart exp, truncation K = 3, order of accuracy 4.
// Terms: S1: 4, S3: 8.
// Operations: gradient and Hessian 69 multiplications and 23 additions; predictor of degree 4 along the flow 110 and 46.
// Comoving frame: S generates the motion in it.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `let [a, b, c, u, v, w] = mu; 0.5 * ((a * a + b * b) / inertia[0] + c * c / inertia[1] + (u * u + v * v) / mass[0] + w * w / mass[1])`
///
/// Group: SE3. Chart exp, truncation K = 3, order of accuracy 4.
/// Terms: S1: 4, S3: 8.
/// Operations: gradient and Hessian 69 multiplications and 23 additions; predictor of degree 4 along the flow 110 and 46.
/// Comoving frame: S generates the motion in it.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct ComovingBody<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 73],
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
    impl<T: ::coadjoint::Scalar> ComovingBody<T> {
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
            inertia: [T; 2],
            mass: [T; 2],
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(
                step,
                &[
                    (T::of(1.0) / inertia[0]),
                    (T::of(1.0) / inertia[1]),
                    (T::of(1.0) / mass[0]),
                    (T::of(1.0) / mass[1]),
                    ((T::of(1.0) / mass[0]) - (T::of(1.0) / mass[1])),
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
            inertia: [T; 2],
            mass: [T; 2],
            momenta: impl ::core::iter::IntoIterator<
                Item = impl ::core::convert::Into<Vector<T>>,
            >,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(
                step,
                &[
                    (T::of(1.0) / inertia[0]),
                    (T::of(1.0) / inertia[1]),
                    (T::of(1.0) / mass[0]),
                    (T::of(1.0) / mass[1]),
                    ((T::of(1.0) / mass[0]) - (T::of(1.0) / mass[1])),
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
            symbols: &[T; 5],
        ) -> ::core::result::Result<[T; 57], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                4,
                11,
                57,
            >(
                Self::table(),
                &[
                    "1/inertia[0]",
                    "1/inertia[1]",
                    "1/mass[0]",
                    "1/mass[1]",
                    "1/mass[0] - 1/mass[1]",
                ],
                step,
                symbols,
            )
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 57],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                4,
                57,
                57,
                73,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 73]) -> Self {
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
            let mu4 = input[3];
            let t4 = mu4 * mu4;
            let mu5 = input[4];
            let t5 = mu5 * mu5;
            let mu6 = input[5];
            let t6 = mu6 * mu6;
            let t7 = t6 * c[63];
            let t8 = t5.times_plus(c[64], t7);
            let t9 = t4.times_plus(c[65], t8);
            let t10 = t3.times_plus(c[66], t9);
            let t11 = t2.times_plus(c[67], t10);
            // H_red(μ)
            let t12 = t1.times_plus(c[68], t11);
            t12
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for ComovingBody<T> {
        type Group = ::coadjoint::SE3<T>;
        type Chart = ::coadjoint::Exponential;
        #[inline(always)]
        fn group(&self) -> &::coadjoint::SE3<T> {
            const { &<::coadjoint::SE3<T>>::new() }
        }
        #[inline]
        fn value(&self, input: &Vector<T>) -> T {
            let c = &self.coefficients;
            let p6 = input[5];
            let p1 = input[0];
            let t1 = p1 * p1;
            let p2 = input[1];
            let t2 = p2 * p2;
            let p4 = input[3];
            let t3 = p4 * p4;
            let p5 = input[4];
            let t4 = p5 * p5;
            let t5 = t4 * c[54];
            let t6 = t3.times_plus(c[56], t5);
            let t7 = t2.times_plus(c[58], t6);
            let t8 = t1.times_plus(c[61], t7);
            let p3 = input[2];
            let t9 = p4 * c[3];
            let t10 = p2 * p5;
            let t11 = t10 * c[7];
            let t12 = p1.times_plus(t9, t11);
            let t13 = p3 * t12;
            let t14 = p6.times_plus(t8, t13);
            let t15 = p3 * p3;
            let t16 = t15.times_plus(c[62], c[60]);
            let t17 = t15.times_plus(c[59], c[57]);
            let t18 = t4 * c[53];
            let t19 = t3.times_plus(c[55], t18);
            let t20 = t2.times_plus(t17, t19);
            let t21 = t1.times_plus(t16, t20);
            // S(p)
            let t22 = p6.times_plus(t14, t21);
            t22
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p3 = input[2];
            let t1 = p3 * p3;
            let p6 = input[5];
            let t2 = p6 * p6;
            let t3 = t2.times_plus(c[1], c[0]);
            let t4 = t1.times_plus(c[2], t3);
            let p4 = input[3];
            let t5 = p3 * p4;
            let t6 = p6 * t5;
            let t7 = t6 * c[3];
            let p1 = input[0];
            // ∂(S₁ + S₃)/∂p₁
            let t8 = t4.times_plus(p1, t7);
            let t9 = t2.times_plus(c[5], c[4]);
            let t10 = t1.times_plus(c[6], t9);
            let p5 = input[4];
            let t11 = p3 * p5;
            let t12 = p6 * t11;
            let t13 = t12 * c[7];
            let p2 = input[1];
            // ∂(S₁ + S₃)/∂p₂
            let t14 = t10.times_plus(p2, t13);
            let t15 = p1 * p1;
            let t16 = p2 * p2;
            let t17 = c[6] * t16;
            let t18 = c[2].times_plus(t15, t17);
            let t19 = p4 * c[3];
            let t20 = p5 * p2;
            let t21 = c[7] * t20;
            let t22 = p1.times_plus(t19, t21);
            let t23 = p6 * t22;
            // ∂(S₁ + S₃)/∂p₃
            let t24 = p3.times_plus(t18, t23);
            let t25 = t2.times_plus(c[9], c[8]);
            let t26 = p3 * p1;
            let t27 = p6 * t26;
            let t28 = c[3] * t27;
            // ∂(S₁ + S₃)/∂p₄
            let t29 = p4.times_plus(t25, t28);
            let t30 = t2.times_plus(c[11], c[10]);
            let t31 = p3 * p2;
            let t32 = p6 * t31;
            let t33 = c[7] * t32;
            // ∂(S₁ + S₃)/∂p₅
            let t34 = p5.times_plus(t30, t33);
            let t35 = p4 * p4;
            let t36 = p5 * p5;
            let t37 = c[11] * t36;
            let t38 = c[9].times_plus(t35, t37);
            let t39 = c[5].times_plus(t16, t38);
            let t40 = c[1].times_plus(t15, t39);
            let t41 = p3 * t22;
            // ∂(S₁ + S₃)/∂p₆
            let t42 = p6.times_plus(t40, t41);
            <Vector<T> as ::core::convert::From<_>>::from([t8, t14, t24, t29, t34, t42])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p3 = input[2];
            let t1 = p3 * p3;
            let p6 = input[5];
            let t2 = p6 * p6;
            let t3 = t2.times_plus(c[1], c[0]);
            // ∂²(S₁ + S₃)/∂p₁²
            let t4 = t1.times_plus(c[2], t3);
            let p4 = input[3];
            let t5 = p3 * p4;
            let t6 = p6 * t5;
            let t7 = t6 * c[3];
            let p1 = input[0];
            // ∂S/∂p₁
            let t8 = t4.times_plus(p1, t7);
            let t9 = t2.times_plus(c[5], c[4]);
            // ∂²(S₁ + S₃)/∂p₂²
            let t10 = t1.times_plus(c[6], t9);
            let p5 = input[4];
            let t11 = p3 * p5;
            let t12 = p6 * t11;
            let t13 = t12 * c[7];
            let p2 = input[1];
            // ∂S/∂p₂
            let t14 = t10.times_plus(p2, t13);
            let t15 = p1 * p1;
            let t16 = p2 * p2;
            let t17 = c[6] * t16;
            // ∂²(S₁ + S₃)/∂p₃²
            let t18 = c[2].times_plus(t15, t17);
            let t19 = p4 * c[3];
            let t20 = p5 * p2;
            let t21 = c[7] * t20;
            // ∂²(S₁ + S₃)/∂p₃∂p₆
            let t22 = p1.times_plus(t19, t21);
            let t23 = p6 * t22;
            // ∂S/∂p₃
            let t24 = p3.times_plus(t18, t23);
            // ∂²(S₁ + S₃)/∂p₄²
            let t25 = t2.times_plus(c[9], c[8]);
            let t26 = p3 * p1;
            let t27 = p6 * t26;
            let t28 = c[3] * t27;
            // ∂S/∂p₄
            let t29 = p4.times_plus(t25, t28);
            // ∂²(S₁ + S₃)/∂p₅²
            let t30 = t2.times_plus(c[11], c[10]);
            let t31 = p3 * p2;
            let t32 = p6 * t31;
            let t33 = c[7] * t32;
            // ∂S/∂p₅
            let t34 = p5.times_plus(t30, t33);
            let t35 = p4 * p4;
            let t36 = p5 * p5;
            let t37 = c[11] * t36;
            let t38 = c[9].times_plus(t35, t37);
            let t39 = c[5].times_plus(t16, t38);
            // ∂²(S₁ + S₃)/∂p₆²
            let t40 = c[1].times_plus(t15, t39);
            let t41 = p3 * t22;
            // ∂S/∂p₆
            let t42 = p6.times_plus(t40, t41);
            let t43 = p3 * c[12];
            let t44 = p6 * p4;
            let t45 = c[3] * t44;
            // ∂²(S₁ + S₃)/∂p₁∂p₃
            let t46 = p1.times_plus(t43, t45);
            let t47 = p3 * p6;
            // ∂²(S₁ + S₃)/∂p₁∂p₄
            let t48 = c[3] * t47;
            let t49 = p6 * c[13];
            let t50 = t5 * c[3];
            // ∂²(S₁ + S₃)/∂p₁∂p₆
            let t51 = p1.times_plus(t49, t50);
            let t52 = p3 * c[14];
            let t53 = p6 * p5;
            let t54 = c[7] * t53;
            // ∂²(S₁ + S₃)/∂p₂∂p₃
            let t55 = p2.times_plus(t52, t54);
            // ∂²(S₁ + S₃)/∂p₂∂p₅
            let t56 = c[7] * t47;
            let t57 = p6 * c[15];
            let t58 = t11 * c[7];
            // ∂²(S₁ + S₃)/∂p₂∂p₆
            let t59 = p2.times_plus(t57, t58);
            let t60 = p6 * p1;
            // ∂²(S₁ + S₃)/∂p₃∂p₄
            let t61 = c[3] * t60;
            let t62 = p6 * p2;
            // ∂²(S₁ + S₃)/∂p₃∂p₅
            let t63 = c[7] * t62;
            let t64 = p3 * c[3];
            let t65 = t44 * c[16];
            // ∂²(S₁ + S₃)/∂p₄∂p₆
            let t66 = p1.times_plus(t64, t65);
            let t67 = p3 * c[7];
            let t68 = t53 * c[17];
            // ∂²(S₁ + S₃)/∂p₅∂p₆
            let t69 = p2.times_plus(t67, t68);
            let gradient = <Vector<
                T,
            > as ::core::convert::From<_>>::from([t8, t14, t24, t29, t34, t42]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([
                [t4, T::of(0.0), t46, t48, T::of(0.0), t51],
                [T::of(0.0), t10, t55, T::of(0.0), t56, t59],
                [t46, t55, t18, t61, t63, t22],
                [t48, T::of(0.0), t61, t25, T::of(0.0), t66],
                [T::of(0.0), t56, t63, T::of(0.0), t30, t69],
                [t51, t59, t22, t66, t69, t40],
            ]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict_increment(
            &self,
            input: &Vector<T>,
        ) -> ::core::option::Option<Vector<T>> {
            let c = &self.coefficients;
            ::core::option::Option::Some({
                let mu1 = input[0];
                let mu2 = input[1];
                let mu3 = input[2];
                let mu4 = input[3];
                let mu5 = input[4];
                let mu6 = input[5];
                let t1 = mu5 * mu6;
                let t2 = c[18] * t1;
                let t3 = mu2 * mu3;
                let t4 = c[19].times_plus(t3, t2);
                let t5 = mu4 * mu6;
                let t6 = c[20] * t5;
                let t7 = mu1 * mu3;
                let t8 = c[21].times_plus(t7, t6);
                let t9 = mu2 * mu6;
                let t10 = c[22] * t9;
                let t11 = mu1 * mu6;
                let t12 = c[23] * t11;
                let t13 = mu2 * mu4;
                let t14 = c[24] * t13;
                let t15 = mu1 * mu5;
                let t16 = c[25].times_plus(t15, t14);
                let t17 = mu5 * t16;
                let t18 = mu6.times_plus(t12, t17);
                let t19 = c[26] * t18;
                let t20 = mu3 * t8;
                let t21 = c[27].times_plus(t20, t19);
                let t22 = mu4 * t16;
                let t23 = mu6.times_plus(t10, t22);
                let t24 = c[28] * t23;
                let t25 = mu3 * t4;
                let t26 = c[29].times_plus(t25, t24);
                let t27 = mu2 * t16;
                let t28 = mu6.times_plus(t8, t27);
                let t29 = c[30] * t28;
                let t30 = mu1 * t16;
                let t31 = mu6.times_plus(t4, t30);
                let t32 = c[31] * t31;
                let t33 = mu2 * t10;
                let t34 = mu4.times_plus(t8, t33);
                let t35 = c[32] * t34;
                let t36 = mu1 * t12;
                let t37 = mu5.times_plus(t4, t36);
                let t38 = c[33].times_plus(t37, t35);
                let t39 = mu5 * t38;
                let t40 = t12.times_plus(t16, t39);
                let t41 = mu6.times_plus(t32, t40);
                let t42 = c[34] * t41;
                let t43 = mu3 * t26;
                let t44 = c[35].times_plus(t43, t42);
                let t45 = mu4 * t38;
                let t46 = t10.times_plus(t16, t45);
                let t47 = mu6.times_plus(t29, t46);
                let t48 = c[36] * t47;
                let t49 = mu3 * t21;
                let t50 = c[37].times_plus(t49, t48);
                let t51 = mu2 * t38;
                let t52 = t8.times_plus(t16, t51);
                let t53 = mu6.times_plus(t26, t52);
                let t54 = c[38] * t53;
                let t55 = mu1 * t38;
                let t56 = t4.times_plus(t16, t55);
                let t57 = mu6.times_plus(t21, t56);
                let t58 = c[39] * t57;
                let t59 = mu1 * c[42];
                let t60 = t4 * c[42];
                let t61 = t21 * c[42];
                let t62 = t44 * c[42];
                let t63 = mu2 * c[43];
                let t64 = t8 * c[43];
                let t65 = t26 * c[43];
                let t66 = t50 * c[43];
                let t67 = mu4 * c[44];
                let t68 = t10 * c[44];
                let t69 = t29 * c[44];
                let t70 = t54 * c[44];
                let t71 = mu5 * c[45];
                let t72 = t12 * c[45];
                let t73 = t32 * c[45];
                let t74 = t58 * c[45];
                let t75 = t59 * c[46];
                let t76 = t60.times_plus(c[47], t75);
                let t77 = t61.times_plus(c[48], t76);
                // x₁, the first guess
                let t78 = t62.times_plus(c[49], t77);
                let t79 = t63 * c[46];
                let t80 = t64.times_plus(c[47], t79);
                let t81 = t65.times_plus(c[48], t80);
                // x₂, the first guess
                let t82 = t66.times_plus(c[49], t81);
                let t83 = t67 * c[46];
                let t84 = t68.times_plus(c[47], t83);
                let t85 = t69.times_plus(c[48], t84);
                // x₄, the first guess
                let t86 = t70.times_plus(c[49], t85);
                let t87 = t71 * c[46];
                let t88 = t72.times_plus(c[47], t87);
                let t89 = t73.times_plus(c[48], t88);
                // x₅, the first guess
                let t90 = t74.times_plus(c[49], t89);
                let t91 = t60 * c[50];
                let t92 = t61.times_plus(c[50], t91);
                let t93 = t62.times_plus(c[51], t92);
                let t94 = t64 * c[50];
                let t95 = t65.times_plus(c[50], t94);
                let t96 = t66.times_plus(c[51], t95);
                let t97 = t68 * c[50];
                let t98 = t69.times_plus(c[50], t97);
                let t99 = t70.times_plus(c[51], t98);
                let t100 = t72 * c[50];
                let t101 = t73.times_plus(c[50], t100);
                let t102 = t74.times_plus(c[51], t101);
                let t103 = t78 * t96;
                let t104 = t78 * t102;
                let t105 = t82 * c[52];
                // x₃, the first guess
                let t106 = t93.times_plus(t105, t103);
                let t107 = t99.times_plus(t105, t104);
                let t108 = t86.times_plus(t96, t107);
                let t109 = t90 * c[52];
                // x₆, the first guess
                let t110 = t93.times_plus(t109, t108);
                <Vector<
                    T,
                > as ::core::convert::From<_>>::from([t78, t82, t106, t86, t90, t110])
            })
        }
        #[inline(always)]
        fn bend(&self, x: T) -> T {
            x * x * T::of(0.25)
        }
        #[inline(always)]
        fn frame(
            &self,
            part: usize,
            input: &Vector<T>,
        ) -> ::core::option::Option<Vector<T>> {
            let c = &self.coefficients;
            match part {
                0usize => {
                    ::core::option::Option::Some({
                        let mu3 = input[2];
                        // y₃
                        let t1 = mu3 * c[69];
                        <Vector<
                            T,
                        > as ::core::convert::From<
                            _,
                        >>::from([
                            T::of(0.0),
                            T::of(0.0),
                            t1,
                            T::of(0.0),
                            T::of(0.0),
                            T::of(0.0),
                        ])
                    })
                }
                1usize => {
                    ::core::option::Option::Some({
                        let mu4 = input[3];
                        // y₄
                        let t1 = mu4 * c[70];
                        let mu5 = input[4];
                        // y₅
                        let t2 = mu5 * c[71];
                        let mu6 = input[5];
                        // y₆
                        let t3 = mu6 * c[72];
                        <Vector<
                            T,
                        > as ::core::convert::From<
                            _,
                        >>::from([T::of(0.0), T::of(0.0), T::of(0.0), t1, t2, t3])
                    })
                }
                _ => ::core::option::Option::None,
            }
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for ComovingBody<T> {
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
    impl ::coadjoint::Lanes for ComovingBody<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = ComovingBody<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> ComovingBody<L> {
            ComovingBody {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> ComovingBody<T> {
        fn table() -> &'static ::coadjoint::plumbing::Table {
            &TABLE
        }
    }
    /// All coefficients as data. A base is Σ h^power Σ factor · product, a slot `c[i]` a base
    /// times an integer.
    static TABLE: ::coadjoint::plumbing::Table = ::coadjoint::plumbing::Table {
        /// Products of symbols: an earlier one times a symbol; number 0 is 1.
        products: &[
            (0, 4), (0, 0), (2, 4), (3, 4), (2, 0), (5, 4), (5, 0), (0, 3), (0, 2), (0, 1),
        ],
        /// Factor, and the number of its product.
        terms: &[
            (0.5, 1), (0.041666666666666664, 4), (0.5, 1), (0.041666666666666664, 4),
            (0.08333333333333333, 6), (0.5, 2), (0.041666666666666664, 6),
            (0.041666666666666664, 7), (0.08333333333333333, 6), (0.5, 2),
            (0.041666666666666664, 6), (0.041666666666666664, 7), (0.5, 8), (0.5, 9), (0.5, 9),
            (0.5, 10), (0.5, 2), (0.5, 2), (-1.0, 1), (-1.0, 2), (1.0, 1), (1.0, 2), (-1.0, 2),
            (1.0, 2), (1.0, 2), (-1.0, 2), (-0.5, 1), (-0.5, 2), (0.5, 1), (0.5, 2), (-0.5, 2),
            (0.5, 2), (0.5, 2), (-0.5, 2), (-0.3333333333333333, 1), (-0.3333333333333333, 2),
            (0.3333333333333333, 1), (0.3333333333333333, 2), (-0.3333333333333333, 2),
            (0.3333333333333333, 2), (0.3333333333333333, 2), (-0.3333333333333333, 2), (1.0, 2),
            (1.0, 2), (1.0, 1), (1.0, 1), (1.0, 0), (0.5, 0), (0.3333333333333333, 0), (0.25, 0),
            (0.08333333333333333, 0), (0.075, 0), (-1.0, 0), (1.0, 10), (1.0, 8), (1.0, 8),
            (1.0, 8),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (3, 2), (1, 3), (3, 4), (3, 5), (1, 6), (3, 7), (3, 8), (3, 9), (1, 10),
            (3, 11), (3, 12), (0, 13), (0, 14), (0, 15), (0, 16), (0, 17), (0, 18), (1, 19),
            (1, 20), (1, 21), (1, 22), (1, 23), (1, 24), (1, 25), (1, 26), (1, 27), (1, 28),
            (1, 29), (1, 30), (1, 31), (1, 32), (1, 33), (1, 34), (1, 35), (1, 36), (1, 37),
            (1, 38), (1, 39), (1, 40), (1, 41), (1, 42), (1, 43), (1, 44), (1, 45), (1, 46),
            (0, 47), (0, 48), (0, 49), (0, 50), (0, 51), (0, 52), (0, 53), (1, 54), (1, 55),
            (1, 56), (1, 57),
        ],
        /// Where the parts of each base end.
        bases: &[
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
            22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40,
            41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56, 57,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (9, 2), (10, 2), (11, 2), (8, 1), (5, 2), (6, 2), (7, 2), (4, 1), (2, 2), (3, 2),
            (0, 2), (1, 2), (11, 4), (10, 4), (7, 4), (6, 4), (3, 4), (1, 4), (18, 1), (19, 1),
            (20, 1), (21, 1), (22, 1), (23, 1), (24, 1), (25, 1), (26, 1), (27, 1), (28, 1),
            (29, 1), (30, 1), (31, 1), (32, 1), (33, 1), (34, 1), (35, 1), (36, 1), (37, 1),
            (38, 1), (39, 1), (40, 1), (41, 1), (42, 1), (43, 1), (44, 1), (45, 1), (46, 1),
            (47, 1), (48, 1), (49, 1), (50, 1), (51, 1), (52, 1), (0, 1), (1, 1), (2, 1), (3, 1),
            (5, 1), (6, 1), (7, 1), (9, 1), (10, 1), (11, 1), (12, 1), (13, 1), (14, 1), (15, 1),
            (16, 1), (17, 1), (53, 1), (54, 1), (55, 1), (56, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[(4, 2)], &[(4, 2), (5, 2)], &[(3, 2)], &[(3, 2), (5, 2)],
            &[(1, 1), (2, 1), (4, 1), (5, 1)], &[(1, 2)], &[(1, 2), (5, 2)], &[(1, 2), (2, 2)],
            &[(0, 1), (2, 1), (3, 1), (5, 1)], &[(0, 2)], &[(0, 2), (5, 2)], &[(0, 2), (2, 2)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₆²), of S₃
// c[2] = 2 C(p₁² p₃²), of S₃
// c[3] = C(p₁ p₃ p₄ p₆), of S₃
// c[4] = 2 C(p₂²), of S₁
// c[5] = 2 C(p₂² p₆²), of S₃
// c[6] = 2 C(p₂² p₃²), of S₃
// c[7] = C(p₂ p₃ p₅ p₆), of S₃
// c[8] = 2 C(p₄²), of S₁
// c[9] = 2 C(p₄² p₆²), of S₃
// c[10] = 2 C(p₅²), of S₁
// c[11] = 2 C(p₅² p₆²), of S₃
// c[12] = 4 C(p₁² p₃²), of S₃
// c[13] = 4 C(p₁² p₆²), of S₃
// c[14] = 4 C(p₂² p₃²), of S₃
// c[15] = 4 C(p₂² p₆²), of S₃
// c[16] = 4 C(p₄² p₆²), of S₃
// c[17] = 4 C(p₅² p₆²), of S₃
// c[53] = C(p₅²), of S₁
// c[54] = C(p₅² p₆²), of S₃
// c[55] = C(p₄²), of S₁
// c[56] = C(p₄² p₆²), of S₃
// c[57] = C(p₂²), of S₁
// c[58] = C(p₂² p₆²), of S₃
// c[59] = C(p₂² p₃²), of S₃
// c[60] = C(p₁²), of S₁
// c[61] = C(p₁² p₆²), of S₃
// c[62] = C(p₁² p₃²), of S₃
