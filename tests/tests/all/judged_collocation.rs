//! Steps by collocation and their judge, which shares only the formula of the Hamiltonian with them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_codegen::judge::{DoubleDouble, Judge, JudgeError, Motion};
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::smooth::{Hamiltonian, Smooth};
use coadjoint_codegen::system::{Options, read_either};
use coadjoint_tests::bridge::matrix_group;
use coadjoint_tests::energies::{Any, Driven, Root, SIX, Six, THREE};

const ROOT: &str = "sqrt(1 + mu[0]^2/1.5 + mu[1]^2/2 + mu[2]^2/2.5) + mu[2]^3/10";
const DRIVEN: &str = "sqrt(1 + mu[0]^2/1.5 + mu[1]^2/2 + mu[2]^2/2.5) + 3/10*cos(3*t)*mu[0] \
    + sin(2*t)*mu[1]^2/4 + cos(t)*mu[2]^3/10";
const ANY: &str = "sqrt(1 + mu[0]^2/3 + 2*mu[1]^2/3 + mu[2]^2) + exp(mu[0]/4)/3";
const R: &str = "sqrt(1 + mu[3]^2 + 2*mu[4]^2/3 + 1.5*mu[5]^2)";
const START: f64 = 0.1;

fn smooth(group: &str, energy: &str, nodes: usize) -> Smooth {
    let text = format!(
        "group = \"{group}\"\nhamiltonian = \"{energy}\"\n[integrator]\ntruncation = {}\n",
        2 * nodes - 1
    );
    match read_either(&text, Options::default(), &[]).map(|system| system.problem) {
        Ok(Hamiltonian::Smooth(smooth)) => *smooth,
        other => panic!("{other:?}"),
    }
}

fn six(nodes: usize) -> Smooth {
    let squares = "mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]*mu[3]/7";
    smooth("SE3", &format!("{squares} + 2/3/{R} + exp(mu[5]/9 + mu[2]/11)*{R}"), nodes)
}

/// The momentum that the judge's step leads to, in doubled precision.
fn end(judge: &Judge, h: f64, mu: &[f64]) -> Vec<DoubleDouble> {
    let mut setting = judge.at(h, &[]).unwrap();
    setting.start(START, 0);
    let step = setting.step(mu).unwrap();
    let end = step.end(&step.right_solution().unwrap(), f64::EPSILON / 2.0).unwrap();
    end.momentum.iter().map(|mu| mu.scaled(end.scale)).collect()
}

/// One step errs with one power more than the order, beside a step with eight nodes: orders 2 to 10 of a field that moves,
/// and 2 to 8 of all functions, of which shorter steps with five nodes err by the rounding of the judge.
#[test]
fn steps_of_the_judge_have_the_orders_of_their_nodes() {
    let all = "exp(mu[0]/3) + ln(2 + mu[1]) + sin(mu[2])/2 + cos(mu[0] + t) + tan(mu[1]/4) + atan(mu[2]) + tanh(mu[0]) \
        + (3 + mu[2])^(2/3)";
    for (energy, most) in [(DRIVEN, 5), (all, 4)] {
        let judge = |nodes| Judge::of_smooth(&smooth("SO3", energy, nodes)).unwrap();
        let exact = judge(8);
        for nodes in 1..=most {
            let judge = judge(nodes);
            let error = |h| {
                let pairs = end(&judge, h, &THREE).into_iter().zip(end(&exact, h, &THREE));
                pairs.map(|(a, b)| (a - b).to_f64().powi(2)).sum::<f64>().sqrt()
            };
            let order = (error(0.04) / error(0.02)).log2() - 1.0;
            assert!((order - 2.0 * nodes as f64).abs() < 0.15, "{energy}, {nodes} nodes: {order}");
        }
    }
}

/// The deviation of a step of the runtime from the judge's, over the bound.
fn deviation<G, E, const M: usize>(
    group: &G,
    energy: E,
    judge: &Judge,
    (h, mu): (f64, &[f64]),
) -> f64
where
    G: LieGroup<Scalar = f64>,
    E: Energy<G::Vector>,
{
    use coadjoint::groups::Coordinates;
    let start = G::Vector::from_entries(mu.len(), |i| mu[i]);
    let mut step = Collocation::<_, _, M>::new(group.clone(), energy, h).unwrap();
    let mut state = Phase::<G>::new(group.identity(), start);
    step.advance(&mut state, START).unwrap();
    let mut motion = Motion::new(mu);
    let mut setting = judge.at(h, &[]).unwrap();
    setting.start(START, 0);
    motion.step(&mut setting, None, f64::EPSILON / 2.0).unwrap();
    let found: Vec<f64> = (0..mu.len()).map(|i| state.momentum[i]).collect();
    for (found, exact) in found.iter().zip(motion.momentum()) {
        assert!((found - exact).abs() < 2e-15, "{found} {exact}");
    }
    motion.momentum_deviation(&found)
}

#[test]
fn steps_of_the_runtime_are_those_of_the_judge_to_rounding() {
    let within = |deviation: f64| assert!(deviation > 0.0 && deviation < 1.0, "{deviation}");
    for h in [0.05, 0.2, 0.5] {
        let case = (h, &THREE[..]);
        let judge = Judge::of_smooth(&smooth("SO3", ROOT, 4)).unwrap();
        within(deviation::<SO3, Root, 4>(&SO3::new(), Root, &judge, case));
        let judge = Judge::of_smooth(&smooth("SO3", DRIVEN, 3)).unwrap();
        within(deviation::<SO3, Driven, 3>(&SO3::new(), Driven, &judge, case));
        let judge = Judge::of_smooth(&six(4)).unwrap();
        within(deviation::<SE3, Six, 4>(&SE3::new(), Six, &judge, (h, &SIX)));
        // By tables.
        let tables = matrix_group(&lookup("SL2").unwrap()).unwrap();
        for (nodes, found) in [(2, 0), (4, 1)] {
            let judge = Judge::of_smooth(&smooth("SL2", ANY, nodes)).unwrap();
            let case = (0.5 * h, &THREE[..]);
            within(match found {
                0 => deviation::<_, Any, 2>(&tables, Any, &judge, case),
                _ => deviation::<_, Any, 4>(&tables, Any, &judge, case),
            });
        }
    }
}

#[test]
fn what_has_no_value_is_not_judged() {
    let judge = smooth("SO3", "ln(mu[0]) + mu[1]^2", 2);
    let judge = Judge::of_smooth(&judge).unwrap();
    let mut setting = judge.at(0.1, &[]).unwrap();
    assert!(setting.step(&[1.0, 0.2, 0.3]).unwrap().right_solution().is_ok());
    assert!(matches!(setting.step(&[-1.0, 0.2, 0.3]), Err(JudgeError::Undefined)));
    assert!(matches!(setting.step(&[f64::NAN, 0.2, 0.3]), Err(JudgeError::NotFinite { .. })));
    let step = setting.step(&[1.0, 0.2, 0.3]).unwrap();
    assert!(matches!(step.at(&[0.0; 3]), Err(JudgeError::Length { expected: 12, .. })));
}
