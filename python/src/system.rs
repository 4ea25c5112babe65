//! Systems, and what can be done with them.

use std::collections::VecDeque;
use std::path::Path;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, PoisonError};

use coadjoint_codegen::drive::Drive;
use coadjoint_codegen::lie;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::smooth::{Facts, Functions};
use coadjoint_codegen::step::Energy;
use coadjoint_codegen::system::{Options, Run, with_values};
use coadjoint_codegen::tolerance::Choice;
use coadjoint_learn::table;
use coadjoint_run::ensemble::{
    Attitude, Course, Disturbance, Engine, Found, How, Known, Layout, Shape, Watch,
};
use coadjoint_run::simulate::{Event, Schedule, Setup, Single, Times, run};
use coadjoint_run::{
    Accuracy, Backend, Derivations, Derived, Grid, Instant, RunError, System, check, emit,
    inputs_hash, meet_tolerance, polynomial, read_given, series, velocities, verify,
};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use numpy::{PyArray1, PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::asked::{Asked, backend_of};
use crate::control::{Control, work};
use crate::emit::emitted;
use crate::error::{raised, raised_by, refused};
use crate::event::Watched;
use crate::function::{Callables, Failures, acting, input};
use crate::outcome::result_of;
use crate::record::{Keeper, Trace};
use crate::stepper::Stepper;

/// The most that records of one run may take in memory.
const MOST_BYTES: f64 = 8e9;
/// Single steps are compiled, whatever that takes: many of them are going to be made.
const MANY: f64 = 1e9;

/// A system that is known as text; never changed.
#[derive(Clone)]
#[pyclass(frozen, module = "coadjoint._core", name = "Core")]
pub struct Core {
    name: String,
    text: Arc<str>,
    system: System,
    /// Replacements for parts of the text: functions, and all inputs as they were at first reading.
    given: Functions,
    /// The failures of functions of Python.
    pub(crate) failures: Arc<Failures>,
    /// The systems derived so far.
    pub(crate) derived: Arc<Derivations>,
    /// The latest choices for tolerances, for calls that ask for the same.
    chosen: Arc<Mutex<VecDeque<Chosen>>>,
}

/// The parameters of an ensemble that vary, and the state along whose motion a tolerance is met where the text has none.
type Ensemble = (Vec<String>, Option<Vec<f64>>);

/// A request for an accuracy: what is asked for, the momentum at the start, and the ensemble, if it is one.
type Request = (Accuracy, Option<Vec<f64>>, Option<Ensemble>);

/// A request, and the choice made for it.
type Chosen = (Request, System, Option<Choice>);

/// Choices that are kept.
const CHOICES: usize = 16;

impl Core {
    /// A copy for another thread. Earlier failures of functions are forgotten.
    pub(crate) fn here(&self) -> Self {
        drop(self.failures.take());
        self.clone()
    }

    /// A system that is known as text elsewhere.
    pub(crate) fn of(name: String, text: Arc<str>, system: System) -> Self {
        let given = Functions { inputs: system.signals().to_vec(), ..Functions::default() };
        let (failures, derived, chosen) = Default::default();
        Self { name, text, system, given, failures, derived, chosen }
    }

    /// Raises the exception of a function of Python, if there was one.
    fn raise(&self, py: Python<'_>) -> PyResult<()> {
        self.failures.take().and_then(|failure| failure.cause).map_or(Ok(()), |cause| {
            let error = RunError::Option("a function of the system failed".to_owned());
            let error = raised(py, &error);
            error.set_cause(py, Some(cause));
            Err(error)
        })
    }

    /// The exception of a failure of this system.
    fn raised(&self, py: Python<'_>, error: &RunError) -> PyErr {
        raised_by(py, error, &self.failures)
    }

    /// A system of this text with its method, for runs or for ensembles, which is shared by all that is done with it.
    fn derive(
        &self,
        system: System,
        ensemble: bool,
        control: &Control,
    ) -> Result<Arc<Derived>, RunError> {
        control.deriving.store(true, Ordering::Relaxed);
        let made = self.derived.derive(self.path(), system, ensemble);
        control.deriving.store(false, Ordering::Relaxed);
        made
    }

    /// The system with the truncation and the step that these settings ask for; a sentence about a choice.
    fn accurate(
        &self,
        accuracy: &Accuracy,
        ensemble: Option<Ensemble>,
    ) -> Result<(System, Option<Choice>), RunError> {
        let request = (*accuracy, self.system.run.momentum.clone(), ensemble);
        let chosen = || self.chosen.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, system, choice)) = chosen().iter().find(|(known, ..)| *known == request) {
            return Ok((system.clone(), choice.clone()));
        }
        let (.., ensemble) = &request;
        let mut system = match ensemble {
            Some((varied, _)) if !varied.is_empty() => self.again(Options::default(), varied)?,
            _ => self.system.clone(),
        };
        let start = ensemble.iter().find_map(|(_, start)| start.clone());
        system.run.momentum = system.run.momentum.or(start);
        if let Some(truncation) = accuracy.truncation {
            system.problem.set_truncation(truncation);
        }
        let met = meet_tolerance(self.path(), &mut system, accuracy, &self.derived)?;
        let choice = met.map(|(choice, _)| choice);
        let mut chosen = chosen();
        chosen.truncate(CHOICES - 1);
        chosen.push_front((request, system.clone(), choice.clone()));
        Ok((system, choice))
    }

    /// The name of the system in messages.
    pub(crate) fn path(&self) -> &Path {
        Path::new(&self.name)
    }

    /// The run that the text asks for.
    pub(crate) fn run(&self) -> &Run {
        &self.system.run
    }

    /// The system of the same text and inputs, read otherwise.
    ///
    /// # Errors
    /// All mistakes.
    pub(crate) fn again(&self, options: Options, varied: &[String]) -> Result<System, RunError> {
        read_given(&self.name, &self.text, options, varied, &self.given)
    }

    /// The shape of a row.
    pub(crate) fn shape(&self) -> Shape {
        Shape::of_system(&self.system)
    }
}

