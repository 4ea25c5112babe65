//! A step allocates nothing.

use coadjoint::{Phase, SO3, lie_poisson};

#[lie_poisson(group = SO3, truncation = 7)]
fn rigid_body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    0.5 * (mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[2] * mu[2] / inertia[2])
}

#[test]
fn constructing_and_stepping_allocate_nothing() -> Result<(), coadjoint::StepError> {
    let mut outcome = Ok(());
    let counted = allocation_counter::measure(|| {
        outcome = (|| {
            let step = RigidBody::new(0.1, [1.5, 2.0, 2.5])?;
            let mut body = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
            for _ in 0..1000 {
                step.advance(&mut body)?;
            }
            Ok(())
        })();
    });
    assert_eq!(counted.count_total, 0, "allocations in 1000 steps");
    outcome
}

#[test]
fn the_counter_counts() {
    // A test of the test: an allocation inside the measured closure is seen.
    let counted = allocation_counter::measure(|| {
        std::hint::black_box(vec![1.0_f64; 100]);
    });
    assert_eq!(counted.count_total, 1);
}
