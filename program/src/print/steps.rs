//! The loop of a kernel as statements, in any language.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::graph::{Id, Node};
use crate::kernel::Kernel;
use crate::print::c::Dialect;
use crate::schedule::{Block, Kept, Kind, Part, Statement, Test, Variable};

/// The words of a language for the loop; the default is the style of a unit of C, with a function around it that declares
/// `bool live`.
#[derive(Clone, Debug)]
pub struct LoopStyle {
    /// The prefix of the names of programs.
    pub prefix: String,
    /// The type of a count; `M`, a vector of whole numbers, where numbers, counts and masks are vectors of lanes.
    pub count: String,
    /// The lengths of g and of μ.
    pub sizes: [String; 2],
    /// The list of the coefficients.
    pub slots: String,
    /// The number of coefficients that one flow reads.
    pub slots_of_flow: String,
    /// The name of a function that copies (to, from, length).
    pub copy: String,
    /// The condition under which a trajectory moves on.
    pub live: String,
    /// The condition under which an equation is corrected again: not solved to the tolerance, near the guess.
    pub open: String,
    /// The condition that a program's answer is 1.
    pub right: String,
    /// Statements that stop a trajectory: because of a step, and because of a state.
    pub refuse: [String; 2],
    /// Statements that report the corrections and the residual bound of the step made.
    pub note: String,
    /// Statements that set the times of the step that begins.
    pub clock: String,
}

impl Default for LoopStyle {
    fn default() -> Self {
        Self {
            prefix: "scalar_".into(),
            count: "unsigned long long".into(),
            sizes: ["ELEMENT", "DIM"].map(String::from),
            slots: "c".into(),
            slots_of_flow: "SLOTS".into(),
            copy: "copy".into(),
            live: "live".into(),
            open: "!(residual_bound <= TOLERANCE) && distance <= NEAR".into(),
            right: "right == 1.0".into(),
            refuse: ["live = false;", "live = false;"].map(String::from),
            note: String::new(),
            clock: String::new(),
        }
    }
}

/// A language that writes the statements of the loop. The function around it has g, μ, `steps` and whatever the word `live`
/// reads.
pub trait Loop {
    /// The words.
    fn style(&self) -> &LoopStyle;
    /// A name that is bound.
    fn bound(&self, name: &str) -> String;
    /// The statement that declares a variable by this name; it, or all its numbers, begin with `initial`.
    fn variable(&self, variable: Variable, name: &str, initial: Option<u32>) -> String;
    /// a + b.
    fn sum(&self, a: &str, b: &str) -> String;
    /// A count that is known.
    fn whole(&self, value: u32) -> String;
    /// The statement that adds 1 to a count, in the lanes of a mask.
    fn next(&self, count: &str, mask: Option<&str>) -> String;
    /// The statement that assigns to a variable like this one, in the lanes of a mask.
    fn assign(&self, mask: Option<&str>, like: Variable, names: [&str; 2]) -> String;
    /// The statement that evaluates a program, given the names of what it reads and of what it assigns.
    fn call(&self, part: Part, inputs: &[Name], outputs: &[Name]) -> String;
    /// True if outputs are assigned while inputs are read.
    fn assigns_early(&self) -> bool;
    /// True if a test has an answer for each lane.
    fn of_lanes(&self, test: Test) -> bool;
    /// A test, or its opposite.
    fn test(&self, holds: bool, test: &str, of_lanes: bool) -> String;
    /// The condition that all tests hold.
    fn all(&self, tests: &[String], of_lanes: bool) -> String;
    /// The statement that declares a mask, and the condition that it has any lane.
    fn mask(&self, name: &str, lanes: &str) -> [String; 2];
}

/// A variable, and a name for it.
pub type Name = (Variable, String);

/// The statements of the loop; lines begin with `depth` spaces.
pub fn statements(kernel: &Kernel, language: &impl Loop, depth: usize) -> String {
    let mut writer = Writer { kernel, language, depth, masks: 0, text: String::new() };
    writer.block(kernel.schedule(), None);
    writer.text
}

