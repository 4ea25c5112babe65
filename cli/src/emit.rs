//! `coadjoint emit`: the integrator as a Rust module, as a header of C, or as a kernel for devices.

use coadjoint_codegen::file;
use coadjoint_codegen::system::Parameters;
use coadjoint_learn::ModelFile;
use coadjoint_run::emit::{Source, header, kernel, rust};

use crate::arguments::EmitOptions;
use crate::ensemble::PrecisionName;
use crate::error::{CliError, unwritten};
use crate::{load, progress};

/// Writes the code to `--out` or the standard output.
pub fn run(options: &EmitOptions) -> Result<(), CliError> {
    let language = options.language;
    if language.of_header().is_none() && options.prefix.is_some() {
        return Err(CliError::Option("--prefix is for --language c and cpp alone".into()));
    }
    if language.of_device().is_none() {
        check_unused(options)?;
    } else if options.keep_parameters {
        return Err(CliError::Option(
            "--keep-parameters: the coefficients of a kernel are folded; leave it out".into(),
        ));
    }
    let (path, source) = source(options)?;
    let path = path.as_path();
    if let Some(out) = &options.out {
        // Refused before the derivation, which may take long.
        file::check(out, &[path]).map_err(unwritten(out))?;
    }
    let phase = progress::phase("deriving S and writing it");
    let text = if let Some(language) = language.of_device() {
        kernel(path, source, options.step, options.precision.into(), language)?
    } else if let Some(language) = language.of_header() {
        header(path, source, language, options.prefix.clone())?
    } else {
        rust(path, source)?
    };
    drop(phase);
    match &options.out {
        Some(out) => file::write(out, &[path], text.as_bytes()).map_err(unwritten(out)),
        None => {
            out!("{text}");
            Ok(())
        }
    }
}

/// The source of the code to write, and the file it is from.
fn source(options: &EmitOptions) -> Result<(std::path::PathBuf, Source), CliError> {
    if let Some(path) = &options.input.model {
        return Ok((path.clone(), Source::Model(Box::new(ModelFile::load(path)?))));
    }
    let source = options.input.source();
    let parameters =
        if options.keep_parameters { Parameters::Kept } else { Parameters::Substituted };
    let (system, choice) = load::settled(&source, options.truncation, options.step, parameters)?;
    Ok((source.file, Source::System(Box::new(system), choice)))
}

/// Refuses options that mean something for kernels alone.
fn check_unused(options: &EmitOptions) -> Result<(), CliError> {
    let unused = match (options.step, options.precision) {
        (Some(_), _) => "--step",
        (None, PrecisionName::Single) => "--precision",
        (None, PrecisionName::Double) => return Ok(()),
    };
    Err(CliError::Option(format!("{unused} is for --language opencl and cuda alone")))
}
