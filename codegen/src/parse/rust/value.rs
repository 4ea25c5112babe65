//! The values of a function's variables while it is read.

use std::rc::Rc;

use super::function::Callable;
use crate::expr::ExprId;

/// A value of the function's world. Copies of lists and matrices share their entries.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// An `f64`.
    Number(ExprId),
    /// An integer, known.
    Integer(i128),
    /// A truth value, known.
    Bool(bool),
    /// An array, a tuple or an iterator.
    List(Rc<Vec<Value>>),
    /// A matrix of nalgebra; one of a single column is a vector.
    Matrix(Matrix),
    /// A closure or a function of the body.
    Function(Rc<Callable>),
    /// `()`.
    Unit,
    /// Something wrong that has been reported.
    Wrong,
}

/// A matrix of nalgebra, row by row.
#[derive(Clone, Debug)]
pub(super) struct Matrix {
    pub rows: usize,
    pub columns: usize,
    pub entries: Rc<Vec<Value>>,
}

impl Matrix {
    pub(super) fn new(rows: usize, columns: usize, entries: impl Iterator<Item = Value>) -> Self {
        Self { rows, columns, entries: Rc::new(entries.collect()) }
    }

    pub(super) fn vector(entries: &[Value]) -> Self {
        Self::new(entries.len(), 1, entries.iter().cloned())
    }

    pub(super) fn shape(&self) -> (usize, usize) {
        (self.rows, self.columns)
    }

    /// The matrix of the same shape with these entries.
    pub(super) fn with(&self, entries: impl Iterator<Item = Value>) -> Self {
        Self::new(self.rows, self.columns, entries)
    }

    pub(super) fn transposed(&self) -> Self {
        let entry =
            |at: usize| self.entries[at % self.rows * self.columns + at / self.rows].clone();
        Self::new(self.columns, self.rows, (0..self.entries.len()).map(entry))
    }
}

impl Value {
    pub(super) fn list(entries: impl IntoIterator<Item = Value>) -> Self {
        Self::List(Rc::new(entries.into_iter().collect()))
    }

    /// A description for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Integer(_) => "an integer",
            Self::Bool(_) => "a truth value",
            Self::List(_) => "an array",
            Self::Matrix(Matrix { columns: 1, .. }) => "a vector",
            Self::Matrix(_) => "a matrix",
            Self::Function(_) => "a function",
            Self::Unit => "nothing",
            Self::Wrong => "a mistake",
        }
    }

    /// The entries in the order in which Rust iterates over them: those of a matrix column by column.
    pub(super) fn iterated(&self) -> Option<Rc<Vec<Value>>> {
        match self {
            Self::List(list) => Some(list.clone()),
            Self::Matrix(matrix) => Some(matrix.transposed().entries),
            _ => None,
        }
    }

    /// The place of the entry named by an index, or the length where there is none such.
    fn position(&self, index: &[usize]) -> Result<usize, usize> {
        let below = |i: usize, length: usize| if i < length { Ok(i) } else { Err(length) };
        match (self, index) {
            (Self::List(list), &[i]) => below(i, list.len()),
            (Self::Matrix(Matrix { rows, columns, .. }), &[i, j]) => {
                Ok(below(i, *rows)? * columns + below(j, *columns)?)
            }
            // nalgebra counts a matrix column by column.
            (Self::Matrix(Matrix { rows, columns, .. }), &[k]) => {
                let k = below(k, rows * columns)?;
                Ok(k % rows * columns + k / rows)
            }
            _ => Err(0),
        }
    }

    /// The entry named by an index, or the length where there is none such.
    pub(super) fn entry(&self, index: &[usize]) -> Result<Value, usize> {
        let at = self.position(index)?;
        match self {
            Self::List(entries) | Self::Matrix(Matrix { entries, .. }) => Ok(entries[at].clone()),
            _ => Err(0),
        }
    }

    /// As [`Value::entry`], for assignment.
    pub(super) fn entry_mut(&mut self, index: &[usize]) -> Result<&mut Value, usize> {
        let at = self.position(index)?;
        match self {
            Self::List(entries) | Self::Matrix(Matrix { entries, .. }) => {
                Ok(&mut Rc::make_mut(entries)[at])
            }
            _ => Err(0),
        }
    }
}
