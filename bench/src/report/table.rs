//! Tables.

use std::fmt::Write as _;

use super::{Machine, TARGETS, best};
use crate::{measure::Measurement, problem::Problem};

/// Everything measured on one problem.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Report {
    /// The problem's name.
    pub problem: String,
    /// The problem's title.
    pub title: String,
    /// The end of the interval.
    pub end: f64,
    /// Where it was measured.
    pub machine: Machine,
    /// All measurements.
    pub measurements: Vec<Measurement>,
}

impl Report {
    /// The measurements of a problem.
    #[must_use]
    pub fn new(problem: &Problem, machine: Machine, measurements: Vec<Measurement>) -> Self {
        Self {
            problem: problem.name.to_owned(),
            title: problem.title.to_owned(),
            end: problem.end,
            machine,
            measurements,
        }
    }
}

/// One row per method, one column per target; the cheapest of a column is bold, whoever it is.
#[must_use]
pub fn markdown(report: &Report) -> String {
    let rows = best(&report.measurements);
    let cheapest: Vec<f64> = (0..TARGETS.len())
        .map(|column| {
            let costs =
                rows.iter().filter_map(|row| row.at[column].as_ref().map(|m| m.nanoseconds));
            costs.fold(f64::INFINITY, f64::min)
        })
        .collect();
    let mut text = format!(
        "## {}, T = {}\n\nNanoseconds of one core per unit of time at an error of (Π, R) at T not above the column's. {}.\n\n",
        report.title, report.end, report.machine
    );
    text.push_str("| method |");
    for target in TARGETS {
        let _ = write!(text, " {target:.0e} |");
    }
    text.push_str("\n|---|");
    text.push_str(&"---:|".repeat(TARGETS.len()));
    text.push('\n');
    for row in &rows {
        let _ = write!(text, "| {} |", row.method);
        for (column, cell) in row.at.iter().enumerate() {
            match cell {
                Some(m) if m.nanoseconds <= cheapest[column] => {
                    let _ = write!(text, " **{}** |", figure(m.nanoseconds));
                }
                Some(m) => {
                    let _ = write!(text, " {} |", figure(m.nanoseconds));
                }
                None => text.push_str(" – |"),
            }
        }
        text.push('\n');
    }
    text
}

fn figure(nanoseconds: f64) -> String {
    if nanoseconds < 10.0 { format!("{nanoseconds:.1}") } else { format!("{nanoseconds:.0}") }
}

/// Every measurement, one per line.
#[must_use]
pub fn csv(report: &Report) -> String {
    let mut text = "problem,method,family,setting,error,nanoseconds_per_unit\n".to_owned();
    for row in &report.measurements {
        let _ = writeln!(
            text,
            "{},\"{}\",\"{}\",{},{:e},{:.3}",
            report.problem, row.method, row.family, row.setting, row.error, row.nanoseconds
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_winner_is_bold_and_what_is_not_reached_is_a_dash() {
        let row = |method: &str, error, nanoseconds| Measurement {
            method: method.to_owned(),
            family: method.to_owned(),
            setting: "h = 1".to_owned(),
            error,
            nanoseconds,
        };
        let machine = Machine {
            processor: "P".to_owned(),
            cores: 1,
            system: "S".to_owned(),
            features: vec!["fma"],
            load: String::new(),
        };
        let report = Report {
            problem: "p".to_owned(),
            title: "P".to_owned(),
            end: 10.0,
            machine,
            measurements: vec![
                row("ours", 1e-9, 90.4),
                row("peer", 1e-7, 70.0),
                row("peer", 1e-9, 120.0),
            ],
        };
        let text = markdown(&report);
        assert!(text.contains("| ours | 90 | 90 | **90** | – | – |"), "{text}");
        assert!(text.contains("| peer | **70** | **70** | 120 | – | – |"), "{text}");
        assert!(csv(&report).contains("p,\"peer\",\"peer\",h = 1,1e-7,70.000"));
    }
}
