//! Steps by the attribute.

use crate::systems::{SYSTEMS, momenta};
use crate::timing::{Failure, line, medians};

/// Trajectories in lanes.
const BODIES: usize = 1024;
/// Systems that are tried in lanes: the first ones.
const IN_LANES: usize = 2;

/// Prints nanoseconds a step; the ratio is to `advance`.
///
/// # Errors
/// An error if something could not be measured.
pub fn table(quick: bool, only: &str) -> Result<(), Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    println!("Nanoseconds a step (in lanes: of one trajectory), and the ratio to `advance`:\n");
    for (number, system) in SYSTEMS.iter().enumerate() {
        if !system.name.contains(only) {
            continue;
        }
        let mut ways = (system.single)(system.step, system.momentum)?;
        if number < IN_LANES {
            ways.extend((system.lanes)(system.step, momenta(system, BODIES))?);
        }
        let found = medians(&mut ways, if quick { 7 } else { 31 })?;
        let end = (system.end)(system.step, system.momentum)?;
        let digits = |x: &f64| format!("{x:.12}");
        let end: Vec<String> = end.iter().map(digits).collect();
        println!("{} after 1000 steps: {} |", line(system.name, &ways, &found), end.join(", "));
    }
    Ok(())
}