#[pymethods]
impl Core {
    /// The truncation and the step that the system's own tolerance asks for, if it has one.
    fn choice(&self, py: Python<'_>) -> PyResult<Option<(usize, f64)>> {
        let here = self.here();
        let made = work(py, None, move |_| here.accurate(&Accuracy::default(), None))?;
        let (_, choice) = made.map_err(|error| self.raised(py, &error))?;
        Ok(choice.map(|choice| (choice.truncation, choice.step)))
    }

    /// Reads the text of a system file; one without a Hamiltonian where `functions` are the energy and its gradient, and with
    /// these functions as inputs, and as velocity and torque.
    #[new]
    #[pyo3(signature = (text, name, functions=None, inputs=Vec::new(), velocity=None, torque=None))]
    fn new(
        py: Python<'_>,
        text: String,
        name: String,
        functions: Option<(Py<PyAny>, Py<PyAny>)>,
        inputs: Vec<(String, Py<PyAny>)>,
        velocity: Option<Py<PyAny>>,
        torque: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let failures: Arc<Failures> = Arc::default();
        let energy = functions.map(|(energy, gradient)| {
            let name = energy.getattr(py, "__name__").and_then(|name| name.extract::<String>(py));
            let name = name.unwrap_or_else(|_| "energy".to_owned());
            (name, Callables::given(energy, gradient, failures.clone()))
        });
        let inputs = inputs.into_iter();
        let inputs = inputs.map(|(name, function)| input(name, function, failures.clone()));
        let inputs = inputs.collect();
        let own = |name, function: Option<Py<PyAny>>| {
            function.map(|function| acting(name, function, failures.clone()))
        };
        let acting = [own("the velocity", velocity), own("the torque", torque)];
        let given = Functions { energy, inputs, acting };
        let made = work(py, None, move |_| {
            let system = read_given(&name, &text, Options::default(), &[], &given)?;
            let made = Self::of(name, text.into(), system);
            let given = Functions { inputs: made.given.inputs, ..given };
            Ok(Self { given, failures, ..made })
        })?;
        made.map_err(|error: RunError| raised(py, &error))
    }

