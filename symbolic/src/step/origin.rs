//! A system with the method by which its steps are made.

use coadjoint_program::Precision;
use coadjoint_program::splitting::Splitting;

use super::{Elements, Step, StepError};
use crate::drive::Drive;
use crate::hamilton_jacobi::{DeriveError, TermLimit};
use crate::integrator::{Integrator, Kick, Kicks};
use crate::problem::Symbol;
use crate::signal::{Interpolation, Signal};
use crate::smooth::{Facts, Hamiltonian, Smooth};

/// A system that the programs of a step are made from.
#[derive(Clone, Debug)]
pub enum Origin {
    /// A polynomial, by its series.
    Series(Box<Integrator>),
    /// A smooth Hamiltonian, by collocation.
    Collocation(Box<Smooth>),
}

impl From<Integrator> for Origin {
    fn from(integrator: Integrator) -> Self {
        Self::Series(Box::new(integrator))
    }
}

impl From<Smooth> for Origin {
    fn from(smooth: Smooth) -> Self {
        Self::Collocation(Box::new(smooth))
    }
}

impl Origin {
    /// Derives the series of a polynomial; another Hamiltonian needs none.
    ///
    /// # Errors
    /// [`DeriveError`] where the series cannot be derived or exceeds the limit.
    pub fn derive(hamiltonian: Hamiltonian, limit: TermLimit) -> Result<Self, DeriveError> {
        match hamiltonian {
            Hamiltonian::Polynomial(problem, _) => {
                Integrator::build(*problem, limit).map(Self::from)
            }
            Hamiltonian::Smooth(smooth) => Ok(Self::Collocation(smooth)),
        }
    }

    /// This system with kicks between flows; `None` where the potential has other parameters than the Hamiltonian.
    pub fn with_kicks(self, kick: Kick, splitting: Splitting) -> Option<Self> {
        match self {
            Self::Series(integrator) => integrator.with_kicks(kick, splitting).map(Self::from),
            Self::Collocation(smooth) => smooth.with_kicks(kick, splitting).map(Self::from),
        }
    }

    /// This system with its flow alone, where there are kicks between flows.
    pub fn without_kicks(&self) -> Option<Self> {
        let mut alone = self.kicks().is_some().then(|| self.clone())?;
        match &mut alone {
            Self::Series(integrator) => integrator.kicks = None,
            Self::Collocation(smooth) => smooth.kicks = None,
        }
        Some(alone)
    }

    /// This system without the velocity of its drive, where it has one.
    pub fn without_velocity(&self) -> Option<Self> {
        let Self::Collocation(smooth) = self else { return None };
        let drive = smooth.drive.as_ref().filter(|drive| drive.velocity)?;
        let drive = Some(Box::new(drive.without_velocity()));
        Some(Self::from(Smooth { drive, ..(**smooth).clone() }))
    }

    /// This system with these inputs in place of its own; one by a series has none.
    pub fn with_signals(&self, signals: Vec<Signal>) -> Self {
        let mut own = self.clone();
        if let Self::Collocation(smooth) = &mut own {
            smooth.signals = signals;
        }
        own
    }

    /// The programs of a step in numbers of this precision.
    ///
    /// # Errors
    /// [`StepError`] where it has none.
    pub fn step(&self, precision: Precision) -> Result<Step, StepError> {
        match self {
            Self::Series(integrator) => {
                if precision == Precision::Single && !integrator.frame.is_empty() {
                    return Err(StepError::SingleFrame);
                }
                let step = Step::build(integrator)?;
                Ok(Step { kernel: step.kernel.in_precision(precision), ..step })
            }
            Self::Collocation(smooth) => {
                Step::by_collocation(smooth, precision, Elements::ByFactors)
            }
        }
    }

    /// The facts of the system.
    pub fn facts(&self) -> Facts<'_> {
        match self {
            Self::Series(integrator) => integrator.problem.facts(),
            Self::Collocation(smooth) => smooth.facts(),
        }
    }

    /// The series, if steps are made by one.
    pub fn series(&self) -> Option<&Integrator> {
        match self {
            Self::Series(integrator) => Some(integrator),
            Self::Collocation(_) => None,
        }
    }

    /// The equations of collocation, if steps are made by it.
    pub fn smooth(&self) -> Option<&Smooth> {
        match self {
            Self::Series(_) => None,
            Self::Collocation(smooth) => Some(smooth),
        }
    }

    /// The expressions in parameters that coefficients are made of.
    pub fn symbols(&self) -> &[Symbol] {
        match self {
            Self::Series(integrator) => &integrator.problem.symbols,
            Self::Collocation(smooth) => &smooth.symbols,
        }
    }

    /// The kicks between flows, where there are any.
    pub fn kicks(&self) -> Option<&Kicks> {
        match self {
            Self::Series(integrator) => integrator.kicks.as_ref(),
            Self::Collocation(smooth) => smooth.kicks.as_ref(),
        }
    }

    /// The inputs u(t).
    pub fn signals(&self) -> &[Signal] {
        match self {
            Self::Series(_) => &[],
            Self::Collocation(smooth) => &smooth.signals,
        }
    }

    /// The times at which steps end, since the equations jump or bend there.
    pub fn breaks(&self) -> Vec<f64> {
        self.smooth().map(Smooth::breaks).unwrap_or_default()
    }

    /// True if the equations depend on the time other than through the state.
    pub fn depends_on_time(&self) -> bool {
        self.smooth().is_some_and(Smooth::depends_on_time)
    }

    /// The velocity and the torque beside the Hamiltonian, where there are any.
    pub fn drive(&self) -> Option<&Drive> {
        self.smooth()?.drive.as_deref()
    }

    /// True if a part of the system is a function of the user's, of which there are no programs.
    pub fn is_function(&self) -> bool {
        self.smooth().is_some_and(Smooth::is_function)
    }

    /// The order of accuracy: K + 1, or that of the splitting where it is lower.
    pub fn order(&self) -> u32 {
        let order = self.facts().truncation as u32 + 1;
        self.kicks().map_or(order, |kicks| order.min(kicks.splitting.order()))
    }

    /// A description of the method in a few words.
    pub fn label(&self) -> String {
        let mut label = match self {
            Self::Series(integrator) => {
                let problem = &integrator.problem;
                let frame = if problem.comoving.is_some() { ", comoving" } else { "" };
                format!("K = {}, {}{frame}", problem.truncation, problem.chart)
            }
            Self::Collocation(smooth) => format!("collocation, {} nodes", smooth.nodes()),
        };
        if self.drive().is_some_and(Drive::is_dissipative) {
            label.push_str(", damped");
        }
        let table = self.signals().iter().find(|signal| !signal.table()[0].is_empty());
        if let Some(table) = table {
            label.push_str(match table.between {
                Interpolation::Previous => ", inputs held",
                Interpolation::Linear => ", inputs by lines",
                Interpolation::Spline => ", inputs by splines",
            });
        }
        if let Some(kicks) = self.kicks() {
            label.push_str(", ");
            label.push_str(kicks.splitting.name());
        }
        label
    }
}
