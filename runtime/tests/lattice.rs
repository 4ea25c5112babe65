//! Lattices of spins: closed solutions, laws and orders of each family, other steps of the same equations, refusals.
#![cfg(feature = "std")]
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint::collocation::Collocation;
use coadjoint::groups::Power;
use coadjoint::lattice::{Boundary, Family, Graph, Lattice, LatticeError, Order};
use coadjoint::laws::check_derivatives;
use coadjoint::{LieGroup, Phase, SO3};
use nalgebra::{Matrix3, SVector, Vector3};

type State = Vec<[f64; 3]>;

const AXES: Family = Family::Axes { shift: 0.0 };
const FAMILIES: [Family; 3] = [AXES, Family::Bonds, Family::Sublattices];

/// A disordered state whose spins have lengths from 0.7 to 1.3.
fn disordered(sites: usize) -> State {
    let spin = |i: usize| {
        let x = i as f64 + 1.0;
        let v = Vector3::new((12.9 * x).sin(), (78.2 * x).cos(), (37.7 * x + 0.4).sin());
        (v.normalize() * (1.0 + 0.3 * (5.1 * x).sin())).into()
    };
    (0..sites).map(spin).collect()
}

fn distance(a: &State, b: &State) -> f64 {
    let gaps = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs());
    gaps.fold(0.0, f64::max)
}

fn rotated(
    lattice: &Lattice,
    family: Family,
    order: Order,
    h: f64,
    steps: u64,
    start: &State,
) -> State {
    let mut spins = start.clone();
    lattice.rotations(family, order, h).unwrap().advance_by(&mut spins, steps).unwrap();
    spins
}

fn collocated<const M: usize>(lattice: &Lattice, h: f64, steps: u64, start: &State) -> State {
    collocated_from::<M>(lattice, 0.0, (h, steps), start)
}

fn collocated_from<const M: usize>(
    lattice: &Lattice,
    begin: f64,
    (h, steps): (f64, u64),
    start: &State,
) -> State {
    let mut spins = start.clone();
    lattice.gauss::<M>(h).unwrap().advance_from(&mut spins, begin, steps).unwrap();
    spins
}

/// Exchange along x, y and z of different strengths, and with all entries.
fn symmetric() -> Matrix3<f64> {
    Matrix3::new(-1.0, 0.3, -0.2, 0.3, -0.6, 0.25, -0.2, 0.25, -0.4)
}

/// Dzyaloshinskii and Moriya's energy d·(a×b).
fn dzyaloshinskii(d: Vector3<f64>) -> Matrix3<f64> {
    d.cross_matrix().transpose()
}

/// A ring with this coupling, a field and an anisotropy along an axis.
fn ring(sites: usize, coupling: Matrix3<f64>) -> Lattice {
    let axis = Vector3::new(0.3, -0.4, 0.9).normalize();
    let field = Vector3::new(0.2, 0.1, -0.5);
    let lattice = Lattice::new(Graph::chain(sites).unwrap()).bond([1], coupling).unwrap();
    lattice.site(field, 0.3 * axis * axis.transpose()).unwrap()
}

#[test]
fn two_spins_turn_about_their_sum() {
    let lattice = Lattice::new(Graph::from_edges(2, &[[0, 1]]).unwrap());
    let lattice = lattice.nearest(Matrix3::identity() * 0.8).unwrap();
    let start = disordered(2);
    let [s, t] = [0, 1].map(|i| Vector3::from(start[i]));
    // ds/dt = s × 0.8 (s + t): the spins turn back about their sum.
    let turn = nalgebra::Rotation3::from_scaled_axis(-0.8 * (s + t) * 2.0);
    let exact: State = vec![(turn * s).into(), (turn * t).into()];
    // One pair is a flow that bonds have as it is.
    assert!(
        distance(&rotated(&lattice, Family::Bonds, Order::Two, 2.0, 1, &start), &exact) < 1e-15
    );
    for family in FAMILIES {
        let gap = distance(&rotated(&lattice, family, Order::Eight, 0.05, 40, &start), &exact);
        assert!(gap < 3e-13, "{family}: {gap:e}");
    }
    assert!(distance(&collocated::<5>(&lattice, 0.1, 20, &start), &exact) < 3e-13);
}

