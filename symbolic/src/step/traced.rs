//! Formulas that write the nodes of a graph as they run.

use std::ops::{Add, Div, Mul, Neg, Sub};

use coadjoint_geometry::number::Number;

use crate::graph::{Graph, Id};
use crate::step::vector::Matrix;

/// A number that is known, which needs no graph, or a node of a graph.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Traced<'g> {
    Constant(f64),
    Node(&'g Graph, Id),
}

use Traced::{Constant, Node};

/// The first N nodes of a list, as numbers.
pub(crate) fn traced<'g, const N: usize>(graph: &'g Graph, list: &[Id]) -> [Traced<'g>; N] {
    std::array::from_fn(|i| Traced::new(graph, list[i]))
}

/// The nodes of numbers.
pub(crate) fn nodes<const N: usize>(graph: &Graph, list: [Traced<'_>; N]) -> Vec<Id> {
    list.into_iter().map(|number| number.id(graph)).collect()
}

/// The nodes of a matrix, given row by row.
pub(crate) fn matrix<const R: usize, const C: usize>(
    graph: &Graph,
    rows: [[Traced<'_>; C]; R],
) -> Matrix {
    Matrix::new(R, C, |i, j| rows[i][j].id(graph))
}

impl<'g> Traced<'g> {
    /// The number of a node.
    fn new(graph: &'g Graph, id: Id) -> Self {
        graph.known_number(id).map_or(Node(graph, id), Constant)
    }

    /// The node of the number.
    pub(crate) fn id(self, graph: &Graph) -> Id {
        match self {
            Constant(value) => graph.constant(value),
            Node(_, id) => id,
        }
    }

    /// The value of a function: by `fold` where all numbers are known, else as the node that `write` makes.
    fn make<const N: usize>(
        list: [Self; N],
        fold: impl Fn([f64; N]) -> f64,
        write: impl Fn(&Graph, [Id; N]) -> Id,
    ) -> Self {
        let graph = list.iter().find_map(|number| match number {
            Node(graph, _) => Some(*graph),
            Constant(_) => None,
        });
        match graph {
            Some(graph) => Self::new(graph, write(graph, list.map(|number| number.id(graph)))),
            None => Constant(fold(list.map(|number| match number {
                Constant(value) => value,
                Node(..) => f64::NAN,
            }))),
        }
    }
}

/// Operations by the function of the graph of this name, and for known numbers by a value.
macro_rules! operations {
    ($($name:ident($($number:ident),*) = $value:expr;)*) => {$(
        fn $name(self $(, $number: Self)*) -> Self {
            let fold = |[s $(, $number)*]: [f64; _]| ($value)(s $(, $number)*);
            let write = |graph: &Graph, [s $(, $number)*]: [Id; _]| graph.$name(s $(, $number)*);
            Self::make([self $(, $number)*], fold, write)
        }
    )*};
}

macro_rules! operators {
    ($($operator:ident $name:ident($($number:ident)?);)*) => {$(
        impl $operator for Traced<'_> {
            type Output = Self;

            operations! { $name($($number)?) = $operator::$name; }
        }
    )*};
}

operators! { Add add(b); Sub sub(b); Mul mul(b); Div div(b); Neg neg(); }

impl Number for Traced<'_> {
    operations! {
        times_plus(a, b) = f64::mul_add;
        abs() = f64::abs;
        sqrt() = f64::sqrt;
        round() = f64::round_ties_even;
    }

    fn of(value: f64) -> Self {
        Constant(value)
    }

    fn at_most(self, other: Self, then: Self, otherwise: Self) -> Self {
        let fold = |[a, b, then, otherwise]: [f64; 4]| if a <= b { then } else { otherwise };
        let write = |graph: &Graph, [a, b, c, d]: [Id; 4]| graph.select(a, b, c, d);
        Self::make([self, other, then, otherwise], fold, write)
    }
}
