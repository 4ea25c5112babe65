//! Flows by collocation, for Hamiltonians that are no polynomials, without programs: by the runtime.

use std::sync::{Arc, Mutex, PoisonError};

use coadjoint::collocation::{Collocation, Drive, Energy, Undefined};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::cancel;
use coadjoint_codegen::smooth::Smooth;
use coadjoint_codegen::step;
use nalgebra::DVector;

use super::compiled::Solved;
use super::drive::Actuator;
use super::method::{Flow, Propagator};
use super::space::Tables;
use crate::error::kept;

/// Flows of a smooth system, for these values of the parameters that it keeps; steps of this size are remembered where that helps.
///
/// # Errors
/// Fails if the size makes no sense, or an expression in the parameters is not finite.
pub(super) fn collocated<'a>(
    smooth: &'a Smooth,
    group: &Arc<Tables>,
    size: f64,
    parameters: &[f64],
) -> Result<Box<dyn Propagator<'a> + 'a>, StepError> {
    let symbols = smooth.symbols_at(parameters);
    if let Some(value) = symbols.into_iter().find(|value| !value.is_finite()) {
        return Err(StepError::InvalidParameter { name: "of the Hamiltonian", value });
    }
    match smooth.nodes() {
        1 => at_nodes::<1>(smooth, group, size, parameters),
        2 => at_nodes::<2>(smooth, group, size, parameters),
        3 => at_nodes::<3>(smooth, group, size, parameters),
        4 => at_nodes::<4>(smooth, group, size, parameters),
        5 => at_nodes::<5>(smooth, group, size, parameters),
        6 => at_nodes::<6>(smooth, group, size, parameters),
        7 => at_nodes::<7>(smooth, group, size, parameters),
        _ => at_nodes::<8>(smooth, group, size, parameters),
    }
}

/// Collocation at `M` nodes, with the drive where there is one.
fn at_nodes<'a, const M: usize>(
    smooth: &'a Smooth,
    group: &Arc<Tables>,
    size: f64,
    parameters: &[f64],
) -> Result<Box<dyn Propagator<'a> + 'a>, StepError> {
    if smooth.drive.is_none() {
        return Ok(Box::new(Collocated::<M, ()>::new(smooth, group, size, parameters, ())?));
    }
    let drive = Actuator::new(smooth, group, parameters);
    Ok(Box::new(Collocated::<M, _>::new(smooth, group, size, parameters, drive)?))
}

/// The energy by its programs.
#[derive(Clone, Debug)]
pub(super) struct Interpreted<'a>(Arc<step::Energy<'a>>);

impl<'a> Interpreted<'a> {
    pub(super) fn new(energy: step::Energy<'a>) -> Self {
        Self(Arc::new(energy))
    }
}

impl Energy<DVector<f64>> for Interpreted<'_> {
    fn value(&self, time: f64, mu: &DVector<f64>) -> f64 {
        self.0.value(time, mu.as_slice())
    }

    fn gradient(&self, time: f64, mu: &DVector<f64>) -> DVector<f64> {
        cancel::check();
        DVector::from_vec(self.0.gradient(time, mu.as_slice()))
    }

    fn reach(&self, from: (f64, &DVector<f64>), to: (f64, &DVector<f64>)) -> Option<f64> {
        let [from, to] = [from, to].map(|(time, mu)| (time, mu.as_slice()));
        self.0.reach(from, to)
    }

    fn unit(&self, i: usize) -> f64 {
        self.0.unit(i)
    }

    fn undefined(&self, time: f64, mu: &DVector<f64>) -> Option<Undefined> {
        let (expression, argument) = self.0.undefined(time, mu.as_slice())?;
        Some(Undefined { expression: kept(expression), argument })
    }
}

/// Steps of one size that know those before them.
type Remembering<'a, const M: usize, D> = Mutex<Collocation<Tables, Interpreted<'a>, M, D>>;

/// Collocation at `M` nodes.
struct Collocated<'a, const M: usize, D> {
    smooth: &'a Smooth,
    energy: Interpreted<'a>,
    drive: D,
    /// Of a function of the user's. Steps of a system too large for programs begin anew: so their bits do not depend on how a run is
    /// cut.
    whole: Option<Remembering<'a, M, D>>,
}

impl<'a, const M: usize, D: Drive<Tables> + Clone> Collocated<'a, M, D> {
    fn new(
        smooth: &'a Smooth,
        group: &Arc<Tables>,
        size: f64,
        parameters: &[f64],
        drive: D,
    ) -> Result<Self, StepError> {
        let energy = Interpreted::new(step::Energy::smooth(smooth, parameters));
        let remembers = smooth.is_function() && smooth.kicks.is_none();
        let whole = || Collocation::driven((**group).clone(), energy.clone(), drive.clone(), size);
        let whole = remembers.then(whole).transpose()?.map(Mutex::new);
        Ok(Self { smooth, energy, drive, whole })
    }
}

impl<'a, const M: usize, D> Propagator<'a> for Collocated<'a, M, D>
where
    D: Drive<Tables> + Clone + Send + Sync + 'a,
{
    fn flow(&self, group: &Tables, length: f64, _: &[f64]) -> Result<Flow<'a>, StepError> {
        let (energy, drive) = (self.energy.clone(), self.drive.clone());
        let flow = Collocation::<_, _, M, _>::driven(group.clone(), energy, drive, length)?;
        Ok(Box::new(move |phase, time| {
            let report = flow.clone().advance(phase, time)?;
            Ok(Solved::one(report.iterations, report.residual))
        }))
    }

    fn go_on(&self, phase: &mut Phase<Tables>, time: f64) -> Option<Solved> {
        // A thread that panicked has left whole steps, if any.
        let mut whole = self.whole.as_ref()?.lock().unwrap_or_else(PoisonError::into_inner);
        let report = whole.advance(phase, time).ok()?;
        Some(Solved::one(report.iterations, report.residual))
    }

    fn may_be_undefined(&self) -> bool {
        true
    }

    fn defined(
        &self,
        time: f64,
        phase: &dyn Fn() -> Phase<Tables>,
        mu: &[f64],
    ) -> Result<(), StepError> {
        let energy = &self.energy.0;
        // A function of the user's says by its value alone that there is none.
        let lost = || self.smooth.given.is_some() && !energy.value(time, mu).is_finite();
        let found = energy.undefined(time, mu).or_else(|| lost().then_some(("H", f64::NAN)));
        let found = found.map(|(expression, argument)| (kept(expression), argument));
        let found = found.or_else(|| {
            let (drive, phase) = (D::ACTS.then_some(&self.drive)?, phase());
            let omega = DVector::from_vec(energy.gradient(time, mu));
            let known = drive.undefined(time, &phase.group_element, &phase.momentum, &omega)?;
            Some((known.expression, known.argument))
        });
        found.map_or(Ok(()), |(expression, argument)| {
            Err(StepError::Undefined { expression, argument, time, at: None })
        })
    }
}
