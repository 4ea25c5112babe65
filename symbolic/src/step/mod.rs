//! A whole step as straight-line programs, ready for any target.
//!
//! [`Step::build`] puts an integrator's gradient, Hessian and first guess together with the formulas of its group and
//! chart: closed forms for SO(3), SU(2), SE(2), SE(3) and translations, series by tables for all
//! others, products factor by factor. The test that accepts a step is the runtime's (`docs/book/src/guarantee.md`), with
//! sufficient conditions in place of eigenvalues: what the programs refuse may still be a right step, which whoever drives
//! them finds by other means.

mod closed;
mod collocation;
mod convergence;
mod drift;
mod energy;
mod error;
mod invariants;
#[cfg(feature = "spatial")]
mod observation;
mod origin;
mod product;
mod programs;
mod solving;
mod tables;
mod tangent;
mod traced;
mod transposed;
mod vector;

use coadjoint_program::fold::{FoldError, Values};
use coadjoint_program::splitting::Splitting;
use coadjoint_program::{Clock, Kernel, Precision};

use crate::expr::ParameterExpr;
use crate::graph::{Graph, Id, Program};
use crate::integrator::{FoldTable, Integrator};
use crate::lie::{Chart, LieAlgebra, catalogue};
use crate::signal::Signal;
use crate::smooth::Smooth;
use crate::step::solving::Scheme;
use crate::step::tables::Tables;
use closed::closed;
use product::{Part, Product, Translations};

pub use convergence::{Convergence, Converging};
pub use drift::{Drift, MEASURABLE, NUDGE, Scales, Start, nudge, rounding};
pub use energy::Energy;
pub(crate) use error::MOST_OF_TABLES;
pub use error::StepError;
pub use invariants::{Invariants, Seen};
#[cfg(feature = "spatial")]
pub use observation::{DriftGauge, DriftPrograms, Observation};
pub use origin::Origin;
pub use tangent::Tangent;

/// A step as programs, with what is needed to fold its coefficients and to read group elements.
#[derive(Debug)]
pub struct Step {
    kernel: Kernel,
    group: Product,
    fold: FoldTable,
    symbols: Vec<ParameterExpr>,
    radius_at: usize,
    /// The splitting, for steps with kicks.
    splitting: Option<Splitting>,
    /// The times among the coefficients, where a step depends on them.
    moving: Option<Moving>,
    /// The numbers that steps leave to the next one, and those of a torque's work among them, which are the last.
    memory: usize,
    work: usize,
}

/// The times at which the programs of a step read the time and the signals then.
#[derive(Debug)]
struct Moving {
    /// The first place.
    first: usize,
    /// The times from the beginning of a flow on, in its lengths.
    times: Vec<f64>,
    signals: Vec<Signal>,
}

impl Step {
    /// The programs of a step.
    ///
    /// # Errors
    /// [`StepError`] where the step has no straight-line programs.
    pub fn build(integrator: &Integrator) -> Result<Self, StepError> {
        Self::by_series(integrator, Elements::ByFactors)
    }

    /// As [`Step::build`], with these numbers of group elements.
    ///
    /// # Errors
    /// As [`Step::build`].
    pub fn by_series(integrator: &Integrator, elements: Elements) -> Result<Self, StepError> {
        let (problem, scheme) = (&integrator.problem, Scheme::of(integrator));
        Self::with(integrator, elements.parts(&problem.algebra, problem.chart, scheme)?)
    }

    fn with(integrator: &Integrator, parts: Vec<Box<dyn Part>>) -> Result<Self, StepError> {
        let group = Product(parts);
        let slots = (integrator.coefficients.slots().len(), integrator.defect_len());
        let kernel = programs::kernel(integrator, Scheme::of(integrator), &group, slots)?;
        let radius_at = FoldTable::radius_at(integrator);
        let fold = FoldTable::placed(integrator, |at| (at <= radius_at).then_some(at));
        let symbols = integrator.problem.symbols.iter().map(|symbol| symbol.expr.clone()).collect();
        let splitting = integrator.kicks.as_ref().map(|kicks| kicks.splitting);
        let (moving, memory, work) = (None, 0, 0);
        Ok(Self { kernel, group, fold, symbols, radius_at, splitting, moving, memory, work })
    }

