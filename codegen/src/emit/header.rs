//! The documentation of a generated integrator.

use coadjoint_program::print::{Value, fill};
use coadjoint_program::quoting::rust_comment;
use coadjoint_program::schedule::Part;
use coadjoint_program::{Cost, Kernel};

use crate::drive::Drive;
use crate::emit::programs::step_operations;
use crate::emit::{Options, identifier};
use crate::integrator::{Coefficients, Integrator, Kicks};
use crate::lie::Chart;
use crate::problem::Problem;
use crate::smooth::{Facts, Smooth};
use crate::step::{Origin, Step};

/// Lines for a doc comment: source, group, method, operations of a step where it is printed.
pub(crate) fn lines(
    facts: Facts<'_>,
    method: &Method<'_>,
    integrator: Option<&Integrator>,
    step: Option<&Step>,
) -> Vec<String> {
    let operations = match step {
        Some(step) => {
            let all = step_operations(step);
            let again = step.kernel().programs.correct.cost().total();
            format!(" A step takes {all} operations, and {again} more for each further correction.")
        }
        None => {
            " A step is solved in loops over the coordinates, without programs of its own.".into()
        }
    };
    let mut lines = vec![
        format!(" Hamiltonian: `{}`", rust_comment(method.source)),
        String::new(),
        format!(" Group: {}. {}", rust_comment(facts.algebra.name()), method.about),
    ];
    lines.extend(integrator.map(terms));
    lines.push(operations);
    let comoving = integrator.is_some_and(|integrator| integrator.problem.comoving.is_some());
    lines.extend(comoving.then(|| " Comoving frame: S generates the motion in it.".to_owned()));
    lines
}

/// The terms of the series of each order.
fn terms(integrator: &Integrator) -> String {
    let orders = (1..=integrator.problem.truncation).step_by(2);
    let terms = orders.map(|k| format!("S{k}: {}", integrator.series.order(k).len()));
    format!(" Terms: {}.", terms.collect::<Vec<_>>().join(", "))
}

/// Paragraphs for the opening of a file: the system, how to use its step, the promises, the cost, how to read it.
pub(crate) fn opening(
    facts: Facts<'_>,
    method: &Method<'_>,
    kicks: Option<&Kicks>,
    options: &Options,
    step: Option<&Step>,
) -> Vec<String> {
    let arguments = facts.parameters.iter().map(|one| format!(", {}", identifier(&one.name)));
    let mut values = system(facts, kicks, method, rust_comment);
    values.extend([
        ("NAME", options.name.to_string()),
        ("PARAMETERS", arguments.collect()),
        ("NOW", when(method.moves, ", time")),
        ("COSTS", step.map_or_else(String::new, |step| costs(step.kernel()))),
    ]);
    paragraphs(&values)
}

/// The paragraphs of the opening of a file, which are lines of a template; a backslash joins a line and the next.
pub(crate) fn paragraphs(values: &[Value]) -> Vec<String> {
    let text = fill(include_str!("opening.in"), values).replace("\\\n", "");
    text.lines().map(str::to_owned).collect()
}

/// The most lines of a legend: no one looks more coefficients up.
const MOST_LINES: usize = 4001;

/// A line for each slot that holds a coefficient of S, `c[3] = 2 C(p₁ p₂²), of S₃ + S₅`, after one about them.
pub(crate) fn legend(coefficients: &Coefficients) -> Vec<String> {
    let about =
        "The coefficients of S = Σ C(m) m that programs read, C(m) being that of the monomial m:";
    let mut lines = vec![about.to_owned()];
    for (slot, &(base, scale)) in coefficients.slots().iter().enumerate() {
        let Some(factors) = coefficients.monomials().get(base) else { continue };
        let monomial: Vec<String> = factors
            .iter()
            .map(|&(coordinate, exponent)| {
                let power =
                    if exponent == 1 { String::new() } else { superscript(exponent as usize) };
                format!("p{}{power}", subscript(coordinate as usize + 1))
            })
            .collect();
        let mut orders: Vec<u32> =
            coefficients.bases()[base].iter().map(|term| term.step_power).collect();
        orders.dedup();
        let orders: Vec<String> =
            orders.iter().map(|&k| format!("S{}", subscript(k as usize))).collect();
        let scale = if scale == 1 { String::new() } else { format!("{scale} ") };
        lines.push(format!(
            "c[{slot}] = {scale}C({}), of {}",
            monomial.join(" "),
            orders.join(" + ")
        ));
    }
    if (2..=MOST_LINES).contains(&lines.len()) { lines } else { Vec::new() }
}

pub(crate) fn subscript(number: usize) -> String {
    let digit = |c: char| c.to_digit(10).and_then(|d| char::from_u32(0x2080 + d)).unwrap_or(c);
    number.to_string().chars().map(digit).collect()
}

pub(crate) fn superscript(number: usize) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or(c, |d| DIGITS[d as usize]);
    number.to_string().chars().map(digit).collect()
}

