//! Steps compiled by the system's C compiler.
//!
//! The text of a kernel is compiled in a private folder, loaded, and cached by content. If the cache cannot be used,
//! the step is compiled anyway.

mod cache;
mod compiler;
mod machine;
mod options;
mod process;

use std::path::Path;
use std::time::{Duration, Instant};

use coadjoint_program::Kernel;
use coadjoint_program::print::native_unit;
use tempfile::TempDir;

use cache::Cache;
use compiler::Compiler;
pub use options::{COptions, CacheFolder};

use crate::entry::Entry;
use crate::error::NativeError;
use crate::library::load;

/// A step as machine code, and its origin.
#[derive(Clone, Debug)]
pub struct Native {
    /// The step.
    pub entry: Entry,
    /// The command of the compiler.
    pub compiler: String,
    /// Whether it was compiled by an earlier run.
    pub cached: bool,
    /// The time until it was ready.
    pub ready: Duration,
}

impl Native {
    /// The step of a kernel, compiled by a C compiler with the machine's own instructions; the bits are those of
    /// the interpreter.
    ///
    /// # Errors
    /// [`NativeError`] where there is no compiler, it fails, is stopped or does not end in time, no temporary file can be written, or
    /// the library cannot be loaded. A cache that cannot be used is no error.
    pub fn by_c(kernel: &Kernel, options: &COptions) -> Result<Self, NativeError> {
        let start = Instant::now();
        let folder = private_folder()?;
        let compiler = Compiler::find(options, folder.path())?;
        let text = native_unit(kernel, options.trajectories);
        let load = |library: &Path| load(kernel, options.trajectories, library);
        let done = |entry, cached| Self {
            entry,
            compiler: compiler.name(),
            cached,
            ready: start.elapsed(),
        };
        let kept =
            Cache::open(&options.cache).zip(machine::processor()).map(|(cache, processor)| {
                let flags = Compiler::flags().join(" ");
                let version = env!("CARGO_PKG_VERSION");
                let name = compiler.name();
                (
                    cache,
                    cache::key(&[version, &text, &name, compiler.version(), &flags, &processor]),
                )
            });
        if let Some((cache, key)) = &kept {
            let loaded = cache.get(key).and_then(|library| load(&library).ok());
            if let Some(entry) = loaded {
                return Ok(done(entry, true));
            }
        }
        let library = compiler.compile(&text, folder.path())?;
        let entry = kept
            .and_then(|(cache, key)| cache.put(&key, &library).ok())
            .and_then(|library| load(&library).ok());
        match entry {
            Some(entry) => Ok(done(entry, false)),
            None => {
                let entry = load(&library)?;
                if cfg!(windows) {
                    // A loaded library needs its file no more, except there.
                    let _ = folder.keep();
                }
                Ok(done(entry, false))
            }
        }
    }
}

/// A folder for this user alone, removed when it is dropped.
fn private_folder() -> Result<TempDir, NativeError> {
    tempfile::Builder::new()
        .prefix("coadjoint-")
        .tempdir()
        .map_err(|source| NativeError::Write { path: std::env::temp_dir(), source })
}
