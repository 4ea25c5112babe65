//! Comparisons of our own: charts, orders, work, harder truths.

use coadjoint_draw::{Axis, Curve as Line, Panel, Style, unbeaten};
use coadjoint_learn::experiment::{Cell, Curve, Report};

use crate::section::{BODY, Section, curve, figure, places, points, values};

/// Errors below this are rounding.
const ROUNDING: f64 = 1e-16;

fn ours(report: &Report, id: &'static str, title: &str) -> Section {
    Section { of_paper: false, ..Section::of(report, id, title) }
}

/// A panel of errors over step sizes, a curve for each K whose column begins with `key`.
fn by_truncation(curve: &Curve, key: &str, heading: &str, most: f64) -> Panel {
    let lines = [1, 3, 5, 7, 9].into_iter().enumerate().filter_map(|(i, k)| {
        let all = points(curve, "h", &format!("{key}_{k}"));
        // Beyond, S no longer says anything; below, only rounding is seen.
        let mut points: Vec<(f64, f64)> =
            all.into_iter().filter(|point| point.1.is_finite() && point.1 <= most).collect();
        points.iter_mut().for_each(|point| point.1 = point.1.max(ROUNDING));
        let name = format!("K = {k}");
        (!points.is_empty()).then(|| Line::marked(name, Style::new(i), points))
    });
    Panel {
        heading: heading.to_owned(),
        across: "step size h (s)".to_owned(),
        curves: lines.collect(),
        ..Panel::default()
    }
}

/// The same axes for all panels.
fn alike(panels: Vec<Panel>) -> Vec<Panel> {
    let lines = || panels.iter().flat_map(|panel| panel.curves.iter().cloned());
    let lines: Vec<Line> = lines().collect();
    let x = Axis::logarithmic_around(&places(&lines), 1e-300, 6);
    let y = Axis::logarithmic_around(&values(&lines), 1e-300, 7);
    let with = |panel: Panel| Panel { x: x.clone(), y: y.clone(), ..panel }.with_legend();
    panels.into_iter().map(with).collect()
}

/// The charts beside each other, and the orders.
pub fn orders(report: &Report) -> Vec<Section> {
    let single = curve(report, "charts");
    let long = curve(report, "orders");
    let table = report.tables.first();
    let ratio = table
        .and_then(|table| {
            let wanted = [Cell::Number(7.0), Cell::Number(0.2)];
            table.rows.iter().find(|row| row[..2] == wanted)
        })
        .map(|row| [2, 3, 4].map(|i| row[i].shown()));
    let [cayley, exponential, ratio] = ratio.unwrap_or_else(|| ["–", "–", "–"].map(str::to_owned));
    let mut charts = ours(report, "charts", "Cayley against exponential, by K and step size");
    charts.settings =
        vec![BODY.to_owned(), "Π = (2, 0.5, 1), R = 1".to_owned(), "one step".to_owned()];
    charts.shows =
        "The paper uses Cayley’s chart. The error of one step in both charts, for K = 1 to 9."
            .to_owned();
    charts.out = format!(
        "The chart matters more than K: with K = 7 and h = 0.2 one step errs by {cayley} in Cayley’s chart and by \
         {exponential} in the exponential one, {ratio} times less. The exponential one is the default."
    );
    charts.panels = alike(vec![
        by_truncation(&single, "cayley", "error of one step, Cayley’s chart", 10.0),
        by_truncation(&single, "exp", "error of one step, exponential chart", 10.0),
    ]);
    charts.tables = table.cloned().into_iter().collect();

    let mut orders = ours(report, "orders", "Orders of accuracy");
    orders.settings = vec![
        format!("{BODY}, and a heavy top on SE(3)"),
        "T = 8 s".to_owned(),
        "error of momentum and attitude".to_owned(),
    ];
    orders.shows = "S is odd in t, so K = 1, 3, 5, 7, 9 have order K + 1: errors over a run fall with h to the power \
        2, 4, 6, 8, 10."
        .to_owned();
    orders.out = "They do, in both charts and on both groups, down to rounding; the table has the slopes measured.".to_owned();
    orders.panels = alike(vec![
        by_truncation(&long, "cayley", "error at T, rigid body, Cayley’s chart", 3.0),
        by_truncation(&long, "exp", "error at T, rigid body, exponential chart", 3.0),
        by_truncation(&long, "top", "error at T, heavy top, exponential chart", 3.0),
    ]);
    orders.tables = report.tables.get(1).cloned().into_iter().collect();
    vec![charts, orders]
}

/// Work against precision, counted.
pub fn work(report: &Report) -> Section {
    let mut section = ours(report, "work", "Work against precision, counted");
    section.settings =
        vec![BODY.to_owned(), "T = 20 s".to_owned(), "error of (R, Π) at T".to_owned()];
    section.shows = "Arithmetic operations for an error: ours, attitude and corrections included, beside RK45. They \
        are counted, not timed, so that the page is the same on every machine; times are below, where the benchmark \
        has been run."
        .to_owned();
    let table = report.tables.first();
    section.out = format!(
        "For an error of 1e-8: K = 7 in the exponential chart needs {} operations per second of motion, RK45 {}.",
        figure(table, "exp K=7", 3),
        figure(table, "RK45", 3),
    );
    let rows = curve(report, "work").rows;
    let names: Vec<String> =
        table.into_iter().flat_map(|table| &table.rows).map(|row| row[0].shown()).collect();
    let family = |at: usize| -> Vec<(f64, f64)> {
        let own = rows.iter().filter(|row| row[0] == at as f64);
        let points = own.map(|row| (row[2], row[3])).filter(|p| p.0.is_finite() && p.0 < 1.0);
        // Rounding gathers where steps are too small; nobody goes there.
        unbeaten(points.map(|p| (p.0.max(ROUNDING), p.1)).collect())
    };
    let panel = |heading: &str, prefix: &str| {
        let own = names.iter().enumerate();
        let own = own.filter(|(_, name)| name.starts_with(prefix) || name.starts_with("RK45"));
        let curves = own.enumerate().map(|(i, (at, name))| {
            Line::marked(name.replace('=', " = "), Style::new(i), family(at))
        });
        Panel {
            heading: heading.to_owned(),
            across: "error at T".to_owned(),
            curves: curves.collect(),
            ..Panel::default()
        }
    };
    section.panels = alike(vec![
        panel("operations per second of motion, exponential chart", "exp"),
        panel("operations per second of motion, Cayley’s chart", "Cayley"),
    ]);
    section.tables.clone_from(&report.tables);
    section
}

/// Truths that are no polynomials.
pub fn harder(report: &Report) -> Section {
    let mut section = ours(report, "harder-truths", "Harder truths");
    section.settings = vec!["exponential chart".to_owned(), "100 unseen points".to_owned()];
    section.shows = "The rigid body’s Hamiltonian is a polynomial, which favours polynomials. Other Hamiltonians: \
        quartic, a square root with a sine, a Gaussian bump, and the heavy top."
        .to_owned();
    section.out = "Where H is no polynomial, networks and Gaussian processes pass polynomials. S = Δt·H is knowledge \
        of the truth, not learning."
        .to_owned();
    section.tables.clone_from(&report.tables);
    section
}
