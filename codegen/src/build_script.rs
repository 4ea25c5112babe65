//! Integrators from a build script.

use std::path::{Path, PathBuf};

use crate::diagnostic::read_text;
use crate::emit;
use crate::file;
use crate::hamilton_jacobi::{DeriveError, TermLimit};
use crate::integrator::Kick;
use crate::lie::Chart;
use crate::step::Origin;
use crate::system::{self, Parameters};

/// Writes the integrator of a system file as a module into `OUT_DIR`, anew only when the file
/// changes.
///
/// In `Cargo.toml`, where the feature `system` is there by default:
///
/// ```toml
/// [build-dependencies]
/// coadjoint-codegen = "0.2" # or { version = "0.2", default-features = false, features = ["system"] }
/// ```
///
/// in `build.rs`:
///
/// ```no_run
/// fn main() -> Result<(), coadjoint_codegen::BuildError> {
///     coadjoint_codegen::Build::new("systems/heavy_top.toml").truncation(5).write("heavy_top.rs")?;
///     Ok(())
/// }
/// ```
///
/// and in the crate:
///
/// ```ignore
/// mod heavy_top {
///     include!(concat!(env!("OUT_DIR"), "/heavy_top.rs"));
/// }
/// ```
///
/// The parameters of the file become arguments of `new`, in the order of the file; `[initial]` and
/// `[run]` are not used. The module opens with a page that says how to read it.
#[derive(Clone, Debug)]
pub struct Build {
    input: PathBuf,
    options: system::Options,
    limit: TermLimit,
}

/// Errors of writing a module. A build script that returns one prints it.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// A file could not be read or written.
    #[error("{path}: {source}")]
    Io {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// `OUT_DIR` is not set.
    #[error("OUT_DIR is not set: call this from a build script, or use `write_to` with a path")]
    NoOutDir,
    /// The system file has mistakes.
    #[error("{0}")]
    System(String),
    /// The series could not be derived.
    #[error("{path}: {source}")]
    Derive {
        /// The system file.
        path: PathBuf,
        /// The reason.
        source: DeriveError,
    },
    /// The series is too large to compile.
    #[error("{}: {source}", .path.display())]
    Size {
        /// The system file.
        path: PathBuf,
        /// The number of terms and the limit.
        source: emit::TooManyTerms,
    },
}

/// `main` shows errors by `Debug`; what a user wants to read there is the message.
impl std::fmt::Debug for BuildError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}

impl Build {
    /// The integrator of the system file `input`, relative to the package.
    pub fn new(input: impl Into<PathBuf>) -> Self {
        let options = system::Options { parameters: Parameters::Kept, ..Default::default() };
        Self { input: input.into(), options, limit: TermLimit::default() }
    }

    /// Replaces the truncation of the file.
    #[must_use]
    pub fn truncation(mut self, truncation: usize) -> Self {
        self.options.truncation = Some(truncation);
        self
    }

    /// Replaces the chart of the file.
    #[must_use]
    pub fn chart(mut self, chart: Chart) -> Self {
        self.options.chart = Some(chart);
        self
    }

    /// Puts the parameters' values into the Hamiltonian: fewer coefficients, and `new` takes the
    /// step size alone.
    #[must_use]
    pub fn substitute_parameters(mut self) -> Self {
        self.options.parameters = Parameters::Substituted;
        self
    }

    /// Writes the module as `name` into `OUT_DIR` and tells cargo to come back only when the
    /// system file changes.
    ///
    /// # Errors
    /// [`BuildError`]: every mistake in the system file at once, with its line.
    pub fn write(&self, name: &str) -> Result<PathBuf, BuildError> {
        println!("cargo::rerun-if-changed={}", self.input.display());
        let directory = std::env::var_os("OUT_DIR").ok_or(BuildError::NoOutDir)?;
        let path = Path::new(&directory).join(name);
        self.write_to(&path)?;
        Ok(path)
    }

    /// Writes the module to `path`.
    ///
    /// # Errors
    /// [`BuildError`].
    pub fn write_to(&self, path: &Path) -> Result<(), BuildError> {
        let io = |path: &Path| {
            let path = path.to_owned();
            move |source| BuildError::Io { path, source }
        };
        let text = read_text(&self.input).map_err(io(&self.input))?;
        let name = self.input.display().to_string();
        let system = system::read_either(&text, self.options, &[])
            .map_err(|mistakes| BuildError::System(mistakes.render(&name, &text)))?;
        let refused = |why| BuildError::System(format!("{name}: {why}"));
        system.writable().map_err(refused)?;
        let options = emit::Options::for_problem(system.problem.facts().name);
        // As a run makes its steps, so does the module.
        let (hamiltonian, gave_way) = system.problem.settled();
        if let Some(reason) = gave_way {
            println!("cargo::warning={name}: {}", reason.gave_way());
        }
        let origin = Origin::derive(hamiltonian, self.limit)
            .map_err(|source| BuildError::Derive { path: self.input.clone(), source })?;
        let items = emit::items_of(&origin, &options)
            .map_err(|source| BuildError::Size { path: self.input.clone(), source })?;
        let mut module = emit::file(items);
        if let Some((potential, _)) = system.potential {
            module.push_str(&emit::potential_items(&Kick::build(potential), &options));
        }
        file::write(path, &[&self.input], module.as_bytes()).map_err(io(path))
    }
}
