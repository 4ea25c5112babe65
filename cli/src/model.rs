//! `simulate --model` and `emit --model`: learned maps, run or written as code.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use coadjoint::{Chart, Coordinates, Phase, StepError, advance};
use coadjoint_codegen::emit::{Options, file};
use coadjoint_learn::catalogue::{Visitor, visit};
use coadjoint_learn::{DataGroup, Generating, LearnError, ModelFile, drifts, problem};
use nalgebra::DMatrix;

use crate::error::CliError;
use crate::load;

/// How far, relatively, a time may be from a whole number of steps.
const WHOLE: f64 = 1e-9;

/// A run of a learned map.
#[derive(Debug)]
pub struct Run {
    /// The model file.
    pub model: PathBuf,
    /// The momentum at the start.
    pub start: Vec<f64>,
    /// The duration T.
    pub time: f64,
    /// Record every n-th step.
    pub every: usize,
    /// Where to write the trajectory as CSV.
    pub out: Option<PathBuf>,
}

/// Follows a learned map and reports its drifts.
pub fn simulate(run: &Run) -> Result<(), CliError> {
    let model = ModelFile::load(&run.model)?;
    let steps = (run.time / model.step).round();
    if !(steps.is_finite() && (1.0..1e12).contains(&steps)) {
        return Err(CliError::Option(format!(
            "the time {} is no number of steps of {}, the step the model was learned for",
            run.time, model.step
        )));
    }
    let end = steps * model.step;
    if (end - run.time).abs() > WHOLE * run.time {
        return Err(CliError::Option(format!(
            "the time {} is no whole number of steps of {}, the step the model was learned for: \
             give --time {end}",
            run.time, model.step
        )));
    }
    // Bounded above by the check.
    let steps = steps as usize;
    visit(&model.group.clone(), &model.chart.clone(), Follow { run, model, steps })?
}

struct Follow<'a> {
    run: &'a Run,
    model: ModelFile,
    steps: usize,
}

impl Visitor for Follow<'_> {
    type Output = Result<(), CliError>;

    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> Self::Output {
        let Self { run, model, steps } = self;
        let dim = group.dim();
        if run.start.len() != dim {
            let (what, found) = ("the start".into(), run.start.len());
            return Err(LearnError::Shape { what, expected: dim, found }.into());
        }
        let map = Generating::<G, C, _>::new(group.clone(), &model.model);
        let start =
            Phase::<G>::new(group.identity(), G::Vector::from_entries(dim, |i| run.start[i]));
        if let Some(path) = &run.out {
            let fail = |error: std::io::Error| CliError::Write {
                path: path.clone(),
                message: error.to_string(),
            };
            let stumble = |step: usize, source: StepError| CliError::Step {
                time: step as f64 * model.step,
                source,
            };
            let mut out = std::io::BufWriter::new(std::fs::File::create(path).map_err(fail)?);
            write_header(&mut out, &group, model.attitude).map_err(fail)?;
            let mut phase = start.clone();
            for step in 0..=steps {
                if step > 0 {
                    advance(&map, &mut phase).map_err(|e| stumble(step, e))?;
                }
                if step % run.every.max(1) == 0 || step == steps {
                    let time = step as f64 * model.step;
                    write_row(&mut out, &group, &phase, time, model.attitude).map_err(fail)?;
                }
            }
            out.flush().map_err(fail)?;
        }
        let found = drifts(&map, &group, &start, steps, None)?;
        outln!(
            "{} steps of {}: drift of the momentum {:.1e}, of the Casimirs {:.1e}",
            steps,
            model.step,
            found.momentum,
            found.casimir
        );
        if !model.attitude {
            outln!(
                "learned from momenta alone: the attitude is not known and not written, since the \
                 data leave it open up to a rotation about the momentum"
            );
        }
        Ok(())
    }
}

fn write_header<G: DataGroup>(
    out: &mut impl std::io::Write,
    group: &G,
    attitude: bool,
) -> std::io::Result<()> {
    let mut names = vec!["t".to_owned()];
    names.extend((1..=group.dim()).map(|i| format!("mu_{i}")));
    if attitude {
        let size = group.matrix_size();
        names.extend((1..=size).flat_map(|i| (1..=size).map(move |j| format!("g_{i}{j}"))));
    }
    writeln!(out, "{}", names.join(","))
}

fn write_row<G: DataGroup>(
    out: &mut impl std::io::Write,
    group: &G,
    phase: &Phase<G>,
    time: f64,
    attitude: bool,
) -> std::io::Result<()> {
    let mut row = vec![time];
    row.extend((0..group.dim()).map(|i| phase.momentum[i]));
    if attitude {
        let g: DMatrix<f64> = coadjoint_learn::matrix_of(group, &phase.group_element);
        row.extend(g.transpose().iter());
    }
    let cells: Vec<String> = row.iter().map(f64::to_string).collect();
    writeln!(out, "{}", cells.join(","))
}

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
