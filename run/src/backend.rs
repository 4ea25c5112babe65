//! The backend that evaluates the programs of a step.

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;
#[cfg(feature = "jit")]
use std::time::Instant;

use coadjoint_native::{COptions, Entry, Native, Store};
use coadjoint_program::{Kernel, Programs, Stepper, Trajectories};

use crate::error::RunError;

/// The backend that makes the steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// Whatever is cheapest for this run: it begins on the interpreter and never waits for a compiler.
    #[default]
    Auto,
    /// The interpreter of the programs, which is always there.
    Interpreter,
    /// The system's C compiler, for this processor.
    C,
    /// Cranelift, for this processor.
    #[cfg(feature = "jit")]
    Jit,
}

/// The cost of steps by a backend; measured on a processor of 2022 (`docs/measurements/backends.md`,
/// `docs/measurements/python.md`), and enough to tell seconds from minutes.
struct Cost {
    backend: Backend,
    /// Seconds until it is ready: to start, and for each operation.
    ready: [f64; 2],
    /// Nanoseconds that an operation takes: of one trajectory, and of [`WIDTH`](coadjoint_program::WIDTH) side by side.
    pace: [f64; 2],
}

const INTERPRETER: Cost =
    Cost { backend: Backend::Interpreter, ready: [0.0, 0.0], pace: [7.0, 7.5] };

/// Backends that compile.
const COMPILERS: &[Cost] = &[
    #[cfg(feature = "jit")]
    Cost { backend: Backend::Jit, ready: [1.5e-3, 5e-6], pace: [0.34, 1.6] },
    Cost { backend: Backend::C, ready: [0.25, 2.2e-4], pace: [0.2, 0.6] },
];

/// Programs of more operations than this are not given to a C compiler unless it is named: its time grows faster.
const MOST_FOR_COMPILER: f64 = 40_000.0;

/// A kernel allows this many times the corrections that its steps usually take: 60 sweeps of collocation, of which 7 to 9 are made.
const SPARE: u32 = 8;

/// The backends that made the steps of a run.
#[derive(Clone, Debug)]
pub struct Used {
    /// In a few words.
    pub name: String,
    /// The time until it was ready, if it took any.
    pub ready: Option<Duration>,
}

/// Machine code, what made it, and how long that took.
#[derive(Debug)]
struct Made {
    backend: Backend,
    entry: Entry,
    name: String,
    ready: Duration,
}

/// The code that is on its way, shared with the thread that makes it.
#[derive(Debug, Default)]
struct Coming {
    /// The first machine code, and one that took longer to make and is faster.
    made: [OnceLock<Made>; 2],
    notes: Mutex<Vec<String>>,
    /// No more is to be expected.
    over: AtomicBool,
}

impl Made {
    fn by_c(Native { entry, compiler, ready }: Native) -> Self {
        let name = format!("machine code by {compiler}");
        Self { backend: Backend::C, entry, name, ready }
    }
}

impl Coming {
    /// The fastest machine code so far, and its place.
    fn best(&self) -> Option<(usize, &Made)> {
        (0..2).rev().find_map(|place| Some((place, self.made[place].get()?)))
    }

    fn put(&self, made: Made) {
        if let Err(better) = self.made[0].set(made) {
            let _ = self.made[1].set(better);
        }
    }
}

/// A thread that makes machine code in the background.
#[derive(Debug)]
struct Worker {
    thread: JoinHandle<()>,
    /// Ends it.
    stop: Arc<AtomicBool>,
    /// True while it runs a compiler, which must not be left behind; Cranelift ends by itself, after half a second at most.
    compiling: Arc<AtomicBool>,
}

impl Worker {
    fn end(self) {
        self.stop.store(true, Ordering::SeqCst);
        if self.compiling.load(Ordering::SeqCst) {
            // One that panicked has made nothing.
            let _ = self.thread.join();
        }
    }
}

/// Programs ready to make steps: interpreted until there is machine code of them, if any is made, by Cranelift until there is some by a C
/// compiler, if that is worth its time. The bits are the same.
#[derive(Debug)]
pub(crate) struct Code {
    coming: Arc<Coming>,
    /// The compiler that ends with the run that began it, and the one that goes on for later runs.
    workers: [Mutex<Option<Worker>>; 2],
    /// True once better machine code was asked for.
    improved: AtomicBool,
    trajectories: Trajectories,
}

/// Steps that are made at a time while machine code is on its way: by the interpreter, and by other machine code.
const FEW: [u64; 2] = [256, 1 << 14];

