//! Emitted code in a crate that calls the runtime `lie`.

#![no_implicit_prelude]
// Lints that people switch on find nothing in emitted code.
#![deny(clippy::pedantic, clippy::nursery)]

/// Free rigid body.
#[::lie::lie_poisson(group = SO3, truncation = 3, crate = ::lie)]
#[must_use]
pub fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

/// A weight on the third axis.
#[::lie::potential(group = SO3, crate = ::lie)]
#[must_use]
pub fn height(g: [[f64; 3]; 3], weight: f64) -> f64 {
    weight * g[2][2]
}

#[test]
fn a_renamed_runtime_integrates() -> ::core::result::Result<(), ::lie::StepError> {
    let step = Body::new(0.1, [1.0, 2.0, 3.0])?;
    let mut state = ::lie::Phase::<::lie::SO3>::at_identity([1.0, 0.2, 0.1]);
    step.advance_by(&mut state, 10)?;
    let height = Height::<f64>::new(2.0)?;
    ::std::assert!(height.energy(&state.group_element).abs() <= 2.0);
    ::core::result::Result::Ok(())
}
