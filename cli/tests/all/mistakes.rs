//! Bad input: exit code 2, the file, the line, and what to write instead.

use crate::support::{Folder, run, system};

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
    let text = GOOD
        .replace("x^2 + y^2/2", "x^2 + sin(y) + w")
        .replace("step = 0.1", "step = 0.1\ntrucnation = 7");
    let (_folder, system) = system(&text);
    for verb in ["derive", "emit", "simulate", "check", "casimirs"] {
        let (code, out, error) = run(&[verb, &system]);
        assert_eq!((code, out.as_str()), (2, ""), "{verb}");
        for expected in [
            format!("{system}:4:22: error: `sin` of the momentum is not a polynomial"),
            format!("{system}:4:31: error: unknown variable `w`"),
            format!(
                "{system}:7:1: error: unknown key `trucnation` in [integrator]; did you mean `truncation`?"
            ),
            "help: known here: x, y, z".to_owned(),
        ] {
            assert!(error.contains(&expected), "{verb}: {expected}\n{error}");
        }
    }
}

#[test]
fn one_line_reasons() {
    let cases = [
        // The bracket of E₁₂ and E₂₁ is diagonal.
        (
            "hamiltonian = \"mu[0]\"\n[algebra]\nbasis = [[[0, 1], [0, 0]], [[0, 0], [1, 0]]]",
            "is not a combination of the basis",
        ),
        (
            "hamiltonian = \"mu[0]\"\n[algebra]\nbasis = [[[0, 1], [0, 0]], [[0, 2], [0, 0]]]",
            "linear combination of those before it",
        ),
        (
            "hamiltonian = \"a\"\n[algebra]\ngenerators = [\"a\", \"b\", \"c\"]\nbrackets = [\"[a, b] = a\", \"[b, c] = b\", \"[c, a] = c\"]",
            "the Jacobi identity fails for a, b, c",
        ),
        (
            "group = \"SU3\"\nhamiltonian = \"mu[0]\"\n[integrator]\nchart = \"cayley\"",
            "no Cayley chart",
        ),
        (
            "group = \"SO3\"\nhamiltonian = \"mu[0]\"\n[integrator]\ntruncation = 6",
            "truncation 6 is even",
        ),
    ];
    for (text, reason) in cases {
        let (_folder, system) = system(text);
        let (code, _, error) = run(&["derive", &system]);
        assert_eq!(code, 2, "{error}");
        assert!(error.lines().next().unwrap().contains(reason), "{error}");
    }
}

#[test]
fn options_are_checked_too() {
    let (_folder, system) = system(GOOD);
    for (arguments, reason) in [
        (&["simulate", &system, "--step", "0"][..], "other than zero"),
        (&["simulate", &system, "--time", "-1"], ""),
        (&["simulate", &system, "--every", "0"], "from 1"),
        (&["simulate", &system, "--truncation", "3,4"], "truncation 4 is even"),
        (&["derive", &system, "--truncation", "0"], "truncation 0"),
        (&["derive", &system, "--chart", "caley"], "cayley"),
        (&["derive", "nowhere.toml"], "cannot read nowhere.toml"),
        (&["derive"], "FILE"),
        (&["deriv", &system], "derive"),
    ] {
        let (code, _, error) = run(arguments);
        assert_eq!(code, 2, "{arguments:?}: {error}");
        assert!(error.contains(reason), "{arguments:?}: {error}");
    }
}

#[test]
fn what_a_run_needs_is_asked_for() {
    let folder = Folder::new();
    for (line, key) in
        [("step = 0.1", "step"), ("time = 1.0", "time"), ("momentum = [1, 2, 3]", "momentum")]
    {
        let system = folder.write("system.toml", GOOD.replace(line, ""));
        let (code, _, error) = run(&["simulate", &system]);
        assert_eq!(code, 2);
        assert!(
            error.contains(&format!("{key}` is missing")) && error.contains("write for example"),
            "{error}"
        );
    }
    let far = GOOD.replace(
        "momentum = [1, 2, 3]",
        "momentum = [1, 2, 3]\ngroup_element = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]",
    );
    let (code, _, error) = run(&["simulate", &folder.write("system.toml", &far)]);
    assert_eq!(code, 2);
    assert!(error.contains("group_element"), "{error}");
}

