//! The opening of emitted code in every language: the system, its equations, the cost of a step.

use coadjoint_program::{Cost, Kernel, Program};

use crate::integrator::{Integrator, Kicks};
use crate::lie::Chart;

/// The lines of a paragraph, at most `width` columns each; a line that begins with a space stays as it is.
pub(crate) fn wrapped(paragraph: &str, width: usize) -> Vec<String> {
    if paragraph.starts_with(' ') {
        return vec![paragraph.to_owned()];
    }
    let mut lines = vec![String::new()];
    for word in paragraph.split(' ') {
        let line = lines.last().map_or(0, String::len);
        if line > 0 && line + 1 + word.len() > width {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

/// Paragraphs about the system and a step of it; `quoted` makes a text fit for a comment.
pub(crate) fn system(integrator: &Integrator, quoted: fn(&str) -> String) -> Vec<String> {
    let problem = &integrator.problem;
    let chart = match problem.chart {
        Chart::Exponential => "exponential",
        Chart::Cayley => "Cayley",
    };
    let mut list = vec![
        format!("Hamiltonian: {}", quoted(&problem.source)),
        format!(
            "Group: {}. Chart: {}. Truncation K = {}, order of accuracy {}.",
            quoted(problem.algebra.name()),
            chart,
            problem.truncation,
            integrator.order()
        ),
    ];
    let mut map = MAP.to_owned();
    if let Some(Kicks { kick, splitting, .. }) = &integrator.kicks {
        list.push(format!("Potential: {}", quoted(&kick.potential.source)));
        let (name, flows, order) = (splitting.name(), splitting.flows().len(), splitting.order());
        list.push(format!(
            "Splitting: {name}, {flows} flows between kicks, order of accuracy {order}."
        ));
        map.push_str(KICKED);
    }
    list.extend([String::new(), map, String::new()]);
    list
}

/// The paragraph about a step.
const MAP: &str = "The map. With the body momentum mu and the group element g, the equations of motion are dmu/dt = \
         ad*_(dH/dmu) mu and dg/dt = g dH/dmu (left trivialisation: g takes body coordinates to space). A step of size h \
         is a symplectic map near their flow; it makes an error of order h^(K+2). The spatial momentum Ad*_g mu and every \
         Casimir are conserved to rounding, step after step, and the energy stays near its first value for all times.";

/// The same where kicks are between flows.
const KICKED: &str = " This describes the flows. Between them the torque -g^-1 dV(g) of the potential kicks mu; of the spatial \
         momentum and the Casimirs, only those remain conserved that the potential leaves invariant, and the order of accuracy \
         is the lesser of both.";

/// The cost of a step with one correction, and with as many as there may be.
pub(crate) fn costs(kernel: &Kernel) -> [String; 2] {
    let programs = kernel.programs();
    let [guess, correct, accept, transport, sound] = [
        &programs.guess,
        &programs.correct,
        &programs.accept,
        &programs.transport,
        &programs.sound,
    ]
    .map(Program::cost);
    let frame = programs.frame.as_ref().map_or(Cost::default(), Program::cost);
    let corrections = kernel.corrections();
    let flows = kernel.flows().unwrap_or(1) as usize;
    let kicks = kernel.kick().map_or((0, Cost::default()), |kick| (flows + 1, kick.cost()));
    let step = |corrections: u32| {
        let times = corrections as usize * flows;
        [(flows, guess), (times, correct), (flows, accept), (flows, transport), kicks]
    };
    let usual = sum(&step(1));
    let most = sum(&[&step(corrections)[..], &[(1, sound), (1, frame)]].concat());
    [
        format!("Cost of a step with one correction, as most have: {usual}."),
        format!("Cost at most ({corrections} corrections, and a check of the state): {most}."),
    ]
}

/// The cost of programs that are evaluated a number of times.
fn sum(programs: &[(usize, Cost)]) -> String {
    let of = |count: fn(&Cost) -> usize| -> usize {
        programs.iter().map(|(times, cost)| times * count(cost)).sum()
    };
    format!(
        "{} multiplications, {} additions, {} divisions and roots",
        of(|cost| cost.multiplications),
        of(|cost| cost.additions),
        of(|cost| cost.divisions)
    )
}
