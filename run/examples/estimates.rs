//! `cargo run --release -p coadjoint-run --example estimates -- examples/*.toml tests/systems/estimates/*.toml`
//!
//! How near the error estimated at the end of a run is to the truth: for these system files, and for thirty random systems
//! on twelve groups. The truth is the difference from the same run with steps of a quarter of the size. Prints the table of
//! `docs/measurements/estimates.md`, and ends with 1 where fewer than nine of ten estimates are within a factor of 10.

use std::path::Path;
use std::process::ExitCode;

use coadjoint_codegen::lie::catalogue;
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{Outcome, Schedule, Setup, run};
use coadjoint_run::{Derived, RunError, System, meet_tolerance, read};
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

/// The run of a system, and the same with steps of a quarter of the size.
fn runs(file: &str, mut system: System) -> Result<(Schedule, usize, [Outcome; 2]), RunError> {
    let path = Path::new(file);
    meet_tolerance(path, &mut system, &coadjoint_run::Accuracy::default())?;
    let (given, truncation) = (system.run.clone(), system.problem.facts().truncation);
    let schedule = Schedule::new(path, None, None, &given)?;
    let momentum = given.momentum.clone().unwrap_or_default();
    let derived = Derived::of_file(path, system)?;
    let run = |step| {
        let schedule = Schedule::of(step, schedule.end.abs())?;
        let group_element = given.group_element.clone();
        let setup = Setup { group_element, ..Setup::new(schedule, momentum.clone()) };
        run(&derived, &setup, &mut ())
    };
    Ok((schedule, truncation, [run(schedule.step)?, run(schedule.step * 0.25)?]))
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
    let mut random = ChaCha8Rng::seed_from_u64(33);
    texts.extend((0..RANDOM).filter_map(|number| {
        let text = text(number, &mut random)?;
        Some((format!("random {number}, {}", GROUPS[number % GROUPS.len()].0), text))
    }));
    println!("| system | K | h | steps | estimate | truth |\n|---|---|---|---|---|---|");
    let (mut judged, mut good) = (0, 0);
    for (name, text) in texts {
        let found = read(&name, &text).and_then(|system| runs(&name, system));
        let (schedule, truncation, [coarse, fine]) = match found {
            Ok(found) => found,
            Err(error) => {
                let line = error.to_string();
                let line = line.split([';', '\n']).next().unwrap_or_default();
                println!("| {name} | | | | {line} | |");
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
            "| {name} | {truncation} | {} | {} | {} | {truth:.1e}{} |",
            shortest((schedule.step * 1e4).round() / 1e4),
            schedule.steps,
            estimate.map_or_else(str::to_owned, |found| format!("{found:.1e}")),
            if near { "" } else { " ✗" },
        );
    }
    println!("\n{good} of {judged} estimates are within a factor of {FACTOR} of the truth.");
    if 10 * good >= 9 * judged { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