/// A spiral s = (sin θ cos φ, sin θ sin φ, cos θ), φ = kx + ωt, on a ring with H = −J Σ a·b + Σ (D z² − B z) moves as a spin
/// wave with ω = 2J cos θ (1 − cos k) + B − 2D cos θ, at any amplitude.
#[test]
fn spirals_move_as_spin_waves() {
    let (sites, j, d, b, height) = (20, 1.3, 0.4, 0.7, 0.8_f64);
    let lattice = Lattice::new(Graph::chain(sites).unwrap());
    let lattice = lattice.nearest(Matrix3::identity() * -j).unwrap();
    let square = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, d));
    let lattice = lattice.site(Vector3::new(0.0, 0.0, -b), square).unwrap();
    let k = 3.0 * std::f64::consts::TAU / sites as f64;
    let frequency = 2.0 * j * height * (1.0 - k.cos()) + b - 2.0 * d * height;
    let radius = (1.0 - height * height).sqrt();
    let at = |time: f64| -> State {
        let phase = |i: usize| k * i as f64 + frequency * time;
        (0..sites).map(|i| [radius * phase(i).cos(), radius * phase(i).sin(), height]).collect()
    };
    for family in FAMILIES {
        let gap = distance(&rotated(&lattice, family, Order::Eight, 0.1, 50, &at(0.0)), &at(5.0));
        assert!(gap < 2e-9, "{family}: {gap:e}");
    }
    let gap = distance(&collocated::<4>(&lattice, 0.1, 50, &at(0.0)), &at(5.0));
    assert!(gap < 2e-9, "{gap:e}");
}

/// The families that admit a coupling, and Gauss's method, agree with collocation in the chart of SO(3)⁵ on a ring of five.
#[test]
fn families_agree_with_collocation_on_the_product_of_groups() {
    let start = disordered(5);
    let isotropic = Matrix3::identity() * -1.0;
    let diagonal = Matrix3::from_diagonal(&Vector3::new(-1.0, 0.5, 0.2));
    let twisted = isotropic + dzyaloshinskii(Vector3::new(0.2, 0.5, -0.3));
    let any = Matrix3::new(0.1, 0.9, -0.3, 0.2, -0.4, 0.6, 0.7, -0.2, 0.5);
    for coupling in [isotropic, diagonal, symmetric(), twisted, any] {
        let lattice = ring(5, coupling);
        type Spins = Power<SO3, 5, 15>;
        let energy = (
            |_: f64, mu: &SVector<f64, 15>| lattice.energy(&list(mu)).unwrap(),
            |_: f64, mu: &SVector<f64, 15>| flat(&lattice.gradient(&list(mu)).unwrap()),
        );
        let group = Spins::new();
        let mut step = Collocation::<_, _, 6>::new(group, energy, 0.05).unwrap();
        let mut state = Phase::<Spins>::new(Spins::new().identity(), flat(&start));
        step.advance_by(&mut state, 0.0, 20).unwrap();
        let exact = list(&state.momentum);
        for family in FAMILIES {
            let gap = distance(&rotated(&lattice, family, Order::Eight, 0.02, 50, &start), &exact);
            assert!(gap < 1e-10, "{coupling} {family}: {gap:e}");
        }
        let gap = distance(&collocated::<5>(&lattice, 0.1, 10, &start), &exact);
        assert!(gap < 1e-10, "{coupling}: {gap:e}");
        // The energy by a closure.
        let gradient = |s: &[[f64; 3]], out: &mut [[f64; 3]]| {
            out.copy_from_slice(&lattice.gradient(s).unwrap());
        };
        let mut spins = start.clone();
        let free = Lattice::new(Graph::chain(5).unwrap());
        free.gauss_of::<5, _>(0.1, gradient).unwrap().advance_by(&mut spins, 10).unwrap();
        assert!(distance(&spins, &exact) < 1e-10, "{coupling}, a closure");
    }
}

/// log₂ of the ratio of the errors with steps h and h/2.
fn order(exact: &State, coarse: &State, fine: &State) -> f64 {
    (distance(coarse, exact) / distance(fine, exact)).log2()
}

