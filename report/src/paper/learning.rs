//! Learning with symmetry: training, trajectories, table 1, noise, the error under reduction, the Hamiltonian.

use coadjoint_draw::{Axis, Curve as Line, Panel, Style};
use coadjoint_learn::experiment::{Curve, Report};

use crate::section::{BODY, Section, curve, figure, over_time, peaks, places, points, values};

/// Training with and without symmetry, and learned trajectories.
pub fn trained(report: &Report) -> Vec<Section> {
    vec![training(report), trajectory(report)]
}

fn training(report: &Report) -> Section {
    let history = curve(report, "training");
    let steps = history.column("step").last().copied().unwrap_or(0.0) + 10.0;
    let table = report.tables.first();
    let mut section = Section::of(report, "training", "Training with and without symmetry");
    section.settings = vec![BODY.to_owned(), "Cayley’s chart".to_owned(), "Δt = 0.1 s".to_owned()];
    let samples = table.and_then(|table| table.title.split(", ").nth(2)?.split(" in ").next());
    section.settings.extend(samples.map(str::to_owned));
    section.shows = "Mean squared errors while two networks train, one with symmetry and one without: the one with \
        symmetry starts closer and falls faster, and predicts new data better."
        .to_owned();
    section.silent = "The paper does not say which loss it plots, nor whether inputs are normalised. Here losses are \
        in units of the variance of the data, so that both begin near 1."
        .to_owned();
    section.out = format!(
        "After {steps} steps of Adam the loss on unseen data is {} with symmetry and {} without.",
        figure(table, "with symmetry", 3),
        figure(table, "without", 3),
    );
    let lines = |columns: [(&str, &str); 2]| -> Vec<Line> {
        let line = |(i, (column, name)): (usize, (&str, &str))| {
            Line::line(name, Style::new(i), points(&history, "step", column))
        };
        columns.into_iter().enumerate().map(line).collect()
    };
    let sides = [
        ("loss on the data", lines([("train", "with symmetry"), ("train_type_two", "without")])),
        ("loss on unseen data", lines([("test", "with symmetry"), ("test_type_two", "without")])),
    ];
    let all: Vec<f64> = sides.iter().flat_map(|(_, lines)| values(lines)).collect();
    let y = Axis::logarithmic_around(&all, 1e-12, 6);
    section.panels = sides
        .into_iter()
        .map(|(heading, curves)| {
            let panel = Panel {
                heading: format!("{heading} (share of its variance)"),
                across: "steps of Adam".to_owned(),
                x: Axis::linear(0.0, steps, 6),
                y: y.clone(),
                curves,
                ..Panel::default()
            };
            panel.with_legend()
        })
        .collect();
    section.tables = report.tables.iter().take(1).cloned().collect();
    section
}

fn trajectory(report: &Report) -> Section {
    let run = curve(report, "trajectory");
    let table = report.tables.get(1);
    let mut section = Section::of(report, "trajectory", "A learned trajectory");
    section.settings =
        vec![BODY.to_owned(), "Π = (2, 0.5, 1), R = 1".to_owned(), "Δt = 0.1 s".to_owned()];
    section.shows = "A trajectory of the trained model, its energy like that of a symplectic integrator, and its \
        momentum, conserved up to round-off."
        .to_owned();
    section.silent = "The paper gives no start and no length. A motion of this body leaves the octant [0, 6]³ from \
        which the paper draws its samples, so the models here saw [−3, 3]³."
        .to_owned();
    section.out = format!(
        "Learned with symmetry: J_L to {}, energy to {} (relative) over the whole run. Without symmetry: J_L off by \
         {}, energy by {}, {} steps made before its map had no solution or the run ended.",
        figure(table, "with symmetry", 3),
        figure(table, "with symmetry", 2),
        figure(table, "without", 3),
        figure(table, "without", 2),
        figure(table, "without", 1),
    );
    let end = run.column("t").last().copied().unwrap_or(1.0);
    let panel = |heading: &str, quantity: &str, floor: (i32, i32)| {
        let curves: Vec<Line> = [("symmetric", "with symmetry"), ("type_two", "without")]
            .into_iter()
            .enumerate()
            .map(|(i, (key, name))| peaks(&run, "t", &format!("{key}_{quantity}"), name, i))
            .collect();
        over_time(heading, end, curves, floor)
    };
    section.panels = vec![
        panel("relative error of the energy", "energy", (-10, -2)),
        panel("largest error of a component of J (kg m²/s)", "momentum", (-17, -2)),
        panel("distance of (R, Π) from the exact flow", "distance", (-6, 1)),
    ];
    section.tables = report.tables.iter().skip(1).cloned().collect();
    section
}

