//! Reading data files and refusing what cannot be used, with row numbers.
#![allow(clippy::unwrap_used)]

use std::io::Write;
use std::path::PathBuf;

use coadjoint::SO3;
use coadjoint::groups::{Cayley, Exponential};
use coadjoint_learn::data::{PhasePair, Recording, Reduction, RowPolicy, TOLERANCE, open, reduce};
use coadjoint_learn::table::Cells;
use coadjoint_learn::truth::{MomentumBox, Separable, phase_pairs};
use coadjoint_learn::{LearnError, RowProblem, npy_header};

use crate::support::csv_of;

fn path(name: &str) -> PathBuf {
    let directory = std::env::temp_dir().join(format!("coadjoint-data-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    directory.join(name)
}

fn pairs(step: f64, count: usize) -> Vec<PhasePair<SO3>> {
    phase_pairs(&SO3::new(), &Separable::paper(), step, MomentumBox::PAPER, count, 7)
}

fn load(path: &std::path::Path) -> Result<Reduction, LearnError> {
    let group = SO3::new();
    let recording = Recording::read(open(path)?, 3, 3)?;
    let rows = recording.phase_pairs(&group, 1e-6)?;
    reduce::<SO3, Exponential>(&group, &rows, TOLERANCE, RowPolicy::Refuse)
}

fn csv(name: &str, text: &str) -> PathBuf {
    let path = path(name);
    std::fs::File::create(&path).unwrap().write_all(text.as_bytes()).unwrap();
    path
}

/// The numbers that were written are read back, in every format with names.
#[test]
fn files_read_back_what_was_written() {
    let pairs = pairs(0.1, 20);
    let text = csv_of(&SO3::new(), &pairs);
    let file = csv("pairs.csv", &text);
    let found = load(&file).unwrap().data;
    let direct =
        reduce::<SO3, Exponential>(&SO3::new(), &pairs.into(), TOLERANCE, RowPolicy::Refuse);
    let direct = direct.unwrap().data;
    assert_eq!(found.momenta, direct.momenta);
    // Attitudes pass through matrices.
    assert!((found.x - direct.x).amax() < 1e-14);
    assert!((found.p - direct.p).amax() < 1e-13);
    #[cfg(feature = "parquet")]
    {
        let names: Vec<String> = text.lines().next().unwrap().split(',').map(Into::into).collect();
        let rows = text.lines().skip(1).flat_map(|line| line.split(','));
        let mut rows = Some(rows.map(|cell| cell.parse().unwrap()).collect());
        let next = || Ok(rows.take().unwrap_or_default());
        let other = path("pairs.parquet");
        let to = std::fs::File::create(&other).unwrap();
        coadjoint_learn::table::write_parquet(to, &names, next).unwrap();
        assert_eq!(load(&other).unwrap(), load(&file).unwrap());
    }
}

#[test]
fn both_formulas_for_the_canonical_momentum_agree() {
    use coadjoint::groups::Chart;
    let data = load(&csv("formulas.csv", &csv_of(&SO3::new(), &pairs(0.1, 20)))).unwrap().data;
    for i in 0..data.count() {
        let column = |m: &nalgebra::DMatrix<f64>| nalgebra::Vector3::from_fn(|r, _| m[(r, i)]);
        let p = Exponential.pull_back(&SO3::new(), &column(&data.x), &column(&data.momenta.before));
        assert!((p - column(&data.p)).norm() < 1e-13);
    }
}

#[test]
fn npz_and_npy_hold_the_same_data() {
    let pairs = pairs(0.1, 5);
    let rows: Vec<[f64; 14]> = pairs
        .iter()
        .map(|pair| {
            let (a, b) = (&pair.before, &pair.after);
            let (q, r) = (a.group_element.as_ref(), b.group_element.as_ref());
            let (mu, nu) = (a.momentum, b.momentum);
            [mu.x, mu.y, mu.z, nu.x, nu.y, nu.z, q.w, q.i, q.j, q.k, r.w, r.i, r.j, r.k]
        })
        .collect();
    let array = |first: usize, width: usize| {
        let mut bytes = npy_header(&[5, width as u64]);
        let values = rows.iter().flat_map(|r| r[first..first + width].to_vec());
        bytes.extend(values.flat_map(f64::to_le_bytes));
        bytes
    };
    let npy = path("pairs.npy");
    std::fs::write(&npy, array(0, 14)).unwrap();
    let npz = path("pairs.npz");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&npz).unwrap());
    for (name, first, width) in [("mu", 0, 3), ("mu_next", 3, 3), ("q", 6, 4), ("q_next", 10, 4)] {
        let options = zip::write::SimpleFileOptions::default();
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(&array(first, width)).unwrap();
    }
    archive.finish().unwrap();
    let (a, b) = (load(&npy).unwrap(), load(&npz).unwrap());
    assert_eq!(a, b);
    assert_eq!(a.data.count(), 5);
    assert_eq!(a.data.momenta.before[(1, 2)], pairs[2].before.momentum.y);
}

