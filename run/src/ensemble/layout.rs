//! Which columns a row of states has, in files as in memory.

use std::collections::HashMap;

use coadjoint::{LieGroup, SO3};
use coadjoint_codegen::lie::LieAlgebra;
use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::smooth::Facts;
use coadjoint_learn::DataGroup;
use nalgebra::UnitQuaternion;

use crate::error::RunError;
use crate::load::System;

/// The largest distance of an attitude from the group, as for `coadjoint learn`: far above rounding in files, far below noise.
const TOLERANCE: f64 = 1e-6;

/// The form in which a row gives the attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attitude {
    /// Not at all: momenta only.
    None,
    /// The matrix of the group element, row by row.
    Matrix,
    /// A unit quaternion w, x, y, z.
    Quaternion,
}

/// The shape of a group's rows.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// n, coordinates of the momentum.
    pub dim: usize,
    /// d, the size of the matrix of a group element.
    pub matrix_size: usize,
    /// True if a unit quaternion gives the element.
    pub quaternions: bool,
}

impl Shape {
    /// Of the group with this algebra, factor by factor.
    pub(crate) fn of(algebra: &LieAlgebra) -> Self {
        let matrix_size = algebra.factors().iter().map(LieAlgebra::matrix_size).sum();
        Self { dim: algebra.dim(), matrix_size, quaternions: algebra.name() == "SO3" }
    }

    /// Of a system: with a potential, its group is no product of factors.
    pub fn of_system(system: &System) -> Self {
        let algebra = system.problem.facts().algebra;
        let shape = Self::of(algebra);
        match system.potential {
            Some(_) => Self { matrix_size: algebra.matrix_size(), ..shape },
            None => shape,
        }
    }
}

/// The columns of a quaternion.
const QUATERNION: [&str; 4] = ["q_w", "q_x", "q_y", "q_z"];

/// The names that a system gives.
#[derive(Clone, Debug, Default)]
pub struct Known {
    coordinates: Vec<String>,
    parameters: Vec<Parameter>,
    /// The rows of each block of the matrix of a group element.
    blocks: Vec<usize>,
}

impl Known {
    /// By these facts, and all parameters of the system's file.
    pub fn of(facts: &Facts<'_>, parameters: &[Parameter]) -> Self {
        Self {
            coordinates: facts.coordinates.to_vec(),
            parameters: parameters.to_vec(),
            blocks: facts.algebra.factors().iter().map(LieAlgebra::matrix_size).collect(),
        }
    }

    /// True if a column has the values of a parameter. One that is nearly called like a parameter is refused.
    fn parameter(&self, column: &str) -> Result<bool, String> {
        for parameter in &self.parameters {
            let (name, scalars) = (&parameter.name, parameter.scalar_names());
            if scalars.iter().any(|scalar| scalar == column) {
                return Ok(true);
            }
            let entry = column == name || column.starts_with(&format!("{name}["));
            let like = scalars.iter().find(|scalar| plain(scalar) == plain(column));
            let (first, last) = (scalars.first(), scalars.last());
            if let (true, None, Some(first), Some(last)) = (entry, like, first, last) {
                return Err(format!(
                    "column {column}: the parameter {name} has the numbers {first} … {last}, which vary each in a \
                     column of its own"
                ));
            }
            if let Some(scalar) = like {
                return Err(format!(
                    "column {column} is no parameter of the system: did you mean {scalar}? Else give the column \
                     another name"
                ));
            }
        }
        Ok(false)
    }

    /// True if this entry of the matrix is outside of all blocks, where entries are 0.
    fn is_zero(&self, entry: usize, size: usize) -> bool {
        let block = |index: usize| {
            let mut end = 0;
            self.blocks.iter().position(|rows| {
                end += rows;
                index < end
            })
        };
        size > 0 && block(entry / size) != block(entry % size)
    }
}

