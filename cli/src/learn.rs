//! `coadjoint learn`: fit a map to pairs of states.

use std::path::{Path, PathBuf};

use clap::Args;
use coadjoint_codegen::file;
use coadjoint_codegen::lie::Chart;
use coadjoint_learn::data::RowPolicy;
use coadjoint_learn::network::{Progress, TrainingOptions};
use coadjoint_learn::{
    Dataset, Errors, Figures, Kind, Request, Summary, learn, remove_checkpoints,
};

use crate::error::{CliError, unwritten};
use crate::named::{CHARTS, FORMATS, Format, Names, named};
use crate::{load, progress};

/// Kinds of models.
const MODELS: &Names<Kind> = &[
    ("auto", "Whichever cross-validates best", Kind::Auto),
    ("polynomial", "A polynomial by least squares", Kind::Polynomial),
    ("gp", "A Gaussian process", Kind::GaussianProcess),
    ("network", "A network", Kind::Network),
    ("hybrid", "A quadratic polynomial and a network", Kind::Hybrid),
];

/// Options of `learn`.
#[derive(Args, Debug)]
pub(crate) struct LearnOptions {
    /// Pairs of states: .csv, .npy, .npz or .parquet with the columns mu_1 …, mu_next_1 …, and for
    /// phase points g_11 …, g_next_11 … or q_w …, q_next_w …
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// The chart
    #[arg(long, value_parser = named(CHARTS), default_value = "exp")]
    chart: Chart,
    /// The time between the two states of a pair
    #[arg(long, value_name = "dt", allow_negative_numbers = true)]
    dt: f64,
    /// The total degree of a polynomial; chosen by cross-validation if not given
    #[arg(long, value_name = "d")]
    degree: Option<usize>,
    /// Write the model to this file
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Leave out rows that cannot be used, instead of refusing the data
    #[arg(long)]
    drop_bad_rows: bool,
    /// The seed of folds and weights
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Steps over which the drifts are measured
    #[arg(long, value_name = "N", default_value_t = 1000)]
    steps: usize,
    /// The initial momentum of the run that measures drifts, separated by commas; by default the first sample
    #[arg(long, value_delimiter = ',', allow_hyphen_values = true)]
    start: Option<Vec<f64>>,
    /// The output format
    #[arg(long, value_parser = named(FORMATS), default_value = "text")]
    format: Format,
    /// Pairs to test the model on
    #[arg(long, value_name = "DATA")]
    test: Option<PathBuf>,
    /// The group, by its name in the catalogue, or the system file (.toml) whose `group` or `[algebra]` it is
    #[arg(long, value_name = "GROUP", default_value = "SO3")]
    group: String,
    /// The kind of model
    #[arg(long, value_parser = named(MODELS), default_value = "auto")]
    model: Kind,
    /// The ridge of a polynomial of given degree
    #[arg(long, default_value_t = 0.0)]
    ridge: f64,
    /// Widths of the hidden layers of a network
    #[arg(long, value_name = "N", value_delimiter = ',', default_values_t = [500, 500])]
    widths: Vec<usize>,
    /// Evaluations of the loss of a network
    #[arg(long, value_name = "N", default_value_t = 1000)]
    evaluations: usize,
    /// The largest error of attitudes (distance from the group) and of momenta (change of J_L); `inf` for noisy data, and
    /// for steps of a method that conserves nothing
    #[arg(long, default_value_t = 1e-6)]
    tolerance: f64,
}

/// Learns the map behind pairs of states.
pub(crate) fn run(options: &LearnOptions) -> Result<(), CliError> {
    let data = std::iter::once(&options.data).chain(&options.test).map(PathBuf::as_path);
    let inputs: Vec<&Path> = data.chain(load::system_file(&options.group)).collect();
    let out = options.out.as_deref();
    // Refused before anything is computed.
    out.map_or(Ok(()), |out| file::check(out, &inputs).map_err(unwritten(out)))?;
    // Beside the model, so that a command given again goes on where it was killed.
    let checkpoint = out.map(|out| file::beside(out, ".checkpoint"));
    let network = TrainingOptions {
        widths: options.widths.clone(),
        checkpoint: checkpoint.clone(),
        ..TrainingOptions::budget(options.evaluations)
    };
    let request = Request {
        group: load::group(&options.group)?,
        chart: options.chart.name().into(),
        step: options.dt,
        kind: options.model,
        degree: options.degree,
        ridge: options.ridge,
        tolerance: Some(options.tolerance),
        policy: if options.drop_bad_rows { RowPolicy::Drop } else { RowPolicy::Refuse },
        start: options.start.clone(),
        seed: options.seed,
        network,
        drift_steps: options.steps,
    };
    let bar = progress::bar(1, "learning");
    let source = Dataset::files(&options.data, options.test.as_deref())?;
    let (model, summary) =
        learn(&request, source, &mut |Progress { step, total, loss, .. }| {
            bar.set_length(total as u64);
            bar.set_position(step as u64);
            bar.set_message(format!("loss {loss:.2e}"));
        })?;
    bar.finish_and_clear();
    if let Some(out) = out {
        let written = model.text().and_then(|text| file::write(out, &inputs, text.as_bytes()));
        written.map_err(unwritten(out))?;
    }
    match options.format {
        Format::Json => {
            let text = serde_json::to_string_pretty(&summary)
                .map_err(|e| CliError::Option(format!("the summary cannot be printed: {e}")))?;
            outln!("{text}");
        }
        Format::Text => print(&summary),
    }
    checkpoint.map_or(Ok(()), |base| Ok(remove_checkpoints(&base)?))
}

fn print(summary: &Summary) {
    summary.warnings.iter().for_each(|warning| errln!("warning: {warning}"));
    outln!("{}", summary.choice);
    let show = |name: &str, figures: &Figures| {
        let line = |what: &str, errors: &Errors| {
            let parts: Vec<String> =
                [("x", errors.x), ("momentum", errors.momentum), ("group", errors.group)]
                    .iter()
                    .filter_map(|(q, value)| value.map(|v| format!("{q} {v:.2e}")))
                    .collect();
            outln!("  {what:<10}{}", parts.join("  "));
        };
        outln!("{name}: {} samples", figures.samples);
        line("mse", &figures.mse);
        line("max error", &figures.max_error);
        if !figures.unsolved.is_empty() {
            outln!("  no step could be made at rows {:?}", figures.unsolved);
        }
    };
    show("train", &summary.train);
    if let Some(test) = &summary.test {
        show("test", test);
    }
    if let Some(drifts) = &summary.drifts {
        outln!(
            "drift over {} steps: momentum {:.1e}, Casimirs {:.1e}",
            drifts.steps,
            drifts.momentum,
            drifts.casimir
        );
    }
    if !summary.unused.is_empty() {
        outln!("columns that are not used: {}", summary.unused.join(", "));
    }
    for (row, reason) in &summary.dropped {
        outln!("left out row {row}: {reason}");
    }
}
