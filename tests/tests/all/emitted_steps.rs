//! Emitted code, compiled and run against the interpreter.

#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::groups::{Heisenberg, Power, Product, SE2, SL2, SU2};
use coadjoint::nalgebra::{SVector, Vector3};
use coadjoint::plumbing::ElementNumbers;
use coadjoint::steps::{Kicked, Splitting};
use coadjoint::{GeneratingFunction, LieGroup as _, Phase, SE3, SO3, StepError, lie_poisson};
use coadjoint_codegen::graph::{Graph, Id, Node, Program};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{FoldTable, Integrator, Kick};
use coadjoint_codegen::step::Origin;
use coadjoint_codegen::system::{Options, Parameters, read, read_either};
use coadjoint_program::{Kernel, KernelParts, Precision, Programs, Stepper};
use coadjoint_tests::kernels;

/// The modules that the build script has written.
macro_rules! emitted {
    ($($name:ident)*) => {
        $(pub mod $name {
            include!(concat!(env!("OUT_DIR"), "/emitted/", stringify!($name), ".rs"));
        })*
    };
}

emitted! {
    rigid_body cayley_body heavy_top comoving_body three_wave relativistic tables twist planar_body
    spin spins charge side_by_side brackets by_basis
}

mod driven_vehicle {
    include!(concat!(env!("OUT_DIR"), "/driven_vehicle.rs"));
}
mod weighted_body {
    include!(concat!(env!("OUT_DIR"), "/weighted_body.rs"));
}
/// `systems/driven_vehicle.toml`, by the attribute.
#[lie_poisson(group = SE3)]
fn driven(mu: [f64; 6]) -> f64 {
    const FOUR: f64 = 4.0;
    #[velocity]
    fn turning(mu: [f64; 6], omega: SVector<f64, 6>, c: f64) -> [f64; 6] {
        [0.0, 0.0, c * mu[0] * omega[1], 0.0, 0.0, 0.0]
    }
    #[torque]
    fn thrust(t: f64, g: [[f64; 4]; 4], mu: [f64; 6], omega: [f64; 6], c: f64) -> [f64; 6] {
        let along = -g[2][2] / FOUR;
        [-c * omega[0], 0.0, g[2][1], -c * mu[3].abs() * mu[3], c * t.sin(), along]
    }
    let [x, y, z, u, v, w] = mu;
    x.powi(2) / 2.0
        + y.powi(2) / 3.0
        + z.powi(2) / 4.0
        + u.powi(2) / 2.0
        + v.powi(2) / 3.0
        + w.powi(2) / 5.0
}

/// The step size of comparisons.
const H: f64 = 0.3;

/// Compares every function of a compiled step with the interpreter's, at a few points.
fn against_interpreter<const N: usize, S>(
    integrator: &Integrator,
    compiled: &S,
    energy: impl Fn(&SVector<f64, N>) -> f64,
    parameters: &[f64],
) where
    S: GeneratingFunction,
    S::Group: coadjoint::LieGroup<Scalar = f64, Vector = SVector<f64, N>>,
{
    let symbols: Vec<f64> =
        integrator.problem.symbols.iter().map(|s| s.expr.evaluate(parameters)).collect();
    let slots = FoldTable::new(integrator).fold(H, &symbols).unwrap();
    let run = |program: &Program, p: &SVector<f64, N>| program.run(p.as_slice(), &slots);
    for point in 0..5 {
        let p = SVector::<f64, N>::from_fn(|i, _| ((1 + point) as f64 * (1.3 + i as f64)).sin());
        let close = |compiled: f64, interpreted: f64| {
            let bound = 1e-14 * (1.0 + interpreted.abs());
            assert!((compiled - interpreted).abs() <= bound, "{compiled} {interpreted}");
        };
        close(compiled.value(&p), run(&integrator.value, &p)[0]);
        close(energy(&p), run(&integrator.energy, &p)[0]);
        let hessian = run(integrator.hessian.as_ref().unwrap(), &p);
        let gradient = compiled.gradient(&p);
        let (by_hessian, full) = compiled.gradient_and_hessian(&p);
        for (part, program) in integrator.frame.iter().enumerate() {
            let (own, interpreted) = (compiled.frame(part, &p).unwrap(), run(program, &p));
            (0..N).for_each(|i| close(own[i], interpreted[i]));
        }
        assert!(compiled.frame(integrator.frame.len(), &p).is_none());
        let mut entry = N;
        for i in 0..N {
            close(gradient[i], hessian[i]);
            close(by_hessian[i], hessian[i]);
            for j in i..N {
                close(full[(i, j)], hessian[entry]);
                assert_eq!(full[(i, j)], full[(j, i)]);
                entry += 1;
            }
        }
    }
}