/// A name without what is easily written otherwise.
fn plain(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The columns that hold the numbers of a state.
#[derive(Clone, Debug)]
pub struct Found {
    /// The layout of the state, and of the parameters that vary.
    pub layout: Layout,
    /// The column of each number; none where the number is 0 in every element of the group.
    pub places: Vec<Option<usize>>,
    /// The columns that are no part of it.
    pub unused: Vec<String>,
}

impl Found {
    /// By the names of columns, or by their number where they have no names.
    ///
    /// # Errors
    /// A column is missing, is there twice, or is nearly named after a parameter; or no state has this number of columns.
    pub fn of(
        shape: Shape,
        known: &Known,
        names: &[String],
        width: usize,
    ) -> Result<Self, RunError> {
        if !names.is_empty() {
            return Self::find(shape, known, names);
        }
        let layout = Layout::of_width(shape, width)?;
        Ok(Self { layout, places: (0..width).map(Some).collect(), unused: Vec::new() })
    }

    /// Finds the numbers of a state among named columns. A coordinate is called `mu_i`, or what the system calls it, as
    /// records of runs do.
    ///
    /// # Errors
    /// Fails if a column is missing, is there twice, or is nearly called what the system calls a parameter.
    fn find(shape: Shape, known: &Known, header: &[String]) -> Result<Self, RunError> {
        let refuse = |what: String| Err(RunError::Option(what));
        let mut first = HashMap::new();
        for (column, name) in header.iter().enumerate() {
            first.entry(name.as_str()).or_insert(column);
        }
        let position = |name: &str| first.get(name).copied();
        let entries = matrix(shape.matrix_size);
        let attitude = match (
            entries.iter().find(|name| position(name).is_some()),
            QUATERNION.iter().find(|name| position(name).is_some()),
        ) {
            (Some(g), Some(q)) => {
                return refuse(format!(
                    "columns {g} and {q} both give the attitude: keep either g_… or q_w, q_x, q_y, q_z"
                ));
            }
            (Some(_), None) => Attitude::Matrix,
            (None, Some(_)) => Attitude::Quaternion,
            (None, None) => Attitude::None,
        };
        if attitude == Attitude::Quaternion && !shape.quaternions {
            return refuse(format!(
                "columns q_w … q_z: elements of this group are no quaternions; give the attitude \
                 as a {d}×{d} matrix, {first} …",
                d = shape.matrix_size,
                first = entries.first().map_or("g_11", String::as_str)
            ));
        }
        let mut layout = Layout { shape, attitude, parameters: Vec::new() };
        let names = layout.names();
        let mut places = Vec::with_capacity(names.len());
        for (number, name) in names.iter().enumerate() {
            let own = known
                .coordinates
                .get(number)
                .and_then(|own| position(&format!("momentum_{own}")).or_else(|| position(own)));
            let place = position(name).or(own);
            let zero = number >= shape.dim && known.is_zero(number - shape.dim, shape.matrix_size);
            if place.is_none() && !(attitude == Attitude::Matrix && zero) {
                return refuse(format!(
                    "column {name} is missing: this system needs {}; there are {}",
                    names.join(", "),
                    header.join(", ")
                ));
            }
            places.push(place);
        }
        let mut used = vec![false; header.len()];
        places.iter().flatten().for_each(|&place| used[place] = true);
        let mut unused = Vec::new();
        for (column, name) in header.iter().enumerate() {
            let index = name.strip_prefix("mu_").and_then(|index| index.parse::<usize>().ok());
            if index.is_some_and(|index| index == 0 || index > shape.dim) {
                return refuse(format!(
                    "column {name}: the momentum of this system has the coordinates mu_1 … mu_{}; \
                     take it out or give it another name",
                    shape.dim
                ));
            }
            if used[column] {
                continue;
            }
            if let Some(before) = position(name).filter(|&before| used[before]) {
                return refuse(format!(
                    "column {name} is there twice, in row 1 as cells {} and {}: keep one",
                    before + 1,
                    column + 1
                ));
            }
            match known.parameter(name).map_err(RunError::Option)? {
                true => {
                    used[column] = true;
                    places.push(Some(column));
                    layout.parameters.push(name.clone());
                }
                false => unused.push(name.clone()),
            }
        }
        Ok(Self { layout, places, unused })
    }
}

/// The columns of a row: `mu_1` … `mu_n`, then the attitude, then the parameters that vary.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The shape of the group's rows.
    pub shape: Shape,
    /// The columns after the momentum.
    pub attitude: Attitude,
    /// The names of the parameters after these.
    pub parameters: Vec<String>,
}

