//! The experiments by name: each fills in a report.

mod hamilton_jacobi;
mod learning;
mod poisson;
mod reduction_error;
mod series;
mod type_two;

use crate::outcome::{CHECKPOINT, Config, Fallible, Report};

type Run = fn(&Config) -> Fallible<Report>;

/// The experiments, in the order in which `all` runs them.
pub const EXPERIMENTS: [(&str, Run); 12] = [
    ("simulation", series::simulation),
    ("orders", series::orders),
    ("work", series::work),
    ("table-2", poisson::table_two),
    ("hamiltonian", poisson::hamiltonian),
    ("geometrize", poisson::geometrize),
    ("hamilton-jacobi", hamilton_jacobi::run),
    ("reduction-error", reduction_error::run),
    ("learned", learning::learned),
    ("noise", learning::noise),
    ("table-1", learning::table_one),
    ("harder-truths", learning::harder),
];

/// Runs the experiment `name`, or `all` in turn. With a folder to write to, an interrupted run goes on where it stopped:
/// `all` reads back the experiments that are done, and networks of tables go on from their last checkpoint.
pub fn run(name: &str, options: &Config) -> Fallible<Vec<Report>> {
    let chosen: Vec<_> = EXPERIMENTS.iter().filter(|one| name == "all" || one.0 == name).collect();
    if chosen.is_empty() {
        let names = EXPERIMENTS.map(|one| one.0).join(", ");
        return Err(format!("there is no experiment {name}: use one of {names}, or all").into());
    }
    if let Some(folder) = &options.out {
        let failed = |e| format!("cannot make the folder {}: {e}", folder.display());
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    let mut reports = Vec::new();
    for (number, (own, run)) in chosen.iter().enumerate() {
        let turn = format!("{} of {}: {own}", number + 1, chosen.len());
        let folder = options.out.as_deref();
        let done = folder.filter(|_| name == "all");
        let done = done.and_then(|folder| Report::read(folder, own, options.quick, options.seed));
        if let Some(report) = done {
            eprintln!("{turn}: done already");
            reports.push(report);
            continue;
        }
        eprintln!("{turn} …");
        let report = run(options)?;
        if let Some(folder) = folder {
            report.write(folder)?;
            for file in crate::outcome::files(folder, CHECKPOINT)? {
                let name = file.file_name().unwrap_or_default().to_string_lossy();
                if name.strip_prefix(own).is_some_and(|rest| rest.starts_with('.')) {
                    std::fs::remove_file(&file)?;
                }
            }
        }
        reports.push(report);
    }
    Ok(reports)
}