#[test]
fn steps_have_their_orders() {
    let twisted = symmetric() + dzyaloshinskii(Vector3::new(0.2, 0.5, -0.3));
    // Chains of even and odd length have two colours and three.
    for (sites, coupling) in [(6, symmetric()), (6, twisted), (7, twisted)] {
        let lattice = ring(sites, coupling);
        let start = disordered(sites);
        let exact = collocated::<6>(&lattice, 0.05, 40, &start);
        for family in FAMILIES {
            for (kind, steps) in
                [(Order::Two, 40), (Order::Four, 20), (Order::Six, 10), (Order::Eight, 8)]
            {
                let after = |n: u64| rotated(&lattice, family, kind, 2.0 / n as f64, n, &start);
                let found = order(&exact, &after(steps), &after(2 * steps));
                assert!(
                    (found - f64::from(kind.number())).abs() < 0.6,
                    "{family} {kind:?}: {found}"
                );
            }
        }
    }
    let lattice = ring(6, symmetric());
    let start = disordered(6);
    let exact = collocated::<6>(&lattice, 0.05, 40, &start);
    nodes_have_their_orders(&lattice, (0.0, 2.0), [40, 20, 10], &start, &exact);
}

/// Steps at one, two and three nodes, of these numbers over a time from its beginning and twice as many, have the orders 2, 4 and 6.
fn nodes_have_their_orders(
    lattice: &Lattice,
    (begin, time): (f64, f64),
    counts: [u64; 3],
    start: &State,
    exact: &State,
) {
    let ends = [collocated_from::<1>, collocated_from::<2>, collocated_from::<3>];
    for ((end, count), expected) in ends.into_iter().zip(counts).zip([2.0, 4.0, 6.0]) {
        let [coarse, fine] =
            [count, 2 * count].map(|n| end(lattice, begin, (time / n as f64, n), start));
        let found = order(exact, &coarse, &fine);
        assert!((found - expected).abs() < 0.4, "{found} for {expected}");
    }
}

/// The momenta of sites as one of the product of groups, and back.
fn flat<const N: usize>(s: &State) -> SVector<f64, N> {
    SVector::from_iterator(s.iter().flatten().copied())
}

fn list<const N: usize>(mu: &SVector<f64, N>) -> State {
    mu.as_slice().as_chunks::<3>().0.to_vec()
}

/// The defect of the law of Poisson maps on SO(3)⁴.
fn poisson_defect(map: impl Fn(&State) -> State, start: &State) -> f64 {
    type Spins = Power<SO3, 4, 12>;
    let point = Phase::<Spins>::new(Spins::new().identity(), flat(start));
    let mut there = |state: &mut Phase<Spins>| {
        state.momentum = flat(&map(&list(&state.momentum)));
        Ok(())
    };
    let mut laws = Vec::new();
    check_derivatives(&Spins::new(), &mut there, &point, &mut laws).unwrap();
    assert_eq!(laws[0].name, "poisson");
    laws[0].value
}

#[test]
fn all_but_sublattices_are_poisson_maps() {
    let start = disordered(4);
    let twisted = symmetric() + dzyaloshinskii(Vector3::new(0.2, 0.5, -0.3));
    let defect = |family, coupling| {
        let lattice = ring(4, coupling);
        poisson_defect(|s| rotated(&lattice, family, Order::Two, 0.2, 1, s), &start)
    };
    for (family, coupling) in [(AXES, symmetric()), (AXES, twisted), (Family::Bonds, twisted)] {
        let found = defect(family, coupling);
        assert!(found < 1e-12, "{family}: {found:e}");
    }
    let found = defect(Family::Sublattices, symmetric());
    assert!(found > 1e-5, "sublattices: {found:e}");
    let lattice = ring(4, twisted);
    let found = poisson_defect(|s| collocated::<2>(&lattice, 0.2, 1, s), &start);
    assert!(found < 1e-12, "gauss: {found:e}");
}

