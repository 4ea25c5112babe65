//! Types of a header, and functions of a state.

use std::fmt::Write;

use coadjoint_program::BLOCK;
use coadjoint_program::quoting::c_comment;
use num_traits::ToPrimitive;

use crate::emit::c::dialect::decimal;
use crate::emit::c::fold::Folding;
use crate::emit::c::names::Names;
use crate::emit::c::programs::casimirs;
use crate::emit::c::template::{CASIMIRS, STATE, TEXT, timed};
use crate::emit::c::{HeaderOptions, Language, parameter};
use crate::emit::header::{self, Method};
use crate::step::{Origin, Step};

fn rows(step: &Step) -> usize {
    step.kernel().programs.matrix.outputs().len().isqrt()
}

/// Sizes, the status, and the structures.
pub(crate) fn types(
    origin: &Origin,
    step: &Step,
    fold: &Folding,
    names: &Names,
    options: &HeaderOptions,
) -> String {
    let kernel = step.kernel();
    let facts = origin.facts();
    let mut text = String::from("\n");
    let mut size = |name: &str, value: usize, about: &str| {
        let _ = writeln!(text, "/** {about} */\n#define @P@_{name} {value}u");
    };
    size("DIMENSION", kernel.dim, "Coordinates of the momentum.");
    size("ELEMENT", kernel.element, "Numbers of a group element.");
    size("ROWS", rows(step), "Rows of its matrix.");
    if casimirs(step) > 0 {
        size("CASIMIRS", casimirs(step), "Casimirs of degree three at most that are looked at.");
    }
    let about = match kernel.flows() {
        Some(flows) => {
            size("FLOWS", flows as usize, "Flows of a step, between kicks.");
            "Folded coefficients of a flow and the kick before it."
        }
        None => "Folded coefficients.",
    };
    size("COEFFICIENTS", fold.len(), about);
    if let Some(clock) = kernel.clock() {
        size("TIMES", clock.times.len(), "Times at which a step asks for the Hamiltonian.");
    }
    size("BLOCK", BLOCK as usize, "Steps after which the state is looked at.");
    if let Some(largest) = step.inverted().iter().map(|&(_, rows)| rows).max() {
        size("LARGEST_BLOCK", largest, "Rows of the largest matrix in a group element.");
    }
    let only = match options.only_step {
        Some(_) => ", or not the one step that was learned",
        None => "",
    };
    let unresolved = match origin.series() {
        Some(_) => "",
        None => ", or its nodes do not resolve it",
    };
    text.push_str(
        &timed(STATUS, step).replace("/*ONLY*/", only).replace("/*UNRESOLVED*/", unresolved),
    );
    if !facts.parameters.is_empty() {
        text.push_str("\n/** Parameters of the Hamiltonian. */\ntypedef struct @p@_parameters {\n");
        for (parameter, name) in facts.parameters.iter().zip(&names.parameters) {
            let member = parameter::member(&parameter.shape, name);
            let own = c_comment(&parameter.name);
            let note = if own == *name { String::new() } else { format!(" /**< {own} */") };
            let _ = writeln!(text, "    {member};{note}");
        }
        text.push_str("} @p@_parameters;\n");
    }
    text.push_str("\n/** A state. Copy it as you like. */\ntypedef struct @p@_state {\n");
    let _ = writeln!(
        text,
        "    /** The group element: {}. */\n    double g[@P@_ELEMENT];",
        step.element_about()
    );
    text.push_str("    /** The body momentum, in the order of the basis of the Lie algebra:\n");
    for (i, name) in facts.coordinates.iter().enumerate() {
        let unit = options.momentum.get(i).and_then(Option::as_ref);
        let unit = unit.map_or(String::new(), |unit| format!(" in {}", c_comment(unit)));
        let _ = writeln!(text, "     *  mu[{i}] = {}{unit}", c_comment(name));
    }
    text.push_str("     */\n    double mu[@P@_DIMENSION];\n} @p@_state;\n");
    text.push_str(&MAP.replace(
        "/*LENGTH*/",
        match kernel.flows() {
            Some(_) => "(@P@_FLOWS + 1u) * @P@_COEFFICIENTS",
            None => "@P@_COEFFICIENTS",
        },
    ));
    names.fill(&text)
}

