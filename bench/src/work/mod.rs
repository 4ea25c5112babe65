//! The cheapest time for an error: ours and the peers on problems with converged references.

mod dop853;
mod exact;
mod method;
mod moser_veselov;
mod ours;
mod problem;
mod smooth;
mod sweep;
#[cfg(test)]
mod tests;

use std::fmt::Write as _;

use crate::timing::{Failure, figure};
use method::Competitor;
use problem::Problem;
use sweep::Measurement;

pub fn methods(problem: &Problem) -> Vec<Competitor> {
    let mut methods = ours::methods(problem);
    methods.extend(smooth::methods(problem));
    methods.extend(dop853::method());
    methods.extend(moser_veselov::method(problem));
    methods.extend(exact::method(problem));
    methods
}

/// Errors that a table has a column for.
const TARGETS: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Measures every problem whose name contains `only` by every method whose name contains `method`, and prints its table.
pub fn tables(quick: bool, only: &str, method: &str) -> Result<(), Failure> {
    let problems = problem::all()?.into_iter().chain(smooth::problems(only)?);
    for problem in problems.filter(|problem| problem.name.contains(only)) {
        let mut methods = methods(&problem);
        methods.retain(|one| one.name.contains(method));
        let measurements = sweep::measure(&problem, &methods, quick);
        println!("## {}, T = {}\n\n{}", problem.title, problem.end, table(&measurements));
    }
    Ok(())
}

/// Nanoseconds of one core per unit of time for each method at each error; the cheapest of a column is bold.
fn table(measurements: &[Measurement]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for one in measurements {
        if !names.contains(&one.method.as_str()) {
            names.push(&one.method);
        }
    }
    let cheapest = |name: Option<&str>, target: f64| {
        let reached = measurements.iter().filter(|m| m.error <= target);
        let own = reached.filter(|m| name.is_none_or(|name| m.method == name));
        own.map(|m| m.nanoseconds).min_by(f64::total_cmp)
    };
    let heads: Vec<String> = TARGETS.iter().map(|target| format!("{target:.0e}")).collect();
    let mut text = format!("| error at most | {} |\n|---|", heads.join(" | "));
    text.push_str(&"---:|".repeat(TARGETS.len()));
    for name in names {
        let _ = write!(text, "\n| {name} |");
        for target in TARGETS {
            let best = cheapest(None, target);
            let _ = match cheapest(Some(name), target) {
                Some(own) if Some(own) == best => write!(text, " **{}** |", figure(own)),
                Some(own) => write!(text, " {} |", figure(own)),
                None => write!(text, " – |"),
            };
        }
    }
    text.push('\n');
    text
}
