//! `coadjoint simulate` of a lattice: progress, records, the spins at the end, and the report.

use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use coadjoint_codegen::file;
use coadjoint_learn::npy_header;
use coadjoint_run::lattice::{Arrays, Conclusion, Itinerary, News, Record, Simulation};
use coadjoint_run::number::shortest;
use coadjoint_run::text_hash;
use serde_json::{Value, json};

use super::interrupt::Guard;
use super::records::Records;
use super::settings::{Header, every};
use super::target::{Destination, Place, paths};
use crate::arguments::SimulateOptions;
use crate::error::{CliError, unwritten};
use crate::named::Format;
use crate::{load, progress};

/// The names of the columns of records.
const COLUMNS: [&str; 5] = ["t", "m_1", "m_2", "m_3", "energy"];

/// Runs the lattice of a file; false if the file has none.
pub(super) fn run(options: &SimulateOptions) -> Result<bool, CliError> {
    let path = options.input.source(None).file;
    let source = load::text(&path)?;
    let phase = progress::phase("building the lattice");
    let Some(lattice) = Simulation::read(&path, &source, &Arrays::new())? else { return Ok(false) };
    drop(phase);
    refuse(options)?;
    let mut used = vec![path.clone()];
    let out = options.out.as_deref().map(|out| Destination::new(out, &used)).transpose()?;
    used.extend(out.iter().flat_map(Destination::names));
    if let Some(last) = &options.last {
        file::check(last, &paths(&used)).map_err(unwritten(last))?;
        if last.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("npy")) {
            let what = format!(
                "--final {}: an array is written; give a name that ends in .npy",
                last.display()
            );
            return Err(CliError::Option(what));
        }
    }
    let asked = options.accuracy.of_run(None, options.t0, options.time);
    let run = &lattice.text().run;
    let every = every(options.every.or(run.every).unwrap_or(1))?;
    let estimate = !options.no_estimate && run.estimate != Some(false);
    let (mut records, mut bar, mut failure) = (None::<Records>, None, None);
    let (guard, mut shown) = (Guard::new(), Instant::now());
    let choosing = progress::phase("choosing the method and the step");
    let mut choosing = Some(choosing);
    let mut tell = |news: News<'_>| -> Result<(), CliError> {
        match news {
            News::Begin(plan) => {
                choosing = None;
                plan.schedule.announcement().iter().for_each(|line| errln!("{line}"));
                if let Some(out) = &out {
                    let header = header(&lattice, &path, plan, every);
                    let names = COLUMNS.map(str::to_owned).to_vec();
                    records = Some(Records::open(out, out.open()?, header, names, None)?);
                }
                bar = Some(progress::bar(plan.schedule.steps, "integrating"));
            }
            News::Record(Record { time, magnetisation: [x, y, z], energy }) => {
                records.as_mut().map_or(Ok(()), |records| records.row(&[time, x, y, z, energy]))?;
            }
            News::Steps(n) => {
                if let Some(bar) = bar.as_ref().filter(|_| shown.elapsed() >= progress::INTERVAL) {
                    bar.set_position(n);
                    shown = Instant::now();
                }
                if let Some(records) = &mut records {
                    records.tick()?;
                }
                if guard.asked() {
                    let what = format!(
                        "interrupted after {n} steps; nothing of a lattice is kept to go on from"
                    );
                    return Err(CliError::Interrupted(what));
                }
            }
        }
        Ok(())
    };
    let mut told = |news: News<'_>| match tell(news) {
        Ok(()) => true,
        Err(error) => {
            failure = Some(error);
            false
        }
    };
    let end = lattice.run(&asked, out.as_ref().map(|_| every), estimate, &mut told);
    bar.inspect(indicatif::ProgressBar::finish_and_clear);
    let end = match (end, records) {
        (Ok(end), records) => {
            if let Some(mut records) = records {
                records.complete()?;
                records.publish()?;
            }
            end
        }
        (Err(error), records) => {
            let error = failure.unwrap_or_else(|| error.into());
            records.into_iter().for_each(|records| records.stop(&error.to_string()));
            return Err(error);
        }
    };
    if let Some(last) = &options.last {
        let mut bytes = npy_header(&[end.spins.len() as u64, 3]);
        end.spins.as_flattened().iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
        file::write(last, &paths(&used), &bytes).map_err(unwritten(last))?;
    }
    let report = match options.format {
        Format::Text => text(&lattice, &end),
        Format::Json => format!("{:#}\n", object(&lattice, &path, &end, every)),
    };
    match out.is_some_and(|out| out.place == Place::Standard) {
        true => err!("{report}"),
        false => out!("{report}"),
    }
    Ok(true)
}

