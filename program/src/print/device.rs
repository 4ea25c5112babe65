//! A kernel for graphics cards and whatever else OpenCL and CUDA drive: a thread a trajectory.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};

use super::c::{C, Dialect};
use super::function::function;
use crate::graph::{Id, Node};
use crate::kernel::{Clock, Kernel, Precision};
use crate::print::c::signatures;
use crate::print::steps::{LoopStyle, steps};
use crate::quoting::c_comment;
use crate::schedule::BLOCK;

/// The name of the kernel in the text of [`device_unit`]. (`step` is a function of OpenCL.)
pub const KERNEL_NAME: &str = "coadjoint_steps";

/// The prefix of the names of the text's functions.
const PREFIX: &str = "coadjoint_";

/// The heads of functions that are inlined into the kernel, and of those that are called.
const INLINE: &str = "INLINE void";
const CALLED: &str = "CALLED void";

/// The languages of devices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DeviceLanguage {
    /// OpenCL C 1.2.
    OpenCl,
    /// CUDA C++ 17.
    Cuda,
}

/// Folded coefficients that fit into the 64 KiB of a card's constant memory, with room for the compiler's own.
const CONSTANT_BYTES: usize = 60_000;

/// Operations of a step up to which its programs become part of the kernel; beyond, they are called.
const INLINED: usize = 4000;

/// Operations of a function that is called at most: compilers allot registers in a time that grows with the square of
/// the length.
const LONGEST: usize = 1000;

/// A text with the kernel [`KERNEL_NAME`], which moves trajectories by the steps of
/// [`Stepper::advance`](crate::Stepper::advance), a thread each:
///
/// ```text
/// coadjoint_steps(g, mu, done, status, rows, target)
/// ```
///
/// Number i of trajectory r is at `i * rows + r` of `g` and `mu`. Trajectory r is moved from step `done[r]` to step
/// `target`, or to the step before the one that is refused; `done[r]` is then how far it came, and `status[r]` is 0, or
/// 1 (the equation is not solved), 2 (its solution is far from the first guess), 3 (the step is not in the domain where
/// it is accepted at once) or 4 (the state is not finite or not on the group). Blocks are counted from `done[r]`: where
/// targets are multiples of [`BLOCK`], cutting a run there changes no bit. Where the kernel has a [`Clock`], step 0 begins at time 0.
///
/// `slots` are the folded coefficients, which stand in the text; those that the programs do not read are left out.
/// Numbers have the kernel's [precision](Kernel::precision). No operation is contracted: in 64 bits the results have the
/// bits of the interpreter wherever the language's operations are rounded as IEEE 754 says. `about` is what the text says of
/// itself, a line or several.
pub fn device_unit(
    kernel: &Kernel,
    slots: &[f64],
    language: DeviceLanguage,
    about: &str,
) -> String {
    let device = Device::new(kernel, language);
    let mut text = comment(kernel, about);
    text.push_str(match language {
        DeviceLanguage::OpenCl => HEAD_OPENCL,
        DeviceLanguage::Cuda => HEAD_CUDA,
    });
    text.push_str(&device.sizes(kernel));
    text.push_str(&device.exponents(kernel));
    text.push_str(&device.coefficients(kernel, slots));
    text.push_str(COPY);
    for signature in signatures(kernel, PREFIX) {
        text.push('\n');
        text.push_str(&function(&device, &signature, device.longest));
    }
    let style = LoopStyle {
        prefix: PREFIX.into(),
        count: "COUNT".into(),
        slots: if device.clock.is_some() { "times" } else { "coadjoint_slots" }.into(),
        slots_of_flow: device.places.len().to_string(),
        copy: "coadjoint_copy".into(),
        live: "why == 0u".into(),
        right: "right == ONE".into(),
        refuse: [REFUSED_STEP, "why = 4u;"].map(String::from),
        clock: device.times_of_step(slots),
        ..LoopStyle::default()
    };
    let times =
        device.clock.as_ref().map(|clock| format!("    NUMBER times[{}];\n", clock.times.len()));
    text + &FUNCTION
        .replace("/*TIMES*/", &times.unwrap_or_default())
        .replace("/*STEPS*/", &steps(kernel, &device, &style, 4))
}

