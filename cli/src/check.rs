//! `coadjoint check`: the laws of the method, tried on this system at random points near its run.

use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::system::Parameters;
use coadjoint_run::check::{Law, Trial, Verdict, check, steep, unmeasured};
use coadjoint_run::{Accuracy, Derived};
use serde_json::{Value, json};

use crate::arguments::CheckOptions;
use crate::error::CliError;
use crate::named::Format;
use crate::{load, progress};

/// Tries all laws, prints them, and fails if one is found not to hold.
pub(crate) fn run(options: &CheckOptions) -> Result<(), CliError> {
    let path = &options.source.file;
    let CheckOptions { source, step, t0, points, seed, .. } = options;
    let asked = Accuracy { step: *step, t0: *t0, ..Accuracy::default() };
    let (system, _) = load::settled(source, &asked, Parameters::Substituted)?;
    let trial = Trial::new(&asked, &system.run, *points, *seed)?;
    let phase = progress::phase("deriving the series");
    let system = Derived::of_file(path, system)?;
    drop(phase);
    system.gave_way().iter().for_each(|note| errln!("note: {note}"));
    let (laws, ratio) = check(&system, &trial)?;
    if let Some(ratio) = ratio {
        errln!("warning: {}", steep(ratio));
    }
    let Facts { name, algebra, truncation, .. } = system.facts();
    let (group, label) = (algebra.name(), system.label());
    let chart = system.series().map(|series| series.problem.chart);
    let Trial { step, points, seed, .. } = trial;
    let breaks = system.drive().is_some_and(|drive| drive.torque.is_some());
    if options.format == Format::Json {
        let mut object = json!({
            "system": name,
            "group": group,
            "method": label,
            "truncation": truncation,
            "step": step,
            "points": points,
            "about": trial.about,
            "laws": laws.iter().map(object).collect::<Value>(),
            "warnings": ratio.iter().map(|&ratio| json!({
                "kind": "series_ratio",
                "ratio": ratio,
                "text": steep(ratio),
            })).collect::<Value>(),
        });
        if breaks {
            object["torque"] = json!("breaks the laws: the order is measured alone");
        }
        if let Some(chart) = chart {
            object["chart"] = json!(chart.to_string());
        }
        outln!("{object:#}");
    } else {
        let place = trial.place();
        let method = match chart {
            Some(chart) => format!("chart {chart}, K = {truncation}"),
            None => label,
        };
        outln!(
            "{name}: group {group}, {method}, h = {step}, {points} random points {place} (seed {seed})"
        );
        ratio.iter().for_each(|&ratio| outln!("  warning: {}", steep(ratio)));
        if breaks {
            outln!("  a torque breaks the other laws:");
        }
        laws.iter().for_each(|law| outln!("  {}", line(law)));
        unmeasured(&system).iter().for_each(|why| outln!("  {why}"));
    }
    let failed = laws.iter().filter(|law| law.verdict == Verdict::Fails);
    let failed: Vec<&str> = failed.map(|law| law.name).collect();
    if failed.is_empty() {
        return Ok(());
    }
    Err(CliError::Laws(format!("these laws do not hold: {}", failed.join(", "))))
}

fn object(law: &Law) -> Value {
    let mut object = json!({ "name": law.name, "bound": law.bound });
    match law.verdict {
        Verdict::NotMeasured(why) => object["not_measured"] = json!(why),
        verdict => object["pass"] = json!(verdict == Verdict::Holds),
    }
    // JSON has no infinity: an order beyond measure, or a value that is no number, has no key.
    if law.value.is_finite() {
        object["value"] = json!(law.value);
    }
    object
}

fn line(law: &Law) -> String {
    let (relation, value, bound) = if law.name.starts_with("order") {
        (">=", format!("{:.2}", law.value), format!("{:.1}", law.bound))
    } else {
        ("<=", format!("{:.1e}", law.value), format!("{:.0e}", law.bound))
    };
    let (name, statement) = (law.name, law.statement);
    let verdict = match law.verdict {
        Verdict::Holds => "holds",
        Verdict::Fails => "FAILS",
        Verdict::NotMeasured(why) => return format!("{name:<12} not measured: {why}"),
    };
    format!("{name:<12} {value:>8} {relation} {bound:<6} {verdict}   {statement}")
}
