//! Steps of systems that are read from a file, against the steps that the attribute compiles.
//!
//! `cargo run --release -p coadjoint-bench --bin backends [--features jit]`
//!
//! Nanoseconds a step; every way runs once per round, and the median over the rounds counts. In brackets the ratio to
//! `advance` of the attribute's code, in the same rounds.

use std::hint::black_box;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use coadjoint::groups::{Power, SU3};
use coadjoint::{Integrator, Phase, SE3, SO3, advance, advance_by, lie_poisson};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator;
use coadjoint_codegen::step::{REACH, Step};
use coadjoint_codegen::system::{Options, read};
use coadjoint_native::{COptions, CacheFolder, Entry, Native};
#[cfg(feature = "jit")]
use coadjoint_program::Trajectories;
use coadjoint_program::{Stepper, WIDTH};
use nalgebra::DMatrix;

/// Rounds over all ways.
const ROUNDS: usize = 31;
/// How long a way runs in a round, about.
const SAMPLE: Duration = Duration::from_millis(4);

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[lie_poisson(group = SE3, truncation = 7)]
fn heavy_top(mu: [f64; 6], inverse: [f64; 3], weight: f64) -> f64 {
    0.5 * (inverse[0] * mu[0] * mu[0] + inverse[1] * mu[1] * mu[1] + inverse[2] * mu[2] * mu[2])
        + weight * mu[5]
}

// Numbers in place of parameters: with these the series has a hundred times as many terms.
#[lie_poisson(group = SE3, truncation = 9)]
fn kirchhoff(mu: [f64; 6]) -> f64 {
    0.5 * (mu[0] * mu[0] + 0.5 * mu[1] * mu[1] + 0.25 * mu[2] * mu[2])
        + 0.5 * (mu[3] * mu[3] + 0.5 * mu[4] * mu[4] + 0.25 * mu[5] * mu[5])
}

#[lie_poisson(group = SU3, truncation = 5)]
fn quadratic(mu: [f64; 8]) -> f64 {
    0.5 * (mu[0] * mu[0] + 0.8 * mu[1] * mu[1] + 0.625 * mu[2] * mu[2] + 0.5 * mu[3] * mu[3])
        + 0.5 * (0.4 * mu[4] * mu[4] + 0.3125 * mu[5] * mu[5] + 0.25 * mu[6] * mu[6])
        + 0.1 * mu[7] * mu[7]
}

#[lie_poisson(group = SO3^4, truncation = 5)]
fn ring(mu: [f64; 12], j: f64) -> f64 {
    let mut sum = 0.0;
    for site in 0..4 {
        for axis in 0..3 {
            sum -= j * mu[3 * site + axis] * mu[(3 * site + axis + 3) % 12];
        }
    }
    sum
}

/// Something that makes so many steps.
struct Way<'a> {
    name: &'static str,
    run: Box<dyn FnMut(u64) + 'a>,
}

/// A system as a file has it.
struct Text {
    name: &'static str,
    group: &'static str,
    hamiltonian: String,
    truncation: usize,
    step: f64,
    momentum: Vec<f64>,
}

type Failure = Box<dyn std::error::Error>;

fn row<S: Integrator>(text: &Text, compiled: &S, start: Phase<S::Group>) -> Result<(), Failure> {
    let coordinates: Vec<String> = (0..text.momentum.len()).map(|i| format!("\"m{i}\"")).collect();
    let file = format!(
        "group = \"{}\"\ncoordinates = [{}]\nhamiltonian = \"{}\"\n",
        text.group,
        coordinates.join(", "),
        text.hamiltonian
    );
    let begun = Instant::now();
    let options = Options { truncation: Some(text.truncation), ..Options::default() };
    let problem =
        read(&file, options).map_err(|mistakes| mistakes.render("the file", &file))?.problem;
    let integrator = integrator::Integrator::build(problem, TermLimit::default())?;
    let derived = begun.elapsed();
    let step = Step::build(&integrator, REACH)?;
    let programs = begun.elapsed() - derived;
    let kernel = step.kernel();
    let slots = step.slots(&integrator.coefficients.fold(text.step, &[]), f64::MAX);
    let size = (kernel.programs().matrix.outputs().len() as f64).sqrt() as usize;
    let identity = step.element_of(DMatrix::<f64>::identity(size, size).as_slice());
    let native =
        Native::by_c(kernel, &COptions { cache: CacheFolder::None, ..COptions::default() })?;

    let state = || (identity.clone(), text.momentum.clone());
    let pack = || {
        let wide = |list: &[f64]| list.iter().flat_map(|x| [*x; WIDTH]).collect::<Vec<f64>>();
        (wide(&identity), wide(&text.momentum))
    };
    let entry = |name, entry: Entry| {
        let ((mut g, mut mu), slots) = (state(), &slots);
        let run = move |steps| {
            black_box(entry.advance(slots, &mut g, &mut mu, steps));
        };
        Way { name, run: Box::new(run) }
    };
    let lanes = |name, entry: Entry| {
        let ((mut g, mut mu), slots) = (pack(), &slots);
        let run = move |steps: u64| {
            let steps = steps / WIDTH as u64;
            black_box(entry.advance_lanes(slots, &mut g, &mut mu, steps, [true; WIDTH]));
        };
        Way { name, run: Box::new(run) }
    };
    let mut ways = Vec::new();
    let mut phase = start.clone();
    ways.push(Way {
        name: "advance",
        run: Box::new(move |steps| {
            for _ in 0..steps {
                if advance(compiled, &mut phase).is_err() {
                    break;
                }
            }
            black_box(&phase);
        }),
    });
    let mut phase = start;
    ways.push(Way {
        name: "advance_by",
        run: Box::new(move |steps| {
            let _ = black_box(advance_by(compiled, &mut phase, steps));
        }),
    });
    let ((mut g, mut mu), own) = (state(), &slots);
    ways.push(Way {
        name: "interpreter",
        run: Box::new(move |steps| {
            black_box(kernel.advance(own, &mut g, &mut mu, steps));
        }),
    });
    ways.push(entry("C", native.entry.clone()));
    ways.push(lanes("C, lanes", native.entry.clone()));
    #[cfg(feature = "jit")]
    let jit = {
        let begun = Instant::now();
        let code = coadjoint_native::jit::compile(kernel, Trajectories::Both)?;
        let ready = begun.elapsed();
        ways.push(entry("Cranelift", code.clone()));
        ways.push(lanes("Cranelift, lanes", code));
        ready
    };
    let medians = measure(&mut ways);
    let first = medians[0].max(f64::MIN_POSITIVE);
    print!("| {} |", text.name);
    for (way, median) in ways.iter().zip(&medians) {
        print!(" {} {median:.0} ({:.2}) |", way.name, median / first);
    }
    let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
    print!(
        " derived in {:.0} ms, programs in {:.0} ms, C in {:.0} ms",
        milliseconds(derived),
        milliseconds(programs),
        milliseconds(native.ready)
    );
    #[cfg(feature = "jit")]
    print!(", Cranelift in {:.0} ms", milliseconds(jit));
    println!(" |");
    Ok(())
}

