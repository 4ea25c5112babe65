//! `verify`: right files are found right, and whatever was changed in them is found, by time or row.

use crate::support::{Folder, json, root, run};
use serde_json::Value;

const BODY: &str = "examples/rigid_body.toml";

/// The records of a run.
fn simulate(arguments: &[&str], out: &str) {
    let (code, _, error) = run(&[&["simulate"], arguments, &["--out", out]].concat());
    assert_eq!(code, 0, "{error}");
}

/// The file is right; what was found.
fn right(arguments: &[&str]) -> Value {
    let (code, out, error) = run(&[&["verify"], arguments, &["--format", "json"]].concat());
    assert_eq!(code, 0, "{arguments:?}: {out}{error}");
    let found: Value = serde_json::from_str(&out).unwrap();
    for found in found.as_array().unwrap_or(&vec![found.clone()]) {
        assert_eq!(found["verdict"], "no row is wrong");
        assert!(found["rows"].as_u64().unwrap() > 0 && found["not_judged"] == 0, "{found}");
    }
    found
}

/// The command ends with this code and says all of these.
fn said(arguments: &[&str], expected: i32, words: &[&str]) {
    let (code, out, error) = run(&[&["verify"], arguments].concat());
    assert_eq!(code, expected, "{arguments:?}: {out}{error}");
    for word in words {
        assert!(error.contains(word), "{word}: {error}");
    }
}