/// Paragraphs as lines of a comment, of at most `width` columns each after their mark; one that begins with a space stays a line.
pub(crate) fn comment(paragraphs: &[String], width: usize, mark: &str) -> String {
    let mut text = String::new();
    for paragraph in paragraphs {
        let mut line = String::new();
        for word in paragraph.split(' ') {
            let full = line.len() + word.len() > width && !line.is_empty();
            if full && !paragraph.starts_with(' ') {
                text.push_str(&format!("{mark}{line}\n"));
                line.clear();
            }
            line.push(' ');
            line.push_str(word);
        }
        text.push_str(&format!("{mark}{}\n", line.trim_end()));
    }
    text
}

/// The text where it holds.
pub(crate) fn when(holds: bool, text: &str) -> String {
    if holds { text.to_owned() } else { String::new() }
}

/// The method of a system, for its documentation.
pub(crate) struct Method<'a> {
    /// The Hamiltonian as the user wrote it.
    source: &'a str,
    /// A sentence or two.
    about: String,
    /// The power of the step that its error follows.
    error: String,
    /// True if the Hamiltonian depends on the time.
    pub moves: bool,
    /// True for a series.
    series: bool,
    /// The velocity and the torque beside the Hamiltonian.
    drive: Option<&'a Drive>,
}

impl<'a> Method<'a> {
    pub(crate) fn of_series(integrator: &'a Integrator) -> Self {
        let Problem { source, chart, truncation, .. } = &integrator.problem;
        let chart = match chart {
            Chart::Exponential => "exponential",
            Chart::Cayley => "Cayley",
        };
        let order = integrator.order();
        let about =
            format!("Chart: {chart}. Truncation K = {truncation}, order of accuracy {order}.");
        let error = "K+2".to_owned();
        Self { source, about, error, moves: false, series: true, drive: None }
    }

    pub(crate) fn of_collocation(smooth: &'a Smooth) -> Self {
        let nodes = smooth.nodes();
        let about = format!(
            "Collocation at {nodes} nodes in the exponential chart about the middle of a step, order of accuracy {}.",
            2 * nodes
        );
        let (error, moves) = ((2 * nodes + 1).to_string(), smooth.depends_on_time());
        let (source, drive) = (&smooth.source, smooth.drive.as_deref());
        Self { source, about, error, moves, series: false, drive }
    }

    /// The method of a system.
    pub(crate) fn of(origin: &'a Origin) -> Self {
        match origin {
            Origin::Series(integrator) => Self::of_series(integrator),
            Origin::Collocation(smooth) => Self::of_collocation(smooth),
        }
    }
}

/// The places of an opening about a system and a step of it; `quoted` makes a text fit for a comment.
pub(crate) fn system(
    facts: Facts<'_>,
    kicks: Option<&Kicks>,
    method: &Method<'_>,
    quoted: fn(&str) -> String,
) -> Vec<Value> {
    let Method { source, about, error, moves, series, drive } = method;
    let mut values = vec![
        ("VERSION", env!("CARGO_PKG_VERSION").to_owned()),
        ("SYSTEM", quoted(facts.name)),
        ("HAMILTONIAN", quoted(source)),
        ("GROUP", quoted(facts.algebra.name())),
        ("METHOD", about.clone()),
        ("ERROR", error.clone()),
        ("STEADY", (!moves).to_string()),
        ("SERIES", series.to_string()),
    ];
    if let Some(Kicks { kick, splitting, .. }) = kicks {
        let (name, flows, order) = (splitting.name(), splitting.flows().len(), splitting.order());
        let about = format!("{name}, {flows} flows between kicks, order of accuracy {order}");
        values.extend([("POTENTIAL", quoted(&kick.potential.source)), ("SPLITTING", about)]);
    }
    values.extend(drive.iter().map(|drive| ("DRIVE", quoted(&drive.source))));
    values
}

/// The cost of a step with one correction, and with as many as there may be.
pub(crate) fn costs(kernel: &Kernel) -> String {
    let flows = kernel.flows().unwrap_or(1) as usize;
    let step = |corrections: u32, checks: usize| {
        let of = |count: fn(&Cost) -> usize| -> usize {
            let cost = |&(part, _): &(Part, _)| {
                let times = match part {
                    Part::Correct => corrections as usize * flows,
                    Part::Kick => flows + 1,
                    Part::Frame | Part::Sound => checks,
                    Part::Guess | Part::Accept | Part::Transport => flows,
                };
                part.program(kernel).map_or(0, |program| times * count(&program.cost()))
            };
            Part::ALL.iter().map(cost).sum()
        };
        format!(
            "{} multiplications, {} additions, {} divisions and roots",
            of(|cost| cost.multiplications),
            of(|cost| cost.additions),
            of(|cost| cost.divisions)
        )
    };
    // Steps that go by those before them are solved in some sweeps, others most often in one correction.
    let (few, about) = match kernel.guesses_from_element() {
        true => (5, "5 corrections, as many have"),
        false => (1, "one correction, as most have"),
    };
    let (usual, corrections) = (step(few, 0), kernel.corrections);
    let most = step(corrections, 1);
    format!(
        "Cost of a step with {about}: {usual}.\nCost at most ({corrections} corrections, and a check of the state): {most}.\n"
    )
}