/// The statements of the loop in a dialect of C.
pub fn steps(kernel: &Kernel, dialect: &impl Dialect, style: &LoopStyle, depth: usize) -> String {
    let lanes = style.count == "M";
    statements(kernel, &CLoop { kernel, dialect, style, lanes }, depth)
}

struct Writer<'a, L> {
    kernel: &'a Kernel,
    language: &'a L,
    depth: usize,
    /// The number of named masks.
    masks: usize,
    text: String,
}

impl<L: Loop> Writer<'_, L> {
    fn line(&mut self, text: &str) {
        for line in text.lines() {
            self.text.push_str(&format!("{:1$}{line}\n", "", self.depth));
        }
    }

    fn name(&self, variable: Variable, end: &str) -> String {
        self.language.bound(&format!("{}{end}", variable.name()))
    }

    fn declare(&mut self, variable: Variable, end: &str, initial: Option<u32>) {
        self.line(&self.language.variable(variable, &self.name(variable, end), initial));
    }

    fn block(&mut self, block: &Block, mask: Option<&str>) {
        for &(variable, initial) in &block.variables {
            self.declare(variable, "", initial);
        }
        for statement in &block.body {
            self.statement(statement, block, mask);
        }
    }

    fn statement(&mut self, statement: &Statement, block: &Block, mask: Option<&str>) {
        let style = self.language.style();
        let refused = |step: usize| match mask {
            None => style.refuse[step].clone(),
            Some(mask) => format!("live &= ~{mask};"),
        };
        let text = match statement {
            Statement::Call(part) => return self.call(*part, block, mask),
            Statement::While(tests, block) => return self.branch("while", tests, block, mask),
            Statement::If(tests, block) => return self.branch("if", tests, block, mask),
            Statement::Lengthen => {
                let distance = self.name(Variable::Distance, "");
                let sum = self.language.sum(&distance, &self.name(Variable::Moved, ""));
                self.language.assign(mask, Variable::Distance, [&distance, &sum])
            }
            Statement::Next(variable) => {
                let mask = mask.filter(|_| *variable != Variable::Flow);
                self.language.next(&self.name(*variable, ""), mask)
            }
            Statement::Keep(kept) => {
                self.declare(Variable::Element, end_of(*kept), None);
                self.declare(Variable::Momentum, end_of(*kept), None);
                self.state(mask, [end_of(*kept), ""])
            }
            Statement::Restore(kept) => {
                let mut text = self.state(mask, ["", end_of(*kept)]);
                if *kept == Kept::Block {
                    let [done, count] =
                        [Variable::Done, Variable::Count].map(|count| self.name(count, ""));
                    let mask = mask.map_or(String::new(), |mask| format!(" & {mask}"));
                    text.push_str(&format!("\n{done} -= {count}{mask};"));
                }
                text
            }
            Statement::Note => style.note.clone(),
            Statement::Clock => style.clock.clone(),
            Statement::RefuseStep => refused(0),
            Statement::RefuseState => refused(1),
        };
        self.line(&text);
    }

    /// Copies g and μ between names with these ends.
    fn state(&self, mask: Option<&str>, ends: [&str; 2]) -> String {
        let copy = |variable: Variable| {
            let [to, from] = ends.map(|end| self.name(variable, end));
            self.language.assign(mask, variable, [&to, &from])
        };
        [Variable::Element, Variable::Momentum].map(copy).join("\n")
    }

    fn call(&mut self, part: Part, block: &Block, mask: Option<&str>) {
        let (inputs, outputs) = part.variables(self.kernel);
        // The loop that a kick is in has other states beside it.
        let beside = if part == Part::Kick { "_kicked" } else { "_next" };
        let (mut names, mut moves) = (Vec::new(), Vec::new());
        for &output in outputs {
            let mut name = self.name(output, "");
            // A value that the program reads, or that may not change in all lanes, is stored beside it first.
            let early = self.language.assigns_early() && inputs.contains(&output);
            if early || (mask.is_some() && !block.owns(output)) {
                self.declare(output, beside, None);
                let next = self.name(output, beside);
                moves.push(self.language.assign(mask, output, [&name, &next]));
                name = next;
            }
            names.push((output, name));
        }
        let inputs: Vec<Name> = inputs.iter().map(|&input| (input, self.name(input, ""))).collect();
        self.line(&self.language.call(part, &inputs, &names));
        moves.iter().for_each(|text| self.line(text));
    }

    /// A loop or a branch; its block has a mask of lanes where the condition is one of lanes.
    fn branch(&mut self, word: &str, tests: &[(bool, Test)], block: &Block, mask: Option<&str>) {
        let all = |of_lanes: bool| -> Vec<String> {
            let own = tests.iter().filter(|one| self.language.of_lanes(one.1) == of_lanes);
            own.map(|&(holds, test)| self.test(holds, test, of_lanes)).collect()
        };
        let (lanes, mut plain) = (all(true), all(false));
        let mut own = None;
        if !lanes.is_empty() {
            self.masks += 1;
            let name = self.language.bound(&format!("lanes{}", self.masks));
            let lanes = self.language.all(&lanes, true);
            let outer = mask.map_or(String::new(), |mask| format!("{mask} & "));
            let [declared, any] = self.language.mask(&name, &format!("{outer}{lanes}"));
            self.line(&declared);
            plain.push(any);
            own = Some((name, lanes));
        }
        let condition = self.language.all(&plain, false);
        self.line(&format!("{word} {condition} {{"));
        self.depth += 4;
        self.block(block, own.as_ref().map(|(name, _)| name.as_str()).or(mask));
        if let Some((name, lanes)) = own.filter(|_| word == "while") {
            self.line(&format!("{name} = {name} & {lanes};"));
        }
        self.depth -= 4;
        self.line("}");
    }

    fn test(&self, holds: bool, test: Test, of_lanes: bool) -> String {
        let (language, style) = (self.language, self.language.style());
        let text = match test {
            Test::Live => style.live.clone(),
            Test::Remaining => {
                format!("{} < {}", self.name(Variable::Done, ""), language.bound("steps"))
            }
            Test::Below(Variable::Flow, most) if of_lanes => {
                format!("counts({}) < {}", Variable::Flow.name(), language.whole(most))
            }
            Test::Below(count, most) => {
                let sign = if holds { "<" } else { ">=" };
                let text = format!("{} {sign} {}", self.name(count, ""), language.whole(most));
                return language.test(true, &text, of_lanes);
            }
            Test::Open => style.open.clone(),
            Test::Right => style.right.clone(),
        };
        language.test(holds, &text, of_lanes)
    }
}

