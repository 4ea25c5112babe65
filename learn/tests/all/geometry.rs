//! The geometry of learned maps, for models of every kind and any weights: the runtime's laws.
#![allow(clippy::unwrap_used)]

use coadjoint::collocation::Collocation;
use coadjoint::groups::{Cayley, Chart, Coordinates, Exponential};
use coadjoint::laws::check;
use coadjoint::{LieGroup, Phase, SE3, SO3};
use coadjoint_learn::data::{MomentumPairs, ReducedData};
use coadjoint_learn::network::{TrainingOptions, fit_network};
use coadjoint_learn::polynomial::fit_polynomial;
use coadjoint_learn::truth::Separable;
use coadjoint_learn::{
    DataGroup, Generating, Hamiltonian, Model, MomentumFunction, fit_gaussian_process, fit_hybrid,
};
use nalgebra::DMatrix;

use crate::support::{WIDE, draw, random, random_network, random_polynomial, relativistic, sample};

/// Derivatives in the laws are differences of twelfth order, good to 1e-12 or so.
fn keeps_the_geometry<G: LieGroup<Scalar = f64>, C: Chart<G>>(
    group: &G,
    name: &str,
    // Not a type for each model: the laws are compiled once for each group and chart.
    function: &dyn MomentumFunction,
) {
    let dim = group.dim();
    let mut rng = random(9);
    let mut vector = |size| {
        let entries = draw(&mut rng, dim, size);
        G::Vector::from_entries(dim, |i| entries[i])
    };
    let points: Vec<_> =
        (0..4).map(|_| Phase::<G>::new(group.exp(&vector(1.0)), vector(1.2))).collect();
    let map = Generating::<G, C, _>::new(group.clone(), function);
    for point in &points {
        let moved = coadjoint::steps::poisson_map(&map, &point.momentum).unwrap();
        let way = (0..dim).map(|i| (moved[i] - point.momentum[i]).abs()).fold(0.0, f64::max);
        assert!(way > 1e-3, "{name}: the map must do something");
    }
    let laws = check(&map, None, &points).unwrap();
    for (law, bar) in [
        ("poisson", 1e-10),
        ("symplectic", 1e-10),
        ("equivariant", 1e-10),
        ("momentum", 1e-14),
        ("casimirs", 1e-13),
    ] {
        let found = laws.iter().find(|l| l.name == law).unwrap();
        println!("{name} {} {law}: {:.1e}", C::NAME, found.value);
        assert!(found.value <= bar, "{name}, {}: {law} {:e}", C::NAME, found.value);
    }
}

fn random_weights<G: LieGroup<Scalar = f64>, C: Chart<G>>(group: &G) {
    let dim = group.dim();
    for seed in 0..3 {
        let mut rng = random(seed);
        keeps_the_geometry::<G, C>(group, "random polynomial", &random_polynomial(dim, &mut rng));
        let network = random_network(dim, &mut rng);
        keeps_the_geometry::<G, C>(group, "random network", &network);
        let polynomial = random_polynomial(dim, &mut rng);
        let hybrid = Model::Hybrid { polynomial, network };
        keeps_the_geometry::<G, C>(group, "random hybrid", &hybrid);
    }
}

#[test]
fn random_weights_on_so3() {
    random_weights::<_, Exponential>(&SO3::new());
    random_weights::<_, Cayley>(&SO3::new());
}

#[test]
fn random_weights_on_se3() {
    random_weights::<_, Exponential>(&SE3::new());
}

fn fitted<G: DataGroup, C: Chart<G>>(group: &G, truth: &impl MomentumFunction) {
    let train = sample::<G, C>(group, truth, (0.2, WIDE), 80, 1).1;
    let polynomial = fit_polynomial(&train, 3, 0.0).unwrap();
    keeps_the_geometry::<G, C>(group, "fitted polynomial", &polynomial);
    let process = fit_gaussian_process(&train, 60).unwrap();
    keeps_the_geometry::<G, C>(group, "Gaussian process", &process);
    let options = TrainingOptions { widths: vec![16, 16], ..TrainingOptions::budget(80) };
    let (network, _) = fit_network(&train.p, &train.x, None, &options, &mut |_| {}).unwrap();
    keeps_the_geometry::<G, C>(group, "trained network", &network);
    let (hybrid, _) = fit_hybrid(&train.p, &train.x, 2, &options, &mut |_| {}).unwrap();
    keeps_the_geometry::<G, C>(group, "trained hybrid", &hybrid);
}

#[test]
fn fitted_models_on_so3() {
    fitted::<_, Exponential>(&SO3::new(), &relativistic());
    fitted::<_, Cayley>(&SO3::new(), &relativistic());
}

#[test]
fn fitted_models_of_the_heavy_top() {
    let top = Separable::heavy_top([1.0, 1.2, 0.8], [0.1, 0.0, 0.4]);
    fitted::<_, Exponential>(&SE3::new(), &top);
}

/// Of momenta and angular velocities, read as a Hamiltonian and integrated by collocation.
#[test]
fn fitted_hamiltonians_keep_momentum_casimir_and_their_own_energy() {
    let (truth, mut rng) = (relativistic(), random(4));
    let p = DMatrix::from_vec(3, 120, draw(&mut rng, 360, 2.0));
    let mut x = p.clone();
    for (mu, mut velocity) in p.column_iter().zip(x.column_iter_mut()) {
        truth.gradient(mu.as_slice(), velocity.as_mut_slice());
    }
    let options = TrainingOptions { widths: vec![16, 16], ..TrainingOptions::budget(300) };
    let network = fit_network(&p, &x, None, &options, &mut |_| {}).unwrap().0;
    let momenta = MomentumPairs { before: p.clone(), after: p.clone() };
    let data = ReducedData { x, p, momenta };
    let polynomial = fit_polynomial(&data, 6, 0.0).unwrap();
    let process = fit_gaussian_process(&data, 60).unwrap();
    let functions: [(&str, &dyn MomentumFunction); 3] =
        [("polynomial", &polynomial), ("process", &process), ("network", &network)];
    for (name, function) in functions {
        let group = SO3::new();
        let start = Phase::<SO3>::at_identity([1.2, 0.5, -0.8]);
        let mut body = start.clone();
        let mut step = Collocation::<SO3, _, 4>::new(group, Hamiltonian(function), 0.2).unwrap();
        step.advance_by(&mut body, 0.0, 1000).unwrap();
        let moved = body.spatial_momentum(&group) - start.momentum;
        let casimir = body.momentum.norm() - start.momentum.norm();
        assert!(moved.norm() < 1e-13 && casimir.abs() < 1e-13, "{name}: {moved} {casimir:e}");
        let change = |energy: &dyn MomentumFunction| {
            let value = |of: &Phase<SO3>| energy.value(of.momentum.as_slice());
            (value(&body) - value(&start)).abs()
        };
        println!("{name}: {:.1e} of its own, {:.1e} of the true", change(function), change(&truth));
        assert!(change(function) < 1e-9 && change(&truth) < 0.05, "{name}");
    }
}