#[test]
fn energy_total_spin_and_lengths_are_kept() {
    let coupling = Matrix3::identity() * -1.0;
    let lattice = Lattice::new(Graph::cubic([4, 4, 6]).unwrap()).nearest(coupling).unwrap();
    let held = lattice.clone().site(Vector3::new(0.0, 0.3, -0.2), Matrix3::zeros()).unwrap();
    let start = disordered(96);
    let changes = |lattice: &Lattice, end: &State| {
        let energy = lattice.energy(end).unwrap() - lattice.energy(&start).unwrap();
        let [now, before] = [end, &start].map(|s| Vector3::from(lattice.total_spin(s).unwrap()));
        let lengths = end
            .iter()
            .zip(&start)
            .map(|(a, b)| (Vector3::from(*a).norm() - Vector3::from(*b).norm()).abs());
        (energy.abs(), (now - before).norm(), lengths.fold(0.0, f64::max))
    };
    for family in FAMILIES {
        let end = rotated(&lattice, family, Order::Four, 0.1, 200, &start);
        let (energy, spin, lengths) = changes(&lattice, &end);
        assert!(lengths < 1e-13, "{family}: {lengths:e}");
        assert!(energy < 1e-4, "{family}: {energy:e}");
        assert_eq!(family == Family::Bonds, spin < 1e-13, "{family}: {spin:e}");
    }
    let end = rotated(&held, Family::Sublattices, Order::Four, 0.1, 200, &start);
    assert!(changes(&held, &end).0 < 1e-12, "{:e}", changes(&held, &end).0);
    let (energy, spin, lengths) = changes(&lattice, &collocated::<2>(&lattice, 0.1, 200, &start));
    assert!(energy < 1e-3 && spin < 1e-12 && lengths < 1e-13, "{energy:e} {spin:e} {lengths:e}");
}

/// The energy of spins along z, by bond and site, is the number of edges.
#[test]
fn graphs_have_their_edges() {
    let edges = |graph: Graph| {
        let up = vec![[0.0, 0.0, 1.0]; graph.sites()];
        Lattice::new(graph).nearest(Matrix3::identity()).unwrap().energy(&up).unwrap()
    };
    use Boundary::{Open, Periodic};
    assert_eq!(edges(Graph::chain(7).unwrap()), 7.0);
    assert_eq!(edges(Graph::chain(2).unwrap().bounded(&[Open]).unwrap()), 1.0);
    assert_eq!(edges(Graph::square([3, 5]).unwrap()), 30.0);
    assert_eq!(edges(Graph::cubic([3, 4, 5]).unwrap()), 180.0);
    let slab = Graph::cubic([3, 4, 5]).unwrap().bounded(&[Open, Periodic, Open]).unwrap();
    assert_eq!(edges(slab), (2 * 4 * 5 + 3 * 4 * 5 + 3 * 4 * 4) as f64);
    assert_eq!(edges(Graph::triangular([4, 5]).unwrap()), 60.0);
    assert_eq!(edges(Graph::honeycomb([4, 5]).unwrap()), 60.0);
    assert_eq!(edges(Graph::kagome([4, 5]).unwrap()), 120.0);
}

/// Graphs whose colours and rows are irregular: the families agree, and parts that no edge joins move as they do alone.
#[test]
fn irregular_graphs_make_the_same_steps() {
    let star: Vec<[usize; 2]> = (1..70).map(|i| [0, i]).collect();
    let mut two: Vec<[usize; 2]> = (0..9).map(|i| [i, (i + 1) % 9]).collect();
    two.extend((10..13).map(|i| [i, i + 1]));
    let open = Graph::square([5, 9]).unwrap().bounded(&[Boundary::Open; 2]).unwrap();
    for graph in [
        Graph::from_edges(70, &star).unwrap(),
        Graph::from_edges(14, &two).unwrap(),
        Graph::kagome([3, 5]).unwrap(),
        Graph::cubic([3, 5, 7]).unwrap(),
        open,
    ] {
        let start = disordered(graph.sites());
        let lattice = Lattice::new(graph).nearest(symmetric() * 0.1).unwrap();
        let square = Matrix3::new(0.1, 0.2, 0.0, 0.2, 0.0, 0.1, 0.0, 0.1, -0.1);
        let lattice = lattice.site(Vector3::new(0.1, 0.2, 0.3), square).unwrap();
        let exact = collocated::<5>(&lattice, 0.1, 5, &start);
        for family in FAMILIES {
            let gap = distance(&rotated(&lattice, family, Order::Six, 0.025, 20, &start), &exact);
            assert!(gap < 1e-9, "{family}: {gap:e}");
        }
    }
    let joint = Lattice::new(Graph::from_edges(14, &two).unwrap()).nearest(symmetric()).unwrap();
    let alone = Lattice::new(Graph::chain(9).unwrap()).nearest(symmetric()).unwrap();
    let (all, ring) = (disordered(14), disordered(9));
    let end = rotated(&joint, AXES, Order::Four, 0.1, 10, &all);
    assert!(
        distance(&end[..9].to_vec(), &rotated(&alone, AXES, Order::Four, 0.1, 10, &ring)) < 1e-14
    );
    // Site 9 has no edge and no energy.
    assert!(distance(&end[9..10].to_vec(), &all[9..10].to_vec()) < 1e-14);
}

