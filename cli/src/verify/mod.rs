//! `coadjoint verify`: judges the output of `simulate` or `ensemble` afterwards, in doubled precision.

mod report;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use coadjoint_codegen::file::beside;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::{FrameChoice, Method};
use coadjoint_codegen::system::{Options, System};
use coadjoint_learn::table::{Cells, Table};
use coadjoint_run::verify::{Follower, Found, KICKED, Quota, judge_of, unjudged};
use coadjoint_run::{Grid, RunError, read_varying, text_hash};
use serde_json::Value;

use crate::arguments::VerifyOptions;
use crate::error::CliError;
use crate::named::Format;
use crate::{load, progress};

/// Judges the file and prints what was found.
///
/// # Errors
/// Bad input, [`CliError::Laws`] where a row is wrong, and [`CliError::NotJudged`] where nothing can be said of one or rows
/// are missing at the end.
pub(crate) fn run(options: &VerifyOptions) -> Result<(), CliError> {
    let (system, output) = match options.files.as_slice() {
        [output] => (None, output),
        [system, output] => (Some(system), output),
        _ => {
            return Err(CliError::Option(
                "give a system file and an output, or the output alone".into(),
            ));
        }
    };
    let judged = tables(output)?.into_iter().map(|table| judge(options, system, table, output));
    let all = judged.collect::<Result<Vec<Found>, _>>()?;
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
    if let Some(what) = all.iter().find_map(|found| found.cut.as_ref()) {
        return Err(CliError::NotJudged(format!("{}: not verified: {what}", output.display())));
    }
    let unjudged: u64 = all.iter().map(|found| found.not_judged).sum();
    match all.iter().find_map(|found| found.why_not_judged.as_ref()) {
        None => Ok(()),
        Some(why) => Err(CliError::NotJudged(format!(
            "{}: not verified: {unjudged} rows could not be judged, the first because of {why}",
            output.display()
        ))),
    }
}

/// The tables of a file: one for each run that a report holds, else one.
fn tables(path: &Path) -> Result<Vec<Table>, CliError> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    match ending.to_str() {
        Some("json" | "jsonl") => report::tables(path),
        _ => Ok(vec![Table::open(path)?]),
    }
}

/// Judges one table of the output.
fn judge(
    options: &VerifyOptions,
    named: Option<&PathBuf>,
    mut table: Table,
    output: &Path,
) -> Result<Found, CliError> {
    let refuse = |what: &str| Err(CliError::Option(format!("{}: {what}", output.display())));
    for (name, what) in [
        (
            "tuned",
            "the run was tuned: its generating function is not the exact series, and cannot be derived from the system file",
        ),
        (
            "fitted",
            "the run was fitted: its generating function is not the exact series, and cannot be derived from the system file",
        ),
        ("model", "the run is of a learned map: there is no exact series to judge it by"),
        ("splitting", KICKED),
    ] {
        if table.value(name).is_some_and(|value| value != "false") {
            return refuse(what);
        }
    }
    let (system, text) = system_of(named, &table, output)?;
    let number = |name: &str| table.value(name)?.parse::<f64>().ok();
    let said = table.value("chart").map(|name| match name {
        "cayley" => Chart::Cayley,
        _ => Chart::Exponential,
    });
    let read = Options {
        truncation: options.truncation.or_else(|| number("truncation").map(|k| k as usize)),
        chart: options.chart.or(said),
        // Only the series has a chart of its own.
        method: match table.value("method") {
            Some("collocation") => Some(Method::Collocation),
            _ => table.value("chart").map(|_| Method::Series),
        },
        frame: table.value("frame").and_then(FrameChoice::named),
        ..Options::default()
    };
    let found = read_varying(&system.display().to_string(), &text, read, &[])?;
    if let Some(why) = unjudged(&found) {
        return refuse(why);
    }
    let System { problem, run, parameters, .. } = found;
    let problem = problem.settled().0;
    let step = options.step.or_else(|| number("step")).or(run.step);
    let step = step.ok_or_else(|| RunError::no_step(&system))?;
    let phase = progress::phase("deriving the judge");
    let judge = judge_of(&system, &problem)?;
    drop(phase);
    // A run's file without an initial time means 0; an ensemble's file never has one.
    let of_run = number("initial_time").unwrap_or(0.0);
    let of_ensemble = options.t0.unwrap_or(run.initial_time);
    let start = if options.input.is_some() { of_ensemble } else { of_run };
    let mut follower = Follower::new(&judge, &problem, Grid { start, step })?;
    follower.parameters = &parameters;
    // Rows are counted for a sample and for a bar; a file that cannot be read twice has neither.
    if options.sample.is_some() && !output.is_file() {
        return refuse("rows are counted before a sample of them is judged: give a file");
    }
    let counted = output.is_file() && (options.sample.is_some() || progress::visible());
    let rows = if counted { table.count()? } else { 0 };
    // The first row of a run is a start.
    let rows = if options.steps.is_some() { rows } else { rows.saturating_sub(1) };
    follower.sample = options.sample.map(|wanted| Quota { wanted, of: rows });
    let share = follower.sample.map_or(1.0, |s| s.wanted.min(rows) as f64 / rows.max(1) as f64);
    let each = options.steps.map(|each| each as f64 * rows as f64);
    let steps = each.or_else(|| number("steps")).unwrap_or(rows as f64);
    let bar = progress::bar((steps * share).ceil() as u64, "judging");
    let told = |done| bar.set_position(done);
    follower.told = &told;
    let Some(input) = &options.input else { return Ok(follower.rows(&mut table)?) };
    let steps = options.steps.ok_or_else(|| {
        CliError::Option("--input needs --steps: how many steps the ensemble made".into())
    })?;
    let mut starts = tables(input)?;
    let [starts] = starts.as_mut_slice() else { return refuse("--input must be one table") };
    Ok(follower.pairs(starts, &mut table, steps, &refused(output)?)?)
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
    let list = beside(output, ".rejected.csv");
    let mut rows = BTreeSet::new();
    if list.exists() {
        let (mut table, mut row) = (Table::open(&list)?, Cells::default());
        let place = table.names().iter().position(|name| name == "row");
        while table.read(&mut row)? {
            rows.extend(place.and_then(|place| row.number(place).ok()).map(|row| row as u64));
        }
    }
    Ok(rows)
}
