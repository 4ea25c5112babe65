// three_wave: written by coadjoint 0.1.0; changes will be overwritten.
//
// Hamiltonian: `mu[0] * mu[0] / 8.0 + s * mu[1] * mu[2]`
//
// Group: SL2. Chart exp, truncation K = 5, order of accuracy 6.
// Terms: S1: 2, S3: 3, S5: 9.
// Operations: gradient and Hessian 32 multiplications and 11 additions; predictor of degree 6 42 and 26.
//
// Programs have one operation a line: `c[i]` is a coefficient, folded once for the step size and the
// parameters, and `a.times_plus(b, c)` is a * b + c. A comment says what a line computes. Coordinates
// count from one in names and comments. Tables stand at the end.

/// Hamiltonian: `mu[0] * mu[0] / 8.0 + s * mu[1] * mu[2]`
///
/// Group: SL2. Chart exp, truncation K = 5, order of accuracy 6.
/// Terms: S1: 2, S3: 3, S5: 9.
/// Operations: gradient and Hessian 32 multiplications and 11 additions; predictor of degree 6 42 and 26.
#[derive(::core::clone::Clone, ::core::fmt::Debug)]
#[allow(clippy::trailing_empty_array)]
pub struct ThreeWave<T = f64> {
    /// The step size h.
    step: T,
    /// The coefficients of the programs below, folded for h and the parameters.
    coefficients: [T; 63],
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
    impl<T: ::coadjoint::Scalar> ThreeWave<T> {
        /// K: the series S₁ … S_K of the generating function is kept.
        pub const TRUNCATION: usize = 5;
        /// The order of accuracy, K + 1.
        pub const ORDER: usize = 6;
        /// Folds all coefficients for the step size `step` (negative: backwards in time) and the
        /// parameters.
        ///
        /// # Errors
        /// `StepError::InvalidStep` for a step that is zero or not finite,
        /// `StepError::InvalidParameter` where a parameter expression is not finite.
        pub fn new(
            step: T,
            s: T,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(step, &[s])?;
            ::core::result::Result::Ok(Self::fold(step, &parts, &|_| T::of(1.0)))
        }
        /// As `new`, with the tail of the series summed for motions that start with `momenta`
        /// (`coadjoint::Tail`): as fast, as geometric, of the same order, and more accurate.
        ///
        /// # Errors
        /// As `new`, and where a step from one of the momenta fails.
        pub fn tuned(
            step: T,
            s: T,
            momenta: impl ::core::iter::IntoIterator<
                Item = impl ::core::convert::Into<Vector<T>>,
            >,
        ) -> ::core::result::Result<Self, ::coadjoint::StepError> {
            let parts = Self::parts(step, &[s])?;
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
            symbols: &[T; 1],
        ) -> ::core::result::Result<[T; 36], ::coadjoint::StepError> {
            ::coadjoint::plumbing::parts::<
                T,
                7,
                7,
                36,
            >(Self::table(), &["s"], step, symbols)
        }
        /// The coefficients of Σ factor(k) S_k.
        fn fold(
            step: T,
            parts: &[T; 36],
            factor: &dyn ::core::ops::Fn(usize) -> T,
        ) -> Self {
            let coefficients = ::coadjoint::plumbing::slots::<
                T,
                7,
                36,
                36,
                63,
            >(Self::table(), parts, factor);
            Self::with(step, coefficients)
        }
        fn with(step: T, coefficients: [T; 63]) -> Self {
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
            phase: &mut ::coadjoint::Phase<::coadjoint::SL2<T>>,
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
            phase: &mut ::coadjoint::Phase<::coadjoint::SL2<T>>,
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
            let mu3 = input[2];
            let t2 = mu2 * mu3;
            let t3 = t2 * c[61];
            // H_red(μ)
            let t4 = t1.times_plus(c[62], t3);
            t4
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::GeneratingFunction for ThreeWave<T> {
        type Group = ::coadjoint::SL2<T>;
        type Chart = ::coadjoint::Exponential;
        #[inline(always)]
        fn group(&self) -> &::coadjoint::SL2<T> {
            const { &<::coadjoint::SL2<T>>::new() }
        }
        #[inline]
        fn value(&self, input: &Vector<T>) -> T {
            let c = &self.coefficients;
            let p1 = input[0];
            let t1 = p1 * p1;
            let p2 = input[1];
            let p3 = input[2];
            let t2 = p3 * c[60];
            let t3 = p2.times_plus(t2, c[5]);
            let t4 = t1.times_plus(c[6], t3);
            let t5 = p3 * t4;
            let t6 = p2.times_plus(t5, c[59]);
            let t7 = p2 * p3;
            let t8 = t7 * c[4];
            // S(p)
            let t9 = t1.times_plus(t6, t8);
            t9
        }
        #[inline]
        fn gradient(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let p2 = input[1];
            let p3 = input[2];
            let p1 = input[0];
            let t1 = p1 * p1;
            let t2 = p3 * c[2];
            let t3 = p2.times_plus(t2, c[1]);
            let t4 = t1.times_plus(c[3], t3);
            let t5 = p3 * t4;
            let t6 = p2.times_plus(t5, c[0]);
            // ∂(S₁ + … + S₅)/∂p₁
            let t7 = p1 * t6;
            let t8 = p3 * p3;
            let t9 = t1 * t8;
            let t10 = c[2] * t9;
            let t11 = t1.times_plus(c[6], c[5]);
            let t12 = t1.times_plus(t11, c[4]);
            let t13 = p3 * t12;
            // ∂(S₁ + … + S₅)/∂p₂
            let t14 = p2.times_plus(t10, t13);
            let t15 = p2 * p2;
            let t16 = t1 * t15;
            let t17 = c[2] * t16;
            let t18 = p2 * t12;
            // ∂(S₁ + … + S₅)/∂p₃
            let t19 = p3.times_plus(t17, t18);
            <Vector<T> as ::core::convert::From<_>>::from([t7, t14, t19])
        }
        #[inline(always)]
        fn gradient_and_hessian(&self, input: &Vector<T>) -> (Vector<T>, Matrix<T>) {
            let c = &self.coefficients;
            let p2 = input[1];
            let p3 = input[2];
            let p1 = input[0];
            let t1 = p1 * p1;
            let t2 = p3 * c[2];
            let t3 = p2.times_plus(t2, c[1]);
            let t4 = t1.times_plus(c[3], t3);
            let t5 = p3 * t4;
            let t6 = p2.times_plus(t5, c[0]);
            // ∂S/∂p₁
            let t7 = p1 * t6;
            let t8 = p3 * p3;
            let t9 = t1 * t8;
            // ∂²(S₁ + … + S₅)/∂p₂²
            let t10 = c[2] * t9;
            let t11 = t1.times_plus(c[6], c[5]);
            let t12 = t1.times_plus(t11, c[4]);
            let t13 = p3 * t12;
            // ∂S/∂p₂
            let t14 = p2.times_plus(t10, t13);
            let t15 = p2 * p2;
            let t16 = t1 * t15;
            // ∂²(S₁ + … + S₅)/∂p₃²
            let t17 = c[2] * t16;
            let t18 = p2 * t12;
            // ∂S/∂p₃
            let t19 = p3.times_plus(t17, t18);
            let t20 = p2 * t1;
            let t21 = p3 * t20;
            let t22 = t21 * c[7];
            // ∂²(S₁ + … + S₅)/∂p₁²
            let t23 = t6 + t22;
            let t24 = p3 * p1;
            let t25 = p3 * c[8];
            let t26 = p2.times_plus(t25, c[1]);
            let t27 = t1.times_plus(c[3], t26);
            // ∂²(S₁ + … + S₅)/∂p₁∂p₂
            let t28 = t24 * t27;
            let t29 = p2 * p1;
            // ∂²(S₁ + … + S₅)/∂p₁∂p₃
            let t30 = t27 * t29;
            let t31 = t1 * c[8];
            let t32 = p2 * p3;
            // ∂²(S₁ + … + S₅)/∂p₂∂p₃
            let t33 = t31.times_plus(t32, t12);
            let gradient = <Vector<T> as ::core::convert::From<_>>::from([t7, t14, t19]);
            let hessian = <Matrix<
                T,
            > as ::core::convert::From<
                _,
            >>::from([[t23, t28, t30], [t28, t10, t33], [t30, t33, t17]]);
            (gradient, hessian)
        }
        #[inline(always)]
        fn predict(&self, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let mu1 = input[0];
            let mu2 = input[1];
            let mu3 = input[2];
            let t1 = mu1 * mu1;
            let t2 = mu3 * c[35];
            let t3 = mu2.times_plus(t2, c[34]);
            let t4 = t1.times_plus(c[36], t3);
            let t5 = mu3 * c[33];
            let t6 = mu2.times_plus(t5, c[32]);
            let t7 = mu3 * t6;
            let t8 = mu2.times_plus(t7, c[31]);
            let t9 = t1.times_plus(t4, t8);
            let t10 = mu3 * t9;
            let t11 = mu2.times_plus(t10, c[30]);
            // p₁, the first guess
            let t12 = mu1 * t11;
            let t13 = mu1.times_plus(c[47], c[46]);
            let t14 = mu3 * c[45];
            let t15 = mu2.times_plus(t14, c[44]);
            let t16 = mu1.times_plus(t13, t15);
            let t17 = mu3 * c[43];
            let t18 = mu2.times_plus(t17, c[42]);
            let t19 = mu1.times_plus(t16, t18);
            let t20 = mu3 * c[41];
            let t21 = mu2.times_plus(t20, c[40]);
            let t22 = mu3 * t21;
            let t23 = mu2.times_plus(t22, c[39]);
            let t24 = mu1.times_plus(t19, t23);
            let t25 = mu1.times_plus(t24, c[38]);
            let t26 = mu1.times_plus(t25, c[37]);
            // p₂, the first guess
            let t27 = mu2 * t26;
            let t28 = mu1.times_plus(c[58], c[57]);
            let t29 = mu3 * c[56];
            let t30 = mu2.times_plus(t29, c[55]);
            let t31 = mu1.times_plus(t28, t30);
            let t32 = mu3 * c[54];
            let t33 = mu2.times_plus(t32, c[53]);
            let t34 = mu1.times_plus(t31, t33);
            let t35 = mu3 * c[52];
            let t36 = mu2.times_plus(t35, c[51]);
            let t37 = mu3 * t36;
            let t38 = mu2.times_plus(t37, c[50]);
            let t39 = mu1.times_plus(t34, t38);
            let t40 = mu1.times_plus(t39, c[49]);
            let t41 = mu1.times_plus(t40, c[48]);
            // p₃, the first guess
            let t42 = mu3 * t41;
            <Vector<T> as ::core::convert::From<_>>::from([t12, t27, t42])
        }
        #[inline(always)]
        fn predict_after(&self, last: &Vector<T>, input: &Vector<T>) -> Vector<T> {
            let c = &self.coefficients;
            let twice_even = {
                let mu1 = input[0];
                let mu2 = input[1];
                let mu3 = input[2];
                let t1 = mu1 * mu1;
                let t2 = mu3 * c[14];
                let t3 = mu2.times_plus(t2, c[13]);
                let t4 = t1.times_plus(c[15], t3);
                let t5 = mu3 * c[12];
                let t6 = mu2.times_plus(t5, c[11]);
                let t7 = mu3 * t6;
                let t8 = mu2.times_plus(t7, c[10]);
                let t9 = t1.times_plus(t4, t8);
                let t10 = mu3 * t9;
                let t11 = mu2.times_plus(t10, c[9]);
                // twice the part of p₁ that is even in h
                let t12 = mu1 * t11;
                let t13 = mu3 * c[21];
                let t14 = mu2.times_plus(t13, c[20]);
                let t15 = t1.times_plus(c[22], t14);
                let t16 = mu3 * c[19];
                let t17 = mu2.times_plus(t16, c[18]);
                let t18 = mu3 * t17;
                let t19 = mu2.times_plus(t18, c[17]);
                let t20 = t1.times_plus(t15, t19);
                let t21 = t1.times_plus(t20, c[16]);
                // twice the part of p₂ that is even in h
                let t22 = mu2 * t21;
                let t23 = mu3 * c[28];
                let t24 = mu2.times_plus(t23, c[27]);
                let t25 = t1.times_plus(c[29], t24);
                let t26 = mu3 * c[26];
                let t27 = mu2.times_plus(t26, c[25]);
                let t28 = mu3 * t27;
                let t29 = mu2.times_plus(t28, c[24]);
                let t30 = t1.times_plus(t25, t29);
                let t31 = t1.times_plus(t30, c[23]);
                // twice the part of p₃ that is even in h
                let t32 = mu3 * t31;
                <Vector<T> as ::core::convert::From<_>>::from([t12, t22, t32])
            };
            twice_even - last
        }
        #[inline(always)]
        fn bend(&self, x: T) -> T {
            x * x * T::of(0.25)
        }
    }
    impl<T: ::coadjoint::Scalar> ::coadjoint::Adjustable for ThreeWave<T> {
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
    impl ::coadjoint::Lanes for ThreeWave<f64> {
        type Over<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        > = ThreeWave<L>;
        fn splat<
            L: ::coadjoint::Scalar + ::coadjoint::nalgebra::SimdValue<Element = f64>,
        >(&self) -> ThreeWave<L> {
            ThreeWave {
                step: L::splat(self.step),
                coefficients: self.coefficients.map(L::splat),
                defect: self.defect.map(L::splat),
            }
        }
    }
    impl<T> ThreeWave<T> {
        fn table() -> &'static ::coadjoint::plumbing::Table {
            &TABLE
        }
    }
    /// All coefficients as data. A base is Σ h^power Σ factor · product, a slot `c[i]` a base
    /// times an integer.
    static TABLE: ::coadjoint::plumbing::Table = ::coadjoint::plumbing::Table {
        /// Products of symbols: an earlier one times a symbol; number 0 is 1.
        products: &[(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (5, 0)],
        /// Factor, and the number of its product.
        terms: &[
            (1.0, 1), (0.125, 0), (-0.08333333333333333, 3), (0.08333333333333333, 2),
            (-0.020833333333333332, 1), (-0.022222222222222223, 5), (0.03611111111111111, 4),
            (-0.019444444444444445, 3), (0.003472222222222222, 2), (0.008333333333333333, 5),
            (-0.013888888888888888, 4), (0.008680555555555556, 3), (-0.0024305555555555556, 2),
            (0.00026041666666666666, 1), (1.0, 1), (0.125, 0), (1.0, 0), (-0.3333333333333333, 2),
            (0.16666666666666666, 1), (0.022222222222222223, 4), (-0.011111111111111112, 3),
            (-0.0021164021164021165, 6), (0.0010582010582010583, 5), (-0.027777777777777776, 4),
            (0.027777777777777776, 3), (-0.005555555555555556, 2), (-0.0006944444444444445, 1),
            (0.009259259259259259, 6), (-0.012037037037037037, 5), (0.004828042328042328, 4),
            (-0.0005621693121693122, 3), (-0.000925925925925926, 6), (0.001388888888888889, 5),
            (-0.000462962962962963, 4), (-0.00011574074074074075, 3), (0.0000496031746031746, 2),
            (0.000004133597883597884, 1), (1.0, 0), (-0.5, 1), (0.25, 0), (0.25, 2),
            (-0.20833333333333334, 1), (0.041666666666666664, 0), (-0.027777777777777776, 4),
            (0.025, 3), (-0.005555555555555556, 2), (0.003703703703703704, 6),
            (-0.0034391534391534392, 5), (0.0007936507936507937, 4), (-0.08333333333333333, 3),
            (0.10416666666666667, 2), (-0.041666666666666664, 1), (0.005208333333333333, 0),
            (0.013888888888888888, 5), (-0.019444444444444445, 4), (0.009027777777777777, 3),
            (-0.001388888888888889, 2), (0.020833333333333332, 4), (-0.034722222222222224, 3),
            (0.020833333333333332, 2), (-0.005381944444444444, 1), (0.0005208333333333333, 0),
            (-0.0060185185185185185, 6), (0.010416666666666666, 5), (-0.00636574074074074, 4),
            (0.0015955687830687831, 3), (-0.00013227513227513228, 2), (-0.004166666666666667, 5),
            (0.008680555555555556, 4), (-0.006944444444444444, 3), (0.002690972222222222, 2),
            (-0.0005208333333333333, 1), (0.00004340277777777778, 0), (0.0006944444444444445, 6),
            (-0.001736111111111111, 5), (0.001736111111111111, 4), (-0.0008969907407407407, 3),
            (0.00026041666666666666, 2), (-0.00004236937830687831, 1),
            (0.0000031001984126984127, 0), (1.0, 0), (0.5, 1), (-0.25, 0), (0.25, 2),
            (-0.20833333333333334, 1), (0.041666666666666664, 0), (-0.027777777777777776, 4),
            (0.025, 3), (-0.005555555555555556, 2), (0.003703703703703704, 6),
            (-0.0034391534391534392, 5), (0.0007936507936507937, 4), (0.08333333333333333, 3),
            (-0.10416666666666667, 2), (0.041666666666666664, 1), (-0.005208333333333333, 0),
            (-0.013888888888888888, 5), (0.019444444444444445, 4), (-0.009027777777777777, 3),
            (0.001388888888888889, 2), (0.020833333333333332, 4), (-0.034722222222222224, 3),
            (0.020833333333333332, 2), (-0.005381944444444444, 1), (0.0005208333333333333, 0),
            (-0.0060185185185185185, 6), (0.010416666666666666, 5), (-0.00636574074074074, 4),
            (0.0015955687830687831, 3), (-0.00013227513227513228, 2), (0.004166666666666667, 5),
            (-0.008680555555555556, 4), (0.006944444444444444, 3), (-0.002690972222222222, 2),
            (0.0005208333333333333, 1), (-0.00004340277777777778, 0), (0.0006944444444444445, 6),
            (-0.001736111111111111, 5), (0.001736111111111111, 4), (-0.0008969907407407407, 3),
            (0.00026041666666666666, 2), (-0.00004236937830687831, 1),
            (0.0000031001984126984127, 0),
        ],
        /// The power of h, and where its terms end.
        parts: &[
            (1, 1), (1, 2), (3, 5), (5, 9), (5, 14), (0, 15), (0, 16), (0, 17), (2, 19), (4, 21),
            (6, 23), (4, 27), (6, 31), (6, 37), (0, 38), (1, 40), (2, 43), (4, 46), (6, 49),
            (3, 53), (5, 57), (4, 62), (6, 67), (5, 73), (6, 80), (0, 81), (1, 83), (2, 86),
            (4, 89), (6, 92), (3, 96), (5, 100), (4, 105), (6, 110), (5, 116), (6, 123),
        ],
        /// Where the parts of each base end.
        bases: &[
            1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
            22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36,
        ],
        /// For each slot its base, and the integer.
        slots: &[
            (1, 2), (2, 2), (3, 2), (4, 4), (0, 1), (2, 1), (4, 1), (4, 8), (3, 4), (7, 2), (8, 2),
            (9, 2), (10, 2), (11, 2), (12, 2), (13, 2), (14, 2), (16, 2), (17, 2), (18, 2), (21, 2),
            (22, 2), (24, 2), (25, 2), (27, 2), (28, 2), (29, 2), (32, 2), (33, 2), (35, 2), (7, 1),
            (8, 1), (9, 1), (10, 1), (11, 1), (12, 1), (13, 1), (14, 1), (15, 1), (16, 1), (17, 1),
            (18, 1), (19, 1), (20, 1), (21, 1), (22, 1), (23, 1), (24, 1), (25, 1), (26, 1),
            (27, 1), (28, 1), (29, 1), (30, 1), (31, 1), (32, 1), (33, 1), (34, 1), (35, 1), (1, 1),
            (3, 1), (5, 1), (6, 1),
        ],
        /// The monomials of S, as (coordinate, exponent) from zero; their coefficients are the
        /// first bases.
        monomials: &[
            &[(1, 1), (2, 1)], &[(0, 2)], &[(0, 2), (1, 1), (2, 1)], &[(0, 2), (1, 2), (2, 2)],
            &[(0, 4), (1, 1), (2, 1)],
        ],
        /// The terms of the first guess that are even in h: base, coordinate, monomial.
        guess: &[
            (7, 0, &[(0, 1)]), (8, 0, &[(0, 1), (1, 1), (2, 1)]), (9, 0, &[(0, 1), (1, 2), (2, 2)]),
            (10, 0, &[(0, 1), (1, 3), (2, 3)]), (11, 0, &[(0, 3), (1, 1), (2, 1)]),
            (12, 0, &[(0, 3), (1, 2), (2, 2)]), (13, 0, &[(0, 5), (1, 1), (2, 1)]),
            (14, 1, &[(1, 1)]), (16, 1, &[(0, 2), (1, 1)]), (17, 1, &[(0, 2), (1, 2), (2, 1)]),
            (18, 1, &[(0, 2), (1, 3), (2, 2)]), (21, 1, &[(0, 4), (1, 1)]),
            (22, 1, &[(0, 4), (1, 2), (2, 1)]), (24, 1, &[(0, 6), (1, 1)]), (25, 2, &[(2, 1)]),
            (27, 2, &[(0, 2), (2, 1)]), (28, 2, &[(0, 2), (1, 1), (2, 2)]),
            (29, 2, &[(0, 2), (1, 2), (2, 3)]), (32, 2, &[(0, 4), (2, 1)]),
            (33, 2, &[(0, 4), (1, 1), (2, 2)]), (35, 2, &[(0, 6), (2, 1)]),
        ],
    };
};

// What programs read of S = Σ C(m) m, C(m) the coefficient of the monomial m:
// c[0] = 2 C(p₁²), of S₁
// c[1] = 2 C(p₁² p₂ p₃), of S₃
// c[2] = 2 C(p₁² p₂² p₃²), of S₅
// c[3] = 4 C(p₁⁴ p₂ p₃), of S₅
// c[4] = C(p₂ p₃), of S₁
// c[5] = C(p₁² p₂ p₃), of S₃
// c[6] = C(p₁⁴ p₂ p₃), of S₅
// c[7] = 8 C(p₁⁴ p₂ p₃), of S₅
// c[8] = 4 C(p₁² p₂² p₃²), of S₅
// c[59] = C(p₁²), of S₁
// c[60] = C(p₁² p₂² p₃²), of S₅
