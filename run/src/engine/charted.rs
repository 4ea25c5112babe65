//! From a system on a group known at run time to its steps.

use std::path::Path;
use std::sync::Arc;

use coadjoint::StepError;
use coadjoint::groups::{Cayley, CayleyMatrixGroup, DirectProduct, Exponential, MatrixGroup};
use coadjoint_codegen::lie;
use coadjoint_codegen::step::Origin;

use super::collocation::collocated;
use super::compiled::Compiled;
use super::motion::{Equations, Steps, Varied};
use super::space::{Elements, cayley_group};
use crate::error::RunError;
use crate::grid::Grid;

/// A group known at run time.
#[derive(Clone, Debug)]
pub(crate) struct Charted {
    /// The group with the exponential.
    pub exponential: Arc<DirectProduct<MatrixGroup>>,
    /// The group with the Cayley map, if steps are made in that chart.
    pub cayley: Option<Arc<DirectProduct<CayleyMatrixGroup>>>,
}

impl Charted {
    /// The group with this chart; `file` is the name of its system in messages.
    ///
    /// # Errors
    /// Fails if the group does not have the chart.
    pub(crate) fn new(
        file: &Path,
        group: DirectProduct<MatrixGroup>,
        chart: lie::Chart,
    ) -> Result<Self, RunError> {
        let cayley = match chart {
            lie::Chart::Exponential => None,
            lie::Chart::Cayley => Some(Arc::new(cayley_group(file, &group)?)),
        };
        Ok(Self { exponential: Arc::new(group), cayley })
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
    ) -> Result<Box<dyn Varied + 'a>, StepError> {
        let compiled = compiled.map(|own| own.anew(grid.step, parameters)).transpose()?;
        let (group, parameters) = (self.exponential.clone(), parameters.to_vec());
        let integrator = match origin {
            Origin::Series(integrator) => integrator,
            Origin::Collocation(smooth) => {
                return collocated(smooth, Elements { group, compiled }, grid, &parameters);
            }
        };
        let equations = Equations { integrator, parameters };
        Ok(match self.cayley.clone() {
            None => Box::new(Steps::<_, Exponential>::new(
                Elements { group, compiled },
                equations,
                grid,
            )),
            Some(group) => {
                Box::new(Steps::<_, Cayley>::new(Elements { group, compiled }, equations, grid))
            }
        })
    }
}
