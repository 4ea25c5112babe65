//! The figure of the simulation: energy, momentum, difference.

use coadjoint_draw::curves::{peaks as peaks_of, range, thinned};
use coadjoint_draw::{Axis, Curve as Line, Panel, Style};
use coadjoint_learn::experiment::{Curve, Report};

use crate::section::{BODY, Section, curve, figure, peaks, values};

/// The lowest decade of errors, and the lowest top of an axis.
const FLOOR: (i32, i32) = (-17, -14);
/// Stretches of time of a whole run, longer than an oscillation.
const STRETCHES: usize = 60;
/// Records of the panels that show oscillations.
const BEGINNING: usize = 251;

/// The panels of energy, momentum and difference.
pub fn sections(report: &Report) -> Vec<Section> {
    let runs = curve(report, "simulation");
    let momentum = curve(report, "simulation-momentum");
    let times = runs.column("t");
    let end = times.last().copied().unwrap_or(0.0);
    let settings = vec![
        BODY.to_owned(),
        "Π = (2, 0.5, 1), R = 1".to_owned(),
        "h = 0.2 s".to_owned(),
        format!("T = {end} s"),
    ];
    let silent = "The paper gives no start, step, duration, chart or tolerance. The start here is that of its section \
        on geometrizing; both charts are shown; RK45 has the tolerances of common libraries when none are set \
        (relative 1e-3, absolute 1e-6), and finer ones."
        .to_owned();
    let table = report.tables.first();
    let of = |row: &str, column: usize| figure(table, row, column);

    let mut energy = Section::of(report, "energy", "Energy for K = 3, 5 and 7");
    energy.shows = "The Hamiltonian along runs with K = 3, 5 and 7: it oscillates around its first value for every K, \
        the less the higher K."
        .to_owned();
    energy.out = format!(
        "So it does. Largest |H − H₀| in Cayley’s chart {}, {} and {} for K = 3, 5 and 7; in the exponential chart \
         {}, {} and {}: the chart decides more than K.",
        of("Cayley K=3", 1),
        of("Cayley K=5", 1),
        of("Cayley K=7", 1),
        of("exp K=3", 1),
        of("exp K=5", 1),
        of("exp K=7", 1),
    );
    energy.panels = energies(&runs);
    energy.tables = report.tables.clone();

    let mut seven = Section::of(report, "energy-7", "Energy for K = 7 alone");
    seven.shows =
        "The Hamiltonian of K = 7 alone, “a very good energy preservation”, without figures."
            .to_owned();
    seven.out = format!(
        "It oscillates with an amplitude that does not grow: at most {} (Cayley) and {} (exponential) over {} steps.",
        of("Cayley K=7", 1),
        of("exp K=7", 1),
        times.len().saturating_sub(1)
    );
    seven.panels = sevens(&runs);

    let mut spatial = Section::of(report, "momentum", "Spatial momentum in three components");
    spatial.shows =
        "The three components of J_L: constant up to numerical error with the paper’s integrator, \
        oscillating with RK45, “quite rough at some points”."
            .to_owned();
    spatial.out = format!(
        "Ours keeps all three to {} over the whole run, RK45 at its default tolerances errs by {}, at finer ones by \
         {}. Left and right have the same ranges.",
        of("exp K=7", 2),
        of("RK45 default", 2),
        of("RK45 fine", 2),
    );
    spatial.panels = momenta(&runs, &momentum);

    let mut difference = Section::of(report, "difference", "Difference over time");
    difference.shows = "The difference between the geometric integrator and RK45: small at first; eventually RK45 \
        “blows up”, while the geometric integrators go on."
        .to_owned();
    difference.out = format!(
        "Distances of (R, Π) from the exact flow at the end: {} (K = 7, exponential), {} (K = 7, Cayley), {} (RK45, \
         default tolerances), {} (finer). RK45 leaves the group and the energy; it does not overflow here.",
        of("exp K=7", 4),
        of("Cayley K=7", 4),
        of("RK45 default", 4),
        of("RK45 fine", 4),
    );
    difference.panels = differences(&runs);

    let mut sections = vec![energy, seven, spatial, difference];
    for section in &mut sections {
        section.settings.clone_from(&settings);
    }
    for section in &mut sections[1..] {
        section.silent = "As in the first figure.".to_owned();
    }
    sections[0].silent = silent;
    sections
}

