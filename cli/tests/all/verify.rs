//! `verify`: right files are found right, and whatever was changed in them is found, by time or row.

use crate::support::{BODY, Folder, text_of};
use serde_json::Value;

/// A folder with the records of a run of the rigid body.
fn place(options: &str) -> Folder {
    let folder = Folder::new();
    folder.run(&format!("simulate {BODY} {options} --out run.csv")).ok();
    folder
}

/// The file is right; what was found.
fn right(folder: &Folder, arguments: &str) -> Value {
    let found = folder.json(&format!("verify {arguments}"));
    for found in found.as_array().unwrap_or(&vec![found.clone()]) {
        assert_eq!(found["verdict"], "no row is wrong");
        assert!(found["rows"].as_u64().unwrap() > 0 && found["not_judged"] == 0, "{found}");
    }
    found
}

/// The file is wrong, which is said by these words.
fn wrong(folder: &Folder, arguments: &str, words: &str) {
    folder.run(&format!("verify {arguments}")).fails(1, &[words]);
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
    folder.write(
        "su2.toml",
        "group = \"SU2\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n[integrator]\ntruncation = 5\n\
         step = 0.2\n[initial]\nmomentum = [1.0, 0.3, 0.5]\n[run]\ntime = 4\n",
    );
    folder.write(
        "mixed.toml",
        "group = \"SO3*SE2\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5 + mu[0]*mu[3] + mu[3]^2/2 + mu[4]^2/3\"\n\
         [integrator]\ntruncation = 3\nstep = 0.1\n[initial]\nmomentum = [1.0, 0.3, 0.5, 0.2, 0.4, 0.1]\n[run]\ntime = 2\n",
    );
    for run in [
        "examples/rigid_body.toml --time 5",
        "examples/rigid_body.toml --time 5 --every 7 --at 0.33,1.25,2",
        "examples/rigid_body.toml --time 5 --chart cayley --step -0.1",
        "examples/gyrostat.toml --time 10",
        "examples/heavy_top.toml --time 0.3",
        // A comoving frame.
        "examples/lagrange_top.toml --time 0.5",
        "examples/so21_by_brackets.toml --time 1",
        "su2.toml",
        "mixed.toml",
    ] {
        for out in ["run.csv", "run.npy"] {
            folder.run(&format!("simulate {run} --out {out}")).ok();
            let found = right(&folder, out);
            assert!(found["momentum"].as_f64().unwrap() <= 1.0, "{run}: {found}");
            assert!(found["group_element"].as_f64().unwrap() > 0.0, "{run}: {found}");
        }
    }
}

#[test]
fn a_sample_is_spread_over_the_rows_and_says_that_it_is_one() {
    let folder = place("--time 10");
    let few = folder.json("verify run.csv --sample 7");
    assert_eq!((few["rows"].as_u64(), few["steps"].as_u64()), (Some(7), Some(7)), "{few}");
    assert_eq!(few["not_sampled"], 93);
    assert_eq!(few["verdict"], "no row of the sample is wrong");
    // All rows are no sample.
    assert_eq!(right(&folder, "run.csv --sample 1000")["rows"], 100);
    // The last row is always in it; of the element of a row that is not in it nothing is said but that its drift is another.
    let text = folder.text("run.csv");
    for (line, words) in [(101, "row 101, time 10: "), (50, "row 50, time 4.9: the drift of the")] {
        folder.write("run.csv", changed(&text, line, 4, &|x| x + 1e-9));
        folder.run("verify run.csv --sample 1").fails(1, &[words]);
        folder.run("verify run.csv").fails(1, &[]);
    }
    folder.refused(&[("verify run.csv --sample 0", "--sample")]);
}

