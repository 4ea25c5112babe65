//! The values of a function's variables while it is read.

use std::rc::Rc;

use super::function::Callable;
use crate::expr::ExprId;

/// A value of the function's world.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// An `f64`.
    Number(ExprId),
    /// An integer, known.
    Integer(i128),
    /// A truth value, known.
    Bool(bool),
    /// An array, a tuple or an iterator.
    List(Vec<Value>),
    /// A vector of nalgebra.
    Vector(Vec<Value>),
    /// A matrix of nalgebra, row by row.
    Matrix { rows: usize, columns: usize, entries: Vec<Value> },
    /// A closure or a function of the body.
    Function(Rc<Callable>),
    /// `()`.
    Unit,
    /// Something wrong that has been reported.
    Wrong,
}

impl Value {
    /// A description for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Integer(_) => "an integer",
            Self::Bool(_) => "a truth value",
            Self::List(_) => "an array",
            Self::Vector(_) => "a vector",
            Self::Matrix { .. } => "a matrix",
            Self::Function(_) => "a function",
            Self::Unit => "nothing",
            Self::Wrong => "a mistake",
        }
    }

    /// The entry named by an index, or the length where there is none such.
    pub(super) fn entry(&self, index: &[usize]) -> Result<&Value, usize> {
        match (self, index) {
            (Self::List(list) | Self::Vector(list), [i] | [i, 0]) => list.get(*i).ok_or(list.len()),
            (Self::Matrix { rows, columns, entries }, [i, j]) => {
                if i < rows && j < columns {
                    entries.get(i * columns + j).ok_or(entries.len())
                } else {
                    Err(if i < rows { *columns } else { *rows })
                }
            }
            // nalgebra counts a matrix column by column.
            (Self::Matrix { rows, columns, entries }, [k]) if *rows > 0 => {
                entries.get((k % rows) * columns + k / rows).ok_or(entries.len())
            }
            _ => Err(0),
        }
    }

    /// As [`Value::entry`], for assignment.
    pub(super) fn entry_mut(&mut self, index: &[usize]) -> Option<&mut Value> {
        match self {
            Self::List(list) | Self::Vector(list) => match index {
                [i] | [i, 0] => list.get_mut(*i),
                _ => None,
            },
            Self::Matrix { rows, columns, entries } => match index {
                [i, j] if i < rows && j < columns => entries.get_mut(*i * *columns + *j),
                [k] if *rows > 0 => entries.get_mut((*k % *rows) * *columns + *k / *rows),
                _ => None,
            },
            _ => None,
        }
    }
}
