//! Which columns hold what.

use std::path::Path;

use coadjoint_codegen::lie::RationalMatrix;
use coadjoint_codegen::problem::Problem;

use crate::error::CliError;

/// The places of the time, the momentum and the group element in a row.
#[derive(Clone, Debug)]
pub struct Columns {
    pub time: Option<usize>,
    momentum: Vec<usize>,
    /// (place in the matrix, place in the row); empty where the file has no group elements.
    element: Vec<(usize, usize)>,
    size: usize,
}

impl Columns {
    /// By names, or by the number of columns where there are none.
    pub fn find(
        problem: &Problem,
        names: &[String],
        width: usize,
        file: &Path,
    ) -> Result<Self, CliError> {
        let dim = problem.algebra.dim();
        let size = problem
            .algebra
            .basis()
            .map_or(dim, |basis| basis.first().map_or(0, RationalMatrix::rows));
        if names.is_empty() {
            let momentum = (0..dim).collect();
            let whole = width == dim + size * size;
            let element: Vec<_> = if whole {
                (0..size * size).map(|at| (at, dim + at)).collect()
            } else {
                Vec::new()
            };
            if width < dim || (width > dim && !whole) {
                return Err(CliError::Option(format!(
                    "{}: {width} columns without names; this system has {dim} momenta, and {} \
                     entries of a group element",
                    file.display(),
                    size * size
                )));
            }
            return Ok(Self { time: None, momentum, element, size });
        }
        let place = |name: &str| names.iter().position(|known| known == name);
        let mut momentum = Vec::new();
        for (i, name) in problem.coordinates.iter().enumerate() {
            let numbered = format!("mu_{}", i + 1);
            let found = place(&numbered)
                .or_else(|| place(&format!("momentum_{name}")))
                .or_else(|| place(name));
            momentum.push(found.ok_or_else(|| {
                CliError::Option(format!(
                    "{}: no column {name} or {numbered}; the file has {}",
                    file.display(),
                    names.join(", ")
                ))
            })?);
        }
        let mut element = Vec::new();
        let separator = if size > 9 { "_" } else { "" };
        for at in 0..size * size {
            let name = format!("g_{}{separator}{}", at / size + 1, at % size + 1);
            element.extend(place(&name).map(|column| (at, column)));
        }
        Ok(Self { time: place("time"), momentum, element, size })
    }

    /// The momentum of a row.
    pub fn momentum(&self, row: &[f64]) -> Vec<f64> {
        self.momentum.iter().map(|&at| row[at]).collect()
    }

    /// The matrix of the group element of a row, row by row; entries that have no column are 0.
    pub fn element(&self, row: &[f64]) -> Option<Vec<f64>> {
        if self.element.is_empty() {
            return None;
        }
        let mut matrix = vec![0.0; self.size * self.size];
        for &(at, column) in &self.element {
            matrix[at] = row[column];
        }
        Some(matrix)
    }
}
