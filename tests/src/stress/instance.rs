//! One system with one step size: momenta are drawn, steps made and judged.

use coadjoint_codegen::judge::{Branch, Enclosure, Inside, Point, RightSolution, Setting, Stop};

use super::family::{Family, Instance, Models, Realisation};
use super::random::Random;
use super::runtime::{Steps, Transition, Way};
use super::verdict::{Tally, Wrong};

/// Momenta drawn of one system and step size.
pub const DRAWS: usize = 64;
/// Draws for which the boundary of acceptance is looked for anew.
const RAYS: usize = 16;
/// The longest step, h|Ω|.
const LONGEST: f64 = 10.0;
/// Steps with less h|μ|/I, I the least moment of inertia, must be accepted where that is promised.
const PROMISED: f64 = 1.5;
/// One in this number of right x is made wrong, to test the judge.
const SPOILT: usize = 64;

struct Case<'a> {
    family: &'a str,
    seed: u64,
    system: &'a Realisation,
    h: f64,
    steps: &'a dyn Steps,
}

/// The family of steps by the series of these.
pub fn family(name: String, weight: usize, models: Models) -> Family {
    let own = name.clone();
    Family::new(name, weight, move |random, tally| run(&own, &models, random, tally))
}

/// Draws one system of a family and [`DRAWS`] momenta, and judges the steps.
fn run(name: &str, family: &Models, random: &mut Random, tally: &mut Tally) {
    let (seed, random) = (random.state(), &mut *random);
    let model = &family.models[random.below(family.models.len())];
    let system = (model.draw)(random);
    let Some((h, made)) = setting(family, &system, random) else { return };
    let judge = made.judge.as_ref().unwrap_or(&model.judge);
    let Ok(mut judge) = judge.at(h, &system.symbols) else { return };
    let steps = made.steps.as_ref();
    let case = Case { family: name, seed, system: &system, h, steps };
    let dim = system.velocity.len();
    let mut ray = random.direction(dim);
    let mut boundary = 1.0;
    let mut longest = 1.0;
    for draw in 0..DRAWS {
        if draw % RAYS == 0 {
            ray = random.direction(dim);
            longest = LONGEST / (h * speed(&system, &ray));
            boundary = match family.promise {
                true => 1.0,
                false => find_boundary(case.steps, &ray, longest),
            };
        }
        let mu: Vec<f64> = if family.promise {
            promised(&case, random)
        } else if random.one_in(40) {
            special(random, dim)
        } else {
            let size = match draw % 4 {
                0 | 2 => boundary * random.between(0.9, 1.1),
                1 => boundary * random.unit(),
                _ => longest * random.unit(),
            };
            ray.iter().map(|r| size * (r + random.between(-0.02, 0.02))).collect()
        };
        let mu = case.steps.rounded(&mu);
        judge_step(&case, &mut judge, &mu, random, tally);
    }
    in_lanes(&case, &mut judge, random, longest, tally);
}

/// A step size, by way of the size that momenta are to have, and the steps of it.
fn setting(family: &Models, system: &Realisation, random: &mut Random) -> Option<(f64, Instance)> {
    for _ in 0..20 {
        let decades = if random.one_in(2) { family.decades.min(2.0) } else { family.decades };
        let size = 10_f64.powf(random.between(-decades, decades));
        let direction = random.direction(system.velocity.len());
        let speed = speed(system, &direction);
        let speed = if system.homogeneous { speed * size } else { speed };
        let h = random.between(0.1, 3.0) / speed;
        // The steps' own h, whatever their scalar.
        let h = if random.one_in(16) { -h } else { h };
        if let Some(made) = (system.steps)(h, random) {
            return Some((h, made));
        }
    }
    None
}

fn speed(system: &Realisation, mu: &[f64]) -> f64 {
    system.velocity.iter().map(|v| v.evaluate(mu)).fold(0.0, f64::hypot)
}

