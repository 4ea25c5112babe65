//! Runs of lattices of spins, as a system file describes them.
//!
//! Steps are exact rotations of a [`Family`], or Gauss's method. Which one is chosen, the step for a tolerance, and the error at the
//! end are found on a cut of at most 16 cells an axis, so that they take no longer than on a small lattice.

mod method;
mod problem;

use std::path::{Path, PathBuf};
use std::time::Instant;

use coadjoint::lattice::{Family, LatticeError, Order};
use coadjoint_codegen::system::{lattice as text, read_lattice};
use serde::{Deserialize, Serialize};

use crate::asked::Accuracy;
use crate::error::RunError;
use crate::grid::Grid;
use crate::simulate::Schedule;
pub use method::Algorithm;
pub use problem::Arrays;
use problem::{Contents, Files, Magnet, Misplaced, Spins, StartError};

/// Halvings of a step after which a tolerance counts as not met.
const MOST_HALVINGS: u32 = 8;
/// An error below which one that no longer falls is rounding.
const ROUNDING: f64 = 1e-9;
/// The truncation of a run with a step that asks for none: order 6.
const TRUNCATION: usize = 5;
/// Steps by collocation, which are guessed from those before them, begin anew after this number, so that a run can go on there.
const RENEWAL: u64 = 32;

/// A lattice and its spins, ready to run.
#[derive(Debug)]
pub struct Simulation {
    /// The system file.
    path: PathBuf,
    source: String,
    text: text::Lattice,
    problem: Magnet,
    cut: Magnet,
    start: Vec<[f64; 3]>,
}

/// The method and the steps of a run.
#[derive(Clone, Debug)]
pub struct Itinerary {
    /// The method of all steps.
    pub method: Algorithm,
    /// The steps.
    pub schedule: Schedule,
    /// The methods that were tried for `auto`, with the seconds that each takes on the cut for equal errors.
    pub tried: Vec<(Algorithm, f64)>,
    /// The estimated error at the end, where the step was chosen by it.
    pub error: Option<f64>,
}

/// A moment of a run.
#[derive(Clone, Debug)]
pub struct Record {
    /// The time.
    pub time: f64,
    /// The mean of all spins.
    pub magnetisation: [f64; 3],
    /// The energy.
    pub energy: f64,
    /// The spins of the sites that are recorded.
    pub spins: Vec<[f64; 3]>,
}

/// News of a run.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// A moment to record.
    Record(&'a Record),
    /// This number of steps is made; where there are spins, a run may go on from them.
    Steps(u64, Option<&'a [[f64; 3]]>),
}

/// A point of a run from which it may go on.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Waypoint {
    /// Steps made.
    pub step: u64,
    /// The spins after them.
    pub spins: Vec<[f64; 3]>,
    splitting: String,
    order: u32,
    /// The step size asked for, or found.
    asked: f64,
    error: Option<f64>,
}

impl Itinerary {
    /// The point of its run after some steps, with the spins there.
    #[must_use]
    pub fn waypoint(&self, step: u64, spins: &[[f64; 3]]) -> Waypoint {
        Waypoint {
            step,
            spins: spins.to_vec(),
            splitting: self.method.name(),
            order: self.method.order(),
            asked: self.schedule.asked,
            error: self.error,
        }
    }
}

/// The end of a run.
#[derive(Clone, Debug)]
pub struct Conclusion {
    /// The method and the steps.
    pub plan: Itinerary,
    /// The spins at the end.
    pub spins: Vec<[f64; 3]>,
    /// The moments at the start and at the end.
    pub ends: [Record; 2],
    /// The largest relative change of the length of a spin.
    pub lengths: f64,
    /// The estimated error at the end: the root of the mean square of that of a spin, over that of a length.
    pub error: Option<f64>,
}

