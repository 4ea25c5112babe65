//! `tolerance` and `region` of `[integrator]`.

use toml::de::DeValue;

use super::table::{Table, matrix, nearest_float, refuse, wrong_kind};
use crate::diagnostic::Diagnostics;
use crate::tolerance::Region;

const TOLERANCE: &str = "tolerance = 1e-9";
const REGION: &str = "region = 2.5";

/// Reads them.
pub(super) fn read(
    table: &Table<'_>,
    diagnostics: &mut Diagnostics,
) -> (Option<f64>, Option<Region>) {
    (tolerance(table, diagnostics), region(table, diagnostics))
}

fn tolerance(table: &Table<'_>, diagnostics: &mut Diagnostics) -> Option<f64> {
    let (tolerance, place) = table.number("tolerance", TOLERANCE, diagnostics)?;
    let tolerance = nearest_float(&tolerance);
    if !(1e-14..=1e-1).contains(&tolerance) {
        let what = "the tolerance must lie between 1e-14 and 1e-1";
        refuse(place, what, TOLERANCE, diagnostics);
    }
    if table.has("step") {
        let what = "a tolerance picks the step: keep one of `tolerance` and `step`";
        refuse(place, what, TOLERANCE, diagnostics);
    }
    Some(tolerance)
}

fn region(table: &Table<'_>, diagnostics: &mut Diagnostics) -> Option<Region> {
    let value = table.get("region")?;
    let place = super::table::span(value);
    if !table.has("tolerance") {
        let what = "`region` says where a tolerance is to hold, and there is none";
        refuse(place, what, TOLERANCE, diagnostics);
    }
    match value.get_ref() {
        DeValue::Array(_) => {
            let rows = matrix("region", value, REGION, table.constants, diagnostics)?;
            let bounds: Option<Vec<[f64; 2]>> = rows
                .iter()
                .map(|row| match row.as_slice() {
                    [low, high] => Some([nearest_float(low), nearest_float(high)]),
                    _ => None,
                })
                .collect();
            if bounds.is_none() {
                let expected = "a radius, or [low, high] for each coordinate";
                wrong_kind("region", expected, value, REGION, diagnostics);
            }
            bounds.map(Region::Box)
        }
        _ => {
            let radius = table.number("region", REGION, diagnostics);
            radius.map(|(radius, _)| Region::Ball(nearest_float(&radius)))
        }
    }
}
