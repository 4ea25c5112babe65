//! An orbit in a potential whose closed form gives no place at a time; cases `potential_*` show the rest.

use std::f64::consts::TAU;

use crate::support::json;

/// The inverse distance from the charge at the angle in the orbit by A. Sommerfeld's formula, whatever the turns.
#[test]
fn an_orbit_near_the_speed_of_light_is_the_ellipse_of_sommerfeld() {
    let (energy, spin, k) = (1.81_f64.sqrt() - 0.5, 0.9, 0.5);
    let (middle, factor) =
        (k * energy / (spin * spin - k * k), (1.0 - k * k / (spin * spin)).sqrt());
    let error = |step: f64| {
        let report = json(&format!("simulate examples/relativistic_orbit.toml --step {step}"));
        assert_eq!(report["conserved_momenta"], 3);
        let drift = |name: &str| report["drift"][name].as_f64().unwrap();
        assert!(drift("spatial_momentum") < 1e-13 && drift("energy") < 1e-8, "{report}");
        let place = |axis: usize| report["group_element"][axis][3].as_f64().unwrap();
        let (x, y) = (place(0), place(1));
        let angles = (0..12).map(|turns| y.atan2(x) + TAU * f64::from(turns));
        let inverse = angles.map(|angle| middle + (1.0 - middle) * (factor * angle).cos());
        inverse.map(|inverse| (inverse - 1.0 / x.hypot(y)).abs()).fold(f64::INFINITY, f64::min)
    };
    let [coarse, fine] = [error(0.2), error(0.1)];
    assert!(fine < 1e-10 && ((coarse / fine).log2() - 6.0).abs() < 0.2, "{coarse:e} {fine:e}");
}
