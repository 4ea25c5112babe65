//! The backend that evaluates the programs of a step.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;
#[cfg(feature = "jit")]
use std::time::Instant;

use coadjoint_native::{COptions, Entry, Native};
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
    Cost { backend: Backend::Interpreter, ready: [0.0, 0.0], pace: [2.0, 7.5] };

/// Backends that compile.
const COMPILERS: &[Cost] = &[
    #[cfg(feature = "jit")]
    Cost { backend: Backend::Jit, ready: [4e-3, 8e-6], pace: [0.34, 1.6] },
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
    entry: Entry,
    name: String,
    ready: Duration,
}

/// The code that is on its way, shared with the thread that makes it.
#[derive(Debug, Default)]
struct Coming {
    made: OnceLock<Made>,
    notes: Mutex<Vec<String>>,
    /// No more is to be expected.
    over: AtomicBool,
    /// Ends a compiler that is at work.
    stop: Arc<AtomicBool>,
}

/// Programs ready to make steps: interpreted until there is machine code of them, if any is made. The bits are the same.
#[derive(Debug)]
pub(crate) struct Code {
    coming: Arc<Coming>,
    /// Runs the compiler.
    thread: Mutex<Option<JoinHandle<()>>>,
    interpreted: AtomicBool,
}

/// Steps that are made at a time while machine code is on its way.
const FEW: u64 = 256;

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
        let code = Self::interpreter();
        match backend {
            Backend::Interpreter => {}
            Backend::Auto => {
                let mut plan = plan(kernel, steps, trajectories);
                if plan.is_empty() {
                    // Of short runs again and again; a compiler that takes longer than these would be stopped by each.
                    plan = self::plan(kernel, steps + before, trajectories);
                    plan.retain(|backend| *backend != Backend::C);
                }
                if !plan.is_empty() {
                    return Ok(code.start(plan, kernel, trajectories));
                }
            }
            named => {
                let made = named.make(kernel, trajectories, &code.coming.stop);
                let made = made.map_err(|what| RunError::Option(format!("--backend: {what}")))?;
                let _ = code.coming.made.set(made);
            }
        }
        code.coming.over.store(true, Ordering::Relaxed);
        Ok(code)
    }

    fn interpreter() -> Self {
        let (coming, thread) = (Arc::default(), Mutex::default());
        Self { coming, thread, interpreted: AtomicBool::new(false) }
    }

    /// Has machine code made in the background, by the first of these backends that can.
    fn start(self, plan: Vec<Backend>, kernel: &Kernel, trajectories: Trajectories) -> Self {
        let (coming, kernel) = (self.coming.clone(), kernel.clone());
        let by_compiler = plan.first() == Some(&Backend::C);
        let work = move || {
            for backend in plan {
                match backend.make(&kernel, trajectories, &coming.stop) {
                    Ok(made) => {
                        let _ = coming.made.set(made);
                        break;
                    }
                    Err(_) if coming.stop.load(Ordering::Relaxed) => break,
                    Err(error) => {
                        let mut notes = coming.notes.lock().unwrap_or_else(PoisonError::into_inner);
                        notes.push(format!("{error}; the run goes on without it"));
                    }
                }
            }
            coming.over.store(true, Ordering::Relaxed);
        };
        match std::thread::Builder::new().spawn(work) {
            // Cranelift ends by itself, after half a second at most.
            Ok(thread) if by_compiler => {
                *self.thread.lock().unwrap_or_else(PoisonError::into_inner) = Some(thread);
            }
            Ok(_) => {}
            Err(_) => self.coming.over.store(true, Ordering::Relaxed),
        }
        self
    }

    /// Ends a compiler that is still at work: the run is over.
    pub(crate) fn stop(&self) {
        let thread = self.thread.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(thread) = thread {
            self.coming.stop.store(true, Ordering::Relaxed);
            // One that panicked has made nothing.
            let _ = thread.join();
        }
    }

    /// True if it is machine code, or will be even if the run ends before.
    pub(crate) fn lasts(&self) -> bool {
        let stays = || self.thread.lock().unwrap_or_else(PoisonError::into_inner).is_none();
        self.is_machine_code() || !self.coming.over.load(Ordering::Relaxed) && stays()
    }

    /// True if it is machine code.
    pub(crate) fn is_machine_code(&self) -> bool {
        self.coming.made.get().is_some()
    }

    /// The steps to make before the backend is chosen anew.
    pub(crate) fn at_a_time(&self) -> u64 {
        let over = self.is_machine_code() || self.coming.over.load(Ordering::Relaxed);
        if over { u64::MAX } else { FEW }
    }

    /// The backend that makes the steps now, in a few words.
    pub(crate) fn maker(&self) -> &str {
        self.coming.made.get().map_or("interpreter", |made| &made.name)
    }

    /// The backends that have made the steps, for reports.
    pub(crate) fn used(&self) -> Used {
        let first = self.is_machine_code() && self.interpreted.load(Ordering::Relaxed);
        let name = format!("{}{}", if first { "interpreter, then " } else { "" }, self.maker());
        Used { name, ready: self.coming.made.get().map(|made| made.ready) }
    }

    /// Notes on backends that are not available so far.
    pub(crate) fn notes(&self) -> Vec<String> {
        self.coming.notes.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// The stepper for the next steps of this kernel, from which the code is.
    pub(crate) fn stepper<'a>(&'a self, kernel: &'a Kernel) -> &'a dyn Stepper {
        match self.coming.made.get() {
            Some(made) => &made.entry,
            None => {
                if !self.interpreted.load(Ordering::Relaxed) {
                    self.interpreted.store(true, Ordering::Relaxed);
                }
                kernel
            }
        }
    }
}

impl Drop for Code {
    fn drop(&mut self) {
        self.stop();
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
            return Ok(Made { entry, name, ready: begun.elapsed() });
        }
        let options = COptions { trajectories, stop: stop.clone(), ..COptions::default() };
        let native = Native::by_c(kernel, &options).map_err(|error| error.to_string())?;
        let name = format!("machine code by {}", native.compiler);
        Ok(Made { entry: native.entry, name, ready: native.ready })
    }
}

/// The backends that take less time for this number of steps than the interpreter, the best one first.
fn plan(kernel: &Kernel, steps: f64, trajectories: Trajectories) -> Vec<Backend> {
    let operations = operations(kernel, 1);
    let work = steps * self::operations(kernel, (kernel.corrections / SPARE).max(1));
    let lanes = usize::from(trajectories == Trajectories::Lanes);
    let time = |cost: &Cost| {
        let [start, each] = cost.ready;
        start + operations * each + work * cost.pace[lanes] * 1e-9
    };
    let worth = |cost: &&Cost| {
        let small = cost.backend != Backend::C || operations <= MOST_FOR_COMPILER;
        small && time(cost) < time(&INTERPRETER)
    };
    let mut plan: Vec<&Cost> = COMPILERS.iter().filter(worth).collect();
    plan.sort_by(|a, b| time(a).total_cmp(&time(b)));
    plan.into_iter().map(|cost| cost.backend).collect()
}

/// The operations of a step of this number of corrections.
fn operations(kernel: &Kernel, corrections: u32) -> f64 {
    let Programs { guess, correct, accept, transport, .. } = &kernel.programs;
    let once =
        [guess, accept, transport].map(|program| program.nodes().len()).iter().sum::<usize>();
    once as f64 + f64::from(corrections) * correct.nodes().len() as f64
}
