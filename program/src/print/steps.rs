//! The loop of a kernel as statements, in any language.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::graph::{Id, Node};
use crate::kernel::Kernel;
use crate::print::c::Dialect;
use crate::schedule::{Block, Kept, Kind, Part, Statement, Test, Variable};

/// The words of a language for the loop; the default is the style of a unit of C. The function around the loop has g, μ,
/// `steps` and what the word `live` reads.
#[derive(Clone, Debug)]
pub struct LoopStyle {
    /// True where arrays are assigned and returned as values, as in Rust, and not by pointers, as in C.
    pub values: bool,
    /// The prefix of the names of programs.
    pub prefix: String,
    /// The words before the name of a number or an array that is declared, before that of a count, and before that of a mask.
    pub declare: [String; 3],
    /// The text around a count that a program reads as a number.
    pub as_number: [String; 2],
    /// The text that adds 1 to the count before it.
    pub next: String,
    /// The list of the coefficients.
    pub slots: String,
    /// The number of coefficients that one flow reads.
    pub slots_of_flow: String,
    /// The name of a function that copies (to, from, length).
    pub copy: String,
    /// The names of functions that assign arrays and numbers in the lanes of a mask, and of one that says if it has any.
    pub in_lanes: [String; 3],
    /// True for a test that has an answer for each lane.
    pub of_lanes: fn(Test) -> bool,
    /// The condition under which a trajectory moves on.
    pub live: String,
    /// The condition under which an equation is corrected again: not solved to the tolerance, near the guess.
    pub open: String,
    /// The conditions that a program's answer is not 1, and that it is.
    pub right: [String; 2],
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
            values: false,
            prefix: "scalar_".into(),
            declare: ["double", "unsigned long long", ""].map(String::from),
            as_number: ["(double)", ""].map(String::from),
            next: "++".into(),
            slots: "c".into(),
            slots_of_flow: "SLOTS".into(),
            copy: "copy".into(),
            in_lanes: [const { String::new() }; 3],
            of_lanes: |_| false,
            live: "live".into(),
            open: "!(residual_bound <= TOLERANCE) && distance <= NEAR".into(),
            right: ["right != 1.0", "right == 1.0"].map(String::from),
            refuse: ["live = false;", "live = false;"].map(String::from),
            note: String::new(),
            clock: String::new(),
        }
    }
}

/// The statements of the loop; lines begin with `depth` spaces.
pub fn steps(kernel: &Kernel, dialect: &impl Dialect, style: &LoopStyle, depth: usize) -> String {
    let mut writer = Writer { kernel, dialect, style, depth, masks: 0, text: String::new() };
    writer.block(kernel.schedule(), None);
    writer.text
}

struct Writer<'a, D> {
    kernel: &'a Kernel,
    dialect: &'a D,
    style: &'a LoopStyle,
    depth: usize,
    /// The number of named masks.
    masks: usize,
    text: String,
}

