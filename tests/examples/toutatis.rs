//! Asteroid 4179 Toutatis for a thousand years, and the frequencies of its light curve.
//!
//! `cargo run --release -p coadjoint-tests --example toutatis [-- PICTURE.svg]`
#![allow(clippy::print_stdout)]

use coadjoint_tests::toutatis::{
    Geometry, LongAxisMode, MEASURED, PRECESSION, ROTATION, light_curve, spectrum,
};
use coadjoint_tests::toutatis_figure::figure;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mode = LongAxisMode::with_periods(ROTATION, PRECESSION).ok_or("no such mode")?;
    println!("periods {ROTATION} d and {PRECESSION} d, I = 1 : 3.09 : 3.22");
    println!("state: L² = {:.9}, 2E = {:.9}", mode.momentum_squared, mode.twice_energy);
    let (step, stride) = (0.125, 4);
    let years = 1000.0;
    let samples = (years * 365.25 / (step * stride as f64)) as usize;
    let curve = light_curve(&mode, &Geometry::fixed(), (step, stride), samples)?;
    let time = samples as f64 * curve.interval;
    let closed = mode.closed_form().momentum(time);
    let error = (curve.end.momentum - closed).norm() / closed.norm();
    println!("{:.0} years in steps of {step} d:", time / 365.25);
    println!("  drift of the spatial angular momentum {:.1e}", curve.drift);
    println!("  drift of its square, the Casimir {:.1e}", curve.casimir_drift);
    println!("  body momentum against Jacobi's elliptic functions {error:.1e}");
    println!("lines of the light curve, per day (measured: 0.135, 0.271, 0.643 ± 0.008):");
    let (rotation, precession) = (1.0 / ROTATION, 1.0 / PRECESSION);
    for line in spectrum(&curve, 8) {
        let mut best = (f64::INFINITY, 0, 0);
        for j in -4_i32..=4 {
            for k in -2_i32..=2 {
                let f = f64::from(j) * precession + 2.0 * f64::from(k) * rotation;
                let distance = (f - line.frequency).abs();
                if distance < best.0 {
                    best = (distance, j, 2 * k);
                }
            }
        }
        println!(
            "  {:.6}  amplitude {:.3}  = {} f_precession + {} f_rotation (off by {:.0e})",
            line.frequency, line.amplitude, best.1, best.2, best.0
        );
    }
    if let Some(path) = std::env::args().nth(1) {
        std::fs::write(path, figure(&curve, &MEASURED))?;
    }
    Ok(())
}
