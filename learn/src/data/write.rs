//! Writing pairs of phase points as CSV, in the columns the reader looks for.

use std::path::Path;

use super::npy::{matrix, numbered};
use super::reduce::PhasePair;
use crate::error::LearnError;
use crate::function::entries;
use crate::group::matrix_of;
use coadjoint::LieGroup;

/// Writes pairs as CSV: `mu_…`, `mu_next_…`, `g_…`, `g_next_…`, in the shortest decimal form that
/// reads back to the same number.
///
/// # Errors
/// [`LearnError::File`] or [`LearnError::Format`] when the file cannot be written.
pub fn write_csv<G: LieGroup<Scalar = f64>>(
    path: &Path,
    group: &G,
    pairs: &[PhasePair<G>],
) -> Result<(), LearnError> {
    let format = |e: ::csv::Error| LearnError::Format {
        path: path.into(),
        format: "CSV",
        reason: e.to_string(),
    };
    let (dim, size) = (group.dim(), group.matrix_size());
    let mut writer = ::csv::Writer::from_path(path).map_err(format)?;
    let header =
        [numbered("mu", dim), numbered("mu_next", dim), matrix("g", size), matrix("g_next", size)];
    writer.write_record(header.concat()).map_err(format)?;
    for pair in pairs {
        let mut row = entries(&pair.before.momentum);
        row.extend(entries(&pair.after.momentum));
        for phase in [&pair.before, &pair.after] {
            let g = matrix_of(group, &phase.group_element);
            row.extend(g.transpose().iter());
        }
        writer.write_record(row.iter().map(f64::to_string)).map_err(format)?;
    }
    writer.flush().map_err(|source| LearnError::File { path: path.into(), source })
}
