//! Families of steps that the attribute generates, of free bodies.

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::parse::rust;
use coadjoint_codegen::poly::Polynomial;

use super::family::{Family, Instance, Models, Realisation, Template, inertias};
use super::instance;
use super::random::Random;
use super::runtime::{MatrixFree, Runner};

/// The function with the attribute, and both as text.
macro_rules! system {
    ($module:ident, $name:ident, ($($arguments:tt)*), $($function:tt)*) => {
        mod $module {
            #[coadjoint::lie_poisson($($arguments)*)]
            $($function)*

            pub(super) use $name as System;
            pub(super) const TEXT: [&str; 2] =
                [stringify!($($arguments)*), stringify!($($function)*)];
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

/// Makes steps from their size and the moments of inertia.
type Make = fn(f64, [f64; 3]) -> Option<Instance>;

fn in_lanes(h: f64, inertia: [f64; 3]) -> Option<Instance> {
    let steps = fixed::System::<f64>::new(h, inertia).ok()?;
    Some(Instance::series(Runner::new(steps).in_lanes()))
}

fn by_fixed_point(h: f64, inertia: [f64; 3]) -> Option<Instance> {
    let steps = fixed::System::<f64>::new(h, inertia).ok()?;
    Some(Instance::series(Runner::new(MatrixFree(steps))))
}

fn in_a_comoving_frame(h: f64, inertia: [f64; 3]) -> Option<Instance> {
    let steps = comoving::System::<f64>::new(h, inertia).ok()?;
    Some(Instance::series(Runner::new(steps).in_lanes()))
}

/// Bodies of any size that obey the triangle inequality, with ratios to 10. Where `must`, steps with h|μ|/I < 1.5 must be
/// accepted.
fn model([arguments, function]: [&'static str; 2], must: bool, make: Make) -> Template {
    let source = syn::parse_str(function).expect("a function");
    let read = rust::hamiltonian(arguments.parse().expect("arguments"), &source);
    let problem = read.ok().and_then(|read| read.into_polynomial().ok()).expect("a polynomial");
    let judge = Judge::of_problem(&problem, TermLimit::default()).expect("a judge");
    let draw = move |random: &mut Random| {
        let size = 10_f64.powf(random.between(-3.0, 1.0));
        let inertia = inertias(random).map(|i| size * i as f64);
        let velocity = |i: usize| {
            let inverse = Rational::from_float(inertia[i]).expect("finite").recip();
            Polynomial::variable(3, i).scale(&inverse)
        };
        let least = inertia.iter().copied().fold(f64::INFINITY, f64::min);
        Realisation {
            text: format!("{arguments}, {function}, {inertia:?}"),
            velocity: (0..3).map(velocity).collect(),
            homogeneous: true,
            symbols: problem.symbols.iter().map(|s| s.expr.evaluate(&inertia)).collect(),
            promised: must.then_some(least),
            steps: Box::new(move |h, _| make(h, inertia)),
        }
    };
    Template { judge, draw: Box::new(draw) }
}

pub fn families(only: &str) -> Vec<Family> {
    let all: [(&str, usize, [&str; 2], bool, Make); 4] = [
        ("generated-fixed-7", 256, fixed::TEXT, true, in_lanes),
        ("generated-promise-7", 16, fixed::TEXT, true, in_lanes),
        ("generated-fixed-point-7", 128, fixed::TEXT, false, by_fixed_point),
        ("generated-comoving-9", 256, comoving::TEXT, true, in_a_comoving_frame),
    ];
    let chosen = all.into_iter().filter(|family| family.0.contains(only));
    let family = |(name, weight, text, must, make): (&str, _, _, _, _)| {
        let (models, promise) = (vec![model(text, must, make)], name.contains("promise"));
        instance::family(name.to_owned(), weight, Models { models, decades: 30.0, promise })
    };
    chosen.map(family).collect()
}
