//! C99 for any compiler: numbers in decimals, coefficients where the header has them.

use std::collections::BTreeMap;

use coadjoint_program::Node;
use coadjoint_program::print::{C, Dialect};

use super::names::Names;

/// The dialect of headers.
#[derive(Clone, Debug)]
pub(crate) struct Portable {
    /// The header of C it is based on.
    c: C,
    /// The place of each coefficient that is read.
    places: BTreeMap<usize, usize>,
}

impl Portable {
    pub(crate) fn new(names: &Names, places: BTreeMap<usize, usize>) -> Self {
        let restrict = format!("{}_RESTRICT", names.upper);
        let c = C {
            head: "static inline void".into(),
            slots: format!("const double *{restrict}"),
            pointer: format!("*{restrict} "),
            functions: [&format!("{}_FMA", names.upper), "sqrt", "fabs", "rint", "ldexp", "ilogb"]
                .map(String::from),
            ..C::default()
        };
        Self { c, places }
    }
}

/// The shortest decimals that are read as this number.
pub(crate) fn decimal(value: f64) -> String {
    C::default().literal(value)
}

impl Dialect for Portable {
    fn c(&self) -> &C {
        &self.c
    }

    fn slot(&self, index: usize) -> String {
        format!("c[{}]", self.places.get(&index).copied().unwrap_or(0))
    }

    fn operation(&self, node: Node, operands: &[&str]) -> String {
        match (node, operands) {
            // Programs scale within the range of normal numbers, and ask for the exponents of such, where these are
            // the same.
            (Node::Scale(..), [a, k]) => format!("ldexp({a}, (int){k})"),
            (Node::Exponent(_), [a]) => format!("(double)ilogb({a})"),
            _ => self.c.operation(node, operands),
        }
    }
}
