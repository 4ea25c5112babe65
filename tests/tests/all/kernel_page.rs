//! The kernel that ARCHITECTURE.md walks through, with its numbers.

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::Step;
use coadjoint_codegen::system::{Options, read as read_system};
use coadjoint_program::Program;

use coadjoint_tests::sources::read;

/// Numbers, short enough for a page.
fn shown(values: &[f64]) -> String {
    let shown = |value: &f64| match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{value:.0e}"),
        _ => format!("{value:.4}"),
    };
    values.iter().map(shown).collect::<Vec<_>>().join(" ")
}

/// One step of the body of `examples/rigid_body.toml`, program by program, is printed as the page has it.
#[test]
fn the_step_of_the_map_is_made_by_its_programs() {
    let system = read_system(&read("examples/rigid_body.toml"), Options::default()).unwrap();
    let integrator = Integrator::build(system.problem, TermLimit::default()).unwrap();
    let step = Step::build(&integrator).unwrap();
    let (kernel, slots) = (step.kernel(), step.fold(0.1, &[]).unwrap());
    let mut lines = Vec::new();
    let mut call = |name: &str, program: &Program, inputs: &[f64]| {
        let outputs = program.run(inputs, &slots);
        let (from, to) = (inputs.len(), outputs.len());
        lines.push(format!(
            "{name:<9} {:>3} operations  {from:>2} -> {to:<2}  {{}}",
            program.operations()
        ));
        outputs
    };
    let (g, mu) = (vec![1.0, 0.0, 0.0, 0.0], vec![2.0, 0.5, 1.0]);
    let state = [&g[..], &mu].concat();
    let solved = call("guess", &kernel.programs.guess, &mu);
    let (mut p, constants) = (solved[..3].to_vec(), solved[3..].to_vec());
    let mut texts = vec![format!("p = {}", shown(&p))];
    let (mut x, mut bound, mut distance) = (vec![0.0; 3], 1.0, 0.0);
    while bound > kernel.tolerance {
        let inputs = [&p[..], &mu, &constants].concat();
        let corrected = call("correct", &kernel.programs.correct, &inputs);
        (p, x) = (corrected[..3].to_vec(), corrected[3..6].to_vec());
        bound = corrected[6];
        distance += corrected[7];
        let [left, moved] = [bound, corrected[7]].map(|value| shown(&[value]));
        texts.push(format!("x = {}, residual {left}, p moved by {moved}", shown(&x)));
    }
    let accepted =
        call("accept", &kernel.programs.accept, &[&mu[..], &x, &[bound, distance]].concat());
    texts.push(shown(&accepted));
    let moved = call("transport", &kernel.programs.transport, &[&state[..], &x].concat());
    texts.push(format!("g = {}, mu = {}", shown(&moved[..4]), shown(&moved[4..])));
    let sound = call("sound", &kernel.programs.sound, &moved);
    texts.push(shown(&sound));
    let found: Vec<String> =
        lines.iter().zip(texts).map(|(line, text)| line.replace("{}", &text)).collect();
    let found = found.join("\n");
    assert!(read("ARCHITECTURE.md").contains(&found), "the page lacks:\n{found}");
}
