//! The key `damping`: the diagonal of Γ in the double bracket.

use super::initial::coordinates;
use super::table::{Table, span};
use crate::lie::LieAlgebra;
use crate::number::nearest_float;

const EXAMPLE: &str = "damping = \"1/100\"";

/// Reads `damping`: a number, or a list of one for each coordinate. None where all of them are 0.
pub(super) fn read(root: &Table<'_>, algebra: Option<&LieAlgebra>) -> Option<Vec<f64>> {
    let value = root.get("damping")?;
    if let (Some(potential), true) = (root.get("potential"), root.has("torque")) {
        let message = "`damping` is not for a system with a potential and a torque: it is not known which energy falls";
        root.diagnostics.report_other(span(potential), message, "leave one of the three out");
    }
    let numbers = match value.get_ref().as_array() {
        Some(_) => coordinates(root, "damping", EXAMPLE, algebra)?.0,
        None => vec![root.exact("damping", value, EXAMPLE)?; algebra?.dim()],
    };
    let rates: Vec<f64> = numbers.iter().map(nearest_float).collect();
    if rates.iter().any(|rate| *rate < 0.0) {
        let what = "`damping` must not be negative: the energy would rise";
        root.refuse(span(value), what, EXAMPLE);
        return None;
    }
    rates.iter().any(|rate| *rate > 0.0).then_some(rates)
}
