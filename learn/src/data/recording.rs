//! The contents of a table of pairs of states, before a group is involved.

use std::path::Path;

use coadjoint::Phase;
use coadjoint_codegen::file;
use nalgebra::DMatrix;

use super::reduce::{MomentumPairs, PairRows, PhasePair};
use crate::error::{BadRow, LearnError, RowProblem};
use crate::function::vector;
use crate::group::DataGroup;
use crate::table::{Cells, Table, matrix, numbered, quaternion};

/// Opens a file of pairs that fits into memory: `.csv` with a header, `.npz` with named arrays, `.npy` with one matrix,
/// `.parquet` (feature `parquet`).
///
/// # Errors
/// [`LearnError::UnknownFormat`] for another ending, else what is wrong with the file.
pub fn open(path: &Path) -> Result<Table, LearnError> {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    if !matches!(ending.as_deref(), Some("csv" | "npy" | "npz" | "parquet")) {
        return Err(LearnError::UnknownFormat(path.into()));
    }
    file::open_whole(path).map_err(LearnError::file(path))?;
    Table::open(path)
}

/// The names of the columns of a matrix with a sample per row: μ, then μ after the step, then nothing, or the attitude
/// before and after as matrices row by row (2d² columns), or as quaternions w, x, y, z (8 columns). `dim` and `size` are n
/// and d.
fn names_of_matrix(table: &Table, dim: usize, size: usize) -> Result<Vec<String>, LearnError> {
    let attitudes = match table.width().checked_sub(2 * dim) {
        Some(0) => Vec::new(),
        Some(8) => [quaternion("q"), quaternion("q_next")].concat(),
        Some(rest) if rest == 2 * size * size => {
            [matrix("g", size), matrix("g_next", size)].concat()
        }
        _ => {
            let what = format!("a row of {}", table.path().display());
            return Err(LearnError::Shape { what, expected: 2 * dim, found: table.width() });
        }
    };
    Ok([numbered("mu", dim), numbered("mu_next", dim), attitudes].concat())
}

/// All columns of a table; those that are not ours may hold any text.
fn columns(table: &mut Table, names: &[String]) -> Result<Vec<Vec<f64>>, LearnError> {
    let ours = |name: &str| ["mu_", "g_", "q_"].iter().any(|start| name.starts_with(start));
    let mut columns = vec![Vec::new(); names.len()];
    let mut cells = Cells::default();
    while table.read(&mut cells)? {
        let row = table.number() as usize;
        if cells.len() != names.len() {
            let reason = format!("row {row} has {} cells in place of {}", cells.len(), names.len());
            return Err(LearnError::format(table.path(), "CSV", reason));
        }
        for (place, (name, column)) in names.iter().zip(&mut columns).enumerate() {
            column.push(match cells.number(place) {
                Ok(value) => value,
                Err(_) if !ours(name) => f64::NAN,
                Err(text) => {
                    return Err(LearnError::NotANumber { row, column: name.clone(), text });
                }
            });
        }
    }
    Ok(columns)
}

/// Attitudes as they stand in a file: a sample per column.
#[derive(Clone, Debug, PartialEq)]
pub struct Attitudes {
    /// True for unit quaternions w, x, y, z (4 rows); false for matrices, row by row (d² rows).
    pub quaternions: bool,
    /// The attitudes g′ before.
    pub before: DMatrix<f64>,
    /// The attitudes g″ after.
    pub after: DMatrix<f64>,
}

/// Pairs of states as recorded: momenta before and after, and attitudes if there are any.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// μ′ and μ″, a sample per column.
    pub momenta: MomentumPairs,
    /// The attitudes g′ before and g″ after, if they were recorded.
    pub attitudes: Option<Attitudes>,
    /// The columns that are neither.
    pub unused: Vec<String>,
}

