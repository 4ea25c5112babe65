//! The loop of steps, that of [`coadjoint_program::Kernel::advance`].

use super::dialect::decimal;
use super::names::Names;
use super::template::{DRIVE, FRAME};
use crate::step::Step;

/// The functions that make steps.
pub fn functions(step: &Step, names: &Names) -> String {
    let kernel = step.kernel();
    let frame = if kernel.programs().frame.is_some() { FRAME } else { "" };
    let text = DRIVE
        .replace("/*FRAME*/", frame)
        .replace("/*CONSTANTS*/", &kernel.constants().max(1).to_string())
        .replace("/*CORRECTIONS*/", &format!("{}u", kernel.corrections()))
        .replace("/*TOLERANCE*/", &decimal(kernel.tolerance()))
        .replace("/*NEAR*/", &decimal(kernel.near()));
    names.fill(&text)
}
