//! What a run did, for people and for programs.

use std::fmt::Write;

use serde_json::{Value, json};

use super::trajectory::Trajectory;
use crate::arguments::Format;

/// Group elements wider than this are not printed for people.
const WIDEST: usize = 12;

/// The text to print: one block per run, or one JSON object (an array of them for several runs).
pub fn report(runs: &[Trajectory], format: Format) -> String {
    match format {
        Format::Text => runs.iter().map(text).collect::<Vec<_>>().join("\n"),
        Format::Json => {
            let value = match runs {
                [single] => object(single),
                several => Value::Array(several.iter().map(object).collect()),
            };
            format!("{value:#}\n")
        }
    }
}

fn object(run: &Trajectory) -> Value {
    let solver = run.solver.map(|solver| {
        json!({
            "mean_iterations": solver.mean_iterations,
            "max_residual": solver.max_residual,
        })
    });
    // What is not conserved has no drift.
    let momentum = (run.momenta > 0).then_some(run.drift.spatial_momentum);
    let casimirs = (run.casimirs > 0 || !run.potential).then_some(run.drift.casimirs);
    json!({
        "method": run.label,
        "truncation": run.truncation,
        "steps": run.steps,
        "time": run.time(),
        "momentum": run.momentum,
        "group_element": run.group_element,
        "drift": {
            "spatial_momentum": momentum,
            "casimirs": casimirs,
            "energy": run.drift.energy,
        },
        "conserved_momenta": run.momenta,
        "conserved_casimirs": run.casimirs,
        "solver": solver,
    })
}

fn text(run: &Trajectory) -> String {
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = writeln!(out, "{}: {} steps to time {}", run.label, run.steps, run.time());
    for (name, value) in run.coordinates.iter().zip(&run.momentum) {
        let _ = writeln!(out, "  {name:<10} {value:>22.16}");
    }
    let size = run.group_element.len();
    if size <= WIDEST {
        let _ = writeln!(out, "  group element");
        for row in &run.group_element {
            let entries: Vec<String> = row.iter().map(|value| format!("{value:>20.16}")).collect();
            let _ = writeln!(out, "    {}", entries.join(" "));
        }
    } else {
        let _ = writeln!(out, "  group element: {size} × {size}, see --format json or --out");
    }
    let drift = run.drift;
    let _ = writeln!(out, "  largest relative drift");
    let _ = match (run.potential, run.momenta) {
        (false, _) => writeln!(out, "    spatial momentum {:>10.1e}", drift.spatial_momentum),
        (true, 0) => {
            writeln!(out, "    spatial momentum not conserved: the potential breaks the symmetry")
        }
        (true, count) => writeln!(
            out,
            "    spatial momentum {:>10.1e} ({count} of its components; the potential breaks the \
             other symmetries)",
            drift.spatial_momentum
        ),
    };
    let _ = match (run.potential, run.casimirs) {
        (false, 0) => writeln!(out, "    Casimirs         none known"),
        (true, 0) => writeln!(out, "    Casimirs         none that the kicks keep"),
        (_, count) => writeln!(out, "    Casimirs ({count})     {:>10.1e}", drift.casimirs),
    };
    let _ = writeln!(out, "    energy           {:>10.1e}", drift.energy);
    if let Some(solver) = run.solver {
        let _ = writeln!(
            out,
            "  solver: {:.2} iterations a step, largest residual {:.1e}",
            solver.mean_iterations, solver.max_residual
        );
    }
    out
}
