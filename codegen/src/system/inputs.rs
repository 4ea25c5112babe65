//! The table `[inputs]`: functions of the time, given by their values.

use super::table::{Table, Value, span};
use crate::diagnostic::Span;
use crate::number::nearest_float;
use crate::signal::{Columns, Interpolation, Signal, SignalError};

const TIMES: &str = "times = [0, 1, 2, 3]";
const TABLE: &str = "table = \"wheels.csv\"";
const BREAKS: &str = "breaks = [0.5, 1.25]";
const HOLD: &str = "hold = \"previous\"";
const COLUMN: &str = "times = \"t\"";

/// The inputs of the text with their places, in place of which stand the `given` ones of the same names; then the other given
/// ones.
pub(super) fn read(root: &Table<'_>, given: &[Signal]) -> Vec<(Signal, Span)> {
    let mut found = of_text(root);
    for own in given {
        match found.iter_mut().find(|(signal, _)| signal.name == own.name) {
            Some((signal, _)) => *signal = own.clone(),
            None => found.push((own.clone(), Span::Whole)),
        }
    }
    found
}

/// The times `breaks`, at which functions of the time jump or bend, and where they are named.
pub(super) fn breaks(root: &Table<'_>) -> (Vec<f64>, Span) {
    let found = root.array("breaks", BREAKS).and_then(|(list, place)| {
        Some((root.numbers("breaks", list, BREAKS)?.iter().map(nearest_float).collect(), place))
    });
    found.unwrap_or((Vec::new(), Span::Whole))
}

/// Reads `times` and the values of each input, with the places of these; with `table`, the names of the columns that hold them. `hold` says
/// what inputs do between the times.
fn of_text(root: &Table<'_>) -> Vec<(Signal, Span)> {
    let Some(table) = root.table("inputs") else { return Vec::new() };
    let file = table.string("table", TABLE);
    let between = table.string("hold", HOLD).and_then(|(text, place)| {
        let known = text.parse::<Interpolation>();
        let wrong = || format!("`hold` is {text:?}: inputs are \"previous\", \"linear\" or \"spline\" between their times");
        known.map_err(|()| table.refuse(place, &wrong(), HOLD)).ok()
    });
    let between = between.unwrap_or_default();
    if !table.has("times") {
        table.missing("times", if table.has("table") { COLUMN } else { TIMES });
    }
    let of_file = |(file, _): (&str, Span), name: &str| {
        let (times, _) = table.string("times", COLUMN)?;
        let (values, _) = table.string(name, &format!("{name} = \"{name}\""))?;
        let [file, times, values] = [file, times, values].map(str::to_owned);
        Some(Signal::of_columns(name.to_owned(), Columns { file, times, values }, between))
    };
    let list = |key: &str, example: &str| -> Option<(Vec<f64>, Vec<&Value<'_>>, Span)> {
        let (list, whole) = table.array(key, example)?;
        let numbers = table.numbers(key, list.iter().copied(), example)?;
        Some((numbers.iter().map(nearest_float).collect(), list, whole))
    };
    let times = if table.has("table") { None } else { list("times", TIMES) };
    let listed = |name: &str| {
        let (values, own, whole) = list(name, &format!("{name} = [0, 0.5, 0.2, 0]"))?;
        let (times, of_times, all) = times.as_ref()?;
        let signal = Signal::new(name.to_owned(), times.clone(), values, between);
        let refuse = |error: SignalError| {
            let place = match error {
                SignalError::Lengths(..) => whole,
                SignalError::Short => *all,
                SignalError::Times(at, _) | SignalError::Close(_, at, _) => span(of_times[at]),
                SignalError::Value(_, at, _) => span(own[at]),
            };
            table.refuse(place, &error.to_string(), TIMES);
        };
        signal.map_err(refuse).ok()
    };
    let mut found = Vec::new();
    let own = |name: &str| !matches!(name, "times" | "table" | "hold");
    for (name, place, _) in table.entries().into_iter().filter(|(name, ..)| own(name)) {
        let signal = match (table.has("table"), file) {
            (true, file) => file.and_then(|file| of_file(file, name)),
            (false, _) => listed(name),
        };
        // The name of a wrong one is known all the same, so that its uses are no further mistakes.
        let stand_in = || Signal::new(name.to_owned(), vec![0.0, 1.0], vec![0.0; 2], between).ok();
        found.extend(signal.or_else(stand_in).map(|signal| (signal, place)));
    }
    if !table.entries().iter().any(|(name, ..)| own(name)) {
        table.refuse(table.span, "[inputs] has no input", "u = [0, 0.5, 0.2, 0]");
    }
    found
}
