//! Bad input: exit code 2, the file, the line, and what to write instead.

use crate::support::{BODY, Folder};

const GOOD: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2 + y^2/2"
[integrator]
step = 0.1
[initial]
momentum = [1, 2, 3]
[run]
time = 1.0
"#;

/// Every mistake in a file is reported at once, with its line.
#[test]
fn mistakes_are_reported_with_file_and_line() {
    let folder = Folder::with(
        &GOOD
            .replace("x^2 + y^2/2", "x^2 + sin(y) + w")
            .replace("step = 0.1", "step = 0.1\ntrucnation = 7"),
    );
    let others = [
        "system.toml:4:31: error: unknown variable `w`",
        "system.toml:7:1: error: unknown key `trucnation` in [integrator]; did you mean `truncation`?",
        "help: known here: x, y, z",
    ];
    // A function of coordinates is no mistake here.
    for verb in ["derive", "emit", "check", "casimirs", "simulate"] {
        let ran = folder.run(&format!("{verb} system.toml")).fails(2, &others);
        assert!(ran.out.is_empty() && !ran.error.contains("polynomial"), "{verb}: {ran:?}");
    }
}

#[test]
fn options_are_checked_too() {
    Folder::with(GOOD).refused(&[
        ("simulate system.toml --step 0", "other than zero"),
        ("simulate system.toml --time -1", ""),
        ("simulate system.toml --every 0", "from 1"),
        ("simulate system.toml --truncation 3,4", "truncation 4 is even"),
        ("derive system.toml --truncation 0", "truncation 0"),
        ("derive system.toml --chart caley", "cayley"),
        ("derive nowhere.toml", "cannot read nowhere.toml"),
        ("derive", "FILE"),
        ("deriv system.toml", "derive"),
        // Options of earlier versions name what takes their place.
        ("simulate system.toml --tuned", "--tuned was removed"),
        ("simulate examples/satellite.toml --fitted=12", "--fitted was removed"),
        ("simulate system.toml --tuned", "--truncation, or write frame = \"comoving\""),
    ]);
}

#[test]
fn what_a_run_needs_is_asked_for() {
    for (line, key) in
        [("step = 0.1", "step"), ("time = 1.0", "time"), ("momentum = [1, 2, 3]", "momentum")]
    {
        let folder = Folder::with(&GOOD.replace(line, ""));
        let missing = format!("{key}` is missing");
        folder.run("simulate system.toml").fails(2, &[&missing, "write for example"]);
    }
    let far = "momentum = [1, 2, 3]\ngroup_element = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]";
    let folder = Folder::with(&GOOD.replace("momentum = [1, 2, 3]", far));
    folder.refused(&[("simulate system.toml", "group_element")]);
}

/// Too large to derive: refused with a count, not by running out of memory.
#[test]
fn a_problem_too_large_says_so() {
    let terms: Vec<String> =
        (0..6).flat_map(|i| (0..=i).map(move |j| format!("mu[{i}]^2*mu[{j}]^2"))).collect();
    let folder = Folder::with(&format!(
        "group = \"SO4\"\nhamiltonian = \"{}\"\n[integrator]\ntruncation = 15",
        terms.join(" + ")
    ));
    folder.run("derive system.toml").fails(2, &["too large", "lower the truncation"]);
}

/// The messages give the place of bytes that are not UTF-8, and name other encodings and separators.
#[test]
fn files_that_are_not_the_text_they_should_be_are_refused_with_the_reason() {
    let folder = Folder::new();
    let utf16 = |text: &str| -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
    };
    let rows = "mu_1;mu_2;mu_3\n1;2,5;3\n";
    folder.write("latin.toml", b"group = \"SO3\"\nname = \"Li\xc3\xa9 \xe9\"");
    folder.write("wide.toml", utf16("group = \"SO3\""));
    folder.write("wide.csv", utf16(rows));
    folder.write("latin.csv", b"# a\nmu_1,\xb5_2,mu_3\n1,2,3\n");
    folder.write("semicolons.csv", rows);
    folder.write("tabs.csv", "mu_1\tmu_2\n1\t2\n");
    let byte = |byte, column| {
        format!("byte {byte} at line 2, column {column} is not UTF-8; save the file as UTF-8")
    };
    let wide = "it is UTF-16, by its first two bytes; save the file as UTF-8";
    folder.refused(&[("derive latin.toml", &byte("0xe9", 13)), ("derive wide.toml", wide)]);
    for (file, word) in [
        ("wide.csv", "UTF-16"),
        ("latin.csv", &byte("0xb5", 6)),
        ("semicolons.csv", "semicolons stand between the names of columns; write commas"),
        ("tabs.csv", "tabs stand between the names of columns"),
    ] {
        folder.refused(&[
            (&format!("ensemble {BODY} --initial {file} --out out.csv --time 1"), word),
            (&format!("learn {file} --dt 0.1"), word),
            (&format!("verify {BODY} {file}"), word),
        ]);
    }
}
