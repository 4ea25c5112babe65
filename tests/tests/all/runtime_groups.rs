//! Systems on a group that the runtime knows are on the runtime's group.

use std::collections::BTreeMap;

use coadjoint::groups::{
    Aff1Algebra, CayleyAlgebra, HeisenbergAlgebra, Rotations, SE23, SE23Algebra, SL2Algebra, SO4,
    Sp4, Sp4Algebra, SpecialUnitary, StaticAlgebra,
};
use coadjoint::steps::StepReport;
use coadjoint::{LieGroup, Phase, StepError, lie_poisson};
use coadjoint_codegen::emit;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::lie::catalogue::lookup;
use coadjoint_codegen::lie::{Chart, LieAlgebra, casimirs};
use coadjoint_codegen::system;
use coadjoint_tests::reference::{end_state, numbers};
use nalgebra::SVector;
use num_traits::ToPrimitive;

#[lie_poisson(group = SO4, truncation = 3)]
fn spherical(mu: [f64; 6], k: f64) -> f64 {
    mu[0] * mu[0] + k * mu[1] * mu[1]
}

#[lie_poisson(group = "SO(4)", truncation = 3)]
fn coupled(mu: [f64; 6]) -> f64 {
    mu[0] * mu[1] + mu[3] * mu[5]
}

#[lie_poisson(group = SE23, truncation = 3)]
fn extended_pose(mu: [f64; 9]) -> f64 {
    let [a, b, c, u, v, w, x, y, z] = mu;
    let turning = a * a / 2.0 + b * b / 3.0 + c * c / 4.0;
    let moving = u * u / 5.0 + v * v / 4.0 + w * w / 3.0 + x * x / 6.0 + y * y / 5.0 + z * z / 3.0;
    turning + moving + (u * x + v * y + w * z) / 4.0 + (a * u + b * v) / 10.0 + c * x / 8.0
}

#[lie_poisson(group = "Sp(4, R)", truncation = 3)]
fn beam_moments(mu: [f64; 10]) -> f64 {
    let [axx, axy, ayx, ayy, bxx, bxy, byy, cxx, cxy, cyy] = mu;
    let channel = cxx + 1.5 * cyy + 0.2 * cxy - bxx - byy;
    let field = (cxx * cxx + 2.0 * cxy * cxy + cyy * cyy) / 4.0;
    channel + field + axx * ayy / 6.0 + (axy * axy + ayx * ayx) / 8.0 + bxy * cxy / 9.0
}

/// 500 steps from the start of a reference; the error at its end.
fn error<G: LieGroup<Scalar = f64, Vector = SVector<f64, N>>, const N: usize, const D: usize>(
    (group, system): (G, &str),
    step: impl Fn(&mut Phase<G>) -> Result<StepReport<f64>, StepError>,
) -> Result<f64, StepError>
where
    G::Element: AsRef<[[f64; D]; D]>,
{
    let entry = end_state(system);
    let start = SVector::from_column_slice(&numbers(&entry.momentum0));
    let mut state = Phase::new(group.identity(), start);
    (0..500).try_for_each(|_| step(&mut state).map(drop))?;
    let columns = state.group_element.as_ref();
    let rows = (0..D).flat_map(|row| columns.iter().map(move |column| column[row]));
    let found: Vec<f64> = state.momentum.iter().copied().chain(rows).collect();
    let expected = numbers(&[entry.momentum, entry.group_element.concat()].concat());
    Ok(found.iter().zip(expected).fold(0.0, |most, (a, b)| most.max((a - b).abs())))
}

#[test]
fn extended_poses_and_moments_reach_their_references() -> Result<(), StepError> {
    let step = ExtendedPose::<f64>::new(0.01)?;
    let pose = error((SE23::new(), "extended-pose"), |state| step.advance(state))?;
    let step = BeamMoments::<f64>::new(0.01)?;
    let beam = error((Sp4::new(), "beam-moments"), |state| step.advance(state))?;
    assert!(pose < 1e-7 && beam < 1e-7, "{pose} {beam}");
    Ok(())
}

