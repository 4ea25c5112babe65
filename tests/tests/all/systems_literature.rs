//! Closed forms from the literature that the systems must follow.

use coadjoint::nalgebra::{DMatrix, SymmetricEigen};
use coadjoint::systems::{Gyrostat, LagrangeTop};
use coadjoint::{Phase, SE3, SO3, StepError};
use coadjoint_tests::reference::{end_state, numbers};
use coadjoint_tests::run::run;

/// Steady precession of Lagrange's top: I₃ω₃ Ω_p − I₁Ω_p² cos θ = m g l (Goldstein, *Classical
/// Mechanics*, § 5.7, with Π₃ = I₃ω₃). The axis keeps its tilt, and turns by Ω_p T.
#[test]
fn steady_precession_of_lagranges_top() -> Result<(), StepError> {
    let (transverse, axial, mgl) = (0.5, 0.3, 1.2);
    let (cosine, sine, rate) = (0.8, 0.6, 0.7);
    let spin = (mgl + transverse * rate * rate * cosine) / rate;
    // Body axes at t = 0: e₃ tilted by θ, the vertical in the plane of e₁ and e₃. The axis
    // precesses with Ω_p about the vertical: Π₁ = I₁ Ω_p sin θ.
    let start = [transverse * rate * sine, 0.0, spin, sine, 0.0, cosine];
    let step = LagrangeTop::new(0.005, transverse, axial, mgl)?;
    let mut top = Phase::<SE3>::at_identity(start);
    let steps = 2000;
    for _ in 0..steps {
        step.advance(&mut top)?;
        assert!((top.momentum[5] - cosine).abs() < 1e-11, "{}", top.momentum);
    }
    // The vertical is fixed in space; the axis e₃ turns about it.
    let vertical = [sine, 0.0, cosine];
    let group = SE3::new();
    let entry = |i, j| coadjoint::LieGroup::matrix_entry(&group, &top.group_element, i, j);
    let axis = [entry(0, 2), entry(1, 2), entry(2, 2)];
    let height: f64 = (0..3).map(|i| axis[i] * vertical[i]).sum();
    // Components of the axis along (e₃ − cos θ v) and v × e₃ at the start.
    let along = (axis[2] - height * vertical[2]) / (1.0 - cosine * cosine);
    let across = -axis[1] / sine;
    let angle = across.atan2(along);
    let expected = rate * 0.005 * f64::from(steps);
    let difference = (angle - expected).rem_euclid(std::f64::consts::TAU);
    let difference = difference.min(std::f64::consts::TAU - difference);
    assert!(difference < 1e-9, "{angle} {expected}: {axis:?}");
    Ok(())
}

/// The axisymmetric dual-spin spacecraft nutates at the rate Π₃/I_t − (Π₃ − k)/I₃ in body axes
/// (P. C. Hughes, *Spacecraft Attitude Dynamics*, § 6.4: Π̇₁ = λΠ₂ with Π₃ constant).
#[test]
fn nutation_of_a_dual_spin_spacecraft() -> Result<(), StepError> {
    let (transverse, axial, rotor) = (85.0, 110.0, 40.0);
    let start = [12.0, -7.0, 60.0];
    let rate = (start[2] - rotor) / axial - start[2] / transverse;
    let step = Gyrostat::new(0.1, [transverse, transverse, axial], [0.0, 0.0, rotor])?;
    let mut body = Phase::<SO3>::at_identity(start);
    for i in 1..=2000 {
        step.advance(&mut body)?;
        // Π̇₁ = rate Π₂, Π̇₂ = −rate Π₁
        let (sin, cos) = (rate * 0.1 * f64::from(i)).sin_cos();
        let exact = [start[0] * cos + start[1] * sin, start[1] * cos - start[0] * sin, start[2]];
        for (found, exact) in body.momentum.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-9, "{i}: {} {exact}", body.momentum);
        }
    }
    Ok(())
}

/// Rotation about the intermediate axis is unstable; a rotor along it with enough momentum makes
/// the axis the one of greatest "inertia" seen by the flow, and stable (Hughes, ch. 7:
/// (Π − k)/I₂ must be below Π/I₃, or above Π/I₁).
#[test]
fn a_rotor_stabilises_the_intermediate_axis() -> Result<(), StepError> {
    let inertia = [1.0, 2.0, 3.0];
    let swing = |rotor: f64| -> Result<f64, StepError> {
        let step = Gyrostat::new(0.1, inertia, [0.0, rotor, 0.0])?;
        let mut body = Phase::<SO3>::at_identity([1e-3, 1.0, 1e-3]);
        let mut largest = 0.0_f64;
        for _ in 0..2000 {
            step.advance(&mut body)?;
            largest = largest.max(body.momentum.x.abs()).max(body.momentum.z.abs());
        }
        Ok(largest)
    };
    // (1 − k)/2 < 1/3 needs k > 1/3.
    let (without, with_rotor) = (swing(0.0)?, swing(0.6)?);
    assert!(without > 0.5 && with_rotor < 0.01, "{without} {with_rotor}");
    Ok(())
}

/// Toda: the eigenvalues of L stay, and b tends to them in decreasing order while a tends to zero
/// (J. Moser, Lect. Notes Phys. 38 (1975) 467).
#[test]
fn toda_sorts_its_eigenvalues() {
    let entry = end_state("toda-lattice");
    let lax = |mu: &[f64]| {
        DMatrix::from_fn(4, 4, |i, j| match i.abs_diff(j) {
            0 => mu[3 + i],
            1 => mu[i.min(j)],
            _ => 0.0,
        })
    };
    let eigenvalues = |mu: &[f64]| {
        let mut values: Vec<f64> =
            SymmetricEigen::new(lax(mu)).eigenvalues.iter().copied().collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let before = eigenvalues(&numbers(&entry.momentum0));
    let series = entry.series(5);
    // Ten times the reference's span, T = 50.
    let (phase, outcome) = run(&entry, &series, (1000, 100), None, &[]);
    assert!(outcome.casimirs < 1e-13, "{outcome:?}");
    let mu = phase.momentum.as_slice();
    for (before, after) in before.iter().zip(eigenvalues(mu)) {
        assert!((before - after).abs() < 1e-8, "{before} {after}");
    }
    // ȧᵢ = aᵢ (bᵢ₊₁ − bᵢ): a decays where b decreases, so b is sorted downwards.
    for (b, eigenvalue) in mu[3..].iter().zip(before.iter().rev()) {
        assert!((b - eigenvalue).abs() < 1e-8, "{mu:?} {before:?}");
    }
}