impl Layout {
    /// The number of columns.
    pub fn width(&self) -> usize {
        self.state() + self.parameters.len()
    }

    /// The number of those of the state.
    pub fn state(&self) -> usize {
        let attitude = match self.attitude {
            Attitude::None => 0,
            Attitude::Matrix => self.shape.matrix_size.pow(2),
            Attitude::Quaternion => 4,
        };
        self.shape.dim + attitude
    }

    /// The names of the parameters that vary, without the places of their numbers.
    pub fn varied(&self) -> Vec<String> {
        let name = |column: &String| column.split('[').next().unwrap_or_default().to_owned();
        let mut names: Vec<String> = self.parameters.iter().map(name).collect();
        names.sort();
        names.dedup();
        names
    }

    /// Their names, as `coadjoint learn` has them.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = (1..=self.shape.dim).map(|i| format!("mu_{i}")).collect();
        match self.attitude {
            Attitude::None => {}
            Attitude::Matrix => names.extend(matrix(self.shape.matrix_size)),
            Attitude::Quaternion => names.extend(QUATERNION.map(str::to_owned)),
        }
        names.extend(self.parameters.iter().cloned());
        names
    }

    /// The rotation that the columns of an attitude name.
    ///
    /// # Errors
    /// The defect.
    pub(super) fn read_rotation(&self, columns: &[f64]) -> Result<UnitQuaternion<f64>, String> {
        let quaternion = self.attitude == Attitude::Quaternion;
        match SO3::<f64>::new().element_of_columns(columns, quaternion) {
            (Some(g), distance) if distance <= TOLERANCE => Ok(g),
            (Some(_), distance) => Err(format!("the attitude is off the group by {distance:.1e}")),
            (None, _) => Err("the attitude is no element of the group".into()),
        }
    }

    /// Writes the element with this matrix, row by row, into the columns of an attitude.
    pub(super) fn write_attitude(&self, matrix: &[f64], columns: &mut [f64]) {
        match self.attitude {
            Attitude::None => {}
            Attitude::Matrix => columns.copy_from_slice(matrix),
            Attitude::Quaternion => {
                let rotation = SO3::<f64>::new().element_from_matrix(|i, j| matrix[3 * i + j]);
                // A matrix that is no rotation becomes NaN, which a check of rows tells.
                let wxyz = rotation.map_or([f64::NAN; 4], |q| [q.w, q.i, q.j, q.k]);
                columns.copy_from_slice(&wxyz);
            }
        }
    }

    /// The layout of a matrix without names, by its width.
    fn of_width(shape: Shape, width: usize) -> Result<Self, RunError> {
        let forms = [Attitude::None, Attitude::Matrix, Attitude::Quaternion];
        let layouts = forms.map(|attitude| Self { shape, attitude, parameters: Vec::new() });
        let possible = |l: &&Self| l.attitude != Attitude::Quaternion || shape.quaternions;
        let widths: Vec<String> =
            layouts.iter().filter(possible).map(|l| l.width().to_string()).collect();
        layouts.iter().filter(possible).find(|l| l.width() == width).cloned().ok_or_else(|| {
            RunError::Option(format!(
                "the array has {width} columns; this system needs {}: {} for the momentum alone, \
                 more with the attitude",
                widths.join(" or "),
                shape.dim
            ))
        })
    }
}

/// `g_11` … `g_dd`, or `g_1_1` … where one digit is not enough.
fn matrix(size: usize) -> Vec<String> {
    let separator = if size > 9 { "_" } else { "" };
    let places = (1..=size).flat_map(|i| (1..=size).map(move |j| (i, j)));
    places.map(|(i, j)| format!("g_{i}{separator}{j}")).collect()
}
