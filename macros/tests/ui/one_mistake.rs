//! One wrong name is one error, whatever is done with what should have been generated.
use coadjoint::{Phase, SO3, solve::Integrator};
use coadjoint::groups::SO4;
use coadjoint::lanes::Lanes;
use coadjoint::steps::{Kicked, Splitting};
use coadjoint::{lie_poisson, potential};

/// Free rigid body.
#[lie_poisson(group = SO3, truncation = 5)]
fn body(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
    mu[0] * mu[0] / inertia[0] + mu[1] * mu[1] / inertia[1] + mu[3] * mu[2] / inertia[2]
}

#[lie_poisson(group = SO5, truncation = 3)]
fn wrong_group(mu: [f64; 6]) -> f64 {
    mu[0] * mu[1]
}

#[potential(group = SO3)]
fn height(g: [[f64; 3]; 3], weight: f64) -> f64 {
    weigth * g[2][2]
}

#[lie_poisson(group = SO3)]
fn driven(mu: [f64; 3]) -> f64 {
    #[torque]
    fn drag(omega: [f64; 3], rate: f64) -> [f64; 3] {
        omega.map(|rotation| -raet * rotation)
    }
    mu[0] * mu[0]
}

fn end<S: Integrator<Group = SO3> + Lanes + Clone + std::fmt::Debug>(step: S) {
    let mut phase = Phase::<SO3>::at_identity([1.0, 2.0, 3.0]);
    let _ = coadjoint::steps::advance(&step, &mut phase);
    let _ = format!("{step:?}");
}

fn main() -> Result<(), coadjoint::StepError> {
    let inertia = [1.0, 2.0, 3.0];
    let step = Body::new(0.1, inertia)?;
    let mut phase = Phase::<SO3>::at_identity([1.0, 2.0, 3.0]);
    step.advance(&mut phase)?;
    step.advance_by(&mut phase, 10)?;
    let mu = step.poisson_map(&phase.momentum)?;
    let _ = step.energy(&mu) + step.step();
    let _ = Body::<f64>::TRUNCATION + Body::<f64>::ORDER;
    end(Body::new(0.1, inertia)?);

    let wrong = WrongGroup::new(0.1)?;
    wrong.advance_by(&mut Phase::<SO4>::at_identity([0.0; 6]), 3)?;
    let _ = (WrongGroup::<f64>::TRUNCATION, wrong.clone());

    Driven::new(0.1, 0.2)?.advance_by(&mut phase, 10)?;

    let height = Height::new(1.2)?;
    let torque = |_time: f64, g: &_| height.torque(g);
    let kicked = Kicked::new(Splitting::Rkn4, 0.05, torque, |h| Body::new(h, inertia))?;
    kicked.advance(&mut phase, 0.0)?;
    Ok(())
}
