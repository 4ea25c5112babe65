//! The report of an ensemble, for people and for programs.

use std::fmt::Write;

use coadjoint_codegen::integrator::Integrator;
use coadjoint_program::Precision;
use coadjoint_run::engine::STEEP;
use coadjoint_run::ensemble::Engine;
use serde_json::json;

use super::run::Outcome;
use crate::named::Format;

/// A warning about the series, if there is reason for one.
pub fn warning(outcome: &Outcome) -> Option<String> {
    let ratio = outcome.journal.drift().ratio;
    (ratio != 0.0).then(|| {
        format!(
            "the series hardly converges for some rows: its last two terms have the ratio \
             {ratio:.3}, above {STEEP}; the motion may be inaccurate: take a smaller step"
        )
    })
}

/// The text to print.
pub fn report(
    outcome: &Outcome,
    integrator: &Integrator,
    (step, steps): (f64, u64),
    engine: &dyn Engine,
    format: Format,
) -> String {
    let truncation = integrator.problem.truncation;
    let chart = integrator.problem.chart;
    let drift = outcome.journal.drift();
    let made_by = &outcome.journal.made_by;
    let (failed, redone) = (outcome.journal.rejected, outcome.journal.redone);
    let conserved = drift.conserved;
    if format == Format::Json {
        // An unknown value has no key.
        let known =
            [("spatial_momentum", conserved.spatial_momentum), ("casimirs", conserved.casimirs)];
        let known: serde_json::Map<_, _> = known
            .iter()
            .filter_map(|(name, drift)| Some(((*name).into(), json!((*drift)?))))
            .collect();
        let first = outcome.first.iter();
        let first: Vec<_> =
            first.map(|r| json!({ "row": r.row, "step": r.step, "reason": r.reason })).collect();
        let value = json!({
            "trajectories": outcome.trajectories,
            "resumed_at": outcome.resumed,
            "kept": outcome.kept,
            "failed": failed,
            "first_failed": first,
            "rejected": outcome.list,
            "truncation": truncation,
            "chart": chart.to_string(),
            "step": step,
            "steps": steps,
            "made_by": made_by,
            "device": engine.device().map(|by| json!({
                "device": by.device.to_string(),
                "name": by.name,
                "precision": by.precision.to_string(),
                "redone": redone,
            })),
            "drift": known,
            "drift_not_measured": drift.unmeasured,
            "warnings": warning(outcome).iter().map(|text| json!({
                "kind": "series_ratio",
                "ratio": drift.ratio,
                "text": text,
            })).collect::<Vec<_>>(),
            "seconds": outcome.seconds,
        });
        return format!("{value:#}\n");
    }
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = writeln!(
        out,
        "K = {truncation}, {chart}: {} trajectories of {steps} steps of {step}",
        outcome.trajectories
    );
    if outcome.kept {
        let _ = writeln!(out, "  finished by an earlier run, and kept");
    } else if outcome.resumed > 0 {
        let _ = writeln!(out, "  {} of them by an earlier run", outcome.resumed);
    }
    let _ = writeln!(out, "  steps by {}", made_by.join(", then by "));
    if let Some(by) = engine.device() {
        let backend = engine.backend();
        let _ = writeln!(out, "    rows with steps it refused, made by {backend}: {redone}");
        if by.precision == Precision::Single {
            let _ = writeln!(out, "    in single precision drifts are at 1e-7 and above");
        }
    }
    if let Some(text) = warning(outcome) {
        let _ = writeln!(out, "  warning: {text}");
    }
    let _ = writeln!(out, "  failed           {:>10}", failed);
    for rejected in &outcome.first {
        let _ = match rejected.step {
            0 => writeln!(out, "    row {}: {}", rejected.row, rejected.reason),
            step => writeln!(out, "    row {}, step {step}: {}", rejected.row, rejected.reason),
        };
    }
    if let Some(list) = &outcome.list {
        let _ = writeln!(out, "    all of them are in {}", list.display());
    }
    let _ = writeln!(out, "  largest relative drift");
    let number = |drift: Option<f64>| match drift {
        Some(drift) => format!("{drift:>10.1e}"),
        None => "not measurable".to_owned(),
    };
    let _ = writeln!(out, "    spatial momentum {}", number(conserved.spatial_momentum));
    let _ = match engine.casimirs() {
        0 => writeln!(out, "    Casimirs         none known"),
        count => writeln!(out, "    Casimirs ({count})     {}", number(conserved.casimirs)),
    };
    if drift.unmeasured > 0 {
        let rows = drift.unmeasured;
        let _ =
            writeln!(out, "    not measurable in {rows} rows: rounding of large numbers hides it");
    }
    let _ = writeln!(out, "  {:.1} s", outcome.seconds);
    out
}