/// Functions of a state, and the status in words.
pub(crate) fn functions(origin: &Origin, step: &Step, names: &Names) -> String {
    let rows = rows(step);
    let identity: Vec<f64> =
        (0..rows * rows).map(|at| f64::from(u8::from(at / rows == at % rows))).collect();
    let mut numbers = String::new();
    for row in step.element_of(&identity).chunks(8) {
        let row: Vec<String> = row.iter().map(|&value| decimal(value)).collect();
        let _ = writeln!(numbers, "        {},", row.join(", "));
    }
    let inverted = step.inverted();
    let mut back = String::new();
    if !inverted.is_empty() {
        back.push_str("    double back[@P@_ELEMENT];\n    uint32_t i;\n");
        back.push_str("    for (i = 0u; i < @P@_ELEMENT; i++) {\n        back[i] = 0.0;\n    }\n");
        for (at, rows) in &inverted {
            let _ =
                writeln!(back, "    @p@_internal_invert(&state->g[{at}], &back[{at}], {rows}u);");
        }
    }
    let singular = match inverted.is_empty() {
        true => "",
        false => " It is not finite\n * where the matrix has no inverse.",
    };
    let mut text = timed(STATE, step)
        .replace("/*IDENTITY*/", &numbers)
        .replace("/*BACK*/", &back)
        .replace("/*ARGUMENT*/", if inverted.is_empty() { "none" } else { "back" })
        .replace("/*SINGULAR*/", singular)
        .replace("/*OF*/", if origin.kicks().is_some() { "state->g, " } else { "" })
        .replace("/*POTENTIAL*/", if origin.kicks().is_some() { " and the potential" } else { "" });
    if casimirs(step) > 0 {
        text.push_str(CASIMIRS);
    }
    text.push_str(
        &timed(TEXT, step).replace(
            "/*BAD_STEP*/",
            "the step size is zero, not finite, or not one that was learned",
        ),
    );
    if origin.facts().parameters.iter().any(|parameter| parameter.default.is_some()) {
        text.push_str(&defaults(origin, names));
    }
    names.fill(&text)
}

/// The values that the system file gives to its parameters.
fn defaults(origin: &Origin, names: &Names) -> String {
    let facts = origin.facts();
    let scalars = parameter::scalars(facts.parameters, names);
    let values = facts.parameters.iter().flat_map(|parameter| {
        (0..parameter.shape.len()).map(move |i| {
            let value = parameter.default.as_ref().and_then(|list| list.get(i));
            value.and_then(ToPrimitive::to_f64).unwrap_or(f64::NAN)
        })
    });
    let mut text = String::from(
        "\n/** The parameters as the system file has them. */\nstatic inline void \
         @p@_default_parameters(@p@_parameters *parameters)\n{\n",
    );
    for (scalar, value) in scalars.iter().zip(values) {
        let value = if value.is_nan() { "(double)NAN".to_owned() } else { decimal(value) };
        let _ = writeln!(text, "    {scalar} = {value};");
    }
    text.push_str("}\n");
    text
}

const STATUS: &str = "
/**
 * What became of a call. Whatever is not @P@_OK left the state (the last one made) as it was.
 *
 * What asks for a smaller step: make another map with half the step size, make two steps with it, and go back to the
 * first map. There is no other rescue in this header; it refuses steps that might be wrong, and now and then one that
 * would have been right.
 */
typedef enum @p@_status {
    /** Fine. */
    @P@_OK = 0,
    /** The step size is zero or not finite/*ONLY*/: fix the call of @p@_init. */
    @P@_BAD_STEP = 1,
    /** A coefficient is not finite: a parameter is not, or one that is divided by is zero. */
    @P@_BAD_PARAMETER = 2,
    /** A number of the state/*OR_TIME*/ is not finite, or became so: the state given was broken, or the motion escapes. */
    @P@_NOT_FINITE = 3,
    /** The group element is none of the group (a quaternion that is not a unit one): normalise it. */
    @P@_OFF_GROUP = 4,
    /** The equation of the step was not solved to rounding near the first guess: take a smaller step. */
    @P@_NOT_SOLVED = 5,
    /** The momentum is so large that the series cannot be trusted: take a smaller step. */
    @P@_BEYOND_SERIES = 6,
    /** The step goes too far at once for the group's chart/*UNRESOLVED*/: take a smaller step. */
    @P@_BEYOND_CHART = 7
} @p@_status;
";

