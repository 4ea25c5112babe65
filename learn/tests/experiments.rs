//! The experiments of `coadjoint reproduce`, in their short versions, against the bars.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint_learn::LearnError;
use coadjoint_learn::experiment::{Cell, Report, RunOptions, run};

fn quick(name: &str) -> Report {
    let options = RunOptions { quick: true, seed: 0, out: None };
    run(name, &options, &mut |_| {}).unwrap().remove(0)
}

fn number(report: &Report, table: usize, row: &str, column: usize) -> f64 {
    let found = report.tables[table].rows.iter().find(|r| r[0] == Cell::from(row)).unwrap();
    match found[column] {
        Cell::Number(value) => value,
        Cell::Text(_) => f64::NAN,
    }
}

/// Every integrator conserves J_L to rounding (here over 500 steps), RK45 does not; K helps.
#[test]
fn simulation() {
    let report = quick("simulation");
    println!("{}", report.text());
    for k in [3, 5, 7] {
        for chart in ["Cayley", "exp"] {
            assert!(number(&report, 0, &format!("{chart} K={k}"), 2) < 1e-13);
        }
    }
    assert!(number(&report, 0, "RK45 default", 2) > 1e-3);
    assert!(number(&report, 0, "exp K=7", 3) < 1e-2 * number(&report, 0, "exp K=5", 3));
    assert_eq!(report.curves[0].rows.len(), 501);
    assert_eq!(report.curves[0].columns.len(), report.curves[0].rows[0].len());
}

#[test]
fn table_two() {
    let report = quick("table-2");
    println!("{}", report.text());
    assert!(number(&report, 0, "p eliminated, degree 4", 1) <= 1e-11);
    assert!(number(&report, 0, "p eliminated, degree 6", 1) <= 1e-15);
    assert!(number(&report, 0, "identity, mu'' = mu'", 1) > 1e-3);
}

#[test]
fn geometrize() {
    let report = quick("geometrize");
    println!("{}", report.text());
    assert!(number(&report, 0, "geometrized_4", 2) <= 1e-12);
    assert!(number(&report, 0, "geometrized_4", 3) <= 2e-3);
    assert!(number(&report, 0, "euler", 3) > 0.2);
}

/// The Hamiltonian of the remark is right up to O(Δt²): slope 2 at the smallest steps.
#[test]
fn hamiltonian() {
    let report = quick("hamiltonian");
    println!("{}", report.text());
    let slopes: Vec<f64> = report.tables[0]
        .rows
        .iter()
        .filter_map(|row| if let Cell::Number(v) = row[3] { Some(v) } else { None })
        .collect();
    assert!(slopes.iter().all(|s| (s - 2.0).abs() < 0.2), "{slopes:?}");
}

/// The fit over the box is as good as the series of the same powers of t, or better.
#[test]
fn hamilton_jacobi() {
    let report = quick("hamilton-jacobi");
    println!("{}", report.text());
    let Cell::Number(fitted) = report.tables[0].rows[1][4] else { panic!("no figure") };
    let Cell::Number(series) = report.tables[0].rows[1][5] else { panic!("no figure") };
    assert!(fitted < 2.0 * series, "{fitted:e} {series:e}");
}

/// Both estimates of the proposition have slope 1 and respect their bounds.
#[test]
fn reduction_error() {
    let report = quick("reduction-error");
    println!("{}", report.text());
    for row in &report.tables[0].rows[2..] {
        for (slope, ratio) in [(2, 3), (5, 6)] {
            assert!(matches!(row[slope], Cell::Number(s) if (s - 1.0).abs() < 0.01), "{row:?}");
            assert!(matches!(row[ratio], Cell::Number(r) if r < 1.0 + 1e-6), "{row:?}");
        }
    }
}

/// `all` goes on where it stopped: what is on disk is not computed again.
#[test]
fn finished_experiments_are_read_back() {
    let out = std::env::temp_dir().join(format!("coadjoint-runs-{}", std::process::id()));
    let options = RunOptions { quick: true, seed: 3, out: Some(out.clone()) };
    let first = run("reduction-error", &options, &mut |_| {}).unwrap();
    let csv = std::fs::read_to_string(out.join("reduction-error.csv")).unwrap();
    assert!(csv.starts_with("size,group_error,covector_error\n"));
    let text = std::fs::read_to_string(out.join("reduction-error.json")).unwrap();
    let back: Report = serde_json::from_str(&text).unwrap();
    assert_eq!(back.tables, first[0].tables);
}

#[test]
fn unknown_names_are_refused_with_the_list() {
    let error = run("table-3", &RunOptions::default(), &mut |_| {}).unwrap_err();
    assert!(matches!(error, LearnError::InvalidOption { .. }));
    assert!(error.to_string().contains("table-1"), "{error}");
}

/// An interrupted experiment keeps the tables it has made: with one of them on disk, only the
/// others are made, and the end is that of an uninterrupted run. `all` then reads it back.
#[test]
fn an_interrupted_run_goes_on_where_it_stopped() {
    let out = std::env::temp_dir().join(format!("coadjoint-interrupted-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&out);
    std::fs::create_dir_all(&out).unwrap();
    let options = RunOptions { quick: true, seed: 5, out: Some(out.clone()) };
    let mut lines = Vec::new();
    let whole = run("table-2", &options, &mut |line| lines.push(line.to_owned())).unwrap();
    assert!(lines.iter().any(|line| line.contains("dt = 1")), "{lines:?}");
    assert!(!out.join("table-2.part").exists());

    // What a run killed after its table has left.
    let mut part = whole[0].clone();
    part.notes.clear();
    std::fs::write(out.join("table-2.part"), serde_json::to_string(&part).unwrap()).unwrap();
    std::fs::remove_file(out.join("table-2.json")).unwrap();
    lines.clear();
    let again = run("table-2", &options, &mut |line| lines.push(line.to_owned())).unwrap();
    assert_eq!(lines, ["table-2 …"]);
    assert_eq!(again[0], whole[0]);
    assert!(!out.join("table-2.part").exists() && out.join("table-2.json").exists());
    // A part of another seed is not ours.
    std::fs::write(out.join("table-2.part"), serde_json::to_string(&part).unwrap()).unwrap();
    let other = RunOptions { seed: 6, ..options.clone() };
    assert_ne!(run("table-2", &other, &mut |_| {}).unwrap()[0].tables, whole[0].tables);

    // `all` takes what is done and stops at what cannot be: here a damaged file is made anew.
    std::fs::write(out.join("reduction-error.json"), "{").unwrap();
    let report = run("reduction-error", &options, &mut |_| {}).unwrap();
    for name in coadjoint_learn::experiment::NAMES {
        let done = Report { name: name.into(), ..report[0].clone() };
        std::fs::write(out.join(format!("{name}.json")), serde_json::to_string(&done).unwrap())
            .unwrap();
    }
    lines.clear();
    let all = run("all", &options, &mut |line| lines.push(line.to_owned())).unwrap();
    assert_eq!(all.len(), coadjoint_learn::experiment::NAMES.len());
    assert!(lines.iter().all(|line| line.ends_with("done already")), "{lines:?}");
}