#[test]
fn emitted_steps_equal_the_interpreter() -> Result<(), StepError> {
    let of = |name| match kernels::emitted(name) {
        Origin::Series(integrator) => *integrator,
        Origin::Collocation(_) => panic!("{name} has no series"),
    };
    let step = rigid_body::RigidBody::new(H)?;
    against_interpreter(&of("rigid_body"), &step, |mu| step.energy(mu), &[]);

    let step = cayley_body::CayleyBody::new(H)?;
    against_interpreter(&of("cayley_body"), &step, |mu| step.energy(mu), &[]);

    let step = heavy_top::HeavyTop::new(H, [1.5, 2.0, 2.5], 0.3, 9.81, 0.7)?;
    let parameters = [1.5, 2.0, 2.5, 0.3, 9.81, 0.7];
    against_interpreter(&of("heavy_top"), &step, |mu| step.energy(mu), &parameters);

    let step = comoving_body::ComovingBody::new(H, [1.5, 0.8], [0.9, 1.4])?;
    let (integrator, parameters) = (of("comoving_body"), [1.5, 0.8, 0.9, 1.4]);
    assert_eq!(integrator.frame.len(), 2);
    against_interpreter(&integrator, &step, |mu| step.energy(mu), &parameters);

    let step = three_wave::ThreeWave::new(H, 0.7)?;
    against_interpreter(&of("three_wave"), &step, |mu| step.energy(mu), &[0.7]);
    Ok(())
}

/// The programs without fused products, as a processor without them computes.
fn unfused(kernel: &Kernel) -> Kernel {
    let of = |program: &Program| {
        let graph = Graph::new();
        let mut ids: Vec<Id> = Vec::new();
        for node in program.nodes() {
            let at = |id: Id| ids[id.index()];
            ids.push(match *node {
                Node::Zero => graph.zero(),
                Node::Constant(bits) => graph.constant(f64::from_bits(bits)),
                Node::Epsilon => graph.epsilon(),
                Node::Input(i) => graph.input(i as usize),
                Node::Slot(i) => graph.slot(i as usize),
                Node::Add(a, b) => graph.add(at(a), at(b)),
                Node::Sub(a, b) => graph.sub(at(a), at(b)),
                Node::Mul(a, b) => graph.mul(at(a), at(b)),
                Node::TimesPlus(a, b, c) => graph.add(graph.mul(at(a), at(b)), at(c)),
                Node::Div(a, b) => graph.div(at(a), at(b)),
                Node::Neg(a) => graph.neg(at(a)),
                Node::Abs(a) => graph.abs(at(a)),
                Node::Sqrt(a) => graph.sqrt(at(a)),
                Node::Round(a) => graph.round(at(a)),
                Node::Scale(a, k) => graph.scale(at(a), at(k)),
                Node::Exponent(a) => graph.exponent(at(a)),
                Node::Select(a, b, c, d) => graph.select(at(a), at(b), at(c), at(d)),
            });
        }
        let outputs: Vec<Id> = program.outputs().iter().map(|id| ids[id.index()]).collect();
        graph.finish(program.inputs(), &outputs)
    };
    let KernelParts { programs, .. } = &**kernel;
    let programs = Programs {
        guess: of(&programs.guess),
        correct: of(&programs.correct),
        accept: of(&programs.accept),
        transport: of(&programs.transport),
        frame: programs.frame.as_ref().map(of),
        sound: of(&programs.sound),
        watch: of(&programs.watch),
        matrix: of(&programs.matrix),
    };
    Kernel::new(KernelParts { programs, ..(**kernel).clone() }).unwrap()
}

/// The time at which trajectories begin.
const START: f64 = -9.3;

