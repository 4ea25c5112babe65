//! Errors of compiling and loading steps.

use std::path::PathBuf;

/// Errors of compiling and loading a step. Each is one line; the interpreter works without either.
#[derive(Debug, thiserror::Error)]
pub enum NativeError {
    /// No C compiler answers.
    #[error(
        "no C compiler was found (tried {tried}); install one, or name one in the environment variable CC"
    )]
    NoCompiler {
        /// The commands that were tried.
        tried: String,
    },
    /// The compiler that was asked for cannot be started.
    #[error("the C compiler '{compiler}' cannot be started: {source}")]
    Start {
        /// The command.
        compiler: String,
        /// The system's error.
        source: std::io::Error,
    },
    /// The compiler did not end in time and was ended.
    #[error("the C compiler '{compiler}' did not end within {seconds} s and was stopped")]
    TimedOut {
        /// The command.
        compiler: String,
        /// The time limit.
        seconds: f64,
    },
    /// The compiler was ended because its step is not wanted any more.
    #[error("the C compiler '{compiler}' was stopped")]
    Stopped {
        /// The command.
        compiler: String,
    },
    /// The compiler refused, or is broken.
    #[error("the C compiler '{compiler}' failed ({status}): {message}")]
    Failed {
        /// The command.
        compiler: String,
        /// Its exit status.
        status: String,
        /// The first line of what it said that tells of an error.
        message: String,
    },
    /// The compiler says that all is well, but wrote no library.
    #[error("the C compiler '{compiler}' wrote no library")]
    NoLibrary {
        /// The command.
        compiler: String,
    },
    /// No file can be written where the step was to be compiled.
    #[error("cannot write to {path}, where a step is compiled: {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The library cannot be loaded.
    #[error("the compiled step {path} cannot be loaded: {message}")]
    Load {
        /// The library.
        path: PathBuf,
        /// The message of the system's loader, or the defect of the library.
        message: String,
    },
}

/// The first lines of what a compiler said that tell of an error, else its first lines, in one line.
pub(crate) fn first_errors(log: &str) -> String {
    const LINES: usize = 3;
    const LONGEST: usize = 400;
    let lines = || log.lines().map(str::trim).filter(|line| !line.is_empty());
    let errors: Vec<&str> = lines().filter(|line| line.contains("error")).take(LINES).collect();
    let chosen = if errors.is_empty() { lines().take(LINES).collect() } else { errors };
    let text: String = chosen.join("; ").chars().take(LONGEST).collect();
    if text.is_empty() { "it said nothing".into() } else { text }
}

#[cfg(test)]
mod tests {
    use super::first_errors;

    #[test]
    fn a_log_becomes_one_line_about_the_error() {
        let log = "warning: a\n\n  x.cl:3: error: no such thing  \nnote: b\nerror: c\n";
        assert_eq!(first_errors(log), "x.cl:3: error: no such thing; error: c");
        assert_eq!(first_errors("nothing\nmore\n"), "nothing; more");
        assert_eq!(first_errors(" \n"), "it said nothing");
        assert!(first_errors(&"error ".repeat(1000)).len() <= 400);
    }
}
