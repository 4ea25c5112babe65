//! `cargo run --release -p coadjoint-run --example estimates -- examples/*.toml tests/systems/estimates/*.toml`
//!
//! How near the error estimated at the end of a run is to the truth: for these system files, and for thirty random systems
//! on twelve groups. The truth is the difference from the same run with steps of a quarter of the size. Also the time that an
//! estimate takes, as a share of that of a run of ten thousand steps. Prints the tables of `docs/measurements/estimates.md`, and
//! ends with 1 where fewer than nine of ten estimates are within a factor of 10.

use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use coadjoint_codegen::lie::catalogue;
use coadjoint_codegen::system::System;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{Halt, Outcome, Resume, Schedule, Setup, Sink, run};
use coadjoint_run::{Derived, RunError, meet_tolerance, read};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The groups of random systems, and their truncations.
const GROUPS: [(&str, [usize; 3]); 12] = [
    ("SO3", [3, 5, 7]),
    ("SU2", [1, 5, 7]),
    ("U2", [1, 3, 5]),
    ("SO4", [3, 5, 5]),
    ("SU3", [3, 3, 3]),
    ("SO3^4", [1, 3, 3]),
    ("SL2", [1, 5, 7]),
    ("SL2*SO3", [1, 3, 5]),
    ("SE2", [3, 5, 7]),
    ("SE3", [3, 5, 7]),
    ("Heisenberg", [1, 3, 7]),
    ("Aff1", [1, 3, 5]),
];
/// How many random systems there are.
const RANDOM: usize = 30;
/// An estimate within this factor of the truth is a good one.
const FACTOR: f64 = 10.0;

/// The text of a random system, quadratic or a heavy top, whose run has 100 to 10 000 steps with h|μ| from 0.05 to 0.5.
fn text(number: usize, random: &mut ChaCha8Rng) -> Option<String> {
    let (group, truncations) = GROUPS[number % GROUPS.len()];
    let dim = catalogue::lookup(group).ok()?.dim();
    let mut terms: Vec<String> =
        (0..dim).map(|i| format!("{:.4}*mu[{i}]^2", random.random_range(0.1..1.0))).collect();
    if group == "SE3" && number < GROUPS.len() {
        terms.truncate(3);
        terms.push("0.5*mu[5]".to_owned());
    }
    let (i, j) = (random.random_range(0..dim), random.random_range(0..dim));
    terms.push(format!("{:.4}*mu[{i}]*mu[{j}]", random.random_range(0.0..0.1)));
    let momentum: Vec<f64> = (0..dim).map(|_| random.random_range(-1.0..1.0)).collect();
    let size = momentum.iter().map(|mu| mu * mu).sum::<f64>().sqrt();
    let step = 10_f64.powf(random.random_range(-1.3..-0.3)) / size;
    let steps = 10_f64.powf(random.random_range(2.0..4.0)).floor();
    Some(format!(
        "name = \"random {number}\"\ngroup = \"{group}\"\nhamiltonian = \"{}\"\n[integrator]\ntruncation = {}\n\
         step = {step}\n[initial]\nmomentum = {momentum:?}\n[run]\ntime = {}\n",
        terms.join(" + "),
        truncations[number / GROUPS.len()],
        step * steps,
    ))
}

/// The time at the last step.
struct Clock(Instant);

impl Sink for Clock {
    fn pause(&mut self, _: u64, _: bool, _: &dyn Fn() -> Resume) -> Result<(), Halt> {
        self.0 = Instant::now();
        Ok(())
    }
}

/// The first files, which are `examples/`, are also timed.
const TIMED: usize = 21;
/// The steps of a run by which the time of an estimate is judged.
const LONG: f64 = 1e4;

/// The run of a system, the same with steps of a quarter of the size, and, where it is timed, the share of time that an
/// estimate takes.
fn runs(
    file: &str,
    mut system: System,
    timed: bool,
) -> Result<(Schedule, usize, [Outcome; 2], f64), RunError> {
    let path = Path::new(file);
    meet_tolerance(path, &mut system, &coadjoint_run::Accuracy::default())?;
    let (given, truncation) = (system.run.clone(), system.problem.truncation);
    let schedule = Schedule::new(path, None, None, &given)?;
    let momentum = given.momentum.clone().unwrap_or_default();
    let derived = Derived::of_file(path, system)?;
    let run = |step, time, sink: &mut dyn Sink| {
        let group_element = given.group_element.clone();
        let setup =
            Setup { group_element, ..Setup::new(Schedule::of(step, time)?, momentum.clone()) };
        run(&derived, &setup, sink)
    };
    let time = schedule.end.abs();
    let both = [run(schedule.step, time, &mut ())?, run(schedule.step * 0.25, time, &mut ())?];
    if !timed {
        return Ok((schedule, truncation, both, f64::NAN));
    }
    let begun = Instant::now();
    let mut clock = Clock(begun);
    // Numbers may grow beyond all bounds after the file's own time.
    let long = run(schedule.step, LONG * schedule.step.abs(), &mut clock);
    let share = clock.0.elapsed().as_secs_f64() / (clock.0 - begun).as_secs_f64();
    Ok((schedule, truncation, both, long.map_or(f64::NAN, |_| share)))
}

/// The difference of two vectors, relative to the second.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (square / b.iter().map(|b| b * b).sum::<f64>()).sqrt()
}

fn main() -> ExitCode {
    let mut texts: Vec<(String, String)> = Vec::new();
    for file in std::env::args().skip(1) {
        let name = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match std::fs::read_to_string(&file) {
            Ok(text) => texts.push((name, text)),
            Err(error) => {
                eprintln!("{file}: {error}");
                return ExitCode::from(2);
            }
        }
    }
    let timed = TIMED.min(texts.len());
    let mut random = ChaCha8Rng::seed_from_u64(33);
    texts.extend((0..RANDOM).filter_map(|number| {
        let text = text(number, &mut random)?;
        Some((format!("random {number}, {}", GROUPS[number % GROUPS.len()].0), text))
    }));
    println!(
        "| system | K | h | steps | estimate | truth | share of time |\n|---|---|---|---|---|---|---|"
    );
    let (mut judged, mut good) = (0, 0);
    for (number, (name, text)) in texts.into_iter().enumerate() {
        let found = read(&name, &text).and_then(|system| runs(&name, system, number < timed));
        let (schedule, truncation, [coarse, fine], share) = match found {
            Ok(found) => found,
            Err(error) => {
                let line = error.to_string();
                let line = line.split([';', '\n']).next().unwrap_or_default();
                println!("| {name} | | | | {line} | | |");
                continue;
            }
        };
        let truth =
            apart(&coarse.momentum, &fine.momentum).max(apart(&coarse.element, &fine.element));
        let estimate = coarse.estimated_error;
        let near = estimate.is_ok_and(|found| {
            found == truth || (1.0 / FACTOR..=FACTOR).contains(&(found / truth))
        });
        judged += 1;
        good += usize::from(near);
        println!(
            "| {name} | {truncation} | {} | {} | {} | {truth:.1e}{} | {} |",
            shortest((schedule.step * 1e4).round() / 1e4),
            schedule.steps,
            estimate.map_or_else(str::to_owned, |found| format!("{found:.1e}")),
            if near { "" } else { " ✗" },
            if share.is_finite() { format!("{:.1} %", share * 100.0) } else { "–".to_owned() },
        );
    }
    println!("\n{good} of {judged} estimates are within a factor of {FACTOR} of the truth.");
    if 10 * good >= 9 * judged { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
