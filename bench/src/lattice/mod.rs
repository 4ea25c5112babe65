//! Spins on a cubic lattice: the families of rotations and Gauss's method beside the classical Runge–Kutta method and the spherical
//! midpoint rule.

mod rivals;

use std::time::{Duration, Instant};

use coadjoint::lattice::{Family, Graph, Lattice, LatticeError, Order};
use nalgebra::{Matrix3, Vector3};

use crate::timing::{Failure, figure};
use rivals::Cube;

type State = Vec<[f64; 3]>;
/// Makes steps of this size, as many as given.
type Steps<'a> = Box<dyn Fn(&mut State, f64, u64) -> Result<(), Failure> + 'a>;

struct Entrant<'a> {
    name: String,
    order: i32,
    /// Steps in the unit of time, few first.
    settings: &'static [u64],
    steps: Steps<'a>,
}

/// A lattice with a state.
struct Specimen {
    name: &'static str,
    cube: Cube,
    lattice: Lattice,
    start: State,
    time: u64,
}

/// Errors that the table has columns for.
const TARGETS: [f64; 3] = [1e-4, 1e-6, 1e-8];

/// Processor time of this thread.
fn processor() -> Option<Duration> {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    told.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

/// The least processor time of several runs; that of the clock where the system does not tell.
fn least(runs: usize, mut run: impl FnMut() -> Result<(), Failure>) -> Result<f64, Failure> {
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let (begun, clock) = (processor(), Instant::now());
        run()?;
        let took = begun.and_then(|begun| processor()?.checked_sub(begun));
        least = least.min(took.unwrap_or_else(|| clock.elapsed()).as_secs_f64());
    }
    Ok(least)
}

/// Numbers in [0, 1).
fn random() -> impl FnMut() -> f64 {
    let mut state = 88_172_645_463_325_252_u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Spins in all directions.
fn hot(sites: usize) -> State {
    let mut random = random();
    let mut spin = || {
        let (z, angle) = (2.0 * random() - 1.0, std::f64::consts::TAU * random());
        let r = (1.0 - z * z).sqrt();
        [r * angle.cos(), r * angle.sin(), z]
    };
    (0..sites).map(|_| spin()).collect()
}

/// Spins in a wave with some disorder.
fn cold(side: usize) -> State {
    let mut random = random();
    let q = std::f64::consts::TAU / side as f64;
    let mut spin = |site: usize| {
        let [x, y, z] = [site % side, site / side % side, site / side.pow(2)].map(|n| q * n as f64);
        let tilt = 0.4 + 0.3 * x.cos() * y.sin() + 0.2 * (2.0 * random() - 1.0);
        let turn = 2.0 * z + 0.2 * (2.0 * random() - 1.0);
        [tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos()]
    };
    (0..side.pow(3)).map(&mut spin).collect()
}

fn lattice(cube: Cube) -> Result<Lattice, LatticeError> {
    let lattice = Lattice::new(Graph::cubic([cube.side; 3])?).nearest(-Matrix3::identity())?;
    let square = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, cube.square));
    lattice.site(Vector3::new(0.0, 0.0, -cube.field), square)
}

fn error(end: &State, exact: &State) -> f64 {
    let squares = end.iter().flatten().zip(exact.iter().flatten()).map(|(a, b)| (a - b).powi(2));
    (squares.sum::<f64>() / end.len() as f64).sqrt()
}

fn rotations<'a>(
    problem: &'a Specimen,
    family: Family,
    order: Order,
    settings: &'static [u64],
) -> Entrant<'a> {
    let steps = move |spins: &mut State, h: f64, steps: u64| {
        Ok(problem.lattice.rotations(family, order, h)?.advance_by(spins, steps)?)
    };
    let order = order.number() as i32;
    Entrant { name: format!("{family}, order {order}"), order, settings, steps: Box::new(steps) }
}

fn gauss<'a, const M: usize>(problem: &'a Specimen, settings: &'static [u64]) -> Entrant<'a> {
    let steps = |spins: &mut State, h: f64, steps: u64| {
        Ok(problem.lattice.gauss::<M>(h)?.advance_by(spins, steps)?)
    };
    let order = 2 * M as i32;
    Entrant { name: format!("Gauss, order {order}"), order, settings, steps: Box::new(steps) }
}

