//! The programs of a step as functions of C.

use coadjoint_program::print::{Field, Signature, function, signatures};
use coadjoint_program::{Graph, Program};

use super::dialect::Portable;
use super::fold::Folding;
use super::names::Names;
use super::template::INVERT;
use crate::step::Step;

/// Operations of a function at most: compilers allot registers in a time that grows faster than its length.
const LONGEST: usize = 1000;

/// Some outputs of the program that watches a state, as a program of μ alone, which is all that Casimirs are of.
fn watched(step: &Step, outputs: std::ops::Range<usize>) -> Program {
    let kernel = step.kernel();
    let (n, m) = (kernel.dim(), kernel.element());
    let mut graph = Graph::new();
    let zero = graph.zero();
    let mut inputs = vec![zero; m];
    inputs.extend((0..n).map(|i| graph.input(i)));
    let all = graph.call(&kernel.programs().watch, &inputs);
    graph.finish(n, all.get(outputs).unwrap_or(&[]))
}

/// The energy: of μ, or with a potential of g and μ.
fn energy(step: &Step) -> Program {
    let kernel = step.kernel();
    if kernel.flows().is_none() {
        return watched(step, 0..1);
    }
    let inputs = kernel.element() + kernel.dim();
    let mut graph = Graph::new();
    let state: Vec<_> = (0..inputs).map(|i| graph.input(i)).collect();
    let all = graph.call(&kernel.programs().watch, &state);
    graph.finish(inputs, all.get(..1).unwrap_or(&[]))
}

/// How many Casimirs are watched.
pub(super) fn casimirs(step: &Step) -> usize {
    step.kernel().programs().watch.outputs().len().saturating_sub(1)
}

/// All programs, and what they need.
pub(super) fn functions(step: &Step, fold: &Folding, names: &Names) -> String {
    let kernel = step.kernel();
    let dialect = Portable::new(names, fold.places.clone());
    let prefix = format!("{}_internal_", names.lower);
    let (n, m) = (kernel.dim(), kernel.element());
    let mut text = String::new();
    if !step.inverted().is_empty() {
        text.push_str(&names.fill(INVERT));
    }
    let mut print = |about: &str, signature: &Signature<'_>| {
        text.push_str(&format!("\n/* Internal: {about}. */\n"));
        text.push_str(&function(&dialect, signature, LONGEST));
    };
    for signature in signatures(kernel, &prefix) {
        let about = match signature.name.strip_prefix(&prefix).unwrap_or_default() {
            "guess" => "mu to a first guess of p, and constants of the solve",
            "correct" => "one correction of p",
            "accept" => "1 where a step is right",
            "transport" => "the state moved by the increment x",
            "frame" => "the state moved on by the comoving frame",
            "kick" => "mu kicked by the torque of the potential",
            _ => "1 where a state is finite and on the group",
        };
        print(about, &signature);
    }
    let array = Field::array;
    let program = &kernel.programs().matrix;
    let (inputs, outputs) = (vec![array("g", m)], vec![array("matrix", program.outputs().len())]);
    let name = |name: &str| format!("{prefix}{name}");
    let signature = Signature { name: name("matrix"), program, inputs, outputs };
    print("the matrix of a group element", &signature);
    let (energy, count) = (energy(step), casimirs(step));
    let mu = || vec![array("mu", n)];
    let outputs = vec![Field::number("energy")];
    let inputs = if kernel.flows().is_some() { vec![array("g", m), array("mu", n)] } else { mu() };
    print("the energy", &Signature { name: name("energy"), program: &energy, inputs, outputs });
    if count > 0 {
        let program = &watched(step, 1..1 + count);
        let outputs = vec![array("casimirs", count)];
        let signature = Signature { name: name("casimirs"), program, inputs: mu(), outputs };
        print("the Casimirs", &signature);
    }
    let inputs = vec![array("g", m), array("back", m), array("mu", n)];
    let outputs = vec![array("spatial", n)];
    let program = &step.spatial();
    let signature = Signature { name: name("spatial"), program, inputs, outputs };
    print("the spatial momentum", &signature);
    text
}
