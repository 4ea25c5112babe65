//! Poisson maps from momenta: table 2, trajectories, geometrizing, Hamilton–Jacobi by least squares.

use coadjoint_draw::{Axis, Curve as Line, Panel, Style};
use coadjoint_learn::experiment::{Cell, Report};

use crate::section::{BODY, Section, curve, figure, over_time, peaks, places, values};

/// Records of a short time.
const LONGER: usize = 101;

/// Table 2 and its trajectories.
pub fn sections(report: &Report) -> Vec<Section> {
    vec![table_two(report), trajectories(report)]
}

fn table_two(report: &Report) -> Section {
    let mut section = Section::of(report, "table-2", "Table 2: Poisson maps from momenta alone");
    section.settings =
        vec![BODY.to_owned(), "100 unseen points".to_owned(), "exponential chart".to_owned()];
    section.shows = "Mean squared and largest errors of a network 50-10 whose canonical momenta are unknowns of the \
        fit, for three steps and two sizes of data: 0.013, 0.0003, 0.055, 0.0006, 0.043 and 0.0008."
        .to_owned();
    section.silent = "The box of the samples is not stated; ours is [−1, 1]³. The row “paper” repeats its figures."
        .to_owned();
    let neural = report
        .tables
        .iter()
        .flat_map(|table| &table.rows)
        .any(|row| matches!(&row[0], Cell::Text(name) if name.starts_with("latent p")));
    let last = report.tables.last();
    section.out = format!(
        "With p eliminated by Newton’s method a polynomial of degree 4 errs by {} (Δt = 1, 200 samples; the paper: \
         {}). {}",
        figure(last, "p eliminated, degree 4", 1),
        figure(last, "paper", 1),
        if neural {
            "The paper’s own way, p latent with a network 50-10, is in the rows below."
        } else {
            "The paper’s own way, p latent with a network, is behind the feature neural, without which this command \
             was built: its rows say so in place of a number."
        }
    );
    section.tables.clone_from(&report.tables);
    section
}

fn trajectories(report: &Report) -> Section {
    let run = curve(report, "poisson");
    let times = run.column("t");
    let end = times.last().copied().unwrap_or(1.0);
    let models: Vec<(&str, &str)> = [
        ("degree_2", "learned, degree 2"),
        ("degree_4", "learned, degree 4"),
        ("latent", "learned, latent p, network 50-10"),
    ]
    .into_iter()
    .filter(|(key, _)| run.columns.iter().any(|column| *column == format!("{key}_energy")))
    .collect();
    let mut section = Section::of(report, "poisson", "Learned Poisson trajectories");
    section.settings = vec![
        BODY.to_owned(),
        "Π = (0.7, 0.2, 0.5)".to_owned(),
        "Δt = 1 s, 200 samples".to_owned(),
        format!("{} steps", times.len().saturating_sub(1)),
    ];
    section.shows = "Energy of the original and the learned model over a short and a long time: both stay; the \
        difference of the momenta, bounded even over a long time; the Casimir, conserved to rounding."
        .to_owned();
    section.silent = "Start, step and length are not given; the step here is the longest of table 2, where learning \
        has most to do."
        .to_owned();
    let largest = |column: &str| run.column(column).into_iter().map(f64::abs).fold(0.0, f64::max);
    section.out = format!(
        "Relative errors of the energy at most {} (degree 2) and {} (degree 4), of the Casimir {}; the momenta differ \
         by at most {} (degree 4).",
        Cell::from(largest("degree_2_energy")).shown(),
        Cell::from(largest("degree_4_energy")).shown(),
        Cell::from(largest("degree_4_casimir")).shown(),
        Cell::from(largest("degree_4_distance")).shown(),
    );
    // Momentum, the beginning: the truth as a line, the learned one as markers.
    let some = 41.min(times.len());
    let mut curves = Vec::new();
    for (i, component) in ["x", "y", "z"].into_iter().enumerate() {
        let of = |key: &str| -> Vec<(f64, f64)> {
            let column = run.column(&format!("{key}_{component}"));
            times.iter().copied().zip(column).take(some).collect()
        };
        curves.push(Line::line(format!("Π {component}, exact"), Style::new(i), of("exact")));
        curves.push(Line::points(format!("Π {component}, learned"), Style::new(i), of("degree_4")));
    }
    let beginning = Panel {
        heading: "momentum (kg m²/s), learned: degree 4".to_owned(),
        across: "time (s), the beginning".to_owned(),
        x: Axis::linear(0.0, times.get(some.saturating_sub(1)).copied().unwrap_or(1.0), 6),
        y: Axis::around(&values(&curves), true, 5),
        curves,
        ..Panel::default()
    };
    let energy = {
        let line = |(i, (key, name)): (usize, &(&str, &str))| {
            let column = run.column(&format!("{key}_energy"));
            let points = times.iter().copied().zip(column).take(LONGER).collect();
            Line::line(*name, Style::new(i), points)
        };
        let curves: Vec<Line> = models.iter().enumerate().map(line).collect();
        Panel {
            heading: "relative error of the energy, a short time".to_owned(),
            across: "time (s), the beginning".to_owned(),
            x: Axis::around(&places(&curves), true, 6),
            y: Axis::around(&values(&curves), true, 5),
            curves,
            ..Panel::default()
        }
    };
    let panel = |heading: &str, quantity: &str, floor: (i32, i32)| {
        let lines = models.iter().enumerate();
        let lines =
            lines.map(|(i, (key, name))| peaks(&run, "t", &format!("{key}_{quantity}"), name, i));
        let curves: Vec<Line> = lines.collect();
        Panel {
            heading: heading.to_owned(),
            across: "time (s)".to_owned(),
            x: Axis::linear(0.0, end, 6),
            y: Axis::floored(&values(&curves), floor, 6),
            curves,
            ..Panel::default()
        }
    };
    section.panels = [
        beginning,
        energy,
        panel("relative error of the energy, a long time", "energy", (-10, -4)),
        panel("distance of the momenta (kg m²/s)", "distance", (-10, -1)),
        panel("relative drift of the Casimir |Π|²", "casimir", (-17, -13)),
    ]
    .into_iter()
    .map(Panel::with_legend)
    .collect();
    section
}

