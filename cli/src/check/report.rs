//! The laws as a table or as JSON.

use std::fmt::Write;

use coadjoint_codegen::problem::Problem;
use coadjoint_run::check::{Law, Steep, Trial};
use serde_json::{Value, json};

use crate::named::Format;

/// The text to print.
pub fn report(
    problem: &Problem,
    trial: &Trial,
    laws: &[Law],
    warning: Option<&Steep>,
    format: Format,
) -> String {
    match format {
        Format::Json => {
            let list: Vec<Value> = laws
                .iter()
                .map(|law| {
                    let mut object = json!({
                        "name": law.name,
                        "bound": law.bound,
                        "pass": law.pass,
                    });
                    // JSON has no infinity: an order beyond measure, or what is no number, has no key.
                    if law.value.is_finite() {
                        object["value"] = json!(law.value);
                    }
                    object
                })
                .collect();
            let object = json!({
                "system": problem.name,
                "group": problem.algebra.name(),
                "chart": problem.chart.to_string(),
                "truncation": problem.truncation,
                "step": trial.step,
                "points": trial.points,
                "about": trial.about,
                "laws": list,
                "warnings": warning.iter().map(|steep| json!({
                    "kind": "series_ratio",
                    "ratio": steep.ratio,
                    "text": steep.text(),
                })).collect::<Vec<_>>(),
            });
            format!("{object:#}\n")
        }
        Format::Text => {
            let mut out = String::new();
            // Writing into a string cannot fail.
            let _ = writeln!(
                out,
                "{}: group {}, chart {}, K = {}, h = {}, {} random points {} (seed {})",
                problem.name,
                problem.algebra.name(),
                problem.chart,
                problem.truncation,
                trial.step,
                trial.points,
                trial.place(),
                trial.seed
            );
            if let Some(warning) = warning {
                let _ = writeln!(out, "  warning: {}", warning.text());
            }
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
