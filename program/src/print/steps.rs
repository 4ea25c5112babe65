//! The loop of a kernel in C and languages like it.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use crate::graph::{Id, Node};
use crate::kernel::Kernel;
use crate::print::c::Dialect;
use crate::schedule::{Block, Kept, Kind, Part, Statement, Test, Variable};

/// The words of a language for the loop. The function around it has g, μ, `steps` and whatever `live` reads.
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

/// The style of a unit of C; a function around it declares `bool live`.
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

/// The statements of the loop in a dialect; lines begin with `depth` spaces.
pub fn steps(kernel: &Kernel, dialect: &impl Dialect, style: &LoopStyle, depth: usize) -> String {
    let lanes = style.count == "M";
    let mut writer = Writer { kernel, dialect, style, lanes, depth, masks: 0, text: String::new() };
    writer.block(kernel.schedule(), None);
    writer.text
}

struct Writer<'a, D> {
    kernel: &'a Kernel,
    dialect: &'a D,
    style: &'a LoopStyle,
    lanes: bool,
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

    fn nested(&mut self, head: &str, block: &Block, mask: Option<&str>) {
        self.line(&format!("{head} {{"));
        self.depth += 4;
        self.block(block, mask);
        self.depth -= 4;
        self.line("}");
    }

    fn whole(&self, value: u32) -> String {
        if self.lanes { format!("counts({value})") } else { format!("{value}u") }
    }

    fn length(&self, variable: Variable) -> String {
        let [element, dim] = &self.style.sizes;
        match variable {
            Variable::Element => element.clone(),
            _ => match variable.kind(self.kernel) {
                Kind::Array(len) if len != self.kernel.dim || variable == Variable::Constants => {
                    len.to_string()
                }
                _ => dim.clone(),
            },
        }
    }

    fn declare(&mut self, variable: Variable, end: &str, initial: Option<u32>) {
        let name = variable.name();
        let LoopStyle { count, .. } = self.style;
        let number = &self.dialect.c().number;
        let text = match (variable.kind(self.kernel), initial) {
            (Kind::Array(len), initial) => {
                let length = if len == 0 { "1".into() } else { self.length(variable) };
                let zeros = initial.map_or("", |_| if self.lanes { " = {{0}}" } else { " = {0}" });
                format!("{number} {name}{end}[{length}]{zeros};")
            }
            (Kind::Number, initial) => {
                let value = self.dialect.constant(f64::from(initial.unwrap_or(0)));
                format!("{number} {name}{end} = {value};")
            }
            (Kind::Count, _) if self.shared(variable) => format!("unsigned int {name} = 0u;"),
            (Kind::Count, _) => format!("{count} {name} = {};", self.whole(0)),
        };
        self.line(&text);
    }

    /// True if a count is one number for all lanes.
    fn shared(&self, count: Variable) -> bool {
        self.lanes && count == Variable::Flow
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
        let refused = |step: usize| match mask {
            None => self.style.refuse[step].clone(),
            Some(mask) => format!("live &= ~{mask};"),
        };
        let text = match statement {
            Statement::Call(part) => return self.call(*part, block, mask),
            Statement::While(condition, block) | Statement::If(condition, block) => {
                let repeats = matches!(statement, Statement::While(..));
                let condition = self.condition(condition);
                if !self.lanes {
                    let word = if repeats { "while" } else { "if" };
                    return self.nested(&format!("{word} {condition}"), block, None);
                }
                self.masks += 1;
                let name = format!("lanes{}", self.masks);
                let outer = mask.map_or(String::new(), |mask| format!("{mask} & "));
                let begin = format!("for (M {name} = {outer}{condition}; any({name}); {name} ");
                let next = if repeats { format!("&= {condition})") } else { "= (M){0})".into() };
                return self.nested(&(begin + &next), block, Some(&name));
            }
            Statement::Lengthen => {
                let sum = self.dialect.operation(Node::Add(Id(0), Id(0)), &["distance", "moved"]);
                self.copy(mask, Variable::Distance, "distance", &sum)
            }
            Statement::Next(variable) => match mask.filter(|_| !self.shared(*variable)) {
                None => format!("{}++;", variable.name()),
                Some(mask) => format!("{} -= {mask};", variable.name()),
            },
            Statement::Keep(kept) => {
                let end = end_of(*kept);
                self.declare(Variable::Element, end, None);
                self.declare(Variable::Momentum, end, None);
                self.state(mask, [end, ""])
            }
            Statement::Restore(kept) => {
                let mut text = self.state(mask, ["", end_of(*kept)]);
                if *kept == Kept::Block {
                    let count = mask.map_or("count".into(), |mask| format!("count & {mask}"));
                    text.push_str(&format!("\ndone -= {count};"));
                }
                text
            }
            Statement::Note => self.style.note.clone(),
            Statement::Clock => self.style.clock.clone(),
            Statement::RefuseStep => refused(0),
            Statement::RefuseState => refused(1),
        };
        self.line(&text);
    }

    /// Copies g and μ between names with these ends.
    fn state(&self, mask: Option<&str>, [to, from]: [&str; 2]) -> String {
        let copy = |variable: Variable| {
            let name = variable.name();
            self.copy(mask, variable, &format!("{name}{to}"), &format!("{name}{from}"))
        };
        [Variable::Element, Variable::Momentum].map(copy).join("\n")
    }

    /// Assigns an array, or a number, in the lanes of a mask.
    fn copy(&self, mask: Option<&str>, like: Variable, to: &str, from: &str) -> String {
        let length = self.length(like);
        match (like.kind(self.kernel), mask) {
            (Kind::Array(_), None) => format!("{}({to}, {from}, {length});", self.style.copy),
            (Kind::Array(_), Some(mask)) => format!("update({mask}, {to}, {from}, {length});"),
            (_, None) => format!("{to} = {from};"),
            (_, Some(mask)) => format!("{to} = pick({mask}, {from}, {to});"),
        }
    }

    fn call(&mut self, part: Part, block: &Block, mask: Option<&str>) {
        let (inputs, outputs) = part.variables(self.kernel);
        let input = |variable: &Variable| match variable.kind(self.kernel) {
            Kind::Count if self.lanes => {
                format!("__builtin_convertvector({}, V)", variable.name())
            }
            Kind::Count => format!("({}){}", self.dialect.c().number, variable.name()),
            _ => variable.name().into(),
        };
        let mut arguments: Vec<String> = inputs.iter().map(input).collect();
        if !self.dialect.c().slots.is_empty() {
            let LoopStyle { slots, slots_of_flow, .. } = self.style;
            let flow = Variable::Flow.name();
            arguments.insert(
                0,
                match self.kernel.flows() {
                    Some(_) if part.is_of_flow() => format!("&{slots}[{flow} * {slots_of_flow}]"),
                    _ => slots.clone(),
                },
            );
        }
        // The loop that a kick is in has other states beside it.
        let beside = if part == Part::Kick { "_kicked" } else { "_next" };
        let mut moves = Vec::new();
        for &output in outputs {
            let mut name = output.name().to_string();
            // A value that the program reads, or that may not change in all lanes, is stored beside it first.
            if inputs.contains(&output) || (self.lanes && !block.owns(output)) {
                self.declare(output, beside, None);
                let next = format!("{name}{beside}");
                moves.push(self.copy(mask, output, &name, &next));
                name = next;
            }
            let reference = if output.kind(self.kernel) == Kind::Number { "&" } else { "" };
            arguments.push(format!("{reference}{name}"));
        }
        let name = Part::ALL[part as usize].1;
        self.line(&format!("{}{name}({});", self.style.prefix, arguments.join(", ")));
        moves.iter().for_each(|text| self.line(text));
    }

    /// A condition in parentheses.
    fn condition(&self, condition: &[(bool, Test)]) -> String {
        let style = self.style;
        let test = |&(holds, test): &(bool, Test)| {
            let text = match test {
                Test::Live => style.live.clone(),
                Test::Remaining => "done < steps".into(),
                Test::Below(a, b) => {
                    let sign = if holds { "<" } else { ">=" };
                    let name = if self.shared(a) {
                        format!("counts({})", a.name())
                    } else {
                        a.name().into()
                    };
                    return format!("({name} {sign} {})", self.whole(b));
                }
                Test::Open => style.open.clone(),
                Test::Right => style.right.clone(),
            };
            match (self.lanes, holds) {
                (true, true) => format!("(M)({text})"),
                (true, false) => format!("~(M)({text})"),
                (false, true) => format!("({text})"),
                (false, false) => format!("(!({text}))"),
            }
        };
        if let [one] = condition {
            return test(one);
        }
        let list: Vec<String> = condition.iter().map(test).collect();
        format!("({})", list.join(if self.lanes { " & " } else { " && " }))
    }
}

/// The end of the names of a state that is kept.
fn end_of(kept: Kept) -> &'static str {
    match kept {
        Kept::Block => "_start",
        Kept::Step => "_before",
    }
}