fn comment(kernel: &Kernel, about: &str) -> String {
    let mut text = String::from("/*\n");
    for line in about.lines() {
        text.push_str(&format!(" * {}\n", c_comment(line)));
    }
    let programs = &kernel.programs;
    let of = |list: &[&crate::Program]| list.iter().map(|one| one.cost().total()).sum::<usize>();
    let fixed = of(&[&programs.guess, &programs.accept, &programs.transport]);
    let (n, m, correction) = (kernel.dim, kernel.element, of(&[&programs.correct]));
    // As headers count them.
    let often = if kernel.guesses_from_element() { "often five" } else { "most often one" };
    let time = match kernel.clock() {
        Some(Clock { start: 0.0, .. }) => {
            String::from(" * Steps depend on time: step i of a trajectory begins at time i h.\n")
        }
        Some(Clock { start, .. }) => {
            format!(
                " * Steps depend on time: step i of a trajectory begins at time {start:?} + i h.\n"
            )
        }
        None => String::new(),
    };
    text.push_str(&format!(
        " *\n\
         \x20* coadjoint_steps(g, mu, done, status, rows, target): a thread a trajectory, numbers of {} precision.\n\
         \x20* Number i of trajectory r is at i * rows + r of g ({m} numbers each) and mu ({n} each). Trajectory r goes from\n\
         \x20* step done[r] on to step target, or as far as steps are accepted: done[r] says how far, status[r] why no farther:\n\
         \x20* 0 it is at the target, 1 the equation of a step is not solved, 2 its solution is far from the first guess,\n\
         \x20* 3 the step is outside the domain where it is accepted at once, 4 the state is not finite or not on the group.\n\
         \x20* Let targets be multiples of {BLOCK}, or one.\n\
         \x20*\n\
         \x20* A step takes {fixed} operations and {correction} for each correction, {often}.\n\
         {time}\x20*/\n",
        kernel.precision(),
    ));
    text
}

/// C as these languages have it; coefficients are in an array of the text.
struct Device {
    c: C,
    language: DeviceLanguage,
    precision: Precision,
    /// Operations of a function at most.
    longest: usize,
    /// The place of a folded coefficient in the array.
    places: BTreeMap<usize, usize>,
    /// The times, which are in an array of the thread.
    clock: Option<Clock>,
}

impl Device {
    fn new(kernel: &Kernel, language: DeviceLanguage) -> Self {
        let precision = kernel.precision();
        let total: usize = signatures(kernel, PREFIX).map(|one| one.program.cost().total()).sum();
        let inlined = total <= INLINED;
        let (number, suffix) = match precision {
            Precision::Double => ("double", ""),
            Precision::Single => ("float", "f"),
        };
        let c = C {
            head: if inlined { INLINE } else { CALLED }.into(),
            number: number.into(),
            slots: match (kernel.flows(), kernel.clock()) {
                (Some(_), _) => "COEFFICIENTS".into(),
                (None, Some(_)) => "const NUMBER *RESTRICT".into(),
                (None, None) => String::new(),
            },
            pointer: "*RESTRICT ".into(),
            suffix: suffix.into(),
            ..C::default()
        };
        let clock = kernel.clock().cloned();
        let folded = clock.as_ref().map_or(usize::MAX, |clock| clock.first);
        let mut places = BTreeMap::new();
        for signature in signatures(kernel, PREFIX) {
            for node in signature.program.nodes() {
                if let Node::Slot(index) = *node
                    && (index as usize) < folded
                {
                    places.insert(index as usize, 0);
                }
            }
        }
        for (place, value) in places.values_mut().enumerate() {
            *value = place;
        }
        let longest = if inlined { usize::MAX } else { LONGEST };
        Self { c, language, precision, longest, places, clock }
    }

    fn literal(&self, value: f64) -> String {
        self.c.literal(self.precision.round(value))
    }

    /// The sizes that the loop uses, as macros; arrays have one number at least.
    fn sizes(&self, kernel: &Kernel) -> String {
        let (n, m) = (kernel.dim, kernel.element);
        let literal = |value| self.literal(value);
        let array = |length: usize| length.max(1);
        format!(
            "#define NUMBER {}\n#define ONE {}\n\
             #define DIM {n}\n#define ELEMENT {m}\n\
             #define DIM_ARRAY {}\n#define ELEMENT_ARRAY {}\n\
             #define TOLERANCE {}\n#define NEAR {}\n",
            self.c.number,
            literal(1.0),
            array(n),
            array(m),
            literal(kernel.tolerance),
            literal(kernel.near),
        )
    }

