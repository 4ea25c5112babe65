//! The problems: exact equations, attitude included, with initial state and converged reference.

mod field;
mod free_body;
mod moving_body;
mod reference;
mod translation;

pub use field::VectorField;
pub use free_body::FreeBody;
pub use moving_body::MovingBody;
pub use reference::{ReferenceError, end_state};
pub use translation::{Gravity, Mass, Translation};

use crate::{
    arithmetic::Vector,
    state::{Rotation, Scale, State},
};

/// The equations of a problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum System {
    /// The free body.
    FreeBody(FreeBody),
    /// A top whose centre of mass lies on the second axis.
    HeavyTop(MovingBody<Gravity<1>>),
    /// A body in an ideal fluid.
    Kirchhoff(MovingBody<Mass>),
    /// A top whose centre of mass lies on the first axis.
    Kovalevskaya(MovingBody<Gravity<0>>),
}

/// One initial value problem.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The name on the command line and in files.
    pub name: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// The equations.
    pub system: System,
    /// The state at time 0.
    pub initial: State,
    /// Where the integration ends.
    pub end: f64,
    /// The state there, converged to more digits than an `f64` holds.
    pub reference: State,
    /// The units of errors.
    pub scale: Scale,
    /// A time over which the body turns by about a radian; sweeps of step sizes are centred on it.
    pub time_scale: f64,
}

const NAMES: [&str; 7] = [
    "free-body-a",
    "free-body-b",
    "heavy-top",
    "kirchhoff",
    "kovalevskaya",
    "kirchhoff-long",
    "kovalevskaya-long",
];
const INERTIA: Vector = [1.5, 2.0, 2.5];

/// Every problem.
///
/// # Errors
/// When a reference is missing.
pub fn all() -> Result<Vec<Problem>, ReferenceError> {
    NAMES.iter().map(|name| named(name)).collect()
}

/// The problem of that name.
///
/// # Errors
/// When there is none.
pub fn named(name: &str) -> Result<Problem, ReferenceError> {
    let unit = Scale { momentum: 1.0, position: 1.0 };
    let missing = || ReferenceError::Missing(name.to_owned());
    let name = *NAMES.iter().find(|&&known| known == name).ok_or_else(missing)?;
    let (title, system, momentum, force, scale, time_scale) = match name {
        "free-body-a" => ("free body A", free_body(), [2.0, 0.5, 1.0], [0.0; 3], unit, 0.8),
        "free-body-b" => ("free body B", free_body(), [1.2, 2.5, 0.6], [0.0; 3], unit, 0.8),
        "heavy-top" => (
            "heavy top (Brüls, Cardona, Arnold 2012)",
            System::HeavyTop(MovingBody {
                inverse_inertia: [64.0 / 975.0, 32.0 / 15.0, 64.0 / 975.0],
                translation: Gravity { weight: 147.15 },
            }),
            [0.0, 70.3125, -70.3124296875],
            [0.0, 0.0, 1.0],
            // Momenta near 100 and positions near 100: compared as fractions of that.
            Scale { momentum: 100.0, position: 100.0 },
            0.008,
        ),
        "kirchhoff" | "kirchhoff-long" => (
            "Kirchhoff's body in a fluid",
            System::Kirchhoff(MovingBody {
                inverse_inertia: [1.0, 0.5, 1.0 / 3.0],
                translation: Mass { inverse: [1.0, 0.5, 0.25] },
            }),
            [1.0, 0.5, 0.2],
            [0.3, 0.4, 0.5],
            unit,
            0.8,
        ),
        "kovalevskaya" | "kovalevskaya-long" => (
            "Kovalevskaya's top",
            System::Kovalevskaya(MovingBody {
                inverse_inertia: [0.5, 0.5, 1.0],
                translation: Gravity { weight: 1.0 },
            }),
            [2.0, 3.0, 4.0],
            [1.0, 0.0, 0.0],
            unit,
            0.25,
        ),
        _ => return Err(missing()),
    };
    let (end, reference) = end_state(name)?;
    let initial = State {
        momentum,
        force,
        rotation: Rotation::Quaternion([1.0, 0.0, 0.0, 0.0]),
        position: [0.0; 3],
    };
    Ok(Problem { name, title, system, initial, end, reference, scale, time_scale })
}

fn free_body() -> System {
    System::FreeBody(FreeBody::new(INERTIA))
}
