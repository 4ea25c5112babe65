//! `coadjoint emit`: the integrator as a Rust module, as a header of C, or as a kernel for devices.

use std::path::PathBuf;

use coadjoint_codegen::file;
use coadjoint_codegen::system::Parameters;
use coadjoint_learn::ModelFile;
use coadjoint_program::Precision;
use coadjoint_run::Accuracy;
use coadjoint_run::emit::{Emittable, header, kernel, rust};

use crate::arguments::EmitOptions;
use crate::error::{CliError, unwritten};
use crate::named::Target;
use crate::{load, progress};

/// Writes the code to `--out` or the standard output.
pub(crate) fn run(options: &EmitOptions) -> Result<(), CliError> {
    let (step, precision) = (options.step, options.precision);
    let is_kernel = matches!(options.language, Target::Kernel(_));
    let header_only = "--prefix is for --language c and cpp alone";
    let kernel_only = |option| format!("{option} is for --language opencl and cuda alone");
    let folded = "--keep-parameters: the coefficients of a kernel are folded; leave it out";
    for (unfit, what) in [
        (options.prefix.is_some() && !matches!(options.language, Target::Header(_)), header_only),
        (step.is_some() && !is_kernel, &kernel_only("--step")),
        (precision == Precision::Single && !is_kernel, &kernel_only("--precision")),
        (options.keep_parameters && is_kernel, folded),
    ] {
        if unfit {
            return Err(CliError::Option(what.to_owned()));
        }
    }
    let (path, source) = source(options)?;
    let path = path.as_path();
    if let Some(out) = &options.out {
        // Refused before the derivation, which may take long.
        file::check(out, &[path]).map_err(unwritten(out))?;
    }
    let phase = progress::phase("deriving S and writing it");
    let text = match options.language {
        Target::Rust => rust(path, source)?,
        Target::Header(language) => header(path, source, language, options.prefix.clone())?,
        Target::Kernel(language) => kernel(path, source, step, precision, language)?,
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

/// The system or the model to be written, and the file it is from.
fn source(options: &EmitOptions) -> Result<(PathBuf, Emittable), CliError> {
    if let Some(path) = &options.input.model {
        return Ok((path.clone(), Emittable::Model(Box::new(ModelFile::load(path)?))));
    }
    let source = options.input.source(options.truncation);
    let parameters =
        if options.keep_parameters { Parameters::Kept } else { Parameters::Substituted };
    let asked = Accuracy { step: options.step, ..Accuracy::default() };
    let (mut system, choice) = load::settled(&source, &asked, parameters)?;
    let (problem, gave_way) = system.problem.settled();
    system.problem = problem;
    gave_way.iter().for_each(|reason| errln!("note: {}", reason.gave_way()));
    Ok((source.file, Emittable::System(Box::new(system), choice)))
}