    /// The times of the step that begins, where the steps of a trajectory depend on them.
    fn times_of_step(&self, slots: &[f64]) -> String {
        let Some(clock) = &self.clock else { return String::new() };
        let (at, size) = (Id(0), self.literal(slots.get(clock.size).copied().unwrap_or(0.0)));
        let operation = |node, operands: &[&str]| self.operation(node, operands);
        let mut now = operation(Node::Mul(at, at), &["(NUMBER)(done_state[row] + done)", &size]);
        if clock.start != 0.0 {
            now = operation(Node::Add(at, at), &[&self.literal(clock.start), &format!("({now})")]);
        }
        let mut text = format!("const NUMBER now = {now};\n");
        for (place, &part) in clock.times.iter().enumerate() {
            let time = operation(Node::TimesPlus(at, at, at), &[&self.literal(part), &size, "now"]);
            text.push_str(&format!("times[{place}] = {time};\n"));
        }
        text
    }

    /// The functions a·2ᵏ and the exponent of a, by their bits, where a program has them.
    fn exponents(&self, kernel: &Kernel) -> String {
        let asks = |node: &Node| matches!(node, Node::Scale(..) | Node::Exponent(_));
        if !signatures(kernel, PREFIX).any(|one| one.program.nodes().iter().any(asks)) {
            return String::new();
        }
        let (bits, fraction) = match self.precision {
            Precision::Double => (64, 52),
            Precision::Single => (32, 23),
        };
        let bias = (1_u64 << (bits - fraction - 2)) - 1;
        let [to_bits, to_number, word] = match (self.language, self.precision) {
            (DeviceLanguage::OpenCl, Precision::Double) => ["as_ulong", "as_double", "ulong"],
            (DeviceLanguage::OpenCl, Precision::Single) => ["as_uint", "as_float", "uint"],
            (DeviceLanguage::Cuda, Precision::Double) => {
                ["__double_as_longlong", "__longlong_as_double", "unsigned long long"]
            }
            (DeviceLanguage::Cuda, Precision::Single) => {
                ["__float_as_uint", "__uint_as_float", "unsigned int"]
            }
        };
        let large = self.literal(1.5 * (1_u64 << fraction) as f64 + bias as f64);
        let operation = |node, operands: &[&str]| self.operation(node, operands);
        let sum = operation(Node::Add(Id(0), Id(0)), &["k", &large]);
        let factor = format!("{to_number}(({word}){to_bits}({sum}) << {fraction})");
        let product = operation(Node::Mul(Id(0), Id(0)), &["a", &factor]);
        let mask = 2 * bias + 1;
        format!(
            "\nINLINE NUMBER scaled(const NUMBER a, const NUMBER k)\n{{\n    return {product};\n}}\n\n\
             INLINE NUMBER exponent(const NUMBER a)\n{{\n    \
             return (NUMBER)(int)((({word}){to_bits}(a) >> {fraction}) & {mask}u) - (NUMBER){bias};\n}}\n",
        )
    }

    /// The array of the folded coefficients that the programs read.
    fn coefficients(&self, kernel: &Kernel, slots: &[f64]) -> String {
        let flows = kernel.flows().map_or(1, |flows| flows as usize + 1);
        let count = self.places.len() * flows;
        if count == 0 {
            return String::new();
        }
        let space = match self.language {
            DeviceLanguage::OpenCl => "__constant",
            DeviceLanguage::Cuda if count * self.precision.bytes() <= CONSTANT_BYTES => {
                "static __constant__ const"
            }
            DeviceLanguage::Cuda => "static __device__ const",
        };
        let mut text = format!("\n{space} NUMBER coadjoint_slots[{count}] = {{\n");
        for flow in 0..flows {
            for &index in self.places.keys() {
                let value = slots.get(flow * kernel.slots_of_flow() + index);
                let value = value.copied().unwrap_or(0.0);
                text.push_str(&format!("    {},\n", self.literal(value)));
            }
        }
        text.push_str("};\n");
        text
    }
}

impl Dialect for Device {
    fn c(&self) -> &C {
        &self.c
    }

    fn epsilon(&self) -> String {
        self.literal(self.precision.epsilon())
    }

    fn constant(&self, value: f64) -> String {
        self.literal(value)
    }