/// Factors of sites and of edges: the energy is the sum written out, and families and Gauss's method follow its gradient.
#[test]
fn sites_and_edges_have_factors() {
    let edges: Vec<[usize; 2]> = (0..21).map(|i| [i, (i + 1) % 21]).chain([[3, 11]]).collect();
    let of_edges: Vec<f64> = (0..22).map(|i| (1.7 * f64::from(i)).sin()).collect();
    let of_sites: Vec<f64> = (0..21).map(|i| (0.9 * f64::from(i)).cos()).collect();
    let (field, square) = (Vector3::new(0.2, -0.1, 0.4), symmetric() * 0.5);
    let twisted = symmetric() + dzyaloshinskii(Vector3::new(0.2, 0.5, -0.3));
    let start = disordered(21);
    for coupling in [symmetric(), twisted] {
        let graph = Graph::from_edges(21, &edges).unwrap();
        let lattice = Lattice::new(graph).edges_each(&edges, coupling, of_edges.clone()).unwrap();
        let lattice = lattice.nearest(Matrix3::identity() * 0.1).unwrap();
        let lattice = lattice.site_each(&of_sites, field, square).unwrap();
        let spin = |i: usize| Vector3::from(start[i]);
        let matrix = |at: usize| coupling * of_edges[at] + Matrix3::identity() * 0.1;
        let pairs = edges.iter().enumerate();
        let pairs = pairs.map(|(at, &[a, b])| spin(a).dot(&(matrix(at) * spin(b))));
        let site =
            |i: usize| of_sites[i] * (field.dot(&spin(i)) + spin(i).dot(&(square * spin(i))));
        let direct = pairs.sum::<f64>() + (0..21).map(site).sum::<f64>();
        assert!((lattice.energy(&start).unwrap() - direct).abs() < 1e-13);
        let gradient = lattice.gradient(&start).unwrap();
        for at in 0..63 {
            let energy = |change: f64| {
                let mut spins = start.clone();
                spins[at / 3][at % 3] += change;
                lattice.energy(&spins).unwrap()
            };
            // Exact, for energies of degree two.
            let slope = (energy(0.5) - energy(-0.5)) - gradient[at / 3][at % 3];
            assert!(slope.abs() < 1e-13, "{slope:e}");
        }
        let gradient = |s: &[[f64; 3]], out: &mut [[f64; 3]]| {
            out.copy_from_slice(&lattice.gradient(s).unwrap());
        };
        let mut exact = start.clone();
        let free = Lattice::new(Graph::chain(21).unwrap());
        free.gauss_of::<5, _>(0.1, gradient).unwrap().advance_by(&mut exact, 10).unwrap();
        assert!(distance(&collocated::<5>(&lattice, 0.1, 10, &start), &exact) < 1e-12);
        for family in FAMILIES {
            let gap = distance(&rotated(&lattice, family, Order::Six, 0.02, 50, &start), &exact);
            assert!(gap < 1e-9, "{family}: {gap:e}");
        }
    }
}

