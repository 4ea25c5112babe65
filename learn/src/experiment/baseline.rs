//! The non-symmetric baseline of the paper, given every model the symmetric side has.

use coadjoint::{Cayley, SO3};

use super::networks::Training;
use super::report::Table;
use super::task::{Task, row};
use crate::data::PairRows;
use crate::error::LearnError;
use crate::evaluate::evaluate_with;
use crate::function::MomentumFunction;
use crate::hybrid::fit_hybrid_to_gradients;
use crate::network::fit_network_to_gradients;
use crate::polynomial::fit_gradients;
use crate::type_two::{TypeTwo, type_two_data};

/// Fills in the rows of type II.
pub(super) fn rows(
    task: &Task<'_, SO3>,
    train: &PairRows<SO3>,
    training: &Training<'_>,
    paper: f64,
    say: &mut dyn FnMut(&str),
    table: &mut Table,
) -> Result<(), LearnError> {
    say("  non-symmetric baseline");
    let (points, gradients) = type_two_data::<SO3, Cayley>(task.group, train)?;
    let mut enter = |name: &str, function: &dyn MomentumFunction, paper: Option<f64>| {
        let map = TypeTwo { function };
        let figures = evaluate_with(task.group, &task.test_pairs, |phase| {
            map.advance::<SO3, Cayley>(task.group, phase)
        });
        table.push(row(format!("type II, not symmetric: {name}"), &figures, paper));
    };
    let options = training.options("baseline");
    let (network, _) = fit_network_to_gradients(&points, &gradients, None, &options, &mut |_| {})?;
    enter("network", &network, Some(paper));
    let options = training.small("baseline-hybrid");
    let (hybrid, _) = fit_hybrid_to_gradients(&points, &gradients, 2, &options, &mut |_| {})?;
    enter("hybrid", &hybrid, None);
    for degree in [2, 4, 6] {
        // Six coordinates: degree 6 has 923 coefficients.
        if let Ok(model) = fit_gradients(&points, &gradients, degree, 0.0) {
            enter(&format!("polynomial degree {degree}"), &model, None);
        }
    }
    Ok(())
}