impl<D: Dialect> Writer<'_, D> {
    fn line(&mut self, text: &str) {
        for line in text.lines() {
            self.text.push_str(&format!("{:1$}{line}\n", "", self.depth));
        }
    }

    fn name(&self, variable: Variable, end: &str) -> String {
        self.dialect.bound(&format!("{}{end}", variable.name()))
    }

    /// True if a variable is a count, and lanes have one each.
    fn counts_lanes(&self, variable: Variable) -> bool {
        (self.style.of_lanes)(Test::Below(variable, 0))
    }

    /// A known number for a count.
    fn whole(&self, count: Variable, value: u32) -> String {
        match (self.counts_lanes(count), self.style.values) {
            (true, _) => format!("counts({value})"),
            (_, true) => value.to_string(),
            (_, false) => format!("{value}u"),
        }
    }

    fn declare(&mut self, variable: Variable, end: &str, initial: Option<u32>) {
        let (name, values) = (self.name(variable, end), self.style.values);
        let [of_number, of_count, of_mask] = &self.style.declare;
        let number = self.dialect.constant(f64::from(initial.unwrap_or(0)));
        let text = match (variable.kind(self.kernel), initial) {
            (Kind::Count, _) => {
                let of = if self.counts_lanes(variable) { of_mask } else { of_count };
                format!("{of} {name} = {};", self.whole(variable, 0))
            }
            (_, None) if values => format!("{of_number} {name};"),
            (Kind::Array(len), _) if values => format!("{of_number} {name} = [{number}; {len}];"),
            (Kind::Array(len), _) => {
                let zeros = initial.map_or("", |_| " = {0}");
                format!("{of_number} {name}[{}]{zeros};", len.max(1))
            }
            (Kind::Number, _) => format!("{of_number} {name} = {number};"),
        };
        self.line(&text);
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
        let style = self.style;
        let refused = |step: usize| match mask {
            None => style.refuse[step].clone(),
            Some(mask) => format!("live &= ~{mask};"),
        };
        let text = match statement {
            Statement::Call(part) => return self.call(*part, block, mask),
            Statement::While(tests, block) => return self.branch("while", tests, block, mask),
            Statement::If(tests, block) => return self.branch("if", tests, block, mask),
            Statement::Lengthen => {
                let [distance, moved] =
                    [Variable::Distance, Variable::Moved].map(|variable| self.name(variable, ""));
                let sum = self.dialect.operation(Node::Add(Id(0), Id(0)), &[&distance, &moved]);
                self.assign(mask, Variable::Distance, [&distance, &sum])
            }
            Statement::Next(count) => match mask.filter(|_| self.counts_lanes(*count)) {
                Some(mask) => format!("{} -= {mask};", self.name(*count, "")),
                None => format!("{}{};", self.name(*count, ""), style.next),
            },
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

    /// The statement that assigns to a variable like this one, in the lanes of a mask.
    fn assign(&self, mask: Option<&str>, like: Variable, [to, from]: [&str; 2]) -> String {
        let LoopStyle { copy, in_lanes: [update, pick, _], .. } = self.style;
        match (like.kind(self.kernel), mask) {
            (Kind::Array(len), None) if !self.style.values => {
                format!("{copy}({to}, {from}, {len}u);")
            }
            (Kind::Array(len), Some(mask)) if !self.style.values => {
                format!("{update}({mask}, {to}, {from}, {len}u);")
            }
            (_, None) => format!("{to} = {from};"),
            (Kind::Array(_), Some(mask)) => format!("{to} = {update}({mask}, {from}, {to});"),
            (_, Some(mask)) => format!("{to} = {pick}({mask}, {from}, {to});"),
        }
    }

    /// Copies g and μ between names with these ends.
    fn state(&self, mask: Option<&str>, ends: [&str; 2]) -> String {
        let copy = |variable: Variable| {
            let [to, from] = ends.map(|end| self.name(variable, end));
            self.assign(mask, variable, [&to, &from])
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
            // A value that is read through a pointer, or that may not change in all lanes, is stored beside it first.
            let early = !self.style.values && inputs.contains(&output);
            if early || (mask.is_some() && !block.owns(output)) {
                self.declare(output, beside, None);
                let next = self.name(output, beside);
                moves.push(self.assign(mask, output, [&name, &next]));
                name = next;
            }
            let pointer = output.kind(self.kernel) == Kind::Number && !self.style.values;
            names.push(if pointer { format!("&{name}") } else { name });
        }
        let LoopStyle { slots, slots_of_flow, .. } = self.style;
        let slots = (!self.dialect.c().slots.is_empty()).then(|| match self.kernel.flows() {
            Some(_) if part.is_of_flow() => {
                format!("&{slots}[{} * {slots_of_flow}]", Variable::Flow.name())
            }
            _ => slots.clone(),
        });
        let input = |&variable: &Variable| {
            let (name, [before, after]) = (self.name(variable, ""), &self.style.as_number);
            match variable.kind(self.kernel) {
                Kind::Count => format!("{before}{name}{after}"),
                Kind::Array(_) if self.style.values => format!("&{name}"),
                _ => name,
            }
        };
        let mut arguments: Vec<String> =
            slots.into_iter().chain(inputs.iter().map(input)).collect();
        let function = format!("{}{}", self.style.prefix, Part::ALL[part as usize].1);
        if self.style.values {
            let call = self.dialect.apart(&format!("{function}({})", arguments.join(", ")));
            self.line(&format!("{} = {call};", tuple(&names)));
        } else {
            arguments.extend(names);
            self.line(&format!("{function}({});", arguments.join(", ")));
        }
        moves.iter().for_each(|text| self.line(text));
    }

    /// A loop or a branch; its block has a mask of lanes where the condition is one of lanes.
    fn branch(&mut self, word: &str, tests: &[(bool, Test)], block: &Block, mask: Option<&str>) {
        let style = self.style;
        let all = |of_lanes: bool| -> Vec<String> {
            let own = tests.iter().filter(|one| (style.of_lanes)(one.1) == of_lanes);
            own.map(|&(holds, test)| self.test(holds, test)).collect()
        };
        let (lanes, mut plain) = (all(true).join(" & "), all(false));
        let mut own = None;
        if !lanes.is_empty() {
            self.masks += 1;
            let name = self.dialect.bound(&format!("lanes{}", self.masks));
            let outer = mask.map_or(String::new(), |mask| format!("{mask} & "));
            self.line(&format!("{} {name} = {outer}{lanes};", style.declare[2]));
            plain.push(format!("{}({name})", style.in_lanes[2]));
            own = Some(name);
        }
        let condition = match (style.values, &plain[..]) {
            (true, tests) => tests.join(" && "),
            (false, [test]) => format!("({test})"),
            // Rule 12.1 of MISRA asks for all of these.
            (false, tests) => format!("(({}))", tests.join(") && (")),
        };
        self.line(&format!("{word} {condition} {{"));
        self.depth += 4;
        self.block(block, own.as_deref().or(mask));
        if let Some(name) = own.filter(|_| word == "while") {
            self.line(&format!("{name} = {name} & {lanes};"));
        }
        self.depth -= 4;
        self.line("}");
    }

    fn test(&self, holds: bool, test: Test) -> String {
        let style = self.style;
        let text = match test {
            Test::Live => style.live.clone(),
            Test::Remaining => {
                format!("{} < {}", self.name(Variable::Done, ""), self.dialect.bound("steps"))
            }
            Test::Below(count, most) => {
                let sign = if holds { "<" } else { ">=" };
                format!("{} {sign} {}", self.name(count, ""), self.whole(count, most))
            }
            Test::Open => style.open.clone(),
            Test::Right => style.right[usize::from(holds)].clone(),
        };
        match (style.of_lanes)(test) && !style.values {
            true => format!("(M)({text})"),
            false => text,
        }
    }
}

/// One text, or several as a tuple.
pub fn tuple(texts: &[String]) -> String {
    match texts {
        [one] => one.clone(),
        several => format!("({})", several.join(", ")),
    }
}

/// The end of the names of a state that is kept.
fn end_of(kept: Kept) -> &'static str {
    match kept {
        Kept::Block => "_start",
        Kept::Step => "_before",
    }
}
