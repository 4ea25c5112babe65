//! Families of steps made by the programs of a kernel: by the interpreter, by C, and with the feature `jit` by Cranelift.

use std::sync::{Arc, OnceLock};

use coadjoint::LieGroup;
use coadjoint::groups::MatrixGroup;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::Options;
use coadjoint_program::WIDTH;
use nalgebra::DVector;

use super::family::{Family, Instance, Models, Realisation, Template};
use super::instance;
use super::random::Random;
use super::runtime::{Snapshot, Steps, Transition, Way};
use crate::backends::{AnyStepper, Backend, matrix_of, numbers_of};
use crate::bridge::matrix_group;
use crate::kernels::problem;

/// Group, Hamiltonian on coordinates a, b, c, …, chart, frame, truncation.
const SYSTEMS: [(&str, &str, &str, &str, usize); 16] = [
    ("SO3", "a^2/3 + b^2/4 + c^2/5", "exp", "fixed", 7),
    ("SO3", "a^2/3 + b^2/4 + c^2/5", "exp", "comoving", 9),
    ("SO3", "a^2/3 + b^2/4 + c^2/5 + a*b/7", "cayley", "fixed", 5),
    ("SU2", "a^2/3 + b^2/4 + c^2/5 + a*b/7", "exp", "fixed", 5),
    ("SU2", "a^2/3 + b^2/4 + c^2/5", "cayley", "fixed", 5),
    ("SE2", "a^2/3 + b^2/4 + c^2/5 + b*c/9", "exp", "fixed", 5),
    ("SE2", "a^2/3 + b^2/4 + c^2/5", "cayley", "fixed", 3),
    ("SE3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9 + b*f/8", "exp", "fixed", 3),
    ("SE3", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8", "cayley", "fixed", 3),
    ("Heisenberg", "a^2/2 + b^2/3 + c^2/5 + a*c/4", "exp", "fixed", 5),
    ("SL2", "a^2/5 + b^2/6 + c^2/7 + a*b/9", "exp", "fixed", 5),
    ("SL2", "a^2/5 + b^2/6 + c^2/7 + a*b/9", "cayley", "fixed", 3),
    ("Aff1", "a^2/5 + b^2/6", "exp", "fixed", 5),
    ("SO4", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8", "exp", "fixed", 3),
    ("SU3", "a^2/3 + b^2/3 + c^2/5 + d^2/5 + e^2/7 + f^2/7 + 9*g", "exp", "comoving", 3),
    ("SO3*SE2", "a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9", "exp", "fixed", 3),
];

/// A kernel, and what it takes to make its steps.
pub struct Subject {
    step: Step,
    group: MatrixGroup,
    backend: Backend,
    /// Compiled where a system is first drawn.
    stepper: OnceLock<Option<AnyStepper>>,
}

impl Subject {
    pub fn new(step: Step, group: MatrixGroup, backend: Backend) -> Self {
        Self { step, group, backend, stepper: OnceLock::new() }
    }

    fn stepper(&self) -> Option<AnyStepper> {
        self.stepper.get_or_init(|| self.backend.stepper(self.step.kernel())).clone()
    }
}

pub struct Runner {
    subject: Arc<Subject>,
    stepper: AnyStepper,
    slots: Vec<f64>,
}

impl Runner {
    /// Steps of this size with these parameters; `None` where there are none.
    pub fn new(subject: &Arc<Subject>, h: f64, parameters: &[f64]) -> Option<Self> {
        let (subject, slots) = (Arc::clone(subject), subject.step.fold(h, parameters).ok()?);
        Some(Self { stepper: subject.stepper()?, subject, slots })
    }

    fn element(&self, at: &[f64]) -> Vec<f64> {
        let group = &self.subject.group;
        numbers_of(&self.subject.step, group, &group.exp(&DVector::from_column_slice(at)))
    }

    fn state(&self, g: &[f64], mu: &[f64]) -> Snapshot {
        let bits: Vec<u64> = g.iter().chain(mu).map(|value| value.to_bits()).collect();
        Snapshot {
            element: matrix_of(self.subject.step.kernel(), g),
            momentum: mu.to_vec(),
            text: format!("{bits:x?}"),
        }
    }

    fn outcome(&self, before: Snapshot, g: &[f64], mu: &[f64], refused: bool) -> Transition {
        let error = refused.then(|| "the kernel refuses the step".to_owned());
        Transition { before, after: self.state(g, mu), error }
    }
}

impl Steps for Runner {
    fn solve(&self, mu: &[f64]) -> Result<Vec<f64>, String> {
        let found = self.subject.step.kernel().attempt(&self.slots, mu);
        found.accepted.then_some(found.increment).ok_or("the kernel refuses the step".to_owned())
    }

    fn go(&self, way: Way, at: &[f64], mu: &[f64]) -> Option<Transition> {
        let (steps, mut g, mut mu) = (way.steps(), self.element(at), mu.to_vec());
        let before = self.state(&g, &mu);
        let made = self.stepper.advance(&self.slots, &mut g, &mut mu, steps).steps;
        Some(self.outcome(before, &g, &mu, made < steps))
    }

    fn together(&self, starts: &[(Vec<f64>, Vec<f64>)], steps: u64) -> Option<Vec<Transition>> {
        let (m, n) = (self.subject.step.kernel().element, self.subject.step.kernel().dim);
        let mut outcomes = Vec::new();
        for starts in starts.chunks(WIDTH) {
            let states: Vec<_> = starts.iter().map(|(at, mu)| (self.element(at), mu)).collect();
            let (mut g, mut mu) = (vec![0.0; m * WIDTH], vec![0.0; n * WIDTH]);
            for (lane, state) in states.iter().enumerate() {
                (0..m).for_each(|i| g[i * WIDTH + lane] = state.0[i]);
                (0..n).for_each(|i| mu[i * WIDTH + lane] = state.1[i]);
            }
            let live = std::array::from_fn(|lane| lane < starts.len());
            let made = self.stepper.advance_lanes(&self.slots, &mut g, &mut mu, steps, live);
            for (lane, state) in states.iter().enumerate() {
                let of = |all: &[f64]| all.iter().skip(lane).step_by(WIDTH).copied().collect();
                let (g, mu): (Vec<f64>, Vec<f64>) = (of(&g), of(&mu));
                let before = self.state(&state.0, state.1);
                outcomes.push(self.outcome(before, &g, &mu, made[lane] < steps));
            }
        }
        Some(outcomes)
    }
}

fn model(system: (&str, &str, &str, &str, usize), backend: Backend) -> Template {
    let (group, hamiltonian, chart, frame, truncation) = system;
    let settings = format!("chart = {chart:?}\nframe = {frame:?}\n");
    let options = Options { truncation: Some(truncation), ..Options::default() };
    let problem = problem(group, hamiltonian, &settings, options);
    let algebra = problem.algebra.clone();
    let (dim, limit) = (algebra.dim(), TermLimit::default());
    let judge = Judge::of_problem(&problem, limit).expect("a judge");
    let velocity = problem.hamiltonian.gradient(dim);
    let integrator = Integrator::build(problem, limit).expect("an integrator");
    let step = Step::build(&integrator).expect("a kernel");
    let group = matrix_group(&algebra).expect("a group");
    let subject = Arc::new(Subject::new(step, group, backend));
    let text = format!("{system:?}");
    let draw = move |_: &mut Random| {
        let subject = Arc::clone(&subject);
        let steps =
            move |h: f64, _: &mut Random| Some(Instance::series(Runner::new(&subject, h, &[])?));
        Realisation {
            text: text.clone(),
            velocity: velocity.clone(),
            homogeneous: true,
            symbols: Vec::new(),
            promised: None,
            steps: Box::new(steps),
        }
    };
    Template { judge, draw: Box::new(draw) }
}

pub fn families(only: &str) -> Vec<Family> {
    let named = Backend::ALL.iter().map(|&backend| (format!("kernel-{}", backend.name()), backend));
    let chosen = named.filter(|(name, _)| name.contains(only));
    let family = |(name, backend)| {
        let models = SYSTEMS.iter().map(|&system| model(system, backend)).collect();
        instance::family(name, 128, Models { models, decades: 30.0, promise: false })
    };
    chosen.map(family).collect()
}
