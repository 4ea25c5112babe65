//! Which columns a row of states has, in files as in memory.

use crate::error::RunError;

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
    /// file. Other columns are not looked at.
    pub fn find(shape: Shape, header: &[String]) -> Result<(Self, Vec<usize>), RunError> {
        let any = |attitude| {
            let names = Self { shape, attitude }.names();
            names.into_iter().skip(shape.dim).find(|name| header.contains(name))
        };
        let first = matrix(shape.matrix_size).into_iter().next().unwrap_or_default();
        let quaternion =
            ["q_w", "q_x", "q_y", "q_z"].into_iter().find(|q| header.iter().any(|h| h == q));
        let attitude = match (any(Attitude::Matrix), quaternion) {
            (Some(g), Some(q)) => {
                return Err(RunError::Option(format!(
                    "columns {g} and {q} both give the attitude: keep either g_… or q_w, q_x, q_y, q_z"
                )));
            }
            (Some(_), None) => Attitude::Matrix,
            (None, Some(_)) => Attitude::Quaternion,
            (None, None) => Attitude::None,
        };
        if attitude == Attitude::Quaternion && !shape.quaternions {
            return Err(RunError::Option(format!(
                "columns q_w … q_z: elements of this group are no quaternions; give the attitude \
                 as a {d}×{d} matrix, {first} …",
                d = shape.matrix_size
            )));
        }
        for (column, name) in header.iter().enumerate() {
            let index = name.strip_prefix("mu_").and_then(|index| index.parse::<usize>().ok());
            if index.is_some_and(|index| index == 0 || index > shape.dim) {
                return Err(RunError::Option(format!(
                    "column {name}: the momentum of this system has the coordinates mu_1 … mu_{}; \
                     take it out or give it another name",
                    shape.dim
                )));
            }
            let ours = Self { shape, attitude }.names().contains(name);
            if let Some(before) = header[..column].iter().position(|h| ours && h == name) {
                return Err(RunError::Option(format!(
                    "column {name} is there twice, in row 1 as cells {} and {}: keep one",
                    before + 1,
                    column + 1
                )));
            }
        }
        let layout = Self { shape, attitude };
        let place = |name: String| {
            header.iter().position(|h| *h == name).ok_or_else(|| {
                RunError::Option(format!(
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
    pub fn of_width(shape: Shape, width: usize) -> Result<Self, RunError> {
        let forms = [Attitude::None, Attitude::Matrix, Attitude::Quaternion];
        let layouts = forms.map(|attitude| Self { shape, attitude });
        let possible = |l: &&Self| l.attitude != Attitude::Quaternion || shape.quaternions;
        let widths: Vec<String> =
            layouts.iter().filter(possible).map(|l| l.width().to_string()).collect();
        layouts.iter().filter(possible).find(|l| l.width() == width).copied().ok_or_else(|| {
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