fn methods(problem: &Specimen) -> Result<Vec<Entrant<'_>>, Failure> {
    let cube = problem.cube;
    let rival = |name: &str, order, settings, steps: fn(Cube, &mut rivals::Board, f64, u64)| {
        let made = move |spins: &mut State, h: f64, count: u64| {
            let mut board = cube.read(spins);
            steps(cube, &mut board, h, count);
            cube.write(&board, spins);
            Ok(())
        };
        Entrant { name: name.to_owned(), order, settings, steps: Box::new(made) }
    };
    let mut methods = vec![
        rival("RK4", 4, &[20, 40, 80], Cube::runge_kutta),
        rival("spherical midpoint", 2, &[20, 50, 100], Cube::midpoint),
    ];
    let shift = if problem.name == "cold" { problem.lattice.shift(&problem.start)? } else { 0.0 };
    for family in [Family::Sublattices, Family::Axes { shift }, Family::Bonds] {
        methods.push(rotations(problem, family, Order::Four, &[4, 10, 20, 40]));
        methods.push(rotations(problem, family, Order::Six, &[3, 5, 8, 12]));
        methods.push(rotations(problem, family, Order::Eight, &[3, 4, 5, 6]));
    }
    methods.push(gauss::<2>(problem, &[5, 10, 20]));
    methods.push(gauss::<3>(problem, &[4, 6, 10]));
    methods.push(gauss::<4>(problem, &[3, 5, 6]));
    methods.push(gauss::<5>(problem, &[3, 4]));
    Ok(methods)
}

fn problem(name: &'static str, side: usize) -> Result<Specimen, Failure> {
    let (square, field) = if name == "cold" { (0.3, 0.5) } else { (0.0, 0.0) };
    let cube = Cube { side, square, field };
    let start = if name == "cold" { cold(side) } else { hot(side.pow(3)) };
    let time = if name == "cold" { 2 } else { 1 };
    Ok(Specimen { name, cube, lattice: lattice(cube)?, start, time })
}

/// Nanoseconds of a spin and unit of time at each error, by the order of the method from the setting that is nearest; and the
/// nanoseconds of a step there.
fn costs(
    problem: &Specimen,
    method: &Entrant<'_>,
    exact: &State,
    runs: usize,
) -> Result<[f64; TARGETS.len()], Failure> {
    let mut found = Vec::new();
    for &setting in method.settings {
        let (count, h) = (setting * problem.time, 1.0 / setting as f64);
        let mut end = problem.start.clone();
        (method.steps)(&mut end, h, count)?;
        let error = error(&end, exact);
        // The difference of two runs has no beginning and no end.
        let more = 1 + 40 / count;
        let mut timed = |count: u64| {
            least(runs, || {
                end.clone_from(&problem.start);
                (method.steps)(&mut end, h, count)
            })
        };
        let took = timed((more + 1) * count)? - timed(count)?;
        let cost = took * 1e9 / (more * problem.time) as f64 / end.len() as f64;
        eprintln!(
            "{} {}, h = {h:.4}: error {error:.1e}, {:.1} ns a step",
            problem.name,
            method.name,
            cost / setting as f64
        );
        found.push((error, cost));
    }
    Ok(TARGETS.map(|target| {
        let gap = |found: &&(f64, f64)| (found.0 / target).ln().abs();
        let nearest = found.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
        nearest.map_or(f64::NAN, |(error, cost)| {
            cost * (error / target).powf(1.0 / f64::from(method.order))
        })
    }))
}

/// Prints the tables.
pub fn tables(quick: bool, only: &str) -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let runs = if quick { 2 } else { 7 };
    for name in ["hot", "cold"] {
        if name.contains(only) {
            work(&problem(name, 32)?, runs)?;
        }
    }
    if "laws".contains(only) {
        laws(if quick { 10 } else { 1000 })?;
    }
    if "sizes".contains(only) {
        sizes(runs)?;
    }
    Ok(())
}

/// The time for an error, and how many times as long RK4 takes.
fn work(problem: &Specimen, runs: usize) -> Result<(), Failure> {
    let mut exact = problem.start.clone();
    problem.lattice.gauss::<6>(0.0625)?.advance_by(&mut exact, 16 * problem.time)?;
    let heads = TARGETS.map(|target| format!("{target:.0e}")).join(" | ");
    println!(
        "{}, {}³: ns a spin and unit of time at an error; RK4's over it\n",
        problem.name, problem.cube.side
    );
    println!("| method | {heads} |\n|---|{}", "---:|".repeat(TARGETS.len()));
    let mut rival = [f64::NAN; TARGETS.len()];
    for method in methods(problem)? {
        let costs = costs(problem, &method, &exact, runs)?;
        if method.name == "RK4" {
            rival = costs;
        }
        let cell = |(cost, rival): (&f64, &f64)| format!("{} ({:.2})", figure(*cost), rival / cost);
        let cells: Vec<_> = costs.iter().zip(&rival).map(cell).collect();
        println!("| {} | {} |", method.name, cells.join(" | "));
    }
    println!();
    Ok(())
}

