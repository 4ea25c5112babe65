//! Families of steps that the attribute generates.

use std::sync::Arc;

use coadjoint::generating::PolynomialFunction;
use coadjoint::groups::Exponential;
use coadjoint::{Phase, SE3, SO3, lie_poisson};
use coadjoint_codegen::hamilton_jacobi::{GeneratingSeries, TermLimit, derive};
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::parse::rust;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::Problem;

use super::family::{Family, Made, Make, Model, System, inertias};
use super::random::Random;
use super::runtime::{MatrixFree, Runner};
use crate::bridge::double;

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
    long_top,
    LongTop,
    (group = SE3, truncation = 7),
    pub(super) fn long_top(mu: [f64; 6], inertia: [f64; 3], weight: f64) -> f64 {
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

/// A problem of a function, with what is known before its parameters.
struct Source {
    problem: Problem,
    text: (&'static str, &'static str),
    homogeneous: bool,
    /// Whether steps with h|μ|/I < 1.5 must be accepted.
    must: bool,
}

impl Source {
    fn new(text: (&'static str, &'static str)) -> Self {
        let arguments = text.0.parse().expect("arguments");
        let function = syn::parse_str(text.1).expect("a function");
        let problem = rust::lie_poisson(arguments, &function).expect("a problem");
        Self { problem, text, homogeneous: true, must: false }
    }

    fn judge(&self) -> Judge {
        Judge::of_problem(&self.problem, TermLimit::default()).expect("a judge")
    }

    fn symbols(&self, parameters: &[f64]) -> Vec<f64> {
        self.problem.symbols.iter().map(|s| s.expr.evaluate(parameters)).collect()
    }

    /// ∂H/∂μ with the symbols put in.
    fn velocity(&self, symbols: &[f64]) -> Vec<Polynomial> {
        let dim = self.problem.algebra.dim();
        let numbers = self.problem.hamiltonian.factors().map(|(factors, value)| {
            let (momenta, own): (Vec<_>, Vec<_>) =
                factors.into_iter().partition(|f| (f.0 as usize) < dim);
            let factor = own.iter().fold(value, |product, &(variable, power)| {
                let symbol = symbols[variable as usize - dim];
                let exact = Rational::from_float(symbol).expect("finite");
                (0..power).fold(product, |product, _| product * &exact)
            });
            (momenta, factor)
        });
        Polynomial::from_factors(dim, numbers.collect::<Vec<_>>()).gradient(dim)
    }

    /// The system with these parameters, the first three of which may be moments of inertia.
    fn system(&self, parameters: &[f64], steps: Make) -> System {
        let symbols = self.symbols(parameters);
        let least = parameters.iter().take(3).copied().fold(f64::INFINITY, f64::min);
        System {
            text: format!("{:?}, {parameters:?}", self.text),
            velocity: self.velocity(&symbols),
            homogeneous: self.homogeneous,
            symbols,
            promised: self.must.then_some(least),
            steps,
        }
    }
}

/// Bodies of any size that obey the triangle inequality, with ratios to 10.
fn body(random: &mut Random) -> [f64; 3] {
    let size = 10_f64.powf(random.between(-3.0, 1.0));
    inertias(random).map(|i| size * i as f64)
}

/// A model of bodies whose steps are made by `make` from a step size and the moments of inertia.
fn bodies<F>(source: Source, make: F) -> Vec<Model>
where
    F: Fn(f64, [f64; 3]) -> Option<Made> + Copy + Send + Sync + 'static,
{
    let judge = source.judge();
    let draw = move |random: &mut Random| {
        let inertia = body(random);
        source.system(&inertia, Box::new(move |h, _| make(h, inertia)))
    };
    vec![Model { judge, draw: Box::new(draw) }]
}

/// A model of tops, with a weight too.
fn tops<F>(text: (&'static str, &'static str), make: F) -> Vec<Model>
where
    F: Fn(f64, [f64; 3], f64) -> Option<Made> + Copy + Send + Sync + 'static,
{
    let source = Source { homogeneous: false, ..Source::new(text) };
    let judge = source.judge();
    let draw = move |random: &mut Random| {
        let (i, weight) = (inertias(random).map(|i| i as f64 / 32.0), random.between(0.1, 4.0));
        source.system(&[i[0], i[1], i[2], weight], Box::new(move |h, _| make(h, i, weight)))
    };
    vec![Model { judge, draw: Box::new(draw) }]
}

/// Powers of coordinates.
type Monomial = Vec<(usize, u32)>;

/// The terms of S of a free body.
fn terms(series: &GeneratingSeries, dim: usize, h: f64, symbols: &[f64]) -> Vec<(Monomial, f64)> {
    let exact = |value: f64| Rational::from_float(value).expect("finite");
    let power =
        |base: &Rational, power: usize| (0..power).fold(exact(1.0), |product, _| product * base);
    let step = exact(h);
    let symbols: Vec<Rational> = symbols.iter().map(|&symbol| exact(symbol)).collect();
    let mut terms: Vec<(Monomial, Rational)> = Vec::new();
    for k in 1..=series.truncation() {
        let step = power(&step, k);
        for (factors, c) in series.order(k).factors() {
            let mut value = c * &step;
            let mut momenta = Vec::new();
            for (variable, times) in factors {
                match (variable as usize).checked_sub(dim) {
                    Some(symbol) => value *= power(&symbols[symbol], times as usize),
                    None => momenta.push((variable as usize, times)),
                }
            }
            match terms.iter_mut().find(|term| term.0 == momenta) {
                Some(term) => term.1 += value,
                None => terms.push((momenta, value)),
            }
        }
    }
    terms.into_iter().map(|(monomial, value)| (monomial, double(&value))).collect()
}

/// An S that is no truncated series: one with every coefficient changed at random by the same share at most.
fn any_function() -> Vec<Model> {
    let source = Source::new(fixed::TEXT);
    let problem = &source.problem;
    let limit = TermLimit::default();
    let series = derive(&problem.algebra, problem.chart, problem.generated(), 7, limit);
    let series = Arc::new(series.expect("a series"));
    let judge = source.judge();
    let draw = move |random: &mut Random| {
        let inertia = body(random);
        let (series, algebra) = (Arc::clone(&series), source.problem.algebra.clone());
        let symbols = source.symbols(&inertia);
        let steps = move |h: f64, random: &mut Random| {
            let share = 10_f64.powf(random.between(-9.0, -0.5));
            let mut change = || 1.0 + share * random.between(-1.0, 1.0);
            let terms: Vec<_> = terms(&series, 3, h, &symbols)
                .into_iter()
                .map(|(m, c)| (c * change(), m))
                .collect();
            // The judge's S is h times a Hamiltonian.
            let exact = |value: f64| Rational::from_float(value).expect("finite");
            let all = terms.iter().map(|(c, monomial)| {
                let factors = monomial.iter().map(|&(i, power)| (i as u32, power));
                (factors.collect(), exact(*c) / exact(h))
            });
            let energy = Polynomial::from_factors(3, all);
            let series = derive(&algebra, Chart::Exponential, &energy, 1, limit).ok()?;
            let judge = Judge::new(&algebra, &series).ok()?;
            let steps = PolynomialFunction::new(SO3::<f64>::new(), Exponential, terms).ok()?;
            Some(Made { steps: Box::new(Runner::new(steps)), judge: Some(judge) })
        };
        source.system(&inertia, Box::new(steps))
    };
    vec![Model { judge, draw: Box::new(draw) }]
}

/// Makes the models of a family.
type Models = fn() -> Vec<Model>;

/// Steps of a body.
macro_rules! of_bodies {
    ($module:ident, $must:expr, |$steps:ident| $run:expr) => {
        || {
            let source = Source { must: $must, ..Source::new($module::TEXT) };
            bodies(source, |h, inertia| {
                let $steps = $module::System::<f64>::new(h, inertia).ok()?;
                Some(Made::series($run))
            })
        }
    };
}

/// All families whose names contain `only`.
pub fn families(only: &str) -> Vec<Family> {
    let all: [(&str, f64, usize, Models); 9] = [
        (
            "generated-fixed-7",
            30.0,
            256,
            of_bodies!(fixed, true, |steps| Runner::new(steps).in_lanes()),
        ),
        ("generated-promise-7", 30.0, 16, of_bodies!(fixed, true, |steps| Runner::new(steps))),
        ("so3-any-7", 30.0, 8, any_function),
        (
            "generated-fixed-point-7",
            30.0,
            128,
            of_bodies!(fixed, false, |steps| Runner::new(MatrixFree(steps))),
        ),
        (
            "generated-comoving-9",
            30.0,
            256,
            of_bodies!(comoving, true, |steps| Runner::new(steps).in_lanes()),
        ),
        (
            "generated-cayley-5",
            30.0,
            128,
            of_bodies!(half_turn, false, |steps| Runner::new(steps).in_lanes()),
        ),
        ("generated-top-5", 1.0, 64, || {
            tops(top::TEXT, |h, i, weight| {
                let steps = top::System::<f64>::new(h, i, weight).ok()?;
                Some(Made::series(Runner::new(steps).in_lanes()))
            })
        }),
        ("generated-top-7", 1.0, 32, || {
            tops(long_top::TEXT, |h, i, weight| {
                let steps = long_top::System::<f64>::new(h, i, weight).ok()?;
                Some(Made::series(Runner::new(steps)))
            })
        }),
        ("generated-manakov-5", 30.0, 32, || {
            let source = Source::new(manakov::TEXT);
            let judge = source.judge();
            let draw = move |_: &mut Random| {
                let steps = |h: f64, _: &mut Random| {
                    Some(Made::series(Runner::new(manakov::System::<f64>::new(h).ok()?)))
                };
                source.system(&[], Box::new(steps))
            };
            vec![Model { judge, draw: Box::new(draw) }]
        }),
    ];
    let chosen = all.into_iter().filter(|family| family.0.contains(only));
    let family = |(name, decades, weight, models): (&str, f64, usize, Models)| Family {
        name: name.to_owned(),
        models: models(),
        decades,
        weight,
        promise: name.contains("promise"),
        instance: None,
    };
    chosen.map(family).collect()
}
