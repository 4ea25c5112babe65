//! Which columns a row of states has, in files as in memory.

use crate::error::CliError;

/// How a row gives the attitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attitude {
    /// Not at all: momenta only.
    None,
    /// The matrix of the group element, row by row.
    Matrix,
    /// A unit quaternion w, x, y, z.
    Quaternion,
}

/// What a group can say in a row.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// n, coordinates of the momentum.
    pub dim: usize,
    /// d, the size of the matrix of a group element.
    pub matrix_size: usize,
    /// Whether a unit quaternion names an element.
    pub quaternions: bool,
}

/// The columns of a row: `mu_1` … `mu_n`, then the attitude.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Of the group.
    pub shape: Shape,
    /// What stands after the momentum.
    pub attitude: Attitude,
}

impl Layout {
    /// The number of columns.
    pub fn width(&self) -> usize {
        let attitude = match self.attitude {
            Attitude::None => 0,
            Attitude::Matrix => self.shape.matrix_size.pow(2),
            Attitude::Quaternion => 4,
        };
        self.shape.dim + attitude
    }

    /// Their names, as `coadjoint learn` has them.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = (1..=self.shape.dim).map(|i| format!("mu_{i}")).collect();
        match self.attitude {
            Attitude::None => {}
            Attitude::Matrix => names.extend(matrix(self.shape.matrix_size)),
            Attitude::Quaternion => names.extend(["w", "x", "y", "z"].map(|x| format!("q_{x}"))),
        }
        names
    }

    /// The layout of a file with named columns, and for each of its columns the number in the
    /// file. Other columns are left alone.
    pub fn find(shape: Shape, header: &[String]) -> Result<(Self, Vec<usize>), CliError> {
        let has = |name: &str| header.iter().any(|h| h == name);
        let first = matrix(shape.matrix_size).into_iter().next().unwrap_or_default();
        let attitude = if has(&first) {
            Attitude::Matrix
        } else if has("q_w") {
            Attitude::Quaternion
        } else {
            Attitude::None
        };
        if attitude == Attitude::Quaternion && !shape.quaternions {
            return Err(CliError::Option(format!(
                "columns q_w … q_z: elements of this group are no quaternions; give the attitude \
                 as a {d}×{d} matrix, {first} …",
                d = shape.matrix_size
            )));
        }
        let layout = Self { shape, attitude };
        let place = |name: String| {
            header.iter().position(|h| *h == name).ok_or_else(|| {
                CliError::Option(format!(
                    "column {name} is missing: this system needs {}; the file has {}",
                    layout.names().join(", "),
                    header.join(", ")
                ))
            })
        };
        let places = layout.names().into_iter().map(place).collect::<Result<_, _>>()?;
        Ok((layout, places))
    }

    /// The layout of a matrix without names, by its width.
    pub fn of_width(shape: Shape, width: usize) -> Result<Self, CliError> {
        let forms = [Attitude::None, Attitude::Matrix, Attitude::Quaternion];
        let layouts = forms.map(|attitude| Self { shape, attitude });
        let possible = |l: &&Self| l.attitude != Attitude::Quaternion || shape.quaternions;
        let widths: Vec<String> =
            layouts.iter().filter(possible).map(|l| l.width().to_string()).collect();
        layouts.iter().filter(possible).find(|l| l.width() == width).copied().ok_or_else(|| {
            CliError::Option(format!(
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
