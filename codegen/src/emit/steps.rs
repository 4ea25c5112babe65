//! The loop of a kernel as Rust: its statements, for one number or for lanes of numbers.
//!
//! Lanes move together: a condition holds where it holds in all of them. Only an equation is corrected in the lanes where it
//! is not solved yet, so that each lane computes the bits that it would have alone.

use coadjoint_program::print::{self, Dialect, LoopStyle, fill};
use coadjoint_program::schedule::Test;
use coadjoint_program::{Clock, Kernel};

use crate::emit::program::Rust;

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
        values: true,
        prefix: String::new(),
        declare: ["let mut"; 3].map(String::from),
        as_number: [format!("{c}.of("), " as f64)".to_owned()],
        next: " += 1".to_owned(),
        slots: c.clone(),
        in_lanes: ["choose_all", "choose", "T::any"].map(String::from),
        of_lanes: |test| test == Test::Open,
        open: format!("open({c}, {bound}, {distance})"),
        right: ["!", ""].map(|not| format!("{not}is_one({c}, {})", name("right"))),
        refuse: [refused(&found), refused("None")],
        clock,
        note: format!("{driven}.note({tried}, {bound});"),
        live: live.clone(),
        ..LoopStyle::default()
    };
    let values = [
        ("STEPS", print::steps(kernel, dialect, &style, 4)),
        ("ROUNDINGS", format!("{:?}", kernel.tolerance / kernel.precision().epsilon())),
        ("NEAR", format!("{:?}", kernel.near)),
        ("ELEMENT", kernel.element.to_string()),
        ("DIM", kernel.dim.to_string()),
        ("CLOCK", kernel.clock().is_some().to_string()),
    ];
    fill(&include_str!("steps.in").replace('@', &dialect.bound("")), &values)
}
