//! A potential run by the interpreter, and its kicks between flows.

use std::cell::RefCell;

use coadjoint::groups::Chart;
use coadjoint::steps::{Kicked, Prk4, Prk6, Rkn4, Rkn6, Splitting as Sequence, Strang};
use coadjoint::{Phase, StepError};
use coadjoint_codegen::graph;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Kick};
use coadjoint_codegen::potential::Potential;
use coadjoint_codegen::problem::values;
use coadjoint_codegen::system::Splitting;
use nalgebra::DVector;

use super::interpreter::refusal;
use super::{Group, Interpreter};

/// The kicks of a potential.
#[derive(Debug)]
pub struct Forces {
    /// Its torque.
    pub kick: Kick,
    /// How kicks and flows are composed.
    pub splitting: Splitting,
}

/// A step, from the time given.
pub type Step<'a, G> = Box<dyn Fn(&mut Phase<G>, f64) -> Result<(), StepError> + 'a>;

impl Forces {
    /// Derives the torque.
    pub fn new(potential: Potential, splitting: Splitting) -> Self {
        Self { kick: Kick::build(potential), splitting }
    }

    /// The order of the splitting.
    pub fn order(&self) -> u32 {
        match self.splitting {
            Splitting::Strang => Strang::ORDER,
            Splitting::Rkn4 => Rkn4::ORDER,
            Splitting::Rkn6 => Rkn6::ORDER,
            Splitting::Prk4 => Prk4::ORDER,
            Splitting::Prk6 => Prk6::ORDER,
        }
    }

    /// The longest flow of a step, as a share of it.
    pub fn longest_flow(&self) -> f64 {
        let parts = match self.splitting {
            Splitting::Strang => Strang::PARTS,
            Splitting::Rkn4 => Rkn4::PARTS,
            Splitting::Rkn6 => Rkn6::PARTS,
            Splitting::Prk4 => Prk4::PARTS,
            Splitting::Prk6 => Prk6::PARTS,
        };
        parts.iter().copied().fold(0.0, |longest: f64, part| match part.abs() > longest.abs() {
            true => part,
            false => longest,
        })
    }

    /// The step of flows and kicks.
    pub fn step<'a, G: Group + 'a, C: Chart<G> + 'a>(
        &'a self,
        integrator: &'a Integrator,
        group: &G,
        step: f64,
    ) -> Result<Step<'a, G>, StepError> {
        match self.splitting {
            Splitting::Strang => self.composed::<G, C, Strang>(integrator, group, step),
            Splitting::Rkn4 => self.composed::<G, C, Rkn4>(integrator, group, step),
            Splitting::Rkn6 => self.composed::<G, C, Rkn6>(integrator, group, step),
            Splitting::Prk4 => self.composed::<G, C, Prk4>(integrator, group, step),
            Splitting::Prk6 => self.composed::<G, C, Prk6>(integrator, group, step),
        }
    }

    fn composed<'a, G: Group + 'a, C: Chart<G> + 'a, M: Sequence + 'a>(
        &'a self,
        integrator: &'a Integrator,
        group: &G,
        step: f64,
    ) -> Result<Step<'a, G>, StepError> {
        let torque = Torque::new(&self.kick, group.clone())?;
        let torque = move |_: f64, g: &G::Element| torque.torque(g);
        let flow = |part: f64| Interpreter::<G, C>::new(integrator, group.clone(), part);
        let kicked = Kicked::<M, _, _>::new(step, torque, flow)?;
        Ok(Box::new(move |phase, time| kicked.advance(phase, time)))
    }
}

/// The body torque −g⁻¹dV(g) of a potential, on a run-time group.
#[derive(Debug)]
pub struct Torque<'a, G> {
    kick: &'a Kick,
    group: G,
    slots: Vec<f64>,
    /// Reused between evaluations: what programs need, and the entries of g.
    scratch: RefCell<(Vec<f64>, Vec<f64>)>,
}

impl<'a, G: Group> Torque<'a, G> {
    /// Folds the coefficients.
    pub fn new(kick: &'a Kick, group: G) -> Result<Self, StepError> {
        let symbols = values(&kick.potential.symbols);
        // No coefficient holds the step size.
        let slots = FoldTable::of_kick(kick).fold(1.0, &symbols);
        let slots = slots.map_err(|error| refusal(error, 1.0, &symbols))?;
        Ok(Self { kick, group, slots, scratch: RefCell::default() })
    }

    /// −g⁻¹dV(g).
    pub fn torque(&self, g: &G::Element) -> DVector<f64> {
        let (scratch, entries) = &mut *self.scratch.borrow_mut();
        let size = self.group.matrix_size();
        let entry = |at: usize| self.group.matrix_entry(g, at / size, at % size);
        entries.clear();
        entries.extend((0..size * size).map(entry));
        let mut result = vec![0.0; self.group.dim()];
        graph::run(&self.kick.torque, entries, &self.slots, scratch, &mut result);
        DVector::from_vec(result)
    }
}