fn time(runs: &Curve) -> Axis {
    let end = runs.column("t").last().copied().unwrap_or(1.0);
    Axis::linear(0.0, end, 6)
}

fn energies(runs: &Curve) -> Vec<Panel> {
    let mut first = Vec::new();
    let mut errors = Vec::new();
    for (key, name) in [("cayley", "Cayley’s chart"), ("exp", "exponential chart")] {
        let (mut signed, mut sizes) = (Vec::new(), Vec::new());
        for (i, k) in [3, 5, 7].into_iter().enumerate() {
            let column = format!("{key}_k{k}_energy");
            let (times, values) = (runs.column("t"), runs.column(&column));
            let some = BEGINNING.min(times.len());
            let points = times[..some].iter().copied().zip(values.iter().copied()).collect();
            signed.push(Line::line(format!("K = {k}"), Style::new(i), points));
            sizes.push(peaks(runs, "t", &column, &format!("K = {k}"), i));
        }
        first.push((name, signed));
        errors.push((name, sizes));
    }
    let all: Vec<f64> = first.iter().flat_map(|(_, lines)| values(lines)).collect();
    let y = Axis::around(&all, true, 5);
    let end = first[0].1[0].points.last().map_or(1.0, |point| point.0);
    let mut panels: Vec<Panel> = first
        .into_iter()
        .map(|(name, curves)| Panel {
            heading: format!("H − H₀ (J), {name}"),
            across: "time (s), the beginning".to_owned(),
            x: Axis::linear(0.0, end, 6),
            y: y.clone(),
            curves,
            ..Panel::default()
        })
        .collect();
    let all: Vec<f64> = errors.iter().flat_map(|(_, lines)| values(lines)).collect();
    let y = Axis::floored(&all, FLOOR, 6);
    panels.extend(errors.into_iter().map(|(name, curves)| Panel {
        heading: format!("|H − H₀| (J), {name}"),
        across: "time (s)".to_owned(),
        x: time(runs),
        y: y.clone(),
        curves,
        ..Panel::default()
    }));
    panels.into_iter().map(Panel::with_legend).collect()
}

/// The beginning, and the least and the greatest value in each stretch of the whole run.
fn sevens(runs: &Curve) -> Vec<Panel> {
    let times = runs.column("t");
    let (mut first, mut whole) = (Vec::new(), Vec::new());
    for (column, name) in [("cayley_k7_energy", "Cayley"), ("exp_k7_energy", "exponential")] {
        let values = runs.column(column);
        let y = Axis::around(&values, true, 5);
        let some = BEGINNING.min(times.len());
        let points = times.iter().copied().zip(values.iter().copied()).take(some).collect();
        first.push(Panel {
            heading: format!("H − H₀ (J), K = 7, {name}"),
            across: "time (s), the beginning".to_owned(),
            x: Axis::linear(0.0, times.get(some.saturating_sub(1)).copied().unwrap_or(1.0), 6),
            y: y.clone(),
            curves: vec![Line::line("K = 7", Style::new(0), points)],
            ..Panel::default()
        });
        let low: Vec<f64> = values.iter().map(|value| -value).collect();
        let least = peaks_of(&times, &low, STRETCHES).into_iter().map(|(t, v)| (t, -v));
        whole.push(Panel {
            heading: format!("the same, greatest and least, {name}"),
            across: "time (s)".to_owned(),
            x: time(runs),
            y,
            curves: vec![
                Line::line("greatest", Style::new(0), peaks_of(&times, &values, STRETCHES)),
                Line::line("least", Style::new(1), least.collect()),
            ],
            ..Panel::default()
        });
    }
    first.into_iter().chain(whole.into_iter().map(Panel::with_legend)).collect()
}

