//! The derivatives of a step: those of the equations that its solution satisfies, and of the motions that it makes.
//!
//! A tangent to a state (g, μ) is (ξ, ν), ξ = g⁻¹δg in 𝔤 and ν = δμ. The solution z of the equations F(g, μ, z) = 0 of a flow moves with the
//! state by ∂F/∂z δz = −∂F/∂(g, μ) (ξ, ν), whatever has found it.

use coadjoint_program::fold::FoldError;
use coadjoint_program::{Argument, Kernel};

use super::product::{Part, Product};
use super::programs::equation_of_series;
use super::solving::{Scheme, inputs};
use super::tables::structure_of;
use super::{Elements, Moving, Origin, Step, StepError, collocation};
use crate::graph::{Graph, Program};
use crate::lie::Chart;

/// A program with its derivatives.
#[derive(Clone, Debug)]
pub struct Differentiated {
    /// The program.
    pub value: Program,
    /// Its inputs, and the changes of those after the first ones ↦ the changes of its outputs.
    pub by_inputs: Program,
    /// Its inputs, and the changes of all folded coefficients ↦ the changes of its outputs.
    pub by_slots: Program,
}

impl Differentiated {
    /// With the derivatives in all inputs after the first `fixed` ones.
    fn new(value: Program, fixed: usize) -> Self {
        let inputs: Vec<Argument> = (fixed..value.inputs()).map(Argument::Input).collect();
        let slots: Vec<Argument> = (0..value.slots()).map(Argument::Slot).collect();
        let (by_inputs, by_slots) = (value.push_forward(&inputs), value.push_forward(&slots));
        Self { value, by_inputs, by_slots }
    }
}

/// The derivatives of a step. n is the dimension, m how many numbers make a group element, u how many are solved for.
#[derive(Debug)]
pub struct Tangent {
    /// g (m), y (n), μ (n), z (u) ↦ F of a flow at g·τ(y) (u), its increment x (n), the momentum that x moves (n); differentiated in y, at
    /// which y = 0, in μ and in z.
    pub equation: Differentiated,
    /// A flow of the step as a step of its own, without kicks.
    pub flow: Kernel,
    /// True if F reads the group element.
    pub reads: bool,
    /// g (m), y (n), μ (n) ↦ the momentum after a kick at g·τ(y) (n), where there are kicks.
    pub kick: Option<Differentiated>,
    /// μ ↦ y, a motion exp(y) after each flow: those of a comoving frame.
    pub frame: Vec<Differentiated>,
    /// x, w ↦ Ad\*_{τ(x)⁻¹} w, (d^R τ_x)ᵀ w.
    pub motion: Program,
    /// As `motion`, by the exponential: that of a comoving frame, where there is one.
    pub frame_motion: Option<Program>,
    /// (i, j, k, cᵢⱼᵏ) of all structure constants that are not 0.
    pub structure: Vec<(usize, usize, usize, f64)>,
}

/// x, w ↦ Ad\*_{τ(x)⁻¹} w, (d^R τ_x)ᵀ w.
fn motion(group: &Product) -> Program {
    let (n, graph) = (group.dim(), Graph::new());
    let [x, w] = [0, n].map(|from| inputs(&graph, from, n));
    let anywhere = vec![graph.zero(); group.element()];
    let mut outputs = group.transport(&graph, &anywhere, &x, &w).mu;
    outputs.extend(group.pull_back(&graph, &x, &w));
    graph.finish(2 * n, &outputs)
}

/// g, y, μ ↦ a kick at g·τ(y).
fn kicked(group: &Product, kick: &Program) -> Program {
    let (n, m, graph) = (group.dim(), group.element(), Graph::new());
    let [g, y, mu] = [(0, m), (m, n), (m + n, n)].map(|(from, count)| inputs(&graph, from, count));
    let moved = group.transport(&graph, &g, &y, &mu).g;
    graph.finish(m + n + n, &graph.call(kick, &[moved, mu].concat()))
}

impl Tangent {
    /// Of the step of this origin.
    ///
    /// # Errors
    /// [`StepError`] where the group of a comoving frame has no formulas.
    pub fn new(step: &Step, origin: &Origin) -> Result<Self, StepError> {
        let (group, algebra) = (&step.group, origin.facts().algebra);
        let (value, reads) = match origin {
            Origin::Series(integrator) => (equation_of_series(integrator, group), false),
            Origin::Collocation(smooth) => collocation::equation(smooth, group),
        };
        let frame = origin.series().map_or(&[][..], |integrator| &integrator.frame);
        let frame_motion = || {
            let scheme = Scheme::FixedPoint;
            let parts = Elements::ByFactors.parts(algebra, Chart::Exponential, scheme)?;
            Ok::<_, StepError>(motion(&Product(parts)))
        };
        let m = group.element();
        let kick = step.kernel.kick().map(|kick| Differentiated::new(kicked(group, kick), m));
        Ok(Self {
            equation: Differentiated::new(value, m),
            flow: Kernel::new((*step.kernel).clone())?,
            reads,
            kick,
            frame: frame.iter().map(|own| Differentiated::new(own.clone(), 0)).collect(),
            motion: motion(group),
            structure: structure_of(algebra),
            frame_motion: (!frame.is_empty()).then(frame_motion).transpose()?,
        })
    }
}

impl Step {
    /// The derivatives of the coefficients of a step along a change of the parameters that are kept, in the order of
    /// [`Step::fold`].
    ///
    /// # Errors
    /// As [`Step::fold`].
    pub fn slope(
        &self,
        step: f64,
        parameters: &[f64],
        change: &[f64],
    ) -> Result<Vec<f64>, FoldError> {
        let symbols = self.symbols(parameters);
        let change: Vec<f64> =
            self.symbols.iter().map(|symbol| symbol.slope(parameters, change)).collect();
        let Some(splitting) = self.splitting else {
            let mut slots = self.fold.slope(step, &symbols, &change)?;
            slots.resize(slots.len().max(self.kernel.slots()), 0.0);
            return Ok(slots);
        };
        let flows = splitting.flows().chain(splitting.flows().next());
        let (mut all, each) = (Vec::new(), self.kernel.slots_of_flow());
        for (number, flow) in flows.enumerate() {
            all.extend(self.fold.slope(step * flow, &symbols, &change)?);
            all.resize((number + 1) * each, 0.0);
        }
        Ok(all)
    }

    /// The places among the coefficients at which a step of this size, which begins at this time, has the value of a signal: the place, the
    /// number of the signal, the time.
    pub fn sampled(&self, step: f64, time: f64) -> Vec<(usize, usize, f64)> {
        let Some(Moving { first, times, signals }) = &self.moving else { return Vec::new() };
        let flows: Vec<f64> = match self.splitting {
            Some(splitting) => splitting.flows().collect(),
            None => vec![1.0],
        };
        let (each, mut start, mut found) = (self.kernel.slots_of_flow(), time, Vec::new());
        for (flow, part) in flows.into_iter().enumerate() {
            for (at, share) in times.iter().enumerate() {
                let place = flow * each + first + at * (1 + signals.len());
                let time = share.mul_add(step * part, start);
                found.extend((0..signals.len()).map(|signal| (place + 1 + signal, signal, time)));
            }
            start += step * part;
        }
        // Of the places those that the programs read.
        found.retain(|(place, ..)| *place < self.kernel.slots());
        found
    }
}