/// NumPy 2 wrote five arrays with `savez` (stored) and `savez_compressed`, and a matrix whose first index varies fastest in
/// version 2 of the format; see `numpy/write.py`.
#[test]
fn files_of_numpy_are_read() {
    let directory = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/numpy");
    let file = |name: &str| {
        let (mut table, mut row) = (open(&directory.join(name)).unwrap(), Cells::default());
        let mut rows = Vec::new();
        while table.read(&mut row).unwrap() {
            rows.push(row.numbers());
        }
        (table.names().to_vec(), rows)
    };
    let stored = file("stored.npz");
    assert_eq!(stored, file("deflated.npz"));
    let (names, rows) = stored;
    assert_eq!(rows.len(), 200);
    let entry = |row: usize, name: &str| rows[row][names.iter().position(|n| n == name).unwrap()];
    assert_eq!([0, 1, 2].map(|row| entry(row, "mu_2")), [0.25, 1.0, 1.75]);
    assert_eq!((entry(1, "mu_next_3"), entry(1, "g_12")), (-1.25, 10.0));
    assert_eq!((entry(199, "q_z"), entry(7, "weight")), (0.5, 7.0));
    let (_, fortran) = file("fortran_v2.npy");
    assert_eq!(fortran.iter().map(|row| row[3]).collect::<Vec<_>>(), [3.0, 9.0, 15.0, 21.0]);
    assert_eq!(fortran[0].len(), 6);
}

#[test]
fn arrays_that_claim_more_than_they_hold_are_refused() {
    // Version 2, a header of 4 GiB less one byte.
    let mut claims = b"\x93NUMPY\x02\x00".to_vec();
    claims.extend(u32::MAX.to_le_bytes());
    claims.extend(b"{'descr': '<f8', ");
    let long = path("long.npy");
    std::fs::write(&long, &claims).unwrap();
    // More rows than bytes.
    let short = path("short.npy");
    std::fs::write(&short, npy_header(&[1 << 60, 6])).unwrap();
    // The header of the first, in an archive.
    let archived = path("claims.npz");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&archived).unwrap());
    archive.start_file("mu.npy", zip::write::SimpleFileOptions::default()).unwrap();
    archive.write_all(&claims).unwrap();
    archive.finish().unwrap();
    let cut = path("cut.npz");
    let whole = std::fs::read(&archived).unwrap();
    std::fs::write(&cut, &whole[..whole.len() - 30]).unwrap();
    for (file, expected) in [
        (&long, "its header claims 4294967295 bytes; the file has 17 left"),
        (&short, "needs more than the 0 bytes that the file has left"),
        (&archived, "its header claims 4294967295 bytes"),
        (&cut, "NumPy"),
    ] {
        let error = load(file).unwrap_err();
        assert!(matches!(error, LearnError::Format { .. }), "{error}");
        assert!(error.to_string().contains(expected), "{error}");
    }
}

const HEADER: &str = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3,q_w,q_x,q_y,q_z,q_next_w,\
                      q_next_x,q_next_y,q_next_z\n";

