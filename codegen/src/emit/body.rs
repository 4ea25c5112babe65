//! Programs as straight-line Rust.

use super::scope::Scope;
use super::split::split;
use super::writer::{Body, Writer};
use crate::graph::Program;

/// Writes `program` down, in several functions where it is large.
#[must_use]
pub fn body(program: &Program, scope: &Scope) -> Body {
    if let Some(body) = split(program, scope) {
        return body;
    }
    let mut writer = Writer::new(program, scope);
    for index in 0..program.nodes().len() {
        writer.write(index);
    }
    let outputs = program.outputs().iter().map(|&id| writer.value(id)).collect();
    Body { statements: writer.take_statements(), outputs }
}
