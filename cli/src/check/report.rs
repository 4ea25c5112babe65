//! The laws as a table or as JSON.

use std::fmt::Write;

use serde_json::{Value, json};

use super::{Law, Trial};
use crate::arguments::Format;

/// The text to print.
pub fn report(trial: &Trial<'_>, laws: &[Law], format: Format) -> String {
    let problem = &trial.integrator.problem;
    match format {
        Format::Json => {
            let list: Vec<Value> = laws
                .iter()
                .map(|law| {
                    // JSON has no infinity: null is an order beyond measure.
                    let value = law.value.is_finite().then_some(law.value);
                    json!({
                        "name": law.name,
                        "value": value,
                        "bound": law.bound,
                        "pass": law.pass,
                    })
                })
                .collect();
            let object = json!({
                "system": problem.name,
                "group": problem.algebra.name(),
                "chart": problem.chart.to_string(),
                "truncation": problem.truncation,
                "step": trial.step,
                "laws": list,
            });
            format!("{object:#}\n")
        }
        Format::Text => {
            let mut out = String::new();
            // Writing into a string cannot fail.
            let _ = writeln!(
                out,
                "{}: group {}, chart {}, K = {}, h = {}, {} random points (seed {})",
                problem.name,
                problem.algebra.name(),
                problem.chart,
                problem.truncation,
                trial.step,
                trial.points,
                trial.seed
            );
            for law in laws {
                let order = law.name.starts_with("order");
                let (relation, value, bound) = if order {
                    (">=", format!("{:.2}", law.value), format!("{:.1}", law.bound))
                } else {
                    ("<=", format!("{:.1e}", law.value), format!("{:.0e}", law.bound))
                };
                let verdict = if law.pass { "holds" } else { "FAILS" };
                let _ = writeln!(
                    out,
                    "  {:<12} {value:>8} {relation} {bound:<6} {verdict}   {}",
                    law.name, law.statement
                );
            }
            out
        }
    }
}