/// Changes of the energy, the total spin and the lengths over a long time, 16³.
fn laws(time: u64) -> Result<(), Failure> {
    println!(
        "16³, hot, T = {time}: changes a spin\n\n| method | energy | total spin | length |\n|---|---|---|---|"
    );
    let problem = problem("hot", 16)?;
    let family = |family| rotations(&problem, family, Order::Four, &[10]);
    let axes = Family::Axes { shift: 0.0 };
    let methods = [
        family(Family::Sublattices),
        family(axes),
        family(Family::Bonds),
        gauss::<2>(&problem, &[5]),
    ];
    for method in methods {
        let setting = method.settings[0];
        let mut end = problem.start.clone();
        (method.steps)(&mut end, 1.0 / setting as f64, time * setting)?;
        let sites = end.len() as f64;
        let energy = problem.lattice.energy(&end)? - problem.lattice.energy(&problem.start)?;
        let [now, before] = [&end, &problem.start].map(|spins| problem.lattice.total_spin(spins));
        let spin = (Vector3::from(now?) - Vector3::from(before?)).norm();
        let length = end.iter().map(|s| (Vector3::from(*s).norm() - 1.0).abs()).fold(0.0, f64::max);
        println!(
            "| {} | {:.1e} | {:.1e} | {length:.1e} |",
            method.name,
            energy.abs() / sites,
            spin / sites
        );
    }
    println!();
    Ok(())
}

/// The time of a step, and sweeps of Gauss's, for several sizes; the time until the first step is made.
fn sizes(runs: usize) -> Result<(), Failure> {
    println!(
        "Hot: ns a spin and step of order 4 (h = 0.1; Gauss 0.2), sweeps a step of Gauss's, seconds to build the graph and make a step of axes\n"
    );
    println!(
        "| side | sublattices | axes | bonds | Gauss | sweeps | first step |\n|---|---|---|---|---|---|---|"
    );
    for side in [16_usize, 32, 64, 100] {
        let start = hot(side.pow(3));
        let cube = Cube { side, square: 0.0, field: 0.0 };
        let lattice = lattice(cube)?;
        let steps = 2_000_000_u64.div_ceil(start.len() as u64);
        let scale = 1e9 / (start.len() as u64 * steps) as f64;
        print!("| {side} |");
        for family in [Family::Sublattices, Family::Axes { shift: 0.0 }, Family::Bonds] {
            let mut step = lattice.rotations(family, Order::Four, 0.1)?;
            let mut spins = start.clone();
            let took = least(runs, || Ok(step.advance_by(&mut spins, steps)?))?;
            print!(" {} |", figure(took * scale));
        }
        let mut step = lattice.gauss::<2>(0.2)?;
        let mut spins = start.clone();
        let took = least(1, || Ok(step.advance_by(&mut spins, steps.max(5))?))?;
        let sweeps = step.sweeps() as f64 / steps.max(5) as f64;
        let scale = 1e9 / (start.len() as u64 * steps.max(5)) as f64;
        let first = least(1, || {
            let lattice = self::lattice(cube)?;
            let mut step = lattice.rotations(Family::Axes { shift: 0.0 }, Order::Four, 0.1)?;
            Ok(step.advance_by(&mut spins, 1)?)
        })?;
        println!(" {} | {sweeps:.1} | {first:.2} |", figure(took * scale));
    }
    println!();
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// The rivals' equations are those of the lattice, and each has its order.
    #[test]
    fn rivals_converge_to_the_same_motion() {
        let problem = problem("cold", 16).unwrap();
        let mut exact = problem.start.clone();
        problem.lattice.gauss::<3>(0.05).unwrap().advance_by(&mut exact, 5).unwrap();
        for method in &methods(&problem).unwrap()[..2] {
            let error = |steps: u64| {
                let mut end = problem.start.clone();
                (method.steps)(&mut end, 0.25 / steps as f64, steps).unwrap();
                error(&end, &exact)
            };
            let found = (error(5) / error(10)).log2();
            assert!((found - f64::from(method.order)).abs() < 0.3, "{}: {found}", method.name);
        }
    }
}
