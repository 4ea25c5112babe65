//! Trajectories as files.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use npyz::WriterBuilder;

use super::trajectory::Trajectory;
use crate::error::CliError;

/// The name itself, or with the truncation before its ending where there are several runs.
pub fn numbered(out: &Path, trajectory: &Trajectory, several: bool) -> PathBuf {
    let (true, Some(k)) = (several, trajectory.truncation) else { return out.to_owned() };
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let ending = out.extension().unwrap_or_default().to_string_lossy();
    out.with_file_name(format!("{stem}-K{k}.{ending}"))
}

/// Writes a table with one row per record: time, mu_1 …, g_11 …, energy, and the three drifts.
/// Of g the diagonal blocks; the other entries of a product are 0. `.csv` has a line of names above; `.npy` is the bare matrix.
pub fn trajectory(path: &Path, trajectory: &Trajectory) -> Result<(), CliError> {
    let failed = |message: String| CliError::Write { path: path.to_owned(), message };
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("csv") => csv(path, trajectory).map_err(|error| failed(error.to_string())),
        Some("npy") => npy(path, trajectory).map_err(|error| failed(error.to_string())),
        _ => Err(CliError::Option(format!(
            "--out {}: the name must end in .csv or .npy",
            path.display()
        ))),
    }
}

fn names(trajectory: &Trajectory) -> Vec<String> {
    let mut names = vec!["time".to_owned()];
    names.extend((1..=trajectory.momentum.len()).map(|i| format!("mu_{i}")));
    let size = trajectory.group_element.len();
    // g_1_12 rather than g_112 where one digit is not enough.
    let separator = if size > 9 { "_" } else { "" };
    for block in &trajectory.blocks {
        let indices = block.start + 1..=block.end;
        let name = |i, j| format!("g_{i}{separator}{j}");
        names.extend(indices.clone().flat_map(|i| indices.clone().map(move |j| name(i, j))));
    }
    names.extend(
        ["energy", "spatial_momentum_drift", "casimir_drift", "energy_drift"].map(Into::into),
    );
    names
}

fn rows(trajectory: &Trajectory) -> impl Iterator<Item = Vec<f64>> + '_ {
    trajectory.records.iter().map(|record| {
        let mut row = vec![record.time];
        row.extend(&record.momentum);
        row.extend(&record.element);
        let drift = record.drift;
        row.extend([record.energy, drift.spatial_momentum, drift.casimirs, drift.energy]);
        row
    })
}

fn csv(path: &Path, trajectory: &Trajectory) -> Result<(), csv::Error> {
    let mut writer = csv::Writer::from_path(path)?;
    writer.write_record(names(trajectory))?;
    for row in rows(trajectory) {
        // The shortest decimals that read back as the same numbers.
        writer.write_record(row.iter().map(f64::to_string))?;
    }
    writer.flush()?;
    Ok(())
}

fn npy(path: &Path, trajectory: &Trajectory) -> std::io::Result<()> {
    let shape = [trajectory.records.len() as u64, names(trajectory).len() as u64];
    let mut writer = npyz::WriteOptions::new()
        .default_dtype()
        .shape(&shape)
        .writer(BufWriter::new(File::create(path)?))
        .begin_nd()?;
    for row in rows(trajectory) {
        writer.extend(row)?;
    }
    writer.finish()
}
