//! A kernel for graphics cards and whatever else OpenCL and CUDA drive: a thread a trajectory.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec;

use super::c::{C, Dialect};
use super::function::function;
use super::template::{Value, fill};
use crate::graph::{Id, Node, Program};
use crate::kernel::{Clock, Kernel, Precision, WIDTH};
use crate::print::c::signatures;
use crate::print::steps::{LoopStyle, steps};
use crate::quoting::c_comment;
use crate::schedule::BLOCK;

/// The name of the kernel in the text of [`device_unit`]. (`step` is a function of OpenCL.)
pub const KERNEL_NAME: &str = "coadjoint_steps";

/// The prefix of the names of the text's functions.
const PREFIX: &str = "coadjoint_";

/// The heads of functions that are inlined into the kernel, and of those of which the compiler decides: NVRTC inlines nearly
/// all, which halves the time of a step of su(3). Told to inline all, it takes many times as long for large kernels.
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

/// Operations of a step up to which its programs become part of the kernel; beyond, the compiler decides.
const INLINED: usize = 4000;

/// Operations of a function at most that may be called: compilers allot registers in a time that grows with the square of
/// the length.
const LONGEST: usize = 1000;

/// A text with the kernel [`KERNEL_NAME`], which moves trajectories by the steps of
/// [`Stepper::advance`](crate::Stepper::advance), a thread each:
///
/// ```text
/// coadjoint_steps(states, done, status, rows, target)
/// ```
///
/// `states` has the order of [`States`](crate::states::States). Trajectory r is moved from step `done[r]` to step
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
    let style = LoopStyle {
        prefix: PREFIX.into(),
        declare: [&device.c.number, "COUNT", ""].map(String::from),
        as_number: [format!("({})", device.c.number), String::new()],
        slots: if device.clock.is_some() { "times" } else { "coadjoint_slots" }.into(),
        slots_of_flow: device.places.len().to_string(),
        copy: "coadjoint_copy".into(),
        live: "why == 0u".into(),
        right: ["right != ONE", "right == ONE"].map(String::from),
        refuse: [REFUSED_STEP, "why = 4u;"].map(String::from),
        clock: device.times_of_step(slots),
        ..LoopStyle::default()
    };
    let programs = &kernel.programs;
    let of = |list: &[&Program]| list.iter().map(|one| one.cost().total()).sum::<usize>();
    let fixed = of(&[&programs.guess, &programs.accept, &programs.transport]);
    // As headers count them.
    let often = if kernel.guesses_from_element() { "often five" } else { "most often one" };
    let [scaled, exponent, exponents] = device.exponents(kernel);
    let functions = signatures(kernel, PREFIX)
        .map(|signature| format!("\n{}", function(&device, &signature, device.longest)));
    let literal = |value| device.literal(value);
    // Arrays have one number at least.
    let array = |length: usize| length.max(1).to_string();
    let mut values = vec![
        (if language == DeviceLanguage::Cuda { "CUDA" } else { "OPENCL" }, "1".into()),
        ("ABOUT", about.lines().map(|line| format!(" * {}\n", c_comment(line))).collect()),
        ("PRECISION", device.precision.to_string()),
        ("BLOCK", BLOCK.to_string()),
        ("FIXED", fixed.to_string()),
        ("CORRECTION", programs.correct.cost().total().to_string()),
        ("OFTEN", often.into()),
        ("NUMBER", device.c.number.clone()),
        ("ONE", literal(1.0)),
        ("DIM", kernel.dim.to_string()),
        ("ELEMENT", kernel.element.to_string()),
        ("WIDTH", WIDTH.to_string()),
        ("LENGTH", (WIDTH * (kernel.element + kernel.dim)).to_string()),
        ("DIM_ARRAY", array(kernel.dim)),
        ("ELEMENT_ARRAY", array(kernel.element)),
        ("TOLERANCE", literal(kernel.tolerance)),
        ("NEAR", literal(kernel.near)),
        ("SCALED", scaled),
        ("EXPONENT", exponent),
        ("EXPONENTS", exponents),
        ("PROGRAMS", functions.collect()),
        ("STEPS", steps(kernel, &device, &style, 4)),
    ];
    values.extend(device.coefficients(kernel, slots));
    if let Some(Clock { start, times, .. }) = &device.clock {
        let start = if *start == 0.0 { String::new() } else { format!("{start:?} + ") };
        values.extend([("TIMES", times.len().to_string()), ("START", start)]);
    }
    fill(include_str!("device.c.in"), &values)
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

    /// The functions a·2ᵏ and the exponent of a, by their bits; the last text is empty where none has.
    fn exponents(&self, kernel: &Kernel) -> [String; 3] {
        let asks = |node: &Node| matches!(node, Node::Scale(..) | Node::Exponent(_));
        let asked = signatures(kernel, PREFIX).any(|one| one.program.nodes().iter().any(asks));
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
        let mask = 2 * bias + 1;
        [
            operation(Node::Mul(Id(0), Id(0)), &["a", &factor]),
            format!(
                "(NUMBER)(int)((({word}){to_bits}(a) >> {fraction}) & {mask}u) - (NUMBER){bias}"
            ),
            if asked { "1".into() } else { String::new() },
        ]
    }

    /// The array of the folded coefficients that the programs read.
    fn coefficients(&self, kernel: &Kernel, slots: &[f64]) -> [Value; 3] {
        let flows = kernel.flows().map_or(1, |flows| flows as usize + 1);
        let count = self.places.len() * flows;
        let space = match self.language {
            DeviceLanguage::OpenCl => "__constant",
            DeviceLanguage::Cuda if count * self.precision.bytes() <= CONSTANT_BYTES => {
                "static __constant__ const"
            }
            DeviceLanguage::Cuda => "static __device__ const",
        };
        let mut text = String::new();
        for flow in 0..flows {
            for &index in self.places.keys() {
                let value = slots.get(flow * kernel.slots_of_flow() + index);
                let value = value.copied().unwrap_or(0.0);
                text.push_str(&format!("    {},\n", self.literal(value)));
            }
        }
        [("SLOTS", text), ("SPACE", space.into()), ("COUNT", count.to_string())]
    }
}

impl Dialect for Device {
    fn c(&self) -> &C {
        &self.c
    }

    /// Compilers of cards keep arrays that are read in loops in slow memory.
    fn has_rows(&self) -> bool {
        false
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

/// Decisions are those of [`Stepper::advance`](crate::Stepper::advance).
const REFUSED_STEP: &str =
    "why = !(distance <= NEAR) ? 2u : !(residual_bound <= TOLERANCE) ? 1u : 3u;";