    /// This system with other values of parameters, flattened by rows, and its text: nothing that was derived or compiled for others is
    /// made anew.
    fn with_parameters(
        &self,
        py: Python<'_>,
        values: Vec<(String, Vec<f64>)>,
    ) -> PyResult<(Self, String)> {
        let mut all = Vec::new();
        for (name, own) in &values {
            let Some(parameter) = self.system.parameters.iter().find(|known| known.name == *name)
            else {
                return Err(refused(
                    py,
                    format!("parameters: the system has no parameter `{name}`"),
                ));
            };
            if own.len() != parameter.shape.len() || own.iter().any(|value| !value.is_finite()) {
                let what = format!(
                    "parameters: `{name}` is {} finite numbers; {own:?} was given",
                    parameter.shape.len()
                );
                return Err(refused(py, what));
            }
            all.push((parameter, &own[..]));
        }
        let (text, here) = (with_values(&self.text, &all), self.here());
        let made = work(py, None, move |_| {
            let names: Vec<String> = values.into_iter().map(|(name, _)| name).collect();
            let system = read_given(&here.name, &text, Options::default(), &names, &here.given)?;
            Ok((Self { system, text: text[..].into(), chosen: Arc::default(), ..here }, text))
        })?;
        made.map_err(|error: RunError| raised(py, &error))
    }