/// h|μ|/I where steps are promised up to [`PROMISED`] of it, and |μ| is neither too small nor too large for that.
fn promised_turn(case: &Case<'_>, mu: &[f64]) -> Option<f64> {
    let least = case.system.promised?;
    let length = mu.iter().copied().fold(0.0, f64::hypot);
    let moderate = length == 0.0 || (1e-30..=1e30).contains(&length);
    moderate.then(|| case.h.abs() * length / least)
}

/// A momentum whose step must be accepted, one in four of them almost at the limit.
fn promised(case: &Case<'_>, random: &mut Random) -> Vec<f64> {
    let least = case.system.promised.unwrap_or(1.0);
    let share = if random.one_in(4) { 1.0 - 1e-3 * random.unit() } else { random.unit() };
    let mut direction = random.direction(case.system.velocity.len());
    let exact = 1.0 / direction.iter().copied().fold(0.0, f64::hypot);
    let size = exact * share * (PROMISED * (1.0 - 1e-12)) * least / case.h.abs();
    direction.iter_mut().for_each(|m| *m *= size);
    direction
}

/// The size along a ray up to which steps are accepted, between 0 and about `longest`.
fn find_boundary(steps: &dyn Steps, ray: &[f64], longest: f64) -> f64 {
    let accepted = |size: f64| {
        let mu: Vec<f64> = ray.iter().map(|r| r * size).collect();
        steps.solve(&mu).is_ok()
    };
    let (mut low, mut high) = (0.0, longest.abs());
    for _ in 0..8 {
        let middle = 0.5 * (low + high);
        if accepted(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn special(random: &mut Random, dim: usize) -> Vec<f64> {
    let sizes = [
        0.0,
        5e-324,
        1e-310,
        1e-300,
        1e-150,
        1e-30,
        1e30,
        1e150,
        1e300,
        1.7e308,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    let size = sizes[random.below(sizes.len())];
    let mut mu: Vec<f64> = random.direction(dim);
    if random.one_in(2) {
        mu.iter_mut().for_each(|m| *m *= size);
    } else {
        // One coordinate only.
        let at = random.below(dim);
        mu[at] = size;
    }
    mu
}

impl Case<'_> {
    fn example(&self, what: &str, mu: &[f64]) -> String {
        // The shortest decimals that are read as the same numbers.
        let Self { family, seed, h, system, .. } = self;
        let turn = h.abs() * speed(system, mu);
        format!(
            "{what}\n    --only {family} --instance {seed}: h = {h}, h|Ω| = {turn:.4}\n    μ = {mu:?}\n    {}",
            system.text
        )
    }
}

fn judge_step(
    case: &Case<'_>,
    judge: &mut Setting<'_>,
    mu: &[f64],
    random: &mut Random,
    tally: &mut Tally,
) {
    let finite = mu.iter().all(|m| m.is_finite());
    let promised = finite && promised_turn(case, mu).is_some_and(|turn| turn < PROMISED);
    tally.promised += u64::from(promised);
    let solved = case.steps.solve(mu);
    let mut right = None;
    match &solved {
        Ok(_) if !finite => {
            tally.accepted += 1;
            tally.note(Wrong::NotFinite, || case.example("a momentum that is not finite", mu));
        }
        Ok(x) => {
            tally.accepted += 1;
            right = judge_increment(case, judge, x, mu, random, tally);
        }
        Err(error) => {
            tally.refused += 1;
            if promised {
                tally.note(Wrong::Refused, || case.example(error, mu));
            }
        }
    }
    let way = match random.below(6) {
        0 | 1 => Way::One,
        2 => Way::Many(1),
        3 => Way::Many(2 + random.below(4) as u64),
        // Several blocks of what is solved at once.
        4 if random.one_in(4) => Way::Many(6 + random.below(12) as u64),
        _ => return,
    };
    let at: Vec<f64> = (0..mu.len()).map(|_| random.between(-1.0, 1.0)).collect();
    if let Some(outcome) = case.steps.go(way, &at, mu) {
        let steps = way.steps();
        if outcome.error.is_none() {
            // The first one has been counted.
            tally.accepted += steps - 1;
        }
        judge_outcome(case, judge, &outcome, right, steps, &format!("{way:?}"), tally);
    }
}

/// Judges an accepted x.
fn judge_increment(
    case: &Case<'_>,
    judge: &mut Setting<'_>,
    x: &[f64],
    mu: &[f64],
    random: &mut Random,
    tally: &mut Tally,
) -> Option<RightSolution> {
    let note = |tally: &mut Tally, wrong, what: String| {
        tally.note(wrong, || case.example(&format!("{what}, x = {x:?}"), mu));
    };
    if !x.iter().all(|x| x.is_finite()) {
        note(tally, Wrong::NotFinite, "x".to_owned());
        return None;
    }
    let Ok(step) = judge.step(mu) else {
        tally.unsure += 1;
        return None;
    };
    let point = match step.at(x) {
        Ok(point) => point,
        // x is so long that its own p̂ has no digits left.
        Err(error) => {
            note(tally, Wrong::Residual, error.to_string());
            return None;
        }
    };
    let inside = step.inside(x);
    if let Some((wrong, what)) = fault(&point, inside, case.steps.unit()) {
        note(tally, wrong, what);
        return None;
    }
    let relative = point.residual(case.steps.unit()).relative();
    if relative > tally.residual {
        tally.residual = relative;
        tally.worst = case.example(&format!("{relative:.3} of the bound, x = {x:?}"), mu);
    }
    tally.unsure += u64::from(inside == Inside::CannotTell);
    let (branch, right) = point.branch();
    match branch {
        Branch::Right => {
            if let Some(right) = &right
                && random.one_in(SPOILT)
            {
                let unit = case.steps.unit();
                // By so much that the residual grows by three bounds at least.
                let by = 4.0 * point.residual(unit).bound * right.response;
                let direction = random.direction(x.len());
                if by >= x.iter().copied().fold(0.0, f64::hypot) {
                    return Some(right.clone());
                }
                let spoilt: Vec<f64> = x.iter().zip(&direction).map(|(x, d)| x + by * d).collect();
                let found = step.at(&spoilt).map(|spoilt| spoilt.residual(unit).relative());
                tally.spoilt += 1;
                if found.is_ok_and(|relative| relative <= 1.0) {
                    note(tally, Wrong::Missed, format!("{spoilt:?} passes for it"));
                }
            }
            return right;
        }
        Branch::CannotTell => tally.unsure += 1,
        Branch::Another(far) => note(tally, Wrong::Branch, format!("{far:.2e} from the right x")),
        Branch::Folds(s) => note(tally, Wrong::Branch, format!("the right one ends at s = {s:.4}")),
    }
    None
}

/// The defect of an x by itself.
fn fault(point: &Point<'_>, inside: Inside, unit: f64) -> Option<(Wrong, String)> {
    let residual = point.residual(unit);
    if residual.relative() > 1.0 {
        let what = format!("residual {:.2e} of a bound {:.2e}", residual.residual, residual.bound);
        return Some((Wrong::Residual, what));
    }
    if let Inside::No(eigenvalue) = inside {
        return Some((Wrong::Chart, format!("an eigenvalue of {eigenvalue}")));
    }
    let ratio = point.series_ratio(unit)?;
    let small = ratio <= 0.5 + 1e-9;
    (!small).then(|| (Wrong::Series, format!("a ratio of {ratio:.3}")))
}

/// Judges what `advance` and its kin did to a state.
fn judge_outcome(
    case: &Case<'_>,
    judge: &mut Setting<'_>,
    outcome: &Transition,
    mut right: Option<RightSolution>,
    steps: u64,
    way: &str,
    tally: &mut Tally,
) {
    let mu = &outcome.before.momentum;
    let example = |what: String| case.example(&format!("{way}: {what}"), mu);
    if let Some(error) = &outcome.error
        && steps == 1
    {
        if outcome.after.text != outcome.before.text {
            tally.note(Wrong::Changed, || example(error.clone()));
        }
        return;
    }
    if !outcome.before.is_finite() {
        if outcome.error.is_none() {
            tally.note(Wrong::NotFinite, || example("a state that is not finite".to_owned()));
        } else if outcome.after.text != outcome.before.text {
            tally.note(Wrong::Changed, || example("the state".to_owned()));
        }
        return;
    }
    if !outcome.after.is_finite() {
        tally.note(Wrong::NotFinite, || example(outcome.after.text.clone()));
        return;
    }
    // Where it should be after one step, two, …
    let unit = case.steps.unit();
    let mut walk = Enclosure::new(mu);
    let mut best: Option<f64> = None;
    let mut cut = false;
    for done in 0..=steps {
        if outcome.error.is_none() == (done == steps) {
            let (before, after) = (&outcome.before, &outcome.after);
            let deviation = if done == 0 {
                if after.text == before.text { 0.0 } else { f64::INFINITY }
            } else {
                let momentum = walk.momentum_deviation(&after.momentum);
                momentum.max(walk.element_deviation(&before.element, &after.element))
            };
            best = Some(best.map_or(deviation, |best| best.min(deviation)));
        }
        if done == steps {
            break;
        }
        if let Err(stop) = walk.step(judge, right.take(), unit) {
            // No right solution: nothing may have been accepted from here on.
            if outcome.error.is_none() {
                match stop {
                    Stop::Branch(Branch::Folds(s)) => tally.note(Wrong::Branch, || {
                        example(format!("step {done}: the right solution ends at s = {s:.4}"))
                    }),
                    _ => tally.unsure += 1,
                }
                return;
            }
            cut = !matches!(stop, Stop::Branch(Branch::Folds(_)));
            break;
        }
        if !walk.is_bounded() {
            tally.unsure += 1;
            return;
        }
    }
    match best {
        // Some steps were made from where the judge cannot follow.
        Some(deviation) if cut && deviation > 1.0 => tally.unsure += 1,
        Some(deviation) if deviation <= 1.0 => tally.deviation = tally.deviation.max(deviation),
        Some(deviation) => {
            tally.note(Wrong::State, || example(format!("{deviation:.2e} times the bound")));
        }
        None => tally.unsure += 1,
    }
}

/// Lanes, some of them bad: each must do what it does alone.
fn in_lanes(
    case: &Case<'_>,
    judge: &mut Setting<'_>,
    random: &mut Random,
    longest: f64,
    tally: &mut Tally,
) {
    let dim = case.system.velocity.len();
    let count = 1 + random.below(19);
    let steps = 1 + random.below(3) as u64;
    let mut starts = Vec::new();
    for _ in 0..count {
        let mu = if random.one_in(4) {
            special(random, dim)
        } else {
            let reach = if random.one_in(3) { 1.0 } else { 0.15 };
            let size = longest * reach * random.unit();
            random.direction(dim).into_iter().map(|m| m * size).collect()
        };
        let at: Vec<f64> = (0..dim).map(|_| random.between(-1.0, 1.0)).collect();
        starts.push((at, case.steps.rounded(&mu)));
    }
    let Some(together) = case.steps.together(&starts, steps) else { return };
    for (start, outcome) in starts.iter().zip(&together) {
        if outcome.error.is_none() {
            tally.accepted += steps;
        } else {
            tally.refused += 1;
        }
        let alone = case.steps.together(std::slice::from_ref(start), steps);
        let alone = alone.and_then(|mut alone| alone.pop());
        if let Some(alone) = alone
            && (alone.error.is_none() != outcome.error.is_none()
                || alone.after.text != outcome.after.text)
        {
            let what = format!("{count} lanes, {steps} steps: {:?} alone {:?}", outcome, alone);
            tally.note(Wrong::Lanes, || case.example(&what, &start.1));
        }
        judge_outcome(case, judge, outcome, None, steps, &format!("{steps} in lanes"), tally);
    }
}
