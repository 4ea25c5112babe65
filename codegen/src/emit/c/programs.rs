//! The programs of a step as functions of C, and the loop that calls them, that of
//! [`coadjoint_program::Stepper::advance`].

use coadjoint_program::print::{Field, LoopStyle, Signature, Value, function, signatures, steps};
use coadjoint_program::{Graph, Kernel, Program};

use crate::emit::c::dialect::{Portable, decimal};
use crate::emit::c::fold::Folding;
use crate::emit::c::names::Names;
use crate::step::Step;

/// Operations of a function at most: compilers allot registers in a time that grows faster than its length.
const LONGEST: usize = 1000;

/// Some outputs of the program that watches a state, as a program of μ alone, which is all that Casimirs are of.
fn watched(step: &Step, outputs: std::ops::Range<usize>) -> Program {
    let kernel = step.kernel();
    let (n, m) = (kernel.dim, kernel.element);
    let graph = Graph::new();
    let mut inputs = vec![graph.zero(); m];
    inputs.extend((0..n).map(|i| graph.input(i)));
    let all = graph.call(&kernel.programs.watch, &inputs);
    graph.finish(n, all.get(outputs).unwrap_or(&[]))
}

/// The energy: of μ, or with a potential of g and μ.
fn energy(step: &Step) -> Program {
    let kernel = step.kernel();
    if kernel.flows().is_none() {
        return watched(step, 0..1);
    }
    let inputs = kernel.element + kernel.dim;
    let graph = Graph::new();
    let state: Vec<_> = (0..inputs).map(|i| graph.input(i)).collect();
    let all = graph.call(&kernel.programs.watch, &state);
    graph.finish(inputs, all.get(..1).unwrap_or(&[]))
}

pub(super) fn casimirs(step: &Step) -> usize {
    step.kernel().programs.watch.outputs().len().saturating_sub(1)
}

/// All programs.
fn functions(kernel: &Kernel, step: &Step, dialect: &Portable, prefix: &str) -> String {
    let (n, m) = (kernel.dim, kernel.element);
    let mut text = String::new();
    let mut print = |about: &str, signature: &Signature<'_>| {
        text.push_str(&format!("\n/* Internal: {about}. */\n"));
        text.push_str(&function(dialect, signature, LONGEST));
    };
    for signature in signatures(kernel, prefix) {
        let about = match signature.name.strip_prefix(prefix).unwrap_or_default() {
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
    let program = &kernel.programs.matrix;
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

/// The programs, the loop that calls them, and its limits, for the template.
pub(super) fn values(step: &Step, fold: &Folding, names: &Names) -> Vec<Value> {
    let kernel = step.kernel();
    let dialect = Portable::new(names, fold.places.clone());
    let prefix = format!("{}_internal_", names.lower);
    let of = if kernel.flows().is_some() { "&c[flow * @P@_COEFFICIENTS]" } else { "c" };
    let refused = format!("status = @p@_internal_reason({of}, mu, residual_bound, distance);");
    let clock = kernel.clock().map_or_else(String::new, |clock| {
        format!("@p@_internal_clock(map, c, time + ((double)done * map->c[{}u]));", clock.size)
    });
    let style = LoopStyle {
        prefix: prefix.clone(),
        declare: ["double", "uint32_t", ""].map(String::from),
        copy: names.fill("@p@_internal_copy"),
        live: names.fill("status == @P@_OK"),
        open: names.fill("@p@_internal_open(residual_bound, distance)"),
        right: ["!(right > 0.5)", "right > 0.5"].map(String::from),
        slots_of_flow: names.fill("@P@_COEFFICIENTS"),
        refuse: [&refused, "status = @p@_internal_broken(g, mu);"].map(|text| names.fill(text)),
        clock: names.fill(&clock),
        ..LoopStyle::default()
    };
    let mut values = vec![
        ("PROGRAMS", functions(kernel, step, &dialect, &prefix)),
        ("STEPS", steps(kernel, &dialect, &style, 4)),
        ("TOLERANCE", decimal(kernel.tolerance)),
        ("NEAR", decimal(kernel.near)),
    ];
    if let Some(clock) = kernel.clock() {
        let parts: Vec<String> = clock.times.iter().map(|&time| decimal(time)).collect();
        values.extend([("PARTS", parts.join(", ")), ("SIZE", format!("{}u", clock.size))]);
    }
    values
}