const MAP: &str = "
/** The step for one step size and one set of parameters; made by @p@_init, and only read after that. */
typedef struct @p@_map {
    /** Folded coefficients. */
    double c[/*LENGTH*/];
    /** Whether steps can be made with it. */
    @p@_status status;
} @p@_map;
";

/// The class, for compilers of C++ alone.
pub(crate) fn class(origin: &Origin, step: &Step, names: &Names) -> String {
    let with = !origin.facts().parameters.is_empty();
    let text = timed(CLASS, step)
        .replace("/*PARAMETERS*/", if with { PARAMETERS } else { "" })
        .replace("/*ARGUMENT*/", if with { ", const Parameters &parameters" } else { "" })
        .replace("/*PASSED*/", if with { ", &parameters" } else { "" })
        .replace("/*CASIMIRS*/", if casimirs(step) > 0 { CLASS_CASIMIRS } else { "" });
    names.fill(&format!("\n#if defined(__cplusplus){text}#endif\n"))
}

/// The name of the parameters in the class.
const PARAMETERS: &str = "    typedef @p@_parameters Parameters;\n";

const CLASS: &str = "
/**
 * The same for C++11: a map with its functions. It allocates nothing and throws nothing.
 */
class @C@ {
public:
    typedef @p@_state State;
    typedef @p@_status Status;
/*PARAMETERS*/
    /** As @p@_init; ask status() whether that went well. */
    explicit @C@(double h/*ARGUMENT*/) noexcept
    {
        (void)@p@_init(&map_, h/*PASSED*/);
    }

    /** Whether steps can be made, or why not. */
    Status status() const noexcept { return map_.status; }

    /** The state at the identity with this momentum. */
    static State at_identity(const double (&mu)[@P@_DIMENSION]) noexcept
    {
        State state;
        @p@_at_identity(&state, mu);
        return state;
    }

    /** As @p@_step. */
    Status step(State &state/*TIME*/) const noexcept { return @p@_step(&map_, &state/*NOW*/); }

    /** As @p@_advance. */
    Status advance(State &state/*TIME*/, uint32_t steps, uint32_t &made) const noexcept
    {
        return @p@_advance(&map_, &state/*NOW*/, steps, &made);
    }

    /** As @p@_energy. */
    double energy(const State &state/*TIME*/) const noexcept { return @p@_energy(&map_, &state/*NOW*/); }
/*CASIMIRS*/
    /** As @p@_spatial_momentum. */
    static void spatial_momentum(const State &state, double (&spatial)[@P@_DIMENSION]) noexcept
    {
        @p@_spatial_momentum(&state, spatial);
    }

    /** As @p@_matrix. */
    static void matrix(const State &state, double (&entries)[@P@_ROWS * @P@_ROWS]) noexcept
    {
        @p@_matrix(&state, entries);
    }

private:
    @p@_map map_;
};
";

const CLASS_CASIMIRS: &str = "
    /** As @p@_casimirs. */
    static void casimirs(const State &state, double (&values)[@P@_CASIMIRS]) noexcept
    {
        @p@_casimirs(&state, values);
    }
";

/// Columns of a comment.
const WIDTH: usize = 112;

/// The opening comment, the guard, what is included, and macros.
pub(super) fn opening(
    origin: &Origin,
    step: &Step,
    fold: &Folding,
    names: &Names,
    options: &HeaderOptions,
) -> String {
    let mut text = String::from("/*\n");
    for paragraph in paragraphs(origin, step, fold, names, options) {
        for line in header::wrapped(&paragraph, WIDTH) {
            text.push_str(if line.is_empty() { " *" } else { " * " });
            text.push_str(&line);
            text.push('\n');
        }
    }
    text.push_str(" */\n");
    text.push_str(&names.fill(GUARD));
    if options.language == Language::Cpp {
        text.push_str(
            "\n#if !defined(__cplusplus)\n#error \"this header has a class: emit it with --language c for C\"\n#endif\n",
        );
    }
    text.replace("/*VERSION*/", env!("CARGO_PKG_VERSION"))
}

