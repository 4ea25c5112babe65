//! `coadjoint::systems`: the ready integrators reach the references of the same systems' files.

use coadjoint::nalgebra::{Complex, DMatrix, SVector};
use coadjoint::solve::Integrator;
use coadjoint::steps::advance;
use coadjoint::systems::{
    ClebschCase, FreeBody, FreeBodyFullInertia, GoryachevChaplyginTop, Gyrostat, HeavyTop,
    HeisenbergSpinRing, KirchhoffBody, KovalevskayaTop, LagrangeTop, ManakovBody, Su3Body,
    ThreeWaveInteraction, TodaLattice, ZeitlinVorticity3, zeitlin_vorticity_3, zeitlin_vorticity_5,
};
use coadjoint::{GeneratingFunction, LieGroup, Phase, StepError};
use coadjoint_tests::moments::special_unitary;
use coadjoint_tests::reference::{end_state, numbers};

/// The relative error of the momentum at T after `steps` steps with the integrator of step T/steps.
fn error<S, const N: usize>(
    system: &str,
    steps: u32,
    make: impl Fn(f64) -> Result<S, StepError>,
) -> Result<f64, StepError>
where
    S: Integrator<Group: LieGroup<Scalar = f64, Vector = SVector<f64, N>>>,
{
    let entry = end_state(system);
    let time: f64 = entry.time.parse().unwrap_or(f64::NAN);
    let step = make(time / f64::from(steps))?;
    let start = SVector::<f64, N>::from_column_slice(&numbers(&entry.momentum0));
    let mut phase = Phase::<S::Group>::new(step.group().identity(), start);
    for _ in 0..steps {
        advance(&step, &mut phase)?;
    }
    let end = SVector::<f64, N>::from_column_slice(&numbers(&entry.momentum));
    let spatial = phase.spatial_momentum(step.group());
    assert!((spatial - start).amax() <= 1e-13 * start.amax(), "{system}: {spatial} {start}");
    Ok((phase.momentum - end).amax() / end.amax())
}

/// Bounds are the measured errors, rounded up; the parameters are those of the files.
#[test]
fn ready_integrators_reach_the_references() -> Result<(), StepError> {
    let found = [
        (error("rigid-body (paper)", 1000, |h| FreeBody::new(h, [1.5, 2.0, 2.5]))?, 1e-11),
        (
            error("free-body-full-inertia", 400, |h| {
                FreeBodyFullInertia::new(h, [52.0, 40.0, 20.0], [-6.0, -9.0, -18.0])
            })?,
            4e-12,
        ),
        (
            error("gyrostat", 400, |h| Gyrostat::new(h, [86.2, 85.1, 113.6], [0.0, 2.5, 40.0]))?,
            2e-10,
        ),
        (error("lagrange-top", 400, |h| LagrangeTop::new(h, 0.5, 0.3, 1.2))?, 1e-9),
        (error("kovalevskaya-top", 400, |h| KovalevskayaTop::new(h, 1.0))?, 3e-10),
        (error("goryachev-chaplygin-top", 200, |h| GoryachevChaplyginTop::new(h, 1.0))?, 3e-10),
        (
            error("heavy-top-bruels", 1000, |h| {
                HeavyTop::new(h, [15.234375, 0.46875, 15.234375], [0.0, 147.15, 0.0])
            })?,
            3e-8,
        ),
        (
            error("kirchhoff-body", 200, |h| {
                KirchhoffBody::new(h, [1.0, 2.0, 3.0], [1.0, 2.0, 4.0])
            })?,
            2e-11,
        ),
        (error("clebsch-case", 200, |h| ClebschCase::new(h, [1.0, 0.7, 0.4], 0.8))?, 3e-10),
        (error("manakov-so4", 100, |h| ManakovBody::new(h, [1.0, 2.0, 3.0, 4.0]))?, 2e-12),
        (
            error("su3-quadratic", 100, |h| {
                Su3Body::new(h, [1.0, 1.25, 1.6, 2.0, 2.5, 3.2, 4.0, 5.0])
            })?,
            7e-7,
        ),
        (error("three-wave", 200, |h| ThreeWaveInteraction::new(h, [2.5, 0.5, 1.5]))?, 5e-5),
        (error("toda-lattice", 200, TodaLattice::new)?, 2e-11),
        (error("heisenberg-spin-ring", 200, |h| HeisenbergSpinRing::new(h, 1.0, 0.3, 0.5))?, 3e-5),
    ];
    for (error, bound) in found {
        assert!(error < bound, "{found:?}");
    }
    Ok(())
}

/// ½ Σ |tr(M T_m†)|²/(N |m|²), T_m = (clock)^m₁ (shift)^m₂, summed as it stands over
/// |m₁|, |m₂| ≤ (N − 1)/2.
fn enstrophy_over_squares(n: usize, mu: &[f64]) -> f64 {
    let unit = |m1: i32, m2: i32| {
        DMatrix::from_fn(n, n, |row, column| {
            let angle = std::f64::consts::TAU * f64::from(m1 * row as i32) / n as f64;
            let there = (row as i32 + m2).rem_euclid(n as i32) == column as i32;
            if there { Complex::from_polar(1.0, angle) } else { Complex::new(0.0, 0.0) }
        })
    };
    let vorticity = special_unitary(n, mu);
    let reach = (n as i32 - 1) / 2;
    let mut energy = 0.0;
    for m1 in -reach..=reach {
        for m2 in -reach..=reach {
            if (m1, m2) != (0, 0) {
                let mode = (&vorticity * unit(m1, m2).adjoint()).trace().norm_sqr() / n as f64;
                energy += 0.5 * mode / f64::from(m1 * m1 + m2 * m2);
            }
        }
    }
    energy
}

/// The Hamiltonians are those of the modes; a flow with one pair ±m is steady. The integrator of
/// N = 5 is that of examples/zeitlin_5.toml, which is run against its reference by the interpreter:
/// compiled for 24 dimensions it takes minutes.
#[test]
fn vorticity_of_zeitlin() -> Result<(), StepError> {
    let mu = [0.5, -0.3, 0.4, 0.6, -0.2, 0.7, 0.1, -0.5];
    let energy = enstrophy_over_squares(3, &mu);
    assert!((zeitlin_vorticity_3(mu) - energy).abs() < 1e-14, "{energy}");
    let mu: [f64; 24] = std::array::from_fn(|i| 0.3 * (1.7 * i as f64).sin() + 0.1);
    let energy = enstrophy_over_squares(5, &mu);
    assert!((zeitlin_vorticity_5(mu) - energy).abs() < 1e-13, "{energy}");

    // Equal entries along the first diagonal, zero elsewhere: the pair ±(0, 1).
    let start = SVector::<f64, 8>::from([0.3, 0.4, -0.3, 0.4, 0.3, 0.4, 0.0, 0.0]);
    let step = ZeitlinVorticity3::new(0.1)?;
    let mut phase = Phase::new(step.group().identity(), start);
    for _ in 0..100 {
        step.advance(&mut phase)?;
    }
    assert!((phase.momentum - start).amax() < 1e-13, "{}", phase.momentum);
    Ok(())
}
