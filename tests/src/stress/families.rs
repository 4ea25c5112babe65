//! The families there are.

use coadjoint::generating::PolynomialFunction;
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::lie::{Chart, LieAlgebra};
use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;

use super::family::Distribution::{Body, Squares, Tensor, Top};
use super::family::{Family, Instance, Maker, Recipe};
use super::random::Random;
use super::runtime::{
    Cayley, Exponential, Heisenberg, MatrixFree, Power, Runner, SE2, SE3, SO3, SU2, SU3, Terms,
    polynomial,
};
use super::{collocation, generated, instance, kernels};
use crate::bridge::matrix_group;

fn table(algebra: &LieAlgebra, terms: Terms, _: f64, _: &mut Random) -> Option<Instance> {
    let group = matrix_group(algebra).expect("a group");
    Some(Instance::series(Runner::new(polynomial(group, Exponential, terms))))
}

fn table_cayley(algebra: &LieAlgebra, terms: Terms, _: f64, _: &mut Random) -> Option<Instance> {
    let group = matrix_group(algebra).expect("a group").into_cayley().expect("a Cayley map");
    Some(Instance::series(Runner::new(polynomial(group, Cayley, terms))))
}

fn fixed_point(_: &LieAlgebra, terms: Terms, _: f64, _: &mut Random) -> Option<Instance> {
    let steps = MatrixFree(polynomial(SO3::<f64>::new(), Exponential, terms));
    Some(Instance::series(Runner::new(steps)))
}

/// An S that is no truncated series: one with every coefficient changed at random by the same share at most.
fn any_function(
    algebra: &LieAlgebra,
    terms: Terms,
    h: f64,
    random: &mut Random,
) -> Option<Instance> {
    let share = 10_f64.powf(random.between(-9.0, -0.5));
    let change = |(_, c, monomial)| (c * (1.0 + share * random.between(-1.0, 1.0)), monomial);
    let terms: Vec<_> = terms.into_iter().map(change).collect();
    // The judge's S is h times a Hamiltonian.
    let exact = |value: f64| Rational::from_float(value).expect("finite");
    let all = terms.iter().map(|(c, monomial): &(f64, Vec<(usize, u32)>)| {
        let factors = monomial.iter().map(|&(i, power)| (i as u32, power));
        (factors.collect(), exact(*c) / exact(h))
    });
    let energy = Polynomial::from_factors(algebra.dim(), all);
    let series = derive(algebra, Chart::Exponential, &energy, 1, TermLimit::default()).ok()?;
    let judge = Some(Judge::new(algebra, &series).ok()?);
    let steps = PolynomialFunction::new(SO3::<f64>::new(), Exponential, terms).ok()?;
    Some(Instance { steps: Box::new(Runner::new(steps)), judge })
}

/// The steps of a group that the compiler knows.
macro_rules! known {
    ($group:expr, $chart:expr) => {
        |_, terms, _, _| Some(Instance::series(Runner::new(polynomial($group, $chart, terms))))
    };
}

/// Families of polynomials: on groups that the compiler knows, and on groups that are tables at run time.
fn polynomials() -> Vec<(Recipe, Maker)> {
    let of = Recipe::new;
    let so3: Maker = known!(SO3::<f64>::new(), Exponential);
    vec![
        (of("so3-exp", "SO3", Body, &[3, 5, 7, 9, 11, 13]).models(4).weight(256).must(), so3),
        (of("so3-exp-long", "SO3", Body, &[15, 17]).models(1).weight(32).must(), so3),
        (of("so3-promise", "SO3", Body, &[5, 7, 9]).models(8).weight(256).promise(), so3),
        (of("so3-promise-long", "SO3", Body, &[11, 13]).models(4).promise(), so3),
        (of("so3-exp-tensor", "SO3", Tensor, &[5, 7]), so3),
        (of("so3-any", "SO3", Body, &[7]).weight(8), any_function),
        (of("so3-exp-fixed-point", "SO3", Body, &[3, 7]), fixed_point),
        (of("so3-cayley", "SO3", Body, &[1, 3, 5, 7]).cayley(), known!(SO3::<f64>::new(), Cayley)),
        (
            of("so3-exp-f32", "SO3", Body, &[3, 5, 7]).single(),
            known!(SO3::<f32>::new(), Exponential),
        ),
        (of("su2-exp-f32", "SU2", Body, &[3, 5]).single(), known!(SU2::<f32>::new(), Exponential)),
        (
            of("se3-exp-f32", "SE3", Top, &[3]).single().weight(32),
            known!(SE3::<f32>::new(), Exponential),
        ),
        (of("su2-exp", "SU2", Body, &[3, 7]), known!(SU2::<f64>::new(), Exponential)),
        (of("su2-cayley", "SU2", Body, &[3, 5]).cayley(), known!(SU2::<f64>::new(), Cayley)),
        (of("se2-exp", "SE2", Squares, &[3, 5, 7]), known!(SE2::<f64>::new(), Exponential)),
        (of("se2-cayley", "SE2", Squares, &[3, 5]).cayley(), known!(SE2::<f64>::new(), Cayley)),
        (
            of("se3-exp-top", "SE3", Top, &[3, 5, 7]).weight(32).slow(),
            known!(SE3::<f64>::new(), Exponential),
        ),
        (
            of("se3-exp-fluid", "SE3", Squares, &[3, 5]).weight(32),
            known!(SE3::<f64>::new(), Exponential),
        ),
        (
            of("se3-cayley", "SE3", Squares, &[3]).weight(32).cayley(),
            known!(SE3::<f64>::new(), Cayley),
        ),
        (
            of("heisenberg", "Heisenberg", Squares, &[3, 5]),
            known!(Heisenberg::<f64>::new(), Exponential),
        ),
        (
            of("so3-power", "SO3^2", Squares, &[3, 5]).weight(32),
            known!(Power::<SO3, 2, 6>::default(), Exponential),
        ),
        (of("su3", "SU3", Squares, &[3]).weight(4), known!(SU3::<f64>::new(), Exponential)),
        (of("so3-table", "SO3", Body, &[5, 9]).weight(32).must(), table),
        (of("so4-table", "SO4", Squares, &[3, 5]).weight(4), table),
        (of("so5-table", "SO5", Squares, &[3]).models(1).weight(1), table),
        (of("su4-table", "SU4", Squares, &[3]).models(1).weight(1), table),
        (of("so4-table-cayley", "SO4", Squares, &[3]).weight(16).cayley(), table_cayley),
        (of("su3-table", "SU3", Squares, &[3]).models(1).weight(1), table),
        (of("sl2-table", "SL2", Squares, &[3, 5]).weight(32), table),
        (of("sl2-table-cayley", "SL2", Squares, &[3]).weight(32).cayley(), table_cayley),
        (of("u2-table", "U2", Squares, &[3, 5]).weight(32), table),
        (of("aff1-table", "Aff1", Squares, &[3, 5]).weight(32), table),
    ]
}

pub fn families(only: &str) -> Vec<Family> {
    let mut families = Vec::new();
    for (recipe, steps) in polynomials() {
        if recipe.name.contains(only) {
            // The same systems whatever else is tried.
            let seed =
                recipe.name.bytes().fold(7_u64, |seed, b| seed.wrapping_mul(31) + u64::from(b));
            let models = recipe.drawn(seed, steps);
            families.push(instance::family(recipe.name.to_owned(), recipe.weight, models));
        }
    }
    families.extend(generated::families(only));
    families.extend(kernels::families(only));
    families.extend(collocation::families(only));
    families
}
