//! One system with one step size: momenta are drawn, steps made and judged.

use coadjoint_codegen::judge::{Branch, Inside, Motion, RightSolution, Setting, Step, Stop};

use super::family::{Family, Model};
use super::random::Random;
use super::runtime::{Outcome, Steps, Way};
use super::verdict::{Tally, Wrong};

/// Momenta drawn of one system and step size.
pub const DRAWS: usize = 64;
/// Draws for which the boundary of acceptance is looked for anew.
const RAYS: usize = 16;
/// The longest step, h|Ω|.
const LONGEST: f64 = 10.0;
/// Steps with less must be accepted where the model says so.
const MUST: f64 = 1.5;

/// What is being judged, for messages.
struct Case<'a> {
    family: &'a str,
    seed: u64,
    model: &'a Model,
    h: f64,
    steps: &'a dyn Steps,
}

/// Draws one system of the family and [`DRAWS`] momenta, and judges the steps.
pub fn run(family: &Family, seed: u64, tally: &mut Tally) {
    let mut random = Random::new(seed);
    let model = &family.models[random.below(family.models.len())];
    let Some((h, steps)) = setting(family, model, &mut random) else { return };
    let Ok(mut judge) = model.judge.at(h, &model.symbols) else { return };
    let case = Case { family: &family.name, seed, model, h, steps: steps.as_ref() };
    let dim = model.velocity.len();
    let mut ray = random.direction(dim);
    let mut boundary = 1.0;
    let mut longest = 1.0;
    for draw in 0..DRAWS {
        if draw % RAYS == 0 {
            ray = random.direction(dim);
            longest = LONGEST / (h * speed(model, &ray));
            boundary = find_boundary(case.steps, &ray, longest);
        }
        let mu: Vec<f64> = if random.one_in(40) {
            special(&mut random, dim)
        } else {
            let size = if draw % 2 == 0 {
                boundary * random.between(0.9, 1.1)
            } else {
                longest * random.unit()
            };
            let nudged: Vec<f64> =
                ray.iter().map(|r| size * (r + random.between(-0.02, 0.02))).collect();
            nudged
        };
        let mu = case.steps.rounded(&mu);
        judge_step(&case, &mut judge, &mu, &mut random, tally);
    }
    in_lanes(&case, &mut judge, &mut random, longest, tally);
}

/// A step size, by way of the size that momenta are to have, and the steps of it.
fn setting(family: &Family, model: &Model, random: &mut Random) -> Option<(f64, Box<dyn Steps>)> {
    for _ in 0..20 {
        let decades = if random.one_in(2) { family.decades.min(2.0) } else { family.decades };
        let size = 10_f64.powf(random.between(-decades, decades));
        let direction = random.direction(model.velocity.len());
        let speed = speed(model, &direction);
        let speed = if model.homogeneous { speed * size } else { speed };
        let h = random.between(0.1, 3.0) / speed;
        // The steps' own h, whatever their scalar.
        let h = if random.one_in(16) { -h } else { h };
        if let Some(steps) = (model.steps)(h) {
            return Some((h, steps));
        }
    }
    None
}

/// |Ω| at μ.
fn speed(model: &Model, mu: &[f64]) -> f64 {
    model.velocity.iter().map(|v| v.evaluate(mu)).fold(0.0, f64::hypot)
}