/// Refuses options that a lattice has no use for.
fn refuse(options: &SimulateOptions) -> Result<(), CliError> {
    let instead = &options.input.instead;
    let given = [
        ("--truncation", !options.truncation.is_empty(), "write `truncation` in the file"),
        ("--chart", instead.chart.is_some(), "its steps are in no chart"),
        ("--solver", instead.solver.is_some(), "its steps choose their own"),
        ("--method", instead.method.is_some(), "write `method` or `splitting` in the file"),
        ("--region", options.accuracy.region.is_some(), "a tolerance holds along the run"),
        ("--at", options.at.is_some(), "records are made by --every"),
        ("--until", options.until.is_some(), "its runs end at their time"),
        (
            "--checkpoint",
            options.checkpoint.is_some(),
            "go on from the array of --final, as `momentum` of [initial]",
        ),
        ("--plot", options.plot.is_some(), "plot the records of --out, or the array of --final"),
        (
            "--backend",
            options.backend != coadjoint_run::Backend::Auto,
            "its steps are compiled already",
        ),
    ];
    match given.into_iter().find(|(_, given, _)| *given) {
        Some((name, _, advice)) => {
            Err(CliError::Option(format!("{name} is not for a lattice: {advice}")))
        }
        None => Ok(()),
    }
}

/// Everything needed to repeat a run.
fn header(lattice: &Simulation, path: &Path, plan: &Itinerary, every: u64) -> Header {
    let Itinerary { method, schedule, .. } = plan;
    let text = lattice.text();
    Header::of_entries(vec![
        ("program", json!(format!("coadjoint {}", env!("CARGO_PKG_VERSION")))),
        ("system", json!(path.display().to_string())),
        ("system_sha256", json!(text_hash(lattice.source()))),
        ("name", json!(text.name)),
        ("group", json!("SO3")),
        ("lattice", json!(text.kind)),
        ("shape", json!(text.shape)),
        ("sites", json!(lattice.sites())),
        ("splitting", json!(method.name())),
        ("order", json!(method.order())),
        ("step", json!(schedule.step)),
        ("step_asked", json!(schedule.asked)),
        ("steps", json!(schedule.steps)),
        ("initial_time", json!(schedule.start)),
        ("time", json!(schedule.end)),
        ("every", json!(every)),
    ])
}

fn object(lattice: &Simulation, path: &Path, end: &Conclusion, every: u64) -> Value {
    let Conclusion { plan, ends, lengths, error, .. } = end;
    let moment = |Record { time, magnetisation, energy }: &Record| json!({ "time": time, "magnetisation": magnetisation, "energy": energy });
    let tried = plan.tried.iter().map(|(method, seconds)| json!({ "splitting": method.name(), "order": method.order(), "seconds": seconds }));
    json!({
        "method": plan.method.label(),
        "run": header(lattice, path, plan, every).object(),
        "tried": tried.collect::<Vec<_>>(),
        "start": moment(&ends[0]),
        "end": moment(&ends[1]),
        "drift": { "energy_per_site": (ends[1].energy - ends[0].energy) / lattice.sites() as f64, "magnetisation": change(ends), "length": lengths },
        "estimated_error": error,
    })
}

/// The size of the change of the magnetisation.
fn change([from, to]: &[Record; 2]) -> f64 {
    let squares = from.magnetisation.iter().zip(to.magnetisation).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

fn text(lattice: &Simulation, end: &Conclusion) -> String {
    let Conclusion { plan, ends, lengths, error, .. } = end;
    let (schedule, sites) = (&plan.schedule, lattice.sites());
    let mut out = String::new();
    let label = plan.method.label();
    let _ = writeln!(out, "{}: {sites} spins, {label}", lattice.text().name);
    if let [(_, best), others @ ..] = &plan.tried[..] {
        let times = others
            .iter()
            .map(|(method, seconds)| format!("{} {:.1}", method.label(), seconds / best));
        let _ = writeln!(
            out,
            "  chosen by {} spins; the time of others for the same error: {}",
            lattice.cut_sites(),
            times.collect::<Vec<_>>().join(", ")
        );
    }
    let [step, time] = [schedule.step, schedule.end].map(shortest);
    let _ = writeln!(out, "  {} steps of {step} to time {time}", schedule.steps);
    for (name, axis) in ["m_1", "m_2", "m_3"].iter().zip(0..) {
        let _ = writeln!(out, "  {name:<10} {:>24}", shortest(ends[1].magnetisation[axis]));
    }
    let _ = writeln!(out, "  energy     {:>24}", shortest(ends[1].energy));
    let _ = match error {
        Some(error) => {
            let of = lattice.cut_sites();
            writeln!(out, "  estimated relative error at the end {error:.1e}, of {of} spins")
        }
        None => writeln!(out, "  the error at the end was not estimated"),
    };
    let _ = writeln!(out, "  change from start to end");
    let energy = (ends[1].energy - ends[0].energy) / sites as f64;
    for (name, size) in [
        ("energy per spin", energy.abs()),
        ("magnetisation", change(ends)),
        ("length of a spin", *lengths),
    ] {
        let _ = writeln!(out, "    {name:<16} {size:>10.1e}");
    }
    out
}
