//! `coadjoint emit --language opencl|cuda`: the steps as a kernel.

use coadjoint::Exponential;
use coadjoint_codegen::system::Parameters;
use coadjoint_learn::{ModelFile, problem};
use coadjoint_program::print::DeviceLanguage;

use crate::arguments::EmitOptions;
use crate::engine::{Interpreter, device_text, whole_group};
use crate::ensemble::PrecisionName;
use crate::error::CliError;
use crate::{load, progress};

/// Refuses options that mean something for kernels alone.
pub fn check_unused(options: &EmitOptions) -> Result<(), CliError> {
    let unused = match (options.step, options.precision) {
        (Some(_), _) => "--step",
        (None, PrecisionName::Single) => "--precision",
        (None, PrecisionName::Double) => return Ok(()),
    };
    Err(CliError::Option(format!("{unused} is for --language opencl and cuda alone")))
}

/// Writes the kernel to `--out` or the standard output.
pub fn run(options: &EmitOptions, language: DeviceLanguage) -> Result<(), CliError> {
    if options.keep_parameters {
        return Err(CliError::Option(
            "--keep-parameters: the coefficients of a kernel are folded; leave it out".into(),
        ));
    }
    let (file, problem, step) = match &options.input.model {
        Some(path) => {
            if options.step.is_some() {
                return Err(CliError::Option("--step: a learned model has its own".into()));
            }
            let model = ModelFile::load(path)?;
            (path.clone(), problem(&model, "learned")?, model.step)
        }
        None => {
            let source = options.input.source();
            let system = load::source(&source, options.truncation, Parameters::Substituted)?;
            if system.potential.is_some() {
                return Err(CliError::Option(format!(
                    "{}: the kicks of a potential are not written as kernels: emit Rust, or leave `potential` out",
                    source.file.display()
                )));
            }
            let step = options.step.or(system.run.step).ok_or_else(|| CliError::Missing {
                file: source.file.clone(),
                key: "[integrator] step",
                example: "step = 0.1",
                option: "--step 0.1",
            })?;
            (source.file, system.problem, step)
        }
    };
    let phase = progress::phase(&format!("deriving S for K = {}", problem.truncation));
    let integrator = load::integrator(&file, problem)?;
    drop(phase);
    let problem = &integrator.problem;
    // Coefficients are those of the step, whatever the group's elements are made of.
    let group = whole_group(&file, &problem.algebra, None)?;
    let interpreter = Interpreter::<_, Exponential>::new(&integrator, group, step)
        .map_err(|source| CliError::Step { time: 0.0, source })?;
    let about = format!(
        "{} on {}, {} chart, K = {}, step {step}.\nWritten by coadjoint {}.",
        problem.name,
        problem.algebra.name(),
        problem.chart,
        problem.truncation,
        env!("CARGO_PKG_VERSION"),
    );
    let text = device_text(&interpreter, options.precision.into(), language, &about)?;
    match &options.out {
        Some(path) => std::fs::write(path, text)
            .map_err(|error| CliError::Write { path: path.clone(), message: error.to_string() }),
        None => {
            out!("{text}");
            Ok(())
        }
    }
}
