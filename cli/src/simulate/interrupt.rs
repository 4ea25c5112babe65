//! Ctrl-C and requests to end, met between steps.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// The flags that signals set.
struct Flags {
    /// A signal has come while a run was guarded.
    asked: Arc<AtomicBool>,
    /// A signal ends the program at once, as it does by default.
    immediate: Arc<AtomicBool>,
}

fn flags() -> &'static Flags {
    static FLAGS: OnceLock<Flags> = OnceLock::new();
    FLAGS.get_or_init(|| {
        let flags = Flags {
            asked: Arc::new(AtomicBool::new(false)),
            immediate: Arc::new(AtomicBool::new(true)),
        };
        for signal in [SIGINT, SIGTERM] {
            // A signal that cannot be watched ends the program as usual; so does a second one.
            let _ = flag::register_conditional_default(signal, flags.immediate.clone());
            let _ = flag::register(signal, flags.asked.clone());
            let _ = flag::register(signal, flags.immediate.clone());
        }
        flags
    })
}

/// While it lives the first signal only asks the run to stop.
pub(crate) struct Guard(());

impl Guard {
    /// Begins to watch.
    pub(crate) fn new() -> Self {
        flags().asked.store(false, Ordering::SeqCst);
        flags().immediate.store(false, Ordering::SeqCst);
        Self(())
    }

    /// True once the run is to stop.
    pub(crate) fn asked(&self) -> bool {
        flags().asked.load(Ordering::Relaxed)
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        flags().immediate.store(true, Ordering::SeqCst);
    }
}