#[test]
fn one_state_serves_two_systems() -> Result<(), StepError> {
    let mut state = Phase::<SO4>::at_identity([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    Spherical::new(0.1, 2.0)?.advance(&mut state)?;
    Coupled::new(0.1)?.advance(&mut state)?;
    assert!(state.momentum.iter().all(|entry| entry.is_finite()));
    Ok(())
}

/// The tables of the type against those of codegen's catalogue, entry for entry.
fn agrees<A: StaticAlgebra>(name: &str) -> Result<(), Box<dyn std::error::Error>> {
    assert!(emit::RUNTIME_TABLES.contains(&name), "{name} is not used");
    let algebra = lookup(name)?;
    let mut brackets = BTreeMap::new();
    for constant in algebra.structure() {
        let value = constant.value.to_f64().ok_or("too large")?;
        brackets.insert((constant.i, constant.j, constant.k), value);
        brackets.insert((constant.j, constant.i, constant.k), -value);
    }
    let here: BTreeMap<_, _> = A::STRUCTURE.iter().map(|&(i, j, k, v)| ((i, j, k), v)).collect();
    assert_eq!(here, brackets, "{name}");

    let mut basis = BTreeMap::new();
    for (i, matrix) in algebra.basis().unwrap_or_default().iter().enumerate() {
        assert_eq!(matrix.rows(), A::MATRIX_SIZE, "{name}");
        for (row, column, value) in matrix.entries() {
            basis.insert((i, row, column), value.to_f64().ok_or("too large")?);
        }
    }
    basis.retain(|_, value| *value != 0.0);
    let here = A::BASIS.unwrap_or_default().iter();
    assert_eq!(here.map(|&(i, r, c, v)| ((i, r, c), v)).collect::<BTreeMap<_, _>>(), basis);

    let invariants = casimirs(&algebra, if A::DIM <= 9 { 3 } else { 2 })?;
    let terms = invariants.iter().map(|casimir| {
        let own = |factors: Vec<(u32, u32)>| {
            factors.into_iter().map(|(i, power)| (i as usize, power)).collect::<Vec<_>>()
        };
        let terms = casimir.factors().map(|(factors, value)| (own(factors), value.to_f64()));
        terms.collect::<BTreeMap<_, _>>()
    });
    let here = A::CASIMIRS.iter().map(|casimir| {
        casimir
            .iter()
            .map(|&(value, factors)| (factors.to_vec(), Some(value)))
            .collect::<BTreeMap<_, _>>()
    });
    assert_eq!(here.collect::<Vec<_>>(), terms.collect::<Vec<_>>(), "{name}");
    Ok(())
}

/// Compares an algebra that has the Cayley chart too.
fn agrees_with_cayley<A: CayleyAlgebra>(name: &str) -> Result<(), Box<dyn std::error::Error>> {
    Chart::Cayley.check(&lookup(name)?)?;
    agrees::<A>(name)
}

#[test]
fn the_runtimes_tables_are_the_catalogues() -> Result<(), Box<dyn std::error::Error>> {
    agrees_with_cayley::<Aff1Algebra>("Aff1")?;
    agrees_with_cayley::<HeisenbergAlgebra>("Heisenberg")?;
    agrees_with_cayley::<SE23Algebra>("SE23")?;
    agrees_with_cayley::<SL2Algebra>("SL2")?;
    agrees_with_cayley::<Sp4Algebra>("Sp4")?;
    agrees_with_cayley::<Rotations<4>>("SO4")?;
    agrees_with_cayley::<Rotations<5>>("SO5")?;
    assert!(Chart::Cayley.check(&lookup("SU3")?).is_err());
    agrees::<SpecialUnitary<3>>("SU3")?;
    assert_eq!(emit::RUNTIME_TABLES.len(), 8);
    Ok(())
}

#[test]
fn an_algebra_of_the_users_own_keeps_its_tables() -> Result<(), Box<dyn std::error::Error>> {
    // Named as one of the catalogue, with brackets of its own.
    let text = r#"
name = "own"
hamiltonian = "a^2 + b*c"

[algebra]
generators = ["a", "b", "c"]
brackets = ["[a, b] = 2*c", "[b, c] = a", "[c, a] = 3*b"]
"#;
    let mut system = system::read(text, system::Options::default())
        .map_err(|mistakes| mistakes.render("own.toml", text))?;
    let constants = system.problem.algebra.structure().iter();
    let constants: Vec<_> = constants.map(|s| (s.i, s.j, s.k, s.value.clone())).collect();
    system.problem.algebra = LieAlgebra::from_structure_constants("SO3", 3, constants)?;
    let integrator = Integrator::build(system.problem, TermLimit::default())?;
    let code = emit::file(emit::items(&integrator, &emit::Options::for_problem("own")));
    assert!(code.contains("pub struct OwnAlgebra;"), "{code}");
    assert!(!code.contains("::coadjoint::SO3"), "{code}");
    Ok(())
}
