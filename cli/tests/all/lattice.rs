//! `simulate` of lattices: the bits of the library, the same bytes for any threads; cases `lattice_*` show the rest.

use std::path::Path;

use coadjoint::lattice::{Family, Graph, Lattice, Order};
use coadjoint_learn::{npy_header, table::array};
use nalgebra::{Matrix3, Vector3};

use crate::support::{Folder, distance, text_of};

const CUBE: &str = r#"
name = "cube"
group = "SO3"
coordinates = ["x", "y", "z"]
[lattice]
shape = [3, 4, 5]
boundary = ["periodic", "open", "periodic"]
site = "D*z^2 - B*z"
[[lattice.bond]]
offset = [1, 0, 0]
energy = "-J*dot(a, b)"
[[lattice.bond]]
offset = [0, 1, 0]
energy = "-K*dot(a, b)"
[lattice.bond.parameters]
K = { table = "K.npy" }
[[lattice.bond]]
offset = [0, 1, 0]
energy = "0.3*a.x*b.x"
[[lattice.bond]]
offset = [0, 0, 1]
matrix = [["-J", 0, 0], [0, "-J", 0], [0, 0, -0.5]]
[parameters]
J = 1
B = 0.1
D = { table = "D.npy" }
[integrator]
step = 0.1
splitting = "bonds"
[initial]
momentum = { table = "spins.npy" }
[run]
time = 2
"#;

fn npy(folder: &Folder, name: &str, shape: &[u64], numbers: &[f64]) {
    let mut bytes = npy_header(shape);
    numbers.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    folder.write(name, bytes);
}

fn spins(path: &Path) -> Vec<[f64; 3]> {
    let (shape, numbers) = array(path).unwrap();
    assert_eq!(shape, [numbers.len() / 3, 3]);
    numbers.as_chunks::<3>().0.to_vec()
}

fn wave(count: usize, speed: f64) -> Vec<f64> {
    (0..count).map(|i| (speed * i as f64).sin()).collect()
}

/// The folder of `CUBE` with its tables.
fn cube() -> (Folder, [Vec<f64>; 3]) {
    let folder = Folder::with(CUBE);
    let tables = [wave(60, 1.3), wave(45, 0.7), wave(180, 2.9)];
    npy(&folder, "D.npy", &[3, 4, 5], &tables[0]);
    npy(&folder, "K.npy", &[45], &tables[1]);
    npy(&folder, "spins.npy", &[60, 3], &tables[2]);
    (folder, tables)
}

#[test]
fn a_file_has_the_bits_of_the_library() {
    let (folder, [d, k, start]) = cube();
    let records = "simulate system.toml --final end.npy --out run.csv --every 5 --format json";
    let report = folder.run(records).json();
    let one = Matrix3::identity();
    let xx = Matrix3::from_diagonal(&Vector3::new(0.3, 0.0, 0.0));
    let zz = Matrix3::from_diagonal(&Vector3::z());
    use coadjoint::lattice::Boundary::{Open, Periodic};
    let graph = Graph::cubic([3, 4, 5]).unwrap().bounded(&[Periodic, Open, Periodic]).unwrap();
    let crystal = Lattice::new(graph)
        .site_each(&d, Vector3::zeros(), zz)
        .and_then(|lattice| lattice.site(Vector3::new(0.0, 0.0, -0.1), Matrix3::zeros()))
        .and_then(|lattice| lattice.bond([1, 0, 0], -one))
        .and_then(|lattice| lattice.bond_each([0, 1, 0], [0, 0], -one, k))
        .and_then(|lattice| lattice.bond([0, 1, 0], xx))
        .and_then(|lattice| {
            lattice.bond([0, 0, 1], Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, -0.5)))
        });
    let crystal = crystal.unwrap();
    let mut expected: Vec<[f64; 3]> = start.as_chunks::<3>().0.to_vec();
    let energy = crystal.energy(&expected).unwrap();
    let mut step = crystal.rotations(Family::Bonds, Order::Six, 0.1).unwrap();
    step.advance_by(&mut expected, 20).unwrap();
    assert_eq!(spins(&folder.at("end.npy")), expected);
    assert_eq!(report["method"], "bonds, order 6");
    assert_eq!(report["start"]["energy"], energy);
    assert_eq!(report["end"]["energy"], crystal.energy(&expected).unwrap());
    let drift = &report["drift"];
    assert!(
        drift["length"].as_f64().unwrap() < 1e-13
            && drift["energy_per_site"].as_f64().unwrap().abs() < 1e-6
    );
    let text = folder.text("run.csv");
    assert!(
        text.contains("\nt,m_1,m_2,m_3,energy\n0,") && text.ends_with("# complete: 5 records\n"),
        "{text}"
    );
    // The estimate is of the size of the error, by an eighth of the step.
    folder.run("simulate system.toml --final fine.npy --step 0.0125").ok();
    let [end, fine] = ["end.npy", "fine.npy"].map(|name| array(&folder.at(name)).unwrap().1);
    let truth = distance(&end, &fine);
    let found = report["estimated_error"].as_f64().unwrap();
    assert!((0.05..20.0).contains(&(found / truth)), "{found:e}, in truth {truth:e}");
}

