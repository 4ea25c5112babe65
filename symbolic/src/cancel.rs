//! Cancelling long work from another thread.
//!
//! Derivations are deep, and most of their functions cannot fail; so the loops in them look at a flag of their thread,
//! and once it is set the work unwinds, with [`Cancelled`] as payload and without a message. Whoever lends the flag
//! catches that. Work without a flag is never cancelled.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The payload with which cancelled work unwinds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// The flag of a thread's work, for other threads that share in it.
#[derive(Clone, Debug, Default)]
pub struct Token(Option<Arc<AtomicBool>>);

impl Token {
    /// Unwinds with [`Cancelled`] if the flag is set.
    pub fn check(&self) {
        if self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            resume_unwind(Box::new(Cancelled));
        }
    }
}

thread_local! {
    static CURRENT: RefCell<Token> = const { RefCell::new(Token(None)) };
}

/// Does the work, which unwinds with [`Cancelled`] at the next [`check`] once the flag is set.
///
/// ```
/// use coadjoint_symbolic::cancel::{Cancelled, check, scope};
/// use std::sync::{Arc, atomic::AtomicBool};
///
/// let work = |flag| std::panic::catch_unwind(|| scope(flag, || { check(); 1 }));
/// assert_eq!(work(Arc::new(AtomicBool::new(false))).unwrap(), 1);
/// assert!(work(Arc::new(AtomicBool::new(true))).unwrap_err().is::<Cancelled>());
/// check();
/// ```
pub fn scope<T>(flag: Arc<AtomicBool>, work: impl FnOnce() -> T) -> T {
    /// Gives the thread back the flag it had, also where the work unwinds.
    struct Before(Token);
    impl Drop for Before {
        fn drop(&mut self) {
            CURRENT.set(std::mem::take(&mut self.0));
        }
    }
    let _before = Before(CURRENT.replace(Token(Some(flag))));
    work()
}

/// The flag of this thread's work.
pub fn token() -> Token {
    CURRENT.with_borrow(Token::clone)
}

/// Unwinds with [`Cancelled`] if the flag of this thread's work is set. Costs a few nanoseconds.
pub fn check() {
    CURRENT.with_borrow(Token::check);
}