/// Table 1.
pub fn table_one(report: &Report) -> Section {
    let mut section = Section::of(report, "table-1", "Table 1: with and without symmetry");
    section.settings =
        vec![BODY.to_owned(), "100 unseen points".to_owned(), "Cayley’s chart".to_owned()];
    section.shows = "Mean squared errors on 100 unseen points for four steps and sizes of data: with symmetry 0.0024, \
        0.0012, 0.0042 and 0.0002; without 0.0202, 0.0063, 0.0429 and 0.0482. Largest errors: 1.06, 0.71, 1.05 and \
        0.48; without 1.45, 1.12, 2.09 and 4.65."
        .to_owned();
    section.silent = "Which error is meant is not said, nor its units; the last column repeats the paper’s figure \
        beside ours. Ours are over samples and coordinates: x is the increment in the chart, momentum μ″, group the \
        matrix of R. Largest errors stand beside; norms of the gradient say nothing of the map and are left out."
        .to_owned();
    let title = "dt = 0.1, 500 samples";
    let table = report.tables.iter().find(|table| table.title.starts_with(title));
    let table = table.or(report.tables.first());
    section.out = format!(
        "Symmetry wins in every cell, by more than in the paper, and a polynomial of degree 6 fitted in milliseconds \
         beats every network. In {}: network {} in μ″ with symmetry, {} without; polynomial of degree 6 in the \
         exponential chart {}.",
        table.map_or("–", |table| table.title.split(", momenta").next().unwrap_or_default()),
        figure(table, "network, symmetric", 2),
        figure(table, "type II, not symmetric: network", 2),
        figure(table, "polynomial degree 6, exp", 2),
    );
    section.tables.clone_from(&report.tables);
    section
}

/// Noise.
pub fn noise(report: &Report) -> Section {
    let mut section = Section::of(report, "noise", "Robustness against noise");
    section.settings = vec![
        BODY.to_owned(),
        "Δt = 0.15 s".to_owned(),
        "exponential chart".to_owned(),
        "noise of variance 0.05".to_owned(),
    ];
    section.shows = "Losses over 250 steps of Adam, trained with and without noise of variance 0.05: in spite of the \
        noise unseen data are predicted well (left); the loss on noisy data stops falling (right), because no \
        symplectic, equivariant map fits noise."
        .to_owned();
    section.silent = "How noise is added to attitudes is not said; here as R·exp(η), so that they stay rotations. \
        The mean squared error is that of the increment x, coordinates weighted by the width of their data."
        .to_owned();
    let noisy = report.tables.get(1);
    section.out = format!(
        "So it is. Trained on noise, the network errs on noise-free data by {} in μ″ (no model at all: {}), the best \
         polynomial by cross-validation by {}.",
        figure(noisy, "network", 2),
        figure(noisy, "x = 0", 2),
        figure(noisy, "cross-validated", 2),
    );
    let curves = [curve(report, "noise_without_noise"), curve(report, "noise_with_noise")];
    let side = |column: &str| -> Vec<Line> {
        let names = ["trained without noise", "trained with noise"];
        let line = |(i, (curve, name)): (usize, (&Curve, &str))| {
            Line::line(name, Style::new(i), points(curve, "step", column))
        };
        curves.iter().zip(names).enumerate().map(line).collect()
    };
    let sides = [
        ("on unseen, noise-free data", side("test_mse")),
        ("on the training data", side("train_mse")),
    ];
    let all: Vec<f64> = sides.iter().flat_map(|(_, lines)| values(lines)).collect();
    let end = curves[0].column("step").last().copied().unwrap_or(1.0);
    let y = Axis::logarithmic_around(&all, 1e-12, 6);
    section.panels = sides
        .into_iter()
        .map(|(heading, curves)| {
            let panel = Panel {
                heading: format!("mse of x (rad²) {heading}"),
                across: "steps of Adam".to_owned(),
                x: Axis::linear(0.0, end, 6),
                y: y.clone(),
                curves,
                ..Panel::default()
            };
            panel.with_legend()
        })
        .collect();
    section.tables.clone_from(&report.tables);
    section
}

