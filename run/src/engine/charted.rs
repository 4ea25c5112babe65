//! From a system on a group known at run time to its steps.

use std::marker::PhantomData;
use std::path::Path;
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint::groups::{Cayley, CayleyMatrixGroup, Chart, DirectProduct, Exponential, TableError};
use coadjoint::steps::advance;
use coadjoint_codegen::lie;
use coadjoint_codegen::step::Origin;
use coadjoint_learn::{Generating, ModelFile};

use super::collocation::collocated;
use super::compiled::{Compiled, Solved};
use super::method::{Flow, Propagator};
use super::motion::Motion;
use super::series::Series;
use super::space::{Group, Space, Tables, moved_in};
use crate::error::RunError;
use crate::grid::Grid;

/// A group known at run time.
#[derive(Clone, Debug)]
pub(crate) struct Charted {
    /// The group with the exponential.
    pub exponential: Arc<Tables>,
    /// The group with the Cayley map, if steps are made in that chart.
    cayley: Option<Arc<DirectProduct<CayleyMatrixGroup>>>,
}

impl Charted {
    /// The group with this chart; `file` is the name of its system in messages.
    ///
    /// # Errors
    /// Fails if the group does not have the chart.
    pub(crate) fn new(file: &Path, group: Tables, chart: lie::Chart) -> Result<Self, RunError> {
        let cayley = || -> Result<_, TableError> {
            let factors = group.factors().map(|factor| factor.clone().into_cayley());
            Ok(Arc::new(DirectProduct::new(factors.collect::<Result<_, _>>()?)))
        };
        let cayley = match chart {
            lie::Chart::Exponential => None,
            lie::Chart::Cayley => Some(cayley().map_err(RunError::of(file))?),
        };
        Ok(Self { exponential: Arc::new(group), cayley })
    }

    fn space(&self, compiled: Option<Arc<Compiled>>) -> Space {
        Space { group: self.exponential.clone(), compiled }
    }

    /// The steps of this grid for these values of the parameters that a system keeps: by programs where there are any.
    ///
    /// # Errors
    /// Where the size makes no sense, or a coefficient is not finite.
    pub(crate) fn steps<'a>(
        &self,
        origin: &'a Origin,
        grid: Grid,
        parameters: &[f64],
        compiled: Option<&Arc<Compiled>>,
    ) -> Result<Motion<'a>, StepError> {
        let compiled = compiled.map(|own| own.anew(grid.step, parameters)).transpose()?;
        let (exponential, cayley) = (self.exponential.clone(), self.cayley.clone());
        let method =
            Box::new(move |parameters: &[f64]| -> Result<Box<dyn Propagator<'a> + 'a>, _> {
                Ok(match (origin, cayley.clone()) {
                    (Origin::Collocation(smooth), _) => {
                        collocated(smooth, &exponential, grid.step, parameters)?
                    }
                    (Origin::Series(integrator), None) => {
                        Box::new(Series::<_, Exponential>::new(integrator, exponential.clone()))
                    }
                    (Origin::Series(integrator), Some(group)) => {
                        Box::new(Series::<_, Cayley>::new(integrator, group))
                    }
                })
            });
        let (space, own) = (self.space(compiled), parameters.to_vec());
        Motion::new(space, grid, own, method, Some(origin))
    }

    /// The steps of a learned map, which are those of this grid.
    ///
    /// # Errors
    /// Where the map has steps of another size.
    pub(crate) fn learned<'a>(
        &self,
        model: &'a ModelFile,
        grid: Grid,
    ) -> Result<Motion<'a>, StepError> {
        let (exponential, cayley) = (self.exponential.clone(), self.cayley.clone());
        let method =
            Box::new(move |_: &[f64]| -> Result<Box<dyn Propagator<'a> + 'a>, StepError> {
                Ok(match cayley.clone() {
                    None => Box::new(Learned::<_, Exponential>::new(model, exponential.clone())),
                    Some(group) => Box::new(Learned::<_, Cayley>::new(model, group)),
                })
            });
        Motion::new(self.space(None), grid, Vec::new(), method, None)
    }
}

/// A learned map, which has one step.
struct Learned<'a, G, C> {
    model: &'a ModelFile,
    group: Arc<G>,
    chart: PhantomData<C>,
}

impl<'a, G, C> Learned<'a, G, C> {
    fn new(model: &'a ModelFile, group: Arc<G>) -> Self {
        Self { model, group, chart: PhantomData }
    }
}

impl<'a, G, C> Propagator<'a> for Learned<'a, G, C>
where
    G: Group + Clone + 'a,
    C: Chart<G> + Send + Sync + 'a,
{
    fn flow(&self, _: &Tables, length: f64, _: &[f64]) -> Result<Flow<'a>, StepError> {
        if length != self.model.step {
            return Err(StepError::InvalidStep { step: length });
        }
        let map = Generating::<G, C, _>::new((*self.group).clone(), &self.model.model);
        Ok(Box::new(move |phase, _| {
            let report = moved_in(phase, |phase| advance(&map, phase))?;
            Ok(Solved::one(report.iterations, report.residual))
        }))
    }
}