/// A field that depends on time is read at the right times: steps keep their orders.
#[test]
fn driven_fields_keep_the_order() {
    let field = |t: f64| [0.8 * (1.3 * t).cos(), 0.8 * (1.3 * t).sin(), 0.3 * t];
    let lattice = ring(6, symmetric()).driven(field);
    let (start, begin) = (disordered(6), 0.7);
    let [exact, finer] =
        [(0.05, 40), (0.025, 80)].map(|steps| collocated_from::<6>(&lattice, begin, steps, &start));
    assert!(distance(&finer, &exact) < 1e-13);
    for family in FAMILIES {
        for (kind, steps) in [(Order::Four, 20), (Order::Six, 16)] {
            let after = |n: u64| {
                let mut spins = start.clone();
                let mut step = lattice.rotations(family, kind, 2.0 / n as f64).unwrap();
                // In two parts.
                step.advance_from(&mut spins, begin, n / 2).unwrap();
                step.advance_from(&mut spins, begin + 1.0, n / 2).unwrap();
                spins
            };
            let found = order(&exact, &after(steps), &after(2 * steps));
            assert!((found - f64::from(kind.number())).abs() < 0.7, "{family} {kind:?}: {found}");
        }
    }
}

/// Damping and a velocity of time, site, spin and ω beside the energy: the solution of DoubleBracket's and the velocity's equation
/// by explicit steps, orders, and lengths.
#[test]
fn damping_and_velocity_have_the_order_and_keep_lengths() {
    let damping = [0.3, 0.2, 0.4];
    let velocity = |t: f64, site: usize, s: [f64; 3], omega: [f64; 3]| {
        [0.2 * s[1] + 0.1 * t.sin(), -0.2 * s[0] + 0.05 * omega[2], 0.03 * site as f64]
    };
    let energy = ring(7, symmetric() + dzyaloshinskii(Vector3::new(0.2, 0.5, -0.3)));
    let driven = energy.clone().damped(damping).unwrap().moved(velocity);
    let (start, begin) = (disordered(7), 0.4);
    let slope = |t: f64, s: &State| -> State {
        let omega = energy.gradient(s).unwrap();
        let of = |i: usize| {
            let (spin, rate) = (Vector3::from(s[i]), Vector3::from(omega[i]));
            let fall = Vector3::from(damping).component_mul(&spin.cross(&rate));
            spin.cross(&(rate + fall + Vector3::from(velocity(t, i, s[i], omega[i])))).into()
        };
        (0..7).map(of).collect()
    };
    let plus = |a: &State, h: f64, b: &State| -> State {
        a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|i| a[i] + h * b[i])).collect()
    };
    let (mut exact, h) = (start.clone(), 1.0 / 2000.0);
    for n in 0..2000 {
        let t = begin + f64::from(n) * h;
        let k1 = slope(t, &exact);
        let k2 = slope(t + 0.5 * h, &plus(&exact, 0.5 * h, &k1));
        let k3 = slope(t + 0.5 * h, &plus(&exact, 0.5 * h, &k2));
        let k4 = slope(t + h, &plus(&exact, h, &k3));
        for (k, weight) in [(&k1, 1.0), (&k2, 2.0), (&k3, 2.0), (&k4, 1.0)] {
            exact = plus(&exact, weight * h / 6.0, k);
        }
    }
    let end = collocated_from::<5>(&driven, begin, (0.1, 10), &start);
    assert!(distance(&end, &exact) < 1e-11, "{:e}", distance(&end, &exact));
    let lengths =
        end.iter().zip(&start).map(|(a, b)| Vector3::from(*a).norm() - Vector3::from(*b).norm());
    assert!(lengths.fold(0.0, |largest: f64, gap| largest.max(gap.abs())) < 2e-15);
    nodes_have_their_orders(&driven, (begin, 1.0), [20, 8, 6], &start, &exact);
}

#[cfg(feature = "ensemble")]
#[test]
fn threads_make_the_same_bits() {
    let coupling = symmetric() * 0.2;
    let lattice = Lattice::new(Graph::cubic([13, 15, 17]).unwrap()).nearest(coupling).unwrap();
    let start = disordered(13 * 15 * 17);
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let family = |family| rotated(&lattice, family, Order::Two, 0.1, 2, &start);
        pool.install(|| (FAMILIES.map(family), collocated::<2>(&lattice, 0.1, 2, &start)))
    };
    let one = of(1);
    assert!(one == of(2) && one == of(3));
}

