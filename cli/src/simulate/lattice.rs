//! `coadjoint simulate` of a lattice: progress, records, the spins at the end, and the report.

use std::fmt::Write;

use coadjoint_codegen::file;
use coadjoint_draw::vectors;
use coadjoint_learn::npy_header;
use coadjoint_run::lattice::{Arrays, Conclusion, Itinerary, News, Record, Simulation, Waypoint};
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::Setup;
use coadjoint_run::text_hash;
use serde_json::{Value, json};

use super::keep::{ANEW, Keeper};
use super::plot::brief;
use super::records::Checkpoint;
use super::settings::{self, Header, Settings, every};
use super::target::{Destination, Place, paths};
use crate::arguments::SimulateOptions;
use crate::error::{CliError, unwritten};
use crate::named::Format;
use crate::{load, note, progress};

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
    let choosing = progress::phase("choosing the method and the step");
    let found = options.checkpoint.as_ref().map(|path| note::read(path, "checkpoint", ANEW));
    let found: Option<Checkpoint<Waypoint>> = found.transpose()?.flatten();
    let plan = lattice.plan(&asked, found.as_ref().map(|found| &found.resume))?;
    drop(choosing);
    plan.schedule.announcement().iter().for_each(|line| errln!("{line}"));
    let setup = Setup::new(plan.schedule, Vec::new());
    let hash = text_hash(lattice.source());
    let settings = Settings {
        // The end is wanted, too, where nobody reads the records.
        sampled: options.plot.is_some() || options.last.is_some(),
        ..Settings::new(options, (&path, &hash), out, setup)?
    };
    let header = header(&lattice, &settings, &plan, every);
    let mut keeper = Keeper::new(&settings, header.clone());
    let spins = lattice.text().sites.iter().flat_map(|site| {
        lattice.text().coordinates.each_ref().map(|name| format!("{name}[{site}]"))
    });
    let columns = COLUMNS.map(str::to_owned).into_iter().chain(spins).collect();
    // The content of tables shows in the start.
    let start =
        ("start", format!("{:?}", row(&lattice.record(plan.schedule.start, lattice.start())?)));
    let from = keeper.open(start, columns, |found: &Waypoint| found.step)?;
    let mut told = |news: News<'_>| {
        let done = match news {
            News::Record(record) => keeper.row(&row(record)),
            News::Steps(n, spins) => {
                let state = || plan.waypoint(n, spins.unwrap_or_default());
                let state = spins.is_some().then_some(&state as &dyn Fn() -> Waypoint);
                keeper.tend(n, n == plan.schedule.steps, state)
            }
        };
        keeper.note(done).is_ok()
    };
    let end = lattice.run(
        plan.clone(),
        (settings.out.as_ref().map(|_| every), estimate),
        from.as_ref(),
        &mut told,
    );
    let (end, _) = keeper.close(end)?;
    if let Some(last) = &options.last {
        let mut bytes = npy_header(&[end.spins.len() as u64, 3]);
        end.spins.as_flattened().iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
        file::write(last, &paths(&used), &bytes).map_err(unwritten(last))?;
    }
    if let (Some(path), Some(plane)) = (&options.plot, plane) {
        let picture = picture(&lattice, &end, &plane);
        file::write(path, &paths(&settings.inputs), picture.as_bytes()).map_err(unwritten(path))?;
    }
    let report = match options.format {
        Format::Text => text(&lattice, &end),
        Format::Json => format!("{:#}\n", object(&lattice, &header, &end)),
    };
    match settings.out.is_some_and(|out| out.place == Place::Standard) {
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
fn header(lattice: &Simulation, settings: &Settings<'_>, plan: &Itinerary, every: u64) -> Header {
    let Itinerary { method, schedule, .. } = plan;
    let text = lattice.text();
    Header::of_entries(vec![
        ("program", json!(format!("coadjoint {}", env!("CARGO_PKG_VERSION")))),
        ("system", json!(settings.file.display().to_string())),
        ("system_sha256", json!(settings.hash)),
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

fn object(lattice: &Simulation, header: &Header, end: &Conclusion) -> Value {
    let Conclusion { plan, ends, lengths, error, .. } = end;
    let moment = |Record { time, magnetisation, energy, .. }: &Record| json!({ "time": time, "magnetisation": magnetisation, "energy": energy });
    let tried = plan.tried.iter().map(|(method, seconds)| json!({ "splitting": method.name(), "order": method.order(), "seconds": seconds }));
    json!({
        "method": plan.method.label(),
        "run": header.object(),
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