/// Steps from a momentum as the emitted code makes them, beside those of the kernel that it is printed from.
fn has_the_bits_of_its_kernel<G, const N: usize>(
    origin: &Origin,
    parameters: &[f64],
    advance: impl Fn(&mut Phase<G>, f64, u64),
) where
    G: ElementNumbers + coadjoint::LieGroup<Scalar = f64, Vector = SVector<f64, N>> + Default,
{
    let (step, fused) = (origin.step(Precision::Double).unwrap(), cfg!(target_feature = "fma"));
    let kernel = if fused { step.kernel().clone() } else { unfused(step.kernel()) };
    let mut slots = step.fold(H, parameters).unwrap();
    let name = origin.facts().name;
    for point in 0..4 {
        let mu = SVector::<f64, N>::from_fn(|i, _| 0.5 * (1.3 * (point + i) as f64 + 0.4).sin());
        let mut phase = Phase::<G>::at_identity(mu);
        let (mut g, mut moved) = (vec![0.0; kernel.element], mu.as_slice().to_vec());
        G::write(&phase.group_element, &mut g);
        advance(&mut phase, START, 40);
        // Times are set for each step.
        let clock = step.kernel().clock();
        let calls = if clock.is_some() { 40 } else { 1 };
        for call in 0..calls {
            for (at, part) in clock.iter().flat_map(|clock| clock.times.iter().enumerate()) {
                let now = START + call as f64 * H;
                let time = if fused { part.mul_add(H, now) } else { part * H + now };
                slots[step.radius_at() + 1 + at] = time;
            }
            let made = kernel.advance(&slots, &mut g, &mut moved, 40 / calls);
            assert_eq!(made.steps, 40 / calls, "{name}");
        }
        let mut own = vec![0.0; G::COUNT];
        G::write(&phase.group_element, &mut own);
        assert_eq!(phase.momentum.as_slice(), moved, "{name}");
        // Programs have half the angle of a motion of the plane, of which the runtime's number does not tell the sign.
        if ["planar-body", "side-by-side"].contains(&name) {
            let [own, g] = [&own[..], &g].map(|g| kernel.programs.matrix.run(g, &[]));
            assert!(
                own.iter().zip(&g).all(|(a, b)| (a - b).abs() < 1e-14),
                "{name}: {own:?} {g:?}"
            );
        } else {
            assert_eq!(own, g[..G::COUNT], "{name}");
        }
    }
}

/// A group, the name of a system, its steps, and their parameters.
macro_rules! has_bits {
    ($($group:ty, $name:literal, $step:expr, $parameters:expr;)*) => {
        $({
            let step = $step;
            has_the_bits_of_its_kernel::<$group, _>(&kernels::emitted($name), &$parameters, |phase, _, count| {
                step.advance_by(phase, count).unwrap();
            });
        })*
    };
}

#[test]
fn emitted_steps_have_the_bits_of_kernels() -> Result<(), StepError> {
    has_bits! {
        SO3, "rigid_body", rigid_body::RigidBody::new(H)?, [];
        SE3, "heavy_top", heavy_top::HeavyTop::new(H, [1.5, 2.0, 2.5], 0.3, 9.81, 0.7)?, [1.5, 2.0, 2.5, 0.3, 9.81, 0.7];
        SE3, "comoving_body", comoving_body::ComovingBody::new(H, [1.5, 0.8], [0.9, 1.4])?, [1.5, 0.8, 0.9, 1.4];
        SL2, "three_wave", three_wave::ThreeWave::new(H, 0.7)?, [0.7];
        SO3, "relativistic", relativistic::Relativistic::new(H, [1.5, 2.0, 2.5])?, [1.5, 2.0, 2.5];
        tables::TablesGroup, "tables", tables::Tables::new(H)?, [];
        brackets::BracketsGroup, "brackets", brackets::Brackets::new(H)?, [];
        by_basis::ByBasisGroup, "by_basis", by_basis::ByBasis::new(H)?, [];
        SE2, "planar_body", planar_body::PlanarBody::new(H, 1.0, [1.0, 2.0])?, [1.0, 1.0, 2.0];
        SU2, "spin", spin::Spin::new(H, 0.7)?, [0.7];
        Power<SO3, 2, 6>, "spins", spins::Spins::new(H, 0.8)?, [0.8];
        Heisenberg, "charge", charge::Charge::new(H)?, [];
        Product<SO3, SE2, 6>, "side_by_side", side_by_side::SideBySide::new(H)?, [];
    }
    let step = driven_vehicle::DrivenVehicle::new(H, 0.2)?;
    let text = include_str!("../../systems/driven_vehicle.toml");
    let driven = read_either(text, Options::default(), &["c".to_owned()]).unwrap();
    let driven = Origin::derive(driven.problem, TermLimit::default()).unwrap();
    has_the_bits_of_its_kernel::<SE3, 6>(&driven, &[0.2], |phase, time, count| {
        step.advance_by(phase, time, count).unwrap();
    });
    let step = Driven::new(H, 0.2)?;
    has_the_bits_of_its_kernel::<SE3, 6>(&driven, &[0.2], |phase, time, count| {
        step.advance_by(phase, time, count).unwrap();
    });
    let step = twist::Twist::new(H, 0.3)?;
    has_the_bits_of_its_kernel::<SO3, 3>(
        &kernels::emitted("twist"),
        &[0.3],
        |phase, time, count| {
            step.advance_by(phase, time, count).unwrap();
        },
    );
    Ok(())
}

