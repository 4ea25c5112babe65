//! Work beside Python: it can be interrupted, and tells how far it has come.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use coadjoint_codegen::cancel;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::worker;

/// Signals are looked at this often.
const LOOK: Duration = Duration::from_millis(20);
/// Work that is asked to stop is waited for this long; what has not come back by then ends unheard.
const PATIENCE: Duration = Duration::from_millis(40);
/// Deriving that takes longer is told to the logger `coadjoint`.
const LONG: Duration = Duration::from_secs(1);
/// The interval at which a listener is called.
const TELL: Duration = Duration::from_millis(100);

/// The channel between the work and the thread that waits for it.
#[derive(Debug, Default)]
pub struct Control {
    /// Set to end the work: it unwinds, where it does not look at this itself.
    pub stop: Arc<AtomicBool>,
    /// Steps made.
    pub done: AtomicU64,
    /// Steps to be made; 0 while that is not known.
    pub total: AtomicU64,
    /// True while steps are derived.
    pub deriving: AtomicBool,
}

struct Shared<T> {
    control: Control,
    result: Mutex<Option<std::thread::Result<T>>>,
    ready: Condvar,
}

/// Does the work in a thread of its own with the interpreter released, and comes back with its result or, within a tenth
/// of a second, with KeyboardInterrupt. `progress` is called with (done, total).
///
/// # Errors
/// An exception that a signal handler or `progress` raised.
pub fn work<T: Send + 'static>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    job: impl FnOnce(&Control) -> T + Send + 'static,
) -> PyResult<T> {
    let shared = Arc::new(Shared {
        control: Control::default(),
        result: Mutex::new(None),
        ready: Condvar::new(),
    });
    let theirs = shared.clone();
    let beside = move |rest: &dyn Fn()| {
        let cancelled = theirs.control.stop.clone();
        let work = || cancel::scope(cancelled, || job(&theirs.control));
        let result = catch_unwind(AssertUnwindSafe(work));
        // The next call may come as soon as this one has its result.
        rest();
        *theirs.result.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        theirs.ready.notify_all();
    };
    worker::start(Box::new(beside))
        .map_err(|error| PyRuntimeError::new_err(format!("no thread can be started: {error}")))?;
    let wait = |time: Duration| {
        let guard = shared.result.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = shared.ready.wait_timeout_while(guard, time, |result| result.is_none());
        waited.map_or_else(|error| error.into_inner().0.take(), |(mut guard, _)| guard.take())
    };
    let tell = |progress: &Bound<'_, PyAny>| {
        let Control { done, total, .. } = &shared.control;
        progress.call1((done.load(Ordering::Relaxed), total.load(Ordering::Relaxed))).map(drop)
    };
    let (mut told, mut since, mut silent) = (Instant::now(), None, true);
    loop {
        if let Some(result) = py.detach(|| wait(LOOK)) {
            if let Some(progress) = progress {
                tell(progress)?;
            }
            return result.map_err(|panic| {
                let what = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
                let what = what.or_else(|| panic.downcast_ref::<String>().cloned());
                PyRuntimeError::new_err(format!(
                    "coadjoint failed unexpectedly, which is a mistake of its own: {}",
                    what.unwrap_or_default()
                ))
            });
        }
        let mut outcome = py.check_signals();
        if !shared.control.deriving.load(Ordering::Relaxed) {
            since = None;
        } else if silent && since.get_or_insert_with(Instant::now).elapsed() > LONG {
            silent = false;
            let logger = py.import("logging")?.call_method1("getLogger", ("coadjoint",))?;
            let what =
                "deriving the steps takes more than a second; the next run of this system has them";
            logger.call_method1("warning", (what,))?;
        }
        if let Some(progress) = progress.filter(|_| outcome.is_ok() && told.elapsed() >= TELL) {
            outcome = tell(progress);
            told = Instant::now();
        }
        if let Err(error) = outcome {
            shared.control.stop.store(true, Ordering::Relaxed);
            py.detach(|| wait(PATIENCE));
            return Err(error);
        }
    }
}
