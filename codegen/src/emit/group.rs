//! The runtime type of a problem's group.

use coadjoint_program::print::{Value, fill};
use coadjoint_program::quoting::rust_comment;
use num_traits::ToPrimitive;

use crate::emit::Options;
use crate::emit::program::float;
use crate::emit::table::list;
use crate::lie::{Chart, LieAlgebra, catalogue, watched_casimirs};
use crate::number::Rational;
use crate::step::Elements;

/// Groups the runtime has closed forms for, under the catalogue's name.
const CLOSED_FORMS: [&str; 4] = ["SO3", "SE3", "SU2", "SE2"];

/// Groups the runtime has tables for, under the catalogue's name.
pub const RUNTIME_TABLES: [&str; 8] =
    ["Aff1", "Heisenberg", "SE23", "SL2", "SO4", "SO5", "SU3", "Sp4"];

/// The type of a product of the runtime's closed forms and powers of them, by its name.
fn product(algebra: &LieAlgebra) -> Option<String> {
    let factors: Option<Vec<(String, usize)>> =
        algebra.name().split('*').map(|factor| power(factor.trim())).collect();
    let mut factors = factors?.into_iter().rev();
    let last = factors.next()?;
    let (ty, dim) = factors.fold(last, |(right, dim), (left, left_dim)| {
        let n = left_dim + dim;
        (format!("__krate::groups::Product<{left}, {right}, {n}>"), n)
    });
    (dim == algebra.dim()).then_some(ty)
}

/// The type and the dimension of `SO3` or `SO3^4`.
fn power(factor: &str) -> Option<(String, usize)> {
    let (base, copies) = match factor.split_once('^') {
        Some((base, copies)) => (base, copies.parse().ok().filter(|&copies: &usize| copies > 0)?),
        None => (factor, 1),
    };
    let base = CLOSED_FORMS.iter().find(|known| **known == base)?;
    let n = copies * catalogue::lookup(base).ok()?.dim();
    let one = format!("__krate::groups::{base}<T>");
    let power = || format!("__krate::groups::Power<{one}, {copies}, {n}>");
    Some((if copies == 1 { one.clone() } else { power() }, n))
}

/// The marker and the type of a group by its tables, and these.
fn own_tables(algebra: &LieAlgebra, options: &Options) -> [String; 2] {
    let number = |value: &Rational| value.to_f64().unwrap_or(f64::NAN);
    let structure = algebra.structure().iter().map(|c| (c.i, c.j, c.k, number(&c.value)));
    let basis = match algebra.basis() {
        Some(matrices) => {
            let entries = matrices.iter().enumerate().flat_map(|(i, matrix)| {
                let entry =
                    move |(row, column, value): (_, _, &Rational)| (i, row, column, number(value));
                matrix.entries().map(entry).filter(|entry| entry.3 != 0.0)
            });
            let entries = list(&entries.collect::<Vec<_>>());
            format!("::core::option::Option::Some(&[{entries}])")
        }
        None => "::core::option::Option::None".to_owned(),
    };
    // For large algebras these would be long tables, which only reports need.
    let watched = if algebra.dim() > 24 { Vec::new() } else { watched_casimirs(algebra) };
    let casimirs = watched.into_iter().map(|casimir| {
        let terms = casimir.terms().map(|(exponents, value)| {
            let powers = exponents.iter().enumerate().filter(|(_, power)| **power > 0);
            format!("({}, &{:?}), ", float(number(&value)), powers.collect::<Vec<_>>())
        });
        format!("&[{}], ", terms.collect::<String>())
    });
    let cayley = if Chart::Cayley.check(algebra).is_ok() { "1" } else { "" };
    let values = [
        ("NAME", rust_comment(algebra.name())),
        ("GROUP", format!("{}Group", options.name)),
        ("MARKER", format!("{}Algebra", options.name)),
        ("N", algebra.dim().to_string()),
        ("SIZE", algebra.matrix_size().to_string()),
        ("STRUCTURE", list(&structure.collect::<Vec<_>>())),
        ("BASIS", basis),
        ("CASIMIRS", casimirs.collect()),
        ("CAYLEY", cayley.to_owned()),
    ];
    [include_str!("group.in"), include_str!("tables.in")].map(|template| fill(template, &values))
}

/// The types that emitted items mention, and the items that define them.
pub(crate) struct Types {
    /// The dimension of the algebra.
    pub dim: usize,
    /// The group, over the scalar `T`.
    pub group: String,
    /// The numbers of its elements.
    pub elements: Elements,
    /// The chart.
    pub chart: &'static str,
    /// Vectors of the algebra or its dual, over the scalar `T`.
    pub vector: String,
    /// Square matrices of this dimension, over the scalar `T`.
    pub matrix: String,
    /// Items the group needs, to stand beside the struct, and its tables, to stand at the end.
    pub items: [String; 2],
}

impl Types {
    pub(crate) fn new(algebra: &LieAlgebra, chart: Chart, options: &Options) -> Self {
        let chart = match chart {
            Chart::Exponential => "__krate::groups::Exponential",
            Chart::Cayley => "__krate::groups::Cayley",
        };
        let (mut elements, mut items) = (Elements::ByFactors, [const { String::new() }; 2]);
        // An algebra of the user's own may have the name of one in the catalogue.
        let name = algebra.name();
        let known = catalogue::lookup(name).is_ok_and(|known| known == *algebra);
        let group = if known && CLOSED_FORMS.iter().chain(&RUNTIME_TABLES).any(|one| *one == name) {
            format!("__krate::groups::{name}<T>")
        } else {
            // Factors act on their own coordinates: far cheaper than one group of large matrices.
            match product(algebra).filter(|_| known) {
                Some(ty) => {
                    let about = format!("/// The group {}.", rust_comment(name));
                    let group = &options.name;
                    items[0] = format!("{about}\n__visibility type {group}Group<T = f64> = {ty};");
                }
                None => {
                    elements = Elements::Matrices;
                    items = own_tables(algebra, options);
                }
            }
            format!("{}Group<T>", options.name)
        };
        // In a block of their own; the struct may have either name.
        let alias = |plain: &str| match options.name == plain {
            true => format!("{plain}Of<T>"),
            false => format!("{plain}<T>"),
        };
        let [vector, matrix] = ["Vector", "Matrix"].map(alias);
        Self { dim: algebra.dim(), group, elements, chart, vector, matrix, items }
    }

    /// The types for templates, and the beginning of a block that uses them.
    pub(crate) fn values(&self) -> Vec<Value> {
        let [definition, tables] = self.items.clone();
        let mut values = vec![
            ("N", self.dim.to_string()),
            ("GROUP", self.group.clone()),
            ("CHART", self.chart.to_owned()),
            ("VECTOR", self.vector.clone()),
            ("MATRIX", self.matrix.clone()),
            ("DEFINITION", definition),
            ("TABLES", tables),
        ];
        values.push(("OPEN", fill(include_str!("block.in"), &values)));
        values
    }
}