fn paragraphs(
    origin: &Origin,
    step: &Step,
    fold: &Folding,
    names: &Names,
    options: &HeaderOptions,
) -> Vec<String> {
    let facts = origin.facts();
    let kernel = step.kernel();
    let lists = kernel.flows().map_or(1, |flows| flows as usize + 1);
    let time =
        options.time.as_ref().map_or(String::new(), |unit| format!(" in {}", c_comment(unit)));
    let parameters = if facts.parameters.is_empty() { "" } else { ", &parameters" };
    let now = kernel.clock().map_or("", |_| ", time");
    let lower = &names.lower;
    let mut list = vec![
        format!("{}: steps of the system \"{}\".", names.file(), c_comment(facts.name)),
        format!(
            "Generated by coadjoint {} for {}; changes will be overwritten.",
            env!("CARGO_PKG_VERSION"),
            match options.language {
                Language::C => "C99 and C++11",
                Language::Cpp => "C++11",
            }
        ),
        String::new(),
    ];
    list.extend(header::system(facts, origin.kicks(), &Method::of(origin), c_comment));
    list.extend([
        "How to use it:".to_owned(),
        format!("     {lower}_map map;"),
        format!("     {lower}_state state;"),
        format!("     {lower}_status status = {lower}_init(&map, h{parameters});"),
        format!("     {lower}_at_identity(&state, mu);"),
        format!("     status = {lower}_step(&map, &state{now});"),
        format!(
            "All memory is the caller's. There are no globals and no allocations, a map may be read by several threads \
             at once, and pointers must not be null. The step size h is a time{time}; every status other than {}_OK says \
             why a call was refused and leaves the state as it was.",
            names.upper
        ),
        String::new(),
        "Refusals. A step is accepted only where its equation is solved to rounding near the first guess and \
         everything used is known to hold there. Longer steps are refused with a status. "
            .to_owned()
            + &rescue(origin, step),
        String::new(),
    ]);
    list.extend(header::costs(kernel));
    list.extend([
        format!(
            "Data: {} coefficients ({} bytes) in a map, {} bytes in a state.",
            fold.len() * lists,
            8 * fold.len() * lists,
            8 * (kernel.dim + kernel.element)
        ),
        String::new(),
        format!(
            "Numbers are doubles of IEEE 754. Compile without -ffast-math, and with -ffp-contract=off for the bits that \
             coadjoint computes itself. A fused product a * b + c is fma() of math.h, slow where the processor has none: \
             there define {0}_FMA as the name of a function or macro for it, which may round twice.",
            names.upper
        ),
    ]);
    if kernel.programs.frame.is_some() {
        list.push(String::new());
        list.push(format!(
            "The motion is generated in a comoving frame, which moves on every {0}_BLOCK steps and at the end of each call \
             of {lower}_advance: the rounding of many steps depends on how they are cut into calls.",
            names.upper
        ));
    }
    if kernel.clock().is_some() {
        list.push(String::new());
        list.push(format!(
            "The Hamiltonian depends on time. A step is given the time at which it begins, {lower}_advance that of its first \
             step. The state does not hold it: count steps, and give t0 + i h, so that no rounding gathers."
        ));
    }
    if let Some(step) = options.only_step {
        list.push(String::new());
        list.push(format!(
            "The map was learned for the step size {step:?}, and {lower}_init refuses any other."
        ));
    }
    list
}

/// The advice after a refused step.
fn rescue(origin: &Origin, step: &Step) -> String {
    match origin.series() {
        Some(_) => "The library in Rust then follows the solution from the identity; this header does not: take a \
            smaller step."
            .to_owned(),
        None if step.memory() == 0 => "Then take a smaller step.".to_owned(),
        None => format!(
            "A step begins with a guess from those before it, by the last {} numbers of g: where a state was changed, or \
             a step is refused, set them to 0, which forgets them; then take a smaller step.",
            step.memory()
        ),
    }
}

const GUARD: &str = "#ifndef @G@
#define @G@

#if !defined(__cplusplus) && (!defined(__STDC_VERSION__) || (__STDC_VERSION__ < 199901L))
#error \"this header needs C99 or C++11\"
#endif
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ > 0))
#error \"steps are accepted by comparisons that fast or finite-only arithmetic leaves out: compile without it\"
#endif

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/** The version of coadjoint that wrote this. */
#define @P@_VERSION \"/*VERSION*/\"

#if defined(__cplusplus)
#define @P@_RESTRICT
#else
#define @P@_RESTRICT restrict
#endif

#ifndef @P@_FMA
#define @P@_FMA fma
#endif
";