/// The size along a ray up to which steps are accepted, between 0 and about `longest`.
fn find_boundary(steps: &dyn Steps, ray: &[f64], longest: f64) -> f64 {
    let accepted = |size: f64| {
        let mu: Vec<f64> = ray.iter().map(|r| r * size).collect();
        steps.solve(&mu).is_ok()
    };
    let (mut low, mut high) = (0.0, longest.abs());
    for _ in 0..9 {
        let middle = 0.5 * (low + high);
        if accepted(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Momenta beyond all bounds.
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

/// A double, exactly.
fn hex(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let bits = value.to_bits();
    let (sign, biased, fraction) =
        (if bits >> 63 == 1 { "-" } else { "" }, (bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
    match biased {
        0 => format!("{sign}0x0.{fraction:013x}p-1022"),
        _ => format!("{sign}0x1.{fraction:013x}p{}", biased as i64 - 1023),
    }
}

impl Case<'_> {
    fn example(&self, what: &str, mu: &[f64]) -> String {
        let exact: Vec<String> = mu.iter().map(|&m| hex(m)).collect();
        let (family, seed, h, text) = (self.family, self.seed, hex(self.h), &self.model.text);
        let turn = self.h.abs() * speed(self.model, mu);
        let exact = exact.join(", ");
        format!(
            "{what}\n    --only {family} --instance {seed}: h = {h} ({}), h|Ω| = {turn:.4}\n    μ = [{exact}] = {mu:?}\n    {text}",
            self.h
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
    let unit = case.steps.unit();
    let finite = mu.iter().all(|m| m.is_finite());
    let solved = case.steps.solve(mu);
    let mut right = None;
    match &solved {
        Ok(_) if !finite => {
            tally.accepted += 1;
            tally.note(Wrong::NotFinite, || case.example("a momentum that is not finite", mu));
        }
        Ok(x) => {
            tally.accepted += 1;
            match judge.step(mu) {
                Ok(step) => right = judge_increment(case, &step, x, mu, unit, tally),
                Err(_) => tally.unsure += 1,
            }
        }
        Err(error) => {
            tally.refused += 1;
            let turn = case.h.abs() * speed(case.model, mu);
            let size = mu.iter().copied().fold(0.0, |a: f64, b| a.max(b.abs()));
            let moderate = size == 0.0 || (size > 1e-30 && size < 1e30);
            if case.model.must_accept && finite && turn < MUST && moderate {
                let found = judge.step(mu).ok().and_then(|step| acceptable(&step));
                // Where the series has stopped converging a step must be refused.
                if let Some(found) = found {
                    tally.note(Wrong::Refused, || case.example(&format!("{error}; {found}"), mu));
                }
            }
        }
    }
    let way = match random.below(8) {
        0..=2 => Way::One,
        3 => Way::Many(1),
        4 => Way::Many(2 + random.below(4) as u64),
        5 | 6 => Way::Compensated,
        _ => return,
    };
    let at: Vec<f64> = (0..mu.len()).map(|_| random.between(-1.0, 1.0)).collect();
    if let Some(outcome) = case.steps.go(way, &at, mu) {
        let steps = if let Way::Many(steps) = way { steps } else { 1 };
        judge_outcome(case, judge, &outcome, right, steps, &format!("{way:?}"), tally);
    }
}

/// The right solution of a step that was refused, where the series' last terms have a ratio of at most a half.
fn acceptable(step: &Step<'_>) -> Option<String> {
    let right = step.right_solution().ok()?;
    let x: Vec<f64> = right.x.iter().map(|x| x.to_f64()).collect();
    let ratio = step.series_ratio(&x)?;
    (ratio <= 0.5).then(|| format!("the right x = {x:?}, the series' ratio {ratio:.3}"))
}

/// Judges an accepted x.
fn judge_increment(
    case: &Case<'_>,
    step: &Step<'_>,
    x: &[f64],
    mu: &[f64],
    unit: f64,
    tally: &mut Tally,
) -> Option<RightSolution> {
    let wrong = judge_all_but_branch(case, step, x, mu, unit, tally);
    if wrong {
        return None;
    }
    let note = |tally: &mut Tally, wrong, what: String| {
        tally.note(wrong, || case.example(&format!("{what}, x = {x:?}"), mu));
    };
    let (branch, right) = step.branch(x);
    match branch {
        Branch::Proven | Branch::Right => return right,
        Branch::CannotTell => tally.unsure += 1,
        Branch::Another(far) => note(tally, Wrong::Branch, format!("{far:.2e} from the right x")),
        Branch::Folds(s) => note(tally, Wrong::Branch, format!("the right one ends at s = {s:.4}")),
    }
    None
}

/// Judges an accepted x by itself; whether it is wrong.
fn judge_all_but_branch(
    case: &Case<'_>,
    step: &Step<'_>,
    x: &[f64],
    mu: &[f64],
    unit: f64,
    tally: &mut Tally,
) -> bool {
    let note = |tally: &mut Tally, wrong, what: String| {
        tally.note(wrong, || case.example(&format!("{what}, x = {x:?}"), mu));
        true
    };
    if !x.iter().all(|x| x.is_finite()) {
        return note(tally, Wrong::NotFinite, "x".to_owned());
    }
    match step.residual(x, unit) {
        Ok(residual) if residual.relative() > 1.0 => {
            let what =
                format!("residual {:.2e} of a bound {:.2e}", residual.residual, residual.bound);
            return note(tally, Wrong::Residual, what);
        }
        Ok(residual) => tally.residual = tally.residual.max(residual.relative()),
        // x is so long that its own p̂ has no digits left.
        Err(error) => return note(tally, Wrong::Residual, error.to_string()),
    }
    match step.inside(x) {
        Inside::No(eigenvalue) => {
            return note(tally, Wrong::Chart, format!("an eigenvalue of {eigenvalue}"));
        }
        Inside::CannotTell => tally.unsure += 1,
        Inside::Yes => {}
    }
    match step.series_ratio(x) {
        Some(ratio) if ratio.is_nan() || ratio > 0.5 + 1e-9 => {
            return note(tally, Wrong::Series, format!("a ratio of {ratio:.3}"));
        }
        _ => {}
    }
    false
}

/// Judges what `advance` and its kin did to a state.
fn judge_outcome(
    case: &Case<'_>,
    judge: &mut Setting<'_>,
    outcome: &Outcome,
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
    let mut walk = Motion::new(mu);
    let mut best: Option<f64> = None;
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
            break;
        }
    }
    match best {
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
    let dim = case.model.velocity.len();
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
            tally.accepted += 1;
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