#[test]
fn a_report_is_judged_from_its_start_to_its_end() {
    let folder = Folder::new();
    let report = |more: &str| folder.json(&format!("simulate {BODY} --time 10 {more}"));
    let write = |report: &Value| folder.write("report.json", report.to_string());
    let mut report_of_one = report("");
    write(&report_of_one);
    assert_eq!(right(&folder, "report.json")["steps"], 100);
    // Several runs.
    write(&report("--truncation 3,5"));
    assert_eq!(right(&folder, "report.json").as_array().unwrap().len(), 2);
    // One a line.
    folder.write("report.json", format!("{report_of_one}\n{report_of_one}\n"));
    assert_eq!(right(&folder, "report.json").as_array().unwrap().len(), 2);
    for (pointer, change) in [("/momentum/2", 1e-10), ("/group_element_blocks/0/matrix/1/2", 1e-9)]
    {
        let number = report_of_one.pointer_mut(pointer).unwrap();
        let before = number.clone();
        *number = (before.as_f64().unwrap() + change).into();
        write(&report_of_one);
        wrong(&folder, "report.json", "row 2, time 10");
        *report_of_one.pointer_mut(pointer).unwrap() = before;
    }
    for (text, word) in [("[1, 2", "no JSON"), ("{}", "no report of `simulate --format json`")] {
        folder.write("report.json", text);
        folder.refused(&[("verify report.json", word)]);
    }
}

#[test]
fn what_was_changed_is_found_where_it_is() {
    let folder = place("--time 3");
    right(&folder, "run.csv");
    let text = folder.text("run.csv");
    let names = folder.table("run.csv").remove(0);
    let column = |name: &str| names.iter().position(|known| known == name).unwrap();
    type Change<'a> = (usize, usize, &'a dyn Fn(f64) -> f64, &'a str);
    let changes: [Change<'_>; 5] = [
        (12, 1, &|x| x + 1e-12, "row 12, time 1.1"),
        (12, column("g_12"), &|x| x + 1e-11, "row 12, time 1.1"),
        (12, column("energy"), &|x| x * (1.0 + 1e-12), "row 12, time 1.1: the energy"),
        (1, 1, &|x| x + 1e-12, "row 1, time 0: the momentum is not that which the file names"),
        (12, 2, &|_| f64::NAN, "row 12, time 1.1"),
    ];
    for (line, column, change, words) in changes {
        folder.write("run.csv", changed(&text, line, column, change));
        wrong(&folder, "run.csv", words);
    }
    // A row is gone.
    for (time, words) in [
        ("1.5,", "row 16, time 1.6: 2 steps after the last row, and the file says every 1"),
        ("3,", "there are 30 rows, and the file says that it has 31"),
    ] {
        let gone: Vec<&str> = text.lines().filter(|line| !line.starts_with(time)).collect();
        folder.write("run.csv", gone.join("\n"));
        wrong(&folder, "run.csv", words);
    }
    // A matrix without names.
    folder.run(&format!("simulate {BODY} --time 3 --out run.npy")).ok();
    right(&folder, "run.npy");
    let mut bytes = folder.bytes("run.npy");
    let place = 128 + 8 * (12 * names.len() + 2);
    let value = f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap());
    bytes[place..place + 8].copy_from_slice(&(value * (1.0 + 1e-11)).to_le_bytes());
    folder.write("run.npy", &bytes);
    wrong(&folder, "run.npy", "row 13, time 1.2");
    folder.write("run.npy", &bytes[..1000]);
    folder.refused(&[("verify run.npy", "its shape [31, 17] needs more than the 872 bytes")]);
}

