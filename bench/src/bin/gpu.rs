//! Trajectories on a graphics card against one core of this processor, with lanes and machine code.
//!
//! `cargo run --release -p coadjoint-bench --bin gpu -- [--rows n] [--processors] [--peak GFLOPS]`
//!
//! Nanoseconds a step and trajectory; the card's include neither reading states nor building the kernel, but all launches
//! and what the card refuses. One step is compared with the interpreter's, and Casimirs at the end with those at the start.
//! Operations are those of the programs, a fused product counted as two.

use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{REACH, Step};
use coadjoint_codegen::system::{Options, read};
use coadjoint_device::{Api, Card, Device, DeviceError, Refused, Row};
use coadjoint_native::{COptions, Native};
use coadjoint_program::{Kernel, Precision, Scratch, Stepper, WIDTH};

#[derive(Parser)]
struct Arguments {
    /// Trajectories
    #[arg(long, default_value_t = 10_000_000)]
    rows: usize,
    /// Steps of each
    #[arg(long, default_value_t = 4096)]
    steps: u64,
    /// Measure devices that are processors too
    #[arg(long)]
    processors: bool,
    /// The card's peak in 10⁹ operations a second, to be compared with
    #[arg(long)]
    peak: Option<f64>,
}

type Failure = Box<dyn std::error::Error>;

const SYSTEMS: [(&str, &str, f64); 2] = [
    ("rigid body, K = 7", include_str!("../../../examples/rigid_body.toml"), 0.1),
    ("heavy top, K = 7", include_str!("../../../examples/heavy_top.toml"), 0.05),
];

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut reasons = Vec::new();
    let mut measured = false;
    for api in [Api::Cuda, Api::OpenCl] {
        let device = Device { api, number: 0 };
        match measure(device, arguments) {
            Ok(None) => reasons.push(format!("{device} is a processor")),
            Ok(Some(())) => measured = true,
            Err(error) => match error.downcast_ref::<DeviceError>() {
                Some(DeviceError::NoLibrary { .. } | DeviceError::NoDevice { .. }) => {
                    reasons.push(error.to_string());
                }
                _ => return Err(error),
            },
        }
    }
    if !measured {
        println!("nothing was measured, as there is no card here: {}", reasons.join("; "));
    }
    Ok(())
}

/// A step of a system, with its folded coefficients.
fn built(text: &str, h: f64, precision: Precision) -> Result<(Step, Vec<f64>), Failure> {
    let options = Options { truncation: Some(7), ..Options::default() };
    let problem = read(text, options).map_err(|_| "an example is not read")?.problem;
    let integrator = Integrator::build(problem, TermLimit::default())?;
    let step = Step::build_in(&integrator, REACH, precision)?;
    let slots = step.slots(&integrator.coefficients.fold(h, &[]), f64::MAX);
    Ok((step, slots))
}

fn start(step: &Step, row: usize) -> Row {
    let n = step.kernel().dim();
    let mut matrix = vec![0.0; step.kernel().programs().matrix.outputs().len()];
    let size = (matrix.len() as f64).sqrt() as usize;
    (0..size).for_each(|i| matrix[i * size + i] = 1.0);
    let mu = (0..n).map(|i| 0.9 * (1.3 + 2.1 * i as f64 + 1e-3 * row as f64).sin()).collect();
    Row { g: step.element_of(&matrix), mu, ..Row::default() }
}

/// `None` where the device is no card.
fn measure(device: Device, arguments: &Arguments) -> Result<Option<()>, Failure> {
    for (name, text, h) in SYSTEMS {
        let (double, folded) = built(text, h, Precision::Double)?;
        let core = one_core(&double, &folded)?;
        let operations = operations(&double, &folded);
        for precision in [Precision::Double, Precision::Single] {
            let (step, slots) = built(text, h, precision)?;
            let mut card = Card::new(device, step.kernel(), &slots)?;
            if card.is_processor() && !arguments.processors {
                return Ok(None);
            }
            let (off, unit) = first_step(&mut card, &double, &folded)?;
            let mut rows: Vec<Row> = (0..arguments.rows).map(|row| start(&step, row)).collect();
            let before: Vec<Row> = rows.iter().step_by(rows.len().div_ceil(100)).cloned().collect();
            let begun = Instant::now();
            let advanced = card.advance(&mut rows, arguments.steps, &mut end, &|_| {})?;
            let all = begun.elapsed().as_secs_f64();
            let after = rows.iter().step_by(rows.len().div_ceil(100));
            let drift = before.iter().zip(after).map(|(a, b)| drift(&double, &folded, a, b));
            let drift = drift.fold(0.0, f64::max);
            let made = arguments.rows as f64 * arguments.steps as f64;
            let each = 1e9 * advanced.running.as_secs_f64() / made;
            let rate = operations / each;
            println!("{name}, {device} ({}), {precision} precision", card.name());
            println!(
                "  {} trajectories, {} steps: {each:.4} ns a step; with transfers {:.4} ns",
                arguments.rows,
                arguments.steps,
                1e9 * all / made
            );
            println!(
                "  one core with {}: {:.2} ns a step, {:.0} times as long",
                core.1,
                core.0,
                core.0 / each
            );
            println!(
                "  {operations:.0} operations a step: {rate:.0} · 10⁹ a second{}",
                share(rate, arguments)
            );
            println!(
                "  first step off by {off:.2e} (8 n u = {unit:.2e}), Casimirs by {drift:.1e} at the end, {} rows refused",
                advanced.refused
            );
        }
    }
    Ok(Some(()))
}

