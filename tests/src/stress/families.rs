//! The families there are.

use coadjoint_codegen::lie::{Chart, LieAlgebra};

use super::family::{Energy, Family, Recipe};
use super::runtime::{
    Cayley, Exponential, Heisenberg, MatrixFree, Power, Runner, SE2, SE3, SO3, SU2, SU3, Steps,
    Terms, polynomial,
};
use super::{generated, kernels};
use crate::bridge::matrix_group;

type Made = Box<dyn Steps>;
type Maker = fn(&LieAlgebra, Terms) -> Made;

fn table(algebra: &LieAlgebra, terms: Terms) -> Made {
    let group = matrix_group(algebra).expect("a group");
    Box::new(Runner::new(polynomial(group, Exponential, terms)))
}

fn table_cayley(algebra: &LieAlgebra, terms: Terms) -> Made {
    let group = matrix_group(algebra).expect("a group").into_cayley().expect("a Cayley map");
    Box::new(Runner::new(polynomial(group, Cayley, terms)))
}

/// The steps of a group that the compiler knows.
macro_rules! known {
    ($group:expr, $chart:expr $(, $with:ident)*) => {
        |_: &LieAlgebra, terms: Terms| -> Made {
            Box::new(Runner::new(polynomial($group, $chart, terms))$(.$with())*)
        }
    };
}

/// Families of polynomials on groups that the compiler knows.
fn closed_forms() -> Vec<(Recipe<'static>, Maker)> {
    let base = Recipe::default;
    let cayley = || Recipe { chart: Chart::Cayley, ..Recipe::default() };
    let body = Energy::Body;
    let promise = || Recipe { must_accept: true, promise: true, energy: body, ..base() };
    vec![
        (
            Recipe {
                name: "so3-exp",
                energy: body,
                truncations: &[3, 5, 7, 9, 11, 13],
                models: 4,
                must_accept: true,
                weight: 256,
                ..base()
            },
            known!(SO3::<f64>::new(), Exponential) as Maker,
        ),
        (
            Recipe {
                name: "so3-exp-long",
                energy: body,
                truncations: &[15, 17],
                models: 1,
                must_accept: true,
                weight: 32,
                ..base()
            },
            known!(SO3::<f64>::new(), Exponential),
        ),
        (
            Recipe {
                name: "so3-promise",
                truncations: &[5, 7, 9],
                models: 8,
                weight: 256,
                ..promise()
            },
            known!(SO3::<f64>::new(), Exponential),
        ),
        (
            Recipe { name: "so3-promise-long", truncations: &[11, 13], models: 4, ..promise() },
            known!(SO3::<f64>::new(), Exponential),
        ),
        (
            Recipe {
                name: "so3-exp-tensor",
                energy: Energy::Tensor,
                truncations: &[5, 7],
                ..base()
            },
            known!(SO3::<f64>::new(), Exponential),
        ),
        (
            Recipe { name: "so3-exp-fixed-point", energy: body, truncations: &[3, 7], ..base() },
            |_, terms| {
                Box::new(Runner::new(MatrixFree(polynomial(SO3::<f64>::new(), Exponential, terms))))
            },
        ),
        (
            Recipe { name: "so3-cayley", energy: body, truncations: &[1, 3, 5, 7], ..cayley() },
            known!(SO3::<f64>::new(), Cayley),
        ),
        (
            Recipe {
                name: "so3-exp-f32",
                energy: body,
                truncations: &[3, 5, 7],
                single: true,
                decades: 1.0,
                ..base()
            },
            known!(SO3::<f32>::new(), Exponential),
        ),
        (
            Recipe {
                name: "su2-exp-f32",
                group: "SU2",
                energy: body,
                single: true,
                decades: 1.0,
                ..base()
            },
            known!(SU2::<f32>::new(), Exponential),
        ),
        (
            Recipe {
                name: "se3-exp-f32",
                group: "SE3",
                energy: Energy::Top,
                truncations: &[3],
                single: true,
                decades: 1.0,
                weight: 32,
                ..base()
            },
            known!(SE3::<f32>::new(), Exponential),
        ),
        (
            Recipe { name: "su2-exp", group: "SU2", energy: body, truncations: &[3, 7], ..base() },
            known!(SU2::<f64>::new(), Exponential),
        ),
        (
            Recipe {
                name: "su2-cayley",
                group: "SU2",
                energy: body,
                truncations: &[3, 5],
                ..cayley()
            },
            known!(SU2::<f64>::new(), Cayley),
        ),
        (
            Recipe { name: "se2-exp", group: "SE2", truncations: &[3, 5, 7], ..base() },
            known!(SE2::<f64>::new(), Exponential),
        ),
        (
            Recipe { name: "se2-cayley", group: "SE2", truncations: &[3, 5], ..cayley() },
            known!(SE2::<f64>::new(), Cayley),
        ),
        (
            Recipe {
                name: "se3-exp-top",
                weight: 32,
                group: "SE3",
                energy: Energy::Top,
                truncations: &[3, 5, 7],
                decades: 1.0,
                ..base()
            },
            known!(SE3::<f64>::new(), Exponential),
        ),
        (
            Recipe { name: "se3-exp-fluid", weight: 32, group: "SE3", ..base() },
            known!(SE3::<f64>::new(), Exponential),
        ),
        (
            Recipe { name: "se3-cayley", weight: 32, group: "SE3", truncations: &[3], ..cayley() },
            known!(SE3::<f64>::new(), Cayley),
        ),
        (
            Recipe { name: "heisenberg", group: "Heisenberg", truncations: &[3, 5], ..base() },
            known!(Heisenberg::<f64>::new(), Exponential),
        ),
        (
            Recipe {
                name: "so3-power",
                weight: 32,
                group: "SO3^2",
                truncations: &[3, 5],
                ..base()
            },
            known!(Power::<SO3, 2, 6>::default(), Exponential),
        ),
        (
            Recipe { name: "su3", weight: 4, group: "SU3", truncations: &[3], ..base() },
            known!(SU3::<f64>::new(), Exponential),
        ),
    ]
}

