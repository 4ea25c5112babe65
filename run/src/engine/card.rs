//! Steps for devices: compiled, or as a text.

use coadjoint_codegen::step::{Origin, Step};
use coadjoint_native::cards::{Card, Device};
use coadjoint_program::Precision;
use coadjoint_program::print::{DeviceLanguage, device_unit};

use super::compiled::coefficients;
use crate::error::RunError;
use crate::grid::Grid;

/// Programs of more operations than this are not compiled for devices.
const MOST_OPERATIONS: usize = 60_000;

/// The programs of a step in this precision, and their folded coefficients. `option` is what the user asked for them by.
fn programs(
    origin: &Origin,
    step_size: f64,
    precision: Precision,
    option: &str,
) -> Result<(Step, Vec<f64>), RunError> {
    let failed = |why: &dyn std::fmt::Display| RunError::Option(format!("{option}: {why}"));
    if !origin.breaks().is_empty() {
        return Err(failed(&"steps that end at breaks are not made on devices"));
    }
    let step = origin.step(precision).map_err(|error| failed(&error))?;
    if step.moves() && step.kernel().clock().is_none() {
        return Err(failed(
            &"steps that depend on inputs, or have kicks and depend on time, are not made on devices",
        ));
    }
    let programs = &step.kernel().programs;
    let operations = programs.correct.nodes().len() + programs.transport.nodes().len();
    if operations > MOST_OPERATIONS {
        return Err(failed(&format_args!(
            "a step has {operations} operations, more than the {MOST_OPERATIONS} that are compiled; lower the truncation"
        )));
    }
    let slots = coefficients(&step, step_size, &[]).map_err(RunError::unmade)?;
    Ok((step, slots))
}

/// Steps of this grid on this device, in numbers of this precision.
///
/// # Errors
/// Fails if they are not made of programs, or the device cannot be had.
pub(crate) fn card(
    origin: &Origin,
    grid: Grid,
    device: Device,
    precision: Precision,
) -> Result<Card, RunError> {
    let (step, slots) = programs(origin, grid.step, precision, "--device")?;
    let card = Card::new(device, &step.kernel().clone().starting_at(grid.start), &slots);
    card.map_err(|error| RunError::Option(format!("--device: {error}")))
}

/// The kernel that makes steps of this size, as a text that says `about` of itself.
///
/// # Errors
/// Fails if they are not made of programs.
pub(crate) fn device_text(
    origin: &Origin,
    step_size: f64,
    precision: Precision,
    language: DeviceLanguage,
    about: &str,
) -> Result<String, RunError> {
    let (step, slots) = programs(origin, step_size, precision, "--language")?;
    Ok(device_unit(step.kernel(), &slots, language, about))
}