impl Simulation {
    /// The lattice of a text, which is called `path` and names its files relative to it, unless arrays of these names are given;
    /// `None` of a system without `[lattice]`.
    ///
    /// # Errors
    /// All mistakes, each at its place, and files that do not fit.
    pub fn read(path: &Path, source: &str, given: &Arrays) -> Result<Option<Self>, RunError> {
        let name = path.display().to_string();
        let read = read_lattice(source);
        let read = read.map_err(|mistakes| RunError::Input(mistakes.render(&name, source)))?;
        let Some(text) = read else { return Ok(None) };
        let placed = |Misplaced(place, what): Misplaced| {
            RunError::Input(text::Lattice::mistake(place, &what).render(&name, source))
        };
        let files = Files { system: path, given };
        let tables = Contents::read(files, &text).map_err(placed)?;
        let problem = Magnet::whole(&text, &tables).map_err(placed)?;
        let sites = problem.lattice.graph().sites();
        if let Some(bad) = text.sites.iter().find(|site| **site >= sites) {
            let what = format!("`sites` of [run]: there is no site {bad}, but 0 to {}", sites - 1);
            return Err(placed(Misplaced(text.place, what)));
        }
        let graph = problem.lattice.graph();
        let cut = Magnet::cut(&text, &tables, graph).map_err(placed)?;
        let start = problem::start(files, &text, graph);
        let start = start.map_err(|error| StartError::placed(error, path, placed))?;
        let (path, source) = (path.to_owned(), source.to_owned());
        Ok(Some(Self { path, source, text, problem, cut, start }))
    }

    /// The description.
    #[must_use]
    pub fn text(&self) -> &text::Lattice {
        &self.text
    }

    /// The number of sites.
    #[must_use]
    pub fn sites(&self) -> usize {
        self.start.len()
    }

    /// The number of sites by which steps are chosen and errors are estimated.
    #[must_use]
    pub fn cut_sites(&self) -> usize {
        self.cut.lattice.graph().sites()
    }

    /// The spins at the start, in the order of the sites.
    #[must_use]
    pub fn start(&self) -> &[[f64; 3]] {
        &self.start
    }

    /// The text of the system.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The sites of the plane of the first two axes that the third one begins with, in their places, every n-th cell so that there are
    /// at most `most` along an axis; none of a graph by edges.
    #[must_use]
    pub fn plane(&self, most: usize) -> Option<Vec<(usize, [f64; 2])>> {
        let graph = self.problem.lattice.graph();
        if self.text.edges.is_some() {
            return None;
        }
        const HEIGHT: f64 = 0.866_025_403_784_438_6;
        let (kind, length) = (self.text.kind, |axis| graph.shape().get(axis).copied().unwrap_or(1));
        let place = |row: usize, column: usize, site: usize| {
            let [u, v] = match (kind, site) {
                ("honeycomb", 1) => [1.0 / 3.0; 2],
                ("kagome", 1) => [0.5, 0.0],
                ("kagome", 2) => [0.0, 0.5],
                _ => [0.0; 2],
            };
            let [u, v] = [u + row as f64, v + column as f64];
            if kind == "cubic" { [u, v] } else { [u + 0.5 * v, HEIGHT * v] }
        };
        let every = length(0).max(length(1)).div_ceil(most.max(1)).max(1);
        let columns = || (0..length(1)).step_by(every);
        let rows = (0..length(0)).step_by(every);
        let rows = rows.flat_map(|row| columns().map(move |column| (row, column)));
        let of = |(row, column): (usize, usize)| {
            let first = (row * length(1) + column) * length(2) * graph.cell();
            (0..graph.cell()).map(move |site| (first + site, place(row, column, site)))
        };
        Some(rows.flat_map(of).collect())
    }

    /// The spins of the cut.
    fn cut_of(&self, spins: &[[f64; 3]]) -> Spins {
        match &self.cut.cut {
            Some(sites) => sites.iter().map(|site| spins[*site]).collect(),
            None => spins.to_vec(),
        }
    }

    /// The methods that the file leaves open, at an order or, where none is asked for, at some.
    fn candidates(&self, orders: &[Order]) -> Result<Vec<Algorithm>, RunError> {
        let refuse = |what: String| RunError::of(&self.path)(what);
        let nodes = self.text.truncation.unwrap_or(TRUNCATION).div_ceil(2);
        let beyond = self.problem.is_beyond_rotations();
        let axes = || {
            let shift = self.problem.lattice.shift(&self.start);
            shift.map(|shift| Family::Axes { shift }).map_err(RunError::of(&self.path))
        };
        let families = match self.text.splitting {
            "collocation" => return Ok(vec![Algorithm::Gauss(nodes)]),
            "auto" if beyond.is_some() => return Ok(vec![Algorithm::Gauss(nodes)]),
            "auto" => vec![axes()?, Family::Bonds],
            name if let Some(reason) = beyond => {
                return Err(refuse(format!(
                    "splitting = \"{name}\": {reason}: write method = \"collocation\""
                )));
            }
            "axes" => vec![axes()?],
            "bonds" => vec![Family::Bonds],
            _ => vec![Family::Sublattices],
        };
        let all = orders
            .iter()
            .flat_map(|order| families.iter().map(|family| Algorithm::Rotations(*family, *order)));
        let (mut admitted, mut reason) = (Vec::new(), None);
        for method in all {
            match self.cut.steps(method, 1.0) {
                Ok(_) => admitted.push(method),
                Err(error) => reason = Some(error),
            }
        }
        match reason.filter(|_| admitted.is_empty()) {
            Some(error) => Err(refuse(error.to_string())),
            None => Ok(admitted),
        }
    }