/// Too large to derive: refused with a count, not by running out of memory.
#[test]
fn a_problem_too_large_says_so() {
    let folder = Folder::new();
    let terms: Vec<String> =
        (0..6).flat_map(|i| (0..=i).map(move |j| format!("mu[{i}]^2*mu[{j}]^2"))).collect();
    let text = format!(
        "group = \"SO4\"\nhamiltonian = \"{}\"\n[integrator]\ntruncation = 15",
        terms.join(" + ")
    );
    let (code, _, error) = run(&["derive", &folder.write("system.toml", &text)]);
    assert_eq!(code, 2);
    assert!(error.contains("too large") && error.contains("lower the truncation"), "{error}");
}

/// The messages give the place of bytes that are not UTF-8, and name other encodings and separators.
#[test]
fn files_that_are_not_the_text_they_should_be_are_refused_with_the_reason() {
    let folder = Folder::new();
    let write = |name: &str, bytes: &[u8]| folder.write(name, bytes);
    let utf16 = |text: &str| -> Vec<u8> {
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
    };
    let rows = "mu_1;mu_2;mu_3\n1;2,5;3\n";
    let out = folder.name("out.csv");
    let ensemble = |states: &str| {
        let body = "examples/rigid_body.toml";
        run(&["ensemble", body, "--initial", states, "--out", &out, "--time", "1"])
    };
    let learn = |data: &str| run(&["learn", data, "--dt", "0.1"]);
    let verify = |data: &str| run(&["verify", "examples/rigid_body.toml", data]);
    let derive = |path: &str| run(&["derive", path]);
    let latin = write("latin.toml", b"group = \"SO3\"\nname = \"Li\xc3\xa9 \xe9\"");
    let wide = write("wide.toml", &utf16("group = \"SO3\""));
    let wide_rows = write("wide.csv", &utf16(rows));
    let latin_rows = write("latin.csv", b"# a\nmu_1,\xb5_2,mu_3\n1,2,3\n");
    let (semicolons, tabs) =
        (write("a.csv", rows.as_bytes()), write("b.csv", b"mu_1\tmu_2\n1\t2\n"));
    let place = "byte 0xb5 at line 2, column 6 is not UTF-8; save the file as UTF-8";
    for (outcome, said) in [
        (derive(&latin), "byte 0xe9 at line 2, column 13 is not UTF-8; save the file as UTF-8"),
        (derive(&wide), "it is UTF-16, by its first two bytes; save the file as UTF-8"),
        (ensemble(&wide_rows), "UTF-16"),
        (learn(&wide_rows), "UTF-16"),
        (verify(&wide_rows), "UTF-16"),
        (ensemble(&latin_rows), place),
        (learn(&latin_rows), place),
        (verify(&latin_rows), place),
        (ensemble(&semicolons), "semicolons stand between the names of columns; write commas"),
        (learn(&semicolons), "semicolons"),
        (verify(&semicolons), "semicolons"),
        (ensemble(&tabs), "tabs stand between the names of columns"),
    ] {
        let (code, _, error) = outcome;
        assert!(code == 2 && error.contains(said), "{code} {said}: {error}");
    }
}

/// A list with commas that begins with a minus is no option.
#[test]
fn lists_may_begin_with_a_minus() {
    let pairs =
        ["geometrize", "--system", "examples/rigid_body.toml", "--dt", "0.1", "--samples", "40"];
    let more = ["--steps", "10", "--degree", "2", "--within", "-2,2", "--start", "-1,0.5,1"];
    let (code, _, error) = run(&[&pairs[..], &more[..]].concat());
    assert_eq!(code, 0, "{error}");
}