/// A graph by its edges with types, spins by a seed, and the same bytes for any number of threads.
#[test]
fn threads_make_the_same_bytes() {
    let folder = Folder::with(
        "group = 'SO3'\n[lattice]\nedges = 'edges.npy'\nsite = 'D*x^2'\n[parameters]\nD = { table = 'D.npy' }\n[[lattice.bond]]\n\
         type = 0\nenergy = '-dot(a, b)'\n[[lattice.bond]]\ntype = 1\nenergy = '0.2*a.x*b.y + K*dot(a, b)'\nparameters = { K = { table = 'K.npy' } }\n\
         [initial]\nmomentum = 'random'\nseed = 7\n[integrator]\nstep = 0.1\nsplitting = 'SPLITTING'\n[run]\ntime = 0.5\n",
    );
    let count = 9000;
    let ring = (0..count).map(|i| [i as f64, ((i + 1) % count) as f64, 0.0]);
    let far = (0..count).map(|i| [i as f64, ((i + 97) % count) as f64, 1.0]);
    let edges: Vec<[f64; 3]> = ring.chain(far).collect();
    npy(&folder, "edges.npy", &[2 * count as u64, 3], edges.as_flattened());
    npy(&folder, "D.npy", &[count as u64], &wave(count, 0.3));
    npy(&folder, "K.npy", &[count as u64], &wave(count, 0.4));
    let text = folder.text("system.toml");
    for splitting in ["bonds", "sublattices"] {
        folder.write("system.toml", text.replace("SPLITTING", splitting));
        let made = |threads: &str| {
            let mut command = folder.command(
                "simulate system.toml --time 0.2 --no-estimate --final end.npy --out run.npy",
            );
            assert!(command.env("RAYON_NUM_THREADS", threads).status().unwrap().success());
            (folder.bytes("end.npy"), folder.bytes("run.npy"))
        };
        let one = made("1");
        assert!(one == made("2") && one == made("3"), "{splitting}");
    }
    // By another program, from the description.
    let path = folder.at("system.toml");
    let text = text.replace("SPLITTING", "auto");
    let lattice = coadjoint_run::lattice::Simulation::read(&path, &text, &Default::default())
        .unwrap()
        .unwrap();
    let known = [
        [-0.9966007768142786, -0.0027081762292681254, -0.0823380679557617],
        [-0.3197191109585733, 0.5661120624858509, -0.7598005151326732],
    ];
    assert_eq!([lattice.start()[0], lattice.start()[5]], known);
}

/// The skyrmion of the manual: its charge, and the energy of the same equation by DOP853 of SciPy at rtol = 1e-9; records of a site.
#[test]
fn damping_relaxes_a_skyrmion() {
    let folder = Folder::with(
        &(text_of("examples/lattices/skyrmion.toml").replace("truncation = 3", "truncation = 5")
            + "sites = [119]\n"),
    );
    let run =
        "simulate system.toml --no-estimate --every 50 --format json --out run.csv --final end.npy";
    let report = folder.run(run).json();
    let energy = report["end"]["energy"].as_f64().unwrap();
    assert!((energy + 577.203_143_345).abs() < 1e-6, "{energy}");
    assert!(report["drift"]["length"].as_f64().unwrap() < 1e-13);
    let end = spins(&folder.at("end.npy"));
    let spin = |i: usize, j: usize| Vector3::from(end[i % 16 * 16 + j % 16]);
    let triangle = |a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>| {
        2.0 * a.dot(&b.cross(&c)).atan2(1.0 + a.dot(&b) + b.dot(&c) + c.dot(&a))
    };
    let cell = |i: usize, j: usize| {
        let [a, b, c, d] = [spin(i, j), spin(i + 1, j), spin(i + 1, j + 1), spin(i, j + 1)];
        triangle(a, b, c) + triangle(a, c, d)
    };
    let charge: f64 = (0..256).map(|at| cell(at / 16, at % 16)).sum();
    assert!((charge / (4.0 * std::f64::consts::PI) + 1.0).abs() < 1e-9, "{charge}");
    let text = folder.text("run.csv");
    assert!(text.contains("\nt,m_1,m_2,m_3,energy,x[119],y[119],z[119]\n0,"), "{text}");
    let last = text.lines().rev().nth(1).unwrap();
    let last: Vec<f64> = last.split(',').skip(5).map(|x| x.parse().unwrap()).collect();
    assert_eq!(last, end[119]);
}

/// Its picture is that of the manual.
#[test]
fn a_plane_is_drawn() {
    let folder = Folder::with(&text_of("examples/lattices/skyrmion.toml"));
    folder.run("simulate system.toml --no-estimate --plot p.svg").ok();
    assert_eq!(folder.text("p.svg"), text_of("docs/images/skyrmion.svg"));
    let cube =
        text_of("examples/lattices/heisenberg_cube.toml").replace("[64, 64, 64]", "[3, 4, 3]");
    folder.write("cube.toml", cube);
    folder.run("simulate cube.toml --no-estimate --time 0.1 --plot p.svg").ok();
    let picture = folder.text("p.svg");
    assert!(picture.contains(">layer k = 0</text>"));
    // Twelve squares and arrows.
    assert!((12..=24).contains(&picture.matches("<polygon").count()));
}