    /// The programs of a step of collocation in numbers of this precision, in the exponential chart about its middle. Without
    /// kicks elements then have numbers that steps leave to the next one.
    ///
    /// # Errors
    /// [`StepError`] where the step has no straight-line programs.
    pub fn by_collocation(
        smooth: &Smooth,
        precision: Precision,
        elements: Elements,
    ) -> Result<Self, StepError> {
        let parts = elements.parts(&smooth.algebra, Chart::Exponential, Scheme::FixedPoint);
        let mut group = Product(parts?);
        if collocation::operations(smooth) > MOST_OF_TABLES {
            return Err(StepError::TooLarge {
                group: smooth.algebra.name().to_owned(),
                dimension: smooth.algebra.dim(),
                rows: smooth.algebra.matrix_size(),
            });
        }
        if precision == Precision::Single && smooth.depends_on_time() {
            return Err(StepError::SingleTime);
        }
        let memory = collocation::memory(smooth);
        if memory > 0 {
            group.0.push(Box::new(Translations { dim: 0, memory }));
        }
        let mut kernel = collocation::kernel(smooth, &group)?.in_precision(precision);
        let symbols = smooth.symbols.iter().map(|symbol| symbol.expr.clone()).collect();
        let (radius_at, kicks) = (collocation::radius_at(smooth), smooth.kicks.as_ref());
        let moving = smooth.depends_on_time().then(|| Moving {
            first: collocation::first_time(smooth),
            times: collocation::times(smooth.nodes()),
            signals: smooth.signals.clone(),
        });
        // The size of a step of kicks is in no place.
        let clocked = moving.as_ref().filter(|own| kicks.is_none() && own.signals.is_empty());
        if let Some(Moving { first, times, .. }) = clocked {
            let (size, first, times) = (radius_at - 1, *first, times.clone());
            kernel = kernel.with_clock(Clock { size, first, times, start: 0.0 });
        }
        let fold = FoldTable::of_symbols(smooth.symbols.len(), kicks, Some);
        let rates =
            smooth.drive.iter().flat_map(|own| own.rates.iter().map(|rate| own.first + rate));
        let fold = fold.with_rates(rates.collect());
        let splitting = kicks.map(|kicks| kicks.splitting);
        let work = collocation::work(smooth);
        Ok(Self { kernel, group, fold, symbols, radius_at, splitting, moving, memory, work })
    }

    /// The programs.
    pub fn kernel(&self) -> &Kernel {
        &self.kernel
    }

    /// The values of the expressions that coefficients are made of, for these of the parameters that are kept.
    pub fn symbols(&self, parameters: &[f64]) -> Vec<f64> {
        self.symbols.iter().map(|symbol| symbol.evaluate(parameters)).collect()
    }

    /// All numbers that the programs read as coefficients, for a step size and the parameters' scalars. With kicks there is
    /// a list for each flow and one for the last kick, one after the other.
    ///
    /// # Errors
    /// [`FoldError`] where the step size is zero, or a number is not finite.
    pub fn fold(&self, step: f64, parameters: &[f64]) -> Result<Vec<f64>, FoldError> {
        let symbols = self.symbols(parameters);
        let Some(splitting) = self.splitting else {
            let mut slots = self.fold.fold(step, &symbols)?;
            slots.resize(slots.len().max(self.kernel.slots()), f64::NAN);
            return Ok(slots);
        };
        // After the last kick there is no flow.
        let flows = splitting.flows().chain(splitting.flows().next());
        let mut all = Vec::new();
        let each = self.kernel.slots_of_flow();
        for (number, (kick, flow)) in splitting.kicks().zip(flows).enumerate() {
            all.extend(self.fold.fold(step * flow, &symbols)?);
            all.push(step * kick);
            // The places of the time and of signals, as far as they are read.
            all.resize((number + 1) * each, f64::NAN);
        }
        Ok(all)
    }

    /// True if a step depends on the time, which [`Step::set_time`] then sets.
    pub fn moves(&self) -> bool {
        self.moving.is_some()
    }

    /// Puts the times at which programs ask for it, and the values of the signals there, among the coefficients of a step of
    /// this size that begins at this time.
    pub fn set_time(&self, slots: &mut [f64], step: f64, time: f64) {
        self.set_time_by(None, slots, [step, time]);
    }

    /// As [`Step::set_time`], with other signals in place of the system's where there are any.
    pub fn set_time_by(
        &self,
        others: Option<&[Signal]>,
        slots: &mut [f64],
        [step, time]: [f64; 2],
    ) {
        let Some(Moving { first, times, signals }) = &self.moving else { return };
        let signals = others.unwrap_or(signals);
        // Of the places those that the programs read.
        let put = |slots: &mut [f64], time: f64| {
            let values = std::iter::once(time).chain(signals.iter().map(|signal| signal.at(time)));
            slots.iter_mut().zip(values).for_each(|(slot, value)| *slot = value);
        };
        // After the last kick there is no flow; without kicks there is one of the whole step.
        let last = if self.splitting.is_some() { 0.0 } else { 1.0 };
        let flows = self.splitting.into_iter().flat_map(Splitting::flows).chain([last]);
        let mut time = time;
        for (slots, flow) in slots.chunks_mut(self.kernel.slots_of_flow().max(1)).zip(flows) {
            let places = slots.get_mut(*first..).unwrap_or_default();
            for (slots, part) in places.chunks_mut(1 + signals.len()).zip(times) {
                put(slots, part.mul_add(step * flow, time));
            }
            time += step * flow;
        }
    }

    /// The number of an element's numbers, the last ones, that a step leaves for the next one.
    pub fn memory(&self) -> usize {
        self.memory
    }

    /// Sets these numbers to 0, but for the work, so that the next step knows none before it.
    pub fn forget(&self, g: &mut [f64]) {
        let (own, end) = (g.len().saturating_sub(self.memory), g.len().saturating_sub(self.work));
        g[own..end].fill(0.0);
    }