/// Geometrizing forward Euler.
pub fn geometrize(report: &Report) -> Section {
    let run = curve(report, "geometrize");
    let end = run.column("t").last().copied().unwrap_or(1.0);
    let table = report.tables.first();
    let degrees: Vec<String> = (2..=6)
        .map(|degree| format!("geometrized_{degree}"))
        .filter(|key| run.columns.iter().any(|column| *column == format!("{key}_energy")))
        .collect();
    let mut section = Section::of(report, "geometrize", "Geometrizing forward Euler");
    section.settings = vec![
        BODY.to_owned(),
        "Π = (2, 0.5, 1)".to_owned(),
        "h = 0.1 s".to_owned(),
        "exponential chart".to_owned(),
    ];
    section.shows = "Forward Euler and the Poisson map learned from 1000 of its steps, from (2, 0.5, 1): energy, \
        distance from the true motion, Casimir, the last to round-off."
        .to_owned();
    section.silent = "Step, length and the box of the samples are not given; the model of the paper is a network, ours \
        a polynomial with p eliminated."
        .to_owned();
    let best = degrees.last().map_or("geometrized", String::as_str);
    section.out = format!(
        "Relative drifts: Casimir {} (Euler) and {} (geometrized), energy {} and {}; largest distance from the true \
         motion {} and {}.",
        figure(table, "euler", 2),
        figure(table, best, 2),
        figure(table, "euler", 3),
        figure(table, best, 3),
        figure(table, "euler", 4),
        figure(table, best, 4),
    );
    let shown: Vec<(String, String)> =
        std::iter::once(("euler".to_owned(), "forward Euler".to_owned()))
            .chain(degrees.iter().map(|key| {
                let degree = key.trim_start_matches("geometrized_");
                (key.clone(), format!("geometrized, degree {degree}"))
            }))
            .collect();
    let panel = |heading: &str, quantity: &str, floor: (i32, i32)| {
        let lines = shown.iter().enumerate();
        let curves: Vec<Line> = lines
            .map(|(i, (key, name))| peaks(&run, "t", &format!("{key}_{quantity}"), name, i))
            .collect();
        over_time(heading, end, curves, floor)
    };
    section.panels = vec![
        panel("relative error of the energy", "energy", (-6, 1)),
        panel("distance from the true motion (kg m²/s)", "distance", (-4, 1)),
        panel("relative drift of the Casimir |Π|²", "casimir", (-17, 1)),
    ];
    section.tables.clone_from(&report.tables);
    section
}

/// The Hamilton–Jacobi equation by least squares.
pub fn hamilton_jacobi(report: &Report) -> Section {
    let mut section = Section::of(report, "hamilton-jacobi", "Hamilton–Jacobi by least squares");
    section.settings =
        vec![BODY.to_owned(), "p in [−1, 1]³".to_owned(), "t in (0, 0.5)".to_owned()];
    section.shows = "A proposal without a figure: the residual of the reduced Hamilton–Jacobi equation at sampled \
        (t, p), minimised, in place of a series in t."
        .to_owned();
    section.silent = "The equation is printed with the sign that generates the flow backwards; ours has ∂S/∂t = + H. \
        No model is named: S here is a polynomial in p times odd powers of t."
        .to_owned();
    section.out = "With the same powers of t the fit over the whole box and time errs somewhat less than the \
        expansion at t = 0."
        .to_owned();
    let residuals = curve(report, "hamilton-jacobi");
    let mut lines = Vec::new();
    for (i, degree) in [2.0, 4.0, 6.0, 8.0].into_iter().enumerate() {
        let rows = residuals.rows.iter().filter(|row| row[0] == degree);
        let points: Vec<(f64, f64)> = rows.map(|row| (row[1], row[2])).collect();
        if !points.is_empty() {
            lines.push(Line::marked(format!("degree {degree}"), Style::new(i), points));
        }
    }
    let history = Panel {
        heading: "mean square of the residual (J²)".to_owned(),
        across: "iterations of Gauss and Newton".to_owned(),
        x: Axis::around(&places(&lines), true, 5),
        y: Axis::logarithmic_around(&values(&lines), 1e-300, 6),
        curves: lines,
        ..Panel::default()
    };
    let rows = report.tables.first().map(|table| table.rows.clone()).unwrap_or_default();
    let column = |at: usize| -> Vec<(f64, f64)> {
        let number = |cell: &Cell| match cell {
            Cell::Number(value) => *value,
            Cell::Text(_) => f64::NAN,
        };
        rows.iter().map(|row| (number(&row[0]), number(&row[at]))).collect()
    };
    let lines = vec![
        Line::marked("least squares", Style::new(0), column(4)),
        Line::marked("series, the same powers of t", Style::new(1), column(5)),
    ];
    let errors = Panel {
        heading: "rms error of the map at t = 0.5 (kg m²/s)".to_owned(),
        across: "degree of S in p".to_owned(),
        x: Axis::around(&places(&lines), false, 3),
        y: Axis::logarithmic_around(&values(&lines), 1e-300, 6),
        curves: lines,
        ..Panel::default()
    };
    section.panels = vec![errors.with_legend(), history.with_legend()];
    section.tables.clone_from(&report.tables);
    section
}