#[test]
fn bad_rows_are_named_by_number() {
    // 1: at rest, fine; 2: NaN; 3: a quaternion of length 1.1; 4: momentum not conserved.
    let text = format!(
        "{HEADER}1,2,3,1,2,3,1,0,0,0,1,0,0,0\nNaN,2,3,1,2,3,1,0,0,0,1,0,0,0\n\
         1,2,3,1,2,3,1.1,0,0,0,1,0,0,0\n1,2,3,1,2,4,1,0,0,0,1,0,0,0\n"
    );
    let LearnError::BadRows(bad) = load(&csv("bad.csv", &text)).unwrap_err() else {
        panic!("bad rows are the error")
    };
    assert_eq!(bad.rows.iter().map(|b| b.row).collect::<Vec<_>>(), [2, 3, 4]);
    assert_eq!(bad.rows[0].problem, RowProblem::NonFinite);
    assert!(
        matches!(bad.rows[1].problem, RowProblem::OffGroup(distance) if (distance - 0.1).abs() < 1e-12)
    );
    assert!(
        matches!(bad.rows[2].problem, RowProblem::MomentumMismatch(relative) if (relative - 1.0 / 3.0).abs() < 1e-12)
    );
    let message = bad.to_string();
    assert!(message.starts_with("3 of 4 rows cannot be used:\n  row 2:"), "{message}");
}

#[test]
fn missing_columns_words_and_unknown_endings_are_named() {
    let message = load(&csv("missing.csv", "mu_1,mu_2,mu_3\n1,2,3\n")).unwrap_err().to_string();
    assert!(message.contains("column mu_next_1 is missing"), "{message}");
    let text = format!("{HEADER}1,2,x,1,2,3,1,0,0,0,1,0,0,0\n");
    let message = load(&csv("word.csv", &text)).unwrap_err().to_string();
    assert_eq!(message, "row 1, column mu_3: `x` is not a number");
    let message = load(&csv("bare.csv", "1,2,3,1,2,3\n")).unwrap_err().to_string();
    assert!(message.contains("must name the columns"), "{message}");
    let message = load(&csv("data.xlsx", "")).unwrap_err().to_string();
    assert!(message.contains("the ending must be .csv"), "{message}");
    let message = load(&csv("fake.npz", "not a zip")).unwrap_err().to_string();
    assert!(message.contains("is not a readable NumPy file"), "{message}");
    assert!(matches!(load(&csv("empty.csv", HEADER)), Err(LearnError::NoSamples)));
}

/// Columns that are not ours may hold anything.
#[test]
fn other_columns_are_left_alone() {
    let header = "when,mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3,q_w,q_x,q_y,q_z,q_next_w,\
                  q_next_x,q_next_y,q_next_z,note";
    let text = format!("{header}\n2026-01-01T00:00Z,1,2,3,1,2,3,1,0,0,0,1,0,0,0,ok\n");
    assert_eq!(load(&csv("more.csv", &text)).unwrap().data.count(), 1);
}

#[test]
fn momenta_alone_do_not_give_attitudes() {
    let header = "mu_1,mu_2,mu_3,mu_next_1,mu_next_2,mu_next_3\n";
    let error = load(&csv("momenta.csv", &format!("{header}1,2,3,1,2,3\n"))).unwrap_err();
    assert!(matches!(error, LearnError::NoAttitude), "{error}");
}

/// The Cayley chart folds where θ tan(θ/2) = 1, θ ≈ 1.3065; in the paper's box Δt = 0.35 is beyond
/// it for many samples, while the exponential chart takes them all.
#[test]
fn data_beyond_the_cayley_fold_are_named_and_the_exponential_chart_suggested() {
    let pairs = pairs(0.35, 100).into();
    let result = reduce::<SO3, Cayley>(&SO3::new(), &pairs, TOLERANCE, RowPolicy::Refuse);
    let message = result.unwrap_err().to_string();
    assert!(message.contains("beyond the fold") && message.contains("exponential chart"));
    let dropped = reduce::<SO3, Cayley>(&SO3::new(), &pairs, TOLERANCE, RowPolicy::Drop);
    let dropped = dropped.unwrap();
    assert!(!dropped.dropped.is_empty() && dropped.data.count() + dropped.dropped.len() == 100);
    for i in 0..dropped.data.count() {
        assert!(2.0 * (0.5 * dropped.data.x.column(i).norm()).atan() < 1.3066);
    }
    reduce::<SO3, Exponential>(&SO3::new(), &pairs, TOLERANCE, RowPolicy::Refuse).unwrap();
}

#[cfg(feature = "parquet")]
#[test]
fn damaged_parquet_is_refused() {
    let path = path("rubbish.parquet");
    std::fs::write(&path, b"PAR1 not really").unwrap();
    let message = load(&path).unwrap_err().to_string();
    assert!(message.contains("is not a readable Parquet file"), "{message}");
}