/// The text with another cell in a line, both counted from 0, comments not counted.
fn changed(text: &str, line: usize, column: usize, cell: &dyn Fn(f64) -> f64) -> String {
    let mut number = 0;
    let lines = text.lines().map(|whole| {
        if whole.starts_with('#') {
            return whole.to_owned();
        }
        number += 1;
        if number - 1 != line {
            return whole.to_owned();
        }
        let mut cells: Vec<String> = whole.split(',').map(str::to_owned).collect();
        cells[column] = cell(cells[column].parse().unwrap()).to_string();
        cells.join(",")
    });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[test]
fn runs_of_every_kind_are_right() {
    let folder = Folder::new();
    let so2 = "hamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n[integrator]\ntruncation = 5\nstep = 0.2\n\
               [initial]\nmomentum = [1.0, 0.3, 0.5]\n[run]\ntime = 4\n";
    let su2 = folder.write("system.toml", format!("group = \"SU2\"\n{so2}"));
    let mixed = folder.name("mixed.toml");
    let product = "group = \"SO3*SE2\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]*mu[3] + \
                   mu[3]^2/2 + mu[4]^2/3\"\n[integrator]\ntruncation = 3\nstep = 0.1\n[initial]\n\
                   momentum = [1.0, 0.3, 0.5, 0.2, 0.4, 0.1]\n[run]\ntime = 2\n";
    std::fs::write(&mixed, product).unwrap();
    for (system, more) in [
        (BODY, &["--time", "5"][..]),
        (BODY, &["--time", "5", "--every", "7", "--at", "0.33,1.25,2"]),
        (BODY, &["--time", "5", "--chart", "cayley", "--step", "-0.1"]),
        ("examples/gyrostat.toml", &["--time", "10"]),
        ("examples/heavy_top.toml", &["--time", "0.3"]),
        // A comoving frame.
        ("examples/lagrange_top.toml", &["--time", "0.5"]),
        ("examples/so21_by_brackets.toml", &["--time", "1"]),
        (su2.as_str(), &[]),
        (mixed.as_str(), &[]),
    ] {
        for name in ["run.csv", "run.npy"] {
            let out = folder.name(name);
            simulate(&[&[system], more].concat(), &out);
            let found = right(&[&out]);
            assert!(found["momentum"].as_f64().unwrap() <= 1.0, "{system}: {found}");
            assert!(found["group_element"].as_f64().unwrap() > 0.0, "{system}: {found}");
        }
    }
}

#[test]
fn a_sample_is_spread_over_the_rows_and_says_that_it_is_one() {
    let folder = Folder::new();
    let out = folder.name("run.csv");
    simulate(&[BODY, "--time", "10"], &out);
    let judged = |n: &str| {
        let (code, out, error) = run(&["verify", &out, "--sample", n, "--format", "json"]);
        assert_eq!(code, 0, "{error}");
        serde_json::from_str::<Value>(&out).unwrap()
    };
    let few = judged("7");
    assert_eq!((few["rows"].as_u64(), few["steps"].as_u64()), (Some(7), Some(7)), "{few}");
    assert_eq!(few["not_sampled"], 93);
    assert_eq!(few["verdict"], "no row of the sample is wrong");
    // All rows are no sample.
    let all = judged("1000");
    assert_eq!((all["rows"].as_u64(), &all["verdict"]), (Some(100), &"no row is wrong".into()));
    // The last row is always in it; of the element of a row that is not in it nothing is said.
    let text = std::fs::read_to_string(&out).unwrap();
    for (line, code) in [(101, 1), (50, 0)] {
        std::fs::write(&out, changed(&text, line, 4, &|x| x + 1e-9)).unwrap();
        assert_eq!(run(&["verify", &out, "--sample", "1"]).0, code, "line {line}");
        assert_eq!(run(&["verify", &out]).0, 1, "line {line}");
    }
    said(&[&out, "--sample", "0"], 2, &["--sample"]);
}

#[test]
fn a_report_is_judged_from_its_start_to_its_end() {
    let folder = Folder::new();
    let out = folder.name("report.json");
    let written = |more: &[&str]| {
        let arguments = ["simulate", BODY, "--time", "10", "--format", "json"];
        let report = json(&[&arguments, more].concat());
        std::fs::write(&out, report.to_string()).unwrap();
        report
    };
    let mut report = written(&[]);
    assert_eq!(right(&[&out])["steps"], 100);
    // Several runs, one of them another method's.
    written(&["--truncation", "3,5", "--compare", "rk45"]);
    assert_eq!(right(&[&out]).as_array().unwrap().len(), 2);
    // One a line.
    std::fs::write(&out, format!("{report}\n{report}\n")).unwrap();
    assert_eq!(right(&[&out]).as_array().unwrap().len(), 2);
    let place = "row 2, time 10";
    let z = report["momentum"][2].as_f64().unwrap();
    report["momentum"][2] = (z + 1e-10).into();
    std::fs::write(&out, report.to_string()).unwrap();
    said(&[&out], 1, &[place]);
    report["momentum"][2] = z.into();
    let g = report["group_element_blocks"][0]["matrix"][1][2].as_f64().unwrap();
    report["group_element_blocks"][0]["matrix"][1][2] = (g + 1e-9).into();
    std::fs::write(&out, report.to_string()).unwrap();
    said(&[&out], 1, &[place]);
    std::fs::write(&out, "[1, 2").unwrap();
    said(&[&out], 2, &["no JSON"]);
    std::fs::write(&out, "{}").unwrap();
    said(&[&out], 2, &["no report of `simulate --format json`"]);
}

#[test]
fn what_was_changed_is_found_where_it_is() {
    let folder = Folder::new();
    let out = folder.name("run.csv");
    simulate(&[BODY, "--time", "3"], &out);
    right(&[&out]);
    let text = std::fs::read_to_string(&out).unwrap();
    let names: Vec<&str> =
        text.lines().find(|line| !line.starts_with('#')).unwrap().split(',').collect();
    let column = |name: &str| names.iter().position(|known| *known == name).unwrap();
    type Change<'a> = (usize, usize, &'a dyn Fn(f64) -> f64, &'a str);
    let changes: [Change<'_>; 5] = [
        (12, 1, &|x| x + 1e-12, "row 12, time 1.1"),
        (12, column("g_12"), &|x| x + 1e-11, "row 12, time 1.1"),
        (12, column("energy"), &|x| x * (1.0 + 1e-12), "row 12, time 1.1: the energy"),
        (1, 1, &|x| x + 1e-12, "row 1, time 0: the momentum is not that which the file names"),
        (12, 2, &|_| f64::NAN, "row 12, time 1.1"),
    ];
    for (line, column, change, words) in changes {
        std::fs::write(&out, changed(&text, line, column, change)).unwrap();
        said(&[&out], 1, &[words]);
    }
    // A row is gone.
    let gone: Vec<&str> = text.lines().filter(|line| !line.starts_with("1.5,")).collect();
    std::fs::write(&out, gone.join("\n")).unwrap();
    said(&[&out], 1, &["there are 30 rows, and the file says that it has 31"]);
    // A matrix without names.
    let out = folder.name("run.npy");
    simulate(&[BODY, "--time", "3"], &out);
    right(&[&out]);
    let mut bytes = std::fs::read(&out).unwrap();
    let place = 128 + 8 * (12 * names.len() + 2);
    let value = f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap());
    bytes[place..place + 8].copy_from_slice(&(value * (1.0 + 1e-11)).to_le_bytes());
    std::fs::write(&out, &bytes).unwrap();
    said(&[&out], 1, &["row 13, time 1.2"]);
    bytes.truncate(1000);
    std::fs::write(&out, &bytes).unwrap();
    said(&[&out], 2, &["its shape [31, 17] needs more than the 872 bytes"]);
}

