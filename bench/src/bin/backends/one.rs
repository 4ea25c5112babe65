//! One trajectory: the attribute's steps, the programs by each backend, and `simulate` from a file.

use std::hint::black_box;
use std::time::{Duration, Instant};

use coadjoint::{Integrator, Phase, advance, advance_by};
use coadjoint_native::{COptions, CacheFolder, Entry, Native};
use coadjoint_program::{Stepper, WIDTH};
use coadjoint_run::simulate::{Block, Halt, Outlet, Schedule, Setup, run};
use coadjoint_run::{Backend, Derived};
use nalgebra::DMatrix;

use crate::Failure;
use crate::measure::{Way, line, measure};
use crate::text::{Programs, Text};

/// The drift is looked at every so many steps of `simulate`.
const EVERY: u64 = 10;

/// Prints the row of a system.
pub fn row<S: Integrator>(
    text: &Text,
    compiled: &S,
    start: Phase<S::Group>,
) -> Result<(), Failure> {
    let Programs { integrator, step, derived, built } = text.programs()?;
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
        Way::new(name, move |steps| {
            black_box(entry.advance(slots, &mut g, &mut mu, steps));
        })
    };
    let lanes = |name, entry: Entry| {
        let ((mut g, mut mu), slots) = (pack(), &slots);
        Way::new(name, move |steps: u64| {
            let steps = steps / WIDTH as u64;
            black_box(entry.advance_lanes(slots, &mut g, &mut mu, steps, [true; WIDTH]));
        })
    };
    let system = Derived::of(text.system()?)?;
    let mut ways = Vec::new();
    let mut phase = start.clone();
    ways.push(Way::new("advance", move |steps| {
        for _ in 0..steps {
            if advance(compiled, &mut phase).is_err() {
                break;
            }
        }
        black_box(&phase);
    }));
    let mut phase = start;
    ways.push(Way::new("advance_by", move |steps| {
        let _ = black_box(advance_by(compiled, &mut phase, steps));
    }));
    let ((mut g, mut mu), own) = (state(), &slots);
    ways.push(Way::new("interpreter", move |steps| {
        black_box(kernel.advance(own, &mut g, &mut mu, steps));
    }));
    ways.push(entry("C", native.entry.clone()));
    ways.push(simulate("C, simulate", &system, text, Backend::C)?);
    ways.push(lanes("C, lanes", native.entry.clone()));
    #[cfg(feature = "jit")]
    let jit = {
        let begun = Instant::now();
        let code = coadjoint_native::jit::compile(kernel, coadjoint_program::Trajectories::One)?;
        let ready = begun.elapsed();
        ways.push(entry("Cranelift", code));
        ways.push(simulate("Cranelift, simulate", &system, text, Backend::Jit)?);
        let code = coadjoint_native::jit::compile(kernel, coadjoint_program::Trajectories::Lanes)?;
        ways.push(lanes("Cranelift, lanes", code));
        ready
    };
    let medians = measure(&mut ways)?;
    let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
    print!(
        "{} derived in {:.0} ms, programs in {:.0} ms, C in {:.0} ms",
        line(text.name, &ways, &medians),
        milliseconds(derived),
        milliseconds(built),
        milliseconds(native.ready)
    );
    #[cfg(feature = "jit")]
    print!(", Cranelift in {:.0} ms", milliseconds(jit));
    println!(" |");
    Ok(())
}

/// A run from a file, its drift looked at every [`EVERY`] steps. What comes before the first step does not count.
fn simulate<'a>(
    name: &'static str,
    system: &'a Derived,
    text: &'a Text,
    backend: Backend,
) -> Result<Way<'a>, Failure> {
    let setup = move |steps: u64| -> Result<Setup, Failure> {
        let schedule = Schedule::of(text.step, steps as f64 * text.step)?;
        let plain = Setup::new(schedule, text.momentum.clone());
        Ok(Setup { recording: true, every: Some(EVERY), backend, ..plain })
    };
    // What cannot run at all is told here, and not in the middle of the rounds.
    run(system, &setup(EVERY)?, &mut First::default())?;
    Ok(Way::timed(name, move |steps| {
        let mut first = First::default();
        black_box(run(system, &setup(steps)?, &mut first)?);
        Ok(first.0.ok_or("the run has not begun")?.elapsed())
    }))
}

/// When the first step was made.
#[derive(Default)]
struct First(Option<Instant>);

impl Outlet for First {
    fn begin(&mut self, _recorded: &[Block]) -> Result<(), Halt> {
        self.0 = Some(Instant::now());
        Ok(())
    }
}
