//! Times steps made by the command from an example file. The time of a short run is subtracted from that of a long one, so
//! that starting, deriving and compiling do not count.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use crate::systems::{SYSTEMS, Workload, momenta};
use crate::timing::{Contender, Failure, line, medians};

const BODIES: usize = 100_000;
const FEW: u64 = 8;

/// The command: the one given, or the one beside this program.
pub fn find(given: Option<&PathBuf>) -> Result<PathBuf, Failure> {
    let beside = || Some(std::env::current_exe().ok()?.with_file_name("coadjoint"));
    let path = given.cloned().or_else(beside).unwrap_or_default();
    match path.is_file() {
        true => Ok(path),
        false => Err(format!(
            "{}: no such file; build it with cargo build --release -p coadjoint-cli, or name it with --command",
            path.display()
        )
        .into()),
    }
}

/// Runs the command for this many steps and returns how long it took.
fn seconds(
    command: &Path,
    verb: &str,
    system: &Workload,
    steps: u64,
    more: &[String],
) -> Result<Duration, Failure> {
    let mut call = Command::new(command);
    call.args([verb, system.file, "--truncation", &system.truncation.to_string()]);
    call.args(["--step", &system.step.to_string()]);
    call.args(["--time", &(steps as f64 * system.step).to_string()]).args(more);
    let begun = Instant::now();
    let output = call.output()?;
    let took = begun.elapsed();
    match output.status.success() {
        true => Ok(took),
        false => Err(String::from_utf8_lossy(&output.stderr).into_owned().into()),
    }
}

/// A way that makes steps by the command, each of this many trajectories.
fn way<'a>(
    command: &'a Path,
    verb: &'static str,
    system: &'a Workload,
    more: Vec<String>,
    bodies: usize,
) -> Contender<'a> {
    let name = more.iter().filter(|word| !word.contains(['-', '/'])).cloned().collect::<Vec<_>>();
    Contender::process(format!("{verb}, {}", name.join(" ")), bodies, move |steps| {
        let long = seconds(command, verb, system, steps + FEW, &more)?;
        Ok(long.saturating_sub(seconds(command, verb, system, FEW, &more)?))
    })
}

/// Prints nanoseconds a step of single runs; the ratio is to `advance`.
pub fn single(command: &Path, backends: &[String], quick: bool, only: &str) -> Result<(), Failure> {
    println!("Nanoseconds a step, and the ratio to `advance`:\n");
    for system in SYSTEMS.iter().filter(|system| system.name.contains(only)) {
        let mut ways = (system.single)(system.step, system.momentum)?;
        for backend in backends {
            let more = vec!["--backend".to_owned(), backend.clone()];
            ways.push(way(command, "simulate", system, more, 1));
        }
        let found = medians(&mut ways, if quick { 3 } else { 9 })?;
        println!("{}", line(system.name, &ways, &found));
    }
    Ok(())
}

/// Prints nanoseconds a step and trajectory; the ratio is to the attribute's lanes.
pub fn ensembles(
    command: &Path,
    given: &[Vec<String>],
    quick: bool,
    only: &str,
) -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    println!(
        "{BODIES} trajectories; nanoseconds a step of one, and the ratio to the attribute's lanes:\n"
    );
    let folder = std::env::temp_dir().join(format!("coadjoint-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let (states, ends) = (folder.join("states.csv"), folder.join("ends.npy"));
    for system in SYSTEMS.iter().take(2).filter(|system| system.name.contains(only)) {
        let (n, all) = (system.momentum.len(), momenta(system, BODIES));
        let names: Vec<String> = (1..=n).map(|i| format!("mu_{i}")).collect();
        let mut text = names.join(",") + "\n";
        for row in all.chunks_exact(n) {
            let row: Vec<String> = row.iter().map(f64::to_string).collect();
            writeln!(text, "{}", row.join(","))?;
        }
        std::fs::write(&states, text)?;
        let mut ways = (system.lanes)(system.step, all)?;
        for extra in given {
            let mut more = extra.clone();
            for (name, value) in [("--initial", &states), ("--out", &ends)] {
                more.extend([name.to_owned(), value.display().to_string()]);
            }
            more.extend(["--threads=1".to_owned(), "--restart".to_owned()]);
            ways.push(way(command, "ensemble", system, more, BODIES));
        }
        let found = medians(&mut ways, if quick { 3 } else { 7 })?;
        println!("{}", line(system.name, &ways, &found));
    }
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}
