//! `simulate` of lattices: the bits of the library, the motion of ordinary files, refusals, the same bytes for any threads.

use std::path::Path;

use coadjoint::lattice::{Family, Graph, Lattice, Order};
use coadjoint_learn::{npy_header, table::array};
use nalgebra::{Matrix3, Vector3};

use crate::support::{Folder, distance, numbers};

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

/// Eight spins on an open cube, and others, move as an ordinary file of the group SO3^n has them.
#[test]
fn lattices_move_as_products_of_groups() {
    let run = "[integrator]\nstep = 0.025\ntruncation = 7\n[run]\ntime = 1\n[initial]\nmomentum = ";
    let dot = "x[P]*x[Q] + y[P]*y[Q] + z[P]*z[Q]";
    let cube = "sum(i, 0..4, [2*i,2*i+1]) + sum(i, 0..4, [i,i+4]) + sum(i, 0..2, [4*i,4*i+2] + [4*i+1,4*i+3])";
    let pairs = |text: &str, energy: &str| {
        let mut out = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once("[") {
            let (pair, after) = after.split_once("]").unwrap();
            let (p, q) = pair.split_once(",").unwrap();
            out += before;
            out += &format!("({})", energy.replace('P', p).replace('Q', q));
            rest = after;
        }
        out + rest
    };
    let ring = "sum(i, 0..4, [i,(i + 1) % 4])";
    let dzyaloshinskii = "0.4*(y[P]*z[Q] - z[P]*y[Q]) + 0.7*(x[P]*y[Q] - y[P]*x[Q])";
    let driven = "sum(i, 0..4, 0.3*cos(2*t)*x[i] + 0.2*z[i]^2)";
    for (lattice, group, energy) in [
        (
            "shape = [2, 2, 2]\nboundary = \"open\"\n[[lattice.bond]]\noffset = [1, 0, 0]\nenergy = 'dot(a, b)'\n\
             [[lattice.bond]]\noffset = [0, 1, 0]\nenergy = 'dot(a, b)'\n[[lattice.bond]]\noffset = [0, 0, 1]\nenergy = 'dot(a, b)'",
            "SO3^8",
            pairs(cube, dot),
        ),
        (
            "shape = [4]\nsite = '0.3*cos(2*t)*x + 0.2*z^2'\n[[lattice.bond]]\noffset = [1]\nenergy = 'dot(a, b) + dot(d, cross(a, b))'\n\
             [parameters]\nd = [0.4, 0, 0.7]",
            "SO3^4",
            format!("{} + {driven}", pairs(ring, &format!("{dot} + {dzyaloshinskii}"))),
        ),
        (
            "shape = [4]\nsite = 'cos(x)'\n[[lattice.bond]]\noffset = [1]\nenergy = 'dot(a, b)^2'",
            "SO3^4",
            format!("{} + sum(i, 0..4, cos(x[i]))", pairs(ring, &format!("({dot})^2"))),
        ),
    ] {
        let start = "['cos(i)', 'sin(2*i)', 0.5]\n";
        let places = start
            .replace('i', if group == "SO3^8" { "(4*i + 2*j + k)" } else { "i" })
            .replace("s(4*i + 2*j + k)n", "sin");
        let folder = Folder::new();
        let head = "group = 'SO3'\n[lattice]\n";
        folder.write("lattice.toml", format!("{head}{lattice}\n{run}{places}"));
        let coordinates = "coordinates = ['x', 'y', 'z']";
        let method = run.replace("truncation = 7", "method = 'collocation'\ntruncation = 9");
        let text =
            format!("group = '{group}'\n{coordinates}\nhamiltonian = '{energy}'\n{method}{start}");
        folder.write("whole.toml", text);
        folder.run("simulate lattice.toml --final end.npy").ok();
        let whole = folder.run("simulate whole.toml --no-estimate --format json").json();
        let gap = distance(
            array(&folder.at("end.npy")).unwrap().1.as_slice(),
            &numbers(&whole["momentum"]),
        );
        assert!(gap < 1e-10, "{energy}: {gap:e}");
    }
}

