//! `coadjoint verify`: judges the output of `simulate` or `ensemble` afterwards, in doubled precision.

#[cfg(feature = "parquet")]
mod parquet;
mod report;
mod table;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::system::{Options, System};
use coadjoint_run::verify::{Columns, Found, Rows, Sample, follower, judge_of};
use coadjoint_run::{RunError, read_with, text_hash};
use serde_json::Value;

use crate::arguments::VerifyOptions;
use crate::error::CliError;
use crate::named::Format;
use crate::{load, progress};

use table::Table;

/// Judges the file and prints what was found.
///
/// # Errors
/// Bad input, [`CliError::Laws`] where a row is wrong, and [`CliError::NotJudged`] where nothing can be said of one.
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
    let mut all = Vec::new();
    for (place, table) in Table::open(output)?.into_iter().enumerate() {
        all.push(judge(options, system, (table, place), output)?);
    }
    match options.format {
        Format::Text => all.iter().flat_map(Found::lines).for_each(|line| outln!("{line}")),
        Format::Json => {
            let mut values: Vec<Value> =
                all.iter().map(|found| Value::Object(found.object())).collect();
            let value = if values.len() == 1 { values.remove(0) } else { Value::Array(values) };
            outln!("{value:#}");
        }
    }
    if let Some(what) = all.iter().find_map(|found| found.wrong.as_ref()) {
        return Err(CliError::Laws(format!("{}: {what}", output.display())));
    }
    let unjudged: u64 = all.iter().map(|found| found.unjudged).sum();
    match all.iter().find_map(|found| found.why.as_ref()) {
        None => Ok(()),
        Some(why) => Err(CliError::NotJudged(format!(
            "{}: not verified: {unjudged} rows could not be judged, the first because of {why}",
            output.display()
        ))),
    }
}

/// Judges one table, which has this place in the output.
fn judge(
    options: &VerifyOptions,
    named: Option<&PathBuf>,
    (mut table, place): (Table, usize),
    output: &Path,
) -> Result<Found, CliError> {
    let refuse = |what: &str| Err(CliError::Option(format!("{}: {what}", output.display())));
    for name in ["tuned", "fitted"] {
        if table.value(name).is_some_and(|value| value != "false") {
            return refuse(&format!(
                "the run was {name}: its generating function is not the exact series, and cannot be derived from the \
                 system file"
            ));
        }
    }
    if table.value("model").is_some() {
        return refuse("the run is of a learned map: there is no exact series to judge it by");
    }
    if table.value("splitting").is_some() {
        return refuse(
            "a system with a potential is not judged: between its kicks the motion is free",
        );
    }
    let (system, text) = system_of(named, &table, output)?;
    let step = options.step.or_else(|| table.number("step"));
    let truncation = options.truncation.or_else(|| table.number("truncation").map(|k| k as usize));
    let said = table.value("chart").map(|name| match name {
        "cayley" => Chart::Cayley,
        _ => Chart::Exponential,
    });
    let chart = options.chart.or(said);
    let read = Options { truncation, chart, ..Options::default() };
    let System { problem, potential, run, .. } =
        read_with(&system.display().to_string(), &text, read)?;
    if potential.is_some() {
        return refuse(
            "a system with a potential is not judged: between its kicks the motion is free",
        );
    }
    let step = step.or(run.step).ok_or_else(|| RunError::Missing {
        file: system.clone(),
        key: "[integrator] step",
        example: "step = 0.1",
        option: "--step 0.1",
    })?;
    let phase = progress::phase("deriving the judge");
    let judge = judge_of(&system, &problem)?;
    drop(phase);
    let follower = follower(&judge, &problem, step)?;
    let columns = Columns::find(&problem, table.names(), table.width(), output)?;
    // Rows are counted for a sample and for a bar; what cannot be read twice has neither.
    let (mut rows, mut steps) = (0, 0.0);
    if options.sample.is_some() && !output.is_file() {
        return refuse("rows are counted before a sample of them is judged: give a file");
    }
    if output.is_file() && (options.sample.is_some() || progress::visible()) {
        let counted = Table::open(output)?.into_iter().nth(place);
        (rows, steps) = counted.map_or(Ok((0, 0.0)), |mut t| follower.survey(&mut t, &columns))?;
    }
    match options.steps {
        Some(each) => steps = rows as f64 * each as f64,
        // The first row is a start.
        None => rows = rows.saturating_sub(1),
    }
    let sample = options.sample.map(|wanted| Sample { wanted, of: rows });
    let share = sample.map_or(1.0, |s| s.wanted.min(rows) as f64 / rows.max(1) as f64);
    let bar = progress::bar((steps * share).ceil() as u64, "judging");
    let told = |done| bar.set_position(done);
    let follower = follower.watched(sample, &told);
    let Some(input) = &options.input else {
        return follower.rows(&mut table, &columns, output);
    };
    let steps = options.steps.ok_or_else(|| {
        CliError::Option("--input needs --steps: how many steps the ensemble made".into())
    })?;
    let mut starts = Table::open(input)?;
    let [start] = starts.as_mut_slice() else { return refuse("--input must be one table") };
    let before = Columns::find(&problem, start.names(), start.width(), input)?;
    let (starts, ends) = ((start, &before), (&mut table, &columns));
    follower.pairs(starts, ends, steps, &refused(output)?, output)
}

/// The system file and its text: the one named, or the one that the output says it is of, which must be as it was.
fn system_of(
    named: Option<&PathBuf>,
    table: &Table,
    output: &Path,
) -> Result<(PathBuf, String), CliError> {
    let said = table.value("system").map(PathBuf::from);
    let system = named.cloned().or(said).ok_or_else(|| {
        CliError::Option(format!(
            "{}: the file does not say of which system it is; write coadjoint verify SYSTEM.toml {}",
            output.display(),
            output.display()
        ))
    })?;
    let text = load::text(&system)?;
    match table.value("system_sha256") {
        Some(hash) if hash != text_hash(&text) => Err(CliError::Option(format!(
            "{}: {} is not the system file of this run: its text has another hash",
            output.display(),
            system.display()
        ))),
        _ => Ok((system, text)),
    }
}

/// The rows that an ensemble lists as refused, counted from 1.
fn refused(output: &Path) -> Result<BTreeSet<u64>, CliError> {
    let mut name = output.file_name().unwrap_or_default().to_owned();
    name.push(".rejected.csv");
    let list = output.with_file_name(name);
    if !list.exists() {
        return Ok(BTreeSet::new());
    }
    let mut rows = BTreeSet::new();
    for mut table in Table::open(&list)? {
        let place = table.names().iter().position(|name| name == "row");
        while let Some(row) = table.next_row()? {
            rows.extend(place.and_then(|place| row.get(place)).map(|&row| row as u64));
        }
    }
    Ok(rows)
}