impl Code {
    /// By the backend asked for, to make about `steps` steps of trajectories one by one or side by side, and `before` that were made in
    /// other runs; trajectories not asked for are interpreted.
    ///
    /// # Errors
    /// Fails if the backend that the user named cannot be had.
    pub(crate) fn new(
        kernel: &Kernel,
        backend: Backend,
        [steps, before]: [f64; 2],
        trajectories: Trajectories,
    ) -> Result<Self, RunError> {
        let (coming, workers, improved) = Default::default();
        let code = Self { coming, workers, improved, trajectories };
        match backend {
            Backend::Interpreter => {}
            Backend::Auto => {
                let known = plan(kernel, steps, trajectories);
                // A compiler that takes longer than short runs, again and again, goes on between them.
                let lasting = known.is_empty();
                let plan = if lasting { plan(kernel, steps + before, trajectories) } else { known };
                if !plan.is_empty() {
                    code.start(plan, kernel, lasting);
                    return Ok(code);
                }
            }
            named => {
                let made = named.make(kernel, trajectories, &Arc::default());
                let made = made.map_err(|what| RunError::Option(format!("--backend: {what}")))?;
                code.coming.put(made);
            }
        }
        code.coming.over.store(true, Ordering::Relaxed);
        Ok(code)
    }

    /// Has machine code made in the background: as it was kept on disk, else by the best of these backends, of which the first one is the
    /// best, and one that is ready at once until then.
    fn start(&self, plan: Vec<Backend>, kernel: &Kernel, lasting: bool) {
        let (coming, kernel) = (self.coming.clone(), kernel.clone());
        let (trajectories, stop) = (self.trajectories, Arc::<AtomicBool>::default());
        let (best, stopped) = (plan.first().copied(), stop.clone());
        // Later runs need no better code, and do not ask why there is none.
        let needed = coming.best().is_none();
        let compiling = Arc::<AtomicBool>::default();
        let at_work = compiling.clone();
        coming.over.store(false, Ordering::Relaxed);
        let work = move || {
            let kept = Backend::kept(&kernel, trajectories);
            let mut order = if kept.is_some() { Vec::new() } else { plan };
            kept.into_iter().for_each(|made| coming.put(made));
            if best == Some(Backend::C) {
                order.reverse();
            }
            for backend in order {
                at_work.store(backend == Backend::C, Ordering::SeqCst);
                if stopped.load(Ordering::SeqCst) {
                    break;
                }
                match backend.make(&kernel, trajectories, &stopped) {
                    Ok(made) => {
                        coming.put(made);
                        if best == Some(backend) {
                            break;
                        }
                    }
                    Err(_) if stopped.load(Ordering::SeqCst) => break,
                    Err(error) if needed => {
                        let mut notes = coming.notes.lock().unwrap_or_else(PoisonError::into_inner);
                        notes.push(format!("{error}; the run goes on without it"));
                    }
                    Err(_) => {}
                }
            }
            coming.over.store(true, Ordering::Relaxed);
        };
        match std::thread::Builder::new().spawn(work) {
            Ok(thread) => {
                let own = &self.workers[usize::from(lasting || best != Some(Backend::C))];
                let worker = Worker { thread, stop, compiling };
                *own.lock().unwrap_or_else(PoisonError::into_inner) = Some(worker);
            }
            Err(_) => self.coming.over.store(true, Ordering::Relaxed),
        }
    }

    /// Has better machine code made for later steps, where all `steps` of runs so far and of this one are worth it.
    pub(crate) fn improve(&self, kernel: &Kernel, steps: f64) {
        let over = self.coming.over.load(Ordering::Relaxed);
        let known = self.coming.best().map(|(_, made)| made.backend);
        let known = known.filter(|known| over && *known != Backend::C);
        let worth = known.is_some_and(|by| worth_a_compiler(kernel, steps, self.trajectories, by));
        if worth && !self.improved.swap(true, Ordering::Relaxed) {
            self.start(vec![Backend::C], kernel, true);
        }
    }

    /// Ends the worker of a run that is over, or the one that goes on.
    fn end(&self, number: usize) {
        let worker = self.workers[number].lock().unwrap_or_else(PoisonError::into_inner).take();
        worker.into_iter().for_each(Worker::end);
    }

    /// True if it is machine code, or will be even if the run ends before.
    pub(crate) fn lasts(&self) -> bool {
        let goes_on = || {
            let ends = self.workers[0].lock().unwrap_or_else(PoisonError::into_inner).is_some();
            !ends && !self.coming.over.load(Ordering::Relaxed)
        };
        self.coming.best().is_some() || goes_on()
    }
}

impl Drop for Code {
    fn drop(&mut self) {
        (0..2).for_each(|number| self.end(number));
    }
}

/// The code of one run, whose own compiler ends with it.
#[derive(Debug)]
pub(crate) struct Running {
    code: Arc<Code>,
    /// The makers of steps so far, as bits: the interpreter, the first machine code, the better one.
    used: AtomicU8,
}

impl Running {
    pub(crate) fn new(code: Arc<Code>) -> Self {
        Self { code, used: AtomicU8::new(0) }
    }

    /// The steps to make before the backend is chosen anew.
    pub(crate) fn at_a_time(&self) -> u64 {
        let coming = &self.code.coming;
        let few = FEW[usize::from(coming.best().is_some())];
        if coming.over.load(Ordering::Relaxed) { u64::MAX } else { few }
    }

    /// The backend that makes the steps now, in a few words.
    pub(crate) fn maker(&self) -> &str {
        self.code.coming.best().map_or("interpreter", |(_, made)| &made.name)
    }

