//! The report of an ensemble, for people and for programs.

use coadjoint_program::Precision;
use coadjoint_run::Derived;
use coadjoint_run::STEEP;
use coadjoint_run::ensemble::{Engine, Rejected};
use coadjoint_run::number::shortest;
use coadjoint_run::simulate::{LARGE, Schedule};
use serde_json::{Value, json};

use super::run::Completion;
use crate::named::Format;

/// Warnings, for programs and for people.
pub(crate) fn warnings(
    outcome: &Completion,
    steps: u64,
    engine: &Engine<'_>,
) -> Vec<(Value, String)> {
    let ratio = outcome.journal.drift().ratio;
    let series = (ratio != 0.0).then(|| {
        let text = format!(
            "the series hardly converges for some rows: its terms have the ratio \
             {ratio:.3}, above {STEEP}; the motion may be inaccurate: take a smaller step"
        );
        (json!({ "kind": "series_ratio", "ratio": ratio, "text": text }), text)
    });
    let largest = outcome.journal.estimated().map(|[_, largest]| largest);
    let error = largest.filter(|largest| *largest > LARGE).map(|error| {
        let text = format!(
            "the error at the end of a row is about {:.0} %: take a smaller step or a larger truncation",
            error * 100.0
        );
        (json!({ "kind": "estimated_error", "error": error, "text": text }), text)
    });
    let single = engine.device().is_some_and(|by| by.precision == Precision::Single);
    // Of single precision the report says what drifts are.
    let mut drift = outcome.journal.drift();
    if single {
        drift.conserved = Default::default();
    }
    let drifts = drift.warnings(outcome.trajectories, steps);
    let drifts = drifts.map(|warning| (warning.object(), warning.text()));
    let journal = &outcome.journal;
    let unresolved = journal.why.as_ref().map(|why| {
        let text = format!("the error at the end of {} rows estimated is {why}", journal.unknown);
        (json!({ "kind": "no_estimate", "rows": journal.unknown, "text": text }), text)
    });
    series.into_iter().chain(error).chain(drifts).chain(unresolved).collect()
}

/// The text to print.
pub(crate) fn report(
    outcome: &Completion,
    (system, parameters): (&Derived, &[String]),
    &Schedule { start, step, steps, .. }: &Schedule,
    engine: &Engine<'_>,
    format: Format,
) -> String {
    let series = system.series().map(|series| &series.problem);
    let Completion { trajectories, resumed, first, list, journal, seconds } = outcome;
    let (made_by, failed, redone) = (&journal.made_by, journal.rejected, journal.redone);
    let drift = journal.drift();
    let drifts = [
        ("spatial_momentum", drift.conserved.spatial_momentum),
        ("casimirs", drift.conserved.casimirs),
    ];
    if format == Format::Json {
        // An unknown value has no key.
        let known = drifts.iter().filter_map(|(name, drift)| Some((*name, (*drift)?)));
        let row = |r: &Rejected| json!({ "row": r.row, "step": r.step, "reason": r.reason });
        let mut value = json!({
            "trajectories": trajectories,
            "resumed_at": resumed,
            "failed": failed,
            "first_failed": first.iter().map(row).collect::<Value>(),
            "rejected": list,
            "method": system.label(),
            "truncation": system.facts().truncation,
            "step": step,
            "steps": steps,
            "made_by": made_by,
            "device": engine.device().map(|by| json!({
                "device": by.device.to_string(),
                "name": by.name,
                "precision": by.precision.to_string(),
                "redone": redone,
                "seconds": by.running.as_secs_f64(),
            })),
            "drift": known.map(|(name, drift)| (name, json!(drift))).collect::<Value>(),
            "drift_not_measured": drift.unmeasured,
            "warnings": warnings(outcome, steps, engine).into_iter().map(|(object, _)| object).collect::<Value>(),
            "seconds": seconds,
        });
        // Absent is 0.
        if start != 0.0 {
            value["initial_time"] = json!(start);
        }
        if let Some(problem) = series {
            value["chart"] = json!(problem.chart.to_string());
            value["frame"] = json!(problem.frame_name());
        }
        if !parameters.is_empty() {
            value["parameters"] = json!(parameters);
        }
        let rows = journal.estimates.len();
        let estimated = journal
            .estimated()
            .map(|[median, largest]| json!({ "rows": rows, "median": median, "largest": largest }));
        if rows as u64 + journal.unknown > 0 {
            value["estimated_error"] = json!(estimated);
        }
        if let Some(why) = &journal.why {
            value["estimated_error_unknown"] = json!({ "rows": journal.unknown, "first": why });
        }
        return format!("{value:#}\n");
    }
    let label = system.label();
    let from = if start == 0.0 { String::new() } else { format!(" from time {}", shortest(start)) };
    let mut lines =
        vec![format!("{label}: {trajectories} trajectories of {steps} steps of {step}{from}")];
    if *resumed > 0 {
        lines.push(format!("  {resumed} of them by an earlier run"));
    }
    if !parameters.is_empty() {
        lines.push(format!("  each row with its own {}", parameters.join(", ")));
    }
    lines.push(format!("  steps by {}", made_by.join(", then by ")));
    if let Some(by) = engine.device() {
        let backend = engine.backend();
        lines.push(format!("    rows with steps it refused, made by {backend}: {redone}"));
        lines.push(format!("    it ran for {:.1} s", by.running.as_secs_f64()));
        if by.precision == Precision::Single {
            lines.push("    in single precision drifts are at 1e-7 and above".to_owned());
        }
    }
    lines.extend(
        warnings(outcome, steps, engine).into_iter().map(|(_, text)| format!("  warning: {text}")),
    );
    lines.push(format!("  failed           {failed:>10}"));
    lines.extend(first.iter().map(|Rejected { row, step, reason }| match step {
        0 => format!("    row {row}: {reason}"),
        step => format!("    row {row}, step {step}: {reason}"),
    }));
    lines.extend(list.iter().map(|list| format!("    all of them are in {}", list.display())));
    if let Some([median, largest]) = journal.estimated() {
        let rows = journal.estimates.len();
        lines.push(format!(
            "  estimated relative error at the end, of {rows} rows: median {median:.1e}, largest {largest:.1e}"
        ));
    }
    if let Some(why) = &journal.why {
        let rows = journal.unknown;
        lines.push(format!("  estimated relative error at the end, of {rows} rows: {why}"));
    }
    lines.push("  largest relative drift".to_owned());
    let casimirs = match engine.casimirs() {
        0 => "Casimirs         none known".to_owned(),
        count => format!("Casimirs ({count})    "),
    };
    for ((_, drift), name) in drifts.into_iter().zip(["spatial momentum", &casimirs]) {
        lines.push(match drift {
            _ if name.ends_with("none known") => format!("    {name}"),
            Some(drift) => format!("    {name} {drift:>10.1e}"),
            None => format!("    {name} not measurable"),
        });
    }
    if drift.unmeasured > 0 {
        let rows = drift.unmeasured;
        lines
            .push(format!("    not measurable in {rows} rows: rounding of large numbers hides it"));
    }
    lines.push(format!("  {seconds:.1} s\n"));
    lines.join("\n")
}
