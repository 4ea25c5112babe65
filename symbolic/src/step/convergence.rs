//! How well the series of a step converges at a momentum.

use std::array::from_fn;
use std::collections::BTreeMap;

use coadjoint_program::Evaluation;
use coadjoint_program::fold::FoldError;
use coadjoint_program::limits::{LARGEST_RATIO, NEGLIGIBLE, RATE_OF_HALF_TURN};

use super::part;
use super::product::{Part, Product};
use super::solving::{Scheme, hessian_of, inputs, square_of_rate};
use super::vector::Matrix;
use crate::graph::{Graph, Id, Program};
use crate::integrator::{FoldTable, Integrator};
use crate::lie::LieAlgebra;

/// Programs of the ratios by which the steps of a series are judged, at a momentum.
#[derive(Debug)]
pub struct Convergence {
    /// μ ↦ the ratio of the last two terms of ∂S.
    terms: Program,
    /// μ ↦ the ratio that the rate at which motions part stands for, where the truncation limits that: see
    /// [`Integrator::largest_rate`].
    rate: Option<Program>,
}

/// The coefficients of [`Convergence`] for one step size and one set of parameters.
#[derive(Clone, Debug)]
pub struct Converging {
    slots: Vec<f64>,
    /// The |μ| up to which the ratio of the last two terms is at most that asked for.
    quiet: f64,
}

impl Convergence {
    /// The programs for an integrator. Of a group without programs the terms alone are looked at.
    pub fn new(integrator: &Integrator) -> Self {
        let rate = integrator.largest_rate.and_then(|largest| rate(integrator, largest));
        Self { terms: terms(integrator), rate }
    }

    /// Folds for a step size and the values of the parameters that are kept; terms are not looked at where their ratio is known
    /// to be at most `quiet`.
    ///
    /// # Errors
    /// [`FoldError`] where the step size is zero, or a number is not finite.
    pub fn fold(
        integrator: &Integrator,
        step: f64,
        parameters: &[f64],
        quiet: f64,
    ) -> Result<Converging, FoldError> {
        let symbols = integrator.problem.symbols_at(parameters);
        let (slots, quiet) = integrator.fold_table().fold_rows(step, &symbols, quiet)?;
        Ok(Converging { slots, quiet })
    }

    /// The largest ratio at L momenta side by side; 0 where the terms are known to be small, or are no finite numbers: there is
    /// no step then.
    pub fn ratio<const L: usize>(&self, folded: &Converging, momenta: &[[f64; L]]) -> f64 {
        let size = |lane: usize| momenta.iter().map(|mu| mu[lane] * mu[lane]).sum::<f64>().sqrt();
        let loud: [bool; L] = from_fn(|lane| size(lane) > folded.quiet);
        let mut largest = 0.0;
        let mut raise = |program: &Program, lanes: [bool; L]| {
            let mut evaluation = Evaluation::<L>::new(program, &folded.slots);
            for ratios in evaluation.run(|i| momenta[i]).results() {
                let own =
                    ratios.into_iter().zip(lanes).filter(|(ratio, own)| *own && ratio.is_finite());
                largest = own.fold(largest, |largest, (ratio, _)| f64::max(largest, ratio));
            }
        };
        if loud.contains(&true) {
            raise(&self.terms, loud);
        }
        self.rate.iter().for_each(|rate| raise(rate, [true; L]));
        largest
    }
}

/// μ ↦ the ratio of S_K and S_{K−2}: of the sums of the absolute values of all monomials of their gradients, the largest of
/// those of the direct factors of the group.
fn terms(integrator: &Integrator) -> Program {
    let (n, truncation) = (integrator.problem.algebra.dim(), integrator.problem.truncation);
    let graph = Graph::new();
    let sizes: Vec<Id> = inputs(&graph, 0, n).iter().map(|&mu| graph.abs(mu)).collect();
    let mut sums: BTreeMap<u32, [Id; 2]> = BTreeMap::new();
    let first = FoldTable::radius_at(integrator) + 1;
    for (number, (order, base)) in integrator.coefficients.last_orders(truncation).enumerate() {
        let value = graph.abs(graph.slot(first + number));
        let monomial = &integrator.coefficients.monomials()[base];
        for (at, &(coordinate, power)) in monomial.iter().enumerate() {
            let mut product = graph.constant(1.0);
            for (other, &(i, power)) in monomial.iter().enumerate() {
                for _ in u32::from(other == at)..power {
                    product = graph.mul(product, sizes[i as usize]);
                }
            }
            let weight = graph.mul(graph.constant(f64::from(power)), value);
            let factor = integrator.factors()[coordinate as usize];
            let sums = sums.entry(factor).or_insert_with(|| [graph.zero(); 2]);
            let sum = &mut sums[usize::from(order != truncation)];
            *sum = graph.times_plus(weight, product, *sum);
        }
    }
    let negligible = graph.constant(NEGLIGIBLE * f64::EPSILON);
    let ratio = |&[last, before]: &[Id; 2]| {
        // Nothing against nothing is no ratio.
        let ratio = graph.select(before, graph.zero(), graph.zero(), graph.div(last, before));
        graph.select(last, negligible, graph.zero(), ratio)
    };
    let ratios: Vec<Id> = sums.values().map(ratio).collect();
    graph.finish(n, &ratios)
}

/// μ ↦ the ratio that the rate at x = ∂S(μ) stands for: [`LARGEST_RATIO`] where it is the largest one allowed. `None` for groups
/// without programs.
fn rate(integrator: &Integrator, largest_rate: f64) -> Option<Program> {
    let (algebra, scheme) = (&integrator.problem.algebra, Scheme::of(integrator));
    let part = |factor: &LieAlgebra| part(factor, integrator.problem.chart, scheme).ok();
    let group = Product(algebra.factors().iter().map(part).collect::<Option<_>>()?);
    let n = algebra.dim();
    let graph = Graph::new();
    let mu = inputs(&graph, 0, n);
    let x = graph.call(&integrator.gradient, &mu);
    let square = match &integrator.hessian {
        Some(hessian) => {
            let (p, derivative) = group.pull_back_with_derivative(&graph, &x, &mu);
            let (_, hessian) = hessian_of(&graph, hessian, &p);
            let product = derivative.times_plus(&graph, &hessian, &Matrix::zeros(&graph, n, n));
            square_of_rate(&graph, algebra, &x, &product)
        }
        None => {
            let half_turn = graph.constant(RATE_OF_HALF_TURN * RATE_OF_HALF_TURN);
            graph.mul(half_turn, group.extent(&graph, &x))
        }
    };
    let ratio = graph.constant(LARGEST_RATIO / largest_rate);
    Some(graph.finish(n, &[graph.mul(graph.sqrt(square), ratio)]))
}
