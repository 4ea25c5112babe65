//! `coadjoint geometrize`: the Poisson map nearest to a method that is none.

use std::path::{Path, PathBuf};

use clap::Args;
use coadjoint::groups::Chart;
use coadjoint_codegen::step::Energy;
use coadjoint_codegen::system::Options;
use coadjoint_learn::catalogue::{Visitor, visit};
use coadjoint_learn::data::MomentumPairs;
use coadjoint_learn::truth::{MomentumBox, OneStep, momentum_pairs};
use coadjoint_learn::{DataGroup, GroupChoice, Kind, Request, Source, learn};

use crate::error::CliError;
use crate::learn::Fit;
use crate::load;
use crate::named::{Names, named};

/// The most pairs that are made.
const MOST_SAMPLES: usize = 100_000;

/// Methods that keep no geometry.
const MAPS: &Names<OneStep> = &[
    ("euler", "Forward Euler", OneStep::Euler),
    ("heun", "Heun's method, of order 2", OneStep::Heun),
    ("rk4", "The classical Runge–Kutta method of order 4", OneStep::Rk4),
];

/// Options of `geometrize`.
#[derive(Args, Debug)]
pub(crate) struct GeometrizeOptions {
    /// Pairs of momenta: .csv, .npy, .npz or .parquet with the columns mu_1 …, mu_next_1 …
    #[arg(value_name = "DATA", required_unless_present = "system")]
    data: Option<PathBuf>,
    #[command(flatten)]
    fit: Fit,
    /// Make the pairs by a method on this system, instead of reading them
    #[arg(long, value_name = "FILE", conflicts_with_all = ["data", "test", "group"])]
    system: Option<PathBuf>,
    /// The method
    #[arg(long, value_parser = named(MAPS), default_value = "euler", requires = "system")]
    map: OneStep,
    /// How many pairs to make
    #[arg(long, value_name = "N", default_value_t = 1000, requires = "system")]
    samples: usize,
    /// The interval from which each coordinate of the momenta is drawn
    #[arg(long, value_name = "LOW,HIGH", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(num_args = 1, default_value = "-2.5,2.5", requires = "system")]
    within: Vec<f64>,
    /// Pairs to test the map on
    #[arg(long, value_name = "DATA")]
    test: Option<PathBuf>,
    /// The group of the data, by its name in the catalogue, or the system file (.toml) whose `group` or `[algebra]` it is
    #[arg(long, value_name = "GROUP", default_value = "SO3")]
    group: String,
}

/// Finds the Poisson map.
pub(crate) fn run(options: &GeometrizeOptions) -> Result<(), CliError> {
    let named = [&options.data, &options.system, &options.test];
    let named = named.into_iter().flatten().map(PathBuf::as_path);
    let inputs: Vec<&Path> = named.chain(load::system_file(&options.group)).collect();
    options.fit.check(&inputs)?;
    let data = options.data.as_deref().unwrap_or(Path::new(""));
    let request = Request {
        kind: Kind::Polynomial,
        momenta_only: true,
        ..options.fit.request(load::group(&options.group)?)
    };
    let (file, summary) = match &options.system {
        None => learn(&request, Source::files(data, options.test.as_deref())?, &mut |_| {})?,
        Some(path) => {
            let problem = load::file(path, Options::default())?.problem;
            let request = Request { group: GroupChoice::of(problem.facts().algebra), ..request };
            let pairs = Pairs { options, energy: Energy::new(&problem) };
            let pairs = visit(&request.group, &request.chart, pairs)??;
            learn(&request, Source::Momenta(&pairs), &mut |_| {})?
        }
    };
    options.fit.finish(&inputs, &file, &summary)
}

struct Pairs<'a> {
    options: &'a GeometrizeOptions,
    energy: Energy,
}

impl Visitor for Pairs<'_> {
    type Output = Result<MomentumPairs, CliError>;

    fn visit<G: DataGroup, C: Chart<G>>(self, group: G) -> Self::Output {
        let Self { options, energy } = self;
        let &[low, high] = options.within.as_slice() else {
            let what = "--within takes two numbers, as in --within -2.5,2.5";
            return Err(CliError::Option(what.to_owned()));
        };
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(CliError::Option(format!("--within {low},{high} is no interval")));
        }
        if options.samples == 0 {
            return Err(CliError::Option("--samples must be at least 1".to_owned()));
        }
        if options.samples > MOST_SAMPLES {
            return Err(CliError::Option(format!(
                "--samples {}: at most {MOST_SAMPLES} pairs are made and held in memory; a few \
                 thousand determine every map that can be fitted",
                options.samples
            )));
        }
        let slopes = energy.gradient(group.dim());
        let gradient = |mu: &[f64], out: &mut [f64]| out.copy_from_slice(&slopes(mu));
        let (step, seed) = (options.fit.dt, options.fit.seed);
        Ok(momentum_pairs(&group, MomentumBox { low, high }, options.samples, seed, |mu| {
            options.map.advance(&group, gradient, mu, step)
        }))
    }
}