/// Columns and entries of the head beside the states are read too, and a file that was cut is not verified.
#[test]
fn what_a_file_says_beside_its_states_is_judged() {
    let folder = place("--time 5");
    // Deviations that are rounding are within a few orders of their bounds, so that no bound is far too wide: of rows a step
    // apart, and of others.
    let others = place("--time 4.9 --every 7");
    for (folder, least) in [(&others, 1e-5), (&folder, 1e-4)] {
        let found = right(folder, "run.csv");
        for name in ["momentum", "group_element"] {
            let share = found[name].as_f64().unwrap();
            assert!(share > least && share <= 1.0, "{name}: {share}");
        }
    }
    let text = folder.text("run.csv");
    let names = folder.table("run.csv").remove(0);
    for (name, what) in [
        ("spatial_momentum_drift", "spatial momentum"),
        ("casimir_drift", "Casimirs"),
        ("energy_drift", "energy"),
    ] {
        let column = names.iter().position(|known| known == name).unwrap();
        folder.write("run.csv", changed(&text, 12, column, &|_| 3.0));
        wrong(&folder, "run.csv", &format!("row 12, time 1.1: the drift of the {what} is "));
    }
    let start = "# initial_momentum: ";
    for (from, to, words) in [
        ("# group: SO3\n", "# group: SO6\n", "the head says `group: SO6`, which is SO3"),
        ("# time: 5\n", "# time: 8\n", "`steps: 50`, which is 80"),
        ("# steps: 50\n", "# steps: 53\n", "`steps: 53`, which is 50"),
        ("# time: 5\n", "# time: 8\n# steps: 80\n", "the file says that the run ends at 8"),
        ("# every: 1\n", "# every: 2\n", "1 steps after the last row, and the file says every 2"),
        (start, "# initial_momentum: 1", "the momentum is not that which the file names"),
        (
            start,
            "# initial_group_element: 0,1,0,-1,0,0,0,0,1\n# initial_momentum: ",
            "row 1, time 0: the group element is not that which the file names as the start",
        ),
        (
            "_momentum_scale: ",
            "_momentum_scale: 1",
            "the scale of the spatial momentum is not that which",
        ),
        (
            "# casimir_scales: ",
            "# casimir_scales: 1",
            "the scale of the Casimirs is not that which",
        ),
        ("# energy_scale: ", "# energy_scale: 1", "the scale of the energy is not that which"),
    ] {
        assert!(text.contains(from), "{from}");
        let other = text.replacen(from, to, 1);
        let own =
            if to.contains("steps: 80") { other.replacen("# steps: 50\n", "", 1) } else { other };
        folder.write("run.csv", own);
        wrong(&folder, "run.csv", words);
    }
    // The first 20 rows, as a process that was killed leaves them.
    let records = text.lines().filter(|line| !line.starts_with('#')).take(21);
    let head = text.lines().take_while(|line| line.starts_with('#'));
    folder.write("run.csv", head.chain(records).collect::<Vec<_>>().join("\n") + "\n");
    let cut = folder.run("verify run.csv").fails(3, &["the file ends at time 1.9"]);
    cut.prints(&["not verified: the file is cut before its end"]);
}

/// Ends that solve the equation of a step which may not be made.
#[test]
fn steps_beyond_the_chart_or_the_series_are_wrong() {
    let folder = Folder::new();
    // A rotation by 4 radians, and terms of third order half as large as the first.
    for (hamiltonian, truncation, state, step, words) in [
        (
            "mu[0]^2/2 + mu[1]^2/2 + mu[2]^2/2",
            1,
            "1,0,0",
            4.0,
            "step 1 of 1 lies outside the chart: an eigenvalue has the size 4.000",
        ),
        (
            "mu[0]^4/2 + mu[1]^4 + mu[2]^4/3 + mu[0]*mu[1]*mu[2]",
            3,
            "1,0.9,0.8",
            0.3,
            "is of a series whose last two terms have the ratio 0.553",
        ),
    ] {
        let integrator = format!("[integrator]\ntruncation = {truncation}\n");
        let system = format!("group = \"SO3\"\nhamiltonian = \"{hamiltonian}\"\n{integrator}");
        folder.write("system.toml", system);
        folder.write("states.csv", format!("mu_1,mu_2,mu_3\n{state}\n"));
        let judged = "system.toml states.csv --input states.csv --steps 1";
        wrong(&folder, &format!("{judged} --step {step}"), words);
    }
}