    /// The place among an element's numbers of the work ∫⟨τ, ω⟩ dt of a torque, where one acts, since it was 0.
    pub fn work_at(&self) -> Option<usize> {
        (self.work > 0).then(|| self.kernel.element - 1)
    }

    /// The values of the same expressions for rows of parameters side by side.
    pub fn symbols_of_rows<T: Values>(&self, parameters: &[T]) -> Vec<T> {
        self.symbols.iter().map(|symbol| symbol.evaluate_rows(parameters)).collect()
    }

    /// The coefficients of a flow, of rows side by side, for the values of the symbols; and the |μ| up to which the last two
    /// terms of the series have at most this ratio.
    ///
    /// # Errors
    /// As [`Step::fold`].
    pub fn fold_rows<T: Values>(
        &self,
        step: f64,
        symbols: &[T],
        ratio: f64,
    ) -> Result<(Vec<T>, T), FoldError> {
        let (mut slots, radius) = self.fold.fold_rows(step, symbols, ratio)?;
        slots.resize(slots.len().max(self.kernel.slots_of_flow()), T::each(|_| f64::NAN));
        Ok((slots, radius))
    }

    /// The place among the coefficients of the square of the |μ| up to which the series can be trusted.
    pub fn radius_at(&self) -> usize {
        self.radius_at
    }

    /// g, g⁻¹, μ ↦ Ad\*_g μ, the spatial momentum, which every step conserves. Of g⁻¹ only the matrices of
    /// [`Step::inverted`] are read.
    pub fn spatial(&self) -> Program {
        let (n, m) = (self.group.dim(), self.group.element());
        let graph = Graph::new();
        let ids: Vec<Id> = (0..m + m + n).map(|i| graph.input(i)).collect();
        let spatial = self.group.spatial(&graph, &ids[..m], &ids[m..m + m], &ids[m + m..]);
        graph.finish(m + m + n, &spatial)
    }

    /// Parts of an element that are matrices by rows, other than rotations and motions: where each begins in the
    /// element's numbers, and how many rows it has.
    pub fn inverted(&self) -> Vec<(usize, usize)> {
        self.group.inverted()
    }

    /// g ↦ the numbers of the element that it is up to rounding, put onto the group as products are.
    pub fn settled(&self) -> Program {
        let (n, m, graph) = (self.group.dim(), self.group.element(), Graph::new());
        let nothing = vec![graph.zero(); n];
        let product = |g: Vec<Id>| self.group.transport(&graph, &g, &nothing, &nothing).g;
        // To first order each.
        let outputs = product(product((0..m).map(|i| graph.input(i)).collect()));
        graph.finish(m, &outputs)
    }

    /// A description of the numbers of a group element; those of factors one after the other.
    pub fn element_about(&self) -> String {
        self.group.about()
    }

    /// The numbers of the group element with this matrix, row by row; factors are its diagonal blocks.
    pub fn element_of(&self, matrix: &[f64]) -> Vec<f64> {
        self.group.element_of(matrix)
    }
}

/// The numbers of group elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elements {
    /// Those of each factor, in closed form where there is one.
    ByFactors,
    /// A matrix in the representation of the basis, also of a product.
    Matrices,
}

impl Elements {
    /// The formulas of a group.
    fn parts(
        self,
        algebra: &LieAlgebra,
        chart: Chart,
        scheme: Scheme,
    ) -> Result<Vec<Box<dyn Part>>, StepError> {
        match self {
            Self::Matrices => Ok(vec![tables(algebra, chart, scheme)?]),
            Self::ByFactors => {
                let factors = algebra.factors();
                factors.iter().map(|factor| part(factor, chart, scheme)).collect()
            }
        }
    }
}

/// The formulas of a group that is no product.
fn part(algebra: &LieAlgebra, chart: Chart, scheme: Scheme) -> Result<Box<dyn Part>, StepError> {
    let is = |name: &str| {
        catalogue::lookup(name).is_ok_and(|known| known.renamed(algebra.name()) == *algebra)
    };
    for name in ["SO3", "SU2", "SE3", "SE2"] {
        if let Some(part) = is(name).then(|| closed(name, chart)).flatten() {
            return Ok(part);
        }
    }
    if is(&format!("R{}", algebra.dim())) {
        return Ok(Box::new(Translations { dim: algebra.dim(), memory: 0 }));
    }
    tables(algebra, chart, scheme)
}

/// The formulas of any group, by tables.
fn tables(algebra: &LieAlgebra, chart: Chart, scheme: Scheme) -> Result<Box<dyn Part>, StepError> {
    let group = || algebra.name().to_owned();
    let Some(tables) = Tables::new(algebra, chart, scheme.slope()) else {
        return Err(StepError::Dependent { group: group() });
    };
    if tables.operations(scheme != Scheme::FixedPoint) > MOST_OF_TABLES {
        let (dimension, rows) = (algebra.dim(), tables.rows());
        return Err(StepError::TooLarge { group: group(), dimension, rows });
    }
    Ok(Box::new(tables))
}