    /// The backends that have made the steps, for reports.
    pub(crate) fn used(&self) -> Used {
        let coming = &self.code.coming;
        let used = self.used.load(Ordering::Relaxed);
        let name = |place: usize| match place {
            0 => Some("interpreter"),
            _ => coming.made[place - 1].get().map(|made| made.name.as_str()),
        };
        let names: Vec<&str> =
            (0..3).filter(|place| used >> place & 1 == 1).filter_map(name).collect();
        let name = if names.is_empty() { self.maker().to_owned() } else { names.join(", then ") };
        Used { name, ready: coming.best().map(|(_, made)| made.ready) }
    }

    /// Notes on backends that are not available so far.
    pub(crate) fn notes(&self) -> Vec<String> {
        self.code.coming.notes.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The stepper for the next steps of this kernel, from which the code is.
    pub(crate) fn stepper<'a>(&'a self, kernel: &'a Kernel) -> &'a dyn Stepper {
        let best = self.code.coming.best();
        let bit = 1 << best.map_or(0, |(place, _)| place + 1);
        if self.used.load(Ordering::Relaxed) & bit == 0 {
            self.used.fetch_or(bit, Ordering::Relaxed);
        }
        match best {
            Some((_, made)) => &made.entry,
            None => kernel,
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.code.end(0);
    }
}

impl Backend {
    /// Makes machine code, or says why there is none.
    fn make(
        self,
        kernel: &Kernel,
        trajectories: Trajectories,
        stop: &Arc<AtomicBool>,
    ) -> Result<Made, String> {
        #[cfg(feature = "jit")]
        if self == Self::Jit {
            let begun = Instant::now();
            let entry = coadjoint_native::jit::compile(kernel, trajectories);
            let entry = entry.map_err(|error| error.to_string())?;
            let name = "machine code by Cranelift".to_owned();
            return Ok(Made { backend: self, entry, name, ready: begun.elapsed() });
        }
        let options = COptions { stop: stop.clone(), ..options(trajectories) };
        let native = Native::by_c(kernel, &options).map_err(|error| error.to_string())?;
        Ok(Made::by_c(native))
    }

    /// Machine code by the C compiler, where it is kept on disk.
    fn kept(kernel: &Kernel, trajectories: Trajectories) -> Option<Made> {
        is_for_compiler(kernel)
            .then(|| Native::kept(kernel, &options(trajectories)))?
            .map(Made::by_c)
    }
}

/// Options of C compilers: steps are kept on disk.
fn options(trajectories: Trajectories) -> COptions {
    static STORE: OnceLock<Option<Store>> = OnceLock::new();
    let store = STORE.get_or_init(Store::of_user).clone();
    COptions { trajectories, store, ..COptions::default() }
}

impl Cost {
    /// The seconds until this number of steps is made, compiling included.
    fn time(&self, kernel: &Kernel, steps: f64, trajectories: Trajectories) -> f64 {
        let [start, each] = self.ready;
        start + operations(kernel, 1) * each + self.steps(kernel, steps, trajectories)
    }

    /// The seconds that this number of steps takes.
    fn steps(&self, kernel: &Kernel, steps: f64, trajectories: Trajectories) -> f64 {
        let work = steps * operations(kernel, (kernel.corrections / SPARE).max(1));
        work * self.pace[usize::from(trajectories == Trajectories::Lanes)] * 1e-9
    }
}

/// False where programs are too large for a C compiler that is not named.
fn is_for_compiler(kernel: &Kernel) -> bool {
    operations(kernel, 1) <= MOST_FOR_COMPILER
}

/// The backends that take less time for this number of steps than the interpreter, the best one first.
fn plan(kernel: &Kernel, steps: f64, trajectories: Trajectories) -> Vec<Backend> {
    let time = |cost: &Cost| cost.time(kernel, steps, trajectories);
    let fits = |cost: &Cost| cost.backend != Backend::C || is_for_compiler(kernel);
    let worth = |cost: &&Cost| fits(cost) && time(cost) < time(&INTERPRETER);
    let mut plan: Vec<&Cost> = COMPILERS.iter().filter(worth).collect();
    plan.sort_by(|a, b| time(a).total_cmp(&time(b)));
    plan.into_iter().map(|cost| cost.backend).collect()
}

/// True if this number of steps takes longer by this machine code than to compile them by a C compiler and make them.
fn worth_a_compiler(kernel: &Kernel, steps: f64, trajectories: Trajectories, by: Backend) -> bool {
    let of = |backend: Backend| COMPILERS.iter().find(|cost| cost.backend == backend);
    of(by).zip(of(Backend::C)).is_some_and(|(now, then)| {
        let now = now.steps(kernel, steps, trajectories);
        is_for_compiler(kernel) && then.time(kernel, steps, trajectories) < now
    })
}

/// The operations of a step of this number of corrections.
fn operations(kernel: &Kernel, corrections: u32) -> f64 {
    let Programs { guess, correct, accept, transport, .. } = &kernel.programs;
    let once =
        [guess, accept, transport].map(|program| program.nodes().len()).iter().sum::<usize>();
    once as f64 + f64::from(corrections) * correct.nodes().len() as f64
}