    fn slot(&self, index: usize) -> String {
        if let Some(clock) = self.clock.as_ref().filter(|clock| index >= clock.first) {
            return format!("c[{}]", index - clock.first);
        }
        let place = self.places.get(&index).map_or_else(|| index.to_string(), usize::to_string);
        match self.c.slots.is_empty() || self.clock.is_some() {
            true => format!("coadjoint_slots[{place}]"),
            false => format!("c[{place}]"),
        }
    }

    fn operation(&self, node: Node, operands: &[&str]) -> String {
        if self.language == DeviceLanguage::OpenCl {
            return self.c.operation(node, operands);
        }
        // Functions that are rounded as they say: the compiler neither contracts nor replaces them.
        let letter = match self.precision {
            Precision::Double => 'd',
            Precision::Single => 'f',
        };
        let (fused, tail) = match self.precision {
            Precision::Double => ("__fma_rn", ""),
            Precision::Single => ("__fmaf_rn", "f"),
        };
        match (node, operands) {
            (Node::Add(..), [a, b]) => format!("__{letter}add_rn({a}, {b})"),
            (Node::Sub(..), [a, b]) => format!("__{letter}sub_rn({a}, {b})"),
            (Node::Mul(..), [a, b]) => format!("__{letter}mul_rn({a}, {b})"),
            (Node::Div(..), [a, b]) => format!("__{letter}div_rn({a}, {b})"),
            (Node::TimesPlus(..), [a, b, c]) => format!("{fused}({a}, {b}, {c})"),
            (Node::Sqrt(_), [a]) => format!("__{letter}sqrt_rn({a})"),
            (Node::Abs(_), [a]) => format!("fabs{tail}({a})"),
            (Node::Round(_), [a]) => format!("rint{tail}({a})"),
            _ => self.c.operation(node, operands),
        }
    }
}

const HEAD_OPENCL: &str = r"
#pragma OPENCL FP_CONTRACT OFF
#define KERNEL __kernel
#define INLINE static
#define CALLED static
#define GLOBAL __global
#define RESTRICT restrict
#define COUNT ulong
#define COEFFICIENTS __constant NUMBER *
#define ROW get_global_id(0)
";

const HEAD_CUDA: &str = r#"
#define KERNEL extern "C" __global__
#define INLINE static __device__ __forceinline__
#define CALLED static __device__ __noinline__
#define GLOBAL
#define RESTRICT __restrict__
#define COUNT unsigned long long
#define COEFFICIENTS const NUMBER *
#define ROW ((COUNT)blockIdx.x * blockDim.x + threadIdx.x)
#ifndef NAN
#define NAN (0.0f / 0.0f)
#endif
#ifndef INFINITY
#define INFINITY (1.0f / 0.0f)
#endif
"#;

const COPY: &str = r"
INLINE void coadjoint_copy(NUMBER *RESTRICT to, const NUMBER *RESTRICT from, const int length)
{
    for (int i = 0; i < length; i++) {
        to[i] = from[i];
    }
}
";

/// Decisions are those of [`Stepper::advance`](crate::Stepper::advance).
const FUNCTION: &str = r"
KERNEL void coadjoint_steps(GLOBAL NUMBER *RESTRICT g_state, GLOBAL NUMBER *RESTRICT mu_state,
    GLOBAL COUNT *RESTRICT done_state, GLOBAL unsigned int *RESTRICT status, const COUNT rows,
    const COUNT target)
{
    const COUNT row = ROW;
    NUMBER g[ELEMENT_ARRAY], mu[DIM_ARRAY];
    COUNT steps;
    unsigned int why = 0u;
/*TIMES*/    if (row >= rows || done_state[row] >= target) {
        return;
    }
    steps = target - done_state[row];
    for (int i = 0; i < ELEMENT; i++) {
        g[i] = g_state[i * rows + row];
    }
    for (int i = 0; i < DIM; i++) {
        mu[i] = mu_state[i * rows + row];
    }
/*STEPS*/    for (int i = 0; i < ELEMENT; i++) {
        g_state[i * rows + row] = g[i];
    }
    for (int i = 0; i < DIM; i++) {
        mu_state[i * rows + row] = mu[i];
    }
    done_state[row] += done;
    status[row] = why;
}
";

const REFUSED_STEP: &str =
    "why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;";