/// Only runs of the exact series of the system file as it is can be judged; all others are refused by name.
#[test]
fn what_cannot_be_judged_is_refused() {
    let folder = Folder::new();
    let out = folder.name("run.csv");
    simulate(&["examples/satellite.toml", "--time", "1"], &out);
    said(&[&out], 2, &["a system with a potential is not judged"]);
    // Earlier versions made such runs.
    simulate(&[BODY, "--time", "3"], &out);
    for (entry, refusal) in [("tuned: true", "was tuned"), ("fitted: 10", "was fitted")] {
        let text = std::fs::read_to_string(&out).unwrap().replacen(
            "# steps:",
            &format!("# {entry}\n# steps:"),
            1,
        );
        std::fs::write(&out, text).unwrap();
        said(&[&out], 2, &[refusal]);
        simulate(&[BODY, "--time", "3"], &out);
    }
    let system = folder.name("body.toml");
    std::fs::copy(root().join(BODY), &system).unwrap();
    simulate(&[&system, "--time", "3"], &out);
    right(&[&out]);
    let text =
        std::fs::read_to_string(&system).unwrap().replace("I1 = 1.5", "I1 = 1.6") + "\n# another\n";
    std::fs::write(&system, text).unwrap();
    said(&[&out], 2, &["is not the system file of this run"]);
    // A file that is no run, and a run without a row, are refused.
    std::fs::write(&out, "time,x,y,z\n").unwrap();
    said(&[&out], 2, &["does not say of which system it is"]);
    said(&[BODY, &out], 3, &["not verified", "the file has no rows"]);
}

/// A part of a run is right as far as it goes, and is said to be a part.
#[test]
fn a_part_is_said_to_be_one() {
    let folder = Folder::new();
    let (whole, part) = (folder.name("t.csv"), folder.name("t.csv.partial"));
    simulate(&[BODY, "--time", "3"], &whole);
    // As a run that is interrupted leaves it.
    let text = std::fs::read_to_string(&whole).unwrap();
    let kept: Vec<&str> = text.lines().take_while(|line| !line.starts_with("1.5,")).collect();
    std::fs::write(&part, kept.join("\n") + "\n# part: interrupted at time 1.4\n").unwrap();
    let (code, said, error) = run(&["verify", &part]);
    assert_eq!(code, 0, "{said}{error}");
    assert!(said.contains("the file is a part of a run: interrupted at time 1.4"), "{said}");
}

/// Momenta that grow by tens of orders on a group that is not compact: no right row is called wrong.
#[test]
fn growing_momenta_are_judged_as_far_as_can_be() {
    let folder = Folder::new();
    let system = folder.write(
        "system.toml",
        "group = \"SL2\"\nhamiltonian = \"mu[0]^2/2+mu[1]*mu[2]\"\n[integrator]\ntruncation = 3\n\
         step = 0.1\n[initial]\nmomentum = [1,0.5,0.5]\n[run]\ntime = 10000\n",
    );
    let out = folder.name("t.csv");
    assert_eq!(run(&["simulate", &system, "--out", &out]).0, 1);
    let (code, found, error) = run(&["verify", &format!("{out}.partial")]);
    assert!(code == 0 || code == 3, "{found}{error}");
    simulate(&[&system, "--time", "4"], &out);
    right(&[&out]);
}

