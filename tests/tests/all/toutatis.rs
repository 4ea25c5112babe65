//! Asteroid 4179 Toutatis: the state from radar data, and the light curve's frequencies.
#![allow(clippy::expect_used)]

use coadjoint::StepError;
use coadjoint_tests::toutatis::{
    Geometry, LongAxisMode, MEASURED, PRECESSION, ROTATION, light_curve, spectrum,
};

/// The largest error of the measured frequencies.
const UNCERTAINTY: f64 = 0.008;

fn mode() -> LongAxisMode {
    LongAxisMode::with_periods(ROTATION, PRECESSION).expect("a long-axis mode")
}

#[test]
fn the_state_has_the_periods_of_hudson_and_ostro() {
    let mode = mode();
    assert!((mode.rotation_period() - ROTATION).abs() < 1e-9);
    assert!((mode.precession_period() - PRECESSION).abs() < 1e-9);
    // A long-axis mode: L² between 2 E I₁ and 2 E I₂.
    let x = mode.momentum_squared / mode.twice_energy;
    assert!(1.0 < x && x < 3.09, "{x}");
    // The long axis precesses slowest, I₂/I₁ − 1 ≈ 2.1 rotations, where the body hardly tumbles.
    assert!(LongAxisMode::with_periods(5.41, 2.3 * 5.41).is_none());
}

#[test]
fn the_motion_is_jacobis() -> Result<(), StepError> {
    let mode = mode();
    let error = |step: f64, samples: usize| -> Result<f64, StepError> {
        let curve = light_curve(&mode, &Geometry::fixed(), (step, 1), samples)?;
        let closed = mode.closed_form().momentum(step * samples as f64);
        assert!(curve.drift < 1e-14, "{}", curve.drift);
        assert!(curve.casimir_drift < 1e-14, "{}", curve.casimir_drift);
        Ok((curve.end.momentum - closed).norm() / closed.norm())
    };
    let (coarse, fine) = (error(0.5, 400)?, error(0.25, 800)?);
    let order = (coarse / fine).log2();
    assert!((order - 8.0).abs() < 0.3 && fine < 1e-5, "{order}: {coarse:.1e}, {fine:.1e}");
    Ok(())
}

/// Two years here; the example `toutatis` runs a thousand.
#[test]
fn the_light_curve_has_the_measured_frequencies() -> Result<(), StepError> {
    let curve = light_curve(&mode(), &Geometry::fixed(), (0.25, 2), 1461)?;
    let lines = spectrum(&curve, 3);
    for measured in MEASURED {
        let found = lines.iter().any(|line| (line.frequency - measured).abs() < UNCERTAINTY);
        assert!(found, "{measured}: {lines:?}");
    }
    // They are 1 and 2 times the precession, and twice the sum of precession and rotation.
    for (line, expected) in
        lines.iter().zip([1.0 / PRECESSION, 2.0 / PRECESSION, 2.0 / PRECESSION + 2.0 / ROTATION])
    {
        assert!((line.frequency - expected).abs() < 1e-3, "{lines:?}");
    }
    Ok(())
}
