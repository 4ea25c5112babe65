//! The run a system file describes: `[initial]`, `[run]` and the step or the tolerance.

use toml::Spanned;
use toml::de::DeValue;

use super::hamiltonian::copies;
use super::table::{Table, exact, matrix, nearest_float, span};
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::Arena;
use crate::lie::LieAlgebra;
use crate::parse::{Names, text};
use crate::tolerance::Region;

const MOMENTUM: &str = "momentum = [2.0, 0.5, 1.0]";
const ELEMENT: &str = "group_element = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]";

/// Where to start, how far and in which steps; `None` where the file does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// The step size h, finite and not zero.
    pub step: Option<f64>,
    /// The error asked for at the end, instead of a step size.
    pub tolerance: Option<f64>,
    /// Where the momentum stays, for `tolerance`.
    pub region: Option<Region>,
    /// The truncation, if the file gives one.
    pub truncation: Option<usize>,
    /// The duration T, finite and positive.
    pub time: Option<f64>,
    /// Every n-th step is recorded, n ≥ 1.
    pub every: Option<usize>,
    /// The body momentum μ at the start.
    pub momentum: Option<Vec<f64>>,
    /// The group element at the start, row by row; the identity if it is not given.
    pub group_element: Option<Vec<Vec<f64>>>,
}

/// Reads `[initial]`, `[run]`, and `step` of `[integrator]`.
pub(super) fn read(
    root: &Table<'_>,
    integrator: Option<&Table<'_>>,
    algebra: Option<&LieAlgebra>,
    diagnostics: &mut Diagnostics,
) -> Run {
    let mut run = Run::default();
    if let Some((step, place)) =
        integrator.and_then(|table| table.number("step", "step = 0.1", diagnostics))
    {
        let step = nearest_float(&step);
        if step == 0.0 || !step.is_finite() {
            refuse(place, "the step must be finite and other than zero", "step = 0.1", diagnostics);
        }
        run.step = Some(step);
    }
    if let Some(table) = integrator {
        super::tolerance::read(table, &mut run, diagnostics);
    }
    if let Some(table) = root.table("run", diagnostics) {
        table.check_keys(&["time", "every"], diagnostics);
        if let Some((time, place)) = table.number("time", "time = 100.0", diagnostics) {
            let time = nearest_float(&time);
            if time <= 0.0 || !time.is_finite() {
                refuse(place, "the time must be finite and positive", "time = 100.0", diagnostics);
            }
            run.time = Some(time);
        }
        if let Some((every, place)) = table.integer("every", "every = 1", diagnostics) {
            if every == 0 {
                refuse(place, "`every` counts steps from 1", "every = 1", diagnostics);
            }
            run.every = Some(every);
        }
    }
    if let Some(table) = root.table("initial", diagnostics) {
        table.check_keys(&["momentum", "group_element"], diagnostics);
        initial(&table, algebra, &mut run, diagnostics);
    }
    run
}

fn initial(
    table: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    run: &mut Run,
    diagnostics: &mut Diagnostics,
) {
    if let Some((list, place)) = table.array("momentum", MOMENTUM, diagnostics) {
        if let Some(copies) = algebra.and_then(|algebra| copies(algebra, list.len())) {
            run.momentum = copy_by_copy(&list, copies, diagnostics);
            return element(table, algebra, run, diagnostics);
        }
        let numbers: Option<Vec<_>> =
            list.iter().map(|value| exact("momentum", value, MOMENTUM, diagnostics)).collect();
        if let Some(algebra) = algebra
            && list.len() != algebra.dim()
        {
            let (name, dim) = (algebra.name().to_owned(), algebra.dim());
            diagnostics.report(place, Mistake::Dimension(list.len(), name, dim));
        }
        run.momentum = numbers.map(|list| list.iter().map(nearest_float).collect());
    }
    element(table, algebra, run, diagnostics);
}

/// The momentum of a power, given for one copy: numbers, or expressions in the copy's number i,
/// counted from 0, in floating point.
fn copy_by_copy(
    list: &[&Spanned<DeValue<'_>>],
    copies: usize,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let before = diagnostics.len();
    let mut columns = Vec::new();
    for value in list {
        let DeValue::String(text) = value.get_ref() else {
            let number = exact("momentum", value, MOMENTUM, diagnostics)?;
            columns.push(vec![nearest_float(&number); copies]);
            continue;
        };
        // After the opening quote.
        let offset = value.span().start + 1;
        let at = |i: usize| {
            let (names, mut arena) = (Names::default(), Arena::new());
            let index = [("i", i as i64)];
            let root = text::parse_with(text, offset, &index, &names, &mut arena, diagnostics);
            let number = (diagnostics.len() == before).then(|| arena.evaluate(root)).flatten();
            if diagnostics.len() == before && !number.is_some_and(f64::is_finite) {
                let message = format!("`{text}` has no finite value for i = {i}");
                refuse(
                    span(value),
                    &message,
                    "momentum = [\"cos(i)\", \"sin(i)\", 0]",
                    diagnostics,
                );
            }
            number
        };
        columns.push((0..copies).map_while(at).collect());
    }
    let whole = diagnostics.len() == before;
    whole.then(|| (0..copies).flat_map(|i| columns.iter().map(move |column| column[i])).collect())
}

fn element(
    table: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    run: &mut Run,
    diagnostics: &mut Diagnostics,
) {
    if let Some(value) = table.get("group_element")
        && let Some(rows) = matrix("group_element", value, ELEMENT, diagnostics)
    {
        // Elements are matrices of the basis's size, or adjoint matrices.
        let size = algebra.map(|algebra| match algebra.basis().and_then(<[_]>::first) {
            Some(first) => first.rows(),
            None => algebra.dim(),
        });
        let square = rows.iter().all(|row| row.len() == rows.len());
        if !square || size.is_some_and(|size| size != rows.len()) {
            let expected = size.map_or("a square matrix".to_owned(), |n| format!("{n} × {n}"));
            let message = format!("the group element must be {expected}");
            refuse(span(value), &message, ELEMENT, diagnostics);
        }
        let rows = rows.iter().map(|row| row.iter().map(nearest_float).collect());
        run.group_element = Some(rows.collect());
    }
}

pub(super) fn refuse(place: Span, what: &str, example: &str, diagnostics: &mut Diagnostics) {
    let help = Some(format!("write for example {example}"));
    diagnostics.report(place, Mistake::Other(what.to_owned(), help));
}