/// The end of the names of a state that is kept.
fn end_of(kept: Kept) -> &'static str {
    match kept {
        Kept::Block => "_start",
        Kept::Step => "_before",
    }
}

/// The loop in C.
struct CLoop<'a, D> {
    kernel: &'a Kernel,
    dialect: &'a D,
    style: &'a LoopStyle,
    /// True if numbers, counts and masks are vectors of lanes.
    lanes: bool,
}

impl<D: Dialect> CLoop<'_, D> {
    fn length(&self, variable: Variable) -> String {
        let [element, dim] = &self.style.sizes;
        match (variable, variable.kind(self.kernel)) {
            (Variable::Element, _) => element.clone(),
            (Variable::Constants, Kind::Array(len)) => len.to_string(),
            (_, Kind::Array(len)) if len != self.kernel.dim => len.to_string(),
            _ => dim.clone(),
        }
    }
}

impl<D: Dialect> Loop for CLoop<'_, D> {
    fn style(&self) -> &LoopStyle {
        self.style
    }

    fn bound(&self, name: &str) -> String {
        name.to_owned()
    }

    fn variable(&self, variable: Variable, name: &str, initial: Option<u32>) -> String {
        let number = &self.dialect.c().number;
        match variable.kind(self.kernel) {
            Kind::Array(len) => {
                let length = if len == 0 { "1".into() } else { self.length(variable) };
                let zeros = initial.map_or("", |_| if self.lanes { " = {{0}}" } else { " = {0}" });
                format!("{number} {name}[{length}]{zeros};")
            }
            Kind::Number => {
                let value = self.dialect.constant(f64::from(initial.unwrap_or(0)));
                format!("{number} {name} = {value};")
            }
            // One number for all lanes.
            Kind::Count if self.lanes && variable == Variable::Flow => {
                format!("unsigned int {name} = 0u;")
            }
            Kind::Count => format!("{} {name} = {};", self.style.count, self.whole(0)),
        }
    }

    fn sum(&self, a: &str, b: &str) -> String {
        self.dialect.operation(Node::Add(Id(0), Id(0)), &[a, b])
    }

    fn whole(&self, value: u32) -> String {
        if self.lanes { format!("counts({value})") } else { format!("{value}u") }
    }

    fn next(&self, count: &str, mask: Option<&str>) -> String {
        mask.map_or_else(|| format!("{count}++;"), |mask| format!("{count} -= {mask};"))
    }

    fn assign(&self, mask: Option<&str>, like: Variable, [to, from]: [&str; 2]) -> String {
        let length = self.length(like);
        match (like.kind(self.kernel), mask) {
            (Kind::Array(_), None) => format!("{}({to}, {from}, {length});", self.style.copy),
            (Kind::Array(_), Some(mask)) => format!("update({mask}, {to}, {from}, {length});"),
            (_, None) => format!("{to} = {from};"),
            (_, Some(mask)) => format!("{to} = pick({mask}, {from}, {to});"),
        }
    }

    fn call(&self, part: Part, inputs: &[Name], outputs: &[Name]) -> String {
        let LoopStyle { slots, slots_of_flow, .. } = self.style;
        let c = self.dialect.c();
        let slots = (!c.slots.is_empty()).then(|| match self.kernel.flows() {
            Some(_) if part.is_of_flow() => {
                format!("&{slots}[{} * {slots_of_flow}]", Variable::Flow.name())
            }
            _ => slots.clone(),
        });
        let input = |(variable, name): &Name| match variable.kind(self.kernel) {
            Kind::Count if self.lanes => format!("__builtin_convertvector({name}, V)"),
            Kind::Count => format!("({}){name}", c.number),
            _ => name.clone(),
        };
        let output = |(variable, name): &Name| match variable.kind(self.kernel) {
            Kind::Number => format!("&{name}"),
            _ => name.clone(),
        };
        let arguments = inputs.iter().map(input).chain(outputs.iter().map(output));
        let arguments: Vec<String> = slots.into_iter().chain(arguments).collect();
        let name = Part::ALL[part as usize].1;
        format!("{}{name}({});", self.style.prefix, arguments.join(", "))
    }

    fn assigns_early(&self) -> bool {
        true
    }

    fn of_lanes(&self, _: Test) -> bool {
        self.lanes
    }

    fn test(&self, holds: bool, test: &str, of_lanes: bool) -> String {
        match (of_lanes, holds) {
            (true, true) => format!("(M)({test})"),
            (true, false) => format!("~(M)({test})"),
            (false, true) => format!("({test})"),
            (false, false) => format!("(!({test}))"),
        }
    }

    fn all(&self, tests: &[String], of_lanes: bool) -> String {
        match tests {
            [one] => one.clone(),
            several => format!("({})", several.join(if of_lanes { " & " } else { " && " })),
        }
    }

    fn mask(&self, name: &str, lanes: &str) -> [String; 2] {
        [format!("M {name} = {lanes};"), format!("(any({name}))")]
    }
}
