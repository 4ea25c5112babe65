//! The steps of an interpreter for devices: compiled, or as a text.

use coadjoint::LieGroup;
use coadjoint::groups::Chart;
use coadjoint_codegen::graph::Arithmetic;
use coadjoint_codegen::step::Step;
use coadjoint_native::cards::{Card, Device};
use coadjoint_program::Precision;
use coadjoint_program::print::{DeviceLanguage, device_unit};

use super::Interpreter;
use super::compiled::MOST_OPERATIONS;
use crate::error::RunError;

/// The programs of a step in this precision, and their folded coefficients. `option` is what the user asked for them by.
fn programs<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>>(
    interpreter: &Interpreter<'_, G, C>,
    precision: Precision,
    option: &str,
) -> Result<(Step, Vec<f64>), RunError> {
    let failed = |why: &dyn std::fmt::Display| RunError::Option(format!("{option}: {why}"));
    let step = Step::build_in(interpreter.integrator, precision);
    let step = step.map_err(|error| failed(&error))?;
    let programs = step.kernel().programs();
    let operations = programs.correct.nodes().len() + programs.transport.nodes().len();
    if operations > MOST_OPERATIONS {
        return Err(failed(&format_args!(
            "a step has {operations} operations, more than the {MOST_OPERATIONS} that are compiled; lower the truncation"
        )));
    }
    let slots = interpreter.slots[..=step.radius_at()].to_vec();
    Ok((step, slots))
}

/// The steps of `interpreter` on this device, in numbers of this precision.
///
/// # Errors
/// Where they are not made of programs, or the device cannot be had.
pub fn card<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>>(
    interpreter: &Interpreter<'_, G, C>,
    device: Device,
    precision: Precision,
) -> Result<Card, RunError> {
    let (step, slots) = programs(interpreter, precision, "--device")?;
    let card = Card::new(device, step.kernel(), &slots);
    card.map_err(|error| RunError::Option(format!("--device: {error}")))
}

/// The kernel that makes the steps of `interpreter`, as a text that says `about` of itself.
///
/// # Errors
/// Where they are not made of programs.
pub fn device_text<G: LieGroup<Scalar: Arithmetic>, C: Chart<G>>(
    interpreter: &Interpreter<'_, G, C>,
    precision: Precision,
    language: DeviceLanguage,
    about: &str,
) -> Result<String, RunError> {
    let (step, slots) = programs(interpreter, precision, "--language")?;
    Ok(device_unit(step.kernel(), &slots, language, about))
}