/// A rotation far beyond the reach of the series, and back.
#[test]
fn long_rotations_are_exact() {
    let field = Vector3::new(30.0, -40.0, 120.0);
    let lattice = Lattice::new(Graph::chain(3).unwrap()).site(field, Matrix3::zeros()).unwrap();
    let start = disordered(3);
    let turn = nalgebra::Rotation3::from_scaled_axis(-field * 0.5);
    let exact: State = start.iter().map(|s| (turn * Vector3::from(*s)).into()).collect();
    for family in [Family::Bonds, Family::Sublattices] {
        let gap = distance(&rotated(&lattice, family, Order::Two, 0.5, 1, &start), &exact);
        assert!(gap < 1e-13, "{family}: {gap:e}");
    }
}

#[test]
fn mistakes_are_refused_in_words() {
    let one = Matrix3::identity();
    let chain = |n| Lattice::new(Graph::chain(n).unwrap());
    let message = |error: LatticeError| error.to_string();
    for (error, words) in [
        (Graph::cubic([4, 0, 4]).unwrap_err(), "axis 1 of the lattice has length 0"),
        (Graph::cubic([1 << 20; 3]).unwrap_err(), "too many sites or edges"),
        (Graph::from_edges(3, &[[0, 3]]).unwrap_err(), "numbered from 0 to 2"),
        (Graph::from_edges(3, &[[1, 1]]).unwrap_err(), "joins site 1 with itself"),
        (Graph::from_edges(3, &[[0, 1], [1, 0]]).unwrap_err(), "joins sites 0 and 1 twice"),
        (chain(4).bond([1, 0], one).unwrap_err(), "2 numbers, and the lattice 1 axes"),
        (chain(4).bond([4], one).unwrap_err(), "joins site 0 with itself"),
        (chain(2).bond([1], one).unwrap_err(), "joins sites 0 and 1 twice"),
        (chain(4).bond_between([1], [0, 1], one).unwrap_err(), "no site 1"),
        (chain(4).bond([1], one * f64::NAN).unwrap_err(), "not finite"),
        (
            Graph::from_edges(3, &[]).map(Lattice::new).unwrap().nearest(one).unwrap_err(),
            "no edges",
        ),
        (
            ring(4, one).damped([0.1; 3]).unwrap().rotations(AXES, Order::Four, 0.1).unwrap_err(),
            "axes are of the energy alone: damping and a velocity are made by `gauss`",
        ),
        (ring(4, one).damped([f64::NAN; 3]).unwrap_err(), "not finite"),
        (ring(4, one).rotations(AXES, Order::Four, 0.0).unwrap_err(), "step size 0 is not usable"),
        (ring(4, one).gauss::<2>(f64::NAN).unwrap_err(), "step size NaN is not usable"),
        (
            chain(4).site_each(&[1.0; 3], Vector3::x(), one).unwrap_err(),
            "3 factors, and 4 are needed",
        ),
        (chain(4).bond_each([1], [0, 0], one, vec![f64::NAN; 4]).unwrap_err(), "not finite"),
        (ring(4, one).energy(&disordered(3)).unwrap_err(), "3 spins, and the lattice 4 sites"),
    ] {
        assert!(message(error).contains(words), "{error}");
    }
    let mut spins = disordered(4);
    spins[2][1] = f64::INFINITY;
    let before = spins.clone();
    let mut step = ring(4, one).rotations(Family::Bonds, Order::Four, 0.1).unwrap();
    assert_eq!(step.advance_by(&mut spins, 1), Err(LatticeError::NonFinite { site: 2 }));
    assert_eq!(spins, before);
    // A step too long for its nodes leaves the state before it.
    let mut spins = disordered(4);
    let error = ring(4, one * 50.0).gauss::<2>(1.0).unwrap().advance_by(&mut spins, 3).unwrap_err();
    assert!(matches!(error, LatticeError::TooLong { steps: 0, .. }), "{error}");
    assert_eq!(spins, disordered(4));
    let mut wild = ring(4, one).gauss_of::<2, _>(0.1, |_, out| out.fill([f64::NAN; 3])).unwrap();
    let error = wild.advance_by(&mut spins, 3).unwrap_err();
    assert!(error.to_string().contains("the residual is not finite"), "{error}");
    assert_eq!(spins, disordered(4));
}
