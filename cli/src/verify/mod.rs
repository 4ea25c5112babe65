//! `coadjoint verify`: judges the output of `simulate` or `ensemble` afterwards, in doubled precision.
// A comparison with what is not a number must refuse.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod follow;
mod record;
mod table;

use std::path::{Path, PathBuf};

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::judge::Judge;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::Problem;
use coadjoint_codegen::system::{Options, System};
use num_traits::ToPrimitive;

use crate::arguments::{Format, VerifyOptions};
use crate::error::CliError;
use crate::load;
use follow::Follower;
use record::Columns;
use table::Table;

/// Judges the file and prints what was found.
///
/// # Errors
/// Bad input, and [`CliError::Laws`] where a row is wrong.
pub fn run(options: &VerifyOptions) -> Result<(), CliError> {
    let (system, output) = match options.files.as_slice() {
        [output] => (None, output),
        [system, output] => (Some(system), output),
        _ => {
            return Err(CliError::Option(
                "give a system file and an output, or the output alone".into(),
            ));
        }
    };
    let table = Table::open(output)?;
    let system = system_of(system, &table, output)?;
    for name in ["tuned", "fitted"] {
        if table.value(name).is_some_and(|value| value != "false") {
            return Err(CliError::Option(format!(
                "{}: the run was {name}: its generating function is not the exact series, and \
                 cannot be derived from the system file",
                output.display()
            )));
        }
    }
    let step = options.step.or_else(|| table.number("step"));
    let truncation = options.truncation.or_else(|| table.number("truncation").map(|k| k as usize));
    let said = table.value("chart").map(|name| match name.as_str() {
        "cayley" => Chart::Cayley,
        _ => Chart::Exponential,
    });
    let chart = options.chart.map(Into::into).or(said);
    let read = Options { truncation, chart, ..Options::default() };
    let System { problem, potential, run, .. } = load::file(&system, read)?;
    if potential.is_some() {
        return Err(CliError::Option(format!(
            "{}: a system with a potential is not judged: between its kicks the motion is free",
            system.display()
        )));
    }
    let step = step.or(run.step).ok_or_else(|| CliError::Missing {
        file: system.clone(),
        key: "[integrator] step",
        example: "step = 0.1",
        option: "--step 0.1",
    })?;
    if step == 0.0 || !step.is_finite() {
        return Err(CliError::Option("--step must be finite and other than zero".into()));
    }
    let judge = Judge::of_problem(&problem, TermLimit::default())
        .map_err(|error| CliError::Option(format!("{}: {error}", system.display())))?;
    let parameters: Vec<f64> = values(&problem)?;
    let symbols: Vec<f64> = problem.symbols.iter().map(|s| s.expr.evaluate(&parameters)).collect();
    let follower = Follower::new(&judge, &problem, step, symbols)?;
    let columns = Columns::find(&problem, table.names(), table.width(), output)?;
    let found = match &options.input {
        None => follower.rows(table, &columns, output)?,
        Some(input) => {
            let steps = options.steps.ok_or_else(|| {
                CliError::Option("--input needs --steps: how many steps the ensemble made".into())
            })?;
            let starts = Table::open(input)?;
            let before = Columns::find(&problem, starts.names(), starts.width(), input)?;
            follower.pairs(starts, &before, table, &columns, steps, output)?
        }
    };
    match options.format {
        Format::Text => found.lines().iter().for_each(|line| outln!("{line}")),
        Format::Json => outln!("{:#}", serde_json::Value::Object(found.object())),
    }
    match &found.wrong {
        None => Ok(()),
        Some(what) => Err(CliError::Laws(format!("{}: {what}", output.display()))),
    }
}

/// The system file: the one named, or the one that the output says it is of.
fn system_of(named: Option<&PathBuf>, table: &Table, output: &Path) -> Result<PathBuf, CliError> {
    if let Some(named) = named {
        return Ok(named.clone());
    }
    let said = table.value("system").map(PathBuf::from);
    said.ok_or_else(|| {
        CliError::Option(format!(
            "{}: the file does not say of which system it is; write coadjoint verify SYSTEM.toml {}",
            output.display(),
            output.display()
        ))
    })
}

/// The values of the parameters, flattened.
fn values(problem: &Problem) -> Result<Vec<f64>, CliError> {
    let mut values = Vec::new();
    for parameter in &problem.parameters {
        let default = parameter.default.as_ref().ok_or_else(|| {
            CliError::Option(format!("the parameter {} has no value in the file", parameter.name))
        })?;
        values.extend(default.iter().map(|value| value.to_f64().unwrap_or(f64::NAN)));
    }
    Ok(values)
}