/// Steps by collocation: roots, exponentials and cosines, fields that move, inputs by tables, steps off the grid, reports.
#[test]
fn runs_by_collocation_are_judged() {
    let folder = Folder::new();
    folder.write(
        "fields.toml",
        "group = \"SO3\"\nhamiltonian = \"exp(mu[0]/4) + cos(mu[1]) + u*mu[2]^2/3\"\n\
         [inputs]\ntimes = [-1, 0, 1, 2, 3, 9]\nu = [1, 1.2, 0.9, 1.1, 1.4, 1]\n\
         [integrator]\ntruncation = 5\nstep = 0.1\n[initial]\nmomentum = [1.0, 0.3, 0.5]\n[run]\ntime = 3\n",
    );
    for run in [
        "examples/relativistic_body.toml --time 3",
        "examples/exponential_spin.toml --time 3 --every 4 --at 0.33",
        "examples/screened_top.toml --time 0.5 --truncation 3",
        "examples/driven_qubit.toml --time 1",
        "fields.toml",
    ] {
        folder.run(&format!("simulate {run} --out run.csv")).ok();
        let found = right(&folder, "run.csv");
        assert!(found["momentum"].as_f64().unwrap() > 0.0, "{run}: {found}");
        assert!(found["group_element"].as_f64().unwrap() > 0.0, "{run}: {found}");
    }
    let report = folder.json("simulate fields.toml");
    folder.write("report.json", report.to_string());
    right(&folder, "report.json");
    // The run of the file is that of the last simulation.
    let text = folder.text("run.csv");
    for (column, change) in [(1, 1e-12), (4, 1e-12)] {
        folder.write("run.csv", changed(&text, 12, column, &|x| x + change));
        wrong(&folder, "run.csv", "row 12, time 1.1");
    }
    folder.write("run.csv", &text);
    let system = folder.text("fields.toml");
    folder.write("fields.toml", system.replace("mu[0]/4", "mu[0]/5"));
    folder.refused(&[("verify run.csv", "is not the system file of this run")]);
    // Of a state outside the domain of H nothing can be said.
    folder.write("fields.toml", system.replace("cos(mu[1])", "ln(mu[1])"));
    folder.write("states.csv", "mu_1,mu_2,mu_3\n1,-0.3,0.5\n");
    folder
        .run("verify fields.toml states.csv --input states.csv --steps 1 --step 0.1")
        .fails(3, &["row 1: step 1 of 1: the Hamiltonian is not defined"]);
}

/// Only runs of the exact series of the system file as it is can be judged; all others are refused by name.
#[test]
fn what_cannot_be_judged_is_refused() {
    let folder = Folder::new();
    let refused = |word: &str| folder.refused(&[("verify run.csv", word)]);
    let simulate = |run: &str| folder.run(&format!("simulate {run} --out run.csv")).ok();
    simulate("examples/satellite.toml --time 1");
    refused("a system with a potential is not judged");
    // Earlier versions made such runs.
    for (entry, refusal) in [("tuned: true", "was tuned"), ("fitted: 10", "was fitted")] {
        simulate(&format!("{BODY} --time 3"));
        let text = folder.text("run.csv");
        folder.write("run.csv", text.replacen("# steps:", &format!("# {entry}\n# steps:"), 1));
        refused(refusal);
    }
    let system = text_of(BODY);
    folder.write("body.toml", &system);
    simulate("body.toml --time 3");
    right(&folder, "run.csv");
    folder.write("body.toml", system.replace("I1 = 1.5", "I1 = 1.6") + "\n# another\n");
    refused("is not the system file of this run");
    // A file that is no run, and a run without a row, are refused.
    folder.write("run.csv", "time,x,y,z\n");
    refused("does not say of which system it is");
    folder
        .run(&format!("verify {BODY} run.csv"))
        .fails(3, &["not verified", "the file has no rows"]);
}

/// A part of a run is right as far as it goes, and is said to be a part.
#[test]
fn a_part_is_said_to_be_one() {
    let folder = place("--time 3");
    // As a run that is interrupted leaves it.
    let text = folder.text("run.csv");
    let kept: Vec<&str> = text.lines().take_while(|line| !line.starts_with("1.5,")).collect();
    folder.write("t.csv.partial", kept.join("\n") + "\n# part: interrupted at time 1.4\n");
    let found = folder.run("verify t.csv.partial").ok();
    found.prints(&["the file is a part of a run: interrupted at time 1.4"]);
}

