//! `coadjoint emit`: the integrator as a Rust module, or as a header of C.

use std::path::Path;

use coadjoint_codegen::emit::c::{self, HeaderOptions, Language};
use coadjoint_codegen::emit::{Options, check_size, file, potential_items};
use coadjoint_codegen::integrator::Kick;
use coadjoint_codegen::system::Parameters;

use crate::arguments::EmitOptions;
use crate::error::CliError;
use crate::{emit_device, load, model, progress};

/// Writes the module or the header to `--out` or the standard output.
pub fn run(options: &EmitOptions) -> Result<(), CliError> {
    if options.language.of_header().is_none() && options.prefix.is_some() {
        return Err(CliError::Option("--prefix is for --language c and cpp alone".into()));
    }
    if let Some(language) = options.language.of_device() {
        return emit_device::run(options, language);
    }
    emit_device::check_unused(options)?;
    if let Some(language) = options.language.of_header() {
        return header(options, language);
    }
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
    write(options.out.as_deref(), &module)
}

/// To the file, or to the standard output.
fn write(path: Option<&Path>, text: &str) -> Result<(), CliError> {
    match path {
        Some(path) => std::fs::write(path, text)
            .map_err(|error| CliError::Write { path: path.into(), message: error.to_string() }),
        None => {
            out!("{text}");
            Ok(())
        }
    }
}

/// Writes the header.
fn header(options: &EmitOptions, language: Language) -> Result<(), CliError> {
    let source = options.input.source();
    let style = HeaderOptions { language, ..HeaderOptions::default() };
    let (file, problem, style) = match &options.input.model {
        Some(path) => {
            let model = coadjoint_learn::ModelFile::load(path)?;
            let problem = coadjoint_learn::problem(&model, "learned")?;
            (path, problem, HeaderOptions { only_step: Some(model.step), ..style })
        }
        None => {
            let parameters =
                if options.keep_parameters { Parameters::Kept } else { Parameters::Substituted };
            let system = load::source(&source, options.truncation, parameters)?;
            if system.potential.is_some() {
                return Err(CliError::Option(format!(
                    "{}: the kicks of a potential are not written as C: emit Rust, or leave `potential` out",
                    source.file.display()
                )));
            }
            let units = system.units;
            let of = |i| units.coordinate(i).map(str::to_owned);
            let momentum = (0..system.problem.algebra.dim()).map(of).collect();
            let time = units.time.clone();
            (&source.file, system.problem, HeaderOptions { time, momentum, ..style })
        }
    };
    let prefix = options.prefix.clone().unwrap_or_else(|| problem.name.clone());
    let phase = progress::phase(&format!("deriving S for K = {}", problem.truncation));
    let integrator = load::integrator(file, problem)?;
    drop(phase);
    let phase = progress::phase("writing the header");
    let text = c::header(&integrator, &HeaderOptions { prefix, ..style })
        .map_err(|error| CliError::Header { file: file.clone(), source: error })?;
    drop(phase);
    write(options.out.as_deref(), &text)
}