    fn tolerance(&self, asked: &Accuracy) -> Option<f64> {
        asked.tolerance.or(self.text.run.tolerance.filter(|_| asked.step.is_none()))
    }

    /// The step that is given.
    fn step(&self, asked: &Accuracy) -> Option<f64> {
        asked.step.or(self.text.run.step).filter(|_| self.tolerance(asked).is_none())
    }

    /// Chooses method and step, by what is asked for, else by the file; those of a run that went as far as some point.
    ///
    /// # Errors
    /// Steps and times that make no sense, families that do not admit the energy, a tolerance that is not met.
    pub fn plan(&self, asked: &Accuracy, from: Option<&Waypoint>) -> Result<Itinerary, RunError> {
        if let Some(from) = from {
            return self.plan_again(asked, from);
        }
        let run = &self.text.run;
        let tolerance = self.tolerance(asked);
        let orders = match (self.text.truncation, tolerance) {
            (None, Some(_)) => vec![Order::Four, Order::Six, Order::Eight],
            (truncation, _) => vec![match truncation.unwrap_or(TRUNCATION) {
                1 => Order::Two,
                3 => Order::Four,
                5 => Order::Six,
                _ => Order::Eight,
            }],
        };
        let candidates = self.candidates(&orders)?;
        let time = asked.time.or(run.time).ok_or_else(|| RunError::no_time(&self.path))?;
        let step = self.step(asked);
        if tolerance.is_none() && step.is_none() {
            return Err(RunError::no_step(&self.path));
        }
        let start = asked.start(run);
        let of = |step: f64| Schedule::of(Grid { start, step }, time);
        let spins = self.cut_of(&self.start);
        let failed =
            |error: LatticeError| RunError::Run { time: start, step: 0, what: error.to_string() };
        if let (&[method], Some(step)) = (&candidates[..], step) {
            return Ok(Itinerary { method, schedule: of(step)?, tried: Vec::new(), error: None });
        }
        // A fifth of a radian, and up to ten of these.
        let speed = self.cut.speed(start, &spins).map_err(failed)?;
        let trial = step.unwrap_or(0.2 / speed).abs().min(time).copysign(step.unwrap_or(1.0));
        let count = (time / trial.abs()).clamp(1.0, 10.0).floor();
        let part = count * trial.abs() / time;
        let (mut found, mut reason) = (Vec::new(), None);
        for method in candidates {
            let at =
                |step: f64, steps: u64| self.of_cut((method, step), spins.clone(), start, steps);
            let pair = || {
                let fine = [at(0.5 * trial, 2 * count as u64)?, at(0.5 * trial, 2 * count as u64)?];
                Ok((at(trial, count as u64)?, fine))
            };
            let (coarse, [fine, again]) = match pair() {
                Ok(pair) => pair,
                Err(error) => {
                    reason = Some(error);
                    continue;
                }
            };
            let error = error_of(method, &coarse.0, &fine.0);
            found.push((method, error.max(f64::MIN_POSITIVE), fine.1.min(again.1)));
        }
        let Some(&(_, first, _)) = found.first() else {
            return Err(failed(reason.unwrap_or(LatticeError::NoEdges)));
        };
        let wanted = tolerance.map_or(first, |tolerance| tolerance * part);
        // The ratio of the step with the error wanted to the step tried.
        let ratio =
            |method: Algorithm, error: f64| (wanted / error).powf(1.0 / f64::from(method.order()));
        let cost = |&(method, error, seconds): &(Algorithm, f64, f64)| {
            (method, seconds / ratio(method, error))
        };
        found.sort_by(|a, b| cost(a).1.total_cmp(&cost(b).1));
        let (method, error, _) = found[0];
        let mut tried: Vec<(Algorithm, f64)> = found.iter().map(cost).collect();
        if tried.len() == 1 {
            tried.clear();
        }
        if let Some(step) = step {
            return Ok(Itinerary { method, schedule: of(step)?, tried, error: None });
        }
        let tolerance = tolerance.unwrap_or(0.0);
        let mut schedule = of((trial * ratio(method, error)).min(time))?;
        let whole = |schedule: &Schedule| {
            let made = self.of_cut((method, schedule.step), spins.clone(), start, schedule.steps);
            made.ok().map(|(end, _)| end)
        };
        let (mut coarse, mut before) = (whole(&schedule), f64::INFINITY);
        for _ in 0..MOST_HALVINGS {
            let half = of(0.5 * schedule.step)?;
            let fine = whole(&half);
            if let (Some(coarse), Some(fine)) = (&coarse, &fine) {
                let error = error_of(method, coarse, fine);
                if error <= tolerance {
                    return Ok(Itinerary { method, schedule, tried, error: Some(error) });
                }
                if error < ROUNDING && error > 0.5 * before {
                    break;
                }
                before = error;
            }
            (coarse, schedule) = (fine, half);
        }
        Err(RunError::of(&self.path)(format!(
            "no step above {:.1e} meets the tolerance {tolerance:e} over the time {time}: disordered spins move chaotically, and errors \
             grow exponentially, from rounding too; ask for a larger tolerance or a shorter time, or give a step",
            schedule.step.abs()
        )))
    }

