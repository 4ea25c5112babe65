//! `emit --model`: a learned polynomial as code.

use std::path::Path;

use coadjoint_codegen::emit::{Options, file};
use coadjoint_learn::{ModelFile, problem};

use crate::error::CliError;
use crate::load;

/// The Rust module of a learned polynomial: built with the model's step it is the model.
pub fn emit(path: &Path, out: Option<&Path>) -> Result<(), CliError> {
    let model = ModelFile::load(path)?;
    let problem = problem(&model, "learned")?;
    let style = Options::for_problem(&problem.name);
    let integrator = load::integrator(path, problem)?;
    let module = format!(
        "//! Learned for the step {step}: build it with `new({step})`; other steps mean nothing.\n{}",
        file(&integrator, &style),
        step = model.step
    );
    match out {
        Some(path) => std::fs::write(path, module)
            .map_err(|error| CliError::Write { path: path.into(), message: error.to_string() }),
        None => {
            out!("{module}");
            Ok(())
        }
    }
}
