//! How a step is compiled by a C compiler.

use std::ffi::OsString;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use coadjoint_program::Trajectories;

/// The name of the library that a compiler writes.
pub(super) const LIBRARY: &str = if cfg!(windows) { "step.dll" } else { "step.so" };

/// How a step is compiled by a C compiler.
#[derive(Clone, Debug)]
pub struct COptions {
    /// The compiler's command; without one that of the environment variable CC, else the first of `cc`, `gcc` and
    /// `clang` that answers.
    pub compiler: Option<OsString>,
    /// The time it may take.
    pub time_limit: Duration,
    /// Where compiled steps are kept.
    pub cache: CacheFolder,
    /// The trajectories compiled for: either half takes about half the time.
    pub trajectories: Trajectories,
    /// Set it from another thread to end the compiler and all that it has started.
    pub stop: Arc<AtomicBool>,
}

impl Default for COptions {
    fn default() -> Self {
        Self {
            compiler: None,
            time_limit: Duration::from_secs(120),
            cache: CacheFolder::User,
            trajectories: Trajectories::Both,
            stop: Arc::default(),
        }
    }
}

/// Where compiled steps are kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum CacheFolder {
    /// The user's: `coadjoint/native` in `$XDG_CACHE_HOME`, `~/.cache`, `~/Library/Caches` or `%LOCALAPPDATA%`.
    #[default]
    User,
    /// This one; it is made, for the user alone, where there is none.
    At(PathBuf),
    /// Nowhere: each run compiles.
    None,
}