impl Recording {
    /// Reads a table and picks the columns by name: `mu_1` … `mu_n`, `mu_next_1` …; if present `g_11` … `g_dd` and
    /// `g_next_11` …, else if present `q_w`, `q_x`, `q_y`, `q_z` and `q_next_w` … A table without names has these columns in
    /// this order. `dim` is n and `matrix_size` is d, the size of group elements as matrices.
    ///
    /// # Errors
    /// [`LearnError::MissingColumn`] for a column that must be there, [`LearnError::NotANumber`] for a bad cell in one.
    pub fn read(mut table: Table, dim: usize, matrix_size: usize) -> Result<Self, LearnError> {
        let names = match table.names() {
            [] => names_of_matrix(&table, dim, matrix_size)?,
            names => names.to_vec(),
        };
        let columns = columns(&mut table, &names)?;
        let rows = columns.first().map_or(0, Vec::len);
        if rows == 0 {
            return Err(LearnError::NoSamples);
        }
        let place = |name: &str| names.iter().position(|other| other == name);
        if place(&format!("mu_{}", dim + 1)).is_some() {
            let found = (1..).take_while(|i| place(&format!("mu_{i}")).is_some()).count();
            let what = "a momentum of this group".to_owned();
            return Err(LearnError::Shape { what, expected: dim, found });
        }
        let mut unused = names.clone();
        let mut gather = |wanted: &[String]| -> Result<DMatrix<f64>, LearnError> {
            unused.retain(|column| !wanted.contains(column));
            let mut gathered = DMatrix::zeros(wanted.len(), rows);
            for (i, name) in wanted.iter().enumerate() {
                let missing = || LearnError::MissingColumn {
                    missing: name.clone(),
                    dim,
                    found: names.clone(),
                };
                let place = place(name).ok_or_else(missing)?;
                gathered.row_mut(i).copy_from_slice(&columns[place]);
            }
            Ok(gathered)
        };
        let momenta = MomentumPairs {
            before: gather(&numbered("mu", dim))?,
            after: gather(&numbered("mu_next", dim))?,
        };
        let quaternions = place("g_11").is_none();
        let attitudes = if quaternions && place("q_w").is_none() {
            None
        } else {
            let names = |name: &str| match quaternions {
                true => quaternion(&format!("q{name}")),
                false => matrix(&format!("g{name}"), matrix_size),
            };
            let (before, after) = (gather(&names(""))?, gather(&names("_next"))?);
            Some(Attitudes { quaternions, before, after })
        };
        Ok(Self { momenta, attitudes, unused })
    }

    /// The pairs of phase points on `group`; rows that are not finite or off the group by more
    /// than `tolerance` (in a matrix entry; a quaternion's length likewise) come back as bad.
    ///
    /// # Errors
    /// [`LearnError::NoAttitude`] for momenta only, [`LearnError::NoQuaternions`] for quaternions
    /// of a group that has none.
    pub fn phase_pairs<G: DataGroup>(
        &self,
        group: &G,
        tolerance: f64,
    ) -> Result<PairRows<G>, LearnError> {
        let Some(Attitudes { quaternions, before, after }) = &self.attitudes else {
            return Err(LearnError::NoAttitude);
        };
        if *quaternions && group.element_of_quaternion([1.0, 0.0, 0.0, 0.0]).is_none() {
            return Err(LearnError::NoQuaternions);
        }
        let element = |column: &[f64]| -> Result<G::Element, RowProblem> {
            if !column.iter().all(|v| v.is_finite()) {
                return Err(RowProblem::NonFinite);
            }
            match group.element_of_columns(column, *quaternions) {
                (Some(g), distance) if distance <= tolerance => Ok(g),
                (_, distance) => Err(RowProblem::OffGroup(distance)),
            }
        };
        let (mut pairs, mut bad) = (Vec::new(), Vec::new());
        for i in 0..self.momenta.count() {
            let (mu, mu_next) = (self.momenta.before.column(i), self.momenta.after.column(i));
            let row = i + 1;
            if !mu.iter().chain(mu_next.iter()).all(|v| v.is_finite()) {
                bad.push(BadRow { row, problem: RowProblem::NonFinite });
                continue;
            }
            let ends = element(before.column(i).as_slice())
                .and_then(|g| Ok((g, element(after.column(i).as_slice())?)));
            match ends {
                Ok((g, g_next)) => pairs.push((
                    row,
                    PhasePair {
                        before: Phase::new(g, vector::<G>(mu.as_slice())),
                        after: Phase::new(g_next, vector::<G>(mu_next.as_slice())),
                    },
                )),
                Err(problem) => bad.push(BadRow { row, problem }),
            }
        }
        Ok(PairRows { pairs, bad })
    }
}