    /// Everything that the text says, and what follows from it.
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let System { problem, potential, run, units, parameters, .. } = &self.system;
        let Facts { name, algebra, coordinates, truncation, .. } = problem.facts();
        let facts = PyDict::new(py);
        facts.set_item("name", name)?;
        facts.set_item("group", algebra.name())?;
        facts.set_item("inputs_sha256", inputs_hash(self.system.signals()))?;
        let of_files = self.system.signals().iter().any(|signal| signal.columns.is_some());
        facts.set_item("inputs_of_files", of_files)?;
        facts.set_item("dimension", algebra.dim())?;
        facts.set_item("coordinates", coordinates)?;
        facts.set_item("truncation", truncation)?;
        facts.set_item("truncation_given", run.truncation.is_some())?;
        let known = PyDict::new(py);
        for parameter in parameters {
            let values = parameter.default.iter().flatten();
            for (scalar, value) in parameter.scalar_names().iter().zip(values) {
                known.set_item(scalar, value.to_string())?;
            }
        }
        facts.set_item("parameters", known)?;
        let polynomial = problem.polynomial();
        let hamiltonian = polynomial.map(|own| series::polynomial(own, &own.hamiltonian));
        let source = || problem.smooth().map(|smooth| smooth.source.clone());
        facts.set_item("chart", polynomial.map(|own| own.chart.name()))?;
        facts.set_item("comoving", polynomial.is_some_and(|own| own.comoving.is_some()))?;
        facts.set_item("hamiltonian", hamiltonian.or_else(source))?;
        facts.set_item("splitting", potential.as_ref().map(|(_, splitting)| splitting.name()))?;
        facts.set_item("step", run.step)?;
        facts.set_item("tolerance", run.tolerance)?;
        facts.set_item("time", run.time)?;
        facts.set_item("moves", self.system.depends_on_time())?;
        facts.set_item("damped", self.system.drive().is_some_and(Drive::is_dissipative))?;
        facts.set_item("every", run.every)?;
        facts.set_item("momentum", run.momentum.clone())?;
        facts.set_item("group_element", run.group_element.clone())?;
        facts.set_item("time_unit", units.time.clone())?;
        let of = |i| units.coordinate(i).map(str::to_owned);
        let of: Vec<Option<String>> = (0..algebra.dim()).map(of).collect();
        facts.set_item("units", of)?;
        facts.set_item("matrix_size", self.shape().matrix_size)?;
        Ok(facts)
    }

    /// One trajectory; a dictionary of arrays and facts.
    #[pyo3(signature = (asked, *, momentum, group_element, every, at, events, looks, backend, estimate, record, progress))]
    #[allow(clippy::too_many_arguments)]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        asked: Asked,
        momentum: Option<PyReadonlyArray1<'py, f64>>,
        group_element: Option<PyReadonlyArray2<'py, f64>>,
        every: Option<u64>,
        at: Option<PyReadonlyArray1<'py, f64>>,
        events: Vec<Watched>,
        looks: Option<u32>,
        backend: &str,
        estimate: bool,
        record: bool,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let accuracy = asked.accuracy(py)?;
        let backend = backend_of(py, backend)?;
        let vector = |array: PyReadonlyArray1<'py, f64>| array.as_array().to_vec();
        let given = &self.system.run;
        let start = accuracy.t0.unwrap_or(given.initial_time);
        let momentum = match momentum.map(vector) {
            Some(momentum) => Some(momentum),
            None => given.momentum_at(start).map_err(|what| refused(py, what))?,
        };
        let Some(momentum) = momentum else {
            return Err(refused(py, "momentum is missing: give momentum=[…]".to_owned()));
        };
        let rows = |array: PyReadonlyArray2<'py, f64>| -> Vec<Vec<f64>> {
            array.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
        };
        let group_element = group_element.map(rows).or_else(|| given.group_element.clone());
        let at = at.map(vector);
        // Times alone are recorded alone; a step count in the text is then no request.
        let every = match (every, &at) {
            (None, Some(_)) => None,
            (every, _) => Some(every.or(given.every.map(|n| n as u64)).unwrap_or(1)),
        };
        if every == Some(0) {
            return Err(refused(py, "every counts steps from 1; try every=1".to_owned()));
        }
        let size = self.shape().matrix_size;
        let own = given.events.iter().cloned().map(Event::of);
        let events: Vec<Event> = own
            .chain(events.into_iter().map(|event| event.event(size, self.failures.clone())))
            .collect();
        let looked_for = events.len();
        let terminal: Vec<bool> = events.iter().map(|event| event.terminal).collect();
        let looks = looks.or(given.looks.map(|looks| looks as u32)).unwrap_or(1);
        let mut here = self.here();
        here.system.run.momentum = Some(momentum.clone());
        let result = work(py, progress.as_ref(), move |control| {
            let (system, choice) = here.accurate(&accuracy, None)?;
            let schedule = Schedule::new(Path::new(&here.name), &accuracy, &system.run)?;
            let at = at.map(|at| Times::new(at, &schedule)).transpose();
            let at = at.map_err(|what| RunError::Option(format!("at: {what}")))?;
            let setup = Setup {
                recording: record,
                estimate: estimate && system.run.estimate != Some(false),
                choice: choice.clone(),
                every,
                at,
                events,
                looks,
                backend,
                group_element,
                ..Setup::new(schedule, momentum)
            };
            let size: f64 = record_size(&system, &setup);
            if size > MOST_BYTES {
                return Err(RunError::Option(format!(
                    "the records would take {:.0} GB of memory: keep every n-th step, every=…, or the times at=[…]",
                    size * 1e-9
                )));
            }
            let truncation = system.problem.facts().truncation;
            let derived = here.derive(system, false, control)?;
            control.total.store(schedule.steps, Ordering::Relaxed);
            let mut keeper = Keeper { table: Trace::default(), control };
            let outcome = run(&derived, &setup, &mut keeper)?;
            Ok((keeper.table, outcome, schedule, truncation, choice, derived.label()))
        })?;
        let (table, outcome, schedule, truncation, choice, label) =
            result.map_err(|error: RunError| self.raised(py, &error))?;
        let found = result_of(py, table, &outcome, &schedule)?;
        found.set_item("watched", looked_for)?;
        found.set_item("terminal", terminal)?;
        found.set_item("truncation", truncation)?;
        found.set_item("choice", choice.map(|choice| choice.to_string()))?;
        found.set_item("label", label)?;
        Ok(found)
    }

    /// Many trajectories: the states at the end, the rows that failed as (row, step, reason), and facts. The last columns of
    /// the states are those of the parameters that vary.
    #[pyo3(signature = (states, asked, *, parameters, inputs=Vec::new(), at, backend, threads, progress))]
    #[allow(clippy::type_complexity, clippy::too_many_arguments)]
    fn ensemble<'py>(
        &self,
        py: Python<'py>,
        states: PyReadonlyArray2<'py, f64>,
        asked: Asked,
        parameters: Vec<String>,
        inputs: Vec<(String, Vec<usize>, PyReadonlyArray1<'py, f64>)>,
        at: Option<PyReadonlyArray1<'py, f64>>,
        backend: &str,
        threads: Option<usize>,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Vec<(u64, u64, String)>, Bound<'py, PyDict>)> {
        let accuracy = asked.accuracy(py)?;
        let backend = backend_of(py, backend)?;
        let (count, width) = (states.shape()[0], states.shape()[1]);
        let values: Vec<f64> = states.as_array().iter().copied().collect();
        let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = threads.unwrap_or(processors);
        if threads == 0 || threads > 256.max(4 * processors) {
            let what =
                format!("threads={threads}: give a number from 1 to {}", 256.max(4 * processors));
            return Err(refused(py, what));
        }
        let at = at.map(|at| at.as_array().to_vec());
        let inputs = inputs.into_iter().map(|(input, shape, values)| Disturbance {
            input,
            shape,
            values: values.as_array().to_vec(),
        });
        let inputs: Vec<Disturbance> = inputs.collect();
        let here = self.here();
        let result = work(py, progress.as_ref(), move |control| {
            let path = Path::new(&here.name);
            let shape = here.shape();
            let dim = shape.dim.min(width);
            let layout =
                Found::of(shape, &Known::default(), &[], width.saturating_sub(parameters.len()))?;
            let layout = Layout { parameters, ..layout.layout };
            let varied = layout.varied();
            // The largest one is in the fastest motion.
            let momenta = values.chunks(width.max(1)).map(|row| &row[..dim]);
            let size = |momentum: &&[f64]| momentum.iter().map(|mu| mu * mu).sum::<f64>();
            let finite = momenta.filter(|momentum| size(momentum).is_finite());
            let fastest = finite.max_by(|a, b| size(a).total_cmp(&size(b)));
            let fastest = fastest.map(<[f64]>::to_vec);
            let (system, choice) = here.accurate(&accuracy, Some((varied.clone(), fastest)))?;
            let schedule = Schedule::new(path, &accuracy, &system.run)?;
            let at = at.map(|at| Times::new(at, &schedule)).transpose();
            let at = at.map_err(|what| RunError::Option(format!("at: {what}")))?;
            let duration = accuracy.time.or(system.run.time);
            let stops = at.map(|times| times.stops(&schedule)).unwrap_or_default();
            let course = Course { steps: schedule.steps, stops };
            let size = 8.0 * (count * width) as f64 * course.kept() as f64;
            if size > MOST_BYTES {
                return Err(RunError::Option(format!(
                    "the trajectories would take {:.0} GB of memory: give fewer times at=[…], or let the command write \
                     them to a file",
                    size * 1e-9
                )));
            }
            let truncation = system.problem.facts().truncation;
            let frame = system.problem.polynomial().map_or("collocation", Problem::frame_name);
            let momentum = system.run.momentum.clone();
            let derived = here.derive(system, true, control)?;
            let lanes = (count as f64 / coadjoint_program::WIDTH as f64).max(1.0);
            let how = How { backend, work: schedule.steps as f64 * lanes, device: None };
            derived.reaches(&schedule)?;
            derived.resolves(schedule.grid(), schedule.steps, momentum.as_deref())?;
            let engine = Engine::disturbed(&derived, schedule.grid(), how, (inputs, count))?;
            control.total.store(schedule.steps * count as u64, Ordering::Relaxed);
            // Threads of its own: those of a parent process are not there in a fork.
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let pool =
                pool.map_err(|error| RunError::Option(format!("threads={threads}: {error}")))?;
            let (values, failed, drift) = pool.install(|| {
                let made = |made: u64| control.done.store(made, Ordering::Relaxed);
                let watch = Watch { made: &made, stop: &control.stop };
                engine.advance_all(&layout, &course, &values, &watch)
            })?;
            let notes = engine.notes();
            Ok((
                values,
                failed,
                drift,
                (engine.backend(), engine.casimirs()),
                notes,
                layout.names().into_iter().take(layout.state()).collect::<Vec<_>>(),
                (schedule, duration),
                (truncation, frame),
                choice,
            ))
        })?;
        let (
            values,
            failed,
            drift,
            (backend, casimirs),
            notes,
            names,
            (schedule, duration),
            (truncation, frame),
            choice,
        ) = result.map_err(|error: RunError| self.raised(py, &error))?;
        self.raise(py)?;
        let rows = values.len().checked_div(width).unwrap_or(0);
        let array = values.into_pyarray(py).reshape([rows, width])?;
        let failed = failed.into_iter().map(|r| (r.row - 1, r.step, r.reason)).collect();
        let facts = PyDict::new(py);
        facts.set_item("spatial_momentum", drift.conserved.spatial_momentum)?;
        facts.set_item("casimirs", drift.conserved.casimirs)?;
        let why = if casimirs == 0 { "none known" } else { "rounding of large numbers hides it" };
        facts.set_item("unknown_casimirs", why)?;
        facts.set_item("ratio", drift.ratio)?;
        let warnings = drift.warnings(rows as u64, schedule.steps);
        facts.set_item("warnings", warnings.map(|warning| warning.text()).collect::<Vec<_>>())?;
        facts.set_item("backend", backend)?;
        facts.set_item("notes", notes)?;
        facts.set_item("columns", names)?;
        facts.set_item("step", schedule.step)?;
        facts.set_item("steps", schedule.steps)?;
        facts.set_item("t0", schedule.start)?;
        facts.set_item("time", duration)?;
        facts.set_item("announcement", schedule.announcement())?;
        facts.set_item("truncation", truncation)?;
        facts.set_item("frame", frame)?;
        facts.set_item("choice", choice.map(|choice| choice.to_string()))?;
        Ok((array, failed, facts))
    }

    /// The layouts of an ensemble's rows: the names of the columns with momenta alone, with matrices, and, for
    /// rotations, with quaternions.
    fn layouts(&self) -> Vec<Vec<String>> {
        let shape = self.shape();
        let mut forms = vec![Attitude::None, Attitude::Matrix];
        if shape.quaternions {
            forms.push(Attitude::Quaternion);
        }
        let layout = |attitude| Layout { shape, attitude, parameters: Vec::new() };
        forms.into_iter().map(|attitude| layout(attitude).names()).collect()
    }

    /// Which columns of a table are a state: the names of a row's numbers, the column of each (none where the number is
    /// 0), the columns that are no part of it, and how many of the last numbers are parameters that vary. A table without
    /// names is known by its width.
    #[allow(clippy::type_complexity)]
    fn columns(
        &self,
        py: Python<'_>,
        names: Option<Vec<String>>,
        width: usize,
    ) -> PyResult<(Vec<String>, Vec<Option<usize>>, Vec<String>, usize)> {
        let known = Known::of(&self.system.problem.facts(), &self.system.parameters);
        let found = Found::of(self.shape(), &known, &names.unwrap_or_default(), width);
        let found = found.map_err(|error| raised(py, &error))?;
        let varied = found.layout.parameters.len();
        Ok((found.layout.names(), found.places, found.unused, varied))
    }

    /// The parameters, each with its lengths: none of a number, two of a matrix.
    fn parameters(&self) -> Vec<(String, Vec<usize>)> {
        let parameters = self.system.parameters.iter();
        parameters.map(|parameter| (parameter.name.clone(), parameter.shape.lengths())).collect()
    }

    /// The inputs, each with the number of its samples: none of a function.
    fn inputs(&self) -> Vec<(String, usize)> {
        let signals = self.system.signals().iter();
        signals.map(|signal| (signal.name.clone(), signal.table()[0].len())).collect()
    }

    /// H at this time and these momenta, a row each; a potential is no part of it.
    fn hamiltonian<'py>(
        &self,
        py: Python<'py>,
        time: f64,
        momenta: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let energy = Energy::new(&self.system.problem);
        let rows = momenta.as_array();
        let found: Vec<f64> =
            rows.rows().into_iter().map(|row| energy.value(time, &row.to_vec())).collect();
        self.raise(py)?;
        Ok(found.into_pyarray(py))
    }

    /// The velocities g⁻¹ġ at these times and momenta, a row each. `matrices` has the elements, a row each, row by row; a width
    /// of 0 serves where no velocity reads them.
    fn velocities<'py>(
        &self,
        py: Python<'py>,
        times: PyReadonlyArray1<'py, f64>,
        momenta: PyReadonlyArray2<'py, f64>,
        matrices: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let problem = &self.system.problem;
        let dim = problem.facts().algebra.dim();
        let [count, width] = [momenta.shape()[0], momenta.shape()[1]];
        if width != dim {
            return Err(refused(py, format!("momenta have {width} numbers; {dim} are needed")));
        }
        let rows = |array: PyReadonlyArray2<'py, f64>| -> Vec<Vec<f64>> {
            array.as_array().rows().into_iter().map(|row| row.to_vec()).collect()
        };
        let (momenta, matrices) = (rows(momenta), rows(matrices));
        let instants = times.as_array().into_iter().zip(&momenta).zip(&matrices);
        let instants: Vec<Instant<'_>> = instants
            .map(|((&time, momentum), matrix)| Instant { time, matrix, momentum })
            .collect();
        let found = velocities(&self.system, &instants);
        self.raise(py)?;
        found.concat().into_pyarray(py).reshape([count, dim])
    }

    /// Steps of this size, ready to be made, that are given the parameters with these names.
    fn stepper(
        &self,
        py: Python<'_>,
        step: Option<f64>,
        backend: &str,
        varied: Vec<String>,
    ) -> PyResult<Stepper> {
        let backend = backend_of(py, backend)?;
        let here = self.here();
        let dimension = self.system.problem.facts().algebra.dim();
        let made = work(py, None, move |control| {
            let several = !varied.is_empty();
            let ensemble = several.then_some((varied, None));
            let (system, _) = here.accurate(&Accuracy { step, ..Accuracy::default() }, ensemble)?;
            let step = step
                .or(system.run.step)
                .ok_or_else(|| RunError::Option("--step is missing: give --step 0.1".to_owned()))?;
            let derived = here.derive(system, several, control)?;
            // It is the default, and there is no such code for collocation.
            let by_default = backend == Backend::Jit && derived.series().is_none();
            let backend = if by_default { Backend::Auto } else { backend };
            Single::new(derived, step, backend, MANY)
        })?;
        let single = made.map_err(|error| self.raised(py, &error))?;
        let failures = self.failures.clone();
        Ok(Stepper { single: Arc::new(single), dimension, failures })
    }

    /// The exact series as `text`, `json` or `latex`.
    fn series(&self, py: Python<'_>, form: String, truncation: Option<usize>) -> PyResult<String> {
        let (name, mut system) = (self.name.clone(), self.system.clone());
        if let Some(truncation) = truncation {
            system.problem.set_truncation(truncation);
        }
        let made = work(py, None, move |_| {
            let instead = "simulate, ensemble and check make them";
            let problem =
                polynomial(Path::new(&name), system, "there is no series", instead)?.problem;
            let series = series::Expansion::derive(Path::new(&name), problem)?;
            Ok(match form.as_str() {
                "latex" => series::latex(&series),
                "json" => series::json(&series),
                _ => series::text(&series),
            })
        })?;
        made.map_err(|error: RunError| self.raised(py, &error))
    }

    /// The generating Casimirs up to this degree, as text.
    fn casimirs(&self, py: Python<'_>, degree: u32) -> PyResult<Vec<String>> {
        let problem = self.system.problem.clone();
        let made = work(py, None, move |_| {
            let Facts { algebra, coordinates, .. } = problem.facts();
            let found = lie::casimirs(algebra, degree).map_err(|error| error.to_string())?;
            Ok(found.iter().map(|casimir| series::sum(casimir, coordinates, &[])).collect())
        })?;
        made.map_err(|error: String| refused(py, format!("{error}; give a smaller degree=")))
    }

    /// The laws: (name, statement, value, bound, holds) each, none where that could not be measured, and a warning.
    #[allow(clippy::type_complexity)]
    fn check(
        &self,
        py: Python<'_>,
        step: Option<f64>,
        t0: Option<f64>,
        points: usize,
        seed: u64,
    ) -> PyResult<(Vec<(String, String, f64, f64, Option<bool>)>, Option<String>)> {
        let here = self.here();
        let made = work(py, None, move |control| {
            let asked = Accuracy { step, t0, ..Accuracy::default() };
            let (system, _) = here.accurate(&asked, None)?;
            let trial = check::Trial::new(&asked, &system.run, points, seed)?;
            let derived = here.derive(system, false, control)?;
            let (laws, steep) = check::check(&derived, &trial)?;
            let law = |law: check::Law| {
                let holds = match law.verdict {
                    check::Verdict::NotMeasured(_) => None,
                    verdict => Some(verdict == check::Verdict::Holds),
                };
                (law.name.to_owned(), law.statement.to_owned(), law.value, law.bound, holds)
            };
            let laws = laws.into_iter().map(law).collect();
            Ok((laws, steep.map(check::steep).or_else(|| check::unmeasured(&derived))))
        })?;
        made.map_err(|error: RunError| self.raised(py, &error))
    }

    /// Judges rows with these names, or pairs of states without names, in doubled precision; what was found, as JSON.
    #[pyo3(signature = (rows, names, *, starts, t0, steps, step, truncation, refused_rows))]
    #[allow(clippy::too_many_arguments)]
    fn verify<'py>(
        &self,
        py: Python<'py>,
        rows: PyReadonlyArray2<'py, f64>,
        names: Vec<String>,
        starts: Option<PyReadonlyArray2<'py, f64>>,
        t0: f64,
        steps: u64,
        step: f64,
        truncation: usize,
        refused_rows: Vec<u64>,
    ) -> PyResult<String> {
        if let Some(why) = verify::unjudged(&self.system) {
            return Err(refused(py, why.to_owned()));
        }
        let (name, mut system) = (self.name.clone(), self.system.clone());
        system.problem.set_truncation(truncation);
        let given = |rows: &PyReadonlyArray2<'_, f64>| {
            let values = rows.as_array().iter().copied().collect();
            (rows.shape()[1], values)
        };
        let (rows, starts) = (given(&rows), starts.map(|starts| given(&starts)));
        let made = work(py, None, move |_| -> Result<_, RunError> {
            let path = Path::new(&name);
            let problem = system.problem.settled().0;
            let judge = verify::judge_of(path, &problem)?;
            let grid = Grid { start: t0, step };
            let follower = verify::Follower::new(&judge, &problem, grid)?;
            let of = |(width, values): (usize, Vec<f64>)| {
                table::Table::of_rows(path, names.clone(), width, values)
            };
            let mut rows = of(rows);
            let found = match starts.map(of) {
                None => follower.rows(&mut rows)?,
                Some(mut starts) => {
                    let refused = refused_rows.into_iter().collect();
                    follower.pairs(&mut starts, &mut rows, steps, &refused)?
                }
            };
            Ok(serde_json::Value::Object(found.object()).to_string())
        })?;
        made.map_err(|error| self.raised(py, &error))
    }

    /// The system as code.
    fn emit(
        &self,
        py: Python<'_>,
        language: &str,
        prefix: Option<String>,
        step: Option<f64>,
        single: bool,
    ) -> PyResult<String> {
        let (here, language) = (self.here(), language.to_owned());
        let made = work(py, None, move |_| {
            let (system, choice) =
                here.accurate(&Accuracy { step, ..Accuracy::default() }, None)?;
            let source = emit::Emittable::System(Box::new(system), choice);
            emitted(&here.name, source, &language, prefix, step, single)
        })?;
        made.map_err(|error| self.raised(py, &error))
    }
}

/// Bytes of the records of a run, about.
fn record_size(system: &System, setup: &Setup) -> f64 {
    let grid = setup.every.map_or(0.0, |every| setup.schedule.steps as f64 / every as f64);
    let times = setup.at.as_ref().map_or(0, |times| times.0.len()) as f64;
    let algebra = system.problem.facts().algebra;
    let entries: usize = algebra.factors().iter().map(|factor| factor.matrix_size().pow(2)).sum();
    if setup.recording {
        8.0 * (grid + times) * (2 * algebra.dim() + entries + 5) as f64
    } else {
        0.0
    }
}