/// The proposition on errors under reduction.
pub fn reduction_error(report: &Report) -> Section {
    let mut section = Section::of(report, "reduction-error", "Errors under reduction");
    section.settings = vec!["T*SO(3) in ℝ⁹ × ℝ⁹".to_owned(), "random pairs".to_owned()];
    section.shows = "A proposition without a figure: reduced data are perturbed linearly in the error of the data, as \
        long as the momentum is bounded."
        .to_owned();
    section.silent = "The estimates are printed with e₂′ where their proof has e₁″, and e₂′ for e₁′; the bounds here \
        are |e₁′| + |e₁″| for the increment and |α″| |e₁′| + |e₂″| for the covector."
        .to_owned();
    section.out =
        "Both errors have slope 1 over six decades and never exceed their bounds.".to_owned();
    let errors = curve(report, "reduction-error");
    let lines: Vec<Line> = [("group_error", "g′⁻¹g″"), ("covector_error", "g′⁻¹α″")]
        .into_iter()
        .enumerate()
        .map(|(i, (column, name))| {
            Line::marked(name, Style::new(i), points(&errors, "size", column))
        })
        .collect();
    let panel = Panel {
        heading: "mean error of the reduced data".to_owned(),
        across: "size of the perturbation".to_owned(),
        x: Axis::logarithmic_around(&places(&lines), 1e-300, 7),
        y: Axis::logarithmic_around(&values(&lines), 1e-300, 7),
        curves: lines,
        ..Panel::default()
    };
    section.panels = vec![panel.with_legend()];
    section.tables.clone_from(&report.tables);
    section
}

/// The remark on learning the Hamiltonian.
pub fn hamiltonian(report: &Report) -> Section {
    let mut section = Section::of(report, "hamiltonian", "Learning the Hamiltonian (remark)");
    section.settings = vec![BODY.to_owned(), "exponential chart".to_owned()];
    section.shows =
        "A remark without a figure: from reduced data the reduced Hamiltonian can be learned by a \
        Lie–Poisson variational integrator."
            .to_owned();
    section.silent = "No figures are given.".to_owned();
    section.out = "The integrator behind the remark is of second order, so the Hamiltonian found is the true one up \
        to O(Δt²): the slope below is 2, for both degrees."
        .to_owned();
    let errors = curve(report, "hamiltonian");
    let lines: Vec<Line> = [2.0, 4.0]
        .into_iter()
        .enumerate()
        .map(|(i, degree)| {
            let rows = errors.rows.iter().filter(|row| row[0] == degree);
            let points = rows.map(|row| (row[1], row[2])).collect();
            Line::marked(format!("polynomial of degree {degree}"), Style::new(i), points)
        })
        .collect();
    let panel = Panel {
        heading: "rms of ∂H − ∂H of the truth (1/s)".to_owned(),
        across: "Δt (s)".to_owned(),
        x: Axis::logarithmic_around(&places(&lines), 1e-300, 7),
        y: Axis::logarithmic_around(&values(&lines), 1e-300, 6),
        curves: lines,
        ..Panel::default()
    };
    section.panels = vec![panel.with_legend()];
    section.tables.clone_from(&report.tables);
    section
}
