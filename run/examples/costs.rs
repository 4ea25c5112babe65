//! `cargo run --release -p coadjoint-run --example costs -- examples/*.toml`
//!
//! Times of the processor that come beside steps, by system files: the estimate of the error, as a share of a run of ten
//! thousand steps; and a row of an ensemble, with the momentum alone, with the attitude, and with the first parameter in a
//! column. Each is the least of some rounds on one thread, rows once there is machine code. A step of a row is the difference
//! of long and short courses.

use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint_codegen::problem::Shape::Scalar;
use coadjoint_codegen::system::Options;
use coadjoint_run::ensemble::{Attitude, Course, Engine, How, Layout, Shape, Watch, in_lanes};
use coadjoint_run::simulate::{Halt, Resume, Schedule, Setup, Sink, run};
use coadjoint_run::{Backend, Derived, RunError, System, meet_tolerance, read_varying};
use num_traits::ToPrimitive;

/// The steps of a run by which the time of an estimate is judged.
const LONG: f64 = 1e4;
/// Rows of an ensemble, and the steps of short and of long courses.
const ROWS: usize = 2048;
const STEPS: [u64; 2] = [1, 65];
/// How often each is measured, and the time after which no further round begins.
const ROUNDS: usize = 11;
const LONGEST: Duration = Duration::from_secs(5);

/// Measures two times in rounds; the least of each.
fn rounds(mut measure: impl FnMut() -> Result<[f64; 2], RunError>) -> Result<[f64; 2], RunError> {
    let begun = Instant::now();
    let mut least = measure()?;
    for _ in 1..ROUNDS {
        if begun.elapsed() < LONGEST {
            let times = measure()?;
            least = [0, 1].map(|part| f64::min(least[part], times[part]));
        }
    }
    Ok(least)
}

/// Time that this thread has had of the processor, in nanoseconds.
fn now() -> f64 {
    // The system counts up to the last time that it looked.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|time| time.parse().ok()).unwrap_or(f64::NAN)
}

/// The time at the last step.
struct Clock(f64);

impl Sink for Clock {
    fn pause(&mut self, _: u64, end: bool, _: &dyn Fn() -> Resume) -> Result<(), Halt> {
        if end {
            self.0 = now();
        }
        Ok(())
    }
}

/// The milliseconds of a run of ten thousand steps, and of the estimate after it.
fn estimate(file: &Path, system: System, step: f64) -> Result<[f64; 2], RunError> {
    let given = system.run.clone();
    let derived = Derived::of_file(file, system)?;
    let schedule = Schedule::of(step, LONG * step.abs())?;
    let setup = Setup::new(schedule, given.momentum.unwrap_or_default());
    let setup = Setup { group_element: given.group_element, ..setup };
    rounds(|| {
        let (begun, mut clock) = (now(), Clock(0.0));
        run(&derived, &setup, &mut clock)?;
        Ok([clock.0 - begun, now() - clock.0].map(|time| time * 1e-6))
    })
}

/// The nanoseconds of a step of a row, and of a row beside its steps, with this attitude, the parameters that vary last.
fn row(file: &Path, system: System, step: f64, attitude: Attitude) -> Result<[f64; 2], RunError> {
    let (momentum, shape) = (system.run.momentum.clone(), Shape::of_system(&system));
    let parameters = system.problem.facts().parameters.to_vec();
    let derived = Derived::of_file(file, in_lanes(system)?)?;
    let how = How { backend: Backend::Auto, work: 1e9, device: None };
    let engine = Engine::new(&derived, step, how)?;
    let names = parameters.iter().map(|parameter| parameter.name.clone()).collect();
    let layout = Layout { shape, attitude, parameters: names };
    let size = if attitude == Attitude::None { 0 } else { shape.matrix_size };
    let identity = (0..size * size).map(|at| f64::from(u8::from(at / size == at % size)));
    let identity: Vec<f64> = match attitude {
        Attitude::Quaternion => vec![1.0, 0.0, 0.0, 0.0],
        _ => identity.collect(),
    };
    let defaults = parameters.iter().flat_map(|parameter| parameter.default.iter().flatten());
    let defaults: Vec<f64> = defaults.map(|value| value.to_f64().unwrap_or(f64::NAN)).collect();
    let momentum = momentum.unwrap_or_default();
    let rows = (0..ROWS).flat_map(|row| {
        let near = 1.0 + 1e-3 * (row as f64 / ROWS as f64);
        let varied = momentum.iter().map(move |mu| mu * near);
        varied.chain(identity.iter().copied()).chain(defaults.iter().map(move |x| x * near))
    });
    let rows: Vec<f64> = rows.collect();
    let stop = AtomicBool::new(false);
    let watch = Watch { made: &|_| {}, stop: &stop };
    while engine.backend() == "interpreter" && engine.notes().is_empty() {
        std::thread::sleep(Duration::from_millis(5));
    }
    let few = rounds(|| {
        let mut times = [0.0; 2];
        for (steps, time) in STEPS.into_iter().zip(&mut times) {
            let course = Course { steps, stops: Vec::new() };
            let begun = now();
            let (_, failed, _) = engine.advance_all(&layout, &course, &rows, &watch)?;
            let took = if failed.is_empty() { now() - begun } else { f64::NAN };
            *time = took / ROWS as f64;
        }
        Ok(times)
    })?;
    let step = (few[1] - few[0]) / (STEPS[1] - STEPS[0]) as f64;
    Ok([step, few[0] - step])
}

/// A line of the table.
fn line(file: &Path) -> Result<String, RunError> {
    let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let read = |varied: &[String]| {
        let options = Options::default();
        let mut system = read_varying(&name, &text, options, varied)?;
        meet_tolerance(file, &mut system, &coadjoint_run::Accuracy::default())?;
        Ok::<_, RunError>(system)
    };
    let system = read(&[])?;
    let step = system.run.step.unwrap_or(0.1);
    let first = system.parameters.iter().find(|own| own.shape == Scalar);
    let first: Vec<String> = first.iter().map(|own| own.name.clone()).collect();
    let [run, after] = estimate(file, system.clone(), step)?;
    let mut cells = vec![format!("{name} | {run:.2} ms | {:.2} %", 100.0 * after / run)];
    let quaternions = Shape::of_system(&system).quaternions;
    let attitude = if quaternions { Attitude::Quaternion } else { Attitude::Matrix };
    for (varied, attitude) in
        [(&[][..], Attitude::None), (&[][..], attitude), (&first[..], Attitude::None)]
    {
        let times = read(varied).and_then(|system| row(file, system, step, attitude));
        cells.push(times.map_or("–".to_owned(), |[step, own]| format!("{step:.0}, {own:.0}")));
    }
    Ok(format!("| {} |", cells.join(" | ")))
}

fn main() -> ExitCode {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    if let Err(error) = pool.build_global() {
        eprintln!("{error}");
        return ExitCode::FAILURE;
    }
    println!(
        "| system | 10⁴ steps | estimate | ns a step, ns a row: momentum | with attitude | with a parameter |\n\
         |---|---|---|---|---|---|"
    );
    for file in std::env::args().skip(1) {
        match line(Path::new(&file)) {
            Ok(line) => println!("{line}"),
            Err(error) => eprintln!("{file}: {error}"),
        }
    }
    ExitCode::SUCCESS
}
