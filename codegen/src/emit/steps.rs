//! The loop of a kernel as Rust: its statements, for one number or for lanes of numbers.
//!
//! Lanes move together: a condition holds where it holds in all of them. Only an equation is corrected in the lanes where it
//! is not solved yet, so that each lane computes the bits that it would have alone.

use coadjoint_program::print::{Dialect, Loop, LoopStyle, Name, fill, statements};
use coadjoint_program::schedule::{Kind, Part, Test, Variable};
use coadjoint_program::{Clock, Kernel};

use crate::emit::program::{Rust, tuple};

/// The functions `open` and `steps` of a kernel.
pub(crate) fn steps(kernel: &Kernel, dialect: &Rust<'_>) -> String {
    let name = |name: &str| dialect.bound(name);
    let [c, live, driven, tried] = ["c", "live", "driven", "tried"].map(name);
    let [time, done] = ["time", "done"].map(name);
    let [bound, distance] = ["residual_bound", "distance"].map(name);
    let refused = |reason: &str| {
        format!("{driven}.refused = ::core::option::Option::{reason};\n{live} = false;")
    };
    // The increment alone is of use to those who make the step by other means.
    let found = match kernel.solution == kernel.dim {
        true => format!("Some(({}, {distance}))", name("x")),
        false => "None".to_owned(),
    };
    let clock = kernel.clock().map_or_else(String::new, |Clock { size, first, times, .. }| {
        let now = format!("{time} + {c}.of({done} as f64) * {c}.at({size})");
        format!("let {c} = plumbing::timed({c}, [{size}, {first}], {now}, {times:?});")
    });
    let style = LoopStyle {
        open: format!("open({c}, {bound}, {distance})"),
        right: format!("is_one({c}, {})", name("right")),
        refuse: [refused(&found), refused("None")],
        clock,
        note: format!("{driven}.note({tried}, {bound});"),
        live: live.clone(),
        ..LoopStyle::default()
    };
    let values = [
        ("STEPS", statements(kernel, &RustLoop { kernel, dialect, style }, 4)),
        ("ROUNDINGS", format!("{:?}", kernel.tolerance / kernel.precision().epsilon())),
        ("NEAR", format!("{:?}", kernel.near)),
        ("ELEMENT", kernel.element.to_string()),
        ("DIM", kernel.dim.to_string()),
        ("CLOCK", if kernel.clock().is_some() { "1" } else { "" }.to_owned()),
    ];
    fill(&include_str!("steps.in").replace('@', &dialect.bound("")), &values)
}

struct RustLoop<'a> {
    kernel: &'a Kernel,
    dialect: &'a Rust<'a>,
    style: LoopStyle,
}

impl Loop for RustLoop<'_> {
    fn style(&self) -> &LoopStyle {
        &self.style
    }

    fn bound(&self, name: &str) -> String {
        self.dialect.bound(name)
    }

    fn variable(&self, variable: Variable, name: &str, initial: Option<u32>) -> String {
        let number = |initial: u32| self.dialect.constant(f64::from(initial));
        match (variable.kind(self.kernel), initial) {
            (Kind::Count, _) => format!("let mut {name}: u64 = {};", initial.unwrap_or(0)),
            (_, None) => format!("let mut {name};"),
            (Kind::Array(len), Some(initial)) => {
                format!("let mut {name} = [{}; {len}];", number(initial))
            }
            (Kind::Number, Some(initial)) => format!("let mut {name} = {};", number(initial)),
        }
    }

    fn sum(&self, a: &str, b: &str) -> String {
        format!("{a} + {b}")
    }

    fn whole(&self, value: u32) -> String {
        value.to_string()
    }

    fn next(&self, count: &str, _: Option<&str>) -> String {
        format!("{count} += 1;")
    }

    fn assign(&self, mask: Option<&str>, like: Variable, [to, from]: [&str; 2]) -> String {
        match (mask, like.kind(self.kernel)) {
            (None, _) => format!("{to} = {from};"),
            (Some(mask), Kind::Array(_)) => format!("{to} = choose_all({mask}, {from}, {to});"),
            (Some(mask), _) => format!("{to} = choose({mask}, {from}, {to});"),
        }
    }

    fn call(&self, part: Part, inputs: &[Name], outputs: &[Name]) -> String {
        let c = self.bound("c");
        let inputs = inputs.iter().map(|(variable, name)| match variable.kind(self.kernel) {
            Kind::Array(_) => format!(", &{name}"),
            Kind::Number => format!(", {name}"),
            Kind::Count => format!(", {c}.of({name} as f64)"),
        });
        let inputs: String = inputs.collect();
        let call = self.dialect.apart(&format!("{}({c}{inputs})", Part::ALL[part as usize].1));
        let outputs: Vec<String> = outputs.iter().map(|(_, name)| name.clone()).collect();
        format!("{} = {call};", tuple(&outputs))
    }

    fn assigns_early(&self) -> bool {
        false
    }

    fn of_lanes(&self, test: Test) -> bool {
        test == Test::Open
    }

    fn test(&self, holds: bool, test: &str, _: bool) -> String {
        if holds { test.to_owned() } else { format!("!{test}") }
    }

    fn all(&self, tests: &[String], of_lanes: bool) -> String {
        tests.join(if of_lanes { " & " } else { " && " })
    }

    fn mask(&self, name: &str, lanes: &str) -> [String; 2] {
        [format!("let mut {name} = {lanes};"), format!("T::any({name})")]
    }
}