fn share(rate: f64, arguments: &Arguments) -> String {
    arguments
        .peak
        .map_or_else(String::new, |peak| format!(", {:.0} % of the peak", 100.0 * rate / peak))
}

/// Rows that are refused end there.
fn end(refused: &mut [Refused<'_>], _: u64) {
    refused.iter_mut().for_each(|one| one.row.ended = true);
}

/// Nanoseconds a step and trajectory on one core, and by what.
fn one_core(step: &Step, slots: &[f64]) -> Result<(f64, &'static str), Failure> {
    let kernel = step.kernel();
    let entry = Native::by_c(kernel, &COptions::default()).ok().map(|native| native.entry);
    let (n, m) = (kernel.dim(), kernel.element());
    let (mut g, mut mu) = (vec![0.0; m * WIDTH], vec![0.0; n * WIDTH]);
    for lane in 0..WIDTH {
        let row = start(step, lane);
        (0..m).for_each(|i| g[i * WIDTH + lane] = row.g[i]);
        (0..n).for_each(|i| mu[i * WIDTH + lane] = row.mu[i]);
    }
    const STEPS: u64 = 1 << 14;
    let mut best = f64::INFINITY;
    for _ in 0..9 {
        let begun = Instant::now();
        let made = match &entry {
            Some(entry) => entry.advance_lanes(slots, &mut g, &mut mu, STEPS, [true; WIDTH]),
            None => kernel.advance_lanes(slots, &mut g, &mut mu, STEPS, [true; WIDTH]),
        };
        if made != [STEPS; WIDTH] {
            return Err("a step of the comparison is refused".into());
        }
        best = best.min(1e9 * begun.elapsed().as_secs_f64() / (STEPS as f64 * WIDTH as f64));
    }
    Ok((best, if entry.is_some() { "machine code by C" } else { "the interpreter" }))
}

/// Operations of a step with as many corrections as a few trajectories take.
fn operations(step: &Step, slots: &[f64]) -> f64 {
    const ROWS: usize = 100;
    let kernel = step.kernel();
    let programs = kernel.programs();
    let corrections: u32 = (0..ROWS)
        .map(|row| {
            let Row { mut g, mut mu, .. } = start(step, row);
            kernel.advance(slots, &mut g, &mut mu, 1).corrections
        })
        .sum();
    let fixed = [&programs.guess, &programs.accept, &programs.transport];
    let fixed: usize = fixed.iter().map(|program| program.cost().total()).sum();
    let each = programs.correct.cost().total() as f64;
    fixed as f64 + each * f64::from(corrections) / ROWS as f64
}

/// How far a step is from the interpreter's, relative to μ, and what is allowed.
fn first_step(card: &mut Card, double: &Step, slots: &[f64]) -> Result<(f64, f64), Failure> {
    let kernel: &Kernel = double.kernel();
    let rounded = |list: &mut Vec<f64>| {
        list.iter_mut().for_each(|value| *value = card.precision().round(*value));
    };
    let mut rows: Vec<Row> = (0..1000).map(|row| start(double, row)).collect();
    for row in &mut rows {
        rounded(&mut row.g);
        rounded(&mut row.mu);
    }
    let before = rows.clone();
    card.advance(&mut rows, 1, &mut end, &|_| {})?;
    let mut off = 0.0_f64;
    for (row, mut own) in rows.iter().zip(before) {
        kernel.advance(slots, &mut own.g, &mut own.mu, 1);
        let scale = own.mu.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        for (a, b) in row.mu.iter().zip(&own.mu) {
            off = off.max((a - b).abs() / scale);
        }
    }
    Ok((off, 4.0 * kernel.dim() as f64 * card.precision().epsilon()))
}

/// The largest change of a Casimir, relative to it.
fn drift(step: &Step, slots: &[f64], before: &Row, after: &Row) -> f64 {
    let kernel = step.kernel();
    let watched = |row: &Row| {
        let mut values = vec![0.0; kernel.programs().watch.outputs().len()];
        kernel.watch(slots, &row.g, &row.mu, &mut Scratch::default(), &mut values);
        values
    };
    let (before, after) = (watched(before), watched(after));
    let pairs = before.iter().zip(&after).skip(1);
    pairs.map(|(a, b)| (a - b).abs() / a.abs().max(f64::MIN_POSITIVE)).fold(0.0, f64::max)
}