/// Families of polynomials on groups that are tables at run time.
fn tables() -> Vec<(Recipe<'static>, Maker)> {
    let base = Recipe::default;
    let cayley = || Recipe { chart: Chart::Cayley, ..Recipe::default() };
    vec![
        (
            Recipe {
                name: "so3-table",
                energy: Energy::Body,
                truncations: &[5, 9],
                must_accept: true,
                weight: 32,
                ..base()
            },
            table as Maker,
        ),
        (Recipe { name: "so4-table", weight: 4, group: "SO4", ..base() }, table),
        (
            Recipe {
                name: "so5-table",
                group: "SO5",
                truncations: &[3],
                models: 1,
                weight: 1,
                ..base()
            },
            table,
        ),
        (
            Recipe {
                name: "su4-table",
                group: "SU4",
                truncations: &[3],
                models: 1,
                weight: 1,
                ..base()
            },
            table,
        ),
        (
            Recipe {
                name: "so4-table-cayley",
                weight: 16,
                group: "SO4",
                truncations: &[3],
                ..cayley()
            },
            table_cayley,
        ),
        (
            Recipe {
                name: "su3-table",
                weight: 1,
                group: "SU3",
                truncations: &[3],
                models: 1,
                ..base()
            },
            table,
        ),
        (Recipe { name: "sl2-table", weight: 32, group: "SL2", ..base() }, table),
        (
            Recipe {
                name: "sl2-table-cayley",
                weight: 32,
                group: "SL2",
                truncations: &[3],
                ..cayley()
            },
            table_cayley,
        ),
        (Recipe { name: "u2-table", weight: 32, group: "U2", ..base() }, table),
        (Recipe { name: "aff1-table", weight: 32, group: "Aff1", ..base() }, table),
    ]
}

/// All families whose names contain `only`.
#[must_use]
pub fn families(only: &str) -> Vec<Family> {
    let mut families = Vec::new();
    for (recipe, steps) in closed_forms().into_iter().chain(tables()) {
        if recipe.name.contains(only) {
            // The same systems whatever else is tried.
            let seed =
                recipe.name.bytes().fold(7_u64, |seed, b| seed.wrapping_mul(31) + u64::from(b));
            families.push(recipe.family(seed, steps));
        }
    }
    families.extend(generated::families(only));
    families.extend(kernels::families(only));
    families
}