/// The end states of rows that were advanced, by momenta and attitudes in two forms.
#[test]
fn ensembles_are_judged_from_their_starts() {
    let folder = Folder::new();
    let (states, out) = (folder.name("states.csv"), folder.name("ends.csv"));
    let rows = "mu_1,name,mu_2,mu_3,q_w,q_x,q_y,q_z\n2.0,\"a, b\",0.5,1.0,1,0,0,0\n1.0,c,0.5,-1.0,0.6,0,0.8,0\n\
                NaN,d,0,0,1,0,0,0\n0.1,e,0.2,0.3,0,0,0,1\n";
    std::fs::write(&states, rows).unwrap();
    let advance = |out: &str| {
        let (code, _, error) = run(&[
            "ensemble",
            BODY,
            "--initial",
            &states,
            "--out",
            out,
            "--time",
            "5",
            "--step",
            "0.1",
        ]);
        assert_eq!(code, 0, "{error}");
    };
    advance(&out);
    let judged = [BODY, out.as_str(), "--input", &states, "--steps", "50", "--step", "0.1"];
    let found = right(&judged);
    assert!(found["rows"] == 3 && found["refused"] == 1 && found["steps"] == 150, "{found}");
    let text = std::fs::read_to_string(&out).unwrap();
    std::fs::write(&out, changed(&text, 2, 2, &|x| x + 1e-10)).unwrap();
    said(&judged, 1, &["row 2: "]);
    std::fs::write(&out, changed(&text, 4, 5, &|x| x + 1e-8)).unwrap();
    said(&judged, 1, &["row 4: "]);
    // A row that the run does not list as refused has an end.
    std::fs::write(&out, &text).unwrap();
    std::fs::remove_file(format!("{out}.rejected.csv")).unwrap();
    said(&judged, 1, &["row 3: a number is not finite"]);
    // Rows are counted.
    let short: Vec<&str> = text.lines().take(4).collect();
    std::fs::write(&out, short.join("\n")).unwrap();
    advance(&folder.name("again.csv"));
    std::fs::copy(folder.name("again.csv.rejected.csv"), format!("{out}.rejected.csv")).unwrap();
    said(&judged, 1, &["the input has more than the 3 rows of the output"]);
    // Another number of steps leads elsewhere.
    std::fs::write(&out, &text).unwrap();
    let other = [BODY, out.as_str(), "--input", &states, "--steps", "49", "--step", "0.1"];
    said(&other, 1, &["row 1: the momentum is off"]);
}

/// A row of numbers so large that the judge has none for what follows is not right, and not wrong.
#[test]
fn what_the_judge_cannot_tell_is_no_success() {
    let folder = Folder::new();
    let (states, out) = (folder.name("states.csv"), folder.name("ends.csv"));
    let text = "mu_1,mu_2,mu_3\n1e300,0,0\n";
    std::fs::write(&states, text).unwrap();
    std::fs::write(&out, text).unwrap();
    let judged = [BODY, out.as_str(), "--input", &states, "--steps", "1", "--step", "0.1"];
    said(&judged, 3, &["not verified: 1 rows could not be judged", "row 1"]);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_files_are_judged_too() {
    let folder = Folder::new();
    let (states, out) = (folder.name("states.csv"), folder.name("ends.parquet"));
    std::fs::write(&states, "mu_1,mu_2,mu_3\n2.0,0.5,1.0\n1.0,0.5,-1.0\n").unwrap();
    let advance = |states: &str, out: &str| {
        let arguments = ["ensemble", BODY, "--initial", states, "--out", out, "--time", "5"];
        assert_eq!(run(&arguments).0, 0);
    };
    advance(&states, &out);
    let judged = [BODY, out.as_str(), "--input", &states, "--steps", "50", "--step", "0.1"];
    right(&judged);
    // The ends of other starts.
    let other = folder.name("other.csv");
    std::fs::write(&other, "mu_1,mu_2,mu_3\n2.0,0.5,1.0\n1.0,0.5,-1.0000000001\n").unwrap();
    advance(&other, &out);
    said(&judged, 1, &["row 2: "]);
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_files_need_the_feature() {
    let folder = Folder::new();
    let out = folder.name("ends.parquet");
    std::fs::write(&out, "").unwrap();
    said(&[BODY, &out], 2, &["without the feature `parquet`"]);
}
