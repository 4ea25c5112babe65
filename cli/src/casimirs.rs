//! `coadjoint casimirs`: the polynomial Casimirs of the system's algebra.

use coadjoint_codegen::lie;
use coadjoint_codegen::smooth::Facts;
use coadjoint_codegen::system;
use coadjoint_run::series::sum;
use serde_json::json;

use crate::arguments::CasimirOptions;
use crate::error::CliError;
use crate::load;
use crate::named::Format;

/// Prints generators of the Casimirs up to the degree asked for.
pub(crate) fn run(options: &CasimirOptions) -> Result<(), CliError> {
    let problem = load::file(&options.file, system::Options::default())?.problem;
    let Facts { algebra, coordinates, .. } = problem.facts();
    let written = |casimir| sum(casimir, coordinates, &[]);
    let found = lie::casimirs(algebra, options.degree).map_err(|error| {
        CliError::Option(format!("{}: {error}; use --degree", options.file.display()))
    })?;
    match options.format {
        Format::Text => {
            outln!(
                "{}: {} generating Casimirs of degree up to {}",
                algebra.name(),
                found.len(),
                options.degree
            );
            for casimir in &found {
                outln!("{}", written(casimir));
            }
        }
        Format::Json => {
            let list: Vec<String> = found.iter().map(written).collect();
            outln!("{:#}", json!({ "group": algebra.name(), "casimirs": list }));
        }
    }
    Ok(())
}
