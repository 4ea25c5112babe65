//! The families there are.

use std::f64::consts::{PI, TAU};

use coadjoint_codegen::lie::{Chart, LieAlgebra};

use super::family::{Energy, Family, Recipe};
use super::runtime::{
    Cayley, Exponential, MatrixFree, Runner, SE3, SO3, Steps, Terms, polynomial,
};
use crate::bridge::matrix_group;

type Made = Box<dyn Steps>;

fn table(algebra: &LieAlgebra, terms: Terms) -> Made {
    let group = matrix_group(algebra).expect("a group");
    Box::new(Runner::new(polynomial(group, Exponential, terms)))
}

fn table_cayley(algebra: &LieAlgebra, terms: Terms) -> Made {
    let group = matrix_group(algebra).expect("a group").into_cayley().expect("a Cayley map");
    Box::new(Runner::new(polynomial(group, Cayley, terms)))
}

/// All families whose names contain `only`.
#[must_use]
pub fn families(only: &str) -> Vec<Family> {
    let mut families = Vec::new();
    let (exp, cayley) = (Chart::Exponential, Chart::Cayley);
    let mut add = |recipe: Recipe<'_>, steps: fn(&LieAlgebra, Terms) -> Made| {
        if recipe.name.contains(only) {
            // The same systems whatever else is tried.
            let seed = recipe.name.bytes().fold(7_u64, |seed, b| seed.wrapping_mul(31) + u64::from(b));
            families.push(recipe.family(seed, steps));
        }
    };
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(
        Recipe {
            name: "so3-exp",
            energy: Energy::Body,
            truncations: &[3, 5, 7, 9, 11, 13],
            models: 4,
            must_accept: true,
            ..base
        },
        |_, terms| Box::new(Runner::new(polynomial(SO3::<f64>::new(), Exponential, terms)).compensated()),
    );
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(
        Recipe {
            name: "so3-exp-tensor",
            energy: Energy::Tensor,
            truncations: &[5, 7],
            ..base
        },
        |_, terms| Box::new(Runner::new(polynomial(SO3::<f64>::new(), Exponential, terms)).compensated()),
    );
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(
        Recipe { name: "so3-exp-fixed-point", energy: Energy::Body, truncations: &[3, 7], ..base },
        |_, terms| {
            Box::new(Runner::new(MatrixFree(polynomial(SO3::<f64>::new(), Exponential, terms))))
        },
    );
    let base = Recipe { chart: cayley, ..Recipe::default() };
    add(
        Recipe {
            name: "so3-cayley",
            energy: Energy::Body,
            truncations: &[1, 3, 5, 7],
            ..base
        },
        |_, terms| Box::new(Runner::new(polynomial(SO3::<f64>::new(), Cayley, terms)).compensated()),
    );
    let base = Recipe { chart: exp, decades: 1.0, ..Recipe::default() };
    add(
        Recipe {
            name: "se3-exp-top",
            group: "SE3",
            energy: Energy::Top,
            truncations: &[3, 5, 7],
            ..base
        },
        |_, terms| Box::new(Runner::new(polynomial(SE3::<f64>::new(), Exponential, terms)).compensated()),
    );
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(
        Recipe { name: "se3-exp-fluid", group: "SE3", truncations: &[3, 5], ..base },
        |_, terms| Box::new(Runner::new(polynomial(SE3::<f64>::new(), Exponential, terms))),
    );
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(Recipe { name: "so4-table", group: "SO4", truncations: &[3, 5], ..base }, table);
    let base = Recipe { chart: exp, ..Recipe::default() };
    add(Recipe { name: "su3-table", group: "SU3", truncations: &[3], ..base }, table);
    let base = Recipe { chart: cayley, ..Recipe::default() };
    add(Recipe { name: "so4-table-cayley", group: "SO4", truncations: &[3], ..base }, table_cayley);
    let _ = (PI, TAU);
    families
}
