//! `reproduce --html`: the page is written, with a gallery of one's own; what cannot be made is refused at once.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use support::run;

const WHEEL: &str = r#"
name = "wheel"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2/2 + y^2/2 + (z - 3)^2/3"

[units]
time = "s"
momentum = "N m s"

[integrator]
truncation = 5
step = 0.05

[initial]
momentum = [1.0, 0.5, 2.0]

[run]
time = 10.0
"#;

#[test]
fn a_page_with_a_gallery_of_ones_own() {
    let folder = tempfile::tempdir().unwrap();
    let systems = folder.path().join("systems");
    std::fs::create_dir(&systems).unwrap();
    std::fs::write(systems.join("wheel.toml"), WHEEL).unwrap();
    std::fs::write(systems.join("notes.txt"), "no system").unwrap();
    let html = folder.path().join("page.html");
    let arguments = [
        "reproduce",
        "reduction-error",
        "--quick",
        "--html",
        html.to_str().unwrap(),
        "--gallery",
        systems.to_str().unwrap(),
    ];
    let (code, _, said) = run(&arguments);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("gallery, 1 of 1"), "{said}");
    let page = std::fs::read_to_string(&html).unwrap();
    for expected in [
        "id=\"reduction-error\"",
        "id=\"gallery-wheel\"",
        ">Orbit on the sphere",
        "|μ| = 2.291 (N m s)",
        ">Body momentum (N m s)</text>",
        ">Relative drifts</text>",
        "<span class=\"mark\">3 of 3</span>",
    ] {
        assert!(page.contains(expected), "{expected}");
    }
    assert!(!page.contains("//") && !page.contains("NaN"));
    // The same command makes the same bytes.
    assert_eq!(run(&arguments).0, 0);
    assert!(std::fs::read_to_string(&html).unwrap() == page);
}

#[test]
fn what_cannot_be_made_is_refused_before_anything_is_run() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let html = inside("page.html");
    let page = ["reproduce", "reduction-error", "--quick", "--html"];
    let nowhere = inside("none/page.html");
    for (more, expected) in [
        (vec![nowhere.as_str()], "no such folder"),
        (vec![folder.path().to_str().unwrap()], "this is a folder"),
        (vec![&html, "--gallery", folder.path().to_str().unwrap()], "no file NAME.toml"),
        (vec![&html, "--gallery", "missing"], "cannot read missing"),
        (vec![&html, "--work-precision", folder.path().to_str().unwrap()], "work --out"),
    ] {
        let (code, out, said) = run(&[&page[..], &more].concat());
        assert_eq!(code, 2, "{said}");
        assert!(said.contains(expected) && out.is_empty(), "{said}");
    }
    // A mistake in a system of the gallery is shown at its place.
    std::fs::write(folder.path().join("bad.toml"), WHEEL.replace("x^2/2", "x^2/0")).unwrap();
    let (code, _, said) =
        run(&[&page[..], &[&html, "--gallery", folder.path().to_str().unwrap()]].concat());
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("bad.toml"), "{said}");
}
