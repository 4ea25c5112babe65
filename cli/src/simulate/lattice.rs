//! `coadjoint simulate` of a lattice: progress, records, the spins at the end, and the report.

use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

use coadjoint_codegen::file;
use coadjoint_draw::vectors;
use coadjoint_learn::npy_header;
use coadjoint_run::lattice::{Arrays, Conclusion, Itinerary, News, Record, Simulation, Waypoint};
use coadjoint_run::number::shortest;
use coadjoint_run::text_hash;
use serde_json::{Value, json};

use super::interrupt::Guard;
use super::keep::{AGAIN, ANEW};
use super::plot::brief;
use super::records::{Checkpoint, Records};
use super::settings::{self, Header, every};
use super::target::{Destination, Place, paths};
use crate::arguments::SimulateOptions;
use crate::error::{CliError, unwritten};
use crate::named::Format;
use crate::note::{self, Identity};
use crate::{load, progress};

/// The names of the columns of records, before those of chosen sites.
const COLUMNS: [&str; 5] = ["t", "m_1", "m_2", "m_3", "energy"];
/// The most sites of a picture along an axis.
const MOST_DRAWN: usize = 128;

/// Runs the lattice of a file; false if the file has none.
pub(super) fn run(options: &SimulateOptions) -> Result<bool, CliError> {
    let path = options.input.source(None).file;
    let source = load::text(&path)?;
    let phase = progress::phase("building the lattice");
    let Some(lattice) = Simulation::read(&path, &source, &Arrays::new())? else { return Ok(false) };
    drop(phase);
    refuse(options)?;
    let mut used = vec![path.clone()];
    let out = settings::check_names(options, &used)?;
    let checkpoint = settings::checkpoint(options)?;
    let plane = lattice.plane(MOST_DRAWN);
    if options.plot.is_some() && plane.is_none() {
        let what = "--plot: a graph by edges has no places to draw its spins at; read the array of --final";
        return Err(CliError::Option(what.to_owned()));
    }
    used.extend(out.iter().flat_map(Destination::names));
    used.extend(options.plot.iter().chain(&options.checkpoint).cloned());
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
    // First of all: what is read below is then not another run's.
    let mut output = out.as_ref().map(Destination::open).transpose()?.flatten();
    let found = checkpoint.as_ref().map(|(path, _)| note::read(path, "checkpoint", ANEW));
    let found: Option<Checkpoint<Waypoint>> = found.transpose()?.flatten();
    let (mut records, mut bar, mut failure) = (None::<Records>, None, None);
    let (guard, mut shown, mut saved) = (Guard::new(), Instant::now(), Instant::now());
    let mut journey = None::<(Itinerary, Identity)>;
    let save = |(plan, identity): &(Itinerary, Identity),
                records: Option<&mut Records>,
                (step, spins): (u64, &[[f64; 3]])| {
        let Some((path, _)) = &checkpoint else { return Ok(()) };
        let (extent, rows) = records.map(Records::vouch).transpose()?.unwrap_or_default();
        let checkpoint = Checkpoint {
            identity: identity.clone(),
            resume: plan.waypoint(step, spins),
            bytes: extent.bytes,
            records_crc32: extent.crc32,
            rows,
            samples: None,
            complete: step == plan.schedule.steps,
        };
        note::write(&checkpoint, path, &[&options.input.source(None).file])
    };
    let choosing = progress::phase("choosing the method and the step");
    let mut choosing = Some(choosing);
    let mut tell = |news: News<'_>| -> Result<(), CliError> {
        match news {
            News::Begin(plan, first) => {
                choosing = None;
                let steps = plan.schedule.steps;
                plan.schedule.announcement().iter().for_each(|line| errln!("{line}"));
                let header = header(&lattice, &path, plan, every);
                let mut identity = header.identity();
                // It follows from the time and the step; the content of tables shows in the start.
                identity.remove("steps");
                identity.insert("start".to_owned(), format!("{:?}", row(first)));
                let name =
                    out.as_ref().map_or_else(String::new, |out| out.path.display().to_string());
                identity.insert("out".to_owned(), name);
                if let (Some(found), Some((path, _))) = (&found, &checkpoint) {
                    note::agree(path, &found.identity, &identity, AGAIN)?;
                    let (path, step) = (path.display(), found.resume.step);
                    match found.complete {
                        true => errln!(
                            "this run has finished; its report is made from {path}: remove it to run anew"
                        ),
                        false => errln!("going on from {path} at step {step} of {steps}"),
                    }
                }
                if let Some(out) = &out {
                    let spins = lattice.text().sites.iter().flat_map(|site| {
                        lattice.text().coordinates.each_ref().map(|name| format!("{name}[{site}]"))
                    });
                    let names = COLUMNS.map(str::to_owned).into_iter().chain(spins).collect();
                    records =
                        Some(Records::open(out, output.take(), header, names, found.as_ref())?);
                }
                journey = Some((plan.clone(), identity));
                saved = Instant::now();
                bar = Some(progress::bar(steps, "integrating"));
            }
            News::Record(record) => {
                records.as_mut().map_or(Ok(()), |records| records.row(&row(record)))?;
            }
            News::Steps(n, spins) => {
                if let Some(bar) = bar.as_ref().filter(|_| shown.elapsed() >= progress::INTERVAL) {
                    bar.set_position(n);
                    shown = Instant::now();
                }
                if let Some(records) = &mut records {
                    records.tick()?;
                }
                let stop = guard.asked();
                let due =
                    checkpoint.as_ref().map(|(_, interval)| stop || saved.elapsed() >= *interval);
                if let (Some(true), Some(journey), Some(spins)) = (due, &journey, spins)
                    && n < journey.0.schedule.steps
                {
                    save(journey, records.as_mut(), (n, spins))?;
                    saved = Instant::now();
                }
                // With checkpoints the run ends where one can be made.
                if stop && (checkpoint.is_none() || spins.is_some()) {
                    let again = checkpoint.as_ref().map(|(path, _)| {
                        format!("; the same command goes on from {}", path.display())
                    });
                    let what = format!("interrupted after {n} steps{}", again.unwrap_or_default());
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
    let settings = (out.as_ref().map(|_| every), estimate);
    let from = found.as_ref().map(|found| &found.resume);
    let end = lattice.run(&asked, settings, from, &mut told);
    bar.inspect(indicatif::ProgressBar::finish_and_clear);
    let end = match (end, records) {
        (Ok(end), mut records) => {
            records.as_mut().map_or(Ok(()), Records::complete)?;
            if let Some(journey) = &journey {
                save(journey, records.as_mut(), (end.plan.schedule.steps, &end.spins))?;
            }
            records.map_or(Ok(()), Records::publish)?;
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
    if let (Some(path), Some(plane)) = (&options.plot, plane) {
        let picture = picture(&lattice, &end, &plane);
        let inputs = [options.input.source(None).file];
        file::write(path, &paths(&inputs), picture.as_bytes()).map_err(unwritten(path))?;
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

/// The numbers of a record.
fn row(Record { time, magnetisation: [x, y, z], energy, spins }: &Record) -> Vec<f64> {
    [*time, *x, *y, *z, *energy].iter().chain(spins.as_flattened()).copied().collect()
}

/// The spins at the end in a plane of the lattice.
fn picture(lattice: &Simulation, end: &Conclusion, plane: &[(usize, [f64; 2])]) -> String {
    let [x, y, z] = &lattice.text().coordinates;
    let settings = [
        format!("{} spins", lattice.sites()),
        end.plan.method.label(),
        format!("h = {}", brief(end.plan.schedule.step)),
        format!("t = {}", brief(end.plan.schedule.end)),
        format!("arrows: {x} and {y}; colours: {z} over the length, blue −1 to orange 1"),
    ];
    let settings = settings
        .into_iter()
        .chain((lattice.text().shape.len() == 3).then(|| "layer k = 0".to_owned()));
    let vectors: Vec<_> = plane.iter().map(|(site, place)| (*place, end.spins[*site])).collect();
    vectors::plane(&lattice.text().name, &settings.collect::<Vec<_>>(), &vectors)
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
    let moment = |Record { time, magnetisation, energy, .. }: &Record| json!({ "time": time, "magnetisation": magnetisation, "energy": energy });
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
