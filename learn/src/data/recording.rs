//! The contents of a data file, before a group is involved.

use nalgebra::DMatrix;

use super::columns::Columns;
use super::npy::{matrix, numbered, quaternion};
use super::reduce::{PairRows, PhasePair};
use super::samples::MomentumPairs;
use crate::error::{BadRow, LearnError, RowProblem};
use crate::function::vector;
use crate::group::DataGroup;
use coadjoint::Phase;

/// Attitudes as they stand in a file: a sample per column.
#[derive(Clone, Debug, PartialEq)]
pub struct Attitudes {
    /// Whether they are unit quaternions w, x, y, z: 4 rows; else matrices, row by row: d² rows.
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
    /// Picks the columns by name: `mu_1` … `mu_n`, `mu_next_1` …; if present `g_11` … `g_dd` and
    /// `g_next_11` …, else if present `q_w`, `q_x`, `q_y`, `q_z` and `q_next_w` …
    ///
    /// # Errors
    /// [`LearnError::MissingColumn`] for a column that must be there.
    pub fn from_columns(
        columns: &Columns,
        dim: usize,
        matrix_size: usize,
    ) -> Result<Self, LearnError> {
        if columns.rows() == 0 {
            return Err(LearnError::NoSamples);
        }
        if columns.column(&format!("mu_{}", dim + 1)).is_some() {
            let found = (1..).take_while(|i| columns.column(&format!("mu_{i}")).is_some()).count();
            let what = "a momentum of this group".to_owned();
            return Err(LearnError::Shape { what, expected: dim, found });
        }
        let mut unused = columns.names().to_vec();
        let mut gather = |names: &[String]| -> Result<DMatrix<f64>, LearnError> {
            unused.retain(|column| !names.contains(column));
            let mut gathered = DMatrix::zeros(names.len(), columns.rows());
            for (i, name) in names.iter().enumerate() {
                let column = columns.column(name).ok_or_else(|| LearnError::MissingColumn {
                    missing: name.clone(),
                    dim,
                    found: columns.names().to_vec(),
                })?;
                gathered.row_mut(i).copy_from_slice(column);
            }
            Ok(gathered)
        };
        let momenta = MomentumPairs {
            before: gather(&numbered("mu", dim))?,
            after: gather(&numbered("mu_next", dim))?,
        };
        let quaternions = columns.column("g_11").is_none();
        let attitudes = if quaternions && columns.column("q_w").is_none() {
            None
        } else {
            let names = |name: &str| match quaternions {
                true => quaternion(&format!("q{name}")).to_vec(),
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
        for i in 0..self.momenta.len() {
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
