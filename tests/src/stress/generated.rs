//! Families of steps that the attribute generates.

use coadjoint::{Phase, SE3, SO3, lie_poisson};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::parse::rust;

use super::family::{Family, Model};
use super::runtime::{MatrixFree, Runner, Steps};

/// The function with the attribute, and both as text.
macro_rules! system {
    ($module:ident, $name:ident, ($($arguments:tt)*), $($function:tt)*) => {
        mod $module {
            #[allow(unused_imports)]
            use super::{Phase, SE3, SO3, lie_poisson};

            #[lie_poisson($($arguments)*)]
            $($function)*

            pub(super) use $name as System;
            pub(super) const TEXT: (&str, &str) =
                (stringify!($($arguments)*), stringify!($($function)*));
        }
    };
}

system!(
    fixed,
    Fixed,
    (group = SO3, truncation = 7),
    pub(super) fn fixed(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
    }
);
system!(
    comoving,
    Comoving,
    (group = SO3, truncation = 9, frame = comoving),
    pub(super) fn comoving(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
    }
);
system!(
    half_turn,
    HalfTurn,
    (group = SO3, truncation = 5, chart = cayley),
    pub(super) fn half_turn(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
    }
);
system!(
    top,
    Top,
    (group = SE3, truncation = 5),
    pub(super) fn top(mu: [f64; 6], inertia: [f64; 3], weight: f64) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
            + weight * mu[5]
    }
);
system!(
    manakov,
    Manakov,
    (group = SO4, truncation = 5),
    pub(super) fn manakov(mu: [f64; 6]) -> f64 {
        mu[0] * mu[0] / 6.0
            + mu[1] * mu[1] / 8.0
            + mu[2] * mu[2] / 10.0
            + mu[3] * mu[3] / 10.0
            + mu[4] * mu[4] / 12.0
            + mu[5] * mu[5] / 14.0
    }
);

/// Bodies that obey the triangle inequality, with ratios to 10.
const INERTIAS: [[f64; 3]; 5] =
    [[1.5, 2.0, 2.5], [1.3, 2.1, 3.0], [0.4, 3.7, 3.9], [1.0, 1.0, 1.9], [2.0, 2.0, 2.0]];

type Make = Box<dyn Fn(f64) -> Option<Box<dyn Steps>> + Send + Sync>;

/// The exact problem of a function and its judge.
fn model(
    text: (&str, &str),
    parameters: &[f64],
    homogeneous: bool,
    must: bool,
    steps: Make,
) -> Model {
    let arguments = text.0.parse().expect("arguments");
    let function = syn::parse_str(text.1).expect("a function");
    let problem = rust::lie_poisson(arguments, &function).expect("a problem");
    let judge = Judge::of_problem(&problem, TermLimit::default()).expect("a judge");
    let symbols: Vec<f64> = problem.symbols.iter().map(|s| s.expr.evaluate(parameters)).collect();
    // ∂H/∂μ with the symbols put in.
    let dim = problem.algebra.dim();
    let numbers = problem.hamiltonian.factors().map(|(factors, value)| {
        let (momenta, own): (Vec<_>, Vec<_>) =
            factors.into_iter().partition(|f| (f.0 as usize) < dim);
        let factor = own.iter().fold(value, |product, &(variable, power)| {
            let symbol = symbols[variable as usize - dim];
            let exact = coadjoint_codegen::number::Rational::from_float(symbol).expect("finite");
            (0..power).fold(product, |product, _| product * &exact)
        });
        (momenta, factor)
    });
    let energy =
        coadjoint_codegen::poly::Polynomial::from_factors(dim, numbers.collect::<Vec<_>>());
    Model {
        text: format!("{text:?}, {parameters:?}"),
        judge,
        velocity: energy.gradient(dim),
        homogeneous,
        symbols,
        must_accept: must,
        steps,
    }
}

/// All families whose names contain `only`.
pub fn families(only: &str) -> Vec<Family> {
    let mut families = Vec::new();
    let mut add = |name: &str, decades: f64, models: &dyn Fn() -> Vec<Model>| {
        if name.contains(only) {
            families.push(Family { name: name.to_owned(), models: models(), decades });
        }
    };
    let bodies = |make: &dyn Fn([f64; 3]) -> Model| INERTIAS.iter().map(|&i| make(i)).collect();
    add("generated-fixed-7", 30.0, &|| {
        bodies(&|i| {
            model(
                fixed::TEXT,
                &i,
                true,
                true,
                Box::new(move |h| {
                    let steps = fixed::System::<f64>::new(h, i).ok()?;
                    Some(Box::new(Runner::new(steps).compensated().in_lanes()))
                }),
            )
        })
    });
    add("generated-fixed-point-7", 30.0, &|| {
        bodies(&|i| {
            model(
                fixed::TEXT,
                &i,
                true,
                false,
                Box::new(move |h| {
                    let steps = fixed::System::<f64>::new(h, i).ok()?;
                    Some(Box::new(Runner::new(MatrixFree(steps))))
                }),
            )
        })
    });
    add("generated-comoving-9", 30.0, &|| {
        bodies(&|i| {
            model(
                comoving::TEXT,
                &i,
                true,
                true,
                Box::new(move |h| {
                    let steps = comoving::System::<f64>::new(h, i).ok()?;
                    Some(Box::new(Runner::new(steps).compensated().in_lanes()))
                }),
            )
        })
    });
    add("generated-cayley-5", 30.0, &|| {
        bodies(&|i| {
            model(
                half_turn::TEXT,
                &i,
                true,
                false,
                Box::new(move |h| {
                    let steps = half_turn::System::<f64>::new(h, i).ok()?;
                    Some(Box::new(Runner::new(steps).compensated()))
                }),
            )
        })
    });
    add("generated-top-5", 1.0, &|| {
        bodies(&|i| {
            let parameters = [i[0], i[1], i[2], 1.25];
            model(
                top::TEXT,
                &parameters,
                false,
                false,
                Box::new(move |h| {
                    let steps = top::System::<f64>::new(h, i, 1.25).ok()?;
                    Some(Box::new(Runner::new(steps).compensated().in_lanes()))
                }),
            )
        })
    });
    add("generated-manakov-5", 30.0, &|| {
        vec![model(
            manakov::TEXT,
            &[],
            true,
            false,
            Box::new(move |h| {
                let steps = manakov::System::<f64>::new(h).ok()?;
                Some(Box::new(Runner::new(steps)))
            }),
        )]
    });
    families
}
