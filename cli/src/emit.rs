//! `coadjoint emit`: the integrator as a Rust module.

use coadjoint_codegen::emit::{Options, check_size, file, potential_items};
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::system::Parameters;

use crate::arguments::EmitOptions;
use crate::error::CliError;
use crate::{emit_device, load, model, progress};

/// Writes the module to `--out` or the standard output.
pub fn run(options: &EmitOptions) -> Result<(), CliError> {
    if let Some(language) = options.language.of_device() {
        return emit_device::run(options, language);
    }
    emit_device::check_unused(options)?;
    if let Some(path) = &options.input.model {
        return model::emit(path, options.out.as_deref());
    }
    let source = options.input.source();
    let parameters =
        if options.keep_parameters { Parameters::Kept } else { Parameters::Substituted };
    let system = load::source(&source, options.truncation, parameters)?;
    let style = Options::for_problem(&system.problem.name);
    let phase = progress::phase(&format!("deriving S for K = {}", system.problem.truncation));
    let integrator = load::integrator(&source.file, system.problem)?;
    drop(phase);
    check_size(&integrator)
        .map_err(|error| CliError::Size { file: source.file.clone(), source: error })?;
    let phase = progress::phase("writing the module");
    let mut module = file(&integrator, &style);
    if let Some((potential, _)) = system.potential {
        module.push_str(&potential_items(&Kick::build(potential), &style));
    }
    drop(phase);
    match &options.out {
        Some(path) => std::fs::write(path, module)
            .map_err(|error| CliError::Write { path: path.clone(), message: error.to_string() }),
        None => {
            out!("{module}");
            Ok(())
        }
    }
}
