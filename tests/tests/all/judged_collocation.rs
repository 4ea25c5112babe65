//! Steps by collocation and their judge, which shares only the formula of the Hamiltonian with them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint::collocation::{Collocation, Energy};
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_codegen::judge::{DoubleDouble, Enclosure, Judge, JudgeError};
use coadjoint_codegen::smooth::Smooth;
use coadjoint_tests::bridge::named;
use coadjoint_tests::energies::{Any, Modulated, Root, SIX, Six, THREE};
use coadjoint_tests::kernels::smooth;

const ROOT: &str = "sqrt(1 + a^2/1.5 + b^2/2 + c^2/2.5) + c^3/10";
const DRIVEN: &str = "sqrt(1 + a^2/1.5 + b^2/2 + c^2/2.5) + 3/10*cos(3*t)*a \
    + sin(2*t)*b^2/4 + cos(t)*c^3/10";
const ANY: &str = "sqrt(1 + a^2/3 + 2*b^2/3 + c^2) + exp(a/4)/3";
const R: &str = "sqrt(1 + d^2 + 2*e^2/3 + 1.5*f^2)";
const START: f64 = 0.1;

fn six(nodes: usize) -> Smooth {
    let squares = "a^2/3 + b^2/4 + c^2/5 + a*d/7";
    smooth("SE3", &format!("{squares} + 2/3/{R} + exp(f/9 + c/11)*{R}"), 2 * nodes - 1)
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
    let all = "exp(a/3) + ln(2 + b) + sin(c)/2 + cos(a + t) + tan(b/4) + atan(c) + tanh(a) \
        + (3 + c)^(2/3)";
    for (energy, most) in [(DRIVEN, 5), (all, 4)] {
        let judge = |nodes: usize| Judge::of_smooth(&smooth("SO3", energy, 2 * nodes - 1)).unwrap();
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
    let mut motion = Enclosure::new(mu);
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
        let judge = Judge::of_smooth(&smooth("SO3", ROOT, 7)).unwrap();
        within(deviation::<SO3, Root, 4>(&SO3::new(), Root, &judge, case));
        let judge = Judge::of_smooth(&smooth("SO3", DRIVEN, 5)).unwrap();
        within(deviation::<SO3, Modulated, 3>(&SO3::new(), Modulated, &judge, case));
        let judge = Judge::of_smooth(&six(4)).unwrap();
        within(deviation::<SE3, Six, 4>(&SE3::new(), Six, &judge, (h, &SIX)));
        // By tables.
        let tables = named("SL2");
        for (nodes, found) in [(2, 0), (4, 1)] {
            let judge = Judge::of_smooth(&smooth("SL2", ANY, 2 * nodes - 1)).unwrap();
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
    let judge = smooth("SO3", "ln(a) + b^2", 3);
    let judge = Judge::of_smooth(&judge).unwrap();
    let mut setting = judge.at(0.1, &[]).unwrap();
    assert!(setting.step(&[1.0, 0.2, 0.3]).unwrap().right_solution().is_ok());
    assert!(matches!(setting.step(&[-1.0, 0.2, 0.3]), Err(JudgeError::Undefined)));
    assert!(matches!(setting.step(&[f64::NAN, 0.2, 0.3]), Err(JudgeError::NotFinite { .. })));
    let step = setting.step(&[1.0, 0.2, 0.3]).unwrap();
    assert!(matches!(step.at(&[0.0; 3]), Err(JudgeError::Length { expected: 12, .. })));
}