/// Momenta that grow by tens of orders on a group that is not compact: no right row is called wrong.
#[test]
fn growing_momenta_are_judged_as_far_as_can_be() {
    let folder = Folder::with(
        "group = \"SL2\"\nhamiltonian = \"mu[0]^2/2+mu[1]*mu[2]\"\n[integrator]\ntruncation = 3\n\
         step = 0.1\n[initial]\nmomentum = [1,0.5,0.5]\n[run]\ntime = 10000\n",
    );
    folder.run("simulate system.toml --out t.csv").fails(1, &[]);
    let found = folder.run("verify t.csv.partial");
    assert!(found.code == 0 || found.code == 3, "{found:?}");
    folder.run("simulate system.toml --time 4 --out t.csv").ok();
    right(&folder, "t.csv");
}

/// The end states of rows that were advanced, by momenta and attitudes in two forms.
#[test]
fn ensembles_are_judged_from_their_starts() {
    let folder = Folder::new();
    folder.write(
        "states.csv",
        "mu_1,name,mu_2,mu_3,q_w,q_x,q_y,q_z\n2.0,\"a, b\",0.5,1.0,1,0,0,0\n1.0,c,0.5,-1.0,0.6,0,0.8,0\n\
         NaN,d,0,0,1,0,0,0\n0.1,e,0.2,0.3,0,0,0,1\n",
    );
    let states = format!("{BODY} --initial states.csv --time 5 --step 0.1");
    folder.run(&format!("ensemble {states} --out ends.csv")).ok();
    let judged = format!("{BODY} ends.csv --input states.csv --step 0.1 --steps");
    let fifty = format!("{judged} 50");
    let found = right(&folder, &fifty);
    assert!(found["rows"] == 3 && found["refused"] == 1 && found["steps"] == 150, "{found}");
    let text = folder.text("ends.csv");
    for (row, column, change, what) in
        [(2, 2, 1e-10, "the Casimirs drift by"), (4, 5, 1e-8, "the spatial momentum drifts by")]
    {
        folder.write("ends.csv", changed(&text, row, column, &|x| x + change));
        wrong(&folder, &fifty, &format!("row {row}: {what}"));
    }
    // A row that the run does not list as refused has an end.
    folder.write("ends.csv", &text);
    let list = folder.bytes("ends.csv.rejected.csv");
    folder.remove("ends.csv.rejected.csv");
    wrong(&folder, &fifty, "row 3: a number is not finite");
    // Rows are counted.
    folder.write("ends.csv.rejected.csv", list);
    folder.write("ends.csv", text.lines().take(4).collect::<Vec<_>>().join("\n"));
    wrong(&folder, &fifty, "the input has more than the 3 rows of the output");
    // Another number of steps leads elsewhere.
    folder.write("ends.csv", &text);
    wrong(&folder, &format!("{judged} 49"), "row 1: the momentum is off");
}

/// A row of numbers so large that the judge has none for what follows is not right, and not wrong.
#[test]
fn what_the_judge_cannot_tell_is_no_success() {
    let folder = Folder::new();
    folder.write("states.csv", "mu_1,mu_2,mu_3\n1e300,0,0\n");
    folder
        .run(&format!("verify {BODY} states.csv --input states.csv --steps 1 --step 0.1"))
        .fails(3, &["not verified: 1 rows could not be judged", "row 1"]);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_files_are_judged_too() {
    let folder = Folder::new();
    let judged = format!("{BODY} ends.parquet --input states.csv --steps 50 --step 0.1");
    // The ends of the starts, and of others.
    for (file, last) in [("states.csv", "-1.0"), ("other.csv", "-1.0000000001")] {
        folder.write(file, format!("mu_1,mu_2,mu_3\n2.0,0.5,1.0\n1.0,0.5,{last}\n"));
        folder.run(&format!("ensemble {BODY} --initial {file} --out ends.parquet --time 5")).ok();
        match file {
            "states.csv" => drop(right(&folder, &judged)),
            _ => wrong(&folder, &judged, "row 2: "),
        }
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_files_need_the_feature() {
    let folder = Folder::new();
    folder.write("ends.parquet", "");
    let verify = format!("verify {BODY} ends.parquet");
    folder.refused(&[(&verify, "without the feature `parquet`")]);
}
