//! The code that the attributes emit means the same whatever names its surroundings have.

use coadjoint::{Phase, SE3, SO3, StepError};

/// No prelude: no `Option`, `Some`, `Into`, `Iterator`.
mod without_prelude {
    #![no_implicit_prelude]

    #[::coadjoint::lie_poisson(group = SO3, truncation = 5)]
    pub fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2]
    }

    // In parts, several steps at once, and in a frame that moves.
    #[::coadjoint::lie_poisson(group = SE3, truncation = 7, frame = comoving)]
    pub fn submerged(mu: [f64; 6], mass: [f64; 2]) -> f64 {
        let [a, b, c, u, v, w] = mu;
        (a * a + b * b) / mass[0].sqrt() + c * c + u * u + v * v + w * w / mass[1]
    }

    #[::coadjoint::lie_poisson(group = algebra(generators = [a, b], brackets = ["[a, b] = b"]))]
    pub fn affine(mu: [f64; 2], k: f64) -> f64 {
        mu[0] * mu[0] + k * mu[1] * mu[1]
    }

    #[::coadjoint::potential(group = SO3)]
    pub fn height(g: [[f64; 3]; 3], weight: f64) -> f64 {
        weight * g[2][2] * g[0][1]
    }
}

/// Constants, types and traits with the names that emitted code uses.
#[allow(non_upper_case_globals, non_camel_case_types, dead_code, unused_imports)]
mod hostile {
    macro_rules! constants {
        ($($name:ident)*) => { $(pub const $name: &str = "not a number";)* };
    }
    constants! {
        step steps input c p1 p2 p3 v1 mu mu1 t1 t2 t3 g x h i j k p part phase group size last factor
        parts series coefficients number symbols direction found pieces
        twice_even fine shared later gradient hessian TABLE Vector_ T_ table
    }
    pub struct Option;
    pub struct Some;
    pub struct None;
    pub struct Ok;
    pub struct Result;
    pub struct Vector;
    pub struct Matrix;
    pub struct T;
    pub trait Into {
        fn into(&self) {}
        fn map(&self) {}
        fn times_plus(&self) {}
    }
    impl<A: ?Sized> Into for A {}

    #[coadjoint::lie_poisson(group = SO3, truncation = 5)]
    pub fn body(momentum: [f64; 3], inertia: [f64; 3]) -> f64 {
        let [x_, y, z] = momentum;
        x_ * x_ / inertia[0] + y * y / inertia[1] + z * z / inertia[2]
    }

    #[coadjoint::lie_poisson(group = SE3, truncation = 7, frame = comoving)]
    pub fn submerged(momentum: [f64; 6], mass: [f64; 2]) -> f64 {
        let [a, b, d, u, v, w] = momentum;
        (a * a + b * b) / mass[0].sqrt() + d * d + u * u + v * v + w * w / mass[1]
    }

    #[coadjoint::potential(group = SO3)]
    pub fn height(element: [[f64; 3]; 3], weight: f64) -> f64 {
        weight * element[2][2] * element[0][1]
    }
}

/// Parameters with the names that emitted code uses.
mod parameters {
    use coadjoint::lie_poisson;

    #[lie_poisson(group = SO3, truncation = 3)]
    #[allow(clippy::too_many_arguments)]
    pub fn named(
        mu: [f64; 3],
        parts: f64,
        parts_: f64,
        coefficients: f64,
        coefficients_: f64,
        step_: f64,
        c: f64,
        input: f64,
        series: [f64; 2],
        factor: f64,
    ) -> f64 {
        let squares = mu[0] * mu[0] * (parts + parts_)
            + mu[1] * mu[1] * (coefficients * coefficients_ + step_);
        squares + mu[2] * mu[2] * (c + input + series[0] + series[1] + factor)
    }

    #[lie_poisson(group = SO3, truncation = 3)]
    pub fn vector(mu: [f64; 3]) -> f64 {
        mu[0] * mu[1]
    }

    #[lie_poisson(group = SO3, truncation = 3)]
    pub fn matrix(mu: [f64; 3]) -> f64 {
        mu[0] * mu[1]
    }
}

mod my {
    pub use ::coadjoint;

    pub mod inner {
        #[coadjoint::lie_poisson(group = SO3, truncation = 3, crate = super::coadjoint)]
        pub fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
            mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2]
        }

        #[coadjoint::potential(crate = crate::hygiene::my::coadjoint, group = SO3)]
        pub fn height(g: [[f64; 3]; 3], weight: f64) -> f64 {
            weight * g[2][2]
        }
    }
}

#[test]
fn surroundings_do_not_change_a_step() -> Result<(), StepError> {
    let mut here = Phase::<SO3>::at_identity([1.0, 0.2, -0.4]);
    let mut there = here.clone();
    without_prelude::Body::new(0.1, [1.0, 2.0, 3.0])?.advance_by(&mut here, 20)?;
    hostile::Body::new(0.1, [1.0, 2.0, 3.0])?.advance_by(&mut there, 20)?;
    assert_eq!(here.momentum, there.momentum);

    let start = [0.3, 0.1, 0.5, 1.0, -0.2, 0.4];
    let mut here = Phase::<SE3>::at_identity(start);
    let mut there = here.clone();
    without_prelude::Submerged::new(0.1, [1.5, 2.0])?.advance_by(&mut here, 20)?;
    hostile::Submerged::new(0.1, [1.5, 2.0])?.advance_by(&mut there, 20)?;
    assert_eq!(here.momentum, there.momentum);

    let affine = without_prelude::Affine::new(0.1, 2.0)?;
    let mut state = Phase::<without_prelude::AffineGroup>::at_identity([0.1, 0.2]);
    affine.advance(&mut state)?;

    let g = there.group_element;
    let rotation = Phase::<SO3>::at_identity([0.0; 3]).group_element;
    let _ = g;
    let (one, other) = (without_prelude::Height::new(2.0)?, hostile::Height::new(2.0)?);
    assert_eq!(one.torque(&rotation), other.torque(&rotation));
    Ok(())
}

#[test]
fn parameters_may_have_any_name_and_keep_it() -> Result<(), StepError> {
    let step = parameters::Named::new(0.1, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, [8.0, 9.0], 10.0)?;
    let mu = [1.0, 10.0, 100.0];
    let energy = parameters::named(mu, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, [8.0, 9.0], 10.0);
    assert!((step.energy(&mu.into()) / energy - 1.0).abs() < 1e-15);
    let same = parameters::vector(mu) - parameters::matrix(mu);
    assert_eq!(same, 0.0);
    assert_eq!(parameters::Vector::new(0.1)?.step(), parameters::Matrix::new(0.1)?.step());
    Ok(())
}

#[test]
fn the_runtime_may_be_reached_by_another_path() -> Result<(), StepError> {
    let step = my::inner::Body::new(0.1, [1.0, 2.0, 3.0])?;
    let mut state = Phase::<SO3>::at_identity([1.0, 0.2, -0.4]);
    step.advance(&mut state)?;
    assert!(my::inner::Height::new(2.0)?.energy(&state.group_element) <= 2.0);
    Ok(())
}