/// A step too long for the programs is left to the runtime, which is given the velocity and the torque too: it refuses the step with a
/// size that works, and the state stays.
#[test]
fn emitted_drives_are_those_of_the_file_in_steps_that_programs_refuse() -> Result<(), StepError> {
    let mut state = Phase::<SE3>::at_identity([3.0, -2.0, 4.0, 0.3, 0.2, -0.1]);
    let fine = driven_vehicle::DrivenVehicle::new(0.01, 0.2)?;
    fine.advance_by(&mut state, 0.5, 40)?;
    let (start, mut exact) = (state.clone(), state.clone());
    let refused = driven_vehicle::DrivenVehicle::new(0.6, 0.2)?.advance(&mut state, 0.9);
    let Err(StepError::Unresolved { at, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(at.usable_step, Some(0.3));
    assert_eq!(state.momentum, start.momentum);
    driven_vehicle::DrivenVehicle::new(0.3, 0.2)?.advance_by(&mut state, 0.9, 2)?;
    fine.advance_by(&mut exact, 0.9, 60)?;
    let off = (state.momentum - exact.momentum).amax();
    assert!(off < 1e-3, "{off:e}");
    Ok(())
}

#[test]
fn many_steps_are_as_many_single_ones() -> Result<(), StepError> {
    let step = rigid_body::RigidBody::new(0.3)?;
    let start = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
    let (mut many, mut single) = (start.clone(), start.clone());
    let report = step.advance_by(&mut many, 50)?;
    let mut worst = 0.0_f64;
    for _ in 0..50 {
        worst = worst.max(step.advance(&mut single)?.residual);
    }
    assert!((many.momentum - single.momentum).amax() < 1e-14);
    assert!(many.group_element.angle_to(&single.group_element) < 1e-14);
    assert!(report.iterations == 1 && report.residual > 0.0 && report.residual <= 2.0 * worst);

    // No step changes nothing; one that fails leaves the state before it.
    let mut state = start.clone();
    assert_eq!(step.advance_by(&mut state, 0)?.iterations, 0);
    state.momentum *= 1e3;
    let before = state.clone();
    assert!(step.advance_by(&mut state, 10).is_err());
    assert_eq!(state.momentum, before.momentum);
    assert_eq!(state.group_element, before.group_element);
    Ok(())
}

/// The module of a potential in a comoving frame.
#[test]
fn a_kicked_body_follows_the_interpreter_and_keeps_its_integrals() -> Result<(), StepError> {
    let text = include_str!("../../systems/weighted_body.toml");
    let kept = Options { parameters: Parameters::Kept, ..Options::default() };
    let system = read(text, kept).unwrap();
    let integrator = Integrator::build(system.problem, TermLimit::default()).unwrap();
    let parameters = [1.5, 2.0, 2.5, 0.8];
    let [i1, i2, i3, m] = parameters;
    let step = weighted_body::WeightedBody::new(H, i1, i2, i3, m)?;
    assert_eq!(integrator.frame.len(), 1);
    against_interpreter(&integrator, &step, |mu| step.energy(mu), &parameters);

    let weight = weighted_body::WeightedBodyPotential::new(i1, i2, i3, m)?;
    let kick = Kick::build(system.potential.unwrap().0);
    let group = SO3::<f64>::new();
    let g = group.exp(&[0.4, -0.7, 0.2].into());
    let matrix: Vec<f64> = (0..9).map(|at| group.matrix_entry(&g, at / 3, at % 3)).collect();
    let symbols: Vec<f64> =
        kick.potential.symbols.iter().map(|s| s.expr.evaluate(&parameters)).collect();
    let slots = FoldTable::of_kick(&kick).fold(1.0, &symbols).unwrap();
    let torque = Vector3::from_vec(kick.torque.run(&matrix, &slots));
    assert!((weight.torque(&g) - torque).amax() < 1e-15 * torque.amax());
    let energy = kick.energy.as_ref().unwrap().run(&matrix, &slots)[0];
    assert!((weight.energy(&g) - energy).abs() < 1e-15 * energy.abs());

    // The weight leaves the momentum about the vertical; energy swings with h⁴.
    let torque = |_: f64, g: &_| weight.torque(g);
    let h = 0.05;
    let kicked = Kicked::new(Splitting::Rkn4, h, torque, |part| {
        weighted_body::WeightedBody::new(part, i1, i2, i3, m)
    })?;
    let mut phase = Phase::<SO3>::new(g, [0.3, 0.9, -0.5]);
    let energy =
        |phase: &Phase<SO3>| step.energy(&phase.momentum) + weight.energy(&phase.group_element);
    let (about, before) = (phase.spatial_momentum(&group), energy(&phase));
    for n in 0..200 {
        kicked.advance(&mut phase, f64::from(n) * h)?;
    }
    let now = phase.spatial_momentum(&group);
    assert!((now.z - about.z).abs() < 1e-13 && (now.x - about.x).abs() > 0.1, "{now} {about}");
    assert!((energy(&phase) - before).abs() < 1e-5, "{} {before}", energy(&phase));
    Ok(())
}
