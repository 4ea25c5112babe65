//! The program: a page with a gallery of one's own, mistakes told at once, and runs that go on where they stopped.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use assert_cmd::Command;

const WHEEL: &str = r#"
name = "wheel"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2/2 + y^2/2 + (z - 3)^2/3"
units = { time = "s", momentum = "N m s" }
integrator = { truncation = 5, step = 0.05 }
initial = { momentum = [1.0, 0.5, 2.0] }
run = { time = 10.0 }
"#;

/// Runs the program; returns true for success, and its error stream.
fn run(folder: &Path, arguments: &[&str]) -> (bool, String) {
    let mut command = Command::cargo_bin("coadjoint-paper").unwrap();
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    (output.status.success(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_gallery_of_ones_own_and_mistakes_before_anything_is_run() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    std::fs::create_dir(folder.join("systems")).unwrap();
    std::fs::write(folder.join("systems/wheel.toml"), WHEEL).unwrap();
    std::fs::write(folder.join("systems/notes.txt"), "no system").unwrap();
    let page = ["reduction-error", "--quick", "--html", "page.html", "--gallery"];
    let (fine, said) = run(folder, &[&page[..], &["systems"]].concat());
    assert!(fine && said.contains("gallery, 1 of 1"), "{said}");
    let html = std::fs::read_to_string(folder.join("page.html")).unwrap();
    for expected in [
        "id=\"reduction-error\"",
        "id=\"gallery-wheel\"",
        ">Body momentum (N m s)</text>",
        ">Relative drifts</text>",
        "<span class=\"mark\">3 of 3</span>",
    ] {
        assert!(html.contains(expected), "{expected}");
    }
    std::fs::create_dir(folder.join("bad")).unwrap();
    std::fs::write(folder.join("bad/bad.toml"), WHEEL.replace("x^2/2", "x^2/0")).unwrap();
    std::fs::create_dir(folder.join("none")).unwrap();
    let quick = |more: &[&'static str]| [&["reduction-error", "--quick"][..], more].concat();
    for (arguments, expected) in [
        (vec!["table-3"], "use one of simulation"),
        (quick(&["--html", "nowhere/page.html"]), "cannot write there"),
        (quick(&["--html", "systems"]), "cannot write there"),
        (quick(&["--html", "page.html", "--gallery", "none"]), "no file NAME.toml"),
        (quick(&["--html", "page.html", "--gallery", "missing"]), "cannot read missing"),
        (quick(&["--html", "page.html", "--gallery", "bad"]), "bad.toml"),
    ] {
        let (fine, said) = run(folder, &arguments);
        assert!(!fine && said.contains(expected) && !said.contains("1 of 1: red"), "{said}");
    }
}

/// Results on disk are not computed again, unless they are damaged or of another seed.
#[test]
fn an_interrupted_run_goes_on_where_it_stopped() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let page = ["--quick", "--out", "out", "--html", "page.html"];
    let names = ["simulation", "orders", "work", "table-2", "hamiltonian", "geometrize"];
    let others = ["hamilton-jacobi", "reduction-error", "learned", "noise", "table-1"];
    assert!(run(folder, &[&["reduction-error"][..], &page].concat()).0);
    let made = folder.join("out/reduction-error.json");
    let text = std::fs::read_to_string(&made).unwrap();
    let csv = std::fs::read_to_string(folder.join("out/reduction-error.csv")).unwrap();
    assert!(csv.starts_with("size,group_error,covector_error\n"));
    let first = std::fs::read_to_string(folder.join("page.html")).unwrap();
    for name in names.iter().chain(&others).chain(&["harder-truths"]) {
        let own = text.replace("\"name\": \"reduction-error\"", &format!("\"name\": \"{name}\""));
        std::fs::write(folder.join(format!("out/{name}.json")), own).unwrap();
    }
    let (fine, said) = run(folder, &[&["all"][..], &page].concat());
    assert!(fine && said.matches("done already").count() == 12, "{said}");
    // Damaged files are made anew; the page is that of one go.
    std::fs::write(&made, "{").unwrap();
    let (fine, said) = run(folder, &[&["all"][..], &page].concat());
    assert!(fine && said.contains("8 of 12: reduction-error …"), "{said}");
    assert!(said.matches("done already").count() == 11, "{said}");
    assert!(std::fs::read_to_string(&made).unwrap() == text);
    assert!(run(folder, &[&["reduction-error"][..], &page].concat()).0);
    assert!(std::fs::read_to_string(folder.join("page.html")).unwrap() == first);
    assert!(run(folder, &[&["reduction-error", "--seed", "1"][..], &page].concat()).0);
    let (_, said) = run(folder, &[&["all"][..], &page].concat());
    assert!(said.contains("8 of 12: reduction-error …"), "{said}");
}