/// The median nanoseconds of a step of each way.
fn measure(ways: &mut [Way<'_>]) -> Vec<f64> {
    let counts: Vec<u64> = ways
        .iter_mut()
        .map(|way| {
            let mut count = 64;
            loop {
                let begun = Instant::now();
                (way.run)(count);
                let took = begun.elapsed();
                if took >= SAMPLE / 4 {
                    let each = took.as_secs_f64() / count as f64;
                    return (SAMPLE.as_secs_f64() / each) as u64 + 1;
                }
                count *= 2;
            }
        })
        .collect();
    let mut samples = vec![Vec::with_capacity(ROUNDS); ways.len()];
    for _ in 0..ROUNDS {
        for ((way, &count), samples) in ways.iter_mut().zip(&counts).zip(&mut samples) {
            let begun = Instant::now();
            (way.run)(count);
            samples.push(begun.elapsed().as_secs_f64() * 1e9 / count as f64);
        }
    }
    let median = |mut list: Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    samples.into_iter().map(median).collect()
}

fn squares(weights: &[f64]) -> String {
    let term = |(i, w): (usize, &f64)| format!("{w}*m{i}^2/2");
    weights.iter().enumerate().map(term).collect::<Vec<_>>().join(" + ")
}

fn run() -> Result<(), Failure> {
    let text = |name, group, hamiltonian, truncation, step, momentum: &[f64]| Text {
        name,
        group,
        hamiltonian,
        truncation,
        step,
        momentum: momentum.to_vec(),
    };
    let body = [2.0, 0.5, 1.0];
    row(
        &text("rigid body, K = 7", "SO3", squares(&[0.8, 0.5, 0.4]), 7, 0.1, &body),
        &RigidBody::new(0.1, [1.25, 2.0, 2.5])?,
        Phase::<SO3>::at_identity(body),
    )?;
    let top = [0.3, -0.2, 2.0, 0.1, 0.2, 0.97];
    let weights = squares(&[0.8, 0.5, 0.4]);
    row(
        &text("heavy top, K = 7", "SE3", format!("{weights} + 0.981*m5"), 7, 0.05, &top),
        &HeavyTop::new(0.05, [0.8, 0.5, 0.4], 0.981)?,
        Phase::<SE3>::at_identity(top),
    )?;
    let fluid = [1.0, 0.5, 0.2, 0.3, 0.4, 0.5];
    row(
        &text(
            "Kirchhoff, K = 9",
            "SE3",
            squares(&[1.0, 0.5, 0.25, 1.0, 0.5, 0.25]),
            9,
            0.1,
            &fluid,
        ),
        &Kirchhoff::new(0.1)?,
        Phase::<SE3>::at_identity(fluid),
    )?;
    let colours = [0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5];
    let w = [1.0, 0.8, 0.625, 0.5, 0.4, 0.3125, 0.25, 0.2];
    row(
        &text("su(3), K = 5", "SU3", squares(&w), 5, 0.1, &colours),
        &Quadratic::new(0.1)?,
        Phase::<SU3>::at_identity(colours),
    )?;
    let spins = [0.6, 0.0, 0.8, 0.0, 0.8, 0.6, -0.48, 0.64, 0.6, 0.36, -0.48, -0.8];
    let term = |i: usize| format!("-m{i}*m{}", (i + 3) % 12);
    let exchange = (0..12).map(term).collect::<Vec<_>>().join(" ");
    row(
        &text("ring of four spins, K = 5", "SO3^4", exchange, 5, 0.05, &spins),
        &Ring::new(0.05, 1.0)?,
        Phase::<Power<SO3, 4, 12>>::at_identity(spins),
    )?;
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