    /// The plan of a run that went as far as this point.
    fn plan_again(&self, asked: &Accuracy, found: &Waypoint) -> Result<Itinerary, RunError> {
        let orders = [Order::Two, Order::Four, Order::Six, Order::Eight];
        let mut all = self.candidates(&orders)?.into_iter();
        let own =
            |method: &Algorithm| method.name() == found.splitting && method.order() == found.order;
        let (Some(method), true) = (all.find(own), found.spins.len() == self.sites()) else {
            return Err(RunError::of(&self.path)(
                "the state to go on from is not one of this lattice",
            ));
        };
        let time = asked.time.or(self.text.run.time);
        let time = time.ok_or_else(|| RunError::no_time(&self.path))?;
        let step = self.step(asked).unwrap_or(found.asked);
        let schedule = Schedule::of(Grid { start: asked.start(&self.text.run), step }, time)?;
        Ok(Itinerary { method, schedule, tried: Vec::new(), error: found.error })
    }

    /// Makes all steps of a plan, or those after a point that an earlier run has come to. With `every`, every n-th of them is
    /// recorded, and the last. `told` is given the news and returns false to stop.
    ///
    /// # Errors
    /// Steps that cannot be made; [`RunError::Halted`] where it was told to stop.
    pub fn run(
        &self,
        plan: Itinerary,
        (every, estimate): (Option<u64>, bool),
        from: Option<&Waypoint>,
        told: &mut dyn FnMut(News<'_>) -> bool,
    ) -> Result<Conclusion, RunError> {
        let Itinerary { method, schedule, .. } = &plan;
        let halted = |n: u64| RunError::Halted { time: schedule.time(n), step: n };
        let failed = |n: u64| {
            move |error: LatticeError| RunError::Run {
                time: schedule.time(n),
                step: n + 1,
                what: error.to_string(),
            }
        };
        let mut tell = |n: u64, news: News<'_>| if told(news) { Ok(()) } else { Err(halted(n)) };
        let first = self.record(schedule.start, &self.start)?;
        let mut spins = from.map_or(&self.start, |from| &from.spins).clone();
        let mut steps = self.problem.steps(*method, schedule.step).map_err(failed(0))?;
        if every.is_some() && from.is_none() {
            tell(0, News::Record(&first))?;
        }
        // Steps at a time: about a twentieth of a second's, or one where each has its own time.
        let (mut made, mut share) = (from.map_or(0, |from| from.step), 1);
        let mut last = self.record(schedule.time(made), &spins)?;
        let renewal = if matches!(method, Algorithm::Gauss(_)) { RENEWAL } else { 1 };
        let next = |made: u64, every: u64| (made / every + 1) * every;
        while made < schedule.steps {
            let end = every.map_or(schedule.steps, |every| next(made, every)).min(schedule.steps);
            let end = if renewal > 1 { end.min(next(made, renewal)) } else { end };
            let rest = end - made;
            let count = if self.problem.is_timed() { 1 } else { rest.min(share) };
            let clock = Instant::now();
            steps.advance(&mut spins, schedule.time(made), count).map_err(failed(made))?;
            share =
                if clock.elapsed().as_secs_f64() < 0.05 { 2 * share } else { (share / 2).max(1) };
            made += count;
            if made == schedule.steps || every.is_some_and(|every| made.is_multiple_of(every)) {
                last = self.record(schedule.time(made), &spins)?;
                if every.is_some() {
                    tell(made, News::Record(&last))?;
                }
            }
            let renewed = made.is_multiple_of(renewal);
            if renewed {
                steps.forget();
            }
            if made < schedule.steps {
                tell(made, News::Steps(made, renewed.then_some(&spins)))?;
            }
        }
        drop(steps);
        tell(made, News::Steps(made, Some(&spins)))?;
        let changes = spins.iter().zip(&self.start).map(|(spin, before)| {
            (length(spin) - length(before)).abs() / length(before).max(f64::MIN_POSITIVE)
        });
        let lengths = changes.fold(0.0, f64::max);
        let error = match plan.error {
            Some(error) => Some(error),
            None if estimate => self.estimate(&plan, &spins).ok(),
            None => None,
        };
        Ok(Conclusion { plan, spins, ends: [first, last], lengths, error })
    }

    /// The error at the end, by a run beside it in longer steps, on the cut.
    fn estimate(&self, plan: &Itinerary, end: &Spins) -> Result<f64, LatticeError> {
        let Itinerary { method, schedule, .. } = plan;
        let run = |step: f64, steps: u64| {
            let start = self.cut_of(&self.start);
            self.of_cut((*method, step), start, schedule.start, steps).map(|(end, _)| end)
        };
        let own = match &self.cut.cut {
            Some(_) => run(schedule.step, schedule.steps)?,
            None => end.clone(),
        };
        let other = if schedule.steps > 1 { schedule.steps.div_ceil(2) } else { 2 };
        let ratio = schedule.steps as f64 / other as f64;
        let other = run(schedule.step * ratio, other)?;
        Ok(distance(&own, &other) / (ratio.powi(method.order() as i32) - 1.0).abs())
    }

    /// The spins of the cut after some steps of this size from a time, and the seconds that these took.
    fn of_cut(
        &self,
        (method, step): (Algorithm, f64),
        mut spins: Spins,
        start: f64,
        steps: u64,
    ) -> Result<(Spins, f64), LatticeError> {
        let mut made = self.cut.steps(method, step)?;
        let clock = Instant::now();
        made.advance(&mut spins, start, steps)?;
        Ok((spins, clock.elapsed().as_secs_f64()))
    }

    /// The moment of these spins.
    ///
    /// # Errors
    /// Spins that are not those of the lattice.
    pub fn record(&self, time: f64, spins: &[[f64; 3]]) -> Result<Record, RunError> {
        let of = || {
            let total = self.problem.lattice.total_spin(spins)?;
            let magnetisation = total.map(|sum| sum / spins.len() as f64);
            let own = self.text.sites.iter().map(|site| spins[*site]).collect();
            Ok(Record {
                time,
                magnetisation,
                energy: self.problem.energy(time, spins)?,
                spins: own,
            })
        };
        of().map_err(|error: LatticeError| RunError::Run { time, step: 0, what: error.to_string() })
    }
}

fn length(spin: &[f64; 3]) -> f64 {
    spin.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The error of spins after steps of some size, by those after steps of half of it.
fn error_of(method: Algorithm, coarse: &Spins, fine: &Spins) -> f64 {
    distance(coarse, fine) / (1.0 - 0.5_f64.powi(method.order() as i32))
}

/// The root of the mean square of the distance of spins, over that of their lengths.
fn distance(a: &Spins, b: &Spins) -> f64 {
    let gaps = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b) * (a - b));
    let squares: f64 = b.iter().flatten().map(|x| x * x).sum();
    (gaps.sum::<f64>() / squares.max(f64::MIN_POSITIVE)).sqrt()
}