fn momenta(runs: &Curve, momentum: &Curve) -> Vec<Panel> {
    let components = |key: &str| -> Vec<Line> {
        ["x", "y", "z"]
            .into_iter()
            .enumerate()
            .map(|(i, component)| {
                let mut column = momentum.column(&format!("{key}_{component}"));
                let first = column.first().copied().unwrap_or(0.0);
                column.iter_mut().for_each(|value| *value -= first);
                let points = thinned(&momentum.column("t"), &column, 220);
                Line::line(format!("J {component}"), Style::new(i), points)
            })
            .collect()
    };
    let sides = [
        ("J − J(0) (kg m²/s), K = 7, exponential", components("exp_k7")),
        ("J − J(0) (kg m²/s), RK45, default tolerances", components("rk45_default")),
    ];
    let all: Vec<f64> = sides.iter().flat_map(|(_, lines)| values(lines)).collect();
    let y = Axis::around(&all, true, 6);
    let mut panels: Vec<Panel> = sides
        .into_iter()
        .map(|(heading, curves)| Panel {
            heading: heading.to_owned(),
            across: "time (s)".to_owned(),
            x: time(runs),
            y: y.clone(),
            curves,
            ..Panel::default()
        })
        .collect();
    let sides = [
        (
            "largest error of a component of J (kg m²/s), ours",
            vec![
                ("cayley_k3_momentum", "K = 3, Cayley"),
                ("cayley_k7_momentum", "K = 7, Cayley"),
                ("exp_k7_momentum", "K = 7, exponential"),
            ],
        ),
        (
            "largest error of a component of J (kg m²/s), RK45",
            vec![
                ("rk45_default_momentum", "default tolerances"),
                ("rk45_fine_momentum", "1e-6 and 1e-9"),
            ],
        ),
    ];
    let sides = sides.map(|(heading, columns)| {
        let lines: Vec<Line> = columns
            .into_iter()
            .enumerate()
            .map(|(i, (column, name))| peaks(runs, "t", column, name, i))
            .collect();
        (heading, lines)
    });
    let all: Vec<f64> = sides.iter().flat_map(|(_, lines)| values(lines)).collect();
    let y = Axis::floored(&all, FLOOR, 6);
    panels.extend(sides.into_iter().map(|(heading, curves)| Panel {
        heading: heading.to_owned(),
        across: "time (s)".to_owned(),
        x: time(runs),
        y: y.clone(),
        curves,
        ..Panel::default()
    }));
    panels.into_iter().map(Panel::with_legend).collect()
}

fn differences(runs: &Curve) -> Vec<Panel> {
    let lines = |columns: &[(&str, &str)]| -> Vec<Line> {
        let line = |(i, (key, name)): (usize, &(&str, &str))| {
            peaks(runs, "t", &format!("{key}_distance"), name, i)
        };
        columns.iter().enumerate().map(line).collect()
    };
    let sides = [
        (
            "distance from the exact flow, Cayley’s chart",
            lines(&[("cayley_k3", "K = 3"), ("cayley_k5", "K = 5"), ("cayley_k7", "K = 7")]),
        ),
        (
            "distance from the exact flow, exponential chart",
            lines(&[("exp_k3", "K = 3"), ("exp_k5", "K = 5"), ("exp_k7", "K = 7")]),
        ),
        (
            "distance from the exact flow, RK45 and ours",
            lines(&[
                ("rk45_default", "RK45, default"),
                ("rk45_fine", "RK45, 1e-6 and 1e-9"),
                ("exp_k7", "K = 7, exponential"),
            ]),
        ),
    ];
    let all: Vec<f64> = sides.iter().flat_map(|(_, lines)| values(lines)).collect();
    let (low, high) = range(all.iter().filter(|v| **v > 0.0)).unwrap_or((1e-12, 1.0));
    let y = Axis::logarithmic(low / 2.0, high * 2.0, 6);
    let panel = |(heading, curves): (&str, Vec<Line>)| Panel {
        heading: heading.to_owned(),
        across: "time (s)".to_owned(),
        x: time(runs),
        y: y.clone(),
        curves,
        ..Panel::default()
    };
    sides.into_iter().map(panel).map(Panel::with_legend).collect()
}