#[test]
fn mistakes_in_lattices_are_reported_at_their_places() {
    let (folder, [d, k, start]) = cube();
    let changed = |from: &str, to: &str| CUBE.replacen(from, to, 1);
    for (from, to, words) in [
        ("\"SO3\"", "\"SE3\"", "3:9: error: the sites of a lattice are spins: the group is SO3"),
        ("[lattice]", "hamiltonian = \"x\"\n[lattice]", "5:1: error: unknown key `hamiltonian`"),
        (
            "shape = [3, 4, 5]",
            "shape = [3, 4, 5]\nkind = \"kagome\"",
            "6:9: error: `shape` has 3 lengths: a kagome lattice has 2 axes",
        ),
        (
            "shape = [3, 4, 5]",
            "shape = [3, 0, 5]",
            "6:9: error: axis 1 of the lattice has length 0",
        ),
        ("shape = [3, 4, 5]", "kind = \"kagom\"", "unknown kind `kagom`; did you mean `kagome`?"),
        (
            "\"open\", ",
            "",
            "7:12: error: `boundary` is periodic or open, one word or 3 in a list, one an axis",
        ),
        ("D*z^2", "D*w^2", "8:11: error: unknown variable `w`"),
        ("D*z^2", "D*z^2*cos(t)", "8:8: error: `t` stands in the field on all sites alone"),
        ("D*z^2", "D*z^3", "of degree two in the spins"),
        ("dot(a, b)", "dot(a, c)", "11:14: error: dot(a, b) is of two vectors"),
        (
            "dot(a, b)",
            "a.x^2",
            "11:10: error: the energy of a bond has both of its spins in each term",
        ),
        ("offset = [1, 0, 0]", "offset = [3, 0, 0]", "error: an edge joins site 0 with itself"),
        (
            "offset = [1, 0, 0]",
            "offset = [1, 0]",
            "error: the offset has 2 numbers, and the lattice 3 axes",
        ),
        (
            "offset = [1, 0, 0]",
            "offset = [1, 0, 0]\nto = 1",
            "error: there is no site 1: sites are numbered from 0 to 0",
        ),
        ("offset = [1, 0, 0]", "", "`offset` is missing"),
        ("matrix = [[\"-J\", 0, 0], ", "matrix = [", "`matrix` has three rows of three numbers"),
        (
            "\"D.npy\"",
            "\"K.npy\"",
            "error: K.npy has 45 numbers, and there are 60 sites: a table has one number for each",
        ),
        (
            "\"K.npy\"",
            "\"D.npy\"",
            "error: D.npy has 60 numbers, and there are 45 edges of the bond",
        ),
        ("\"D.npy\"", "\"nan.npy\"", "error: nan.npy: number 3 of the array is NaN, not finite"),
        ("\"D.npy\"", "\"none.npy\"", "cannot read or write none.npy"),
        (
            "\"spins.npy\"",
            "\"D.npy\"",
            "error: D.npy has the shape [3, 4, 5], and the lattice 60 sites: write (60, 3)",
        ),
        ("{ table = \"spins.npy\" }", "\"random\"", "`seed` is missing"),
        ("{ table = \"spins.npy\" }", "[1, \"1/i\", 0]", "the spin of site 0 is not finite"),
        (
            "{ table = \"spins.npy\" }",
            "7",
            "`momentum` must be { table = \"spins.npy\" }, \"random\", or three formulas in i, j, k",
        ),
        (
            "splitting = \"bonds\"",
            "splitting = \"bond\"",
            "unknown splitting `bond`; did you mean `bonds`?",
        ),
        (
            "splitting = \"bonds\"",
            "splitting = \"bonds\"\nmethod = \"collocation\"",
            "`method` and `splitting` are both given",
        ),
        ("splitting = \"bonds\"", "truncation = 4", "truncation 4 is even"),
        ("step = 0.1", "tolerance = 1e-9\nstep = 0.1", "keep one of `tolerance` and `step`"),
        ("step = 0.1\n", "", "`[integrator] step` is missing"),
        ("-J*dot(a, b)", "dot(a, b)^2", "rotations are of energies of degree two"),
        (
            "0.3*a.x*b.x",
            "0.3*a.x*b.y\"\n#\"",
            "axes admit couplings by symmetric matrices only: take bonds",
        ),
    ] {
        let text = changed(from, to);
        assert_ne!(text, CUBE, "{from}");
        let text =
            if words.starts_with("axes") { text.replace("\"bonds\"", "\"axes\"") } else { text };
        folder.write("system.toml", text);
        npy(&folder, "nan.npy", &[60], &[&d[..3], &[f64::NAN; 57]].concat());
        folder.run("simulate system.toml").fails(2, &[words]);
    }
    folder.write("system.toml", CUBE);
    for verb in ["check", "derive", "emit --language c", "ensemble --initial K.npy --out e.npy"] {
        folder
            .run(&format!("{verb} system.toml"))
            .fails(2, &["system.toml:5:1: error: a lattice runs by"]);
    }
    folder
        .run("simulate system.toml --plot p.svg")
        .fails(2, &["--plot is not for a lattice: plot the"]);
    folder.run("simulate system.toml --final e.csv").fails(2, &["ends in .npy"]);
    folder
        .run("simulate examples/rigid_body.toml --final e.npy")
        .fails(2, &["is the end of a lattice"]);
    drop((k, start));
}

/// A chosen method and step meet the tolerance; the cut has sixteen cells an axis.
#[test]
fn tolerances_are_met() {
    let folder = Folder::with(
        "group = 'SO3'\n[lattice]\nkind = 'triangular'\nshape = [20, 18]\nsite = '-z/2'\n[[lattice.bond]]\noffset = [1, 0]\n\
         energy = '-dot(a, b)'\n[[lattice.bond]]\noffset = [0, 1]\nenergy = '-dot(a, b)'\n[initial]\n\
         momentum = ['cos(i/4)', 'sin(j/3)', 1]\n[integrator]\ntolerance = 1e-6\n[run]\ntime = 2\n",
    );
    let report = folder.run("simulate system.toml --final a.npy --format json").json();
    assert!(report["estimated_error"].as_f64().unwrap() <= 1e-6, "{report}");
    assert_eq!(report["tried"].as_array().unwrap().len(), 6, "{report}");
    folder.run("simulate system.toml --final b.npy --tolerance 1e-10").ok();
    let [a, b] = ["a.npy", "b.npy"].map(|name| array(&folder.at(name)).unwrap().1);
    assert!(distance(&a, &b) < 1e-6 * (a.len() as f64).sqrt());
    folder.run("simulate system.toml --tolerance 1e-14").fails(2, &["meets the tolerance 1e-14"]);
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
    let lattice =
        coadjoint_run::lattice::Lattice::read(&path, &text, &Default::default()).unwrap().unwrap();
    let known = [
        [-0.9966007768142786, -0.0027081762292681254, -0.0823380679557617],
        [-0.3197191109585733, 0.5661120624858509, -0.7598005151326732],
    ];
    assert_eq!([lattice.start()[0], lattice.start()[5]], known);
}
